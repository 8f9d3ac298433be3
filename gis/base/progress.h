/* progress.h: prints the progress of a run to stderr. */
#ifndef GIS_PROGRESS_H
#define GIS_PROGRESS_H

#include <stdbool.h>

/* Prints nothing, a bar like GDAL's, or whole percents on lines of their own. */
typedef enum gis_progress_kind { GIS_PROGRESS_NONE, GIS_PROGRESS_BAR, GIS_PROGRESS_PLAIN } gis_progress_kind;

/* A stage whose name the bar shows. */
typedef struct gis_progress_name {
    double from; /* where it begins, as a fraction of the whole */
    const char *word;
} gis_progress_name;

typedef struct gis_progress {
    gis_progress_kind kind;
    double from, to;               /* the range of the whole to which a callback's fraction of 0 to 1 is mapped */
    int shown;                     /* the last value printed; -1: none */
    const gis_progress_name *name; /* the stages not yet named, ascending, ended by one without a word; NULL: none */
} gis_progress;

gis_progress gis_progress_new(gis_progress_kind kind);
/* Sets the names of stages that a bar shows, ascending, ended by one without a word; borrowed. */
void gis_progress_names(gis_progress *progress, const gis_progress_name *name);
/* Begins a stage that covers the range from `from` to `to` of the whole. */
void gis_progress_stage(gis_progress *progress, double from, double to);
/* A sunder_progress callback; `user` is a gis_progress. Returns false after a signal. */
bool gis_progress_call(double fraction, void *user);
/* Ends the current line of progress, so that a message on stderr begins on a new line. */
void gis_progress_break(void);
/* Prints the end of the progress. */
void gis_progress_done(gis_progress *progress);

#endif
