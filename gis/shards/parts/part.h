/* part.h: separates one part of a layer.
 *
 * The part is all features that meet some boxes. The result contains the worlds (sunder_parts.h) that have a requested
 * feature, and whether each is complete, that is, whether everything that meets what it saw was in the part. The result
 * of a complete world is that of a run over the whole layer, unless another world wrote where it read; parts do not
 * know of each other, so that is checked later (join.h). Features are identified by their places in the input. */
#ifndef GIS_SHARDS_PART_H
#define GIS_SHARDS_PART_H

#include "shards/parts/part_result.h"
#include "shards/spool/barrier_spool.h"
#include "shards/spool/spool.h"

typedef struct gis_boxes_list {
    double (*box)[4];
    size_t n, capacity;
} gis_boxes_list;

/* A block number that features have in their demands, and the box of these features. Lists are sorted by block. */
typedef struct gis_part_block {
    int64_t block;
    double box[4];
} gis_part_block;

/* What all parts of a layer have in common. A zeroed struct is empty. */
typedef struct gis_layout {
    gis_spool *spool;              /* borrowed */
    gis_spooled_barriers barriers; /* borrowed; set by the caller if there are barriers */
    size_t features;               /* number of features in the input: things with numbers from here on are barriers;
                                    * set by the caller */
    sunder_layer_options how;
    sunder_gaps gaps;            /* the tables by classes, and which classes there are, borrowed; set by the caller if
                                  * gaps depend on classes */
    double halo;                 /* distance around a shard within which features are read with it; a guess */
    gis_part_block *block, *row; /* the numbered blocks, and the rows of --rows FIELD likewise */
    size_t blocks, rows;
    double memory; /* approximate bytes that a process may take; a part that takes much more gets a warning. 0: no
                     * limit */
    const gis_layer_rules *rules;    /* borrowed: which features may be hidden or become smaller; set by the caller */
    const gis_rung_lengths *lengths; /* borrowed: the lengths in the rules */
    bool by_places;   /* the proof identifies features by their places in the input, since FIDs are not unique */
    const char *name; /* borrowed: of the layer, for messages */
    double *explain, *verify; /* borrowed: the seconds of these stages are added here; NULL: not measured */
} gis_layout;

/* Makes a layout. numbered: some features have a block in their demands, or a row, so all features are read to find
 * the boxes of blocks and rows. The caller fills in `how`, without keep_worlds; if it has keep_trees, results contain
 * lines of the proof. */
bool gis_layout_make(gis_spool *spool, double gap, bool numbered, gis_layout *out, gis_error *error);
/* The block, or the row, with this number; NULL: no feature has it. */
const gis_part_block *gis_layout_block(const gis_layout *layout, int64_t number);
const gis_part_block *gis_layout_row(const gis_layout *layout, int64_t number);
void gis_layout_clear(gis_layout *layout);

/* Is the feature `index`, which is in cell `cell` of the spool, requested? */
typedef bool gis_part_wants(const void *user, size_t cell, size_t index);

/* Separates the features that meet the boxes, with all features of numbered blocks and rows that these belong to, and
 * so on, and adds the results to *result. `run` is a number for this separation. Fails as gis_layer_run() does. */
bool gis_part_separate(const gis_layout *layout, const gis_boxes_list *boxes, gis_part_wants *wants, const void *user,
                       unsigned run, gis_part_result *result, gis_error *error);

/* Separates the spool's parts first to end - 1 as one, with the features around their cells (parts_separate.c). */
bool gis_parts_separate(const gis_layout *layout, unsigned first, unsigned end, gis_part_result *result,
                        gis_error *error);

/* Makes the features that meet the boxes larger by the rules of the layout, and adds the requested ones to a spool:
 * with their larger shapes, and with the first feature of each block as its number. Adds boxes if blocks are larger
 * than the part. *larger is increased by the number of features that grew. */
bool gis_part_enlarge(const gis_layout *layout, gis_boxes_list *boxes, gis_part_wants *wants, const void *user,
                      gis_spool_writer *to, size_t *larger, gis_error *error);
/* The same for the spool's parts first to end - 1 (parts_separate.c). */
bool gis_parts_enlarge(const gis_layout *layout, unsigned first, unsigned end, gis_spool_writer *to, size_t *larger,
                       gis_error *error);

bool gis_boxes_add(gis_boxes_list *list, const double box[4], double reach, gis_error *error);

#endif
