/* shape: random valid sets of every kind that the generators make (touching holes, rings that touch themselves, map
 * coordinates, ragged and huge ones) are accepted in every way of writing them, and satisfy all invariants; also on a
 * wide lattice. Placing two shapes on one lattice keeps every coordinate, shifts and reflections included. If memory
 * runs out, an error is reported and nothing leaks. */
#include "failing.h"
#include "generate.h"
#include "gmp_numbers.h"
#include "shape/shape.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define CASES 400

static void explain(const polyset *set, uint64_t i, const char *what)
{
    char *text = polyset_wkt(set);
    fail_msg("SUNDER_SEED=%llu, case %llu: %s: %s", (unsigned long long)test_seed(), (unsigned long long)i, what, text);
}

static sunder_shape *build(const polyset *set, uint64_t i)
{
    sunder_shape *s = NULL;
    sunder_error err;
    if (sunder_shape_from_rings(set->xy, set->ring_end, set->poly_end, set->polygons, SUNDER_VALIDITY_STRICT, &s, &err))
        explain(set, i, err.message);
    const char *fault = sunder_i_shape_check(s);
    if (fault) explain(set, i, fault);
    return s;
}

static void test_valid_sets(void **state)
{
    (void)state;
    const size_t n = test_count(CASES);
    for (uint64_t i = 0; i < n; i++) {
        rng g = rng_start(test_seed(), i);
        polyset p, q;
        random_pair(&p, &q, &g, (pair_kind)(i % PAIR_KINDS));
        sunder_shape *s = build(&p, i);
        random_dress(&p, &g);
        sunder_shape *t = build(&p, i);
        if (sunder_shape_area(s) != sunder_shape_area(t))
            explain(&p, i, "the area depends on the way of writing the set");
        sunder_shape_free(s);
        sunder_shape_free(t);
        sunder_shape_free(build(&q, i));
        polyset_free(&p);
        polyset_free(&q);
    }
}

/* A ring of many corners around a centre, alternating between spikes and bays, with a net of holes in it: large enough
 * for the trees. */
static void gear(polyset *set, rng *g)
{
    const int teeth = (int)rng_int(g, 30, 120);
    for (int k = 0; k < teeth; k++) {
        const double angle = 6.283185307179586 * k / teeth, far = (k & 1 ? 90 : 50) + 20 * rng_unit(g);
        polyset_vertex(set, far * cos(angle), far * sin(angle));
    }
    polyset_end_ring(set);
    const int n = (int)rng_int(g, 0, 6);
    for (int k = 0; k < n * n; k++) {
        const double x = -30 + 60.0 / n * (k % n), y = -30 + 60.0 / n * (k / n), size = 50.0 / n;
        const double hole[] = {x,
                               y,
                               x + size,
                               y + size * rng_unit(g) / 2,
                               x + size * rng_unit(g),
                               y + size,
                               x + size / 4,
                               y + size * rng_unit(g)};
        polyset_ring(set, hole, 4);
    }
    polyset_end_polygon(set);
}

static void test_gears(void **state)
{
    (void)state;
    const size_t n = test_count(CASES / 10);
    for (uint64_t i = 0; i < n; i++) {
        rng g = rng_start(test_seed(), i);
        polyset set;
        polyset_init(&set);
        gear(&set, &g);
        sunder_shape *s = NULL;
        sunder_error err;
        /* A hole may cross itself by chance. */
        if (sunder_shape_from_rings(set.xy, set.ring_end, set.poly_end, set.polygons, SUNDER_VALIDITY_EVEN_ODD, &s,
                                    &err))
            explain(&set, i, err.message);
        const char *fault = sunder_i_shape_check(s);
        if (fault) explain(&set, i, fault);
        sunder_shape_free(s);
        polyset_free(&set);
    }
}

/* ---- Placing ---- */

/* A number n of the lattice as a rational: n * 2^exponent + origin. */
static void value_of(mpq_t r, sunder_i_lattice *l, int64_t n, double origin)
{
    mpq_t o;
    mpq_init(o);
    const sunder_i_ratio v = sunder_i_lattice_read(&l->arena, l, n);
    mpz_from_big(mpq_numref(r), v.num);
    mpz_from_big(mpq_denref(r), v.den);
    mpq_canonicalize(r);
    if (l->exponent >= 0)
        mpq_mul_2exp(r, r, (mp_bitcnt_t)l->exponent);
    else
        mpq_div_2exp(r, r, (mp_bitcnt_t)-l->exponent);
    mpq_set_d(o, origin);
    mpq_add(r, r, o);
    mpq_clear(o);
}

