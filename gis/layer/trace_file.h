/* trace_file.h: makes the file of --trace: one JSON line for each step of a separation, with FIDs (docs/trace.md). */
#ifndef GIS_TRACE_FILE_H
#define GIS_TRACE_FILE_H

#include "base/json.h"
#include "layer/layer_input.h"

typedef struct gis_trace {
    const gis_layer_input *input;
    gis_json json; /* the lines so far */
} gis_trace;

/* A sunder_trace callback; `user` is a gis_trace. */
void gis_trace_event(const sunder_trace_event *event, void *user);
void gis_trace_clear(gis_trace *trace);

#endif
