/* containment.c: tests whether a closed set lies in another.
 *
 * P lies in Q exactly if no convex piece C of P has interior points outside Q. If C has some, then the interior of C is
 * either disjoint from Q, or it contains a part of the boundary of Q of positive length, since each part of the
 * boundary of a set that is the closure of its interior has positive length. Hence P lies in Q if each C overlaps a
 * piece of Q and, along each boundary edge of a polygon of Q, inside C, other pieces of Q cover the outer side of the
 * edge (polygons may overlap and touch). It is enough that this holds except at finitely many points, so that closed
 * intervals on the edge decide. */
#include "separation/separation.h"

#include "base/invariant.h"
#include "separation/operands/pair_operands.h"

typedef struct interval {
    sunder_i_fraction low, high;
} interval;

/* Computes the part of the segment ab (t in [0, 1]) in piece i of operand `side`; returns false if it has no length. If
 * the segment runs along a side of the piece, it counts only if `right` is true and the interior of the piece is on the
 * right of ab. */
static bool clip_segment(sunder_i_operands *g, sunder_i_point a, sunder_i_point b, int side, uint32_t i, bool right,
                         interval *out)
{
    sunder_i_lattice *l = &g->placed.lattice;
    const sunder_i_point d = sunder_i_point_sub(l, b, a), *at = g->at[side];
    const sunder_i_operand_piece c = sunder_i_operands_piece(g, side, i);
    out->low = sunder_i_fraction_int(l, 0);
    out->high = sunder_i_fraction_int(l, 1);
    for (uint32_t k = 0; k < c.n; k++) {
        const sunder_i_point u = at[c.corner[k]], v = at[sunder_i_piece_next(&c, k)];
        const sunder_i_point s = sunder_i_point_sub(l, v, u);
        const int turn = sunder_i_cross_sign(l, s, d);
        if (turn == 0) {
            const int where = sunder_i_orient(l, u, v, a);
            /* The segment lies on the line of the side. The piece is on the left of the side, hence on the right of ab
             * if the two directions are opposite. */
            if (where < 0 || (where == 0 && !(right && sunder_i_dot_sign(l, s, d) < 0))) return false;
            continue;
        }
        const sunder_i_fraction t = sunder_i_crossing(l, a, b, u, v);
        if (turn > 0) {
            if (sunder_i_fraction_cmp(l, &t, &out->low) > 0) out->low = t;
        } else if (sunder_i_fraction_cmp(l, &t, &out->high) < 0)
            out->high = t;
    }
    SUNDER_I_ASSERT((out->low.value >= 0 && out->high.value <= 1) || l->arena.failed);
    return sunder_i_fraction_cmp(l, &out->low, &out->high) < 0;
}

/* Returns whether the n closed intervals, in any order, cover *want except for finitely many points. */
static bool intervals_cover(sunder_i_lattice *l, interval *v, uint32_t n, const interval *want)
{
    sunder_i_fraction reached = want->low;
    /* Extends the covered part to the end of an interval that begins in it, while there is one; n is small. */
    bool grew = true;
    while (grew && sunder_i_fraction_cmp(l, &reached, &want->high) < 0) {
        grew = false;
        for (uint32_t i = 0; i < n; i++)
            if (sunder_i_fraction_cmp(l, &v[i].low, &reached) <= 0 &&
                sunder_i_fraction_cmp(l, &v[i].high, &reached) > 0) {
                reached = v[i].high;
                grew = true;
            }
    }
    return sunder_i_fraction_cmp(l, &reached, &want->high) >= 0;
}

/* Returns whether the right side of edge e of Q, inside piece i of P, belongs to Q. */
static bool edge_harmless(sunder_i_operands *g, uint32_t i, uint32_t e, interval *buffer)
{
    const sunder_shape *q = g->shape[1];
    const uint32_t next = q->form->cleaned.next[e];
    double box[4];
    sunder_i_box_of_segment(g->xy[1] + 2 * e, g->xy[1] + 2 * next, box);
    const sunder_i_point a = g->at[1][e], b = g->at[1][next];
    interval want;
    if (!sunder_i_box_near(g->piece_box[0] + 4 * (size_t)i, box, g->error) ||
        !clip_segment(g, a, b, 0, i, false, &want))
        return true;
    uint32_t n = 0;
    for (uint32_t j = 0; j < q->pieces; j++)
        if (sunder_i_box_near(g->piece_box[1] + 4 * (size_t)j, box, g->error) &&
            clip_segment(g, a, b, 1, j, true, buffer + n))
            n++;
    return intervals_cover(&g->placed.lattice, buffer, n, &want);
}

static bool piece_contained(sunder_i_operands *g, uint32_t i, interval *buffer)
{
    const sunder_shape *q = g->shape[1];
    bool meets = false;
    for (uint32_t j = 0; j < q->pieces && !meets; j++) meets = sunder_i_pieces_overlap(g, i, j);
    if (!meets) return false;
    for (uint32_t e = 0; e < q->vertices; e++)
        if (!edge_harmless(g, i, e, buffer)) return false;
    return true;
}

static bool all_contained(sunder_i_operands *g)
{
    const double *p = g->box[0], *q = g->box[1], e = g->error;
    if (p[0] < q[0] - e || p[1] < q[1] - e || p[2] > q[2] + e || p[3] > q[3] + e) return false;
    interval *buffer = sunder_i_arena_alloc(&g->placed.lattice.arena, g->shape[1]->pieces, sizeof *buffer);
    if (!buffer) return false;
    for (uint32_t i = 0; i < g->shape[0]->pieces; i++)
        if (!piece_contained(g, i, buffer)) return false;
    return true;
}

sunder_status sunder_i_contained(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                                 bool *contained, sunder_error *err)
{
    if (p->pieces == 0 || q->pieces == 0) {
        *contained = p->pieces == 0;
        return SUNDER_OK;
    }
    if (sunder_i_boxes_apart(p, tp, q, tq, 0)) {
        *contained = false;
        return SUNDER_OK;
    }
    sunder_i_operands g;
    const sunder_i_operands_options options = {.tp = tp, .tq = tq};
    sunder_status status = sunder_i_operands_init(&g, p, q, &options, err);
    if (status) return status;
    const bool answer = all_contained(&g);
    status = sunder_i_operands_end(&g, err);
    if (status == SUNDER_OK) *contained = answer;
    return status;
}
