/* The town: features with their boxes, the near pairs, and the bodies that the rules make of them. */
#include "displacement/layer/inclusion.h"

#include "base/union_find.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void sunder_i_town_free(sunder_i_town *town)
{
    sunder_i_free(town->body_of);
    sunder_i_free(town->member);
    sunder_i_free(town->body);
    sunder_i_free(town->piece);
    sunder_i_free(town->outline);
    sunder_i_free(town->corner);
    for (size_t b = 0; town->whole && b < town->bodies; b++) sunder_shape_free(town->whole[b]);
    sunder_i_free(town->whole);
    sunder_i_free(town->box);
    sunder_i_free(town->present);
    sunder_i_free(town->kept);
    sunder_i_free(town->a_in_b);
    sunder_i_free(town->enters);
    sunder_i_free(town->keeping);
    sunder_i_free(town->lying);
    sunder_i_free(town->lying_a);
    sunder_i_free(town->wall);
    sunder_i_truces_free(&town->truces);
    sunder_i_free(town->given);
    sunder_i_free(town->move);
    sunder_i_free(town->inexact);
    sunder_i_index_free(&town->tree);
    memset(town, 0, sizeof *town);
}

sunder_status sunder_i_town_init(const sunder_layer *layer, const sunder_i_rules *rules, sunder_i_town *town,
                                 sunder_error *err)
{
    memset(town, 0, sizeof *town);
    const size_t n = layer->n;
    town->layer = layer;
    town->rules = *rules;
    town->features = n;
    town->body_of = sunder_i_alloc(n, sizeof *town->body_of);
    town->member = sunder_i_alloc(n, sizeof *town->member);
    town->body = sunder_i_calloc(n, sizeof *town->body);
    town->box = sunder_i_calloc(4 * n, sizeof *town->box);
    town->present = sunder_i_calloc(n, sizeof *town->present);
    town->move = sunder_i_calloc(2 * n, sizeof *town->move);
    town->inexact = sunder_i_calloc(n, sizeof *town->inexact);
    if (!town->body_of || !town->member || !town->body || !town->box || !town->present || !town->move || !town->inexact)
        return sunder_i_no_memory(err);
    for (size_t f = 0; f < n; f++) {
        town->present[f] = sunder_i_is_present(&layer->feature[f]);
        if (town->present[f]) sunder_shape_box(layer->feature[f].shape, town->box + 4 * f);
    }
    return sunder_i_index_build(town->box, town->present, n, &town->tree, err);
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

/* Equal block numbers of the caller's. */
static bool unite_labelled(const sunder_layer *layer, uint32_t *parent)
{
    label *labels = sunder_i_alloc(layer->n, sizeof *labels);
    if (!labels) return false;
    size_t k = 0;
    for (size_t f = 0; f < layer->n; f++)
        if (layer->feature[f].block >= 0 && !layer->feature[f].ignored) {
            labels[k].block = layer->feature[f].block;
            labels[k++].feature = (uint32_t)f;
        }
    qsort(labels, k, sizeof *labels, by_label);
    for (size_t i = 1; i < k; i++)
        if (labels[i].block == labels[i - 1].block)
            sunder_i_union_join(parent, labels[i - 1].feature, labels[i].feature);
    sunder_i_free(labels);
    return true;
}

/* Numbers the sets by their least members and fills the bodies. */
static void number_bodies(sunder_i_town *town, uint32_t *parent)
{
    uint32_t bodies = 0;
    for (size_t f = 0; f < town->features; f++) {
        const uint32_t root = sunder_i_union_find(parent, (uint32_t)f);
        /* The least member is its own root, and comes first. */
        town->body_of[f] = root == f ? bodies++ : town->body_of[root];
        town->body[town->body_of[f]].members++;
    }
    town->bodies = bodies;
    uint32_t next = 0;
    for (uint32_t b = 0; b < bodies; b++) {
        sunder_i_body *body = &town->body[b];
        body->member = next;
        next += body->members;
        body->members = 0;
        body->limit = INFINITY;
    }
    for (size_t f = 0; f < town->features; f++) {
        const sunder_feature *feature = &town->layer->feature[f];
        sunder_i_body *body = &town->body[town->body_of[f]];
        town->member[body->member + body->members++] = (uint32_t)f;
        body->weight += feature->weight;
        body->limit = fmin(body->limit, feature->max_shift);
        body->fixed = body->fixed || feature->fixed || feature->ignored || feature->max_shift == 0;
    }
}

sunder_status sunder_i_town_join(sunder_i_town *town, const sunder_i_relations *relations, sunder_error *err)
{
    const size_t n = town->features;
    uint32_t *parent = sunder_i_alloc(n, sizeof *parent);
    if (!parent) return sunder_i_no_memory(err);
    sunder_i_union_init(parent, n);
    for (size_t k = 0; k < relations->n && town->rules.joins; k++) {
        const sunder_i_relation *r = &relations->pair[k];
        if (r->touch || (r->contained && town->rules.contained == SUNDER_CONTAINMENT_BLOCK))
            sunder_i_union_join(parent, r->a, r->b);
    }
    const sunder_status status =
        unite_labelled(town->layer, parent) ? sunder_i_keep_init(town, relations, err) : sunder_i_no_memory(err);
    if (!status) number_bodies(town, parent);
    sunder_i_free(parent);
    return status;
}
