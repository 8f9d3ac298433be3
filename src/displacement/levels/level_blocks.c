/* The blocks of a layer, and what a level has to meet. */
#include "displacement/levels/levels.h"

#include "morphology/morphology.h"
#include "separation/separation.h"

#include <math.h>

/* Sets *out to polygon p of a shape whose corners are doubles. */
static sunder_status polygon_of(const sunder_shape *shape, uint32_t p, sunder_shape **out, sunder_error *err)
{
    const sunder_i_cleaned *c = &shape->form->cleaned;
    const uint32_t ring = p ? c->poly_end[p - 1] : 0, vertex = ring ? c->ring_end[ring - 1] : 0;
    const size_t rings = c->poly_end[p] - ring;
    size_t *end = sunder_i_alloc(rings, sizeof *end);
    if (!end) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < rings; k++) end[k] = c->ring_end[ring + k] - vertex;
    const sunder_status status =
        sunder_shape_from_rings(shape->xy + 2 * (size_t)vertex, end, &rings, 1, SUNDER_VALIDITY_STRICT, out, err);
    sunder_i_free(end);
    return status;
}

sunder_status sunder_i_disc_fits_polygons(const sunder_shape *shape, const sunder_shape *disc, bool *fits,
                                          sunder_error *err)
{
    const uint32_t polygons = shape->form->cleaned.polygons;
    sunder_status status = SUNDER_OK;
    *fits = true;
    if (polygons < 2 || shape->rational) return sunder_i_fits_in_both(shape, NULL, shape, NULL, disc, fits, err);
    for (uint32_t p = 0; p < polygons && *fits && !status; p++) {
        sunder_shape *one = NULL;
        status = polygon_of(shape, p, &one, err);
        if (!status) status = sunder_i_fits_in_both(one, NULL, one, NULL, disc, fits, err);
        sunder_shape_free(one);
    }
    return status;
}

sunder_status sunder_i_level_may_follow(const sunder_shape *before, const sunder_shape *shape, const sunder_shape *disc,
                                        bool *may, sunder_error *err)
{
    *may = sunder_shape_area(shape) < sunder_shape_area(before);
    sunder_status status = SUNDER_OK;
    if (*may) status = sunder_i_contained(shape, NULL, before, NULL, may, err);
    if (!status && *may && disc) status = sunder_i_disc_fits_polygons(shape, disc, may, err);
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

void sunder_i_blocks_number(const sunder_i_blocks *blocks, size_t n, int64_t *block)
{
    const sunder_i_model *model = &blocks->model;
    for (size_t f = 0; f < n; f++) block[f] = -1;
    for (size_t b = 0; b < model->bodies; b++) {
        const sunder_i_body *body = &model->body[b];
        if (sunder_i_is_barrier_body(model, body) || body->members < 2) continue;
        for (uint32_t m = 0; m < body->members; m++)
            block[model->member[body->member + m]] = model->member[body->member];
    }
}

sunder_status sunder_layer_blocks(const sunder_layer *layer, const sunder_layer_options *options, int64_t *block,
                                  sunder_error *err)
{
    sunder_i_blocks blocks;
    const sunder_status status = sunder_i_blocks_find(layer, options, &blocks, err);
    if (!status) sunder_i_blocks_number(&blocks, layer->n, block);
    sunder_i_blocks_free(&blocks);
    return status;
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
    if (!status) status = sunder_i_barriers_make(layer, &rules, &out->barriers, err);
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
