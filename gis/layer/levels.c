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

/* The features that may have other shapes by the rules of `own`, one of the layers of `input`, or it. */
static bool find_rigid(const gis_layer_input *input, const gis_layer_input *own, bool **rigid, gis_error *error)
{
    bool *marked;
    if (own == input) return gis_levels_rigid(input, rigid, error);
    *rigid = malloc((input->n + 1) * sizeof **rigid);
    bool ok = (*rigid || gis_no_memory(error)) && gis_levels_rigid(own, &marked, error);
    for (size_t i = 0; ok && i < input->n; i++) (*rigid)[i] = own->points || i < own->first || i >= own->first + own->n;
    for (size_t i = 0; ok && marked && i < own->n; i++) (*rigid)[own->first + i] |= marked[i];
    if (ok) free(marked);
    return ok;
}

/* Makes the smaller shapes of the features of one layer by its rules, beside all features. */
static bool make_of(const gis_layer_input *input, const gis_layer_input *own, const int64_t *weight,
                    const sunder_layer *layer, gis_levels *out, gis_error *error)
{
    bool *rigid = NULL;
    *out = (gis_levels){0};
    if (!gis_levels_asked(&own->request->rules)) return true;
    bool ok = find_rigid(input, own, &rigid, error);
    const gis_rung_request request = {.rules = &own->request->rules,
                                      .lengths = &own->lengths,
                                      .core = gis_layer_core_options(input),
                                      .layer = layer,
                                      .n = input->n,
                                      .shape = (const sunder_shape *const *)input->shape,
                                      .weight = weight,
                                      .rigid = rigid};
    ok = ok && gis_rungs_make(&request, out, error);
    free(rigid);
    return ok;
}

/* Puts the rungs of layers after each other. A feature has those of its own layer. */
static bool join(gis_levels *of, size_t layers, gis_levels *out, gis_error *error)
{
    for (size_t k = 0; k < layers; k++) {
        out->rungs += of[k].rungs;
        if (of[k].rungs) out->features = of[k].features;
    }
    const size_t all = out->features * out->rungs;
    out->shape = calloc(all + 1, sizeof *out->shape);
    out->cost = calloc(all + 1, sizeof *out->cost);
    out->kind = calloc(out->rungs + 1, sizeof *out->kind);
    if (!out->shape || !out->cost || !out->kind) return gis_no_memory(error);
    for (size_t k = 0, first = 0; k < layers; first += of[k++].rungs) {
        for (size_t rung = 0; rung < of[k].rungs; rung++) out->kind[first + rung] = of[k].kind[rung];
        for (size_t at = 0; at < of[k].features * of[k].rungs; at++) {
            const size_t to = at / of[k].rungs * out->rungs + first + at % of[k].rungs;
            out->shape[to] = of[k].shape[at];
            out->cost[to] = of[k].cost[at];
            of[k].shape[at] = NULL; /* it is taken over */
        }
    }
    return true;
}

/* Makes those of layers that move together, each by its own rules. */
static bool make_together(const gis_layer_input *input, const int64_t *weight, const sunder_layer *layer,
                          gis_levels *out, gis_error *error)
{
    gis_levels *of = calloc(input->parts, sizeof *of);
    bool ok = of || gis_no_memory(error);
    for (size_t k = 0; ok && k < input->parts; k++) ok = make_of(input, &input->part[k], weight, layer, &of[k], error);
    ok = ok && join(of, input->parts, out, error);
    for (size_t k = 0; of && k < input->parts; k++) gis_levels_clear(&of[k]);
    free(of);
    return ok;
}

bool gis_levels_make(const gis_layer_input *input, const sunder_layer *layer, gis_levels *out, gis_error *error)
{
    *out = (gis_levels){0};
    if (!gis_levels_asked(&input->request->rules)) return true;
    int64_t *weight = malloc((input->n + 1) * sizeof *weight);
    bool ok = weight || gis_no_memory(error);
    for (size_t i = 0; ok && i < input->n; i++) weight[i] = gis_layer_hiding_cost(input, i).weight;
    ok = ok && (input->parts ? make_together(input, weight, layer, out, error)
                             : make_of(input, input, weight, layer, out, error));
    free(weight);
    return ok;
}

bool gis_levels_set(const gis_layer_input *input, const gis_levels *levels, const size_t *matched, size_t n,
                    sunder_layer *layer, gis_error *error)
{
    return gis_rungs_set(&input->request->rules, input->lengths.min_size, levels, matched, n, layer,
                         gis_source_name(input->source), error);
}
