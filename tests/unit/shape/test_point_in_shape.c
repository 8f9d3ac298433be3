/* shape/point_in_shape: points about the rings of random shapes, valid and invalid, are located as by the even-odd rule
 * in rationals, for a ray in another direction. */
#include "generate.h"

#include <gmp.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

/* The sign of (b - a) x (c - a), in rationals. */
static int orient(const double a[2], const double b[2], const double c[2])
{
    mpq_t t[4], u, v;
    mpq_inits(t[0], t[1], t[2], t[3], u, v, NULL);
    for (int k = 0; k < 2; k++) {
        mpq_set_d(u, a[k]);
        mpq_set_d(t[k], b[k]);
        mpq_sub(t[k], t[k], u);
        mpq_set_d(t[2 + k], c[k]);
        mpq_sub(t[2 + k], t[2 + k], u);
    }
    mpq_mul(u, t[0], t[3]);
    mpq_mul(v, t[1], t[2]);
    const int sign = mpq_cmp(u, v);
    mpq_clears(t[0], t[1], t[2], t[3], u, v, NULL);
    return (sign > 0) - (sign < 0);
}

static bool lies_between(const double a[2], const double b[2], const double c[2])
{
    bool in = true;
    for (int k = 0; k < 2; k++) in = in && fmin(a[k], b[k]) <= c[k] && c[k] <= fmax(a[k], b[k]);
    return in && orient(a, b, c) == 0;
}

/* The position relative to one polygon, by the ray upwards. */
static int locate_in(const polyset *set, size_t polygon, const double at[2])
{
    bool inside = false;
    for (size_t r = polygon ? set->poly_end[polygon - 1] : 0; r < set->poly_end[polygon]; r++) {
        const size_t first = r ? set->ring_end[r - 1] : 0, n = set->ring_end[r] - first;
        for (size_t i = 0; i < n; i++) {
            const double *a = set->xy + 2 * (first + i), *b = set->xy + 2 * (first + (i + 1) % n);
            if (lies_between(a, b, at)) return 0;
            const bool right = a[0] < b[0];
            if ((a[0] > at[0]) != (b[0] > at[0])) inside ^= orient(right ? a : b, right ? b : a, at) < 0;
        }
    }
    return inside ? 1 : -1;
}

static int locate(const polyset *set, const double at[2])
{
    int best = -1;
    for (size_t p = 0; p < set->polygons; p++) {
        const int side = locate_in(set, p, at);
        if (side > best) best = side;
    }
    return best;
}

/* A vertex, a point of an edge in doubles, or any point near a ring, and perhaps a neighbour of it in doubles. */
static void random_place(const polyset *set, rng *r, double at[2])
{
    const size_t ring = (size_t)rng_int(r, 0, (int64_t)set->rings - 1), first = ring ? set->ring_end[ring - 1] : 0,
                 n = set->ring_end[ring] - first, i = (size_t)rng_int(r, 0, (int64_t)n - 1);
    const double *a = set->xy + 2 * (first + i), *b = set->xy + 2 * (first + (i + 1) % n);
    const int kind = (int)rng_int(r, 0, 3);
    const double along = rng_unit(r), across = kind == 3 ? rng_unit(r) : along;
    at[0] = kind == 0 ? a[0] : a[0] + along * (b[0] - a[0]);
    at[1] = kind == 0 ? a[1] : a[1] + across * (b[1] - a[1]);
    if (kind == 2) at[rng_int(r, 0, 1)] = set->xy[2 * (first + (size_t)rng_int(r, 0, (int64_t)n - 1))];
    if (rng_once_in(r, 3)) {
        const int k = (int)rng_int(r, 0, 1);
        at[k] = nextafter(at[k], rng_once_in(r, 2) ? INFINITY : -INFINITY);
    }
}

static void random_set(polyset *set, rng *r)
{
    polyset_init(set);
    switch (rng_int(r, 0, 4)) {
    case 0: random_simple(set, r, 8, 6); break;
    case 1: random_star(set, r, 12, 40); break;
    case 2: random_comb(set, r, 4, 30, true); break;
    case 3: random_building(set, r); break;
    default: random_invalid(set, r, (invalid_kind)rng_int(r, 0, INVALID_KINDS - 1), 16);
    }
    if (rng_once_in(r, 3)) random_building(set, r);
}

static void test_locate_random(void **state)
{
    (void)state;
    rng r = rng_start(test_seed(), 401);
    size_t count[3] = {0};
    for (size_t i = 0; i < test_count(2000); i++) {
        polyset set;
        sunder_shape *shape;
        random_set(&set, &r);
        if (sunder_shape_from_rings(set.xy, set.ring_end, set.poly_end, set.polygons, SUNDER_VALIDITY_EVEN_ODD, &shape,
                                    NULL) == SUNDER_OK) {
            for (int k = 0; k < 20; k++) {
                double at[2];
                random_place(&set, &r, at);
                const int side = sunder_shape_locate(shape, &(sunder_point){at[0], at[1]});
                if (side != locate(&set, at))
                    fail_msg("SUNDER_SEED=%llu: (%.17g %.17g) is at %d of %s", (unsigned long long)test_seed(), at[0],
                             at[1], side, polyset_wkt(&set));
                count[side + 1]++;
            }
            sunder_shape_free(shape);
        }
        polyset_free(&set);
    }
    for (int k = 0; k < 3; k++) assert_true(count[k] > test_count(2000)); /* each answer was asked for often */
}

static void test_locate_empty(void **state)
{
    (void)state;
    sunder_shape *shape;
    assert_int_equal(sunder_shape_from_rings(NULL, NULL, NULL, 0, SUNDER_VALIDITY_STRICT, &shape, NULL), SUNDER_OK);
    assert_int_equal(sunder_shape_locate(shape, &(sunder_point){0, 0}), -1);
    sunder_shape_free(shape);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_locate_random), cmocka_unit_test(test_locate_empty)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
