/* Sums of several polygons with one polygon. Polygons whose sums stay apart are traced one by one, small groups that
 * overlap are traced together, and the rest goes through the general algorithm. The result equals, byte for byte, that
 * of the general algorithm for all of them. */
#include "generate.h"
#include "minkowski/members.h"
#include "roads.h"
#include "sum/operands_on_lattice.h"
#include "sum_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef enum kind { CONVEX, STARS, MIXED, HOLES, TOUCHING, PATCHES, KINDS } kind;

/* A frame, in whose hole there may be others. */
static void frame(polyset *set, double x, double y, double half, double width)
{
    const double out[] = {x - half, y - half + 1, x + half, y - half, x + half - 1, y + half, x - half, y + half};
    const double in = half - width;
    const double hole[] = {x - in, y - in, x - in, y + in, x + in, y + in - 1, x + in, y - in};
    polyset_ring(set, out, 4);
    polyset_ring(set, hole, 4);
    polyset_end_polygon(set);
}

static void add_member(polyset *set, rng *r, kind k, double x, double y)
{
    polyset one;
    polyset_init(&one);
    switch (k == MIXED ? (kind)rng_int(r, CONVEX, STARS) : k) {
    case STARS: random_star(&one, r, (int)rng_int(r, 5, 12), 60); break;
    case HOLES:
        if (rng_once_in(r, 2)) {
            frame(&one, 0, 0, (double)rng_int(r, 60, 160), (double)rng_int(r, 5, 20));
            break;
        } /* fall through */
    default: random_convex(&one, r, (int)rng_int(r, 4, 9), (double)rng_int(r, 15, 60)); break;
    case TOUCHING: polyset_rectangle(&one, 0, 0, 40, (double)rng_int(r, 1, 2) * 20);
    }
    polyset_move(&one, x, y);
    polyset_append(set, &one);
    polyset_free(&one);
}

/* Half squares of a board, whose rings touch themselves and each other in vertices and on edges. */
static void draw_patches(polyset *set, rng *r)
{
    cells board;
    random_cells(&board, r, (int)rng_int(r, 2, 6), (int)rng_int(r, 2, 6), SPACING_SMALL, true, (int)rng_int(r, 30, 70));
    polyset_init(set);
    cells_outline(set, &board, rng_once_in(r, 2), true);
    polyset_scale(set, 30, 30);
}

static void draw_many(polyset *set, rng *r, kind k)
{
    if (k == PATCHES) {
        draw_patches(set, r);
        return;
    }
    const int n = (int)rng_int(r, 2, 14), room = (int)rng_int(r, 1, 6);
    polyset_init(set);
    for (int i = 0; i < n; i++) {
        double x = (double)rng_int(r, 0, 200 * room), y = (double)rng_int(r, 0, 200 * room);
        if (k == TOUCHING) x = 40 * (double)rng_int(r, 0, 9), y = 40 * i;
        add_member(set, r, k, x, y);
    }
}

static void draw_one(polyset *set, rng *r, bool convex)
{
    polyset_init(set);
    if (convex)
        random_convex(set, r, (int)rng_int(r, 3, 12), (double)rng_int(r, 5, 50));
    else
        random_star(set, r, (int)rng_int(r, 5, 14), (double)rng_int(r, 20, 90));
}

/* The number of members left for the general algorithm; all of them if none is traced. */
static size_t left_of(const polyset *many, const polyset *one)
{
    sunder_shape *a = polyset_shape(many), *b = polyset_shape(one);
    sunder_sum *sum = sunder_i_calloc(1, sizeof *sum);
    sunder_i_placed at;
    sunder_i_members_left left;
    assert_true(a && b && sum);
    assert_int_equal(sunder_i_sum_place(sum, a, b, false, &at, NULL), SUNDER_OK);
    assert_int_equal(sunder_i_members_sum(sum, a, at.p, b, at.q, &left, NULL), SUNDER_OK);
    if (left.n == many->polygons) assert_null(sum->vertex);
    for (size_t i = 0, n = 0; left.polygon && i < many->polygons; i++) {
        n += left.polygon[i];
        if (i + 1 == many->polygons) assert_int_equal(n, left.n);
    }
    sunder_i_free(left.polygon);
    sunder_i_placed_free(&at);
    sunder_sum_free(sum);
    sunder_shape_free(a);
    sunder_shape_free(b);
    return left.n;
}

