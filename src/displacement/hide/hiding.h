/* Which features are left out, because a layout of all of them does not exist. See hiding.c. */
#ifndef SUNDER_I_HIDING_H
#define SUNDER_I_HIDING_H

#include "displacement/hide/cover.h"
#include "displacement/report/report.h"

/* The conflict that a clause was made of, by the caller's numbers. */
typedef struct sunder_i_clause_source {
    size_t first; /* that of the clause */
    size_t a, b;
    sunder_reason reason;
    bool crowded;
    sunder_proof *proof; /* NULL if there is none, or if proofs are not kept */
} sunder_i_clause_source;

/* The work on one layer. Features are numbered as the caller numbers them, barrier k as the number of features + k. */
typedef struct sunder_i_hiding {
    const sunder_hiding_cost *cost; /* [n] borrowed from the layer */
    size_t n;
    bool *hidden; /* [n] the present choice */
    sunder_i_clauses clauses;
    sunder_i_clause_source *source; /* [sources] ascending by `first` */
    size_t sources, source_room;
    bool keep_proofs; /* of the clauses */
    bool thorough;    /* layouts are computed with the caller's effort; before that with none */
    size_t rounds;    /* the number of layouts computed */
} sunder_i_hiding;

/* Begins with nothing hidden. The caller frees it, also after a failure. */
sunder_status sunder_i_hiding_begin(const sunder_layer *layer, sunder_i_hiding *hiding, sunder_error *err);
void sunder_i_hiding_free(sunder_i_hiding *hiding);
/* Learns from the conflicts that remain in a layout of the features that are not hidden, and chooses again.
 *
 * number  [things of the model] the caller's numbers
 * report  the proofs that are kept are taken from it
 * again   whether the choice has to be tried; otherwise the layout is the last one, and its conflicts are among
 *         features that may not be hidden */
sunder_status sunder_i_hiding_learn(sunder_i_hiding *hiding, const sunder_i_model *model, const uint32_t *number,
                                    sunder_report *report, bool *again, sunder_error *err);
/* Writes what is hidden, and what is proved of it, to the report, which receives the proofs of the clauses. */
sunder_status sunder_i_hiding_report(sunder_i_hiding *hiding, sunder_report *report, sunder_error *err);

#endif
