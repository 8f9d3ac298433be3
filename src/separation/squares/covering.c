/* covering.c: tests whether something covers a square completely: a box inside P and one inside -Q whose sum, a box,
 * contains the square in its interior, so that any translation from the square makes the operands overlap; or a subsum.
 *
 * If the operands overlap deeply, few large boxes cover large squares. Spikes have no boxes inside, but the sum of two
 * crossing spikes is a parallelogram that covers many squares. Among millions of pairs such a sum is found in the two
 * trees of convex sets, the most promising nodes first: the sum of their chiefs (inner_convex.h) is tested, and bounds
 * how deep the square can be in any sum below the nodes. If this does not succeed soon, many sums nearly cover the
 * square, and its quarters are tested instead; the pairs near it are then not listed.
 *
 * All is in doubles or floats and one-sided: "covered" is certain, and a pair that is not listed is farther away than
 * the error. */
#include "separation/squares/squares_inner.h"

#include "base/heap.h"
#include "base/watch.h"
#include "separation/squares/tuning.h"

#include <math.h>
#include <string.h>

/* ---- Boxes ---- */

/* Tests the nodes a and b of the two quadtrees, with their boxes. If the sum of two boxes does not cover the square,
 * the sums of their parts do not either. */
static bool boxes_cover(sunder_i_squares *q, const double at[4], int32_t a, const double abox[4], int32_t b,
                        const double bbox[4])
{
    const double e = 8 * q->g->error;
    for (int k = 0; k < 2; k++)
        if (at[k] - e <= abox[k] + bbox[k] || at[k + 2] + e >= abox[k + 2] + bbox[k + 2]) return false;
    const int32_t u = q->quadtree[0].child[a], v = q->quadtree[1].child[b];
    if (u == SUNDER_I_QUADTREE_REST || v == SUNDER_I_QUADTREE_REST) return false;
    if (u == SUNDER_I_QUADTREE_FULL && v == SUNDER_I_QUADTREE_FULL) return true;
    if (++q->tries > MOST_BOX_PAIRS) return false;
    const bool of_p =
        v == SUNDER_I_QUADTREE_FULL || (u != SUNDER_I_QUADTREE_FULL && abox[2] - abox[0] >= bbox[2] - bbox[0]);
    for (int k = 0; k < 4; k++) {
        double part[4];
        sunder_i_quadtree_quarter(of_p ? abox : bbox, k, part);
        if (of_p ? boxes_cover(q, at, u + k, part, b, bbox) : boxes_cover(q, at, a, abox, v + k, part)) return true;
    }
    return false;
}

bool sunder_i_squares_boxes_cover(sunder_i_squares *squares, const double square[4])
{
    squares->tries = 0;
    return boxes_cover(squares, square, 0, squares->quadtree[0].box, 0, squares->quadtree[1].box);
}

/* ---- Sums of convex sets ---- */

/* A sum grown by a disc of radius g covers a square if the sum covers the square shrunk by g / sqrt(2) on each side;
 * the factor is somewhat smaller, for rounding. */
#define SQUARE_IN_DISC 0.70

void sunder_i_squares_query(sunder_i_squares *squares, const double square[4], double less[4])
{
    const double by = SQUARE_IN_DISC * squares->gap;
    for (int k = 0; k < 4; k++) less[k] = k < 2 ? square[k] + by : square[k] - by;
    squares->query = sunder_i_inner_convex_query(squares->g, less);
    squares->at = less;
}

/* Returns whether the sum of the chiefs of two nodes covers the square; *in becomes its depth. The pair with the
 * greatest depth is kept in q->best. */
static bool sum_covers(sunder_i_squares *q, const uint32_t node[2], float *in)
{
    const uint32_t i = q->inner[0].node[node[0]].chief, j = q->inner[1].node[node[1]].chief;
    *in = sunder_i_inner_convex_depth(q->inner, i, j, &q->query).in;
    if (*in > q->best_depth) {
        q->best_depth = *in;
        memcpy(q->best, node, sizeof q->best);
    }
    if (fabsf(*in) > SUNDER_I_INNER_CONVEX_ERROR) return *in > 0;
    const bool pieces = i < q->g->shape[0]->pieces && j < q->g->shape[1]->pieces;
    return pieces && q->query.hx > 0 && sunder_i_squares_position(q, q->at, i, j) == SUNDER_I_POSITION_WITHIN;
}

static bool key_before(const void *a, const void *b)
{
    return ((const sunder_i_node_pair *)a)->key > ((const sunder_i_node_pair *)b)->key;
}

static bool push_node(sunder_i_squares *q, sunder_i_node_pair v)
{
    if (!sunder_i_reserve(&q->node, &q->nodes_capacity, q->nodes + 1, sizeof *q->node)) return false;
    /* there are no nodes below */
    if (v.node[0] >= q->inner[0].all.leaves && v.node[1] >= q->inner[1].all.leaves) return true;
    sunder_i_heap_push(q->node, &q->nodes, sizeof v, &v, key_before);
    return true;
}

