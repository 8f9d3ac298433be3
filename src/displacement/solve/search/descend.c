/* The sequence of quadratic programs.
 *
 * Around a reference position each pair of convex pieces gives one support constraint (obstacle.c). If the pair is
 * free, its direction is that of the nearest point. If two bodies clash, directions are taken where the pair would
 * stand after the least translation that separates it, so that all pieces of the pair agree on the side. The program's
 * solution is feasible for the true shapes, since support constraints are global; from a feasible position every round
 * is feasible and costs no more than the last. Pieces beyond the reach are left out until they are found in the way. A
 * large crowd without limits descends coarsely first, and takes its sides from where its path leads; a round where that
 * failed is repeated without it.
 *
 * Pairs that clash may demand contradictory sides. Then the program is solved softly, and the compromise is the next
 * reference position. */
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"
#include "base/invariant.h"
#include "base/watch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Solving one program ----------------------------------------------------------------------------------------- */

static double longest_step(const sunder_i_search *s)
{
    double longest = 0;
    for (size_t k = 0; k < 2 * s->n; k++) longest = sunder_i_max(longest, fabs(s->next[k] - s->t[k]));
    return longest;
}

/* Have more than half of the movable bodies moved? */
static bool is_under_way(const sunder_i_search *s)
{
    size_t moved = 0;
    for (size_t k = 0; k < s->n; k++) moved += s->mass[k] > 0 && (s->t[2 * k] != 0 || s->t[2 * k + 1] != 0);
    return 2 * moved > sunder_i_search_movers(s);
}

static double longest_move(const sunder_i_search *s)
{
    double longest = 0;
    for (size_t k = 0; k < 2 * s->n; k++) longest = sunder_i_max(longest, fabs(s->next[k]));
    return longest;
}

/* Fixed bodies keep their present moves. (A neighbour of the cluster may stand elsewhere than at its original
 * place.) */
static void keep_still(sunder_i_search *s)
{
    for (size_t k = 0; k < s->n; k++)
        if (!(s->mass[k] > 0)) memcpy(s->next + 2 * k, s->t + 2 * k, 2 * sizeof *s->next);
}

static bool is_out_of_patience(const sunder_i_search *s) { return sunder_i_search_work(s) >= s->patience; }

/* Solves the program. If the solution violates hard constraints, which long chains of contacts cause, it is solved
 * again with larger demands. Returns the remaining violation. */
static double solve_program(sunder_i_search *s, double softness)
{
    sunder_i_quadratic *p = &s->program;
    const double hurry = sunder_i_max(s->tolerance / SOLVED_TO,
                                      softness > 0 ? COMPROMISE_TO * sunder_i_max(s->gap, s->extent / SMALL_PART) : 0);
    p->most_work = s->patience < UINT64_MAX ? (s->patience > s->steps ? s->patience - s->steps : 1) : 0;
    double v = sunder_i_quadratic_solve(p, softness, hurry, s->extent);
    if (v < 0 || !sunder_i_look()) s->failed = true;
    keep_still(s);
    if (softness > 0 || v <= s->tolerance) return v;
    double asked = 0;
    for (int k = 0; k < MOST_CORRECTIONS && v > s->tolerance && v <= NO_SOLUTION * (s->extent + s->gap) && !s->failed;
         k++) {
        const double more = CORRECTION * v;
        asked += more;
        for (size_t c = 0; c < p->n; c++) p->constraint[c].d += p->constraint[c].give > 0 ? 0 : more;
        v = sunder_i_quadratic_solve(p, 0, s->tolerance / SOLVED_TO, s->extent);
        if (v < 0 || !sunder_i_look()) s->failed = true;
        keep_still(s);
        v = sunder_i_max(0, v - asked);
    }
    return v;
}

/* Solves a hard program again after constraints were added that s->next violates. Returns the remaining violation. With
 * limits their effect is local, and the old solution is repaired. Without limits chains of contacts carry it on, and
 * the result would depend on the repair, so the program is solved from scratch. */
