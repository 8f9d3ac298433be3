/* doubles_free.c: tests whether the doubles nearest to a translation are free, too. A double is an integer divided by a
 * power of two on the lattice; doubles are tried first, then 128-bit integers if the numbers fit, else big integers. */
#include "separation/penetration/penetration_search.h"

#include "predicate/rational_point.h"
#include "separation/answer/answer.h"

#include <math.h>
#include <string.h>

typedef struct dyadic {
    double ax, ay; /* in units */
    bool native;   /* the integers x, y and bits represent the point; else `big` does */
    sunder_i_i128 x, y;
    unsigned bits;               /* x / 2^bits, y / 2^bits */
    sunder_i_rational_point big; /* used unless native */
} dyadic;

/* Represents v as m 2^f lattice units with |m| < 2^53. Returns false if v is subnormal or f is out of range. */
static bool native_units(double v, long exponent, int64_t *m, long *f)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    const int field = (int)(bits >> 52 & 0x7ff);
    *m = 0;
    *f = 0;
    if (v == 0) return true;
    if (field == 0) return false; /* subnormal numbers have fewer digits */
    const uint64_t magnitude = (bits & (((uint64_t)1 << 52) - 1)) | (uint64_t)1 << 52;
    const int z = __builtin_ctzll(magnitude);
    *m = (int64_t)(magnitude >> z);
    if (v < 0) *m = -*m;
    *f = field - 1075 + z - exponent;
    return *f > -64 && *f < 64;
}

static dyadic dyadic_of(sunder_i_operands *g, double dx, double dy)
{
    sunder_i_lattice *l = &g->placed.lattice;
    dyadic d;
    d.native = false;
    int64_t mx, my;
    long fx, fy;
    if (l->small && l->approx_shift == 0 && native_units(dx, l->exponent, &mx, &fx) &&
        native_units(dy, l->exponent, &my, &fy)) {
        const long low = fx < fy ? fx < 0 ? fx : 0 : fy < 0 ? fy : 0;
        if (fx - low < 70 && fy - low < 70) {
            d.native = true;
            d.bits = (unsigned)-low;
            d.x = mx * ((sunder_i_i128)1 << (fx - low));
            d.y = my * ((sunder_i_i128)1 << (fy - low));
            d.ax = (double)mx * sunder_i_power_of_two(fx);
            d.ay = (double)my * sunder_i_power_of_two(fy);
            return d;
        }
    }
    d.big = sunder_i_doubles_point(g, dx, dy);
    sunder_i_rational_doubles(&l->arena, d.big, -l->approx_shift, &d.ax, &d.ay);
    return d;
}

/* Compares the point with side k of the subsum: +1 on its left, 0 on its line, -1 on its right. Exact. */
static int dyadic_side(sunder_i_operands *g, const dyadic *d, const sunder_i_subsum *s, uint32_t k)
{
    sunder_i_lattice *l = &g->placed.lattice;
    l->counts.orientation_tests++;
    l->counts.exact_fallbacks++;
    if (d->native && sunder_i_point_is_plain(s->corner[k]) && sunder_i_point_is_plain(s->side[k])) {
        /* |corner| < 2^61 and bits < 64, so that differences are below 2^126 */
        const sunder_i_i128 one = (sunder_i_i128)1 << d->bits;
        const sunder_i_i128 x = d->x - s->corner[k].x * one, y = d->y - s->corner[k].y * one;
        const sunder_i_i128 most = (sunder_i_i128)1 << 94;
        /* times a side, which is below 2^30, this is below 2^124 */
        if (g->brief && x < most && x > -most && y < most && y > -most)
            return sunder_i_i128_sign(s->side[k].x * y - s->side[k].y * x);
        return sunder_i_cmp_products(s->side[k].x, y, s->side[k].y, x);
    }
    if (l->arena.failed) return 0;
    const sunder_i_mark mark = sunder_i_lattice_begin(l);
    sunder_i_arena *m = &l->scratch;
    sunder_i_rational_point at = d->big;
    if (d->native)
        at = (sunder_i_rational_point){sunder_i_big_i128(m, d->x), sunder_i_big_i128(m, d->y),
                                       sunder_i_big_shl(m, sunder_i_big_i64(m, 1), d->bits)};
    const sunder_i_rational_point v = sunder_i_rational_sub(m, at, sunder_i_rational_get(m, l, s->corner[k]));
    const int sign = sunder_i_rational_cross_sign(m, sunder_i_rational_get(m, l, s->side[k]), v);
    sunder_i_lattice_end(l, mark);
    return sign;
}

static bool is_inside(sunder_i_operands *g, const dyadic *d, const sunder_i_subsum *s)
{
    if (s->sides <= SUNDER_I_SIDES_IN_A_WORD) {
        uint32_t doubt;
        if (!sunder_i_subsum_may_hold(s, d->ax, d->ay, 1, &doubt)) return false;
        for (; doubt; doubt &= doubt - 1)
            if (dyadic_side(g, d, s, (uint32_t)__builtin_ctz(doubt)) <= 0) return false;
        return true;
    }
    for (uint32_t k = 0; k < s->sides; k++) {
        const double v = s->sx[k] * (d->ay - s->cy[k]) - s->sy[k] * (d->ax - s->cx[k]);
        if (!(v > s->bound[k] || (v >= -s->bound[k] && dyadic_side(g, d, s, k) > 0))) return false;
    }
    return true;
}

bool sunder_i_doubles_free(sunder_i_operands *operands, const sunder_i_free_point *nearest,
                           const sunder_i_near_subsums *near, double dx, double dy)
{
    if (!isfinite(dx) || !isfinite(dy)) return false;
    const dyadic d = dyadic_of(operands, dx, dy);
    /* As close to the exact point as its error, which holds unless doubles are at the end of their range: it is clear
     * of all subsums that the exact point is clear of. */
    if (fabs(d.ax - nearest->x) <= operands->error / 2 && fabs(d.ay - nearest->y) <= operands->error / 2) {
        for (size_t n = 0; n < near->n; n++)
            if (is_inside(operands, &d, operands->subsum + near->subsum[n])) return false;
        return true;
    }
    for (size_t n = 0; n < operands->subsums; n++) {
        sunder_i_subsum *s = operands->subsum + n;
        if (!sunder_i_box_near_point(s->box, d.ax, d.ay, operands->error)) continue;
        if (!s->sides && !sunder_i_subsum_make(operands, s)) return false;
        if (is_inside(operands, &d, s)) return false;
    }
    return true;
}
