/* Eases the pairs that are left in conflict, and with a full gap the tight ones, after all other stages: each cluster
 * moves to where the sum of moves, springs and prices (layer/prices.h) is least. An exact check decides on the moves of
 * each cluster: no pair comes into conflict, no conflict becomes an overlap, and none stands worse than at the start.
 *
 * There are two remedies if the check refuses a pair. If it is a pair of two clusters, these become one. If it is one
 * within the cluster, rounding made it a little worse: its bodies are pinned where they stand, and the cluster is eased
 * again. So is a body whose move cannot be exact. Bodies that are in the way of a cluster join it, too, and so do those
 * that it has come nearer to than the full gap. */
#include "base/extremes.h"
#include "base/union_find.h"
#include "displacement/layer/rounding.h"
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/trial.h"
#include "displacement/solve/clusters/tuning.h"

#include <string.h>

/* Relaxes the pairs of members of two bodies that have no relaxation. A relaxation that was changed since it was made
 * stays as it is: of two relaxations of a pair, which one is found would depend on the rest of the list. */
static bool relax_bodies(sunder_i_model *model, uint32_t i, uint32_t j, double reach)
{
    sunder_i_relaxations made = {0};
    bool ok = sunder_i_relaxations_make(model, i, j, reach, &made);
    for (size_t k = 0; k < made.n && ok; k++)
        if (!sunder_i_relaxations_find(&model->relaxations, made.item[k].a, made.item[k].b))
            ok = sunder_i_relaxations_insert(&model->relaxations, model, &made.item[k]);
    sunder_i_relaxations_free(&made);
    return ok;
}

/* Relaxes the pairs that are in conflict without a relaxation: those of two bodies that were both pinned when they were
 * put back (uphold.c). Otherwise their clusters would begin with a clash. */
