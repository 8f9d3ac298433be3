/* A layer separated in parts and joined again is what it is when separated whole, to the last bit, in however many
 * shards: moves, statuses, blocks, conflicts, pushes, sums.
 *
 * Layers are towns of slanted boxes, some of them crowded, some in rows that touch, some fixed or limited, some
 * of blocks whose members are far from each other. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "parts/join.h"
#include "random.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST = 4000 };

static char directory[] = "/tmp/test_parts.XXXXXX";

typedef struct town {
    sunder_feature feature[MOST];
    size_t n;
    sunder_layer_options how;
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

static void lay_out(town *t, rng *r)
{
    sunder_layer_options_init(&t->how);
    t->how.gap = rng_once_in(r, 4) ? 0 : 1 + rng_unit(r);
    t->how.effort = rng_once_in(r, 4) ? 0.002 : 0;
    t->how.no_blocks = rng_once_in(r, 4);
    t->how.allow_jumps = rng_once_in(r, 2);
    t->how.keep_pushes = true;
    t->how.drop_proofs = true;
    t->how.threads = (unsigned)rng_int(r, 1, 2);
    const bool limited = rng_once_in(r, 2), numbered = rng_once_in(r, 2);
    const double pitch = 15 + 4 * rng_unit(r), crowded = 0.01 + 0.02 * rng_unit(r);
    const size_t row = 40 + (size_t)rng_int(r, 0, 60);
    for (t->n = 0; t->n < MOST; t->n++) {
        const bool street = t->n / row % 7 == 3 && t->n % row < 50; /* fixed by its first */
        const bool crowd = rng_unit(r) < crowded, terrace = street || rng_once_in(r, 12);
        const double x = 4000.25 + pitch * (double)(t->n % row), y = 9000 + pitch * (double)(t->n / row);
        const double w = terrace ? pitch : crowd ? pitch - 1 + 3 * rng_unit(r) : 4 + 6 * rng_unit(r);
        t->feature[t->n] = (sunder_feature){.shape = box_at(r, x, y, w, 5 + 3 * rng_unit(r), !terrace),
                                            .weight = rng_once_in(r, 3) ? 1 + 3 * rng_unit(r) : 1,
                                            .max_shift = limited ? 4 * rng_unit(r) : INFINITY,
                                            .fixed = street ? t->n % row == 0 : rng_once_in(r, 40),
                                            .block = numbered && rng_once_in(r, 200) ? rng_int(r, 0, 9) : -1};
    }
    for (size_t k = t->n; k-- > 1;) {
        const size_t other = (size_t)rng_int(r, 0, (int64_t)k);
        const sunder_feature swap = t->feature[k];
        t->feature[k] = t->feature[other];
        t->feature[other] = swap;
    }
}

static gis_spool *spool_of(const town *t, unsigned shards)
{
    gis_spool_writer *writer;
    gis_spool *spool;
    gis_error error;
    assert_true(gis_spool_create(directory, &writer, &error));
    for (size_t k = 0; k < t->n; k++) {
        const gis_spool_feature f = {.index = k, .fid = (int64_t)k + 1, .demands = t->feature[k], .start = {NAN, NAN}};
        assert_true(gis_spool_add(writer, &f, &error));
    }
    assert_true(gis_spool_finish(writer, shards, NULL, NULL, &error));
    gis_spool_writer_free(writer);
    assert_true(gis_spool_open(directory, &spool, &error));
    return spool;
}

/* ---- Comparing --------------------------------------------------------------------------------------------------- */

static void demand_same_features(const town *t, const sunder_report *whole, const gis_joined *j)
{
    size_t row = 0, block = 0, still = 0;
    for (size_t k = 0; k < t->n; k++) {
        double move[2], none[2] = {0, 0};
        const double *got = none;
        sunder_feature_status status =
            t->feature[k].fixed || t->feature[k].max_shift == 0 ? SUNDER_FEATURE_FIXED : SUNDER_FEATURE_UNMOVED;
        int64_t of = -1;
        sunder_report_move(whole, k, &move[0], &move[1]);
        while (still < j->stills && j->still[still].index < k) still++;
        if (still < j->stills && j->still[still].index == k) status = j->still[still].status;
        if (row < j->rows && j->parts->row[j->row[row]].index == k) {
            got = j->parts->row[j->row[row]].move;
            status = j->parts->row[j->row[row++]].status;
        }
        if (block < j->blocks && j->block[block].a == k) of = (int64_t)j->block[block++].b;
        if (move[0] != got[0] || move[1] != got[1] || status != sunder_report_status(whole, k) ||
            of != sunder_report_block(whole, k))
            fail_msg("seed %llu: feature %zu: %.17g %.17g, status %d, block %lld; in parts %.17g %.17g, %d, %lld",
                     (unsigned long long)test_seed(), k, move[0], move[1], (int)sunder_report_status(whole, k),
                     (long long)sunder_report_block(whole, k), got[0], got[1], (int)status, (long long)of);
    }
    assert_int_equal(row, j->rows);
    assert_int_equal(block, j->blocks);
}

