/* Least translations (and distances) of larger operands, for which the search discards whole squares of the plane:
 * equal, as rationals, to the least distance of the origin from the boundary and the degenerate holes of P + (-Q),
 * which the sum computes by other means. */
#include "generate.h"
#include "sunder.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <gmp.h>

typedef struct place {
    mpq_t x, y;
} place;

static void place_get(place *p, const sunder_sum *sum, uint32_t vertex)
{
    char *x = NULL, *y = NULL;
    assert_int_equal(sunder_sum_vertex_text(sum, vertex, &x, &y, NULL), SUNDER_OK);
    mpq_inits(p->x, p->y, NULL);
    assert_int_equal(mpq_set_str(p->x, x, 10) | mpq_set_str(p->y, y, 10), 0);
    sunder_free(x);
    sunder_free(y);
}

static void place_clear(place *p) { mpq_clears(p->x, p->y, NULL); }

static void dot(mpq_t result, const mpq_t ax, const mpq_t ay, const mpq_t bx, const mpq_t by)
{
    mpq_t t;
    mpq_init(t);
    mpq_mul(t, ax, bx);
    mpq_mul(result, ay, by);
    mpq_add(result, result, t);
    mpq_clear(t);
}

/* Replaces *least by the squared distance of the origin from the segment ab if that is less (or if *least is
 * negative). */
static void nearer(mpq_t least, const place *a, const place *b)
{
    mpq_t dx, dy, t, length, x, y;
    mpq_inits(dx, dy, t, length, x, y, NULL);
    mpq_sub(dx, b->x, a->x);
    mpq_sub(dy, b->y, a->y);
    dot(length, dx, dy, dx, dy);
    dot(t, a->x, a->y, dx, dy);
    mpq_neg(t, t);
    if (mpq_sgn(t) <= 0 || mpq_sgn(length) == 0)
        mpq_set_ui(t, 0, 1);
    else if (mpq_cmp(t, length) >= 0)
        mpq_set_ui(t, 1, 1);
    else
        mpq_div(t, t, length);
    mpq_mul(x, t, dx);
    mpq_add(x, x, a->x);
    mpq_mul(y, t, dy);
    mpq_add(y, y, a->y);
    dot(t, x, y, x, y);
    if (mpq_sgn(least) < 0 || mpq_cmp(t, least) < 0) mpq_set(least, t);
    mpq_clears(dx, dy, t, length, x, y, NULL);
}

static void nearer_segment(mpq_t least, const sunder_sum *sum, uint32_t u, uint32_t v)
{
    place a, b;
    place_get(&a, sum, u);
    place_get(&b, sum, v);
    nearer(least, &a, &b);
    place_clear(&a);
    place_clear(&b);
}

static void from_sum(mpq_t least, const sunder_sum *sum)
{
    sunder_sum_size c;
    sunder_sum_get_size(sum, &c);
    mpq_set_si(least, -1, 1);
    for (size_t p = 0; p < c.polygons; p++)
        for (size_t r = 0; r < sunder_sum_rings(sum, p); r++) {
            size_t n;
            const uint32_t *ring = sunder_sum_ring(sum, p, r, &n);
            for (size_t i = 0; i < n; i++) nearer_segment(least, sum, ring[i], ring[i + 1 < n ? i + 1 : 0]);
        }
    for (size_t i = 0; i < c.degenerate_segments; i++) {
        uint32_t ends[2];
        sunder_sum_segment(sum, i, ends);
        nearer_segment(least, sum, ends[0], ends[1]);
    }
    for (size_t i = 0; i < c.degenerate_points; i++)
        nearer_segment(least, sum, sunder_sum_point(sum, i), sunder_sum_point(sum, i));
}

/* Moves Q so that its box is centred on that of P, or nearly so. */
static void centre(polyset *q, const polyset *p, rng *r)
{
    double low[2][2], high[2][2];
    const polyset *set[2] = {p, q};
    for (int s = 0; s < 2; s++)
        for (int k = 0; k < 2; k++) {
            low[s][k] = high[s][k] = set[s]->xy[k];
            for (size_t i = 0; i < set[s]->vertices; i++) {
                const double v = set[s]->xy[2 * i + (size_t)k];
                if (v < low[s][k]) low[s][k] = v;
                if (v > high[s][k]) high[s][k] = v;
            }
        }
    double by[2];
    for (int k = 0; k < 2; k++) {
        by[k] = (low[0][k] + high[0][k] - low[1][k] - high[1][k]) / 2;
        by[k] = (double)((int64_t)(by[k] + rng_unit(r) * (high[0][k] - low[0][k]) / 8));
    }
    polyset_move(q, by[0], by[1]);
}

