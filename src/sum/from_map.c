/* from_map.c: makes the canonical sum from a marked map, which may be a whole arrangement or a clean union.
 *
 * The covered counts classify the edges. An edge with exactly one covered side *bounds* the sum. An edge that no region
 * covers, but with both sides covered, is a *slit*, a piece of a degenerate segment. Slits and covered edges connect
 * the faces on their two sides, so that the components of the interior of the sum are the classes of covered faces that
 * are connected by edges with both sides covered.
 *
 * Rings. There is one for each component C of the interior and each component of the plane minus the closure of C. From
 * the end of a bounding half-edge with C on its left, the ring continues with the next half-edge, counterclockwise,
 * that bounds C: between the two lies one wedge of the plane without C. Where the boundary of C touches itself, the
 * ring turns off at the first of these half-edges, so that rings are simple; the half-edges of other components at the
 * vertex are skipped.
 *
 * Degenerate holes. Slits on one line with common ends are joined to one segment. A degenerate point is a vertex that
 * no region covers and at which every edge is covered.
 *
 * sunder_i_sum_from_cells() does the same for another set of faces than the covered ones (struct sunder_i_inside), for
 * example for the faces between regions.
 *
 * Vertices in the middle of a straight side, or of a segment, are omitted: the map has such vertices at the corners of
 * subsums, at other components and at antennas. */
#include "sum/from_map.h"

#include "base/watch.h"
#include "sum/canonical_sum.h"

#include "base/union_find.h"

#include <string.h>

typedef struct outline {
    sunder_i_planar_map *map;
    const sunder_i_inside *inside; /* the faces of the set; NULL: the covered faces */
    uint32_t *component;           /* [faces] a union-find forest; its roots are the components */
    bool *done;                    /* [half-edges] the half-edge belongs to a ring that was traced */
    uint32_t *vertex;              /* the map's vertices: those of all rings, then the ends of segments, then points */
    size_t vertices, vertex_capacity;
    sunder_i_found_ring *ring;
    size_t rings, ring_capacity;
    size_t ring_end, segment_end; /* the ends of the rings and of the segments in `vertex` */
} outline;

static int compare_vertices(void *context, uint32_t v, uint32_t w)
{
    const outline *o = context;
    return sunder_i_planar_map_vertex_cmp(o->map, v, w);
}

/* ---- Components ---- */

static bool left_inside(const outline *o, uint32_t h)
{
    return o->inside ? o->inside->face[sunder_i_planar_map_face(o->map, h)]
                     : sunder_i_planar_map_left_covered(o->map, h) != 0;
}

static bool connect_faces(outline *o)
{
    const uint32_t faces = sunder_i_planar_map_face_end(o->map);
    o->component = sunder_i_alloc(faces, sizeof *o->component);
    if (!o->component) return false;
    sunder_i_union_init(o->component, faces);
    for (uint32_t e = 0; e < sunder_i_planar_map_edge_end(o->map); e++) {
        if (sunder_i_planar_map_edge_alive(o->map, e) && left_inside(o, 2 * e) && left_inside(o, 2 * e + 1))
            sunder_i_union_join(o->component, sunder_i_planar_map_face(o->map, 2 * e),
                                sunder_i_planar_map_face(o->map, 2 * e + 1));
    }
    return true;
}

static uint32_t component_of(const outline *o, uint32_t h)
{
    return sunder_i_union_find(o->component, sunder_i_planar_map_face(o->map, h));
}

/* ---- Rings ---- */

static bool is_outline(const outline *o, uint32_t h)
{
    return left_inside(o, h) && !left_inside(o, sunder_i_planar_map_twin(h));
}

static uint32_t next_of_ring(const outline *o, uint32_t h, uint32_t component)
{
    uint32_t g = sunder_i_planar_map_twin(h);
    do g = sunder_i_planar_map_ccw(o->map, g);
    while (!is_outline(o, g) || component_of(o, g) != component);
    return g;
}

/* Returns true if the half-edges h and g have the same direction. */
static bool is_straight(sunder_i_planar_map *map, uint32_t h, uint32_t g)
{
    return ((h ^ g) & 1) == 0 && sunder_i_planar_map_turn(map, h >> 1, g >> 1) == 0;
}

static bool push_vertex(outline *o, uint32_t v)
{
    if (o->vertices == UINT32_MAX ||
        !sunder_i_reserve(&o->vertex, &o->vertex_capacity, o->vertices + 1, sizeof *o->vertex))
        return false;
    o->vertex[o->vertices++] = v;
    return true;
}

