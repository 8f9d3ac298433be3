/* big_gcd.c: the greatest common divisor and the square root of big integers: with GMP if the operands are short enough
 * (big_limbs.h explains why), else with the algorithms of Lehmer and Newton. */
#include "number/big_limbs.h"

#include "base/watch.h"

/* ---- The greatest common divisor ---- */

/* Several steps of Euclid's algorithm at once: u' = a u - b v, v' = c v - d u; both negated if `odd`. */
typedef struct lehmer {
    uint64_t a, b, c, d;
    bool odd;
} lehmer;

/* *m becomes the steps that the leading 62 bits of u >= v determine: Collins' condition in Jebelean's form [Jeb95]
 * shows which steps are certain. Returns false if not even the first is. */
static bool lehmer_steps(uint64_t u, uint64_t v, lehmer *m)
{
    /* The remainder after i steps is x_i u + y_i v, with alternating signs; these are the magnitudes, below 2^31. */
    uint64_t x0 = 1, y0 = 0, x1 = 0, y1 = 1;
    bool odd = false;
    int steps = 0;
    while (v) {
        const uint64_t q = u / v, r = u % v;
        if (q >= (uint64_t)1 << 31) break;
        const uint64_t x2 = x0 + q * x1, y2 = y0 + q * y1;
        if (x2 >> 31 || y2 >> 31) break;
        if (odd ? (r < x2 || v - r < y1 + y2) : (r < y2 || v - r < x1 + x2)) break;
        u = v;
        v = r;
        x0 = x1, y0 = y1, x1 = x2, y1 = y2;
        odd = !odd;
        steps++;
    }
    *m = (lehmer){x0, y0, y1, x1, odd};
    return steps > 0;
}

/* r becomes x u - y v, with n limbs; the result must not be negative, and must fit. */
static void combine_limbs(mp_limb_t *r, const mp_limb_t *u, uint64_t x, const mp_limb_t *v, uint64_t y, mp_size_t n)
{
    mpn_mul_1(r, u, n, x);
    mpn_submul_1(r, v, n, y);
}

static uint64_t leading_bits(sunder_i_big a, unsigned long bits)
{
    /* Bits [bits - 62, bits). */
    const unsigned long low = bits - 62, at = low / 64, shift = low % 64;
    const mp_limb_t first = (long)at < a.size ? a.limb[at] : 0, second = (long)at + 1 < a.size ? a.limb[at + 1] : 0;
    return (first >> shift | (shift ? second << (64 - shift) : 0)) & (((uint64_t)1 << 62) - 1);
}

/* The state of Euclid's algorithm for a >= b > 0; the results of a step are written to `spare`, which is then exchanged
 * with `used`, which has the results of the previous step. */
typedef struct euclid {
    sunder_i_big a, b;
    mp_limb_t *spare[2], *used[2];
} euclid;

/* Returns false if out of memory. */
static bool start_euclid(euclid *e, sunder_i_arena *arena, sunder_i_big a, sunder_i_big b)
{
    const bool ordered = sunder_i_big_cmp(a, b) >= 0;
    *e = (euclid){.a = ordered ? a : b, .b = ordered ? b : a};
    const mp_size_t room = e->a.size + 1;
    mp_limb_t *block = sunder_i_limbs_alloc(arena, 4 * room);
    for (int i = 0; block && i < 2; i++) {
        e->spare[i] = block + i * room;
        e->used[i] = block + (i + 2) * room;
    }
    return block != NULL;
}

/* Returns false if out of memory. */
static bool take_lehmer_steps(euclid *e, sunder_i_arena *arena, const lehmer *m)
{
    const mp_size_t n = e->a.size;
    const mp_limb_t *u = e->a.limb;
    mp_limb_t *v = sunder_i_limbs_alloc(arena, n); /* b with as many limbs as a */
    if (!v) return false;
    mpn_zero(v, n);
    mpn_copyi(v, e->b.limb, e->b.size);
    if (m->odd) {
        combine_limbs(e->spare[0], v, m->b, u, m->a, n);
        combine_limbs(e->spare[1], u, m->d, v, m->c, n);
    } else {
        combine_limbs(e->spare[0], u, m->a, v, m->b, n);
        combine_limbs(e->spare[1], v, m->c, u, m->d, n);
    }
    e->a = sunder_i_limbs_value(e->spare[0], n, 1);
    e->b = sunder_i_limbs_value(e->spare[1], n, 1);
    return true;
}

/* Does one step by a division: if the quotient is too large for a word, or no step is certain. Returns false if out of
 * memory. */
static bool take_division_step(euclid *e, sunder_i_arena *arena)
{
    sunder_i_big rest;
    sunder_i_big_divide(arena, e->a, e->b, &rest);
    if (arena->failed) return false;
    mpn_copyi(e->spare[0], e->b.limb, e->b.size);
    if (rest.size) mpn_copyi(e->spare[1], rest.limb, rest.size);
    e->a = (sunder_i_big){e->spare[0], e->b.size};
    e->b = (sunder_i_big){e->spare[1], rest.size};
    return true;
}

