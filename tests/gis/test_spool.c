/* Spools: records are read back as they were written, to the last bit. The order along the curve does not depend on the
 * size of the batches that are sorted. Cells have the boxes of their features and are assigned in order. Files that
 * were changed, cut off or written by another version are refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "disk/external_sort.h"
#include "random.h"
#include "scratch.h"
#include "shards/spool/spool.h"
#include "shards/spool/spool_index.h"
#include "shards/spool/spool_record.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- Random features --------------------------------------------------------------------------------------------- */

enum { MOST = 3000 };

typedef struct board {
    const sunder_shape *given[MOST]; /* what some features were before they became larger: the shape before theirs */
    sunder_shape *shape[MOST];
    gis_spool_feature feature[MOST];
    char id[MOST][16];
    size_t n, seen;
} board;

static void add_ring(gis_polygons *to, const double *at, double size, bool clockwise, rng *random)
{
    static const double corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (int k = 0; k < 4; k++) {
        const double *c = corner[clockwise ? 3 - k : k], *d = corner[clockwise ? (6 - k) % 4 : (k + 1) % 4];
        const double x = at[0] + size * c[0], y = at[1] + size * c[1];
        const int repeated = rng_once_in(random, 4) ? 2 : 1;
        for (int r = 0; r < repeated; r++) assert_true(gis_polygons_vertex(to, x, y, NULL));
        if (rng_once_in(random, 3)) /* adds a straight vertex; the half is exact */
            assert_true(gis_polygons_vertex(to, (x + at[0] + size * d[0]) / 2, (y + at[1] + size * d[1]) / 2, NULL));
    }
}

/* Draws shapes of several squares with holes; some cross themselves. */
static sunder_shape *draw_shape(rng *random)
{
    gis_polygons set = {0};
    sunder_shape *shape = NULL;
    sunder_error why;
    const double size = (double)(8 * rng_int(random, 1, 20));
    const double at[2] = {(double)rng_int(random, -100000, 100000), (double)rng_int(random, -70000, 70000)};
    for (int64_t members = rng_int(random, 1, 3), m = 0; m < members; m++) {
        const double here[2] = {at[0] + 2 * size * (double)m, at[1]},
                     hole[2] = {here[0] + size / 4, here[1] + size / 4};
        if (rng_once_in(random, 10)) {
            const double tie[8] = {here[0],     here[1], here[0] + 3, here[1] + 7,
                                   here[0] + 3, here[1], here[0],     here[1] + 5};
            for (int k = 0; k < 4; k++) assert_true(gis_polygons_vertex(&set, tie[2 * k], tie[2 * k + 1], NULL));
            assert_true(gis_polygons_end_ring(&set, NULL));
        } else {
            add_ring(&set, here, size, rng_once_in(random, 2), random);
            assert_true(gis_polygons_end_ring(&set, NULL));
            if (rng_once_in(random, 3)) {
                add_ring(&set, hole, size / 2, rng_once_in(random, 2), random);
                assert_true(gis_polygons_end_ring(&set, NULL));
            }
        }
        assert_true(gis_polygons_end_polygon(&set, NULL));
    }
    if (gis_polygons_shape(&set, SUNDER_VALIDITY_STRICT, &shape, &why) != SUNDER_OK)
        assert_int_equal(gis_polygons_shape(&set, SUNDER_VALIDITY_EVEN_ODD, &shape, &why), SUNDER_OK);
    gis_polygons_clear(&set);
    return shape;
}

static board *draw_board(size_t n)
{
    board *b = calloc(1, sizeof *b);
    b->n = n;
    for (size_t i = 0; i < n; i++) {
        rng random = rng_start(test_seed(), i);
        b->shape[i] = draw_shape(&random);
        snprintf(b->id[i], sizeof b->id[i], "%.*s%zu", (int)(i % 7), "building", i);
        b->feature[i] = (gis_spool_feature){
            .index = i,
            .fid = rng_int(&random, -1, INT32_MAX),
            .demands = {.shape = b->shape[i],
                        .weight = rng_unit(&random) + 0.1,
                        .max_shift = rng_once_in(&random, 3) ? INFINITY : rng_unit(&random),
                        .block = rng_int(&random, -1, 5),
                        .fixed = rng_once_in(&random, 5)},
            .start = {NAN, rng_unit(&random)},
            .area = rng_unit(&random),
            .id = rng_once_in(&random, 4) ? NULL : b->id[i],
            .rigid = rng_once_in(&random, 3),
        };
        if (i && rng_once_in(&random, 3)) b->given[i] = b->shape[i - 1];
        if (b->given[i]) b->feature[i].given = gis_spool_rings_of(b->given[i]);
    }
    return b;
}

