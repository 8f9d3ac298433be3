/* Grows a shape by the tolerance: computes Q + D as a shape, where D is a polygon inscribed in the disc whose radius is
 * the tolerance. */
#include "displacement/layer/relate.h"

#include "sum/to_shape.h"

#include <math.h>

/* Makes D. Its corners are multiples of 1/32 of the power of two below the tolerance, rounded towards the centre, so
 * that they lie in the disc. Corners of few bits keep the lattice of the sum narrow. As the radius is at least 32 such
 * units, the distance of each side from the centre is at least cos(pi / 16) - sqrt(2) / 32 = 0.93 of the radius. */
static sunder_status small_disc(double tolerance, sunder_shape **out, sunder_error *err)
{
    enum { CORNERS = 16 };
    int exponent;
    frexp(tolerance, &exponent);
    const double unit = ldexp(1, exponent - 6), r = tolerance / unit;
    /* Cosines of multiples of pi / 8, rounded down. */
    static const double cosine[5] = {1, 0.9238, 0.7071, 0.3826, 0};
    double xy[2 * CORNERS];
    for (int k = 0; k < CORNERS; k++) {
        const int quarter = k / 4, i = k % 4;
        const double x = floor(r * cosine[i]) * unit, y = floor(r * cosine[4 - i]) * unit;
        xy[2 * k] = quarter == 0 ? x : quarter == 1 ? -y : quarter == 2 ? -x : y;
        xy[2 * k + 1] = quarter == 0 ? y : quarter == 1 ? x : quarter == 2 ? -y : -x;
    }
    const size_t ring_end = CORNERS, poly_end = 1;
    return sunder_shape_from_rings(xy, &ring_end, &poly_end, 1, SUNDER_VALIDITY_STRICT, out, err);
}

sunder_status sunder_i_grow_by_tolerance(const sunder_shape *q, double tolerance, sunder_shape **out, sunder_error *err)
{
    sunder_shape *disc = NULL;
    sunder_sum *sum = NULL;
    sunder_status status = small_disc(tolerance, &disc, err);
    if (!status) status = sunder_minkowski_sum(q, disc, NULL, &sum, err);
    sunder_shape_free(disc);
    if (status) return status;
    status = sunder_i_sum_to_shape(sum, false, SUNDER_VALIDITY_EVEN_ODD, out, err);
    sunder_sum_free(sum);
    return status;
}
