/* Tests exactly which features that moved break the rule against jumps, the rule of sides or the rule of rows.
 *
 * A feature's anchor a moves straight from a to a + (t - s) relative to another feature, where t and s are the moves of
 * the two. It must not meet the other feature's original outline, unless the other feature contained it at the start or
 * one of the two may jump.
 * If it does, then at some moment of both moves, made at constant speed, the anchor lies in the other feature, so the
 * boxes of the two paths meet. A tree of these boxes gives candidate pairs, and separation/straight_path.c decides. For
 * the rule of sides the model's tree gives the parts of barriers near the path of a side anchor, and sides.c
 * decides. */
#include "displacement/layer/jumps.h"

#include "base/parallel.h"
#include "displacement/layer/reads.h"
#include "displacement/layer/sides.h"
#include "separation/separation.h"

#include <stdlib.h>
#include <string.h>

void sunder_i_jumps_free(sunder_i_jumps *jumps)
{
    sunder_i_free(jumps->pair);
    sunder_i_path_tree_free(&jumps->paths);
    memset(jumps, 0, sizeof *jumps);
}

/* ---- Paths ------------------------------------------------------------------------------------------------------- */

static const double *move_of(const sunder_i_jumps *jumps, const sunder_i_model *model, uint32_t f)
{
    return sunder_i_move_of(&jumps->paths, model, f);
}

static bool has_moved(const sunder_i_jumps *jumps, const sunder_i_model *model, uint32_t f)
{
    const double *t = move_of(jumps, model, f);
    return t[0] != 0 || t[1] != 0;
}

/* Sets near to the features whose paths come near the path of f. */
static bool find_near(const sunder_i_jumps *jumps, const sunder_i_model *model, uint32_t f, sunder_i_list *near)
{
    double path[4];
    sunder_i_path_box(&jumps->paths, model, f, path);
    return sunder_i_path_tree_look_about(&jumps->paths, model, path, near);
}

/* ---- Pairs ------------------------------------------------------------------------------------------------------- */

