/* Data that only few bodies of a layer have. It is stored apart from the bodies, since a layer may have a million
 * bodies. */
#include "displacement/layer/model.h"

/* For at most this many members the box of their anchors is computed at each call instead of being stored. */
#define FEW_ANCHORS 4

const sunder_i_extras sunder_i_no_extras;

sunder_i_extras *sunder_i_own_extras(sunder_i_model *model, sunder_i_body *body)
{
    if (body->has == &sunder_i_no_extras) {
        sunder_i_extras *own = sunder_i_arena_alloc(&model->extras, 1, sizeof *own);
        if (!own) return NULL;
        *own = (sunder_i_extras){0};
        body->has = own;
    }
    return (sunder_i_extras *)body->has;
}

static void box_of_anchors(const sunder_i_model *model, const sunder_i_body *body, double box[4])
{
    sunder_i_box_clear(box);
    for (uint32_t m = 0; m < body->members; m++) {
        const uint32_t f = model->member[body->member + m];
        if (sunder_i_is_barrier(model, f) || !model->present[f]) continue;
        const double *at = model->anchor_at + 2 * (size_t)f;
        sunder_i_box_include(box, (double[]){at[0] - body->origin[0], at[1] - body->origin[1]});
    }
}

void sunder_i_anchors(const sunder_i_model *model, const sunder_i_body *body, double box[4])
{
    if (body->members <= FEW_ANCHORS)
        box_of_anchors(model, body, box);
    else
        memcpy(box, body->has->anchors, sizeof body->has->anchors);
}

bool sunder_i_keep_anchors(sunder_i_model *model, sunder_i_body *body)
{
    if (body->members <= FEW_ANCHORS) return true;
    sunder_i_extras *extras = sunder_i_own_extras(model, body);
    if (extras) box_of_anchors(model, body, extras->anchors);
    return extras != NULL;
}
