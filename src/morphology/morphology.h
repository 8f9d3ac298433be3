/* morphology.h: dilating and eroding polygonal sets: declarations shared by the files of this folder.
 *
 *   figure.c                a shape or a sum as rings, segments and points with rational vertices
 *   dilate_erode.c          one exact sum of such a figure, or its complement, and a shape: bands, then the cells
 *                           between them
 *   erode_outline.c         an erosion without a map, if all vertices are integers
 *   figure_convolution.c    a sum of a figure and a convex shape without bands, if the convolution proves it
 *   morphology_operands.c   the lattice, and B as a structuring element, for all stages of one operation
 *   bands.c                 a side plus a convex piece
 *   convex_fit.c            whether a convex shape fits into the intersection of two shapes
 *   islands.c               polygon by polygon, on several threads
 *   member_union.c          polygons that overlap
 *   morphology.c            dilation, erosion, opening, closing */
#ifndef SUNDER_I_MORPHOLOGY_H
#define SUNDER_I_MORPHOLOGY_H

#include "planar_map/planar_map.h"
#include "shape/shape.h"
#include "sum/sum_value.h"
#include "sunder_sum.h"

/* A closed set in units of a lattice: the polygons that its rings bound, with the interior on their left, and segments
 * and points without area. All arrays are in the arena. */
typedef struct sunder_i_figure {
    sunder_i_arena arena;
    sunder_i_rational_point *at; /* the vertices, by number */
    uint32_t *ring;              /* the vertex numbers of all rings, one ring after the other */
    size_t *ring_end;            /* [rings] */
    size_t rings, sides;
    const uint32_t *segment; /* [2 * segments] */
    const uint32_t *point;   /* [points] */
    size_t segments, points;
    bool touches; /* two vertices of the rings have one position */
} sunder_i_figure;

/* Converts all polygons of a shape, which are disjoint and whose vertices have the positions at[] on the lattice.
 * Returns false if out of memory. */
bool sunder_i_figure_of_shape(sunder_i_lattice *lattice, const sunder_shape *shape, const sunder_i_point *at,
                              sunder_i_figure *out);
/* Converts the polygons first to last - 1 of a sum and, unless `regular`, all its degenerate parts. Threads may share
 * the sum. Returns false if out of memory. */
bool sunder_i_figure_of_sum(const sunder_sum *sum, size_t first, size_t last, bool regular, sunder_i_figure *out);
void sunder_i_figure_free(sunder_i_figure *figure);

/* A structuring element [Ser82], the convex operand of dilations and erosions: convex pieces, counterclockwise, and a
 * point inside each. */
typedef struct sunder_i_structuring_element {
    sunder_i_arena arena;
    uint32_t pieces;
    size_t *end; /* [pieces] the end of the vertices of each piece */
    sunder_i_rational_point *corner;
    sunder_i_rational_point *side; /* the vector from each vertex to the next one of its piece */
    sunder_i_point *along;         /* the directions of the sides as plain vectors in lowest terms, if `plain` */
    bool plain;
    sunder_i_rational_point *inner; /* [pieces] a point inside each piece */
} sunder_i_structuring_element;

/* Converts the pieces of a shape, or of its reflection. Returns false if out of memory. */
bool sunder_i_structuring_element_of_shape(sunder_i_lattice *lattice, const sunder_shape *shape,
                                           const sunder_i_point *at, bool reflected, sunder_i_structuring_element *out);
void sunder_i_structuring_element_free(sunder_i_structuring_element *element);

/* Sets *out to the plain vector in lowest terms of which u is a positive multiple. Returns false if there is none, or
 * if the arena has failed. */
bool sunder_i_heading(sunder_i_arena *arena, sunder_i_rational_point u, sunder_i_point *out);
/* Computes the sum of the segment from a to b and the vertices first to end - 1 of an element, which are one of its
 * pieces: writes its vertices, counterclockwise, to out, which has room for two more than the piece has, and returns
 * their number. *known becomes whether along[] contains each side's direction, or its reverse, as a plain vector for
 * the map. All results are undefined if the arena has failed. */
size_t sunder_i_band(sunder_i_arena *arena, const sunder_i_structuring_element *element, size_t first, size_t end,
                     sunder_i_rational_point a, sunder_i_rational_point b, sunder_i_rational_point *out,
                     sunder_i_point *along, bool *known);

