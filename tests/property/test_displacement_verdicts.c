/* Verdicts on small layers with known (planted) solutions, and the rule that no conflict gets worse.
 *
 * A layer is laid out without conflicts: houses in rows, in outlines that may contain them, in courtyards; blocks by
 * number; some fixed. Then each block is moved by at most its limit. So there is a solution, and no conflict may be
 * listed as max_shift or no_room. No listed pair is worse than at the start, in rationals by brute force. A check
 * confirms that the planted layer has no conflicts, with the features that join at the start as blocks. */
#include "polyset.h"
#include "random.h"
#include "run_layer.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 16 };

typedef struct plot {
    polyset solved, start;
    sunder_feature feature;
    double back[2]; /* the move from the start to the solution */
    bool inner;     /* inside an outline: moves with the outline's block if containment joins blocks */
} plot;

typedef struct layer {
    plot plot[MOST];
    size_t n;
    sunder_layer_options options;
} layer;

/* ---- Planted layouts -------------------------------------------------------------------------------------------- */

static plot *add_plot(layer *l)
{
    plot *p = &l->plot[l->n++];
    memset(p, 0, sizeof *p);
    polyset_init(&p->solved);
    p->feature = (sunder_feature){.weight = 1, .max_shift = INFINITY, .block = -1};
    return p;
}

static plot *add_box(layer *l, double x, double y, double w, double h)
{
    plot *p = add_plot(l);
    polyset_rectangle(&p->solved, x, y, x + w, y + h);
    return p;
}

static double eighths(rng *r, int low, int high) { return (double)rng_int(r, low, high) / 8; }

/* A box, or one with a corner cut off or with a notch, in the same place. */
static plot *add_house(layer *l, rng *r, double x, double y, double w, double h)
{
    if (!rng_once_in(r, 3)) return add_box(l, x, y, w, h);
    plot *p = add_plot(l);
    if (rng_once_in(r, 2))
        polyset_polygon(&p->solved, (double[]){x, y, x + w, y, x + w, y + h / 2, x + w / 2, y + h, x, y + h}, 5);
    else
        polyset_polygon(&p->solved,
                        (double[]){x, y, x + w, y, x + w, y + h / 2, x + w / 2, y + h / 2, x + w / 2, y + h, x, y + h},
                        6);
    return p;
}

/* An outline with houses in it, separate from each other, that touch its edge or project from it by less than the
 * tolerance. Returns its width. */
static double plant_outline(layer *l, rng *r, double x, double y, double tolerance)
{
    const double gap = l->options.gap, w = eighths(r, 96, 240), h = eighths(r, 96, 160);
    const int houses = (int)rng_int(r, 1, 3);
    const double room = (w - gap * (houses - 1)) / houses;
    const int64_t block = l->options.contained == SUNDER_CONTAINMENT_IGNORE ? -1 : (int64_t)l->n;
    plot *o = add_box(l, x, y, w, h);
    o->feature.block = block;
    o->feature.fixed = rng_once_in(r, 2);
    for (int k = 0; k < houses && room >= 1; k++) {
        const double wide = fmax(1, floor(room * 8 * (0.5 + rng_unit(r) / 2)) / 8), tall = eighths(r, 8, (int)(h * 8));
        const double over = k == 0 && tolerance > 0 && rng_once_in(r, 3) ? tolerance / 2 : 0;
        plot *p = add_house(l, r, x + k * (room + gap) - over, y + (rng_once_in(r, 2) ? 0 : h - tall), wide, tall);
        p->inner = true;
        p->feature.block = block;
    }
    return w;
}

