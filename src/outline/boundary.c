/* boundary.c: see boundary.h. Rings are traced in the graph of boundary edges, without straight vertices; degenerate
 * segments are stretches covered on both sides, and degenerate points are vertices that no stretch touches. */
#include "outline/boundary.h"

#include "outline/boundary_graph.h"
#include "sum/canonical_sum.h"

/* The rings and degenerate parts before they are sorted. */
typedef struct tracer {
    const sunder_i_graph *g;
    sunder_sum *out;  /* its vertices are set already */
    uint32_t *vertex; /* the vertices of all rings, one ring after the other, each from its smallest vertex on */
    sunder_i_found_ring *ring;
    size_t rings;
    bool *done; /* [edges] */
    uint32_t *segment, *point;
    size_t segments, points;
} tracer;

/* Returns whether edge f continues edge e in the same direction. */
static bool is_straight(const sunder_i_graph *g, uint32_t e, uint32_t f)
{
    return g->edge[e].line == g->edge[f].line && g->edge[e].rank == g->edge[f].rank;
}

/* Returns the edge of the ring through `start` that leaves its smallest vertex. *outer becomes whether the ring is
 * counterclockwise: at that vertex both edges point to the right, and the leaving one is the lower one exactly if the
 * ring is counterclockwise. */
static uint32_t first_edge(const sunder_i_graph *g, uint32_t start, bool *outer)
{
    const uint32_t walk = g->walk[start];
    if (g->walk_plain[walk]) {
        const uint32_t lowest = g->walk_start[walk]; /* of a hole it arrives at that vertex */
        *outer = g->walk_outer[walk];
        return *outer ? lowest : sunder_i_graph_next_free(g, lowest);
    }
    uint32_t best = start, before = start, previous = start;
    for (uint32_t e = sunder_i_graph_next_free(g, start);; e = sunder_i_graph_next_free(g, e)) {
        if (e == start) {
            if (best == start) before = previous;
            break;
        }
        if (sunder_i_is_before(g, g->edge[e].from, g->edge[best].from)) {
            best = e;
            before = previous;
        }
        previous = e;
    }
    *outer = sunder_i_ray_height(g, 2 * best) < sunder_i_ray_height(g, 2 * before + 1);
    return best;
}

static void trace_ring(tracer *t, uint32_t start)
{
    const sunder_i_graph *g = t->g;
    size_t at = t->rings ? t->ring[t->rings - 1].end : 0;
    sunder_i_found_ring *ring = &t->ring[t->rings++];
    const uint32_t first = first_edge(g, start, &ring->outer);
    ring->start = at;
    ring->component = g->component[g->walk[first]];
    t->vertex[at++] = g->edge[first].from;
    for (uint32_t e = first;;) {
        t->done[e] = true;
        const uint32_t f = sunder_i_graph_next_free(g, e);
        if (f == first) break;
        if (!is_straight(g, e, f)) t->vertex[at++] = g->edge[f].from;
        e = f;
    }
    ring->end = at;
}

static bool trace_rings(tracer *t)
{
    const size_t n = t->g->edges;
    t->vertex = sunder_i_alloc(n, sizeof *t->vertex);
    t->ring = sunder_i_alloc(n, sizeof *t->ring);
    t->done = sunder_i_calloc(n, sizeof *t->done);
    if (!t->vertex || !t->ring || !t->done) return false;
    for (uint32_t e = 0; e < n; e++)
        if (!t->done[e]) trace_ring(t, e);
    return true;
}

/* ---- Degenerate holes ---- */

/* Joins consecutive stretches on one line with both sides covered to degenerate segments. Returns false if out of
 * memory. */
static bool gather_segments(tracer *t, const sunder_i_coverage *c)
{
    const uint8_t both = SUNDER_I_BANK_LEFT | SUNDER_I_BANK_RIGHT;
    size_t n = 0;
    for (size_t i = 0; i < c->stretches; i++) n += c->stretch[i].banks == both;
    t->segment = sunder_i_alloc(2 * n, sizeof *t->segment);
    for (size_t i = 0, j; t->segment && i < c->stretches; i = j + 1) {
        j = i;
        if (c->stretch[i].banks != both) continue;
        while (j + 1 < c->stretches && c->stretch[j + 1].banks == both &&
               c->stretch[j + 1].line == c->stretch[i].line && c->stretch[j + 1].from == c->stretch[j].to)
            j++;
        const uint32_t a = c->stretch[i].from, b = c->stretch[j].to;
        const bool rises = sunder_i_sum_vertex_cmp(t->out, a, b) < 0;
        t->segment[2 * t->segments] = rises ? a : b;
        t->segment[2 * t->segments++ + 1] = rises ? b : a;
    }
    return t->segment != NULL;
}

/* Lists the vertices that no stretch touches. Returns false if out of memory. */
static bool gather_points(tracer *t, const sunder_i_coverage *c)
{
    bool *touched = sunder_i_calloc(t->g->vertices, sizeof *touched);
    size_t n = 0;
    for (size_t i = 0; touched && i < c->stretches; i++) touched[c->stretch[i].from] = touched[c->stretch[i].to] = true;
    for (uint32_t v = 0; touched && v < t->g->vertices; v++) n += !touched[v];
    t->point = touched ? sunder_i_alloc(n, sizeof *t->point) : NULL;
    for (uint32_t v = 0; t->point && v < t->g->vertices; v++)
        if (!touched[v]) t->point[t->points++] = v;
    sunder_i_free(touched);
    return t->point != NULL;
}

static bool trace_outline(const sunder_i_graph *g, const sunder_i_coverage *coverage, sunder_sum *out)
{
    tracer t = {.g = g, .out = out};
    bool ok = trace_rings(&t) && gather_segments(&t, coverage) && gather_points(&t, coverage);
    sunder_i_found found = {.vertex = t.vertex,
                            .ring = t.ring,
                            .rings = t.rings,
                            .components = g->components,
                            .segment = t.segment,
                            .segments = t.segments,
                            .point = t.point,
                            .points = t.points,
                            .compare = sunder_i_sum_vertex_cmp,
                            .context = out,
                            .place = g->vertex,
                            .sorted = g->sorted};
    ok = ok && sunder_i_canonical(&found, out);
    sunder_i_free_all(t.vertex, t.ring, t.done, t.segment, t.point);
    return ok;
}

sunder_status sunder_i_boundary_build(sunder_i_lattice *lattice, uint32_t classes, const sunder_i_lines *lines,
                                      sunder_i_coverage *coverage, sunder_sum *out, sunder_error *err)
{
    out->vertex = coverage->vertices.point;
    out->vertices = (uint32_t)coverage->vertices.n;
    coverage->vertices.point = NULL;
    sunder_i_graph g = {.lattice = lattice,
                        .lines = lines,
                        .vertex = out->vertex,
                        .classes = classes,
                        .vertices = out->vertices,
                        .sorted = coverage->sorted};
    const bool ok = sunder_i_graph_build(&g, coverage) && trace_outline(&g, coverage, out);
    sunder_i_graph_free(&g);
    return ok && !lattice->arena.failed ? SUNDER_OK : sunder_i_failure_cause(err);
}
