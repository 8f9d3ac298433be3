/* number/big: integers of any size, their ratios as doubles and as text, compared with GMP. */
#include "failing.h"
#include "gmp_numbers.h"
#include "polyset.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define ROUNDS 4000

typedef struct work {
    sunder_i_arena arena;
    rng g;
    mpz_t a, b, r, s;
} work;

static void open_work(work *w, uint64_t i)
{
    sunder_i_arena_init(&w->arena);
    w->g = rng_start(test_seed(), i);
    mpz_inits(w->a, w->b, w->r, w->s, NULL);
}

static void close_work(work *w)
{
    mpz_clears(w->a, w->b, w->r, w->s, NULL);
    sunder_i_arena_free(&w->arena);
}

static void expect(work *w, sunder_i_big got, const mpz_t want)
{
    assert_true(big_is_canonical(got));
    mpz_from_big(w->s, got);
    assert_int_equal(mpz_cmp(w->s, want), 0);
}

static void test_conversions(void **state)
{
    (void)state;
    static const int64_t small[] = {0, 1, -1, INT64_MAX, -INT64_MAX, 12345, -98765432101};
    work w;
    open_work(&w, 1);
    for (size_t i = 0; i < sizeof small / sizeof *small; i++) {
        int64_t back = 7;
        const sunder_i_big v = sunder_i_big_i64(&w.arena, small[i]);
        mpz_set_si(w.r, small[i]);
        expect(&w, v, w.r);
        assert_true(sunder_i_big_fits_i64(v, &back));
        assert_true(back == small[i]);
    }
    for (int i = 0; i < ROUNDS; i++) {
        const sunder_i_i128 v = random_i128(&w.g, 127);
        mpz_from_i128(w.r, v);
        expect(&w, sunder_i_big_i128(&w.arena, v), w.r);
        const sunder_i_i256 x = sunder_i_mul_add((int64_t)random_i128(&w.g, 62), v, 3, 5);
        mpz_from_i256(w.r, &x);
        expect(&w, sunder_i_big_i256(&w.arena, x), w.r);
    }
    close_work(&w);
}

static void test_double(void **state)
{
    (void)state;
    work w;
    open_work(&w, 2);
    int e = 3;
    assert_int_equal(sunder_i_big_sign(sunder_i_big_double(&w.arena, 0, &e)), 0);
    assert_int_equal(e, 0);
    assert_int_equal(sunder_i_big_sign(sunder_i_big_double(&w.arena, -0.0, &e)), 0);
    static const double values[] = {1,         -1,        0.1, -6, 1e300, -1e-300, 0x1p-1074, 0x1.fffffffffffffp1023,
                                    0x1p-1022, 451234.567};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        const sunder_i_big m = sunder_i_big_double(&w.arena, values[i], &e);
        mpz_from_big(w.r, m);
        assert_true(mpz_odd_p(w.r));
        assert_true(ldexp(mpz_get_d(w.r), e) == values[i]);
    }
    close_work(&w);
}

