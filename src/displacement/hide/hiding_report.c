/* What is proved of a choice: no choice without a conflict is better than the bound, which rests on the proved clauses
 * alone. Where the choice hides the same weight of each class as the bound says, it is proved to be the best. With
 * what is hidden, the least cost of other levels for the proved clauses is a bound for that cost. */
#include "displacement/hide/hiding.h"
#include "displacement/hide/hiding_bound.h"
#include "displacement/hide/tuning.h"

#include "base/union_find.h"

#include <stdlib.h>
#include <string.h>

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

/* What a component hides in one class, or the bound of it. */
typedef struct entry {
    uint32_t root, hierarchy;
    size_t hidden;
    int64_t weight, least;
} entry;

/* The components while they are made. */
typedef struct listing {
    const sunder_i_hiding *h;
    uint32_t *root; /* [features] the least feature of the component */
    size_t *at;     /* [features] of roots: the number of the component; SIZE_MAX: the feature is in no clause */
    sunder_report *report;
    size_t components;
} listing;

static sunder_hiding_component *component_of(const listing *l, size_t feature)
{
    return &l->report->component[l->at[l->root[feature]]];
}

/* Makes an entry for each component, in the order of their first features. Returns false if memory is out. */
static bool begin_components(listing *l)
{
    const sunder_i_hiding *h = l->h;
    size_t n = 0;
    l->root = find_roots(h);
    l->at = sunder_i_alloc(h->layer->n, sizeof *l->at);
    if (!l->root || !l->at) return false;
    for (size_t f = 0; f < h->layer->n; f++) l->at[f] = SIZE_MAX;
    for (size_t k = 0; k < h->clauses.n; k++) l->at[l->root[h->clauses.item[h->clauses.clause[k].first]]] = 0;
    for (size_t f = 0; f < h->layer->n; f++)
        if (l->at[f] == 0) l->at[f] = n++;
    sunder_hiding_component *component = sunder_i_calloc(n, sizeof *component);
    for (size_t f = 0; f < h->layer->n && component; f++)
        if (l->at[f] != SIZE_MAX) component[l->at[f]] = (sunder_hiding_component){.feature = f, .best = true};
    l->report->component = component;
    l->components = n;
    return component;
}

/* ---- What is hidden, by component and class ---------------------------------------------------------------------- */

static int by_class(const void *a, const void *b)
{
    const sunder_hiding_class *p = a, *q = b;
    return p->hierarchy < q->hierarchy ? -1 : p->hierarchy > q->hierarchy;
}

/* Lists what is hidden, and the bounds. list: room for all hidden features and weights of bounds. Returns their
 * number. */
static size_t list_entries(const listing *l, const sunder_i_hiding_bound *bound, entry *list)
{
    const sunder_i_hiding *h = l->h;
    size_t n = 0;
    for (uint32_t f = 0; f < h->layer->n; f++)
        if (h->hidden[f])
            list[n++] = (entry){l->root[f], h->layer->hiding[f].hierarchy, 1, h->layer->hiding[f].weight, 0};
    for (size_t t = 0; t < bound->trees; t++)
        for (size_t k = 0; k < bound->tree[t].bounds; k++) {
            const sunder_hiding_share *of = &bound->share[bound->tree[t].bound + k];
            list[n++] = (entry){l->root[bound->tree[t].feature], of->hierarchy, 0, 0, of->weight};
        }
    if (n) qsort(list, n, sizeof *list, sunder_i_by_id_pair);
    return n;
}

/* Sums up the entries of each component by class. It is proved to be the best if it hides as much as the bound says, in
 * each class. Returns false if memory is out. */
static bool sum_entries(const listing *l, const entry *list, size_t n)
{
    sunder_report *report = l->report;
    sunder_hiding_class *class = report->component_class = sunder_i_alloc(n, sizeof *class);
    size_t classes = 0;
    if (!class) return false;
    for (size_t k = 0, end; k < n; k = end) {
        sunder_hiding_component *c = &report->component[l->at[list[k].root]];
        sunder_hiding_class *of = &class[classes];
        *of = (sunder_hiding_class){.hierarchy = list[k].hierarchy};
        for (end = k; end < n && sunder_i_by_id_pair(&list[end], &list[k]) == 0; end++) {
            of->hidden += list[end].hidden;
            of->weight += list[end].weight;
            of->least += list[end].least;
        }
        if (c->classes++ == 0) c->first_class = classes;
        c->best = c->best && of->weight == of->least;
        classes++;
    }
    report->component_classes = classes;
    return true;
}

