/* Pairs that a search has given up are asked for again, one after the other, from its present layout: the full distance
 * is demanded of each two bodies with given-up pairs, overlaps first, then those that miss least, by pushing the bodies
 * in the way straight on (pushed.c), hundreds if need be. That needs no program. */
#include "displacement/solve/search/pushed.h"
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"

#include <math.h>
#include <stdlib.h>

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

/* Ends the relaxations between the two bodies of the wish in this search. */
static void claim_pair(sunder_i_search *s, const sunder_i_relaxations *all, const wish *w)
{
    for (size_t k = 0; k < all->n; k++)
        if (is_between(s, &all->item[k], w)) sunder_i_relaxations_remove(&s->relaxations, s->model, &all->item[k]);
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

void sunder_i_search_push_back(sunder_i_search *search)
{
    sunder_i_relaxations all = {0};
    for (size_t k = 0; k < search->relaxations.n && !search->failed; k++)
        if (!sunder_i_relaxations_add(&all, &search->relaxations.item[k])) search->failed = true;
    if (!search->failed && !sunder_i_relaxations_index(&all, search->model)) search->failed = true;
    wish *list = sunder_i_alloc(all.relaxed_n, sizeof *list);
    search->failed = search->failed || !list;
    search->patience = UINT64_MAX;
    if (!search->failed) {
        list_wishes(search, &all, list);
        ask_pushed(search, &all, list, all.relaxed_n);
    }
    sunder_i_relaxations_free(&all);
    sunder_i_free(list);
}
