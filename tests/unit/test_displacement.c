/* A whole layer on small figures with known answers: what conflicts, what joins, what moves, what cannot. */
#include "polyset.h"
#include "run_layer.h"
#include "upheld.h"

#include "displacement/layer/model.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 30 };

typedef struct scene {
    sunder_feature feature[MOST];
    size_t n;
    sunder_layer_options options;
    sunder_report *report;
    sunder_layer_summary summary;
} scene;

static sunder_feature *add(scene *s, const char *wkt)
{
    polyset set;
    polyset_init(&set);
    sunder_feature *f = &s->feature[s->n++];
    memset(f, 0, sizeof *f);
    if (wkt) {
        if (!polyset_read_wkt(&set, wkt, NULL)) fail_msg("not WKT: %s", wkt);
        f->shape = polyset_shape(&set);
        assert_non_null(f->shape);
    }
    polyset_free(&set);
    f->weight = 1;
    f->max_shift = INFINITY;
    f->block = -1;
    return f;
}

/* The axis-parallel square of that side with its lower left corner at (x, y). */
static sunder_feature *add_box(scene *s, double x, double y, double w, double h)
{
    char wkt[400];
    snprintf(wkt, sizeof wkt, "POLYGON ((%.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g))", x, y,
             x + w, y, x + w, y + h, x, y + h, x, y);
    return add(s, wkt);
}

static void begin(scene *s, double gap)
{
    memset(s, 0, sizeof *s);
    sunder_layer_options_init(&s->options);
    s->options.gap = gap;
}

static void run(scene *s, bool check)
{
    sunder_report_free(s->report);
    s->report = (check ? run_check : run_separate)(s->feature, s->n, &s->options);
    sunder_report_summary(s->report, &s->summary);
}

static void end(scene *s)
{
    sunder_report_free(s->report);
    for (size_t i = 0; i < s->n; i++) sunder_shape_free((sunder_shape *)s->feature[i].shape);
}

static size_t left(const sunder_layer_summary *s)
{
    return s->after.overlap + s->after.too_close + s->after.barrier + s->after.barrier_near + s->after.contained +
           s->after.duplicate;
}

static double length(const scene *s, size_t f)
{
    double dx, dy;
    sunder_report_move(s->report, f, &dx, &dy);
    return hypot(dx, dy);
}

/* In doubles, which assert_float_equal() is not. */
#define assert_near(a, b, tolerance) assert_true(fabs((a) - (b)) <= (tolerance))

/* Moves are rounded outward by some units in the last place; nothing here is larger than a few hundred. */
#define HAIR 1e-9

static void check_nothing(void **state)
{
    scene s;
    begin(&s, 1);
    run(&s, false);
    assert_int_equal(s.summary.features, 0);
    assert_int_equal(s.summary.max_feature, SIZE_MAX);
    assert_true(s.summary.verified);
    add(&s, NULL);
    sunder_shape *empty = NULL;
    assert_int_equal(sunder_shape_from_rings(NULL, NULL, NULL, 0, SUNDER_VALIDITY_STRICT, &empty, NULL), SUNDER_OK);
    add(&s, NULL)->shape = empty;
    run(&s, false);
    assert_int_equal(s.summary.features, 2);
    assert_int_equal(s.summary.moved, 0);
    end(&s);
}

static void check_two_squares(void **state)
{
    scene s;
    begin(&s, 0);
    add_box(&s, 0, 0, 10, 10);
    add_box(&s, 8, 1, 10, 10);
    run(&s, false);
    assert_int_equal(s.summary.before.overlap, 1);
    assert_int_equal(left(&s.summary), 0);
    assert_int_equal(s.summary.moved, 2);
    /* Two apart along x, shared evenly: cost 1 + 1. */
    assert_near(length(&s, 0), 1, HAIR);
    assert_near(length(&s, 1), 1, HAIR);
    assert_near(s.summary.cost, 2, 10 * HAIR);
    assert_true(s.summary.lower_bound <= s.summary.cost);
    assert_near(s.summary.lower_bound, 2, 1e-6);
    end(&s);
}

