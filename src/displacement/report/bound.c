/* Computes the lower bound that the pairs in conflict prove.
 *
 * If d_ij is the least relative move that separates the pair (i, j), every solution has |t_i| + |t_j| >= d_ij for the
 * moves t of the two bodies. So its cost is at least the optimum of
 *     min sum w_i r_i^2,  r_i + r_j >= d_ij,  r >= 0,  r_i = 0 where i is fixed,
 * and by weak duality at least sum l_ij d_ij - sum_i (sum_j l_ij)^2 / (4 w_i), over bodies i that may move, for any
 * l >= 0. Coordinate ascent finds the multipliers l; they need not be optimal, only non-negative. The value is then
 * computed so that no rounding can make it too large: terms that are added are rounded downwards, and terms that are
 * subtracted upwards. */
#include "displacement/report/report.h"
#include "displacement/report/tuning.h"

#include "base/extremes.h"
#include "base/list.h"
#include "base/union_find.h"

#include <math.h>
#include <stdlib.h>

/* Return the next smaller and the next larger double. One such step covers the half unit in the last place by which a
 * single operation rounds. */
static double round_down(double v) { return nextafter(v, -INFINITY); }
static double round_up(double v) { return nextafter(v, INFINITY); }

/* Returns a lower bound of the weight of a body: the weights of its members, each addition rounded downwards. */
static double weight_below(const sunder_i_model *model, const sunder_i_body *body)
{
    double w = 0;
    for (uint32_t k = 0; k < body->members; k++) {
        const uint32_t f = model->member[body->member + k];
        const double own = model->present[f] ? sunder_i_feature(model->layer, f).weight : 0;
        w = w > 0 ? round_down(w + own) : own;
    }
    return w;
}

/* Runs coordinate ascent on the n pairs whose indices are which[].b, a connected component of the pairs. The number of
 * sweeps depends on these pairs only. load[body] is the sum of the multipliers of the body's pairs. */
static void ascend_component(const sunder_i_model *model, sunder_bound_pair *pairs, const sunder_i_id_pair *which,
                             size_t n, double *load)
{
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        double moved = 0, scale = 0;
        for (size_t k = 0; k < n; k++) {
            sunder_bound_pair *pair = &pairs[which[k].b];
            const uint32_t i = model->body_of[pair->a], j = model->body_of[pair->b];
            const double mi = model->body[i].fixed ? 0 : 0.5 / model->body[i].weight;
            const double mj = model->body[j].fixed ? 0 : 0.5 / model->body[j].weight;
            if (!(mi + mj > 0)) continue;
            double change = (pair->least - mi * load[i] - mj * load[j]) / (mi + mj);
            if (change < -pair->multiplier) change = -pair->multiplier;
            pair->multiplier += change;
            if (mi > 0) load[i] += change;
            if (mj > 0) load[j] += change;
            moved = sunder_i_max(moved, fabs(change) * (mi + mj));
            scale = sunder_i_max(scale, pair->least);
        }
        if (moved <= STILL * scale) break;
    }
}

/* Runs the ascent for each connected component of the pairs by itself; fixed bodies do not connect pairs. which: [n]
 * scratch, filled with (root of the component, index of the pair). Multipliers that are negative or not finite are set
 * to 0 at the end. */
static void ascend_all(const sunder_i_model *model, sunder_bound_pair *pairs, sunder_i_id_pair *which, size_t n,
                       uint32_t *root, double *load)
{
    sunder_i_union_init(root, model->bodies);
    for (size_t k = 0; k < n; k++) {
        const uint32_t i = model->body_of[pairs[k].a], j = model->body_of[pairs[k].b];
        if (!model->body[i].fixed && !model->body[j].fixed) sunder_i_union_join(root, i, j);
    }
    for (size_t k = 0; k < n; k++) {
        const uint32_t i = model->body_of[pairs[k].a], j = model->body_of[pairs[k].b];
        which[k] = (sunder_i_id_pair){sunder_i_union_find(root, model->body[i].fixed ? j : i), (uint32_t)k};
    }
    qsort(which, n, sizeof *which, sunder_i_by_id_pair);
    for (size_t k = 0, end; k < n; k = end) {
        for (end = k + 1; end < n && which[end].a == which[k].a;) end++;
        ascend_component(model, pairs, which + k, end - k, load);
    }
    for (size_t k = 0; k < n; k++)
        if (!(pairs[k].multiplier > 0) || !isfinite(pairs[k].multiplier)) pairs[k].multiplier = 0;
}

