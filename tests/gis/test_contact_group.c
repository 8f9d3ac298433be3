/* Connected groups in a spool, by boxes and by shapes, compared with a comparison of all pairs of features.
 *
 * Layers are diamonds, whose boxes meet far more often than the diamonds do, in crowds of all densities, some of them
 * fixed, some in blocks whose members are far from each other, some much larger, some far away. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "base/disjoint_sets.h"
#include "random.h"
#include "scratch.h"
#include "shards/parts/contact_group.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST = 40000, BLOCKS = 40, LARGEST = 30 };

typedef struct diamond {
    double x, y, size; /* |X - x| + |Y - y| <= size */
    int64_t block;
    bool fixed;
} diamond;

typedef struct layer {
    diamond of[MOST];
    size_t n;
    double reach;
} layer;

static void lay_out(layer *l, rng *r)
{
    const bool numbered = rng_once_in(r, 2);
    l->n = (size_t)rng_int(r, 1, MOST);
    const double wide = sqrt((double)l->n) * (2 + 8 * rng_unit(r));
    l->reach = rng_once_in(r, 4) ? 1e-6 : 0.1 + 3 * rng_unit(r);
    for (size_t k = 0; k < l->n; k++) {
        const bool far = rng_once_in(r, 2000);
        l->of[k] = (diamond){(far ? 1e5 : 0) + wide * rng_unit(r), wide * rng_unit(r) * (rng_once_in(r, 9) ? 0.1 : 1),
                             rng_once_in(r, 500) ? LARGEST : 0.5 + 2 * rng_unit(r),
                             numbered && rng_once_in(r, 20) ? rng_int(r, 0, BLOCKS - 1) : -1, rng_once_in(r, 10)};
    }
}

/* The shortest link between two diamonds is between corners, or between a corner and a side at 45 degrees. */
static double distance(const diamond *a, const diamond *b)
{
    const double dx = fabs(a->x - b->x), dy = fabs(a->y - b->y), size = a->size + b->size;
    if (dx + dy <= size) return 0;
    const double along = (dx - dy) / 2; /* the diamond of that size around a, and the centre of b */
    return fabs(along) <= size / 2 ? (dx + dy - size) / sqrt(2) : hypot(fmax(dx, dy) - size, fmin(dx, dy));
}

static bool boxes_meet(const diamond *a, const diamond *b, double reach)
{
    const double size = a->size + b->size + reach;
    return fabs(a->x - b->x) <= size && fabs(a->y - b->y) <= size;
}

static size_t count_largest(const layer *l, bool by_shapes)
{
    static size_t parent[MOST], size[MOST];
    size_t first[BLOCKS], most = 0;
    for (size_t k = 0; k < l->n; k++) parent[k] = k, size[k] = 0;
    for (size_t b = 0; b < BLOCKS; b++) first[b] = SIZE_MAX;
    for (size_t i = 0; i < l->n; i++) {
        const diamond *a = &l->of[i];
        if (a->fixed) continue;
        if (a->block >= 0 && first[a->block] == SIZE_MAX) first[a->block] = i;
        if (a->block >= 0) gis_set_join(parent, i, first[a->block]);
        for (size_t j = 0; j < i; j++)
            if (fabs(a->x - l->of[j].x) <= 2 * LARGEST + l->reach && !l->of[j].fixed &&
                boxes_meet(a, &l->of[j], l->reach) && (!by_shapes || distance(a, &l->of[j]) < l->reach))
                gis_set_join(parent, i, j);
    }
    for (size_t k = 0; k < l->n; k++)
        if (!l->of[k].fixed && ++size[gis_set_root(parent, k)] > most) most = size[gis_set_root(parent, k)];
    return most;
}

