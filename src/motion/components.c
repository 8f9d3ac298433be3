/* components.c: the connected components of free space. The stretches of the outline belong to free space, so each
 * joins the vertices at its ends. The vertices that are joined in this way form a curve; two curves are in the same
 * component if they bound the same face of free space. From the smallest vertex of each curve (no vertex of the curve
 * is to its left) a ray goes to the left up to the first stretch that it meets: if the segment up to there is free, the
 * curve of that stretch is in the same component; otherwise the curve is inside a component of O. A ray that meets
 * nothing ends in the outer face. Start and goal are joined by rays, too. Doubles select the few stretches that may be
 * the first on the ray; whether the segment to one of them is free is decided exactly, and to join a farther one that
 * is reached would be correct, too. */
#include "motion/corners.h"

#include "base/extremes.h"
#include "base/union_find.h"
#include "spatial/strips.h"

#include <math.h>
#include <string.h>

/* Returns the intersection of the horizontal line through v with the line ab. The segment ab must reach the height of v
 * and not be horizontal. */
static sunder_i_filtered_point meeting_point(sunder_i_lattice *l, const sunder_i_filtered_point *v,
                                             const sunder_i_filtered_point *a, const sunder_i_filtered_point *b)
{
    sunder_i_arena *m = &l->arena;
    const sunder_i_rational_point rise = sunder_i_rational_sub(m, v->at, a->at);
    sunder_i_rational_point d = sunder_i_rational_sub(m, b->at, a->at);
    if (sunder_i_big_sign(d.y) < 0) d = sunder_i_rational_neg(d);
    /* The intersection is a + (rise.y / d.y) d; the denominator of d cancels. */
    const sunder_i_rational_point along = {sunder_i_big_mul(m, rise.y, d.x), sunder_i_big_mul(m, rise.y, d.y),
                                           sunder_i_big_mul(m, rise.w, d.y)};
    return sunder_i_filtered_make(l, sunder_i_rational_add(m, a->at, along));
}

/* Stores in x[0] and x[1] bounds, in doubles, of the x coordinates at which the stretch ab meets the horizontal line
 * through v. Returns false if the stretch does not reach the height of v. */
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
    /* The height has an error of e, so x has one of e times the slope, plus the rounding errors. */
    const double at = a->ax + dx * ((v->ay - a->ay) / dy);
    const double off = 4 * e * (1 + fabs(dx / dy)) + 0x1p-48 * fabs(dx);
    x[0] = sunder_i_max(low, at - off);
    x[1] = sunder_i_min(high, at + off);
    return true;
}

/* *hit becomes the point of the stretch ab that has the height of v and is not right of v (for a horizontal stretch:
 * the rightmost one). Returns false if there is none. */
static bool meet_left(const sunder_i_free_space *s, const sunder_i_filtered_point *v, const sunder_i_filtered_point *a,
                      const sunder_i_filtered_point *b, sunder_i_filtered_point *hit)
{
    const sunder_i_filter *g = &s->filter;
    if (sunder_i_filtered_cmp_y(g, a, v) == 0 && sunder_i_filtered_cmp_y(g, b, v) == 0) {
        const bool a_first = sunder_i_filtered_cmp_x(g, a, b) < 0;
        const sunder_i_filtered_point *right = a_first ? b : a, *left = a_first ? a : b;
        if (sunder_i_filtered_cmp_x(g, left, v) > 0) return false;
        *hit = sunder_i_filtered_cmp_x(g, right, v) > 0 ? *v : *right; /* v itself is on the stretch */
        return true;
    }
    *hit = meeting_point(g->lattice, v, a, b);
    return sunder_i_filtered_cmp_x(g, hit, v) <= 0;
}

/* Sorts the stretches into strips by height, for queries with one height. The intervals are widened by the errors of
 * their coordinates and of the height in the query. */
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

/* Shoots a ray from v to the left and joins v with the stretch that it reaches. The stretches of the curve with the
 * root `own` are not tested. */
static void shoot_ray(const sunder_i_free_space *s, sunder_i_corners *c, const sunder_i_strips *t, uint32_t v,
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
        /* The root of a tree has the least vertex number in it, so that the loop reaches the root first. */
        if (r == v || sunder_i_filtered_cmp(&space->filter, &corners->place[v], &corners->place[least[r]]) < 0)
            least[r] = v;
    }
    /* Vertices without stretches are degenerate points: no path leads there, so a ray from them has no effect. */
    for (uint32_t v = 0; ok && v < corners->vertices; v++)
        if (curve[v] == v) shoot_ray(space, corners, &t, least[v], curve, v);
    for (uint32_t v = corners->vertices; ok && v < corners->vertices + 2; v++)
        shoot_ray(space, corners, &t, v, curve, SUNDER_I_NO_PLACE);
    sunder_i_free_all(curve, least);
    sunder_i_strips_free(&t);
    return ok;
}

bool sunder_i_corners_connected(sunder_i_corners *corners, uint32_t a, uint32_t b)
{
    return sunder_i_union_find(corners->parent, a) == sunder_i_union_find(corners->parent, b);
}
