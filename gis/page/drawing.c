/* drawing.c: see drawing.h.
 *
 * A ring is clipped by the four sides of a box in turn [Sutherland and Hodgman 1974]. If the ring is not convex, the
 * result may have overlapping edges along a side of the box; the box is larger than the window, so that they are not
 * visible. Coordinates of the picture are rounded to integers and repeated vertices omitted, which keeps the paths of
 * small shapes short. */
#include "page/drawing.h"

#include "base/array.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void gis_picture_place(const gis_picture *picture, double x, double y, double at[2])
{
    const double *w = picture->window;
    at[0] = (x - w[0]) / (w[2] - w[0]) * picture->width;
    at[1] = (w[3] - y) / (w[3] - w[1]) * picture->height;
}

double gis_picture_length(const gis_picture *picture, double length)
{
    return length / (picture->window[2] - picture->window[0]) * picture->width;
}

void gis_corners_clear(gis_corners *corners)
{
    free(corners->xy);
    *corners = (gis_corners){0};
}

static bool reserve_corners(gis_corners *corners, size_t n, gis_error *error)
{
    return gis_array_reserve(&corners->xy, &corners->capacity, 2 * n, sizeof *corners->xy) || gis_no_memory(error);
}

/* ---- Clipping ---------------------------------------------------------------------------------------------------- */

/* Returns the signed distance of `at` from side k of the box (0 to 3: minimum x, minimum y, maximum x, maximum y); it
 * is positive inside. */
static double distance_inside(const double *at, const double box[4], int k)
{
    return k < 2 ? at[k] - box[k] : box[k] - at[k - 2];
}

/* Clips the ring of n vertices at `from` by side k of the box. Writes the result to `to`, which has room for 2 * n
 * vertices, and returns its number of vertices. */
static size_t cut_by_side(const double *from, size_t n, const double box[4], int k, double *to)
{
    size_t m = 0;
    for (size_t i = 0; i < n; i++) {
        const double *a = from + 2 * (i ? i - 1 : n - 1), *b = from + 2 * i;
        double in_a = distance_inside(a, box, k), in_b = distance_inside(b, box, k);
        if ((in_a < 0) != (in_b < 0)) {
            double part = in_a / (in_a - in_b);
            to[2 * m] = a[0] + part * (b[0] - a[0]);
            to[2 * m + 1] = a[1] + part * (b[1] - a[1]);
            m++;
        }
        if (in_b >= 0) {
            memcpy(to + 2 * m, b, 2 * sizeof *to);
            m++;
        }
    }
    return m;
}

/* Moves the ring, converts it to coordinates of the picture and clips it; the result is in *scratch. Each side of the
 * box at most doubles the number of vertices, since a ring may leave and enter the box between any two. */
static bool cut_ring(const gis_picture *picture, const double *ring, size_t n, const double move[2],
                     gis_corners *scratch, gis_error *error)
{
    const double width = picture->width, height = picture->height;
    const double box[4] = {-0.1 * width, -0.1 * height, 1.1 * width, 1.1 * height};
    bool outside = false;
    if (!reserve_corners(scratch, n, error)) return false;
    for (size_t i = 0; i < n; i++) {
        double *at = scratch->xy + 2 * i;
        gis_picture_place(picture, ring[2 * i] + move[0], ring[2 * i + 1] + move[1], at);
        for (int k = 0; k < 4; k++) outside = outside || distance_inside(at, box, k) < 0;
    }
    scratch->n = n;
    for (int k = 0; outside && k < 4; k++) {
        if (!reserve_corners(scratch, 3 * scratch->n, error)) return false;
        double *cut = scratch->xy + 2 * scratch->n;
        size_t m = cut_by_side(scratch->xy, scratch->n, box, k, cut);
        memmove(scratch->xy, cut, 2 * m * sizeof *cut);
        scratch->n = m;
    }
    return true;
}

static void add_ring(const gis_corners *ring, gis_text *to)
{
    long first[2] = {0, 0}, last[2] = {0, 0};
    for (size_t i = 0; i < ring->n; i++) {
        const long x = lround(ring->xy[2 * i]), y = lround(ring->xy[2 * i + 1]);
        if (i == 0) {
            gis_text_print(to, "M%ld %ldl", x, y);
            first[0] = x;
            first[1] = y;
        } else if (x != last[0] || y != last[1]) {
            gis_text_print(to, "%ld %ld ", x - last[0], y - last[1]);
        }
        last[0] = x;
        last[1] = y;
    }
    /* a ring that is rounded to one point gets the width of one unit, so that it is visible */
    if (ring->n > 0) gis_text_add(to, last[0] == first[0] && last[1] == first[1] ? "1 0 0 1z" : "0 0z");
}

bool gis_picture_add_shape(const gis_picture *picture, const sunder_shape *shape, const double move[2],
                           gis_corners *scratch, gis_text *to, gis_error *error)
{
    for (size_t p = 0; p < sunder_shape_polygons(shape); p++)
        for (size_t r = 0; r < sunder_shape_rings(shape, p); r++) {
            size_t n;
            const double *ring = sunder_shape_ring(shape, p, r, &n);
            if (!cut_ring(picture, ring, n, move, scratch, error)) return false;
            add_ring(scratch, to);
        }
    return true;
}

/* Returns whether the segment ab may be visible: false if both ends lie beyond the same side of the picture by more
 * than its width or height. */
