/* What is proved of a choice: no choice without a conflict is better than the bound, which rests on the proved clauses
 * alone. Where the choice hides the same weight of each class as the bound says, it is proved to be the best. With
 * what is hidden, the least cost of other levels for the proved clauses is a bound for that cost. */
#include "displacement/hide/hiding.h"
#include "displacement/hide/hiding_bound.h"
#include "displacement/hide/tuning.h"

#include "base/union_find.h"

#include <stdlib.h>
#include <string.h>

/* A difference of hidden weight in one class of one component. */
typedef struct difference {
    uint32_t root, hierarchy;
    int64_t weight;
} difference;

/* The components of all clauses: the least member of each feature's. Features in no clause are alone. */
static uint32_t *find_roots(const sunder_i_hiding *h)
{
    const size_t n = h->layer->n;
    uint32_t *parent = sunder_i_alloc(n, sizeof *parent);
    if (!parent) return NULL;
    sunder_i_union_init(parent, n);
    for (size_t k = 0; k < h->clauses.n; k++) {
        const sunder_i_clause *c = &h->clauses.clause[k];
        const uint32_t *member = h->clauses.item + c->first;
        for (size_t m = 1; m < c->n; m++) sunder_i_union_join(parent, member[0], member[m]);
    }
    for (size_t f = 0; f < n; f++) parent[f] = sunder_i_union_find(parent, (uint32_t)f);
    return parent;
}

/* What is known of the component that has its root at a feature. */
enum { NO_COMPONENT, BEST, UNPROVED };

/* Lists what is hidden beyond the bound, by component and class. list: room for all hidden features and weights of
 * bounds. Returns their number. */
static size_t list_differences(const sunder_i_hiding *h, const uint32_t *root, const sunder_i_hiding_bound *bound,
                               difference *list)
{
    size_t n = 0;
    for (uint32_t f = 0; f < h->layer->n; f++)
        if (h->hidden[f]) list[n++] = (difference){root[f], h->layer->hiding[f].hierarchy, h->layer->hiding[f].weight};
    for (size_t t = 0; t < bound->trees; t++)
        for (size_t k = 0; k < bound->tree[t].bounds; k++) {
            const sunder_hiding_share *of = &bound->share[bound->tree[t].bound + k];
            list[n++] = (difference){root[bound->tree[t].feature], of->hierarchy, -of->weight};
        }
    return n;
}

/* Finds the components, and those in which the choice hides as much as the bound says, in each class. */
static void mark_components(const sunder_i_hiding *h, const uint32_t *root, difference *list, size_t n,
                            unsigned char *state)
{
    for (size_t k = 0; k < h->clauses.n; k++) state[root[h->clauses.item[h->clauses.clause[k].first]]] = BEST;
    if (n) qsort(list, n, sizeof *list, sunder_i_by_id_pair);
    for (size_t k = 0, end; k < n; k = end) {
        int64_t sum = 0;
        for (end = k; end < n && sunder_i_by_id_pair(&list[end], &list[k]) == 0; end++) sum += list[end].weight;
        if (sum != 0) state[list[k].root] = UNPROVED;
    }
}

static int by_class(const void *a, const void *b)
{
    const sunder_hiding_class *p = a, *q = b;
    return p->hierarchy < q->hierarchy ? -1 : p->hierarchy > q->hierarchy;
}

/* Sums up what is hidden, and the bound, by class. Returns false if memory is out. */
static bool report_classes(const difference *list, size_t n, sunder_report *report)
{
    sunder_hiding_class *class = sunder_i_alloc(n, sizeof *class);
    size_t classes = 0;
    if (!class) return false;
    for (size_t k = 0; k < n; k++) {
        const int64_t weight = list[k].weight;
        class[k] = weight > 0 ? (sunder_hiding_class){list[k].hierarchy, 1, weight, 0}
                              : (sunder_hiding_class){list[k].hierarchy, 0, 0, -weight};
    }
    if (n) qsort(class, n, sizeof *class, by_class);
    for (size_t k = 0; k < n; k++) {
        if (classes == 0 || class[classes - 1].hierarchy != class[k].hierarchy) {
            class[classes++] = class[k];
            continue;
        }
        class[classes - 1].hidden += class[k].hidden;
        class[classes - 1].weight += class[k].weight;
        class[classes - 1].least += class[k].least;
    }
    report->hiding_class = class;
    report->hiding_classes = classes;
    for (size_t k = 0; k < classes; k++) {
        report->hiding.hidden += class[k].hidden;
        report->hiding.weight += class[k].weight;
        report->hiding.least += class[k].least;
    }
    return true;
}

static int by_size(const void *a, const void *b)
{
    const size_t p = *(const size_t *)a, q = *(const size_t *)b;
    return p < q ? -1 : p > q;
}

static int by_first(const void *a, const void *b)
{
    const size_t p = *(const size_t *)a, q = ((const sunder_i_clause_source *)b)->first;
    return p < q ? -1 : p > q;
}

