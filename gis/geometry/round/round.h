/* round.h: exact polygons as doubles: valid, and no farther off than is said. */
#ifndef GIS_ROUND_H
#define GIS_ROUND_H

#include "geometry/polygons.h"

/* The polygons of a sum in doubles, each valid in the sense of OGC simple features, and so all as one multipolygon.
 * deviation: no point of their boundaries is farther than this from the exact boundary. (The other way round that does
 * not hold: a needle or a hole thinner than an ulp may be gone.) */
typedef struct gis_rounded {
    gis_polygons set;
    double deviation;
    size_t repaired; /* polygons that rounding would have broken, and groups of them that it would have made overlap */
} gis_rounded;

/* Fails where a vertex leaves the range of doubles, or a polygon cannot be mended. */
bool gis_round_sum(const sunder_sum *sum, gis_rounded *out, gis_error *error);
void gis_rounded_clear(gis_rounded *rounded);

/* Takes corners out that are straight but for a few units in the last place (straight.c): those that a shape which was
 * turned, and so rounded, leaves in walls. */
bool gis_straighten(gis_rounded *rounded, gis_error *error);

/* A bound of |exact - x| where x is the double nearest to exact, which is "num" or "num/den" as the core writes it: 0
 * if they are equal, else half a unit in the last place. */
double gis_text_deviation(const char *exact, double x);
/* A bound of the distance from a vertex of the sum to its nearest doubles; infinite beyond their range. */
bool gis_vertex_deviation(const sunder_sum *sum, uint32_t vertex, double *deviation, gis_error *error);

#endif