static void free_board(board *b)
{
    for (size_t i = 0; i < b->n; i++) sunder_shape_free(b->shape[i]);
    free(b);
}

/* The declared extent of the features; some lie outside. */
static const double frame[4] = {-90000, -70000, 100000, 65000};

static bool put_board(const board *b, const double *around, unsigned parts, gis_spool_settle *settle, gis_error *error)
{
    gis_spool_writer *writer;
    assert_true(gis_spool_create(scratch_directory(), around, &writer, error));
    for (size_t i = 0; i < b->n; i++) assert_true(gis_spool_add(writer, &b->feature[i], error));
    const bool done = gis_spool_finish(writer, parts, settle, (void *)b, error);
    gis_spool_writer_free(writer);
    return done;
}

static void write_board(const board *b, const double *around, unsigned parts, gis_spool_settle *settle)
{
    gis_error error = {0};
    assert_true(put_board(b, around, parts, settle, &error));
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

static void same_shape(const sunder_shape *a, const sunder_shape *b)
{
    const double *xy[2];
    const size_t *ring_end[2], *poly_end[2];
    double box[2][4];
    const size_t polygons = sunder_shape_given(a, &xy[0], &ring_end[0], &poly_end[0]);
    assert_int_equal(polygons, sunder_shape_given(b, &xy[1], &ring_end[1], &poly_end[1]));
    assert_memory_equal(poly_end[0], poly_end[1], polygons * sizeof *poly_end[0]);
    const size_t rings = poly_end[0][polygons - 1];
    assert_memory_equal(ring_end[0], ring_end[1], rings * sizeof *ring_end[0]);
    assert_memory_equal(xy[0], xy[1], 2 * ring_end[0][rings - 1] * sizeof *xy[0]);
    assert_int_equal(sunder_shape_repaired(a), sunder_shape_repaired(b));
    assert_int_equal(sunder_shape_vertices(a), sunder_shape_vertices(b));
    sunder_shape_box(a, box[0]);
    sunder_shape_box(b, box[1]);
    assert_memory_equal(box[0], box[1], sizeof box[0]);
}

typedef struct reading {
    const board *board;
    const gis_spool_cell *cell;
    double box[4];
    size_t features, vertices;
    uint64_t last, place[MOST];
    bool found[MOST];
} reading;

/* Compares the feature's shape before it became larger with the one that was put, and joins its box to `box`. */
static void join_given(const sunder_shape *put, const gis_spool_feature *feature, double box[4])
{
    sunder_shape *given;
    gis_error error;
    double own[4];
    assert_true((put == NULL) == (feature->given.polygons == 0));
    if (!put) return;
    assert_true(gis_spool_rings_shape(&feature->given, &given, &error));
    same_shape(put, given);
    sunder_shape_box(given, own);
    for (int c = 0; c < 4; c++) box[c] = c < 2 ? fmin(box[c], own[c]) : fmax(box[c], own[c]);
    sunder_shape_free(given);
}

static bool see(void *user, const gis_spool_feature *feature, gis_error *error)
{
    reading *r = user;
    const gis_spool_feature *put = &r->board->feature[feature->index];
    const double *xy;
    const size_t *ring_end, *poly_end;
    double box[4];
    (void)error;
    assert_false(r->found[feature->index]);
    r->found[feature->index] = true;
    r->place[feature->index] = feature->place;
    same_shape(put->demands.shape, feature->demands.shape);
    assert_int_equal(put->fid, feature->fid);
    assert_true(put->demands.max_shift == feature->demands.max_shift);
    assert_int_equal(put->demands.fixed, feature->demands.fixed);
    assert_int_equal(put->rigid, feature->rigid);
    assert_false(feature->demands.ignored);
    assert_memory_equal(put->start, feature->start, sizeof put->start);
    assert_true(put->area == feature->area);
    assert_true((put->id == NULL) == (feature->id == NULL) && (!put->id || strcmp(put->id, feature->id) == 0));
    const size_t polygons = sunder_shape_given(feature->demands.shape, &xy, &ring_end, &poly_end);
    r->features++;
    r->vertices += ring_end[poly_end[polygons - 1] - 1];
    sunder_shape_box(feature->demands.shape, box);
    join_given(r->board->given[feature->index], feature, box);
    for (int k = 0; k < 2; k++) {
        r->box[k] = fmin(fmin(r->box[k], box[k]), feature->start[k]); /* NAN, if there is none, is ignored */
        r->box[k + 2] = fmax(fmax(r->box[k + 2], box[k + 2]), feature->start[k]);
    }
    sunder_shape_free((sunder_shape *)feature->demands.shape);
    return true;
}

/* Reads all records, and checks the data of the cells. */
static void read_board(const board *b, unsigned parts)
{
    gis_spool *spool;
    gis_error error = {0};
    reading *r = calloc(1, sizeof *r);
    unsigned last = 0;
    r->board = b;
    assert_true(gis_spool_open(scratch_directory(), &spool, &error));
    assert_int_equal(gis_spool_parts(spool), parts);
    assert_int_equal(gis_spool_features(spool), b->n);
    for (size_t c = 0; c < gis_spool_cells(spool); c++) {
        const gis_spool_cell *cell = gis_spool_cell_at(spool, c);
        r->features = r->vertices = 0;
        r->box[0] = r->box[1] = INFINITY;
        r->box[2] = r->box[3] = -INFINITY;
        assert_true(gis_spool_read(spool, c, see, r, &error));
        assert_int_equal(r->features, cell->features);
        assert_int_equal(r->vertices, cell->vertices);
        assert_memory_equal(r->box, cell->box, sizeof r->box);
        assert_true(cell->features <= 1000 && cell->part >= last && cell->part < parts);
        last = cell->part;
    }
    for (size_t i = 0; i < b->n; i++) assert_true(r->found[i]);
    /* Each record is found again by its place in the file. */
    for (size_t i = 0; i < b->n; i++) {
        const uint64_t place = r->place[i];
        r->found[i] = false;
        assert_true(gis_spool_read_one(spool, place, see, r, &error));
        assert_true(r->found[i] && r->place[i] == place);
    }
    gis_spool_close(spool);
    free(r);
}

static void test_what_was_put_in(void **state)
{
    const size_t sizes[] = {0, 1, 999, 2900};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        board *b = draw_board(sizes[k]);
        for (unsigned parts = 1; parts < 9; parts += 3) {
            write_board(b, NULL, parts, NULL);
            read_board(b, parts);
            write_board(b, frame, parts, NULL);
            read_board(b, parts);
        }
        free_board(b);
    }
    static const char *const left[] = {"features.runs", "features.again", "features.part", "cells.part"};
    for (size_t k = 0; k < sizeof left / sizeof *left; k++) {
        const char *path = scratch_path(left[k]);
        assert_int_not_equal(access(path, F_OK), 0);
    }
}

