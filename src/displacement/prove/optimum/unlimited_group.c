/* Large groups without limits, for which prices of area prove more than blocks do.
 *
 * If all pairs have to keep the gap and nothing limits any body, the report computes prices for the whole area that
 * such a group occupies (../../report/area_bounds.c): for thousands of bodies at once, while blocks have six bodies
 * each. So bounds by blocks are mostly useless there, and blocks are used only if a quick trial proves nearly as much
 * as prices for the group alone. For Italy's 10,000 symbols of 2 mm blocks proved 5e-4 of the bound, in a quarter of
 * the time. */
#include "displacement/prove/areas/areas.h"
#include "displacement/prove/optimum/optimum.h"
#include "displacement/prove/optimum/tuning.h"

bool sunder_i_group_is_unlimited(const sunder_i_model *model, const sunder_i_waived *waived,
                                 const sunder_i_group *group)
{
    if (group->n <= BRANCHED || sunder_i_forbids_paths(model) || model->rules.contained == SUNDER_CONTAINMENT_IGNORE ||
        model->preferred)
        return false;
    for (size_t k = 0; k < group->n; k++) {
        const sunder_i_body *b = &model->body[group->body[k]];
        if (!sunder_i_may_move(b) || b->limit < INFINITY || !sunder_i_model_shape(model, group->body[k])) return false;
    }
    return sunder_i_group_listed(model, waived, group) == 0;
}

sunder_status sunder_i_group_ask_prices(const sunder_i_model *model, const sunder_i_group *group, double *bound,
                                        sunder_error *err)
{
    sunder_i_prices prices;
    const sunder_status status = sunder_i_areas_bound(model, group->body, group->n, &prices, bound, err);
    if (!status) sunder_i_free(prices.price);
    return status;
}
