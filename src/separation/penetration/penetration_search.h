/* penetration_search.h: the point nearest to the origin that no listed subsum covers. */
#ifndef SUNDER_I_PENETRATION_SEARCH_H
#define SUNDER_I_PENETRATION_SEARCH_H

#include "separation/obstacle/carrier.h"

/* A point of the plane of translations, at the parameter t of a line of the convolution. */
typedef struct sunder_i_free_point {
    bool found;
    bool origin; /* the origin itself is free, hence the answer */
    sunder_i_carrier line;
    sunder_i_fraction t;
    double x, y, distance; /* with an error of at most operands->error */
} sunder_i_free_point;

/* Finds the nearest free point of operands with Q reflected. `limit`, in units: points that are certainly farther are
 * not searched (found is false if there is no nearer one). Fails only with SUNDER_ENOMEM. */
sunder_status sunder_i_nearest_free_point(sunder_i_operands *operands, double limit, sunder_i_free_point *out,
                                          sunder_error *err);

/* Does the same as sunder_i_nearest_free_point(), which calls this function for many pairs of pieces, by squares
 * (squares.h). *done is false if there are too many squares or the lattice is wide; *out is then undefined. */
sunder_status sunder_i_nearest_by_squares(sunder_i_operands *operands, double limit, bool *done,
                                          sunder_i_free_point *out, sunder_error *err);

/* The numbers of the listed subsums, all computed, that the point may be in, on, or very close to. From all others its
 * distance exceeds twice the error of doubles. */
typedef struct sunder_i_near_subsums {
    uint32_t *subsum;
    size_t n;
} sunder_i_near_subsums;

/* Returns how the operands touch at a point that the search found; *near becomes the subsums near it, in the lattice's
 * arena. */
sunder_contact sunder_i_free_point_contact(sunder_i_operands *operands, const sunder_i_free_point *nearest,
                                           sunder_i_near_subsums *near);

/* Returns whether no listed subsum covers the translation (dx, dy), the doubles nearest to the point `nearest`. Exact.
 * All subsums that could cover it are listed. */
bool sunder_i_doubles_free(sunder_i_operands *operands, const sunder_i_free_point *nearest,
                           const sunder_i_near_subsums *near, double dx, double dy);

/* Returns whether the pieces of P and of Q + x, x the found point, have disjoint interiors. It tests every pair of
 * pieces by separating sides, without the subsums. Exact. */
bool sunder_i_free_point_verify(sunder_i_operands *operands, const sunder_i_free_point *nearest);

#endif
