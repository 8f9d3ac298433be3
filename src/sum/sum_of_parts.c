/* sum_of_parts.c: joins disjoint sums to one sum: their rings, segments and points are sorted together. */
#include "sum/sum_of_parts.h"

#include "base/invariant.h"
#include "base/watch.h"
#include "sum/canonical_sum.h"

typedef struct gathering {
    sunder_sum *out;
    uint32_t *vertex;
    sunder_i_found_ring *ring;
    uint32_t *segment, *point;
    size_t polygons, rings, corners, segments, points, vertices;
} gathering;

static size_t corners_of(const sunder_sum *s) { return s->rings ? s->ring_end[s->rings - 1] : 0; }

static bool make_room(gathering *g, sunder_sum *const *part, size_t n)
{
    size_t rings = 0, corners = 0, segments = 0, points = 0, vertices = 0, polygons = 0;
    for (size_t i = 0; i < n; i++) {
        polygons += part[i]->polygons;
        rings += part[i]->rings;
        corners += corners_of(part[i]);
        segments += part[i]->segments;
        points += part[i]->points;
        vertices += part[i]->vertices;
    }
    if (vertices > UINT32_MAX || polygons > UINT32_MAX) return sunder_i_too_many();
    g->vertex = sunder_i_alloc(corners, sizeof *g->vertex);
    g->ring = sunder_i_alloc(rings, sizeof *g->ring);
    g->segment = sunder_i_alloc(2 * segments, sizeof *g->segment);
    g->point = sunder_i_alloc(points, sizeof *g->point);
    g->out->vertex = sunder_i_alloc(vertices, sizeof *g->out->vertex);
    return g->vertex && g->ring && g->segment && g->point && g->out->vertex;
}

static bool copy_vertices(sunder_sum *out, sunder_i_arena *arena, const sunder_sum *s)
{
    for (uint32_t v = 0; v < s->vertices; v++) {
        if (s->vertex[v].w != 0) { /* native numbers are the same on all lattices with one unit */
            out->vertex[out->vertices++] = s->vertex[v];
            continue;
        }
        const sunder_i_mark mark = sunder_i_arena_mark(arena);
        const sunder_i_rational_point at = sunder_i_hpoint_read(arena, &s->lattice, &s->vertex[v]);
        if (arena->failed) return false;
        out->vertex[out->vertices++] = sunder_i_hpoint_make(&out->lattice, at);
        sunder_i_arena_release(arena, mark);
    }
    return !out->lattice.arena.failed;
}

/* Appends the rings, segments and points of a part; its vertices are numbered from `first` on. */
static void add_part(gathering *g, const sunder_sum *s, uint32_t first)
{
    const size_t corners = corners_of(s), before = g->corners;
    for (size_t i = 0; i < corners; i++) g->vertex[g->corners++] = first + s->ring_vertex[i];
    for (size_t p = 0, r = 0; p < s->polygons; p++, g->polygons++)
        for (const size_t outer = r; r < s->poly_end[p]; r++)
            g->ring[g->rings++] = (sunder_i_found_ring){before + (r ? s->ring_end[r - 1] : 0), before + s->ring_end[r],
                                                        (uint32_t)g->polygons, r == outer};
    for (size_t i = 0; i < 2 * s->segments; i++) g->segment[2 * g->segments + i] = first + s->segment[i];
    g->segments += s->segments;
    for (size_t i = 0; i < s->points; i++) g->point[g->points++] = first + s->point[i];
}

static bool put_in_order(gathering *g)
{
    sunder_i_found found = {.vertex = g->vertex,
                            .ring = g->ring,
                            .rings = g->rings,
                            .components = (uint32_t)g->polygons,
                            .segment = g->segment,
                            .segments = g->segments,
                            .point = g->point,
                            .points = g->points,
                            .compare = sunder_i_sum_vertex_cmp,
                            .context = g->out,
                            .place = g->out->vertex};
    return sunder_i_canonical(&found, g->out) && !g->out->lattice.arena.failed;
}

bool sunder_i_gather(sunder_sum *const *part, size_t n, sunder_sum *out)
{
    gathering g = {.out = out};
    sunder_i_arena arena = {0};
    bool ok = make_room(&g, part, n);
    for (size_t i = 0; ok && i < n; i++) {
        const uint32_t first = out->vertices;
        ok = copy_vertices(out, &arena, part[i]);
        if (ok) add_part(&g, part[i], first);
    }
    ok = ok && put_in_order(&g);
    SUNDER_I_ASSERT(!ok || !sunder_i_canonical_check(out));
    sunder_i_arena_free(&arena);
    sunder_i_free_all(g.vertex, g.ring, g.segment, g.point);
    return ok;
}
