/* The sequence of quadratic programs.
 *
 * Around a reference position each pair of convex pieces gives one support constraint (obstacle.c). Its direction is
 * that of the nearest point where the pair stands free; where two bodies clash the directions are taken where the pair
 * would stand if the least translation from here had parted it, so that all pieces of the pair agree on the side. The
 * program's solution is feasible for the true shapes, since support constraints are global; from a feasible position
 * every round is feasible and no dearer than the last. Pieces farther off than the reach are left out until they are
 * found in the way.
 *
 * Pairs that clash may ask for contradictory sides. Then the program is solved softly, and the compromise is the next
 * reference position. */
#include "displacement/search/stages.h"
#include "displacement/search/tuning.h"

#include "base/invariant.h"
#include "base/union_find.h"
#include "base/watch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Constraints ------------------------------------------------------------------------------------------------- */

int sunder_i_by_constraint(const void *a, const void *b)
{
    const sunder_i_constraint *c = a, *d = b;
    return c->key < d->key ? -1 : c->key > d->key;
}

static const sunder_i_constraint *look_up(const sunder_i_constraint *c, size_t n, uint64_t key)
{
    const sunder_i_constraint wanted = {.key = key};
    return n ? bsearch(&wanted, c, n, sizeof *c, sunder_i_by_constraint) : NULL;
}

/* Pieces of one wall give the same line many times. */
void sunder_i_search_add_constraint(sunder_i_search *s, size_t first, const sunder_i_constraint *c)
{
    sunder_i_quadratic *p = &s->program;
    for (size_t k = first; k < p->n; k++) {
        sunder_i_constraint *other = &p->constraint[k];
        if (fabs(other->n[0] - c->n[0]) > SAME_NORMAL || fabs(other->n[1] - c->n[1]) > SAME_NORMAL) continue;
        if (other->d < c->d) {
            const double force = other->force + c->force;
            *other = *c;
            other->force = force;
        }
        return;
    }
    if (!sunder_i_reserve(&p->constraint, &p->capacity, p->n + 1, sizeof *p->constraint)) {
        s->failed = true;
        return;
    }
    p->constraint[p->n++] = *c;
}

/* The constraints of pair (i, j): of the pieces that stand no farther apart than gap + reach at relative position near,
 * with the sides of position u. Those that `known` holds are left as they are. */
typedef struct sighting {
    const double *near, *u;
    double reach;
    bool yields;
    const sunder_i_constraint *known;
    size_t known_n;
} sighting;

typedef struct sighted {
    const sighting *at;
    uint32_t i, j;
    size_t first; /* of the pair's constraints */
} sighted;

static void constrain_part(sunder_i_search *s, const sunder_i_piece_pair *part, void *context)
{
    const sighted *pair = context;
    const sighting *at = pair->at;
    if (look_up(at->known, at->known_n, part->key)) return;
    double gap;
    size_t n;
    const sunder_i_obstacle_edge *edge = sunder_i_search_edges(s, part, &n, &gap);
    if (!edge) return;
    sunder_i_support h = sunder_i_search_support(part, edge, n, at->near);
    if (h.distance > (part->shadow ? gap : fmax(s->gap, gap)) + at->reach) return;
    if (at->near != at->u) h = sunder_i_search_support(part, edge, n, at->u);
    const sunder_i_constraint *before = look_up(s->old, s->old_n, part->key);
    double d = h.support + gap;
    /* What the position misses by less than counts as a miss is forgiven: else an exact fit, missed by a hair on two
     * sides, would be a contradiction. */
    const double now = h.n[0] * at->u[0] + h.n[1] * at->u[1];
    if (now < d && now >= d - s->tolerance) d = now;
    /* What does not move counts where it stands. */
    uint32_t ends[2] = {pair->i, pair->j};
    for (int e = 0; e < 2; e++) {
        const double *t = s->t + 2 * ends[e];
        if (s->mass[ends[e]] > 0) continue;
        d += (e ? -1 : 1) * (h.n[0] * t[0] + h.n[1] * t[1]);
        ends[e] = SUNDER_I_GROUND;
    }
    sunder_i_search_add_constraint(s, pair->first,
                                   &(sunder_i_constraint){.i = ends[0],
                                                          .j = ends[1],
                                                          .n = {h.n[0], h.n[1]},
                                                          .d = d,
                                                          .force = before ? before->force : 0,
                                                          .key = part->key});
}

