/* shape_invariants.c: sunder_i_shape_check() tests every invariant of shape.h from the definitions, with all pairs. It
 * is slow on purpose: it shares only the predicates with the code that it checks. */
#include "shape/shape.h"

#include "predicate/predicate.h"
#include "predicate/rational_point.h"

#include "base/extremes.h"

typedef struct checker {
    const sunder_shape *s;
    sunder_i_lattice *l;
    const sunder_i_point *at;
    sunder_i_arena arena;
    uint32_t *polygon; /* the polygon of each vertex */
} checker;

static int vertex_turn(const checker *c, uint32_t a, uint32_t b, uint32_t d)
{
    return sunder_i_orient(c->l, c->at[a], c->at[b], c->at[d]);
}

static bool same_place(const checker *c, uint32_t a, uint32_t b)
{
    return sunder_i_point_equal(c->l, c->at[a], c->at[b]);
}

static uint32_t ring_begin(const sunder_shape *s, uint32_t ring)
{
    return ring ? s->form->cleaned.ring_end[ring - 1] : 0;
}

static const char *check_links(checker *c)
{
    const sunder_shape *s = c->s;
    uint32_t v = 0, ring = 0;
    for (uint32_t p = 0; p < s->form->cleaned.polygons; p++) {
        if (s->form->cleaned.poly_end[p] <= ring) return "a polygon has no ring";
        for (; ring < s->form->cleaned.poly_end[p]; ring++) {
            if (ring >= s->form->cleaned.rings || s->form->cleaned.ring_end[ring] < v + 3)
                return "a ring has under three vertices";
            const uint32_t first = v, end = s->form->cleaned.ring_end[ring];
            for (; v < end; v++) {
                c->polygon[v] = p;
                if (s->form->cleaned.next[v] != (v + 1 < end ? v + 1 : first)) return "next is not along the ring";
                if (s->form->cleaned.prev[s->form->cleaned.next[v]] != v) return "prev is not the reverse of next";
            }
        }
    }
    return v == s->vertices && ring == s->form->cleaned.rings ? NULL : "the counts do not agree";
}

static bool boxes_apart(const sunder_shape *s, uint32_t a, uint32_t b, uint32_t g, uint32_t h)
{
    for (size_t k = 0; k < 2; k++) {
        const double p = s->xy[2 * (size_t)a + k], q = s->xy[2 * (size_t)b + k];
        const double t = s->xy[2 * (size_t)g + k], u = s->xy[2 * (size_t)h + k];
        if (sunder_i_max(p, q) < sunder_i_min(t, u) || sunder_i_max(t, u) < sunder_i_min(p, q)) return true;
    }
    return false;
}

/* Returns whether the direction v -> d is in the closed sector of the interior at v. */
static bool in_sector(const checker *c, uint32_t v, uint32_t d)
{
    const uint32_t u = c->s->form->cleaned.next[v], w = c->s->form->cleaned.prev[v];
    const bool left = vertex_turn(c, v, u, d) >= 0, right = vertex_turn(c, v, d, w) >= 0;
    return vertex_turn(c, v, u, w) > 0 ? left && right : left || right;
}

static const char *check_edge_pair(const checker *c, uint32_t e, uint32_t f)
{
    const sunder_shape *s = c->s;
    const uint32_t a = e, b = s->form->cleaned.next[e], g = f, h = s->form->cleaned.next[f];
    if (boxes_apart(s, a, b, g, h)) return NULL;
    switch (sunder_i_segments_meet(c->l, c->at[a], c->at[b], c->at[g], c->at[h])) {
    case SUNDER_I_CROSS: return "edges cross";
    case SUNDER_I_OVERLAP: return "edges share a piece";
    case SUNDER_I_END_INSIDE:
        /* allowed only from outside: the edges of the vertex are on the right */
        if (vertex_turn(c, a, b, g) == 0 && !same_place(c, g, a) && !same_place(c, g, b) && vertex_turn(c, a, b, h) > 0)
            return "a vertex touches an edge from inside";
        if (vertex_turn(c, g, h, a) == 0 && !same_place(c, a, g) && !same_place(c, a, h) && vertex_turn(c, g, h, b) > 0)
            return "a vertex touches an edge from inside";
        return NULL;
    default:
        if (same_place(c, a, g) &&
            (in_sector(c, a, h) || in_sector(c, a, s->form->cleaned.prev[g]) || in_sector(c, g, b)))
            return "sectors at one place overlap";
        return NULL;
    }
}

