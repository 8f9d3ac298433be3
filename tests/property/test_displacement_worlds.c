/* Worlds (sunder_parts.h: groups of features whose result does not depend on others) are independent of the rest of the
 * layer. Let a part of the layer contain everything that the computation of a world looked at. Then the part gives the
 * same result for that world as the whole layer, to the last bit, unless another world of the part changed something
 * there. The results of worlds, of unchanged blocks and of moves add up to the result of the layer.
 *
 * The same holds for neighbours in rows: a part that contains the place that decides on the neighbours of a feature
 * gives it the same ones as the whole layer.
 *
 * Features of every second layer may be hidden or have smaller shapes; then the layer is laid out several times, and
 * components of clauses belong to worlds.
 *
 * Layers are fields of slanted boxes, most of them separate, some with fixed ones, limits, blocks, and barriers: roads
 * across the whole layer, and ponds. */
#include "polyset.h"
#include "random.h"
#include "run_layer.h"
#include "sunder_hiding.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 160, FIELDS = 200, BARRIERS = 4, BENDS = 5, LEVELS = 2 };

typedef struct field {
    sunder_feature feature[MOST];
    size_t n;
    sunder_barrier barrier[BARRIERS]; /* every part contains all of them */
    double road[BARRIERS][2 * BENDS];
    size_t bends, barriers;
    bool hides, shrinks;
    sunder_hiding_cost cost[MOST];
    sunder_level level[MOST][LEVELS];
    size_t levels[MOST];
    sunder_layer_options options;
    double width;
} field;

static sunder_shape *slanted_box(rng *r, double x, double y, double steepest)
{
    const double a = rng_once_in(r, 2) ? 0 : steepest * rng_unit(r), w = 3 + 5 * rng_unit(r), h = 3 + 3 * rng_unit(r);
    sunder_shape *shape = polyset_turned_rectangle(x, y, w, h, a);
    assert_non_null(shape);
    return shape;
}

static void draw_options(field *f, rng *r)
{
    sunder_layer_options_init(&f->options);
    f->options.touch_tolerance = rng_once_in(r, 2) ? 0 : -1;
    f->options.no_blocks = rng_once_in(r, 3);
    f->options.allow_jumps = rng_once_in(r, 3);
    f->options.contained = (sunder_containment)rng_int(r, 0, 2);
    f->options.gap = rng_once_in(r, 4) ? 0 : 0.5 + 2 * rng_unit(r);
    f->options.effort = rng_once_in(r, 2) ? 0 : 0.02;
    f->options.keep_pushes = f->options.keep_worlds = true;
    f->options.rows = rng_once_in(r, 2) ? SUNDER_ROWS_FOUND : SUNDER_ROWS_NONE;
    if (f->options.rows) f->options.gap = 1 + 2 * rng_unit(r);
    f->options.keep_trees = rng_once_in(r, 2) && !f->options.rows;
    f->options.threads = (unsigned)rng_int(r, 1, 2);
}

/* Boxes on a grid with slightly more room than they need, displaced at random; their order in the list is random. */
static void lay_out(field *f, rng *r)
{
    const bool limited = rng_once_in(r, 2);
    const double pitch = 9 + 6 * rng_unit(r);
    const size_t row = (size_t)rng_int(r, 3, 12), n = (size_t)rng_int(r, 20, MOST);
    f->width = pitch * (double)row;
    for (f->n = 0; f->n < n; f->n++) {
        const double x = 1000.25 + pitch * (double)(f->n % row) + 4 * rng_unit(r),
                     y = 2000 + pitch * (double)(f->n / row) + 4 * rng_unit(r);
        f->feature[f->n] = (sunder_feature){.shape = slanted_box(r, x, y, f->options.rows ? 0.2 : 0.8),
                                            .weight = rng_once_in(r, 3) ? 1 + 3 * rng_unit(r) : 1,
                                            .max_shift = limited ? 4 * rng_unit(r) : INFINITY,
                                            .fixed = rng_once_in(r, 12),
                                            .block = rng_once_in(r, 20) ? rng_int(r, 0, 9) : -1};
    }
    for (size_t k = n; k-- > 1;) {
        const size_t other = (size_t)rng_int(r, 0, (int64_t)k);
        const sunder_feature swap = f->feature[k];
        f->feature[k] = f->feature[other];
        f->feature[other] = swap;
    }
}

