/* levels.c: see levels.h. */
#include "layer/levels.h"

#include "base/core_error.h"
#include "base/message.h"
#include "sunder_hiding.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool gis_levels_asked(const gis_layer_rules *rules)
{
    return rules->trim || rules->inset || rules->symbol_size.text || rules->enlarge;
}

void gis_levels_clear(gis_levels *levels)
{
    for (size_t k = 0; levels->shape && k < levels->features * levels->rungs; k++) sunder_shape_free(levels->shape[k]);
    free(levels->shape);
    free(levels->kind);
    *levels = (gis_levels){0};
}

size_t gis_levels_rung(const gis_levels *levels, size_t i, size_t k)
{
    size_t rung = 0;
    for (size_t found = 0; rung < levels->rungs; rung++)
        if (gis_levels_shape(levels, i, rung) && ++found == k) break;
    return rung;
}

const sunder_shape *gis_levels_shape_now(const gis_layer_input *input, const sunder_report *report, size_t i)
{
    const size_t level = sunder_report_level(report, i);
    if (sunder_report_status(report, i) == SUNDER_FEATURE_HIDDEN) return gis_layer_original(input, i);
    return level ? gis_levels_shape(&input->levels, i, gis_levels_rung(&input->levels, i, level)) : input->shape[i];
}

/* ---- The cost ---------------------------------------------------------------------------------------------------- */

/* The cost of a smaller shape of feature i: the weight for hiding the feature times the share that it loses, in
 * millionths. */
static int64_t cost_of(const gis_layer_input *input, size_t i, const sunder_shape *smaller)
{
    const double lost = 1 - sunder_shape_area(smaller) / sunder_shape_area(input->shape[i]);
    const double cost = GIS_SHRINKING_UNIT / GIS_HIDING_UNIT * (double)gis_layer_hiding_cost(input, i).weight * lost;
    return (int64_t)fmax(1, fmin(nearbyint(cost), (double)SUNDER_GREATEST_HIDING_WEIGHT));
}

bool gis_levels_set(const gis_layer_input *input, const gis_levels *levels, const size_t *matched, size_t n,
                    sunder_layer *layer, gis_error *error)
{
    const gis_layer_rules *rules = &input->request->rules;
    const sunder_trimming least = {rules->trim ? rules->trim_keep : 0, input->min_size};
    sunder_error why;
    if (!gis_levels_asked(rules)) return true;
    sunder_layer_set_least(layer, &least);
    sunder_level *level = malloc((levels->features * levels->rungs + 1) * sizeof *level);
    size_t *end = malloc((n + 1) * sizeof *end), made = 0;
    bool ok = (level && end) || gis_no_memory(error);
    for (size_t k = 0; ok && k < n; k++) {
        const size_t i = matched ? matched[k] : k;
        for (size_t rung = 0; rung < levels->rungs; rung++) {
            const sunder_shape *shape = gis_levels_shape(levels, i, rung);
            if (shape) level[made++] = (sunder_level){shape, cost_of(input, i, shape)};
        }
        end[k] = made;
    }
    if (ok && sunder_layer_set_levels(layer, level, end, &why) != SUNDER_OK)
        ok = gis_core_failed(error, gis_source_name(input->source), &why);
    free(level);
    free(end);
    return ok;
}

/* ---- Rungs ------------------------------------------------------------------------------------------------------- */

/* Features are scaled by these before they become a square: last choices, since they open shared walls. */
static const double factor[] = {0.8, 0.6};
enum { FACTORS = sizeof factor / sizeof *factor };

/* What is at work: `one` is scratch for the shapes of some rungs. */
typedef struct maker {
    const gis_layer_input *input;
    const sunder_layer *layer;
    sunder_layer_options core;
    gis_levels *levels;
    sunder_shape **one;   /* [features * the rungs that are made at once] */
    sunder_shape **least; /* [features] the smallest shapes so far, borrowed; NULL: as given */
    size_t made;          /* the number of rungs made */
    bool *rigid;          /* [features] their shapes never change; NULL: all may */
} maker;

