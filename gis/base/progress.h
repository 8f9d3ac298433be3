/* progress.h: how far a run is, on stderr. */
#ifndef GIS_PROGRESS_H
#define GIS_PROGRESS_H

#include <stdbool.h>

/* Nothing, a bar in GDAL's manner, or whole percents, a line each. */
typedef enum gis_progress_kind { GIS_PROGRESS_NONE, GIS_PROGRESS_BAR, GIS_PROGRESS_PLAIN } gis_progress_kind;

/* A stage that a bar names. */
typedef struct gis_progress_name {
    double from; /* as a part of the whole */
    const char *word;
} gis_progress_name;

typedef struct gis_progress {
    gis_progress_kind kind;
    double from, to; /* the part of the whole that the callback's [0, 1] stands for */
    int shown;       /* the last value printed; -1: none */
    const gis_progress_name
        *name; /* stages that are still to be named, ascending, up to one without a word; NULL: none */
} gis_progress;

gis_progress gis_progress_new(gis_progress_kind kind);
/* The stages that a bar is to name, up to one without a word; borrowed. */
void gis_progress_names(gis_progress *progress, const gis_progress_name *name);
/* The next stage covers [from, to] of the whole. */
void gis_progress_stage(gis_progress *progress, double from, double to);
/* A sunder_progress; user is a gis_progress. False when a signal asked to stop. */
bool gis_progress_call(double fraction, void *user);
/* Ends the current line of progress, so that another message on stderr begins its own line. */
void gis_progress_break(void);
/* All is done: a bar ends with the word for it. */
void gis_progress_done(gis_progress *progress);

#endif
