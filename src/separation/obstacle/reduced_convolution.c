/* Which edges meet which vertices [BL11]. An edge e of one operand at a vertex v of the other can carry boundary only
 * if v is convex and the directions of its two edges enclose that of e: otherwise, near v, the interior at v reaches
 * across e and covers the whole segment. The range is taken closed; with it the ends of the segments are all vertices
 * that can be free: two disjoint cones at a pair of vertices are parted by the line of an edge of one of them.
 *
 * Where several vertices stand at one place each has a sector of the interior of its own (shape.h), and what one of
 * them covers is covered: each is asked for itself. Diagonals of the decomposition lie inside an operand, so what they
 * would carry is covered. */
#include "separation/obstacle/reduced_convolution.h"
#include "base/heap.h"
#include "base/watch.h"
#include "separation/obstacle/board.h"
#include "separation/obstacle/cones.h"

#include <math.h>

/* Room for n more. */
static bool make_room(sunder_i_operands *g, sunder_i_candidates *h, uint32_t n)
{
    return h->n + n <= h->capacity ||
           sunder_i_arena_reserve(&g->placed.lattice.arena, &h->item, &h->capacity, h->n + n, sizeof *h->item);
}

bool sunder_i_candidates_push(sunder_i_operands *g, sunder_i_candidates *h, sunder_i_candidate c)
{
    if (!make_room(g, h, 1)) return false;
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

/* An edge of operand `side`, at the corners of the other; no segment is to be farther off than `reach`. */
typedef struct edge {
    int side;
    uint32_t tail;
    double x, y, dx, dy, inverse, reach;
    const double *other; /* coordinates of the other operand */
} edge;

/* That from p to q. */
static inline void take_edge(edge *e, uint32_t tail, const double *p, const double *q)
{
    e->tail = tail;
    e->x = p[0];
    e->y = p[1];
    e->dx = q[0] - p[0];
    e->dy = q[1] - p[1];
    e->inverse = 1 / (e->dx * e->dx + e->dy * e->dy);
}

/* The edge at vertex v, if it comes near enough. There is room for it. */
static inline void add(const sunder_i_operands *g, const edge *e, uint32_t v, sunder_i_candidates *h)
{
    const double x = e->x + e->other[2 * (size_t)v], y = e->y + e->other[2 * (size_t)v + 1];
    const double square = sunder_i_segment_square(x, y, e->dx, e->dy, e->inverse);
    if (square > e->reach * e->reach) return;
    if (g->board && sunder_i_board_segment(g->board, g->error, x, y, e->dx, e->dy)) return;
    h->item[h->n++] = (sunder_i_candidate){square, e->tail, v, e->side};
}

/* The edges of operand `side` at the corners of the other, which has few. What is in doubt about their directions is
 * let in, since a superset of the boundary serves as well. */
static bool pair_edges_with_few(sunder_i_operands *g, int side, const sunder_i_cones *own, const sunder_i_cones *c,
                                double limit, sunder_i_candidates *h)
{
    const sunder_shape *s = g->shape[side];
    const double *xy = g->xy[side];
    edge e = {.side = side, .reach = limit + 8 * g->error, .other = g->xy[!side]};
    for (uint32_t v = 0; v < s->vertices; v++) {
        if (s->form->cleaned.next[v] == v) continue; /* a point, which has none */
        uint32_t met = sunder_i_cones_met_few(c, sunder_i_cones_edge(own, v));
        if (!sunder_i_steps(4)) return false;
        if (met == 0) continue;
        if (!make_room(g, h, c->n)) return false;
        take_edge(&e, v, xy + 2 * (size_t)v, xy + 2 * (size_t)s->form->cleaned.next[v]);
        for (; met; met &= met - 1) add(g, &e, c->vertex[__builtin_ctz(met)], h);
    }
    g->placed.lattice.counts.orientation_tests += 2 * (uint64_t)s->vertices * c->n;
    return true;
}

static bool pair_edges_with_many(sunder_i_operands *g, int side, const sunder_i_cones *own, const sunder_i_cones *c,
                                 double limit, sunder_i_candidates *h)
{
    const sunder_shape *s = g->shape[side];
    const double *xy = g->xy[side];
    edge e = {.side = side, .reach = limit + 8 * g->error, .other = g->xy[!side]};
    uint32_t *met = sunder_i_arena_alloc(&g->placed.lattice.arena, (size_t)c->n + 1, sizeof *met);
    if (!met) return false;
    uint64_t asked = 0;
    for (uint32_t v = 0; v < s->vertices; v++) {
        const double *p = xy + 2 * (size_t)v, *q = xy + 2 * (size_t)s->form->cleaned.next[v];
        if (!sunder_i_step()) return false;
        if (s->form->cleaned.next[v] == v || out_of_reach(p, q, g->box[!side], e.reach)) continue;
        uint32_t looked_at;
        const uint32_t n = sunder_i_cones_met(c, sunder_i_cones_edge(own, v), met, &looked_at);
        asked += looked_at;
        if (!sunder_i_steps(looked_at / 32 + n)) return false;
        if (n == 0) continue;
        if (!make_room(g, h, n)) return false;
        take_edge(&e, v, p, q);
        for (uint32_t m = 0; m < n; m++) add(g, &e, c->vertex[met[m]], h);
    }
    g->placed.lattice.counts.orientation_tests += 2 * asked;
    return true;
}

static bool pair_edges(sunder_i_operands *g, int side, const sunder_i_cones *own, const sunder_i_cones *c, double limit,
                       sunder_i_candidates *h)
{
    return c->n <= SUNDER_I_CONES_FEW ? pair_edges_with_few(g, side, own, c, limit, h)
                                      : pair_edges_with_many(g, side, own, c, limit, h);
}

static bool before(const void *a, const void *b)
{
    return ((const sunder_i_candidate *)a)->square < ((const sunder_i_candidate *)b)->square;
}

void sunder_i_candidates_order(sunder_i_candidates *h)
{
    sunder_i_candidate scratch;
    sunder_i_heap_make(h->item, h->n, sizeof scratch, &scratch, before);
}

bool sunder_i_candidates_find(sunder_i_operands *g, double limit, sunder_i_candidates *h)
{
    sunder_i_cones p, q;
    *h = (sunder_i_candidates){NULL, 0, 0};
    if (!sunder_i_cones_find(g, 0, &p) || !sunder_i_cones_find(g, 1, &q)) return false;
    if (!pair_edges(g, 0, &p, &q, limit, h) || !pair_edges(g, 1, &q, &p, limit, h)) return false;
    sunder_i_candidates_order(h);
    return true;
}

sunder_i_candidate sunder_i_candidates_pop(sunder_i_candidates *h)
{
    sunder_i_candidate top;
    sunder_i_heap_pop(h->item, &h->n, sizeof top, &top, before);
    return top;
}

sunder_i_carrier sunder_i_candidate_carrier(sunder_i_operands *g, const sunder_i_candidate *c)
{
    const sunder_i_point *at = g->at[c->side];
    const uint32_t next = g->shape[c->side]->form->cleaned.next[c->edge];
    return sunder_i_carrier_make(g, sunder_i_operands_add(g, at[c->edge], g->at[!c->side][c->vertex]),
                                 sunder_i_operands_diff(g, at[next], at[c->edge]));
}
