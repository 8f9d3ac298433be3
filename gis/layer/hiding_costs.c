/* hiding_costs.c: what it costs to hide each feature, its class by --hierarchy-field and its weight by --hide-weight;
 * and which features of a result are hidden. */
#include "layer/layer_input.h"

#include "base/core_error.h"
#include "read/fields.h"
#include "sunder_hiding.h"

#include <math.h>
#include <stdlib.h>

/* Weights are whole numbers of thousandths. */
static int64_t weight_of(gis_weighting by, double area)
{
    const double weight = by == GIS_WEIGHTING_EVEN ? 1 : by == GIS_WEIGHTING_AREA ? area : sqrt(area);
    return (int64_t)fmax(1, fmin(nearbyint(GIS_HIDING_UNIT * weight), (double)SUNDER_GREATEST_HIDING_WEIGHT));
}

/* The value of --hierarchy-field of feature i; NAN if it is null. */
static double class_value(const gis_layer_input *input, size_t i)
{
    OGRFeatureH feature = gis_source_attributes(input->source, i);
    return gis_field_is_blank(feature, input->hierarchy_field) ? NAN
                                                               : gis_field_number(feature, input->hierarchy_field);
}

sunder_hiding_cost gis_layer_hiding_cost(const gis_layer_input *input, size_t i)
{
    input = gis_layer_own(input, &i);
    const sunder_shape *shape = gis_layer_original(input, i);
    const double area = shape ? sunder_shape_area(shape) : 0;
    const double value = input->hierarchy_field < 0 ? 1 : class_value(input, i);
    return (sunder_hiding_cost){isnan(value) ? GIS_LAST_CLASS : (uint32_t)value,
                                weight_of(input->request->rules.hide_weighting, area)};
}

bool gis_layer_check_class(const gis_layer_input *input, size_t i, gis_error *error)
{
    if (input->hierarchy_field < 0 || input->feature[i].ignored) return true;
    const double value = class_value(input, i);
    if (gis_field_is_blank(gis_source_attributes(input->source, i), input->hierarchy_field) ||
        (value >= 0 && value == floor(value) && value < GIS_LAST_CLASS))
        return true;
    return gis_layer_wrong_number(input, i, input->hierarchy_field, "class", "a whole number, 0 or more", error);
}

bool gis_layer_mark_hidden(gis_layer_input *input, gis_error *error)
{
    const int field = input->hidden_field;
    for (size_t i = 0; field >= 0 && i < input->n; i++) {
        OGRFeatureH feature = gis_source_attributes(input->source, i);
        if (!gis_layer_check_class(input, i, error)) return false;
        if (gis_field_is_blank(feature, field) || gis_field_number(feature, field) == 0) continue;
        if (gis_layer_hiding_cost(input, i).hierarchy) input->feature[i].ignored = true;
    }
    return true;
}

bool gis_layer_set_hiding(gis_layer_input *input, gis_error *error)
{
    sunder_error why;
    if (!input->request->rules.hide) return true;
    sunder_hiding_cost *cost = malloc((input->n + 1) * sizeof *cost);
    bool ok = cost || gis_no_memory(error);
    for (size_t i = 0; i < input->n && ok; i++) {
        size_t k = i;
        const gis_layer_input *own = gis_layer_own(input, &k);
        ok = gis_layer_check_class(own, k, error);
        const bool may = ok && !own->request->rules.never_hidden && !input->feature[i].ignored;
        cost[i] = may ? gis_layer_hiding_cost(own, k) : (sunder_hiding_cost){0, 1};
    }
    if (ok && sunder_layer_set_hiding(input->layer, cost, &why) != SUNDER_OK)
        ok = gis_core_failed(error, "--hide", &why);
    free(cost);
    return ok;
}
