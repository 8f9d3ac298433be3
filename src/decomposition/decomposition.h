/* Exact convex decompositions of polygonal sets with holes.
 *
 * Each member of a shape is cut into convex pieces by itself (members may overlap): interiors of its pieces are
 * disjoint, and the closure of their union is the member. README.md tells the six ways and what each costs.
 *
 * Every side of every piece lies on a line through two lattice points: an edge of the shape, a diagonal between two
 * of its vertices, or a cut from a vertex in a lattice direction. So a Steiner point is the crossing of two such
 * lines, never of lines through other Steiner points: its numbers do not grow with the number of cuts, and no
 * decision here takes a Steiner point as an operand of anything but the order along one line. A side carries its
 * lattice vector (`along`) besides its corners, so that directions and supporting lines need no Steiner coordinates
 * either. */
#ifndef SUNDER_I_DECOMPOSITION_H
#define SUNDER_I_DECOMPOSITION_H

#include "predicate/rational_point.h"
#include "shape/shape.h"

/* Vertices of a member that OPTIMAL and MIXED solve, in time of order r n n; others fall back on Hertel
 * and Mehlhorn. */
#define SUNDER_I_OPTIMAL_MOST 500

/* A point on the lattice that the shape was placed on, in lowest terms (w is 1 for vertices of the shape that are no
 * crossings, and for points that happen to be lattice points). */
typedef struct sunder_i_corner {
    sunder_i_rational_point at;
    uint32_t vertex; /* of the shape; UINT32_MAX: a Steiner point */
} sunder_i_corner;

typedef struct sunder_i_decomposition {
    sunder_i_arena arena;      /* all that follows, the big integers too; independent of the lattice's arena */
    sunder_decomposition used; /* as asked, or HERTEL_MEHLHORN where some member could not be decomposed so */
    uint32_t fallbacks;        /* members with reflex vertices that were decomposed by Hertel-Mehlhorn instead */
    uint32_t corners;
    sunder_i_corner *corner; /* [corners] first the vertices of the shape by number, then the Steiner points, each
                                place on one line once */
    uint32_t pieces;
    uint32_t *piece_end;    /* [pieces] index past the last side of each */
    uint32_t *piece_corner; /* [sides] the corner where each side starts. Pieces are counter-clockwise and strictly
                               convex, and start with the side of the least angle in [0, 2 pi), so that angles ascend */
    sunder_i_point *along;  /* [sides] a vector of the lattice, a positive multiple of the side */
    uint32_t *member;       /* [pieces] the polygon of the shape that each is a piece of; ascending */
    sunder_counts counts;   /* done here; they are in lattice->counts as well */
} sunder_i_decomposition;

/* Decomposes a shape that stands on a lattice.
 *
 * at      its vertices on the lattice (placed.p, or placed.q, reflected or not). The lattice must live as long as
 *         `along` is used.
 * kind    AUTO is taken for ANGLE_BISECTOR, and MIXED for OPTIMAL.
 * out     on success cleared with sunder_i_decomposition_clear(); untouched on failure. The empty shape has no
 *         pieces.
 * Fails   SUNDER_ENOMEM
 * Cost    HERTEL_MEHLHORN linear, TRIANGULATION that of ears (near n log n on maps); VERTICAL n log n and the
 *         triangles crossed by the cuts; ANGLE_BISECTOR the vertices visible from reflex ones and r^2; OPTIMAL
 *         O(r n^2) at worst. */
sunder_status sunder_i_decompose(sunder_i_lattice *lattice, const sunder_shape *shape, const sunder_i_point *at,
                                 sunder_decomposition kind, sunder_i_decomposition *out, sunder_error *err);

/* Both operands of a sum, on one lattice. For MIXED they are decomposed together, else each by itself. */
sunder_status sunder_i_decompose_pair(sunder_i_lattice *lattice, const sunder_shape *p, const sunder_i_point *at_p,
                                      const sunder_shape *q, const sunder_i_point *at_q, sunder_decomposition kind,
                                      sunder_i_decomposition *out_p, sunder_i_decomposition *out_q, sunder_error *err);

void sunder_i_decomposition_clear(sunder_i_decomposition *decomposition);

/* Piece i has the sides from this index on, up to piece_end[i]. */
static inline uint32_t sunder_i_piece_first(const sunder_i_decomposition *d, uint32_t piece)
{
    return piece ? d->piece_end[piece - 1] : 0;
}

/* Checks, exactly and slowly, that pieces are counter-clockwise, strictly convex and said as above, that `along`
 * agrees with the corners, and that the areas of the pieces of each member add up to the member's. NULL if all
 * holds, or memory is out; else a sentence. */
const char *sunder_i_decomposition_check(sunder_i_lattice *lattice, const sunder_shape *shape, const sunder_i_point *at,
                                         const sunder_i_decomposition *decomposition);

#endif
