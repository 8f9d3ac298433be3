/* gis_error.h: messages for the user: one sentence for a failure, and lists of sentences (losses, warnings).
 *
 * Functions of gis/ that can fail return false and fill a gis_error. Only commands print them. */
#ifndef GIS_ERROR_H
#define GIS_ERROR_H

#include <stdbool.h>
#include <stddef.h>

#include "base/exit_status.h"

/* The message if a signal ended the work, wherever it was noticed; gis_interruption() may add the reason. */
#define GIS_INTERRUPTED "interrupted"

/* Buffer size for what a message is about, such as "layer buildings, FID 12"; longer names are cut. */
enum { GIS_WHO_SIZE = 512 };

typedef struct gis_error {
    int exit_status; /* GIS_FAILED or GIS_USAGE */
    bool no_memory;  /* the only cause was a lack of memory */
    bool in_a_box;   /* GDAL failed to compare geometries with a box; reading without the box may succeed */
    char message[1024];
} gis_error;

/* Each fills *error (if not NULL) with one line and returns false, so that a function can end with `return
 * gis_fail(...)`. After a signal the message is that of the interruption, since system calls that were interrupted fail
 * for all kinds of reasons. */
bool gis_fail(gis_error *error, const char *format, ...) __attribute__((format(printf, 2, 3)));
bool gis_fail_usage(gis_error *error, const char *format, ...) __attribute__((format(printf, 2, 3)));
bool gis_no_memory(gis_error *error);
/* Returns true if this is the error of an interruption. */
bool gis_is_interruption(const gis_error *error);

/* Makes a message one line without blanks at its end; texts of GDAL and SQLite sometimes contain line breaks. */
void gis_make_one_line(char *text);

/* A list of distinct sentences in the order of their first appearance. A zeroed struct is an empty list. */
typedef struct gis_sentences {
    char **items; /* n sentences; items[n] is not defined */
    size_t n, capacity;
} gis_sentences;

/* Appends a sentence unless the list contains it. Returns false if out of memory. */
bool gis_sentences_add(gis_sentences *list, const char *format, ...) __attribute__((format(printf, 2, 3)));
void gis_sentences_clear(gis_sentences *list);

/* Collects what GDAL reports in this thread, instead of printing it: the text of the first failure, the number of
 * failures, and all warnings. Listeners nest; between begin and end the struct must not move in memory. */
typedef struct gis_listener {
    size_t failures;
    char first[512];
    gis_sentences warnings;
} gis_listener;

void gis_listen_begin(gis_listener *listener);
/* Stops listening. The collected reports stay readable until gis_listener_clear(). */
void gis_listen_end(void);
void gis_listener_clear(gis_listener *listener);
/* Returns the text of the first failure; `otherwise` if there was none. */
const char *gis_listener_reason(const gis_listener *listener, const char *otherwise);

#endif
