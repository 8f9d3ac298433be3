/* The exact check of a result: asked of the pieces themselves, by separating sides; it shares only the arithmetic with
 * the search. */
#include "separation/penetration/search.h"

#include "base/sort.h"
#include "base/watch.h"

#include <math.h>

/* Sign of cross(b - a, x - c - a), x the point found: on which side of ab the corner x - c of Q + x is. Exact. */
static int exact_side(sunder_i_operands *g, const sunder_i_free_point *f, sunder_i_point a, sunder_i_point b,
                      sunder_i_point c)
{
    sunder_i_lattice *l = &g->placed.lattice;
    l->counts.orientation_tests++;
    const sunder_i_point corner = sunder_i_operands_add(g, a, c);
    if (!l->narrow) {
        const sunder_i_hpoint x = sunder_i_hpoint_at(l, f->line.a, f->line.b, &f->t);
        return sunder_i_orient_hpoint(l, corner, sunder_i_point_add(l, b, c), &x);
    }
    const sunder_i_point u = sunder_i_narrow_sub(b, a);
    const sunder_i_i128 p = sunder_i_narrow_cross(u, sunder_i_narrow_sub(f->line.a, corner));
    const sunder_i_i128 q = sunder_i_narrow_cross(u, f->line.d);
    return q == 0 ? sunder_i_i128_sign(p) : sunder_i_cmp_products(p, f->t.den, -q, f->t.num);
}

/* Does a side of p have all of x - q on its right or on it? Symmetric in p and q up to the reflection at x / 2. */
static bool side_parts(sunder_i_operands *g, const sunder_i_free_point *f, const sunder_i_operand_piece *p,
                       const sunder_i_operand_piece *q)
{
    const sunder_i_point *at = g->at[p->side];
    const double *xy = g->xy[p->side], *other = g->xy[q->side];
    /* The ends are each off by 2^-53 of the magnitude: the error of u counts like a rough one. */
    const double per_length = 4 * g->error;
    const double fixed = 32 * g->magnitude * g->rough + g->magnitude * g->magnitude * 0x1p-47;
    if (p->n < 2) return false; /* a point has no sides */
    uint32_t a = p->corner[p->n - 1];
    for (uint32_t k = 0; k < p->n; k++) {
        const uint32_t b = p->corner[k];
        const double ux = xy[2 * b] - xy[2 * a], uy = xy[2 * b + 1] - xy[2 * a + 1];
        const double bound = (fabs(ux) + fabs(uy)) * per_length + fixed;
        const double x = f->x - xy[2 * a], y = f->y - xy[2 * a + 1];
        uint32_t m = 0;
        for (; m < q->n; m++) {
            const uint32_t c = q->corner[m];
            const double v = ux * (y - other[2 * c + 1]) - uy * (x - other[2 * c]);
            if (v < -bound) continue;
            if (v > bound || exact_side(g, f, at[a], at[b], g->at[q->side][c]) > 0) break;
        }
        if (m == q->n) return true;
        a = b;
    }
    return false;
}

/* Does the point lie off the subsum of these pieces by its box, or by a side of one of them? */
static bool parted(sunder_i_operands *g, const sunder_i_free_point *f, uint32_t i, uint32_t j)
{
    const double *a = g->piece_box[0] + 4 * (size_t)i, *b = g->piece_box[1] + 4 * (size_t)j;
    if (!sunder_i_box_sum_near_point(a, b, f->x, f->y, g->error)) return true;
    const sunder_i_operand_piece p = sunder_i_operands_piece(g, 0, i), q = sunder_i_operands_piece(g, 1, j);
    return side_parts(g, f, &p, &q) || side_parts(g, f, &q, &p);
}

/* ---- Many pieces ---- */

typedef struct row {
    const double *box; /* of all pieces */
    uint32_t *piece;   /* those that the other operand can reach, by their low x */
    uint32_t n;
    double widest;
} row;

static int by_low_x(void *context, uint32_t i, uint32_t j)
{
    const double *box = context, a = box[4 * (size_t)i], b = box[4 * (size_t)j];
    return (a > b) - (a < b);
}

static bool line_up(const sunder_i_operands *g, const sunder_i_free_point *f, int side, row *r)
{
    const uint32_t n = g->shape[side]->pieces;
    *r = (row){.box = g->piece_box[side], .piece = sunder_i_alloc(n, sizeof *r->piece)};
    if (!r->piece) return false;
    for (uint32_t i = 0; i < n; i++) {
        const double *a = r->box + 4 * (size_t)i;
        if (!sunder_i_box_sum_near_point(a, g->box[!side], f->x, f->y, g->error)) continue;
        r->piece[r->n++] = i;
        r->widest = fmax(r->widest, a[2] - a[0]);
    }
    return sunder_i_sort_indices(r->piece, r->n, by_low_x, (void *)r->box);
}

/* The first whose low x is not below that. */
static uint32_t first_from(const row *r, double x)
{
    uint32_t low = 0, high = r->n;
    while (low < high) {
        const uint32_t k = low + (high - low) / 2;
        if (r->box[4 * (size_t)r->piece[k]] < x)
            low = k + 1;
        else
            high = k;
    }
    return low;
}

/* For each piece of Q the pieces of P that can have the point between them in x. Doubles, with room for rounding. */
static bool verify_many(sunder_i_operands *g, const sunder_i_free_point *f)
{
    const double *b = g->piece_box[1], e = 4 * g->error;
    row p;
    bool ok = line_up(g, f, 0, &p);
    if (!ok) g->placed.lattice.arena.failed = true;
    for (uint32_t j = 0; ok && j < g->shape[1]->pieces; j++) {
        const double low = f->x - b[4 * (size_t)j + 2] - p.widest - e, high = f->x - b[4 * (size_t)j] + e;
        const uint32_t first = first_from(&p, low);
        uint32_t k = first;
        while (ok && k < p.n && p.box[4 * (size_t)p.piece[k]] <= high) ok = parted(g, f, p.piece[k++], j);
        if (!sunder_i_steps((k - first) / 8 + 1)) g->placed.lattice.arena.failed = true;
        ok = ok && !g->placed.lattice.arena.failed;
    }
    sunder_i_free(p.piece);
    return ok;
}

#define MANY 4096 /* pairs, from which on sorting pays */

bool sunder_i_free_point_verify(sunder_i_operands *g, const sunder_i_free_point *f)
{
    const uint32_t m = g->shape[0]->pieces, n = g->shape[1]->pieces;
    if ((uint64_t)m * n > MANY) return verify_many(g, f);
    for (uint32_t i = 0; i < m; i++)
        for (uint32_t j = 0; j < n; j++)
            if (!parted(g, f, i, j)) return false;
    return true;
}