static void constrain_pair(sunder_i_search *s, uint32_t i, uint32_t j, const sighting *at)
{
    sighted pair = {at, i, j, s->program.n};
    sunder_i_search_piece_pairs(s, i, j, at->near, at->reach + s->gap, at->yields, constrain_part, &pair);
}

typedef struct around {
    const double *t;
    double reach;
    bool as_it_stands; /* whatever clashes is parted where it stands: it misses a hair */
    bool clashing;
} around;

static void constrain(sunder_i_search *s, uint32_t i, uint32_t j, void *context)
{
    around *a = context;
    double u[2] = {a->t[2 * j] - a->t[2 * i], a->t[2 * j + 1] - a->t[2 * i + 1]};
    bool yields;
    if (sunder_i_search_pair(s, i, j, u, &yields) > s->tolerance) {
        a->clashing = true;
        double place[1][2];
        if (!a->as_it_stands && sunder_i_search_free_pair(s, i, j, u, 0, 1, place)) memcpy(u, place[0], sizeof u);
    }
    constrain_pair(s, i, j, &(sighting){u, u, a->reach, yields, NULL, 0});
}

/* Mostly they are sorted already. */
static void sort_constraints(sunder_i_search *s)
{
    const sunder_i_constraint *c = s->program.constraint;
    size_t k = 1;
    while (k < s->program.n && c[k - 1].key <= c[k].key) k++;
    if (k < s->program.n)
        qsort(s->program.constraint, s->program.n, sizeof *s->program.constraint, sunder_i_by_constraint);
}

/* All constraints around t. Returns whether a pair clashes there, or a limit is overstepped. */
static bool constrain_all(sunder_i_search *s, double reach, bool as_it_stands)
{
    sunder_i_quadratic *p = &s->program;
    /* The last round's constraints become the old ones. */
    sunder_i_constraint *swap = s->old;
    const size_t capacity = s->old_capacity;
    s->old = p->constraint;
    s->old_n = p->n;
    s->old_capacity = p->capacity;
    p->constraint = swap;
    p->capacity = capacity;
    p->n = 0;
    around a = {.t = s->t, .reach = reach, .as_it_stands = as_it_stands};
    sunder_i_search_near(s, s->t, s->gap + reach, constrain, &a);
    sunder_i_search_passing(s, s->t, s->gap + reach, constrain, &a);
    for (size_t k = 0; k < s->old_n && !s->failed; k++)
        if (sunder_i_is_tangent(&s->old[k]) && s->old[k].force > 0) sunder_i_search_add_constraint(s, p->n, &s->old[k]);
    sort_constraints(s);
    memcpy(s->next, s->t, 2 * s->n * sizeof *s->t); /* who is out of patience by now stays where it stands */
    return a.clashing || sunder_i_search_is_beyond(s, s->t);
}

/* ---- Solving one program ----------------------------------------------------------------------------------------- */

static double longest_step(const sunder_i_search *s)
{
    double longest = 0;
    for (size_t k = 0; k < 2 * s->n; k++) longest = fmax(longest, fabs(s->next[k] - s->t[k]));
    return longest;
}

static bool is_crowd(const sunder_i_search *s)
{
    size_t movers = 0;
    for (size_t k = 0; k < s->n; k++) movers += s->mass[k] > 0;
    return movers > LARGE_CROWD;
}

static double longest_move(const sunder_i_search *s)
{
    double longest = 0;
    for (size_t k = 0; k < 2 * s->n; k++) longest = fmax(longest, fabs(s->next[k]));
    return longest;
}

/* What does not move stays where it stands, which for a neighbour of the cluster need not be where it came from. */
static void keep_still(sunder_i_search *s)
{
    for (size_t k = 0; k < s->n; k++)
        if (!(s->mass[k] > 0)) memcpy(s->next + 2 * k, s->t + 2 * k, 2 * sizeof *s->next);
}

static bool is_out_of_patience(const sunder_i_search *s) { return sunder_i_search_work(s) >= s->patience; }

/* Solves; what long chains leave of the hard constraints is made good by asking for that much more. Returns the
 * violation left. */
