/* Pairs that were given up are asked again for their full distance.
 *
 * More pairs than necessary may have been relaxed together (elastic.c). So once clusters no longer merge, the full
 * distance is demanded again of one pair at a time, overlaps first, while all other pairs keep their relaxations. If
 * several members of two blocks are in conflict, all these conflicts are tried together, and then each by itself, since
 * one may have no solution where others do. At first only the pair moves, then more and more bodies around it
 * (neighbourhood.c), at last the whole cluster. An overlap without a solution is at least to be separated, before pairs
 * that are only too close are tried. All pairs are tried at one level before any at the next, so that when the effort
 * ends the small questions have been asked. The effort depends on the numbers of bodies and of pairs only. A level ends
 * early after a number of failures in a row, or after a certain amount of work. The order of the demands is a table. */
#include "displacement/layer/stage_table.h"
#include "displacement/solve/search/neighbourhood.h"
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include <math.h>
#include <string.h>

/* The numbers of bodies that move at each level; at level LEVELS the whole cluster moves. */
static const size_t moved[] = RETRY_STAGES;
#define LEVELS (sizeof moved / sizeof *moved)

typedef struct retrying {
    sunder_i_stage_run run;
    sunder_i_search *search;
    const sunder_i_retry *retry;
    size_t n, moving;
    bool *settled;         /* [n] nothing remains to be demanded */
    bool *in_vain;         /* [n] the last try included all bodies around the pair, so a larger one would be the same */
    double *stand;         /* [2 bodies] */
    uint64_t effort;       /* of all demands */
    uint64_t end;          /* tries end when the work (sunder_i_search_work()) reaches this */
    uint64_t in_vain_most; /* work at one level without a success, after which the level ends */
    sunder_i_neighbourhood neighbourhood;
} retrying;

bool sunder_i_can_be_disjoint(const sunder_i_model *model, const sunder_i_relaxation *relaxation)
{
    const sunder_i_body *p = &model->body[model->body_of[relaxation->a]],
                        *q = &model->body[model->body_of[relaxation->b]];
    const double depth = hypot(relaxation->shift[0], relaxation->shift[1]);
    return depth > 0 && !sunder_i_is_crossed(model, relaxation->a, relaxation->b) &&
           sunder_i_owed_above(model, relaxation->a, relaxation->b) > 0 &&
           depth <= sunder_i_limit_of(p) + sunder_i_limit_of(q);
}

/* Begins a stage: its tries may take the total effort divided by its budget. */
static void begin_stage(retrying *p) { p->end = sunder_i_search_work(p->search) + p->effort / p->run.budget; }

/* ---- What is asked ----------------------------------------------------------------------------------------------- */

static const sunder_i_relaxation *relaxation_of(const sunder_i_search *s, const sunder_i_retry *x, size_t k)
{
    return &s->model->relaxations.item[x->relaxation[k]];
}

static size_t find_restored(const sunder_i_search *s, const sunder_i_relaxation *t, bool *known)
{
    const sunder_i_restored wanted = sunder_i_restored_of(s->model, t);
    const size_t at = sunder_i_restored_at(s->restored, s->restored_n, &wanted);
    *known = at < s->restored_n && sunder_i_by_restored(&s->restored[at], &wanted) == 0;
    return at;
}

/* Ends the relaxations of this request in the search, except infeasible ones; relax_again() restores them. */
static bool restore_retry(sunder_i_search *s, const sunder_i_retry *x)
{
    if (!sunder_i_reserve(&s->restored, &s->restored_capacity, s->restored_n + x->relaxations, sizeof *s->restored))
        return false;
    for (size_t k = 0; k < x->relaxations; k++) {
        const sunder_i_relaxation *t = relaxation_of(s, x, k);
        bool known;
        const size_t at = find_restored(s, t, &known);
        if (t->infeasible || known) continue;
        memmove(s->restored + at + 1, s->restored + at, (s->restored_n++ - at) * sizeof *s->restored);
        s->restored[at] = sunder_i_restored_of(s->model, t);
    }
    return true;
}

static void relax_again(sunder_i_search *s, const sunder_i_retry *x)
{
    for (size_t k = 0; k < x->relaxations; k++) {
        bool known;
        const size_t at = find_restored(s, relaxation_of(s, x, k), &known);
        if (known) memmove(s->restored + at, s->restored + at + 1, (--s->restored_n - at) * sizeof *s->restored);
    }
}

/* Changes the relaxation of an overlap so that the overlap has to end: the two features have to be apart by the margin.
 * Other relaxations do not change. */
static void part_barely(const sunder_i_search *s, sunder_i_relaxation *t)
{
    if (t->shift[0] == 0 && t->shift[1] == 0) return;
    t->shift[0] = t->shift[1] = 0;
    t->inside = false;
    t->gap = s->gap - s->model->rules.gap;
}

