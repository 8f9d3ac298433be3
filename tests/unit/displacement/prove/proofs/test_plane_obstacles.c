/* displacement/prove/proofs/plane_obstacles: the set shadowed by an obstacle lies in the box that is known before its
 * ways are made. Ways are made only for obstacles near the places asked about. */
#include "random.h"
#include "scene_model.h"

#include "displacement/prove/proofs/plane.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

enum { LAYERS = 40, HOUSES = 10 };

typedef struct two {
    scene scene;
    scene_model of;
    uint32_t body[2];
    sunder_i_subproblem asked;
} two;

/* A triangle of random orientation. */
static void add_house(rng *r, scene *s, int64_t block, double limit)
{
    char wkt[300];
    const double x = 40 * rng_unit(r), y = 40 * rng_unit(r), turn = 6.3 * rng_unit(r), size = 0.5 + 4 * rng_unit(r);
    double at[3][2];
    for (int k = 0; k < 3; k++) {
        at[k][0] = x + size * cos(turn + 2.1 * k);
        at[k][1] = y + size * sin(turn + 2.1 * k);
    }
    snprintf(wkt, sizeof wkt, "POLYGON ((%.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g))", at[0][0], at[0][1],
             at[1][0], at[1][1], at[2][0], at[2][1], at[0][0], at[0][1]);
    sunder_feature *f = scene_add(s, wkt);
    f->block = block;
    f->max_shift = limit;
}

static void begin(rng *r, two *l)
{
    const double limit = 1 + 20 * rng_unit(r);
    scene_begin(&l->scene, rng_once_in(r, 2) ? 0 : rng_unit(r));
    l->scene.options.no_blocks = true;
    for (int k = 0; k < 2 * HOUSES; k++) add_house(r, &l->scene, k % 2, limit);
    scene_model_related(&l->of, &l->scene);
    l->body[0] = 0;
    l->body[1] = 1;
    l->asked = (sunder_i_subproblem){.model = &l->of.model, .body = l->body, .bodies = 2, .most = 2};
    l->asked.a = l->asked.b = SUNDER_I_NOBODY;
}

static void end(two *l)
{
    scene_model_end(&l->of);
    scene_end(&l->scene);
}

static void test_boxes(void **state)
{
    size_t shadows = 0, pieces = 0, beyond = 0;
    for (uint64_t k = 0; k < LAYERS; k++) {
        rng r = rng_start(41, k);
        two l;
        begin(&r, &l);
        sunder_i_branching c = {.subproblem = &l.asked, .model = &l.of.model};
        sunder_i_plane g = {.c = &c, .p = l.body[0], .q = l.body[1]};
        sunder_i_planes planes = {0};
        sunder_i_branching_join(&c, g.p);
        sunder_i_branching_join(&c, g.q);
        g.reach = c.limit[0] + c.limit[1];
        sunder_i_plane_disc(&g.disc, g.reach);
        g.kept = sunder_i_planes_take(&planes, &g);
        assert_non_null(g.kept);
        for (size_t o = 0; o < g.kept->n; o++) {
            sunder_i_plane_obstacle *it = &g.kept->obstacle[o];
            double bound[4], *box = g.kept->box + 4 * o;
            it->clearance = it->shadow ? 0 : (double)rng_int(&r, -2, 4) / 4;
            sunder_i_plane_bound(&g, it, it->clearance, bound);
            memcpy(box, bound, sizeof bound);
            assert_true(sunder_i_plane_make_half_planes(&g, o));
            if (it->half_planes == 0) {
                beyond += bound[0] <= bound[2];
                continue;
            }
            *(it->shadow ? &shadows : &pieces) += 1;
            assert_true(bound[0] <= box[0] && bound[1] <= box[1] && box[2] <= bound[2] && box[3] <= bound[3]);
        }
        sunder_i_planes_clear(&planes);
        sunder_i_half_planes_forget(&c.kept);
        sunder_i_free(c.body);
        sunder_i_free(c.t);
        sunder_i_free(c.limit);
        sunder_i_free(c.shift);
        sunder_i_free(c.net);
        sunder_i_free(c.weight);
        sunder_i_free(c.scratch);
        sunder_i_free(c.near.item);
        end(&l);
    }
    assert_true(shadows > 1000 && pieces > 1000 && beyond < shadows + pieces);
    (void)state;
}

static void test_made(void **state)
{
    size_t made = 0, all = 0;
    for (uint64_t k = 0; k < LAYERS; k++) {
        rng r = rng_start(42, k);
        two l;
        begin(&r, &l);
        sunder_i_planes planes = {0};
        sunder_i_decision decision;
        sunder_error err;
        l.asked.planes = &planes;
        assert_int_equal(sunder_i_decide(&l.asked, &decision, &err), SUNDER_OK);
        const struct sunder_i_plane_kept *kept = planes.plane[0];
        for (size_t o = 0; o < kept->n; o++) made += kept->obstacle[o].made;
        all += kept->items;
        sunder_i_decision_clear(&decision);
        sunder_i_planes_clear(&planes);
        end(&l);
    }
    assert_true(made > 0 && 2 * made < all);
    (void)state;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_boxes), cmocka_unit_test(test_made)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
