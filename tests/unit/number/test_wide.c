/* number/wide: fixed-width integers compared with GMP, at the widest operands that each function allows. */
#include "gmp_numbers.h"
#include "number/wide.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

#define ROUNDS 20000

typedef struct numbers {
    mpz_t a, b, c, d, s, t;
} numbers;

static void open_numbers(numbers *n) { mpz_inits(n->a, n->b, n->c, n->d, n->s, n->t, NULL); }
static void close_numbers(numbers *n) { mpz_clears(n->a, n->b, n->c, n->d, n->s, n->t, NULL); }

static int sign(int v) { return (v > 0) - (v < 0); }

static void test_signs(void **state)
{
    (void)state;
    const sunder_i_i128 big = (sunder_i_i128)1 << 100;
    assert_int_equal(sunder_i_i128_sign(0), 0);
    assert_int_equal(sunder_i_i128_sign(big), 1);
    assert_int_equal(sunder_i_i128_sign(-big), -1);
    assert_true(sunder_i_i128_abs(-big) == (sunder_i_u128)big);
    assert_true(sunder_i_i128_abs(0) == 0);
}

static void test_mul(void **state)
{
    (void)state;
    numbers n;
    open_numbers(&n);
    rng g = rng_start(test_seed(), 1);
    for (int i = 0; i < ROUNDS; i++) {
        const sunder_i_u128 a = sunder_i_i128_abs(random_i128(&g, 127)) << (i & 1),
                            b = sunder_i_i128_abs(random_i128(&g, 127)) << (i & 1);
        uint64_t r[4];
        const uint64_t la[2] = {(uint64_t)a, (uint64_t)(a >> 64)}, lb[2] = {(uint64_t)b, (uint64_t)(b >> 64)};
        sunder_i_u128_mul(a, b, r);
        mpz_from_limbs(n.a, la, 2);
        mpz_from_limbs(n.b, lb, 2);
        mpz_mul(n.s, n.a, n.b);
        mpz_from_limbs(n.t, r, 4);
        assert_int_equal(mpz_cmp(n.s, n.t), 0);
        assert_int_equal(sunder_i_limbs_cmp(la, lb, 2), sign(mpz_cmp(n.a, n.b)));
    }
    close_numbers(&n);
}

static void test_cmp_products(void **state)
{
    (void)state;
    numbers n;
    open_numbers(&n);
    rng g = rng_start(test_seed(), 2);
    int equal = 0;
    for (int i = 0; i < ROUNDS; i++) {
        sunder_i_i128 a = random_i128(&g, 127), b = random_i128(&g, 127), c = random_i128(&g, 127),
                      d = random_i128(&g, 127);
        if (i % 3 == 0) { /* a * b and b * a, or products that differ by one */
            c = b;
            d = a;
        }
        mpz_from_i128(n.a, a);
        mpz_from_i128(n.b, b);
        mpz_from_i128(n.c, c);
        mpz_from_i128(n.d, d);
        mpz_mul(n.s, n.a, n.b);
        mpz_mul(n.t, n.c, n.d);
        const int want = sign(mpz_cmp(n.s, n.t));
        equal += want == 0;
        assert_int_equal(sunder_i_cmp_products(a, b, c, d), want);
        assert_int_equal(sunder_i_cmp_products(c, d, a, b), -want);
    }
    assert_true(equal > ROUNDS / 4);
    close_numbers(&n);
}

/* a, c below 2^63 in magnitude, b, d below 2^127: what the contract allows of 64-bit integers. */
static sunder_i_i256 random_sum(rng *g, mpz_t r)
{
    mpz_t b, d;
    mpz_inits(b, d, NULL);
    const int64_t a = (int64_t)random_i128(g, 63), c = (int64_t)random_i128(g, 63);
    sunder_i_i128 y = random_i128(g, 127), z = random_i128(g, 127);
    int64_t e = c;
    if (rng_once_in(g, 6)) z = y, e = -a; /* the terms cancel */
    mpz_from_i128(b, y);
    mpz_from_i128(d, z);
    mpz_mul_si(r, b, a);
    mpz_mul_si(d, d, e);
    mpz_add(r, r, d);
    mpz_clears(b, d, NULL);
    return sunder_i_mul_add(a, y, e, z);
}

