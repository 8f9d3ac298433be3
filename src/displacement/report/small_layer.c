/* The small layer around a remaining conflict. It contains the two bodies of the conflict and bodies around them at
 * their original positions, with the properties that they were given; and all features around these at their positions
 * in the result, as fixed ones. The number of bodies that move is bounded (NEED_MOVING). */
#include "displacement/report/small_layer.h"
#include "displacement/layer/reads.h"
#include "displacement/report/tuning.h"

#include "shape/shape.h"

#include "base/extremes.h"

#include <math.h>
#include <stdlib.h>

/* ---- What is in it ----------------------------------------------------------------------------------------------- */

void sunder_i_surroundings_clear(sunder_i_surroundings *surroundings)
{
    for (size_t k = 0; surroundings->standing && k < surroundings->feature.n; k++)
        sunder_shape_free(surroundings->standing[k]);
    sunder_i_free_all(surroundings->standing, surroundings->as, surroundings->feature.item, surroundings->part.item);
}

/* Returns the length by which the conflict violates what is required: by how far its features have to move apart. */
static double missing_of(const sunder_conflict *c) { return c->depth + c->required - c->distance; }

static bool append_members(const sunder_i_model *model, uint32_t body, sunder_i_list *feature)
{
    const sunder_i_body *b = &model->body[body];
    for (uint32_t k = 0; k < b->members; k++)
        if (model->present[model->member[b->member + k]] && !sunder_i_list_push(feature, model->member[b->member + k]))
            return false;
    return true;
}

/* Appends to `body` the bodies that reach into the original box of `feature`, grown by `reach`, at their original or
 * present positions. */
static bool look_about(const sunder_i_solver *s, uint32_t feature, double reach, sunder_i_list *near,
                       sunder_i_list *body)
{
    double box[4];
    sunder_i_box_grow(sunder_i_home_box(&s->model, feature), reach, box);
    near->n = 0;
    if (!sunder_i_look_about(&s->model, &s->placement.tree, box, near) ||
        !sunder_i_look_about(&s->model, &s->model.tree, box, near))
        return false;
    for (size_t k = 0; k < near->n; k++)
        if (!sunder_i_list_push(body, s->model.body_of[near->item[k]])) return false;
    return true;
}

/* Appends the body to `moving`, unless it is there already or is fixed, or unless `moving` has two bodies and would,
 * with this one, have more than NEED_MOVING features. Returns false only if memory is out. */
static bool take_in(const sunder_i_model *model, uint32_t body, sunder_i_list *moving)
{
    size_t features = model->body[body].members;
    for (size_t k = 0; k < moving->n; k++) {
        if (moving->item[k] == body) return true;
        features += model->body[moving->item[k]].members;
    }
    const bool enough = moving->n >= 2 && features > NEED_MOVING;
    return model->body[body].fixed || enough || sunder_i_list_push(moving, body);
}

/* Lists the bodies that move in the question: first those of the conflict that may move, then bodies around them in
 * ascending order. */
static bool choose_moving(const sunder_i_solver *s, const sunder_conflict *c, double reach, sunder_i_list *moving)
{
    const sunder_i_model *model = &s->model;
    sunder_i_list near = {0}, body = {0};
    bool ok = take_in(model, model->body_of[c->a], moving) && take_in(model, model->body_of[c->b], moving);
    for (size_t k = 0, n = moving->n; k < n && ok; k++) {
        const sunder_i_body *b = &model->body[moving->item[k]];
        for (uint32_t m = 0; m < b->members && ok; m++)
            if (model->present[model->member[b->member + m]])
                ok = look_about(s, model->member[b->member + m], reach, &near, &body);
    }
    body.n = sunder_i_set_make(body.item, body.n);
    for (size_t k = 0; k < body.n && ok; k++) ok = take_in(model, body.item[k], moving);
    sunder_i_free_all(near.item, body.item);
    return ok;
}

/* Sets how feature k takes part. Features that move take part as they were given, each with the number of its body as
 * its block; all others take part fixed, at their position in the result. */
