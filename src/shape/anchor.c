/* The anchor of a shape: the centroid of its largest convex piece, to the nearest doubles.
 *
 * Over the fan of triangles o, a, b with u = a - o, v = b - o the centroid is o + sum (u + v) cross(u, v) / (3 sum
 * cross(u, v)). In doubles that quotient is known up to an error e; where o + (c - e) and o + (c + e) round to the same
 * double, so does what lies between them: on a map nearly always. Else it is worked out exactly: in words of 128 bits
 * where the piece is no more than 2^40 units of its lowest bit across, as a house is on a map, or with numbers of any
 * size.
 *
 * An anchor has no way to fail, so nothing is allocated for it: the numbers stand on the stack, and the range of
 * doubles bounds their size. Those of a rational shape, whose numbers nothing bounds, are worked out when it is made
 * (measure_rational.c). */
#include "number/wide.h"
#include "shape/shape.h"

#include <math.h>
#include <string.h>

/* ---- In doubles -------------------------------------------------------------------------------------------------- */

/* Sums over the fan: of the cross products and the moments as computed, and of what bounds their errors. */
typedef struct fan_sums {
    double weight, moment[2];
    double products, moments[2], size;
} fan_sums;

static void sum_fan(const sunder_shape *shape, const uint32_t *corner, uint32_t n, fan_sums *f)
{
    const double *o = shape->xy + 2 * (size_t)corner[0];
    *f = (fan_sums){0};
    for (uint32_t i = 1; i + 1 < n; i++) {
        const double *a = shape->xy + 2 * (size_t)corner[i], *b = shape->xy + 2 * (size_t)corner[i + 1];
        const double u[2] = {a[0] - o[0], a[1] - o[1]}, v[2] = {b[0] - o[0], b[1] - o[1]};
        const double left = u[0] * v[1], right = u[1] * v[0], cross = left - right, both = fabs(left) + fabs(right);
        f->weight += cross;
        f->products += both;
        for (int k = 0; k < 2; k++) {
            const double size = fabs(u[k]) + fabs(v[k]);
            f->moment[k] += cross * (u[k] + v[k]);
            f->moments[k] += both * size;
            f->size += size;
        }
    }
}

bool sunder_i_anchor_in_doubles(const sunder_shape *shape, const uint32_t *corner, uint32_t n, double xy[2])
{
    /* With eps = 2^-53: a difference is off by eps of itself, a cross product by less than 5 eps of its two products P
     * (2 eps of each by its differences, 1 by the product, 1 by the subtraction, and terms of eps^2), its moment by 9
     * eps of P (|u| + |v|), and a sum of m terms by m eps of the sum of their sizes more. (n + 10) 2^-52 of the sums of
     * sizes as computed, which are themselves right up to a part of 2^-25, is beyond both. So with the errors d of the
     * moment M and dw of the weight W, dw <= W / 2, the quotient M / (3 W) is off by less than (d + |M| / W dw) 2 / (3
     * W) and some eps of itself: the third that is left over pays for the roundings here. What underflows adds 2^-1073
     * for each product, times the sizes, over the weight: less than 2^-200 with the bounds asked for. */
    fan_sums f;
    if (n > UINT32_C(1) << 24) return false;
    sum_fan(shape, corner, n, &f);
    const double part = (n + 10) * 0x1p-52, error = part * f.products;
    if (!(f.weight > 0x1p-500 && error <= f.weight / 2 && f.size < 0x1p300)) return false;
    for (int k = 0; k < 2; k++) {
        const double c = f.moment[k] / (3 * f.weight);
        const double e =
            (part * f.moments[k] + fabs(f.moment[k]) / f.weight * error) / f.weight + 0x1p-50 * fabs(c) + 0x1p-200;
        const double o = shape->xy[2 * (size_t)corner[0] + (size_t)k];
        xy[k] = o + (c - e);
        if (!isfinite(xy[k]) || xy[k] != o + (c + e)) return false;
    }
    return true;
}

/* ---- Exactly, in words ------------------------------------------------------------------------------------------- */

/* With differences below 2^40 a cross product is below 2^81 and its moment below 2^122: so many corners make 30. */
enum { MOST_CORNERS = 32 };

