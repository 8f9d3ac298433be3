/* What is proved of a choice: the best choice for the proved clauses alone is at least as good as any choice without a
 * conflict. Where the two hide the same weight of each class the choice is proved to be the best. */
#include "displacement/hide/hiding.h"
#include "displacement/hide/tuning.h"

#include "base/union_find.h"

#include <stdlib.h>

/* A difference of hidden weight in one class of one component. */
typedef struct difference {
    uint32_t root, hierarchy;
    int64_t weight;
} difference;

/* The components of all clauses: the least member of each feature's. Features in no clause are alone. */
static uint32_t *find_roots(const sunder_i_hiding *h)
{
    uint32_t *parent = sunder_i_alloc(h->n, sizeof *parent);
    if (!parent) return NULL;
    sunder_i_union_init(parent, h->n);
    for (size_t k = 0; k < h->clauses.n; k++) {
        const sunder_i_clause *c = &h->clauses.clause[k];
        const uint32_t *member = h->clauses.item + c->first;
        for (size_t m = 1; m < c->n; m++) sunder_i_union_join(parent, member[0], member[m]);
    }
    for (size_t f = 0; f < h->n; f++) parent[f] = sunder_i_union_find(parent, (uint32_t)f);
    return parent;
}

/* What is known of the component that has its root at a feature. */
enum { NO_COMPONENT, BEST, UNPROVED };

/* Finds the components. One is unproved if a best choice for its proved clauses is not known. */
static void mark_components(const sunder_i_hiding *h, const uint32_t *root, const bool *sure, unsigned char *state)
{
    for (size_t k = 0; k < h->clauses.n; k++) {
        const sunder_i_clause *c = &h->clauses.clause[k];
        const uint32_t first = h->clauses.item[c->first];
        unsigned char *at = &state[root[first]];
        if (*at == NO_COMPONENT) *at = BEST;
        if (c->proved && !sure[first]) *at = UNPROVED;
    }
}

/* Components in which the choice hides other weights than the best one for the proved clauses are unproved. list: room
 * for all features. */
static void compare_choices(const sunder_i_hiding *h, const uint32_t *root, const bool *best, difference *list,
                            unsigned char *state)
{
    size_t n = 0;
    for (uint32_t f = 0; f < h->n; f++)
        if (h->hidden[f] != best[f])
            list[n++] =
                (difference){root[f], h->cost[f].hierarchy, h->hidden[f] ? h->cost[f].weight : -h->cost[f].weight};
    if (n) qsort(list, n, sizeof *list, sunder_i_by_id_pair);
    for (size_t k = 0, end; k < n; k = end) {
        int64_t sum = 0;
        for (end = k; end < n && sunder_i_by_id_pair(&list[end], &list[k]) == 0; end++) sum += list[end].weight;
        if (sum != 0) state[list[k].root] = UNPROVED;
    }
}

static int by_size(const void *a, const void *b)
{
    const size_t p = *(const size_t *)a, q = *(const size_t *)b;
    return p < q ? -1 : p > q;
}

/* Copies the clauses to the report, of each the members and then all things. Returns false if memory is out. */
static bool report_clauses(const sunder_i_hiding *h, sunder_report *report)
{
    const sunder_i_clauses *c = &h->clauses;
    size_t *number = sunder_i_alloc(2 * c->items, sizeof *number);
    report->clause = sunder_i_alloc(c->n, sizeof *report->clause);
    report->clause_number = number;
    if (!number || !report->clause) return false;
    for (size_t k = 0; k < c->n; k++) {
        const sunder_i_clause *from = &c->clause[k];
        size_t *thing = number + from->n;
        for (size_t m = 0; m < from->n; m++) number[m] = c->item[from->first + m];
        for (size_t m = 0; m < from->n + from->others; m++) thing[m] = c->item[from->first + m];
        qsort(thing, from->n + from->others, sizeof *thing, by_size);
        report->clause[k] = (sunder_clause){number, thing, from->n, from->n + from->others, from->proved};
        number = thing + from->n + from->others;
    }
    return true;
}

/* Fills in the counts that need no search. */
static void count_hidden(const sunder_i_hiding *h, const bool *best, const unsigned char *state,
                         sunder_hiding_summary *out)
{
    for (size_t f = 0; f < h->n; f++) {
        out->hidden += h->hidden[f];
        out->weight += h->hidden[f] ? h->cost[f].weight : 0;
        out->least += best[f] ? h->cost[f].weight : 0;
        out->components += state[f] != NO_COMPONENT;
        out->components_best += state[f] == BEST;
    }
    for (size_t k = 0; k < h->clauses.n; k++) {
        out->proved += h->clauses.clause[k].proved;
        out->forced += h->clauses.clause[k].proved && h->clauses.clause[k].n == 1;
    }
    out->clauses = h->clauses.n;
    out->rounds = h->rounds;
}

sunder_status sunder_i_hiding_report(const sunder_i_hiding *hiding, sunder_report *report, sunder_error *err)
{
    const size_t n = hiding->n;
    bool *best = sunder_i_alloc(n, sizeof *best), *sure = sunder_i_alloc(n, sizeof *sure);
    unsigned char *state = sunder_i_calloc(n, sizeof *state);
    difference *list = sunder_i_alloc(n, sizeof *list);
    uint32_t *root = find_roots(hiding);
    const bool ok = best && sure && state && list && root && report_clauses(hiding, report);
    sunder_status status = ok ? SUNDER_OK : sunder_i_failure_cause(err);
    sunder_i_cover_result result = {.hidden = best, .sure = sure};
    if (!status) status = sunder_i_cover_find(&hiding->clauses, true, hiding->cost, n, COVER_EFFORT, &result, err);
    if (!status) {
        mark_components(hiding, root, sure, state);
        compare_choices(hiding, root, best, list, state);
        count_hidden(hiding, best, state, &report->hiding);
    }
    sunder_i_free_all(best, sure, state, list, root);
    return status;
}
