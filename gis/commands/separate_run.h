/* separate_run.h: the state of a separation, and the steps that are the same whether it is done in memory, in parts, or
 * by the shards of a plan: opening the output, computing statistics, writing layers and delivering the results. */
#ifndef GIS_SEPARATE_RUN_H
#define GIS_SEPARATE_RUN_H

#include "base/json.h"
#include "follow/follow.h"
#include "layer/result.h"
#include "layer/trace_file.h"
#include "options/options.h"
#include "shards/run/shard_run.h"
#include "write/deliver.h"

/* The layers of --layers, as bits; GIS_SEPARATE_LAYERS is their number. */
enum {
    GIS_SEPARATE_MAIN = 1,
    GIS_SEPARATE_DISPLACEMENT = 2,
    GIS_SEPARATE_CONFLICTS = 4,
    GIS_SEPARATE_PUSHES = 8,
    GIS_SEPARATE_ROWS = 16,
    GIS_SEPARATE_SYMBOLS = 32,
    GIS_SEPARATE_HIDDEN = 64,
    GIS_SEPARATE_LAYERS = 7
};

/* Layers that go along with what moves. */
typedef struct gis_separate_along {
    gis_follow_request *request; /* [n] */
    gis_follow *follow;          /* [n] */
    size_t n;
    gis_follow_targets targets; /* what moved */
} gis_separate_along;

typedef struct gis_separate_run {
    const gis_options *options;
    gis_destinations to;
    gis_layer_input_request request;
    gis_layer_input input;
    const char *suffixes[GIS_SEPARATE_LAYERS]; /* the suffixes of the layers besides the main one, NULL-terminated; the
                                                * sink borrows the array */
    gis_sink_main *more;                       /* the main layers besides the first; the sink borrows the array */
    gis_separate_along along;
    gis_sink *sink;
    sunder_report *report;
    sunder_layer_summary summary;
    gis_progress progress;
    gis_trace trace; /* filled if --trace is given */
    unsigned chosen; /* the layers to write, as bits */
    bool taken;      /* standard output is used by a result, hence no summary is printed */
    bool verified;
    double start, read, write;
    bool source_held;    /* all features of the source are in memory; else they are read in batches */
    const char *scratch; /* the directory for temporary data on features; NULL: they are kept in memory */
    uint64_t stamp;      /* identifies the run that shards belong to */
    double began;        /* when the separation began, in seconds of gis_clock() */
    gis_shard_run parts; /* the parts on disk of a layer that is not held in memory */
    gis_result result;   /* valid after the separation */
} gis_separate_run;

/* ---- separate.c: begin and end of a run -------------------------------------------------------------------------- */

/* Checks the destinations of the results and resolves the request. The caller calls gis_separate_end() on failure,
 * too. */
bool gis_separate_begin(const gis_options *options, gis_separate_run *run, gis_error *error);
/* Frees the run and returns the exit status of the program; prints *error unless `done`. */
int gis_separate_end(gis_separate_run *run, bool done, const gis_error *error);

/* ---- separate_layers.c: the layers ------------------------------------------------------------------------------- */

/* *chosen becomes the layers that `list` (--layers; NULL: all) names and that apply; the layer of symbols applies to
 * points only, that of rows only if rows are found, and that of hidden features only with --hide. An unknown name is a
 * usage error. */
bool gis_separate_choose_layers(const char *list, const gis_layer_rules *rules, bool points, unsigned *chosen,
                                gis_error *error);
/* Opens the output before the computation, so that an output that must be refused is refused at once. */
bool gis_separate_open_sink(gis_separate_run *run, gis_error *error);
/* Writes the layers of run->result; only gis_deliver(), which puts the files in place, is left to do. */
bool gis_separate_write_layers(gis_separate_run *run, gis_error *error);

/* ---- separate_along.c: layers that go along ---------------------------------------------------------------------- */

/* Reads these layers, once those that move are read. */
bool gis_separate_read_along(gis_separate_run *run, gis_error *error);
/* Has the targets noted as the main layers are written. */
void gis_separate_watch(gis_separate_run *run, gis_result_layers *layers);
/* Writes the layers, once all others are written. */
bool gis_separate_write_along(gis_separate_run *run, gis_error *error);
void gis_separate_clear_along(gis_separate_along *along);

/* ---- separate_in_parts.c: a layer in parts on disk --------------------------------------------------------------- */

/* Opens the output as gis_separate_open_sink() does, and starts the clock of the separation. */
bool gis_separate_in_parts_begin(gis_separate_run *run, gis_error *error);
/* Joins the shards, which must all be done, and writes the layers. */
bool gis_separate_in_parts_end(gis_separate_run *run, gis_error *error);

/* ---- separate_figures.c: statistics ------------------------------------------------------------------------------ */

/* Returns the share of the cost that exceeds the lower bound; 1 if the cost exceeds the range of doubles, and 0 if it
 * is 0. */
double gis_separate_optimality_gap(const sunder_layer_summary *summary);
/* Returns the name that the CRS gives to the unit of the layer, or "unknown"; it is borrowed from the CRS. */
const char *gis_separate_unit(const gis_separate_run *run);
void gis_separate_stats(gis_json *out, const gis_separate_run *run);
/* Prints the summary to standard output; `separated` is a gis_separate_run. */
bool gis_separate_print(const void *separated, gis_error *error);

/* ---- separate_deliver.c ------------------------------------------------------------------------------------------ */

/* Returns whether the summary is printed. */
bool gis_separate_is_summarised(const gis_separate_run *run);
/* Writes the statistics, report, proof and trace and puts all files in place. */
bool gis_separate_deliver(const gis_separate_run *run, gis_error *error);

#endif
