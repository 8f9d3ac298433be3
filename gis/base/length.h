/* length.h: lengths as users write them, and their value in the units of a layer.
 *
 * A bare number is in the layer's units. m, km, ft (international), us-ft are converted by the linear unit of the
 * layer's CRS; mm is on the sheet, and needs --scale. */
#ifndef GIS_LENGTH_H
#define GIS_LENGTH_H

#include <stdbool.h>
#include <stddef.h>

#include "base/gis_error.h"

typedef enum gis_length_unit {
    GIS_LAYER_UNIT,
    GIS_METRE,
    GIS_KILOMETRE,
    GIS_FOOT,
    GIS_US_FOOT,
    GIS_SHEET_MILLIMETRE
} gis_length_unit;

typedef struct gis_length {
    double value; /* finite, >= 0 */
    gis_length_unit unit;
} gis_length;

/* An optional length. */
typedef struct gis_optional_length {
    const char *text; /* as it was written; NULL: not given */
    gis_length length;
} gis_optional_length;

/* What a layer's CRS says about its coordinates, and the scale of the map. */
typedef struct gis_crs_units {
    bool has_crs;
    bool geographic;    /* coordinates are angles: no length but zero has a meaning */
    double unit_metres; /* metres in one unit of a projected CRS */
    double scale;       /* N of 1:N, 0 if not given */
} gis_crs_units;

/* Reads a finite decimal number (no inf, nan or hexadecimal) that fills text[0..n). */
bool gis_length_parse_number(const char *text, size_t n, double *value);

/* Reads a length that fills text[0..n). On failure *why is a short reason, and out is untouched. */
bool gis_length_parse(const char *text, size_t n, gis_length *out, const char **why);

/* The length in the units of the layer. The message of a failure names `what`, the option or operand, and says
 * what to do. */
bool gis_length_in_layer_units(const gis_length *given, const gis_crs_units *units, const char *what, double *out,
                               gis_error *error);
/* The same of one that may not be given: then *out stays as it is. */
bool gis_optional_length_in_layer_units(const gis_optional_length *given, const gis_crs_units *units, const char *what,
                                        double *out, gis_error *error);

#endif
