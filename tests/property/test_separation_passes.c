/* Straight paths of points past random sets, compared with brute force in rationals: paths along edges, through
 * corners, of length zero, that end where an edge begins; starts inside, outside and on the boundary; coordinates of
 * similar and of very different sizes. */
#include "generate.h"
#include "passage_oracle.h"
#include "separation/separation.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

typedef struct tally {
    size_t asked, held, met, unsure;
} tally;

/* A place that is often related to the set's corners and edges: a corner, between two corners, or anywhere nearby. */
static void random_place(const polyset *set, rng *r, double out[2])
{
    const double *p = set->xy + 2 * (size_t)rng_int(r, 0, (int64_t)set->vertices - 1);
    const double *q = set->xy + 2 * (size_t)rng_int(r, 0, (int64_t)set->vertices - 1);
    static const double shares[] = {0, 0.5, 0.25, 2, -1, 1.5};
    const double share = shares[rng_int(r, 0, 5)];
    for (int k = 0; k < 2; k++) {
        out[k] = p[k] + share * (q[k] - p[k]);
        if (rng_once_in(r, 4)) out[k] = nextafter(out[k], rng_once_in(r, 2) ? INFINITY : -INFINITY);
        if (rng_once_in(r, 5)) out[k] = q[k];
        if (!isfinite(out[k])) out[k] = p[k];
    }
}

/* A path from a that ends at e as nearly as doubles allow, or exactly, in two moves. */
static void random_moves(rng *r, const double a[2], const double e[2], double t[2], double s[2])
{
    for (int k = 0; k < 2; k++) {
        const double u = isfinite(e[k] - a[k]) ? e[k] - a[k] : 0;
        static const double scale[] = {0, 0, 1, 0x1p20, 0x1p-30};
        s[k] = scale[rng_int(r, 0, 4)] * (double)rng_int(r, -8, 8) * (rng_once_in(r, 3) ? 0.1 : 1);
        t[k] = u + s[k];
        if (!isfinite(t[k])) t[k] = s[k] = 0;
    }
}

static void check_ways(const polyset *set, const sunder_shape *shape, const oracle_boundary *truth, rng *r, tally *sum)
{
    for (int k = 0; k < 12; k++) {
        double a[2], e[2];
        sunder_i_passage way;
        random_place(set, r, a);
        random_place(set, r, e);
        if (rng_once_in(r, 12)) e[0] = a[0], e[1] = a[1];
        random_moves(r, a, e, way.t, way.s);
        way.from[0] = a[0], way.from[1] = a[1];
        bool holds, passes;
        assert_int_equal(sunder_i_holds(shape, a, &holds, NULL), SUNDER_OK);
        assert_int_equal(sunder_i_passes(&way, shape, &passes, NULL), SUNDER_OK);
        const bool held = oracle_holds(truth, a), met = !held && oracle_way_meets(truth, a, way.t, way.s);
        sum->asked++;
        sum->held += held;
        sum->met += met;
        if (holds == held && passes == met) continue;
        char *text = polyset_wkt(set);
        print_error("%s\nfrom %.17g %.17g by %.17g %.17g less %.17g %.17g: holds %d for %d, passes %d for %d\n", text,
                    a[0], a[1], way.t[0], way.t[1], way.s[0], way.s[1], holds, held, passes, met);
        free(text);
        fail();
    }
}

static void shapes_are_passed(void **state)
{
    const uint64_t seed = test_seed();
    const size_t rounds = test_count(1500);
    tally sum = {0};
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
    for (size_t i = 0; i < rounds; i++) {
        rng r = rng_start(seed, i);
        polyset p, q;
        oracle_boundary truth;
        random_pair(&p, &q, &r, (pair_kind)(i % PAIR_KINDS));
        sunder_shape *shape = polyset_shape(&p);
        assert_non_null(shape);
        oracle_boundary_open(&truth, &p);
        check_ways(&p, shape, &truth, &r, &sum);
        oracle_boundary_close(&truth);
        sunder_shape_free(shape);
        polyset_free(&p);
        polyset_free(&q);
    }
    print_message("%zu ways, %zu begin inside, %zu pass\n", sum.asked, sum.held, sum.met);
    assert_true(sum.held > 0 && sum.met > 0 && sum.held + sum.met < sum.asked);
}

