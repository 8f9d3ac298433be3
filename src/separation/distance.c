/* distance.c: the distance of two sets, to about one ulp, and a shortest segment between them. */
#include "separation/separation.h"

#include "separation/operands/pair_operands.h"

#include <math.h>

typedef struct link {
    double square; /* the squared distance, in squared lattice units */
    uint32_t i, j; /* the edges of P and Q, by their first vertices */
} link;

typedef struct vector {
    double x, y;
} vector;

/* Returns to - from. The difference is computed on the lattice without cancellation and then rounded. */
static vector vector_between(sunder_i_operands *g, sunder_i_point to, sunder_i_point from)
{
    sunder_i_lattice *l = &g->placed.lattice;
    if (l->narrow) {
        const sunder_i_point d = sunder_i_narrow_sub(to, from);
        return (vector){(double)d.x, (double)d.y};
    }
    vector d;
    sunder_i_point_difference(l, to, from, &d.x, &d.y);
    return d;
}

/* Returns the squared distance of p from the segment ab; a + *t (b - a) is the nearest point. The distance from an
 * inner point of the segment is the exact cross product divided by the length. */
static double to_segment(sunder_i_operands *g, sunder_i_point p, sunder_i_point a, sunder_i_point b, double *t)
{
    sunder_i_lattice *l = &g->placed.lattice;
    const vector u = vector_between(g, b, a), v = vector_between(g, p, a), w = vector_between(g, p, b);
    const double along = v.x * u.x + v.y * u.y, square = u.x * u.x + u.y * u.y;
    *t = 0;
    if (!(along > 0)) return v.x * v.x + v.y * v.y;
    *t = 1;
    if (!(w.x * u.x + w.y * u.y < 0)) return w.x * w.x + w.y * w.y;
    *t = along / square;
    double cross = u.x * v.y - u.y * v.x;
    if (l->narrow) cross = (double)sunder_i_narrow_orient(a, b, p);
    return cross * cross / square;
}

/* Returns the squared distance of edge i of P from edge j of Q, the least over their four ends. *which is the end: 0 or
 * 1 of P's edge, 2 or 3 of Q's; *t is the parameter of the nearest point on the other edge. */
static double edge_square(sunder_i_operands *g, uint32_t i, uint32_t j, int *which, double *t)
{
    const sunder_i_point a = g->at[0][i], b = g->at[0][g->shape[0]->form->cleaned.next[i]];
    const sunder_i_point c = g->at[1][j], d = g->at[1][g->shape[1]->form->cleaned.next[j]];
    const sunder_i_point end[4] = {a, b, c, d};
    double best = INFINITY;
    for (int k = 0; k < 4; k++) {
        double s;
        const double square = k < 2 ? to_segment(g, end[k], c, d, &s) : to_segment(g, end[k], a, b, &s);
        if (square < best) {
            best = square;
            *which = k;
            *t = s;
        }
    }
    return best;
}

static double box_square(const double *a, const double *b, const double *c, const double *d)
{
    double square = 0;
    for (int k = 0; k < 2; k++) {
        const double low = a[k] < b[k] ? a[k] : b[k], high = a[k] < b[k] ? b[k] : a[k];
        const double from = c[k] < d[k] ? c[k] : d[k], to = c[k] < d[k] ? d[k] : c[k];
        const double off = from > high ? from - high : low > to ? low - to : 0;
        square += off * off;
    }
    return square;
}

/* Replaces *best if the edges i and j are closer, or equally close and first in order, so that the answer does not
 * depend on the order of the search. */
static void offer_link(sunder_i_operands *g, uint32_t i, uint32_t j, link *best)
{
    int which;
    double t;
    const double square = edge_square(g, i, j, &which, &t);
    if (square < best->square || (square == best->square && (i < best->i || (i == best->i && j < best->j))))
        *best = (link){square, i, j};
}

/* Compares the edges from .. to - 1 of P with the edges first .. last - 1 of Q, all of which lie in `box`; updates
 * *best. */
static void compare_edges(sunder_i_operands *g, uint32_t from, uint32_t to, uint32_t first, uint32_t last,
                          const double box[4], link *best)
{
    const sunder_shape *p = g->shape[0], *q = g->shape[1];
    for (uint32_t i = from; i < to; i++) {
        const double *a = g->xy[0] + 2 * i, *b = g->xy[0] + 2 * p->form->cleaned.next[i];
        const double reach = sqrt(best->square) + 4 * g->error;
        if (box_square(a, b, box, box + 2) > reach * reach) continue;
        for (uint32_t j = first; j < last; j++) {
            const double now = sqrt(best->square) + 4 * g->error;
            if (box_square(a, b, g->xy[1] + 2 * j, g->xy[1] + 2 * q->form->cleaned.next[j]) <= now * now)
                offer_link(g, i, j, best);
        }
    }
}

