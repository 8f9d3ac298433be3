/* Convex regions of relative moves that the cuts of a node leave to a pair; see region.c. */
#ifndef SUNDER_I_REGION_H
#define SUNDER_I_REGION_H

#include "displacement/prove/optimum/forbidden.h"

#define SUNDER_I_REGION_CORNERS 40
/* Marks a side of a region that is not from a cut. */
#define SUNDER_I_NO_CUT UINT32_MAX

/* A convex polygon, counter-clockwise. The true region, of all u that satisfy the cuts made up to now exactly, lies
 * within `blur` of it. n = 0: the region is empty. */
typedef struct sunder_i_region {
    uint32_t n;
    double xy[2 * SUNDER_I_REGION_CORNERS];
    uint32_t cut[SUNDER_I_REGION_CORNERS]; /* the cut that made the side from corner k */
    double blur;
} sunder_i_region;

/* ---- region.c ---------------------------------------------------------------------------------------------------- */

/* Sets *region to the square of half side `reach` around `centre`. */
void sunder_i_region_init(sunder_i_region *region, const double centre[2], double reach);
/* Clips the region to n.u >= d; |n| is 1 up to rounding. */
void sunder_i_region_clip(sunder_i_region *region, const double n[2], double d, uint32_t cut, double grain);
/* Returns how far u is beyond the side of the region that it is farthest beyond, 0 if it is beyond none, and sets *cut
 * to the cut of that side. Sides not made by a cut do not count. */
double sunder_i_region_beyond(const sunder_i_region *region, const double u[2], uint32_t *cut);

/* ---- covered_region.c -------------------------------------------------------------------------------------------- */

/* A function of u: d - n.u, divided by the share. */
typedef struct sunder_i_slope {
    double n[2], d, share;
} sunder_i_slope;

static inline double sunder_i_slope_at(const sunder_i_slope *slope, const double u[2])
{
    return (slope->d - (slope->n[0] * u[0] + slope->n[1] * u[1])) / slope->share;
}

/* Is it proved that each u of the true region is forbidden, or lacks more than the slope at u? used, steps, gap: as
 * below. */
bool sunder_i_region_lacks(const sunder_i_region *region, const sunder_i_forbidden *forbidden,
                           const sunder_i_slope *slope, bool *used, double gap[2], uint64_t *steps);
/* Is it proved that the true region lies in the forbidden set? used: NULL, or [forbidden->pieces], where the pieces
 * used by the proof are marked. gap: NULL, or receives a place of the region that shows why it is not covered: a place
 * in no piece, or next to such a place; NAN if none was found. *steps grows by the work done. */
bool sunder_i_region_is_covered(const sunder_i_region *region, const sunder_i_forbidden *forbidden, bool *used,
                                double gap[2], uint64_t *steps);

typedef struct sunder_i_regions {
    sunder_i_region *item;
    size_t n, capacity;
} sunder_i_regions;

/* Proves that the region lies in the forbidden set, except for small regions, which are appended to *left. Returns
 * false if memory is out. */
bool sunder_i_region_cover(const sunder_i_region *region, const sunder_i_forbidden *forbidden, sunder_i_regions *left,
                           uint64_t *steps);

/* ---- free_hull.c ------------------------------------------------------------------------------------------------- */

/* Reflex corners: places where the boundaries of two pieces cross outside of all others, in doubles. */
typedef struct sunder_i_reflex {
    double (*place)[2];
    size_t n, capacity;
    size_t cover; /* the piece that covered the last place that was not free, as a guess for the next one */
} sunder_i_reflex;

bool sunder_i_reflex_find(sunder_i_reflex *reflex, const sunder_i_forbidden *forbidden, uint64_t *steps);
/* For many pieces only the reflex corners that are needed are looked for, one by one: from a free place of the region,
 * downhill in the direction `down` until no free path leads farther down. Returns false if memory is out. */
bool sunder_i_reflex_seek(sunder_i_reflex *reflex, const sunder_i_forbidden *forbidden, const sunder_i_region *region,
                          const double from[2], const double down[2], uint64_t *steps);

/* The free parts of a region's sides: places where they begin and end; for many pieces only the first and last place of
 * each side. The last region that was examined is remembered with them. */
typedef struct sunder_i_free_sides {
    sunder_i_region region;
    bool any;                                    /* a region was examined */
    uint32_t first[SUNDER_I_REGION_CORNERS + 1]; /* the places of side k are first[k] .. first[k + 1] - 1 */
    uint64_t steps[SUNDER_I_REGION_CORNERS];     /* the work it took to find them */
    double (*place)[2];
    size_t n, capacity;
} sunder_i_free_sides;

/* Finds the free parts of a region's sides. Sides that are among those of `known`, which may be the same struct, are
 * copied. Returns false if memory is out. */
bool sunder_i_free_sides_find(sunder_i_free_sides *sides, const sunder_i_free_sides *known,
                              const sunder_i_region *region, const sunder_i_forbidden *forbidden, uint64_t *steps);

/* Sets `place` to the point nearest to u of the convex hull of the free part of a region, in doubles; for many pieces,
 * of its known part. Returns false if nothing is free. */
bool sunder_i_free_hull_nearest(const sunder_i_free_sides *sides, const sunder_i_forbidden *forbidden,
                                const sunder_i_reflex *reflex, const double u[2], double place[2], uint64_t *steps);

#endif