static bool agree(family_kind kind, uint64_t seed, size_t i, int low, int high)
{
    rng r = rng_start(seed * 29 + (uint64_t)kind, i);
    polyset p, q;
    sunder_shape *reflected = NULL;
    sunder_sum *sum = NULL;
    sunder_separation s;
    random_family(&p, &q, &r, kind, low, high);
    if (kind != FAMILY_MAP && kind != FAMILY_TOWN) centre(&q, &p, &r); /* these kinds have integer coordinates */
    sunder_shape *a = polyset_shape(&p), *b = polyset_shape(&q);
    assert_true(a && b);
    assert_int_equal(sunder_shape_reflect(b, &reflected, NULL), SUNDER_OK);
    assert_int_equal(sunder_minkowski_sum(a, reflected, NULL, &sum, NULL), SUNDER_OK);
    assert_int_equal(sunder_pair_separate(a, b, 0, &s, NULL), SUNDER_OK);
    mpq_t least, got;
    mpq_inits(least, got, NULL);
    bool apart = false;
    assert_int_equal(sunder_pair_apart(a, b, 0, &apart, NULL), SUNDER_OK);
    assert_int_equal(apart, !s.overlap);
    if (!apart) from_sum(least, sum); /* otherwise the distance is zero */
    assert_int_equal(mpq_set_str(got, s.distance_squared_text, 10), 0);
    const bool ok = mpq_equal(least, got) != 0;
    if (!ok) {
        char *tp = polyset_wkt(&p), *tq = polyset_wkt(&q);
        gmp_printf("%s, SUNDER_SEED=%llu, case %zu\n%s\n%s\n  squared distance %Qd, of the sum %Qd\n",
                   family_kind_string(kind), (unsigned long long)seed, i, tp, tq, got, least);
        free(tp);
        free(tq);
    }
    mpq_clears(least, got, NULL);
    sunder_separation_clear(&s);
    sunder_sum_free(sum);
    sunder_shape_free(a);
    sunder_shape_free(b);
    sunder_shape_free(reflected);
    polyset_free(&p);
    polyset_free(&q);
    return ok;
}

static void test_family(void **state)
{
    const family_kind kind = *(const family_kind *)*state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(12);
    size_t bad = 0;
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
    for (size_t i = 0; i < n && bad < 2; i++)
        if (!agree(kind, seed, i, 100, 300)) bad++;
    assert_int_equal(bad, 0);
}

static long double point_to_edge(const double *p, const double *a, const double *b)
{
    const long double ux = (long double)b[0] - a[0], uy = (long double)b[1] - a[1];
    const long double vx = (long double)p[0] - a[0], vy = (long double)p[1] - a[1];
    long double t = (vx * ux + vy * uy) / (ux * ux + uy * uy);
    t = t > 0 ? t < 1 ? t : 1 : 0;
    return hypotl(vx - t * ux, vy - t * uy);
}

/* The vertices of one set against the edges of the other. */
static long double vertices_to_edges(const polyset *v, const polyset *e)
{
    long double least = INFINITY;
    for (size_t r = 0, first = 0; r < e->rings; first = e->ring_end[r++])
        for (size_t i = first; i < e->ring_end[r]; i++) {
            const size_t next = i + 1 < e->ring_end[r] ? i + 1 : first;
            for (size_t k = 0; k < v->vertices; k++)
                least = fminl(least, point_to_edge(v->xy + 2 * k, e->xy + 2 * i, e->xy + 2 * next));
        }
    return least;
}

/* Distances of separate stars, compared with the distances of every vertex and edge. The library promises about an ulp,
 * the comparison in long double is more exact; 1e-12 allows for both. */
static void test_distance(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
    for (size_t i = 0; i < test_count(40); i++) {
        rng r = rng_start(seed * 31, i);
        polyset p, q;
        polyset_init(&p);
        polyset_init(&q);
        random_star(&p, &r, (int)rng_int(&r, 50, 400), 1000);
        random_star(&q, &r, (int)rng_int(&r, 50, 400), 1000);
        const bool across = rng_once_in(&r, 2);
        const double beside = (double)rng_int(&r, -900, 900);
        polyset_move(&q, across ? 2010 : beside, across ? beside : 2010);
        sunder_shape *a = polyset_shape(&p), *b = polyset_shape(&q);
        double d, on_p[2], on_q[2];
        assert_int_equal(sunder_pair_distance(a, b, &d, on_p, on_q, NULL), SUNDER_OK);
        const long double want = fminl(vertices_to_edges(&p, &q), vertices_to_edges(&q, &p));
        assert_true(fabsl(d - want) <= 1e-12L * want);
        /* The ends are rounded to 1e-13. */
        assert_true(fabs(hypot(on_p[0] - on_q[0], on_p[1] - on_q[1]) - d) <= 1e-9 * d);
        sunder_shape_free(a);
        sunder_shape_free(b);
        polyset_free(&p);
        polyset_free(&q);
    }
}

int main(void)
{
    family_kind kinds[FAMILY_KINDS];
    struct CMUnitTest tests[FAMILY_KINDS + 1];
    for (int k = 0; k < FAMILY_KINDS; k++) {
        kinds[k] = (family_kind)k;
        tests[k] = (struct CMUnitTest){family_kind_string(kinds[k]), test_family, NULL, NULL, &kinds[k]};
    }
    tests[FAMILY_KINDS] = (struct CMUnitTest){"distances", test_distance, NULL, NULL, NULL};
    return cmocka_run_group_tests_name("least translations of larger operands", tests, NULL, NULL);
}