/* Adds the relaxations of the request, changed so that overlaps have to end. False if memory is out. */
static bool ask_disjoint(sunder_i_search *s, const sunder_i_retry *x)
{
    const sunder_i_model *model = s->model;
    for (size_t k = 0; k < x->relaxations; k++) {
        sunder_i_relaxation t = *relaxation_of(s, x, k);
        if (!sunder_i_can_be_disjoint(model, &t)) continue;
        part_barely(s, &t);
        if (!sunder_i_relaxations_insert(&s->relaxations, model, &t)) return false;
    }
    return true;
}

static void resume_overlap(sunder_i_search *s, const sunder_i_retry *x)
{
    for (size_t k = 0; k < x->relaxations; k++)
        if (sunder_i_can_be_disjoint(s->model, relaxation_of(s, x, k)))
            sunder_i_relaxations_remove(&s->relaxations, s->model, relaxation_of(s, x, k));
}

/* ---- At one level ------------------------------------------------------------------------------------------------ */

/* Descends with the whole cluster from its present layout; if that fails, bodies jump, and all descend again. On
 * failure all return. */
static bool settle_all(retrying *p)
{
    sunder_i_search *s = p->search;
    const size_t size = 2 * s->n * sizeof *p->stand;
    memcpy(p->stand, s->t, size);
    s->program.n = 0;
    s->patience = sunder_i_search_work(s) + PATIENCE + PATIENCE_EACH * (uint64_t)s->n;
    bool done = sunder_i_search_descend(s);
    if (!done && !s->failed && sunder_i_search_jump_soon(s)) {
        s->patience = sunder_i_search_work(s) + PATIENCE + PATIENCE_EACH * (uint64_t)s->n;
        done = sunder_i_search_descend(s);
    }
    s->patience = UINT64_MAX;
    if (!done) memcpy(s->t, p->stand, size);
    return done && !s->failed;
}

static bool settle_one(retrying *p, size_t k, size_t level)
{
    sunder_i_search *s = p->search;
    if (level == LEVELS) return settle_all(p);
    const sunder_i_id_pair *pair = &p->retry[k].body;
    const bool done = sunder_i_neighbourhood_settle(&p->neighbourhood, sunder_i_search_place_of(s, pair->a),
                                                    sunder_i_search_place_of(s, pair->b), moved[level],
                                                    s->gap + 2 * p->retry[k].missing);
    p->in_vain[k] = !p->neighbourhood.wider;
    return done;
}

/* Demands the full distance for retry k (`resolve`), or the end of its overlap. If there is no solution at this level,
 * the relaxations are valid again. Returns whether there is one. */
static bool grant_retry(retrying *p, size_t k, size_t level, bool resolve)
{
    sunder_i_search *s = p->search;
    const sunder_i_retry *x = &p->retry[k];
    if (!(resolve ? restore_retry(s, x) : ask_disjoint(s, x))) {
        s->failed = true;
        return false;
    }
    if (settle_one(p, k, level)) return true;
    if (resolve)
        relax_again(s, x);
    else
        resume_overlap(s, x);
    return false;
}

/* What is demanded, and of which retries. */
typedef struct request {
    bool overlap; /* of those that overlap */
    bool resolve; /* the full distance; otherwise the end of the overlap */
    bool single;  /* of those about a single relaxation; otherwise of those about all between two bodies */
} request;

/* Is retry k left out of request r? It is if it is settled, if r is about another kind of retry, or if the relaxation
 * of a single retry was ended together with others. */
static bool is_out(const retrying *p, size_t k, const request *r)
{
    const sunder_i_retry *x = &p->retry[k];
    bool known;
    if (p->settled[k] || x->overlap != r->overlap || (x->single > 0) != r->single ||
        !(r->resolve ? x->resolve : x->disjoint))
        return true;
    if (!r->single) return false;
    const sunder_i_relaxation *t = relaxation_of(p->search, x, 0);
    find_restored(p->search, t, &known);
    return known || sunder_i_relaxations_find(&p->search->relaxations, t->a, t->b);
}

/* The failures at one level since its last success. */
typedef struct useless {
    size_t asked;
    uint64_t since; /* work when they began */
    size_t most;
} useless;

/* Have too many tries failed to continue with the level? The first level is never ended early. */
static bool is_useless(const retrying *p, const useless *u, size_t level)
{
    if (level == 0 || u->asked == 0) return false;
    return u->asked >= u->most || sunder_i_search_work(p->search) > u->since + p->in_vain_most;
}

