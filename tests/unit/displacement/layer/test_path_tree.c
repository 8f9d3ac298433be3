/* The bodies whose paths from their original places come near a box: compares the tree with a loop over all bodies, for
 * small, large and reversed moves, and for features that move on their own. */
#include "random.h"
#include "scene_model.h"

#include "displacement/layer/path_tree.h"
#include "spatial/box.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static void ask(rng *r, const sunder_i_path_tree *ways, const sunder_i_model *model)
{
    double box[4];
    sunder_i_list hits = {0};
    bool named[SCENE_MOST] = {0};
    for (int c = 0; c < 2; c++) {
        box[c] = (double)rng_int(r, -50, 250);
        box[c + 2] = box[c] + (double)rng_int(r, 0, 60);
    }
    assert_true(sunder_i_path_tree_look_about(ways, model, box, &hits));
    for (size_t k = 0; k < hits.n; k++) {
        assert_false(named[hits.item[k]]);
        named[hits.item[k]] = true;
    }
    for (uint32_t f = 0; f < model->features; f++) {
        double way[4];
        sunder_i_path_box(ways, model, f, way);
        assert_int_equal(named[f], model->present[f] && sunder_i_box_meet(way, box));
    }
    sunder_i_free(hits.item);
}

static void add_features(rng *r, scene *s, size_t n)
{
    for (size_t k = 0; k < n; k++)
        if (rng_once_in(r, 8))
            scene_add(s, NULL);
        else
            scene_add_box(s, (double)rng_int(r, 0, 200), (double)rng_int(r, 0, 200), 1 + (double)rng_int(r, 0, 9), 3);
}

/* Moves some bodies by up to `far`; returns the features that moved. */
static size_t move_some(rng *r, sunder_i_model *model, int64_t far, uint32_t *moved)
{
    size_t n = 0;
    for (size_t b = 0; b < model->bodies; b++) {
        if (!rng_once_in(r, 4)) continue;
        for (size_t c = 0; c < 2; c++)
            model->move[2 * b + c] = rng_once_in(r, 3) ? 0 : (double)rng_int(r, -far, far) / 7;
        const sunder_i_body *body = &model->body[b];
        for (uint32_t m = 0; m < body->members; m++) {
            const uint32_t f = model->member[body->member + m];
            if (model->present[f]) moved[n++] = f;
        }
    }
    return n;
}

static void try_layer(rng *r, size_t n)
{
    scene s;
    scene_model of;
    sunder_error err;
    uint32_t moved[SCENE_MOST];
    sunder_i_path_tree ways = {0};
    scene_begin(&s, 1);
    add_features(r, &s, n);
    scene_model_related(&of, &s);
    assert_int_equal(sunder_i_path_tree_begin(&ways, &of.model, &err), SUNDER_OK);
    for (int round = 0; round < 12; round++) {
        const size_t some = move_some(r, &of.model, rng_once_in(r, 4) ? 1500 : 30, moved);
        assert_int_equal(sunder_i_path_tree_follow(&ways, &of.model, moved, some, &err), SUNDER_OK);
        for (int k = 0; k < 20; k++) ask(r, &ways, &of.model);
    }
    sunder_i_path_tree_free(&ways);
    scene_model_end(&of);
    scene_end(&s);
}

static void test_bodies_move(void **state)
{
    (void)state;
    rng r = rng_start(test_seed(), 0);
    for (size_t k = 0; k < test_count(60); k++)
        try_layer(&r, rng_once_in(&r, 5) ? (size_t)rng_int(&r, 0, 2) : 40 + (size_t)rng_int(&r, 0, 39));
}

static void test_moves_of_their_own(void **state)
{
    (void)state;
    rng r = rng_start(test_seed(), 1);
    scene s;
    scene_model of;
    sunder_error err;
    double own[2 * SCENE_MOST];
    scene_begin(&s, 1);
    add_features(&r, &s, SCENE_MOST);
    scene_model_related(&of, &s);
    for (size_t k = 0; k < 2 * SCENE_MOST; k++) own[k] = (double)rng_int(&r, -3, 3);
    sunder_i_path_tree ways = {.own = own};
    assert_int_equal(sunder_i_path_tree_begin(&ways, &of.model, &err), SUNDER_OK);
    for (int k = 0; k < 200; k++) ask(&r, &ways, &of.model);
    sunder_i_path_tree_free(&ways);
    scene_model_end(&of);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_bodies_move), cmocka_unit_test(test_moves_of_their_own)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
