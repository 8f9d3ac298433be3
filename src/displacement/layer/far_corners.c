/* Far corners: for instance one vertex of a house or a road at 1e20, or a line with ends at -1e300 and 1e300.
 *
 * The search computes in doubles relative to an origin of each body. Relative to an origin at 1e20 all near corners
 * would round to the same place, and a line between two such corners would pass kilometres beside its true place. So a
 * body with a corner that is 2^20 times as far from (0, 0) as the body's nearest point has *far corners*, and is
 * represented relative to that nearest point:
 *
 *     the origin         the corner nearest to (0, 0); for a line without near corners, its point nearest to (0, 0)
 *     a far corner       is dropped, and its piece ends where the edges from near corners reach a certain distance; the
 *                        piece stays convex
 *     a far segment      has two far ends; they are replaced by the points of the segment at that distance, rounded to
 *                        doubles with an error of some units in the last place
 *
 * All of this depends on the body alone. It is done for the search, and proofs that use such a piece allow for it.
 * Exact questions and sunder_i_piece_as_given() use the corners as given.
 *
 *   a piece of three or more corners without a near one    its corners are moved towards the origin, even if an edge
 *                                                          passes near it: the search does not see that edge, exact
 *                                                          questions do */
#include "displacement/layer/far_corners.h"

#include "shape/shape.h"

#include <math.h>
#include <string.h>

/* A corner is far if its distance from the body's origin exceeds NEAR and also NEAR_TIMES the distance of the origin
 * from (0, 0). In metres, feet and degrees the Earth is smaller than NEAR. Doubles resolve coordinates of that size to
 * about 1e-8. With corners at 2^36 the search needed ten times as much work for rows of houses. */
#define NEAR 0x1p27
#define NEAR_TIMES 8
/* A body has far corners if one of its corners is this many times as far from (0, 0) as its nearest point. */
#define OUT_OF_PROPORTION 0x1p20
/* Coordinates are scaled down to this exponent, so that the product of two is finite and its rounding error is not
 * subnormal. */
#define LARGE_EXPONENT 500

static double max_norm(const double p[2]) { return sunder_i_max(fabs(p[0]), fabs(p[1])); }

static double max_distance(const double p[2], const double q[2])
{
    return sunder_i_max(fabs(p[0] - q[0]), fabs(p[1] - q[1]));
}

/* ---- Segments ---------------------------------------------------------------------------------------------------- */

/* Returns the axis, 0 or 1, along which the segment ab is longer. */
static size_t longer_axis(const double a[2], const double b[2])
{
    return fabs(b[0] / 2 - a[0] / 2) >= fabs(b[1] / 2 - a[1] / 2) ? 0 : 1;
}

/* Returns coordinate 1 - k of the line through a and b at the point whose coordinate k is u:
 *
 * ((a' b_k - b' a_k) + u (b' - a')) / (b_k - a_k)
 *
 * where a', b' are the coordinates 1 - k of a and b. The difference of products may cancel almost completely; it is
 * computed with an error of at most 1.5 units in the last place (Kahan's method, see [JLM13]). */
static double other_coordinate(const double a[2], const double b[2], size_t k, double u)
{
    int exponent;
    frexp(sunder_i_max(max_norm(a), max_norm(b)), &exponent);
    const int shift = exponent > LARGE_EXPONENT ? exponent - LARGE_EXPONENT : 0;
    double p[2], q[2];
    for (size_t c = 0; c < 2; c++) {
        p[c] = ldexp(a[c], -shift);
        q[c] = ldexp(b[c], -shift);
    }
    const double product = q[1 - k] * p[k], rest = fma(-q[1 - k], p[k], product),
                 difference = fma(p[1 - k], q[k], -product) + rest, length = q[k] - p[k];
    return ldexp(difference / length, shift) + u * ((q[1 - k] - p[1 - k]) / length);
}

static void place_at(const double a[2], const double b[2], size_t k, double u, double out[2])
{
    out[k] = u;
    out[1 - k] = u == a[k] ? a[1 - k] : u == b[k] ? b[1 - k] : other_coordinate(a, b, k, u);
}

static double clamp(double v, double low, double high) { return sunder_i_max(low, sunder_i_min(v, high)); }

/* Sets out to a point of the segment ab that is about as near to (0, 0) as any of its points. */
static void nearest_place(const double a[2], const double b[2], double out[2])
{
    const size_t k = longer_axis(a, b);
    place_at(a, b, k, clamp(0, sunder_i_min(a[k], b[k]), sunder_i_max(a[k], b[k])), out);
}

/* Clips the segment `corner` to the square with half width `half` around the origin and makes its ends relative to the
 * origin. Returns false if no part of it, of positive length, remains. */
static bool cut_off(const double origin[2], double half, double corner[4])
{
    const double a[2] = {corner[0], corner[1]}, b[2] = {corner[2], corner[3]};
    const size_t k = longer_axis(a, b);
    const double from = clamp(a[k], origin[k] - half, origin[k] + half),
                 to = clamp(b[k], origin[k] - half, origin[k] + half);
    if (from == to) return false;
    place_at(a, b, k, from, corner);
    place_at(a, b, k, to, corner + 2);
    for (size_t c = 0; c < 4; c++) corner[c] -= origin[c & 1];
    return true;
}

/* ---- Bodies ------------------------------------------------------------------------------------------------------ */

static void take_nearer(const double p[2], double origin[2])
{
    if (max_norm(p) < max_norm(origin)) memcpy(origin, p, 2 * sizeof *origin);
}

