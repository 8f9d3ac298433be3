/* The shadow of a convex polygon K from the origin: the points that a straight path from the origin cannot reach
 * without meeting K.
 *
 *            far .--------------------.
 *               /      shadow        /     Rays from the two tangent corners of K bound it on the left and right; the
 *          L   /                    /      sides of K between these, on the side of the origin, close it. It is convex,
 *           \_K_                   /       as K is, and unbounded: the rays have infinite length.
 *               \_ R ____________ /
 *       0
 *
 * It is computed in doubles, for the search: a shadow proposes sides and places, and decides nothing. */
#include "displacement/geometry/obstacle_shadow.h"

#include <math.h>

static double cross_product(const double u[2], const double v[2]) { return u[0] * v[1] - u[1] * v[0]; }

static double dot_product(const double u[2], const double v[2]) { return u[0] * v[0] + u[1] * v[1]; }

/* Returns the corner that has all others on its left (sign +1) or right (sign -1) as seen from the origin; of several
 * the nearest. */
static size_t tangent_corner(const double *k, size_t n, double sign)
{
    size_t best = 0;
    for (size_t c = 1; c < n; c++) {
        const double x = sign * cross_product(k + 2 * best, k + 2 * c);
        if (x < 0 || (x == 0 && dot_product(k + 2 * c, k + 2 * c) < dot_product(k + 2 * best, k + 2 * best))) best = c;
    }
    return best;
}

/* Do all corners lie between the two directions, which must be less than half a turn apart? Then the origin is not in
 * K. */
static bool is_between(const double *k, size_t n, const double right[2], const double left[2])
{
    if (cross_product(right, left) < 0 || (cross_product(right, left) == 0 && !(dot_product(right, left) > 0)))
        return false;
    for (size_t c = 0; c < n; c++)
        if (cross_product(right, k + 2 * c) < 0 || cross_product(k + 2 * c, left) < 0) return false;
    return true;
}

/* Returns the ray that begins at `from` and leads away from the origin. Its outer normal is on its left (sign +1) or
 * right (sign -1). */
static sunder_i_obstacle_edge ray_from(const double from[2], double sign)
{
    const double length = hypot(from[0], from[1]);
    return (sunder_i_obstacle_edge){{from[0], from[1]}, {-sign * from[1] / length, sign * from[0] / length}, INFINITY};
}

size_t sunder_i_shadow_edges(const double *k, size_t n, sunder_i_obstacle_edge *edge)
{
    const size_t r = tangent_corner(k, n, 1), l = tangent_corner(k, n, -1);
    const double *right = k + 2 * r, *left = k + 2 * l;
    size_t edges = 0;
    if (!is_between(k, n, right, left)) return 0;
    edge[edges++] = ray_from(left, 1);
    for (size_t c = l; c != r; c = c + 1 < n ? c + 1 : 0) {
        const double *p = k + 2 * c, *q = k + 2 * (c + 1 < n ? c + 1 : 0);
        const double ex = q[0] - p[0], ey = q[1] - p[1], length = hypot(ex, ey);
        if (length > 0) edge[edges++] = (sunder_i_obstacle_edge){{p[0], p[1]}, {ey / length, -ex / length}, length};
    }
    edge[edges++] = ray_from(right, -1);
    return edges;
}

static sunder_i_support support_of(const sunder_i_obstacle_edge *e, double distance)
{
    return (sunder_i_support){{e->n[0], e->n[1]}, dot_product(e->n, e->from), distance};
}

sunder_i_support sunder_i_shadow_support_at(const sunder_i_obstacle_edge *edge, size_t n, const double u[2])
{
    sunder_i_support best = {{1, 0}, 0, -INFINITY}, corner = best;
    double nearest = INFINITY;
    for (size_t k = 0; k < n; k++) {
        const sunder_i_obstacle_edge *e = &edge[k];
        const double w[2] = {u[0] - e->from[0], u[1] - e->from[1]}, s = dot_product(e->n, w);
        if (s > best.distance) best = support_of(e, s);
        if (s < 0) continue;
        /* The first ray points against the order of the other edges. */
        const double along = (k ? 1 : -1) * (w[1] * e->n[0] - w[0] * e->n[1]);
        if (along >= 0 && along <= e->length) {
            if (s < nearest) {
                nearest = s;
                corner = support_of(e, s);
            }
            continue;
        }
        const double *c = along < 0 ? e->from : edge[k + 1 < n ? k + 1 : k].from;
        const double away[2] = {u[0] - c[0], u[1] - c[1]}, far = hypot(away[0], away[1]);
        if (!(far < nearest) || !(far > 0)) continue;
        nearest = far;
        corner = (sunder_i_support){{away[0] / far, away[1] / far}, dot_product(away, c) / far, far};
    }
    return best.distance <= 0 || !(nearest < INFINITY) ? best : corner;
}

size_t sunder_i_shadow_corners(const sunder_i_obstacle_edge *edge, size_t n, double far, double *out)
{
    const sunder_i_obstacle_edge *left = &edge[0], *right = &edge[n - 1];
    size_t corners = 0;
    for (size_t k = 1; k < n; k++) {
        out[2 * corners] = edge[k].from[0];
        out[2 * corners++ + 1] = edge[k].from[1];
    }
    /* The polygon ends with a corner far out on the right ray, a middle one, and one on the left ray. The middle corner
     * keeps its far sides beyond the distance `far`: the rays are less than half a turn apart, so each side spans less
     * than a quarter. */
    const double a[2] = {-right->n[1], right->n[0]}, b[2] = {left->n[1], -left->n[0]};
    double middle[2] = {a[0] + b[0], a[1] + b[1]};
    const double length = hypot(middle[0], middle[1]);
    const double d = 1.5 * far + hypot(left->from[0], left->from[1]) + hypot(right->from[0], right->from[1]);
    const double *direction[3] = {a, middle, b};
    for (int c = 0; c < 2; c++) middle[c] = length > 0 ? middle[c] / length : 0;
    for (int k = 0; k < 3; k++) {
        if (k == 1 && !(length > 0)) continue;
        out[2 * corners] = d * direction[k][0];
        out[2 * corners++ + 1] = d * direction[k][1];
    }
    return corners;
}

size_t sunder_i_half_plane_corners(const sunder_i_obstacle_edge *edge, double far, double *out)
{
    const double d = 2 * far + hypot(edge->from[0], edge->from[1]), *n = edge->n;
    const double along[2] = {-n[1], n[0]};
    for (int k = 0; k < 4; k++) {
        const double side = k == 0 || k == 3 ? -d : d, depth = k < 2 ? 0 : 2 * d;
        for (int c = 0; c < 2; c++) out[2 * k + c] = edge->from[c] + side * along[c] - depth * n[c];
    }
    return 4;
}
