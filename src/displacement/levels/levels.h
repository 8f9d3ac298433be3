/* What the files of this folder share. */
#ifndef SUNDER_I_LEVELS_H
#define SUNDER_I_LEVELS_H

#include "displacement/layer/model.h"
#include "displacement/layer/placement.h"
#include "shape/difference.h"

/* The corners of the polygons that stand for discs. The excess at a corner is 1 / cos(pi / 32) - 1 of the radius: half
 * a per cent. */
enum { SUNDER_I_ROUND_CORNERS = 32 };

/* May a shape be the level after `before`? It lies in it, exactly, is smaller, and `disc` fits into each of its
 * polygons (NULL: any). Fails with SUNDER_ENOMEM or SUNDER_ECANCEL. */
sunder_status sunder_i_level_may_follow(const sunder_shape *before, const sunder_shape *shape, const sunder_shape *disc,
                                        bool *may, sunder_error *err);
/* Sets *fits to whether the disc fits into each polygon of the shape. Fails with SUNDER_ENOMEM or SUNDER_ECANCEL. */
sunder_status sunder_i_disc_fits_polygons(const sunder_shape *shape, const sunder_shape *disc, bool *fits,
                                          sunder_error *err);
/* Sets u to the direction of the longest edge, the first of equal ones. */
void sunder_i_main_direction(const sunder_shape *shape, double u[2]);
/* trim_along.c: replaces what trimming leaves of a shape by what one cut along its main direction, or across it,
 * leaves, if that is hardly less, and at least the share `keep` of the area. margin: by how much the cut is farther
 * than corners demand. Fails with SUNDER_ENOMEM or SUNDER_ECANCEL. */
sunder_status sunder_i_trim_along(const sunder_shape *shape, double keep, double margin, const sunder_shape *disc,
                                  sunder_shape **trimmed, sunder_error *err);
/* arms_cut.c: replaces a shape that was cut from the one as given by what is left of it without arms that the cut made
 * thinner than the disc; it lies in the shape but for rounding. NULL: rounding left no valid ring. disc: around the
 * disc of this diameter; NULL: nothing is too thin. Fails with SUNDER_ENOMEM, SUNDER_ESIZE or SUNDER_ECANCEL. */
sunder_status sunder_i_cut_arms(const sunder_shape *given, const sunder_shape *disc, double diameter,
                                sunder_shape **shape, sunder_error *err);
/* Sets *out to a copy of the shape with its vertices at xy; NULL if it is not valid then. level_blocks.c. Fails with
 * SUNDER_ENOMEM or SUNDER_ESIZE. */
sunder_status sunder_i_shape_with_corners(const sunder_shape *shape, const double *xy, sunder_shape **out,
                                          sunder_error *err);

/* Is the shape of feature f one that levels can be made of: not ignored, one polygon or more, corners that are
 * doubles? */
bool sunder_i_level_has_shape(const sunder_layer *layer, size_t f);
/* Frees n shapes and sets them to NULL. */
void sunder_i_levels_drop(sunder_shape **shape, size_t n);

/* The blocks of a layer in the caller's order. */
typedef struct sunder_i_blocks {
    sunder_i_barriers barriers;
    sunder_layer layer;
    sunder_i_model model;
    sunder_i_placement placement;
    sunder_i_relations relations;
} sunder_i_blocks;

/* Finds them. The caller frees *out, also after a failure; the layer must outlive it. */
sunder_status sunder_i_blocks_find(const sunder_layer *layer, const sunder_layer_options *options, sunder_i_blocks *out,
                                   sunder_error *err);
/* Sets block[n] to the block of each feature: the number of its first feature; -1 for a feature in none. */
void sunder_i_blocks_number(const sunder_i_blocks *blocks, size_t n, int64_t *block);
void sunder_i_blocks_free(sunder_i_blocks *blocks);

#endif
