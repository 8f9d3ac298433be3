/* surd.c: a number of height h is lo + hi r with lo, hi of height h - 1 and r the root number h - 1: every operation is
 * recursive on the halves. The sign of lo + hi r, if the signs of the two terms differ, is that of lo times that of
 * lo^2 - hi^2 r^2, which has one root less: no bound on the separation of roots is needed, and squares are computed
 * only if the leading bits do not decide. Each root doubles the lengths; two are usual here, and four arise if two
 * points with two roots each are compared. */
#include "number/surd.h"

#define PARTS(height) ((size_t)1 << (height))

static const sunder_i_big ZERO = {NULL, 0};

/* Allocates the parts of a new number, all zero; if out of memory, *out becomes a shared zero that is never written to,
 * and the function returns NULL. */
static sunder_i_big *new_parts(sunder_i_arena *arena, int height, sunder_i_surd *out)
{
    sunder_i_big *part = sunder_i_arena_alloc(arena, PARTS(height), sizeof *part);
    *out = part ? (sunder_i_surd){height, part} : (sunder_i_surd){0, &ZERO};
    for (size_t k = 0; part && k < PARTS(height); k++) part[k] = ZERO;
    return part;
}

static sunder_i_surd half_of(sunder_i_surd a, bool high)
{
    return (sunder_i_surd){a.height - 1, a.part + (high ? PARTS(a.height - 1) : 0)};
}

static bool is_zero(sunder_i_surd a)
{
    for (size_t k = 0; k < PARTS(a.height); k++)
        if (a.part[k].size) return false;
    return true;
}

/* Returns the number without the highest roots if their coefficients are zero. */
static sunder_i_surd trimmed_surd(sunder_i_surd a)
{
    while (a.height && is_zero(half_of(a, true))) a = half_of(a, false);
    return a;
}

static sunder_i_surd join_halves(sunder_i_arena *arena, sunder_i_surd low, sunder_i_surd high, int height)
{
    sunder_i_surd out;
    sunder_i_big *part = new_parts(arena, height, &out);
    for (size_t k = 0; part && k < PARTS(low.height); k++) part[k] = low.part[k];
    for (size_t k = 0; part && k < PARTS(high.height); k++) part[PARTS(height - 1) + k] = high.part[k];
    return out;
}

sunder_i_surd sunder_i_surd_big(sunder_i_arena *arena, sunder_i_big v)
{
    sunder_i_surd out;
    sunder_i_big *part = new_parts(arena, 0, &out);
    if (part) part[0] = v;
    return out;
}

bool sunder_i_surd_root(sunder_i_arena *arena, sunder_i_roots *roots, sunder_i_surd square, sunder_i_surd *out)
{
    square = trimmed_surd(square);
    const int sign = sunder_i_surd_sign(arena, roots, square);
    if (sign <= 0) {
        *out = sunder_i_surd_big(arena, ZERO);
        return sign == 0;
    }
    if (square.height == 0) {
        const sunder_i_big v = square.part[0], r = sunder_i_big_sqrt_floor(arena, v);
        if (sunder_i_big_cmp(sunder_i_big_mul(arena, r, r), v) == 0) {
            *out = sunder_i_surd_big(arena, r);
            return true;
        }
    }
    const int n = roots->n++;
    roots->square[n] = square;
    sunder_i_big *part = new_parts(arena, n + 1, out);
    if (part) part[PARTS(n)] = sunder_i_big_i64(arena, 1);
    return true;
}

static sunder_i_surd combine_surds(sunder_i_arena *arena, sunder_i_surd a, sunder_i_surd b, bool minus)
{
    sunder_i_surd out;
    const int height = a.height > b.height ? a.height : b.height;
    sunder_i_big *part = new_parts(arena, height, &out);
    for (size_t k = 0; part && k < PARTS(height); k++) {
        const sunder_i_big u = k < PARTS(a.height) ? a.part[k] : ZERO, v = k < PARTS(b.height) ? b.part[k] : ZERO;
        part[k] = minus ? sunder_i_big_sub(arena, u, v) : sunder_i_big_add(arena, u, v);
    }
    return out;
}

sunder_i_surd sunder_i_surd_add(sunder_i_arena *arena, sunder_i_surd a, sunder_i_surd b)
{
    return combine_surds(arena, a, b, false);
}

