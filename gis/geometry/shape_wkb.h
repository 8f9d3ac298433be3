/* shape_wkb.h: writes the polygons of a shape, with the vertices that it was given, as ISO well-known binary in the
 * machine's byte order; open rings are closed. */
#ifndef GIS_SHAPE_WKB_H
#define GIS_SHAPE_WKB_H

#include <cpl_port.h>
#include <ogr_core.h>

#include "sunder.h"

/* The byte order of this machine: doubles in this order can be copied without swapping. */
#ifdef CPL_LSB
#define GIS_WKB_ORDER wkbNDR
#else
#define GIS_WKB_ORDER wkbXDR
#endif

/* The size, and the bytes, of a shape as a MultiPolygon (multi) or as a Polygon; the latter requires a shape of one
 * polygon. */
size_t gis_shape_wkb_bytes(const sunder_shape *shape, bool multi);
void gis_shape_wkb_write(const sunder_shape *shape, bool multi, unsigned char *to);

#endif
