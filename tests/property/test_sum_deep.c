/* Layers of members that overlap deeply, such as rings of equal travel time around one place, or overlapping service
 * areas. Most of their sides are inside other members, and the outline is small. No cell of a grid separates them until
 * it is as small as their distances. The sum by the convolution equals that of another algorithm, and its memory grows
 * linearly: the memory for a layer four times as long is compared, which, unlike time, does not vary. */
#include "generate.h"
#include "roads.h"
#include "sum_text.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef enum deep_kind {
    DEEP_SQUARES, /* nested squares */
    DEEP_RINGS,   /* circles about one centre, their corners on the same rays */
    DEEP_STAIRS,  /* squares, each shifted slightly along the diagonal */
    DEEP_TURNED,  /* squares about one centre, each rotated slightly */
    DEEP_JITTER,  /* one circle, with slightly different corners each time */
    DEEP_DISCS,   /* circles that overlap to a great extent */
    DEEP_KINDS
} deep_kind;

static const char *const kind_name[] = {"squares", "rings", "stairs", "turned", "jitter", "discs"};

static double thousandth(double v) { return round(1000 * v) / 1000; }

static void circle(polyset *set, double x, double y, double radius, double turn, int corners, rng *r, double jitter)
{
    for (int i = 0; i < corners; i++) {
        const double angle = turn + 2 * 3.14159265358979323846 * i / corners;
        polyset_vertex(set, thousandth(x + radius * cos(angle) + jitter * (rng_unit(r) - 0.5)),
                       thousandth(y + radius * sin(angle) + jitter * (rng_unit(r) - 0.5)));
    }
    polyset_end_ring(set);
    polyset_end_polygon(set);
}

static void add_member(polyset *set, deep_kind kind, int i, int n, rng *r)
{
    const double reach = 4 * n; /* the distance of members does not depend on their number */
    switch (kind) {
    case DEEP_SQUARES: polyset_rectangle(set, i, i, 2 * reach - i, 2 * reach - i); break;
    case DEEP_RINGS: circle(set, 0, 0, reach - i, 0.1, 16, r, 0); break;
    case DEEP_STAIRS: polyset_rectangle(set, i, i, i + reach, i + reach); break;
    case DEEP_TURNED: circle(set, 0, 0, reach, 1.5 * i / n, 4, r, 0); break;
    case DEEP_JITTER: circle(set, 0, 0, reach, 0, 16, r, 2); break;
    default: circle(set, reach * rng_unit(r), reach * rng_unit(r), reach * (0.4 + 0.2 * rng_unit(r)), 0, 16, r, 0);
    }
}

/* The members in random order, in ascending or in descending order. */
static void deep_layer(polyset *set, deep_kind kind, int n, rng *r)
{
    polyset_init(set);
    const int order = (int)rng_int(r, 0, 2), step = n % 7 ? 7 : 11;
    for (int i = 0; i < n; i++) add_member(set, kind, order == 0 ? i : order == 1 ? n - 1 - i : i * step % n, n, r);
}

static void random_grower(polyset *set, rng *r)
{
    polyset_init(set);
    if (rng_once_in(r, 2))
        random_convex(set, r, (int)rng_int(r, 3, 9), 3);
    else
        polyset_rectangle(set, -1, -1, 1, 1);
}

static void test_other_roads(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(12);
    size_t bad = 0;
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
    for (size_t i = 0; i < n && bad < 2; i++) {
        rng r = rng_start(seed * 37, i);
        polyset p, q;
        deep_layer(&p, (deep_kind)(i % DEEP_KINDS), (int)rng_int(&r, 8, i % 4 ? 40 : 90), &r);
        random_grower(&q, &r);
        char *ours = library_sum_text(&p, &q);
        const sunder_sum_options how = {.size = sizeof how,
                                        .algorithm = SUNDER_ALGORITHM_INCREMENTAL,
                                        .decomposition = SUNDER_DECOMPOSITION_VERTICAL,
                                        .order = SUNDER_ORDER_FAT,
                                        .seed = seed};
        assert_non_null(ours);
        if (!road_agrees(&p, &q, &how, false, ours, true)) {
            print_message("SUNDER_SEED=%llu, case %zu, %s\n", (unsigned long long)seed, i, kind_name[i % DEEP_KINDS]);
            bad++;
        }
        free(ours);
        polyset_free(&p);
        polyset_free(&q);
    }
    assert_int_equal(bad, 0);
}

