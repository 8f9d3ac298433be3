/* Better sides: from a free start, cheaper places of single bodies and other sides of pairs, while they are found. */
#include "displacement/solve/search/neighbourhood.h"
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct rank {
    double cost;
    uint32_t index, other;
} rank;

static int by_cost(const void *a, const void *b)
{
    const rank *p = a, *q = b;
    if (p->cost != q->cost) return p->cost > q->cost ? -1 : 1;
    if (p->index != q->index) return p->index < q->index ? -1 : 1;
    return p->other < q->other ? -1 : p->other > q->other;
}

static bool has_time(const sunder_i_search *s) { return sunder_i_search_work(s) < s->effort; }

/* The same after bodies i and j alone were put elsewhere. In a large cluster only those about them go down with
 * them. */
static bool attempt_about(sunder_i_search *s, uint32_t i, uint32_t j, double *best, double *cost)
{
    if (!s->neighbourhood) return sunder_i_search_attempt(s, best, cost);
    const double gain = sunder_i_neighbourhood_descend(s->neighbourhood, i, j, ABOUT, s->gap + s->extent / ABOUT_REACH,
                                                       best, CHEAPER * *cost);
    if (gain > 0) memcpy(best, s->t, 2 * s->n * sizeof *best);
    *cost -= gain;
    return gain > 0;
}

/* Bodies, or pairs of them, whose other places failed since the last gain, and the work it took: they would fail again.
 * Skipping them counts as the same work, so that the remaining effort is the same. */
typedef struct vain {
    struct vain_try {
        uint32_t i, j;
        uint64_t work;
    } * tried;
    size_t n, capacity;
} vain;

static bool was_in_vain(sunder_i_search *s, const vain *v, uint32_t i, uint32_t j)
{
    for (size_t k = 0; k < v->n; k++) {
        if (v->tried[k].i != i || v->tried[k].j != j) continue;
        s->steps += v->tried[k].work;
        return true;
    }
    return false;
}

/* before: the work when it began. */
static void note_try(sunder_i_search *s, vain *v, uint32_t i, uint32_t j, uint64_t before, bool gained)
{
    if (gained) {
        v->n = 0;
        return;
    }
    if (s->neighbourhood) return; /* too many to look through, and seldom twice */
    if (!sunder_i_reserve(&v->tried, &v->capacity, v->n + 1, sizeof *v->tried)) {
        s->failed = true;
        return;
    }
    v->tried[v->n++] = (struct vain_try){i, j, sunder_i_search_work(s) - before};
}

/* The longest move, and the power of two below it. */
static double longest_move(const sunder_i_search *s, double *below)
{
    double longest = 0;
    for (size_t k = 0; k < s->n; k++)
        if (s->mass[k] > 0) longest = sunder_i_max(longest, hypot(s->t[2 * k], s->t[2 * k + 1]));
    int exponent;
    frexp(longest, &exponent);
    *below = ldexp(1, exponent - 1);
    return longest;
}

/* Once more from the original places, with no move longer than the power of two below the longest. Where sides
 * contradict each other the search then ends elsewhere: bodies that were sent far stay near if possible. That can only
 * help if a body has moved much farther than any pair was in conflict; and not in a crowd, where no body has room
 * nearer by. */
static void try_near(sunder_i_search *s, double *best, double *cost)
{
    double below;
    const double longest = longest_move(s, &below);
    for (size_t k = 0; k < s->n; k++)
        if (s->mass[k] > 0) s->t[2 * k] = s->t[2 * k + 1] = 0;
    if (longest > FAR * sunder_i_search_find_clashes(s, s->t) && !s->failed) {
        s->cap = below;
        s->patience = sunder_i_search_work(s) + NEAR_PATIENCE + sunder_i_search_work(s) / NEAR_SHARE;
        s->program.n = 0;
        bool found = sunder_i_search_descend(s);
        /* A body that jumps would have to descend, too, which fails without patience. */
        if (!found && sunder_i_search_work(s) < s->patience && sunder_i_search_jump_soon(s))
            found = sunder_i_search_descend(s);
        s->cap = INFINITY;
        s->patience = UINT64_MAX;
        if (found && sunder_i_search_attempt(s, best, cost)) return;
    }
    memcpy(s->t, best, 2 * s->n * sizeof *best);
}