static double solve_further(sunder_i_search *s)
{
    sunder_i_quadratic *p = &s->program;
    if (!(p->most_cost > 0)) return solve_program(s, 0);
    const double v = sunder_i_quadratic_mend(p, s->tolerance / SOLVED_TO, s->extent, s->settled / PART_OF_SETTLED);
    if (v < 0) s->failed = true;
    return v >= 0 && v <= s->tolerance ? v : solve_program(s, 0);
}

/* Solves the program around s->t, adds the constraints that its solution violates, and repeats that until none are
 * added, at most MOST_ADDITIONS times (MOST_SOFT_ADDITIONS for a soft program). Returns the violation of the last
 * solution. */
static double solve_lazily(sunder_i_search *s, double softness)
{
    double v = 0;
    const int most = softness > 0 ? MOST_SOFT_ADDITIONS : MOST_ADDITIONS;
    s->ended = false;
    for (int k = 0; k < most && !is_out_of_patience(s) && !s->failed; k++) {
        v = k > 0 && softness == 0 ? solve_further(s) : solve_program(s, softness);
        /* There is no solution, and constraints near the point reached are of no use. */
        if (softness == 0 && v > NO_SOLUTION * (s->extent + s->gap)) break;
        s->ended = !sunder_i_search_constrain_further(s);
        if (s->ended) break;
    }
    return v;
}

/* The greatest violation at the solution of a program. If the last step has looked there and found nothing, its result
 * is used, and its work is counted again. */
static double look_at_end(sunder_i_search *s)
{
    if (!s->ended) return sunder_i_search_find_clashes(s, s->next);
    s->steps += s->seen_steps;
    return s->seen;
}

/* Solves the program around a position with clashes softly. If the violation is small compared with the moves, it is
 * solved hard as well, and that solution is used if it is one. */
static double solve_compromise(sunder_i_search *s, double softness)
{
    const double v = solve_lazily(s, softness);
    if (v > NEARLY_SOLVED * (longest_move(s) + s->gap) || s->failed) return v;
    const size_t n = s->program.n;
    sunder_i_constraint *constraint = sunder_i_alloc(n, sizeof *constraint);
    double *next = sunder_i_alloc(2 * s->n, sizeof *next);
    double full = v;
    if (!constraint || !next) {
        s->failed = true;
    } else {
        if (n) memcpy(constraint, s->program.constraint, n * sizeof *constraint);
        memcpy(next, s->next, 2 * s->n * sizeof *next);
        full = solve_lazily(s, 0);
        if (full > s->tolerance) {
            if (n) memcpy(s->program.constraint, constraint, n * sizeof *constraint);
            s->program.n = n;
            memcpy(s->next, next, 2 * s->n * sizeof *next);
            s->ended = false;
            full = v;
        }
    }
    sunder_i_free_all(constraint, next);
    return full;
}

/* For a program that was not solved to the end: shortens the step from the free position s->t to s->next, so that no
 * constraint is violated more than at s->t. Constraints are convex, so the whole path is free. */
static void stop_short(sunder_i_search *s)
{
    double share = 1;
    for (size_t k = 0; k < s->program.n; k++) {
        const sunder_i_constraint *c = &s->program.constraint[k];
        const double here = sunder_i_stretch(c, s->t) - c->d, there = sunder_i_stretch(c, s->next) - c->d;
        if (c->give == 0 && there < 0 && there < here)
            share = sunder_i_min(share, sunder_i_max(0, here) / (here - there));
    }
    for (size_t k = 0; k < 2 * s->n; k++) s->next[k] = s->t[k] + JUST_BEFORE * share * (s->next[k] - s->t[k]);
    s->ended = false;
}

/* Does the program end at s->back, from where a search came? Then the next round would begin there again. */
static bool is_back(const sunder_i_search *s)
{
    for (size_t k = 0; k < 2 * s->n; k++)
        if (!(fabs(s->next[k] - s->back[k]) <= BACK * s->extent)) return false;
    return true;
}

