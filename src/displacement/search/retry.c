/* Pairs that were given up are asked for peace again.
 *
 * Pairs that were put under a truce together (yield.c) may be more than need be. So once nothing joins clusters any
 * more each is asked by itself, those that overlap first, the rest keeping what they have: blocks of which several
 * members are in conflict for all of these, and then for each, since one may have no solution where others do. At
 * first nobody but the pair moves, then more and more of those about it (vicinity.c), at last the whole cluster.
 * What overlaps and finds no peace is asked not to overlap, at least, before any pair that is only too near is asked
 * for anything. All are asked at one stage before any is at the next, so that where the effort ends the small
 * questions have been put; it grows with the number of bodies and of pairs, and with nothing else. */
#include "displacement/search/neighbourhood.h"
#include "displacement/search/stages.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How many may move at each stage, before all may. A cluster of no more than FEW is asked as a whole at once. */
static const size_t stage[] = {2, 8, 32, 128};
#define STAGES (sizeof stage / sizeof *stage)
#define FEW 8
/* Effort, in constraints looked at: for a cluster, for each of its bodies, and for each pair that is asked. */
#define EFFORT 2000000u
#define EFFORT_EACH 5000u
#define EFFORT_SUIT 200000u
#define MOST_SUITS 50 /* ... of no more than these */
/* So many in vain, one after the other, and with so many who move none of the others is asked. */
#define USELESS 32
/* Overlaps are parted at the cost of other pairs in clusters of which no more than so many may move. */
#define MOST_TRADING 64
/* What one descent of the whole may take: so much, and so much for each body. */
#define PATIENCE 200000u
#define PATIENCE_EACH 1500u

typedef struct petition {
    sunder_i_search *search;
    const sunder_i_suit *suit;
    size_t n, moving;
    bool *settled;   /* [n] nothing is left to be asked */
    bool *in_vain;   /* [n] with more bodies the question would be the same */
    double *stand;   /* [2 bodies] */
    uint64_t effort; /* till when */
    bool any;        /* somebody found peace */
    sunder_i_vicinity vicinity;
} petition;

static uint64_t work_of(const sunder_i_search *s) { return s->steps + s->program.work; }

bool sunder_i_suit_parts(const sunder_i_town *town, const sunder_i_truce *t)
{
    const sunder_i_body *p = &town->body[town->body_of[t->a]], *q = &town->body[town->body_of[t->b]];
    const double depth = hypot(t->shift[0], t->shift[1]);
    return depth > 0 && town->rules.gap > 0 && depth <= sunder_i_limit_of(p) + sunder_i_limit_of(q);
}

/* ---- What is asked ----------------------------------------------------------------------------------------------- */

static const sunder_i_truce *truce_of(const sunder_i_search *s, const sunder_i_suit *x, size_t k)
{
    return &s->town->truces.item[x->truce[k]];
}

static size_t find_ended(const sunder_i_search *s, const sunder_i_truce *t, bool *known)
{
    const sunder_i_ended wanted = sunder_i_ended_of(s->town, t);
    const size_t at = sunder_i_ended_at(s->ended, s->ended_n, &wanted);
    *known = at < s->ended_n && sunder_i_by_ended(&s->ended[at], &wanted) == 0;
    return at;
}

/* From now on the town's truces of this suit do not count, but for those that are hopeless; or they do again. */
static bool end_truces(sunder_i_search *s, const sunder_i_suit *x)
{
    if (!sunder_i_reserve(&s->ended, &s->ended_capacity, s->ended_n + x->truces, sizeof *s->ended)) return false;
    for (size_t k = 0; k < x->truces; k++) {
        const sunder_i_truce *t = truce_of(s, x, k);
        bool known;
        const size_t at = find_ended(s, t, &known);
        if (t->hopeless || known) continue;
        memmove(s->ended + at + 1, s->ended + at, (s->ended_n++ - at) * sizeof *s->ended);
        s->ended[at] = sunder_i_ended_of(s->town, t);
    }
    return true;
}

