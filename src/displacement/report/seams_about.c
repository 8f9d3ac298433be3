/* The seams that questions about what is left in conflict may come to. Few conflicts are left of a large layer, and a
 * question about one comes no farther than limits reach from the bodies of its cluster: so most of the layer needs
 * none.
 *
 * A question is about the two bodies of a conflict, and whoever of their clusters joins them (proofs/participants.c).
 * None of these goes farther than `far`, the longest limit of all; of who has none, and is asked about within what
 * takes two apart for certain, that. Looked at is what stands within two such ways and the gap of their homes. Seams of
 * others are never looked at: nothing changes if there are more of them. */
#include "displacement/report/report.h"

#include "base/union_find.h"
#include "spatial/box.h"

#include <math.h>
#include <string.h>

/* What is looked up, in features for each that there is, before all have their seams made. */
#define LOOKED_UP 2

typedef struct looking {
    const sunder_i_solver *solver;
    bool *asked, *met; /* [bodies] */
    size_t any;        /* how many are asked about */
    double far;
} looking;

static void ask(looking *l, uint32_t b)
{
    l->any += !l->asked[b];
    l->asked[b] = true;
    const double limit = sunder_i_limit_of(&l->solver->model.body[b]);
    if (isfinite(limit)) l->far = fmax(l->far, limit);
}

/* The body and its cluster; what is fixed is of none. */
static void ask_cluster(looking *l, uint32_t b)
{
    size_t n;
    const sunder_i_solver *s = l->solver;
    ask(l, b);
    if (s->model.body[b].fixed) return;
    const uint32_t *member = sunder_i_solver_members(s, sunder_i_union_find(s->parent, b), &n);
    for (size_t k = 0; k < n; k++) ask(l, member[k]);
}

static void ask_all(looking *l)
{
    const sunder_i_solver *s = l->solver;
    for (size_t k = 0; k < s->now.n; k++) {
        const sunder_i_relation *r = &s->now.pair[k];
        const uint32_t i = s->model.body_of[r->a], j = s->model.body_of[r->b];
        if (!r->near || i == j) continue;
        if (!l->asked[i]) ask_cluster(l, i);
        if (!l->asked[j]) ask_cluster(l, j);
        l->far = fmax(l->far, 2 * sunder_i_farthest_near(&s->model, i, j));
    }
}

/* Who stands about a body that is asked about. *left: how much may be looked up still. False if memory is out. */
static bool meet(looking *l, uint32_t b, sunder_i_list *near, size_t *left)
{
    const sunder_i_model *model = &l->solver->model;
    const sunder_i_body *body = &model->body[b];
    for (uint32_t m = 0; m < body->members; m++) {
        const uint32_t f = model->member[body->member + m];
        double box[4];
        if (!model->present[f]) continue;
        near->n = 0;
        sunder_i_box_grow(model->box + 4 * (size_t)f, 2 * l->far + model->rules.gap, box);
        if (!sunder_i_rtree_query(&model->tree, box, near)) return false;
        for (size_t k = 0; k < near->n; k++) l->met[model->body_of[near->item[k]]] = true;
        *left = *left > near->n ? *left - near->n : 0;
    }
    return true;
}

/* All that is met, ascending. */
static sunder_status find_some(looking *l, sunder_i_model *model, sunder_error *err)
{
    const size_t most = LOOKED_UP * model->things;
    size_t left = most;
    sunder_i_list near = {0};
    bool ok = true;
    for (uint32_t b = 0; b < model->bodies && ok && left; b++)
        if (l->asked[b]) ok = meet(l, b, &near, &left);
    near.n = 0;
    for (uint32_t b = 0; b < model->bodies && ok && left; b++)
        if (l->asked[b] || l->met[b]) ok = sunder_i_list_push(&near, b);
    sunder_status status = ok ? SUNDER_OK : sunder_i_no_memory(err);
    if (ok && !left) status = sunder_i_model_find_seams(model, err);
    if (ok && left) status = sunder_i_model_find_seams_of(model, near.item, near.n, err);
    sunder_i_free(near.item);
    return status;
}

sunder_status sunder_i_report_find_seams(sunder_i_solver *s, sunder_error *err)
{
    looking l = {.solver = s,
                 .asked = sunder_i_calloc(s->model.bodies, sizeof *l.asked),
                 .met = sunder_i_calloc(s->model.bodies, sizeof *l.met)};
    sunder_status status = l.asked && l.met ? SUNDER_OK : sunder_i_no_memory(err);
    if (!status) ask_all(&l);
    if (l.any) status = find_some(&l, &s->model, err);
    sunder_i_free(l.asked);
    sunder_i_free(l.met);
    return status;
}