/* Returns the half-edge that leaves the smallest vertex of the ring through `start`. *outer becomes whether the ring is
 * counterclockwise: both sides at the smallest vertex lead to the right, and it is if the one that leaves is the
 * lower. */
static uint32_t first_of_ring(outline *o, uint32_t start, uint32_t component, bool *outer)
{
    uint32_t least = start, before = start;
    for (uint32_t h = start, g = SUNDER_I_NOWHERE; g != start; h = g) {
        g = next_of_ring(o, h, component);
        const bool smaller = g != start && compare_vertices(o, sunder_i_planar_map_origin(o->map, g),
                                                            sunder_i_planar_map_origin(o->map, least)) < 0;
        if (smaller) least = g;
        if (smaller || (g == start && least == start)) before = h;
    }
    *outer = sunder_i_planar_map_turn(o->map, least >> 1, before >> 1) > 0;
    return least;
}

static bool trace_ring(outline *o, uint32_t start)
{
    if (!sunder_i_reserve(&o->ring, &o->ring_capacity, o->rings + 1, sizeof *o->ring)) return false;
    sunder_i_found_ring *r = &o->ring[o->rings++];
    r->component = component_of(o, start);
    r->start = o->vertices;
    const uint32_t first = first_of_ring(o, start, r->component, &r->outer);
    if (!push_vertex(o, sunder_i_planar_map_origin(o->map, first))) return false;
    for (uint32_t h = first;;) {
        o->done[h] = true;
        const uint32_t g = next_of_ring(o, h, r->component);
        if (g == first) break;
        if (!is_straight(o->map, h, g) && !push_vertex(o, sunder_i_planar_map_origin(o->map, g))) return false;
        h = g;
    }
    r->end = o->vertices;
    return true;
}

static bool trace_rings(outline *o)
{
    const uint32_t halves = 2 * sunder_i_planar_map_edge_end(o->map);
    o->done = sunder_i_calloc(halves, sizeof *o->done);
    if (!o->done || !sunder_i_reserve(&o->vertex, &o->vertex_capacity, 1, sizeof *o->vertex)) return false;
    for (uint32_t h = 0; h < halves; h++)
        if (sunder_i_planar_map_edge_alive(o->map, h >> 1) && is_outline(o, h) && !o->done[h] && !trace_ring(o, h))
            return false;
    return true;
}

/* ---- Degenerate holes ---- */

static bool is_slit(const outline *o, uint32_t e)
{
    return sunder_i_planar_map_edge_alive(o->map, e) && sunder_i_planar_map_edge_covered(o->map, e) == 0 &&
           sunder_i_planar_map_left_covered(o->map, 2 * e) && sunder_i_planar_map_left_covered(o->map, 2 * e + 1) &&
           (!o->inside || (o->inside->edge && o->inside->edge[e]));
}

/* Returns the half-edge of a slit that continues h in the same direction, from the end of h; NOWHERE if there is
 * none. */
static uint32_t slit_after(const outline *o, uint32_t h)
{
    sunder_i_planar_map *map = o->map;
    const uint32_t back = sunder_i_planar_map_twin(h);
    for (uint32_t g = sunder_i_planar_map_ccw(map, back); g != back; g = sunder_i_planar_map_ccw(map, g))
        if (is_slit(o, g >> 1) && is_straight(map, h, g)) return g;
    return SUNDER_I_NOWHERE;
}

static bool gather_segments(outline *o)
{
    o->ring_end = o->vertices;
    for (uint32_t e = 0; e < sunder_i_planar_map_edge_end(o->map); e++) {
        if (!is_slit(o, e) || slit_after(o, 2 * e + 1) != SUNDER_I_NOWHERE) continue;
        uint32_t last = 2 * e;
        for (uint32_t g = last; g != SUNDER_I_NOWHERE; g = slit_after(o, g)) last = g;
        if (!push_vertex(o, sunder_i_planar_map_origin(o->map, 2 * e)) ||
            !push_vertex(o, sunder_i_planar_map_origin(o->map, sunder_i_planar_map_twin(last))))
            return false;
    }
    o->segment_end = o->vertices;
    return true;
}

static bool is_point(const outline *o, uint32_t v)
{
    const sunder_i_planar_map *map = o->map;
    if (o->inside && !(o->inside->vertex && o->inside->vertex[v])) return false;
    if (!sunder_i_planar_map_vertex_alive(map, v) || sunder_i_planar_map_vertex_covered(map, v)) return false;
    const uint32_t first = sunder_i_planar_map_vertex_out(map, v);
    uint32_t h = first;
    if (h != SUNDER_I_NOWHERE) do {
            if (sunder_i_planar_map_edge_covered(map, h >> 1) == 0) return false;
            h = sunder_i_planar_map_ccw(map, h);
        } while (h != first);
    return true;
}

