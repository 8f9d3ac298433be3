/* rungs.c: see rungs.h. */
#include "layer/rungs.h"

#include "base/core_error.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool gis_levels_asked(const gis_layer_rules *rules)
{
    return rules->trim || rules->inset || rules->symbol_size.text || rules->enlarge;
}

bool gis_rung_asked(const gis_layer_rules *rules, gis_rung kind)
{
    return kind == GIS_RUNG_TRIMMED ? rules->trim
           : kind == GIS_RUNG_INSET ? rules->inset != NULL
                                    : rules->symbol_size.text != NULL;
}

void gis_levels_clear(gis_levels *levels)
{
    for (size_t k = 0; levels->shape && k < levels->features * levels->rungs; k++) sunder_shape_free(levels->shape[k]);
    free(levels->shape);
    free(levels->cost);
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

/* ---- Lengths ----------------------------------------------------------------------------------------------------- */

static bool read_insets(const gis_layer_rules *rules, const gis_crs_units *units, gis_rung_lengths *out,
                        gis_error *error)
{
    const char *text = rules->inset;
    double last = 0;
    if (!text) return true;
    out->inset = malloc((strlen(text) + 1) * sizeof *out->inset);
    if (!out->inset) return gis_no_memory(error);
    for (size_t n; text; text = text[n] ? text + n + 1 : NULL) {
        gis_length length;
        const char *why;
        double *to = &out->inset[out->insets++];
        n = strcspn(text, ",");
        if (!gis_length_parse(text, n, &length, &why))
            return gis_fail_usage(error, "--inset %.*s: %s", (int)n, text, why);
        if (!gis_length_in_layer_units(&length, units, "--inset", to, error)) return false;
        if (!(*to > last))
            return gis_fail_usage(error, "--inset %s: lengths are above 0, and each is greater than the one before",
                                  rules->inset);
        last = *to;
    }
    return true;
}

bool gis_rung_lengths_read(const gis_layer_rules *rules, const gis_crs_units *units, gis_rung_lengths *out,
                           gis_error *error)
{
    *out = (gis_rung_lengths){0};
    return gis_optional_length_in_layer_units(&rules->min_size, units, "--min-size", &out->min_size, error) &&
           gis_optional_length_in_layer_units(&rules->symbol_size, units, "--symbol-size", &out->symbol_size, error) &&
           read_insets(rules, units, out, error);
}

void gis_rung_lengths_clear(gis_rung_lengths *lengths)
{
    free(lengths->inset);
    *lengths = (gis_rung_lengths){0};
}

/* ---- Making ------------------------------------------------------------------------------------------------------ */

/* Features are scaled by these before they become a square: last choices, since they open shared walls. */
static const double factor[] = {0.8, 0.6};
enum { FACTORS = sizeof factor / sizeof *factor };

/* What is at work: `one` is scratch for the shapes of some rungs. */
typedef struct maker {
    const gis_rung_request *of;
    gis_levels *levels;
    sunder_shape **one;   /* [n * the rungs that are made at once] */
    sunder_shape **least; /* [n] the smallest shapes so far, borrowed; NULL: as given */
    size_t made;          /* the number of rungs made */
} maker;

static bool begin(maker *m, gis_error *error)
{
    const gis_layer_rules *rules = m->of->rules;
    gis_levels *levels = m->levels;
    levels->features = m->of->n;
    levels->rungs = rules->trim + m->of->lengths->insets + (rules->symbol_size.text ? FACTORS + 1 : 0);
    const size_t all = levels->features * levels->rungs;
    levels->shape = calloc(all + 1, sizeof *levels->shape);
    levels->cost = calloc(all + 1, sizeof *levels->cost);
    levels->kind = calloc(levels->rungs + 1, sizeof *levels->kind);
    m->one = calloc(all + 1, sizeof(sunder_shape *));
    m->least = calloc(levels->features + 1, sizeof(sunder_shape *));
    return (levels->shape && levels->cost && levels->kind && m->one && m->least) || gis_no_memory(error);
}

/* The cost of a smaller shape of feature k: the weight for hiding the feature times the share that it loses, in
 * millionths. */
static int64_t cost_of(const gis_rung_request *of, size_t k, const sunder_shape *smaller)
{
    const double lost = 1 - sunder_shape_area(smaller) / sunder_shape_area(of->shape[k]);
    const double cost = GIS_SHRINKING_UNIT / GIS_HIDING_UNIT * (double)of->weight[k] * lost;
    return (int64_t)fmax(1, fmin(nearbyint(cost), (double)SUNDER_GREATEST_HIDING_WEIGHT));
}

/* Takes over the shapes in m->one, `rungs` for each feature, except those of rigid features: later rungs of their
 * neighbours are made beside the shapes that they keep. The last rung has a kind of its own. */
static void take_rungs(maker *m, gis_rung kind, size_t rungs, gis_rung last)
{
    gis_levels *levels = m->levels;
    for (size_t k = 0; k < levels->features; k++)
        for (size_t rung = 0; rung < rungs; rung++) {
            sunder_shape *shape = m->one[k * rungs + rung];
            const size_t to = k * levels->rungs + m->made + rung;
            if (!shape) continue;
            if (m->of->rigid && m->of->rigid[k]) {
                sunder_shape_free(shape);
                continue;
            }
            levels->shape[to] = m->least[k] = shape;
            levels->cost[to] = cost_of(m->of, k, shape);
        }
    memset(m->one, 0, levels->features * rungs * sizeof *m->one);
    for (size_t k = 0; k < rungs; k++) levels->kind[m->made++] = k + 1 < rungs ? kind : last;
}

static bool trim(maker *m, gis_error *error)
{
    const sunder_trimming how = {m->of->rules->trim_keep, m->of->lengths->min_size};
    sunder_error why;
    if (!m->of->rules->trim) return true;
    if (sunder_layer_trim(m->of->layer, &m->of->core, &how, m->one, &why) != SUNDER_OK)
        return gis_core_failed(error, "--trim", &why);
    take_rungs(m, GIS_RUNG_TRIMMED, 1, GIS_RUNG_TRIMMED);
    return true;
}

/* Moves in the outlines of blocks, as the rungs so far leave them. */
static bool inset(maker *m, gis_error *error)
{
    const gis_rung_lengths *lengths = m->of->lengths;
    const sunder_inset how = {lengths->inset, lengths->insets, lengths->min_size};
    sunder_error why;
    if (!how.lengths) return true;
    if (sunder_layer_inset(m->of->layer, &m->of->core, &how, m->least, m->one, &why) != SUNDER_OK)
        return gis_core_failed(error, "--inset", &why);
    take_rungs(m, GIS_RUNG_INSET, how.lengths, GIS_RUNG_INSET);
    return true;
}

/* Scales features, and makes squares of them at last. */
static bool scale(maker *m, gis_error *error)
{
    const sunder_scaling how = {factor, FACTORS, m->of->lengths->symbol_size, m->of->lengths->min_size};
    sunder_error why;
    if (!m->of->rules->symbol_size.text) return true;
    if (sunder_layer_scale(m->of->layer, &m->of->core, &how, m->least, m->one, &why) != SUNDER_OK)
        return gis_core_failed(error, "--symbol-size", &why);
    take_rungs(m, GIS_RUNG_SCALED, FACTORS + 1, GIS_RUNG_SYMBOL);
    return true;
}

bool gis_rungs_make(const gis_rung_request *request, gis_levels *out, gis_error *error)
{
    maker m = {.of = request, .levels = out};
    *out = (gis_levels){0};
    if (!gis_levels_asked(request->rules)) return true;
    const bool ok = begin(&m, error) && trim(&m, error) && inset(&m, error) && scale(&m, error);
    free(m.one);
    free(m.least);
    return ok;
}

bool gis_rungs_set(const gis_layer_rules *rules, double min_size, const gis_levels *levels, const size_t *matched,
                   size_t n, sunder_layer *layer, const char *name, gis_error *error)
{
    const sunder_trimming least = {rules->trim ? rules->trim_keep : 0, min_size};
    sunder_error why;
    if (!gis_levels_asked(rules)) return true;
    sunder_layer_set_least(layer, &least);
    sunder_level *level = malloc((levels->features * levels->rungs + 1) * sizeof *level);
    size_t *end = malloc((n + 1) * sizeof *end), made = 0;
    bool ok = (level && end) || gis_no_memory(error);
    for (size_t k = 0; ok && k < n; k++) {
        const size_t first = (matched ? matched[k] : k) * levels->rungs;
        for (size_t at = first; at < first + levels->rungs; at++)
            if (levels->shape[at]) level[made++] = (sunder_level){levels->shape[at], levels->cost[at]};
        end[k] = made;
    }
    if (ok && sunder_layer_set_levels(layer, level, end, &why) != SUNDER_OK) ok = gis_core_failed(error, name, &why);
    free(level);
    free(end);
    return ok;
}
