/* sunder_shape_from_rings(): raw coordinates -> a shape. Rings are cleaned, turned, and checked exactly, polygon by
 * polygon; then come the convex pieces, and all of it moves into one block of memory.
 *
 * Most input is tiny and there is much of it, so the plain path allocates twice: one arena for the work, one block for the
 * shape. */
#include "shape/build.h"

#include "shape/from_rings.h"

#include <math.h>
#include <stdio.h>

/* Below this all pairs of edges are looked at; above, the tree of boxes pays. */
#define TREE_FROM 40

static bool finite_all(const sunder_i_input *in, sunder_error *err)
{
    const size_t n = in->vertices;
    /* One pass that a compiler can vectorise: a value that is not finite makes the sum of x - x a NaN. */
    double sum = 0;
    for (size_t i = 0; i < 2 * n; i++) sum += in->xy[i] - in->xy[i];
    if (sum == 0) return true;
    for (size_t i = 0; i < 2 * n; i++)
        if (!isfinite(in->xy[i])) {
            const sunder_i_place_name at = sunder_i_name_vertex(in, (uint32_t)(i / 2));
            sunder_i_fail_at(err, SUNDER_EINVALID, at.polygon, at.ring, at.vertex,
                             "polygon %zu, ring %zu, vertex %zu (%.17g %.17g): a coordinate is not finite", at.polygon,
                             at.ring, at.vertex, in->xy[i & ~(size_t)1], in->xy[i | 1]);
            return false;
        }
    return true;
}

sunder_i_place_name sunder_i_name_vertex(const sunder_i_input *in, uint32_t vertex)
{
    sunder_i_place_name at = {0, 0, 0};
    size_t ring = 0;
    while (in->ring_end[ring] <= vertex) ring++;
    while (in->poly_end[at.polygon] <= ring) at.polygon++;
    at.ring = ring - (at.polygon ? in->poly_end[at.polygon - 1] : 0);
    at.vertex = vertex - (ring ? in->ring_end[ring - 1] : 0);
    return at;
}

sunder_status sunder_i_fail_problem(const sunder_i_input *in, const sunder_i_problem *p, sunder_error *err)
{
    static const char *const what[] = {[SUNDER_I_FEW] = "the ring has under three distinct vertices",
                                       [SUNDER_I_FLAT] = "the ring has no area",
                                       [SUNDER_I_SPIKE] = "a spike: the ring runs back along itself",
                                       [SUNDER_I_CROSSES] = "crosses",
                                       [SUNDER_I_OVERLAPS] = "shares a piece of edge with",
                                       [SUNDER_I_OUTSIDE] = "the hole lies outside",
                                       [SUNDER_I_NESTED] = "the hole lies inside"};
    const sunder_i_place_name at = sunder_i_name_vertex(in, p->vertex);
    char place[160], rest[80] = "";
    const double *xy = in->xy + 2 * (size_t)p->vertex;
    snprintf(place, sizeof place, "polygon %zu, ring %zu, vertex %zu (%.10g %.10g)", at.polygon, at.ring, at.vertex, xy[0],
             xy[1]);
    if (p->other != SUNDER_I_NONE) {
        const sunder_i_place_name o = sunder_i_name_vertex(in, p->other);
        const bool ring_only = p->fault == SUNDER_I_OUTSIDE || p->fault == SUNDER_I_NESTED;
        if (ring_only)
            snprintf(rest, sizeof rest, " ring %zu", o.ring);
        else if (o.ring == at.ring)
            snprintf(rest, sizeof rest, " segment %zu", o.vertex);
        else
            snprintf(rest, sizeof rest, " segment %zu of ring %zu", o.vertex, o.ring);
    }
    return sunder_i_fail_at(err, SUNDER_EINVALID, at.polygon, at.ring, at.vertex, "%s: %s%s", place, what[p->fault], rest);
}

/* Counts that fit our 32-bit vertex numbers, with room for bridges and half-edges. */
static sunder_status read_input(sunder_i_input *in, sunder_error *err)
{
    const size_t rings = in->polygons ? in->poly_end[in->polygons - 1] : 0;
    in->vertices = rings ? in->ring_end[rings - 1] : 0;
    in->rings = rings;
    if (in->vertices > UINT32_MAX / 32 || rings > UINT32_MAX / 32)
        return sunder_i_fail(err, SUNDER_ERANGE, "a shape of %zu vertices in %zu rings is too large", in->vertices, rings);
    return finite_all(in, err) ? SUNDER_OK : SUNDER_EINVALID;
}

