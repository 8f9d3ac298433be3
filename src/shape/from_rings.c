/* from_rings.c: sunder_shape_from_rings() makes a shape from raw coordinates. Rings are cleaned, oriented and checked
 * exactly, polygon by polygon; then the convex pieces are found, and everything is copied to one block of memory.
 *
 * Most shapes are tiny, and there are many of them: a valid polygon with few vertices has a path of its own
 * (small_polygon.c), and the usual path allocates twice otherwise, an arena for the computation and a block for the
 * shape. */
#include "shape/from_rings.h"

#include "base/invariant.h"
#include "shape/rational_corners.h"
#include "shape/repair.h"
#include "shape/small_polygon.h"

#include <math.h>
#include <stdio.h>

/* Numbers from 0 on: of the polygon, of the ring in it, and of the vertex in the ring. */
typedef struct place_name {
    size_t polygon, ring, vertex;
} place_name;

static place_name name_vertex(const sunder_i_input *in, uint32_t vertex)
{
    place_name at = {0, 0, 0};
    size_t ring = 0;
    while (in->ring_end[ring] <= vertex) ring++;
    while (in->poly_end[at.polygon] <= ring) at.polygon++;
    at.ring = ring - (at.polygon ? in->poly_end[at.polygon - 1] : 0);
    at.vertex = vertex - (ring ? in->ring_end[ring - 1] : 0);
    return at;
}

static bool finite_all(const sunder_i_input *in, sunder_error *err)
{
    const size_t n = in->vertices;
    /* One loop that a compiler can vectorise: a value that is not finite makes the sum of x - x NaN. */
    double sum = 0;
    for (size_t i = 0; i < 2 * n; i++) sum += in->xy[i] - in->xy[i];
    if (sum == 0) return true;
    for (size_t i = 0; i < 2 * n; i++)
        if (!isfinite(in->xy[i])) {
            const place_name at = name_vertex(in, (uint32_t)(i / 2));
            sunder_i_fail_at(err, SUNDER_EINVALID, at.polygon, at.ring, at.vertex,
                             "polygon %zu, ring %zu, vertex %zu (%.17g %.17g): a coordinate is not finite", at.polygon,
                             at.ring, at.vertex, in->xy[i & ~(size_t)1], in->xy[i | 1]);
            return false;
        }
    return true;
}

/* Sets *err to the message for a problem whose vertices are raw numbers; returns its status. */
static sunder_status fail_problem(const sunder_i_input *in, const sunder_i_problem *problem, sunder_error *err)
{
    static const char *const what[] = {[SUNDER_I_FEW] = "the ring has under three distinct vertices",
                                       [SUNDER_I_FLAT] = "the ring has no area",
                                       [SUNDER_I_SPIKE] = "a spike: the ring runs back along itself",
                                       [SUNDER_I_CROSSES] = "crosses",
                                       [SUNDER_I_OVERLAPS] = "shares a piece of edge with",
                                       [SUNDER_I_OUTSIDE] = "the hole lies outside",
                                       [SUNDER_I_NESTED] = "the hole lies inside"};
    if (problem->fault == SUNDER_I_EMPTY) {
        /* here `vertex` is the number of the raw ring, which has no vertex */
        size_t polygon = 0;
        while (in->poly_end[polygon] <= problem->vertex) polygon++;
        const size_t ring = problem->vertex - (polygon ? in->poly_end[polygon - 1] : 0);
        return sunder_i_fail_at(err, SUNDER_EINVALID, polygon, ring, SIZE_MAX,
                                "polygon %zu, ring %zu: the ring is empty", polygon, ring);
    }
    const place_name at = name_vertex(in, problem->vertex);
    char place[160], rest[80] = "";
    const double *xy = in->xy + 2 * (size_t)problem->vertex;
    snprintf(place, sizeof place, "polygon %zu, ring %zu, vertex %zu (%.10g %.10g)", at.polygon, at.ring, at.vertex,
             xy[0], xy[1]);
    if (problem->other != SUNDER_I_NONE) {
        const place_name o = name_vertex(in, problem->other);
        const bool ring_only = problem->fault == SUNDER_I_OUTSIDE || problem->fault == SUNDER_I_NESTED;
        if (ring_only)
            snprintf(rest, sizeof rest, " ring %zu", o.ring);
        else if (o.ring == at.ring)
            snprintf(rest, sizeof rest, " segment %zu", o.vertex);
        else
            snprintf(rest, sizeof rest, " segment %zu of ring %zu", o.vertex, o.ring);
    }
    return sunder_i_fail_at(err, SUNDER_EINVALID, at.polygon, at.ring, at.vertex, "%s: %s%s", place,
                            what[problem->fault], rest);
}

