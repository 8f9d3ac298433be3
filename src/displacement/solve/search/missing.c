/* What a pair lacks of its distance.
 *
 * Two pieces lack the distance minus what lies between them, and two bodies, or a body and a barrier, the most that two
 * of their pieces lack, along the shortest link of these. That is known near the full distance, where tight pairs
 * stand. A pair that is left in conflict may overlap. Two members of it that overlap lack their distance, and the
 * length of the least translation that takes their interiors apart; the pair lacks the most that two members lack. That
 * is what the report counts and prices. The way to the nearest place at which the pair is solved may be much longer,
 * where that is not on the side of the least translation. It counts while the search looks for the pairs that can be
 * solved (elastic.c). */
#include "displacement/geometry/free_places.h"
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"

#include <math.h>
#include <string.h>

/* By how much the full distance of two pieces exceeds the one that they have to keep. */
static double slack_of(const sunder_i_search *s, const sunder_i_piece_pair *pair)
{
    if (!s->fully) return 0;
    const sunder_i_model *model = s->model;
    const uint32_t f = pair->a->feature, g = pair->b->feature;
    return sunder_i_full_above(model, f, g) - sunder_i_owed_above(model, f, g);
}

/* Does a line of a barrier cross the feature, which is kept so? Then the two lack nothing. */
static bool is_kept(const sunder_i_search *s, const sunder_i_piece_pair *pair)
{
    return sunder_i_is_crossed(s->model, pair->a->feature, pair->b->feature);
}

/* What neighbours in a row lack, at the relative move u of j, of the rule of rows with the full gap, along *along;
 * -INFINITY if they have no such rule. */
static double missing_along(const sunder_i_search *s, uint32_t i, uint32_t j, const double u[2], const double **along)
{
    const sunder_i_body *p = &s->model->body[s->body[i]];
    const sunder_i_row_side *side = p->has->row_sides ? sunder_i_row_side_of(s->model, p, s->body[j]) : NULL;
    if (!side || side->full == -INFINITY) return -INFINITY;
    *along = side->along;
    return side->full + (s->gap - s->model->rules.gap) - (u[0] * side->along[0] + u[1] * side->along[1]);
}

/* ---- Tight pairs ------------------------------------------------------------------------------------------------- */

typedef struct facing {
    const double *u;
    sunder_i_short_pair *out;
} facing;

static void take_pieces(sunder_i_search *s, const sunder_i_piece_pair *pair, void *context)
{
    const facing *f = context;
    double gap;
    size_t n;
    if (pair->shadow || pair->inclusion != SUNDER_I_LAPSED || is_kept(s, pair)) return;
    const sunder_i_obstacle_edge *edge = sunder_i_search_edges(s, pair, &n, &gap);
    if (!edge) return;
    const sunder_i_support h = sunder_i_search_support(pair, edge, n, f->u);
    const double full = gap + slack_of(s, pair);
    if (!(full - h.distance > f->out->missing)) return;
    f->out->missing = full - h.distance;
    f->out->n[0] = h.n[0];
    f->out->n[1] = h.n[1];
    f->out->d = h.support + full;
}

/* With a full gap, neighbours in a row also lack what they lack of its rule. */
static void take_row(const sunder_i_search *s, const double u[2], sunder_i_short_pair *out)
{
    const double *along = NULL, missing = missing_along(s, out->i, out->j, u, &along);
    if (!(missing > out->missing)) return;
    out->missing = missing;
    out->n[0] = along[0];
    out->n[1] = along[1];
    out->d = missing + along[0] * u[0] + along[1] * u[1];
}

void sunder_i_search_measure_pair(sunder_i_search *search, const double u[2], double reach, sunder_i_short_pair *pair)
{
    facing f = {u, pair};
    pair->missing = -reach;
    const double far = reach + sunder_i_search_full_gap(search);
    sunder_i_search_piece_pairs(search, pair->i, pair->j, u, far, false, take_pieces, &f);
    take_row(search, u, pair);
}

/* ---- Pairs left in conflict -------------------------------------------------------------------------------------- */

/* of: NULL, or the members whose pieces alone count, and without their distance. */
typedef struct forbidding {
    sunder_i_obstacles *obstacles;
    const double *shift;
    const sunder_i_member_pair *of;
} forbidding;

