/* A placement: the positions of the features at one moment, and which pairs of them are near. All relations found here
 * are exact; the report is based on them. */
#include "displacement/layer/placement.h"
#include "displacement/layer/barrier_pairs.h"

#include "base/extremes.h"
#include "base/invariant.h"
#include "base/parallel.h"
#include "base/sort.h"
#include "shape/shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Positions --------------------------------------------------------------------------------------------------- */

sunder_status sunder_i_placement_init(const sunder_i_model *model, sunder_i_placement *placement, sunder_error *err)
{
    const size_t n = model->things;
    memset(placement, 0, sizeof *placement);
    placement->move = sunder_i_calloc(2 * n, sizeof *placement->move);
    placement->rounded = sunder_i_calloc(n, sizeof *placement->rounded);
    placement->interior_cover = model->interior_cover ? sunder_i_calloc(n, sizeof *placement->interior_cover) : NULL;
    placement->reshaped = sunder_i_calloc(n, sizeof *placement->reshaped);
    if (!placement->move || !placement->rounded || (model->interior_cover && !placement->interior_cover) ||
        !placement->reshaped)
        return sunder_i_failure_cause(err);
    placement->tree = sunder_i_rtree_lend(&model->tree); /* every feature is at its original position */
    return SUNDER_OK;
}

void sunder_i_placement_free(const sunder_i_model *model, sunder_i_placement *placement)
{
    for (size_t f = 0; placement->rounded && f < model->features; f++) sunder_shape_free(placement->rounded[f]);
    for (size_t f = 0; placement->interior_cover && f < model->features; f++)
        sunder_i_interior_cover_free(&placement->interior_cover[f]);
    sunder_i_free_all(placement->rounded, placement->interior_cover, placement->reshaped, placement->move);
    sunder_i_rtree_free(&placement->tree);
    memset(placement, 0, sizeof *placement);
}

/* Puts feature f at its body's present position. The placement's tree must own its boxes. */
static sunder_status stand_feature(sunder_i_model *model, sunder_i_placement *placement, size_t f, sunder_error *err)
{
    const double *t = model->move + 2 * (size_t)model->body_of[f];
    const sunder_shape *shape = sunder_i_thing_shape(model, f);
    const bool rounded = model->inexact[f];
    double box[4];
    sunder_shape_free(placement->rounded[f]);
    if (placement->interior_cover) sunder_i_interior_cover_free(&placement->interior_cover[f]);
    placement->rounded[f] = NULL;
    for (size_t c = 0; c < 2; c++) placement->move[2 * f + c] = rounded ? 0 : t[c];
    if (rounded) {
        /* The shape that will be written is the rounded translate. */
        bool exact;
        placement->reshaped[f] = true;
        const sunder_status status = sunder_shape_translate(shape, t[0], t[1], &placement->rounded[f], &exact, err);
        if (status) return status;
        sunder_shape_box(placement->rounded[f], box);
        sunder_i_rtree_move(&placement->tree, (uint32_t)f, box);
        if (!model->interior_cover) return SUNDER_OK;
        return sunder_i_interior_cover_make(placement->rounded[f], &placement->interior_cover[f], err);
    }
    const double *home = sunder_i_home_box(model, (uint32_t)f);
    for (int c = 0; c < 4; c++) {
        const double v = home[c] + t[c & 1];
        /* The sums of corners and t are exact, but a repaired shape's box is not made of its corners. */
        box[c] = shape->rational ? nextafter(v, c < 2 ? -INFINITY : INFINITY) : v;
    }
    sunder_i_rtree_move(&placement->tree, (uint32_t)f, box);
    return SUNDER_OK;
}

sunder_status sunder_i_placement_move(sunder_i_model *model, sunder_i_placement *placement,
                                      const sunder_i_changes *changes, sunder_error *err)
{
    sunder_status status = sunder_i_rtree_own(&placement->tree, err);
    for (size_t k = 0; k < changes->list.n && !status; k++) {
        const uint32_t f = changes->list.item[k];
        if (model->present[f]) status = stand_feature(model, placement, f, err);
    }
    if (status) return status;
    if (!sunder_i_rtree_is_worn(&placement->tree)) return SUNDER_OK;
    double *box = sunder_i_rtree_boxes(&placement->tree, model->things);
    if (!box) return sunder_i_failure_cause(err);
    sunder_i_rtree_free(&placement->tree);
    status = sunder_i_rtree_build(box, model->present, model->things, &placement->tree, err);
    sunder_i_free(box);
    return status;
}

