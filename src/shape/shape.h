/* shape.h: polygonal sets in the form that the algorithms use.
 *
 * A shape keeps its input as given (translations need it) and a cleaned form: outer rings counterclockwise, holes
 * clockwise, so that the interior is on the left of every edge; no repeated vertices, no collinear ones, no spikes.
 * Each ring begins at its smallest vertex, and holes and polygons are sorted (canonical_rings.c; a reflected copy keeps
 * the order). Coordinates are doubles, taken exactly, except vertices of a shape repaired by the even-odd rule that are
 * crossings of two given edges: each of these has its own denominator.
 *
 * Rings may touch each other and themselves at points, in one way only: each vertex represents one sector of the
 * interior, from the edge that leaves it counterclockwise to the edge that arrives, and sectors of one polygon at one
 * position are disjoint. So if a contact divides the interior, there are two polygons; if a hole touches its outer ring
 * they are one ring. If a vertex touches an edge from inside, the edge has a vertex of its own there (both are
 * `shared`). A vertex may touch an edge from outside.
 *
 * The convex pieces are a decomposition of each polygon without added vertices (triangulation, merged after Hertel and
 * Mehlhorn): counterclockwise lists of vertex numbers, strictly convex. Interiors of pieces of one polygon are
 * disjoint, and the closure of their union is the polygon. Different polygons may overlap. */
#ifndef SUNDER_I_SHAPE_H
#define SUNDER_I_SHAPE_H

#include "number/lattice.h"
#include "sunder_shape.h"

/* A vertex that is not a pair of doubles: (num[0], num[1]) / den * 2^exponent, den > 0 and odd. den.size == 0: the
 * vertex is a pair of doubles. */
typedef struct sunder_i_exact {
    sunder_i_big num[2], den;
    long exponent;
} sunder_i_exact;

/* Numbers that few shapes need: those with a vertex that is not a pair of doubles, those with many vertices, and those
 * made from pieces (of_pieces.c). */
typedef struct sunder_i_numbers {
    sunder_i_arena arena;   /* contains the numbers of vertices */
    sunder_i_exact *exact;  /* [vertices] of rational shapes */
    double area, anchor[2]; /* computed when the shape is made, when failing is possible; `area` for rational shapes
                             * only (measure_rational.c) */
} sunder_i_numbers;

/* The structure of the given coordinates: rings and polygons. */
typedef struct sunder_i_given {
    const size_t *ring_end, *poly_end;
    uint32_t polygons;
} sunder_i_given;

/* The structure of the cleaned form: rings and polygons, one after the other. */
typedef struct sunder_i_cleaned {
    const uint32_t *ring_end;    /* [rings] the end of the vertices of each ring */
    const uint32_t *poly_end;    /* [polygons] the end of the rings of each polygon; its first ring is the outer one */
    const uint32_t *next, *prev; /* [vertices] the next and the previous vertex of the ring */
    const bool *shared;          /* [vertices] whether another vertex has the same position */
    uint32_t rings, polygons;
} sunder_i_cleaned;

/* The structure of a shape's coordinates. */
typedef struct sunder_i_form {
    sunder_i_given given;
    sunder_i_cleaned cleaned;
    sunder_i_numbers *numbers; /* in the shape's block of memory; NULL: not needed */
} sunder_i_form;

/* The input as given, and the cleaned form. Layers have millions of shapes, most of them with one ring of few vertices:
 * these share the form (few_corners.h), and a ring that was clean as given is stored once. */
struct sunder_shape {
    const sunder_i_form *form;
    const uint32_t *piece_end; /* [pieces] the end of the vertices of each convex piece; these vertices follow */
    double *xy;                /* [2 * vertices] the coordinates of the cleaned form; for vertices that are not doubles
                                * the nearest ones; may be raw_xy */
    double box[4];             /* rounded outward if rational */
    uint32_t vertices, pieces; /* of the cleaned form */
    int low_bit;               /* coordinates are multiples of 2^low_bit; if rational, the given ones are */
    bool touches;              /* in the input, rings of one polygon meet, a ring meets itself, or one was repaired */
    bool flat;                 /* made of convex pieces, with or without area (of_pieces.c) */
    bool repaired, rational;   /* rational: some vertex is not a pair of doubles */
    double raw_xy[];           /* the coordinates as given */
};

