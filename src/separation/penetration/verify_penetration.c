/* verify_penetration.c: the exact verification of a result. It tests the pieces by separating sides and shares only the
 * arithmetic with the search. */
#include "separation/penetration/penetration_search.h"

#include "base/extremes.h"
#include "base/sort.h"
#include "base/watch.h"

#include <math.h>

/* Returns the sign of cross(b - a, x - c - a), x the found point: on which side of ab the vertex x - c of x - Q is.
 * Exact. */
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

/* Side ab of an operand, in doubles. */
typedef struct side_line {
    uint32_t a, b;
    double ux, uy, x, y; /* b - a, and x - a, x the point found */
    double bound;        /* a vertex whose distance from the line, times the length of the side, exceeds this is
                          * certainly on one side */
} side_line;

static inline side_line line_of(const sunder_i_operands *g, const sunder_i_free_point *f, int side, uint32_t a,
                                uint32_t b)
{
    const double *xy = g->xy[side];
    /* Each end has an error of 2^-53 of the magnitude, so that the error of u is absolute. */
    const double per_length = 4 * g->error;
    const double fixed = 32 * g->magnitude * g->rough + g->magnitude * g->magnitude * 0x1p-47;
    const double ux = xy[2 * b] - xy[2 * a], uy = xy[2 * b + 1] - xy[2 * a + 1];
    return (side_line){.a = a,
                       .b = b,
                       .ux = ux,
                       .uy = uy,
                       .x = f->x - xy[2 * a],
                       .y = f->y - xy[2 * a + 1],
                       .bound = (fabs(ux) + fabs(uy)) * per_length + fixed};
}

/* The number of vertices compared with a side before the results are examined, since it cannot be predicted which
 * vertex is on its left. */
#define CORNERS_AT_ONCE 8

/* Returns a number whose bit k is set if it is uncertain whether x - corner[k] is on the left of the side. If n is
 * odd bit n may be set, too; it stands for the last vertex again, since two vertices are compared at a time. *left
 * becomes whether one is certainly on the left. */
static inline uint32_t compare_corners(const side_line *s, const double *xy, const uint32_t *corner, uint32_t n,
                                       bool *left)
{
    sunder_i_double_masks any = {0, 0};
    uint32_t doubt = 0;
    for (uint32_t k = 0; k < n; k += SUNDER_I_DOUBLES) {
        const double *c = xy + 2 * (size_t)corner[k], *d = xy + 2 * (size_t)corner[k + 1 < n ? k + 1 : k];
        const sunder_i_doubles cx = {c[0], d[0]}, cy = {c[1], d[1]};
        const sunder_i_doubles v = s->ux * (s->y - cy) - s->uy * (s->x - cx);
        any |= v > s->bound;
        doubt |= sunder_i_doubles_set(~(v < -s->bound)) << k;
    }
    *left = sunder_i_doubles_set(any) != 0;
    return doubt;
}

/* Returns whether all of x - q is on the right of the side s of p, or on its line. */
static bool has_on_right(sunder_i_operands *g, const sunder_i_free_point *f, const side_line *s,
                         const sunder_i_operand_piece *p, const sunder_i_operand_piece *q)
{
    for (uint32_t m = 0; m < q->n; m += CORNERS_AT_ONCE) {
        const uint32_t *corner = q->corner + m, n = q->n - m < CORNERS_AT_ONCE ? q->n - m : CORNERS_AT_ONCE;
        bool left;
        uint32_t doubt = compare_corners(s, g->xy[q->side], corner, n, &left);
        if (left) return false;
        for (; doubt; doubt &= doubt - 1) {
            const uint32_t k = (uint32_t)__builtin_ctz(doubt), c = corner[k < n ? k : n - 1];
            if (exact_side(g, f, g->at[p->side][s->a], g->at[p->side][s->b], g->at[q->side][c]) > 0) return false;
        }
    }
    return true;
}

/* Returns whether a side of p has all of x - q on its right or on its line. p and q may be exchanged, up to the
 * reflection at x / 2. */
static bool side_parts(sunder_i_operands *g, const sunder_i_free_point *f, const sunder_i_operand_piece *p,
                       const sunder_i_operand_piece *q)
{
    if (p->n < 2) return false; /* a point has no sides */
    uint32_t a = p->corner[p->n - 1];
    for (uint32_t k = 0; k < p->n; k++) {
        const side_line s = line_of(g, f, p->side, a, p->corner[k]);
        if (has_on_right(g, f, &s, p, q)) return true;
        a = p->corner[k];
    }
    return false;
}

