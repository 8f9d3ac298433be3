/* displacement/solve/search/retry_cluster: a given-up pair is tried again, even if another pair is slightly too near
 * for the search and cannot be separated. */
#include "scene_board.h"

#include "displacement/solve/search/cluster.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static const double margin = 0x1p-30;

/* Two bodies that overlap by 2, were given up, and can be separated; and another two that are too near by a few
 * tolerances, one of them fixed and the other hardly movable. Is the first pair resolved? */
static bool is_granted(double missed)
{
    scene_board b;
    memset(&b, 0, sizeof b);
    scene_begin(&b.scene, 0);
    const double x[] = {0, 8, 100, 110 + margin * (1 - missed / 4)};
    for (size_t k = 0; k < sizeof x / sizeof *x; k++) {
        sunder_feature *f = scene_add_box(&b.scene, x[k], 0, 10, 10);
        f->max_shift = k < 2 ? 1.5 : 0x1p-44;
        f->fixed = k == 2;
    }
    scene_board_begin(&b);
    sunder_i_model *model = &b.of.model;
    sunder_i_relaxation t;
    sunder_error err;
    assert_int_equal(sunder_i_relaxation_of(model, 0, 1, &t, &err), SUNDER_OK);
    assert_true(sunder_i_relaxations_add(&model->relaxations, &t) &&
                sunder_i_relaxations_index(&model->relaxations, model));
    const uint32_t relaxation = 0;
    const sunder_i_retry retry = {
        .body = {0, 1}, .relaxation = &relaxation, .relaxations = 1, .overlap = true, .resolve = true, .missing = 2};
    sunder_i_cluster cluster = {.body = b.body, .n = b.scene.n, .margin = margin, .limited = true};
    assert_int_equal(sunder_i_cluster_retry(model, &cluster, &retry, 1, b.move, &err), SUNDER_OK);
    const bool granted = cluster.restored_n > 0;
    if (granted) assert_true(x[1] + b.move[2] - x[0] - b.move[0] >= 10);
    sunder_i_relaxations_free(&cluster.relaxations);
    sunder_i_free(cluster.restored);
    scene_board_end(&b);
    return granted;
}

static void test_in_order(void **state)
{
    (void)state;
    assert_true(is_granted(0));
    assert_true(is_granted(0.9));
}

static void test_a_hair_beside(void **state)
{
    (void)state;
    assert_true(is_granted(1.3));
}

/* A position with violations above rounding is not accepted as a start. */
static void test_out_of_order(void **state)
{
    (void)state;
    assert_false(is_granted(3));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_in_order), cmocka_unit_test(test_a_hair_beside),
                                       cmocka_unit_test(test_out_of_order)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
