/* Components: stretches of the outline join the vertices at their ends, since the outline belongs to free space. That
 * gives curves; two curves belong together when they bound one face of free space. From the smallest vertex of each
 * curve, which has nothing of its curve to its left, a ray goes left to the first stretch that it meets: if the way
 * there is free the two belong together, else the curve lies in a component of O. A ray that meets nothing has come
 * outside. Start and goal ask in the same way. Doubles find the few stretches that may be the first; which of them can
 * be reached is decided exactly, and reaching a farther one would not be wrong. */
#include "motion/corners.h"

#include "base/extremes.h"
#include "base/union_find.h"
#include "spatial/strips.h"

#include <math.h>
#include <string.h>

/* Where the horizontal through v meets the line of a stretch ab that reaches its height and is not horizontal. */
static sunder_i_filtered_point meeting(sunder_i_lattice *l, const sunder_i_filtered_point *v,
                                       const sunder_i_filtered_point *a, const sunder_i_filtered_point *b)
{
    sunder_i_arena *m = &l->arena;
    const sunder_i_rational_point rise = sunder_i_rational_sub(m, v->at, a->at);
    sunder_i_rational_point d = sunder_i_rational_sub(m, b->at, a->at);
    if (sunder_i_big_sign(d.y) < 0) d = sunder_i_rational_neg(d);
    /* a + (rise.y / d.y) d; d's own denominator drops out. */
    const sunder_i_rational_point along = {sunder_i_big_mul(m, rise.y, d.x), sunder_i_big_mul(m, rise.y, d.y),
                                           sunder_i_big_mul(m, rise.w, d.y)};
    return sunder_i_filtered_make(l, sunder_i_rational_add(m, a->at, along));
}

/* Between which x the stretch meets the horizontal through v, in doubles; false if it does not reach its height. */
static bool range_at(const sunder_i_free_space *s, const sunder_i_filtered_point *v, const sunder_i_filtered_point *a,
                     const sunder_i_filtered_point *b, double x[2])
{
    const double e = 2 * s->filter.error;
    if ((a->ay < v->ay - e && b->ay < v->ay - e) || (a->ay > v->ay + e && b->ay > v->ay + e)) return false;
    const double low = sunder_i_min(a->ax, b->ax) - e, high = sunder_i_max(a->ax, b->ax) + e;
    if (low > v->ax + e) return false;
    if (sunder_i_filtered_cmp_y(&s->filter, a, v) * sunder_i_filtered_cmp_y(&s->filter, b, v) > 0) return false;
    const double dx = b->ax - a->ax, dy = b->ay - a->ay;
    x[0] = low;
    x[1] = high;
    if (fabs(dy) <= 4 * e) return true;
    /* Height is off by e, so x by e times the slope; and what rounds. */
    const double at = a->ax + dx * ((v->ay - a->ay) / dy);
    const double off = 4 * e * (1 + fabs(dx / dy)) + 0x1p-48 * fabs(dx);
    x[0] = sunder_i_max(low, at - off);
    x[1] = sunder_i_min(high, at + off);
    return true;
}

/* The place on the stretch, at the height of v and not right of it; false if there is none. */
static bool meet_left(const sunder_i_free_space *s, const sunder_i_filtered_point *v, const sunder_i_filtered_point *a,
                      const sunder_i_filtered_point *b, sunder_i_filtered_point *hit)
{
    const sunder_i_filter *g = &s->filter;
    if (sunder_i_filtered_cmp_y(g, a, v) == 0 && sunder_i_filtered_cmp_y(g, b, v) == 0) {
        const bool a_first = sunder_i_filtered_cmp_x(g, a, b) < 0;
        const sunder_i_filtered_point *right = a_first ? b : a, *left = a_first ? a : b;
        if (sunder_i_filtered_cmp_x(g, left, v) > 0) return false;
        *hit = sunder_i_filtered_cmp_x(g, right, v) > 0 ? *v : *right; /* v itself lies on it */
        return true;
    }
    *hit = meeting(g->lattice, v, a, b);
    return sunder_i_filtered_cmp_x(g, hit, v) <= 0;
}

