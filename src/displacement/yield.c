/* Clusters without a solution: limits, fixed bodies, or no room between them.
 *
 * Pairs that clash in the end, and clashed at the start, are put under a truce (truce.c): all others stay at peace, and
 * these stand no worse than they stood. What came into a clash besides goes home, until nothing clashes; in the end all
 * are at home, where every truce holds. From there the cluster descends as from any other solution: nobody is pushed to
 * ease a pair that stays in conflict.
 *
 * The pairs that were put under a truce together may be more than need be. So once nothing joins clusters any more each
 * is asked for peace again, those that overlap first, the rest keeping what they have. */
#include "displacement/search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void sunder_i_search_clip(sunder_i_search *s)
{
    for (size_t k = 0; k < s->n; k++) {
        const double limit = sunder_i_search_limit(s, (uint32_t)k), length = hypot(s->t[2 * k], s->t[2 * k + 1]);
        if (!(s->mass[k] > 0) || !(length > limit)) continue;
        s->t[2 * k] *= limit / length;
        s->t[2 * k + 1] *= limit / length;
    }
}

/* ---- Yielding ------------------------------------------------------------------------------------------------------
 */

static int by_pair(const void *a, const void *b)
{
    const sunder_i_clash *p = a, *q = b;
    if (p->i != q->i) return p->i < q->i ? -1 : 1;
    return p->j < q->j ? -1 : p->j > q->j;
}

static bool send_home(sunder_i_search *s, uint32_t i)
{
    if (!(s->mass[i] > 0) || (s->t[2 * i] == 0 && s->t[2 * i + 1] == 0)) return false;
    s->t[2 * i] = s->t[2 * i + 1] = 0;
    return true;
}

/* The pairs that clash with all at home; *n of them, sorted. NULL if memory is out. */
static sunder_i_clash *look_at_home(sunder_i_search *s, size_t *n)
{
    double *stand = sunder_i_alloc(2 * s->n, sizeof *stand);
    if (!stand) return NULL;
    memcpy(stand, s->t, 2 * s->n * sizeof *stand);
    for (uint32_t k = 0; k < s->n; k++) send_home(s, k);
    sunder_i_search_look(s, s->t);
    memcpy(s->t, stand, 2 * s->n * sizeof *stand);
    sunder_i_free(stand);
    *n = s->clashes;
    sunder_i_clash *at_home = sunder_i_alloc(*n, sizeof *at_home);
    if (at_home && *n) memcpy(at_home, s->clash, *n * sizeof *at_home);
    if (at_home && *n) qsort(at_home, *n, sizeof *at_home, by_pair);
    return at_home;
}

/* A truce for pair (i, j), if there is none by this search yet. */
static bool make_truce(sunder_i_search *s, uint32_t i, uint32_t j)
{
    const uint32_t p = s->body[i], q = s->body[j];
    if (sunder_i_truces_between(&s->truces, p, q)) return false;
    const size_t before = s->truces.n;
    /* All that is within what the search asks for: the gap and its margin. */
    if (sunder_i_truces_make(s->town, p, q, s->gap + 2 * s->tolerance, &s->truces, NULL)) s->failed = true;
    return s->truces.n > before;
}

/* One pass over what clashes now. Returns whether anything changed. */
static bool yield_once(sunder_i_search *s, const sunder_i_clash *at_home, size_t n)
{
    bool any = false;
    const size_t before = s->truces.n;
    sunder_i_search_look(s, s->t);
    for (size_t k = 0; k < s->clashes && !s->failed; k++) {
        const sunder_i_clash *c = &s->clash[k];
        if (n && bsearch(c, at_home, n, sizeof *at_home, by_pair) && make_truce(s, c->i, c->j)) {
            any = true;
            continue;
        }
        const bool i = send_home(s, c->i), j = send_home(s, c->j);
        any = any || i || j;
    }
    if (s->truces.n > before && !sunder_i_truces_index(&s->truces, s->town)) s->failed = true;
    return any;
}

/* Down from a position without clashes, or stay there. */
static void descend_from(sunder_i_search *s)
{
    const size_t size = 2 * s->n * sizeof *s->t;
    double *stand = sunder_i_alloc(2 * s->n, sizeof *stand);
    s->failed = s->failed || !stand;
    if (!s->failed && sunder_i_search_look(s, s->t) <= s->tolerance) {
        memcpy(stand, s->t, size);
        s->program.n = 0;
        if (!sunder_i_search_descend(s)) memcpy(s->t, stand, size);
    }
    sunder_i_free(stand);
}

void sunder_i_search_yield(sunder_i_search *s)
{
    size_t n = 0;
    sunder_i_search_clip(s);
    sunder_i_clash *at_home = look_at_home(s, &n);
    s->failed = s->failed || !at_home;
    while (!s->failed && yield_once(s, at_home, n)) {}
    sunder_i_free(at_home);
    descend_from(s);
}

/* ---- Asking again --------------------------------------------------------------------------------------------------
 */

/* A pair under a truce: what it would take to make peace, the least first; overlaps before all others. */
typedef struct suit {
    bool disjoint, hopeless;
    double missing;
    sunder_i_couple body;
} suit;

