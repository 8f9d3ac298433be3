/* What a shape says of itself: counts, box, area, anchor.
 *
 * Area and anchor have no way to fail, so nothing is allocated for them: where coordinates are doubles the area is a
 * sum of products of doubles in fixed memory, and the anchor is worked out on the stack, in numbers whose size the
 * range of doubles bounds. Those of a rational shape, whose numbers nothing bounds, are worked out when it is made
 * (measure_rational.c). */
#include "shape/shape.h"

#include "number/accumulator.h"

#include <math.h>
#include <string.h>

size_t sunder_shape_polygons(const sunder_shape *shape) { return shape->polygons; }
size_t sunder_shape_vertices(const sunder_shape *shape) { return shape->vertices; }
bool sunder_shape_is_empty(const sunder_shape *shape) { return shape->polygons == 0; }
bool sunder_shape_repaired(const sunder_shape *shape) { return shape->repaired; }

bool sunder_shape_touches(const sunder_shape *shape) { return shape->touches; }
void sunder_shape_box(const sunder_shape *shape, double box[4]) { memcpy(box, shape->box, sizeof shape->box); }

/* Rings run with the interior on their left, so their signed areas add up to that of the members. */
double sunder_shape_area(const sunder_shape *shape)
{
    if (shape->rational) return shape->area;
    sunder_i_accumulator twice = {{0}};
    for (uint32_t i = 0; i < shape->vertices; i++) {
        const double *a = shape->xy + 2 * (size_t)i, *b = shape->xy + 2 * (size_t)shape->next[i];
        sunder_i_accumulator_add(&twice, a[0], b[1]);
        sunder_i_accumulator_sub(&twice, a[1], b[0]);
    }
    return sunder_i_accumulator_double(&twice, -1);
}

/* Area of a convex piece in doubles, from its first corner, so that far origins cost no digits. */
static double rough_area(const sunder_shape *shape, const uint32_t *corner, uint32_t n)
{
    const double *o = shape->xy + 2 * (size_t)corner[0];
    double sum = 0;
    for (uint32_t i = 1; i + 1 < n; i++) {
        const double *a = shape->xy + 2 * (size_t)corner[i], *b = shape->xy + 2 * (size_t)corner[i + 1];
        sum += (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
    }
    return sum;
}

uint32_t sunder_i_largest_piece(const sunder_shape *shape, uint32_t *from)
{
    double most = -1;
    uint32_t largest = 0;
    *from = 0;
    for (uint32_t i = 0, at = 0; i < shape->pieces; at = shape->piece_end[i++]) {
        const double area = rough_area(shape, shape->piece_vertex + at, shape->piece_end[i] - at);
        if (!(area > most)) continue;
        most = area;
        largest = i;
        *from = at;
    }
    return largest;
}

/* ---- The anchor on the stack ---- */

/* In units of the lowest bit, 2^-1074 or above, coordinates are below 2^2098, their differences below 2^2099: 33 limbs.
 * A cross product has 66 and a sign's bit, a moment 99 and some; sums over a piece add 27 bits at most. */
enum {
    MOMENT_LIMBS = 102,
    /* One corner takes 4 differences of 5 numbers each (700 limbs) and 7 products and sums of at most 102 limbs; the
     * quotients at the end 8 numbers of at most 140. */
    SCRATCH_LIMBS = 3072
};

/* a - b in units of 2^unit. */
static sunder_i_big difference(sunder_i_arena *arena, double a, double b, int unit)
{
    int e, f;
    sunder_i_big u = sunder_i_big_double(arena, a, &e), v = sunder_i_big_double(arena, b, &f);
    if (u.size) u = sunder_i_big_shl(arena, u, (unsigned long)(e - unit));
    if (v.size) v = sunder_i_big_shl(arena, v, (unsigned long)(f - unit));
    return sunder_i_big_sub(arena, u, v);
}

/* A sum that outlives the scratch. */
typedef struct kept {
    mp_limb_t limb[MOMENT_LIMBS];
    sunder_i_big value;
} kept;

static void keep(kept *k, sunder_i_big value)
{
    const size_t n = (size_t)(value.size < 0 ? -value.size : value.size);
    if (n) memcpy(k->limb, value.limb, n * sizeof *k->limb);
    k->value = (sunder_i_big){k->limb, value.size};
}

/* The centroid of a piece: over the fan of triangles o, a, b with u = a - o, v = b - o it is
 * o + sum (u + v) cross(u, v) / (3 sum cross(u, v)). */
static void centroid_of_doubles(const sunder_shape *shape, const uint32_t *corner, uint32_t n, double xy[2])
{
    _Alignas(16) mp_limb_t memory[SCRATCH_LIMBS];
    sunder_i_arena arena;
    sunder_i_arena_init_on(&arena, memory, sizeof memory);
    const int unit = shape->extent.low_bit;
    const double *o = shape->xy + 2 * (size_t)corner[0];
    kept weight, moment[2];
    keep(&weight, (sunder_i_big){NULL, 0});
    keep(&moment[0], weight.value);
    keep(&moment[1], weight.value);
    const sunder_i_mark mark = sunder_i_arena_mark(&arena);
    for (uint32_t i = 1; i + 1 < n; i++) {
        const double *a = shape->xy + 2 * (size_t)corner[i], *b = shape->xy + 2 * (size_t)corner[i + 1];
        sunder_i_big u[2], v[2];
        for (int k = 0; k < 2; k++) {
            u[k] = difference(&arena, a[k], o[k], unit);
            v[k] = difference(&arena, b[k], o[k], unit);
        }
        const sunder_i_big cross =
            sunder_i_big_sub(&arena, sunder_i_big_mul(&arena, u[0], v[1]), sunder_i_big_mul(&arena, u[1], v[0]));
        keep(&weight, sunder_i_big_add(&arena, weight.value, cross));
        for (int k = 0; k < 2; k++) {
            const sunder_i_big m = sunder_i_big_mul(&arena, cross, sunder_i_big_add(&arena, u[k], v[k]));
            keep(&moment[k], sunder_i_big_add(&arena, moment[k].value, m));
        }
        sunder_i_arena_release(&arena, mark);
    }
    const sunder_i_big den = sunder_i_big_mul(&arena, weight.value, sunder_i_big_i64(&arena, 3));
    const sunder_i_mark after = sunder_i_arena_mark(&arena);
    for (int k = 0; k < 2; k++) {
        const sunder_i_big start = sunder_i_big_mul(&arena, den, difference(&arena, o[k], 0, unit));
        xy[k] = sunder_i_big_ratio(&arena, sunder_i_big_add(&arena, start, moment[k].value), den, unit);
        sunder_i_arena_release(&arena, after);
    }
    sunder_i_arena_free(&arena);
}

void sunder_shape_anchor(const sunder_shape *shape, double xy[2])
{
    xy[0] = xy[1] = 0;
    if (shape->pieces == 0) return;
    if (shape->rational) {
        memcpy(xy, shape->anchor, sizeof shape->anchor);
        return;
    }
    uint32_t from;
    const uint32_t largest = sunder_i_largest_piece(shape, &from);
    centroid_of_doubles(shape, shape->piece_vertex + from, shape->piece_end[largest] - from, xy);
}
