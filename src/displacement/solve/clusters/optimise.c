/* Contact groups of the layout: proves for each a lower bound of its cost, and finds cheaper layouts. The order of the
 * steps of a round is a table.
 *
 * Each group is examined separately, all from the positions at the round's start; a cheaper layout of a group is taken.
 * Groups are treated as one in the next round if one is in the way of the other's cheaper layout, or if both proofs had
 * to include the same body outside them, a guest. A group that did not change from one round to the next keeps its
 * proof. A bound proved for bodies is inherited by the group that they are in, as long as the demands on their pairs
 * are the same. Rounds join groups, or improve the layout by a significant amount, so they end; their number is
 * limited, and a body has a limited number of steps in all of them.
 *
 * Pairs left in conflict must stand no worse than at the start, which is checked exactly for every layout taken;
 * uphold.c repairs the effect of rounding on them. So this stage runs once more after that repair, and no stage moves
 * bodies after it. */
#include "displacement/layer/resolution.h"
#include "displacement/prove/optimum/optimum.h"
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/layer_stages.h"
#include "displacement/solve/clusters/tuning.h"

#include "base/extremes.h"
#include "base/parallel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Rounds ------------------------------------------------------------------------------------------------------ */

/* Sets unlike[] for the bodies of pairs of `one` that `other` does not list, or lists with another demand. */
static void mark_unlike(const sunder_i_model *model, const sunder_i_waiver *one, size_t n, const sunder_i_waiver *other,
                        size_t m, bool *unlike)
{
    for (size_t k = 0; k < n; k++) {
        const sunder_i_waiver *like = m ? bsearch(&one[k], other, m, sizeof *other, sunder_i_by_id_pair) : NULL;
        if (!like || sunder_i_waiver_clearance(like) != sunder_i_waiver_clearance(&one[k]))
            unlike[model->body_of[one[k].a]] = unlike[model->body_of[one[k].b]] = true;
    }
}

/* A proof depends on the demands on the group's pairs. If these have changed, the proof is dropped and made again.
 * before: [n] the former list. False if memory is out. */
static bool forget_proofs(sunder_i_solver *s, const sunder_i_waiver *before, size_t n)
{
    const sunder_i_model *model = &s->model;
    sunder_i_groups *groups = &s->groups;
    bool *unlike = sunder_i_calloc(model->bodies, sizeof *unlike);
    if (!unlike) return false;
    mark_unlike(model, before, n, groups->waived, groups->waived_n, unlike);
    mark_unlike(model, groups->waived, groups->waived_n, before, n, unlike);
    for (size_t k = 0; k < groups->n; k++) {
        sunder_i_group *g = &groups->group[k];
        for (size_t m = 0; m < g->n + g->guests.n; m++) {
            const uint32_t b = m < g->n ? g->body[m] : g->guests.item[m - g->n];
            if (!unlike[b] || model->body[b].fixed) continue;
            g->state = SUNDER_I_TO_BE_PROVED;
            g->bound = 0;
        }
    }
    sunder_i_free(unlike);
    return true;
}

/* Adds a pair to the list of *m. Its demand is that of the list of groups, or is computed from the start. */
static sunder_status list_pair(const sunder_i_solver *s, const sunder_i_relation *r, sunder_i_waiver *list, size_t *m,
                               sunder_error *err)
{
    const sunder_i_waiver *before = s->groups.waived;
    const size_t n = s->groups.waived_n;
    const uint32_t a = r->a, b = sunder_i_whole_of(&s->model, r->b);
    sunder_i_waiver *last = *m ? &list[*m - 1] : NULL;
    if (last && last->a == a && last->b == b) {
        last->overlap = last->overlap || r->overlap;
        return SUNDER_OK;
    }
    sunder_i_requirement held = {.clearance = -INFINITY};
    sunder_status status = SUNDER_OK;
    const sunder_i_waiver key = {.a = a, .b = b},
                          *known = n ? bsearch(&key, before, n, sizeof key, sunder_i_by_id_pair) : NULL;
    if (known)
        held.clearance = known->stood;
    else if (sunder_i_is_conflict_of_bodies(&s->model, r))
        status = sunder_i_requirement_find(&s->model, &s->start, a, b, &held, err);
    if (!status) list[(*m)++] = (sunder_i_waiver){a, b, held.clearance, r->overlap};
    return status;
}

