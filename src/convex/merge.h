/* merge.h: the sum of two convex polygons: their sides are merged by angle [BKOS08, section 13.4].
 *
 * A piece is a counterclockwise list of sides, each of which starts at a corner. Both pieces start with the side of the
 * least angle, measured from the same direction, so that angles ascend within one turn. The sides of the sum are those
 * of both pieces in the order of their angles. The current side is the earlier one of the two next sides, or both as
 * one if they have the same direction, and starts at the sum of the corners at which the two next sides start.
 *
 * Invariant: this sum of corners is the end of the polyline of the sides taken so far. It is a corner of the sum, since
 * it is extreme in all directions normal to the angles between the side taken last and the next one.
 *
 *   sunder_i_merge m = sunder_i_merge_of(n, k);
 *   while (SUNDER_I_MERGE_NEXT(&m, compare(p[m.next_a], q[m.next_b])))
 *       ... corner m.a of the first piece plus corner m.b of the second; m.of_a, m.of_b: whose sides start there
 *
 * The caller supplies the comparison: of ranks, exact directions or doubles; it is evaluated only while both pieces
 * have sides left. Negative: the side of the first piece has the smaller angle; positive: that of the second; 0: the
 * directions are equal, and the two sides become one. A comparison that is never 0 results in all sides of both pieces,
 * with parallel ones adjacent.
 *
 *   a piece has no side left  its corner is the first one, to which a full turn returns
 *   straight corners          sides of the same direction are adjacent in a piece; the first is merged with the other
 *                             piece's side, the others are sides of their own
 *   a segment                 two sides, forward and back
 *   a point                   no sides; it translates the other piece
 *   two points                no sides at all: the loop does nothing, and the caller adds the one corner */
#ifndef SUNDER_I_MERGE_H
#define SUNDER_I_MERGE_H

#include <stdbool.h>
#include <stdint.h>

typedef struct sunder_i_merge {
    uint32_t left_a, left_b; /* the number of sides that are not taken yet */
    uint32_t next_a, next_b; /* the index of the first of these */
    uint32_t a, b;           /* the corners at which the current side starts */
    bool of_a, of_b;         /* whether a side of the first piece, of the second, is part of the current side */
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

/* Advances to the next side of the sum; false if there is none. */
#define SUNDER_I_MERGE_NEXT(m, order)                                                                                  \
    (((m)->left_a || (m)->left_b) && sunder_i_merge_take((m), (m)->left_a && (m)->left_b ? (order)                     \
                                                              : (m)->left_a              ? -1                          \
                                                                                         : 1))

#endif
