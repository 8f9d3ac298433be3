/* Better sides: from a free start, cheaper places of single bodies and other sides of pairs, while they are found. The
 * order of the stages is a table. */
#include "displacement/layer/stage_table.h"
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

/* As sunder_i_search_attempt(), after only bodies i and j were moved away from `best`. In a large cluster only the
 * bodies around them descend. Returns whether the result is cheaper. */
static bool attempt_about(sunder_i_search *s, uint32_t i, uint32_t j, double *best, double *cost)
{
    if (!s->neighbourhood) return sunder_i_search_attempt(s, best, cost);
    const double gain = sunder_i_neighbourhood_descend(s->neighbourhood, i, j, ABOUT, s->gap + s->extent / ABOUT_REACH,
                                                       best, CHEAPER * *cost);
    if (gain > 0) memcpy(best, s->t, 2 * s->n * sizeof *best);
    *cost -= gain;
    return gain > 0;
}

/* Bodies, or pairs of bodies, whose other places failed since the last gain, and the work spent. They would fail again,
 * so they are skipped, but the work is counted, so that the remaining effort does not change. */
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

/* Notes the result of a try. before: the work at its beginning. */
static void note_try(sunder_i_search *s, vain *v, uint32_t i, uint32_t j, uint64_t before, bool gained)
{
    if (gained) {
        v->n = 0;
        return;
    }
    if (s->neighbourhood) return; /* there are too many to search through, and few repeat */
    if (!sunder_i_reserve(&v->tried, &v->capacity, v->n + 1, sizeof *v->tried)) {
        s->failed = true;
        return;
    }
    v->tried[v->n++] = (struct vain_try){i, j, sunder_i_search_work(s) - before};
}

/* The length of the longest move; *below: the greatest power of two that does not exceed it. */
static double longest_move(const sunder_i_search *s, double *below)
{
    double longest = 0;
    for (size_t k = 0; k < s->n; k++)
        if (s->mass[k] > 0) longest = sunder_i_max(longest, sunder_i_search_stray(s, k));
    int exponent;
    frexp(longest, &exponent);
    *below = ldexp(1, exponent - 1);
    return longest;
}

/* Searches once more from the original places, with all moves limited to the power of two below the longest one. If
 * sides contradict each other the search then ends elsewhere, with bodies nearer to home. That helps only if a body has
 * moved much farther than any pair was in conflict by. In a crowd there is no room nearby. The limit is about the
 * original places, so it is of no use if bodies prefer others. */
static void try_near(sunder_i_search *s, double *best, double *cost)
{
    double below;
    if (s->model->preferred) return;
    const double longest = longest_move(s, &below);
    for (size_t k = 0; k < s->n; k++)
        if (s->mass[k] > 0) s->t[2 * k] = s->t[2 * k + 1] = 0;
    if (longest > FAR * sunder_i_search_find_clashes(s, s->t) && !s->failed) {
        s->cap = below;
        s->patience = sunder_i_search_work(s) + NEAR_PATIENCE + sunder_i_search_work(s) / NEAR_SHARE;
        s->program.n = 0;
        bool found = sunder_i_search_descend(s);
        /* After a jump the bodies have to descend, which needs patience that is left. */
        if (!found && sunder_i_search_work(s) < s->patience && sunder_i_search_jump_soon(s))
            found = sunder_i_search_descend(s);
        s->cap = INFINITY;
        s->patience = UINT64_MAX;
        if (found && sunder_i_search_attempt(s, best, cost)) return;
    }
    memcpy(s->t, best, 2 * s->n * sizeof *best);
}

/* Should further tries follow after in_vain failures in a row? In a small cluster and without limits everything is
 * tried: 53,000 places of Europe cost 2.6 % more otherwise. In a crowd within limits bodies are alike, so if many found
 * no better place the rest will not either. */
static bool is_hopeful(const sunder_i_search *s, size_t in_vain)
{
    return !s->neighbourhood || !(s->program.most_cost > 0) || in_vain < BETTER_IN_VAIN + s->n / BETTER_SHARE;
}

/* Moves body i to the free position nearest to the one it prefers, and descends. Returns whether the result is cheaper.
 * */
static bool try_place(sunder_i_search *s, uint32_t i, double *best, double *cost)
{
    double place[2];
    if (!sunder_i_search_free_body(s, i, NEARER_PLACE * sunder_i_search_stray(s, i), place)) return false;
    memcpy(s->t + 2 * i, place, sizeof place);
    return attempt_about(s, i, i, best, cost);
}