/* Sums up the classes of all components. Returns false if memory is out. */
static bool report_classes(sunder_report *report)
{
    const size_t n = report->component_classes;
    sunder_hiding_class *class = report->hiding_class = sunder_i_alloc(n, sizeof *class);
    if (!class) return false;
    if (n) memcpy(class, report->component_class, n * sizeof *class);
    if (n) qsort(class, n, sizeof *class, by_class);
    for (size_t k = 0; k < n; k++) {
        sunder_hiding_class *last = report->hiding_classes ? &class[report->hiding_classes - 1] : NULL;
        report->hiding.hidden += class[k].hidden;
        report->hiding.weight += class[k].weight;
        report->hiding.least += class[k].least;
        if (!last || last->hierarchy != class[k].hierarchy) {
            class[report->hiding_classes++] = class[k];
            continue;
        }
        last->hidden += class[k].hidden;
        last->weight += class[k].weight;
        last->least += class[k].least;
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
    report->clause = sunder_i_calloc(c->n, sizeof *report->clause); /* none has a proof yet, if memory is out */
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

/* A choice after which clauses of a component were found. */
typedef struct choice {
    uint32_t component;
    size_t number;
} choice;

static int by_choice(const void *a, const void *b)
{
    const choice *p = a, *q = b;
    if (p->component != q->component) return p->component < q->component ? -1 : 1;
    return p->number < q->number ? -1 : p->number > q->number;
}

/* Counts the clauses of each component, and after how many choices they were found. Returns false if memory is out. */
static bool count_clauses(const listing *l)
{
    const sunder_i_hiding *h = l->h;
    choice *list = sunder_i_alloc(h->clauses.n, sizeof *list);
    if (!list) return false;
    for (size_t k = 0; k < h->clauses.n; k++) {
        const sunder_i_clause *clause = &h->clauses.clause[k];
        const sunder_i_clause_source *source = bsearch(&clause->first, h->source, h->sources, sizeof *source, by_first);
        sunder_hiding_component *c = component_of(l, h->clauses.item[clause->first]);
        c->clauses++;
        c->proved += clause->proved;
        c->forced += clause->proved && clause->n == 1;
        list[k] = (choice){(uint32_t)(c - l->report->component), source->choice};
    }
    if (h->clauses.n) qsort(list, h->clauses.n, sizeof *list, by_choice);
    for (size_t k = 0; k < h->clauses.n; k++)
        l->report->component[list[k].component].rounds += k == 0 || by_choice(&list[k - 1], &list[k]) != 0;
    sunder_i_free(list);
    return true;
}

/* Returns the cost of a level with which the feature is not hidden. */
static int64_t cost_of(const sunder_layer *layer, size_t feature, uint32_t level)
{
    size_t n;
    const sunder_level *smaller = sunder_i_levels_of(layer, feature, &n);
    return level && level <= n ? smaller[level - 1].cost : 0;
}

/* Sums up what is smaller, and bounds its cost. level: scratch [n]. */
static sunder_status count_smaller(const listing *l, uint32_t *level, sunder_error *err)
{
    const sunder_i_hiding *h = l->h;
    const size_t n = h->layer->n;
    if (!h->layer->level_end) return SUNDER_OK;
    bool *sure = sunder_i_calloc(n, sizeof *sure);
    sunder_i_cover_result result = {.level = level, .sure = sure};
    if (!sure) return sunder_i_failure_cause(err);
    if (n) memcpy(level, h->level, n * sizeof *level);
    const sunder_status status =
        sunder_i_cover_find(&h->clauses, SUNDER_I_COVER_SHRINKING, h->layer, COVER_EFFORT, &result, err);
    for (size_t f = 0; f < n && !status; f++) {
        if (l->at[l->root[f]] == SIZE_MAX) continue;
        sunder_hiding_component *c = component_of(l, f);
        c->smaller += h->level[f] > 0 && !h->hidden[f];
        c->smaller_cost += cost_of(h->layer, f, h->level[f]);
        if (sure[f]) c->smaller_least += cost_of(h->layer, f, level[f]);
    }
    sunder_i_free(sure);
    return status;
}

void sunder_hiding_add(sunder_hiding_summary *sum, const sunder_hiding_component *component)
{
    sum->components++;
    sum->components_best += component->best;
    sum->clauses += component->clauses;
    sum->proved += component->proved;
    sum->forced += component->forced;
    sum->smaller += component->smaller;
    sum->smaller_cost += component->smaller_cost;
    sum->smaller_least += component->smaller_least;
    if (component->rounds > sum->rounds) sum->rounds = component->rounds;
}

/* Makes the list of components. level: scratch [n]. */
static sunder_status report_components(listing *l, const sunder_i_hiding_bound *bound, uint32_t *level,
                                       sunder_error *err)
{
    entry *list = sunder_i_alloc(l->h->layer->n + bound->shares, sizeof *list);
    bool ok = list && begin_components(l);
    ok = ok && sum_entries(l, list, list_entries(l, bound, list)) && report_classes(l->report) && count_clauses(l);
    sunder_i_free(list);
    const sunder_status status = ok ? count_smaller(l, level, err) : sunder_i_failure_cause(err);
    for (size_t k = 0; k < l->components && !status; k++)
        sunder_hiding_add(&l->report->hiding, &l->report->component[k]);
    sunder_i_free_all(l->root, l->at);
    return status;
}

sunder_status sunder_i_hiding_report(sunder_i_hiding *hiding, sunder_report *report, sunder_error *err)
{
    uint32_t *best = sunder_i_alloc(hiding->layer->n, sizeof *best);
    sunder_i_cover_result result = {.level = best};
    sunder_i_hiding_bound bound = {0};
    listing l = {.h = hiding, .report = report};
    sunder_status status = best ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status)
        status =
            sunder_i_cover_find(&hiding->clauses, SUNDER_I_COVER_PROVED, hiding->layer, COVER_EFFORT, &result, err);
    if (!status) status = sunder_i_hiding_bound_find(&hiding->clauses, hiding->layer, best, BOUND_EFFORT, &bound, err);
    if (!status) status = report_components(&l, &bound, best, err);
    if (!status && !report_clauses(hiding, report)) status = sunder_i_failure_cause(err);
    report->hiding_trees =
        (sunder_hiding_trees){bound.tree, bound.node, bound.share, bound.trees, bound.nodes, bound.shares};
    report->level = hiding->level;
    hiding->level = NULL;
    sunder_i_free(best);
    return status;
}
