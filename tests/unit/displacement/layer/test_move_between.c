/* The move between two places of a shape whose coordinates were rounded: triangles far from the origin and near to it,
 * on both sides of powers of two, moved by any double, by multiples of a unit in the last place, and by odd multiples
 * of half a unit, where sums are ties. A move is always found, and it rounds all vertices to their new places. It is
 * the drawn move if that is exact at all vertices; otherwise it is exact, or no longer than the drawn move. */
#include "random.h"

#include "displacement/layer/rounding.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

/* Draws a coordinate near a power of two, or anywhere below it. */
static double draw_coordinate(rng *g, int exponent)
{
    const double size = ldexp(1, exponent), sign = rng_once_in(g, 4) ? -1 : 1;
    if (rng_once_in(g, 3)) return sign * size * rng_unit(g);
    return sign * size + ldexp((double)rng_int(g, -64, 64), exponent - (int)rng_int(g, 40, 54));
}

/* Draws a coordinate whose sum with t is a tie, if there is one near a drawn place; otherwise any. */
static double draw_tie(rng *g, int exponent, double t)
{
    const double to = draw_coordinate(g, exponent), half = (nextafter(to, INFINITY) - to) / 2;
    const double near = to - t, x = near + half, sum = x + t;
    return sum - x == t && (sum == to || sum == to + 2 * half) ? x : draw_coordinate(g, exponent);
}

/* Draws a move of up to a few units in the last place of 2^exponent, or of any length. */
static double draw_move(rng *g, int exponent)
{
    const int finer = (int)rng_int(g, 51, 54);
    if (rng_once_in(g, 3)) return draw_coordinate(g, exponent - (int)rng_int(g, 0, 3));
    if (rng_once_in(g, 3)) return (rng_unit(g) - 0.5) * ldexp(1, exponent - (int)rng_int(g, 0, 60));
    return ldexp((double)rng_int(g, -200, 200), exponent - finer);
}

static sunder_shape *make_triangle(const double xy[6])
{
    const size_t ring_end[] = {3}, poly_end[] = {1};
    sunder_shape *shape = NULL;
    sunder_shape_from_rings(xy, ring_end, poly_end, 1, SUNDER_VALIDITY_STRICT, &shape, NULL);
    return shape; /* NULL if rounding left no area */
}

/* Are all sums with the move along axis c exact? */
static bool is_exact(const double before[6], double t, int c)
{
    bool exact = true;
    for (int k = c; k < 6; k += 2) {
        const double sum = before[k] + t, part = sum - before[k];
        exact = exact && (before[k] - (sum - part)) + (t - part) == 0;
    }
    return exact;
}

static void check_found(const double before[6], const double after[6], const double drawn[2], const double found[2])
{
    for (int k = 0; k < 6; k++) assert_true(before[k] + found[k & 1] == after[k]);
    for (int c = 0; c < 2; c++) {
        if (is_exact(before, drawn[c], c)) assert_true(found[c] == drawn[c]);
        assert_true(is_exact(before, found[c], c) || fabs(found[c]) <= fabs(drawn[c]));
    }
}

static void test_moves_are_found(void **state)
{
    size_t asked = 0;
    (void)state;
    for (size_t round = 0; round < test_count(20000); round++) {
        rng g = rng_start(test_seed(), round);
        const int exponent = (int)rng_int(&g, -3, 24);
        double before[6], after[6], drawn[2], found[2];
        for (int c = 0; c < 2; c++) drawn[c] = draw_move(&g, exponent);
        for (int k = 0; k < 6; k++) {
            const int at = exponent - (rng_once_in(&g, 4) ? (int)rng_int(&g, 1, 20) : 0);
            before[k] = rng_once_in(&g, 2) ? draw_coordinate(&g, at) : draw_tie(&g, at, drawn[k & 1]);
            after[k] = before[k] + drawn[k & 1];
        }
        sunder_shape *was = make_triangle(before), *is = make_triangle(after);
        if (was && is) {
            asked++;
            assert_true(sunder_i_move_between(was, is, found));
            check_found(before, after, drawn, found);
        }
        sunder_shape_free(was);
        sunder_shape_free(is);
    }
    assert_true(asked > test_count(20000) / 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_moves_are_found)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
