/* round.h: rounds exact polygons to valid polygons in doubles, with a bound on the deviation. */
#ifndef GIS_ROUND_H
#define GIS_ROUND_H

#include "geometry/polygons.h"

/* The polygons of a sum in doubles, each valid in the sense of OGC simple features, and all together a valid
 * multipolygon. deviation: no point of their boundaries is farther than this from the exact boundary. (The converse
 * does not hold: a needle or hole thinner than an ulp may have been dropped.) */
typedef struct gis_rounded {
    gis_polygons set;
    double deviation;
    size_t repaired; /* number of polygons, and of groups of polygons, that were mended */
} gis_rounded;

/* Fails if a vertex is beyond the range of doubles, or a polygon cannot be mended. */
bool gis_round_sum(const sunder_sum *sum, gis_rounded *out, gis_error *error);
void gis_rounded_clear(gis_rounded *rounded);

/* Removes vertices that are straight up to a few ulps (straight.c), which a turned, and so rounded, shape leaves in
 * walls. */
bool gis_straighten(gis_rounded *rounded, gis_error *error);

/* A bound on |exact - x|, where x is the double nearest to `exact`, a number written by the core as "num" or "num/den":
 * 0 if they are equal, else half an ulp. */
double gis_text_deviation(const char *exact, double x);
/* Sets *deviation to a bound on the distance between a vertex of the sum and its nearest doubles; infinite if these are
 * out of range. */
bool gis_vertex_deviation(const sunder_sum *sum, uint32_t vertex, double *deviation, gis_error *error);

#endif
