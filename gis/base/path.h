/* path.h: joins and divides paths of files, of any length.
 *
 * GDAL's functions for this (CPLFormFilename(), CPLGetPath(), ...) are limited to 2,047 bytes, and return "" for a
 * longer path, which is another file; CPLSPrintf() cuts texts at 8,000. So this program calls none of them (tests/house
 * checks that). But GDAL's drivers do, so a dataset with a longer path is refused (gis_path_suits_gdal()). */
#ifndef GIS_PATH_H
#define GIS_PATH_H

#include "base/gis_error.h"

/* Formats like printf(). If memory is out it ends the program, as GDAL's allocating functions do. All results of these
 * functions are freed with CPLFree(). */
char *gis_printed(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* DIRECTORY/NAME; NAME alone if the directory is "". */
char *gis_path_join(const char *directory, const char *name);
/* Everything before the last slash: "/" for a file in the root directory, "" for a name alone. */
char *gis_path_directory(const char *path);
/* Everything after the last slash; points into `path`. */
const char *gis_path_name(const char *path);
/* Everything after the last dot of the name, "" if there is none; points into `path`. */
const char *gis_path_extension(const char *path);
/* The name without its last dot and what follows it. */
char *gis_path_stem(const char *path);
/* The current directory; NULL if it cannot be determined. */
char *gis_path_here(void);

/* The longest path accepted for a dataset: about 140 bytes are left for what a run or a driver inserts or appends (the
 * name of a stage, _displacement, -journal, another extension). */
enum { GIS_PATH_LONGEST = 1900 };
/* Fails if the path is longer than GDAL's drivers accept; `what` names it in the message. Data given as text (beginning
 * with {, [ or <) is not a path. */
bool gis_path_suits_gdal(const char *path, const char *what, gis_error *error);

#endif