/* Stretches by height, with room for the error of theirs and of the height that is asked for. */
static bool make_strips(const sunder_i_free_space *s, const sunder_i_corners *c, sunder_i_strips *out)
{
    double(*span)[2] = sunder_i_alloc(s->stretches, sizeof *span);
    memset(out, 0, sizeof *out);
    if (!span) return false;
    const double e = 4 * s->filter.error;
    for (size_t i = 0; i < s->stretches; i++) {
        const double a = c->place[s->stretch[i].from].ay, b = c->place[s->stretch[i].to].ay;
        span[i][0] = sunder_i_min(a, b) - e;
        span[i][1] = sunder_i_max(a, b) + e;
    }
    const bool ok = sunder_i_strips_build(out, (const double(*)[2])span, s->stretches, s->stretches);
    sunder_i_free(span);
    return ok;
}

/* Joins v with what it reaches on its left. Stretches whose vertices have the root `own` are not looked at. */
static void shoot(const sunder_i_free_space *s, sunder_i_corners *c, const sunder_i_strips *t, uint32_t v,
                  const uint32_t *curve, uint32_t own)
{
    const sunder_i_filtered_point *p = &c->place[v];
    size_t from, to;
    sunder_i_strips_at(t, p->ay, &from, &to);
    double nearest = -INFINITY, x[2];
    bool any = false;
    for (int round = 0; round < 2; round++)
        for (size_t i = from; i < to; i++) {
            const sunder_i_outline_stretch *e = &s->stretch[t->item[i]];
            const sunder_i_filtered_point *a = &c->place[e->from], *b = &c->place[e->to];
            if (curve[e->from] == own || !range_at(s, p, a, b, x) || x[0] > p->ax + 2 * s->filter.error) continue;
            if (round == 0) {
                if (x[1] < p->ax - 2 * s->filter.error) nearest = sunder_i_max(nearest, x[0]);
                continue;
            }
            sunder_i_filtered_point hit;
            if (x[1] < nearest || !meet_left(s, p, a, b, &hit)) continue;
            any = true;
            if (sunder_i_leg_is_free(s, &hit, p, false, NULL)) sunder_i_union_join(c->parent, v, e->from);
        }
    if (!any) sunder_i_union_join(c->parent, v, c->vertices + 2);
}

bool sunder_i_components_find(const sunder_i_free_space *space, sunder_i_corners *corners)
{
    uint32_t *curve = sunder_i_alloc(corners->vertices, sizeof *curve),
             *least = sunder_i_alloc(corners->vertices, sizeof *least);
    sunder_i_strips t;
    const bool ok = make_strips(space, corners, &t) && curve && least;
    sunder_i_union_init(corners->parent, (size_t)corners->vertices + 3);
    for (size_t i = 0; i < space->stretches; i++)
        sunder_i_union_join(corners->parent, space->stretch[i].from, space->stretch[i].to);
    for (uint32_t v = 0; ok && v < corners->vertices; v++) {
        const uint32_t r = curve[v] = sunder_i_union_find(corners->parent, v);
        /* A root has the least number in its tree, so the loop meets it first there. */
        if (r == v || sunder_i_filtered_cmp(&space->filter, &corners->place[v], &corners->place[least[r]]) < 0)
            least[r] = v;
    }
    /* Points without stretches are degenerate: no way leads there, and a ray from them goes nowhere. */
    for (uint32_t v = 0; ok && v < corners->vertices; v++)
        if (curve[v] == v) shoot(space, corners, &t, least[v], curve, v);
    for (uint32_t v = corners->vertices; ok && v < corners->vertices + 2; v++)
        shoot(space, corners, &t, v, curve, SUNDER_I_NO_PLACE);
    sunder_i_free(curve);
    sunder_i_free(least);
    sunder_i_strips_free(&t);
    return ok;
}

bool sunder_i_corners_connected(sunder_i_corners *corners, uint32_t a, uint32_t b)
{
    return sunder_i_union_find(corners->parent, a) == sunder_i_union_find(corners->parent, b);
}