static void repaired_shapes_are_passed(void **state)
{
    const uint64_t seed = test_seed();
    const size_t rounds = test_count(500);
    tally sum = {0};
    for (size_t i = 0; i < rounds; i++) {
        rng r = rng_start(seed, i);
        polyset p;
        even_odd set;
        oracle_boundary truth;
        sunder_shape *shape = NULL;
        polyset_init(&p);
        random_invalid(&p, &r, (invalid_kind)(i % INVALID_KINDS), 12);
        assert_int_equal(
            sunder_shape_from_rings(p.xy, p.ring_end, p.poly_end, p.polygons, SUNDER_VALIDITY_EVEN_ODD, &shape, NULL),
            SUNDER_OK);
        even_odd_open(&set, &p);
        oracle_boundary_of_even_odd(&truth, &set);
        if (p.vertices) check_ways(&p, shape, &truth, &r, &sum);
        oracle_boundary_close(&truth);
        even_odd_close(&set);
        sunder_shape_free(shape);
        polyset_free(&p);
    }
    print_message("%zu ways, %zu begin inside, %zu pass\n", sum.asked, sum.held, sum.met);
    assert_true(sum.held > 0 && sum.met > 0 && sum.held + sum.met < sum.asked);
}

/* Each kind of arithmetic gives the exact answer, or none. */
static void rungs_agree(void **state)
{
    const uint64_t seed = test_seed();
    const size_t rounds = test_count(50000);
    tally sum = {0};
    for (size_t i = 0; i < rounds; i++) {
        rng r = rng_start(seed, i);
        double v[5][2];
        static const double scale[] = {1, 0.1, 0x1p-40, 1e6, 0x1p400, 0x1p-600};
        const double size = scale[rng_int(&r, 0, 5)];
        for (int k = 0; k < 5; k++)
            for (int c = 0; c < 2; c++) v[k][c] = size * ((double)rng_int(&r, -4, 4) + (rng_once_in(&r, 3) ? 0.3 : 0));
        const sunder_i_passage way = {{v[0][0], v[0][1]}, {v[1][0], v[1][1]}, {v[2][0], v[2][1]}};
        const int side = sunder_i_passage_side_filter(&way, v[3]), end = sunder_i_passage_end_filter(&way, v[3], v[4]);
        if (side == SUNDER_I_PASSAGE_UNSURE || end == SUNDER_I_PASSAGE_UNSURE) sum.unsure++;
        if (side != SUNDER_I_PASSAGE_UNSURE) assert_int_equal(side, sunder_i_passage_side_exact(&way, v[3]));
        if (end != SUNDER_I_PASSAGE_UNSURE) assert_int_equal(end, sunder_i_passage_end_exact(&way, v[3], v[4]));
        const double line[4] = {v[3][0], v[3][1], v[4][0], v[4][1]};
        oracle_boundary truth;
        oracle_boundary_of_line(&truth, line, 2);
        const bool meets = oracle_way_meets(&truth, way.from, way.t, way.s);
        assert_int_equal(sunder_i_passage_meets(&way, v[3], v[4]), meets);
        oracle_boundary_close(&truth);
        double box[4];
        sunder_i_passage_box(&way, box);
        for (int c = 0; c < 2; c++) assert_true(box[c] <= way.from[c] && way.from[c] <= box[c + 2]);
        sum.met += meets;
    }
    print_message("%zu of %zu unsure, %zu meet\n", sum.unsure, rounds, sum.met);
    assert_true(sum.unsure > 0 && sum.unsure < rounds && sum.met > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(shapes_are_passed),
                                       cmocka_unit_test(repaired_shapes_are_passed), cmocka_unit_test(rungs_agree)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
