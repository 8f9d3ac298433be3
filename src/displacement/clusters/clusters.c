/* Bodies in conflict make edges, edges make clusters. */
#include "displacement/clusters/solver.h"

#include "base/union_find.h"

#include <math.h>
#include <stdlib.h>

static void free_clusters(sunder_i_job *w)
{
    for (size_t k = 0; k < w->clusters; k++) {
        sunder_i_truces_free(&w->cluster[k].truces);
        sunder_i_free(w->cluster[k].ended);
        sunder_i_free(w->cluster[k].guest);
    }
    sunder_i_free(w->cluster);
    w->cluster = NULL;
    w->clusters = 0;
}

void sunder_i_job_free(sunder_i_job *w)
{
    sunder_i_scene_free(&w->town, &w->scene);
    sunder_i_town_free(&w->town);
    sunder_i_free(w->start.pair);
    sunder_i_free(w->now.pair);
    sunder_i_free(w->entry);
    sunder_i_free(w->edge);
    sunder_i_free(w->parent);
    sunder_i_free(w->dirty);
    sunder_i_free(w->widened);
    sunder_i_free(w->changed);
    sunder_i_free(w->standing);
    sunder_i_free(w->improved);
    sunder_i_free(w->limit);
    sunder_i_free(w->aside);
    sunder_i_truces_free(&w->waiting);
    sunder_i_free(w->carrier);
    sunder_i_free(w->member);
    sunder_i_free(w->body);
    sunder_i_free(w->move);
    free_clusters(w);
    sunder_i_free(w->layer.feature);
    sunder_i_free(w->number);
}

sunder_status sunder_i_job_init(sunder_i_job *w, sunder_error *err)
{
    const size_t n = w->town.bodies;
    w->parent = sunder_i_alloc(n, sizeof *w->parent);
    w->dirty = sunder_i_calloc(n, sizeof *w->dirty);
    w->widened = sunder_i_calloc(n, sizeof *w->widened);
    w->changed = sunder_i_calloc(w->town.features, sizeof *w->changed);
    w->standing = sunder_i_calloc(n, sizeof *w->standing);
    w->improved = sunder_i_calloc(n, sizeof *w->improved);
    w->carrier = sunder_i_alloc(n, sizeof *w->carrier);
    if (!w->improved || !w->parent || !w->dirty || !w->widened || !w->changed || !w->standing || !w->carrier)
        return sunder_i_no_memory(err);
    sunder_i_union_init(w->parent, n);
    for (size_t b = 0; b < n; b++) w->carrier[b] = SUNDER_I_NOBODY;
    return SUNDER_OK;
}

/* ---- Clusters ---------------------------------------------------------------------------------------------------- */

bool sunder_i_job_add_edge(sunder_i_job *w, uint32_t i, uint32_t j)
{
    if (!sunder_i_reserve(&w->edge, &w->edge_capacity, w->edges + 1, sizeof *w->edge)) return false;
    w->edge[w->edges++] = (sunder_i_couple){i, j};
    const bool fi = w->town.body[i].fixed, fj = w->town.body[j].fixed;
    if (!fi) w->dirty[i] = true;
    if (!fj) w->dirty[j] = true;
    if (fi || fj) return true;
    sunder_i_union_join(w->parent, i, j);
    return true;
}

static int by_member(const void *a, const void *b)
{
    const sunder_i_member *p = a, *q = b;
    if (p->root != q->root) return p->root < q->root ? -1 : 1;
    return p->body < q->body ? -1 : p->body > q->body;
}

bool sunder_i_job_has_member(const sunder_i_job *w, uint32_t root, uint32_t body)
{
    const sunder_i_member wanted = {root, body};
    return w->members && bsearch(&wanted, w->member, w->members, sizeof wanted, by_member);
}

/* The first member of the cluster of that root, or of a later one. */
static size_t first_member(const sunder_i_job *w, uint64_t root)
{
    size_t low = 0, high = w->members;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (w->member[middle].root < root)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

const uint32_t *sunder_i_job_members(const sunder_i_job *w, uint32_t root, size_t *n)
{
    const size_t first = first_member(w, root);
    *n = first_member(w, (uint64_t)root + 1) - first;
    return w->body + first;
}

/* What is asked beyond the gap so that rounding the moves, and the search's own rounding, cannot eat into it: a
 * power of two, two to four units in the last place of the largest coordinate; four times as much for each failed
 * check. So where a shift keeps coordinates in their binades the search, which reckons from the bodies' own origins,
 * does the same. */
static double margin_of(const sunder_i_job *w, const sunder_i_member *m, size_t n)
{
    double largest = 0;
    unsigned widened = 0;
    for (size_t k = 0; k < n; k++) {
        const sunder_i_body *body = &w->town.body[m[k].body];
        if (body->pieces == 0) continue;
        for (int c = 0; c < 4; c++) largest = fmax(largest, fabs(body->origin[c & 1]) + fabs(body->box[c]));
        if (w->widened[m[k].body] > widened) widened = w->widened[m[k].body];
    }
    int exponent;
    frexp(largest + w->town.rules.gap, &exponent);
    return ldexp(1, exponent - 51 + 2 * (int)widened);
}

/* Clusters from the edges, afresh. */
sunder_status sunder_i_job_gather(sunder_i_job *w, sunder_error *err)
{
    sunder_i_free(w->member);
    sunder_i_free(w->body);
    sunder_i_free(w->move);
    free_clusters(w);
    w->member = sunder_i_alloc(2 * w->edges, sizeof *w->member);
    w->body = sunder_i_alloc(2 * w->edges, sizeof *w->body);
    w->move = sunder_i_alloc(4 * w->edges, sizeof *w->move);
    w->cluster = sunder_i_calloc(w->edges, sizeof *w->cluster);
    w->members = 0;
    if (!w->member || !w->body || !w->move || !w->cluster) return sunder_i_no_memory(err);
    size_t n = 0;
    for (size_t e = 0; e < w->edges; e++) {
        const uint32_t i = w->edge[e].a, j = w->edge[e].b;
        const uint32_t root = sunder_i_union_find(w->parent, w->town.body[i].fixed ? j : i);
        w->member[n++] = (sunder_i_member){root, i};
        w->member[n++] = (sunder_i_member){root, j};
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
            c->limited = c->limited || body->fixed || body->pinned || body->limit < INFINITY;
        }
        c->body = w->body + first;
        c->n = end - first;
        c->margin = margin_of(w, w->member + first, c->n);
    }
    return SUNDER_OK;
}
