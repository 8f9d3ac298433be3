/* Contact groups of the layout: for each a proof of how little it could cost, and what is cheaper where such is found.
 *
 * A group is what hangs together by contact, or what a proof takes together. Each is looked into by itself, all from
 * the places at the round's start; what one finds to be cheaper is taken. Whoever is in its way, of another group,
 * belongs to it in the next round; so do two groups that have invited the same guest. What did not change from one
 * round to the next keeps its proof. Rounds join groups, or better the layout by what counts, so they end; there are
 * only so many. */
#include "displacement/clusters/stages.h"
#include "displacement/clusters/tuning.h"
#include "displacement/layer/resolution.h"
#include "displacement/optimum/optimum.h"

#include "base/parallel.h"
#include "base/union_find.h"
#include "base/watch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void sunder_i_groups_free(sunder_i_groups *g)
{
    for (size_t k = 0; k < g->n; k++) sunder_i_group_free(&g->group[k]);
    sunder_i_free(g->group);
    sunder_i_free(g->of);
    sunder_i_free(g->waived);
    memset(g, 0, sizeof *g);
}

/* ---- Who is of which group --------------------------------------------------------------------------------------- */

typedef struct gathering {
    const sunder_i_solver *solver;
    uint32_t *parent;
    bool *counts;        /* [bodies] what moved, or is in conflict, and what is in contact with such */
    sunder_i_list queue; /* of these, those whose contacts are to be looked for */
    sunder_i_list near;
    sunder_i_id_pair *touch; /* a body that may move, and a fixed one in contact */
    size_t touches, touch_capacity;
    sunder_i_id_pair *member;
    size_t members, capacity;
} gathering;

static bool is_fixed(const gathering *g, uint32_t body) { return g->solver->model.body[body].fixed; }

static bool count(gathering *g, uint32_t body)
{
    if (g->counts[body] || is_fixed(g, body)) return true;
    g->counts[body] = true;
    return sunder_i_list_push(&g->queue, body);
}

/* What moved, and what is in conflict. */
static bool count_all(gathering *g)
{
    const sunder_i_solver *s = g->solver;
    bool ok = true;
    for (uint32_t b = 0; b < s->model.bodies && ok; b++)
        if (s->model.move[2 * b] != 0 || s->model.move[2 * b + 1] != 0) ok = count(g, b);
    for (size_t k = 0; k < s->now.n && ok; k++) {
        const sunder_i_relation *r = &s->now.pair[k];
        if (sunder_i_is_conflict_of_bodies(&s->model, r))
            ok = count(g, s->model.body_of[r->a]) && count(g, s->model.body_of[r->b]);
    }
    return ok;
}

/* The gap, or a length of the smaller body where that is 0: what is a small share of it is none. So a layer on another
 * scale has the same contacts. */
static double length_of(const sunder_i_model *model, const sunder_i_body *p, const sunder_i_body *q)
{
    if (model->rules.gap > 0) return model->rules.gap;
    return fmin(p->box[2] - p->box[0] + p->box[3] - p->box[1], q->box[2] - q->box[0] + q->box[3] - q->box[1]);
}

static bool are_in_contact(const sunder_i_model *model, uint32_t i, uint32_t j, bool *contact)
{
    const sunder_i_waived none = {0};
    const double *t = model->move + 2 * (size_t)i, *v = model->move + 2 * (size_t)j, u[2] = {v[0] - t[0], v[1] - t[1]};
    const double hair = CONTACT * length_of(model, &model->body[i], &model->body[j]);
    sunder_i_forbidden f;
    const bool ok = sunder_i_forbidden_init(&f, model, &none, i, j, fabs(u[0]) + fabs(u[1]) + hair);
    *contact = ok && sunder_i_forbidden_is_near(&f, u, hair);
    sunder_i_forbidden_free(&f);
    return ok;
}

