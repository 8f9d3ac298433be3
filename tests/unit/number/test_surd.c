/* number/surd: signs and digits of numbers with square roots, compared with intervals of long binary fractions, and
 * cases in which only exact arithmetic recognises that a number is zero. */
#include "number/surd.h"
#include "random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static sunder_i_surd integer(sunder_i_arena *a, int64_t v) { return sunder_i_surd_big(a, sunder_i_big_i64(a, v)); }

static sunder_i_surd root(sunder_i_arena *a, sunder_i_roots *roots, sunder_i_surd square)
{
    sunder_i_surd r;
    assert_true(sunder_i_surd_root(a, roots, square, &r));
    return r;
}

static void roots_of_squares_are_integers(void **state)
{
    sunder_i_arena a = {0};
    sunder_i_roots roots = {.n = 0};
    sunder_i_surd r;
    for (int64_t v = 0; v < 50; v++) {
        assert_true(sunder_i_surd_root(&a, &roots, integer(&a, v * v), &r));
        assert_int_equal(roots.n, 0);
        assert_int_equal(sunder_i_surd_sign(&a, &roots, sunder_i_surd_sub(&a, r, integer(&a, v))), 0);
    }
    assert_false(sunder_i_surd_root(&a, &roots, integer(&a, -1), &r));
    /* 2 - sqrt 4 and sqrt 2 - sqrt 2 are zero, and so are their roots. */
    const sunder_i_surd two = root(&a, &roots, integer(&a, 2)), same = root(&a, &roots, integer(&a, 2));
    assert_int_equal(roots.n, 2);
    r = root(&a, &roots, sunder_i_surd_sub(&a, two, same));
    assert_int_equal(roots.n, 2);
    assert_int_equal(sunder_i_surd_sign(&a, &roots, r), 0);
    sunder_i_arena_free(&a);
}

/* sqrt(5 + 2 sqrt 6) = sqrt 2 + sqrt 3, and the roots of 8 and 2 are not independent. */
static void zero_is_seen(void **state)
{
    sunder_i_arena a = {0};
    sunder_i_roots roots = {.n = 0};
    const sunder_i_surd two = root(&a, &roots, integer(&a, 2)), three = root(&a, &roots, integer(&a, 3));
    const sunder_i_surd six = sunder_i_surd_mul(&a, &roots, two, three);
    const sunder_i_surd nested = root(&a, &roots, sunder_i_surd_add(&a, integer(&a, 5), sunder_i_surd_shl(&a, six, 1)));
    const sunder_i_surd sum = sunder_i_surd_add(&a, two, three);
    assert_int_equal(sunder_i_surd_sign(&a, &roots, sunder_i_surd_sub(&a, nested, sum)), 0);
    const sunder_i_surd eight = root(&a, &roots, integer(&a, 8));
    assert_int_equal(roots.n, 4);
    assert_int_equal(sunder_i_surd_sign(&a, &roots, sunder_i_surd_sub(&a, eight, sunder_i_surd_shl(&a, two, 1))), 0);
    const sunder_i_surd off = sunder_i_surd_add(&a, sunder_i_surd_shl(&a, nested, 200), integer(&a, 1));
    assert_int_equal(sunder_i_surd_sign(&a, &roots, sunder_i_surd_sub(&a, off, sunder_i_surd_shl(&a, sum, 200))), 1);
    sunder_i_arena_free(&a);
}

