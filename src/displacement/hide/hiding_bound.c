/* What has to be hidden at least, because of the proved clauses, as a tree that can be checked without a search.
 *
 * Each clause S gets a share y_S of the cost of hiding, so that for each feature and level the shares of the clauses
 * that it satisfies with this level are no more than the level costs. A choice that satisfies all clauses then costs at
 * least the sum of the shares: each clause is satisfied by someone, and the costs of the levels cover the shares. Where
 * that proves too little, the choices are divided into those that give a certain feature at least some level and those
 * that do not, and so on. Costs are vectors of the weights of each class, compared in the order of the classes; shares
 * are such vectors, and not less than 0 in that order. The reasoning needs only sums and an order, so it holds for
 * vectors, too.
 *
 * A tree is written in preorder. The shares are greedy: that of each clause in turn is the least that its members have
 * left. */
#include "displacement/hide/hiding_bound.h"
#include "displacement/hide/cost_vectors.h"

#include "base/list.h"
#include "base/union_find.h"

#include <stdlib.h>
#include <string.h>

/* Here the levels of a feature are 0, visible with whatever shape, and 1, hidden; a clause demands a level above 0. */
enum { LEVELS = 2, LEVEL_OF_CLAUSE = 0 };

/* The component at hand. Features are numbered within it. */
typedef struct branching {
    const sunder_i_clauses *clauses;
    const uint32_t *clause; /* [n] those of the component, the smallest first */
    size_t n;
    const uint32_t *feature, *place; /* [features] their numbers in the layer; and the reverse, by those */
    size_t features;
    const uint32_t *class; /* [classes] those that occur, ascending */
    size_t classes;
    int64_t *cost, *rest; /* [features * LEVELS * classes] what each level costs, and what the shares leave of it */
    uint32_t *low, *high; /* [features] the least and the greatest level of the choices at hand */
    uint32_t *unmet;      /* [features] clauses that each feature may satisfy, and none does yet */
    int64_t *spent, *value, *share, *target, *least; /* [classes] what the least levels cost; with the shares; of one
                                                      * clause; of the best choice; the least value of all leaves */
    bool any;                                        /* there is a leaf */
    size_t left;                                     /* nodes that may still be divided */
    sunder_i_hiding_bound *out;
} branching;

/* Of feature f, numbered within the component. */
static int64_t *cost_of(const branching *b, uint32_t f, uint32_t level)
{
    return b->cost + b->classes * ((size_t)f * LEVELS + level);
}

static int64_t *rest_of(const branching *b, uint32_t f, uint32_t level)
{
    return b->rest + b->classes * ((size_t)f * LEVELS + level);
}

/* A member of a clause: the feature, and the level that it has to exceed. */
typedef struct member {
    uint32_t f, level;
} member;

static member member_of(const branching *b, const sunder_i_clause *clause, size_t m)
{
    return (member){b->place[b->clauses->item[clause->first + m]], LEVEL_OF_CLAUSE};
}

static bool is_met(const branching *b, member m) { return b->low[m.f] > m.level; }

static bool is_free(const branching *b, member m) { return b->low[m.f] <= m.level && b->high[m.f] > m.level; }

/* ---- Writing ----------------------------------------------------------------------------------------------------- */

static bool put_node(branching *b, sunder_hiding_node node)
{
    sunder_i_hiding_bound *out = b->out;
    if (!sunder_i_reserve(&out->node, &out->node_room, out->nodes + 1, sizeof *out->node)) return false;
    out->node[out->nodes++] = node;
    return true;
}

/* Appends the weights of each class that are not 0, as a share of this clause. */
static bool put_shares(branching *b, size_t clause, const int64_t *weight)
{
    sunder_i_hiding_bound *out = b->out;
    if (!sunder_i_reserve(&out->share, &out->share_room, out->shares + b->classes, sizeof *out->share)) return false;
    for (size_t k = 0; k < b->classes; k++)
        if (weight[k]) out->share[out->shares++] = (sunder_hiding_share){clause, b->class[k], weight[k]};
    return true;
}

/* ---- One node ---------------------------------------------------------------------------------------------------- */

