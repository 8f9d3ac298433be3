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
#include "base/union_find.h"
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

/* A fixed body stays at its place, which for a neighbour of the cluster may differ from its original one. */
static void keep_still(sunder_i_search *s)
{
    for (size_t k = 0; k < s->n; k++)
        if (!(s->mass[k] > 0)) memcpy(s->next + 2 * k, s->t + 2 * k, 2 * sizeof *s->next);
}

static bool is_out_of_patience(const sunder_i_search *s) { return sunder_i_search_work(s) >= s->patience; }

/* Solves; what long chains leave of the hard constraints is made good by asking for that much more. Returns the
 * violation left. */
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
        for (size_t c = 0; c < p->n; c++) p->constraint[c].d += more;
        v = sunder_i_quadratic_solve(p, 0, s->tolerance / SOLVED_TO, s->extent);
        if (v < 0 || !sunder_i_look()) s->failed = true;
        keep_still(s);
        v = sunder_i_max(0, v - asked);
    }
    return v;
}

/* Solves a hard program again, of which s->next violates only the latest constraints; returns the violation left.
 * With limits the effect of these fades, and the solution is mended. Without limits chains of contacts carry it on,
 * and the layout that a crowd ends in is arbitrary. */
static double solve_further(sunder_i_search *s)
{
    sunder_i_quadratic *p = &s->program;
    if (!(p->most_cost > 0)) return solve_program(s, 0);
    const double v = sunder_i_quadratic_mend(p, s->tolerance / SOLVED_TO, s->extent, s->settled / PART_OF_SETTLED);
    if (v < 0) s->failed = true;
    return v >= 0 && v <= s->tolerance ? v : solve_program(s, 0);
}

/* The program around s->t with everything that its solution runs into. */
static double solve_lazily(sunder_i_search *s, double softness)
{
    double v = 0;
    const int most = softness > 0 ? MOST_SOFT_ADDITIONS : MOST_ADDITIONS;
    s->ended = false;
    for (int k = 0; k < most && !is_out_of_patience(s) && !s->failed; k++) {
        v = k > 0 && softness == 0 ? solve_further(s) : solve_program(s, softness);
        /* No solution: what lies in the way of where it went astray is of no interest. */
        if (softness == 0 && v > NO_SOLUTION * (s->extent + s->gap)) break;
        s->ended = !sunder_i_search_constrain_further(s);
        if (s->ended) break;
    }
    return v;
}

/* Finds the clashes at the end of a program. Usually the last step looked there already and found none: then its result
 * is still valid, and its work is counted once more. */
static double look_at_end(sunder_i_search *s)
{
    if (!s->ended) return sunder_i_search_find_clashes(s, s->next);
    s->steps += s->seen_steps;
    return s->seen;
}

/* Around a position with clashes: solves softly; and then hard, if the violation is small compared with the moves and
 * the hard program turns out to have a solution. */
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
    sunder_i_free(constraint);
    sunder_i_free(next);
    return full;
}

/* The farthest towards s->next that one can go from s->t, which is free, without missing a constraint more than there;
 * for programs that were not solved to the end. The constraints are convex, so the way is free up to there. */
static void stop_short(sunder_i_search *s)
{
    double share = 1;
    for (size_t k = 0; k < s->program.n; k++) {
        const sunder_i_constraint *c = &s->program.constraint[k];
        const double here = sunder_i_stretch(c, s->t) - c->d, there = sunder_i_stretch(c, s->next) - c->d;
        if (there < 0 && there < here) share = sunder_i_min(share, sunder_i_max(0, here) / (here - there));
    }
    for (size_t k = 0; k < 2 * s->n; k++) s->next[k] = s->t[k] + JUST_BEFORE * share * (s->next[k] - s->t[k]);
    s->ended = false;
}

/* Does the program end where a search came from, all but for rounding? Then it would begin there once more. */
static bool is_back(const sunder_i_search *s)
{
    for (size_t k = 0; k < 2 * s->n; k++)
        if (!(fabs(s->next[k] - s->back[k]) <= BACK * s->extent)) return false;
    return true;
}

