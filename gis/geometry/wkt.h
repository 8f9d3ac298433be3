/* wkt.h: POLYGON and MULTIPOLYGON texts into plain arrays. Decimals become the nearest doubles, whatever their length;
 * Z and M are read and dropped, and so is the SRID of PostGIS in front (SRID=4326;POLYGON ...); EMPTY is the empty
 * set. Other types, and anything else, are errors that name the place. */
#ifndef GIS_WKT_H
#define GIS_WKT_H

#include "geometry/polygons.h"

/* What follows "SRID=N;" at the beginning of the text; the text itself, and *srid = 0, where that is not there. */
const char *gis_wkt_after_srid(const char *text, int *srid);

/* Does the text, after an SRID, begin as WKT does: a word, then Z, M, EMPTY or a bracket? */
bool gis_wkt_looks_like(const char *text);

/* Appends the polygons of the text. `who` opens the message of a failure. */
bool gis_wkt_read(const char *text, const char *who, gis_polygons *out, gis_error *error);

#endif
