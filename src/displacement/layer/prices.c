/* The price of the distance s that a pair left in conflict, or a tight one, still lacks: w (4 R s + ease s^2).
 *
 * w is the lesser weight of the two bodies, or the weight of the only body that may move. R is the lesser of their
 * limits; if neither has a limit above 0, R is the full distance of the two. A move of length r costs w r^2,
 * so its last metre costs at most w 2 R. So a body that reaches its place within the limit goes there, even if it has
 * to push another as far. */
#include "displacement/layer/prices.h"

#include "base/extremes.h"

static double limit_above_0(const sunder_i_body *body)
{
    const double limit = sunder_i_limit_of(body);
    return limit > 0 ? limit : INFINITY;
}

/* The full distance of the two bodies; with gaps by classes the least one of two of their members. */
static double full_distance(const sunder_i_model *model, const sunder_i_body *p, const sunder_i_body *q)
{
    double least = INFINITY;
    for (uint32_t k = p->member; k < p->member + p->members; k++)
        for (uint32_t l = q->member; l < q->member + q->members; l++) {
            least = sunder_i_min(least, sunder_i_full_above(model, model->member[k], model->member[l]));
            if (!model->gaps) return least;
        }
    return least;
}

sunder_i_price sunder_i_price_of(const sunder_i_model *model, const sunder_i_body *p, const sunder_i_body *q)
{
    const double limit = sunder_i_min(limit_above_0(p), limit_above_0(q));
    const double weight = p->fixed ? q->weight : q->fixed ? p->weight : sunder_i_min(p->weight, q->weight);
    const double far = limit < INFINITY ? limit : full_distance(model, p, q);
    return (sunder_i_price){weight * 4 * far, weight * model->rules.ease};
}