static sunder_status take_part(const sunder_i_solver *s, sunder_i_surroundings *a, size_t k, sunder_error *err)
{
    const sunder_i_model *model = &s->model;
    const uint32_t f = a->feature.item[k], b = model->body_of[f];
    const sunder_i_translate at = sunder_i_standing(model, &s->placement, f);
    a->as[k] = sunder_i_feature(model->layer, f);
    a->as[k].block = b;
    if (k < a->moving) {
        a->as[k].max_shift = model->body[b].limit;
        return SUNDER_OK;
    }
    a->as[k].fixed = true;
    a->as[k].shape = at.shape;
    if (at.t[0] == 0 && at.t[1] == 0) return SUNDER_OK;
    bool exact;
    const sunder_status status = sunder_shape_translate(at.shape, at.t[0], at.t[1], &a->standing[k], &exact, err);
    a->as[k].shape = a->standing[k];
    return status;
}

/* Returns the longer of the present moves of the conflict's two features, since a sufficient limit may be slightly
 * longer than it. Returns 0 if one of the two is a barrier: there the required distance already includes the drawn
 * width, and larger surroundings would only take longer. */
static double present_move(const sunder_i_model *model, const sunder_conflict *c)
{
    if (c->b >= model->features) return 0;
    const double *s = model->move + 2 * (size_t)model->body_of[c->a],
                 *t = model->move + 2 * (size_t)model->body_of[c->b];
    return sunder_i_max(hypot(s[0], s[1]), hypot(t[0], t[1]));
}

sunder_status sunder_i_surround(const sunder_i_solver *solver, const sunder_conflict *conflict,
                                sunder_i_surroundings *surroundings, sunder_error *err)
{
    const sunder_i_model *model = &solver->model;
    const double reach = conflict->required + missing_of(conflict);
    sunder_i_list moving = {0}, near = {0};
    bool ok = choose_moving(solver, conflict, reach, &moving);
    sunder_i_box_clear(surroundings->known);
    for (size_t k = 0; k < moving.n && ok; k++) ok = append_members(model, moving.item[k], &surroundings->feature);
    surroundings->moving = surroundings->feature.n;
    for (size_t k = 0; k < surroundings->moving; k++)
        sunder_i_box_join(surroundings->known, sunder_i_home_box(model, surroundings->feature.item[k]));
    surroundings->farthest =
        NEED_GAPS * conflict->required + NEED_MISSING * missing_of(conflict) + present_move(model, conflict);
    sunder_i_box_grow(surroundings->known, surroundings->farthest + reach, surroundings->known);
    ok = ok && sunder_i_look_about(&solver->model, &solver->placement.tree, surroundings->known, &near);
    moving.n = sunder_i_set_make(moving.item, moving.n);
    near.n = sunder_i_set_make(near.item, near.n);
    for (size_t k = 0; k < near.n && ok; k++)
        if (!sunder_i_set_has(moving.item, moving.n, model->body_of[near.item[k]]))
            ok = sunder_i_list_push(
                sunder_i_is_barrier(model, near.item[k]) ? &surroundings->part : &surroundings->feature, near.item[k]);
    sunder_i_free_all(moving.item, near.item);
    surroundings->as = sunder_i_alloc(surroundings->feature.n, sizeof *surroundings->as);
    surroundings->standing = sunder_i_calloc(surroundings->feature.n, sizeof *surroundings->standing);
    sunder_status status = ok && surroundings->as && surroundings->standing ? SUNDER_OK : sunder_i_failure_cause(err);
    for (size_t k = 0; k < surroundings->feature.n && !status; k++) status = take_part(solver, surroundings, k, err);
    return status;
}

/* ---- The layer itself -------------------------------------------------------------------------------------------- */

/* Adds the nearby parts of barriers to the small layer, each as a barrier of its own. Parts of areas get no sides,
 * since some edges of pieces are no edges of the area. */
