/* json.h: a small JSON writer into memory. Commas and colons come by themselves; the caller's nesting must be sound.
 * An allocation that fails makes the writer stay failed: gis_json_text() then gives NULL. */
#ifndef GIS_JSON_H
#define GIS_JSON_H

#include "base/text.h"

#include <stdint.h>

typedef struct gis_json {
    gis_text text;
    bool need_comma; /* a value stands before this place in the innermost container */
} gis_json;

/* Start from a zeroed struct; gis_json_clear() frees it. */
void gis_json_clear(gis_json *out);
const char *gis_json_text(const gis_json *out); /* NULL after a failed allocation */

void gis_json_open(gis_json *out, char bracket);  /* '{' or '[' */
void gis_json_close(gis_json *out, char bracket); /* '}' or ']' */
void gis_json_key(gis_json *out, const char *key);
void gis_json_line(gis_json *out); /* a line break after the comma that is due, for eyes */

void gis_json_string(gis_json *out, const char *utf8); /* NULL: null */
void gis_json_size(gis_json *out, uint64_t value);
void gis_json_signed(gis_json *out, int64_t value);
void gis_json_double(gis_json *out, double value); /* shortest that reads back; null where not finite */
void gis_json_bool(gis_json *out, bool value);
void gis_json_null(gis_json *out);
void gis_json_raw(gis_json *out, const char *text); /* copied as it is, commas included; counts as one value */

/* A key and its value. */
void gis_json_put_string(gis_json *out, const char *key, const char *utf8);
void gis_json_put_size(gis_json *out, const char *key, uint64_t value);
void gis_json_put_double(gis_json *out, const char *key, double value);
void gis_json_put_bool(gis_json *out, const char *key, bool value);

/* The shortest decimal that reads back as the same double, at most 32 bytes with its end; -0 is 0. */
#define GIS_NUMBER_MAX 32
void gis_number_text(double value, char text[GIS_NUMBER_MAX]);

#endif
