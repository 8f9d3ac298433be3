/* A question about a conflict: a small layer about it; see question.c. */
#ifndef SUNDER_I_QUESTION_H
#define SUNDER_I_QUESTION_H

#include "base/patience.h"
#include "displacement/report/report.h"

/* A small layer about one conflict. The first `moving` features move, the others stand. */
typedef struct sunder_i_surroundings {
    sunder_i_list feature; /* in the numbers of the whole layer */
    sunder_i_list part;    /* of barriers, likewise */
    size_t moving;
    sunder_feature *as;      /* [feature.n] how each takes part */
    sunder_shape **standing; /* [feature.n] owned shapes, of those that moved; else NULL */
    double known[4];         /* whoever reaches into this box is among them */
    double farthest;         /* nobody may go farther than this */
} sunder_i_surroundings;

typedef struct sunder_i_questions {
    const sunder_i_solver *solver;
    sunder_report *report;
    const sunder_layer_options *options;
    sunder_i_solve_layer solve;
    int halvings;  /* between what does and what does not */
    size_t leaves; /* of those in the way, by turns */
} sunder_i_questions;

/* What is asked: a limit for all that move, the gap, and who is gone. */
typedef struct sunder_i_supposition {
    double limit, gap;
    uint32_t gone; /* SUNDER_I_NOBODY: nobody */
    bool all;      /* few that are listed besides have to be solved, too */
} sunder_i_supposition;

/* Who takes part in questions about a conflict. To be cleared, also on failure. */
sunder_status sunder_i_surround(const sunder_i_solver *solver, const sunder_conflict *conflict,
                                sunder_i_surroundings *surroundings, sunder_error *err);
void sunder_i_surroundings_clear(sunder_i_surroundings *surroundings);
/* Are others listed besides, so few that they can be asked to be solved, too? */
sunder_status sunder_i_few_are_listed(const sunder_i_questions *questions, const sunder_i_surroundings *surroundings,
                                      const sunder_conflict *conflict, bool *few, sunder_error *err);
/* Is there a solution? *longest: of its moves. proof: with looking for a proof that there is none, which only saves
 * time. */
sunder_status sunder_i_ask(const sunder_i_questions *questions, const sunder_i_surroundings *surroundings,
                           const sunder_conflict *conflict, const sunder_i_supposition *what, sunder_i_patience *proof,
                           bool *yes, double *longest, sunder_error *err);

#endif
