/* source_files.h: which files does a path read? */
#ifndef GIS_SOURCE_FILES_H
#define GIS_SOURCE_FILES_H

#include "read/source.h"

/* Would writing `file` change what is read from `path`? True if both are the same file, under whatever names, or if
 * `file` is an archive or compressed file through which `path` is read by GDAL's virtual paths (/vsizip/a.zip/b.gpkg is
 * in a.zip). If a file does not exist yet the names are compared. */
bool gis_path_lies_in(const char *path, const char *file);

/* The same for all files of an open source; false if source is NULL. */
bool gis_source_lies_in(const gis_source *source, const char *file);

/* Fails if writing the output would replace this source (NULL: there is none); an update only adds to it. */
bool gis_source_spare(const gis_source *source, const char *output, bool update, gis_error *error);

#endif
