/* shape_text.h: shapes that are written on a command line or in a field: WKT, @FILE, @-, disc:, inside-disc:, square:,
 * rectangle:. */
#ifndef GIS_SHAPE_TEXT_H
#define GIS_SHAPE_TEXT_H

#include "base/length.h"
#include "read/validity.h"

/* Is it anything but a data source? */
bool gis_shape_is_text(const char *text);

/* Reads a SHAPE that is a text (gis_shape_is_text()); `units` converts lengths inside. `who` and the text open
 * messages. A repair gives a warning. Adds the time from coordinates in memory to the shape to *building, unless that
 * is NULL. */
bool gis_shape_from_text(const char *text, const char *who, const gis_crs_units *units, gis_invalid_policy policy,
                         sunder_shape **out, double *building, gis_error *error);

/* The parts of that: all of a file, or of standard input with "-", to be freed; a WKT with polygons; and "P (disc:4)",
 * where long texts are cut at the end of a character. */
bool gis_shape_read_file(const char *name, const char *who, char **text, gis_error *error);
bool gis_shape_of_wkt(const char *text, const char *who, gis_invalid_policy policy, sunder_shape **out,
                      double *building, gis_error *error);
enum { GIS_SHAPE_NAME_SIZE = GIS_WHO_SIZE + 128 };
void gis_shape_name(const char *who, const char *text, char *name, size_t size);

/* The standard shape ("disc:") that a text with a misspelt one was probably to be; NULL: none. */
const char *gis_shape_prefix_meant(const char *text);

#endif