static void check_weights(void **state)
{
    scene s;
    begin(&s, 0);
    add_box(&s, 0, 0, 10, 10)->weight = 3;
    add_box(&s, 8, 1, 10, 10);
    run(&s, false);
    /* 3 a^2 + b^2 with a + b = 2 is least at a = 1/2. */
    assert_near(length(&s, 0), 0.5, HAIR);
    assert_near(length(&s, 1), 1.5, HAIR);
    assert_near(s.summary.lower_bound, 3, 1e-6);
    end(&s);
}

static void check_fixed(void **state)
{
    scene s;
    begin(&s, 1);
    add_box(&s, 0, 0, 10, 10)->fixed = true;
    add_box(&s, 10.5, 1, 10, 10);
    run(&s, false);
    assert_int_equal(s.summary.before.too_close, 1);
    assert_int_equal(left(&s.summary), 0);
    assert_int_equal(sunder_report_status(s.report, 0), SUNDER_FEATURE_FIXED);
    assert_int_equal(sunder_report_status(s.report, 1), SUNDER_FEATURE_MOVED);
    assert_near(length(&s, 1), 0.5, HAIR);
    /* Nothing can be done between two fixed ones. */
    s.feature[1].fixed = true;
    run(&s, false);
    assert_int_equal(left(&s.summary), 1);
    size_t n;
    const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
    assert_int_equal(n, 1);
    assert_int_equal(c->reason, SUNDER_REASON_FIXED);
    assert_near(c->distance, 0.5, HAIR);
    assert_near(c->required, 1, 0);
    end(&s);
}

static void check_limits(void **state)
{
    scene s;
    begin(&s, 0);
    add_box(&s, 0, 0, 10, 10)->max_shift = 0.25;
    add_box(&s, 8, 1, 10, 10)->max_shift = 3;
    run(&s, false);
    assert_int_equal(left(&s.summary), 0);
    assert_true(length(&s, 0) <= 0.25);
    assert_near(length(&s, 1), 1.75, 1e-6);
    /* Together too little: the pair is listed, and nobody moves to ease it. */
    s.feature[1].max_shift = 0.5;
    run(&s, false);
    assert_int_equal(left(&s.summary), 1);
    assert_int_equal(s.summary.blocked, 2);
    assert_true(length(&s, 0) == 0 && length(&s, 1) == 0);
    size_t n;
    const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
    assert_int_equal(n, 1);
    assert_int_equal(c->reason, SUNDER_REASON_MAX_SHIFT);
    assert_int_equal(c->kind, SUNDER_CONFLICT_OVERLAP);
    assert_near(c->depth, 2, HAIR);
    end(&s);
}

static void check_chain_without_room(void **state)
{
    scene s;
    begin(&s, 1);
    /* Three between two walls 12 apart, where four gaps of 1 and three widths of 3 need 13, and with moves of 2
     * the middle one could just pass below the others; a fourth elsewhere has room. */
    add_box(&s, -10, -50, 10, 100)->fixed = true;
    add_box(&s, 12, -50, 10, 100)->fixed = true;
    for (int k = 0; k < 3; k++) add_box(&s, 1 + 3.5 * k, 0, 3, 3)->max_shift = 1.75;
    add_box(&s, 22.5, 0, 3, 3);
    run(&s, false);
    assert_true(left(&s.summary) > 0);
    assert_int_equal(sunder_report_status(s.report, 5), SUNDER_FEATURE_MOVED);
    size_t n;
    const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
    /* Either gap between the three could only grow if the other shrank, which nothing may: all stay. */
    assert_int_equal(n, 2);
    for (size_t k = 0; k < n; k++) {
        assert_int_equal(c[k].kind, SUNDER_CONFLICT_TOO_CLOSE);
        assert_true(c[k].distance == 0.5 && c[k].before == 0.5);
    }
    for (size_t f = 2; f < 5; f++) assert_true(length(&s, f) == 0);
    end(&s);
}

