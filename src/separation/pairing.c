#include "separation/pairing.h"

#include <math.h>
#include <string.h>

/* Doubles of coordinates are within 2^-53 of the magnitude M; a sum of two adds as much again and its own rounding. A point
 * a + t d with t from an exact fraction (its value within 2^-50 of max(1, |t|), t taken in [0, 1]) and |d| <= 4 M is within
 * 2^-47 M; the rest is slack, which costs nothing but a few exact evaluations. */
#define COORDINATE_ERROR 0x1p-45

static void grow_box(double box[4], double x, double y)
{
    if (x < box[0]) box[0] = x;
    if (y < box[1]) box[1] = y;
    if (x > box[2]) box[2] = x;
    if (y > box[3]) box[3] = y;
}

static const double EMPTY_BOX[4] = {INFINITY, INFINITY, -INFINITY, -INFINITY};

static void fill_operand(sunder_i_pairing *g, int side)
{
    const sunder_shape *s = g->shape[side];
    const sunder_i_lattice *l = &g->placed.lattice;
    double *xy = g->xy[side];
    memcpy(g->box[side], EMPTY_BOX, sizeof EMPTY_BOX);
    for (uint32_t v = 0; v < s->vertices; v++) {
        xy[2 * v] = sunder_i_approx(l, g->at[side][v].x);
        xy[2 * v + 1] = sunder_i_approx(l, g->at[side][v].y);
        grow_box(g->box[side], xy[2 * v], xy[2 * v + 1]);
    }
    for (int k = 0; k < 4; k++) g->magnitude = fmax(g->magnitude, fabs(g->box[side][k]));
    uint32_t c = 0;
    for (uint32_t i = 0; i < s->pieces; i++) {
        double *box = g->piece_box[side] + 4 * (size_t)i;
        memcpy(box, EMPTY_BOX, sizeof EMPTY_BOX);
        for (; c < s->piece_end[i]; c++) {
            const uint32_t v = s->piece_vertex[c];
            grow_box(box, xy[2 * v], xy[2 * v + 1]);
        }
    }
}

sunder_status sunder_i_pairing_init(sunder_i_pairing *g, const sunder_shape *p, const sunder_shape *q,
                                    const sunder_i_pairing_options *options, sunder_error *err)
{
    const sunder_i_place_options place = {.reflect_q = options->reflect_q,
                                          .common_origin = true,
                                          .extra = options->extra,
                                          .extra_n = options->extra_n,
                                          .shift_p = options->tp,
                                          .shift_q = options->tq,
                                          .force_wide = options->force_wide};
    memset(g, 0, sizeof *g);
    g->shape[0] = p;
    g->shape[1] = q;
    const sunder_status status = sunder_i_place(p, q, &place, &g->placed, err);
    if (status) return status;
    sunder_i_lattice *l = &g->placed.lattice;
    g->at[0] = g->placed.p;
    g->at[1] = g->placed.q;
    const size_t pn = p->vertices, qn = q->vertices, pp = p->pieces, qp = q->pieces;
    double *block = sunder_i_arena_alloc(&l->arena, 2 * (pn + qn) + 4 * (pp + qp), sizeof *block);
    if (!block || l->arena.failed) {
        sunder_i_placed_free(&g->placed);
        return sunder_i_no_memory(err);
    }
    g->xy[0] = block;
    g->xy[1] = g->xy[0] + 2 * pn;
    g->piece_box[0] = g->xy[1] + 2 * qn;
    g->piece_box[1] = g->piece_box[0] + 4 * pp;
    fill_operand(g, 0);
    fill_operand(g, 1);
    g->error = COORDINATE_ERROR * g->magnitude;
    g->rough = l->narrow ? 0 : g->error;
    g->coarse = l->narrow && g->magnitude < 0x1p52 ? 0 : g->error;
    const bool whole = l->denominator.size == 1 && l->denominator.limb[0] == 1;
    g->unit = whole ? ldexp(1, (int)(l->exponent + l->approx_shift))
                    : sunder_i_big_ratio(&l->arena, sunder_i_big_i64(&l->arena, 1), l->denominator,
                                         l->exponent + l->approx_shift);
    return SUNDER_OK;
}

void sunder_i_pairing_free(sunder_i_pairing *pairing)
{
    sunder_i_placed_free(&pairing->placed);
}

/* Is a + s + gap <= b + t for certain? Each double sum is off by at most an ulp of its larger operand. */
static bool certainly_below(double a, double s, double b, double t, double gap)
{
    const double left = a + s + gap, right = b + t;
    const double slack = 0x1p-50 * (fabs(a) + fabs(s) + gap + fabs(b) + fabs(t));
    return left + slack < right || (s == 0 && t == 0 && gap == 0 && a <= b);
}

bool sunder_i_boxes_apart(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                          double gap)
{
    for (int k = 0; k < 2; k++) {
        const double s = tp ? tp[k] : 0, t = tq ? tq[k] : 0;
        if (certainly_below(p->box[k + 2], s, q->box[k], t, gap) || certainly_below(q->box[k + 2], t, p->box[k], s, gap))
            return true;
    }
    return false;
}

/* ---- Pieces ---- */

/* Does a side of piece i of operand `side` have all of piece j of the other one on its right, or on it? */
static bool side_parts(sunder_i_pairing *g, int side, uint32_t i, uint32_t j)
{
    const sunder_shape *s = g->shape[side], *o = g->shape[!side];
    const uint32_t *c = s->piece_vertex, *d = o->piece_vertex;
    const uint32_t first = i ? s->piece_end[i - 1] : 0, last = s->piece_end[i];
    const uint32_t from = j ? o->piece_end[j - 1] : 0, to = o->piece_end[j];
    sunder_i_lattice *l = &g->placed.lattice;
    for (uint32_t k = first; k < last; k++) {
        const sunder_i_point a = g->at[side][c[k]], b = g->at[side][c[k + 1 < last ? k + 1 : first]];
        uint32_t m = from;
        if (l->narrow) {
            const sunder_i_point u = sunder_i_narrow_sub(b, a);
            while (m < to && sunder_i_narrow_cross(u, sunder_i_narrow_sub(g->at[!side][d[m]], a)) <= 0) m++;
            l->operations.orientation_tests += m - from;
        } else
            while (m < to && sunder_i_orient(l, a, b, g->at[!side][d[m]]) <= 0) m++;
        if (m == to) return true;
    }
    return false;
}

bool sunder_i_pieces_overlap(sunder_i_pairing *g, uint32_t i, uint32_t j)
{
    const double *a = g->piece_box[0] + 4 * (size_t)i, *b = g->piece_box[1] + 4 * (size_t)j, e = g->error;
    if (a[2] < b[0] - e || b[2] < a[0] - e || a[3] < b[1] - e || b[3] < a[1] - e) return false;
    return !side_parts(g, 0, i, j) && !side_parts(g, 1, j, i);
}
