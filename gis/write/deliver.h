/* deliver.h: where results go (the output, the file of --stats, standard output), and the end of a run: all of it is in
 * place, or, if anything fails, no file has changed. */
#ifndef GIS_DELIVER_H
#define GIS_DELIVER_H

#include "base/json.h"
#include "options/options.h"
#include "write/sink.h"

/* Where --stats goes; NULL if nowhere. */
const char *gis_stats_path(const gis_options *options);
/* Can the file of --stats be made, and is neither it nor the output a file that something is read from? Asked before
 * the work, so that its failure does not come when all is done. */
bool gis_stats_check(const gis_options *options, gis_error *error);
/* Is standard output taken by JSON (--stats -) or by the layer (/vsistdout/), so that no summary may go there? Both at
 * once is wrong usage. */
bool gis_stdout_taken(const gis_options *options, const char *output, bool *taken, gis_error *error);

/* The options of the output; `main_layer` is its name unless --output-layer says another. */
gis_sink_request gis_options_sink(const gis_options *options, const char *path, const char *main_layer);

typedef struct gis_delivery {
    const gis_options *options;
    gis_sink *sink;        /* finished (gis_sink_finish); NULL: there is no output */
    const gis_json *stats; /* what --stats gets, if it is given */
    bool (*print)(const void *run, gis_error *error); /* what else goes to standard output, by stdio; NULL: nothing */
    const void *run;
} gis_delivery;

/* A `print` whose `run` is a gis_json that has not failed. */
bool gis_print_json(const void *json, gis_error *error);

/* In this order: the statistics to a temporary file; what goes to standard output, which is flushed; the statistics and
 * the output renamed into place. What the sink has to warn of is printed last. On failure statistics and output are as
 * they were before. */
bool gis_deliver(const gis_delivery *delivery, gis_error *error);

#endif
