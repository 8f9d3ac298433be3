/* sheet_values.c: values of a sheet, and errors that name their place. */
#include "sheet/sheet_inner.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

bool gis_sheet_fail(const gis_sheet *sheet, gis_error *error, const char *place, const char *format, ...)
{
    char message[sizeof error->message];
    va_list list;
    va_start(list, format);
    vsnprintf(message, sizeof message, format, list);
    va_end(list);
    return gis_fail_usage(error, "%s: %s%s%s", sheet->path, place, *place ? ": " : "", message);
}

struct json_object *gis_sheet_member(struct json_object *object, const char *key)
{
    struct json_object *value = NULL;
    json_object_object_get_ex(object, key, &value);
    return value;
}

bool gis_sheet_text(const gis_sheet *sheet, struct json_object *object, const char *place, const char *key,
                    const char **out, gis_error *error)
{
    struct json_object *value = gis_sheet_member(object, key);
    char at[GIS_PLACE_SIZE];
    *out = NULL;
    if (!value) return true;
    snprintf(at, sizeof at, "%.90s.%.60s", place, key);
    if (!json_object_is_type(value, json_type_string) || json_object_get_string_len(value) == 0)
        return gis_sheet_fail(sheet, error, at, "must be a text");
    *out = json_object_get_string(value);
    return true;
}

const char *gis_sheet_scalar(struct json_object *value)
{
    const enum json_type type = json_object_get_type(value);
    const bool scalar = type == json_type_string || type == json_type_int || type == json_type_double;
    return scalar ? json_object_get_string(value) : NULL;
}

bool gis_sheet_length(const gis_sheet *sheet, struct json_object *value, const char *place, gis_optional_length *out,
                      gis_error *error)
{
    const char *why, *text = gis_sheet_scalar(value);
    if (!value) return true;
    if (!text) return gis_sheet_fail(sheet, error, place, "must be a length, such as 3 or \"0.2mm\"");
    out->text = text;
    return gis_length_parse(text, strlen(text), &out->length, &why) ||
           gis_sheet_fail(sheet, error, place, "%s: %s", text, why);
}
