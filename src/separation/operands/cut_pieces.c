/* Pieces with very many corners, as of round outlines, in parts with few: what is asked of two pieces takes their
 * corners times each other, and of the sides of a great one hardly any come near a square.
 *
 * A core with corners evenly spaced along the piece keeps most of it together; what is left beyond each of its sides is
 * a cap, which is cut likewise. The parts are convex and make up the piece, so with them for pieces all that is said of
 * subsums holds as before: it does so for any pieces that make up an operand. */
#include "separation/operands/pair_operands.h"

#include <string.h>

#define MOST 16 /* corners of a part; by measurement on discs and stars */

typedef struct cutting {
    const uint32_t *corner;  /* of the piece */
    uint32_t *end, *vertex;  /* of the parts */
    uint32_t parts, corners; /* so far */
} cutting;

/* Corners first to last of a piece, which is closed by the side back. */
static void cut(cutting *c, uint32_t first, uint32_t last)
{
    const uint32_t span = last - first, n = span < MOST ? span + 1 : MOST;
    for (uint32_t k = 0; k < n; k++) c->vertex[c->corners++] = c->corner[first + (uint64_t)k * span / (n - 1)];
    c->end[c->parts++] = c->corners;
    for (uint32_t k = 0; k + 1 < n; k++) {
        const uint32_t from = first + (uint32_t)((uint64_t)k * span / (n - 1));
        const uint32_t to = first + (uint32_t)((uint64_t)(k + 1) * span / (n - 1));
        if (to - from > 1) cut(c, from, to);
    }
}

/* Each part beyond the core has at least one corner of its own, and two that were there before. */
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
        cut(&c, 0, s->piece_end[i] - first - 1);
    }
    memmove(end + c.parts, c.vertex, c.corners * sizeof *end); /* corners come right behind the ends */
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
