/* Which edges meet which vertices [BL11]. An edge e of one operand at a vertex v of the other can carry boundary only if
 * v is convex and the directions of its two edges enclose that of e: otherwise, near v, the interior at v reaches across e
 * and covers the whole segment. The range is taken closed; with it the ends of the segments are all vertices that can be
 * free: two disjoint cones at a pair of vertices are parted by the line of an edge of one of them.
 *
 * A vertex where rings touch, or a ring itself, does not see its true cone through its own ring: it is taken with every edge. Diagonals of
 * the decomposition lie inside an operand, so what they would carry is covered. */
#include "separation/candidates.h"

#include <math.h>

typedef struct turn {
    sunder_i_point in, out; /* the edges that arrive and leave */
    bool convex, shared;
} turn;

/* May reflex vertex v lie inside an edge of its polygon, whose vertices are first .. last - 1? In doubles: a false alarm only
 * costs candidates. (A convex one that does so sees its true cone all the same: no straight edge fits in it.) */
static bool may_touch_edge(const sunder_i_pairing *g, int side, uint32_t v, uint32_t first, uint32_t last)
{
    const sunder_shape *s = g->shape[side];
    const double *xy = g->xy[side], x = xy[2 * v], y = xy[2 * v + 1], e = 2 * g->error;
    for (uint32_t a = first; a < last; a++) {
        const uint32_t b = s->next[a];
        if (a == v || b == v) continue;
        const double ax = xy[2 * a], ay = xy[2 * a + 1], bx = xy[2 * b], by = xy[2 * b + 1];
        if ((x > ax + e && x > bx + e) || (x < ax - e && x < bx - e) || (y > ay + e && y > by + e) ||
            (y < ay - e && y < by - e))
            continue;
        const double bound = (fabs(bx - ax) + fabs(by - ay) + e) * e + g->magnitude * g->rough;
        if (fabs((bx - ax) * (y - ay) - (by - ay) * (x - ax)) <= bound) return true;
    }
    return false;
}

static turn *find_turns(sunder_i_pairing *g, int side)
{
    const sunder_shape *s = g->shape[side];
    turn *t = sunder_i_arena_alloc(&g->placed.lattice.arena, s->vertices, sizeof *t);
    if (!t) return NULL;
    const sunder_i_point *at = g->at[side];
    for (uint32_t v = 0; v < s->vertices; v++) {
        const uint32_t next = s->next[v];
        t[v].out = t[next].in = sunder_i_pairing_diff(g, at[next], at[v]);
    }
    for (uint32_t p = 0, v = 0; p < s->polygons; p++) {
        const uint32_t first = v, last = s->ring_end[s->poly_end[p] - 1];
        for (; v < last; v++) {
            t[v].convex = sunder_i_pairing_cross(g, t[v].in, t[v].out) > 0;
            t[v].shared = s->shared[v] || (!t[v].convex && may_touch_edge(g, side, v, first, last));
        }
    }
    return t;
}

static inline bool compatible(sunder_i_pairing *g, const turn *v, sunder_i_point e)
{
    return v->shared || (sunder_i_pairing_cross(g, v->in, e) >= 0 && sunder_i_pairing_cross(g, e, v->out) >= 0);
}

/* A lower bound of the distance of the origin from the segment of length `length` from (ax, ay) in direction (dx, dy). */
static inline double segment_key(double ax, double ay, double dx, double dy, double square, double error)
{
    double t = -(ax * dx + ay * dy) / square;
    t = t > 0 ? t < 1 ? t : 1 : 0;
    if (!(t >= 0)) t = 0; /* a length lost in the doubles */
    const double x = ax + t * dx, y = ay + t * dy, d = sqrt(x * x + y * y) - 4 * error;
    return d > 0 ? d : 0;
}

static bool push(sunder_i_pairing *g, sunder_i_candidates *h, sunder_i_candidate c)
{
    if (h->n == h->capacity) {
        const size_t capacity = h->capacity ? 2 * h->capacity : 64;
        sunder_i_candidate *item = sunder_i_arena_alloc(&g->placed.lattice.arena, capacity, sizeof *item);
        if (!item) return false;
        for (size_t i = 0; i < h->n; i++) item[i] = h->item[i];
        h->item = item;
        h->capacity = capacity;
    }
    h->item[h->n++] = c;
    return true;
}

/* The edges of operand `side` at the vertices of the other. */
static bool pair_edges(sunder_i_pairing *g, int side, const turn *edges, const turn *corners, double limit,
                       sunder_i_candidates *h)
{
    const uint32_t n = g->shape[side]->vertices, m = g->shape[!side]->vertices;
    const double *p = g->xy[side], *q = g->xy[!side];
    for (uint32_t e = 0; e < n; e++) {
        const sunder_i_point d = edges[e].out;
        const double ax = p[2 * e], ay = p[2 * e + 1];
        const double dx = sunder_i_approx(&g->placed.lattice, d.x), dy = sunder_i_approx(&g->placed.lattice, d.y);
        const double square = dx * dx + dy * dy;
        for (uint32_t v = 0; v < m; v++) {
            if (!corners[v].convex && !corners[v].shared) continue;
            const double key = segment_key(ax + q[2 * v], ay + q[2 * v + 1], dx, dy, square, g->error);
            if (key > limit || !compatible(g, corners + v, d)) continue;
            if (!push(g, h, (sunder_i_candidate){key, e, v, side})) return false;
        }
    }
    g->placed.lattice.operations.orientation_tests += 2 * (uint64_t)n * m;
    return true;
}

static void sink(sunder_i_candidates *h, size_t i)
{
    const sunder_i_candidate c = h->item[i];
    for (;;) {
        size_t k = 2 * i + 1;
        if (k >= h->n) break;
        if (k + 1 < h->n && h->item[k + 1].key < h->item[k].key) k++;
        if (c.key <= h->item[k].key) break;
        h->item[i] = h->item[k];
        i = k;
    }
    h->item[i] = c;
}

bool sunder_i_candidates_find(sunder_i_pairing *g, double limit, sunder_i_candidates *h)
{
    const turn *p = find_turns(g, 0), *q = find_turns(g, 1);
    *h = (sunder_i_candidates){NULL, 0, 0};
    if (!p || !q || !pair_edges(g, 0, p, q, limit, h) || !pair_edges(g, 1, q, p, limit, h)) return false;
    for (size_t i = h->n / 2; i-- > 0;) sink(h, i);
    return true;
}

sunder_i_candidate sunder_i_candidates_pop(sunder_i_candidates *h)
{
    const sunder_i_candidate top = h->item[0];
    h->item[0] = h->item[--h->n];
    if (h->n) sink(h, 0);
    return top;
}

sunder_i_line sunder_i_candidate_line(sunder_i_pairing *g, const sunder_i_candidate *c)
{
    const sunder_i_point *at = g->at[c->side];
    const uint32_t next = g->shape[c->side]->next[c->edge];
    return sunder_i_line_make(g, sunder_i_pairing_add(g, at[c->edge], g->at[!c->side][c->vertex]),
                              sunder_i_pairing_diff(g, at[next], at[c->edge]));
}
