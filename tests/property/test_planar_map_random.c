/* planar_map/: random convex polygons on small grids, where coincidences are frequent, are inserted, united, overlaid
 * and removed. The checker runs after every step, and counts and places are compared with the polygons themselves in
 * GMP's rationals. */
#include "gmp_numbers.h"
#include "planar_map/planar_map.h"
#include "random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#define MOST_CORNERS 12
#define MOST_POLYGONS 12
#define MOST_POINTS 4000

/* ---- The polygons by themselves: integer corners over a common denominator ----------- */

typedef struct polygon {
    int n;
    long x[MOST_CORNERS], y[MOST_CORNERS], w; /* coordinates over the common denominator w */
} polygon;

typedef struct point {
    mpq_t x, y;
} point;

typedef struct world {
    rng g;
    int n;
    polygon p[MOST_POLYGONS];
    int points;
    point *at;
    sunder_i_lattice lattice;
    sunder_i_arena arena;
} world;

static long cross(long ax, long ay, long bx, long by) { return ax * by - ay * bx; }

static int by_xy(const void *a, const void *b)
{
    const long *p = a, *q = b;
    return p[0] != q[0] ? (p[0] < q[0] ? -1 : 1) : (p[1] > q[1]) - (p[1] < q[1]);
}

/* The hull of random points; `loose` keeps collinear corners and repeats some. Returns false if it has no area. */
static bool random_polygon(rng *g, polygon *p, bool loose)
{
    const int style = (int)rng_int(g, 0, 3), wide = style == 3 ? 1000 : (int)rng_int(g, 2, 8);
    p->w = rng_once_in(g, 3) ? rng_int(g, 2, 5) : 1;
    if (style == 0) { /* a rectangle */
        const long x = rng_int(g, 0, wide - 1), y = rng_int(g, 0, wide - 1), a = rng_int(g, 1, wide),
                   b = rng_int(g, 1, wide);
        *p = (polygon){4, {x, x + a, x + a, x}, {y, y, y + b, y + b}, p->w};
        return true;
    }
    long xy[8][2], hull[17][2];
    const int n = (int)rng_int(g, 3, 8);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < 2; k++) xy[i][k] = rng_int(g, 0, wide);
    qsort(xy, (size_t)n, sizeof *xy, by_xy);
    int m = 0;
    for (int pass = 0; pass < 2; pass++) {
        const int start = m;
        for (int k = 0; k < n; k++) {
            const int i = pass ? n - 1 - k : k;
            while (m >= start + 2) {
                const long turn = cross(hull[m - 1][0] - hull[m - 2][0], hull[m - 1][1] - hull[m - 2][1],
                                        xy[i][0] - hull[m - 1][0], xy[i][1] - hull[m - 1][1]);
                if (turn > 0 || (turn == 0 && loose && (xy[i][0] != hull[m - 1][0] || xy[i][1] != hull[m - 1][1])))
                    break;
                m--;
            }
            hull[m][0] = xy[i][0];
            hull[m++][1] = xy[i][1];
        }
        m--;
    }
    if (m < 3 || m > MOST_CORNERS - 1) return false;
    long area = 0;
    p->n = m;
    for (int i = 0; i < m; i++) {
        p->x[i] = hull[i][0];
        p->y[i] = hull[i][1];
        area += cross(hull[i][0], hull[i][1], hull[(i + 1) % m][0], hull[(i + 1) % m][1]);
    }
    if (area <= 0) return false;
    if (loose && rng_once_in(g, 3)) { /* repeats the last corner */
        p->x[m] = p->x[m - 1];
        p->y[m] = p->y[m - 1];
        p->n++;
    }
    return true;
}

/* Sign of the side on which (x, y) is of side i of p: 0 on its line; 2 for a side of length zero. */
static int side_of(const polygon *p, int i, mpq_srcptr x, mpq_srcptr y)
{
    const int j = (i + 1) % p->n;
    const long dx = p->x[j] - p->x[i], dy = p->y[j] - p->y[i];
    if (dx == 0 && dy == 0) return 2;
    mpq_t a, b;
    mpq_inits(a, b, NULL);
    mpq_set_si(a, p->y[i], (unsigned long)p->w);
    mpq_canonicalize(a);
    mpq_sub(a, y, a);
    mpq_set_si(b, dx, 1);
    mpq_mul(a, a, b);
    mpq_set_si(b, p->x[i], (unsigned long)p->w);
    mpq_canonicalize(b);
    mpq_sub(b, x, b);
    mpq_t c;
    mpq_init(c);
    mpq_set_si(c, dy, 1);
    mpq_mul(b, b, c);
    const int s = mpq_cmp(a, b);
    mpq_clears(a, b, c, NULL);
    return (s > 0) - (s < 0);
}

