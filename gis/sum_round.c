/* sum_round.c: a sum in doubles that is valid.
 *
 * Every vertex goes to its nearest double, so the boundary moves by less than an ulp. Rings that fall together so are
 * left out, and polygons that rounding has broken are mended (sum_mend.c). The core's exact validation says whether a
 * polygon is well, before and after. */
#include "sum_layers.h"

#include <math.h>

double gis_ulp(double x)
{
    x = fabs(x);
    return nextafter(x, INFINITY) - x;
}

bool gis_vertex_deviation(const sunder_sum *sum, uint32_t vertex, double *deviation, gis_error *error)
{
    double xy[2];
    sunder_error why;
    *deviation = 0;
    return sunder_sum_vertices(sum, &vertex, 1, xy, deviation, &why) == SUNDER_OK || gis_fail(error, "%s", why.message);
}

static bool same_vertex(const double *a, const double *b)
{
    return a[0] == b[0] && a[1] == b[1];
}

/* Appends one ring of the sum; repeated vertices once. A ring that has fallen together is not appended. */
static bool append_ring(const sunder_sum *sum, size_t polygon, size_t ring, gis_rounded *out, double *deviation,
                        bool *kept, gis_error *error)
{
    size_t n, first = out->set.vertices;
    sunder_error why;
    const uint32_t *vertex = sunder_sum_ring(sum, polygon, ring, &n);
    if (!gis_polygons_reserve(&out->set, n, error))
        return false;
    double *xy = out->set.xy + 2 * first;
    if (sunder_sum_vertices(sum, vertex, n, xy, deviation, &why) != SUNDER_OK)
        return gis_fail(error, "%s", why.message);
    if (!isfinite(*deviation))
        return gis_fail(error, "the sum leaves the range of doubles, which a layer or decimals hold; "
                        "`sunder sum --exact` gives it as JSON");
    size_t m = 0;
    for (size_t i = 0; i < n; i++) {
        if (m > 0 && same_vertex(xy + 2 * (m - 1), xy + 2 * i))
            continue;
        xy[2 * m] = xy[2 * i];
        xy[2 * m + 1] = xy[2 * i + 1];
        m++;
    }
    out->set.vertices = first + m;
    return gis_end_ring_with_area(&out->set, first, kept, error);
}

bool gis_round_sum(const sunder_sum *sum, gis_rounded *out, gis_error *error)
{
    gis_rounded rounded = {0};
    sunder_sum_counts counts;
    sunder_sum_count(sum, &counts);
    bool ok = true;
    double moved = 0;
    for (size_t p = 0; ok && p < counts.polygons; p++) {
        size_t first = rounded.set.rings, rings = sunder_sum_rings(sum, p);
        bool kept = true;
        double deviation = 0;
        for (size_t r = 0; ok && kept && r < rings; r++) {
            bool ring_kept = false;
            ok = append_ring(sum, p, r, &rounded, &deviation, &ring_kept, error);
            if (r == 0)
                kept = ring_kept; /* without its outer ring, a polygon and its holes are gone */
        }
        rounded.deviation = fmax(rounded.deviation, deviation);
        if (ok && kept && deviation == 0)
            ok = gis_polygons_end_polygon(&rounded.set, error); /* the exact polygon itself, which is valid */
        else if (ok && kept)
            ok = gis_end_valid_polygon(&rounded.set, first, &moved, &rounded.repaired, error);
    }
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
