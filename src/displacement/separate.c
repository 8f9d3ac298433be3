/* A whole layer: conflicts make clusters, clusters are solved, what they run into joins them, and exact checks have the
 * last word.
 *
 *     relations as it stands --> edges between bodies --> clusters --> moves, rounded
 *            ^                                                           |
 *            +---- relations of what moved, exact <----------------------+
 *
 * An edge is a pair of bodies that came into conflict at some time. Clusters are the components of the edges over
 * bodies that may move; a fixed body is a member of every cluster that has an edge to it, and joins none. Edges are
 * never removed, so each round either adds an edge between clusters, or widens the margin of a cluster whose result
 * failed the exact check (at most MOST_MARGINS times), or is the last: the loop ends. */
#include "displacement/displacement.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define MOST_MARGINS 14

typedef struct member {
    uint32_t root, body;
} member;

typedef struct work {
    sunder_i_town town;
    sunder_i_scene scene;
    sunder_i_relations start, now;
    sunder_i_couple *edge;
    size_t edges, edge_capacity;
    uint32_t *parent;       /* [bodies] union-find over edges */
    bool *dirty;            /* [bodies] to be solved (again) */
    unsigned char *widened; /* [bodies] how often the margin grew */
    bool *unsolved;         /* [bodies] its cluster is limited and no solution was found */
    bool *changed;          /* [features] moved in this round */
    double *next;           /* [2 * bodies] */
    member *member;         /* cluster after cluster, bodies ascending */
    size_t members;
    uint32_t *body; /* the bodies of member[] */
    double *move;   /* [2 * members] */
    sunder_i_cluster *cluster;
    bool *solved; /* [clusters] */
    size_t clusters;
    sunder_report *report;
} work;

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void work_free(work *w)
{
    sunder_i_scene_free(&w->town, &w->scene);
    sunder_i_town_free(&w->town);
    sunder_i_free(w->start.pair);
    sunder_i_free(w->now.pair);
    sunder_i_free(w->edge);
    sunder_i_free(w->parent);
    sunder_i_free(w->dirty);
    sunder_i_free(w->widened);
    sunder_i_free(w->unsolved);
    sunder_i_free(w->changed);
    sunder_i_free(w->next);
    sunder_i_free(w->member);
    sunder_i_free(w->body);
    sunder_i_free(w->move);
    sunder_i_free(w->cluster);
    sunder_i_free(w->solved);
    sunder_report_free(w->report);
}

static sunder_status work_init(work *w, sunder_error *err)
{
    const size_t n = w->town.bodies;
    w->parent = sunder_i_alloc(n, sizeof *w->parent);
    w->dirty = sunder_i_calloc(n, sizeof *w->dirty);
    w->widened = sunder_i_calloc(n, sizeof *w->widened);
    w->unsolved = sunder_i_calloc(n, sizeof *w->unsolved);
    w->changed = sunder_i_calloc(w->town.features, sizeof *w->changed);
    w->next = sunder_i_alloc(2 * n, sizeof *w->next);
    if (!w->parent || !w->dirty || !w->widened || !w->unsolved || !w->changed || !w->next)
        return sunder_i_no_memory(err);
    for (size_t b = 0; b < n; b++) w->parent[b] = (uint32_t)b;
    return SUNDER_OK;
}

/* ---- Clusters -------------------------------------------------------------------------------------------------- */

static uint32_t find(uint32_t *parent, uint32_t x)
{
    while (parent[x] != x) x = parent[x] = parent[parent[x]];
    return x;
}

static bool add_edge(work *w, uint32_t i, uint32_t j)
{
    if (!sunder_i_reserve(&w->edge, &w->edge_capacity, w->edges + 1, sizeof *w->edge)) return false;
    w->edge[w->edges++] = (sunder_i_couple){i, j};
    const bool fi = w->town.body[i].fixed, fj = w->town.body[j].fixed;
    if (!fi) w->dirty[i] = true;
    if (!fj) w->dirty[j] = true;
    if (fi || fj) return true;
    const uint32_t a = find(w->parent, i), b = find(w->parent, j);
    if (a != b) w->parent[a < b ? b : a] = a < b ? a : b;
    return true;
}

