/* The nearest point to the origin that no listed subsum covers. */
#ifndef SUNDER_I_NEAREST_H
#define SUNDER_I_NEAREST_H

#include "separation/obstacle/line.h"

/* A point of the plane of translations: at t on a line of the convolution. */
typedef struct sunder_i_nearest {
    bool found;
    bool origin; /* the origin itself is free, and so the answer */
    sunder_i_line line;
    sunder_i_fraction t;
    double x, y, distance; /* within pairing->error */
} sunder_i_nearest;

/* limit: in units; what is certainly farther is not looked for (found is false if there is nothing nearer). The pairing
 * has Q reflected. Fails only with SUNDER_ENOMEM. */
sunder_status sunder_i_nearest_free(sunder_i_pairing *pairing, double limit, sunder_i_nearest *out, sunder_error *err);

/* The same square by square (squares.h), which the function above does where there are many pairs of pieces. Not *done:
 * too many squares, or a wide lattice; *out says nothing then. */
sunder_status sunder_i_nearest_by_squares(sunder_i_pairing *pairing, double limit, bool *done, sunder_i_nearest *out,
                                          sunder_error *err);

/* How the placement touches: for a point that the search found. */
sunder_contact sunder_i_nearest_contact(sunder_i_pairing *pairing, const sunder_i_nearest *nearest);

/* The pieces of P and of Q + x, x the point found, have disjoint interiors: asked again of every pair of pieces by
 * separating sides, without the subsums. Exact. */
bool sunder_i_nearest_verify(sunder_i_pairing *pairing, const sunder_i_nearest *nearest);

#endif
