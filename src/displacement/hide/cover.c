/* The best choice of features to hide, for each component of the clauses by branch and bound.
 *
 * Costs are vectors, one number a class that occurs in the component, compared lexicographically: the sum of weights
 * hidden in the most important class comes first. Such vectors are an ordered group, so that weak duality holds for
 * them as for numbers: clauses get values y >= 0 such that for no feature the values of its clauses exceed its cost;
 * then each choice costs at least the sum of the values. The values are found greedily, clause by clause
 * (bound_of()). A node of the search branches on the feature that is in most clauses without a hidden member: hidden,
 * or kept. A clause whose last free member is left makes it hidden.
 *
 * Among best choices the one is taken whose features come first: each feature that is not in the choice is asked, in
 * their order, whether a choice of the same cost has it and the features already decided. */
#include "displacement/hide/cover.h"

#include "base/union_find.h"

#include <stdlib.h>
#include <string.h>

enum { FREE, HIDDEN, KEPT };

/* One component. Features and clauses are numbered within it, features in the order of their numbers. */
typedef struct component {
    size_t features, clauses, classes;
    const uint32_t *feature;     /* [features] their numbers in the layer */
    int64_t *cost;               /* [features * classes] what hiding each costs */
    uint32_t *first, *member;    /* [clauses + 1] index in member[] of the first member of each */
    uint32_t *first_of, *of;     /* [features + 1] likewise in of[]: the clauses of each feature */
    unsigned char *state;        /* [features] */
    uint32_t *hidden_n, *free_n; /* [clauses] how many members have this state */
    uint32_t *trail;             /* the features that are not free, in the order of the decisions */
    size_t decided;
    uint32_t *unit;                 /* [clauses] clauses with one free member and no hidden one; some may have */
    size_t units;                   /* got a hidden one since */
    int64_t *spent, *least, *value; /* [classes] the cost of the hidden; a bound; and scratch */
    int64_t *rest;                  /* [features * classes] what clauses leave of the costs */
    int64_t *best;                  /* [classes] the cost of the best choice */
    unsigned char *chosen;          /* [features] that choice */
    bool found, first_only; /* a choice was found; the first one that costs no more than best[] ends the search */
    uint64_t nodes, most;
} component;

/* ---- Costs ------------------------------------------------------------------------------------------------------- */

static int compare(const int64_t *p, const int64_t *q, size_t n)
{
    for (size_t k = 0; k < n; k++)
        if (p[k] != q[k]) return p[k] < q[k] ? -1 : 1;
    return 0;
}

static void add(int64_t *sum, const int64_t *term, int64_t sign, size_t n)
{
    for (size_t k = 0; k < n; k++) sum[k] += sign * term[k];
}

/* Sets least[] to a lower bound of the cost of all choices that contain the hidden features and none of the kept. */
static void bound_of(component *c)
{
    const size_t n = c->classes;
    memcpy(c->rest, c->cost, c->features * n * sizeof *c->rest);
    memcpy(c->least, c->spent, n * sizeof *c->least);
    for (size_t k = 0; k < c->clauses; k++) {
        if (c->hidden_n[k]) continue;
        const int64_t *y = NULL;
        for (uint32_t m = c->first[k]; m < c->first[k + 1]; m++) {
            const uint32_t f = c->member[m];
            if (c->state[f] == FREE && (!y || compare(c->rest + n * f, y, n) < 0)) y = c->rest + n * f;
        }
        if (!y) continue;
        memcpy(c->value, y, n * sizeof *y);
        add(c->least, c->value, 1, n);
        for (uint32_t m = c->first[k]; m < c->first[k + 1]; m++) add(c->rest + n * c->member[m], c->value, -1, n);
    }
}

/* ---- Decisions --------------------------------------------------------------------------------------------------- */

/* Gives a free feature a state. Returns false if a clause has neither a free member nor a hidden one now. */
static bool decide(component *c, uint32_t f, unsigned char state)
{
    bool ok = true;
    c->state[f] = state;
    c->trail[c->decided++] = f;
    if (state == HIDDEN) add(c->spent, c->cost + c->classes * f, 1, c->classes);
    for (uint32_t k = c->first_of[f]; k < c->first_of[f + 1]; k++) {
        const uint32_t clause = c->of[k];
        c->free_n[clause]--;
        if (state == HIDDEN)
            c->hidden_n[clause]++;
        else if (c->hidden_n[clause] == 0 && c->free_n[clause] == 0)
            ok = false;
        else if (c->hidden_n[clause] == 0 && c->free_n[clause] == 1)
            c->unit[c->units++] = clause;
    }
    return ok;
}

/* Hides the last free members of clauses without a hidden one. */
static void hide_units(component *c)
{
    while (c->units) {
        const uint32_t clause = c->unit[--c->units];
        if (c->hidden_n[clause]) continue;
        uint32_t m = c->first[clause];
        while (c->state[c->member[m]] != FREE) m++;
        decide(c, c->member[m], HIDDEN);
    }
}

