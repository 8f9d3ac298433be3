/* Laws of preferred places (sunder_layer_set_preferred()), on streets of boxes beside a road: a layout in which nothing
 * is short, preferred, is the result, and costs nothing; what cannot move prefers nothing; the cost counts from the
 * preferred places, and the bound does not exceed it; limits count from where features stand; a street in line has the
 * least cost of a quadratic program in one dimension, springs included. That the cost is the optimum without rows is
 * tested beside the oracle (test_displacement_optimum.c). */
#include "random.h"
#include "upheld.h"

#include "sunder.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 24 };

typedef struct street {
    sunder_feature feature[MOST];
    double preferred[2 * MOST];
    size_t n;
    sunder_layer_options options;
    double road[4];
    size_t road_end;
    sunder_barrier barrier;
    bool has_road;
} street;

static sunder_shape *box_shape(double x, double y, double w, double h)
{
    const double xy[8] = {x, y, x + w, y, x + w, y + h, x, y + h};
    const size_t ring_end = 4, rings = 1;
    sunder_shape *shape = NULL;
    sunder_error err;
    if (sunder_shape_from_rings(xy, &ring_end, &rings, 1, SUNDER_VALIDITY_STRICT, &shape, &err))
        fail_msg("%s", err.message);
    return shape;
}

/* Two rows of boxes with little room between them, and a road between the rows. */
static void build(rng *r, street *s)
{
    const double at = rng_once_in(r, 2) ? 0 : 400000;
    *s = (street){.has_road = rng_once_in(r, 2)};
    sunder_layer_options_init(&s->options);
    s->options.gap = (double)rng_int(r, 1, 8) / 4;
    s->options.allow_jumps = rng_once_in(r, 2);
    s->options.no_blocks = rng_once_in(r, 2);
    s->options.rows = rng_once_in(r, 2) ? SUNDER_ROWS_FOUND : SUNDER_ROWS_NONE;
    const bool limits = rng_once_in(r, 2), weights = rng_once_in(r, 3);
    for (int row = 0; row < 2; row++) {
        double x = at;
        for (int64_t k = rng_int(r, 2, 10); k > 0; k--) {
            const double w = (double)rng_int(r, 4, 12), y = at + 20 * row + (double)rng_int(r, 0, 8) / 8;
            sunder_feature *f = &s->feature[s->n++];
            *f = (sunder_feature){.weight = 1, .max_shift = INFINITY, .block = -1};
            f->shape = box_shape(x, y, w, (double)rng_int(r, 8, 10));
            if (weights) f->weight = (double)rng_int(r, 1, 16) / 4;
            if (limits) f->max_shift = (double)rng_int(r, 0, 40) / 4;
            x += w + (double)rng_int(r, -2, 16) / 4;
        }
    }
    s->road_end = 2;
    memcpy(s->road, (double[]){at - 50, at + 15, at + 200, at + 15}, sizeof s->road);
    s->barrier = (sunder_barrier){
        .geometry = {.xy = s->road, .line_end = &s->road_end, .lines = 1}, .width = 1, .gap = -1, .side = true};
}

static void end(street *s)
{
    for (size_t k = 0; k < s->n; k++) sunder_shape_free((sunder_shape *)s->feature[k].shape);
}

static sunder_status try_separate(const street *s, const double *preferred, sunder_report **report)
{
    sunder_layer *layer = NULL;
    sunder_error err;
    if (sunder_layer_new(s->feature, s->n, &layer, &err) ||
        sunder_layer_set_barriers(layer, &s->barrier, s->has_road, &err) ||
        sunder_layer_set_preferred(layer, preferred, &err))
        fail_msg("%s", err.message);
    const sunder_status status = sunder_layer_separate(layer, &s->options, report, &err);
    sunder_layer_free(layer);
    return status;
}

static sunder_report *separate(const street *s, const double *preferred, sunder_layer_summary *summary)
{
    sunder_report *report = NULL;
    if (try_separate(s, preferred, &report)) fail_msg("the layer cannot be separated");
    sunder_report_summary(report, summary);
    assert_true(summary->verified);
    if (!s->has_road) { /* that rule is tested without barriers */
        const char *worse = upheld_breach(s->feature, s->n, &s->options, report);
        if (worse) fail_msg("%s", worse);
    }
    return report;
}

