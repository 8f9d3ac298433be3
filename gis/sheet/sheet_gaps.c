/* sheet_gaps.c: the gaps of classes: rules "between" two classes. The last rule that matches a pair counts. */
#include "sheet/sheet_inner.h"

#include "base/spelling.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const keys[] = {"between", "gap", "least", NULL};

static bool is_every(const char *name) { return strcmp(name, "*") == 0; }

uint32_t gis_sheet_class(const gis_sheet *sheet, const char *name)
{
    for (size_t k = 1; k < sheet->gaps.classes; k++)
        if (strcmp(sheet->name[k], name) == 0) return (uint32_t)k;
    return 0;
}

bool gis_sheet_read_class(const gis_sheet *sheet, struct json_object *layer, const char *place, const char **name,
                          const char **field, gis_error *error)
{
    static const char *const of_field[] = {"field", NULL};
    struct json_object *value = gis_sheet_member(layer, "class");
    char at[GIS_PLACE_SIZE];
    *name = *field = NULL;
    snprintf(at, sizeof at, "%.120s.class", place);
    if (!value) return gis_sheet_text(sheet, layer, place, "name", name, error);
    if (json_object_is_type(value, json_type_string)) {
        *name = json_object_get_string(value);
        return !is_every(*name) || gis_sheet_fail(sheet, error, at, "\"*\" stands for every class, and is none");
    }
    if (!json_object_is_type(value, json_type_object))
        return gis_sheet_fail(sheet, error, at, "must be a name, or {\"field\": NAME}");
    if (!gis_sheet_check_keys(sheet, value, at, of_field, false, error) ||
        !gis_sheet_text(sheet, value, at, "field", field, error))
        return false;
    return *field || gis_sheet_fail(sheet, error, at, "\"field\" is missing");
}

bool gis_sheet_is_for_all(struct json_object *rule)
{
    struct json_object *between = gis_sheet_member(rule, "between");
    for (size_t k = 0; k < 2; k++)
        if (!is_every(json_object_get_string(json_object_array_get_idx(between, k)))) return false;
    return true;
}

/* The number of the class with this name, which is added if it is new. */
static bool find_class(gis_sheet *sheet, const char *name, uint32_t *out, gis_error *error)
{
    *out = is_every(name) ? GIS_EVERY_CLASS : gis_sheet_class(sheet, name);
    if (*out) return true;
    const char **more = realloc(sheet->name, (sheet->gaps.classes + 1) * sizeof *more);
    if (!more) return gis_no_memory(error);
    sheet->name = more;
    *out = (uint32_t)sheet->gaps.classes;
    sheet->name[sheet->gaps.classes++] = name;
    return true;
}

static bool read_rule(gis_sheet *sheet, struct json_object *object, const char *place, gis_gap_rule *out,
                      gis_error *error)
{
    char at[GIS_PLACE_SIZE];
    *out = (gis_gap_rule){{0, 0}, {0}, {0}};
    if (!json_object_is_type(object, json_type_object))
        return gis_sheet_fail(sheet, error, place, "must be an object with \"between\" and \"gap\"");
    if (!gis_sheet_check_keys(sheet, object, place, keys, false, error)) return false;
    struct json_object *between = gis_sheet_member(object, "between");
    if (!json_object_is_type(between, json_type_array) || json_object_array_length(between) != 2)
        return gis_sheet_fail(sheet, error, place, "\"between\" must be an array of two classes; \"*\" is every class");
    for (size_t k = 0; k < 2; k++) {
        struct json_object *name = json_object_array_get_idx(between, k);
        if (!json_object_is_type(name, json_type_string))
            return gis_sheet_fail(sheet, error, place, "\"between\": a class is a text");
        if (!find_class(sheet, json_object_get_string(name), &out->of[k], error)) return false;
    }
    snprintf(at, sizeof at, "%.120s.gap", place);
    if (!gis_sheet_length(sheet, gis_sheet_member(object, "gap"), at, &out->gap, error)) return false;
    snprintf(at, sizeof at, "%.120s.least", place);
    if (!gis_sheet_length(sheet, gis_sheet_member(object, "least"), at, &out->least, error)) return false;
    return out->gap.text || out->least.text || gis_sheet_fail(sheet, error, place, "\"gap\" is missing");
}

