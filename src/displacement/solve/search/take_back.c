/* Pairs that a search has given up are asked for again, one after the other, from its present layout.
 *
 * Several pairs are given up at once (give_up.c), and in a connected set some are given up in place of others: with the
 * rest out of the way they may have a solution. So the full distance is demanded again of each two bodies with given-up
 * pairs, overlaps first, then those that miss least. Each is first tried with a few bodies around it, while all others
 * stand (neighbourhood.c), which succeeds for most that can succeed and costs little. The remaining ones are tried with
 * the whole cluster, which descends from its present layout; if that does not end within its limit of work all bodies
 * return. Each of these two stages ends after a number of failures in a row. At last all remaining pairs are tried by
 * pushing the bodies in the way straight on (pushed.c), hundreds if need be, which needs no program. */
#include "displacement/solve/search/neighbourhood.h"
#include "displacement/solve/search/pushed.h"
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define HALF_WAY 0.70710678118654752440 /* cosine and sine of 45 degrees */

/* Two bodies, i < j, the move that would resolve all relaxed pairs between them, and whether one overlaps. */
typedef struct wish {
    uint32_t i, j;
    double missing;
    bool overlap;
} wish;

static int by_ease(const void *a, const void *b)
{
    const wish *p = a, *q = b;
    if (p->overlap != q->overlap) return p->overlap ? -1 : 1;
    if (p->missing != q->missing) return p->missing < q->missing ? -1 : 1;
    return sunder_i_by_id_pair(p, q);
}

static wish *wish_of(const sunder_i_search *s, const sunder_i_relaxations *all, const sunder_i_relaxation *t,
                     wish *list)
{
    const uint32_t *body_of = s->model->body_of;
    return &list[sunder_i_relaxations_between(all, body_of[t->a], body_of[t->b]) - all->relaxed];
}

/* Lists one wish for each two bodies, in the order in which they are tried. */
static void list_wishes(const sunder_i_search *s, const sunder_i_relaxations *all, wish *list)
{
    for (size_t k = 0; k < all->relaxed_n; k++) list[k] = (wish){all->relaxed[k].i, all->relaxed[k].j, 0, false};
    for (size_t k = 0; k < all->n; k++) {
        const sunder_i_relaxation *t = &all->item[k];
        const double depth = hypot(t->shift[0], t->shift[1]);
        wish *w = wish_of(s, all, t, list);
        w->overlap = w->overlap || depth > 0;
        w->missing = sunder_i_max(w->missing, depth > 0 ? depth : sunder_i_owed_above(s->model, t->a, t->b) - t->gap);
    }
    qsort(list, all->relaxed_n, sizeof *list, by_ease);
}

static bool is_between(const sunder_i_search *s, const sunder_i_relaxation *t, const wish *w)
{
    const uint32_t p = s->model->body_of[t->a], q = s->model->body_of[t->b];
    return (p == w->i && q == w->j) || (p == w->j && q == w->i);
}

/* Ends the relaxations between the two bodies of the wish in this search. waive_pair() makes them valid again. */
static void claim_pair(sunder_i_search *s, const sunder_i_relaxations *all, const wish *w)
{
    for (size_t k = 0; k < all->n; k++)
        if (is_between(s, &all->item[k], w)) sunder_i_relaxations_remove(&s->relaxations, s->model, &all->item[k]);
}

static void waive_pair(sunder_i_search *s, const sunder_i_relaxations *all, const wish *w)
{
    for (size_t k = 0; k < all->n && !s->failed; k++)
        if (is_between(s, &all->item[k], w) && !sunder_i_relaxations_insert(&s->relaxations, s->model, &all->item[k]))
            s->failed = true;
}

/* Descends with all bodies from the present layout; on failure they return. stand: [2 n] scratch. */
static bool settle_whole(sunder_i_search *s, double *stand)
{
    const size_t size = 2 * s->n * sizeof *stand;
    memcpy(stand, s->t, size);
    s->program.n = 0;
    s->patience = sunder_i_search_work(s) + TAKE_BACK_EACH;
    const bool done = sunder_i_search_descend(s);
    s->patience = UINT64_MAX;
    if (!done) memcpy(s->t, stand, size);
    return done;
}

/* Tries each wish with a few bodies around the pair. Keeps the wishes that were not granted at the front of the list
 * and returns their number. */
static size_t ask_few(sunder_i_search *s, const sunder_i_relaxations *all, wish *list, size_t n)
{
    sunder_i_neighbourhood about;
    size_t left = 0;
    unsigned in_vain = 0; /* failures in a row */
    if (!sunder_i_neighbourhood_init(&about, s)) s->failed = true;
    for (size_t k = 0; k < n; k++) {
        const wish w = list[k];
        bool granted = false;
        if (in_vain < TAKE_BACK_FEW_IN_VAIN && !s->failed) {
            claim_pair(s, all, &w);
            granted =
                sunder_i_neighbourhood_settle(&about, sunder_i_search_place_of(s, w.i),
                                              sunder_i_search_place_of(s, w.j), TAKE_BACK_FEW, s->gap + 2 * w.missing);
            if (!granted) waive_pair(s, all, &w);
            in_vain = granted ? 0 : in_vain + 1;
        }
        if (!granted) list[left++] = w;
    }
    sunder_i_neighbourhood_free(&about);
    return left;
}

/* Tries each wish with all bodies, until TAKE_BACK_IN_VAIN fail in a row or the work exceeds TAKE_BACK_MOST. Keeps the
 * wishes that were not granted at the front of the list and returns their number. stand: [2 n] scratch. */
