/* wkt.h: parses POLYGON and MULTIPOLYGON texts into plain arrays. Decimals are rounded to the nearest doubles, whatever
 * their length; Z and M are skipped, as is the SRID of PostGIS in front (SRID=4326;POLYGON ...); EMPTY is the empty
 * set. Other types, and anything else, are errors that name the place. */
#ifndef GIS_WKT_H
#define GIS_WKT_H

#include "geometry/polygons.h"

/* The text behind "SRID=N;", and N in *srid; the text itself, and *srid = 0, if it does not begin so. */
const char *gis_wkt_after_srid(const char *text, int *srid);

/* Does the text, after an SRID, begin like WKT: a word, then Z, M, ZM, EMPTY or a parenthesis? */
bool gis_wkt_looks_like(const char *text);

/* Appends the polygons of the text. `who` begins the error message. */
bool gis_wkt_read(const char *text, const char *who, gis_polygons *out, gis_error *error);

#endif
