/* straight_path.c: tests whether a point on its straight path meets a set, and whether the set contains the start of
 * the path.
 *
 * A closed set that does not contain the start of the path is met exactly if one of its boundary edges is. So the edges
 * whose boxes meet the path's box are tested (predicate/passage.c, first in doubles). Only if one is met is the start
 * tested against the closed convex pieces, whose union is the set.
 *
 * Vertices that are not doubles (those of a repaired shape) become rational points, and all tests of the set are then
 * done in big integers. */
#include "separation/separation.h"

#include "shape/rational_corners.h"
#include "spatial/box.h"

static const double *corner_of(const sunder_shape *p, uint32_t v) { return p->xy + 2 * (size_t)v; }

static sunder_point point_of(const double xy[2]) { return (sunder_point){xy[0], xy[1]}; }

static bool box_holds(const double box[4], const double at[2])
{
    return box[0] <= at[0] && at[0] <= box[2] && box[1] <= at[1] && at[1] <= box[3];
}

/* ---- Vertices in doubles ----------------------------------------------------------------------------------------- */

static bool holds_doubles(const sunder_shape *p, const double at[2])
{
    const sunder_point c = point_of(at);
    uint32_t from = 0;
    for (uint32_t i = 0; i < p->pieces; from = p->piece_end[i++]) {
        bool in = true;
        for (uint32_t k = from; k < p->piece_end[i] && in; k++) {
            const uint32_t next = k + 1 < p->piece_end[i] ? k + 1 : from;
            const sunder_point a = point_of(corner_of(p, sunder_i_piece_vertices(p)[k])),
                               b = point_of(corner_of(p, sunder_i_piece_vertices(p)[next]));
            in = sunder_orient(&a, &b, &c) >= 0;
        }
        if (in) return true;
    }
    return false;
}

static bool meets_doubles(const sunder_i_passage *way, const double way_box[4], const sunder_shape *p)
{
    for (uint32_t v = 0; v < p->vertices; v++) {
        const double *c = corner_of(p, v), *d = corner_of(p, p->form->cleaned.next[v]);
        double box[4];
        sunder_i_box_of_segment(c, d, box);
        if (sunder_i_box_meet(way_box, box) && sunder_i_passage_meets(way, c, d)) return true;
    }
    return false;
}

/* ---- Rational vertices ------------------------------------------------------------------------------------------- */

/* The vertices of the shape and the two ends of the path, in one unit, a power of two. */
typedef struct rationals {
    sunder_i_arena arena;
    sunder_i_rational_point *corner, from, to;
} rationals;

static sunder_i_rational_point put_double(sunder_i_arena *arena, const double xy[2], long unit)
{
    return (sunder_i_rational_point){sunder_i_big_in_units(arena, xy[0], unit),
                                     sunder_i_big_in_units(arena, xy[1], unit), sunder_i_big_i64(arena, 1)};
}

static sunder_i_rational_point put_corner(sunder_i_arena *arena, const sunder_shape *p, uint32_t v, long unit)
{
    const sunder_i_exact *e = &p->form->numbers->exact[v];
    if (e->den.size == 0) return put_double(arena, corner_of(p, v), unit);
    const unsigned long up = (unsigned long)(e->exponent - unit);
    return (sunder_i_rational_point){sunder_i_big_shl(arena, e->num[0], up), sunder_i_big_shl(arena, e->num[1], up),
                                     e->den};
}

/* Returns the lower one of `unit` and the exponents of the lowest bits of the coordinates of vertex v. */
static long lower_unit(const sunder_shape *p, uint32_t v, long unit)
{
    if (p->form->numbers->exact[v].den.size)
        return p->form->numbers->exact[v].exponent < unit ? p->form->numbers->exact[v].exponent : unit;
    for (int c = 0; c < 2; c++) {
        const int bit = sunder_i_low_bit(corner_of(p, v)[c]);
        if (bit < unit) unit = bit;
    }
    return unit;
}

/* Returns vertex i of those listed in `which`; NULL: of all vertices. */
static uint32_t asked_vertex(const uint32_t *which, uint32_t i) { return which ? which[i] : i; }

static bool put_rationals(rationals *r, const sunder_i_passage *way, const sunder_shape *p, const uint32_t *which,
                          uint32_t n)
{
    const double given[6] = {way->from[0], way->from[1], way->t[0], way->t[1], way->s[0], way->s[1]};
    long unit = p->low_bit;
    for (uint32_t i = 0; i < n; i++) unit = lower_unit(p, asked_vertex(which, i), unit);
    for (size_t k = 0; k < 6; k++)
        if (sunder_i_low_bit(given[k]) < unit) unit = sunder_i_low_bit(given[k]);
    sunder_i_arena_init(&r->arena);
    r->corner = sunder_i_arena_alloc(&r->arena, n, sizeof *r->corner);
    for (uint32_t i = 0; i < n && !r->arena.failed; i++)
        r->corner[i] = put_corner(&r->arena, p, asked_vertex(which, i), unit);
    r->from = put_double(&r->arena, way->from, unit);
    r->to = sunder_i_rational_add(&r->arena, r->from, put_double(&r->arena, way->t, unit));
    r->to = sunder_i_rational_sub(&r->arena, r->to, put_double(&r->arena, way->s, unit));
    return !r->arena.failed;
}

