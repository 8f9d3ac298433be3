/* measure_rational.c: area and anchor of a shape with vertices that are not doubles. */
#include "predicate/narrow.h"
#include "predicate/rational_point.h"
#include "shape/shape.h"
#include "shape/widest_interval.h"

/* ---- Area ---- */

/* Returns the cross product of the ends of an edge in units of 2^-bits, rounded down; *lost counts the rounded ones. */
static sunder_i_big edge_area(sunder_i_arena *arena, const sunder_i_lattice *l, sunder_i_point a, sunder_i_point b,
                              unsigned long bits, int64_t *lost)
{
    const sunder_i_rational_point u = sunder_i_rational_get(arena, l, a), v = sunder_i_rational_get(arena, l, b);
    const sunder_i_big den = sunder_i_times(arena, u.w, v.w);
    const sunder_i_big term = sunder_i_big_shl(arena, sunder_i_rational_cross(arena, u, v), bits);
    if (sunder_i_big_is_one(den)) return term;
    ++*lost;
    return sunder_i_big_div_floor(arena, term, den);
}

/* Returns twice the area, the sum over all edges (the interior is on their left), with `bits` bits after the point;
 * exact, or too small by less than *lost units of the last bit. Most vertices of most shapes are plain numbers, whose
 * products, below 2^124, are summed separately until they overflow. */
static sunder_i_big sum_edges(sunder_i_arena *arena, const sunder_shape *shape, const sunder_i_placed *placed,
                              unsigned long bits, int64_t *lost)
{
    sunder_i_big sum = {NULL, 0}, plain = {NULL, 0};
    sunder_i_i128 run = 0;
    sunder_i_arena scratch;
    *lost = 0;
    sunder_i_arena_init(&scratch);
    for (uint32_t i = 0; i < shape->vertices && !arena->failed; i++) {
        const sunder_i_point a = placed->p[i], b = placed->p[shape->form->cleaned.next[i]];
        if (sunder_i_point_is_plain(a) && sunder_i_point_is_plain(b)) {
            const sunder_i_i128 term = sunder_i_det_i128(sunder_i_narrow_cross(a, b)), before = run;
            if (!__builtin_add_overflow(before, term, &run)) continue;
            plain = sunder_i_big_add(arena, plain, sunder_i_big_i128(arena, before));
            run = term;
            continue;
        }
        const sunder_i_mark mark = sunder_i_arena_mark(&scratch);
        const sunder_i_big term = edge_area(&scratch, &placed->lattice, a, b, bits, lost);
        /* copied, since a sum with zero is its other operand */
        sum = sunder_i_big_add(arena, sum, sunder_i_big_copy(arena, term));
        arena->failed |= scratch.failed;
        if (!scratch.failed) sunder_i_arena_release(&scratch, mark);
    }
    sunder_i_arena_free(&scratch);
    plain = sunder_i_big_add(arena, plain, sunder_i_big_i128(arena, run));
    return sunder_i_big_add(arena, sum, sunder_i_big_shl(arena, plain, bits));
}

/* The numerators of points with a common denominator. */
typedef struct common {
    sunder_i_big (*xy)[2], den;
} common;

static common over_one(sunder_i_arena *arena, const sunder_i_lattice *l, const sunder_i_point *at,
                       const uint32_t *corner, uint32_t n)
{
    common c = {sunder_i_arena_alloc(arena, n, sizeof *c.xy), sunder_i_big_i64(arena, 1)};
    for (uint32_t i = 0; i < n && !arena->failed; i++) {
        if (sunder_i_point_is_plain(at[corner[i]])) continue;
        const sunder_i_big w = sunder_i_rational_get(arena, l, at[corner[i]]).w;
        const sunder_i_big g = sunder_i_big_gcd(arena, c.den, w);
        if (!arena->failed) c.den = sunder_i_big_mul(arena, c.den, sunder_i_big_div_floor(arena, w, g));
    }
    for (uint32_t i = 0; i < n && !arena->failed; i++) {
        const sunder_i_rational_point v = sunder_i_rational_get(arena, l, at[corner[i]]);
        const sunder_i_big factor = sunder_i_big_is_one(v.w) ? c.den : sunder_i_big_div_floor(arena, c.den, v.w);
        c.xy[i][0] = sunder_i_big_mul(arena, v.x, factor);
        c.xy[i][1] = sunder_i_big_mul(arena, v.y, factor);
    }
    return c;
}

