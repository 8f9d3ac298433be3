/* part_internal.h: what part.c, part_result_fill.c and part_worlds.c share: a part while it is worked on. */
#ifndef GIS_PART_INTERNAL_H
#define GIS_PART_INTERNAL_H

#include "layer/proof_lines.h"
#include "shards/parts/part.h"

/* A feature as it was read, at its place in the order of the input. */
typedef struct gis_part_loaded {
    gis_spool_feature feature; /* its id owned */
    bool wanted;
} gis_part_loaded;

typedef struct gis_part {
    const gis_layout *layout;
    gis_spool *spool;
    const gis_boxes_list *boxes;
    gis_part_wants *wants;
    const void *user;
    size_t cell; /* that is being read */
    bool others; /* ... for those of blocks alone */
    bool *block; /* [layout->blocks] one of it is there */
    gis_part_loaded *item;
    size_t n, capacity;
    gis_barriers_list barriers;
    sunder_layer *layer;
    sunder_report *report;
    gis_proof_lines lines; /* where trees are kept */
    unsigned run;
    gis_part_result *out;
} gis_part;

/* ---- part_result_fill.c: one thing each, from the part's report to its result ------------------------------------ */

/* The place in the input of a feature, or of a barrier behind all features. */
size_t gis_part_index_of(const gis_part *p, size_t thing);
/* Feature k. */
bool gis_part_fill_row(gis_part *p, size_t k, gis_error *error);
/* number: among those of the report. */
bool gis_part_fill_conflict(gis_part *p, size_t number, bool loose, gis_error *error);
bool gis_part_fill_push(gis_part *p, const sunder_push *push, gis_error *error);
bool gis_part_fill_tree(gis_part *p, const gis_proof_place *place, gis_error *error);

/* ---- part_worlds.c: all that is told of worlds that have a feature which was asked for, and of those of none ----- */

bool gis_part_fill_worlds(gis_part *p, gis_error *error);
bool gis_part_fill_others(gis_part *p, gis_error *error);

#endif
