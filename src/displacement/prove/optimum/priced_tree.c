/* A tree in which pairs that are left in conflict have prices.
 *
 * Where a pair overlaps, single pieces show less than its depth. So polygons that join pieces (joined_piece.c) are made
 * for the present layout, and then for each layout that the tree finds; the tree is begun again with them. */
#include "displacement/prove/optimum/body_contact.h"
#include "displacement/prove/optimum/tree.h"
#include "displacement/prove/optimum/tuning.h"

typedef struct joining {
    sunder_i_joined *item;
    size_t n, capacity;
} joining;

bool sunder_i_tree_list_parts(const sunder_i_model *model, uint32_t i, uint32_t j, sunder_i_list *body)
{
    const double home[2] = {0, 0}, limit = sunder_i_limit_of(&model->body[i]);
    const uint32_t whole = sunder_i_whole_of(model, model->member[model->body[j].member]);
    sunder_i_list near = {0};
    bool ok = true;
    if (sunder_i_is_barrier_body(model, &model->body[j]) && limit < INFINITY)
        ok = sunder_i_bodies_about(model, i, home, limit + model->rules.full_gap, &near);
    for (size_t k = 0; k < near.n && ok; k++) {
        const sunder_i_body *b = &model->body[near.item[k]];
        if (sunder_i_is_barrier_body(model, b) && sunder_i_whole_of(model, model->member[b->member]) == whole)
            ok = sunder_i_list_push(body, near.item[k]);
    }
    sunder_i_free(near.item);
    return ok && sunder_i_list_push(body, j);
}

/* Runs a tree until it is complete, or its steps are used up, or a layout that it finds shows that further polygons are
 * needed: then *again is set. Returns false if memory is out. */
static bool run_tree(sunder_i_tree *tree, const sunder_i_priced_run *run, joining *joined, bool last, bool *again)
{
    const size_t before = joined->n;
    for (bool found = true; found && !*again;) {
        const sunder_i_tree_outcome outcome = sunder_i_tree_run(tree, run->steps);
        if (tree->failed) return false;
        found = outcome == SUNDER_I_TREE_FOUND || outcome == SUNDER_I_TREE_JOINED;
        if (found && run->found && !run->found(tree, run->context)) return false;
        if (found && !last && !sunder_i_tree_join_pieces(tree, false, &joined->item, &joined->n, &joined->capacity))
            return false;
        *again = joined->n > before;
    }
    return true;
}

bool sunder_i_tree_run_priced(const sunder_i_task *task, const sunder_i_priced_run *run)
{
    sunder_i_task now = *task;
    joining joined = {0};
    bool ok = true, again = true;
    for (int round = 0; ok && again; round++) {
        sunder_i_tree tree;
        now.joined = joined.item;
        now.joins = joined.n;
        ok = sunder_i_tree_init(&tree, &now);
        if (ok && round == 0) ok = sunder_i_tree_join_pieces(&tree, true, &joined.item, &joined.n, &joined.capacity);
        again = ok && joined.n > now.joins;
        if (ok && !again) ok = run_tree(&tree, run, &joined, round >= MOST_JOINED, &again);
        if (ok && !again && run->ended) ok = run->ended(&tree, run->context);
        now.goal = tree.task.goal;
        sunder_i_tree_free(&tree);
    }
    sunder_i_free(joined.item);
    return ok;
}