/* ---- Settling features when the spool is finished -------------------------------------------------------------- */

static bool settle(void *user, gis_spool_feature *feature, gis_error *error)
{
    board *b = user;
    (void)error;
    b->seen++;
    assert_null(feature->demands.shape);
    assert_true(feature->id == NULL || strcmp(feature->id, b->id[feature->index]) == 0);
    feature->demands.weight = 2 * feature->demands.weight / feature->area;
    feature->demands.block = feature->demands.block < 0 ? -1 : 100 + feature->demands.block;
    return true;
}

static bool see_settled(void *user, const gis_spool_feature *feature, gis_error *error)
{
    const board *b = user;
    const gis_spool_feature *put = &b->feature[feature->index];
    (void)error;
    assert_true(feature->demands.weight == 2 * put->demands.weight / put->area);
    assert_int_equal(feature->demands.block, put->demands.block < 0 ? -1 : 100 + put->demands.block);
    sunder_shape_free((sunder_shape *)feature->demands.shape);
    return true;
}

static void test_settled(void **state)
{
    const double *const around[] = {NULL, frame};
    board *b = draw_board(1500);
    gis_error error = {0};
    for (int k = 0; k < 2; k++) {
        gis_spool *spool;
        b->seen = 0;
        write_board(b, around[k], 2, settle);
        assert_int_equal(b->seen, b->n);
        assert_true(gis_spool_open(scratch_directory(), &spool, &error));
        for (size_t c = 0; c < gis_spool_cells(spool); c++)
            assert_true(gis_spool_read(spool, c, see_settled, b, &error));
        gis_spool_close(spool);
    }
    free_board(b);
}

static bool refuse_some(void *user, gis_spool_feature *feature, gis_error *error)
{
    (void)user;
    return feature->index % 7 != 5 || gis_fail(error, "feature %zu is refused", feature->index);
}

