/* A layer for which every allocation fails in turn: each failure gives an error and no leak, and the result is the same
 * when none fails. */
#include "failing.h"

#include "displacement/layer/sides.h"
#include "sunder_hiding.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { HOUSES = 6 };

typedef struct street {
    sunder_shape *shape[HOUSES];
    bool check, moves;
    double limit;             /* of all features: 1.1 is enough for each pair, but not for all together */
    bool barriers, preferred; /* preferred: features prefer other places */
    bool hides;               /* all features may be hidden */
    sunder_layer_options options;
} street;

/* Two features that touch, one that overlaps them, a fixed one, one beside it with a small limit, one far away. */
static bool make(street *s)
{
    static const double at[HOUSES][2] = {{0, 0}, {10, 0}, {18, 2}, {28.5, 0}, {25, 12}, {100, 100}};
    const size_t ring_end = 4, poly_end = 1;
    for (size_t k = 0; k < HOUSES; k++) {
        const double x = at[k][0], y = at[k][1], xy[8] = {x, y, x + 10, y, x + 10, y + 10, x, y + 10};
        if (sunder_shape_from_rings(xy, &ring_end, &poly_end, 1, SUNDER_VALIDITY_STRICT, &s->shape[k], NULL))
            return false;
    }
    return true;
}

/* A road through one feature, a point barrier near another, and an area near the far one. */
static sunder_status set_barriers(const street *s, sunder_layer *layer, sunder_error *err)
{
    static const double xy[] = {-5, 3, 5, 4, 15, -3, 40, 5};
    static const size_t line_end[] = {3, 4};
    const sunder_barrier barrier[2] = {{{.xy = xy, .line_end = line_end, .lines = 2}, 1, 0.5, s->moves, 0},
                                       {{.shape = s->shape[5]}, 0, -1, s->moves, 0}};
    return s->barriers ? sunder_layer_set_barriers(layer, barrier, 2, err) : SUNDER_OK;
}

static sunder_status set_hiding(const street *s, sunder_layer *layer, sunder_error *err)
{
    sunder_hiding_cost cost[HOUSES];
    for (size_t k = 0; k < HOUSES; k++) cost[k] = (sunder_hiding_cost){1, 1};
    return s->hides ? sunder_layer_set_hiding(layer, cost, err) : SUNDER_OK;
}

static bool attempt(void *context)
{
    static const double preferred[2 * HOUSES] = {1, 0.5, 1, 0.5, -3, 0, 0, 0, 0, 0, 5, 0};
    street *s = context;
    sunder_feature feature[HOUSES];
    sunder_layer *layer = NULL;
    sunder_report *report = NULL;
    sunder_error err;
    for (size_t k = 0; k < HOUSES; k++) s->shape[k] = NULL;
    sunder_status status = make(s) ? SUNDER_OK : SUNDER_ENOMEM;
    for (size_t k = 0; k < HOUSES; k++)
        feature[k] = (sunder_feature){
            .shape = s->shape[k], .weight = 1, .max_shift = k == 4 ? 0.5 : s->limit, .block = -1, .fixed = k == 3};
    if (!status) status = sunder_layer_new(feature, HOUSES, &layer, &err);
    if (!status) status = set_barriers(s, layer, &err);
    if (!status && s->preferred) status = sunder_layer_set_preferred(layer, preferred, &err);
    if (!status) status = set_hiding(s, layer, &err);
    if (!status && s->moves)
        status = sunder_layer_check_moves(layer, layer, &s->options, &report, &err);
    else if (!status)
        status = s->check ? sunder_layer_check(layer, &s->options, &report, &err)
                          : sunder_layer_separate(layer, &s->options, &report, &err);
    if (status) {
        assert_int_equal(status, SUNDER_ENOMEM);
        assert_null(report);
    } else {
        sunder_layer_summary summary;
        sunder_hiding_summary hiding;
        sunder_report_summary(report, &summary);
        sunder_report_hiding(report, &hiding);
        assert_true((hiding.hidden > 0) == s->hides);
        assert_true(s->moves || summary.before.overlap > 0);
        assert_true(s->check || summary.moved > 0 || s->limit < INFINITY);
        assert_true(s->limit == INFINITY || s->hides || summary.blocked > 0);
    }
    sunder_report_free(report);
    sunder_layer_free(layer);
    for (size_t k = 0; k < HOUSES; k++) sunder_shape_free(s->shape[k]);
    return status == SUNDER_OK;
}

