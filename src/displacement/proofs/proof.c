/* The record of a branch and bound as a proof of its own: what hangs below one node, in one piece of memory for each
 * array. */
#include "displacement/proofs/branching.h"

#include "base/invariant.h"
#include "shape/shape.h"

#include <string.h>

/* Adds to `sum` the nodes, ways, forces and corners of the subtree at node `at`, which tell the memory it takes. */
static void count(const sunder_i_branching *c, size_t at, sunder_proof *sum)
{
    const sunder_i_node *node = &c->node[at];
    sum->nodes++;
    sum->ways += node->ways;
    sum->forces += node->forces;
    if (node->ways) sum->corners += node->part_a->corners + node->part_b->corners;
    for (size_t k = 0; k < node->ways; k++) count(c, c->way[node->way + k].next, sum);
}

typedef struct copying {
    const sunder_i_branching *branching;
    sunder_proof *proof;
    sunder_proof_node *node;
    sunder_proof_way *way;
    sunder_proof_force *force;
    double *corner;
    size_t path[SUNDER_I_LEVELS + 1];      /* nodes of the record on the way down ... */
    size_t path_copy[SUNDER_I_LEVELS + 1]; /* ... and of the proof */
} copying;

static void copy_corner(copying *g, const double *xy)
{
    memcpy(g->corner + 2 * g->proof->corners++, xy, 2 * sizeof *xy);
}

/* An anchor, or a side: the corners as they are. False if it is a piece of a shape. */
static bool copy_of_shadow(copying *g, const sunder_i_body_piece *piece, uint32_t feature)
{
    const sunder_i_model *model = g->branching->model;
    const bool barrier = sunder_i_is_barrier(model, feature);
    if (!barrier && model->anchor && piece == &model->anchor[feature]) {
        copy_corner(g, model->anchor_at + 2 * (size_t)feature);
        return true;
    }
    if (!barrier && model->side_anchor && piece == &model->side_anchor[feature]) {
        copy_corner(g, model->side_at + 2 * (size_t)feature);
        return true;
    }
    const sunder_i_body *body = &model->body[model->body_of[feature]];
    for (uint32_t k = body->side; barrier && k < body->side + body->sides; k++) {
        const sunder_i_side *side = &model->side[k];
        if (piece != &side->piece) continue;
        copy_corner(g, side->from);
        copy_corner(g, side->to);
        return true;
    }
    return false;
}

static size_t copy_part(copying *g, const sunder_i_body_piece *piece, uint32_t feature)
{
    const sunder_i_model *model = g->branching->model;
    const sunder_shape *shape = model->layer->feature[feature].shape;
    const size_t at = g->proof->corners;
    if (copy_of_shadow(g, piece, feature)) return at;
    /* Pieces of the model are in the order of the shape's; the model's corners are relative to the body. */
    uint32_t p = 0;
    const sunder_i_body_piece *first = piece;
    const sunder_i_body_piece *all = model->piece + model->body[model->body_of[feature]].piece;
    while (first > all && first[-1].feature == feature) first--, p++;
    const uint32_t from = p ? shape->piece_end[p - 1] : 0;
    for (uint32_t k = from; k < shape->piece_end[p]; k++)
        copy_corner(g, shape->xy + 2 * (size_t)shape->piece_vertex[k]);
    return at;
}

static size_t copy(copying *g, size_t at, size_t depth)
{
    const sunder_i_branching *c = g->branching;
    const sunder_i_node *from = &c->node[at];
    sunder_proof *proof = g->proof;
    const size_t number = proof->nodes++;
    sunder_proof_node *to = &g->node[number];
    *to = (sunder_proof_node){.way = proof->ways, .ways = from->ways, .force = proof->forces, .forces = from->forces};
    proof->ways += from->ways;
    proof->forces += from->forces;
    for (size_t k = 0; k < from->forces; k++) {
        const sunder_proof_force *f = &c->force[from->force + k];
        size_t level = 0;
        while (g->path[level] != f->node) level++;
        const sunder_proof_node *above = &g->node[g->path_copy[level]];
        g->force[to->force + k] = (sunder_proof_force){
            g->path_copy[level], above->way + (f->way - c->node[f->node].way), f->behind, f->force};
    }
    if (from->ways == 0) return number;
    to->a = from->a;
    to->b = from->b;
    to->clearance = from->clearance;
    to->shadow = from->shadow;
    to->corners_a = from->part_a->corners;
    to->corners_b = from->part_b->corners;
    to->part_a = copy_part(g, from->part_a, from->a);
    to->part_b = copy_part(g, from->part_b, from->b);
    g->path[depth] = at;
    g->path_copy[depth] = number;
    for (size_t k = 0; k < from->ways; k++) {
        const sunder_i_way *w = &c->way[from->way + k];
        g->way[to->way + k] = (sunder_proof_way){{w->n[0], w->n[1]}, w->d, copy(g, w->next, depth + 1)};
    }
    return number;
}

sunder_proof *sunder_i_proof_of(const sunder_i_branching *c, size_t root)
{
    sunder_proof size = {0};
    count(c, root, &size);
    sunder_proof *proof = sunder_i_calloc(1, sizeof *proof);
    if (!proof) return NULL;
    copying g = {c,
                 proof,
                 sunder_i_alloc(size.nodes, sizeof *g.node),
                 sunder_i_alloc(size.ways, sizeof *g.way),
                 sunder_i_alloc(size.forces, sizeof *g.force),
                 sunder_i_alloc(2 * size.corners, sizeof *g.corner),
                 {0},
                 {0}};
    proof->node = g.node;
    proof->way = g.way;
    proof->force = g.force;
    proof->corner = g.corner;
    if (g.node && g.way && g.force && g.corner) {
        copy(&g, root, 0);
        SUNDER_I_ASSERT(proof->nodes == size.nodes && proof->ways == size.ways && proof->forces == size.forces);
        return proof;
    }
    sunder_i_proof_free(proof);
    return NULL;
}

void sunder_i_proof_free(sunder_proof *proof)
{
    if (!proof) return;
    sunder_i_free((void *)proof->node);
    sunder_i_free((void *)proof->way);
    sunder_i_free((void *)proof->force);
    sunder_i_free((void *)proof->corner);
    sunder_i_free(proof);
}