/* Cleaned rings of polygon p appended to r. */
static void append_polygon(sunder_i_rings *r, const sunder_i_input *in, const sunder_i_point *at, size_t p,
                           sunder_i_problem *problem)
{
    const uint32_t first = r->vertices;
    for (size_t ring = p ? in->poly_end[p - 1] : 0; ring < in->poly_end[p]; ring++) {
        const uint32_t lo = ring ? (uint32_t)in->ring_end[ring - 1] : 0, hi = (uint32_t)in->ring_end[ring];
        const uint32_t begin = r->vertices;
        const uint32_t n = sunder_i_clean_ring(r->lattice, in->xy, at, lo, hi, r->source + begin, problem);
        if (problem->fault) return;
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
}

/* Is the polygon of the last rings, from ring_lo on, as it should be? */
static void check_polygon(sunder_i_rings *r, uint32_t ring_lo, sunder_i_arena *arena, sunder_i_problem *problem,
                          bool *touches)
{
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    const uint32_t n = r->vertices - (ring_lo ? r->ring_end[ring_lo - 1] : 0);
    sunder_i_box_tree tree;
    sunder_i_box_tree *use = NULL;
    sunder_i_orient_rings(r, ring_lo, r->rings);
    if (n >= TREE_FROM) {
        sunder_i_box_tree_build(&tree, r, ring_lo, r->rings, arena);
        if (arena->failed) return;
        use = &tree;
    }
    sunder_i_contact_find(r, ring_lo, r->rings, use, arena, problem, touches);
    if (!problem->fault && r->rings - ring_lo > 1) sunder_i_nesting_check(r, ring_lo, r->rings, use, problem);
    if (problem->fault) {
        problem->vertex = r->source[problem->vertex];
        if (problem->other != SUNDER_I_NONE) problem->other = r->source[problem->other];
    }
    sunder_i_arena_release(arena, mark);
}

static bool make_room(sunder_i_rings *r, const sunder_i_input *in, sunder_i_arena *arena)
{
    const size_t n = in->vertices;
    r->at = sunder_i_arena_alloc(arena, n, sizeof *r->at);
    r->xy = sunder_i_arena_alloc(arena, 2 * n, sizeof *r->xy);
    r->source = sunder_i_arena_alloc(arena, 3 * n + in->rings + in->polygons, sizeof *r->source);
    if (arena->failed) return false;
    r->next = r->source + n;
    r->prev = r->next + n;
    r->ring_end = r->prev + n;
    r->poly_end = r->ring_end + in->rings;
    return true;
}

/* The whole way, on a lattice and an arena that the caller frees. */
static sunder_status build(const sunder_i_input *in, sunder_validity validity, sunder_i_lattice *lattice,
                           sunder_i_arena *arena, sunder_shape **out, sunder_error *err)
{
    sunder_i_extent extent = {0};
    double origin[1][2];
    sunder_i_extent_add(&extent, in->xy, in->vertices);
    sunder_i_lattice_init(lattice, &extent, 1, true, origin, false);
    sunder_i_point *at = sunder_i_arena_alloc(arena, in->vertices, sizeof *at);
    sunder_i_rings r = {.lattice = lattice};
    if (!at || !make_room(&r, in, arena)) return sunder_i_no_memory(err);
    for (size_t i = 0; i < in->vertices; i++) {
        at[i].x = sunder_i_lattice_int(lattice, in->xy[2 * i], origin[0][0]);
        at[i].y = sunder_i_lattice_int(lattice, in->xy[2 * i + 1], origin[0][1]);
    }
    for (size_t p = 0; p < in->polygons; p++) {
        const uint32_t ring_lo = r.rings;
        sunder_i_problem problem = {SUNDER_I_SOUND, 0, SUNDER_I_NONE};
        bool touches = false;
        append_polygon(&r, in, at, p, &problem);
        if (!problem.fault && r.rings > ring_lo) check_polygon(&r, ring_lo, arena, &problem, &touches);
        if (arena->failed || lattice->arena.failed) return sunder_i_no_memory(err);
        if (problem.fault) return sunder_i_fail_problem(in, &problem, err);
        if (r.rings > ring_lo) r.poly_end[r.polygons++] = r.rings;
    }
    (void)validity;
    sunder_i_pieces pieces;
    if (!sunder_i_pieces_find(&r, arena, &pieces)) return sunder_i_no_memory(err);
    sunder_shape *s = sunder_i_shape_assemble(in->xy, in->ring_end, in->poly_end, in->polygons, &r, &pieces);
    if (!s) return sunder_i_no_memory(err);
    sunder_i_shape_measure(s);
    if (!sunder_i_shape_mark_shared(s, arena)) {
        sunder_shape_free(s);
        return sunder_i_no_memory(err);
    }
    *out = s;
    return SUNDER_OK;
}

sunder_status sunder_shape_from_rings(const double *xy, const size_t *ring_end, const size_t *poly_end, size_t polygons,
                                      sunder_validity validity, sunder_shape **out, sunder_error *err)
{
    sunder_i_input in = {.xy = xy, .ring_end = ring_end, .poly_end = poly_end, .polygons = polygons};
    sunder_status status = read_input(&in, err);
    if (status) return status;
    sunder_i_arena arena;
    sunder_i_arena_init(&arena);
    sunder_i_lattice lattice = {0};
    status = build(&in, validity, &lattice, &arena, out, err);
    sunder_i_lattice_free(&lattice);
    sunder_i_arena_free(&arena);
    return status;
}
