/* Branches: a node is divided where the minimiser of its program has a pair in conflict.
 *
 *           q1 . . . n . . . q2        u lies in the forbidden set. Three rays from u, each two less than a straight
 *             \      |      /          angle apart, divide the plane into cones. n is the nearest exit of the set; q1
 *              \  A  |     /           and q2 are the exits along a line slightly nearer to u. One cone is between
 *               \    |    /            q1 and q2, two are behind. The free part of a cone has a hull that usually
 *             C  `.  |  .'  B          misses u, since u is in the forbidden set: so each child is cut off from u. No
 *                   `u'                free place is lost: the cut of a cone lies a grain behind u, so that the cones
 *                    |                 cover everything.
 *
 * Each of the deepest conflicts is tried, by the bounds that its children would prove. The conflict whose children
 * prove most is taken [strong branching]. Trials use cuts that are not proved; the children prove theirs. */
#include "displacement/prove/optimum/tree.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/extremes.h"
#include "base/heap.h"

#include <math.h>
#include <stdlib.h>

typedef struct branching_rays {
    double ray[3][2];
} branching_rays;

static void choose_rays(sunder_i_tree *t, const sunder_i_tree_conflict *c, branching_rays *out)
{
    const sunder_i_forbidden *f =
        c->eased == SUNDER_I_NOBODY ? &t->pair[c->pair].forbidden : &t->eased[c->eased].pieces;
    double nearest = INFINITY, n[2] = {1, 0};
    for (int k = 0; k < SUNDER_I_TREE_RAYS; k++) {
        const double *dir = t->ray[k];
        const double away = sunder_i_forbidden_exit(f, c->u, dir, nearest);
        if (away >= nearest) continue;
        nearest = away;
        n[0] = dir[0];
        n[1] = dir[1];
    }
    t->steps += SUNDER_I_TREE_RAYS * sunder_i_forbidden_look(f);
    const double ahead = (1 - NEARER) * nearest, mid[2] = {c->u[0] + ahead * n[0], c->u[1] + ahead * n[1]};
    for (int k = 0; k < 2; k++) {
        const double side = k ? 1 : -1, dir[2] = {-side * n[1], side * n[0]};
        /* At most 84 degrees, so that the angle to the ray behind is less than straight. */
        double away = sunder_i_min(sunder_i_forbidden_exit(f, mid, dir, 10 * ahead), 10 * ahead);
        /* In a slot without width there are exits beside u as well as ahead. A ray along the slot would leave the slot
         * to both of its cones, and one of these would have u in its hull. */
        if (away < IN_SLOT * ahead) away = BESIDE_SLOT * ahead;
        const double x = ahead * n[0] + away * dir[0], y = ahead * n[1] + away * dir[1], length = sqrt(x * x + y * y);
        out->ray[k][0] = length > 0 ? x / length : n[0];
        out->ray[k][1] = length > 0 ? y / length : n[1];
    }
    out->ray[2][0] = -n[0];
    out->ray[2][1] = -n[1];
}

/* Sets n and d to the two cuts n.u >= d that bound cone k: to the left of ray k, and to the right of the next ray; each
 * a grain behind the conflict's u. */
static void cone_cuts(const sunder_i_tree *t, const sunder_i_tree_conflict *c, const branching_rays *b, int k,
                      double n[2][2], double d[2])
{
    const double *r = b->ray[k], *s = b->ray[(k + 1) % 3], grain = t->pair[c->pair].forbidden.grain;
    n[0][0] = -r[1];
    n[0][1] = r[0];
    n[1][0] = s[1];
    n[1][1] = -s[0];
    for (int e = 0; e < 2; e++) d[e] = n[e][0] * c->u[0] + n[e][1] * c->u[1] - grain;
}

/* Returns the share of the missing bound, goal less `value`, that the child in cone k would prove: 1 if nothing in the
 * cone is free, 0 if no cut separates u from what is free there. */
static double try_cone(sunder_i_tree *t, const sunder_i_tree_conflict *c, const branching_rays *b, int k, double value)
{
    const double grain = t->pair[c->pair].forbidden.grain;
    double n[2][2], d[2], m[2], e;
    bool none;
    cone_cuts(t, c, b, k, n, d);
    sunder_i_slope slope;
    sunder_i_region region = *sunder_i_tree_region(t, c->pair);
    for (int x = 0; x < 2; x++) sunder_i_region_clip(&region, n[x], d[x], SUNDER_I_NO_CUT, grain);
    if (region.n == 0) return 1;
    const bool price = c->eased != SUNDER_I_NOBODY && sunder_i_tree_propose_price(t, c->eased, &region, c->u, &slope);
    if (!price && !sunder_i_tree_propose(t, c->pair, &region, c->u, m, &e, &none)) return none ? 1 : 0;
    /* This cut is for the trial alone, and is removed below. */
    const sunder_i_region before = *sunder_i_tree_region(t, c->pair);
    const size_t cuts = t->cuts, priced = t->priced.n;
    const uint32_t own = t->nodes ? t->node[t->nodes - 1].cuts : 0;
    if (price)
        sunder_i_tree_add_price_cut(t, c->eased, &slope);
    else
        sunder_i_tree_cut(t, SUNDER_I_CUT_HULL, c->pair, m, e);
    if (t->failed) return 0;
    const double then = sunder_i_tree_solve(t);
    t->cuts = cuts;
    t->node[t->nodes - 1].cuts = own;
    *sunder_i_tree_region(t, c->pair) = before;
    t->priced.n = priced;
    sunder_i_tree_restore_program(t);
    return sunder_i_min(1, sunder_i_max(0, (then - value) / (t->task.goal - value)));
}

