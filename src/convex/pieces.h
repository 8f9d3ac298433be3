/* Lists of convex pieces, points and segments among them: of shapes, of obstacles, and of sums of these. outline/
 * unites them.
 *
 * A piece is a counter-clockwise list of corners: three or more, convex, straight ones allowed; two for a segment (its
 * two sides run there and back); one, without a side, for a point. int(s + B) of a segment or a point s is open and
 * convex all the same, and a list may be a union by itself.
 *
 * Once ranked (directions.h), each piece starts with a side of the least rank, and ranks do not fall: so a sum is a
 * merge of two lists (merge.h).
 *
 * A side is a *candidate* where it can carry boundary of the union: of a shape's pieces the edges, not the
 * diagonals. */
#ifndef SUNDER_I_CONVEX_PIECES_H
#define SUNDER_I_CONVEX_PIECES_H

#include "convex/directions.h"
#include "shape/shape.h"

typedef struct sunder_i_convex_pieces {
    uint32_t n, corners;
    uint32_t *end;             /* [n] past the last corner of each */
    sunder_i_point *corner;    /* [corners] */
    uint32_t *rank;            /* [corners] of the side that starts there; unused for points */
    bool *candidate;           /* [corners] likewise */
    uint32_t *vertex;          /* [corners] the shape's vertex at each corner; NULL: not kept */
    sunder_i_lattice *lattice; /* these three are borrowed, and set by ranking and by summing */
    uint32_t classes;
    const sunder_i_point *direction; /* [classes] */
} sunder_i_convex_pieces;

/* Reserves room for n pieces and `corners` corners; false if memory is out. */
bool sunder_i_convex_pieces_init(sunder_i_convex_pieces *list, size_t n, size_t corners);
void sunder_i_convex_pieces_free(sunder_i_convex_pieces *list);

/* Removes these pieces, and returns spare memory, not all of it. The others keep their order. */
void sunder_i_convex_pieces_remove(sunder_i_convex_pieces *list, const bool *gone);

/* Piece i has the corners from this index on, up to end[i]. */
static inline uint32_t sunder_i_convex_pieces_first(const sunder_i_convex_pieces *list, size_t i)
{
    return i ? list->end[i - 1] : 0;
}

/* Appends a corner to the piece that is being added; the caller sets the piece's end. */
static inline void sunder_i_convex_pieces_add_corner(sunder_i_convex_pieces *list, sunder_i_point at, bool candidate)
{
    list->corner[list->corners] = at;
    list->candidate[list->corners++] = candidate;
}

/* Appends the convex pieces of a shape whose vertices stand at these places (perhaps turned by half a turn). The caller
 * has reserved the room. */
void sunder_i_convex_pieces_add_shape(sunder_i_convex_pieces *list, const sunder_shape *shape,
                                      const sunder_i_point *at);

/* Ranks the directions of all sides of `lists` lists and turns each piece so that its ranks rise from the first side.
 * The directions have to live as long as the lists. False if memory is out. */
bool sunder_i_convex_pieces_rank(sunder_i_lattice *lattice, sunder_i_convex_pieces *const *list, size_t lists,
                                 sunder_i_directions *out);

/* An empty list with room for all sums of a piece of a with a piece of b, ranked as these are. False if memory
 * is out. */
bool sunder_i_convex_pieces_init_sum(const sunder_i_convex_pieces *a, const sunder_i_convex_pieces *b,
                                     sunder_i_convex_pieces *out);
/* All those sums, a's pieces in the outer loop. False if memory is out. */
bool sunder_i_convex_pieces_sum(const sunder_i_convex_pieces *a, const sunder_i_convex_pieces *b,
                                sunder_i_convex_pieces *out);

/* What is wrong with a ranked list, or NULL. */
const char *sunder_i_convex_pieces_check(const sunder_i_convex_pieces *list);

#endif
