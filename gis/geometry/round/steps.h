/* steps.h: functions that the files of rounding share; also used for polygons of rounded vertices. */
#ifndef GIS_STEPS_H
#define GIS_STEPS_H

#include "geometry/round/round.h"

/* Numbers of polygons that may have lost a hole by rounding. */
typedef struct gis_suspects {
    size_t *polygon;
    size_t n, capacity;
} gis_suspects;

bool gis_suspect(gis_suspects *suspects, size_t polygon, gis_error *error);
void gis_suspects_clear(gis_suspects *suspects);

/* The two steps of rounding a sum: polygons that are valid by themselves (round_polygons.c), and as one multipolygon
 * (mend_multipolygon.c). */
bool gis_round_polygons(const sunder_sum *sum, gis_rounded *out, gis_suspects *suspects, gis_error *error);
bool gis_mend_multipolygon(gis_rounded *rounded, gis_suspects *suspects, gis_error *error);

/* Used by both (mend_polygon.c). Appends a set with every edge bent through the set's vertices within GIS_BEND_ULPS of
 * it, in later rounds within GIS_PIXEL_ULPS (constants.h); adds the largest distance by which an edge is moved to
 * *moved. */
bool gis_bend_set(const gis_polygons *from, int round, gis_polygons *to, double *moved, gis_error *error);
/* Ends the ring that began at vertex `first`; if it has no area it is removed instead, and *kept is false. */
bool gis_end_ring_with_area(gis_polygons *set, size_t first, bool *kept, gis_error *error);
/* Ends the polygon of the rings first ... set->rings - 1. If it is not valid in the sense of OGC it is replaced by the
 * polygons that mending makes of it, and *repaired is raised. */
bool gis_end_valid_polygon(gis_polygons *set, size_t first, double *moved, size_t *repaired, gis_error *error);
/* The position of c's projection on the line ab, as a fraction of ab: 0 at a, 1 at b. *off is the distance of c from
 * the segment ab. Each axis is measured in its own unit. */
double gis_place_along(const double *a, const double *b, const double *c, const double unit[2], double *off);
static inline bool gis_same_vertex(const double *a, const double *b) { return a[0] == b[0] && a[1] == b[1]; }
/* The unit in the last place of a double (deviation.c). */
double gis_ulp(double x);

#endif