/* A closed courtyard with a house in it. */
static double plant_yard(layer *l, rng *r, double x, double y)
{
    const double gap = l->options.gap, w = eighths(r, 16, 60), h = eighths(r, 16, 60), wall = eighths(r, 4, 24);
    const double in = gap + wall + eighths(r, 0, 8), slack = eighths(r, 0, 8);
    plot *p = add_plot(l);
    const double wx = w + 2 * in + slack, wy = h + 2 * in + slack;
    const double outer[8] = {x, y, x + wx, y, x + wx, y + wy, x, y + wy};
    const double hole[8] = {x + wall,      y + wall,      x + wall,      y + wy - wall,
                            x + wx - wall, y + wy - wall, x + wx - wall, y + wall};
    for (int k = 0; k < 4; k++) polyset_vertex(&p->solved, outer[2 * k], outer[2 * k + 1]);
    polyset_end_ring(&p->solved);
    for (int k = 0; k < 4; k++) polyset_vertex(&p->solved, hole[2 * k], hole[2 * k + 1]);
    polyset_end_ring(&p->solved);
    polyset_end_polygon(&p->solved);
    p->feature.fixed = rng_once_in(r, 2);
    add_house(l, r, x + in, y + in, w, h);
    return wx;
}

/* Two features that touch, in one block by number. */
static double plant_block(layer *l, rng *r, double x, double y)
{
    const double w = eighths(r, 8, 40), h = eighths(r, 8, 40);
    const int64_t block = (int64_t)l->n;
    add_house(l, r, x, y, w, h)->feature.block = block;
    add_box(l, x + w, y, eighths(r, 8, 40), h)->feature.block = block;
    return 2 * w + 5;
}

/* The symbol of a point: an octagon. */
static double plant_symbol(layer *l, rng *r, double x, double y)
{
    const double a = eighths(r, 2, 12), b = a + eighths(r, 4, 16), c = a + b;
    plot *p = add_plot(l);
    polyset_polygon(
        &p->solved,
        (double[]){x + a, y, x + b, y, x + c, y + a, x + c, y + b, x + b, y + c, x + a, y + c, x, y + b, x, y + a}, 8);
    return c;
}

static void lay_out(layer *l, rng *r, double tolerance)
{
    const double gap = l->options.gap;
    double x = rng_once_in(r, 2) ? 0 : 451234.5;
    const size_t wanted = (size_t)rng_int(r, 2, 10);
    while (l->n < wanted) {
        const double y = eighths(r, 0, 80);
        switch (rng_int(r, 0, 5)) {
        case 0:
        case 1:
            if (l->options.contained != SUNDER_CONTAINMENT_SEPARATE) {
                x += tolerance + plant_outline(l, r, x + tolerance, y, tolerance);
                break;
            }
            x += plant_yard(l, r, x, y);
            break;
        case 2: x += plant_yard(l, r, x, y); break;
        case 3: x += plant_block(l, r, x, y); break;
        case 4: x += plant_symbol(l, r, x, y); break;
        default: {
            const double w = eighths(r, 8, 60);
            add_house(l, r, x, y, w, eighths(r, 8, 60));
            x += w;
        }
        }
        x += gap + (rng_once_in(r, 2) ? 0 : eighths(r, 0, 16));
    }
}

/* Moves each block by multiples of 1/8 within its limit. */
static void carry_off(layer *l, rng *r)
{
    const double limit = eighths(r, 4, 64);
    const bool whole = rng_once_in(r, 3);
    for (size_t k = 0; k < l->n; k++) {
        plot *p = &l->plot[k];
        p->feature.max_shift = rng_once_in(r, 8) ? INFINITY : limit;
        p->feature.weight = rng_once_in(r, 3) ? eighths(r, 1, 64) : 1;
        p->back[0] = p->back[1] = 0;
        do {
            for (int c = 0; c < 2; c++) p->back[c] = eighths(r, -64, 64);
            if (whole) {
                const int c = rng_once_in(r, 2);
                p->back[c] = copysign(limit, p->back[c]);
                p->back[1 - c] = 0;
            }
        } while (hypot(p->back[0], p->back[1]) > limit);
        size_t first = k;
        for (size_t m = 0; m < k; m++)
            if (p->feature.block >= 0 && l->plot[m].feature.block == p->feature.block) {
                first = m;
                break;
            }
        if (first < k) {
            memcpy(p->back, l->plot[first].back, sizeof p->back);
            p->feature.fixed = l->plot[first].feature.fixed;
            p->feature.max_shift = l->plot[first].feature.max_shift;
        }
        if (p->feature.fixed) p->back[0] = p->back[1] = 0;
        polyset_copy(&p->start, &p->solved);
        polyset_move(&p->start, -p->back[0], -p->back[1]);
        p->feature.shape = polyset_shape(&p->start);
        assert_non_null(p->feature.shape);
    }
}

