/* The best choice of levels, for each component of the clauses by branch and bound.
 *
 * Costs are vectors, compared lexicographically: one number for each class that occurs in the component, the most
 * important one first, and a last one for the features that become smaller. Such vectors are an ordered group, so that
 * weak duality holds for them as for numbers. Clauses get values y >= 0: for no feature and no level the values of the
 * clauses that it satisfies with this level exceed the cost of the level. Then each choice costs at least the sum of
 * the values. They are found greedily, clause by clause (bound_of()).
 *
 * At each node a feature's level is known to be in a range low .. high. A node branches on the feature that is in most
 * clauses that are not satisfied yet: it has the least level that satisfies one of them, or a greater one; or a lesser
 * one. A clause that only one member can still satisfy raises its low level.
 *
 * Among best choices the one is taken that gives the first features the greater levels: each feature is asked, in their
 * order, whether a choice of the same cost gives it the level, with those already decided. */
#include "displacement/hide/cover.h"
#include "displacement/hide/cost_vectors.h"

#include "base/union_find.h"

#include <stdlib.h>
#include <string.h>

/* A decision to be undone: the range that a feature had. */
typedef struct range {
    uint32_t feature, low, high;
} range;

/* One component. Features and clauses are numbered within it, features in the order of their numbers. */
typedef struct component {
    size_t features, clauses, columns;
    const uint32_t *feature;  /* [features] their numbers in the layer */
    uint32_t *row;            /* [features + 1] index in cost[] of level 0 of each */
    int64_t *cost;            /* [rows * columns] what each level costs */
    uint32_t *first, *member; /* [clauses + 1] index in member[] of the first member of each */
    uint32_t *above;          /* likewise: the least level that satisfies the clause */
    uint32_t *first_of, *of;  /* [features + 1] index in of[]: the places in member[] that are this feature */
    uint32_t *clause_of;      /* the clause of each place in member[] */
    uint32_t *low, *high;     /* [features] */
    uint32_t *met_n, *free_n; /* [clauses] how many members satisfy it already, and how many may yet */
    range *trail;             /* in the order of the decisions */
    size_t decided, trail_room;
    uint32_t *unit; /* clauses that one member may yet satisfy, and none does; some may have been satisfied since */
    size_t units, unit_room;
    int64_t *spent, *least, *value; /* [columns] the cost of the low levels; a bound; and scratch */
    int64_t *rest;                  /* [rows * columns] what clauses leave of the costs */
    int64_t *best;                  /* [columns] the cost of the best choice */
    uint32_t *chosen;               /* [features] that choice */
    bool found, first_only; /* a choice was found; the first one that costs no more than best[] ends the search */
    bool failed;            /* memory was out */
    uint64_t nodes, most;
} component;

uint32_t sunder_i_last_level(const sunder_layer *layer, size_t feature)
{
    size_t n;
    sunder_i_levels_of(layer, feature, &n);
    return (uint32_t)n + (layer->hiding && layer->hiding[feature].hierarchy);
}

bool sunder_i_is_hidden_at(const sunder_layer *layer, size_t feature, uint32_t level)
{
    size_t n;
    sunder_i_levels_of(layer, feature, &n);
    return level > n;
}

/* ---- Costs ------------------------------------------------------------------------------------------------------- */

static int64_t *cost_of(const component *c, uint32_t f, uint32_t level)
{
    return c->cost + c->columns * ((size_t)c->row[f] + level);
}

static int64_t *rest_of(const component *c, uint32_t f, uint32_t level)
{
    return c->rest + c->columns * ((size_t)c->row[f] + level);
}

/* May the member at this place yet satisfy its clause? It does not do so already. */
static bool is_free(const component *c, uint32_t place)
{
    const uint32_t f = c->member[place];
    return c->low[f] < c->above[place] && c->high[f] >= c->above[place];
}

/* Returns the least rest of the levels with which the member at this place satisfies its clause. */
static const int64_t *least_rest(const component *c, uint32_t place)
{
    const uint32_t f = c->member[place];
    const int64_t *least = rest_of(c, f, c->above[place]);
    for (uint32_t k = c->above[place] + 1; k <= c->high[f]; k++)
        if (sunder_i_costs_cmp(rest_of(c, f, k), least, c->columns) < 0) least = rest_of(c, f, k);
    return least;
}

