/* planar_map/: each degenerate position, on maps small enough to know the result; every kind of query; numbers of every
 * size; and every allocation fails once. */
#include "failing.h"
#include "planar_map/planar_map.h"
#include "predicate/predicate.h"
#include "random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

typedef struct bed {
    sunder_i_lattice lattice;
    sunder_i_arena arena;
    sunder_i_planar_map *map;
} bed;

static void open_lattice(sunder_i_lattice *lattice, double reach, bool wide)
{
    double origin[1][2];
    const double corner[] = {-reach, -reach, reach, 1};
    sunder_i_extent e = {0};
    sunder_i_extent_add(&e, corner, 2);
    sunder_i_lattice_init(lattice, &e, 1, false, origin, wide);
}

static void open_bed(bed *b, double reach, bool wide)
{
    *b = (bed){0};
    open_lattice(&b->lattice, reach, wide);
    assert_int_equal(sunder_i_planar_map_new(&b->lattice, 1, &b->map, NULL), SUNDER_OK);
}

static void close_bed(bed *b)
{
    sunder_i_planar_map_free(b->map);
    sunder_i_lattice_free(&b->lattice);
    sunder_i_arena_free(&b->arena);
}

static void set(bed *b, sunder_i_rational_point *p, long x, long y, long w)
{
    *p = (sunder_i_rational_point){sunder_i_big_i64(&b->arena, x), sunder_i_big_i64(&b->arena, y),
                                   sunder_i_big_i64(&b->arena, w)};
}

static void check(bed *b)
{
    const char *wrong = sunder_i_planar_map_check(b->map);
    if (wrong) fail_msg("%s", wrong);
}

static void segment(bed *b, long ax, long ay, long bx, long by, uint32_t left, uint32_t right)
{
    sunder_i_rational_point p, q;
    set(b, &p, ax, ay, 1);
    set(b, &q, bx, by, 1);
    uint32_t first, last;
    assert_int_equal(sunder_i_planar_map_insert_segment(b->map, p, q, left, right, &first, &last, NULL), SUNDER_OK);
    assert_int_equal(sunder_i_planar_map_vertex_cmp(b->map, first, last), ax < bx || (ax == bx && ay < by) ? -1 : 1);
    check(b);
}

static void polygon(bed *b, size_t n, const long (*xy)[2], bool unite)
{
    sunder_i_rational_point corner[8];
    for (size_t i = 0; i < n; i++) set(b, &corner[i], xy[i][0], xy[i][1], 1);
    assert_int_equal(
        (unite ? sunder_i_planar_map_unite_polygon : sunder_i_planar_map_insert_polygon)(b->map, corner, NULL, n, NULL),
        SUNDER_OK);
    check(b);
}

static void box(bed *b, long x, long y, long w, long h, bool unite)
{
    const long xy[4][2] = {{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}};
    polygon(b, 4, xy, unite);
}

static sunder_i_location locate(bed *b, long x, long y, long w)
{
    sunder_i_rational_point p;
    set(b, &p, x, y, w);
    sunder_i_location l;
    assert_int_equal(sunder_i_planar_map_locate(b->map, p, &l, NULL), SUNDER_OK);
    return l;
}

static void expect_size(bed *b, size_t vertices, size_t edges, uint32_t faces)
{
    sunder_i_map_size size;
    sunder_i_planar_map_size(b->map, &size);
    assert_int_equal(size.vertices, vertices);
    assert_int_equal(size.edges, edges);
    assert_int_equal(sunder_i_planar_map_faces(b->map, NULL), SUNDER_OK);
    assert_int_equal(sunder_i_planar_map_face_end(b->map), faces);
    check(b);
}

static void mark(bed *b)
{
    assert_int_equal(sunder_i_planar_map_mark(b->map, NULL), SUNDER_OK);
    check(b);
}

/* ---- Degenerate positions ---- */

static void test_empty(void **state)
{
    (void)state;
    bed b;
    open_bed(&b, 100, false);
    expect_size(&b, 0, 0, 1);
    mark(&b);
    assert_int_equal(locate(&b, 3, 4, 1).place, SUNDER_I_IN_FACE);
    assert_int_equal(sunder_i_planar_map_clean(b.map, NULL), SUNDER_OK);
    expect_size(&b, 0, 0, 1);
    size_t n;
    sunder_i_planar_map_face_inner(b.map, 0, &n);
    assert_int_equal(n, 0);
    close_bed(&b);
}

