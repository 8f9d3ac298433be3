/* part_internal.h: what part.c, part_result_fill.c and part_worlds.c share: a part while it is being separated. */
#ifndef GIS_PART_INTERNAL_H
#define GIS_PART_INTERNAL_H

#include "layer/proof_lines.h"
#include "shards/parts/part.h"

#include <limits.h>

/* A feature that was read; item[] is sorted by place in the input. */
typedef struct gis_part_loaded {
    gis_spool_feature feature; /* its id is owned; not its rings before it became larger, but: */
    sunder_shape *given;       /* the shape that these make; NULL: it has not become larger */
    bool wanted;
} gis_part_loaded;

#define GIS_NO_PASS UINT_MAX

typedef struct gis_part {
    const gis_layout *layout;
    gis_spool *spool;
    const gis_boxes_list *boxes;
    gis_part_wants *wants;
    const void *user;
    size_t cell; /* the cell being read */
    /* [layout->blocks], [layout->rows] The pass of reading in which the first feature of each came into the part;
     * GIS_NO_PASS: it has none. Pass 0 adds the features in the boxes, each further pass the other features of blocks
     * and rows that came in the pass before; more: another pass is needed. */
    unsigned *block, *row, pass;
    bool more;
    gis_part_loaded *item;
    size_t n, capacity;
    bool *decided; /* [n] it is known which neighbours in rows the feature has; only for features that are wanted */
    gis_barriers_list barriers;
    sunder_layer *layer;
    gis_levels levels; /* the smaller shapes of the features, if they may have any */
    sunder_report *report;
    gis_proof_lines lines; /* used if trees are kept, and so are: */
    gis_proof_choices choices;
    unsigned run;
    gis_part_result *out;
} gis_part;

/* ---- part.c: the beginning and the end of a part
 * ------------------------------------------------------------------ */

/* Reads the features that meet the boxes, with all of their numbered blocks and rows, and the barriers. */
bool gis_part_load(gis_part *p, gis_error *error);
void gis_part_clear(gis_part *p);

/* ---- part_result_fill.c: adds one item each from the part's report to its result
 * ---------------------------------- */

/* The place in the input of a feature of the part; for a barrier, a number behind those of all features. */
size_t gis_part_index_of(const gis_part *p, size_t thing);
/* Adds the row of feature k of the part. */
bool gis_part_fill_row(gis_part *p, size_t k, gis_error *error);
/* Adds the conflict with this number in the report. */
bool gis_part_fill_conflict(gis_part *p, size_t number, bool loose, gis_error *error);
bool gis_part_fill_push(gis_part *p, const sunder_push *push, gis_error *error);
bool gis_part_fill_tree(gis_part *p, const gis_proof_place *place, gis_error *error);
/* Adds feature k of the part, which is hidden for this reason. */
bool gis_part_fill_hidden(gis_part *p, size_t k, const sunder_clause *why, gis_error *error);
/* Adds the component of clauses with this number in the report, and what it hides by class. */
bool gis_part_fill_component(gis_part *p, size_t number, gis_error *error);
bool gis_part_fill_neighbours(gis_part *p, const sunder_row_pair *pair, bool hidden, gis_error *error);
/* Add the lines of the proof about the smaller shapes of feature k of the part, about a clause, and about a tree of the
 * bound of what is hidden, if these are wanted. */
bool gis_part_fill_shapes(gis_part *p, size_t k, gis_error *error);
bool gis_part_fill_clause(gis_part *p, const gis_proof_place *place, gis_error *error);
bool gis_part_fill_choice(gis_part *p, const gis_proof_place *place, gis_error *error);

/* ---- part_worlds.c: adds the worlds that have a requested feature, and features in no world
 * ----------------------- */

bool gis_part_fill_worlds(gis_part *p, gis_error *error);
bool gis_part_fill_others(gis_part *p, gis_error *error);
/* Is everything of the layer that meets the box in the part? May return false if it is. */
bool gis_part_knows(const gis_part *p, const double box[4]);

/* ---- part_rows.c: adds neighbours in rows
 * ------------------------------------------------------------------------- */

/* Adds the pairs of neighbours of requested features. Requested features that are in no world, and for which it is not
 * known which neighbours they have, are added as one incomplete world. Called after gis_part_fill_worlds(). */
bool gis_part_fill_rows(gis_part *p, gis_error *error);

#endif