static int by_weight(const void *a, const void *b)
{
    const sunder_i_tree_conflict *p = a, *q = b;
    if (p->depth != q->depth) return p->depth > q->depth ? -1 : 1;
    return p->pair < q->pair ? -1 : p->pair > q->pair;
}

/* Chooses the conflict to divide by, and its rays. */
static sunder_i_tree_conflict choose_conflict(sunder_i_tree *t, double value, branching_rays *rays)
{
    for (size_t k = 0; k < t->conflicts; k++) t->conflict[k].depth /= sqrt(t->pair[t->conflict[k].pair].slackness);
    qsort(t->conflict, t->conflicts, sizeof *t->conflict, by_weight);
    const size_t n = t->conflicts < TRIED ? t->conflicts : TRIED;
    sunder_i_tree_conflict best = t->conflict[0];
    double least = INFINITY;
    sunder_i_tree_keep_program(t);
    for (size_t k = 0; k < n && !t->failed; k++) {
        branching_rays b;
        double left = 0;
        choose_rays(t, &t->conflict[k], &b);
        for (int e = 0; e < 3 && !t->failed && left < least; e++) {
            const double rest = 1 - (n > 1 ? try_cone(t, &t->conflict[k], &b, e, value) : 0);
            left += rest * rest * rest;
        }
        if (left >= least) continue;
        least = left;
        best = t->conflict[k];
        *rays = b;
    }
    return best;
}

/* Is the conflict that divided the node still at the same place in a child without a cut? Then it must not be used
 * again, as it would be divided by the same rays forever. */
static bool is_stuck(const sunder_i_tree *t, const sunder_i_tree_conflict *c)
{
    const sunder_i_tree_pair *p = &t->pair[c->pair];
    const double *at = t->program.t, x = at[2 * p->j] - at[2 * p->i], y = at[2 * p->j + 1] - at[2 * p->i + 1];
    return fabs(x - c->u[0]) + fabs(y - c->u[1]) <= STUCK * p->forbidden.grain;
}

/* Removes the conflicts by which nodes above were divided without moving them, if the bound has not grown since. */
static void leave_out_stuck(sunder_i_tree *t, uint32_t node)
{
    const double least = t->node[node].value * (1 - HOLDS);
    for (uint32_t at = node; t->node[at].parent != SUNDER_I_NO_NODE; at = t->node[at].parent) {
        const uint32_t parent = t->node[at].parent;
        size_t kept = 0;
        if (t->node[parent].value < least) return;
        for (size_t k = 0; k < t->conflicts; k++)
            if (!t->node[at].stuck || t->conflict[k].pair != t->node[parent].pair) t->conflict[kept++] = t->conflict[k];
        t->conflicts = kept;
    }
}

void sunder_i_tree_divide(sunder_i_tree *tree, uint32_t node)
{
    const double value = tree->node[node].value;
    branching_rays rays = {0};
    leave_out_stuck(tree, node);
    if (tree->conflicts == 0) sunder_i_tree_find_outside_conflicts(tree);
    if (tree->conflicts == 0 || tree->failed) {
        tree->node[node].state = SUNDER_I_LEAF;
        return;
    }
    const sunder_i_tree_conflict c = choose_conflict(tree, value, &rays);
    if (tree->failed) return;
    tree->node[node].state = SUNDER_I_DIVIDED;
    tree->node[node].pair = c.pair;
    const sunder_i_region region = *sunder_i_tree_region(tree, c.pair);
    const size_t priced = tree->priced.n;
    for (int k = 0; k < 3 && !tree->failed; k++) {
        double n[2][2], d[2];
        bool empty = false;
        const uint32_t child = sunder_i_tree_add_node(tree, node, value);
        if (tree->failed) return;
        cone_cuts(tree, &c, &rays, k, n, d);
        for (int e = 0; e < 2 && !tree->failed; e++) sunder_i_tree_cut(tree, SUNDER_I_CUT_CONE, c.pair, n[e], d[e]);
        bool cut = !tree->failed && sunder_i_tree_cut_hull(tree, c.pair, c.u, &empty);
        if (c.eased != SUNDER_I_NOBODY && !empty && !tree->failed)
            cut = sunder_i_tree_cut_price(tree, c.eased, c.u) || cut;
        if (tree->failed) return;
        if (empty) {
            tree->node[child].state = SUNDER_I_EMPTY;
        } else {
            tree->node[child].value = sunder_i_max(value, sunder_i_tree_solve(tree));
            sunder_i_tree_keep_forces(tree, child);
            tree->node[child].stuck = !cut && is_stuck(tree, &c);
            if (tree->node[child].value >= tree->task.goal) tree->node[child].state = SUNDER_I_CLOSED;
        }
        if (tree->node[child].state == SUNDER_I_OPEN) {
            const sunder_i_open open = {tree->node[child].value, child};
            if (!sunder_i_reserve(&tree->open, &tree->open_capacity, tree->opens + 1, sizeof *tree->open))
                tree->failed = true;
            else
                sunder_i_heap_push(tree->open, &tree->opens, sizeof *tree->open, &open, sunder_i_opens_first);
            sunder_i_tree_keep_regions(tree, child);
        }
        *sunder_i_tree_region(tree, c.pair) = region;
        tree->priced.n = priced;
        sunder_i_tree_restore_program(tree);
    }
}