/* A grid with vertical lines; each line consists of several overlapping pieces in both directions. */
static void test_grid_of_overlaps(void **state)
{
    (void)state;
    bed b;
    open_bed(&b, 100, false);
    for (long i = 0; i < 4; i++) {
        segment(&b, i, 3, i, 0, 1, 0);
        segment(&b, i, 1, i, 2, 0, 1);
        segment(&b, 0, i, 2, i, 1, 0);
        segment(&b, 3, i, 1, i, 0, 1);
    }
    expect_size(&b, 16, 24, 10);
    size_t twice = 0;
    for (uint32_t h = 0; h < 2 * sunder_i_planar_map_edge_end(b.map); h++) {
        if (!sunder_i_planar_map_edge_alive(b.map, h >> 1)) continue;
        const uint32_t s = sunder_i_planar_map_sides(b.map, h);
        twice += s == 2;
        assert_true(s <= 2);
    }
    assert_int_equal(twice, 8); /* the middle third of each line: the regions of both pieces are on the same side */
    close_bed(&b);
}

/* Sixteen lines through one point; no piece ends there. */
static void test_star(void **state)
{
    (void)state;
    bed b;
    open_bed(&b, 100, false);
    for (long i = -8; i < 8; i++) {
        segment(&b, 8, i, -8, -i, 0, 0);
        segment(&b, i, -8, -i, 8, 0, 0);
    }
    expect_size(&b, 1 + 64, 64, 1); /* the diagonal through both corners was added twice */
    const sunder_i_location l = locate(&b, 0, 0, 1);
    assert_int_equal(l.place, SUNDER_I_AT_VERTEX);
    size_t degree = 0;
    uint32_t h = sunder_i_planar_map_vertex_out(b.map, l.id);
    do {
        degree++;
        assert_int_equal(sunder_i_planar_map_origin(b.map, h), l.id);
        h = sunder_i_planar_map_ccw(b.map, h);
    } while (h != sunder_i_planar_map_vertex_out(b.map, l.id));
    assert_int_equal(degree, 64);
    close_bed(&b);
}

/* Four squares around a vertex and four half-planes (large enough to act as such) look the same along their sides: the
 * vertex not covered by the squares has one region all around it, the other has two. */
static void test_wrapped_vertex(void **state)
{
    (void)state;
    bed b;
    open_bed(&b, 100, false);
    for (int i = 0; i < 4; i++) box(&b, i & 1 ? 0 : -2, i & 2 ? 0 : -2, 2, 2, false);
    mark(&b);
    uint32_t v = locate(&b, 0, 0, 1).id;
    assert_int_equal(sunder_i_planar_map_vertex_covered(b.map, v), 0);
    assert_int_equal(sunder_i_planar_map_vertex_below(b.map, v), 1);
    box(&b, -9, 0, 18, 9, false);
    box(&b, -9, -9, 18, 9, false);
    mark(&b);
    assert_int_equal(sunder_i_planar_map_vertex_covered(b.map, v), 0);
    box(&b, -1, -1, 2, 2, false);
    mark(&b);
    v = locate(&b, 0, 0, 1).id;
    assert_int_equal(sunder_i_planar_map_vertex_covered(b.map, v), 1);
    assert_int_equal(locate(&b, 1, 1, 2).covered, 3);
    close_bed(&b);
}

/* The union of the following boxes has a hole with an antenna, an isolated point and a segment, for each algorithm. */
static void build_holes(bed *b, bool unite)
{
    box(b, 0, 0, 10, 4, unite);
    box(b, 0, 6, 10, 4, unite);
    box(b, 0, 0, 4, 10, unite);
    box(b, 6, 0, 4, 10, unite); /* a hole (4, 4) - (6, 6) in a square */
    box(b, 4, 0, 1, 5, unite);
    box(b, 5, 0, 1, 5, unite); /* fills its lower half, except the segment between the two */
    box(b, 20, 0, 4, 4, unite);
    box(b, 24, 4, 4, 4, unite);
    box(b, 20, 4, 4, 4, unite);
    box(b, 24, 0, 4, 4, unite); /* four squares: their common sides form a cross of segments */
    box(b, 20, 3, 8, 2, unite); /* which removes the centre and the two side arms of the cross */
}

