/* Preferred places: the moves of bodies that cost nothing.
 *
 * The cost of a feature is w |t - t0|^2, with its move t and the move t0 that it prefers. All else stays relative to
 * where features stand in the layer: limits, sides, jumps, and what may not get worse. So a body that cannot be placed
 * otherwise still has its original place to return to, where no rule is broken.
 *
 * The members of a block move together, so their costs add up to W |t - m|^2 with the sum W of their weights and the
 * weighted mean m of their t0, and a sum that no move changes, which is not counted. m is rounded to a move after which
 * all coordinates are doubles (rounding.c), as for a single feature; the cost counts from there, so it can be 0. What
 * does not move has the preferred move 0. */
#include "displacement/layer/rounding.h"

#include <math.h>

/* Returns the weighted mean of coordinate c of the moves that the body's members prefer. It is exact if they are equal.
 * Members that are left out do not count. */
static double mean_of(const sunder_i_model *model, const sunder_i_body *body, size_t c)
{
    const double *preferred = model->layer->given->preferred;
    double first = 0, more = 0, weight = 0;
    for (uint32_t m = 0; m < body->members; m++) {
        const uint32_t f = model->member[body->member + m];
        const double own = sunder_i_feature(model->layer, f).weight,
                     to = preferred[2 * (size_t)model->layer->number[f] + c];
        if (!model->present[f]) continue;
        if (weight == 0) first = to;
        weight += own;
        more += own * (to - first);
    }
    return weight > 0 ? first + more / weight : 0;
}

double sunder_i_stray(const sunder_i_model *model, uint32_t body, const double t[2])
{
    const double *a = sunder_i_preferred(model, body);
    return hypot(t[0] - a[0], t[1] - a[1]);
}

bool sunder_i_model_prefer(sunder_i_model *model)
{
    bool any = false;
    if (!model->layer->given->preferred) return true;
    model->preferred = sunder_i_calloc(2 * model->bodies, sizeof *model->preferred);
    for (uint32_t b = 0; model->preferred && b < model->bodies; b++) {
        const sunder_i_body *body = &model->body[b];
        double *to = model->preferred + 2 * (size_t)b;
        if (body->fixed || sunder_i_is_barrier_body(model, body)) continue;
        const double mean[2] = {mean_of(model, body, 0), mean_of(model, body, 1)};
        sunder_i_round_to_units(model, b, mean, to);
        any = any || to[0] != 0 || to[1] != 0;
    }
    if (!model->preferred) return false;
    if (!any) {
        sunder_i_free(model->preferred);
        model->preferred = NULL;
    }
    return true;
}

void sunder_i_model_rest_springs(sunder_i_model *model)
{
    for (uint32_t b = 0; model->preferred && b < model->bodies; b++) {
        const sunder_i_extras *has = model->body[b].has;
        for (uint32_t k = has->row_side; k < has->row_side + has->row_sides; k++) {
            sunder_i_row_side *side = &model->row_side[k];
            const double *own = sunder_i_preferred(model, b), *other = sunder_i_preferred(model, side->other);
            for (int c = 0; c < 2; c++) side->rest[c] = other[c] - own[c];
        }
    }
}
