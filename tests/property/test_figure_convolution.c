/* The convolution computed as a curve compared with bands in a planar map: one stage of a closing or an opening,
 * computed by both algorithms, is exactly the same sum. The work for a closing by an n-gon grows with n as that for a
 * dilation does.
 *
 * Houses are rectangles at all angles on a fine grid; rows of boxes on a coarse grid meet in configurations for which
 * the curve algorithm has to decline. */
#include "polyset.h"
#include "random.h"
#include "sum_text.h"

#include "morphology/morphology.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const double circle = 6.283185307179586;

/* ---- Sets ---- */

static double to_grid(double v, double unit) { return floor(v / unit + 0.5) * unit; }

static void add_hut(polyset *set, rng *r, double extent, double unit)
{
    const double x = rng_unit(r) * extent, y = rng_unit(r) * extent, angle = rng_unit(r) * circle / 2;
    const double w = 6 + 12 * rng_unit(r), h = 5 + 9 * rng_unit(r), c = cos(angle), s = sin(angle);
    const double side[4][2] = {{-w / 2, -h / 2}, {w / 2, -h / 2}, {w / 2, h / 2}, {-w / 2, h / 2}};
    double xy[8];
    for (int i = 0; i < 4; i++) {
        xy[2 * i] = to_grid(x + side[i][0] * c - side[i][1] * s, unit);
        xy[2 * i + 1] = to_grid(y + side[i][0] * s + side[i][1] * c, unit);
    }
    polyset_polygon(set, xy, 4);
}

static void add_box(polyset *set, rng *r, int extent)
{
    const double x = (double)rng_int(r, 0, extent), y = (double)rng_int(r, 0, extent);
    polyset_rectangle(set, x, y, x + (double)rng_int(r, 1, 6), y + (double)rng_int(r, 1, 6));
}

/* Houses whose walls are diagonal: corners in the middle of other houses' sides, and at other houses' corners. */
static void add_roof(polyset *set, rng *r, int extent)
{
    const double x = (double)rng_int(r, 0, extent), y = (double)rng_int(r, 0, extent), a = (double)rng_int(r, 1, 4);
    const double xy[8] = {x, y - a, x + a, y, x, y + a, x - a, y};
    polyset_polygon(set, xy, 4);
}

typedef enum scene_kind { HUTS, BOXES, ROOFS, SCENES } scene_kind;

static sunder_shape *draw_scene(rng *r, scene_kind kind)
{
    polyset set;
    polyset_init(&set);
    const int n = (int)rng_int(r, 2, 16);
    for (int i = 0; i < n; i++) {
        if (kind == HUTS) add_hut(&set, r, 12 * sqrt(n), 0.0625);
        if (kind == BOXES || (kind == ROOFS && i % 2)) add_box(&set, r, 16);
        if (kind == ROOFS && i % 2 == 0) add_roof(&set, r, 16);
    }
    sunder_shape *shape = polyset_shape(&set);
    assert_non_null(shape);
    polyset_free(&set);
    return shape;
}

static sunder_shape *draw_element(rng *r, scene_kind kind)
{
    sunder_shape *shape = NULL;
    if (kind != HUTS && rng_once_in(r, 2)) {
        const double side = (double)rng_int(r, 1, 4);
        assert_int_equal(sunder_shape_rectangle(side, side, &shape, NULL), SUNDER_OK);
    } else
        assert_int_equal(
            sunder_shape_disc(0.5 + 2.5 * rng_unit(r), (unsigned)rng_int(r, 3, 24), rng_once_in(r, 2), &shape, NULL),
            SUNDER_OK);
    return shape;
}

/* ---- One stage, by both algorithms ---- */

typedef struct tally {
    size_t stages, by_curve, wrong;
} tally;

static sunder_sum *by_map(const sunder_i_morphology_operands *o, const sunder_i_figure *figure, bool erode)
{
    sunder_sum *sum = sunder_i_morphology_operands_sum(o, 0);
    assert_non_null(sum);
    const sunder_status status = erode ? sunder_i_erode_figure(figure, &o->reflected, NULL, sum, NULL)
                                       : sunder_i_dilate_figure(figure, &o->element, NULL, sum, NULL);
    assert_int_equal(status, SUNDER_OK);
    return sum;
}

static void compare(const sunder_i_morphology_operands *o, const sunder_i_figure *figure, bool erode, tally *t)
{
    sunder_sum *curve = sunder_i_morphology_operands_sum(o, 0);
    bool done;
    assert_non_null(curve);
    assert_int_equal(
        sunder_i_sum_by_convolution(figure, erode ? &o->reflected : &o->element, erode, curve, &done, NULL), SUNDER_OK);
    t->stages++;
    if (done) {
        sunder_sum *map = by_map(o, figure, erode);
        char *ours = sum_text(curve), *theirs = sum_text(map);
        t->by_curve++;
        t->wrong += strcmp(ours, theirs) != 0;
        free(ours);
        free(theirs);
        sunder_sum_free(map);
    }
    sunder_sum_free(curve);
}

