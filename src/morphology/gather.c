/* Sums of islands as one sum, in canonical form: polygons in the order of their outer rings, segments and points in
 * lexicographic order. The lattices have one unit. */
#include "morphology/morphology.h"

#include "base/sort.h"
#include "base/watch.h"

/* Where something of a part is found. */
typedef struct source {
    uint32_t part, index;
} source;

typedef struct gathering {
    sunder_sum *const *part;
    sunder_sum *out;
    uint32_t *first; /* [n] the number in `out` of vertex 0 of each part */
    source *polygon, *segment, *point;
    size_t n, polygons, segments, points, rings, sides, vertices;
} gathering;

static void measure(gathering *g)
{
    for (size_t i = 0; i < g->n; i++) {
        const sunder_sum *s = g->part[i];
        g->polygons += s->polygons;
        g->segments += s->segments;
        g->points += s->points;
        g->rings += s->rings;
        g->sides += s->rings ? s->ring_end[s->rings - 1] : 0;
        g->vertices += s->vertices;
    }
}

static bool make_room(gathering *g)
{
    sunder_sum *out = g->out;
    if (g->vertices > UINT32_MAX) return sunder_i_too_many();
    g->first = sunder_i_alloc(g->n, sizeof *g->first);
    g->polygon = sunder_i_alloc(g->polygons, sizeof *g->polygon);
    g->segment = sunder_i_alloc(g->segments, sizeof *g->segment);
    g->point = sunder_i_alloc(g->points, sizeof *g->point);
    out->vertex = sunder_i_alloc(g->vertices, sizeof *out->vertex);
    out->ring_vertex = sunder_i_alloc(g->sides, sizeof *out->ring_vertex);
    out->ring_end = sunder_i_alloc(g->rings, sizeof *out->ring_end);
    out->poly_end = sunder_i_alloc(g->polygons, sizeof *out->poly_end);
    out->segment = sunder_i_alloc(2 * g->segments, sizeof *out->segment);
    out->point = sunder_i_alloc(g->points, sizeof *out->point);
    return g->first && g->polygon && g->segment && g->point && out->vertex &&
           out->ring_vertex && out->ring_end && out->poly_end && out->segment && out->point;
}

/* Vertices of all parts, and what there is to put in order. */
static bool read_parts(gathering *g)
{
    size_t polygons = 0, segments = 0, points = 0;
    sunder_i_arena arena = {0};
    for (size_t i = 0; i < g->n; i++) {
        const sunder_sum *s = g->part[i];
        g->first[i] = g->out->vertices;
        for (uint32_t v = 0; v < s->vertices; v++) {
            const sunder_i_mark mark = sunder_i_arena_mark(&arena);
            const sunder_i_rational_point at = sunder_i_hpoint_read(&arena, &s->lattice, &s->vertex[v]);
            if (arena.failed) break;
            g->out->vertex[g->out->vertices++] = sunder_i_hpoint_make(&g->out->lattice, at);
            sunder_i_arena_release(&arena, mark);
        }
        for (size_t k = 0; k < s->polygons; k++) g->polygon[polygons++] = (source){(uint32_t)i, (uint32_t)k};
        for (size_t k = 0; k < s->segments; k++) g->segment[segments++] = (source){(uint32_t)i, (uint32_t)k};
        for (size_t k = 0; k < s->points; k++) g->point[points++] = (source){(uint32_t)i, (uint32_t)k};
    }
    const bool ok = !arena.failed && !g->out->lattice.arena.failed;
    sunder_i_arena_free(&arena);
    return ok;
}

/* ---- Order ---- */

static int compare_runs(const gathering *g, source a, const uint32_t *va, size_t na, source b, const uint32_t *vb,
                        size_t nb)
{
    sunder_sum *out = g->out;
    for (size_t i = 0; i < na && i < nb; i++) {
        const int c = sunder_i_hpoint_cmp(&out->lattice, &out->vertex[g->first[a.part] + va[i]],
                                          &out->vertex[g->first[b.part] + vb[i]]);
        if (c) return c;
    }
    return (na > nb) - (na < nb);
}

