/* Layers of members that overlap and touch, grown by a convex shape: sides inside a single subsum are dropped before
 * anything else then. Against the oracle byte for byte, and against the same sum on big integers, where none is
 * dropped. */
#include "convex/subsums.h"
#include "generate.h"
#include "minkowski/minkowski.h"
#include "oracle.h"
#include "outline/contained_sides.h"
#include "sum_text.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void random_member(polyset *p, rng *r, bool map)
{
    cells board;
    polyset one;
    polyset_init(&one);
    switch (rng_int(r, 0, map ? 1 : 4)) {
    case 0:
    case 1:
        if (map)
            random_building(&one, r);
        else
            polyset_rectangle(&one, 0, 0, (double)rng_int(r, 1, 9), (double)rng_int(r, 1, 9));
        break;
    case 2: random_simple(&one, r, (int)rng_int(r, 3, 7), 10); break;
    case 3: random_star(&one, r, (int)rng_int(r, 4, 8), 9); break;
    default:
        random_cells(&board, r, 3, 3, SPACING_SMALL, rng_once_in(r, 2), 70);
        cells_outline(&one, &board, false, true);
    }
    if (!map) polyset_move(&one, (double)rng_int(r, 0, 24), (double)rng_int(r, 0, 24));
    polyset_append(p, &one);
    polyset_free(&one);
}

static void random_layer(polyset *p, polyset *q, rng *r, bool map, int most)
{
    const int n = (int)rng_int(r, 2, most);
    polyset_init(p);
    polyset_init(q);
    for (int i = 0; i < n; i++) random_member(p, r, map);
    if (rng_once_in(r, 2))
        random_convex(q, r, (int)rng_int(r, 3, 10), rng_once_in(r, 2) ? 4 : 9);
    else
        polyset_rectangle(q, -2, -1, (double)rng_int(r, 1, 6), (double)rng_int(r, 1, 6));
}

static bool same_texts(const polyset *p, const polyset *q, bool with_oracle)
{
    char *ours = library_sum_text(p, q);
    char *other = with_oracle ? oracle_sum_text(p, q, false) : library_sum_text_wide(p, q);
    const bool same = ours && other && strcmp(ours, other) == 0;
    if (!same) {
        char *x = polyset_wkt(p), *y = polyset_wkt(q);
        print_message("%s\n%s\n  ours  %.2000s\n  other %.2000s\n", x, y, ours ? ours : "failed",
                      other ? other : "failed");
        free(x);
        free(y);
    }
    free(ours);
    free(other);
    return same;
}

static void test_layers(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(150);
    size_t bad = 0;
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
    for (size_t i = 0; i < n && bad < 2; i++) {
        rng r = rng_start(seed * 31, i);
        polyset p, q;
        const bool small = i % 3 != 0;
        random_layer(&p, &q, &r, i % 4 == 1, small ? 4 : 30);
        if (!same_texts(&p, &q, small)) {
            print_message("SUNDER_SEED=%llu, case %zu\n", (unsigned long long)seed, i);
            bad++;
        }
        polyset_free(&p);
        polyset_free(&q);
    }
    assert_int_equal(bad, 0);
}

/* How many candidates there are before and after. */
static void count_candidates(const polyset *p, const polyset *q, size_t count[2])
{
    sunder_shape *a = polyset_shape(p), *b = polyset_shape(q);
    sunder_i_placed placed;
    sunder_i_convex_pieces s;
    sunder_i_directions directions;
    const sunder_i_place_options how = {0};
    assert_int_equal(sunder_i_place(a, b, &how, &placed, NULL), SUNDER_OK);
    assert_true(placed.lattice.narrow);
    assert_int_equal(sunder_i_subsums_build(&placed.lattice, a, placed.p, b, placed.q, &directions, &s, NULL),
                     SUNDER_OK);
    for (int pass = 0; pass < 2; pass++) {
        if (pass) assert_int_equal(sunder_i_drop_contained_sides(&s, NULL), SUNDER_OK);
        count[pass] = 0;
        for (size_t k = 0; k < s.corners; k++) count[pass] += s.candidate[k];
    }
    sunder_i_convex_pieces_free(&s);
    sunder_i_directions_free(&directions);
    sunder_i_placed_free(&placed);
    sunder_shape_free(a);
    sunder_shape_free(b);
}

/* A row of squares: each one's sides towards its neighbours are inside these, all but the first and the last; sides
 * that only touch a neighbour's are not. */
static void test_row(void **state)
{
    (void)state;
    for (int step = 2; step <= 6; step++) {
        polyset p, q;
        size_t count[2];
        polyset_init(&p);
        polyset_init(&q);
        for (int i = 0; i < 40; i++) polyset_rectangle(&p, step * i, 0.25 * (i % 2), step * i + 2, 0.25 * (i % 2) + 2);
        polyset_rectangle(&q, -2, -2, 2, 2); /* sums are 6 wide */
        count_candidates(&p, &q, count);
        assert_int_equal(count[0], 160);
        /* The upright sides reach a quarter out of the neighbours, and end on the outline of the next but one. */
        assert_int_equal(count[1], 160);
        polyset_free(&p);
        polyset_init(&p);
        for (int i = 0; i < 40; i++) polyset_rectangle(&p, step * i, i % 2, step * i + 2, 4 - i % 2);
        count_candidates(&p, &q, count);
        assert_int_equal(count[0], 160);
        /* The low ones' upright sides lie in the high ones, where these overlap by more than a touch. */
        assert_int_equal(count[1], step < 6 ? 160 - 40 + 1 : 160);
        polyset_free(&p);
        polyset_free(&q);
    }
}

static void test_memory(void **state)
{
    (void)state;
    polyset operand[2];
    polyset_init(&operand[0]);
    polyset_init(&operand[1]);
    for (int i = 0; i < 6; i++) polyset_rectangle(&operand[0], 2 * i, i % 2, 2 * i + 2, 4 - i % 2);
    polyset_rectangle(&operand[1], -2, -2, 2, 2);
    assert_true(library_sum_survives(operand));
    polyset_free(&operand[0]);
    polyset_free(&operand[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_row), cmocka_unit_test(test_layers),
                                       cmocka_unit_test(test_memory)};
    return cmocka_run_group_tests_name("sides inside one subsum", tests, NULL, NULL);
}
