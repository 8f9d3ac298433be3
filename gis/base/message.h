/* message.h: what the program says on stderr: warnings, and the one error that a run ends with. One line each, in words
 * or as JSON (--messages); of many warnings of one kind the first few, and at the end how many more there were. A log
 * (--log) holds all of them. */
#ifndef GIS_MESSAGE_H
#define GIS_MESSAGE_H

#include "base/gis_error.h"

#include <stdint.h>

/* What a warning is about; in JSON a word. */
typedef enum gis_message_kind {
    GIS_MESSAGE_INVALID,   /* a geometry that breaks the rules of polygons */
    GIS_MESSAGE_ARCS,      /* arcs that are taken as polylines */
    GIS_MESSAGE_CRS,       /* coordinates that are no lengths, or of no known system */
    GIS_MESSAGE_PASSED_BY, /* features that the command does nothing with */
    GIS_MESSAGE_INPUT,     /* GDAL's messages about input */
    GIS_MESSAGE_OUTPUT,    /* GDAL's messages about output */
    GIS_MESSAGE_LOSS,      /* what the output's format does not hold */
    GIS_MESSAGE_REMAINS,   /* what a run that was ended has left */
    GIS_MESSAGE_MEMORY,    /* what takes more than --max-memory */
    GIS_MESSAGE_GDAL,      /* what GDAL says elsewhere */
    GIS_MESSAGE_N
} gis_message_kind;

typedef struct gis_messages_request {
    bool json;       /* a JSON object a line, not words */
    bool quiet;      /* warnings are suppressed; errors are printed */
    const char *log; /* NULL, or the file that holds all of them; a former log is replaced, another file is not */
} gis_messages_request;

/* How messages are said from here on; before the first call as if all were zero. May be called again as long as no log
 * is open. */
bool gis_messages_begin(const gis_messages_request *request, gis_error *error);
/* Says how many more there were, and closes the log; false if it could not be written. */
bool gis_messages_end(gis_error *error);

/* "sunder: warning: ...", exactly one line: line breaks and other control characters inside become spaces. */
void gis_say_warning(gis_message_kind kind, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* "sunder: error: ...", likewise; returns the exit status of the error, which is the run's. */
int gis_say_failure(const gis_error *error);

/* Each sentence of the list as a warning; none once a signal has come. Those count as of one kind that differ in
 * numbers alone. */
void gis_say_warnings(gis_message_kind kind, const gis_sentences *list);

/* A feature, for messages. */
typedef struct gis_subject {
    const char *within; /* what the layer belongs to ("barrier roads.gpkg"), or NULL */
    const char *layer;
    bool has_fid;
    int64_t fid;
    size_t number;  /* from 0 on: what it is called by where it has no FID */
    const char *id; /* the user's own key, or NULL */
} gis_subject;

/* "layer NAME, FID 12 (id KEY)". A message of this thread that names the subject last asked for so has its parts
 * apart, in JSON. */
void gis_name_subject(const gis_subject *subject, char *text, size_t size);

#endif
