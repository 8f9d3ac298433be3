/* Barriers about a body without a limit, and the length that a proof about it takes for one.
 *
 * Beyond the length at which the body is apart from some barriers for certain, nothing but shadows of theirs forbids a
 * move, and these have no end: a direction that leads into a shadow stays in it. So if these barriers leave no move of
 * that length or shorter, they leave none at all. A proof needs a few barriers near the body, as a rule; the length
 * grows with the farthest of them. */
#include "displacement/layer/model.h"
#include "displacement/layer/reads.h"

#include "base/extremes.h"

bool sunder_i_barriers_about(const sunder_i_model *model, uint32_t body, double reach, sunder_i_list *whole,
                             double *far)
{
    const sunder_i_body *b = &model->body[body];
    double box[4];
    size_t out = 0;
    for (uint32_t x = 0; x < 4; x++) box[x] = b->box[x] + b->origin[x & 1];
    sunder_i_box_grow(box, reach, box);
    whole->n = 0;
    if (!sunder_i_look_about(model, &model->tree, box, whole)) return false;
    for (size_t k = 0; k < whole->n; k++)
        if (sunder_i_is_barrier(model, whole->item[k])) whole->item[out++] = sunder_i_whole_of(model, whole->item[k]);
    whole->n = sunder_i_set_make(whole->item, out);
    *far = 0;
    for (size_t k = 0; k < whole->n; k++)
        *far = sunder_i_max(*far, sunder_i_far_from_barrier(model, body, whole->item[k]));
    return true;
}