/* Joins a body with those it is in contact with. Fixed ones join none. */
static bool join_contacts(gathering *g, uint32_t b)
{
    const sunder_i_model *model = &g->solver->model;
    const sunder_i_body *body = &model->body[b];
    double box[4];
    g->near.n = 0;
    if (body->pieces == 0) return true;
    sunder_i_body_box(body, model->move + 2 * (size_t)b, model->rules.gap + CONTACT * length_of(model, body, body),
                      box);
    if (!sunder_i_rtree_query(model->standing, box, &g->near)) return false;
    for (size_t k = 0; k < g->near.n; k++) g->near.item[k] = model->body_of[g->near.item[k]];
    g->near.n = sunder_i_set_make(g->near.item, g->near.n);
    for (size_t k = 0; k < g->near.n; k++) {
        const uint32_t other = g->near.item[k];
        bool contact;
        if (other == b ||
            (!is_fixed(g, other) && sunder_i_union_find(g->parent, other) == sunder_i_union_find(g->parent, b)))
            continue;
        if (!are_in_contact(model, b, other, &contact)) return false;
        if (!contact) continue;
        if (is_fixed(g, other)) {
            if (!sunder_i_reserve(&g->touch, &g->touch_capacity, g->touches + 1, sizeof *g->touch)) return false;
            g->touch[g->touches++] = (sunder_i_id_pair){b, other};
        } else {
            sunder_i_union_join(g->parent, b, other);
            if (!count(g, other)) return false;
        }
    }
    return true;
}

static bool flood(gathering *g, const sunder_i_id_pair *joined, size_t n)
{
    sunder_i_union_init(g->parent, g->solver->model.bodies);
    if (!count_all(g)) return false;
    for (size_t k = 0; k < n; k++) {
        sunder_i_union_join(g->parent, joined[k].a, joined[k].b);
        if (!count(g, joined[k].a) || !count(g, joined[k].b)) return false;
    }
    for (size_t k = 0; k < g->queue.n; k++)
        if (!sunder_i_step() || !join_contacts(g, g->queue.item[k])) return false;
    return true;
}

static bool add_member(gathering *g, uint32_t of, uint32_t body)
{
    const uint32_t root = sunder_i_union_find(g->parent, of);
    if (!sunder_i_reserve(&g->member, &g->capacity, g->members + 1, sizeof *g->member)) return false;
    g->member[g->members++] = (sunder_i_id_pair){root, body};
    return true;
}

static bool list_members(gathering *g)
{
    bool ok = true;
    for (size_t k = 0; k < g->queue.n && ok; k++) ok = add_member(g, g->queue.item[k], g->queue.item[k]);
    for (size_t k = 0; k < g->touches && ok; k++) ok = add_member(g, g->touch[k].a, g->touch[k].b);
    if (ok && g->members) qsort(g->member, g->members, sizeof *g->member, sunder_i_by_id_pair);
    size_t out = 0;
    for (size_t k = 0; k < g->members; k++)
        if (k == 0 || sunder_i_by_id_pair(&g->member[k - 1], &g->member[k])) g->member[out++] = g->member[k];
    g->members = out;
    return ok;
}

/* The group of these members, as they stand; it is known by the least of them that may move, so that its name does not
 * depend on others. */
static sunder_status make_group(const sunder_i_solver *s, const sunder_i_id_pair *member, size_t n, sunder_i_group *out,
                                sunder_error *err)
{
    out->body = sunder_i_alloc(n, sizeof *out->body);
    out->move = sunder_i_alloc(2 * n, sizeof *out->move);
    if (!out->body || !out->move) return sunder_i_no_memory(err);
    out->n = n;
    out->number = SUNDER_I_NOBODY;
    for (size_t k = 0; k < n; k++) {
        const uint32_t b = out->body[k] = member[k].b;
        memcpy(out->move + 2 * k, s->model.move + 2 * (size_t)b, 2 * sizeof *out->move);
        if (out->number == SUNDER_I_NOBODY && !s->model.body[b].fixed) out->number = b;
    }
    out->margin = sunder_i_solver_margin(s, out->body, n);
    return SUNDER_OK;
}