/* Set the outline of an empty sum, which owns the lattice of all operands:
 *   dilate  the closure of F + element, without degenerate parts (that set is closed, and they are inside)
 *   erode   the complement of F^c + int element, with parts without area: the erosion of F, which is regular, by
 *           -element
 * Fail with SUNDER_ENOMEM or SUNDER_ECANCEL; the caller frees the sum. */
sunder_status sunder_i_dilate_figure(const sunder_i_figure *figure, const sunder_i_structuring_element *element,
                                     const sunder_sum_options *options, sunder_sum *sum, sunder_error *err);
sunder_status sunder_i_erode_figure(const sunder_i_figure *figure, const sunder_i_structuring_element *element,
                                    const sunder_sum_options *options, sunder_sum *sum, sunder_error *err);

/* erode_outline.c: does the same as sunder_i_erode_figure() and sets *done, if all vertices are integers, the element
 * is convex, and the figure has rings only, no two vertices of which have one position. */
sunder_status sunder_i_erode_by_outline(const sunder_i_figure *figure, const sunder_i_structuring_element *element,
                                        const sunder_sum_options *options, sunder_sum *sum, bool *done,
                                        sunder_error *err);

/* figure_convolution.c: does the same as sunder_i_dilate_figure() or, with `erode`, sunder_i_erode_figure(), and sets
 * *done; the sum is unchanged if the curve does not prove it. Fails with SUNDER_ENOMEM or SUNDER_ECANCEL. */
sunder_status sunder_i_sum_by_convolution(const sunder_i_figure *figure, const sunder_i_structuring_element *element,
                                          bool erode, sunder_sum *sum, bool *done, sunder_error *err);

/* ---- morphology_operands.c: P and B on one lattice ---- */

/* P and B with the units and origins of sunder_minkowski_sum(); the lattice is never narrow, since vertices of later
 * stages have denominators. */
typedef struct sunder_i_morphology_operands {
    sunder_i_lattice lattice; /* empty, to be copied */
    double origin_p[2], origin_q[2];
    sunder_i_structuring_element element, reflected; /* B and -B */
    sunder_i_figure figure;                          /* P, if it has only one polygon; else empty */
} sunder_i_morphology_operands;

sunder_status sunder_i_morphology_operands_make(const sunder_shape *p, const sunder_shape *b,
                                                sunder_i_morphology_operands *out, sunder_error *err);
void sunder_i_morphology_operands_free(sunder_i_morphology_operands *operands);
/* Returns an empty sum on an empty lattice like operands->lattice, with the origin of P plus `moved` times that of B.
 * NULL if out of memory. */
sunder_sum *sunder_i_morphology_operands_sum(const sunder_i_morphology_operands *operands, int moved);

/* ---- islands.c ---- */

/* Performs the last stages: the erosion of a set (open: then dilated by B, with its parts without area; close: the set
 * is P + B), as the union of the erosions of its polygons if B's interior is connected. whole: the set, on a lattice
 * with these units, its degenerate parts filled; NULL: the operands' figure. */
sunder_status sunder_i_islands(const sunder_i_morphology_operands *operands, const sunder_sum *whole, bool connected,
                               sunder_operation operation, const sunder_sum_options *options, sunder_sum **out,
                               sunder_error *err);

/* ---- member_union.c ---- */

/* Computes the union of the polygons of a shape; if b is given they are placed together, so that units and origins
 * agree with those of their sums. Fails with SUNDER_ENOMEM or SUNDER_ECANCEL. */
sunder_status sunder_i_union_of_members(const sunder_shape *shape, const sunder_shape *b,
                                        const sunder_sum_options *options, sunder_sum **out, sunder_error *err);
/* Computes the union of the polygons of a shape, as sunder_i_union_of_members() does, and returns it as a shape whose
 * polygons have disjoint interiors and share no wall. A wall that two polygons
 * share is inside the set, yet their open pieces do not contain it, so that a segment or a point, which has no area,
 * could pass along it. *out becomes NULL if there is only one polygon, or if polygons cross at points that are not
 * doubles; else the vertices are the polygons' own. */
sunder_status sunder_i_without_seams(const sunder_shape *shape, sunder_shape **out, sunder_error *err);

/* ---- convex_fit.c ---- */

/* Tests whether there is an x such that D + x is a subset of P + tp and of Q + tq (closed sets). Exact, with degenerate
 * positions: what fits exactly fits. D is convex, and the origin is inside it. A translation NULL is zero. */
sunder_status sunder_i_fits_in_both(const sunder_shape *p, const double tp[2], const sunder_shape *q,
                                    const double tq[2], const sunder_shape *d, bool *fits, sunder_error *err);

#endif
