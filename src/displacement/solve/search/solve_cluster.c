/* A cluster from start to rounded moves: descend, and where sides contradict each other jump, descend again; pairs that
 * find no solution are given up; then round. Of two features that are alone the exact core knows the answer. */
#include "displacement/layer/rounding.h"
#include "displacement/prove/areas/areas.h"
#include "displacement/solve/search/stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/invariant.h"

#include <string.h>

void sunder_i_search_round(const sunder_i_search *search, double *move)
{
    SUNDER_I_CHECK(sunder_i_search_check(search), search->n);
    for (size_t k = 0; k < search->n; k++)
        if (search->mass[k] > 0)
            sunder_i_round_move(search->model, search->body[k], search->t + 2 * k, move + 2 * k, NULL);
}

void sunder_i_search_hand_over(sunder_i_search *search, sunder_i_cluster *cluster)
{
    cluster->relaxations = search->relaxations;
    cluster->restored = search->restored;
    cluster->restored_n = search->restored_n;
    memset(&search->relaxations, 0, sizeof search->relaxations);
    search->restored = NULL;
    search->restored_n = search->restored_capacity = 0;
}

/* Descends, and where sides contradict each other jumps and descends again; as long as jumps help, or once more. */
static bool find_free(sunder_i_search *s, const sunder_i_cluster *cluster)
{
    bool done = !s->failed && sunder_i_search_descend(s);
    for (int k = 0; k < MOST_JUMPS && !done && !s->failed; k++) {
        const bool stuck = !sunder_i_search_jump(s) && cluster->limited;
        if (stuck && !cluster->brief) break;
        done = sunder_i_search_descend(s);
        if (stuck) break;
    }
    return done;
}

static bool has_limits(const sunder_i_search *s)
{
    for (size_t k = 0; k < s->n; k++)
        if (!s->model->body[s->body[k]].fixed && s->model->body[s->body[k]].limit < INFINITY) return true;
    return false;
}

/* Begins anew from where all began, with pairs that stood apart there, but not by the margin, held to that. */
static bool find_free_but_for_margins(sunder_i_search *s, const sunder_i_cluster *cluster, const double *move)
{
    if (!sunder_i_search_waive_margins(s)) return false;
    memcpy(s->t, move, 2 * s->n * sizeof *s->t);
    s->program.n = 0;
    return find_free(s, cluster);
}

/* Do all together go farther than within their limits they may? Then the sides that they found are of no use there. */
static bool is_beyond_use(const sunder_i_search *s, const double *t)
{
    double cost = 0, most = 0;
    for (uint32_t k = 0; k < s->n; k++) {
        const double limit = sunder_i_search_limit(s, k), *at = t + 2 * (size_t)s->body[k];
        if (!(s->mass[k] > 0)) continue;
        cost += (at[0] * at[0] + at[1] * at[1]) / (2 * s->mass[k]);
        most += limit * limit / (2 * s->mass[k]);
    }
    return cost > most;
}

/* The same from where the bodies stood when limits were lifted: the sides that they had found there. */
static bool find_free_from_lifted(sunder_i_search *s, const sunder_i_cluster *cluster)
{
    const sunder_i_model *model = s->model;
    if (!model->lifted || !has_limits(s) || is_beyond_use(s, model->lifted)) return false;
    for (size_t k = 0; k < s->n; k++)
        if (s->mass[k] > 0) memcpy(s->t + 2 * k, model->lifted + 2 * (size_t)s->body[k], 2 * sizeof *s->t);
    s->program.n = 0;
    return find_free(s, cluster);
}

/* One body alone among barriers and what is fixed, without a limit, in the nearest free place in its sight, however far
 * that is: such as a symbol in a long arm of an area, whose room is where the arm begins. */
static bool find_free_alone(sunder_i_search *s, const sunder_i_cluster *cluster)
{
    uint32_t mover = 0, movers = 0;
    double place[2];
    for (uint32_t k = 0; k < s->n; k++)
        if (s->mass[k] > 0) {
            mover = k;
            movers++;
        }
    if (!s->model->barriers || s->model->barriers->parts == 0 || !cluster->limited || cluster->brief || movers != 1 ||
        sunder_i_search_limit(s, mover) < INFINITY || !sunder_i_search_free_body_anywhere(s, mover, place))
        return false;
    memcpy(s->t + 2 * (size_t)mover, place, sizeof place);
    s->program.n = 0;
    return sunder_i_search_descend(s);
}

/* A crowd begins apart as far as its area needs it to be, and nobody far from home by chance. */
static sunder_status begin_crowd(sunder_i_search *s, const sunder_i_cluster *cluster, sunder_error *err)
{
    bool found;
    if (s->failed || !cluster->crowd) return SUNDER_OK;
    return sunder_i_areas_places(s->model, s->body, s->n, false, s->t, &found, err);
}

static bool may_give_up(const sunder_i_cluster *cluster) { return cluster->limited && !cluster->brief; }

/* Down to where nothing clashes any more: *done. Of a cluster that may give up pairs and does so at once: *given_up. */
static sunder_status find_solution(sunder_i_search *s, const sunder_i_cluster *cluster, const double *move, bool *done,
                                   bool *given_up, sunder_error *err)
{
    const sunder_status begun = begin_crowd(s, cluster, err);
    if (begun) return begun;
    *given_up = may_give_up(cluster) && has_limits(s) &&
                (sunder_i_search_mend_few(s) || sunder_i_search_give_up_at_home(s, move));
    *done = *given_up || find_free(s, cluster);
    if (!*done && !s->failed && cluster->brief) *done = find_free_but_for_margins(s, cluster, move);
    if (!*done && !s->failed) *done = find_free_from_lifted(s, cluster);
    if (!*done && !s->failed) *done = sunder_i_search_spread(s);
    if (!*done && !s->failed) *done = find_free_alone(s, cluster);
    return SUNDER_OK;
}

/* Is a solution the cheapest? */
static bool is_cheapest(sunder_i_search *s, const sunder_i_cluster *cluster)
{
    return !s->failed && !cluster->brief && sunder_i_search_goes_down(s) && sunder_i_search_is_cheapest(s);
}

sunder_status sunder_i_cluster_solve(const sunder_i_model *model, sunder_i_cluster *cluster, double *move,
                                     sunder_error *err)
{
    sunder_i_search s;
    bool alone = false, done = false, given_up = false;
    if (!sunder_i_search_init(&s, model, cluster->body, cluster->n, cluster->margin, move)) s.failed = true;
    sunder_status status = sunder_i_search_part_lone_pair(&s, cluster, &alone, err);
    if (!status && !alone && !s.failed) status = find_solution(&s, cluster, move, &done, &given_up, err);
    if (status) s.failed = true;
    cluster->cheapest = alone || (done && !given_up && is_cheapest(&s, cluster));
    done = done || alone;
    if (!done && !s.failed && may_give_up(cluster)) sunder_i_search_give_up(&s, move);
    cluster->hopeless = !done && cluster->brief;
    sunder_i_search_hand_over(&s, cluster);
    const bool failed = s.failed;
    if (!failed && !cluster->hopeless) sunder_i_search_round(&s, move);
    sunder_i_search_free(&s);
    if (status) return status;
    return failed ? sunder_i_no_memory(err) : SUNDER_OK;
}