static gis_spool *spool_of(const layer *l, unsigned shards)
{
    gis_spool_writer *writer;
    gis_spool *spool;
    gis_error error;
    assert_true(gis_spool_create(scratch_directory(), NULL, &writer, &error));
    for (size_t k = 0; k < l->n; k++) {
        const diamond *d = &l->of[k];
        const double xy[] = {d->x - d->size, d->y, d->x, d->y - d->size, d->x + d->size, d->y, d->x, d->y + d->size};
        const size_t ring_end = 4, poly_end = 1;
        sunder_shape *shape;
        assert_int_equal(sunder_shape_from_rings(xy, &ring_end, &poly_end, 1, SUNDER_VALIDITY_STRICT, &shape, NULL),
                         SUNDER_OK);
        const gis_spool_feature f = {.index = k,
                                     .fid = (int64_t)k,
                                     .demands = {.shape = shape, .weight = 1, .block = d->block, .fixed = d->fixed},
                                     .start = {NAN, NAN}};
        assert_true(gis_spool_add(writer, &f, &error));
        sunder_shape_free(shape);
    }
    assert_true(gis_spool_finish(writer, shards, NULL, NULL, &error));
    gis_spool_writer_free(writer);
    assert_true(gis_spool_open(scratch_directory(), &spool, &error));
    return spool;
}

static size_t find_largest(const layer *l, gis_spool *spool, double enough)
{
    gis_layout layout;
    gis_contact_group found;
    gis_error error;
    assert_true(gis_layout_make(spool, l->reach, true, &layout, &error));
    assert_true(gis_contact_group_find(&layout, l->reach, enough, &found, &error));
    assert_int_equal(found.vertices, 4 * found.features);
    gis_layout_clear(&layout);
    return found.features;
}

static void test_largest(void **state)
{
    (void)state;
    static layer l;
    size_t cells = 0, fewer = 0;
    for (size_t i = 0; i < test_count(6); i++) {
        rng r = rng_start(test_seed(), i);
        lay_out(&l, &r);
        gis_spool *spool = spool_of(&l, (unsigned)rng_int(&r, 1, 500));
        cells += gis_spool_cells(spool);
        const size_t by_boxes = count_largest(&l, false), by_shapes = count_largest(&l, true);
        assert_int_equal(find_largest(&l, spool, INFINITY), by_boxes);
        assert_int_equal(find_largest(&l, spool, 0), by_shapes);
        fewer += by_shapes < by_boxes;
        gis_spool_close(spool);
    }
    print_message("%zu cells; in %zu layers the groups by shapes are smaller than those by boxes\n", cells, fewer);
    assert_true(cells > 6 && fewer > 0);
}

/* Ten thousand diamonds on top of each other, and two more: too many pairs to enumerate. */
static void test_pile(void **state)
{
    (void)state;
    static layer l;
    rng r = rng_start(test_seed(), 0);
    l = (layer){.n = 10002, .reach = 1};
    for (size_t k = 0; k < l.n; k++) l.of[k] = (diamond){rng_unit(&r), rng_unit(&r), 5 + 5 * rng_unit(&r), -1, false};
    l.of[77] = (diamond){-100, 0, 5, -1, false};
    l.of[78] = (diamond){-90.5, 0, 5, -1, false};
    gis_spool *spool = spool_of(&l, 7);
    assert_int_equal(find_largest(&l, spool, INFINITY), 10000);
    assert_int_equal(find_largest(&l, spool, 0), 10000);
    gis_spool_close(spool);
}

static void test_nothing(void **state)
{
    (void)state;
    static layer l;
    l = (layer){.n = 0, .reach = 1};
    gis_spool *spool = spool_of(&l, 3);
    assert_int_equal(find_largest(&l, spool, 0), 0);
    gis_spool_close(spool);
    l = (layer){.of = {{.size = 1, .block = -1, .fixed = true}}, .n = 1, .reach = 1};
    spool = spool_of(&l, 1);
    assert_int_equal(find_largest(&l, spool, 0), 0);
    gis_spool_close(spool);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_largest), cmocka_unit_test(test_pile),
                                       cmocka_unit_test(test_nothing)};
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