/* Counts the members that may satisfy a clause; SIZE_MAX if one does already. */
static size_t count_free(const branching *b, const sunder_i_clause *clause)
{
    size_t n = 0;
    for (size_t k = 0; k < clause->n; k++) {
        const member m = member_of(b, clause, k);
        if (is_met(b, m)) return SIZE_MAX;
        n += is_free(b, m);
    }
    return n;
}

/* Gives the clause the least that the levels have left with which its members would satisfy it. */
static bool give_share(branching *b, size_t number)
{
    const sunder_i_clause *clause = &b->clauses->clause[number];
    const int64_t *least = NULL;
    for (int taken = 0; taken < 2; taken++) {
        for (size_t k = 0; k < clause->n; k++) {
            const member m = member_of(b, clause, k);
            for (uint32_t level = m.level + 1; is_free(b, m) && level <= b->high[m.f]; level++)
                if (taken)
                    sunder_i_costs_add(rest_of(b, m.f, level), b->share, -1, b->classes);
                else if (!least || sunder_i_costs_cmp(rest_of(b, m.f, level), least, b->classes) < 0)
                    least = rest_of(b, m.f, level);
        }
        if (!taken) memcpy(b->share, least, b->classes * sizeof *least);
    }
    sunder_i_costs_add(b->value, b->share, 1, b->classes);
    return put_shares(b, number, b->share);
}

/* Sets what the levels have left before any share: what each costs more than the least one. */
static void begin_shares(branching *b)
{
    memcpy(b->value, b->spent, b->classes * sizeof *b->value);
    memset(b->unmet, 0, b->features * sizeof *b->unmet);
    memcpy(b->rest, b->cost, b->features * LEVELS * b->classes * sizeof *b->rest);
    for (uint32_t f = 0; f < b->features; f++)
        for (uint32_t level = b->low[f]; b->low[f] && level <= b->high[f]; level++)
            sunder_i_costs_add(rest_of(b, f, level), cost_of(b, f, b->low[f]), -1, b->classes);
}

/* Gives all clauses their shares, those that only one feature may satisfy first. Sets *unmet to a clause that no
 * feature may satisfy; SIZE_MAX: there is none. Returns false if memory is out. */
static bool give_shares(branching *b, size_t *unmet)
{
    bool ok = true;
    *unmet = SIZE_MAX;
    begin_shares(b);
    for (int others = 0; others < 2; others++)
        for (size_t k = 0; k < b->n && ok && *unmet == SIZE_MAX; k++) {
            const sunder_i_clause *clause = &b->clauses->clause[b->clause[k]];
            const size_t n = count_free(b, clause);
            if (n == 0) *unmet = b->clause[k];
            if (n == 0 || n == SIZE_MAX || (n > 1) != others) continue;
            for (size_t m = 0; m < clause->n; m++) b->unmet[member_of(b, clause, m).f]++;
            ok = give_share(b, b->clause[k]);
        }
    return ok;
}

/* Chooses the feature that may satisfy most clauses, and the least level with which it satisfies one. Returns false if
 * each clause is satisfied. */
static bool choose_split(const branching *b, member *split)
{
    uint32_t most = 0;
    *split = (member){0, LEVELS};
    for (uint32_t f = 0; f < b->features; f++)
        if (b->low[f] < b->high[f] && b->unmet[f] > most) {
            most = b->unmet[f];
            split->f = f;
        }
    for (size_t k = 0; k < b->n && most; k++) {
        const sunder_i_clause *clause = &b->clauses->clause[b->clause[k]];
        for (size_t i = 0; i < clause->n; i++) {
            const member m = member_of(b, clause, i);
            if (m.f == split->f && is_free(b, m) && m.level + 1 < split->level) split->level = m.level + 1;
        }
    }
    return most > 0;
}

static bool put_leaf(branching *b, size_t shares)
{
    if (!b->any || sunder_i_costs_cmp(b->value, b->least, b->classes) < 0)
        memcpy(b->least, b->value, b->classes * sizeof *b->least);
    b->any = true;
    return put_node(
        b, (sunder_hiding_node){.kind = SUNDER_HIDING_NODE_SHARES, .share = shares, .shares = b->out->shares - shares});
}

