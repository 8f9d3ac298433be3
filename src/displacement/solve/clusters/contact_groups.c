/* Contact groups: the components of contact in the layout, of bodies that moved or are in conflict and bodies in
 * contact with these; or the sets that a proof treats together.
 *
 * Fixed bodies connect nothing, and are members of every group that they touch, as obstacles. A group is identified by
 * the least of its movable bodies, so its identity does not depend on others, and a group that did not change from one
 * round to the next keeps its proof. */
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/contact_flood.h"
#include "displacement/solve/clusters/tuning.h"
#include "displacement/solve/search/shake.h"

#include "base/union_find.h"

#include <stdlib.h>
#include <string.h>

void sunder_i_groups_free(sunder_i_groups *groups)
{
    for (size_t k = 0; k < groups->n; k++) sunder_i_group_free(&groups->group[k]);
    sunder_i_free_all(groups->group, groups->of, groups->waived, groups->joined, groups->spent);
    memset(groups, 0, sizeof *groups);
}

typedef struct gathering {
    const sunder_i_solver *solver;
    sunder_i_flood flood;
    sunder_i_id_pair *member; /* [members] the root of a group, and a body of the group */
    size_t members, capacity;
} gathering;

static bool add_member(gathering *g, uint32_t of, uint32_t body)
{
    const uint32_t root = sunder_i_union_find(g->flood.parent, of);
    if (!sunder_i_reserve(&g->member, &g->capacity, g->members + 1, sizeof *g->member)) return false;
    g->member[g->members++] = (sunder_i_id_pair){root, body};
    return true;
}

static bool list_members(gathering *g)
{
    bool ok = true;
    const sunder_i_flood *f = &g->flood;
    for (size_t k = 0; k < f->body.n && ok; k++) ok = add_member(g, f->body.item[k], f->body.item[k]);
    for (size_t k = 0; k < f->touches && ok; k++) ok = add_member(g, f->touch[k].a, f->touch[k].b);
    if (ok && g->members) qsort(g->member, g->members, sizeof *g->member, sunder_i_by_id_pair);
    size_t out = 0;
    for (size_t k = 0; k < g->members; k++)
        if (k == 0 || sunder_i_by_id_pair(&g->member[k - 1], &g->member[k])) g->member[out++] = g->member[k];
    g->members = out;
    return ok;
}

/* Do the bodies that were shaken have more than the share MOSTLY_SHAKEN of the group's cost? */
static bool is_tired(const sunder_i_solver *s, const sunder_i_group *g)
{
    double all = 0, tired = 0;
    for (size_t k = 0; k < g->n; k++) {
        const sunder_i_body *b = &s->model.body[g->body[k]];
        const double cost = b->fixed ? 0 : sunder_i_move_cost(&s->model, g->body[k], g->move + 2 * k);
        all += cost;
        if (sunder_i_is_in(s, SUNDER_I_SHAKING, g->body[k], SUNDER_I_SHAKEN)) tired += cost;
    }
    return tired > MOSTLY_SHAKEN * all;
}

/* Makes the group of these n members at their present moves. Its number is that of its least movable body, so it does
 * not depend on other groups. */
static sunder_status make_group(const sunder_i_solver *s, const sunder_i_id_pair *member, size_t n, sunder_i_group *out,
                                sunder_error *err)
{
    out->body = sunder_i_alloc(n, sizeof *out->body);
    out->move = sunder_i_alloc(2 * n, sizeof *out->move);
    if (!out->body || !out->move) return sunder_i_failure_cause(err);
    out->n = n;
    out->number = SUNDER_I_NOBODY;
    for (size_t k = 0; k < n; k++) {
        const uint32_t b = out->body[k] = member[k].b;
        memcpy(out->move + 2 * k, s->model.move + 2 * (size_t)b, 2 * sizeof *out->move);
        out->with_slack = out->with_slack || sunder_i_is_in(s, SUNDER_I_SLACK, b, SUNDER_I_WITH_SLACK);
        if (out->number == SUNDER_I_NOBODY && !s->model.body[b].fixed) out->number = b;
    }
    out->margin = sunder_i_solver_margin(s, out->body, n);
    out->tired = is_tired(s, out);
    return SUNDER_OK;
}

/* If the group is the same as `old`, with the same moves, it keeps the proof of `old`: the two are swapped. */
static void keep_proof(sunder_i_group *old, sunder_i_group *now)
{
    if (old->state == SUNDER_I_TO_BE_PROVED || old->joins.n || old->n != now->n ||
        memcmp(old->body, now->body, old->n * sizeof *old->body) ||
        memcmp(old->move, now->move, 2 * old->n * sizeof *old->move))
        return;
    const sunder_i_group kept = *old;
    *old = *now;
    *now = kept;
}

/* The number of the group that contains all bodies and guests of an old group, except those that are in no group now;
 * SUNDER_I_NOBODY: there is none. */
