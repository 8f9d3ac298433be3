/* legible_rules.c: the least sizes that a sheet gives, and their values in the units of a layer. */
#include "legible/legible_inner.h"

#include <string.h>

const char *gis_legible_key(sunder_illegible_kind kind)
{
    static const char *const key[SUNDER_ILLEGIBLE_KINDS] = {"width", "area", "neck", "inner_gap", "edge"};
    return key[kind];
}

/* "0.3mm2" is 0.3 times the square of 1 mm, so the scale counts twice. */
static bool parse_area(const char *text, gis_legible_rules *rules, const char **why)
{
    const size_t n = strlen(text);
    gis_length length;
    const bool plain = gis_length_parse_number(text, n, &rules->area);
    if (!plain && (n < 2 || text[n - 1] != '2')) {
        *why = "not an area, such as \"0.3mm2\", \"40m2\", or a number of square units of the layer";
        return false;
    }
    if (!gis_length_parse(text, plain ? n : n - 1, &length, why)) return false;
    rules->area = length.value;
    length.value = 1;
    rules->least[SUNDER_ILLEGIBLE_SMALL] = (gis_optional_length){text, length};
    return true;
}

bool gis_legible_rule_parse(const char *text, sunder_illegible_kind kind, gis_legible_rules *rules, const char **why)
{
    if (kind == SUNDER_ILLEGIBLE_SMALL) return parse_area(text, rules, why);
    if (!gis_length_parse(text, strlen(text), &rules->least[kind].length, why)) return false;
    rules->least[kind].text = text;
    return true;
}

bool gis_legible_any_rule(const gis_legible_rules *rules)
{
    for (int kind = 0; kind < SUNDER_ILLEGIBLE_KINDS; kind++)
        if (rules->least[kind].text) return true;
    return false;
}

bool gis_legible_limits(const gis_legible_rules *rules, const gis_crs_units *units, sunder_legible_limits *out,
                        gis_error *error)
{
    double *const limit[SUNDER_ILLEGIBLE_KINDS] = {&out->width, &out->area, &out->neck, &out->inner_gap, &out->edge};
    *out = (sunder_legible_limits){0};
    for (int kind = 0; kind < SUNDER_ILLEGIBLE_KINDS; kind++) {
        char what[32] = "legible.";
        strcat(what, gis_legible_key((sunder_illegible_kind)kind));
        if (!gis_optional_length_in_layer_units(&rules->least[kind], units, what, limit[kind], error)) return false;
    }
    out->area = rules->least[SUNDER_ILLEGIBLE_SMALL].text ? rules->area * out->area * out->area : 0;
    return true;
}
