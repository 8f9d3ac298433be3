/* The line that carries a segment of the reduced convolution: points on it, and how far convex subsums cover it, all in
 * exact fractions of its own parameter. */
#ifndef SUNDER_I_CARRIER_H
#define SUNDER_I_CARRIER_H

#include "separation/operands/pair_operands.h"

/* From a (t = 0) to b (t = 1); d = b - a. */
typedef struct sunder_i_carrier {
    sunder_i_point a, b, d;
    double ax, ay, dx, dy;
    bool plain; /* a and d are plain numbers */
} sunder_i_carrier;

/* The line through a in direction d. */
sunder_i_carrier sunder_i_carrier_make(sunder_i_operands *operands, sunder_i_point a, sunder_i_point d);

/* The foot of the perpendicular from the origin, clamped to [0, 1]. */
sunder_i_fraction sunder_i_carrier_foot(sunder_i_operands *operands, const sunder_i_carrier *line);

static inline void sunder_i_carrier_at(const sunder_i_carrier *line, const sunder_i_fraction *t, double *x, double *y)
{
    *x = line->ax + t->value * line->dx;
    *y = line->ay + t->value * line->dy;
}

int sunder_i_carrier_cmp(sunder_i_operands *operands, const sunder_i_fraction *s, const sunder_i_fraction *t);

/* Side of the point at t to side k of the subsum: +1 inside. Exact. */
int sunder_i_carrier_side(sunder_i_operands *operands, const sunder_i_carrier *line, const sunder_i_fraction *t,
                          const sunder_i_subsum *subsum, uint32_t k);

/* The number of a listed subsum that has the point at t, which is (x, y) in doubles, in its interior; -1 if there is
 * none. 0 <= t <= 1. Exact. *first (NULL: 0) is where to start, and receives the answer. */
long sunder_i_carrier_cover(sunder_i_operands *operands, const sunder_i_carrier *line, const sunder_i_fraction *t,
                            double x, double y, size_t *first);

/* Where the line leaves the subsum, whose interior it meets, forwards or backwards. */
sunder_i_fraction sunder_i_carrier_exit(sunder_i_operands *operands, const sunder_i_carrier *line,
                                        const sunder_i_subsum *subsum, bool forwards);

/* The corner of a subsum farthest to the right of the direction (dx, dy), in doubles, and so only nearly: the start of
 * the first side whose angle in [0, 2 pi) is above that of the direction. */
uint32_t sunder_i_subsum_lowest(const sunder_i_subsum *subsum, double dx, double dy);

#endif
