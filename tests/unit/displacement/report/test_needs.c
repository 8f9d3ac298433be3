/* Changes of options that would resolve a conflict, in small layers with known results. */
#include "scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* No blocks; jumps are allowed. */
static void begin(scene *s, double gap)
{
    scene_begin(s, gap);
    s->options.no_blocks = s->options.allow_jumps = true;
    s->options.contained = SUNDER_CONTAINMENT_SEPARATE;
}

static void add_box(scene *s, double x, double y, double w, double h, double limit)
{
    sunder_feature *f = scene_add_box(s, x, y, w, h);
    f->max_shift = limit;
    f->fixed = limit == 0;
}

/* Separates; returns the number of conflicts left. */
static size_t separate(scene *s, const sunder_conflict **conflict)
{
    size_t n;
    scene_separate(s);
    *conflict = sunder_report_conflicts(s->report, &n);
    return n;
}

/* Two squares with limit 0.2, which would have to move 0.5 each. */
static void a_longer_limit(void **state)
{
    (void)state;
    scene s;
    begin(&s, 0);
    add_box(&s, 0, 0, 2, 2, 0.2);
    add_box(&s, 1, 0, 2, 2, 0.2);
    const sunder_conflict *conflict;
    assert_int_equal(separate(&s, &conflict), 1);
    assert_int_equal(conflict[0].reason, SUNDER_REASON_MAX_SHIFT);
    assert_true(conflict[0].need_shift >= 0.5 && conflict[0].need_shift < 0.5 + 1e-9);
    assert_true(isnan(conflict[0].need_gap) && conflict[0].need_gone == SIZE_MAX);
    scene_end(&s);
}

/* A box of width 2 between walls 4 apart, at a gap of 1.5: a gap of 1 would do, and without it the box would have to
 * jump over the right wall. */
static void a_smaller_gap(void **state)
{
    (void)state;
    scene s;
    begin(&s, 1.5);
    add_box(&s, -2, -20, 2, 40, 0);
    add_box(&s, 1.125, -1, 2, 2, 1);
    add_box(&s, 4, -20, 2, 40, 0);
    const sunder_conflict *conflict;
    assert_int_equal(separate(&s, &conflict), 2);
    for (size_t k = 0; k < 2; k++) {
        const sunder_conflict *c = &conflict[k];
        assert_int_equal(c->reason, SUNDER_REASON_NO_ROOM);
        assert_true(c->need_gap >= 0.985 && c->need_gap <= 1);
        assert_int_equal(c->need_gone, c->a == 0 ? 2 : 0);
        assert_true(c->need_shift >= 6.375 && c->need_shift < 6.4);
    }
    scene_end(&s);
}

/* Two boxes between walls that leave room for one, unless one moves above the other. */
static void one_less(void **state)
{
    (void)state;
    scene s;
    begin(&s, 0);
    add_box(&s, -2, -400, 2, 800, 0);
    add_box(&s, 3.25, -400, 2, 800, 0);
    add_box(&s, 0, 0, 2, 2, 0.9);
    add_box(&s, 1, 0, 2, 2, 0.9);
    const sunder_conflict *conflict;
    assert_int_equal(separate(&s, &conflict), 1);
    assert_int_equal(conflict[0].reason, SUNDER_REASON_NO_ROOM);
    assert_int_equal(conflict[0].a, 2);
    assert_int_equal(conflict[0].need_gone, 0);
    assert_true(conflict[0].need_shift > 0.9 && conflict[0].need_shift <= 2);
    scene_end(&s);
}

/* At effort 0 no such questions are asked. */
static void nothing_asked(void **state)
{
    (void)state;
    scene s;
    begin(&s, 0);
    s.options.effort = 0;
    add_box(&s, 0, 0, 2, 2, 0.2);
    add_box(&s, 1, 0, 2, 2, 0.2);
    const sunder_conflict *conflict;
    assert_int_equal(separate(&s, &conflict), 1);
    assert_true(isnan(conflict[0].need_shift) && conflict[0].need_gone == SIZE_MAX);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_longer_limit), cmocka_unit_test(a_smaller_gap),
                                       cmocka_unit_test(one_less), cmocka_unit_test(nothing_asked)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
