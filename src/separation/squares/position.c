/* position.c: the position of a square relative to the sum of two pieces, in doubles, for what floats leave uncertain
 * (inner_convex.h). */
#include "separation/squares/squares_inner.h"

#include <math.h>

/* Tests the square against the sides of piece i of operand `side`, each translated by the farthest vertex of piece j in
 * its direction. */
static sunder_i_square_position position_to_sides(const sunder_i_operands *g, const double at[4], int side, uint32_t i,
                                                  uint32_t j)
{
    const sunder_i_operand_piece p = sunder_i_operands_piece(g, side, i), q = sunder_i_operands_piece(g, !side, j);
    const double *xy = g->xy[side], *uv = g->xy[!side];
    /* if coordinates are rounded, sides are, too */
    const double e = 128 * g->error, fixed = 32 * g->magnitude * g->coarse;
    const double cx = at[0] / 2 + at[2] / 2, cy = at[1] / 2 + at[3] / 2;
    const double hx = at[2] / 2 - at[0] / 2 + e, hy = at[3] / 2 - at[1] / 2 + e;
    sunder_i_square_position where = SUNDER_I_POSITION_WITHIN;
    for (uint32_t k = 0; k < p.n; k++) {
        const double *a = xy + 2 * (size_t)p.corner[k], *b = xy + 2 * (size_t)sunder_i_piece_next(&p, k);
        const double dx = b[0] - a[0], dy = b[1] - a[1];
        double most = -INFINITY;
        for (uint32_t m = 0; m < q.n; m++) {
            const double *c = uv + 2 * (size_t)q.corner[m];
            const double v = dx * (cy - a[1] - c[1]) - dy * (cx - a[0] - c[0]);
            most = v > most ? v : most;
        }
        const double reach = hx * fabs(dy) + hy * fabs(dx), error = e * (fabs(dx) + fabs(dy)) + fixed;
        if (most + reach < -error) return SUNDER_I_POSITION_OUTSIDE;
        if (most - reach <= error) where = SUNDER_I_POSITION_ACROSS;
    }
    return where;
}

sunder_i_square_position sunder_i_squares_position(const sunder_i_squares *squares, const double square[4], uint32_t i,
                                                   uint32_t j)
{
    const sunder_i_square_position p = position_to_sides(squares->g, square, 0, i, j);
    const sunder_i_square_position r =
        p == SUNDER_I_POSITION_OUTSIDE ? p : position_to_sides(squares->g, square, 1, j, i);
    return p < r ? p : r;
}
