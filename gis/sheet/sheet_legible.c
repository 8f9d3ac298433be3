/* sheet_legible.c: the least sizes of features, "legible", of the sheet and of a layer. */
#include "sheet/sheet_inner.h"

#include <stdio.h>
#include <string.h>

const char *const gis_sheet_legible_about[SUNDER_ILLEGIBLE_KINDS] = {
    "least diameter of the largest disc in a feature", "least area, such as \"0.3mm2\"",
    "least distance of two walls of a feature through its inside",
    "and through its outside: across bays and courtyards", "least length of an edge"};

bool gis_sheet_read_legible(const gis_sheet *sheet, struct json_object *of, const char *place, gis_legible_rules *rules,
                            gis_error *error)
{
    const char *keys[SUNDER_ILLEGIBLE_KINDS + 1] = {NULL}, *why;
    struct json_object *legible = gis_sheet_member(of, "legible");
    char at[GIS_PLACE_SIZE];
    if (!legible) return true;
    snprintf(at, sizeof at, "%.80s%slegible", place, *place ? "." : "");
    if (!json_object_is_type(legible, json_type_object))
        return gis_sheet_fail(sheet, error, at, "must be an object of least sizes");
    for (int kind = 0; kind < SUNDER_ILLEGIBLE_KINDS; kind++) keys[kind] = gis_legible_key((sunder_illegible_kind)kind);
    if (!gis_sheet_check_keys(sheet, legible, at, keys, false, error)) return false;
    for (int kind = 0; kind < SUNDER_ILLEGIBLE_KINDS; kind++) {
        struct json_object *value = gis_sheet_member(legible, keys[kind]);
        char key[GIS_PLACE_SIZE];
        if (!value || rules->least[kind].text) continue;
        snprintf(key, sizeof key, "%.100s.%s", at, keys[kind]);
        const char *text = gis_sheet_scalar(value);
        if (!text) return gis_sheet_fail(sheet, error, key, "must be a text or a number");
        if (!gis_legible_rule_parse(text, (sunder_illegible_kind)kind, rules, &why))
            return gis_sheet_fail(sheet, error, key, "%s: %s", text, why);
    }
    return true;
}