static void plant(rng *r, layer *l)
{
    memset(l, 0, sizeof *l);
    sunder_layer_options_init(&l->options);
    l->options.allow_jumps = true; /* a planted place may be behind a neighbour */
    l->options.gap = rng_once_in(r, 4) ? 0 : eighths(r, 1, 24);
    l->options.contained = (sunder_containment)rng_int(r, 0, 2);
    l->options.touch_tolerance = l->options.gap > 0 && rng_once_in(r, 2) ? l->options.gap / 4 : 0;
    l->options.no_blocks = l->options.gap > 0 && rng_once_in(r, 2);
    lay_out(l, r, l->options.touch_tolerance);
    carry_off(l, r);
}

static void clear(layer *l)
{
    for (size_t k = 0; k < l->n; k++) {
        polyset_free(&l->plot[k].solved);
        polyset_free(&l->plot[k].start);
        sunder_shape_free((sunder_shape *)l->plot[k].feature.shape);
    }
}

/* ---- Verdicts --------------------------------------------------------------------------------------------------- */

static size_t count(const sunder_conflict_counts *c)
{
    return c->overlap + c->too_close + c->barrier + c->barrier_drawn + c->barrier_near + c->contained + c->duplicate;
}

/* Is the planted layout a solution by the rules: do the blocks of the start move as one, and are there no conflicts? */
static bool is_solution(const layer *l, const sunder_report *report)
{
    sunder_feature feature[MOST];
    sunder_layer_options o = l->options;
    bool rigid = true;
    for (size_t a = 0; a < l->n; a++)
        for (size_t b = 0; b < a; b++)
            rigid = rigid && (sunder_report_block(report, a) < 0 ||
                              sunder_report_block(report, a) != sunder_report_block(report, b) ||
                              memcmp(l->plot[a].back, l->plot[b].back, sizeof l->plot[a].back) == 0);
    if (!rigid) return false;
    o.no_blocks = true;
    for (size_t k = 0; k < l->n; k++) {
        feature[k] = l->plot[k].feature;
        feature[k].shape = polyset_shape(&l->plot[k].solved);
        feature[k].block = sunder_report_block(report, k);
    }
    sunder_report *solved = run_check(feature, l->n, &o);
    sunder_layer_summary s;
    sunder_report_summary(solved, &s);
    sunder_report_free(solved);
    for (size_t k = 0; k < l->n; k++) sunder_shape_free((sunder_shape *)feature[k].shape);
    return count(&s.after) == 0;
}

static void check_planted(void **state)
{
    (void)state;
    size_t before = 0, open = 0, planted = 0;
    const size_t trials = test_count(1000);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed(), trial);
        layer l;
        plant(&r, &l);
        sunder_feature feature[MOST];
        for (size_t k = 0; k < l.n; k++) feature[k] = l.plot[k].feature;
        sunder_report *report = run_separate(feature, l.n, &l.options);
        sunder_layer_summary s;
        sunder_report_summary(report, &s);
        assert_true(s.verified);
        size_t n;
        const sunder_conflict *c = sunder_report_conflicts(report, &n);
        if (is_solution(&l, report)) {
            planted++;
            before += count(&s.before);
            open += count(&s.after);
            for (size_t k = 0; k < n; k++)
                if (c[k].reason == SUNDER_REASON_MAX_SHIFT || c[k].reason == SUNDER_REASON_NO_ROOM || c[k].crowded)
                    fail_msg("trial %zu: %zu and %zu are listed as %s, but a solution was planted", trial, c[k].a,
                             c[k].b, sunder_reason_string(c[k].reason));
        }
        sunder_report_free(report);
        clear(&l);
    }
    print_message("%zu of %zu layers have their solution, of %zu conflicts %zu are left\n", planted, trials, before,
                  open);
    assert_true(planted * 2 > trials && before > planted);
    assert_true(open * 5 <= before);
}

