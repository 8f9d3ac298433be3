/* unions/: the planar map of a sum, through the public interface; orders of insertion and measures of fatness; options
 * out of range, stops, and every allocation fails once. tests/property tests that all algorithms give the same sum. */
#include "failing.h"
#include "generate.h"
#include "generated.h"
#include "roads.h"
#include "unions/unions.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <gmp.h>

/* ---- The map ---- */

static uint32_t find(uint32_t *parent, uint32_t v)
{
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
}

/* Half-edges, vertices and faces refer to each other consistently; the number of faces agrees with Euler's formula. */
static void check_links(const sunder_map *m)
{
    const uint32_t vertices = (uint32_t)sunder_map_vertices(m), halves = 2 * (uint32_t)sunder_map_edges(m);
    uint32_t *parent = test_alloc(vertices, sizeof *parent), *degree = test_alloc(vertices, sizeof *degree);
    uint32_t parts = vertices;
    for (uint32_t v = 0; v < vertices; v++) {
        parent[v] = v;
        degree[v] = 0;
    }
    for (uint32_t h = 0; h < halves; h++) {
        const uint32_t twin = sunder_map_twin(h), next = sunder_map_next(m, h), v = sunder_map_origin(m, h);
        assert_int_equal(sunder_map_twin(twin), h);
        assert_int_equal(sunder_map_origin(m, next), sunder_map_origin(m, twin));
        assert_int_equal(sunder_map_face(m, next), sunder_map_face(m, h));
        assert_true(sunder_map_face(m, h) < sunder_map_faces(m));
        degree[v]++;
        const uint32_t a = find(parent, v), b = find(parent, sunder_map_origin(m, twin));
        parts -= a != b;
        parent[a] = b;
    }
    for (uint32_t v = 0; v < vertices; v++) {
        const uint32_t out = sunder_map_out(m, v);
        assert_int_equal(out == SUNDER_NOWHERE, degree[v] == 0);
        assert_int_equal(sunder_map_around(m, v) == SUNDER_NOWHERE, degree[v] != 0);
        uint32_t n = 0, h = out;
        if (h != SUNDER_NOWHERE) do {
                assert_int_equal(sunder_map_origin(m, h), v);
                n++;
                h = sunder_map_turn(m, h);
            } while (h != out);
        assert_int_equal(n, degree[v]);
    }
    assert_int_equal(vertices + sunder_map_faces(m), halves / 2 + 1 + parts);
    free(parent);
    free(degree);
}

/* Each half-edge is on one boundary of its face, and the listed boundaries are complete. */
static void check_boundaries(const sunder_map *m)
{
    size_t seen = 0;
    for (uint32_t f = 0; f < sunder_map_faces(m); f++) {
        size_t n;
        const uint32_t *inner = sunder_map_inner(m, f, &n), outer = sunder_map_outer(m, f);
        assert_int_equal(outer == SUNDER_NOWHERE, f == 0);
        for (size_t i = 0; i <= n; i++) {
            const uint32_t start = i < n ? inner[i] : outer;
            uint32_t h = start;
            if (h != SUNDER_NOWHERE) do {
                    assert_int_equal(sunder_map_face(m, h), f);
                    seen++;
                    h = sunder_map_next(m, h);
                } while (h != start);
        }
    }
    assert_int_equal(seen, 2 * sunder_map_edges(m));
}

static void vertex_at(const sunder_map *m, uint32_t v, mpq_t x, mpq_t y)
{
    char *xt, *yt;
    assert_int_equal(sunder_map_vertex_text(m, v, &xt, &yt, NULL), SUNDER_OK);
    assert_int_equal(mpq_set_str(x, xt, 10) | mpq_set_str(y, yt, 10), 0);
    double xy[2];
    sunder_map_vertex(m, v, xy);
    assert_true(xy[0] == 0 || xy[0] / mpq_get_d(x) > 0.999);
    sunder_free(xt);
    sunder_free(yt);
}

/* The covered faces have together the area of the sum; the degenerate holes are those that can be counted one by
 * one. */
