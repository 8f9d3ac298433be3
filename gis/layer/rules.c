/* rules.c: what the options say of each feature: lengths, who is fixed or ignored, blocks by a field, weights. */
#include "base/nearest.h"
#include "layer/input.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

bool gis_field_is_blank(OGRFeatureH feature, int field)
{
    if (!OGR_F_IsFieldSetAndNotNull(feature, field))
        return true;
    if (OGR_Fld_GetType(OGR_F_GetFieldDefnRef(feature, field)) != OFTString)
        return false;
    const char *text = OGR_F_GetFieldAsString(feature, field);
    return text[strspn(text, " ")] == '\0';
}

bool gis_layer_field(const gis_layer_input *input, gis_option_id option, int *field, gis_error *error)
{
    const char *name = input->options->text[option], *layer = gis_source_name(input->source);
    *field = name ? gis_source_field(input->source, name) : -1;
    if (!name || *field >= 0)
        return true;
    OGRFeatureDefnH definition = OGR_L_GetLayerDefn(gis_source_layer(input->source));
    gis_nearest search = gis_nearest_to(name, strlen(name));
    for (int i = 0; i < OGR_FD_GetFieldCount(definition); i++) {
        const char *other = OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(definition, i));
        gis_nearest_offer(&search, other, strlen(other));
    }
    return gis_fail(error, "%s: layer %s has no field %s%s%s%s", gis_option_table[option].names, layer, name,
                    search.best ? "; did you mean " : "", search.best ? search.best : "", search.best ? "?" : "");
}

bool gis_layer_lengths(gis_layer_input *input, gis_error *error)
{
    const gis_options *options = input->options;
    const struct {
        gis_option_id id;
        const char *name;
        double *to;
    } lengths[] = {{OPT_GAP, "--gap", &input->gap}, {OPT_MAX_SHIFT, "--max-shift", &input->max_shift},
                   {OPT_TOUCH_TOLERANCE, "--touch-tolerance", &input->tolerance}};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++)
        if (options->given[lengths[i].id] && !gis_length_in_layer_units(&options->length[lengths[i].id], &input->rule,
                                                                        lengths[i].name, lengths[i].to, error))
            return false;
    if (input->gap > 0 && input->tolerance >= input->gap)
        return gis_fail_usage(error, "--touch-tolerance %s: must be less than the gap, %s",
                              options->text[OPT_TOUCH_TOLERANCE], options->text[OPT_GAP]);
    return true;
}

bool gis_layer_marks(gis_layer_input *input, gis_error *error)
{
    const gis_options *options = input->options;
    bool *marks = calloc(input->n + 1, sizeof *marks);
    if (!marks)
        return gis_no_memory(error);
    bool ok = true;
    if (options->given[OPT_IGNORE_WHERE]) {
        ok = gis_source_mark(input->source, options->text[OPT_IGNORE_WHERE], marks, error);
        for (size_t i = 0; ok && i < input->n; i++)
            input->feature[i].ignored = input->feature[i].ignored || marks[i];
    }
    if (ok && options->given[OPT_FIXED_WHERE]) {
        ok = gis_source_mark(input->source, options->text[OPT_FIXED_WHERE], marks, error);
        for (size_t i = 0; ok && i < input->n; i++)
            input->feature[i].fixed = marks[i];
    }
    free(marks);
    return ok;
}

typedef struct keyed {
    char *key;
    size_t feature;
} keyed;

static int by_key(const void *a, const void *b)
{
    const keyed *ka = a, *kb = b;
    int order = strcmp(ka->key, kb->key);
    return order ? order : (ka->feature > kb->feature) - (ka->feature < kb->feature);
}

/* Doubles with all their digits, so that different ones stay different; the two zeros are equal. */
char *gis_field_key(OGRFeatureH feature, int field)
{
    OGRFieldType type = OGR_Fld_GetType(OGR_F_GetFieldDefnRef(feature, field));
    char number[64];
    const char *text = number;
    if (type == OFTReal)
        snprintf(number, sizeof number, "%.17g", OGR_F_GetFieldAsDouble(feature, field) + 0.0);
    else
        text = OGR_F_GetFieldAsString(feature, field);
    char *copy = malloc(strlen(text) + 1);
    return copy ? strcpy(copy, text) : NULL;
}