/* Writes the tree of the choices at hand. Its depth is at most the number of features and levels. */
static bool write_tree(branching *b)
{
    const size_t shares = b->out->shares;
    size_t unmet;
    member split;
    if (!give_shares(b, &unmet)) return false;
    if (unmet == SIZE_MAX &&
        (b->left == 0 || sunder_i_costs_cmp(b->value, b->target, b->classes) >= 0 || !choose_split(b, &split)))
        return put_leaf(b, shares);
    b->out->shares = shares;
    if (unmet != SIZE_MAX) return put_node(b, (sunder_hiding_node){.kind = SUNDER_HIDING_NODE_UNMET, .clause = unmet});
    b->left--;
    const uint32_t low = b->low[split.f], high = b->high[split.f];
    bool ok = put_node(b, (sunder_hiding_node){
                              .kind = SUNDER_HIDING_NODE_SPLIT, .feature = b->feature[split.f], .level = split.level});
    b->low[split.f] = split.level;
    sunder_i_costs_add(b->spent, cost_of(b, split.f, split.level), 1, b->classes);
    sunder_i_costs_add(b->spent, cost_of(b, split.f, low), -1, b->classes);
    ok = ok && write_tree(b);
    b->low[split.f] = low;
    sunder_i_costs_add(b->spent, cost_of(b, split.f, low), 1, b->classes);
    sunder_i_costs_add(b->spent, cost_of(b, split.f, split.level), -1, b->classes);
    b->high[split.f] = split.level - 1;
    ok = ok && write_tree(b);
    b->high[split.f] = high;
    return ok;
}

/* ---- Components -------------------------------------------------------------------------------------------------- */

/* Fills in the costs, and that of the best choice. */
static void find_costs(branching *b, const sunder_layer *layer, const uint32_t *best)
{
    const sunder_hiding_cost *cost = layer->hiding;
    for (size_t f = 0; f < b->features; f++) {
        const uint32_t number = b->feature[f];
        const uint32_t *class =
            bsearch(&cost[number].hierarchy, b->class, b->classes, sizeof *class, sunder_i_by_number);
        for (uint32_t level = 1; level < LEVELS; level++)
            cost_of(b, (uint32_t)f, level)[class - b->class] = cost[number].weight;
        b->high[f] = LEVELS - 1;
        if (sunder_i_is_hidden_at(layer, number, best[number])) b->target[class - b->class] += cost[number].weight;
    }
}

/* Vectors without negative weights that are not below `weight` are not below this one either: from the first negative
 * weight on they have more, unless they differ before. */
static void clear_negative(int64_t *weight, size_t n)
{
    size_t k = 0;
    while (k < n && weight[k] >= 0) k++;
    for (; k < n; k++) weight[k] = 0;
}

static bool make_tree(branching *b, const sunder_layer *layer, const uint32_t *best)
{
    int64_t **const all[] = {&b->spent, &b->value, &b->share, &b->target, &b->least};
    sunder_i_hiding_bound *out = b->out;
    bool ok = true;
    b->cost = sunder_i_calloc(b->features * LEVELS * b->classes, sizeof *b->cost);
    b->rest = sunder_i_alloc(b->features * LEVELS * b->classes, sizeof *b->rest);
    b->low = sunder_i_calloc(b->features, sizeof *b->low);
    b->high = sunder_i_alloc(b->features, sizeof *b->high);
    b->unmet = sunder_i_alloc(b->features, sizeof *b->unmet);
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        *all[k] = sunder_i_calloc(b->classes, sizeof **all[k]);
        ok = ok && *all[k];
    }
    ok = ok && b->cost && b->rest && b->low && b->high && b->unmet &&
         sunder_i_reserve(&out->tree, &out->tree_room, out->trees + 1, sizeof *out->tree);
    sunder_hiding_tree tree = {.node = out->nodes};
    if (ok) {
        find_costs(b, layer, best);
        ok = write_tree(b);
        clear_negative(b->least, b->classes);
        tree.nodes = out->nodes - tree.node;
        tree.bound = out->shares;
        ok = ok && put_shares(b, SIZE_MAX, b->least);
        tree.bounds = out->shares - tree.bound;
        tree.feature = b->feature[0];
    }
    if (ok) out->tree[out->trees++] = tree;
    sunder_i_free_all(b->cost, b->rest, b->low, b->high, b->unmet, b->spent, b->value, b->share, b->target, b->least);
    return ok;
}

