/* wkt.h: POLYGON and MULTIPOLYGON texts into plain arrays. Decimals become the nearest doubles, whatever their length;
 * Z and M are read and dropped; EMPTY is the empty set. Other types, and anything else, are errors that name the
 * place. */
#ifndef GIS_WKT_H
#define GIS_WKT_H

#include "base/polygons.h"

/* Does the text begin as WKT does: a word, then Z, M, EMPTY or a bracket? */
bool gis_wkt_looks_like(const char *text);

/* Appends the polygons of the text. `who` opens the message of a failure. */
bool gis_wkt_read(const char *text, const char *who, gis_polygons *out, gis_error *error);

#endif
