/* json.c: see json.h. Each value writes the comma that is due before it, so callers that write a list need not treat
 * the first member specially. A failed allocation is remembered, and tested once, at the end. */
#include "base/json.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void gis_json_clear(gis_json *out)
{
    gis_text_clear(&out->text);
    *out = (gis_json){0};
}

const char *gis_json_text(const gis_json *out) { return gis_text_get(&out->text); }

static void append_bytes(gis_json *out, const char *bytes, size_t n) { gis_text_add_bytes(&out->text, bytes, n); }

static void begin_value(gis_json *out)
{
    if (out->need_comma) append_bytes(out, ", ", 2);
    out->need_comma = true;
}

void gis_json_open(gis_json *out, char bracket)
{
    begin_value(out);
    append_bytes(out, &bracket, 1);
    out->need_comma = false;
}

void gis_json_close(gis_json *out, char bracket)
{
    append_bytes(out, &bracket, 1);
    out->need_comma = true;
}

void gis_json_line(gis_json *out)
{
    if (out->need_comma)
        append_bytes(out, ",\n ", 3);
    else
        append_bytes(out, "\n ", 2);
    out->need_comma = false;
}

/* The number of bytes of the UTF-8 character that begins here (RFC 3629); 0: it is invalid. */
static size_t character_size(const unsigned char *c)
{
    size_t n = *c < 0x80 ? 1 : *c < 0xc2 ? 0 : *c < 0xe0 ? 2 : *c < 0xf0 ? 3 : *c < 0xf5 ? 4 : 0;
    for (size_t k = 1; k < n; k++)
        if ((c[k] & 0xc0) != 0x80) return 0;
    bool too_long = (*c == 0xe0 && c[1] < 0xa0) || (*c == 0xf0 && c[1] < 0x90);
    bool beyond = (*c == 0xed && c[1] >= 0xa0) || (*c == 0xf4 && c[1] >= 0x90); /* surrogates; above U+10FFFF */
    return too_long || beyond ? 0 : n;
}

/* Appends a string in quotes. Names of files and layers may be in another encoding, or cut within a character; each
 * invalid byte becomes U+FFFD, so that the rest can be read. */
static void append_quoted(gis_json *out, const char *text)
{
    append_bytes(out, "\"", 1);
    for (const char *c = text; *c;) {
        unsigned char byte = (unsigned char)*c;
        size_t n = character_size((const unsigned char *)c);
        char escape[8];
        if (byte == '"' || byte == '\\')
            append_bytes(out, (char[]){'\\', *c}, 2);
        else if (byte < 0x20 || n == 0)
            append_bytes(out, escape, (size_t)snprintf(escape, sizeof escape, "\\u%04x", n ? byte : 0xfffd));
        else
            append_bytes(out, c, n);
        c += n ? n : 1;
    }
    append_bytes(out, "\"", 1);
}

void gis_json_key(gis_json *out, const char *key)
{
    begin_value(out);
    append_quoted(out, key);
    append_bytes(out, ": ", 2);
    out->need_comma = false;
}

void gis_json_string(gis_json *out, const char *utf8)
{
    begin_value(out);
    if (utf8)
        append_quoted(out, utf8);
    else
        append_bytes(out, "null", 4);
}

void gis_json_size(gis_json *out, uint64_t value)
{
    char text[24];
    begin_value(out);
    append_bytes(out, text, (size_t)snprintf(text, sizeof text, "%" PRIu64, value));
}

void gis_json_signed(gis_json *out, int64_t value)
{
    char text[24];
    begin_value(out);
    append_bytes(out, text, (size_t)snprintf(text, sizeof text, "%" PRId64, value));
}

void gis_json_double(gis_json *out, double value)
{
    char text[GIS_NUMBER_MAX];
    begin_value(out);
    if (!isfinite(value)) {
        append_bytes(out, "null", 4);
        return;
    }
    gis_number_text(value, text);
    append_bytes(out, text, strlen(text));
}

void gis_json_bool(gis_json *out, bool value)
{
    begin_value(out);
    append_bytes(out, value ? "true" : "false", value ? 4 : 5);
}

void gis_json_null(gis_json *out)
{
    begin_value(out);
    append_bytes(out, "null", 4);
}

void gis_json_raw(gis_json *out, const char *text)
{
    append_bytes(out, text, strlen(text));
    out->need_comma = true;
}

void gis_json_put_string(gis_json *out, const char *key, const char *utf8)
{
    gis_json_key(out, key);
    gis_json_string(out, utf8);
}

void gis_json_put_size(gis_json *out, const char *key, uint64_t value)
{
    gis_json_key(out, key);
    gis_json_size(out, value);
}

void gis_json_put_double(gis_json *out, const char *key, double value)
{
    gis_json_key(out, key);
    gis_json_double(out, value);
}

void gis_json_put_bool(gis_json *out, const char *key, bool value)
{
    gis_json_key(out, key);
    gis_json_bool(out, value);
}

/* The numbers of digits that are tried. %.15g drops trailing zeros, and every decimal of up to 15 digits survives
 * conversion to a double, so if 15 digits read back, the printed text is the shortest decimal. 17 digits always read
 * back. Subnormal numbers have fewer digits, so below few_digits_below the search begins at one. */
enum { DIGITS_TOLD_APART = DBL_DIG, DIGITS_ENOUGH = DBL_DECIMAL_DIG };
static const double few_digits_below = 1e-300;

void gis_number_text(double value, char text[GIS_NUMBER_MAX])
{
    if (value == 0) {
        strcpy(text, "0");
        return;
    }
    int digits = fabs(value) < few_digits_below ? 1 : DIGITS_TOLD_APART;
    for (; digits <= DIGITS_ENOUGH; digits++) {
        snprintf(text, GIS_NUMBER_MAX, "%.*g", digits, value);
        if (strtod(text, NULL) == value) return;
    }
}
