/* sum_round.c: a sum in doubles that is valid.
 *
 * Every vertex goes to its nearest double, so the boundary moves by less than an ulp. That can break a ring in two
 * ways, and both happen on ordinary input:
 *
 *  - a hole or a member so small that its vertices fall together: the ring has no area left, and is left out;
 *  - a vertex that lay on an edge of its own polygon, or within an ulp of it (rings of a sum meet in points), and now
 * is on the wrong side of it. The edge is bent through that vertex (a new vertex there, equal to it), which moves the
 * edge by as little as the vertex is away from it, and the rings touch again instead of crossing.
 *
 * The core's exact validation says whether a polygon is well, before and after; what cannot be mended so is an error.
 */
#include "sum_layers.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* How near a vertex must be to an edge to bend it, in units in the last place of their coordinates. Both ends of the
 * edge and the vertex have moved by half a unit in each coordinate: the sum of the three is below this. */
static const double near_ulps = 4;
/* Each round of bending can bring the next vertex over an edge; this many rounds have always been plenty. */
enum { BENDING_ROUNDS = 8 };

static double ulp(double x)
{
    x = fabs(x);
    return nextafter(x, INFINITY) - x;
}

/* A double as the library writes exact numbers: "num" or "num/den" in lowest terms; false if it is too long. */
static bool exact_text(double x, char *text, size_t size)
{
    int exponent;
    double mantissa = frexp(x, &exponent); /* x = mantissa 2^exponent, 0.5 <= |mantissa| < 1 */
    if (x == floor(x))
        return (size_t)snprintf(text, size, "%.0f", x == 0 ? 0.0 : x) < size;
    mantissa = ldexp(mantissa, DBL_MANT_DIG);
    exponent -= DBL_MANT_DIG;
    while (fmod(mantissa, 2) == 0) {
        mantissa /= 2;
        exponent++;
    }
    return exponent > -1024 && (size_t)snprintf(text, size, "%.0f/%.0f", mantissa, ldexp(1, -exponent)) < size;
}

/* A bound of |exact - x| where x is the double nearest to exact: 0 if they are equal, else the difference in long
 * doubles with what that may be off by, but never more than half a unit of x. */
static double coordinate_deviation(const char *exact, double x)
{
    char same[700];
    if (exact_text(x, same, sizeof same) && strcmp(same, exact) == 0)
        return 0;
    double bound = ulp(x) / 2;
    const char *slash = strchr(exact, '/');
    long double quotient = strtold(exact, NULL) / (slash ? strtold(slash + 1, NULL) : 1.0L);
    long double seen = fabsl(quotient - (long double)x) + 4 * LDBL_EPSILON * fabsl((long double)x);
    return seen < (long double)bound ? nextafter((double)seen, INFINITY) : bound; /* NaN: the bound */
}

bool gis_vertex_deviation(const sunder_sum *sum, uint32_t vertex, double *deviation, gis_error *error)
{
    double xy[2];
    sunder_sum_vertex(sum, vertex, xy);
    if (!isfinite(xy[0]) || !isfinite(xy[1])) {
        *deviation = INFINITY;
        return true;
    }
    char *x, *y;
    sunder_error why;
    if (sunder_sum_vertex_text(sum, vertex, &x, &y, &why) != SUNDER_OK)
        return gis_fail(error, "%s", why.message);
    *deviation = hypot(coordinate_deviation(x, xy[0]), coordinate_deviation(y, xy[1]));
    sunder_free(x);
    sunder_free(y);
    return true;
}

static bool same_vertex(const double *a, const double *b)
{
    return a[0] == b[0] && a[1] == b[1];
}

/* Appends one ring of the sum; repeated vertices once. A ring that has fallen together is not appended. */
static bool append_ring(const sunder_sum *sum, size_t polygon, size_t ring, gis_rounded *out, bool *kept,
                        gis_error *error)
{
    size_t n, first = out->set.vertices;
    const uint32_t *vertex = sunder_sum_ring(sum, polygon, ring, &n);
    bool has_area = false;
    for (size_t i = 0; i < n; i++) {
        double xy[2], deviation;
        if (!gis_vertex_deviation(sum, vertex[i], &deviation, error))
            return false;
        if (!isfinite(deviation))
            return gis_fail(error, "the sum leaves the range of doubles, which a layer or decimals hold; "
                            "`sunder sum --exact` gives it as JSON");
        sunder_sum_vertex(sum, vertex[i], xy);
        if (deviation > out->deviation)
            out->deviation = deviation;
        if (out->set.vertices > first && same_vertex(out->set.xy + 2 * (out->set.vertices - 1), xy))
            continue;
        if (!gis_polygons_vertex(&out->set, xy[0], xy[1], error))
            return false;
    }
    if (out->set.vertices > first + 1 &&
        same_vertex(out->set.xy + 2 * first, out->set.xy + 2 * (out->set.vertices - 1)))
        out->set.vertices--;
    const sunder_point *point = (const sunder_point *)out->set.xy; /* pairs of doubles, laid out as points are */
    for (size_t i = first + 2; i < out->set.vertices && !has_area; i++)
        has_area = sunder_orient(&point[first], &point[first + 1], &point[i]) != 0;
    *kept = has_area;
    if (!has_area) {
        out->set.vertices = first;
        out->vanished++;
        return true;
    }
    return gis_polygons_end_ring(&out->set, error);
}

