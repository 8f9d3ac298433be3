/* The nearest free placement, searched square by square as for large operands, equals the one found without squares:
 * the same point and the same contact. Pairs of all kinds of degeneracy are drawn, also translated so that they overlap
 * by little, and ragged outlines that are large enough for squares to matter, including stars of equal spikes and round
 * outlines, whose pieces are cut. Every fourth pair is on a wide lattice. With a gap: the same least length, rounded
 * down, the same contact, and a result that is hardly longer. */
#include "failing.h"
#include "generate.h"
#include "separation/least_translation.h"
#include "separation/penetration/penetration_search.h"
#include "separation/separation.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

typedef struct result {
    bool done;
    sunder_i_free_point nearest;
    sunder_contact contact;
} result;

static sunder_i_operands pair_up(const sunder_shape *p, const sunder_shape *q, const double *move, bool wide)
{
    sunder_i_operands g;
    const sunder_i_operands_options how = {.tq = move, .reflect_q = true, .force_wide = wide};
    assert_int_equal(sunder_i_operands_init(&g, p, q, &how, NULL), SUNDER_OK);
    return g;
}

static result look(sunder_i_operands *g, bool squares)
{
    result r = {.done = true};
    assert_int_equal(squares ? sunder_i_nearest_by_squares(g, INFINITY, &r.done, &r.nearest, NULL)
                             : sunder_i_nearest_free_point(g, INFINITY, &r.nearest, NULL),
                     SUNDER_OK);
    if (r.done && !r.nearest.origin) {
        assert_true(r.nearest.found);
        assert_true(sunder_i_free_point_verify(g, &r.nearest));
        sunder_i_near_subsums near;
        r.contact = sunder_i_free_point_contact(g, &r.nearest, &near);
    }
    return r;
}

/* The exact coordinates of the point, in memory of the arena. */
static sunder_i_rational_point read_point(sunder_i_arena *arena, sunder_i_operands *g, const sunder_i_free_point *found)
{
    sunder_i_lattice *l = &g->placed.lattice;
    const sunder_i_hpoint point = sunder_i_hpoint_at(l, found->line.a, found->line.b, &found->t);
    return sunder_i_hpoint_read(arena, l, &point);
}

/* Each lattice has its own numbers; their units are the same. */
static bool same_point(sunder_i_operands *g, const sunder_i_free_point *a, sunder_i_operands *h,
                       const sunder_i_free_point *b)
{
    sunder_i_lattice *l = &g->placed.lattice;
    const sunder_i_mark mark = sunder_i_lattice_begin(l);
    const sunder_i_rational_point p = read_point(&l->scratch, g, a), q = read_point(&l->scratch, h, b);
    const bool same =
        sunder_i_big_cmp(sunder_i_big_mul(&l->scratch, p.x, q.w), sunder_i_big_mul(&l->scratch, q.x, p.w)) == 0 &&
        sunder_i_big_cmp(sunder_i_big_mul(&l->scratch, p.y, q.w), sunder_i_big_mul(&l->scratch, q.y, p.w)) == 0;
    sunder_i_lattice_end(l, mark);
    return same;
}

/* Searches with and without squares, perhaps on wide lattices; returns whether the search with squares succeeded. */
static bool compare(const polyset *p, const polyset *q, const double *move, bool wide, bool *same)
{
    sunder_shape *a = polyset_shape(p), *b = polyset_shape(q);
    sunder_i_operands g = pair_up(a, b, move, wide), h = pair_up(a, b, move, wide);
    assert_true(sunder_i_operands_cut(&g));
    const result r = look(&g, true), s = look(&h, false);
    *same = !r.done || r.nearest.origin == s.nearest.origin;
    if (r.done && *same && !r.nearest.origin)
        *same = same_point(&g, &r.nearest, &h, &s.nearest) && r.contact == s.contact;
    sunder_i_operands_free(&g);
    sunder_i_operands_free(&h);
    sunder_shape_free(a);
    sunder_shape_free(b);
    return r.done;
}

static void expect_same(const polyset *p, const polyset *q, const double *move, size_t *done, uint64_t seed, size_t i)
{
    bool same;
    *done += compare(p, q, move, i % 4 == 3, &same);
    if (same) return;
    char *x = polyset_wkt(p), *y = polyset_wkt(q);
    print_message("SUNDER_SEED=%llu, case %zu\n%.3000s\n%.3000s\nmoved by %g %g\n", (unsigned long long)seed, i, x, y,
                  move[0], move[1]);
    free(x);
    free(y);
    fail();
}

