/* json.h: a JSON writer into memory. Commas and colons are written automatically; the caller must nest correctly. After
 * a failed allocation gis_json_text() returns NULL. */
#ifndef GIS_JSON_H
#define GIS_JSON_H

#include "base/text.h"

#include <stdint.h>

typedef struct gis_json {
    gis_text text;
    bool need_comma; /* a value precedes in the innermost container */
} gis_json;

/* Frees the text; start from a zeroed struct. */
void gis_json_clear(gis_json *out);
const char *gis_json_text(const gis_json *out); /* NULL after a failed allocation */

void gis_json_open(gis_json *out, char bracket);  /* '{' or '[' */
void gis_json_close(gis_json *out, char bracket); /* '}' or ']' */
void gis_json_key(gis_json *out, const char *key);
void gis_json_line(gis_json *out); /* a line break after the comma that is due, for human readers */

void gis_json_string(gis_json *out, const char *utf8); /* NULL: null */
void gis_json_size(gis_json *out, uint64_t value);
void gis_json_signed(gis_json *out, int64_t value);
void gis_json_double(gis_json *out, double value); /* the shortest decimal that reads back; null if not finite */
void gis_json_bool(gis_json *out, bool value);
void gis_json_null(gis_json *out);
void gis_json_raw(gis_json *out, const char *text); /* copied without change; counts as one value */

/* Each writes a key and a value. */
void gis_json_put_string(gis_json *out, const char *key, const char *utf8);
void gis_json_put_size(gis_json *out, const char *key, uint64_t value);
void gis_json_put_double(gis_json *out, const char *key, double value);
void gis_json_put_bool(gis_json *out, const char *key, bool value);

/* The shortest decimal that reads back as the same double, with its NUL at most GIS_NUMBER_MAX bytes; -0 becomes 0. */
#define GIS_NUMBER_MAX 32
void gis_number_text(double value, char text[GIS_NUMBER_MAX]);

#endif
