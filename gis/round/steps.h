/* steps.h: what the files of rounding share with each other, and with whoever makes polygons of rounded vertices. */
#ifndef GIS_ROUND_STEPS_H
#define GIS_ROUND_STEPS_H

#include "round/round.h"

/* Polygons that may have lost a hole in rounding, by number. */
typedef struct gis_suspects {
    size_t *polygon;
    size_t n, capacity;
} gis_suspects;

bool gis_suspect(gis_suspects *suspects, size_t polygon, gis_error *error);
void gis_suspects_clear(gis_suspects *suspects);

/* The two halves of rounding a sum: polygons that are valid each by itself (round.c), and as one multipolygon
 * (apart.c). */
bool gis_round_polygons(const sunder_sum *sum, gis_rounded *out, gis_suspects *suspects, gis_error *error);
bool gis_part_polygons(gis_rounded *rounded, gis_suspects *suspects, gis_error *error);

/* Steps of both (mend.c). Appends a set with every edge bent through the vertices of the set that lie within a few ulps
 * of it, in later rounds within a half; adds how far that moves one to *moved. */
bool gis_bend_set(const gis_polygons *from, int round, gis_polygons *to, double *moved, gis_error *error);
/* Ends the ring that began at vertex `first`, unless it has no area: then it is taken back. */
bool gis_end_ring_with_area(gis_polygons *set, size_t first, bool *kept, gis_error *error);
/* What rings [first, last) are as a polygon. Where rings touch it may be valid in the sense of SUNDER_VALIDITY_STRICT
 * alone: an interior that falls apart, a ring that meets itself. False only where the question cannot be answered. */
typedef enum gis_polygon_state { GIS_POLYGON_BROKEN, GIS_POLYGON_TOUCHES, GIS_POLYGON_WELL } gis_polygon_state;
bool gis_polygon_look(const gis_polygons *set, size_t first, size_t last, gis_error *error, gis_polygon_state *state);
/* Appends rings [first, last) of another set, which touch, as polygons that are valid in the sense of OGC; their
 * corners are the same. */
bool gis_settle_polygon(gis_polygons *set, const gis_polygons *from, size_t first, size_t last, gis_error *error);
/* Replaces rings [first, set->rings) by valid polygons, and raises *moved to how far that moves a boundary. */
bool gis_mend_polygon(gis_polygons *set, size_t first, double *moved, gis_error *error);
/* Ends the polygon of rings [first, set->rings), which are not one yet, as what it is or, if that is not valid in the
 * sense of OGC, as the polygons that it is mended to; those are counted. */
bool gis_end_valid_polygon(gis_polygons *set, size_t first, double *moved, size_t *repaired, gis_error *error);
/* Where the point of the segment ab that is next to c lies, from 0 to 1 (beyond: outside), and how far c is *off, where
 * lengths along each axis are measured in its own unit. */
double gis_place_along(const double *a, const double *b, const double *c, const double unit[2], double *off);
/* The unit in the last place of a double. */
double gis_ulp(double x);

#endif
