/* The bodies of a tree: those of its task, and those that join it because its bodies run into them. */
#include "displacement/prove/optimum/body_contact.h"
#include "displacement/prove/optimum/tree.h"

#include <string.h>

void sunder_i_tree_lend_bodies(sunder_i_tree *tree)
{
    tree->task.body = tree->body;
    tree->task.weight = tree->program.weight = tree->weight;
    tree->task.anchor = tree->program.anchor = tree->anchor;
    tree->program.mass = tree->mass;
    tree->program.bodies = tree->task.n;
}

void sunder_i_tree_set_body(sunder_i_tree *tree, size_t k, uint32_t body, double weight)
{
    const sunder_i_body *b = &tree->task.model->body[body];
    tree->body[k] = body;
    tree->weight[k] = b->fixed ? INFINITY : weight;
    tree->mass[k] = b->fixed ? 0 : 0.5 / weight;
    tree->limit[k] = sunder_i_limit_of(b);
    if (!b->fixed) memcpy(tree->anchor + 2 * k, sunder_i_preferred(tree->task.model, body), 2 * sizeof *tree->anchor);
}

void sunder_i_tree_add_guest(sunder_i_tree *tree, uint32_t body)
{
    const size_t n = tree->task.n;
    if (n == tree->capacity) return;
    sunder_i_tree_set_body(tree, n, body, sunder_i_weight_below(tree->task.model, &tree->task.model->body[body]));
    tree->task.n = n + 1;
    sunder_i_tree_lend_bodies(tree);
    sunder_i_dual_place(&tree->program);
}

/* Adds n springs as cuts of the root. */
static void add_springs(sunder_i_tree *t, const sunder_i_move_cut *spring, size_t n)
{
    if (!sunder_i_reserve(&t->cut, &t->cut_capacity, t->cuts + n, sizeof *t->cut) ||
        !sunder_i_reserve(&t->note, &t->note_capacity, t->cuts + n, sizeof *t->note)) {
        t->failed = true;
        return;
    }
    for (size_t k = 0; k < n; k++) {
        t->cut[t->cuts] = spring[k];
        t->note[t->cuts++] = (sunder_i_cut_note){.kind = SUNDER_I_CUT_SPRING};
    }
}

void sunder_i_tree_add_springs(sunder_i_tree *tree)
{
    const sunder_i_model *model = tree->task.model;
    if (tree->task.springs) add_springs(tree, tree->task.spring, tree->task.springs);
    for (uint32_t i = 0; i < tree->task.n && tree->task.all_springs && model->row_sides; i++)
        for (uint32_t j = i + 1; j < tree->task.n && !tree->failed; j++) {
            sunder_i_move_cut cut[4];
            add_springs(tree, cut, sunder_i_spring_cuts(model, tree->body[i], tree->body[j], i, j, cut));
        }
    tree->springs = tree->cuts;
    tree->program.cut = tree->cut;
}