/* Sets least[] to a lower bound of the cost of all choices in the present ranges. */
static void bound_of(component *c)
{
    const size_t n = c->columns;
    memcpy(c->rest, c->cost, c->row[c->features] * n * sizeof *c->rest);
    for (uint32_t f = 0; f < c->features; f++)
        for (uint32_t k = c->low[f]; k <= c->high[f] && c->low[f]; k++)
            sunder_i_costs_add(rest_of(c, f, k), cost_of(c, f, c->low[f]), -1, n);
    memcpy(c->least, c->spent, n * sizeof *c->least);
    for (size_t k = 0; k < c->clauses; k++) {
        if (c->met_n[k]) continue;
        const int64_t *y = NULL;
        for (uint32_t m = c->first[k]; m < c->first[k + 1]; m++) {
            if (!is_free(c, m)) continue;
            const int64_t *rest = least_rest(c, m);
            if (!y || sunder_i_costs_cmp(rest, y, n) < 0) y = rest;
        }
        if (!y) continue;
        memcpy(c->value, y, n * sizeof *y);
        sunder_i_costs_add(c->least, c->value, 1, n);
        for (uint32_t m = c->first[k]; m < c->first[k + 1]; m++)
            for (uint32_t level = c->above[m]; is_free(c, m) && level <= c->high[c->member[m]]; level++)
                sunder_i_costs_add(rest_of(c, c->member[m], level), c->value, -1, n);
    }
}

/* ---- Decisions --------------------------------------------------------------------------------------------------- */

/* Counts the members at the places of a feature in or out of their clauses. */
static void count_places(component *c, uint32_t f, bool in)
{
    for (uint32_t k = c->first_of[f]; k < c->first_of[f + 1]; k++) {
        const uint32_t place = c->of[k], clause = c->clause_of[place];
        const uint32_t met = c->low[f] >= c->above[place], may = is_free(c, place);
        c->met_n[clause] += in ? met : 0 - met;
        c->free_n[clause] += in ? may : 0 - may;
    }
}

/* Lists the clauses of a feature that have one free member left. Returns false if one has none and is not satisfied. */
static bool list_units(component *c, uint32_t f)
{
    bool ok = true;
    for (uint32_t k = c->first_of[f]; k < c->first_of[f + 1]; k++) {
        const uint32_t clause = c->clause_of[c->of[k]];
        if (c->met_n[clause] || c->free_n[clause] > 1) continue;
        ok = ok && c->free_n[clause] == 1;
        if (!sunder_i_reserve(&c->unit, &c->unit_room, c->units + 1, sizeof *c->unit))
            c->failed = true;
        else
            c->unit[c->units++] = clause;
    }
    return ok && !c->failed;
}

/* Narrows the range of a feature. Returns false if a clause cannot be satisfied any more, or if memory is out. */
static bool decide(component *c, uint32_t f, uint32_t low, uint32_t high)
{
    if (!sunder_i_reserve(&c->trail, &c->trail_room, c->decided + 1, sizeof *c->trail)) {
        c->failed = true;
        return false;
    }
    c->trail[c->decided++] = (range){f, c->low[f], c->high[f]};
    count_places(c, f, false);
    sunder_i_costs_add(c->spent, cost_of(c, f, c->low[f]), -1, c->columns);
    c->low[f] = low;
    c->high[f] = high;
    sunder_i_costs_add(c->spent, cost_of(c, f, low), 1, c->columns);
    count_places(c, f, true);
    return list_units(c, f);
}

/* Raises the members that alone can satisfy clauses. Returns false if a clause cannot be satisfied. */
static bool raise_units(component *c)
{
    while (c->units) {
        const uint32_t clause = c->unit[--c->units];
        if (c->met_n[clause]) continue;
        uint32_t m = c->first[clause];
        while (m < c->first[clause + 1] && !is_free(c, m)) m++;
        if (m == c->first[clause + 1] || !decide(c, c->member[m], c->above[m], c->high[c->member[m]])) return false;
    }
    return true;
}

static void undo(component *c, size_t decided)
{
    c->units = 0;
    while (c->decided > decided) {
        const range *was = &c->trail[--c->decided];
        const uint32_t f = was->feature;
        count_places(c, f, false);
        sunder_i_costs_add(c->spent, cost_of(c, f, c->low[f]), -1, c->columns);
        c->low[f] = was->low;
        c->high[f] = was->high;
        sunder_i_costs_add(c->spent, cost_of(c, f, c->low[f]), 1, c->columns);
        count_places(c, f, true);
    }
}

/* ---- Search ------------------------------------------------------------------------------------------------------ */

/* Returns the feature that may satisfy most clauses that are not satisfied, and sets *level to the least level that
 * satisfies one of them; NO_FEATURE: each clause is satisfied. */