/* The exact coordinate: (coordinate + shift), negated if asked. */
static void truth(mpq_t r, const sunder_shape *s, size_t i, const double *shift, bool negate)
{
    mpq_t d;
    mpq_init(d);
    const sunder_i_exact *v = s->rational ? &s->form->numbers->exact[i / 2] : NULL;
    if (v && v->den.size) {
        mpz_from_big(mpq_numref(r), v->num[i & 1]);
        mpz_from_big(mpq_denref(r), v->den);
        mpq_canonicalize(r);
        if (v->exponent >= 0)
            mpq_mul_2exp(r, r, (mp_bitcnt_t)v->exponent);
        else
            mpq_div_2exp(r, r, (mp_bitcnt_t)-v->exponent);
    } else {
        mpq_set_d(r, s->xy[i]);
    }
    mpq_set_d(d, shift ? shift[i & 1] : 0);
    mpq_add(r, r, d);
    if (negate) mpq_neg(r, r);
    mpq_clear(d);
}

static void check_operand(sunder_i_lattice *l, const sunder_shape *s, const sunder_i_point *at, const double origin[2],
                          const double *shift, bool negate, uint64_t i)
{
    mpq_t got, want;
    mpq_inits(got, want, NULL);
    for (uint32_t v = 0; v < s->vertices; v++) {
        const int64_t n[2] = {at[v].x, at[v].y};
        for (size_t k = 0; k < 2; k++) {
            value_of(got, l, n[k], origin[k]);
            truth(want, s, 2 * (size_t)v + k, shift, negate);
            if (mpq_cmp(got, want) != 0)
                fail_msg("SUNDER_SEED=%llu, case %llu: vertex %u has other coordinates",
                         (unsigned long long)test_seed(), (unsigned long long)i, v);
            if (l->narrow) assert_true(n[k] < (int64_t)1 << 60 && n[k] > -((int64_t)1 << 60));
        }
    }
    mpq_clears(got, want, NULL);
}

static void check_place(const sunder_shape *p, const sunder_shape *q, rng *g, uint64_t i)
{
    static const double scale[] = {1, 1.0 / 1024, 0x1p60, 0x1p-200, 3e6};
    double shift[4];
    for (int k = 0; k < 4; k++) shift[k] = (double)rng_int(g, -1000, 1000) * scale[rng_int(g, 0, 4)];
    if (rng_once_in(g, 20)) shift[0] = 1.7e308;
    const double gap = 0.1;
    const sunder_i_place_options o = {.reflect_q = rng_once_in(g, 2),
                                      .common_origin = rng_once_in(g, 2),
                                      .extra = &gap,
                                      .extra_n = (size_t)rng_int(g, 0, 1),
                                      .shift_p = rng_once_in(g, 2) ? shift : NULL,
                                      .shift_q = rng_once_in(g, 2) ? shift + 2 : NULL,
                                      .force_wide = rng_once_in(g, 4)};
    sunder_i_placed placed;
    assert_int_equal(sunder_i_place(p, q, &o, &placed, NULL), SUNDER_OK);
    assert_false(o.force_wide && placed.lattice.narrow);
    check_operand(&placed.lattice, p, placed.p, placed.origin_p, o.shift_p, false, i);
    check_operand(&placed.lattice, q, placed.q, placed.origin_q, o.shift_q, o.reflect_q, i);
    for (int k = 0; k < 2 && o.common_origin; k++)
        assert_true(placed.origin_q[k] == (o.reflect_q ? -placed.origin_p[k] : placed.origin_p[k]));
    sunder_i_placed_free(&placed);
}

