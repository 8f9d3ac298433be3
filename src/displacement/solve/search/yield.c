/* The last resort of a search that ends with clashes. A clashing pair that also clashes in the original places is
 * relaxed; the bodies of any other clashing pair return to their original places. That is repeated until nothing
 * clashes. It ends, since with all bodies in their original places every relaxation holds. */
#include "displacement/solve/search/search_stages.h"

#include <stdlib.h>
#include <string.h>

/* Relaxes pair (i, j), unless this search has done so already. Returns whether relaxations were added. */
bool sunder_i_search_relax(sunder_i_search *search, uint32_t i, uint32_t j)
{
    const uint32_t p = search->body[i], q = search->body[j];
    if (sunder_i_relaxations_between(&search->relaxations, p, q)) return false;
    const size_t before = search->relaxations.n;
    /* All pairs of features within the distance that the search demands. */
    if (!sunder_i_relaxations_make(search->model, p, q, search->gap + 2 * search->tolerance, &search->relaxations))
        search->failed = true;
    return search->relaxations.n > before;
}

bool sunder_i_search_send_home(sunder_i_search *search, uint32_t i)
{
    if (!(search->mass[i] > 0) || (search->t[2 * i] == 0 && search->t[2 * i + 1] == 0)) return false;
    search->t[2 * i] = search->t[2 * i + 1] = 0;
    return true;
}

/* Pairs of bodies that may come near each other when some return to their original places; and the neighbours of each
 * body. */
typedef struct neighbours {
    sunder_i_id_pair *pair;
    size_t pairs, capacity;
    size_t *first;   /* [n + 1] */
    uint32_t *other; /* neighbours of body k, from first[k] to first[k + 1] */
} neighbours;

static void free_neighbours(neighbours *g) { sunder_i_free_all(g->pair, g->first, g->other); }

static void add_pair(sunder_i_search *s, uint32_t i, uint32_t j, void *context)
{
    neighbours *g = context;
    if (!sunder_i_reserve(&g->pair, &g->capacity, g->pairs + 1, sizeof *g->pair)) {
        s->failed = true;
        return;
    }
    g->pair[g->pairs++] = (sunder_i_id_pair){i, j};
}

static void find_neighbours(sunder_i_search *s, neighbours *g)
{
    sunder_i_search_visit_near_or_home(s, s->gap, add_pair, g);
    g->first = sunder_i_calloc(s->n + 1, sizeof *g->first);
    g->other = sunder_i_alloc(2 * g->pairs, sizeof *g->other);
    s->failed = s->failed || !g->first || !g->other;
    if (s->failed) return;
    for (size_t k = 0; k < g->pairs; k++) g->first[g->pair[k].a]++, g->first[g->pair[k].b]++;
    /* the end of each, which becomes the start below */
    for (size_t k = 0, sum = 0; k <= s->n; k++) g->first[k] = sum += g->first[k];
    for (size_t k = g->pairs; k-- > 0;) {
        g->other[--g->first[g->pair[k].a]] = g->pair[k].b;
        g->other[--g->first[g->pair[k].b]] = g->pair[k].a;
    }
}

/* Replaces s->clash by the clashes of pairs of which at least one body is marked in changed[n]. */
static void look_at_changed(sunder_i_search *s, const neighbours *g, const bool *changed)
{
    s->clashes = 0;
    for (uint32_t i = 0; i < s->n; i++) {
        if (!changed[i]) continue;
        for (size_t k = g->first[i]; k < g->first[i + 1] && !s->failed; k++) {
            const uint32_t j = g->other[k];
            if (!changed[j] || i < j) sunder_i_search_add_clash(s, s->t, i < j ? i : j, i < j ? j : i);
        }
    }
}

/* For each clash in s->clash of more than `hair`: relaxes the pair if it is one of the n pairs at_home and not relaxed
 * yet; otherwise sends both bodies home. Marks the bodies concerned in changed[], and returns whether there were
 * any. */
static bool yield_once(sunder_i_search *s, const sunder_i_clash *at_home, size_t n, double hair, bool *changed)
{
    bool any = false;
    const size_t before = s->relaxations.n;
    memset(changed, 0, s->n * sizeof *changed);
    for (size_t k = 0; k < s->clashes && !s->failed; k++) {
        const sunder_i_clash *c = &s->clash[k];
        if (c->violation <= hair) continue;
        const bool yields =
            n && bsearch(c, at_home, n, sizeof *at_home, sunder_i_by_id_pair) && sunder_i_search_relax(s, c->i, c->j);
        const bool i = yields || sunder_i_search_send_home(s, c->i), j = yields || sunder_i_search_send_home(s, c->j);
        changed[c->i] = changed[c->i] || i;
        changed[c->j] = changed[c->j] || j;
        any = any || i || j;
    }
    if (s->relaxations.n > before && !sunder_i_relaxations_index(&s->relaxations, s->model)) s->failed = true;
    return any;
}

void sunder_i_search_yield(sunder_i_search *search, const sunder_i_clash *at_home, size_t n, double hair)
{
    neighbours near = {0};
    bool *changed = sunder_i_alloc(search->n, sizeof *changed);
    search->failed = search->failed || !changed;
    if (!search->failed) sunder_i_search_find_clashes(search, search->t);
    while (!search->failed && yield_once(search, at_home, n, hair, changed)) {
        if (!near.first) find_neighbours(search, &near);
        if (!search->failed) look_at_changed(search, &near, changed);
    }
    free_neighbours(&near);
    sunder_i_free(changed);
}
