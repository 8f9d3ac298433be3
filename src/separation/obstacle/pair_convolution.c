/* pair_convolution.c: finds which edges meet which vertices [BL11]. An edge e of one operand at a vertex v of the other
 * can belong to the boundary only if v is convex and the direction of e lies between those of the two edges at v:
 * otherwise, near v, the interior at v extends across e and covers the whole segment. The range of directions is
 * closed, so that the ends of the segments include all vertices that can be free: two disjoint cones at a pair of
 * vertices are separated by the line of an edge of one of them.
 *
 * Where several vertices have one position, each has its own sector of the interior (shape.h), and what one of them
 * covers is covered; each is treated separately. Diagonals of the decomposition lie inside an operand, so that their
 * segments are covered. */
#include "separation/obstacle/pair_convolution.h"
#include "base/heap.h"
#include "base/watch.h"
#include "separation/obstacle/board.h"
#include "separation/obstacle/cones.h"

/* Makes room for n more candidates. Returns false if out of memory. */
static bool make_room(sunder_i_operands *g, sunder_i_candidates *h, uint32_t n)
{
    return h->n + n <= h->capacity ||
           sunder_i_arena_reserve(&g->placed.lattice.arena, &h->item, &h->capacity, h->n + n, sizeof *h->item);
}

bool sunder_i_candidates_push(sunder_i_operands *operands, sunder_i_candidates *heap, sunder_i_candidate candidate)
{
    if (!make_room(operands, heap, 1)) return false;
    heap->item[heap->n++] = candidate;
    return true;
}

/* Returns whether the edge ab, moved over the box of the other operand, stays farther than `limit` from the origin in
 * one coordinate. */
static bool out_of_reach(const double *a, const double *b, const double box[4], double limit)
{
    for (int k = 0; k < 2; k++) {
        const double low = a[k] < b[k] ? a[k] : b[k], high = a[k] < b[k] ? b[k] : a[k];
        if (low + box[k] > limit || high + box[k + 2] < -limit) return true;
    }
    return false;
}

/* An edge of operand `side`, which is combined with vertices of the other operand; segments farther than `reach` are
 * not needed. */
typedef struct edge {
    int side;
    uint32_t tail;
    sunder_i_doubles from, d; /* its first vertex, and its vector */
    double inverse, reach, reach_square;
    const double *other; /* the coordinates of the other operand */
} edge;

static edge edge_of(const sunder_i_operands *g, int side, double limit)
{
    const double reach = limit + 8 * g->error;
    return (edge){.side = side, .reach = reach, .reach_square = reach * reach, .other = g->xy[!side]};
}

/* Sets e to the edge from p to q. */
static inline void take_edge(edge *e, uint32_t tail, const double *p, const double *q)
{
    e->tail = tail;
    e->from = sunder_i_doubles_at(p);
    e->d = sunder_i_doubles_at(q) - e->from;
    const sunder_i_doubles square = e->d * e->d;
    e->inverse = 1 / (square[0] + square[1]);
}

/* Writes the candidate for the edge at vertex v to `at`. Returns 1 if it is near enough to be kept, else 0. There are
 * no branches, since they would wait for a long chain of operations. The formula is that of sunder_i_segment_square(),
 * for both coordinates at a time. */
static inline size_t put_candidate(const sunder_i_operands *g, const edge *e, uint32_t v, sunder_i_candidate *at)
{
    const sunder_i_doubles a = e->from + sunder_i_doubles_at(e->other + 2 * (size_t)v), along = a * e->d;
    const sunder_i_doubles p = a + sunder_i_clamped(-(along[0] + along[1]) * e->inverse) * e->d, squares = p * p;
    const double square = squares[0] + squares[1];
    *at = (sunder_i_candidate){square, e->tail, v, e->side};
    const size_t near = !(square > e->reach_square);
    if (g->board) return near && !sunder_i_board_segment(g->board, g->error, a[0], a[1], e->d[0], e->d[1]);
    return near;
}

