#include "separation/answer/answer.h"

#include "predicate/vector.h"

#include <float.h>
#include <math.h>
#include <string.h>

static bool fits(const sunder_i_i256 *v) { return !(v->limb[1] | v->limb[2] | v->limb[3]) && v->limb[0] >> 63 == 0; }

sunder_i_vector_exact sunder_i_vector_of(sunder_i_operands *g, const sunder_i_hpoint *p)
{
    sunder_i_lattice *l = &g->placed.lattice;
    sunder_i_vector_exact v;
    memset(&v, 0, sizeof v);
    if (p->w != 0 && fits(&p->x) && fits(&p->y) && p->w >> 63 == 0) {
        v.small = true;
        v.x = (sunder_i_i128)p->x.sign * (int64_t)p->x.limb[0];
        v.y = (sunder_i_i128)p->y.sign * (int64_t)p->y.limb[0];
        v.w = p->w;
        return v;
    }
    sunder_i_hpoint_big(l, p, &v.bx, &v.by, &v.bw);
    return v;
}

sunder_i_vector_exact sunder_i_vector_big(sunder_i_big x, sunder_i_big y, sunder_i_big w)
{
    sunder_i_vector_exact v;
    memset(&v, 0, sizeof v);
    v.bx = x;
    v.by = y;
    v.bw = w;
    return v;
}

static void big_parts(sunder_i_operands *g, const sunder_i_vector_exact *v, sunder_i_big *x, sunder_i_big *y,
                      sunder_i_big *w)
{
    sunder_i_lattice *l = &g->placed.lattice;
    *x = v->small ? sunder_i_big_i128(&l->arena, v->x) : v->bx;
    *y = v->small ? sunder_i_big_i128(&l->arena, v->y) : v->by;
    *w = v->small ? sunder_i_big_i128(&l->arena, v->w) : v->bw;
}

/* ---- Nothing to do, or too much ---- */

void sunder_separation_clear(sunder_separation *separation)
{
    if (!separation) return;
    sunder_i_free(separation->dx_text);
    sunder_i_free(separation->dy_text);
    sunder_i_free(separation->distance_squared_text);
    separation->dx_text = separation->dy_text = separation->distance_squared_text = NULL;
}

sunder_status sunder_i_stay(bool texts, sunder_separation *out, sunder_error *err)
{
    out->attained = out->rounded_is_free = true;
    out->contact = SUNDER_CONTACT_NONE;
    if (!texts) return SUNDER_OK;
    char **text[3] = {&out->dx_text, &out->dy_text, &out->distance_squared_text};
    for (int i = 0; i < 3; i++) {
        *text[i] = sunder_i_alloc(2, 1);
        if (!*text[i]) {
            sunder_separation_clear(out);
            return sunder_i_no_memory(err);
        }
        memcpy(*text[i], "0", 2);
    }
    return SUNDER_OK;
}

void sunder_i_too_far(double upper, sunder_separation *out, bool *beyond)
{
    *beyond = true;
    out->overlap = true;
    out->attained = false;
    out->lower_bound = upper;
}

/* ---- Doubles ---- */

/* num / den * 2^exponent where all is small enough for one correctly rounded division; false where it is not. */
static bool quick_ratio(sunder_i_i128 num, sunder_i_i128 den, long exponent, double *out)
{
    const sunder_i_i128 most = (sunder_i_i128)1 << 53;
    if (num > most || num < -most || den > most || exponent < -800 || exponent > 800) return false;
    *out = ldexp((double)(int64_t)num / (double)(int64_t)den, (int)exponent);
    return true; /* the quotient lies between 2^-53 and 2^53: scaling is exact */
}

/* sqrt(n) / w * 2^exponent, from long doubles: correctly rounded where they leave no doubt. Every step is off by at
 * most half an ulp of the format (2^-64 relative), four steps in all. */
static bool quick_root(sunder_i_u128 n, sunder_i_i128 w, long exponent, double *nearest, double *down)
{
    if (LDBL_MANT_DIG < 64 || exponent < -400 || exponent > 400) return false;
    const long double wide = (long double)(uint64_t)(n >> 64) * 0x1p64L + (long double)(uint64_t)n;
    const long double root = sqrtl(wide) / (long double)(int64_t)w;
    const double d = (double)root;
    const long double doubt = root * 0x1p-61L, off = root - d;
    const long double half_ulp = (long double)(nextafter(d, INFINITY) - d) / 2;
    const long double half_below = (long double)(d - nextafter(d, 0)) / 2;
    if (off > half_ulp - doubt || off < doubt - half_below) return false;
    *nearest = ldexp(d, (int)exponent);
    *down = ldexp(off > doubt ? d : nextafter(d, 0), (int)exponent);
    return true;
}

