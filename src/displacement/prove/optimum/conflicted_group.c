/* Groups with many remaining conflicts.
 *
 * A pair in conflict must be no nearer than at the start, and if the search found no room for it, it is usually exactly
 * as near as then. So in a layout with many such pairs there are distances without room for rounding: a cheaper layout
 * found by a random perturbation makes some of these distances slightly too short, and is rejected as a whole. Nor does
 * a tree of the group prove more than its pairs do by themselves. */
#include "displacement/prove/optimum/optimum.h"
#include "displacement/prove/optimum/tuning.h"

/* Is the body a member of the group that may move? */
static bool has_mover(const sunder_i_model *model, const sunder_i_group *g, uint32_t body)
{
    return !model->body[body].fixed && sunder_i_set_has(g->body, g->n, body);
}

/* Returns the number of listed pairs whose first thing is `feature` and whose second belongs to another movable body of
 * the group. */
static size_t count_listed(const sunder_i_model *model, const sunder_i_waived *waived, const sunder_i_group *g,
                           uint32_t feature)
{
    const sunder_i_waiver first = {.a = feature};
    size_t listed = 0;
    for (size_t k = sunder_i_lower_bound(&first, waived->pair, waived->n, sizeof first, sunder_i_by_id_pair);
         k < waived->n && waived->pair[k].a == feature; k++) {
        const uint32_t other = model->body_of[waived->pair[k].b];
        listed += other != model->body_of[feature] && has_mover(model, g, other);
    }
    return listed;
}

size_t sunder_i_group_listed(const sunder_i_model *model, const sunder_i_waived *waived, const sunder_i_group *group)
{
    size_t listed = 0;
    for (size_t k = 0; k < group->n; k++) {
        const sunder_i_body *b = &model->body[group->body[k]];
        for (uint32_t m = 0; m < b->members && !b->fixed; m++)
            listed += count_listed(model, waived, group, model->member[b->member + m]);
    }
    return listed;
}

bool sunder_i_group_has_many_conflicts(const sunder_i_model *model, const sunder_i_waived *waived,
                                       const sunder_i_group *group)
{
    size_t movers = 0;
    for (size_t k = 0; k < group->n; k++) movers += !model->body[group->body[k]].fixed;
    return movers > BRANCHED && sunder_i_group_listed(model, waived, group) * CROWDED >= movers;
}
