#include "outline/boundary.h"

#include "outline/boundary_graph.h"
#include "base/sort.h"

#include <string.h>

/* Rings as traced, before they are put in order. */
typedef struct tracer {
    const sunder_i_graph *g;
    uint32_t *vertex; /* of all rings, one after the other, smallest vertex first */
    uint32_t *start, *end; /* [rings] */
    uint32_t *component;
    bool *outer;
    uint32_t rings;
    bool *done; /* [edges] */
} tracer;

/* Does the boundary go straight on from edge e to edge f? */
static bool straight(const sunder_i_graph *g, uint32_t e, uint32_t f)
{
    return g->edge[e].line == g->edge[f].line && g->edge[e].rank == g->edge[f].rank;
}

/* The edge of the ring through `start` that leaves its smallest vertex; *outer tells the ring's orientation: at that
 * vertex both rays point right, and the leaving one is the lower of a counter-clockwise ring. */
static uint32_t first_edge(const sunder_i_graph *g, uint32_t start, bool *outer)
{
    uint32_t best = start, before = start, previous = start;
    for (uint32_t e = sunder_i_graph_next_free(g, start);; e = sunder_i_graph_next_free(g, e)) {
        if (e == start) {
            if (best == start) before = previous;
            break;
        }
        const uint32_t v = g->edge[e].from, w = g->edge[best].from;
        if (v != w && sunder_i_hpoint_cmp(g->lattice, &g->vertex[v], &g->vertex[w]) < 0) {
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
    const uint32_t ring = t->rings++, first = first_edge(g, start, &t->outer[ring]);
    uint32_t at = ring ? t->end[ring - 1] : 0, e = first;
    t->start[ring] = at;
    t->component[ring] = g->component[g->walk[first]];
    t->vertex[at++] = g->edge[first].from;
    for (;;) {
        t->done[e] = true;
        const uint32_t f = sunder_i_graph_next_free(g, e);
        if (f == first) break;
        if (!straight(g, e, f)) t->vertex[at++] = g->edge[f].from;
        e = f;
    }
    t->end[ring] = at;
}

/* Lexicographic order of the vertex sequences of two rings. */
static int compare_rings(void *context, uint32_t a, uint32_t b)
{
    const tracer *t = context;
    const uint32_t m = t->end[a] - t->start[a], n = t->end[b] - t->start[b];
    for (uint32_t i = 0; i < m && i < n; i++) {
        const uint32_t u = t->vertex[t->start[a] + i], v = t->vertex[t->start[b] + i];
        if (u == v) continue;
        const int c = sunder_i_hpoint_cmp(t->g->lattice, &t->g->vertex[u], &t->g->vertex[v]);
        if (c) return c;
    }
    return (m > n) - (m < n);
}

/* Outer rings in order, each followed by its holes in order. */
static bool arrange(tracer *t, sunder_sum *out)
{
    const uint32_t n = t->rings, components = t->g->components;
    uint32_t *order = sunder_i_alloc(n, sizeof *order), *head = sunder_i_calloc(components, sizeof *head);
    uint32_t *place = sunder_i_alloc(n, sizeof *place), *holes = sunder_i_calloc((size_t)components + 1, sizeof *holes);
    out->ring_vertex = sunder_i_alloc(n ? t->end[n - 1] : 0, sizeof *out->ring_vertex);
    out->ring_end = sunder_i_alloc(n, sizeof *out->ring_end);
    out->poly_end = sunder_i_alloc(components, sizeof *out->poly_end);
    bool ok = order && head && place && holes && out->ring_vertex && out->ring_end && out->poly_end;
    for (uint32_t r = 0; ok && r < n; r++) order[r] = r;
    ok = ok && sunder_i_sort_indices(order, n, compare_rings, t);
    if (ok) {
        /* Outer rings take the polygons in order; then every ring, in order, the next place in its polygon. */
        for (uint32_t i = 0; i < n; i++)
            if (t->outer[order[i]]) head[t->component[order[i]]] = (uint32_t)out->polygons++;
        for (uint32_t r = 0; r < n; r++) holes[head[t->component[r]]]++;
        size_t sum = 0;
        for (size_t p = 0; p < out->polygons; p++) {
            const uint32_t rings = holes[p];
            holes[p] = (uint32_t)sum + 1; /* the place of its next hole, after the outer ring */
            sum += rings;
            out->poly_end[p] = sum;
        }
        for (uint32_t i = 0; i < n; i++) {
            const uint32_t r = order[i], p = head[t->component[r]];
            place[t->outer[r] ? (p ? out->poly_end[p - 1] : 0) : holes[p]++] = r;
        }
        size_t at = 0;
        for (uint32_t i = 0; i < n; i++) {
            const uint32_t r = place[i], length = t->end[r] - t->start[r];
            memcpy(out->ring_vertex + at, t->vertex + t->start[r], length * sizeof *t->vertex);
            at += length;
            out->ring_end[i] = at;
        }
        out->rings = n;
    }
    sunder_i_free(order);
    sunder_i_free(head);
    sunder_i_free(place);
    sunder_i_free(holes);
    return ok;
}

static bool trace_rings(const sunder_i_graph *g, sunder_sum *out)
{
    const size_t n = g->edges;
    tracer t = {g, sunder_i_alloc(n, sizeof *t.vertex), sunder_i_alloc(n, sizeof *t.start),
                sunder_i_alloc(n, sizeof *t.end), sunder_i_alloc(n, sizeof *t.component),
                sunder_i_alloc(n, sizeof *t.outer), 0, sunder_i_calloc(n, sizeof *t.done)};
    bool ok = t.vertex && t.start && t.end && t.component && t.outer && t.done;
    for (uint32_t e = 0; ok && e < n; e++)
        if (!t.done[e]) trace_ring(&t, e);
    ok = ok && arrange(&t, out);
    sunder_i_free(t.vertex);
    sunder_i_free(t.start);
    sunder_i_free(t.end);
    sunder_i_free(t.component);
    sunder_i_free(t.outer);
    sunder_i_free(t.done);
    return ok;
}

/* ---- Degenerate holes ---- */

typedef struct degenerates {
    sunder_i_lattice *lattice;
    const sunder_i_hpoint *vertex;
    const uint32_t *end; /* pairs */
} degenerates;

static int compare_segments(void *context, uint32_t a, uint32_t b)
{
    const degenerates *d = context;
    for (int k = 0; k < 2; k++) {
        const uint32_t u = d->end[2 * a + (uint32_t)k], v = d->end[2 * b + (uint32_t)k];
        const int c = u == v ? 0 : sunder_i_hpoint_cmp(d->lattice, &d->vertex[u], &d->vertex[v]);
        if (c) return c;
    }
    return 0;
}

static int compare_points(void *context, uint32_t a, uint32_t b)
{
    const degenerates *d = context;
    return a == b ? 0 : sunder_i_hpoint_cmp(d->lattice, &d->vertex[a], &d->vertex[b]);
}

/* Pieces with both banks covered, joined where one goes on in the next on its line. */
static bool gather_segments(const sunder_i_coverage *c, degenerates *d, sunder_sum *out)
{
    const uint8_t both = SUNDER_I_LEFT | SUNDER_I_RIGHT;
    size_t n = 0;
    for (size_t i = 0; i < c->pieces; i++) n += c->piece[i].banks == both;
    uint32_t *end = sunder_i_alloc(2 * n, sizeof *end), *order = sunder_i_alloc(n, sizeof *order);
    out->segment = sunder_i_alloc(2 * n, sizeof *out->segment);
    bool ok = end && order && out->segment;
    n = 0;
    for (size_t i = 0; ok && i < c->pieces; i++) {
        if (c->piece[i].banks != both) continue;
        size_t j = i;
        while (j + 1 < c->pieces && c->piece[j + 1].banks == both && c->piece[j + 1].line == c->piece[i].line &&
               c->piece[j + 1].from == c->piece[j].to)
            j++;
        uint32_t a = c->piece[i].from, b = c->piece[j].to;
        if (compare_points(d, a, b) > 0) {
            const uint32_t t = a;
            a = b;
            b = t;
        }
        end[2 * n] = a;
        end[2 * n + 1] = b;
        order[n] = (uint32_t)n;
        n++;
        i = j;
    }
    d->end = end;
    ok = ok && sunder_i_sort_indices(order, n, compare_segments, d);
    for (size_t i = 0; ok && i < n; i++) memcpy(out->segment + 2 * i, end + 2 * order[i], 2 * sizeof *end);
    out->segments = n;
    sunder_i_free(end);
    sunder_i_free(order);
    return ok;
}

/* Places that no piece touches. */
static bool gather_points(const sunder_i_coverage *c, degenerates *d, sunder_sum *out)
{
    bool *touched = sunder_i_calloc(out->vertices, sizeof *touched);
    if (!touched) return false;
    for (size_t i = 0; i < c->pieces; i++) touched[c->piece[i].from] = touched[c->piece[i].to] = true;
    for (uint32_t v = 0; v < out->vertices; v++) out->points += !touched[v];
    out->point = sunder_i_alloc(out->points, sizeof *out->point);
    size_t n = 0;
    for (uint32_t v = 0; out->point && v < out->vertices; v++)
        if (!touched[v]) out->point[n++] = v;
    sunder_i_free(touched);
    return out->point && sunder_i_sort_indices(out->point, out->points, compare_points, d);
}

sunder_status sunder_i_boundary_build(const sunder_i_pieces *subsums, const sunder_i_lines *lines,
                                      sunder_i_coverage *coverage, sunder_sum *out, sunder_error *err)
{
    sunder_i_lattice *lattice = subsums->lattice;
    out->vertex = coverage->places.point;
    out->vertices = (uint32_t)coverage->places.n;
    coverage->places.point = NULL;
    sunder_i_graph g = {.lattice = lattice, .lines = lines, .vertex = out->vertex,
                        .classes = subsums->classes, .vertices = out->vertices};
    degenerates d = {lattice, out->vertex, NULL};
    const bool ok = sunder_i_graph_build(&g, coverage) && trace_rings(&g, out) &&
                    gather_segments(coverage, &d, out) && gather_points(coverage, &d, out);
    sunder_i_graph_free(&g);
    return ok && !lattice->arena.failed ? SUNDER_OK : sunder_i_no_memory(err);
}