/* The number of edges processed between two checks whether the computation may continue. */
#define EDGES_AT_ONCE 32

/* Combines the edges of operand `side` with the vertices of the other operand, which has few. Uncertain pairs are
 * included, since a superset of the boundary is sufficient. */
static bool pair_edges_with_few(sunder_i_operands *g, int side, const sunder_i_cones *own, const sunder_i_cones *c,
                                double limit, sunder_i_candidates *h)
{
    const sunder_shape *s = g->shape[side];
    const double *xy = g->xy[side];
    const uint32_t *next = s->form->cleaned.next;
    edge e = edge_of(g, side, limit);
    uint32_t all[EDGES_AT_ONCE];
    for (uint32_t v = 0, n; v < s->vertices; v += n) {
        n = s->vertices - v < EDGES_AT_ONCE ? s->vertices - v : EDGES_AT_ONCE;
        if (!sunder_i_steps(4 * (size_t)n)) return false;
        sunder_i_cones_met_few(c, own, v, n, all);
        for (uint32_t k = 0; k < n; k++) {
            const uint32_t tail = v + k, head = next[tail];
            if (all[k] == 0 || head == tail) continue; /* it meets none, or it is a point, which has no edge */
            if (!make_room(g, h, c->n)) return false;
            take_edge(&e, tail, xy + 2 * (size_t)tail, xy + 2 * (size_t)head);
            size_t have = h->n;
            for (uint32_t met = all[k]; met; met &= met - 1)
                have += put_candidate(g, &e, c->vertex[__builtin_ctz(met)], h->item + have);
            h->n = have;
        }
    }
    g->placed.lattice.counts.orientation_tests += 2 * (uint64_t)s->vertices * c->n;
    return true;
}

static bool pair_edges_with_many(sunder_i_operands *g, int side, const sunder_i_cones *own, const sunder_i_cones *c,
                                 double limit, sunder_i_candidates *h)
{
    const sunder_shape *s = g->shape[side];
    const double *xy = g->xy[side];
    edge e = edge_of(g, side, limit);
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
        for (uint32_t m = 0; m < n; m++) h->n += put_candidate(g, &e, c->vertex[met[m]], h->item + h->n);
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

static bool square_before(const void *a, const void *b)
{
    return ((const sunder_i_candidate *)a)->square < ((const sunder_i_candidate *)b)->square;
}

void sunder_i_candidates_order(sunder_i_candidates *heap)
{
    sunder_i_candidate scratch;
    sunder_i_heap_make(heap->item, heap->n, sizeof scratch, &scratch, square_before);
}

bool sunder_i_candidates_find(sunder_i_operands *operands, double limit, sunder_i_candidates *out)
{
    sunder_i_cones p, q;
    *out = (sunder_i_candidates){NULL, 0, 0};
    if (!sunder_i_cones_find(operands, 0, &p) || !sunder_i_cones_find(operands, 1, &q)) return false;
    if (!pair_edges(operands, 0, &p, &q, limit, out) || !pair_edges(operands, 1, &q, &p, limit, out)) return false;
    sunder_i_candidates_order(out);
    return true;
}

sunder_i_candidate sunder_i_candidates_pop(sunder_i_candidates *heap)
{
    sunder_i_candidate top;
    sunder_i_heap_pop(heap->item, &heap->n, sizeof top, &top, square_before);
    return top;
}

sunder_i_carrier sunder_i_candidate_carrier(sunder_i_operands *operands, const sunder_i_candidate *candidate)
{
    const sunder_i_point *at = operands->at[candidate->side];
    const uint32_t next = operands->shape[candidate->side]->form->cleaned.next[candidate->edge];
    return sunder_i_carrier_make(
        operands,
        sunder_i_operands_add(operands, at[candidate->edge], operands->at[!candidate->side][candidate->vertex]),
        sunder_i_operands_diff(operands, at[next], at[candidate->edge]));
}