static size_t ask_whole(sunder_i_search *s, const sunder_i_relaxations *all, wish *list, size_t n, double *stand)
{
    const uint64_t end = sunder_i_search_work(s) + TAKE_BACK_MOST;
    size_t left = 0;
    unsigned in_vain = 0; /* failures in a row */
    for (size_t k = 0; k < n; k++) {
        const wish w = list[k];
        bool granted = false;
        if (in_vain < TAKE_BACK_IN_VAIN && !s->failed && sunder_i_search_work(s) < end) {
            claim_pair(s, all, &w);
            granted = settle_whole(s, stand);
            if (!granted) waive_pair(s, all, &w);
            in_vain = granted ? 0 : in_vain + 1;
        }
        if (!granted) list[left++] = w;
    }
    return left;
}

/* ---- By pushing -------------------------------------------------------------------------------------------------- */

/* Separates bodies i and j, if their violation is at most `most`, by pushing the bodies in the way: straight on, or at
 * 45 degrees to either side, which is along a row if i and j meet corner to corner. Returns whether no violation above
 * the tolerance is left. */
static bool push_pair(sunder_i_search *s, sunder_i_pushed *p, uint32_t i, uint32_t j, double most)
{
    static const double turn[3][2] = {{1, 0}, {HALF_WAY, HALF_WAY}, {HALF_WAY, -HALF_WAY}};
    double n[2];
    const double missing = sunder_i_pushed_missing(p, i, j, n);
    if (missing <= s->tolerance || missing > most) return missing <= s->tolerance;
    for (size_t k = 0; k < 3 && !s->failed; k++) {
        const double along[2] = {turn[k][0] * n[0] - turn[k][1] * n[1], turn[k][1] * n[0] + turn[k][0] * n[1]};
        const double far = missing / turn[k][0];
        if (sunder_i_pushed_reaches(p, i, j, along, far) && sunder_i_pushed_part(p, far)) break;
    }
    return sunder_i_pushed_missing(p, i, j, n) <= s->tolerance;
}

/* Tries to separate each pair whose violation is at most `most`, until the work reaches `end`. Keeps the others at the
 * front of the list and returns their number. */
static size_t push_each(sunder_i_search *s, sunder_i_pushed *p, const sunder_i_relaxations *all, wish *list, size_t n,
                        double most, uint64_t end)
{
    size_t left = 0;
    for (size_t k = 0; k < n; k++) {
        const wish w = list[k];
        const uint32_t i = sunder_i_search_place_of(s, w.i), j = sunder_i_search_place_of(s, w.j);
        const bool is_out = s->failed || i == SUNDER_I_NOBODY || j == SUNDER_I_NOBODY || sunder_i_search_work(s) >= end;
        if (is_out || !push_pair(s, p, i, j, most)) {
            list[left++] = w;
            continue;
        }
        claim_pair(s, all, &w);
        sunder_i_pushed_renew(p, i, j);
    }
    return left;
}

/* Tries pairs with a small violation first: a row that is opened for one pair may be most of what another needs. Each
 * level is repeated while enough pairs succeed (LEAST_PUSHED). If hardly any pair of a level succeeds (LEAST_OF_LEVEL),
 * the next level is the last, and takes all remaining pairs. Returns the number of remaining wishes. */
static size_t ask_pushed(sunder_i_search *s, const sunder_i_relaxations *all, wish *list, size_t n)
{
    sunder_i_pushed pushed;
    double most = 0;
    const uint64_t end = sunder_i_search_work(s) + PUSHED_MOST + PUSHED_EACH * (uint64_t)s->n;
    for (size_t k = 0; k < n; k++) most = sunder_i_max(most, list[k].missing);
    if (!sunder_i_pushed_init(&pushed, s, most)) s->failed = true;
    bool last = false;
    for (double level = most / PUSHED_FIRST; n && !s->failed; level *= PUSHED_LEVELS) {
        last = last || !(level < most);
        const size_t whole = n;
        for (size_t before = 2 * n; before - n > before / LEAST_PUSHED && !s->failed;) {
            before = n;
            n = push_each(s, &pushed, all, list, n, last ? INFINITY : level, end);
        }
        if (last) break;
        last = whole - n < whole / LEAST_OF_LEVEL;
    }
    sunder_i_pushed_free(&pushed);
    return n;
}

/* ---- All of it --------------------------------------------------------------------------------------------------- */

static void take_back(sunder_i_search *s, const sunder_i_relaxations *all, wish *list, bool by_pushing_alone)
{
    double *stand = sunder_i_alloc(2 * s->n, sizeof *stand);
    s->failed = s->failed || !stand;
    list_wishes(s, all, list);
    const size_t some = by_pushing_alone ? all->relaxed_n : ask_few(s, all, list, all->relaxed_n);
    const size_t left = by_pushing_alone ? some : ask_whole(s, all, list, some, stand);
    ask_pushed(s, all, list, left);
    sunder_i_free(stand);
}

static void begin_take_back(sunder_i_search *s, bool by_pushing_alone)
{
    sunder_i_relaxations all = {0};
    for (size_t k = 0; k < s->relaxations.n && !s->failed; k++)
        if (!sunder_i_relaxations_add(&all, &s->relaxations.item[k])) s->failed = true;
    if (!s->failed && !sunder_i_relaxations_index(&all, s->model)) s->failed = true;
    wish *list = sunder_i_alloc(all.relaxed_n, sizeof *list);
    s->failed = s->failed || !list;
    s->patience = UINT64_MAX;
    if (!s->failed) take_back(s, &all, list, by_pushing_alone);
    sunder_i_relaxations_free(&all);
    sunder_i_free(list);
}

void sunder_i_search_take_back(sunder_i_search *search) { begin_take_back(search, false); }

void sunder_i_search_push_back(sunder_i_search *search) { begin_take_back(search, true); }
