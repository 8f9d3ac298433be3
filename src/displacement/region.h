/* Where one body of a pair may stand relative to the other: a convex polygon around all that is free of a disc. */
#ifndef SUNDER_I_REGION_H
#define SUNDER_I_REGION_H

#include "displacement/displacement.h"

/* A region has no more corners than this; a cut that would make more is left out, which makes the region larger. */
#define SUNDER_I_REGION_CORNERS 64

/* Convex, counter-clockwise; no corners: nothing is free. */
typedef struct sunder_i_region {
    size_t n;
    double xy[2 * SUNDER_I_REGION_CORNERS];
} sunder_i_region;

/* Relative moves u of Q that make its interior meet P's, of pairs that are r apart at most: the boundary of P + (-Q)
 * within reach, its degenerate holes among them. */
typedef struct sunder_i_obstruction {
    double r;
    double *segment; /* [4 * segments] */
    size_t walls;    /* the first of them: those that bound the interior */
    size_t segments;
} sunder_i_obstruction;

sunder_status sunder_i_obstruction_of(const sunder_shape *p, const sunder_shape *q, double r, sunder_i_obstruction *out,
                                      sunder_error *err);
void sunder_i_obstruction_free(sunder_i_obstruction *obstruction);

/* A polygon around the disc of radius r. */
void sunder_i_region_disc(double r, sunder_i_region *region);
/* Keeps what has n.u >= h, for a unit vector n. */
void sunder_i_region_cut(sunder_i_region *region, const double n[2], double h);
/* Shrinks the region to what lies around its free places. */
void sunder_i_region_tighten(sunder_i_region *region, const sunder_i_obstruction *obstruction);

#endif