/* Is the polygon of rings [first, last) valid? */
static bool is_valid(const gis_polygons *set, size_t first, size_t last, sunder_error *why)
{
    size_t start = first ? set->ring_end[first - 1] : 0;
    size_t *ends = malloc((last - first) * sizeof *ends);
    if (!ends) {
        snprintf(why->message, sizeof why->message, "out of memory");
        return false;
    }
    for (size_t r = first; r < last; r++)
        ends[r - first] = set->ring_end[r] - start;
    size_t rings = last - first;
    sunder_shape *shape = NULL;
    bool valid = sunder_shape_from_rings(set->xy + 2 * start, ends, &rings, 1, SUNDER_STRICT, &shape, why) == SUNDER_OK;
    sunder_shape_free(shape);
    free(ends);
    return valid;
}

/* Does vertex c lie so near to the inside of edge ab that rounding may have put it on the wrong side? *t: where along
 * the edge, *distance: how far. Doubles do here: bending an edge in vain, or not bending it, is found out by the exact
 * validation that follows. */
static bool is_near(const double *a, const double *b, const double *c, double *t, double *distance)
{
    double dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
    double unit =
        ulp(fmax(fmax(fabs(c[0]), fabs(c[1])), fmax(fmax(fabs(a[0]), fabs(b[0])), fmax(fabs(a[1]), fabs(b[1])))));
    if (!(length2 > 0) || same_vertex(a, c) || same_vertex(b, c))
        return false;
    *t = ((c[0] - a[0]) * dx + (c[1] - a[1]) * dy) / length2;
    if (!(*t > 0 && *t < 1))
        return false;
    *distance = hypot(c[0] - (a[0] + *t * dx), c[1] - (a[1] + *t * dy));
    return *distance <= near_ulps * unit;
}

typedef struct bend {
    double t, xy[2];
} bend;

static int by_place(const void *a, const void *b)
{
    double ta = ((const bend *)a)->t, tb = ((const bend *)b)->t;
    return (ta > tb) - (ta < tb);
}

/* Writes ring r of `from` to `to`, each edge bent through the vertices of the polygon's rings that are near to it. */
static bool bend_ring(const gis_polygons *from, size_t first, size_t last, size_t r, gis_polygons *to, double *moved,
                      bend *bends, gis_error *error)
{
    size_t all = first ? from->ring_end[first - 1] : 0, all_end = from->ring_end[last - 1];
    size_t begin = r ? from->ring_end[r - 1] : 0, end = from->ring_end[r];
    for (size_t i = begin; i < end; i++) {
        const double *a = from->xy + 2 * i, *b = from->xy + 2 * (i + 1 < end ? i + 1 : begin);
        size_t n = 0;
        for (size_t v = all; v < all_end; v++) {
            const double *c = from->xy + 2 * v;
            double distance;
            if (is_near(a, b, c, &bends[n].t, &distance)) {
                bends[n].xy[0] = c[0];
                bends[n].xy[1] = c[1];
                n++;
                *moved = fmax(*moved, distance);
            }
        }
        qsort(bends, n, sizeof *bends, by_place);
        if (!gis_polygons_vertex(to, a[0], a[1], error))
            return false;
        for (size_t k = 0; k < n; k++)
            if ((k == 0 || !same_vertex(bends[k].xy, bends[k - 1].xy)) &&
                !gis_polygons_vertex(to, bends[k].xy[0], bends[k].xy[1], error))
                return false;
    }
    return gis_polygons_end_ring(to, error);
}

/* Bends the edges of the polygon at the end of the set, rings [first, set->rings), until it is valid. */
static bool mend(gis_polygons *set, size_t first, double *moved, sunder_error *why, gis_error *error)
{
    for (int round = 0; round < BENDING_ROUNDS; round++) {
        size_t last = set->rings, start = first ? set->ring_end[first - 1] : 0;
        gis_polygons bent = {0};
        bend *bends = malloc((set->vertices - start + 1) * sizeof *bends);
        bool ok = bends || gis_no_memory(error);
        for (size_t r = first; ok && r < last; r++)
            ok = bend_ring(set, first, last, r, &bent, moved, bends, error);
        free(bends);
        bool changed = bent.vertices > set->vertices - start;
        set->vertices = start;
        set->rings = first;
        for (size_t r = 0, v = 0; ok && r < bent.rings; r++) {
            for (; ok && v < bent.ring_end[r]; v++)
                ok = gis_polygons_vertex(set, bent.xy[2 * v], bent.xy[2 * v + 1], error);
            ok = ok && gis_polygons_end_ring(set, error);
        }
        gis_polygons_clear(&bent);
        if (!ok)
            return false;
        if (is_valid(set, first, set->rings, why))
            return true;
        if (!changed)
            break;
    }
    return gis_fail(error, "rounded to doubles the sum is no longer valid (%s); `sunder sum --exact` gives it as JSON",
                    why->message);
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
        for (size_t r = 0; ok && kept && r < rings; r++) {
            bool ring_kept = false;
            ok = append_ring(sum, p, r, &rounded, &ring_kept, error);
            if (r == 0)
                kept = ring_kept; /* without its outer ring, a polygon and its holes are gone */
        }
        if (!ok || !kept)
            continue;
        sunder_error why;
        if (!is_valid(&rounded.set, first, rounded.set.rings, &why))
            ok = mend(&rounded.set, first, &moved, &why, error);
        ok = ok && gis_polygons_end_polygon(&rounded.set, error);
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
