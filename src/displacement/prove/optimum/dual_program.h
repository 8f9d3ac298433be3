/* The convex program of a node: the least weighted sum of squared moves under half-planes; see dual_program.c. */
#ifndef SUNDER_I_DUAL_PROGRAM_H
#define SUNDER_I_DUAL_PROGRAM_H

#include "displacement/layer/prices.h"
#include "displacement/quadratic/quadratic.h"

#include <stdbool.h>

/* The cut n.(t_j - t_i) + share * s >= d; i or j may be SUNDER_I_GROUND. The doubles are exact. With give > 0 it may be
 * violated by v at the cost v^2 / (2 give): two such cuts with opposite normals are a spring. s is what the pair number
 * `eased` of the program lacks; it does not count if the share is 0, as for most cuts. */
typedef struct sunder_i_move_cut {
    uint32_t i, j;
    double n[2], d, give;
    uint32_t eased;
    double share;
} sunder_i_move_cut;

/* Is it the cut s >= 0? */
static inline bool sunder_i_is_lack_above_0(const sunder_i_move_cut *cut)
{
    return cut->share != 0 && cut->i == SUNDER_I_GROUND && cut->j == SUNDER_I_GROUND && cut->d == 0;
}

/* An active cut, and its force. */
typedef struct sunder_i_cut_force {
    uint32_t cut;
    double force;
} sunder_i_cut_force;

/* Minimise sum w_i |t_i - a_i|^2, plus the cost of the violations of cuts that give, plus the prices of what pairs
 * lack, under cuts. For each price there has to be a cut s >= 0 (of the ground with itself, with a share of 1). */
typedef struct sunder_i_dual_program {
    size_t bodies;
    const double *weight;        /* [bodies] */
    const double *mass;          /* [bodies] 1 / (2 weight); 0 for a fixed body, whose t is its anchor */
    const double *anchor;        /* [2 * bodies] the points a; 0 for fixed bodies */
    const sunder_i_price *price; /* [prices] of what each pair that is eased lacks */
    size_t prices;
    const sunder_i_move_cut *cut;
    sunder_i_cut_force *acting; /* [acting_n] the active cuts */
    sunder_i_cut_force *before; /* scratch: those before one was added */
    size_t acting_n, capacity;
    double *factor; /* [capacity^2] the lower triangle of the Cholesky factor of the active cuts' products, by rows */
    double *t;      /* [2 * bodies] the minimiser for these forces */
    double *lacks;  /* [prices] what each pair lacks there */
    double *push;   /* [2 * prices] scratch: the sum of forces on each, and the sum of their magnitudes */
    double *net;    /* [3 * bodies] scratch: the sum of forces on each body, and the sum of their magnitudes */
    double *scratch;
    uint64_t steps;
} sunder_i_dual_program;

typedef enum sunder_i_dual_outcome {
    SUNDER_I_DUAL_SOLVED,
    SUNDER_I_DUAL_CLOSED, /* the forces prove at least `enough` */
    SUNDER_I_DUAL_STUCK   /* the cut could not be satisfied, in doubles */
} sunder_i_dual_outcome;

/* The caller sets weight, mass, anchor, price and cut. Returns false if memory is out. */
bool sunder_i_dual_init(sunder_i_dual_program *program, size_t bodies, size_t prices);
void sunder_i_dual_free(sunder_i_dual_program *program);
/* Starts from n active cuts, solved as equations. Cuts that are combinations of those before them, and cuts whose
 * forces would be negative, are dropped. Returns false if memory is out. */
bool sunder_i_dual_load(sunder_i_dual_program *program, const sunder_i_cut_force *acting, size_t n);
/* Adds one cut that program->t violates, and solves for forces for which it holds; `enough` is the value at which the
 * program ends if the cuts contradict each other. Sets *failed if memory is out. */
sunder_i_dual_outcome sunder_i_dual_add(sunder_i_dual_program *program, uint32_t cut, double enough, bool *failed);
/* Sets t from the forces. */
void sunder_i_dual_place(sunder_i_dual_program *program);
/* Returns a lower bound of that sum under the active cuts, rounded downwards. */
double sunder_i_dual_value(sunder_i_dual_program *program);
/* Returns the distance by which t violates the cut; negative if t satisfies it. */
double sunder_i_dual_missing(const sunder_i_dual_program *program, const sunder_i_move_cut *cut);
/* Is the cut active? One that gives is violated then, by what it gives. */
bool sunder_i_dual_is_acting(const sunder_i_dual_program *program, uint32_t cut);

#endif
