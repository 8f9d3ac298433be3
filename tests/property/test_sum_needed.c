/* Sums with so many subsums that those deep inside are not computed: the same, byte for byte, as by an algorithm that
 * computes them all, on the lattice and on big integers. */
#include "convex/hertel_mehlhorn.h"
#include "convex/needed_subsums.h"
#include "generate.h"
#include "minkowski/minkowski.h"
#include "roads.h"
#include "sum_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Counts the subsums, and those that are reported as needed. */
static void count_needed(const polyset *p, const polyset *q, size_t count[2])
{
    sunder_shape *a = polyset_shape(p), *b = polyset_shape(q);
    sunder_i_placed placed;
    sunder_i_convex_pieces s, t, *const list[2] = {&s, &t};
    sunder_i_directions directions;
    sunder_i_subsum_list needed;
    const sunder_i_place_options how = {0};
    assert_int_equal(sunder_i_place(a, b, &how, &placed, NULL), SUNDER_OK);
    assert_true(sunder_i_hertel_mehlhorn(&placed.lattice, a, placed.p, &s) &&
                sunder_i_hertel_mehlhorn(&placed.lattice, b, placed.q, &t) &&
                sunder_i_convex_pieces_rank(&placed.lattice, list, 2, &directions) &&
                sunder_i_needed_subsums(&s, &t, 128, &needed));
    count[0] = (size_t)s.n * t.n;
    count[1] = needed.all ? count[0] : needed.n;
    for (size_t i = 1; !needed.all && i < needed.n; i++) assert_true(needed.pair[i - 1] < needed.pair[i]);
    sunder_i_subsum_list_free(&needed);
    sunder_i_convex_pieces_free(&s);
    sunder_i_convex_pieces_free(&t);
    sunder_i_directions_free(&directions);
    sunder_i_placed_free(&placed);
    sunder_shape_free(a);
    sunder_shape_free(b);
}

static bool agrees(const polyset *p, const polyset *q, size_t i)
{
    const sunder_sum_options how = {.size = sizeof how,
                                    .algorithm = SUNDER_ALGORITHM_DIVIDE,
                                    .decomposition = i % 2 ? SUNDER_DECOMPOSITION_ANGLE_BISECTOR
                                                           : SUNDER_DECOMPOSITION_HERTEL_MEHLHORN};
    char *want = i % 4 ? library_sum_text(p, q) : library_sum_text_wide(p, q);
    assert_non_null(want);
    const bool same = road_agrees(p, q, &how, false, want, true);
    free(want);
    return same;
}

static void test_families(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(120);
    size_t bad = 0, fewer = 0, many = 0;
    for (size_t i = 0; i < n && bad < 2; i++) {
        rng r = rng_start(seed * 17, i);
        polyset p, q;
        size_t count[2];
        random_family(&p, &q, &r, (family_kind)(i % FAMILY_KINDS), 50, i % 5 ? 90 : 150);
        count_needed(&p, &q, count);
        many += count[0] >= 256;
        fewer += count[0] >= 256 && count[1] < count[0];
        if (!agrees(&p, &q, i)) {
            print_message("SUNDER_SEED=%llu, case %zu, %s\n", (unsigned long long)seed, i,
                          family_kind_string((family_kind)(i % FAMILY_KINDS)));
            bad++;
        }
        polyset_free(&p);
        polyset_free(&q);
    }
    print_message("SUNDER_SEED=%llu: %zu sums, %zu of 256 subsums or more, %zu with some left out\n",
                  (unsigned long long)seed, n, many, fewer);
    assert_int_equal(bad, 0);
    assert_true(fewer >= n / 10);
}

/* The larger two stars are, the smaller the share of the subsums that the outline needs. */
static void test_share(void **state)
{
    (void)state;
    double before = 1;
    for (int n = 50; n <= 400; n *= 2) {
        rng r = rng_start(test_seed() * 3, (uint64_t)n);
        polyset p, q;
        size_t count[2];
        polyset_init(&p);
        polyset_init(&q);
        random_star(&p, &r, n, 1e6);
        random_star(&q, &r, n, 1e6);
        count_needed(&p, &q, count);
        print_message("stars of %d: %zu of %zu subsums\n", n, count[1], count[0]);
        assert_true((double)count[1] < before * (double)count[0]);
        before = (double)count[1] / (double)count[0];
        polyset_free(&p);
        polyset_free(&q);
    }
    assert_true(before < 0.1);
}

