/* How things stand at the start: of some alone, and what a pair that is left is held to. */
#include "random.h"
#include "scene_model.h"

#include "base/memory.h"
#include "displacement/layer/relaxation.h"
#include "displacement/layer/requirement.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

/* Boxes that overlap, touch, lie in each other, and stand nearer than the gap or farther. */
static void draw_scene(rng *g, scene *s)
{
    scene_begin(s, 2);
    s->options.no_blocks = true;
    const size_t n = (size_t)rng_int(g, 2, 24);
    for (size_t k = 0; k < n; k++)
        scene_add_box(s, (double)rng_int(g, 0, 40), (double)rng_int(g, 0, 40), 1 + 9 * rng_unit(g),
                      1 + 9 * rng_unit(g));
    for (size_t k = 0; k < n; k++) s->feature[k].fixed = rng_once_in(g, 2);
}

/* Those of a few are all of which one is among them, and no others. */
static void test_relations_of_some(void **state)
{
    (void)state;
    for (size_t round = 0; round < test_count(60); round++) {
        rng g = rng_start(test_seed(), 100 + round);
        scene s;
        scene_model m;
        sunder_i_changes some;
        sunder_i_relations found;
        sunder_error err;
        draw_scene(&g, &s);
        scene_model_related(&m, &s);
        assert_true(sunder_i_changes_init(&some, m.model.things));
        for (uint32_t f = 0; f < m.model.features; f++)
            if (!s.feature[f].fixed) sunder_i_changes_add(&some, f);
        assert_true(sunder_i_changes_sort(&some));
        assert_int_equal(sunder_i_placement_relate(&m.model, &m.placement, &some, NULL, &found, &err), SUNDER_OK);
        size_t n = 0;
        for (size_t k = 0; k < m.start.n; k++) {
            const sunder_i_relation *r = &m.start.pair[k];
            if (!some.is[r->a] && !some.is[r->b]) continue;
            assert_true(n < found.n && found.pair[n].a == r->a && found.pair[n].b == r->b);
            assert_true(found.pair[n].overlap == r->overlap && found.pair[n].near == r->near);
            n++;
        }
        assert_true(n == found.n);
        sunder_i_changes_free(&some);
        sunder_i_free(found.pair);
        scene_model_end(&m);
        scene_end(&s);
    }
}

/* What a relaxation holds a pair to, taken a little below, is what it had, and never more: its distance, or a way out
 * of each other. */
static void test_below_what_it_had(void **state)
{
    (void)state;
    size_t apart = 0, deep = 0;
    for (size_t round = 0; round < test_count(60); round++) {
        rng g = rng_start(test_seed(), 200 + round);
        scene s;
        scene_model m;
        sunder_error err;
        draw_scene(&g, &s);
        scene_model_related(&m, &s);
        for (size_t k = 0; k < m.start.n; k++) {
            const sunder_i_relation *r = &m.start.pair[k];
            sunder_i_relaxation relaxation;
            sunder_i_requirement exact;
            if (r->contained || !sunder_i_is_conflict_of_bodies(&m.model, r)) continue;
            assert_int_equal(sunder_i_relaxation_of(&m.model, r->a, r->b, &relaxation, &err), SUNDER_OK);
            assert_int_equal(sunder_i_requirement_find(&m.model, &m.start, r->a, r->b, &exact, &err), SUNDER_OK);
            const sunder_i_requirement below = sunder_i_requirement_below(&m.model, &relaxation);
            assert_true(below.clearance <= exact.clearance);
            assert_true(below.clearance >= exact.clearance - 1e-9);
            assert_true((below.clearance < 0) == r->overlap);
            *(r->overlap ? &deep : &apart) += 1;
        }
        scene_model_end(&m);
        scene_end(&s);
    }
    assert_true(apart > 10 && deep > 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_relations_of_some),
                                       cmocka_unit_test(test_below_what_it_had)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
