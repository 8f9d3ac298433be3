/* Convex regions of relative moves: what the cuts of a node leave to a pair; see region.c. */
#ifndef SUNDER_I_REGION_H
#define SUNDER_I_REGION_H

#include "displacement/prove/optimum/forbidden.h"

#define SUNDER_I_REGION_CORNERS 40
/* The side of a region that no cut made. */
#define SUNDER_I_NO_CUT UINT32_MAX

/* A convex polygon, counter-clockwise; everything within `blur` of it contains the true region, of all u that keep the
 * cuts made so far, exactly. n = 0: the region is empty. */
typedef struct sunder_i_region {
    uint32_t n;
    double xy[2 * SUNDER_I_REGION_CORNERS];
    uint32_t cut[SUNDER_I_REGION_CORNERS]; /* that made the side from corner k */
    double blur;
} sunder_i_region;

/* ---- region.c ---------------------------------------------------------------------------------------------------- */

/* The square of half side `reach` about a place. */
void sunder_i_region_init(sunder_i_region *region, const double centre[2], double reach);
/* Keeps what has n.u >= d; |n| is 1 up to rounding. */
void sunder_i_region_clip(sunder_i_region *region, const double n[2], double d, uint32_t cut, double grain);
/* The side that u is farthest beyond: its cut, and how far. Sides that no cut made do not count. */
double sunder_i_region_beyond(const sunder_i_region *region, const double u[2], uint32_t *cut);

/* ---- covered_region.c -------------------------------------------------------------------------------------------- */

/* Is the true region proved to be within the forbidden set? used: NULL, or [forbidden->pieces], where the pieces
 * that the proof uses are marked. gap: NULL, or receives a place of the region that shows why it is not covered.
 * This place is in no piece, or next to a place in none; it is NAN if none was met. steps: grows by the work done. */
bool sunder_i_region_is_covered(const sunder_i_region *region, const sunder_i_forbidden *forbidden, bool *used,
                                double gap[2], uint64_t *steps);

typedef struct sunder_i_regions {
    sunder_i_region *item;
    size_t n, capacity;
} sunder_i_regions;

/* Covers what it can: all of the region is proved to be within the forbidden set but for what is left, which is added
 * to the list. False if memory is out. */
bool sunder_i_region_cover(const sunder_i_region *region, const sunder_i_forbidden *forbidden, sunder_i_regions *left,
                           uint64_t *steps);

/* ---- free_hull.c ------------------------------------------------------------------------------------------------- */

/* Places where the boundaries of two pieces cross outside of all others, in doubles. */
typedef struct sunder_i_reflex {
    double (*place)[2];
    size_t n, capacity;
    size_t cover; /* the number of the piece that covered the last place that was not free: a guess for the next */
} sunder_i_reflex;

bool sunder_i_reflex_find(sunder_i_reflex *reflex, const sunder_i_forbidden *forbidden, uint64_t *steps);
/* With many pieces only the relevant reflex corners are searched for, one by one: from a free place of the region,
 * downhill along `down` until no free path leads farther, or hardly. False if memory is out. */
bool sunder_i_reflex_seek(sunder_i_reflex *reflex, const sunder_i_forbidden *forbidden, const sunder_i_region *region,
                          const double from[2], const double down[2], uint64_t *steps);

/* What the forbidden set leaves of a region's sides: the ends of it, of many pieces the first and the last of a side.
 * The region that was asked of last is known, side by side. */
typedef struct sunder_i_free_sides {
    sunder_i_region region;
    bool any;                                    /* was one asked of? */
    uint32_t first[SUNDER_I_REGION_CORNERS + 1]; /* of its side k the places from first[k] to first[k + 1] */
    uint64_t steps[SUNDER_I_REGION_CORNERS];     /* that it took to find them */
    double (*place)[2];
    size_t n, capacity;
} sunder_i_free_sides;

/* Of sides that `known` has, which may be the same, what it tells is taken. False if memory is out. */
bool sunder_i_free_sides_find(sunder_i_free_sides *sides, const sunder_i_free_sides *known,
                              const sunder_i_region *region, const sunder_i_forbidden *forbidden, uint64_t *steps);

/* The place nearest to u of the convex hull of the part of a region, with these sides, that the forbidden set leaves,
 * in doubles; with many pieces, of the part that is known. False: it leaves nothing. */
bool sunder_i_free_hull_nearest(const sunder_i_free_sides *sides, const sunder_i_forbidden *forbidden,
                                const sunder_i_reflex *reflex, const double u[2], double place[2], uint64_t *steps);

#endif