/* A shape with rational corners. */
static sunder_shape *bow_tie(rng *g)
{
    const double a = (double)rng_int(g, 1, 9), b = (double)rng_int(g, 1, 9);
    const double xy[] = {0, 0, a, 7, a, 0, 0, b + 0.125};
    const size_t ring_end[] = {4}, poly_end[] = {1};
    sunder_shape *s = NULL;
    assert_int_equal(sunder_shape_from_rings(xy, ring_end, poly_end, 1, SUNDER_VALIDITY_EVEN_ODD, &s, NULL), SUNDER_OK);
    return s;
}

static void test_place(void **state)
{
    (void)state;
    const size_t n = test_count(CASES);
    for (uint64_t i = 0; i < n; i++) {
        rng g = rng_start(test_seed(), i);
        polyset a, b;
        random_pair(&a, &b, &g, (pair_kind)(i % PAIR_KINDS));
        sunder_shape *p = build(&a, i), *q = build(&b, i), *r = bow_tie(&g);
        check_place(p, q, &g, i);
        check_place(q, r, &g, i);
        check_place(r, p, &g, i);
        sunder_shape_free(p);
        sunder_shape_free(q);
        sunder_shape_free(r);
        polyset_free(&a);
        polyset_free(&b);
    }
}

/* ---- Memory ---- */

typedef struct attempt_context {
    polyset set;
    sunder_validity validity;
} attempt_context;

static bool attempt(void *user)
{
    const attempt_context *c = user;
    const polyset *set = &c->set;
    sunder_shape *s = NULL, *r = NULL, *t = NULL, *d = NULL;
    sunder_error err;
    bool exact;
    sunder_status status =
        sunder_shape_from_rings(set->xy, set->ring_end, set->poly_end, set->polygons, c->validity, &s, &err);
    if (!status) status = sunder_shape_reflect(s, &r, &err);
    if (!status) status = sunder_shape_translate(s, 1.5, 0.1, &t, &exact, &err);
    if (!status) {
        sunder_shape_free(t);
        t = NULL;
        status = sunder_shape_translate(s, 2, -4, &t, &exact, &err);
    }
    if (!status) status = sunder_shape_disc(2, 12, false, &d, &err);
    assert_true(status == SUNDER_OK || status == SUNDER_ENOMEM);
    if (status) assert_int_equal(err.status, SUNDER_ENOMEM);
    sunder_shape_free(s);
    sunder_shape_free(r);
    sunder_shape_free(t);
    sunder_shape_free(d);
    return status == SUNDER_OK;
}

static void test_no_memory(void **state)
{
    (void)state;
    static const char *const wkt[] = {
        "POLYGON((0 0,9 0,9 9,5 3,0 9),(2 2,3 2,3 3),(4 1,5 1,5 2))",
        "MULTIPOLYGON(((0 0,9 0,9 9,0 9),(0 4,4 4,4 6)),((1 1,3 1,3 3)))",
        "MULTIPOLYGON(((0 0,7 5,7 0,0 6)),((1 1,3 1,3 3)),((0 0,1e200 1e-200,3 7,1 -1e-300)))",
    };
    for (size_t i = 0; i < sizeof wkt / sizeof *wkt; i++) {
        attempt_context c = {.validity = SUNDER_VALIDITY_EVEN_ODD};
        polyset_init(&c.set);
        assert_true(polyset_read_wkt(&c.set, wkt[i], NULL));
        /* Area and anchor return zero if memory is out, so an attempt may succeed although an allocation failed. */
        assert_true(failing_loop(attempt, &c, false));
        polyset_free(&c.set);
    }
    /* A large set: for grids, trees, many holes. */
    attempt_context c = {.validity = SUNDER_VALIDITY_STRICT};
    polyset_init(&c.set);
    const double outer[] = {0, 0, 100, 0, 100, 100, 0, 100};
    polyset_ring(&c.set, outer, 4);
    for (int k = 0; k < 49; k++) {
        const double x = 2 + 14 * (k % 7), y = 2 + 14 * (k / 7);
        const double hole[] = {x, y, x + 8, y + 1, x + 4, y + 3, x + 7, y + 8, x + 3, y + 5};
        polyset_ring(&c.set, hole, 5);
    }
    polyset_end_polygon(&c.set);
    assert_true(failing_loop(attempt, &c, false));
    polyset_free(&c.set);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_valid_sets), cmocka_unit_test(test_gears),
                                       cmocka_unit_test(test_place), cmocka_unit_test(test_no_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
