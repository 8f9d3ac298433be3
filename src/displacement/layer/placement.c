/* A scene: how the features stand at one moment, and which pairs of them are near. What is found here is exact and is
 * what the report stands on. */
#include "displacement/layer/placement.h"

#include "base/parallel.h"
#include "shape/shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Standing ---------------------------------------------------------------------------------------------------- */

sunder_status sunder_i_scene_init(const sunder_i_town *town, sunder_i_scene *scene, sunder_error *err)
{
    const size_t n = town->features;
    memset(scene, 0, sizeof *scene);
    scene->stand = sunder_i_calloc(n, sizeof *scene->stand);
    scene->rounded = sunder_i_calloc(n, sizeof *scene->rounded);
    scene->was_rounded = sunder_i_calloc(n, sizeof *scene->was_rounded);
    scene->box = sunder_i_alloc(4 * n, sizeof *scene->box);
    if (!scene->stand || !scene->rounded || !scene->was_rounded || !scene->box) return sunder_i_no_memory(err);
    memcpy(scene->box, town->box, 4 * n * sizeof *scene->box);
    for (size_t f = 0; f < n; f++) scene->stand[f].shape = town->layer->feature[f].shape;
    return sunder_i_index_build(scene->box, town->present, n, &scene->tree, err);
}

void sunder_i_scene_free(const sunder_i_town *town, sunder_i_scene *scene)
{
    for (size_t f = 0; scene->rounded && f < town->features; f++) sunder_shape_free(scene->rounded[f]);
    sunder_i_free(scene->rounded);
    sunder_i_free(scene->was_rounded);
    sunder_i_free(scene->stand);
    sunder_i_free(scene->box);
    sunder_i_index_free(&scene->tree);
    memset(scene, 0, sizeof *scene);
}

static sunder_status stand_feature(sunder_i_town *town, sunder_i_scene *scene, size_t f, sunder_error *err)
{
    const double *t = town->move + 2 * (size_t)town->body_of[f];
    const sunder_shape *shape = town->layer->feature[f].shape;
    sunder_i_stand *stand = &scene->stand[f];
    sunder_shape_free(scene->rounded[f]);
    scene->rounded[f] = NULL;
    stand->shape = shape;
    stand->t[0] = t[0];
    stand->t[1] = t[1];
    if (town->inexact[f]) {
        /* It stands as it will be written. */
        bool exact;
        scene->was_rounded[f] = true;
        const sunder_status status = sunder_shape_translate(shape, t[0], t[1], &scene->rounded[f], &exact, err);
        if (status) return status;
        stand->shape = scene->rounded[f];
        stand->t[0] = stand->t[1] = 0;
        sunder_shape_box(stand->shape, scene->box + 4 * f);
        return SUNDER_OK;
    }
    for (int c = 0; c < 4; c++) {
        const double v = town->box[4 * f + (size_t)c] + t[c & 1];
        /* Corners plus t are exact, but the box of a repaired shape is not made of corners. */
        scene->box[4 * f + (size_t)c] = shape->rational ? nextafter(v, c < 2 ? -INFINITY : INFINITY) : v;
    }
    return SUNDER_OK;
}

sunder_status sunder_i_scene_move(sunder_i_town *town, sunder_i_scene *scene, const bool *changed, sunder_error *err)
{
    for (size_t f = 0; f < town->features; f++) {
        if (!changed[f] || !town->present[f]) continue;
        const sunder_status status = stand_feature(town, scene, f, err);
        if (status) return status;
        sunder_i_index_move(&scene->tree, (uint32_t)f, scene->box + 4 * f);
    }
    if (!sunder_i_index_is_worn(&scene->tree)) return SUNDER_OK;
    sunder_i_index_free(&scene->tree);
    return sunder_i_index_build(scene->box, town->present, town->features, &scene->tree, err);
}

sunder_status sunder_i_scene_place(sunder_i_town *town, sunder_i_scene *scene, uint32_t body, sunder_error *err)
{
    const sunder_i_body *b = &town->body[body];
    for (uint32_t m = 0; m < b->members; m++) {
        const uint32_t f = town->member[b->member + m];
        if (!town->present[f]) continue;
        const sunder_status status = stand_feature(town, scene, f, err);
        if (status) return status;
        sunder_i_index_move(&scene->tree, f, scene->box + 4 * (size_t)f);
    }
    return SUNDER_OK;
}