static void take_moves(const street *s, const sunder_report *report, double *move)
{
    for (size_t k = 0; k < s->n; k++) sunder_report_move(report, k, &move[2 * k], &move[2 * k + 1]);
}

static bool leaves_conflicts(const sunder_report *report)
{
    size_t n, left = 0;
    const sunder_conflict *c = sunder_report_conflicts(report, &n);
    for (size_t k = 0; k < n; k++) left += !c[k].inside_block;
    return left > 0;
}

/* Both zeros are the same move. */
static bool are_equal(const double *a, const double *b, size_t n)
{
    for (size_t k = 0; k < n; k++)
        if (a[k] != b[k]) return false;
    return true;
}

/* A layout that was found once, preferred: found again, to the bit, and free. */
static void test_layout_is_kept(void **state)
{
    (void)state;
    size_t kept = 0, moved = 0;
    for (size_t i = 0; i < test_count(60); i++) {
        rng r = rng_start(test_seed(), i);
        street s;
        sunder_layer_summary first, again;
        double move[2 * MOST], next[2 * MOST];
        build(&r, &s);
        sunder_report *report = separate(&s, NULL, &first), *other;
        take_moves(&s, report, move);
        if (!leaves_conflicts(report)) {
            other = separate(&s, move, &again);
            take_moves(&s, other, next);
            if (!are_equal(move, next, 2 * s.n) || again.cost != 0 || again.lower_bound != 0)
                fail_msg("seed %llu, case %zu: cost %.17g, bound %.17g", (unsigned long long)test_seed(), i, again.cost,
                         again.lower_bound);
            assert_int_equal(again.moved, first.moved);
            kept++;
            moved += first.moved;
            sunder_report_free(other);
        }
        sunder_report_free(report);
        end(&s);
    }
    printf("%zu layouts kept, %zu moved features\n", kept, moved);
    assert_true(kept > 0 && moved > 0);
}

static double cost_of(const street *s, const double *move)
{
    double cost = 0;
    for (size_t k = 0; k < s->n; k++) {
        const double x = move[2 * k] - s->preferred[2 * k], y = move[2 * k + 1] - s->preferred[2 * k + 1];
        if (s->feature[k].max_shift > 0) cost += s->feature[k].weight * (x * x + y * y);
    }
    return cost;
}

/* Moves within twice the limit, some of them those of the neighbour. */
static void choose_preferred(rng *r, street *s)
{
    for (size_t k = 0; k < s->n; k++) {
        const int64_t kind = rng_int(r, 0, 3);
        for (size_t c = 0; c < 2 && kind; c++)
            s->preferred[2 * k + c] =
                kind == 1 && k ? s->preferred[2 * k - 2 + c] : (double)rng_int(r, -48, 48) / 8 * (c ? 0.5 : 1);
    }
}

/* Costs, bounds and limits for any preferred places. Blocks count from their means, so there are none here. */
static void test_costs(void **state)
{
    (void)state;
    double cost = 0, bound = 0;
    for (size_t i = 0; i < test_count(60); i++) {
        rng r = rng_start(test_seed() + 1, i);
        street s;
        sunder_layer_summary summary;
        double move[2 * MOST];
        build(&r, &s);
        s.options.no_blocks = true;
        choose_preferred(&r, &s);
        sunder_report *report = separate(&s, s.preferred, &summary);
        take_moves(&s, report, move);
        const double own = cost_of(&s, move);
        if (fabs(summary.cost_moves - own) > 1e-9 * own + 1e-9)
            fail_msg("seed %llu, case %zu: cost %.17g, not %.17g", (unsigned long long)test_seed(), i, own,
                     summary.cost_moves);
        if (summary.lower_bound > summary.cost * (1 + 1e-12))
            fail_msg("seed %llu, case %zu: bound %.17g above the cost %.17g", (unsigned long long)test_seed(), i,
                     summary.lower_bound, summary.cost);
        for (size_t k = 0; k < s.n; k++) /* exact: squares of few bits; a longer move differs by more than rounding */
            assert_true(hypot(move[2 * k], move[2 * k + 1]) <= s.feature[k].max_shift * (1 + 1e-15));
        cost += summary.cost;
        bound += summary.lower_bound;
        sunder_report_free(report);
        end(&s);
    }
    printf("cost %.6g, at least %.6g\n", cost, bound);
    assert_true(bound > 0.9 * cost);
}

