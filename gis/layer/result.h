/* result.h: the result of a separation: moves of features, remaining conflicts, contact forces, and proofs. These
 * functions give the same answers whether the layer is held in memory with its report (result_held.c) or is on disk
 * (shards/run/run_result.c). */
#ifndef GIS_RESULT_H
#define GIS_RESULT_H

#include "layer/layer_input.h"
#include "layer/result_view.h"
#include "layer/rows.h"

#include <stdio.h>

/* Visitors are called for one item after the other; returning false, with *error, ends the loop. */
/* i: number of the feature in the current batch of the source. */
typedef bool gis_feature_visit(void *user, size_t i, const gis_feature_row *row, gis_error *error);
typedef bool gis_arrow_visit(void *user, const gis_arrow_row *row, gis_error *error);
/* things: names of the two things, a and b, of the conflict or push. */
typedef bool gis_conflict_visit(void *user, const sunder_conflict *conflict, const gis_things *things,
                                gis_error *error);
typedef bool gis_push_visit(void *user, const sunder_push *push, const gis_things *things, const double from[2],
                            const double to[2], gis_error *error);

/* least_fid: the least FID of the row's features; xy: their anchors now. */
typedef bool gis_house_row_visit(void *user, const sunder_row *row, GIntBig least_fid, const double *xy,
                                 gis_error *error);

/* geometry: that of the feature in the source; things: names of the things of the row, and the id of its feature. */
typedef bool gis_hidden_visit(void *user, const gis_hidden_row *row, const gis_things *things, OGRGeometryH geometry,
                              gis_error *error);

typedef struct gis_result gis_result;

/* The functions of one implementation. */
typedef struct gis_result_kind {
    /* Visits all features in input order. Call it once, before the other functions, since blocks are identified by
     * FIDs, which a layer on disk learns here; visit may be NULL. has_null: the format distinguishes null from numbers;
     * if not, a feature in no block gets its own number as block. */
    bool (*features)(const gis_result *result, bool has_null, gis_feature_visit *visit, void *user, gis_error *error);
    /* Visits the features that moved. */
    bool (*arrows)(const gis_result *result, bool has_null, gis_arrow_visit *visit, void *user, gis_error *error);
    bool (*conflicts)(const gis_result *result, gis_conflict_visit *visit, void *user, gis_error *error);
    /* Call it once only. */
    bool (*pushes)(const gis_result *result, gis_push_visit *visit, void *user, gis_error *error);
    /* Visits the rows of neighbours. */
    bool (*rows)(const gis_result *result, gis_house_row_visit *visit, void *user, gis_error *error);
    /* Adds the layer of symbols to the sink and writes it. */
    bool (*symbols)(const gis_result *result, gis_sink *sink, gis_error *error);
    /* Visits the hidden features in input order. */
    bool (*hidden)(const gis_result *result, gis_hidden_visit *visit, void *user, gis_error *error);
    /* Gets the sums of what is hidden or smaller. */
    void (*hiding)(const gis_result *result, gis_hiding *hiding);
    /* Writes the file of --proof. Fails as gis_proof_print() does. */
    bool (*proof)(const gis_result *result, const sunder_layer_summary *summary, FILE *to, gis_error *error);
    /* Opens a view for drawing the layer, which must be closed in any case. */
    bool (*view)(const gis_result *result, gis_result_view *out, gis_error *error);
    /* The FID of the feature with the longest move, which has the number `feature`. */
    GIntBig (*longest_fid)(const gis_result *result, size_t feature);
    /* The type of the values of --id-field. */
    OGRFieldType (*id_type)(const gis_result *result);
} gis_result_kind;

/* A result; everything is borrowed. */
struct gis_result {
    const gis_result_kind *kind;
    const gis_layer_input *input; /* the source, and the request */
    void *of;                     /* what the implementation works on: a sunder_report or a gis_shard_run */
};

/* Is called with each feature, the number i of its layer or of its current batch, before it is written; also with those
 * that are hidden and not written. */
typedef bool gis_feature_watch(void *user, const gis_layer_input *own, size_t i, const gis_feature_row *row,
                               gis_error *error);

/* Which layers are written. */
typedef struct gis_result_layers {
    bool main, displacement, conflicts, pushes, rows, symbols, hidden;
    gis_feature_watch *watch; /* NULL: nothing watches the main layers */
    void *watcher;
} gis_result_layers;

/* Writes the chosen layers, one after the other (result_layers.c). */
bool gis_result_write(const gis_result *result, const gis_result_layers *layers, gis_sink *sink, gis_error *error);

#endif
