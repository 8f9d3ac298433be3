/* sunder_hiding.h: features of a layer become smaller or are left out, as few as possible, if not all of them can be
 * given room.
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
 * barriers that cannot all be kept as they are: a clause. The best choice with a hidden or smaller feature in each
 * clause is taken, the layer is laid out with it, and so on, until no conflict remains for which a feature may be
 * hidden or become smaller. Hidden features do not move, and have the status SUNDER_FEATURE_HIDDEN. Blocks, limits,
 * anchors, rows, and what lies in what are those of all features with the shapes as given.
 *
 * Fails with SUNDER_ENOMEM, and with SUNDER_EARG for a weight out of its range. */
SUNDER_EXPERIMENTAL sunder_status sunder_layer_set_hiding(sunder_layer *layer, const sunder_hiding_cost *cost,
                                                          sunder_error *err);

/* What becomes of a feature that a line or point of a barrier crosses: that meets its interior as it is given. */
typedef enum sunder_crossed {
    SUNDER_CROSSED_HIDE, /* it owes the barrier the same as all others, and is not cut back */
    SUNDER_CROSSED_TRIM, /* it owes the same, and may be cut back to one side of the line */
    SUNDER_CROSSED_KEEP  /* it may not stand worse beside the barrier than at home, and owes it nothing else: its
                          * conflict has the reason SUNDER_REASON_KEPT, and nothing is hidden or smaller for it */
} sunder_crossed;
/* Sets it for all features of the layer; SUNDER_CROSSED_HIDE is the default. */
SUNDER_EXPERIMENTAL void sunder_layer_set_crossed(sunder_layer *layer, sunder_crossed crossed);

/* A smaller shape that a feature may have. */
typedef struct sunder_level {
    const sunder_shape *shape; /* remains the caller's, and must outlive the layer; it lies in the shape before it */
    int64_t cost;              /* from 0 to SUNDER_GREATEST_HIDING_WEIGHT, and not less than that of the level before */
} sunder_level;

/* Allows sunder_layer_separate() to give features smaller shapes. level: those of all features, feature by feature,
 * from the largest on; end: [n] the index past the last one of each feature. Both are copied. end NULL: no feature has
 * any, which is the default. Of choices that hide the same weights the one with the least sum of costs is the best.
 *
 * Fails with SUNDER_ENOMEM, and with SUNDER_EARG if a shape does not lie in the one before it, or a cost is out of its
 * range. */
SUNDER_EXPERIMENTAL sunder_status sunder_layer_set_levels(sunder_layer *layer, const sunder_level *level,
                                                          const size_t *end, sunder_error *err);

/* How features are made larger. */
typedef struct sunder_enlarging {
    double width;      /* above 0: a disc of this diameter fits into each part of a block, or of a feature in none */
    const bool *rigid; /* NULL, or [n] features whose blocks keep their shapes */
} sunder_enlarging;

/* Makes blocks larger that are too small. A part of a block, which is one polygon or several that are no farther apart
 * than the touch tolerance, is stretched along the box of least width around it and across it, up to the least size,
 * and then in both directions alike until the disc fits in, which is decided up to a thousandth of its width. Members
 * share the vertices that they shared. The larger shapes are meant for the features of another layer, with the blocks
 * of this one (sunder_layer_options.no_blocks), and with its shapes as originals (sunder_layer_set_originals()).
 *
 * options  decide which features are blocks
 * shape    [n] becomes the larger shape of each feature that grows, a new one that the caller frees; NULL for others
 * block    [n] becomes the block of each feature: the number of its first feature; -1 for a feature in none
 *
 * Blocks with a member that is ignored or rigid, or that has corners that are not doubles, keep their shapes. Fails
 * with SUNDER_ENOMEM or SUNDER_ECANCEL, with SUNDER_EARG if the least size is not above 0 and finite, and with
 * SUNDER_ERANGE if a shape would leave the range of doubles; all shapes are then NULL. */
