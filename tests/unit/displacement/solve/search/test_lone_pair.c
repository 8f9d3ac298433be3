/* displacement/solve/search/lone_pair: two features without neighbours are separated by their least translation, of
 * which the lighter one takes more; if anything else has an influence, nothing is changed. */
#include "random.h"
#include "scene_board.h"

#include "displacement/solve/search/search_stages.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static const double margin = 0x1p-40;

typedef struct pair {
    scene_board board;
    sunder_i_cluster cluster;
    sunder_i_search search;
    double stood[6];
    bool done;
} pair;

/* An empty scene. */
static scene *scene_of(pair *p, double gap)
{
    memset(p, 0, sizeof *p);
    scene_begin(&p->board.scene, gap);
    return &p->board.scene;
}

/* The exact result for the two; the caller clears it. */
static sunder_separation least_of(const scene *s)
{
    sunder_separation least;
    assert_int_equal(sunder_pair_separate(s->feature[0].shape, s->feature[1].shape, s->options.gap, &least, NULL),
                     SUNDER_OK);
    return least;
}

/* Starts a search with the two or three features of the scene; stood are their vectors. */
static void begin(pair *p, const double stood[6])
{
    sunder_error err;
    scene_board *b = &p->board;
    scene_board_begin(b);
    memcpy(p->stood, stood, sizeof p->stood);
    p->cluster = (sunder_i_cluster){.body = b->body, .n = b->scene.n, .margin = margin};
    assert_true(sunder_i_search_init(&p->search, &b->of.model, b->body, b->scene.n, margin, stood));
    assert_int_equal(sunder_i_search_separate_lone_pair(&p->search, &p->cluster, &p->done, &err), SUNDER_OK);
    if (!p->done) assert_memory_equal(p->search.t, stood, 2 * b->scene.n * sizeof *stood);
}

static void end(pair *p)
{
    sunder_i_search_free(&p->search);
    scene_board_end(&p->board);
}

/* A box with a corner cut off, or with a notch in a side: it has a concave corner, so there are places in contact with
 * two lines. */
static void add_any(rng *r, scene *s)
{
    char wkt[400];
    const double x = 6 * rng_unit(r), y = 6 * rng_unit(r), w = 1 + 5 * rng_unit(r), h = 1 + 5 * rng_unit(r);
    const double u = x + w * rng_unit(r), v = y + h * rng_unit(r);
    if (rng_once_in(r, 2))
        snprintf(wkt, sizeof wkt, "POLYGON ((%.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g))", x, y,
                 x + w, y, x + w, v, u, y + h, x, y + h);
    else
        snprintf(wkt, sizeof wkt, "POLYGON ((%.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g))", x, y,
                 x + w, y, x + w, y + h, u, v, x, y + h);
    char *ring_end = strstr(wkt, "))");
    snprintf(ring_end, sizeof wkt - (size_t)(ring_end - wkt), ", %.17g %.17g))", x, y);
    scene_add(s, wkt)->weight = rng_once_in(r, 3) ? 0.25 + rng_unit(r) : 1;
}

