/* join.h: what parts tell, as the whole layer's.
 *
 * Worlds that are not complete, or of which one wrote where another read that was found in another run, are separated
 * again, with all that they saw and each other, until there are none: then what is left are the worlds of the whole
 * layer. A block is whoever is linked in some part. */
#ifndef GIS_PARTS_JOIN_H
#define GIS_PARTS_JOIN_H

#include "parts/part.h"

typedef struct gis_joined {
    gis_part_result *parts;
    size_t *row; /* [rows] places in parts->row, by features; only of worlds that stand */
    size_t rows;
    size_t *conflict; /* places in parts->conflict, by their features */
    size_t conflicts;
    size_t *push;
    size_t pushes;
    gis_part_link *block; /* a: a feature of a block, b: the block's first; by features */
    size_t blocks;
    gis_part_still *still; /* of no world, and not as they are alone: by features */
    size_t stills;
    sunder_layer_summary summary; /* but for features, vertices and skipped, which are the layer's */
    unsigned runs;
} gis_joined;

/* result: of all shards; more is added to it. It has to live as long as *out. */
bool gis_parts_join(const gis_layout *layout, gis_part_result *result, gis_joined *out, gis_error *error);
void gis_joined_clear(gis_joined *joined);

/* gather.c: the lists and sums of the worlds that stand in out->parts. */
bool gis_joined_gather(gis_joined *out, gis_error *error);
/* What became of a feature; NULL: it is of no world. Its entry in block[]; NULL: it is of no block. */
const gis_part_row *gis_joined_row(const gis_joined *joined, size_t feature);
const gis_part_link *gis_joined_block(const gis_joined *joined, size_t feature);

/* Shards first to end - 1 of the spool, as one part, with what is about their cells. */
bool gis_parts_shards(const gis_layout *layout, unsigned first, unsigned end, gis_part_result *result,
                      gis_error *error);

#endif