/* Tries each body, the most expensive first, at the free position nearest to the one it prefers. */
static void try_places(sunder_i_search *s, rank *order, vain *v, double *best, double *cost)
{
    size_t n = 0;
    for (uint32_t k = 0; k < s->n; k++) {
        const double c = s->mass[k] > 0 ? sunder_i_search_stray_square(s, k, s->t) / s->mass[k] : 0;
        if (c > 0) order[n++] = (rank){c, k, 0};
    }
    qsort(order, n, sizeof *order, by_cost);
    size_t in_vain = 0; /* failures in a row */
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

/* The pairs in contact, those with the greatest force first. NULL if memory is out. */
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

/* Is a descent from s->t useless? Two bodies were moved to the p-th of their other positions there. If s->t costs less
 * than the best solution, which costs `cost`, it clashes, and usually ends more expensive. If many bodies move, the
 * clash is a small part of the cost, and the answer is no. With proofs all positions are tried. */
static bool is_too_cheap(sunder_i_search *s, size_t p, double cost)
{
    if (sunder_i_search_movers(s) > MOST_FORESEEN || s->model->rules.effort > 0) return false;
    return sunder_i_search_cost(s, s->t) < (p == 0 ? 1 : CHEAP_OTHER) * cost;
}

/* Tries bodies i and j on the other sides of each other, until one leads to a cheaper layout. Returns whether one
 * did. */
static bool try_sides_of(sunder_i_search *s, uint32_t i, uint32_t j, double *best, double *cost)
{
    const double home[2] = {0, 0}, u[2] = {s->t[2 * j] - s->t[2 * i], s->t[2 * j + 1] - s->t[2 * i + 1]};
    const double length = hypot(u[0], u[1]);
    double places[MOST_SIDES][2];
    const size_t found = sunder_i_search_free_pair(s, i, j, home, OTHER_SIDE * length, MOST_SIDES, places);
    for (size_t p = 0; p < found && has_time(s) && !s->failed; p++) {
        if (hypot(places[p][0] - u[0], places[p][1] - u[1]) < OTHER_SIDE * length) continue;
        /* The lighter body moves farther. */
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

/* Tries the pairs in contact on other sides. */
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

/* Tries every place once, then every side once. In a large cluster each is tried with the bodies around it, and all
 * bodies descend after each kind. */
static void try_once(sunder_i_search *s, rank *order, vain *v, double *best, double *cost)
{
    sunder_i_neighbourhood about = {0};
    if (sunder_i_search_movers(s) > MANY) s->neighbourhood = &about;
    if (s->neighbourhood && !sunder_i_neighbourhood_init(&about, s)) s->failed = true;
    const double start = *cost;
    if (!s->failed) try_places(s, order, v, best, cost);
    /* All bodies descend, which also gives the forces, unless these are known from the last full descent and nothing
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

/* Tries places and sides in rounds, until a round gains less than ROUND_GAIN. */
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

/* Is the start without clashes? A loss of margin by rounding is repaired first. */
static bool is_free_start(sunder_i_search *s)
{
    const double missed = sunder_i_search_find_clashes(s, s->t);
    return missed <= s->tolerance || (missed <= MENDED * s->tolerance && !s->failed && sunder_i_search_descend(s));
}

/* ---- The order --------------------------------------------------------------------------------------------------- */

/* The state that the stages share. */
typedef struct improving {
    sunder_i_stage_run run;
    sunder_i_search *s;
    rank *order;            /* [n] scratch */
    double *best, *near;    /* [2 n] the cheapest layout found; one that is found from a start near home */
    double cost, near_cost; /* the costs of both */
    double before;          /* the cost of the layout that the last stages began with */
} improving;

static bool is_to_be_proved(const void *state)
{
    return !sunder_i_search_runs_without_proofs(((const improving *)state)->s);
}

static bool is_no_large_crowd(const void *state)
{
    return sunder_i_search_movers(((const improving *)state)->s) <= LARGE_CROWD;
}

static bool has_gained_near_home(const void *state)
{
    return ((const improving *)state)->near_cost < ((const improving *)state)->before;
}

static bool has_gained(const void *state)
{
    return ((const improving *)state)->cost < ((const improving *)state)->before;
}

/* Without proofs this was done for the first solution. */
static void descend_first(void *state)
{
    improving *x = state;
    sunder_i_search_attempt(x->s, x->best, &x->cost);
}

/* Without proofs this was asked about the first solution. */
static void ask_whether_cheapest(void *state)
{
    improving *x = state;
    x->run.over = sunder_i_search_is_cheapest(x->s);
    if (x->run.over) memcpy(x->best, x->s->t, 2 * x->s->n * sizeof *x->best);
}

static void try_best(void *state)
{
    improving *x = state;
    memcpy(x->near, x->best, 2 * x->s->n * sizeof *x->near);
    x->before = x->near_cost = x->cost;
    try_all(x->s, x->order, x->best, &x->cost);
}

static void start_near_home(void *state)
{
    improving *x = state;
    memcpy(x->s->t, x->near, 2 * x->s->n * sizeof *x->near);
    try_near(x->s, x->near, &x->near_cost);
}

static void try_near_home(void *state)
{
    improving *x = state;
    try_all(x->s, x->order, x->near, &x->near_cost);
}

static void reorder(void *state)
{
    improving *x = state;
    const size_t size = 2 * x->s->n * sizeof *x->best;
    if (x->near_cost < x->cost) {
        memcpy(x->best, x->near, size);
        x->cost = x->near_cost;
    }
    memcpy(x->s->t, x->best, size);
    x->before = x->cost;
    sunder_i_search_reorder(x->s, x->best, &x->cost);
}

/* Places and sides are tried from the layout itself, and from a start that keeps all bodies near home; the cheaper
 * result is reordered. The budget of a stage is in tuning.h. */
static const sunder_i_stage stages[] = {
    {"descend", NULL, descend_first, 0},
    {"ask whether cheapest", is_to_be_proved, ask_whether_cheapest, 0},
    {"try places and sides", NULL, try_best, 0},
    {"start near home", is_no_large_crowd, start_near_home, 0},
    {"try places and sides", has_gained_near_home, try_near_home, 0},
    {"reorder", NULL, reorder, 0},
    {"try places and sides", has_gained, try_best, 0},
};

static const char *look(const void *state, const double before[2], double now[2])
{
    const improving *x = state;
    (void)before;
    now[0] = sunder_i_min(x->cost, x->near_cost);
    now[1] = 0;
    return "cheaper";
}

static const sunder_i_stage_table table = {"improve", stages, sizeof stages / sizeof *stages, look};

/* From the free layout s->t to the cheapest layout found, which becomes x->best. */
static sunder_status improve_layout(improving *x)
{
    memcpy(x->best, x->s->t, 2 * x->s->n * sizeof *x->best);
    x->cost = sunder_i_search_cost(x->s, x->s->t);
    x->near_cost = INFINITY;
    return sunder_i_stages_run(&table, x);
}

sunder_status sunder_i_cluster_improve(const sunder_i_model *model, sunder_i_cluster *cluster, double *move,
                                       sunder_error *err)
{
    sunder_i_search s;
    bool ok = sunder_i_search_init_about(&s, model, cluster, move);
    improving x = {.run = {.log = sunder_i_is_traced(model) ? &cluster->log : NULL, .failed = &s.failed, .err = err},
                   .s = &s,
                   .order = sunder_i_alloc(s.n, sizeof *x.order),
                   .best = sunder_i_alloc(2 * s.n, sizeof *x.best),
                   .near = sunder_i_alloc(2 * s.n, sizeof *x.near)};
    ok = ok && x.best && x.near && x.order;
    if (ok) {
        s.settled = SETTLED_BETTER;
        s.effort = BETTER_EFFORT * (uint64_t)cluster->n;
        if (s.effort > BETTER_MOST) s.effort = BETTER_MOST;
        const double before = sunder_i_search_cost(&s, s.t);
        if (is_free_start(&s)) {
            ok = !improve_layout(&x);
            memcpy(s.t, x.best, 2 * s.n * sizeof *x.best);
            const bool cheaper = sunder_i_search_cost(&s, x.best) < before;
            s.n = cluster->n;
            if (cheaper && ok && !s.failed) sunder_i_search_round(&s, move);
        }
    }
    ok = ok && !s.failed;
    sunder_i_search_free(&s);
    sunder_i_free_all(x.best, x.near, x.order);
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