/* ---- Near pairs -------------------------------------------------------------------------------------------------- */

typedef struct pair_search {
    const sunder_i_town *town;
    const sunder_i_scene *scene;
    const bool *changed;   /* NULL: all did */
    const uint32_t *asked; /* features that changed */
    sunder_i_list *found;  /* [asked] partners of each; of two that changed the greater is the lesser's partner */
} pair_search;

static sunder_status find_partners(void *context, size_t begin, size_t end, sunder_error *err)
{
    const pair_search *s = context;
    const double reach = fmax(s->town->rules.gap, s->town->rules.tolerance);
    for (size_t a = begin; a < end; a++) {
        const uint32_t f = s->asked[a];
        double box[4];
        if (reach > 0)
            sunder_i_box_grow(s->scene->box + 4 * (size_t)f, reach, box);
        else
            memcpy(box, s->scene->box + 4 * (size_t)f, sizeof box);
        sunder_i_list *list = &s->found[a];
        if (!sunder_i_index_query(&s->scene->tree, box, list)) return sunder_i_no_memory(err);
        size_t kept = 0;
        for (size_t k = 0; k < list->n; k++) {
            const uint32_t g = list->item[k];
            if (g > f || (s->changed && !s->changed[g])) list->item[kept++] = g;
        }
        list->n = kept;
        if (kept) qsort(list->item, kept, sizeof *list->item, sunder_i_by_number);
    }
    return SUNDER_OK;
}

typedef struct classification {
    const sunder_i_town *town;
    const sunder_i_scene *scene;
    const bool *changed;
    const sunder_i_relations *before;
    sunder_i_relation *pair;
} classification;

/* Did nothing happen to the pair since `before`? Then it is what it was; if it is not listed there it was not near.
 * Members of a body move together; unless one is ever rounded nothing changes between them. */
static bool is_as_before(const classification *c, const sunder_i_relation *r)
{
    return c->before && c->town->body_of[r->a] == c->town->body_of[r->b] && !c->scene->was_rounded[r->a] &&
           !c->scene->was_rounded[r->b] && c->changed[r->a] == c->changed[r->b];
}

static sunder_status classify(void *context, size_t begin, size_t end, sunder_error *err)
{
    const classification *c = context;
    for (size_t k = begin; k < end; k++) {
        sunder_i_relation *r = &c->pair[k];
        if (is_as_before(c, r)) {
            const sunder_i_relation *old = sunder_i_relations_find(c->before, r->a, r->b);
            if (old) *r = *old;
            continue;
        }
        const sunder_status status =
            sunder_i_relate(&c->town->rules, &c->scene->stand[r->a], &c->scene->stand[r->b], r, err);
        if (status) return status;
    }
    return SUNDER_OK;
}

sunder_status sunder_i_scene_about(const sunder_i_town *town, const sunder_i_scene *scene, uint32_t body,
                                   sunder_i_list *near, sunder_i_visit_relation visit, void *context, sunder_error *err)
{
    const sunder_i_body *b = &town->body[body];
    const double reach = fmax(town->rules.gap, town->rules.tolerance);
    sunder_status status = SUNDER_OK;
    bool on = true;
    for (uint32_t m = 0; m < b->members && on && !status; m++) {
        const uint32_t f = town->member[b->member + m];
        double box[4];
        if (!town->present[f]) continue;
        sunder_i_box_grow(scene->box + 4 * (size_t)f, reach, box);
        near->n = 0;
        if (!sunder_i_index_query(&scene->tree, box, near)) return sunder_i_no_memory(err);
        if (near->n) qsort(near->item, near->n, sizeof *near->item, sunder_i_by_number);
        for (size_t k = 0; k < near->n && on && !status; k++) {
            const uint32_t g = near->item[k];
            sunder_i_relation r = {.a = f < g ? f : g, .b = f < g ? g : f};
            if (town->body_of[g] == body) continue;
            status = sunder_i_relate(&town->rules, &scene->stand[r.a], &scene->stand[r.b], &r, err);
            if (!status && (r.near || r.touch || r.kept)) status = visit(context, &r, &on, err);
        }
    }
    return status;
}