/* A multiple of 2^unit, in these units. */
static bool in_units(double v, int unit, int64_t *out)
{
    const double scaled = ldexp(v, -unit);
    if (!(fabs(scaled) < 0x1p62)) return false;
    *out = (int64_t)scaled;
    return true;
}

/* (whole + r / d) 2^unit to the nearest double, for 0 <= r < d < 2^90; false where `whole` is 0. With 55 bits and
 * more before what is left, the last two of them are no bits of the double: so the last may stand for all that is
 * left. */
static bool round_ratio(uint64_t whole, sunder_i_u128 r, sunder_i_u128 d, int unit, double *out)
{
    int more = 0;
    if (whole == 0) return false;
    while (more < 54 && whole >> (54 - more) == 0) more++;
    if (d >> (126 - more) || unit - more < -1070) return false;
    r <<= more;
    whole = whole << more | (uint64_t)(r / d);
    *out = ldexp((double)(int64_t)(r % d ? whole | 1 : whole), unit - more);
    return isfinite(*out);
}

/* o + moment / weight in units of 2^unit, weight > 0; all far below their bounds. */
static bool round_sum(int64_t o, sunder_i_i128 moment, sunder_i_i128 weight, int unit, double *out)
{
    int64_t whole = o + (int64_t)(moment / weight);
    sunder_i_i128 left = moment % weight;
    if (left < 0) {
        left += weight;
        whole--;
    }
    const bool negative = whole < 0;
    if (negative && left) left = weight - left;
    const uint64_t size = negative ? (uint64_t)-whole - (left != 0) : (uint64_t)whole;
    if (!round_ratio(size, (sunder_i_u128)left, (sunder_i_u128)weight, unit, out)) return false;
    if (negative) *out = -*out;
    return true;
}

bool sunder_i_anchor_in_words(const sunder_shape *shape, const uint32_t *corner, uint32_t n, double xy[2])
{
    const int unit = shape->low_bit;
    int64_t o[2], u[2] = {0, 0};
    sunder_i_i128 weight = 0, moment[2] = {0, 0};
    if (n > MOST_CORNERS) return false;
    for (uint32_t i = 0; i < n; i++) {
        int64_t v[2];
        for (int k = 0; k < 2; k++) {
            int64_t at;
            if (!in_units(shape->xy[2 * (size_t)corner[i] + (size_t)k], unit, &at)) return false;
            if (i == 0) o[k] = at;
            v[k] = at - o[k];
            if (v[k] >= INT64_C(1) << 40 || -v[k] >= INT64_C(1) << 40) return false;
        }
        const sunder_i_i128 cross = (sunder_i_i128)u[0] * v[1] - (sunder_i_i128)u[1] * v[0];
        weight += cross;
        for (int k = 0; k < 2; k++) {
            moment[k] += cross * (u[k] + v[k]);
            u[k] = v[k];
        }
    }
    for (int k = 0; k < 2; k++)
        if (weight <= 0 || !round_sum(o[k], moment[k], 3 * weight, unit, &xy[k])) return false;
    return true;
}

/* ---- Exactly, on the stack --------------------------------------------------------------------------------------- */

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

void sunder_i_anchor_exactly(const sunder_shape *shape, const uint32_t *corner, uint32_t n, double xy[2])
{
    _Alignas(16) mp_limb_t memory[SCRATCH_LIMBS];
    sunder_i_arena arena;
    sunder_i_arena_init_on(&arena, memory, sizeof memory);
    const int unit = shape->low_bit;
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
        memcpy(xy, shape->form->numbers->anchor, sizeof shape->form->numbers->anchor);
        return;
    }
    uint32_t from;
    const uint32_t largest = sunder_i_largest_piece(shape, &from);
    const uint32_t *corner = sunder_i_piece_vertices(shape) + from, n = shape->piece_end[largest] - from;
    if (!sunder_i_anchor_in_doubles(shape, corner, n, xy) && !sunder_i_anchor_in_words(shape, corner, n, xy))
        sunder_i_anchor_exactly(shape, corner, n, xy);
}
