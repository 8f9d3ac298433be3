/* An exact fit within limits is solved, and distinguished from a case without a solution, in which one limit is shorter
 * by its last bit.
 *
 * Rows of shapes along a direction of rational length, all on one grid: each has to move a given number of grid steps,
 * those at the ends exactly by their limits, after which neighbours have exactly the required distance. So there is one
 * solution, in whole steps, which doubles represent. Neighbours face each other with whole edges, or with corners
 * across a gap; a row may begin at a barrier, or at a fixed shape, and every limit may be slightly longer than
 * necessary. With the limit at one end shorter by one unit in the last place there is no solution. All this follows
 * from the construction of a row, without the library. */
#include "random.h"
#include "run_layer.h"

#include "sunder.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 5 };

typedef enum beginning { FREE, FIXED, BESIDE_BARRIER } beginning;

typedef struct row {
    sunder_feature feature[MOST];
    size_t n;
    double line[4];
    size_t line_end;
    sunder_barrier barrier;
    sunder_layer_options options;
    beginning begins;
    double origin[2], unit;
    int64_t p, q, r; /* p^2 + q^2 = r^2: the direction (p, q), and its length r, in units */
} row;

/* The point at a given number of steps along the row and to its left. */
static void place(const row *w, int64_t along, int64_t left, double xy[2])
{
    xy[0] = w->origin[0] + (double)(along * w->p - left * w->q) * w->unit;
    xy[1] = w->origin[1] + (double)(along * w->q + left * w->p) * w->unit;
}

static double length(const row *w, int64_t steps) { return (double)(steps * w->r) * w->unit; }

static void add(row *w, const double *xy, size_t corners, double limit)
{
    const size_t rings = 1;
    sunder_shape *shape = NULL;
    sunder_error err;
    if (sunder_shape_from_rings(xy, &corners, &rings, 1, SUNDER_VALIDITY_STRICT, &shape, &err))
        fail_msg("%s", err.message);
    w->feature[w->n++] =
        (sunder_feature){.shape = shape, .weight = 1, .max_shift = limit, .fixed = limit == 0, .block = -1};
}

/* A box from `from` to `to` along the row, or a shape with its corners there. */
static void add_shape(row *w, bool corners, int64_t from, int64_t to, int64_t left, int64_t wide, double limit)
{
    double xy[8];
    const int64_t half = (to - from) / 2;
    const int64_t box[8] = {from, left - wide, to, left - wide, to, left + wide, from, left + wide},
                  diamond[8] = {from, left, from + half, left - half, to, left, from + half, left + half};
    const int64_t *at = corners ? diamond : box;
    for (int k = 0; k < 4; k++) place(w, at[2 * k], at[2 * k + 1], xy + 2 * k);
    add(w, xy, 4, limit);
}

/* The range and the step of coordinates. */
static void draw_grid(rng *r, row *w)
{
    static const int64_t way[][3] = {{1, 0, 1}, {0, 1, 1},  {-1, 0, 1},   {0, -1, 1},
                                     {3, 4, 5}, {-4, 3, 5}, {5, -12, 13}, {-15, -8, 17}};
    static const double at[] = {0, 40, 1000.25, 400000, 5500000};
    const int64_t *e = way[rng_int(r, 0, 7)];
    w->p = e[0], w->q = e[1], w->r = e[2];
    w->unit = ldexp(1, (int)rng_int(r, -6, 0));
    for (int c = 0; c < 2; c++) w->origin[c] = at[rng_int(r, 0, 4)];
}

/* The first shape of a row is free, fixed, or beside a barrier. */
static void draw_barrier(rng *r, row *w, int64_t owed, int64_t far)
{
    const int64_t drawn = rng_int(r, 0, 2) * owed;
    place(w, -owed, -40 * far, w->line);
    place(w, -owed, 40 * far, w->line + 2);
    w->line_end = 2;
    w->barrier = (sunder_barrier){.geometry = {.xy = w->line, .line_end = &w->line_end, .lines = 1},
                                  .width = length(w, drawn),
                                  .gap = length(w, owed) - length(w, drawn) / 2,
                                  .side = rng_once_in(r, 2)};
}

