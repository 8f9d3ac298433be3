/* What no displacement can beat.
 *
 * If d is the least separation of a pair, every solution has |t_i| + |t_j| >= d. So its cost is at least the optimum of
 *     min sum w_i r_i^2,  r_i + r_j >= d_ij,  r >= 0,  r_i = 0 where i is fixed,
 * and by weak duality at least sum l_ij d_ij - sum_i (sum_j l_ij)^2 / (4 w_i), over bodies i that may move, for any l
 * >= 0. The multipliers l are found by coordinate ascent; they need not be optimal, only non-negative. The value is
 * then computed with every operation rounded against us: downwards what is added, upwards what is taken away. */
#include "displacement/report/report.h"
#include "displacement/report/tuning.h"

#include <math.h>

/* One step down, or up, covers the half unit that a single operation rounds by. */
static double down(double v) { return nextafter(v, -INFINITY); }
static double up(double v) { return nextafter(v, INFINITY); }

/* A lower bound of the weight of a body: its members' weights are added downwards. */
static double weight_below(const sunder_i_model *model, const sunder_i_body *body)
{
    double w = 0;
    for (uint32_t k = 0; k < body->members; k++) {
        const double own = model->layer->feature[model->member[body->member + k]].weight;
        w = k ? down(w + own) : own;
    }
    return w;
}

static void ascend(const sunder_i_model *model, sunder_bound_pair *pairs, size_t n, double *load)
{
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        double moved = 0, scale = 0;
        for (size_t k = 0; k < n; k++) {
            const uint32_t i = model->body_of[pairs[k].a], j = model->body_of[pairs[k].b];
            const double mi = model->body[i].fixed ? 0 : 0.5 / model->body[i].weight;
            const double mj = model->body[j].fixed ? 0 : 0.5 / model->body[j].weight;
            if (!(mi + mj > 0)) continue;
            double change = (pairs[k].least - mi * load[i] - mj * load[j]) / (mi + mj);
            if (change < -pairs[k].multiplier) change = -pairs[k].multiplier;
            pairs[k].multiplier += change;
            load[i] += change;
            load[j] += change;
            moved = fmax(moved, fabs(change) * (mi + mj));
            scale = fmax(scale, pairs[k].least);
        }
        if (moved <= STILL * scale) break;
    }
    for (size_t k = 0; k < n; k++)
        if (!(pairs[k].multiplier > 0) || !isfinite(pairs[k].multiplier)) pairs[k].multiplier = 0;
}

sunder_status sunder_i_bound(const sunder_i_model *model, sunder_bound_pair *pairs, size_t n, double *bound,
                             sunder_error *err)
{
    *bound = 0;
    if (n == 0) return SUNDER_OK;
    double *load = sunder_i_calloc(model->bodies, sizeof *load);
    if (!load) return sunder_i_no_memory(err);
    ascend(model, pairs, n, load);
    for (size_t b = 0; b < model->bodies; b++) load[b] = 0;
    double value = 0;
    for (size_t k = 0; k < n; k++) {
        const uint32_t i = model->body_of[pairs[k].a], j = model->body_of[pairs[k].b];
        /* Two fixed bodies have no solution at all, and prove nothing. */
        if (model->body[i].fixed && model->body[j].fixed) pairs[k].multiplier = 0;
        if (!(pairs[k].multiplier > 0)) continue;
        value = down(value + down(pairs[k].multiplier * pairs[k].least));
        load[i] = up(load[i] + pairs[k].multiplier);
        load[j] = up(load[j] + pairs[k].multiplier);
    }
    for (size_t b = 0; b < model->bodies; b++) {
        if (!(load[b] > 0) || model->body[b].fixed) continue;
        const double w = weight_below(model, &model->body[b]);
        value = down(value - up(up(load[b] * load[b]) / (4 * w)));
    }
    sunder_i_free(load);
    *bound = value > 0 && isfinite(value) ? value : 0;
    return SUNDER_OK;
}