static void check_courtyard(void **state)
{
    scene s;
    begin(&s, 1);
    add(&s, "POLYGON ((0 0, 30 0, 30 30, 0 30, 0 0), (10 10, 20 10, 20 20, 10 20, 10 10))");
    add_box(&s, 10.5, 11, 5, 5);
    s.options.touch_tolerance = 0.1;
    run(&s, false);
    assert_int_equal(s.summary.before.too_close, 1);
    assert_int_equal(left(&s.summary), 0);
    assert_true(s.summary.max < 1); /* there is room inside */
    end(&s);
    /* No room: the one inside has to leave, if it may jump; else it stays. */
    for (int jumps = 0; jumps < 2; jumps++) {
        begin(&s, 3);
        add(&s, "POLYGON ((0 0, 30 0, 30 30, 0 30, 0 0), (10 10, 20 10, 20 20, 10 20, 10 10))");
        add_box(&s, 12, 12, 5, 5);
        s.options.allow_jumps = jumps;
        run(&s, false);
        assert_int_equal(left(&s.summary), jumps ? 0 : 1);
        assert_true((s.summary.moved > 0) == (jumps > 0));
        assert_true(s.summary.verified);
        end(&s);
    }
}

/* A yard too narrow for the gap, and no move long enough to leave it: the house stays in it, no worse off than
 * before. */
static void check_narrow_yard(void **state)
{
    scene s;
    begin(&s, 3);
    add(&s, "POLYGON ((0 0, 20 0, 20 20, 0 20, 0 0), (5 5, 5 15, 15 15, 15 5, 5 5))")->max_shift = 5;
    add_box(&s, 6.75, 7, 6, 6)->max_shift = 5;
    run(&s, false);
    size_t n = 0;
    const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
    assert_int_equal(n, 1);
    assert_int_equal(c->kind, SUNDER_CONFLICT_TOO_CLOSE);
    assert_int_equal(c->reason, SUNDER_REASON_MAX_SHIFT);
    assert_true(c->before == 1.75);
    assert_true(c->distance >= 1.75);
    assert_int_equal(sunder_report_status(s.report, 1), SUNDER_FEATURE_BLOCKED);
    end(&s);
}

/* The same, with moves long enough to leave it: what forbids that is the rule against jumps, by a proof; and a limit
 * that would let nobody leave is told first. */
static void check_yard_without_gate(void **state)
{
    for (int k = 0; k < 3; k++) {
        scene s;
        begin(&s, 3);
        add(&s, "POLYGON ((0 0, 20 0, 20 20, 0 20, 0 0), (5 5, 5 15, 15 15, 15 5, 5 5))")->max_shift = k ? 20 : 3;
        add_box(&s, 6.75, 7, 6, 6)->max_shift = k ? 20 : 3;
        s.options.allow_jumps = k == 2;
        run(&s, false);
        size_t n = 0;
        const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
        assert_int_equal(n, k == 2 ? 0 : 1);
        if (n) assert_int_equal(c->reason, k ? SUNDER_REASON_JUMP : SUNDER_REASON_MAX_SHIFT);
        assert_true(s.summary.verified);
        end(&s);
    }
    /* A gate: the way out is free where the anchor sees it, and then the house may leave. */
    scene s;
    begin(&s, 3);
    add(&s, "POLYGON ((0 0, 20 0, 20 20, 0 20, 0 13, 5 13, 5 15, 15 15, 15 5, 5 5, 5 7, 0 7, 0 0))")->max_shift = 0;
    add_box(&s, 6.75, 7, 6, 6)->max_shift = 20;
    run(&s, false);
    assert_int_equal(left(&s.summary), 0);
    end(&s);
}

static void check_blocks(void **state)
{
    scene s;
    begin(&s, 0);
    /* Two that touch, a third that overlaps one of them. */
    add_box(&s, 0, 0, 10, 10);
    add_box(&s, 10, 0, 10, 10);
    add_box(&s, 19, 1, 10, 10);
    run(&s, false);
    assert_int_equal(s.summary.blocks, 1);
    assert_int_equal(sunder_report_block(s.report, 0), 0);
    assert_int_equal(sunder_report_block(s.report, 1), 0);
    assert_int_equal(sunder_report_block(s.report, 2), -1);
    double a[2], b[2];
    sunder_report_move(s.report, 0, &a[0], &a[1]);
    sunder_report_move(s.report, 1, &b[0], &b[1]);
    assert_memory_equal(a, b, sizeof a);
    /* The block weighs two: it goes a third of the way. */
    assert_near(hypot(a[0], a[1]), 1.0 / 3, HAIR);
    assert_near(length(&s, 2), 2.0 / 3, HAIR);
    assert_int_equal(left(&s.summary), 0);
    /* Without blocks each is on its own, and touching is no conflict. */
    s.options.no_blocks = true;
    run(&s, false);
    assert_int_equal(s.summary.blocks, 0);
    assert_int_equal(s.summary.before.overlap, 1);
    assert_int_equal(left(&s.summary), 0);
    /* Numbers of the caller's hold all the same. */
    s.feature[0].block = s.feature[2].block = 7;
    run(&s, false);
    assert_int_equal(s.summary.blocks, 1);
    assert_int_equal(sunder_report_block(s.report, 2), 0);
    assert_int_equal(sunder_report_block(s.report, 1), -1);
    end(&s);
}

