/* Rows in small layers: which neighbours belong to a row, and where it ends. */
#include "failing.h"
#include "scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

/* A scene in which nothing moves, to find rows in it. */
static void begin(scene *s, double gap)
{
    scene_begin(s, gap);
    s->options.rows = SUNDER_ROWS_FOUND;
}

static const sunder_row *rows_of(scene *s, size_t *n)
{
    for (size_t f = 0; f < s->n; f++) s->feature[f].fixed = true;
    scene_separate(s);
    const sunder_row *row = sunder_report_rows(s->report, n);
    assert_int_equal(s->summary.rows, *n);
    return row;
}

static size_t count_rows(scene *s)
{
    size_t n;
    rows_of(s, &n);
    return n;
}

static void add_houses(scene *s, size_t n, double x, double y, double dx, double dy)
{
    for (size_t k = 0; k < n; k++) scene_add_box(s, x + dx * (double)k, y + dy * (double)k, 10, 10);
}

static void check_street(void **state)
{
    (void)state;
    scene s;
    size_t n;
    begin(&s, 5);
    add_houses(&s, 4, 0, 0, 12, 0);
    const sunder_row *row = rows_of(&s, &n);
    assert_int_equal(n, 1);
    assert_int_equal(row->features, 4);
    assert_int_equal(row->bodies, 4);
    assert_false(row->ring);
    for (size_t k = 0; k < 4; k++) assert_int_equal(row->feature[k], k);
    assert_true(row->kink_before == 0 && row->kink_after == 0);
    assert_int_equal(s.summary.row_features, 4);
    assert_int_equal(s.summary.row_pairs, 3);
    scene_end(&s);
}

/* Two houses are not a row, and without the option no rows are found. */
static void check_none(void **state)
{
    (void)state;
    scene s;
    begin(&s, 5);
    add_houses(&s, 2, 0, 0, 12, 0);
    assert_int_equal(count_rows(&s), 0);
    add_houses(&s, 1, 24, 0, 12, 0);
    assert_int_equal(count_rows(&s), 1);
    s.options.rows = SUNDER_ROWS_NONE;
    assert_int_equal(count_rows(&s), 0);
    scene_end(&s);
}

/* Streets of three houses, with a fourth one nearby; true: it continues the row. */
static void check_ends(void **state)
{
    (void)state;
    static const struct {
        const char *fourth; /* the third one is the square (24, 0) - (34, 10), and the gap 5 */
        bool continues;
    } cases[] = {
        {"POLYGON((36 0,46 0,46 10,36 10,36 0))", true},
        {"POLYGON((54 0,64 0,64 10,54 10,54 0))", true},        /* four gaps away */
        {"POLYGON((54.1 0,64 0,64 10,54.1 10,54.1 0))", false}, /* farther away */
        {"POLYGON((36 4,46 4,46 14,36 14,36 4))", true},        /* offset by 0.4 of the depth */
        {"POLYGON((36 4.1,46 4.1,46 14.1,36 14.1,36 4.1))", false},
        {"POLYGON((36 0,46 0,46 25,36 25,36 0))", true}, /* 2.5 times as deep, with a common front */
        {"POLYGON((36 0,46 0,46 25.1,36 25.1,36 0))", false},
        {"POLYGON((36 0,45 4,41 13,32 9,36 0))", false},  /* turned by 24 degrees */
        {"POLYGON((36 0,46 2,44 12,34 10,36 0))", true},  /* turned by 11 degrees */
        {"POLYGON((32 0,46 0,46 10,32 10,32 0))", true},  /* overlaps the third one a little */
        {"POLYGON((26 1,36 1,36 11,26 11,26 1))", false}, /* overlaps most of it */
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        scene s;
        size_t n;
        begin(&s, 5);
        s.options.no_blocks = true;
        add_houses(&s, 3, 0, 0, 12, 0);
        scene_add(&s, cases[k].fourth);
        const sunder_row *row = rows_of(&s, &n);
        if (n != 1 || row->features != (cases[k].continues ? 4 : 3)) fail_msg("case %zu: %s", k, cases[k].fourth);
        scene_end(&s);
    }
}

/* A step may be longer than the gap, by half. */
static void check_steps(void **state)
{
    (void)state;
    static const struct {
        double gap, step;
        bool is_row;
    } cases[] = {{3, 3.9, true}, {3, 4.1, false}, {2, 2.9, true}, {2, 3.1, false}, {10, 3.9, true}, {10, 4.1, false}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        scene s;
        begin(&s, cases[k].gap);
        add_houses(&s, 3, 0, 0, 12, cases[k].step);
        if (count_rows(&s) != cases[k].is_row) fail_msg("case %zu", k);
        scene_end(&s);
    }
}

