/* report.h: pieces that the reports of several commands share: clocks, memory, operation counts, progress. */
#ifndef GIS_REPORT_H
#define GIS_REPORT_H

#include "json.h"
#include "operand.h"
#include "sink.h"
#include "sunder.h"

/* Seconds of a clock that never goes back. */
double gis_clock(void);
/* The greatest amount of memory that the process has held. */
uint64_t gis_peak_rss(void);

/* A time, to the nanosecond: more digits would be noise. */
void gis_json_seconds(gis_json *out, const char *key, double seconds);
void gis_json_operations(gis_json *out, const sunder_operations *operations);
void gis_json_conflict_counts(gis_json *out, const sunder_conflict_counts *counts);

/* Where --stats goes; NULL if nowhere. */
const char *gis_stats_path(const gis_options *options);
/* Can the file of --stats be made? Asked before the work, so that its failure does not come when all is done. */
bool gis_stats_check(const gis_options *options, gis_error *error);
/* Is anything in conflict between blocks? */
bool gis_any_conflict(const sunder_conflict_counts *counts);
/* Is standard output taken by JSON (--stats -) or by the layer (/vsistdout/), so that no summary may go there? Both at
 * once is wrong usage. */
bool gis_stdout_taken(const gis_options *options, const char *output, bool *taken, gis_error *error);

/* From here on SIGINT and SIGTERM do not end the process but make gis_interrupted() true (and the next one ends it), so
 * that temporary files go. */
void gis_catch_signals(void);
bool gis_interrupted(void);

/* Progress on stderr, as the options ask: none, a bar in GDAL's manner, or whole percents, a line each. */
typedef struct gis_progress {
    enum { GIS_PROGRESS_NONE, GIS_PROGRESS_BAR, GIS_PROGRESS_PLAIN } kind;
    double from, to; /* the part of the whole that the callback's [0, 1] stands for */
    int shown;       /* what was printed last; -1: nothing */
} gis_progress;

gis_progress gis_progress_of(const gis_options *options);
/* The next stage covers [from, to] of the whole. */
void gis_progress_stage(gis_progress *progress, double from, double to);
/* A sunder_progress; user is a gis_progress. False when a signal asked to stop. */
bool gis_progress_call(double fraction, void *user);
void gis_progress_done(gis_progress *progress);

/* The options of the output; `main_layer` is its name unless --output-layer says another. */
gis_sink_request gis_options_sink(const gis_options *options, const char *path, const char *main_layer);

/* Commits, and prints what the sink has to warn of: warnings, losses. */
bool gis_output_finish(gis_sink *sink, gis_sink_result *result, gis_error *error);

#endif
