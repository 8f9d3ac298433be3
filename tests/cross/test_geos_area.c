/* Compares areas of larger sums with GEOS: the union, by OverlayNG in doubles, of the sums of all pairs of triangles.
 * The oracle triangulates, since GEOS's own triangulation fails on rings that touch. The relative difference may be
 * 1e-9: GEOS rounds its crossings by 1e-16 of their size, and the errors add up over some thousand edges; a missing or
 * additional face makes a far larger difference. */
#include "generate.h"
#include "oracle.h"
#include "sum_text.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <geos_c.h>
#include <gmp.h>

static GEOSContextHandle_t geos;

static void complain(const char *message, void *user)
{
    (void)user;
    print_message("GEOS: %s\n", message);
}

static int open_geos(void **state)
{
    (void)state;
    geos = GEOS_init_r();
    GEOSContext_setErrorMessageHandler_r(geos, complain, NULL);
    return geos ? 0 : -1;
}

static int close_geos(void **state)
{
    (void)state;
    GEOS_finish_r(geos);
    return 0;
}

static GEOSGeometry *polygon(const double *xy, size_t n)
{
    GEOSCoordSequence *s = GEOSCoordSeq_create_r(geos, (unsigned)n + 1, 2);
    for (size_t i = 0; i <= n; i++) GEOSCoordSeq_setXY_r(geos, s, (unsigned)i, xy[2 * (i % n)], xy[2 * (i % n) + 1]);
    return GEOSGeom_createPolygon_r(geos, GEOSGeom_createLinearRing_r(geos, s), NULL, 0);
}

static double cross(const double *u, const double *v) { return u[0] * v[1] - u[1] * v[0]; }

/* The sum of two triangles: their sides in order of angle, from the lowest corners on. */
static GEOSGeometry *triangle_sum(const double *a, const double *b)
{
    double out[14];
    size_t i = 0, j = 0, low[2] = {0, 0}, n = 0;
    for (size_t k = 1; k < 3; k++) {
        if (a[2 * k + 1] < a[2 * low[0] + 1] || (a[2 * k + 1] == a[2 * low[0] + 1] && a[2 * k] < a[2 * low[0]]))
            low[0] = k;
        if (b[2 * k + 1] < b[2 * low[1] + 1] || (b[2 * k + 1] == b[2 * low[1] + 1] && b[2 * k] < b[2 * low[1]]))
            low[1] = k;
    }
    while (i < 3 || j < 3) {
        const double *p = a + 2 * ((low[0] + i) % 3), *q = b + 2 * ((low[1] + j) % 3);
        const double *p2 = a + 2 * ((low[0] + i + 1) % 3), *q2 = b + 2 * ((low[1] + j + 1) % 3);
        const double u[2] = {p2[0] - p[0], p2[1] - p[1]}, v[2] = {q2[0] - q[0], q2[1] - q[1]};
        out[2 * n] = p[0] + q[0];
        out[2 * n + 1] = p[1] + q[1];
        n++;
        const double c = cross(u, v);
        if (j == 3 || (i < 3 && c > 0))
            i++;
        else if (i == 3 || c < 0)
            j++;
        else
            i++, j++;
    }
    return polygon(out, n);
}

static double geos_area(const polyset *p, const polyset *q)
{
    size_t m, n;
    double *s = oracle_triangles(p, &m), *t = oracle_triangles(q, &n), area = NAN;
    GEOSGeometry **all = test_alloc(m * n, sizeof(GEOSGeometry *));
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < n; j++) all[i * n + j] = triangle_sum(s + 6 * i, t + 6 * j);
    GEOSGeometry *many = GEOSGeom_createCollection_r(geos, GEOS_MULTIPOLYGON, all, (unsigned)(m * n));
    GEOSGeometry *one = GEOSUnaryUnion_r(geos, many);
    if (one) GEOSArea_r(geos, one, &area);
    GEOSGeom_destroy_r(geos, many);
    GEOSGeom_destroy_r(geos, one);
    free(all);
    free(s);
    free(t);
    return area;
}

static double our_area(const polyset *p, const polyset *q)
{
    sunder_shape *a = polyset_shape(p), *b = polyset_shape(q);
    sunder_sum *sum = NULL;
    double area = NAN;
    char *text = NULL;
    if (a && b && sunder_minkowski_sum(a, b, NULL, &sum, NULL) == SUNDER_OK &&
        sunder_sum_area_text(sum, &text, NULL) == SUNDER_OK) {
        /* num/den as a double; strtod would overflow on the parts of a long fraction. */
        mpq_t r;
        mpq_init(r);
        if (mpq_set_str(r, text, 10) == 0) area = mpq_get_d(r);
        mpq_clear(r);
    }
    sunder_free(text);
    sunder_sum_free(sum);
    sunder_shape_free(a);
    sunder_shape_free(b);
    return area;
}

static bool same_area(const char *name, const polyset *p, const polyset *q)
{
    const double theirs = geos_area(p, q), ours = our_area(p, q);
    if (fabs(ours - theirs) <= 1e-9 * fabs(theirs)) return true;
    char *a = polyset_wkt(p), *b = polyset_wkt(q);
    print_message("%s: area %.17g, GEOS %.17g\n%.2000s\n%.2000s\n", name, ours, theirs, a, b);
    free(a);
    free(b);
    return false;
}

static void test_families(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(6);
    size_t bad = 0;
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
    for (int f = 0; f < FAMILY_KINDS; f++)
        for (size_t i = 0; i < n; i++) {
            rng r = rng_start(seed + 77 * (uint64_t)f, i);
            polyset p, q;
            random_family(&p, &q, &r, (family_kind)f, 30, 70);
            char *name = test_format("%s, case %zu", family_kind_string((family_kind)f), i);
            if (!same_area(name, &p, &q)) bad++;
            free(name);
            polyset_free(&p);
            polyset_free(&q);
        }
    assert_int_equal(bad, 0);
}

/* The benchmark inputs beside the repository, if they exist. */
static void test_shared_families(void **state)
{
    (void)state;
    static const char *const names[] = {"comb_50",     "fork_20",   "forkt_20",   "cfork_20", "star_20",  "star_50",
                                        "random_20",   "random_50", "randmap_50", "robot_20", "robot_50", "fatgrid_20",
                                        "fatcover_20", "tight_0",   "tight_1",    "tight_2"};
    const char *source = getenv("SUNDER_SOURCE");
    size_t found = 0, bad = 0;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char *path = test_format("%s/../shared/families/%s.txt", source ? source : SUNDER_SOURCE, names[i]);
        char *text = test_read_file(path);
        const char *end;
        polyset p, q;
        if (text && polyset_read_wkt(&p, text, &end)) {
            found++;
            if (!polyset_read_wkt(&q, end, NULL) || !same_area(names[i], &p, &q)) bad++;
            polyset_free(&p);
            polyset_free(&q);
        }
        free(text);
        free(path);
    }
    if (!found) {
        print_message("no ../shared/families beside the repository: skipped\n");
        skip();
    }
    print_message("%zu of %zu files agree\n", found - bad, found);
    assert_int_equal(bad, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_families), cmocka_unit_test(test_shared_families)};
    return cmocka_run_group_tests_name("areas like GEOS's", tests, open_geos, close_geos);
}