static bool is_of(const sunder_i_search *s, const sunder_i_piece_pair *pair, const sunder_i_member_pair *m)
{
    return sunder_i_whole_of(s->model, pair->a->feature) == m->a && pair->b->feature == m->b;
}

static void forbid_pieces(sunder_i_search *s, const sunder_i_piece_pair *pair, void *context)
{
    const forbidding *f = context;
    double gap;
    if (pair->shadow || is_kept(s, pair) || (f->of && (pair->inclusion != SUNDER_I_LAPSED || !is_of(s, pair, f->of))))
        return;
    const size_t n = sunder_i_search_obstacle(s, pair, &gap);
    for (size_t k = 0; k < 2 * n; k++) s->scratch.xy[k] += f->shift[k & 1];
    s->steps += OBSTACLE_WORK;
    gap = f->of ? 0 : gap + slack_of(s, pair);
    if (n) sunder_i_obstacles_add(f->obstacles, s->scratch.xy, n, sunder_i_max(gap, 0) + 2 * s->tolerance);
}

/* Finds the nearest place within `reach` at which body i keeps the full distance from the others. With members `of`,
 * the nearest one at which these two do not overlap. */
static bool find_place(sunder_i_search *s, const sunder_i_shortfall *f, const sunder_i_member_pair *of, const double *t,
                       double reach, double place[2])
{
    const double *at = t + 2 * (size_t)f->i;
    double found[1][2];
    sunder_i_obstacles_clear(&s->obstacles);
    for (uint32_t k = f->other; k < f->other + f->others && !s->failed; k++) {
        const uint32_t j = s->creditor.item[k];
        const double *from = t + 2 * (size_t)j, u[2] = {at[0] - from[0], at[1] - from[1]};
        forbidding all = {&s->obstacles, from, of};
        sunder_i_search_piece_pairs(s, j, f->i, u, reach + sunder_i_search_full_gap(s), false, forbid_pieces, &all);
    }
    const size_t n = sunder_i_free_places(&s->obstacles, at, reach, 0, 1, found, &s->steps, &s->failed);
    s->failed = s->failed || s->obstacles.failed;
    if (n) memcpy(place, found[0], sizeof found[0]);
    return n > 0;
}

/* Do the two bodies stand nearer than their full distance, by more than the tolerance? */
static bool lacks_distance(sunder_i_search *s, uint32_t i, uint32_t j, const double u[2])
{
    sunder_i_short_pair found = {.i = i, .j = j, .missing = 0};
    facing f = {u, &found};
    sunder_i_search_piece_pairs(s, i, j, u, sunder_i_search_full_gap(s), false, take_pieces, &f);
    return found.missing > s->tolerance;
}

static bool is_short(sunder_i_search *s, const sunder_i_shortfall *f, const double *t)
{
    bool yields = false;
    for (uint32_t k = f->other; k < f->other + f->others && !yields; k++) {
        const uint32_t j = s->creditor.item[k], a = j < f->i ? j : f->i, b = j < f->i ? f->i : j;
        const double u[2] = {t[2 * b] - t[2 * a], t[2 * b + 1] - t[2 * a + 1]};
        sunder_i_search_pair(s, a, b, u, &yields);
        if (!yields && s->fully) yields = lacks_distance(s, a, b, u);
    }
    return yields;
}

/* Finds the nearest such place, in ever wider circles. Returns false if there is none. */
static bool find_nearest(sunder_i_search *s, const sunder_i_shortfall *f, const sunder_i_member_pair *of,
                         const double *t, double place[2])
{
    const sunder_i_body *p = &s->model->body[s->body[f->i]];
    const double size = sunder_i_max(p->box[2] - p->box[0], p->box[3] - p->box[1]) + s->gap;
    bool found = false;
    for (double reach = size / 2; reach <= BEYOND_ALL * size && !found && !s->failed; reach *= PAIR_GROWTH)
        found = find_place(s, f, of, t, reach, place);
    return found;
}

/* ---- What their members lack ------------------------------------------------------------------------------------- */