static double or_none(double length) { return isnan(length) ? -1 : length; }

static void demand_same_conflicts(const sunder_report *whole, const gis_joined *j)
{
    size_t n;
    const sunder_conflict *c = sunder_report_conflicts(whole, &n);
    assert_int_equal(n, j->conflicts);
    for (size_t k = 0; k < n; k++) {
        const sunder_conflict *d = &j->parts->conflict[j->conflict[k]];
        assert_true(c[k].a == d->a && c[k].b == d->b && c[k].kind == d->kind && c[k].reason == d->reason);
        assert_true(c[k].distance == d->distance && c[k].before == d->before && c[k].depth == d->depth);
        assert_true(or_none(c[k].need_shift) == or_none(d->need_shift));
        assert_true(or_none(c[k].need_gap) == or_none(d->need_gap) && c[k].need_gone == d->need_gone);
        assert_int_equal(c[k].n_blocked_by, d->n_blocked_by);
        for (size_t i = 0; i < d->n_blocked_by; i++) assert_int_equal(c[k].blocked_by[i], d->blocked_by[i]);
    }
    const sunder_push *p = sunder_report_pushes(whole, &n);
    assert_int_equal(n, j->pushes);
    for (size_t k = 0; k < n; k++) {
        const sunder_push *q = &j->parts->push[j->push[k]];
        assert_true(p[k].a == q->a && p[k].b == q->b && p[k].force == q->force && p[k].n[0] == q->n[0]);
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
    assert_true(s.total == t->total && s.mean == t->mean && s.max == t->max && s.max_feature == t->max_feature);
    assert_true(s.cost == t->cost && s.lower_bound == t->lower_bound && s.verified == t->verified);
}

static unsigned compare(const town *t, const sunder_report *whole, unsigned shards, double halo)
{
    gis_spool *spool = spool_of(t, shards);
    gis_part_result result = {0};
    gis_joined joined;
    gis_error error;
    gis_layout layout;
    if (!gis_layout_make(spool, &t->how, true, &layout, &error)) fail_msg("%s", error.message);
    if (halo >= 0) layout.halo = halo;
    for (unsigned k = 0; k < shards; k++)
        if (!gis_parts_shards(&layout, k, k + 1, &result, &error)) fail_msg("%s", error.message);
    if (!gis_parts_join(&layout, &result, &joined, &error)) fail_msg("%s", error.message);
    demand_same_features(t, whole, &joined);
    demand_same_conflicts(whole, &joined);
    demand_same_sums(whole, &joined);
    const unsigned more = joined.runs - shards;
    gis_joined_clear(&joined);
    gis_part_result_clear(&result);
    gis_layout_clear(&layout);
    gis_spool_close(spool);
    return more;
}

static void test_towns_in_parts(void **state)
{
    (void)state;
    static town t;
    unsigned more = 0;
    size_t moved = 0;
    for (size_t number = 0; number < test_count(4); number++) {
        rng r = rng_start(test_seed(), 8200 + number);
        lay_out(&t, &r);
        sunder_layer *layer;
        sunder_report *whole;
        sunder_error why;
        sunder_layer_summary s;
        assert_int_equal(sunder_layer_new(t.feature, t.n, &layer, &why), SUNDER_OK);
        assert_int_equal(sunder_layer_separate(layer, &t.how, &whole, &why), SUNDER_OK);
        sunder_report_summary(whole, &s);
        moved += s.moved;
        more += compare(&t, whole, 1, -1) + compare(&t, whole, 2, -1) + compare(&t, whole, 7, -1);
        more += compare(&t, whole, 7, t.how.gap); /* hardly a halo */
        sunder_report_free(whole);
        sunder_layer_free(layer);
        for (size_t k = 0; k < t.n; k++) sunder_shape_free((sunder_shape *)t.feature[k].shape);
    }
    print_message("%zu features moved; %u parts were separated once more\n", moved, more);
    assert_true(moved > 0 && more > 0);
}

static int set_up(void **state)
{
    (void)state;
    return mkdtemp(directory) ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    char command[200];
    snprintf(command, sizeof command, "rm -rf %s", directory);
    return system(command);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_towns_in_parts)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