/* A group of the last round that is the same in all that counts, and so keeps its proof. */
static void keep_proof(const sunder_i_groups *old, sunder_i_group *now)
{
    for (size_t k = 0; k < old->n; k++) {
        sunder_i_group *g = &old->group[k];
        if (g->number != now->number) continue;
        if (!g->done || g->joins.n || g->n != now->n || memcmp(g->body, now->body, g->n * sizeof *g->body) ||
            memcmp(g->move, now->move, 2 * g->n * sizeof *g->move))
            return;
        const sunder_i_group kept = *g;
        *g = *now;
        *now = kept;
        return;
    }
}

static sunder_status make_groups(const gathering *g, sunder_i_groups *groups, sunder_error *err)
{
    const sunder_i_solver *s = g->solver;
    sunder_i_groups made = {.group = sunder_i_calloc(g->members, sizeof *made.group),
                            .of = sunder_i_alloc(s->model.bodies, sizeof *made.of)};
    sunder_status status = made.group && made.of ? SUNDER_OK : sunder_i_no_memory(err);
    for (size_t b = 0; !status && b < s->model.bodies; b++) made.of[b] = SUNDER_I_NOBODY;
    for (size_t first = 0, end; first < g->members && !status; first = end) {
        for (end = first; end < g->members && g->member[end].a == g->member[first].a; end++) {
        }
        sunder_i_group *group = &made.group[made.n++];
        status = make_group(s, g->member + first, end - first, group, err);
        if (status) break;
        keep_proof(groups, group);
        for (size_t k = 0; k < group->n; k++)
            if (!s->model.body[group->body[k]].fixed) made.of[group->body[k]] = group->number;
    }
    if (status) {
        sunder_i_groups_free(&made);
        return status;
    }
    made.waived = groups->waived;
    made.waived_n = groups->waived_n;
    groups->waived = NULL;
    sunder_i_groups_free(groups);
    *groups = made;
    return SUNDER_OK;
}

static sunder_status gather(sunder_i_solver *s, const sunder_i_id_pair *joined, size_t n, sunder_error *err)
{
    gathering g = {.solver = s,
                   .parent = sunder_i_alloc(s->model.bodies, sizeof *g.parent),
                   .counts = sunder_i_calloc(s->model.bodies, sizeof *g.counts)};
    const bool ok = g.parent && g.counts && flood(&g, joined, n) && list_members(&g);
    const sunder_status status = ok ? make_groups(&g, &s->groups, err) : sunder_i_no_memory(err);
    sunder_i_free(g.parent);
    sunder_i_free(g.counts);
    sunder_i_free(g.queue.item);
    sunder_i_free(g.near.item);
    sunder_i_free(g.touch);
    sunder_i_free(g.member);
    return status;
}

/* ---- Rounds ------------------------------------------------------------------------------------------------------ */

/* What is listed is not asked of anybody. */
static sunder_status waive(sunder_i_solver *s, sunder_error *err)
{
    sunder_i_free(s->groups.waived);
    s->groups.waived_n = 0;
    s->groups.waived = sunder_i_alloc(s->now.n, sizeof *s->groups.waived);
    if (!s->groups.waived) return sunder_i_no_memory(err);
    for (size_t k = 0; k < s->now.n; k++)
        if (sunder_i_is_conflict(&s->now.pair[k]))
            s->groups.waived[s->groups.waived_n++] = (sunder_i_id_pair){s->now.pair[k].a, s->now.pair[k].b};
    return SUNDER_OK;
}

/* Groups with a pair that is listed, or a body that is pinned, are left as they stand: what they are held to is not
 * what is asked of others. */
static bool hold(sunder_i_solver *s)
{
    const sunder_i_model *model = &s->model;
    sunder_i_groups *groups = &s->groups;
    bool *held = sunder_i_calloc(model->bodies, sizeof *held);
    if (!held) return false;
    for (size_t k = 0; k < groups->waived_n; k++) {
        const uint32_t i = model->body_of[groups->waived[k].a], j = model->body_of[groups->waived[k].b];
        if (i != j) held[i] = held[j] = true;
    }
    for (size_t k = 0; k < groups->n; k++)
        for (size_t m = 0; m < groups->group[k].n; m++) {
            const uint32_t b = groups->group[k].body[m];
            if (model->body[b].pinned || (held[b] && !model->body[b].fixed)) groups->group[k].held = true;
        }
    sunder_i_free(held);
    return true;
}

