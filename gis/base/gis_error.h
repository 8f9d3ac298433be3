/* gis_error.h: what the GIS side tells a person: one sentence on failure, and lists of sentences (losses, warnings).
 *
 * Functions of gis/ that can fail return false and fill a gis_error. Printing is the commands' business. */
#ifndef GIS_ERROR_H
#define GIS_ERROR_H

#include <stdbool.h>
#include <stddef.h>

#include "base/exit_status.h"

/* What is said when a signal ended the work, whatever noticed it first; gis_interruption() may add why. */
#define GIS_INTERRUPTED "interrupted"

/* Room for what a message is about: "layer buildings, FID 12"; longer names are cut. */
enum { GIS_WHO_SIZE = 512 };

typedef struct gis_error {
    int exit_status; /* GIS_FAILED or GIS_USAGE */
    bool no_memory;  /* that is all that failed: neither the call nor the data is at fault */
    bool in_a_box;   /* reading failed while GDAL compared geometries with a box; without the box it may not fail */
    char message[1024];
} gis_error;

/* Fills *error (if not NULL), flattening line breaks, so that a function can end with `return gis_fail(...)`. Once a
 * signal has come the sentence is that of the interruption: calls that were cut short by it fail for reasons of all
 * kinds. */
bool gis_fail(gis_error *error, const char *format, ...) __attribute__((format(printf, 2, 3)));
bool gis_fail_usage(gis_error *error, const char *format, ...) __attribute__((format(printf, 2, 3)));
bool gis_no_memory(gis_error *error);
/* Is it that of an interruption? */
bool gis_is_interruption(const gis_error *error);

/* A list of distinct sentences in the order of their first appearance. A zeroed struct is an empty list. */
typedef struct gis_sentences {
    char **items; /* n of them; items[n] is not defined */
    size_t n, capacity;
} gis_sentences;

/* Appends unless the very sentence is there already; false if memory is out. */
bool gis_sentences_add(gis_sentences *list, const char *format, ...) __attribute__((format(printf, 2, 3)));
void gis_sentences_clear(gis_sentences *list);

/* Listens to what GDAL reports in this thread, instead of letting it print: the first failure (its words), how many
 * failures, and all warnings. Listeners nest; between begin and end the struct must stay where it is. */
typedef struct gis_listener {
    size_t failures;
    char first[512];
    gis_sentences warnings;
} gis_listener;

void gis_listen_begin(gis_listener *listener);
/* Stops listening. What was heard stays readable until gis_listener_clear(). */
void gis_listen_end(void);
void gis_listener_clear(gis_listener *listener);
/* The first failure heard, else `otherwise`. */
const char *gis_listener_reason(const gis_listener *listener, const char *otherwise);

#endif