static int by_member(const void *a, const void *b)
{
    const member *p = a, *q = b;
    if (p->root != q->root) return p->root < q->root ? -1 : 1;
    return p->body < q->body ? -1 : p->body > q->body;
}

/* What is asked beyond the gap so that rounding the moves, and the search's own rounding, cannot eat into it: some
 * units in the last place of the coordinates; four times as much for each failed check. */
static double margin_of(const work *w, const member *m, size_t n)
{
    double largest = 0;
    unsigned widened = 0;
    for (size_t k = 0; k < n; k++) {
        const sunder_i_body *body = &w->town.body[m[k].body];
        if (body->pieces == 0) continue;
        for (int c = 0; c < 4; c++) largest = fmax(largest, fabs(body->origin[c & 1]) + fabs(body->box[c]));
        if (w->widened[m[k].body] > widened) widened = w->widened[m[k].body];
    }
    return ldexp(largest + w->town.rules.gap, -50 + 2 * (int)widened);
}

/* Clusters from the edges, afresh. */
static sunder_status gather(work *w, sunder_error *err)
{
    sunder_i_free(w->member);
    sunder_i_free(w->body);
    sunder_i_free(w->move);
    sunder_i_free(w->cluster);
    sunder_i_free(w->solved);
    w->member = sunder_i_alloc(2 * w->edges, sizeof *w->member);
    w->body = sunder_i_alloc(2 * w->edges, sizeof *w->body);
    w->move = sunder_i_alloc(4 * w->edges, sizeof *w->move);
    w->cluster = sunder_i_calloc(w->edges, sizeof *w->cluster);
    w->solved = sunder_i_calloc(w->edges, sizeof *w->solved);
    w->members = w->clusters = 0;
    if (!w->member || !w->body || !w->move || !w->cluster || !w->solved) return sunder_i_no_memory(err);
    size_t n = 0;
    for (size_t e = 0; e < w->edges; e++) {
        const uint32_t i = w->edge[e].a, j = w->edge[e].b;
        const uint32_t root = find(w->parent, w->town.body[i].fixed ? j : i);
        w->member[n++] = (member){root, i};
        w->member[n++] = (member){root, j};
    }
    if (n) qsort(w->member, n, sizeof *w->member, by_member);
    for (size_t k = 0; k < n; k++)
        if (k == 0 || by_member(&w->member[k - 1], &w->member[k])) {
            /* Compares the raw entry k with its neighbour, which may have been overwritten only by itself or an equal.
             */
            w->member[w->members] = w->member[k];
            w->body[w->members++] = w->member[k].body;
        }
    for (size_t first = 0, end; first < w->members; first = end) {
        sunder_i_cluster *c = &w->cluster[w->clusters++];
        for (end = first; end < w->members && w->member[end].root == w->member[first].root; end++) {
            const sunder_i_body *body = &w->town.body[w->member[end].body];
            c->limited = c->limited || body->fixed || body->limit < INFINITY;
        }
        c->body = w->body + first;
        c->n = end - first;
        c->margin = margin_of(w, w->member + first, c->n);
    }
    return SUNDER_OK;
}

static bool is_dirty(const work *w, const sunder_i_cluster *c)
{
    for (size_t k = 0; k < c->n; k++)
        if (w->dirty[c->body[k]]) return true;
    return false;
}

static void load_moves(const work *w, const sunder_i_cluster *c, double *move)
{
    for (size_t k = 0; k < c->n; k++) memcpy(move + 2 * k, w->town.move + 2 * (size_t)c->body[k], 2 * sizeof *move);
}

static sunder_status solve_clusters(void *context, size_t begin, size_t end, sunder_error *err)
{
    const work *w = context;
    for (size_t k = begin; k < end; k++) {
        const sunder_i_cluster *c = &w->cluster[k];
        double *move = w->move + 2 * (size_t)(c->body - w->body);
        load_moves(w, c, move);
        if (!is_dirty(w, c)) continue;
        const sunder_status status = sunder_i_cluster_solve(&w->town, c, move, &w->solved[k], err);
        if (status) return status;
    }
    return SUNDER_OK;
}

