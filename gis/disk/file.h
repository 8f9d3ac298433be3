/* file.h: a file of a spool: written to a temporary one in the directory, read at any place. What fails names it. */
#ifndef GIS_DISK_FILE_H
#define GIS_DISK_FILE_H

#include "base/interrupt.h"

#include <stdint.h>
#include <stdio.h>

/* Zeroed: none. */
typedef struct gis_disk_file {
    char *path;
    FILE *stream;
    char *buffer;           /* the stream's, if it is written */
    uint64_t size;          /* bytes written, or there */
    gis_leftover *leftover; /* of a temporary one */
} gis_disk_file;

/* The path of what is called that in a directory; NULL if memory is out. Freed with free(). */
char *gis_disk_path(const char *directory, const char *name);

/* A new one; what an earlier run left of that name is replaced. It goes when closed, unless it was placed. A name that
 * ends with XXXXXX gets other letters there, so that it is no file's: for what several processes make at once
 * (disk/temporary.h). */
bool gis_disk_file_create(gis_disk_file *file, const char *directory, const char *name, gis_error *error);
bool gis_disk_file_write(gis_disk_file *file, const void *bytes, size_t n, gis_error *error);
/* All that was written can be read from now on, and is not written on. */
bool gis_disk_file_flush(gis_disk_file *file, gis_error *error);
/* On the disk, and then by that name; it is closed. */
bool gis_disk_file_place(gis_disk_file *file, const char *directory, const char *name, gis_error *error);

bool gis_disk_file_open(gis_disk_file *file, const char *directory, const char *name, gis_error *error);
/* n bytes from a place on; fewer are an error. */
bool gis_disk_file_read(gis_disk_file *file, uint64_t from, void *to, size_t n, gis_error *error);
void gis_disk_file_close(gis_disk_file *file);

#endif