sunder_status sunder_i_jumps_over(const sunder_i_jumps *jumps, const sunder_i_model *model, uint32_t f, uint32_t g,
                                  bool *over, sunder_error *err)
{
    if (sunder_i_is_barrier(model, g)) return sunder_i_crosses_side(model, f, move_of(jumps, model, f), g, over, err);
    *over = false;
    if (sunder_i_may_jump(model, f, g)) return SUNDER_OK;
    const double *a = model->anchor_at + 2 * (size_t)f, *t = move_of(jumps, model, f), *s = move_of(jumps, model, g);
    const sunder_i_passage path = {{a[0], a[1]}, {t[0], t[1]}, {s[0], s[1]}};
    return sunder_i_passes(&path, sunder_i_thing_shape(model, g), over, err);
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

/* ---- Sides ------------------------------------------------------------------------------------------------------- */

/* Appends to `near` the parts of barriers that the side anchor of f may have come near on its path. */
static bool find_parts(const sunder_i_jumps *jumps, const sunder_i_model *model, uint32_t f, sunder_i_list *near)
{
    const double *a = model->side_at + 2 * (size_t)f, *t = move_of(jumps, model, f);
    const sunder_i_passage path = {{a[0], a[1]}, {t[0], t[1]}, {0, 0}};
    const size_t before = near->n;
    double box[4];
    if (t[0] == 0 && t[1] == 0) return true;
    sunder_i_passage_box(&path, box);
    if (!sunder_i_look_about(model, &model->tree, box, near)) return false;
    size_t kept = before;
    for (size_t k = before; k < near->n; k++)
        if (model->body[model->body_of[near->item[k]]].has->sides) near->item[kept++] = near->item[k];
    near->n = kept;
    return true;
}

/* Appends to `found` the parts of barriers whose side the side anchor of f crossed. near: scratch. */
static sunder_status find_crossed(const sunder_i_jumps *jumps, const sunder_i_model *model, uint32_t f,
                                  sunder_i_list *near, sunder_i_list *found, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    near->n = 0;
    if (!find_parts(jumps, model, f, near)) status = sunder_i_failure_cause(err);
    for (size_t k = 0; k < near->n && !status; k++) {
        bool crosses;
        status = sunder_i_jumps_over(jumps, model, f, near->item[k], &crosses, err);
        if (!status && crosses && !sunder_i_list_push(found, near->item[k])) status = sunder_i_failure_cause(err);
    }
    return status;
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

/* Returns the present member of the body with the least number; SUNDER_I_NOBODY if there is none. */
static uint32_t first_member(const sunder_i_model *model, uint32_t body)
{
    const sunder_i_body *b = &model->body[body];
    for (uint32_t m = b->member; m < b->member + b->members; m++)
        if (model->present[model->member[m]]) return model->member[m];
    return SUNDER_I_NOBODY;
}

/* Do the body of f and its neighbour break the rule of rows? Not if they have the same move: then they stand as at the
 * start, and if they are in conflict there, that is dealt with as a conflict. So bodies in their original places break
 * no rule. */
static bool leaves_row(const sunder_i_jumps *jumps, const sunder_i_model *model, uint32_t f,
                       const sunder_i_row_side *side)
{
    const bool relaxed = sunder_i_relaxations_between(&model->relaxations, model->body_of[f], side->other);
    const double *t = move_of(jumps, model, f), *s = move_of(jumps, model, first_member(model, side->other));
    if (t[0] == s[0] && t[1] == s[1]) return false;
    return !sunder_i_keeps_row(side, t, s, relaxed ? side->least_listed : side->least);
}

/* Returns the neighbours in rows of the body of f, *n of them; none unless f stands for its body. */
static const sunder_i_row_side *row_of(const sunder_i_model *model, uint32_t f, uint32_t *n)
{
    const sunder_i_body *b = &model->body[model->body_of[f]];
    *n = b->has->row_sides && first_member(model, model->body_of[f]) == f ? b->has->row_sides : 0;
    return *n ? model->row_side + b->has->row_side : NULL;
}

/* ---- Pairs that break a rule ------------------------------------------------------------------------------------- */

typedef struct pair_search {
    const sunder_i_jumps *jumps;
    const sunder_i_model *model;
    const bool *changed;
    const uint32_t *asked;
    sunder_i_list *found; /* [asked] the partners with which each breaks a rule; if both features of a pair are asked
                           * about, only the lesser has the other as partner */
} pair_search;

/* Did the present feature f change? If the changes are unknown (changed is NULL): has it moved? Two features that have
 * not moved break no rule. */
static bool is_asked(const pair_search *s, uint32_t f)
{
    return s->changed ? s->changed[f] : has_moved(s->jumps, s->model, f);
}

/* Sets list to the features with which f breaks the rule against jumps. near: scratch. */
static sunder_status find_jumped(const pair_search *s, uint32_t f, sunder_i_list *near, sunder_i_list *list,
                                 sunder_error *err)
{
    size_t kept = 0;
    sunder_status status = SUNDER_OK;
    near->n = 0;
    sunder_i_reading reading;
    sunder_i_reads_begin(&reading, s->model, s->model->body_of[f]);
    const bool ok = find_near(s->jumps, s->model, f, near);
    sunder_i_reads_end(&reading);
    if (!ok) return sunder_i_failure_cause(err);
    for (size_t i = 0; i < near->n && !status; i++) {
        const uint32_t g = near->item[i];
        bool jumps = false;
        if (g > f || !is_asked(s, g)) status = ask_both(s->jumps, s->model, f, g, &jumps, err);
        if (jumps) near->item[kept++] = g;
    }
    near->n = kept;
    return status || sunder_i_list_copy(list, near) ? status : sunder_i_failure_cause(err);
}

/* Appends to `found` the features that stand for neighbours in rows with which the body of f breaks the rule. */
static bool find_rows_left(const pair_search *s, uint32_t f, sunder_i_list *found)
{
    uint32_t n;
    const sunder_i_row_side *side = row_of(s->model, f, &n);
    for (uint32_t k = 0; k < n; k++) {
        const uint32_t g = first_member(s->model, side[k].other);
        if ((g > f || !is_asked(s, g)) && leaves_row(s->jumps, s->model, f, &side[k]) && !sunder_i_list_push(found, g))
            return false;
    }
    return true;
}

static sunder_status find_partners(void *context, size_t begin, size_t end, sunder_error *err)
{
    const pair_search *s = context;
    sunder_i_list near = {0};
    sunder_status status = SUNDER_OK;
    for (size_t k = begin; k < end && !status; k++) {
        if (!s->model->rules.jumps) status = find_jumped(s, s->asked[k], &near, &s->found[k], err);
        if (!status && s->model->sides)
            status = find_crossed(s->jumps, s->model, s->asked[k], &near, &s->found[k], err);
        if (!status && s->model->row_sides && !find_rows_left(s, s->asked[k], &s->found[k]))
            status = sunder_i_failure_cause(err);
    }
    sunder_i_free(near.item);
    return status;
}

/* Replaces jumps->pair by the old pairs without a changed feature and the pairs that were found. */
static bool collect_pairs(sunder_i_jumps *jumps, const pair_search *s, size_t asked)
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

sunder_status sunder_i_jumps_update(sunder_i_jumps *jumps, const sunder_i_model *model, const sunder_i_changes *changes,
                                    sunder_error *err)
{
    if (!sunder_i_forbids_paths(model) && model->row_sides == 0) return SUNDER_OK;
    sunder_status status = sunder_i_jumps_begun(jumps) || model->rules.jumps
                               ? SUNDER_OK
                               : sunder_i_path_tree_begin(&jumps->paths, model, err);
    const size_t most = changes ? changes->list.n : model->features;
    uint32_t *asked = sunder_i_alloc(most, sizeof *asked);
    if (!status && !asked) status = sunder_i_failure_cause(err);
    size_t n = 0;
    for (size_t k = 0; k < most && !status; k++) {
        const uint32_t f = changes ? changes->list.item[k] : (uint32_t)k;
        if (f < model->features && model->present[f]) asked[n++] = f;
    }
    if (!status && sunder_i_jumps_begun(jumps)) status = sunder_i_path_tree_follow(&jumps->paths, model, asked, n, err);
    pair_search s = {jumps, model, changes ? changes->is : NULL, asked, NULL};
    const size_t present = n;
    n = 0;
    for (size_t k = 0; k < present && !status; k++)
        if (is_asked(&s, asked[k])) asked[n++] = asked[k];
    sunder_i_list *found = s.found = sunder_i_calloc(n, sizeof *found);
    if (!status && !found) status = sunder_i_failure_cause(err);
    if (!status) status = sunder_i_parallel(model->rules.threads, n, SUNDER_I_GRAIN_TESTS, find_partners, &s, err);
    if (!status && !collect_pairs(jumps, &s, n)) status = sunder_i_failure_cause(err);
    for (size_t k = 0; k < n && found; k++) sunder_i_free(found[k].item);
    sunder_i_free_all(found, asked);
    return status;
}

sunder_status sunder_i_jumps_follow(sunder_i_jumps *jumps, const sunder_i_model *model, uint32_t body,
                                    sunder_error *err)
{
    const sunder_i_body *b = &model->body[body];
    if (model->rules.jumps) return SUNDER_OK;
    sunder_status status =
        sunder_i_jumps_begun(jumps) ? SUNDER_OK : sunder_i_path_tree_begin(&jumps->paths, model, err);
    for (uint32_t m = 0; m < b->members && !status; m++) {
        const uint32_t f = model->member[b->member + m];
        if (model->present[f]) status = sunder_i_path_tree_follow(&jumps->paths, model, &f, 1, err);
    }
    return status;
}

sunder_status sunder_i_jumps_of_body(const sunder_i_jumps *jumps, const sunder_i_model *model, uint32_t body,
                                     sunder_i_list *near, bool *any, sunder_error *err)
{
    const sunder_i_body *b = &model->body[body];
    sunder_status status = SUNDER_OK;
    *any = false;
    for (uint32_t m = 0; m < b->members && !status && !*any; m++) {
        const uint32_t f = model->member[b->member + m];
        if (!model->present[f]) continue;
        uint32_t neighbours;
        const sunder_i_row_side *side = row_of(model, f, &neighbours);
        for (uint32_t k = 0; k < neighbours && !*any; k++) *any = leaves_row(jumps, model, f, &side[k]);
        near->n = 0;
        if (sunder_i_jumps_begun(jumps) && !find_near(jumps, model, f, near)) return sunder_i_failure_cause(err);
        for (size_t k = 0; k < near->n && !status && !*any; k++)
            status = ask_both(jumps, model, f, near->item[k], any, err);
        near->n = 0;
        if (!status && model->sides && !find_parts(jumps, model, f, near)) return sunder_i_failure_cause(err);
        for (size_t k = 0; k < near->n && !status && !*any; k++)
            status = sunder_i_jumps_over(jumps, model, f, near->item[k], any, err);
    }
    return status;
}