static const char *check_edges(checker *c)
{
    const sunder_shape *s = c->s;
    for (uint32_t e = 0; e < s->vertices; e++) {
        if (vertex_turn(c, s->form->cleaned.prev[e], e, s->form->cleaned.next[e]) == 0) return "a collinear vertex";
        for (uint32_t f = e + 1; f < s->vertices && c->polygon[f] == c->polygon[e]; f++) {
            if (s->form->cleaned.next[e] == f || s->form->cleaned.next[f] == e) continue;
            const char *fault = check_edge_pair(c, e, f);
            if (fault) return fault;
        }
    }
    return NULL;
}

static const char *check_shared(checker *c)
{
    const sunder_shape *s = c->s;
    for (uint32_t v = 0; v < s->vertices; v++) {
        bool found = false;
        for (uint32_t w = 0; w < s->vertices && !found; w++) found = w != v && same_place(c, v, w);
        if (found != s->form->cleaned.shared[v]) return "shared is wrong";
    }
    return NULL;
}

/* A sum of cross products, each with a denominator of its own. */
typedef struct sum {
    sunder_i_big num, den;
} sum;

static void add_term(sunder_i_arena *arena, sum *s, sunder_i_big num, sunder_i_big den)
{
    const sunder_i_big g = sunder_i_big_gcd(arena, s->den, den);
    if (arena->failed) return;
    const sunder_i_big more = sunder_i_big_div_floor(arena, den, g);
    s->num = sunder_i_big_add(arena, sunder_i_big_mul(arena, s->num, more),
                              sunder_i_big_mul(arena, num, sunder_i_big_div_floor(arena, s->den, g)));
    s->den = sunder_i_big_mul(arena, s->den, more);
}

/* Adds twice the signed area of a cycle of vertices, times `factor`, to s. */
static void add_area(checker *c, const uint32_t *list, uint32_t first, uint32_t n, int factor, sum *s)
{
    sunder_i_arena *arena = &c->arena;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t j = i + 1 < n ? i + 1 : 0;
        const sunder_i_rational_point p = sunder_i_rational_get(arena, c->l, c->at[list ? list[i] : first + i]);
        const sunder_i_rational_point q = sunder_i_rational_get(arena, c->l, c->at[list ? list[j] : first + j]);
        const sunder_i_big cross = sunder_i_rational_cross(arena, p, q);
        add_term(arena, s, factor < 0 ? sunder_i_big_neg(cross) : cross, sunder_i_big_mul(arena, p.w, q.w));
    }
}

/* Returns whether the cycle is strictly convex and turns once. */
static bool is_convex(const checker *c, const uint32_t *list, uint32_t n)
{
    uint32_t peaks = 0;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t a = list[i], b = list[(i + 1) % n], d = list[(i + 2) % n];
        if (vertex_turn(c, a, b, d) <= 0) return false;
        peaks += sunder_i_point_cmp(c->l, c->at[a], c->at[b]) < 0 && sunder_i_point_cmp(c->l, c->at[b], c->at[d]) > 0;
    }
    return peaks == 1;
}

/* Returns whether a side of p has all of q on its right or on its line. Two convex polygons have disjoint interiors
 * exactly if this holds for one of them. */
static bool side_separates(const checker *c, const uint32_t *p, uint32_t n, const uint32_t *q, uint32_t m)
{
    for (uint32_t i = 0; i < n; i++) {
        uint32_t k = 0;
        while (k < m && vertex_turn(c, p[i], p[(i + 1) % n], q[k]) <= 0) k++;
        if (k == m) return true;
    }
    return false;
}

/* Returns how many pieces have the side a -> b. */
static uint32_t count_side(const sunder_shape *s, uint32_t a, uint32_t b)
{
    uint32_t count = 0;
    for (uint32_t i = 0, lo = 0; i < s->pieces; lo = s->piece_end[i++])
        for (uint32_t k = lo; k < s->piece_end[i]; k++)
            count += sunder_i_piece_vertices(s)[k] == a &&
                     sunder_i_piece_vertices(s)[k + 1 < s->piece_end[i] ? k + 1 : lo] == b;
    return count;
}

static const char *check_sides(const checker *c)
{
    const sunder_shape *s = c->s;
    for (uint32_t v = 0; v < s->vertices; v++)
        if (count_side(s, v, s->form->cleaned.next[v]) != 1)
            return "a boundary edge is not the side of exactly one piece";
    for (uint32_t i = 0, lo = 0; i < s->pieces; lo = s->piece_end[i++])
        for (uint32_t k = lo; k < s->piece_end[i]; k++) {
            const uint32_t a = sunder_i_piece_vertices(s)[k],
                           b = sunder_i_piece_vertices(s)[k + 1 < s->piece_end[i] ? k + 1 : lo];
            if (c->polygon[a] != c->polygon[b]) return "a piece spans two polygons";
            if (s->form->cleaned.next[a] != b && (count_side(s, a, b) != 1 || count_side(s, b, a) != 1))
                return "a diagonal is not the side of exactly two pieces";
        }
    return NULL;
}

