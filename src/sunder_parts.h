/* sunder_parts.h: what is needed to separate a layer in parts, each with the features near to it, and to get the result
 * that separating the whole layer would give.
 *
 * The report of a part says which of its features cannot have been influenced by features that the part does not
 * contain: see sunder_footprint. The whole header is experimental: see sunder.h and docs/api.md. The report owns all
 * arrays that the functions below return; they are valid until it is freed. */
#ifndef SUNDER_PARTS_H
#define SUNDER_PARTS_H

#include "sunder.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Sums of many doubles --------------------------------------------------------------------------------- */

/* An exact sum of doubles. So the totals of parts, joined in any order, are the total of the whole. It holds up to 2^60
 * addends of any size. A struct of zeros is the sum 0. Source: the long accumulator of [Kul13, section 8]. */
typedef struct sunder_total {
    uint64_t limb[67]; /* two's complement, in units of 2^-2148, lowest first */
    double beyond;     /* the sum of the addends that are not finite; 0 if there are none */
} sunder_total;

/* Adds the value to the total. */
SUNDER_EXPERIMENTAL void sunder_total_add(sunder_total *total, double value);
/* Adds to the total all that was added to `part`. */
SUNDER_EXPERIMENTAL void sunder_total_join(sunder_total *total, const sunder_total *part);
/* The double nearest to the sum: infinite if the sum is beyond the range of doubles. If an addend was not finite, the
 * sum of all such addends, which may be NAN. */
SUNDER_EXPERIMENTAL double sunder_total_nearest(const sunder_total *total);
/* The greatest double that is not above the sum: -INFINITY if the sum is below the range of doubles. If an addend was
 * not finite, the same as sunder_total_nearest(). */
SUNDER_EXPERIMENTAL double sunder_total_below(const sunder_total *total);

/* ---- Parts of a layer ----------------------------------------------------------------------------------------- */

/* Worlds and footprints are in a report if sunder_layer_options.keep_worlds was set.
 *
 * A world is a set of features that influenced each other: they were solved together, or they are in conflict or in
 * contact, or a place that was read on behalf of some of them is one where others stood at some time. A world has one
 * or several footprints, each of three boxes. `read` holds the places that were read. `seen` holds the places whose
 * content has to be known: it contains `read`, and blocks that reach into `read` as a whole. `wrote` holds the places
 * where the features stood at any time.
 *
 * Consider a part of a larger layer, with the same options and barriers, that contains each block as a whole or not at
 * all. Let W be a world of the part. If the part has all features of the larger layer that meet the `seen` boxes of W,
 * and no other world of the larger layer has a `wrote` box that meets a `read` box of W, then everything that is
 * reported of the features of W, of their conflicts, and of the proofs of W, is the same for the larger layer, to the
 * last bit. */
typedef struct sunder_footprint {
    size_t world; /* index in sunder_report_worlds() */
    /* xmin ymin xmax ymax of each box; if only fixed features belong to it, `wrote` is empty: xmin > xmax. */
    double read[4], seen[4], wrote[4];
} sunder_footprint;

typedef struct sunder_world {
    size_t first;                 /* the least number of its features */
    size_t footprint, footprints; /* its footprints in sunder_report_footprints(): the first, and their number */
    sunder_conflict_counts before, after;    /* the counts of its conflicts, as in sunder_layer_summary */
    size_t thin, clusters, clusters_optimal; /* as in sunder_layer_summary */
    size_t bound, bounds; /* its bounds in sunder_report_world_bounds(): the first, and their number */
} sunder_world;

/* Returns the worlds, in the order of their first features, and sets *n to their number. */
SUNDER_EXPERIMENTAL const sunder_world *sunder_report_worlds(const sunder_report *report, size_t *n);
/* Returns the footprints, in the order of their worlds, and sets *n to their number. */
SUNDER_EXPERIMENTAL const sunder_footprint *sunder_report_footprints(const sunder_report *report, size_t *n);
/* Two lower bounds of the cost of a part of a world. `proved` is the bound that trees or prices prove, and is part of
 * lower_bound. `by_pairs` is the bound that the least translations of pairs prove, and is part of pair_bound. The other
 * members add up over all parts to the members of the summary that have their names. */
typedef struct sunder_world_bound {
    double proved, by_pairs;
    size_t short_pairs;
    double shortfall, cost_shortfall, cost_alone;
} sunder_world_bound;
/* Returns the bounds of all parts of worlds, in the order of the worlds, and sets *n to their number. The sums of
 * `proved`, `by_pairs` and `cost_alone` over all of them, rounded down, are lower_bound, pair_bound and cost_alone of
 * the summary, and the other sums, rounded to the nearest double, are those of the summary. */