sunder_i_surd sunder_i_surd_sub(sunder_i_arena *arena, sunder_i_surd a, sunder_i_surd b)
{
    return combine_surds(arena, a, b, true);
}

sunder_i_surd sunder_i_surd_scale(sunder_i_arena *arena, sunder_i_surd a, sunder_i_big f)
{
    sunder_i_surd out;
    sunder_i_big *part = new_parts(arena, a.height, &out);
    for (size_t k = 0; part && k < PARTS(a.height); k++) part[k] = sunder_i_big_mul(arena, a.part[k], f);
    return out;
}

sunder_i_surd sunder_i_surd_shl(sunder_i_arena *arena, sunder_i_surd a, unsigned long shift)
{
    if (!shift) return a;
    sunder_i_surd out;
    sunder_i_big *part = new_parts(arena, a.height, &out);
    for (size_t k = 0; part && k < PARTS(a.height); k++) part[k] = sunder_i_big_shl(arena, a.part[k], shift);
    return out;
}

sunder_i_surd sunder_i_surd_mul(sunder_i_arena *arena, const sunder_i_roots *roots, sunder_i_surd a, sunder_i_surd b)
{
    a = trimmed_surd(a);
    b = trimmed_surd(b);
    if (a.height == 0) return sunder_i_surd_scale(arena, b, a.part[0]);
    if (b.height == 0) return sunder_i_surd_scale(arena, a, b.part[0]);
    if (a.height != b.height) {
        const sunder_i_surd tall = a.height > b.height ? a : b, other = a.height > b.height ? b : a;
        return join_halves(arena, sunder_i_surd_mul(arena, roots, half_of(tall, false), other),
                           sunder_i_surd_mul(arena, roots, half_of(tall, true), other), tall.height);
    }
    const sunder_i_surd a0 = half_of(a, false), a1 = half_of(a, true), b0 = half_of(b, false), b1 = half_of(b, true);
    const sunder_i_surd twice = sunder_i_surd_mul(arena, roots, a1, b1);
    const sunder_i_surd low = sunder_i_surd_add(arena, sunder_i_surd_mul(arena, roots, a0, b0),
                                                sunder_i_surd_mul(arena, roots, twice, roots->square[a.height - 1]));
    const sunder_i_surd high =
        sunder_i_surd_add(arena, sunder_i_surd_mul(arena, roots, a0, b1), sunder_i_surd_mul(arena, roots, a1, b0));
    return join_halves(arena, low, high, a.height);
}

sunder_i_ball sunder_i_surd_ball(const sunder_i_roots *roots, sunder_i_surd a)
{
    sunder_i_ball root[SUNDER_I_SURD_ROOTS], sum = sunder_i_ball_big(a.part[0]);
    for (int i = 0; i < a.height; i++) root[i] = sunder_i_ball_sqrt(sunder_i_surd_ball(roots, roots->square[i]));
    for (size_t k = 1; k < PARTS(a.height); k++) {
        if (!a.part[k].size) continue;
        sunder_i_ball product = sunder_i_ball_big(a.part[k]);
        for (int i = 0; i < a.height; i++)
            if (k >> i & 1) product = sunder_i_ball_mul(product, root[i]);
        sum = sunder_i_ball_add(sum, product);
    }
    return sum;
}

int sunder_i_surd_sign(sunder_i_arena *arena, const sunder_i_roots *roots, sunder_i_surd a)
{
    a = trimmed_surd(a);
    if (a.height == 0) return sunder_i_big_sign(a.part[0]);
    const sunder_i_surd low = half_of(a, false), high = half_of(a, true);
    const int u = sunder_i_surd_sign(arena, roots, low), v = sunder_i_surd_sign(arena, roots, high);
    if (v == 0 || u == v) return u;
    if (u == 0) return v;
    const int rough = sunder_i_ball_sign(sunder_i_surd_ball(roots, a));
    if (rough) return rough;
    const sunder_i_surd square = sunder_i_surd_mul(arena, roots, high, high);
    const sunder_i_surd d = sunder_i_surd_sub(arena, sunder_i_surd_mul(arena, roots, low, low),
                                              sunder_i_surd_mul(arena, roots, square, roots->square[a.height - 1]));
    return u * sunder_i_surd_sign(arena, roots, d);
}