#define NO_FEATURE UINT32_MAX
static uint32_t choose_feature(const component *c, uint32_t *level)
{
    uint32_t best = NO_FEATURE, most = 0;
    for (uint32_t f = 0; f < c->features; f++) {
        uint32_t n = 0, least = UINT32_MAX;
        if (c->low[f] == c->high[f]) continue;
        for (uint32_t k = c->first_of[f]; k < c->first_of[f + 1]; k++) {
            const uint32_t place = c->of[k];
            if (c->met_n[c->clause_of[place]] || !is_free(c, place)) continue;
            n++;
            if (c->above[place] < least) least = c->above[place];
        }
        if (n <= most) continue;
        best = f;
        most = n;
        *level = least;
    }
    return best;
}

/* Can this node not lead to a better choice than the one found? */
static bool is_hopeless(component *c)
{
    if (!c->found && !c->first_only) return false;
    bound_of(c);
    const int order = sunder_i_costs_cmp(c->least, c->best, c->columns);
    return c->first_only ? order > 0 || c->found : order >= 0;
}

/* Searches below the present decisions. Each decision undoes itself. The depth is at most the number of levels of all
 * features. */
static void search(component *c)
{
    if (c->nodes >= c->most || c->failed || is_hopeless(c)) return;
    c->nodes++;
    uint32_t level = 0;
    const uint32_t f = choose_feature(c, &level);
    if (f == NO_FEATURE) {
        memcpy(c->best, c->spent, c->columns * sizeof *c->best);
        memcpy(c->chosen, c->low, c->features * sizeof *c->chosen);
        c->found = true;
        return;
    }
    const size_t decided = c->decided;
    if (decide(c, f, level, c->high[f]) && raise_units(c)) search(c);
    undo(c, decided);
    if (decide(c, f, c->low[f], level - 1) && raise_units(c)) search(c);
    undo(c, decided);
}

/* Is there a choice of the cost best[] with the present decisions? Then it becomes chosen[]. */
static bool has_equal(component *c)
{
    c->found = false;
    c->first_only = true;
    search(c);
    c->first_only = false;
    return c->found;
}

/* Gives a feature the greatest level that a choice of the cost best[] gives it with the present decisions. */
static void take_greatest(component *c, uint32_t f)
{
    while (c->low[f] < c->high[f] && c->nodes < c->most && !c->failed) {
        const size_t decided = c->decided;
        const uint32_t level = c->high[f];
        const bool kept = decide(c, f, level, level) && raise_units(c);
        if (kept && (c->chosen[f] == level || has_equal(c))) return;
        undo(c, decided);
        decide(c, f, c->low[f], level - 1); /* the choice at hand has the present decisions: no clause is left empty */
        raise_units(c);
    }
}

/* Replaces chosen[] by the choice of the same cost that comes first. */
static void take_first(component *c)
{
    for (uint32_t f = 0; f < c->features; f++) take_greatest(c, f);
}

/* ---- Components -------------------------------------------------------------------------------------------------- */

/* What all components share: the clauses that count, sorted by component, and where each feature stands in its own. */
typedef struct plan {
    const sunder_i_clauses *clauses;
    const sunder_layer *layer;
    bool shrinking;   /* nothing is hidden */
    uint32_t *parent; /* [features] union-find over the clauses */
    uint32_t *place;  /* [features] the number of each within its component */
    struct placed {
        uint32_t root, clause;
    } * placed; /* sorted */
    size_t n;
} plan;

static uint32_t last_level(const plan *p, size_t feature)
{
    size_t n;
    sunder_i_levels_of(p->layer, feature, &n);
    return p->shrinking ? (uint32_t)n : sunder_i_last_level(p->layer, feature);
}

/* Sets cost[] of one level of a feature; class: the classes that occur. */
static void set_cost(const plan *p, component *c, uint32_t f, uint32_t level, const uint32_t *class)
{
    size_t n;
    const size_t feature = c->feature[f];
    const sunder_level *smaller = sunder_i_levels_of(p->layer, feature, &n);
    int64_t *cost = cost_of(c, f, level);
    if (level == 0) return;
    if (level <= n) {
        cost[c->columns - 1] = smaller[level - 1].cost;
        return;
    }
    const sunder_hiding_cost *hiding = &p->layer->hiding[feature];
    const uint32_t *column = bsearch(&hiding->hierarchy, class, c->columns - 1, sizeof *class, sunder_i_by_number);
    cost[column - class] = hiding->weight;
}

