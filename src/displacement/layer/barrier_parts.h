/* Barriers, cut into parts of a few convex pieces, and the pieces of a barrier near a box; see barrier_parts.c. */
#ifndef SUNDER_I_BARRIER_PARTS_H
#define SUNDER_I_BARRIER_PARTS_H

#include "displacement/layer/relate.h"
#include "shape/of_pieces.h"
#include "spatial/rtree.h"

/* All barriers of a layer, cut into parts. A part consists of a few neighbouring convex pieces of one barrier. */
typedef struct sunder_i_barriers {
    uint32_t n, parts;
    sunder_i_piece_of *piece; /* the pieces of all parts, one part after the other */
    uint32_t *piece_end;      /* [parts] index past the last piece of each part */
    uint32_t *barrier;        /* [parts] the number of the barrier that each belongs to; parts of one barrier are
                               * consecutive */
    uint32_t *part_end;       /* [n] index past the last part of each barrier */
    sunder_shape **shape;     /* [parts] the pieces of each as a shape */
    double *half;             /* [n] half of each barrier's width */
    double (*required)[2];    /* [n] half the width plus the gap, as a sum of two doubles: the rounded sum and its
                               * error */
    double (*full)[2];        /* [n] likewise with the full gap, which features keep if it pays; not less */
    double farthest;          /* the greatest full distance, rounded up */
    bool slack;               /* there is a barrier whose full distance is greater than the required one */
    bool flat;                /* at least one piece has no area */
} sunder_i_barriers;

/* Cuts the layer's barriers into parts; their geometry is borrowed. gap, full_gap: those of barriers that have none of
 * their own. After a failure, too, the caller has to call sunder_i_barriers_free(). */
sunder_status sunder_i_barriers_make(const sunder_layer *layer, double gap, double full_gap, sunder_i_barriers *out,
                                     sunder_error *err);
void sunder_i_barriers_free(sunder_i_barriers *barriers);

/* Returns the first part of the barrier that `part` belongs to. */
static inline uint32_t sunder_i_first_part(const sunder_i_barriers *b, uint32_t part)
{
    const uint32_t k = b->barrier[part];
    return k ? b->part_end[k - 1] : 0;
}

/* A distance and the error of its rounding, r[0] + r[1], rounded down and rounded up. */
static inline double sunder_i_rounded_down(const double r[2]) { return r[1] < 0 ? nextafter(r[0], 0) : r[0]; }
static inline double sunder_i_rounded_up(const double r[2]) { return r[1] > 0 ? nextafter(r[0], INFINITY) : r[0]; }

/* The distance that features have to keep from the barrier, rounded down. */
static inline double sunder_i_required_below(const sunder_i_barriers *b, uint32_t barrier)
{
    return sunder_i_rounded_down(b->required[barrier]);
}

/* The distance that features have to keep from the barrier, rounded up. */
static inline double sunder_i_required_above(const sunder_i_barriers *b, uint32_t barrier)
{
    return sunder_i_rounded_up(b->required[barrier]);
}

/* The distance that features keep from the barrier if it pays, rounded down, and rounded up. */
static inline double sunder_i_full_required_below(const sunder_i_barriers *b, uint32_t barrier)
{
    return sunder_i_rounded_down(b->full[barrier]);
}

static inline double sunder_i_full_required_above(const sunder_i_barriers *b, uint32_t barrier)
{
    return sunder_i_rounded_up(b->full[barrier]);
}

/* Sets *out to a shape of those pieces of one barrier whose boxes come within `reach` of `box`; NULL if there are none.
 * With `areas` only pieces that have an area count. `tree` holds part k as item `first` + k. */
sunder_status sunder_i_barrier_near(const sunder_i_barriers *barriers, const sunder_i_rtree *tree, uint32_t first,
                                    uint32_t barrier, const double box[4], double reach, bool areas, sunder_shape **out,
                                    sunder_error *err);

#endif
