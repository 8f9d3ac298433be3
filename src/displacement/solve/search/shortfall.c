/* What pairs that are left in conflict still lack, and the constraints that ease them.
 *
 * A pair lacks s: the distance from its relative move to the nearest relative move at which it is solved. That has a
 * price (../../layer/prices.h). Let p be the nearest place of body i at which the pair is solved, and n the direction
 * to it. To first order s is n.(p - t_i), so a program has the constraint n.t_i >= n.p with this price. If the boundary
 * of the solved places is straight nearby, this is exact. Otherwise the next program has a constraint with another
 * direction, and a step that is no cheaper is shortened (descend.c). */
#include "displacement/geometry/free_places.h"
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"

#include <math.h>
#include <string.h>

/* ---- Which pairs ------------------------------------------------------------------------------------------------- */

/* Adds the pair of bodies i and j of the search, one of which may move. A part of a barrier joins the part before
 * it. */
static bool add_pair(sunder_i_search *s, uint32_t i, uint32_t j)
{
    const sunder_i_model *model = s->model;
    if (!(s->mass[i] > 0)) {
        const uint32_t swap = i;
        i = j;
        j = swap;
    }
    const sunder_i_body *p = &model->body[s->body[i]], *q = &model->body[s->body[j]];
    const sunder_i_price price = sunder_i_price_of(model, p, q);
    sunder_i_shortfall *last = s->shortfalls ? &s->shortfall[s->shortfalls - 1] : NULL;
    const uint32_t whole = sunder_i_whole_of(model, model->member[q->member]);
    const bool joins =
        last && last->i == i && sunder_i_is_barrier_body(model, q) &&
        sunder_i_whole_of(model, model->member[model->body[s->body[s->creditor.item[last->other]]].member]) == whole;
    if (!sunder_i_list_push(&s->creditor, j)) return false;
    if (joins) {
        last->others++;
        return true;
    }
    if (!sunder_i_reserve(&s->shortfall, &s->shortfall_capacity, s->shortfalls + 1, sizeof *s->shortfall)) return false;
    s->shortfall[s->shortfalls++] =
        (sunder_i_shortfall){.i = i, .other = (uint32_t)(s->creditor.n - 1), .others = 1, .price = price};
    return true;
}

/* Lists the pairs of the search that these relaxations are about. False if memory is out. */
static bool list_pairs(sunder_i_search *search, const sunder_i_relaxations *all)
{
    bool ok = true;
    search->shortfalls = search->creditor.n = 0;
    for (uint32_t i = 0; i < search->n && ok; i++) {
        const uint32_t body = search->body[i];
        size_t low = 0, high = all->relaxed_n;
        while (low < high) {
            const size_t mid = low + (high - low) / 2;
            if (all->relaxed[mid].i < body)
                low = mid + 1;
            else
                high = mid;
        }
        for (; low < all->relaxed_n && all->relaxed[low].i == body && ok; low++) {
            const uint32_t j = sunder_i_search_place_of(search, all->relaxed[low].j);
            if (j != SUNDER_I_NOBODY && search->mass[i] + search->mass[j] > 0) ok = add_pair(search, i, j);
        }
    }
    return ok;
}

bool sunder_i_search_ease(sunder_i_search *search) { return list_pairs(search, &search->model->relaxations); }

bool sunder_i_search_ease_own(sunder_i_search *search) { return list_pairs(search, &search->relaxations); }

/* ---- How much ---------------------------------------------------------------------------------------------------- */

typedef struct forbidding {
    sunder_i_obstacles *obstacles;
    const double *shift;
} forbidding;

static void forbid_pieces(sunder_i_search *s, const sunder_i_piece_pair *pair, void *context)
{
    const forbidding *f = context;
    double gap;
    if (pair->shadow) return;
    const size_t n = sunder_i_search_obstacle(s, pair, &gap);
    for (size_t k = 0; k < 2 * n; k++) s->scratch.xy[k] += f->shift[k & 1];
    s->steps += OBSTACLE_WORK;
    gap += sunder_i_search_slack(s, pair);
    if (n) sunder_i_obstacles_add(f->obstacles, s->scratch.xy, n, sunder_i_max(gap, 0) + 2 * s->tolerance);
}

