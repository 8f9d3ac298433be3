/* path.h: paths of files, put together and taken apart, whatever their length.
 *
 * GDAL's functions for this (CPLFormFilename(), CPLGetPath(), ...) have room for 2,047 bytes, and answer "" for what is
 * longer, which is another file; CPLSPrintf() cuts texts at 8,000. So none of them is called by this program (a test,
 * tests/house, looks for them). But GDAL's drivers call them: a dataset is refused whose path is longer than they can
 * hold (gis_path_suits_gdal()). */
#ifndef GIS_PATH_H
#define GIS_PATH_H

#include "base/gis_error.h"

/* As printf() prints it; memory that runs out ends the program, as in all functions of GDAL's that allocate. What these
 * functions give is freed with CPLFree(). */
char *gis_printed(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* DIRECTORY/NAME; the name alone where the directory is "". */
char *gis_path_join(const char *directory, const char *name);
/* What stands before the last slash: "/" of a file in the root, "" of a name alone. */
char *gis_path_directory(const char *path);
/* What follows the last slash; a part of the path. */
const char *gis_path_name(const char *path);
/* What follows the last dot of the name, "" if there is none; a part of the path. */
const char *gis_path_extension(const char *path);
/* The name without its last dot and what follows that. */
char *gis_path_stem(const char *path);
/* The current directory; NULL if it cannot be determined. */
char *gis_path_here(void);

/* The longest path of a dataset: some 140 bytes are left for what a run or a driver puts into it or behind it (the
 * name of a stage, _displacement, -journal, another extension). */
enum { GIS_PATH_LONGEST = 1900 };
/* False: the path is longer than GDAL takes; `what` names it in the sentence. Data that is given as text ({, [, <) is
 * no path. */
bool gis_path_suits_gdal(const char *path, const char *what, gis_error *error);

#endif
