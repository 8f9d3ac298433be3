/* A layer that is separated in parts and joined again gives the result of the whole layer, to the last bit, for every
 * number of shards: moves, statuses, shapes, blocks, conflicts, pushes, sums, what is hidden and why.
 *
 * Layers are towns of slanted boxes, some of them crowded, some in rows that touch, some fixed or limited, some in
 * blocks whose members are far from each other. Some have barriers: roads through the whole town or of a few metres,
 * meadows, many at one place, some far away. In half of the towns gaps depend on classes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "layer/output.h"
#include "random.h"
#include "scratch.h"
#include "shards/parts/join.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST = 4000, BARRIERS = 1500, CLASSES = 4 };

typedef struct town {
    sunder_feature feature[MOST];
    size_t n;
    sunder_layer_options how;
    sunder_barrier barrier[BARRIERS];
    size_t barriers;
    gis_layer_rules rules;
    gis_rung_lengths lengths;
    sunder_hiding_cost cost[MOST];
    bool rigid[MOST];
    sunder_gaps gaps; /* classes 0: there is one gap */
    double class_gap[CLASSES * CLASSES];
    uint32_t class_of[MOST], class_of_barrier[BARRIERS];
    bool class_there[CLASSES];
} town;

static const sunder_shape *box_at(rng *r, double x, double y, double w, double h, bool slanted)
{
    const double a = slanted ? 0.7 * rng_unit(r) : 0, c = cos(a), s = sin(a);
    const double xy[] = {x, y, x + w * c, y + w * s, x + w * c - h * s, y + w * s + h * c, x - h * s, y + h * c};
    const size_t ring_end = 4, poly_end = 1;
    sunder_shape *shape;
    sunder_error error;
    assert_int_equal(sunder_shape_from_rings(xy, &ring_end, &poly_end, 1, SUNDER_VALIDITY_STRICT, &shape, &error),
                     SUNDER_OK);
    return shape;
}

static void draw_options(town *t, rng *r)
{
    sunder_layer_options_init(&t->how);
    t->how.gap = rng_once_in(r, 4) ? 0 : 1 + rng_unit(r);
    t->how.effort = rng_once_in(r, 4) ? 0.002 : 0;
    t->how.no_blocks = rng_once_in(r, 4);
    t->how.allow_jumps = rng_once_in(r, 2);
    t->how.keep_pushes = true;
    t->how.drop_proofs = true;
    t->how.threads = (unsigned)rng_int(r, 1, 2);
}

/* Puts the features in an order that is drawn. */
static void shuffle(town *t, rng *r)
{
    for (size_t k = t->n; k-- > 1;) {
        const size_t other = (size_t)rng_int(r, 0, (int64_t)k);
        const sunder_feature swap = t->feature[k];
        t->feature[k] = t->feature[other];
        t->feature[other] = swap;
    }
}

/* Streets of houses side by side, which are rows: some houses touch, some are nearer than the gap, and the others are
 * up to four gaps apart. */
static void lay_streets(town *t, rng *r, size_t n)
{
    draw_options(t, r);
    t->how.gap = 1 + rng_unit(r);
    t->how.rows = SUNDER_ROWS_FOUND;
    const bool limited = rng_once_in(r, 2);
    const size_t length = 20 + (size_t)rng_int(r, 0, 40);
    double x = 0;
    for (t->n = 0; t->n < n; t->n++) {
        const double w = 4 + 4 * rng_unit(r), y = 9000 + 14 * (double)(t->n / length) + 0.4 * rng_unit(r);
        if (t->n % length == 0) x = 4000.25 + 10 * rng_unit(r);
        t->feature[t->n] = (sunder_feature){.shape = box_at(r, x, y, w, 6 + rng_unit(r), false),
                                            .weight = rng_once_in(r, 3) ? 1 + 3 * rng_unit(r) : 1,
                                            .max_shift = limited ? 4 * rng_unit(r) : INFINITY,
                                            .fixed = rng_once_in(r, 40),
                                            .block = rng_once_in(r, 200) ? rng_int(r, 0, 9) : -1};
        x += w + (rng_once_in(r, 15) ? 0 : t->how.gap * (rng_once_in(r, 12) ? rng_unit(r) : 1.2 + 2.8 * rng_unit(r)));
    }
    shuffle(t, r);
}

