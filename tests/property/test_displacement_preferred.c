/* Laws of preferred places (sunder_layer_set_preferred()), on streets of boxes beside a road: a layout in which nothing
 * is short, preferred, is the result, and costs nothing; what cannot move prefers nothing; the cost counts from the
 * preferred places, and the bound does not exceed it; limits count from where features stand. That the cost is the
 * optimum is tested beside the oracle (test_displacement_optimum.c). */
#include "random.h"
#include "upheld.h"

#include "sunder.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 24 };

typedef struct street {
    sunder_feature feature[MOST];
    double preferred[2 * MOST];
    size_t n;
    sunder_layer_options options;
    double road[4];
    size_t road_end;
    sunder_barrier barrier;
    bool has_road;
} street;

static sunder_shape *box_shape(double x, double y, double w, double h)
{
    const double xy[8] = {x, y, x + w, y, x + w, y + h, x, y + h};
    const size_t ring_end = 4, rings = 1;
    sunder_shape *shape = NULL;
    sunder_error err;
    if (sunder_shape_from_rings(xy, &ring_end, &rings, 1, SUNDER_VALIDITY_STRICT, &shape, &err))
        fail_msg("%s", err.message);
    return shape;
}

/* Two rows of boxes with little room between them, and a road between the rows. */
static void build(rng *r, street *s)
{
    const double at = rng_once_in(r, 2) ? 0 : 400000;
    *s = (street){.has_road = rng_once_in(r, 2)};
    sunder_layer_options_init(&s->options);
    s->options.gap = (double)rng_int(r, 1, 8) / 4;
    s->options.allow_jumps = rng_once_in(r, 2);
    s->options.no_blocks = rng_once_in(r, 2);
    s->options.rows = rng_once_in(r, 2) ? SUNDER_ROWS_FOUND : SUNDER_ROWS_NONE;
    const bool limits = rng_once_in(r, 2), weights = rng_once_in(r, 3);
    for (int row = 0; row < 2; row++) {
        double x = at;
        for (int64_t k = rng_int(r, 2, 10); k > 0; k--) {
            const double w = (double)rng_int(r, 4, 12), y = at + 20 * row + (double)rng_int(r, 0, 8) / 8;
            sunder_feature *f = &s->feature[s->n++];
            *f = (sunder_feature){.weight = 1, .max_shift = INFINITY, .block = -1};
            f->shape = box_shape(x, y, w, (double)rng_int(r, 8, 10));
            if (weights) f->weight = (double)rng_int(r, 1, 16) / 4;
            if (limits) f->max_shift = (double)rng_int(r, 0, 40) / 4;
            x += w + (double)rng_int(r, -2, 16) / 4;
        }
    }
    s->road_end = 2;
    memcpy(s->road, (double[]){at - 50, at + 15, at + 200, at + 15}, sizeof s->road);
    s->barrier = (sunder_barrier){
        .geometry = {.xy = s->road, .line_end = &s->road_end, .lines = 1}, .width = 1, .gap = -1, .side = true};
}

static void end(street *s)
{
    for (size_t k = 0; k < s->n; k++) sunder_shape_free((sunder_shape *)s->feature[k].shape);
}

static sunder_status try_separate(const street *s, const double *preferred, sunder_report **report)
{
    sunder_layer *layer = NULL;
    sunder_error err;
    if (sunder_layer_new(s->feature, s->n, &layer, &err) ||
        sunder_layer_set_barriers(layer, &s->barrier, s->has_road, &err) ||
        sunder_layer_set_preferred(layer, preferred, &err))
        fail_msg("%s", err.message);
    const sunder_status status = sunder_layer_separate(layer, &s->options, report, &err);
    sunder_layer_free(layer);
    return status;
}

static sunder_report *separate(const street *s, const double *preferred, sunder_layer_summary *summary)
{
    sunder_report *report = NULL;
    if (try_separate(s, preferred, &report)) fail_msg("the layer cannot be separated");
    sunder_report_summary(report, summary);
    assert_true(summary->verified);
    if (!s->has_road) { /* the test of that rule knows no barriers */
        const char *worse = upheld_breach(s->feature, s->n, &s->options, report);
        if (worse) fail_msg("%s", worse);
    }
    return report;
}

static void take_moves(const street *s, const sunder_report *report, double *move)
{
    for (size_t k = 0; k < s->n; k++) sunder_report_move(report, k, &move[2 * k], &move[2 * k + 1]);
}

static bool leaves_conflicts(const sunder_report *report)
{
    size_t n, left = 0;
    const sunder_conflict *c = sunder_report_conflicts(report, &n);
    for (size_t k = 0; k < n; k++) left += !c[k].inside_block;
    return left > 0;
}

/* Both zeros are the same move. */
static bool are_equal(const double *a, const double *b, size_t n)
{
    for (size_t k = 0; k < n; k++)
        if (a[k] != b[k]) return false;
    return true;
}