static void check_inside_blocks(void **state)
{
    scene s;
    begin(&s, 1);
    add_box(&s, 0, 0, 10, 10)->block = 1;
    add_box(&s, 5, 5, 10, 10)->block = 1;
    add_box(&s, 10.05, 0, 10, 4);
    run(&s, true);
    size_t n;
    const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
    assert_int_equal(s.summary.blocks, 1);               /* 0 and 1 by number, 2 by the tolerance of 0.1 */
    assert_int_equal(s.summary.before.inside_blocks, 2); /* 1 and 2 are the gap apart, exactly */
    assert_int_equal(s.summary.before.overlap + s.summary.before.too_close, 0);
    assert_int_equal(n, 1);
    assert_int_equal(c->kind, SUNDER_CONFLICT_OVERLAP);
    assert_int_equal(c->reason, SUNDER_REASON_SAME_BLOCK);
    assert_true(c->inside_block);
    assert_near(c->depth, 5, HAIR);
    s.options.list_inside = true;
    run(&s, true);
    sunder_report_conflicts(s.report, &n);
    assert_int_equal(n, 2);
    end(&s);
}

/* Two outlines have to part; the house in the one stands by the edge that is pushed in, and stays inside. */
static void check_kept_inside(void **state)
{
    scene s;
    begin(&s, 0);
    s.options.contained = SUNDER_CONTAINMENT_IGNORE;
    add_box(&s, 0, 0, 100, 100);
    add_box(&s, 97, 0, 100, 100);
    add_box(&s, 90, 40, 6, 6);
    s.feature[0].weight = s.feature[2].weight = 1;
    s.feature[1].weight = 1000;
    run(&s, false);
    assert_int_equal(s.summary.before.overlap, 1);
    assert_int_equal(left(&s.summary), 0);
    /* The outline gives way by nearly 3, and would leave the house 1 of the 4 that it had; it need not move. */
    assert_near(length(&s, 0), 3, 0.01);
    assert_int_equal(sunder_report_status(s.report, 2), SUNDER_FEATURE_UNMOVED);
    /* Nearer the edge it is pushed in, by what the edge comes too far. */
    end(&s);
    begin(&s, 0);
    s.options.contained = SUNDER_CONTAINMENT_IGNORE;
    add_box(&s, 0, 0, 100, 100);
    add_box(&s, 97, 0, 100, 100)->weight = 1000;
    add_box(&s, 0.5, 40, 6, 6);
    add_box(&s, 90.5, 40, 6, 6);
    add_box(&s, 0, 60, 6, 6)->weight = 1e-3; /* touches the edge that moves away from it, and may stay */
    run(&s, false);
    assert_int_equal(left(&s.summary), 0);
    assert_near(length(&s, 0), 3, 0.02);
    assert_int_equal(sunder_report_status(s.report, 2), SUNDER_FEATURE_UNMOVED);
    assert_int_equal(sunder_report_status(s.report, 4), SUNDER_FEATURE_UNMOVED);
    double dx, dy;
    sunder_report_move(s.report, 3, &dx, &dy);
    assert_near(dx, 0, HAIR);
    end(&s);
    /* The edge is pushed across the whole house: kept inside, the house goes along. */
    begin(&s, 0);
    s.options.contained = SUNDER_CONTAINMENT_IGNORE;
    add_box(&s, 0, 0, 100, 100);
    add_box(&s, 80, 0, 100, 100)->weight = 1000;
    add_box(&s, 79, 40, 6, 6)->weight = 1e-3;
    run(&s, false);
    assert_int_equal(left(&s.summary), 0);
    sunder_report_move(s.report, 2, &dx, &dy);
    assert_near(dx, -5, 0.1);
    end(&s);
    /* In both of two that part: it stays in the one whose edge is farther. */
    begin(&s, 0);
    s.options.contained = SUNDER_CONTAINMENT_IGNORE;
    add_box(&s, 0, 0, 100, 100);
    add_box(&s, 80, 0, 100, 100);
    add_box(&s, 81, 40, 4, 4)->weight = 1e-3;
    run(&s, false);
    assert_int_equal(s.summary.before.overlap, 1);
    assert_int_equal(left(&s.summary), 0);
    assert_true(s.summary.max < 11);
    end(&s);
}

