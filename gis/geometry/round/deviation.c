/* deviation.c: see round.h. The distance between a double and an exact number. */
#include "geometry/round/steps.h"

#include "base/core_error.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

double gis_ulp(double x)
{
    x = fabs(x);
    return nextafter(x, INFINITY) - x;
}

/* Writes a double as the library writes exact numbers: "num" or "num/den" in lowest terms; false if it does not fit. */
static bool exact_text(double x, char *text, size_t size)
{
    int exponent;
    double mantissa = frexp(x, &exponent); /* x = mantissa 2^exponent, 0.5 <= |mantissa| < 1 */
    if (x == floor(x)) return (size_t)snprintf(text, size, "%.0f", x == 0 ? 0.0 : x) < size;
    mantissa = ldexp(mantissa, DBL_MANT_DIG);
    exponent -= DBL_MANT_DIG;
    while (fmod(mantissa, 2) == 0) {
        mantissa /= 2;
        exponent++;
    }
    return exponent > -1024 && (size_t)snprintf(text, size, "%.0f/%.0f", mantissa, ldexp(1, -exponent)) < size;
}

double gis_text_deviation(const char *exact, double x)
{
    char same[700];
    return exact_text(x, same, sizeof same) && strcmp(same, exact) == 0 ? 0 : gis_ulp(x) / 2;
}

bool gis_vertex_deviation(const sunder_sum *sum, uint32_t vertex, double *deviation, gis_error *error)
{
    double xy[2];
    sunder_error why;
    *deviation = 0;
    return sunder_sum_vertices(sum, &vertex, 1, xy, deviation, &why) == SUNDER_OK || gis_core_failed(error, NULL, &why);
}