static uint32_t heir_of(const sunder_i_model *model, const sunder_i_group *old, const uint32_t *of)
{
    const uint32_t heir = of[old->number];
    for (size_t m = 0; m < old->n + old->guests.n; m++) {
        const uint32_t b = m < old->n ? old->body[m] : old->guests.item[m - old->n];
        if (!model->body[b].fixed && of[b] != heir && of[b] != SUNDER_I_NOBODY) return SUNDER_I_NOBODY;
    }
    return heir;
}

/* A bound that was proved for bodies holds wherever they stand. So a group inherits the bounds of all groups that
 * merged into it, until more is proved; a body that is in no group any more becomes a guest. at: [bodies] index of the
 * group by number. False if memory is out. */
static bool hand_on(const sunder_i_model *model, sunder_i_groups *old, sunder_i_groups *now, const uint32_t *at)
{
    bool ok = true;
    for (size_t k = 0; k < old->n && ok; k++) {
        sunder_i_group *g = &old->group[k];
        const uint32_t heir = g->bound > 0 || g->shaken_at > 0 ? heir_of(model, g, now->of) : SUNDER_I_NOBODY;
        if (heir == SUNDER_I_NOBODY) continue;
        sunder_i_group *to = &now->group[at[heir]];
        if (to->state != SUNDER_I_TO_BE_PROVED) continue;
        to->shaken_at += g->shaken_at;
        if (!(g->bound > 0)) continue;
        to->bound = to->bound > 0 ? nextafter(to->bound + g->bound, -INFINITY) : g->bound;
        to->asked += g->asked;
        for (size_t m = 0; m < g->n && ok; m++)
            if (!model->body[g->body[m]].fixed && now->of[g->body[m]] == SUNDER_I_NOBODY)
                ok = sunder_i_list_push(&to->guests, g->body[m]);
        for (size_t m = 0; m < g->guests.n && ok; m++) ok = sunder_i_list_push(&to->guests, g->guests.item[m]);
        to->guests.n = sunder_i_set_make(to->guests.item, to->guests.n);
        ok = ok && sunder_i_bound_trees_take(&to->trees, &g->trees);
    }
    return ok;
}

/* at: [bodies] receives the index of each group by its number. */
static void index_groups(const sunder_i_groups *old, uint32_t *at, size_t bodies)
{
    for (size_t b = 0; b < bodies; b++) at[b] = SUNDER_I_NOBODY;
    for (size_t k = 0; k < old->n; k++) at[old->group[k].number] = (uint32_t)k;
}

static size_t count_groups(const gathering *g)
{
    size_t n = 0;
    for (size_t k = 0; k < g->members; k++) n += k == 0 || g->member[k].a != g->member[k - 1].a;
    return n;
}

static sunder_status make_groups(const gathering *g, sunder_i_groups *groups, sunder_error *err)
{
    const sunder_i_solver *s = g->solver;
    uint32_t *at = sunder_i_alloc(s->model.bodies, sizeof *at);
    sunder_i_groups made = {.group = sunder_i_calloc(count_groups(g), sizeof *made.group),
                            .of = sunder_i_alloc(s->model.bodies, sizeof *made.of)};
    sunder_status status = made.group && made.of && at ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status) index_groups(groups, at, s->model.bodies);
    for (size_t b = 0; !status && b < s->model.bodies; b++) made.of[b] = SUNDER_I_NOBODY;
    for (size_t first = 0, end; first < g->members && !status; first = end) {
        for (end = first; end < g->members && g->member[end].a == g->member[first].a; end++) {
        }
        sunder_i_group *group = &made.group[made.n++];
        status = make_group(s, g->member + first, end - first, group, err);
        if (status) break;
        group->search = &sunder_i_group_search;
        if (at[group->number] != SUNDER_I_NOBODY) keep_proof(&groups->group[at[group->number]], group);
        for (size_t k = 0; k < group->n; k++)
            if (!s->model.body[group->body[k]].fixed) made.of[group->body[k]] = group->number;
    }
    if (!status) index_groups(&made, at, s->model.bodies);
    if (!status && !hand_on(&s->model, groups, &made, at)) status = sunder_i_failure_cause(err);
    sunder_i_free(at);
    if (status) {
        sunder_i_groups_free(&made);
        return status;
    }
    sunder_i_groups now = *groups;
    now.group = made.group;
    now.n = made.n;
    now.of = made.of;
    *groups = (sunder_i_groups){.group = groups->group, .n = groups->n, .of = groups->of};
    sunder_i_groups_free(groups);
    *groups = now;
    return SUNDER_OK;
}

sunder_status sunder_i_solver_gather_groups(sunder_i_solver *solver, sunder_error *err)
{
    gathering g = {.solver = solver};
    if (!solver->groups.spent)
        solver->groups.spent = sunder_i_calloc(solver->model.bodies, sizeof *solver->groups.spent);
    sunder_status status =
        solver->groups.spent ? sunder_i_flood_contacts(solver, &g.flood, err) : sunder_i_failure_cause(err);
    if (!status && !list_members(&g)) status = sunder_i_failure_cause(err);
    if (!status) status = make_groups(&g, &solver->groups, err);
    sunder_i_flood_free(&g.flood);
    sunder_i_free(g.member);
    return status;
}