/* Returns whether no end is less than the previous one. */
static bool is_ascending(const size_t *end, size_t n)
{
    for (size_t i = 1; i < n; i++)
        if (end[i] < end[i - 1]) return false;
    return true;
}

/* Checks that the arrays describe rings, and that the numbers fit 32-bit vertex numbers with room for bridges and
 * half-edges; sets in->rings and in->vertices. */
static sunder_status read_input(sunder_i_input *in, sunder_error *err)
{
    const size_t rings = in->polygons ? in->poly_end[in->polygons - 1] : 0;
    if (!is_ascending(in->poly_end, in->polygons) || !is_ascending(in->ring_end, rings))
        return sunder_i_fail(err, SUNDER_EARG, "a ring or polygon ends before the one that it follows");
    in->vertices = rings ? in->ring_end[rings - 1] : 0;
    in->rings = rings;
    if (in->vertices > UINT32_MAX / 32 || rings > UINT32_MAX / 32)
        return sunder_i_fail(err, SUNDER_ESIZE, "a shape of %zu vertices in %zu rings is too large", in->vertices,
                             rings);
    return finite_all(in, err) ? SUNDER_OK : SUNDER_EINVALID;
}

/* Appends the cleaned rings of polygon p to r. Returns false if out of memory. */
static bool append_polygon(sunder_i_rings *r, const sunder_i_input *in, const sunder_i_point *at, size_t p,
                           sunder_i_problem *problem, sunder_i_arena *arena)
{
    const uint32_t first = r->vertices;
    const size_t ring_lo = p ? in->poly_end[p - 1] : 0, ring_hi = in->poly_end[p];
    const size_t raw = in->ring_end[ring_hi - 1] - (ring_lo ? in->ring_end[ring_lo - 1] : 0);
    if (!sunder_i_rings_grow(r, arena, raw, ring_hi - ring_lo, 1)) return false;
    for (size_t ring = ring_lo; ring < ring_hi; ring++) {
        const uint32_t lo = ring ? (uint32_t)in->ring_end[ring - 1] : 0, hi = (uint32_t)in->ring_end[ring];
        const uint32_t begin = r->vertices;
        if (lo == hi) {
            *problem = (sunder_i_problem){SUNDER_I_EMPTY, (uint32_t)ring, SUNDER_I_NONE};
            return true;
        }
        const uint32_t n = sunder_i_clean_ring(r->lattice, in->xy, at, lo, hi, r->source + begin, problem);
        if (problem->fault) return true;
        r->vertices = begin + n;
        r->ring_end[r->rings++] = r->vertices;
        for (uint32_t i = begin; i < r->vertices; i++) {
            r->next[i] = i + 1 < r->vertices ? i + 1 : begin;
            r->prev[i] = i > begin ? i - 1 : r->vertices - 1;
        }
    }
    for (uint32_t i = first; i < r->vertices; i++) {
        r->at[i] = at[r->source[i]];
        r->xy[2 * (size_t)i] = in->xy[2 * (size_t)r->source[i]];
        r->xy[2 * (size_t)i + 1] = in->xy[2 * (size_t)r->source[i] + 1];
    }
    return true;
}

/* Checks the polygon of the last rings, from ring_lo on, and orients its rings. Crossings are checked first, while the
 * rings have their given direction, so that the first vertex of an edge identifies its segment in messages. */
