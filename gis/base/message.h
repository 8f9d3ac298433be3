/* message.h: the messages of a run on stderr: warnings, and the error that ends a run. Each is one line, as words or as
 * JSON (--messages); of similar warnings only the first few are printed, and at the end the number of the others. A log
 * (--log) contains all of them. */
#ifndef GIS_MESSAGE_H
#define GIS_MESSAGE_H

#include "base/gis_error.h"

#include <stdint.h>

/* The kind of a warning, which JSON gives as a word. */
typedef enum gis_message_kind {
    GIS_MESSAGE_INVALID,   /* an invalid polygon */
    GIS_MESSAGE_ARCS,      /* arcs that are replaced by polylines */
    GIS_MESSAGE_CRS,       /* coordinates in degrees, or in an unknown CRS */
    GIS_MESSAGE_PASSED_BY, /* features that the command ignores */
    GIS_MESSAGE_INPUT,     /* GDAL's messages about input */
    GIS_MESSAGE_OUTPUT,    /* GDAL's messages about output */
    GIS_MESSAGE_LOSS,      /* what the output's format cannot hold */
    GIS_MESSAGE_REMAINS,   /* files left by a run that was killed */
    GIS_MESSAGE_MEMORY,    /* work that needs more than --max-memory */
    GIS_MESSAGE_GDAL,      /* other messages of GDAL */
    GIS_MESSAGE_N
} gis_message_kind;

typedef struct gis_messages_request {
    bool json;       /* print JSON objects instead of words */
    bool quiet;      /* warnings are suppressed; errors are printed */
    const char *log; /* the log file, or NULL; an earlier log is replaced, any other file is not */
} gis_messages_request;

/* Sets how messages are printed from now on; before the first call all members count as zero. May be called again as
 * long as no log is open. */
bool gis_messages_begin(const gis_messages_request *request, gis_error *error);
/* Prints the numbers of warnings that were not printed, and closes the log; false if writing the log failed. */
bool gis_messages_end(gis_error *error);

/* Prints "sunder: warning: ..." as one line; line breaks and other control characters become blanks. */
void gis_say_warning(gis_message_kind kind, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Prints "sunder: error: ..." as one line; returns the exit status of the error, which is that of the run. */
int gis_say_failure(const gis_error *error);

/* Prints each sentence of the list as a warning; none after a signal. Sentences that differ only in numbers count as
 * similar. */
void gis_say_warnings(gis_message_kind kind, const gis_sentences *list);

/* A feature, for naming it in messages. */
typedef struct gis_subject {
    const char *within; /* what the layer belongs to ("barrier roads.gpkg"), or NULL */
    const char *layer;
    bool has_fid;
    int64_t fid;
    size_t number;  /* from 0; names a feature without a FID */
    const char *id; /* value of --id-field, or NULL */
} gis_subject;

/* Writes "layer NAME, FID 12 (id KEY)". If a message of this thread contains the name that was written last, JSON gives
 * layer, FID and id as separate members. */
void gis_name_subject(const gis_subject *subject, char *text, size_t size);

#endif
