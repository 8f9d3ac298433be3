/* Sums of sets with axis-parallel sides, united as rectangles: the same, byte for byte, as by algorithms that do not
 * treat rectangles specially, including holes, exact fits and rings that touch. */
#include "generate.h"
#include "minkowski/minkowski.h"
#include "rectilinear/rectangles.h"
#include "rectilinear/rectilinear_sum.h"
#include "roads.h"
#include "sum/operands_on_lattice.h"
#include "sum_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* The sum if it is computed by rectangles; NULL if it is not. */
static char *text_by_rectangles(const polyset *p, const polyset *q)
{
    sunder_shape *a = polyset_shape(p), *b = polyset_shape(q);
    sunder_sum *sum = sunder_i_calloc(1, sizeof *sum);
    sunder_i_placed at;
    bool done;
    assert_true(a && b && sum);
    assert_int_equal(sunder_i_sum_place(sum, a, b, false, &at, NULL), SUNDER_OK);
    assert_int_equal(sunder_i_rectilinear_sum(sum, a, at.p, b, at.q, &done, NULL), SUNDER_OK);
    char *text = done ? sum_text(sum) : NULL;
    sunder_i_placed_free(&at);
    sunder_sum_free(sum);
    sunder_shape_free(a);
    sunder_shape_free(b);
    return text;
}

static bool agrees(const polyset *p, const polyset *q, sunder_algorithm algorithm)
{
    const sunder_sum_options how = {
        .size = sizeof how, .algorithm = algorithm, .decomposition = SUNDER_DECOMPOSITION_HERTEL_MEHLHORN};
    char *got = text_by_rectangles(p, q);
    assert_non_null(got);
    const bool same = road_agrees(p, q, &how, false, got, true);
    free(got);
    return same;
}

/* Some squares of a board, half of the time with straight vertices, or with rings that touch themselves. */
static void draw(polyset *set, rng *r, spacing kind)
{
    cells c;
    random_cells(&c, r, (int)rng_int(r, 1, CELLS_MAX), (int)rng_int(r, 1, CELLS_MAX), kind, false,
                 (int)rng_int(r, 20, 95));
    c.on[0][0][1] = c.on[0][0][0]; /* half a square if none is set */
    polyset_init(set);
    cells_outline(set, &c, rng_once_in(r, 2), rng_once_in(r, 2));
}

/* A board with a pocket that the other one, turned by half a turn, fits into. */
static void draw_pocket(polyset *p, polyset *q, rng *r)
{
    cells board, peg;
    random_cells(&peg, r, 3, 3, SPACING_UNIT, false, 70);
    peg.on[0][0][1] = peg.on[0][0][0];
    pocket_for(&board, r, &peg, (int)rng_int(r, 0, 2));
    polyset_init(p);
    polyset_init(q);
    cells_outline(p, &board, false, true);
    cells_outline(q, &peg, false, true);
}

static void test_boards(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(600);
    size_t bad = 0;
    for (size_t i = 0; i < n && bad < 2; i++) {
        rng r = rng_start(seed * 23, i);
        const spacing kind = (spacing)(i % SPACING_HUGE);
        polyset p, q;
        if (i % 7 == 0) {
            draw_pocket(&p, &q, &r);
        } else {
            draw(&p, &r, kind);
            draw(&q, &r, kind);
        }
        if (!agrees(&p, &q, i % 2 ? SUNDER_ALGORITHM_DIVIDE : SUNDER_ALGORITHM_ARRANGEMENT)) {
            print_message("SUNDER_SEED=%llu, case %zu\n", (unsigned long long)seed, i);
            bad++;
        }
        polyset_free(&p);
        polyset_free(&q);
    }
    assert_int_equal(bad, 0);
}

/* Bars that overlap, touch and coincide; so many that only the needed subsums are computed. */
static void draw_bars(polyset *set, rng *r, int n, int span)
{
    polyset_init(set);
    for (int i = 0; i < n; i++) {
        const int x = (int)rng_int(r, 0, span), y = (int)rng_int(r, 0, span);
        const int length = (int)rng_int(r, 1, span / 2), width = (int)rng_int(r, 1, 1 + span / 20);
        if (rng_once_in(r, 2))
            polyset_rectangle(set, x, y, x + length, y + width);
        else
            polyset_rectangle(set, x, y, x + width, y + length);
    }
}

static void test_bars(void **state)
{
    (void)state;
    const size_t n = test_count(16);
    for (size_t i = 0; i < n; i++) {
        rng r = rng_start(test_seed() * 29, i);
        const int span = i % 2 ? 40 : 1000;
        polyset p, q;
        draw_bars(&p, &r, 18, span);
        draw_bars(&q, &r, 18, span);
        assert_true(agrees(&p, &q, SUNDER_ALGORITHM_DIVIDE));
        polyset_free(&p);
        polyset_free(&q);
    }
}

