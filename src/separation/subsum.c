/* Convex subsums: which of them matter, and their corners. The sum of two convex polygons has the sides of both, merged
 * by direction. */
#include "separation/pairing.h"

#include <math.h>
#include <string.h>

static bool touches_disc(const double box[4], double radius)
{
    const double x = box[0] > 0 ? box[0] : box[2] < 0 ? -box[2] : 0;
    const double y = box[1] > 0 ? box[1] : box[3] < 0 ? -box[3] : 0;
    return x <= radius && y <= radius && (x + y <= radius || x * x + y * y <= radius * radius * (1 + 0x1p-50));
}

bool sunder_i_pairing_reach(sunder_i_pairing *g, double radius)
{
    const uint32_t m = g->shape[0]->pieces, n = g->shape[1]->pieces;
    const double reach = radius + 2 * g->error;
    const double *pb = g->piece_box[0], *qb = g->piece_box[1];
    size_t covering = 0, others = 0;
    for (uint32_t i = 0; i < m; i++)
        for (uint32_t j = 0; j < n; j++) {
            const double *a = pb + 4 * (size_t)i, *b = qb + 4 * (size_t)j;
            const double box[4] = {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]};
            if (touches_disc(box, 2 * g->error))
                covering++;
            else if (touches_disc(box, reach))
                others++;
        }
    g->subsums = covering + others;
    g->subsum = sunder_i_arena_alloc(&g->placed.lattice.arena, g->subsums + 1, sizeof *g->subsum);
    if (!g->subsum) return false;
    sunder_i_subsum *near = g->subsum, *far = g->subsum + covering;
    for (uint32_t i = 0; i < m; i++)
        for (uint32_t j = 0; j < n; j++) {
            const double *a = pb + 4 * (size_t)i, *b = qb + 4 * (size_t)j;
            const double box[4] = {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]};
            const bool covers = touches_disc(box, 2 * g->error);
            if (!covers && !touches_disc(box, reach)) continue;
            sunder_i_subsum *s = covers ? near++ : far++;
            s->i = i;
            s->j = j;
            s->sides = 0;
            memcpy(s->box, box, sizeof box);
        }
    return true;
}

/* The lowest corner of a piece (of those the leftmost), as an offset into its corners. */
static uint32_t lowest(sunder_i_pairing *g, int side, uint32_t first, uint32_t n)
{
    const uint32_t *c = g->shape[side]->piece_vertex + first;
    sunder_i_lattice *l = &g->placed.lattice;
    uint32_t best = 0;
    for (uint32_t k = 1; k < n; k++) {
        const sunder_i_point a = g->at[side][c[k]], b = g->at[side][c[best]];
        int d;
        if (l->narrow)
            d = a.y != b.y ? (a.y < b.y ? -1 : 1) : (a.x < b.x ? -1 : 1);
        else {
            d = sunder_i_int_cmp(l, a.y, b.y);
            if (d == 0) d = sunder_i_int_cmp(l, a.x, b.x);
        }
        if (d < 0) best = k;
    }
    return best;
}

typedef struct ring {
    const uint32_t *corner;
    const sunder_i_point *at;
    uint32_t n, start, done; /* `done` sides are used up */
} ring;

static ring open_ring(sunder_i_pairing *g, int side, uint32_t piece)
{
    const sunder_shape *s = g->shape[side];
    const uint32_t first = piece ? s->piece_end[piece - 1] : 0, n = s->piece_end[piece] - first;
    return (ring){s->piece_vertex + first, g->at[side], n, lowest(g, side, first, n), 0};
}

static inline sunder_i_point ring_at(const ring *r, uint32_t ahead)
{
    uint32_t k = r->start + r->done + ahead;
    while (k >= r->n) k -= r->n;
    return r->at[r->corner[k]];
}

/* The merge. Both start at their lowest corners, so that their sides are sorted by angle in [0, 2 pi), and the two sides at
 * hand are never pi or more apart: the side before the further one came before the other, and turns by less than pi. */
static uint32_t merge(sunder_i_pairing *g, ring *a, ring *b, sunder_i_point *corner, sunder_i_point *side)
{
    uint32_t n = 0;
    while (a->done < a->n || b->done < b->n) {
        const sunder_i_point pa = ring_at(a, 0), pb = ring_at(b, 0);
        const sunder_i_point u = sunder_i_pairing_diff(g, ring_at(a, 1), pa);
        const sunder_i_point v = sunder_i_pairing_diff(g, ring_at(b, 1), pb);
        const int turn = a->done == a->n ? -1 : b->done == b->n ? 1 : sunder_i_pairing_cross(g, u, v);
        corner[n] = sunder_i_pairing_add(g, pa, pb);
        side[n++] = turn > 0 ? u : turn < 0 ? v : sunder_i_pairing_add(g, u, v);
        if (turn >= 0) a->done++;
        if (turn <= 0) b->done++;
    }
    return n;
}

bool sunder_i_subsum_make(sunder_i_pairing *g, sunder_i_subsum *s)
{
    sunder_i_lattice *l = &g->placed.lattice;
    ring a = open_ring(g, 0, s->i), b = open_ring(g, 1, s->j);
    const size_t most = (size_t)a.n + b.n;
    sunder_i_point *points = sunder_i_arena_alloc(&l->arena, most, 2 * sizeof *points + 5 * sizeof *s->cx);
    if (!points) return false;
    s->corner = points;
    s->side = points + most;
    s->cx = (double *)(points + 2 * most);
    s->cy = s->cx + most;
    s->sx = s->cy + most;
    s->sy = s->sx + most;
    s->bound = s->sy + most;
    const uint32_t n = merge(g, &a, &b, s->corner, s->side);
    const double per_length = 2 * g->error, fixed = 16 * g->magnitude * g->rough;
    for (uint32_t k = 0; k < n; k++) {
        s->cx[k] = sunder_i_approx(l, s->corner[k].x);
        s->cy[k] = sunder_i_approx(l, s->corner[k].y);
        s->sx[k] = sunder_i_approx(l, s->side[k].x);
        s->sy[k] = sunder_i_approx(l, s->side[k].y);
        s->bound[k] = (fabs(s->sx[k]) + fabs(s->sy[k])) * per_length + fixed;
    }
    s->sides = n;
    return !l->arena.failed;
}