/* ---- Memory ----------- */

static size_t held, most_held;

typedef union block {
    size_t size;
    max_align_t align;
} block;

static void note(size_t more, size_t less)
{
    held += more - less;
    if (held > most_held) most_held = held;
}

static void *counted(size_t size)
{
    block *b = malloc(sizeof *b + size);
    if (!b) return NULL;
    b->size = size;
    note(size, 0);
    return b + 1;
}

static void *counted_again(void *old, size_t size)
{
    if (!old) return counted(size);
    block *b = (block *)old - 1;
    const size_t before = b->size;
    b = realloc(b, sizeof *b + size);
    if (!b) return NULL;
    b->size = size;
    note(size, before);
    return b + 1;
}

static void uncounted(void *memory)
{
    if (!memory) return;
    block *b = (block *)memory - 1;
    held -= b->size;
    free(b);
}

typedef enum use { USE_SUM, USE_UNION, USE_ROUTE, USES } use;

static const char *const use_name[] = {"sum", "union", "route"};

static void use_it(use how, const sunder_shape *p, const sunder_shape *q)
{
    sunder_sum *sum = NULL;
    if (how != USE_ROUTE) {
        assert_int_equal(how == USE_SUM ? sunder_minkowski_sum(p, q, NULL, &sum, NULL)
                                        : sunder_shape_union(p, NULL, &sum, NULL),
                         SUNDER_OK);
        sunder_sum_free(sum);
        return;
    }
    const sunder_obstacle obstacle = {p, NULL, NULL, 0};
    /* a path past all members */
    const sunder_place from = {{-1e5, -1e5}, {NULL, NULL}}, to = {{-1e5, 1e5}, {NULL, NULL}};
    sunder_route *route = NULL;
    assert_int_equal(sunder_route_find(&obstacle, 1, q, &from, &to, NULL, &route, NULL), SUNDER_OK);
    assert_int_equal(sunder_route_reason(route, NULL), SUNDER_ROUTE_FOUND);
    sunder_route_free(route);
}

/* The peak memory; sides are long compared with the shape by which they are dilated. */
static size_t memory_for(deep_kind kind, use how, int n, uint64_t seed)
{
    rng r = rng_start(seed * 41, (uint64_t)kind);
    polyset p, q;
    deep_layer(&p, kind, n, &r);
    polyset_init(&q);
    polyset_rectangle(&q, -0.25, -0.25, 0.25, 0.25);
    sunder_set_allocator(counted, counted_again, uncounted);
    sunder_shape *a = polyset_shape(&p), *b = polyset_shape(&q);
    assert_non_null(a);
    assert_non_null(b);
    most_held = held;
    const size_t before = held;
    use_it(how, a, b);
    const size_t most = most_held - before;
    sunder_shape_free(a);
    sunder_shape_free(b);
    assert_int_equal(held, 0);
    sunder_set_allocator(NULL, NULL, NULL);
    polyset_free(&p);
    polyset_free(&q);
    return most;
}

/* Memory for four times the members: linear growth gives a factor of 4, all pairs of members would give 16. Tables
 * double in size, which adds a factor of up to 2 between two sizes. The union of rotated squares without dilation is
 * left out: near their corners, which are all on one circle, each side is covered only by many others together, and
 * their number grows with the layer. */
static void test_memory(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    size_t bad = 0;
    for (int kind = 0; kind < DEEP_KINDS; kind++)
        for (int how = 0; how < USES; how++) {
            if (kind == DEEP_TURNED && how == USE_UNION) continue;
            const size_t small = memory_for((deep_kind)kind, (use)how, 150, seed);
            const size_t large = memory_for((deep_kind)kind, (use)how, 600, seed);
            print_message("%-8s %-6s %8zu bytes a member of 150, %8zu of 600\n", kind_name[kind], use_name[how],
                          small / 150, large / 600);
            bad += large > 8 * small;
        }
    assert_int_equal(bad, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_other_roads), cmocka_unit_test(test_memory)};
    return cmocka_run_group_tests_name("members deep in each other", tests, NULL, NULL);
}