/* A random number over the same roots; equal roots are shared. */
static void joining_shares_roots(void **state)
{
    sunder_i_arena a = {0};
    sunder_i_roots u = {.n = 0}, v = {.n = 0};
    const sunder_i_surd ut = root(&a, &u, integer(&a, 2)), uf = root(&a, &u, sunder_i_surd_add(&a, ut, integer(&a, 7)));
    const sunder_i_surd v5 = root(&a, &v, integer(&a, 5)), vt = root(&a, &v, integer(&a, 2));
    int place[SUNDER_I_SURD_ROOTS];
    sunder_i_roots all = u;
    assert_true(sunder_i_roots_join(&a, &all, &v, place));
    assert_int_equal(all.n, 3);
    assert_int_equal(place[1], 0);
    const sunder_i_surd lifted = sunder_i_surd_lift(&a, sunder_i_surd_add(&a, v5, vt), place);
    /* sqrt 5 + sqrt 2 > sqrt(7 + sqrt 2) */
    assert_int_equal(sunder_i_surd_sign(&a, &all, sunder_i_surd_sub(&a, lifted, uf)), 1);
    assert_int_equal(sunder_i_surd_sign(&a, &all, sunder_i_surd_sub(&a, sunder_i_surd_lift(&a, vt, place), ut)), 0);
    sunder_i_arena_free(&a);
}

static sunder_i_surd random_surd(sunder_i_arena *a, const sunder_i_roots *roots, rng *r, int bits)
{
    const int64_t most = ((int64_t)1 << bits) - 1;
    sunder_i_big *part = sunder_i_arena_alloc(a, (size_t)1 << roots->n, sizeof *part);
    for (size_t k = 0; k < (size_t)1 << roots->n; k++) part[k] = sunder_i_big_i64(a, rng_int(r, -most, most));
    return (sunder_i_surd){roots->n, part};
}

/* Products and signs agree with the digits, and results with more digits agree with those with fewer. */
static void signs_agree_with_digits(void **state)
{
    for (uint64_t i = 0; i < 2000; i++) {
        rng g = rng_start(test_seed(), i);
        sunder_i_arena a = {0};
        sunder_i_roots roots = {.n = 0};
        const int bits = (int)rng_int(&g, 1, 60), most = (int)rng_int(&g, 1, 4);
        while (roots.n < most) {
            sunder_i_surd r;
            const bool plain = rng_once_in(&g, 2);
            const sunder_i_surd square = plain ? integer(&a, rng_int(&g, 2, 1000)) : random_surd(&a, &roots, &g, bits);
            sunder_i_surd_root(&a, &roots, square, &r);
        }
        const sunder_i_surd u = random_surd(&a, &roots, &g, bits), v = random_surd(&a, &roots, &g, bits);
        const sunder_i_surd w = sunder_i_surd_mul(&a, &roots, u, v);
        const sunder_i_big near = sunder_i_surd_scaled(&a, &roots, w, 400);
        const sunder_i_big far = sunder_i_surd_scaled(&a, &roots, w, 17);
        if (sunder_i_big_bits(near) > 3) assert_int_equal(sunder_i_surd_sign(&a, &roots, w), sunder_i_big_sign(near));
        assert_int_equal(sunder_i_surd_sign(&a, &roots, w),
                         sunder_i_surd_sign(&a, &roots, u) * sunder_i_surd_sign(&a, &roots, v));
        const sunder_i_big off = sunder_i_big_sub(&a, sunder_i_big_shr(&a, near, 383), far);
        assert_true(sunder_i_big_bits(off) <= 2);
        /* (u v)^2 = u^2 v^2, and u v - v u = 0 */
        const sunder_i_surd uu = sunder_i_surd_mul(&a, &roots, u, u), vv = sunder_i_surd_mul(&a, &roots, v, v);
        const sunder_i_surd ww = sunder_i_surd_mul(&a, &roots, w, w);
        const sunder_i_surd d = sunder_i_surd_sub(&a, ww, sunder_i_surd_mul(&a, &roots, uu, vv));
        assert_int_equal(sunder_i_surd_sign(&a, &roots, d), 0);
        assert_false(a.failed);
        sunder_i_arena_free(&a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(roots_of_squares_are_integers),
        cmocka_unit_test(zero_is_seen),
        cmocka_unit_test(joining_shares_roots),
        cmocka_unit_test(signs_agree_with_digits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