/* Replaces `origin` by the point of the shape's pieces nearest to (0, 0), if that is nearer than `origin`. */
static void look_for_origin(const sunder_shape *shape, double origin[2])
{
    uint32_t from = 0;
    for (uint32_t p = 0; p < shape->pieces; from = shape->piece_end[p++]) {
        for (uint32_t k = from; k < shape->piece_end[p]; k++)
            take_nearer(shape->xy + 2 * (size_t)sunder_i_piece_vertices(shape)[k], origin);
        if (shape->piece_end[p] - from != 2) continue;
        double place[2];
        nearest_place(shape->xy + 2 * (size_t)sunder_i_piece_vertices(shape)[from],
                      shape->xy + 2 * (size_t)sunder_i_piece_vertices(shape)[from + 1], place);
        take_nearer(place, origin);
    }
}

void sunder_i_find_far_corners(const sunder_i_model *model, sunder_i_body *body)
{
    const uint32_t *member = model->member + body->member;
    double farthest = 0, nearest[2] = {INFINITY, INFINITY};
    memcpy(body->origin, sunder_i_home_box(model, member[0]), sizeof body->origin);
    body->reach = 0x1p400; /* the product of two such lengths is finite */
    body->far = false;
    for (uint32_t m = 0; m < body->members; m++) {
        if (!model->present[member[m]]) continue;
        const double *box = sunder_i_thing_shape(model, member[m])->box;
        farthest = sunder_i_max(farthest, sunder_i_max(max_norm(box), max_norm(box + 2)));
    }
    if (!(farthest > NEAR)) return;
    for (uint32_t m = 0; m < body->members; m++)
        if (model->present[member[m]]) look_for_origin(sunder_i_thing_shape(model, member[m]), nearest);
    if (!(farthest / OUT_OF_PROPORTION > max_norm(nearest))) return;
    memcpy(body->origin, nearest, sizeof body->origin);
    body->far = true;
}

static double half_window(const sunder_i_body *body) { return sunder_i_max(NEAR, NEAR_TIMES * max_norm(body->origin)); }

static bool is_far(const sunder_i_body *body, const double p[2])
{
    return max_distance(p, body->origin) > half_window(body);
}

/* Makes p relative to the body's origin. A far p is moved along the ray from the origin to the distance half_window().
 * Coordinates are halved first, since the difference of two of the largest doubles is not finite. */
static void draw_in(const sunder_i_body *body, double p[2])
{
    const bool far = is_far(body, p);
    for (size_t c = 0; c < 2; c++) p[c] = far ? p[c] / 2 - body->origin[c] / 2 : p[c] - body->origin[c];
    const double longest = max_norm(p);
    for (size_t c = 0; c < 2 && far; c++) p[c] = p[c] / longest * half_window(body);
}

/* Sets out to the point where the edge from the near corner `near` to the far corner `far` is cut off, relative to the
 * origin. */
static void cut_edge(const sunder_i_body *body, const double near[2], const double far[2], double out[2])
{
    const double half = half_window(body);
    const size_t k = longer_axis(near, far);
    out[k] = clamp(far[k], body->origin[k] - half, body->origin[k] + half);
    const double along = out[k] - near[k], run = far[k] / 2 - near[k] / 2, rise = far[1 - k] / 2 - near[1 - k] / 2;
    out[1 - k] = near[1 - k] - body->origin[1 - k] + along * (rise / run);
    out[k] -= body->origin[k];
}

void sunder_i_draw_in(const sunder_i_body *body, double *corner, uint32_t n)
{
    if (n == 2) {
        const double a[2] = {corner[0], corner[1]}, b[2] = {corner[2], corner[3]};
        if (is_far(body, a) && is_far(body, b) && cut_off(body->origin, half_window(body), corner)) return;
        if (!is_far(body, a) && is_far(body, b)) cut_edge(body, a, b, corner + 2);
        if (is_far(body, a) && !is_far(body, b)) cut_edge(body, b, a, corner);
        if (is_far(body, a) != is_far(body, b)) {
            draw_in(body, is_far(body, a) ? corner + 2 : corner);
            return;
        }
    }
    for (uint32_t k = 0; k < n; k++) draw_in(body, corner + 2 * (size_t)k);
}

static const double *corner_as_given(const sunder_shape *shape, uint32_t k)
{
    return shape->xy + 2 * (size_t)sunder_i_piece_vertices(shape)[k];
}

static bool has_near_corner(const sunder_i_body *body, const sunder_shape *shape, uint32_t from, uint32_t end)
{
    while (from < end && is_far(body, corner_as_given(shape, from))) from++;
    return from < end;
}

size_t sunder_i_far_corner(const sunder_i_body *body, const sunder_shape *shape, uint32_t p, uint32_t k, double *out)
{
    const uint32_t from = p ? shape->piece_end[p - 1] : 0, end = shape->piece_end[p];
    const double *at = corner_as_given(shape, k), *before = corner_as_given(shape, (k > from ? k : end) - 1),
                 *after = corner_as_given(shape, k + 1 < end ? k + 1 : from);
    double two[4];
    memcpy(two, at, 2 * sizeof *two);
    memcpy(two + 2, after, 2 * sizeof *two);
    if (end - from <= 2 || !is_far(body, at) || !has_near_corner(body, shape, from, end)) {
        sunder_i_draw_in(body, two, end - from == 2 ? 2 : 1);
        memcpy(out, two, 2 * sizeof *out);
        return 1;
    }
    size_t n = 0;
    if (!is_far(body, before)) cut_edge(body, before, at, out + 2 * n++);
    if (!is_far(body, after)) cut_edge(body, after, at, out + 2 * n++);
    return n;
}