/* Replaces the node whose sets extend farther beyond its chief by its children. These are tested by their chiefs, and
 * discarded if none of their sums can cover the square. */
static sunder_i_covering open_pair(sunder_i_squares *q, const sunder_i_node_pair *v)
{
    const sunder_i_inner_convex *b = q->inner;
    const float reach[2] = {b[0].node[v->node[0]].reach, b[1].node[v->node[1]].reach};
    const int side = v->node[0] >= b[0].all.leaves || (v->node[1] < b[1].all.leaves && reach[1] > reach[0]);
    const uint32_t chief = b[side].node[v->node[side]].chief;
    for (uint32_t k = 0; k < 2; k++) {
        sunder_i_node_pair part = *v;
        part.node[side] = 2 * v->node[side] + k;
        const sunder_i_dop *extent[2] = {b[0].all.extent + part.node[0], b[1].all.extent + part.node[1]};
        const float depth = sunder_i_dop_depth(extent[0], extent[1], &q->dop);
        if (!(depth > 0)) continue;
        if (b[side].node[part.node[side]].chief != chief) {
            if (q->tries == 0) return SUNDER_I_COVERING_UNDECIDED;
            q->tries--;
            if (sum_covers(q, part.node, &part.in)) return SUNDER_I_COVERING_FOUND;
        }
        const float out = b[0].node[part.node[0]].reach + b[1].node[part.node[1]].reach;
        if (part.in + out <= 0) continue;
        part.key = part.in + EXTENTS_COUNT * depth;
        if (!push_node(q, part)) return SUNDER_I_COVERING_NO_MEMORY;
    }
    return SUNDER_I_COVERING_NONE;
}

/* Returns the pair of nodes that covered the previous square near this one, or the roots. */
static uint32_t *remembered_pair(sunder_i_squares *q)
{
    const float per_unit = SUNDER_I_SQUARES_MEMORY / (2 * q->reach);
    const int x = (int)((q->query.x + q->reach) * per_unit), y = (int)((q->query.y + q->reach) * per_unit);
    const int most = SUNDER_I_SQUARES_MEMORY - 1;
    return q->memory[(y < 0 ? 0 : y > most ? most : y) * SUNDER_I_SQUARES_MEMORY + (x < 0 ? 0 : x > most ? most : x)];
}

static sunder_i_covering search_nodes(sunder_i_squares *q, const uint32_t first[2])
{
    sunder_i_node_pair near = {.node = {first[0], first[1]}}, all = {.node = {1, 1}};
    q->nodes = 0;
    if (sum_covers(q, first, &near.in) || sum_covers(q, remembered_pair(q), &all.in) ||
        sum_covers(q, all.node, &all.in))
        return SUNDER_I_COVERING_FOUND;
    for (int k = 0; k < 2; k++) near.node[k] = q->best[k] >> LEVELS_UP ? q->best[k] >> LEVELS_UP : 1;
    if ((near.node[0] > 1 || near.node[1] > 1) && sum_covers(q, near.node, &near.in)) return SUNDER_I_COVERING_FOUND;
    near.key = near.in;
    all.key = all.in;
    if ((near.node[0] > 1 || near.node[1] > 1) && !push_node(q, near)) return SUNDER_I_COVERING_NO_MEMORY;
    if (!push_node(q, all)) return SUNDER_I_COVERING_NO_MEMORY;
    while (q->nodes) {
        sunder_i_node_pair top;
        sunder_i_heap_pop(q->node, &q->nodes, sizeof top, &top, key_before);
        const sunder_i_covering how = open_pair(q, &top);
        if (how != SUNDER_I_COVERING_NONE) return how;
        if (!sunder_i_step()) return SUNDER_I_COVERING_NO_MEMORY;
    }
    return SUNDER_I_COVERING_NONE;
}

sunder_i_covering sunder_i_squares_one_covers(sunder_i_squares *squares, const double square[4],
                                              const uint32_t first[2], uint32_t tries)
{
    double less[4];
    sunder_i_squares_query(squares, square, less);
    squares->dop = sunder_i_dop_query(squares->g, less, 0);
    squares->tries = tries;
    squares->best_depth = -INFINITY;
    squares->best[0] = squares->best[1] = 1;
    const sunder_i_covering how = search_nodes(squares, first);
    squares->covered = how == SUNDER_I_COVERING_FOUND;
    if (!squares->covered) return how;
    memcpy(remembered_pair(squares), squares->best, sizeof squares->best);
    for (int k = 0; k < 2; k++) squares->covering[k] = squares->inner[k].node[squares->best[k]].chief;
    return how;
}