static void test_mul_add(void **state)
{
    (void)state;
    numbers n;
    open_numbers(&n);
    rng g = rng_start(test_seed(), 3);
    int zeros = 0;
    for (int i = 0; i < ROUNDS; i++) {
        const sunder_i_i256 v = random_sum(&g, n.a), w = random_sum(&g, n.b);
        mpz_from_i256(n.s, &v);
        assert_int_equal(mpz_cmp(n.s, n.a), 0);
        assert_int_equal(v.sign, mpz_sgn(n.a)); /* canonical: the sign is 0 exactly if the value is zero */
        assert_int_equal(sunder_i_i256_cmp(&v, &w), sign(mpz_cmp(n.a, n.b)));
        assert_int_equal(sunder_i_i256_cmp(&v, &v), 0);
        zeros += v.sign == 0;
    }
    assert_true(zeros > 100);
    close_numbers(&n);
}

/* Short factors, including the extremes of 64 bits. */
static void test_mul_add_short(void **state)
{
    (void)state;
    numbers n;
    open_numbers(&n);
    rng g = rng_start(test_seed(), 6);
    for (int i = 0; i < ROUNDS; i++) {
        int64_t f[4];
        for (int k = 0; k < 4; k++) {
            const bool extreme = rng_once_in(&g, 4);
            f[k] = extreme ? (rng_once_in(&g, 2) ? INT64_MAX : -INT64_MAX) : (int64_t)random_i128(&g, 63);
        }
        const sunder_i_i128 b = rng_once_in(&g, 8) ? INT64_MIN : f[1];
        mpz_from_i128(n.b, b);
        mpz_mul_si(n.s, n.b, f[0]);
        mpz_set_si(n.d, f[3]);
        mpz_mul_si(n.d, n.d, f[2]);
        mpz_add(n.s, n.s, n.d);
        const sunder_i_i256 v = sunder_i_mul_add(f[0], b, f[2], f[3]);
        mpz_from_i256(n.a, &v);
        assert_int_equal(mpz_cmp(n.a, n.s), 0);
        assert_int_equal(v.sign, mpz_sgn(n.s));
        assert_true(sunder_i_i128_double(b) == (double)b);
    }
    close_numbers(&n);
}

/* |p / v - q / w| rounded up. */
static double apart_of(const numbers *n)
{
    mpq_t x, y;
    mpq_inits(x, y, NULL);
    mpq_set_num(x, n->a);
    mpq_set_den(x, n->b);
    mpq_set_num(y, n->c);
    mpq_set_den(y, n->d);
    mpq_canonicalize(x);
    mpq_canonicalize(y);
    mpq_sub(x, x, y);
    const double apart = nextafter(fabs(mpq_get_d(x)), INFINITY);
    mpq_clears(x, y, NULL);
    return apart;
}

/* p / v and q / w close to each other, of any length: if their lengths allow, the lowest bits decide their order. */
static void test_low_bits(void **state)
{
    (void)state;
    numbers n;
    open_numbers(&n);
    rng g = rng_start(test_seed(), 7);
    int low_64 = 0, low_128 = 0, equal = 0;
    for (int i = 0; i < ROUNDS; i++) {
        const unsigned bits = i % 2 ? 62 : 100;
        const sunder_i_i128 v = (sunder_i_i128)sunder_i_i128_abs(random_i128(&g, bits)) + 1;
        const sunder_i_i128 w = (sunder_i_i128)sunder_i_i128_abs(random_i128(&g, bits)) + 1;
        mpz_from_i128(n.b, v);
        mpz_from_i128(n.d, w);
        mpz_from_i128(n.a, random_i128(&g, 126)); /* p = a v + a small number, q = a w + a small number */
        mpz_mul(n.c, n.a, n.d);
        mpz_mul(n.a, n.a, n.b);
        const int64_t off = i % 3 ? (int64_t)random_i128(&g, 20) : 0;
        mpz_set_si(n.s, off);
        mpz_add(n.a, n.a, n.s);
        const double apart = apart_of(&n);
        mpz_mul(n.s, n.a, n.d);
        mpz_mul(n.t, n.c, n.b);
        const int want = sign(mpz_cmp(n.s, n.t));
        mpz_t mask;
        mpz_init_set_ui(mask, 1);
        mpz_mul_2exp(mask, mask, 128);
        mpz_fdiv_r(n.a, n.a, mask); /* the lowest bits, in two's complement */
        mpz_fdiv_r(n.c, n.c, mask);
        mpz_clear(mask);
        uint64_t p[2] = {0, 0}, q[2] = {0, 0};
        mpz_export(p, NULL, -1, sizeof *p, 0, 0, n.a);
        mpz_export(q, NULL, -1, sizeof *q, 0, 0, n.c);
        const bool is_short = sunder_i_i128_is_short(v) && sunder_i_i128_is_short(w);
        if (is_short && sunder_i_is_low_64(apart, (int64_t)v, (int64_t)w)) {
            assert_int_equal(sunder_i_sign_low_64(p[0], (uint64_t)v, q[0], (uint64_t)w), want);
            low_64++;
        }
        if (sunder_i_is_low_128(apart, v, w)) {
            const sunder_i_u128 pl = (sunder_i_u128)p[1] << 64 | p[0], ql = (sunder_i_u128)q[1] << 64 | q[0];
            assert_int_equal(sunder_i_sign_low_128(pl, (sunder_i_u128)v, ql, (sunder_i_u128)w), want);
            low_128++;
            equal += want == 0;
        }
    }
    assert_true(low_64 > ROUNDS / 20 && low_128 > low_64 && equal > ROUNDS / 20);
    close_numbers(&n);
}

