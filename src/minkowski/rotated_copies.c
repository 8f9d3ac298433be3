/* rotated_copies.c: see rotated_copies.h. The products and the sum of a coordinate are computed with their rounding
 * errors, which are doubles, too (Dekker's two-product by fma, Knuth's two-sum): the coordinate is exact if all three
 * errors are 0. An underflow of such an error would hide it, so tiny products count as rounded. */
#include "minkowski/rotated_copies.h"

#include "base/memory.h"

#include <math.h>

/* The squares of integers up to this one are doubles, and so is the sum of two of them. */
static const double longest = 67108864; /* 2^26 */

/* Below this product its rounding error may be less than the least double. */
static const double least_product = 0x1p-900;

bool sunder_i_rotation_is_rational(const sunder_rotation *rotation)
{
    const double c = rotation->cosine, s = rotation->sine, d = rotation->scale;
    return fabs(c) <= longest && fabs(s) <= longest && d >= 1 && d <= longest && c == rint(c) && s == rint(s) &&
           d == rint(d) && c * c + s * s == d * d;
}

/* Returns a * x + b * y, rounded; *exact becomes false if that is not the exact value. */
static double combine(double a, double x, double b, double y, bool *exact)
{
    const double p = a * x, q = b * y, sum = p + q, back = sum - p;
    const double lost = (p - (sum - back)) + (q - back);
    if (fma(a, x, -p) != 0 || fma(b, y, -q) != 0 || lost != 0) *exact = false;
    if ((p == 0) != (a == 0 || x == 0) || (q == 0) != (b == 0 || y == 0)) *exact = false;
    if ((p != 0 && fabs(p) < least_product) || (q != 0 && fabs(q) < least_product)) *exact = false;
    return sum + 0; /* never a negative zero */
}

sunder_status sunder_i_rotated_copy(const sunder_shape *shape, double cosine, double sine, sunder_shape **out,
                                    bool *exact, sunder_error *err)
{
    const double *xy;
    const size_t *ring_end, *poly_end, polygons = sunder_shape_given(shape, &xy, &ring_end, &poly_end),
                                       rings = polygons ? poly_end[polygons - 1] : 0,
                                       n = rings ? ring_end[rings - 1] : 0;
    double *moved = sunder_i_alloc(2 * n, sizeof *moved);
    if (!moved) return sunder_i_failure_cause(err);
    *exact = true;
    bool finite = true;
    for (size_t k = 0; k < n; k++) {
        const double x = xy[2 * k], y = xy[2 * k + 1];
        moved[2 * k] = combine(cosine, x, -sine, y, exact);
        moved[2 * k + 1] = combine(sine, x, cosine, y, exact);
        finite = finite && isfinite(moved[2 * k]) && isfinite(moved[2 * k + 1]);
    }
    sunder_status status = SUNDER_OK;
    if (!finite) status = sunder_i_fail(err, SUNDER_ERANGE, "a rotated vertex leaves the range of doubles");
    const sunder_validity validity = sunder_shape_repaired(shape) ? SUNDER_VALIDITY_EVEN_ODD : SUNDER_VALIDITY_STRICT;
    if (status == SUNDER_OK) status = sunder_shape_from_rings(moved, ring_end, poly_end, polygons, validity, out, err);
    if (status == SUNDER_EINVALID)
        status = sunder_shape_from_rings(moved, ring_end, poly_end, polygons, SUNDER_VALIDITY_EVEN_ODD, out, err);
    sunder_i_free(moved);
    return status;
}
