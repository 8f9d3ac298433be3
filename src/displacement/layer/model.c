/* The model: the features with their boxes and the tree over these, and the bodies that the rules make of the
 * features. */
#include "displacement/layer/model.h"

#include "base/extremes.h"
#include "base/invariant.h"
#include "base/parallel.h"
#include "base/union_find.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

void sunder_i_model_free(sunder_i_model *model)
{
    sunder_shape_free(model->disc);
    sunder_i_free_all(model->read, model->went);
    sunder_i_pieces_end(model);
    sunder_i_free_all(model->body_of, model->member, model->body);
    sunder_i_arena_free(&model->extras);
    sunder_i_free_all(model->anchor_at, model->may_jump, model->held, model->clear, model->diagonal_cover,
                      model->diagonal_cover_vertices, model->diagonal_cover_corner, model->wall_cover, model->side,
                      model->side_anchor, model->side_at, model->side_anchors);
    for (size_t b = 0; model->whole && b < model->bodies; b++) sunder_shape_free(model->whole[b]);
    sunder_i_free_all(model->whole, model->present, model->row_side);
    for (size_t f = 0; model->interior_cover && f < model->features; f++)
        sunder_i_interior_cover_free(&model->interior_cover[f]);
    sunder_i_free_all(model->interior_cover, model->inclusion, model->nested, model->wall, model->wall_corner,
                      model->crossed);
    sunder_i_relaxations_free(&model->relaxations);
    sunder_i_free_all(model->given_up, model->shut_in, model->confined, model->move, model->preferred, model->lifted,
                      model->inexact);
    sunder_i_rtree_free(&model->tree);
    memset(model, 0, sizeof *model);
}

static sunder_status make_some_interior_covers(void *context, size_t begin, size_t end, sunder_error *err)
{
    const sunder_i_model *model = context;
    sunder_status status = SUNDER_OK;
    for (size_t f = begin; f < end && !status; f++)
        if (model->present[f])
            status = sunder_i_interior_cover_make(sunder_i_thing_shape(model, f), &model->interior_cover[f], err);
    return status;
}

static sunder_status make_interior_covers(sunder_i_model *model, sunder_error *err)
{
    if (!model->barriers->flat) return SUNDER_OK;
    model->interior_cover = sunder_i_calloc(model->features, sizeof *model->interior_cover);
    if (!model->interior_cover) return sunder_i_failure_cause(err);
    return sunder_i_parallel(model->rules.threads, model->features, SUNDER_I_GRAIN_SHAPES, make_some_interior_covers,
                             model, err);
}

typedef struct presence {
    sunder_i_model *model;
    double *box; /* [things][4] */
    atomic_size_t vertices;
} presence;

static sunder_status find_some_present(void *context, size_t begin, size_t end, sunder_error *err)
{
    (void)err;
    presence *p = context;
    size_t vertices = 0;
    for (size_t f = begin; f < end; f++) {
        const sunder_feature feature = sunder_i_feature(p->model->layer, f);
        double *box = p->box + 4 * f;
        if (feature.shape && f < p->model->features) vertices += sunder_shape_vertices(feature.shape);
        p->model->present[f] = sunder_i_is_present(&feature);
        if (!p->model->present[f]) continue;
        sunder_shape_box(feature.shape, box);
        const double beyond = sunder_i_reach_beyond(p->model, (uint32_t)f);
        if (beyond > 0) sunder_i_box_grow(box, beyond, box);
    }
    atomic_fetch_add(&p->vertices, vertices);
    return SUNDER_OK;
}

/* Finds which features are present, and builds the tree over the boxes of all things. */
static sunder_status build_tree(sunder_i_model *model, sunder_error *err)
{
    presence p = {model, sunder_i_alloc(4 * model->things, sizeof *p.box), 0};
    if (!p.box) return sunder_i_failure_cause(err);
    sunder_status status =
        sunder_i_parallel(model->rules.threads, model->things, SUNDER_I_GRAIN_LOOKS, find_some_present, &p, err);
    model->vertices = p.vertices;
    if (!status) status = sunder_i_rtree_build(p.box, model->present, model->things, &model->tree, err);
    sunder_i_free(p.box);
    return status;
}

/* Takes the gaps by classes from the layer. */
static void set_gaps(sunder_i_model *model)
{
    const sunder_i_rules *rules = &model->rules;
    const sunder_i_class_gaps *gaps = model->gaps = model->layer->given->gaps;
    if (!gaps) return;
    model->class_gap = gaps->gap;
    model->class_full = rules->has_full ? gaps->full : gaps->gap;
    for (size_t k = 0; k < gaps->n * gaps->n && !model->class_slack; k++)
        model->class_slack =
            sunder_i_min(rules->full_gap, model->class_full[k]) > sunder_i_min(rules->gap, gaps->gap[k]);
}

sunder_status sunder_i_model_init(const sunder_layer *layer, const sunder_i_barriers *barriers,
                                  const sunder_i_rules *rules, sunder_i_model *model, sunder_error *err)
{
    memset(model, 0, sizeof *model);
    const size_t n = layer->n + barriers->parts;
    model->layer = layer;
    model->barriers = barriers;
    model->rules = *rules;
    set_gaps(model);
    model->features = layer->n;
    model->things = n;
    model->body_of = sunder_i_alloc(n, sizeof *model->body_of);
    model->member = sunder_i_alloc(n, sizeof *model->member);
    model->present = sunder_i_calloc(n, sizeof *model->present);
    model->inexact = sunder_i_calloc(n, sizeof *model->inexact);
    if (!model->body_of || !model->member || !model->present || !model->inexact) return sunder_i_failure_cause(err);
    sunder_status status = build_tree(model, err);
    if (!status) status = sunder_i_thin_disc(rules->tolerance, &model->disc, err);
    model->rules.disc = model->disc;
    return status ? status : make_interior_covers(model, err);
}