static bool gather_points(outline *o)
{
    for (uint32_t v = 0; v < sunder_i_planar_map_vertex_end(o->map); v++)
        if (!sunder_i_step() || (is_point(o, v) && !push_vertex(o, v))) return false;
    return true;
}

static bool put_in_order(outline *o, sunder_sum *sum)
{
    sunder_i_found found = {.vertex = o->vertex,
                            .ring = o->ring,
                            .rings = o->rings,
                            .components = sunder_i_planar_map_face_end(o->map),
                            .segment = o->vertex + o->ring_end,
                            .segments = (o->segment_end - o->ring_end) / 2,
                            .point = o->vertex + o->segment_end,
                            .points = o->vertices - o->segment_end,
                            .compare = compare_vertices,
                            .context = o};
    return sunder_i_canonical(&found, sum);
}

/* ---- The vertices of the sum ---- */

static void renumber_vertices(uint32_t *vertex, size_t n, uint32_t *number, uint32_t *next, uint32_t *of)
{
    for (size_t i = 0; i < n; i++) {
        if (number[vertex[i]] == UINT32_MAX) {
            of[*next] = vertex[i];
            number[vertex[i]] = (*next)++;
        }
        vertex[i] = number[vertex[i]];
    }
}

/* *out becomes vertex v of the map in lowest terms, as the other methods return vertices. Returns false if out of
 * memory. Every vertex of a sum is a corner of the convolution or a crossing of two of its sides, which lie on lines
 * through lattice points along lattice vectors. So its numbers are as small as those of such crossings, although the
 * map may have computed it from Steiner points. */
static bool reduced_vertex(sunder_i_lattice *lattice, sunder_i_arena *arena, const sunder_i_planar_map *map, uint32_t v,
                           sunder_i_hpoint *out)
{
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    const sunder_i_rational_point at = sunder_i_rational_reduced(arena, *sunder_i_planar_map_vertex_point(map, v));
    if (arena->failed) return false;
    *out = sunder_i_hpoint_make(lattice, at);
    sunder_i_arena_release(arena, mark);
    return !lattice->arena.failed;
}

static bool make_vertices(outline *o, sunder_sum *sum)
{
    const uint32_t end = sunder_i_planar_map_vertex_end(o->map);
    uint32_t *number = sunder_i_alloc(end, sizeof *number), *of = sunder_i_alloc(o->vertices, sizeof *of), n = 0;
    bool ok = number && of;
    if (ok) {
        memset(number, 0xff, end * sizeof *number);
        renumber_vertices(sum->ring_vertex, sum->rings ? sum->ring_end[sum->rings - 1] : 0, number, &n, of);
        renumber_vertices(sum->segment, 2 * sum->segments, number, &n, of);
        renumber_vertices(sum->point, sum->points, number, &n, of);
        sum->vertex = sunder_i_alloc(n, sizeof *sum->vertex);
        ok = sum->vertex != NULL;
    }
    sunder_i_arena arena = {0};
    for (uint32_t i = 0; ok && i < n; i++) ok = reduced_vertex(&sum->lattice, &arena, o->map, of[i], &sum->vertex[i]);
    sum->vertices = ok ? n : 0;
    sunder_i_arena_free(&arena);
    sunder_i_free_all(number, of);
    return ok;
}

sunder_status sunder_i_sum_from_cells(sunder_i_planar_map *map, const sunder_i_inside *inside, sunder_sum *sum,
                                      sunder_error *err)
{
    outline o = {.map = map, .inside = inside};
    const bool ok = connect_faces(&o) && trace_rings(&o) && gather_segments(&o) && gather_points(&o) &&
                    put_in_order(&o, sum) && make_vertices(&o, sum);
    sunder_i_free_all(o.component, o.done, o.vertex, o.ring);
    return ok && !sunder_i_planar_map_failed(map) ? SUNDER_OK : sunder_i_failure_cause(err);
}

sunder_status sunder_i_sum_from_map(sunder_i_planar_map *map, sunder_sum *sum, sunder_error *err)
{
    const sunder_status status = sunder_i_planar_map_faces(map, err);
    return status == SUNDER_OK ? sunder_i_sum_from_cells(map, NULL, sum, err) : status;
}