/* Fills in the costs. Returns false if memory is out. */
static bool make_costs(const plan *p, component *c)
{
    uint32_t *class = sunder_i_alloc(c->features, sizeof *class);
    size_t classes = 0;
    if (!class) return false;
    for (size_t f = 0; f < c->features; f++) {
        const uint32_t last = last_level(p, c->feature[f]);
        c->row[f + 1] = c->row[f] + last + 1;
        c->high[f] = last;
        if (sunder_i_is_hidden_at(p->layer, c->feature[f], last))
            class[classes++] = p->layer->hiding[c->feature[f]].hierarchy;
    }
    classes = sunder_i_set_make(class, classes);
    c->columns = classes + 1;
    c->cost = sunder_i_calloc(c->row[c->features] * c->columns, sizeof *c->cost);
    c->rest = sunder_i_alloc(c->row[c->features] * c->columns, sizeof *c->rest);
    for (uint32_t f = 0; f < c->features && c->cost; f++)
        for (uint32_t level = 0; level <= c->high[f]; level++) set_cost(p, c, f, level, class);
    sunder_i_free(class);
    return c->cost && c->rest;
}

/* Lists the features of the n clauses in feature[], and gives each its place. Returns their number. */
static size_t list_features(const plan *p, const struct placed *placed, size_t n, uint32_t *feature)
{
    size_t members = 0;
    for (size_t k = 0; k < n; k++) {
        const sunder_i_clause *clause = &p->clauses->clause[placed[k].clause];
        memcpy(feature + members, p->clauses->item + clause->first, clause->n * sizeof *feature);
        members += clause->n;
    }
    const size_t features = sunder_i_set_make(feature, members);
    for (size_t f = 0; f < features; f++) p->place[feature[f]] = (uint32_t)f;
    return features;
}

/* Fills in the members of the clauses, and the places of the features; the arrays have room. */
static bool link_clauses(const plan *p, const struct placed *placed, component *c)
{
    uint32_t at = 0;
    for (size_t k = 0; k < c->clauses; k++) {
        const sunder_i_clause *clause = &p->clauses->clause[placed[k].clause];
        c->first[k] = at;
        for (size_t m = 0; m < clause->n; m++) {
            const uint32_t f = p->place[p->clauses->item[clause->first + m]];
            c->clause_of[at] = (uint32_t)k;
            c->above[at] = p->clauses->level[clause->first + m] + 1;
            c->member[at++] = f;
            c->first_of[f + 1]++;
        }
    }
    c->first[c->clauses] = at;
    for (size_t f = 0; f < c->features; f++) c->first_of[f + 1] += c->first_of[f];
    for (uint32_t place = at; place-- > 0;) c->of[--c->first_of[c->member[place] + 1]] = place;
    /* first_of[f + 1] was the end of the places of f, and is their beginning now. */
    memmove(c->first_of, c->first_of + 1, c->features * sizeof *c->first_of);
    c->first_of[c->features] = at;
    for (uint32_t f = 0; f < c->features; f++) count_places(c, f, true);
    for (uint32_t f = 0; f < c->features; f++) list_units(c, f);
    return !c->failed;
}

static void free_component(component *c, uint32_t *feature)
{
    sunder_i_free_all(feature, c->row, c->cost, c->first, c->member, c->above, c->clause_of, c->first_of, c->of, c->low,
                      c->high, c->met_n, c->free_n, c->trail, c->unit);
    sunder_i_free_all(c->spent, c->least, c->value, c->rest, c->best, c->chosen);
}

static bool make_component(const plan *p, const struct placed *placed, size_t n, component *c, uint32_t **feature)
{
    size_t members = 0;
    for (size_t k = 0; k < n; k++) members += p->clauses->clause[placed[k].clause].n;
    *feature = sunder_i_alloc(members, sizeof **feature);
    if (!*feature) return false;
    c->feature = *feature;
    c->clauses = n;
    c->features = list_features(p, placed, n, *feature);
    c->row = sunder_i_calloc(c->features + 1, sizeof *c->row);
    c->first = sunder_i_alloc(n + 1, sizeof *c->first);
    c->member = sunder_i_alloc(members, sizeof *c->member);
    c->above = sunder_i_alloc(members, sizeof *c->above);
    c->clause_of = sunder_i_alloc(members, sizeof *c->clause_of);
    c->first_of = sunder_i_calloc(c->features + 1, sizeof *c->first_of);
    c->of = sunder_i_alloc(members, sizeof *c->of);
    c->low = sunder_i_calloc(c->features, sizeof *c->low);
    c->high = sunder_i_calloc(c->features, sizeof *c->high);
    c->chosen = sunder_i_calloc(c->features, sizeof *c->chosen);
    c->met_n = sunder_i_calloc(n, sizeof *c->met_n);
    c->free_n = sunder_i_calloc(n, sizeof *c->free_n);
    if (!c->row || !c->first || !c->member || !c->above || !c->clause_of || !c->first_of || !c->of || !c->low ||
        !c->high || !c->chosen || !c->met_n || !c->free_n || !make_costs(p, c))
        return false;
    c->spent = sunder_i_calloc(c->columns, sizeof *c->spent);
    c->least = sunder_i_alloc(c->columns, sizeof *c->least);
    c->value = sunder_i_alloc(c->columns, sizeof *c->value);
    c->best = sunder_i_calloc(c->columns, sizeof *c->best);
    return c->spent && c->least && c->value && c->best && link_clauses(p, placed, c);
}

