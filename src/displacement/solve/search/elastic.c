/* Which pairs of a cluster without a solution to give up, by prices; the cause may be limits, fixed bodies, or lack of
 * room. Such a pair is relaxed (relaxation.c): it stands no worse than at the start, and no body is moved to ease it.
 * (retry_cluster.c asks for the relaxed pairs again.)
 *
 * A pair that clashes in the original places may fall short of its distance, at a price; all other pairs keep theirs.
 * With all bodies in their original places that holds, so every program on the way from there has a solution. The price
 * is linear in the distance that a pair lacks, or nearly, and so dear that a pair falls short only where moves within
 * the limits do not help. The cluster descends to where moves and prices are least.
 *
 * The least sum of what pairs lack may leave many pairs short by a little where few could be short by more. So a pair
 * becomes the cheaper the more it lacks, and the cluster descends again, a few times [CWB08]. */
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"

#include <math.h>

/* Moves all bodies to their original places and relaxes the n pairs that clash there. Returns whether nothing clashes
 * then; it does not unless memory is out. */
static bool relax_at_home(sunder_i_search *search, const sunder_i_clash *at_home, size_t n)
{
    for (uint32_t k = 0; k < search->n; k++) sunder_i_search_send_home(search, k);
    search->program.n = 0;
    for (size_t k = 0; k < n && !search->failed; k++) sunder_i_search_relax(search, at_home[k].i, at_home[k].j);
    if (!search->failed && !sunder_i_relaxations_index(&search->relaxations, search->model)) search->failed = true;
    return !search->failed && sunder_i_search_find_clashes(search, search->t) <= search->tolerance;
}

/* The most that a pair lacks; 0 before any pair was measured. */
static double most_missing(const sunder_i_search *s)
{
    double most = 0;
    for (size_t k = 0; k < s->shortfalls; k++)
        if (s->shortfall[k].known && s->shortfall[k].missing < INFINITY)
            most = sunder_i_max(most, s->shortfall[k].missing);
    return most;
}

/* Sets the price of a pair that lacks `missing`, where the worst lacks `most`. */
static void set_price(const sunder_i_search *s, sunder_i_shortfall *f, double missing, double most)
{
    const uint32_t end[2] = {f->i, s->creditor.item[f->other]};
    double far = INFINITY, mass = 0;
    for (int e = 0; e < 2; e++) {
        if (!(s->mass[end[e]] > 0)) continue;
        far = sunder_i_min(far, sunder_i_search_limit(s, end[e]));
        mass = sunder_i_max(mass, s->mass[end[e]]);
    }
    if (far == INFINITY) far = s->extent + s->gap;
    const double weight = 1 / (2 * mass), less = most > 0 ? most * MUCH_MISSING / (missing + most * MUCH_MISSING) : 1;
    f->price = (sunder_i_price){weight * DEAR * far * less, weight * DEAR_SQUARE * less};
}

/* Makes pairs cheaper the more they lack. */
static void set_prices(sunder_i_search *s)
{
    const double most = most_missing(s);
    for (size_t k = 0; k < s->shortfalls; k++) {
        sunder_i_shortfall *f = &s->shortfall[k];
        set_price(s, f, f->known && f->missing < INFINITY ? f->missing : most, most);
    }
}

static bool is_any_short(const sunder_i_search *s)
{
    for (size_t k = 0; k < s->shortfalls; k++)
        if (s->shortfall[k].missing > 0) return true;
    return false;
}

/* Descends at prices. Returns whether nothing clashes then but what falls short. */
static bool descend_at_prices(sunder_i_search *s)
{
    const double settled = s->settled;
    bool done = sunder_i_search_ease_own(s);
    s->failed = s->failed || !done;
    s->settled = SETTLED_AT_PRICES;
    for (int k = 0; k <= MOST_DISCOUNTS && done && !s->failed && (k == 0 || is_any_short(s)); k++) {
        set_prices(s);
        s->program.n = 0;
        done = sunder_i_search_descend(s);
        sunder_i_search_shortfall_price(s, s->t);
    }
    s->settled = settled;
    return done && !s->failed && sunder_i_search_find_clashes(s, s->t) <= s->tolerance;
}

/* Ends the relaxations of pairs that lack nothing. */
static void end_solved(sunder_i_search *s)
{
    sunder_i_relaxations *all = &s->relaxations;
    const uint32_t *body_of = s->model->body_of;
    bool *solved = sunder_i_calloc(all->relaxed_n, sizeof *solved);
    size_t left = 0;
    s->failed = s->failed || !solved;
    for (size_t k = 0; k < s->shortfalls && !s->failed; k++) {
        const sunder_i_shortfall *f = &s->shortfall[k];
        for (uint32_t other = f->other; other < f->other + f->others && !(f->missing > 0); other++)
            solved[sunder_i_relaxations_between(all, s->body[f->i], s->body[s->creditor.item[other]]) - all->relaxed] =
                true;
    }
    for (size_t k = 0; k < all->n && !s->failed; k++) {
        const sunder_i_relaxation *t = &all->item[k];
        if (!solved[sunder_i_relaxations_between(all, body_of[t->a], body_of[t->b]) - all->relaxed])
            all->item[left++] = *t;
    }
    if (!s->failed) all->n = left;
    if (!s->failed && !sunder_i_relaxations_index(all, s->model)) s->failed = true;
    sunder_i_free(solved);
}

void sunder_i_search_give_up(sunder_i_search *search)
{
    size_t n = 0;
    sunder_i_clash *at_home = sunder_i_search_at_home(search, &n);
    if (!at_home) search->failed = true;
    const bool done = at_home && relax_at_home(search, at_home, n) && descend_at_prices(search);
    if (done) end_solved(search);
    search->shortfalls = search->creditor.n = 0;
    if (!done && !search->failed) relax_at_home(search, at_home, n);
    sunder_i_free(at_home);
}