/* A clause with the root of its component. */
typedef struct placed {
    uint32_t root, n, clause;
} placed;

static int by_component(const void *x, const void *y)
{
    const placed *p = x, *q = y;
    if (p->root != q->root) return p->root < q->root ? -1 : 1;
    if (p->n != q->n) return p->n < q->n ? -1 : 1;
    return (p->clause > q->clause) - (p->clause < q->clause);
}

/* Makes the tree of the component of these n clauses. place: room for all features. */
static bool bound_component(const sunder_i_clauses *clauses, const placed *list, size_t n, uint32_t *place,
                            const sunder_layer *layer, const uint32_t *best, size_t effort, sunder_i_hiding_bound *out)
{
    sunder_i_list clause = {0}, feature = {0}, class = {0};
    bool ok = true;
    for (size_t k = 0; k < n && ok; k++) {
        const sunder_i_clause *c = &clauses->clause[list[k].clause];
        ok = sunder_i_list_push(&clause, list[k].clause);
        for (size_t m = 0; m < c->n && ok; m++) ok = sunder_i_list_push(&feature, clauses->item[c->first + m]);
    }
    feature.n = sunder_i_set_make(feature.item, feature.n);
    for (size_t f = 0; f < feature.n && ok; f++) {
        place[feature.item[f]] = (uint32_t)f;
        ok = sunder_i_list_push(&class, layer->hiding[feature.item[f]].hierarchy);
    }
    class.n = sunder_i_set_make(class.item, class.n);
    branching b = {.clauses = clauses,
                   .clause = clause.item,
                   .n = n,
                   .feature = feature.item,
                   .place = place,
                   .features = feature.n,
                   .class = class.item,
                   .classes = class.n,
                   .left = effort + 2 * feature.n,
                   .out = out};
    ok = ok && make_tree(&b, layer, best);
    sunder_i_free_all(clause.item, feature.item, class.item);
    return ok;
}

/* Can this clause be satisfied by nothing but a hidden member, by a proof? The others bind no hidden weight: with the
 * smallest shapes all of them are satisfied. */
static bool binds_hiding(const sunder_i_clauses *clauses, const sunder_i_clause *c, const sunder_layer *layer)
{
    if (!c->proved || c->n == 0) return false;
    for (size_t m = c->first; m < c->first + c->n; m++)
        if (!sunder_i_is_hidden_at(layer, clauses->item[m], clauses->level[m] + 1)) return false;
    return true;
}

sunder_status sunder_i_hiding_bound_find(const sunder_i_clauses *clauses, const sunder_layer *layer,
                                         const uint32_t *best, size_t effort, sunder_i_hiding_bound *bound,
                                         sunder_error *err)
{
    const size_t features = layer->n;
    uint32_t *parent = sunder_i_alloc(features, sizeof *parent), *place = sunder_i_alloc(features, sizeof *place);
    placed *list = sunder_i_alloc(clauses->n, sizeof *list);
    bool ok = parent && place && list;
    size_t n = 0;
    if (ok) sunder_i_union_init(parent, features);
    for (size_t k = 0; k < clauses->n && ok; k++) {
        const sunder_i_clause *c = &clauses->clause[k];
        if (!binds_hiding(clauses, c, layer)) continue;
        list[n++] = (placed){0, (uint32_t)c->n, (uint32_t)k};
        for (size_t m = 1; m < c->n; m++)
            sunder_i_union_join(parent, clauses->item[c->first], clauses->item[c->first + m]);
    }
    for (size_t k = 0; k < n; k++)
        list[k].root = sunder_i_union_find(parent, clauses->item[clauses->clause[list[k].clause].first]);
    if (n) qsort(list, n, sizeof *list, by_component);
    for (size_t k = 0, end; k < n && ok; k = end) {
        for (end = k + 1; end < n && list[end].root == list[k].root;) end++;
        ok = bound_component(clauses, list + k, end - k, place, layer, best, effort, bound);
    }
    sunder_i_free_all(parent, place, list);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}
