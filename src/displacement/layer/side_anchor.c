/* The side anchor of a feature to which the caller gave none: a point of the largest part that the lines of barriers
 * leave of it.
 *
 * Each member of the feature is cut by the lines separately. A part is a connected component of a member's interior
 * without the lines. So a line that ends inside cuts off nothing, and a ring inside separates its interior from the
 * rest. The rule:
 *
 *   no line meets a member's interior        the plain anchor (sunder_shape_anchor())
 *   else: take the parts whose area is at    keep those with the most room (side_room.c)
 *     most the tolerance, times width plus
 *     height of the feature's box, less
 *     than the largest area
 *   among these, take those of the largest   the plain anchor, if one of them contains it, off all lines
 *   area
 *   else                                     on the horizontal line at the middle of a part's height, the middle of the
 *                                            widest interval that the part, without the lines, has there, the first
 *                                            from the left of equal ones; of several parts the smallest such point by
 *                                            x, then y. It is rounded to doubles; the part must contain the rounded
 *                                            point, off all lines
 *   else                                     the plain anchor: a part that contains no doubles there is a few units in
 *                                            the last place wide
 *
 * All of this is exact (side_cut.c). */
#include "displacement/layer/side_cut.h"

#include "base/error.h"
#include "base/sort.h"
#include "shape/shape.h"

/* ---- The point of one part --------------------------------------------------------------------------------------- */

/* The points of a part's boundary at one height. */
typedef struct level {
    sunder_i_rational_point low, high; /* corners with the least and the greatest height */
    bool any;
    sunder_i_rational_point height; /* a point at this height */
    sunder_i_rational_point *at;
    size_t n, capacity;
    bool failed;
} level;

static void add_height(sunder_i_side_cut *c, const sunder_i_rational_point *a, const sunder_i_rational_point *b,
                       void *context)
{
    level *l = context;
    (void)b;
    if (!l->any || sunder_i_rational_cmp(&c->arena, a, &l->low, 1) < 0) l->low = *a;
    if (!l->any || sunder_i_rational_cmp(&c->arena, a, &l->high, 1) > 0) l->high = *a;
    l->any = true;
}

static void append_point(level *l, sunder_i_rational_point at)
{
    if (!sunder_i_reserve(&l->at, &l->capacity, l->n + 1, sizeof *l->at))
        l->failed = true;
    else
        l->at[l->n++] = at;
}

/* Appends the point where the edge ab meets the height of l: its beginning a, or a point inside it. If p and q are the
 * heights of a and b relative to that of l, with opposite signs, the point is a + (b - a) p / (p - q). */
static void add_crossing(sunder_i_side_cut *c, const sunder_i_rational_point *a, const sunder_i_rational_point *b,
                         void *context)
{
    level *l = context;
    sunder_i_arena *m = &c->arena;
    const int below = sunder_i_rational_cmp(m, a, &l->height, 1), above = sunder_i_rational_cmp(m, b, &l->height, 1);
    if (below == 0) append_point(l, *a);
    if (below * above >= 0) return;
    const sunder_i_rational_point p = sunder_i_rational_sub(m, *a, l->height),
                                  q = sunder_i_rational_sub(m, *b, l->height);
    /* p and q as numerators over one denominator. */
    const sunder_i_big py = sunder_i_times(m, p.y, q.w), qy = sunder_i_times(m, q.y, p.w);
    const sunder_i_big den = sunder_i_big_sub(m, py, qy);
    const sunder_i_rational_point u = sunder_i_rational_sub(m, *b, *a);
    sunder_i_rational_point step = {sunder_i_big_mul(m, u.x, py), sunder_i_big_mul(m, u.y, py),
                                    sunder_i_big_mul(m, u.w, den)};
    if (sunder_i_big_sign(step.w) < 0)
        step = (sunder_i_rational_point){sunder_i_big_neg(step.x), sunder_i_big_neg(step.y), sunder_i_big_neg(step.w)};
    append_point(l, sunder_i_rational_add(m, *a, step));
}