/* ---- Corridors -------------------------------------------------------------------------------------------------- */

/* A quadrangle with two sides along (ex, ey), from (x, y). */
static plot *add_slanted(layer *l, const double o[2], const double e[2], double along, double across, double from,
                         double off)
{
    plot *p = add_plot(l);
    const double n[2] = {-e[1], e[0]};
    double xy[8];
    for (int k = 0; k < 4; k++) {
        const double s = from + (k == 1 || k == 2 ? along : 0), t = off + (k > 1 ? across : 0);
        for (int c = 0; c < 2; c++) xy[2 * k + c] = o[c] + s * e[c] + t * n[c];
    }
    polyset_polygon(&p->solved, xy, 4);
    return p;
}

/* A slanted corridor between fixed walls. A body in it that is too near to both walls, or exactly between them, is
 * pressed along it by others, and no double represents such a move exactly. The other features, outside the corridor,
 * have room. */
static void check_corridors(void **state)
{
    (void)state;
    size_t open = 0, before = 0, moved = 0;
    const size_t trials = test_count(200);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed(), trial);
        layer l;
        memset(&l, 0, sizeof l);
        sunder_layer_options_init(&l.options);
        l.options.gap = rng_once_in(&r, 3) ? 0 : eighths(&r, 8, 24);
        l.options.touch_tolerance = 0;
        l.options.no_blocks = true;
        l.options.contained = SUNDER_CONTAINMENT_SEPARATE;
        const double angle = 6.28 * rng_unit(&r), e[2] = {cos(angle), sin(angle)};
        const double o[2] = {rng_once_in(&r, 2) ? 451234.567 : 0.1, rng_once_in(&r, 2) ? 5411234.321 : 0.3};
        const double wide = 3 + 3 * rng_unit(&r), gap = l.options.gap;
        const double slack = gap * (rng_once_in(&r, 2) ? 0.5 * rng_unit(&r) : rng_unit(&r) < 0.5 ? 1 : 0);
        add_slanted(&l, o, e, 60, 4, 0, -4)->feature.fixed = true;
        add_slanted(&l, o, e, 60, 4, 0, wide + 2 * slack)->feature.fixed = true;
        const int houses = (int)rng_int(&r, 2, 4);
        const double limit = rng_once_in(&r, 3) ? 20 : 0.5 + 3 * rng_unit(&r);
        double at = 15;
        for (int k = 0; k < houses; k++) {
            const double along = 2 + 4 * rng_unit(&r);
            add_slanted(&l, o, e, along, wide, at, slack)->feature.max_shift = limit;
            at += along + (rng_once_in(&r, 2) ? -0.5 : 0.3) * rng_unit(&r) * fmax(gap, 1);
        }
        add_slanted(&l, o, e, 5, 5, 10, wide + 2 * slack + 4 + gap / 2)->feature.max_shift = 20;
        sunder_feature feature[MOST];
        for (size_t k = 0; k < l.n; k++) {
            polyset_copy(&l.plot[k].start, &l.plot[k].solved);
            l.plot[k].feature.shape = polyset_shape(&l.plot[k].start);
            feature[k] = l.plot[k].feature;
        }
        sunder_report *report = run_separate(feature, l.n, &l.options);
        sunder_layer_summary s;
        sunder_report_summary(report, &s);
        assert_true(s.verified);
        before += count(&s.before);
        open += count(&s.after);
        moved += s.moved;
        double d[2];
        sunder_report_move(report, l.n - 1, &d[0], &d[1]);
        if (gap > 0 && hypot(d[0], d[1]) < gap / 4)
            fail_msg("trial %zu: the house beside the corridor does not move", trial);
        sunder_report_free(report);
        clear(&l);
    }
    print_message("%zu conflicts in corridors, %zu are left; %zu moved\n", before, open, moved);
    assert_true(open > 0 && moved > trials);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_planted), cmocka_unit_test(check_corridors)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