/* The same of any size: floor of the root to 70 bits or more, with a sticky bit beneath, rounds like the root itself.
 */
static void slow_root(sunder_i_arena *a, sunder_i_big n, sunder_i_big w, long exponent, double *nearest, double *down)
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

void sunder_i_answer_numbers(sunder_i_operands *g, const sunder_i_vector_exact *v, sunder_separation *out)
{
    sunder_i_lattice *l = &g->placed.lattice;
    const long e = l->exponent;
    if (v->small && quick_ratio(v->x, v->w, e, &out->dx) && quick_ratio(v->y, v->w, e, &out->dy)) {
        const sunder_i_u128 n = (sunder_i_u128)(v->x * v->x) + (sunder_i_u128)(v->y * v->y);
        if (quick_root(n, v->w, e, &out->distance, &out->lower_bound)) return;
    }
    sunder_i_big x, y, w;
    big_parts(g, v, &x, &y, &w);
    out->dx = sunder_i_big_ratio(&l->arena, x, w, e);
    out->dy = sunder_i_big_ratio(&l->arena, y, w, e);
    slow_root(&l->arena, sunder_i_big_norm(&l->arena, x, y), w, e, &out->distance, &out->lower_bound);
}

/* ---- Texts ---- */

static unsigned twos(sunder_i_u128 v)
{
    const uint64_t low = (uint64_t)v;
    return low ? (unsigned)__builtin_ctzll(low) : 64 + (unsigned)__builtin_ctzll((uint64_t)(v >> 64));
}

/* Binary greatest common divisor of odd numbers. */
static sunder_i_u128 odd_gcd(sunder_i_u128 a, sunder_i_u128 b)
{
    while (a != b && (a >> 64 || b >> 64)) {
        if (a > b) {
            a -= b;
            a >>= twos(a);
        } else {
            b -= a;
            b >>= twos(b);
        }
    }
    uint64_t c = (uint64_t)a, d = (uint64_t)b;
    if (a == b) return a;
    while (c != d) {
        if (c > d) {
            c -= d;
            c >>= __builtin_ctzll(c);
        } else {
            d -= c;
            d >>= __builtin_ctzll(d);
        }
    }
    return c;
}

/* Decimal digits of v at `at`; returns past the last one. */
static char *put_digits(char *at, sunder_i_u128 v)
{
    char buffer[40];
    int n = 0;
    const uint64_t chunk = 10000000000000000000u;
    do {
        const bool more = v >= chunk;
        uint64_t low = more ? (uint64_t)(v % chunk) : (uint64_t)v;
        v = more ? v / chunk : 0;
        const int end = n + 19;
        do {
            buffer[n++] = (char)('0' + low % 10);
            low /= 10;
        } while (low);
        while (v && n < end) buffer[n++] = '0';
    } while (v);
    while (n > 0) *at++ = buffer[--n];
    return at;
}

/* The text of num / den * 2^exponent; NULL if the fraction does not fit (then *fits is false) or memory is out. */
static char *quick_text(bool negative, sunder_i_u128 num, sunder_i_u128 den, long exponent, bool *fit)
{
    *fit = true;
    char text[2 * 40 + 2], *end = text;
    if (num == 0) {
        *end++ = '0';
    } else {
        const unsigned a = twos(num), b = twos(den);
        exponent += (long)a - (long)b;
        num >>= a;
        den >>= b;
        if (den != 1) {
            const sunder_i_u128 common = odd_gcd(num, den);
            if (common != 1) {
                num /= common;
                den /= common;
            }
        }
        sunder_i_u128 *grows = exponent > 0 ? &num : &den;
        const long shift = exponent > 0 ? exponent : -exponent;
        if (shift >= 127 || *grows >> (127 - shift)) {
            *fit = false;
            return NULL;
        }
        *grows <<= shift;
        if (negative) *end++ = '-';
        end = put_digits(end, num);
        if (den != 1) {
            *end++ = '/';
            end = put_digits(end, den);
        }
    }
    *end++ = 0;
    char *copy = sunder_i_alloc((size_t)(end - text), 1);
    if (copy) memcpy(copy, text, (size_t)(end - text));
    return copy;
}