/* ---- Digits ---- */

static unsigned long root_bits(const sunder_i_roots *roots, int i);

/* Returns a number of bits with |a| < 2^bits. */
static unsigned long value_bits(const sunder_i_roots *roots, sunder_i_surd a)
{
    unsigned long bits = 0;
    for (size_t k = 0; k < PARTS(a.height); k++) {
        const unsigned long b = sunder_i_big_bits(a.part[k]);
        if (b > bits) bits = b;
    }
    for (int i = 0; i < a.height; i++) bits += root_bits(roots, i) + 1; /* twice as many terms each time */
    return bits;
}

/* Returns a number of bits, at least 1, with root i < 2^bits. */
static unsigned long root_bits(const sunder_i_roots *roots, int i)
{
    return value_bits(roots, roots->square[i]) / 2 + 1;
}

/* Returns an approximation of root i times 2^bits with an error below 3: the square has an error of 2, so that the root
 * has one below 2, and it is rounded down. */
static sunder_i_big scaled_root(sunder_i_arena *arena, const sunder_i_roots *roots, int i, unsigned long bits)
{
    const sunder_i_big square = sunder_i_surd_scaled(arena, roots, roots->square[i], 2 * bits);
    return sunder_i_big_sign(square) > 0 ? sunder_i_big_sqrt_floor(arena, square) : ZERO;
}

sunder_i_big sunder_i_surd_scaled(sunder_i_arena *arena, const sunder_i_roots *roots, sunder_i_surd a,
                                  unsigned long bits)
{
    a = trimmed_surd(a);
    if (a.height == 0) return sunder_i_big_shl(arena, a.part[0], bits);
    /* Four additional binary digits are computed. The root has an error of 3 * 2^-m, m = bits + 6 + the bits of hi, and
     * hi one of 2 * 2^-n, n = bits + 6 + the bits of the root, so that the product has an error below (3 + 2 + 1) / 64,
     * that is 6 / 4 with the additional digits; the shift adds 1 and lo 2. These 4.5 / 16, and 1 for the last shift,
     * are below 2. */
    const sunder_i_surd low = half_of(a, false), high = half_of(a, true);
    const unsigned long m = bits + 6 + value_bits(roots, high), n = bits + 6 + root_bits(roots, a.height - 1);
    const sunder_i_big product = sunder_i_big_mul(arena, scaled_root(arena, roots, a.height - 1, m),
                                                  sunder_i_surd_scaled(arena, roots, high, n));
    const sunder_i_big sum = sunder_i_big_add(arena, sunder_i_surd_scaled(arena, roots, low, bits + 4),
                                              sunder_i_big_shr(arena, product, m + n - bits - 4));
    return sunder_i_big_shr(arena, sum, 4);
}

/* ---- Numbers over different roots ---- */

sunder_i_surd sunder_i_surd_lift(sunder_i_arena *arena, sunder_i_surd a, const int place[SUNDER_I_SURD_ROOTS])
{
    a = trimmed_surd(a);
    int height = 0;
    for (int i = 0; i < a.height; i++)
        if (place[i] >= height) height = place[i] + 1;
    sunder_i_surd out;
    sunder_i_big *part = new_parts(arena, height, &out);
    for (size_t k = 0; part && k < PARTS(a.height); k++) {
        size_t at = 0;
        for (int i = 0; i < a.height; i++)
            if (k >> i & 1) at |= PARTS(place[i]);
        part[at] = a.part[k];
    }
    return out;
}

bool sunder_i_roots_join(sunder_i_arena *arena, sunder_i_roots *to, const sunder_i_roots *from,
                         int place[SUNDER_I_SURD_ROOTS])
{
    for (int i = 0; i < from->n; i++) {
        const sunder_i_surd square = sunder_i_surd_lift(arena, from->square[i], place);
        int k = 0;
        while (k < to->n && !is_zero(sunder_i_surd_sub(arena, to->square[k], square))) k++;
        if (k == to->n) {
            if (k == SUNDER_I_SURD_ROOTS) return false;
            to->square[to->n++] = square;
        }
        place[i] = k;
    }
    return true;
}
