/* The rule against jumps, exactly, of features as they moved.
 *
 * A feature's anchor a goes straight from a to a + (t - s), seen from another that moves by s: it may not meet that
 * other where it stood, unless it lay in it to begin with. If it does, then at some moment of both ways, walked evenly,
 * the anchor lies in the other as that stands then; so the boxes of their ways meet. A tree of these boxes gives the
 * pairs; separation/passes.c decides. */
#include "displacement/layer/jumps.h"

#include "base/invariant.h"
#include "base/parallel.h"
#include "separation/separation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void sunder_i_jumps_free(sunder_i_jumps *jumps)
{
    sunder_i_free(jumps->way);
    sunder_i_free(jumps->pair);
    sunder_i_rtree_free(&jumps->tree);
    memset(jumps, 0, sizeof *jumps);
}

/* ---- Ways -------------------------------------------------------------------------------------------------------- */

static const double *move_of(const sunder_i_jumps *jumps, const sunder_i_model *model, uint32_t f)
{
    return jumps->own ? jumps->own + 2 * (size_t)f : model->move + 2 * (size_t)model->body_of[f];
}

/* From home to where the feature stands, rounded outward. */
static void set_way(sunder_i_jumps *jumps, const sunder_i_model *model, uint32_t f)
{
    const double *home = model->box + 4 * (size_t)f, *t = move_of(jumps, model, f);
    double *way = jumps->way + 4 * (size_t)f;
    for (int c = 0; c < 4; c++) {
        const double out = c < 2 ? -INFINITY : INFINITY, there = nextafter(home[c] + t[c & 1], out);
        way[c] = c < 2 ? fmin(home[c], there) : fmax(home[c], there);
    }
}

static sunder_status begin(sunder_i_jumps *jumps, const sunder_i_model *model, sunder_error *err)
{
    const size_t n = model->features;
    jumps->way = sunder_i_alloc(4 * n, sizeof *jumps->way);
    if (!jumps->way) return sunder_i_no_memory(err);
    for (uint32_t f = 0; f < n; f++)
        if (model->present[f]) set_way(jumps, model, f);
    return sunder_i_rtree_build(jumps->way, model->present, n, &jumps->tree, err);
}

static sunder_status follow(sunder_i_jumps *jumps, const sunder_i_model *model, const uint32_t *moved, size_t n,
                            sunder_error *err)
{
    for (size_t k = 0; k < n; k++) {
        set_way(jumps, model, moved[k]);
        sunder_i_rtree_move(&jumps->tree, moved[k], jumps->way + 4 * (size_t)moved[k]);
    }
    if (!sunder_i_rtree_is_worn(&jumps->tree)) return SUNDER_OK;
    sunder_i_rtree_free(&jumps->tree);
    return sunder_i_rtree_build(jumps->way, model->present, model->features, &jumps->tree, err);
}

/* ---- Pairs ------------------------------------------------------------------------------------------------------- */

sunder_status sunder_i_jumps_over(const sunder_i_jumps *jumps, const sunder_i_model *model, uint32_t f, uint32_t g,
                                  bool *over, sunder_error *err)
{
    const double *a = model->anchor_at + 2 * (size_t)f, *t = move_of(jumps, model, f), *s = move_of(jumps, model, g);
    const sunder_i_passage way = {{a[0], a[1]}, {t[0], t[1]}, {s[0], s[1]}};
    return sunder_i_passes(&way, model->layer->feature[g].shape, over, err);
}

static sunder_status ask_both(const sunder_i_jumps *jumps, const sunder_i_model *model, uint32_t f, uint32_t g,
                              bool *any, sunder_error *err)
{
    const double *t = move_of(jumps, model, f), *s = move_of(jumps, model, g);
    *any = false;
    if (model->body_of[f] == model->body_of[g] || (t[0] == s[0] && t[1] == s[1])) return SUNDER_OK;
    const sunder_status status = sunder_i_jumps_over(jumps, model, f, g, any, err);
    return status || *any ? status : sunder_i_jumps_over(jumps, model, g, f, any, err);
}

typedef struct pair_search {
    const sunder_i_jumps *jumps;
    const sunder_i_model *model;
    const bool *changed;
    const uint32_t *asked;
    sunder_i_list *found; /* [asked] partners that broke the rule; of two that are asked the lesser has it */
} pair_search;