static sunder_status improve_clusters(void *context, size_t begin, size_t end, sunder_error *err)
{
    const work *w = context;
    for (size_t k = begin; k < end; k++) {
        const sunder_i_cluster *c = &w->cluster[k];
        double *move = w->move + 2 * (size_t)(c->body - w->body);
        load_moves(w, c, move);
        const sunder_status status = sunder_i_cluster_improve(&w->town, c, move, err);
        if (status) return status;
    }
    return SUNDER_OK;
}

/* Takes over the clusters' moves: bodies, features that changed, and whether their coordinates stayed exact. */
static void commit(work *w)
{
    sunder_i_town *town = &w->town;
    memset(w->changed, 0, town->features * sizeof *w->changed);
    for (size_t k = 0; k < w->members; k++) {
        const uint32_t b = w->body[k];
        const sunder_i_body *body = &town->body[b];
        double *move = town->move + 2 * (size_t)b, exact_move[2];
        if (body->fixed || memcmp(move, w->move + 2 * k, 2 * sizeof *move) == 0) continue;
        memcpy(move, w->move + 2 * k, 2 * sizeof *move);
        town->far = fmax(town->far, fmax(fabs(move[0]), fabs(move[1])));
        const bool exact = sunder_i_round_move(town, b, move, exact_move, NULL);
        for (uint32_t m = 0; m < body->members; m++) {
            const uint32_t f = town->member[body->member + m];
            w->changed[f] = true;
            town->inexact[f] = !exact;
        }
    }
}

/* ---- The loop ------------------------------------------------------------------------------------------------------
 */

/* Exact relations of what changed. */
static sunder_status check_changes(work *w, sunder_error *err)
{
    sunder_status status = sunder_i_scene_move(&w->town, &w->scene, w->changed, err);
    if (status) return status;
    sunder_i_relations now;
    status = sunder_i_scene_relate(&w->town, &w->scene, w->changed, &w->now, &now, err);
    if (status) return status;
    sunder_i_free(w->now.pair);
    w->now = now;
    return SUNDER_OK;
}

static bool is_between(const sunder_i_town *town, const sunder_i_relation *r)
{
    return r->near && !r->kept && town->body_of[r->a] != town->body_of[r->b] && !sunder_i_is_exempt(town, r->a, r->b);
}

/* In clusters of more bodies than this a pair that its limits cannot part is left as it is: to make the worst of
 * hundreds of such violations least would take hours, and gain nobody anything. */
#define LARGE 50

typedef struct judging {
    const sunder_i_town *town;
    const sunder_i_relations *start;
    const uint32_t *root, *size;
    bool *hopeless; /* [start->n] */
} judging;

static double limit_of(const sunder_i_body *body) { return body->fixed ? 0 : body->limit; }

static sunder_status judge(void *context, size_t begin, size_t end, sunder_error *err)
{
    const judging *g = context;
    const sunder_i_town *town = g->town;
    const double none[2] = {0, 0};
    for (size_t k = begin; k < end; k++) {
        const sunder_i_relation *r = &g->start->pair[k];
        const uint32_t i = town->body_of[r->a], j = town->body_of[r->b];
        const double reach = limit_of(&town->body[i]) + limit_of(&town->body[j]);
        const uint32_t root = town->body[i].fixed ? g->root[j] : g->root[i];
        if (!is_between(town, r) || reach == INFINITY || g->size[root] <= LARGE) continue;
        sunder_separation least;
        const sunder_status status =
            sunder_i_separate(town->layer->feature[r->a].shape, none, town->layer->feature[r->b].shape, none,
                              town->rules.gap, reach, &least, &g->hopeless[k], err);
        if (status) return status;
        sunder_separation_clear(&least);
    }
    return SUNDER_OK;
}

