/* approx_sum.c: two pieces merged by ranks, as in merge.h; corners and sides are the doubles of the piece trees.
 *
 * Errors. Let u = 2^-53, and let `most` bound the sum of the operands' coordinates. A corner of the sum has an error of
 * 2u * most (conversion and addition), differences of coordinates have one of as much again, products and their
 * difference have one of 3u of products up to 2 * most * |d|. The total is below 16 u * most * (|dx| + |dy|); twice
 * that is used. On lattices that are not narrow approx_shift keeps the largest coordinates near 2^500;
 * SUNDER_I_APPROX_UNDERFLOW bounds the error of numbers that underflow. */
#include "convex/approx_sum.h"

#include "convex/merge.h"
#include "number/trust.h"

#include <math.h>

double sunder_i_approx_sum_error(const sunder_i_piece_tree *p, const sunder_i_piece_tree *q)
{
    return 0x1p-48 * (p->most + q->most) + 0x1p-900;
}

sunder_i_cell_window sunder_i_cell_window_of(const double box[4], double error)
{
    sunder_i_cell_window w = {.cx = box[0] / 2 + box[2] / 2,
                              .cy = box[1] / 2 + box[3] / 2,
                              .hx = box[2] / 2 - box[0] / 2,
                              .hy = box[3] / 2 - box[1] / 2,
                              .error = error};
    sunder_i_half_planes_of_box(box, w.low, w.high);
    for (int k = 0; k < SUNDER_I_WAYS; k++) {
        w.low[k] -= 2 * error; /* x + y has the errors of both */
        w.high[k] += 2 * error;
    }
    return w;
}

/* Two pieces during their merge. */
typedef struct circuit {
    const sunder_i_approx_side *a, *b; /* the first sides */
    const uint32_t *rank_a, *rank_b;
    sunder_i_merge merge;
} circuit;

static circuit circuit_of(const sunder_i_piece_tree *p, uint32_t i, const sunder_i_piece_tree *q, uint32_t j)
{
    const uint32_t af = sunder_i_convex_pieces_first(p->pieces, i), bf = sunder_i_convex_pieces_first(q->pieces, j);
    return (circuit){p->side + af, q->side + bf, p->pieces->rank + af, q->pieces->rank + bf,
                     sunder_i_merge_of(p->pieces->end[i] - af, q->pieces->end[j] - bf)};
}

static inline bool next_side(circuit *r)
{
    return SUNDER_I_MERGE_NEXT(&r->merge, sunder_i_rank_cmp(r->rank_a[r->merge.next_a], r->rank_b[r->merge.next_b]));
}

sunder_i_window_place sunder_i_approx_sum_sees(const sunder_i_piece_tree *p, uint32_t i, const sunder_i_piece_tree *q,
                                               uint32_t j, const sunder_i_cell_window *w)
{
    sunder_i_window_place where = SUNDER_I_WITHIN;
    for (circuit r = circuit_of(p, i, q, j); next_side(&r);) {
        const sunder_i_approx_side *a = &r.a[r.merge.a], *b = &r.b[r.merge.b], *s = r.merge.of_a ? a : b;
        const double adx = fabs(s->dx), ady = fabs(s->dy), reach = w->hx * ady + w->hy * adx;
        const double error = SUNDER_I_DOUBT(w->error * (adx + ady) + SUNDER_I_APPROX_UNDERFLOW);
        const double c = s->dx * (w->cy - (a->y + b->y)) - s->dy * (w->cx - (a->x + b->x));
        if (c + reach < -error) return SUNDER_I_BEYOND;
        if (!(c - reach > error)) where = SUNDER_I_ACROSS;
    }
    return where;
}

double sunder_i_approx_sum_area(const sunder_i_piece_tree *p, uint32_t i, const sunder_i_piece_tree *q, uint32_t j)
{
    double area = 0;
    for (circuit r = circuit_of(p, i, q, j); next_side(&r);) {
        const sunder_i_approx_side *a = &r.a[r.merge.a], *b = &r.b[r.merge.b];
        const double x = a->x - r.a->x + (b->x - r.b->x), y = a->y - r.a->y + (b->y - r.b->y);
        if (r.merge.of_a) area += x * a->dy - y * a->dx;
        if (r.merge.of_b) area += x * b->dy - y * b->dx;
    }
    return area / 2;
}
