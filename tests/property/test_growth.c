/* The sizes of sums of the families, and the work for them, as functions of the sizes of P and Q: measured by the size
 * of the output and counts of operations, never by time. The families come from sunder-families, so the generator is
 * tested, too. */
#include "generated.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define SKIPPED 77

typedef struct growth {
    size_t m, n; /* vertices of P and of Q */
    sunder_sum_size out;
    sunder_counts counts;
} growth;

static growth grow(const char *family, size_t m, size_t n, unsigned seed)
{
    char *arguments = test_format("%s --size %zu --size-q %zu --seed %u", family, m, n, seed);
    polyset p, q;
    generated_pair(&p, &q, arguments);
    sunder_shape *a = polyset_shape(&p), *b = polyset_shape(&q);
    sunder_sum *sum = NULL;
    assert_true(a && b && sunder_minkowski_sum(a, b, NULL, &sum, NULL) == SUNDER_OK);
    growth g = {.m = sunder_shape_vertices(a), .n = sunder_shape_vertices(b)};
    sunder_sum_get_size(sum, &g.out);
    sunder_sum_get_counts(sum, &g.counts);
    print_message("%-40s %zu + %zu: %zu vertices, %zu holes, %llu crossings\n", arguments, g.m, g.n, g.out.vertices,
                  g.out.holes, (unsigned long long)g.counts.segment_intersections);
    sunder_sum_free(sum);
    sunder_shape_free(a);
    sunder_shape_free(b);
    polyset_free(&p);
    polyset_free(&q);
    free(arguments);
    return g;
}

/* low <= b / a <= high */
static void assert_ratio(size_t a, size_t b, size_t low, size_t high)
{
    if (b < low * a || b > high * a) fail_msg("%zu is not %zu to %zu times %zu", b, low, high, a);
}

