/* Out of clashes: bodies that clash jump, one at a time, to the nearest place where they clash with nothing. */
#include "displacement/solve/search/stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/invariant.h"

#include <math.h>
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

/* Where the smaller of the two that clash finds room, or else the other: its number, or SUNDER_I_NOBODY. Bodies that
 * found none are marked, and not asked again. */
static uint32_t find_room(sunder_i_search *s, const sunder_i_clash *clash, bool *stuck, double place[2])
{
    const sunder_i_body *p = &s->model->body[s->body[clash->i]], *q = &s->model->body[s->body[clash->j]];
    const bool swap = p->pieces > q->pieces;
    const uint32_t pair[2] = {swap ? clash->j : clash->i, swap ? clash->i : clash->j};
    for (int e = 0; e < 2 && !s->failed; e++) {
        const uint32_t i = pair[e];
        if (!(s->mass[i] > 0) || stuck[i]) continue;
        if (sunder_i_search_free_body(s, i, sunder_i_search_limit(s, i), place)) return i;
        stuck[i] = true;
    }
    return SUNDER_I_NOBODY;
}

bool sunder_i_search_jump(sunder_i_search *s)
{
    s->program.n = 0; /* the forces belong to places that are left */
    sunder_i_search_clip(s);
    bool *stuck = sunder_i_calloc(s->n, sizeof *stuck);
    if (!stuck) s->failed = true;
    if (!s->failed) sunder_i_search_look(s, s->t);
    /* A body that jumps clashes with nothing where it lands, so the number of clashing bodies falls each time. */
    size_t at = 0;
    for (size_t k = 0; k <= 2 * s->n && at < s->clashes && sunder_i_search_work(s) < s->patience && !s->failed; k++) {
        double place[2];
        const uint32_t who = find_room(s, &s->clash[at], stuck, place);
        if (who == SUNDER_I_NOBODY) {
            at++;
            continue;
        }
        memcpy(s->t + 2 * who, place, sizeof place);
        sunder_i_search_look_again(s, s->t, who);
        at = 0;
    }
    sunder_i_free(stuck);
    if (s->failed) return false;
    SUNDER_I_CHECK(sunder_i_search_check(s), s->n);
    return sunder_i_search_look(s, s->t) <= s->tolerance;
}

bool sunder_i_search_jump_soon(sunder_i_search *s)
{
    const uint64_t patience = s->patience;
    s->patience = sunder_i_search_work(s) + LEAP_PATIENCE;
    const bool clear = sunder_i_search_jump(s);
    s->patience = patience;
    return clear;
}