static void check_contained(void **state)
{
    scene s;
    begin(&s, 0);
    add_box(&s, 0, 0, 20, 20);
    add_box(&s, 5, 6, 4, 4);
    run(&s, true);
    assert_int_equal(s.summary.blocks, 1);
    assert_int_equal(s.summary.before.contained, 0);
    assert_int_equal(s.summary.before.inside_blocks, 1);
    s.options.contained = SUNDER_CONTAINMENT_IGNORE;
    run(&s, false);
    assert_int_equal(s.summary.blocks, 0);
    assert_int_equal(left(&s.summary), 0);
    assert_int_equal(s.summary.moved, 0);
    s.options.contained = SUNDER_CONTAINMENT_SEPARATE;
    run(&s, false);
    assert_int_equal(s.summary.before.contained, 1);
    assert_int_equal(left(&s.summary), 0);
    assert_near(s.summary.total, 9, HAIR); /* out by the left: 5 + 4 */
    end(&s);
    /* Up to the tolerance: 0.2 beyond the wall, with a tolerance of 0.3. */
    begin(&s, 3);
    add_box(&s, 0, 0, 20, 20);
    add_box(&s, -0.2, 6, 8, 8);
    run(&s, true);
    assert_int_equal(s.summary.blocks, 1);
    s.options.touch_tolerance = 0.1;
    run(&s, true);
    assert_int_equal(s.summary.blocks, 0);
    assert_int_equal(s.summary.before.overlap, 1);
    end(&s);
}

static void check_duplicates(void **state)
{
    scene s;
    begin(&s, 0);
    for (int k = 0; k < 4; k++) add_box(&s, 3, 4, 2, 2);
    run(&s, true);
    assert_int_equal(s.summary.blocks, 1);
    s.options.contained = SUNDER_CONTAINMENT_SEPARATE;
    run(&s, true);
    assert_int_equal(s.summary.before.duplicate, 6);
    run(&s, false);
    assert_int_equal(left(&s.summary), 0);
    assert_int_equal(s.summary.rounded, 0);
    end(&s);
}

/* A house that sticks out of its outline and is too near a block beside it: into the outline is a way out of both. */
static void check_way_inside(void **state)
{
    scene s;
    begin(&s, 3);
    s.options.contained = SUNDER_CONTAINMENT_IGNORE;
    add_box(&s, 0, 0, 100, 100)->fixed = true;
    add_box(&s, 94, 40, 10, 10)->max_shift = 7;
    add_box(&s, 105, 20, 15, 50)->fixed = true;
    run(&s, false);
    assert_int_equal(left(&s.summary), 0);
    assert_near(length(&s, 1), 4, HAIR);
    assert_true(s.summary.lower_bound <= s.summary.cost);
    /* 3.5 is too short for either way. Off the block it would only go deeper into the outline: it stays. */
    s.feature[1].max_shift = 3.5;
    run(&s, false);
    size_t n;
    const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
    assert_int_equal(n, 2);
    assert_int_equal(c->reason, SUNDER_REASON_MAX_SHIFT);
    assert_true(length(&s, 1) == 0);
    end(&s);
    /* Neither fits in the other: then the gap is the only way. */
    begin(&s, 3);
    s.options.contained = SUNDER_CONTAINMENT_IGNORE;
    add_box(&s, 0, 0, 8, 100)->fixed = true;
    add_box(&s, 4, 40, 10, 10)->max_shift = 6;
    run(&s, false);
    c = sunder_report_conflicts(s.report, &n);
    assert_int_equal(n, 1);
    assert_int_equal(c->reason, SUNDER_REASON_MAX_SHIFT);
    end(&s);
}

