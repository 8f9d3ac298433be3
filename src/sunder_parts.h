/* sunder_parts.h: a layer that is separated in parts, each with what is near to it, and gives the result of the whole.
 *
 * The report of a part says which of its features had nothing to do with anything beyond what the part knew; see
 * sunder_footprint. All of this header is experimental: see sunder.h and docs/api.md. */
#ifndef SUNDER_PARTS_H
#define SUNDER_PARTS_H

#include "sunder.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Sums of many doubles --------------------------------------------------------------------------------- */

/* What was added to it, exactly: so a sum over parts, in any order, is the whole's. It holds 2^60 addends of any size.
 * Zeroed: 0. Source: the long accumulator of [Kul13, section 8]. */
typedef struct sunder_total {
    uint64_t limb[67]; /* two's complement, in units of 2^-2148, lowest first */
    double beyond;     /* the sum of those that were not finite */
} sunder_total;

SUNDER_EXPERIMENTAL void sunder_total_add(sunder_total *total, double value);
/* All that was added to `part`. */
SUNDER_EXPERIMENTAL void sunder_total_join(sunder_total *total, const sunder_total *part);
/* The nearest double, and the greatest that is no more. Infinite past the range, or where an addend was. */
SUNDER_EXPERIMENTAL double sunder_total_nearest(const sunder_total *total);
SUNDER_EXPERIMENTAL double sunder_total_below(const sunder_total *total);

/* ---- Parts of a layer ----------------------------------------------------------------------------------------- */

/* Available if keep_worlds was asked for.
 *
 * A world is a set of features that influenced each other: they were solved together, are in conflict or in contact, or
 * a place read on behalf of some of them was one where others stood at some time. Its footprints are boxes: the places
 * that were read, the contents that must be known there (seen: blocks that reach there, whole), and where its features
 * stood from the first moment to the last (wrote).
 *
 * Consider a part of a larger layer, with the same options and barriers, which has either all features of a block or
 * none. If it has all features of the larger layer that meet what one of its worlds saw, and no other world of the
 * larger one wrote where that one read, then everything reported of the world's features, of the conflicts between them
 * or with others, and of its proofs, is what is reported of them in the larger layer, to the last bit. */
typedef struct sunder_footprint {
    size_t world;
    /* xmin ymin xmax ymax; everything read was seen. A fixed feature wrote nothing: xmin > xmax. */
    double read[4], seen[4], wrote[4];
} sunder_footprint;

typedef struct sunder_world {
    size_t first;                 /* the first of its features */
    size_t footprint, footprints; /* of those of the report */
    sunder_conflict_counts before, after;
    size_t thin, clusters, clusters_optimal;
    size_t bound, bounds; /* of those of the report */
} sunder_world;

/* By their first features. */
SUNDER_EXPERIMENTAL const sunder_world *sunder_report_worlds(const sunder_report *report, size_t *n);
/* By worlds. */
SUNDER_EXPERIMENTAL const sunder_footprint *sunder_report_footprints(const sunder_report *report, size_t *n);
/* What is proved of a part of a world, with trees by these where they are kept; and what its pairs prove. */
typedef struct sunder_world_bound {
    double proved, by_pairs;
} sunder_world_bound;
/* By worlds; lower_bound and pair_bound are the sums over all. */
SUNDER_EXPERIMENTAL const sunder_world_bound *sunder_report_world_bounds(const sunder_report *report, size_t *n);
/* The number of the feature's world; SIZE_MAX: it is of none. */
SUNDER_EXPERIMENTAL size_t sunder_report_world(const sunder_report *report, size_t feature);
/* The world that a conflict or a push belongs to, of two features or a feature and a barrier: that of the movable one,
 * if the other is fixed. SIZE_MAX: none. */
SUNDER_EXPERIMENTAL size_t sunder_report_world_of_pair(const sunder_report *report, size_t a, size_t b);
/* How many pairs inside the block whose first feature this is are not the gap apart; 0 where the block is in a world,
 * which has counted them. */
SUNDER_EXPERIMENTAL size_t sunder_report_inside(const sunder_report *report, size_t feature);
/* Could its translate not be held in doubles? */
SUNDER_EXPERIMENTAL bool sunder_report_rounded(const sunder_report *report, size_t feature);

#ifdef __cplusplus
}
#endif
#endif
