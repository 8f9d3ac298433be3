/* Finds which relative moves resolve a pair.
 *
 * The moves of Q that take it off P are the complement of an open set; the least of them is found by the separation of
 * two shapes. The moves that take Q into P are the erosion { x : Q + x in P }, also exact; with a tolerance, into P + D
 * (grown_shape.c). The pair is resolved by the union of three sets of moves (Q off P, Q into P, P into Q), so the least
 * length is the least of the three. Boxes show beforehand where an erosion is empty or too far away. */
#include "displacement/layer/resolution.h"

#include "separation/separation.h"

#include "base/extremes.h"

#include <math.h>

/* ---- Bounds from boxes ------------------------------------------------------------------------------------------- */

/* Returns a length such that no shorter move takes a set with the box `inner` into one with the box `outer`; INFINITY
 * if no move does. The slack covers the rounding of the corners of Q + D, of boxes and of this computation. */
static double least_by_boxes(const double inner[4], const double outer[4], double tolerance)
{
    double shift[2];
    for (int c = 0; c < 2; c++) {
        const double size = fabs(inner[c]) + fabs(inner[c + 2]) + fabs(outer[c]) + fabs(outer[c + 2]) + tolerance;
        const double slack = tolerance + 0x1p-48 * size;
        const double low = outer[c] - inner[c] - slack, high = outer[c + 2] - inner[c + 2] + slack;
        if (low > high) return INFINITY;
        shift[c] = low > 0 ? low : high < 0 ? -high : 0;
    }
    return hypot(shift[0], shift[1]) * (1 - 0x1p-50);
}

bool sunder_i_may_get_inside(const sunder_i_rules *rules, const double a[4], const double b[4], double reach)
{
    return sunder_i_may_be_inside(rules) &&
           (least_by_boxes(a, b, rules->tolerance) <= reach || least_by_boxes(b, a, rules->tolerance) <= reach);
}

/* ---- Erosion ----------------------------------------------------------------------------------------------------- */

/* The point of an erosion nearest to the origin among those examined. */
typedef struct nearest {
    double least;    /* proved: no point of the erosion is nearer */
    double distance; /* the distance of `place` */
    double place[2];
} nearest;

/* Updates *n by the point of the segment pq nearest to the origin.
 *
 * This is the foot p + s e of the perpendicular, e = q - p, with s clamped to 0 .. 1. Let u = 2^-53, and let no
 * coordinate of the ends exceed M in magnitude. Each coordinate of the ends has an error of at most u M (nearest
 * doubles). e is a rounded difference, with a relative error of u, so s |e| has an error of at most 6 u M, and the foot
 * of 3 u M more. Together this is less than 16 u M. The error of the distance is no larger, as a wrong foot can only be
 * farther away. */
static void take_segment(nearest *n, const double p[2], const double q[2])
{
    const double e[2] = {q[0] - p[0], q[1] - p[1]}, square = e[0] * e[0] + e[1] * e[1];
    double s = square > 0 ? -(p[0] * e[0] + p[1] * e[1]) / square : 0;
    s = sunder_i_min(1, sunder_i_max(0, s));
    const double at[2] = {p[0] + s * e[0], p[1] + s * e[1]}, distance = hypot(at[0], at[1]);
    const double m = sunder_i_max(sunder_i_max(fabs(p[0]), fabs(p[1])), sunder_i_max(fabs(q[0]), fabs(q[1])));
    n->least = sunder_i_min(n->least, sunder_i_max(0, distance - 0x1p-49 * m));
    if (distance >= n->distance) return;
    n->distance = distance;
    n->place[0] = at[0];
    n->place[1] = at[1];
}

static void take_vertices(nearest *n, const sunder_sum *sum, uint32_t from, uint32_t to)
{
    double p[2], q[2];
    sunder_sum_vertex(sum, from, p);
    sunder_sum_vertex(sum, to, q);
    take_segment(n, p, q);
}

/* Does the sum contain the origin? Counts the sides that an upward ray crosses. The answer may be wrong if the origin
 * is on a side or very near to one, but there the distance to that side gives the same bound. */