/* +1 inside, 0 on the boundary, -1 outside. */
static int place_in(const polygon *p, mpq_srcptr x, mpq_srcptr y)
{
    int least = 1;
    for (int i = 0; i < p->n; i++) {
        const int s = side_of(p, i, x, y);
        if (s < 0) return -1;
        if (s == 0) least = 0;
    }
    return least;
}

/* Does p have a side on the line through a and b, with the same direction, that contains the midpoint m? */
static bool has_side(const polygon *p, const point *a, const point *b, const point *m)
{
    if (place_in(p, m->x, m->y) != 0) return false;
    const int ex = mpq_cmp(b->x, a->x), ey = mpq_cmp(b->y, a->y);
    for (int i = 0; i < p->n; i++) {
        const long dx = p->x[(i + 1) % p->n] - p->x[i], dy = p->y[(i + 1) % p->n] - p->y[i];
        if (side_of(p, i, a->x, a->y) == 0 && side_of(p, i, b->x, b->y) == 0 &&
            (dx ? (dx > 0) == (ex > 0) : (dy > 0) == (ey > 0)))
            return true;
    }
    return false;
}

static unsigned inside(const world *w, mpq_srcptr x, mpq_srcptr y, unsigned *boundary)
{
    unsigned n = 0;
    *boundary = 0;
    for (int i = 0; i < w->n; i++) {
        const int s = place_in(&w->p[i], x, y);
        n += s > 0;
        *boundary += s == 0;
    }
    return n;
}

static void add_point(world *w, mpq_srcptr x, mpq_srcptr y)
{
    if (w->points == MOST_POINTS) return;
    mpq_inits(w->at[w->points].x, w->at[w->points].y, NULL);
    mpq_set(w->at[w->points].x, x);
    mpq_set(w->at[w->points++].y, y);
}

/* Crossings of the lines of all sides (which include every vertex of the arrangement), in random order and at most as
 * many as fit, midpoints of pairs of them, and points of a grid. */
static void choose_points(world *w)
{
    mpq_t x, y;
    mpq_inits(x, y, NULL);
    for (int a = 0; a < w->n; a++)
        for (int b = 0; b < a; b++)
            for (int i = 0; i < w->p[a].n; i++)
                for (int j = 0; j < w->p[b].n; j++) {
                    const polygon *p = &w->p[a], *q = &w->p[b];
                    const int i2 = (i + 1) % p->n, j2 = (j + 1) % q->n;
                    /* Coordinates times p.w q.w: lines A x + B y = C. */
                    const long A = (p->y[i] - p->y[i2]) * q->w, B = (p->x[i2] - p->x[i]) * q->w;
                    const long C = (A * p->x[i] + B * p->y[i]) * q->w;
                    const long D = (q->y[j] - q->y[j2]) * p->w, E = (q->x[j2] - q->x[j]) * p->w;
                    const long F = (D * q->x[j] + E * q->y[j]) * p->w, det = cross(A, B, D, E);
                    if (det == 0 || !rng_once_in(&w->g, 1 + w->n * w->n / 8)) continue;
                    mpq_set_si(x, det > 0 ? cross(C, B, F, E) : -cross(C, B, F, E), (unsigned long)labs(det));
                    mpq_set_si(y, det > 0 ? cross(A, C, D, F) : -cross(A, C, D, F), (unsigned long)labs(det));
                    mpq_canonicalize(x);
                    mpq_canonicalize(y);
                    mpq_t scale;
                    mpq_init(scale);
                    mpq_set_si(scale, 1, (unsigned long)(p->w * q->w));
                    mpq_mul(x, x, scale);
                    mpq_mul(y, y, scale);
                    mpq_clear(scale);
                    add_point(w, x, y);
                }
    const int crossings = w->points;
    for (int k = 0; k < 60 && crossings; k++) {
        const point *p = &w->at[rng_int(&w->g, 0, crossings - 1)], *q = &w->at[rng_int(&w->g, 0, crossings - 1)];
        mpq_add(x, p->x, q->x);
        mpq_add(y, p->y, q->y);
        mpq_div_2exp(x, x, 1);
        mpq_div_2exp(y, y, 1);
        add_point(w, x, y);
    }
    for (int k = 0; k < 60; k++) {
        mpq_set_si(x, rng_int(&w->g, -2, 40), (unsigned long)rng_int(&w->g, 1, 6));
        mpq_set_si(y, rng_int(&w->g, -2, 40), (unsigned long)rng_int(&w->g, 1, 6));
        mpq_canonicalize(x);
        mpq_canonicalize(y);
        add_point(w, x, y);
    }
    mpq_clears(x, y, NULL);
}