static sunder_status prove_groups(void *context, size_t begin, size_t end, sunder_error *err)
{
    const sunder_i_solver *s = context;
    const sunder_i_waived waived = {s->groups.waived, s->groups.waived_n};
    for (size_t k = begin; k < end; k++) {
        sunder_i_group *g = &s->groups.group[k];
        if (g->done) continue;
        const double steps = STEPS_EACH * (double)g->n * s->model.rules.effort;
        const sunder_status status =
            sunder_i_group_prove(&s->model, &waived, s->groups.of, g, (uint64_t)fmin(steps, 0x1p62), err);
        if (status) return status;
    }
    return SUNDER_OK;
}

typedef struct taking {
    sunder_i_solver *solver;
    uint32_t *by;   /* [bodies] the place in the list of the group that moved it; SUNDER_I_NOBODY: none */
    double *before; /* [2 * bodies] */
} taking;

static void place(taking *t, size_t k, bool back)
{
    const sunder_i_group *g = &t->solver->groups.group[k];
    for (size_t m = 0; m < g->n; m++) {
        const uint32_t b = g->body[m];
        if (!back) memcpy(t->before + 2 * (size_t)b, t->solver->model.move + 2 * (size_t)b, 2 * sizeof *t->before);
        if (!back) t->by[b] = (uint32_t)k;
        sunder_i_solver_place(t->solver, b, back ? t->before + 2 * (size_t)b : g->move + 2 * m);
    }
}

/* Is every coordinate of the group as it should be? */
static bool is_exact(const sunder_i_model *model, const sunder_i_group *g)
{
    for (size_t k = 0; k < g->n; k++) {
        const sunder_i_body *body = &model->body[g->body[k]];
        for (uint32_t m = 0; m < body->members; m++)
            if (model->inexact[model->member[body->member + m]]) return false;
    }
    return true;
}

/* Takes back what the group found. */
static bool put_back(taking *t, uint32_t k)
{
    sunder_i_solver *s = t->solver;
    sunder_i_group *g = k == SUNDER_I_NOBODY ? NULL : &s->groups.group[k];
    if (!g || !g->improved) return false;
    g->improved = g->done = false;
    place(t, k, true);
    /* What rounding ate into is looked for again with a wider margin. */
    for (size_t m = 0; m < g->n; m++) {
        const uint32_t b = g->body[m];
        memcpy(g->move + 2 * m, t->before + 2 * (size_t)b, 2 * sizeof *g->move);
        if (s->widened[b] < MOST_MARGINS_AGAIN)
            s->widened[b]++;
        else
            g->done = true;
    }
    return true;
}

/* Who moved the one or the other of two features goes back: *any, if somebody did. Of two groups that run into each
 * other the first one stays, if it can: they are looked at again, together. */
static void part(taking *t, uint32_t a, uint32_t b, bool *any)
{
    const uint32_t i = t->by[t->solver->model.body_of[a]], j = t->by[t->solver->model.body_of[b]];
    const sunder_i_group *group = t->solver->groups.group;
    if (i == SUNDER_I_NOBODY && j == SUNDER_I_NOBODY) return;
    const bool both = i != j && i != SUNDER_I_NOBODY && j != SUNDER_I_NOBODY && group[i].improved && group[j].improved;
    if (!both || i > j) *any = put_back(t, i) || *any;
    if (!both || j > i) *any = put_back(t, j) || *any;
}

/* Does a conflict stand that did not, or did one jump over another? Then who moved goes back: *any. */
static void put_back_offenders(taking *t, bool *any)
{
    sunder_i_solver *s = t->solver;
    const sunder_i_groups *groups = &s->groups;
    *any = false;
    memset(s->changed, 0, s->model.features * sizeof *s->changed);
    for (size_t k = 0; k < s->now.n; k++) {
        const sunder_i_relation *r = &s->now.pair[k];
        const sunder_i_id_pair key = {r->a, r->b};
        if (sunder_i_is_conflict_of_bodies(&s->model, r) &&
            !(groups->waived_n && bsearch(&key, groups->waived, groups->waived_n, sizeof key, sunder_i_by_id_pair)))
            part(t, r->a, r->b, any);
    }
    for (size_t k = 0; k < s->jumps.n; k++) part(t, s->jumps.pair[k].a, s->jumps.pair[k].b, any);
}

