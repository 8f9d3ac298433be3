/* Does a pair stand worse than it stood? The library's exact answer against rationals by brute force, on placements
 * that tie, that differ by a unit in the last place, and others. */
#include "generate.h"
#include "standing.h"

#include "separation/separation.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

static void random_shape(rng *r, polyset *s)
{
    if (rng_once_in(r, 2))
        random_simple(s, r, (int)rng_int(r, 3, 6), 8);
    else
        random_convex(s, r, (int)rng_int(r, 3, 6), 6);
    if (rng_once_in(r, 3)) polyset_scale(s, 0.1, 0.3);
}

/* The same again, mirrored or turned by a quarter, by which nothing is nearer or deeper; then put off by a hair. */
static void restage(rng *r, const polyset *from, polyset *to, int way, double hair)
{
    polyset_copy(to, from);
    if (way & 1) polyset_scale(to, -1, 1);
    if (way & 2) polyset_scale(to, 1, -1);
    if (way & 4)
        for (size_t k = 0; k < to->vertices; k++) {
            const double x = to->xy[2 * k];
            to->xy[2 * k] = to->xy[2 * k + 1];
            to->xy[2 * k + 1] = x;
        }
    polyset_move(to, rng_once_in(r, 2) ? hair : 0, rng_once_in(r, 2) ? -hair : 0);
}

/* Rings the right way round again. */
static sunder_shape *shape_of(polyset *s)
{
    double area = 0;
    for (size_t k = 0; k < s->vertices; k++) {
        const double *p = s->xy + 2 * k, *q = s->xy + 2 * ((k + 1) % s->vertices);
        area += p[0] * q[1] - q[0] * p[1];
    }
    if (area < 0) polyset_turn_rings(s, 0);
    return polyset_shape(s);
}

static void check_worse(void **state)
{
    (void)state;
    size_t ties = 0, worse_n = 0;
    const size_t trials = test_count(400);
    for (size_t k = 0; k < trials; k++) {
        rng r = rng_start(test_seed(), k);
        polyset p[2], q[2];
        for (int e = 0; e < 2; e++) {
            polyset_init(&p[e]);
            polyset_init(&q[e]);
        }
        random_shape(&r, &p[0]);
        random_shape(&r, &q[0]);
        polyset_move(&q[0], (double)rng_int(&r, -12, 12) / 2, (double)rng_int(&r, -12, 12) / 2);
        const int way = (int)rng_int(&r, 0, 7);
        const double hair = rng_once_in(&r, 3) ? 0 : ldexp(1, -(int)rng_int(&r, 30, 50));
        restage(&r, &p[0], &p[1], way, 0);
        restage(&r, &q[0], &q[1], way, hair);
        sunder_shape *ps[2], *qs[2];
        standing s[2];
        for (int e = 0; e < 2; e++) {
            ps[e] = shape_of(&p[e]);
            qs[e] = shape_of(&q[e]);
            assert_true(ps[e] && qs[e]);
            standing_of(&s[e], &p[e], &q[e]);
        }
        for (int e = 0; e < 2; e++) {
            const sunder_i_pair was = {ps[e], qs[e], NULL, NULL}, is = {ps[1 - e], qs[1 - e], NULL, NULL};
            bool worse;
            assert_int_equal(sunder_i_is_worse(&was, &is, &worse, NULL), SUNDER_OK);
            const bool expected = stands_worse(&s[1 - e], &s[e]);
            if (worse != expected)
                fail_msg("trial %zu: %s, but %s\n%s\n%s\n%s\n%s", k, worse ? "worse" : "no worse",
                         expected ? "it is" : "it is not", polyset_wkt(&p[e]), polyset_wkt(&q[e]),
                         polyset_wkt(&p[1 - e]), polyset_wkt(&q[1 - e]));
            worse_n += worse;
        }
        ties += s[0].meet == s[1].meet && mpq_equal(s[0].square, s[1].square);
        for (int e = 0; e < 2; e++) {
            standing_clear(&s[e]);
            sunder_shape_free(ps[e]);
            sunder_shape_free(qs[e]);
            polyset_free(&p[e]);
            polyset_free(&q[e]);
        }
    }
    print_message("%zu ties, %zu of %zu questions said worse\n", ties, worse_n, 2 * trials);
    assert_true(ties > trials / 10 && worse_n > trials / 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_worse)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