static void open_world(world *w, uint64_t i, int polygons, bool loose, bool wide)
{
    *w = (world){.g = rng_start(test_seed(), i)};
    w->at = malloc(MOST_POINTS * sizeof *w->at);
    assert_non_null(w->at);
    while (w->n < polygons) w->n += random_polygon(&w->g, &w->p[w->n], loose);
    choose_points(w);
    double origin[1][2];
    const double corner[] = {-1, -1, 3000, 3};
    sunder_i_extent e = {0};
    sunder_i_extent_add(&e, corner, 2);
    sunder_i_lattice_init(&w->lattice, &e, 1, false, origin, wide);
}

static void close_world(world *w)
{
    for (int i = 0; i < w->points; i++) mpq_clears(w->at[i].x, w->at[i].y, NULL);
    free(w->at);
    sunder_i_lattice_free(&w->lattice);
    sunder_i_arena_free(&w->arena);
}

/* ---- The same polygons in the map's numbers ---- */

static void corners_of(world *w, const polygon *p, sunder_i_rational_point *out)
{
    for (int i = 0; i < p->n; i++)
        out[i] = (sunder_i_rational_point){sunder_i_big_i64(&w->arena, p->x[i]), sunder_i_big_i64(&w->arena, p->y[i]),
                                           sunder_i_big_i64(&w->arena, p->w)};
}

static void insert(world *w, sunder_i_planar_map *map, int i, bool unite)
{
    sunder_i_rational_point corner[MOST_CORNERS];
    sunder_i_point along[MOST_CORNERS];
    const polygon *p = &w->p[i];
    corners_of(w, p, corner);
    for (int k = 0; k < p->n; k++)
        along[k] = (sunder_i_point){p->x[(k + 1) % p->n] - p->x[k], p->y[(k + 1) % p->n] - p->y[k]};
    const bool by_direction = w->lattice.narrow && rng_once_in(&w->g, 2);
    const sunder_status s = (unite ? sunder_i_planar_map_unite_polygon : sunder_i_planar_map_insert_polygon)(
        map, corner, by_direction ? along : NULL, (size_t)p->n, NULL);
    assert_int_equal(s, SUNDER_OK);
}

static void check(sunder_i_planar_map *map)
{
    const char *wrong = sunder_i_planar_map_check(map);
    if (wrong) fail_msg("%s (seed %llu)", wrong, (unsigned long long)test_seed());
}

static void coordinate(mpq_t out, sunder_i_big n, sunder_i_big w)
{
    mpz_t a;
    mpz_roinit_n(a, n.limb, n.size);
    mpz_set(mpq_numref(out), a);
    mpz_roinit_n(a, w.limb, w.size);
    mpz_set(mpq_denref(out), a);
    mpq_canonicalize(out);
}

static sunder_i_location locate(world *w, sunder_i_planar_map *map, const point *p)
{
    sunder_i_rational_point at;
    mpz_t n;
    mpz_init(n);
    mpz_mul(n, mpq_numref(p->x), mpq_denref(p->y));
    at.x = big_from_mpz(&w->arena, n);
    mpz_mul(n, mpq_numref(p->y), mpq_denref(p->x));
    at.y = big_from_mpz(&w->arena, n);
    mpz_mul(n, mpq_denref(p->x), mpq_denref(p->y));
    at.w = big_from_mpz(&w->arena, n);
    mpz_clear(n);
    sunder_i_location l;
    assert_int_equal(sunder_i_planar_map_locate(map, at, &l, NULL), SUNDER_OK);
    return l;
}

static void vertex_point(const sunder_i_planar_map *map, uint32_t v, point *out)
{
    const sunder_i_rational_point *at = sunder_i_planar_map_vertex_point(map, v);
    coordinate(out->x, at->x, at->w);
    coordinate(out->y, at->y, at->w);
}

