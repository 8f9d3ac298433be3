/* coordinate.c: see coordinate.h. A fraction is passed to the core as text, since converting it to a double would not
 * be exact. */
#include "route/coordinate.h"

#include "base/length.h"

#include <cpl_conv.h>
#include <string.h>

/* Reads text[0..n), one ordinate: a decimal, which becomes the nearest double *value, or a fraction of integers, which
 * is copied to *fraction and *exact. Returns false if it is neither. */
static bool read_ordinate(const char *text, size_t n, double *value, char **fraction, const char **exact)
{
    const char *slash = memchr(text, '/', n);
    if (!slash) return gis_length_parse_number(text, n, value);
    size_t start = text[0] == '-' || text[0] == '+', m = (size_t)(slash - text);
    if (strspn(text + start, "0123456789") != m - start || m == start || n == m + 1 ||
        strspn(slash + 1, "0123456789") < n - m - 1 || strspn(slash + 1, "0") >= n - m - 1)
        return false;
    *fraction = CPLMalloc(n + 1);
    memcpy(*fraction, text, n);
    (*fraction)[n] = '\0';
    *exact = *fraction;
    return true;
}

bool gis_coordinate_parse(const char *text, gis_coordinate *out)
{
    const char *comma = strchr(text, ',');
    return comma && read_ordinate(text, (size_t)(comma - text), &out->at.xy[0], &out->fraction[0], &out->at.text[0]) &&
           read_ordinate(comma + 1, strlen(comma + 1), &out->at.xy[1], &out->fraction[1], &out->at.text[1]);
}

void gis_coordinate_clear(gis_coordinate *coordinate)
{
    CPLFree(coordinate->fraction[0]);
    CPLFree(coordinate->fraction[1]);
    *coordinate = (gis_coordinate){0};
}