/* Is it worth going on? In a small cluster everything is tried, and in one without limits: 53,000 places of Europe cost
 * 2.6 % more otherwise. In a crowd within limits bodies are alike, and if this many before found no better place the
 * rest will not either. */
static bool is_hopeful(const sunder_i_search *s, size_t in_vain)
{
    return !s->neighbourhood || !(s->program.most_cost > 0) || in_vain < BETTER_IN_VAIN + s->n / BETTER_SHARE;
}

/* Body i put to the free place nearest to where it came from: is it cheaper? */
static bool try_place(sunder_i_search *s, uint32_t i, double *best, double *cost)
{
    double place[2];
    if (!sunder_i_search_free_body(s, i, NEARER_PLACE * hypot(s->t[2 * i], s->t[2 * i + 1]), place)) return false;
    memcpy(s->t + 2 * i, place, sizeof place);
    return attempt_about(s, i, i, best, cost);
}

/* Each body in turn, the costliest first, to the free place nearest to where it came from, the others standing. */
static void try_places(sunder_i_search *s, rank *order, vain *v, double *best, double *cost)
{
    size_t n = 0;
    for (uint32_t k = 0; k < s->n; k++) {
        const double c =
            s->mass[k] > 0 ? (s->t[2 * k] * s->t[2 * k] + s->t[2 * k + 1] * s->t[2 * k + 1]) / s->mass[k] : 0;
        if (c > 0) order[n++] = (rank){c, k, 0};
    }
    qsort(order, n, sizeof *order, by_cost);
    size_t in_vain = 0; /* one after the other */
    for (size_t k = 0; k < n && is_hopeful(s, in_vain) && has_time(s) && !s->failed; k++) {
        const uint32_t i = order[k].index;
        in_vain++;
        if (was_in_vain(s, v, i, i)) continue;
        const uint64_t before = sunder_i_search_work(s);
        const bool gained = try_place(s, i, best, cost);
        note_try(s, v, i, i, before, gained);
        if (gained) in_vain = 0;
    }
}

static int by_places(const void *a, const void *b)
{
    const rank *p = a, *q = b;
    if (p->index != q->index) return p->index < q->index ? -1 : 1;
    if (p->other != q->other) return p->other < q->other ? -1 : 1;
    return p->cost < q->cost ? -1 : p->cost > q->cost;
}

/* The pairs in contact, those that press hardest first. NULL if memory is out. */
static rank *rank_contacts(const sunder_i_quadratic *program, size_t *n)
{
    rank *order = sunder_i_alloc(program->n, sizeof *order);
    size_t contacts = 0;
    *n = 0;
    if (!order) return NULL;
    for (size_t k = 0; k < program->n; k++) {
        const sunder_i_constraint *c = &program->constraint[k];
        if (!(c->force > 0) || c->i == SUNDER_I_GROUND || c->j == SUNDER_I_GROUND) continue;
        order[contacts++] = (rank){c->force * c->d, c->i, c->j};
    }
    if (contacts) qsort(order, contacts, sizeof *order, by_places);
    for (size_t k = 0; k < contacts; k++) {
        if (*n && order[*n - 1].index == order[k].index && order[*n - 1].other == order[k].other)
            order[*n - 1].cost += order[k].cost;
        else
            order[(*n)++] = order[k];
    }
    if (*n) qsort(order, *n, sizeof *order, by_cost);
    return order;
}

/* Does it lead nowhere to go down from here, where the two stand at the p-th of their places from home? All together
 * cost less than in the solution that is to be bettered, and clash, which has a price. Where many move that price is a
 * small part of the cost. What proofs begin from is sought from all places. */