sunder_status sunder_i_placement_move_body(sunder_i_model *model, sunder_i_placement *placement, uint32_t body,
                                           sunder_error *err)
{
    const sunder_i_body *b = &model->body[body];
    sunder_status status = sunder_i_rtree_own(&placement->tree, err);
    for (uint32_t m = 0; m < b->members && !status; m++) {
        const uint32_t f = model->member[b->member + m];
        if (model->present[f]) status = stand_feature(model, placement, f, err);
    }
    return status;
}

/* ---- Near pairs -------------------------------------------------------------------------------------------------- */

/* The partners of one feature: n features, from index `first` on, in the list of its run. */
typedef struct partners {
    uint32_t run, first, n;
} partners;

typedef struct pair_search {
    const sunder_i_model *model;
    const sunder_i_placement *placement;
    const bool *changed;   /* the features that changed; NULL: all did */
    const uint32_t *asked; /* features that changed, ascending */
    partners *found;       /* [asked] the partners of each; if both features of a pair changed, the greater is a partner
                            * of the lesser */
    uint32_t **partner;    /* [runs] the list of partners of each run */
    const uint64_t *place; /* [asked] sorted pairs (leaf of the tree, index in asked), so that features of a run are
                            * consecutive */
    const uint32_t *first; /* [runs + 1] index in `place` of the first feature of each run */
    double reach;
} pair_search;

static uint32_t asked_at(const pair_search *s, size_t k) { return s->asked[(uint32_t)s->place[k]]; }

static void box_about(const pair_search *s, uint32_t f, double box[4])
{
    const double *own = sunder_i_rtree_box(&s->placement->tree, f);
    if (s->reach > 0)
        sunder_i_box_grow(own, s->reach, box);
    else
        memcpy(box, own, 4 * sizeof *box);
}

/* Appends to `near` the partners of feature f, sorted. Candidates are the leaves near its run. */
static bool pick_partners(const pair_search *s, uint32_t f, const sunder_i_list *leaves, sunder_i_list *near)
{
    const sunder_i_rtree *tree = &s->placement->tree;
    const size_t first = near->n;
    double box[4];
    box_about(s, f, box);
    if (!sunder_i_reserve(&near->item, &near->capacity, first + leaves->n + 1, sizeof *near->item)) return false;
    for (size_t k = 0; k < leaves->n; k++) {
        const uint32_t g = near->item[near->n] = tree->item[leaves->item[k]];
        near->n += sunder_i_box_meet_any(tree->box + 4 * (size_t)leaves->item[k], box) &
                   (g > f || (s->changed && !s->changed[g]));
    }
    sunder_i_sort_few(near->item + first, near->n - first, sizeof *near->item, sunder_i_by_number);
    return true;
}

/* Task of a thread: finds the partners of the features of the runs `begin` to `end` - 1. The neighbours of a run are
 * looked up once for all its features. */