static void test_members(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(400);
    size_t bad = 0, all = 0, some = 0;
    for (size_t i = 0; i < n && bad < 2; i++) {
        rng r = rng_start(seed * 37, i);
        const kind k = (kind)(i % KINDS);
        const sunder_sum_options how = {.size = sizeof how,
                                        .algorithm = SUNDER_ALGORITHM_DIVIDE,
                                        .decomposition = SUNDER_DECOMPOSITION_HERTEL_MEHLHORN};
        polyset many, one;
        draw_many(&many, &r, k);
        draw_one(&one, &r, k == CONVEX ? rng_once_in(&r, 2) : !rng_once_in(&r, 4));
        const size_t left = left_of(&many, &one);
        all += left == 0;
        some += left > 0 && left < many.polygons;
        char *want = i % 2 ? library_sum_text(&many, &one) : library_sum_text(&one, &many);
        assert_non_null(want);
        if (!road_agrees(&many, &one, &how, false, want, true)) {
            print_message("SUNDER_SEED=%llu, case %zu\n", (unsigned long long)seed, i);
            bad++;
        }
        free(want);
        polyset_free(&many);
        polyset_free(&one);
    }
    print_message("SUNDER_SEED=%llu: %zu sums, %zu traced, %zu traced in part\n", (unsigned long long)seed, n, all,
                  some);
    assert_int_equal(bad, 0);
    assert_true(all >= n / 5 && some >= n / 20);
}

/* Three frames, each in the hole of the one before, far enough apart that all holes stay: three components, each with
 * its own hole. */
static void test_nested(void **state)
{
    (void)state;
    polyset many, one;
    const double tile[] = {0, 0, 7, 1, 3, 8};
    polyset_init(&many);
    polyset_init(&one);
    frame(&many, 0, 0, 300, 20);
    frame(&many, 3, 5, 200, 20);
    frame(&many, -4, 2, 100, 20);
    polyset_polygon(&one, tile, 3);
    assert_int_equal(left_of(&many, &one), 0);
    const sunder_sum_options how = {.size = sizeof how,
                                    .algorithm = SUNDER_ALGORITHM_ARRANGEMENT,
                                    .decomposition = SUNDER_DECOMPOSITION_HERTEL_MEHLHORN};
    char *want = library_sum_text(&many, &one);
    assert_true(want && road_agrees(&many, &one, &how, false, want, true));
    free(want);
    polyset_free(&many);
    polyset_free(&one);
}

/* A courtyard that is closed by a tooth whose tip touches an edge from outside. */
static void test_shut_yard(void **state)
{
    (void)state;
    const double yard[] = {0, 0, 100, 0, 100, 41, 30, 40, 30, 80, 60, 81, 65, 40.5, 81, 80, 100, 81, 101, 120, -1, 120};
    const double away[] = {300, 0, 330, 1, 310, 30};
    const sunder_sum_options how = {.size = sizeof how,
                                    .algorithm = SUNDER_ALGORITHM_DIVIDE,
                                    .decomposition = SUNDER_DECOMPOSITION_HERTEL_MEHLHORN};
    size_t traced = 0;
    for (int i = 1; i <= 64; i++) {
        rng r = rng_start(test_seed() * 41, (uint64_t)i);
        polyset many, one;
        polyset_init(&many);
        polyset_init(&one);
        polyset_polygon(&many, yard, 11);
        polyset_polygon(&many, away, 3);
        random_convex(&one, &r, (int)rng_int(&r, 3, 9), i / 2.0 + 2);
        traced += left_of(&many, &one) == 0;
        char *want = library_sum_text(&many, &one);
        assert_true(want && road_agrees(&many, &one, &how, false, want, true));
        free(want);
        polyset_free(&many);
        polyset_free(&one);
    }
    assert_true(traced > 16);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_members), cmocka_unit_test(test_nested),
                                       cmocka_unit_test(test_shut_yard)};
    return cmocka_run_group_tests_name("sum_members", tests, NULL, NULL);
}