#ifndef NDEBUG
/* The checker: s->next violates no constraint by more than s->t does, up to the tolerance. */
static const char *check_next(const sunder_i_search *s)
{
    for (size_t k = 0; k < s->program.n; k++) {
        const sunder_i_constraint *c = &s->program.constraint[k];
        const double here = sunder_i_stretch(c, s->t) - c->d, there = sunder_i_stretch(c, s->next) - c->d;
        if (c->give == 0 && there < sunder_i_min(0, here) - s->tolerance)
            return "a way that was free up to there is not";
    }
    return NULL;
}
#endif

/* How far body k may go from its original place; a fixed one stays. */
static double farthest_move(const sunder_i_search *s, uint32_t k)
{
    return s->mass[k] > 0 ? sunder_i_search_limit(s, k) : hypot(s->t[2 * k], s->t[2 * k + 1]);
}

/* The greatest cost with all bodies at their limits, those of springs included; 0 if a body has none. */
static double most_cost(const sunder_i_search *s)
{
    double cost = 0;
    sunder_i_row_link link;
    for (sunder_i_row_walk walk = {0}; sunder_i_search_next_row(s, &walk, &link);) {
        const double far = farthest_move(s, link.i) + hypot(link.side->rest[0], link.side->rest[1]) +
                           (link.j == SUNDER_I_GROUND ? hypot(link.still[0], link.still[1]) : farthest_move(s, link.j));
        sunder_i_spring spring[2];
        for (size_t k = sunder_i_springs_of(s->model, link.side, spring); k-- > 0;) cost += spring[k].stiff * far * far;
    }
    for (uint32_t k = 0; k < s->n; k++) {
        const double *a = s->preferred + 2 * k, far = sunder_i_search_limit(s, k) + hypot(a[0], a[1]);
        if (s->mass[k] > 0) cost += far * far / (2 * s->mass[k]);
    }
    return cost < INFINITY ? cost : 0;
}

/* ---- The sequence ------------------------------------------------------------------------------------------------ */

/* The state of a descent between two rounds. */
typedef struct descent {
    sunder_i_search *s;
    double *best;                    /* [2 n] the layout with the least violation so far, of those with clashes */
    double *lead;                    /* [2 n] see lead_on(), for large crowds; otherwise NULL */
    double reach, farthest;          /* pieces within this distance get constraints; its upper bound */
    double cost;                     /* cost of the present layout, if it is free */
    double softness;                 /* softness of the next compromise */
    double missed, left;             /* least violation of a program so far; least violation of a layout so far */
    bool is_free, is_led;            /* the present layout has no clashes; the next round takes its sides at `lead` */
    int clashing, idle, led_in_vain; /* number of rounds with clashes; of those in a row without progress; of those
                                      * without `lead` to come */
} descent;

/* Is it a large crowd without limits? Within limits moves are short, and the tolerance of a coarse descent may exceed
 * all violations. */
static bool descends_coarsely(const sunder_i_search *s)
{
    if (sunder_i_search_movers(s) <= LARGE_CROWD_LED) return false;
    for (uint32_t k = 0; k < s->n; k++)
        if (s->mass[k] > 0 && sunder_i_search_limit(s, k) < INFINITY) return false;
    return true;
}

static void descent_free(descent *d) { sunder_i_free_all(d->best, d->lead); }

static bool descent_init(descent *d, sunder_i_search *s)
{
    const bool crowd = sunder_i_search_movers(s) > LARGE_CROWD, large = descends_coarsely(s);
    const double part = large ? PART_OF_LARGE_CROWD : crowd ? PART_OF_CROWD : SMALL_PART;
    const double farthest = sunder_i_max(s->gap / 2, s->extent / part);
    /* The reach is at least the margin: a body in a free place keeps a little more than the full distance from its
     * neighbours. In a crowd away from its original place contacts are everywhere. */
    *d = (descent){.s = s,
                   .best = sunder_i_alloc(2 * s->n, sizeof *d->best),
                   .lead = large ? sunder_i_alloc(2 * s->n, sizeof *d->lead) : NULL,
                   .reach = sunder_i_max(crowd && is_under_way(s) ? farthest : s->gap, 4 * s->tolerance),
                   .farthest = farthest,
                   .cost = INFINITY,
                   .softness = SOFT,
                   .missed = INFINITY,
                   .left = INFINITY};
    return d->best && (d->lead || !large);
}

