/* part.h: a part of a layer, separated by itself.
 *
 * The part is all features that meet some boxes. The result has those of its worlds (sunder_parts.h) that have a
 * requested feature; and whether they are complete, that is, whether everything that meets what they saw was in the
 * part. The result for a complete world is that of a run over the whole layer, unless another world wrote where it
 * read, which parts do not know of each other (join.h). Features are identified by their places in the input. */
#ifndef GIS_SHARDS_PART_H
#define GIS_SHARDS_PART_H

#include "shards/parts/part_result.h"
#include "shards/spool/barrier_spool.h"
#include "shards/spool/spool.h"

typedef struct gis_boxes_list {
    double (*box)[4];
    size_t n, capacity;
} gis_boxes_list;

/* Where the features are that have the same block in their demands; by blocks. */
typedef struct gis_part_block {
    int64_t block;
    double box[4];
} gis_part_block;

/* What all parts of a layer have in common. Zeroed: none. */
typedef struct gis_layout {
    gis_spool *spool;              /* borrowed */
    gis_spooled_barriers barriers; /* borrowed, too; set by callers that have some */
    size_t features;               /* of the input: from here on things are barriers; likewise */
    sunder_layer_options how;
    double halo; /* so far about a shard it is looked at first: a guess */
    gis_part_block *block;
    size_t blocks;
    double memory;  /* bytes that a process may take, about; what takes far more is told of. 0: it does not matter */
    bool by_places; /* proofs identify features by their places in the input, since FIDs are not unique */
    double *explain, *verify; /* borrowed: the seconds of these stages are added to them; NULL: not measured */
} gis_layout;

/* numbered: some features have a block in their demands, and all are looked through. `how` is left to be filled in,
 * without keep_worlds; with keep_trees, results have lines of proofs. */
bool gis_layout_make(gis_spool *spool, double gap, bool numbered, gis_layout *out, gis_error *error);
/* The block with that number; NULL: it has none. */
const gis_part_block *gis_layout_block(const gis_layout *layout, int64_t number);
void gis_layout_clear(gis_layout *layout);

/* Is the feature, of that cell, requested? */
typedef bool gis_part_wants(const void *user, size_t cell, size_t index);

/* Separates the features that meet the boxes, and all features of numbered blocks among these, and adds the results.
 * run: a number for it. Fails as gis_layer_run(). */
bool gis_part_separate(const gis_layout *layout, const gis_boxes_list *boxes, gis_part_wants *wants, const void *user,
                       unsigned run, gis_part_result *result, gis_error *error);

/* Parts first to end - 1 that the spool is dealt to, as one, with what is about their cells (parts_separate.c). */
bool gis_parts_separate(const gis_layout *layout, unsigned first, unsigned end, gis_part_result *result,
                        gis_error *error);

bool gis_boxes_add(gis_boxes_list *list, const double box[4], double reach, gis_error *error);

#endif