static double solve(sunder_i_search *s, double softness)
{
    sunder_i_quadratic *p = &s->program;
    const double hurry =
        fmax(s->tolerance / SOLVED_TO, softness > 0 ? COMPROMISE_TO * fmax(s->gap, s->extent / SMALL_PART) : 0);
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
        v = fmax(0, v - asked);
    }
    return v;
}

/* The program around s->t with everything that its solution runs into. */
static double solve_lazily(sunder_i_search *s, double softness)
{
    double v = 0;
    const int most = softness > 0 ? MOST_SOFT_ADDITIONS : MOST_ADDITIONS;
    for (int k = 0; k < most && !is_out_of_patience(s) && !s->failed; k++) {
        v = solve(s, softness);
        /* No solution: what lies in the way of where it went astray is of no interest. */
        if (softness == 0 && v > NO_SOLUTION * (s->extent + s->gap)) break;
        bool more = sunder_i_search_constrain_limits(s);
        sort_constraints(s);
        const size_t before = s->program.n;
        sunder_i_constraint *known = sunder_i_alloc(before, sizeof *known);
        if (!known) {
            s->failed = true;
            break;
        }
        if (before) memcpy(known, s->program.constraint, before * sizeof *known);
        /* Pieces in the way that no constraint knows of: their sides are those of the reference position, where they
         * stood apart. */
        sunder_i_search_look(s, s->next);
        const size_t clashes = s->clashes;
        for (size_t c = 0; c < clashes && !s->failed; c++) {
            const uint32_t i = s->clash[c].i, j = s->clash[c].j;
            double u[2] = {s->t[2 * j] - s->t[2 * i], s->t[2 * j + 1] - s->t[2 * i + 1]};
            bool yields;
            if (sunder_i_search_pair(s, i, j, u, &yields) > s->tolerance) continue;
            const double w[2] = {s->next[2 * j] - s->next[2 * i], s->next[2 * j + 1] - s->next[2 * i + 1]};
            constrain_pair(s, i, j, &(sighting){w, u, -s->tolerance, yields, known, before});
        }
        more = more || s->program.n > before;
        sunder_i_free(known);
        sort_constraints(s);
        if (!more) break;
    }
    return v;
}

/* Around a position with clashes: softly; and in full, if what is missed is little beside how far things go and the
 * full program turns out to have a solution. */
static double compromise(sunder_i_search *s, double softness)
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
        if (there < 0 && there < here) share = fmin(share, fmax(0, here) / (here - there));
    }
    for (size_t k = 0; k < 2 * s->n; k++) s->next[k] = s->t[k] + JUST_BEFORE * share * (s->next[k] - s->t[k]);
}

