/* Questions about a remaining conflict, each answered by a small layer around it; question.c explains them. */
#ifndef SUNDER_I_QUESTION_H
#define SUNDER_I_QUESTION_H

#include "base/patience.h"
#include "displacement/prove/proofs/feasibility.h"
#include "displacement/report/report.h"

/* The small layer around one conflict. The first `moving` features may move, all others are fixed. */
typedef struct sunder_i_surroundings {
    sunder_i_list feature; /* features, by their numbers in the whole layer */
    sunder_i_list part;    /* parts of barriers, by their numbers in the whole layer */
    size_t moving;
    sunder_feature *as;      /* [feature.n] the properties with which each takes part */
    sunder_shape **standing; /* [feature.n] owned: the shapes of features that moved in the result, at their present
                              * positions; NULL for others */
    double known[4];         /* every feature that reaches into this box is in the small layer */
    double farthest;         /* the longest move that a feature may make in it */
} sunder_i_surroundings;

typedef struct sunder_i_questions {
    const sunder_i_solver *solver;
    sunder_report *report;
    const sunder_layer_options *options;
    sunder_i_solve_layer solve;
    int halvings;  /* how often an interval between a sufficient and an insufficient value is halved */
    size_t leaves; /* how many of the blocking features are removed, one at a time */
} sunder_i_questions;

/* What a question changes: the limit of all movable features, the gap, and a feature or barrier that is removed. */
typedef struct sunder_i_supposition {
    double limit, gap;
    uint32_t gone; /* in the whole layer's numbers; SUNDER_I_NOBODY if none is removed */
    bool all;      /* a few other listed pairs have to be solved, too */
} sunder_i_supposition;

typedef struct sunder_i_answer {
    bool yes;       /* whether there is a solution */
    double longest; /* the longest move of the solution, if yes */
    double refuted; /* if not yes: about the least gap that is known to have no solution */
} sunder_i_answer;

/* Collects the features and barriers of the small layer around a conflict. The caller calls
 * sunder_i_surroundings_clear() even if this fails. */
sunder_status sunder_i_surround(const sunder_i_solver *solver, const sunder_conflict *conflict,
                                sunder_i_surroundings *surroundings, sunder_error *err);
void sunder_i_surroundings_clear(sunder_i_surroundings *surroundings);
/* Sets *few to whether the small layer contains other listed pairs, and so few that they can be required to be
 * solved. */
sunder_status sunder_i_few_are_listed(const sunder_i_questions *questions, const sunder_i_surroundings *surroundings,
                                      const sunder_conflict *conflict, bool *few, sunder_error *err);
/* Answers a question: whether there is a solution. `proof` decides whether a proof that there is none is attempted
 * first, which saves time if it succeeds. */
sunder_status sunder_i_ask(const sunder_i_questions *questions, const sunder_i_surroundings *surroundings,
                           const sunder_conflict *conflict, const sunder_i_supposition *what, sunder_i_patience *proof,
                           sunder_i_answer *answer, sunder_error *err);

/* ---- Proofs about smaller gaps ----------------------------------------------------------------------------------- */

/* The small layer of a question with the layer's gap and limits, which is not solved but only used for proofs that
 * there is no solution with some gap, or without one of its features. Proofs take a small part of the time of solving,
 * and what is computed for one helps the next. */
typedef struct sunder_i_foresight {
    sunder_layer *layer;
    sunder_i_solver solver;
    sunder_i_id_pair *spared;
    size_t n;
    const sunder_i_questions *questions;
    const sunder_i_surroundings *about;
    double *move; /* [2 * bodies] the moves of the last solution in real numbers */
    double *next; /* [2 * bodies] scratch */
    double *at;   /* [2 * features] scratch, by features of the small layer */
    sunder_i_planes planes;
    sunder_i_precedents precedents;
} sunder_i_foresight;

/* Makes the small layer. With `all`, a few other listed pairs may not remain in conflict. The caller calls
 * sunder_i_foresight_clear() even if this fails. */
sunder_status sunder_i_foresight_init(sunder_i_foresight *foresight, const sunder_i_questions *questions,
                                      const sunder_i_surroundings *surroundings, const sunder_conflict *conflict,
                                      bool all, sunder_error *err);
void sunder_i_foresight_clear(sunder_i_foresight *foresight);
/* Decides whether the small layer has a solution with this gap: in real numbers, each conflict by itself and up to a
 * small tolerance. If it is proved that there is none, *refuted becomes about the least gap for which that is proved.
 * gone: SUNDER_I_NOBODY, or a feature or barrier to leave out, in the whole layer's numbers. in_plane: examine only the
 * plane of the pair's relative moves, which takes part of the time and can only prove that there is no solution. */
sunder_status sunder_i_foresee(sunder_i_foresight *foresight, double gap, uint32_t gone, bool in_plane,
                               sunder_i_verdict *verdict, double *refuted, sunder_error *err);
/* Sets *yes to whether the last solution in real numbers, with a slightly smaller gap, is a solution in doubles that
 * meets all conditions of a question. */
sunder_status sunder_i_foresight_holds(const sunder_i_foresight *foresight, const sunder_conflict *conflict, double gap,
                                       bool *yes, sunder_error *err);

#endif
