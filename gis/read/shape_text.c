/* shape_text.c: see shape_text.h. The beginning of a text distinguishes WKT from a data source; but if there is a file
 * of that name, such as one called "POLYGON (...)", the file is meant. */
#include "read/shape_text.h"

#include "base/core_error.h"
#include "base/interrupt.h"
#include "base/message.h"
#include "base/resources.h"
#include "base/spelling.h"
#include "geometry/wkt.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *const standard_shapes[] = {"disc:", "inside-disc:", "square:", "rectangle:"};
enum { DISC, INSIDE_DISC, SQUARE, RECTANGLE, N_STANDARD };

static const unsigned default_segments = 32;
/* A polygon with more vertices cannot be distinguished from a circle at any scale; a larger number is an error. */
static const double most_segments = 65536;

static int standard_shape(const char *text)
{
    for (int i = 0; i < N_STANDARD; i++)
        if (strncmp(text, standard_shapes[i], strlen(standard_shapes[i])) == 0) return i;
    return N_STANDARD;
}

bool gis_shape_is_text(const char *text)
{
    if (text[0] == '@' || standard_shape(text) != N_STANDARD) return true;
    return gis_wkt_looks_like(text) && access(text, F_OK) != 0;
}

/* Reads the radius, side, width or height (`what`) of a standard shape. */
static bool read_length(const char *text, size_t n, const char *what, const char *who, const gis_crs_units *units,
                        double *out, gis_error *error)
{
    gis_length length;
    const char *why;
    if (n == 0) return gis_fail_usage(error, "%s: the %s is missing", who, what);
    if (!gis_length_parse(text, n, &length, &why))
        return gis_fail_usage(error, "%s: the %s, %.*s: %s", who, what, (int)n, text, why);
    if (length.value == 0) return gis_fail_usage(error, "%s: the %s must be greater than 0", who, what);
    return gis_length_in_layer_units(&length, units, who, out, error);
}

/* An invalid argument is wrong usage; any other error of the core is a failure of the run. */
static bool core_failed(const char *who, const sunder_error *why, gis_error *error)
{
    if (why->status == SUNDER_EARG) return gis_fail_usage(error, "%s: %s", who, why->message);
    return gis_core_failed(error, who, why);
}

static bool read_disc(const char *text, bool inside, const char *who, const gis_crs_units *units, sunder_shape **out,
                      gis_error *error)
{
    size_t n = strcspn(text, ":");
    double radius, segments = default_segments;
    if (!read_length(text, n, "radius", who, units, &radius, error)) return false;
    if (text[n] == ':') {
        const char *count = text + n + 1;
        if (!*count) return gis_fail_usage(error, "%s: the number of segments is missing", who);
        if (strspn(count, "0123456789") != strlen(count) || !gis_length_parse_number(count, strlen(count), &segments))
            return gis_fail_usage(error, "%s: %s is not a number of segments", who, count);
    }
    if (segments < 3 || segments > most_segments)
        return gis_fail_usage(error, "%s: a disc needs 3 segments at least, and no more than %.0f", who, most_segments);
    sunder_error why;
    if (sunder_shape_disc(radius, (unsigned)segments, inside, out, &why) != SUNDER_OK)
        return core_failed(who, &why, error);
    return true;
}

static bool read_rectangle(const char *text, bool square, const char *who, const gis_crs_units *units,
                           sunder_shape **out, gis_error *error)
{
    double width, height;
    size_t n = square ? strlen(text) : strcspn(text, "x");
    if (!square && text[n] != 'x')
        return gis_fail_usage(error, "%s: expected rectangle:WIDTHxHEIGHT, as in rectangle:4x2.5", who);
    if (!read_length(text, n, square ? "side" : "width", who, units, &width, error)) return false;
    height = width;
    if (!square && !read_length(text + n + 1, strlen(text + n + 1), "height", who, units, &height, error)) return false;
    sunder_error why;
    if (sunder_shape_rectangle(width, height, out, &why) != SUNDER_OK) return core_failed(who, &why, error);
    return true;
}