/* If this step and the last are free, the next round takes its sides at `lead`, beyond s->next by the length of this
 * step. Round bodies roll along each other, so that their sides turn a little each round, in the same sense. */
static void lead_on(descent *d, bool is_free)
{
    const sunder_i_search *s = d->s;
    d->is_led = d->lead && d->is_free && is_free && d->led_in_vain == 0;
    if (d->led_in_vain > 0) d->led_in_vain--;
    for (size_t k = 0; k < 2 * s->n && d->is_led; k++) d->lead[k] = s->next[k] + (s->next[k] - s->t[k]);
}

/* To be called after a round that took its sides at d->lead (lead_on()) and failed or gained too little: at least
 * the next NOT_LED rounds take them at the present layout. */
static void lead_no_more(descent *d)
{
    d->is_led = false;
    d->led_in_vain = NOT_LED;
}

/* Solves the program around the present layout. Returns its violation. */
static double solve_round(descent *d, bool clashing)
{
    sunder_i_search *s = d->s;
    if (clashing) {
        const double v = solve_compromise(s, d->softness);
        d->softness = sunder_i_max(d->softness / HARDENING, HARDEST);
        return v;
    }
    const double v = solve_lazily(s, 0);
    if (v > s->tolerance && !d->is_led) {
        stop_short(s);
        SUNDER_I_CHECK(check_next(s), s->n);
    }
    return v;
}

/* Moves to s->next. left, cost: its violation and cost. */
static void take_step(descent *d, bool is_free, double left, double cost)
{
    sunder_i_search *s = d->s;
    const double step = longest_step(s);
    lead_on(d, is_free);
    memcpy(s->t, s->next, 2 * s->n * sizeof *s->t);
    if (!is_free && left < d->left) {
        d->left = left;
        memcpy(d->best, s->t, 2 * s->n * sizeof *d->best);
    }
    d->is_free = is_free;
    d->cost = cost;
    d->reach = sunder_i_min(sunder_i_max(STEPS_AHEAD * step, s->gap / LEAST_REACH), d->farthest);
}

typedef enum outcome { ON, SETTLED_DOWN, IN_VAIN } outcome;

/* The price of what pairs lack is known to a program to first order only. So if the end of the step clashes or is no
 * cheaper, the step is halved, at most MOST_HALVINGS times. left, cost: those of s->next. */
static void shorten_step(const descent *d, double *left, double *cost)
{
    sunder_i_search *s = d->s;
    for (int k = 0; k < MOST_HALVINGS && sunder_i_search_has_prices(s) && d->is_free && !s->failed; k++) {
        if (*left <= s->tolerance && *cost < d->cost) return;
        for (size_t c = 0; c < 2 * s->n; c++) s->next[c] = (s->t[c] + s->next[c]) / 2;
        s->ended = false;
        *left = look_at_end(s);
        *cost = sunder_i_search_cost(s, s->next);
    }
}

