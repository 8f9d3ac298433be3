/* part.h: a part of a layer, separated by itself.
 *
 * The part is all features that meet some boxes. Of its worlds (sunder.h, "Parts of a layer") those are told that
 * have a feature which was asked for; and whether they are complete, that is, whether all that meets what they saw
 * was in the part. What is told of a complete one is what a run over the whole layer tells, unless another world
 * wrote where it read, which parts do not know of each other (join.h). Features are called by their places in the
 * input. */
#ifndef GIS_PARTS_PART_H
#define GIS_PARTS_PART_H

#include "spool/spool.h"

typedef struct gis_boxes_list {
    double (*box)[4];
    size_t n, capacity;
} gis_boxes_list;

/* A feature of a world. */
typedef struct gis_part_row {
    size_t index;
    int64_t fid;
    char *id; /* owned; NULL: null */
    double move[2], from[2], weight;
    sunder_feature_status status;
    bool rounded;
} gis_part_row;

typedef struct gis_part_world {
    size_t first;        /* the first of its features */
    bool complete, gone; /* gone: another world has its features now */
    bool loose;          /* no world: conflicts inside a block that nothing happened to, of which `first` is one */
    unsigned run;        /* of which run */
    size_t row, rows;    /* in those of the result; likewise: */
    size_t footprint, footprints, bound, bounds, conflict, conflicts, push, pushes;
    sunder_conflict_counts before, after;
    size_t thin, clusters, clusters_optimal;
} gis_part_world;

/* A feature that is named by a conflict or a push. */
typedef struct gis_part_name {
    size_t index;
    int64_t fid;
    char *id;         /* owned */
    double anchor[2]; /* before it moved */
} gis_part_name;

/* A feature that was asked for and is of no world. */
typedef struct gis_part_still {
    size_t index, inside; /* pairs inside its block, of which it is the first, that are not the gap apart */
    sunder_feature_status status;
} gis_part_still;

/* Two features of one block. */
typedef struct gis_part_link {
    size_t a, b;
} gis_part_link;

/* Of one part, or of several, one behind the other. Zeroed: of none. */
typedef struct gis_part_result {
    gis_part_world *world;
    gis_part_row *row;
    sunder_footprint *footprint;
    double *bound;
    sunder_conflict *conflict; /* without blocked_by, until they are joined (join.h) */
    size_t *blocker;
    size_t *blocked; /* [conflicts] where its blocked_by begins in blocker[] */
    sunder_push *push;
    gis_part_name *name;
    gis_part_still *still;
    gis_part_link *link;
    size_t worlds, rows, footprints, bounds, conflicts, blockers, pushes, names, stills, links;
    struct {
        size_t world, row, footprint, bound, conflict, blocker, blocked, push, name, still, link;
    } room;
    bool unverified; /* the core did not verify some part */
} gis_part_result;

void gis_part_result_clear(gis_part_result *result);

/* Where the features are that have the same block in their demands; by blocks. */
typedef struct gis_part_block {
    int64_t block;
    double box[4];
} gis_part_block;

/* What all parts of a layer have in common. Zeroed: none. */
typedef struct gis_layout {
    gis_spool *spool; /* borrowed */
    sunder_layer_options how;
    double halo; /* so far about a shard it is looked at first: a guess */
    gis_part_block *block;
    size_t blocks;
} gis_layout;

/* how: without keep_worlds. numbered: some features have a block in their demands, and all are looked through. */
bool gis_layout_make(gis_spool *spool, const sunder_layer_options *how, bool numbered, gis_layout *out,
                     gis_error *error);
void gis_layout_clear(gis_layout *layout);

/* Is the feature, of that cell, asked for? */
typedef bool gis_part_wants(const void *user, size_t cell, size_t index);

/* Separates what meets the boxes, and who is of a block by number with such, and adds what is told of it to the result.
 * run: a number for it. Fails as gis_layer_run(). */
bool gis_part_separate(const gis_layout *layout, const gis_boxes_list *boxes, gis_part_wants *wants, const void *user,
                       unsigned run, gis_part_result *result, gis_error *error);

bool gis_boxes_add(gis_boxes_list *list, const double box[4], double reach, gis_error *error);
bool gis_boxes_meet(const double a[4], const double b[4]);

#endif