/* A hut between two fixed walls that it cannot keep the gap from, and neighbours with room: nobody moves for the
 * hut. */
static void check_nothing_worse(void **state)
{
    scene s;
    begin(&s, 3);
    add_box(&s, 0, 0, 10, 40)->fixed = true;
    add_box(&s, 14.9, 0, 10, 40)->fixed = true;
    add_box(&s, 10.9, 10, 3, 3)->max_shift = 10;
    for (int k = 0; k < 4; k++) add_box(&s, 10.5, 50 + 12.0 * k, 4, 9)->max_shift = 10;
    run(&s, false);
    size_t n;
    const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
    assert_int_equal(n, 2);
    for (size_t k = 0; k < n; k++) assert_true(c[k].distance >= c[k].before);
    assert_int_equal(s.summary.moved, 0);
    assert_true(s.summary.verified);
    end(&s);
    /* What overlaps stays no deeper, though a neighbour presses. */
    begin(&s, 0);
    add_box(&s, 0, 0, 10, 10)->fixed = true;
    add_box(&s, 6, 0, 10, 10)->max_shift = 1;
    add_box(&s, 15, 0, 10, 10)->max_shift = 9;
    run(&s, false);
    c = sunder_report_conflicts(s.report, &n);
    assert_int_equal(n, 1);
    assert_int_equal(c->reason, SUNDER_REASON_MAX_SHIFT);
    assert_near(c->depth, 4, HAIR);
    assert_true(c->depth <= 4);
    end(&s);
}

static void check_ignored(void **state)
{
    scene s;
    begin(&s, 1);
    add_box(&s, 0, 0, 10, 10);
    add_box(&s, 1, 1, 10, 10)->ignored = true;
    run(&s, false);
    assert_int_equal(s.summary.skipped, 1);
    assert_int_equal(s.summary.moved, 0);
    assert_int_equal(sunder_report_status(s.report, 1), SUNDER_FEATURE_SKIPPED);
    assert_int_equal(left(&s.summary), 0);
    end(&s);
}

static void check_arguments(void **state)
{
    sunder_layer *layer = NULL;
    sunder_report *report = NULL;
    sunder_error err;
    sunder_feature f = {.weight = 1, .max_shift = INFINITY, .block = -1};
    const double bad_weight[] = {0, -1, NAN, INFINITY}, bad_limit[] = {-1, NAN};
    for (size_t k = 0; k < 4; k++) {
        f.weight = bad_weight[k];
        assert_int_equal(sunder_layer_new(&f, 1, &layer, &err), SUNDER_EARG);
    }
    f.weight = 1;
    for (size_t k = 0; k < 2; k++) {
        f.max_shift = bad_limit[k];
        assert_int_equal(sunder_layer_new(&f, 1, &layer, &err), SUNDER_EARG);
    }
    f.max_shift = INFINITY;
    assert_int_equal(sunder_layer_new(&f, 1, &layer, &err), SUNDER_OK);
    const struct {
        double gap, tolerance;
    } bad[] = {{-1, -1}, {NAN, -1}, {INFINITY, -1}, {1, 1}, {1, 2}, {1, NAN}, {0, INFINITY}};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        sunder_layer_options o;
        sunder_layer_options_init(&o);
        o.gap = bad[k].gap;
        o.touch_tolerance = bad[k].tolerance;
        assert_int_equal(sunder_layer_check(layer, &o, &report, &err), SUNDER_EARG);
        assert_int_equal(sunder_layer_separate(layer, &o, &report, &err), SUNDER_EARG);
    }
    const double bad_effort[3] = {-1, NAN, INFINITY};
    for (size_t k = 0; k < 3; k++) {
        sunder_layer_options o;
        sunder_layer_options_init(&o);
        o.effort = bad_effort[k];
        assert_int_equal(sunder_layer_check(layer, &o, &report, &err), SUNDER_EARG);
    }
    assert_null(report);
    static const double point[2] = {0, NAN}, line[4] = {0, 0, 1, 1};
    static const size_t one[1] = {1}, back[2] = {2, 1}, both[2] = {1, 2};
    const sunder_barrier bad_barrier[] = {
        {.width = -1}, {.width = NAN}, {.width = INFINITY}, {.gap = NAN}, {.gap = INFINITY}, {.gap = -INFINITY},
    };
    for (size_t k = 0; k < sizeof bad_barrier / sizeof *bad_barrier; k++)
        assert_int_equal(sunder_layer_set_barriers(layer, &bad_barrier[k], 1, &err), SUNDER_EARG);
    sunder_barrier b = {.geometry = {.xy = point, .line_end = one, .lines = 1}, .gap = -1};
    assert_int_equal(sunder_layer_set_barriers(layer, &b, 1, &err), SUNDER_EINVALID);
    b.geometry = (sunder_obstacle){.xy = line, .line_end = back, .lines = 2};
    assert_int_equal(sunder_layer_set_barriers(layer, &b, 1, &err), SUNDER_EARG);
    b.geometry.line_end = both;
    assert_int_equal(sunder_layer_set_barriers(layer, &b, 1, &err), SUNDER_OK);
    assert_int_equal(sunder_layer_set_barriers(layer, NULL, 0, &err), SUNDER_OK);
    sunder_layer_free(layer);
    sunder_layer_free(NULL);
    sunder_report_free(NULL);
}