static sunder_status relax_open_pairs(sunder_i_solver *s, sunder_error *err)
{
    sunder_i_model *model = &s->model;
    bool ok = true;
    for (size_t k = 0; k < s->now.n && ok; k++) {
        const sunder_i_relation *r = &s->now.pair[k];
        const uint32_t pair[2] = {model->body_of[r->a], model->body_of[r->b]};
        if (sunder_i_is_open_conflict(model, r))
            ok = relax_bodies(model, pair[0], pair[1], model->rules.gap + 2 * sunder_i_solver_margin(s, pair, 2));
    }
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

/* Marks the bodies of pairs that may fall short. Their clusters are eased first; later only those that others joined,
 * so that no cluster is eased once more on account of another one. */
static bool mark_short(sunder_i_solver *s)
{
    const sunder_i_relaxations *all = &s->model.relaxations;
    s->to_ease = sunder_i_calloc(s->model.bodies, sizeof *s->to_ease);
    for (size_t k = 0; k < all->relaxed_n && s->to_ease; k++)
        s->to_ease[all->relaxed[k].i] = s->to_ease[all->relaxed[k].j] = true;
    return s->to_ease != NULL;
}

static bool is_to_ease(const sunder_i_solver *s, uint32_t body) { return s->to_ease[body]; }

static bool has_to_ease(const sunder_i_solver *s, const sunder_i_cluster *c)
{
    return sunder_i_solver_any_of(s, c->body, c->n, is_to_ease);
}

/* Joins the two bodies of each relation that is in conflict or tight, if one of the two may move. With a full gap such
 * bodies are marked to be eased: with `all` each of them, else those that were in different clusters. *any: whether any
 * body was. */
static sunder_status join_pairs(sunder_i_solver *s, const sunder_i_relations *relations, bool all, bool *any,
                                sunder_error *err)
{
    const sunder_i_model *model = &s->model;
    *any = false;
    for (size_t k = 0; k < relations->n; k++) {
        const sunder_i_relation *r = &relations->pair[k];
        const uint32_t i = model->body_of[r->a], j = model->body_of[r->b];
        if (!sunder_i_is_conflict_of_bodies(model, r)) continue;
        if (!sunder_i_may_move(&model->body[i]) && !sunder_i_may_move(&model->body[j])) continue;
        const uint32_t mover = model->body[i].fixed ? j : i, other = mover == i ? j : i;
        const bool fresh = all || !sunder_i_solver_has_member(s, sunder_i_union_find(s->parent, mover), other);
        if (fresh && sunder_i_has_slack(model)) *any = s->to_ease[i] = s->to_ease[j] = true;
        if (!sunder_i_solver_add_edge(s, i, j)) return sunder_i_failure_cause(err);
    }
    return sunder_i_solver_gather(s, err);
}

/* Makes a cluster of the bodies that are linked by pairs that lack some of their distance. */
static sunder_status join_short_pairs(sunder_i_solver *s, bool all, bool *any, sunder_error *err)
{
    if (!sunder_i_has_slack(&s->model)) return join_pairs(s, &s->now, all, any, err);
    sunder_i_relations full = {0};
    sunder_status status = sunder_i_placement_relate_fully(&s->model, &s->placement, &full, err);
    if (!status) status = join_pairs(s, &full, all, any, err);
    sunder_i_free(full.pair);
    return status;
}

/* How far bodies of the cluster may go: as far as their limits, or about their size, let them. */
static double farthest_of(const sunder_i_model *model, const sunder_i_cluster *c)
{
    double far = 0;
    for (size_t k = 0; k < c->n; k++) {
        const sunder_i_body *b = &model->body[c->body[k]];
        const double size = sunder_i_max(b->box[2] - b->box[0], b->box[3] - b->box[1]) + model->rules.full_gap;
        if (sunder_i_may_move(b)) far = sunder_i_max(far, sunder_i_min(b->limit, size));
    }
    return far;
}

static sunder_status ease_cluster(const sunder_i_solver *s, sunder_i_cluster *c, double *move, void *context,
                                  sunder_error *err)
{
    bool done;
    double cost;
    (void)context;
    c->about = farthest_of(&s->model, c);
    const sunder_status status = sunder_i_cluster_ease(&s->model, c, move, &cost, &done, err);
    if (done) c->outcome = SUNDER_I_WORKED_ON;
    return status;
}

/* A cluster with pinned bodies is to be eased again. */
static bool has_pinned(const sunder_i_solver *s, const sunder_i_cluster *c)
{
    for (size_t k = 0; k < c->n; k++)
        if (s->model.body[c->body[k]].pinned) return true;
    return false;
}

static void unpin(sunder_i_solver *s, const sunder_i_cluster *c)
{
    for (size_t k = 0; k < c->n; k++) s->model.body[c->body[k]].pinned = false;
}

/* Pins the bodies of a pair of the cluster that the exact check refused, so that the next attempt leaves it as it is.
 * Returns whether one of them was not pinned yet. */
static bool pin_pair(sunder_i_solver *s, uint32_t i, uint32_t j)
{
    bool any = false;
    for (int e = 0; e < 2; e++) {
        sunder_i_body *b = &s->model.body[e ? j : i];
        any = any || sunder_i_may_move(b);
        b->pinned = !b->fixed;
    }
    return any;
}

/* Pins the bodies of the cluster whose eased moves cannot be exact (layer/rounding.h), so that they do not keep the
 * others from moving. Returns whether there are any. */
static bool pin_inexact(sunder_i_solver *s, const sunder_i_cluster *c, const double *move)
{
    bool any = false;
    for (size_t k = 0; k < c->n; k++) {
        sunder_i_body *b = &s->model.body[c->body[k]];
        const double *to = move + 2 * k, *at = s->model.move + 2 * (size_t)c->body[k];
        if (!sunder_i_may_move(b) || (to[0] == at[0] && to[1] == at[1])) continue;
        b->pinned = !sunder_i_is_exact_move(&s->model, c->body[k], to);
        any = any || b->pinned;
    }
    return any;
}

/* Is the body one of another cluster? */
static bool is_foreign(const sunder_i_solver *s, const sunder_i_cluster *c, uint32_t body)
{
    return !s->model.body[body].fixed && !sunder_i_set_has(c->body, c->n, body);
}

/* The exact check refused a pair: if it is one of two clusters, these will be one; otherwise the pair is pinned, unless
 * `again` is NULL. *again: there is another attempt for the cluster. */
static sunder_status refuse_pair(sunder_i_solver *s, sunder_i_cluster *c, const sunder_i_id_pair *pair, bool *again,
                                 sunder_error *err)
{
    const uint32_t i = s->model.body_of[pair->a], j = s->model.body_of[pair->b];
    if (i != j && (is_foreign(s, c, i) || is_foreign(s, c, j))) {
        if (!sunder_i_reserve(&c->guest, &c->guest_capacity, c->guests + 1, sizeof *c->guest))
            return sunder_i_failure_cause(err);
        c->guest[c->guests++] = (sunder_i_id_pair){i, j};
    } else if (i != j && again && pin_pair(s, i, j)) {
        *again = true;
        return SUNDER_OK;
    }
    unpin(s, c);
    return SUNDER_OK;
}

/* Moves the bodies of a cluster to where they are eased, if the exact check lets them stay there. again: see
 * refuse_pair(). */
static sunder_status try_moves(sunder_i_solver *s, sunder_i_cluster *c, bool *again, sunder_error *err)
{
    const double none[2] = {0, 0}, *move = s->move + 2 * (size_t)(c->body - s->body);
    sunder_i_trial t = {.solver = s, .whole_rows = true};
    sunder_i_reading reading;
    if (again && pin_inexact(s, c, move)) {
        *again = true;
        return SUNDER_OK;
    }
    sunder_i_reads_begin(&reading, &s->model, sunder_i_reader_for(s, c));
    sunder_status status = sunder_i_trial_take_moved(&t, c, move) ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status && t.n) status = sunder_i_trial_place(&t, none, err);
    sunder_i_reads_end(&reading);
    if (t.well || t.n == 0)
        unpin(s, c);
    else if (!status)
        status = refuse_pair(s, c, &t.broken, again, err);
    sunder_i_trial_free(&t);
    return status;
}

