/* sheet_read.c: reads a sheet and applies it to the options of a command. Comments may stand in the file, as json-c
 * allows them. */
#include "sheet/sheet_inner.h"

#include "base/path.h"
#include "base/text.h"

#include <cpl_conv.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- The file ---------------------------------------------------------------------------------------------------- */

static bool read_text(const char *path, gis_text *out, gis_error *error)
{
    FILE *file = fopen(path, "rb");
    char bytes[1 << 14];
    if (!file) return gis_fail(error, "--spec %s: %s", path, strerror(errno));
    for (size_t n; (n = fread(bytes, 1, sizeof bytes, file)) > 0;) gis_text_add_bytes(out, bytes, n);
    const bool failed = ferror(file) != 0;
    fclose(file);
    if (failed) return gis_fail(error, "--spec %s: cannot be read", path);
    return gis_text_get(out) || gis_no_memory(error);
}

static size_t line_of(const char *text, size_t offset)
{
    size_t line = 1;
    for (size_t k = 0; k < offset && text[k]; k++) line += text[k] == '\n';
    return line;
}

/* Fails if there is text after what was parsed, which ends at `end`. */
static bool check_end(const gis_sheet *sheet, const char *text, size_t end, gis_error *error)
{
    const size_t length = strlen(text), at = end < length ? end : length, rest = at + strspn(text + at, " \t\r\n");
    return !text[rest] || gis_fail_usage(error, "%s: line %zu: text after the end", sheet->path, line_of(text, rest));
}

static bool parse(gis_sheet *sheet, gis_error *error)
{
    gis_text text = {0};
    struct json_tokener *tokener = json_tokener_new();
    bool ok = (tokener || gis_no_memory(error)) && read_text(sheet->path, &text, error);
    if (ok) {
        sheet->root = json_tokener_parse_ex(tokener, gis_text_get(&text), (int)text.length + 1);
        const enum json_tokener_error why = json_tokener_get_error(tokener);
        if (why != json_tokener_success)
            ok = gis_fail_usage(error, "%s: line %zu: %s", sheet->path,
                                line_of(gis_text_get(&text), json_tokener_get_parse_end(tokener)),
                                json_tokener_error_desc(why));
    }
    if (ok) ok = check_end(sheet, gis_text_get(&text), json_tokener_get_parse_end(tokener), error);
    if (tokener) json_tokener_free(tokener);
    gis_text_clear(&text);
    if (ok && !json_object_is_type(sheet->root, json_type_object))
        return gis_sheet_fail(sheet, error, "", "must be a JSON object with \"layers\"");
    return ok;
}

/* ---- Layers ------------------------------------------------------------------------------------------------------ */

static const char *const sheet_keys[] = {"title", "scale", "defaults", "layers", "gaps", "legible", NULL};

/* Applies a layer that does not move, and counts those that move. */
static bool apply_layer(gis_sheet *sheet, struct json_object *layer, const char *place, size_t *moving,
                        gis_options *options, gis_error *error)
{
    const char *role, *source;
    if (!json_object_is_type(layer, json_type_object)) return gis_sheet_fail(sheet, error, place, "must be an object");
    if (!gis_sheet_text(sheet, layer, place, "role", &role, error) ||
        !gis_sheet_text(sheet, layer, place, "source", &source, error))
        return false;
    if (!source) return gis_sheet_fail(sheet, error, place, "\"source\" is missing: a dataset");
    if (role && (strcmp(role, "barrier") == 0 || strcmp(role, "fixed") == 0))
        return sheet->said[OPT_BARRIER] || gis_sheet_add_barriers(sheet, layer, place, options, error);
    if (role && strcmp(role, "follow") == 0) return gis_sheet_add_follower(sheet, layer, place, options, error);
    if (!role || strcmp(role, "move") != 0)
        return gis_sheet_fail(sheet, error, place, "\"role\" must be move, fixed, barrier or follow");
    (*moving)++;
    return true;
}

static bool apply_layers(gis_sheet *sheet, gis_options *options, gis_error *error)
{
    struct json_object *layers = gis_sheet_member(sheet->root, "layers");
    size_t moving = 0;
    if (!json_object_is_type(layers, json_type_array))
        return gis_sheet_fail(sheet, error, "layers", "must be an array of objects");
    for (size_t k = 0; k < json_object_array_length(layers); k++) {
        char place[GIS_PLACE_SIZE];
        snprintf(place, sizeof place, "layers[%zu]", k);
        if (!apply_layer(sheet, json_object_array_get_idx(layers, k), place, &moving, options, error)) return false;
    }
    if (!moving) return gis_sheet_fail(sheet, error, "layers", "none has the role move");
    return gis_sheet_apply_moving(sheet, moving, options, error) && gis_sheet_lend_followers(sheet, options, error);
}

/* ---- All of it --------------------------------------------------------------------------------------------------- */

static bool apply_sheet(gis_sheet *sheet, gis_options *options, gis_error *error)
{
    struct json_object *scale = gis_sheet_member(sheet->root, "scale"),
                       *defaults = gis_sheet_member(sheet->root, "defaults");
    gis_error why;
    if (!gis_sheet_check_keys(sheet, sheet->root, "", sheet_keys, false, error)) return false;
    if (scale && !options->given[OPT_SCALE] &&
        (!gis_sheet_scalar(scale) || !gis_options_set(options, OPT_SCALE, gis_sheet_scalar(scale), &why)))
        return gis_sheet_fail(sheet, error, "scale", "must be N or \"1:N\", above 0");
    if (defaults && !json_object_is_type(defaults, json_type_object))
        return gis_sheet_fail(sheet, error, "defaults", "must be an object of rules");
    const char *const none[] = {NULL};
    return gis_sheet_read_gaps(sheet, options, error) &&
           (!defaults || gis_sheet_check_keys(sheet, defaults, "defaults", none, true, error)) &&
           apply_layers(sheet, options, error) && gis_sheet_check_classes(sheet, error);
}

bool gis_sheet_apply(gis_options *options, gis_sheet *out, gis_error *error)
{
    *out = (gis_sheet){.path = options->text[OPT_SPEC]};
    if (!out->path) return true;
    memcpy(out->said, options->given, sizeof out->said);
    out->directory = gis_path_directory(out->path);
    if (!parse(out, error) || !apply_sheet(out, options, error) || !gis_sheet_make_effective(out, options, error))
        return false;
    options->sheet =
        json_object_to_json_string_ext(out->effective, JSON_C_TO_STRING_PLAIN | JSON_C_TO_STRING_NOSLASHESCAPE);
    gis_sheet_lend_rules(out, options);
    options->given[OPT_SPEC] = false; /* what the sheet says is given now, and a plan stores that */
    if (options->given[OPT_PRINT_SPEC]) return true;
    for (size_t k = 0; k < options->n_more; k++)
        if (!gis_options_finish(&options->more[k], error)) return false;
    return gis_options_finish(options, error);
}

void gis_sheet_clear(gis_sheet *sheet)
{
    json_object_put(sheet->effective);
    json_object_put(sheet->root);
    CPLFree(sheet->directory);
    CPLFree(sheet->stem);
    free(sheet->of_layer);
    free(sheet->along);
    free(sheet->name);
    free(sheet->rule);
    free(sheet->of_barrier);
    *sheet = (gis_sheet){0};
}