static void lay_out(town *t, rng *r, size_t n)
{
    draw_options(t, r);
    const bool limited = rng_once_in(r, 2), numbered = rng_once_in(r, 2);
    const double pitch = 15 + 4 * rng_unit(r), crowded = 0.01 + 0.02 * rng_unit(r);
    const size_t row = 40 + (size_t)rng_int(r, 0, 60);
    for (t->n = 0; t->n < n; t->n++) {
        const bool street = t->n / row % 7 == 3 && t->n % row < 50; /* the first of a street is fixed */
        const bool crowd = rng_unit(r) < crowded, terrace = street || rng_once_in(r, 12);
        const double x = 4000.25 + pitch * (double)(t->n % row), y = 9000 + pitch * (double)(t->n / row);
        const double w = terrace ? pitch : crowd ? pitch - 1 + 3 * rng_unit(r) : 4 + 6 * rng_unit(r);
        t->feature[t->n] = (sunder_feature){.shape = box_at(r, x, y, w, 5 + 3 * rng_unit(r), !terrace),
                                            .weight = rng_once_in(r, 3) ? 1 + 3 * rng_unit(r) : 1,
                                            .max_shift = limited ? 4 * rng_unit(r) : INFINITY,
                                            .fixed = street ? t->n % row == 0 : rng_once_in(r, 40),
                                            .block = numbered && rng_once_in(r, 200) ? rng_int(r, 0, 9) : -1};
    }
    shuffle(t, r);
}

/* ---- Barriers ---------------------------------------------------------------------------------------------------- */

static double *line_of(rng *r, double x, double y, double dx, double dy, size_t n, double shaken)
{
    double *xy = malloc(2 * n * sizeof *xy);
    assert_non_null(xy);
    for (size_t k = 0; k < n; k++) {
        xy[2 * k] = x + dx * (double)k + shaken * rng_unit(r);
        xy[2 * k + 1] = y + dy * (double)k + shaken * rng_unit(r);
    }
    return xy;
}

static void add_line(town *t, rng *r, const double from[2], const double step[2], size_t n)
{
    if (t->barriers == BARRIERS) return;
    size_t *end = malloc(sizeof *end);
    assert_non_null(end);
    *end = n;
    t->barrier[t->barriers++] = (sunder_barrier){
        .geometry = {.xy = line_of(r, from[0], from[1], step[0], step[1], n, 1), .line_end = end, .lines = 1},
        .width = rng_once_in(r, 3) ? 0 : 2 + 3 * rng_unit(r),
        .gap = rng_once_in(r, 2) ? -1 : 2 * rng_unit(r),
        .side = rng_once_in(r, 2)};
}

static void add_meadow(town *t, rng *r, double x, double y, double size)
{
    if (t->barriers == BARRIERS) return;
    t->barrier[t->barriers++] = (sunder_barrier){.geometry = {.shape = box_at(r, x, y, size, size / 2, true)},
                                                 .gap = rng_once_in(r, 2) ? -1 : rng_unit(r),
                                                 .side = rng_once_in(r, 3)};
}