/* Has work done on the clusters that pass the test, and tries their moves. again: see refuse_pair(). */
static sunder_status work_on_clusters(sunder_i_solver *s, sunder_i_cluster_test test, sunder_i_cluster_work work,
                                      void *context, bool *again, sunder_error *err)
{
    for (size_t k = 0; k < s->clusters; k++) s->cluster[k].outcome = SUNDER_I_UNTOUCHED;
    sunder_status status = sunder_i_solver_for_clusters(s, test, work, context, err);
    sunder_i_pieces_forget(&s->model, SUNDER_I_PIECES_HELD);
    for (size_t k = 0; k < s->clusters && !status; k++) {
        sunder_i_cluster *c = &s->cluster[k];
        if (c->outcome == SUNDER_I_UNTOUCHED)
            unpin(s, c);
        else
            status = try_moves(s, c, again, err);
    }
    return status;
}

static sunder_status ease_clusters(sunder_i_solver *s, sunder_i_cluster_test test, bool *again, sunder_error *err)
{
    *again = false;
    return work_on_clusters(s, test, ease_cluster, NULL, again, err);
}

/* Eases clusters from other starts (eased_starts.c). A layout that the exact check refuses is given up: the present one
 * is eased already. */
static sunder_status try_starts(sunder_i_solver *s, sunder_error *err)
{
    sunder_i_eased_starts starts;
    sunder_status status = sunder_i_eased_starts_init(s, &starts, err);
    if (!status) status = work_on_clusters(s, has_to_ease, sunder_i_eased_starts_try, &starts, NULL, err);
    sunder_i_eased_starts_free(&starts);
    return status;
}

