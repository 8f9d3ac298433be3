/* displacement/prove/proofs/plane_kept: a further question about the same bodies of a small layer has the same answer
 * with the cache as without, for the same effort, whatever was asked before. */
#include "random.h"
#include "scene_model.h"

#include "displacement/prove/proofs/feasibility.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { LAYERS = 80, QUESTIONS = 60, MOVING = 6, STANDING = 6 };

typedef struct layer {
    scene scene;
    scene_model of;
} layer;

static int64_t draw_block(rng *r) { return rng_once_in(r, 3) ? -1 : rng_int(r, 0, 1); }

/* A box with an obtuse gable: coarse lines, each of which replaces several, cut its tip off. */
static sunder_feature *add_house(rng *r, scene *s)
{
    char wkt[200];
    const double x = (double)rng_int(r, 0, 40) / 4, y = (double)rng_int(r, 0, 40) / 4,
                 w = (double)rng_int(r, 1, 12) / 4, h = (double)rng_int(r, 1, 12) / 4;
    snprintf(wkt, sizeof wkt, "POLYGON ((%.4f %.4f, %.4f %.4f, %.4f %.4f, %.4f %.4f, %.4f %.4f, %.4f %.4f))", x, y,
             x + w, y, x + w, y + h, x + w / 2, y + h + 0.125, x, y + h, x, y);
    return scene_add(s, wkt);
}

/* A crowd of houses: more bodies than the cache holds, some of them blocks, some without a limit, and some fixed. */
static void begin(rng *r, layer *l)
{
    memset(l, 0, sizeof *l);
    scene_begin(&l->scene, 1);
    l->scene.options.allow_jumps = rng_once_in(r, 2);
    for (int k = 0; k < MOVING + STANDING; k++) {
        sunder_feature *f = add_house(r, &l->scene);
        f->fixed = k >= MOVING;
        f->max_shift = (double)rng_int(r, 2, 8);
        f->block = f->fixed ? -1 : draw_block(r);
    }
    scene_model_related(&l->of, &l->scene);
}

static void end(layer *l)
{
    scene_model_end(&l->of);
    scene_end(&l->scene);
}

/* Draws a question: one of three movable bodies and another body or a fixed one, under some of the rules, with only
 * some features considered, and with a reduced requirement for some pair. */
static void draw_question(rng *r, const layer *l, uint32_t body[2], uint32_t *feature, sunder_i_requirement *required,
                          sunder_i_subproblem *q)
{
    const uint32_t a = (uint32_t)rng_int(r, 0, 2), b = (uint32_t)rng_int(r, 1, MOVING);
    body[0] = l->of.model.body_of[a];
    body[1] = l->of.model.body_of[b];
    *q = (sunder_i_subproblem){
        .model = &l->of.model, .body = body, .bodies = 2, .a = SUNDER_I_NOBODY, .b = SUNDER_I_NOBODY, .most = 8};
    if (body[0] == body[1]) q->bodies = 1;
    q->effort = rng_once_in(r, 4) ? 2000 : 200000;
    q->coarse = rng_once_in(r, 2) ? 0x1p-5 : 0;
    q->any_jump = rng_once_in(r, 3);
    q->heed_paths = rng_once_in(r, 3);
    if (rng_once_in(r, 2)) {
        for (uint32_t f = 0; f < l->scene.n; f++)
            if (f == a || f == b || rng_once_in(r, 2)) feature[q->features++] = f;
        q->feature = feature;
    }
    if (rng_once_in(r, 2)) {
        const uint32_t f = (uint32_t)rng_int(r, 0, MOVING - 1), g = (uint32_t)rng_int(r, MOVING, MOVING + STANDING - 1);
        *required = (sunder_i_requirement){.a = f, .b = g, .clearance = (double)rng_int(r, 0, 3) / 4};
        q->required = required;
        q->required_n = 1;
    }
}

static void expect_same(const sunder_i_decision *kept, const sunder_i_decision *anew)
{
    assert_int_equal(kept->verdict, anew->verdict);
    assert_int_equal(kept->work, anew->work);
    assert_int_equal(kept->no_plane, anew->no_plane);
    assert_int_equal(kept->solution.bodies, anew->solution.bodies);
    for (size_t k = 0; k < kept->solution.bodies; k++) {
        assert_int_equal(kept->solution.body[k], anew->solution.body[k]);
        for (size_t x = 0; x < 2; x++) assert_true(kept->solution.move[2 * k + x] == anew->solution.move[2 * k + x]);
    }
    assert_true(!kept->proof == !anew->proof);
    if (!kept->proof) return;
    assert_int_equal(kept->proof->nodes, anew->proof->nodes);
    for (size_t k = 0; k < kept->proof->nodes; k++) {
        assert_int_equal(kept->proof->node[k].a, anew->proof->node[k].a);
        assert_int_equal(kept->proof->node[k].b, anew->proof->node[k].b);
        assert_int_equal(kept->proof->node[k].ways, anew->proof->node[k].ways);
    }
}

