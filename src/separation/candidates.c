/* Which edges meet which vertices [BL11]. An edge e of one operand at a vertex v of the other can carry boundary only
 * if v is convex and the directions of its two edges enclose that of e: otherwise, near v, the interior at v reaches
 * across e and covers the whole segment. The range is taken closed; with it the ends of the segments are all vertices
 * that can be free: two disjoint cones at a pair of vertices are parted by the line of an edge of one of them.
 *
 * A vertex where rings touch, or a ring itself, does not see its true cone through its own ring: it is taken with every
 * edge. Diagonals of the decomposition lie inside an operand, so what they would carry is covered. */
#include "separation/candidates.h"
#include "number/watch.h"
#include "separation/held.h"

#include <math.h>

/* A corner that edges of the other operand may meet, in doubles: convex, or one where rings touch (then `in` and `out`,
 * the edges that arrive and leave, are zero, which every edge passes). */
typedef struct corners {
    uint32_t n;
    uint32_t *vertex;
    double *x, *y, *in_x, *in_y, *out_x, *out_y;
} corners;

/* May reflex vertex v lie inside an edge of its polygon, whose vertices are first .. last - 1? In doubles: a false
 * alarm only costs candidates. (A convex one that does so sees its true cone all the same: no straight edge fits in
 * it.) */
static bool may_touch_edge(const sunder_i_pairing *g, int side, uint32_t v, uint32_t first, uint32_t last)
{
    const sunder_shape *s = g->shape[side];
    const double *xy = g->xy[side], x = xy[2 * v], y = xy[2 * v + 1], e = 2 * g->error;
    if (!s->touches && !s->repaired) return false; /* as given, and so cleaned, nothing touches anything */
    sunder_i_steps((last - first) / 16);
    for (uint32_t a = first; a < last; a++) {
        const uint32_t b = s->next[a];
        const double ax = xy[2 * a], ay = xy[2 * a + 1], bx = xy[2 * b], by = xy[2 * b + 1];
        if ((x > ax + e && x > bx + e) || (x < ax - e && x < bx - e) || (y > ay + e && y > by + e) ||
            (y < ay - e && y < by - e) || a == v || b == v)
            continue;
        const double bound = (fabs(bx - ax) + fabs(by - ay) + e) * e + 8 * g->magnitude * g->coarse;
        if (fabs((bx - ax) * (y - ay) - (by - ay) * (x - ax)) <= bound) return true;
    }
    return false;
}

static inline bool look_at_corner(const sunder_i_pairing *g, int side, uint32_t v, uint32_t first, uint32_t last,
                                  sunder_i_corner *out)
{
    const sunder_shape *s = g->shape[side];
    const double *xy = g->xy[side], *a = xy + 2 * s->prev[v], *b = xy + 2 * v, *d = xy + 2 * s->next[v];
    double in_x = b[0] - a[0], in_y = b[1] - a[1], out_x = d[0] - b[0], out_y = d[1] - b[1];
    const double bound = (fabs(in_x) + fabs(in_y)) * g->error + 8 * g->magnitude * g->coarse;
    const bool convex = in_x * out_y - in_y * out_x > -bound;
    const bool shared = s->shared[v] || (!convex && may_touch_edge(g, side, v, first, last));
    if (!convex && !shared) return false;
    if (shared) in_x = in_y = out_x = out_y = 0;
    *out = (sunder_i_corner){b[0], b[1], in_x, in_y, out_x, out_y};
    return true;
}

bool sunder_i_corner_of(const sunder_i_pairing *g, int side, uint32_t v, sunder_i_corner *out)
{
    const sunder_shape *s = g->shape[side];
    uint32_t low = 0, high = s->polygons - 1; /* the polygon that v is of */
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (v < s->ring_end[s->poly_end[middle] - 1])
            high = middle;
        else
            low = middle + 1;
    }
    const uint32_t first = low ? (uint32_t)s->ring_end[s->poly_end[low - 1] - 1] : 0;
    return look_at_corner(g, side, v, first, (uint32_t)s->ring_end[s->poly_end[low] - 1], out);
}

static bool make_room(sunder_i_pairing *g, uint32_t n, corners *c)
{
    double *block = sunder_i_arena_alloc(&g->placed.lattice.arena, n, 6 * sizeof *block + sizeof *c->vertex);
    if (!block) return false;
    *c = (corners){0,
                   (uint32_t *)(block + 6 * (size_t)n),
                   block,
                   block + n,
                   block + 2 * (size_t)n,
                   block + 3 * (size_t)n,
                   block + 4 * (size_t)n,
                   block + 5 * (size_t)n};
    return true;
}