static void check_polygon(sunder_i_rings *r, uint32_t ring_lo, sunder_i_arena *arena, sunder_i_problem *problem,
                          bool *touches)
{
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    const uint32_t n = r->vertices - (ring_lo ? r->ring_end[ring_lo - 1] : 0);
    sunder_i_edge_tree tree;
    sunder_i_edge_tree *const use = n >= SUNDER_I_TREE_FROM ? &tree : NULL;
    if (use) sunder_i_edge_tree_build(use, r, ring_lo, r->rings, arena);
    if (arena->failed) return;
    sunder_i_intersections_find(r, ring_lo, r->rings, use, arena, problem, touches);
    if (!problem->fault) sunder_i_orient_rings(r, ring_lo, r->rings);
    if (!problem->fault && r->rings - ring_lo > 1) {
        if (use) sunder_i_edge_tree_build(use, r, ring_lo, r->rings, arena);
        if (arena->failed) return;
        sunder_i_nesting_check(r, ring_lo, r->rings, use, problem);
    }
    if (problem->fault) {
        problem->vertex = r->source[problem->vertex];
        if (problem->other != SUNDER_I_NONE) problem->other = r->source[problem->other];
    }
    sunder_i_arena_release(arena, mark);
}

/* A shape under construction. */
typedef struct builder {
    const sunder_i_input *in;
    sunder_validity validity;
    sunder_i_arena arena;
    sunder_i_lattice lattice;
    sunder_i_extent extent; /* of the raw vertices */
    double origin[1][2];
    sunder_i_point *at; /* of the raw vertices */
    sunder_i_rings r;
    sunder_i_made_points made;
    bool repaired, touches;
} builder;

#define SMALL_BYTES 8192 /* bytes of memory on the stack */

static bool place_input(builder *b)
{
    const sunder_i_input *in = b->in;
    sunder_i_extent_add(&b->extent, in->xy, in->vertices);
    sunder_i_lattice_init(&b->lattice, &b->extent, 1, true, b->origin, false);
    b->at = sunder_i_arena_alloc(&b->arena, in->vertices, sizeof *b->at);
    b->r.lattice = &b->lattice;
    if (!b->at || !sunder_i_rings_grow(&b->r, &b->arena, in->vertices, in->rings, in->polygons)) return false;
    sunder_i_lattice_points(&b->lattice, in->xy, in->vertices, b->origin[0], b->at);
    return !b->lattice.arena.failed;
}

/* Appends polygon p as it is, or the even-odd set of its rings. */
static sunder_status add_polygon(builder *b, size_t p, sunder_error *err)
{
    sunder_i_rings *r = &b->r;
    const uint32_t vertices = r->vertices, rings = r->rings;
    sunder_i_problem problem = {SUNDER_I_SOUND, 0, SUNDER_I_NONE};
    bool touches = false;
    if (b->in->poly_end[p] == (p ? b->in->poly_end[p - 1] : 0)) return SUNDER_OK;
    if (!append_polygon(r, b->in, b->at, p, &problem, &b->arena)) return sunder_i_failure_cause(err);
    if (!problem.fault) check_polygon(r, rings, &b->arena, &problem, &touches);
    if (b->arena.failed || b->lattice.arena.failed) return sunder_i_failure_cause(err);
    if (problem.fault && b->validity == SUNDER_VALIDITY_STRICT) return fail_problem(b->in, &problem, err);
    b->touches |= touches || problem.fault; /* after a fault the rest was not checked */
    if (problem.fault || touches) {
        b->repaired |= problem.fault != SUNDER_I_SOUND;
        r->vertices = vertices;
        r->rings = rings;
        return sunder_i_repair_polygon(r, b->in, b->at, b->origin[0], p, &b->made, &b->arena)
                   ? SUNDER_OK
                   : sunder_i_failure_cause(err);
    }
    r->poly_end[r->polygons++] = r->rings;
    return SUNDER_OK;
}

/* Stores the exact numbers of vertices that are not doubles. Returns false if out of memory. */
static bool set_exact(builder *b, sunder_shape *s)
{
    sunder_i_exact *exact = sunder_i_arena_alloc(&b->arena, s->vertices, sizeof *exact);
    if (!exact) return false;
    for (uint32_t v = 0; v < s->vertices; v++) {
        const uint32_t source = b->r.source[v];
        exact[v] = (sunder_i_exact){.exponent = 0};
        if (!(source & SUNDER_I_MADE)) continue;
        const sunder_i_exact *made = &b->made.point[source & ~SUNDER_I_MADE];
        if (!sunder_i_exact_is_double(&b->arena, made)) exact[v] = *made;
    }
    return sunder_i_shape_set_rational(s, exact);
}

