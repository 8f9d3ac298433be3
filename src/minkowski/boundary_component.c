/* Which hole walks belong to which outer walk. */
#include "minkowski/boundary_graph.h"

#include <math.h>

typedef struct outer {
    uint32_t walk;
    double low[2], high[2], area; /* approximate; the box is widened by the error of the coordinates */
} outer;

static double margin(double v) { return fabs(v) * 0x1p-48 + 0x1p-900; }

static outer measure(const sunder_i_graph *g, uint32_t walk)
{
    outer o = {walk, {INFINITY, INFINITY}, {-INFINITY, -INFINITY}, 0};
    const uint32_t start = g->walk_start[walk];
    const sunder_i_hpoint *base = &g->vertex[g->edge[start].from];
    uint32_t e = start;
    do {
        const sunder_i_hpoint *a = &g->vertex[g->edge[e].from], *b = &g->vertex[g->edge[e].to];
        const double c[2] = {a->ax, a->ay};
        for (int k = 0; k < 2; k++) {
            o.low[k] = fmin(o.low[k], c[k] - margin(c[k]));
            o.high[k] = fmax(o.high[k], c[k] + margin(c[k]));
        }
        o.area += (a->ax - base->ax) * (b->ay - base->ay) - (a->ay - base->ay) * (b->ax - base->ax);
        e = sunder_i_graph_next_covered(g, e);
    } while (e != start);
    return o;
}

/* Is the place just left of vertex v inside the outer walk? Counts the edges that a ray from there to the left crosses. The
 * wedge at v around the direction to the left holds no edge: v is the smallest vertex of a hole walk, whose covered side is there. */
static bool left_is_inside(const sunder_i_graph *g, const outer *o, uint32_t v)
{
    const sunder_i_hpoint *place = &g->vertex[v];
    if (place->ax < o->low[0] || place->ax > o->high[0] || place->ay < o->low[1] || place->ay > o->high[1]) return false;
    bool inside = false;
    const uint32_t start = g->walk_start[o->walk];
    uint32_t e = start;
    do {
        const sunder_i_edge *edge = &g->edge[e];
        const bool from_above = sunder_i_hpoint_cmp_y(g->lattice, &g->vertex[edge->from], place) > 0;
        const bool to_above = sunder_i_hpoint_cmp_y(g->lattice, &g->vertex[edge->to], place) > 0;
        if (from_above != to_above) {
            /* Lines run with angles in [0, pi), so this one runs upwards: it is crossed to the left of v where v is right of it. */
            const sunder_i_line *line = &g->lines->line[edge->line];
            if (sunder_i_orient_hpoint(g->lattice, line->a, line->b, place) < 0) inside = !inside;
        }
        e = sunder_i_graph_next_covered(g, e);
    } while (e != start);
    return inside;
}

/* Outer walks that hold one place are nested, each inside a hole of the one around it. The innermost is the one that holds the
 * fewest others' smallest vertices; areas tell in practice, and nested walks with areas too close for doubles are told apart by
 * the order of their smallest vertices: an inner one never starts before an outer one. */
static bool inner_of(const sunder_i_graph *g, const outer *a, const outer *b)
{
    const double slack = 0x1p-40 * (a->area + b->area);
    if (a->area < b->area - slack) return true;
    if (b->area < a->area - slack) return false;
    return sunder_i_hpoint_cmp(g->lattice, &g->vertex[g->edge[g->walk_start[a->walk]].from],
                               &g->vertex[g->edge[g->walk_start[b->walk]].from]) > 0;
}

static uint32_t owner_of(const sunder_i_graph *g, const outer *outers, uint32_t n, uint32_t walk)
{
    /* judge_walk() left the walk's start as the edge of the lowest ray at its smallest vertex; of a hole it arrives there. */
    const uint32_t v = g->edge[g->walk_start[walk]].to;
    uint32_t best = UINT32_MAX;
    for (uint32_t i = 0; i < n; i++)
        if (left_is_inside(g, &outers[i], v) && (best == UINT32_MAX || inner_of(g, &outers[i], &outers[best]))) best = i;
    return best == UINT32_MAX ? 0 : best;
}

bool sunder_i_graph_components(sunder_i_graph *graph)
{
    graph->component = sunder_i_alloc(graph->walks, sizeof *graph->component);
    if (!graph->component) return false;
    uint32_t n = 0;
    for (uint32_t w = 0; w < graph->walks; w++) n += graph->walk_outer[w];
    graph->components = n;
    outer *outers = sunder_i_alloc(n, sizeof *outers);
    if (!outers) return false;
    n = 0;
    for (uint32_t w = 0; w < graph->walks; w++)
        if (graph->walk_outer[w]) {
            if (graph->components > 1) outers[n] = measure(graph, w);
            graph->component[w] = n++;
        }
    for (uint32_t w = 0; w < graph->walks; w++)
        if (!graph->walk_outer[w]) graph->component[w] = n == 1 ? 0 : owner_of(graph, outers, n, w);
    sunder_i_free(outers);
    return !graph->lattice->arena.failed;
}
