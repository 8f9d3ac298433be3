/* text_file.h: writes a text into a file in two steps, so that everything that can fail has failed before anything is
 * changed.
 *
 *  gis_text_file_write   writes to a temporary file beside the final one
 *  gis_text_file_place   renames it; an existing file is moved aside
 *  gis_text_file_end     keep: removes the file moved aside; else restores it. Always to be called. */
#ifndef GIS_TEXT_FILE_H
#define GIS_TEXT_FILE_H

#include "base/interrupt.h"

#include <stdio.h>

typedef struct gis_text_file {
    char *path;      /* with links resolved: the link stays, and its target is replaced */
    char *temporary; /* NULL: not made, or the file is a pipe or a device */
    char *former;    /* path to which the existing file was moved (TEMPORARY~); NULL: it was not moved */
    bool placed;
    gis_leftover *leftover, *former_leftover; /* register the files, so that a signal removes or restores them */
} gis_text_file;

/* Writes the whole text to a stream. False: *error is set, or writing to the stream failed (ferror()). */
typedef bool gis_text_writer(const void *of, FILE *to, gis_error *error);

/* Writes the temporary file; start from a zeroed struct. A pipe or a device (/dev/stdout, /dev/null) cannot be replaced
 * by a rename, so it is written at once. `what` is the option that names the file, for messages. */
bool gis_text_file_write(gis_text_file *file, const char *path, gis_text_writer *write, const void *of,
                         const char *what, gis_error *error);
bool gis_text_file_place(gis_text_file *file, const char *what, gis_error *error);
void gis_text_file_end(gis_text_file *file, bool keep);

#endif
