/* A scene: how the features stand at one moment, and which pairs of them are near. What is found here is exact and is
 * what the report stands on. */
#include "displacement/displacement.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Standing ------------------------------------------------------------------------------------------------- */

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

/* ---- Near pairs --------------------------------------------------------------------------------------------- */

typedef struct pair_search {
    const sunder_i_town *town;
    const sunder_i_scene *scene;
    sunder_i_list *found; /* [features] partners of each, greater than it */
} pair_search;

static sunder_status find_partners(void *context, size_t begin, size_t end, sunder_error *err)
{
    const pair_search *s = context;
    const sunder_i_town *town = s->town;
    const double reach = fmax(town->rules.gap, town->rules.tolerance);
    for (size_t f = begin; f < end; f++) {
        if (!town->present[f]) continue;
        double box[4];
        if (reach > 0)
            sunder_i_box_grow(s->scene->box + 4 * f, reach, box);
        else
            memcpy(box, s->scene->box + 4 * f, sizeof box);
        sunder_i_list *list = &s->found[f];
        if (!sunder_i_index_query(&s->scene->tree, box, list)) return sunder_i_no_memory(err);
        size_t kept = 0;
        for (size_t k = 0; k < list->n; k++)
            if (list->item[k] > f) list->item[kept++] = list->item[k];
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

const sunder_i_relation *sunder_i_relations_find(const sunder_i_relations *relations, uint32_t a, uint32_t b)
{
    size_t low = 0, high = relations->n;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        const sunder_i_relation *r = &relations->pair[middle];
        if (r->a < a || (r->a == a && r->b < b))
            low = middle + 1;
        else
            high = middle;
    }
    return low < relations->n && relations->pair[low].a == a && relations->pair[low].b == b ? &relations->pair[low]
                                                                                            : NULL;
}

/* Did nothing happen to the pair since `before`? Then it is what it was; if it is not listed there it was not near. */
static bool is_as_before(const classification *c, const sunder_i_relation *r)
{
    if (!c->before) return false;
    if (!c->changed[r->a] && !c->changed[r->b]) return true;
    /* Members of a body move together; unless one is ever rounded nothing changes between them. */
    return c->town->body_of[r->a] == c->town->body_of[r->b] && !c->scene->was_rounded[r->a] &&
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

/* The lists of partners as one array of pairs, in order; the lists are freed. */
static sunder_i_relation *collect(sunder_i_list *found, size_t n, size_t *pairs)
{
    size_t total = 0, k = 0;
    for (size_t f = 0; f < n; f++) total += found[f].n;
    sunder_i_relation *pair = sunder_i_alloc(total, sizeof *pair);
    for (size_t f = 0; f < n; f++) {
        if (pair)
            for (size_t i = 0; i < found[f].n; i++, k++) {
                memset(&pair[k], 0, sizeof pair[k]);
                pair[k].a = (uint32_t)f;
                pair[k].b = found[f].item[i];
            }
        sunder_i_free(found[f].item);
    }
    sunder_i_free(found);
    *pairs = total;
    return pair;
}

sunder_status sunder_i_scene_relate(const sunder_i_town *town, const sunder_i_scene *scene, const bool *changed,
                                    const sunder_i_relations *before, sunder_i_relations *relations, sunder_error *err)
{
    const size_t n = town->features;
    pair_search search = {town, scene, sunder_i_calloc(n, sizeof *search.found)};
    if (!search.found) return sunder_i_no_memory(err);
    sunder_status status = sunder_i_parallel(town->rules.threads, n, 256, find_partners, &search, err);
    size_t pairs = 0;
    classification c = {town, scene, changed, before, collect(search.found, n, &pairs)};
    if (!status && !c.pair) status = sunder_i_no_memory(err);
    if (!status) status = sunder_i_parallel(town->rules.threads, pairs, 32, classify, &c, err);
    if (status) {
        sunder_i_free(c.pair);
        return status;
    }
    size_t k = 0;
    for (size_t i = 0; i < pairs; i++)
        if (c.pair[i].near || c.pair[i].touch || c.pair[i].kept) c.pair[k++] = c.pair[i];
    relations->pair = c.pair;
    relations->n = k;
    relations->tested = pairs;
    return SUNDER_OK;
}