static sunder_status set_barriers(const sunder_i_solver *s, const sunder_i_surroundings *a, uint32_t gone,
                                  sunder_layer *layer, sunder_error *err)
{
    sunder_barrier *barrier = sunder_i_alloc(a->part.n, sizeof *barrier);
    size_t n = 0;
    if (!barrier) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < a->part.n; k++) {
        const uint32_t part = a->part.item[k];
        if (sunder_i_whole_of(&s->model, part) == gone) continue;
        barrier[n] = s->layer.barrier[sunder_i_barrier_of(&s->model, part)];
        barrier[n].full_gap = 0;
        barrier[n].side = barrier[n].side && sunder_i_thing_shape(&s->model, part)->flat;
        barrier[n++].geometry = (sunder_obstacle){.shape = sunder_i_thing_shape(&s->model, part)};
    }
    const sunder_status status = sunder_layer_set_barriers(layer, barrier, n, err);
    sunder_i_free(barrier);
    return status;
}

/* Gives the features and barriers of the small layer their classes for gaps. */
static sunder_status set_gaps(const sunder_i_model *model, const sunder_i_surroundings *a, uint32_t gone,
                              sunder_layer *layer, sunder_error *err)
{
    const sunder_i_class_gaps *gaps = model->gaps;
    const uint32_t *number = model->layer->number;
    if (!gaps) return SUNDER_OK;
    const size_t n = a->feature.n;
    uint32_t *of = sunder_i_alloc(n + a->part.n, sizeof *of);
    if (!of) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < n; k++) of[k] = gaps->of[number[a->feature.item[k]]];
    for (size_t k = 0, parts = 0; k < a->part.n; k++)
        if (sunder_i_whole_of(model, a->part.item[k]) != gone) of[n + parts++] = gaps->of[number[a->part.item[k]]];
    const sunder_gaps own = {.classes = gaps->n, .gap = gaps->gap, .feature = of, .barrier = of + n};
    const sunder_status status = sunder_layer_set_gaps(layer, &own, err);
    sunder_i_free(of);
    return status;
}

/* Gives the movable features the anchors from which the whole layer determines their sides; the whole layer has more
 * barriers. */
static sunder_status set_side_anchors(const sunder_i_model *model, const sunder_i_surroundings *a, sunder_layer *layer,
                                      sunder_error *err)
{
    if (!model->side_at) return SUNDER_OK;
    double *xy = sunder_i_alloc(2 * a->feature.n, sizeof *xy);
    if (!xy) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < 2 * a->feature.n; k++)
        xy[k] = k < 2 * a->moving ? model->side_at[2 * (size_t)a->feature.item[k / 2] + k % 2] : NAN;
    const sunder_status status = sunder_layer_set_side_anchors(layer, xy, err);
    sunder_i_free(xy);
    return status;
}

/* Gives the movable features the shapes that they have in the whole layer. */
static sunder_status set_levels(const sunder_i_model *model, const sunder_i_surroundings *a, sunder_layer *layer,
                                sunder_error *err)
{
    const sunder_shape **shape = sunder_i_alloc(a->feature.n, sizeof *shape);
    if (!shape) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < a->feature.n; k++)
        shape[k] = k < a->moving ? sunder_i_thing_shape(model, a->feature.item[k]) : a->as[k].shape;
    const sunder_status status = sunder_i_layer_lower(layer, shape, err);
    sunder_i_free((void *)shape);
    return status;
}

sunder_status sunder_i_surroundings_layer(const sunder_i_surroundings *surroundings, const sunder_i_solver *solver,
                                          double limit, uint32_t gone, sunder_layer **layer, sunder_error *err)
{
    const sunder_i_surroundings *a = surroundings;
    const size_t n = a->feature.n;
    sunder_feature *feature = sunder_i_alloc(n, sizeof *feature);
    if (!feature) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < n; k++) {
        sunder_feature *f = &feature[k];
        *f = a->as[k];
        if (k < a->moving) f->max_shift = sunder_i_min(sunder_i_max(f->max_shift, limit), a->farthest);
        f->ignored = f->ignored || a->feature.item[k] == gone;
    }
    sunder_status status = sunder_layer_new(feature, n, layer, err);
    sunder_i_free(feature);
    if (!status) status = set_side_anchors(&solver->model, a, *layer, err);
    if (!status && solver->layer.lowered) status = set_levels(&solver->model, a, *layer, err);
    if (!status) status = set_barriers(solver, a, gone, *layer, err);
    return status ? status : set_gaps(&solver->model, a, gone, *layer, err);
}

