/* Pairs that keep the distance that they have to keep, but may lack some of their full distance, at a price
 * (../../layer/full_gap.c, missing.c). A program has one priced constraint for each pair, along the shortest link, for
 * pairs that lack nothing so far, too. Pairs that are left in conflict are in shortfall.c. */
#include "displacement/solve/search/search_stages.h"

#include <stdlib.h>

#define TIGHT_KEY (UINT64_C(31) << 58)

static uint64_t key_of(uint32_t i, uint32_t j) { return TIGHT_KEY | (uint64_t)i << 29 | j; }

bool sunder_i_search_is_tight_key(uint64_t key, uint32_t *i, uint32_t *j)
{
    *i = (uint32_t)(key >> 29 & 0x1fffffff);
    *j = (uint32_t)(key & 0x1fffffff);
    return key >> 58 == TIGHT_KEY >> 58;
}

/* ---- Which pairs ------------------------------------------------------------------------------------------------- */

typedef struct looking {
    const double *t;
    double reach;
} looking;

static void take_bodies(sunder_i_search *s, uint32_t i, uint32_t j, void *context)
{
    const looking *l = context;
    double shift;
    if (sunder_i_search_is_relaxed(s, s->body[i], s->body[j], &shift)) return;
    if (!(s->mass[i] > 0) || sunder_i_is_barrier_body(s->model, &s->model->body[s->body[i]])) {
        const uint32_t swap = i;
        i = j;
        j = swap;
    }
    const uint32_t whole = sunder_i_whole_of(s->model, s->model->member[s->model->body[s->body[j]].member]);
    const double u[2] = {l->t[2 * j] - l->t[2 * i], l->t[2 * j + 1] - l->t[2 * i + 1]};
    sunder_i_short_pair found = {.i = i, .j = j, .whole = whole};
    sunder_i_search_measure_pair(s, u, l->reach, &found);
    if (s->failed || !(found.missing > -l->reach)) return;
    if (sunder_i_reserve(&s->tight, &s->tight_capacity, s->tights + 1, sizeof *s->tight))
        s->tight[s->tights++] = found;
    else
        s->failed = true;
}

/* Sorts pairs by bodies, those of one barrier by what they lack, the most first. */
static int by_pair(const void *x, const void *y)
{
    const sunder_i_short_pair *p = x, *q = y;
    if (p->i != q->i) return p->i < q->i ? -1 : 1;
    if (p->whole != q->whole) return p->whole < q->whole ? -1 : 1;
    if (p->missing != q->missing) return p->missing > q->missing ? -1 : 1;
    return p->j < q->j ? -1 : p->j > q->j;
}

/* Finds the pairs that are within `reach` of their full distance at the moves t. */
static void find_tight(sunder_i_search *s, const double *t, double reach)
{
    looking l = {t, reach};
    s->tights = 0;
    sunder_i_search_visit_near(s, t, sunder_i_search_full_gap(s) + reach, take_bodies, &l);
    if (s->tights) qsort(s->tight, s->tights, sizeof *s->tight, by_pair);
    size_t out = 0;
    for (size_t k = 0; k < s->tights; k++)
        if (out == 0 || s->tight[k].i != s->tight[out - 1].i || s->tight[k].whole != s->tight[out - 1].whole)
            s->tight[out++] = s->tight[k];
    s->tights = out;
}

static sunder_i_price price_of(const sunder_i_search *s, const sunder_i_short_pair *pair)
{
    return sunder_i_price_of(s->model, &s->model->body[s->body[pair->i]], &s->model->body[s->body[pair->j]]);
}

double sunder_i_search_tight_price(sunder_i_search *search, const double *t)
{
    double cost = 0;
    if (!search->prices_tight) return 0;
    find_tight(search, t, 0);
    for (size_t k = 0; k < search->tights && !search->failed; k++) {
        const sunder_i_price price = price_of(search, &search->tight[k]);
        cost += sunder_i_price_at(&price, search->tight[k].missing);
    }
    return cost;
}

/* ---- Constraints ------------------------------------------------------------------------------------------------- */

void sunder_i_search_constrain_tight(sunder_i_search *search, double reach)
{
    if (!search->prices_tight) return;
    find_tight(search, search->t, reach);
    for (size_t k = 0; k < search->tights && !search->failed; k++) {
        const sunder_i_short_pair *pair = &search->tight[k];
        const sunder_i_price price = price_of(search, pair);
        const bool moves = search->mass[pair->j] > 0;
        const double *t = search->t + 2 * (size_t)pair->j;
        const uint64_t key = key_of(pair->i, pair->j);
        const sunder_i_constraint c = {.i = pair->i,
                                       .j = moves ? pair->j : SUNDER_I_GROUND,
                                       .n = {pair->n[0], pair->n[1]},
                                       .d = pair->d - (moves ? 0 : pair->n[0] * t[0] + pair->n[1] * t[1]),
                                       .force = sunder_i_search_force_before(search, key),
                                       .give = 1 / (2 * price.square),
                                       .price = price.linear,
                                       .key = key};
        sunder_i_search_add_constraint(search, search->program.n, &c);
    }
}
