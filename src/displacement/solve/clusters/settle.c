/* The rounds: clusters are solved, their moves checked exactly, and what is found makes work for the next round. The
 * order of the steps of a round is a table.
 *
 * No edge is removed meanwhile. So each round adds an edge between clusters, or takes a pair of one inside the other a
 * state further (layer/inclusion.h), or widens the margin of a cluster whose result failed the exact check (a limited
 * number of times), or is the last: the loop ends. */
#include "displacement/layer/resolution.h"
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/layer_stages.h"
#include "displacement/solve/clusters/tuning.h"

#include "base/union_find.h"

static bool is_due(const sunder_i_solver *s, const sunder_i_cluster *c)
{
    for (size_t k = 0; k < c->n; k++)
        if (sunder_i_is_due(s, c->body[k])) return true;
    return false;
}

static sunder_status solve_cluster(const sunder_i_solver *s, sunder_i_cluster *c, double *move, void *context,
                                   sunder_error *err)
{
    (void)context;
    return sunder_i_cluster_solve(&s->model, c, move, err);
}

/* Notes that the bodies of solved clusters have to be improved again, and keeps measured pairs for the report. From now
 * on bodies start from their own moves. */
static sunder_status note_solved(sunder_i_solver *s, sunder_error *err)
{
    for (size_t k = 0; k < s->clusters; k++) {
        const sunder_i_cluster *c = &s->cluster[k];
        if (c->outcome == SUNDER_I_UNTOUCHED) continue;
        const sunder_i_body_event_kind event =
            c->outcome == SUNDER_I_FOUND_CHEAPEST ? SUNDER_I_IS_SOLVED_CHEAPEST : SUNDER_I_IS_SOLVED;
        for (size_t m = 0; m < c->n; m++) {
            sunder_i_body_event(&s->states, c->body[m], event);
            if (c->starts_from_areas) s->crowd_size[c->body[m]] = (uint32_t)c->n;
        }
        if (!(c->measured.least > 0)) continue;
        if (!sunder_i_reserve(&s->measured, &s->measured_capacity, s->measured_n + 1, sizeof *s->measured))
            return sunder_i_failure_cause(err);
        s->measured[s->measured_n++] = c->measured;
    }
    for (size_t k = 0; k < s->members; k++) s->carrier[s->body[k]] = SUNDER_I_NOBODY;
    return SUNDER_OK;
}

/* An inner body that has not moved yet may be cut by the edge of its holder, which has. Then it starts from where the
 * holder would carry it, so that the cluster starts without that conflict. */
static void carry_inner_body(sunder_i_solver *s, uint32_t f, uint32_t g)
{
    const sunder_i_model *model = &s->model;
    sunder_i_inclusion_state state;
    for (int e = 0; e < 2; e++) {
        const uint32_t holder = model->body_of[e ? g : f], inner = model->body_of[e ? f : g];
        const double *t = model->move + 2 * (size_t)holder, *own = model->move + 2 * (size_t)inner;
        if (sunder_i_keeps_inside(model, e ? g : f, e ? f : g, &state) && own[0] == 0 && own[1] == 0 &&
            sunder_i_may_move(&model->body[inner]) && sunder_i_is_within_limit(t, model->body[inner].limit))
            s->carrier[inner] = holder;
    }
}

static void mark_due(sunder_i_solver *s, uint32_t b)
{
    s->unsettled = true;
    if (!s->model.body[b].fixed) sunder_i_body_event(&s->states, b, SUNDER_I_MEETS_CONFLICT);
}

/* Adds the edge (i, j); the cluster that bodies i and j are in then is solved in the next round. False if memory is
 * out. */
static bool solve_together(sunder_i_solver *s, uint32_t i, uint32_t j)
{
    mark_due(s, i);
    mark_due(s, j);
    return sunder_i_solver_add_edge(s, i, j);
}

/* Are bodies i and j in one cluster? For a fixed body the answer is that of the last gathering: edges added since then
 * do not count, and may be added again. */
static bool are_together(const sunder_i_solver *s, uint32_t i, uint32_t j)
{
    const bool fixed = s->model.body[i].fixed || s->model.body[j].fixed;
    if (!fixed) return sunder_i_union_find(s->parent, i) == sunder_i_union_find(s->parent, j);
    const uint32_t still = s->model.body[i].fixed ? i : j, other = still == i ? j : i;
    return sunder_i_solver_has_member(s, sunder_i_union_find(s->parent, other), still);
}

/* A relaxed pair r of two clusters affects neither of them, unless it is worse than at the start: then they become
 * one. */
static sunder_status heed_relaxation(sunder_i_solver *s, const sunder_i_relation *r, sunder_error *err)
{
    const uint32_t i = s->model.body_of[r->a], j = s->model.body_of[r->b];
    bool worse;
    if (are_together(s, i, j)) return SUNDER_OK;
    const sunder_status status = sunder_i_solver_is_worse(s, r, &worse, err);
    if (status || !worse) return status;
    sunder_i_trace_pair(&s->model, "check", "left in conflict, and worse than at the start: solved together", r->a,
                        r->b);
    return solve_together(s, i, j) ? SUNDER_OK : sunder_i_failure_cause(err);
}

/* Features a and c are in conflict, or one jumped over the other, though they are in one cluster, whose solution should
 * have prevented that: rounding spoiled it. The cluster is solved again with a wider margin, unless its margin has
 * grown MOST_MARGINS times. */
