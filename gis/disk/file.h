/* file.h: a file on disk that is written under a temporary name and read at any offset. Error messages name it. */
#ifndef GIS_DISK_FILE_H
#define GIS_DISK_FILE_H

#include "base/interrupt.h"

#include <stdint.h>
#include <stdio.h>

/* A zeroed struct is closed. */
typedef struct gis_disk_file {
    char *path;
    FILE *stream;
    char *buffer;           /* the stream's buffer, if the file is written */
    uint64_t size;          /* bytes written, or size of the file */
    gis_leftover *leftover; /* for a temporary file, so that a signal removes it */
} gis_disk_file;

/* Returns the path of `name` in a directory, which the caller frees with free(); NULL if out of memory. */
char *gis_disk_path(const char *directory, const char *name);

/* Creates a file, in place of one that an earlier run left under this name. It is removed when it is closed, unless
 * gis_disk_file_place() was called. In a name that ends with XXXXXX these letters are replaced by others so that the
 * name is unique, for files that several processes make at once (disk/temporary.h). */
bool gis_disk_file_create(gis_disk_file *file, const char *directory, const char *name, gis_error *error);
bool gis_disk_file_write(gis_disk_file *file, const void *bytes, size_t n, gis_error *error);
/* Makes everything written readable; nothing may be written afterwards. */
bool gis_disk_file_flush(gis_disk_file *file, gis_error *error);
/* Syncs the file, renames it to `name` in the directory, and closes it. */
bool gis_disk_file_place(gis_disk_file *file, const char *directory, const char *name, gis_error *error);

bool gis_disk_file_open(gis_disk_file *file, const char *directory, const char *name, gis_error *error);
/* Reads n bytes from offset `from`; fails if there are fewer. */
bool gis_disk_file_read(gis_disk_file *file, uint64_t from, void *to, size_t n, gis_error *error);
void gis_disk_file_close(gis_disk_file *file);

#endif