static void test_convex(void **state)
{
    static const size_t sizes[][2] = {{8, 8}, {8, 200}, {50, 13}, {400, 400}, {9, 3000}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (unsigned seed = 1; seed <= 5; seed++) {
            const growth g = grow("convex", sizes[i][0], sizes[i][1], seed);
            assert_int_equal(g.out.polygons, 1);
            assert_int_equal(g.out.holes + g.out.degenerate_segments + g.out.degenerate_points, 0);
            assert_true(g.out.vertices <= g.m + g.n);
        }
}

/* Half of the m vertices are tips, and nearly half of Q is visible at each tip. */
static void test_comb(void **state)
{
    growth before = grow("comb", 20, 20, 1);
    for (size_t n = 40; n <= 640; n *= 2) {
        const growth g = grow("comb", n, n, 1), wider = grow("comb", n, 2 * n, 1), longer = grow("comb", 2 * n, n, 1);
        assert_true(8 * g.out.vertices >= g.m * g.n && g.out.vertices <= g.m * g.n);
        assert_ratio(before.out.vertices, g.out.vertices, 3, 5);
        assert_true(2 * wider.out.vertices > 3 * g.out.vertices && 2 * wider.out.vertices < 5 * g.out.vertices);
        assert_true(2 * longer.out.vertices > 3 * g.out.vertices && 2 * longer.out.vertices < 5 * g.out.vertices);
        before = g;
    }
}

/* The number of holes of the grid is exact, and there are no more vertices than crossings of all pairs of sums of
 * teeth. */
static void test_fork(void **state)
{
    static const char *const names[] = {"fork", "slanted-fork"};
    for (int slanted = 0; slanted < 2; slanted++) {
        growth before = {0};
        for (size_t n = 16; n <= 128; n *= 2) {
            const size_t teeth = n == 16 ? slanted ? 1 : 2 : slanted ? n / 6 - 1 : n / 8;
            const growth g = grow(names[slanted], n, n, 1);
            assert_true(g.out.holes >= (teeth * teeth - 1) * (teeth * teeth - 1));
            assert_true(g.out.vertices <= g.m * g.m * g.n * g.n);
            if (n > 32) assert_ratio(before.out.vertices, g.out.vertices, 10, 32); /* 2^4, and more for short forks */
            if (n > 32) assert_ratio(before.counts.segment_intersections, g.counts.segment_intersections, 8, 40);
            before = g;
        }
        const growth wide = grow(names[slanted], 32, 128, 1), square = grow(names[slanted], 32, 64, 1);
        assert_ratio(square.out.vertices, wide.out.vertices, 3, 6); /* n^2 alone */
    }
}

/* A sum that is no larger than its operands, added to the fork's; covered parts are discarded before the arrangement is
 * computed. */
static void test_covered_fork(void **state)
{
    for (size_t n = 16; n <= 256; n *= 2) {
        const growth g = grow("covered-fork", n, n, 1);
        assert_int_equal(g.out.polygons, 1);
        assert_int_equal(g.out.holes, 0);
        assert_true(g.out.vertices <= g.m + g.n);
    }
    const growth covered = grow("covered-fork", 128, 128, 1), bare = grow("fork", 128, 128, 1);
    assert_ratio(covered.out.vertices, bare.out.vertices, 1000, SIZE_MAX / (covered.out.vertices + 1));
    assert_ratio(covered.counts.segment_intersections, bare.counts.segment_intersections, 20,
                 SIZE_MAX / (covered.counts.segment_intersections + 1));
}

static void test_fat(void **state)
{
    for (size_t n = 16; n <= 512; n *= 2) {
        const growth grid = grow("fat-grid", n, n, 1), cover = grow("fat-cover", n, n, 1);
        assert_true(8 * grid.out.vertices >= grid.m * grid.n && grid.out.vertices <= grid.m * grid.n);
        assert_true(cover.out.vertices <= 2 * (cover.m + cover.n));
        assert_int_equal(cover.out.polygons, 1);
    }
}

/* Every room gives a hole, every passage a segment, also the one with a dead end. */
static void test_tight(void **state)
{
    for (size_t m = 8; m <= 264; m = 2 * m - 4)
        for (unsigned seed = 1; seed <= 8; seed++) {
            const growth g = grow("tight", m, 8 + 5 * (seed - 1), seed);
            const size_t rooms = m < 24 ? 1 : m / 8 - 1;
            assert_int_equal(g.out.polygons, 1);
            assert_int_equal(g.out.holes, rooms);
            assert_int_equal(g.out.degenerate_segments, rooms + 1);
            assert_int_equal(g.out.degenerate_points, 0);
        }
}

/* The inputs in tests/golden equal the generator's output, byte for byte. */
static void test_committed(void **state)
{
    static const char *const kept[][2] = {{"fork", "fork --size 16"},
                                          {"comb-swapped", "comb --size 12 --swap --seed 2"},
                                          {"tight-rooms", "tight --size 40 --size-q 8 --seed 3"},
                                          {"slanted-fork", "slanted-fork --size 20"},
                                          {"covered-fork-map", "covered-fork --size 16 --coordinates map"},
                                          {"convex", "convex --size 16"},
                                          {"star-map", "star --size 10 --coordinates map"},
                                          {"random-map", "random --size 10 --coordinates map"},
                                          {"robot", "robot --size 16"},
                                          {"fat-grid", "fat-grid --size 16"},
                                          {"fat-cover", "fat-cover --size 16"},
                                          {"tight-map", "tight --size 10 --coordinates map"}};
    const char *source = getenv("SUNDER_SOURCE");
    for (size_t i = 0; i < sizeof kept / sizeof *kept; i++) {
        char *path = test_format("%s/tests/golden/family-%s.wkt", source ? source : SUNDER_SOURCE, kept[i][0]);
        char *want = test_read_file(path), *got = generated_text(kept[i][1], NULL);
        assert_non_null(want);
        assert_string_equal(got, want);
        free(path);
        free(want);
        free(got);
    }
}

/* For a wrong family, size or seed the status is 2, and nothing is written to standard output. */
static void test_refused(void **state)
{
    static const char *const wrong[] = {
        "",           "spoon",          "fork --size",           "fork --size 7",
        "fork comb",  "fork --size -9", "fork --size 1e3",       "fork --seed x",
        "fork --map", "fork --size ''", "fork --coordinates km", "fork --size 99999999999999999999"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        int status;
        char *text = generated_text(wrong[i], &status);
        assert_int_equal(status, 2);
        assert_string_equal(text, "");
        free(text);
    }
}

int main(void)
{
    if (!generated_available()) return SKIPPED;
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_convex),    cmocka_unit_test(test_comb),
                                       cmocka_unit_test(test_fork),      cmocka_unit_test(test_covered_fork),
                                       cmocka_unit_test(test_fat),       cmocka_unit_test(test_tight),
                                       cmocka_unit_test(test_committed), cmocka_unit_test(test_refused)};
    return cmocka_run_group_tests_name("growth", tests, NULL, NULL);
}
