/* overlapping_pieces.c: tests whether the interiors of two sets meet. They do if those of two pieces do, and two convex
 * pieces have disjoint interiors exactly if a side of one of them has all of the other on its right or on its line: the
 * separating axis theorem, in the plane and for closed sets that may touch. One of the pieces may be a segment, which
 * has two sides in opposite directions, or a point, which has none: then the test is whether the interior of the other
 * piece meets it. */
#include "separation/operands/pair_operands.h"

/* Returns whether a side of piece i of operand `side` has all of piece j of the other operand on its right or on its
 * line. */
static bool side_parts(sunder_i_operands *g, int side, uint32_t i, uint32_t j)
{
    const sunder_i_operand_piece p = sunder_i_operands_piece(g, side, i), q = sunder_i_operands_piece(g, !side, j);
    const sunder_i_point *at = g->at[side], *other = g->at[!side];
    sunder_i_lattice *l = &g->placed.lattice;
    if (p.n < 2) return false;
    for (uint32_t k = 0; k < p.n; k++) {
        const sunder_i_point a = at[p.corner[k]], b = at[sunder_i_piece_next(&p, k)];
        uint32_t m = 0;
        if (l->narrow) {
            const sunder_i_point u = sunder_i_narrow_sub(b, a);
            while (m < q.n && sunder_i_narrow_cross(u, sunder_i_narrow_sub(other[q.corner[m]], a)) <= 0) m++;
            l->counts.orientation_tests += m;
        } else
            while (m < q.n && sunder_i_orient(l, a, b, other[q.corner[m]]) <= 0) m++;
        if (m == q.n) return true;
    }
    return false;
}

bool sunder_i_pieces_overlap(sunder_i_operands *operands, uint32_t i, uint32_t j)
{
    if (!sunder_i_box_near(operands->piece_box[0] + 4 * (size_t)i, operands->piece_box[1] + 4 * (size_t)j,
                           operands->error))
        return false;
    return !side_parts(operands, 0, i, j) && !side_parts(operands, 1, j, i);
}

/* Returns the *n pieces of one operand whose boxes are within `reach` of the box of the other operand; NULL if out of
 * memory. */
static uint32_t *pieces_near(sunder_i_operands *g, int side, double reach, uint32_t *n)
{
    const uint32_t all = g->shape[side]->pieces;
    uint32_t *list = sunder_i_arena_alloc(&g->placed.lattice.arena, all, sizeof *list);
    *n = 0;
    if (!list) return NULL;
    for (uint32_t i = 0; i < all; i++)
        if (sunder_i_box_near(g->piece_box[side] + 4 * (size_t)i, g->box[!side], reach)) list[(*n)++] = i;
    return list;
}

bool sunder_i_operands_overlap(sunder_i_operands *operands)
{
    uint32_t m, n;
    const uint32_t *p = pieces_near(operands, 0, operands->error, &m),
                   *q = pieces_near(operands, 1, operands->error, &n);
    if (!p || !q) return false;
    for (uint32_t i = 0; i < m; i++)
        for (uint32_t j = 0; j < n; j++)
            if (sunder_i_pieces_overlap(operands, p[i], q[j])) return true;
    return false;
}
