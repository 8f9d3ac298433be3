/* part_links.c: the shortest neck or inner gap of a part.
 *
 * A link is a segment between two boundary points whose distance is a local minimum. The distance of two points is
 * convex on each pair of edges, so the point pair is a local minimum exactly if no direction along the boundary, at
 * either end, makes it shorter to first order: if no edge at an end makes an acute angle with the link. So three kinds
 * of links are examined, by the signs of cross and dot products:
 *
 *   - from a vertex to a vertex,
 *   - from a vertex to the foot of its perpendicular, strictly inside of an edge,
 *   - between two antiparallel edges: all perpendicular links over the part of positive length in which they face each
 *     other are equally long, and one that is clear suffices. A link over a single point is one of the other kinds.
 *
 * On which side does a link leave a vertex? Let it make no acute angle with the two edges there. A sector of less than
 * half a turn between the edges contains no such direction, as its angles to the two edges sum to less than that.
 * So a link leaves a reflex vertex into the interior, and a convex one to the outside, and needs no further test.
 *
 * Where the boundary touches itself, at a vertex, the length is 0: to either side of the vertex the part and the
 * outside widen from nothing. The shape has vertices of its own on an edge that is touched from inside. */
#include "legibility/legibility.h"

#include "separation/answer/root.h"

#include "base/extremes.h"
#include "base/watch.h"

#include <math.h>

typedef struct search {
    sunder_i_part_read *part;
    bool inside;
    double limit, slack; /* slack: a bound of the error of a distance in doubles; INFINITY: there is none */
    sunder_i_list near, between;
    bool found;
    double least; /* the length of the shortest link so far; INFINITY: none */
    sunder_illegible *out;
    bool failed; /* out of memory */
} search;

static sunder_i_point side_of(const search *s, uint32_t e)
{
    return sunder_i_point_sub(&s->part->placed.lattice, sunder_i_part_at(s->part, sunder_i_part_next(s->part, e)),
                              sunder_i_part_at(s->part, e));
}

static sunder_i_point vector(const search *s, uint32_t from, uint32_t to)
{
    return sunder_i_point_sub(&s->part->placed.lattice, sunder_i_part_at(s->part, to), sunder_i_part_at(s->part, from));
}

/* Does a link that makes no acute angle with the edges at v leave it on the side that is searched? */
static bool leaves_vertex(const search *s, uint32_t v)
{
    const sunder_i_part_read *p = s->part;
    const int turn = sunder_i_orient(&s->part->placed.lattice, sunder_i_part_at(p, sunder_i_part_prev(p, v)),
                                     sunder_i_part_at(p, v), sunder_i_part_at(p, sunder_i_part_next(p, v)));
    return s->inside ? turn < 0 : turn > 0;
}

/* Sets xy to the point of edge e at a place from 0 to 1. */
static void point_along(const search *s, uint32_t e, double at, double xy[2])
{
    const double *a = sunder_i_part_xy(s->part, e), *b = sunder_i_part_xy(s->part, sunder_i_part_next(s->part, e));
    for (int c = 0; c < 2; c++) xy[c] = a[c] + at * (b[c] - a[c]);
}

/* Sets xy to the point of edge e that is nearest to a point, in doubles. */
static void nearest_along(const search *s, uint32_t e, const double to[2], double xy[2])
{
    const double *a = sunder_i_part_xy(s->part, e), *b = sunder_i_part_xy(s->part, sunder_i_part_next(s->part, e));
    const double u[2] = {b[0] - a[0], b[1] - a[1]}, v[2] = {to[0] - a[0], to[1] - a[1]};
    const double at = (u[0] * v[0] + u[1] * v[1]) / (u[0] * u[0] + u[1] * u[1]);
    point_along(s, e, at >= 0 ? sunder_i_min(1, at) : 0, xy);
}

/* ---- Is a distance below the limit? ------------------------------------------------------------------------------ */