/* Adds a road from one side to the other, with a width; or a pond. */
static void add_barrier(field *f, rng *r)
{
    const size_t k = f->barriers++;
    sunder_barrier *b = &f->barrier[k];
    *b = (sunder_barrier){.width = rng_once_in(r, 2) ? 0 : 3 * rng_unit(r),
                          .gap = rng_once_in(r, 2) ? -1 : rng_unit(r),
                          .side = rng_once_in(r, 2)};
    f->bends = BENDS;
    if (rng_once_in(r, 3)) {
        b->geometry.shape = slanted_box(r, 1000 + f->width * rng_unit(r), 2000 + f->width * rng_unit(r), 0.8);
        return;
    }
    for (size_t m = 0; m < BENDS; m++) {
        f->road[k][2 * m] = 990 + (f->width + 20) * (double)m / (BENDS - 1);
        f->road[k][2 * m + 1] = 2000 + f->width * rng_unit(r);
    }
    b->geometry = (sunder_obstacle){.xy = f->road[k], .line_end = &f->bends, .lines = 1};
}

static void add_barriers(field *f, rng *r)
{
    const size_t n = rng_once_in(r, 2) ? (size_t)rng_int(r, 1, BARRIERS) : 0;
    f->barriers = 0;
    while (f->barriers < n) add_barrier(f, r);
}

/* Draws what it costs to hide features, some of them never, and squares in the middle of some of them. */
static void draw_hiding(field *f, rng *r)
{
    f->hides = rng_once_in(r, 2);
    f->shrinks = f->hides ? rng_once_in(r, 2) : rng_once_in(r, 6);
    for (size_t k = 0; k < f->n; k++) {
        f->cost[k] = (sunder_hiding_cost){(uint32_t)rng_int(r, 0, 3), rng_int(r, 1, 5)};
        f->levels[k] = 0;
        if (!f->shrinks || rng_once_in(r, 3)) continue;
        double box[4];
        int64_t cost = 0;
        sunder_shape_box(f->feature[k].shape, box);
        for (double size = 2; f->levels[k] < LEVELS; size /= 2) {
            sunder_shape *square =
                polyset_turned_rectangle((box[0] + box[2] - size) / 2, (box[1] + box[3] - size) / 2, size, size, 0);
            f->level[k][f->levels[k]++] = (sunder_level){square, cost += rng_int(r, 0, 100)};
        }
    }
}

/* Separates n features of the field with these numbers, or all. */
static sunder_report *separate_beside(const field *f, const size_t *number, size_t n)
{
    static sunder_feature feature[MOST];
    static sunder_hiding_cost cost[MOST];
    static sunder_level level[MOST * LEVELS];
    size_t end[MOST], levels = 0;
    for (size_t k = 0; k < n; k++) {
        const size_t i = number ? number[k] : k;
        feature[k] = f->feature[i];
        cost[k] = f->cost[i];
        for (size_t m = 0; m < f->levels[i]; m++) level[levels++] = f->level[i][m];
        end[k] = levels;
    }
    sunder_layer *layer = NULL;
    sunder_report *report = NULL;
    sunder_error err;
    if (sunder_layer_new(feature, n, &layer, &err) || sunder_layer_set_barriers(layer, f->barrier, f->barriers, &err) ||
        (f->hides && sunder_layer_set_hiding(layer, cost, &err)) ||
        (f->shrinks && sunder_layer_set_levels(layer, level, end, &err)) ||
        sunder_layer_separate(layer, &f->options, &report, &err))
        fail_msg("%s", err.message);
    sunder_layer_free(layer);
    return report;
}

static void clear(field *f)
{
    for (size_t k = 0; k < f->barriers; k++) sunder_shape_free((sunder_shape *)f->barrier[k].geometry.shape);
    for (size_t k = 0; k < f->n; k++) {
        sunder_shape_free((sunder_shape *)f->feature[k].shape);
        for (size_t m = 0; m < f->levels[k]; m++) sunder_shape_free((sunder_shape *)f->level[k][m].shape);
    }
}

static bool meets(const double a[4], const double b[4])
{
    return a[0] <= b[2] && b[0] <= a[2] && a[1] <= b[3] && b[1] <= a[3];
}

/* ---- The report about a world ------------------------------------------------------------------------------------ */

static void demand_same_counts(const sunder_conflict_counts *a, const sunder_conflict_counts *b)
{
    assert_memory_equal(a, b, sizeof *a);
}

static double or_none(double length) { return isnan(length) ? -1 : length; }