/* Finds the pairs of large clusters that cannot be parted within their limits; exact. */
static sunder_status give_up(work *w, sunder_error *err)
{
    sunder_i_town *town = &w->town;
    const size_t n = town->bodies;
    uint32_t *root = sunder_i_alloc(n, sizeof *root), *size = sunder_i_calloc(n, sizeof *size);
    bool *hopeless = sunder_i_calloc(w->start.n, sizeof *hopeless);
    sunder_status status = root && size && hopeless ? SUNDER_OK : sunder_i_no_memory(err);
    if (!status) {
        for (size_t b = 0; b < n; b++) root[b] = (uint32_t)b;
        for (size_t k = 0; k < w->start.n; k++) {
            const sunder_i_relation *r = &w->start.pair[k];
            const uint32_t i = town->body_of[r->a], j = town->body_of[r->b];
            if (!is_between(town, r) || town->body[i].fixed || town->body[j].fixed) continue;
            const uint32_t a = find(root, i), b = find(root, j);
            if (a != b) root[a < b ? b : a] = a < b ? a : b;
        }
        for (size_t b = 0; b < n; b++) root[b] = find(root, (uint32_t)b);
        for (size_t b = 0; b < n; b++) size[root[b]]++;
        judging g = {town, &w->start, root, size, hopeless};
        status = sunder_i_parallel(town->rules.threads, w->start.n, 8, judge, &g, err);
    }
    size_t found = 0;
    for (size_t k = 0; !status && k < w->start.n; k++) found += hopeless[k];
    if (!status) town->hopeless = sunder_i_alloc(found, sizeof *town->hopeless);
    if (!status && !town->hopeless) status = sunder_i_no_memory(err);
    for (size_t k = 0; !status && k < w->start.n; k++)
        if (hopeless[k]) town->hopeless[town->hopeless_n++] = (sunder_i_couple){w->start.pair[k].a, w->start.pair[k].b};
    sunder_i_free(root);
    sunder_i_free(size);
    sunder_i_free(hopeless);
    return status;
}

/* Conflicts as the features stand make bodies dirty: by a new edge between clusters, or a wider margin within one.
 * Returns whether there is anything to do. */
static sunder_status find_work(work *w, bool *any, sunder_error *err)
{
    sunder_i_town *town = &w->town;
    memset(w->dirty, 0, town->bodies * sizeof *w->dirty);
    *any = false;
    for (size_t k = 0; k < w->now.n; k++) {
        const sunder_i_relation *r = &w->now.pair[k];
        /* What lay in another and was moved across its edge by others has to leave it altogether. */
        if (r->near && !r->kept && town->kept_n) sunder_i_lapse(town, r->a, r->b);
        if (!is_between(town, r)) continue;
        const uint32_t i = town->body_of[r->a], j = town->body_of[r->b];
        const bool fi = town->body[i].fixed, fj = town->body[j].fixed;
        if (fi && fj) continue;
        bool known = false;
        if (!fi && !fj)
            known = find(w->parent, i) == find(w->parent, j);
        else
            for (size_t e = 0; e < w->edges && !known; e++)
                known = (w->edge[e].a == i && w->edge[e].b == j) || (w->edge[e].a == j && w->edge[e].b == i);
        if (!known) {
            if (!add_edge(w, i, j)) return sunder_i_no_memory(err);
            *any = true;
            continue;
        }
        const uint32_t b = fi ? j : i;
        if (w->unsolved[find(w->parent, b)] || w->widened[b] >= MOST_MARGINS) continue;
        if (w->dirty[b] && w->widened[b]) continue; /* once a round */
        w->widened[b]++;
        w->dirty[b] = *any = true;
    }
    return SUNDER_OK;
}

static void note_unsolved(work *w)
{
    for (size_t k = 0; k < w->clusters; k++) {
        const sunder_i_cluster *c = &w->cluster[k];
        if (!is_dirty(w, c)) continue;
        for (size_t m = 0; m < c->n; m++) {
            const uint32_t b = c->body[m];
            if (!w->town.body[b].fixed) w->unsolved[find(w->parent, b)] = !w->solved[k] && c->limited;
        }
    }
}

/* Unites the blocks that clusters are made of. A fixed one may be a member of several clusters: each body once, so that
 * no two threads do the same. */
static sunder_status unite_blocks(work *w, sunder_error *err)
{
    bool *seen = sunder_i_calloc(w->town.bodies, sizeof *seen);
    uint32_t *body = sunder_i_alloc(w->members, sizeof *body);
    sunder_status status = seen && body ? SUNDER_OK : sunder_i_no_memory(err);
    size_t n = 0;
    for (size_t k = 0; !status && k < w->members; k++) {
        if (!seen[w->body[k]]) body[n++] = w->body[k];
        seen[w->body[k]] = true;
    }
    if (!status) status = sunder_i_town_unite(&w->town, body, n, err);
    sunder_i_free(seen);
    sunder_i_free(body);
    return status;
}

