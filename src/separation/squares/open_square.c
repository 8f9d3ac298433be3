/* open_square.c: the subsums of an open square, and the segments of the reduced convolution near it. */
#include "separation/squares/squares_inner.h"

#include "base/extremes.h"

enum { UNKNOWN = 0, NO_CORNER, CORNER };

static const sunder_i_cone *corner_of(sunder_i_squares *q, int side, uint32_t v)
{
    if (q->state[side][v] == UNKNOWN)
        q->state[side][v] = sunder_i_cone_of(q->g, side, v, &q->corner[side][v]) ? CORNER : NO_CORNER;
    return q->state[side][v] == CORNER ? &q->corner[side][v] : NULL;
}

/* Returns whether the box of the segment from (x, y) to (x + dx, y + dy) is within e of square `at`. */
static bool comes_near(const double at[4], double e, double x, double y, double dx, double dy)
{
    return sunder_i_min(x, x + dx) <= at[2] + e && sunder_i_max(x, x + dx) >= at[0] - e &&
           sunder_i_min(y, y + dy) <= at[3] + e && sunder_i_max(y, y + dy) >= at[1] - e;
}

/* Adds the edge from vertex u of operand `side` at the vertices of piece j of the other operand; a vertex of several
 * pieces counts with the first of them only. The tests are those of pair_convolution.c. */
static bool add_edge(sunder_i_squares *q, const double at[4], double reach, int side, uint32_t u, uint32_t j,
                     sunder_i_candidates *out)
{
    sunder_i_operands *g = q->g;
    const sunder_shape *s = g->shape[side];
    const sunder_i_operand_piece o = sunder_i_operands_piece(g, !side, j);
    const double *a = g->xy[side] + 2 * (size_t)u, *b = g->xy[side] + 2 * (size_t)s->form->cleaned.next[u];
    const double dx = b[0] - a[0], dy = b[1] - a[1], inverse = 1 / (dx * dx + dy * dy);
    const sunder_i_direction direction = sunder_i_direction_of(g, dx, dy);
    for (uint32_t k = 0; k < o.n; k++) {
        const uint32_t v = o.corner[k];
        const double *c = g->xy[!side] + 2 * (size_t)v;
        if (q->first_piece[!side][v] != j || !comes_near(at, 32 * g->error, a[0] + c[0], a[1] + c[1], dx, dy)) continue;
        const sunder_i_cone *w = corner_of(q, !side, v);
        if (!w || !sunder_i_cone_meets(*w, direction)) continue;
        const double norm = sunder_i_segment_square(a[0] + c[0], a[1] + c[1], dx, dy, inverse);
        if (norm > reach * reach) continue;
        if (!sunder_i_candidates_push(g, out, (sunder_i_candidate){norm, u, v, side})) return false;
    }
    return true;
}

/* Adds the boundary edges of piece i. A boundary edge is a side of one piece only, so that nothing is added twice. */
static bool add_edges(sunder_i_squares *q, const double at[4], double reach, int side, uint32_t i, uint32_t j,
                      sunder_i_candidates *out)
{
    const sunder_i_operand_piece p = sunder_i_operands_piece(q->g, side, i);
    for (uint32_t k = 0; k < p.n; k++) {
        const uint32_t u = p.corner[k], v = sunder_i_piece_next(&p, k);
        if (sunder_i_is_boundary(q->g->shape[side], u, v) && !add_edge(q, at, reach, side, u, j, out)) return false;
    }
    return true;
}

bool sunder_i_squares_take_subsums(sunder_i_squares *squares)
{
    sunder_i_operands *g = squares->g;
    g->subsum = sunder_i_arena_alloc(&g->placed.lattice.arena, squares->pairs + 1, sizeof *g->subsum);
    g->subsums = g->subsum ? squares->pairs : 0;
    for (size_t k = 0; k < g->subsums; k++) {
        sunder_i_subsum *s = g->subsum + k;
        *s = (sunder_i_subsum){.i = squares->pair[k][0], .j = squares->pair[k][1]};
        sunder_i_box_sum(g->piece_box[0] + 4 * (size_t)s->i, g->piece_box[1] + 4 * (size_t)s->j, s->box);
    }
    return g->subsum != NULL;
}

bool sunder_i_squares_take_candidates(sunder_i_squares *squares, const double square[4], double limit,
                                      sunder_i_candidates *out)
{
    const double reach = limit + 8 * squares->g->error;
    *out = (sunder_i_candidates){NULL, 0, 0};
    for (size_t k = 0; k < squares->pairs; k++) {
        const uint32_t i = squares->pair[k][0], j = squares->pair[k][1];
        if (!add_edges(squares, square, reach, 0, i, j, out) || !add_edges(squares, square, reach, 1, j, i, out))
            return false;
    }
    sunder_i_candidates_order(out);
    return true;
}
