/* Two features that only conflict with each other: the exact core gives the least translation that separates them, and
 * it is divided between them in proportion to their masses. No other moves of these features are cheaper, whatever the
 * sides, so no search is needed. Most pairs of single buildings are such. The margin that covers rounding is not needed
 * if the rounded moves keep the gap exactly. If anything else affects the features (a limit, an anchor that may not be
 * passed), a clash is found at the computed places, and the search begins as for all other clusters. */
#include "displacement/layer/barrier_pairs.h"
#include "displacement/layer/rounding.h"
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "separation/separation.h"

#include <math.h>
#include <string.h>

/* The feature that makes up the body; SUNDER_I_NOBODY: it is a block, or part of a barrier. */
static uint32_t only_feature(const sunder_i_model *model, uint32_t body)
{
    const sunder_i_body *b = &model->body[body];
    return b->members == 1 && !sunder_i_is_barrier_body(model, b) ? model->member[b->member] : SUNDER_I_NOBODY;
}

/* Is one of the two, which can move, in a row, with springs to its neighbours? The springs of a body that cannot move
 * are those of its neighbours, and a part of the layer need not know them. */
static bool has_springs(const sunder_i_search *s)
{
    const double *stiffness = s->model->rules.row_stiffness;
    for (int k = 0; k < 2; k++)
        if (s->mass[k] > 0 && s->model->body[s->body[k]].has->row_sides > 0 && stiffness[0] + stiffness[1] > 0)
            return true;
    return false;
}

/* Does one of the two prefer another place than its own? */
static bool has_preferred(const sunder_i_search *s)
{
    for (int k = 0; k < 4; k++)
        if (s->preferred[k] != 0) return true;
    return false;
}

/* Is the search about two single features, with nothing to keep but the gap? */
static bool is_lone_pair(const sunder_i_search *s, const sunder_i_cluster *cluster)
{
    double reach;
    return s->n == 2 && !cluster->starts_from_areas && !has_springs(s) && !has_preferred(s) &&
           s->mass[0] + s->mass[1] > 0 && !sunder_i_may_be_inside(&s->model->rules) &&
           only_feature(s->model, s->body[0]) != SUNDER_I_NOBODY &&
           only_feature(s->model, s->body[1]) != SUNDER_I_NOBODY &&
           !sunder_i_search_is_relaxed(s, s->body[0], s->body[1], &reach);
}

/* The sum of the limits of the two movable bodies, rounded up: a longer separation is of no use. */
static double farthest_apart(const sunder_i_search *s)
{
    double sum = 0;
    for (uint32_t k = 0; k < 2; k++) sum += s->mass[k] > 0 ? sunder_i_search_limit(s, k) : 0;
    return nextafter(sum, INFINITY);
}

/* Separates the two bodies by the translation `away`, made longer until they keep the margin, too: between two lines
 * that form a corner, a move that leaves a margin to both lines is longer than the margin. s->t has the moves; false if
 * MOST_LENGTHENED lengths do not suffice. */
static bool stand_apart(sunder_i_search *s, const double away[2])
{
    const double length = hypot(away[0], away[1]), margin = s->gap - s->model->rules.gap;
    const double share = s->mass[1] / (s->mass[0] + s->mass[1]);
    for (int k = 0; k < MOST_LENGTHENED && !s->failed; k++) {
        const double longer = 1 + ldexp(margin, k) / length;
        if (!isfinite(longer * length)) return false;
        for (size_t c = 0; c < 2; c++) {
            s->t[c] = (share - 1) * longer * away[c];
            s->t[2 + c] = share * longer * away[c];
        }
        if (sunder_i_search_find_clashes(s, s->t) <= s->tolerance) return true;
    }
    return false;
}

/* ---- Exact contact ----------------------------------------------------------------------------------------------- */

/* The exact test that makes the margin unnecessary: *apart if the two features keep the gap after the moves t, which
 * doubles represent exactly. */
