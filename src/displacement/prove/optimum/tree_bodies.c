/* The bodies of a tree: those of its task, and those that join it because its bodies run into them. */
#include "displacement/prove/optimum/tree.h"

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
}

void sunder_i_tree_add_guest(sunder_i_tree *tree, uint32_t body)
{
    const size_t n = tree->task.n;
    if (n == tree->capacity) return;
    sunder_i_tree_set_body(tree, n, body, sunder_i_weight_below(tree->task.model, &tree->task.model->body[body]));
    tree->anchor[2 * n] = tree->anchor[2 * n + 1] = 0;
    tree->task.n = n + 1;
    sunder_i_tree_lend_bodies(tree);
    sunder_i_dual_place(&tree->program);
}