/* Returns twice the area, exactly, as a numerator over the square of *den. */
static sunder_i_big whole_area(sunder_i_arena *arena, const sunder_shape *shape, const sunder_i_placed *placed,
                               sunder_i_big *den)
{
    const uint32_t n = shape->piece_end[shape->pieces - 1];
    const common c = over_one(arena, &placed->lattice, placed->p, sunder_i_piece_vertices(shape), n);
    sunder_i_big sum = {NULL, 0};
    *den = c.den;
    for (uint32_t i = 0, first = 0; i < shape->pieces && !arena->failed; first = shape->piece_end[i++])
        for (uint32_t k = first; k < shape->piece_end[i]; k++) {
            const uint32_t next = k + 1 < shape->piece_end[i] ? k + 1 : first;
            sum = sunder_i_big_add(arena, sum,
                                   sunder_i_big_sub(arena, sunder_i_big_mul(arena, c.xy[k][0], c.xy[next][1]),
                                                    sunder_i_big_mul(arena, c.xy[k][1], c.xy[next][0])));
        }
    return sum;
}

/* Returns the area, rounded to the nearest double. An exact sum needs a common denominator of all vertices: a sum that
 * is rounded down suffices unless the area is the midpoint of two doubles, or too close to it. */
static double area_of(sunder_i_arena *arena, const sunder_shape *shape, const sunder_i_placed *placed)
{
    const long e = 2 * placed->lattice.exponent - 1;
    const sunder_i_big one = sunder_i_big_i64(arena, 1);
    for (unsigned long bits = 128; bits <= 2048; bits *= 4) {
        int64_t lost;
        const sunder_i_big low = sum_edges(arena, shape, placed, bits, &lost);
        const double area = sunder_i_big_ratio(arena, low, one, e - (long)bits);
        const sunder_i_big high = sunder_i_big_add(arena, low, sunder_i_big_i64(arena, lost));
        if (lost == 0 || sunder_i_big_ratio(arena, high, one, e - (long)bits) == area) return area;
    }
    sunder_i_big den;
    const sunder_i_big sum = whole_area(arena, shape, placed, &den);
    return arena->failed ? 0 : sunder_i_big_ratio(arena, sum, sunder_i_big_mul(arena, den, den), e);
}

/* ---- Anchor ---- */

/* Returns (num / den) * 2^exponent + origin, rounded to the nearest double. */
static double near_value(sunder_i_arena *arena, sunder_i_big num, sunder_i_big den, long exponent, double origin)
{
    int e;
    const sunder_i_big o = sunder_i_big_double(arena, origin, &e);
    if (o.size == 0) return sunder_i_big_ratio(arena, num, den, exponent);
    const long unit = exponent < e ? exponent : e;
    num = sunder_i_big_shl(arena, num, (unsigned long)(exponent - unit));
    const sunder_i_big shift = sunder_i_big_mul(arena, sunder_i_big_shl(arena, o, (unsigned long)(e - unit)), den);
    return sunder_i_big_ratio(arena, sunder_i_big_add(arena, num, shift), den, unit);
}

static bool find_anchor(const sunder_shape *shape, const sunder_i_placed *placed, sunder_i_arena *arena, double xy[2])
{
    sunder_i_rational_point *point = sunder_i_arena_alloc(arena, shape->vertices, sizeof *point);
    int8_t *side = sunder_i_arena_alloc(arena, shape->vertices, sizeof *side);
    sunder_i_level_crossing *crossing = sunder_i_arena_alloc(arena, 2 * (size_t)shape->vertices, sizeof *crossing);
    if (arena->failed) return false;
    for (uint32_t v = 0; v < shape->vertices; v++)
        point[v] = sunder_i_rational_get(arena, &placed->lattice, placed->p[v]);
    const sunder_i_boundary b = {.n = shape->vertices, .next = shape->form->cleaned.next, .point = point};
    sunder_i_widest_interval widest;
    sunder_i_widest_interval_find(&b, side, crossing, arena, &widest);
    if (arena->failed) return false;
    const sunder_i_rational_point at = sunder_i_widest_interval_middle(&b, &widest, arena);
    for (int k = 0; k < 2 && !arena->failed; k++)
        xy[k] = near_value(arena, sunder_i_rational_axis(&at, k), at.w, placed->lattice.exponent, placed->origin_p[k]);
    return !arena->failed;
}

bool sunder_i_shape_measure_pieces(sunder_shape *shape)
{
    sunder_i_placed placed;
    if (shape->pieces == 0) return true;
    if (sunder_i_place(shape, NULL, NULL, &placed, NULL)) return false;
    sunder_i_arena arena;
    sunder_i_arena_init(&arena);
    find_anchor(shape, &placed, &arena, shape->form->numbers->anchor);
    shape->form->numbers->area = area_of(&arena, shape, &placed);
    const bool good = !arena.failed && !placed.lattice.arena.failed;
    sunder_i_arena_free(&arena);
    sunder_i_placed_free(&placed);
    return good;
}