static sunder_status settle(work *w, double from, double to, sunder_error *err)
{
    bool any;
    sunder_status status = find_work(w, &any, err);
    for (size_t round = 0; !status && any; round++) {
        if (!sunder_i_progress(&w->town.rules, from + (to - from) * (1 - 1 / (1 + 0.25 * (double)round))))
            return sunder_i_fail(err, SUNDER_ECANCEL, "stopped");
        status = gather(w, err);
        if (!status) status = unite_blocks(w, err);
        if (!status) status = sunder_i_parallel(w->town.rules.threads, w->clusters, 1, solve_clusters, w, err);
        if (status) return status;
        commit(w);
        note_unsolved(w);
        status = check_changes(w, err);
        if (!status) status = find_work(w, &any, err);
    }
    return status;
}

static sunder_status improve(work *w, sunder_error *err)
{
    sunder_status status = gather(w, err);
    if (!status) status = sunder_i_parallel(w->town.rules.threads, w->clusters, 1, improve_clusters, w, err);
    if (status) return status;
    commit(w);
    return check_changes(w, err);
}

/* ---- The report
 * ------------------------------------------------------------------------------------------------------ */

typedef struct measuring {
    const sunder_i_town *town;
    sunder_bound_pair *pair;
} measuring;

static sunder_status measure_pairs(void *context, size_t begin, size_t end, sunder_error *err)
{
    const measuring *m = context;
    const double none[2] = {0, 0};
    for (size_t k = begin; k < end; k++) {
        sunder_separation least;
        bool beyond;
        const sunder_status status = sunder_i_separate(m->town->layer->feature[m->pair[k].a].shape, none,
                                                       m->town->layer->feature[m->pair[k].b].shape, none,
                                                       m->town->rules.gap, INFINITY, &least, &beyond, err);
        if (status) return status;
        m->pair[k].least = fmax(0, least.lower_bound);
        sunder_separation_clear(&least);
    }
    return SUNDER_OK;
}

typedef struct key_pair {
    uint64_t bodies;
    size_t at;
} key_pair;

static int by_bodies(const void *a, const void *b)
{
    const key_pair *p = a, *q = b;
    if (p->bodies != q->bodies) return p->bodies < q->bodies ? -1 : 1;
    return p->at < q->at ? -1 : p->at > q->at;
}

static uint64_t bodies_of(const sunder_i_town *town, size_t a, size_t b)
{
    const uint32_t i = town->body_of[a], j = town->body_of[b];
    return i < j ? (uint64_t)i << 32 | j : (uint64_t)j << 32 | i;
}

static bool is_left(uint64_t bodies, const key_pair *left, size_t n)
{
    size_t low = 0, high = n;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (left[middle].bodies < bodies)
            low = middle + 1;
        else
            high = middle;
    }
    return low < n && left[low].bodies == bodies;
}

/* Where contained features may overlap what they lie in, a pair can also be resolved by moving one into the other, and
 * its least separation proves nothing; unless the boxes show that neither fits. */
static bool may_fit(const sunder_i_town *town, const sunder_i_relation *r)
{
    if (town->rules.contained != SUNDER_CONTAINED_IGNORE) return false;
    const double *a = town->box + 4 * (size_t)r->a, *b = town->box + 4 * (size_t)r->b;
    const double slack = 2 * town->rules.tolerance + 0x1p-48 * (fabs(a[0]) + fabs(a[1]) + fabs(b[2]) + fabs(b[3]));
    const double wide = (a[2] - a[0]) - (b[2] - b[0]), high = (a[3] - a[1]) - (b[3] - b[1]);
    return (wide <= slack && high <= slack) || (wide >= -slack && high >= -slack);
}

