/* The nearest point to the origin that no listed subsum covers. */
#ifndef SUNDER_I_PENETRATION_SEARCH_H
#define SUNDER_I_PENETRATION_SEARCH_H

#include "separation/obstacle/carrier.h"

/* A point of the plane of translations: at t on a line of the convolution. */
typedef struct sunder_i_free_point {
    bool found;
    bool origin; /* the origin itself is free, and so the answer */
    sunder_i_carrier line;
    sunder_i_fraction t;
    double x, y, distance; /* within operands->error */
} sunder_i_free_point;

/* limit: in units; what is certainly farther is not looked for (found is false if there is nothing nearer). The
 * operands have Q reflected. Fails only with SUNDER_ENOMEM. */
sunder_status sunder_i_nearest_free_point(sunder_i_operands *operands, double limit, sunder_i_free_point *out,
                                          sunder_error *err);

/* The same square by square (squares.h), which the function above does where there are many pairs of pieces. Not *done:
 * too many squares, or a wide lattice; *out says nothing then. */
sunder_status sunder_i_nearest_by_squares(sunder_i_operands *operands, double limit, bool *done,
                                          sunder_i_free_point *out, sunder_error *err);

/* The numbers of listed subsums, made, that a point may be in, on or very near to: of all others it is off by more than
 * what doubles get wrong of it twice. */
typedef struct sunder_i_near_subsums {
    uint32_t *subsum;
    size_t n;
} sunder_i_near_subsums;

/* How the placement touches, for a point that the search found; and what is near it. Memory: the lattice's arena. */
sunder_contact sunder_i_free_point_contact(sunder_i_operands *operands, const sunder_i_free_point *nearest,
                                           sunder_i_near_subsums *near);

/* Is the translation by the doubles (dx, dy), nearest to that point, covered by no listed subsum? Exact. The listed
 * ones reach that far. */
bool sunder_i_doubles_free(sunder_i_operands *operands, const sunder_i_free_point *nearest,
                           const sunder_i_near_subsums *near, double dx, double dy);

/* The pieces of P and of Q + x, x the point found, have disjoint interiors: asked again of every pair of pieces by
 * separating sides, without the subsums. Exact. */
bool sunder_i_free_point_verify(sunder_i_operands *operands, const sunder_i_free_point *nearest);

#endif