static int compare_polygons(void *context, uint32_t i, uint32_t j)
{
    const gathering *g = context;
    const source a = g->polygon[i], b = g->polygon[j];
    size_t na, nb;
    const uint32_t *va = sunder_sum_ring(g->part[a.part], a.index, 0, &na);
    const uint32_t *vb = sunder_sum_ring(g->part[b.part], b.index, 0, &nb);
    return compare_runs(g, a, va, na, b, vb, nb);
}

static int compare_segments(void *context, uint32_t i, uint32_t j)
{
    const gathering *g = context;
    const source a = g->segment[i], b = g->segment[j];
    return compare_runs(g, a, g->part[a.part]->segment + 2 * (size_t)a.index, 2, b,
                        g->part[b.part]->segment + 2 * (size_t)b.index, 2);
}

static int compare_points(void *context, uint32_t i, uint32_t j)
{
    const gathering *g = context;
    const source a = g->point[i], b = g->point[j];
    return compare_runs(g, a, g->part[a.part]->point + a.index, 1, b, g->part[b.part]->point + b.index, 1);
}

static uint32_t *sorted(gathering *g, size_t n, int (*compare)(void *, uint32_t, uint32_t))
{
    uint32_t *order = sunder_i_alloc(n, sizeof *order);
    for (size_t i = 0; order && i < n; i++) order[i] = (uint32_t)i;
    if (order && sunder_i_sort_indices(order, n, compare, g)) return order;
    sunder_i_free(order);
    return NULL;
}

/* ---- In that order ---- */

static void copy_polygon(const gathering *g, source from)
{
    sunder_sum *out = g->out;
    const sunder_sum *s = g->part[from.part];
    size_t at = out->rings ? out->ring_end[out->rings - 1] : 0;
    for (size_t r = 0; r < sunder_sum_rings(s, from.index); r++) {
        size_t n;
        const uint32_t *ring = sunder_sum_ring(s, from.index, r, &n);
        for (size_t i = 0; i < n; i++) out->ring_vertex[at++] = g->first[from.part] + ring[i];
        out->ring_end[out->rings++] = at;
    }
    out->poly_end[out->polygons++] = out->rings;
}

static bool copy(gathering *g)
{
    sunder_sum *out = g->out;
    uint32_t *polygon = sorted(g, g->polygons, compare_polygons), *segment = sorted(g, g->segments, compare_segments);
    uint32_t *point = sorted(g, g->points, compare_points);
    const bool ok = polygon && segment && point;
    for (size_t i = 0; ok && i < g->polygons; i++) copy_polygon(g, g->polygon[polygon[i]]);
    for (size_t i = 0; ok && i < g->segments; i++) {
        const source from = g->segment[segment[i]];
        for (size_t k = 0; k < 2; k++)
            out->segment[2 * i + k] = g->first[from.part] + g->part[from.part]->segment[2 * (size_t)from.index + k];
    }
    for (size_t i = 0; ok && i < g->points; i++) {
        const source from = g->point[point[i]];
        out->point[i] = g->first[from.part] + g->part[from.part]->point[from.index];
    }
    out->segments = ok ? g->segments : 0;
    out->points = ok ? g->points : 0;
    sunder_i_free(polygon);
    sunder_i_free(segment);
    sunder_i_free(point);
    return ok;
}

bool sunder_i_gather(sunder_sum *const *part, size_t n, sunder_sum *out)
{
    gathering g = {.part = part, .n = n, .out = out};
    measure(&g);
    const bool ok = make_room(&g) && read_parts(&g) && copy(&g) && !out->lattice.arena.failed;
    sunder_i_free(g.first);
    sunder_i_free(g.polygon);
    sunder_i_free(g.segment);
    sunder_i_free(g.point);
    return ok;
}
