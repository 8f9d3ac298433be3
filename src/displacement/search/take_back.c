/* Pairs that a search has given up are asked for again, one after the other, from where it stands.
 *
 * Several are given up at once (give_up.c), and of those that hang together some are given up for others: with the
 * rest out of the way they may have a solution. So bodies between which something is given up owe each other all again,
 * those that overlapped first, then by what is missing, and the search goes down from there; where it comes to no end,
 * within what one may take, all is put back as it was. They are asked until so many were in vain. */
#include "displacement/search/stages.h"
#include "displacement/search/tuning.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Two bodies, i < j, and what it would take to resolve all that is given up between them. */
typedef struct wish {
    uint32_t i, j;
    double missing;
    bool overlap;
} wish;

static int by_ease(const void *a, const void *b)
{
    const wish *p = a, *q = b;
    if (p->overlap != q->overlap) return p->overlap ? -1 : 1;
    if (p->missing != q->missing) return p->missing < q->missing ? -1 : 1;
    return sunder_i_by_id_pair(p, q);
}

static wish *wish_of(const sunder_i_search *s, const sunder_i_relaxations *all, const sunder_i_relaxation *t,
                     wish *list)
{
    const uint32_t *body_of = s->model->body_of;
    return &list[sunder_i_relaxations_between(all, body_of[t->a], body_of[t->b]) - all->relaxed];
}

/* One for each two bodies, in the order in which they are asked. */
static void list_wishes(const sunder_i_search *s, const sunder_i_relaxations *all, wish *list)
{
    for (size_t k = 0; k < all->relaxed_n; k++) list[k] = (wish){all->relaxed[k].i, all->relaxed[k].j, 0, false};
    for (size_t k = 0; k < all->n; k++) {
        const sunder_i_relaxation *t = &all->item[k];
        const double depth = hypot(t->shift[0], t->shift[1]);
        wish *w = wish_of(s, all, t, list);
        w->overlap = w->overlap || depth > 0;
        w->missing = fmax(w->missing, depth > 0 ? depth : sunder_i_owed_above(s->model, t->a, t->b) - t->gap);
    }
    qsort(list, all->relaxed_n, sizeof *list, by_ease);
}

static bool is_between(const sunder_i_search *s, const sunder_i_relaxation *t, const wish *w)
{
    const uint32_t p = s->model->body_of[t->a], q = s->model->body_of[t->b];
    return (p == w->i && q == w->j) || (p == w->j && q == w->i);
}

/* Returns whether it was granted. stand: [2 n] scratch. */
static bool ask(sunder_i_search *s, const sunder_i_relaxations *all, const wish *w, double *stand)
{
    const size_t size = 2 * s->n * sizeof *stand;
    for (size_t k = 0; k < all->n; k++)
        if (is_between(s, &all->item[k], w)) sunder_i_relaxations_remove(&s->relaxations, s->model, &all->item[k]);
    memcpy(stand, s->t, size);
    s->program.n = 0;
    if (sunder_i_search_descend(s)) return true;
    memcpy(s->t, stand, size);
    for (size_t k = 0; k < all->n && !s->failed; k++)
        if (is_between(s, &all->item[k], w) && !sunder_i_relaxations_insert(&s->relaxations, s->model, &all->item[k]))
            s->failed = true;
    return false;
}

void sunder_i_search_take_back(sunder_i_search *s)
{
    sunder_i_relaxations all = {0};
    for (size_t k = 0; k < s->relaxations.n && !s->failed; k++)
        if (!sunder_i_relaxations_add(&all, &s->relaxations.item[k])) s->failed = true;
    if (!s->failed && !sunder_i_relaxations_index(&all, s->model)) s->failed = true;
    wish *list = sunder_i_alloc(all.relaxed_n, sizeof *list);
    double *stand = sunder_i_alloc(2 * s->n, sizeof *stand);
    s->failed = s->failed || !list || !stand;
    if (!s->failed) list_wishes(s, &all, list);
    const uint64_t end = sunder_i_search_work(s) + TAKE_BACK_MOST;
    unsigned in_vain = 0; /* one after the other */
    for (size_t k = 0; k < all.relaxed_n && in_vain < TAKE_BACK_IN_VAIN && !s->failed && sunder_i_search_work(s) < end;
         k++) {
        s->patience = sunder_i_search_work(s) + TAKE_BACK_EACH;
        in_vain = ask(s, &all, &list[k], stand) ? 0 : in_vain + 1;
    }
    s->patience = UINT64_MAX;
    sunder_i_relaxations_free(&all);
    sunder_i_free(list);
    sunder_i_free(stand);
}
