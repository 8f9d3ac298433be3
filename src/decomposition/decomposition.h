/* decomposition.h: exact convex decompositions of polygonal sets with holes.
 *
 * Each polygon of a shape is divided into convex pieces separately (polygons may overlap): the interiors of its pieces
 * are disjoint, and the closure of their union is the polygon. README.md describes the six methods and their costs.
 *
 * Every side of every piece is on a line through two lattice points: an edge of the shape, a diagonal between two of
 * its vertices, or a cut from a vertex in a lattice direction. So a Steiner point is the intersection of two such
 * lines, never of lines through other Steiner points: its numbers do not become longer with the number of cuts, and
 * Steiner points are operands of no decision except of the order along one line. A side has its lattice vector
 * (`along`) besides its corners, so that directions and supporting lines need no Steiner coordinates either. */
#ifndef SUNDER_I_DECOMPOSITION_H
#define SUNDER_I_DECOMPOSITION_H

#include "predicate/rational_point.h"
#include "shape/shape.h"
#include "sunder_sum.h"

/* The largest number of vertices of a polygon for which OPTIMAL and MIXED are computed, in time of order r n n; larger
 * ones are decomposed by Hertel and Mehlhorn's method. */
#define SUNDER_I_OPTIMAL_MOST 500

/* A point on the lattice of the shape, in lowest terms (w is 1 for vertices of the shape that are no crossings, and for
 * other points that are lattice points). */
typedef struct sunder_i_corner {
    sunder_i_rational_point at;
    uint32_t vertex; /* the vertex of the shape; UINT32_MAX: a Steiner point */
} sunder_i_corner;

typedef struct sunder_i_decomposition {
    sunder_i_arena arena;      /* the memory of all arrays below, including big integers; independent of the lattice's
                                * arena */
    sunder_decomposition used; /* the requested method, or HERTEL_MEHLHORN if some polygon could not be decomposed with
                                * that method */
    uint32_t fallbacks;        /* the number of polygons with reflex vertices that were decomposed by Hertel and
                                * Mehlhorn's method instead */
    uint32_t corners;
    sunder_i_corner *corner; /* [corners] first the vertices of the shape by number, then the Steiner points; each point
                              * on a line once */
    uint32_t pieces;
    uint32_t *piece_end;    /* [pieces] the index after the last side of each */
    uint32_t *piece_corner; /* [sides] the corner at which each side starts. Pieces are counterclockwise and strictly
                             * convex, and start with the side of the least angle in [0, 2 pi), so that angles ascend */
    sunder_i_point *along;  /* [sides] a lattice vector of which the side is a positive multiple */
    uint32_t *member;       /* [pieces] the polygon of the shape to which each piece belongs; ascending */
    sunder_counts counts;   /* the operations of this decomposition; they are included in lattice->counts, too */
} sunder_i_decomposition;

/* Decomposes a shape on a lattice.
 *
 *   at      the shape's vertices on the lattice (placed.p, or placed.q, reflected or not). The lattice must exist as
 *           long as `along` is used.
 *   kind    AUTO means ANGLE_BISECTOR here, and MIXED means OPTIMAL.
 *   out     on success the caller frees it with sunder_i_decomposition_clear(); unchanged on failure. The empty shape
 *           has no pieces.
 *
 * Fails with SUNDER_ENOMEM. Time: HERTEL_MEHLHORN linear, TRIANGULATION that of ears (near n log n on maps); VERTICAL n
 * log n and the triangles crossed by the cuts; ANGLE_BISECTOR the vertices visible from reflex ones and r^2; OPTIMAL at
 * most O(r n^2). */
sunder_status sunder_i_decompose(sunder_i_lattice *lattice, const sunder_shape *shape, const sunder_i_point *at,
                                 sunder_decomposition kind, sunder_i_decomposition *out, sunder_error *err);

/* Decomposes both operands of a sum, on one lattice. With MIXED they are decomposed together, else separately. Fails
 * with SUNDER_ENOMEM. */
sunder_status sunder_i_decompose_pair(sunder_i_lattice *lattice, const sunder_shape *p, const sunder_i_point *at_p,
                                      const sunder_shape *q, const sunder_i_point *at_q, sunder_decomposition kind,
                                      sunder_i_decomposition *out_p, sunder_i_decomposition *out_q, sunder_error *err);

void sunder_i_decomposition_clear(sunder_i_decomposition *decomposition);

/* Returns the index of the first side of a piece; its last side is piece_end[piece] - 1. */
static inline uint32_t sunder_i_piece_first(const sunder_i_decomposition *d, uint32_t piece)
{
    return piece ? d->piece_end[piece - 1] : 0;
}

/* Tests, exactly and slowly, that pieces are counterclockwise, strictly convex and in the form described above, that
 * `along` agrees with the corners, and that the areas of the pieces of each polygon add up to that of the polygon.
 * Returns NULL if all conditions hold, or if out of memory; else a message. */
const char *sunder_i_decomposition_check(sunder_i_lattice *lattice, const sunder_shape *shape, const sunder_i_point *at,
                                         const sunder_i_decomposition *decomposition);

#endif
