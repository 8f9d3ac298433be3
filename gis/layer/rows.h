/* rows.h: writes the layers of results row by row, from a report (output.h) or from rows that were stored elsewhere. A
 * layer is begun and its rows are written in order; then the next layer is begun. */
#ifndef GIS_LAYER_ROWS_H
#define GIS_LAYER_ROWS_H

#include "write/sink/sink.h"

/* A FID as a value; null if there is none. */
gis_value gis_fid_as_value(GIntBig fid);
/* The value of a block: the FID of its first member or, if FIDs are not unique, its place in the input (`first`). first
 * = -1: no block, which gives null. In a format without null, a feature in no block gets its own number, which no block
 * has. */
gis_value gis_block_as_value(bool fids_unique, int64_t first, GIntBig fid);

/* ---- LAYER ------------------------------------------------------------------------------------------------------- */

/* The result for a feature. */
typedef struct gis_feature_row {
    double dx, dy;
    sunder_feature_status status;
    gis_value block;
    const sunder_shape *other; /* the shape that the feature has instead of its own; NULL: it has its own */
    bool multi;                /* ... which is written as a multipolygon */
    size_t rung;               /* ... and is this one of the run's smaller shapes, from 1 on; 0: its own */
    double lost;               /* the share of its area that the feature lost; below 0: gained */
    double size;               /* the diameter of the largest disc in the shape that is written; 0: unknown */
} gis_feature_row;

/* hide: the layer has the column sunder_inv; smaller: it has sunder_lvl, sunder_cut and sunder_siz. */
/* main: the number of the main layer. */
bool gis_main_begin(gis_sink *sink, size_t main, bool hide, bool smaller, gis_sink_layer **layer, gis_error *error);
/* Writes the row of feature i of the layer's source, or of its current batch. */
bool gis_main_row(gis_sink_layer *layer, size_t i, const gis_feature_row *row, gis_error *error);

/* ---- LAYER_displacement ------------------------------------------------------------------------------------------ */

/* A feature that moved; `from` is the start of its arrow. */
typedef struct gis_arrow_row {
    gis_value fid, id, block;
    double from[2], move[2];
    gis_value layer; /* the name of its layer, if several layers move together */
} gis_arrow_row;

/* id: the type of the column "id". layers: it has the column layer_a. */
bool gis_displacement_begin(gis_sink *sink, OGRFieldType id, OGRSpatialReferenceH crs, bool layers,
                            gis_sink_layer **layer, gis_error *error);
bool gis_displacement_row(gis_sink_layer *layer, const gis_arrow_row *row, gis_error *error);

/* ---- LAYER_conflicts, LAYER_pushes ------------------------------------------------------------------------------- */

/* Names of the things of a report, by their numbers: features, and from `features` on barriers. */
typedef struct gis_things {
    const void *of;
    size_t features;
    GIntBig (*fid)(const void *of, size_t feature);
    /* The value of --id-field; null if there is none. *copy owns the text (start with NULL, free it at the end). */
    bool (*id)(const void *of, size_t feature, char **copy, gis_value *value, gis_error *error);
    /* The FID of a barrier, and the name of its layer, which is valid as long as `of`. */
    GIntBig (*barrier)(const void *of, size_t thing, const char **layer);
    /* The name of a feature's layer, if several layers move together; else NULL. */
    const char *(*layer)(const void *of, size_t feature);
} gis_things;

/* The columns of LAYER_conflicts. Texts in the values of a conflict are valid until the next call with the same
 * `scratch`, which starts zeroed and is cleared at the end. */
enum {
    COLUMN_FID_A,
    COLUMN_ID_A,
    COLUMN_FID_B,
    COLUMN_ID_B,
    COLUMN_BARRIER,
    COLUMN_BARR_FID,
    COLUMN_KIND,
    COLUMN_REASON,
    COLUMN_DISTANCE,
    COLUMN_BEFORE,
    COLUMN_DEPTH,
    COLUMN_REQUIRED,
    COLUMN_MISSING,
    COLUMN_BLOCKED_BY,
    COLUMN_NEED_SHIFT,
    COLUMN_NEED_GAP,
    COLUMN_NEED_GONE,
    COLUMN_BY_ROW,  /* only in the result of a run with rows */
    COLUMN_LAYER_A, /* only if several layers move together */
    COLUMN_LAYER_B, /* likewise */
    N_CONFLICT_COLUMNS
};

typedef struct gis_conflict_texts {
    char *id[2]; /* copies, since OGR reuses a text at the next call */
    char *blocked_by, *need_gone;
} gis_conflict_texts;

/* Is the number that of a barrier (and not of a feature, or SIZE_MAX)? */
bool gis_things_is_barrier(const gis_things *things, size_t thing);
bool gis_things_conflict(const gis_things *things, const sunder_conflict *conflict, gis_conflict_texts *scratch,
                         gis_value values[N_CONFLICT_COLUMNS], gis_error *error);
void gis_conflict_texts_clear(gis_conflict_texts *scratch);
/* The FIDs of n things, separated by commas; barriers as LAYER:FID. Null if n is 0. *copy owns the text. */
bool gis_things_value(const gis_things *things, const size_t *thing, size_t n, char **copy, gis_value *value,
                      gis_error *error);

/* The name of a feature's layer, if several layers move together; null for what is none. */
gis_value gis_things_layer(const gis_things *things, size_t thing);

/* The columns of LAYER_pushes, the last two only if several layers move together; the texts are borrowed from the
 * barriers and layers. */
enum { N_PUSH_COLUMNS = 9 };
void gis_things_push(const gis_things *things, const sunder_push *push, gis_value values[N_PUSH_COLUMNS]);

/* Adds the layer of conflicts: MAIN_suffix, or MAIN if suffix is "". by_row: it has the column by_row. layers: it has
 * this column, layer_a and layer_b. tight: it may list tight pairs. */
bool gis_conflicts_begin(gis_sink *sink, const char *suffix, OGRFieldType id, OGRSpatialReferenceH crs, bool by_row,
                         bool layers, bool tight, gis_sink_layer **layer, gis_error *error);
/* layers: it has layer_a and layer_b. */
bool gis_pushes_begin(gis_sink *sink, OGRSpatialReferenceH crs, bool layers, gis_sink_layer **layer, gis_error *error);
/* Writes a row with a line as geometry. */
bool gis_line_row(gis_sink_layer *layer, const gis_value *values, const double from[2], const double to[2],
                  gis_error *error);

/* ---- LAYER_rows -------------------------------------------------------------------------------------------------- */

bool gis_house_rows_begin(gis_sink *sink, OGRSpatialReferenceH crs, gis_sink_layer **layer, gis_error *error);
/* Writes a row of neighbours. least_fid: the least FID of its features; xy: [2 * row->features] their anchors now. */
bool gis_house_row(gis_sink_layer *layer, const sunder_row *row, GIntBig least_fid, const double *xy, gis_error *error);

/* ---- LAYER_symbols ----------------------------------------------------------------------------------------------- */

/* main: the number of the main layer whose points have these symbols. multi: some symbol has several polygons. */
bool gis_symbols_begin(gis_sink *sink, size_t main, bool multi, OGRSpatialReferenceH crs, gis_sink_layer **layer,
                       gis_error *error);
/* Writes the symbol of a feature of the source, moved: its vertices plus the move, which the core rounded so that the
 * sums are doubles. shape == NULL: it has none. */
bool gis_symbols_row(gis_sink_layer *layer, OGRFeatureH feature, const sunder_shape *shape, double dx, double dy,
                     bool multi, gis_error *error);

#endif