static bool stop(double fraction, void *user)
{
    (void)user;
    return fraction < 0.05;
}

static void check_cancel(void **state)
{
    scene s;
    begin(&s, 0);
    add_box(&s, 0, 0, 10, 10);
    add_box(&s, 8, 1, 10, 10);
    s.options.progress = stop;
    sunder_layer *layer = NULL;
    sunder_error err;
    assert_int_equal(sunder_layer_new(s.feature, s.n, &layer, &err), SUNDER_OK);
    assert_int_equal(sunder_layer_separate(layer, &s.options, &s.report, &err), SUNDER_ECANCEL);
    assert_null(s.report);
    sunder_layer_free(layer);
    end(&s);
}

static bool stop_later(double fraction, void *user)
{
    (void)fraction;
    return --*(long *)user > 0;
}

/* Stopped at every place that asks: no report, no leak, and the word for it. */
static void check_cancel_anywhere(void **state)
{
    scene s;
    begin(&s, 1);
    for (int i = 0; i < 5; i++)
        for (int j = 0; j < 5; j++) {
            sunder_feature *f = add_box(&s, 8 * i, 7 * j, 10, 10);
            if (j < 2) f->max_shift = 3;
        }
    s.options.progress = stop_later;
    sunder_layer *layer = NULL;
    sunder_error err;
    assert_int_equal(sunder_layer_new(s.feature, s.n, &layer, &err), SUNDER_OK);
    sunder_status status = SUNDER_ECANCEL;
    long calls = 1;
    for (; status && calls < 1000000; calls += 1 + calls / 4) {
        long left = calls;
        s.options.progress_user = &left;
        s.options.threads = calls % 2 ? 1 : 3;
        status = sunder_layer_separate(layer, &s.options, &s.report, &err);
        if (!status) break;
        assert_int_equal(status, SUNDER_ECANCEL);
        assert_null(s.report);
    }
    assert_int_equal(status, SUNDER_OK);
    assert_null(upheld_breach(s.feature, s.n, &s.options, s.report));
    assert_true(calls > 100); /* it was asked within the search, too */
    sunder_layer_free(layer);
    end(&s);
}

static void check_within(void **state)
{
    const double t[2] = {3, 4}, u[2] = {3, nextafter(4, 5)}, v[2] = {3e-200, 4e-200};
    assert_true(sunder_i_is_within_limit(t, 5));
    assert_false(sunder_i_is_within_limit(t, nextafter(5, 0)));
    assert_false(sunder_i_is_within_limit(u, 5));
    assert_true(sunder_i_is_within_limit(v, 5.0000001e-200));
    assert_false(sunder_i_is_within_limit(v, 4.9e-200));
    assert_true(sunder_i_is_within_limit(t, INFINITY));
}

/* ---- Barriers ---------------------------------------------------------------------------------------------------- */

/* One box of 10 by 10 at the origin, beside a road that leads upward at x, of width 2 at a gap of 1: so 2 from its
 * middle. The report lives until the next call. */
