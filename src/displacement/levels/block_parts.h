/* The parts of a block: the polygons of its members that hang together. */
#ifndef SUNDER_I_BLOCK_PARTS_H
#define SUNDER_I_BLOCK_PARTS_H

#include "displacement/layer/model.h"

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

/* Finds the polygons and parts of a body whose members have the shapes shape[f], by feature, in doubles. What `out`
 * holds is replaced. Returns false if memory is out. */
bool sunder_i_block_parts_find(const sunder_i_model *model, const sunder_i_body *body, const sunder_shape *const *shape,
                               double tolerance, sunder_i_block_parts *out);

#endif