static void lay_barriers(town *t, rng *r, bool any)
{
    double all[4] = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    t->barriers = 0;
    if (!any) return;
    for (size_t k = 0; k < t->n; k++) {
        double box[4];
        sunder_shape_box(t->feature[k].shape, box);
        for (int c = 0; c < 4; c++) all[c] = c < 2 ? fmin(all[c], box[c]) : fmax(all[c], box[c]);
    }
    const double w = all[2] - all[0], h = all[3] - all[1];
    for (int k = 0; k < 6; k++) /* through all parts */
        add_line(t, r, (double[]){all[0] + w * rng_unit(r), all[1] - 20}, (double[]){w / 900, h / 60}, 64);
    for (int k = 0; k < 6; k++)
        add_line(t, r, (double[]){all[0] - 20, all[1] + h * rng_unit(r)}, (double[]){w / 60, -h / 2000}, 64);
    for (int k = 0; k < 60; k++)
        add_line(t, r, (double[]){all[0] + w * rng_unit(r), all[1] + h * rng_unit(r)},
                 (double[]){20 * rng_unit(r) - 10, 20 * rng_unit(r) - 10}, (size_t)rng_int(r, 1, 6));
    for (int k = 0; k < 30; k++)
        add_meadow(t, r, all[0] + w * rng_unit(r), all[1] + h * rng_unit(r), 3 + 9 * rng_unit(r));
    if (rng_once_in(r, 2)) /* many in one place */
        for (int k = 0; k < 300; k++)
            add_line(t, r, (double[]){all[0] + w / 2, all[1] + h / 2}, (double[]){3 * rng_unit(r), 3 * rng_unit(r)}, 2);
    add_line(t, r, (double[]){all[0] - 9 * w, all[1] - 9 * h}, (double[]){1, 1}, 9);
    /* Proofs about given-up pairs look at everything within reach, so the reach is kept small. */
    for (size_t k = 0; k < t->n; k++) t->feature[k].max_shift = fmin(t->feature[k].max_shift, 2);
    t->how.barrier_reach = INFINITY;
    t->how.effort = 0;
}

/* Draws the class of a feature: in the north they all have one, so that parts lack the others. */
static uint32_t draw_class(rng *r, const sunder_shape *shape)
{
    double box[4];
    sunder_shape_box(shape, box);
    return box[1] > 9050 ? CLASSES - 2 : (uint32_t)rng_int(r, 0, CLASSES - 3);
}

/* Draws gaps by classes: none between some two classes, and the last class has barriers alone. */
static void draw_gaps(town *t, rng *r, bool any)
{
    const double most = 1 + rng_unit(r);
    t->gaps = (sunder_gaps){0};
    if (!any) return;
    memset(t->class_there, 0, sizeof t->class_there);
    for (size_t k = 0; k < t->n; k++) t->class_there[t->class_of[k] = draw_class(r, t->feature[k].shape)] = true;
    for (size_t k = 0; k < t->barriers; k++) t->class_of_barrier[k] = (uint32_t)rng_int(r, 0, CLASSES - 1);
    for (size_t i = 0; i < CLASSES; i++)
        for (size_t j = 0; j <= i; j++)
            t->class_gap[i * CLASSES + j] = t->class_gap[j * CLASSES + i] = rng_once_in(r, 4) ? 0 : most * rng_unit(r);
    t->how.gap = 0;
    for (size_t k = 0; k < CLASSES * CLASSES; k++) t->how.gap = fmax(t->how.gap, t->class_gap[k]);
    t->gaps = (sunder_gaps){CLASSES, t->class_gap, t->class_gap, t->class_of, t->class_of_barrier, t->class_there};
}

/* Draws what it costs to hide features, some of them never, and whether they may become smaller, some of them
 * never. */
static void draw_costs(town *t, rng *r, bool hides, bool smaller)
{
    static double inset[] = {0.2, 0.6};
    t->rules = (gis_layer_rules){.hide = hides, .crossed = SUNDER_CROSSED_HIDE};
    t->lengths = (gis_rung_lengths){0};
    for (size_t k = 0; k < t->n; k++) {
        t->cost[k] = (sunder_hiding_cost){(uint32_t)rng_int(r, 0, 3), rng_int(r, 1, 9)};
        t->rigid[k] = rng_once_in(r, 8);
    }
    if (!smaller) return;
    t->rules.trim = true;
    t->rules.trim_keep = 0.3;
    t->rules.inset = "0.2,0.6";
    t->rules.symbol_size.text = "2";
    t->lengths = (gis_rung_lengths){inset, 2, 1.5, 2};
}

