/* levels.c: see levels.h. */
#include "layer/levels.h"

#include <stdlib.h>

const sunder_shape *gis_levels_shape_now(const gis_layer_input *input, const sunder_report *report, size_t i)
{
    const size_t level = sunder_report_level(report, i);
    if (sunder_report_status(report, i) == SUNDER_FEATURE_HIDDEN) return gis_layer_original(input, i);
    return level ? gis_levels_shape(&input->levels, i, gis_levels_rung(&input->levels, i, level)) : input->shape[i];
}

bool gis_levels_rigid(const gis_layer_input *input, bool **rigid, gis_error *error)
{
    const char *where = input->request->rules.rigid_where;
    *rigid = NULL;
    if (!where) return true;
    *rigid = calloc(input->n + 1, sizeof **rigid);
    return *rigid ? gis_source_mark(input->source, "--rigid-where", where, *rigid, error) : gis_no_memory(error);
}

bool gis_levels_make(const gis_layer_input *input, const sunder_layer *layer, gis_levels *out, gis_error *error)
{
    bool *rigid = NULL;
    *out = (gis_levels){0};
    if (!gis_levels_asked(&input->request->rules)) return true;
    int64_t *weight = malloc((input->n + 1) * sizeof *weight);
    bool ok = (weight || gis_no_memory(error)) && gis_levels_rigid(input, &rigid, error);
    for (size_t i = 0; ok && i < input->n; i++) weight[i] = gis_layer_hiding_cost(input, i).weight;
    const gis_rung_request request = {.rules = &input->request->rules,
                                      .lengths = &input->lengths,
                                      .core = gis_layer_core_options(input),
                                      .layer = layer,
                                      .n = input->n,
                                      .shape = (const sunder_shape *const *)input->shape,
                                      .weight = weight,
                                      .rigid = rigid};
    ok = ok && gis_rungs_make(&request, out, error);
    free(weight);
    free(rigid);
    return ok;
}

bool gis_levels_set(const gis_layer_input *input, const gis_levels *levels, const size_t *matched, size_t n,
                    sunder_layer *layer, gis_error *error)
{
    return gis_rungs_set(&input->request->rules, input->lengths.min_size, levels, matched, n, layer,
                         gis_source_name(input->source), error);
}
