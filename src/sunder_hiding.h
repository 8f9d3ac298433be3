/* sunder_hiding.h: leaving features of a layer out, as few as possible, if not all of them can be given room.
 *
 * The whole header is experimental: see sunder.h and docs/api.md. */
#ifndef SUNDER_HIDING_H
#define SUNDER_HIDING_H

#include "sunder.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What it costs to hide a feature, that is to leave it out of the result. A choice of features is better than another
 * one if it hides less weight of the most important class in which the two differ. */
typedef struct sunder_hiding_cost {
    uint32_t hierarchy; /* its class: 0: it is never hidden; 1: the most important class of the others */
    int64_t weight;     /* from 1 to SUNDER_GREATEST_HIDING_WEIGHT */
} sunder_hiding_cost;
#define SUNDER_GREATEST_HIDING_WEIGHT (INT64_C(1) << 40)

/* Allows sunder_layer_separate() to hide features. cost: [n], copied; NULL: none is hidden, which is the default.
 *
 * Then each conflict that remains is proved, or assumed if no proof is found, to be due to a set of features and
 * barriers that cannot all be kept: a clause. The best choice with a hidden feature in each clause is taken, the others
 * are laid out without the hidden ones, and so on, until no conflict remains for which a feature may be hidden. Hidden
 * features do not move, and have the status SUNDER_FEATURE_HIDDEN. Blocks, limits, rows, and what lies in what are
 * those of all features.
 *
 * Fails with SUNDER_ENOMEM, and with SUNDER_EARG for a weight out of its range. */
SUNDER_EXPERIMENTAL sunder_status sunder_layer_set_hiding(sunder_layer *layer, const sunder_hiding_cost *cost,
                                                          sunder_error *err);

/* What was hidden, and what is proved of it. */
typedef struct sunder_hiding_summary {
    size_t hidden;          /* the number of hidden features */
    size_t forced;          /* of them, those that have no place whatever else is hidden: clauses of one member */
    int64_t weight, least;  /* the sum of their weights; and that of the best choice for the proved clauses, in the
                             * order of the classes: no choice without a conflict is better than that one */
    size_t clauses, proved; /* the number of clauses, and of those that are proved */
    size_t components;      /* parts of the clauses that have no member in common */
    size_t components_best; /* of them, those in which what is hidden is proved to be the best */
    size_t rounds;          /* layouts computed */
} sunder_hiding_summary;
/* Fills in *summary; zeros if the layer had no hiding costs. */
SUNDER_EXPERIMENTAL void sunder_report_hiding_sized(const sunder_report *report, sunder_hiding_summary *summary,
                                                    size_t size);
static inline void sunder_report_hiding(const sunder_report *report, sunder_hiding_summary *summary)
{
    sunder_report_hiding_sized(report, summary, sizeof *summary);
}

/* A set of features of which one has to be hidden. */
typedef struct sunder_clause {
    const size_t *member; /* [members] the features that may be hidden, ascending */
    const size_t *thing;  /* [things] all features and barriers of the conflict or its proof, ascending; barrier k is
                           * the number of features + k */
    size_t members, things;
    bool proved;
} sunder_clause;
/* Returns the clauses, and sets *n to their number. The report owns them. */
SUNDER_EXPERIMENTAL const sunder_clause *sunder_report_clauses(const sunder_report *report, size_t *n);

#ifdef __cplusplus
}
#endif

#endif
