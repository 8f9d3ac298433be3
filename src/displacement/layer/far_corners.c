/* Far corners: for instance one vertex of a house or a road at 1e20, or a line with ends at -1e300 and 1e300.
 *
 * The search computes in doubles relative to an origin of each body. Relative to an origin at 1e20 all near corners
 * would round to the same place, and a line between two such corners would pass kilometres beside its true place. So a
 * body with a corner that is 2^10 times as far from (0, 0) as the body's nearest point has *far corners*, and is
 * represented relative to that nearest point, by what it has in a *window*, a square around that origin:
 *
 *     the origin         the corner nearest to (0, 0); for a line, or where no corner is near, the point of a line or
 *                        an edge that is nearest to (0, 0)
 *     a far corner       a corner outside the window
 *     a line             is cut off along its longer axis where the window ends
 *     a convex piece     is clipped to the window, and stays convex. A piece that has nothing in the window becomes one
 *                        place on the window's border, since a piece has at least one corner
 *
 * All of this depends on the body alone. Places on the window's border are rounded, with an error of some units in the
 * last place. They are for the search, and proofs that use such a piece allow for it. Exact questions and
 * sunder_i_piece_as_given() use the corners as given. */
#include "displacement/layer/far_corners.h"

#include "shape/shape.h"

#include <math.h>
#include <string.h>

/* A corner is far if its distance from the body's origin exceeds NEAR and also NEAR_TIMES the distance of the origin
 * from (0, 0). In metres, feet and degrees the Earth is smaller than NEAR. Doubles resolve coordinates of that size to
 * about 1e-8. With corners at 2^36 the search needed ten times as much work for rows of houses. */
#define NEAR 0x1p27
#define NEAR_TIMES 8
/* A body has far corners if one of its corners is this many times as far from (0, 0) as its nearest point. With 2^20,
 * rows of houses beside a wall with a corner at 1e11 cost fifteen times what they cost with that corner at 1e9. A fixed
 * body is not rounded, so there a smaller number suffices: with 2^10, rows beside a fixed wall with a corner at 1e9 or
 * 4e9 cost up to 3.6 times what they cost with that corner at 1e8. */
#define OUT_OF_PROPORTION 0x1p10
#define OUT_OF_PROPORTION_FIXED 0x1p4
/* Coordinates are scaled down to this exponent, so that the product of two is finite and its rounding error is not
 * subnormal. */
#define LARGE_EXPONENT 500

static double max_norm(const double p[2]) { return sunder_i_max(fabs(p[0]), fabs(p[1])); }

static double max_distance(const double p[2], const double q[2])
{
    return sunder_i_max(fabs(p[0] - q[0]), fabs(p[1] - q[1]));
}

/* ---- Pieces as given --------------------------------------------------------------------------------------------- */

/* A convex piece of a shape: its corners are those from `from` to `end` - 1. */
typedef struct piece_as_given {
    const sunder_shape *shape;
    uint32_t from, end;
} piece_as_given;

static const double *corner_as_given(const piece_as_given *piece, uint32_t k)
{
    return piece->shape->xy + 2 * (size_t)sunder_i_piece_vertices(piece->shape)[k];
}

