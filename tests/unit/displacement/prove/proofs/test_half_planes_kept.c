/* displacement/prove/proofs/half_planes_kept: cached lines between pieces equal new ones and count the same number of
 * steps, for any number and order of requests and of clearances, and also if others have replaced them in the cache, or
 * if questions with coarser lines share it. Pieces that are apart by more than lines lose at corners are also apart by
 * lines made for their place. */
#include "random.h"
#include "scene_model.h"

#include "displacement/prove/proofs/branching.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { LAYERS = 4, QUESTIONS = 20000, HOUSES = 28 };

static void add_house(rng *r, scene *s)
{
    char wkt[200];
    const double x = (double)rng_int(r, 0, 80) / 4, y = (double)rng_int(r, 0, 80) / 4,
                 w = (double)rng_int(r, 1, 12) / 4, h = (double)rng_int(r, 1, 12) / 4;
    snprintf(wkt, sizeof wkt, "POLYGON ((%.4f %.4f, %.4f %.4f, %.4f %.4f, %.4f %.4f, %.4f %.4f, %.4f %.4f))", x, y,
             x + w, y, x + w, y + h, x + w / 2, y + h + 0.125, x, y + h, x, y);
    scene_add(s, wkt)->max_shift = (double)rng_int(r, 2, 8);
}

/* Compares the lines of a pair; returns whether there are any. */
static bool check_pair(rng *r, sunder_i_branching *kept, sunder_i_branching *anew)
{
    const sunder_i_model *model = kept->model;
    const sunder_i_body *p = &model->body[rng_int(r, 0, (int64_t)model->bodies - 1)],
                        *q = &model->body[rng_int(r, 0, (int64_t)model->bodies - 1)];
    const sunder_i_body_pieces *of_p = sunder_i_pieces_of(model, p), *of_q = sunder_i_pieces_of(model, q);
    const sunder_i_body_piece *a = &of_p->piece[rng_int(r, 0, p->pieces - 1)],
                              *b = &of_q->piece[rng_int(r, 0, q->pieces - 1)];
    const bool shadow = rng_once_in(r, 3);
    if (shadow) a = &of_p->anchor[0]; /* features here have no blocks */
    const double clearance = shadow ? 0 : (double)rng_int(r, -4, 4) / 4;
    size_t n;
    const sunder_i_half_plane *way = sunder_i_branching_kept_half_planes(kept, p, a, q, b, clearance, shadow, &n);
    assert_int_equal(n, sunder_i_branching_fill_half_planes(anew, p, a, q, b, clearance, shadow, NULL));
    assert_int_equal(kept->looked, anew->looked);
    assert_false(kept->failed);
    for (size_t k = 0; k < n; k++) {
        assert_true(way[k].n[0] == anew->scratch[k].n[0] && way[k].n[1] == anew->scratch[k].n[1]);
        assert_true(way[k].d == anew->scratch[k].d);
    }
    return n > 0;
}

/* Returns whether the two are told apart by more than the loss at corners. */
static bool check_place(rng *r, sunder_i_branching *c)
{
    const sunder_i_body *p = &c->model->body[rng_int(r, 0, (int64_t)c->model->bodies - 1)],
                        *q = &c->model->body[rng_int(r, 0, (int64_t)c->model->bodies - 1)];
    const sunder_i_body_piece *a = sunder_i_pieces_of(c->model, p)->piece, *b = sunder_i_pieces_of(c->model, q)->piece;
    const double clearance = (double)rng_int(r, 1, 24) / 4,
                 u[2] = {(double)rng_int(r, -400, 400) / 16, (double)rng_int(r, -400, 400) / 16};
    const size_t n = sunder_i_branching_fill_half_planes(c, p, a, q, b, clearance, false, NULL);
    const double depth = sunder_i_branching_depth(c, n, u);
    if (n == 0 || depth >= -SUNDER_I_CORNER_LOSS * clearance) return false;
    const size_t made = sunder_i_branching_fill_half_planes(c, p, a, q, b, clearance, false, u);
    assert_true(sunder_i_branching_depth(c, made, u) < 0);
    return true;
}

static void test_places(void **state)
{
    size_t apart = 0;
    (void)state;
    rng r = rng_start(13, 0);
    scene s;
    scene_model of;
    scene_begin(&s, 1);
    for (int k = 0; k < HOUSES; k++) add_house(&r, &s);
    scene_model_related(&of, &s);
    const sunder_i_subproblem q = {.model = &of.model};
    sunder_i_branching c = {.subproblem = &q, .model = &of.model};
    for (int k = 0; k < QUESTIONS; k++) apart += check_place(&r, &c);
    sunder_i_free(c.scratch);
    scene_model_end(&of);
    scene_end(&s);
    assert_true(apart > QUESTIONS / 4 && apart < QUESTIONS);
}

static void test_ways(void **state)
{
    size_t some = 0;
    (void)state;
    for (uint64_t layer = 0; layer < LAYERS; layer++) {
        rng r = rng_start(12, layer);
        scene s;
        scene_model of;
        scene_begin(&s, 1);
        for (int k = 0; k < HOUSES; k++) add_house(&r, &s);
        scene_model_related(&of, &s);
        sunder_i_planes planes = {0};
        const sunder_i_subproblem q[2] = {{.model = &of.model, .planes = layer % 2 ? &planes : NULL},
                                          {.model = &of.model, .coarse = 0x1p-5, .planes = layer % 2 ? &planes : NULL}};
        sunder_i_branching kept[2] = {{.subproblem = &q[0], .model = &of.model},
                                      {.subproblem = &q[1], .model = &of.model}};
        sunder_i_branching anew[2] = {kept[0], kept[1]};
        for (int k = 0; k < QUESTIONS; k++) some += check_pair(&r, &kept[k % 2], &anew[k % 2]);
        for (int k = 0; k < 2; k++) {
            sunder_i_half_planes_forget(&kept[k].kept);
            assert_null(kept[k].kept);
            sunder_i_free(kept[k].scratch);
            sunder_i_free(anew[k].scratch);
        }
        sunder_i_planes_clear(&planes);
        scene_model_end(&of);
        scene_end(&s);
    }
    assert_true(some > LAYERS * QUESTIONS / 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_ways), cmocka_unit_test(test_places)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