static void undo(component *c, size_t decided)
{
    c->units = 0;
    while (c->decided > decided) {
        const uint32_t f = c->trail[--c->decided];
        const bool hidden = c->state[f] == HIDDEN;
        c->state[f] = FREE;
        if (hidden) add(c->spent, c->cost + c->classes * f, -1, c->classes);
        for (uint32_t k = c->first_of[f]; k < c->first_of[f + 1]; k++) {
            c->free_n[c->of[k]]++;
            c->hidden_n[c->of[k]] -= hidden;
        }
    }
}

/* ---- Search ------------------------------------------------------------------------------------------------------ */

/* The free feature that is in most clauses without a hidden member; NO_FEATURE: each clause has one. */
#define NO_FEATURE UINT32_MAX
static uint32_t choose_feature(const component *c)
{
    uint32_t best = NO_FEATURE, most = 0;
    for (uint32_t f = 0; f < c->features; f++) {
        if (c->state[f] != FREE) continue;
        uint32_t n = 0;
        for (uint32_t k = c->first_of[f]; k < c->first_of[f + 1]; k++) n += c->hidden_n[c->of[k]] == 0;
        if (n > most) {
            best = f;
            most = n;
        }
    }
    return best;
}

/* Can this node not lead to a better choice than the one found? */
static bool is_hopeless(component *c)
{
    if (!c->found && !c->first_only) return false;
    bound_of(c);
    const int order = compare(c->least, c->best, c->classes);
    return c->first_only ? order > 0 || c->found : order >= 0;
}