/* Takes over what was found to be cheaper, where exact relations bear it out: *any. */
static sunder_status take_over(sunder_i_solver *s, bool *any, sunder_error *err)
{
    const size_t n = s->model.bodies;
    taking t = {s, sunder_i_alloc(n, sizeof *t.by), sunder_i_alloc(2 * n, sizeof *t.before)};
    sunder_status status = t.by && t.before ? SUNDER_OK : sunder_i_no_memory(err);
    bool again = false;
    *any = false;
    if (!status) {
        for (size_t b = 0; b < n; b++) t.by[b] = SUNDER_I_NOBODY;
        memset(s->changed, 0, s->model.features * sizeof *s->changed);
        for (size_t k = 0; k < s->groups.n; k++) {
            if (!s->groups.group[k].improved) continue;
            place(&t, k, false);
            if (!is_exact(&s->model, &s->groups.group[k])) put_back(&t, (uint32_t)k);
            again = true;
        }
    }
    while (!status && again) {
        status = sunder_i_solver_relate(s, err);
        if (!status) put_back_offenders(&t, &again);
    }
    for (size_t k = 0; !status && k < s->groups.n; k++) {
        *any = *any || s->groups.group[k].improved || !s->groups.group[k].done;
        s->groups.group[k].improved = false;
    }
    sunder_i_free(t.by);
    sunder_i_free(t.before);
    return status;
}

typedef struct joining {
    sunder_i_id_pair *pair;
    size_t n, capacity;
} joining;

/* Groups of which one is in the other's way, or that have a guest in common. */
static bool join(const sunder_i_solver *s, joining *j, bool *any)
{
    const sunder_i_groups *groups = &s->groups;
    bool ok = true;
    uint32_t *host = sunder_i_alloc(s->model.bodies, sizeof *host);
    *any = false;
    for (size_t b = 0; host && b < s->model.bodies; b++) host[b] = groups->of[b];
    for (size_t k = 0; k < groups->n && host && ok; k++) {
        const sunder_i_group *g = &groups->group[k];
        for (size_t m = 0; m < g->joins.n + g->guests.n && ok; m++) {
            const uint32_t b = m < g->joins.n ? g->joins.item[m] : g->guests.item[m - g->joins.n];
            if (s->model.body[b].fixed || host[b] == g->number) continue;
            if (host[b] == SUNDER_I_NOBODY) {
                host[b] = g->number;
                continue;
            }
            ok = sunder_i_reserve(&j->pair, &j->capacity, j->n + 1, sizeof *j->pair);
            if (ok) j->pair[j->n++] = (sunder_i_id_pair){g->number, host[b]};
            *any = true;
        }
    }
    ok = ok && host;
    sunder_i_free(host);
    return ok;
}

sunder_status sunder_i_solver_optimise(sunder_i_solver *s, sunder_error *err)
{
    joining j = {0};
    if (!(s->model.rules.effort > 0)) return SUNDER_OK;
    bool again = true;
    sunder_status status = SUNDER_OK;
    for (int round = 0; round < OPTIMISED && again && !status; round++) {
        bool moved = false;
        status = waive(s, err);
        if (!status) status = gather(s, j.pair, j.n, err);
        if (!status && !hold(s)) status = sunder_i_no_memory(err);
        if (!status)
            status = sunder_i_parallel(s->model.rules.threads, s->groups.n, SUNDER_I_GRAIN_WHOLE, prove_groups, s, err);
        if (!status) status = join(s, &j, &again) ? take_over(s, &moved, err) : sunder_i_no_memory(err);
        again = again || moved;
    }
    sunder_i_free(j.pair);
    return status;
}