static void test_arithmetic(void **state)
{
    (void)state;
    work w;
    open_work(&w, 3);
    for (int i = 0; i < ROUNDS; i++) {
        const sunder_i_mark mark = sunder_i_arena_mark(&w.arena);
        const unsigned bits = i % 2 ? 130 : 2100;
        random_mpz(w.a, &w.g, bits);
        random_mpz(w.b, &w.g, i % 5 ? bits : 40);
        if (i % 7 == 0) mpz_neg(w.b, w.a);
        const sunder_i_big a = big_from_mpz(&w.arena, w.a), b = big_from_mpz(&w.arena, w.b);
        const unsigned long shift = (unsigned long)rng_int(&w.g, 0, 200);
        mpz_add(w.r, w.a, w.b);
        expect(&w, sunder_i_big_add(&w.arena, a, b), w.r);
        mpz_sub(w.r, w.a, w.b);
        expect(&w, sunder_i_big_sub(&w.arena, a, b), w.r);
        mpz_mul(w.r, w.a, w.b);
        expect(&w, sunder_i_big_mul(&w.arena, a, b), w.r);
        expect(&w, sunder_i_big_mul(&w.arena, b, a), w.r);
        mpz_neg(w.r, w.a);
        expect(&w, sunder_i_big_neg(a), w.r);
        expect(&w, sunder_i_big_copy(&w.arena, a), w.a);
        mpz_mul_2exp(w.r, w.a, shift);
        expect(&w, sunder_i_big_shl(&w.arena, a, shift), w.r);
        mpz_fdiv_q_2exp(w.r, w.a, shift);
        expect(&w, sunder_i_big_shr(&w.arena, a, shift), w.r);
        mpz_gcd(w.r, w.a, w.b);
        expect(&w, sunder_i_big_gcd(&w.arena, a, b), w.r);
        const int c = mpz_cmp(w.a, w.b);
        assert_int_equal(sunder_i_big_cmp(a, b), (c > 0) - (c < 0));
        assert_int_equal(sunder_i_big_sign(a), mpz_sgn(w.a));
        assert_int_equal(sunder_i_big_bits(a), mpz_sgn(w.a) ? mpz_sizeinbase(w.a, 2) : 0);
        if (mpz_sgn(w.a)) assert_int_equal(sunder_i_big_twos(a), mpz_scan1(w.a, 0));
        int64_t v = 0;
        /* -2^63 is left out on purpose: |a| has to fit. */
        const bool fits = mpz_sizeinbase(w.a, 2) <= 63;
        assert_int_equal(sunder_i_big_fits_i64(a, &v), fits);
        if (fits) assert_true(v == mpz_get_si(w.a));
        sunder_i_arena_release(&w.arena, mark);
    }
    close_work(&w);
}

static void test_division_and_root(void **state)
{
    (void)state;
    work w;
    open_work(&w, 4);
    for (int i = 0; i < ROUNDS; i++) {
        random_mpz(w.a, &w.g, i % 2 ? 200 : 1500);
        random_mpz(w.b, &w.g, i % 3 ? 100 : 1500);
        mpz_abs(w.b, w.b);
        mpz_add_ui(w.b, w.b, 1);
        if (i % 5 == 0) mpz_mul(w.a, w.a, w.b); /* makes the quotient exact */
        sunder_i_big a = big_from_mpz(&w.arena, w.a), b = big_from_mpz(&w.arena, w.b);
        mpz_fdiv_q(w.r, w.a, w.b);
        expect(&w, sunder_i_big_div_floor(&w.arena, a, b), w.r);
        mpz_abs(w.a, w.a);
        if (i % 4 == 0) mpz_mul(w.a, w.a, w.a); /* a square, and one less than a square */
        if (i % 8 == 0 && mpz_sgn(w.a)) mpz_sub_ui(w.a, w.a, 1);
        mpz_sqrt(w.r, w.a);
        expect(&w, sunder_i_big_sqrt_floor(&w.arena, big_from_mpz(&w.arena, w.a)), w.r);
    }
    close_work(&w);
}

/* ---- Ratios ---- */

static void exact_ratio(mpq_t r, const work *w, long exponent)
{
    mpz_set(mpq_numref(r), w->a);
    mpz_set(mpq_denref(r), w->b);
    mpq_canonicalize(r);
    if (exponent >= 0)
        mpq_mul_2exp(r, r, (mp_bitcnt_t)exponent);
    else
        mpq_div_2exp(r, r, (mp_bitcnt_t)-exponent);
}

/* down is the largest double <= r (-infinity if r is below all finite ones, the largest finite double if r is above),
 * up is the next one. */
static void expect_down(double d, const mpq_t r)
{
    mpq_t x;
    mpq_init(x);
    assert_true(d == d);
    if (isfinite(d)) {
        mpq_set_d(x, d);
        assert_true(mpq_cmp(x, r) <= 0);
        const double next = nextafter(d, INFINITY);
        if (isfinite(next)) {
            mpq_set_d(x, next);
            assert_true(mpq_cmp(x, r) > 0);
        }
    } else {
        mpq_set_d(x, -0x1.fffffffffffffp1023);
        assert_true(d < 0 && mpq_cmp(r, x) < 0);
    }
    mpq_clear(x);
}