/* Tries all retries that request r is about (is_out()), at one level after the other, until the effort ends. */
static void ask_request(retrying *p, const request *r)
{
    sunder_i_search *s = p->search;
    size_t most = RETRIES_IN_VAIN;
    memset(p->in_vain, 0, p->n * sizeof *p->in_vain);
    for (size_t level = p->moving > FEW ? 0 : LEVELS; level <= LEVELS; level++) {
        useless u = {0, sunder_i_search_work(s), most};
        bool any = false;
        for (size_t k = 0; k < p->n && !s->failed && sunder_i_search_work(s) < p->end; k++) {
            if ((p->in_vain[k] && level < LEVELS) || is_out(p, k, r) || is_useless(p, &u, level)) continue;
            p->settled[k] = grant_retry(p, k, level, r->resolve);
            any = any || p->settled[k];
            u.asked++;
            if (p->settled[k]) u = (useless){0, sunder_i_search_work(s), most};
        }
        /* In a crowd a demand that fails at one level usually fails at the next. */
        most = any || p->n <= FEW_RETRIES || p->n / SHARE_OF_RETRIES >= RETRIES_IN_VAIN ? RETRIES_IN_VAIN
                                                                                        : p->n / SHARE_OF_RETRIES;
    }
}

/* ---- Pairs for an overlap ---------------------------------------------------------------------------------------- */

/* Relaxes all pairs that are in conflict in the original places and have no valid relaxation: they may come as near as
 * there, but not overlap. The new relaxations are stored in `list`. */
static void sacrifice_pairs(sunder_i_search *s, sunder_i_relaxations *list)
{
    size_t n = 0, out = 0;
    sunder_i_clash *clash = sunder_i_search_at_home(s, &n);
    if (!clash) s->failed = true;
    for (size_t k = 0; k < n && !s->failed; k++)
        if (!sunder_i_relaxations_make(s->model, s->body[clash[k].i], s->body[clash[k].j], s->gap + 2 * s->tolerance,
                                       list))
            s->failed = true;
    sunder_i_free(clash);
    for (size_t k = 0; k < list->n && !s->failed; k++) {
        sunder_i_relaxation t = list->item[k];
        const sunder_i_relaxation *old = sunder_i_relaxations_find(&s->model->relaxations, t.a, t.b);
        bool restored = false;
        part_barely(s, &t);
        if (old) find_restored(s, old, &restored);
        if (sunder_i_relaxations_find(&s->relaxations, t.a, t.b) || (old && !restored)) continue;
        if (!sunder_i_relaxations_insert(&s->relaxations, s->model, &t)) s->failed = true;
        list->item[out++] = t;
    }
    list->n = s->failed ? 0 : out;
}

/* Ends the relaxations in `list` again, one after the other, those with the smallest shortfall first, unless there is
 * no layout without it. */
static void redeem_pairs(retrying *p, sunder_i_relaxations *list)
{
    sunder_i_search *s = p->search;
    for (size_t k = 0; k < list->n && !s->failed; k++) {
        size_t best = k;
        for (size_t other = k + 1; other < list->n; other++)
            if (list->item[other].gap > list->item[best].gap) best = other;
        const sunder_i_relaxation t = list->item[best];
        list->item[best] = list->item[k];
        list->item[k] = t;
        sunder_i_relaxations_remove(&s->relaxations, s->model, &t);
        if (sunder_i_search_find_clashes(s, s->t) <= s->tolerance ||
            (sunder_i_search_work(s) < p->end && settle_all(p)))
            continue;
        if (!s->failed && !sunder_i_relaxations_insert(&s->relaxations, s->model, &t)) s->failed = true;
    }
}

/* Tries a pair with all bodies starting from their original places, where the sides chosen for other pairs do not
 * matter. */
static bool grant_from_home(retrying *p, size_t k)
{
    sunder_i_search *s = p->search;
    double *stood = sunder_i_search_copy_moves(s);
    if (s->failed) return false;
    for (size_t i = 0; i < s->n; i++)
        if (s->mass[i] > 0) s->t[2 * i] = s->t[2 * i + 1] = 0;
    const bool granted = grant_retry(p, k, LEVELS, false);
    sunder_i_search_end_copy(s, stood, !granted);
    return granted;
}

/* Ends remaining overlaps at the expense of other pairs, which give up their gap: an overlap counts for more than any
 * number of those. */
static void trade_pairs(void *state)
{
    retrying *p = state;
    sunder_i_search *s = p->search;
    begin_stage(p);
    for (size_t k = 0; k < p->n && p->moving <= MOST_TRADING && sunder_i_search_work(s) < p->end && !s->failed; k++) {
        sunder_i_relaxations list = {0};
        const sunder_i_retry *x = &p->retry[k];
        const request r = {x->overlap, false, x->single > 0};
        if (!x->overlap || is_out(p, k, &r)) continue;
        sacrifice_pairs(s, &list);
        p->settled[k] = list.n && !s->failed && (grant_retry(p, k, LEVELS, false) || grant_from_home(p, k));
        if (p->settled[k]) redeem_pairs(p, &list);
        for (size_t t = 0; t < list.n && !p->settled[k]; t++)
            sunder_i_relaxations_remove(&s->relaxations, s->model, &list.item[t]);
        sunder_i_relaxations_free(&list);
    }
}

