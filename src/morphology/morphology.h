/* Growing and shrinking polygonal sets: what the files hand each other.
 *
 * figure.c      a shape or a sum as rings, segments and points with rational corners
 * grow.c        one exact sum of such a figure and a shape, or of its complement: bands, then the cells between them
 * morphology.c  dilate, erode, open, close */
#ifndef SUNDER_I_MORPHOLOGY_H
#define SUNDER_I_MORPHOLOGY_H

#include "minkowski/sum.h"
#include "planar_map/planar_map.h"
#include "shape/shape.h"

/* A closed set in units of a lattice: the polygons that its rings bound, their interior on the left, and segments and
 * points without area. All arrays live in the arena. */
typedef struct sunder_i_figure {
    sunder_i_arena arena;
    sunder_i_xyw *at; /* corners, by number */
    uint32_t *ring;   /* corner numbers of all rings, one after the other */
    size_t *ring_end; /* [rings] */
    size_t rings, sides;
    const uint32_t *segment; /* [2 * segments] */
    const uint32_t *point;   /* [points] */
    size_t segments, points;
} sunder_i_figure;

/* All members of a shape, whose vertices stand at these places of the lattice. Members may overlap. */
bool sunder_i_figure_of_shape(sunder_i_lattice *lattice, const sunder_shape *shape, const sunder_i_point *at,
                              sunder_i_figure *out);
/* A sum, which must outlive the figure; without its degenerate parts if `regular`. */
bool sunder_i_figure_of_sum(sunder_sum *sum, bool regular, sunder_i_figure *out);
void sunder_i_figure_free(sunder_i_figure *figure);

/* What a figure is summed with: convex pieces with lattice corners, counter-clockwise, and a point inside each. */
typedef struct sunder_i_probe {
    sunder_i_arena arena;
    uint32_t pieces;
    size_t *end;              /* [pieces] index past the last corner of each */
    sunder_i_big (*corner)[2];
    sunder_i_big (*side)[2];  /* from each corner to the next of its piece */
    sunder_i_xyw *inner;      /* [pieces] */
} sunder_i_probe;

/* The pieces of a shape, or of its reflection. */
bool sunder_i_probe_of_shape(sunder_i_lattice *lattice, const sunder_shape *shape, const sunder_i_point *at,
                             bool reflected, sunder_i_probe *out);
void sunder_i_probe_free(sunder_i_probe *probe);

/* Fills the outline of an empty sum, which owns the lattice that all stands on:
 *   grow    the closure of F + probe, without degenerate parts (that set is closed, and they are inside)
 *   shrink  the complement of F^c + int probe, parts without area included; F is regular
 *   unite   the closure of the union of what the rings of F bound, which may overlap (grow and shrink need it so)
 * Fails with SUNDER_ENOMEM or SUNDER_ECANCEL; the caller frees the sum. */
sunder_status sunder_i_grow(const sunder_i_figure *figure, const sunder_i_probe *probe,
                            const sunder_sum_options *options, sunder_sum *sum, sunder_error *err);
sunder_status sunder_i_shrink(const sunder_i_figure *figure, const sunder_i_probe *probe,
                              const sunder_sum_options *options, sunder_sum *sum, sunder_error *err);
sunder_status sunder_i_unite_figure(const sunder_i_figure *figure, const sunder_sum_options *options, sunder_sum *sum,
                                    sunder_error *err);

#endif
