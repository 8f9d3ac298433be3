/* geometry_distance.c: distances by segments. The distance of two segments is 0 if they cross, else the least distance
 * of an end from the other segment. Points are segments of length 0. */
#include "follow/geometry_distance.h"

#include <math.h>

static double square_of_point(const double p[2], const double a[2], const double b[2])
{
    const double u[2] = {b[0] - a[0], b[1] - a[1]}, v[2] = {p[0] - a[0], p[1] - a[1]};
    const double length = u[0] * u[0] + u[1] * u[1];
    const double along = length > 0 ? fmin(1, fmax(0, (u[0] * v[0] + u[1] * v[1]) / length)) : 0;
    const double x = v[0] - along * u[0], y = v[1] - along * u[1];
    return x * x + y * y;
}

static int side_of(const double a[2], const double b[2], const double c[2])
{
    return sunder_orient(&(sunder_point){a[0], a[1]}, &(sunder_point){b[0], b[1]}, &(sunder_point){c[0], c[1]});
}

static double square_of_segments(const double a[2], const double b[2], const double c[2], const double d[2])
{
    if (side_of(a, b, c) * side_of(a, b, d) < 0 && side_of(c, d, a) * side_of(c, d, b) < 0) return 0;
    return fmin(fmin(square_of_point(a, c, d), square_of_point(b, c, d)),
                fmin(square_of_point(c, a, b), square_of_point(d, a, b)));
}

/* The least square of the distance of the segment ab from the thing that `user` is. */
typedef double square_from(const void *user, const double a[2], const double b[2]);

static double from_shape(const void *user, const double a[2], const double b[2])
{
    const sunder_shape *shape = user;
    const double *xy;
    const size_t *ring_end, *poly_end, n = sunder_shape_given(shape, &xy, &ring_end, &poly_end),
                                       rings = n ? poly_end[n - 1] : 0;
    if (sunder_shape_locate(shape, &(sunder_point){a[0], a[1]}) >= 0) return 0;
    double least = INFINITY;
    for (size_t r = 0; r < rings && least > 0; r++)
        for (size_t first = r ? ring_end[r - 1] : 0, i = first; i < ring_end[r]; i++)
            least = fmin(least, square_of_segments(a, b, xy + 2 * i, xy + 2 * (i + 1 < ring_end[r] ? i + 1 : first)));
    return least;
}

typedef struct points {
    const double *xy;
    size_t n;
} points;

static double from_points(const void *user, const double a[2], const double b[2])
{
    const points *p = user;
    double least = INFINITY;
    for (size_t i = 0; i < p->n; i++) least = fmin(least, square_of_point(p->xy + 2 * i, a, b));
    return least;
}

static double least_square(OGRGeometryH geometry, square_from *from, const void *user)
{
    double least = INFINITY, a[2], b[2];
    for (int i = 0; i < OGR_G_GetGeometryCount(geometry); i++)
        least = fmin(least, least_square(OGR_G_GetGeometryRef(geometry, i), from, user));
    const int n = OGR_G_GetGeometryCount(geometry) || OGR_G_IsEmpty(geometry) ? 0 : OGR_G_GetPointCount(geometry);
    for (int i = 0; i < n && least > 0; i++) {
        const int j = i + 1 < n ? i + 1 : i;
        if (j == i && n > 1) break;
        a[0] = OGR_G_GetX(geometry, i);
        a[1] = OGR_G_GetY(geometry, i);
        b[0] = OGR_G_GetX(geometry, j);
        b[1] = OGR_G_GetY(geometry, j);
        least = fmin(least, from(user, a, b));
    }
    return least;
}

double gis_follow_distance(OGRGeometryH geometry, const sunder_shape *shape)
{
    return sqrt(least_square(geometry, from_shape, shape));
}

double gis_follow_distance_to_points(OGRGeometryH geometry, const double *point, size_t n)
{
    const points p = {point, n};
    return sqrt(least_square(geometry, from_points, &p));
}