static void resume_truces(sunder_i_search *s, const sunder_i_suit *x)
{
    for (size_t k = 0; k < x->truces; k++) {
        bool known;
        const size_t at = find_ended(s, truce_of(s, x, k), &known);
        if (known) memmove(s->ended + at, s->ended + at + 1, (--s->ended_n - at) * sizeof *s->ended);
    }
}

/* The truce, but that what overlapped no longer does, nor will after rounding. */
static void part_barely(const sunder_i_search *s, sunder_i_truce *t)
{
    if (t->shift[0] == 0 && t->shift[1] == 0) return;
    t->shift[0] = t->shift[1] = 0;
    t->inside = false;
    t->gap = s->gap - s->town->rules.gap;
}

/* The suit's truces, but that what overlapped no longer does. */
static bool ask_disjoint(sunder_i_search *s, const sunder_i_suit *x)
{
    const sunder_i_town *town = s->town;
    for (size_t k = 0; k < x->truces; k++) {
        sunder_i_truce t = *truce_of(s, x, k);
        if (!sunder_i_suit_parts(town, &t)) continue;
        part_barely(s, &t);
        if (!sunder_i_truces_insert(&s->truces, town, &t)) return false;
    }
    return true;
}

static void resume_overlap(sunder_i_search *s, const sunder_i_suit *x)
{
    for (size_t k = 0; k < x->truces; k++)
        if (sunder_i_suit_parts(s->town, truce_of(s, x, k)))
            sunder_i_truces_remove(&s->truces, s->town, truce_of(s, x, k));
}

/* ---- At one stage ------------------------------------------------------------------------------------------------ */

/* With all that the cluster has. */
static bool settle_all(petition *p)
{
    sunder_i_search *s = p->search;
    const size_t size = 2 * s->n * sizeof *p->stand;
    memcpy(p->stand, s->t, size);
    s->program.n = 0;
    s->patience = work_of(s) + PATIENCE + PATIENCE_EACH * (uint64_t)s->n;
    bool done = sunder_i_search_descend(s);
    if (!done && !s->failed && sunder_i_search_jump(s)) {
        s->patience = work_of(s) + PATIENCE + PATIENCE_EACH * (uint64_t)s->n;
        done = sunder_i_search_descend(s);
    }
    s->patience = UINT64_MAX;
    if (!done) memcpy(s->t, p->stand, size);
    return done && !s->failed;
}

static uint32_t place_of(const sunder_i_search *s, uint32_t body)
{
    for (size_t part = 0; part < 2; part++) {
        const uint32_t *set = part ? s->body + s->own : s->body;
        const uint32_t *found = bsearch(&body, set, part ? s->n - s->own : s->own, sizeof body, sunder_i_by_number);
        if (found) return (uint32_t)(found - s->body);
    }
    return SUNDER_I_NOBODY; /* cannot be: suits are of the cluster's own */
}

static bool settle_one(petition *p, size_t k, size_t level)
{
    sunder_i_search *s = p->search;
    if (level == STAGES) return settle_all(p);
    const sunder_i_couple *pair = &p->suit[k].body;
    const bool done = sunder_i_vicinity_settle(&p->vicinity, place_of(s, pair->a), place_of(s, pair->b), stage[level],
                                               s->gap + 2 * p->suit[k].missing);
    p->in_vain[k] = !p->vicinity.wider;
    return done;
}

/* Asks one for peace, or not to overlap. */
static bool grant(petition *p, size_t k, size_t level, bool peace)
{
    sunder_i_search *s = p->search;
    const sunder_i_suit *x = &p->suit[k];
    if (!(peace ? end_truces(s, x) : ask_disjoint(s, x))) {
        s->failed = true;
        return false;
    }
    if (settle_one(p, k, level)) return true;
    if (peace)
        resume_truces(s, x);
    else
        resume_overlap(s, x);
    return false;
}

/* What is asked, in this order: as few overlaps as can be, then as few pairs. Truces of two bodies first together; of
 * those of which that had no solution, each. */
typedef struct request {
    bool overlap, peace, part;
} request;

static const request requests[] = {{true, true, false}, {true, true, true},   {true, false, false},
                                   {true, false, true}, {false, true, false}, {false, true, true}};
#define REQUESTS (sizeof requests / sizeof *requests)

