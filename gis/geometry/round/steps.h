/* steps.h: functions that the rounding files share, also used to make polygons of rounded vertices. */
#ifndef GIS_STEPS_H
#define GIS_STEPS_H

#include "geometry/round/round.h"

/* Polygons that may have lost a hole in rounding, by number. */
typedef struct gis_suspects {
    size_t *polygon;
    size_t n, capacity;
} gis_suspects;

bool gis_suspect(gis_suspects *suspects, size_t polygon, gis_error *error);
void gis_suspects_clear(gis_suspects *suspects);

/* The two halves of rounding a sum: polygons that are valid each by itself (round_polygons.c), and as one multipolygon
 * (mend_multipolygon.c). */
bool gis_round_polygons(const sunder_sum *sum, gis_rounded *out, gis_suspects *suspects, gis_error *error);
bool gis_mend_multipolygon(gis_rounded *rounded, gis_suspects *suspects, gis_error *error);

/* Steps of both (mend_polygon.c). Appends a set with every edge bent through the vertices of the set that lie within
 * GIS_BEND_ULPS of it, in later rounds within GIS_PIXEL_ULPS (constants.h); adds how far that moves one to *moved. */
bool gis_bend_set(const gis_polygons *from, int round, gis_polygons *to, double *moved, gis_error *error);
/* Ends the ring that began at vertex `first`, unless it has no area: then it is taken back. */
bool gis_end_ring_with_area(gis_polygons *set, size_t first, bool *kept, gis_error *error);
/* Ends the polygon of rings [first, set->rings), which are not one yet, as what it is or, if that is not valid in the
 * sense of OGC, as the polygons that it is mended to; those are counted. */
bool gis_end_valid_polygon(gis_polygons *set, size_t first, double *moved, size_t *repaired, gis_error *error);
/* The foot of c on the line ab, as a fraction of ab: 0 at a, 1 at b, others beyond the two. *off: how far c is from the
 * segment ab. Lengths along each axis are in units of its own. */
double gis_place_along(const double *a, const double *b, const double *c, const double unit[2], double *off);
static inline bool gis_same_vertex(const double *a, const double *b) { return a[0] == b[0] && a[1] == b[1]; }
/* The unit in the last place of a double (deviation.c). */
double gis_ulp(double x);

#endif
