/* The interval that contains a conflict's largest gap by the report, need_gap to need_gap_most, compared with the true
 * largest gap. Layers are rows of tall boxes between two walls, whose limits allow moves along the row only. There the
 * largest gap is a sum: with it the pair in question and all unlisted pairs keep it, and no listed pair is worse than
 * at the start. */
#include "random.h"
#include "scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

/* The computation of need_gap moves the two features and their neighbours only; in a longer row more boxes would have
 * to keep the places of the result. */
enum { MOST = 2, TALL = 400 };

/* Boxes between walls; stood: the distances between neighbours at the start. */
typedef struct row {
    size_t n;
    double at[MOST + 2], wide[MOST + 2], limit[MOST + 2], stood[MOST + 1], gap;
    bool listed[MOST + 1];
} row;

/* Can all boxes be placed so that each pair keeps the distance required with that gap? Each box, from left to right, is
 * placed as far left as possible. all: listed pairs other than `pair` have to keep the gap, too. */
static bool has_solution(const row *r, size_t pair, double gap, bool all)
{
    double end = r->at[0] + r->wide[0];
    for (size_t k = 1; k < r->n; k++) {
        const bool held = r->listed[k - 1] && k - 1 != pair && !all;
        const double owed = held && r->stood[k - 1] < gap ? r->stood[k - 1] : gap,
                     least = fmax(r->at[k] - r->limit[k], end + owed);
        if (least > r->at[k] + r->limit[k]) return false;
        end = least + r->wide[k];
    }
    return true;
}

/* Returns -1 if there is none. */
static double largest_gap(const row *r, size_t pair, bool all)
{
    double low = 0, high = r->gap;
    if (!has_solution(r, pair, 0, all)) return -1;
    for (int k = 0; k < 60; k++) {
        const double middle = (low + high) / 2;
        *(has_solution(r, pair, middle, all) ? &low : &high) = middle;
    }
    return low;
}

static row random_row(rng *r)
{
    row out = {.n = 3 + (size_t)rng_int(r, 0, MOST - 1), .gap = 1 + 3 * rng_unit(r)};
    double x = 0;
    for (size_t k = 0; k < out.n; k++) {
        const bool wall = k == 0 || k + 1 == out.n;
        out.at[k] = x;
        out.wide[k] = 15 + 5 * rng_unit(r); /* so that only neighbours are near each other */
        out.limit[k] = wall ? 0 : 0.1 + out.gap * rng_unit(r);
        if (k) out.stood[k - 1] = out.at[k] - (out.at[k - 1] + out.wide[k - 1]);
        x += out.wide[k] + out.gap * (1.3 * rng_unit(r) - 0.3);
    }
    return out;
}

static void separate(const row *r, scene *s)
{
    scene_begin(s, r->gap);
    s->options.no_blocks = s->options.allow_jumps = true;
    s->options.contained = SUNDER_CONTAINMENT_SEPARATE;
    for (size_t k = 0; k < r->n; k++) {
        sunder_feature *f = scene_add_box(s, r->at[k], 0, r->wide[k], TALL);
        f->max_shift = r->limit[k];
        f->fixed = r->limit[k] == 0;
    }
    scene_separate(s);
}

static bool is_right(uint64_t i, size_t *asked)
{
    rng random = rng_start(test_seed() + 91, i);
    row r = random_row(&random);
    scene s;
    size_t n;
    bool right = true;
    separate(&r, &s);
    const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
    for (size_t k = 0; k < n; k++) r.listed[c[k].a < c[k].b ? c[k].a : c[k].b] = true;
    for (size_t k = 0; k < n; k++) {
        const size_t pair = c[k].a < c[k].b ? c[k].a : c[k].b;
        const double most = largest_gap(&r, pair, false), of_all = n == 2 ? largest_gap(&r, pair, true) : -1,
                     least = (of_all >= 0 ? of_all : most) - r.gap / 100;
        ++*asked;
        const double told = c[k].need_gap, above = c[k].need_gap_most;
        const bool well = most < 0 ? isnan(told)
                                   : told >= least - 1e-9 && told <= most * (1 + 1e-9) + 1e-12 && above >= told &&
                                         above <= told + r.gap / 100 && above >= least + r.gap / 100 - 1e-9;
        if (!well)
            print_message("case %llu, boxes %zu and %zu: gap %.17g, need_gap %.17g to %.17g, the largest is %.17g (of "
                          "all %.17g)\n",
                          (unsigned long long)i, pair, pair + 1, r.gap, told, above, most, of_all);
        right = right && well;
    }
    scene_end(&s);
    return right;
}

static void test_gap_among_neighbours_is_the_largest(void **state)
{
    (void)state;
    const size_t n = test_count(200);
    size_t asked = 0, wrong = 0;
    for (size_t i = 0; i < n; i++) wrong += !is_right(i, &asked);
    print_message("%zu rows, %zu pairs left in conflict, %zu rows with a wrong gap\n", n, asked, wrong);
    assert_int_equal(wrong, 0);
    assert_true(asked > n / 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_gap_among_neighbours_is_the_largest)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
