/* sheet_stored.c: gaps by classes as the text that a plan stores. All else of a sheet is among the options of a plan.
 * The text is like a part of a sheet: {"gaps": [...], "class": NAME or {"field": NAME}, "barriers": [NAME, null, ...]}.
 * The last has the class of each value of --barrier, null if no rule names it. */
#include "sheet/sheet_inner.h"

#include "base/json.h"

#include <cpl_conv.h>
#include <stdlib.h>

/* ---- Writing ----------------------------------------------------------------------------------------------------- */

static void put_length(gis_json *out, const char *key, const gis_optional_length *length)
{
    if (length->text) gis_json_put_string(out, key, length->text);
}

static void put_rule(gis_json *out, const gis_gap_classes *gaps, const gis_gap_rule *rule)
{
    gis_json_open(out, '{');
    gis_json_key(out, "between");
    gis_json_open(out, '[');
    for (int k = 0; k < 2; k++) gis_json_string(out, rule->of[k] == GIS_EVERY_CLASS ? "*" : gaps->name[rule->of[k]]);
    gis_json_close(out, ']');
    put_length(out, "gap", &rule->gap);
    put_length(out, "least", &rule->least);
    gis_json_close(out, '}');
}

static void put_class(gis_json *out, const gis_gap_classes *gaps)
{
    gis_json_key(out, "class");
    if (!gaps->field) {
        gis_json_string(out, gaps->name[gaps->of_features]);
        return;
    }
    gis_json_open(out, '{');
    gis_json_put_string(out, "field", gaps->field);
    gis_json_close(out, '}');
}

void gis_sheet_put_gaps(gis_json *out, const gis_gap_classes *gaps, size_t barriers)
{
    gis_json_open(out, '{');
    gis_json_key(out, "gaps");
    gis_json_open(out, '[');
    for (size_t k = 0; k < gaps->rules; k++) put_rule(out, gaps, &gaps->rule[k]);
    gis_json_close(out, ']');
    put_class(out, gaps);
    gis_json_key(out, "barriers");
    gis_json_open(out, '[');
    for (size_t k = 0; k < barriers && gaps->of_barrier; k++) gis_json_string(out, gaps->name[gaps->of_barrier[k]]);
    gis_json_close(out, ']');
    gis_json_close(out, '}');
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

static bool take_barriers(gis_sheet *sheet, gis_error *error)
{
    struct json_object *list = gis_sheet_member(sheet->root, "barriers");
    const size_t n = json_object_is_type(list, json_type_array) ? json_object_array_length(list) : 0;
    if (n == 0) return true;
    sheet->of_barrier = calloc(n, sizeof *sheet->of_barrier);
    if (!sheet->of_barrier) return gis_no_memory(error);
    for (; sheet->barriers < n; sheet->barriers++) {
        struct json_object *name = json_object_array_get_idx(list, sheet->barriers);
        if (name) sheet->of_barrier[sheet->barriers] = gis_sheet_class(sheet, json_object_get_string(name));
    }
    return true;
}

bool gis_sheet_take_gaps(const char *text, gis_options *options, gis_sheet *out, gis_error *error)
{
    const char *name = NULL;
    *out = (gis_sheet){.path = "plan", .root = json_tokener_parse(text)};
    if (!json_object_is_type(out->root, json_type_object)) return gis_fail(error, "the gaps of the plan: not JSON");
    if (!gis_sheet_read_gaps(out, options, error) || !take_barriers(out, error)) return false;
    if (gis_sheet_member(out->root, "class") &&
        !gis_sheet_read_class(out, out->root, "", &name, &out->gaps.field, error))
        return false;
    if (name) out->gaps.of_features = gis_sheet_class(out, name);
    gis_sheet_lend_gaps(out, options);
    return true;
}