/* Searches below the present decisions. Each decision undoes itself. The depth is at most the number of features. */
static void search(component *c)
{
    if (c->nodes >= c->most || is_hopeless(c)) return;
    c->nodes++;
    const uint32_t f = choose_feature(c);
    if (f == NO_FEATURE) {
        memcpy(c->best, c->spent, c->classes * sizeof *c->best);
        memcpy(c->chosen, c->state, c->features);
        c->found = true;
        return;
    }
    const size_t decided = c->decided;
    decide(c, f, HIDDEN);
    search(c);
    undo(c, decided);
    if (decide(c, f, KEPT)) {
        hide_units(c);
        search(c);
    }
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

/* Replaces chosen[] by the choice of the same cost whose features come first. */
static void take_first(component *c)
{
    for (uint32_t f = 0; f < c->features && c->nodes < c->most; f++) {
        if (c->state[f] != FREE) continue;
        const size_t decided = c->decided;
        decide(c, f, HIDDEN);
        if (c->chosen[f] == HIDDEN || has_equal(c)) continue;
        undo(c, decided);
        decide(c, f, KEPT); /* the choice at hand has the present decisions, so that no clause is left empty */
        hide_units(c);
    }
}

/* ---- Components -------------------------------------------------------------------------------------------------- */

/* What all components share: the clauses that count, sorted by component, and where each feature stands in its own. */
typedef struct plan {
    const sunder_i_clauses *clauses;
    const sunder_hiding_cost *cost;
    uint32_t *parent; /* [features] union-find over the clauses */
    uint32_t *place;  /* [features] the number of each within its component */
    struct placed {
        uint32_t root, clause;
    } * placed; /* sorted */
    size_t n;
} plan;

/* Fills in the costs: one column for each class that occurs. Returns false if memory is out. */
static bool make_costs(component *c, const sunder_hiding_cost *cost)
{
    uint32_t *class = sunder_i_alloc(c->features, sizeof *class);
    if (!class) return false;
    for (size_t f = 0; f < c->features; f++) class[f] = cost[c->feature[f]].hierarchy;
    c->classes = sunder_i_set_make(class, c->features);
    c->cost = sunder_i_calloc(c->features * c->classes, sizeof *c->cost);
    c->rest = sunder_i_alloc(c->features * c->classes, sizeof *c->rest);
    for (size_t f = 0; f < c->features && c->cost; f++) {
        const sunder_hiding_cost *own = &cost[c->feature[f]];
        const uint32_t *column = bsearch(&own->hierarchy, class, c->classes, sizeof *class, sunder_i_by_number);
        c->cost[f * c->classes + (size_t)(column - class)] = own->weight;
    }
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

/* Fills in the members of the clauses, and the clauses of the features; the arrays have room. */
static void link_clauses(const plan *p, const struct placed *placed, component *c)
{
    uint32_t at = 0;
    for (size_t k = 0; k < c->clauses; k++) {
        const sunder_i_clause *clause = &p->clauses->clause[placed[k].clause];
        c->first[k] = at;
        for (size_t m = 0; m < clause->n; m++) {
            const uint32_t f = p->place[p->clauses->item[clause->first + m]];
            c->member[at++] = f;
            c->first_of[f + 1]++;
        }
        c->free_n[k] = (uint32_t)clause->n;
        if (clause->n == 1) c->unit[c->units++] = (uint32_t)k;
    }
    c->first[c->clauses] = at;
    for (size_t f = 0; f < c->features; f++) c->first_of[f + 1] += c->first_of[f];
    for (size_t k = c->clauses; k-- > 0;)
        for (uint32_t m = c->first[k + 1]; m-- > c->first[k];) {
            const uint32_t f = c->member[m];
            c->of[--c->first_of[f + 1]] = (uint32_t)k;
        }
    /* first_of[f + 1] was the end of the clauses of f, and is their beginning now. */
    memmove(c->first_of, c->first_of + 1, c->features * sizeof *c->first_of);
    c->first_of[c->features] = at;
}

static void free_component(component *c, uint32_t *feature)
{
    sunder_i_free_all(feature, c->cost, c->first, c->member, c->first_of, c->of, c->state, c->hidden_n, c->free_n,
                      c->trail, c->unit, c->spent, c->least, c->value, c->rest, c->best, c->chosen);
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
    c->first = sunder_i_alloc(n + 1, sizeof *c->first);
    c->member = sunder_i_alloc(members, sizeof *c->member);
    c->first_of = sunder_i_calloc(c->features + 1, sizeof *c->first_of);
    c->of = sunder_i_alloc(members, sizeof *c->of);
    c->state = sunder_i_calloc(c->features, sizeof *c->state);
    c->chosen = sunder_i_calloc(c->features, sizeof *c->chosen);
    c->hidden_n = sunder_i_calloc(n, sizeof *c->hidden_n);
    c->free_n = sunder_i_alloc(n, sizeof *c->free_n);
    c->unit = sunder_i_alloc(n, sizeof *c->unit);
    c->trail = sunder_i_alloc(c->features, sizeof *c->trail);
    if (!make_costs(c, p->cost)) return false;
    c->spent = sunder_i_calloc(c->classes, sizeof *c->spent);
    c->least = sunder_i_alloc(c->classes, sizeof *c->least);
    c->value = sunder_i_alloc(c->classes, sizeof *c->value);
    c->best = sunder_i_calloc(c->classes, sizeof *c->best);
    if (!c->first || !c->member || !c->first_of || !c->of || !c->state || !c->chosen || !c->hidden_n || !c->free_n ||
        !c->unit || !c->trail || !c->spent || !c->least || !c->value || !c->best)
        return false;
    link_clauses(p, placed, c);
    return true;
}

/* Makes the choice for the component of n clauses. */
static bool cover_component(const plan *p, const struct placed *placed, size_t n, uint64_t effort,
                            sunder_i_cover_result *result)
{
    component c = {0};
    uint32_t *feature = NULL;
    const bool ok = make_component(p, placed, n, &c, &feature);
    if (ok) {
        c.most = effort + c.features; /* the first descent finds a choice */
        hide_units(&c);
        search(&c);
        if (c.nodes < c.most) take_first(&c);
        const bool exact = c.nodes < c.most;
        result->components++;
        result->exact += exact;
        for (size_t f = 0; f < c.features; f++) {
            result->hidden[feature[f]] = c.chosen[f] == HIDDEN;
            if (result->sure) result->sure[feature[f]] = exact;
        }
    }
    free_component(&c, feature);
    return ok;
}

/* Lists the clauses that count, by components. Returns false if memory is out. */
static bool sort_clauses(plan *p, bool proved_only, size_t features)
{
    const sunder_i_clauses *clauses = p->clauses;
    p->parent = sunder_i_alloc(features, sizeof *p->parent);
    p->place = sunder_i_alloc(features, sizeof *p->place);
    p->placed = sunder_i_alloc(clauses->n, sizeof *p->placed);
    if (!p->parent || !p->place || !p->placed) return false;
    sunder_i_union_init(p->parent, features);
    for (size_t k = 0; k < clauses->n; k++) {
        const sunder_i_clause *c = &clauses->clause[k];
        if (c->n == 0 || (proved_only && !c->proved)) continue;
        for (size_t m = 1; m < c->n; m++)
            sunder_i_union_join(p->parent, clauses->item[c->first], clauses->item[c->first + m]);
        p->placed[p->n++].clause = (uint32_t)k;
    }
    for (size_t k = 0; k < p->n; k++)
        p->placed[k].root = sunder_i_union_find(p->parent, clauses->item[clauses->clause[p->placed[k].clause].first]);
    if (p->n) qsort(p->placed, p->n, sizeof *p->placed, sunder_i_by_id_pair);
    return true;
}

sunder_status sunder_i_cover_find(const sunder_i_clauses *clauses, bool proved_only, const sunder_hiding_cost *cost,
                                  size_t features, uint64_t effort, sunder_i_cover_result *result, sunder_error *err)
{
    plan p = {.clauses = clauses, .cost = cost};
    bool ok = sort_clauses(&p, proved_only, features);
    result->components = result->exact = 0;
    memset(result->hidden, 0, features * sizeof *result->hidden);
    if (result->sure) memset(result->sure, 0, features * sizeof *result->sure);
    for (size_t k = 0, end; ok && k < p.n; k = end) {
        for (end = k + 1; end < p.n && p.placed[end].root == p.placed[k].root;) end++;
        ok = cover_component(&p, p.placed + k, end - k, effort, result);
    }
    sunder_i_free_all(p.parent, p.place, p.placed);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}