static sunder_status find_partners(void *context, size_t begin, size_t end, sunder_error *err)
{
    const pair_search *s = context;
    sunder_i_list near = {0}, leaves = {0};
    bool ok = true;
    for (size_t run = begin; run < end && ok; run++) {
        double hull[4], box[4];
        sunder_i_box_clear(hull);
        for (size_t k = s->first[run]; k < s->first[run + 1]; k++) {
            box_about(s, asked_at(s, k), box);
            sunder_i_box_join(hull, box);
        }
        leaves.n = near.n = 0;
        ok = sunder_i_rtree_query_leaves(&s->placement->tree, hull, &leaves);
        for (size_t k = s->first[run]; k < s->first[run + 1] && ok; k++) {
            const size_t first = near.n;
            ok = pick_partners(s, asked_at(s, k), &leaves, &near);
            s->found[(uint32_t)s->place[k]] = (partners){(uint32_t)run, (uint32_t)first, (uint32_t)(near.n - first)};
        }
        sunder_i_list kept = {0};
        ok = ok && sunder_i_list_copy(&kept, &near);
        s->partner[run] = kept.item;
    }
    sunder_i_free_all(near.item, leaves.item);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

/* Sorts the n features asked about by their leaves in the tree, and finds where each run of leaves begins among them;
 * *runs is the number of runs. Returns false if memory is out. */
static bool order_by_runs(const pair_search *s, size_t n, uint64_t *place, uint32_t *first, size_t *runs)
{
    const uint32_t *leaf = s->placement->tree.leaf;
    for (size_t a = 0; a < n; a++) place[a] = (uint64_t)leaf[s->asked[a]] << 32 | a;
    if (!sunder_i_sort_keys(place, n)) return false;
    *runs = 0;
    for (size_t k = 0; k < n; k++)
        if (k == 0 || (place[k] >> 32) / SUNDER_I_RTREE_RUN != (place[k - 1] >> 32) / SUNDER_I_RTREE_RUN)
            first[(*runs)++] = (uint32_t)k;
    first[*runs] = (uint32_t)n;
    return true;
}

static sunder_status relate_pair(const sunder_i_model *model, const sunder_i_placement *placement, sunder_i_relation *r,
                                 sunder_error *err)
{
    const sunder_i_translate a = sunder_i_standing(model, placement, r->a);
    if (sunder_i_is_barrier(model, r->b)) return sunder_i_barrier_relate(model, &a, r->b, r, err);
    const sunder_i_translate b = sunder_i_standing(model, placement, r->b);
    return sunder_i_relate(&model->rules, sunder_i_gap_of(model, r->a, r->b), &a, &b, r, err);
}

typedef struct classification {
    const sunder_i_model *model;
    const sunder_i_placement *placement;
    const bool *changed;
    const sunder_i_relations *before;
    sunder_i_relation *pair;
} classification;

/* Is the relation of the pair r the same as in c->before? It is if both members belong to one body, neither was ever
 * reshaped, and both or neither changed, since members of a body move together. A pair that is not listed in c->before
 * was not near. */
static bool is_as_before(const classification *c, const sunder_i_relation *r)
{
    return c->before && c->model->body_of[r->a] == c->model->body_of[r->b] && !c->placement->reshaped[r->a] &&
           !c->placement->reshaped[r->b] && c->changed[r->a] == c->changed[r->b];
}

static sunder_status relate_pairs(void *context, size_t begin, size_t end, sunder_error *err)
{
    const classification *c = context;
    for (size_t k = begin; k < end; k++) {
        sunder_i_relation *r = &c->pair[k];
        if (is_as_before(c, r)) {
            const sunder_i_relation *old = sunder_i_relations_find(c->before, r->a, r->b);
            if (old) *r = *old;
            continue;
        }
        const sunder_status status = relate_pair(c->model, c->placement, r, err);
        if (status) return status;
    }
    return SUNDER_OK;
}

bool sunder_i_placement_near(const sunder_i_model *model, const sunder_i_placement *placement, uint32_t thing,
                             sunder_i_list *near)
{
    double box[4];
    sunder_i_box_grow(sunder_i_rtree_box(&placement->tree, thing),
                      sunder_i_max(model->rules.gap, model->rules.tolerance), box);
    return sunder_i_rtree_query(&placement->tree, box, near);
}

sunder_status sunder_i_placement_visit(const sunder_i_model *model, const sunder_i_placement *placement, uint32_t body,
                                       sunder_i_list *near, sunder_i_visit_relation visit, void *context,
                                       sunder_error *err)
{
    const sunder_i_body *b = &model->body[body];
    sunder_status status = SUNDER_OK;
    bool on = true;
    for (uint32_t m = 0; m < b->members && on && !status; m++) {
        const uint32_t f = model->member[b->member + m];
        if (!model->present[f]) continue;
        near->n = 0;
        if (!sunder_i_placement_near(model, placement, f, near)) return sunder_i_failure_cause(err);
        if (near->n) qsort(near->item, near->n, sizeof *near->item, sunder_i_by_number);
        for (size_t k = 0; k < near->n && on && !status; k++) {
            const uint32_t g = near->item[k];
            sunder_i_relation r = {.a = f < g ? f : g, .b = f < g ? g : f};
            if (model->body_of[g] == body) continue;
            status = relate_pair(model, placement, &r, err);
            if (!status && (r.near || r.touch || r.kept)) status = visit(context, &r, &on, err);
        }
    }
    return status;
}

/* Makes a relation for each pair of partners, sorted, with the lesser feature first; sets *pairs to their number.
 * Returns NULL if memory is out. */
static sunder_i_relation *collect_pairs(const pair_search *s, size_t asked, size_t *pairs)
{
    size_t total = 0, k = 0;
    for (size_t a = 0; a < asked; a++) total += s->found[a].n;
    uint64_t *key = sunder_i_alloc(total, sizeof *key);
    sunder_i_relation *pair = sunder_i_calloc(total, sizeof *pair);
    for (size_t a = 0; a < asked && key; a++) {
        if (s->found[a].n == 0) continue;
        const uint32_t f = s->asked[a], *partner = s->partner[s->found[a].run] + s->found[a].first;
        for (uint32_t i = 0; i < s->found[a].n; i++)
            key[k++] = f < partner[i] ? (uint64_t)f << 32 | partner[i] : (uint64_t)partner[i] << 32 | f;
    }
    const bool ok = key && pair && (!s->changed || sunder_i_sort_keys(key, total));
    for (k = 0; k < total && ok; k++) {
        pair[k].a = (uint32_t)(key[k] >> 32);
        pair[k].b = (uint32_t)key[k];
    }
    sunder_i_free(key);
    if (!ok) sunder_i_free(pair);
    *pairs = total;
    return ok ? pair : NULL;
}

static uint32_t *list_asked(const sunder_i_model *model, const sunder_i_changes *changes, size_t *n)
{
    const size_t most = changes ? changes->list.n : model->features;
    uint32_t *asked = sunder_i_alloc(most, sizeof *asked);
    *n = 0;
    for (size_t k = 0; k < most && asked; k++) {
        const uint32_t f = changes ? changes->list.item[k] : (uint32_t)k;
        if (f < model->features && model->present[f]) asked[(*n)++] = f;
    }
    return asked;
}

/* Finds every pair of things whose boxes are within reach of each other in the present positions, if at least one of
 * the two changed. */
static sunder_status find_pairs(const sunder_i_model *model, const sunder_i_placement *placement,
                                const sunder_i_changes *changes, sunder_i_relation **pair, size_t *pairs,
                                sunder_error *err)
{
    size_t n, runs = 0;
    uint32_t *asked = list_asked(model, changes, &n), *first = sunder_i_alloc(n + 1, sizeof *first);
    uint64_t *place = sunder_i_alloc(n, sizeof *place);
    partners *found = sunder_i_calloc(n, sizeof *found);
    pair_search search = {.model = model,
                          .placement = placement,
                          .changed = changes ? changes->is : NULL,
                          .asked = asked,
                          .found = found,
                          .place = place,
                          .first = first,
                          .reach = sunder_i_max(model->rules.gap, model->rules.tolerance)};
    bool ok = asked && first && place && found && order_by_runs(&search, n, place, first, &runs);
    if (ok) search.partner = sunder_i_calloc(runs, sizeof *search.partner);
    ok = ok && search.partner;
    sunder_status status = ok ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status)
        status = sunder_i_parallel(model->rules.threads, runs, SUNDER_I_GRAIN_TESTS, find_partners, &search, err);
    sunder_i_free_all(first, place);
    if (!status) {
        *pair = collect_pairs(&search, n, pairs);
        if (!*pair) status = sunder_i_failure_cause(err);
    }
    for (size_t run = 0; run < runs && search.partner; run++) sunder_i_free(search.partner[run]);
    sunder_i_free_all(search.partner, found, asked);
    return status;
}

