/* Contact groups of the layout: for each a proof of how little it could cost, and what is cheaper where such is found.
 *
 * Each is looked into by itself, all from the places at the round's start; what one finds to be cheaper is taken.
 * Whoever is in its way, of another group, belongs to it in the next round; so do two groups that have invited the same
 * guest. What did not change from one round to the next keeps its proof. Rounds join groups, or better the layout by
 * what counts, so they end; there are only so many, and a body is worth only so many steps in all of them. */
#include "displacement/clusters/stages.h"
#include "displacement/clusters/tuning.h"
#include "displacement/layer/resolution.h"
#include "displacement/optimum/optimum.h"

#include "base/parallel.h"
#include "base/watch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Rounds ------------------------------------------------------------------------------------------------------ */

sunder_status sunder_i_solver_waive(sunder_i_solver *s, sunder_error *err)
{
    sunder_i_free(s->groups.waived);
    s->groups.waived_n = 0;
    s->groups.waived = sunder_i_alloc(s->now.n, sizeof *s->groups.waived);
    if (!s->groups.waived) return sunder_i_no_memory(err);
    for (size_t k = 0; k < s->now.n; k++)
        if (sunder_i_is_conflict(&s->now.pair[k]))
            s->groups.waived[s->groups.waived_n++] =
                (sunder_i_id_pair){s->now.pair[k].a, sunder_i_whole_of(&s->model, s->now.pair[k].b)};
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

/* What the group's bodies have left, of which each is worth so many steps. */
static uint64_t allowance(const sunder_i_solver *s, const sunder_i_group *g)
{
    const double each = STEPS_EACH * s->model.rules.effort;
    double steps = 0;
    for (size_t m = 0; m < g->n; m++)
        if (!s->model.body[g->body[m]].fixed) steps += fmax(0, each - s->groups.spent[g->body[m]]);
    return (uint64_t)fmin(steps, 0x1p62);
}

static sunder_status prove_groups(void *context, size_t begin, size_t end, sunder_error *err)
{
    const sunder_i_solver *s = context;
    const sunder_i_waived waived = {s->groups.waived, s->groups.waived_n};
    for (size_t k = begin; k < end; k++) {
        sunder_i_group *g = &s->groups.group[k];
        if (g->done) continue;
        const sunder_status status = sunder_i_group_prove(&s->model, &waived, s->groups.of, g, allowance(s, g), err);
        if (status) return status;
    }
    return SUNDER_OK;
}

/* Bodies pay for the proofs that were made in this round, all of a group alike. */
static void charge(sunder_i_solver *s)
{
    for (size_t k = 0; k < s->groups.n; k++) {
        sunder_i_group *g = &s->groups.group[k];
        for (size_t m = 0; m < g->n; m++) s->groups.spent[g->body[m]] += (double)g->steps / (double)g->n;
        g->steps = 0;
    }
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

/* A conflict that is to be none. */
static bool offends(const sunder_i_solver *s, const sunder_i_relation *r)
{
    const sunder_i_waived waived = {s->groups.waived, s->groups.waived_n};
    return sunder_i_is_conflict_of_bodies(&s->model, r) && !sunder_i_is_waived(&s->model, &waived, r->a, r->b);
}

/* Does a conflict stand that did not, or did one jump over another? Then who moved goes back: *any. */
static void put_back_offenders(taking *t, bool *any)
{
    sunder_i_solver *s = t->solver;
    *any = false;
    memset(s->changed, 0, s->model.features * sizeof *s->changed);
    for (size_t k = 0; k < s->now.n; k++)
        if (offends(s, &s->now.pair[k])) part(t, s->now.pair[k].a, s->now.pair[k].b, any);
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

/* Groups of which one is in the other's way, or that have a guest in common. */
static bool join(sunder_i_solver *s, bool *any)
{
    sunder_i_groups *groups = &s->groups;
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
            ok = sunder_i_reserve(&groups->joined, &groups->capacity, groups->joins + 1, sizeof *groups->joined);
            if (ok) groups->joined[groups->joins++] = (sunder_i_id_pair){g->number, host[b]};
            *any = true;
        }
    }
    ok = ok && host;
    sunder_i_free(host);
    return ok;
}

sunder_status sunder_i_solver_optimise(sunder_i_solver *s, sunder_error *err)
{
    bool again = s->model.rules.effort > 0;
    sunder_status status = SUNDER_OK;
    for (int round = 0; round < OPTIMISED && again && !status; round++) {
        bool moved = false;
        status = sunder_i_solver_waive(s, err);
        if (!status) status = sunder_i_solver_gather_groups(s, err);
        if (!status && !hold(s)) status = sunder_i_no_memory(err);
        if (!status)
            status = sunder_i_parallel(s->model.rules.threads, s->groups.n, SUNDER_I_GRAIN_WHOLE, prove_groups, s, err);
        if (!status) charge(s);
        if (!status) status = join(s, &again) ? take_over(s, &moved, err) : sunder_i_no_memory(err);
        again = again || moved;
    }
    return status;
}