#define BLOCK 16         /* the number of consecutive edges that share a box */
#define BLOCKS_FROM 4096 /* with fewer pairs of edges, boxes of blocks are not worth computing */

/* Returns the boxes of the blocks of one operand; NULL if out of memory. */
static double (*block_boxes(sunder_i_operands *g, int side, uint32_t blocks))[4]
{
    const sunder_shape *s = g->shape[side];
    double(*box)[4] = sunder_i_arena_alloc(&g->placed.lattice.arena, blocks, sizeof *box);
    for (uint32_t k = 0; box && k < blocks; k++) {
        double *b = box[k];
        b[0] = b[1] = INFINITY;
        b[2] = b[3] = -INFINITY;
        for (uint32_t e = k * BLOCK; e < (k + 1) * BLOCK && e < s->vertices; e++)
            for (int end = 0; end < 2; end++) {
                const double *v = g->xy[side] + 2 * (end ? s->form->cleaned.next[e] : e);
                for (int c = 0; c < 2; c++) {
                    if (v[c] < b[c]) b[c] = v[c];
                    if (v[c] > b[c + 2]) b[c + 2] = v[c];
                }
            }
    }
    return box;
}

typedef struct blocks {
    double (*box)[4];
    uint32_t n, edges;
} blocks;

static uint32_t block_end(const blocks *b, uint32_t k) { return k + 1 < b->n ? (k + 1) * BLOCK : b->edges; }

static void compare_two(sunder_i_operands *g, const blocks *p, uint32_t i, const blocks *q, uint32_t j, link *best)
{
    compare_edges(g, i * BLOCK, block_end(p, i), j * BLOCK, block_end(q, j), q->box[j], best);
}

/* Compares the two blocks with the closest boxes first, so that most other pairs of blocks are excluded by their
 * boxes. */
static void compare_blocks(sunder_i_operands *g, link *best)
{
    blocks p = {.edges = g->shape[0]->vertices}, q = {.edges = g->shape[1]->vertices};
    p.n = (p.edges + BLOCK - 1) / BLOCK;
    q.n = (q.edges + BLOCK - 1) / BLOCK;
    p.box = block_boxes(g, 0, p.n);
    q.box = block_boxes(g, 1, q.n);
    if (!p.box || !q.box) return;
    uint32_t near_i = 0, near_j = 0;
    double least = INFINITY;
    for (uint32_t i = 0; i < p.n; i++)
        for (uint32_t j = 0; j < q.n; j++) {
            const double square = box_square(p.box[i], p.box[i] + 2, q.box[j], q.box[j] + 2);
            if (square >= least) continue;
            least = square;
            near_i = i;
            near_j = j;
        }
    compare_two(g, &p, near_i, &q, near_j, best);
    for (uint32_t i = 0; i < p.n; i++) {
        const double reach = sqrt(best->square) + 4 * g->error;
        if (box_square(p.box[i], p.box[i] + 2, g->box[1], g->box[1] + 2) > reach * reach) continue;
        for (uint32_t j = 0; j < q.n; j++) {
            const double now = sqrt(best->square) + 4 * g->error;
            if (box_square(p.box[i], p.box[i] + 2, q.box[j], q.box[j] + 2) <= now * now)
                compare_two(g, &p, i, &q, j, best);
        }
    }
}

static link nearest_edges(sunder_i_operands *g)
{
    const uint32_t m = g->shape[0]->vertices, n = g->shape[1]->vertices;
    link best = {INFINITY, 0, 0};
    if ((uint64_t)m * n < BLOCKS_FROM)
        compare_edges(g, 0, m, 0, n, g->box[1], &best);
    else
        compare_blocks(g, &best);
    return best;
}

/* Converts a point from lattice units to the caller's units. */
static vector in_caller_units(sunder_i_operands *g, vector v)
{
    return (vector){v.x * g->unit + g->placed.origin_p[0] + g->base[0],
                    v.y * g->unit + g->placed.origin_p[1] + g->base[1]};
}

