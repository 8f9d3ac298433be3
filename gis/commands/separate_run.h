/* separate_run.h: a separation, and what is the same for one that is done in one process, in parts, or by shards of a
 * plan: the output is opened, figures and layers are made, and all of it is delivered. */
#ifndef GIS_SEPARATE_RUN_H
#define GIS_SEPARATE_RUN_H

#include "base/json.h"
#include "layer/result.h"
#include "layer/trace_file.h"
#include "options/options.h"
#include "shards/run/shard_run.h"
#include "write/deliver.h"

/* Bits of --layers. */
enum {
    GIS_SEPARATE_MAIN = 1,
    GIS_SEPARATE_DISPLACEMENT = 2,
    GIS_SEPARATE_CONFLICTS = 4,
    GIS_SEPARATE_PUSHES = 8,
    GIS_SEPARATE_SYMBOLS = 16,
    GIS_SEPARATE_LAYERS = 5
};

typedef struct gis_separate_run {
    const gis_options *options;
    gis_destinations to;
    gis_layer_input_request request;
    gis_layer_input input;
    const char *suffixes[GIS_SEPARATE_LAYERS]; /* of the layers besides the main one; the sink borrows them */
    gis_sink *sink;
    sunder_report *report;
    sunder_layer_summary summary;
    gis_progress progress;
    gis_trace trace; /* where --trace is given */
    unsigned chosen; /* which layers are written */
    bool taken;      /* standard output is */
    bool verified;
    double start, read, write;
    bool source_held;    /* all features of the source are; else it is read by batches */
    const char *scratch; /* the directory for what is noted of features; NULL: memory */
    uint64_t stamp;      /* of what shards were done for */
    double began;        /* to separate */
    gis_shard_run parts; /* of a layer that is not held */
    gis_result result;   /* from when it is separated */
} gis_separate_run;

/* ---- separate.c: from beginning to end --------------------------------------------------------------------------- */

/* Where results go is looked at, and the rules are resolved. The run is to be ended in any case. */
bool gis_separate_begin(const gis_options *options, gis_separate_run *run, gis_error *error);
/* The exit status; what failed is said. */
int gis_separate_end(gis_separate_run *run, bool done, const gis_error *error);

/* ---- separate_layers.c: which layers are written ----------------------------------------------------------------- */

/* What --layers chooses of those that apply; an unknown name is wrong usage. */
bool gis_separate_choose_layers(const char *list, bool points, unsigned *chosen, gis_error *error);
/* The sink is opened before the work is done: what can be refused is refused before hours of computing. */
bool gis_separate_open_sink(gis_separate_run *run, gis_error *error);
/* Writes the layers of run->result: all but the last step, which is gis_deliver()'s. */
bool gis_separate_write_layers(gis_separate_run *run, gis_error *error);

/* ---- separate_in_parts.c: of a layer that is not held ------------------------------------------------------------ */

/* As gis_separate_open_sink(). From here on the layer is separated. */
bool gis_separate_in_parts_begin(gis_separate_run *run, gis_error *error);
/* All shards are there: joins them, and writes the layers. */
bool gis_separate_in_parts_end(gis_separate_run *run, gis_error *error);

/* ---- separate_figures.c: what came of it ------------------------------------------------------------------------- */

/* What part of the cost is not proved to be needed; of a cost beyond doubles all of it, as far as a double can tell. */
double gis_separate_optimality_gap(const sunder_layer_summary *summary);
/* The name of the layer's unit, the CRS's own. */
const char *gis_separate_unit(const gis_separate_run *run);
void gis_separate_stats(gis_json *out, const gis_separate_run *run);
/* The summary, on standard output; of a gis_separate_run. */
bool gis_separate_print(const void *separated, gis_error *error);

/* ---- separate_deliver.c ------------------------------------------------------------------------------------------ */

/* Is the summary printed? */
bool gis_separate_is_summarised(const gis_separate_run *run);
/* All is put in place. */
bool gis_separate_deliver(const gis_separate_run *run, gis_error *error);

#endif