/* The error of a distance of a vertex and an edge in doubles. Differences of coordinates and the four operations on
 * them have relative errors of at most 2^-53 each, and each number is at most twice the part's extent: fewer than 32
 * such errors of this size. Corners that are no doubles have an error of their own, by rounding. Numbers whose squares
 * are out of the range of doubles have no bound. */
static double slack_of(const sunder_i_part_read *part)
{
    const double *b = part->box, size = hypot(b[2] - b[0], b[3] - b[1]);
    if (!(size > 0x1p-400 && size < 0x1p400)) return INFINITY;
    const double far = sunder_i_max(sunder_i_max(fabs(b[0]), fabs(b[2])), sunder_i_max(fabs(b[1]), fabs(b[3])));
    return 0x1p-46 * size + (part->shape->rational ? 0x1p-50 * far : 0);
}

/* Compares the distance of vertex v and edge f with the limit in doubles: -1 below, 1 not below, 0 uncertain. *meet
 * becomes whether they may meet. */
static int rough_cmp(const search *s, uint32_t v, uint32_t f, bool *meet)
{
    const double *a = sunder_i_part_xy(s->part, f), *b = sunder_i_part_xy(s->part, sunder_i_part_next(s->part, f));
    const double *at = sunder_i_part_xy(s->part, v);
    const double u[2] = {b[0] - a[0], b[1] - a[1]}, w[2] = {at[0] - a[0], at[1] - a[1]};
    const double along = (u[0] * w[0] + u[1] * w[1]) / (u[0] * u[0] + u[1] * u[1]);
    const double t = along >= 0 ? sunder_i_min(1, along) : 0;
    const double distance = hypot(w[0] - t * u[0], w[1] - t * u[1]);
    *meet = !(distance > s->slack);
    if (distance - s->slack > s->limit) return 1;
    return distance + s->slack < s->limit ? -1 : 0;
}

/* ---- Lengths ----------------------------------------------------------------------------------------------------- */

/* Sets *length to the distance of two vertices, as the nearest double. Returns whether it is below the limit. */
static bool vertex_distance(const search *s, uint32_t v, uint32_t w, double *length)
{
    sunder_i_lattice *l = &s->part->placed.lattice;
    const sunder_i_mark mark = sunder_i_lattice_begin(l);
    sunder_i_arena *m = &l->scratch;
    const sunder_i_rational_point u =
        sunder_i_rational_diff(m, l, sunder_i_part_at(s->part, w), sunder_i_part_at(s->part, v));
    const sunder_i_big square = sunder_i_rational_dot(m, u, u);
    const bool below = sunder_i_distance_below(l, square, sunder_i_big_mul(m, u.w, u.w), s->limit);
    double down;
    if (below) sunder_i_root(m, square, u.w, l->exponent, length, &down);
    sunder_i_lattice_end(l, mark);
    return below;
}

/* Sets *length to the distance of vertex v from the line of edge f, as the nearest double, and *foot to the foot of the
 * perpendicular, as a point of the lattice. Returns whether the distance is below the limit; otherwise nothing is set.
 * With a = v - f.a and d = f.b - f.a the distance is |a x d| / |d|, and the foot is f.a + (a.d / d.d) d. */
