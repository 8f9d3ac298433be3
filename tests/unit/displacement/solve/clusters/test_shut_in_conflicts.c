/* displacement/solve/clusters/shut_in_conflicts: a house in a courtyard of four others: which of its conflicts with
 * them have no solution if the others remain as they are? */
#include "scene_model.h"

#include "displacement/solve/clusters/cluster_stages.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { WEST, EAST, SOUTH, NORTH, SIDES };

typedef struct yard {
    scene scene;
    scene_model of;
} yard;

static void add_box(scene *s, double x, double y, double width, double height, int64_t block)
{
    char wkt[200];
    snprintf(wkt, sizeof wkt, "POLYGON ((%g %g, %g %g, %g %g, %g %g, %g %g))", x, y, x + width, y, x + width,
             y + height, x, y + height, x, y);
    scene_add(s, wkt)->block = block;
}

/* A house of 2 by 2, half a gap away from three sides of its courtyard, and `east` away from the fourth. */
static void begin(yard *y, double east)
{
    memset(y, 0, sizeof *y);
    scene_begin(&y->scene, 1);
    const double width = 2.5 + east;
    add_box(&y->scene, -1, -1, 1, 5, 0);
    add_box(&y->scene, width, -1, 1, 5, 0);
    add_box(&y->scene, 0, -1, width, 1, 0);
    add_box(&y->scene, 0, 3, width, 1, 0);
    add_box(&y->scene, 0.5, 0.5, 2, 2, 1);
    scene_model_related(&y->of, &y->scene);
}

static void end(yard *y)
{
    scene_model_end(&y->of);
    scene_end(&y->scene);
}

/* The side of the courtyard that the pair is about, from the centre of the member that is not the house. */
static int side_of(const yard *y, const sunder_i_relaxation *t, double width)
{
    for (uint32_t e = 0; e < 2; e++) {
        const double *box = sunder_i_home_box(&y->of.model, e ? t->b : t->a);
        const double u = (box[0] + box[2]) / 2, v = (box[1] + box[3]) / 2;
        if (u < 0 || u > width) return u < 0 ? WEST : EAST;
        if (v < 0 || v > 3) return v < 0 ? SOUTH : NORTH;
    }
    return SIDES;
}

/* Determines for each conflict whether it is proved unsolvable; returns the number of conflicts. */
static size_t ask(yard *y, double width, bool proved[SIDES])
{
    sunder_i_relaxation relaxation[SIDES];
    sunder_error err;
    size_t n = 0;
    sunder_i_id_pair bodies = {0, 0};
    memset(proved, 0, SIDES * sizeof *proved);
    for (size_t k = 0; k < y->of.start.n; k++) {
        const sunder_i_relation *r = &y->of.start.pair[k];
        if (!sunder_i_is_open_conflict(&y->of.model, r)) continue;
        const uint32_t i = y->of.model.body_of[r->a], j = y->of.model.body_of[r->b];
        bodies = i < j ? (sunder_i_id_pair){i, j} : (sunder_i_id_pair){j, i};
        assert_int_equal(sunder_i_relaxation_of(&y->of.model, r->a, r->b, &relaxation[n++], &err), SUNDER_OK);
    }
    assert_int_equal(sunder_i_find_unsolvable(&y->of.model, &bodies, relaxation, n, &err), SUNDER_OK);
    for (size_t k = 0; k < n; k++) proved[side_of(y, &relaxation[k], width)] = relaxation[k].infeasible;
    return n;
}

/* Each conflict alone has a solution; with the others none has, since the opposite side is equally near. */
static void check_no_place(void **state)
{
    yard y;
    bool proved[SIDES];
    begin(&y, 0.5);
    assert_int_equal(ask(&y, 3, proved), 4);
    for (int k = 0; k < SIDES; k++) assert_true(proved[k]);
    end(&y);
    (void)state;
}

/* There is room in the east. */
static void check_place(void **state)
{
    yard y;
    bool proved[SIDES];
    begin(&y, 1.75);
    assert_int_equal(ask(&y, 4.25, proved), 3);
    assert_false(proved[WEST]);
    assert_true(proved[SOUTH]);
    assert_true(proved[NORTH]);
    end(&y);
    (void)state;
}

/* A conflict that has no solution within the limits has to be no worse than at the start, and nothing more. */
static void check_others(void **state)
{
    yard y;
    bool proved[SIDES];
    begin(&y, 0.5);
    for (size_t k = 0; k < y.of.start.n; k++) {
        const sunder_i_relation *r = &y.of.start.pair[k];
        sunder_i_relaxation t;
        sunder_error err;
        if (!sunder_i_is_open_conflict(&y.of.model, r)) continue;
        assert_int_equal(sunder_i_relaxation_of(&y.of.model, r->a, r->b, &t, &err), SUNDER_OK);
        if (side_of(&y, &t, 3) != EAST) continue;
        t.infeasible = true;
        t.gap = 0;
        assert_true(sunder_i_relaxations_add(&y.of.model.relaxations, &t));
    }
    assert_true(sunder_i_relaxations_index(&y.of.model.relaxations, &y.of.model));
    assert_int_equal(ask(&y, 3, proved), 3);
    assert_false(proved[WEST]);
    assert_true(proved[SOUTH]);
    assert_true(proved[NORTH]);
    end(&y);
    (void)state;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_no_place), cmocka_unit_test(check_place),
                                       cmocka_unit_test(check_others)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
