/* Whom to ask once more: the pairs of bodies under a truce that might have a solution, by the clusters they are of. */
#include "displacement/clusters/settle.h"
#include "displacement/clusters/stages.h"

#include "base/parallel.h"
#include "base/union_find.h"

#include <math.h>
#include <stdlib.h>

/* A truce of the town, by the cluster and the bodies it is of. */
typedef struct claim {
    uint32_t root;
    sunder_i_couple body;
    uint32_t truce;
} claim;

typedef struct suits {
    sunder_i_suit *suit; /* cluster after cluster, in the order in which to ask */
    size_t n;
    uint32_t *truce; /* what they are about, places in the town's */
} suits;

static int by_claim(const void *a, const void *b)
{
    const claim *p = a, *q = b;
    if (p->root != q->root) return p->root < q->root ? -1 : 1;
    const int order = sunder_i_by_couple(&p->body, &q->body);
    return order ? order : (p->truce > q->truce) - (p->truce < q->truce);
}

/* Overlaps before all others; what it would take to make peace, the least first. */
static int by_ease(const void *a, const void *b)
{
    const sunder_i_suit *p = a, *q = b;
    if (p->root != q->root) return p->root < q->root ? -1 : 1;
    if (p->overlap != q->overlap) return p->overlap ? -1 : 1;
    if (p->missing != q->missing) return p->missing < q->missing ? -1 : 1;
    const int order = sunder_i_by_couple(&p->body, &q->body);
    return order ? order : (p->part > q->part) - (p->part < q->part);
}

static size_t list_claims(const sunder_i_job *w, claim *list)
{
    const sunder_i_town *town = &w->town;
    size_t n = 0;
    for (size_t k = 0; k < town->truces.n; k++) {
        const uint32_t i = town->body_of[town->truces.item[k].a], j = town->body_of[town->truces.item[k].b];
        if (town->body[i].fixed && town->body[j].fixed) continue;
        const uint32_t root = sunder_i_union_find(w->parent, town->body[i].fixed ? j : i);
        if (!sunder_i_job_has_member(w, root, i) || !sunder_i_job_has_member(w, root, j)) continue;
        list[n++] = (claim){root, i < j ? (sunder_i_couple){i, j} : (sunder_i_couple){j, i}, (uint32_t)k};
    }
    if (n) qsort(list, n, sizeof *list, by_claim);
    return n;
}

/* The suit of truces between two bodies. */
static sunder_i_suit suit_of(const sunder_i_town *town, const claim *c, const uint32_t *truce, size_t n)
{
    sunder_i_suit x = {.root = c->root, .body = c->body, .truce = truce, .truces = n};
    double deepest = 0;
    for (size_t k = 0; k < n; k++) {
        const sunder_i_truce *t = &town->truces.item[truce[k]];
        const double depth = hypot(t->shift[0], t->shift[1]);
        x.peace = x.peace || !t->hopeless;
        x.disjoint = x.disjoint || sunder_i_suit_parts(town, t);
        deepest = fmax(deepest, depth);
        if (!(depth > 0)) x.missing = fmax(x.missing, town->rules.gap - t->gap);
    }
    x.overlap = deepest > 0;
    if (x.overlap) x.missing = deepest;
    return x;
}

static void add_suit(suits *out, const sunder_i_suit *x)
{
    if (x->peace || x->disjoint) out->suit[out->n++] = *x;
}

/* For each two bodies one of all truces between them, and where these are several one of each, in case not all have a
 * solution. */
static bool list_suits(const sunder_i_job *w, suits *out)
{
    const size_t most = w->town.truces.n;
    claim *list = sunder_i_alloc(most, sizeof *list);
    out->suit = sunder_i_alloc(2 * most, sizeof *out->suit);
    out->truce = sunder_i_alloc(most, sizeof *out->truce);
    const bool ok = list && out->suit && out->truce;
    const size_t n = ok ? list_claims(w, list) : 0;
    for (size_t k = 0; k < n; k++) out->truce[k] = list[k].truce;
    for (size_t first = 0, end; first < n; first = end) {
        const claim *c = &list[first];
        for (end = first; end < n && list[end].root == c->root && !sunder_i_by_couple(&list[end].body, &c->body);)
            end++;
        sunder_i_suit x = suit_of(&w->town, c, out->truce + first, end - first);
        add_suit(out, &x);
        for (size_t k = first; k < end && end - first > 1; k++) {
            x = suit_of(&w->town, c, out->truce + k, 1);
            x.part = k - first + 1;
            add_suit(out, &x);
        }
    }
    if (out->n) qsort(out->suit, out->n, sizeof *out->suit, by_ease);
    sunder_i_free(list);
    return ok;
}

/* ---- Asking ------------------------------------------------------------------------------------------------------ */

typedef struct asking {
    const sunder_i_job *job;
    const suits *suits;
} asking;