/* Has the bodies that were in the way of a cluster solved together with it from now on. *any: there were some. */
static sunder_status join_guests(sunder_i_solver *s, bool *any, sunder_error *err)
{
    *any = false;
    memset(s->to_ease, 0, s->model.bodies * sizeof *s->to_ease);
    for (size_t k = 0; k < s->clusters; k++)
        for (size_t g = 0; g < s->cluster[k].guests; g++) {
            const sunder_i_id_pair *pair = &s->cluster[k].guest[g];
            *any = s->to_ease[pair->a] = s->to_ease[pair->b] = true;
            if (!sunder_i_solver_add_edge(s, pair->a, pair->b)) return sunder_i_failure_cause(err);
        }
    return *any ? sunder_i_solver_gather(s, err) : SUNDER_OK;
}

/* Makes the contact groups of the present layout. What was proved of the bodies of a former group holds wherever they
 * stand, so they stay in one group. */
static sunder_status gather_groups(sunder_i_solver *s, sunder_error *err)
{
    sunder_i_groups *groups = &s->groups;
    bool ok = true;
    for (size_t k = 0; k < groups->n && ok; k++) {
        const sunder_i_group *g = &groups->group[k];
        for (size_t m = 0; m < g->n + g->guests.n && ok; m++) {
            const uint32_t b = m < g->n ? g->body[m] : g->guests.item[m - g->n];
            ok = s->model.body[b].fixed || b == g->number || sunder_i_groups_join(groups, g->number, b);
        }
    }
    return ok ? sunder_i_solver_gather_groups(s, err) : sunder_i_failure_cause(err);
}

/* Clusters that are to be eased get the usual margin. A wide one, which they got in vain, would leave no layout without
 * clashes to begin with. Other clusters keep theirs: a part of the layer may have nothing to ease. */
static void narrow_margins(sunder_i_solver *s)
{
    for (size_t k = 0; k < s->clusters; k++)
        if (has_to_ease(s, &s->cluster[k])) sunder_i_solver_narrow_margin(s, &s->cluster[k]);
}

/* One round: eases clusters, and then joins those that are in each other's way, if there are any (*more). */
static sunder_status ease_round(sunder_i_solver *s, bool *more, sunder_error *err)
{
    bool again, apart = false;
    narrow_margins(s);
    sunder_status status = sunder_i_solver_unite_blocks(s, err);
    if (!status) status = ease_clusters(s, has_to_ease, &again, err);
    for (int k = 0; k < MOST_PINNINGS && again && !status; k++) status = ease_clusters(s, has_pinned, &again, err);
    for (size_t b = 0; b < s->model.bodies; b++) s->model.body[b].pinned = false;
    if (!status && s->model.rules.effort > 0 && !sunder_i_has_slack(&s->model)) status = try_starts(s, err);
    if (!status) status = join_guests(s, more, err);
    if (!status && sunder_i_has_slack(&s->model)) status = join_short_pairs(s, false, &apart, err);
    *more = *more || apart;
    return status;
}

sunder_status sunder_i_solver_ease(sunder_i_solver *solver, sunder_error *err)
{
    bool more = true, any;
    const bool slack = sunder_i_has_slack(&solver->model);
    sunder_status status = relax_open_pairs(solver, err);
    if (!status) status = mark_short(solver) ? join_short_pairs(solver, true, &any, err) : sunder_i_failure_cause(err);
    for (int round = 0; round < (slack ? MOST_JOININGS_OF_TIGHT : MOST_JOININGS) && more && !status; round++)
        status = ease_round(solver, &more, err);
    sunder_i_free(solver->to_ease);
    solver->to_ease = NULL;
    solver->eased = true;
    return status || !(solver->groups.n || slack) ? status : gather_groups(solver, err);
}