static void expect_holes(bed *b)
{
    /* Outer square 4, hole 4 + antenna from (5, 4) to (5, 5) through the hole's bottom; second: outer 4, with two
     * attached segments. */
    assert_int_equal(sunder_i_planar_map_faces(b->map, NULL), SUNDER_OK);
    assert_int_equal(locate(b, 5, 6, 1).place, SUNDER_I_ON_EDGE);
    assert_int_equal(locate(b, 11, 11, 2).covered, 0); /* in the hole */
    assert_int_equal(locate(b, 5, 9, 2).place, SUNDER_I_IN_FACE);
    assert_int_equal(locate(b, 10, 9, 2).place, SUNDER_I_ON_EDGE); /* x = 5 between y = 4 and 5 */
    assert_int_equal(locate(b, 10, 9, 2).covered, 0);
    assert_int_equal(locate(b, 24, 2, 1).place, SUNDER_I_ON_EDGE);
    assert_int_equal(locate(b, 24, 3, 1).place, SUNDER_I_AT_VERTEX);
    assert_int_equal(locate(b, 24, 4, 1).place, SUNDER_I_IN_FACE);
    assert_int_equal(locate(b, 24, 4, 1).covered, 1);
    assert_int_equal(locate(b, 22, 4, 1).place, SUNDER_I_IN_FACE);
}

static void test_holes(void **state)
{
    (void)state;
    size_t edges[3];
    for (int road = 0; road < 3; road++) {
        bed b;
        open_bed(&b, 100, road == 2);
        build_holes(&b, road == 1);
        if (road != 1) {
            mark(&b);
            assert_int_equal(sunder_i_planar_map_clean(b.map, NULL), SUNDER_OK);
            check(&b);
        }
        expect_holes(&b);
        sunder_i_map_size size;
        sunder_i_planar_map_size(b.map, &size);
        edges[road] = size.edges;
        close_bed(&b);
    }
    assert_int_equal(edges[0], edges[1]);
    assert_int_equal(edges[0], edges[2]);
}

/* An exact fit leaves an isolated point; a polygon that covers it removes it. */
static void test_degenerate_point(void **state)
{
    (void)state;
    bed b;
    open_bed(&b, 100, false);
    const long up[3][2] = {{0, 0}, {4, 4}, {-4, 4}}, down[3][2] = {{0, 0}, {-4, -4}, {4, -4}};
    const long right[3][2] = {{0, 0}, {4, -4}, {4, 4}}, left[3][2] = {{0, 0}, {-4, 4}, {-4, -4}};
    polygon(&b, 3, up, true);
    polygon(&b, 3, down, true);
    polygon(&b, 3, right, true);
    polygon(&b, 3, left, true);
    expect_size(&b, 5, 8, 5); /* the diagonals are uncovered */
    box(&b, -4, 1, 8, 3, true);
    const long ring[4][4][2] = {{{0, 0}, {4, 0}, {4, 4}, {0, 4}},
                                {{0, 0}, {0, 4}, {-4, 4}, {-4, 0}},
                                {{0, 0}, {-4, 0}, {-4, -4}, {0, -4}},
                                {{0, 0}, {0, -4}, {4, -4}, {4, 0}}};
    for (int i = 0; i < 4; i++) polygon(&b, 4, ring[i], true);
    expect_size(&b, 5, 4, 2); /* the outline, and the centre as an isolated vertex */
    const sunder_i_location l = locate(&b, 0, 0, 1);
    assert_int_equal(l.place, SUNDER_I_AT_VERTEX);
    assert_int_equal(sunder_i_planar_map_vertex_out(b.map, l.id), SUNDER_I_NOWHERE);
    size_t n;
    const uint32_t f = sunder_i_planar_map_vertex_face(b.map, l.id);
    const uint32_t *isolated = sunder_i_planar_map_face_isolated(b.map, f, &n);
    assert_int_equal(n, 1);
    assert_int_equal(isolated[0], l.id);
    assert_int_equal(sunder_i_planar_map_face_covered(b.map, f), 1);
    box(&b, -1, -1, 2, 2, true);
    expect_size(&b, 4, 4, 2);
    close_bed(&b);
}

/* Small polygons are added and a large one covers them, until the history is a hundred times the size of the map: it
 * must not stay in memory. */
static void test_history_starts_afresh(void **state)
{
    (void)state;
    bed b;
    open_bed(&b, 1e6, false);
    rng g = rng_start(test_seed(), 3);
    size_t most = 0;
    bool shrank = false;
    for (int i = 0; i < 1000 && !shrank; i++) {
        box(&b, 0, 1000 * i, 1000, 900, true);
        for (int k = 0; k < 30; k++) {
            const long x = rng_int(&g, 0, 900), y = rng_int(&g, 0, 800);
            const long xy[3][2] = {{x, 1000 * i + y}, {x + 90, 1000 * i + y + 10}, {x + 20, 1000 * i + y + 90}};
            polygon(&b, 3, xy, true);
        }
        for (int k = 0; k < 10; k++) box(&b, rng_int(&g, 0, 900), 1000 * i + rng_int(&g, 0, 900), 200, 300, true);
        box(&b, -500, -5, 5000, 1000 * i + 1300, true);
        sunder_i_map_size size;
        sunder_i_planar_map_size(b.map, &size);
        assert_int_equal(size.edges, 4);
        shrank = shrank || size.history < most;
        most = size.history > most ? size.history : most;
    }
    assert_true(shrank);
    assert_true(most < 200000);
    assert_int_equal(locate(&b, 0, 0, 1).covered, 1);
    close_bed(&b);
}

