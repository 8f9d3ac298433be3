/* Round outlines of many corners, whose subsums have so many sides that they are searched by bisection, compared with
 * the same sets cut into triangles, whose subsums have few: the least translations, with a gap and without, have equal
 * lengths to the last digit, and both keep the gap. */
#include "polyset.h"
#include "random.h"
#include "sunder.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 60 };

/* A ring around the origin, some of its corners pushed in or out, and the triangles from the origin to its sides. */
static void round_outline(polyset *whole, polyset *cut, rng *r)
{
    double xy[2 * MOST];
    const size_t n = (size_t)rng_int(r, 14, MOST);
    const double size = rng_once_in(r, 3) ? 1 : 16, flat = 0.25 + rng_unit(r), from = 6 * rng_unit(r);
    for (size_t i = 0; i < n; i++) {
        const double a = 6.283185307179586 * (double)i / (double)n + from;
        xy[2 * i] = rint(1024 * size * cos(a)) / 64;
        xy[2 * i + 1] = rint(1024 * flat * size * sin(a)) / 64;
    }
    for (int64_t pushed = rng_int(r, 0, 2); pushed > 0; pushed--) {
        const int64_t i = rng_int(r, 0, (int64_t)n - 1);
        const double by = rng_once_in(r, 2) ? 0.875 : 1.125;
        xy[2 * i] *= by;
        xy[2 * i + 1] *= by;
    }
    polyset_init(whole);
    polyset_init(cut);
    polyset_polygon(whole, xy, n);
    for (size_t i = 0; i < n; i++) {
        const double *a = xy + 2 * i, *b = xy + 2 * ((i + 1) % n);
        polyset_polygon(cut, (double[]){0, 0, a[0], a[1], b[0], b[1]}, 3);
    }
}

static void compare(const sunder_shape *const whole[2], const sunder_shape *const cut[2], double gap, uint64_t trial)
{
    sunder_separation s, t;
    assert_int_equal(sunder_pair_separate(whole[0], whole[1], gap, &s, NULL), SUNDER_OK);
    assert_int_equal(sunder_pair_separate(cut[0], cut[1], gap, &t, NULL), SUNDER_OK);
    if (s.lower_bound != t.lower_bound || s.distance != t.distance || s.overlap != t.overlap)
        fail_msg("SUNDER_SEED=%llu, pair %llu, gap %g: %.17g (bound %.17g), cut into triangles %.17g (%.17g)",
                 (unsigned long long)test_seed(), (unsigned long long)trial, gap, s.distance, s.lower_bound, t.distance,
                 t.lower_bound);
    sunder_separation_clear(&s);
    sunder_separation_clear(&t);
}

static void check_sides(void **state)
{
    (void)state;
    static const double GAPS[] = {0, 1, 0.5, 16, 100, 0.015625};
    const uint64_t trials = test_count(60);
    uint64_t done = 0;
    for (uint64_t k = 0; k < trials; k++) {
        rng r = rng_start(test_seed(), k);
        polyset set[2][2];
        sunder_shape *shape[2][2];
        for (int e = 0; e < 2; e++) {
            round_outline(&set[0][e], &set[1][e], &r);
            const double x = (double)rng_int(&r, -64, 64) / 4, y = (double)rng_int(&r, -64, 64) / 4;
            for (int w = 0; w < 2; w++) {
                polyset_move(&set[w][e], x, y);
                shape[w][e] = polyset_shape(&set[w][e]);
            }
        }
        const double gap = GAPS[rng_int(&r, 0, 5)];
        if (shape[0][0] && shape[0][1] && shape[1][0] && shape[1][1]) {
            compare((const sunder_shape *const *)shape[0], (const sunder_shape *const *)shape[1], gap, k);
            done++;
        }
        for (int w = 0; w < 2; w++)
            for (int e = 0; e < 2; e++) {
                sunder_shape_free(shape[w][e]);
                polyset_free(&set[w][e]);
            }
    }
    print_message("%llu of %llu pairs\n", (unsigned long long)done, (unsigned long long)trials);
    assert_true(done * 2 > trials);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_sides)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