static void test_kinds(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(60);
    size_t done = 0;
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
    for (int kind = 0; kind < PAIR_HUGE; kind++)
        for (size_t i = 0; i < n; i++) {
            rng r = rng_start(seed * 41 + (uint64_t)kind, i);
            polyset p, q;
            random_pair(&p, &q, &r, (pair_kind)kind);
            const double move[2] = {(double)rng_int(&r, -4, 4), (double)rng_int(&r, -4, 4)};
            expect_same(&p, &q, move, &done, seed, i);
            polyset_free(&p);
            polyset_free(&q);
        }
    assert_true(done > n * PAIR_HUGE / 2);
}

/* With a gap. If the exact point is irrational, its approximation depends on the order of the contacts there; the exact
 * point does not. */
static void expect_same_gap(const polyset *p, const polyset *q, const double *move, double gap, uint64_t seed, size_t i)
{
    sunder_shape *a = polyset_shape(p), *b = polyset_shape(q);
    sunder_separation out[2];
    for (int k = 0; k < 2; k++) {
        const sunder_i_least_options o = {.tq = move, .gap = gap, .upper = INFINITY, .force_squares = k == 0};
        assert_int_equal(sunder_i_least(a, b, &o, &out[k], NULL, NULL), SUNDER_OK);
    }
    sunder_shape_free(a);
    sunder_shape_free(b);
    const bool same = out[0].overlap == out[1].overlap && out[0].contact == out[1].contact &&
                      out[0].lower_bound == out[1].lower_bound &&
                      fabs(out[0].distance - out[1].distance) <= 1e-9 * out[1].distance;
    if (same) return;
    char *x = polyset_wkt(p), *y = polyset_wkt(q);
    print_message("SUNDER_SEED=%llu, case %zu\n%.3000s\n%.3000s\nmoved by %g %g, gap %g: %.17g %.17g, %.17g %.17g\n",
                  (unsigned long long)seed, i, x, y, move[0], move[1], gap, out[0].lower_bound, out[0].distance,
                  out[1].lower_bound, out[1].distance);
    free(x);
    free(y);
    fail();
}

static void test_gap_kinds(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(40);
    for (int kind = 0; kind < PAIR_HUGE; kind++)
        for (size_t i = 0; i < n; i++) {
            rng r = rng_start(seed * 53 + (uint64_t)kind, i);
            polyset p, q;
            random_pair(&p, &q, &r, (pair_kind)kind);
            const double move[2] = {(double)rng_int(&r, -4, 4), (double)rng_int(&r, -4, 4)};
            const double gap = rng_once_in(&r, 2) ? (double)rng_int(&r, 1, 5) : 0.25 + rng_unit(&r);
            expect_same_gap(&p, &q, move, gap, seed, i);
            polyset_free(&p);
            polyset_free(&q);
        }
}

/* Outlines along pixels, ragged stars and combs: exact coincidences, many spikes that overlap, exact fits. */
static void random_large(polyset *p, rng *r, size_t kind, int n)
{
    cells board;
    polyset_init(p);
    switch (kind % 3) {
    case 0: random_star(p, r, n, 2000); return;
    case 1: random_comb(p, r, n / 4, 2000, rng_once_in(r, 2)); return;
    default:
        random_cells(&board, r, CELLS_MAX, CELLS_MAX, SPACING_SMALL, false, 75);
        cells_outline(p, &board, false, true);
    }
}

/* The same for a random shift of at most `far`. */
static void expect_same_moved(polyset *p, polyset *q, rng *r, double far, size_t *done, uint64_t seed, size_t i)
{
    const double move[2] = {rint(far * rng_unit(r)), rint(far * rng_unit(r))};
    expect_same(p, q, move, done, seed, i);
    polyset_free(p);
    polyset_free(q);
}

static void test_large(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(45);
    size_t done = 0;
    for (size_t i = 0; i < n; i++) {
        rng r = rng_start(seed * 43, i);
        polyset p, q;
        random_large(&p, &r, i, (int)rng_int(&r, 20, 240));
        random_large(&q, &r, i + (i / 3) % 2, (int)rng_int(&r, 20, 240));
        const double far = rng_once_in(&r, 2) ? 20 : 1200;
        expect_same_moved(&p, &q, &r, far, &done, seed, i);
    }
    assert_true(done > n / 2);
}