static void clear_barriers(town *t)
{
    for (size_t k = 0; k < t->barriers; k++) {
        const sunder_obstacle *o = &t->barrier[k].geometry;
        sunder_shape_free((sunder_shape *)o->shape);
        free((double *)o->xy);
        free((size_t *)o->line_end);
    }
    t->barriers = 0;
}

/* Numbers of barriers may have gaps: here every second number is used. */
static size_t number_of(const town *t, size_t thing)
{
    return thing < t->n || thing == SIZE_MAX ? thing : t->n + 2 * (thing - t->n);
}

static gis_spooled_barriers barriers_of(const town *t)
{
    gis_barriers_writer *writer;
    gis_spooled_barriers spool = {0};
    gis_error error;
    if (t->barriers == 0) return spool;
    assert_true(gis_barriers_create(scratch_directory(), t->how.gap, t->how.gap, &t->gaps, &writer, &error));
    for (size_t k = 0; k < t->barriers; k++) {
        const gis_spooled_barrier barrier = {2 * k, (int64_t)k, "roads", t->barrier[k],
                                             t->gaps.classes ? t->class_of_barrier[k] : 0};
        assert_true(gis_barriers_add(writer, &barrier, &error));
    }
    if (!gis_barriers_finish(writer, &error)) fail_msg("%s", error.message);
    gis_barriers_writer_free(writer);
    assert_true(gis_barriers_open(scratch_directory(), &spool, &error));
    return spool;
}

static gis_spool *spool_of(const town *t, unsigned shards)
{
    gis_spool_writer *writer;
    gis_spool *spool;
    gis_error error;
    assert_true(gis_spool_create(scratch_directory(), NULL, &writer, &error));
    for (size_t k = 0; k < t->n; k++) {
        gis_spool_feature f = {.index = k, .fid = (int64_t)k + 1, .demands = t->feature[k], .start = {NAN, NAN}};
        if (t->rules.hide || t->rules.trim) f.hiding = t->cost[k];
        f.rigid = t->rigid[k];
        f.gap_class = t->gaps.classes ? t->class_of[k] : 0;
        assert_true(gis_spool_add(writer, &f, &error));
    }
    assert_true(gis_spool_finish(writer, shards, NULL, NULL, &error));
    gis_spool_writer_free(writer);
    assert_true(gis_spool_open(scratch_directory(), &spool, &error));
    return spool;
}

/* ---- Comparison -------------------------------------------------------------------------------------------------- */

/* Makes the smaller shapes for the whole layer, if there are to be any. */
static gis_levels levels_of(const town *t, sunder_layer *layer)
{
    static const sunder_shape *shape[MOST];
    static int64_t weight[MOST];
    gis_levels levels = {0};
    gis_error error;
    const gis_rung_request request = {.rules = &t->rules,
                                      .lengths = &t->lengths,
                                      .core = t->how,
                                      .layer = layer,
                                      .n = t->n,
                                      .shape = shape,
                                      .weight = weight,
                                      .rigid = t->rigid};
    for (size_t k = 0; k < t->n; k++) {
        shape[k] = t->feature[k].shape;
        weight[k] = t->cost[k].weight;
    }
    if (!gis_rungs_make(&request, &levels, &error) ||
        !gis_rungs_set(&t->rules, t->lengths.min_size, &levels, NULL, t->n, layer, "town", &error))
        fail_msg("%s", error.message);
    return levels;
}