static void widen_margin(sunder_i_solver *s, uint32_t a, uint32_t c)
{
    const uint32_t i = s->model.body_of[a], j = s->model.body_of[c];
    const uint32_t b = s->model.body[i].fixed ? j : i;
    if (s->widened[b] >= MOST_MARGINS) return;
    if (sunder_i_is_due(s, b) && s->widened[b]) return; /* at most once a round */
    s->widened[b]++;
    mark_due(s, b);
    sunder_i_trace_pair(&s->model, "check", "in conflict within its cluster: solved with a wider margin", a, c);
}

/* If a body jumped over a body of another cluster, the two clusters become one; a jump within a cluster widens its
 * margin. */
static sunder_status find_jumps(sunder_i_solver *s, sunder_error *err)
{
    const sunder_i_model *model = &s->model;
    for (size_t k = 0; k < s->jumps.n; k++) {
        const uint32_t i = model->body_of[s->jumps.pair[k].a], j = model->body_of[s->jumps.pair[k].b];
        if (sunder_i_is_aside(s, i) || sunder_i_is_aside(s, j)) continue;
        if (are_together(s, i, j)) {
            widen_margin(s, s->jumps.pair[k].a, s->jumps.pair[k].b);
            continue;
        }
        if (!solve_together(s, i, j)) return sunder_i_failure_cause(err);
        sunder_i_trace_pair(model, "check", "jumped over: solved together from now on", s->jumps.pair[k].a,
                            s->jumps.pair[k].b);
    }
    return SUNDER_OK;
}

/* Examines the present conflicts and marks bodies as due: two clusters with a conflict become one, and a conflict
 * within a cluster widens its margin. Sets s->unsettled if there is work for another round. */
static sunder_status find_work(sunder_i_solver *s, sunder_error *err)
{
    sunder_i_model *model = &s->model;
    s->unsettled = false;
    sunder_i_solver_hold_coarse(s);
    for (size_t k = 0; k < s->now.n; k++) {
        const sunder_i_relation *r = &s->now.pair[k];
        const uint32_t i = model->body_of[r->a], j = model->body_of[r->b];
        if (sunder_i_is_aside(s, i) || sunder_i_is_aside(s, j)) continue;
        if (!sunder_i_is_conflict(r) || i == j) continue;
        if (!sunder_i_may_move(&model->body[i]) && !sunder_i_may_move(&model->body[j])) continue;
        if (sunder_i_relaxations_find(&model->relaxations, r->a, r->b)) {
            const sunder_status status = heed_relaxation(s, r, err);
            if (status) return status;
            continue;
        }
        if (!are_together(s, i, j)) {
            if (!solve_together(s, i, j)) return sunder_i_failure_cause(err);
            sunder_i_trace_pair(model, "check", "in conflict: solved together from now on", r->a, r->b);
            carry_inner_body(s, r->a, r->b);
            continue;
        }
        const uint32_t b = model->body[i].fixed ? j : i;
        /* A feature that lay in the other one at the start was not kept inside. */
        sunder_i_inclusion *inclusion = sunder_i_inclusion_find(model, r->a, r->b);
        if (inclusion && inclusion->state != SUNDER_I_LAPSED) {
            inclusion->state++;
            sunder_i_trace_pair(model, "check", "not kept inside", r->a, r->b);
            mark_due(s, b);
            continue;
        }
        widen_margin(s, r->a, r->b);
    }
    return find_jumps(s, err);
}

/* ---- A round ----------------------------------------------------------------------------------------------------- */

static bool is_hopeless(const sunder_i_solver *s)
{
    for (size_t k = 0; k < s->clusters; k++)
        if (s->cluster[k].outcome == SUNDER_I_FOUND_NONE) return true;
    return false;
}

static sunder_status solve_all(sunder_i_solver *s, sunder_error *err)
{
    sunder_status status = sunder_i_solver_for_clusters(s, is_due, solve_cluster, NULL, err);
    if (!status) status = sunder_i_solver_trace_clusters(s, err);
    s->hopeless = !status && is_hopeless(s);
    return status;
}

static bool has_hope(sunder_i_solver *s) { return !s->hopeless; }

static sunder_status commit_moves(sunder_i_solver *s, sunder_error *err)
{
    sunder_i_pieces_forget(&s->model, SUNDER_I_PIECES_HELD);
    return sunder_i_solver_commit(s, err);
}

static const sunder_i_layer_stage settling[] = {
    {"gather", NULL, sunder_i_solver_gather, 1, 0, 0},
    {"unite blocks", NULL, sunder_i_solver_unite_blocks, 1, 0, 0},
    {"grow crowds", NULL, sunder_i_solver_grow_crowds, 1, 0, 0},
    {"solve", NULL, solve_all, 1, 0, 0},
    {"commit", has_hope, commit_moves, 1, 0, 0},
    {"note solved", has_hope, note_solved, 1, 0, 0},
    {"take relaxations", has_hope, sunder_i_solver_take_relaxations, 1, 0, 0},
    {"relate", has_hope, sunder_i_solver_relate, 1, 0, 0},
    {"set far aside", has_hope, sunder_i_solver_set_far_aside, 1, 0, 0},
    {"find work", has_hope, find_work, 1, 0, 0},
};

static const sunder_i_layer_table table = {"settle", SUNDER_I_TABLE_OF_STEPS, settling,
                                           sizeof settling / sizeof *settling, NULL};

sunder_status sunder_i_solver_settle(sunder_i_solver *solver, double from, double to, sunder_error *err)
{
    sunder_status status = find_work(solver, err);
    for (size_t round = 0; !status && solver->unsettled && has_hope(solver); round++) {
        if (!sunder_i_progress(&solver->model.rules,
                               from + (to - from) * (1 - 1 / (1 + SHARE_OF_ROUND * (double)round))))
            return sunder_i_cancelled(err);
        status = sunder_i_solver_run_stages(solver, &table, from, to, err);
    }
    return status;
}