static sunder_status find_partners(void *context, size_t begin, size_t end, sunder_error *err)
{
    const pair_search *s = context;
    sunder_status status = SUNDER_OK;
    for (size_t k = begin; k < end && !status; k++) {
        const uint32_t f = s->asked[k];
        sunder_i_list *list = &s->found[k];
        if (!sunder_i_rtree_query(&s->jumps->tree, s->jumps->way + 4 * (size_t)f, list)) return sunder_i_no_memory(err);
        size_t kept = 0;
        for (size_t i = 0; i < list->n && !status; i++) {
            const uint32_t g = list->item[i];
            bool jumps = false;
            if (g > f || (s->changed && !s->changed[g])) status = ask_both(s->jumps, s->model, f, g, &jumps, err);
            if (jumps) list->item[kept++] = g;
        }
        list->n = kept;
    }
    return status;
}

/* The pairs that remain, and those that were found. */
static bool collect(sunder_i_jumps *jumps, const pair_search *s, size_t asked)
{
    size_t n = 0, kept = 0;
    for (size_t k = 0; k < asked; k++) n += s->found[k].n;
    sunder_i_id_pair *pair = sunder_i_alloc(jumps->n + n, sizeof *pair);
    if (!pair) return false;
    for (size_t k = 0; k < jumps->n && s->changed; k++)
        if (!s->changed[jumps->pair[k].a] && !s->changed[jumps->pair[k].b]) pair[kept++] = jumps->pair[k];
    for (size_t k = 0; k < asked; k++)
        for (size_t i = 0; i < s->found[k].n; i++) {
            const uint32_t f = s->asked[k], g = s->found[k].item[i];
            pair[kept++] = f < g ? (sunder_i_id_pair){f, g} : (sunder_i_id_pair){g, f};
        }
    if (kept) qsort(pair, kept, sizeof *pair, sunder_i_by_id_pair);
    sunder_i_free(jumps->pair);
    jumps->pair = pair;
    jumps->n = kept;
    return true;
}

sunder_status sunder_i_jumps_update(sunder_i_jumps *jumps, const sunder_i_model *model, const bool *changed,
                                    sunder_error *err)
{
    if (model->rules.jumps) return SUNDER_OK;
    sunder_status status = jumps->way ? SUNDER_OK : begin(jumps, model, err);
    uint32_t *asked = sunder_i_alloc(model->features, sizeof *asked);
    if (!status && !asked) status = sunder_i_no_memory(err);
    size_t n = 0;
    for (uint32_t f = 0; f < model->features && !status; f++)
        if (model->present[f] && (!changed || changed[f])) asked[n++] = f;
    if (!status) status = follow(jumps, model, asked, n, err);
    sunder_i_list *found = sunder_i_calloc(n, sizeof *found);
    if (!status && !found) status = sunder_i_no_memory(err);
    pair_search s = {jumps, model, changed, asked, found};
    if (!status) status = sunder_i_parallel(model->rules.threads, n, SUNDER_I_GRAIN_TESTS, find_partners, &s, err);
    if (!status && !collect(jumps, &s, n)) status = sunder_i_no_memory(err);
    for (size_t k = 0; k < n && found; k++) sunder_i_free(found[k].item);
    sunder_i_free(found);
    sunder_i_free(asked);
    return status;
}

sunder_status sunder_i_jumps_follow(sunder_i_jumps *jumps, const sunder_i_model *model, uint32_t body,
                                    sunder_error *err)
{
    const sunder_i_body *b = &model->body[body];
    if (model->rules.jumps) return SUNDER_OK;
    sunder_status status = jumps->way ? SUNDER_OK : begin(jumps, model, err);
    for (uint32_t m = 0; m < b->members && !status; m++) {
        const uint32_t f = model->member[b->member + m];
        if (model->present[f]) status = follow(jumps, model, &f, 1, err);
    }
    return status;
}

sunder_status sunder_i_jumps_of_body(const sunder_i_jumps *jumps, const sunder_i_model *model, uint32_t body,
                                     sunder_i_list *near, bool *any, sunder_error *err)
{
    const sunder_i_body *b = &model->body[body];
    sunder_status status = SUNDER_OK;
    *any = false;
    for (uint32_t m = 0; m < b->members && jumps->way && !status && !*any; m++) {
        const uint32_t f = model->member[b->member + m];
        if (!model->present[f]) continue;
        near->n = 0;
        if (!sunder_i_rtree_query(&jumps->tree, jumps->way + 4 * (size_t)f, near)) return sunder_i_no_memory(err);
        for (size_t k = 0; k < near->n && !status && !*any; k++)
            status = ask_both(jumps, model, f, near->item[k], any, err);
    }
    return status;
}