/* d is the nearer of the two neighbours, or the even one in a tie. */
static void expect_nearest(double d, double down, double up, const mpq_t r)
{
    mpq_t x, y;
    if (down == up) {
        assert_true(d == down);
        return;
    }
    assert_true(d == down || d == up);
    mpq_inits(x, y, NULL);
    /* The successor of the greatest double would be 2^1024: rounding uses the same spacing there. */
    mpq_set_d(x, isfinite(down) ? down : -0x1p1023);
    if (!isfinite(down)) mpq_mul_2exp(x, x, 1);
    mpq_set_d(y, isfinite(up) ? up : 0x1p1023);
    if (!isfinite(up)) mpq_mul_2exp(y, y, 1);
    mpq_sub(x, r, x);
    mpq_sub(y, y, r);
    const int c = mpq_cmp(x, y);
    if (c) {
        assert_true(d == (c < 0 ? down : up));
    } else {
        uint64_t bits;
        memcpy(&bits, &d, sizeof bits);
        assert_true((bits & 1) == 0);
    }
    mpq_clears(x, y, NULL);
}

static void test_ratio(void **state)
{
    (void)state;
    work w;
    mpq_t r;
    open_work(&w, 5);
    mpq_init(r);
    for (int i = 0; i < 4 * ROUNDS; i++) {
        const sunder_i_mark mark = sunder_i_arena_mark(&w.arena);
        long exponent = rng_int(&w.g, -60, 60);
        random_mpz(w.a, &w.g, i % 2 ? 150 : 1100);
        random_mpz(w.b, &w.g, i % 3 ? 130 : 1100);
        mpz_abs(w.b, w.b);
        if (i % 4 == 0) mpz_set_ui(w.b, 1u << rng_int(&w.g, 0, 12)); /* exact results and ties */
        if (i % 4 == 0) mpz_tdiv_q_2exp(w.a, w.a, mpz_sizeinbase(w.a, 2) > 54 ? mpz_sizeinbase(w.a, 2) - 54 : 0);
        if (i % 11 == 0) exponent += 900;
        if (i % 11 == 1) exponent -= 1100;
        if (mpz_sgn(w.b) == 0) mpz_set_ui(w.b, 3);
        exact_ratio(r, &w, exponent);
        const sunder_i_big a = big_from_mpz(&w.arena, w.a), b = big_from_mpz(&w.arena, w.b);
        const double down = sunder_i_big_ratio_down(&w.arena, a, b, exponent);
        const double up = sunder_i_big_ratio_up(&w.arena, a, b, exponent);
        expect_down(down, r);
        mpq_neg(r, r);
        expect_down(-up, r);
        mpq_neg(r, r);
        expect_nearest(sunder_i_big_ratio(&w.arena, a, b, exponent), down, up, r);
        sunder_i_arena_release(&w.arena, mark);
    }
    mpq_clear(r);
    close_work(&w);
}

static void test_ratio_edges(void **state)
{
    (void)state;
    sunder_i_arena arena;
    sunder_i_arena_init(&arena);
    const sunder_i_big zero = sunder_i_big_i64(&arena, 0), one = sunder_i_big_i64(&arena, 1),
                       three = sunder_i_big_i64(&arena, 3);
    assert_true(sunder_i_big_ratio(&arena, zero, three, 900) == 0);
    assert_true(sunder_i_big_ratio(&arena, one, one, -1074) == 0x1p-1074);
    assert_true(sunder_i_big_ratio(&arena, one, one, -1075) == 0);           /* a tie is rounded to even */
    assert_true(sunder_i_big_ratio(&arena, three, one, -1076) == 0x1p-1074); /* three quarters of the least double */
    assert_true(sunder_i_big_ratio_down(&arena, three, one, -1076) == 0);
    assert_true(sunder_i_big_ratio_up(&arena, one, one, -5000) == 0x1p-1074);
    assert_true(isinf(sunder_i_big_ratio(&arena, one, one, 1024)));
    assert_true(isinf(sunder_i_big_ratio(&arena, one, one, 100000)));
    assert_true(sunder_i_big_ratio_down(&arena, one, one, 100000) == 0x1.fffffffffffffp1023);
    assert_true(sunder_i_big_ratio_up(&arena, sunder_i_big_neg(one), one, 100000) == -0x1.fffffffffffffp1023);
    sunder_i_arena_free(&arena);
}

/* Quotients near or at the midpoint of two doubles, with divisors of all lengths: the highest bits of both numbers do
 * not decide the rounding. */