/* Returns the side of p whose normal has the largest product with (x, y), as the vertex at its end. The product, with
 * the normal not normalised, must exceed *most, which is raised to it; else UINT32_MAX is returned. */
static inline uint32_t side_towards(const sunder_i_operands *g, const sunder_i_operand_piece *p, double x, double y,
                                    double *most)
{
    const double *xy = g->xy[p->side], *a = xy + 2 * (size_t)p->corner[p->n - 1];
    uint32_t best = UINT32_MAX;
    for (uint32_t k = 0; k < p->n; k++) {
        const double *b = xy + 2 * (size_t)p->corner[k], v = (b[1] - a[1]) * x - (b[0] - a[0]) * y;
        best = v > *most ? k : best;
        *most = v > *most ? v : *most;
        a = b;
    }
    return best;
}

/* Tests the side that probably separates p and q: the one whose normal points most in the direction from the centre of
 * their sum to the point. */
static bool likely_side_parts(sunder_i_operands *g, const sunder_i_free_point *f, const sunder_i_operand_piece *p,
                              const sunder_i_operand_piece *q, const double sum[4])
{
    const double x = f->x - (sum[0] / 2 + sum[2] / 2), y = f->y - (sum[1] / 2 + sum[3] / 2);
    double most = 0;
    const uint32_t i = side_towards(g, p, x, y, &most), j = side_towards(g, q, x, y, &most);
    if (j != UINT32_MAX) {
        const side_line s = line_of(g, f, q->side, q->corner[j ? j - 1 : q->n - 1], q->corner[j]);
        return has_on_right(g, f, &s, q, p);
    }
    if (i == UINT32_MAX) return false;
    const side_line s = line_of(g, f, p->side, p->corner[i ? i - 1 : p->n - 1], p->corner[i]);
    return has_on_right(g, f, &s, p, q);
}

/* Returns whether the point is outside the subsum of these pieces, by its box or by a side of one of them. */
static bool parted_pieces(sunder_i_operands *g, const sunder_i_free_point *f, uint32_t i, uint32_t j)
{
    double sum[4];
    sunder_i_box_sum(g->piece_box[0] + 4 * (size_t)i, g->piece_box[1] + 4 * (size_t)j, sum);
    if (!sunder_i_box_near_point(sum, f->x, f->y, g->error)) return true;
    const sunder_i_operand_piece p = sunder_i_operands_piece(g, 0, i), q = sunder_i_operands_piece(g, 1, j);
    return likely_side_parts(g, f, &p, &q, sum) || side_parts(g, f, &p, &q) || side_parts(g, f, &q, &p);
}

/* ---- Many pieces ---- */

typedef struct row {
    const double *box; /* the boxes of all pieces */
    uint32_t *piece;   /* the pieces that can reach the point with the other operand, sorted by minimum x */
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
        r->widest = sunder_i_max(r->widest, a[2] - a[0]);
    }
    return sunder_i_sort_indices(r->piece, r->n, by_low_x, (void *)r->box);
}

/* Returns the first piece whose minimum x is not less than x. */
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

/* Tests each piece of Q with the pieces of P whose range of x can contain the point together with it. In doubles, with
 * an allowance for rounding. */
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
        while (ok && k < p.n && p.box[4 * (size_t)p.piece[k]] <= high) ok = parted_pieces(g, f, p.piece[k++], j);
        if (!sunder_i_steps((k - first) / 8 + 1)) g->placed.lattice.arena.failed = true;
        ok = ok && !g->placed.lattice.arena.failed;
    }
    sunder_i_free(p.piece);
    return ok;
}

#define MANY 4096 /* the number of pairs from which sorting is worth its cost */

bool sunder_i_free_point_verify(sunder_i_operands *operands, const sunder_i_free_point *nearest)
{
    const uint32_t m = operands->shape[0]->pieces, n = operands->shape[1]->pieces;
    if ((uint64_t)m * n > MANY) return verify_many(operands, nearest);
    for (uint32_t i = 0; i < m; i++)
        for (uint32_t j = 0; j < n; j++)
            if (!parted_pieces(operands, nearest, i, j)) return false;
    return true;
}
