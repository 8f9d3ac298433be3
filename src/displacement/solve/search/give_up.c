/* Clusters without a solution: because of limits, fixed bodies, or lack of room. The order of the stages is a table.
 *
 * Pairs that clash at the end, and clash in the original places, are relaxed (relaxation.c), a few at a time: all
 * others keep their full distance, and relaxed ones stand no worse than at the start. The compromise that the search
 * ended in selects them: its violations are greatest where the contradiction is. After each few the search continues
 * from there, in a crowd from the original places. In the end a crowd asks for each relaxed pair again (take_back.c);
 * and all bodies descend from their original places once more, since a compromise may have moved some that need not
 * move any more.
 *
 * If that fails, all pairs that still clash are relaxed, and further bodies that come to clash go back, until nothing
 * clashes; at worst all are in their original places, where every relaxation holds. From there the cluster descends as
 * from any other solution: no body is moved to ease a pair that stays in conflict. (retry_cluster.c asks for the
 * relaxed pairs again.) */
#include "displacement/layer/stage_table.h"
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"
#include "base/union_find.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The state that the stages share. */
typedef struct giving_up {
    sunder_i_stage_run run;
    sunder_i_search *s;
    const double *start;     /* [2 n] the moves that the search began with */
    sunder_i_clash *at_home; /* [n] pairs that clash in the original places */
    size_t n;
    bool separately; /* the start consists of separate solutions that have run into each other */
    bool pushed;     /* the solution was made by pushing */
    bool done;       /* nothing clashes */
} giving_up;

/* ---- One at a time ----------------------------------------------------------------------------------------------- */

/* A clashing pair that may be relaxed. */
typedef struct candidate {
    const sunder_i_clash *clash;
    bool overlaps; /* its bodies overlapped in the original places */
} candidate;

/* Should p be given up rather than q? A pair that did not overlap at home should, before one that did; then the one
 * with the greater violation. */
static bool is_cheaper(const candidate *p, const candidate *q)
{
    if (p->overlaps != q->overlaps) return q->overlaps;
    if (p->clash->violation != q->clash->violation) return p->clash->violation > q->clash->violation;
    return sunder_i_by_id_pair(p->clash, q->clash) < 0;
}

/* Lists the clashing pairs that clashed at home and are not relaxed yet. In each component of clashes only those count
 * whose violation is at least `share` of the worst one, since smaller ones may be its consequence. */
static size_t list_candidates(sunder_i_search *s, const sunder_i_clash *at_home, size_t n, double share,
                              candidate *list, uint32_t *root, double *worst)
{
    size_t listed = 0, out = 0;
    sunder_i_union_init(root, s->n);
    for (size_t k = 0; k < s->n; k++) worst[k] = 0;
    for (size_t k = 0; k < s->clashes; k++) sunder_i_union_join(root, s->clash[k].i, s->clash[k].j);
    for (size_t k = 0; k < s->clashes; k++) {
        const sunder_i_clash *c = &s->clash[k],
                             *home = n ? bsearch(c, at_home, n, sizeof *c, sunder_i_by_id_pair) : NULL;
        if (!home || sunder_i_relaxations_between(&s->relaxations, s->body[c->i], s->body[c->j])) continue;
        double *w = &worst[sunder_i_union_find(root, c->i)];
        *w = sunder_i_max(*w, c->violation);
        list[listed++] = (candidate){c, home->violation > s->gap};
    }
    for (size_t k = 0; k < listed; k++)
        if (list[k].clash->violation >= share * worst[sunder_i_union_find(root, list[k].clash->i)])
            list[out++] = list[k];
    return out;
}

/* Relaxes the candidates that are cheaper to give up (is_cheaper()) than all other candidates with either of their
 * bodies. Returns whether any pair was relaxed. */
static bool relax_cheapest(sunder_i_search *s, const sunder_i_clash *at_home, size_t n, double share)
{
    const size_t before = s->relaxations.n;
    uint32_t *root = sunder_i_alloc(s->n, sizeof *root);
    double *worst = sunder_i_alloc(s->n, sizeof *worst);
    candidate *list = sunder_i_alloc(s->clashes, sizeof *list);
    const candidate **best = sunder_i_calloc(s->n, sizeof *best);
    s->failed = s->failed || !root || !worst || !list || !best;
    const size_t listed = s->failed ? 0 : list_candidates(s, at_home, n, share, list, root, worst);
    for (size_t k = 0; k < listed; k++)
        for (int e = 0; e < 2; e++) {
            const candidate **b = &best[e ? list[k].clash->j : list[k].clash->i];
            if (!*b || is_cheaper(&list[k], *b)) *b = &list[k];
        }
    for (size_t k = 0; k < listed && !s->failed; k++) {
        const sunder_i_clash *c = list[k].clash;
        if (best[c->i] == &list[k] && best[c->j] == &list[k]) sunder_i_search_relax(s, c->i, c->j);
    }
    if (s->relaxations.n > before && !sunder_i_relaxations_index(&s->relaxations, s->model)) s->failed = true;
    sunder_i_free_all(root, worst, list, best);
    return s->relaxations.n > before;
}