static bool is_for_all(const gis_gap_rule *rule)
{
    return rule->of[0] == GIS_EVERY_CLASS && rule->of[1] == GIS_EVERY_CLASS;
}

/* Sets --gap and --least-gap, if they are not given, to those of the last of the leading rules for all classes. */
static bool set_common(const gis_sheet *sheet, size_t leading, gis_options *options, gis_error *error)
{
    const struct {
        gis_option_id id;
        size_t of; /* offset of the length in a rule */
    } parts[] = {{OPT_GAP, offsetof(gis_gap_rule, gap)}, {OPT_LEAST_GAP, offsetof(gis_gap_rule, least)}};
    for (size_t p = 0; p < sizeof parts / sizeof *parts; p++)
        for (size_t k = leading; k-- > 0 && !options->given[parts[p].id];) {
            const gis_optional_length *length = (const void *)((const char *)&sheet->rule[k] + parts[p].of);
            if (length->text && !gis_options_set(options, parts[p].id, length->text, error)) return false;
        }
    return true;
}

bool gis_sheet_read_gaps(gis_sheet *sheet, gis_options *options, gis_error *error)
{
    struct json_object *list = gis_sheet_member(sheet->root, "gaps");
    sheet->name = calloc(1, sizeof *sheet->name);
    if (!sheet->name) return gis_no_memory(error);
    sheet->gaps.classes = 1;
    if (!list) return true;
    if (!json_object_is_type(list, json_type_array))
        return gis_sheet_fail(sheet, error, "gaps", "must be an array of objects");
    const size_t n = json_object_array_length(list);
    sheet->rule = calloc(n + 1, sizeof *sheet->rule);
    if (!sheet->rule) return gis_no_memory(error);
    size_t leading = 0;
    for (size_t k = 0; k < n; k++) {
        char place[GIS_PLACE_SIZE];
        snprintf(place, sizeof place, "gaps[%zu]", k);
        if (!read_rule(sheet, json_object_array_get_idx(list, k), place, &sheet->rule[k], error)) return false;
        if (leading == k && is_for_all(&sheet->rule[k])) leading++;
    }
    if (!set_common(sheet, leading, options, error)) return false;
    sheet->gaps.rules = n - leading;
    memmove(sheet->rule, sheet->rule + leading, sheet->gaps.rules * sizeof *sheet->rule);
    return true;
}

/* Offers the classes of all layers as what a name was meant to be. */
static bool is_of_layer(const gis_sheet *sheet, const char *name, gis_spelling *search)
{
    struct json_object *layers = gis_sheet_member(sheet->root, "layers");
    for (size_t k = 0; k < json_object_array_length(layers); k++) {
        const char *own, *field;
        gis_error none;
        if (!gis_sheet_read_class(sheet, json_object_array_get_idx(layers, k), "", &own, &field, &none) || !own)
            continue;
        if (strcmp(own, name) == 0) return true;
        gis_spelling_offer(search, own, strlen(own));
    }
    return false;
}

bool gis_sheet_check_classes(const gis_sheet *sheet, gis_error *error)
{
    for (size_t k = 1; k < sheet->gaps.classes && !sheet->classes_by_field; k++) {
        gis_spelling search = gis_spelling_of(sheet->name[k], strlen(sheet->name[k]));
        if (is_of_layer(sheet, sheet->name[k], &search)) continue;
        return gis_sheet_fail(sheet, error, "gaps", "no layer has the class %s%s%s%s", sheet->name[k],
                              search.best ? "; did you mean " : "", search.best ? search.best : "",
                              search.best ? "?" : "");
    }
    return true;
}

void gis_sheet_lend_gaps(gis_sheet *sheet, gis_options *options)
{
    sheet->gaps.name = sheet->name;
    sheet->gaps.rule = sheet->rule;
    sheet->gaps.of_barrier = sheet->of_barrier;
    if (sheet->gaps.rules) options->gap_classes = &sheet->gaps;
}
