/* polygons_area.c: areas and orientations of rings, in doubles with compensation of rounding errors. A shape of the
 * core would give exact results, but making one costs more. */
#include "geometry/polygons.h"

#include <float.h>
#include <math.h>

/* A compensated sum [Ogita, Rump, Oishi, Accurate sum and dot product, 2005, algorithm 5.3]: as accurate as with twice
 * the number of digits, and the same on every machine, unlike wider floating-point formats. */
typedef struct careful_sum {
    double sum, lost;
} careful_sum;

static void add_term(careful_sum *s, double term)
{
    const double sum = s->sum + term, part = sum - s->sum;
    s->lost += (s->sum - (sum - part)) + (term - part);
    s->sum = sum;
}

static careful_sum exact_difference(double a, double b)
{
    careful_sum s = {a, 0};
    add_term(&s, -b);
    return s;
}

/* Adds sign * a * b. */
static void add_product(careful_sum *s, double sign, careful_sum a, careful_sum b)
{
    const double product = a.sum * b.sum;
    add_term(s, sign * product);
    s->lost += sign * (fma(a.sum, b.sum, -product) + (a.sum * b.lost + a.lost * b.sum));
}

/* Twice the signed area of a ring in units of 1 / unit. Vertices are taken relative to the first one, so that large
 * coordinates lose no digits. */
static double scaled_area(const double *xy, size_t n, double unit)
{
    const double origin[2] = {unit * xy[0], unit * xy[1]};
    careful_sum twice = {0, 0}, x = {0, 0}, y = {0, 0};
    for (size_t i = 1; i < n; i++) {
        const careful_sum next_x = exact_difference(unit * xy[2 * i], origin[0]);
        const careful_sum next_y = exact_difference(unit * xy[2 * i + 1], origin[1]);
        add_product(&twice, 1, x, next_y);
        add_product(&twice, -1, y, next_x);
        x = next_x;
        y = next_y;
    }
    return twice.sum + twice.lost;
}

/* The exponent of the power of two by which a ring is scaled, so that products stay within the range of doubles. */
static int scale_of(const double *xy, size_t n)
{
    double most = 0;
    for (size_t i = 0; i < 2 * n; i++) most = fmax(most, fabs(xy[i]));
    return most > 0x1p400 ? -600 : most < 0x1p-400 ? 600 : 0;
}

/* Twice the signed area of a ring, times 4^*scale. Not finite if it overflows even so. */
static double ring_area(const double *xy, size_t n, int *scale)
{
    *scale = 0;
    const double twice = scaled_area(xy, n, 1), size = fabs(twice);
    if (size >= 0x1p-800 && size <= DBL_MAX) return twice;
    *scale = scale_of(xy, n);
    return scaled_area(xy, n, ldexp(1, *scale));
}

double gis_polygons_area(const gis_polygons *set)
{
    careful_sum area = {0, 0};
    for (size_t p = 0, r = 0; p < set->polygons; p++)
        for (size_t first = r; r < set->poly_end[p]; r++) {
            int scale;
            const size_t from = r ? set->ring_end[r - 1] : 0;
            const double twice = fabs(ring_area(set->xy + 2 * from, set->ring_end[r] - from, &scale));
            const double one = ldexp(twice, -2 * scale - 1);
            if (one == INFINITY) return INFINITY;
            add_term(&area, r == first ? one : -one);
        }
    return area.sum + area.lost;
}

static void reverse_ring(double *xy, size_t n)
{
    /* The first vertex stays the first; in a closed ring it is also the last. */
    if (n < 2) return;
    bool closed = xy[0] == xy[2 * n - 2] && xy[1] == xy[2 * n - 1];
    for (size_t i = closed ? 0 : 1, j = n - 1; i < j; i++, j--)
        for (size_t c = 0; c < 2; c++) {
            double kept = xy[2 * i + c];
            xy[2 * i + c] = xy[2 * j + c];
            xy[2 * j + c] = kept;
        }
}

void gis_polygons_wind(gis_polygons *set)
{
    for (size_t p = 0, r = 0; p < set->polygons; p++)
        for (bool outer = true; r < set->poly_end[p]; r++, outer = false) {
            size_t first = r ? set->ring_end[r - 1] : 0;
            double *xy = set->xy + 2 * first;
            int scale;
            const size_t n = set->ring_end[r] - first;
            if ((ring_area(xy, n, &scale) > 0) != outer) reverse_ring(xy, n);
        }
}
