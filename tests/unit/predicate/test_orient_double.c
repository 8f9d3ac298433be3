/* predicate/orient_double: sunder_orient() and each of its stages (filter, wide integers, big integers) compared with
 * GMP, for doubles of every size. */
#include "failing.h"
#include "predicate/orient_double.h"
#include "random.h"

#include <float.h>
#include <gmp.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static int slow(const sunder_point *a, const sunder_point *b, const sunder_point *c)
{
    mpq_t p[6], s, t;
    const double v[6] = {b->x, a->x, c->y, a->y, 0, 0}, w[6] = {b->y, a->y, c->x, a->x, 0, 0};
    mpq_inits(s, t, NULL);
    for (int i = 0; i < 6; i++) mpq_init(p[i]);
    for (int i = 0; i < 4; i++) mpq_set_d(p[i], v[i]);
    mpq_sub(p[0], p[0], p[1]);
    mpq_sub(p[2], p[2], p[3]);
    mpq_mul(s, p[0], p[2]);
    for (int i = 0; i < 4; i++) mpq_set_d(p[i], w[i]);
    mpq_sub(p[0], p[0], p[1]);
    mpq_sub(p[2], p[2], p[3]);
    mpq_mul(t, p[0], p[2]);
    const int sign = mpq_cmp(s, t);
    mpq_clears(s, t, NULL);
    for (int i = 0; i < 6; i++) mpq_clear(p[i]);
    return (sign > 0) - (sign < 0);
}

/* How often the filter decided, and how often the points were collinear. */
typedef struct tally {
    int filter, zero;
} tally;

static void check(const sunder_point *a, const sunder_point *b, const sunder_point *c, tally *t)
{
    const int want = slow(a, b, c);
    const int filter = sunder_i_orient_filter(a, b, c);
    assert_int_equal(sunder_orient(a, b, c), want);
    assert_int_equal(sunder_orient(b, a, c), -want);
    assert_int_equal(sunder_orient(b, c, a), want);
    if (filter != SUNDER_I_UNSURE) assert_int_equal(filter, want);
    assert_int_equal(sunder_i_orient_exact(a, b, c), want);
    t->filter += filter != SUNDER_I_UNSURE;
    t->zero += want == 0;
}

static void test_near_collinear(void **state)
{
    (void)state;
    rng g = rng_start(test_seed(), 41);
    tally t = {0, 0};
    const int n = 20000;
    for (int i = 0; i < n; i++) {
        const int scale = i % 3 ? 0 : (int)rng_int(&g, -400, 400);
        sunder_point a = {rng_unit(&g), rng_unit(&g)}, b = {rng_unit(&g), rng_unit(&g)}, c;
        const double s = rng_unit(&g) * 3 - 1;
        c.x = a.x + s * (b.x - a.x);
        c.y = a.y + s * (b.y - a.y);
        if (i % 2) c.y = nextafter(c.y, i % 4 == 1 ? 9 : -9);
        if (i % 5 == 0) { /* small integers: exact zeros */
            a = (sunder_point){(double)rng_int(&g, 0, 6), (double)rng_int(&g, 0, 6)};
            b = (sunder_point){(double)rng_int(&g, 0, 6), (double)rng_int(&g, 0, 6)};
            c = (sunder_point){2 * b.x - a.x, 2 * b.y - a.y};
        }
        sunder_point *p[3] = {&a, &b, &c};
        for (int k = 0; k < 3; k++) p[k]->x = ldexp(p[k]->x, scale), p[k]->y = ldexp(p[k]->y, scale);
        check(&a, &b, &c, &t);
    }
    print_message("filter %d, zero %d of %d\n", t.filter, t.zero, n);
    assert_true(t.filter > n / 100 && t.filter < n && t.zero > n / 10);
}

static void test_sizes(void **state)
{
    (void)state;
    static const double v[] = {0,         -0.0,       1,     -1,     DBL_MAX,    -DBL_MAX, DBL_MIN,
                               0x1p-1074, -0x1p-1074, 1e300, 1e-300, 0x1p52 + 1, 3,        0.1};
    rng g = rng_start(test_seed(), 42);
    const int64_t last = (int64_t)(sizeof v / sizeof *v) - 1;
    tally t = {0, 0};
    for (int i = 0; i < 20000; i++) {
        const sunder_point a = {v[rng_int(&g, 0, last)], v[rng_int(&g, 0, last)]};
        const sunder_point b = {v[rng_int(&g, 0, last)], v[rng_int(&g, 0, last)]};
        const sunder_point c = {v[rng_int(&g, 0, last)], v[rng_int(&g, 0, last)]};
        check(&a, &b, &c, &t);
    }
    assert_true(t.zero > 100);
}

static void test_map(void **state)
{
    (void)state;
    rng g = rng_start(test_seed(), 43);
    tally t = {0, 0};
    for (int i = 0; i < 20000; i++) {
        sunder_point p[3];
        for (int k = 0; k < 3; k++) {
            p[k].x = rint((451234.567 + 5 * rng_unit(&g)) * 1000) / 1000;
            p[k].y = rint((5411234.567 + (i % 2 ? 0 : 5 * rng_unit(&g))) * 1000) / 1000;
        }
        check(&p[0], &p[1], &p[2], &t);
    }
    assert_true(t.zero >= 10000);
}

/* Without memory the sign is still the true one. */
static void test_orient_without_memory(void **state)
{
    (void)state;
    failing_begin();
    failing_at(1, true);
    const sunder_point a = {0, 0}, b = {0x1p-1074, 0x1p1000}, c = {0x1p-1074, 0x1.0000000000001p1000};
    assert_int_equal(sunder_orient(&a, &b, &c), 1);
    assert_int_equal(sunder_orient(&a, &c, &b), -1);
    assert_int_equal(sunder_orient(&b, &b, &c), 0);
    assert_false(failing_happened());
    failing_end();
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_near_collinear), cmocka_unit_test(test_sizes),
                                       cmocka_unit_test(test_map), cmocka_unit_test(test_orient_without_memory)};
    return cmocka_run_group_tests_name("predicate/orient", tests, NULL, NULL);
}
