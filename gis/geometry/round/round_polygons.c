/* round_polygons.c: see steps.h. Rounds the polygons of a sum to doubles, each valid by itself. */
#include "geometry/round/steps.h"

#include "base/array.h"
#include "base/core_error.h"

#include <math.h>
#include <stdlib.h>

/* Appends a ring of the sum without repeated vertices. *kept = false: the ring has lost its area, and is dropped. */
static bool append_ring(const sunder_sum *sum, size_t polygon, size_t ring, gis_rounded *out, double *deviation,
                        bool *kept, gis_error *error)
{
    size_t n, first = out->set.vertices;
    sunder_error why;
    const uint32_t *vertex = sunder_sum_ring(sum, polygon, ring, &n);
    if (!gis_polygons_reserve(&out->set, n, error)) return false;
    double *xy = out->set.xy + 2 * first;
    if (sunder_sum_vertices(sum, vertex, n, xy, deviation, &why) != SUNDER_OK)
        return gis_core_failed(error, NULL, &why);
    if (!isfinite(*deviation))
        return gis_fail(error, "the sum leaves the range of doubles, so neither a layer nor decimals can hold it; "
                               "`sunder sum --exact` gives it as JSON");
    size_t m = 0;
    for (size_t i = 0; i < n; i++) {
        if (m > 0 && gis_same_vertex(xy + 2 * (m - 1), xy + 2 * i)) continue;
        xy[2 * m] = xy[2 * i];
        xy[2 * m + 1] = xy[2 * i + 1];
        m++;
    }
    out->set.vertices = first + m;
    return gis_end_ring_with_area(&out->set, first, kept, error);
}

bool gis_suspect(gis_suspects *suspects, size_t polygon, gis_error *error)
{
    if (!gis_array_reserve(&suspects->polygon, &suspects->capacity, suspects->n + 1, sizeof *suspects->polygon))
        return gis_no_memory(error);
    suspects->polygon[suspects->n++] = polygon;
    return true;
}

void gis_suspects_clear(gis_suspects *suspects)
{
    free(suspects->polygon);
    *suspects = (gis_suspects){0};
}

/* Appends polygon p of the sum, mended if needed; raises out->deviation, and *moved to the distance that mending
 * adds. */
static bool append_polygon(const sunder_sum *sum, size_t p, gis_rounded *out, double *moved, gis_suspects *suspects,
                           gis_error *error)
{
    size_t first = out->set.rings, before = out->set.polygons, repaired = out->repaired;
    size_t rings = sunder_sum_rings(sum, p);
    bool lost = false, ok = true;
    double deviation = 0;
    for (size_t r = 0; r < rings; r++) {
        bool kept;
        if (!append_ring(sum, p, r, out, &deviation, &kept, error)) return false;
        lost = lost || !kept;
        if (r == 0 && !kept) break; /* without its outer ring the polygon is dropped with its holes */
    }
    out->deviation = fmax(out->deviation, deviation);
    if (out->set.rings == first) return true;
    if (deviation == 0)
        return gis_polygons_end_polygon(&out->set, error); /* all vertices are exact, so the polygon is valid */
    ok = gis_end_valid_polygon(&out->set, first, moved, &out->repaired, error);
    for (size_t k = before; ok && (lost || out->repaired > repaired) && k < out->set.polygons; k++)
        ok = gis_suspect(suspects, k, error);
    return ok;
}

bool gis_round_polygons(const sunder_sum *sum, gis_rounded *out, gis_suspects *suspects, gis_error *error)
{
    gis_rounded rounded = {0};
    sunder_sum_size size;
    sunder_sum_get_size(sum, &size);
    bool ok = true;
    double moved = 0;
    for (size_t p = 0; ok && p < size.polygons; p++) ok = append_polygon(sum, p, &rounded, &moved, suspects, error);
    rounded.deviation += moved;
    if (ok)
        *out = rounded;
    else
        gis_rounded_clear(&rounded);
    return ok;
}

void gis_rounded_clear(gis_rounded *rounded)
{
    gis_polygons_clear(&rounded->set);
    *rounded = (gis_rounded){0};
}