/* Compares every vertex and edge with the polygons. If the map is clean (united), covered counts are 0 or 1, and no
 * covered edges or vertices are left. */
static void compare_cells(world *w, sunder_i_planar_map *map, bool clean)
{
    point p, q, m;
    mpq_inits(p.x, p.y, q.x, q.y, m.x, m.y, NULL);
    unsigned boundary;
    for (uint32_t v = 0; v < sunder_i_planar_map_vertex_end(map); v++) {
        if (!sunder_i_planar_map_vertex_alive(map, v)) continue;
        vertex_point(map, v, &p);
        const unsigned n = inside(w, p.x, p.y, &boundary);
        assert_true(boundary > 0);
        assert_int_equal(sunder_i_planar_map_vertex_covered(map, v), n);
        if (clean) {
            assert_int_equal(n, 0);
            assert_false(sunder_i_planar_map_mergeable(map, v));
        }
    }
    for (uint32_t h = 0; h < 2 * sunder_i_planar_map_edge_end(map); h++) {
        if (!sunder_i_planar_map_edge_alive(map, h >> 1)) continue;
        vertex_point(map, sunder_i_planar_map_origin(map, h), &p);
        vertex_point(map, sunder_i_planar_map_origin(map, sunder_i_planar_map_twin(h)), &q);
        mpq_add(m.x, p.x, q.x);
        mpq_add(m.y, p.y, q.y);
        mpq_div_2exp(m.x, m.x, 1);
        mpq_div_2exp(m.y, m.y, 1);
        const unsigned n = inside(w, m.x, m.y, &boundary);
        unsigned left = 0;
        for (int i = 0; i < w->n; i++) left += has_side(&w->p[i], &p, &q, &m);
        if (clean) left = left + n > 0;
        assert_int_equal(sunder_i_planar_map_edge_covered(map, h >> 1), n);
        assert_int_equal(sunder_i_planar_map_sides(map, h), left);
        assert_int_equal(sunder_i_planar_map_left_covered(map, h), n + left);
        if (clean) assert_int_equal(n, 0);
    }
    mpq_clears(p.x, p.y, q.x, q.y, m.x, m.y, NULL);
}

static void compare_points(world *w, sunder_i_planar_map *map, bool clean)
{
    for (int i = 0; i < w->points; i++) {
        const point *p = &w->at[i];
        const sunder_i_location l = locate(w, map, p);
        unsigned boundary;
        const unsigned n = inside(w, p->x, p->y, &boundary);
        assert_int_equal(l.covered, clean ? n > 0 : n);
        assert_int_equal(l.place != SUNDER_I_IN_FACE, boundary > 0 && (!clean || n == 0));
    }
}

static void compare(world *w, sunder_i_planar_map *map, bool clean)
{
    check(map);
    assert_int_equal(sunder_i_planar_map_faces(map, NULL), SUNDER_OK);
    check(map);
    compare_cells(w, map, clean);
    compare_points(w, map, clean);
}

/* ---- The tests ---- */

static sunder_i_planar_map *new_map(world *w)
{
    sunder_i_planar_map *map;
    assert_int_equal(sunder_i_planar_map_new(&w->lattice, rng_next(&w->g), &map, NULL), SUNDER_OK);
    return map;
}

static void test_arrangement(void **state)
{
    (void)state;
    for (size_t i = 0; i < test_count(150); i++) {
        world w;
        open_world(&w, i, (int)(1 + i % MOST_POLYGONS), i % 2, i % 5 == 4);
        sunder_i_planar_map *map = new_map(&w);
        for (int k = 0; k < w.n; k++) {
            insert(&w, map, k, false);
            check(map);
        }
        assert_int_equal(sunder_i_planar_map_mark(map, NULL), SUNDER_OK);
        compare(&w, map, false);
        assert_int_equal(sunder_i_planar_map_clean(map, NULL), SUNDER_OK);
        compare(&w, map, true);
        sunder_i_planar_map_free(map);
        close_world(&w);
    }
}

