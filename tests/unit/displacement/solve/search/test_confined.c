/* displacement/solve/search/confined: for two bodies that are shut in, the search for places is limited to the distance
 * of possible free places; the places found are the same. */
#include "random.h"
#include "scene_model.h"

#include "displacement/prove/optimum/forbidden.h"
#include "displacement/solve/search/search_stages.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { YARDS = 40 };

static const double margin = 0x1p-30;

/* A house in a courtyard that is too small for it, as near to one side as allowed: all conflicts are left as they
 * are. */
static void begin(rng *r, scene *s, scene_model *of)
{
    const double width = 2.5 + rng_unit(r), height = 2.5 + rng_unit(r);
    scene_begin(s, 1);
    scene_add_box(s, -1, -1, 1, height + 2)->block = 0;
    scene_add_box(s, width, -1, 1, height + 2)->block = 0;
    scene_add_box(s, 0, -1, width, 1)->block = 0;
    scene_add_box(s, 0, height, width, 1)->block = 0;
    scene_add_box(s, (width - 2) * rng_unit(r), (height - 2) * rng_unit(r), 2, 2)->block = 1;
    scene_model_related(of, s);
    sunder_i_model *model = &of->model;
    for (size_t k = 0; k < of->start.n; k++) {
        sunder_i_relaxation t;
        sunder_error err;
        if (!sunder_i_is_open_conflict(model, &of->start.pair[k])) continue;
        assert_int_equal(sunder_i_relaxation_of(model, of->start.pair[k].a, of->start.pair[k].b, &t, &err), SUNDER_OK);
        assert_true(sunder_i_relaxations_add(&model->relaxations, &t));
    }
    assert_true(sunder_i_relaxations_index(&model->relaxations, model));
}

/* The place beside the other body that is nearest to the target, if any, and the number of steps to find it. */
static size_t find(const scene_model *of, const double target[2], double place[2], uint64_t *steps)
{
    static const uint32_t body[2] = {0, 1};
    static const double move[4] = {0};
    double places[1][2] = {{0, 0}};
    sunder_i_search s;
    assert_true(sunder_i_search_init(&s, &of->model, body, 2, margin, move));
    const size_t n = sunder_i_search_free_pair(&s, 0, 1, target, 0, 1, places);
    assert_false(s.failed);
    *steps = s.steps;
    memcpy(place, places[0], sizeof places[0]);
    sunder_i_search_free(&s);
    return n;
}

/* Compares the places that are found with and without the knowledge that the two are shut in. */
static void compare(rng *r, scene_model *of, size_t found[2], uint64_t all[2])
{
    sunder_i_id_pair two = {0, 1};
    const double target[2] = {2 * rng_unit(r) - 1, 2 * rng_unit(r) - 1};
    double place[2][2];
    uint64_t steps[2];
    const size_t n = find(of, target, place[0], &steps[0]);
    of->model.confined = &two;
    of->model.confined_n = 1;
    assert_int_equal(find(of, target, place[1], &steps[1]), n);
    of->model.confined = NULL;
    of->model.confined_n = 0;
    assert_memory_equal(place[0], place[1], sizeof place[0]);
    found[n]++;
    for (size_t k = 0; k < 2 && !n; k++) all[k] += steps[k];
}

static void test_yards(void **state)
{
    size_t found[2] = {0};
    uint64_t all[2] = {0};
    for (uint64_t k = 0; k < YARDS; k++) {
        rng r = rng_start(51, k);
        scene s;
        scene_model of;
        bool shut = false;
        begin(&r, &s, &of);
        if (of.model.bodies == 2) /* a house that touches a wall is in one block with it */
            assert_true(sunder_i_is_shut_in(&of.model, 0, 1, &shut));
        if (shut) compare(&r, &of, found, all);
        scene_model_end(&of);
        scene_end(&s);
    }
    assert_true(found[0] > 20);
    assert_true(4 * all[1] < 3 * all[0]);
    (void)state;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_yards)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
