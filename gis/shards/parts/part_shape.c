/* part_shape.c: see part_result.h. Shapes are kept as the rings that they were made of, so that the shape made from
 * these is identical. */
#include "shards/parts/part_result.h"

#include "base/array.h"
#include "base/core_error.h"

#include <string.h>

bool gis_part_add_shape(gis_part_result *to, const sunder_shape *shape, gis_part_shape *at, gis_error *error)
{
    const double *xy;
    const size_t *ring_end, *poly_end;
    *at = (gis_part_shape){.corner = to->corners, .end = to->ends};
    at->polygons = sunder_shape_given(shape, &xy, &ring_end, &poly_end);
    if (at->polygons == 0) return true;
    at->rings = poly_end[at->polygons - 1];
    at->vertices = ring_end[at->rings - 1];
    if (!GIS_PART_MORE(to, corner, corners, 2 * at->vertices, error) ||
        !GIS_PART_MORE(to, end, ends, at->rings + at->polygons, error))
        return false;
    memcpy(to->corner + to->corners, xy, 2 * at->vertices * sizeof *xy);
    memcpy(to->end + to->ends, ring_end, at->rings * sizeof *ring_end);
    memcpy(to->end + to->ends + at->rings, poly_end, at->polygons * sizeof *poly_end);
    to->corners += 2 * at->vertices;
    to->ends += at->rings + at->polygons;
    return true;
}

bool gis_part_copy_shape(gis_part_result *to, const gis_part_result *from, gis_part_shape *at, gis_error *error)
{
    const size_t corners = 2 * at->vertices, ends = at->rings + at->polygons;
    if (at->polygons == 0) return true;
    if (!GIS_PART_MORE(to, corner, corners, corners, error) || !GIS_PART_MORE(to, end, ends, ends, error)) return false;
    memcpy(to->corner + to->corners, from->corner + at->corner, corners * sizeof *to->corner);
    memcpy(to->end + to->ends, from->end + at->end, ends * sizeof *to->end);
    at->corner = to->corners;
    at->end = to->ends;
    to->corners += corners;
    to->ends += ends;
    return true;
}

bool gis_part_make_shape(const gis_part_result *from, const gis_part_shape *at, sunder_shape **out, gis_error *error)
{
    const size_t *end = from->end + at->end;
    sunder_error why;
    *out = NULL;
    if (at->polygons == 0) return true;
    return sunder_shape_from_rings(from->corner + at->corner, end, end + at->rings, at->polygons,
                                   SUNDER_VALIDITY_STRICT, out, &why) == SUNDER_OK ||
           gis_core_failed(error, "a shape in the results of a part", &why);
}

bool gis_part_shape_is_sound(const gis_part_result *of, const gis_part_shape *at)
{
    if (at->polygons == 0) return true;
    if (at->vertices > of->corners / 2 || at->corner > of->corners - 2 * at->vertices || at->rings > of->ends ||
        at->polygons > of->ends - at->rings || at->end > of->ends - at->rings - at->polygons)
        return false;
    const size_t *end = of->end + at->end;
    if (at->rings == 0 || end[at->rings - 1] != at->vertices || end[at->rings + at->polygons - 1] != at->rings)
        return false;
    for (size_t k = 1; k < at->rings; k++)
        if (end[k] < end[k - 1]) return false;
    for (size_t k = at->rings + 1; k < at->rings + at->polygons; k++)
        if (end[k] < end[k - 1]) return false;
    return true;
}
