/* Nothing is made worse: the rule for pairs that stay in conflict, exactly, for the features as they will be written.
 *
 * The search keeps relaxations (relaxation.c) up to its own rounding, and moves are rounded to doubles; so a pair may
 * stand worse by a unit in the last place. Such pairs are repaired one by one, while the rest keeps its solution. These
 * remedies are tried in turn:
 *
 *     - one of the pair's bodies moves by a unit or a few, or gets the other's move, or one coordinate of it; or all
 *       bodies with nearly the same move get exactly one move, or one coordinate of it: if nothing is in the way there;
 *     - the search finds places nearby for the pair and the bodies around it that leave a margin
 *       (../search/pair_margin.c);
 *     - if there are none (a slanted corridor of exact width has none), the body with the cheaper move is pinned to its
 *       original place. Its neighbours are solved again around it, and pairs that have no solution then are given up.
 *       Other pairs of the same cluster wait until that is done: the pinned body is in their way meanwhile, and their
 *       bodies need not be pinned as well. In a cluster of thousands, which takes long to settle, only pairs with one
 *       of these two bodies wait.
 *
 * A place that is taken breaks the rule for no pair, a pinned body stays pinned, and with all bodies in their original
 * places nothing stands worse: the loop ends. */
#include "displacement/layer/barrier_pairs.h"
#include "displacement/layer/reads.h"
#include "displacement/layer/rounding.h"
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/trial.h"
#include "displacement/solve/clusters/tuning.h"

#include "base/extremes.h"
#include "base/union_find.h"
#include "separation/separation.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* ---- A place nearby ---------------------------------------------------------------------------------------------- */

/* The units by which the body's present move can change. */
static void units_of(const sunder_i_solver *s, uint32_t b, double unit[2])
{
    const double *stood = s->model.move + 2 * (size_t)b;
    double same[2];
    for (int c = 0; c < 2; c++) {
        /* A move of 0 has no unit, so the unit is that of a tiny move. */
        double along[2] = {0, 0};
        along[c] = stood[c] != 0 ? stood[c] : DBL_MIN;
        sunder_i_round_move(&s->model, b, along, same, &unit[c]);
    }
}

/* Tries the eight positions one unit away, then four and ALIKE units away, since the error of the search is about as
 * large. */
static sunder_status try_nearby(sunder_i_trial *t, sunder_error *err)
{
    const double stood[2] = {t->stood[0], t->stood[1]};
    double unit[2];
    sunder_status status = SUNDER_OK;
    units_of(t->solver, t->body[0], unit);
    t->well = false;
    for (int step = 1; step <= ALIKE && !t->well && !status; step *= 4)
        for (int k = 0; k < 9 && !t->well && !status; k++) {
            const double to[2] = {stood[0] + step * (k % 3 - 1) * unit[0], stood[1] + step * (k / 3 - 1) * unit[1]};
            if (k != 4) status = sunder_i_trial_place(t, to, err);
        }
    return status;
}

/* ---- All that move as one ---------------------------------------------------------------------------------------- */

/* Do bodies b and `other` have the same move up to `hair`, in the coordinates that the trial changes? */
static bool is_alike(const sunder_i_trial *t, uint32_t b, uint32_t other, double hair)
{
    const double *p = t->solver->model.move + 2 * (size_t)b, *q = t->solver->model.move + 2 * (size_t)other;
    for (unsigned c = 0; c < 2; c++)
        if ((t->along >> c & 1) && !(fabs(p[c] - q[c]) <= hair)) return false;
    return true;
}

/* Adds to the trial the bodies around body b that have the same move. */
static sunder_status take_bodies_alike(sunder_i_trial *t, uint32_t b, double hair, sunder_error *err)
{
    const sunder_i_model *model = &t->solver->model;
    const sunder_i_body *p = &model->body[b];
    for (uint32_t m = 0; m < p->members; m++) {
        const uint32_t f = model->member[p->member + m];
        double box[4];
        if (!model->present[f]) continue;
        sunder_i_box_grow(sunder_i_rtree_box(&t->solver->placement.tree, f), model->rules.gap, box);
        t->near.n = 0;
        sunder_i_reading reading;
        sunder_i_reads_begin(&reading, model, b);
        const bool ok = sunder_i_look_about(model, &t->solver->placement.tree, box, &t->near);
        sunder_i_reads_end(&reading);
        if (!ok) return sunder_i_failure_cause(err);
        for (size_t k = 0; k < t->near.n; k++) {
            const uint32_t other = model->body_of[t->near.item[k]];
            if (t->taken[other] || !sunder_i_may_move(&t->solver->model.body[other]) || !is_alike(t, b, other, hair))
                continue;
            if (!sunder_i_trial_take(t, other)) return sunder_i_failure_cause(err);
            t->taken[other] = true;
        }
    }
    return SUNDER_OK;
}