static int by_features(const void *a, const void *b)
{
    const sunder_i_relation *p = a, *q = b;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    return p->b < q->b ? -1 : p->b > q->b;
}

/* The lists of partners as one array of pairs, in order; the lists are emptied. */
static sunder_i_relation *collect(const pair_search *s, size_t asked, size_t *pairs)
{
    size_t total = 0, k = 0;
    for (size_t a = 0; a < asked; a++) total += s->found[a].n;
    sunder_i_relation *pair = sunder_i_calloc(total, sizeof *pair);
    for (size_t a = 0; a < asked; a++) {
        for (size_t i = 0; pair && i < s->found[a].n; i++, k++) {
            const uint32_t f = s->asked[a], g = s->found[a].item[i];
            pair[k].a = f < g ? f : g;
            pair[k].b = f < g ? g : f;
        }
        sunder_i_free(s->found[a].item);
    }
    if (pair && total && s->changed) qsort(pair, total, sizeof *pair, by_features);
    *pairs = total;
    return pair;
}

/* Every pair of boxes within reach of each other of which one feature changed, as the features stand. */
static sunder_status find_pairs(const sunder_i_town *town, const sunder_i_scene *scene, const bool *changed,
                                sunder_i_relation **pair, size_t *pairs, sunder_error *err)
{
    uint32_t *asked = sunder_i_alloc(town->features, sizeof *asked);
    if (!asked) return sunder_i_no_memory(err);
    size_t n = 0;
    for (uint32_t f = 0; f < town->features; f++)
        if (town->present[f] && (!changed || changed[f])) asked[n++] = f;
    const pair_search search = {town, scene, changed, asked, sunder_i_calloc(n, sizeof *search.found)};
    sunder_status status = search.found ? SUNDER_OK : sunder_i_no_memory(err);
    if (!status) status = sunder_i_parallel(town->rules.threads, n, 256, find_partners, (void *)&search, err);
    if (search.found) {
        *pair = collect(&search, n, pairs);
        if (!status && !*pair) status = sunder_i_no_memory(err);
    }
    sunder_i_free(search.found);
    sunder_i_free(asked);
    return status;
}

/* Of the pairs looked at, those that matter; and those that nothing happened to. Both are sorted. */
static sunder_status merge(const classification *c, size_t pairs, sunder_i_relations *relations, sunder_error *err)
{
    const size_t old = c->before ? c->before->n : 0;
    sunder_i_relation *out = old ? sunder_i_alloc(old + pairs, sizeof *out) : c->pair;
    if (!out) return sunder_i_no_memory(err);
    size_t n = 0, at = 0;
    for (size_t k = 0; k <= pairs; k++) {
        const sunder_i_relation *r = k < pairs ? &c->pair[k] : NULL;
        for (; at < old && (!r || by_features(&c->before->pair[at], r) <= 0); at++) {
            const sunder_i_relation *b = &c->before->pair[at];
            if (!c->changed[b->a] && !c->changed[b->b]) out[n++] = *b;
        }
        if (r && (r->near || r->touch || r->kept)) out[n++] = *r;
    }
    if (out != c->pair) sunder_i_free(c->pair);
    *relations = (sunder_i_relations){out, n, pairs};
    return SUNDER_OK;
}

sunder_status sunder_i_scene_relate(const sunder_i_town *town, const sunder_i_scene *scene, const bool *changed,
                                    const sunder_i_relations *before, sunder_i_relations *relations, sunder_error *err)
{
    classification c = {town, scene, changed, before, NULL};
    size_t pairs = 0;
    sunder_status status = find_pairs(town, scene, changed, &c.pair, &pairs, err);
    if (!status) status = sunder_i_parallel(town->rules.threads, pairs, 32, classify, &c, err);
    if (!status) status = merge(&c, pairs, relations, err);
    if (status) sunder_i_free(c.pair);
    return status;
}