/* Compares the conflicts of the world's features one by one; from: the index in the whole layer of each feature of the
 * part. */
static void demand_same_conflicts(const sunder_report *whole, const sunder_report *part, size_t world, size_t of_part,
                                  const size_t *from)
{
    size_t n, m, j = 0;
    const sunder_conflict *c = sunder_report_conflicts(whole, &n), *d = sunder_report_conflicts(part, &m);
    for (size_t k = 0; k < n; k++) {
        if (sunder_report_world_of_pair(whole, c[k].a, c[k].b) != world) continue;
        while (j < m && sunder_report_world_of_pair(part, d[j].a, d[j].b) != of_part) j++;
        assert_true(j < m);
        assert_int_equal(c[k].a, from[d[j].a]);
        assert_int_equal(c[k].b, from[d[j].b]);
        assert_int_equal(c[k].kind, d[j].kind);
        assert_int_equal(c[k].reason, d[j].reason);
        assert_true(or_none(c[k].distance) == or_none(d[j].distance));
        assert_true(or_none(c[k].depth) == or_none(d[j].depth));
        assert_true(or_none(c[k].before) == or_none(d[j].before));
        assert_true(or_none(c[k].need_shift) == or_none(d[j].need_shift));
        assert_true(or_none(c[k].need_gap) == or_none(d[j].need_gap));
        assert_int_equal(c[k].n_blocked_by, d[j].n_blocked_by);
        for (size_t i = 0; i < c[k].n_blocked_by; i++) assert_int_equal(c[k].blocked_by[i], from[d[j].blocked_by[i]]);
        j++;
    }
    while (j < m && sunder_report_world_of_pair(part, d[j].a, d[j].b) != of_part) j++;
    assert_int_equal(j, m);
}

/* Compares the bounds of the parts of a world, in any order. */
static void demand_same_bounds(const sunder_world_bound *one, const sunder_world_bound *other, size_t n)
{
    sunder_total a[2] = {{.beyond = 0}}, b[2] = {{.beyond = 0}};
    for (size_t k = 0; k < n; k++) {
        sunder_total_add(&a[0], one[k].proved);
        sunder_total_add(&a[1], one[k].by_pairs);
        sunder_total_add(&b[0], other[k].proved);
        sunder_total_add(&b[1], other[k].by_pairs);
    }
    for (int k = 0; k < 2; k++) assert_true(sunder_total_below(&a[k]) == sunder_total_below(&b[k]));
}

/* Compares the components of clauses one by one, with their classes, and returns their number. */
static size_t demand_same_components(const sunder_report *whole, const sunder_report *part, size_t world,
                                     size_t of_part, const size_t *from)
{
    size_t n, m, classes, found = 0, j = 0;
    const sunder_hiding_component *c = sunder_report_hiding_components(whole, &n),
                                  *d = sunder_report_hiding_components(part, &m);
    const sunder_hiding_class *p = sunder_report_component_classes(whole, &classes),
                              *q = sunder_report_component_classes(part, &classes);
    for (size_t k = 0; k < n; k++) {
        if (sunder_report_world(whole, c[k].feature) != world) continue;
        while (j < m && sunder_report_world(part, d[j].feature) != of_part) j++;
        assert_true(j < m);
        sunder_hiding_component other = d[j++];
        other.feature = from[other.feature];
        const size_t first = other.first_class;
        other.first_class = c[k].first_class;
        assert_int_equal(c[k].feature, other.feature);
        assert_int_equal(c[k].clauses, other.clauses);
        assert_int_equal(c[k].proved, other.proved);
        assert_int_equal(c[k].forced, other.forced);
        assert_int_equal(c[k].rounds, other.rounds);
        assert_int_equal(c[k].smaller, other.smaller);
        assert_int_equal(c[k].smaller_cost, other.smaller_cost);
        assert_int_equal(c[k].smaller_least, other.smaller_least);
        assert_int_equal(c[k].best, other.best);
        assert_int_equal(c[k].classes, other.classes);
        for (size_t i = 0; i < other.classes; i++) {
            assert_int_equal(p[c[k].first_class + i].hierarchy, q[first + i].hierarchy);
            assert_int_equal(p[c[k].first_class + i].hidden, q[first + i].hidden);
            assert_int_equal(p[c[k].first_class + i].weight, q[first + i].weight);
            assert_int_equal(p[c[k].first_class + i].least, q[first + i].least);
        }
        found++;
    }
    while (j < m && sunder_report_world(part, d[j].feature) != of_part) j++;
    assert_int_equal(j, m);
    return found;
}

