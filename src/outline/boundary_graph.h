/* boundary_graph.h: the directed boundary edges and the order of their ends around each vertex. Used by boundary*.c
 * only. */
#ifndef SUNDER_I_BOUNDARY_GRAPH_H
#define SUNDER_I_BOUNDARY_GRAPH_H

#include "outline/coverage.h"

typedef struct sunder_i_boundary_edge {
    uint32_t from, to; /* vertices; the sum is on the left */
    uint32_t rank, line;
} sunder_i_boundary_edge;

/* An end of an edge at a vertex: 2 * edge, plus 1 if the edge arrives there. */
typedef uint32_t sunder_i_ray;

typedef struct sunder_i_graph {
    sunder_i_lattice *lattice;
    const sunder_i_lines *lines;
    const sunder_i_hpoint *vertex;
    uint32_t classes, vertices;
    bool sorted; /* vertices with edges are numbered lexicographically */
    sunder_i_boundary_edge *edge;
    uint32_t edges;
    uint32_t *ray_end; /* [vertices] the end of the rays of each vertex */
    sunder_i_ray *ray; /* the rays, counterclockwise around each vertex from the positive x axis */
    uint32_t *walk;    /* [edges] the covered walk of each edge */
    uint32_t walks;
    uint32_t *walk_start; /* [walks] an edge that leaves, or arrives at, the walk's lexicographically smallest vertex */
    bool *walk_outer;     /* [walks] whether the walk is the outer boundary of its component */
    bool *walk_plain;     /* [walks] whether no other edges meet the walk's vertices, so that it is a ring by itself */
    uint32_t *component;  /* [walks] the number of the component, from 0 on */
    uint32_t components;
} sunder_i_graph;

static inline uint32_t sunder_i_first_ray(const sunder_i_graph *g, uint32_t v) { return v ? g->ray_end[v - 1] : 0; }

static inline uint32_t sunder_i_ray_rank(const sunder_i_graph *g, sunder_i_ray r)
{
    const uint32_t rank = g->edge[r >> 1].rank;
    if (!(r & 1)) return rank;
    return rank < g->classes ? rank + g->classes : rank - g->classes;
}

/* Returns the position of the ray in the half-turn on the right of a lexicographically smallest vertex, from bottom to
 * top: angles -pi/2 .. pi/2. */
static inline uint32_t sunder_i_ray_height(const sunder_i_graph *g, sunder_i_ray r)
{
    const uint32_t rank = sunder_i_ray_rank(g, r);
    return rank < g->classes ? rank + g->classes : rank - g->classes;
}

/* Returns whether v is lexicographically before w. */
static inline bool sunder_i_is_before(const sunder_i_graph *g, uint32_t v, uint32_t w)
{
    return g->sorted ? v < w : v != w && sunder_i_hpoint_cmp(g->lattice, &g->vertex[v], &g->vertex[w]) < 0;
}

/* Builds edges, rays, covered walks and components. Returns false if out of memory. */
bool sunder_i_graph_build(sunder_i_graph *graph, const sunder_i_coverage *coverage);
/* Numbers the components, one for each outer walk, and assigns each hole walk to the component of the outer walk that
 * contains it (boundary_holes.c). Returns false if out of memory. */
bool sunder_i_graph_assign_holes(sunder_i_graph *graph);
/* Returns the edge that follows `edge` on the ring of its component that has the same free face. */
uint32_t sunder_i_graph_next_free(const sunder_i_graph *graph, uint32_t edge);
void sunder_i_graph_free(sunder_i_graph *graph);

#endif
