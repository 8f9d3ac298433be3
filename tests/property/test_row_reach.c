/* What decides on the neighbours of a feature in rows. A feature that does not meet the place that
 * sunder_report_row_reach() tells can be taken away, and the neighbours remain the same. If they change, the place that
 * the rest of the layer tells meets the feature that was taken away, too: a part of a layer knows that it lacks it.
 *
 * Layers are loose streets of houses of several sizes, some of them turned, some touching the next one, with a fence
 * here and there. No feature moves. */
#include "polyset.h"
#include "random.h"
#include "run_layer.h"
#include "sunder_parts.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 36, LAYERS = 300 };

typedef struct street {
    sunder_feature feature[MOST];
    size_t n;
    sunder_layer_options options;
} street;

static sunder_shape *house(rng *r, double x, double y)
{
    const double a = rng_once_in(r, 3) ? 0.3 * (rng_unit(r) - 0.5) : 0, w = 4 + 4 * rng_unit(r),
                 h = 5 + 3 * rng_unit(r);
    sunder_shape *shape = polyset_turned_rectangle(x, y, w, h, a);
    assert_non_null(shape);
    return shape;
}

/* Houses along streets, each at a distance from the one before that is up to four gaps, or touches it. */
static void lay_out(street *s, rng *r)
{
    sunder_layer_options_init(&s->options);
    s->options.gap = 1 + rng_unit(r);
    s->options.effort = 0;
    s->options.rows = SUNDER_ROWS_FOUND;
    s->options.keep_worlds = true;
    const size_t streets = rng_once_in(r, 2) ? 1 : (size_t)rng_int(r, 2, 4);
    s->n = (size_t)rng_int(r, 8, MOST);
    double x[4] = {0, 0, 0, 0};
    for (size_t k = 0; k < s->n; k++) {
        const size_t at = k % streets;
        const double step = rng_once_in(r, 6) ? 6 : 6 + 5 * s->options.gap * rng_unit(r);
        s->feature[k] = (sunder_feature){.shape = house(r, 500 + x[at], 12 * (double)at + 2 * rng_unit(r)),
                                         .weight = 1,
                                         .max_shift = INFINITY,
                                         .block = rng_once_in(r, 15) ? rng_int(r, 0, 3) : -1,
                                         .fixed = true};
        x[at] += step;
    }
}

static bool meets(const double a[4], const double b[4])
{
    return a[0] <= b[2] && b[0] <= a[2] && a[1] <= b[3] && b[1] <= a[3];
}

/* ---- Comparing -------------------------------------------------------------------------------------------------- */

/* The features of a layer that remain; from[k]: the number of feature k in the whole layer. */
typedef struct rest {
    sunder_report *report;
    size_t from[MOST], n;
} rest;

static bool is_of(const sunder_report *report, const sunder_row_pair *pair, size_t feature)
{
    const int64_t block = sunder_report_block(report, feature);
    const size_t first = block < 0 ? feature : (size_t)block;
    return pair->block[0] == first || pair->block[1] == first;
}

/* Has feature k of the rest the same neighbours as in the whole layer? */
static bool is_same(const sunder_report *whole, const rest *part, size_t k)
{
    size_t n, m, j = 0;
    const sunder_row_pair *p = sunder_report_row_pairs(whole, &n), *q = sunder_report_row_pairs(part->report, &m);
    for (size_t i = 0; i < n; i++) {
        if (!is_of(whole, &p[i], part->from[k])) continue;
        while (j < m && !is_of(part->report, &q[j], k)) j++;
        if (j == m || p[i].feature[0] != part->from[q[j].feature[0]] ||
            p[i].feature[1] != part->from[q[j].feature[1]] || p[i].side[0] != q[j].side[0] ||
            p[i].side[1] != q[j].side[1] || p[i].along[0] != q[j].along[0] || p[i].offset != q[j].offset)
            return false;
        j++;
    }
    while (j < m && !is_of(part->report, &q[j], k)) j++;
    return j == m;
}

/* Does the box meet feature `gone`, or one in the same numbered block? */
static bool meets_gone(const street *s, size_t gone, const double place[4])
{
    for (size_t g = 0; g < s->n; g++) {
        double box[4];
        if (g != gone && (s->feature[g].block < 0 || s->feature[g].block != s->feature[gone].block)) continue;
        sunder_shape_box(s->feature[g].shape, box);
        if (meets(box, place)) return true;
    }
    return false;
}

/* Takes away feature `gone` and all that are in one numbered block with it. Returns the number of features whose
 * neighbours are changed by that; it must meet the places that decide on them. */
static size_t look_without(const street *s, const sunder_report *whole, size_t gone)
{
    static sunder_feature chosen[MOST];
    rest part = {.n = 0};
    double reach[4];
    size_t changed = 0;
    for (size_t k = 0; k < s->n; k++) {
        const int64_t block = s->feature[k].block;
        if (k == gone || (block >= 0 && block == s->feature[gone].block)) continue;
        chosen[part.n] = s->feature[k];
        part.from[part.n++] = k;
    }
    part.report = run_separate(chosen, part.n, &s->options);
    for (size_t k = 0; k < part.n; k++) {
        if (is_same(whole, &part, k)) continue;
        changed++;
        sunder_report_row_reach(whole, part.from[k], reach);
        if (!meets_gone(s, gone, reach)) fail_msg("feature %zu decides on the neighbours of %zu", gone, part.from[k]);
        sunder_report_row_reach(part.report, k, reach);
        if (!meets_gone(s, gone, reach)) fail_msg("%zu is not known to lack feature %zu", part.from[k], gone);
    }
    sunder_report_free(part.report);
    return changed;
}

static void check_reach(void **state)
{
    (void)state;
    static street s;
    size_t changed = 0, pairs = 0, n;
    for (size_t number = 0; number < test_count(LAYERS); number++) {
        rng r = rng_start(test_seed(), 9300 + number);
        lay_out(&s, &r);
        sunder_report *whole = run_separate(s.feature, s.n, &s.options);
        sunder_report_row_pairs(whole, &n);
        pairs += n;
        for (size_t k = 0; k < s.n; k++) changed += look_without(&s, whole, k);
        sunder_report_free(whole);
        for (size_t k = 0; k < s.n; k++) sunder_shape_free((sunder_shape *)s.feature[k].shape);
    }
    print_message("%zu pairs of neighbours; %zu changes\n", pairs, changed);
    assert_true(pairs > 0 && changed > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_reach)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
