/* deliver.h: where results go (the output, the files of --stats, --report, --proof and --trace, standard output), and
 * the end of a run, which puts all results in place or, if any step fails, changes no file. */
#ifndef GIS_DELIVER_H
#define GIS_DELIVER_H

#include "base/json.h"
#include "disk/text_file.h"
#include "write/sink/sink.h"

/* The destinations of a run's results, and the files that the run reads, so that a result never replaces an input.
 * Strings are borrowed. */
typedef struct gis_destinations {
    const char *output;   /* NULL: none */
    const char *stats;    /* --stats: a file, or "-" for standard output; NULL: not requested */
    const char *report;   /* --report: a file; NULL: not requested */
    const char *proof;    /* --proof: a file; NULL: not requested */
    const char *trace;    /* --trace: a file; NULL: not requested */
    const char *input[2]; /* the operands that are read (data sources, texts, @FILEs); NULL after the last */
    const char *shape[3]; /* the values of options that take a SHAPE (text or @FILE), so that no result
                           * replaces such a file; each may be NULL */
    const char *sheet;    /* the file of --spec; NULL: none */
} gis_destinations;

/* Checks the destinations before the work, so that a run does not fail at its end. Fails if two of the files of
 * --stats, --report, --proof and --trace are the same, if one of them cannot be written, or if one of them, or the
 * output, is a file that is read. Sets *stdout_taken if JSON (--stats -) or the layer (/vsistdout/) goes to standard
 * output, in which case no summary may be printed there; both at once is wrong usage. */
bool gis_destinations_check(const gis_destinations *to, bool *stdout_taken, gis_error *error);

/* Fails if one of the files of --stats, --report, --proof and --trace is one of the files of the dataset `source` (such
 * as the .dbf of a Shapefile). */
bool gis_destinations_spare(const gis_destinations *to, const gis_source *source, gis_error *error);

typedef struct gis_delivery {
    const gis_destinations *to;
    gis_sink *sink;                                   /* finished (gis_sink_finish); NULL: there is no output */
    const gis_json *stats;                            /* the text for to->stats, used if that is given */
    const gis_text *report;                           /* the text for to->report */
    const gis_text *trace;                            /* the text for to->trace */
    gis_text_writer *proof;                           /* writes the proof to to->proof; it is called with `run` */
    bool (*print)(const void *run, gis_error *error); /* prints further text to standard output with stdio; NULL:
                                                       * none */
    const void *run;
} gis_delivery;

/* A function for `print`: prints `json`, a gis_json in which no allocation failed. */
bool gis_print_json(const void *json, gis_error *error);

/* Ends a run, in this order: writes the statistics, the report, the trace and the proof to temporary files; prints to
 * standard output and flushes it; renames the temporary files and the output into place; prints the sink's warnings
 * and losses. On failure all files are as they were before. */
bool gis_deliver(const gis_delivery *delivery, gis_error *error);

#endif
