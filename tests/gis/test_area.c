/* The area of rings in doubles, compared with the exact one in rationals: near the origin and far from it, fat and
 * thin, with holes, open and closed, and with squares beyond the range of doubles. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "geometry/polygons.h"
#include "random.h"

#include <gmp.h>
#include <math.h>

/* Sets `twice` to twice the signed area of n corners, and `size` to the sum of the absolute values of the products. */
static void exact_ring(mpq_t twice, mpq_t size, const double *xy, size_t n)
{
    mpq_t a, b;
    mpq_inits(a, b, NULL);
    mpq_set_ui(twice, 0, 1);
    mpq_set_ui(size, 0, 1);
    for (size_t i = 0; i < n; i++) {
        const double *p = xy + 2 * i, *q = xy + 2 * ((i + 1) % n);
        for (int k = 0; k < 2; k++) { /* both are relative to the first corner, as the products are */
            mpq_t c;
            mpq_init(c);
            mpq_set_d(a, p[k]);
            mpq_set_d(c, xy[k]);
            mpq_sub(a, a, c);
            mpq_set_d(b, q[!k]);
            mpq_set_d(c, xy[!k]);
            mpq_sub(b, b, c);
            mpq_clear(c);
            mpq_mul(a, a, b);
            if (k)
                mpq_sub(twice, twice, a);
            else
                mpq_add(twice, twice, a);
            mpq_abs(a, a);
            mpq_add(size, size, a);
        }
    }
    mpq_clears(a, b, NULL);
}

static void add_ring(gis_polygons *set, rng *r, double x, double y, double width, double height, size_t n)
{
    gis_error error;
    double first[2] = {0, 0};
    for (size_t i = 0; i < n; i++) {
        const double at[] = {x + width * rng_unit(r), y + height * rng_unit(r)};
        assert_true(gis_polygons_vertex(set, at[0], at[1], &error));
        if (i == 0) first[0] = at[0], first[1] = at[1];
    }
    if (rng_once_in(r, 2)) assert_true(gis_polygons_vertex(set, first[0], first[1], &error));
    assert_true(gis_polygons_end_ring(set, &error));
}

static void check_random(void **state)
{
    (void)state;
    for (size_t trial = 0; trial < test_count(2000); trial++) {
        rng r = rng_start(test_seed(), trial);
        gis_polygons set = {0};
        gis_error error;
        const double far = ldexp(rng_unit(&r), (int)rng_int(&r, -10, 30));
        const double width = ldexp(1, (int)rng_int(&r, -12, 12)), height = ldexp(1, (int)rng_int(&r, -12, 12));
        for (int64_t polygons = rng_int(&r, 1, 3); polygons > 0; polygons--) {
            for (int64_t rings = rng_int(&r, 1, 3); rings > 0; rings--)
                add_ring(&set, &r, far, -far / 3, width, height, (size_t)rng_int(&r, 3, 30));
            assert_true(gis_polygons_end_polygon(&set, &error));
        }
        mpq_t area, size, one, its, rings;
        mpq_inits(area, size, one, its, rings, NULL);
        for (size_t p = 0, k = 0; p < set.polygons; p++)
            for (size_t first = k; k < set.poly_end[p]; k++) {
                const size_t from = k ? set.ring_end[k - 1] : 0;
                exact_ring(one, its, set.xy + 2 * from, set.ring_end[k] - from);
                mpq_abs(one, one);
                mpq_add(rings, rings, one);
                if (k == first)
                    mpq_add(area, area, one);
                else
                    mpq_sub(area, area, one);
                mpq_add(size, size, its);
            }
        mpq_div_2exp(area, area, 1);
        const double is = gis_polygons_area(&set);
        mpq_set_d(one, is);
        mpq_sub(one, one, area);
        const double off = fabs(mpq_get_d(one));
        if (!(off <= 0x1p-52 * mpq_get_d(rings) + 0x1p-98 * mpq_get_d(size)))
            fail_msg("trial %zu: %.17g is off by %g", trial, is, off);
        mpq_clears(area, size, one, its, rings, NULL);
        gis_polygons_clear(&set);
    }
}

static void square(gis_polygons *set, double at, double side, bool clockwise)
{
    gis_error error;
    const double a = at, b = at + side, xy[] = {a, a, b, a, b, b, a, b};
    for (size_t k = 0; k < 4; k++) {
        const double *corner = xy + 2 * (clockwise ? 3 - k : k);
        assert_true(gis_polygons_vertex(set, corner[0], corner[1], &error));
    }
    assert_true(gis_polygons_end_ring(set, &error) && gis_polygons_end_polygon(set, &error));
}

/* Squares whose area, or only an intermediate value of it, leaves the range of doubles; in both orientations. */
static void check_range(void **state)
{
    (void)state;
    static const struct {
        double at, side, area;
    } squares[] = {
        {-0x1p1023, 0x1.8p1023, INFINITY},
        {-0x1.8p1023, 0x1p1023, INFINITY},
        {0x1p300, 0x1p260, 0x1p520},
        {0x1p520, 0x1p490, 0x1p980},
        {0, 0x1p-500, 0x1p-1000},
        {0, 0x1p-700, 0},
        {0x1p52, 1, 1},
        {0, 0, 0},
    };
    for (size_t i = 0; i < sizeof squares / sizeof *squares; i++) {
        gis_polygons set = {0};
        square(&set, squares[i].at, squares[i].side, true);
        assert_true(gis_polygons_area(&set) == squares[i].area);
        const double *xy = set.xy;
        gis_polygons_wind(&set);
        gis_polygons wound = {0};
        square(&wound, squares[i].at, squares[i].side, false);
        if (squares[i].side > 0) gis_polygons_wind(&wound); /* the ring already has this orientation */
        if (squares[i].side > 0) assert_true(wound.xy[3] == wound.xy[1]);
        for (size_t k = 0; k < 4; k++) { /* the same ring from another starting vertex */
            const double *p = xy + 2 * k, *q = xy + 2 * ((k + 1) % 4);
            bool found = squares[i].side == 0;
            for (size_t m = 0; m < 4; m++) {
                const double *a = wound.xy + 2 * m, *b = wound.xy + 2 * ((m + 1) % 4);
                found = found || (p[0] == a[0] && p[1] == a[1] && q[0] == b[0] && q[1] == b[1]);
            }
            assert_true(found);
        }
        gis_polygons_clear(&wound);
        gis_polygons_clear(&set);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_random), cmocka_unit_test(check_range)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
