/* sunder_hiding.h: leaving features of a layer out, as few as possible, if not all of them can be given room.
 *
 * The whole header is experimental: see sunder.h and docs/api.md. */
#ifndef SUNDER_HIDING_H
#define SUNDER_HIDING_H

#include "sunder_parts.h"
#include "sunder_proof.h"

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
    int64_t weight, least;  /* the sum of their weights; and that of the bounds of all classes */
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

/* The same of one class. `least`: no choice without a conflict is better than one that hides these weights; in another
 * class than the most important one it may hide less, if it hides more in a more important one. */
typedef struct sunder_hiding_class {
    uint32_t hierarchy;
    size_t hidden;
    int64_t weight, least;
} sunder_hiding_class;
/* Returns the classes that occur in it or in the proved clauses, the most important one first, and sets *n to their
 * number. The report owns them, as all that the functions below return. */
SUNDER_EXPERIMENTAL const sunder_hiding_class *sunder_report_hiding_classes(const sunder_report *report, size_t *n);

/* A set of features that cannot all be kept, and the conflict that it was made of. */
typedef struct sunder_clause {
    const size_t *member; /* [members] the features that may be hidden, ascending */
    const size_t *thing;  /* [things] all features and barriers of the conflict or its proof, ascending; barrier k is
                           * the number of features + k */
    size_t members, things;
    bool proved;
    size_t a, b; /* the conflict, as in sunder_conflict */
    sunder_reason reason;
    bool crowded;
    const sunder_proof *proof; /* if it is proved and sunder_layer_options.keep_trees was set: NULL for the reasons
                                * fixed and perhaps max_shift */
} sunder_clause;
/* Returns the clauses, and sets *n to their number. */
SUNDER_EXPERIMENTAL const sunder_clause *sunder_report_clauses(const sunder_report *report, size_t *n);

/* Returns the neighbours in rows with a hidden end, and sets *n to their number. Proofs of clauses may name them.
 * sunder_report_row_pairs() returns the others. */
SUNDER_EXPERIMENTAL const sunder_row_pair *sunder_report_hidden_row_pairs(const sunder_report *report, size_t *n);

/* ---- The bound of what is hidden -------------------------------------------------------------------------- */

/* Proofs of the bound, one tree for each component of the proved clauses; docs/PROOF.md, section 6, says why the bound
 * follows. A feature has levels: 0 as given, 1 hidden. */
typedef enum sunder_hiding_node_kind {
    SUNDER_HIDING_NODE_SPLIT, /* the choices with the feature at `level` or above; then those with it below */
    SUNDER_HIDING_NODE_UNMET, /* there are no choices: all members of the clause are kept */
    SUNDER_HIDING_NODE_SHARES /* the shares of the clauses in the costs of their members prove the bound */
} sunder_hiding_node_kind;
typedef struct sunder_hiding_node {
    sunder_hiding_node_kind kind;
    size_t feature, level, clause; /* of the first two kinds; the clause as in sunder_report_clauses() */
    size_t share, shares;          /* the first in sunder_hiding_trees.share, and their number */
} sunder_hiding_node;
/* A weight of one class that a clause gets, or of a bound; clause: SIZE_MAX in a bound. */
typedef struct sunder_hiding_share {
    size_t clause;
    uint32_t hierarchy;
    int64_t weight;
} sunder_hiding_share;
typedef struct sunder_hiding_tree {
    size_t feature;       /* one of the component */
    size_t node, nodes;   /* the first in sunder_hiding_trees.node, and their number, in preorder */
    size_t bound, bounds; /* the weights that are proved, by class, in sunder_hiding_trees.share */
} sunder_hiding_tree;
typedef struct sunder_hiding_trees {
    const sunder_hiding_tree *tree;
    const sunder_hiding_node *node;
    const sunder_hiding_share *share;
    size_t trees, nodes, shares;
} sunder_hiding_trees;
SUNDER_EXPERIMENTAL const sunder_hiding_trees *sunder_report_hiding_trees(const sunder_report *report);

#ifdef __cplusplus
}
#endif

#endif
