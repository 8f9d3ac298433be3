/* ratio.c: ratios: read, added, reduced, compared. If out of memory, in which case a greatest common divisor is zero, a
 * ratio does not change; the arena's `failed` is set. */
#include "number/ratio.h"

#include <string.h>

sunder_i_ratio sunder_i_ratio_double(sunder_i_arena *arena, double v)
{
    int e;
    sunder_i_ratio r = {sunder_i_big_double(arena, v, &e), sunder_i_big_i64(arena, 1)};
    if (e >= 0)
        r.num = sunder_i_big_shl(arena, r.num, (unsigned long)e);
    else
        r.den = sunder_i_big_shl(arena, r.den, (unsigned long)-(long)e);
    return r;
}

bool sunder_i_ratio_parse(sunder_i_arena *arena, const char *text, sunder_i_ratio *out)
{
    const char *slash = strchr(text, '/');
    if (!sunder_i_big_parse(arena, text, slash ? (size_t)(slash - text) : strlen(text), &out->num)) return false;
    out->den = sunder_i_big_i64(arena, 1);
    if (!slash) return true;
    if (!sunder_i_big_parse(arena, slash + 1, strlen(slash + 1), &out->den)) return false;
    if (sunder_i_big_sign(out->den) < 0) {
        out->num = sunder_i_big_neg(out->num);
        out->den = sunder_i_big_neg(out->den);
    }
    return arena->failed || sunder_i_big_sign(out->den) > 0;
}

sunder_i_ratio sunder_i_ratio_add(sunder_i_arena *arena, sunder_i_ratio a, sunder_i_ratio b)
{
    if (sunder_i_big_cmp(a.den, b.den) == 0) return (sunder_i_ratio){sunder_i_big_add(arena, a.num, b.num), a.den};
    const sunder_i_big g = sunder_i_big_gcd(arena, a.den, b.den);
    if (g.size == 0) return a;
    const sunder_i_big bd = sunder_i_big_div_floor(arena, b.den, g);
    const sunder_i_big ad = sunder_i_big_div_floor(arena, a.den, g);
    return (sunder_i_ratio){
        sunder_i_big_add(arena, sunder_i_big_mul(arena, a.num, bd), sunder_i_big_mul(arena, b.num, ad)),
        sunder_i_big_mul(arena, a.den, bd)};
}

sunder_i_ratio sunder_i_ratio_reduced(sunder_i_arena *arena, sunder_i_ratio a)
{
    if (sunder_i_big_is_one(a.den)) return a;
    const sunder_i_big g = sunder_i_big_gcd(arena, a.num, a.den);
    if (g.size == 0 || a.num.size == 0 || sunder_i_big_is_one(g)) return a;
    return (sunder_i_ratio){sunder_i_big_div_floor(arena, a.num, g), sunder_i_big_div_floor(arena, a.den, g)};
}

int sunder_i_ratio_cmp(sunder_i_arena *arena, sunder_i_ratio a, sunder_i_ratio b)
{
    return sunder_i_big_cmp(sunder_i_big_mul(arena, a.num, b.den), sunder_i_big_mul(arena, b.num, a.den));
}
