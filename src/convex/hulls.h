/* Lists of convex pieces, points and segments among them, and their sums.
 *
 * A piece is a counter-clockwise list of corners: three or more, strictly convex; two for a segment (its two sides run
 * there and back); one, without a side, for a point. sunder_i_subsums_build() knows polygons only; here
 * int(s + B) of a segment or a point s is open and convex all the same, and a list may be a union by itself. Sides have
 * the ranks of directions that minkowski/subsums.h describes; the first side of a piece has the least rank, so that a
 * sum is a merge of two lists.
 *
 * `edge` tells the sides that lie on the boundary of the operand from diagonals of its decomposition: the boundary of
 * a sum lies on sides of which one part is an edge. */
#ifndef SUNDER_I_HULLS_H
#define SUNDER_I_HULLS_H

#include "convex/subsums.h"

typedef struct sunder_i_hulls {
    uint32_t n, corners;
    uint32_t *end;          /* [n] past the last corner of each */
    sunder_i_point *corner; /* [corners] */
    uint32_t *rank;         /* [corners] of the side that starts there; unused for points */
    bool *edge;             /* [corners] likewise */
} sunder_i_hulls;

/* Room for so many; false if memory is out. */
bool sunder_i_hulls_init(sunder_i_hulls *list, size_t n, size_t corners);
void sunder_i_hulls_free(sunder_i_hulls *list);

static inline uint32_t sunder_i_hulls_first(const sunder_i_hulls *list, uint32_t piece)
{
    return piece ? list->end[piece - 1] : 0;
}

/* The next corner of the piece that is being added; its end is set by whoever adds it. */
static inline void sunder_i_hulls_add_corner(sunder_i_hulls *list, sunder_i_point at, bool edge)
{
    list->corner[list->corners] = at;
    list->edge[list->corners++] = edge;
}

/* The convex pieces of a shape, whose vertices stand at these places (turned by half a turn, perhaps). There is room.
 */
void sunder_i_hulls_add_shape(sunder_i_hulls *list, const sunder_shape *shape, const sunder_i_point *at);

/* Ranks the directions of all sides of `lists` lists and turns each piece so that its ranks rise from the first side.
 * *direction: a vector of each class, to be freed. False if memory is out. */
bool sunder_i_hulls_rank(sunder_i_lattice *lattice, sunder_i_hulls *const *list, size_t lists,
                         sunder_i_point **direction, uint32_t *classes);

/* All sums of a piece of a with a piece of b, a's pieces in the outer loop; ranked lists. False if memory is out. */
bool sunder_i_hulls_sum(sunder_i_lattice *lattice, const sunder_i_hulls *a, const sunder_i_hulls *b,
                        sunder_i_hulls *out);

/* The list as parts of a union. Borrowed, all of it. */
static inline sunder_i_subsums sunder_i_hulls_parts(const sunder_i_hulls *list, sunder_i_lattice *lattice,
                                                    sunder_i_point *direction, uint32_t classes)
{
    return (sunder_i_subsums){lattice,   classes,      direction,  list->n,   list->corners,
                              list->end, list->corner, list->rank, list->edge};
}

#endif
