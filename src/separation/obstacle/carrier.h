/* carrier.h: the line that contains a segment of the reduced convolution: points on it, and how far convex subsums
 * cover it, all in exact fractions of the line's parameter. */
#ifndef SUNDER_I_CARRIER_H
#define SUNDER_I_CARRIER_H

#include "separation/operands/pair_operands.h"

/* The line through a (t = 0) and b (t = 1); d = b - a. */
typedef struct sunder_i_carrier {
    sunder_i_point a, b, d;
    double ax, ay, dx, dy;
    bool plain; /* a and d are plain numbers */
} sunder_i_carrier;

/* Returns the line through a in direction d. */
sunder_i_carrier sunder_i_carrier_make(sunder_i_operands *operands, sunder_i_point a, sunder_i_point d);

/* Returns the parameter of the foot of the perpendicular from the origin, limited to [0, 1]. */
sunder_i_fraction sunder_i_carrier_foot(sunder_i_operands *operands, const sunder_i_carrier *line);

static inline void sunder_i_carrier_at(const sunder_i_carrier *line, const sunder_i_fraction *t, double *x, double *y)
{
    *x = line->ax + t->value * line->dx;
    *y = line->ay + t->value * line->dy;
}

int sunder_i_carrier_cmp(sunder_i_operands *operands, const sunder_i_fraction *s, const sunder_i_fraction *t);

/* Compares the point at t with side k of the subsum: +1 on its left (inside), 0 on its line, -1 on its right. Exact. */
int sunder_i_carrier_side(sunder_i_operands *operands, const sunder_i_carrier *line, const sunder_i_fraction *t,
                          const sunder_i_subsum *subsum, uint32_t k);

/* Returns the number of a listed subsum whose interior contains the point at t, (x, y) in doubles; -1 if there is none.
 * 0 <= t <= 1. Exact. The subsum *first (NULL: 0) is tested before the others, except on a square of the board that has
 * a holder; *first becomes the number found, if any. -1 also if out of memory (arena.failed). */
long sunder_i_carrier_cover(sunder_i_operands *operands, const sunder_i_carrier *line, const sunder_i_fraction *t,
                            double x, double y, size_t *first);

/* Returns the parameter at which the line, which meets the interior of the subsum, leaves it forwards or backwards. */
sunder_i_fraction sunder_i_carrier_exit(sunder_i_operands *operands, const sunder_i_carrier *line,
                                        const sunder_i_subsum *subsum, bool forwards);

/* Returns the vertex of a subsum farthest on the right of the direction (dx, dy), approximately, since it uses doubles:
 * the beginning of the first side whose angle in [0, 2 pi) is greater than that of the direction. */
uint32_t sunder_i_subsum_lowest(const sunder_i_subsum *subsum, double dx, double dy);

#endif
