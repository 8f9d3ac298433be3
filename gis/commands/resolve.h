/* resolve.h: converts the options of the program, with defaults for those not given, to typed requests for the other
 * folders, which do not know the options. A request borrows everything from the options, except where a comment says
 * that it owns it. */
#ifndef GIS_RESOLVE_H
#define GIS_RESOLVE_H

#include "base/message.h"
#include "base/progress.h"
#include "buffer/buffer.h"
#include "follow/follow.h"
#include "options/options.h"
#include "route/route_input.h"
#include "sum/operands.h"
#include "write/deliver.h"

gis_optional_length gis_resolve_length(const gis_options *options, gis_option_id id);

/* Separate, check and buffer: the request of the layer, and its rules, which buffer ignores. The caller clears *out
 * with gis_layer_input_request_clear(), on failure, too. */
bool gis_resolve_layer(const gis_options *options, gis_layer_input_request *out, gis_error *error);
/* Check --before: the request of the original layer, with the name `name` if the dataset has such a layer, and of those
 * that move with it (the caller frees out->with, on failure, too). All else is copied from `now`, the request of the
 * checked layer, which still owns the barriers and strings. */
bool gis_resolve_original(const gis_options *options, const gis_layer_input_request *now, const char *name,
                          gis_layer_input_request *out, gis_error *error);
/* For the commands sum and pair: the requests for P and Q. An option that selects features (--where, --bbox) is
 * refused if neither operand is a data source. */
bool gis_resolve_operands(const gis_options *options, gis_operands_request *out, gis_error *error);
/* Sum: the options of the computation. A planar map is refused if there is no output for it or if the algorithm makes
 * none. */
bool gis_resolve_road(const gis_options *options, sunder_sum_options *out, gis_error *error);
/* Buffer: its request. Everything that can be refused before a file is read is refused here. */
bool gis_resolve_buffer(const gis_options *options, gis_buffer_request *out, gis_error *error);
/* Route: its request; refuses as gis_resolve_buffer() does. The caller clears *out with gis_route_request_clear(), on
 * failure, too. */
bool gis_resolve_route(const gis_options *options, gis_route_request *out, gis_error *error);

/* Follow: its request. */
bool gis_resolve_follow(const gis_options *options, gis_follow_request *out, gis_error *error);
/* Separate: the request of a layer that goes along. */
bool gis_resolve_along(const gis_options *options, const gis_along *along, gis_follow_request *out, gis_error *error);

/* *bytes becomes the size of --max-memory in bytes; 0 if it was not given. */
bool gis_resolve_memory(const gis_options *options, double *bytes, gis_error *error);
/* The request of the output at `path`; `main_layer` is the name of the main layer unless --output-layer gives another
 * one. */
gis_sink_request gis_resolve_sink(const gis_options *options, const char *path, const char *main_layer);
gis_destinations gis_resolve_destinations(const gis_options *options);
/* The progress of the run: as --progress says, else a bar if stderr is a terminal and the command reads or writes a
 * layer. */
gis_progress gis_resolve_progress(const gis_options *options);
/* How errors and warnings are printed. A log file that is also another file of the call is a usage error. */
bool gis_resolve_messages(const gis_options *options, gis_messages_request *out, gis_error *error);

#endif
