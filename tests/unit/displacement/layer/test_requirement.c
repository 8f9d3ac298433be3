/* The relations of features and barriers at the start, also for a subset of them, and the requirement on a pair that is
 * left in conflict. */
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

/* Boxes that overlap, touch, contain each other, or are nearer or farther than the gap. */
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

/* The relations of a subset are all relations with a member of it, and no others. */
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
        assert_int_equal(sunder_i_placement_relate(&m.model, &m.placement, &some, &found, &err), SUNDER_OK);
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

/* Moves some bodies, far or slightly; lists those that moved, sorted, and their neighbours. */
static void move_some(rng *g, scene_model *m, sunder_i_changes *changes, sunder_i_list *about)
{
    sunder_error err;
    const bool aside = rng_once_in(g, 2);
    sunder_i_changes_clear(changes);
    for (size_t b = 0; b < m->model.bodies; b++) {
        if (!rng_once_in(g, 3)) continue;
        for (size_t c = 0; c < 2; c++) {
            double *t = &m->model.move[2 * b + c];
            *t = aside ? *t + (double)rng_int(g, -1, 1) / 1024 : (double)rng_int(g, -40, 40) / 8;
        }
        const sunder_i_body *body = &m->model.body[b];
        for (uint32_t k = 0; k < body->members; k++) sunder_i_changes_add(changes, m->model.member[body->member + k]);
    }
    assert_true(sunder_i_changes_sort(changes));
    about->n = 0;
    for (size_t k = 0; k < changes->list.n; k++) {
        const uint32_t f = changes->list.item[k];
        if (m->model.present[f]) assert_true(sunder_i_placement_near(&m->model, &m->placement, f, about));
    }
    about->n = sunder_i_set_make(about->item, about->n);
    assert_int_equal(sunder_i_placement_move(&m->model, &m->placement, changes, &err), SUNDER_OK);
}

static bool are_alike(const sunder_i_relation *a, const sunder_i_relation *b)
{
    return a->a == b->a && a->b == b->b && a->near == b->near && a->touch == b->touch && a->overlap == b->overlap &&
           a->contained == b->contained && a->kept == b->kept;
}

/* Relations that are updated, move after move, equal those computed from scratch, whether the neighbours are given or
 * not. */
static void test_brought_up_to_date(void **state)
{
    (void)state;
    size_t most = 0;
    for (size_t round = 0; round < test_count(60); round++) {
        rng g = rng_start(test_seed(), 300 + round);
        scene s;
        scene_model m;
        sunder_i_changes changes;
        sunder_i_relations kept, fresh;
        sunder_i_list about = {0};
        sunder_error err;
        draw_scene(&g, &s);
        scene_model_related(&m, &s);
        assert_true(sunder_i_changes_init(&changes, m.model.things));
        assert_int_equal(sunder_i_placement_relate(&m.model, &m.placement, NULL, &kept, &err), SUNDER_OK);
        for (int step = 0; step < 12; step++) {
            move_some(&g, &m, &changes, &about);
            const sunder_i_list *things = rng_once_in(&g, 4) ? NULL : &about;
            assert_int_equal(sunder_i_placement_relate_again(&m.model, &m.placement, &changes, things, &kept, &err),
                             SUNDER_OK);
            assert_int_equal(sunder_i_placement_relate(&m.model, &m.placement, NULL, &fresh, &err), SUNDER_OK);
            assert_int_equal(kept.n, fresh.n);
            for (size_t k = 0; k < kept.n; k++) assert_true(are_alike(&kept.pair[k], &fresh.pair[k]));
            most = kept.n > most ? kept.n : most;
            sunder_i_free(fresh.pair);
        }
        sunder_i_free(about.item);
        sunder_i_free(kept.pair);
        sunder_i_changes_free(&changes);
        scene_model_end(&m);
        scene_end(&s);
    }
    assert_true(most > 20);
}

/* The requirement of a relaxation, slightly reduced, is satisfied at the start and is never stricter than the full one:
 * it is the former distance, or a way out of the overlap. */
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
                                       cmocka_unit_test(test_brought_up_to_date),
                                       cmocka_unit_test(test_below_what_it_had)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