/* The first suit of a cluster of that root, or of a later one. */
static size_t first_of(const suits *all, uint64_t root)
{
    size_t low = 0, high = all->n;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (all->suit[middle].root < root)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static sunder_status retry_clusters(void *context, size_t begin, size_t end, sunder_error *err)
{
    const asking *g = context;
    const sunder_i_job *w = g->job;
    sunder_status status = SUNDER_OK;
    for (size_t k = begin; k < end && !status; k++) {
        sunder_i_cluster *c = &w->cluster[k];
        double *move = w->move + 2 * (size_t)(c->body - w->body);
        const uint32_t root = w->member[c->body - w->body].root;
        const size_t first = first_of(g->suits, root), last = first_of(g->suits, (uint64_t)root + 1);
        sunder_i_job_load_moves(w, c, move);
        if (first < last) status = sunder_i_cluster_retry(&w->town, c, g->suits->suit + first, last - first, move, err);
    }
    return status;
}

/* Pairs that cannot be brought to peace, but off each other, become members of clusters. */
static bool join_torn(sunder_i_job *w)
{
    const sunder_i_town *town = &w->town;
    for (size_t k = 0; k < town->truces.torn_n; k++) {
        const sunder_i_torn *t = &town->truces.torn[k];
        if (t->reach > 0 && t->reach <= sunder_i_limit_of(&town->body[t->i]) + sunder_i_limit_of(&town->body[t->j]) &&
            !sunder_i_job_add_edge(w, t->i, t->j))
            return false;
    }
    return true;
}

/* Who could be run into by body b, were it to move that far, becomes a member of its cluster, unless it is of another:
 * clusters stay what they are. */
static bool join_about(sunder_i_job *w, bool *alone, uint32_t b, double far, sunder_i_list *near)
{
    const sunder_i_town *town = &w->town;
    const sunder_i_body *p = &town->body[b];
    const double *t = town->move + 2 * (size_t)b, reach = town->rules.gap + far;
    double box[4];
    if (p->fixed || p->pinned || p->pieces == 0) return true;
    for (uint32_t c = 0; c < 4; c++) box[c] = p->box[c] + p->origin[c & 1] + t[c & 1] + (c < 2 ? -reach : reach);
    near->n = 0;
    if (!sunder_i_index_query(town->standing, box, near)) return false;
    for (size_t k = 0; k < near->n; k++) {
        const uint32_t other = town->body_of[near->item[k]];
        if (!alone[other] || other == b) continue;
        if (!sunder_i_job_add_edge(w, b, other)) return false;
        alone[other] = false;
    }
    return true;
}

/* What is to be asked may take others to make way: those about who stands under a truce that might end. */
static bool join_neighbours(sunder_i_job *w)
{
    const sunder_i_town *town = &w->town;
    sunder_i_list near = {0};
    bool *alone = sunder_i_alloc(town->bodies, sizeof *alone), ok = alone != NULL;
    for (size_t b = 0; b < town->bodies && ok; b++) alone[b] = !town->body[b].fixed && !town->body[b].pinned;
    for (size_t e = 0; e < w->edges && ok; e++) alone[w->edge[e].a] = alone[w->edge[e].b] = false;
    for (size_t k = 0; k < town->truces.n && ok; k++) {
        const sunder_i_truce *t = &town->truces.item[k];
        const double depth = hypot(t->shift[0], t->shift[1]), missing = depth > 0 ? depth : town->rules.gap - t->gap;
        const uint32_t i = town->body_of[t->a], j = town->body_of[t->b];
        if (t->hopeless && !sunder_i_suit_parts(town, t)) continue;
        ok = join_about(w, alone, i, fmin(missing, sunder_i_limit_of(&town->body[i])), &near) &&
             join_about(w, alone, j, fmin(missing, sunder_i_limit_of(&town->body[j])), &near);
    }
    sunder_i_free(near.item);
    sunder_i_free(alone);
    return ok;
}

sunder_status sunder_i_job_retry(sunder_i_job *w, sunder_error *err)
{
    suits all = {0};
    if (w->town.truces.n == 0) return SUNDER_OK;
    if (!join_torn(w) || !join_neighbours(w)) return sunder_i_no_memory(err);
    sunder_status status = sunder_i_job_gather(w, err);
    if (!status) status = sunder_i_job_unite_blocks(w, err);
    if (!status && !list_suits(w, &all)) status = sunder_i_no_memory(err);
    asking g = {w, &all};
    if (!status) status = sunder_i_parallel(w->town.rules.threads, w->clusters, 1, retry_clusters, &g, err);
    sunder_i_free(all.suit);
    sunder_i_free(all.truce);
    if (status) return status;
    sunder_i_job_commit(w);
    status = sunder_i_job_note_truces(w, err);
    return status ? status : sunder_i_job_check(w, err);
}
