/* Nothing is made worse: the rule for pairs that stay in conflict, exactly, of the features as they will be written.
 *
 * The search heeds truces (truce.c) up to its own rounding, and moves are rounded to what doubles hold; so a pair may
 * stand worse by a unit in the last place. It is taken back pair by pair, and the rest keeps its solution:
 *
 *   - one of the two is put a unit beside its place, or takes the other's move, where it is then in nobody's way;
 *   - where no such place will do (a slanted corridor of exact width has none), the one whose move is cheaper is pinned
 *     to where it came from. Its neighbours settle about it, and if they cannot, yield in their turn.
 *
 * A place that is taken breaks the rule for no pair, and a body that is pinned stays so, and with all at home nothing
 * stands worse: the loop ends. */
#include "displacement/job.h"
#include "displacement/peace.h"

#include <float.h>
#include <string.h>

/* ---- The rule ------------------------------------------------------------------------------------------------------
 */

/* Do the two stand to each other as they did, exactly? */
static bool stand_as_they_did(const sunder_i_job *w, const sunder_i_relation *r)
{
    const sunder_i_stand *a = &w->scene.stand[r->a], *b = &w->scene.stand[r->b];
    return !w->scene.rounded[r->a] && !w->scene.rounded[r->b] && a->t[0] == b->t[0] && a->t[1] == b->t[1];
}

sunder_status sunder_i_job_is_worse(const sunder_i_job *w, const sunder_i_relation *r, bool *worse, sunder_error *err)
{
    const sunder_i_relation *was = sunder_i_relations_find(&w->start, r->a, r->b);
    *worse = !was || sunder_i_is_at_peace(was);
    if (*worse || stand_as_they_did(w, r) || (was->contained && r->contained)) return SUNDER_OK;
    const sunder_feature *feature = w->town.layer->feature;
    const sunder_i_stand *a = &w->scene.stand[r->a], *b = &w->scene.stand[r->b];
    const sunder_i_pair before = {feature[r->a].shape, feature[r->b].shape, NULL, NULL},
                        now = {a->shape, b->shape, a->t, b->t};
    return sunder_i_is_worse(&before, &now, worse, err);
}

/* Is it a conflict that is listed whatever the options? Members of a block may gape and touch. */
static bool is_listed(const sunder_i_job *w, const sunder_i_relation *r)
{
    return !sunder_i_is_at_peace(r) &&
           (w->town.body_of[r->a] != w->town.body_of[r->b] || (r->overlap && !r->touch));
}

static sunder_status breaks_rule(const sunder_i_job *w, const sunder_i_relation *r, bool *breaks, sunder_error *err)
{
    *breaks = false;
    return is_listed(w, r) ? sunder_i_job_is_worse(w, r, breaks, err) : SUNDER_OK;
}

sunder_status sunder_i_job_is_upheld(const sunder_i_job *w, bool *upheld, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    *upheld = true;
    for (size_t k = 0; k < w->now.n && *upheld && !status; k++) {
        bool breaks;
        status = breaks_rule(w, &w->now.pair[k], &breaks, err);
        *upheld = !status && !breaks;
    }
    return status;
}

/* ---- A place nearby ------------------------------------------------------------------------------------------------
 */

static bool can_move(const sunder_i_job *w, uint32_t b) { return !w->town.body[b].fixed && !w->town.body[b].pinned; }

/* Puts body b there. */
static sunder_status put(sunder_i_job *w, uint32_t b, const double to[2], sunder_error *err)
{
    memset(w->changed, 0, w->town.features * sizeof *w->changed);
    sunder_i_job_place(w, b, to);
    return sunder_i_job_check(w, err);
}

/* Is all well with body b where it stands: is it in no conflict but those it was in, and in none that is worse? */
static sunder_status is_well(const sunder_i_job *w, uint32_t b, const sunder_i_relations *before, bool *well,
                             sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    *well = true;
    for (size_t k = 0; k < w->now.n && *well && !status; k++) {
        const sunder_i_relation *r = &w->now.pair[k];
        if ((w->town.body_of[r->a] != b && w->town.body_of[r->b] != b) || !is_listed(w, r)) continue;
        const sunder_i_relation *old = sunder_i_relations_find(before, r->a, r->b);
        bool breaks = !old || sunder_i_is_at_peace(old);
        if (!breaks) status = breaks_rule(w, r, &breaks, err);
        *well = !breaks;
    }
    return status;
}