/* Was it granted with others, or is it not what this request is for? */
static bool is_out(const petition *p, size_t k, const request *r)
{
    const sunder_i_suit *x = &p->suit[k];
    bool known;
    if (p->settled[k] || x->overlap != r->overlap || (x->part > 0) != r->part || !(r->peace ? x->peace : x->disjoint))
        return true;
    if (!r->part) return false;
    const sunder_i_truce *t = truce_of(p->search, x, 0);
    find_ended(p->search, t, &known);
    return known || sunder_i_truces_find(&p->search->truces, t->a, t->b);
}

/* Puts one question to all whom it concerns, stage by stage. */
static void ask_all(petition *p, const request *r)
{
    sunder_i_search *s = p->search;
    memset(p->in_vain, 0, p->n * sizeof *p->in_vain);
    for (size_t level = p->moving > FEW ? 0 : STAGES; level <= STAGES; level++) {
        size_t useless = 0;
        for (size_t k = 0; k < p->n && !s->failed && work_of(s) < p->effort; k++) {
            if ((p->in_vain[k] && level < STAGES) || is_out(p, k, r) || (level && useless == USELESS)) continue;
            p->settled[k] = grant(p, k, level, r->peace);
            p->any = p->any || p->settled[k];
            useless = p->settled[k] ? 0 : useless + 1;
        }
    }
}

/* ---- Pairs for an overlap ---------------------------------------------------------------------------------------- */

/* Lets the pairs that were in conflict at the start, and are at peace, be as they were then, but that none overlaps:
 * their truces are in `list`. */
static void sacrifice(sunder_i_search *s, sunder_i_truces *list)
{
    size_t n = 0, out = 0;
    sunder_i_clash *clash = sunder_i_search_at_home(s, &n);
    if (!clash) s->failed = true;
    for (size_t k = 0; k < n && !s->failed; k++)
        if (sunder_i_truces_make(s->town, s->body[clash[k].i], s->body[clash[k].j], s->gap + 2 * s->tolerance, list,
                                 NULL))
            s->failed = true;
    sunder_i_free(clash);
    for (size_t k = 0; k < list->n && !s->failed; k++) {
        sunder_i_truce t = list->item[k];
        const sunder_i_truce *old = sunder_i_truces_find(&s->town->truces, t.a, t.b);
        bool ended = false;
        part_barely(s, &t);
        if (old) find_ended(s, old, &ended);
        if (sunder_i_truces_find(&s->truces, t.a, t.b) || (old && !ended)) continue;
        if (!sunder_i_truces_insert(&s->truces, s->town, &t)) s->failed = true;
        list->item[out++] = t;
    }
    list->n = s->failed ? 0 : out;
}

/* Takes the truces back, those first that least is missing of, where there is a solution without. */
static void redeem(petition *p, sunder_i_truces *list)
{
    sunder_i_search *s = p->search;
    for (size_t k = 0; k < list->n && !s->failed; k++) {
        size_t best = k;
        for (size_t other = k + 1; other < list->n; other++)
            if (list->item[other].gap > list->item[best].gap) best = other;
        const sunder_i_truce t = list->item[best];
        list->item[best] = list->item[k];
        list->item[k] = t;
        sunder_i_truces_remove(&s->truces, s->town, &t);
        if (sunder_i_search_look(s, s->t) <= s->tolerance || (work_of(s) < p->effort && settle_all(p))) continue;
        if (!s->failed && !sunder_i_truces_insert(&s->truces, s->town, &t)) s->failed = true;
    }
}

/* From where all came from: sides that others chose do not matter there. */
static bool grant_from_home(petition *p, size_t k)
{
    sunder_i_search *s = p->search;
    double *stood = sunder_i_alloc(2 * s->n, sizeof *stood);
    if (!stood) s->failed = true;
    if (s->failed) return false;
    memcpy(stood, s->t, 2 * s->n * sizeof *stood);
    for (size_t i = 0; i < s->n; i++)
        if (s->mass[i] > 0) s->t[2 * i] = s->t[2 * i + 1] = 0;
    const bool granted = grant(p, k, STAGES, false);
    if (!granted) memcpy(s->t, stood, 2 * s->n * sizeof *stood);
    sunder_i_free(stood);
    return granted;
}