static bool is_too_cheap(const sunder_i_search *s, size_t p, double cost)
{
    if (sunder_i_search_movers(s) > MOST_FORESEEN || s->model->rules.effort > 0) return false;
    return sunder_i_search_cost(s, s->t) < (p == 0 ? 1 : CHEAP_OTHER) * cost;
}

/* Bodies i and j put to their other sides, one after the other, until one is cheaper. */
static bool try_sides_of(sunder_i_search *s, uint32_t i, uint32_t j, double *best, double *cost)
{
    const double home[2] = {0, 0}, u[2] = {s->t[2 * j] - s->t[2 * i], s->t[2 * j + 1] - s->t[2 * i + 1]};
    const double length = hypot(u[0], u[1]);
    double places[MOST_SIDES][2];
    const size_t found = sunder_i_search_free_pair(s, i, j, home, OTHER_SIDE * length, MOST_SIDES, places);
    for (size_t p = 0; p < found && has_time(s) && !s->failed; p++) {
        if (hypot(places[p][0] - u[0], places[p][1] - u[1]) < OTHER_SIDE * length) continue;
        /* The lighter goes farther. */
        const double share = s->mass[j] / (s->mass[i] + s->mass[j]);
        for (int c = 0; c < 2; c++) {
            const double change = places[p][c] - u[c];
            s->t[2 * j + (uint32_t)c] += share * change;
            s->t[2 * i + (uint32_t)c] -= (1 - share) * change;
        }
        if (is_too_cheap(s, p, *cost))
            memcpy(s->t, best, 2 * s->n * sizeof *best);
        else if (attempt_about(s, i, j, best, cost))
            return true;
    }
    return false;
}

/* Pairs in contact put to their other sides. */
static void try_sides(sunder_i_search *s, vain *v, double *best, double *cost)
{
    size_t n;
    rank *order = rank_contacts(&s->program, &n);
    s->failed = s->failed || !order;
    size_t in_vain = 0;
    for (size_t k = 0; k < n && is_hopeful(s, in_vain) && has_time(s) && !s->failed; k++) {
        const uint32_t i = order[k].index, j = order[k].other;
        in_vain++;
        if (was_in_vain(s, v, i, j)) continue;
        const uint64_t before = sunder_i_search_work(s);
        const bool gained = try_sides_of(s, i, j, best, cost);
        note_try(s, v, i, j, before, gained);
        if (gained) in_vain = 0;
    }
    sunder_i_free(order);
}

/* Every place once, then every side once; in a large cluster with those about each only, after which all go down. */
static void try_once(sunder_i_search *s, rank *order, vain *v, double *best, double *cost)
{
    sunder_i_neighbourhood about = {0};
    if (sunder_i_search_movers(s) > MANY) s->neighbourhood = &about;
    if (s->neighbourhood && !sunder_i_neighbourhood_init(&about, s)) s->failed = true;
    const double start = *cost;
    if (!s->failed) try_places(s, order, v, best, cost);
    /* All bodies descend, which also gives the forces; unless these are known from the last full descent, and nothing
     * has moved since. */
    if (s->neighbourhood && !s->failed && (*cost < start || s->program.n == 0)) sunder_i_search_attempt(s, best, cost);
    if (!s->neighbourhood && !s->failed) {
        sunder_i_search_descend(s);
        memcpy(s->t, best, 2 * s->n * sizeof *best);
    }
    const double before = *cost;
    if (has_time(s) && !s->failed) try_sides(s, v, best, cost);
    if (s->neighbourhood && *cost < before && !s->failed) sunder_i_search_attempt(s, best, cost);
    s->neighbourhood = NULL;
    sunder_i_neighbourhood_free(&about);
}

