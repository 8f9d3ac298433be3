/* Polygonal sets, as the algorithms see them.
 *
 * A shape keeps its input as given (translations need it) and a cleaned form: outer rings counter-clockwise, holes
 * clockwise, so that the interior is on the left of every edge; no repeated vertices, no collinear ones, no spikes.
 * Each ring begins at its smallest vertex, holes and members ascend (canonical_rings.c; a reflected copy keeps the
 * order). Coordinates are doubles, taken exactly, but for those corners of a shape repaired by the even-odd rule that
 * are crossings of two edges as given: each of them has a denominator of its own.
 *
 * Rings may touch at points, themselves too, in one way only: each vertex stands for one sector of the interior, from
 * the edge that leaves it counter-clockwise to the edge that comes in, and sectors of one polygon at one place are
 * disjoint. So where touching cuts an interior in two there are two polygons; where a hole touches its outer ring they
 * are one ring. Where a vertex touches an edge from inside, the edge has a vertex of its own there (both are `shared`).
 * A vertex may touch an edge from outside.
 *
 * The convex pieces are a decomposition of each member without added vertices (triangulation, merged after Hertel and
 * Mehlhorn): counter-clockwise lists of vertex numbers, strictly convex. Interiors of pieces of one member are
 * disjoint, and the closure of their union is the member. Different members may overlap. */
#ifndef SUNDER_I_SHAPE_H
#define SUNDER_I_SHAPE_H

#include "number/lattice.h"
#include "sunder.h"

/* A corner that is no pair of doubles: (num[0], num[1]) / den * 2^exponent, den > 0 and odd. den.size == 0: it is
 * one. */
typedef struct sunder_i_exact {
    sunder_i_big num[2], den;
    long exponent;
} sunder_i_exact;

/* Numbers that few shapes need: those with a corner that is no pair of doubles, those with many corners, and those made
 * from pieces (of_pieces.c). */
typedef struct sunder_i_numbers {
    sunder_i_arena arena;   /* of the numbers of corners */
    sunder_i_exact *exact;  /* [vertices] of rational shapes */
    double area, anchor[2]; /* worked out when made, while failing was possible; the area of rational shapes
                             * (measure_rational.c) */
} sunder_i_numbers;

/* How the coordinates given make rings. */
typedef struct sunder_i_given {
    const size_t *ring_end, *poly_end;
    uint32_t polygons;
} sunder_i_given;

/* How the vertices of the cleaned form make rings, of the polygons one after the other. */
typedef struct sunder_i_cleaned {
    const uint32_t *ring_end;    /* [rings] index past the last vertex of each ring */
    const uint32_t *poly_end;    /* [polygons] index past the last ring of each; its first ring is the outer one */
    const uint32_t *next, *prev; /* [vertices] along the ring */
    const bool *shared;          /* [vertices] another vertex stands at the same place */
    uint32_t rings, polygons;
} sunder_i_cleaned;

/* What describes a shape's coordinates. */
typedef struct sunder_i_form {
    sunder_i_given given;
    sunder_i_cleaned cleaned;
    sunder_i_numbers *numbers; /* in the shape's own block; NULL: it has none */
} sunder_i_form;

/* The input as given, and the cleaned form. Layers have millions of shapes, most with one ring of few corners: what is
 * the same for all of these they share (few_corners.h), and a ring that was clean as it was given is kept once. */
struct sunder_shape {
    const sunder_i_form *form;
    const uint32_t *piece_end; /* [pieces] index past the last corner of each convex piece; behind them these corners */
    double *xy;                /* [2 * vertices] the coordinates of the cleaned form; of corners that are no doubles the
                                * nearest ones; may be raw_xy */
    double box[4];             /* rounded outward if rational */
    uint32_t vertices, pieces; /* of the cleaned form */
    int low_bit;               /* coordinates are multiples of 2^low_bit; if rational, those that were given */
    bool touches;              /* as given, rings of one polygon meet, a ring meets itself, or one was repaired */
    bool flat;                 /* made of convex pieces, with or without area (of_pieces.c) */
    bool repaired, rational;   /* rational: some corner is no pair of doubles */
    double raw_xy[];           /* as given */
};

/* The corners of all pieces, one piece after the other: numbers of vertices, counter-clockwise. */
static inline const uint32_t *sunder_i_piece_vertices(const sunder_shape *shape)
{
    return shape->piece_end + shape->pieces;
}

/* What a lattice has to hold for the shape; of a rational one the box, and the low bit of what was given. */
static inline sunder_i_extent sunder_i_shape_extent(const sunder_shape *s)
{
    return (sunder_i_extent){s->vertices > 0, {s->box[0], s->box[1]}, {s->box[2], s->box[3]}, s->low_bit};
}

/* Two shapes on one lattice; q reflected (-Q) if asked. */
typedef struct sunder_i_placed {
    sunder_i_lattice lattice;
    sunder_i_point *p, *q;           /* [vertices] of each */
    double origin_p[2], origin_q[2]; /* of q after reflection */
} sunder_i_placed;

typedef struct sunder_i_place_options {
    bool reflect_q;
    bool common_origin;  /* one origin for both (then origin_q = origin_p, or its negative if reflected) */
    const double *extra; /* further doubles that must be lattice multiples (a gap), n of them; magnitudes count too */
    size_t extra_n;
    const double *shift_p, *shift_q; /* NULL, or an exact translation of the operand (before reflection): two doubles */
    bool force_wide;                 /* for tests */
} sunder_i_place_options;

/* Fails only with SUNDER_ENOMEM. */
sunder_status sunder_i_place(const sunder_shape *p, const sunder_shape *q, const sunder_i_place_options *options,
                             sunder_i_placed *result, sunder_error *err);
void sunder_i_placed_free(sunder_i_placed *placed);
/* A corner that is no pair of doubles, moved by shift (if not NULL) and taken from an origin. The lattice admits
 * ratios. */
sunder_i_point sunder_i_place_exact(sunder_i_lattice *lattice, const sunder_i_exact *corner, const double *shift,
                                    const double origin[2]);

/* The edges of the shape are (v, next[v]), each a side of exactly one piece. A side (u, v) of a piece is one of them
 * exactly when next[u] == v; else it is a diagonal, and (v, u) is a side of another piece. */
static inline bool sunder_i_is_boundary(const sunder_shape *shape, uint32_t u, uint32_t v)
{
    return shape->form->cleaned.next[u] == v;
}

/* How many vertices the rings have as they were given. */
static inline size_t sunder_i_shape_raw_vertices(const sunder_shape *s)
{
    const size_t rings = s->form->given.polygons ? s->form->given.poly_end[s->form->given.polygons - 1] : 0;
    return rings ? s->form->given.ring_end[rings - 1] : 0;
}

/* Area and anchor of a rational shape that is complete but for them. False if memory is out. */
bool sunder_i_shape_measure_pieces(sunder_shape *shape);

/* Up to this many corners an anchor is computed on the stack on demand; with more it is stored. */
#define SUNDER_I_ANCHOR_CORNERS 64
/* The anchor to be kept, of a shape with numbers of its own whose corners are doubles. False if memory is out. */
bool sunder_i_shape_measure_anchor(sunder_shape *shape);

/* Checks every invariant above (exactly, slowly); for tests and debug builds. NULL if all hold, else a sentence; NULL
 * too where memory runs out, since nothing is known then. */
const char *sunder_i_shape_check(const sunder_shape *shape);

#endif