static void check_covered(const sunder_sum *sum, const sunder_map *m)
{
    mpq_t a[2], b[2], area, part, want;
    mpq_inits(a[0], a[1], b[0], b[1], area, part, want, NULL);
    size_t slits = 0, points = 0;
    for (uint32_t h = 0; h < 2 * sunder_map_edges(m); h++) {
        const uint32_t left = sunder_map_face_covered(m, sunder_map_face(m, h));
        const uint32_t right = sunder_map_face_covered(m, sunder_map_face(m, sunder_map_twin(h)));
        const uint32_t on = sunder_map_edge_covered(m, h >> 1);
        assert_true(on <= left && on <= right);
        slits += !on && left && right;
        if (!left || right) continue; /* inner edges, and edges of holes from the other side, add nothing */
        vertex_at(m, sunder_map_origin(m, h), a[0], a[1]);
        vertex_at(m, sunder_map_origin(m, sunder_map_twin(h)), b[0], b[1]);
        mpq_mul(part, a[0], b[1]);
        mpq_add(area, area, part);
        mpq_mul(part, a[1], b[0]);
        mpq_sub(area, area, part);
    }
    for (uint32_t v = 0; v < sunder_map_vertices(m); v++) {
        bool alone = sunder_map_vertex_covered(m, v) == 0;
        uint32_t h = sunder_map_out(m, v);
        if (h != SUNDER_NOWHERE) do {
                alone = alone && sunder_map_edge_covered(m, h >> 1);
                h = sunder_map_turn(m, h);
            } while (h != sunder_map_out(m, v));
        points += alone;
    }
    sunder_sum_size size;
    sunder_sum_get_size(sum, &size);
    char *text;
    assert_int_equal(sunder_sum_area_text(sum, &text, NULL), SUNDER_OK);
    assert_int_equal(mpq_set_str(want, text, 10), 0);
    mpq_div_2exp(area, area, 1);
    assert_true(mpq_equal(area, want));
    assert_int_equal(points, size.degenerate_points);
    assert_true(slits / 2 >= size.degenerate_segments && (slits == 0) == (size.degenerate_segments == 0));
    sunder_free(text);
    mpq_clears(a[0], a[1], b[0], b[1], area, part, want, NULL);
}

static void test_map(void **state)
{
    size_t holes = 0;
    for (int k = 0; k < PAIR_KINDS; k++)
        for (size_t i = 0; i < test_count(10); i++) {
            rng r = rng_start(test_seed() + 77, i * PAIR_KINDS + (size_t)k);
            polyset p, q;
            random_pair(&p, &q, &r, (pair_kind)k);
            sunder_shape *a = polyset_shape(&p), *b = polyset_shape(&q);
            sunder_sum_options how = road_options(i * 7 + (size_t)k, i);
            how.keep_map = true;
            sunder_sum *sum;
            assert_int_equal(sunder_minkowski_sum(a, b, &how, &sum, NULL), SUNDER_OK);
            const sunder_map *m = sunder_sum_map(sum);
            assert_non_null(m);
            check_links(m);
            check_boundaries(m);
            check_covered(sum, m);
            sunder_sum_size size;
            sunder_sum_get_size(sum, &size);
            holes += size.degenerate_points + size.degenerate_segments;
            sunder_sum_free(sum);
            sunder_shape_free(a);
            sunder_shape_free(b);
            polyset_free(&p);
            polyset_free(&q);
        }
    assert_true(holes > 2 * test_count(10));
}