/* ---- Faces ---- */

static void test_faces(void **state)
{
    (void)state;
    bed b;
    open_bed(&b, 100, false);
    box(&b, 0, 0, 20, 20, false);
    box(&b, 2, 2, 4, 4, false);
    box(&b, 10, 10, 5, 5, false);
    segment(&b, 0, 10, 3, 10, 0, 0); /* an antenna */
    segment(&b, 16, 2, 18, 4, 0, 0); /* an isolated segment */
    sunder_i_rational_point p;
    set(&b, &p, 17, 17, 1);
    uint32_t v;
    assert_int_equal(sunder_i_planar_map_insert_point(b.map, p, 0, &v, NULL), SUNDER_OK);
    mark(&b);
    assert_int_equal(sunder_i_planar_map_faces(b.map, NULL), SUNDER_OK);
    check(&b);
    assert_int_equal(sunder_i_planar_map_face_end(b.map), 4);
    const uint32_t f = locate(&b, 1, 1, 1).face;
    size_t n;
    assert_int_equal(sunder_i_planar_map_face_covered(b.map, f), 1);
    sunder_i_planar_map_face_inner(b.map, f, &n);
    assert_int_equal(n, 3);
    assert_int_equal(*sunder_i_planar_map_face_isolated(b.map, f, &n), v);
    assert_int_equal(n, 1);
    /* The outer boundary passes the antenna on both sides. */
    size_t length = 0;
    uint32_t h = sunder_i_planar_map_face_outer(b.map, f);
    do {
        assert_int_equal(sunder_i_planar_map_face(b.map, h), f);
        assert_int_equal(sunder_i_planar_map_prev(b.map, sunder_i_planar_map_next(b.map, h)), h);
        length++;
        h = sunder_i_planar_map_next(b.map, h);
    } while (h != sunder_i_planar_map_face_outer(b.map, f));
    assert_int_equal(length, 5 + 2);
    assert_int_equal(locate(&b, 17, 17, 1).id, v);
    assert_int_equal(sunder_i_planar_map_remove_vertex(b.map, v, NULL), SUNDER_OK);
    check(&b);
    close_bed(&b);
}

/* ---- Numbers ---- */

/* Corners with denominators of sixty bits, at coordinates of sixty bits, which neither a double nor the sum of three
 * doubles distinguishes. */
static void test_large_numbers(void **state)
{
    (void)state;
    for (int wide = 0; wide < 2; wide++) {
        bed b;
        open_bed(&b, 0x1p57, wide);
        rng g = rng_start(test_seed(), 7);
        for (int i = 0; i < 30; i++) {
            const long x = rng_int(&g, 0, 3), y = rng_int(&g, 0, 3), big = 0x1ffffffffffffffL;
            sunder_i_rational_point corner[3];
            set(&b, &corner[0], x * 5 + big, y * 5 - big, big - i % 5);
            set(&b, &corner[1], x * 5 + 7 + big, y * 5 - big, big - i % 5);
            set(&b, &corner[2], x * 5 + 3 + big, y * 5 + 4 - big, big - i % 5);
            assert_int_equal(sunder_i_planar_map_insert_polygon(b.map, corner, NULL, 3, NULL), SUNDER_OK);
            check(&b);
        }
        mark(&b);
        assert_int_equal(sunder_i_planar_map_clean(b.map, NULL), SUNDER_OK);
        check(&b);
        assert_true(b.lattice.counts.exact_fallbacks > 0);
        close_bed(&b);
    }
}

