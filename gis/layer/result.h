/* result.h: a layer that was separated: what became of its features, what remains in conflict, what presses on what,
 * and what is proved. Users ask through these functions, whether the layer is held in memory with its report
 * (result_held.c) or lies on disk (shards/run/run_result.c): the same questions get the same answers. */
#ifndef GIS_RESULT_H
#define GIS_RESULT_H

#include "layer/layer_input.h"
#include "layer/result_view.h"
#include "layer/rows.h"

#include <stdio.h>

/* Each of these is called for one thing after the other; false, with *error, ends it all. */
/* i: the feature in the batch of the source that is read now. */
typedef bool gis_feature_visit(void *user, size_t i, const gis_feature_row *row, gis_error *error);
typedef bool gis_arrow_visit(void *user, const gis_arrow_row *row, gis_error *error);
/* things: what a and b of the conflict, or of the push, are called. */
typedef bool gis_conflict_visit(void *user, const sunder_conflict *conflict, const gis_things *things,
                                gis_error *error);
typedef bool gis_push_visit(void *user, const sunder_push *push, const gis_things *things, const double from[2],
                            const double to[2], gis_error *error);

typedef struct gis_result gis_result;

/* One implementation. */
typedef struct gis_result_kind {
    /* All features in the order of the input. To be called once, before all that follows: blocks are called by FIDs,
     * which a layer on disk learns here. visit: NULL: nothing is wanted but that. has_null: the format tells a null
     * from a number; if not, a feature of no block has its own number as block. */
    bool (*features)(const gis_result *result, bool has_null, gis_feature_visit *visit, void *user, gis_error *error);
    /* Those that moved. */
    bool (*arrows)(const gis_result *result, bool has_null, gis_arrow_visit *visit, void *user, gis_error *error);
    bool (*conflicts)(const gis_result *result, gis_conflict_visit *visit, void *user, gis_error *error);
    /* Once. */
    bool (*pushes)(const gis_result *result, gis_push_visit *visit, void *user, gis_error *error);
    /* The layer of symbols, added to the sink and written. */
    bool (*symbols)(const gis_result *result, gis_sink *sink, gis_error *error);
    /* The file of --proof. False: see gis_proof_print(). */
    bool (*proof)(const gis_result *result, const sunder_layer_summary *summary, FILE *to, gis_error *error);
    /* The layer to be drawn; to be closed in any case. */
    bool (*view)(const gis_result *result, gis_result_view *out, gis_error *error);
    /* The FID of the feature that moved farthest, which is number `feature`. */
    GIntBig (*longest_fid)(const gis_result *result, size_t feature);
    /* The type of the user's own keys (--id-field). */
    OGRFieldType (*id_type)(const gis_result *result);
} gis_result_kind;

/* Zeroed: none. Everything is borrowed. */
struct gis_result {
    const gis_result_kind *kind;
    const gis_layer_input *input; /* the source, and what was asked for */
    void *of;                     /* of this kind: a report, or a run */
};

/* Which layers are written. */
typedef struct gis_result_layers {
    bool main, displacement, conflicts, pushes, symbols;
} gis_result_layers;

/* Writes them, one after the other (result_layers.c). */
bool gis_result_write(const gis_result *result, const gis_result_layers *layers, gis_sink *sink, gis_error *error);

#endif
