/* number/ball, compared with rationals of GMP: the result of an operation contains all results for numbers in the
 * operands. A sign that is reported is the true one, and it is reported for numbers that are far apart, or exact and
 * small. */
#include "number/ball.h"
#include "random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

enum { NUMBERS = 6 };

/* v * 2^exponent */
static void set_double(mpq_t out, double v, long exponent)
{
    mpq_set_d(out, v);
    if (exponent >= 0)
        mpq_mul_2exp(out, out, (mp_bitcnt_t)exponent);
    else
        mpq_div_2exp(out, out, (mp_bitcnt_t)-exponent);
}

/* middle + sign * radius */
static void set_end(mpq_t out, sunder_i_ball b, int sign)
{
    mpq_t radius;
    mpq_init(radius);
    set_double(out, b.middle, b.exponent);
    set_double(radius, sign * b.radius, b.exponent);
    mpq_add(out, out, radius);
    mpq_clear(radius);
}

static bool is_canonical(sunder_i_ball b)
{
    const double size = fmax(fabs(b.middle), b.radius);
    if (size == 0) return b.exponent == 0;
    return size == (double)INFINITY || (size >= 0.5 && size < 1 && (b.radius == 0 || b.radius >= 0x1p-60));
}

static void assert_holds(sunder_i_ball b, const mpq_t v)
{
    assert_true(is_canonical(b));
    if (b.radius == (double)INFINITY) return;
    mpq_t end;
    mpq_init(end);
    set_end(end, b, -1);
    assert_true(mpq_cmp(end, v) <= 0);
    set_end(end, b, 1);
    assert_true(mpq_cmp(end, v) >= 0);
    mpq_clear(end);
    const int sign = sunder_i_ball_sign(b);
    assert_true(sign == 0 || sign == mpq_sgn(v));
}

/* Demands that the ball contains the square root of v, by comparing squares. */
static void assert_holds_root(sunder_i_ball b, const mpq_t v)
{
    assert_true(is_canonical(b));
    if (b.radius == (double)INFINITY) return;
    mpq_t end, square;
    mpq_inits(end, square, NULL);
    set_end(end, b, 1);
    mpq_mul(square, end, end);
    assert_true(mpq_sgn(end) >= 0 && mpq_cmp(square, v) >= 0);
    set_end(end, b, -1);
    mpq_mul(square, end, end);
    assert_true(mpq_sgn(end) <= 0 || mpq_cmp(square, v) <= 0);
    mpq_clears(end, square, NULL);
}

/* Numbers of up to 2000 bits; some are short, some near others, some zero. */
static sunder_i_big random_big(sunder_i_arena *a, rng *r, sunder_i_big near)
{
    const int64_t bits = rng_once_in(r, 3) ? 40 : 2000;
    sunder_i_big v = sunder_i_big_i64(a, rng_int(r, -1000, 1000) * (rng_once_in(r, 2) ? 1 : (int64_t)1 << 50));
    v = sunder_i_big_shl(a, v, (unsigned long)rng_int(r, 0, bits));
    if (rng_once_in(r, 3)) v = sunder_i_big_add(a, v, near);
    return rng_once_in(r, 3) ? sunder_i_big_add(a, v, sunder_i_big_i64(a, rng_int(r, -3, 3))) : v;
}

static void set_big(mpq_t out, sunder_i_big v)
{
    mpz_t z;
    mpz_init(z);
    mpz_import(z, (size_t)labs(v.size), -1, sizeof(mp_limb_t), 0, 0, v.limb);
    if (v.size < 0) mpz_neg(z, z);
    mpq_set_z(out, z);
    mpz_clear(z);
}

/* Replaces one of the numbers by the result of an operation on two others; radii grow with repetition. */
static void step(rng *r, sunder_i_ball ball[NUMBERS], mpq_t value[NUMBERS])
{
    const int64_t i = rng_int(r, 0, NUMBERS - 1), j = rng_int(r, 0, NUMBERS - 1), k = rng_int(r, 0, NUMBERS - 1);
    const sunder_i_ball a = ball[j], b = ball[k];
    switch (rng_int(r, 0, 4)) {
    case 0:
        ball[i] = sunder_i_ball_add(a, b);
        mpq_add(value[i], value[j], value[k]);
        break;
    case 1:
        ball[i] = sunder_i_ball_sub(a, b);
        mpq_sub(value[i], value[j], value[k]);
        break;
    case 2:
        if (mpq_sgn(value[k]) == 0) break;
        ball[i] = sunder_i_ball_div(a, b);
        mpq_div(value[i], value[j], value[k]);
        break;
    case 3:
        if (mpq_sgn(value[j]) >= 0) assert_holds_root(sunder_i_ball_sqrt(a), value[j]);
        break;
    default:
        ball[i] = sunder_i_ball_shift(sunder_i_ball_mul(a, b), -7);
        mpq_mul(value[i], value[j], value[k]);
        mpq_div_2exp(value[i], value[i], 7);
    }
    assert_holds(ball[i], value[i]);
}

static void operations_hold_what_is_true(void **state)
{
    for (uint64_t n = 0; n < test_count(2000); n++) {
        rng r = rng_start(test_seed(), n);
        sunder_i_arena a = {0};
        sunder_i_ball ball[NUMBERS];
        mpq_t value[NUMBERS];
        sunder_i_big v = {NULL, 0};
        for (int i = 0; i < NUMBERS; i++) {
            v = random_big(&a, &r, v);
            ball[i] = sunder_i_ball_big(v);
            mpq_init(value[i]);
            set_big(value[i], v);
            assert_holds(ball[i], value[i]);
        }
        for (int i = 0; i < 6; i++) step(&r, ball, value);
        for (int i = 0; i < NUMBERS; i++) mpq_clear(value[i]);
        assert_false(a.failed);
        sunder_i_arena_free(&a);
    }
}

static void what_is_far_apart_is_told(void **state)
{
    sunder_i_arena a = {0};
    const sunder_i_ball one = sunder_i_ball_big(sunder_i_big_i64(&a, 1)),
                        three = sunder_i_ball_big(sunder_i_big_i64(&a, 3));
    const sunder_i_ball huge = sunder_i_ball_shift(three, 5000), tiny = sunder_i_ball_shift(one, -5000);
    assert_int_equal(sunder_i_ball_sign(sunder_i_ball_sub(huge, one)), 1);
    assert_int_equal(sunder_i_ball_sign(sunder_i_ball_sub(tiny, one)), -1);
    assert_int_equal(sunder_i_ball_sign(sunder_i_ball_mul(huge, tiny)), 1);
    assert_int_equal(sunder_i_ball_sign(sunder_i_ball_sub(sunder_i_ball_sqrt(huge), one)), 1);
    /* 1 - 3 / 3 may be any number near zero, so a quotient by it has no bounds. */
    const sunder_i_ball zero = sunder_i_ball_sub(one, sunder_i_ball_div(three, three));
    const sunder_i_ball anything = sunder_i_ball_div(huge, zero);
    assert_int_equal(sunder_i_ball_sign(zero), 0);
    assert_true(anything.radius == (double)INFINITY);
    assert_int_equal(sunder_i_ball_sign(sunder_i_ball_add(sunder_i_ball_mul(anything, tiny), huge)), 0);
    assert_int_equal(sunder_i_ball_sign(sunder_i_ball_sqrt(anything)), 0);
    /* The difference of equal exact numbers is exact. */
    assert_true(sunder_i_ball_sub(three, three).radius == 0);
    sunder_i_arena_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(operations_hold_what_is_true),
        cmocka_unit_test(what_is_far_apart_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
