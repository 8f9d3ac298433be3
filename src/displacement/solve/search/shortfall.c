/* The price of what pairs that are left in conflict still lack, and the constraints that ease them.
 *
 * A pair lacks s (missing.c), in a direction n of body i, and that has a price (../../layer/prices.h). Let p be the
 * place of body i at the end of that way. To first order s is n.(p - t_i), so a program has the constraint n.t_i >= n.p
 * with this price. If the boundary of the places nearby is straight, this is exact. Otherwise the next program has a
 * constraint with another direction, and a step that is no cheaper is shortened (descend.c). */
#include "displacement/solve/search/search_stages.h"

#include <math.h>

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

bool sunder_i_search_ease_own(sunder_i_search *search)
{
    search->to_solved = true;
    return list_pairs(search, &search->relaxations);
}

/* ---- Price and constraints --------------------------------------------------------------------------------------- */

double sunder_i_search_shortfall_price(sunder_i_search *search, const double *t)
{
    double price = 0;
    for (size_t k = 0; k < search->shortfalls; k++) {
        sunder_i_shortfall *f = &search->shortfall[k];
        sunder_i_search_measure_shortfall(search, f, t);
        if (f->missing < INFINITY) price += sunder_i_price_at(&f->price, f->missing);
    }
    return price;
}

void sunder_i_search_constrain_shortfalls(sunder_i_search *search)
{
    for (size_t k = 0; k < search->shortfalls && !search->failed; k++) {
        sunder_i_shortfall *f = &search->shortfall[k];
        const uint32_t j = search->creditor.item[f->other];
        sunder_i_search_measure_shortfall(search, f, search->t);
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