#ifndef NDEBUG
/* Does s->next miss no constraint by more than s->t, but for rounding? */
static const char *check_next(const sunder_i_search *s)
{
    for (size_t k = 0; k < s->program.n; k++) {
        const sunder_i_constraint *c = &s->program.constraint[k];
        const double here = sunder_i_stretch(c, s->t) - c->d, there = sunder_i_stretch(c, s->next) - c->d;
        if (there < fmin(0, here) - s->tolerance) return "a way that was free up to there is not";
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

bool sunder_i_search_descend(sunder_i_search *s)
{
    s->program.most_cost = most_cost(s);
    /* At least a margin: who was put in a free place stands beside its pieces, a hair farther than is asked. */
    double reach = fmax(s->gap, 4 * s->tolerance), cost = INFINITY, softness = SOFT;
    const double longest_reach = fmax(s->gap / 2, s->extent / (is_crowd(s) ? PART_OF_CROWD : SMALL_PART));
    bool free_now = false;
    int clashing_rounds = 0, idle = 0;
    double least_missed = INFINITY, least_left = INFINITY;
    double *best = sunder_i_alloc(2 * s->n, sizeof *best);
    if (!best) s->failed = true;
    for (int round = 0; round < MOST_ROUNDS && !is_out_of_patience(s) && !s->failed; round++) {
        const bool clashing = constrain_all(s, reach, false);
        if (s->failed) break;
        double v;
        if (clashing) {
            v = compromise(s, softness);
            softness = fmax(softness / HARDENING, HARDEST);
        } else {
            v = solve_lazily(s, 0);
            if (v > s->tolerance) {
                stop_short(s);
                SUNDER_I_CHECK(check_next(s), s->n);
            }
        }
        if (s->failed) break;
        const double left = sunder_i_search_look(s, s->next);
        const bool free_next = left <= s->tolerance;
        const double next_cost = sunder_i_search_cost(s, s->next);
        const double step = longest_step(s);
        if (free_now && free_next && next_cost - HOPEFUL * (cost - next_cost) > s->hope) break;
        if (free_now && (!free_next || next_cost >= cost - s->settled * cost)) {
            /* The last round; one that ends in a clash was stuck numerically, and what stands is free. */
            if (free_next && next_cost < cost) memcpy(s->t, s->next, 2 * s->n * sizeof *s->t);
            sunder_i_free(best);
            return true;
        }
        memcpy(s->t, s->next, 2 * s->n * sizeof *s->t);
        if (!free_next && left < least_left) {
            least_left = left;
            memcpy(best, s->t, 2 * s->n * sizeof *best);
        }
        free_now = free_next;
        cost = next_cost;
        reach = fmin(fmax(STEPS_AHEAD * step, s->gap / LEAST_REACH), longest_reach);
        if (free_now) continue;
        idle = v > least_missed / 2 ? idle + 1 : 0;
        least_missed = fmin(least_missed, v);
        if (++clashing_rounds >= MOST_CLASHING || idle >= MOST_IDLE) break;
    }
    if (!free_now && least_left < INFINITY && !s->failed) {
        memcpy(s->t, best, 2 * s->n * sizeof *best);
    }
    sunder_i_free(best);
    return free_now && !s->failed;
}

bool sunder_i_search_make_good(sunder_i_search *s)
{
    double left = INFINITY;
    for (int round = 0; round < MOST_MENDING && left > s->tolerance && !s->failed; round++) {
        constrain_all(s, s->gap / LEAST_REACH, true);
        if (s->failed || !(solve_lazily(s, 0) <= s->tolerance) || is_out_of_patience(s)) return false;
        left = sunder_i_search_look(s, s->next);
        memcpy(s->t, s->next, 2 * s->n * sizeof *s->t);
    }
    return left <= s->tolerance && !s->failed;
}

/* ---- Where it ended in a compromise -------------------------------------------------------------------------------
 * */

/* The sets of bodies that constraints hold together, by their roots; what does not move joins none. */
static void join_constrained(const sunder_i_search *s, uint32_t *root)
{
    sunder_i_union_init(root, s->n);
    for (size_t k = 0; k < s->program.n; k++) {
        const sunder_i_constraint *c = &s->program.constraint[k];
        if (c->i != SUNDER_I_GROUND && c->j != SUNDER_I_GROUND) sunder_i_union_join(root, c->i, c->j);
    }
}

/* Do they make no more than one set? */
static bool is_one_part(const sunder_i_search *s, uint32_t *root)
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

void sunder_i_search_settle_parts(sunder_i_search *s)
{
    uint32_t *root = sunder_i_alloc(s->n, sizeof *root);
    bool *unsolved = sunder_i_calloc(s->n, sizeof *unsolved);
    s->failed = s->failed || !root || !unsolved;
    if (!s->failed) constrain_all(s, s->gap, false);
    if (!s->failed) {
        /* Where one part has no solution the others are to be solved all the same. */
        join_constrained(s, root);
        s->program.most_cost = is_one_part(s, root) ? most_cost(s) : 0;
        solve_lazily(s, 0);
        join_constrained(s, root);
        for (size_t k = 0; k < s->program.n; k++) {
            const sunder_i_constraint *c = &s->program.constraint[k];
            const uint32_t of = c->j == SUNDER_I_GROUND ? c->i : c->j;
            if (!(sunder_i_stretch(c, s->next) >= c->d - s->tolerance)) unsolved[sunder_i_union_find(root, of)] = true;
        }
        for (uint32_t k = 0; k < s->n; k++)
            if (s->mass[k] > 0 && !unsolved[sunder_i_union_find(root, k)])
                memcpy(s->t + 2 * k, s->next + 2 * k, 2 * sizeof *s->t);
    }
    sunder_i_free(root);
    sunder_i_free(unsolved);
}