/* Makes sure that the start is without clashes. Bodies that joined the cluster may demand a wider margin than the
 * others keep. A violation up to half the margin is tolerated from then on, since otherwise one pair left so by
 * rounding would keep a crowd of hundreds from being tried. If a violation is greater, all bodies descend. Returns
 * whether that succeeds. */
static bool is_in_order(sunder_i_search *s)
{
    const double hair = 2 * s->tolerance, missed = sunder_i_search_find_clashes(s, s->t);
    if (s->failed || missed <= s->tolerance) return !s->failed;
    if (missed <= hair) {
        s->tolerance = hair;
        return true;
    }
    s->patience = sunder_i_search_work(s) + PATIENCE + PATIENCE_EACH * (uint64_t)s->n;
    const bool ok = sunder_i_search_descend(s);
    s->patience = UINT64_MAX;
    return ok && !s->failed;
}

/* ---- The order --------------------------------------------------------------------------------------------------- */

/* The relaxations between two bodies are tried together first, and then each. */
static void ask_requests(retrying *p, bool overlap, bool resolve)
{
    begin_stage(p);
    ask_request(p, &(request){overlap, resolve, false});
    if (!p->search->failed) ask_request(p, &(request){overlap, resolve, true});
}

static void resolve_overlaps(void *state) { ask_requests(state, true, true); }

static void end_overlaps(void *state) { ask_requests(state, true, false); }

static void resolve_pairs(void *state) { ask_requests(state, false, true); }

static bool has_gap(const void *state) { return ((const retrying *)state)->search->model->rules.gap > 0; }

/* First as few overlaps as possible, then as few pairs. The total effort is divided by the budget. */
static const sunder_i_stage stages[] = {
    {"resolve overlaps", NULL, resolve_overlaps, 2}, {"end overlaps", NULL, end_overlaps, 2},
    {"resolve pairs", NULL, resolve_pairs, 2},       {"trade pairs", has_gap, trade_pairs, 2},
};

static const char *look(const void *state, const double before[2], double now[2])
{
    const retrying *p = state;
    now[0] = sunder_i_search_cost(p->search, p->search->t);
    now[1] = 0;
    for (size_t k = 0; k < p->n; k++) now[1] += p->settled[k];
    return now[1] > before[1] ? "pairs solved that were given up" : "cheaper";
}

static const sunder_i_stage_table table = {"retry", stages, sizeof stages / sizeof *stages, look};

static void retry_all(sunder_i_search *s, const sunder_i_retry *retry, size_t n)
{
    if (!is_in_order(s)) return;
    retrying p = {.run = {.log = s->log, .failed = &s->failed},
                  .search = s,
                  .retry = retry,
                  .n = n,
                  .moving = sunder_i_search_movers(s),
                  .settled = sunder_i_calloc(n, sizeof *p.settled),
                  .in_vain = sunder_i_alloc(n, sizeof *p.in_vain),
                  .stand = sunder_i_alloc(2 * s->n, sizeof *p.stand)};
    if (!p.settled || !p.in_vain || !p.stand || (p.moving > FEW && !sunder_i_neighbourhood_init(&p.neighbourhood, s)))
        s->failed = true;
    const uint64_t pairs = n < MOST_RETRIES ? n : MOST_RETRIES;
    p.effort = RETRY_EFFORT + RETRY_EFFORT_EACH * (uint64_t)p.moving + RETRY_EFFORT_PAIR * pairs;
    p.in_vain_most = p.effort / SHARE_IN_VAIN > WORK_IN_VAIN ? p.effort / SHARE_IN_VAIN : WORK_IN_VAIN;
    if (sunder_i_stages_run(&table, &p)) s->failed = true;
    sunder_i_neighbourhood_free(&p.neighbourhood);
    sunder_i_free_all(p.settled, p.in_vain, p.stand);
}

sunder_status sunder_i_cluster_retry(const sunder_i_model *model, sunder_i_cluster *cluster,
                                     const sunder_i_retry *retry, size_t retries, double *move, sunder_error *err)
{
    sunder_i_search s;
    bool ok = sunder_i_search_init_about(&s, model, cluster, move);
    s.log = sunder_i_is_traced(model) ? &cluster->log : NULL;
    if (ok) retry_all(&s, retry, retries);
    ok = ok && !s.failed;
    if (ok && s.restored_n + s.relaxations.n) {
        s.n = cluster->n;
        sunder_i_search_round(&s, move);
        sunder_i_search_hand_over(&s, cluster);
    }
    sunder_i_search_free(&s);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}