/* In a pushed row no body may come nearer to the next, so the row has to move as one to the last bit. All its bodies
 * get the move of the body with the coarsest coordinates. */
static sunder_status try_common_move(sunder_i_trial *t, sunder_error *err)
{
    double coarsest = 0, to[2] = {0, 0};
    sunder_status status = SUNDER_OK;
    if (!t->taken) t->taken = sunder_i_calloc(t->solver->model.bodies, sizeof *t->taken);
    if (!t->taken) return sunder_i_failure_cause(err);
    t->taken[t->body[0]] = true;
    for (size_t k = 0; k < t->n && t->n <= *t->budget && !status; k++) {
        double unit[2];
        units_of(t->solver, t->body[k], unit);
        const double coarse = sunder_i_max(unit[0], unit[1]);
        if (coarse > coarsest) {
            coarsest = coarse;
            memcpy(to, t->stood + 2 * k, sizeof to);
        }
        status = take_bodies_alike(t, t->body[k], ALIKE * coarsest, err);
    }
    for (size_t k = 0; k < t->n; k++) t->taken[t->body[k]] = false;
    t->well = false;
    if (!status && t->n <= *t->budget) status = sunder_i_trial_place(t, to, err);
    if (!t->well) *t->budget -= t->n < *t->budget ? t->n : *t->budget;
    return status;
}

/* The remedies for a pair, the smallest change first, with the coordinates that change: bit 0 is x, bit 1 is y. */
typedef enum remedy { NEARBY, PARTNER, TOGETHER } remedy;
static const struct {
    remedy remedy;
    unsigned along;
} remedies[] = {{NEARBY, 3}, {PARTNER, 3}, {PARTNER, 1}, {PARTNER, 2}, {TOGETHER, 3}, {TOGETHER, 1}, {TOGETHER, 2}};

size_t *sunder_i_solver_patience(const sunder_i_solver *solver)
{
    size_t *budget = sunder_i_alloc(solver->model.bodies, sizeof *budget);
    for (size_t b = 0; b < solver->model.bodies && budget; b++) budget[b] = IN_VAIN;
    return budget;
}

sunder_status sunder_i_solver_mend(sunder_i_solver *solver, const sunder_i_relation *r, size_t *budget, bool *well,
                                   sunder_error *err)
{
    const uint32_t pair[2] = {solver->model.body_of[r->a], solver->model.body_of[r->b]};
    sunder_i_trial t = {.solver = solver};
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < sizeof remedies / sizeof *remedies && !t.well && !status; k++)
        for (int e = 0; e < 2 && !t.well && !status; e++) {
            const double *other = solver->model.move + 2 * (size_t)pair[1 - e], to[2] = {other[0], other[1]};
            t.n = 0;
            t.along = remedies[k].along;
            if (!sunder_i_may_move(&solver->model.body[pair[e]])) continue;
            t.budget = &budget[sunder_i_union_find(solver->parent, pair[e])];
            if (!sunder_i_trial_take(&t, pair[e])) status = sunder_i_failure_cause(err);
            if (!status && remedies[k].remedy == NEARBY) status = try_nearby(&t, err);
            if (!status && remedies[k].remedy == PARTNER) status = sunder_i_trial_place(&t, to, err);
            if (!status && remedies[k].remedy == TOGETHER) status = try_common_move(&t, err);
        }
    *well = t.well;
    sunder_i_trial_free(&t);
    return status;
}

/* ---- With a margin ----------------------------------------------------------------------------------------------- */

/* Asks the search for places near the present ones at which the pair keeps the margin, too. *well if there are such
 * places and they pass the exact check. */
