/* Sums of operands with rational vertices: quadrangles that cross themselves, by the even-odd rule. The test computes
 * the crossing. Multiplied by its denominator both operands are integers, and the oracle's sum of those is the
 * library's multiplied by that number. */
#include "generate.h"
#include "oracle.h"
#include "sum_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct spot {
    int64_t x, y;
} spot;

static int64_t cross(spot a, spot b, spot c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

static int64_t gcd(int64_t a, int64_t b)
{
    while (b) {
        const int64_t t = a % b;
        a = b;
        b = t;
    }
    return a < 0 ? -a : a;
}

/* A ring a b c d whose sides ab and cd cross inside both: the crossing is (x.x / den, x.y / den). */
static int64_t bow_tie(rng *r, spot v[4], spot *x, int span)
{
    for (;;) {
        for (int i = 0; i < 4; i++) v[i] = (spot){rng_int(r, 0, span), rng_int(r, 0, span)};
        const int64_t s = cross(v[0], v[1], v[2]), t = cross(v[0], v[1], v[3]);
        const int64_t u = cross(v[2], v[3], v[0]), w = cross(v[2], v[3], v[1]);
        if (!((s > 0) != (t > 0) && s && t && (u > 0) != (w > 0) && u && w)) continue;
        /* The point of ab with the parameter u / (u - w). */
        int64_t den = u - w, nx = v[0].x * den + (v[1].x - v[0].x) * u, ny = v[0].y * den + (v[1].y - v[0].y) * u;
        const int64_t g = gcd(gcd(nx, ny), den) * (den < 0 ? -1 : 1);
        *x = (spot){nx / g, ny / g};
        return den / g;
    }
}

/* The two triangles, multiplied by k; the crossing is x / den, and k is a multiple of den. */
static void lobes(polyset *set, const spot v[4], spot x, int64_t den, int64_t k)
{
    static const int corner[2][2] = {{1, 2}, {3, 0}}; /* b c and d a */
    for (int i = 0; i < 2; i++) {
        const spot p = v[corner[i][0]], q = v[corner[i][1]];
        const double xy[] = {(double)(x.x * (k / den)), (double)(x.y * (k / den)), (double)(p.x * k),
                             (double)(p.y * k),         (double)(q.x * k),         (double)(q.y * k)};
        polyset_polygon(set, xy, 3);
    }
}

static void raw_ring(polyset *set, const spot v[4])
{
    const double xy[] = {(double)v[0].x, (double)v[0].y, (double)v[1].x, (double)v[1].y,
                         (double)v[2].x, (double)v[2].y, (double)v[3].x, (double)v[3].y};
    polyset_polygon(set, xy, 4);
}

static char *even_odd_sum(const polyset *p, const polyset *q)
{
    sunder_shape *a = NULL, *b = NULL;
    sunder_sum *sum = NULL;
    sunder_error err = {0};
    char *text = NULL;
    sunder_status s =
        sunder_shape_from_rings(p->xy, p->ring_end, p->poly_end, p->polygons, SUNDER_VALIDITY_EVEN_ODD, &a, &err);
    if (!s)
        s = sunder_shape_from_rings(q->xy, q->ring_end, q->poly_end, q->polygons, SUNDER_VALIDITY_EVEN_ODD, &b, &err);
    if (!s) s = sunder_minkowski_sum(a, b, NULL, &sum, &err);
    if (!s)
        text = sum_text(sum);
    else
        print_message("%s\n", err.message);
    if (a && !sunder_shape_repaired(a)) print_message("not repaired\n");
    sunder_sum_free(sum);
    sunder_shape_free(a);
    sunder_shape_free(b);
    return text;
}

static bool agree(uint64_t seed, size_t i)
{
    rng r = rng_start(seed + 991, i);
    spot v[4], w[4], x, y;
    polyset p, q, kp, kq;
    const int span = i % 2 ? 6 : 40;
    const int64_t den = bow_tie(&r, v, &x, span);
    int64_t k = den;
    polyset_init(&p);
    polyset_init(&q);
    polyset_init(&kp);
    polyset_init(&kq);
    raw_ring(&p, v);
    if (i % 3 == 0) { /* both operands cross themselves */
        const int64_t other = bow_tie(&r, w, &y, 6);
        k = den / gcd(den, other) * other;
        raw_ring(&q, w);
        lobes(&kq, w, y, other, k);
    } else {
        random_simple(&q, &r, (int)rng_int(&r, 3, 5), 5);
        polyset_append(&kq, &q);
        polyset_scale(&kq, (double)k, (double)k);
    }
    lobes(&kp, v, x, den, k);
    char *expected = oracle_sum_text(&kp, &kq, false), *got = even_odd_sum(&p, &q);
    char *ours = got ? sum_text_times(got, (long)k) : NULL;
    const bool same = ours && strcmp(ours, expected) == 0;
    if (!same) {
        char *a = polyset_wkt(&p), *b = polyset_wkt(&q);
        print_message("SUNDER_SEED=%llu, case %zu, times %ld\n%s\n%s\n  library %s\n  oracle  %s\n",
                      (unsigned long long)seed, i, (long)k, a, b, ours ? ours : "failed", expected);
        free(a);
        free(b);
    }
    free(expected);
    free(got);
    free(ours);
    polyset_free(&p);
    polyset_free(&q);
    polyset_free(&kp);
    polyset_free(&kq);
    return same;
}

static void test_bow_ties(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(300);
    size_t bad = 0;
    for (size_t i = 0; i < n && bad < 5; i++)
        if (!agree(seed, i)) bad++;
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
    assert_int_equal(bad, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_bow_ties)};
    return cmocka_run_group_tests_name("sums of repaired operands", tests, NULL, NULL);
}