static bool line_distance(const search *s, uint32_t v, uint32_t f, double *length, sunder_i_point *foot)
{
    sunder_i_lattice *l = &s->part->placed.lattice;
    const sunder_i_mark mark = sunder_i_lattice_begin(l);
    sunder_i_arena *m = &l->scratch;
    const sunder_i_point from = sunder_i_part_at(s->part, f);
    const sunder_i_rational_point d =
        sunder_i_rational_diff(m, l, sunder_i_part_at(s->part, sunder_i_part_next(s->part, f)), from);
    const sunder_i_rational_point a = sunder_i_rational_diff(m, l, sunder_i_part_at(s->part, v), from);
    const sunder_i_big square = sunder_i_rational_dot(m, d, d), cross = sunder_i_rational_cross(m, a, d);
    /* the denominator of d cancels: |a x d| / |d| = sqrt((a x d)^2 d.d) / (a.w d.d), products of numerators */
    const sunder_i_big over = sunder_i_big_mul(m, square, a.w), area = sunder_i_big_mul(m, cross, cross);
    const bool below = sunder_i_distance_below(l, area, sunder_i_big_mul(m, over, a.w), s->limit);
    if (below) {
        double down;
        sunder_i_root(m, sunder_i_big_mul(m, area, square), over, l->exponent, length, &down);
        const sunder_i_big along = sunder_i_rational_dot(m, a, d);
        const sunder_i_rational_point step = {sunder_i_big_mul(m, along, d.x), sunder_i_big_mul(m, along, d.y),
                                              sunder_i_big_mul(m, over, d.w)};
        *foot = sunder_i_rational_put(l, sunder_i_rational_add(m, sunder_i_rational_get(m, l, from), step));
    }
    sunder_i_lattice_end(l, mark);
    return below;
}

/* ---- Findings ---------------------------------------------------------------------------------------------------- */

static void offer(search *s, double length, const double from[2], const double to[2])
{
    s->found = true;
    s->least = length;
    s->out->has = length;
    for (int c = 0; c < 2; c++) {
        s->out->from[c] = from[c];
        s->out->to[c] = to[c];
    }
}

static void offer_if_clear(search *s, uint32_t v, uint32_t w, bool foot, sunder_i_point end, double length)
{
    bool clear;
    if (length >= s->least) return;
    if (!sunder_i_link_clear(s->part, v, w, foot, end, &s->between, &clear)) {
        s->failed = true;
        return;
    }
    double to[2] = {sunder_i_part_xy(s->part, w)[0], sunder_i_part_xy(s->part, w)[1]};
    if (foot) nearest_along(s, w, sunder_i_part_xy(s->part, v), to);
    if (clear) offer(s, length, sunder_i_part_xy(s->part, v), to);
}

/* ---- The three kinds --------------------------------------------------------------------------------------------- */

/* Does a link from v to w make no acute angle with the edges at v, and leave it on the side that is searched? */
static bool ends_at_vertex(const search *s, uint32_t v, uint32_t w)
{
    sunder_i_lattice *l = &s->part->placed.lattice;
    const sunder_i_point u = vector(s, v, w);
    return sunder_i_dot_sign(l, u, vector(s, v, sunder_i_part_next(s->part, v))) <= 0 &&
           sunder_i_dot_sign(l, u, vector(s, v, sunder_i_part_prev(s->part, v))) <= 0 && leaves_vertex(s, v);
}

static void take_vertices(search *s, uint32_t v, uint32_t w)
{
    double length;
    if (ends_at_vertex(s, v, w) && ends_at_vertex(s, w, v) && vertex_distance(s, v, w, &length))
        offer_if_clear(s, v, w, false, sunder_i_part_at(s->part, w), length);
}

/* The foot of v is strictly inside of edge f. A neighbour of v that is nearer to the line of f than v makes an acute
 * angle. */
static void take_foot(search *s, uint32_t v, uint32_t f)
{
    sunder_i_lattice *l = &s->part->placed.lattice;
    const sunder_i_point d = side_of(s, f);
    const int side = sunder_i_cross_sign(l, d, vector(s, f, v));
    if (side != (s->inside ? 1 : -1) || !leaves_vertex(s, v)) return;
    if (side * sunder_i_cross_sign(l, d, vector(s, v, sunder_i_part_next(s->part, v))) < 0 ||
        side * sunder_i_cross_sign(l, d, vector(s, v, sunder_i_part_prev(s->part, v))) < 0)
        return;
    sunder_i_point foot;
    double length;
    if (line_distance(s, v, f, &length, &foot)) offer_if_clear(s, v, f, true, foot, length);
}

/* Edges e and f, if they are antiparallel and face each other on the side that is searched, over a part of positive
 * length, nearer than the limit. */