/* ---- A street in line -------------------------------------------------------------------------------------------- */

enum { IN_LINE = 8 };

/* The least of sum over i, j of m_ij t_i t_j / 2 - sum b_i t_i under t_(i + 1) - t_i >= c_i, by ascent of one
 * multiplier after the other; h is the inverse of m. t receives the minimiser. */
static void solve_chain(size_t n, double h[IN_LINE][IN_LINE], const double *b, const double *c, double *t)
{
    double force[IN_LINE] = {0};
    for (int sweep = 0; sweep < 20000; sweep++)
        for (size_t k = 0; k + 1 < n; k++) {
            for (size_t i = 0; i < n; i++) {
                t[i] = 0;
                for (size_t j = 0; j < n; j++)
                    t[i] += h[i][j] * (b[j] + (j ? force[j - 1] : 0) - (j + 1 < n ? force[j] : 0));
            }
            const double square = h[k][k] + h[k + 1][k + 1] - h[k][k + 1] - h[k + 1][k];
            force[k] = fmax(0, force[k] + (c[k] - (t[k + 1] - t[k])) / square);
        }
}

/* Inverts the matrix by Gauss and Jordan; it is positive definite. */
static void invert(size_t n, double a[IN_LINE][IN_LINE], double out[IN_LINE][IN_LINE])
{
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) out[i][j] = i == j;
    for (size_t k = 0; k < n; k++) {
        const double pivot = a[k][k];
        for (size_t j = 0; j < n; j++) a[k][j] /= pivot, out[k][j] /= pivot;
        for (size_t i = 0; i < n; i++) {
            const double times = a[i][k];
            for (size_t j = 0; j < n && i != k; j++) a[i][j] -= times * a[k][j], out[i][j] -= times * out[k][j];
        }
    }
}

/* The least cost of a street in line whose houses keep their order: only moves along it matter, since across it each
 * house makes the move that it prefers. */
static double cost_in_line(const street *s, const double *apart)
{
    double matrix[IN_LINE][IN_LINE] = {{0}}, inverse[IN_LINE][IN_LINE], b[IN_LINE] = {0}, c[IN_LINE], t[IN_LINE],
           cost = 0;
    for (size_t i = 0; i < s->n; i++) {
        matrix[i][i] += 2 * s->feature[i].weight;
        b[i] += 2 * s->feature[i].weight * s->preferred[2 * i];
        if (i == 0) continue;
        const double stiff = s->options.row_stiffness[1] * fmin(s->feature[i].weight, s->feature[i - 1].weight),
                     rest = s->preferred[2 * i] - s->preferred[2 * i - 2];
        matrix[i][i] += 2 * stiff, matrix[i - 1][i - 1] += 2 * stiff;
        matrix[i][i - 1] -= 2 * stiff, matrix[i - 1][i] -= 2 * stiff;
        b[i] += 2 * stiff * rest, b[i - 1] -= 2 * stiff * rest;
        c[i - 1] = s->options.gap - apart[i - 1];
    }
    invert(s->n, matrix, inverse);
    solve_chain(s->n, inverse, b, c, t);
    for (size_t i = 0; i < s->n; i++) {
        const double off = t[i] - s->preferred[2 * i];
        cost += s->feature[i].weight * off * off;
        if (i == 0) continue;
        const double u = off - (t[i - 1] - s->preferred[2 * i - 2]);
        cost += s->options.row_stiffness[1] * fmin(s->feature[i].weight, s->feature[i - 1].weight) * u * u;
    }
    return cost;
}