/* Notes what two pieces lack for the pair of their members. */
static void note_pieces(sunder_i_search *s, const sunder_i_piece_pair *pair, void *context)
{
    const double *u = context;
    double gap;
    size_t n, k = 0;
    if (pair->shadow || pair->inclusion != SUNDER_I_LAPSED || is_kept(s, pair)) return;
    const sunder_i_obstacle_edge *edge = sunder_i_search_edges(s, pair, &n, &gap);
    if (!edge) return;
    const sunder_i_support h = sunder_i_search_support(pair, edge, n, u);
    const double owed = gap + slack_of(s, pair);
    while (k < s->members && !is_of(s, pair, &s->member[k])) k++;
    if (k == s->members) {
        if (!sunder_i_reserve(&s->member, &s->member_capacity, s->members + 1, sizeof *s->member)) {
            s->failed = true;
            return;
        }
        s->member[s->members++] = (sunder_i_member_pair){
            .a = sunder_i_whole_of(s->model, pair->a->feature), .b = pair->b->feature, .missing = -INFINITY};
    }
    sunder_i_member_pair *m = &s->member[k];
    if (!(owed - h.distance > m->missing)) return;
    *m = (sunder_i_member_pair){m->a, m->b, owed, owed - h.distance, {h.n[0], h.n[1]}, h.distance < 0};
}

/* If two members overlap, they lack their distance and the way to the nearest place at which they do not. */
static void measure_overlap(sunder_i_search *s, const sunder_i_shortfall *f, const double *t, sunder_i_member_pair *m)
{
    double place[2];
    if (!find_nearest(s, f, m, t, place)) {
        m->missing = INFINITY;
        return;
    }
    const double away[2] = {place[0] - f->at[0], place[1] - f->at[1]}, depth = hypot(away[0], away[1]);
    if (!(depth > 0) || !(depth + m->owed > m->missing)) return;
    m->missing = depth + m->owed;
    for (int c = 0; c < 2; c++) m->n[c] = away[c] / depth;
}

/* Sets what the pair lacks: the most that two of its members lack, as the report counts it. */
static void measure_members(sunder_i_search *s, sunder_i_shortfall *f, const double *t)
{
    s->members = 0;
    for (uint32_t k = f->other; k < f->other + f->others && !s->failed; k++) {
        const uint32_t j = s->creditor.item[k];
        double u[2] = {f->at[0] - t[2 * j], f->at[1] - t[2 * j + 1]};
        sunder_i_search_piece_pairs(s, j, f->i, u, sunder_i_search_full_gap(s), false, note_pieces, u);
    }
    for (size_t k = 0; k < s->members && !s->failed; k++) {
        sunder_i_member_pair *m = &s->member[k];
        if (m->overlaps) measure_overlap(s, f, t, m);
        if (!(m->missing > f->missing)) continue;
        f->missing = m->missing;
        for (int c = 0; c < 2; c++) f->place[c] = f->at[c] + (m->missing < INFINITY ? m->missing * m->n[c] : 0);
    }
}

/* With a full gap, neighbours in a row also lack what they lack of its rule; the nearest place is then along it. */
static void measure_along(const sunder_i_search *s, sunder_i_shortfall *f)
{
    const double u[2] = {f->from[0] - f->at[0], f->from[1] - f->at[1]}, *along = NULL,
                 missing = missing_along(s, f->i, s->creditor.item[f->other], u, &along);
    if (!(missing > f->missing)) return;
    f->missing = missing;
    for (int c = 0; c < 2; c++) f->place[c] = f->at[c] - missing * along[c];
}

void sunder_i_search_measure_shortfall(sunder_i_search *search, sunder_i_shortfall *shortfall, const double *t)
{
    sunder_i_shortfall *f = shortfall;
    const double *at = t + 2 * (size_t)f->i, *from = t + 2 * (size_t)search->creditor.item[f->other];
    if (f->known && memcmp(f->at, at, sizeof f->at) == 0 && memcmp(f->from, from, sizeof f->from) == 0) return;
    memcpy(f->at, at, sizeof f->at);
    memcpy(f->from, from, sizeof f->from);
    f->known = true;
    f->missing = 0;
    if (is_short(search, f, t)) {
        if (!search->to_solved)
            measure_members(search, f, t);
        else if (find_nearest(search, f, NULL, t, f->place))
            f->missing = hypot(f->place[0] - at[0], f->place[1] - at[1]);
        else
            f->missing = INFINITY;
    }
    if (search->fully) measure_along(search, f);
}
