/* lattice.c: chooses a lattice for given coordinates, and converts doubles, integers and ratios to its numbers. */
#include "number/lattice.h"

#include "base/invariant.h"

#include <limits.h>
#include <math.h>
#include <string.h>

static inline int low_bit_of(double v)
{
    uint64_t b;
    memcpy(&b, &v, sizeof b);
    const int field = (int)(b >> 52 & 0x7ff);
    const uint64_t fraction = b & (((uint64_t)1 << 52) - 1);
    if (field) return field - 1075 + __builtin_ctzll(fraction | (uint64_t)1 << 52);
    return fraction ? -1074 + __builtin_ctzll(fraction) : INT_MAX; /* for subnormal doubles, and for zero */
}

int sunder_i_low_bit(double v) { return low_bit_of(v); }

void sunder_i_extent_add(sunder_i_extent *extent, const double *xy, size_t n)
{
    if (n == 0) return;
    if (!extent->any) {
        extent->any = true;
        extent->low_bit = INT_MAX;
        for (int k = 0; k < 2; k++) extent->low[k] = extent->high[k] = xy[k];
    }
    double low[2] = {extent->low[0], extent->low[1]}, high[2] = {extent->high[0], extent->high[1]};
    int bit = extent->low_bit;
    for (size_t i = 0; i < n; i++)
        for (int k = 0; k < 2; k++) {
            const double v = xy[2 * i + (size_t)k];
            low[k] = v < low[k] ? v : low[k];
            high[k] = v > high[k] ? v : high[k];
            const int b = low_bit_of(v);
            bit = b < bit ? b : bit;
        }
    memcpy(extent->low, low, sizeof low);
    memcpy(extent->high, high, sizeof high);
    extent->low_bit = bit;
}

/* Returns the exponent e of v = m 2^e, 1/2 <= |m| < 1, as frexp(), but without a call if v is a normal double. */
static inline int exponent_of(double v)
{
    uint64_t b;
    memcpy(&b, &v, sizeof b);
    const int field = (int)(b >> 52 & 0x7ff);
    if (field && field < 0x7ff) return field - 1022;
    int e;
    frexp(v, &e);
    return e;
}

double sunder_i_lattice_origin(double low, double high, int bit)
{
    const double middle = low / 2 + high / 2;
    if (middle == 0) return 0;
    const int e = exponent_of(middle), range = exponent_of(high - low);
    /* Limits the bits to the size of the range: a more precise origin has no advantage. */
    int keep = e - range + 2;
    if (high == low || keep > 20) keep = 20;
    if (keep <= 0) return 0;
    if (e - keep < bit) keep = e - bit;
    if (keep <= 0) return 0;
    const double bits = fabs(middle) > 0x1p-900 && fabs(middle) < 0x1p900 ? middle * sunder_i_power_of_two(keep - e)
                                                                          : ldexp(middle, keep - e);
    return ldexp((double)(int64_t)bits, e - keep); /* truncated to an integer below 2^20 */
}

/* Returns an upper bound of the number of bits of |v - o| in units of 2^bit. */
static int magnitude_bits(double v, double o, int bit)
{
    const double d = fabs(v - o); /* the rounding error is relative, below one bit */
    if (d == 0) return 0;
    if (isinf(d)) return INT_MAX / 2;
    return exponent_of(d) + 1 - bit;
}