/* Returns whether all raw vertices are corners, except those that close rings. */
static bool all_kept(const builder *b)
{
    size_t closings = 0;
    if (b->repaired || b->touches) return false;
    for (size_t ring = 0, lo = 0; ring < b->in->rings; lo = b->in->ring_end[ring++]) {
        const double *first = b->in->xy + 2 * lo, *last = b->in->xy + 2 * (b->in->ring_end[ring] - 1);
        closings += first[0] == last[0] && first[1] == last[1];
    }
    return b->r.vertices + closings == b->in->vertices;
}

/* Sets coordinates, box and marks of the assembled shape. Returns false if out of memory. */
static bool complete_shape(builder *b, sunder_shape *s)
{
    s->repaired = b->repaired;
    s->touches = b->touches;
    if (b->made.rational) {
        if (!set_exact(b, s) || !sunder_i_shape_measure_rational(s)) return false;
    } else {
        sunder_i_shape_measure(s, all_kept(b) ? &b->extent : NULL);
        if (!sunder_i_shape_measure_anchor(s)) return false;
    }
    /* vertices of one polygon with a common position touch, which was checked */
    if (b->in->polygons == 1 && !b->repaired && !b->touches) {
        sunder_i_shape_mark_none_shared(s);
        return true;
    }
    return sunder_i_shape_mark_shared(s, &b->arena);
}

static sunder_status build_shape(builder *b, sunder_shape **out, sunder_error *err)
{
    const sunder_i_input *in = b->in;
    if (!place_input(b)) return sunder_i_failure_cause(err);
    for (size_t p = 0; p < in->polygons; p++) {
        const sunder_status status = add_polygon(b, p, err);
        if (status) return status;
    }
    if (b->made.n && !sunder_i_repair_place(&b->r, &b->made, b->origin[0], &b->arena))
        return sunder_i_failure_cause(err);
    if (!sunder_i_rings_canonical(&b->r, &b->arena)) return sunder_i_failure_cause(err);
    sunder_i_pieces pieces;
    if (!sunder_i_pieces_find(&b->r, &b->arena, &pieces)) return sunder_i_failure_cause(err);
    sunder_shape *s = sunder_i_shape_assemble(in->xy, in->ring_end, in->poly_end, in->polygons, &b->r, &pieces);
    if (!s) return sunder_i_failure_cause(err);
    if (!complete_shape(b, s)) {
        sunder_shape_free(s);
        return sunder_i_failure_cause(err);
    }
    SUNDER_I_CHECK(sunder_i_shape_check(s), s->vertices);
    *out = s;
    return SUNDER_OK;
}

sunder_status sunder_shape_from_rings(const double *xy, const size_t *ring_end, const size_t *poly_end, size_t polygons,
                                      sunder_validity validity, sunder_shape **out, sunder_error *err)
{
    if (validity != SUNDER_VALIDITY_STRICT && validity != SUNDER_VALIDITY_EVEN_ODD)
        return sunder_i_fail(err, SUNDER_EARG, "there is no such treatment of invalid rings");
    sunder_i_input in = {.xy = xy, .ring_end = ring_end, .poly_end = poly_end, .polygons = polygons};
    sunder_status status = read_input(&in, err);
    if (status) return status;
    sunder_shape *small;
    if (sunder_i_small_polygon(&in, &small)) {
        if (!small) return sunder_i_failure_cause(err);
        SUNDER_I_CHECK(sunder_i_shape_check(small), small->vertices);
        *out = small;
        return SUNDER_OK;
    }
    _Alignas(16) unsigned char memory[SMALL_BYTES]; /* sufficient for a building */
    builder b = {.in = &in, .validity = validity};
    sunder_i_arena_init_on(&b.arena, memory, sizeof memory);
    status = build_shape(&b, out, err);
    sunder_i_lattice_free(&b.lattice);
    sunder_i_free(b.made.point);
    sunder_i_arena_free(&b.arena);
    return status;
}
