/* Questions about a remaining conflict, each answered by a small layer around it; question.c explains them. */
#ifndef SUNDER_I_QUESTION_H
#define SUNDER_I_QUESTION_H

#include "base/patience.h"
#include "displacement/prove/proofs/feasibility.h"
#include "displacement/report/report.h"
#include "displacement/report/small_layer.h"
#include "displacement/solve/clusters/cluster_stages.h"

/* Requirements of listed pairs of features in the whole layer, sorted. The caller frees the list. All zero: empty. */
typedef struct sunder_i_requirement_memo {
    sunder_i_requirement *item;
    size_t n, capacity;
} sunder_i_requirement_memo;

typedef struct sunder_i_questions {
    const sunder_i_solver *solver;
    sunder_report *report;
    const sunder_layer_options *options;
    sunder_i_solve_layer solve;
    int halvings;  /* how often an interval between a sufficient and an insufficient value is halved */
    size_t leaves; /* how many of the blocking features are removed, one at a time */
    /* Caches of the cluster at hand: relaxations beside barriers, and how listed pairs of features stood in the whole
     * layer. */
    sunder_i_relaxation_memo *memo;
    sunder_i_requirement_memo *stood;
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
    bool foreseen;  /* if not yes: whether a proof told so and no search was made */
    double refuted; /* if not yes: about the least gap for which a search is known to fail */
    double *layout; /* NULL, or [2 * features of the small layer]: if yes, receives the moves of the solution */
} sunder_i_answer;

/* Sets *few to whether the small layer contains other listed pairs, and at most NEED_ALL of them, so that they can be
 * required to be solved, too. */
sunder_status sunder_i_few_are_listed(const sunder_i_questions *questions, const sunder_i_surroundings *surroundings,
                                      const sunder_conflict *conflict, bool *few, sunder_error *err);
/* Answers a question: whether there is a solution. `proof` decides whether a proof that there is none is attempted
 * first, which saves time if it succeeds; NULL: it is not. */
sunder_status sunder_i_ask(const sunder_i_questions *questions, const sunder_i_surroundings *surroundings,
                           const sunder_conflict *conflict, const sunder_i_supposition *what, sunder_i_patience *proof,
                           sunder_i_answer *answer, sunder_error *err);

/* ---- question_rows.c --------------------------------------------------------------------------------------------- */

/* Sets *list to what the rule of rows demands in the small layer, *n of them; the caller frees it. */
sunder_status sunder_i_question_rows(const sunder_i_questions *questions, const sunder_i_surroundings *surroundings,
                                     const sunder_i_supposition *what, sunder_i_row_demand **list, size_t *n,
                                     sunder_error *err);
/* Does the small layer as solved break the rule of rows, with the neighbours that it does not have, too? */
bool sunder_i_question_leaves_row(const sunder_i_questions *questions, const sunder_i_surroundings *surroundings,
                                  const sunder_i_solver *small, const sunder_i_supposition *what);

/* ---- Proofs about smaller gaps ----------------------------------------------------------------------------------- */

/* A small layer about one conflict that is prepared once, with the layer's gap, and not solved. It is used for proofs
 * about all questions on that conflict: with larger limits, with a smaller gap, without one feature. Proofs take a
 * small part of the time of solving, and what is computed for one helps the next. */
typedef struct sunder_i_foresight {
    sunder_layer *layer;
    sunder_i_solver solver;
    sunder_i_id_pair *spared; /* [n] all other listed pairs, sorted */
    size_t n;
    uint32_t *name; /* the numbers in the whole layer of this layer's features and barrier parts, for questions->memo */
    sunder_i_row_demand *row; /* [rows] what the rule of rows demands in this layer */
    size_t rows;
    double *held;  /* [n] the clearance that proofs hold each spared pair to; NAN: how it stood at the start of this
                     * layer */
    bool hopeless; /* a pair that has to be solved is proved to have no solution within the limits of init */
    const sunder_i_questions *questions;
    const sunder_i_surroundings *about;
    double *move; /* [2 * bodies] the moves of the last solution in real numbers */
    double *best; /* [2 * bodies] the moves of the last solution that holds in doubles */
    bool known;   /* there is one */
    bool patient; /* NEED_PROOF_PATIENT times the effort is allowed */
    double *next; /* [2 * bodies] scratch */
    double *at;   /* [2 * features] scratch, by features of the small layer */
    sunder_i_planes planes;
    sunder_i_precedents precedents;
} sunder_i_foresight;

typedef enum sunder_i_foresight_mode {
    SUNDER_I_FORESEE,          /* branch and bound, within NEED_PROOF_EFFORT */
    SUNDER_I_FORESEE_IN_PLANE, /* only the plane of the pair's relative moves, which takes part of the time and can only
                                * prove that there is no solution */
    /* What a layout in doubles has to keep: one translation separates a feature from all parts of a barrier with which
     * it may keep an overlap; and pairs that may remain in conflict, unless both bodies had the same move in the last
     * solution, stand better than at the start by NEED_ROOM, so that rounding makes none of them worse. This finds
     * solutions, and proves nothing. */
    SUNDER_I_FORESEE_WITH_ROOM,
    /* Whether a search of the small layer can succeed. Such a search demands more than a solution has to fulfil: pairs
     * that may remain in conflict stand no worse than at the start of the small layer, in which some features stand
     * where they moved to. */
    SUNDER_I_FORESEE_SEARCH
} sunder_i_foresight_mode;

/* Makes the small layer. Each feature that moves may go as far as `limit`, or as its own limit if that is larger, but
 * not farther than surroundings->farthest. The caller calls sunder_i_foresight_clear() even if this fails. */
sunder_status sunder_i_foresight_init(sunder_i_foresight *foresight, const sunder_i_questions *questions,
                                      const sunder_i_surroundings *surroundings, const sunder_conflict *conflict,
                                      double limit, sunder_error *err);
void sunder_i_foresight_clear(sunder_i_foresight *foresight);
/* Sets the limits for the next questions in the same way; `limit` is at most the one of sunder_i_foresight_init(). */
void sunder_i_foresight_limit(sunder_i_foresight *foresight, double limit);
/* Decides whether the small layer has a solution with what->gap and without what->gone, within the present limits
 * (what->limit is not used): in real numbers, up to a small tolerance. If it is proved that there is none, *refuted
 * becomes about the least gap for which that is proved. */
sunder_status sunder_i_foresee(sunder_i_foresight *foresight, const sunder_i_supposition *what,
                               sunder_i_foresight_mode mode, sunder_i_verdict *verdict, double *refuted,
                               sunder_error *err);
/* Stores a solution, move[2 * features of the small layer]; solutions near it are looked for first. */
void sunder_i_foresight_note(sunder_i_foresight *foresight, const double *move);
/* Sets *yes to whether the last solution in real numbers is a solution in doubles that meets all conditions of a
 * question. what->gap is slightly smaller than the gap of that solution. */
sunder_status sunder_i_foresight_holds(sunder_i_foresight *foresight, const sunder_conflict *conflict,
                                       const sunder_i_supposition *what, bool *yes, sunder_error *err);

#endif