void sunder_i_lattice_init(sunder_i_lattice *lattice, const sunder_i_extent *extents, size_t n, bool relative,
                           double (*origins)[2], bool force_wide)
{
    memset(lattice, 0, sizeof *lattice);
    int bit = INT_MAX;
    for (size_t i = 0; i < n; i++)
        if (extents[i].any && extents[i].low_bit < bit) bit = extents[i].low_bit;
    if (bit == INT_MAX) bit = 0;
    lattice->exponent = bit;
    lattice->scale = bit > -1000 && bit < 1000 ? sunder_i_power_of_two(-bit) : 0;
    int most = 0;
    for (size_t i = 0; i < n; i++) {
        origins[i][0] = origins[i][1] = 0;
        if (!extents[i].any) continue;
        for (int k = 0; k < 2; k++) {
            const double low = extents[i].low[k], high = extents[i].high[k];
            if (relative) origins[i][k] = sunder_i_lattice_origin(low, high, bit);
            const int a = magnitude_bits(low, origins[i][k], bit), b = magnitude_bits(high, origins[i][k], bit);
            if (a > most) most = a;
            if (b > most) most = b;
        }
    }
    /* One bit for the sum of two operands. */
    lattice->small = most + 1 <= SUNDER_I_NARROW_BITS;
    lattice->pooled = force_wide;
    lattice->narrow = lattice->small && !force_wide;
    lattice->approx_shift = most <= 500 ? 0 : most - 500;
}

void sunder_i_lattice_admit_ratios(sunder_i_lattice *lattice) { lattice->narrow = false; }

void sunder_i_lattice_free(sunder_i_lattice *lattice)
{
    sunder_i_arena_free(&lattice->arena);
    sunder_i_arena_free(&lattice->scratch);
    sunder_i_free(lattice->pool);
    lattice->pool = NULL;
    lattice->pool_n = lattice->pool_capacity = 0;
}

sunder_i_mark sunder_i_lattice_begin(sunder_i_lattice *lattice)
{
    /* An allocation that remains in the first chunk, so that the chunk is not freed and allocated again and again. */
    if (!lattice->scratch.chunk) sunder_i_arena_alloc(&lattice->scratch, 1, 1);
    return sunder_i_arena_mark(&lattice->scratch);
}

void sunder_i_lattice_end(sunder_i_lattice *lattice, sunder_i_mark mark)
{
    if (lattice->scratch.failed) lattice->arena.failed = true;
    sunder_i_arena_release(&lattice->scratch, mark);
}

static const mp_limb_t one_limb = 1;
static const sunder_i_big one = {&one_limb, 1};

/* Returns the double nearest to num / den in the units of sunder_i_approx(). */
static double value_of(sunder_i_lattice *lattice, sunder_i_big num, sunder_i_big den)
{
    const sunder_i_mark mark = sunder_i_lattice_begin(lattice);
    const double value = sunder_i_big_ratio(&lattice->scratch, num, den, -lattice->approx_shift);
    sunder_i_lattice_end(lattice, mark);
    return value;
}

int64_t sunder_i_lattice_pool(sunder_i_lattice *lattice, sunder_i_big num, sunder_i_big den, double value)
{
    if (lattice->arena.failed) return 0;
    if (!sunder_i_reserve(&lattice->pool, &lattice->pool_capacity, lattice->pool_n + 1, sizeof *lattice->pool)) {
        lattice->arena.failed = true;
        return 0;
    }
    SUNDER_I_ASSERT(lattice->scratch.failed || sunder_i_big_sign(den) > 0);
    lattice->pool[lattice->pool_n] = (sunder_i_pooled){{num, den}, value};
    return INT64_MIN + (int64_t)lattice->pool_n++;
}

int64_t sunder_i_lattice_big(sunder_i_lattice *lattice, sunder_i_big v)
{
    int64_t n = 0;
    if (!lattice->pooled && sunder_i_big_bits(v) <= SUNDER_I_PLAIN_BITS) {
        sunder_i_big_fits_i64(v, &n);
        return n;
    }
    return sunder_i_lattice_pool(lattice, v, one, value_of(lattice, v, one));
}

int64_t sunder_i_lattice_ratio(sunder_i_lattice *lattice, sunder_i_big num, sunder_i_big den)
{
    if (sunder_i_big_bits(den) == 1) return sunder_i_lattice_big(lattice, num);
    return sunder_i_lattice_pool(lattice, num, den, value_of(lattice, num, den));
}

