/* The checker of canonical sums: a sum with polygons, holes, segments and points is canonical, and is no longer after
 * any two of them are swapped. */
#include "generate.h"
#include "minkowski/minkowski.h"
#include "sum/canonical_sum.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

/* Two frames, each with two holes that shrink; the first also has two that become segments and two that become
 * points. */
static const char frames[] =
    "MULTIPOLYGON (((0 0, 100 0, 100 100, 0 100), (10 10, 10 20, 20 20, 20 10), (10 40, 10 50, 20 50, 20 40),"
    " (40 10, 40 15, 42 15, 42 10), (40 40, 40 45, 42 45, 42 40), (70 10, 70 12, 72 12, 72 10),"
    " (70 40, 70 42, 72 42, 72 40)), ((200 0, 300 0, 300 100, 200 100), (210 10, 210 20, 220 20, 220 10),"
    " (210 40, 210 50, 220 50, 220 40)))";

static sunder_shape *shape_of(const char *wkt)
{
    sunder_shape *shape = polyset_shape_of_wkt(wkt);
    assert_non_null(shape);
    return shape;
}

static sunder_sum *make_sum(void)
{
    sunder_shape *p = shape_of(frames), *q = shape_of("POLYGON ((0 0, 2 0, 2 2, 0 2))");
    sunder_sum *sum;
    assert_int_equal(sunder_i_minkowski_sum(p, q, false, NULL, &sum, NULL), SUNDER_OK);
    sunder_shape_free(p);
    sunder_shape_free(q);
    assert_int_equal(sum->polygons, 2);
    assert_int_equal(sum->rings, 6);
    assert_int_equal(sum->segments, 2);
    assert_int_equal(sum->points, 2);
    return sum;
}

/* All rings here have four vertices. */
static void swap_rings(sunder_sum *sum, size_t r, size_t s)
{
    for (size_t i = 0; i < 4; i++) {
        const uint32_t kept = sum->ring_vertex[4 * r + i];
        sum->ring_vertex[4 * r + i] = sum->ring_vertex[4 * s + i];
        sum->ring_vertex[4 * s + i] = kept;
    }
}

static void swap(uint32_t *a, uint32_t *b)
{
    const uint32_t kept = *a;
    *a = *b;
    *b = kept;
}

static void test_what_is_made_is_canonical(void **state)
{
    (void)state;
    sunder_sum *sum = make_sum();
    const sunder_counts before = sum->lattice.counts;
    assert_null(sunder_i_canonical_check(sum));
    assert_memory_equal(&before, &sum->lattice.counts, sizeof before);
    sunder_sum_free(sum);
}

static void test_what_is_out_of_order_is_not(void **state)
{
    (void)state;
    sunder_sum *sum = make_sum();
    swap_rings(sum, 1, 2);
    assert_string_equal(sunder_i_canonical_check(sum), "holes are out of order");
    swap_rings(sum, 1, 2);
    swap_rings(sum, 0, 3);
    assert_string_equal(sunder_i_canonical_check(sum), "polygons are out of order");
    swap_rings(sum, 0, 3);
    swap(&sum->ring_vertex[4], &sum->ring_vertex[5]);
    assert_string_equal(sunder_i_canonical_check(sum), "a ring starts at no smallest vertex");
    swap(&sum->ring_vertex[4], &sum->ring_vertex[5]);
    swap(&sum->segment[2], &sum->segment[3]);
    assert_string_equal(sunder_i_canonical_check(sum), "a segment does not rise");
    swap(&sum->segment[2], &sum->segment[3]);
    for (int k = 0; k < 2; k++) swap(&sum->segment[k], &sum->segment[2 + k]);
    assert_string_equal(sunder_i_canonical_check(sum), "segments are out of order");
    for (int k = 0; k < 2; k++) swap(&sum->segment[k], &sum->segment[2 + k]);
    swap(&sum->point[0], &sum->point[1]);
    assert_string_equal(sunder_i_canonical_check(sum), "points are out of order");
    swap(&sum->point[0], &sum->point[1]);
    assert_null(sunder_i_canonical_check(sum));
    sunder_sum_free(sum);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_is_made_is_canonical),
        cmocka_unit_test(test_what_is_out_of_order_is_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