/* Does the feature have the same smaller shape, if it has one? */
static void demand_same_shape(const town *t, const sunder_report *whole, const gis_levels *levels, size_t k,
                              const gis_part_result *one)
{
    const size_t level = sunder_report_status(whole, k) == SUNDER_FEATURE_HIDDEN ? 0 : sunder_report_level(whole, k);
    const gis_part_row *row = one && one->rows ? one->row : NULL;
    sunder_shape *shape;
    gis_error error;
    bool equal = false;
    if (level == 0) {
        assert_true(!row || (row->rung == 0 && row->now.polygons == 0));
        return;
    }
    assert_non_null(row);
    const size_t rung = gis_levels_rung(levels, k, level);
    const sunder_shape *wanted = gis_levels_shape(levels, k, rung);
    assert_int_equal(row->rung, rung + 1);
    assert_int_equal(row->kind, levels->kind[rung]);
    assert_true(row->lost == 1 - sunder_shape_area(wanted) / sunder_shape_area(t->feature[k].shape));
    assert_true(gis_part_make_shape(one, &row->now, &shape, &error));
    assert_int_equal(sunder_shape_polygons(wanted), sunder_shape_polygons(shape));
    for (size_t p = 0; p < sunder_shape_polygons(wanted); p++) {
        size_t n, m;
        const double *a = sunder_shape_ring(wanted, p, 0, &n), *b = sunder_shape_ring(shape, p, 0, &m);
        equal = n == m && memcmp(a, b, 2 * n * sizeof *a) == 0;
        assert_true(equal);
    }
    sunder_shape_free(shape);
}

static void demand_same_features(const town *t, const sunder_report *whole, const gis_levels *levels, gis_joined *j)
{
    size_t block = 0, rows = 0;
    bool any;
    gis_error error;
    gis_sorted_results_rewind(&j->rows);
    assert_true(gis_sorted_results_next(&j->rows, &any, &error));
    for (size_t k = 0; k < t->n; k++) {
        double move[2], got[2] = {0, 0};
        sunder_feature_status status =
            t->feature[k].fixed || t->feature[k].max_shift == 0 ? SUNDER_FEATURE_FIXED : SUNDER_FEATURE_UNMOVED;
        int64_t of = -1;
        sunder_report_move(whole, k, &move[0], &move[1]);
        if (any && j->rows.head.first == k) {
            const gis_part_result *one = &j->rows.one;
            status = one->rows ? one->row->status : gis_joined_status(j, one->still);
            if (one->rows) memcpy(got, one->row->move, sizeof got);
            demand_same_shape(t, whole, levels, k, one);
            rows++;
            assert_true(gis_sorted_results_next(&j->rows, &any, &error));
        } else {
            demand_same_shape(t, whole, levels, k, NULL);
        }
        if (block < j->blocks && j->block[block].a == k) of = (int64_t)j->block[block++].b;
        if (move[0] != got[0] || move[1] != got[1] || status != sunder_report_status(whole, k) ||
            of != sunder_report_block(whole, k))
            fail_msg("seed %llu: feature %zu: %.17g %.17g, status %d, block %lld; in parts %.17g %.17g, %d, %lld",
                     (unsigned long long)test_seed(), k, move[0], move[1], (int)sunder_report_status(whole, k),
                     (long long)sunder_report_block(whole, k), got[0], got[1], (int)status, (long long)of);
    }
    assert_true(!any && rows == j->rows.n);
    assert_int_equal(block, j->blocks);
}

static double or_none(double length) { return isnan(length) ? -1 : length; }