/* Checks that the corners of pieces are vertices, before anything else about pieces is checked. */
static const char *check_corners(const sunder_shape *s)
{
    for (uint32_t i = 0, lo = 0; i < s->pieces; lo = s->piece_end[i++]) {
        if (s->piece_end[i] < lo + 3) return "a piece has under three corners";
        for (uint32_t k = lo; k < s->piece_end[i]; k++)
            if (sunder_i_piece_vertices(s)[k] >= s->vertices) return "a corner of a piece is no vertex";
    }
    return NULL;
}

static const char *check_pieces(checker *c)
{
    const sunder_shape *s = c->s;
    const char *fault = check_corners(s);
    if (fault) return fault;
    for (uint32_t i = 0, lo = 0; i < s->pieces; lo = s->piece_end[i++]) {
        const uint32_t n = s->piece_end[i] - lo, *p = sunder_i_piece_vertices(s) + lo;
        if (!is_convex(c, p, n)) return "a piece is not strictly convex";
        for (uint32_t j = i + 1; j < s->pieces; j++) {
            const uint32_t at = s->piece_end[j - 1], m = s->piece_end[j] - at, *q = sunder_i_piece_vertices(s) + at;
            if (c->polygon[*p] != c->polygon[*q]) continue;
            if (!side_separates(c, p, n, q, m) && !side_separates(c, q, m, p, n)) return "pieces overlap";
        }
    }
    return check_sides(c);
}

/* Checks that outer rings are counterclockwise and holes clockwise, and that the areas of a polygon's pieces add up to
 * its area. */
static const char *check_areas(checker *c)
{
    const sunder_shape *s = c->s;
    for (uint32_t p = 0; p < s->form->cleaned.polygons; p++) {
        sum all = {{NULL, 0}, sunder_i_big_i64(&c->arena, 1)};
        const uint32_t first = p ? s->form->cleaned.poly_end[p - 1] : 0;
        for (uint32_t ring = first; ring < s->form->cleaned.poly_end[p]; ring++) {
            const uint32_t lo = ring_begin(s, ring);
            sum own = {{NULL, 0}, sunder_i_big_i64(&c->arena, 1)};
            add_area(c, NULL, lo, s->form->cleaned.ring_end[ring] - lo, 1, &own);
            if (sunder_i_big_sign(own.num) != (ring == first ? 1 : -1)) return "a ring is turned the wrong way";
            add_term(&c->arena, &all, own.num, own.den);
        }
        for (uint32_t i = 0, lo = 0; i < s->pieces; lo = s->piece_end[i++])
            if (c->polygon[sunder_i_piece_vertices(s)[lo]] == p)
                add_area(c, sunder_i_piece_vertices(s) + lo, 0, s->piece_end[i] - lo, -1, &all);
        if (sunder_i_big_sign(all.num) != 0) return "the pieces do not make up the polygon's area";
    }
    return NULL;
}

static const char *check_numbers(checker *c)
{
    const sunder_shape *s = c->s;
    for (size_t i = 0; i < 2 * (size_t)s->vertices; i++) {
        const sunder_i_exact *v =
            s->rational && s->form->numbers->exact[i / 2].den.size ? &s->form->numbers->exact[i / 2] : NULL;
        if (v && (sunder_i_big_sign(v->den) <= 0 || sunder_i_big_twos(v->den) != 0)) return "a denominator is not odd";
        if (v && sunder_i_big_ratio(&c->arena, v->num[i & 1], v->den, v->exponent) != s->xy[i])
            return "a coordinate is not the nearest double";
        if (s->xy[i] < s->box[i & 1] || s->xy[i] > s->box[2 + (i & 1)]) return "the box is too small";
    }
    return NULL;
}

const char *sunder_i_shape_check(const sunder_shape *shape)
{
    sunder_i_placed placed;
    if (shape->form->cleaned.polygons == 0)
        return shape->vertices || shape->pieces ? "an empty shape has vertices" : NULL;
    if (sunder_i_place(shape, NULL, NULL, &placed, NULL)) return NULL;
    checker c = {.s = shape, .l = &placed.lattice, .at = placed.p};
    c.polygon = sunder_i_alloc(shape->vertices, sizeof *c.polygon);
    static const char *(*const check[])(checker *) = {check_links,  check_numbers, check_edges,
                                                      check_shared, check_pieces,  check_areas};
    const char *fault = NULL;
    for (size_t i = 0; c.polygon && !fault && i < sizeof check / sizeof *check; i++) fault = check[i](&c);
    if (c.arena.failed || placed.lattice.arena.failed) fault = NULL;
    sunder_i_free(c.polygon);
    sunder_i_arena_free(&c.arena);
    sunder_i_placed_free(&placed);
    return fault;
}