static void build_in_line(rng *r, street *s, double *apart)
{
    double x = 0;
    *s = (street){.n = (size_t)rng_int(r, 3, IN_LINE)};
    sunder_layer_options_init(&s->options);
    s->options.gap = 2;
    s->options.no_blocks = true;
    s->options.rows = SUNDER_ROWS_FOUND;
    for (size_t k = 0; k < s->n; k++) {
        const double w = (double)rng_int(r, 8, 12);
        s->feature[k] = (sunder_feature){.weight = 1, .max_shift = INFINITY, .block = -1};
        if (rng_once_in(r, 2)) s->feature[k].weight = (double)rng_int(r, 2, 12) / 4;
        s->feature[k].shape = box_shape(x, 0, w, 10);
        apart[k] = (double)rng_int(r, 2, 12) / 4;
        x += w + apart[k];
        for (size_t c = 0; c < 2; c++)
            if (rng_once_in(r, 2)) s->preferred[2 * k + c] = (double)rng_int(r, -16, 16) / 8;
    }
}

static void test_street_in_line(void **state)
{
    (void)state;
    double sum = 0;
    for (size_t i = 0; i < test_count(40); i++) {
        rng r = rng_start(test_seed() + 3, i);
        street s;
        sunder_layer_summary summary;
        double apart[IN_LINE];
        build_in_line(&r, &s, apart);
        sunder_report *report = separate(&s, s.preferred, &summary);
        const double least = cost_in_line(&s, apart);
        if (!leaves_conflicts(report) && fabs(summary.cost - least) > 1e-5 * least + 1e-6)
            fail_msg("seed %llu, case %zu: cost %.12g, the least is %.12g", (unsigned long long)test_seed(), i,
                     summary.cost, least);
        if (summary.lower_bound > least * (1 + 1e-9) + 1e-9)
            fail_msg("seed %llu, case %zu: bound %.12g, the least is %.12g", (unsigned long long)test_seed(), i,
                     summary.lower_bound, least);
        sum += least;
        sunder_report_free(report);
        end(&s);
    }
    printf("cost in line %.6g\n", sum);
    assert_true(sum > 0);
}

/* The law that all zeros are as good as none; what is fixed prefers nothing. */
static void test_nothing_preferred(void **state)
{
    (void)state;
    for (size_t i = 0; i < test_count(10); i++) {
        rng r = rng_start(test_seed() + 2, i);
        street s;
        sunder_layer_summary first, again;
        double move[2 * MOST], next[2 * MOST], none[2 * MOST] = {0};
        build(&r, &s);
        s.feature[0].fixed = true;
        for (int fixed = 0; fixed < 2; fixed++) {
            none[0] = fixed;
            sunder_report *report = separate(&s, NULL, &first), *other = separate(&s, none, &again);
            take_moves(&s, report, move);
            take_moves(&s, other, next);
            assert_memory_equal(move, next, 2 * s.n * sizeof *move);
            assert_true(first.cost == again.cost && first.lower_bound == again.lower_bound);
            sunder_report_free(report);
            sunder_report_free(other);
        }
        end(&s);
    }
}

static void test_refusals(void **state)
{
    (void)state;
    rng r = rng_start(1, 0);
    street s;
    sunder_layer *layer = NULL;
    sunder_report *report = NULL;
    sunder_error err;
    double move[2 * MOST] = {1};
    build(&r, &s);
    s.options.keep_trees = true;
    assert_int_equal(try_separate(&s, move, &report), SUNDER_EARG);
    s.options.keep_trees = false;
    s.options.keep_worlds = true;
    assert_int_equal(try_separate(&s, move, &report), SUNDER_EARG);
    move[3] = NAN;
    assert_int_equal(sunder_layer_new(s.feature, s.n, &layer, &err), SUNDER_OK);
    assert_int_equal(sunder_layer_set_preferred(layer, move, &err), SUNDER_EINVALID);
    sunder_layer_free(layer);
    end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_layout_is_kept), cmocka_unit_test(test_costs),
        cmocka_unit_test(test_street_in_line), cmocka_unit_test(test_nothing_preferred),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
