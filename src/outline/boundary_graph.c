/* boundary_graph.c: see boundary_graph.h. Edges, their ends sorted around each vertex by rank, and then the covered
 * walks, which turn across covered wedges. */
#include "outline/boundary_graph.h"

#include "base/invariant.h"
#include "base/sort.h"

#include <string.h>

static bool make_edges(sunder_i_graph *g, const sunder_i_coverage *c)
{
    g->edge = sunder_i_alloc(c->stretches, sizeof *g->edge);
    if (!g->edge) return false;
    for (size_t i = 0; i < c->stretches; i++) {
        const sunder_i_outline_stretch *p = &c->stretch[i];
        const uint32_t from = p->from, to = p->to, class = sunder_i_lines_class(g->lines, p->line);
        if (p->banks == SUNDER_I_BANK_LEFT) g->edge[g->edges++] = (sunder_i_boundary_edge){from, to, class, p->line};
        if (p->banks == SUNDER_I_BANK_RIGHT)
            g->edge[g->edges++] = (sunder_i_boundary_edge){to, from, class + g->classes, p->line};
    }
    return true;
}

static int compare_rays(void *context, uint32_t a, uint32_t b)
{
    const sunder_i_graph *g = context;
    const uint32_t ra = sunder_i_ray_rank(g, a), rb = sunder_i_ray_rank(g, b);
    return (ra > rb) - (ra < rb);
}

static bool make_rays(sunder_i_graph *g)
{
    g->ray_end = sunder_i_calloc((size_t)g->vertices + 1, sizeof *g->ray_end);
    g->ray = sunder_i_alloc(2 * (size_t)g->edges, sizeof *g->ray);
    if (!g->ray_end || !g->ray) return false;
    for (uint32_t e = 0; e < g->edges; e++) {
        g->ray_end[g->edge[e].from]++;
        g->ray_end[g->edge[e].to]++;
    }
    uint32_t sum = 0;
    for (uint32_t v = 0; v < g->vertices; v++) {
        const uint32_t n = g->ray_end[v];
        g->ray_end[v] = sum; /* the position of the next ray of v; finally the end of its rays */
        sum += n;
    }
    for (uint32_t e = 0; e < g->edges; e++) {
        g->ray[g->ray_end[g->edge[e].from]++] = 2 * e;
        g->ray[g->ray_end[g->edge[e].to]++] = 2 * e + 1;
    }
    for (uint32_t v = 0; v < g->vertices; v++) {
        const uint32_t first = sunder_i_first_ray(g, v), n = g->ray_end[v] - first;
        if (n > 2 && !sunder_i_sort_indices(g->ray + first, n, compare_rays, g)) return false;
    }
    return true;
}

/* Returns the first outgoing edge after the arrival of `edge`, turning clockwise (across the covered wedge) or
 * counterclockwise (across the free one); with same_component, among the edges of that edge's component. */
static uint32_t turn_at_end(const sunder_i_graph *g, uint32_t edge, bool clockwise, bool same_component)
{
    const uint32_t v = g->edge[edge].to, first = sunder_i_first_ray(g, v), n = g->ray_end[v] - first;
    if (n == 2) return g->ray[g->ray[first] & 1 ? first + 1 : first] >> 1;
    uint32_t i = 0;
    while (g->ray[first + i] != 2 * edge + 1) i++;
    for (uint32_t k = 1; k < n; k++) {
        const sunder_i_ray r = g->ray[first + (clockwise ? i + n - k : i + k) % n];
        if (r & 1) continue;
        if (!same_component || g->component[g->walk[r >> 1]] == g->component[g->walk[edge]]) return r >> 1;
    }
    SUNDER_I_ASSERT(false && "edges that arrive and edges that leave balance at each vertex");
    return edge;
}

/* Returns the edge that follows `edge` on its covered walk. */
static uint32_t next_covered(const sunder_i_graph *graph, uint32_t edge)
{
    return turn_at_end(graph, edge, true, false);
}

uint32_t sunder_i_graph_next_free(const sunder_i_graph *graph, uint32_t edge)
{
    return turn_at_end(graph, edge, false, true);
}

/* Assigns the edges from `start` on to a walk; returns its lexicographically smallest vertex. */
static uint32_t number_walk(sunder_i_graph *g, uint32_t walk, uint32_t start)
{
    uint32_t least = g->edge[start].from, e = start;
    bool plain = true;
    do {
        const uint32_t v = g->edge[e].from;
        if (sunder_i_is_before(g, v, least)) least = v;
        plain &= g->ray_end[v] - sunder_i_first_ray(g, v) == 2;
        g->walk[e] = walk;
        e = next_covered(g, e);
    } while (e != start);
    g->walk_plain[walk] = plain;
    return least;
}

/* Determines whether the walk is the outer boundary of its face. At `least`, its smallest vertex, all rays point into
 * the right half-plane, and the region below the lowest ray is outside the walk. If that ray leaves, the covered side
 * (its left) is above it, inside; if it arrives, the covered side is below it. */
static void judge_walk(sunder_i_graph *g, uint32_t walk, uint32_t least)
{
    const uint32_t first = sunder_i_first_ray(g, least);
    sunder_i_ray lowest = UINT32_MAX;
    for (uint32_t i = first; i < g->ray_end[least]; i++) {
        const sunder_i_ray r = g->ray[i];
        if (g->walk[r >> 1] != walk) continue;
        if (lowest == UINT32_MAX || sunder_i_ray_height(g, r) < sunder_i_ray_height(g, lowest)) lowest = r;
    }
    g->walk_start[walk] = lowest >> 1;
    g->walk_outer[walk] = !(lowest & 1);
}

static bool make_walks(sunder_i_graph *g)
{
    g->walk = sunder_i_alloc(g->edges, sizeof *g->walk);
    g->walk_start = sunder_i_alloc(g->edges, sizeof *g->walk_start);
    g->walk_outer = sunder_i_alloc(g->edges, sizeof *g->walk_outer);
    g->walk_plain = sunder_i_alloc(g->edges, sizeof *g->walk_plain);
    if (!g->walk || !g->walk_start || !g->walk_outer || !g->walk_plain) return false;
    memset(g->walk, 0xff, g->edges * sizeof *g->walk);
    for (uint32_t start = 0; start < g->edges; start++) {
        if (g->walk[start] != UINT32_MAX) continue;
        judge_walk(g, g->walks, number_walk(g, g->walks, start));
        g->walks++;
    }
    return true;
}

bool sunder_i_graph_build(sunder_i_graph *graph, const sunder_i_coverage *coverage)
{
    return make_edges(graph, coverage) && make_rays(graph) && make_walks(graph) && sunder_i_graph_assign_holes(graph);
}

void sunder_i_graph_free(sunder_i_graph *graph)
{
    sunder_i_free_all(graph->edge, graph->ray_end, graph->ray, graph->walk, graph->walk_start, graph->walk_outer,
                      graph->walk_plain, graph->component);
}