static void demand_same_conflicts(const town *t, const sunder_report *whole, gis_joined *j)
{
    size_t n;
    bool any;
    gis_error error;
    const sunder_conflict *c = sunder_report_conflicts(whole, &n);
    assert_int_equal(n, j->conflicts.n);
    for (size_t k = 0; k < n; k++) {
        assert_true(gis_sorted_results_next(&j->conflicts, &any, &error) && any);
        const sunder_conflict *d = &j->conflicts.one.conflict->is;
        assert_true(c[k].a == d->a && number_of(t, c[k].b) == d->b && c[k].kind == d->kind && c[k].reason == d->reason);
        assert_true(c[k].distance == d->distance && c[k].before == d->before && c[k].depth == d->depth);
        assert_true(or_none(c[k].need_shift) == or_none(d->need_shift));
        assert_true(or_none(c[k].need_gap) == or_none(d->need_gap) && number_of(t, c[k].need_gone) == d->need_gone);
        assert_int_equal(c[k].n_blocked_by, d->n_blocked_by);
        for (size_t i = 0; i < d->n_blocked_by; i++)
            assert_int_equal(number_of(t, c[k].blocked_by[i]), j->conflicts.one.blocker[i]);
    }
    const sunder_push *p = sunder_report_pushes(whole, &n);
    assert_int_equal(n, j->pushes.n);
    for (size_t k = 0; k < n; k++) {
        assert_true(gis_sorted_results_next(&j->pushes, &any, &error) && any);
        const sunder_push *q = &j->pushes.one.push->is;
        assert_true(p[k].a == q->a && number_of(t, p[k].b) == q->b && p[k].force == q->force && p[k].n[0] == q->n[0]);
    }
}

static void demand_same_sums(const sunder_report *whole, const gis_joined *j)
{
    sunder_layer_summary s;
    const sunder_layer_summary *t = &j->summary;
    sunder_report_summary(whole, &s);
    assert_memory_equal(&s.before, &t->before, sizeof s.before);
    assert_memory_equal(&s.after, &t->after, sizeof s.after);
    assert_int_equal(s.blocks, t->blocks);
    assert_int_equal(s.clusters, t->clusters);
    assert_int_equal(s.clusters_optimal, t->clusters_optimal);
    assert_true(s.moved == t->moved && s.blocked == t->blocked && s.rounded == t->rounded && s.thin == t->thin);
    assert_true(s.blocked_moved == t->blocked_moved && s.inside_overlaps == t->inside_overlaps);
    assert_true(s.total == t->total && s.mean == t->mean && s.max == t->max && s.max_feature == t->max_feature);
    assert_true(s.cost == t->cost && s.lower_bound == t->lower_bound && s.verified == t->verified);
}

/* The same features are hidden, for the same reasons, and the same is proved of it. */
static size_t demand_same_hiding(const town *t, const sunder_report *whole, gis_joined *j)
{
    gis_hiding all;
    bool any;
    gis_error error;
    sunder_report_hiding(whole, &all.sum);
    all.class = sunder_report_hiding_classes(whole, &all.classes);
    assert_memory_equal(&all.sum, &j->hiding.sum, sizeof all.sum);
    assert_int_equal(all.classes, j->hiding.classes);
    for (size_t k = 0; k < all.classes; k++) {
        assert_int_equal(all.class[k].hierarchy, j->hiding.class[k].hierarchy);
        assert_int_equal(all.class[k].hidden, j->hiding.class[k].hidden);
        assert_int_equal(all.class[k].weight, j->hiding.class[k].weight);
        assert_int_equal(all.class[k].least, j->hiding.class[k].least);
    }
    const sunder_clause **reason = gis_hidden_reasons(whole, t->n);
    assert_non_null(reason);
    for (size_t k = 0; k < t->n; k++) {
        if (sunder_report_status(whole, k) != SUNDER_FEATURE_HIDDEN) continue;
        assert_true(gis_sorted_results_next(&j->hidden, &any, &error) && any);
        const gis_part_hidden *h = j->hidden.one.hidden;
        assert_true(h->index == k && h->cost.hierarchy == t->cost[k].hierarchy && h->cost.weight == t->cost[k].weight);
        assert_true(h->proved == reason[k]->proved && h->things == reason[k]->things);
        for (size_t i = 0; i < h->things; i++)
            assert_int_equal(number_of(t, reason[k]->thing[i]), j->hidden.one.blocker[i]);
    }
    assert_int_equal(all.sum.hidden, j->hidden.n);
    free(reason);
    return all.sum.hidden;
}