static char *coordinate_text(sunder_i_operands *g, const sunder_i_vector_exact *v, int k)
{
    sunder_i_lattice *l = &g->placed.lattice;
    if (v->small) {
        const sunder_i_i128 c = k ? v->y : v->x;
        bool fit;
        char *text = quick_text(c < 0, sunder_i_i128_abs(c), (sunder_i_u128)v->w, l->exponent, &fit);
        if (fit) return text;
    }
    sunder_i_big x, y, w;
    big_parts(g, v, &x, &y, &w);
    return sunder_i_big_ratio_text(&l->arena, k ? y : x, w, l->exponent);
}

static char *norm_text(sunder_i_operands *g, const sunder_i_vector_exact *v)
{
    sunder_i_lattice *l = &g->placed.lattice;
    if (v->small) {
        const sunder_i_u128 n = (sunder_i_u128)(v->x * v->x) + (sunder_i_u128)(v->y * v->y);
        bool fit;
        char *text = quick_text(false, n, (sunder_i_u128)(v->w * v->w), 2 * l->exponent, &fit);
        if (fit) return text;
    }
    sunder_i_big x, y, w;
    big_parts(g, v, &x, &y, &w);
    return sunder_i_big_ratio_text(&l->arena, sunder_i_big_norm(&l->arena, x, y), sunder_i_big_mul(&l->arena, w, w),
                                   2 * l->exponent);
}

sunder_status sunder_i_answer_texts(sunder_i_operands *g, const sunder_i_vector_exact *v, sunder_separation *out,
                                    sunder_error *err)
{
    out->dx_text = coordinate_text(g, v, 0);
    out->dy_text = coordinate_text(g, v, 1);
    out->distance_squared_text = norm_text(g, v);
    if (out->dx_text && out->dy_text && out->distance_squared_text && !g->placed.lattice.arena.failed) return SUNDER_OK;
    sunder_separation_clear(out);
    return sunder_i_no_memory(err);
}

/* ---- Are the doubles free too? ---- */

/* The double v as num / 2^bits lattice units. */
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

void sunder_i_vector_doubles(sunder_i_operands *g, double dx, double dy, sunder_i_big *x, sunder_i_big *y,
                             sunder_i_big *w)
{
    sunder_i_lattice *l = &g->placed.lattice;
    unsigned long bx, by;
    const sunder_i_big u = in_units(l, dx, &bx), v = in_units(l, dy, &by);
    const unsigned long bits = bx > by ? bx : by;
    *x = sunder_i_big_shl(&l->arena, u, bits - bx);
    *y = sunder_i_big_shl(&l->arena, v, bits - by);
    *w = sunder_i_big_shl(&l->arena, sunder_i_big_i64(&l->arena, 1), bits);
}

bool sunder_i_answer_exact(sunder_i_operands *g, const sunder_i_vector_exact *v, double dx, double dy)
{
    sunder_i_lattice *l = &g->placed.lattice;
    if (!isfinite(dx) || !isfinite(dy)) return false;
    if (v->small && l->exponent > -400 && l->exponent < 400) {
        /* A product with one rounding, against an integer that a double holds. */
        const sunder_i_i128 most = (sunder_i_i128)1 << 53;
        const double w = (double)(int64_t)v->w;
        if (v->w < most && v->x < most && v->x > -most && v->y < most && v->y > -most)
            return fma(ldexp(dx, (int)-l->exponent), w, -(double)(int64_t)v->x) == 0 &&
                   fma(ldexp(dy, (int)-l->exponent), w, -(double)(int64_t)v->y) == 0;
    }
    sunder_i_big c[2], w;
    big_parts(g, v, &c[0], &c[1], &w);
    const double d[2] = {dx, dy};
    for (int k = 0; k < 2; k++) {
        unsigned long bits;
        const sunder_i_big u = sunder_i_big_mul(&l->arena, in_units(l, d[k], &bits), w);
        if (sunder_i_big_cmp(u, sunder_i_big_shl(&l->arena, c[k], bits))) return false;
    }
    return true;
}

typedef struct dyadic {
    double ax, ay; /* in units */
    bool native;   /* the integers below hold it */
    sunder_i_i128 x, y;
    unsigned bits; /* x / 2^bits, y / 2^bits */
    sunder_i_big bx, by;
    unsigned long big_bits;
} dyadic;