static bool begin(maker *m, size_t n, gis_error *error)
{
    const gis_layer_rules *rules = &m->input->request->rules;
    gis_levels *levels = m->levels;
    levels->features = n;
    levels->rungs = rules->trim + m->input->insets + (rules->symbol_size.text ? FACTORS + 1 : 0);
    levels->shape = calloc(n * levels->rungs + 1, sizeof *levels->shape);
    levels->kind = calloc(levels->rungs + 1, sizeof *levels->kind);
    m->one = calloc(n * levels->rungs + 1, sizeof(sunder_shape *));
    m->least = calloc(n + 1, sizeof(sunder_shape *));
    return ((levels->shape && levels->kind && m->one && m->least) || gis_no_memory(error)) &&
           gis_levels_rigid(m->input, &m->rigid, error);
}

/* Takes over the shapes in m->one, `rungs` for each feature, except those of rigid features: later rungs of their
 * neighbours are made beside the shapes that they keep. The last rung has a kind of its own. */
static void take_rungs(maker *m, gis_rung kind, size_t rungs, gis_rung last)
{
    gis_levels *levels = m->levels;
    for (size_t k = 0; k < levels->features; k++)
        for (size_t rung = 0; rung < rungs; rung++) {
            sunder_shape *shape = m->one[k * rungs + rung];
            if (m->rigid && m->rigid[k]) {
                sunder_shape_free(shape);
                continue;
            }
            levels->shape[k * levels->rungs + m->made + rung] = shape;
            if (shape) m->least[k] = shape;
        }
    memset(m->one, 0, levels->features * rungs * sizeof *m->one);
    for (size_t k = 0; k < rungs; k++) levels->kind[m->made++] = k + 1 < rungs ? kind : last;
}

static bool trim(maker *m, gis_error *error)
{
    const gis_layer_rules *rules = &m->input->request->rules;
    const sunder_trimming how = {rules->trim_keep, m->input->min_size};
    sunder_error why;
    if (!rules->trim) return true;
    if (sunder_layer_trim(m->layer, &m->core, &how, m->one, &why) != SUNDER_OK)
        return gis_core_failed(error, "--trim", &why);
    take_rungs(m, GIS_RUNG_TRIMMED, 1, GIS_RUNG_TRIMMED);
    return true;
}

/* Moves in the outlines of blocks, as the rungs so far leave them. */
static bool inset(maker *m, gis_error *error)
{
    const sunder_inset how = {m->input->inset, m->input->insets, m->input->min_size};
    sunder_error why;
    if (!how.lengths) return true;
    if (sunder_layer_inset(m->layer, &m->core, &how, m->least, m->one, &why) != SUNDER_OK)
        return gis_core_failed(error, "--inset", &why);
    take_rungs(m, GIS_RUNG_INSET, how.lengths, GIS_RUNG_INSET);
    return true;
}

/* Scales features, and makes squares of them at last. */
static bool scale(maker *m, gis_error *error)
{
    const sunder_scaling how = {factor, FACTORS, m->input->symbol_size, m->input->min_size};
    sunder_error why;
    if (!m->input->request->rules.symbol_size.text) return true;
    if (sunder_layer_scale(m->layer, &m->core, &how, m->least, m->one, &why) != SUNDER_OK)
        return gis_core_failed(error, "--symbol-size", &why);
    take_rungs(m, GIS_RUNG_SCALED, FACTORS + 1, GIS_RUNG_SYMBOL);
    return true;
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
    maker m = {.input = input, .layer = layer, .core = gis_layer_core_options(input), .levels = out};
    *out = (gis_levels){0};
    if (!gis_levels_asked(&input->request->rules)) return true;
    const bool ok = begin(&m, input->n, error) && trim(&m, error) && inset(&m, error) && scale(&m, error);
    free(m.rigid);
    free(m.one);
    free(m.least);
    return ok;
}