/* Three houses and a terrace of three, with a wing across the row or with one that closes a yard: a terrace is deeper
 * than its deepest house by 0.75 of it, or it is in no row. */
static void check_wings(void **state)
{
    (void)state;
    static const struct {
        const char *wing[3];
        bool continues;
    } cases[] = {
        {{NULL}, true},
        {{"POLYGON((36 10,46 10,46 17,36 17,36 10))"}, true},
        {{"POLYGON((36 10,46 10,46 18,36 18,36 10))"}, false},
        {{"POLYGON((56 10,66 10,66 18,56 18,56 10))"}, false},
        {{"POLYGON((36 10,66 10,66 24,36 24,36 10))"}, true}, /* the deepest house is 14 deep */
        {{"POLYGON((36 10,41 10,41 20,36 20,36 10))", "POLYGON((61 10,66 10,66 20,61 20,61 10))",
          "POLYGON((36 20,66 20,66 25,36 25,36 20))"},
         false},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        scene s;
        size_t n;
        begin(&s, 5);
        add_houses(&s, 3, 0, 0, 12, 0);
        add_houses(&s, 3, 36, 0, 10, 0);
        for (size_t w = 0; w < 3 && cases[k].wing[w]; w++) scene_add(&s, cases[k].wing[w]);
        const sunder_row *row = rows_of(&s, &n);
        if (n != 1 || row->bodies != (cases[k].continues ? 4 : 3)) fail_msg("case %zu", k);
        scene_end(&s);
    }
}

/* A shed that is nearer to two houses than they are to each other removes their link. */
static void check_between(void **state)
{
    (void)state;
    scene s;
    begin(&s, 5);
    add_houses(&s, 3, 0, 0, 26, 0);
    assert_int_equal(count_rows(&s), 1);
    scene_add(&s, "POLYGON((15 4,21 4,21 7,15 7,15 4))");
    assert_int_equal(count_rows(&s), 0);
    scene_end(&s);
}

/* A house at a corner belongs to both streets. */
static void check_corner(void **state)
{
    (void)state;
    scene s;
    size_t n;
    begin(&s, 5);
    add_houses(&s, 4, 0, 0, 12, 0);
    add_houses(&s, 3, 0, 12, 0, 12);
    const sunder_row *row = rows_of(&s, &n);
    assert_int_equal(n, 2);
    for (size_t k = 0; k < 2; k++) assert_int_equal(row[k].feature[0], 0);
    assert_int_equal(s.summary.row_features, 7);
    scene_end(&s);
}

enum { HOUSES = 40 };

/* Adds houses around a round plaza, counter-clockwise: `first` to `last` of HOUSES, which begin in the east. */
static void add_ring(scene *s, int first, int last)
{
    for (int k = first; k <= last; k++) {
        const double turn = 2 * acos(-1) * k / HOUSES, c = cos(turn), d = sin(turn);
        char wkt[512];
        const double corner[4][2] = {{80, -5}, {90, -5}, {90, 5}, {80, 5}};
        int at = snprintf(wkt, sizeof wkt, "POLYGON((");
        for (int v = 0; v <= 4; v++) {
            const double *p = corner[v % 4];
            at += snprintf(wkt + at, sizeof wkt - (size_t)at, "%s%.17g %.17g", v ? "," : "", p[0] * c - p[1] * d,
                           p[0] * d + p[1] * c);
        }
        snprintf(wkt + at, sizeof wkt - (size_t)at, "))");
        scene_add(s, wkt);
    }
}

/* A row of houses around a round plaza is a ring. */
static void check_ring(void **state)
{
    (void)state;
    scene s;
    size_t n;
    begin(&s, 5);
    add_ring(&s, 0, HOUSES - 1);
    const sunder_row *row = rows_of(&s, &n);
    assert_int_equal(n, 1);
    assert_true(row->ring);
    assert_int_equal(row->features, HOUSES);
    assert_int_equal(row->bodies, HOUSES);
    for (size_t k = 0; k < HOUSES; k++) assert_int_equal(row->feature[k], k);
    assert_int_equal(s.summary.row_pairs, HOUSES);
    scene_end(&s);
}

/* A row that crosses itself passes a house twice and counts it once: three quarters of a round plaza, from the south to
 * the west, continued by two streets that cross. */
static void check_passed_twice(void **state)
{
    (void)state;
    scene s;
    size_t n;
    begin(&s, 5);
    add_ring(&s, -HOUSES / 4, HOUSES / 2);
    add_houses(&s, 5, -90, -75, 0, 14);
    add_houses(&s, 5, -75, -90, 14, 0);
    add_houses(&s, 2, -90, -90, -14, 0); /* the crossing, and a house beyond it */
    add_houses(&s, 1, -90, -104, 0, 0);
    const sunder_row *row = rows_of(&s, &n);
    assert_int_equal(n, 1);
    assert_false(row->ring);
    assert_int_equal(row->bodies, s.n);
    assert_int_equal(row->features, s.n + 1);
    assert_int_equal(s.summary.row_features, s.n);
    scene_end(&s);
}