/* Native: v = m 2^f lattice units with |m| < 2^53. */
static bool native_units(double v, long exponent, int64_t *m, long *f)
{
    int e;
    *m = (int64_t)ldexp(frexp(v, &e), 53);
    *f = e - 53 - exponent;
    if (*m == 0) {
        *f = 0;
        return true;
    }
    const int z = __builtin_ctzll((uint64_t)(*m < 0 ? -*m : *m));
    *m /= (int64_t)1 << z;
    *f += z;
    return *f > -64 && *f < 64;
}

static dyadic dyadic_of(sunder_i_operands *g, double dx, double dy)
{
    sunder_i_lattice *l = &g->placed.lattice;
    dyadic d;
    memset(&d, 0, sizeof d);
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
            d.ax = ldexp((double)mx, (int)fx);
            d.ay = ldexp((double)my, (int)fy);
            return d;
        }
    }
    unsigned long bx, by;
    const sunder_i_big x = in_units(l, dx, &bx), y = in_units(l, dy, &by);
    d.big_bits = bx > by ? bx : by;
    d.bx = sunder_i_big_shl(&l->arena, x, d.big_bits - bx);
    d.by = sunder_i_big_shl(&l->arena, y, d.big_bits - by);
    const sunder_i_big one = sunder_i_big_i64(&l->arena, 1);
    d.ax = sunder_i_big_ratio(&l->arena, d.bx, one, -(long)d.big_bits - l->approx_shift);
    d.ay = sunder_i_big_ratio(&l->arena, d.by, one, -(long)d.big_bits - l->approx_shift);
    return d;
}

/* Side of the point to side k of the subsum. Exact. */
static int dyadic_side(sunder_i_operands *g, const dyadic *d, const sunder_i_subsum *s, uint32_t k)
{
    sunder_i_lattice *l = &g->placed.lattice;
    l->counts.orientation_tests++;
    l->counts.exact_fallbacks++;
    if (d->native && sunder_i_point_is_plain(s->corner[k]) && sunder_i_point_is_plain(s->side[k])) {
        /* |corner| < 2^61 and bits < 64, so differences stay below 2^126. */
        const sunder_i_i128 one = (sunder_i_i128)1 << d->bits;
        const sunder_i_i128 x = d->x - s->corner[k].x * one, y = d->y - s->corner[k].y * one;
        return sunder_i_cmp_products(s->side[k].x, y, s->side[k].y, x);
    }
    if (l->arena.failed) return 0;
    const sunder_i_mark mark = sunder_i_lattice_begin(l);
    sunder_i_arena *m = &l->scratch;
    const unsigned long bits = d->native ? d->bits : d->big_bits;
    const sunder_i_vector at = {d->native ? sunder_i_big_i128(m, d->x) : d->bx,
                                d->native ? sunder_i_big_i128(m, d->y) : d->by,
                                sunder_i_big_shl(m, sunder_i_big_i64(m, 1), bits)};
    const sunder_i_vector v = sunder_i_vector_sub(m, at, sunder_i_vector_get(m, l, s->corner[k]));
    const int sign = sunder_i_big_sign(sunder_i_vector_cross(m, sunder_i_vector_get(m, l, s->side[k]), v));
    sunder_i_lattice_end(l, mark);
    return sign;
}

bool sunder_i_doubles_free(sunder_i_operands *g, double dx, double dy)
{
    if (!isfinite(dx) || !isfinite(dy)) return false;
    const dyadic d = dyadic_of(g, dx, dy);
    const double e = g->error;
    for (size_t n = 0; n < g->subsums; n++) {
        sunder_i_subsum *s = g->subsum + n;
        if (d.ax < s->box[0] - e || d.ax > s->box[2] + e || d.ay < s->box[1] - e || d.ay > s->box[3] + e) continue;
        if (!s->sides && !sunder_i_subsum_make(g, s)) return false;
        bool inside = true;
        for (uint32_t k = 0; k < s->sides && inside; k++) {
            const double v = s->sx[k] * (d.ay - s->cy[k]) - s->sy[k] * (d.ax - s->cx[k]);
            inside = v > s->bound[k] || (v >= -s->bound[k] && dyadic_side(g, &d, s, k) > 0);
        }
        if (inside) return false;
    }
    return true;
}
