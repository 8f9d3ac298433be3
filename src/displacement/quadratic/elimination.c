/* The order in which the nodes of a graph are eliminated. It is found by one of two methods, and then changed so that
 * columns with the same rows are consecutive. */
#include "displacement/quadratic/elimination.h"
#include "displacement/quadratic/tuning.h"

#define END UINT32_MAX

bool sunder_i_elimination_init(sunder_i_elimination *e, size_t n, const sunder_i_id_pair *pair, size_t pairs,
                               uint32_t *rank)
{
    e->n = n;
    e->rank = rank;
    e->near = sunder_i_calloc(n, sizeof *e->near);
    if (!e->near) return false;
    for (size_t k = 0; k < pairs; k++)
        if (!sunder_i_list_push(&e->near[pair[k].a], pair[k].b) || !sunder_i_list_push(&e->near[pair[k].b], pair[k].a))
            return false;
    for (size_t v = 0; v < n; v++) e->near[v].n = sunder_i_set_make(e->near[v].item, e->near[v].n);
    return true;
}

void sunder_i_elimination_free(sunder_i_elimination *e)
{
    for (size_t v = 0; e->near && v < e->n; v++) sunder_i_free(e->near[v].item);
    sunder_i_free(e->near);
}

static bool rank_all(sunder_i_elimination *e, const double *place)
{
    bool done = false;
    if (place && e->n > FEWEST_DISSECTED && !sunder_i_dissect(e, place, &done)) return false;
    return done || sunder_i_minimum_degree(e);
}

/* Changes the order to a postorder of the elimination tree, in which the parent of a node is the first of its
 * neighbours to be eliminated: each node comes directly after all nodes below it. This changes no column, and columns
 * with the same rows become consecutive. Ranks are assigned from the last node on, to each node before those below
 * it. */
static bool rank_in_postorder(const sunder_i_elimination *g)
{
    uint32_t *rank = g->rank;
    uint32_t *by_rank = sunder_i_alloc(g->n, sizeof *by_rank), *parent = sunder_i_alloc(g->n, sizeof *parent),
             *below = sunder_i_calloc(g->n, sizeof *below), *end = sunder_i_alloc(g->n, sizeof *end);
    const bool ok = by_rank && parent && below && end;
    for (uint32_t v = 0; ok && v < g->n; v++) by_rank[rank[v]] = v;
    for (size_t r = 0; ok && r < g->n; r++) {
        const sunder_i_list *near = &g->near[by_rank[r]];
        parent[r] = END;
        for (size_t k = 0; k < near->n; k++)
            if (rank[near->item[k]] < parent[r]) parent[r] = rank[near->item[k]];
        if (parent[r] != END) below[parent[r]] += below[r] + 1;
    }
    /* end[r] is one more than the last rank left for the nodes below r. */
    uint32_t left = (uint32_t)g->n;
    for (size_t r = g->n; ok && r-- > 0;) {
        uint32_t *from = parent[r] == END ? &left : &end[parent[r]];
        end[r] = *from - 1;
        *from -= below[r] + 1;
        rank[by_rank[r]] = end[r];
    }
    sunder_i_free_all(by_rank, parent, below, end);
    return ok;
}

bool sunder_i_eliminate(sunder_i_elimination *e, const double *place)
{
    return rank_all(e, place) && rank_in_postorder(e);
}
