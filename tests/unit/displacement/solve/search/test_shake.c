/* displacement/solve/search/shake: a perturbed group never becomes more expensive and stays separated, and the same
 * seed gives the same bytes. displacement/prove/optimum: a group is not examined twice for the same question. */
#include "scene_model.h"

#include "displacement/solve/search/shake.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDE = 5, HIGH = 4, MOST = WIDE * HIGH, HALF = MOST / 2 };

static const double size = 10, pitch = 11, gap = 3;

/* Boxes in a grid with passages of width 1, which have to be 3, and their group: all of them moved away from the centre
 * until they are separated, in rows and columns. */
typedef struct grid {
    scene scene;
    scene_model of;
    sunder_i_group group;
} grid;

/* In place of the box, a comb with teeth upwards; nothing fits between the teeth. */
static void add_comb(scene *s, double x, double y, int teeth)
{
    char wkt[4096];
    const double pitch_of_teeth = size / (teeth - 0.5);
    size_t n = (size_t)snprintf(wkt, sizeof wkt, "POLYGON ((%.17g %.17g, %.17g %.17g", x, y, x + size, y);
    for (int k = teeth - 1; k >= 0; k--) {
        const double from = x + k * pitch_of_teeth, to = k + 1 < teeth ? from + pitch_of_teeth / 2 : x + size;
        n += (size_t)snprintf(wkt + n, sizeof wkt - n, ", %.17g %.17g, %.17g %.17g", to, y + size, from, y + size);
        if (k > 0)
            n += (size_t)snprintf(wkt + n, sizeof wkt - n, ", %.17g %.17g, %.17g %.17g", from, y + size / 2,
                                  from - pitch_of_teeth / 2, y + size / 2);
    }
    n += (size_t)snprintf(wkt + n, sizeof wkt - n, ", %.17g %.17g))", x, y);
    assert_true(n < sizeof wkt);
    scene_add(s, wkt);
}

static void begin(grid *g, size_t wide, size_t high, int teeth, uint64_t seed)
{
    memset(g, 0, sizeof *g);
    scene_begin(&g->scene, gap);
    for (size_t k = 0; k < wide * high; k++) {
        const double x = pitch * (double)(k % wide), y = pitch * (double)(k / wide);
        if (teeth)
            add_comb(&g->scene, x, y, teeth);
        else
            scene_add_box(&g->scene, x, y, size, size);
    }
    g->scene.options.seed = seed;
    scene_model_begin(&g->of, &g->scene);
    const size_t n = g->of.model.bodies;
    g->group = (sunder_i_group){.search = &sunder_i_group_search,
                                .n = n,
                                .margin = 0x1p-30,
                                .body = calloc(n, sizeof(uint32_t)),
                                .move = calloc(2 * n, sizeof(double))};
    for (size_t k = 0; k < n; k++) {
        const double middle[2] = {(double)(wide - 1) / 2, (double)(high - 1) / 2},
                     at[2] = {(double)(k % wide), (double)(k / wide)};
        g->group.body[k] = (uint32_t)k;
        for (size_t c = 0; c < 2; c++) {
            g->group.move[2 * k + c] = (at[c] - middle[c]) * (size + gap + 0.5 - pitch);
            g->group.cost += g->group.move[2 * k + c] * g->group.move[2 * k + c];
        }
    }
}

static void end(grid *g)
{
    free(g->group.body);
    free(g->group.move);
    scene_model_end(&g->of);
    scene_end(&g->scene);
}

static void shake(grid *g, uint64_t steps)
{
    const sunder_i_waived none = {0};
    sunder_error err;
    assert_int_equal(sunder_i_group_shake(&g->of.model, &none, &g->group, steps, &err), SUNDER_OK);
}

/* All bodies keep the gap, up to a share of it, and the cost is that of the group. */
static void check_layout(const grid *g, size_t wide, double off)
{
    double cost = 0;
    for (size_t k = 0; k < g->group.n; k++) {
        const double *t = g->group.move + 2 * k;
        cost += t[0] * t[0] + t[1] * t[1];
        for (size_t m = 0; m < k; m++) {
            const double *s = g->group.move + 2 * m;
            const double x = fabs(pitch * ((double)(k % wide) - (double)(m % wide)) + t[0] - s[0]) - size,
                         y = fabs(pitch * ((double)(k / wide) - (double)(m / wide)) + t[1] - s[1]) - size;
            assert_true(hypot(fmax(0, x), fmax(0, y)) >= gap * (1 - off));
        }
    }
    assert_true(fabs(cost - g->group.cost) <= 1e-9 * cost);
}

static void test_never_dearer(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 6; seed++) {
        grid g;
        begin(&g, WIDE, HIGH, 0, seed);
        const double before = g.group.cost;
        shake(&g, 20000000);
        assert_true(g.group.cost < before && sunder_i_group_is_cheaper(&g.group));
        check_layout(&g, WIDE, 1e-12);
        const double once = g.group.cost;
        shake(&g, 20000000);
        assert_true(g.group.cost <= once);
        check_layout(&g, WIDE, 1e-12);
        end(&g);
    }
}

static void test_same_seed(void **state)
{
    (void)state;
    double move[2 * MOST];
    for (int k = 0; k < 2; k++) {
        grid g;
        begin(&g, WIDE, HIGH, 0, 7);
        shake(&g, 5000000);
        if (k == 0) memcpy(move, g.group.move, sizeof move);
        assert_memory_equal(move, g.group.move, sizeof move);
        end(&g);
    }
}