static outcome run_round(descent *d)
{
    sunder_i_search *s = d->s;
    const uint64_t before = sunder_i_search_work(s);
    s->lead = d->is_led ? d->lead : NULL;
    const bool clashing = sunder_i_search_constrain(s, d->reach, false);
    s->lead = NULL;
    if (s->failed) return IN_VAIN;
    const double v = solve_round(d, clashing);
    if (s->failed) return IN_VAIN;
    double left = look_at_end(s), cost = sunder_i_search_cost(s, s->next);
    shorten_step(d, &left, &cost);
    const bool is_free = left <= s->tolerance, settled = !is_free || cost >= d->cost - s->settled * d->cost;
    if (s->back && is_free && is_back(s)) {
        s->steps += sunder_i_search_work(s) - before; /* the work of the next round, which would repeat known results */
        return IN_VAIN;
    }
    if (d->is_free && is_free && cost - HOPEFUL * (d->cost - cost) > s->hope) return IN_VAIN;
    if (d->is_led && (settled || v > s->tolerance)) {
        lead_no_more(d);
        if (!is_free || v > s->tolerance || !(cost < d->cost)) return ON;
    } else if (d->is_free && settled) {
        /* This is the last round. If it ends in a clash the program had numerical trouble, and the present free layout
         * is kept. */
        if (is_free && cost < d->cost) memcpy(s->t, s->next, 2 * s->n * sizeof *s->t);
        return SETTLED_DOWN;
    }
    take_step(d, is_free, left, cost);
    if (is_free) return ON;
    d->idle = v > d->missed / 2 ? d->idle + 1 : 0;
    d->missed = sunder_i_min(d->missed, v);
    return ++d->clashing >= MOST_CLASHING || d->idle >= MOST_IDLE ? IN_VAIN : ON;
}

/* Runs rounds from s->t until one gains little or the descent is given up. Returns whether s->t is free of clashes
 * then; if it is not, s->t is the layout with the least violation. */
static bool descend_by_rounds(sunder_i_search *s)
{
    descent d;
    if (!descent_init(&d, s)) s->failed = true;
    /* A pair is eased from a layout without clashes, and a program that knows its price only to first order may end
     * dearer. */
    d.is_free = sunder_i_search_has_prices(s);
    if (d.is_free) d.cost = sunder_i_search_cost(s, s->t);
    outcome last = ON;
    for (int round = 0; round < MOST_ROUNDS && last == ON && !is_out_of_patience(s) && !s->failed; round++)
        last = run_round(&d);
    if (last != SETTLED_DOWN && !d.is_free && d.left < INFINITY && !s->failed)
        memcpy(s->t, d.best, 2 * s->n * sizeof *s->t);
    descent_free(&d);
    return last == SETTLED_DOWN || (d.is_free && !s->failed);
}

bool sunder_i_search_descend(sunder_i_search *search)
{
    const double tolerance = search->tolerance, settled = search->settled;
    search->program.most_cost = sunder_i_search_has_prices(search) ? 0 : most_cost(search);
    if (!descends_coarsely(search)) return descend_by_rounds(search);
    search->tolerance = sunder_i_max(tolerance, ROUGHLY * search->extent);
    search->settled = sunder_i_max(settled, ROUGHLY_SETTLED);
    search->roughly = true;
    const bool found = descend_by_rounds(search);
    search->roughly = false;
    search->tolerance = tolerance;
    search->settled = settled;
    return found && descend_by_rounds(search);
}

bool sunder_i_search_repair(sunder_i_search *search)
{
    double left = INFINITY;
    for (int round = 0; round < MOST_MENDING && left > search->tolerance && !search->failed; round++) {
        sunder_i_search_constrain(search, search->gap / LEAST_REACH, true);
        if (search->failed || !(solve_lazily(search, 0) <= search->tolerance) || is_out_of_patience(search))
            return false;
        left = look_at_end(search);
        memcpy(search->t, search->next, 2 * search->n * sizeof *search->t);
    }
    return left <= search->tolerance && !search->failed;
}

bool sunder_i_search_attempt(sunder_i_search *search, double *best, double *cost)
{
    const size_t size = 2 * search->n * sizeof *best;
    search->hope = *cost;
    search->back = best;
    const bool free_now = sunder_i_search_descend(search);
    search->back = NULL;
    search->hope = INFINITY;
    const double now = sunder_i_search_cost(search, search->t);
    if (!search->failed && free_now && now < *cost * (1 - CHEAPER)) {
        memcpy(best, search->t, size);
        *cost = now;
        return true;
    }
    memcpy(search->t, best, size);
    return false;
}