/* Adds what the pairs prove of each part of the layer to value[] at the part's root, rounded downwards. load: [bodies],
 * all 0 before the call. */
static void add_up(const sunder_i_model *model, const sunder_bound_pair *pairs, size_t n, uint32_t *root, double *load,
                   double *value)
{
    for (size_t k = 0; k < n; k++) {
        const uint32_t i = model->body_of[pairs[k].a], j = model->body_of[pairs[k].b];
        if (!(pairs[k].multiplier > 0)) continue;
        const uint32_t at = sunder_i_union_find(root, model->body[i].fixed ? j : i);
        value[at] = round_down(value[at] + round_down(pairs[k].multiplier * pairs[k].least));
        load[i] = round_up(load[i] + pairs[k].multiplier);
        load[j] = round_up(load[j] + pairs[k].multiplier);
    }
    for (uint32_t b = 0; b < model->bodies; b++) {
        if (!(load[b] > 0) || model->body[b].fixed) continue;
        const uint32_t at = sunder_i_union_find(root, b);
        value[at] =
            round_down(value[at] - round_up(round_up(load[b] * load[b]) / (4 * weight_below(model, &model->body[b]))));
    }
}

static double positive_or_0(double value) { return value > 0 && isfinite(value) ? value : 0; }

/* Returns the total bound, rounded downwards. value[] contains what is proved of each component, at its root; negative
 * values are set to 0, and the pairs of such components get the multiplier 0. */
static double bound_of(const sunder_i_model *model, sunder_bound_pair *pairs, size_t n, uint32_t *root, double *value)
{
    sunder_total total = {0};
    for (size_t k = 0; k < n; k++) {
        const uint32_t i = model->body_of[pairs[k].a], j = model->body_of[pairs[k].b];
        if (!(value[sunder_i_union_find(root, model->body[i].fixed ? j : i)] > 0)) pairs[k].multiplier = 0;
    }
    for (size_t b = 0; b < model->bodies; b++) sunder_total_add(&total, value[b] = positive_or_0(value[b]));
    return sunder_total_below(&total);
}

sunder_status sunder_i_bound(const sunder_i_model *model, sunder_bound_pair *pairs, size_t n, double *bound,
                             double **proved, sunder_error *err)
{
    *bound = 0;
    *proved = NULL;
    if (n == 0) return SUNDER_OK;
    double *load = sunder_i_calloc(model->bodies, sizeof *load), *value = sunder_i_calloc(model->bodies, sizeof *value);
    uint32_t *root = sunder_i_alloc(model->bodies, sizeof *root);
    sunder_i_id_pair *which = sunder_i_alloc(n, sizeof *which);
    const bool ok = load && value && root && which;
    if (ok) {
        ascend_all(model, pairs, which, n, root, load);
        /* A pair of two fixed bodies has no solution at all, so it contributes nothing to a bound. */
        for (size_t k = 0; k < n; k++)
            if (model->body[model->body_of[pairs[k].a]].fixed && model->body[model->body_of[pairs[k].b]].fixed)
                pairs[k].multiplier = 0;
        for (size_t b = 0; b < model->bodies; b++) load[b] = 0;
        add_up(model, pairs, n, root, load, value);
        *bound = bound_of(model, pairs, n, root, value);
    }
    if (ok && model->rules.keep_worlds)
        *proved = value;
    else
        sunder_i_free(value);
    sunder_i_free_all(load, root, which);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

bool sunder_i_bound_parts(const sunder_i_model *model, const sunder_bound_pair *pairs, size_t n, uint32_t *root,
                          double *value)
{
    double *load = sunder_i_calloc(model->bodies, sizeof *load);
    if (!load) return false;
    add_up(model, pairs, n, root, load, value);
    for (size_t b = 0; b < model->bodies; b++) value[b] = positive_or_0(value[b]);
    sunder_i_free(load);
    return true;
}