static bool may_be_seen(const gis_picture *picture, const double a[2], const double b[2])
{
    const double size[2] = {picture->width, picture->height};
    for (int k = 0; k < 2; k++)
        if (fmax(a[k], b[k]) < -size[k] || fmin(a[k], b[k]) > 2 * size[k]) return false;
    return true;
}

/* Rounds a coordinate to an integer and limits it to +-1e8: a point farther away only determines the direction of a
 * line. */
static long whole_units(double value)
{
    const double most = 1e8;
    return lround(fmax(-most, fmin(most, value)));
}

void gis_picture_add_line(const gis_picture *picture, const double *xy, size_t n, gis_text *to)
{
    double last[2], at[2];
    bool open = false;
    for (size_t i = 0; i < n; i++) {
        gis_picture_place(picture, xy[2 * i], xy[2 * i + 1], at);
        if (i == 0) memcpy(last, at, sizeof at);
        bool seen = (i > 0 || n == 1) && may_be_seen(picture, last, at);
        long dx = whole_units(at[0]) - whole_units(last[0]), dy = whole_units(at[1]) - whole_units(last[1]);
        if (seen && !open) gis_text_print(to, "M%ld %ldl", whole_units(last[0]), whole_units(last[1]));
        if (seen && (!open || dx || dy)) gis_text_print(to, "%ld %ld ", dx, dy);
        open = seen;
        memcpy(last, at, sizeof at);
    }
}

/* ---- Simplification ---------------------------------------------------------------------------------------------- */

static double squared_distance(const double *p, const double *a, const double *b)
{
    double x = b[0] - a[0], y = b[1] - a[1], u = p[0] - a[0], v = p[1] - a[1], length = x * x + y * y;
    double part = length > 0 ? fmin(1, fmax(0, (u * x + v * y) / length)) : 0;
    return (u - part * x) * (u - part * x) + (v - part * y) * (v - part * y);
}

/* Returns the vertex between `first` and `last` that is farthest from the segment between these two, and the square of
 * its distance; n stands for vertex 0. Returns `first` if all distances are 0. */
static size_t farthest_corner(const double *xy, size_t n, size_t first, size_t last, double *distance)
{
    size_t best = first;
    *distance = 0;
    for (size_t i = first + 1; i < last; i++) {
        double d = squared_distance(xy + 2 * i, xy + 2 * first, xy + 2 * (last % n));
        if (d > *distance) {
            *distance = d;
            best = i;
        }
    }
    return best;
}

/* Marks in keep[] the vertices between `first` and `last` that the simplification keeps [DP73]. The recursion uses
 * `stack`, which holds the ends of the second halves; its depth is at most n. */
static void keep_between(const double *xy, size_t n, size_t first, size_t last, double tolerance, bool *keep,
                         size_t *stack)
{
    size_t depth = 0;
    for (;;) {
        double distance;
        size_t middle = farthest_corner(xy, n, first, last, &distance);
        if (distance > tolerance * tolerance) {
            keep[middle] = true;
            stack[depth++] = last;
            last = middle;
        } else if (depth > 0) {
            first = last;
            last = stack[--depth];
        } else {
            return;
        }
    }
}

/* Marks in keep[] the vertices that the simplification of a ring or of a line keeps. */
static void keep_ring(const double *xy, size_t n, double tolerance, bool *keep, size_t *stack)
{
    /* the ring is divided at its first vertex and at the vertex farthest from that one */
    size_t opposite = 0;
    double most = 0;
    for (size_t i = 1; i < n; i++) {
        double d = squared_distance(xy + 2 * i, xy, xy);
        if (d > most) {
            most = d;
            opposite = i;
        }
    }
    keep[0] = keep[opposite] = true;
    if (!(most > tolerance * tolerance)) return;
    keep_between(xy, n, 0, opposite, tolerance, keep, stack);
    keep_between(xy, n, opposite, n, tolerance, keep, stack);
}

static void keep_line(const double *xy, size_t n, double tolerance, bool *keep, size_t *stack)
{
    keep[0] = keep[n - 1] = true;
    keep_between(xy, n, 0, n - 1, tolerance, keep, stack);
}

static bool simplify_corners(gis_corners *corners, const double *xy, size_t n, double tolerance, bool closed,
                             gis_error *error)
{
    corners->n = 0;
    if (n == 0) return true;
    bool *keep = calloc(n, sizeof *keep);
    size_t *stack = malloc((n + 1) * sizeof *stack);
    bool ok = (keep && stack && reserve_corners(corners, n, error)) || gis_no_memory(error);
    if (ok) {
        (closed ? keep_ring : keep_line)(xy, n, tolerance, keep, stack);
        for (size_t i = 0; i < n; i++)
            if (keep[i]) memcpy(corners->xy + 2 * corners->n++, xy + 2 * i, 2 * sizeof *xy);
        if (closed && corners->n < 3) corners->n = 0;
    }
    free(keep);
    free(stack);
    return ok;
}

bool gis_corners_simplify(gis_corners *corners, const double *xy, size_t n, double tolerance, gis_error *error)
{
    return simplify_corners(corners, xy, n, tolerance, true, error);
}

bool gis_corners_simplify_line(gis_corners *corners, const double *xy, size_t n, double tolerance, gis_error *error)
{
    return simplify_corners(corners, xy, n, tolerance, false, error);
}
