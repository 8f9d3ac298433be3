/* displacement/prove/proofs/half_planes_kept: cached lines between pieces equal new ones and count the same number of
 * steps, for any number and order of requests, and also if others have replaced them in the cache. */
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
    const double clearance = shadow ? 0 : (double)rng_int(r, -1, 1);
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
        const sunder_i_subproblem q = {.model = &of.model, .coarse = layer % 2 ? 0x1p-5 : 0};
        sunder_i_branching kept = {.subproblem = &q, .model = &of.model}, anew = kept;
        for (int k = 0; k < QUESTIONS; k++) some += check_pair(&r, &kept, &anew);
        sunder_i_branching_forget_half_planes(&kept);
        assert_null(kept.kept);
        sunder_i_free(kept.scratch);
        sunder_i_free(anew.scratch);
        scene_model_end(&of);
        scene_end(&s);
    }
    assert_true(some > LAYERS * QUESTIONS / 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_ways)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
