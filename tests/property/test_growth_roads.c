/* The three algorithms that unite subsums, measured by counts of operations and sizes of maps, never by time, on the
 * families that distinguish them. */
#include "generated.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#define SKIPPED 77

typedef struct work {
    sunder_sum_size out;
    sunder_counts all, unite;
    size_t map_edges, subsums;
} work;

static work done(const char *family, size_t n, sunder_algorithm algorithm, sunder_order order)
{
    char *arguments = test_format("%s --size %zu", family, n);
    const sunder_sum_options options = {.size = sizeof options,
                                        .algorithm = algorithm,
                                        .decomposition = SUNDER_DECOMPOSITION_ANGLE_BISECTOR,
                                        .order = order,
                                        .seed = 1,
                                        .keep_map = true};
    polyset p, q;
    generated_pair(&p, &q, arguments);
    sunder_shape *a = polyset_shape(&p), *b = polyset_shape(&q);
    sunder_sum *sum = NULL;
    sunder_sum_method method;
    work w;
    assert_true(a && b && sunder_minkowski_sum(a, b, &options, &sum, NULL) == SUNDER_OK);
    sunder_sum_get_size(sum, &w.out);
    sunder_sum_get_counts(sum, &w.all);
    assert_true(sunder_sum_phase(sum, SUNDER_PHASE_UNION, &w.unite));
    sunder_sum_get_method(sum, &method);
    w.subsums = method.pieces_p * method.pieces_q;
    w.map_edges = sunder_map_edges(sunder_sum_map(sum));
    print_message("%-24s %-12s %-6s %6zu subsums, map %7zu edges, out %6zu vertices; %8llu comparisons, %8llu "
                  "orientation tests, %7llu "
                  "crossings\n",
                  arguments, sunder_algorithm_string(algorithm), sunder_order_string(order), w.subsums, w.map_edges,
                  w.out.vertices, (unsigned long long)w.unite.comparisons,
                  (unsigned long long)w.unite.orientation_tests, (unsigned long long)w.unite.segment_intersections);
    sunder_sum_free(sum);
    sunder_shape_free(a);
    sunder_shape_free(b);
    polyset_free(&p);
    polyset_free(&q);
    free(arguments);
    return w;
}

/* ceil(log2(n)) */
static size_t logarithm(size_t n)
{
    size_t l = 0;
    while (((size_t)1 << l) < n) l++;
    return l;
}

/* The number of questions is in O(I + k log k) for k subsums with I crossings: few per edge of the arrangement and, to
 * find the first corner of each subsum, few per level of the history. The number of edges is I up to a constant factor.
 * That factor grew slowly over the sizes tried, and less than the logarithm of the size of the map. */
static void test_arrangement(void **state)
{
    for (size_t n = 16; n <= 96; n *= 2) {
        const work w = done("fork", n, SUNDER_ALGORITHM_ARRANGEMENT, SUNDER_ORDER_RANDOM);
        const size_t asked = (size_t)(w.unite.comparisons + w.unite.orientation_tests);
        assert_true(asked <= 2 * (w.map_edges + w.subsums) * logarithm(w.map_edges));
        assert_true(w.map_edges >= w.out.vertices && w.unite.segment_intersections <= w.map_edges);
    }
}

/* With the largest subsums first the cost is proportional to the output; in random order, the arrangement of the forks
 * is computed before they are covered. */
static void test_covered_fork(void **state)
{
    for (size_t n = 32; n <= 96; n += 32) {
        const work fat = done("covered-fork", n, SUNDER_ALGORITHM_INCREMENTAL, SUNDER_ORDER_FAT);
        const work random = done("covered-fork", n, SUNDER_ALGORITHM_INCREMENTAL, SUNDER_ORDER_RANDOM);
        const work arranged = done("covered-fork", n, SUNDER_ALGORITHM_ARRANGEMENT, SUNDER_ORDER_RANDOM);
        assert_true(fat.unite.segment_intersections <= 2 * fat.out.vertices);
        assert_true(random.unite.segment_intersections >= 5 * fat.unite.segment_intersections);
        assert_true(arranged.unite.segment_intersections >= 50 * fat.unite.segment_intersections);
    }
}

/* If one operand is a single convex polygon there is nothing for the first round of divide and conquer to unite: each P
 * + Q_j is one subsum, and log t rounds of overlays are necessary, each on maps nearly as large as the result. With the
 * operands exchanged the only P + Q_1 is the incremental union itself. */
static void test_divide_on_comb(void **state)
{
    for (size_t n = 32; n <= 128; n *= 2) {
        const work swapped = done("comb --swap", n, SUNDER_ALGORITHM_DIVIDE, SUNDER_ORDER_RANDOM);
        const work straight = done("comb", n, SUNDER_ALGORITHM_DIVIDE, SUNDER_ORDER_RANDOM);
        const work incremental = done("comb --swap", n, SUNDER_ALGORITHM_INCREMENTAL, SUNDER_ORDER_RANDOM);
        const work other = done("comb", n, SUNDER_ALGORITHM_INCREMENTAL, SUNDER_ORDER_RANDOM);
        assert_int_equal(straight.unite.segment_intersections, other.unite.segment_intersections);
        assert_int_equal(straight.unite.comparisons, other.unite.comparisons);
        assert_true(swapped.unite.comparisons >= 2 * incremental.unite.comparisons);
    }
}

int main(void)
{
    if (!generated_available()) return SKIPPED;
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_arrangement), cmocka_unit_test(test_covered_fork),
                                       cmocka_unit_test(test_divide_on_comb)};
    return cmocka_run_group_tests_name("what the roads do", tests, NULL, NULL);
}
