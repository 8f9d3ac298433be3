/* Changes of options that would resolve the remaining pairs of a crowd: for each pair a longer limit, from one layout
 * of the whole crowd; and a smaller gap. */
#include "polyset.h"
#include "run_layer.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

enum { MOST = 200 };

typedef struct crowd {
    sunder_feature feature[MOST];
    size_t n;
    sunder_layer_options options;
} crowd;

static void begin(crowd *c)
{
    c->n = 0;
    sunder_layer_options_init(&c->options);
    c->options.gap = 3;
    c->options.no_blocks = true;
    c->options.effort = 0x1p-6; /* so that little work is spent on the bound */
}

static void end(crowd *c)
{
    for (size_t k = 0; k < c->n; k++) sunder_shape_free((sunder_shape *)c->feature[k].shape);
}

static void add_box(crowd *c, double x, double y, double w, double h, double limit)
{
    char wkt[400];
    snprintf(wkt, sizeof wkt, "POLYGON ((%.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g))", x, y,
             x + w, y, x + w, y + h, x, y + h, x, y);
    assert_true(c->n < MOST);
    c->feature[c->n++] =
        (sunder_feature){.shape = polyset_shape_of_wkt(wkt), .weight = 1, .max_shift = limit, .block = -1};
}

/* Adds squares of side 10 whose centres are nearly 12 apart. */
static void add_grid(crowd *c, size_t rows, size_t columns, double limit)
{
    for (size_t k = 0; k < rows * columns; k++) {
        const size_t column = k % columns, row = k / columns;
        add_box(c, 12 * (double)column + 0.25 * (double)(k * 7 % 3), 12 * (double)row + 0.25 * (double)(k * 5 % 3), 10,
                10, limit);
    }
}

/* Separates, and demands that each conflict has a limit and a gap with which it would be resolved; returns the longest
 * limit. */
static double longest_need(crowd *c, size_t least)
{
    sunder_report *report = run_separate(c->feature, c->n, &c->options);
    size_t n;
    const sunder_conflict *conflict = sunder_report_conflicts(report, &n);
    double longest = 0;
    assert_true(n > least);
    for (size_t k = 0; k < n; k++) {
        assert_true(isfinite(conflict[k].need_shift) && conflict[k].need_shift > c->feature[0].max_shift);
        assert_true(conflict[k].need_gap >= 0 && conflict[k].need_gap < c->options.gap);
        longest = fmax(longest, conflict[k].need_shift);
    }
    sunder_report_free(report);
    return longest;
}

/* Is the whole crowd solved with that limit for all? */
static void demand_solved_within(crowd *c, double limit)
{
    sunder_layer_summary summary;
    for (size_t k = 0; k < c->n; k++) c->feature[k].max_shift = limit;
    sunder_report *report = run_separate(c->feature, c->n, &c->options);
    sunder_report_summary(report, &summary);
    assert_int_equal(summary.after.too_close, 0);
    assert_true(summary.max <= limit);
    sunder_report_free(report);
}

/* Without limits the grid as a whole has a layout, and its longest move is the longest limit that a pair needs. */
static void test_grid(void **state)
{
    (void)state;
    crowd c;
    begin(&c);
    add_grid(&c, 6, 6, 1);
    demand_solved_within(&c, longest_need(&c, 10));
    end(&c);
}

/* One body in the middle is fixed: the others move away from it, too. */
static void test_about_one_that_stands(void **state)
{
    (void)state;
    crowd c;
    begin(&c);
    add_grid(&c, 5, 5, 1);
    c.feature[12].fixed = true;
    longest_need(&c, 4);
    end(&c);
}

/* Terraces of more than a hundred houses are not solved without limits, since they run into each other: instead the
 * layout of the whole crowd is stretched. */
static void test_terraces(void **state)
{
    (void)state;
    crowd c;
    begin(&c);
    for (size_t k = 0; k < 160; k++) {
        const size_t house = k % 16, row = k / 16 % 2, block = k / 32;
        const double x = 116 * (double)(block % 3) + 6 * (double)house + (row ? 0.5 : 0),
                     y = 32 * (double)(block / 3) + 10 * (double)row;
        add_box(&c, x, y, 6, 10, 4);
    }
    const double longest = longest_need(&c, 50);
    /* Houses of 6 by 10 need 3 more each way: the layout, 324 by 52, is stretched about its centre by 3/6 and 3/10. */
    assert_true(longest > 75 && longest < 0.5 * 162 + 0.3 * 26 + 1);
    end(&c);
}

/* At effort 0 no such questions are asked. */
static void test_nothing_asked(void **state)
{
    (void)state;
    crowd c;
    begin(&c);
    c.options.effort = 0;
    add_grid(&c, 6, 6, 1);
    sunder_report *report = run_separate(c.feature, c.n, &c.options);
    size_t n;
    const sunder_conflict *conflict = sunder_report_conflicts(report, &n);
    for (size_t k = 0; k < n; k++) assert_true(isnan(conflict[k].need_shift) && isnan(conflict[k].need_gap));
    sunder_report_free(report);
    end(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_grid), cmocka_unit_test(test_about_one_that_stands),
                                       cmocka_unit_test(test_terraces), cmocka_unit_test(test_nothing_asked)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