bool gis_layer_blocks(gis_layer_input *input, gis_error *error)
{
    int field;
    if (!gis_layer_field(input, OPT_BLOCK_FIELD, &field, error))
        return false;
    if (field < 0)
        return true;
    keyed *keys = calloc(input->n + 1, sizeof *keys);
    if (!keys)
        return gis_no_memory(error);
    bool ok = true;
    size_t n = 0;
    for (size_t i = 0; ok && i < input->n; i++) {
        OGRFeatureH feature = gis_source_feature(input->source, i);
        if (!OGR_F_IsFieldSetAndNotNull(feature, field))
            continue;
        keys[n] = (keyed){gis_field_key(feature, field), i};
        ok = keys[n].key || gis_no_memory(error);
        n += ok;
    }
    qsort(keys, n, sizeof *keys, by_key);
    for (size_t k = 0, block = 0; ok && k < n; k++) {
        block += k > 0 && strcmp(keys[k].key, keys[k - 1].key) != 0;
        input->feature[keys[k].feature].block = (int64_t)block;
    }
    for (size_t k = 0; k < n; k++)
        free(keys[k].key);
    free(keys);
    return ok;
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Each area (or its root) relative to the median of those that count. */
static bool weigh_by_area(gis_layer_input *input, bool root, gis_error *error)
{
    double *areas = malloc((input->n + 1) * sizeof *areas);
    if (!areas)
        return gis_no_memory(error);
    size_t n = 0;
    for (size_t i = 0; i < input->n; i++)
        if (!input->feature[i].ignored)
            areas[n++] = sunder_shape_area(input->shape[i]);
    qsort(areas, n, sizeof *areas, by_size);
    double median = n == 0 ? 1 : n % 2 ? areas[n / 2] : areas[n / 2 - 1] / 2 + areas[n / 2] / 2;
    free(areas);
    for (size_t i = 0; i < input->n; i++) {
        if (input->feature[i].ignored)
            continue;
        double weight = sunder_shape_area(input->shape[i]) / median;
        input->feature[i].weight = root ? sqrt(weight) : weight;
    }
    return true;
}

/* A number, also one that a text holds; NAN for anything else. */
static double number_in(OGRFeatureH feature, int field)
{
    double value;
    if (OGR_Fld_GetType(OGR_F_GetFieldDefnRef(feature, field)) != OFTString)
        return OGR_F_GetFieldAsDouble(feature, field);
    const char *text = OGR_F_GetFieldAsString(feature, field);
    text += strspn(text, " ");
    size_t n = strlen(text);
    while (n && text[n - 1] == ' ')
        n--;
    return gis_length_parse_number(text, n, &value) ? value : NAN;
}

static bool weigh_by_field(gis_layer_input *input, gis_error *error)
{
    int field;
    if (!gis_layer_field(input, OPT_WEIGHT_FIELD, &field, error))
        return false;
    if (field < 0)
        return true;
    OGRFieldDefnH definition = OGR_FD_GetFieldDefn(OGR_L_GetLayerDefn(gis_source_layer(input->source)), field);
    OGRFieldType type = OGR_Fld_GetType(definition);
    if (type != OFTInteger && type != OFTInteger64 && type != OFTReal && type != OFTString)
        return gis_fail(error, "--weight-field: field %s of layer %s is of type %s; numbers are needed",
                        OGR_Fld_GetNameRef(definition), gis_source_name(input->source), OGR_GetFieldTypeName(type));
    for (size_t i = 0; i < input->n; i++) {
        OGRFeatureH feature = gis_source_feature(input->source, i);
        if (input->feature[i].ignored || gis_field_is_blank(feature, field))
            continue;
        double weight = number_in(feature, field);
        if (!(weight > 0) || !isfinite(weight)) {
            char who[512];
            gis_feature_name(input, i, who, sizeof who);
            return gis_fail(error, "%s: the weight in %s is %s; it must be a finite number greater than 0", who,
                            OGR_Fld_GetNameRef(definition),
                            type == OFTReal ? CPLSPrintf("%g", weight) : OGR_F_GetFieldAsString(feature, field));
        }
        input->feature[i].weight *= weight;
    }
    return true;
}

bool gis_layer_weights(gis_layer_input *input, gis_error *error)
{
    const gis_options *options = input->options;
    const char *kind = options->text[OPT_WEIGHT];
    if (kind && strcmp(kind, "1") != 0 && !weigh_by_area(input, strcmp(kind, "sqrt-area") == 0, error))
        return false;
    if (!weigh_by_field(input, error))
        return false;
    for (size_t i = 0; i < input->n; i++) {
        double weight = input->feature[i].weight;
        if (input->feature[i].ignored) {
            input->feature[i].weight = 1; /* it is not asked for, and may have been anything */
        } else if (!(weight > 0) || !isfinite(weight)) {
            char who[512];
            gis_feature_name(input, i, who, sizeof who);
            return gis_fail(error, "%s: its weight, %g, is not a finite number greater than 0", who, weight);
        }
    }
    return true;
}

static sunder_layer_options core_options(const gis_layer_input *input)
{
    const gis_options *options = input->options;
    /* Symbols that lie on each other are what a layer of points is separated for; buildings that do belong together. */
    const char *contained = input->points && !options->given[OPT_CONTAINED] ? "separate" : options->text[OPT_CONTAINED];
    sunder_layer_options core;
    sunder_layer_options_init(&core);
    core.gap = input->gap;
    core.touch_tolerance = input->tolerance;
    core.no_blocks = options->given[OPT_NO_BLOCKS];
    core.list_inside = options->given[OPT_LIST_INSIDE];
    core.contained = strcmp(contained, "ignore") == 0     ? SUNDER_CONTAINMENT_IGNORE
                     : strcmp(contained, "separate") == 0 ? SUNDER_CONTAINMENT_SEPARATE
                                                          : SUNDER_CONTAINMENT_BLOCK;
    double threads = options->given[OPT_THREADS] ? options->number[OPT_THREADS] : 0;
    core.threads = threads > 4096 ? 4096 : (unsigned)threads;
    return core;
}

bool gis_layer_run(const gis_layer_input *input, gis_layer_work *work, gis_progress *progress, sunder_report **report,
                   sunder_layer_summary *summary, gis_error *error)
{
    sunder_layer_options how = core_options(input);
    sunder_error why;
    how.progress = gis_progress_call;
    how.progress_user = progress;
    sunder_status status = work(input->layer, &how, report, &why);
    if (status == SUNDER_EARG)
        return gis_fail_usage(error, "%s", why.message);
    if (status != SUNDER_OK)
        return gis_fail(error, "layer %s: %s", gis_source_name(input->source), why.message);
    sunder_report_summary(*report, summary);
    return true;
}