/* Of each pair of blocks the pair of members that is hardest to part; none of blocks that are still in conflict. */
static sunder_status bound_from_start(work *w, sunder_error *err)
{
    const sunder_i_town *town = &w->town;
    sunder_report *report = w->report;
    size_t n = 0, left = 0;
    key_pair *key = sunder_i_alloc(w->start.n + w->now.n, sizeof *key),
             *remain = sunder_i_alloc(w->now.n, sizeof *remain);
    report->bound_pair = sunder_i_calloc(w->start.n, sizeof *report->bound_pair);
    sunder_status status = key && remain && report->bound_pair ? SUNDER_OK : sunder_i_no_memory(err);
    if (!status) {
        for (size_t k = 0; k < w->now.n; k++)
            if (is_between(town, &w->now.pair[k]))
                remain[left++] = (key_pair){bodies_of(town, w->now.pair[k].a, w->now.pair[k].b), k};
        qsort(remain, left, sizeof *remain, by_bodies);
        for (size_t k = 0; k < w->start.n; k++) {
            const sunder_i_relation *r = &w->start.pair[k];
            if (!is_between(town, r) || may_fit(town, r) || is_left(bodies_of(town, r->a, r->b), remain, left))
                continue;
            report->bound_pair[n].a = r->a;
            report->bound_pair[n++].b = r->b;
        }
        measuring m = {town, report->bound_pair};
        status = sunder_i_parallel(town->rules.threads, n, 8, measure_pairs, &m, err);
    }
    if (!status) {
        for (size_t k = 0; k < n; k++)
            key[k] = (key_pair){bodies_of(town, report->bound_pair[k].a, report->bound_pair[k].b), k};
        qsort(key, n, sizeof *key, by_bodies);
        /* Keep the hardest of each run; a pair that is dropped gets least < 0. */
        for (size_t k = 1; k < n; k++) {
            if (key[k].bodies != key[k - 1].bodies) continue;
            sunder_bound_pair *p = &report->bound_pair[key[k - 1].at], *q = &report->bound_pair[key[k].at];
            if (p->least > q->least) {
                const size_t swap = key[k].at;
                key[k].at = key[k - 1].at;
                key[k - 1].at = swap;
                p = q;
            }
            p->least = -1;
        }
        size_t out = 0;
        for (size_t k = 0; k < n; k++)
            if (report->bound_pair[k].least > 0) report->bound_pair[out++] = report->bound_pair[k];
        report->bound_pairs = out;
        status = sunder_i_bound(town, report->bound_pair, out, &report->summary.lower_bound, err);
    }
    sunder_i_free(key);
    sunder_i_free(remain);
    return status;
}

/* Moves, statuses and their sums; in feature order, so that the sums are the same however the work was shared out. */
static void fill_moves(const work *w)
{
    const sunder_i_town *town = &w->town;
    sunder_report *report = w->report;
    sunder_layer_summary *s = &report->summary;
    for (size_t f = 0; f < town->features; f++) {
        const double *t = town->move + 2 * (size_t)town->body_of[f];
        if (t[0] == 0 && t[1] == 0) continue;
        report->move[2 * f] = t[0];
        report->move[2 * f + 1] = t[1];
        const double length = hypot(t[0], t[1]);
        report->status[f] = SUNDER_MOVED;
        s->moved++;
        s->total += length;
        s->cost += town->layer->feature[f].weight * (t[0] * t[0] + t[1] * t[1]);
        if (length > s->max) {
            s->max = length;
            s->max_feature = f;
        }
        if (town->inexact[f]) s->rounded++;
    }
    if (s->moved) s->mean = s->total / (double)s->moved;
    for (size_t k = 0; k < report->conflicts; k++) {
        const sunder_conflict *c = &report->conflict[k];
        if (c->inside_block || c->reason == SUNDER_REASON_KEPT) continue;
        const size_t pair[2] = {c->a, c->b};
        for (int e = 0; e < 2; e++)
            if (!town->body[town->body_of[pair[e]]].fixed) report->status[pair[e]] = SUNDER_BLOCKED;
    }
    for (size_t f = 0; f < town->features; f++) s->blocked += report->status[f] == SUNDER_BLOCKED;
}

static void name_unresolved(const work *w)
{
    /* Where nothing limits a cluster there is always room: what is left there the search failed to resolve. */
    for (size_t k = 0; k < w->report->conflicts; k++) {
        sunder_conflict *c = &w->report->conflict[k];
        if (c->reason != SUNDER_REASON_NO_ROOM) continue;
        const uint32_t bodies[2] = {w->town.body_of[c->a], w->town.body_of[c->b]};
        for (int e = 0; e < 2; e++) {
            if (w->town.body[bodies[e]].fixed) continue;
            const uint32_t root = find(w->parent, bodies[e]);
            for (size_t m = 0; m < w->clusters; m++)
                if (w->member[w->cluster[m].body - w->body].root == root && !w->cluster[m].limited)
                    c->reason = SUNDER_REASON_UNRESOLVED;
        }
    }
}