static vector link_point(sunder_i_operands *g, int side, uint32_t edge, double t)
{
    const double *a = g->xy[side] + 2 * edge, *b = g->xy[side] + 2 * g->shape[side]->form->cleaned.next[edge];
    return in_caller_units(g, (vector){a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
}

static void link_ends(sunder_i_operands *g, const link *k, double on_p[2], double on_q[2])
{
    int which = 0;
    double t = 0;
    edge_square(g, k->i, k->j, &which, &t);
    const vector a = link_point(g, 0, k->i, which < 2 ? which : t);
    const vector b = link_point(g, 1, k->j, which < 2 ? t : which - 2);
    on_p[0] = a.x;
    on_p[1] = a.y;
    on_q[0] = b.x;
    on_q[1] = b.y;
}

/* Returns a point of both pieces i of P and j of Q: the mean of the vertices of their intersection, computed in
 * doubles. `buffer` has room for two polygons. */
static vector common_point(sunder_i_operands *g, uint32_t i, uint32_t j, vector *buffer)
{
    const sunder_i_operand_piece p = sunder_i_operands_piece(g, 0, i), q = sunder_i_operands_piece(g, 1, j);
    uint32_t n = p.n;
    vector *now = buffer, *then = buffer + (n + q.n + 2);
    for (uint32_t k = 0; k < n; k++) now[k] = (vector){g->xy[0][2 * p.corner[k]], g->xy[0][2 * p.corner[k] + 1]};
    for (uint32_t m = 0; m < q.n; m++) {
        const uint32_t a = q.corner[m], b = sunder_i_piece_next(&q, m);
        const double ax = g->xy[1][2 * a], ay = g->xy[1][2 * a + 1];
        const double ux = g->xy[1][2 * b] - ax, uy = g->xy[1][2 * b + 1] - ay;
        uint32_t kept = 0;
        for (uint32_t k = 0; k < n; k++) {
            const vector u = now[k], v = now[k + 1 < n ? k + 1 : 0];
            const double s = ux * (u.y - ay) - uy * (u.x - ax), t = ux * (v.y - ay) - uy * (v.x - ax);
            if (s >= 0) then[kept++] = u;
            if ((s > 0 && t < 0) || (s < 0 && t > 0))
                then[kept++] = (vector){u.x + (v.x - u.x) * (s / (s - t)), u.y + (v.y - u.y) * (s / (s - t))};
        }
        if (kept == 0) break; /* the intersection is thinner than the errors; the previous polygon is close enough */
        vector *swap = now;
        now = then;
        then = swap;
        n = kept;
    }
    vector sum = {0, 0};
    for (uint32_t k = 0; k < n; k++) sum = (vector){sum.x + now[k].x / n, sum.y + now[k].y / n};
    return in_caller_units(g, sum);
}

static bool find_common_point(sunder_i_operands *g, double on[2])
{
    for (uint32_t i = 0; i < g->shape[0]->pieces; i++) {
        if (!sunder_i_box_near(g->piece_box[0] + 4 * (size_t)i, g->box[1], g->error)) continue;
        for (uint32_t j = 0; j < g->shape[1]->pieces; j++) {
            if (!sunder_i_pieces_overlap(g, i, j)) continue;
            const size_t most = (size_t)g->shape[0]->vertices + g->shape[1]->vertices + 2;
            vector *buffer = sunder_i_arena_alloc(&g->placed.lattice.arena, 2 * most, sizeof *buffer);
            if (!buffer) return true;
            const vector v = common_point(g, i, j, buffer);
            on[0] = v.x;
            on[1] = v.y;
            return true;
        }
    }
    return false;
}

sunder_status sunder_i_distance(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                                double *distance, double on_p[2], double on_q[2], sunder_error *err)
{
    if (p->pieces == 0 || q->pieces == 0) {
        *distance = INFINITY;
        on_p[0] = on_p[1] = on_q[0] = on_q[1] = 0;
        return SUNDER_OK;
    }
    sunder_i_operands g;
    const sunder_i_operands_options options = {.tp = tp, .tq = tq};
    sunder_status status = sunder_i_operands_init(&g, p, q, &options, err);
    if (status) return status;
    double d = 0, ends[4] = {0, 0, 0, 0};
    if (find_common_point(&g, ends)) {
        ends[2] = ends[0];
        ends[3] = ends[1];
    } else {
        const link k = nearest_edges(&g);
        sunder_i_lattice *l = &g.placed.lattice;
        d = sqrt(k.square) * g.unit;
        /* the distance is 0 exactly if the sets touch */
        if (sunder_i_segments_meet(l, g.at[0][k.i], g.at[0][p->form->cleaned.next[k.i]], g.at[1][k.j],
                                   g.at[1][q->form->cleaned.next[k.j]]) != SUNDER_I_APART)
            d = 0;
        else if (d == 0)
            d = 0x1p-1074;
        link_ends(&g, &k, ends, ends + 2);
    }
    status = sunder_i_operands_end(&g, err);
    if (status) return status;
    *distance = d;
    for (int k = 0; k < 2; k++) {
        on_p[k] = ends[k];
        on_q[k] = ends[k + 2];
    }
    return SUNDER_OK;
}

sunder_status sunder_pair_distance(const sunder_shape *p, const sunder_shape *q, double *distance, double on_p[2],
                                   double on_q[2], sunder_error *err)
{
    return sunder_i_distance(p, NULL, q, NULL, distance, on_p, on_q, err);
}