/* ---- Bodies ------------------------------------------------------------------------------------------------------ */

typedef struct label {
    int64_t block;
    uint32_t feature;
} label;

static int by_label(const void *a, const void *b)
{
    const label *p = a, *q = b;
    if (p->block != q->block) return p->block < q->block ? -1 : 1;
    return p->feature < q->feature ? -1 : p->feature > q->feature;
}

/* Joins the features to which the caller gave equal block numbers. Returns false if memory is out. */
static bool unite_labelled(const sunder_layer *layer, uint32_t *parent)
{
    label *labels = sunder_i_alloc(layer->n, sizeof *labels);
    if (!labels) return false;
    size_t k = 0;
    for (size_t f = 0; f < layer->n; f++) {
        const sunder_feature feature = sunder_i_feature(layer, f);
        if (feature.block < 0 || feature.ignored) continue;
        labels[k].block = feature.block;
        labels[k++].feature = (uint32_t)f;
    }
    qsort(labels, k, sizeof *labels, by_label);
    for (size_t i = 1; i < k; i++)
        if (labels[i].block == labels[i - 1].block)
            sunder_i_union_join(parent, labels[i - 1].feature, labels[i].feature);
    sunder_i_free(labels);
    return true;
}

/* Numbers the sets of joined things by their least members, and fills in the bodies; there may be far fewer bodies than
 * things. Returns false if memory is out. */
static bool number_bodies(sunder_i_model *model, uint32_t *parent)
{
    uint32_t bodies = 0;
    for (size_t f = 0; f < model->things; f++) {
        const uint32_t root = sunder_i_union_find(parent, (uint32_t)f);
        /* The root of a set is its least member, so it comes first. */
        model->body_of[f] = root == f ? bodies++ : model->body_of[root];
    }
    model->body = sunder_i_calloc(bodies, sizeof *model->body);
    model->move = sunder_i_calloc(2 * (size_t)bodies, sizeof *model->move);
    if (!model->body || !model->move) return false;
    model->bodies = bodies;
    for (size_t f = 0; f < model->things; f++) model->body[model->body_of[f]].members++;
    uint32_t next = 0;
    for (uint32_t b = 0; b < bodies; b++) {
        sunder_i_body *body = &model->body[b];
        body->member = next;
        next += body->members;
        body->members = 0;
        body->limit = INFINITY;
        body->has = &sunder_i_no_extras;
    }
    for (size_t f = 0; f < model->things; f++) {
        const sunder_feature feature = sunder_i_feature(model->layer, f);
        sunder_i_body *body = &model->body[model->body_of[f]];
        model->member[body->member + body->members++] = (uint32_t)f;
        body->weight += feature.weight;
        body->limit = sunder_i_min(body->limit, feature.max_shift);
        body->fixed = body->fixed || feature.fixed || feature.ignored || feature.max_shift == 0;
    }
    return true;
}

#ifndef NDEBUG
/* Checks that each thing is in one body, that bodies are numbered in the order of their first members, and that the
 * members of a body ascend. */
static const char *check_bodies(const sunder_i_model *model)
{
    size_t members = 0;
    for (size_t b = 0; b < model->bodies; b++) {
        const sunder_i_body *body = &model->body[b];
        const uint32_t *member = model->member + body->member;
        if (body->member != members || body->members == 0) return "a body without members of its own";
        if (b && member[0] <= model->member[body[-1].member]) return "bodies are not numbered by their first members";
        for (uint32_t k = 0; k < body->members; k++)
            if (model->body_of[member[k]] != b || (k && member[k - 1] >= member[k])) return "members do not ascend";
        members += body->members;
    }
    return members == model->things ? NULL : "a thing without a body";
}
#endif

/* Allocates, for each body, the boxes that bound what was read for it and where it moved. */
static bool keep_reads(sunder_i_model *model)
{
    model->read = sunder_i_alloc(model->bodies, sizeof *model->read);
    model->went = sunder_i_calloc(4 * model->bodies, sizeof *model->went);
    for (size_t b = 0; b < model->bodies && model->read; b++) {
        sunder_i_box_clear(model->read[b].place);
        sunder_i_box_clear(model->read[b].seen);
    }
    return model->read && model->went;
}

/* May the thing join a block by touch or containment? */
static bool may_join(const sunder_i_model *model, uint32_t thing)
{
    return sunder_i_is_barrier(model, thing) || !sunder_i_demands_on(model, thing)->joins_none;
}

sunder_status sunder_i_model_join(sunder_i_model *model, const sunder_i_relations *relations, sunder_error *err)
{
    const size_t n = model->things;
    uint32_t *parent = sunder_i_alloc(n, sizeof *parent);
    if (!parent) return sunder_i_failure_cause(err);
    sunder_i_union_init(parent, n);
    for (size_t k = 0; k < relations->n; k++) {
        const sunder_i_relation *r = &relations->pair[k];
        if (((r->touch && model->rules.touch_joins) || (r->contained && model->rules.containment_joins)) &&
            may_join(model, r->a) && may_join(model, r->b))
            sunder_i_union_join(parent, r->a, r->b);
    }
    sunder_status status = unite_labelled(model->layer, parent) ? sunder_i_inclusions_init(model, relations, err)
                                                                : sunder_i_failure_cause(err);
    if (!status && !number_bodies(model, parent)) status = sunder_i_failure_cause(err);
    if (!status && model->rules.keep_worlds && !keep_reads(model)) status = sunder_i_failure_cause(err);
    SUNDER_I_CHECK(status ? NULL : check_bodies(model), model->things);
    sunder_i_free(parent);
    return status;
}