/* Asks with the cache and without it. */
static void ask_both(sunder_i_subproblem *q, sunder_i_planes *planes, size_t *told)
{
    sunder_i_decision kept, anew;
    sunder_error err;
    assert_int_equal(sunder_i_decide(q, &anew, &err), SUNDER_OK);
    q->planes = planes;
    assert_int_equal(sunder_i_decide(q, &kept, &err), SUNDER_OK);
    expect_same(&kept, &anew);
    told[kept.verdict]++;
    sunder_i_decision_clear(&kept);
    sunder_i_decision_clear(&anew);
}

static void check_questions(rng *r, const layer *l, size_t *told)
{
    sunder_i_planes planes = {0};
    for (int k = 0; k < QUESTIONS; k++) {
        uint32_t body[2], feature[MOVING + STANDING];
        sunder_i_requirement required;
        sunder_i_subproblem q;
        draw_question(r, l, body, feature, &required, &q);
        ask_both(&q, &planes, told);
    }
    sunder_i_planes_clear(&planes);
}

static void test_questions(void **state)
{
    size_t told[3] = {0};
    (void)state;
    for (uint64_t k = 0; k < LAYERS; k++) {
        rng r = rng_start(11, k);
        layer l;
        begin(&r, &l);
        check_questions(&r, &l, told);
        end(&l);
    }
    assert_true(told[SUNDER_I_INFEASIBLE] > LAYERS && told[SUNDER_I_FEASIBLE] > LAYERS);
}

/* ---- Two blocks of many houses ----------------------------------------------------------------------------------- */

enum { HOUSES = 30, CROWDS = 6, CROWD_QUESTIONS = 40 };

/* Two blocks that interpenetrate: houses of the one are between those of the other, or overlap them. So hundreds of
 * pieces and shadows are in the plane of their relative move, which then uses a tree. */
static void begin_crowd(rng *r, layer *l)
{
    memset(l, 0, sizeof *l);
    scene_begin(&l->scene, 0.25);
    l->scene.options.no_blocks = true;
    l->scene.options.contained = SUNDER_CONTAINMENT_SEPARATE;
    for (int k = 0; k < 2 * HOUSES; k++) {
        sunder_feature *f = scene_add_box(&l->scene, (double)rng_int(r, 0, 96) / 4, (double)rng_int(r, 0, 96) / 4,
                                          (double)rng_int(r, 4, 16) / 4, (double)rng_int(r, 4, 16) / 4);
        f->block = k % 2;
        f->max_shift = 5;
    }
    scene_model_related(&l->of, &l->scene);
}

/* A question about a random pair, with all or some of the houses, where others have no requirement or a small one. */
static void check_crowd(rng *r, const layer *l, size_t *told)
{
    sunder_i_planes planes = {0};
    uint32_t feature[2 * HOUSES];
    const uint32_t body[2] = {l->of.model.body_of[0], l->of.model.body_of[1]};
    sunder_i_requirement required[HOUSES * HOUSES];
    size_t n = 0;
    for (uint32_t f = 0; f < 2 * HOUSES; f++)
        for (uint32_t g = f + 1; g < 2 * HOUSES; g += 2)
            required[n++] = (sunder_i_requirement){.a = f, .b = g, .clearance = rng_once_in(r, 12) ? 0 : -INFINITY};
    for (int k = 0; k < CROWD_QUESTIONS; k++) {
        sunder_i_subproblem q = {.model = &l->of.model, .body = body, .bodies = 2, .most = 2, .required = required};
        q.required_n = n;
        q.a = 2 * (uint32_t)rng_int(r, 0, HOUSES - 1);
        q.b = 2 * (uint32_t)rng_int(r, 0, HOUSES - 1) + 1;
        if (q.a > q.b) {
            const uint32_t a = q.a;
            q.a = q.b;
            q.b = a;
        }
        q.coarse = rng_once_in(r, 2) ? 0x1p-8 : 0;
        const bool all = rng_once_in(r, 3);
        for (uint32_t f = 0; f < 2 * HOUSES; f++)
            if (all || f == q.a || f == q.b || !rng_once_in(r, 4)) feature[q.features++] = f;
        q.feature = feature;
        ask_both(&q, &planes, told);
    }
    sunder_i_planes_clear(&planes);
}

static void test_crowds(void **state)
{
    size_t told[3] = {0};
    (void)state;
    for (uint64_t k = 0; k < CROWDS; k++) {
        rng r = rng_start(12, k);
        layer l;
        begin_crowd(&r, &l);
        check_crowd(&r, &l, told);
        end(&l);
    }
    assert_true(told[SUNDER_I_INFEASIBLE] > CROWDS && told[SUNDER_I_FEASIBLE] > CROWDS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_questions), cmocka_unit_test(test_crowds)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
