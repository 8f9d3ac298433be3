/* join.h: the results of parts, joined to those of the whole layer.
 *
 * Worlds that are incomplete, or where one wrote where another read that was found in another run, are separated again,
 * together and with all that they saw, until there are none: the remaining worlds are those of the whole layer.
 * Features that are linked in any part are one block.
 *
 * Results of parts lie in files. In memory are the chunks that meet others (border_chunks.h), results that were
 * separated again, and a few numbers for each feature of a block; the results for features and pairs are sorted on
 * disk. */
#ifndef GIS_SHARDS_JOIN_H
#define GIS_SHARDS_JOIN_H

#include "shards/parts/border_chunks.h"
#include "shards/parts/part.h"
#include "shards/parts/sorted_results.h"

/* Zeroed: nothing. */
typedef struct gis_joined {
    gis_sorted_results rows;      /* by features: of each one row, or one still; other features are as they are alone */
    gis_sorted_results conflicts; /* by (a, b): one conflict each */
    gis_sorted_results pushes;    /* likewise */
    gis_sorted_results trees;     /* by groups, each by its first feature that moves */
    gis_part_link *block;         /* a: a feature of a block, b: the block's first; by features */
    bool *fixed;                  /* [blocks] at the block's first: someone of it is fixed, and so all are */
    size_t blocks;
    sunder_layer_summary summary; /* except features, vertices and skipped, which are the layer's */
    int64_t longest_fid;          /* of summary.max_feature */
    unsigned runs;
} gis_joined;

/* file: of all parts, open. directory: for sorting, until *out is cleared. */
bool gis_parts_join(const gis_layout *layout, gis_part_file *file, size_t files, const char *directory, gis_joined *out,
                    gis_error *error);
void gis_joined_clear(gis_joined *joined);

/* joined_lists.c: the lists and sums of the worlds that stand: of what is held, which is cleared, and of the chunks
 * that are not. */
bool gis_joined_lists_make(gis_joined *out, gis_border_chunks *chunks, gis_part_result *held, const char *directory,
                           gis_error *error);
/* A feature's entry in block[]; NULL: it is of no block. */
const gis_part_link *gis_joined_block(const gis_joined *joined, size_t feature);
/* The status of a feature that is of no world. */
sunder_feature_status gis_joined_status(const gis_joined *joined, const gis_part_still *still);

#endif
