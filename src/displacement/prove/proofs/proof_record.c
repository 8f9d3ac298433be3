/* Copies the part of a branch and bound's record below one node to a proof, with one block of memory for each array. */
#include "displacement/prove/proofs/branching.h"

#include "base/invariant.h"

#include <stdlib.h>
#include <string.h>

/* The number of corners of the two sides of a chord. */
enum { CHORD_CORNERS = 4 };

/* Adds to `sum` the nodes, half-planes, forces and corners of the subtree at node `at`, for the memory it takes.
 * *deepest: the depth of its deepest node. */
static void count_subtree(const sunder_i_branching *c, size_t at, size_t depth, sunder_proof *sum, size_t *deepest)
{
    const sunder_i_node *node = &c->node[at];
    sum->nodes++;
    if (depth > *deepest) *deepest = depth;
    sum->ways += node->half_planes;
    sum->forces += node->forces;
    if (node->half_planes && !node->row)
        sum->corners +=
            sunder_i_corners_as_given(c->model, node->part_a) + sunder_i_corners_as_given(c->model, node->part_b);
    if (node->chord != SIZE_MAX) sum->corners += CHORD_CORNERS;
    for (size_t k = 0; k < node->half_planes; k++)
        count_subtree(c, c->half_plane[node->half_plane + k].next, depth + 1, sum, deepest);
}

typedef struct copying {
    const sunder_i_branching *branching;
    sunder_proof *proof;
    sunder_proof_node *node;
    sunder_proof_way *way;
    sunder_proof_force *force;
    double *corner;
    size_t *path;      /* the nodes of the record on the path down */
    size_t *path_copy; /* the same nodes in the proof */
} copying;

static size_t copy_part(copying *g, const sunder_i_body_piece *piece)
{
    const size_t at = g->proof->corners;
    sunder_i_piece_as_given(g->branching->model, piece, g->corner + 2 * at);
    g->proof->corners += sunder_i_corners_as_given(g->branching->model, piece);
    return at;
}

static size_t copy_chord(copying *g, const sunder_i_chord *chord)
{
    const size_t at = g->proof->corners;
    memcpy(g->corner + 2 * at, chord->at, sizeof chord->at);
    g->proof->corners += 2;
    return at;
}

/* Copies both sides of a chord as pairs of end points, and returns their index. */
static size_t copy_sides(copying *g, const sunder_i_chord *chord)
{
    const size_t at = g->proof->corners;
    for (size_t k = 0; k < 2; k++) {
        memcpy(g->corner + 2 * at + 4 * k, chord->side[k]->from, 2 * sizeof *g->corner);
        memcpy(g->corner + 2 * at + 4 * k + 2, chord->side[k]->to, 2 * sizeof *g->corner);
    }
    g->proof->corners += CHORD_CORNERS;
    return at;
}

/* Returns the number in the proof of a node on the path down. */
static size_t copy_of(const copying *g, size_t node)
{
    size_t level = 0;
    while (g->path[level] != node) level++;
    return g->path_copy[level];
}

/* Copies the two parts of a node, and what a chord has besides. */
static void copy_parts(copying *g, const sunder_i_node *from, sunder_proof_node *to)
{
    const sunder_i_branching *c = g->branching;
    to->corners_a = sunder_i_corners_as_given(c->model, from->part_a);
    to->corners_b = sunder_i_corners_as_given(c->model, from->part_b);
    to->part_a = copy_part(g, from->part_a);
    to->part_b = from->chord == SIZE_MAX ? copy_part(g, from->part_b) : copy_chord(g, &c->chord[from->chord]);
    if (from->chord != SIZE_MAX) {
        to->chord = true;
        to->c = c->chord[from->chord].side[1]->piece.feature;
        to->sides = copy_sides(g, &c->chord[from->chord]);
    }
}

