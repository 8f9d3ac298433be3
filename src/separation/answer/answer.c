/* answer.c: converts exact vectors to the nearest doubles, and doubles to exact vectors.
 *
 * A coordinate is num / den * 2^e and is rounded once; a length is the square root of such a number (root.c). Small
 * numbers are first tried in machine arithmetic, which returns the same result or fails. */
#include "separation/answer/answer.h"

#include "separation/answer/root.h"

#include <math.h>
#include <string.h>

static bool fits_63_bits(const sunder_i_i256 *v)
{
    return !(v->limb[1] | v->limb[2] | v->limb[3]) && v->limb[0] >> 63 == 0;
}

bool sunder_i_hpoint_is_short(const sunder_i_hpoint *point)
{
    return point->w != 0 && fits_63_bits(&point->x) && fits_63_bits(&point->y) && point->w >> 63 == 0;
}

sunder_i_exact_translation sunder_i_exact_translation_of(sunder_i_operands *operands, const sunder_i_hpoint *point)
{
    sunder_i_lattice *l = &operands->placed.lattice;
    sunder_i_exact_translation v;
    memset(&v, 0, sizeof v);
    if (sunder_i_hpoint_is_short(point)) {
        v.small = true;
        v.x = (sunder_i_i128)point->x.sign * (int64_t)point->x.limb[0];
        v.y = (sunder_i_i128)point->y.sign * (int64_t)point->y.limb[0];
        v.w = point->w;
        return v;
    }
    v.big = sunder_i_hpoint_read(&l->arena, l, point);
    return v;
}

sunder_i_rational_point sunder_i_exact_translation_point(sunder_i_operands *operands,
                                                         const sunder_i_exact_translation *v)
{
    sunder_i_arena *a = &operands->placed.lattice.arena;
    if (!v->small) return v->big;
    return (sunder_i_rational_point){sunder_i_big_i128(a, v->x), sunder_i_big_i128(a, v->y),
                                     sunder_i_big_i128(a, v->w)};
}

/* ---- Doubles ---- */

/* *out becomes num / den * 2^exponent, correctly rounded, by one division of doubles. Returns false if a number is too
 * large for that. */
static bool quick_ratio(sunder_i_i128 num, sunder_i_i128 den, long exponent, double *out)
{
    const sunder_i_i128 most = (sunder_i_i128)1 << 53;
    if (num > most || num < -most || den > most || exponent < -800 || exponent > 800) return false;
    *out = (double)(int64_t)num / (double)(int64_t)den * sunder_i_power_of_two(exponent);
    return true; /* the quotient is 0 or between 2^-53 and 2^53 in absolute value: scaling is exact */
}

void sunder_i_answer_numbers(sunder_i_operands *operands, const sunder_i_exact_translation *v, sunder_separation *out)
{
    sunder_i_lattice *l = &operands->placed.lattice;
    const long e = l->exponent;
    if (v->small && quick_ratio(v->x, v->w, e, &out->dx) && quick_ratio(v->y, v->w, e, &out->dy)) {
        const sunder_i_u128 n = (sunder_i_u128)(v->x * v->x) + (sunder_i_u128)(v->y * v->y);
        if (sunder_i_quick_root(n, (int64_t)v->w, e, &out->distance, &out->lower_bound)) return;
    }
    const sunder_i_rational_point big = sunder_i_exact_translation_point(operands, v);
    sunder_i_rational_doubles(&l->arena, big, e, &out->dx, &out->dy);
    sunder_i_root(&l->arena, sunder_i_rational_dot(&l->arena, big, big), big.w, e, &out->distance, &out->lower_bound);
}

/* ---- Doubles as exact vectors ---- */

/* Returns the integer num and sets *bits such that the double v is num / 2^bits lattice units. */
static sunder_i_big in_units(sunder_i_lattice *l, double v, unsigned long *bits)
{
    int e;
    *bits = 0;
    const sunder_i_big m = sunder_i_big_double(&l->arena, v, &e);
    const long shift = (long)e - l->exponent;
    if (m.size == 0) return m;
    if (shift >= 0) return sunder_i_big_shl(&l->arena, m, (unsigned long)shift);
    *bits = (unsigned long)-shift;
    return m;
}

sunder_i_rational_point sunder_i_doubles_point(sunder_i_operands *operands, double dx, double dy)
{
    sunder_i_lattice *l = &operands->placed.lattice;
    unsigned long bx, by;
    const sunder_i_big u = in_units(l, dx, &bx), v = in_units(l, dy, &by);
    const unsigned long bits = bx > by ? bx : by;
    return (sunder_i_rational_point){sunder_i_big_shl(&l->arena, u, bits - bx),
                                     sunder_i_big_shl(&l->arena, v, bits - by),
                                     sunder_i_big_shl(&l->arena, sunder_i_big_i64(&l->arena, 1), bits)};
}

bool sunder_i_answer_exact(sunder_i_operands *operands, const sunder_i_exact_translation *v, double dx, double dy)
{
    sunder_i_lattice *l = &operands->placed.lattice;
    if (!isfinite(dx) || !isfinite(dy)) return false;
    if (v->small && l->exponent > -400 && l->exponent < 400) {
        /* fma() rounds the product and difference once, hence it is 0 exactly if the two are equal */
        const sunder_i_i128 most = (sunder_i_i128)1 << 53;
        const double w = (double)(int64_t)v->w;
        if (v->w < most && v->x < most && v->x > -most && v->y < most && v->y > -most) {
            const double scale = sunder_i_power_of_two(-l->exponent);
            return fma(dx * scale, w, -(double)(int64_t)v->x) == 0 && fma(dy * scale, w, -(double)(int64_t)v->y) == 0;
        }
    }
    const sunder_i_rational_point big = sunder_i_exact_translation_point(operands, v);
    const double d[2] = {dx, dy};
    for (int k = 0; k < 2; k++) {
        unsigned long bits;
        const sunder_i_big u = sunder_i_big_mul(&l->arena, in_units(l, d[k], &bits), big.w);
        if (sunder_i_big_cmp(u, sunder_i_big_shl(&l->arena, sunder_i_rational_axis(&big, k), bits))) return false;
    }
    return true;
}

/* ---- Answers without a search ---- */

void sunder_separation_clear(sunder_separation *separation)
{
    if (!separation) return;
    sunder_i_free(separation->dx_text); /* the block that also holds the other two texts */
    separation->dx_text = separation->dy_text = separation->distance_squared_text = NULL;
}

sunder_status sunder_i_stay(bool texts, sunder_separation *out, sunder_error *err)
{
    out->attained = out->rounded_is_free = true;
    out->contact = SUNDER_CONTACT_NONE;
    if (!texts) return SUNDER_OK;
    char *block = sunder_i_alloc(6, 1);
    if (!block) return sunder_i_failure_cause(err);
    memcpy(block, "0\0000\0000", 6);
    out->dx_text = block;
    out->dy_text = block + 2;
    out->distance_squared_text = block + 4;
    return SUNDER_OK;
}

void sunder_i_too_far(double upper, sunder_separation *out, bool *beyond)
{
    *beyond = true;
    out->overlap = true;
    out->attained = false;
    out->lower_bound = upper;
}
