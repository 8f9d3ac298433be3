/* What becomes of a town is a matter of the town: alone, or in a layer with others out of reach, in whatever order
 * these come, its features make the same moves to the last bit, and the same is said of its conflicts and proved of its
 * pairs and groups.
 *
 * Towns are crowds of slanted boxes that overlap and lie in each other, some without a solution for limits and fixed
 * ones. Each has its coordinates wherever it stands in the list; its own features keep their order. */
#include "polyset.h"
#include "random.h"
#include "run_layer.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { TOWNS = 4, HOUSES = 16, MOST = TOWNS * HOUSES };

typedef struct town {
    sunder_feature feature[HOUSES];
    size_t n;
} town;

typedef struct country {
    town town[TOWNS];
    size_t towns;
    sunder_layer_options options;
} country;

/* An order of all features, or of those of a town. */
typedef struct order {
    size_t town[MOST], house[MOST];
    size_t n;
} order;

static void add_box(town *t, rng *r, double x, double y, double limit)
{
    polyset box = {0};
    const double a = rng_once_in(r, 2) ? 0 : 0.8 * rng_unit(r), size = rng_once_in(r, 6) ? 4 : 1,
                 w = size * (3 + 5 * rng_unit(r)), h = size * (3 + 3 * rng_unit(r));
    const double e[2] = {cos(a), sin(a)};
    polyset_polygon(&box,
                    (double[]){x, y, x + w * e[0], y + w * e[1], x + w * e[0] - h * e[1], y + w * e[1] + h * e[0],
                               x - h * e[1], y + h * e[0]},
                    4);
    t->feature[t->n++] = (sunder_feature){.shape = polyset_shape(&box),
                                          .weight = rng_once_in(r, 3) ? 1 + 3 * rng_unit(r) : 1,
                                          .max_shift = limit,
                                          .fixed = rng_once_in(r, 12),
                                          .block = -1};
    assert_non_null(t->feature[t->n - 1].shape);
    polyset_free(&box);
}

/* Towns in a row, so far from each other. */
static void found(country *c, rng *r, double far)
{
    memset(c, 0, sizeof *c);
    sunder_layer_options_init(&c->options);
    c->options.no_blocks = rng_once_in(r, 2);
    c->options.touch_tolerance = 0;
    c->options.allow_jumps = rng_once_in(r, 2);
    c->options.contained = rng_once_in(r, 2) ? SUNDER_CONTAINMENT_IGNORE : SUNDER_CONTAINMENT_SEPARATE;
    c->options.gap = rng_once_in(r, 3) ? 0 : 0.5 + 2 * rng_unit(r);
    c->options.effort = rng_once_in(r, 3) ? 0 : 0.02;
    c->options.keep_pushes = c->options.keep_trees = true;
    const bool limited = !rng_once_in(r, 3);
    c->towns = (size_t)rng_int(r, 2, TOWNS);
    for (size_t k = 0; k < c->towns; k++) {
        /* What no one oversteps in one town is little in another. */
        const double limit = limited ? (rng_once_in(r, 2) ? 60 : 6) * rng_unit(r) : INFINITY;
        const size_t n = (size_t)rng_int(r, 1, HOUSES), row = (size_t)rng_int(r, 1, 5);
        const double x = 1000.25 + far * (double)k, y = 2000 + far * rng_unit(r), pitch = 4 + 3 * rng_unit(r);
        while (c->town[k].n < n)
            add_box(&c->town[k], r, x + pitch * (double)(c->town[k].n % row) + 2 * rng_unit(r),
                    y + pitch * (double)(c->town[k].n / row) + 2 * rng_unit(r), limit);
    }
}

static void abandon(country *c)
{
    for (size_t k = 0; k < c->towns; k++)
        for (size_t h = 0; h < c->town[k].n; h++) sunder_shape_free((sunder_shape *)c->town[k].feature[h].shape);
}

static void add_to_order(order *o, size_t which, size_t house)
{
    o->town[o->n] = which;
    o->house[o->n++] = house;
}

/* One town after the other, first to last or back; or a house of whichever comes up. */
static void draw_order(const country *c, rng *r, order *o)
{
    size_t at[TOWNS] = {0}, left = 0;
    o->n = 0;
    for (size_t k = 0; k < c->towns; k++) left += c->town[k].n;
    if (!rng_once_in(r, 3)) {
        const bool back = rng_once_in(r, 2);
        for (size_t k = 0; k < c->towns; k++)
            for (size_t h = 0; h < c->town[back ? c->towns - 1 - k : k].n; h++)
                add_to_order(o, back ? c->towns - 1 - k : k, h);
        return;
    }
    while (o->n < left) {
        const size_t k = (size_t)rng_int(r, 0, (int64_t)c->towns - 1);
        if (at[k] < c->town[k].n) add_to_order(o, k, at[k]++);
    }
}

static sunder_report *run(const country *c, const order *o)
{
    static sunder_feature feature[MOST];
    for (size_t k = 0; k < o->n; k++) feature[k] = c->town[o->town[k]].feature[o->house[k]];
    return run_separate(feature, o->n, &c->options);
}

/* ---- What is said of one town ------------------------------------------------------------------------------------ */

