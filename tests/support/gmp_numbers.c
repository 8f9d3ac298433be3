#include "gmp_numbers.h"

void mpz_from_limbs(mpz_t r, const uint64_t *limb, size_t n) { mpz_import(r, n, -1, sizeof *limb, 0, 0, limb); }

void mpz_from_i128(mpz_t r, sunder_i_i128 v)
{
    const sunder_i_u128 m = v < 0 ? -(sunder_i_u128)v : (sunder_i_u128)v;
    const uint64_t limb[2] = {(uint64_t)m, (uint64_t)(m >> 64)};
    mpz_from_limbs(r, limb, 2);
    if (v < 0) mpz_neg(r, r);
}

void mpz_from_i256(mpz_t r, const sunder_i_i256 *v)
{
    mpz_from_limbs(r, v->limb, 4);
    if (v->sign < 0) mpz_neg(r, r);
}

void mpz_from_big(mpz_t r, sunder_i_big v)
{
    const size_t n = (size_t)(v.size < 0 ? -v.size : v.size);
    mpz_import(r, n, -1, sizeof(mp_limb_t), 0, 0, v.limb);
    if (v.size < 0) mpz_neg(r, r);
}

sunder_i_big big_from_mpz(sunder_i_arena *arena, const mpz_t v)
{
    const size_t n = mpz_size(v);
    mp_limb_t *p = sunder_i_arena_alloc(arena, n + 1, sizeof *p);
    for (size_t i = 0; p && i < n; i++) p[i] = mpz_getlimbn(v, (mp_size_t)i);
    return (sunder_i_big){p, p ? (mpz_sgn(v) < 0 ? -(long)n : (long)n) : 0};
}

bool big_is_canonical(sunder_i_big v)
{
    const long n = v.size < 0 ? -v.size : v.size;
    return n == 0 || v.limb[n - 1] != 0;
}

void random_mpz(mpz_t r, rng *g, unsigned bits)
{
    const unsigned b = (unsigned)rng_int(g, 0, bits);
    mpz_set_ui(r, 0);
    switch (rng_int(g, 0, 5)) {
    case 0: mpz_set_si(r, rng_int(g, 0, 2)); break;
    case 1: /* a power of two */
        if (b) mpz_setbit(r, b - 1);
        break;
    case 2: /* all ones */
        mpz_setbit(r, b);
        mpz_sub_ui(r, r, 1);
        break;
    case 3: /* blocks of ones */
        for (unsigned i = 0; i < b; i++)
            if (i / 13 % 2) mpz_setbit(r, i);
        break;
    default:
        for (unsigned i = 0; i < b; i++)
            if (rng_next(g) & 1) mpz_setbit(r, i);
    }
    while (mpz_sizeinbase(r, 2) > bits) mpz_tdiv_q_2exp(r, r, 1);
    if (rng_next(g) & 1) mpz_neg(r, r);
}

sunder_i_i128 random_i128(rng *g, unsigned bits)
{
    mpz_t z;
    mpz_init(z);
    random_mpz(z, g, bits);
    sunder_i_u128 m = 0;
    for (size_t i = mpz_size(z); i-- > 0;) m = m << 64 | mpz_getlimbn(z, (mp_size_t)i);
    const sunder_i_i128 v = mpz_sgn(z) < 0 ? -(sunder_i_i128)m : (sunder_i_i128)m;
    mpz_clear(z);
    return v;
}