static sunder_status start(work *w, const sunder_layer *layer, const sunder_layer_options *options, sunder_error *err)
{
    sunder_i_rules rules;
    sunder_status status = sunder_i_rules_of(options, &rules, err);
    if (!status) status = sunder_i_town_init(layer, &rules, &w->town, err);
    if (!status) status = sunder_i_scene_init(&w->town, &w->scene, err);
    if (!status) status = sunder_i_scene_relate(&w->town, &w->scene, NULL, NULL, &w->start, err);
    if (!status) status = sunder_i_town_join(&w->town, &w->start, err);
    if (!status) status = sunder_i_report_new(&w->town, &w->report, err);
    if (status) return status;
    w->report->summary.pairs_tested = w->start.tested;
    sunder_i_count_relations(&w->town, &w->start, &w->report->summary.before);
    return SUNDER_OK;
}

static sunder_status separate(work *w, const sunder_layer *layer, const sunder_layer_options *options,
                              sunder_error *err)
{
    const double began = seconds();
    sunder_status status = start(w, layer, options, err);
    if (!status) status = sunder_i_town_cut(&w->town, err);
    if (!status) status = work_init(w, err);
    if (status) return status;
    w->now.pair = sunder_i_alloc(w->start.n, sizeof *w->now.pair);
    if (!w->now.pair) return sunder_i_no_memory(err);
    if (w->start.n) memcpy(w->now.pair, w->start.pair, w->start.n * sizeof *w->now.pair);
    w->now.n = w->start.n;
    if (!sunder_i_progress(&w->town.rules, 0.1)) return sunder_i_fail(err, SUNDER_ECANCEL, "stopped");
    status = give_up(w, err);
    if (!status) status = settle(w, 0.1, 0.5, err);
    if (!status) status = improve(w, err);
    if (!status) status = settle(w, 0.6, 0.8, err);
    if (!status) status = gather(w, err);
    if (status) return status;
    const double solved = seconds();
    if (!sunder_i_progress(&w->town.rules, 0.8)) return sunder_i_fail(err, SUNDER_ECANCEL, "stopped");
    sunder_report *report = w->report;
    /* Once more from nothing: the verdict leans on no earlier one. */
    sunder_i_relations last;
    memset(&last, 0, sizeof last);
    status = sunder_i_scene_relate(&w->town, &w->scene, NULL, NULL, &last, err);
    if (status) return status;
    sunder_i_free(w->now.pair);
    w->now = last;
    report->summary.seconds_solve = solved - began;
    report->summary.seconds_verify = seconds() - solved;
    sunder_i_count_relations(&w->town, &w->now, &report->summary.after);
    status = sunder_i_report_conflicts(report, &w->town, &w->scene, &w->now, true, err);
    if (!status) status = bound_from_start(w, err);
    if (status) return status;
    name_unresolved(w);
    fill_moves(w);
    report->summary.clusters = w->clusters;
    report->summary.verified = true;
    sunder_i_progress(&w->town.rules, 1);
    return SUNDER_OK;
}

sunder_status sunder_layer_separate(const sunder_layer *layer, const sunder_layer_options *options, sunder_report **out,
                                    sunder_error *err)
{
    work w;
    memset(&w, 0, sizeof w);
    const sunder_status status = separate(&w, layer, options, err);
    if (!status) {
        *out = w.report;
        w.report = NULL;
    }
    work_free(&w);
    return status;
}

sunder_status sunder_layer_check(const sunder_layer *layer, const sunder_layer_options *options, sunder_report **out,
                                 sunder_error *err)
{
    work w;
    memset(&w, 0, sizeof w);
    const double began = seconds();
    sunder_status status = start(&w, layer, options, err);
    if (!status) status = sunder_i_report_conflicts(w.report, &w.town, &w.scene, &w.start, false, err);
    if (!status) {
        sunder_layer_summary *s = &w.report->summary;
        s->after = s->before;
        s->verified = true;
        s->seconds_verify = seconds() - began;
        *out = w.report;
        w.report = NULL;
    }
    work_free(&w);
    return status;
}
