/* displacement/solve/search/cheapest: a solution is reported as the cheapest only if no other start leads to a cheaper
 * one, and usually whenever that is true. If it is not reported, nothing is changed. */
#include "random.h"
#include "scene_board.h"

#include "displacement/solve/search/search_stages.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 5, STARTS = 60 };

static const double margin = 0x1p-40;

static double cost_of(const scene_board *b)
{
    double cost = 0;
    for (size_t k = 0; k < b->scene.n; k++)
        cost +=
            b->of.model.body[k].weight * (b->move[2 * k] * b->move[2 * k] + b->move[2 * k + 1] * b->move[2 * k + 1]);
    return cost;
}

static sunder_i_cluster cluster_of(scene_board *b)
{
    return (sunder_i_cluster){.body = b->body, .n = b->scene.n, .margin = margin};
}

/* Adds a box, a triangle, or an L of two boxes. */
static void add_any(rng *r, scene *s)
{
    char wkt[400];
    const double x = 8 * rng_unit(r), y = 8 * rng_unit(r), w = 1 + 4 * rng_unit(r), h = 1 + 4 * rng_unit(r);
    const double tilt = rng_unit(r);
    const int kind = (int)rng_int(r, 0, 3);
    if (kind == 0)
        snprintf(wkt, sizeof wkt, "POLYGON ((%.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g))", x, y, x + w,
                 y + tilt, x + tilt * w, y + h, x, y);
    else if (kind == 1)
        snprintf(
            wkt, sizeof wkt,
            "POLYGON ((%.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g))", x,
            y, x + w, y, x + w, y + h / 2, x + w / 2, y + h / 2, x + w / 2, y + h, x, y + h, x, y);
    else
        snprintf(wkt, sizeof wkt, "POLYGON ((%.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g))", x, y,
                 x + w, y + tilt, x + w - tilt, y + tilt + h, x - tilt, y + h, x, y);
    scene_add(s, wkt)->weight = rng_once_in(r, 3) ? 0.25 + rng_unit(r) : 1;
    s->feature[s->n - 1].fixed = s->n > 1 && rng_once_in(r, 8);
}

/* Is there a start from which the descent reaches a lower cost? */
static bool is_beaten(rng *r, scene_board *b, double cost)
{
    sunder_error err;
    sunder_i_cluster cluster = cluster_of(b);
    for (int k = 0; k < STARTS; k++) {
        bool found;
        for (size_t m = 0; m < b->scene.n; m++)
            for (int c = 0; c < 2; c++)
                b->move[2 * m + (size_t)c] = b->scene.feature[m].fixed ? 0 : 12 * rng_unit(r) - 6;
        assert_int_equal(sunder_i_cluster_descend(&b->of.model, &cluster, cost, b->move, &found, &err), SUNDER_OK);
        if (found) return true;
    }
    return false;
}

static void test_nothing_is_cheaper(void **state)
{
    (void)state;
    size_t said = 0, beaten = 0, all = test_count(150);
    for (size_t k = 0; k < all; k++) {
        rng r = rng_start(test_seed(), k);
        const size_t n = (size_t)rng_int(&r, 2, MOST);
        scene_board b;
        sunder_error err;
        memset(&b, 0, sizeof b);
        scene_begin(&b.scene, rng_once_in(&r, 4) ? 0 : 2 * rng_unit(&r));
        for (size_t m = 0; m < n; m++) add_any(&r, &b.scene);
        b.scene.options.effort = 0;
        scene_board_begin(&b);
        sunder_i_cluster cluster = cluster_of(&b);
        assert_int_equal(sunder_i_cluster_solve(&b.of.model, &cluster, b.move, &err), SUNDER_OK);
        const double cost = cost_of(&b);
        const bool better = is_beaten(&r, &b, cost * (1 - 1e-6) - 1e-12);
        const bool cheapest = cluster.outcome == SUNDER_I_FOUND_CHEAPEST;
        said += cheapest;
        beaten += better;
        assert_false(cheapest && better);
        sunder_i_relaxations_free(&cluster.relaxations);
        sunder_i_free(cluster.restored);
        scene_board_end(&b);
    }
    /* Both cases occurred: solutions that are the cheapest, and solutions that are not. */
    assert_true(10 * said > 3 * all && beaten > 0);
}

/* Two boxes that overlap less along x than along y, and are separated along y. */
static void test_the_wrong_side(void **state)
{
    (void)state;
    scene_board b;
    memset(&b, 0, sizeof b);
    scene_begin(&b.scene, 1);
    scene_add_box(&b.scene, 0, 0, 10, 4);
    scene_add_box(&b.scene, 9, 1, 10, 4);
    b.scene.options.effort = 0;
    scene_board_begin(&b);
    for (int side = 0; side < 2; side++) {
        sunder_i_search s;
        const double x = side ? 0 : 1, y = side ? 2 : 0;
        const double move[4] = {-x, -y, x + margin, y + margin};
        assert_true(sunder_i_search_init(&s, &b.of.model, b.body, 2, margin, move));
        assert_true(sunder_i_search_descend(&s));
        const double stood[2] = {s.t[2], s.t[3]};
        const uint64_t work = sunder_i_search_work(&s);
        const size_t n = s.program.n;
        assert_true(sunder_i_search_is_cheapest(&s) == (side == 0));
        if (side) {
            assert_true(s.t[2] == stood[0] && s.t[3] == stood[1]);
            assert_true(sunder_i_search_work(&s) == work && s.program.n == n);
        }
        sunder_i_search_free(&s);
    }
    scene_board_end(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nothing_is_cheaper),
        cmocka_unit_test(test_the_wrong_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