#ifndef NDEBUG
/* Does s->next miss no constraint by more than s->t, but for rounding? */
static const char *check_next(const sunder_i_search *s)
{
    for (size_t k = 0; k < s->program.n; k++) {
        const sunder_i_constraint *c = &s->program.constraint[k];
        const double here = sunder_i_stretch(c, s->t) - c->d, there = sunder_i_stretch(c, s->next) - c->d;
        if (there < sunder_i_min(0, here) - s->tolerance) return "a way that was free up to there is not";
    }
    return NULL;
}
#endif

/* With all that move at their limits; 0 where one has none. */
static double most_cost(const sunder_i_search *s)
{
    double cost = 0;
    for (uint32_t k = 0; k < s->n; k++) {
        const double limit = sunder_i_search_limit(s, k);
        if (s->mass[k] > 0) cost += limit * limit / (2 * s->mass[k]);
    }
    return cost < INFINITY ? cost : 0;
}

/* ---- The sequence ------------------------------------------------------------------------------------------------ */

/* A way down, between two rounds. */
typedef struct descent {
    sunder_i_search *s;
    double *best;                    /* [2 n] of the places that clash the one that misses least */
    double *lead;                    /* [2 n] of a large crowd; NULL */
    double reach, farthest;          /* how far is looked, and how far at most */
    double cost;                     /* where they stand, once it is free */
    double softness;                 /* of the next compromise */
    double missed, left;             /* the least that a program missed, and that was missed where it ended */
    bool is_free, is_led;            /* where they stand; are the next sides those of `lead`? */
    int clashing, idle, led_in_vain; /* rounds that clashed, that gained nothing on it, and that are not led */
} descent;

/* Within limits ways are short, and what is missed roughly may be all that there is. */
static bool descends_coarsely(const sunder_i_search *s)
{
    if (sunder_i_search_movers(s) <= LARGE_CROWD_LED) return false;
    for (uint32_t k = 0; k < s->n; k++)
        if (s->mass[k] > 0 && sunder_i_search_limit(s, k) < INFINITY) return false;
    return true;
}

static void descent_free(descent *d)
{
    sunder_i_free(d->best);
    sunder_i_free(d->lead);
}

static bool descent_init(descent *d, sunder_i_search *s)
{
    const bool crowd = sunder_i_search_movers(s) > LARGE_CROWD, large = descends_coarsely(s);
    const double part = large ? PART_OF_LARGE_CROWD : crowd ? PART_OF_CROWD : SMALL_PART;
    const double farthest = sunder_i_max(s->gap / 2, s->extent / part);
    /* At least a margin: a body in a free place keeps a hair more than the distance owed from its neighbours. A crowd
     * away from its original place has contacts everywhere. */
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

/* If its steps are free, the next round takes its sides at `lead`: as far beyond s->next as this step was long.
 * Round things roll along each other, so that sides turn a little each round, and always the same way. */
static void lead_on(descent *d, bool is_free)
{
    const sunder_i_search *s = d->s;
    d->is_led = d->lead && d->is_free && is_free && d->led_in_vain == 0;
    if (d->led_in_vain > 0) d->led_in_vain--;
    for (size_t k = 0; k < 2 * s->n && d->is_led; k++) d->lead[k] = s->next[k] + (s->next[k] - s->t[k]);
}

/* It led astray: the next rounds take the sides of where they stand. */
static void lead_no_more(descent *d)
{
    d->is_led = false;
    d->led_in_vain = NOT_LED;
}

/* Solves the program about where they stand. Returns what it misses. */
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

/* Goes to s->next, which is free or not. */
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
    const double left = look_at_end(s), cost = sunder_i_search_cost(s, s->next);
    const bool is_free = left <= s->tolerance, settled = !is_free || cost >= d->cost - s->settled * d->cost;
    if (s->back && is_free && is_back(s)) {
        s->steps += sunder_i_search_work(s) - before; /* the round that would follow; it counts as work */
        return IN_VAIN;
    }
    if (d->is_free && is_free && cost - HOPEFUL * (d->cost - cost) > s->hope) return IN_VAIN;
    if (d->is_led && (settled || v > s->tolerance)) {
        lead_no_more(d);
        if (!is_free || v > s->tolerance || !(cost < d->cost)) return ON;
    } else if (d->is_free && settled) {
        /* The last round; one that ends in a clash was stuck numerically, and what stands is free. */
        if (is_free && cost < d->cost) memcpy(s->t, s->next, 2 * s->n * sizeof *s->t);
        return SETTLED_DOWN;
    }
    take_step(d, is_free, left, cost);
    if (is_free) return ON;
    d->idle = v > d->missed / 2 ? d->idle + 1 : 0;
    d->missed = sunder_i_min(d->missed, v);
    return ++d->clashing >= s->clashing || d->idle >= MOST_IDLE ? IN_VAIN : ON;
}

