/* A crowd that has almost no room within its limits.
 *
 * In a compromise of thousands of bodies that owe each other more than the limits allow, every body is at its limit,
 * pushed into others: it does not show what to give up, and each descent that finds this out costs more than all else.
 * So if nothing has moved yet, all clashing pairs are given up first, with all bodies in their original places. Pushing
 * (pushed.c) takes back those for which there is room, the smallest violations first, at very little cost. Pushing only
 * goes straight on, and leaves more pairs than necessary; so its result is accepted only if it leaves more than a given
 * share of the pairs, which shows that the crowd is of that kind. Between such rounds all bodies descend to their least
 * cost, which spreads the remaining slack of the limits. */
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include <math.h>
#include <string.h>

static bool begins_at_home(const sunder_i_search *s, const double *start)
{
    bool limited = false;
    for (size_t k = 0; k < s->n; k++) {
        limited = limited || (s->mass[k] > 0 && sunder_i_search_limit(s, (uint32_t)k) < INFINITY);
        if (s->mass[k] > 0 && (start[2 * k] != 0 || start[2 * k + 1] != 0)) return false;
    }
    return limited;
}

/* Pushes, descends, and pushes again, as long as that restores a fair number of pairs. Returns whether the first push
 * left more than the share LEFT_AT_HOME of them relaxed. */
static bool push_all(sunder_i_search *s)
{
    const size_t all = s->relaxations.n;
    sunder_i_search_push_back(s);
    if (s->failed || (double)s->relaxations.n <= LEFT_AT_HOME * (double)all) return false;
    for (size_t before = all; before - s->relaxations.n > before / LEAST_PUSHED && !s->failed;) {
        before = s->relaxations.n;
        sunder_i_search_descend_or_stay(s);
        sunder_i_search_push_back(s);
    }
    return !s->failed;
}

bool sunder_i_search_push_from_home(sunder_i_search *search, const double *start, const sunder_i_clash *at_home,
                                    size_t n)
{
    if (n == 0 || !begins_at_home(search, start)) return false;
    double *stood = sunder_i_search_copy_moves(search);
    if (search->failed) return false;
    const sunder_i_relaxations given_up = search->relaxations;
    memset(&search->relaxations, 0, sizeof search->relaxations);
    const bool done = sunder_i_search_relax_at_home(search, at_home, n) && push_all(search);
    sunder_i_relaxations other = done ? given_up : search->relaxations;
    if (!done) {
        search->relaxations = given_up;
        search->program.n = 0;
    }
    sunder_i_relaxations_free(&other);
    sunder_i_search_end_copy(search, stood, !done);
    return done;
}
