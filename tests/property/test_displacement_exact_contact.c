/* Moves without a limit end in exact contact if doubles represent it: no margin is left in them.
 *
 * Rows of boxes on a grid, where each has to move a given number of steps away from the one before: in the cheapest
 * solution all neighbours are in contact. A row begins at a fixed box, or is free, and then its moves add up to zero.
 * The expected moves follow from the construction of the row, without the library. Also pairs of boxes with arbitrary
 * coordinates, whose expected relative move is the exact double that the gap lacks. */
#include "random.h"
#include "scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { MOST = 6 };

typedef struct row {
    scene scene;
    size_t n;
    double t[MOST]; /* expected moves along the row */
    bool upright;   /* the row is parallel to y */
} row;

/* A box that extends from `from` to `to` along the row, with a small offset across it. */
static void add_box(row *w, double from, double to, double beside, double wide)
{
    if (w->upright)
        scene_add_box(&w->scene, beside, from, wide, to - from);
    else
        scene_add_box(&w->scene, from, beside, to - from, wide);
}

/* The number of steps of each: from 0 up after a fixed box, else around a mean of 0. */
static void draw_steps(rng *r, row *w, bool fixed, double unit)
{
    int64_t step[MOST] = {0}, sum = 0;
    for (size_t k = 1; k < w->n; k++) step[k] = step[k - 1] + rng_int(r, 1, 40) * (fixed ? 1 : (int64_t)w->n);
    for (size_t k = 0; k < w->n && !fixed; k++) sum += step[k];
    for (size_t k = 0; k < w->n; k++) w->t[k] = (double)(step[k] - sum / (int64_t)w->n) * unit;
}

static void draw_row(rng *r, row *w)
{
    static const double places[] = {0, 40, 1000.25, 400000, 5500000};
    const double unit = ldexp(1, (int)rng_int(r, -6, 0)), at = places[rng_int(r, 0, 4)];
    const bool fixed = rng_once_in(r, 3);
    scene_begin(&w->scene, rng_once_in(r, 3) ? 0 : (double)rng_int(r, 1, 9) * unit);
    w->n = (size_t)rng_int(r, 2, MOST);
    w->upright = rng_once_in(r, 2);
    draw_steps(r, w, fixed, unit);
    double from = at;
    for (size_t k = 0; k < w->n; k++) {
        /* Each pair of neighbours lacks exactly the difference of their moves; boxes that are not neighbours are too
         * far apart to meet. */
        const double to = from + (double)rng_int(r, 600, 900) * (double)MOST * unit, wide = 8000 * MOST * unit;
        add_box(w, from, to, at + (double)rng_int(r, 0, 40) * unit, wide);
        if (k + 1 < w->n) from = to + w->scene.options.gap - (w->t[k + 1] - w->t[k]);
    }
    w->scene.feature[0].fixed = fixed;
    w->scene.options.no_blocks = true;
}

static void test_rows_end_in_contact(void **state)
{
    (void)state;
    for (size_t k = 0; k < test_count(300); k++) {
        rng r = rng_start(test_seed(), k);
        row w = {0};
        draw_row(&r, &w);
        scene_separate(&w.scene);
        double cost = 0;
        for (size_t b = 0; b < w.n; b++) {
            double t[2];
            sunder_report_move(w.scene.report, b, &t[0], &t[1]);
            assert_true(t[w.upright] == w.t[b] && t[!w.upright] == 0);
            cost += w.t[b] * w.t[b];
        }
        assert_true(w.scene.summary.cost == cost && w.scene.summary.lower_bound <= cost);
        assert_true(w.scene.summary.verified && scene_left(&w.scene) == 0);
        scene_end(&w.scene);
    }
}

/* All coordinates, before and after, are between 2^21 and 2^22, so they have the same unit in the last place. */
static void test_pairs_end_in_contact(void **state)
{
    (void)state;
    for (size_t k = 0; k < test_count(300); k++) {
        rng r = rng_start(test_seed(), k);
        row w = {.n = 2, .upright = rng_once_in(&r, 2)};
        scene_begin(&w.scene, rng_once_in(&r, 3) ? 0 : ldexp((double)rng_int(&r, 1, 0xffff), -16));
        const double a = 3000000 + 100 * rng_unit(&r), b = a + 10 + 10 * rng_unit(&r), c = b - 3 * rng_unit(&r),
                     d = c + 10 + 10 * rng_unit(&r), beside = 3000000 + 100 * rng_unit(&r);
        add_box(&w, a, b, beside, 200);
        add_box(&w, c, d, beside + rng_unit(&r), 200);
        w.scene.feature[rng_int(&r, 0, 1)].fixed = rng_once_in(&r, 4);
        w.scene.options.no_blocks = true;
        scene_separate(&w.scene);
        double t[2], u[2];
        sunder_report_move(w.scene.report, 0, &t[0], &t[1]);
        sunder_report_move(w.scene.report, 1, &u[0], &u[1]);
        const size_t along = w.upright, across = 1 - along;
        const double end = a + (b - a) + t[along], begin = c + u[along];
        assert_true(begin - end == w.scene.options.gap && t[across] == 0 && u[across] == 0);
        assert_true(w.scene.summary.verified && scene_left(&w.scene) == 0);
        scene_end(&w.scene);
    }
}

/* The smallest case: an earlier version gave the moves 1.0000000000000071. */
static void test_two_squares_that_overlap_by_2(void **state)
{
    (void)state;
    scene s;
    scene_begin(&s, 0);
    scene_add_box(&s, 0, 0, 10, 10);
    scene_add_box(&s, 8, 0, 10, 10);
    scene_separate(&s);
    double t[2], u[2];
    sunder_report_move(s.report, 0, &t[0], &t[1]);
    sunder_report_move(s.report, 1, &u[0], &u[1]);
    assert_true(t[0] == -1 && t[1] == 0 && u[0] == 1 && u[1] == 0 && s.summary.cost == 2);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_two_squares_that_overlap_by_2),
        cmocka_unit_test(test_rows_end_in_contact),
        cmocka_unit_test(test_pairs_end_in_contact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
