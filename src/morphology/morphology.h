/* Growing and shrinking polygonal sets: what the files hand each other.
 *
 * figure.c              a shape or a sum as rings, segments and points with rational corners
 * dilate_erode.c        one exact sum of such a figure and a shape, or of its complement: bands, then the cells between
 *                       them
 * erode_outline.c       an erosion without a map, where all corners are integers
 * figure_convolution.c  a sum of a figure and a convex shape without bands, where the convolution's curve proves it
 * morphology_operands.c            what all stages of one operation share: the lattice, and B as a structuring element
 * bands.c               a side plus a convex piece
 * convex_fit.c                 does a convex shape fit into what two shapes have in common?
 * islands.c             polygon by polygon, on several threads
 * member_union.c               members that overlap
 * morphology.c          dilate, erode, open, close */
#ifndef SUNDER_I_MORPHOLOGY_H
#define SUNDER_I_MORPHOLOGY_H

#include "planar_map/planar_map.h"
#include "shape/shape.h"
#include "sum/sum_value.h"

/* A closed set in units of a lattice: the polygons that its rings bound, their interior on the left, and segments and
 * points without area. All arrays live in the arena. */
typedef struct sunder_i_figure {
    sunder_i_arena arena;
    sunder_i_rational_point *at; /* corners, by number */
    uint32_t *ring;              /* corner numbers of all rings, one after the other */
    size_t *ring_end;            /* [rings] */
    size_t rings, sides;
    const uint32_t *segment; /* [2 * segments] */
    const uint32_t *point;   /* [points] */
    size_t segments, points;
    bool touches; /* a corner of the rings stands where another one does */
} sunder_i_figure;

/* All members of a shape, whose vertices stand at these places of the lattice; they are disjoint. */
bool sunder_i_figure_of_shape(sunder_i_lattice *lattice, const sunder_shape *shape, const sunder_i_point *at,
                              sunder_i_figure *out);
/* Polygons first to last - 1 of a sum, and, unless `regular`, all its degenerate parts. The sum may be shared by
 * threads. */
bool sunder_i_figure_of_sum(const sunder_sum *sum, size_t first, size_t last, bool regular, sunder_i_figure *out);
void sunder_i_figure_free(sunder_i_figure *figure);

/* A structuring element [Ser82], which a figure is summed with: convex pieces, counter-clockwise, and a point inside
 * each. */
typedef struct sunder_i_structuring_element {
    sunder_i_arena arena;
    uint32_t pieces;
    size_t *end; /* [pieces] index past the last corner of each */
    sunder_i_rational_point *corner;
    sunder_i_rational_point *side; /* from each corner to the next of its piece */
    sunder_i_point *along;         /* the directions of the sides as plain vectors, in lowest terms; if plain */
    bool plain;
    sunder_i_rational_point *inner; /* [pieces] */
} sunder_i_structuring_element;

/* The pieces of a shape, or of its reflection. */
bool sunder_i_structuring_element_of_shape(sunder_i_lattice *lattice, const sunder_shape *shape,
                                           const sunder_i_point *at, bool reflected, sunder_i_structuring_element *out);
void sunder_i_structuring_element_free(sunder_i_structuring_element *element);

/* The plain vector in lowest terms that u is a positive multiple of; false if it is none, or the arena has failed. */
bool sunder_i_heading(sunder_i_arena *arena, sunder_i_rational_point u, sunder_i_point *out);
/* The segment from a to b plus the corners first to end - 1 of an element, which are one of its pieces: its corners,
 * counter-clockwise, into out, which has room for two more than the piece has; returns how many. *known: along has each
 * side's direction or its reverse as a plain vector, for the map; else it is filled with nothing of use. Nothing of all
 * this holds if the arena has failed. */
size_t sunder_i_band(sunder_i_arena *arena, const sunder_i_structuring_element *element, size_t first, size_t end,
                     sunder_i_rational_point a, sunder_i_rational_point b, sunder_i_rational_point *out,
                     sunder_i_point *along, bool *known);

