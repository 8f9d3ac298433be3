/* sheet_follow.c: layers that go along with those that move, as the command follow takes one along: their features get
 * the moves of the features that they belong to. */
#include "sheet/sheet_inner.h"

#include "base/spelling.h"

#include <cpl_conv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const gis_sheet_follower_keys[] = {"name", "source", "layer", "where",    "role",
                                               "crs",  "by",     "of",    "id_field", NULL};

bool gis_sheet_add_follower(gis_sheet *sheet, struct json_object *layer, const char *place, gis_options *options,
                            gis_error *error)
{
    gis_along one = {0};
    const struct {
        const char *key, **text;
    } parts[] = {{"name", &one.name}, {"source", &one.source}, {"layer", &one.layer}, {"where", &one.where},
                 {"crs", &one.crs},   {"by", &one.by},         {"of", &one.of},       {"id_field", &one.id_field}};
    if (!gis_sheet_check_keys(sheet, layer, place, gis_sheet_follower_keys, false, error)) return false;
    for (size_t k = 0; k < sizeof parts / sizeof *parts; k++)
        if (!gis_sheet_text(sheet, layer, place, parts[k].key, parts[k].text, error)) return false;
    gis_along *more = realloc(sheet->along, (sheet->followers + 1) * sizeof *more);
    if (!more) return gis_no_memory(error);
    sheet->along = more;
    char *path = gis_sheet_dataset(sheet, one.source);
    const bool ok = gis_options_own(options, path, &one.source, error);
    CPLFree(path);
    sheet->along[sheet->followers++] = one;
    return ok;
}

/* Fails if a layer goes along with one that does not move. */
static bool check_of(const gis_sheet *sheet, const gis_along *one, const char *place, gis_error *error)
{
    struct json_object *layers = gis_sheet_member(sheet->root, "layers");
    gis_spelling search = gis_spelling_of(one->of, strlen(one->of));
    for (size_t k = 0; k < json_object_array_length(layers); k++) {
        struct json_object *layer = json_object_array_get_idx(layers, k);
        const char *name = json_object_get_string(gis_sheet_member(layer, "name"));
        if (!gis_sheet_is_moving(layer) || !name) continue;
        if (strcmp(name, one->of) == 0) return true;
        gis_spelling_offer(&search, name, strlen(name));
    }
    return gis_sheet_fail(sheet, error, place, "\"of\": no layer that moves has the name %s%s%s%s", one->of,
                          search.best ? ", did you mean " : "", search.best ? search.best : "", search.best ? "?" : "");
}

bool gis_sheet_lend_followers(gis_sheet *sheet, gis_options *options, gis_error *error)
{
    struct json_object *layers = gis_sheet_member(sheet->root, "layers");
    for (size_t i = 0, k = 0; k < sheet->followers; i++) {
        const char *role = json_object_get_string(gis_sheet_member(json_object_array_get_idx(layers, i), "role"));
        if (!role || strcmp(role, "follow") != 0) continue;
        const gis_along *one = &sheet->along[k++];
        char place[GIS_PLACE_SIZE];
        snprintf(place, sizeof place, "layers[%zu]", i);
        if (one->of && !check_of(sheet, one, place, error)) return false;
        if (!one->of && sheet->moving > 1 && one->by && strncmp(one->by, "field:", 6) == 0)
            return gis_sheet_fail(sheet, error, place, "\"of\" is missing: the layer whose features the field names");
    }
    if (options->command->bit == GIS_PLAN && sheet->followers)
        return gis_sheet_fail(sheet, error, "layers",
                              "a plan takes no layer along: give it to sunder follow, with what "
                              "merge writes");
    if (options->command->bit != GIS_SEPARATE) return true;
    options->along = sheet->along;
    options->n_along = sheet->followers;
    return true;
}
