/* A question about a conflict: a small layer about it; see question.c. */
#ifndef SUNDER_I_QUESTION_H
#define SUNDER_I_QUESTION_H

#include "base/patience.h"
#include "displacement/prove/proofs/feasibility.h"
#include "displacement/report/report.h"

/* A small layer about one conflict. The first `moving` features move, the others stand. */
typedef struct sunder_i_surroundings {
    sunder_i_list feature; /* in the numbers of the whole layer */
    sunder_i_list part;    /* of barriers, likewise */
    size_t moving;
    sunder_feature *as;      /* [feature.n] how each takes part */
    sunder_shape **standing; /* [feature.n] owned shapes, of those that moved; else NULL */
    double known[4];         /* all features that reach into this box are among them */
    double farthest;         /* no feature may go farther than this */
} sunder_i_surroundings;

typedef struct sunder_i_questions {
    const sunder_i_solver *solver;
    sunder_report *report;
    const sunder_layer_options *options;
    sunder_i_solve_layer solve;
    int halvings;  /* between what does and what does not */
    size_t leaves; /* features in the way, in turn */
} sunder_i_questions;

/* The question: a limit for all movable features, the gap, and a removed feature. */
typedef struct sunder_i_supposition {
    double limit, gap;
    uint32_t gone; /* SUNDER_I_NOBODY: none */
    bool all;      /* few that are listed besides have to be solved, too */
} sunder_i_supposition;

typedef struct sunder_i_answer {
    bool yes;       /* there is a solution */
    double longest; /* of its moves, then */
    double refuted; /* else no gap above this has one, roughly: what is known without asking again */
} sunder_i_answer;

/* The participants of questions about a conflict. The caller clears it, also after a failure. */
sunder_status sunder_i_surround(const sunder_i_solver *solver, const sunder_conflict *conflict,
                                sunder_i_surroundings *surroundings, sunder_error *err);
void sunder_i_surroundings_clear(sunder_i_surroundings *surroundings);
/* Are others listed besides, so few that they can be asked to be solved, too? */
sunder_status sunder_i_few_are_listed(const sunder_i_questions *questions, const sunder_i_surroundings *surroundings,
                                      const sunder_conflict *conflict, bool *few, sunder_error *err);
/* Is there a solution? proof: with looking for a proof that there is none, which saves time. */
sunder_status sunder_i_ask(const sunder_i_questions *questions, const sunder_i_surroundings *surroundings,
                           const sunder_conflict *conflict, const sunder_i_supposition *what, sunder_i_patience *proof,
                           sunder_i_answer *answer, sunder_error *err);

/* ---- What proofs tell of smaller gaps ---------------------------------------------------------------------------- */

/* A question about a conflict with the layer's gap and limits that is not solved: it only serves proofs, with a smaller
 * gap, or without one of its features. That takes a small part of the work of solving, and results of one such question
 * help the next. */
typedef struct sunder_i_foresight {
    sunder_layer *layer;
    sunder_i_solver solver;
    sunder_i_id_pair *spared;
    size_t n;
    const sunder_i_questions *questions;
    const sunder_i_surroundings *about;
    double *move; /* [2 * bodies] of the last solution of reals */
    double *next; /* likewise, scratch */
    double *at;   /* [2 * features] scratch, by features of the question */
    sunder_i_planes planes;
    sunder_i_precedents precedents;
} sunder_i_foresight;

/* all: few that are listed besides are not spared. To be cleared, also on failure. */
sunder_status sunder_i_foresight_init(sunder_i_foresight *foresight, const sunder_i_questions *questions,
                                      const sunder_i_surroundings *surroundings, const sunder_conflict *conflict,
                                      bool all, sunder_error *err);
void sunder_i_foresight_clear(sunder_i_foresight *foresight);
/* Has it a solution with that gap? Of reals, each conflict by itself and up to a hair; or it is proved that there is
 * none: *refuted is then roughly the least gap for which that is proved. gone: SUNDER_I_NOBODY, or what is left out, in
 * the numbers of the whole layer. in_plane: only what the plane of one relative move tells, which may be that there is
 * none, and takes a part of the time. */
sunder_status sunder_i_foresee(sunder_i_foresight *foresight, double gap, uint32_t gone, bool in_plane,
                               sunder_i_verdict *verdict, double *refuted, sunder_error *err);
/* Is the last solution of reals one of doubles, with all that is asked of a question, with a gap that is less by a
 * hair? */
sunder_status sunder_i_foresight_holds(const sunder_i_foresight *foresight, const sunder_conflict *conflict, double gap,
                                       bool *yes, sunder_error *err);

#endif