/* ---- Its numbers in the whole layer ------------------------------------------------------------------------------ */

uint32_t sunder_i_surroundings_number(const sunder_i_surroundings *surroundings, const sunder_i_model *whole,
                                      const sunder_i_solver *small, uint32_t thing, uint32_t gone)
{
    const sunder_i_surroundings *a = surroundings;
    if (!sunder_i_is_barrier(&small->model, thing)) return a->feature.item[small->layer.number[thing]];
    size_t k = 0;
    for (size_t left = small->layer.number[thing] - a->feature.n;; k++)
        if (sunder_i_whole_of(whole, a->part.item[k]) != gone && left-- == 0) return a->part.item[k];
}

uint32_t *sunder_i_surroundings_names(const sunder_i_surroundings *surroundings, const sunder_i_model *whole,
                                      uint32_t gone)
{
    const sunder_i_surroundings *a = surroundings;
    uint32_t *name = sunder_i_alloc(a->feature.n + a->part.n, sizeof *name);
    if (!name) return NULL;
    for (size_t k = 0; k < a->feature.n; k++) name[k] = a->standing[k] ? SUNDER_I_NOBODY : a->feature.item[k];
    for (size_t k = 0, n = a->feature.n; k < a->part.n; k++)
        if (sunder_i_whole_of(whole, a->part.item[k]) != gone) name[n++] = a->part.item[k];
    return name;
}

int sunder_i_by_things(const void *p, const void *q)
{
    const sunder_conflict *c = p, *d = q;
    return c->a != d->a ? (c->a < d->a ? -1 : 1) : (c->b > d->b) - (c->b < d->b);
}

/* Appends to *list the pairs of feature k with each occurrence of the feature or barrier `other` in the small layer, in
 * the small layer's numbers. Returns false if memory is out. */
static bool append_pairs(const sunder_i_surroundings *a, const sunder_i_model *model, size_t k, uint32_t other,
                         uint32_t gone, sunder_i_id_pair **list, size_t *n, size_t *capacity)
{
    const bool barrier = sunder_i_is_barrier(model, other);
    const sunder_i_list *from = barrier ? &a->part : &a->feature;
    for (size_t i = 0, number = barrier ? a->feature.n : 0; i < from->n; i++) {
        const uint32_t whole = sunder_i_whole_of(model, from->item[i]);
        if (whole == other && whole != gone) {
            if (!sunder_i_reserve(list, capacity, *n + 1, sizeof **list)) return false;
            (*list)[(*n)++] = number < k ? (sunder_i_id_pair){(uint32_t)number, (uint32_t)k}
                                         : (sunder_i_id_pair){(uint32_t)k, (uint32_t)number};
        }
        number += !barrier || whole != gone;
    }
    return true;
}

bool sunder_i_surroundings_listed(const sunder_i_surroundings *surroundings, const sunder_i_model *whole,
                                  const sunder_report *report, const sunder_conflict *conflict, uint32_t gone,
                                  sunder_i_id_pair **list, size_t *n)
{
    const sunder_i_surroundings *a = surroundings;
    size_t capacity = 0;
    for (size_t k = 0; k < a->feature.n; k++) {
        const sunder_conflict first = {.a = a->feature.item[k]};
        size_t at = sunder_i_lower_bound(&first, report->conflict, report->conflicts, sizeof first, sunder_i_by_things);
        for (; at < report->conflicts && report->conflict[at].a == first.a; at++) {
            const sunder_conflict *other = &report->conflict[at];
            if (other == conflict || other->inside_block) continue;
            if (!append_pairs(a, whole, k, (uint32_t)other->b, gone, list, n, &capacity)) return false;
        }
    }
    if (*n) qsort(*list, *n, sizeof **list, sunder_i_by_id_pair);
    return true;
}