/* Copies the clauses to the report, of each the members and then all things. Returns false if memory is out. */
static bool report_clauses(sunder_i_hiding *h, sunder_report *report)
{
    const sunder_i_clauses *c = &h->clauses;
    size_t *number = sunder_i_alloc(2 * c->items, sizeof *number);
    report->clause = sunder_i_alloc(c->n, sizeof *report->clause);
    report->clause_level = sunder_i_alloc(c->items, sizeof *report->clause_level);
    report->clause_number = number;
    if (!number || !report->clause || !report->clause_level) return false;
    if (c->items) memcpy(report->clause_level, c->level, c->items * sizeof *c->level);
    for (size_t k = 0; k < c->n; k++) {
        const sunder_i_clause *from = &c->clause[k];
        size_t *thing = number + from->n;
        for (size_t m = 0; m < from->n; m++) number[m] = c->item[from->first + m];
        for (size_t m = 0; m < from->n + from->others; m++) thing[m] = c->item[from->first + m];
        qsort(thing, from->n + from->others, sizeof *thing, by_size);
        sunder_i_clause_source *source = bsearch(&from->first, h->source, h->sources, sizeof *source, by_first);
        report->clause[k] = (sunder_clause){number,
                                            thing,
                                            report->clause_level + from->first,
                                            from->n,
                                            from->n + from->others,
                                            from->proved,
                                            source->a,
                                            source->b,
                                            source->reason,
                                            source->crowded,
                                            source->proof};
        source->proof = NULL;
        number = thing + from->n + from->others;
    }
    return true;
}

/* Fills in the counts of clauses and components. */
static void count_clauses(const sunder_i_hiding *h, const unsigned char *state, sunder_hiding_summary *out)
{
    for (size_t f = 0; f < h->layer->n; f++) {
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

/* Compares the choice with the bound. Returns false if memory is out. */
static bool compare_with_bound(const sunder_i_hiding *h, const sunder_i_hiding_bound *bound, sunder_report *report)
{
    uint32_t *root = find_roots(h);
    unsigned char *state = sunder_i_calloc(h->layer->n, sizeof *state);
    difference *list = sunder_i_alloc(h->layer->n + bound->shares, sizeof *list);
    bool ok = root && state && list;
    if (ok) {
        const size_t n = list_differences(h, root, bound, list);
        mark_components(h, root, list, n, state);
        count_clauses(h, state, &report->hiding);
        ok = report_classes(list, n, report);
    }
    sunder_i_free_all(root, state, list);
    return ok;
}

/* Returns the cost of a level with which the feature is not hidden. */
static int64_t cost_of(const sunder_layer *layer, size_t feature, uint32_t level)
{
    size_t n;
    const sunder_level *smaller = sunder_i_levels_of(layer, feature, &n);
    return level && level <= n ? smaller[level - 1].cost : 0;
}

/* Sums up what is smaller, and bounds its cost. level: scratch [n]. */
static sunder_status report_smaller(const sunder_i_hiding *h, uint32_t *level, sunder_hiding_summary *out,
                                    sunder_error *err)
{
    const size_t n = h->layer->n;
    sunder_i_cover_result result = {.level = level};
    if (!h->layer->level_end) return SUNDER_OK;
    if (n) memcpy(level, h->level, n * sizeof *level);
    const sunder_status status =
        sunder_i_cover_find(&h->clauses, SUNDER_I_COVER_SHRINKING, h->layer, COVER_EFFORT, &result, err);
    const bool exact = result.exact == result.components;
    for (size_t f = 0; f < n && !status; f++) {
        out->smaller += h->level[f] > 0 && !h->hidden[f];
        out->smaller_cost += cost_of(h->layer, f, h->level[f]);
        if (exact) out->smaller_least += cost_of(h->layer, f, level[f]);
    }
    return status;
}

sunder_status sunder_i_hiding_report(sunder_i_hiding *hiding, sunder_report *report, sunder_error *err)
{
    uint32_t *best = sunder_i_alloc(hiding->layer->n, sizeof *best);
    sunder_i_cover_result result = {.level = best};
    sunder_i_hiding_bound bound = {0};
    sunder_status status = best ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status)
        status =
            sunder_i_cover_find(&hiding->clauses, SUNDER_I_COVER_PROVED, hiding->layer, COVER_EFFORT, &result, err);
    if (!status) status = sunder_i_hiding_bound_find(&hiding->clauses, hiding->layer, best, BOUND_EFFORT, &bound, err);
    if (!status && !(compare_with_bound(hiding, &bound, report) && report_clauses(hiding, report)))
        status = sunder_i_failure_cause(err);
    if (!status) status = report_smaller(hiding, best, &report->hiding, err);
    report->hiding_trees =
        (sunder_hiding_trees){bound.tree, bound.node, bound.share, bound.trees, bound.nodes, bound.shares};
    report->level = hiding->level;
    hiding->level = NULL;
    sunder_i_free(best);
    return status;
}