static void take_edges(search *s, uint32_t e, uint32_t f)
{
    sunder_i_part_read *p = s->part;
    sunder_i_lattice *l = &p->placed.lattice;
    const sunder_i_point d = side_of(s, e), c = side_of(s, f);
    if (sunder_i_cross_sign(l, d, c) != 0 || sunder_i_dot_sign(l, d, c) > 0) return;
    if (sunder_i_cross_sign(l, d, vector(s, e, f)) != (s->inside ? 1 : -1)) return;
    const uint32_t e_end = sunder_i_part_next(p, e), f_end = sunder_i_part_next(p, f);
    const uint32_t low = sunder_i_dot_sign(l, d, vector(s, e, f_end)) > 0 ? f_end : e;
    const uint32_t high = sunder_i_dot_sign(l, d, vector(s, f, e_end)) > 0 ? f : e_end;
    if (sunder_i_dot_sign(l, d, vector(s, low, high)) <= 0) return;
    const uint32_t other = low == e ? f : e;
    sunder_i_point foot;
    double length, place = 0, from[2], to[2];
    bool clear;
    if (rough_cmp(s, low, other, &clear) > 0) return;
    if (!line_distance(s, low, other, &length, &foot) || length >= s->least) return;
    if (!sunder_i_links_clear(p, e, f, low, high, &s->between, &clear, &place))
        s->failed = true;
    else if (clear) {
        point_along(s, e, place, from);
        nearest_along(s, f, from, to);
        offer(s, length, from, to);
    }
}

/* ---- All pairs --------------------------------------------------------------------------------------------------- */

/* Vertex v and edge f, which does not begin or end there. */
static void take_vertex(search *s, uint32_t v, uint32_t f)
{
    sunder_i_lattice *l = &s->part->placed.lattice;
    const uint32_t f_end = sunder_i_part_next(s->part, f);
    const sunder_i_point at = sunder_i_part_at(s->part, v), a = sunder_i_part_at(s->part, f),
                         b = sunder_i_part_at(s->part, f_end);
    bool meet;
    if (rough_cmp(s, v, f, &meet) > 0) return;
    if (meet && sunder_i_segments_meet(l, at, at, a, b) != SUNDER_I_APART) {
        offer(s, 0, sunder_i_part_xy(s->part, v), sunder_i_part_xy(s->part, v));
        return;
    }
    const sunder_i_point d = side_of(s, f);
    if (sunder_i_dot_sign(l, d, vector(s, f, v)) <= 0)
        take_vertices(s, v, f);
    else if (sunder_i_dot_sign(l, d, vector(s, v, f_end)) > 0)
        take_foot(s, v, f);
}

static void take_pair(search *s, uint32_t e, uint32_t f)
{
    if (f == e) return;
    if (sunder_i_part_next(s->part, f) != e) take_vertex(s, e, f);
    if (e < f) take_edges(s, e, f);
}

sunder_status sunder_i_part_links(sunder_i_part_read *part, bool inside, double limit, bool *found,
                                  sunder_illegible *out, sunder_error *err)
{
    search s = {.part = part, .inside = inside, .limit = limit, .slack = slack_of(part), .least = INFINITY, .out = out};
    for (uint32_t k = 0; k < part->n && s.least > 0 && !s.failed; k++) {
        double box[4], wide[4];
        sunder_i_part_edge_box(part, part->first + k, box);
        sunder_i_box_grow(box, s.limit, wide);
        s.near.n = 0;
        s.failed = !sunder_i_rtree_query(&part->tree, wide, &s.near) || !sunder_i_steps(s.near.n);
        for (size_t i = 0; i < s.near.n && s.least > 0 && !s.failed; i++)
            take_pair(&s, part->first + k, part->first + s.near.item[i]);
    }
    sunder_i_free_all(s.near.item, s.between.item);
    if (s.failed || part->placed.lattice.arena.failed) return sunder_i_failure_cause(err);
    *found = s.found;
    return SUNDER_OK;
}
