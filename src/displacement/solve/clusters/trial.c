/* One place for a few bodies, tried exactly; see trial.h. */
#include "displacement/solve/clusters/trial.h"
#include "displacement/layer/resolution.h"
#include "displacement/layer/rounding.h"
#include "displacement/solve/clusters/cluster_stages.h"

#include <string.h>

/* Sets `goal` to the move that body k of the trial gets if the trial moves to `to`. */
static void goal_of(const sunder_i_trial *t, size_t k, const double to[2], double goal[2])
{
    for (unsigned c = 0; c < 2; c++)
        goal[c] = t->goal ? t->goal[2 * k + c] : t->along >> c & 1 ? to[c] : t->stood[2 * k + c];
}

bool sunder_i_trial_take(sunder_i_trial *trial, uint32_t body)
{
    const double *move = trial->solver->model.move + 2 * (size_t)body;
    if (!sunder_i_reserve(&trial->body, &trial->body_capacity, trial->n + 1, sizeof *trial->body) ||
        !sunder_i_reserve(&trial->stood, &trial->stood_capacity, 2 * (trial->n + 1), sizeof *trial->stood))
        return false;
    trial->body[trial->n] = body;
    memcpy(trial->stood + 2 * trial->n++, move, 2 * sizeof *move);
    return true;
}

static bool is_to_be_parted(const sunder_i_trial *t, const sunder_i_relation *r)
{
    const sunder_i_model *model = &t->solver->model;
    const uint32_t i = model->body_of[r->a], j = model->body_of[r->b];
    if (!t->parted || (i < j ? i : j) != t->parted->a || (i < j ? j : i) != t->parted->b) return false;
    const sunder_i_relaxation *held = sunder_i_relaxations_find(&model->relaxations, r->a, r->b);
    return sunder_i_is_conflict(r) && !(held && held->infeasible);
}

/* Was the pair r in conflict before the trial, and in overlap if it overlaps now? A barrier counts as a whole. */
static bool was_in_conflict(const sunder_i_trial *t, const sunder_i_relation *r)
{
    const sunder_i_relations *now = &t->solver->now;
    const sunder_i_relation first = {.a = r->a, .b = sunder_i_whole_of(&t->solver->model, r->b)};
    bool conflict = false, overlap = false;
    for (size_t k = sunder_i_lower_bound(&first, now->pair, now->n, sizeof first, sunder_i_by_id_pair);
         k < now->n && now->pair[k].a == r->a && sunder_i_whole_of(&t->solver->model, now->pair[k].b) == first.b; k++) {
        conflict = conflict || sunder_i_is_conflict(&now->pair[k]);
        overlap = overlap || now->pair[k].overlap;
    }
    return conflict && (overlap || !r->overlap);
}

/* Checks one pair after the move: every conflict has to be an old one, may not overlap unless it did before, and may be
 * no worse than at the start. *on: the check continues. */
static sunder_status check_pair(void *context, const sunder_i_relation *r, bool *on, sunder_error *err)
{
    sunder_i_trial *t = context;
    if (!sunder_i_solver_is_always_listed(t->solver, r)) return SUNDER_OK;
    bool breaks = (!t->from_start && !was_in_conflict(t, r)) || is_to_be_parted(t, r);
    const sunder_status status = breaks ? SUNDER_OK : sunder_i_solver_breaks_rule(t->solver, r, &breaks, err);
    t->well = *on = !breaks;
    if (breaks) t->broken = (sunder_i_id_pair){r->a, r->b};
    return status;
}

/* Two bodies, and whether they are in conflict. */
typedef struct meeting {
    const sunder_i_model *model;
    uint32_t i, j;
    bool conflict;
} meeting;

static sunder_status note_conflict(void *context, const sunder_i_relation *r, bool *on, sunder_error *err)
{
    meeting *m = context;
    const uint32_t i = m->model->body_of[r->a], j = m->model->body_of[r->b];
    (void)err;
    m->conflict = ((i == m->i && j == m->j) || (i == m->j && j == m->i)) && sunder_i_is_conflict(r);
    *on = !m->conflict;
    return SUNDER_OK;
}

/* Checks the neighbours in rows with which body b was left in conflict: if they are in conflict no more, they have to
 * keep the rule of a pair that is solved. */
static sunder_status check_rows(sunder_i_trial *t, uint32_t b, sunder_error *err)
{
    const sunder_i_model *model = &t->solver->model;
    const sunder_i_extras *has = model->body[b].has;
    sunder_status status = SUNDER_OK;
    for (uint32_t k = has->row_side; k < has->row_side + has->row_sides && t->well && !status; k++) {
        const sunder_i_row_side *side = &model->row_side[k];
        meeting m = {model, b, side->other, false};
        if (!sunder_i_relaxations_between(&model->relaxations, b, side->other) ||
            sunder_i_keeps_row(side, model->move + 2 * (size_t)b, model->move + 2 * (size_t)side->other, side->least))
            continue;
        status = sunder_i_placement_visit(model, &t->solver->placement, b, &t->near, note_conflict, &m, err);
        t->well = m.conflict;
        if (!m.conflict)
            t->broken = (sunder_i_id_pair){model->member[model->body[b].member],
                                           model->member[model->body[side->other].member]};
    }
    return status;
}