/* The rectangles have disjoint interiors, and the area of the shape. */
static void test_cut(void **state)
{
    (void)state;
    const size_t n = test_count(300);
    for (size_t i = 0; i < n; i++) {
        rng r = rng_start(test_seed() * 31, i);
        const sunder_i_place_options how = {0};
        sunder_i_rectangle_list list;
        sunder_i_placed at;
        polyset p;
        int64_t area = 0, want = 0;
        draw(&p, &r, SPACING_SMALL);
        sunder_shape *shape = polyset_shape(&p);
        assert_int_equal(sunder_i_place(shape, shape, &how, &at, NULL), SUNDER_OK);
        assert_true(sunder_i_is_rectilinear(shape, at.p));
        assert_true(sunder_i_rectangles_cut(shape, at.p, &list));
        for (size_t k = 0; k < list.n; k++) {
            const sunder_i_rectangle *a = &list.item[k];
            assert_true(a->low[0] < a->high[0] && a->low[1] < a->high[1]);
            area += 2 * (a->high[0] - a->low[0]) * (a->high[1] - a->low[1]);
            for (size_t m = 0; m < k; m++) {
                const sunder_i_rectangle *b = &list.item[m];
                assert_true(a->low[0] >= b->high[0] || b->low[0] >= a->high[0] || a->low[1] >= b->high[1] ||
                            b->low[1] >= a->high[1]);
            }
        }
        for (uint32_t v = 0; v < shape->vertices; v++) {
            const sunder_i_point a = at.p[v], b = at.p[shape->form->cleaned.next[v]];
            want += a.x * b.y - a.y * b.x;
        }
        assert_int_equal(area, want);
        sunder_i_free(list.item);
        sunder_i_placed_free(&at);
        sunder_shape_free(shape);
        polyset_free(&p);
    }
}

static size_t places_below(const sunder_i_rectangle_list *list, int axis, int64_t v)
{
    int64_t seen[64];
    size_t n = 0;
    for (size_t i = 0; i < 2 * list->n; i++) {
        const sunder_i_rectangle *r = &list->item[i / 2];
        const int64_t at = i % 2 ? r->high[axis] : r->low[axis];
        size_t k = 0;
        while (k < n && seen[k] != at) k++;
        if (k == n && at < v) seen[n++] = at;
    }
    return n;
}

/* The rank of a coordinate is the number of smaller ones; also for coordinates whose keys leave no bits for indices. */
static void test_rank(void **state)
{
    (void)state;
    const size_t n = test_count(300);
    for (size_t i = 0; i < n; i++) {
        rng r = rng_start(test_seed() * 37, i);
        const int64_t most = i % 3 == 0 ? ((int64_t)1 << 60) - 1 : i % 3 == 1 ? 5 : 100000;
        sunder_i_rectangle item[32];
        const sunder_i_rectangle_list list = {item, (size_t)rng_int(&r, 1, 32), 32};
        sunder_i_ranked_rectangles ranked;
        for (size_t k = 0; k < list.n; k++)
            for (int axis = 0; axis < 2; axis++) {
                const bool far = rng_once_in(&r, 4);
                item[k].low[axis] = far ? -most : rng_int(&r, -most, most - 1);
                item[k].high[axis] = far ? most : rng_int(&r, item[k].low[axis] + 1, most);
            }
        assert_true(sunder_i_rectangles_rank(&list, &ranked));
        assert_int_equal(ranked.n, list.n);
        for (int axis = 0; axis < 2; axis++) {
            assert_int_equal(ranked.places[axis], places_below(&list, axis, INT64_MAX));
            for (size_t k = 0; k < list.n; k++) {
                assert_int_equal(ranked.item[k].low[axis], places_below(&list, axis, item[k].low[axis]));
                assert_int_equal(ranked.item[k].high[axis], places_below(&list, axis, item[k].high[axis]));
                assert_true(ranked.at[axis][ranked.item[k].low[axis]] == item[k].low[axis]);
                assert_true(ranked.at[axis][ranked.item[k].high[axis]] == item[k].high[axis]);
            }
        }
        sunder_i_ranked_rectangles_free(&ranked);
    }
}

/* Operands with a slanted side, and operands on big integers, use another algorithm. */
static void test_not_for_all(void **state)
{
    (void)state;
    const double house[] = {0, 0, 8, 0, 8, 3, 3, 3, 3, 8, 0, 8}, slanted[] = {0, 0, 8, 0, 8, 3, 3, 3, 3, 8, 1, 8};
    const double far[] = {0, 0, 1e200, 0, 1e200, 3, 3, 3, 3, 8, 0, 8};
    polyset p, q, r;
    polyset_init(&p);
    polyset_init(&q);
    polyset_init(&r);
    polyset_polygon(&p, house, 6);
    polyset_polygon(&q, slanted, 6);
    polyset_polygon(&r, far, 6);
    char *text = text_by_rectangles(&p, &p);
    assert_non_null(text);
    assert_null(text_by_rectangles(&p, &q));
    assert_null(text_by_rectangles(&q, &p));
    assert_null(text_by_rectangles(&r, &p));
    free(text);
    polyset_free(&p);
    polyset_free(&q);
    polyset_free(&r);
}

/* Four bars around a point that none of them covers: it is a degenerate point, and not a vertex of a ring. */
static void test_pinwheel(void **state)
{
    (void)state;
    polyset p, q;
    polyset_init(&p);
    polyset_init(&q);
    polyset_rectangle(&p, 0, 0, 2, 1);
    polyset_rectangle(&p, 2, 0, 3, 2);
    polyset_rectangle(&p, 1, 2, 3, 3);
    polyset_rectangle(&p, 0, 1, 1, 3);
    polyset_rectangle(&q, 0, 0, 1, 1);
    assert_true(agrees(&p, &q, SUNDER_ALGORITHM_ARRANGEMENT));
    polyset_free(&p);
    polyset_free(&q);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_boards),      cmocka_unit_test(test_bars),
                                       cmocka_unit_test(test_cut),         cmocka_unit_test(test_rank),
                                       cmocka_unit_test(test_not_for_all), cmocka_unit_test(test_pinwheel)};
    return cmocka_run_group_tests_name("sum_rectilinear", tests, NULL, NULL);
}