static const sunder_conflict *beside_road(double x, double limit, sunder_layer_summary *summary, double t[2])
{
    static sunder_report *report;
    const double xy[4] = {x, -100, x, 100};
    const size_t line_end = 2;
    const sunder_barrier road = {{.xy = xy, .line_end = &line_end, .lines = 1}, 2, 1, false};
    scene s;
    size_t n;
    sunder_layer *layer = NULL;
    sunder_report_free(report);
    report = NULL;
    begin(&s, 5);
    add_box(&s, 0, 0, 10, 10)->max_shift = limit;
    assert_int_equal(sunder_layer_new(s.feature, 1, &layer, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_set_barriers(layer, &road, 1, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_separate(layer, &s.options, &report, NULL), SUNDER_OK);
    sunder_layer_free(layer);
    sunder_report_summary(report, summary);
    sunder_report_move(report, 0, &t[0], &t[1]);
    end(&s);
    const sunder_conflict *c = sunder_report_conflicts(report, &n);
    if (n == 0) sunder_report_free(report), report = NULL;
    return n ? c : NULL;
}

static void check_beside_barrier(void **state)
{
    sunder_layer_summary s;
    double t[2];
    assert_null(beside_road(-1, INFINITY, &s, t)); /* 1 off: 1 more is needed */
    assert_int_equal(s.before.barrier_near, 1);
    assert_near(t[0], 1, HAIR);
    assert_near(s.lower_bound, 1, 1e-6);
    assert_null(beside_road(-2, INFINITY, &s, t)); /* just so */
    assert_int_equal(s.before.barrier_near, 0);
    assert_null(beside_road(0, INFINITY, &s, t)); /* along a wall, which meets no interior */
    assert_int_equal(s.before.barrier_near, 1);
    assert_near(t[0], 2, HAIR);
    assert_null(beside_road(3, INFINITY, &s, t)); /* through it: the nearer side is that of x = 3 */
    assert_int_equal(s.before.barrier, 1);
    assert_near(t[0], 5, HAIR);
    assert_near(s.cost, 25, 100 * HAIR);
    assert_near(s.lower_bound, 25, 1e-5);
}

static void check_barrier_without_room(void **state)
{
    sunder_layer_summary s;
    double t[2];
    const sunder_conflict *c = beside_road(3, 0.125, &s, t);
    assert_non_null(c);
    assert_int_equal(c->a, 0);
    assert_int_equal(c->b, 1);
    assert_int_equal(c->kind, SUNDER_CONFLICT_BARRIER);
    assert_int_equal(c->reason, SUNDER_REASON_MAX_SHIFT);
    assert_near(c->depth, 3, HAIR);
    assert_near(c->required, 2, HAIR);
    assert_true(t[0] == 0 && t[1] == 0 && s.verified);
    assert_int_equal(s.blocked, 1);
    c = beside_road(-1, 0, &s, t);
    assert_non_null(c);
    assert_int_equal(c->kind, SUNDER_CONFLICT_BARRIER_NEAR);
    assert_int_equal(c->reason, SUNDER_REASON_FIXED);
    assert_near(c->distance, 1, HAIR);
    assert_near(c->to[0], -1, HAIR);
    assert_null(beside_road(-50, INFINITY, &s, t)); /* frees the last report */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_nothing),
        cmocka_unit_test(check_two_squares),
        cmocka_unit_test(check_weights),
        cmocka_unit_test(check_fixed),
        cmocka_unit_test(check_limits),
        cmocka_unit_test(check_chain_without_room),
        cmocka_unit_test(check_courtyard),
        cmocka_unit_test(check_narrow_yard),
        cmocka_unit_test(check_yard_without_gate),
        cmocka_unit_test(check_blocks),
        cmocka_unit_test(check_inside_blocks),
        cmocka_unit_test(check_contained),
        cmocka_unit_test(check_kept_inside),
        cmocka_unit_test(check_way_inside),
        cmocka_unit_test(check_nothing_worse),
        cmocka_unit_test(check_duplicates),
        cmocka_unit_test(check_ignored),
        cmocka_unit_test(check_arguments),
        cmocka_unit_test(check_cancel),
        cmocka_unit_test(check_cancel_anywhere),
        cmocka_unit_test(check_within),
        cmocka_unit_test(check_beside_barrier),
        cmocka_unit_test(check_barrier_without_room),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