/* A house in which a road ends; or that house and another one, between the road and an area. */
typedef struct lane {
    size_t houses;
    double limit;
} lane;

static sunder_status separate_in_lane(const lane *l, sunder_shape *const shape[3], sunder_report **report)
{
    static const double xy[] = {-5, 5, 2, 5};
    static const size_t line_end[] = {2};
    const sunder_barrier barrier[2] = {{{.xy = xy, .line_end = line_end, .lines = 1}, 0.5, 0.25, true, 0},
                                       {{.shape = shape[2]}, 0, -1, true, 0}};
    sunder_feature feature[2];
    sunder_layer_options options;
    sunder_layer *layer = NULL;
    sunder_layer_options_init(&options);
    options.gap = 1;
    for (size_t k = 0; k < l->houses; k++)
        feature[k] = (sunder_feature){.shape = shape[k], .weight = 1, .max_shift = l->limit, .block = -1};
    sunder_status status = sunder_layer_new(feature, l->houses, &layer, NULL);
    if (!status) status = sunder_layer_set_barriers(layer, barrier, 2, NULL);
    if (!status) status = sunder_layer_separate(layer, &options, report, NULL);
    sunder_layer_free(layer);
    return status;
}

static bool attempt_lane(void *context)
{
    static const double at[3][2] = {{0, 0}, {11.5, 0}, {22, 0}};
    const size_t ring_end = 4, poly_end = 1;
    const lane *l = context;
    sunder_shape *shape[3] = {NULL, NULL, NULL};
    sunder_report *report = NULL;
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < 3 && !status; k++) {
        const double x = at[k][0], y = at[k][1], xy[8] = {x, y, x + 10, y, x + 10, y + 10, x, y + 10};
        status = sunder_shape_from_rings(xy, &ring_end, &poly_end, 1, SUNDER_VALIDITY_STRICT, &shape[k], NULL);
    }
    if (!status) status = separate_in_lane(l, shape, &report);
    if (status) {
        assert_int_equal(status, SUNDER_ENOMEM);
        assert_null(report);
    } else {
        sunder_layer_summary summary;
        sunder_report_summary(report, &summary);
        assert_true(summary.before.barrier == 1 && summary.before.barrier_near == l->houses - 1 && summary.verified);
        assert_int_equal(summary.after.barrier, l->limit < INFINITY);
        assert_int_equal(summary.after.barrier_near, 0);
    }
    sunder_report_free(report);
    for (size_t k = 0; k < 3; k++) sunder_shape_free(shape[k]);
    return status == SUNDER_OK;
}

static void run_in_lane(size_t houses, double limit)
{
    lane l = {houses, limit};
    failing_begin();
    const bool sound = failing_loop(attempt_lane, &l, true);
    failing_end();
    assert_true(sound);
}

static void check_separate_beside_barriers(void **state) { run_in_lane(2, INFINITY); }
static void check_separate_beside_barriers_without_room(void **state) { run_in_lane(1, 1); }

static void run_beside(bool check, double gap, double limit, bool barriers)
{
    street s = {.check = check, .limit = limit, .barriers = barriers};
    sunder_layer_options_init(&s.options);
    s.options.gap = gap;
    s.options.keep_trees = s.options.keep_pushes = true;
    failing_begin();
    const bool sound = failing_loop(attempt, &s, true);
    failing_end();
    assert_true(sound);
}

static void run(bool check, double gap, double limit) { run_beside(check, gap, limit, false); }

static void check_check(void **state) { run(true, 1, INFINITY); }
static void check_separate(void **state) { run(false, 0, INFINITY); }
static void check_separate_with_gap(void **state) { run(false, 1, INFINITY); }
static void check_separate_without_room(void **state) { run(false, 0, 1.1); }
/* Two in a block that prefer the same, one that prefers to overlap them more, and one far away. */
static void check_separate_from_preferred(void **state)
{
    street s = {.limit = INFINITY, .preferred = true};
    sunder_layer_options_init(&s.options);
    s.options.gap = 1;
    s.options.rows = SUNDER_ROWS_FOUND;
    s.options.keep_pushes = true;
    failing_begin();
    const bool sound = failing_loop(attempt, &s, true);
    failing_end();
    assert_true(sound);
}

