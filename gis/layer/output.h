/* output.h: what separate and check write of a layer that is held, with its report. Rows are rows.h's. */
#ifndef GIS_LAYER_OUTPUT_H
#define GIS_LAYER_OUTPUT_H

#include "layer/layer_input.h"
#include "layer/rows.h"

/* Where the arrow of a feature starts: at the point itself (gis_layer_point()), or the anchor of a polygon. */
bool gis_arrow_start(const gis_layer_input *input, size_t i, double from[2], gis_error *error);
/* The rows of LAYER_conflicts. */
bool gis_write_report_conflicts(gis_sink_layer *layer, const gis_layer_input *input, const sunder_report *report,
                                gis_error *error);
/* How a feature by its place in the input moved; asked of each once, in their order. */
typedef bool gis_move_of(void *user, size_t feature, double move[2], gis_error *error);
/* LAYER_symbols of a source that is read anew, with its shapes: a batch at a time, if it was opened so. multi: some
 * symbol has several members (symbols_anew.c). */
bool gis_write_symbols_anew(gis_sink *sink, const gis_layer_input *input, bool multi, bool batches, gis_move_of *move,
                            void *user, gis_error *error);
/* LAYER_symbols: the symbols of points where they stand now. */
bool gis_write_symbols(gis_sink *sink, const gis_layer_input *input, const sunder_report *report, gis_error *error);

/* The FID as a value; null if there is none. */
gis_value gis_fid_value(const gis_layer_input *input, size_t feature);
/* Of a thing by its number in the core's report the barrier that it is; NULL: a feature, or SIZE_MAX, nothing. */
const gis_barrier_feature *gis_barrier_of(const gis_layer_input *input, size_t thing);
const char *gis_barrier_layer(const gis_layer_input *input, const gis_barrier_feature *barrier);
/* The type of the id columns, and the user's own key in it; null without --id-field. *copy keeps a text (start with
 * NULL, free at the end). */
OGRFieldType gis_id_type(const gis_layer_input *input);
bool gis_id_value(const gis_layer_input *input, size_t i, char **copy, gis_value *value, gis_error *error);

/* The input's features and barriers, for rows about them. */
gis_things gis_things_of(const gis_layer_input *input);
bool gis_conflict_values(const gis_layer_input *input, const sunder_conflict *conflict, gis_conflict_texts *scratch,
                         gis_value values[N_CONFLICT_COLUMNS], gis_error *error);

#endif