static bool holds_origin(const sunder_sum *sum, size_t polygons)
{
    bool in = false;
    for (size_t k = 0; k < polygons; k++)
        for (size_t r = 0, m; r < sunder_sum_rings(sum, k); r++) {
            const uint32_t *ring = sunder_sum_ring(sum, k, r, &m);
            for (size_t v = 0; v < m; v++) {
                double p[2], q[2];
                sunder_sum_vertex(sum, ring[v], p);
                sunder_sum_vertex(sum, ring[v + 1 < m ? v + 1 : 0], q);
                if ((p[0] <= 0) != (q[0] <= 0) && p[1] - p[0] / (q[0] - p[0]) * (q[1] - p[1]) > 0) in = !in;
            }
        }
    return in;
}

static void take_sum(nearest *n, const sunder_sum *sum)
{
    sunder_sum_size size;
    sunder_sum_get_size(sum, &size);
    if (holds_origin(sum, size.polygons)) *n = (nearest){0, 0, {0, 0}};
    for (size_t k = 0; k < size.polygons; k++)
        for (size_t r = 0, m; r < sunder_sum_rings(sum, k); r++) {
            const uint32_t *ring = sunder_sum_ring(sum, k, r, &m);
            for (size_t v = 0; v < m; v++) take_vertices(n, sum, ring[v], ring[v + 1 < m ? v + 1 : 0]);
        }
    for (size_t k = 0; k < size.degenerate_segments; k++) {
        uint32_t ends[2];
        sunder_sum_segment(sum, k, ends);
        take_vertices(n, sum, ends[0], ends[1]);
    }
    for (size_t k = 0; k < size.degenerate_points; k++)
        take_vertices(n, sum, sunder_sum_point(sum, k), sunder_sum_point(sum, k));
}

/* Finds the least move that takes `inner` into `outer`, both without and with the tolerance. Both are needed: the
 * corners of the grown shape are rounded to doubles, so it need not contain the other. */
static sunder_status least_inside(const sunder_shape *inner, const sunder_shape *outer, double tolerance, nearest *n,
                                  sunder_error *err)
{
    *n = (nearest){INFINITY, INFINITY, {0, 0}};
    sunder_shape *grown = NULL;
    sunder_status status = tolerance > 0 ? sunder_i_grow_by_tolerance(outer, tolerance, &grown, err) : SUNDER_OK;
    for (int k = 0; k < 2 && !status; k++) {
        const sunder_shape *into = k ? grown : outer;
        sunder_sum *places = NULL;
        if (!into) continue;
        status = sunder_morphology(into, inner, SUNDER_OPERATION_ERODE, NULL, &places, err);
        if (!status) take_sum(n, places);
        sunder_sum_free(places);
    }
    sunder_shape_free(grown);
    return status;
}

/* ---- All three sets ---------------------------------------------------------------------------------------------- */

sunder_status sunder_i_resolve(const sunder_i_rules *rules, double gap, const sunder_shape *a, const sunder_shape *b,
                               double upper, sunder_i_resolution *out, sunder_error *err)
{
    *out = (sunder_i_resolution){0};
    double apart;
    sunder_status status = sunder_i_least_bound(a, b, gap, upper, &apart, out->away, &out->beyond, err);
    if (status) return status;
    out->least = sunder_i_max(0, apart);
    out->apart_beyond = out->beyond = out->beyond || out->least > upper;
    if (!sunder_i_may_be_inside(rules)) return SUNDER_OK;
    double box[2][4];
    sunder_shape_box(a, box[0]);
    sunder_shape_box(b, box[1]);
    double nearest_place = INFINITY;
    for (int k = 0; k < 2 && !status; k++) {
        const sunder_shape *inner = k ? b : a, *outer = k ? a : b;
        const double at_least = least_by_boxes(box[k], box[1 - k], rules->tolerance);
        if (at_least > out->least || at_least >= nearest_place) continue;
        nearest n;
        status = least_inside(inner, outer, rules->tolerance, &n, err);
        if (status) break;
        out->least = sunder_i_min(out->least, n.least);
        out->beyond = out->beyond && n.least > upper;
        if (!(n.distance < nearest_place)) continue;
        nearest_place = n.distance;
        out->inside = true;
        out->a_inside = k == 0;
        /* `place` is a move of b: if a moves into b, b moves the opposite way. */
        for (int c = 0; c < 2; c++) out->place[c] = k ? n.place[c] : -n.place[c];
    }
    return status;
}
