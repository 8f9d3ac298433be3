/* leg.c: which parts a segment meets. A tree of boxes selects the few parts to test, and the separating axis theorem
 * decides the test exactly.
 *
 * A closed segment pq and an open convex polygon are disjoint exactly if the line through a side of the polygon, or the
 * line pq, weakly separates them: the Minkowski difference of the two is a convex polygon whose sides are parallel to
 * these, and the origin is not in its interior exactly if it is on or beyond one of them. */
#include "motion/free_space.h"

#include "spatial/curve.h"

#include "base/extremes.h"

#include <float.h>
#include <math.h>

static void part_box(const sunder_i_free_space *s, uint32_t part, double box[4])
{
    const sunder_i_convex_pieces *c = &s->part;
    sunder_i_box_clear(box);
    for (uint32_t k = sunder_i_convex_pieces_first(c, part); k < c->end[part]; k++)
        sunder_i_box_include(box, s->corner[k]);
    for (int k = 0; k < 2; k++) {
        box[k] -= s->filter.error;
        box[k + 2] += s->filter.error;
    }
}

static void add_part(const void *of, size_t i, double box[4])
{
    const sunder_i_free_space *s = of;
    double one[4];
    part_box(s, s->tree.part[i], one);
    sunder_i_box_join(box, one);
}

bool sunder_i_part_tree_build(sunder_i_free_space *space)
{
    sunder_i_part_tree *t = &space->tree;
    const size_t n = space->part.n;
    t->boxes = sunder_i_box_tree_of(n, SUNDER_I_LEAF_PARTS);
    t->part = sunder_i_alloc(n, sizeof *t->part);
    t->boxes.box = sunder_i_alloc(2 * t->boxes.leaves, sizeof *t->boxes.box);
    double *middle = sunder_i_alloc(2 * n, sizeof *middle);
    uint32_t *self = sunder_i_alloc(n, sizeof *self);
    bool ok = t->part && t->boxes.box && middle && self;
    for (uint32_t i = 0; ok && i < n; i++) {
        double box[4];
        part_box(space, i, box);
        middle[2 * i] = box[0] / 2 + box[2] / 2;
        middle[2 * i + 1] = box[1] / 2 + box[3] / 2;
        t->part[i] = self[i] = i;
    }
    if (ok) {
        sunder_i_arena arena = {0};
        sunder_i_curve_sort(middle, self, t->part, n, &arena);
        ok = !arena.failed;
        sunder_i_arena_free(&arena);
    }
    if (ok) sunder_i_box_tree_fill(&t->boxes, add_part, space);
    sunder_i_free_all(middle, self);
    return ok;
}

/* ---- One part ---- */

/* Returns true if the closed segment pq meets the part: unless both ends are on or beyond the line of one side of the
 * part, or all of the part is on one side of the line pq. */
static bool meets_part(const sunder_i_free_space *s, uint32_t part, const sunder_i_filtered_point *p,
                       const sunder_i_filtered_point *q)
{
    const sunder_i_convex_pieces *c = &s->part;
    const uint32_t first = sunder_i_convex_pieces_first(c, part), end = c->end[part];
    for (uint32_t k = first; k < end; k++) {
        const uint32_t next = k + 1 < end ? k + 1 : first;
        const sunder_i_lattice_corner a = {c->corner[k], s->corner[k]}, b = {c->corner[next], s->corner[next]};
        if (sunder_i_filtered_side(&s->filter, a, b, p) <= 0 &&
            (p == q || sunder_i_filtered_side(&s->filter, a, b, q) <= 0))
            return false;
    }
    if (p == q) return true;
    int left = 0, right = 0;
    for (uint32_t k = first; k < end && !(left && right); k++) {
        const int side =
            sunder_i_filtered_corner_side(&s->filter, p, q, (sunder_i_lattice_corner){c->corner[k], s->corner[k]});
        left += side > 0;
        right += side < 0;
    }
    /* If p and q are equal, there is no line pq, and the tests of the sides have decided. */
    return (left && right) || (!left && !right);
}

/* ---- The tree ---- */

typedef struct ray {
    double x, y, dx, dy, low[2], high[2], slack;
} ray;

static bool box_near(const double box[4], const ray *r)
{
    if (box[0] > r->high[0] || box[2] < r->low[0] || box[1] > r->high[1] || box[3] < r->low[1]) return false;
    /* The line misses the box if all corners of the box are clearly on one side of it. A product that overflows decides
     * nothing. */
    const double mx = box[0] / 2 + box[2] / 2 - r->x, my = box[1] / 2 + box[3] / 2 - r->y;
    const double hx = (box[2] - box[0]) / 2, hy = (box[3] - box[1]) / 2;
    const double off = fabs(r->dx * my - r->dy * mx), reach = fabs(r->dx) * hy + fabs(r->dy) * hx;
    const double error =
        r->slack * (fabs(r->dx) + fabs(r->dy)) + 4 * DBL_EPSILON * (fabs(r->dx * my) + fabs(r->dy * mx));
    return !(off > reach + error);
}

static ray ray_of(const sunder_i_free_space *s, const sunder_i_filtered_point *p, const sunder_i_filtered_point *q)
{
    const double e = s->filter.error;
    ray r = {p->ax, p->ay, q->ax - p->ax, q->ay - p->ay, {0, 0}, {0, 0}, 0};
    r.low[0] = sunder_i_min(p->ax, q->ax) - e, r.high[0] = sunder_i_max(p->ax, q->ax) + e;
    r.low[1] = sunder_i_min(p->ay, q->ay) - e, r.high[1] = sunder_i_max(p->ay, q->ay) + e;
    /* The ends have an error of e each, and sums of boxes and ends are rounded; this bound has ample margin. */
    r.slack = 16 * e + 4 * DBL_EPSILON * (fabs(r.dx) + fabs(r.dy));
    return r;
}

bool sunder_i_leg_is_free(const sunder_i_free_space *space, const sunder_i_filtered_point *p,
                          const sunder_i_filtered_point *q, bool least, uint32_t *part)
{
    const sunder_i_box_tree *t = &space->tree.boxes;
    const uint32_t *in = space->tree.part;
    const ray r = ray_of(space, p, q);
    uint32_t found = UINT32_MAX;
    sunder_i_box_walk walk;
    sunder_i_box_walk_start(&walk, t);
    for (size_t i; sunder_i_box_walk_next(&walk, &i);) {
        if (!box_near(t->box[i], &r)) continue;
        if (i < t->leaves) {
            sunder_i_box_walk_open(&walk, 2 * i + 1, 2 * i);
            continue;
        }
        const size_t end = sunder_i_box_tree_end(t, i);
        for (size_t k = sunder_i_box_tree_first(t, i); k < end; k++) {
            if (in[k] > found || !meets_part(space, in[k], p, q)) continue;
            found = in[k];
            if (!least) {
                if (part) *part = found;
                return false;
            }
        }
    }
    if (part) *part = found;
    return found == UINT32_MAX;
}
