/* root.c: see root.h. Such a root is irrational as a rule. Its floor with more bits than a double has, followed by one
 * bit that says whether anything was cut off, is rounded like the root itself. For small numbers the sum of two doubles
 * approximates the root so closely that the rounding is certain, except in rare cases. The results are the same on
 * every machine, unlike those of extended formats. */
#include "separation/answer/root.h"

#include "number/lattice.h"
#include "spatial/box.h"

#include <math.h>

void sunder_i_root(sunder_i_arena *a, sunder_i_big n, sunder_i_big w, long exponent, double *nearest, double *down)
{
    if (sunder_i_big_sign(n) == 0) {
        *nearest = *down = 0;
        return;
    }
    const long have = (long)(sunder_i_big_bits(n) / 2) - (long)sunder_i_big_bits(w);
    const long k = have < 72 ? 72 - have : 0;
    const sunder_i_big scaled = sunder_i_big_shl(a, n, 2 * (unsigned long)k);
    const sunder_i_big q = sunder_i_big_div_floor(a, sunder_i_big_sqrt_floor(a, scaled), w);
    const sunder_i_big qw = sunder_i_big_mul(a, q, w);
    const bool exact = sunder_i_big_cmp(sunder_i_big_mul(a, qw, qw), scaled) == 0;
    const sunder_i_big one = sunder_i_big_i64(a, 1);
    sunder_i_big twice = sunder_i_big_shl(a, q, 1);
    if (!exact) twice = sunder_i_big_add(a, twice, one);
    *nearest = sunder_i_big_ratio(a, twice, one, exponent - k - 1);
    *down = sunder_i_big_ratio_down(a, twice, one, exponent - k - 1);
}

/* ---- In doubles -------------------------------------------------------------------------------------------------- */

/* Returns d, the double nearest to the computed sum d + *rest, which is sqrt(n) / w with a relative error of at most
 * 2^-102.
 *
 * With u = 2^-53: n is exactly high + low, and s s is exactly p + e. Their difference has an error of 7 u^2 n, hence
 * the correction of s one of 3.5 u^2 s; the division adds 2 u^2 s, and the neglected term of Newton's method is 2 u^2
 * s. The remainder of the division of s by w is exact, its sum with the correction has an error of 3 u^2 s, and the
 * last division adds as much: less than 14 u^2 in all. */
static double root_over(sunder_i_u128 n, double w, double *rest)
{
    const double high = (double)n, low = (double)(int64_t)(n - (sunder_i_u128)high);
    const double s = sqrt(high), p = s * s, e = fma(s, s, -p);
    const double correction = (((high - p) - e) + low) / (2 * s);
    const double q = s / w, more = (fma(-q, w, s) + correction) / w;
    const double d = q + more;
    *rest = more - (d - q);
    return d;
}

/* Compares r = sqrt(n) / w with the double d, which is so close to r that two doubles do not separate them: returns 1
 * if r >= d, -1 if r <= d, and 0 if unknown. It uses the integer nearest to d w: if that lies between d w and sqrt(n),
 * or equals one of them, the order is known. This decides the usual case, in which the length is a double because n is
 * a square. */
static int compare_root(sunder_i_u128 n, double w, double d)
{
    const uint64_t between = (uint64_t)(d * w + 0.5); /* below 2^54 */
    const double beyond = fma(d, w, -(double)between);
    const sunder_i_u128 square = (sunder_i_u128)between * between;
    if (beyond <= 0 && square <= n) return 1;
    return beyond >= 0 && square >= n ? -1 : 0;
}

bool sunder_i_quick_root(sunder_i_u128 n, int64_t w, long exponent, double *nearest, double *down)
{
    if (exponent < -400 || exponent > 400) return false;
    if (n == 0) {
        *nearest = *down = 0;
        return true;
    }
    double rest;
    const double d = root_over(n, (double)w, &rest), doubt = d * 0x1p-100;
    const double below = sunder_i_box_step(d, false);
    if (rest > (sunder_i_box_step(d, true) - d) / 2 - doubt || rest < doubt - (d - below) / 2) return false;
    int order = rest > doubt ? 1 : -1;
    if (fabs(rest) <= doubt) order = compare_root(n, (double)w, d);
    /* the root lies between 2^-54 and 2^54: scaling is exact */
    *nearest = d * sunder_i_power_of_two(exponent);
    *down = (order > 0 ? d : below) * sunder_i_power_of_two(exponent);
    return order != 0;
}