/* A part far from everything else, and one that is tiny compared with the others, keep their sums. */
static void test_far_and_tiny(void **state)
{
    (void)state;
    rng r = rng_start(test_seed() * 5, 0);
    for (size_t i = 0; i < 4; i++) {
        polyset p, q;
        polyset_init(&p);
        polyset_init(&q);
        random_star(&p, &r, 40, 1000);
        random_star(&q, &r, 40, 1000);
        if (i & 1)
            polyset_rectangle(i & 2 ? &p : &q, 1e9, -1e9, 1e9 + 1, -1e9 + 1);
        else
            polyset_rectangle(i & 2 ? &p : &q, 3000, 0, 3000 + 0x1p-20, 0x1p-20);
        assert_true(agrees(&p, &q, i + 1));
        polyset_free(&p);
        polyset_free(&q);
    }
}

/* Long copies of one outline at small distances stay together in every cell. There their sides are half-planes, the
 * widest of which covers the others. The number of questions is compared with the number of output vertices. */
static void test_copies(void **state)
{
    (void)state;
    polyset p, q;
    sunder_sum_size size;
    sunder_counts counts;
    sunder_sum *sum = NULL;
    polyset_init(&p);
    polyset_init(&q);
    for (int i = 0; i < 100; i++) {
        const double corner[] = {8 * i, 0, 8 * i + 400, 0, 8 * i + 210, 8000};
        polyset_polygon(&p, corner, 3);
    }
    polyset_rectangle(&q, 0, 0, 8, 4);
    polyset_rectangle(&q, 0, 0, 4, 9);
    sunder_shape *a = polyset_shape(&p), *b = polyset_shape(&q);
    assert_true(a && b && sunder_minkowski_sum(a, b, NULL, &sum, NULL) == SUNDER_OK);
    sunder_sum_get_size(sum, &size);
    sunder_sum_get_counts(sum, &counts);
    print_message("copies: %zu vertices, %llu orientation tests\n", size.vertices,
                  (unsigned long long)counts.orientation_tests);
    assert_true(size.vertices == 404 && counts.orientation_tests < 250 * size.vertices);
    sunder_sum_free(sum);
    sunder_shape_free(a);
    sunder_shape_free(b);
    polyset_free(&p);
    polyset_free(&q);
}

/* A large piece is only worth its cost if it has others inside: tested with squares spread over it, and with teeth
 * along its edge. */
static void test_one_large_piece(void **state)
{
    (void)state;
    for (int inside = 0; inside < 2; inside++) {
        polyset p, q;
        size_t count[2];
        polyset_init(&p);
        polyset_init(&q);
        polyset_rectangle(&p, 0, 0, 10000, 10000);
        for (int i = 0; i < 400; i++) {
            const double x = inside ? 500 * (i % 20) + 10 : 25 * i, y = inside ? 500 * (i / 20) + 10 : -9;
            polyset_rectangle(&p, x, y, x + 10, y + 10);
        }
        polyset_rectangle(&q, 0, 0, 3, 2);
        count_needed(&p, &q, count);
        assert_true(inside ? count[1] < count[0] / 4 : count[1] == count[0]);
        assert_true(agrees(&p, &q, 0));
        polyset_free(&p);
        polyset_free(&q);
    }
}

static void test_memory(void **state)
{
    (void)state;
    rng r = rng_start(7, 0);
    polyset operand[2];
    size_t count[2];
    for (int k = 0; k < 2; k++) {
        polyset_init(&operand[k]);
        random_star(&operand[k], &r, 44, 1000);
    }
    count_needed(&operand[0], &operand[1], count);
    assert_true(count[0] >= 256 && count[1] < count[0]);
    assert_true(library_sum_survives(operand));
    for (int k = 0; k < 2; k++) polyset_free(&operand[k]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_families),        cmocka_unit_test(test_share),
                                       cmocka_unit_test(test_far_and_tiny),    cmocka_unit_test(test_copies),
                                       cmocka_unit_test(test_one_large_piece), cmocka_unit_test(test_memory)};
    return cmocka_run_group_tests_name("subsums that the outline needs", tests, NULL, NULL);
}
