/* text_file.h: a text put into a file in two steps, so that what can fail has failed before anything is changed.
 *
 *   gis_text_file_write   to a temporary file beside it
 *   gis_text_file_place   renamed; what stood there steps aside
 *   gis_text_file_end     kept: what stood there goes. Not kept: all is as before. Always called. */
#ifndef GIS_TEXT_FILE_H
#define GIS_TEXT_FILE_H

#include "base/interrupt.h"

#include <stdio.h>

typedef struct gis_text_file {
    char *path;      /* with links resolved: the link stays, and its target is replaced */
    char *temporary; /* NULL: there is none (yet, any more, or since the file is a pipe or a device) */
    char *former;    /* where the former file waits: TEMPORARY~; NULL: nowhere */
    bool placed;
    gis_leftover *leftover, *former_leftover; /* the same, for a signal */
} gis_text_file;

/* Writes all of it. False: with an error, or because the file could not be written, which that knows. */
typedef bool gis_text_writer(const void *of, FILE *to, gis_error *error);

/* Start from a zeroed struct. A pipe or a device (/dev/stdout, /dev/null) cannot be renamed over: it is written at
 * once. `what` names the file's role in the messages. */
bool gis_text_file_write(gis_text_file *file, const char *path, gis_text_writer *write, const void *of,
                         const char *what, gis_error *error);
bool gis_text_file_place(gis_text_file *file, const char *what, gis_error *error);
void gis_text_file_end(gis_text_file *file, bool keep);

#endif