static bool find_corners(sunder_i_pairing *g, int side, corners *c)
{
    const sunder_shape *s = g->shape[side];
    if (!make_room(g, s->vertices, c)) return false;
    for (uint32_t p = 0, v = 0; p < s->polygons; p++) {
        const uint32_t first = v, last = s->ring_end[s->poly_end[p] - 1];
        for (; v < last; v++) {
            if (!sunder_i_step()) return false;
            sunder_i_corner at;
            if (!look_at_corner(g, side, v, first, last, &at)) continue;
            const uint32_t k = c->n++;
            c->vertex[k] = v;
            c->x[k] = at.x;
            c->y[k] = at.y;
            c->in_x[k] = at.in_x;
            c->in_y[k] = at.in_y;
            c->out_x[k] = at.out_x;
            c->out_y[k] = at.out_y;
        }
    }
    return true;
}

bool sunder_i_candidates_push(sunder_i_pairing *g, sunder_i_candidates *h, sunder_i_candidate c)
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

/* Is the edge a..b, moved over the box of the other operand, out of reach of the origin? */
static bool out_of_reach(const double *a, const double *b, const double box[4], double limit)
{
    for (int k = 0; k < 2; k++) {
        const double low = a[k] < b[k] ? a[k] : b[k], high = a[k] < b[k] ? b[k] : a[k];
        if (low + box[k] > limit || high + box[k + 2] < -limit) return true;
    }
    return false;
}

/* The edges of operand `side` at the corners of the other. The directions are compared in doubles: what is in doubt is
 * let in, since a superset of the boundary serves as well. */
static bool pair_edges(sunder_i_pairing *g, int side, const corners *c, double limit, sunder_i_candidates *h)
{
    const sunder_shape *s = g->shape[side];
    const double *xy = g->xy[side], reach = limit + 8 * g->error;
    const bool many = c->n > 16; /* else the test costs more than it saves */
    uint32_t *met = sunder_i_arena_alloc(&g->placed.lattice.arena, (size_t)c->n + 1, sizeof *met);
    if (!met) return false;
    for (uint32_t e = 0; e < s->vertices; e++) {
        const double *a = xy + 2 * e, *b = xy + 2 * s->next[e];
        if (!sunder_i_step()) return false;
        if (many && out_of_reach(a, b, g->box[!side], reach)) continue;
        const double dx = b[0] - a[0], dy = b[1] - a[1];
        const double bound = -(fabs(dx) + fabs(dy)) * g->error - 8 * g->magnitude * g->coarse;
        uint32_t n = 0;
        for (uint32_t k = 0; k < c->n; k++) { /* without branches: which corners pass is anyone's guess */
            met[n] = k;
            n += (uint32_t)((c->in_x[k] * dy - c->in_y[k] * dx >= bound) &
                            (dx * c->out_y[k] - dy * c->out_x[k] >= bound));
        }
        if (!sunder_i_steps(c->n / 32 + n)) return false;
        if (n == 0) continue;
        const double inverse = 1 / (dx * dx + dy * dy);
        for (uint32_t m = 0; m < n; m++) {
            const uint32_t k = met[m];
            const double square = sunder_i_segment_square(a[0] + c->x[k], a[1] + c->y[k], dx, dy, inverse);
            if (square > reach * reach ||
                (g->held && sunder_i_held_segment(g->held, g->error, a[0] + c->x[k], a[1] + c->y[k], dx, dy)))
                continue;
            if (!sunder_i_candidates_push(g, h, (sunder_i_candidate){square, e, c->vertex[k], side})) return false;
        }
    }
    g->placed.lattice.operations.orientation_tests += 2 * (uint64_t)c->n * s->vertices;
    return true;
}

static void sink(sunder_i_candidates *h, size_t i)
{
    const sunder_i_candidate c = h->item[i];
    for (;;) {
        size_t k = 2 * i + 1;
        if (k >= h->n) break;
        if (k + 1 < h->n && h->item[k + 1].square < h->item[k].square) k++;
        if (c.square <= h->item[k].square) break;
        h->item[i] = h->item[k];
        i = k;
    }
    h->item[i] = c;
}

void sunder_i_candidates_order(sunder_i_candidates *h)
{
    for (size_t i = h->n / 2; i-- > 0;) sink(h, i);
}

bool sunder_i_candidates_find(sunder_i_pairing *g, double limit, sunder_i_candidates *h)
{
    corners p, q;
    *h = (sunder_i_candidates){NULL, 0, 0};
    if (!find_corners(g, 0, &p) || !find_corners(g, 1, &q)) return false;
    if (!pair_edges(g, 0, &q, limit, h) || !pair_edges(g, 1, &p, limit, h)) return false;
    sunder_i_candidates_order(h);
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
