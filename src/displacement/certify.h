/* A few bodies with limits: a proof that there is no solution, or one. */
#ifndef SUNDER_I_CERTIFY_H
#define SUNDER_I_CERTIFY_H

#include "displacement/displacement.h"

typedef enum sunder_i_verdict {
    SUNDER_I_UNKNOWN,   /* the effort ran out, or a limit is infinite */
    SUNDER_I_INSOLUBLE, /* proved: no moves within the limits part all pairs */
    SUNDER_I_SOLVED     /* no two of these bodies overlap in the solution; of the gap a little may be missed, and what
                         * lies beyond them is not heeded */
} sunder_i_verdict;

typedef struct sunder_i_solution {
    uint32_t *body; /* ascending: those asked about, and what stands about them */
    double *move;   /* [2 * bodies] */
    size_t bodies;
} sunder_i_solution;

/* pair: bodies among the given ones that are in conflict. The solution is filled, to be cleared, if the verdict is
 * SUNDER_I_SOLVED; else it is empty. */
sunder_status sunder_i_certify(const sunder_i_town *town, const uint32_t *body, size_t bodies,
                               const sunder_i_couple *pair, size_t pairs, sunder_i_verdict *verdict,
                               sunder_i_solution *solution, sunder_error *err);
void sunder_i_solution_clear(sunder_i_solution *solution);

#endif