/* *out becomes v / 2^unit; v must be a multiple of 2^unit. Returns false if that needs more than 123 bits. */
static bool units_of(double v, long unit, sunder_i_i128 *out)
{
    *out = 0;
    if (v == 0) return true;
    int e;
    const int64_t m = (int64_t)ldexp(frexp(v, &e), 53);
    const long shift = e - 53 - unit;
    if (shift > 70) return false;
    *out = shift >= 0 ? m * ((sunder_i_i128)1 << shift) : m / ((int64_t)1 << -shift); /* exact, since v is a multiple */
    return true;
}

static int64_t narrow_int(const sunder_i_lattice *lattice, double v, double o)
{
    /* The usual case: scaling by a power of two is exact, and both are integers that fit. */
    const double sv = v * lattice->scale, so = o * lattice->scale;
    if (lattice->scale > 0 && fabs(sv) < 0x1p62 && fabs(so) < 0x1p62) return (int64_t)sv - (int64_t)so;
    sunder_i_i128 a, b;
    if (units_of(v, lattice->exponent, &a) && units_of(o, lattice->exponent, &b)) return (int64_t)(a - b);
    /* One is above 2^122 units and they differ by less than 2^60: their ratio is less than two, so that the difference
     * is exact (Sterbenz). */
    return (int64_t)ldexp(v - o, (int)-lattice->exponent);
}

void sunder_i_lattice_points(sunder_i_lattice *lattice, const double *xy, size_t n, const double origin[2],
                             sunder_i_point *out)
{
    const double scale = lattice->scale, x = origin[0] * scale, y = origin[1] * scale;
    if (lattice->narrow && scale > 0 && fabs(x) < 0x1p62 && fabs(y) < 0x1p62) {
        const int64_t less_x = (int64_t)x, less_y = (int64_t)y;
        for (size_t i = 0; i < n; i++) {
            const double sx = xy[2 * i] * scale, sy = xy[2 * i + 1] * scale;
            if (fabs(sx) < 0x1p62 && fabs(sy) < 0x1p62)
                out[i] = (sunder_i_point){(int64_t)sx - less_x, (int64_t)sy - less_y};
            else
                out[i] = (sunder_i_point){narrow_int(lattice, xy[2 * i], origin[0]),
                                          narrow_int(lattice, xy[2 * i + 1], origin[1])};
        }
        return;
    }
    for (size_t i = 0; i < n; i++)
        out[i] = (sunder_i_point){sunder_i_lattice_int(lattice, xy[2 * i], origin[0]),
                                  sunder_i_lattice_int(lattice, xy[2 * i + 1], origin[1])};
}

int64_t sunder_i_lattice_int(sunder_i_lattice *lattice, double v, double o)
{
    if (lattice->small && !lattice->pooled) return narrow_int(lattice, v, o);
    sunder_i_arena *arena = &lattice->arena;
    int e, f;
    sunder_i_big a = sunder_i_big_double(arena, v, &e), b = sunder_i_big_double(arena, o, &f);
    if (a.size) a = sunder_i_big_shl(arena, a, (unsigned long)(e - lattice->exponent));
    if (b.size) b = sunder_i_big_shl(arena, b, (unsigned long)(f - lattice->exponent));
    return sunder_i_lattice_big(lattice, sunder_i_big_sub(arena, a, b));
}

sunder_i_ratio sunder_i_lattice_read(sunder_i_arena *arena, const sunder_i_lattice *lattice, int64_t n)
{
    if (sunder_i_is_plain(n)) return (sunder_i_ratio){sunder_i_big_i64(arena, n), one};
    return lattice->pool[n - INT64_MIN].ratio;
}

sunder_i_big sunder_i_lattice_get(sunder_i_lattice *lattice, int64_t n)
{
    return sunder_i_lattice_read(&lattice->arena, lattice, n).num;
}
