/* The least moves under constraints, up to rounding, or forces that prove that there are none; see nearest.c. */
#ifndef SUNDER_I_NEAREST_H
#define SUNDER_I_NEAREST_H

#include "displacement/quadratic/quadratic.h"
#include <stdbool.h>

typedef enum sunder_i_nearest_outcome {
    SUNDER_I_NEAREST_FOUND,   /* t is the solution, and the constraints' forces are its multipliers */
    SUNDER_I_NEAREST_NONE,    /* there is no solution: the constraints' forces contradict the limits, up to rounding */
    SUNDER_I_NEAREST_NOT_SURE /* not decided, because of rounding or of the limit on steps */
} sunder_i_nearest_outcome;

/* The constraints that are active at the present place. */
typedef struct sunder_i_nearest {
    size_t dims, n; /* dims: two for each body; n: the number of active constraints */
    uint32_t *set;  /* [n] the active constraints, by their numbers in the program */
    double *force;  /* [n] their forces */
    double *axis;   /* rows of length `dims`: an orthonormal basis of the span of the active normals */
    double *factor; /* rows of length `dims`: the coordinates of the active normals in this basis; the k-th has k + 1
                     * entries */
    double *part;   /* [dims] the coordinates of the normal of the new constraint in the basis */
    double *share;  /* [dims] its coefficients as a combination of the active normals */
    double *rest;   /* [dims] its component orthogonal to them */
    size_t set_capacity, force_capacity, axis_capacity, factor_capacity, part_capacity, share_capacity, rest_capacity;
} sunder_i_nearest;

void sunder_i_nearest_free(sunder_i_nearest *nearest);
/* Starts with no active constraint and t = 0. Returns false if memory is out. */
bool sunder_i_nearest_begin(sunder_i_nearest *nearest, sunder_i_quadratic *program);
/* Continues with the program's constraints, to which some may have been appended, until none is violated by more than
 * `tolerance`. All bodies have equal weight, whatever their masses. from: the positions of the bodies at t = 0; limit:
 * the greatest distance of each from the origin. */
sunder_i_nearest_outcome sunder_i_nearest_go_on(sunder_i_nearest *nearest, sunder_i_quadratic *program,
                                                const double *from, const double *limit, double tolerance);

#endif
