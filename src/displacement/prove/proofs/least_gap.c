/* For which smaller gaps does a proof that there is no solution still hold?
 *
 * Let C be the convex set A - B of a node, and K what is behind all of its half-planes: K lies in C grown by a disc of
 * the clearance r. Move all its lines n.u = d inwards by e |n|, e <= r. What is behind them is a K' such that K' grown
 * by a disc of radius e lies in K, and so in C grown by r - e and by e. If one set lies in a convex set after both are
 * grown alike, it does so before: K' lies in C grown by r - e. So the proof holds for a gap that is smaller by e if the
 * half-planes of all nodes that have to keep the gap are n.u >= d - e |n| and each leaf remains a contradiction: the
 * sum of its forces falls by a multiple of e, and the loss by limits stays the same.
 *
 * It is computed in doubles. What rounding adds is covered by a share of the gap. */
#include "displacement/prove/proofs/branching.h"

#include "base/extremes.h"
#include "base/memory.h"

#include <math.h>

/* Far above the rounding of a sum of some hundred forces that stand for moves of some gaps. */
#define ROUNDED 0x1p-30

typedef struct shrinking {
    const sunder_i_subproblem *subproblem;
    const sunder_i_model *model;
    const sunder_proof *proof;
    double *net; /* [2 * bodies] all zero between leaves */
} shrinking;

static double owed_distance(const shrinking *g, const sunder_proof_node *node)
{
    return sunder_i_branching_owed(g->subproblem, (uint32_t)node->a, (uint32_t)node->b);
}

/* Does the node's pair have to keep the layer's gap, or at most that much less in its row? Reduced requirements of
 * listed pairs, and gaps of barriers of their own, do not change. */
static bool owes_gap(const shrinking *g, const sunder_proof_node *node)
{
    return node->row || (!node->shadow && node->clearance >= owed_distance(g, node) &&
                         sunder_i_owe_gap(g->model, (uint32_t)node->a, (uint32_t)node->b));
}

static double limit_of(const shrinking *g, uint32_t body)
{
    const sunder_i_body *b = &g->model->body[body];
    if (b->fixed) return 0;
    return isfinite(b->limit) ? b->limit : g->proof->within;
}

/* Returns what the limit of the body of `thing` takes from the contradiction of a leaf: the limit times the length
 * of the net force on the body. Resets that net force, so that a body is counted once. */
static double take_lost(shrinking *g, size_t thing)
{
    const uint32_t body = g->model->body_of[thing];
    double *net = g->net + 2 * (size_t)body;
    const double limit = limit_of(g, body), lost = limit > 0 ? limit * hypot(net[0], net[1]) : 0;
    net[0] = net[1] = 0;
    return lost;
}

/* Returns by how much the gap may be reduced so that the leaf remains a contradiction. */
static double shrink_leaf(shrinking *g, const sunder_proof_node *leaf)
{
    const sunder_proof_force *force = g->proof->force + leaf->force;
    double won = 0, falls = 0;
    for (size_t k = 0; k < leaf->forces; k++) {
        const sunder_proof_way *way = &g->proof->way[force[k].way];
        const sunder_proof_node *node = &g->proof->node[force[k].node];
        const double f = force[k].behind ? -force[k].force : force[k].force;
        double *p = g->net + 2 * (size_t)g->model->body_of[node->a],
               *q = g->net + 2 * (size_t)g->model->body_of[node->b];
        won += f * way->d;
        if (owes_gap(g, node)) falls += f * hypot(way->n[0], way->n[1]);
        for (size_t x = 0; x < 2; x++) {
            p[x] -= f * way->n[x];
            q[x] += f * way->n[x];
        }
    }
    for (size_t k = 0; k < leaf->forces; k++)
        won -= take_lost(g, g->proof->node[force[k].node].a) + take_lost(g, g->proof->node[force[k].node].b);
    return falls > 0 ? sunder_i_max(won, 0) / falls : INFINITY;
}

/* Returns by how much the gap may be reduced because of a node: the required distance may not fall below the
 * requirement of a listed pair. */
static double shrink_owed(const shrinking *g, const sunder_proof_node *node)
{
    const double all = owed_distance(g, node);
    return node->clearance < all ? all - sunder_i_max(0, node->clearance) : INFINITY;
}

sunder_status sunder_i_proof_least_gap(const sunder_i_subproblem *subproblem, const sunder_proof *proof, double *gap,
                                       sunder_error *err)
{
    const sunder_i_model *model = subproblem->model;
    const double of = model->rules.gap - subproblem->less;
    shrinking g = {subproblem, model, proof, sunder_i_calloc(2 * model->bodies, sizeof *g.net)};
    if (!g.net) return sunder_i_failure_cause(err);
    double less = of;
    for (size_t k = 0; k < proof->nodes; k++) {
        const sunder_proof_node *node = &proof->node[k];
        if (node->ways && !node->shadow && !node->row) less = sunder_i_min(less, shrink_owed(&g, node));
        if (node->slack || node->still)
            less = 0;
        else if (node->ways == 0)
            less = sunder_i_min(less, shrink_leaf(&g, node));
    }
    *gap = of - sunder_i_max(less - of * ROUNDED, 0);
    sunder_i_free(g.net);
    return SUNDER_OK;
}
