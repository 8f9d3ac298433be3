/* resolve.h: turns the program's options, with defaults for those not given, into typed requests for the folders
 * below, which know no options. A request borrows everything from the options, except what is said to be owned. */
#ifndef GIS_RESOLVE_H
#define GIS_RESOLVE_H

#include "base/message.h"
#include "base/progress.h"
#include "buffer/buffer.h"
#include "options/options.h"
#include "route/route_input.h"
#include "sum/operands.h"
#include "write/deliver.h"

gis_optional_length gis_resolve_length(const gis_options *options, gis_option_id id);

/* Separate, check, buffer: the layer, and its rules, which buffer does not ask for; to be cleared with
 * gis_layer_input_request_clear() in any case. */
bool gis_resolve_layer(const gis_options *options, gis_layer_input_request *out, gis_error *error);
/* Check --before: the layer as it was, of the same name if it has one; the request of the layer that is checked tells
 * the rest. Barriers and strings are that one's. */
void gis_resolve_original(const gis_options *options, const gis_layer_input_request *now, const char *name,
                          gis_layer_input_request *out);
/* For the commands sum and pair: the requests for P and Q. An option that selects features (--where, --bbox) is
 * refused if neither operand is a data source. */
bool gis_resolve_operands(const gis_options *options, gis_operands_request *out, gis_error *error);
/* Sum: the road to it. A planar map is refused if no output shows it, or the road makes none. */
bool gis_resolve_road(const gis_options *options, sunder_sum_options *out, gis_error *error);
/* Buffer. What can be refused before anything is read is refused. */
bool gis_resolve_buffer(const gis_options *options, gis_buffer_request *out, gis_error *error);
/* Route, likewise; to be cleared with gis_route_request_clear() in any case. */
bool gis_resolve_route(const gis_options *options, gis_route_request *out, gis_error *error);

/* --max-memory in bytes; 0: not given. */
bool gis_resolve_memory(const gis_options *options, double *bytes, gis_error *error);
/* OUTPUT; `main_layer` is the name of the main layer unless --output-layer says another. */
gis_sink_request gis_resolve_sink(const gis_options *options, const char *path, const char *main_layer);
gis_destinations gis_resolve_destinations(const gis_options *options);
/* A bar where it is seen, on a terminal, if the run takes a layer or writes one; as --progress says where that is
 * given. */
gis_progress gis_resolve_progress(const gis_options *options);
/* How messages are said. A log in the place of something that the call names is wrong usage. */
bool gis_resolve_messages(const gis_options *options, gis_messages_request *out, gis_error *error);

#endif