/* With bodies of many pieces no descent ends within the budget. Such groups are perturbed a limited number of times. */
static void test_patience(void **state)
{
    (void)state;
    grid g;
    begin(&g, WIDE, HIGH, 24, 3);
    const double before = g.group.cost;
    g.group.tired = true;
    shake(&g, 20000);
    assert_true(g.group.cost == before && !g.group.shaken);
    g.group.tired = false;
    shake(&g, 2000000);
    assert_true(g.group.cost < before && g.group.shaken);
    check_layout(&g, WIDE, 2e-3);
    end(&g);
}

/* With any number of steps a small group is perturbed once for each of its variants; a group with a fixed body is not,
 * nor is a single body; and without steps nothing happens. */
static void test_ends(void **state)
{
    (void)state;
    grid g;
    begin(&g, 3, 1, 0, 1);
    shake(&g, UINT64_MAX / 8);
    check_layout(&g, 3, 1e-12);
    assert_true(g.group.cost >= 8 - 1e-9 && g.group.cost <= 8 + 1e-6); /* a move of 2 to either side */
    end(&g);
    for (int k = 0; k < 3; k++) {
        begin(&g, WIDE, HIGH, 0, 1);
        double move[2 * MOST];
        memcpy(move, g.group.move, sizeof move);
        g.group.held = k == 0;
        if (k == 1) g.group.n = 1;
        shake(&g, k == 2 ? 0 : 1000000);
        assert_memory_equal(move, g.group.move, 2 * g.group.n * sizeof *move);
        end(&g);
    }
}

static bool count_look(void *looks)
{
    ++*(size_t *)looks;
    return true;
}

/* The number of polls during a proof. */
static size_t prove_waived(grid *g, const sunder_i_waived *waived)
{
    size_t looks = 0;
    uint32_t of[MOST] = {0};
    sunder_error err;
    sunder_watch(count_look, &looks);
    assert_int_equal(sunder_i_group_prove(&g->of.model, waived, of, &g->group, 8000000, &err), SUNDER_OK);
    sunder_watch(NULL, NULL);
    return looks;
}

static size_t prove(grid *g)
{
    const sunder_i_waived none = {0};
    return prove_waived(g, &none);
}

/* A group that is too large for its tree, and whose cost is the same as in the last proof or nearly so, keeps its
 * bound, at a fraction of the work. A group of which only a part was examined is examined once more. */
static void test_asked_once(void **state)
{
    (void)state;
    grid g;
    begin(&g, WIDE, HIGH, 0, 1);
    const double cost = g.group.cost;
    const size_t first = prove(&g);
    const double bound = g.group.bound, asked = g.group.asked;
    assert_true(bound > 0 && bound < g.group.cost && asked >= g.group.cost && asked <= cost * (1 + 1e-9));
    g.group.asked = 0.95 * g.group.cost;
    const size_t again = prove(&g);
    assert_true(again < first / 2 && g.group.bound == bound && g.group.asked < g.group.cost);
    g.group.asked = 0.5 * g.group.cost;
    assert_true(prove(&g) > 2 * again);
    assert_true(g.group.bound >= bound && g.group.asked >= g.group.cost);
    check_layout(&g, WIDE, 1e-12);
    end(&g);
}

/* In a group that is too large for a tree, if listed pairs within the group are at least half the number of its bodies,
 * the group is a crowd: it is not perturbed, and bounded at a fraction of the work. */
static void test_crowded(void **state)
{
    (void)state;
    sunder_i_waiver listed[HALF];
    for (uint32_t k = 0; k < HALF; k++) listed[k] = (sunder_i_waiver){k, k + WIDE, 1, false};
    const sunder_i_waived crowd = {.pair = listed, .n = HALF}, fewer = {.pair = listed, .n = HALF - 1};
    size_t looks[2];
    for (int k = 0; k < 2; k++) {
        grid g;
        begin(&g, WIDE, HIGH, 0, 1);
        assert_int_equal(sunder_i_group_has_many_conflicts(&g.of.model, k ? &crowd : &fewer, &g.group), k);
        looks[k] = prove_waived(&g, k ? &crowd : &fewer);
        assert_true(g.group.bound > 0 && g.group.bound < g.group.cost);
        end(&g);
    }
    assert_true(looks[1] < looks[0] / 4);
    /* Pairs with a body outside the group do not count, and a group small enough for a tree is not a crowd. */
    grid g;
    begin(&g, WIDE, HIGH, 0, 1);
    for (uint32_t k = 0; k < MOST - 3; k++) g.group.body[k] = k + 3;
    g.group.n = MOST - 3;
    assert_false(sunder_i_group_has_many_conflicts(&g.of.model, &crowd, &g.group));
    for (uint32_t k = 0; k < 16; k++) g.group.body[k] = k;
    g.group.n = 16;
    assert_false(sunder_i_group_has_many_conflicts(&g.of.model, &crowd, &g.group));
    g.group.body[16] = 16;
    g.group.n = 17;
    assert_true(sunder_i_group_has_many_conflicts(&g.of.model, &crowd, &g.group));
    g.of.model.body[0].fixed = true;
    assert_false(sunder_i_group_has_many_conflicts(&g.of.model, &crowd, &g.group));
    end(&g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_never_dearer), cmocka_unit_test(test_same_seed),
                                       cmocka_unit_test(test_patience),     cmocka_unit_test(test_ends),
                                       cmocka_unit_test(test_asked_once),   cmocka_unit_test(test_crowded)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
