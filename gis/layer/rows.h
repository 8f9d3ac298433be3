/* rows.h: the layers of results row by row: from a report (output.h), or from rows kept elsewhere until all are there.
 * A layer is begun, its rows are written in order, then the next one is begun. */
#ifndef GIS_LAYER_ROWS_H
#define GIS_LAYER_ROWS_H

#include "write/sink/sink.h"

/* A FID as a value; null if there is none. */
gis_value gis_fid_as_value(GIntBig fid);
/* What a block is called: by its first member, that is by the FID, or, where FIDs are not unique, by the place in the
 * input. first: that place; -1: no block, which is null. In a format without null the value of a feature
 * that stands alone is its own number, which no other feature has. */
gis_value gis_block_as_value(bool fids_unique, int64_t first, GIntBig fid);

/* ---- LAYER ------------------------------------------------------------------------------------------------------- */

/* What became of a feature. */
typedef struct gis_feature_row {
    double dx, dy;
    sunder_feature_status status;
    gis_value block;
} gis_feature_row;

bool gis_main_begin(gis_sink *sink, gis_sink_layer **layer, gis_error *error);
/* Of feature i of the sink's source, or of its batch. */
bool gis_main_row(gis_sink_layer *layer, size_t i, const gis_feature_row *row, gis_error *error);

/* ---- LAYER_displacement ------------------------------------------------------------------------------------------ */

/* A feature that moved; `from` is where its arrow starts. */
typedef struct gis_arrow_row {
    gis_value fid, id, block;
    double from[2], move[2];
} gis_arrow_row;

/* id: the type of ids. */
bool gis_displacement_begin(gis_sink *sink, OGRFieldType id, OGRSpatialReferenceH crs, gis_sink_layer **layer,
                            gis_error *error);
bool gis_displacement_row(gis_sink_layer *layer, const gis_arrow_row *row, gis_error *error);

/* ---- LAYER_conflicts, LAYER_pushes ------------------------------------------------------------------------------- */

/* How the things of a report are called, by their numbers in it: features, and from `features` on barriers. */
typedef struct gis_things {
    const void *of;
    size_t features;
    GIntBig (*fid)(const void *of, size_t feature);
    /* The user's own key; null without one. *copy keeps a text (start with NULL, free at the end). */
    bool (*id)(const void *of, size_t feature, char **copy, gis_value *value, gis_error *error);
    /* Of a barrier the FID, and the name of its layer, which lives as long as `of`. */
    GIntBig (*barrier)(const void *of, size_t thing, const char **layer);
} gis_things;

/* The columns of LAYER_conflicts, as the values of one conflict. Texts in them stay valid until the next call with the
 * same scratch, which starts zeroed and is cleared at the end. */
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
    N_CONFLICT_COLUMNS
};

typedef struct gis_conflict_texts {
    char *id[2]; /* OGR lends a text only until the next one is asked for: these are copies */
    char *blocked_by, *need_gone;
} gis_conflict_texts;

/* Is the thing a barrier, and no feature, nor SIZE_MAX, nothing? */
bool gis_things_is_barrier(const gis_things *things, size_t thing);
bool gis_things_conflict(const gis_things *things, const sunder_conflict *conflict, gis_conflict_texts *scratch,
                         gis_value values[N_CONFLICT_COLUMNS], gis_error *error);
void gis_conflict_texts_clear(gis_conflict_texts *scratch);

/* The columns of LAYER_pushes; all texts are the barriers'. */
enum { N_PUSH_COLUMNS = 7 };
void gis_things_push(const gis_things *things, const sunder_push *push, gis_value values[N_PUSH_COLUMNS]);

/* The layer is called MAIN_suffix, or MAIN if suffix is "". */
bool gis_conflicts_begin(gis_sink *sink, const char *suffix, OGRFieldType id, OGRSpatialReferenceH crs,
                         gis_sink_layer **layer, gis_error *error);
bool gis_pushes_begin(gis_sink *sink, OGRSpatialReferenceH crs, gis_sink_layer **layer, gis_error *error);
/* A row of either: values, and a line. */
bool gis_line_row(gis_sink_layer *layer, const gis_value *values, const double from[2], const double to[2],
                  gis_error *error);

/* ---- LAYER_symbols ----------------------------------------------------------------------------------------------- */

/* multi: some symbol has several members. */
bool gis_symbols_begin(gis_sink *sink, bool multi, OGRSpatialReferenceH crs, gis_sink_layer **layer, gis_error *error);
/* The symbol of a feature of the source, moved: its corners plus the move, which the core chose so that they are
 * doubles. shape: NULL: it has none. */
bool gis_symbols_row(gis_sink_layer *layer, OGRFeatureH feature, const sunder_shape *shape, double dx, double dy,
                     bool multi, gis_error *error);

#endif
