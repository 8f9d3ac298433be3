/* Exact fits: pairs that limits allow to keep exactly the distance required, and no more. An example is a row between a
 * wall and the limit of its last body.
 *
 * The search demands a margin beyond the distance owed, to cover rounding, and there is no room for it here: it gives
 * such pairs up. But where coordinates and distances are multiples of a step that is coarse compared with rounding, the
 * fit has its places on that lattice, and doubles represent them. So the search is asked for places that miss a little
 * (../search/fit_given_up.c), and these are moved to the lattice (../../prove/optimum/tight_place.c). They are taken if
 * they hold, exactly, and solve the pair. Elsewhere a fit to the last bit would be mere chance. */
#include "displacement/layer/barrier_pairs.h"
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/trial.h"
#include "displacement/solve/clusters/tuning.h"

#include "base/extremes.h"
#include "separation/separation.h"

#include <math.h>
#include <string.h>

/* The bodies that are aligned: movable bodies of the trial, and fixed ones near them. */
typedef struct fitting {
    uint32_t *body; /* ascending */
    double *move;
    size_t n;
} fitting;

static double extent_of(const sunder_i_body *b) { return sunder_i_max(b->box[2] - b->box[0], b->box[3] - b->box[1]); }

/* Is b within `reach` of the new position of a body that the trial moves? */
static bool is_about(const sunder_i_model *model, const sunder_i_trial *t, uint32_t b, double reach)
{
    const double none[2] = {0, 0};
    double box[4], other[4];
    sunder_i_body_box(&model->body[b], none, reach, box);
    for (size_t k = 0; k < t->n; k++) {
        sunder_i_body_box(&model->body[t->body[k]], t->goal + 2 * k, 0, other);
        if (model->body[b].pieces && sunder_i_box_meet(box, other)) return true;
    }
    return false;
}

static bool gather_bodies(const sunder_i_model *model, const sunder_i_cluster *c, const sunder_i_trial *t, double reach,
                          fitting *f)
{
    f->n = 0;
    f->body = sunder_i_alloc(c->n, sizeof *f->body);
    f->move = sunder_i_alloc(2 * c->n, sizeof *f->move);
    for (size_t k = 0, moved = 0; k < c->n && f->body && f->move; k++) {
        const uint32_t b = c->body[k];
        const bool moves = moved < t->n && t->body[moved] == b;
        if (!moves && (!model->body[b].fixed || !is_about(model, t, b, reach))) continue;
        const double *to = moves ? t->goal + 2 * moved : model->move + 2 * (size_t)b;
        memcpy(f->move + 2 * f->n, to, 2 * sizeof *to);
        f->body[f->n++] = b;
        moved += moves;
    }
    return f->body && f->move;
}

