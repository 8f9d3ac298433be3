/* What would free a conflict, on figures with known answers. */
#include "polyset.h"

#include "sunder.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 8 };

typedef struct scene {
    sunder_feature feature[MOST];
    size_t n;
    sunder_layer_options options;
    sunder_report *report;
    const sunder_conflict *conflict;
    size_t conflicts;
} scene;

static void begin(scene *s, double gap)
{
    memset(s, 0, sizeof *s);
    sunder_layer_options_init(&s->options);
    s->options.gap = gap;
    s->options.no_blocks = s->options.allow_jumps = true;
    s->options.contained = SUNDER_CONTAINMENT_SEPARATE;
}

static void add_box(scene *s, double x, double y, double w, double h, double limit)
{
    char wkt[400];
    snprintf(wkt, sizeof wkt, "POLYGON ((%.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g))", x, y,
             x + w, y, x + w, y + h, x, y + h, x, y);
    s->feature[s->n++] = (sunder_feature){
        .shape = polyset_shape_of_wkt(wkt), .weight = 1, .max_shift = limit, .block = -1, .fixed = limit == 0};
}

static void separate(scene *s)
{
    sunder_layer *layer = NULL;
    assert_int_equal(sunder_layer_new(s->feature, s->n, &layer, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_separate(layer, &s->options, &s->report, NULL), SUNDER_OK);
    sunder_layer_free(layer);
    s->conflict = sunder_report_conflicts(s->report, &s->conflicts);
}

static void end(scene *s)
{
    sunder_report_free(s->report);
    for (size_t k = 0; k < s->n; k++) sunder_shape_free((sunder_shape *)s->feature[k].shape);
}

/* Each of two squares may go 0.2, and would have to go a half. */
static void a_longer_limit(void **state)
{
    (void)state;
    scene s;
    begin(&s, 0);
    add_box(&s, 0, 0, 2, 2, 0.2);
    add_box(&s, 1, 0, 2, 2, 0.2);
    separate(&s);
    assert_int_equal(s.conflicts, 1);
    assert_int_equal(s.conflict[0].reason, SUNDER_REASON_MAX_SHIFT);
    assert_true(s.conflict[0].need_shift >= 0.5 && s.conflict[0].need_shift < 0.5 + 1e-9);
    assert_true(isnan(s.conflict[0].need_gap) && s.conflict[0].need_gone == SIZE_MAX);
    end(&s);
}

/* A box of 2 between walls that are 4 from each other, at a gap of 1.5; it could keep 1, and would go over the right
 * one. */
static void a_smaller_gap(void **state)
{
    (void)state;
    scene s;
    begin(&s, 1.5);
    add_box(&s, -2, -20, 2, 40, 0);
    add_box(&s, 1.125, -1, 2, 2, 1);
    add_box(&s, 4, -20, 2, 40, 0);
    separate(&s);
    assert_int_equal(s.conflicts, 2);
    for (size_t k = 0; k < 2; k++) {
        const sunder_conflict *c = &s.conflict[k];
        assert_int_equal(c->reason, SUNDER_REASON_NO_ROOM);
        assert_true(c->need_gap >= 0.75 && c->need_gap <= 1);
        assert_int_equal(c->need_gone, c->a == 0 ? 2 : 0);
        assert_true(c->need_shift >= 6.375 && c->need_shift < 6.4);
    }
    end(&s);
}

/* Two between walls that leave room for one, unless one goes above the other. */
static void one_less(void **state)
{
    (void)state;
    scene s;
    begin(&s, 0);
    add_box(&s, -2, -400, 2, 800, 0);
    add_box(&s, 3.25, -400, 2, 800, 0);
    add_box(&s, 0, 0, 2, 2, 0.9);
    add_box(&s, 1, 0, 2, 2, 0.9);
    separate(&s);
    assert_int_equal(s.conflicts, 1);
    assert_int_equal(s.conflict[0].reason, SUNDER_REASON_NO_ROOM);
    assert_int_equal(s.conflict[0].a, 2);
    assert_int_equal(s.conflict[0].need_gone, 0);
    assert_true(s.conflict[0].need_shift > 0.9 && s.conflict[0].need_shift <= 2);
    end(&s);
}

/* Without effort nothing is asked. */
static void nothing_asked(void **state)
{
    (void)state;
    scene s;
    begin(&s, 0);
    s.options.effort = 0;
    add_box(&s, 0, 0, 2, 2, 0.2);
    add_box(&s, 1, 0, 2, 2, 0.2);
    separate(&s);
    assert_int_equal(s.conflicts, 1);
    assert_true(isnan(s.conflict[0].need_shift) && s.conflict[0].need_gone == SIZE_MAX);
    end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_longer_limit), cmocka_unit_test(a_smaller_gap),
                                       cmocka_unit_test(one_less), cmocka_unit_test(nothing_asked)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