/* Returns the number of its components of clauses. */
static size_t demand_same_world(const sunder_report *whole, const sunder_report *part, size_t world, const size_t *from,
                                size_t parts)
{
    size_t n, m, bounds;
    const sunder_world *all = sunder_report_worlds(whole, &n), *w = &all[world];
    size_t first = 0, of_part;
    while (first < parts && from[first] != w->first) first++;
    assert_true(first < parts);
    of_part = sunder_report_world(part, first);
    assert_true(of_part != SIZE_MAX);
    const sunder_world *v = &sunder_report_worlds(part, &m)[of_part];
    demand_same_counts(&w->before, &v->before);
    demand_same_counts(&w->after, &v->after);
    assert_int_equal(w->clusters, v->clusters);
    assert_int_equal(w->clusters_optimal, v->clusters_optimal);
    assert_int_equal(w->bounds, v->bounds);
    demand_same_bounds(sunder_report_world_bounds(whole, &bounds) + w->bound,
                       sunder_report_world_bounds(part, &bounds) + v->bound, w->bounds);
    for (size_t k = 0; k < parts; k++) {
        double t[2], u[2];
        assert_int_equal(sunder_report_world(part, k) == of_part, sunder_report_world(whole, from[k]) == world);
        if (sunder_report_world(part, k) != of_part) continue;
        sunder_report_move(whole, from[k], &t[0], &t[1]);
        sunder_report_move(part, k, &u[0], &u[1]);
        assert_true(t[0] == u[0] && t[1] == u[1]);
        assert_int_equal(sunder_report_status(whole, from[k]), sunder_report_status(part, k));
        assert_int_equal(sunder_report_rounded(whole, from[k]), sunder_report_rounded(part, k));
        assert_int_equal(sunder_report_level(whole, from[k]), sunder_report_level(part, k));
    }
    demand_same_conflicts(whole, part, world, of_part, from);
    return demand_same_components(whole, part, world, of_part, from);
}

/* Does the part contain all features that meet the box? */
static bool is_known(const field *f, const bool *there, const double place[4])
{
    for (size_t k = 0; k < f->n; k++) {
        double box[4];
        sunder_shape_box(f->feature[k].shape, box);
        if (!there[k] && meets(box, place)) return false;
    }
    return true;
}

/* Does the part contain all features that meet the area at which the part's world looked? */
static bool is_complete(const field *f, const bool *there, const sunder_report *part, size_t of_part)
{
    size_t n, footprints;
    const sunder_world *w = &sunder_report_worlds(part, &n)[of_part];
    const sunder_footprint *p = sunder_report_footprints(part, &footprints);
    for (size_t i = 0; i < w->footprints; i++)
        if (!is_known(f, there, p[w->footprint + i].seen)) return false;
    return true;
}

/* Did features that are not in the part, or of which it has only some, come into the area at which the part's world
 * looked? Then the world of the whole layer has more features. */
static bool is_joined(const sunder_report *whole, const sunder_report *part, size_t of_part, const size_t *from,
                      size_t parts)
{
    size_t n, in_part = 0, in_whole = 0;
    sunder_report_worlds(part, &n);
    size_t world = SIZE_MAX;
    for (size_t k = 0; k < parts; k++) {
        if (sunder_report_world(part, k) != of_part) continue;
        in_part++;
        world = sunder_report_world(whole, from[k]);
    }
    sunder_layer_summary s;
    sunder_report_summary(whole, &s);
    for (size_t k = 0; k < s.features; k++) in_whole += sunder_report_world(whole, k) == world;
    return world == SIZE_MAX || in_whole > in_part;
}

static bool has_block(const sunder_row_pair *pair, size_t block)
{
    return pair->block[0] == block || pair->block[1] == block;
}

static size_t block_of(const sunder_report *report, size_t feature)
{
    const int64_t block = sunder_report_block(report, feature);
    return block < 0 ? feature : (size_t)block;
}

