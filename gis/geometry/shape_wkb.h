/* shape_wkb.h: the polygons of a shape as they were given, as well-known binary: ISO's, in the machine's own order;
 * rings that lack the closing vertex are closed. */
#ifndef GIS_SHAPE_WKB_H
#define GIS_SHAPE_WKB_H

#include <cpl_port.h>
#include <ogr_core.h>

#include "sunder.h"

/* The machine's order of bytes: doubles can be taken as they stand. */
#ifdef CPL_LSB
#define GIS_WKB_ORDER wkbNDR
#else
#define GIS_WKB_ORDER wkbXDR
#endif

/* As a MultiPolygon, or else a Polygon, which a shape of one polygon can be. */
size_t gis_shape_wkb_bytes(const sunder_shape *shape, bool multi);
void gis_shape_wkb_write(const sunder_shape *shape, bool multi, unsigned char *to);

#endif