/* A line of numbers for each fact, features by their places in the town; in the report's order. */
typedef struct facts {
    double number[40 * HOUSES * HOUSES];
    size_t n;
} facts;

static void note(facts *f, double number)
{
    assert_true(f->n < sizeof f->number / sizeof *f->number);
    f->number[f->n++] = isnan(number) ? -INFINITY : number;
}

static double house_at(const order *o, size_t k) { return k < o->n ? (double)o->house[k] : -1; }

static void note_conflict(facts *f, const order *o, const sunder_conflict *c)
{
    note(f, house_at(o, c->a));
    note(f, house_at(o, c->b));
    note(f, c->kind);
    note(f, c->reason);
    note(f, c->inside_block);
    note(f, c->distance);
    note(f, c->before);
    note(f, c->depth);
    note(f, c->required);
    note(f, c->need_shift);
    note(f, c->need_gap);
    note(f, house_at(o, c->need_gone));
    for (size_t k = 0; k < c->n_blocked_by; k++) note(f, house_at(o, c->blocked_by[k]));
}

/* The town that a tree is about: no body that moves is of another. */
static size_t town_of(const order *o, const sunder_bound_tree *tree)
{
    for (size_t k = 0; k < tree->bodies; k++)
        if (tree->body[k].weight < INFINITY) return o->town[tree->body[k].thing];
    return TOWNS;
}

static void note_tree(facts *f, const order *o, const sunder_bound_tree *tree)
{
    note(f, tree->bound);
    note(f, (double)tree->nodes);
    note(f, (double)tree->cuts);
    for (size_t k = 0; k < tree->bodies; k++) {
        note(f, house_at(o, tree->body[k].thing));
        note(f, tree->body[k].weight);
        note(f, tree->body[k].shift[0]);
        note(f, tree->body[k].shift[1]);
    }
}

static void gather(const sunder_report *report, const order *o, size_t which, facts *f)
{
    size_t n;
    f->n = 0;
    for (size_t k = 0; k < o->n; k++) {
        double t[2];
        if (o->town[k] != which) continue;
        sunder_report_move(report, k, &t[0], &t[1]);
        note(f, t[0]);
        note(f, t[1]);
        note(f, sunder_report_status(report, k));
    }
    const sunder_conflict *conflict = sunder_report_conflicts(report, &n);
    for (size_t k = 0; k < n; k++)
        if (o->town[conflict[k].a] == which) note_conflict(f, o, &conflict[k]);
    const sunder_bound_pair *pair = sunder_report_bound_pairs(report, &n);
    for (size_t k = 0; k < n; k++) {
        if (o->town[pair[k].a] != which) continue;
        note(f, house_at(o, pair[k].a));
        note(f, house_at(o, pair[k].b));
        note(f, pair[k].least);
        note(f, pair[k].multiplier);
    }
    const sunder_bound_tree *tree = sunder_report_bound_trees(report, &n);
    for (size_t k = 0; k < n; k++)
        if (town_of(o, &tree[k]) == which) note_tree(f, o, &tree[k]);
    const sunder_push *push = sunder_report_pushes(report, &n);
    for (size_t k = 0; k < n; k++) {
        if (o->town[push[k].a] != which) continue;
        note(f, house_at(o, push[k].a));
        note(f, house_at(o, push[k].b));
        note(f, push[k].force);
    }
}

static void test_towns(void **state)
{
    (void)state;
    static const double far[] = {3000, 100000, 4e6};
    static country c;
    static order all, alone;
    static facts together, by_itself;
    const size_t countries = test_count(12);
    size_t moved = 0, conflicts = 0;
    for (size_t i = 0; i < countries; i++) {
        rng r = rng_start(test_seed(), i);
        found(&c, &r, far[i % 3]);
        draw_order(&c, &r, &all);
        sunder_report *report = run(&c, &all);
        sunder_layer_summary s;
        sunder_report_summary(report, &s);
        moved += s.moved;
        conflicts += s.after.overlap + s.after.too_close;
        for (size_t k = 0; k < c.towns; k++) {
            alone.n = 0;
            for (size_t h = 0; h < c.town[k].n; h++) add_to_order(&alone, k, h);
            sunder_report *own = run(&c, &alone);
            gather(report, &all, k, &together);
            gather(own, &alone, k, &by_itself);
            for (size_t f = 0; f < together.n && f < by_itself.n; f++)
                if (memcmp(&together.number[f], &by_itself.number[f], sizeof *together.number) != 0)
                    fail_msg("seed %llu, country %zu, town %zu of %zu: number %zu is %.17g, and %.17g alone",
                             (unsigned long long)test_seed(), i, k, c.towns, f, together.number[f],
                             by_itself.number[f]);
            if (together.n != by_itself.n)
                fail_msg("seed %llu, country %zu, town %zu: more is said of it with others about, or less",
                         (unsigned long long)test_seed(), i, k);
            sunder_report_free(own);
        }
        sunder_report_free(report);
        abandon(&c);
    }
    print_message("%zu countries: %zu features moved, %zu conflicts left\n", countries, moved, conflicts);
    assert_true(moved > countries && conflicts > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_towns)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
