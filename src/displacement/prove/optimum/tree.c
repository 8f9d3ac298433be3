/* Branch and bound for the least cost of a few bodies, exact for arcs, for shapes that are not convex, and for holes.
 *
 * A node restricts, for some pairs, the relative move u_ij = t_j - t_i to a convex region given by its cuts. Its
 * program is the least cost under all cuts, for which forces prove a lower bound (dual_program.c). If the minimiser has
 * a pair in conflict, cuts are added that lose no solution (tree_cuts.c), or the node is divided by three cones
 * (tree_branch.c). A node whose forces prove the goal is closed; so is one that leaves a pair no room. A node without
 * conflict is a leaf: no layout below it is cheaper.
 *
 * The bound is the least of the goal and the values of nodes that are open, or leaves; a cut by a disc removes only
 * layouts that cost at least the goal. The open node with the least value is processed next, so the bound is valid, and
 * the best possible at that point, whenever the steps end.
 *
 * Why this tree? The free places of a pair are the complement of an obstacle, so the problem is a choice of sides.
 * There are three usual methods.
 *
 *  - A mixed integer program has a binary variable for each side of an obstacle, and a constant M that switches the
 *    constraint of a side off. M has to exceed all moves, so the relaxation, with fractional sides, proves next to
 *    nothing until most sides are chosen. It also needs a cover of the free places by finitely many convex parts, and
 *    beside an arc there is none.
 *  - A subdivision of the space of all moves has two dimensions for each body: twenty for ten bodies. Near the optimum,
 *    where a dozen contacts bind at once, boxes would be divided without end.
 *  - A branch for each line by which one piece may pass another (../proofs/branches.c) suits the question whether there
 *    is a solution at all, where most branches end at once. For the least cost, the pieces of one shape have many lines
 *    that are nearly alike, and each would be a child. It was tried for the clusters of the search: 1.5 times the
 *    instructions (tests/bench/DISPLACEMENT.md).
 *
 * Here a node divides the plane of one relative move, which has two dimensions whatever the shapes are, into three
 * cones that cover it. Sides are never listed: the forbidden set is only asked which pieces are near a place. Most
 * progress comes from cuts, not from branches: the hull of what is free in a region is a convex relaxation without M,
 * and each cut tightens it where the minimiser stands. The proof of a node is a set of forces, one for each cut that
 * binds, and its bound follows from weak duality alone (dual_program.c). So the solver of the programs need not be
 * trusted, and a checker needs no solver.
 *
 * What it reaches (tests/bench/displacement/optimum.csv, gap 3 m, no barriers): all groups of Saint-Jean, Krems,
 * Baltimore and Neuss, 497 of 498 of Liechtenstein, 1,115 of 1,130 of Jakarta. In groups of more than some twenty
 * bodies the tree does not end within its effort, and blocks bound them (blocks.c). In Paris one group of 52 blocks
 * leaves 47.5 % of the cost without proof. */
#include "displacement/prove/optimum/tree.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/extremes.h"
#include "base/heap.h"
#include "base/watch.h"

#include <math.h>
#include <string.h>

/* Loads the program of the root: no pair lacks anything. */
static bool load_root(sunder_i_tree *tree)
{
    sunder_i_cut_force *force = sunder_i_alloc(tree->task.prices, sizeof *force);
    for (uint32_t k = 0; force && k < tree->task.prices; k++)
        force[k] = (sunder_i_cut_force){(uint32_t)tree->springs + 2 * k, tree->price[k].linear};
    const bool ok = force && sunder_i_dual_load(&tree->program, force, tree->task.prices);
    sunder_i_free(force);
    return ok;
}

bool sunder_i_tree_init(sunder_i_tree *tree, const sunder_i_task *task)
{
    memset(tree, 0, sizeof *tree);
    const size_t n = task->n, most = tree->capacity = n + MOST_GUESTS;
    tree->task = *task;
    tree->leaf = INFINITY;
    for (int k = 0; k < SUNDER_I_TREE_RAYS; k++) {
        const double angle = 6.283185307179586 * k / SUNDER_I_TREE_RAYS;
        tree->ray[k][0] = cos(angle);
        tree->ray[k][1] = sin(angle);
    }
    tree->body = sunder_i_alloc(most, sizeof *tree->body);
    tree->weight = sunder_i_alloc(most, sizeof *tree->weight);
    tree->anchor = sunder_i_calloc(2 * most, sizeof *tree->anchor);
    tree->mass = sunder_i_alloc(most, sizeof *tree->mass);
    tree->limit = sunder_i_alloc(most, sizeof *tree->limit);
    tree->pair_at = sunder_i_alloc(most * most, sizeof *tree->pair_at);
    if (!sunder_i_dual_init(&tree->program, most, task->prices) || !tree->body || !tree->weight || !tree->anchor ||
        !tree->mass || !tree->limit || !tree->pair_at)
        return false;
    for (size_t k = 0; k < most * most; k++) tree->pair_at[k] = UINT32_MAX;
    for (size_t k = 0; k < n; k++)
        sunder_i_tree_set_body(tree, k, task->body[k],
                               task->weight ? task->weight[k]
                                            : sunder_i_weight_below(task->model, &task->model->body[task->body[k]]));
    if (task->anchor) memcpy(tree->anchor, task->anchor, 2 * n * sizeof *tree->anchor);
    sunder_i_tree_lend_bodies(tree);
    sunder_i_tree_add_springs(tree);
    sunder_i_tree_add_eased(tree);
    if (tree->failed || !load_root(tree)) return false;
    const uint32_t root = sunder_i_tree_add_node(tree, SUNDER_I_NO_NODE, 0);
    if (task->prices && !tree->failed) sunder_i_tree_keep_forces(tree, root);
    const sunder_i_open open = {0, root};
    if (tree->failed || !sunder_i_reserve(&tree->open, &tree->open_capacity, 1, sizeof open)) return false;
    tree->open[tree->opens++] = open;
    return true;
}