sunder_status sunder_i_solver_find_waivers(const sunder_i_solver *solver, sunder_i_waiver **list, size_t *n,
                                           sunder_error *err)
{
    *n = 0;
    *list = sunder_i_alloc(solver->now.n, sizeof **list);
    sunder_status status = *list ? SUNDER_OK : sunder_i_failure_cause(err);
    for (size_t k = 0; k < solver->now.n && !status; k++)
        if (sunder_i_is_conflict(&solver->now.pair[k])) status = list_pair(solver, &solver->now.pair[k], *list, n, err);
    return status;
}

sunder_status sunder_i_solver_list_waivers(sunder_i_solver *solver, sunder_error *err)
{
    sunder_i_groups *groups = &solver->groups;
    sunder_i_waiver *before = groups->waived, *list;
    size_t n;
    const sunder_status status = sunder_i_solver_find_waivers(solver, &list, &n, err);
    if (status) {
        sunder_i_free(list);
        return status;
    }
    const size_t before_n = groups->waived_n;
    groups->waived = list;
    groups->waived_n = n;
    const bool ok = forget_proofs(solver, before, before_n);
    sunder_i_free(before);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

/* Groups with a pinned body keep their layout. */
static void hold_pinned_groups(sunder_i_solver *s)
{
    for (size_t k = 0; k < s->groups.n; k++)
        for (size_t m = 0; m < s->groups.group[k].n; m++)
            if (s->model.body[s->groups.group[k].body[m]].pinned) s->groups.group[k].held = true;
}

/* The steps for the proof of a group: what its bodies have not spent of STEPS_EACH; a small group counts as one of
 * SMALL_GROUP bodies. A body gets at least the share 1 / LATE, so that something is proved of groups that form late. */
static uint64_t steps_allowed(const sunder_i_solver *s, const sunder_i_group *g)
{
    size_t movers = 0;
    for (size_t m = 0; m < g->n; m++) movers += !s->model.body[g->body[m]].fixed;
    const double small = movers && movers < SMALL_GROUP ? (double)SMALL_GROUP / (double)movers : 1;
    const double each = small * STEPS_EACH * s->model.rules.effort;
    double steps = 0;
    for (size_t m = 0; m < g->n; m++)
        if (!s->model.body[g->body[m]].fixed) steps += sunder_i_max(each / LATE, each - s->groups.spent[g->body[m]]);
    return (uint64_t)sunder_i_min(steps, 0x1p62);
}

static bool is_group_wanted(const sunder_i_solver *s, const sunder_i_group *g)
{
    return sunder_i_solver_any_of(s, g->body, g->n, sunder_i_is_wanted);
}

static sunder_status prove_groups(void *context, size_t begin, size_t end, sunder_error *err)
{
    const sunder_i_solver *s = context;
    const sunder_i_waived waived = {s->groups.waived, s->groups.waived_n, s->states.of[SUNDER_I_DIAGONALS]};
    for (size_t k = begin; k < end; k++) {
        sunder_i_group *g = &s->groups.group[k];
        if (g->state != SUNDER_I_TO_BE_PROVED || !is_group_wanted(s, g)) continue;
        sunder_i_reading reading;
        sunder_i_reads_begin(&reading, &s->model, g->number);
        const sunder_status status =
            sunder_i_group_prove(&s->model, &waived, s->groups.of, g, steps_allowed(s, g), err);
        sunder_i_reads_end(&reading);
        if (status) return status;
    }
    return SUNDER_OK;
}

/* Charges the steps of this round's proofs to the bodies of each group, in equal shares. */
static void charge_bodies(sunder_i_solver *s)
{
    for (size_t k = 0; k < s->groups.n; k++) {
        sunder_i_group *g = &s->groups.group[k];
        for (size_t m = 0; m < g->n; m++) s->groups.spent[g->body[m]] += (double)g->steps / (double)g->n;
        for (size_t m = 0; m < g->n && g->shaken; m++) sunder_i_body_event(&s->states, g->body[m], SUNDER_I_IS_SHAKEN);
        g->shaken = false;
        g->steps = 0;
    }
}

typedef struct taking {
    sunder_i_solver *solver;
    uint32_t *by;            /* [bodies] index of the group that moved the body; SUNDER_I_NOBODY: none */
    double *before;          /* [2 * bodies] moves before */
    size_t *budget;          /* [bodies] by roots of clusters: for sunder_i_solver_mend() */
    sunder_i_id_pair mended; /* no pair before this one is worse than at the start, and repairs keep it so */
} taking;

static void place_group(taking *t, size_t k, bool back)
{
    const sunder_i_group *g = &t->solver->groups.group[k];
    for (size_t m = 0; m < g->n; m++) {
        const uint32_t b = g->body[m];
        if (!back) memcpy(t->before + 2 * (size_t)b, t->solver->model.move + 2 * (size_t)b, 2 * sizeof *t->before);
        /* A fixed body does not move, and may be in several groups. */
        if (!back && !t->solver->model.body[b].fixed) t->by[b] = (uint32_t)k;
        sunder_i_solver_place(t->solver, b, back ? t->before + 2 * (size_t)b : g->move + 2 * m);
    }
}

/* Do all features of the group have exact coordinates? */
static bool is_exact(const sunder_i_model *model, const sunder_i_group *g)
{
    for (size_t k = 0; k < g->n; k++) {
        const sunder_i_body *body = &model->body[g->body[k]];
        for (uint32_t m = 0; m < body->members; m++)
            if (model->inexact[model->member[body->member + m]]) return false;
    }
    return true;
}

static bool takes_part(const sunder_i_group *g, uint32_t body)
{
    for (size_t m = 0; m < g->n; m++)
        if (g->body[m] == body) return true;
    return false;
}

/* Undoes the new layout of group k, if it has one; returns whether it had. known: the layout failed in itself, and not
 * because of a body outside the group. */
static bool put_back(taking *t, uint32_t k, bool known)
{
    sunder_i_solver *s = t->solver;
    sunder_i_group *g = k == SUNDER_I_NOBODY ? NULL : &s->groups.group[k];
    if (!g || !sunder_i_group_is_cheaper(g)) return false;
    const bool tight = g->state == SUNDER_I_IS_CHEAPER_TIGHT;
    g->state = SUNDER_I_TO_BE_PROVED;
    place_group(t, k, true);
    /* A layout that failed because of rounding is looked for again, with a wider margin. One without room for rounding
     * is not looked for again, unless another group was in its way. */
    for (size_t m = 0; m < g->n; m++) {
        const uint32_t b = g->body[m];
        memcpy(g->move + 2 * m, t->before + 2 * (size_t)b, 2 * sizeof *g->move);
        if (tight && known)
            sunder_i_body_event(&s->states, b, SUNDER_I_LACKS_SLACK);
        else if (s->widened[b] < MOST_MARGINS_AGAIN)
            s->widened[b]++;
        else
            g->state = SUNDER_I_IS_PROVED;
    }
    return true;
}

/* Undoes the new layout of the groups that moved features a and b; *any if there was one. If two groups ran into each
 * other, the one with the smaller index keeps its layout, and both are examined again, together. known: the pieces of
 * the two bodies show what failed; a group that contains both is then not to try a layout without slack again. */
static void put_back_either(taking *t, uint32_t a, uint32_t b, bool known, bool *any)
{
    const uint32_t p = t->solver->model.body_of[a], q = t->solver->model.body_of[b], i = t->by[p], j = t->by[q];
    const sunder_i_group *group = t->solver->groups.group;
    if (i == SUNDER_I_NOBODY && j == SUNDER_I_NOBODY) return;
    const bool both = i != j && i != SUNDER_I_NOBODY && j != SUNDER_I_NOBODY && sunder_i_group_is_cheaper(&group[i]) &&
                      sunder_i_group_is_cheaper(&group[j]);
    if (!both || i > j) *any = put_back(t, i, known && i != SUNDER_I_NOBODY && takes_part(&group[i], q)) || *any;
    if (!both || j > i) *any = put_back(t, j, known && j != SUNDER_I_NOBODY && takes_part(&group[j], p)) || *any;
}

/* Notes two groups, by bodies of theirs, that one proof has to treat together. False if memory is out. */
bool sunder_i_groups_join(sunder_i_groups *groups, uint32_t one, uint32_t other)
{
    if (!sunder_i_reserve(&groups->joined, &groups->capacity, groups->joins + 1, sizeof *groups->joined)) return false;
    groups->joined[groups->joins++] = (sunder_i_id_pair){one, other};
    return true;
}

/* Undoes the new layouts of features a and b, one of which jumped over the other; *any if there was one. Their pieces
 * may not show the jump: an anchor that moves along a diagonal between two pieces meets neither. So both bodies use the
 * pieces that cover their diagonals from now on (layer/diagonal_covers.c). The feature that was jumped over may be far
 * away now, so the two groups are joined. False if memory is out. */
static bool put_back_jump(taking *t, uint32_t a, uint32_t b, bool *any)
{
    sunder_i_groups *groups = &t->solver->groups;
    const uint32_t body[2] = {t->solver->model.body_of[a], t->solver->model.body_of[b]};
    const uint32_t group[2] = {groups->of[body[0]], groups->of[body[1]]};
    sunder_i_body_states *states = &t->solver->states;
    const unsigned char *diagonals = states->of[SUNDER_I_DIAGONALS];
    const bool known = diagonals[body[0]] && diagonals[body[1]];
    for (int k = 0; k < 2; k++) sunder_i_body_event(states, body[k], SUNDER_I_JUMPS_IN_PROOF);
    groups->with_diagonals = true;
    put_back_either(t, a, b, known, any);
    return group[0] == group[1] || group[0] == SUNDER_I_NOBODY || group[1] == SUNDER_I_NOBODY ||
           sunder_i_groups_join(groups, group[0], group[1]);
}

static bool has_moved(const taking *t, uint32_t thing)
{
    return t->by[t->solver->model.body_of[thing]] != SUNDER_I_NOBODY;
}

/* Has feature a or b returned since pairs were related? Then their pair may be in order again. */
static bool is_outdated(const sunder_i_solver *s, uint32_t a, uint32_t b)
{
    return s->changes.is[a] || s->changes.is[b];
}

/* Is the pair in conflict, with a feature that moved? *may_stay: the conflict was listed before, and no overlap has
 * come back. */
static bool is_in_question(const taking *t, const sunder_i_relation *r, bool *may_stay)
{
    sunder_i_solver *s = t->solver;
    const sunder_i_waived waived = {.pair = s->groups.waived, .n = s->groups.waived_n};
    if (!sunder_i_is_conflict_of_bodies(&s->model, r) || (!has_moved(t, r->a) && !has_moved(t, r->b))) return false;
    const sunder_i_waiver *waiver = sunder_i_waiver_of(&s->model, &waived, r->a, r->b);
    *may_stay = waiver && (!r->overlap || waiver->overlap);
    return true;
}

/* Finds the first listed pair that is worse than at the start, and repairs the effect of rounding, or undoes the layout
 * of the group. *any if there was such a pair. */
static sunder_status mend_first(taking *t, bool *any, sunder_error *err)
{
    sunder_i_solver *s = t->solver;
    sunder_status status = SUNDER_OK;
    const sunder_i_relation from = {.a = t->mended.a, .b = t->mended.b};
    size_t k = sunder_i_lower_bound(&from, s->now.pair, s->now.n, sizeof from, sunder_i_by_id_pair);
    for (; k < s->now.n && !status && !*any; k++) {
        const sunder_i_relation r = s->now.pair[k];
        bool may_stay, worse = false;
        if (is_in_question(t, &r, &may_stay) && may_stay) status = sunder_i_solver_is_worse(s, &r, &worse, err);
        if (status || !worse) continue;
        status = sunder_i_solver_mend(s, &r, t->budget, any, err);
        t->mended = *any ? (sunder_i_id_pair){r.a, r.b} : (sunder_i_id_pair){0, 0};
        if (!status && !*any) put_back_either(t, r.a, r.b, true, any);
    }
    return status;
}

/* Undoes the layouts that led to a new conflict, a deeper one, or a jump; *any if there were any. Pairs that are
 * slightly worse are repaired only when no layout is undone, so that other parts of the layer do not influence the
 * repair. */
static sunder_status put_back_offenders(taking *t, bool *any, sunder_error *err)
{
    sunder_i_solver *s = t->solver;
    sunder_status status = SUNDER_OK;
    *any = false;
    sunder_i_changes_clear(&s->changes);
    for (size_t k = 0; k < s->now.n; k++) {
        const sunder_i_relation *r = &s->now.pair[k];
        bool may_stay;
        if (!is_outdated(s, r->a, r->b) && is_in_question(t, r, &may_stay) && !may_stay)
            put_back_either(t, r->a, r->b, true, any);
    }
    for (size_t k = 0; k < s->jumps.n && !status; k++) {
        const sunder_i_id_pair *p = &s->jumps.pair[k];
        if (!is_outdated(s, p->a, p->b) && !put_back_jump(t, p->a, p->b, any)) status = sunder_i_failure_cause(err);
    }
    if (*any) t->mended = (sunder_i_id_pair){0, 0};
    return status || *any ? status : mend_first(t, any, err);
}

/* Uses the cheaper layouts that pass the exact check. Sets groups.unproved if groups should be proved once more. */
static sunder_status take_over(sunder_i_solver *s, sunder_error *err)
{
    const size_t n = s->model.bodies;
    taking t = {s,
                sunder_i_alloc(n, sizeof *t.by),
                sunder_i_alloc(2 * n, sizeof *t.before),
                sunder_i_solver_patience(s),
                {0, 0}};
    sunder_status status = t.by && t.before && t.budget ? SUNDER_OK : sunder_i_failure_cause(err);
    bool again = false;
    if (!status) {
        for (size_t b = 0; b < n; b++) t.by[b] = SUNDER_I_NOBODY;
        sunder_i_changes_clear(&s->changes);
        for (size_t k = 0; k < s->groups.n; k++) {
            if (!sunder_i_group_is_cheaper(&s->groups.group[k])) continue;
            place_group(&t, k, false);
            if (!is_exact(&s->model, &s->groups.group[k])) put_back(&t, (uint32_t)k, true);
            again = true;
        }
    }
    while (!status && again) {
        status = sunder_i_solver_relate(s, err);
        if (!status) status = put_back_offenders(&t, &again, err);
    }
    for (size_t k = 0; !status && k < s->groups.n; k++) {
        sunder_i_group *g = &s->groups.group[k];
        s->groups.unproved = s->groups.unproved || (is_group_wanted(s, g) && g->state != SUNDER_I_IS_PROVED);
        /* A group of which nothing is proved yet was only perturbed; its proof follows in the next round. */
        if (sunder_i_group_is_cheaper(g)) g->state = g->bound > 0 ? SUNDER_I_IS_PROVED : SUNDER_I_TO_BE_PROVED;
    }
    sunder_i_free_all(t.budget, t.by, t.before);
    return status;
}

/* Joins groups where one is in the way of the other's cheaper layout, or that have a common guest. Sets groups.unproved
 * if there are such. */
static sunder_status join_groups(sunder_i_solver *s, sunder_error *err)
{
    sunder_i_groups *groups = &s->groups;
    bool ok = true;
    uint32_t *host = sunder_i_alloc(s->model.bodies, sizeof *host);
    groups->unproved = false;
    for (size_t b = 0; host && b < s->model.bodies; b++) host[b] = groups->of[b];
    for (size_t k = 0; k < groups->n && host && ok; k++) {
        sunder_i_group *g = &groups->group[k];
        bool joined = false;
        for (size_t m = 0; m < g->joins.n + g->guests.n && ok && is_group_wanted(s, g); m++) {
            const uint32_t b = m < g->joins.n ? g->joins.item[m] : g->guests.item[m - g->joins.n];
            if (s->model.body[b].fixed || host[b] == g->number) continue;
            if (host[b] == SUNDER_I_NOBODY) {
                host[b] = g->number;
                continue;
            }
            ok = sunder_i_groups_join(groups, g->number, host[b]);
            groups->unproved = joined = true;
        }
        /* A body in no group does not make the proof incomplete. */
        if (!joined) g->joins.n = 0;
    }
    ok = ok && host;
    sunder_i_free(host);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

static sunder_status prove_each(sunder_i_solver *s, sunder_error *err)
{
    const sunder_i_groups *groups = &s->groups;
    size_t *size = sunder_i_alloc(groups->n, sizeof *size);
    if (!size) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < groups->n; k++) size[k] = groups->group[k].n;
    const sunder_status status =
        sunder_i_parallel_largest_first(s->model.rules.threads, size, groups->n, prove_groups, s, err);
    sunder_i_free(size);
    return status;
}

static sunder_status trace_groups(sunder_i_solver *s, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < s->groups.n && sunder_i_is_traced(&s->model) && !status; k++) {
        sunder_i_group *g = &s->groups.group[k];
        status = sunder_i_trace_log_emit(&s->model, "group", &g->log, g->body, g->n, err);
    }
    return status;
}