/* The cost equals that of the exact least translation, and the pair keeps the gap and the margin. */
static void test_the_least_is_paid(void **state)
{
    (void)state;
    size_t parted = 0, all = test_count(400);
    for (size_t k = 0; k < all; k++) {
        rng r = rng_start(test_seed(), k);
        pair p;
        scene *s = scene_of(&p, rng_once_in(&r, 3) ? 0 : 2 * rng_unit(&r));
        add_any(&r, s);
        add_any(&r, s);
        s->feature[1].fixed = rng_once_in(&r, 6);
        if (rng_once_in(&r, 4)) s->feature[0].max_shift = s->feature[1].max_shift = 2 * rng_unit(&r);
        begin(&p, (double[6]){rng_unit(&r), 0, 0, 0});
        sunder_separation least = least_of(s);
        if (p.done)
            assert_true(p.cluster.measured.least == least.lower_bound);
        else
            assert_true(p.cluster.measured.least == 0 || p.cluster.measured.least == least.lower_bound);
        if (p.done) {
            const double *t = p.search.t, w = s->feature[0].weight, v = s->feature[1].weight;
            const double share = s->feature[1].fixed ? w : w * v / (w + v);
            assert_true(sunder_i_search_find_clashes(&p.search, t) <= p.search.tolerance);
            assert_true(fabs(hypot(t[2] - t[0], t[3] - t[1]) - least.distance) <= 16 * margin);
            assert_true(fabs(sunder_i_search_cost(&p.search, t) - share * least.distance * least.distance) <=
                        1e-9 * (1 + least.distance) * (1 + w + v));
            assert_true(!s->feature[1].fixed || (t[2] == 0 && t[3] == 0));
            parted++;
        }
        sunder_separation_clear(&least);
        end(&p);
    }
    assert_true(2 * parted > all);
}

/* Other influences: no conflict; a limit that is too short; a third body; a given-up pair; a mode in which one may lie
 * inside the other. */
static void test_others_have_a_say(void **state)
{
    (void)state;
    for (int kind = 0; kind < 6; kind++) {
        pair p;
        scene *s = scene_of(&p, 1);
        scene_add_box(s, 0, 0, 10, 4);
        scene_add_box(s, kind == 1 ? 12 : 9, 1, 10, 4);
        if (kind == 2) s->feature[0].max_shift = s->feature[1].max_shift = 0.5;
        if (kind == 3) scene_add_box(s, 40, 0, 1, 1);
        if (kind == 4) s->feature[0].fixed = s->feature[1].fixed = true;
        if (kind == 5) s->options.contained = SUNDER_CONTAINMENT_IGNORE;
        begin(&p, (double[6]){0});
        assert_true(p.done == (kind == 0));
        assert_true((p.cluster.measured.least > 0) == (kind == 0));
        end(&p);
    }
}

/* Adds a box of that size at an offset along e and across it. */
static void add_slanted(scene *s, const double o[2], const double e[2], double along, double across, double w, double h)
{
    char wkt[400];
    double x[4], y[4];
    for (int k = 0; k < 4; k++) {
        const double a = along + (k == 1 || k == 2 ? w : 0), b = across + (k > 1 ? h : 0);
        x[k] = o[0] + a * e[0] - b * e[1];
        y[k] = o[1] + a * e[1] + b * e[0];
    }
    snprintf(wkt, sizeof wkt, "POLYGON ((%.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g))", x[0], y[0],
             x[1], y[1], x[2], y[2], x[3], y[3], x[0], y[0]);
    scene_add(s, wkt);
}

/* Two bodies that keep the gap up to the rounding of their corners: the least translation may be too short for
 * doubles. */
static void test_hardly_too_near(void **state)
{
    (void)state;
    size_t conflicts = 0, all = test_count(400);
    for (size_t k = 0; k < all; k++) {
        rng r = rng_start(test_seed(), k);
        pair p;
        const double angle = 6.28 * rng_unit(&r), gap = (double)rng_int(&r, 1, 24) / 8;
        const double e[2] = {cos(angle), sin(angle)}, o[2] = {0.1, 0.3};
        scene *s = scene_of(&p, gap);
        add_slanted(s, o, e, 0, 0, 10, 5);
        add_slanted(s, o, e, 1, 5 + gap, 4, 3);
        begin(&p, (double[6]){0});
        for (int c = 0; c < 4; c++) assert_true(fabs(p.search.t[c]) < 1e-6); /* the comparison also fails for NAN */
        sunder_separation least = least_of(s);
        conflicts += least.overlap;
        sunder_separation_clear(&least);
        end(&p);
    }
    assert_true(4 * conflicts > all && conflicts < all);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_least_is_paid),
        cmocka_unit_test(test_others_have_a_say),
        cmocka_unit_test(test_hardly_too_near),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