void sunder_i_tree_free(sunder_i_tree *tree)
{
    for (size_t k = 0; k < tree->pairs; k++) {
        sunder_i_forbidden_free(&tree->pair[k].forbidden);
        sunder_i_free_all(tree->pair[k].reflex.place, tree->pair[k].sides.place);
    }
    for (size_t k = 0; k < tree->nodes; k++) sunder_i_free(tree->node[k].regions);
    sunder_i_tree_free_eased(tree);
    sunder_i_free_all(tree->body, tree->weight, tree->anchor, tree->mass, tree->limit, tree->pair_at, tree->pair,
                      tree->cut, tree->note, tree->force, tree->node, tree->open, tree->path.item, tree->touched.item,
                      tree->near.item, tree->joins.item, tree->named.item, tree->used, tree->conflict,
                      tree->tried.place, tree->kept, tree->kept_factor, tree->eased, tree->price, tree->priced.item);
    sunder_i_dual_free(&tree->program);
    memset(tree, 0, sizeof *tree);
}

double sunder_i_tree_bound(const sunder_i_tree *tree)
{
    double bound = sunder_i_min(tree->task.goal, tree->leaf);
    if (tree->opens) bound = sunder_i_min(bound, tree->open[0].value);
    return bound;
}

void sunder_i_tree_lower_goal(sunder_i_tree *tree, double goal)
{
    tree->task.goal = sunder_i_min(tree->task.goal, goal);
}

/* Examines one node. Returns true if its minimiser has no conflicts, or none by which dividing proves more; *leaf is
 * the cost that is proved for it. */
static bool examine_node(sunder_i_tree *t, uint32_t node, double *leaf)
{
    sunder_i_tree_load(t, node);
    for (int round = 0; !t->failed; round++) {
        /* Cuts by discs depend on the present forces, so these belong to the parent node. They may prove more than
         * those that were recorded, since loading a node balances them anew. */
        const double dual = sunder_i_dual_value(&t->program), value = sunder_i_max(t->node[node].value, dual);
        if (t->task.keep && dual > t->node[node].value) sunder_i_tree_keep_forces(t, node);
        t->node[node].value = value;
        if (value >= t->task.goal) {
            t->node[node].state = SUNDER_I_CLOSED;
            return false;
        }
        sunder_i_tree_find_conflicts(t);
        if (t->conflicts == 0 && !t->failed && sunder_i_tree_add_chords(t)) sunder_i_tree_find_conflicts(t);
        if (!t->failed) sunder_i_tree_find_lacking(t);
        if (t->conflicts == 0 && !t->failed) sunder_i_tree_find_outside_conflicts(t);
        if (t->failed) return false;
        if (t->conflicts == 0) {
            t->node[node].state = SUNDER_I_LEAF;
            *leaf = value;
            return true;
        }
        if (round == MOST_REFINED) break;
        bool empty;
        const uint32_t child = sunder_i_tree_add_node(t, node, value);
        if (t->failed) return false;
        const size_t made = sunder_i_tree_refine(t, sunder_i_dual_value(&t->program), &empty);
        t->node[node].state = SUNDER_I_REFINED;
        if (empty) {
            t->node[child].state = SUNDER_I_EMPTY;
            return false;
        }
        if (made) t->node[child].value = sunder_i_max(value, sunder_i_tree_solve(t));
        if (t->failed) return false;
        sunder_i_tree_keep_forces(t, child);
        node = child;
        if (!made) break;
    }
    if (t->failed) return false;
    sunder_i_tree_divide(t, node);
    *leaf = t->node[node].value;
    return !t->failed && t->node[node].state == SUNDER_I_LEAF;
}

sunder_i_tree_outcome sunder_i_tree_run(sunder_i_tree *tree, uint64_t steps)
{
    while (tree->opens && !tree->failed) {
        if (tree->open[0].value >= sunder_i_min(tree->task.goal, tree->leaf)) return SUNDER_I_TREE_PROVED;
        if (tree->steps > steps) return SUNDER_I_TREE_SPENT;
        sunder_i_open next;
        sunder_i_heap_pop(tree->open, &tree->opens, sizeof next, &next, sunder_i_opens_first);
        const uint64_t before = tree->steps;
        double leaf = INFINITY;
        const bool found = examine_node(tree, next.node, &leaf);
        if (!sunder_i_steps(1 + (size_t)(tree->steps - before) / 64)) tree->failed = true;
        if (!found) continue;
        tree->leaf = sunder_i_min(tree->leaf, leaf);
        return tree->joins.n ? SUNDER_I_TREE_JOINED : SUNDER_I_TREE_FOUND;
    }
    return SUNDER_I_TREE_PROVED;
}
