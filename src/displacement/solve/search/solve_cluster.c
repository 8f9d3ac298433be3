/* A cluster from start to rounded moves: the stages in the order of a table. Bodies descend; where sides contradict
 * each other they jump, and descend again; pairs for which no solution is found are given up; then moves are rounded.
 * For two features that are alone the exact core computes the answer. */
#include "displacement/layer/rounding.h"
#include "displacement/layer/stage_table.h"
#include "displacement/prove/areas/areas.h"
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/invariant.h"

#include <math.h>
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

/* ---- Preconditions ----------------------------------------------------------------------------------------------- */

/* The state of a solution that its stages share. */
typedef struct solving {
    sunder_i_stage_run run;
    sunder_i_search *s;
    sunder_i_cluster *cluster;
    const double *move; /* [2 n] moves at the beginning */
    bool alone;         /* a lone pair, whose least translation is known */
    bool done;          /* nothing clashes */
    bool given_up;      /* then: except for pairs that were given up */
    bool cheapest;      /* the solution is known to be the cheapest */
} solving;

static bool has_limits(const sunder_i_search *s)
{
    for (size_t k = 0; k < s->n; k++)
        if (!s->model->body[s->body[k]].fixed && s->model->body[s->body[k]].limit < INFINITY) return true;
    return false;
}

static bool is_unsolved(const void *state) { return !((const solving *)state)->done; }

static bool is_unsolved_crowd(const void *state)
{
    return is_unsolved(state) && ((const solving *)state)->cluster->starts_from_areas;
}

static bool is_unsolved_question(const void *state)
{
    return is_unsolved(state) && ((const solving *)state)->cluster->brief;
}

static bool may_relax(const sunder_i_cluster *cluster) { return cluster->limited && !cluster->brief; }

static bool may_give_up(const void *state)
{
    return is_unsolved(state) && may_relax(((const solving *)state)->cluster);
}

static bool may_give_up_at_once(const void *state)
{
    return may_give_up(state) && has_limits(((const solving *)state)->s);
}

static uint32_t count_movers(const sunder_i_search *s, uint32_t *mover)
{
    uint32_t movers = 0;
    for (uint32_t k = 0; k < s->n; k++)
        if (s->mass[k] > 0) {
            *mover = k;
            movers++;
        }
    return movers;
}

static bool is_lone_body(const void *state)
{
    const solving *x = state;
    const sunder_i_barriers *barriers = x->s->model->barriers;
    uint32_t mover = 0;
    return barriers && barriers->parts > 0 && may_relax(x->cluster) && count_movers(x->s, &mover) == 1 &&
           !(sunder_i_search_limit(x->s, mover) < INFINITY);
}

static bool may_be_cheapest(const void *state)
{
    const solving *x = state;
    return x->done && !x->alone && !x->given_up && !x->cluster->brief && sunder_i_search_runs_without_proofs(x->s);
}

/* ---- Stages ------------------------------------------------------------------------------------------------------ */

static void part_lone_pair(void *state)
{
    solving *x = state;
    x->run.status = sunder_i_search_separate_lone_pair(x->s, x->cluster, &x->alone, x->run.err);
    x->done = x->cheapest = x->alone;
}

/* Moves the bodies of a crowd apart as far as their areas need, so that none is far from home by chance. */
static void begin_crowd(void *state)
{
    solving *x = state;
    bool found;
    x->run.status = sunder_i_areas_places(x->s->model, x->s->body, x->s->n, false, x->s->t, &found, x->run.err);
}

static void mend_few(void *state)
{
    solving *x = state;
    x->done = x->given_up = sunder_i_search_mend_few(x->s);
}

/* Descends; if sides contradict each other, bodies jump and all descend again, up to the budget's number of times. If
 * no jump clears the clashes, a limited cluster gives up, after one more descent if it may not relax pairs. */
static void descend_cluster(void *state)
{
    solving *x = state;
    sunder_i_search *s = x->s;
    x->done = !s->failed && sunder_i_search_descend(s);
    for (uint64_t k = 0; k < x->run.budget && !x->done && !s->failed; k++) {
        const bool stuck = !sunder_i_search_jump(s) && x->cluster->limited;
        if (stuck && !x->cluster->brief) break;
        x->done = sunder_i_search_descend(s);
        if (stuck) break;
    }
}

/* Relaxes the pairs whose distance in the original places is less than the gap plus the margin, but not less than the
 * gap, to that distance. If there are such pairs, starts again from the first moves. */