/* The number of steps of each, ascending: the last one moves away from the others. */
static void draw_steps(rng *r, beginning begins, int64_t most, size_t n, int64_t *step)
{
    step[0] = begins == FIXED ? 0 : begins == FREE ? -rng_int(r, 0, 20) : rng_int(r, 1, 20);
    for (size_t k = 1; k < n; k++) step[k] = step[k - 1] + rng_int(r, 1, most);
    for (int64_t back = step[n - 1] <= 0 ? 1 - step[n - 1] : 0, k = 0; k < (int64_t)n; k++) step[k] += back;
}

static void set_options(row *w, int64_t owed)
{
    sunder_layer_options_init(&w->options);
    w->options.gap = length(w, owed);
    w->options.no_blocks = true;
    w->options.touch_tolerance = 0;
    w->options.contained = SUNDER_CONTAINMENT_SEPARATE;
    w->options.effort = 0;
    w->options.barrier_reach = INFINITY;
}

/* missing: the limit of the last one is too short by a unit in the last place. */
static void draw_row(rng *r, row *w, bool missing)
{
    memset(w, 0, sizeof *w);
    draw_grid(r, w);
    w->begins = (beginning)rng_int(r, 0, 2);
    const bool corners = rng_once_in(r, 3), hairs = !missing && rng_once_in(r, 3);
    const size_t least = w->begins == BESIDE_BARRIER ? 1 : 2,
                 n = corners ? least : (size_t)rng_int(r, (int64_t)least, rng_once_in(r, 2) ? 2 : 4);
    const int64_t owed = corners ? rng_int(r, 8, 40) : rng_once_in(r, 3) ? 0 : rng_int(r, 1, 40), far = owed + 80 * 4;
    int64_t step[MOST], along = 0; /* along: the end of the last one, after its move */
    draw_steps(r, w->begins, corners ? owed / 2 : 20, n, step);
    if (w->begins == BESIDE_BARRIER) draw_barrier(r, w, owed, far);
    for (size_t k = 0; k < n; k++) {
        const int64_t deep = far + 2 * rng_int(r, 0, 20), left = corners ? 0 : rng_int(r, 0, 20);
        const bool inner = k > 0 && k < n - 1;
        double limit = length(w, step[k] < 0 ? -step[k] : step[k]) + (inner ? length(w, rng_int(r, 0, 3)) : 0);
        if (hairs && rng_once_in(r, 2) && limit > 0) limit = nextafter(limit, INFINITY);
        if (missing && k == n - 1) limit = nextafter(limit, 0);
        add_shape(w, corners, along - step[k], along - step[k] + deep, left, far, limit);
        along += deep + owed;
    }
    set_options(w, owed);
}

static void free_row(row *w)
{
    for (size_t k = 0; k < w->n; k++) sunder_shape_free((sunder_shape *)w->feature[k].shape);
}

static sunder_report *separate(const row *w, sunder_layer_summary *summary)
{
    sunder_layer *layer = NULL;
    sunder_report *report = NULL;
    sunder_error err;
    if (sunder_layer_new(w->feature, w->n, &layer, &err) ||
        (w->begins == BESIDE_BARRIER && sunder_layer_set_barriers(layer, &w->barrier, 1, &err)) ||
        sunder_layer_separate(layer, &w->options, &report, &err))
        fail_msg("%s", err.message);
    sunder_layer_free(layer);
    sunder_report_summary(report, summary);
    assert_true(summary->verified);
    return report;
}

static size_t count(const sunder_conflict_counts *c)
{
    return c->overlap + c->too_close + c->barrier + c->barrier_drawn + c->barrier_near;
}

static void test_fits(void **state)
{
    (void)state;
    const size_t trials = test_count(150);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed(), trial);
        row w;
        sunder_layer_summary s;
        draw_row(&r, &w, false);
        sunder_report *report = separate(&w, &s);
        assert_true(count(&s.before) > 0);
        if (count(&s.after))
            fail_msg("seed %llu, trial %zu: %zu of %zu conflicts of %zu shapes are left",
                     (unsigned long long)test_seed(), trial, count(&s.after), count(&s.before), w.n);
        sunder_report_free(report);
        free_row(&w);
    }
}

static void test_misses(void **state)
{
    (void)state;
    const size_t trials = test_count(50);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed() + 1, trial);
        row w;
        sunder_layer_summary s;
        draw_row(&r, &w, true);
        sunder_report *report = separate(&w, &s);
        if (!count(&s.after))
            fail_msg("seed %llu, trial %zu: solved, and cannot be", (unsigned long long)test_seed(), trial);
        sunder_report_free(report);
        free_row(&w);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_fits), cmocka_unit_test(test_misses)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
