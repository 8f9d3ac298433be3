/* The search's representation of a body: made at its first use, and the same for every thread that uses it first:
 * pieces relative to the body's origin, in the order of the shapes' pieces, with boxes whose union is the body's box;
 * anchors; and convex outlines. */
#include "random.h"
#include "scene.h"
#include "scene_model.h"

#include "base/parallel.h"
#include "shape/shape.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

/* The first two features share a wall and are one body; the third is not convex, and has more pieces than fit into a
 * run; the last is a row of six. */
static void draw(scene *s)
{
    scene_begin(s, 1);
    scene_add(s, "POLYGON ((10 10, 20 10, 20 30, 10 30, 10 10))");
    scene_add(s, "POLYGON ((20 10, 40 10, 40 20, 30 20, 30 30, 20 30, 20 10))");
    scene_add(s, "POLYGON ((100 0, 104 0, 104 9, 108 9, 108 0, 112 0, 112 9, 116 9, 116 0, 120 0, 120 9, 124 9, 124 0, "
                 "128 0, 128 9, 132 9, 132 0, 136 0, 136 9, 140 9, 140 0, 144 0, 144 12, 100 12, 100 0))");
    scene_add(s, "POLYGON ((0.1 50.1, 4.3 50.1, 4.3 54.7, 0.1 54.7, 0.1 50.1))");
    for (int k = 0; k < 6; k++) scene_add_box(s, 200 + 4 * k, k, 4, 7);
}

static void check_piece(const sunder_i_model *model, const sunder_i_body *body, const sunder_i_body_piece *piece)
{
    double given[2 * 32], box[4];
    assert_true(piece->corners <= 32);
    sunder_i_piece_as_given(model, piece, given);
    sunder_i_box_clear(box);
    for (uint32_t k = 0; k < 2 * piece->corners; k++) assert_true(piece->corner[k] == given[k] - body->origin[k & 1]);
    for (uint32_t k = 0; k < piece->corners; k++) sunder_i_box_include(box, piece->corner + 2 * (size_t)k);
    assert_memory_equal(box, piece->box, sizeof box);
}

static void check_runs(const sunder_i_body *body, const sunder_i_body_pieces *pieces)
{
    for (uint32_t l = 0; l + SUNDER_I_RUN <= body->pieces; l++) {
        double box[4];
        if ((body->piece + l) % SUNDER_I_RUN) continue;
        sunder_i_box_clear(box);
        for (uint32_t k = l; k < l + SUNDER_I_RUN; k++) sunder_i_box_join(box, pieces->piece[k].box);
        assert_memory_equal(pieces->run + 4 * ((body->piece + l) / SUNDER_I_RUN - pieces->first_run), box, sizeof box);
    }
}

static void check_outlines(const sunder_i_model *model, const sunder_i_body *body)
{
    const sunder_i_body_piece *outline = sunder_i_outlines_of(model, body);
    assert_ptr_equal(outline, sunder_i_outlines_of(model, body));
    for (uint32_t m = 0; m < body->members; m++) {
        const double *at = outline[m].corner;
        const uint32_t n = outline[m].corners;
        assert_int_equal(outline[m].feature, model->member[body->member + m]);
        assert_true(n >= 4);
        for (uint32_t k = 0; k < n; k++) {
            const double *p = at + 2 * k, *q = at + 2 * ((k + 1) % n), *r = at + 2 * ((k + 2) % n);
            assert_true((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]) > 0);
        }
    }
}

/* The box of a body's anchors is the box of its anchors given as pieces, for few and for many anchors. */
static void check_anchors(const sunder_i_model *model, const sunder_i_body *body, const sunder_i_body_pieces *pieces)
{
    double box[4], all[4];
    sunder_i_box_clear(all);
    for (uint32_t m = 0; m < body->members; m++) sunder_i_box_join(all, pieces->anchor[m].box);
    sunder_i_anchors(model, body, box);
    assert_memory_equal(box, all, sizeof box);
}

