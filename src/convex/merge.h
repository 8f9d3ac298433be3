/* The sum of two convex polygons: their sides merged by angle [BKOS08, section 13.4].
 *
 * A piece is a counter-clockwise list of sides, each begun by a corner. Both pieces start with the side of the least
 * angle from some direction on, the same one for both, so that angles do not fall within one turn. The sides of the sum
 * are those of both in the order of their angles. The side at hand is the earlier one of the two next sides, or both as
 * one where they have one direction, and starts at the sum of the corners at which the two next sides start.
 *
 * Invariant: that sum of corners is where the sides taken so far end, if they are put end to end. It is a corner of the
 * sum, for it is extreme in all directions normal to the angles between the side taken last and the next.
 *
 *     sunder_i_merge m = sunder_i_merge_of(n, k);
 *     while (SUNDER_I_MERGE_NEXT(&m, compare(p[m.next_a], q[m.next_b])))
 *         ... corner m.a of the one plus corner m.b of the other; m.of_a, m.of_b: whose sides start there
 *
 * The comparison is the caller's: ranks, exact directions, doubles; it is evaluated only while both have sides left.
 * Negative: the first one's side has the smaller angle; positive: the second one's; 0: one direction, and the two sides
 * become one. A caller that never says 0 gets all sides of both, parallel ones in a row.
 *
 *   a piece is used up   it waits in its first corner: a turn has brought it back there
 *   straight corners     sides of one direction follow each other in a piece; the first joins the other piece's side,
 *                        the others stand alone
 *   a segment            two sides, there and back
 *   a point              no sides; it shifts the other piece
 *   two points           no sides at all: nothing is taken, and the one corner is the caller's to add */
#ifndef SUNDER_I_MERGE_H
#define SUNDER_I_MERGE_H

#include <stdbool.h>
#include <stdint.h>

typedef struct sunder_i_merge {
    uint32_t left_a, left_b; /* how many sides are not taken yet */
    uint32_t next_a, next_b; /* the first of these */
    uint32_t a, b;           /* where the side at hand starts */
    bool of_a, of_b;         /* is a side of the first piece part of it? of the second? */
} sunder_i_merge;

static inline sunder_i_merge sunder_i_merge_of(uint32_t sides_a, uint32_t sides_b)
{
    return (sunder_i_merge){.left_a = sides_a, .left_b = sides_b};
}

static inline bool sunder_i_merge_take(sunder_i_merge *m, int order)
{
    m->a = m->left_a ? m->next_a : 0;
    m->b = m->left_b ? m->next_b : 0;
    m->of_a = order <= 0;
    m->of_b = order >= 0;
    if (m->of_a) m->left_a--, m->next_a++;
    if (m->of_b) m->left_b--, m->next_b++;
    return true;
}

/* The next side of the sum; false if there is none. */
#define SUNDER_I_MERGE_NEXT(m, order)                                                                                  \
    (((m)->left_a || (m)->left_b) && sunder_i_merge_take((m), (m)->left_a && (m)->left_b ? (order)                     \
                                                              : (m)->left_a              ? -1                          \
                                                                                         : 1))

#endif
