/* Barriers as things that features stand near: in parts, and what of each lies about a feature; see barrier_parts.c. */
#ifndef SUNDER_I_BARRIER_PARTS_H
#define SUNDER_I_BARRIER_PARTS_H

#include "displacement/layer/relate.h"
#include "shape/of_pieces.h"
#include "spatial/rtree.h"

/* The barriers of a layer in parts: a few convex pieces each that lie together, of one barrier. */
typedef struct sunder_i_barriers {
    uint32_t n, parts;
    sunder_i_piece_of *piece; /* of all parts, one after the other */
    uint32_t *piece_end;      /* [parts] index past the last piece of each */
    uint32_t *barrier;        /* [parts] whose they are; those of one barrier follow each other */
    uint32_t *part_end;       /* [n] index past the last part of each barrier */
    sunder_shape **shape;     /* [parts] */
    double *half;             /* [n] half the width */
    double (*required)[2];    /* [n] half the width, and the gap: the sum of two doubles, rounded and the rest */
    double farthest;          /* the greatest of these, rounded up */
    bool flat;                /* some piece has no area */
} sunder_i_barriers;

/* The parts of the layer's barriers, whose geometry is borrowed; gap: for barriers without their own. On failure the
 * caller still calls sunder_i_barriers_free(). */
sunder_status sunder_i_barriers_make(const sunder_layer *layer, double gap, sunder_i_barriers *out, sunder_error *err);
void sunder_i_barriers_free(sunder_i_barriers *barriers);

/* The first part of the barrier that a part is of. */
static inline uint32_t sunder_i_first_part(const sunder_i_barriers *b, uint32_t part)
{
    const uint32_t k = b->barrier[part];
    return k ? b->part_end[k - 1] : 0;
}

/* What features are to keep from a barrier, rounded down, and up. */
static inline double sunder_i_required_below(const sunder_i_barriers *b, uint32_t barrier)
{
    const double *r = b->required[barrier];
    return r[1] < 0 ? nextafter(r[0], 0) : r[0];
}

static inline double sunder_i_required_above(const sunder_i_barriers *b, uint32_t barrier)
{
    const double *r = b->required[barrier];
    return r[1] > 0 ? nextafter(r[0], INFINITY) : r[0];
}

/* The pieces of one barrier that come within reach of a box, as a shape; NULL: none do. areas: of those that have an
 * area. tree: holds parts as items from `first` on. */
sunder_status sunder_i_barrier_near(const sunder_i_barriers *barriers, const sunder_i_rtree *tree, uint32_t first,
                                    uint32_t barrier, const double box[4], double reach, bool areas, sunder_shape **out,
                                    sunder_error *err);

#endif
