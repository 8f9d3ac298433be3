/* number/big_limbs: numbers that are longer than one operand of GMP, compared with GMP itself. Our code never calls
 * GMP's own allocator, which ends the process if there is no memory. */
#include "failing.h"
#include "gmp_numbers.h"
#include "number/big_limbs.h"
#include "polyset.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* GMP's allocation functions are replaced by these, which count requests while our code runs. */
static bool ours;
static size_t asked;

static void *gmp_allocate(size_t n)
{
    asked += ours;
    return test_alloc(n, 1);
}

static void *gmp_reallocate(void *old, size_t from, size_t to)
{
    (void)from;
    asked += ours;
    return test_resize(old, to, 1);
}

static void gmp_release(void *p, size_t n)
{
    (void)n;
    free(p);
}

typedef struct work {
    sunder_i_arena arena;
    mpz_t a, b, r, s, t;
} work;

static void open_work(work *w)
{
    sunder_i_arena_init(&w->arena);
    mpz_inits(w->a, w->b, w->r, w->s, w->t, NULL);
}

static void close_work(work *w)
{
    mpz_clears(w->a, w->b, w->r, w->s, w->t, NULL);
    sunder_i_arena_free(&w->arena);
}

/* Draws a number of about that many limbs, often with difficult patterns: runs of ones and zeros, powers of two. */
static void draw(mpz_t v, rng *g, long limbs)
{
    random_mpz(v, g, (unsigned)(64 * limbs));
    if (rng_int(g, 0, 2) == 0) mpz_setbit(v, (mp_bitcnt_t)(64 * limbs - 1));
    mpz_abs(v, v);
    if (mpz_sgn(v) == 0) mpz_set_ui(v, 1);
}

/* Draws lengths around the bound, and far beyond it. */
static long length(rng *g)
{
    switch (rng_int(g, 0, 3)) {
    case 0: return (long)rng_int(g, 1, 40);
    case 1: return SUNDER_I_GMP_LIMBS + (long)rng_int(g, -3, 3);
    case 2: return (long)rng_int(g, 500, 2100);
    default: return (long)rng_int(g, 2000, 7000);
    }
}

static void expect(work *w, sunder_i_big got, const mpz_t want)
{
    ours = false;
    assert_false(w->arena.failed);
    assert_true(big_is_canonical(got));
    mpz_from_big(w->s, got);
    assert_int_equal(mpz_cmp(w->s, want), 0);
}

static void test_against_gmp(void **state)
{
    (void)state;
    mp_set_memory_functions(gmp_allocate, gmp_reallocate, gmp_release);
    asked = 0;
    rng g = rng_start(test_seed(), 61);
    const size_t n = test_count(150);
    for (size_t i = 0; i < n; i++) {
        work w;
        open_work(&w);
        draw(w.a, &g, length(&g));
        draw(w.b, &g, length(&g));
        if (i % 3 == 0) { /* a common factor, and quotients that are nearly a power of two */
            draw(w.t, &g, length(&g));
            mpz_mul(w.a, w.a, w.t);
            mpz_mul(w.b, w.b, w.t);
        } else if (i % 3 == 1 && mpz_cmp(w.a, w.b) > 0) {
            mpz_fdiv_q(w.t, w.a, w.b);
            mpz_mul(w.a, w.b, w.t);
            mpz_sub_ui(w.a, w.a, (unsigned long)rng_int(&g, 0, 1));
        }
        const sunder_i_big a = big_from_mpz(&w.arena, w.a), b = big_from_mpz(&w.arena, w.b);
        sunder_i_big rest;
        ours = true;
        const sunder_i_big product = sunder_i_big_mul(&w.arena, a, sunder_i_big_neg(b));
        const sunder_i_big quotient = sunder_i_big_divide(&w.arena, a, b, &rest);
        const sunder_i_big root = sunder_i_big_sqrt_floor(&w.arena, a);
        const sunder_i_big common = sunder_i_big_gcd(&w.arena, a, sunder_i_big_neg(b));
        ours = false;
        mpz_mul(w.r, w.a, w.b);
        mpz_neg(w.r, w.r);
        expect(&w, product, w.r);
        mpz_fdiv_qr(w.r, w.t, w.a, w.b);
        expect(&w, quotient, w.r);
        expect(&w, rest, w.t);
        mpz_sqrt(w.r, w.a);
        expect(&w, root, w.r);
        mpz_gcd(w.r, w.a, w.b);
        expect(&w, common, w.r);
        close_work(&w);
    }
    assert_int_equal(asked, 0);
    mp_set_memory_functions(NULL, NULL, NULL);
}