/* A lattice from 1e-300 to 1e300: two thousand bits. */
static void test_wide_lattice(void **state)
{
    (void)state;
    bed b = {0};
    double origin[1][2];
    const double corner[] = {1e-300, -1e300, 1e300, 1};
    sunder_i_extent e = {0};
    sunder_i_extent_add(&e, corner, 2);
    sunder_i_lattice_init(&b.lattice, &e, 1, false, origin, false);
    assert_false(b.lattice.narrow);
    assert_int_equal(sunder_i_planar_map_new(&b.lattice, 1, &b.map, NULL), SUNDER_OK);
    const double size[] = {1e-300, 2e-300, 1e-8, 1, 3, 1e17, 1e300};
    for (int i = 0; i < 7; i++)
        for (int j = 0; j < 7; j++) {
            const double s = size[i], t = size[j], x[4] = {0, s, s, 0}, y[4] = {0, 0, t, t};
            sunder_i_rational_point at[4];
            sunder_i_point along[4];
            sunder_i_point n[4];
            for (int k = 0; k < 4; k++) {
                n[k].x = sunder_i_lattice_int(&b.lattice, x[k], 0);
                n[k].y = sunder_i_lattice_int(&b.lattice, y[k], 0);
                at[k] =
                    (sunder_i_rational_point){sunder_i_lattice_get(&b.lattice, n[k].x),
                                              sunder_i_lattice_get(&b.lattice, n[k].y), sunder_i_big_i64(&b.arena, 1)};
            }
            for (int k = 0; k < 4; k++) along[k] = sunder_i_point_sub(&b.lattice, n[(k + 1) % 4], n[k]);
            assert_int_equal(sunder_i_planar_map_insert_polygon(b.map, at, i & 1 ? along : NULL, 4, NULL), SUNDER_OK);
            check(&b);
        }
    mark(&b);
    expect_size(&b, 64, 112, 50);
    assert_int_equal(sunder_i_planar_map_clean(b.map, NULL), SUNDER_OK);
    expect_size(&b, 4, 4, 2);
    close_bed(&b);
}

/* ---- Memory ---- */

static bool whole_run(void *context)
{
    const bool wide = *(const bool *)context;
    bed b = {0};
    open_lattice(&b.lattice, 100, wide);
    sunder_i_planar_map *other = NULL;
    bool ok = sunder_i_planar_map_new(&b.lattice, 1, &b.map, NULL) == SUNDER_OK &&
              sunder_i_planar_map_new(&b.lattice, 2, &other, NULL) == SUNDER_OK;
    for (long i = 0; ok && i < 3; i++) {
        const long xy[4][2] = {{i, i}, {i + 3, i + 1}, {i + 3, i + 4}, {i, i + 2}};
        sunder_i_rational_point corner[4];
        for (int k = 0; k < 4; k++) set(&b, &corner[k], xy[k][0], xy[k][1], 1 + i);
        ok = !b.arena.failed && sunder_i_planar_map_insert_polygon(b.map, corner, NULL, 4, NULL) == SUNDER_OK &&
             sunder_i_planar_map_unite_polygon(other, corner, NULL, 4, NULL) == SUNDER_OK;
    }
    sunder_i_rational_point p;
    if (ok) set(&b, &p, 1, 1, 1);
    sunder_i_location l;
    ok = ok && sunder_i_planar_map_mark(b.map, NULL) == SUNDER_OK &&
         sunder_i_planar_map_clean(b.map, NULL) == SUNDER_OK &&
         sunder_i_planar_map_overlay(b.map, other, NULL) == SUNDER_OK &&
         sunder_i_planar_map_mark(b.map, NULL) == SUNDER_OK && sunder_i_planar_map_faces(b.map, NULL) == SUNDER_OK &&
         !b.arena.failed && sunder_i_planar_map_locate(b.map, p, &l, NULL) == SUNDER_OK &&
         sunder_i_planar_map_remove_edge(b.map, 0, NULL) == SUNDER_OK;
    sunder_i_planar_map_free(other);
    close_bed(&b);
    return ok;
}

static void test_every_allocation_fails(void **state)
{
    (void)state;
    failing_begin();
    for (int wide = 0; wide < 2; wide++) {
        bool context = wide;
        assert_true(failing_loop(whole_run, &context, false));
    }
    failing_end();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_empty),
        cmocka_unit_test(test_grid_of_overlaps),
        cmocka_unit_test(test_star),
        cmocka_unit_test(test_wrapped_vertex),
        cmocka_unit_test(test_holes),
        cmocka_unit_test(test_degenerate_point),
        cmocka_unit_test(test_history_starts_afresh),
        cmocka_unit_test(test_faces),
        cmocka_unit_test(test_large_numbers),
        cmocka_unit_test(test_wide_lattice),
        cmocka_unit_test(test_every_allocation_fails),
    };
    return cmocka_run_group_tests_name("planar_map", tests, NULL, NULL);
}
