/* layer_rules.c: applies the rules to each feature: lengths, fixed and ignored features, blocks by a field, weights,
 * limits. Errors in the data name the feature; errors in a rule name the option. */
#include "layer/layer_rules.h"

#include "layer/gap_rules.h"
#include "read/fields.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *gis_weighting_string(gis_weighting weighting)
{
    static const char *const word[] = {"1", "area", "sqrt-area"};
    return (unsigned)weighting <= GIS_WEIGHTING_SQRT_AREA ? word[weighting] : "";
}

/* Called before features are read, so that an error about a missing field is not preceded by warnings about
 * features. */
bool gis_layer_fields(gis_layer_input *input, gis_error *error)
{
    const gis_source *source = input->source;
    const gis_layer_rules *rules = &input->request->rules;
    return gis_class_gaps_field(input, error) &&
           gis_field_find(source, "--id-field", input->request->id_field, &input->id_field, error) &&
           gis_field_find(source, "--block-field", rules->block_field, &input->block_field, error) &&
           gis_field_find(source, "--rows", rules->rows_field, &input->rows_field, error) &&
           gis_field_find_numbers(source, "--max-shift-field", rules->max_shift_field, &input->limit_field, error) &&
           gis_field_find_numbers(source, "--prefer-dx", rules->prefer_field[0], &input->prefer_field[0], error) &&
           gis_field_find_numbers(source, "--prefer-dy", rules->prefer_field[1], &input->prefer_field[1], error) &&
           gis_field_find_numbers(source, "--hierarchy-field", rules->hierarchy_field, &input->hierarchy_field,
                                  error) &&
           gis_field_find_numbers(source, "--hidden-field", rules->hidden_field, &input->hidden_field, error) &&
           gis_field_find_numbers(source, "--weight-field", rules->weight_field, &input->weight_field, error);
}

bool gis_layer_lengths(gis_layer_input *input, gis_error *error)
{
    const gis_layer_rules *rules = &input->request->rules;
    if (!gis_optional_length_in_layer_units(&rules->gap, &input->units, "--gap", &input->gap, error) ||
        !gis_optional_length_in_layer_units(&rules->least_gap, &input->units, "--least-gap", &input->least_gap,
                                            error) ||
        !gis_optional_length_in_layer_units(&rules->max_shift, &input->units, "--max-shift", &input->max_shift,
                                            error) ||
        !gis_optional_length_in_layer_units(&rules->touch_tolerance, &input->units, "--touch-tolerance",
                                            &input->tolerance, error) ||
        !gis_rung_lengths_read(rules, &input->units, &input->lengths, error))
        return false;
    if (rules->least_gap.text && input->least_gap > input->gap)
        return gis_fail_usage(error, "--least-gap %s: must not be greater than the gap, %s", rules->least_gap.text,
                              rules->gap.text);
    if (input->gap > 0 && input->tolerance >= input->gap)
        return gis_fail_usage(error, "--touch-tolerance %s: must be less than the gap, %s", rules->touch_tolerance.text,
                              rules->gap.text);
    if (rules->enlarge && !(input->lengths.min_size > 0))
        return gis_fail_usage(error, "--enlarge: --min-size %s must be above 0", rules->min_size.text);
    if (rules->symbol_size.text &&
        !(input->lengths.symbol_size > 0 && input->lengths.symbol_size >= input->lengths.min_size))
        return gis_fail_usage(error, "--symbol-size %s: must be above 0, and not below --min-size",
                              rules->symbol_size.text);
    return gis_class_gaps_tables(input, error);
}

bool gis_layer_marks(gis_layer_input *input, gis_error *error)
{
    const gis_layer_rules *rules = &input->request->rules;
    bool *marks = calloc(input->n + 1, sizeof *marks);
    if (!marks) return gis_no_memory(error);
    bool ok = true;
    if (rules->ignore_where) {
        ok = gis_source_mark(input->source, "--ignore-where", rules->ignore_where, marks, error);
        for (size_t i = 0; ok && i < input->n; i++) input->feature[i].ignored = input->feature[i].ignored || marks[i];
    }
    if (ok && rules->fixed_where) {
        ok = gis_source_mark(input->source, "--fixed-where", rules->fixed_where, marks, error);
        for (size_t i = 0; ok && i < input->n; i++) input->feature[i].fixed = marks[i];
    }
    free(marks);
    return ok;
}

bool gis_layer_number_blocks(gis_layer_input *input, gis_block_keys *keys, gis_error *error)
{
    const int field = input->block_field;
    for (size_t i = 0; field >= 0 && i < input->n; i++) {
        OGRFeatureH feature = gis_source_attributes(input->source, i);
        if (gis_field_is_blank(feature, field)) continue;
        char *key = gis_field_key(feature, field);
        if (!key) return gis_no_memory(error);
        if (!gis_block_keys_add(keys, key, &input->feature[i].block, error)) return false;
    }
    return true;
}

bool gis_layer_blocks(gis_layer_input *input, gis_error *error)
{
    gis_block_keys keys = {0};
    const bool done = gis_layer_number_blocks(input, &keys, error) && gis_block_keys_rank(&keys, error);
    for (size_t i = 0; done && i < input->n; i++)
        if (input->feature[i].block >= 0) input->feature[i].block = keys.rank[input->feature[i].block];
    gis_block_keys_clear(&keys);
    return done;
}