SUNDER_EXPERIMENTAL sunder_status sunder_layer_enlarge(const sunder_layer *layer, const sunder_layer_options *options,
                                                       const sunder_enlarging *enlarging, sunder_shape **shape,
                                                       int64_t *block, sunder_error *err);

/* Sets block[n] to the block of each feature by the options: the number of its first feature; -1 for a feature in none.
 * Fails with SUNDER_ENOMEM or SUNDER_ECANCEL. */
SUNDER_EXPERIMENTAL sunder_status sunder_layer_blocks(const sunder_layer *layer, const sunder_layer_options *options,
                                                      int64_t *block, sunder_error *err);

/* Says that features of the layer were made larger. shape: [n] the shapes that they had before, NULL for a feature that
 * has the same; copied, but the shapes remain the caller's and must outlive the layer. NULL: no feature was enlarged.
 * These shapes decide on which sides of barriers features stand, and which a barrier crosses. Fails with
 * SUNDER_ENOMEM. */
SUNDER_EXPERIMENTAL sunder_status sunder_layer_set_originals(sunder_layer *layer, const sunder_shape *const *shape,
                                                             sunder_error *err);

/* How features are cut back at barriers. */
typedef struct sunder_trimming {
    double keep;  /* the least share of its area that a feature keeps, from 0 to 1 */
    double width; /* >= 0; a disc of this diameter lies in what remains, and thinner arms that a cut left are cut off */
} sunder_trimming;

/* Says what sunder_layer_check_moves() demands of features that have smaller shapes: one with a shape that it may not
 * have is too small (SUNDER_CONFLICT_TOO_SMALL) if it keeps less, or if the disc does not fit into one of its polygons,
 * and else altered. Nothing is demanded by default. */
SUNDER_EXPERIMENTAL void sunder_layer_set_least(sunder_layer *layer, const sunder_trimming *least);

/* Cuts features back to the largest polygon of what is as far from all barriers as they have to be; with
 * the gap of the options. shape: [n] becomes, for each feature that is cut and meets the conditions, a new shape that
 * lies in it and that the caller frees; NULL for all others. Ignored features, those without a polygon and those with
 * corners that are not doubles are not cut. sunder_layer_set_crossed() says whether crossed features are; those that
 * are kept are cut back at other barriers. Fails with SUNDER_ENOMEM or SUNDER_ECANCEL; all shapes are then NULL. */
SUNDER_EXPERIMENTAL sunder_status sunder_layer_trim(const sunder_layer *layer, const sunder_layer_options *options,
                                                    const sunder_trimming *trimming, sunder_shape **shape,
                                                    sunder_error *err);

/* How far the outlines of blocks are moved in. */
typedef struct sunder_inset {
    const double *length; /* [lengths] above 0, ascending: the distances from the outline */
    size_t lengths;
    double width; /* >= 0; a disc of this diameter lies in what remains, and thinner arms that a cut left are cut off */
} sunder_inset;

/* Moves the outlines of blocks in, one rung for each length. The walls between members of a block stay where they are,
 * so that members share them as before. A member keeps the largest polygon of what is left of it.
 *
 * options  decide which features are blocks, and what is an inner wall: where the members are no farther apart than
 *          the touch tolerance
 * from     NULL, or [n] the shapes whose outlines are moved in, such as those of sunder_layer_trim(); NULL for a
 *          feature: its shape as given
 * shape    [n * lengths] feature by feature: new shapes that the caller frees, each in the one before it; NULL where
 *          there is none that meets the conditions
 *
 * Ignored features, those that are not one polygon, and those with corners that are not doubles have none. Fails with
 * SUNDER_ENOMEM or SUNDER_ECANCEL, and with SUNDER_EARG for lengths out of their range; all shapes are then NULL. */
SUNDER_EXPERIMENTAL sunder_status sunder_layer_inset(const sunder_layer *layer, const sunder_layer_options *options,
                                                     const sunder_inset *inset, sunder_shape *const *from,
                                                     sunder_shape **shape, sunder_error *err);

