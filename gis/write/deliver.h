/* deliver.h: where results go (the output, the files of --stats, --report, --proof and --trace, standard output), and
 * the end of a run: all of it is in place, or, if anything fails, no file has changed. */
#ifndef GIS_DELIVER_H
#define GIS_DELIVER_H

#include "base/json.h"
#include "disk/text_file.h"
#include "write/sink/sink.h"

/* Destinations of results, and the other files that are read, so that no result replaces an input. Strings are
 * borrowed. */
typedef struct gis_destinations {
    const char *output;   /* NULL: none */
    const char *stats;    /* --stats: a file, or "-" for standard output; NULL: nowhere */
    const char *report;   /* --report: a file; NULL: nowhere */
    const char *proof;    /* --proof: likewise */
    const char *trace;    /* --trace: likewise */
    const char *input[2]; /* the operands that are read: data sources, texts, @FILEs; NULL after the last */
    const char *shape[3]; /* the SHAPEs of options, any of them NULL */
} gis_destinations;

/* Checked before the work, so that a failure does not come at its end: is standard output taken by JSON (--stats -) or
 * by the layer (/vsistdout/), so that no summary may go there? Both at once is wrong usage. Can the files of --stats,
 * --report, --proof and --trace be made, are all of them different, and is none of them, nor the output, a file that is
 * read? */
bool gis_destinations_check(const gis_destinations *to, bool *stdout_taken, gis_error *error);

/* Is none of the files of --stats, --report, --proof and --trace one of the files of this source (the attributes beside
 * a Shapefile)? */
bool gis_destinations_spare(const gis_destinations *to, const gis_source *source, gis_error *error);

typedef struct gis_delivery {
    const gis_destinations *to;
    gis_sink *sink;                                   /* finished (gis_sink_finish); NULL: there is no output */
    const gis_json *stats;                            /* what goes to to->stats, if that is given */
    const gis_text *report;                           /* and to to->report */
    const gis_text *trace;                            /* and to to->trace */
    gis_text_writer *proof;                           /* and to to->proof; of the run */
    bool (*print)(const void *run, gis_error *error); /* what else goes to standard output, by stdio; NULL: nothing */
    const void *run;
} gis_delivery;

/* A `print` whose `run` is a gis_json that has not failed. */
bool gis_print_json(const void *json, gis_error *error);

/* In this order: the statistics, the report, the trace and the proof to temporary files; what goes to standard output,
 * which is flushed; these and the output renamed into place. What the sink has to warn of is printed last. On failure
 * all of them are as they were before. */
bool gis_deliver(const gis_delivery *delivery, gis_error *error);

#endif
