/* Clusters without a solution: limits, fixed bodies, or no room between them.
 *
 * Pairs that clash in the end, and clashed at the start, are relaxed (relaxation.c): all others keep what they owe,
 * and these stand no worse than they stood. What came into a clash besides goes home, until nothing clashes; in the
 * end all are at home, where every relaxation holds. From there the cluster descends as from any other solution:
 * nobody is pushed to ease a pair that stays in conflict. (retry_cluster.c asks them again.) */
#include "displacement/search/stages.h"

#include <stdlib.h>
#include <string.h>

/* ---- Yielding ---------------------------------------------------------------------------------------------------- */

static bool send_home(sunder_i_search *s, uint32_t i)
{
    if (!(s->mass[i] > 0) || (s->t[2 * i] == 0 && s->t[2 * i + 1] == 0)) return false;
    s->t[2 * i] = s->t[2 * i + 1] = 0;
    return true;
}

sunder_i_clash *sunder_i_search_at_home(sunder_i_search *s, size_t *n)
{
    double *stand = sunder_i_alloc(2 * s->n, sizeof *stand);
    if (!stand) return NULL;
    memcpy(stand, s->t, 2 * s->n * sizeof *stand);
    for (uint32_t k = 0; k < s->n; k++) send_home(s, k);
    sunder_i_search_look(s, s->t);
    memcpy(s->t, stand, 2 * s->n * sizeof *stand);
    sunder_i_free(stand);
    *n = s->clashes;
    sunder_i_clash *at_home = sunder_i_alloc(*n, sizeof *at_home);
    if (at_home && *n) memcpy(at_home, s->clash, *n * sizeof *at_home);
    if (at_home && *n) qsort(at_home, *n, sizeof *at_home, sunder_i_by_id_pair);
    return at_home;
}

/* A relaxation for pair (i, j), if there is none by this search yet. */
static bool relax(sunder_i_search *s, uint32_t i, uint32_t j)
{
    const uint32_t p = s->body[i], q = s->body[j];
    if (sunder_i_relaxations_between(&s->relaxations, p, q)) return false;
    const size_t before = s->relaxations.n;
    /* All that is within what the search asks for: the gap and its margin. */
    if (sunder_i_relaxations_make(s->model, p, q, s->gap + 2 * s->tolerance, &s->relaxations, NULL)) s->failed = true;
    return s->relaxations.n > before;
}

bool sunder_i_search_waive_margins(sunder_i_search *s)
{
    size_t n = 0;
    sunder_i_clash *at_home = sunder_i_search_at_home(s, &n);
    const size_t before = s->relaxations.n;
    const double margin = s->gap - s->model->rules.gap;
    if (!at_home) s->failed = true;
    for (size_t k = 0; k < n && !s->failed; k++)
        if (at_home[k].violation <= margin + s->tolerance) relax(s, at_home[k].i, at_home[k].j);
    sunder_i_free(at_home);
    if (s->relaxations.n > before && !sunder_i_relaxations_index(&s->relaxations, s->model)) s->failed = true;
    return !s->failed && s->relaxations.n > before;
}

/* Who may stand near whom, each where it stands or where it came from: pairs, and of each body which they are. */
typedef struct neighbours {
    sunder_i_id_pair *pair;
    size_t pairs, capacity;
    size_t *first;   /* [n + 1] */
    uint32_t *other; /* of body k from first[k] to first[k + 1] */
} neighbours;

static void free_neighbours(neighbours *g)
{
    sunder_i_free(g->pair);
    sunder_i_free(g->first);
    sunder_i_free(g->other);
}

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
    sunder_i_search_near_or_home(s, s->gap, add_pair, g);
    g->first = sunder_i_calloc(s->n + 1, sizeof *g->first);
    g->other = sunder_i_alloc(2 * g->pairs, sizeof *g->other);
    s->failed = s->failed || !g->first || !g->other;
    if (s->failed) return;
    for (size_t k = 0; k < g->pairs; k++) g->first[g->pair[k].a]++, g->first[g->pair[k].b]++;
    for (size_t k = 0, sum = 0; k <= s->n; k++) g->first[k] = sum += g->first[k]; /* the ends, for now */
    for (size_t k = g->pairs; k-- > 0;) {
        g->other[--g->first[g->pair[k].a]] = g->pair[k].b;
        g->other[--g->first[g->pair[k].b]] = g->pair[k].a;
    }
}

/* What clashes now, of the pairs of which one changed: into s->clash. */
static void look_at_changed(sunder_i_search *s, const neighbours *g, const bool *changed)
{
    s->clashes = 0;
    for (uint32_t i = 0; i < s->n; i++) {
        if (!changed[i]) continue;
        for (size_t k = g->first[i]; k < g->first[i + 1] && !s->failed; k++) {
            const uint32_t j = g->other[k];
            if (!changed[j] || i < j) sunder_i_search_look_at(s, s->t, i < j ? i : j, i < j ? j : i);
        }
    }
}

/* One pass over what clashes now. Marks what changed, and returns whether anything did. */
static bool yield_once(sunder_i_search *s, const sunder_i_clash *at_home, size_t n, bool *changed)
{
    bool any = false;
    const size_t before = s->relaxations.n;
    memset(changed, 0, s->n * sizeof *changed);
    for (size_t k = 0; k < s->clashes && !s->failed; k++) {
        const sunder_i_clash *c = &s->clash[k];
        const bool yields = n && bsearch(c, at_home, n, sizeof *at_home, sunder_i_by_id_pair) && relax(s, c->i, c->j);
        const bool i = yields || send_home(s, c->i), j = yields || send_home(s, c->j);
        changed[c->i] = changed[c->i] || i;
        changed[c->j] = changed[c->j] || j;
        any = any || i || j;
    }
    if (s->relaxations.n > before && !sunder_i_relaxations_index(&s->relaxations, s->model)) s->failed = true;
    return any;
}

void sunder_i_search_lower(sunder_i_search *s)
{
    const size_t size = 2 * s->n * sizeof *s->t;
    double *stand = sunder_i_alloc(2 * s->n, sizeof *stand);
    s->failed = s->failed || !stand;
    if (!s->failed && sunder_i_search_look(s, s->t) <= s->tolerance) {
        memcpy(stand, s->t, size);
        s->program.n = 0;
        if (!sunder_i_search_descend(s)) memcpy(s->t, stand, size);
    }
    sunder_i_free(stand);
}

void sunder_i_search_give_up(sunder_i_search *s)
{
    size_t n = 0;
    sunder_i_search_clip(s);
    neighbours near = {0};
    sunder_i_clash *at_home = sunder_i_search_at_home(s, &n);
    bool *changed = sunder_i_alloc(s->n, sizeof *changed);
    s->failed = s->failed || !at_home || !changed;
    if (!s->failed) find_neighbours(s, &near);
    if (!s->failed) sunder_i_search_look(s, s->t);
    while (!s->failed && yield_once(s, at_home, n, changed)) look_at_changed(s, &near, changed);
    free_neighbours(&near);
    sunder_i_free(changed);
    sunder_i_free(at_home);
    sunder_i_search_lower(s);
}