/* A layout that was found once, preferred: found again, to the bit, and free. */
static void test_layout_is_kept(void **state)
{
    (void)state;
    size_t kept = 0, moved = 0;
    for (size_t i = 0; i < test_count(60); i++) {
        rng r = rng_start(test_seed(), i);
        street s;
        sunder_layer_summary first, again;
        double move[2 * MOST], next[2 * MOST];
        build(&r, &s);
        sunder_report *report = separate(&s, NULL, &first), *other;
        take_moves(&s, report, move);
        if (!leaves_conflicts(report)) {
            other = separate(&s, move, &again);
            take_moves(&s, other, next);
            if (!are_equal(move, next, 2 * s.n) || again.cost != 0 || again.lower_bound != 0)
                fail_msg("seed %llu, case %zu: cost %.17g, bound %.17g", (unsigned long long)test_seed(), i, again.cost,
                         again.lower_bound);
            assert_int_equal(again.moved, first.moved);
            kept++;
            moved += first.moved;
            sunder_report_free(other);
        }
        sunder_report_free(report);
        end(&s);
    }
    printf("%zu layouts kept, %zu moved features\n", kept, moved);
    assert_true(kept > 0 && moved > 0);
}

static double cost_of(const street *s, const double *move)
{
    double cost = 0;
    for (size_t k = 0; k < s->n; k++) {
        const double x = move[2 * k] - s->preferred[2 * k], y = move[2 * k + 1] - s->preferred[2 * k + 1];
        if (s->feature[k].max_shift > 0) cost += s->feature[k].weight * (x * x + y * y);
    }
    return cost;
}

/* Moves within twice the limit, some of them those of the neighbour. */
static void choose_preferred(rng *r, street *s)
{
    for (size_t k = 0; k < s->n; k++) {
        const int64_t kind = rng_int(r, 0, 3);
        for (size_t c = 0; c < 2 && kind; c++)
            s->preferred[2 * k + c] =
                kind == 1 && k ? s->preferred[2 * k - 2 + c] : (double)rng_int(r, -48, 48) / 8 * (c ? 0.5 : 1);
    }
}

/* Costs, bounds and limits for any preferred places. Blocks count from their means, so there are none here. */
static void test_costs(void **state)
{
    (void)state;
    double cost = 0, bound = 0;
    for (size_t i = 0; i < test_count(60); i++) {
        rng r = rng_start(test_seed() + 1, i);
        street s;
        sunder_layer_summary summary;
        double move[2 * MOST];
        build(&r, &s);
        s.options.no_blocks = true;
        choose_preferred(&r, &s);
        sunder_report *report = separate(&s, s.preferred, &summary);
        take_moves(&s, report, move);
        const double own = cost_of(&s, move);
        if (fabs(summary.cost_moves - own) > 1e-9 * own + 1e-9)
            fail_msg("seed %llu, case %zu: cost %.17g, not %.17g", (unsigned long long)test_seed(), i, own,
                     summary.cost_moves);
        if (summary.lower_bound > summary.cost * (1 + 1e-12))
            fail_msg("seed %llu, case %zu: bound %.17g above the cost %.17g", (unsigned long long)test_seed(), i,
                     summary.lower_bound, summary.cost);
        for (size_t k = 0; k < s.n; k++) /* exact: squares of few bits; a longer move differs by more than rounding */
            assert_true(hypot(move[2 * k], move[2 * k + 1]) <= s.feature[k].max_shift * (1 + 1e-15));
        cost += summary.cost;
        bound += summary.lower_bound;
        sunder_report_free(report);
        end(&s);
    }
    printf("cost %.6g, at least %.6g\n", cost, bound);
    assert_true(bound > 0.9 * cost);
}

/* The law that all zeros are as good as none; what is fixed prefers nothing. */
static void test_nothing_preferred(void **state)
{
    (void)state;
    for (size_t i = 0; i < test_count(10); i++) {
        rng r = rng_start(test_seed() + 2, i);
        street s;
        sunder_layer_summary first, again;
        double move[2 * MOST], next[2 * MOST], none[2 * MOST] = {0};
        build(&r, &s);
        s.feature[0].fixed = true;
        for (int fixed = 0; fixed < 2; fixed++) {
            none[0] = fixed;
            sunder_report *report = separate(&s, NULL, &first), *other = separate(&s, none, &again);
            take_moves(&s, report, move);
            take_moves(&s, other, next);
            assert_memory_equal(move, next, 2 * s.n * sizeof *move);
            assert_true(first.cost == again.cost && first.lower_bound == again.lower_bound);
            sunder_report_free(report);
            sunder_report_free(other);
        }
        end(&s);
    }
}

static void test_refusals(void **state)
{
    (void)state;
    rng r = rng_start(1, 0);
    street s;
    sunder_layer *layer = NULL;
    sunder_report *report = NULL;
    sunder_error err;
    double move[2 * MOST] = {1};
    build(&r, &s);
    s.options.keep_trees = true;
    assert_int_equal(try_separate(&s, move, &report), SUNDER_EARG);
    s.options.keep_trees = false;
    s.options.keep_worlds = true;
    assert_int_equal(try_separate(&s, move, &report), SUNDER_EARG);
    move[3] = NAN;
    assert_int_equal(sunder_layer_new(s.feature, s.n, &layer, &err), SUNDER_OK);
    assert_int_equal(sunder_layer_set_preferred(layer, move, &err), SUNDER_EINVALID);
    sunder_layer_free(layer);
    end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_layout_is_kept),
        cmocka_unit_test(test_costs),
        cmocka_unit_test(test_nothing_preferred),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
