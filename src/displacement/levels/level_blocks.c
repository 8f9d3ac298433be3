/* The blocks of a layer, and what a level has to meet. */
#include "displacement/levels/levels.h"

#include "morphology/morphology.h"
#include "separation/separation.h"

#include <math.h>

sunder_status sunder_i_level_may_follow(const sunder_shape *before, const sunder_shape *shape, const sunder_shape *disc,
                                        bool *may, sunder_error *err)
{
    *may = sunder_shape_area(shape) < sunder_shape_area(before);
    sunder_status status = SUNDER_OK;
    if (*may) status = sunder_i_contained(shape, NULL, before, NULL, may, err);
    if (!status && *may && disc) status = sunder_i_fits_in_both(shape, NULL, shape, NULL, disc, may, err);
    return status;
}

void sunder_i_main_direction(const sunder_shape *shape, double u[2])
{
    double longest = -1;
    for (uint32_t v = 0; v < shape->vertices; v++) {
        const double *a = shape->xy + 2 * (size_t)v, *b = shape->xy + 2 * (size_t)shape->form->cleaned.next[v];
        const double length = hypot(b[0] - a[0], b[1] - a[1]);
        if (length <= longest) continue;
        longest = length;
        for (int c = 0; c < 2; c++) u[c] = (b[c] - a[c]) / length;
    }
}

sunder_status sunder_i_shape_with_corners(const sunder_shape *shape, const double *xy, sunder_shape **out,
                                          sunder_error *err)
{
    const sunder_i_cleaned *c = &shape->form->cleaned;
    size_t *end = sunder_i_alloc((size_t)c->rings + c->polygons, sizeof *end);
    sunder_error invalid;
    *out = NULL;
    if (!end) return sunder_i_failure_cause(err);
    for (uint32_t k = 0; k < c->rings; k++) end[k] = c->ring_end[k];
    for (uint32_t k = 0; k < c->polygons; k++) end[c->rings + k] = c->poly_end[k];
    sunder_status status =
        sunder_shape_from_rings(xy, end, end + c->rings, c->polygons, SUNDER_VALIDITY_STRICT, out, &invalid);
    sunder_i_free(end);
    if (status == SUNDER_EINVALID) return SUNDER_OK;
    return status ? sunder_i_failure_cause(err) : SUNDER_OK;
}

bool sunder_i_level_has_shape(const sunder_layer *layer, size_t f)
{
    const sunder_shape *shape = layer->shape[f];
    return shape && !sunder_shape_is_empty(shape) && !shape->rational && !sunder_i_demands(layer, f)->ignored;
}

void sunder_i_levels_drop(sunder_shape **shape, size_t n)
{
    for (size_t k = 0; k < n; k++) {
        sunder_shape_free(shape[k]);
        shape[k] = NULL;
    }
}

sunder_status sunder_i_blocks_find(const sunder_layer *layer, const sunder_layer_options *options, sunder_i_blocks *out,
                                   sunder_error *err)
{
    sunder_i_rules rules;
    *out = (sunder_i_blocks){0};
    sunder_status status = sunder_i_rules_of(options, &rules, err);
    if (!status) status = sunder_i_barriers_make(layer, rules.gap, rules.full_gap, &out->barriers, err);
    if (!status) status = sunder_i_order_layer(layer, &out->barriers, true, &out->layer, err);
    if (!status) status = sunder_i_model_init(&out->layer, &out->barriers, &rules, &out->model, err);
    if (!status) status = sunder_i_placement_init(&out->model, &out->placement, err);
    if (!status) status = sunder_i_placement_relate(&out->model, &out->placement, NULL, &out->relations, err);
    return status ? status : sunder_i_model_join(&out->model, &out->relations, err);
}

void sunder_i_blocks_free(sunder_i_blocks *blocks)
{
    sunder_i_placement_free(&blocks->model, &blocks->placement);
    sunder_i_model_free(&blocks->model);
    sunder_i_barriers_free(&blocks->barriers);
    sunder_i_ordered_clear(&blocks->layer);
    sunder_i_free(blocks->relations.pair);
}