static void test_texts(void **state)
{
    (void)state;
    mp_set_memory_functions(gmp_allocate, gmp_reallocate, gmp_release);
    asked = 0;
    rng g = rng_start(test_seed(), 62);
    const size_t n = test_count(150);
    for (size_t i = 0; i < n; i++) {
        work w;
        open_work(&w);
        if (i % 3)
            draw(w.a, &g, length(&g));
        else { /* powers of ten and their neighbours: with zeros inside */
            mpz_ui_pow_ui(w.a, 10, (unsigned long)rng_int(&g, 0, 30000));
            if (i % 2) mpz_add_ui(w.a, w.a, (unsigned long)rng_int(&g, 0, 2));
            if (i % 2 == 0 && mpz_cmp_ui(w.a, 1) > 0) mpz_sub_ui(w.a, w.a, 1);
        }
        const sunder_i_big a = big_from_mpz(&w.arena, w.a);
        ours = true;
        char *text = sunder_i_big_ratio_text(&w.arena, a, sunder_i_big_i64(&w.arena, 1), 0);
        ours = false;
        assert_non_null(text);
        char *want = mpz_get_str(NULL, 10, w.a);
        assert_string_equal(text, want);
        sunder_free(text);
        free(want);
        close_work(&w);
    }
    assert_int_equal(asked, 0);
    mp_set_memory_functions(NULL, NULL, NULL);
}

/* The 1st, 2nd, 3rd ... allocation fails: the result is zero, and the arena records the failure. */
static bool all_in_turn(void *context)
{
    rng g = rng_start(*(const uint64_t *)context, 63);
    work w;
    open_work(&w);
    draw(w.a, &g, 2500);
    draw(w.b, &g, 1200);
    mpz_setbit(w.a, 64 * 2500);
    mpz_setbit(w.b, 64 * 1200);
    mp_limb_t *limb[2] = {test_alloc(2501, 8), test_alloc(1201, 8)};
    sunder_i_big v[2];
    mpz_t *from[2] = {&w.a, &w.b};
    for (int k = 0; k < 2; k++) {
        const size_t size = mpz_size(*from[k]);
        memcpy(limb[k], mpz_limbs_read(*from[k]), size * 8);
        v[k] = (sunder_i_big){limb[k], (long)size};
    }
    sunder_i_big rest;
    sunder_i_big_mul(&w.arena, v[0], v[1]);
    sunder_i_big_divide(&w.arena, v[0], v[1], &rest);
    sunder_i_big_sqrt_floor(&w.arena, v[0]);
    sunder_i_big_gcd(&w.arena, v[0], v[1]);
    char *text = sunder_i_big_ratio_text(&w.arena, v[0], v[1], 0);
    const bool ok = !w.arena.failed;
    assert_int_equal(ok, text != NULL);
    sunder_free(text);
    free(limb[0]);
    free(limb[1]);
    close_work(&w);
    return ok;
}

static void test_out_of_memory(void **state)
{
    (void)state;
    uint64_t seed = test_seed();
    failing_begin();
    assert_true(failing_loop(all_in_turn, &seed, false));
    failing_end();
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_against_gmp), cmocka_unit_test(test_texts),
                                       cmocka_unit_test(test_out_of_memory)};
    return cmocka_run_group_tests_name("number/big_limbs", tests, NULL, NULL);
}