static bool holds_rational(rationals *r, const sunder_shape *p)
{
    uint32_t from = 0;
    for (uint32_t i = 0; i < p->pieces; from = p->piece_end[i++]) {
        bool in = true;
        for (uint32_t k = from; k < p->piece_end[i] && in; k++) {
            const uint32_t next = k + 1 < p->piece_end[i] ? k + 1 : from;
            in = sunder_i_rational_orient(&r->arena, r->corner[sunder_i_piece_vertices(p)[k]],
                                          r->corner[sunder_i_piece_vertices(p)[next]], r->from) >= 0;
        }
        if (in) return true;
    }
    return false;
}

typedef struct meeting {
    rationals *r;
    uint32_t c, d;
} meeting;

static bool share_coordinates(const void *context)
{
    const meeting *m = context;
    rationals *r = m->r;
    const sunder_i_rational_point *c = &r->corner[m->c], *d = &r->corner[m->d];
    for (int k = 0; k < 2; k++) {
        const int cf = sunder_i_rational_cmp(&r->arena, c, &r->from, k),
                  df = sunder_i_rational_cmp(&r->arena, d, &r->from, k),
                  ct = sunder_i_rational_cmp(&r->arena, c, &r->to, k),
                  dt = sunder_i_rational_cmp(&r->arena, d, &r->to, k);
        if ((cf > 0 && df > 0 && ct > 0 && dt > 0) || (cf < 0 && df < 0 && ct < 0 && dt < 0)) return false;
    }
    return true;
}

/* Returns whether the path meets the edge from vertex c to vertex d, as numbered in r->corner. */
static bool meets_edge(rationals *r, uint32_t c, uint32_t d)
{
    const meeting m = {r, c, d};
    const sunder_i_rational_point p = r->corner[c], q = r->corner[d];
    return sunder_i_sides_meet(sunder_i_rational_orient(&r->arena, r->from, r->to, p),
                               sunder_i_rational_orient(&r->arena, r->from, r->to, q),
                               sunder_i_rational_orient(&r->arena, p, q, r->from),
                               sunder_i_rational_orient(&r->arena, p, q, r->to), share_coordinates, &m);
}

static bool meets_rational(rationals *r, const sunder_shape *p)
{
    for (uint32_t v = 0; v < p->vertices && !r->arena.failed; v++) {
        const sunder_i_mark mark = sunder_i_arena_mark(&r->arena);
        const bool meets = meets_edge(r, v, p->form->cleaned.next[v]);
        sunder_i_arena_release(&r->arena, mark);
        if (meets) return true;
    }
    return false;
}

/* Sets *holds to whether the shape contains the start of the path; or, if holds is NULL, *passes to whether the path
 * meets the shape but does not start in it. */
static sunder_status ask_rational(const sunder_i_passage *way, const sunder_shape *p, bool *holds, bool *passes,
                                  sunder_error *err)
{
    rationals r;
    bool answer = false;
    if (put_rationals(&r, way, p, NULL, p->vertices))
        answer = holds ? holds_rational(&r, p) : meets_rational(&r, p) && !holds_rational(&r, p);
    const bool failed = r.arena.failed;
    sunder_i_arena_free(&r.arena);
    if (failed) return sunder_i_failure_cause(err);
    *(holds ? holds : passes) = answer;
    return SUNDER_OK;
}

/* ---- The tests --------------------------------------------------------------------------------------------------- */

sunder_status sunder_i_holds(const sunder_shape *p, const double point[2], bool *holds, sunder_error *err)
{
    *holds = false;
    if (p->pieces == 0 || !box_holds(p->box, point)) return SUNDER_OK;
    const sunder_i_passage stay = {.from = {point[0], point[1]}};
    if (p->rational) return ask_rational(&stay, p, holds, NULL, err);
    *holds = holds_doubles(p, point);
    return SUNDER_OK;
}

sunder_status sunder_i_passes(const sunder_i_passage *passage, const sunder_shape *p, bool *passes, sunder_error *err)
{
    double box[4];
    *passes = false;
    if (p->pieces == 0) return SUNDER_OK;
    sunder_i_passage_box(passage, box);
    if (!sunder_i_box_meet(box, p->box)) return SUNDER_OK;
    if (p->rational) return ask_rational(passage, p, NULL, passes, err);
    *passes = meets_doubles(passage, box, p) && !(box_holds(p->box, passage->from) && holds_doubles(p, passage->from));
    return SUNDER_OK;
}

sunder_status sunder_i_enters_by_edge(const sunder_i_passage *passage, const sunder_shape *p, uint32_t v, bool *enters,
                                      sunder_error *err)
{
    const uint32_t end[2] = {v, p->form->cleaned.next[v]};
    if (!p->rational ||
        (p->form->numbers->exact[end[0]].den.size == 0 && p->form->numbers->exact[end[1]].den.size == 0)) {
        const sunder_point c = point_of(corner_of(p, end[0])), d = point_of(corner_of(p, end[1])),
                           at = point_of(passage->from);
        *enters = sunder_orient(&c, &d, &at) < 0 &&
                  sunder_i_passage_meets(passage, corner_of(p, end[0]), corner_of(p, end[1]));
        return SUNDER_OK;
    }
    rationals r;
    bool answer = false;
    if (put_rationals(&r, passage, p, end, 2))
        answer = sunder_i_rational_orient(&r.arena, r.corner[0], r.corner[1], r.from) < 0 && meets_edge(&r, 0, 1);
    const bool failed = r.arena.failed;
    sunder_i_arena_free(&r.arena);
    if (failed) return sunder_i_failure_cause(err);
    *enters = answer;
    return SUNDER_OK;
}