static sunder_status prove_all(sunder_i_solver *s, sunder_error *err)
{
    hold_pinned_groups(s);
    sunder_status status = prove_each(s, err);
    if (!status) status = trace_groups(s, err);
    if (!status) charge_bodies(s);
    return status;
}

static bool has_diagonals(sunder_i_solver *s) { return s->groups.with_diagonals; }

static sunder_status cover_diagonals(sunder_i_solver *s, sunder_error *err)
{
    return sunder_i_model_cover_diagonals(&s->model, err);
}

static bool has_unproved(sunder_i_solver *s) { return s->groups.unproved; }

static const sunder_i_layer_stage optimising[] = {
    {"cover diagonals", has_diagonals, cover_diagonals, 1, 0, 0},
    {"prove", NULL, prove_all, 1, 0, 0},
    {"join groups", NULL, join_groups, 1, 0, 0},
    {"take over", NULL, take_over, 1, 0, 0},
    {"list waivers", has_unproved, sunder_i_solver_list_waivers, 1, 0, 0},
    {"gather groups", has_unproved, sunder_i_solver_gather_groups, 1, 0, 0},
};

static const sunder_i_layer_table table = {"optimise", SUNDER_I_TABLE_OF_STEPS, optimising,
                                           sizeof optimising / sizeof *optimising, NULL};

sunder_status sunder_i_solver_optimise(sunder_i_solver *solver, sunder_error *err)
{
    if (!(solver->model.rules.effort > 0)) return SUNDER_OK;
    sunder_status status = sunder_i_solver_list_waivers(solver, err);
    if (!status) status = sunder_i_solver_gather_groups(solver, err);
    solver->groups.unproved = true;
    for (int round = 0; round < OPTIMISED && solver->groups.unproved && !status; round++)
        status = sunder_i_solver_run_stages(solver, &table, 0, 0, err);
    return status;
}
