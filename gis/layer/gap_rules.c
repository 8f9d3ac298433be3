/* gap_rules.c: see gap_rules.h. */
#include "layer/gap_rules.h"

#include "base/core_error.h"
#include "read/fields.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool gis_class_gaps_field(gis_layer_input *input, gis_error *error)
{
    const gis_gap_classes *classes = input->request->rules.classes;
    return !classes || gis_field_find(input->source, "--spec: class", classes->field, &input->class_field, error);
}

void gis_class_gaps_clear(gis_class_tables *tables)
{
    free(tables->gap);
    free(tables->full);
    *tables = (gis_class_tables){0};
}

/* Puts a number into both entries of each two classes that a rule is about. */
static void put(const gis_gap_rule *rule, size_t classes, double value, double *table)
{
    for (size_t i = 0; i < classes; i++)
        for (size_t j = 0; j < classes; j++)
            if ((rule->of[0] == GIS_EVERY_CLASS || rule->of[0] == i) &&
                (rule->of[1] == GIS_EVERY_CLASS || rule->of[1] == j))
                table[i * classes + j] = table[j * classes + i] = value;
}

static bool apply_rule(const gis_layer_input *input, const gis_gap_rule *rule, gis_class_tables *out, gis_error *error)
{
    const size_t classes = input->request->rules.classes->classes;
    const struct {
        const gis_optional_length *length;
        double *table;
    } parts[] = {{&rule->gap, out->full}, {&rule->least, out->gap}};
    for (size_t k = 0; k < sizeof parts / sizeof *parts; k++) {
        double value = 0;
        if (!parts[k].length->text) continue;
        if (!gis_optional_length_in_layer_units(parts[k].length, &input->units, "--spec: gaps", &value, error))
            return false;
        put(rule, classes, value, parts[k].table);
    }
    return true;
}

/* A pair without a least gap has to keep its gap. */
static bool finish_tables(const gis_gap_classes *classes, gis_class_tables *out, gis_error *error)
{
    const size_t n = classes->classes;
    for (size_t k = 0; k < n * n; k++) {
        const char *one = classes->name[k / n], *other = classes->name[k % n];
        if (isnan(out->gap[k])) out->gap[k] = out->full[k];
        if (out->gap[k] > out->full[k])
            return gis_fail_usage(error,
                                  "--spec: gaps between %s and %s: the least gap, %.15g, is greater than the "
                                  "gap, %.15g",
                                  one ? one : "*", other ? other : "*", out->gap[k], out->full[k]);
        out->slack = out->slack || out->gap[k] < out->full[k];
        out->most = fmax(out->most, out->gap[k]);
        out->most_full = fmax(out->most_full, out->full[k]);
    }
    return true;
}

bool gis_class_gaps_tables(gis_layer_input *input, gis_error *error)
{
    const gis_gap_classes *classes = input->request->rules.classes;
    gis_class_tables *out = &input->class_tables;
    if (!classes) return true;
    const size_t n = classes->classes;
    if (n > GIS_MOST_CLASSES)
        return gis_fail_usage(error, "--spec: gaps: %zu classes; at most %d", n - 1, GIS_MOST_CLASSES - 1);
    out->gap = malloc(n * n * sizeof *out->gap);
    out->full = malloc(n * n * sizeof *out->full);
    if (!out->gap || !out->full) return gis_no_memory(error);
    for (size_t k = 0; k < n * n; k++) {
        out->full[k] = input->gap;
        out->gap[k] = input->request->rules.least_gap.text ? input->least_gap : NAN;
    }
    for (size_t k = 0; k < classes->rules; k++)
        if (!apply_rule(input, &classes->rule[k], out, error)) return false;
    return finish_tables(classes, out, error);
}

/* The class of a feature. Text is compared as it is; what is blank or unknown has class 0. */
static bool class_of(const gis_layer_input *input, size_t i, uint32_t *out, gis_error *error)
{
    const gis_gap_classes *classes = input->request->rules.classes;
    *out = classes->of_features;
    if (input->class_field < 0) return true;
    OGRFeatureH feature = gis_source_feature(input->source, i);
    *out = 0;
    if (gis_field_is_blank(feature, input->class_field)) return true;
    char *key = gis_field_key(feature, input->class_field);
    if (!key) return gis_no_memory(error);
    for (size_t k = 1; k < classes->classes; k++)
        if (strcmp(classes->name[k], key) == 0) *out = (uint32_t)k;
    free(key);
    return true;
}

bool gis_class_gaps_read(gis_layer_input *input, gis_error *error)
{
    if (!input->request->rules.classes) return true;
    free(input->gap_class);
    input->gap_class = malloc((input->n + 1) * sizeof *input->gap_class);
    bool ok = input->gap_class || gis_no_memory(error);
    for (size_t i = 0; ok && i < input->n; i++) ok = class_of(input, i, &input->gap_class[i], error);
    return ok;
}

uint32_t gis_class_gaps_of_barrier(const gis_gap_classes *classes, size_t request)
{
    return classes->of_barrier ? classes->of_barrier[request] : 0;
}

sunder_gaps gis_class_gaps_core(const gis_gap_classes *classes, const gis_class_tables *tables)
{
    return (sunder_gaps){.classes = classes ? classes->classes : 0, .gap = tables->gap, .full_gap = tables->full};
}

double gis_class_gaps_most(const gis_layer_input *input) { return fmax(input->gap, input->class_tables.most_full); }

bool gis_class_gaps_set(const gis_layer_input *input, const size_t *number, size_t n, sunder_layer *layer,
                        gis_error *error)
{
    const gis_gap_classes *classes = input->request->rules.classes;
    const gis_barriers *barriers = &input->barriers;
    sunder_error why;
    if (!classes) return true;
    uint32_t *of = malloc((n + barriers->n + 1) * sizeof *of);
    bool ok = of || gis_no_memory(error);
    for (size_t k = 0; ok && k < n; k++) of[k] = input->gap_class[number ? number[k] : k];
    for (size_t k = 0; ok && k < barriers->n; k++)
        of[n + k] = gis_class_gaps_of_barrier(classes, barriers->feature[k].request);
    sunder_gaps gaps = gis_class_gaps_core(classes, &input->class_tables);
    gaps.feature = of;
    gaps.barrier = ok ? of + n : NULL;
    if (ok && sunder_layer_set_gaps(layer, &gaps, &why) != SUNDER_OK) ok = gis_core_failed(error, "--spec: gaps", &why);
    free(of);
    return ok;
}
