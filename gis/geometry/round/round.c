/* round.c: a sum in doubles that is valid.
 *
 * Every vertex goes to its nearest double, so the boundary moves by less than an ulp. Rings that fall together so are
 * left out, polygons that rounding has broken are mended (mend_polygon.c), and those that it has brought into each
 * other are united there (mend_multipolygon.c). The core's exact validation says what is well, before and after. */
#include "geometry/round/steps.h"

#include "base/array.h"
#include "base/core_error.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

double gis_ulp(double x)
{
    x = fabs(x);
    return nextafter(x, INFINITY) - x;
}

/* A double as the library writes exact numbers: "num" or "num/den" in lowest terms; false if it is too long. */
static bool exact_text(double x, char *text, size_t size)
{
    int exponent;
    double mantissa = frexp(x, &exponent); /* x = mantissa 2^exponent, 0.5 <= |mantissa| < 1 */
    if (x == floor(x)) return (size_t)snprintf(text, size, "%.0f", x == 0 ? 0.0 : x) < size;
    mantissa = ldexp(mantissa, DBL_MANT_DIG);
    exponent -= DBL_MANT_DIG;
    while (fmod(mantissa, 2) == 0) {
        mantissa /= 2;
        exponent++;
    }
    return exponent > -1024 && (size_t)snprintf(text, size, "%.0f/%.0f", mantissa, ldexp(1, -exponent)) < size;
}

double gis_text_deviation(const char *exact, double x)
{
    char same[700];
    return exact_text(x, same, sizeof same) && strcmp(same, exact) == 0 ? 0 : gis_ulp(x) / 2;
}

bool gis_vertex_deviation(const sunder_sum *sum, uint32_t vertex, double *deviation, gis_error *error)
{
    double xy[2];
    sunder_error why;
    *deviation = 0;
    return sunder_sum_vertices(sum, &vertex, 1, xy, deviation, &why) == SUNDER_OK || gis_core_failed(error, NULL, &why);
}

/* Appends one ring of the sum; repeated vertices once. A ring that has fallen together is not appended. */
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
        return gis_fail(error, "the sum leaves the range of doubles, which a layer or decimals hold; "
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

/* Polygon p of the sum, mended where that is needed; raises out->deviation, and *moved to what mending adds. */
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
        if (r == 0 && !kept) break; /* without its outer ring, a polygon and its holes are gone */
    }
    out->deviation = fmax(out->deviation, deviation);
    if (out->set.rings == first) return true;
    if (deviation == 0)
        return gis_polygons_end_polygon(&out->set, error); /* the exact polygon itself, which is valid */
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

bool gis_round_sum(const sunder_sum *sum, gis_rounded *out, gis_error *error)
{
    gis_rounded rounded = {0};
    gis_suspects suspects = {0};
    bool ok = gis_round_polygons(sum, &rounded, &suspects, error) && gis_mend_multipolygon(&rounded, &suspects, error);
    gis_suspects_clear(&suspects);
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