/* Finds the nearest place within `reach` at which body i keeps the full distance from the others. */
static bool find_place(sunder_i_search *s, const sunder_i_shortfall *f, const double *t, double reach, double place[2])
{
    const double *at = t + 2 * (size_t)f->i;
    double found[1][2];
    sunder_i_obstacles_clear(&s->obstacles);
    for (uint32_t k = f->other; k < f->other + f->others && !s->failed; k++) {
        const uint32_t j = s->creditor.item[k];
        const double *from = t + 2 * (size_t)j, u[2] = {at[0] - from[0], at[1] - from[1]};
        forbidding all = {&s->obstacles, from};
        sunder_i_search_piece_pairs(s, j, f->i, u, reach + sunder_i_search_full_gap(s), false, forbid_pieces, &all);
    }
    const size_t n = sunder_i_free_places(&s->obstacles, at, reach, 0, 1, found, &s->steps, &s->failed);
    s->failed = s->failed || s->obstacles.failed;
    if (n) memcpy(place, found[0], sizeof found[0]);
    return n > 0;
}

static bool is_short(sunder_i_search *s, const sunder_i_shortfall *f, const double *t)
{
    bool yields = false;
    for (uint32_t k = f->other; k < f->other + f->others && !yields; k++) {
        const uint32_t j = s->creditor.item[k], a = j < f->i ? j : f->i, b = j < f->i ? f->i : j;
        const double u[2] = {t[2 * b] - t[2 * a], t[2 * b + 1] - t[2 * a + 1]};
        sunder_i_search_pair(s, a, b, u, &yields);
        if (!yields && s->fully) yields = sunder_i_search_missing(s, a, b, u) > s->tolerance;
    }
    return yields;
}

/* With a full gap, neighbours in a row also lack what they lack of its rule; the nearest place is then along it. */
static void measure_along(const sunder_i_search *s, sunder_i_shortfall *f)
{
    const double u[2] = {f->from[0] - f->at[0], f->from[1] - f->at[1]}, *along = NULL,
                 missing = sunder_i_search_missing_along(s, f->i, s->creditor.item[f->other], u, &along);
    if (!(missing > f->missing)) return;
    f->missing = missing;
    for (int c = 0; c < 2; c++) f->place[c] = f->at[c] - missing * along[c];
}

/* Computes what the pair lacks at t, unless it is known. */
static void measure(sunder_i_search *s, sunder_i_shortfall *f, const double *t)
{
    const double *at = t + 2 * (size_t)f->i, *from = t + 2 * (size_t)s->creditor.item[f->other];
    if (f->known && memcmp(f->at, at, sizeof f->at) == 0 && memcmp(f->from, from, sizeof f->from) == 0) return;
    memcpy(f->at, at, sizeof f->at);
    memcpy(f->from, from, sizeof f->from);
    f->known = true;
    f->missing = 0;
    if (is_short(s, f, t)) {
        const sunder_i_body *p = &s->model->body[s->body[f->i]];
        const double size = sunder_i_max(p->box[2] - p->box[0], p->box[3] - p->box[1]) + s->gap;
        f->missing = INFINITY;
        for (double reach = size / 2; reach <= BEYOND_ALL * size && f->missing == INFINITY && !s->failed;
             reach *= PAIR_GROWTH)
            if (find_place(s, f, t, reach, f->place)) f->missing = hypot(f->place[0] - at[0], f->place[1] - at[1]);
    }
    if (s->fully) measure_along(s, f);
}

double sunder_i_search_shortfall_price(sunder_i_search *search, const double *t)
{
    double price = 0;
    for (size_t k = 0; k < search->shortfalls; k++) {
        sunder_i_shortfall *f = &search->shortfall[k];
        measure(search, f, t);
        if (f->missing < INFINITY) price += sunder_i_price_at(&f->price, f->missing);
    }
    return price;
}

/* ---- Constraints ------------------------------------------------------------------------------------------------- */

void sunder_i_search_constrain_shortfalls(sunder_i_search *search)
{
    for (size_t k = 0; k < search->shortfalls && !search->failed; k++) {
        sunder_i_shortfall *f = &search->shortfall[k];
        const uint32_t j = search->creditor.item[f->other];
        measure(search, f, search->t);
        if (!(f->missing > 0) || f->missing == INFINITY) continue;
        const double n[2] = {(f->place[0] - f->at[0]) / f->missing, (f->place[1] - f->at[1]) / f->missing};
        const bool moves = search->mass[j] > 0;
        const sunder_i_constraint c = {.i = moves ? j : SUNDER_I_GROUND,
                                       .j = f->i,
                                       .n = {n[0], n[1]},
                                       .d = n[0] * (f->place[0] - (moves ? f->from[0] : 0)) +
                                            n[1] * (f->place[1] - (moves ? f->from[1] : 0)),
                                       .give = 1 / (2 * f->price.square),
                                       .price = f->price.linear,
                                       .key = UINT64_C(29) << 58 | k};
        sunder_i_search_add_constraint(search, search->program.n, &c);
    }
}