static sunder_status are_apart(const sunder_i_search *s, const sunder_bound_pair *pair, const double t[4], bool *apart,
                               sunder_error *err)
{
    const sunder_shape *p = sunder_i_thing_shape(s->model, pair->a), *q = sunder_i_thing_shape(s->model, pair->b);
    const double gap = sunder_i_gap_of(s->model, (uint32_t)pair->a, (uint32_t)pair->b);
    return sunder_i_apart(p, t, q, t + 2, gap, apart, err);
}

/* Rounds the move of body k, unless it is fixed. Returns whether the moved coordinates are doubles without further
 * rounding. *unit: the larger of the units of the move's two coordinates; 0 for a fixed body. */
static bool round_one(const sunder_i_search *s, uint32_t k, double t[4], double *unit)
{
    double to[2];
    *unit = 0;
    if (!(s->mass[k] > 0)) return true;
    const bool exact = sunder_i_round_move(s->model, s->body[k], t + 2 * k, to, unit);
    memcpy(t + 2 * k, to, sizeof to);
    return exact;
}

/* Divides the relative move `away` between the two bodies, in t, rounded. The move with the coarser unit is rounded
 * first, and the other makes up for it, so that their difference is `away` if that is a multiple of the finer unit. The
 * move with the finer unit is made longer by one unit along each axis whose bit in `along` is set. False if moved
 * coordinates would need rounding. */
static bool share_rounded(const sunder_i_search *s, const double away[2], unsigned along, double t[4])
{
    const double share = s->mass[1] / (s->mass[0] + s->mass[1]);
    double unit[2], shared[4];
    for (size_t c = 0; c < 2; c++) {
        t[c] = shared[c] = s->mass[0] > 0 ? (share - 1) * away[c] : 0;
        t[2 + c] = shared[2 + c] = s->mass[1] > 0 ? share * away[c] : 0;
    }
    if (!round_one(s, 0, t, &unit[0]) || !round_one(s, 1, t, &unit[1])) return false;
    const uint32_t last = s->mass[0] > 0 && (s->mass[1] == 0 || unit[0] <= unit[1]) ? 0 : 1;
    const double sign = last ? 1 : -1;
    for (size_t c = 0; c < 2; c++) {
        const double farther = along >> c & 1 ? copysign(unit[last], away[c]) : 0;
        t[2 * last + c] = sign * (away[c] + farther) + t[2 * (1 - last) + c];
    }
    return round_one(s, last, t, &unit[last]);
}

/* Divides the least translation `away` between the two bodies, without a margin, if moved coordinates are doubles and
 * the exact test succeeds: for the nearest rounded moves, or for moves one unit longer along one axis or both. *done if
 * that succeeds; s->t has these moves then. */
static sunder_status stand_in_contact(sunder_i_search *s, const sunder_bound_pair *pair, const double away[2],
                                      bool *done, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    *done = false;
    for (unsigned along = 0; along < 4 && !*done && !status; along++) {
        double t[4];
        if ((along & 1 && away[0] == 0) || (along & 2 && away[1] == 0)) continue;
        if (!share_rounded(s, away, along, t)) continue;
        status = are_apart(s, pair, t, done, err);
        if (!status && *done) memcpy(s->t, t, sizeof t);
    }
    return status;
}

sunder_status sunder_i_search_separate_lone_pair(sunder_i_search *search, sunder_i_cluster *cluster, bool *done,
                                                 sunder_error *err)
{
    *done = false;
    if (search->failed || !is_lone_pair(search, cluster)) return SUNDER_OK;
    const sunder_bound_pair pair = {.a = only_feature(search->model, search->body[0]),
                                    .b = only_feature(search->model, search->body[1])};
    const double stood[4] = {search->t[0], search->t[1], search->t[2], search->t[3]};
    sunder_i_resolution r;
    const sunder_status status =
        sunder_i_resolve_things(search->model, pair.a, pair.b, farthest_apart(search), &r, err);
    if (status || r.beyond || !(r.least > 0)) return status;
    cluster->measured = pair;
    cluster->measured.least = r.least;
    *done = stand_apart(search, r.away);
    if (!*done) memcpy(search->t, stood, sizeof stood);
    if (!*done || !cluster->touching) return SUNDER_OK;
    bool in_contact;
    return stand_in_contact(search, &pair, r.away, &in_contact, err);
}