/* If a feature is refused when the spool is finished, the former spool stays; for both orders on the disk. */
static void test_refused(void **state)
{
    const double *const around[] = {NULL, frame};
    board *b = draw_board(1500);
    for (int k = 0; k < 2; k++) {
        gis_error error = {0};
        write_board(b, frame, 1, NULL);
        assert_false(put_board(b, around[k], 1, refuse_some, &error));
        assert_string_equal(error.message, "feature 5 is refused");
        read_board(b, 1);
    }
    free_board(b);
}

/* ---- Order ------------------------------------------------------------------------------------------------------- */

typedef struct order {
    uint64_t along[MOST], index[MOST];
    size_t n;
} order;

static bool note(void *user, const unsigned char *record, gis_error *error)
{
    order *o = user;
    gis_spool_head head;
    (void)error;
    memcpy(&head, record, sizeof head);
    o->along[o->n] = head.along;
    o->index[o->n++] = head.index;
    return true;
}

/* The order is the same for every amount of memory, even if it does not hold a single record. */
static void test_order(void **state)
{
    static const size_t runs[] = {1, 700, 4096, 100000, GIS_SORT_BYTES};
    static const double all[] = {-100000, -70000, 100000, 70000};
    static order o[5];
    board *b = draw_board(2000);
    gis_error error = {0};
    gis_spool_room record = {0};
    for (size_t k = 0; k < sizeof runs / sizeof *runs; k++) {
        gis_sorter *sorter;
        double box[4];
        assert_true(gis_sorter_new(scratch_directory(), "features.runs", runs[k], &sorter, &error));
        for (size_t i = 0; i < b->n; i++) {
            assert_true(gis_spool_record_make(&record, &b->feature[i], &error));
            gis_spool_record_box(record.at, box);
            gis_spool_record_head(record.at)->along = gis_spool_along(all, box);
            assert_true(gis_sorter_add(sorter, record.at, &error));
        }
        o[k].n = 0;
        assert_true(gis_sorter_take(sorter, note, &o[k], &error));
        gis_sorter_free(sorter);
        assert_int_equal(o[k].n, b->n);
        for (size_t i = 1; i < b->n; i++) assert_true(o[k].along[i - 1] <= o[k].along[i]);
        assert_memory_equal(o[0].index, o[k].index, sizeof o[k].index);
    }
    free(record.at);
    free_board(b);
}

static void find_box(const board *b, double all[4])
{
    double box[4];
    all[0] = all[1] = INFINITY;
    all[2] = all[3] = -INFINITY;
    for (size_t i = 0; i < b->n; i++) {
        sunder_shape_box(b->shape[i], box);
        for (int k = 0; k < 2; k++) {
            all[k] = fmin(all[k], box[k]);
            all[k + 2] = fmax(all[k + 2], box[k + 2]);
        }
    }
}

/* The bytes of a file; the caller frees them. */
static char *bytes_of(const char *name, size_t *n)
{
    const char *path = scratch_path(name);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    *n = (size_t)ftell(file);
    rewind(file);
    char *bytes = malloc(*n + 1);
    assert_int_equal(fread(bytes, 1, *n, file), *n);
    fclose(file);
    return bytes;
}

/* The declared extent of a layer may be out of date, or the whole world. Then the extent of the features is used. */
static void test_poor_frames(void **state)
{
    static const double far[] = {0, 0, 1, 1}, half[] = {-100000, -70000, 0, 70000}, world[] = {-1e9, -1e9, 1e9, 1e9},
                        huge[] = {-1e308, -1e308, 1e308, 1e308};
    static const double *const poor[] = {NULL, far, half, world, huge};
    board *b = draw_board(MOST);
    double all[4];
    size_t n;
    find_box(b, all);
    write_board(b, all, 4, NULL);
    char *wanted = bytes_of("cells", &n);
    for (size_t k = 0; k < sizeof poor / sizeof *poor; k++) {
        size_t own;
        write_board(b, poor[k], 4, NULL);
        read_board(b, 4);
        char *bytes = bytes_of("cells", &own);
        assert_int_equal(own, n);
        assert_memory_equal(bytes, wanted, n);
        free(bytes);
    }
    free(wanted);
    free_board(b);
}

/* ---- Damaged files ----------------------------------------------------------------------------------------------- */

static long size_of(const char *path)
{
    FILE *file = fopen(path, "r");
    fseek(file, 0, SEEK_END);
    const long size = ftell(file);
    fclose(file);
    return size;
}