#ifndef NDEBUG
static const char *check_relations(const sunder_i_relations *relations)
{
    for (size_t k = 0; k < relations->n; k++) {
        const sunder_i_relation *r = &relations->pair[k];
        if (r->a >= r->b || (k && sunder_i_by_id_pair(r - 1, r) >= 0)) return "relations are not sorted";
        if (!r->near && !r->touch && !r->kept) return "a relation of two that have none";
        if ((r->a_in_b || r->duplicate || r->kept) && !r->contained) return "a relation contradicts itself";
    }
    return NULL;
}
#endif

/* Does r come after `other` in the order of sunder_i_by_id_pair()? */
static inline bool comes_behind(const sunder_i_relation *r, const sunder_i_relation *other)
{
    return r->a != other->a ? r->a > other->a : r->b > other->b;
}

/* Keeps those of the n tested pairs that are near, touch or are `kept`, in order, and returns their number. */
static size_t keep_related(sunder_i_relation *pair, size_t n)
{
    size_t out = 0;
    for (size_t k = 0; k < n; k++)
        if (pair[k].near || pair[k].touch || pair[k].kept) pair[out++] = pair[k];
    return out;
}

/* Removes the pairs with a changed feature. */
static void drop_changed(const bool *changed, sunder_i_relations *relations)
{
    sunder_i_relation *pair = relations->pair;
    size_t n = 0;
    while (n < relations->n && !changed[pair[n].a] && !changed[pair[n].b]) n++;
    for (size_t k = n; k < relations->n; k++) {
        pair[n] = pair[k];
        n += !changed[pair[k].a] && !changed[pair[k].b];
    }
    relations->n = n;
}