/* Returns the gcd of two magnitudes, both odd. */
static sunder_i_big gcd_long(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b)
{
    euclid e;
    if (!start_euclid(&e, arena, a, b)) return SUNDER_I_BIG_ZERO;
    while (e.b.size > SUNDER_I_GMP_LIMBS) {
        if (!sunder_i_steps((size_t)e.a.size / 64 + 1)) arena->failed = true;
        const sunder_i_mark mark = sunder_i_arena_mark(arena);
        const unsigned long bits = sunder_i_big_bits(e.a);
        lehmer m;
        const bool many = lehmer_steps(leading_bits(e.a, bits), leading_bits(e.b, bits), &m);
        if (arena->failed || !(many ? take_lehmer_steps(&e, arena, &m) : take_division_step(&e, arena)))
            return SUNDER_I_BIG_ZERO;
        for (int i = 0; i < 2; i++) {
            mp_limb_t *t = e.spare[i];
            e.spare[i] = e.used[i];
            e.used[i] = t;
        }
        sunder_i_arena_release(arena, mark);
    }
    if (e.b.size == 0) return e.a;
    sunder_i_big rest;
    sunder_i_big_divide(arena, e.a, e.b, &rest);
    return sunder_i_big_gcd(arena, e.b, rest);
}

sunder_i_big sunder_i_big_gcd(sunder_i_arena *arena, sunder_i_big a, sunder_i_big b)
{
    if (a.size < 0) a.size = -a.size;
    if (b.size < 0) b.size = -b.size;
    if (a.size == 0) return b;
    if (b.size == 0) return a;
    /* mpn_gcd requires that the second operand is odd and not longer than the first; it destroys both. */
    const unsigned long ta = sunder_i_big_twos(a), tb = sunder_i_big_twos(b), twos = ta < tb ? ta : tb;
    sunder_i_big u = sunder_i_big_copy(arena, sunder_i_big_shr(arena, a, ta));
    sunder_i_big v = sunder_i_big_copy(arena, sunder_i_big_shr(arena, b, tb));
    if (arena->failed) return SUNDER_I_BIG_ZERO;
    if (sunder_i_limbs(u) < sunder_i_limbs(v)) {
        const sunder_i_big t = u;
        u = v;
        v = t;
    }
    if (sunder_i_limbs(u) > SUNDER_I_GMP_LIMBS) return sunder_i_big_shl(arena, gcd_long(arena, u, v), twos);
    mp_limb_t *r = sunder_i_limbs_alloc(arena, sunder_i_limbs(v));
    if (!r) return SUNDER_I_BIG_ZERO;
    const mp_size_t n = mpn_gcd(r, (mp_limb_t *)(uintptr_t)u.limb, sunder_i_limbs(u), (mp_limb_t *)(uintptr_t)v.limb,
                                sunder_i_limbs(v));
    return sunder_i_big_shl(arena, sunder_i_limbs_value(r, n, 1), twos);
}

/* ---- Square root ---- */

/* Newton's iteration with as many bits as are correct so far, twice as many each time. The invariant, with c = (bits of
 * a - 1) / 2 and d the leading bits of c: (s - 1)^2 < floor(a / 2^(2 c - 2 d)) < (s + 1)^2. A step preserves it, since
 * the error of a quotient step is the square of the old error over 2 s; at the end s or s - 1 is the root. */
static sunder_i_big sqrt_long(sunder_i_arena *arena, sunder_i_big a)
{
    const unsigned long c = (sunder_i_big_bits(a) - 1) / 2;
    unsigned long d = 0;
    int levels = 0;
    while (c >> levels) levels++;
    sunder_i_big s = sunder_i_big_one();
    for (int k = levels - 1; k >= 0 && !arena->failed; k--) {
        const unsigned long e = d;
        d = c >> k;
        const sunder_i_big part = sunder_i_big_shr(arena, a, 2 * c - e - d + 1);
        s = sunder_i_big_add(arena, sunder_i_big_shl(arena, s, d - e - 1), sunder_i_big_div_floor(arena, part, s));
    }
    if (sunder_i_big_cmp(sunder_i_big_mul(arena, s, s), a) > 0) s = sunder_i_big_sub(arena, s, sunder_i_big_one());
    return s;
}

sunder_i_big sunder_i_big_sqrt_floor(sunder_i_arena *arena, sunder_i_big a)
{
    if (a.size <= 0) return SUNDER_I_BIG_ZERO;
    const mp_size_t n = sunder_i_limbs(a);
    if (n > SUNDER_I_GMP_LIMBS) return sqrt_long(arena, a);
    mp_limb_t *p = sunder_i_limbs_alloc(arena, (n + 1) / 2);
    if (!p) return SUNDER_I_BIG_ZERO;
    mpn_sqrtrem(p, NULL, a.limb, n);
    return sunder_i_limbs_value(p, (n + 1) / 2, 1);
}
