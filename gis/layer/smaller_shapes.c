/* smaller_shapes.c: the smaller shapes that features may have: cut back at barriers by --trim. */
#include "layer/layer_input.h"

#include "base/core_error.h"
#include "base/message.h"
#include "sunder_hiding.h"

#include <math.h>
#include <stdlib.h>

double gis_layer_share_lost(const gis_layer_input *input, size_t i)
{
    return 1 - sunder_shape_area(input->smaller[i]) / sunder_shape_area(input->shape[i]);
}

/* The cost of the smaller shape: the weight for hiding the feature times the share that it loses, in millionths. */
static int64_t cost_of(const gis_layer_input *input, size_t i)
{
    const double cost = GIS_SHRINKING_UNIT / GIS_HIDING_UNIT * (double)gis_layer_hiding_cost(input, i).weight *
                        gis_layer_share_lost(input, i);
    return (int64_t)fmax(1, fmin(nearbyint(cost), (double)SUNDER_GREATEST_HIDING_WEIGHT));
}

/* Drops the smaller shapes of the features that --rigid-where selects. */
static bool keep_rigid(gis_layer_input *input, gis_error *error)
{
    const char *where = input->request->rules.rigid_where;
    if (!where) return true;
    bool *rigid = calloc(input->n + 1, sizeof *rigid);
    const bool ok = rigid ? gis_source_mark(input->source, "--rigid-where", where, rigid, error) : gis_no_memory(error);
    for (size_t i = 0; ok && i < input->n; i++) {
        if (!rigid[i]) continue;
        sunder_shape_free(input->smaller[i]);
        input->smaller[i] = NULL;
    }
    free(rigid);
    return ok;
}

bool gis_layer_set_levels(const gis_layer_input *input, const size_t *matched, size_t n, sunder_layer *layer,
                          gis_error *error)
{
    sunder_error why;
    if (!input->smaller) return true;
    sunder_level *level = malloc((n + 1) * sizeof *level);
    size_t *end = malloc((n + 1) * sizeof *end), levels = 0;
    bool ok = (level && end) || gis_no_memory(error);
    for (size_t k = 0; ok && k < n; k++) {
        const size_t i = matched ? matched[k] : k;
        if (input->smaller[i]) level[levels++] = (sunder_level){input->smaller[i], cost_of(input, i)};
        end[k] = levels;
    }
    if (ok && sunder_layer_set_levels(layer, level, end, &why) != SUNDER_OK)
        ok = gis_core_failed(error, "--trim", &why);
    free(level);
    free(end);
    return ok;
}

bool gis_layer_set_smaller(gis_layer_input *input, gis_error *error)
{
    const gis_layer_rules *rules = &input->request->rules;
    const sunder_trimming how = {rules->trim_keep, input->min_size};
    sunder_error why;
    if (!rules->trim) return true;
    const sunder_layer_options core = gis_layer_core_options(input);
    input->smaller = calloc(input->n + 1, sizeof *input->smaller);
    if (!input->smaller) return gis_no_memory(error);
    if (sunder_layer_trim(input->layer, &core, &how, input->smaller, &why) != SUNDER_OK)
        return gis_core_failed(error, "--trim", &why);
    return keep_rigid(input, error) && gis_layer_set_levels(input, NULL, input->n, input->layer, error);
}