/* Returns the vertices of all pieces, one piece after the other, counterclockwise. */
static inline const uint32_t *sunder_i_piece_vertices(const sunder_shape *shape)
{
    return shape->piece_end + shape->pieces;
}

/* Returns the extent that a lattice must contain for the shape; for a rational one the box, and the lowest bit of the
 * given coordinates. */
static inline sunder_i_extent sunder_i_shape_extent(const sunder_shape *s)
{
    return (sunder_i_extent){s->vertices > 0, {s->box[0], s->box[1]}, {s->box[2], s->box[3]}, s->low_bit};
}

/* Two shapes on one lattice; q is reflected (-Q) if requested. */
typedef struct sunder_i_placed {
    sunder_i_lattice lattice;
    sunder_i_point *p, *q;           /* [vertices] of each */
    double origin_p[2], origin_q[2]; /* of q after reflection */
} sunder_i_placed;

typedef struct sunder_i_place_options {
    bool reflect_q;
    bool common_origin;  /* one origin for both shapes (then origin_q = origin_p, or its negative if reflected) */
    const double *extra; /* [extra_n] further doubles that must be multiples of the lattice's unit (a gap); their
                          * magnitudes count, too */
    size_t extra_n;
    const double *shift_p, *shift_q; /* NULL, or two doubles: an exact translation of the shape (before reflection) */
    bool force_wide;                 /* for tests */
} sunder_i_place_options;

/* Fails only with SUNDER_ENOMEM. */
sunder_status sunder_i_place(const sunder_shape *p, const sunder_shape *q, const sunder_i_place_options *options,
                             sunder_i_placed *result, sunder_error *err);
void sunder_i_placed_free(sunder_i_placed *placed);
/* Returns a vertex that is not a pair of doubles, translated by `shift` (unless NULL), relative to `origin`. The
 * lattice must admit ratios. */
sunder_i_point sunder_i_place_exact(sunder_i_lattice *lattice, const sunder_i_exact *corner, const double *shift,
                                    const double origin[2]);

/* Returns whether a side (u, v) of a piece is an edge of the shape. The edges are (v, next[v]), each a side of exactly
 * one piece. Any other side (u, v) is a diagonal, and (v, u) is a side of another piece. */
static inline bool sunder_i_is_boundary(const sunder_shape *shape, uint32_t u, uint32_t v)
{
    return shape->form->cleaned.next[u] == v;
}

/* Returns the number of vertices of the given rings. */
static inline size_t sunder_i_shape_raw_vertices(const sunder_shape *s)
{
    const size_t rings = s->form->given.polygons ? s->form->given.poly_end[s->form->given.polygons - 1] : 0;
    return rings ? s->form->given.ring_end[rings - 1] : 0;
}

/* Computes area and anchor of a rational shape that is otherwise complete. Returns false if out of memory. */
bool sunder_i_shape_measure_pieces(sunder_shape *shape);

/* Up to this number of vertices the anchor is computed on demand, on the stack; with more it is stored. */
#define SUNDER_I_ANCHOR_CORNERS 64
/* Computes and stores the anchor of a shape with numbers of its own whose vertices are doubles. Returns false if out of
 * memory. */
bool sunder_i_shape_measure_anchor(sunder_shape *shape);

/* Checks every invariant above (exactly and slowly), for tests and debug builds. Returns NULL if all hold, else a
 * sentence; NULL also if out of memory, since the result is then unknown. */
const char *sunder_i_shape_check(const sunder_shape *shape);

#endif
