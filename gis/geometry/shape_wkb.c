/* shape_wkb.c: see shape_wkb.h. */
#include "geometry/shape_wkb.h"

#include "geometry/polygons_wkb.h"

size_t gis_shape_wkb_bytes(const sunder_shape *shape, bool multi)
{
    const double *xy;
    const size_t *ring_end, *poly_end, polygons = sunder_shape_given(shape, &xy, &ring_end, &poly_end);
    return gis_polygons_wkb_bytes(xy, ring_end, poly_end, polygons, multi);
}

void gis_shape_wkb_write(const sunder_shape *shape, bool multi, unsigned char *to)
{
    const double *xy;
    const size_t *ring_end, *poly_end, polygons = sunder_shape_given(shape, &xy, &ring_end, &poly_end);
    gis_polygons_wkb_write(xy, ring_end, poly_end, polygons, multi, to);
}