static void waive_margins(void *state)
{
    solving *x = state;
    if (!sunder_i_search_waive_margins(x->s)) return;
    memcpy(x->s->t, x->move, 2 * x->s->n * sizeof *x->s->t);
    x->s->program.n = 0;
    descend_cluster(x);
}

static void spread_cluster(void *state)
{
    solving *x = state;
    x->done = sunder_i_search_spread(x->s);
}

/* For one movable body among fixed ones, without a limit: moves it to the nearest free position that it can see,
 * however far away, unless it stands at a free position that is no farther. An example is a symbol in a long arm of an
 * area, with room only where the arm begins. Since round corners are polygons in that search, it descends from some
 * positions and takes the cheapest. */
static void place_lone_body(void *state)
{
    solving *x = state;
    sunder_i_search *s = x->s;
    uint32_t mover = 0;
    double place[LONE_PLACES][2], best[2];
    count_movers(s, &mover);
    double *at = s->t + 2 * (size_t)mover;
    memcpy(best, at, sizeof best);
    double nearest = x->done ? sunder_i_search_stray(s, mover) * (1 - NO_NEARER) : INFINITY;
    const size_t n = nearest > 0 ? sunder_i_search_free_body_anywhere(s, mover, nearest, LONE_PLACES, place) : 0;
    for (size_t k = 0; k < n && !s->failed; k++) {
        memcpy(at, place[k], sizeof place[k]);
        s->program.n = 0;
        const bool solved = sunder_i_search_descend(s);
        if (solved ? !(sunder_i_search_stray(s, mover) < nearest) : x->done || k > 0) continue;
        memcpy(best, at, sizeof best);
        x->done = x->done || solved;
        if (solved) nearest = sunder_i_search_stray(s, mover);
    }
    memcpy(at, best, sizeof best);
}

static void ask_whether_cheapest(void *state)
{
    solving *x = state;
    x->cheapest = sunder_i_search_is_cheapest(x->s);
}

static void give_up(void *state)
{
    solving *x = state;
    sunder_i_search_give_up(x->s);
    x->given_up = true;
}

/* ---- The order --------------------------------------------------------------------------------------------------- */

/* The budget is the greatest number of jumps. */
static const sunder_i_stage stages[] = {
    {"part lone pair", NULL, part_lone_pair, 0},
    {"begin crowd", is_unsolved_crowd, begin_crowd, 0},
    {"mend few", may_give_up_at_once, mend_few, 0},
    {"descend", is_unsolved, descend_cluster, MOST_JUMPS},
    {"waive margins", is_unsolved_question, waive_margins, MOST_JUMPS},
    {"spread", is_unsolved, spread_cluster, 0},
    {"place lone body", is_lone_body, place_lone_body, 0},
    {"ask whether cheapest", may_be_cheapest, ask_whether_cheapest, 0},
    {"give up", may_give_up, give_up, 0},
};

static const char *look(const void *state, const double before[2], double now[2])
{
    const solving *x = state;
    (void)before;
    now[0] = sunder_i_search_cost(x->s, x->s->t);
    now[1] = x->given_up ? 1 : x->done ? 2 : 0;
    return x->given_up ? "solved but for pairs given up" : x->done ? "solved" : "not solved";
}

static const sunder_i_stage_table table = {"cluster", stages, sizeof stages / sizeof *stages, look};

sunder_status sunder_i_cluster_solve(const sunder_i_model *model, sunder_i_cluster *cluster, double *move,
                                     sunder_error *err)
{
    sunder_i_search s;
    if (!sunder_i_search_init(&s, model, cluster->body, cluster->n, cluster->margin, move)) s.failed = true;
    s.log = sunder_i_is_traced(model) ? &cluster->log : NULL;
    solving x = {.run = {.log = s.log, .failed = &s.failed, .err = err}, .s = &s, .cluster = cluster, .move = move};
    const sunder_status status = sunder_i_stages_run(&table, &x);
    if (status) s.failed = true;
    cluster->outcome = !x.done && cluster->brief ? SUNDER_I_FOUND_NONE
                       : x.cheapest              ? SUNDER_I_FOUND_CHEAPEST
                                                 : SUNDER_I_WORKED_ON;
    sunder_i_search_hand_over(&s, cluster);
    const bool failed = s.failed;
    if (!failed && cluster->outcome != SUNDER_I_FOUND_NONE) sunder_i_search_round(&s, move);
    sunder_i_search_free(&s);
    if (status) return status;
    return failed ? sunder_i_failure_cause(err) : SUNDER_OK;
}