/* A barrier line between two houses ends the row; a line that only passes near them, or leads to a corner of one, does
 * not. Houses with parallel walls have many shortest links: which of them is found must not matter. */
static void check_barrier(void **state)
{
    (void)state;
    static const struct {
        double line[4];
        size_t houses;
    } cases[] = {{{23, -50, 23, 50}, 4}, {{-50, 12, 80, 12}, 6}, {{23, -50, 23, 2}, 6},
                 {{23, 8, 23, 50}, 6},   {{22, 0, 24, 10}, 4},   {{20, -1, 26, 1}, 6}};
    static const size_t end[] = {2};
    scene s;
    begin(&s, 5);
    add_houses(&s, 6, 0, 0, 12, 0);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        for (size_t f = 0; f < s.n; f++) s.feature[f].fixed = true;
        sunder_layer *layer;
        sunder_report *report;
        size_t n;
        const sunder_barrier barrier = {.geometry = {.xy = cases[k].line, .line_end = end, .lines = 1}, .gap = 0};
        assert_int_equal(sunder_layer_new(s.feature, s.n, &layer, NULL), SUNDER_OK);
        assert_int_equal(sunder_layer_set_barriers(layer, &barrier, 1, NULL), SUNDER_OK);
        assert_int_equal(sunder_layer_separate(layer, &s.options, &report, NULL), SUNDER_OK);
        const sunder_row *row = sunder_report_rows(report, &n);
        assert_int_equal(n, 1);
        if (row->features != cases[k].houses) fail_msg("case %zu: %zu", k, row->features);
        sunder_report_free(report);
        sunder_layer_free(layer);
    }
    scene_end(&s);
}

/* A terrace is one body of the row, and its separation is that of the whole terrace. */
static void check_block(void **state)
{
    (void)state;
    scene s;
    size_t n;
    begin(&s, 5);
    add_houses(&s, 2, 0, 0, 12, 0);
    add_houses(&s, 3, 24, 0, 10, 0);
    add_houses(&s, 1, 56, 0, 12, 0);
    const sunder_row *row = rows_of(&s, &n);
    assert_int_equal(n, 1);
    assert_int_equal(row->bodies, 4);
    assert_int_equal(row->features, 5); /* the terrace counts by its first and its last house */
    assert_int_equal(row->feature[2], 2);
    assert_int_equal(row->feature[3], 4);
    scene_end(&s);
}

/* A terrace that stands across a row does not continue it, though its nearest house is in line with the row; nor does
 * one that touches the line with a wing alone. */
static void check_terrace_across(void **state)
{
    (void)state;
    scene s;
    size_t n;
    begin(&s, 5);
    add_houses(&s, 3, 0, 0, 12, 0);
    add_houses(&s, 4, 36, 0, 0, 10);
    const sunder_row *row = rows_of(&s, &n);
    assert_int_equal(n, 1);
    assert_int_equal(row->bodies, 3);
    scene_end(&s);
    begin(&s, 5);
    add_houses(&s, 3, 0, 0, 12, 0);
    add_houses(&s, 1, 36, 2, 0, 0);
    scene_add_box(&s, 46, 10, 40, 20);
    row = rows_of(&s, &n);
    assert_int_equal(n, 1);
    assert_int_equal(row->bodies, 3);
    scene_end(&s);
}

/* Kinks, in the result, are measured across the row. */
static void check_kinks(void **state)
{
    (void)state;
    scene s;
    size_t n;
    scene_begin(&s, 5);
    s.options.rows = SUNDER_ROWS_FOUND;
    s.options.kink = 0.5;
    add_houses(&s, 3, 0, 0, 16, 0);
    scene_add_box(&s, 16, 13, 10, 10);
    for (size_t f = 0; f < 4; f++) s.feature[f].fixed = f != 1;
    scene_separate(&s);
    const sunder_row *row = sunder_report_rows(s.report, &n);
    assert_int_equal(n, 1);
    assert_true(fabs(row->kink_before) <= 1e-9);
    assert_true(fabs(row->kink_after - 2) <= 1e-6);
    assert_true(fabs(s.summary.kink_mean - 2) <= 1e-6 && fabs(s.summary.kink_p95 - 2) <= 1e-6);
    assert_true(s.summary.kink_share == 1);
    scene_end(&s);
}

