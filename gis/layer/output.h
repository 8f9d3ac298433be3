/* output.h: what separate and check write from a layer in memory and its report. The rows themselves are made by
 * rows.h. */
#ifndef GIS_LAYER_OUTPUT_H
#define GIS_LAYER_OUTPUT_H

#include "layer/layer_input.h"
#include "layer/result_view.h"
#include "layer/rows.h"

/* Where the arrow of feature i starts: at the point itself (gis_layer_point()), or at the anchor of a polygon. */
bool gis_arrow_start(const gis_layer_input *input, size_t i, double from[2], gis_error *error);
/* Writes the rows of LAYER_conflicts. */
bool gis_write_report_conflicts(gis_sink_layer *layer, const gis_layer_input *input, const sunder_report *report,
                                gis_error *error);
/* Gets the move of a feature by its place in the input; called once for each, in order. */
typedef bool gis_move_of(void *user, size_t feature, double move[2], gis_error *error);
/* Writes LAYER_symbols of a source that is read again, with its shapes; in batches, if it was opened so. multi: some
 * symbol has several polygons (symbols_anew.c). */
bool gis_write_symbols_anew(gis_sink *sink, const gis_layer_input *input, bool multi, bool batches, gis_move_of *move,
                            void *user, gis_error *error);
/* Writes LAYER_symbols: the symbols of points at their new places; several layers if several layers of points move. */
bool gis_write_symbols(gis_sink *sink, const gis_layer_input *input, const sunder_report *report, gis_error *error);

/* Returns an array [n], which the caller frees: the clause that explains why a feature is hidden; NULL where there is
 * none. Returns NULL if memory is out (hidden_rows.c). */
const sunder_clause **gis_hidden_reasons(const sunder_report *report, size_t n);
/* Makes the row of a feature that is hidden for this reason. */
gis_hidden_row gis_hidden_row_of(size_t feature, sunder_hiding_cost cost, const sunder_clause *why);
/* Lists the hidden features of a layer in memory, in input order. The caller frees the list; the things are the
 * report's. */
bool gis_hidden_list(const gis_layer_input *input, const sunder_report *report, gis_hidden_row **list, size_t *n,
                     gis_error *error);

/* Adds LAYER_hidden: the hidden features where they stood, and why each is hidden. id: the type of its column. */
bool gis_hidden_begin(gis_sink *sink, const gis_layer_input *input, OGRFieldType id, gis_sink_layer **layer,
                      gis_error *error);
bool gis_hidden_put(gis_sink_layer *layer, const gis_hidden_row *row, const gis_things *things, OGRGeometryH geometry,
                    gis_error *error);

/* The FID of a feature, and the same as a value; null if it has none. */
GIntBig gis_layer_fid(const gis_layer_input *input, size_t feature);
gis_value gis_fid_value(const gis_layer_input *input, size_t feature);
/* The barrier with this number in the core's report; NULL if the number is that of a feature, or SIZE_MAX. */
const gis_barrier_feature *gis_barrier_of(const gis_layer_input *input, size_t thing);
const char *gis_barrier_layer(const gis_layer_input *input, const gis_barrier_feature *barrier);
/* The type of the id columns, and the value of --id-field for feature i; null if not given. *copy owns the text (start
 * with NULL, free it at the end). */
OGRFieldType gis_id_type(const gis_layer_input *input);
bool gis_id_value(const gis_layer_input *input, size_t i, char **copy, gis_value *value, gis_error *error);

/* The input's features and barriers, for naming them in rows. */
gis_things gis_things_of(const gis_layer_input *input);
bool gis_conflict_values(const gis_layer_input *input, const sunder_conflict *conflict, gis_conflict_texts *scratch,
                         gis_value values[N_CONFLICT_COLUMNS], gis_error *error);

#endif