static void send_all_home(sunder_i_search *s)
{
    for (uint32_t k = 0; k < s->n; k++) sunder_i_search_send_home(s, k);
    s->program.n = 0;
}

/* Descends once more from the original places, with the pairs relaxed so far and those that miss only the margin there.
 * If the result has no clashes and is cheaper than s->t it is kept. */
static void try_from_home(sunder_i_search *s)
{
    sunder_i_search_waive_margins(s);
    if (s->failed) return;
    double *stand = sunder_i_search_copy_moves(s);
    if (s->failed) return;
    send_all_home(s);
    const bool found = sunder_i_search_descend(s);
    sunder_i_search_end_copy(s, stand, !found || sunder_i_search_cost(s, stand) <= sunder_i_search_cost(s, s->t));
}

/* Is it a crowd that is small enough to give up pairs gradually, and too large for take_back.c to try all of them
 * again? */
static bool restarts_from_home(const sunder_i_search *s) { return s->n >= CROWD && s->n <= LARGE_CROWD; }

/* Relaxes the cheapest candidates, continues the search, and so on, with more candidates each time, until the effort
 * ends.
 *
 * A crowd restarts from its original places each time: where its search ended, hundreds of bodies are pushed into each
 * other, including relaxed pairs, and the more pairs are relaxed, the fewer of the clashing ones there can still be
 * relaxed. */
static void relax_gradually(void *state)
{
    giving_up *x = state;
    sunder_i_search *s = x->s;
    const uint64_t work = sunder_i_search_work(s), times = (GIVE_UP_TIMES - 1) * work;
    const uint64_t little = work + PATIENCE + PATIENCE_EACH * (uint64_t)s->n;
    const uint64_t more = restarts_from_home(s) ? GIVE_UP_OF_CROWD : times < GIVE_UP_MOST ? times : GIVE_UP_MOST;
    const uint64_t end = work + more + little;
    bool done = false;
    for (double share = FIRST_SHARE; !done && !s->failed && sunder_i_search_work(s) < end; share /= MORE) {
        sunder_i_search_settle_components(s);
        if (!s->failed) sunder_i_search_find_clashes(s, s->t);
        if (s->failed || !relax_cheapest(s, x->at_home, x->n, share)) break;
        s->patience = end;
        if (restarts_from_home(s))
            send_all_home(s);
        else
            s->clashing = CLASHING_AGAIN;
        done = sunder_i_search_descend(s);
        s->clashing = MOST_CLASHING;
    }
    if (done && s->n >= CROWD) sunder_i_search_take_back(s);
    s->patience = sunder_i_search_work(s) + little;
    if (done) try_from_home(s);
    s->patience = UINT64_MAX;
    x->done = done && !s->failed;
}

/* ---- All of it --------------------------------------------------------------------------------------------------- */

sunder_i_clash *sunder_i_search_at_home(sunder_i_search *search, size_t *n)
{
    double *stand = sunder_i_search_copy_moves(search);
    if (!stand) return NULL;
    for (uint32_t k = 0; k < search->n; k++) sunder_i_search_send_home(search, k);
    sunder_i_search_find_clashes(search, search->t);
    sunder_i_search_end_copy(search, stand, true);
    *n = search->clashes;
    sunder_i_clash *at_home = sunder_i_alloc(*n, sizeof *at_home);
    if (at_home && *n) memcpy(at_home, search->clash, *n * sizeof *at_home);
    if (at_home && *n) qsort(at_home, *n, sizeof *at_home, sunder_i_by_id_pair);
    return at_home;
}

