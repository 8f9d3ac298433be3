/* Covers the diagonals between the pieces of those bodies that questions about remaining conflicts may reach. In a
 * large layer few conflicts remain, and a question about one of them reaches no farther than the limits of the bodies
 * of its cluster; so the covers of most bodies are never needed.
 *
 * A question is about the two bodies of a conflict and those bodies of their clusters that have a limit
 * (prove/proofs/participants.c). Each of them moves at most by its limit; a body of the conflict without a limit moves
 * at most by the distance that certainly separates the two (pair_reasons.c). The question looks at bodies within the
 * gap of these moves. Where the relative move of two bodies is examined, it also looks at fixed features and barriers
 * within the gap of the places that either may reach (prove/proofs/plane_obstacles.c). Covers of other bodies are never
 * looked at, so making more of them would change no result. */
#include "displacement/layer/resolution.h"
#include "displacement/report/report.h"

#include "base/extremes.h"
#include "base/union_find.h"
#include "spatial/box.h"

#include <math.h>

/* The number of features and barrier parts found by look-ups, for each feature and barrier part of the layer, after
 * which the covers of all bodies are made instead. */
#define LOOKED_UP 2

typedef struct looking {
    sunder_i_solver *solver;
    double *far;     /* [bodies] how far the body may move in a question, with a small margin; negative if no question
                      * is about it */
    bool *met;       /* [bodies] whether a question may reach the body */
    bool *gathered;  /* [bodies] whether the cluster with this root was already entered in far[] */
    double most;     /* the largest entry of far[] */
    bool any, fixed; /* `any`: some entry of far[] is not negative; `fixed`: the layer has fixed features */
} looking;

static void enter_body(looking *l, uint32_t b, double far)
{
    l->any = true;
    l->far[b] = sunder_i_max(l->far[b], far * (1 + 0x1p-10));
    l->most = sunder_i_max(l->most, l->far[b]);
}

/* Enters body b of a conflict, with `without` as its distance if it has no limit, and the bodies of its cluster that
 * have a limit. A fixed body belongs to no cluster. */
static void enter_cluster(looking *l, uint32_t b, double without)
{
    size_t n = 0;
    const sunder_i_solver *s = l->solver;
    const sunder_i_model *model = &s->model;
    const double limit = sunder_i_limit_of(&model->body[b]);
    enter_body(l, b, isfinite(limit) ? limit : without);
    const uint32_t root = sunder_i_union_find(s->parent, b);
    if (model->body[b].fixed || l->gathered[root]) return;
    l->gathered[root] = true;
    const uint32_t *member = sunder_i_solver_members(s, root, &n);
    for (size_t k = 0; k < n; k++) {
        const double own = sunder_i_limit_of(&model->body[member[k]]);
        if (isfinite(own)) enter_body(l, member[k], own);
    }
}

static void enter_pair(looking *l, uint32_t i, uint32_t j)
{
    const double without = 2 * sunder_i_farthest_near(&l->solver->model, i, j);
    enter_cluster(l, i, without);
    enter_cluster(l, j, without);
}

static void enter_remaining(looking *l)
{
    const sunder_i_solver *s = l->solver;
    const sunder_i_model *model = &s->model;
    for (uint32_t b = 0; b < model->bodies; b++) {
        l->far[b] = -1;
        l->fixed = l->fixed ||
                   (!sunder_i_is_barrier_body(model, &model->body[b]) && !(sunder_i_limit_of(&model->body[b]) > 0));
    }
    for (size_t k = 0; k < s->now.n; k++) {
        const sunder_i_relation *r = &s->now.pair[k];
        const uint32_t i = model->body_of[r->a], j = model->body_of[r->b];
        if (r->near && i != j) enter_pair(l, i, j);
    }
}

/* During the search: enters all conflicts that are connected with one that was given up, since a question is about all
 * of these at once (solve/clusters/reconsider.c), and the clusters of their bodies. Returns false if memory is out. */
