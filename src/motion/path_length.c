/* A leg's length is the root of a rational, floored to the bits asked for; a path's is the sum of these. With 256
 * significant bits and some for the sum of many legs, what is lost is far below half a unit in the last place of a
 * double: the sum is rounded to the nearest one, once. */
#include "motion/path_length.h"

#include <math.h>

/* Significant bits of a length: 256 asked for, and some for the sum of many legs. */
#define LENGTH_BITS 320

/* floor(2^bits * |b - a|) on the lattice: sqrt(4^bits |b - a|^2 w^2) / w, each floored, and floor(floor(r) / w) =
 * floor(r / w) for an integer w. Memory in the arena. */
static sunder_i_big leg_length(sunder_i_arena *m, const sunder_i_filtered_point *a, const sunder_i_filtered_point *b,
                               unsigned long bits)
{
    const sunder_i_rational_point d = sunder_i_rational_sub(m, b->at, a->at);
    const sunder_i_big square = sunder_i_rational_dot(m, d, d);
    if (m->failed) return (sunder_i_big){NULL, 0};
    return sunder_i_big_div_floor(m, sunder_i_big_sqrt_floor(m, sunder_i_big_shl(m, square, 2 * bits)), d.w);
}

unsigned long sunder_i_path_length_bits(const sunder_i_lattice *l, double length)
{
    int e = 0;
    frexp(length, &e);
    const long bits = LENGTH_BITS - (long)e - (long)l->approx_shift;
    return bits > 64 ? (unsigned long)bits : 64;
}

sunder_i_big sunder_i_path_length_scaled(sunder_i_arena *arena, const sunder_i_filtered_point *place,
                                         const uint32_t *place_of, const uint32_t *path, size_t n, unsigned long bits)
{
    sunder_i_big sum = sunder_i_big_i64(arena, 0);
    for (size_t i = 0; i + 1 < n; i++) {
        const uint32_t a = place_of ? place_of[path[i]] : path[i], b = place_of ? place_of[path[i + 1]] : path[i + 1];
        sum = sunder_i_big_add(arena, sum, leg_length(arena, &place[a], &place[b], bits));
    }
    return sum;
}

double sunder_i_path_length(const sunder_i_lattice *l, const sunder_i_filtered_point *place, const uint32_t *path,
                            size_t n)
{
    sunder_i_arena arena = {0};
    double about = 0;
    for (size_t i = 0; i + 1 < n; i++) {
        const sunder_i_filtered_point *a = &place[path[i]], *b = &place[path[i + 1]];
        about += hypot(a->ax - b->ax, a->ay - b->ay);
    }
    const unsigned long bits = sunder_i_path_length_bits(l, about);
    const sunder_i_big sum = sunder_i_path_length_scaled(&arena, place, NULL, path, n, bits);
    const double length = arena.failed
                              ? (double)NAN
                              : sunder_i_big_ratio(&arena, sum, sunder_i_big_i64(&arena, 1), l->exponent - (long)bits);
    sunder_i_arena_free(&arena);
    return length;
}