/* n corners around a circle, every second one at `inner` of its radius. */
static void round_outline(polyset *p, rng *r, int n, double size, double inner)
{
    const double turn = rng_once_in(r, 2) ? 0 : rng_unit(r);
    polyset_init(p);
    for (int i = 0; i < n; i++) {
        const double angle = 2 * 3.14159265358979 * (i + turn) / n, length = i % 2 ? size : inner * size;
        polyset_vertex(p, rint(length * cos(angle)), rint(length * sin(angle)));
    }
    polyset_end_ring(p);
    polyset_end_polygon(p);
}

/* Pairs of stars of equal spikes, round outlines, and stars of unequal spikes. */
static void test_even(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(36);
    const double size = 200000;
    size_t done = 0;
    for (size_t i = 0; i < n; i++) {
        rng r = rng_start(seed * 47, i);
        polyset set[2];
        for (size_t k = 0; k < 2; k++) {
            const int corners = 2 * (int)rng_int(&r, 10, 100);
            switch ((k ? i / 3 : i) % 3) {
            case 0: round_outline(&set[k], &r, corners, size, 0.05 + 0.5 * rng_unit(&r)); break;
            case 1: round_outline(&set[k], &r, corners, size, 1); break;
            default: polyset_init(&set[k]), random_star(&set[k], &r, corners, size);
            }
        }
        expect_same_moved(&set[0], &set[1], &r, rng_once_in(&r, 2) ? 2000 : 120000, &done, seed, i);
    }
    assert_true(done > n / 2);
}

static void test_gap_large(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(24);
    for (size_t i = 0; i < n; i++) {
        rng r = rng_start(seed * 59, i);
        polyset p, q;
        random_large(&p, &r, i, (int)rng_int(&r, 20, 80));
        random_large(&q, &r, i + (i / 3) % 2, (int)rng_int(&r, 20, 80));
        const double move[2] = {rint(1200 * rng_unit(&r)), rint(1200 * rng_unit(&r))};
        expect_same_gap(&p, &q, move, rng_once_in(&r, 2) ? (double)rng_int(&r, 1, 200) : 0.3, seed, i);
        polyset_free(&p);
        polyset_free(&q);
    }
}

static bool search_once(void *context)
{
    const sunder_shape *const *shape = context;
    const sunder_i_operands_options how = {.reflect_q = true};
    sunder_i_operands g;
    sunder_i_free_point nearest;
    bool done;
    if (sunder_i_operands_init(&g, shape[0], shape[1], &how, NULL) != SUNDER_OK) return false;
    const bool ok = sunder_i_nearest_by_squares(&g, INFINITY, &done, &nearest, NULL) == SUNDER_OK;
    sunder_i_operands_free(&g);
    return ok;
}

static bool search_gap_once(void *context)
{
    const sunder_shape *const *shape = context;
    const sunder_i_least_options o = {.gap = 30, .upper = INFINITY, .force_squares = true};
    sunder_separation out;
    const sunder_status status = sunder_i_least(shape[0], shape[1], &o, &out, NULL, NULL);
    assert_true(status == SUNDER_OK || status == SUNDER_ENOMEM);
    return status == SUNDER_OK;
}

static void test_memory(void **state)
{
    (void)state;
    rng r = rng_start(5, 0);
    polyset p, q;
    random_large(&p, &r, 0, 40);
    random_large(&q, &r, 1, 40);
    sunder_shape *shape[2] = {polyset_shape(&p), polyset_shape(&q)};
    assert_true(failing_loop(search_once, shape, false));
    assert_true(failing_loop(search_gap_once, shape, false));
    for (int k = 0; k < 2; k++) sunder_shape_free(shape[k]);
    polyset_free(&p);
    polyset_free(&q);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_kinds),     cmocka_unit_test(test_large),
                                       cmocka_unit_test(test_even),      cmocka_unit_test(test_gap_kinds),
                                       cmocka_unit_test(test_gap_large), cmocka_unit_test(test_memory)};
    return cmocka_run_group_tests_name("square by square", tests, NULL, NULL);
}
