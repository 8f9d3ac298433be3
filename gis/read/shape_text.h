/* shape_text.h: reads shapes that are written on the command line or in a field: WKT, @FILE, @-, disc:, inside-disc:,
 * square:, rectangle:. */
#ifndef GIS_SHAPE_TEXT_H
#define GIS_SHAPE_TEXT_H

#include "base/length.h"
#include "read/validity.h"

/* Is it a shape as text, and not a data source? */
bool gis_shape_is_text(const char *text);

/* Reads a SHAPE that is a text (gis_shape_is_text()); `units` converts lengths in it. `who` and the text begin
 * messages. A repair gives a warning. Adds the time for making the shape from coordinates in memory to *building,
 * unless that is NULL. */
bool gis_shape_from_text(const char *text, const char *who, const gis_crs_units *units, gis_invalid_policy policy,
                         sunder_shape **out, double *building, gis_error *error);

/* Its steps: read all of a file, or of standard input ("-"), into *text, which the caller frees; make a shape of WKT
 * with polygons; write "P (disc:4)", with long texts cut at the end of a character. */
bool gis_shape_read_file(const char *name, const char *who, char **text, gis_error *error);
bool gis_shape_of_wkt(const char *text, const char *who, gis_invalid_policy policy, sunder_shape **out,
                      double *building, gis_error *error);
enum { GIS_SHAPE_NAME_SIZE = GIS_WHO_SIZE + 128 };
void gis_shape_name(const char *who, const char *text, char *name, size_t size);

/* The standard shape (such as "disc:") that was probably meant by a text with a misspelt one; NULL: none. */
const char *gis_shape_prefix_meant(const char *text);

#endif