static sunder_status demand_margin(sunder_i_solver *s, const sunder_i_relation *r, bool others, bool *well,
                                   sunder_error *err)
{
    const uint32_t i = s->model.body_of[r->a], j = s->model.body_of[r->b];
    sunder_i_trial t = {.solver = s};
    *well = false;
    sunder_status status = sunder_i_solver_gather(s, err);
    if (!status) status = sunder_i_solver_unite_blocks(s, err);
    const sunder_i_cluster *c =
        status ? NULL : sunder_i_solver_cluster_of(s, sunder_i_may_move(&s->model.body[i]) ? i : j);
    if (!c) return status;
    const double none[2] = {0, 0};
    double *move = sunder_i_solver_load_moves(s, c);
    bool done;
    status = sunder_i_cluster_demand_margin(&s->model, c, r->a, r->b, others, move, &done, err);
    if (!status && done && !sunder_i_trial_take_moved(&t, c, move)) status = sunder_i_failure_cause(err);
    if (!status && done) status = sunder_i_trial_place(&t, none, err);
    *well = t.well;
    sunder_i_trial_free(&t);
    return status;
}

/* ---- Staying ----------------------------------------------------------------------------------------------------- */

static double cost_of(const sunder_i_solver *s, uint32_t b)
{
    return sunder_i_move_cost(&s->model, b, s->model.move + 2 * (size_t)b);
}

/* Pins body i or j to its original place: the one that can move; if both can, the one with the cheaper move, unless
 * that one has not moved at all. */
static sunder_status pin_either(sunder_i_solver *s, uint32_t i, uint32_t j, sunder_error *err)
{
    const double home[2] = {0, 0};
    const bool may_i = sunder_i_may_move(&s->model.body[i]), may_j = sunder_i_may_move(&s->model.body[j]);
    uint32_t b = may_i ? i : j;
    if (may_i && may_j && cost_of(s, j) < cost_of(s, i)) b = j;
    if (may_i && may_j && cost_of(s, b) == 0) b = b == i ? j : i;
    sunder_i_changes_clear(&s->changes);
    sunder_i_solver_place(s, b, home);
    const sunder_status status = sunder_i_solver_relate(s, err);
    s->model.body[b].pinned = true;
    return status;
}

/* Pins bodies that still jump over others, since no margin repaired the effect of rounding. */
static sunder_status pin_jumps(sunder_i_solver *s, bool *pinned, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    while (s->jumps.n && !status) {
        *pinned = true;
        status = pin_either(s, s->model.body_of[s->jumps.pair[0].a], s->model.body_of[s->jumps.pair[0].b], err);
    }
    return status;
}

/* The pairs that wait until clusters have settled, and the failed attempts of each cluster. */
typedef struct waiting {
    bool *body, *cluster; /* [bodies] pairs with this body wait; [bodies] by roots: pairs with any body of the cluster
                           * wait */
    size_t *vain;         /* [bodies] by roots: summed sizes of clusters for which a margin was demanded without
                           * success */
    uint32_t *size;       /* [bodies] by roots at the beginning of the pass: size of the cluster */
} waiting;

static bool waiting_init(waiting *w, size_t bodies)
{
    w->body = sunder_i_alloc(bodies, sizeof *w->body);
    w->cluster = sunder_i_alloc(bodies, sizeof *w->cluster);
    w->vain = sunder_i_calloc(bodies, sizeof *w->vain);
    w->size = sunder_i_alloc(bodies, sizeof *w->size);
    return w->body && w->cluster && w->vain && w->size;
}

static void waiting_free(waiting *w) { sunder_i_free_all(w->body, w->cluster, w->vain, w->size); }

/* Begins a pass: no pair waits. */
static void begin_pass(const sunder_i_solver *s, waiting *w)
{
    const size_t n = s->model.bodies;
    memset(w->body, 0, n * sizeof *w->body);
    memset(w->cluster, 0, n * sizeof *w->cluster);
    memset(w->size, 0, n * sizeof *w->size);
    for (uint32_t b = 0; b < n; b++)
        if (!s->model.body[b].fixed) w->size[sunder_i_union_find(s->parent, b)]++;
}

