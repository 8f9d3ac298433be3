/* The lower bound of a layer is valid for every effort: no layout found with a greater effort costs less than the bound
 * proved with a small one, whichever method proved it (one tree, blocks of a large group, parts of a very large one).
 *
 * Layers are rows and crowds of slanted boxes that overlap, with groups of five to some dozens of boxes; and one crowd
 * of hundreds. */
#include "polyset.h"
#include "random.h"
#include "run_layer.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#define MOST 256

typedef struct crowd {
    sunder_feature feature[MOST];
    size_t n;
    sunder_layer_options options;
} crowd;

static void add_box(crowd *c, rng *r, double x, double y)
{
    sunder_feature *f = &c->feature[c->n];
    const double a = rng_once_in(r, 2) ? 0 : 0.8 * rng_unit(r), w = 3 + 5 * rng_unit(r), h = 3 + 3 * rng_unit(r);
    *f = (sunder_feature){.shape = polyset_turned_rectangle(x, y, w, h, a),
                          .weight = rng_once_in(r, 3) ? 1 + 3 * rng_unit(r) : 1,
                          .max_shift = INFINITY,
                          .fixed = rng_once_in(r, 12),
                          .block = -1};
    assert_non_null(f->shape);
    c->n++;
}

/* n boxes in rows of `row`, at distances less than their size. */
static void gather(crowd *c, rng *r, size_t n, size_t row)
{
    memset(c, 0, sizeof *c);
    sunder_layer_options_init(&c->options);
    c->options.no_blocks = true;
    c->options.touch_tolerance = 0;
    c->options.allow_jumps = rng_once_in(r, 2);
    c->options.gap = rng_once_in(r, 4) ? 0 : 0.5 + rng_unit(r);
    const double pitch = 5 + 3 * rng_unit(r);
    while (c->n < n)
        add_box(c, r, 1000 + pitch * (double)(c->n % row) + 2 * rng_unit(r),
                2000 + pitch * (double)(c->n / row) + 2 * rng_unit(r));
}

static void disperse(crowd *c)
{
    for (size_t k = 0; k < c->n; k++) sunder_shape_free((sunder_shape *)c->feature[k].shape);
}

static sunder_layer_summary run(crowd *c, double effort)
{
    sunder_layer_summary s;
    c->options.effort = effort;
    sunder_report *report = run_separate(c->feature, c->n, &c->options);
    sunder_report_summary(report, &s);
    sunder_report_free(report);
    assert_true(s.verified);
    return s;
}

static size_t conflicts(const sunder_layer_summary *s) { return s->after.overlap + s->after.too_close; }

static void test_bounds(void **state)
{
    (void)state;
    static const double effort[] = {0.0005, 0.005, 0.05, 0.3};
    enum { EFFORTS = sizeof effort / sizeof *effort };
    const size_t crowds = test_count(30);
    size_t solved = 0, optimal = 0, groups = 0;
    double cost = 0, proved[EFFORTS] = {0};
    static crowd c;
    for (size_t i = 0; i < crowds; i++) {
        rng r = rng_start(test_seed(), i);
        gather(&c, &r, (size_t)rng_int(&r, 5, 24), (size_t)rng_int(&r, 3, 8));
        sunder_layer_summary s[EFFORTS];
        bool all = true;
        double cheapest = INFINITY, most = 0;
        for (size_t k = 0; k < EFFORTS; k++) {
            s[k] = run(&c, effort[k]);
            all = all && conflicts(&s[k]) == 0;
            cheapest = fmin(cheapest, s[k].cost);
            most = fmax(most, s[k].lower_bound);
        }
        disperse(&c);
        if (!all) continue;
        if (most > cheapest * (1 + 1e-9))
            fail_msg("seed %llu, case %zu: %.17g is proved, but %.17g was found", (unsigned long long)test_seed(), i,
                     most, cheapest);
        solved++;
        cost += cheapest;
        groups += s[EFFORTS - 1].clusters;
        optimal += s[EFFORTS - 1].clusters_optimal;
        for (size_t k = 0; k < EFFORTS; k++) proved[k] += s[k].lower_bound;
    }
    print_message("%zu of %zu layers solved, %zu of %zu groups proved; of a cost of %g by effort:", solved, crowds,
                  optimal, groups, cost);
    for (size_t k = 0; k < EFFORTS; k++) print_message(" %g", proved[k]);
    print_message("\n");
    assert_true(2 * solved > crowds);
    assert_true(proved[EFFORTS - 1] > 0.5 * cost && proved[0] < proved[EFFORTS - 1]);
}

/* Enough bodies that the group is divided into parts. */
static void test_hundreds(void **state)
{
    (void)state;
    static crowd c;
    rng r = rng_start(test_seed(), 1000000);
    gather(&c, &r, MOST, 16);
    c.options.gap = 1;
    const sunder_layer_summary s = run(&c, 0.02);
    disperse(&c);
    print_message("%zu boxes, %zu groups: cost %g, proved %g\n", c.n, s.clusters, s.cost, s.lower_bound);
    assert_true(conflicts(&s) > 0 || (s.lower_bound > 0 && s.lower_bound <= s.cost * (1 + 1e-12)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_bounds), cmocka_unit_test(test_hundreds)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
