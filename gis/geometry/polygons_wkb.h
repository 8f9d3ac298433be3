/* polygons_wkb.h: writes polygons in plain arrays as ISO well-known binary in the machine's byte order; open rings are
 * closed. The arrays are laid out as for sunder_shape_from_rings(). */
#ifndef GIS_POLYGONS_WKB_H
#define GIS_POLYGONS_WKB_H

#include <stdbool.h>
#include <stddef.h>

/* The byte that says which byte order this machine has. */
#define GIS_WKB_NATIVE (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__)

/* The size, and the bytes, of the polygons as a MultiPolygon (multi) or as a Polygon; the latter requires one
 * polygon. */
size_t gis_polygons_wkb_bytes(const double *xy, const size_t *ring_end, const size_t *poly_end, size_t polygons,
                              bool multi);
void gis_polygons_wkb_write(const double *xy, const size_t *ring_end, const size_t *poly_end, size_t polygons,
                            bool multi, unsigned char *to);

#endif