/* A square in a square: a map of four regions, made by hand. */
static void test_map_of_four(void **state)
{
    polyset p, q;
    polyset_init(&p);
    polyset_init(&q);
    polyset_rectangle(&p, 0, 0, 2, 2);
    polyset_rectangle(&p, 1, 1, 3, 3);
    polyset_rectangle(&q, 0, 0, 1, 1);
    sunder_shape *a = polyset_shape(&p), *b = polyset_shape(&q);
    const sunder_sum_options how = {.size = sizeof how, .keep_map = true};
    sunder_sum *sum;
    sunder_sum_method method;
    assert_int_equal(sunder_minkowski_sum(a, b, &how, &sum, NULL), SUNDER_OK);
    sunder_sum_get_method(sum, &method);
    assert_int_equal(method.algorithm, SUNDER_ALGORITHM_ARRANGEMENT); /* the algorithm that AUTO selects with a map */
    assert_int_equal(method.decomposition, SUNDER_DECOMPOSITION_ANGLE_BISECTOR);
    assert_int_equal(method.pieces_p, 2);
    assert_int_equal(method.pieces_q, 1);
    const sunder_map *m = sunder_sum_map(sum);
    /* [0, 3]^2 and [1, 4]^2: their boundaries cross twice; faces: outside, one, both, the other. */
    assert_int_equal(sunder_map_vertices(m), 10);
    assert_int_equal(sunder_map_edges(m), 12);
    assert_int_equal(sunder_map_faces(m), 4);
    size_t covered[3] = {0, 0, 0};
    for (uint32_t f = 0; f < 4; f++) covered[sunder_map_face_covered(m, f)]++;
    assert_int_equal(covered[0], 1);
    assert_int_equal(covered[1], 2);
    assert_int_equal(covered[2], 1);
    sunder_sum_free(sum);
    sunder_shape_free(a);
    sunder_shape_free(b);
    polyset_free(&p);
    polyset_free(&q);
}

/* ---- Order ---- */

typedef struct fixture {
    sunder_shape *p, *q;
    sunder_i_placed placed;
    sunder_sum_options options;
    sunder_i_uniting u;
} fixture;

static void fixture_start(fixture *f, const char *arguments, sunder_order order, sunder_i_fatness fatness)
{
    polyset p, q;
    generated_pair(&p, &q, arguments);
    f->p = polyset_shape(&p);
    f->q = polyset_shape(&q);
    polyset_free(&p);
    polyset_free(&q);
    f->options = (sunder_sum_options){.size = sizeof(sunder_sum_options), .order = order};
    const sunder_i_place_options place = {.force_wide = false};
    assert_int_equal(sunder_i_place(f->p, f->q, &place, &f->placed, NULL), SUNDER_OK);
    f->u = (sunder_i_uniting){.lattice = &f->placed.lattice, .options = &f->options, .fatness = fatness, .random = 5};
    const sunder_status status = sunder_i_decompose_pair(f->u.lattice, f->p, f->placed.p, f->q, f->placed.q,
                                                         SUNDER_DECOMPOSITION_HERTEL_MEHLHORN, &f->u.p, &f->u.q, NULL);
    assert_int_equal(status, SUNDER_OK);
    f->u.subsums = f->u.p.pieces * f->u.q.pieces;
}

static void fixture_end(fixture *f)
{
    sunder_i_decomposition_clear(&f->u.p);
    sunder_i_decomposition_clear(&f->u.q);
    sunder_i_arena_free(&f->u.arena);
    sunder_i_placed_free(&f->placed);
    sunder_shape_free(f->p);
    sunder_shape_free(f->q);
}

/* Twice the area of a subsum of lattice points. */
static double area_of(fixture *f, uint32_t k)
{
    sunder_i_convex_sum s;
    double area = 0;
    assert_true(sunder_i_make_subsum(&f->u, k, &s));
    for (uint32_t i = 0; i < s.corners; i++) {
        double c[4];
        for (uint32_t j = 0; j < 2; j++)
            sunder_i_rational_doubles(&f->u.arena, s.at[(i + j) % s.corners], 0, &c[2 * j], &c[2 * j + 1]);
        area += c[0] * c[3] - c[1] * c[2];
    }
    return area;
}

static void test_order(void **state)
{
    if (!generated_available()) skip();
    for (int o = SUNDER_ORDER_RANDOM; o <= SUNDER_ORDER_GIVEN; o++) {
        fixture f;
        fixture_start(&f, "random --size 20", (sunder_order)o, SUNDER_I_FAT_AREA);
        const uint32_t first = 3, n = f.u.subsums - first;
        uint32_t *subsum = test_alloc(n, sizeof *subsum);
        bool *there = calloc(f.u.subsums, sizeof *there);
        for (uint32_t i = 0; i < n; i++) subsum[i] = first + i;
        assert_true(sunder_i_order_subsums(&f.u, subsum, n));
        size_t moved = 0;
        for (uint32_t i = 0; i < n; i++) {
            assert_true(subsum[i] >= first && subsum[i] < f.u.subsums && !there[subsum[i]]);
            there[subsum[i]] = true;
            moved += subsum[i] != first + i;
            /* Coordinates here are small integers, so areas in doubles are exact. */
            if (o == SUNDER_ORDER_FAT && i) assert_true(area_of(&f, subsum[i - 1]) >= area_of(&f, subsum[i]));
        }
        assert_int_equal(moved > 0, o != SUNDER_ORDER_GIVEN);
        free(there);
        free(subsum);
        fixture_end(&f);
    }
}

