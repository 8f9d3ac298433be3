/* displacement/solve/clusters/contact_groups: groups that are unions of other groups keep the cost at which these were
 * perturbed, whether or not a bound was proved for them; parts of a group do not keep it. */
#include "scene_solver.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void gather(sunder_i_solver *s, size_t groups)
{
    sunder_error err;
    assert_int_equal(sunder_i_solver_gather_groups(s, &err), SUNDER_OK);
    assert_int_equal(s->groups.n, groups);
}

static void test_what_was_shaken(void **state)
{
    (void)state;
    scene layer;
    scene_model of;
    sunder_i_solver s;
    const double up[] = {0, 1};
    scene_begin(&layer, 1);
    layer.options.no_blocks = layer.options.allow_jumps = true;
    for (int pair = 0; pair < 2; pair++)
        for (int k = 0; k < 2; k++) scene_add_box(&layer, 100 * pair + 11 * k, 0, 10, 10);
    scene_model_related(&of, &layer);
    scene_solver_begin(&s, &of);
    sunder_i_solver_place(&s, 0, up);
    sunder_i_solver_place(&s, 2, up);
    gather(&s, 2);
    for (size_t k = 0; k < 2; k++) {
        assert_int_equal(s.groups.group[k].n, 2);
        assert_true(s.groups.group[k].shaken_at == 0);
        s.groups.group[k].shaken_at = 3 + (double)k;
    }
    s.groups.group[1].bound = 0.5;
    s.groups.joined = sunder_i_alloc(1, sizeof *s.groups.joined);
    assert_non_null(s.groups.joined);
    s.groups.joined[0] = (sunder_i_id_pair){1, 2};
    s.groups.joins = 1;
    for (int round = 0; round < 2; round++) { /* the second time nothing has changed */
        gather(&s, 1);
        assert_int_equal(s.groups.group[0].n, 4);
        assert_true(s.groups.group[0].shaken_at == 7 && s.groups.group[0].bound == 0.5);
    }
    s.groups.joins = 0;
    gather(&s, 2);
    for (size_t k = 0; k < 2; k++) assert_true(s.groups.group[k].shaken_at == 0 && s.groups.group[k].bound == 0);
    scene_solver_end(&s);
    scene_model_end(&of);
    scene_end(&layer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_what_was_shaken)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
