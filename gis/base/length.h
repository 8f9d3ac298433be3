/* length.h: lengths as users write them, and their values in the units of a layer.
 *
 * A bare number is in the layer's units. m, km, ft (international) and us-ft are converted with the linear unit of the
 * layer's CRS; mm is measured on the map sheet, and needs --scale. */
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

/* A length that may be missing. */
typedef struct gis_optional_length {
    const char *text; /* as the user wrote it; NULL: not given */
    gis_length length;
} gis_optional_length;

/* What a layer's CRS says about its coordinates, and the scale of the map. */
typedef struct gis_crs_units {
    bool has_crs;
    bool geographic;    /* coordinates are angles, so that only the length 0 has a meaning */
    double unit_metres; /* metres in one unit of a projected CRS */
    double scale;       /* N of the scale 1:N; 0 if not given */
} gis_crs_units;

/* Parses text[0..n) as a finite decimal number (not inf, nan or hexadecimal). */
bool gis_length_parse_number(const char *text, size_t n, double *value);

/* Parses text[0..n) as a length. On failure *why is a short reason, and *out is unchanged. */
bool gis_length_parse(const char *text, size_t n, gis_length *out, const char **why);

/* Converts a length to the layer's units. `what` names the option or operand in the error message, which says what to
 * do. */
bool gis_length_in_layer_units(const gis_length *given, const gis_crs_units *units, const char *what, double *out,
                               gis_error *error);
/* The same for an optional length: if it is not given, *out is unchanged. */
bool gis_optional_length_in_layer_units(const gis_optional_length *given, const gis_crs_units *units, const char *what,
                                        double *out, gis_error *error);

#endif
