/* length.c: see length.h. Conversions cancel equal units: 10us-ft on a layer in US survey feet is exactly the double
 * 10, not 10 * (1200 / 3937) / 0.304800609601219. */
#include "base/length.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The metres in a unit as numerator / denominator; both are exact doubles. */
typedef struct unit {
    const char *suffix;
    gis_length_unit unit;
    double numerator, denominator;
} unit;

static const unit known_units[] = {
    {"", GIS_LAYER_UNIT, 1, 1},         {"m", GIS_METRE, 1, 1},
    {"km", GIS_KILOMETRE, 1000, 1},     {"ft", GIS_FOOT, 3048, 10000},
    {"us-ft", GIS_US_FOOT, 1200, 3937}, {"mm", GIS_SHEET_MILLIMETRE, 1, 1000},
};
#define N_UNITS (sizeof known_units / sizeof known_units[0])

/* CRS definitions give their unit as a decimal with about ten digits; units that agree to this relative difference are
 * the same (the international and the US foot differ by 2e-6). */
static const double same_unit = 1e-9;

bool gis_length_parse_number(const char *text, size_t n, double *value)
{
    char digits[64];
    if (n == 0 || n >= sizeof digits) return false;
    for (size_t i = 0; i < n; i++)
        if (!strchr("0123456789+-.eE", text[i]) || text[i] == '\0') return false;
    memcpy(digits, text, n);
    digits[n] = '\0';
    char *end;
    double read = strtod(digits, &end);
    if (end != digits + n || !isfinite(read)) return false;
    *value = read;
    return true;
}

/* The length of the number at the beginning of the text: everything up to a letter of a unit. An e belongs to the
 * number if a digit or a sign follows. */
static size_t number_part(const char *text, size_t n)
{
    size_t i = 0;
    while (i < n && (strchr("0123456789+-.", text[i]) ||
                     ((text[i] == 'e' || text[i] == 'E') && i + 1 < n && strchr("0123456789+-", text[i + 1]))))
        i++;
    return i;
}

bool gis_length_parse(const char *text, size_t n, gis_length *out, const char **why)
{
    size_t split = number_part(text, n);
    double value;
    if (!gis_length_parse_number(text, split, &value)) {
        *why = "not a finite number, with or without a unit (m, km, ft, us-ft, mm)";
        return false;
    }
    if (value < 0) {
        *why = "negative";
        return false;
    }
    for (size_t u = 0; u < N_UNITS; u++) {
        if (strlen(known_units[u].suffix) == n - split && memcmp(text + split, known_units[u].suffix, n - split) == 0) {
            *out = (gis_length){value == 0 ? 0.0 : value, known_units[u].unit};
            return true;
        }
    }
    *why = "unknown unit; known are m, km, ft, us-ft, and mm on the sheet";
    return false;
}

/* Is the unit this many metres long? */
static bool is_unit(const unit *candidate, double metres)
{
    double own = candidate->numerator / candidate->denominator;
    return fabs(own - metres) <= same_unit * own;
}

bool gis_length_in_layer_units(const gis_length *given, const gis_crs_units *units, const char *what, double *out,
                               gis_error *error)
{
    if (given->value == 0) { /* 0 needs no unit, also on a layer with angular coordinates */
        *out = 0;
        return true;
    }
    if (units->geographic) {
        return gis_fail(error,
                        "%s: the layer's coordinates are degrees, in which no length can be measured; "
                        "reproject it first (ogr2ogr -t_srs)",
                        what);
    }
    if (given->unit == GIS_LAYER_UNIT) {
        *out = given->value;
        return true;
    }
    if (given->unit == GIS_SHEET_MILLIMETRE && units->scale == 0) {
        return gis_fail(error, "%s: mm are measured on the sheet; give the map's scale, as in --scale 25000", what);
    }
    if (!units->has_crs) {
        return gis_fail(error,
                        "%s: the layer has no CRS, so the length cannot be converted to its unit; give the length "
                        "without a unit, or give the layer a CRS (--input-crs)",
                        what);
    }
    size_t from = 0, to = 0;
    while (known_units[from].unit != given->unit) from++;
    while (to < N_UNITS && !is_unit(&known_units[to], units->unit_metres)) to++;
    double value = given->value;
    if (given->unit == GIS_SHEET_MILLIMETRE) value *= units->scale;
    if (to == N_UNITS) /* not in the table: use the factor that the CRS gives */
        value = value * known_units[from].numerator / known_units[from].denominator / units->unit_metres;
    else if (known_units[to].numerator * known_units[from].denominator !=
             known_units[from].numerator * known_units[to].denominator)
        value = value * (known_units[from].numerator * known_units[to].denominator) /
                (known_units[from].denominator * known_units[to].numerator);
    if (!isfinite(value)) {
        return gis_fail(error, "%s: too long for a double", what);
    }
    *out = value;
    return true;
}

bool gis_optional_length_in_layer_units(const gis_optional_length *given, const gis_crs_units *units, const char *what,
                                        double *out, gis_error *error)
{
    return !given->text || gis_length_in_layer_units(&given->length, units, what, out, error);
}