/* The same rows of houses, with the same figures. */
static void demand_same_rows(const town *t, const sunder_report *whole, const gis_joined *j)
{
    size_t n;
    sunder_layer_summary s;
    const sunder_layer_summary *u = &j->summary;
    const sunder_row *row = sunder_report_rows(whole, &n);
    sunder_report_summary(whole, &s);
    assert_int_equal(n, j->row_list.rows);
    for (size_t k = 0; k < n; k++) {
        const sunder_row *other = &j->row_list.row[k];
        assert_int_equal(row[k].features, other->features);
        assert_true(row[k].bodies == other->bodies && row[k].ring == other->ring);
        assert_true(row[k].kink_before == other->kink_before && row[k].kink_after == other->kink_after);
        for (size_t i = 0; i < row[k].features; i++) {
            double anchor[2], move[2];
            const size_t f = row[k].feature[i];
            const gis_row_place *place = gis_joined_row_place(j, f);
            assert_true(f == other->feature[i] && place);
            sunder_shape_anchor(t->feature[f].shape, anchor);
            sunder_report_move(whole, f, &move[0], &move[1]);
            assert_true(place->at[0] == anchor[0] + move[0] && place->at[1] == anchor[1] + move[1]);
        }
    }
    assert_true(s.rows == u->rows && s.row_features == u->row_features && s.row_pairs == u->row_pairs);
    assert_true(s.kink_mean == u->kink_mean && s.kink_p95 == u->kink_p95 && s.kink_share == u->kink_share);
    assert_true(s.spacing_mean == u->spacing_mean && s.spacing_p95 == u->spacing_p95);
    assert_true(s.turn_mean == u->turn_mean && s.turn_p95 == u->turn_p95);
    assert_true(s.cost_moves == u->cost_moves && s.cost_rows == u->cost_rows);
}

/* Writes each part into a file of its own, or all of them into one file. */
static void separate_parts(gis_layout *layout, unsigned shards, bool apart)
{
    gis_part_file file = {0};
    gis_part_result result = {0};
    gis_error error;
    for (unsigned k = 0; k < shards; k++) {
        const gis_part_stamp stamp = {.version = "1", .shard = k + 1, .shards = apart ? shards : 1};
        const bool opens = apart || k == 0, ends = apart || k + 1 == shards;
        gis_part_result_empty(&result);
        if (!gis_parts_separate(layout, k, k + 1, &result, &error) ||
            (opens && !gis_part_file_create(&file, scratch_directory(), &stamp, &error)) ||
            !gis_part_file_add(&file, &result, &error) ||
            (ends && !gis_part_file_place(&file, scratch_directory(), &error)))
            fail_msg("%s", error.message);
    }
    gis_part_result_clear(&result);
}

static unsigned compare(const town *t, const sunder_report *whole, const gis_levels *levels, unsigned shards,
                        double halo, size_t *hidden)
{
    gis_spool *spool = spool_of(t, shards);
    gis_part_file file[7];
    gis_joined joined;
    gis_error error;
    gis_layout layout;
    const bool apart = halo < 0;
    const unsigned files = apart ? shards : 1;
    if (!gis_layout_make(spool, t->how.gap, true, &layout, &error)) fail_msg("%s", error.message);
    layout.how = t->how;
    layout.gaps = t->gaps;
    if (halo >= 0) layout.halo = halo;
    layout.barriers = barriers_of(t);
    layout.features = t->n;
    layout.rules = &t->rules;
    layout.lengths = &t->lengths;
    separate_parts(&layout, shards, apart);
    for (unsigned k = 0; k < files; k++) {
        const gis_part_stamp stamp = {.version = "1", .shard = k + 1, .shards = files};
        if (!gis_part_file_open(&file[k], scratch_directory(), &stamp, &error)) fail_msg("%s", error.message);
    }
    if (!gis_parts_join(&layout, file, files, scratch_directory(), &joined, &error)) fail_msg("%s", error.message);
    demand_same_features(t, whole, levels, &joined);
    demand_same_conflicts(t, whole, &joined);
    demand_same_sums(whole, &joined);
    demand_same_rows(t, whole, &joined);
    *hidden += demand_same_hiding(t, whole, &joined);
    const unsigned more = joined.runs - shards;
    gis_joined_clear(&joined);
    for (unsigned k = 0; k < files; k++) gis_part_file_close(&file[k]);
    gis_barriers_close(&layout.barriers);
    gis_layout_clear(&layout);
    gis_spool_close(spool);
    return more;
}

