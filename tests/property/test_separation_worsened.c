/* Is a pair worse than it was? The library's exact answer compared with brute force in rationals, for placements that
 * are equally good, that differ by a unit in the last place, and others. */
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

/* The same again, mirrored or rotated by a quarter turn, which changes no distance or depth; then shifted by a unit in
 * the last place. */
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

/* Makes a shape, after correcting the orientation of its rings. */
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
            assert_int_equal(sunder_i_pair_worsened(&was, &is, &worse, NULL), SUNDER_OK);
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
    print_message("%zu ties, %zu of %zu pairs are worse\n", ties, worse_n, 2 * trials);
    assert_true(ties > trials / 10 && worse_n > trials / 4);
}

/* Is the sum exact in doubles? (Knuth's TwoSum.) */
static bool add_exactly(double *to, double d)
{
    const double sum = *to + d, part = sum - *to, lost = (*to - (sum - part)) + (d - part);
    *to = sum;
    return lost == 0;
}

/* The same pair is compared at many places, as a translated shape and as a shape of its own. */
static void check_worse_since(void **state)
{
    size_t worse_n = 0, asked = 0;
    const size_t trials = test_count(300);
    for (size_t k = 0; k < trials; k++) {
        rng r = rng_start(test_seed(), 1000000 + k);
        polyset p, q;
        standing before;
        sunder_i_depth depth = {.stood = SUNDER_I_STOOD_UNKNOWN};
        polyset_init(&p);
        polyset_init(&q);
        random_shape(&r, &p);
        random_shape(&r, &q);
        polyset_move(&q, (double)rng_int(&r, -6, 6) / 2, (double)rng_int(&r, -6, 6) / 2);
        sunder_shape *ps = shape_of(&p), *qs = shape_of(&q);
        assert_true(ps && qs);
        standing_of(&before, &p, &q);
        const double unit = rng_once_in(&r, 3) ? 0x1p-40 : rng_once_in(&r, 2) ? 0.125 : 1;
        for (int m = 0; m < 8; m++) {
            double t[2][2];
            for (int c = 0; c < 4; c++) t[c / 2][c % 2] = unit * (double)rng_int(&r, -3, 3);
            polyset moved;
            standing now;
            bool exact = true; /* sums of tenths may be rounded; then the rounded shape is tested */
            polyset_copy(&moved, &q);
            for (size_t v = 0; v < 2 * moved.vertices; v++)
                exact = add_exactly(&moved.xy[v], t[1][v % 2] - t[0][v % 2]) && exact;
            const bool own = !exact || rng_once_in(&r, 3);
            sunder_shape *there = shape_of(&moved);
            standing_of(&now, &p, &moved);
            const sunder_i_pair was = {ps, qs, NULL, NULL};
            const sunder_i_pair is = own ? (sunder_i_pair){ps, there, NULL, NULL} : (sunder_i_pair){ps, qs, t[0], t[1]};
            bool worse;
            assert_int_equal(sunder_i_pair_worsened_since(&was, &depth, &is, &worse, NULL), SUNDER_OK);
            assert_int_equal(worse, stands_worse(&now, &before));
            worse_n += worse;
            asked++;
            standing_clear(&now);
            sunder_shape_free(there);
            polyset_free(&moved);
        }
        standing_clear(&before);
        sunder_shape_free(ps);
        sunder_shape_free(qs);
        polyset_free(&p);
        polyset_free(&q);
    }
    print_message("%zu of %zu pairs are worse\n", worse_n, asked);
    assert_true(worse_n > asked / 10 && worse_n < asked * 9 / 10);
}

/* ---- The oracle itself ------------------------------------------------------------------------------------------ */

/* The greatest of the dot products of n with the corners of p. */
static void support_of(mpq_t out, const polyset *p, const mpq_t n[2])
{
    mpq_t at, t;
    mpq_inits(at, t, NULL);
    for (size_t v = 0; v < p->vertices; v++) {
        mpq_set_d(at, p->xy[2 * v]);
        mpq_mul(at, at, n[0]);
        mpq_set_d(t, p->xy[2 * v + 1]);
        mpq_mul(t, t, n[1]);
        mpq_add(at, at, t);
        if (v == 0 || mpq_cmp(at, out) > 0) mpq_set(out, at);
    }
    mpq_clears(at, t, NULL);
}

