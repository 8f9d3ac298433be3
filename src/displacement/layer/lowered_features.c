/* Features that are left out of a layout, or that have smaller shapes in it. Blocks, limits, anchors, inclusions and
 * rows are those of the whole layer with the shapes as given, so that what has a solution keeps it when more features
 * are left out or become smaller. */
#include "displacement/layer/barrier_pairs.h"
#include "displacement/layer/placement.h"
#include "displacement/layer/relaxation.h"

#include <math.h>

/* Rebuilds the tree over the boxes of the things that are present. */
static sunder_status rebuild_tree(sunder_i_model *model, sunder_error *err)
{
    double *box = sunder_i_rtree_boxes(&model->tree, model->things);
    if (!box) return sunder_i_failure_cause(err);
    sunder_i_rtree_free(&model->tree);
    const sunder_status status = sunder_i_rtree_build(box, model->present, model->things, &model->tree, err);
    sunder_i_free(box);
    return status;
}

static void forget_relations(const sunder_i_model *model, sunder_i_relations *relations)
{
    size_t n = 0;
    for (size_t k = 0; k < relations->n; k++) {
        const sunder_i_relation *r = &relations->pair[k];
        if (model->present[r->a] && model->present[r->b]) relations->pair[n++] = *r;
    }
    relations->n = n;
}

static void forget_inclusions(sunder_i_model *model)
{
    size_t n = 0;
    for (size_t k = 0; k < model->inclusions; k++) {
        const sunder_i_inclusion *i = &model->inclusion[k];
        if (model->present[i->a] && model->present[i->b]) model->inclusion[n++] = *i;
    }
    model->inclusions = n;
}

/* Is the feature present with a shape other than the given one? */
static bool is_lowered(const sunder_i_model *model, size_t f)
{
    return model->present[f] && sunder_i_thing_shape(model, f) != sunder_i_given_shape(model, f);
}

/* Finds the relations of the features that have other shapes than before. */
static sunder_status relate_lowered(const sunder_i_model *model, sunder_i_placement *placement,
                                    sunder_i_relations *relations, sunder_error *err)
{
    sunder_i_changes lowered;
    sunder_status status = sunder_i_changes_init(&lowered, model->things) ? SUNDER_OK : sunder_i_failure_cause(err);
    for (uint32_t f = 0; f < model->features && !status; f++)
        if (is_lowered(model, f)) {
            placement->reshaped[f] = true;
            sunder_i_changes_add(&lowered, f);
        }
    if (!status && (lowered.failed || !sunder_i_changes_sort(&lowered))) status = sunder_i_failure_cause(err);
    if (!status) status = sunder_i_placement_relate_again(model, placement, &lowered, NULL, relations, err);
    sunder_i_changes_free(&lowered);
    return status;
}

static sunder_status cover_lowered(const sunder_i_model *model, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (size_t f = 0; f < model->features && model->interior_cover && !status; f++) {
        if (!is_lowered(model, f)) continue;
        sunder_i_interior_cover_free(&model->interior_cover[f]);
        status = sunder_i_interior_cover_make(sunder_i_thing_shape(model, f), &model->interior_cover[f], err);
    }
    return status;
}

/* A body without visible members does not move. */
static void weigh_bodies(sunder_i_model *model)
{
    for (size_t b = 0; b < model->bodies; b++) {
        sunder_i_body *body = &model->body[b];
        uint32_t visible = 0;
        double weight = 0;
        for (uint32_t m = 0; m < body->members; m++) {
            const uint32_t f = model->member[body->member + m];
            if (!model->present[f]) continue;
            visible++;
            weight += sunder_i_feature(model->layer, f).weight;
        }
        if (visible < body->members && visible) body->weight = weight;
        body->fixed = body->fixed || visible == 0;
    }
}

sunder_status sunder_i_placement_lower(sunder_i_model *model, sunder_i_placement *placement,
                                       sunder_i_relations *relations, const bool *hidden, sunder_error *err)
{
    for (size_t f = 0; f < model->features; f++) model->present[f] = model->present[f] && !(hidden && hidden[f]);
    sunder_i_placement_free(model, placement);
    sunder_status status = rebuild_tree(model, err);
    if (!status) status = cover_lowered(model, err);
    if (!status) status = sunder_i_placement_init(model, placement, err);
    forget_relations(model, relations);
    if (!status && model->layer->lowered) status = relate_lowered(model, placement, relations, err);
    forget_inclusions(model);
    weigh_bodies(model);
    return status;
}

/* Is the hidden feature f, at this place, in conflict with g? */
static sunder_status is_in_conflict(const sunder_i_model *model, const sunder_i_placement *placement, uint32_t f,
                                    const sunder_i_translate *place, uint32_t g, bool *yes, sunder_error *err)
{
    sunder_i_relation r = {.a = f < g ? f : g, .b = f < g ? g : f};
    sunder_status status;
    if (sunder_i_is_barrier(model, g)) {
        status = sunder_i_barrier_relate(model, place, g, &r, err);
    } else {
        const sunder_i_translate other = sunder_i_standing(model, placement, g);
        status = sunder_i_relate(&model->rules, sunder_i_gap_of(model, f, g), f < g ? place : &other,
                                 f < g ? &other : place, &r, err);
    }
    *yes = !status && sunder_i_is_conflict_of_bodies(model, &r) && !sunder_i_is_crossed(model, f, g);
    return status;
}

sunder_status sunder_i_placement_fits(const sunder_i_model *model, const sunder_i_placement *placement, uint32_t f,
                                      const double t[2], bool *fits, sunder_error *err)
{
    sunder_i_translate place = sunder_i_at_home(model, f);
    sunder_i_list near = {0};
    double box[4];
    sunder_shape_box(place.shape, box);
    for (int c = 0; c < 4; c++) box[c] += t[c & 1];
    for (int c = 0; c < 2; c++) place.t[c] = t[c];
    sunder_i_box_grow(box, nextafter(sunder_i_max(model->rules.gap, model->rules.tolerance), INFINITY), box);
    sunder_status status = sunder_i_rtree_query(&placement->tree, box, &near) ? SUNDER_OK : sunder_i_failure_cause(err);
    bool conflict = false;
    for (size_t k = 0; k < near.n && !conflict && !status; k++)
        status = is_in_conflict(model, placement, f, &place, near.item[k], &conflict, err);
    *fits = !status && !conflict;
    sunder_i_free(near.item);
    return status;
}