static void test_ratio_in_the_middle(void **state)
{
    (void)state;
    work w;
    mpq_t r;
    open_work(&w, 6);
    mpq_init(r);
    for (int i = 0; i < ROUNDS; i++) {
        const sunder_i_mark mark = sunder_i_arena_mark(&w.arena);
        random_mpz(w.b, &w.g, i % 2 ? 70 : 400);
        mpz_abs(w.b, w.b);
        if (mpz_cmp_ui(w.b, 3) < 0) mpz_set_ui(w.b, 3);
        mpz_set_ui(w.a, i % 3 ? (1ul << 53) + (unsigned long)rng_int(&w.g, 0, 9) : (1ul << 54) - 1);
        mpz_mul_ui(w.a, w.a, 2);
        mpz_add_ui(w.a, w.a, 1);
        mpz_mul(w.a, w.a, w.b);
        if (i % 5) mpz_add(w.a, w.a, w.a); /* adds a bit to be rounded */
        const int64_t beside = rng_int(&w.g, -3, 3);
        if (beside < 0)
            mpz_sub_ui(w.a, w.a, (unsigned long)-beside);
        else
            mpz_add_ui(w.a, w.a, (unsigned long)beside);
        exact_ratio(r, &w, 0);
        const sunder_i_big a = big_from_mpz(&w.arena, w.a), b = big_from_mpz(&w.arena, w.b);
        const double down = sunder_i_big_ratio_down(&w.arena, a, b, 0), up = sunder_i_big_ratio_up(&w.arena, a, b, 0);
        expect_nearest(sunder_i_big_ratio(&w.arena, a, b, 0), down, up, r);
        sunder_i_arena_release(&w.arena, mark);
    }
    mpq_clear(r);
    close_work(&w);
}

static void test_text(void **state)
{
    (void)state;
    work w;
    mpq_t r;
    open_work(&w, 6);
    mpq_init(r);
    for (int i = 0; i < ROUNDS; i++) {
        const long exponent = rng_int(&w.g, -90, 90);
        random_mpz(w.a, &w.g, i % 2 ? 100 : 1200);
        random_mpz(w.b, &w.g, i % 3 ? 60 : 700);
        mpz_abs(w.b, w.b);
        if (mpz_sgn(w.b) == 0) mpz_set_ui(w.b, 1);
        exact_ratio(r, &w, exponent);
        char *want = mpq_get_str(NULL, 10, r);
        char *got =
            sunder_i_big_ratio_text(&w.arena, big_from_mpz(&w.arena, w.a), big_from_mpz(&w.arena, w.b), exponent);
        assert_non_null(got);
        assert_string_equal(got, want);
        sunder_i_free(got);
        free(want);
    }
    mpq_clear(r);
    close_work(&w);
}

/* ---- Out of memory ---- */

static bool big_run(void *context)
{
    (void)context;
    sunder_i_arena arena;
    sunder_i_arena_init(&arena);
    sunder_i_big a = sunder_i_big_i64(&arena, 3);
    for (int i = 0; i < 10; i++)
        a = sunder_i_big_mul(&arena, a, sunder_i_big_add(&arena, a, sunder_i_big_i64(&arena, 1)));
    const sunder_i_big g = sunder_i_big_gcd(&arena, a, sunder_i_big_shl(&arena, a, 70));
    sunder_i_big_ratio(&arena, a, sunder_i_big_i64(&arena, 7), -900);
    sunder_i_big_sqrt_floor(&arena, g);
    sunder_i_big_shr(&arena, sunder_i_big_neg(g), 13);
    char *text = sunder_i_big_ratio_text(&arena, a, sunder_i_big_i64(&arena, 35), -5);
    const bool ok = text && !arena.failed;
    sunder_i_free(text);
    sunder_i_arena_free(&arena);
    return ok;
}

static void test_out_of_memory(void **state)
{
    (void)state;
    assert_true(failing_loop(big_run, NULL, false));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_conversions),
                                       cmocka_unit_test(test_double),
                                       cmocka_unit_test(test_arithmetic),
                                       cmocka_unit_test(test_division_and_root),
                                       cmocka_unit_test(test_ratio),
                                       cmocka_unit_test(test_ratio_edges),
                                       cmocka_unit_test(test_ratio_in_the_middle),
                                       cmocka_unit_test(test_text),
                                       cmocka_unit_test(test_out_of_memory)};
    return cmocka_run_group_tests_name("number/big", tests, NULL, NULL);
}
