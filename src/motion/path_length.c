/* path_length.c: the length of a leg is the square root of a rational number, rounded down to a given number of bits;
 * that of a path is the sum of these. With LENGTH_BITS significant bits the error is far below half a unit in the last
 * place of a double: the sum is rounded to the nearest double, once. */
#include "motion/path_length.h"

#include <limits.h>
#include <math.h>

/* The significant bits of a length: 256, and some more for the sum of many legs. */
#define LENGTH_BITS 320

/* Returns floor(2^bits * |b - a|) on the lattice: sqrt(4^bits |b - a|^2 w^2) / w, each rounded down; this is correct,
 * since floor(floor(r) / w) = floor(r / w) for an integer w. Memory is from the arena. */
static sunder_i_big leg_length(sunder_i_arena *m, const sunder_i_filtered_point *a, const sunder_i_filtered_point *b,
                               unsigned long bits)
{
    const sunder_i_rational_point d = sunder_i_rational_sub(m, b->at, a->at);
    const sunder_i_big square = sunder_i_rational_dot(m, d, d);
    if (m->failed) return (sunder_i_big){NULL, 0};
    return sunder_i_big_div_floor(m, sunder_i_big_sqrt_floor(m, sunder_i_big_shl(m, square, 2 * bits)), d.w);
}

static const sunder_i_filtered_point *place_at(const sunder_i_path *path, size_t i)
{
    return &path->place[path->place_of ? path->place_of[path->node[i]] : path->node[i]];
}

/* Returns the approximate length of the path, in units of sunder_i_approx(). */
static double length_in_doubles(const sunder_i_path *path)
{
    double length = 0;
    for (size_t i = 0; i + 1 < path->n; i++) {
        const sunder_i_filtered_point *a = place_at(path, i), *b = place_at(path, i + 1);
        length += hypot(a->ax - b->ax, a->ay - b->ay);
    }
    return length;
}

/* Returns an approximation of the binary logarithm of the longest leg on the lattice; 0 if all legs have length 0. */
static long exponent_of(sunder_i_arena *m, const sunder_i_path *path)
{
    long most = LONG_MIN;
    for (size_t i = 0; i + 1 < path->n; i++) {
        const sunder_i_rational_point d = sunder_i_rational_sub(m, place_at(path, i + 1)->at, place_at(path, i)->at);
        if (m->failed) return 0;
        const unsigned long x = sunder_i_big_bits(d.x), y = sunder_i_big_bits(d.y), w = sunder_i_big_bits(d.w);
        if (x == 0 && y == 0) continue;
        const long e = (long)(x > y ? x : y) - (long)w;
        most = e > most ? e : most;
    }
    return most == LONG_MIN ? 0 : most;
}

/* If a path is short and far from the origin, its positions may be equal or adjacent in doubles: then the exponent is
 * computed from the exact numbers. */
unsigned long sunder_i_path_length_bits(const sunder_i_filter *filter, sunder_i_arena *arena, const sunder_i_path *path)
{
    const double length = length_in_doubles(path);
    int e = 0;
    frexp(length, &e);
    const bool known = length > 0x1p10 * filter->error * (double)path->n;
    const long bits = LENGTH_BITS - (known ? (long)e + (long)filter->lattice->approx_shift : exponent_of(arena, path));
    return bits > 64 ? (unsigned long)bits : 64;
}

sunder_i_big sunder_i_path_length_scaled(sunder_i_arena *arena, const sunder_i_path *path, unsigned long bits)
{
    sunder_i_big sum = sunder_i_big_i64(arena, 0);
    for (size_t i = 0; i + 1 < path->n; i++)
        sum = sunder_i_big_add(arena, sum, leg_length(arena, place_at(path, i), place_at(path, i + 1), bits));
    return sum;
}

double sunder_i_path_length(const sunder_i_filter *filter, const sunder_i_path *path)
{
    sunder_i_arena arena = {0};
    const unsigned long bits = sunder_i_path_length_bits(filter, &arena, path);
    const sunder_i_big sum = sunder_i_path_length_scaled(&arena, path, bits);
    const double length = arena.failed ? (double)NAN
                                       : sunder_i_big_ratio(&arena, sum, sunder_i_big_i64(&arena, 1),
                                                            filter->lattice->exponent - (long)bits);
    sunder_i_arena_free(&arena);
    return length;
}
