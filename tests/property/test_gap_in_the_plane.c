/* The interval that contains a conflict's largest gap according to the report, need_gap to need_gap_most, compared with
 * a branch and bound over the moves of one box among fixed boxes. The signed distance of two boxes (the distance, or
 * minus the depth) changes by no more than the move, so its value at the centre of a square bounds it in the whole
 * square, from both sides. */
#include "random.h"
#include "scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

enum { MOST = 6, SQUARES = 1 << 18 };

typedef struct box {
    double x, y, w, h;
} box;

/* The first box moves, by no more than the limit. */
typedef struct room {
    size_t n;
    box of[MOST];
    double limit, gap;
    bool listed[MOST]; /* its pair with the first box is left in conflict */
} room;

static double signed_distance(const box *a, const box *b, double ux, double uy)
{
    const double x = fmax(b->x - (a->x + ux + a->w), a->x + ux - (b->x + b->w)),
                 y = fmax(b->y - (a->y + uy + a->h), a->y + uy - (b->y + b->h));
    if (x <= 0 && y <= 0) return fmax(x, y);
    return hypot(fmax(x, 0), fmax(y, 0));
}

/* An upper bound of the gap that moves in a square leave (r: half its diagonal), or the gap that its centre leaves (r =
 * 0). all: listed pairs other than `pair` have to keep the gap as well; else they may not be worse than at the
 * start. */
static double gap_at(const room *g, size_t pair, bool all, double ux, double uy, double r)
{
    double least = g->gap;
    for (size_t k = 1; k < g->n; k++) {
        const double is = signed_distance(&g->of[0], &g->of[k], ux, uy) + r,
                     was = signed_distance(&g->of[0], &g->of[k], 0, 0);
        const bool held = g->listed[k] && k != pair && !all;
        if (!held || is < was) least = fmin(least, is);
    }
    return least;
}

/* Squares that may contain better moves than those found are divided, until none is better by more than `width`. */
static void largest_gap(const room *g, size_t pair, bool all, double width, double *low, double *high)
{
    static double square[SQUARES][3];
    size_t n = 1, done = 0;
    square[0][0] = square[0][1] = 0;
    square[0][2] = g->limit;
    *low = gap_at(g, pair, all, 0, 0, 0);
    *high = *low;
    for (; done < n; done++) {
        const double *s = square[done], r = s[2] * sqrt(2), far = hypot(s[0], s[1]);
        if (far - r > g->limit) continue;
        if (far <= g->limit) *low = fmax(*low, gap_at(g, pair, all, s[0], s[1], 0));
        const double bound = gap_at(g, pair, all, s[0], s[1], r);
        if (bound <= *low + width || n + 4 > SQUARES || s[2] < width / 64) {
            *high = fmax(*high, bound);
            continue;
        }
        for (int k = 0; k < 4; k++, n++) {
            square[n][2] = square[done][2] / 2;
            square[n][0] = square[done][0] + (k & 1 ? 1 : -1) * square[n][2];
            square[n][1] = square[done][1] + (k & 2 ? 1 : -1) * square[n][2];
        }
    }
    *high = fmax(*high, *low + width);
}

static room random_room(rng *r)
{
    room g = {.n = 3 + (size_t)rng_int(r, 0, MOST - 3), .gap = 1 + 3 * rng_unit(r)};
    g.of[0] = (box){0, 0, 6 + 6 * rng_unit(r), 6 + 6 * rng_unit(r)};
    g.limit = g.gap * (0.2 + rng_unit(r));
    for (size_t k = 1; k < g.n; k++) {
        const double w = 3 + 10 * rng_unit(r), h = 3 + 10 * rng_unit(r), off = g.gap * (1.6 * rng_unit(r) - 0.2),
                     t = rng_unit(r);
        const bool beside = rng_once_in(r, 2), before = rng_once_in(r, 2);
        const double along = beside ? t * (g.of[0].h + h) - h : t * (g.of[0].w + w) - w;
        const double across = before ? -off - (beside ? w : h) : off + (beside ? g.of[0].w : g.of[0].h);
        g.of[k] = beside ? (box){across, along, w, h} : (box){along, across, w, h};
    }
    return g;
}

static void separate(const room *g, scene *s)
{
    scene_begin(s, g->gap);
    s->options.no_blocks = s->options.allow_jumps = true;
    s->options.contained = SUNDER_CONTAINMENT_SEPARATE;
    for (size_t k = 0; k < g->n; k++) {
        sunder_feature *f = scene_add_box(s, g->of[k].x, g->of[k].y, g->of[k].w, g->of[k].h);
        f->max_shift = k ? 0 : g->limit;
        f->fixed = k > 0;
    }
    scene_separate(s);
}

typedef struct tally {
    size_t asked, wide, wrong;
} tally;

static void judge(room *g, const sunder_conflict *c, size_t listed, uint64_t i, tally *t)
{
    const double width = g->gap / 1000;
    double low, high, low_of_all = -1, high_of_all;
    largest_gap(g, c->b, false, width, &low, &high);
    if (listed == 2) largest_gap(g, c->b, true, width, &low_of_all, &high_of_all);
    const double least = low_of_all >= 0 ? low_of_all : low;
    t->asked++;
    const bool none = isnan(c->need_gap);
    const bool right = none ? isnan(c->need_gap_most)
                            : c->need_gap <= high + 1e-9 && c->need_gap_most >= fmin(least, g->gap) - 1e-9 &&
                                  c->need_gap_most >= c->need_gap;
    t->wrong += !right;
    t->wide += none ? low > width : c->need_gap_most - c->need_gap > g->gap / 100;
    if (!right)
        print_message(
            "case %llu, box %zu: gap %.17g, need_gap %.17g to %.17g, the largest is in %.17g to %.17g (of all "
            "%.17g)\n",
            (unsigned long long)i, c->b, g->gap, c->need_gap, c->need_gap_most, low, high, low_of_all);
}

static void test_largest_gap_is_in_the_interval_told(void **state)
{
    (void)state;
    const size_t n = test_count(150);
    tally t = {0, 0, 0};
    for (size_t i = 0; i < n; i++) {
        rng random = rng_start(test_seed() + 92, i);
        room g = random_room(&random);
        scene s;
        size_t conflicts, listed = 0;
        separate(&g, &s);
        const sunder_conflict *c = sunder_report_conflicts(s.report, &conflicts);
        for (size_t k = 0; k < conflicts; k++)
            if (c[k].a == 0) g.listed[c[k].b] = ++listed;
        for (size_t k = 0; k < conflicts; k++)
            if (c[k].a == 0) judge(&g, &c[k], listed, i, &t);
        scene_end(&s);
    }
    print_message("%zu rooms, %zu pairs left in conflict: %zu intervals are wrong, %zu wider than a hundredth\n", n,
                  t.asked, t.wrong, t.wide);
    assert_int_equal(t.wrong, 0);
    assert_true(t.asked > n / 2);
    assert_true(20 * t.wide <= t.asked);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_largest_gap_is_in_the_interval_told)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