static bool enter_given_up(looking *l)
{
    const sunder_i_model *model = &l->solver->model;
    const sunder_i_relations *start = &l->solver->start;
    if (model->given_up_n == 0) return true;
    const uint32_t *root = sunder_i_solver_conflict_roots(l->solver);
    bool *asked = sunder_i_calloc(model->bodies, sizeof *asked);
    for (size_t k = 0; k < model->given_up_n && root && asked; k++) {
        const uint32_t i = model->given_up[k].a, j = model->given_up[k].b;
        asked[root[i]] = asked[root[j]] = true;
        enter_pair(l, i, j);
    }
    for (size_t k = 0; k < start->n && root && asked; k++) {
        const sunder_i_relation *r = &start->pair[k];
        const uint32_t i = model->body_of[r->a], j = model->body_of[r->b];
        if (sunder_i_is_conflict_of_bodies(model, r) && (asked[root[i]] || asked[root[j]])) enter_pair(l, i, j);
    }
    const bool ok = root && asked;
    sunder_i_free(asked);
    return ok;
}

/* Marks in l->met the bodies whose features or barrier parts, at their original positions, have boxes within `reach` of
 * the box of feature f. Unless `all` is set, only bodies that cannot move are marked. *left is reduced by the number of
 * features and parts found. Returns false if memory is out. */
static bool meet_near(looking *l, uint32_t f, double reach, bool all, sunder_i_list *near, size_t *left)
{
    const sunder_i_model *model = &l->solver->model;
    double box[4];
    near->n = 0;
    sunder_i_box_grow(sunder_i_home_box(model, f), reach, box);
    if (!sunder_i_rtree_query(&model->tree, box, near)) return false;
    for (size_t k = 0; k < near->n; k++) {
        const uint32_t b = model->body_of[near->item[k]];
        if (all || !(sunder_i_limit_of(&model->body[b]) > 0)) l->met[b] = true;
    }
    *left = *left > near->n ? *left - near->n : 0;
    return true;
}

static bool meet_body(looking *l, uint32_t b, sunder_i_list *near, size_t *left)
{
    const sunder_i_model *model = &l->solver->model;
    const sunder_i_body *body = &model->body[b];
    bool ok = true;
    for (uint32_t m = 0; m < body->members && ok; m++) {
        const uint32_t f = model->member[body->member + m];
        if (!model->present[f]) continue;
        ok = meet_near(l, f, l->far[b] + model->rules.gap, true, near, left);
        if (ok && l->fixed) ok = meet_near(l, f, l->far[b] + l->most + model->rules.gap, false, near, left);
    }
    return ok;
}

/* Makes the covers of all bodies that questions may reach, in ascending order; or of all bodies of the model, if the
 * look-ups find more than LOOKED_UP times as many features and barrier parts as the layer has. */
static sunder_status find_some(looking *l, sunder_i_model *model, sunder_error *err)
{
    const size_t most = LOOKED_UP * model->things;
    size_t left = most;
    sunder_i_list near = {0};
    bool ok = true;
    for (uint32_t b = 0; b < model->bodies && ok && left; b++)
        if (l->far[b] >= 0) ok = meet_body(l, b, &near, &left);
    near.n = 0;
    for (uint32_t b = 0; b < model->bodies && ok && left; b++)
        if (l->far[b] >= 0 || l->met[b]) ok = sunder_i_list_push(&near, b);
    sunder_status status = ok ? SUNDER_OK : sunder_i_failure_cause(err);
    if (ok && !left) status = sunder_i_model_cover_diagonals(model, err);
    if (ok && left) status = sunder_i_model_cover_diagonals_of(model, near.item, near.n, err);
    sunder_i_free(near.item);
    return status;
}

sunder_status sunder_i_report_cover_diagonals(sunder_i_solver *solver, sunder_error *err)
{
    looking l = {.solver = solver,
                 .far = sunder_i_alloc(solver->model.bodies, sizeof *l.far),
                 .met = sunder_i_calloc(solver->model.bodies, sizeof *l.met),
                 .gathered = sunder_i_calloc(solver->model.bodies, sizeof *l.gathered)};
    sunder_status status = l.far && l.met && l.gathered ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status) enter_remaining(&l);
    if (!status && !enter_given_up(&l)) status = sunder_i_failure_cause(err);
    if (!status && l.any) status = find_some(&l, &solver->model, err);
    sunder_i_free_all(l.far, l.met, l.gathered);
    return status;
}