static void test_incremental(void **state)
{
    (void)state;
    for (size_t i = 0; i < test_count(150); i++) {
        world w;
        open_world(&w, 10000 + i, (int)(1 + i % MOST_POLYGONS), i % 2, i % 5 == 4);
        sunder_i_planar_map *map = new_map(&w);
        const int all = w.n;
        for (int k = 0; k < all; k++) {
            insert(&w, map, k, true);
            check(map);
            w.n = k + 1;
            compare_cells(&w, map, true);
            w.n = all;
        }
        compare(&w, map, true);
        sunder_i_planar_map_free(map);
        close_world(&w);
    }
}

static void test_divide(void **state)
{
    (void)state;
    for (size_t i = 0; i < test_count(150); i++) {
        world w;
        open_world(&w, 20000 + i, (int)(2 + i % (MOST_POLYGONS - 1)), i % 2, i % 5 == 4);
        sunder_i_planar_map *half[2] = {new_map(&w), new_map(&w)};
        const bool unite = rng_once_in(&w.g, 2);
        for (int k = 0; k < w.n; k++) insert(&w, half[k % 2], k, unite);
        assert_int_equal(sunder_i_planar_map_overlay(half[0], half[1], NULL), SUNDER_OK);
        check(half[0]);
        assert_int_equal(sunder_i_planar_map_mark(half[0], NULL), SUNDER_OK);
        if (!unite) compare(&w, half[0], false);
        check(half[0]);
        assert_int_equal(sunder_i_planar_map_clean(half[0], NULL), SUNDER_OK);
        compare(&w, half[0], true);
        for (int k = 0; k < 2; k++) sunder_i_planar_map_free(half[k]);
        close_world(&w);
    }
}

/* Edges are removed and segments inserted in any order; at the end all are removed, and one face is left. */
static void test_removal(void **state)
{
    (void)state;
    for (size_t i = 0; i < test_count(60); i++) {
        world w;
        open_world(&w, 30000 + i, (int)(1 + i % 6), i % 2, i % 5 == 4);
        sunder_i_planar_map *map = new_map(&w);
        for (int k = 0; k < w.n; k++) insert(&w, map, k, false);
        for (int step = 0; step < 200; step++) {
            sunder_i_map_size size;
            sunder_i_planar_map_size(map, &size);
            const bool more = step < 100 && rng_once_in(&w.g, 8);
            if (more) insert(&w, map, (int)rng_int(&w.g, 0, w.n - 1), false);
            const uint32_t e = (uint32_t)rng_int(&w.g, 0, sunder_i_planar_map_edge_end(map) - 1);
            if (sunder_i_planar_map_edge_alive(map, e))
                assert_int_equal(sunder_i_planar_map_remove_edge(map, 2 * e + (e & 1), NULL), SUNDER_OK);
            const uint32_t v = (uint32_t)rng_int(&w.g, 0, sunder_i_planar_map_vertex_end(map) - 1);
            if (sunder_i_planar_map_vertex_alive(map, v)) {
                if (sunder_i_planar_map_vertex_out(map, v) == SUNDER_I_NOWHERE)
                    assert_int_equal(sunder_i_planar_map_remove_vertex(map, v, NULL), SUNDER_OK);
                else if (sunder_i_planar_map_mergeable(map, v))
                    assert_int_equal(sunder_i_planar_map_merge_vertex(map, v, NULL), SUNDER_OK);
            }
            check(map);
        }
        for (uint32_t e = 0; e < sunder_i_planar_map_edge_end(map); e++)
            if (sunder_i_planar_map_edge_alive(map, e))
                assert_int_equal(sunder_i_planar_map_remove_edge(map, 2 * e, NULL), SUNDER_OK);
        check(map);
        for (uint32_t v = 0; v < sunder_i_planar_map_vertex_end(map); v++)
            if (sunder_i_planar_map_vertex_alive(map, v))
                assert_int_equal(sunder_i_planar_map_remove_vertex(map, v, NULL), SUNDER_OK);
        check(map);
        sunder_i_map_size size;
        sunder_i_planar_map_size(map, &size);
        assert_int_equal(size.vertices + size.edges, 0);
        assert_int_equal(size.trapezoids, 1);
        sunder_i_planar_map_free(map);
        close_world(&w);
    }
}

int main(void)
{
    printf("seed %llu\n", (unsigned long long)test_seed());
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_arrangement), cmocka_unit_test(test_incremental),
                                       cmocka_unit_test(test_divide), cmocka_unit_test(test_removal)};
    return cmocka_run_group_tests_name("planar_map", tests, NULL, NULL);
}
