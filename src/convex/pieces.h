/* pieces.h: lists of convex pieces, which may include points and segments: of shapes, of obstacles, and of sums of
 * these. outline/ computes their union.
 *
 * A piece is a counterclockwise list of corners: three or more, convex, with straight corners allowed; two for a
 * segment (its two sides go forward and back); one, without a side, for a point. int(s + B) of a segment or a point s
 * is open and convex, too, and a list may represent a union.
 *
 * In a ranked list (directions.h) each piece starts with a side of the least rank, and ranks do not descend: so a sum
 * is a merge of two lists (merge.h).
 *
 * A side is a *candidate* if it can contain boundary of the union: in the pieces of a shape the edges are candidates,
 * not the diagonals. */
#ifndef SUNDER_I_CONVEX_PIECES_H
#define SUNDER_I_CONVEX_PIECES_H

#include "convex/directions.h"
#include "shape/shape.h"

typedef struct sunder_i_convex_pieces {
    uint32_t n, corners;
    uint32_t *end;             /* [n] the index after the last corner of each piece */
    sunder_i_point *corner;    /* [corners] */
    uint32_t *rank;            /* [corners] the rank of the side that starts at the corner; unused for points */
    bool *candidate;           /* [corners] whether that side is a candidate */
    uint32_t *vertex;          /* [corners] the shape's vertex at each corner; NULL: not stored */
    sunder_i_lattice *lattice; /* lattice, classes and direction are borrowed; ranking and summing set them */
    uint32_t classes;
    const sunder_i_point *direction; /* [classes] a vector of each class */
} sunder_i_convex_pieces;

/* Makes an empty list with memory for n pieces and `corners` corners. Returns false if out of memory. */
bool sunder_i_convex_pieces_init(sunder_i_convex_pieces *list, size_t n, size_t corners);
void sunder_i_convex_pieces_free(sunder_i_convex_pieces *list);

/* Removes the pieces i with gone[i]. The others keep their order. Most of the memory that becomes unused is freed. */
void sunder_i_convex_pieces_remove(sunder_i_convex_pieces *list, const bool *gone);

/* Returns the index of the first corner of piece i; its last corner is end[i] - 1. */
static inline uint32_t sunder_i_convex_pieces_first(const sunder_i_convex_pieces *list, size_t i)
{
    return i ? list->end[i - 1] : 0;
}

/* Appends a corner to the piece that is being added; the caller sets the piece's `end`. */
static inline void sunder_i_convex_pieces_add_corner(sunder_i_convex_pieces *list, sunder_i_point at, bool candidate)
{
    list->corner[list->corners] = at;
    list->candidate[list->corners++] = candidate;
}

/* Appends the convex pieces of a shape. at[v]: the point of vertex v (the shape may be rotated by half a turn). The
 * list must have room for them. */
void sunder_i_convex_pieces_add_shape(sunder_i_convex_pieces *list, const sunder_shape *shape,
                                      const sunder_i_point *at);

/* Ranks the directions of all sides of `lists` lists, and rotates each piece so that its ranks ascend from the first
 * side. *out owns the directions and must outlive the lists. Returns false if out of memory. */
bool sunder_i_convex_pieces_rank(sunder_i_lattice *lattice, sunder_i_convex_pieces *const *list, size_t lists,
                                 sunder_i_directions *out);

/* *out becomes an empty list with room for all sums of a piece of a and a piece of b, with the ranks of these. Returns
 * false if out of memory. */
bool sunder_i_convex_pieces_init_sum(const sunder_i_convex_pieces *a, const sunder_i_convex_pieces *b,
                                     sunder_i_convex_pieces *out);
/* *out becomes the list of all sums of a piece of a and a piece of b, with a's pieces in the outer loop. Returns false
 * if out of memory. */
bool sunder_i_convex_pieces_sum(const sunder_i_convex_pieces *a, const sunder_i_convex_pieces *b,
                                sunder_i_convex_pieces *out);

/* Returns a message about the first violated invariant of a ranked list, or NULL if there is none. */
const char *sunder_i_convex_pieces_check(const sunder_i_convex_pieces *list);

#endif
