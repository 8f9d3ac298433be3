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
    uint32_t classes;         /* the number of classes of features for gaps; 1 if the layer has one gap */
    double (*required)[2];    /* [n * classes] half the width plus the gap to each class, as a sum of two doubles: the
                               * rounded sum and its error */
    double (*full)[2];        /* [n * classes] likewise with the full gap, which features keep if it pays; not less */
    double farthest;          /* the greatest full distance, rounded up */
    bool slack;               /* there is a barrier whose full distance is greater than the required one */
    bool flat;                /* at least one piece has no area */
} sunder_i_barriers;

/* Cuts the layer's barriers into parts; their geometry is borrowed. The rules have the gaps of barriers that have none
 * of their own. After a failure, too, the caller has to call sunder_i_barriers_free(). */
sunder_status sunder_i_barriers_make(const sunder_layer *layer, const sunder_i_rules *rules, sunder_i_barriers *out,
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

/* The distance that features of a class have to keep from the barrier. */
static inline const double *sunder_i_required(const sunder_i_barriers *b, uint32_t barrier, uint32_t of)
{
    return b->required[(size_t)barrier * b->classes + of];
}

/* The distance that features of a class keep from the barrier if it pays. */
static inline const double *sunder_i_full_required(const sunder_i_barriers *b, uint32_t barrier, uint32_t of)
{
    return b->full[(size_t)barrier * b->classes + of];
}

/* The least distance that features of some class have to keep from the barrier, rounded down. */
static inline double sunder_i_required_least(const sunder_i_barriers *b, uint32_t barrier)
{
    double least = INFINITY;
    for (uint32_t k = 0; k < b->classes; k++)
        least = fmin(least, sunder_i_rounded_down(sunder_i_required(b, barrier, k)));
    return least;
}

/* The greatest distance that features of some class have to keep from the barrier, rounded up, and likewise the one
 * that they keep if it pays. */
static inline double sunder_i_required_most(const sunder_i_barriers *b, uint32_t barrier)
{
    double most = 0;
    for (uint32_t k = 0; k < b->classes; k++) most = fmax(most, sunder_i_rounded_up(sunder_i_required(b, barrier, k)));
    return most;
}

static inline double sunder_i_full_required_most(const sunder_i_barriers *b, uint32_t barrier)
{
    double most = 0;
    for (uint32_t k = 0; k < b->classes; k++)
        most = fmax(most, sunder_i_rounded_up(sunder_i_full_required(b, barrier, k)));
    return most;
}

/* Sets *out to a shape of those pieces of one barrier whose boxes come within `reach` of `box`; NULL if there are none.
 * With `areas` only pieces that have an area count. `tree` holds part k as item `first` + k. */
sunder_status sunder_i_barrier_near(const sunder_i_barriers *barriers, const sunder_i_rtree *tree, uint32_t first,
                                    uint32_t barrier, const double box[4], double reach, bool areas, sunder_shape **out,
                                    sunder_error *err);

#endif
