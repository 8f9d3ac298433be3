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

/* The edges of operand `side` at the corners of the other. What is in doubt about their directions is let in, since a
 * superset of the boundary serves as well. */
static bool pair_edges(sunder_i_operands *g, int side, const sunder_i_cones *own, const sunder_i_cones *c, double limit,
                       sunder_i_candidates *h)
{
    const sunder_shape *s = g->shape[side];
    const double *xy = g->xy[side], *other = g->xy[!side], reach = limit + 8 * g->error;
    const bool many = c->n > 16; /* else the test costs more than it saves */
    uint32_t *met = sunder_i_arena_alloc(&g->placed.lattice.arena, (size_t)c->n + 1, sizeof *met);
    if (!met) return false;
    uint64_t asked = 0;
    for (uint32_t e = 0; e < s->vertices; e++) {
        const double *a = xy + 2 * (size_t)e, *b = xy + 2 * (size_t)s->next[e];
        if (s->next[e] == e) continue; /* a point, which has none */
        if (many && out_of_reach(a, b, g->box[!side], reach)) {
            if (!sunder_i_step()) return false;
            continue;
        }
        uint32_t looked_at;
        const uint32_t n = sunder_i_cones_met(c, sunder_i_cones_edge(own, e), met, &looked_at);
        asked += looked_at;
        if (!sunder_i_steps(looked_at / 32 + n + 1)) return false;
        if (n == 0) continue;
        if (!make_room(g, h, n)) return false;
        const double dx = b[0] - a[0], dy = b[1] - a[1], inverse = 1 / (dx * dx + dy * dy);
        for (uint32_t m = 0; m < n; m++) {
            const uint32_t v = c->vertex[met[m]];
            const double x = a[0] + other[2 * (size_t)v], y = a[1] + other[2 * (size_t)v + 1];
            const double square = sunder_i_segment_square(x, y, dx, dy, inverse);
            if (square > reach * reach || (g->board && sunder_i_board_segment(g->board, g->error, x, y, dx, dy)))
                continue;
            h->item[h->n++] = (sunder_i_candidate){square, e, v, side};
        }
    }
    g->placed.lattice.counts.orientation_tests += 2 * asked;
    return true;
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
    const uint32_t next = g->shape[c->side]->next[c->edge];
    return sunder_i_carrier_make(g, sunder_i_operands_add(g, at[c->edge], g->at[!c->side][c->vertex]),
                                 sunder_i_operands_diff(g, at[next], at[c->edge]));
}