/* Reads all of a stream; the caller frees *text. */
static bool read_stream(FILE *file, char **text, gis_error *error)
{
    char *bytes = NULL;
    size_t n = 0, capacity = 0;
    for (;;) {
        if (capacity - n < 2) {
            capacity = capacity * 2 + 4096;
            char *larger = realloc(bytes, capacity);
            if (!larger) {
                free(bytes);
                return gis_no_memory(error);
            }
            bytes = larger;
        }
        size_t got = gis_interrupted() ? 0 : fread(bytes + n, 1, capacity - n - 1, file);
        if (got == 0) break;
        n += got;
    }
    bytes[n] = '\0';
    if (strlen(bytes) != n) {
        free(bytes);
        return gis_fail(error, "not a text");
    }
    *text = bytes;
    return true;
}

bool gis_shape_read_file(const char *name, const char *who, char **text, gis_error *error)
{
    bool standard = strcmp(name, "-") == 0;
    if (!*name) return gis_fail_usage(error, "%s: the name of the file is missing; @- is standard input", who);
    FILE *file = standard ? stdin : fopen(name, "r");
    if (!file) return gis_fail(error, "%s: cannot read %s: %s", who, name, strerror(errno));
    gis_error why = {0};
    errno = 0;
    bool ok = read_stream(file, text, &why);
    if (ok && (ferror(file) || gis_interrupted())) {
        free(*text);
        ok = gis_fail(&why, "%s", strerror(errno));
    }
    if (!standard) fclose(file);
    return ok || gis_fail(error, "%s: cannot read %s: %s", who, standard ? "standard input" : name, why.message);
}

bool gis_shape_of_wkt(const char *text, const char *who, gis_invalid_policy policy, sunder_shape **out,
                      double *building, gis_error *error)
{
    gis_polygons set = {0};
    bool invalid = false;
    gis_error reason;
    bool ok = gis_wkt_read(text, who, &set, error);
    double begin = gis_clock();
    ok = ok && gis_shape_of_polygons(&set, policy, who, out, &invalid, &reason, error);
    *building += gis_clock() - begin;
    if (ok && invalid)
        gis_say_warning(GIS_MESSAGE_INVALID, "%s: %s; read as the region that its rings enclose by the even-odd rule",
                        who, reason.message);
    gis_polygons_clear(&set);
    return ok;
}

static bool shape_from_text(const char *text, const char *who, const gis_crs_units *units, gis_invalid_policy policy,
                            sunder_shape **out, double *building, gis_error *error)
{
    int standard = standard_shape(text);
    if (standard != N_STANDARD) {
        const char *rest = text + strlen(standard_shapes[standard]);
        double begin = gis_clock();
        bool ok = standard == DISC || standard == INSIDE_DISC
                      ? read_disc(rest, standard == INSIDE_DISC, who, units, out, error)
                      : read_rectangle(rest, standard == SQUARE, who, units, out, error);
        *building += gis_clock() - begin;
        return ok;
    }
    if (text[0] == '@') {
        char *wkt = NULL;
        if (!gis_shape_read_file(text + 1, who, &wkt, error)) return false;
        bool ok = gis_shape_of_wkt(wkt, who, policy, out, building, error);
        free(wkt);
        return ok;
    }
    if (gis_shape_of_wkt(text, who, policy, out, building, error)) return true;
    if (!error->no_memory) error->exit_status = GIS_USAGE; /* the text is part of the command line */
    return false;
}

void gis_shape_name(const char *who, const char *text, char *name, size_t size)
{
    enum { SHOWN = 48 };
    size_t n = strlen(text);
    if (n > SHOWN)
        for (n = SHOWN; n > 0 && ((unsigned char)text[n] & 0xC0) == 0x80;) n--;
    snprintf(name, size, "%s (%.*s%s)", who, (int)n, text, text[n] ? "..." : "");
}

bool gis_shape_from_text(const char *text, const char *who, const gis_crs_units *units, gis_invalid_policy policy,
                         sunder_shape **out, double *building, gis_error *error)
{
    double unasked = 0;
    char name[GIS_SHAPE_NAME_SIZE];
    gis_shape_name(who, text, name, sizeof name);
    return shape_from_text(text, name, units, policy, out, building ? building : &unasked, error);
}

const char *gis_shape_prefix_meant(const char *text)
{
    gis_spelling search = gis_spelling_of(text, strcspn(text, ":"));
    if (text[search.n] == ':')
        for (int i = 0; i < N_STANDARD; i++)
            gis_spelling_offer(&search, standard_shapes[i], strlen(standard_shapes[i]) - 1);
    return search.best;
}