/* From s->t, to where nothing is gained any more. */
static bool descend_by_rounds(sunder_i_search *s)
{
    descent d;
    if (!descent_init(&d, s)) s->failed = true;
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
    search->program.most_cost = most_cost(search);
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

/* ---- Where it ended in a compromise ------------------------------------------------------------------------------ */

/* The sets of bodies that constraints hold together, by their roots; what does not move joins none. */
static void join_constrained(const sunder_i_search *s, uint32_t *root)
{
    sunder_i_union_init(root, s->n);
    for (size_t k = 0; k < s->program.n; k++) {
        const sunder_i_constraint *c = &s->program.constraint[k];
        if (c->i != SUNDER_I_GROUND && c->j != SUNDER_I_GROUND) sunder_i_union_join(root, c->i, c->j);
    }
}

/* Do they form at most one connected set? */
static bool is_one_component(const sunder_i_search *s, uint32_t *root)
{
    uint32_t first = SUNDER_I_NOBODY;
    for (size_t k = 0; k < s->program.n; k++) {
        const sunder_i_constraint *c = &s->program.constraint[k];
        const uint32_t of = sunder_i_union_find(root, c->j == SUNDER_I_GROUND ? c->i : c->j);
        if (first != SUNDER_I_NOBODY && of != first) return false;
        first = of;
    }
    return true;
}

void sunder_i_search_settle_components(sunder_i_search *search)
{
    uint32_t *root = sunder_i_alloc(search->n, sizeof *root);
    bool *unsolved = sunder_i_calloc(search->n, sizeof *unsolved);
    search->failed = search->failed || !root || !unsolved;
    if (!search->failed) sunder_i_search_constrain(search, search->gap, false);
    if (!search->failed) {
        /* If one part has no solution the others are still solved. */
        join_constrained(search, root);
        search->program.most_cost = is_one_component(search, root) ? most_cost(search) : 0;
        solve_lazily(search, 0);
        join_constrained(search, root);
        for (size_t k = 0; k < search->program.n; k++) {
            const sunder_i_constraint *c = &search->program.constraint[k];
            const uint32_t of = c->j == SUNDER_I_GROUND ? c->i : c->j;
            if (!(sunder_i_stretch(c, search->next) >= c->d - search->tolerance))
                unsolved[sunder_i_union_find(root, of)] = true;
        }
        for (uint32_t k = 0; k < search->n; k++)
            if (search->mass[k] > 0 && !unsolved[sunder_i_union_find(root, k)])
                memcpy(search->t + 2 * k, search->next + 2 * k, 2 * sizeof *search->t);
    }
    sunder_i_free(root);
    sunder_i_free(unsolved);
}

void sunder_i_search_descend_or_stay(sunder_i_search *search)
{
    const size_t size = 2 * search->n * sizeof *search->t;
    double *stand = sunder_i_alloc(2 * search->n, sizeof *stand);
    search->failed = search->failed || !stand;
    if (!search->failed && sunder_i_search_find_clashes(search, search->t) <= search->tolerance) {
        memcpy(stand, search->t, size);
        search->program.n = 0;
        if (!sunder_i_search_descend(search)) memcpy(search->t, stand, size);
    }
    sunder_i_free(stand);
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