bool gis_layer_number_rows(gis_layer_input *input, gis_block_keys *keys, gis_error *error)
{
    const int field = input->rows_field;
    if (field < 0) return true;
    input->row = malloc((input->n + 1) * sizeof *input->row);
    bool ok = input->row != NULL || gis_no_memory(error);
    for (size_t i = 0; ok && i < input->n; i++) {
        OGRFeatureH feature = gis_source_attributes(input->source, i);
        input->row[i] = -1;
        if (gis_field_is_blank(feature, field)) continue;
        char *key = gis_field_key(feature, field);
        ok = key ? gis_block_keys_add(keys, key, &input->row[i], error) : gis_no_memory(error);
    }
    return ok;
}

bool gis_layer_rows(gis_layer_input *input, gis_error *error)
{
    gis_block_keys keys = {0};
    const bool done = gis_layer_number_rows(input, &keys, error);
    gis_block_keys_clear(&keys);
    return done;
}

bool gis_layer_wrong_number(const gis_layer_input *input, size_t i, int field, const char *what, const char *needed,
                            gis_error *error)
{
    char who[GIS_WHO_SIZE], held[GIS_FIELD_TEXT_SIZE];
    OGRFeatureH feature = gis_source_attributes(input->source, i);
    gis_feature_name(input, i, who, sizeof who);
    gis_field_text(feature, field, held);
    return gis_fail(error, "%s: the %s in %s is %s; it must be %s", who, what,
                    OGR_Fld_GetNameRef(OGR_F_GetFieldDefnRef(feature, field)), held, needed);
}

/* Replaces the common limit by each feature's own from --max-shift-field. */
bool gis_layer_limits(gis_layer_input *input, gis_error *error)
{
    const int field = input->limit_field;
    for (size_t i = 0; field >= 0 && i < input->n; i++) {
        OGRFeatureH feature = gis_source_attributes(input->source, i);
        char who[GIS_WHO_SIZE];
        if (input->feature[i].ignored || gis_field_is_blank(feature, field)) continue;
        gis_length limit = {gis_field_number(feature, field), GIS_LAYER_UNIT};
        if (!(limit.value >= 0) || !isfinite(limit.value))
            return gis_layer_wrong_number(input, i, field, "limit", "a finite number, 0 or more", error);
        gis_feature_name(input, i, who, sizeof who);
        if (!gis_length_in_layer_units(&limit, &input->units, who, &input->feature[i].max_shift, error)) return false;
    }
    return true;
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double gis_layer_median(double *areas, size_t n)
{
    if (n == 0) return 1;
    qsort(areas, n, sizeof *areas, by_size);
    return n % 2 ? areas[n / 2] : areas[n / 2 - 1] / 2 + areas[n / 2] / 2;
}

double gis_layer_area_weight(gis_weighting by, double area, double median)
{
    const double weight = area / median;
    return by == GIS_WEIGHTING_SQRT_AREA ? sqrt(weight) : weight;
}

/* Sets weights to the area (or its square root) relative to the median area of the features that are not ignored. */
static bool weigh_by_area(gis_layer_input *input, gis_weighting by, gis_error *error)
{
    double *areas = malloc((input->n + 1) * sizeof *areas);
    if (!areas) return gis_no_memory(error);
    size_t n = 0;
    for (size_t i = 0; i < input->n; i++)
        if (!input->feature[i].ignored) areas[n++] = sunder_shape_area(input->shape[i]);
    const double median = gis_layer_median(areas, n);
    free(areas);
    for (size_t i = 0; i < input->n; i++)
        if (!input->feature[i].ignored)
            input->feature[i].weight = gis_layer_area_weight(by, sunder_shape_area(input->shape[i]), median);
    return true;
}

bool gis_layer_is_weight(double weight) { return weight >= SUNDER_LEAST_WEIGHT && weight <= SUNDER_GREATEST_WEIGHT; }

bool gis_layer_weigh_by_field(gis_layer_input *input, gis_error *error)
{
    const int field = input->weight_field;
    for (size_t i = 0; field >= 0 && i < input->n; i++) {
        OGRFeatureH feature = gis_source_attributes(input->source, i);
        if (input->feature[i].ignored || gis_field_is_blank(feature, field)) continue;
        double weight = gis_field_number(feature, field);
        if (!gis_layer_is_weight(weight))
            return gis_layer_wrong_number(input, i, field, "weight", "a number from 1e-100 to 1e100", error);
        input->feature[i].weight *= weight;
    }
    return true;
}

bool gis_layer_wrong_weight(const char *who, double weight, gis_error *error)
{
    return gis_fail(error, "%s: its weight, %g, is not a number from %g to %g", who, weight, SUNDER_LEAST_WEIGHT,
                    SUNDER_GREATEST_WEIGHT);
}

bool gis_layer_weights(gis_layer_input *input, gis_error *error)
{
    gis_weighting by = input->request->rules.weighting;
    if (by != GIS_WEIGHTING_EVEN && !weigh_by_area(input, by, error)) return false;
    if (!gis_layer_weigh_by_field(input, error)) return false;
    for (size_t i = 0; i < input->n; i++) {
        double weight = input->feature[i].weight;
        if (input->feature[i].ignored) {
            input->feature[i].weight = 1; /* not used; the factor may be anything */
        } else if (!gis_layer_is_weight(weight)) {
            char who[GIS_WHO_SIZE];
            gis_feature_name(input, i, who, sizeof who);
            return gis_layer_wrong_weight(who, weight, error);
        }
    }
    return true;
}
