/* The exact check of a result: asked of the pieces themselves, by separating sides; it shares only the arithmetic with
 * the search. */
#include "separation/nearest.h"

#include <math.h>

typedef struct convex {
    const uint32_t *corner;
    const sunder_i_point *at;
    const double *xy;
    uint32_t n;
} convex;

static convex piece_of(const sunder_i_pairing *g, int side, uint32_t i)
{
    const sunder_shape *s = g->shape[side];
    const uint32_t first = i ? s->piece_end[i - 1] : 0;
    return (convex){s->piece_vertex + first, g->at[side], g->xy[side], s->piece_end[i] - first};
}

/* Sign of cross(b - a, x - c - a), x the point found: on which side of ab the corner x - c of Q + x is. Exact. */
static int exact_side(sunder_i_pairing *g, const sunder_i_nearest *f, sunder_i_point a, sunder_i_point b,
                      sunder_i_point c)
{
    sunder_i_lattice *l = &g->placed.lattice;
    l->operations.orientation_tests++;
    const sunder_i_point corner = sunder_i_pairing_add(g, a, c);
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
static bool side_parts(sunder_i_pairing *g, const sunder_i_nearest *f, const convex *p, const convex *q)
{
    const double per_length = 4 * g->error, fixed = 32 * g->magnitude * g->rough;
    for (uint32_t k = 0; k < p->n; k++) {
        const uint32_t a = p->corner[k], b = p->corner[k + 1 < p->n ? k + 1 : 0];
        const double ux = p->xy[2 * b] - p->xy[2 * a], uy = p->xy[2 * b + 1] - p->xy[2 * a + 1];
        /* The ends are each off by 2^-53 of the magnitude: the error of u counts like a rough one. */
        const double bound = (fabs(ux) + fabs(uy)) * per_length + fixed + g->magnitude * g->magnitude * 0x1p-47;
        const double x = f->x - p->xy[2 * a], y = f->y - p->xy[2 * a + 1];
        bool parts = true;
        for (uint32_t m = 0; m < q->n && parts; m++) {
            const uint32_t c = q->corner[m];
            const double v = ux * (y - q->xy[2 * c + 1]) - uy * (x - q->xy[2 * c]);
            if (v > bound)
                parts = false;
            else if (v >= -bound)
                parts = exact_side(g, f, p->at[a], p->at[b], q->at[c]) <= 0;
        }
        if (parts) return true;
    }
    return false;
}

bool sunder_i_nearest_verify(sunder_i_pairing *g, const sunder_i_nearest *f)
{
    const double e = g->error;
    for (uint32_t i = 0; i < g->shape[0]->pieces; i++) {
        const double *a = g->piece_box[0] + 4 * (size_t)i;
        const convex p = piece_of(g, 0, i);
        for (uint32_t j = 0; j < g->shape[1]->pieces; j++) {
            const double *b = g->piece_box[1] + 4 * (size_t)j;
            if (f->x < a[0] + b[0] - e || f->x > a[2] + b[2] + e || f->y < a[1] + b[1] - e || f->y > a[3] + b[3] + e)
                continue;
            const convex q = piece_of(g, 1, j);
            if (!side_parts(g, f, &p, &q) && !side_parts(g, f, &q, &p)) return false;
        }
    }
    return true;
}
