/* digits.c: would GDAL's 17 significant digits lose a double? sink_rewrite.c explains when. */
#include "write/sink/sink_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool has_run(const char *text)
{
    const char *point = strchr(text, '.');
    return point && (strstr(point, "999999") || strstr(point, "000000"));
}

/* Would GDAL print x with fewer than 17 digits that read back as another double? This predicts what GDAL does; the
 * written file is verified in any case. */
static bool loses_digits(double x)
{
    char text[64];
    snprintf(text, sizeof text, "%.17g", x);
    if (!has_run(text)) return false;
    for (int digits = 16; digits >= 14; digits--) {
        snprintf(text, sizeof text, "%.*g", digits, x);
        if (strchr(text, '.') && !has_run(text)) return strtod(text, NULL) != x;
    }
    return false;
}

bool gis_sink_loses_digits(OGRGeometryH geometry)
{
    if (!geometry) return false;
    for (int i = 0; i < OGR_G_GetGeometryCount(geometry); i++)
        if (gis_sink_loses_digits(OGR_G_GetGeometryRef(geometry, i))) return true;
    if (OGR_G_GetGeometryCount(geometry)) return false;
    for (int i = 0; i < OGR_G_GetPointCount(geometry); i++)
        if (loses_digits(OGR_G_GetX(geometry, i)) || loses_digits(OGR_G_GetY(geometry, i))) return true;
    return false;
}