/* Lets the pairs of a pinned body wait, and those of its whole cluster if that has at most MOST_HELD bodies: the body's
 * neighbours are in its way until the cluster settles. */
static void hold_body(sunder_i_solver *s, waiting *w, uint32_t body)
{
    const uint32_t root = sunder_i_union_find(s->parent, body);
    if (s->model.body[body].fixed) return;
    w->body[body] = true;
    w->cluster[root] = w->cluster[root] || w->size[root] <= MOST_HELD;
}

static bool is_held(const sunder_i_solver *s, const waiting *w, uint32_t body)
{
    return !s->model.body[body].fixed && (w->body[body] || w->cluster[sunder_i_union_find(s->parent, body)]);
}

/* Demands the margin of the pair r and of other pairs left in conflict, and if that fails, of r and those that keep it
 * already. *well if one succeeds. Nothing is tried if too many bodies were involved in failures in this cluster
 * (EASED_IN_VAIN). */
static sunder_status demand_margin_either_way(sunder_i_solver *s, const sunder_i_relation *r, waiting *w, bool *well,
                                              sunder_error *err)
{
    const uint32_t i = s->model.body_of[r->a], j = s->model.body_of[r->b];
    const uint32_t root = sunder_i_union_find(s->parent, s->model.body[i].fixed ? j : i);
    sunder_status status = SUNDER_OK;
    *well = false;
    if (w->vain[root] >= EASED_IN_VAIN) return SUNDER_OK;
    for (int others = 1; others >= 0 && !status && !*well; others--) status = demand_margin(s, r, others, well, err);
    if (!*well) w->vain[root] += w->size[root];
    return status;
}

/* The index of the first pair after `last`. Repairs change the list of pairs, so indices do not persist. */
static size_t first_after(const sunder_i_solver *s, sunder_i_id_pair last)
{
    const sunder_i_relation key = {.a = last.a, .b = last.b};
    const size_t at = sunder_i_lower_bound(&key, s->now.pair, s->now.n, sizeof key, sunder_i_by_id_pair);
    return at < s->now.n && s->now.pair[at].a == last.a && s->now.pair[at].b == last.b ? at + 1 : at;
}

sunder_status sunder_i_solver_uphold(sunder_i_solver *solver, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    size_t *budget = sunder_i_solver_patience(solver);
    waiting held;
    if (!waiting_init(&held, solver->model.bodies) || !budget) status = sunder_i_failure_cause(err);
    for (bool any = solver->now.n + solver->jumps.n > 0, pinned; any && !status;) {
        any = pinned = false;
        begin_pass(solver, &held);
        status = pin_jumps(solver, &pinned, err);
        any = pinned;
        sunder_i_id_pair last = {0, 0}; /* before all pairs */
        for (size_t k; (k = first_after(solver, last)) < solver->now.n && !status;) {
            const sunder_i_relation r = solver->now.pair[k];
            last = (sunder_i_id_pair){r.a, r.b};
            const uint32_t i = solver->model.body_of[r.a], j = solver->model.body_of[r.b];
            bool breaks, well = false;
            status = sunder_i_solver_breaks_rule(solver, &r, &breaks, err);
            if (status || !breaks ||
                (!sunder_i_may_move(&solver->model.body[i]) && !sunder_i_may_move(&solver->model.body[j])))
                continue;
            any = true;
            if (is_held(solver, &held, i) || is_held(solver, &held, j)) continue;
            status = sunder_i_solver_mend(solver, &r, budget, &well, err);
            if (!status && !well) status = demand_margin_either_way(solver, &r, &held, &well, err);
            if (!status)
                sunder_i_trace_pair(&solver->model, "worse than at the start",
                                    well ? "mended" : "one of the two put back", r.a, r.b);
            if (status || well) continue;
            pinned = true;
            status = pin_either(solver, i, j, err);
            hold_body(solver, &held, i);
            hold_body(solver, &held, j);
        }
        if (pinned && !status) status = sunder_i_solver_settle(solver, SOUGHT, SOUGHT, err);
    }
    for (size_t b = 0; b < solver->model.bodies; b++) solver->model.body[b].pinned = false;
    waiting_free(&held);
    sunder_i_free(budget);
    return status;
}
