/* The reasons of conflicts that remain within limits, compared with layers whose answer is known.
 *
 * Planted: boxes that are separate are moved by at most their limits, so a solution exists: no conflict may have a
 * reason of limits or of missing room. Packed: boxes that together are too wide for the lane that they cannot leave:
 * the remaining conflicts have the reason that there is no room. */
#include "random.h"
#include "run_layer.h"

#include "sunder.h"

#include <gmp.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 40 };

typedef struct town {
    sunder_feature feature[MOST];
    size_t n;
} town;

static sunder_feature *add_box(town *t, double x, double y, double w, double h)
{
    const double xy[8] = {x, y, x + w, y, x + w, y + h, x, y + h};
    const size_t ring_end = 4, rings = 1;
    sunder_shape *shape = NULL;
    sunder_error err;
    sunder_feature *f = &t->feature[t->n++];
    if (sunder_shape_from_rings(xy, &ring_end, &rings, 1, SUNDER_VALIDITY_STRICT, &shape, &err))
        fail_msg("%s", err.message);
    *f = (sunder_feature){.shape = shape, .weight = 1, .max_shift = INFINITY, .block = -1};
    return f;
}

/* Demands, exactly, that no feature moved farther than its limit, and that fixed ones did not move. */
static void demand_within(const town *t, const sunder_report *report)
{
    mpq_t sum, square;
    mpq_inits(sum, square, NULL);
    for (size_t k = 0; k < t->n; k++) {
        double d[2];
        sunder_report_move(report, k, &d[0], &d[1]);
        mpq_set_ui(sum, 0, 1);
        for (int e = 0; e < 2; e++) {
            mpq_set_d(square, d[e]);
            mpq_mul(square, square, square);
            mpq_add(sum, sum, square);
        }
        mpq_set_d(square, t->feature[k].fixed ? 0 : t->feature[k].max_shift);
        mpq_mul(square, square, square);
        if (mpq_cmp(sum, square) > 0) fail_msg("feature %zu moved by (%.17g, %.17g)", k, d[0], d[1]);
    }
    mpq_clears(sum, square, NULL);
}

static void free_town(town *t)
{
    for (size_t k = 0; k < t->n; k++) sunder_shape_free((sunder_shape *)t->feature[k].shape);
}

static sunder_report *separate(const town *t, double gap)
{
    sunder_layer_options options;
    sunder_layer_options_init(&options);
    options.contained = SUNDER_CONTAINMENT_SEPARATE;
    options.no_blocks = true;
    options.gap = gap;
    options.touch_tolerance = 0;
    return run_separate(t->feature, t->n, &options);
}

/* Boxes in rows with alleys between them; each is moved by a multiple of 1/8 within its limit; some are fixed
 * instead. */
static double plant(rng *r, town *t)
{
    memset(t, 0, sizeof *t);
    const int rows = (int)rng_int(r, 1, 4), columns = (int)rng_int(r, 2, 6);
    const double limit = (double)rng_int(r, 4, 40) / 8, alley = (double)rng_int(r, 0, 8) / 8;
    const bool barriers = rng_once_in(r, 2), far = rng_once_in(r, 3); /* far: the way back is the whole limit */
    double y = 5000000;
    for (int i = 0; i < rows; i++) {
        double x = 400000 + (double)rng_int(r, 0, 24) / 8, tallest = 0;
        for (int j = 0; j < columns; j++) {
            const double w = (double)rng_int(r, 8, 60) / 8, h = (double)rng_int(r, 8, 60) / 8;
            double dx, dy;
            do {
                dx = (double)rng_int(r, -40, 40) / 8;
                dy = (double)rng_int(r, -40, 40) / 8;
                if (far) *(rng_once_in(r, 2) ? &dx : &dy) = 0;
                if (far && dx != 0) dx = copysign(limit, dx);
                if (far && dy != 0) dy = copysign(limit, dy);
            } while (dx * dx + dy * dy > limit * limit);
            if (barriers && rng_once_in(r, 6)) {
                add_box(t, x, y, w, h)->fixed = true;
            } else {
                add_box(t, x + dx, y + dy, w, h)->max_shift = limit;
            }
            x += w + alley;
            tallest = fmax(tallest, h);
        }
        y += tallest + alley;
    }
    return alley * (double)rng_int(r, 0, 2) / 2;
}

static void check_planted(void **state)
{
    (void)state;
    size_t before = 0, open = 0;
    const size_t trials = test_count(300);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed(), trial);
        town t;
        const double gap = plant(&r, &t);
        sunder_report *report = separate(&t, gap);
        demand_within(&t, report);
        sunder_layer_summary summary;
        sunder_report_summary(report, &summary);
        assert_int_equal(summary.rounded, 0);
        before +=
            summary.before.overlap + summary.before.too_close + summary.before.contained + summary.before.duplicate;
        size_t conflicts;
        const sunder_conflict *c = sunder_report_conflicts(report, &conflicts);
        for (size_t k = 0; k < conflicts; k++)
            if (c[k].reason != SUNDER_REASON_UNRESOLVED)
                fail_msg("trial %zu: %zu and %zu are listed as %s, but a solution was planted", trial, c[k].a, c[k].b,
                         sunder_reason_string(c[k].reason));
        open += conflicts;
        sunder_report_free(report);
        free_town(&t);
    }
    print_message("%zu conflicts planted, %zu left\n", before, open);
    assert_true(before > trials);
    assert_true(open * 20 <= before);
}

/* A lane between two fixed boxes, narrower than the boxes in it together; these are too tall to leave it, and too wide
 * to change places. */
static void check_packed(void **state)
{
    (void)state;
    size_t open = 0, said = 0;
    const size_t trials = test_count(200);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed(), trial);
        town t;
        memset(&t, 0, sizeof t);
        const int n = (int)rng_int(&r, 2, 8);
        double width[8];
        for (int k = 0; k < n; k++) width[k] = (double)rng_int(&r, 64, 120) / 8;
        const double excess = (double)rng_int(&r, 1, 6) / 8;
        /* The boxes overlap, so that the row in the lane is connected with its walls. */
        const double share = excess / (n + 1);
        double x = 400000;
        add_box(&t, x - 10, 5000000, 10, 40)->fixed = true;
        for (int k = 0; k < n; k++) {
            x -= share;
            add_box(&t, x, 5000000 + (double)rng_int(&r, 0, 16) / 8, width[k], 38)->max_shift =
                (double)rng_int(&r, 8, 60) / 8;
            x += width[k];
        }
        add_box(&t, x - share, 5000000, 10, 40)->fixed = true;
        sunder_report *report = separate(&t, 0);
        demand_within(&t, report);
        sunder_layer_summary summary;
        sunder_report_summary(report, &summary);
        assert_int_equal(summary.rounded, 0);
        size_t conflicts;
        const sunder_conflict *c = sunder_report_conflicts(report, &conflicts);
        assert_true(conflicts > 0);
        for (size_t k = 0; k < conflicts; k++) {
            assert_true(c[k].reason == SUNDER_REASON_NO_ROOM || c[k].reason == SUNDER_REASON_UNRESOLVED);
            said += c[k].reason == SUNDER_REASON_NO_ROOM;
            open += c[k].reason == SUNDER_REASON_UNRESOLVED;
        }
        sunder_report_free(report);
        free_town(&t);
    }
    print_message("%zu shown to have no room, %zu not\n", said, open);
    assert_int_equal(open, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_planted), cmocka_unit_test(check_packed)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
