/* The convex program of a node: least weighted squares of moves under half-planes; see dual_program.c. */
#ifndef SUNDER_I_DUAL_PROGRAM_H
#define SUNDER_I_DUAL_PROGRAM_H

#include "displacement/quadratic/quadratic.h"

#include <stdbool.h>

/* n.(t_j - t_i) >= d; i or j may be SUNDER_I_GROUND. Exactly as it says. */
typedef struct sunder_i_move_cut {
    uint32_t i, j;
    double n[2], d;
} sunder_i_move_cut;

/* A cut that acts, and its force. */
typedef struct sunder_i_cut_force {
    uint32_t cut;
    double force;
} sunder_i_cut_force;

/* min sum w_i |t_i - a_i|^2 */
typedef struct sunder_i_dual_program {
    size_t bodies;
    const double *weight; /* [bodies] */
    const double *mass;   /* [bodies] 1 / (2 weight), or 0 for what is fixed, whose t is its anchor */
    const double *anchor; /* [2 * bodies] a; 0 for fixed ones */
    const sunder_i_move_cut *cut;
    sunder_i_cut_force *acting; /* [acting_n] */
    size_t acting_n, capacity;
    double *factor; /* [capacity^2] the lower triangle of the Cholesky factor of their products, by rows */
    double *t;      /* [2 * bodies] the least for these forces */
    double *net;    /* [3 * bodies] scratch: forces on each, and their size */
    double *scratch;
    uint64_t steps;
} sunder_i_dual_program;

typedef enum sunder_i_dual_outcome {
    SUNDER_I_DUAL_SOLVED,
    SUNDER_I_DUAL_CLOSED, /* the forces prove `enough`, or more */
    SUNDER_I_DUAL_STUCK   /* the cut could not be made to hold, in doubles; forces are as they were */
} sunder_i_dual_outcome;

/* The caller sets weight, mass, anchor and cut. False if memory is out. */
bool sunder_i_dual_init(sunder_i_dual_program *program, size_t bodies);
void sunder_i_dual_free(sunder_i_dual_program *program);
/* Starts from these cuts, as equations; forces that would pull are dropped. False if memory is out. */
bool sunder_i_dual_load(sunder_i_dual_program *program, const sunder_i_cut_force *acting, size_t n);
/* Makes one more cut hold, which t violates. */
sunder_i_dual_outcome sunder_i_dual_add(sunder_i_dual_program *program, uint32_t cut, double enough, bool *failed);
/* t from the forces. */
void sunder_i_dual_place(sunder_i_dual_program *program);
/* What sum of w |t - a|^2 cannot be less than under the cuts that act, rounded downwards. */
double sunder_i_dual_value(sunder_i_dual_program *program);
/* By how much t misses the cut. */
double sunder_i_dual_missing(const sunder_i_dual_program *program, const sunder_i_move_cut *cut);

#endif