static void test_cmp_products_256(void **state)
{
    (void)state;
    numbers n;
    open_numbers(&n);
    rng g = rng_start(test_seed(), 4);
    for (int i = 0; i < ROUNDS; i++) {
        sunder_i_i256 a = random_sum(&g, n.a), c = random_sum(&g, n.c);
        sunder_i_i128 b = random_i128(&g, 127), d = random_i128(&g, 127);
        if (i % 4 == 0) c = a, mpz_set(n.c, n.a), d = i % 8 ? b / 2 : b;
        mpz_from_i128(n.b, b);
        mpz_from_i128(n.d, d);
        mpz_mul(n.s, n.a, n.b);
        mpz_mul(n.t, n.c, n.d);
        assert_int_equal(sunder_i_cmp_products_256(&a, b, &c, d), sign(mpz_cmp(n.s, n.t)));
    }
    close_numbers(&n);
}

/* With divisors of any length, as in coordinates of crossings; also a long and a short one. */
static void test_gcd(void **state)
{
    (void)state;
    numbers n;
    open_numbers(&n);
    rng g = rng_start(test_seed(), 6);
    for (int i = 0; i < ROUNDS; i++) {
        const unsigned bits = (unsigned)rng_int(&g, 1, 62);
        sunder_i_i128 common = random_i128(&g, bits), a = random_i128(&g, 63) * common,
                      b = random_i128(&g, 63) * common;
        if (i % 8 == 0) b = a;
        if (i % 8 == 1) b = common;
        if (i % 8 == 2) b = random_i128(&g, 62);
        if (a == 0 || b == 0) continue;
        mpz_from_i128(n.a, a);
        mpz_from_i128(n.b, b);
        mpz_gcd(n.s, n.a, n.b);
        mpz_from_i128(n.t, (sunder_i_i128)sunder_i_u128_gcd(sunder_i_i128_abs(a), sunder_i_i128_abs(b)));
        assert_int_equal(mpz_cmp(n.s, n.t), 0);
    }
    close_numbers(&n);
}

static void test_i256_double(void **state)
{
    (void)state;
    numbers n;
    mpq_t e, x;
    open_numbers(&n);
    mpq_inits(e, x, NULL);
    rng g = rng_start(test_seed(), 5);
    for (int i = 0; i < ROUNDS; i++) {
        const sunder_i_i256 v = random_sum(&g, n.a);
        const double d = sunder_i_i256_double(&v);
        if (v.sign == 0) {
            assert_true(d == 0);
            continue;
        }
        /* |d - v| < 2^-51 |v| */
        mpq_set_d(e, d);
        mpq_set_z(x, n.a);
        mpq_sub(e, e, x);
        mpq_abs(e, e);
        mpq_abs(x, x);
        mpq_div_2exp(x, x, 51);
        assert_true(mpq_cmp(e, x) < 0);
    }
    mpq_clears(e, x, NULL);
    close_numbers(&n);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_signs),
                                       cmocka_unit_test(test_mul),
                                       cmocka_unit_test(test_cmp_products),
                                       cmocka_unit_test(test_mul_add),
                                       cmocka_unit_test(test_mul_add_short),
                                       cmocka_unit_test(test_low_bits),
                                       cmocka_unit_test(test_cmp_products_256),
                                       cmocka_unit_test(test_gcd),
                                       cmocka_unit_test(test_i256_double)};
    return cmocka_run_group_tests_name("number/wide", tests, NULL, NULL);
}
