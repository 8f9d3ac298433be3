/* polygons.c: see polygons.h. Vertices, rings and polygons are counted from the start of the set, so the last ones are
 * removed by reducing the counts. Whether a signal has arrived is tested wherever vertices are added, since all work
 * that makes many of them passes here. */
#include "geometry/polygons.h"

#include "base/array.h"
#include "base/interrupt.h"

#include <stdlib.h>
#include <string.h>

void gis_polygons_clear(gis_polygons *set)
{
    free(set->xy);
    free(set->ring_end);
    free(set->poly_end);
    *set = (gis_polygons){0};
}

static bool reserve_array(void *array, size_t *capacity, size_t needed, size_t size, gis_error *error)
{
    return gis_array_reserve(array, capacity, needed, size) || gis_no_memory(error);
}

bool gis_polygons_reserve(gis_polygons *set, size_t vertices, gis_error *error)
{
    return gis_go_on(error) &&
           reserve_array(&set->xy, &set->xy_capacity, set->vertices + vertices, 2 * sizeof *set->xy, error);
}

bool gis_polygons_vertex(gis_polygons *set, double x, double y, gis_error *error)
{
    if (!gis_polygons_reserve(set, 1, error)) return false;
    set->xy[2 * set->vertices] = x;
    set->xy[2 * set->vertices + 1] = y;
    set->vertices++;
    return true;
}

bool gis_polygons_end_ring(gis_polygons *set, gis_error *error)
{
    if (!reserve_array(&set->ring_end, &set->ring_capacity, set->rings + 1, sizeof *set->ring_end, error)) return false;
    set->ring_end[set->rings++] = set->vertices;
    return true;
}

bool gis_polygons_end_closed_ring(gis_polygons *set, gis_error *error)
{
    const size_t first = set->rings ? set->ring_end[set->rings - 1] : 0, n = set->vertices - first;
    const double *xy = set->xy + 2 * first;
    if (n > 1 && memcmp(xy, xy + 2 * (n - 1), 2 * sizeof *xy) == 0) set->vertices--;
    return gis_polygons_end_ring(set, error);
}

bool gis_polygons_end_polygon(gis_polygons *set, gis_error *error)
{
    if (!reserve_array(&set->poly_end, &set->poly_capacity, set->polygons + 1, sizeof *set->poly_end, error))
        return false;
    set->poly_end[set->polygons++] = set->rings;
    return true;
}

bool gis_polygons_append(gis_polygons *set, const gis_polygons *from, size_t first, size_t last, gis_error *error)
{
    for (size_t r = first; r < last; r++) {
        for (size_t v = r ? from->ring_end[r - 1] : 0; v < from->ring_end[r]; v++)
            if (!gis_polygons_vertex(set, from->xy[2 * v], from->xy[2 * v + 1], error)) return false;
        if (!gis_polygons_end_ring(set, error)) return false;
    }
    return gis_polygons_end_polygon(set, error);
}

bool gis_polygons_append_one(gis_polygons *set, const gis_polygons *from, size_t polygon, gis_error *error)
{
    return gis_polygons_append(set, from, polygon ? from->poly_end[polygon - 1] : 0, from->poly_end[polygon], error);
}

bool gis_polygons_append_all(gis_polygons *set, const gis_polygons *from, gis_error *error)
{
    for (size_t p = 0; p < from->polygons; p++)
        if (!gis_polygons_append_one(set, from, p, error)) return false;
    return true;
}

bool gis_polygons_append_shape(gis_polygons *set, const sunder_shape *shape, double dx, double dy, gis_error *error)
{
    for (size_t p = 0; p < sunder_shape_polygons(shape); p++) {
        for (size_t r = 0; r < sunder_shape_rings(shape, p); r++) {
            size_t n;
            const double *xy = sunder_shape_ring(shape, p, r, &n);
            for (size_t v = 0; v < n; v++)
                if (!gis_polygons_vertex(set, xy[2 * v] + dx, xy[2 * v + 1] + dy, error)) return false;
            if (!gis_polygons_end_ring(set, error)) return false;
        }
        if (!gis_polygons_end_polygon(set, error)) return false;
    }
    return true;
}

sunder_status gis_polygons_shape(const gis_polygons *set, sunder_validity validity, sunder_shape **out,
                                 sunder_error *why)
{
    return sunder_shape_from_rings(set->xy, set->ring_end, set->poly_end, set->polygons, validity, out, why);
}
