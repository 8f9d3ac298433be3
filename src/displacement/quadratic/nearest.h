/* The least moves under constraints, to the last digit, or the forces that say there are none; see nearest.c. */
#ifndef SUNDER_I_NEAREST_H
#define SUNDER_I_NEAREST_H

#include "displacement/quadratic/quadratic.h"
#include <stdbool.h>

typedef enum sunder_i_nearest_outcome {
    SUNDER_I_NEAREST_FOUND,   /* t is it, the constraints' forces are its multipliers */
    SUNDER_I_NEAREST_NONE,    /* the constraints' forces contradict the limits, up to rounding */
    SUNDER_I_NEAREST_NOT_SURE /* rounding, or more steps than are taken */
} sunder_i_nearest_outcome;

/* The constraints that act at the place at hand. */
typedef struct sunder_i_nearest {
    size_t dims, n; /* two for each body; how many act */
    uint32_t *set;  /* [n] their places in the program */
    double *force;  /* [n] */
    double *axis;   /* rows of `dims`: an orthonormal basis of what their normals span, and ... */
    double *factor; /* ... rows of `dims`: the active normals in it; the k-th has k + 1 entries */
    double *part;   /* [dims] of the one that comes in: in the basis, ... */
    double *share;  /* [dims] ... as a sum of those that act, ... */
    double *rest;   /* [dims] ... and what is left of it */
    size_t set_capacity, force_capacity, axis_capacity, factor_capacity, part_capacity, share_capacity, rest_capacity;
} sunder_i_nearest;

void sunder_i_nearest_free(sunder_i_nearest *nearest);
/* Nothing acts, and nothing has moved. False if memory is out. */
bool sunder_i_nearest_begin(sunder_i_nearest *nearest, sunder_i_quadratic *program);
/* Goes on with the program's constraints, to which some may have been appended, until none is missed by more than
 * tolerance. All weigh alike, whatever the masses. from, limit: where the bodies stand at t = 0, and how far from the
 * origin each may be. */
sunder_i_nearest_outcome sunder_i_nearest_go_on(sunder_i_nearest *nearest, sunder_i_quadratic *program,
                                                const double *from, const double *limit, double tolerance);

#endif