SUNDER_EXPERIMENTAL const sunder_world_bound *sunder_report_world_bounds(const sunder_report *report, size_t *n);
/* Returns the index of the feature's world in sunder_report_worlds(), or SIZE_MAX if the feature is in no world. */
SUNDER_EXPERIMENTAL size_t sunder_report_world(const sunder_report *report, size_t feature);
/* Returns the index of the world to which a conflict or a push of a and b belongs, or SIZE_MAX if it belongs to none. a
 * is a feature; b is a feature or, from the number of features on, a barrier. If one of the two is fixed, it is the
 * world of the other. */
SUNDER_EXPERIMENTAL size_t sunder_report_world_of_pair(const sunder_report *report, size_t a, size_t b);
/* Returns the number of pairs inside blocks that are less than the gap apart and in which this feature has the lower
 * number. A pair that belongs to a world is not counted here, but in the counts of that world. */
SUNDER_EXPERIMENTAL size_t sunder_report_inside(const sunder_report *report, size_t feature);
/* Returns whether the moved coordinates of the feature had to be rounded to doubles. */
SUNDER_EXPERIMENTAL bool sunder_report_rounded(const sunder_report *report, size_t feature);

/* ---- Rows of parts -------------------------------------------------------------------------------------------- */

/* Two neighbours in a row: the features of two different blocks that are nearest to each other, ascending. A feature
 * that stands alone counts as a block. A block has four sides, with at most one neighbour on each: sides 0 and 2 are
 * opposite to each other, and so are sides 1 and 3. A row leaves a block on the side that is opposite to the one it
 * arrives at.
 *
 * Let v be the move of the second block minus that of the first one. If `apart` > 0, the two have to keep the rule of
 * rows: v.along >= gap - apart if some members of the two are in conflict at the start and none remain so, otherwise
 * v.along >= min(0, gap - apart). With K and K' of sunder_layer_options.row_stiffness, and m = (-along[1], along[0]),
 * they have springs that cost weight (K (v.m)^2 + K' (v.along)^2), with v - rest in place of v. */
typedef struct sunder_row_pair {
    size_t feature[2];
    size_t block[2];   /* the first feature of the block of each */
    size_t side[2];    /* the sides of the two blocks that face each other */
    double along[2];   /* the direction of the row, from the first to the second: a unit vector */
    double apart;      /* at the start, the separation of the two blocks along it; negative: they overlap there */
    double offset;     /* at the start, by how much the second is to the left of the first, seen along the row */
    double middle[2];  /* at the start, from the middle of the first to that of the second: along the row, and to its
                        * left; the middles are those of the blocks' extents in these directions */
    double weight;     /* the lesser of the weights of the two blocks */
    double move[2][2]; /* the moves of the two */
    double rest[2];    /* the relative move at which springs are at rest: sunder_layer_set_preferred() */
} sunder_row_pair;

/* Returns the pairs of neighbours in rows, in the order of their features, and sets *n to their number; there are none
 * unless options.rows was set. */
SUNDER_EXPERIMENTAL const sunder_row_pair *sunder_report_row_pairs(const sunder_report *report, size_t *n);
/* Sets `box` to the place that decides which neighbours in rows the block of the feature has. They are those of the
 * larger layer if the part has all of its features and barriers that meet the box. The report has these boxes if
 * options.rows and keep_worlds were set. */
SUNDER_EXPERIMENTAL void sunder_report_row_reach(const sunder_report *report, size_t feature, double box[4]);

/* The rows that pairs of neighbours form, in the order of their features. A struct of zeros is empty. */
typedef struct sunder_row_list {
    sunder_row *row;
    size_t rows;
    size_t *feature; /* the array into which `feature` of all rows points */
} sunder_row_list;

/* Joins n pairs to rows, with the kinks and costs that follow from their moves. Sets *out, which the caller frees with
 * sunder_row_list_free(), and in *summary all that is about rows, and adds cost_rows to `cost`. The pairs may be given
 * in any order, each once. Of the options `gap`, `kink` and `row_stiffness` are used. Fails with SUNDER_EARG if an
 * option is out of its range, or with SUNDER_ENOMEM. */
SUNDER_EXPERIMENTAL sunder_status sunder_rows_make(const sunder_row_pair *pair, size_t n,
                                                   const sunder_layer_options *options, sunder_row_list *out,
                                                   sunder_layer_summary *summary, sunder_error *err);
SUNDER_EXPERIMENTAL void sunder_row_list_free(sunder_row_list *list);

#ifdef __cplusplus
}
#endif
#endif
