/* displacement/prove/proofs/precedents: a further question about the same bodies has the same answer if earlier answers
 * are used, with fewer steps; and if coarse lines do not prove a pair with some features, they do not prove it with
 * fewer features. */
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

enum { HOUSES = 30, THINGS = 2 * HOUSES, CROWDS = 8, QUESTIONS = 60 };

typedef struct crowd {
    scene scene;
    scene_model of;
    uint32_t body[2], feature[THINGS];
    sunder_i_requirement required[HOUSES * HOUSES];
    size_t required_n;
} crowd;

/* Two interlocking blocks. Most of their houses have no requirement, or a small one. */
static void begin(rng *r, crowd *c)
{
    memset(c, 0, sizeof *c);
    scene_begin(&c->scene, 0.25);
    c->scene.options.no_blocks = true;
    c->scene.options.contained = SUNDER_CONTAINMENT_SEPARATE;
    for (int k = 0; k < THINGS; k++) {
        sunder_feature *f = scene_add_box(&c->scene, (double)rng_int(r, 0, 180) / 4, (double)rng_int(r, 0, 180) / 4,
                                          (double)rng_int(r, 4, 16) / 4, (double)rng_int(r, 4, 16) / 4);
        f->block = k % 2;
        f->max_shift = 5;
    }
    scene_model_related(&c->of, &c->scene);
    for (uint32_t k = 0; k < 2; k++) c->body[k] = c->of.model.body_of[k];
    for (uint32_t f = 0; f < THINGS; f++) {
        c->feature[f] = f;
        for (uint32_t g = f + 1; g < THINGS; g += 2)
            c->required[c->required_n++] =
                (sunder_i_requirement){.a = f, .b = g, .clearance = rng_once_in(r, 8) ? 0 : -INFINITY};
    }
}

static void end(crowd *c)
{
    scene_model_end(&c->of);
    scene_end(&c->scene);
}

/* A question about a random pair of the two, with all houses considered. */
static sunder_i_subproblem draw_question(rng *r, const crowd *c)
{
    const uint32_t f = 2 * (uint32_t)rng_int(r, 0, HOUSES - 1), g = 2 * (uint32_t)rng_int(r, 0, HOUSES - 1) + 1;
    return (sunder_i_subproblem){.model = &c->of.model,
                                 .body = c->body,
                                 .bodies = 2,
                                 .a = f < g ? f : g,
                                 .b = f < g ? g : f,
                                 .required = c->required,
                                 .required_n = c->required_n,
                                 .feature = c->feature,
                                 .features = THINGS,
                                 .coarse = rng_once_in(r, 2) ? 0x1p-8 : 0,
                                 .most = 2};
}

static sunder_i_verdict decide(const sunder_i_subproblem *q, sunder_i_decision *decision)
{
    sunder_error err;
    assert_int_equal(sunder_i_decide(q, decision, &err), SUNDER_OK);
    assert_true(!decision->proof == (decision->verdict != SUNDER_I_INFEASIBLE));
    return decision->verdict;
}

/* The outcome of each question with and without precedents, and the number of steps. */
static void test_questions(void **state)
{
    size_t told[3] = {0};
    uint64_t with = 0, without = 0;
    for (uint64_t k = 0; k < CROWDS; k++) {
        rng r = rng_start(31, k);
        crowd c;
        begin(&r, &c);
        sunder_i_precedents precedents = {0};
        for (int n = 0; n < QUESTIONS; n++) {
            sunder_i_subproblem q = draw_question(&r, &c);
            sunder_i_decision anew, known;
            decide(&q, &anew);
            q.precedents = &precedents;
            assert_int_equal(decide(&q, &known), anew.verdict);
            told[known.verdict]++;
            with += known.work;
            without += anew.work;
            sunder_i_decision_clear(&anew);
            sunder_i_decision_clear(&known);
        }
        end(&c);
    }
    assert_true(told[SUNDER_I_INFEASIBLE] > 10 * CROWDS && told[SUNDER_I_FEASIBLE] > CROWDS);
    assert_true(3 * with < 2 * without);
    (void)state;
}

/* ---- Coarse lines and fine ones ---------------------------------------------------------------------------------- */

enum { YARD = 10, ROUND = 24, WALLS = 4, SHEDS = 6 };

/* A block around a square courtyard, with sheds behind its walls, and in the courtyard a round house, slightly too
 * large. */
static void begin_yard(crowd *c)
{
    char wkt[2000];
    memset(c, 0, sizeof *c);
    scene_begin(&c->scene, 0);
    c->scene.options.no_blocks = true;
    scene_add_box(&c->scene, -1, -1, 1, YARD + 2)->block = 0;
    scene_add_box(&c->scene, YARD, -1, 1, YARD + 2)->block = 0;
    scene_add_box(&c->scene, 0, -1, YARD, 1)->block = 0;
    scene_add_box(&c->scene, 0, YARD, YARD, 1)->block = 0;
    for (int k = 0; k < SHEDS; k++) scene_add_box(&c->scene, 2.0 * k, YARD + 3, 1, 1)->block = 0;
    int at = snprintf(wkt, sizeof wkt, "POLYGON ((");
    for (int k = 0; k <= ROUND; k++)
        at += snprintf(wkt + at, sizeof wkt - (size_t)at, "%s%.10f %.10f", k ? ", " : "",
                       YARD / 2.0 + 1.02 * YARD / 2 * cos(6.283185307179586 * (k % ROUND) / ROUND),
                       YARD / 2.0 + 1.02 * YARD / 2 * sin(6.283185307179586 * (k % ROUND) / ROUND));
    snprintf(wkt + at, sizeof wkt - (size_t)at, "))");
    scene_add(&c->scene, wkt)->block = 1;
    for (size_t k = 0; k < c->scene.n; k++) c->scene.feature[k].max_shift = 40;
    scene_model_related(&c->of, &c->scene);
}

/* If only fine lines prove a question infeasible, the question with a feature left out is tried with fine lines only;
 * the outcome is the same. */
static void test_fine_planes(void **state)
{
    crowd c;
    sunder_i_decision all, some, anew;
    begin_yard(&c);
    const sunder_i_model *model = &c.of.model;
    uint32_t set[WALLS + SHEDS + 1], house = 0;
    for (uint32_t f = 0; f < model->features; f++)
        if (model->body[model->body_of[f]].members == 1) house = f;
    const uint32_t other = house == 0, body[2] = {model->body_of[house], model->body_of[other]};
    sunder_i_subproblem q = {.model = model, .body = body, .bodies = 2, .coarse = 0x1p-5, .most = 2};
    q.a = house < other ? house : other;
    q.b = house < other ? other : house;
    assert_int_equal(decide(&q, &all), SUNDER_I_INFEASIBLE);
    assert_true(all.fine_plane);
    sunder_i_decision_clear(&all);
    q.feature = set;
    for (uint32_t out = 0; out < model->features; out++) {
        q.features = 0;
        q.fine_plane = false;
        for (uint32_t f = 0; f < model->features; f++)
            if (f != out) set[q.features++] = f;
        decide(&q, &anew);
        q.fine_plane = true;
        assert_int_equal(decide(&q, &some), anew.verdict);
        assert_true(some.work < anew.work);
        sunder_i_decision_clear(&some);
        sunder_i_decision_clear(&anew);
    }
    end(&c);
    (void)state;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_questions), cmocka_unit_test(test_fine_planes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