/* Compares the measures: the union is the same, and each measure has its cost in crossings. For an operand shaped like
 * a fork, where two subsums cover everything, a measure that takes them first must be far better than a random
 * order. */
static void test_fatness(void **state)
{
    static const struct {
        const char *name;
        sunder_order order;
        sunder_i_fatness fatness;
    } ways[] = {{"random", SUNDER_ORDER_RANDOM, SUNDER_I_FAT_AREA},
                {"area", SUNDER_ORDER_FAT, SUNDER_I_FAT_AREA},
                {"breadth", SUNDER_ORDER_FAT, SUNDER_I_FAT_BREADTH},
                {"round", SUNDER_ORDER_FAT, SUNDER_I_FAT_ROUND}};
    static const char *const inputs[] = {"covered-fork --size 80", "random --size 60", "star --size 60",
                                         "fork --size 40",         "robot --size 60",  "fat-grid --size 60",
                                         "fat-cover --size 60"};
    if (!generated_available()) skip();
    for (size_t i = 0; i < sizeof inputs / sizeof *inputs; i++) {
        uint64_t crossings[4];
        size_t edges[4];
        for (size_t w = 0; w < 4; w++) {
            fixture f;
            fixture_start(&f, inputs[i], ways[w].order, ways[w].fatness);
            sunder_i_planar_map *map;
            assert_int_equal(sunder_i_unite_by_increments(&f.u, &map, NULL), SUNDER_OK);
            assert_null(sunder_i_planar_map_check(map));
            sunder_i_map_size size;
            sunder_i_planar_map_size(map, &size);
            edges[w] = size.edges;
            crossings[w] = f.u.lattice->counts.segment_intersections;
            sunder_i_planar_map_free(map);
            fixture_end(&f);
            assert_int_equal(edges[w], edges[0]);
        }
        print_message("%-24s crossings: random %llu, area %llu, breadth %llu, round %llu\n", inputs[i],
                      (unsigned long long)crossings[0], (unsigned long long)crossings[1],
                      (unsigned long long)crossings[2], (unsigned long long)crossings[3]);
        if (i == 0) assert_true(10 * crossings[1] < crossings[0]);
    }
}

/* ---- Failures ------------- */

static void test_options(void **state)
{
    polyset square;
    polyset_init(&square);
    polyset_rectangle(&square, 0, 0, 1, 1);
    sunder_shape *p = polyset_shape(&square);
    const size_t size = sizeof(sunder_sum_options);
    const sunder_sum_options wrong[] = {{.size = size, .algorithm = (sunder_algorithm)17},
                                        {.size = size, .decomposition = (sunder_decomposition)17},
                                        {.size = size, .order = (sunder_order)17},
                                        {.size = size, .algorithm = SUNDER_ALGORITHM_CONVOLUTION, .keep_map = true}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        sunder_sum *sum = NULL;
        sunder_error err;
        assert_int_equal(sunder_minkowski_sum(p, p, &wrong[i], &sum, &err), SUNDER_EARG);
        assert_int_equal(err.status, SUNDER_EARG);
        assert_null(sum);
    }
    sunder_sum *sum;
    sunder_counts counts;
    assert_int_equal(sunder_minkowski_sum(p, p, NULL, &sum, NULL), SUNDER_OK);
    assert_null(sunder_sum_map(sum));
    assert_false(sunder_sum_phase(sum, SUNDER_PHASE_UNION, &counts));
    assert_int_equal(counts.comparisons, 0);
    sunder_sum_free(sum);
    assert_string_equal(sunder_algorithm_string(SUNDER_ALGORITHM_DIVIDE), "divide");
    assert_string_equal(sunder_decomposition_string(SUNDER_DECOMPOSITION_MIXED), "mixed");
    assert_string_equal(sunder_order_string(SUNDER_ORDER_GIVEN), "given");
    assert_string_equal(sunder_order_string((sunder_order)17), "");
    sunder_shape_free(p);
    polyset_free(&square);
}