/* Tries one place for body b: stays there if all is well, else goes back. */
static sunder_status try_place(sunder_i_job *w, uint32_t b, const double to[2], bool *well, sunder_error *err)
{
    const double *move = w->town.move + 2 * (size_t)b;
    const double stood[2] = {move[0], move[1]};
    *well = false;
    double exact[2];
    if (!sunder_i_within(to, w->town.body[b].limit) || (to[0] == stood[0] && to[1] == stood[1])) return SUNDER_OK;
    if (!sunder_i_round_move(&w->town, b, to, exact, NULL) || exact[0] != to[0] || exact[1] != to[1]) return SUNDER_OK;
    sunder_i_relations before = w->now;
    w->now.pair = sunder_i_alloc(before.n, sizeof *before.pair);
    sunder_status status = w->now.pair ? SUNDER_OK : sunder_i_no_memory(err);
    if (!status && before.n) memcpy(w->now.pair, before.pair, before.n * sizeof *before.pair);
    if (!status) status = put(w, b, to, err);
    if (!status) status = is_well(w, b, &before, well, err);
    if (!status && !*well) status = put(w, b, stood, err);
    sunder_i_free(before.pair);
    return status;
}

/* The eight places a unit beside its own. */
static sunder_status try_nearby(sunder_i_job *w, uint32_t b, bool *well, sunder_error *err)
{
    const double *move = w->town.move + 2 * (size_t)b;
    const double stood[2] = {move[0], move[1]};
    double unit[2], same[2];
    sunder_status status = SUNDER_OK;
    *well = false;
    for (int c = 0; c < 2; c++) {
        /* A move of nothing has no unit. */
        double along[2] = {0, 0};
        along[c] = stood[c] != 0 ? stood[c] : DBL_MIN;
        sunder_i_round_move(&w->town, b, along, same, &unit[c]);
    }
    for (int k = 0; k < 9 && !*well && !status; k++) {
        const double to[2] = {stood[0] + (k % 3 - 1) * unit[0], stood[1] + (k / 3 - 1) * unit[1]};
        if (k != 4) status = try_place(w, b, to, well, err);
    }
    return status;
}

static sunder_status mend(sunder_i_job *w, uint32_t i, uint32_t j, bool *well, sunder_error *err)
{
    const uint32_t pair[2] = {i, j};
    sunder_status status = SUNDER_OK;
    *well = false;
    for (int e = 0; e < 2 && !*well && !status; e++)
        if (can_move(w, pair[e])) status = try_nearby(w, pair[e], well, err);
    for (int e = 0; e < 2 && !*well && !status; e++) {
        const double *other = w->town.move + 2 * (size_t)pair[1 - e], to[2] = {other[0], other[1]};
        if (can_move(w, pair[e])) status = try_place(w, pair[e], to, well, err);
    }
    return status;
}

/* ---- Staying -------------------------------------------------------------------------------------------------------
 */

static double cost_of(const sunder_i_job *w, uint32_t b)
{
    const double *t = w->town.move + 2 * (size_t)b;
    return w->town.body[b].weight * (t[0] * t[0] + t[1] * t[1]);
}

/* Pins the one whose move is cheaper, of those that may move and did; either if none did, which cannot be. */
static sunder_status pin(sunder_i_job *w, uint32_t i, uint32_t j, sunder_error *err)
{
    const double home[2] = {0, 0};
    uint32_t b = can_move(w, i) ? i : j;
    if (can_move(w, i) && can_move(w, j) && cost_of(w, j) < cost_of(w, i)) b = j;
    if (can_move(w, i) && can_move(w, j) && cost_of(w, b) == 0) b = b == i ? j : i;
    const sunder_status status = put(w, b, home, err);
    w->town.body[b].pinned = true;
    return status;
}

sunder_status sunder_i_job_uphold(sunder_i_job *w, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (bool any = w->now.n > 0, pinned; any && !status;) {
        any = pinned = false;
        for (size_t k = 0; k < w->now.n && !status; k++) {
            const sunder_i_relation r = w->now.pair[k];
            const uint32_t i = w->town.body_of[r.a], j = w->town.body_of[r.b];
            bool breaks, well = false;
            status = breaks_rule(w, &r, &breaks, err);
            if (status || !breaks || (!can_move(w, i) && !can_move(w, j))) continue;
            any = true;
            status = mend(w, i, j, &well, err);
            if (status || well) continue;
            pinned = true;
            status = pin(w, i, j, err);
        }
        if (pinned && !status) status = sunder_i_job_settle(w, 0.8, 0.8, err);
    }
    return status;
}
