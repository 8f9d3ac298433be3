/* rule_keys.c: which options may stand in a sheet, and under which key; keys that nothing knows. */
#include "sheet/sheet_inner.h"

#include "base/spelling.h"
#include "base/text.h"

#include <stdio.h>
#include <string.h>

/* The options about features are rules. Options about a run are not, and some have a key of their own. */
static bool is_rule(const gis_option *option)
{
    static const gis_option_id more[] = {OPT_EFFORT, OPT_SEED, OPT_INVALID},
                               none[] = {OPT_SCALE,       OPT_BARRIER,     OPT_SPEC,           OPT_PRINT_SPEC,
                                         OPT_INPUT_CRS,   OPT_INPUT_LAYER, OPT_BEFORE,         OPT_HIDDEN_FIELD,
                                         OPT_CONFIG,      OPT_PREVIOUS,    OPT_PREVIOUS_RELAX, OPT_LINKS,
                                         OPT_LINKS_RADIUS};
    if (!(option->commands & (GIS_SEPARATE | GIS_CHECK))) return false;
    for (size_t k = 0; k < sizeof more / sizeof *more; k++)
        if (option->id == more[k]) return true;
    for (size_t k = 0; k < sizeof none / sizeof *none; k++)
        if (option->id == none[k]) return false;
    return option->group <= GIS_GROUP_INPUT;
}

bool gis_rule_key(const gis_option *option, char *key, size_t size)
{
    const size_t n = strcspn(option->names, " ");
    if (!is_rule(option) || n < 3 || n - 2 >= size) return false;
    for (size_t k = 2; k < n; k++) key[k - 2] = option->names[k] == '-' ? '_' : option->names[k];
    key[n - 2] = '\0';
    return true;
}

const gis_option *gis_rule_of_key(const char *key)
{
    char own[64];
    for (int id = 0; id < OPT_N; id++)
        if (gis_rule_key(&gis_option_table[id], own, sizeof own) && strcmp(own, key) == 0) return &gis_option_table[id];
    return NULL;
}

/* Adds the values of an array, separated by commas. */
static bool join(struct json_object *array, gis_text *out)
{
    for (size_t k = 0; k < json_object_array_length(array); k++) {
        const char *one = gis_sheet_scalar(json_object_array_get_idx(array, k));
        if (!one) return false;
        if (k) gis_text_add(out, ",");
        gis_text_add(out, one);
    }
    return json_object_array_length(array) > 0;
}

/* Sets one option to a value of the sheet. Flags are true or false, lists are arrays. */
static bool set_rule(const gis_sheet *sheet, const gis_option *option, struct json_object *value, const char *place,
                     gis_options *options, gis_error *error)
{
    gis_text text = {0};
    gis_error why;
    const bool flag = option->type == GIS_TYPE_FLAG;
    const char *one = gis_sheet_scalar(value);
    bool ok = true;
    if (flag && !json_object_is_type(value, json_type_boolean))
        return gis_sheet_fail(sheet, error, place, "must be true or false");
    if (flag && !json_object_get_boolean(value)) return true;
    if (gis_option_is_list(option) && json_object_is_type(value, json_type_array)) {
        for (size_t k = 0; ok && k < json_object_array_length(value); k++) {
            one = gis_sheet_scalar(json_object_array_get_idx(value, k));
            ok = one && gis_options_set(options, option->id, one, &why);
            if (!one) gis_fail_usage(&why, "must be texts or numbers");
        }
    } else if (!flag && !one && !(json_object_is_type(value, json_type_array) && join(value, &text))) {
        return gis_sheet_fail(sheet, error, place, "must be a text, a number, or an array");
    } else {
        ok = gis_options_set(options, option->id, flag ? NULL : one ? one : gis_text_get(&text), &why);
    }
    gis_text_clear(&text);
    return ok || gis_sheet_fail(sheet, error, place, "%s", why.message);
}

bool gis_rules_set(const gis_sheet *sheet, struct json_object *object, const char *place, gis_options *options,
                   gis_error *error)
{
    const bool check_alone = options->command->bit == GIS_CHECK && !options->given[OPT_BEFORE];
    if (!object) return true;
    json_object_object_foreach(object, key, value)
    {
        const gis_option *option = gis_rule_of_key(key);
        char at[GIS_PLACE_SIZE];
        if (!option || !(option->commands & options->command->bit) || options->given[option->id]) continue;
        if (check_alone && gis_option_is_of_moves(option->id)) continue;
        snprintf(at, sizeof at, "%.90s.%.60s", place, key);
        if (!set_rule(sheet, option, value, at, options, error)) return false;
    }
    return true;
}

static bool is_listed(const char *const *keys, const char *key)
{
    for (; *keys; keys++)
        if (strcmp(*keys, key) == 0) return true;
    return false;
}

bool gis_sheet_check_keys(const gis_sheet *sheet, struct json_object *object, const char *place,
                          const char *const *keys, bool rules, gis_error *error)
{
    json_object_object_foreach(object, key, value)
    {
        char own[64];
        (void)value;
        if (is_listed(keys, key) || strcmp(key, "comment") == 0 || (rules && gis_rule_of_key(key))) continue;
        gis_spelling search = gis_spelling_of(key, strlen(key));
        for (const char *const *k = keys; *k; k++) gis_spelling_offer(&search, *k, strlen(*k));
        for (int id = 0; rules && id < OPT_N; id++)
            if (gis_rule_key(&gis_option_table[id], own, sizeof own))
                gis_spelling_offer(&search, gis_option_table[id].names + 2, strlen(own));
        return gis_sheet_fail(sheet, error, place, "there is no key %s%s%s%s; sunder --spec-schema lists all", key,
                              search.best ? ", did you mean " : "", search.best ? search.best : "",
                              search.best ? "?" : "");
    }
    return true;
}