/* With what is reported of parts of the layer. */
static void check_hide(void **state)
{
    street s = {.limit = 1.1, .hides = true};
    sunder_layer_options_init(&s.options);
    s.options.gap = 1;
    s.options.effort = 0;
    s.options.keep_worlds = true;
    failing_begin();
    const bool sound = failing_loop(attempt, &s, true);
    failing_end();
    assert_true(sound);
}

static void check_beside_barriers(void **state) { run_beside(true, 1, INFINITY, true); }

/* No feature moved; but the side anchors of features that the road cuts are computed. */
static void check_moves_beside_barriers(void **state)
{
    street s = {.check = true, .moves = true, .limit = INFINITY, .barriers = true};
    sunder_layer_options_init(&s.options);
    failing_begin();
    const bool sound = failing_loop(attempt, &s, true);
    failing_end();
    assert_true(sound);
}

enum { TEETH = 120 };

typedef struct lines {
    const sunder_i_side *line[1];
    size_t n;
} lines;

static bool find_lines(void *user, const double box[4], const sunder_i_side *const **line, size_t *n)
{
    const lines *all = user;
    (void)box;
    *line = all->line;
    *n = all->n;
    return true;
}

/* A comb cut in two by a line through its anchor: another anchor is found at a height where all teeth are crossed, by
 * more numbers than one allocation holds. */
static bool attempt_anchor(void *context)
{
    double xy[2 * (4 * TEETH + 2)];
    const size_t ring_end = 4 * TEETH + 2, poly_end = 1;
    size_t n = 0;
    for (int k = 0; k < 4 * TEETH; k++) { /* corners from right to left, alternating in pairs between top and bottom */
        xy[n++] = 451234.567 + 1.25 * (4 * TEETH - k);
        xy[n++] = 5411234.567 + (k % 4 == 1 || k % 4 == 2 ? 90.125 : 10.25);
    }
    const double left = xy[n - 2] - 1, right = xy[0] + 1, last[4] = {left, 5411234.567, right, 5411234.567};
    memcpy(xy + n, last, sizeof last);
    sunder_shape *shape = NULL;
    sunder_status status = sunder_shape_from_rings(xy, &ring_end, &poly_end, 1, SUNDER_VALIDITY_STRICT, &shape, NULL);
    if (!status) {
        double anchor[2];
        sunder_shape_anchor(shape, anchor);
        const double from[2] = {anchor[0], anchor[1] - 500}, to[2] = {anchor[0], anchor[1] + 500};
        const sunder_i_side side = {.from = from, .to = to}, *const sides[1] = {&side};
        lines both = {{&side}, 1};
        /* All parts are as large as the largest, so the free distance of each is computed. */
        const sunder_i_side_scope scope = {1e6, find_lines, &both};
        status = sunder_i_side_anchor(shape, sides, 1, &scope, anchor, NULL);
        if (!status) assert_true(anchor[0] != from[0]);
    }
    sunder_shape_free(shape);
    if (status) assert_int_equal(status, SUNDER_ENOMEM);
    return status == SUNDER_OK;
}

static void check_side_anchor(void **state)
{
    failing_begin();
    const bool sound = failing_loop(attempt_anchor, NULL, true);
    failing_end();
    assert_true(sound);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_check),
        cmocka_unit_test(check_separate),
        cmocka_unit_test(check_separate_with_gap),
        cmocka_unit_test(check_separate_without_room),
        cmocka_unit_test(check_separate_from_preferred),
        cmocka_unit_test(check_hide),
        cmocka_unit_test(check_beside_barriers),
        cmocka_unit_test(check_separate_beside_barriers),
        cmocka_unit_test(check_separate_beside_barriers_without_room),
        cmocka_unit_test(check_moves_beside_barriers),
        cmocka_unit_test(check_side_anchor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