static int by_ease(const void *a, const void *b)
{
    const suit *p = a, *q = b;
    if (p->disjoint != q->disjoint) return p->disjoint ? 1 : -1;
    if (p->missing != q->missing) return p->missing < q->missing ? -1 : 1;
    return sunder_i_by_couple(&p->body, &q->body);
}

static bool has(const sunder_i_search *s, uint32_t body)
{
    return sunder_i_set_has(s->body, s->own, body) || sunder_i_set_has(s->body + s->own, s->n - s->own, body);
}

/* The pairs of the town's truces that this search has the bodies of. NULL if memory is out. */
static suit *list_suits(const sunder_i_search *s, size_t *n)
{
    const sunder_i_town *town = s->town;
    const sunder_i_truces *all = &town->truces;
    suit *list = sunder_i_alloc(all->torn_n, sizeof *list);
    *n = 0;
    for (size_t k = 0; list && k < all->torn_n; k++) {
        const sunder_i_torn *t = &all->torn[k];
        if (!has(s, t->i) || !has(s, t->j)) continue;
        list[(*n)++] = (suit){.disjoint = !(t->reach > 0), .missing = t->reach, .body = {t->i, t->j}};
    }
    /* Sorted by bodies, as the couples of `torn` are. */
    for (size_t k = 0; list && *n && k < all->n; k++) {
        const sunder_i_truce *t = &all->item[k];
        const uint32_t i = town->body_of[t->a], j = town->body_of[t->b];
        const sunder_i_couple key = {i < j ? i : j, i < j ? j : i};
        for (size_t low = 0, high = *n; low < high;) {
            const size_t middle = low + (high - low) / 2;
            const int order = sunder_i_by_couple(&list[middle].body, &key);
            if (order == 0) {
                list[middle].hopeless = list[middle].hopeless || t->hopeless;
                if (list[middle].disjoint) list[middle].missing = fmax(list[middle].missing, s->gap - t->gap);
                break;
            }
            if (order < 0)
                low = middle + 1;
            else
                high = middle;
        }
    }
    if (list && *n) qsort(list, *n, sizeof *list, by_ease);
    return list;
}

/* Is there a solution now? Else back to where all stood. */
static bool attempt(sunder_i_search *s, double *stand)
{
    const size_t size = 2 * s->n * sizeof *stand;
    memcpy(stand, s->t, size);
    s->program.n = 0;
    bool done = sunder_i_search_descend(s);
    if (!done && !s->failed && sunder_i_search_jump(s)) done = sunder_i_search_descend(s);
    if (!done) memcpy(s->t, stand, size);
    return done && !s->failed;
}

static bool try_peace(sunder_i_search *s, const suit *x, double *stand)
{
    if (!sunder_i_reserve(&s->ended, &s->ended_capacity, s->ended_n + 1, sizeof *s->ended)) {
        s->failed = true;
        return false;
    }
    s->ended[s->ended_n++] = x->body;
    qsort(s->ended, s->ended_n, sizeof *s->ended, sunder_i_by_couple);
    if (attempt(s, stand)) return true;
    const size_t at = sunder_i_couple_at(s->ended, s->ended_n, x->body.a, x->body.b);
    memmove(s->ended + at, s->ended + at + 1, (--s->ended_n - at) * sizeof *s->ended);
    return false;
}

/* That they no longer overlap, at least. */
static void try_disjoint(sunder_i_search *s, const suit *x, double *stand)
{
    const sunder_i_town *town = s->town;
    const sunder_i_truces *all = &town->truces;
    for (size_t k = 0; k < all->n && !s->failed; k++) {
        sunder_i_truce t = all->item[k];
        const uint32_t i = town->body_of[t.a], j = town->body_of[t.b];
        if ((i < j ? i : j) != x->body.a || (i < j ? j : i) != x->body.b || (t.shift[0] == 0 && t.shift[1] == 0))
            continue;
        t.shift[0] = t.shift[1] = 0;
        t.gap = s->gap - town->rules.gap; /* so that no rounding makes them overlap again */
        if (!sunder_i_truces_add(&s->truces, &t)) s->failed = true;
    }
    if (s->failed || !sunder_i_truces_index(&s->truces, town)) {
        s->failed = true;
        return;
    }
    if (!attempt(s, stand)) sunder_i_truces_end(&s->truces, town, x->body.a, x->body.b);
}

void sunder_i_search_retry(sunder_i_search *s)
{
    size_t n = 0;
    if (sunder_i_search_look(s, s->t) > s->tolerance || s->failed) return;
    suit *list = list_suits(s, &n);
    double *stand = sunder_i_alloc(2 * s->n, sizeof *stand);
    s->failed = s->failed || !list || !stand;
    for (size_t k = 0; k < n && !s->failed && s->steps + s->program.work < s->effort; k++) {
        if (!list[k].hopeless && try_peace(s, &list[k], stand)) continue;
        if (!s->failed && !list[k].disjoint) try_disjoint(s, &list[k], stand);
    }
    sunder_i_free(list);
    sunder_i_free(stand);
}