static void check_refusals(void **state)
{
    (void)state;
    scene s;
    begin(&s, 5);
    add_houses(&s, 3, 0, 0, 12, 0);
    sunder_layer *layer;
    sunder_report *report;
    assert_int_equal(sunder_layer_new(s.feature, s.n, &layer, NULL), SUNDER_OK);
    s.options.rows = (sunder_rows)7;
    assert_int_equal(sunder_layer_separate(layer, &s.options, &report, NULL), SUNDER_EARG);
    s.options.rows = SUNDER_ROWS_FOUND;
    s.options.kink = NAN;
    assert_int_equal(sunder_layer_separate(layer, &s.options, &report, NULL), SUNDER_EARG);
    sunder_layer_free(layer);
    scene_end(&s);
}

/* ---- Interrupted runs -------------------------------------------------------------------------------------------- */

enum { STREET = 30 };

typedef struct cut_short {
    sunder_layer *layer;
    sunder_layer_options options;
    size_t calls, most; /* of progress calls; call number `most` stops the run; 0: none does */
} cut_short;

static bool count_calls(double fraction, void *user)
{
    cut_short *c = user;
    (void)fraction;
    return ++c->calls != c->most;
}

static void begin_street(scene *s, cut_short *c)
{
    static const double xy[] = {47, -50, 47, 50};
    static const size_t end[] = {2};
    const sunder_barrier barrier = {.geometry = {.xy = xy, .line_end = end, .lines = 1}, .gap = 0};
    begin(s, 60); /* with this gap each house is within reach of all others */
    s->options.no_blocks = true;
    s->options.effort = 0;
    add_houses(s, STREET, 0, 0, 12, 0);
    for (size_t f = 0; f < s->n; f++) s->feature[f].fixed = true;
    *c = (cut_short){.options = s->options};
    assert_int_equal(sunder_layer_new(s->feature, s->n, &c->layer, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_set_barriers(c->layer, &barrier, 1, NULL), SUNDER_OK);
}

/* Returns false after a failure of the expected kind; then there is no report. */
static bool try_street(cut_short *c, sunder_status expected)
{
    sunder_report *report = NULL;
    size_t n;
    const sunder_status status = sunder_layer_separate(c->layer, &c->options, &report, NULL);
    if (status) {
        assert_int_equal(status, expected);
        assert_null(report);
        return false;
    }
    const sunder_row *row = sunder_report_rows(report, &n);
    assert_int_equal(n, 2);
    assert_int_equal(row[0].bodies + row[1].bodies, STREET);
    sunder_report_free(report);
    return true;
}

static bool try_street_without_memory(void *context) { return try_street(context, SUNDER_ENOMEM); }

/* Each allocation fails in turn. */
static void check_memory(void **state)
{
    (void)state;
    scene s;
    cut_short c;
    begin_street(&s, &c);
    failing_begin();
    const bool sound = failing_loop(try_street_without_memory, &c, true);
    failing_end();
    assert_true(sound);
    sunder_layer_free(c.layer);
    scene_end(&s);
}

/* Each call of the progress function stops the run in turn. It is called more often with rows than without them, since
 * finding rows counts its steps. */
static void check_stops(void **state)
{
    (void)state;
    scene s;
    cut_short c;
    size_t calls[2]; /* without rows, with them */
    begin_street(&s, &c);
    c.options.progress = count_calls;
    c.options.progress_user = &c;
    assert_true(try_street(&c, SUNDER_OK));
    calls[1] = c.calls;
    c.options.rows = SUNDER_ROWS_NONE;
    sunder_report *report;
    c.calls = 0;
    assert_int_equal(sunder_layer_separate(c.layer, &c.options, &report, NULL), SUNDER_OK);
    sunder_report_free(report);
    calls[0] = c.calls;
    assert_true(calls[1] > calls[0]);
    c.options.rows = SUNDER_ROWS_FOUND;
    for (c.most = 1, c.calls = 0; !try_street(&c, SUNDER_ECANCEL); c.most++, c.calls = 0)
        assert_int_equal(c.calls, c.most);
    assert_true(c.most > calls[0]);
    sunder_layer_free(c.layer);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_street),       cmocka_unit_test(check_none),     cmocka_unit_test(check_ends),
        cmocka_unit_test(check_between),      cmocka_unit_test(check_corner),   cmocka_unit_test(check_ring),
        cmocka_unit_test(check_passed_twice), cmocka_unit_test(check_barrier),  cmocka_unit_test(check_block),
        cmocka_unit_test(check_kinks),        cmocka_unit_test(check_refusals), cmocka_unit_test(check_memory),
        cmocka_unit_test(check_stops),        cmocka_unit_test(check_steps),    cmocka_unit_test(check_wings),
        cmocka_unit_test(check_terrace_across),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
