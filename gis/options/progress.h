/* progress.h: how far a run is, and what it took. */
#ifndef GIS_PROGRESS_H
#define GIS_PROGRESS_H

#include <stdint.h>

#include "options/options.h"

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

/* Seconds of a clock that never goes back. */
double gis_clock(void);
/* The greatest amount of memory that the process has held. */
uint64_t gis_peak_rss(void);

#endif