/* One operand or both are empty: an empty sum, on a map of one face. */
static void test_empty(void **state)
{
    polyset nothing, square;
    polyset_init(&nothing);
    polyset_init(&square);
    polyset_rectangle(&square, 0, 0, 1, 1);
    sunder_shape *p = polyset_shape(&nothing), *q = polyset_shape(&square);
    for (size_t i = 0; i < ROADS; i++) {
        sunder_sum_options how = road_options(i, i);
        how.keep_map = true;
        const sunder_shape *const pairs[3][2] = {{p, q}, {q, p}, {p, p}};
        for (int k = 0; k < 3; k++) {
            sunder_sum *sum;
            sunder_sum_size size;
            assert_int_equal(sunder_minkowski_sum(pairs[k][0], pairs[k][1], &how, &sum, NULL), SUNDER_OK);
            sunder_sum_get_size(sum, &size);
            assert_int_equal(size.polygons, 0);
            assert_int_equal(sunder_map_faces(sunder_sum_map(sum)), 1);
            sunder_sum_free(sum);
        }
    }
    sunder_shape_free(p);
    sunder_shape_free(q);
    polyset_free(&nothing);
    polyset_free(&square);
}

typedef struct stop {
    int calls, allowed;
    double last;
} stop;

static bool stopping(double fraction, void *user)
{
    stop *s = user;
    assert_true(fraction >= s->last && fraction <= 1);
    s->last = fraction;
    return ++s->calls <= s->allowed;
}

static void hard_pair(sunder_shape **p, sunder_shape **q)
{
    rng r = rng_start(3, 14);
    polyset a, b;
    random_pair(&a, &b, &r, PAIR_SLIDE);
    *p = polyset_shape(&a);
    *q = polyset_shape(&b);
    polyset_free(&a);
    polyset_free(&b);
}

static void test_stop(void **state)
{
    sunder_shape *p, *q;
    hard_pair(&p, &q);
    failing_begin();
    for (size_t i = 0; i < ROAD_ALGORITHMS; i++)
        for (int allowed = 0;; allowed++) {
            stop s = {0, allowed, 0};
            sunder_sum_options how = road_options(i, 1);
            how.progress = stopping;
            how.progress_user = &s;
            sunder_sum *sum = NULL;
            const sunder_status status = sunder_minkowski_sum(p, q, &how, &sum, NULL);
            sunder_sum_free(sum);
            assert_int_equal(failing_outstanding(), 0);
            if (status == SUNDER_OK) {
                assert_true(allowed > 3);
                break;
            }
            assert_int_equal(status, SUNDER_ECANCEL);
            assert_null(sum);
        }
    failing_end();
    sunder_shape_free(p);
    sunder_shape_free(q);
}

typedef struct attempt {
    const sunder_shape *p, *q;
    sunder_sum_options how;
} attempt;

static bool attempt_sum(void *context)
{
    const attempt *a = context;
    sunder_sum *sum = NULL;
    const sunder_status status = sunder_minkowski_sum(a->p, a->q, &a->how, &sum, NULL);
    assert_int_equal(status == SUNDER_OK, sum != NULL);
    sunder_sum_free(sum);
    return status == SUNDER_OK;
}

static void test_memory(void **state)
{
    sunder_shape *p, *q;
    hard_pair(&p, &q);
    for (size_t i = 0; i < ROAD_ALGORITHMS; i++) {
        attempt a = {p, q, road_options(i + ROAD_ALGORITHMS * ROAD_DECOMPOSITIONS, 1)};
        a.how.keep_map = true;
        assert_true(failing_loop(attempt_sum, &a, false));
    }
    sunder_shape_free(p);
    sunder_shape_free(q);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_map),     cmocka_unit_test(test_map_of_four),
                                       cmocka_unit_test(test_order),   cmocka_unit_test(test_fatness),
                                       cmocka_unit_test(test_options), cmocka_unit_test(test_empty),
                                       cmocka_unit_test(test_stop),    cmocka_unit_test(test_memory)};
    return cmocka_run_group_tests_name("unions", tests, NULL, NULL);
}
