/* Before a large crowd is solved, it absorbs the bodies on the area that it needs: those without limits, alone or in
 * small crowds, and no others. */
#include "random.h"
#include "scene_solver.h"

#include "base/union_find.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "polyset.h"

/* Bodies in one heap are a large crowd, which takes a disc with a radius of some 180 (clusters/tuning.h). */
enum { HEAP = 1050, SMALL_HEAP = 8, ALONE = 12, HELD = 4, MOST = HEAP + SMALL_HEAP + 2 * ALONE + HELD };

typedef struct crowd {
    sunder_feature feature[MOST];
    size_t n;
    sunder_layer_options options;
    scene_model of;
    sunder_i_solver solver;
} crowd;

static sunder_feature *add_square(crowd *c, double x, double y)
{
    char wkt[300];
    snprintf(wkt, sizeof wkt, "POLYGON ((%.17g %.17g, %.17g %.17g, %.17g %.17g, %.17g %.17g))", x, y, x + 10, y, x + 10,
             y + 10, x, y + 10);
    sunder_shape *shape = polyset_shape_of_wkt(wkt);
    assert_non_null(shape);
    c->feature[c->n] = (sunder_feature){.shape = shape, .weight = 1, .max_shift = INFINITY, .block = -1};
    return &c->feature[c->n++];
}

/* y is drawn first: C leaves the order of evaluation of arguments to the compiler, so two random numbers may not be
 * drawn in one call. */
static void add_heap(crowd *c, rng *g, size_t n, double x, double y, double within)
{
    for (size_t k = 0; k < n; k++) {
        const double up = y + within * rng_unit(g), right = x + within * rng_unit(g);
        add_square(c, right, up);
    }
}

static void begin(crowd *c)
{
    sunder_error err;
    scene_model_related_features(&c->of, c->feature, c->n, &c->options);
    scene_solver_begin(&c->solver, &c->of);
    assert_int_equal(sunder_i_solver_gather(&c->solver, &err), SUNDER_OK);
    assert_int_equal(sunder_i_solver_unite_blocks(&c->solver, &err), SUNDER_OK);
}

static void end(crowd *c)
{
    scene_solver_end(&c->solver);
    scene_model_end(&c->of);
}

/* Removes the first n squares. */
static void forget(crowd *c, size_t n)
{
    for (size_t k = 0; k < n; k++) sunder_shape_free((sunder_shape *)(uintptr_t)c->feature[k].shape);
    memmove(c->feature, c->feature + n, (c->n -= n) * sizeof *c->feature);
}

static uint32_t root_of(const crowd *c, size_t feature)
{
    return sunder_i_union_find(c->solver.parent, c->solver.model.body_of[feature]);
}

static void draw(crowd *c)
{
    memset(c, 0, sizeof *c);
    sunder_layer_options_init(&c->options);
    c->options.no_blocks = c->options.allow_jumps = true;
    rng g = {1};
    add_heap(c, &g, HEAP, 0, 0, 60);
    add_heap(c, &g, SMALL_HEAP, 130, 30, 12);
    for (int k = 0; k < ALONE; k++) { /* some within the area, some far outside */
        const double angle = 0.3 + 0.5 * k;
        add_square(c, 30 + 110 * cos(angle), 30 + 110 * sin(angle));
        add_square(c, 30 + 900 * cos(angle), 30 + 900 * sin(angle));
    }
    add_square(c, 30, 150)->fixed = true;
    add_square(c, 60, 150)->max_shift = 5;
    add_square(c, -90, 60)->fixed = true;
    add_square(c, -85, 62);
}

static void test_takes_in(void **state)
{
    (void)state;
    static crowd c;
    sunder_error err;
    uint32_t joined[2][MOST];
    draw(&c);
    for (unsigned run = 0; run < 2; run++) {
        c.options.threads = run ? 4 : 1;
        begin(&c);
        const uint32_t own = root_of(&c, 0);
        for (size_t k = HEAP; k < c.n; k++) assert_true(root_of(&c, k) != own);
        assert_int_equal(sunder_i_solver_grow_crowds(&c.solver, &err), SUNDER_OK);
        for (size_t k = 0; k < c.n; k++) joined[run][k] = root_of(&c, k) == root_of(&c, 0);
        end(&c);
    }
    for (size_t k = 0; k < HEAP + SMALL_HEAP; k++) assert_true(joined[0][k]);
    for (size_t k = 0; k < ALONE; k++) {
        assert_true(joined[0][HEAP + SMALL_HEAP + 2 * k]);
        assert_false(joined[0][HEAP + SMALL_HEAP + 2 * k + 1]);
    }
    for (size_t k = 1; k <= HELD; k++) assert_false(joined[0][c.n - k]);
    assert_memory_equal(joined[0], joined[1], c.n * sizeof **joined); /* the number of threads changes nothing */
    forget(&c, c.n);
}

/* At effort 0 no body starts at the position that prices give; and a small crowd is started again whenever it grows. */
static void test_others_stay(void **state)
{
    (void)state;
    static crowd c;
    sunder_error err;
    for (int run = 0; run < 2; run++) {
        draw(&c);
        if (run)
            c.options.effort = 0;
        else
            forget(&c, 600);
        begin(&c);
        const size_t edges = c.solver.edges;
        assert_int_equal(sunder_i_solver_grow_crowds(&c.solver, &err), SUNDER_OK);
        assert_int_equal(c.solver.edges, edges);
        end(&c);
        forget(&c, c.n);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_takes_in), cmocka_unit_test(test_others_stay)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