/* Compares each component of a set: eroded, and (open) dilated again. */
static void compare_islands(const sunder_i_morphology_operands *o, const sunder_sum *whole, bool open, tally *t)
{
    for (size_t i = 0; i < whole->polygons; i++) {
        sunder_i_figure figure;
        assert_true(sunder_i_figure_of_sum(whole, i, i + 1, true, &figure));
        compare(o, &figure, true, t);
        if (open) {
            sunder_sum *eroded = by_map(o, &figure, true);
            sunder_i_figure left;
            assert_true(sunder_i_figure_of_sum(eroded, 0, eroded->polygons, false, &left));
            if (left.sides) compare(o, &left, false, t);
            sunder_i_figure_free(&left);
            sunder_sum_free(eroded);
        }
        sunder_i_figure_free(&figure);
    }
}

static void compare_scene(uint64_t seed, size_t i, scene_kind kind, bool open, tally *t)
{
    rng r = rng_start(seed, i);
    sunder_shape *p = draw_scene(&r, kind), *b = draw_element(&r, kind);
    sunder_sum *whole;
    sunder_i_morphology_operands o;
    const size_t wrong = t->wrong;
    assert_int_equal(
        open ? sunder_i_union_of_members(p, b, &(sunder_sum_options){.size = sizeof(sunder_sum_options)}, &whole, NULL)
             : sunder_minkowski_sum(p, b, NULL, &whole, NULL),
        SUNDER_OK);
    assert_int_equal(sunder_i_morphology_operands_make(p, b, &o, NULL), SUNDER_OK);
    compare_islands(&o, whole, open, t);
    if (t->wrong > wrong) print_message("case %zu of kind %d, seed %llu\n", i, (int)kind, (unsigned long long)seed);
    sunder_i_morphology_operands_free(&o);
    sunder_sum_free(whole);
    sunder_shape_free(p);
    sunder_shape_free(b);
}

/* At least `share` of the stages have to use the curve algorithm, else there is nothing to compare. */
static void compare_scenes(bool open, scene_kind kind, double share)
{
    const size_t n = test_count(150);
    tally t = {0};
    for (size_t i = 0; i < n; i++) compare_scene(test_seed() + 500 + (uint64_t)kind, i, kind, open, &t);
    print_message("%zu stages, %zu by the curve\n", t.stages, t.by_curve);
    assert_int_equal(t.wrong, 0);
    assert_true((double)t.by_curve >= share * (double)t.stages);
}

static void test_closings_agree(void **state)
{
    compare_scenes(false, HUTS, 0.95);
    compare_scenes(false, BOXES, 0.7);
    compare_scenes(false, ROOFS, 0.7);
}

static void test_openings_agree(void **state)
{
    compare_scenes(true, HUTS, 0.9);
    compare_scenes(true, BOXES, 0.5);
    compare_scenes(true, ROOFS, 0.5);
}

/* ---- Growth of the work ---- */

static bool count_look(double fraction, void *user)
{
    ++*(size_t *)user;
    return true;
}

/* How often the library polls the progress function on one thread: once in a fixed number of steps, the same on every
 * machine. */
static size_t looks_of(const sunder_shape *p, sunder_operation operation, unsigned segments)
{
    size_t looks = 0;
    const sunder_sum_options options = {
        .size = sizeof options, .threads = 1, .progress = count_look, .progress_user = &looks};
    sunder_shape *b;
    sunder_sum *sum;
    assert_int_equal(sunder_shape_disc(2, segments, false, &b, NULL), SUNDER_OK);
    assert_int_equal(sunder_morphology(p, b, operation, &options, &sum, NULL), SUNDER_OK);
    sunder_sum_free(sum);
    sunder_shape_free(b);
    return looks;
}

/* From n to 8 n segments linear work grows at most by a factor of eight, and the work with bands by some fifty. */
static void test_work_grows_with_segments_as_dilation_does(void **state)
{
    polyset set;
    polyset_init(&set);
    rng r = rng_start(test_seed() + 700, 0);
    for (int i = 0; i < 400; i++) add_hut(&set, &r, 390, 0.0625);
    sunder_shape *p = polyset_shape(&set);
    assert_non_null(p);
    const sunder_operation operation[] = {SUNDER_OPERATION_CLOSE, SUNDER_OPERATION_OPEN};
    for (int i = 0; i < 2; i++) {
        const size_t few = looks_of(p, operation[i], 16), many = looks_of(p, operation[i], 128);
        print_message("%s: %zu polls for 16 segments, %zu for 128\n", sunder_operation_string(operation[i]), few, many);
        assert_true(many <= 8 * few);
    }
    sunder_shape_free(p);
    polyset_free(&set);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_closings_agree),
        cmocka_unit_test(test_openings_agree),
        cmocka_unit_test(test_work_grows_with_segments_as_dilation_does),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