/* Makes the choice for the component of n clauses. */
static bool cover_component(const plan *p, const struct placed *placed, size_t n, uint64_t effort,
                            sunder_i_cover_result *result)
{
    component c = {0};
    uint32_t *feature = NULL;
    bool ok = make_component(p, placed, n, &c, &feature);
    if (ok) {
        c.most = effort + c.row[c.features]; /* the first descent finds a choice */
        raise_units(&c);
        search(&c);
        if (c.nodes < c.most) take_first(&c);
        const bool exact = c.nodes < c.most;
        ok = !c.failed;
        result->components++;
        result->exact += exact;
        for (size_t f = 0; f < c.features; f++) {
            result->level[feature[f]] = c.chosen[f];
            if (result->sure) result->sure[feature[f]] = exact;
        }
    }
    free_component(&c, feature);
    return ok;
}

/* Does the clause count? gone: NULL, or features are hidden that have their last level there. */
static bool counts(const plan *p, const sunder_i_clause *c, bool proved_only, const uint32_t *gone)
{
    if (c->n == 0 || (proved_only && !c->proved)) return false;
    for (size_t m = 0; gone && m < c->n; m++) {
        const uint32_t f = p->clauses->item[c->first + m];
        if (sunder_i_is_hidden_at(p->layer, f, gone[f])) return false;
    }
    return true;
}

/* Lists the clauses that count, by components. Returns false if memory is out. */
static bool sort_clauses(plan *p, bool proved_only, const uint32_t *gone)
{
    const sunder_i_clauses *clauses = p->clauses;
    p->parent = sunder_i_alloc(p->layer->n, sizeof *p->parent);
    p->place = sunder_i_alloc(p->layer->n, sizeof *p->place);
    p->placed = sunder_i_alloc(clauses->n, sizeof *p->placed);
    if (!p->parent || !p->place || !p->placed) return false;
    sunder_i_union_init(p->parent, p->layer->n);
    for (size_t k = 0; k < clauses->n; k++) {
        const sunder_i_clause *c = &clauses->clause[k];
        if (!counts(p, c, proved_only, gone)) continue;
        for (size_t m = 1; m < c->n; m++)
            sunder_i_union_join(p->parent, clauses->item[c->first], clauses->item[c->first + m]);
        p->placed[p->n++].clause = (uint32_t)k;
    }
    for (size_t k = 0; k < p->n; k++)
        p->placed[k].root = sunder_i_union_find(p->parent, clauses->item[clauses->clause[p->placed[k].clause].first]);
    if (p->n) qsort(p->placed, p->n, sizeof *p->placed, sunder_i_by_id_pair);
    return true;
}

sunder_status sunder_i_cover_find(const sunder_i_clauses *clauses, sunder_i_cover_demand demand,
                                  const sunder_layer *layer, uint64_t effort, sunder_i_cover_result *result,
                                  sunder_error *err)
{
    plan p = {.clauses = clauses, .layer = layer, .shrinking = demand == SUNDER_I_COVER_SHRINKING};
    bool ok = sort_clauses(&p, demand != SUNDER_I_COVER_ALL, p.shrinking ? result->level : NULL);
    result->components = result->exact = 0;
    memset(result->level, 0, layer->n * sizeof *result->level);
    if (result->sure) memset(result->sure, 0, layer->n * sizeof *result->sure);
    for (size_t k = 0, end; ok && k < p.n; k = end) {
        for (end = k + 1; end < p.n && p.placed[end].root == p.placed[k].root;) end++;
        ok = cover_component(&p, p.placed + k, end - k, effort, result);
    }
    sunder_i_free_all(p.parent, p.place, p.placed);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}