static const double *corner_after(const piece_as_given *piece, uint32_t k)
{
    return corner_as_given(piece, k + 1 < piece->end ? k + 1 : piece->from);
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

/* ---- Bodies ------------------------------------------------------------------------------------------------------ */

static void take_nearer(const double p[2], double origin[2])
{
    if (max_norm(p) < max_norm(origin)) memcpy(origin, p, 2 * sizeof *origin);
}

/* Replaces `origin` by the nearest to (0, 0) of the corners of the shape's pieces and of the points of its lines, and
 * with `edges` of the points of its pieces' edges, if that is nearer than `origin`. */
static void look_for_origin(const sunder_shape *shape, bool edges, double origin[2])
{
    uint32_t from = 0;
    for (uint32_t p = 0; p < shape->pieces; from = shape->piece_end[p++]) {
        const piece_as_given piece = {shape, from, shape->piece_end[p]};
        for (uint32_t k = from; k < piece.end; k++) {
            double place[2];
            take_nearer(corner_as_given(&piece, k), origin);
            if (!edges && piece.end - from != 2) continue;
            nearest_place(corner_as_given(&piece, k), corner_after(&piece, k), place);
            take_nearer(place, origin);
        }
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
    for (int edges = 0; edges <= 1 && max_norm(nearest) > NEAR; edges++)
        for (uint32_t m = 0; m < body->members; m++)
            if (model->present[member[m]]) look_for_origin(sunder_i_thing_shape(model, member[m]), edges, nearest);
    if (!(farthest / (body->fixed ? OUT_OF_PROPORTION_FIXED : OUT_OF_PROPORTION) > max_norm(nearest))) return;
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

/* ---- Edges within the window ------------------------------------------------------------------------------------- */

/* Sets `end`, relative to the origin, to where the segment from p to `other` is cut off along axis k: at p if that is
 * within the window along k, otherwise at the border. At most one of the two is near. */
static void cut_end(const sunder_i_body *body, const double p[2], const double other[2], size_t k, double end[2])
{
    const double half = half_window(body), at = p[k] - body->origin[k];
    end[k] = clamp(at, -half, half);
    end[1 - k] = p[1 - k] - body->origin[1 - k];
    if (end[k] == at) return;
    if (is_far(body, other))
        end[1 - k] = other_coordinate(p, other, k, body->origin[k] + end[k]) - body->origin[1 - k];
    else
        end[1 - k] =
            other[1 - k] - body->origin[1 - k] +
            (end[k] - (other[k] - body->origin[k])) * ((p[1 - k] / 2 - other[1 - k] / 2) / (p[k] / 2 - other[k] / 2));
}

/* Sets out to the segment ab relative to the origin, cut off at the window's border along its longer axis. Returns
 * false if no part of positive length remains. */
static bool cut_along(const sunder_i_body *body, const double a[2], const double b[2], double out[4])
{
    const size_t k = longer_axis(a, b);
    cut_end(body, a, b, k, out);
    cut_end(body, b, a, k, out + 2);
    return out[k] != out[2 + k];
}

/* Moves the end p of a segment, whose other end is q, to the window's border along axis c, if it lies beyond. */
static void cut_across(double half, size_t c, double p[2], const double q[2])
{
    if (fabs(p[c]) <= half) return;
    const double at = clamp(p[c], -half, half), share = (at - q[c]) / (p[c] - q[c]);
    p[1 - c] = q[1 - c] + share * (p[1 - c] - q[1 - c]);
    p[c] = at;
}

/* Sets out to the part of the segment ab in the window, relative to the origin. Returns false if there is none of
 * positive length. */
static bool cut_to_window(const sunder_i_body *body, const double a[2], const double b[2], double out[4])
{
    const double half = half_window(body);
    const size_t c = 1 - longer_axis(a, b);
    if (!cut_along(body, a, b, out)) return false;
    if (sunder_i_min(out[c], out[2 + c]) >= half || sunder_i_max(out[c], out[2 + c]) <= -half) return false;
    const double from[2] = {out[0], out[1]};
    cut_across(half, c, out, out + 2);
    cut_across(half, c, out + 2, from);
    return true;
}

void sunder_i_draw_in(const sunder_i_body *body, double *corner, uint32_t n)
{
    double part[4];
    if (n == 2 && cut_along(body, corner, corner + 2, part))
        memcpy(corner, part, sizeof part);
    else
        for (uint32_t k = 0; k < n; k++) draw_in(body, corner + 2 * (size_t)k);
}

/* ---- Pieces within the window ------------------------------------------------------------------------------------ */

/* Returns 1 if `place` is in the interior of the piece, 0 if it is on its border, and -1 if it is outside. */
static int side_of_piece(const piece_as_given *piece, const double place[2])
{
    const sunder_point at = {place[0], place[1]};
    int least = 1;
    for (uint32_t k = piece->from; k < piece->end && least >= 0; k++) {
        const double *p = corner_as_given(piece, k), *q = corner_after(piece, k);
        const int side = sunder_orient(&(sunder_point){p[0], p[1]}, &(sunder_point){q[0], q[1]}, &at);
        least = side < least ? side : least;
    }
    return least;
}

/* Writes to out, counter-clockwise, the corners of the window from corner number `first` for which side_of_piece() is
 * at least `least`, up to the first for which it is not. Corner 0 is the right upper one. Returns their number. */
static size_t take_window_corners(const sunder_i_body *body, const piece_as_given *piece, size_t first, int least,
                                  double *out)
{
    static const double sign[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    const double half = half_window(body);
    size_t n = 0;
    for (; n < 4; n++, out += 2) {
        const double *of = sign[(first + n) % 4];
        const double at[2] = {body->origin[0] + of[0] * half, body->origin[1] + of[1] * half};
        if (side_of_piece(piece, at) < least) break;
        for (size_t c = 0; c < 2; c++) out[c] = of[c] * half;
    }
    return n;
}

/* Returns the number of the window's corner that follows, counter-clockwise, on a place of its border. */
static size_t corner_behind(double half, const double place[2])
{
    if (place[0] >= half && place[1] < half) return 0;
    if (place[1] >= half && place[0] > -half) return 1;
    return place[0] <= -half && place[1] > -half ? 2 : 3;
}

/* For a piece without an edge in the window: writes the window's corners, if it lies in the piece; otherwise a place on
 * its border, since a piece has at least one corner. */
static size_t take_window(const sunder_i_body *body, const piece_as_given *piece, double *out)
{
    const size_t n = take_window_corners(body, piece, 0, 0, out);
    if (n == 4) return n;
    memcpy(out, corner_as_given(piece, piece->from), 2 * sizeof *out);
    draw_in(body, out);
    return 1;
}

static bool has_edge_in_window(const sunder_i_body *body, const piece_as_given *piece)
{
    double part[4];
    uint32_t k = piece->from;
    while (k < piece->end && !cut_to_window(body, corner_as_given(piece, k), corner_after(piece, k), part)) k++;
    return k < piece->end;
}

size_t sunder_i_far_corner(const sunder_i_body *body, const sunder_shape *shape, uint32_t p, uint32_t k, double *out)
{
    const piece_as_given piece = {shape, p ? shape->piece_end[p - 1] : 0, shape->piece_end[p]};
    const double *at = corner_as_given(&piece, k), *after = corner_after(&piece, k);
    double part[4];
    if (piece.end - piece.from <= 2) {
        memcpy(part, at, 2 * sizeof *part);
        memcpy(part + 2, after, 2 * sizeof *part);
        sunder_i_draw_in(body, part, piece.end - piece.from);
        memcpy(out, part, 2 * sizeof *out);
        return 1;
    }
    if (!cut_to_window(body, at, after, part))
        return k == piece.from && !has_edge_in_window(body, &piece) ? take_window(body, &piece, out) : 0;
    memcpy(out, part, 2 * sizeof *out);
    if (!is_far(body, after)) return 1;
    memcpy(out + 2, part + 2, 2 * sizeof *out);
    return 2 + take_window_corners(body, &piece, corner_behind(half_window(body), part + 2), 1, out + 4);
}