/* Can each body take its goal exactly and within its limit, and does at least one of them move? */
static bool can_go(const sunder_i_trial *t, const double to[2])
{
    bool any = false;
    for (size_t k = 0; k < t->n; k++) {
        double exact[2], goal[2];
        goal_of(t, k, to, goal);
        any = any || t->stood[2 * k] != goal[0] || t->stood[2 * k + 1] != goal[1];
        if (!sunder_i_is_within_limit(goal, t->solver->model.body[t->body[k]].limit) ||
            !sunder_i_round_move(&t->solver->model, t->body[k], goal, exact, NULL) || exact[0] != goal[0] ||
            exact[1] != goal[1])
            return false;
    }
    return any;
}

/* Moves the bodies of a trial to the goal, or back to their former moves (to: NULL). */
static sunder_status put_bodies(sunder_i_trial *t, const double *to, sunder_error *err)
{
    sunder_i_solver *s = t->solver;
    sunder_status status = SUNDER_OK;
    sunder_i_changes_clear(&s->changes);
    for (size_t k = 0; k < t->n && !status; k++) {
        double goal[2] = {t->stood[2 * k], t->stood[2 * k + 1]};
        if (to) goal_of(t, k, to, goal);
        sunder_i_solver_place(s, t->body[k], goal);
        status = sunder_i_placement_move_body(&s->model, &s->placement, t->body[k], err);
        if (!status) status = sunder_i_jumps_follow(&s->jumps, &s->model, t->body[k], err);
    }
    return status;
}

/* Stores the neighbours of the trial's bodies in the present layout in t->about. False if memory is out. */
static bool note_neighbours(sunder_i_trial *t)
{
    const sunder_i_solver *s = t->solver;
    bool ok = true;
    for (size_t k = 0; k < t->n; k++) {
        const sunder_i_body *body = &s->model.body[t->body[k]];
        for (uint32_t m = 0; m < body->members && ok; m++) {
            const uint32_t f = s->model.member[body->member + m];
            if (s->model.present[f]) ok = sunder_i_placement_near(&s->model, &s->placement, f, &t->about);
        }
    }
    t->about.n = ok ? sunder_i_set_make(t->about.item, t->about.n) : 0;
    return ok;
}

sunder_status sunder_i_trial_place(sunder_i_trial *trial, const double to[2], sunder_error *err)
{
    sunder_i_solver *s = trial->solver;
    trial->well = false;
    if (!can_go(trial, to)) return SUNDER_OK;
    trial->well = true;
    trial->about.n = 0;
    sunder_status status = note_neighbours(trial) ? put_bodies(trial, to, err) : sunder_i_failure_cause(err);
    for (size_t k = 0; k < trial->n && trial->well && !status; k++)
        status =
            sunder_i_placement_visit(&s->model, &s->placement, trial->body[k], &trial->near, check_pair, trial, err);
    for (size_t k = 0; k < trial->n && trial->whole_rows && trial->well && !status; k++)
        status = check_rows(trial, trial->body[k], err);
    for (size_t k = 0; k < trial->n && trial->well && !status; k++) {
        bool jumps;
        status = sunder_i_jumps_of_body(&s->jumps, &s->model, trial->body[k], &trial->near, &jumps, err);
        trial->well = !jumps;
    }
    if (status) return status;
    return trial->well ? sunder_i_solver_relate_near(s, &trial->about, err) : put_bodies(trial, NULL, err);
}

bool sunder_i_trial_take_moved(sunder_i_trial *trial, const sunder_i_cluster *cluster, const double *move)
{
    const sunder_i_solver *s = trial->solver;
    trial->goal = sunder_i_alloc(2 * cluster->n, sizeof *trial->goal);
    for (size_t k = 0; k < cluster->n && trial->goal; k++) {
        const uint32_t b = cluster->body[k];
        if (!sunder_i_may_move(&s->model.body[b]) ||
            memcmp(move + 2 * k, s->model.move + 2 * (size_t)b, 2 * sizeof *move) == 0)
            continue;
        if (!sunder_i_trial_take(trial, b)) return false;
        memcpy(trial->goal + 2 * (trial->n - 1), move + 2 * k, 2 * sizeof *move);
    }
    return trial->goal != NULL;
}

void sunder_i_trial_free(sunder_i_trial *trial)
{
    sunder_i_free_all(trial->body, trial->stood, trial->goal, trial->taken, trial->near.item, trial->about.item);
}
