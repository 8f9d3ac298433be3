/* Anchors, and what holds them: a feature whose anchor lies in another, closed, may leave it.
 *
 * An anchor is the nearest doubles to an interior point (sunder_shape_anchor()), whichever those are: for a sliver they
 * may lie beside it. The rule is about the anchor as those doubles say it, so it is exact whatever they are; an anchor
 * never lies outside its feature's box, since rounding keeps order. */
#include "displacement/layer/sides.h"

#include "separation/separation.h"

#include <stdlib.h>

/* The pairs of another body's feature with the anchor in it. */
static sunder_status find_holders(sunder_i_model *model, sunder_error *err)
{
    sunder_i_list near = {0};
    size_t capacity = 0;
    sunder_status status = SUNDER_OK;
    for (uint32_t f = 0; f < model->features && !status; f++) {
        const double *a = model->anchor_at + 2 * (size_t)f, box[4] = {a[0], a[1], a[0], a[1]};
        if (!model->present[f]) continue;
        near.n = 0;
        if (!sunder_i_rtree_query(&model->tree, box, &near)) status = sunder_i_no_memory(err);
        for (size_t k = 0; k < near.n && !status; k++) {
            const uint32_t g = near.item[k];
            bool holds;
            if (sunder_i_is_barrier(model, g) || model->body_of[f] == model->body_of[g]) continue;
            status = sunder_i_holds(model->layer->feature[g].shape, a, &holds, err);
            if (status || !holds) continue;
            if (!sunder_i_reserve(&model->held, &capacity, model->held_n + 1, sizeof *model->held))
                status = sunder_i_no_memory(err);
            else
                model->held[model->held_n++] = (sunder_i_id_pair){f, g};
        }
    }
    sunder_i_free(near.item);
    if (model->held_n) qsort(model->held, model->held_n, sizeof *model->held, sunder_i_by_id_pair);
    return status;
}

sunder_status sunder_i_model_anchor(sunder_i_model *model, sunder_error *err)
{
    const size_t n = model->features;
    const sunder_status status = sunder_i_model_find_sides(model, err);
    if (status || model->rules.jumps) return status;
    model->anchor_at = sunder_i_calloc(2 * n, sizeof *model->anchor_at);
    model->anchor = sunder_i_calloc(model->things, sizeof *model->anchor);
    if (!model->anchor_at || !model->anchor) return sunder_i_no_memory(err);
    if (model->corners + n >= UINT32_MAX)
        return sunder_i_fail(err, SUNDER_ESIZE, "too many corners: %zu", model->corners + n);
    double *corner = sunder_i_realloc(model->corner, 2 * (model->corners + n), sizeof *corner);
    if (!corner) return sunder_i_no_memory(err);
    model->corner = corner;
    for (size_t b = 0; b < model->bodies; b++) {
        sunder_i_body *body = &model->body[b];
        sunder_i_box_clear(body->anchors);
        for (uint32_t m = 0; m < body->members; m++) {
            const uint32_t f = model->member[body->member + m];
            if (sunder_i_is_barrier(model, f)) continue;
            double *at = model->anchor_at + 2 * (size_t)f, *to = corner + 2 * model->corners;
            sunder_i_body_piece *anchor = &model->anchor[f];
            if (!model->present[f]) continue;
            sunder_shape_anchor(model->layer->feature[f].shape, at);
            *anchor = (sunder_i_body_piece){.corner = (uint32_t)model->corners++, .corners = 1, .feature = f};
            for (int c = 0; c < 2; c++) to[c] = anchor->box[c] = anchor->box[c + 2] = at[c] - body->origin[c];
            sunder_i_box_join(body->anchors, anchor->box);
        }
    }
    const sunder_status found = find_holders(model, err);
    return found ? found : sunder_i_model_find_seams(model, err);
}

bool sunder_i_is_held(const sunder_i_model *model, uint32_t f, uint32_t g)
{
    const sunder_i_id_pair pair = {f, g};
    return model->held_n && bsearch(&pair, model->held, model->held_n, sizeof pair, sunder_i_by_id_pair);
}
