/* Which hole walks belong to which outer walk. */
#include "minkowski/boundary_graph.h"

#include <math.h>

typedef struct outer {
    uint32_t walk;
    double low[2], high[2]; /* approximate, widened by the error of the coordinates */
} outer;

static double margin(double v) { return fabs(v) * 0x1p-48 + 0x1p-900; }

static outer measure(const sunder_i_graph *g, uint32_t walk)
{
    outer o = {walk, {INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    const uint32_t start = g->walk_start[walk];
    uint32_t e = start;
    do {
        const sunder_i_hpoint *a = &g->vertex[g->edge[e].from];
        const double c[2] = {a->ax, a->ay};
        for (int k = 0; k < 2; k++) {
            o.low[k] = fmin(o.low[k], c[k] - margin(c[k]));
            o.high[k] = fmax(o.high[k], c[k] + margin(c[k]));
        }
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

/* Of two outer walks that hold one place, is a the inner one? Components are disjoint, so what the two enclose is nested, and the
 * inner walk has no vertex before the smallest one of the outer walk. Where both start in one vertex, the outer walk's lowest
 * ray is below everything that it encloses there; no two walks share an edge, so the two rays differ. (Areas would need exact
 * numbers: those of long slanted shapes are lost in doubles.) */
static bool inner_of(const sunder_i_graph *g, const outer *a, const outer *b)
{
    const uint32_t ea = g->walk_start[a->walk], eb = g->walk_start[b->walk]; /* of outer walks they leave */
    const uint32_t va = g->edge[ea].from, vb = g->edge[eb].from;
    if (va != vb) return sunder_i_hpoint_cmp(g->lattice, &g->vertex[va], &g->vertex[vb]) > 0;
    return sunder_i_ray_height(g, 2 * ea) > sunder_i_ray_height(g, 2 * eb);
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
