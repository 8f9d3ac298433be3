/* near_pairs.c: lists the pairs of pieces near a square. Both trees are traversed together, as long as the extents of
 * two nodes do not exclude the square. A pair that is not listed is farther away than the error; a pair that covers the
 * square ends the traversal. */
#include "separation/squares/squares_inner.h"

#include "base/watch.h"

/* Returns the position of the square relative to the subsum of the pieces i and j. With a gap, pairs slightly farther
 * than the gap are listed, too, since the search with a gap tests positions beside its points. */
static sunder_i_square_position position_to_subsum(const sunder_i_squares *q, uint32_t i, uint32_t j)
{
    const sunder_i_square_depth d = sunder_i_inner_convex_depth(q->inner, i, j, &q->query);
    const float e = SUNDER_I_INNER_CONVEX_ERROR + q->inner[0].vague[i] + q->inner[1].vague[j];
    if (q->gap > 0) {
        const float gap = (float)(2 * q->gap * sunder_i_float_scale(q->g)) + 2 * SUNDER_I_INNER_CONVEX_ERROR;
        return d.touch + gap < -e ? SUNDER_I_POSITION_OUTSIDE
               : d.in > e         ? SUNDER_I_POSITION_WITHIN
                                  : SUNDER_I_POSITION_ACROSS;
    }
    if (d.touch < -e) return SUNDER_I_POSITION_OUTSIDE;
    if (d.in > e) return SUNDER_I_POSITION_WITHIN;
    return d.touch > e && d.in < -e ? SUNDER_I_POSITION_ACROSS : sunder_i_squares_position(q, q->at, i, j);
}

/* Replaces one of two nodes, the one that is higher in its tree, by its children, each combined with the other node. */
static void open_nodes(const sunder_i_squares *q, uint32_t a, uint32_t b, uint32_t part[2][2])
{
    const bool first = b >= q->inner[1].pieces.leaves || (a < q->inner[0].pieces.leaves && a <= b);
    for (uint32_t k = 0; k < 2; k++) {
        part[k][0] = first ? 2 * a + k : a;
        part[k][1] = first ? b : 2 * b + k;
    }
}

/* Adds the pairs below two nodes. Returns false if there are more than `most`, if one of them covers the square
 * (q->covered), or if out of memory. */
static bool gather_pairs(sunder_i_squares *q, uint32_t a, uint32_t b, size_t most)
{
    const sunder_i_dop_tree *p = &q->inner[0].pieces, *r = &q->inner[1].pieces;
    if (!sunder_i_dop_near(p->extent + a, r->extent + b, &q->dop)) return true;
    if (a >= p->leaves && b >= r->leaves) {
        const uint32_t i = p->piece[a - p->leaves], j = r->piece[b - r->leaves];
        if (!sunder_i_step()) return false;
        const sunder_i_square_position where = position_to_subsum(q, i, j);
        if (where == SUNDER_I_POSITION_OUTSIDE) return true;
        q->covered = where == SUNDER_I_POSITION_WITHIN;
        q->covering[0] = i;
        q->covering[1] = j;
        if (q->covered) return false;
        if (q->pairs == most || !sunder_i_reserve(&q->pair, &q->pairs_capacity, q->pairs + 1, sizeof *q->pair))
            return false;
        q->pair[q->pairs][0] = i;
        q->pair[q->pairs++][1] = j;
        return true;
    }
    uint32_t part[2][2];
    open_nodes(q, a, b, part);
    return gather_pairs(q, part[0][0], part[0][1], most) && gather_pairs(q, part[1][0], part[1][1], most);
}

bool sunder_i_squares_gather(sunder_i_squares *squares, const double square[4], size_t most)
{
    double less[4];
    sunder_i_squares_query(squares, square, less);
    squares->dop = sunder_i_dop_query(squares->g, square, squares->gap);
    squares->pairs = 0;
    squares->covered = false;
    return gather_pairs(squares, 1, 1, most);
}
