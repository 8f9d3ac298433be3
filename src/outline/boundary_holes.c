/* boundary_holes.c: assigns hole walks to outer walks: among the outer walks that a ray from the hole crosses an odd
 * number of times, the innermost one contains the hole. Each outer walk is a component of its own. */
#include "outline/boundary_graph.h"
#include "spatial/strips.h"

#include <math.h>

/* Finds the outer walks that contain a point. */
typedef struct finder {
    const sunder_i_graph *g;
    const uint32_t *walk; /* [components] the outer walk of each component */
    uint32_t *edge;       /* the edges of outer walks, numbered as in the strips */
    sunder_i_strips strips;
    bool *odd;       /* [components] whether the number of crossings is odd; all false between queries */
    uint32_t *holds; /* [edges] the components that were crossed, with repetitions */
} finder;

/* Returns a bound of the error of heights, if y is the largest one. */
static double margin_of_height(double y) { return y * 0x1p-47 + 0x1p-900; }

static bool sort_edges(finder *f)
{
    const sunder_i_graph *g = f->g;
    double(*span)[2] = sunder_i_alloc(g->edges, sizeof *span), most = 0;
    uint32_t n = 0;
    if (!span) return false;
    for (uint32_t v = 0; v < g->vertices; v++)
        if (fabs(g->vertex[v].ay) > most) most = fabs(g->vertex[v].ay);
    for (uint32_t e = 0; e < g->edges; e++) {
        if (!g->walk_outer[g->walk[e]]) continue;
        const double a = g->vertex[g->edge[e].from].ay, b = g->vertex[g->edge[e].to].ay;
        span[n][0] = (a < b ? a : b) - margin_of_height(most);
        span[n][1] = (a < b ? b : a) + margin_of_height(most);
        f->edge[n++] = e;
    }
    const bool ok = sunder_i_strips_build(&f->strips, (const double(*)[2])span, n, g->walks - g->components);
    sunder_i_free(span);
    return ok;
}

/* Sets f->holds to the components of the outer walks that contain the point just left of vertex v; returns their
 * number. It counts the edges that a ray from there to the left crosses. There is no edge in the wedge at v around the
 * direction to the left: v is the smallest vertex of a hole walk, whose covered side is there. */
static uint32_t find_holders(finder *f, uint32_t v)
{
    const sunder_i_graph *g = f->g;
    const sunder_i_hpoint *place = &g->vertex[v];
    size_t from, to;
    uint32_t crossed = 0, n = 0;
    sunder_i_strips_at(&f->strips, place->ay, &from, &to);
    for (; from < to; from++) {
        const uint32_t e = f->edge[f->strips.item[from]], c = g->component[g->walk[e]];
        const sunder_i_boundary_edge *edge = &g->edge[e];
        const bool from_above = sunder_i_hpoint_cmp_y(g->lattice, &g->vertex[edge->from], place) > 0;
        const bool to_above = sunder_i_hpoint_cmp_y(g->lattice, &g->vertex[edge->to], place) > 0;
        /* Lines have angles in [0, pi), so this one points upwards: the ray crosses it if v is on its right. */
        if (from_above == to_above) continue;
        const sunder_i_supporting_line line = sunder_i_lines_get(g->lines, edge->line);
        if (sunder_i_orient_hpoint(g->lattice, line.a, line.b, place) >= 0) continue;
        if (!f->odd[c]) f->holds[crossed++] = c; /* perhaps not for the first time */
        f->odd[c] = !f->odd[c];
    }
    for (uint32_t i = 0; i < crossed; i++) {
        const uint32_t c = f->holds[i];
        if (f->odd[c]) f->holds[n++] = c;
        f->odd[c] = false;
    }
    return n;
}

/* Returns whether a is the inner one of two outer walks that contain one point. Components are disjoint, so that the
 * regions that the two enclose are nested, and the inner walk has no vertex before the smallest one of the outer walk.
 * If both have the same smallest vertex, the outer walk's lowest ray is below everything that it encloses there; no two
 * walks share an edge, so that the two rays differ. (Comparing areas would need exact numbers: those of long slanted
 * shapes are inexact in doubles.) */
static bool inner_of(const finder *f, uint32_t a, uint32_t b)
{
    const sunder_i_graph *g = f->g;
    /* these edges of outer walks leave their vertices */
    const uint32_t ea = g->walk_start[f->walk[a]], eb = g->walk_start[f->walk[b]];
    const uint32_t va = g->edge[ea].from, vb = g->edge[eb].from;
    if (va != vb) return sunder_i_hpoint_cmp(g->lattice, &g->vertex[va], &g->vertex[vb]) > 0;
    return sunder_i_ray_height(g, 2 * ea) > sunder_i_ray_height(g, 2 * eb);
}

static uint32_t owner_of(finder *f, uint32_t walk)
{
    /* judge_walk() has set the start of the walk to the edge of the lowest ray at its smallest vertex; of a hole it
     * arrives there */
    const uint32_t n = find_holders(f, f->g->edge[f->g->walk_start[walk]].to);
    uint32_t best = n ? f->holds[0] : 0;
    for (uint32_t i = 1; i < n; i++)
        if (inner_of(f, f->holds[i], best)) best = f->holds[i];
    return best;
}

static bool find_owners(sunder_i_graph *g, const uint32_t *walk)
{
    finder f = {.g = g,
                .walk = walk,
                .edge = sunder_i_alloc(g->edges, sizeof *f.edge),
                .odd = sunder_i_calloc(g->components, sizeof *f.odd),
                .holds = sunder_i_alloc(g->edges, sizeof *f.holds)};
    const bool ok = f.edge && f.odd && f.holds && sort_edges(&f);
    for (uint32_t w = 0; ok && w < g->walks; w++)
        if (!g->walk_outer[w]) g->component[w] = owner_of(&f, w);
    sunder_i_strips_free(&f.strips);
    sunder_i_free_all(f.edge, f.odd, f.holds);
    return ok;
}

bool sunder_i_graph_assign_holes(sunder_i_graph *graph)
{
    graph->components = 0;
    graph->component = sunder_i_calloc(graph->walks, sizeof *graph->component);
    uint32_t *outer = sunder_i_alloc(graph->walks, sizeof *outer);
    bool ok = graph->component && outer;
    for (uint32_t w = 0; ok && w < graph->walks; w++)
        if (graph->walk_outer[w]) {
            outer[graph->components] = w;
            graph->component[w] = graph->components++;
        }
    if (ok && graph->components > 1 && graph->components < graph->walks) ok = find_owners(graph, outer);
    sunder_i_free(outer);
    return ok && !graph->lattice->arena.failed;
}
