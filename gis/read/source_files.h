/* source_files.h: which files a path reads. */
#ifndef GIS_SOURCE_FILES_H
#define GIS_SOURCE_FILES_H

#include "read/source.h"

/* Would writing the file at `file` change what is read under `path`? It would if both are the same file, by any name;
 * or if one is an archive or a compressed file through which the other is read by GDAL's virtual paths
 * (/vsizip/a.zip/b.gpkg lies in a.zip). If a file does not exist yet the names are compared. */
bool gis_path_lies_in(const char *path, const char *file);

/* The same for all files of an open source. NULL: false. */
bool gis_source_lies_in(const gis_source *source, const char *file);

/* False, with an error, if writing the output would replace this source (NULL: there is none). An update adds to it. */
bool gis_source_spare(const gis_source *source, const char *output, bool update, gis_error *error);

#endif
