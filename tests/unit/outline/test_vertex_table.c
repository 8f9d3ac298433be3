/* outline/vertex_table.h: every point gets the number of its place for any representation of its integers, even if
 * points are so close that doubles cannot distinguish them; finding it takes a few comparisons in either case. */
#include "failing.h"
#include "outline/vertex_table.h"
#include "random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define SIDE 60 /* places form a grid of columns and rows */
#define FAR ((int64_t)1 << 57)

static void open_lattice(sunder_i_lattice *l, bool wide)
{
    double origin[1][2];
    const double corner[] = {-0x1p57, -0x1p57, 1, 3};
    sunder_i_extent e = {0};
    sunder_i_extent_add(&e, corner, 2);
    sunder_i_lattice_init(l, &e, 1, false, origin, wide);
    assert_true(l->narrow != wide);
}

/* Place i of the grid: thirds of `step` lattice units near a far corner, multiplied by a random common factor. */
static sunder_i_hpoint point(sunder_i_lattice *l, rng *r, int i, int64_t step)
{
    sunder_i_arena *arena = &l->arena;
    const int64_t k = rng_int(r, 1, 1000);
    const sunder_i_big x = sunder_i_big_i128(arena, (sunder_i_i128)(3 * FAR + i % SIDE * step) * k);
    const sunder_i_big y = sunder_i_big_i128(arena, (sunder_i_i128)(i / SIDE * step - 3 * FAR) * k);
    return sunder_i_hpoint_make(l, (sunder_i_rational_point){x, y, sunder_i_big_i64(arena, 3 * k)});
}

/* Adds all places in a random order, then all again; returns the number of comparisons. */
static uint64_t add_twice(bool wide, int64_t step, size_t expected)
{
    sunder_i_lattice l;
    sunder_i_vertex_table places;
    uint32_t number[SIDE * SIDE];
    rng r = rng_start(test_seed(), (uint64_t)step);
    open_lattice(&l, wide);
    assert_true(sunder_i_vertex_table_init(&places, &l, 0x1p58 / (wide ? 1 << l.approx_shift : 1), expected, 0));
    memset(number, 0xff, sizeof number);
    for (int i = 0; i < 3 * SIDE * SIDE; i++) {
        const int place = i < SIDE * SIDE ? (int)rng_int(&r, 0, SIDE * SIDE - 1) : i % (SIDE * SIDE);
        const sunder_i_hpoint p = point(&l, &r, place, step);
        const size_t before = places.n;
        const uint32_t got = sunder_i_vertex_table_add(&places, &p, NULL, false);
        if (number[place] == UINT32_MAX) {
            assert_int_equal(got, before);
            assert_int_equal(places.n, before + 1);
            number[place] = got;
        }
        assert_int_equal(got, number[place]);
    }
    assert_int_equal(places.n, SIDE * SIDE);
    sunder_i_vertex_table_free(&places);
    assert_false(l.arena.failed);
    sunder_i_lattice_free(&l);
    return l.counts.comparisons;
}

/* Places far apart, within one cell of the grid, and closer than neighbouring doubles. */
static void test_places(void **state)
{
    (void)state;
    const int64_t steps[] = {(int64_t)1 << 50, (int64_t)1 << 20, 1 << 10, 16, 1};
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)test_seed());
    for (int wide = 0; wide < 2; wide++)
        for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
            for (size_t expected = 0; expected <= SIDE * SIDE; expected += SIDE * SIDE) {
                /* Until the table detects the crowd, each new place is compared with all others: some 128^2 / 2
                 * comparisons. */
                const uint64_t comparisons = add_twice(wide, steps[i], expected);
                assert_true(comparisons < 3 * 3 * SIDE * SIDE + 4 * 128 * 128);
            }
}

static uint32_t find(const sunder_i_vertex_table *t, const sunder_i_hpoint *p, uint32_t line, uint32_t first,
                     uint32_t second)
{
    const sunder_i_vertex_lines lines = {line, {first, second}, 2};
    bool is_new;
    const uint32_t found = sunder_i_vertex_table_find(t, p->ax, p->ay, &lines, &is_new);
    assert_false(is_new); /* every requested vertex exists */
    return found;
}

/* A place is found by the two lines with which it was first found, from either of them, whatever its doubles are; by
 * other lines it is not. Columns are lines 0 .. SIDE - 1, rows those above. */
static void test_lines(void **state)
{
    (void)state;
    const uint32_t none = 3 * SIDE;
    sunder_i_lattice l;
    sunder_i_vertex_table places;
    rng r = rng_start(test_seed(), 8);
    open_lattice(&l, false);
    assert_true(sunder_i_vertex_table_init(&places, &l, 0x1p58, 0, 0)); /* it grows, and keeps its entries */
    for (int i = 0; i < SIDE * SIDE; i++) {
        const sunder_i_hpoint p = point(&l, &r, i, (int64_t)1 << 50);
        const sunder_i_vertex_lines lines = {(uint32_t)(i % SIDE), {SIDE + (uint32_t)(i / SIDE), 0}, i % 7 ? 1 : 0};
        bool is_new;
        assert_int_equal(sunder_i_vertex_table_find(&places, p.ax, p.ay, &lines, &is_new), SUNDER_I_NO_VERTEX);
        assert_true(is_new);
        assert_int_equal(sunder_i_vertex_table_add(&places, &p, &lines, i % 2), i);
    }
    for (int i = 0; i < SIDE * SIDE; i++) {
        const sunder_i_hpoint p = point(&l, &r, i, (int64_t)1 << 50);
        const uint32_t column = (uint32_t)(i % SIDE), row = SIDE + (uint32_t)(i / SIDE);
        const uint32_t want = i % 7 ? (uint32_t)i : SUNDER_I_NO_VERTEX;
        assert_int_equal(find(&places, &p, column, none, row), want);
        assert_int_equal(find(&places, &p, row, column, none), want);
        assert_int_equal(find(&places, &p, column, none, row + 1), SUNDER_I_NO_VERTEX);
        assert_int_equal(find(&places, &p, none, column, row), SUNDER_I_NO_VERTEX);
    }
    sunder_i_vertex_table_free(&places);
    sunder_i_lattice_free(&l);
}

/* Points of equal value have equal hashes; different points almost never do. */
static void test_hash(void **state)
{
    (void)state;
    for (int wide = 0; wide < 2; wide++) {
        sunder_i_lattice l;
        rng r = rng_start(test_seed(), 7);
        open_lattice(&l, wide);
        for (int i = 0; i < 1000; i++) {
            const int j = (int)rng_int(&r, 0, SIDE * SIDE - 1);
            const sunder_i_hpoint a = point(&l, &r, i, 1), b = point(&l, &r, i, 1), c = point(&l, &r, j, 1);
            assert_true(sunder_i_hpoint_hash(&l, &a) == sunder_i_hpoint_hash(&l, &b));
            assert_true((i == j) == (sunder_i_hpoint_hash(&l, &a) == sunder_i_hpoint_hash(&l, &c)));
        }
        sunder_i_lattice_free(&l);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_places), cmocka_unit_test(test_lines),
                                       cmocka_unit_test(test_hash)};
    return cmocka_run_group_tests_name("places", tests, NULL, NULL);
}