/* Fills the outline of an empty sum, which owns the lattice that all stands on:
 *   dilate  the closure of F + element, without degenerate parts (that set is closed, and they are inside)
 *   erode   the complement of F^c + int element, parts without area included: the erosion of F, which is regular, by
 *           -element
 * Fails with SUNDER_ENOMEM or SUNDER_ECANCEL; the caller frees the sum. */
sunder_status sunder_i_dilate_figure(const sunder_i_figure *figure, const sunder_i_structuring_element *element,
                                     const sunder_sum_options *options, sunder_sum *sum, sunder_error *err);
sunder_status sunder_i_erode_figure(const sunder_i_figure *figure, const sunder_i_structuring_element *element,
                                    const sunder_sum_options *options, sunder_sum *sum, sunder_error *err);

/* erode_outline.c: the same as sunder_i_erode_figure() where all is integers and the element convex; sets *done. */
sunder_status sunder_i_erode_by_outline(const sunder_i_figure *figure, const sunder_i_structuring_element *element,
                                        const sunder_sum_options *options, sunder_sum *sum, bool *done,
                                        sunder_error *err);

/* figure_convolution.c: what sunder_i_dilate_figure() fills in, or (erode) sunder_i_erode_figure(), and sets *done;
 * leaves the sum alone where the curve does not prove it. Fails with SUNDER_ENOMEM or SUNDER_ECANCEL. */
sunder_status sunder_i_sum_by_convolution(const sunder_i_figure *figure, const sunder_i_structuring_element *element,
                                          bool erode, sunder_sum *sum, bool *done, sunder_error *err);

/* ---- morphology_operands.c: P and B on one lattice ---- */

/* Units and origins as sunder_minkowski_sum() has them; never narrow: corners of later stages have denominators. */
typedef struct sunder_i_morphology_operands {
    sunder_i_lattice lattice; /* empty, to be copied */
    double origin_p[2], origin_q[2];
    sunder_i_structuring_element element, reflected; /* B and -B */
    sunder_i_figure figure;                          /* P, if it has one member only; else empty */
} sunder_i_morphology_operands;

sunder_status sunder_i_morphology_operands_make(const sunder_shape *p, const sunder_shape *b,
                                                sunder_i_morphology_operands *out, sunder_error *err);
void sunder_i_morphology_operands_free(sunder_i_morphology_operands *operands);
/* An empty sum on such a lattice; B's origin counts `moved` times. NULL if memory is out. */
sunder_sum *sunder_i_morphology_operands_sum(const sunder_i_morphology_operands *operands, int moved);

/* ---- islands.c ---- */

/* The last stages: the erosion of a set (open: grown again by B, parts without area and all; close: the set is P + B),
 * which is the union of those of its polygons where B's interior is connected. whole: the set, on a lattice of these
 * units, its degenerate parts filled; NULL: the operands' figure. */
sunder_status sunder_i_islands(const sunder_i_morphology_operands *operands, const sunder_sum *whole, bool connected,
                               sunder_operation operation, const sunder_sum_options *options, sunder_sum **out,
                               sunder_error *err);

/* ---- member_union.c ---- */

/* The union of the members of a shape; with b, placed beside it, so that units and origins agree with those of its
 * sums. Fails with SUNDER_ENOMEM or SUNDER_ECANCEL. */
sunder_status sunder_i_union_of_members(const sunder_shape *shape, const sunder_shape *b,
                                        const sunder_sum_options *options, sunder_sum **out, sunder_error *err);
/* The same as a shape whose members have disjoint interiors and share no wall: a wall that two members share is inside
 * the set, yet their pieces leave it out, so a segment or a point, which has no area, would pass along it. *out stays
 * NULL if there is one member only, or if members cross in places that are not doubles; else the corners are the
 * members' own. */
sunder_status sunder_i_without_seams(const sunder_shape *shape, sunder_shape **out, sunder_error *err);

/* ---- convex_fit.c ---- */

/* Is there an x such that D + x lies in P + tp and in Q + tq (closed sets)? Exact, degenerate places included: what
 * fits exactly fits. D is convex, and the origin is inside it. NULL translations are zero. */
sunder_status sunder_i_fits_in_both(const sunder_shape *p, const double tp[2], const sunder_shape *q,
                                    const double tq[2], const sunder_shape *d, bool *fits, sunder_error *err);

#endif
