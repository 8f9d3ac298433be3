/* Out of clashes: bodies that clash jump, one at a time, to the nearest place where they clash with nothing. */
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/invariant.h"

#include <math.h>
#include <string.h>

/* Shortens moves that exceed their limits. */
static void clip_moves(sunder_i_search *search)
{
    for (size_t k = 0; k < search->n; k++) {
        const double limit = sunder_i_search_limit(search, (uint32_t)k),
                     length = hypot(search->t[2 * k], search->t[2 * k + 1]);
        if (!(search->mass[k] > 0) || !(length > limit)) continue;
        search->t[2 * k] *= limit / length;
        search->t[2 * k + 1] *= limit / length;
    }
}

/* Finds a free position for the body of the clash with fewer pieces, or for the other one. Returns its index, or
 * SUNDER_I_NOBODY. stuck: [n] bodies for which none was found; they are not tried again. */
static uint32_t find_room(sunder_i_search *s, const sunder_i_clash *clash, bool *stuck, double place[2])
{
    const sunder_i_body *p = &s->model->body[s->body[clash->i]], *q = &s->model->body[s->body[clash->j]];
    const bool swap = p->pieces > q->pieces;
    const uint32_t pair[2] = {swap ? clash->j : clash->i, swap ? clash->i : clash->j};
    for (int e = 0; e < 2 && !s->failed; e++) {
        const uint32_t i = pair[e];
        if (!(s->mass[i] > 0) || stuck[i]) continue;
        const double *to = s->preferred + 2 * i, limit = sunder_i_search_limit(s, i) + hypot(to[0], to[1]);
        if (sunder_i_search_free_body(s, i, limit, place)) return i;
        stuck[i] = true;
    }
    return SUNDER_I_NOBODY;
}

bool sunder_i_search_jump(sunder_i_search *search)
{
    search->program.n = 0; /* its forces belong to the former places */
    clip_moves(search);
    bool *stuck = sunder_i_calloc(search->n, sizeof *stuck);
    if (!stuck) search->failed = true;
    if (!search->failed) sunder_i_search_find_clashes(search, search->t);
    /* After a jump the body clashes with nothing, so the number of clashing bodies falls. */
    size_t at = 0;
    for (size_t k = 0; k <= 2 * search->n && at < search->clashes && sunder_i_search_work(search) < search->patience &&
                       !search->failed;
         k++) {
        double place[2];
        const uint32_t who = find_room(search, &search->clash[at], stuck, place);
        if (who == SUNDER_I_NOBODY) {
            at++;
            continue;
        }
        memcpy(search->t + 2 * who, place, sizeof place);
        sunder_i_search_update_clashes(search, search->t, who);
        at = 0;
    }
    sunder_i_free(stuck);
    if (search->failed) return false;
    SUNDER_I_CHECK(sunder_i_search_check(search), search->n);
    return sunder_i_search_find_clashes(search, search->t) <= search->tolerance;
}

bool sunder_i_search_jump_soon(sunder_i_search *search)
{
    const uint64_t patience = search->patience;
    search->patience = sunder_i_search_work(search) + LEAP_PATIENCE;
    const bool clear = sunder_i_search_jump(search);
    search->patience = patience;
    return clear;
}