static void flip(const char *path, long at)
{
    FILE *file = fopen(path, "r+");
    fseek(file, at, SEEK_SET);
    const int byte = fgetc(file);
    fseek(file, at, SEEK_SET);
    fputc(byte ^ 16, file);
    fclose(file);
}

static bool pass(void *user, const gis_spool_feature *feature, gis_error *error)
{
    (void)user;
    (void)error;
    sunder_shape_free((sunder_shape *)feature->demands.shape);
    return true;
}

/* Reads the whole spool; false: sets the error. */
static bool read_all(gis_error *error)
{
    gis_spool *spool;
    if (!gis_spool_open(scratch_directory(), &spool, error)) return false;
    bool done = true;
    for (size_t c = 0; done && c < gis_spool_cells(spool); c++) done = gis_spool_read(spool, c, pass, NULL, error);
    gis_spool_close(spool);
    return done;
}

static void test_harm(void **state)
{
    static const char *const names[] = {"features", "cells"};
    board *b = draw_board(300);
    gis_error error = {0};
    for (int f = 0; f < 2; f++) {
        const char *path = scratch_path(names[f]);
        write_board(b, NULL, 3, NULL);
        assert_true(read_all(&error));
        const long size = size_of(path), step = size > 2000 ? size / 200 : 1;
        for (long at = 0; at < size; at += step) {
            flip(path, at);
            assert_false(read_all(&error));
            assert_non_null(strstr(error.message, path));
            flip(path, at);
        }
        for (long end = size - 1; end > 0; end = end * 2 / 3) {
            assert_int_equal(truncate(path, end), 0);
            assert_false(read_all(&error));
            assert_non_null(strstr(error.message, path));
        }
        unlink(path);
        assert_false(read_all(&error));
        assert_non_null(strstr(error.message, path));
    }
    free_board(b);
}

/* The marks of a file are checked before its checksum, so that the message names the cause. */
static void test_marks(void **state)
{
    static const struct {
        long at;
        const char *said;
    } cases[] = {{0, "not a file of a plan"}, {8, "version"}, {12, "order of bytes"}};
    static const char *const names[] = {"features", "cells"};
    board *b = draw_board(3);
    write_board(b, frame, 1, NULL);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        for (int f = 0; f < 2; f++) {
            gis_error error = {0};
            const char *path = scratch_path(names[f]);
            flip(path, cases[k].at);
            assert_false(read_all(&error));
            assert_non_null(strstr(error.message, cases[k].said));
            flip(path, cases[k].at);
        }
    free_board(b);
}

/* A spool that is not finished leaves the former one in place, and no other files. */
static void test_given_up(void **state)
{
    board *b = draw_board(20);
    gis_spool_writer *writer;
    gis_error error = {0};
    write_board(b, frame, 1, NULL);
    assert_true(gis_spool_create(scratch_directory(), NULL, &writer, &error));
    assert_true(gis_spool_add(writer, &b->feature[0], &error));
    gis_spool_writer_free(writer);
    read_board(b, 1);
    const char *path = scratch_path("features.runs");
    assert_int_not_equal(access(path, F_OK), 0);
    assert_true(gis_spool_create("/nowhere", NULL, &writer, &error));
    assert_false(gis_spool_finish(writer, 1, NULL, NULL, &error));
    gis_spool_writer_free(writer);
    assert_non_null(strstr(error.message, "/nowhere/features.part"));
    free_board(b);
}

static void test_full_disk(void **state)
{
    gis_disk_file file = {0};
    gis_error error = {0};
    static char bytes[1 << 16];
    if (access("/dev/full", W_OK) != 0) skip();
    assert_true(gis_disk_file_create(&file, "/dev", "full", &error) || true);
    bool done = true;
    for (int k = 0; k < 4 && done; k++) done = gis_disk_file_write(&file, bytes, sizeof bytes, &error);
    done = done && gis_disk_file_flush(&file, &error);
    assert_false(done);
    assert_non_null(strstr(error.message, "/dev/full: cannot be written: No space left"));
    gis_leftover_forget(file.leftover); /* the device may not be removed by the clean-up */
    file.leftover = NULL;
    gis_disk_file_close(&file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_was_put_in), cmocka_unit_test(test_settled),     cmocka_unit_test(test_refused),
        cmocka_unit_test(test_order),           cmocka_unit_test(test_poor_frames), cmocka_unit_test(test_harm),
        cmocka_unit_test(test_marks),           cmocka_unit_test(test_given_up),    cmocka_unit_test(test_full_disk),
    };
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