bool sunder_i_search_waive_margins(sunder_i_search *search)
{
    size_t n = 0;
    sunder_i_clash *at_home = sunder_i_search_at_home(search, &n);
    const size_t before = search->relaxations.n;
    const double margin = search->gap - search->model->rules.gap;
    if (!at_home) search->failed = true;
    for (size_t k = 0; k < n && !search->failed; k++)
        if (at_home[k].violation <= margin + search->tolerance)
            sunder_i_search_relax(search, at_home[k].i, at_home[k].j);
    sunder_i_free(at_home);
    if (search->relaxations.n > before && !sunder_i_relaxations_index(&search->relaxations, search->model))
        search->failed = true;
    return !search->failed && search->relaxations.n > before;
}

/* Bodies that are almost at their original places return there, if nothing clashes then. Only unobstructed bodies are
 * that near. */
static void return_home(void *state)
{
    sunder_i_search *s = ((giving_up *)state)->s;
    double *stand = sunder_i_search_copy_moves(s);
    if (s->failed) return;
    for (uint32_t k = 0; k < s->n; k++)
        if (hypot(s->t[2 * k], s->t[2 * k + 1]) <= NEARLY_HOME * s->extent) sunder_i_search_send_home(s, k);
    sunder_i_search_end_copy(s, stand, sunder_i_search_find_clashes(s, s->t) > s->tolerance);
}

/* The number of clashes at t, except violations as small as rounding causes. */
static size_t count_clashes(sunder_i_search *s, const double *t)
{
    size_t n = 0;
    sunder_i_search_find_clashes(s, t);
    for (size_t k = 0; k < s->clashes; k++) n += s->clash[k].violation > MENDED * s->tolerance;
    return n;
}

/* Has the start fewer clashes than the end of the search, and few compared with the clashes at home? Then the start
 * consists of separate solutions that have run into each other. */
static bool was_solved_separately(sunder_i_search *s, const double *start, size_t at_home)
{
    const size_t clashes = count_clashes(s, s->t), then = count_clashes(s, start);
    return then < clashes && then <= at_home / FEW_LEFT;
}

/* Marks in about[] the bodies of clashes whose violation is at least the share FIRST_SHARE of the worst one, and
 * relaxes all pairs with such a body that clash in the original places. */
static void relax_about(sunder_i_search *s, const sunder_i_clash *at_home, size_t n, bool *about)
{
    double worst = 0;
    const size_t before = s->relaxations.n;
    memset(about, 0, s->n * sizeof *about);
    for (size_t k = 0; k < s->clashes; k++) worst = sunder_i_max(worst, s->clash[k].violation);
    for (size_t k = 0; k < s->clashes; k++)
        if (s->clash[k].violation >= FIRST_SHARE * worst) about[s->clash[k].i] = about[s->clash[k].j] = true;
    for (size_t k = 0; k < n && !s->failed; k++)
        if (about[at_home[k].i] || about[at_home[k].j]) sunder_i_search_relax(s, at_home[k].i, at_home[k].j);
    if (s->relaxations.n > before && !sunder_i_relaxations_index(&s->relaxations, s->model)) s->failed = true;
}

/* For separate solutions that have run into each other: relaxes the pairs of clashing bodies and descends from `start`,
 * then relaxes those of bodies that clash after that, and so on, at most MOST_RINGS times. Other pairs keep their
 * distance. Pairs that were relaxed without need are tried again later (retry_cluster.c). If clashes remain in the end,
 * s->t is `start`. */
static void relax_in_rings(void *state)
{
    giving_up *x = state;
    sunder_i_search *s = x->s;
    const size_t size = 2 * s->n * sizeof *s->t;
    bool *about = sunder_i_alloc(s->n, sizeof *about), done = false;
    sunder_i_relaxations_free(&s->relaxations);
    s->failed = s->failed || !about;
    s->patience = sunder_i_search_work(s) + GIVE_UP_MOST + PATIENCE_EACH * (uint64_t)s->n;
    for (int ring = 0; ring < MOST_RINGS && !done && !s->failed; ring++) {
        sunder_i_search_find_clashes(s, s->t);
        if (!s->failed) relax_about(s, x->at_home, x->n, about);
        memcpy(s->t, x->start, size);
        s->program.n = 0;
        done = !s->failed && sunder_i_search_descend(s);
    }
    s->patience = UINT64_MAX;
    if (!done) memcpy(s->t, x->start, size);
    sunder_i_free(about);
    x->done = done && !s->failed;
}

/* ---- The order --------------------------------------------------------------------------------------------------- */

static bool is_unsolved(const void *state) { return !((const giving_up *)state)->done; }

static bool is_unsolved_large_crowd(const void *state)
{
    return is_unsolved(state) && ((const giving_up *)state)->s->n > LARGE_CROWD;
}