static size_t copy_subtree(copying *g, size_t at, size_t depth)
{
    const sunder_i_branching *c = g->branching;
    const sunder_i_node *from = &c->node[at];
    sunder_proof *proof = g->proof;
    const size_t number = proof->nodes++;
    sunder_proof_node *to = &g->node[number];
    *to = (sunder_proof_node){
        .way = proof->ways, .ways = from->half_planes, .force = proof->forces, .forces = from->forces};
    proof->ways += from->half_planes;
    proof->forces += from->forces;
    for (size_t k = 0; k < from->forces; k++) {
        const sunder_proof_force *f = &c->force[from->force + k];
        const size_t above = copy_of(g, f->node);
        g->force[to->force + k] = (sunder_proof_force){
            above, g->node[above].way + (f->way - c->node[f->node].half_plane), f->behind, f->force};
    }
    to->still = from->still;
    for (size_t k = 0; k < 2 && from->still; k++) {
        to->line_node[k] = copy_of(g, from->line_node[k]);
        to->line_way[k] = g->node[to->line_node[k]].way + (from->line_way[k] - c->node[from->line_node[k]].half_plane);
    }
    if (from->half_planes == 0) return number;
    to->a = from->a;
    to->b = from->b;
    to->clearance = from->clearance;
    to->shadow = from->shadow;
    to->slack = from->slack;
    to->held = from->held;
    to->row = from->row;
    g->path[depth] = at;
    g->path_copy[depth] = number;
    if (!from->row) copy_parts(g, from, to);
    for (size_t k = 0; k < from->half_planes; k++) {
        const sunder_i_half_plane *w = &c->half_plane[from->half_plane + k];
        g->way[to->way + k] = (sunder_proof_way){{w->n[0], w->n[1]}, w->d, copy_subtree(g, w->next, depth + 1)};
    }
    return number;
}

sunder_proof *sunder_i_proof_of(const sunder_i_branching *branching, size_t root)
{
    sunder_proof size = {0};
    size_t deepest = 0;
    count_subtree(branching, root, 0, &size, &deepest);
    sunder_proof *proof = sunder_i_calloc(1, sizeof *proof);
    if (!proof) return NULL;
    copying g = {branching,
                 proof,
                 sunder_i_alloc(size.nodes, sizeof *g.node),
                 sunder_i_alloc(size.ways, sizeof *g.way),
                 sunder_i_alloc(size.forces, sizeof *g.force),
                 sunder_i_alloc(2 * size.corners, sizeof *g.corner),
                 sunder_i_alloc(deepest + 1, sizeof *g.path),
                 sunder_i_alloc(deepest + 1, sizeof *g.path_copy)};
    proof->node = g.node;
    proof->way = g.way;
    proof->force = g.force;
    proof->corner = g.corner;
    proof->within = branching->subproblem->instead;
    const bool ok = g.node && g.way && g.force && g.corner && g.path && g.path_copy;
    if (ok) {
        copy_subtree(&g, root, 0);
        SUNDER_I_ASSERT(proof->nodes == size.nodes && proof->ways == size.ways && proof->forces == size.forces);
    }
    sunder_i_free_all(g.path, g.path_copy);
    if (ok) return proof;
    sunder_i_proof_free(proof);
    return NULL;
}

void sunder_i_proof_free(sunder_proof *proof)
{
    if (!proof) return;
    sunder_i_free_all((void *)proof->node, (void *)proof->way, (void *)proof->force, (void *)proof->corner, proof);
}

size_t sunder_i_proof_things(const sunder_i_model *model, const sunder_proof *proof, uint32_t *set)
{
    size_t n = 0;
    for (size_t k = 0; k < proof->nodes; k++) {
        const sunder_proof_node *node = &proof->node[k];
        if (!node->ways) continue;
        set[n++] = sunder_i_whole_of(model, (uint32_t)node->a);
        set[n++] = sunder_i_whole_of(model, (uint32_t)node->b);
        if (node->chord) set[n++] = sunder_i_whole_of(model, (uint32_t)node->c);
    }
    return sunder_i_set_make(set, n);
}

static int by_things(const void *a, const void *b)
{
    const sunder_proof_node *p = a, *q = b;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    if (p->b != q->b) return p->b < q->b ? -1 : 1;
    if (p->chord != q->chord) return p->chord ? 1 : -1;
    return (p->c > q->c) - (p->c < q->c);
}

void sunder_i_proof_strip(sunder_proof *proof)
{
    if (!proof) return;
    sunder_proof_node *node = (sunder_proof_node *)proof->node;
    size_t inner = 0, n = 0;
    for (size_t k = 0; k < proof->nodes; k++)
        if (node[k].ways)
            node[inner++] =
                (sunder_proof_node){.a = node[k].a, .b = node[k].b, .ways = 1, .chord = node[k].chord, .c = node[k].c};
    if (inner) qsort(node, inner, sizeof *node, by_things);
    for (size_t k = 0; k < inner; k++)
        if (k == 0 || by_things(&node[k - 1], &node[k])) node[n++] = node[k];
    sunder_proof_node *less = sunder_i_realloc(node, n, sizeof *node);
    sunder_i_free_all((void *)proof->way, (void *)proof->force, (void *)proof->corner);
    *proof = (sunder_proof){.node = less ? less : node, .nodes = n};
}