/* Places and sides in turn, until a round of both gains little. */
static void try_all(sunder_i_search *s, rank *order, double *best, double *cost)
{
    vain v = {0};
    const int most = sunder_i_search_runs_without_proofs(s) ? BETTER_ROUNDS_SOON : BETTER_ROUNDS;
    for (int round = 0; round < most && has_time(s) && !s->failed; round++) {
        const double start = *cost;
        try_once(s, order, &v, best, cost);
        if (!(*cost < start * (1 - ROUND_GAIN))) break;
    }
    sunder_i_free(v.tried);
}

/* Does it stand without clashes? What rounding took of the margin is made good first. */
static bool is_free_start(sunder_i_search *s)
{
    const double missed = sunder_i_search_find_clashes(s, s->t);
    return missed <= s->tolerance || (missed <= MENDED * s->tolerance && !s->failed && sunder_i_search_descend(s));
}

/* From s->t, which is free, to the cheapest that is found, in best; near is scratch of the same size. */
static void improve_layout(sunder_i_search *s, rank *order, double *best, double *near)
{
    const size_t size = 2 * s->n * sizeof *best;
    memcpy(best, s->t, size);
    double cost = sunder_i_search_cost(s, s->t);
    sunder_i_search_attempt(s, best, &cost); /* otherwise it was tested for the first solution */
    if (!sunder_i_search_runs_without_proofs(s) &&
        sunder_i_search_is_cheapest(s)) { /* else done for the first solution */
        memcpy(best, s->t, size);
        return;
    }
    /* Descends from here, and from a start that keeps all bodies near, and keeps the cheaper of the two ends. */
    memcpy(near, best, size);
    double near_cost = cost;
    const double start = cost;
    try_all(s, order, best, &cost);
    memcpy(s->t, near, size);
    if (sunder_i_search_movers(s) <= LARGE_CROWD) try_near(s, near, &near_cost);
    if (near_cost < start) try_all(s, order, near, &near_cost);
    if (near_cost < cost) {
        memcpy(best, near, size);
        cost = near_cost;
    }
    memcpy(s->t, best, size);
    const double ordered = cost;
    sunder_i_search_reorder(s, best, &cost);
    if (cost < ordered) try_all(s, order, best, &cost);
}

sunder_status sunder_i_cluster_improve(const sunder_i_model *model, const sunder_i_cluster *cluster, double *move,
                                       sunder_error *err)
{
    sunder_i_search s;
    bool ok = sunder_i_search_init_about(&s, model, cluster, move);
    double *best = sunder_i_alloc(2 * s.n, sizeof *best), *near = sunder_i_alloc(2 * s.n, sizeof *near);
    rank *order = sunder_i_alloc(s.n, sizeof *order);
    if (ok && best && near && order) {
        s.settled = SETTLED_BETTER;
        s.effort = BETTER_EFFORT * (uint64_t)cluster->n;
        if (s.effort > BETTER_MOST) s.effort = BETTER_MOST;
        const double before = sunder_i_search_cost(&s, s.t);
        if (is_free_start(&s)) {
            improve_layout(&s, order, best, near);
            memcpy(s.t, best, 2 * s.n * sizeof *best);
            const bool cheaper = sunder_i_search_cost(&s, best) < before;
            s.n = cluster->n;
            if (cheaper && !s.failed) sunder_i_search_round(&s, move);
        }
    }
    ok = ok && best && near && order && !s.failed;
    sunder_i_search_free(&s);
    sunder_i_free(best);
    sunder_i_free(near);
    sunder_i_free(order);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

sunder_status sunder_i_cluster_descend(const sunder_i_model *model, const sunder_i_cluster *cluster, double cost,
                                       double *move, bool *found, sunder_error *err)
{
    sunder_i_search s;
    bool ok = sunder_i_search_init_about(&s, model, cluster, move);
    *found = false;
    if (ok) {
        s.settled = SETTLED_BEST;
        *found = sunder_i_search_descend(&s) && sunder_i_search_cost(&s, s.t) < cost;
        s.n = cluster->n;
        if (*found && !s.failed) sunder_i_search_round(&s, move);
    }
    ok = ok && !s.failed;
    sunder_i_search_free(&s);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}