/* What still overlaps, and cannot but at the cost of pairs that keep their gap, is parted at that cost: an overlap
 * counts for more than any number of pairs. */
static void trade(petition *p)
{
    sunder_i_search *s = p->search;
    for (size_t k = 0; k < p->n && p->moving <= MOST_TRADING && work_of(s) < p->effort && !s->failed; k++) {
        sunder_i_truces list = {0};
        const sunder_i_suit *x = &p->suit[k];
        const request r = {x->overlap, false, x->part > 0};
        if (!x->overlap || is_out(p, k, &r)) continue;
        sacrifice(s, &list);
        p->settled[k] = list.n && !s->failed && (grant(p, k, STAGES, false) || grant_from_home(p, k));
        p->any = p->any || p->settled[k];
        if (p->settled[k]) redeem(p, &list);
        for (size_t t = 0; t < list.n && !p->settled[k]; t++)
            sunder_i_truces_remove(&s->truces, s->town, &list.item[t]);
        sunder_i_truces_free(&list);
    }
}

/* Does nothing clash to begin with? Those who joined the cluster may ask for a wider margin than the others kept. */
static bool is_in_order(sunder_i_search *s)
{
    s->patience = work_of(s) + PATIENCE + PATIENCE_EACH * (uint64_t)s->n;
    const bool ok = sunder_i_search_look(s, s->t) <= s->tolerance || (!s->failed && sunder_i_search_descend(s));
    s->patience = UINT64_MAX;
    return ok && !s->failed;
}

void sunder_i_search_retry(sunder_i_search *s, const sunder_i_suit *suit, size_t n)
{
    if (!is_in_order(s)) return;
    petition p = {.search = s,
                  .suit = suit,
                  .n = n,
                  .settled = sunder_i_calloc(n, sizeof *p.settled),
                  .in_vain = sunder_i_alloc(n, sizeof *p.in_vain),
                  .stand = sunder_i_alloc(2 * s->n, sizeof *p.stand)};
    for (size_t k = 0; k < s->n; k++) p.moving += s->mass[k] > 0;
    if (!p.settled || !p.in_vain || !p.stand || (p.moving > FEW && !sunder_i_vicinity_init(&p.vicinity, s)))
        s->failed = true;
    const uint64_t pairs = n < MOST_SUITS ? n : MOST_SUITS;
    const uint64_t effort = EFFORT + EFFORT_EACH * (uint64_t)p.moving + EFFORT_SUIT * pairs;
    for (size_t k = 0; k < REQUESTS && !s->failed; k++) {
        if (!requests[k].part) p.effort = work_of(s) + effort / 2;
        ask_all(&p, &requests[k]);
    }
    p.effort = work_of(s) + effort / 2;
    if (!s->failed && s->town->rules.gap > 0) trade(&p);
    if (p.any && p.moving > FEW) sunder_i_search_lower(s);
    sunder_i_vicinity_free(&p.vicinity);
    sunder_i_free(p.settled);
    sunder_i_free(p.in_vain);
    sunder_i_free(p.stand);
}

sunder_status sunder_i_cluster_retry(const sunder_i_town *town, sunder_i_cluster *cluster, const sunder_i_suit *suit,
                                     size_t suits, double *move, sunder_error *err)
{
    uint32_t *body = NULL;
    double *all = NULL;
    size_t n = 0;
    sunder_i_search s;
    memset(&s, 0, sizeof s);
    bool ok = sunder_i_cluster_about(town, cluster, move, &body, &all, &n);
    if (ok) ok = sunder_i_search_init(&s, town, body, n, cluster->margin, all);
    if (ok) {
        s.own = cluster->n;
        for (size_t k = cluster->n; k < n; k++) s.mass[k] = 0;
        sunder_i_search_retry(&s, suit, suits);
        ok = !s.failed;
    }
    if (ok && s.ended_n + s.truces.n) {
        s.n = cluster->n;
        sunder_i_search_round(&s, move);
        sunder_i_search_hand_over(&s, cluster);
    }
    sunder_i_search_free(&s);
    sunder_i_free(body);
    sunder_i_free(all);
    return ok ? SUNDER_OK : sunder_i_no_memory(err);
}
