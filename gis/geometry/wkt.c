/* wkt.c: see wkt.h. A parser of its own, since GDAL's accepts much that is not WKT and does not say what is wrong. */
#include "geometry/wkt.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef struct reader {
    const char *start, *at;
    const char *who;
    int tagged;    /* numbers in each point according to the tag (3 or 4); 0: there is no tag */
    int dimension; /* numbers in each point, as in the first one; 0: none was read yet */
    gis_polygons *out;
    gis_error *error;
} reader;

static void skip_blanks(reader *in)
{
    while (isspace((unsigned char)*in->at)) in->at++;
}

static size_t word_length(const char *text)
{
    size_t n = 0;
    while (isalpha((unsigned char)text[n])) n++;
    return n;
}

static bool is_word(const char *text, size_t n, const char *word)
{
    return strlen(word) == n && strncasecmp(text, word, n) == 0;
}

static bool fail_at(reader *in, const char *expected)
{
    size_t place = (size_t)(in->at - in->start) + 1;
    if (*in->at == '\0')
        return gis_fail(in->error, "%s: the WKT ends after %zu characters; expected %s", in->who, place - 1, expected);
    return gis_fail(in->error, "%s: WKT, character %zu ('%.1s'): expected %s", in->who, place, in->at, expected);
}

static bool take_character(reader *in, char c)
{
    skip_blanks(in);
    if (*in->at != c) return false;
    in->at++;
    return true;
}

static bool take_empty(reader *in)
{
    skip_blanks(in);
    size_t n = word_length(in->at);
    if (!is_word(in->at, n, "EMPTY")) return false;
    in->at += n;
    return true;
}

static bool read_number(reader *in, double *value)
{
    size_t n = strspn(in->at, "0123456789+-.eE");
    char *end;
    if (n == 0) return fail_at(in, "a number");
    *value = strtod(in->at, &end);
    if (end != in->at + n) return fail_at(in, "a number");
    if (!isfinite(*value)) return fail_at(in, "a number that a double can hold");
    in->at += n;
    return true;
}

/* Reads X and Y, and skips Z and M. Every point must have the same number of coordinates as the first, and as the tag
 * says. */
static bool read_point(reader *in)
{
    double value[4];
    int n = 0;
    for (skip_blanks(in); n < 4 && (n < 2 || (*in->at != ',' && *in->at != ')')); skip_blanks(in), n++)
        if (!read_number(in, &value[n])) return false;
    if (in->dimension == 0 && in->tagged == 0) in->dimension = n;
    if (n != (in->tagged ? in->tagged : in->dimension))
        return fail_at(in, n < (in->tagged ? in->tagged : in->dimension) ? "another number: points differ in dimension"
                                                                         : "fewer numbers: points differ in dimension");
    return gis_polygons_vertex(in->out, value[0], value[1], in->error);
}

static bool read_ring(reader *in)
{
    size_t first = in->out->vertices;
    if (!take_character(in, '(')) return fail_at(in, "'(' of a ring");
    do {
        if (!read_point(in)) return false;
    } while (take_character(in, ','));
    if (!take_character(in, ')')) return fail_at(in, "',' or ')'");
    const double *xy = in->out->xy;
    size_t n = in->out->vertices - first, last = in->out->vertices - 1;
    if (n > 1 && xy[2 * first] == xy[2 * last] && xy[2 * first + 1] == xy[2 * last + 1]) n--;
    if (n < 3)
        return gis_fail(in->error, "%s: WKT, character %zu: a ring of %zu point%s; it needs three at least", in->who,
                        (size_t)(in->at - in->start), n, n == 1 ? "" : "s");
    return gis_polygons_end_ring(in->out, in->error);
}

static bool read_polygon(reader *in)
{
    if (take_empty(in)) return true;
    if (!take_character(in, '(')) return fail_at(in, "'(' of a polygon");
    do {
        if (!read_ring(in)) return false;
    } while (take_character(in, ','));
    if (!take_character(in, ')')) return fail_at(in, "',' or ')'");
    return gis_polygons_end_polygon(in->out, in->error);
}

static bool read_members(reader *in)
{
    if (take_empty(in)) return true;
    if (!take_character(in, '(')) return fail_at(in, "'(' of a multipolygon");
    do {
        if (!read_polygon(in)) return false;
    } while (take_character(in, ','));
    return take_character(in, ')') || fail_at(in, "',' or ')'");
}

/* Reads the tag Z, M or ZM behind the type, separated from it or not (POLYGONZ). */
static void read_tag(reader *in, size_t *type_length, const char *type)
{
    size_t n = *type_length;
    int joined = n > 0 && (is_word(type, n, "POLYGONZ") || is_word(type, n, "MULTIPOLYGONZ") ||
                           is_word(type, n, "POLYGONM") || is_word(type, n, "MULTIPOLYGONM"));
    int both = is_word(type, n, "POLYGONZM") || is_word(type, n, "MULTIPOLYGONZM");
    if (joined || both) {
        in->tagged = both ? 4 : 3;
        *type_length = n - (both ? 2 : 1);
        return;
    }
    skip_blanks(in);
    size_t tag = word_length(in->at);
    if (is_word(in->at, tag, "Z") || is_word(in->at, tag, "M") || is_word(in->at, tag, "ZM")) {
        in->tagged = tag == 2 ? 4 : 3;
        in->at += tag;
    }
}

const char *gis_wkt_after_srid(const char *text, int *srid)
{
    enum { DIGITS = 9 }; /* more digits are no SRID, and do not fit an int */
    const char *at = text;
    *srid = 0;
    while (isspace((unsigned char)*at)) at++;
    if (strncasecmp(at, "SRID=", 5) != 0) return text;
    const size_t n = strspn(at + 5, "0123456789");
    if (n == 0 || n > DIGITS || at[5 + n] != ';') return text;
    *srid = atoi(at + 5);
    return at + 5 + n + 1;
}

bool gis_wkt_looks_like(const char *text)
{
    int srid;
    text = gis_wkt_after_srid(text, &srid);
    while (isspace((unsigned char)*text)) text++;
    size_t n = word_length(text);
    if (n == 0) return false;
    text += n;
    bool blank = isspace((unsigned char)*text);
    while (isspace((unsigned char)*text)) text++;
    size_t tag = word_length(text);
    if (blank &&
        (is_word(text, tag, "Z") || is_word(text, tag, "M") || is_word(text, tag, "ZM") || is_word(text, tag, "EMPTY")))
        return true;
    return *text == '(';
}

bool gis_wkt_read(const char *text, const char *who, gis_polygons *out, gis_error *error)
{
    int srid;
    reader in = {.start = text, .at = gis_wkt_after_srid(text, &srid), .who = who, .out = out, .error = error};
    skip_blanks(&in);
    const char *type = in.at;
    size_t n = word_length(type);
    in.at += n;
    read_tag(&in, &n, type);
    bool one = is_word(type, n, "POLYGON"), many = is_word(type, n, "MULTIPOLYGON");
    if (!one && !many)
        return gis_fail(error, "%s: %.*s is not a polygonal set; expected POLYGON or MULTIPOLYGON", who,
                        n ? (int)(n < 40 ? n : 40) : 4, n ? type : "this");
    if (!(one ? read_polygon(&in) : read_members(&in))) return false;
    skip_blanks(&in);
    if (*in.at) return fail_at(&in, "the end of the text");
    return true;
}
