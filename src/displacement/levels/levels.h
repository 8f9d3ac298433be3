/* What the files of this folder share. */
#ifndef SUNDER_I_LEVELS_H
#define SUNDER_I_LEVELS_H

#include "displacement/layer/model.h"
#include "displacement/layer/placement.h"
#include "shape/difference.h"

#include <string.h>

/* The corners of the polygons that stand for discs. The excess at a corner is 1 / cos(pi / 32) - 1 of the radius: half
 * a per cent. */
enum { SUNDER_I_ROUND_CORNERS = 32 };

/* May a shape be the level after `before`? It lies in it, exactly, is smaller, and `disc` fits into each of its
 * polygons (NULL: any).
 * Fails with SUNDER_ENOMEM or SUNDER_ECANCEL. */
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
/* The edge of a shape that begins at vertex v: both of its ends. */
static inline void sunder_i_edge_of(const sunder_shape *shape, uint32_t v, double edge[4])
{
    memcpy(edge, shape->xy + 2 * (size_t)v, 2 * sizeof *edge);
    memcpy(edge + 2, shape->xy + 2 * (size_t)shape->form->cleaned.next[v], 2 * sizeof *edge);
}

/* Where a disc may lie: inside of its members or in cracks between them, and not across a wall. A wall or edge has four
 * coordinates, those of both ends. */
typedef struct sunder_i_disc_room {
    const double *wall;
    const double *edge; /* the edges of the members, one after the other */
    const size_t *end;  /* [members] the index past the last edge of each, of which there is at least one */
    size_t walls, members;
    double crack; /* members no farther apart than this have a crack between them */
} sunder_i_disc_room;

/* The radius of the largest disc is found up to this part of the lesser side of the box around the room. */
#define SUNDER_I_DISC_PRECISION 0x1p-10
/* Finds the largest disc in the room. Returns false if memory is out. inscribed.c. */
bool sunder_i_largest_disc(const sunder_i_disc_room *room, double centre[2], double *radius);

/* Improves a disc by small steps, which are halved where none helps, from `step` on. In a long room, whose middle line
 * is full of discs that are nearly the largest, that finds more than the search in all of it. */
void sunder_i_disc_climb(const sunder_i_disc_room *room, double step, double centre[2], double *radius);

/* Sets *out to a copy of the shape with its vertices at xy; NULL if it is not valid then. level_blocks.c. Fails with
 * SUNDER_ENOMEM or SUNDER_ESIZE. */
sunder_status sunder_i_shape_with_corners(const sunder_shape *shape, const double *xy, sunder_shape **out,
                                          sunder_error *err);

/* One polygon of a member of a block. */
typedef struct sunder_i_block_polygon {
    const sunder_shape *shape; /* the member's */
    uint32_t feature;
    uint32_t vertex, end; /* its vertices in the shape */
    uint32_t part;        /* the number of its part, counted from 0 */
    double box[4];
} sunder_i_block_polygon;

/* The polygons of a block, and its parts: polygons that are no farther apart than the tolerance are in one. */
typedef struct sunder_i_block_parts {
    sunder_i_block_polygon *polygon;
    size_t n, room;
    uint32_t parts;
} sunder_i_block_parts;

/* Finds those of a body whose members have the shapes shape[f], by feature, in doubles; what `out` holds is replaced.
 * Returns false if memory is out. block_parts.c. */
bool sunder_i_block_parts_find(const sunder_i_model *model, const sunder_i_body *body, const sunder_shape *const *shape,
                               double tolerance, sunder_i_block_parts *out);

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
