/* A cluster from start to rounded moves: the stages in the order of a table. Bodies descend; where sides contradict
 * each other they jump, and descend again; pairs for which no solution is found are given up; then moves are rounded.
 * For two features that are alone the exact core computes the answer. */
#include "displacement/layer/rounding.h"
#include "displacement/prove/areas/areas.h"
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/invariant.h"
#include "base/stage_switch.h"

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

/* Does the layout cost more than if all bodies were at their limits? Then its sides are of no use within limits. */
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

static bool may_give_up(const solving *x) { return x->cluster->limited && !x->cluster->brief; }

static bool is_unsolved(const solving *x) { return !x->done; }

static bool is_unsolved_crowd(const solving *x) { return !x->done && x->cluster->starts_from_areas; }

static bool may_give_up_at_once(const solving *x) { return !x->done && may_give_up(x) && has_limits(x->s); }

static bool is_unsolved_question(const solving *x) { return !x->done && x->cluster->brief; }

static bool was_lifted(const solving *x)
{
    const double *lifted = x->s->model->lifted;
    return !x->done && lifted && has_limits(x->s) && !is_beyond_use(x->s, lifted);
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

static bool is_lone_body(const solving *x)
{
    const sunder_i_barriers *barriers = x->s->model->barriers;
    uint32_t mover = 0;
    return barriers && barriers->parts > 0 && may_give_up(x) && count_movers(x->s, &mover) == 1 &&
           !(sunder_i_search_limit(x->s, mover) < INFINITY);
}

static bool may_be_cheapest(const solving *x)
{
    return x->done && !x->alone && !x->given_up && !x->cluster->brief && sunder_i_search_runs_without_proofs(x->s);
}

static bool may_give_up_pairs(const solving *x) { return !x->done && may_give_up(x); }

/* ---- Stages ------------------------------------------------------------------------------------------------------ */

static sunder_status part_lone_pair(solving *x, int jumps, sunder_error *err)
{
    (void)jumps;
    const sunder_status status = sunder_i_search_separate_lone_pair(x->s, x->cluster, &x->alone, err);
    x->done = x->cheapest = x->alone;
    return status;
}

/* Moves the bodies of a crowd apart as far as their areas need, so that none is far from home by chance. */
static sunder_status begin_crowd(solving *x, int jumps, sunder_error *err)
{
    bool found;
    (void)jumps;
    return sunder_i_areas_places(x->s->model, x->s->body, x->s->n, false, x->s->t, &found, err);
}

static sunder_status mend_few(solving *x, int jumps, sunder_error *err)
{
    (void)jumps;
    (void)err;
    x->done = x->given_up = sunder_i_search_mend_few(x->s);
    return SUNDER_OK;
}

static sunder_status give_up_at_home(solving *x, int jumps, sunder_error *err)
{
    (void)jumps;
    (void)err;
    x->done = x->given_up = sunder_i_search_give_up_at_home(x->s, x->move);
    return SUNDER_OK;
}

/* Descends; if sides contradict each other, bodies jump and all descend again, up to `jumps` times. If no jump clears
 * the clashes, a limited cluster gives up, after one more descent if it may not relax pairs. */
static bool find_free(solving *x, int jumps)
{
    sunder_i_search *s = x->s;
    x->done = !s->failed && sunder_i_search_descend(s);
    for (int k = 0; k < jumps && !x->done && !s->failed; k++) {
        const bool stuck = !sunder_i_search_jump(s) && x->cluster->limited;
        if (stuck && !x->cluster->brief) break;
        x->done = sunder_i_search_descend(s);
        if (stuck) break;
    }
    return x->done;
}

static sunder_status descend_cluster(solving *x, int jumps, sunder_error *err)
{
    (void)err;
    find_free(x, jumps);
    return SUNDER_OK;
}

/* Relaxes the pairs whose distance in the original places is less than the gap plus the margin, but not less than the
 * gap, to that distance. If there are such pairs, starts again from the first moves. */
static sunder_status waive_margins(solving *x, int jumps, sunder_error *err)
{
    (void)err;
    if (!sunder_i_search_waive_margins(x->s)) return SUNDER_OK;
    memcpy(x->s->t, x->move, 2 * x->s->n * sizeof *x->s->t);
    x->s->program.n = 0;
    find_free(x, jumps);
    return SUNDER_OK;
}

/* Starts again from the layout that was found without limits (model->lifted), whose sides may also serve within
 * limits. */
static sunder_status begin_from_lifted(solving *x, int jumps, sunder_error *err)
{
    sunder_i_search *s = x->s;
    (void)err;
    for (size_t k = 0; k < s->n; k++)
        if (s->mass[k] > 0) memcpy(s->t + 2 * k, s->model->lifted + 2 * (size_t)s->body[k], 2 * sizeof *s->t);
    s->program.n = 0;
    find_free(x, jumps);
    return SUNDER_OK;
}

static sunder_status spread_cluster(solving *x, int jumps, sunder_error *err)
{
    (void)jumps;
    (void)err;
    x->done = sunder_i_search_spread(x->s);
    return SUNDER_OK;
}

/* For one movable body among fixed ones, without a limit: moves it to the nearest free position that it can see,
 * however far away, unless it stands at a free position that is no farther. An example is a symbol in a long arm of an
 * area, with room only where the arm begins. */
static sunder_status place_lone_body(solving *x, int jumps, sunder_error *err)
{
    sunder_i_search *s = x->s;
    uint32_t mover = 0;
    double place[2], stood[2];
    (void)jumps;
    (void)err;
    count_movers(s, &mover);
    double *at = s->t + 2 * (size_t)mover;
    memcpy(stood, at, sizeof stood);
    const double farthest = x->done ? hypot(at[0], at[1]) * (1 - NO_NEARER) : INFINITY;
    if (!(farthest > 0) || !sunder_i_search_free_body_anywhere(s, mover, farthest, place)) return SUNDER_OK;
    memcpy(at, place, sizeof place);
    s->program.n = 0;
    const bool solved = sunder_i_search_descend(s);
    if (x->done && !solved) memcpy(at, stood, sizeof stood);
    x->done = x->done || solved;
    return SUNDER_OK;
}

static sunder_status ask_whether_cheapest(solving *x, int jumps, sunder_error *err)
{
    (void)jumps;
    (void)err;
    x->cheapest = sunder_i_search_is_cheapest(x->s);
    return SUNDER_OK;
}

static sunder_status give_up(solving *x, int jumps, sunder_error *err)
{
    (void)jumps;
    (void)err;
    sunder_i_search_give_up(x->s, x->move);
    x->given_up = true;
    return SUNDER_OK;
}

/* ---- The order --------------------------------------------------------------------------------------------------- */

typedef struct stage {
    const char *name;
    bool (*applies)(const solving *x); /* the precondition; NULL: it always applies */
    sunder_status (*run)(solving *x, int jumps, sunder_error *err);
    int jumps; /* budget: the greatest number of jumps; other stages have theirs in tuning.h */
} stage;

static const stage stages[] = {
    {"part lone pair", NULL, part_lone_pair, 0},
    {"begin crowd", is_unsolved_crowd, begin_crowd, 0},
    {"mend few", may_give_up_at_once, mend_few, 0},
    {"give up at home", may_give_up_at_once, give_up_at_home, 0},
    {"descend", is_unsolved, descend_cluster, MOST_JUMPS},
    {"waive margins", is_unsolved_question, waive_margins, MOST_JUMPS},
    {"begin from lifted", was_lifted, begin_from_lifted, MOST_JUMPS},
    {"spread", is_unsolved, spread_cluster, 0},
    {"place lone body", is_lone_body, place_lone_body, 0},
    {"ask whether cheapest", may_be_cheapest, ask_whether_cheapest, 0},
    {"give up", may_give_up_pairs, give_up, 0},
};

/* If the layer is traced: notes a stage that changed anything. */
static sunder_status note_stage(const solving *before, const solving *x, const char *name, double cost,
                                sunder_error *err)
{
    const double now = sunder_i_search_cost(x->s, x->s->t);
    const char *outcome = x->given_up ? "solved but for pairs given up" : x->done ? "solved" : "not solved";
    const sunder_i_trace_step step = {name, outcome, cost, now};
    if (x->done == before->done && x->given_up == before->given_up && !(now < cost) && !(now > cost)) return SUNDER_OK;
    return sunder_i_trace_note(&x->cluster->log, &step) ? SUNDER_OK : sunder_i_failure_cause(err);
}

static sunder_status run_stage(solving *x, const stage *y, sunder_error *err)
{
    if (!sunder_i_is_traced(x->s->model)) return y->run(x, y->jumps, err);
    const solving before = *x;
    const double cost = sunder_i_search_cost(x->s, x->s->t);
    const sunder_status status = y->run(x, y->jumps, err);
    return status || x->s->failed ? status : note_stage(&before, x, y->name, cost, err);
}

sunder_status sunder_i_cluster_solve(const sunder_i_model *model, sunder_i_cluster *cluster, double *move,
                                     sunder_error *err)
{
    sunder_i_search s;
    solving x = {.s = &s, .cluster = cluster, .move = move};
    sunder_status status = SUNDER_OK;
    if (!sunder_i_search_init(&s, model, cluster->body, cluster->n, cluster->margin, move)) s.failed = true;
    for (size_t k = 0; k < sizeof stages / sizeof *stages && !status && !s.failed; k++)
        if (sunder_i_stage_is_on("cluster", stages[k].name) && (!stages[k].applies || stages[k].applies(&x)))
            status = run_stage(&x, &stages[k], err);
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