/* Returns how many pairs of neighbours in rows the feature's block has; all of them are of the other report, too. */
static size_t demand_same_neighbours(const sunder_report *whole, const sunder_report *part, size_t k,
                                     const size_t *from)
{
    size_t n, m, j = 0, found = 0;
    const sunder_row_pair *p = sunder_report_row_pairs(whole, &n), *q = sunder_report_row_pairs(part, &m);
    const size_t block = block_of(whole, from[k]), of_part = block_of(part, k);
    assert_int_equal(block, from[of_part]);
    for (size_t i = 0; i < n; i++) {
        if (!has_block(&p[i], block)) continue;
        while (j < m && !has_block(&q[j], of_part)) j++;
        assert_true(j < m);
        for (int c = 0; c < 2; c++) {
            assert_int_equal(p[i].feature[c], from[q[j].feature[c]]);
            assert_int_equal(p[i].block[c], from[q[j].block[c]]);
            assert_int_equal(p[i].side[c], q[j].side[c]);
            assert_true(p[i].along[c] == q[j].along[c]);
        }
        assert_true(p[i].offset == q[j].offset && p[i].weight == q[j].weight);
        j++;
        found++;
    }
    while (j < m && !has_block(&q[j], of_part)) j++;
    assert_int_equal(j, m);
    return found;
}

/* Compares the neighbours in rows of the features for which the part knows all that decides on them. */
static size_t look_at_rows(const field *f, const sunder_report *whole, const sunder_report *part, const bool *there,
                           const size_t *from, size_t n)
{
    size_t found = 0;
    for (size_t k = 0; k < n && f->options.rows; k++) {
        double reach[4];
        sunder_report_row_reach(part, k, reach);
        if (is_known(f, there, reach)) found += demand_same_neighbours(whole, part, k, from);
    }
    return found;
}

/* Compares what a part of the field reports about the worlds that are complete in it. Returns their number. */
static size_t look_at_part(const field *f, const sunder_report *whole, const bool *there, size_t *neighbours,
                           size_t *components)
{
    size_t from[MOST + BARRIERS], n = 0, worlds, same = 0;
    for (size_t k = 0; k < f->n; k++) {
        if (!there[k]) continue;
        from[n++] = k;
    }
    if (n == f->n) return 0; /* the whole layer, so there is nothing to compare */
    for (size_t k = 0; k < f->barriers; k++) from[n + k] = f->n + k;
    sunder_report *part = separate_beside(f, from, n);
    const sunder_world *w = sunder_report_worlds(part, &worlds);
    for (size_t k = 0; k < worlds; k++) {
        if (!is_complete(f, there, part, k) || is_joined(whole, part, k, from, n)) continue;
        *components += demand_same_world(whole, part, sunder_report_world(whole, from[w[k].first]), from, n);
        same++;
    }
    *neighbours += look_at_rows(f, whole, part, there, from, n);
    sunder_report_free(part);
    return same;
}

/* A feature with a block number brings all features with that number. */
static void add_blocks(const field *f, bool *there)
{
    for (size_t k = 0; k < f->n; k++)
        for (size_t m = 0; m < f->n && !there[k] && f->feature[k].block >= 0; m++)
            there[k] = there[m] && f->feature[m].block == f->feature[k].block;
}

/* Tests the part that meets everything that a world looked at, and the part that meets a random box. */
static size_t look_at_parts(const field *f, rng *r, const sunder_report *whole, size_t *neighbours, size_t *components)
{
    size_t worlds, footprints, same = 0;
    const sunder_world *w = sunder_report_worlds(whole, &worlds);
    const sunder_footprint *p = sunder_report_footprints(whole, &footprints);
    for (size_t k = 0; k < worlds + 3; k++) {
        const double x = 1000 + f->width * rng_unit(r), y = 2000 + f->width * rng_unit(r),
                     drawn[4] = {x - 40, y - 40, x + 40, y + 40};
        bool there[MOST] = {false};
        for (size_t i = 0; i < f->n; i++) {
            double box[4];
            sunder_shape_box(f->feature[i].shape, box);
            if (k >= worlds) there[i] = meets(box, drawn);
            for (size_t m = 0; k < worlds && m < w[k].footprints && !there[i]; m++)
                there[i] = meets(box, p[w[k].footprint + m].seen);
        }
        add_blocks(f, there);
        same += look_at_part(f, whole, there, neighbours, components);
    }
    return same;
}

/* ---- Sums over worlds -------------------------------------------------------------------------------------------- */

