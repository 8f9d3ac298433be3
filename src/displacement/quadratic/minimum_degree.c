/* Elimination in minimum degree order.
 *
 * Nodes with few neighbours are eliminated first. Bodies in a plane touch few others, and an outline that contains
 * hundreds of houses comes last, so the factor stays sparse whatever the shape of the cluster [GL81, chapter 5]. */
#include "displacement/quadratic/elimination.h"

#include <string.h>

#define END UINT32_MAX

/* The graph during elimination: sorted lists of the remaining neighbours, and the remaining nodes by degree in doubly
 * linked lists. */
typedef struct graph {
    size_t n;
    sunder_i_list *near;                 /* borrowed */
    uint32_t *head, *tail, *next, *prev; /* [n] head and tail of the list of each degree; successor and predecessor of
                                          * each node; END ends a list */
    sunder_i_list merged;
} graph;

static void remove_from_list(graph *g, uint32_t v)
{
    if (g->prev[v] != END)
        g->next[g->prev[v]] = g->next[v];
    else
        g->head[g->near[v].n] = g->next[v];
    if (g->next[v] != END)
        g->prev[g->next[v]] = g->prev[v];
    else
        g->tail[g->near[v].n] = g->prev[v];
}

/* Appends v to the list of its degree. Among nodes of equal degree the one that has had its degree longest is
 * eliminated first, so that elimination spreads over the whole graph. Elimination next to the last node took a third
 * more work on a grid of 20,000. */
static void append_to_list(graph *g, uint32_t v)
{
    const size_t degree = g->near[v].n;
    const uint32_t last = g->head[degree] == END ? END : g->tail[degree];
    g->prev[v] = last;
    g->next[v] = END;
    g->tail[degree] = v;
    if (last == END)
        g->head[degree] = v;
    else
        g->next[last] = v;
}

static bool graph_init(graph *g, const sunder_i_elimination *e)
{
    memset(g, 0, sizeof *g);
    g->n = e->n;
    g->near = e->near;
    g->head = sunder_i_alloc(g->n, sizeof *g->head);
    g->tail = sunder_i_alloc(g->n, sizeof *g->tail);
    g->next = sunder_i_alloc(g->n, sizeof *g->next);
    g->prev = sunder_i_alloc(g->n, sizeof *g->prev);
    if (!g->head || !g->tail || !g->next || !g->prev) return false;
    for (size_t v = 0; v < g->n; v++) g->head[v] = END;
    for (size_t v = 0; v < g->n; v++) append_to_list(g, (uint32_t)v);
    return true;
}

static void graph_free(graph *g) { sunder_i_free_all(g->head, g->tail, g->next, g->prev, g->merged.item); }

/* Adds the neighbours of v to those of u, and removes v from them. Returns false if memory is out. */
static bool join_neighbours(graph *g, uint32_t u, uint32_t v)
{
    const sunder_i_list *a = &g->near[u], *b = &g->near[v];
    sunder_i_list *out = &g->merged;
    if (!sunder_i_reserve(&out->item, &out->capacity, a->n + b->n, sizeof *out->item)) return false;
    out->n = 0;
    size_t i = 0, j = 0;
    while (i < a->n || j < b->n) {
        uint32_t w;
        if (j == b->n || (i < a->n && a->item[i] < b->item[j]))
            w = a->item[i++];
        else {
            w = b->item[j++];
            if (i < a->n && a->item[i] == w) i++;
        }
        if (w != u && w != v) out->item[out->n++] = w;
    }
    remove_from_list(g, u);
    const sunder_i_list swap = g->near[u];
    g->near[u] = *out;
    *out = swap;
    append_to_list(g, u);
    return true;
}

static bool eliminate_nodes(graph *g, uint32_t *rank)
{
    size_t degree = 0;
    for (size_t turn = 0; turn < g->n; turn++) {
        /* Eliminating a node lowers the least degree by at most one. */
        if (degree) degree--;
        while (g->head[degree] == END) degree++;
        const uint32_t v = g->head[degree];
        remove_from_list(g, v);
        rank[v] = (uint32_t)turn;
        for (size_t k = 0; k < g->near[v].n; k++)
            if (!join_neighbours(g, g->near[v].item[k], v)) return false;
    }
    return true;
}

bool sunder_i_minimum_degree(sunder_i_elimination *e)
{
    graph g;
    const bool ok = graph_init(&g, e) && eliminate_nodes(&g, e->rank);
    graph_free(&g);
    return ok;
}