/* Inserts n sorted pairs that are not in the list, beginning with the last. They are few compared with the list, so no
 * entry before the first insertion is moved. Returns false if memory is out. */
static bool insert_pairs(sunder_i_relations *relations, const sunder_i_relation *pair, size_t n)
{
    if (!sunder_i_reserve(&relations->pair, &relations->room, relations->n + n, sizeof *pair)) return false;
    size_t at = relations->n, to = relations->n += n;
    while (n) {
        if (at && comes_behind(&relations->pair[at - 1], &pair[n - 1]))
            relations->pair[--to] = relations->pair[--at];
        else
            relations->pair[--to] = pair[--n];
    }
    return true;
}

/* Relates the pairs with a changed feature. c->pair gets the *n pairs that are near, touch or are `kept`; the caller
 * frees it, also after a failure. *tested is the number of pairs that were tested. */
static sunder_status relate_changed(classification *c, const sunder_i_changes *changes, size_t *n, size_t *tested,
                                    sunder_error *err)
{
    sunder_status status = find_pairs(c->model, c->placement, changes, &c->pair, tested, err);
    if (!status)
        status = sunder_i_parallel(c->model->rules.threads, *tested, SUNDER_I_GRAIN_TESTS, relate_pairs, c, err);
    *n = status ? 0 : keep_related(c->pair, *tested);
    return status;
}

sunder_status sunder_i_placement_relate(const sunder_i_model *model, const sunder_i_placement *placement,
                                        const sunder_i_changes *changes, sunder_i_relations *relations,
                                        sunder_error *err)
{
    classification c = {model, placement, changes ? changes->is : NULL, NULL, NULL};
    size_t n = 0, tested = 0;
    const sunder_status status = relate_changed(&c, changes, &n, &tested, err);
    if (status) {
        sunder_i_free(c.pair);
        return status;
    }
    /* The list is kept for long, so the memory of pairs that were left out is returned. */
    sunder_i_relation *fits = sunder_i_realloc(c.pair, n, sizeof *fits);
    *relations = (sunder_i_relations){fits ? fits : c.pair, n, fits ? n : tested, tested};
    SUNDER_I_CHECK(check_relations(relations), n);
    return SUNDER_OK;
}

/* Replaces the listed pairs among `things` with a changed feature by the n given ones, provided that both are the same
 * pairs. Returns false otherwise. This is the usual case after rounding, which changes few features, by tiny amounts,
 * at places far apart: all other pairs are left as they are. */
static bool replace_pairs(const sunder_i_changes *changes, const sunder_i_list *things, const sunder_i_relation *pair,
                          size_t n, sunder_i_relations *relations)
{
    size_t listed = 0;
    for (size_t k = 0; k < changes->list.n; k++)
        for (size_t l = 0; l < things->n; l++) {
            const uint32_t f = changes->list.item[k], g = things->item[l];
            if (f == g || (changes->is[g] && g < f)) continue;
            listed += sunder_i_relations_find(relations, f < g ? f : g, f < g ? g : f) != NULL;
        }
    bool all = listed == n;
    for (size_t k = 0; k < n && all; k++) all = sunder_i_relations_find(relations, pair[k].a, pair[k].b);
    for (size_t k = 0; k < n && all; k++)
        relations->pair[sunder_i_relations_find(relations, pair[k].a, pair[k].b) - relations->pair] = pair[k];
    return all;
}

sunder_status sunder_i_placement_relate_again(const sunder_i_model *model, const sunder_i_placement *placement,
                                              const sunder_i_changes *changes, const sunder_i_list *things,
                                              sunder_i_relations *relations, sunder_error *err)
{
    classification c = {model, placement, changes->is, relations, NULL};
    size_t n = 0, tested = 0;
    sunder_status status = relate_changed(&c, changes, &n, &tested, err);
    if (!status && !(things && replace_pairs(changes, things, c.pair, n, relations))) {
        drop_changed(changes->is, relations);
        if (!insert_pairs(relations, c.pair, n)) status = sunder_i_failure_cause(err);
    }
    if (!status) relations->tested = tested;
    sunder_i_free(c.pair);
    SUNDER_I_CHECK(check_relations(relations), relations->n);
    return status;
}
