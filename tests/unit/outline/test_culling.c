/* Sums of members that are tiny compared with their distances: clusters that doubles cannot distinguish from points.
 * Splitting such a cluster further in doubles does not separate its members, and memory must not be spent on it. */
#include "roads.h"
#include "sum_text.h"

#include <malloc.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* 256 times the memory that these sums need; an earlier version took gigabytes. */
#define ALLOWED ((size_t)64 << 20)

static size_t held;

static void *limited_realloc(void *old, size_t n)
{
    const size_t before = old ? malloc_usable_size(old) : 0;
    if (held - before + n > ALLOWED) return NULL;
    void *p = realloc(old, n);
    if (p) held += malloc_usable_size(p) - before;
    return p;
}

static void *limited_malloc(size_t n) { return limited_realloc(NULL, n); }

static void limited_free(void *p)
{
    if (p) held -= malloc_usable_size(p);
    free(p);
}

/* Rectangles and triangles with sides of a few units (a unit is 2^-30 / n), in clusters from the origin to 10^7. */
static void make_clusters(polyset *set, unsigned members)
{
    static const double places[] = {0, 1e5, 3e6, 1e7};
    polyset_init(set);
    for (unsigned i = 0; i < members; i++) {
        const double x = places[i % 4], u = 0x1p-28;
        const double dx = (i * 5 % 9) * u, dy = (i * 7 % 8) * u, w = (1 + i % 3) * u, h = (1 + i % 4) * u;
        const double corner[] = {x + dx, x + dy, x + dx + w, x + dy, x + dx + w, x + dy + h, x + dx, x + dy + h};
        polyset_polygon(set, corner, i % 3 ? 4 : 3);
    }
}

static void test_clusters(void **state)
{
    (void)state;
    polyset p, q;
    make_clusters(&p, 24);
    polyset_init(&q);
    const double s = 0x1p-31,
                 seven[] = {3 * s, 0, 2 * s, 2 * s, 0, 3 * s, -3 * s, s, -3 * s, -s, -s, -3 * s, 2 * s, -2 * s};
    polyset_polygon(&q, seven, 7);
    sunder_set_allocator(limited_malloc, limited_realloc, limited_free);
    char *sum = library_sum_text(&p, &q);
    assert_non_null(sum);
    assert_int_equal(held, 0);
    sunder_set_allocator(NULL, NULL, NULL);
    for (size_t road = 0; road < ROAD_ALGORITHMS; road++) {
        const sunder_sum_options other = road_options(road, 1);
        assert_true(road_agrees(&p, &q, &other, false, sum, true));
    }
    free(sum);
    polyset_free(&p);
    polyset_free(&q);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_clusters)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