/* The squared distance by which one must move along the normal of p's edge from a to b; 0 if the line of the edge
 * separates them. */
static void depth_along(mpq_t out, const double *a, const double *b, const polyset *p, const polyset *q)
{
    mpq_t n[2], t;
    mpq_inits(n[0], n[1], t, NULL);
    for (int c = 0; c < 2; c++) {
        mpq_set_d(n[c], c == 0 ? b[1] : a[0]);
        mpq_set_d(t, c == 0 ? a[1] : b[0]);
        mpq_sub(n[c], n[c], t);
    }
    support_of(out, p, (const mpq_t *)n);
    for (int c = 0; c < 2; c++) mpq_neg(n[c], n[c]);
    support_of(t, q, (const mpq_t *)n);
    mpq_add(out, out, t);
    if (mpq_sgn(out) < 0) mpq_set_ui(out, 0, 1);
    mpq_mul(out, out, out);
    mpq_mul(n[0], n[0], n[0]);
    mpq_mul(n[1], n[1], n[1]);
    mpq_add(t, n[0], n[1]);
    mpq_div(out, out, t);
    mpq_clears(n[0], n[1], t, NULL);
}

/* The least translation of two convex sets is along the normal of an edge of one of them. */
static void convex_depth(mpq_t best, const polyset *p, const polyset *q)
{
    mpq_t depth;
    mpq_init(depth);
    bool any = false;
    for (int side = 0; side < 2; side++) {
        const polyset *own = side ? q : p, *other = side ? p : q;
        for (size_t v = 0; v < own->vertices; v++, any = true) {
            depth_along(depth, own->xy + 2 * v, own->xy + 2 * ((v + 1) % own->vertices), own, other);
            if (!any || mpq_cmp(depth, best) < 0) mpq_set(best, depth);
        }
    }
    mpq_clear(depth);
}

/* A parallelogram and a copy of it, or another convex polygon, shifted by a vector that is rounded to doubles. Their
 * edges are parallel up to the last place, so lines of contact may cross anywhere. */
static void check_nearly_parallel(void **state)
{
    (void)state;
    size_t meet = 0;
    const size_t trials = test_count(400);
    for (size_t k = 0; k < trials; k++) {
        rng r = rng_start(test_seed(), k);
        polyset p, q;
        polyset_init(&p);
        polyset_init(&q);
        const double ax = (double)rng_int(&r, 1, 12), ay = (double)rng_int(&r, 0, 12) / 3;
        const double bx = -(double)rng_int(&r, 0, 12) / 3, by = (double)rng_int(&r, 1, 12);
        const double corner[8] = {0, 0, ax, ay, ax + bx, ay + by, bx, by};
        for (int c = 0; c < 4; c++) polyset_vertex(&p, corner[2 * c], corner[2 * c + 1]);
        polyset_end_ring(&p);
        polyset_end_polygon(&p);
        if (rng_once_in(&r, 4))
            random_convex(&q, &r, (int)rng_int(&r, 3, 6), 6);
        else
            polyset_copy(&q, &p);
        const double far = (double)rng_int(&r, 0, 100) / 7;
        polyset_move(&p, far, far);
        const double x = (double)rng_int(&r, -30, 30) / 7, y = (double)rng_int(&r, -30, 30) / 7;
        polyset_move(&q, far + x, far + y);
        standing s;
        mpq_t expected;
        mpq_init(expected);
        standing_of(&s, &p, &q);
        convex_depth(expected, &p, &q);
        assert_int_equal(s.meet, mpq_sgn(expected) > 0);
        if (s.meet && !mpq_equal(s.square, expected))
            fail_msg("trial %zu: %.17g, but %.17g\n%s\n%s", k, mpq_get_d(s.square), mpq_get_d(expected),
                     polyset_wkt(&p), polyset_wkt(&q));
        meet += s.meet;
        mpq_clear(expected);
        standing_clear(&s);
        polyset_free(&p);
        polyset_free(&q);
    }
    assert_true(meet > trials / 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_worse), cmocka_unit_test(check_worse_since),
                                       cmocka_unit_test(check_nearly_parallel)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