typedef struct point_order {
    sunder_i_side_cut *c;
    const sunder_i_rational_point *at;
} point_order;

static int by_x(void *context, uint32_t a, uint32_t b)
{
    const point_order *s = context;
    return sunder_i_rational_cmp(&s->c->arena, &s->at[a], &s->at[b], 0);
}

static sunder_i_rational_point middle_of(sunder_i_side_cut *c, const sunder_i_rational_point *a,
                                         const sunder_i_rational_point *b)
{
    sunder_i_rational_point sum = sunder_i_rational_add(&c->arena, *a, *b);
    sum.w = sunder_i_big_shl(&c->arena, sum.w, 1);
    return sum;
}

/* Sets *out to the middle of the widest interval that the part has at the height of l. There always is one; if none is
 * found memory was out. */
static sunder_status widest_interval(sunder_i_side_cut *c, const sunder_i_cut_part *p, const level *l,
                                     const uint32_t *order, sunder_i_rational_point *out, sunder_error *err)
{
    sunder_i_rational_point widest = {.w = {NULL, 0}};
    for (size_t k = 1; k < l->n; k++) {
        const sunder_i_rational_point *a = &l->at[order[k - 1]], *b = &l->at[order[k]];
        const sunder_i_rational_point width = sunder_i_rational_sub(&c->arena, *b, *a);
        if (sunder_i_big_sign(width.x) <= 0 ||
            (widest.w.size && sunder_i_rational_cmp(&c->arena, &width, &widest, 0) <= 0))
            continue;
        const sunder_i_rational_point middle = middle_of(c, a, b);
        bool in;
        const sunder_status status = sunder_i_side_cut_holds(p, middle, &in, err);
        if (status) return status;
        if (!in) continue;
        widest = width;
        *out = middle;
    }
    return widest.w.size && !c->arena.failed ? SUNDER_OK : sunder_i_failure_cause(err);
}

static sunder_status point_of(sunder_i_side_cut *c, const sunder_i_cut_part *p, sunder_i_rational_point *out,
                              sunder_error *err)
{
    level l = {.n = 0};
    sunder_i_side_cut_boundary(c, p, add_height, &l);
    l.height = middle_of(c, &l.low, &l.high);
    sunder_i_side_cut_boundary(c, p, add_crossing, &l);
    uint32_t *order = sunder_i_alloc(l.n, sizeof *order);
    for (uint32_t k = 0; order && k < l.n; k++) order[k] = k;
    point_order s = {c, l.at};
    sunder_status status = SUNDER_OK;
    if (!order || l.failed || !sunder_i_sort_indices(order, l.n, by_x, &s)) status = sunder_i_failure_cause(err);
    if (!status) status = widest_interval(c, p, &l, order, out, err);
    sunder_i_free_all(order, l.at);
    return status;
}

/* ---- The side anchor --------------------------------------------------------------------------------------------- */

/* On entry `anchor` is the plain anchor. Unless one of the remaining parts, which have equal areas, contains it, sets
 * `anchor` to the point of one of them, rounded to doubles, if that part contains the rounded point. */
static sunder_status choose_part(sunder_i_side_cut *c, double anchor[2], sunder_error *err)
{
    const sunder_i_rational_point plain = sunder_i_side_cut_point(c, anchor);
    sunder_i_rational_point best = {.w = {NULL, 0}};
    const sunder_i_cut_part *of = NULL;
    sunder_status status = SUNDER_OK;
    bool in = false;
    for (size_t k = 0; k < c->parts && !in && !status; k++)
        status = sunder_i_side_cut_holds(&c->part[k], plain, &in, err);
    if (status || in) return status;
    for (size_t k = 0; k < c->parts && !status; k++) {
        sunder_i_rational_point at;
        status = point_of(c, &c->part[k], &at, err);
        if (status) return status;
        int order = of ? sunder_i_rational_cmp(&c->arena, &at, &best, 0) : -1;
        if (of && order == 0) order = sunder_i_rational_cmp(&c->arena, &at, &best, 1);
        if (order >= 0) continue;
        best = at;
        of = &c->part[k];
    }
    double xy[2] = {0, 0};
    if (of) sunder_i_side_cut_doubles(c, &best, xy);
    if (of) status = sunder_i_side_cut_holds(of, sunder_i_side_cut_point(c, xy), &in, err);
    if (!status && in)
        for (int k = 0; k < 2; k++) anchor[k] = xy[k];
    return status;
}