static void separate_towns(size_t n, bool barriers, bool rows)
{
    static town t;
    unsigned more = 0;
    size_t moved = 0, neighbours = 0, hidden = 0, smaller = 0;
    for (size_t number = 0; number < test_count(4); number++) {
        rng r = rng_start(test_seed(), (rows ? 8400 : barriers ? 8300 : 8200) + number);
        if (rows)
            lay_streets(&t, &r, n);
        else
            lay_out(&t, &r, n);
        lay_barriers(&t, &r, barriers);
        draw_gaps(&t, &r, number % 2 == 1);
        draw_costs(&t, &r, barriers && number % 2 == 0, barriers && number % 4 == 2);
        sunder_layer *layer;
        sunder_report *whole;
        sunder_error why;
        sunder_layer_summary s;
        assert_int_equal(sunder_layer_new(t.feature, t.n, &layer, &why), SUNDER_OK);
        assert_int_equal(sunder_layer_set_barriers(layer, t.barrier, t.barriers, &why), SUNDER_OK);
        if (t.gaps.classes) assert_int_equal(sunder_layer_set_gaps(layer, &t.gaps, &why), SUNDER_OK);
        gis_levels levels = levels_of(&t, layer);
        if (t.rules.hide) assert_int_equal(sunder_layer_set_hiding(layer, t.cost, &why), SUNDER_OK);
        assert_int_equal(sunder_layer_separate(layer, &t.how, &whole, &why), SUNDER_OK);
        sunder_report_summary(whole, &s);
        moved += s.moved;
        neighbours += s.row_pairs;
        if (!t.rules.hide) more += compare(&t, whole, &levels, 1, -1, &hidden);
        if (!t.rules.trim) more += compare(&t, whole, &levels, 2, -1, &hidden);
        more += compare(&t, whole, &levels, 7, -1, &hidden);
        more += compare(&t, whole, &levels, 7, t.how.gap, &hidden); /* a small margin around each part */
        sunder_hiding_summary hiding;
        sunder_report_hiding(whole, &hiding);
        smaller += hiding.smaller;
        sunder_report_free(whole);
        sunder_layer_free(layer);
        gis_levels_clear(&levels);
        clear_barriers(&t);
        for (size_t k = 0; k < t.n; k++) sunder_shape_free((sunder_shape *)t.feature[k].shape);
    }
    print_message("%zu features moved; %u parts were separated once more; %zu neighbours in rows; %zu features hidden, "
                  "%zu smaller\n",
                  moved, more, neighbours, hidden, smaller);
    assert_true(moved > 0 && more > 0 && (neighbours > 0) == rows && (hidden > 0) == barriers);
    assert_true((smaller > 0) == barriers);
}

static void test_towns_in_parts(void **state)
{
    (void)state;
    separate_towns(MOST, false, false);
}

static void test_barriers_in_parts(void **state)
{
    (void)state;
    separate_towns(MOST / 8, true, false);
}

static void test_rows_in_parts(void **state)
{
    (void)state;
    separate_towns(MOST / 8, false, true);
    separate_towns(MOST / 16, true, true);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_towns_in_parts), cmocka_unit_test(test_barriers_in_parts),
                                       cmocka_unit_test(test_rows_in_parts)};
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
