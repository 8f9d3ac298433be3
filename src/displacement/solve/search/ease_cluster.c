/* Eases the pairs of a cluster that are left in conflict: descends, from a layout without clashes, to where the sum of
 * moves, springs and prices is least. Every layout on the way satisfies the constraints of the search: all other pairs
 * keep their distance, and pairs left in conflict are no worse than at the start. */
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include <math.h>
#include <string.h>

/* Sets *a and *b to the bodies of a constraint of two pieces, or of a tight pair. Returns false if it is another. */
static bool find_bodies(const sunder_i_search *s, const sunder_i_constraint *c, uint32_t *a, uint32_t *b)
{
    uint32_t i, j;
    const bool tight = sunder_i_search_is_tight_key(c->key, &i, &j);
    if (!tight && c->key >> 60) return false;
    *a = tight ? s->body[i] : sunder_i_body_of_piece(s->model, (uint32_t)(c->key >> 32));
    *b = tight ? s->body[j] : sunder_i_body_of_piece(s->model, (uint32_t)c->key);
    return true;
}

static bool add_guest(sunder_i_cluster *cluster, uint32_t own, uint32_t guest)
{
    if (!sunder_i_reserve(&cluster->guest, &cluster->guest_capacity, cluster->guests + 1, sizeof *cluster->guest))
        return false;
    cluster->guest[cluster->guests++] = (sunder_i_id_pair){own, guest};
    return true;
}

/* Adds to cluster->guest the bodies outside the cluster that may move and that its bodies press against. False if
 * memory is out. */
static bool find_guests(const sunder_i_search *s, sunder_i_cluster *cluster)
{
    const sunder_i_model *model = s->model;
    for (size_t k = 0; k < s->program.n; k++) {
        const sunder_i_constraint *c = &s->program.constraint[k];
        uint32_t a, b;
        if (!(c->force > 0) || !find_bodies(s, c, &a, &b)) continue;
        const bool has_a = sunder_i_set_has(cluster->body, cluster->n, a),
                   has_b = sunder_i_set_has(cluster->body, cluster->n, b);
        if (has_a == has_b || !sunder_i_may_move(&model->body[has_a ? b : a])) continue;
        if (!add_guest(cluster, has_a ? a : b, has_a ? b : a)) return false;
    }
    return true;
}

/* Adds the neighbours in rows outside the cluster that its bodies pull: those of bodies that easing has moved from
 * where they stood; with a full gap, where whole rows are eased, all whose springs act. As long as they stay they hold
 * the cluster back. */
static bool find_row_guests(const sunder_i_search *s, sunder_i_cluster *cluster)
{
    const sunder_i_model *model = s->model;
    const double least = ACTING_SPRING * (s->prices_tight ? model->rules.full_gap : model->rules.gap);
    sunder_i_row_link link;
    for (sunder_i_row_walk walk = {0}; sunder_i_search_next_row(s, &walk, &link);) {
        const uint32_t other = link.side->other, own = s->body[link.i];
        const double *t = s->t + 2 * (size_t)link.i, *still = model->move + 2 * (size_t)(s->prices_tight ? other : own);
        if (link.i >= cluster->n || sunder_i_set_has(cluster->body, cluster->n, other)) continue;
        if (!sunder_i_may_move(&model->body[other])) continue;
        if (!(hypot(t[0] - still[0], t[1] - still[1]) > least)) continue;
        if (!add_guest(cluster, own, other)) return false;
    }
    return true;
}

/* What the moves t cost, with the prices of all that pairs lack of their full distances. */
static double full_cost(sunder_i_search *s, const double *t)
{
    s->prices_tight = s->fully = sunder_i_has_slack(s->model);
    const double cost = sunder_i_search_cost(s, t);
    s->prices_tight = false;
    return cost;
}

/* Descends from the moves of the search. Returns whether that ends without clashes at less than `before`. */
static bool descend(sunder_i_search *s, double before)
{
    s->settled = EASED;
    /* Where there is no room for margins, the exact check decides. */
    if (!sunder_i_search_keep_margins(s) && sunder_i_search_find_clashes(s, s->t) > s->tolerance) return false;
    s->prices_tight = s->fully;
    s->program.n = 0;
    return sunder_i_search_descend(s) && sunder_i_search_cost(s, s->t) < before * (1 - CHEAPER);
}

sunder_status sunder_i_cluster_ease(const sunder_i_model *model, sunder_i_cluster *cluster, double *move, double *cost,
                                    bool *done, sunder_error *err)
{
    sunder_i_search s;
    *done = false;
    *cost = 0;
    const bool ok = sunder_i_search_init_about(&s, model, cluster, move) && sunder_i_search_ease(&s);
    s.failed = s.failed || !ok;
    const bool priced = s.shortfalls || sunder_i_has_slack(model);
    if (!s.failed && priced) *cost = full_cost(&s, s.t);
    if (!s.failed && *cost > 0) *done = sunder_i_search_ask_margins(&s) && descend(&s, *cost);
    if (!s.failed && *done) *cost = sunder_i_search_cost(&s, s.t);
    s.n = cluster->n;
    if (*done && !s.failed) sunder_i_search_round(&s, move);
    if (!s.failed && priced && !find_guests(&s, cluster)) s.failed = true;
    if (!s.failed && (*done || s.prices_tight) && !find_row_guests(&s, cluster)) s.failed = true;
    const bool failed = s.failed;
    sunder_i_search_free(&s);
    return failed ? sunder_i_failure_cause(err) : SUNDER_OK;
}

/* Turns the overlaps that may remain into the directions in which they are least at the present moves. The search holds
 * an overlap to one direction, while a layout may have any. */
static sunder_status turn_overlaps(sunder_i_search *s, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < s->relaxations.n && !status; k++) {
        sunder_i_relaxation *r = &s->relaxations.item[k];
        const uint32_t i = sunder_i_search_place_of(s, s->model->body_of[r->a]),
                       j = sunder_i_search_place_of(s, s->model->body_of[r->b]);
        bool fits;
        if (r->inside || (r->shift[0] == 0 && r->shift[1] == 0)) continue;
        status = sunder_i_relaxation_turn(s->model, s->t + 2 * (size_t)i, s->t + 2 * (size_t)j, r, &fits, err);
    }
    return status;
}

sunder_status sunder_i_cluster_ease_from(const sunder_i_model *model, const sunder_i_cluster *cluster,
                                         const double *start, double *move, double *cost, bool *done, sunder_error *err)
{
    sunder_i_search s;
    sunder_status status = SUNDER_OK;
    *done = false;
    bool ok = sunder_i_search_init_about(&s, model, cluster, move) && sunder_i_search_ease(&s) &&
              sunder_i_search_ask_margins(&s);
    if (ok) memcpy(s.t, start, 2 * cluster->n * sizeof *start);
    if (ok && full_cost(&s, s.t) < *cost) {
        status = turn_overlaps(&s, err);
        *done = !status && descend(&s, *cost);
    }
    ok = ok && !s.failed;
    if (ok && *done) {
        *cost = sunder_i_search_cost(&s, s.t);
        s.n = cluster->n;
        sunder_i_search_round(&s, move);
    }
    sunder_i_search_free(&s);
    if (status) return status;
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}
