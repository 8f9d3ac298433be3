/* sunder_layer_check_moves(): each move that violates a rule is reported with the rule, and no others are. */
#include "polyset.h"
#include "sunder.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 4 };

typedef struct scene {
    sunder_feature was[MOST], is[MOST];
    sunder_barrier barrier; /* of the original layer, if it has one */
    size_t n;
    sunder_layer_options options;
    sunder_report *report;
    const sunder_conflict *found;
    size_t found_n;
} scene;

static void begin(scene *s, double gap)
{
    memset(s, 0, sizeof *s);
    sunder_layer_options_init(&s->options);
    s->options.gap = gap;
}

/* Adds a feature with its geometries before and after. */
static sunder_feature *add(scene *s, const char *was, const char *is)
{
    sunder_feature *f = &s->was[s->n];
    *f = (sunder_feature){.weight = 1, .max_shift = INFINITY, .block = -1};
    s->is[s->n] = *f;
    f->shape = polyset_shape_of_wkt(was);
    s->is[s->n++].shape = polyset_shape_of_wkt(is);
    assert_non_null(f->shape);
    return f;
}

static void run(scene *s)
{
    sunder_layer *before = NULL, *after = NULL;
    assert_int_equal(sunder_layer_new(s->was, s->n, &before, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_new(s->is, s->n, &after, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_set_barriers(before, &s->barrier, 1, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_check_moves(before, after, &s->options, &s->report, NULL), SUNDER_OK);
    s->found = sunder_report_conflicts(s->report, &s->found_n);
    sunder_layer_summary summary;
    sunder_report_summary(s->report, &summary);
    assert_int_equal(summary.verified, s->found_n == 0);
    sunder_layer_free(before);
    sunder_layer_free(after);
}

static void end(scene *s)
{
    sunder_report_free(s->report);
    for (size_t k = 0; k < s->n; k++) {
        sunder_shape_free((sunder_shape *)s->was[k].shape);
        sunder_shape_free((sunder_shape *)s->is[k].shape);
    }
}

#define HOUSE "POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0))"
#define NEIGHBOUR "POLYGON ((6 0, 10 0, 10 4, 6 4, 6 0))"

static void check_translates(void **state)
{
    static const struct {
        const char *is;
        bool translate;
    } cases[] = {{HOUSE, true},
                 {"POLYGON ((1 2, 5 2, 5 6, 1 6, 1 2))", true},
                 {"POLYGON ((1 2, 5 2, 5 6, 1 6.5, 1 2))", false},
                 {"POLYGON ((1 2, 5 2, 5 6, 1 6.000000000000001, 1 2))", false},
                 {"POLYGON ((1 2, 5 2, 5 6, 1 2))", false},
                 {"POLYGON EMPTY", false}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        scene s;
        begin(&s, 0);
        add(&s, HOUSE, cases[k].is);
        run(&s);
        assert_int_equal(s.found_n, cases[k].translate ? 0 : 1);
        if (s.found_n) {
            assert_int_equal(s.found[0].kind, SUNDER_CONFLICT_NOT_A_TRANSLATE);
            assert_true(s.found[0].a == 0 && s.found[0].b == SIZE_MAX);
        }
        end(&s);
    }
    /* Rounding: 0.1 and 0.7 from the origin, and the same from 100, each rounded to the nearest double. */
    scene s;
    begin(&s, 0);
    add(&s, "POLYGON ((0.1 0, 0.7 0, 0.7 1, 0.1 1, 0.1 0))", "POLYGON ((100.1 0, 100.7 0, 100.7 1, 100.1 1, 100.1 0))");
    run(&s);
    assert_int_equal(s.found_n, 0);
    end(&s);
}

static void check_limits(void **state)
{
    for (int k = 0; k < 4; k++) {
        scene s;
        begin(&s, 0);
        sunder_feature *f = add(&s, HOUSE, "POLYGON ((3 4, 7 4, 7 8, 3 8, 3 4))");
        f->max_shift = k == 0 ? 5 : k == 1 ? nextafter(5, 0) : INFINITY;
        f->fixed = k == 2;
        f->ignored = k == 3;
        run(&s);
        const bool breaks = k == 1 || k == 2;
        assert_int_equal(s.found_n, breaks);
        if (breaks) {
            assert_int_equal(s.found[0].kind, SUNDER_CONFLICT_LIMIT);
            assert_true(s.found[0].distance == 5 && s.found[0].to[0] == 5 && s.found[0].to[1] == 6);
        }
        end(&s);
    }
}

/* Far from the origin many moves round to the same vertices. If one of them is exact for all vertices it is taken as
 * the move, even if a shorter one would be within the limit. */
static void check_exact_moves(void **state)
{
    const double move = 5 + 0x1p-33;
    char is[256];
    snprintf(is, sizeof is, "POLYGON ((%.17g 0, %.17g 0, %.17g 1, %.17g 0))", 400000 + move, 400002 + move,
             400002 + move, 400000 + move);
    for (int k = 0; k < 2; k++) {
        scene s;
        begin(&s, 0);
        add(&s, "POLYGON ((400000 0, 400002 0, 400002 1, 400000 0))", is)->max_shift = k ? nextafter(move, 0) : move;
        run(&s);
        assert_int_equal(s.found_n, k);
        if (k) assert_true(s.found[0].kind == SUNDER_CONFLICT_LIMIT && s.found[0].distance == move);
        end(&s);
    }
}

static void check_jumps(void **state)
{
    for (int k = 0; k < 4; k++) {
        scene s;
        begin(&s, 0);
        add(&s, HOUSE, "POLYGON ((12 0, 16 0, 16 4, 12 4, 12 0))");
        /* The neighbour stays, or moves equally far, or moves away, so that the paths do not meet it. */
        add(&s, NEIGHBOUR,
            k == 1   ? "POLYGON ((18 0, 22 0, 22 4, 18 4, 18 0))"
            : k == 2 ? "POLYGON ((6 64, 10 64, 10 68, 6 68, 6 64))"
                     : NEIGHBOUR);
        if (k == 3) s.was[0].block = s.was[1].block = 7;
        run(&s);
        assert_int_equal(s.found_n, k == 0 ? 2 : 0); /* both jump: each crosses the other, relative to it */
        if (s.found_n) {
            assert_int_equal(s.found[0].kind, SUNDER_CONFLICT_JUMP);
            assert_true(s.found[0].a == 0 && s.found[0].b == 1 && s.found[0].from[0] == 2 && s.found[0].to[0] == 14);
            assert_true(s.found[1].a == 1 && s.found[1].b == 0 && s.found[1].from[0] == 8 && s.found[1].to[0] == -4);
        }
        end(&s);
    }
    scene s;
    begin(&s, 0);
    add(&s, HOUSE, "POLYGON ((12 0, 16 0, 16 4, 12 4, 12 0))");
    add(&s, NEIGHBOUR, NEIGHBOUR);
    s.options.allow_jumps = true;
    run(&s);
    assert_int_equal(s.found_n, 0);
    end(&s);
}

/* A house that moves 8 to the right, beside a line; its side anchor is (2, 2) unless the line cuts the house. */
static void check_sides(void **state)
{
    static const struct {
        double xy[6];
        size_t points;
        bool side, crosses;
        double from[2];
    } line[] = {
        {{5, -9, 5, 9}, 2, true, true, {2, 2}},         /* the line crosses the path */
        {{5, -9, 5, 9}, 2, false, false, {0, 0}},       /* the same line without sides: allowed */
        {{5, 9, 5, 2}, 2, true, true, {2, 2}},          /* the path touches its end */
        {{5, 9, 5, 3}, 2, true, false, {0, 0}},         /* the path passes below it */
        {{12, -9, 12, 9}, 2, true, false, {0, 0}},      /* the house reaches the line, but its anchor does not */
        {{1, -9, 1, 9}, 2, true, false, {0, 0}},        /* cuts a small part off, in front of the anchor's side */
        {{3, -9, 3, 9}, 2, true, true, {2, 2}},         /* cuts a small part off on the other side */
        {{2, -9, 2, 9}, 2, true, true, {1, 2}},         /* halves: the anchor is the centre of the left one */
        {{2, -9, 2, 3, 6, 9}, 3, true, true, {2, 1.5}}, /* the line meets the anchor: the larger part is beside it and
                                                         * below */
        {{3, 2}, 1, true, false, {0, 0}},               /* points have no sides */
    };
    for (size_t k = 0; k < sizeof line / sizeof *line; k++) {
        scene s;
        begin(&s, 0);
        add(&s, HOUSE, "POLYGON ((8 0, 12 0, 12 4, 8 4, 8 0))");
        s.barrier = (sunder_barrier){{NULL, line[k].xy, &line[k].points, 1}, 0, 0, line[k].side, 0};
        run(&s);
        size_t sides = 0;
        for (size_t i = 0; i < s.found_n; i++) {
            if (s.found[i].kind != SUNDER_CONFLICT_SIDE) continue;
            sides++;
            assert_true(s.found[i].a == 0 && s.found[i].b == 1);
            if (k != 8) assert_true(s.found[i].from[0] == line[k].from[0] && s.found[i].from[1] == line[k].from[1]);
            assert_true(s.found[i].to[0] == s.found[i].from[0] + 8);
        }
        assert_int_equal(sides, line[k].crosses);
        end(&s);
    }
}

/* The number of times that the house crosses the boundary of an area, on its path of 8 to the right. Frees the area. */
static size_t crossings_of(sunder_shape *area)
{
    scene s;
    size_t sides = 0;
    assert_non_null(area);
    begin(&s, 0);
    add(&s, HOUSE, "POLYGON ((8 0, 12 0, 12 4, 8 4, 8 0))");
    s.barrier = (sunder_barrier){{.shape = area}, 0, 0, true, 0};
    run(&s);
    for (size_t i = 0; i < s.found_n; i++) sides += s.found[i].kind == SUNDER_CONFLICT_SIDE;
    sunder_shape_free(area);
    end(&s);
    return sides;
}

/* The same for areas: a path inside the area, out of it, out and in again, past it. */
static void check_sides_of_areas(void **state)
{
    static const struct {
        const char *area;
        bool crosses;
    } area[] = {
        {"POLYGON ((6 -9, 20 -9, 20 9, 6 9, 6 -9))", true},
        {"POLYGON ((-9 -9, 6 -9, 6 9, -9 9, -9 -9))", false},
        {"POLYGON ((-9 -9, 20 -9, 20 9, 9 9, 9 -5, 6 -5, 6 9, -9 9, -9 -9))", true},
        {"POLYGON ((-9 -9, 20 -9, 20 9, 12 9, 12 -5, 6 -5, 6 9, -9 9, -9 -9))", false},
        {"POLYGON ((6 3, 8 3, 8 5, 6 5, 6 3))", false},
        {"POLYGON ((6 1, 8 1, 8 5, 6 5, 6 1))", true},
        {"POLYGON ((-9 -9, 20 -9, 20 9, -9 9, -9 -9), (-1 -1, -1 6, 6 6, 6 -1, -1 -1))", true},
        {"POLYGON ((-9 -9, 20 -9, 20 9, -9 9, -9 -9), (6 1, 6 3, 8 3, 8 1, 6 1))", true},
    };
    for (size_t k = 0; k < sizeof area / sizeof *area; k++) {
        const size_t crossings = crossings_of(polyset_shape_of_wkt(area[k].area));
        if (crossings != area[k].crosses) print_error("area %zu\n", k);
        assert_int_equal(crossings, area[k].crosses);
    }
}

/* Areas that cross themselves, some of them at places that are not doubles. */
static void check_sides_of_repaired_areas(void **state)
{
    static const struct {
        double xy[8];
        bool crosses;
    } area[] = {
        {{6, -6, 12, 12, 12, -6, 6, 12}, true},   /* into it, by an edge that begins at the crossing */
        {{7, 1, 8, 3, 8, 1, 7, 4}, true},         /* through both of its parts */
        {{-1, -3, 11, 8, 11, -4, -1, 8}, true},   /* out of one part, and into the other */
        {{-9, -9, 8, 2.125, 8, -9, -9, 9}, true}, /* out of one part, and into the other beyond the crossing */
        {{7, 2.5, 8, 4, 8, 2.5, 7, 5}, false},    /* past it */
    };
    const size_t ring_end = 4, poly_end = 1;
    for (size_t k = 0; k < sizeof area / sizeof *area; k++) {
        sunder_shape *shape = NULL;
        assert_int_equal(
            sunder_shape_from_rings(area[k].xy, &ring_end, &poly_end, 1, SUNDER_VALIDITY_EVEN_ODD, &shape, NULL),
            SUNDER_OK);
        const size_t crossings = crossings_of(shape);
        if (crossings != area[k].crosses) print_error("area %zu\n", k);
        assert_int_equal(crossings, area[k].crosses);
    }
}

static void check_worse(void **state)
{
    /* Two features 1 apart with a gap of 3: they come nearer, farther apart, or overlap. */
    static const char *const to[] = {"POLYGON ((5 0, 9 0, 9 4, 5 4, 5 0))", NEIGHBOUR,
                                     "POLYGON ((7 0, 11 0, 11 4, 7 4, 7 0))", "POLYGON ((3 0, 7 0, 7 4, 3 4, 3 0))"};
    for (int k = 0; k < 4; k++) {
        scene s;
        begin(&s, 3);
        add(&s, HOUSE, HOUSE);
        add(&s, NEIGHBOUR, to[k]);
        run(&s);
        const bool worse = k == 0 || k == 3;
        assert_int_equal(s.found_n, worse);
        if (worse) {
            assert_int_equal(s.found[0].kind, SUNDER_CONFLICT_WORSE);
            assert_true(s.found[0].before == 2 && s.found[0].distance == (k == 0 ? 1 : 0));
        }
        end(&s);
    }
}

static void check_sizes(void **state)
{
    scene s;
    begin(&s, 0);
    add(&s, HOUSE, HOUSE);
    sunder_layer *one = NULL, *none = NULL;
    sunder_report *report = NULL;
    assert_int_equal(sunder_layer_new(s.was, 1, &one, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_new(s.was, 0, &none, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_check_moves(one, none, NULL, &report, NULL), SUNDER_EARG);
    assert_null(report);
    assert_int_equal(sunder_layer_check_moves(none, none, NULL, &report, NULL), SUNDER_OK);
    sunder_report_free(report);
    sunder_layer_free(one);
    sunder_layer_free(none);
    s.report = NULL;
    end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_translates),     cmocka_unit_test(check_limits),
        cmocka_unit_test(check_exact_moves),
        cmocka_unit_test(check_jumps),          cmocka_unit_test(check_sides),
        cmocka_unit_test(check_sides_of_areas), cmocka_unit_test(check_sides_of_repaired_areas),
        cmocka_unit_test(check_worse),          cmocka_unit_test(check_sizes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
