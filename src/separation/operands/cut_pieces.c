/* cut_pieces.c: divides pieces with very many vertices, such as those of round outlines, into parts with few: the cost
 * of a test of two pieces is the product of their numbers of vertices, and hardly any side of a large piece is near a
 * given square.
 *
 * A core with vertices evenly spaced along the piece contains most of it; the remainder beyond each side of the core is
 * divided in the same way. The parts are convex and their union is the piece, so that everything about subsums holds
 * with the parts as pieces: it holds for any pieces whose union is the operand. */
#include "separation/operands/pair_operands.h"

#include <string.h>

#define MOST 16 /* the most vertices of a part; measured on discs and stars */

typedef struct cutting {
    const uint32_t *corner;  /* the vertices of the piece */
    uint32_t *end, *vertex;  /* the ends of the parts, and their vertices */
    uint32_t parts, corners; /* the numbers of parts and of their vertices so far */
} cutting;

/* Divides the polygon of the vertices first to last of a piece. */
static void cut_piece(cutting *c, uint32_t first, uint32_t last)
{
    const uint32_t span = last - first, n = span < MOST ? span + 1 : MOST;
    for (uint32_t k = 0; k < n; k++) c->vertex[c->corners++] = c->corner[first + (uint64_t)k * span / (n - 1)];
    c->end[c->parts++] = c->corners;
    for (uint32_t k = 0; k + 1 < n; k++) {
        const uint32_t from = first + (uint32_t)((uint64_t)k * span / (n - 1));
        const uint32_t to = first + (uint32_t)((uint64_t)(k + 1) * span / (n - 1));
        if (to - from > 1) cut_piece(c, from, to);
    }
}

/* Divides the pieces of one operand; returns false if out of memory. Each part beyond a core has at least one new
 * vertex, and two that other parts have, too, which bounds the memory. */
static bool cut_operand(sunder_i_operands *g, int side)
{
    const sunder_shape *s = g->shape[side];
    sunder_i_arena *arena = &g->placed.lattice.arena;
    const size_t corners = s->piece_end[s->pieces - 1], most = s->pieces + corners;
    sunder_shape *out = sunder_i_arena_alloc(arena, 1, sizeof *out);
    uint32_t *end = sunder_i_arena_alloc(arena, most + 3 * corners, sizeof *end);
    if (!end) return false;
    *out = *s;
    out->piece_end = end;
    cutting c = {.end = end, .vertex = end + most};
    for (uint32_t i = 0, first = 0; i < s->pieces; first = s->piece_end[i++]) {
        if (!sunder_i_steps(s->piece_end[i] - first)) return false;
        c.corner = sunder_i_piece_vertices(s) + first;
        cut_piece(&c, 0, s->piece_end[i] - first - 1);
    }
    memmove(end + c.parts, c.vertex, c.corners * sizeof *end); /* the vertices follow directly after the ends */
    out->pieces = c.parts;
    g->shape[side] = out;
    g->piece_box[side] = sunder_i_arena_alloc(arena, 4 * (size_t)out->pieces, sizeof(double));
    g->turned[side] = sunder_i_arena_alloc(arena, out->pieces, sizeof *g->turned[side]);
    if (!g->turned[side]) return false;
    sunder_i_operands_fill_boxes(g, side);
    return true;
}

bool sunder_i_operands_cut(sunder_i_operands *operands) { return cut_operand(operands, 0) && cut_operand(operands, 1); }

void sunder_i_operands_uncut(sunder_i_operands *operands, const sunder_i_operands *before)
{
    for (int k = 0; k < 2; k++) {
        operands->shape[k] = before->shape[k];
        operands->piece_box[k] = before->piece_box[k];
        operands->turned[k] = before->turned[k];
    }
}

static uint64_t parts_of(const sunder_shape *s)
{
    uint64_t parts = 0;
    for (uint32_t i = 0, first = 0; i < s->pieces; first = s->piece_end[i++])
        parts += 1 + (s->piece_end[i] - first) / (MOST + 1);
    return parts;
}

uint64_t sunder_i_operands_parts(const sunder_i_operands *operands)
{
    return parts_of(operands->shape[0]) * parts_of(operands->shape[1]);
}