/* Aligns the goals of the trial to multiples of the coordinates' common step; *found if there are such places. */
static sunder_status align_to_steps(const sunder_i_model *model, const sunder_i_cluster *c, sunder_i_trial *t,
                                    bool *found, sunder_error *err)
{
    const sunder_i_waived none = {0};
    fitting f;
    double reach = model->rules.gap;
    for (size_t k = 0; k < t->n; k++)
        reach = sunder_i_max(reach, model->rules.gap + extent_of(&model->body[t->body[k]]));
    bool ok = gather_bodies(model, c, t, reach, &f) &&
              sunder_i_tight_place(model, &none, f.body, f.n, c->margin, f.move, found);
    for (size_t k = 0, moved = 0; k < f.n && ok; k++)
        if (moved < t->n && t->body[moved] == f.body[k])
            memcpy(t->goal + 2 * moved++, f.move + 2 * k, 2 * sizeof *f.move);
    sunder_i_free_all(f.body, f.move);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

/* The pair is solved: ends its relaxations, except infeasible ones. */
static sunder_status take_over(sunder_i_solver *s, sunder_i_cluster *c, const sunder_i_id_pair *pair, sunder_error *err)
{
    const sunder_i_relaxations *all = &s->model.relaxations;
    sunder_i_restored *list = sunder_i_alloc(all->n, sizeof *list);
    if (!list) return sunder_i_failure_cause(err);
    sunder_i_free(c->restored);
    c->restored = list;
    c->restored_n = 0;
    for (size_t k = 0; k < all->n; k++) {
        const sunder_i_restored r = sunder_i_restored_of(&s->model, &all->item[k]);
        if (!all->item[k].infeasible && sunder_i_by_id_pair(&r.body, pair) == 0) list[c->restored_n++] = r;
    }
    const sunder_status status = sunder_i_solver_take_relaxations(s, err);
    c->restored_n = 0;
    return status;
}

/* How the places to be aligned are found, in this order. */
typedef enum look { SHARE_LEAST, SEARCH_ABOUT, SEARCH_FROM_HOME, LOOKS } look;

/* The least translation that separates two features, as a move d of g relative to f; *found if it is at most `upper`. A
 * barrier has to be g. */
static sunder_status find_least(const sunder_i_model *model, uint32_t f, uint32_t g, double upper, double d[2],
                                bool *found, sunder_error *err)
{
    const double none[2] = {0, 0};
    sunder_separation least;
    bool beyond;
    const sunder_i_translate home = sunder_i_at_home(model, f);
    const bool beside = sunder_i_is_barrier(model, g);
    const sunder_status status =
        beside ? sunder_i_barrier_least(model, &home, g, sunder_i_owed_above(model, f, g), upper, &least, &beyond, err)
               : sunder_i_separate(sunder_i_thing_shape(model, f), none, sunder_i_thing_shape(model, g), none,
                                   sunder_i_gap_of(model, f, g), upper, &least, &beyond, err);
    if (status) return status;
    *found = !beyond;
    d[0] = beside ? -least.dx : least.dx;
    d[1] = beside ? -least.dy : least.dy;
    sunder_separation_clear(&least);
    return SUNDER_OK;
}

/* If the least translation of two single features uses up both limits: moves each as far as its limit allows. */
static sunder_status share_least(const sunder_i_model *model, const sunder_i_cluster *c, const sunder_i_id_pair *pair,
                                 double *move, bool *found, sunder_error *err)
{
    const sunder_i_body *p = &model->body[pair->a], *q = &model->body[pair->b];
    const uint32_t f = model->member[p->member], g = model->member[q->member];
    const double reach = sunder_i_limit_of(p) + sunder_i_limit_of(q);
    double d[2] = {0, 0};
    *found = false;
    if (p->members != 1 || q->members != 1 || f > g || !(reach < INFINITY)) return SUNDER_OK;
    const sunder_status status = find_least(model, f, g, reach * (1 + FIT_ROOM), d, found, err);
    const double length = hypot(d[0], d[1]);
    *found = !status && *found && length >= reach * (1 - FIT_ROOM);
    for (size_t k = 0; k < c->n && *found; k++)
        for (int x = 0; x < 2; x++) {
            if (c->body[k] == pair->a) move[2 * k + (size_t)x] = -d[x] * (sunder_i_limit_of(p) / reach);
            if (c->body[k] == pair->b) move[2 * k + (size_t)x] = d[x] * (sunder_i_limit_of(q) / reach);
        }
    return status;
}

static sunder_status fit_pair(sunder_i_solver *s, sunder_i_cluster *c, const sunder_i_id_pair *pair, look how,
                              bool *well, sunder_error *err)
{
    const sunder_i_model *model = &s->model;
    const double none[2] = {0, 0},
                 room = FIT_ROOM * sunder_i_min(extent_of(&model->body[pair->a]), extent_of(&model->body[pair->b]));
    sunder_i_trial t = {.solver = s, .parted = pair};
    double *move = sunder_i_solver_load_moves(s, c);
    bool found;
    sunder_status status = how == SHARE_LEAST ? share_least(model, c, pair, move, &found, err)
                                              : sunder_i_cluster_fit(model, c, pair->a, pair->b, room,
                                                                     how == SEARCH_FROM_HOME, move, &found, err);
    if (!status && found && !sunder_i_trial_take_moved(&t, c, move)) status = sunder_i_failure_cause(err);
    if (!status && found) status = align_to_steps(model, c, &t, &found, err);
    if (!status && found) status = sunder_i_trial_place(&t, none, err);
    *well = t.well;
    if (!status && *well) status = take_over(s, c, pair, err);
    sunder_i_trial_free(&t);
    return status;
}

/* *may: is the pair relaxed, within one wanted cluster, and may it fit exactly? */
static sunder_status may_fit(const sunder_i_solver *s, const sunder_i_cluster *c, const sunder_i_id_pair *pair,
                             bool *may, sunder_error *err)
{
    const uint32_t body[2] = {pair->a, pair->b};
    *may = false;
    if (!c || !sunder_i_set_has(c->body, c->n, pair->a) || !sunder_i_set_has(c->body, c->n, pair->b) ||
        !sunder_i_solver_any_of(s, c->body, c->n, sunder_i_is_wanted) ||
        !sunder_i_relaxations_between(&s->model.relaxations, pair->a, pair->b))
        return SUNDER_OK;
    return sunder_i_may_be_tight(&s->model, body, 2, may) ? SUNDER_OK : sunder_i_failure_cause(err);
}

static sunder_status fit_all(sunder_i_solver *s, const sunder_i_id_pair *pair, size_t n, unsigned *in_vain,
                             sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < n && !status; k++) {
        const uint32_t mover = sunder_i_may_move(&s->model.body[pair[k].a]) ? pair[k].a : pair[k].b;
        sunder_i_cluster *c = sunder_i_solver_cluster_of(s, mover);
        bool may, well = false;
        status = may_fit(s, c, &pair[k], &may, err);
        if (status || !may || in_vain[c - s->cluster] == FITS_IN_VAIN) continue;
        for (look how = SHARE_LEAST; how < LOOKS && !well && !status; how++)
            status = fit_pair(s, c, &pair[k], how, &well, err);
        in_vain[c - s->cluster] = well ? 0 : in_vain[c - s->cluster] + 1;
    }
    return status;
}

sunder_status sunder_i_solver_fit_exactly(sunder_i_solver *solver, sunder_error *err)
{
    const size_t n = solver->model.given_up_n;
    if (n == 0) return SUNDER_OK;
    sunder_status status = sunder_i_solver_gather(solver, err);
    if (!status) status = sunder_i_solver_unite_blocks(solver, err);
    unsigned *in_vain = sunder_i_calloc(solver->clusters, sizeof *in_vain);
    sunder_i_id_pair *pair = sunder_i_alloc(n, sizeof *pair);
    if (!status && (!in_vain || !pair)) status = sunder_i_failure_cause(err);
    if (!status) memcpy(pair, solver->model.given_up, n * sizeof *pair);
    if (!status) status = fit_all(solver, pair, n, in_vain, err);
    sunder_i_free_all(in_vain, pair);
    return status;
}