static void test_made_when_asked(void **state)
{
    (void)state;
    scene s;
    scene_model of;
    draw(&s);
    scene_model_related(&of, &s);
    const sunder_i_model *model = &of.model;
    uint32_t number = 0, most_members = 0, diagonal_covers = 0;
    assert_int_equal(model->bodies, 4);
    for (size_t b = 0; b < model->bodies; b++) {
        const sunder_i_body *body = &model->body[b];
        assert_null(model->made[b]);
        const sunder_i_body_pieces *pieces = sunder_i_pieces_of(model, body);
        double box[4];
        assert_ptr_equal(pieces, sunder_i_pieces_of(model, body));
        assert_int_equal(body->piece, number);
        sunder_i_box_clear(box);
        for (uint32_t k = 0; k < body->pieces; k++) {
            check_piece(model, body, &pieces->piece[k]);
            sunder_i_box_join(box, pieces->piece[k].box);
            assert_int_equal(sunder_i_body_of_piece(model, number++), b);
        }
        assert_memory_equal(box, body->box, sizeof box);
        for (uint32_t m = 0; m < body->members; m++) check_piece(model, body, &pieces->anchor[m]);
        for (uint32_t k = 0; k < body->has->diagonal_covers; k++)
            check_piece(model, body, &model->diagonal_cover[body->has->diagonal_cover + k]);
        diagonal_covers += body->has->diagonal_covers;
        check_anchors(model, body, pieces);
        check_runs(body, pieces);
        check_outlines(model, body);
        most_members = body->members > most_members ? body->members : most_members;
    }
    assert_true(diagonal_covers >= model->most_pieces - 1);
    assert_true(most_members > 4); /* so that there are runs with a stored box */
    assert_true(model->most_pieces >= 2 * SUNDER_I_RUN - 1);
    scene_model_end(&of);
    scene_end(&s);
}

/* Pieces that were dropped from the cache are made again, equal to the first ones. */
static void test_forgotten(void **state)
{
    (void)state;
    scene s;
    scene_model of;
    draw(&s);
    scene_model_related(&of, &s);
    for (size_t b = 0; b < of.model.bodies; b++) {
        const sunder_i_body *body = &of.model.body[b];
        double corner[2 * 64];
        size_t n = 0;
        const sunder_i_body_pieces *pieces = sunder_i_pieces_of(&of.model, body);
        for (uint32_t k = 0; k < body->pieces; n += pieces->piece[k++].corners)
            memcpy(corner + 2 * n, pieces->piece[k].corner, 2 * pieces->piece[k].corners * sizeof *corner);
        assert_non_null(sunder_i_outlines_of(&of.model, body));
        sunder_i_pieces_forget(&of.model, SIZE_MAX);
        assert_ptr_equal(of.model.made[b], pieces);
        sunder_i_pieces_forget(&of.model, 0);
        assert_null(of.model.made[b]);
        pieces = sunder_i_pieces_of(&of.model, body);
        n = 0;
        for (uint32_t k = 0; k < body->pieces; n += pieces->piece[k++].corners)
            assert_memory_equal(corner + 2 * n, pieces->piece[k].corner, 2 * pieces->piece[k].corners * sizeof *corner);
        check_outlines(&of.model, body);
    }
    scene_model_end(&of);
    scene_end(&s);
}

enum { ASKING = 4000 };

typedef struct asking {
    const sunder_i_model *model;
    const sunder_i_body_pieces *got[ASKING];
    const sunder_i_body_piece *outline[ASKING];
} asking;

static sunder_status ask(void *context, size_t begin, size_t end, sunder_error *err)
{
    asking *a = context;
    (void)err;
    for (size_t k = begin; k < end; k++) {
        const sunder_i_body *body = &a->model->body[k % a->model->bodies];
        a->got[k] = sunder_i_pieces_of(a->model, body);
        a->outline[k] = sunder_i_outlines_of(a->model, body);
    }
    return SUNDER_OK;
}

static void test_many_ask(void **state)
{
    (void)state;
    static asking a;
    sunder_error err;
    scene s;
    draw(&s);
    for (int round = 0; round < 20; round++) {
        scene_model of;
        scene_model_related(&of, &s);
        a.model = &of.model;
        assert_int_equal(sunder_i_parallel(4, ASKING, 1, ask, &a, &err), SUNDER_OK);
        for (size_t k = 0; k < ASKING; k++) {
            assert_non_null(a.got[k]);
            assert_ptr_equal(a.got[k], a.got[k % of.model.bodies]);
            assert_ptr_equal(a.outline[k], a.outline[k % of.model.bodies]);
        }
        scene_model_end(&of);
    }
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_made_when_asked), cmocka_unit_test(test_forgotten),
                                       cmocka_unit_test(test_many_ask)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