/* How features are made smaller as a whole. */
typedef struct sunder_scaling {
    const double *factor; /* [factors] below 1, descending, above 0 */
    size_t factors;
    double square; /* the side of a square that comes last; 0: none does */
    double width;  /* >= 0; a disc of this diameter lies in what is scaled */
} sunder_scaling;

/* Scales features about the centre of their largest disc, and at last replaces them by a square about the centre of the
 * largest disc of the shape before, along their longest edge.
 *
 * options  decide which features are in blocks; these are not scaled
 * from     NULL, or [n] the smallest shapes so far; NULL for a feature: its shape as given
 * shape    [n * (factors + 1)] feature by feature, the square last: new shapes that the caller frees, each in the one
 *          before it; NULL where there is none that meets the conditions
 *
 * Ignored features and those with corners that are not doubles have none. Fails as sunder_layer_inset() does. */
SUNDER_EXPERIMENTAL sunder_status sunder_layer_scale(const sunder_layer *layer, const sunder_layer_options *options,
                                                     const sunder_scaling *scaling, sunder_shape *const *from,
                                                     sunder_shape **shape, sunder_error *err);

/* Finds a largest disc that lies in the shape, up to a thousandth of the shape's width: its centre, and a radius that
 * is not too great but for rounding. 0 for an empty shape. Fails with SUNDER_ENOMEM. */
SUNDER_EXPERIMENTAL sunder_status sunder_shape_largest_disc(const sunder_shape *shape, double centre[2], double *radius,
                                                            sunder_error *err);

/* What was hidden or became smaller, and what is proved of it. */
typedef struct sunder_hiding_summary {
    size_t hidden;          /* the number of hidden features */
    size_t forced;          /* of them, those that have no place whatever else is hidden: clauses of one member */
    int64_t weight, least;  /* the sum of their weights; and that of the bounds of all classes */
    size_t clauses, proved; /* the number of clauses, and of those that are proved */
    size_t components;      /* parts of the clauses that have no member in common */
    size_t components_best; /* of them, those in which what is hidden is proved to be the best */
    size_t rounds;          /* the greatest number of layouts from which a component got clauses */
    size_t smaller;         /* the number of features with a smaller shape */
    int64_t smaller_cost;   /* the sum of the costs of their levels */
    int64_t smaller_least;  /* a lower bound of it for any choice that hides the same features */
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

/* What is hidden or smaller in one component of the clauses, and what is proved of it. The members add up over all
 * components to those of the summary that have their names, but for `rounds`. All of its features belong to one world
 * (sunder_report_world()). */
typedef struct sunder_hiding_component {
    size_t feature; /* the least number of its features */
    size_t clauses, proved, forced, rounds, smaller;
    int64_t smaller_cost, smaller_least;
    size_t first_class, classes; /* its classes in sunder_report_component_classes() */
    bool best;
} sunder_hiding_component;
/* Adds a component to a summary, which begins with zeros. `rounds` becomes the greatest of all components. */
SUNDER_EXPERIMENTAL void sunder_hiding_add(sunder_hiding_summary *sum, const sunder_hiding_component *component);
/* Returns the components, in the order of their first features, and sets *n to their number. */
SUNDER_EXPERIMENTAL const sunder_hiding_component *sunder_report_hiding_components(const sunder_report *report,
                                                                                   size_t *n);
/* Returns what is hidden in each component by class, in the order of the components, and sets *n to the number of all
 * entries. */
SUNDER_EXPERIMENTAL const sunder_hiding_class *sunder_report_component_classes(const sunder_report *report, size_t *n);

/* Returns the level of a feature: 0 with its shape as given, k with its smaller shape number k; one more than there are
 * smaller shapes if it is hidden. */
SUNDER_EXPERIMENTAL size_t sunder_report_level(const sunder_report *report, size_t feature);

/* A set of features that cannot all keep their levels, and the conflict that it was made of. */
typedef struct sunder_clause {
    const size_t *member;  /* [members] the features that may be hidden or become smaller, ascending */
    const size_t *thing;   /* [things] all features and barriers of the conflict or its proof, ascending; barrier k is
                           * the number of features + k */
    const uint32_t *level; /* [members] the levels that they cannot all keep */
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
