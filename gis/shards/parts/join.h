/* join.h: joins the results of parts to the result of the whole layer.
 *
 * A world must be separated again if it is incomplete, or if it wrote where a world found in another run read (or the
 * reverse). Such worlds are separated together, with everything that they saw, until there are none; then the worlds
 * are those of the whole layer. Features that are linked in any part form one block.
 *
 * The results of parts are in files. In memory are the chunks that meet others (border_chunks.h), results that were
 * separated again, and a few numbers for each feature of a block; results of features and pairs are sorted on disk. */
#ifndef GIS_SHARDS_JOIN_H
#define GIS_SHARDS_JOIN_H

#include "layer/result_view.h"
#include "shards/parts/border_chunks.h"
#include "shards/parts/part.h"
#include "shards/parts/sorted_results.h"

/* A feature in a row of houses: its FID, and its anchor after its move. */
typedef struct gis_row_place {
    size_t index;
    int64_t fid;
    double at[2];
} gis_row_place;

/* The first key of a line of the proof in the joined list. */
static inline uint64_t gis_told_key(size_t kind, size_t first) { return (uint64_t)kind << 56 | first; }

/* The joined result. A zeroed struct is empty. */
typedef struct gis_joined {
    gis_sorted_results rows;      /* by feature: one row or one still each; a feature without an entry is as it would be
                                   * alone */
    gis_sorted_results conflicts; /* by (a, b): one conflict each */
    gis_sorted_results pushes;    /* by (a, b): one push each */
    gis_sorted_results hidden;    /* by feature: the hidden ones */
    gis_sorted_results larger;    /* by feature: a row of each that became larger, with the larger shape */
    gis_hiding hiding;            /* the sums of what is hidden, with the classes of: */
    sunder_hiding_class *class;   /* [hiding.classes] */
    size_t class_room;
    gis_sorted_results trees; /* by group (its first feature that moves) and place in the group */
    gis_sorted_results told; /* by kind, first feature and number: lines of the proof about what is hidden or smaller */
    size_t tolds[GIS_TOLD_KINDS];  /* the number of such lines of each kind */
    gis_sorted_results neighbours; /* by the two features: neighbours in rows of houses */
    sunder_row_list row_list;      /* the rows that they form */
    gis_row_place *row_place;      /* [row_places] their features, by number */
    size_t row_places;
    gis_part_link *block; /* by feature; a: a feature in a block, b: the block's first feature */
    bool *fixed;          /* [blocks] at the entry of a block's first feature: one of its features is fixed, and
                                   * so the whole block is */
    size_t blocks;
    sunder_layer_summary summary; /* except features, vertices and skipped, which are known of the layer */
    int64_t longest_fid;          /* FID of summary.max_feature */
    unsigned runs;
} gis_joined;

/* Joins the results of `files` open files, one of each shard. `directory` is used for sorting, and must exist until
 * *out is cleared. */
bool gis_parts_join(const gis_layout *layout, gis_part_file *file, size_t files, const char *directory, gis_joined *out,
                    gis_error *error);
void gis_joined_clear(gis_joined *joined);

/* Makes the lists and sums (joined_lists.c) of all worlds that are not gone: those in `held`, which is cleared, and
 * those in chunks that are not in memory. */
bool gis_joined_lists_make(gis_joined *out, gis_border_chunks *chunks, gis_part_result *held, const char *directory,
                           gis_error *error);
/* Lists the features of the spool that became larger (joined_larger.c). */
bool gis_joined_larger_make(gis_joined *joined, gis_spool *spool, const char *directory, gis_error *error);
/* Joins the neighbours to rows, with the moves of the joined rows of features, and adds up what is about rows in the
 * summary (joined_rows.c). how: the options of the parts. Called when all lists are sorted. */
bool gis_joined_rows_make(gis_joined *joined, const sunder_layer_options *how, gis_error *error);
/* The entry of a feature that is in a row of houses. */
const gis_row_place *gis_joined_row_place(const gis_joined *joined, size_t feature);
/* The entry of a feature in joined->block; NULL: it is in no block. */
const gis_part_link *gis_joined_block(const gis_joined *joined, size_t feature);
/* The status of a feature that is in no world. */
sunder_feature_status gis_joined_status(const gis_joined *joined, const gis_part_still *still);

#endif