static bool may_relax_gradually(const void *state)
{
    const giving_up *x = state;
    return is_unsolved(x) && (!x->separately || restarts_from_home(x->s));
}

static bool is_unsolved_together(const void *state)
{
    return is_unsolved(state) && !((const giving_up *)state)->separately;
}

static bool is_unsolved_separately(const void *state)
{
    return is_unsolved(state) && ((const giving_up *)state)->separately;
}

static bool is_done(const void *state) { return ((const giving_up *)state)->done; }

static bool was_pushed(const void *state) { return ((const giving_up *)state)->pushed; }

static void push_from_home(void *state)
{
    giving_up *x = state;
    x->done = x->pushed = sunder_i_search_push_from_home(x->s, x->start, x->at_home, x->n, LEFT_BY_PUSHING);
}

/* Returns to the start of the search, if fewer pairs clash there. */
static void begin_again(void *state)
{
    giving_up *x = state;
    sunder_i_search *s = x->s;
    if (count_clashes(s, x->start) < count_clashes(s, s->t)) memcpy(s->t, x->start, 2 * s->n * sizeof *s->t);
}

static void clip_moves(void *state) { sunder_i_search_clip(((giving_up *)state)->s); }

/* Violations by rounding only are no reason to relax a pair. */
static void yield_and_repair(void *state)
{
    giving_up *x = state;
    sunder_i_search_yield(x->s, x->at_home, x->n, MENDED * x->s->tolerance);
    if (!x->s->failed) sunder_i_search_repair(x->s);
}

static void yield_last(void *state)
{
    giving_up *x = state;
    sunder_i_search_yield(x->s, x->at_home, x->n, 0);
}

static void descend_last(void *state) { sunder_i_search_descend_or_stay(((giving_up *)state)->s); }

static void equalise_moves(void *state) { sunder_i_search_equalise_moves(((giving_up *)state)->s); }

static const sunder_i_stage stages[] = {
    {"push from home", NULL, push_from_home, 0},
    {"begin again", is_unsolved_large_crowd, begin_again, 0},
    {"relax gradually", may_relax_gradually, relax_gradually, 0},
    {"begin again", is_unsolved_together, begin_again, 0},
    {"relax in rings", is_unsolved_separately, relax_in_rings, 0},
    {"clip", is_unsolved, clip_moves, 0},
    {"yield and repair", is_unsolved, yield_and_repair, 0},
};

/* After the stages above, and after pushing at home. */
static const sunder_i_stage last_stages[] = {
    {"yield", NULL, yield_last, 0},
    {"descend again", NULL, descend_last, 0},
    {"return home", is_done, return_home, 0},
    {"equalise moves", was_pushed, equalise_moves, 0},
};

static const char *look(const void *state, const double before[2], double now[2])
{
    const giving_up *x = state;
    (void)before;
    now[0] = sunder_i_search_cost(x->s, x->s->t);
    now[1] = x->done;
    return x->done ? "solved but for pairs given up" : "not solved";
}

static const sunder_i_stage_table table = {"give up", stages, sizeof stages / sizeof *stages, look};
static const sunder_i_stage_table last = {"give up", last_stages, sizeof last_stages / sizeof *last_stages, look};

static giving_up begin_giving_up(sunder_i_search *s, const double *start)
{
    giving_up x = {.run = {.log = s->log, .failed = &s->failed}, .s = s, .start = start};
    x.at_home = sunder_i_search_at_home(s, &x.n);
    s->failed = s->failed || !x.at_home;
    return x;
}

/* Memory for a step of the trace may be out. */
static void end_giving_up(giving_up *x)
{
    x->s->failed = x->s->failed || sunder_i_stages_run(&last, x);
    sunder_i_free(x->at_home);
}

bool sunder_i_search_give_up_at_home(sunder_i_search *search, const double *start)
{
    if (search->failed || sunder_i_search_movers(search) <= LARGE_CROWD) return false;
    giving_up x = begin_giving_up(search, start);
    if (!search->failed)
        x.pushed = x.done = sunder_i_search_push_from_home(search, start, x.at_home, x.n, LEFT_AT_HOME);
    if (x.pushed)
        end_giving_up(&x);
    else
        sunder_i_free(x.at_home);
    return x.pushed;
}

void sunder_i_search_give_up(sunder_i_search *search, const double *start)
{
    giving_up x = begin_giving_up(search, start);
    x.separately = !search->failed && search->n >= CROWD && was_solved_separately(search, start, x.n);
    sunder_i_stages_run(&table, &x);
    end_giving_up(&x);
}