/* Does the line lie beside the shape, with all its vertices strictly on one side? Returns false if corners are not
 * doubles; these cases are decided later. */
static bool lies_beside(const sunder_shape *s, const sunder_i_side *side)
{
    const sunder_point a = {side->from[0], side->from[1]}, b = {side->to[0], side->to[1]};
    int sign = 0;
    if (s->rational || (side->area && side->area->rational)) return false;
    for (uint32_t v = 0; v < s->vertices; v++) {
        const sunder_point at = {s->xy[2 * (size_t)v], s->xy[2 * (size_t)v + 1]};
        const int now = sunder_orient(&a, &b, &at);
        if (now == 0 || now == -sign) return false;
        sign = now;
    }
    return true;
}

/* Keeps only the parts with the most room. */
static sunder_status keep_roomiest(sunder_i_side_cut *c, const sunder_i_side_scope *scope, sunder_error *err)
{
    const double reach = sunder_side_reach(c->shape->box);
    const sunder_i_side *const *line;
    sunder_i_ratio most = {.den = {NULL, 0}};
    double box[4];
    size_t lines, kept = 0;
    sunder_i_box_grow(c->shape->box, reach, box);
    if (!scope->find(scope->user, box, &line, &lines)) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < c->parts; k++) {
        sunder_i_rational_point at;
        const sunder_status status = point_of(c, &c->part[k], &at, err);
        if (status) return status;
        const sunder_i_ratio room = sunder_i_side_room(c, at, line, lines, reach);
        const int order = most.den.size ? sunder_i_ratio_cmp(&c->arena, room, most) : 1;
        if (order > 0) {
            most = room;
            kept = 0;
        }
        if (order >= 0) c->part[kept++] = c->part[k];
    }
    c->parts = kept;
    return SUNDER_OK;
}

/* Chooses the side anchor, given the n lines that may meet the shape's interior. */
static sunder_status choose_among_lines(const sunder_shape *shape, const sunder_i_side *const *side, size_t n,
                                        const sunder_i_side_scope *scope, double anchor[2], sunder_error *err)
{
    const double *box = shape->box, slack = scope->tolerance * ((box[2] - box[0]) + (box[3] - box[1]));
    sunder_i_side_cut cut;
    sunder_status status = sunder_i_side_cut_make(shape, side, n, &cut, err);
    if (!status && cut.any) {
        sunder_i_side_cut_keep_largest(&cut, slack);
        if (cut.parts > 1) status = keep_roomiest(&cut, scope, err);
        if (!status) sunder_i_side_cut_keep_largest(&cut, 0);
        if (!status) status = choose_part(&cut, anchor, err);
    }
    if (!status && (cut.arena.failed || cut.lattice.arena.failed)) status = sunder_i_failure_cause(err);
    sunder_i_side_cut_free(&cut);
    return status;
}

sunder_status sunder_i_side_anchor(const sunder_shape *shape, const sunder_i_side *const *side, size_t n,
                                   const sunder_i_side_scope *scope, double anchor[2], sunder_error *err)
{
    sunder_shape_anchor(shape, anchor);
    const sunder_i_side **near = n ? sunder_i_alloc(n, sizeof *near) : NULL;
    size_t left = 0;
    if (n && !near) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < n; k++)
        if (!lies_beside(shape, side[k])) near[left++] = side[k];
    const sunder_status status = left ? choose_among_lines(shape, near, left, scope, anchor, err) : SUNDER_OK;
    sunder_i_free(near);
    return status;
}