/* The rows of a report are those that its pairs of neighbours form. */
static void demand_same_rows(const sunder_report *report, const sunder_layer_options *options)
{
    size_t n, pairs;
    sunder_layer_summary s, t;
    sunder_row_list list = {0};
    const sunder_row *row = sunder_report_rows(report, &n);
    const sunder_row_pair *pair = sunder_report_row_pairs(report, &pairs);
    sunder_report_summary(report, &s);
    t = s;
    t.cost = s.cost_moves;
    assert_int_equal(sunder_rows_make(pair, pairs, options, &list, &t, NULL), SUNDER_OK);
    assert_int_equal(list.rows, n);
    for (size_t k = 0; k < n; k++) {
        assert_int_equal(list.row[k].features, row[k].features);
        for (size_t i = 0; i < row[k].features; i++) assert_int_equal(list.row[k].feature[i], row[k].feature[i]);
    }
    assert_memory_equal(&s, &t, sizeof s);
    sunder_row_list_free(&list);
}

static void demand_sums(const field *f, const sunder_report *report)
{
    sunder_layer_summary s;
    size_t worlds, bounds, inside = 0, clusters = 0, optimal = 0;
    sunder_total proved = {0}, by_pairs = {0}, cost = {0};
    sunder_conflict_counts before = {0}, after = {0};
    sunder_report_summary(report, &s);
    const sunder_world *w = sunder_report_worlds(report, &worlds);
    const sunder_world_bound *bound = sunder_report_world_bounds(report, &bounds);
    for (size_t k = 0; k < bounds; k++) {
        sunder_total_add(&proved, bound[k].proved);
        sunder_total_add(&by_pairs, bound[k].by_pairs);
    }
    for (size_t k = 0; k < worlds; k++) {
        clusters += w[k].clusters;
        optimal += w[k].clusters_optimal;
        before.overlap += w[k].before.overlap;
        before.too_close += w[k].before.too_close;
        before.barrier += w[k].before.barrier;
        before.inside_blocks += w[k].before.inside_blocks;
        after.overlap += w[k].after.overlap;
        after.too_close += w[k].after.too_close;
        after.barrier += w[k].after.barrier;
        after.contained += w[k].after.contained;
        after.inside_blocks += w[k].after.inside_blocks;
        assert_int_equal(sunder_report_world(report, w[k].first), k);
    }
    for (size_t k = 0; k < f->n; k++) {
        double t[2];
        inside += sunder_report_inside(report, k);
        sunder_report_move(report, k, &t[0], &t[1]);
        sunder_total_add(&cost, f->feature[k].weight * (t[0] * t[0] + t[1] * t[1]));
        if (t[0] != 0 || t[1] != 0) assert_true(sunder_report_world(report, k) != SIZE_MAX);
    }
    assert_int_equal(before.inside_blocks + inside, s.before.inside_blocks);
    assert_int_equal(after.inside_blocks + inside, s.after.inside_blocks);
    assert_int_equal(before.overlap, s.before.overlap);
    assert_int_equal(before.too_close, s.before.too_close);
    assert_int_equal(before.barrier, s.before.barrier);
    assert_int_equal(after.barrier, s.after.barrier);
    assert_int_equal(after.overlap, s.after.overlap);
    assert_int_equal(after.too_close, s.after.too_close);
    assert_int_equal(after.contained, s.after.contained);
    assert_int_equal(clusters, s.clusters);
    assert_int_equal(optimal, s.clusters_optimal);
    assert_true(sunder_total_below(&proved) == s.lower_bound);
    assert_true(sunder_total_below(&by_pairs) == s.pair_bound);
    assert_true(sunder_total_nearest(&cost) == s.cost_moves);
    demand_same_rows(report, &f->options);
}

static void test_worlds(void **state)
{
    (void)state;
    static field f;
    size_t seen = 0, asked = 0, neighbours = 0, components = 0;
    for (size_t number = 0; number < test_count(FIELDS); number++) {
        rng r = rng_start(test_seed(), 7100 + number);
        size_t worlds;
        draw_options(&f, &r);
        lay_out(&f, &r);
        add_barriers(&f, &r);
        draw_hiding(&f, &r);
        sunder_report *whole = separate_beside(&f, NULL, f.n);
        demand_sums(&f, whole);
        sunder_report_worlds(whole, &worlds);
        asked += look_at_parts(&f, &r, whole, &neighbours, &components);
        seen += worlds;
        sunder_report_free(whole);
        clear(&f);
    }
    print_message(
        "%zu worlds, found %zu times in parts of their layers; %zu neighbours in rows, %zu components of clauses\n",
        seen, asked, neighbours, components);
    assert_true(asked > 0 && neighbours > 0 && components > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_worlds)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
