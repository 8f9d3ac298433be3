/* Convex decompositions of shapes small enough to know the result; sums of convex pieces compared with hulls of all
 * sums of corners; memory that runs out. Properties on random input are tested in property/test_decomposition.c. */
#include "convex/convex_sum.h"
#include "decomposition/maker.h"
#include "failing.h"
#include "generate.h"
#include "gmp_numbers.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static sunder_shape *shape_of(const char *wkt)
{
    sunder_shape *shape = polyset_shape_of_wkt(wkt);
    assert_non_null(shape);
    return shape;
}

typedef struct outcome {
    uint32_t pieces, steiner, fallbacks;
    sunder_decomposition used;
} outcome;

static outcome decompose(const char *wkt, sunder_decomposition kind, bool wide)
{
    sunder_shape *shape = shape_of(wkt);
    sunder_i_placed placed;
    const sunder_i_place_options options = {.force_wide = wide};
    assert_int_equal(sunder_i_place(shape, NULL, &options, &placed, NULL), SUNDER_OK);
    sunder_i_decomposition d;
    assert_int_equal(sunder_i_decompose(&placed.lattice, shape, placed.p, kind, &d, NULL), SUNDER_OK);
    const char *wrong = sunder_i_decomposition_check(&placed.lattice, shape, placed.p, &d);
    if (wrong) fail_msg("%s, %s: %s", wkt, sunder_decomposition_string(kind), wrong);
    const outcome result = {d.pieces, d.corners - shape->vertices, d.fallbacks, d.used};
    sunder_i_decomposition_clear(&d);
    sunder_i_placed_free(&placed);
    sunder_shape_free(shape);
    return result;
}

static void expect(const char *wkt, sunder_decomposition kind, uint32_t pieces, uint32_t steiner)
{
    for (int wide = 0; wide < 2; wide++) {
        const outcome got = decompose(wkt, kind, wide);
        if (got.pieces != pieces || got.steiner != steiner)
            fail_msg("%s, %s: %u pieces, %u Steiner points; not %u, %u", wkt, sunder_decomposition_string(kind),
                     got.pieces, got.steiner, pieces, steiner);
        assert_int_equal(got.used, kind);
        assert_int_equal(got.fallbacks, 0);
    }
}

#define L_SHAPE "POLYGON((0 0,4 0,4 2,2 2,2 4,0 4,0 0))"
/* A plus sign: each reflex vertex sees two others along an axis. */
#define PLUS "POLYGON((1 0,2 0,2 1,3 1,3 2,2 2,2 3,1 3,1 2,0 2,0 1,1 1,1 0))"
#define FRAME "POLYGON((0 0,6 0,6 6,0 6,0 0),(2 2,2 4,4 4,4 2,2 2))"
/* Two teeth upwards, whose reflex vertices are at the same height. */
#define TEETH "POLYGON((0 0,7 0,7 5,6 5,6 1,1 1,1 5,0 5,0 0))"

static void test_convex(void **state)
{
    static const char square[] = "POLYGON((0 0,1 0,1 1,0 1,0 0))";
    expect(square, SUNDER_DECOMPOSITION_HERTEL_MEHLHORN, 1, 0);
    expect(square, SUNDER_DECOMPOSITION_TRIANGULATION, 2, 0);
    expect(square, SUNDER_DECOMPOSITION_ANGLE_BISECTOR, 1, 0);
    expect(square, SUNDER_DECOMPOSITION_VERTICAL, 1, 0);
    expect(square, SUNDER_DECOMPOSITION_OPTIMAL, 1, 0);
}

static void test_one_reflex(void **state)
{
    expect(L_SHAPE, SUNDER_DECOMPOSITION_TRIANGULATION, 4, 0);
    expect(L_SHAPE, SUNDER_DECOMPOSITION_HERTEL_MEHLHORN, 2, 0);
    expect(L_SHAPE, SUNDER_DECOMPOSITION_ANGLE_BISECTOR, 2, 0); /* a cut to the vertex in the cone */
    expect(L_SHAPE, SUNDER_DECOMPOSITION_VERTICAL, 2, 1);
    expect(L_SHAPE, SUNDER_DECOMPOSITION_OPTIMAL, 2, 0);
}

static void test_pairs_of_reflex(void **state)
{
    expect(PLUS, SUNDER_DECOMPOSITION_ANGLE_BISECTOR, 3, 0);
    expect(PLUS, SUNDER_DECOMPOSITION_OPTIMAL, 3, 0);
    expect(PLUS, SUNDER_DECOMPOSITION_VERTICAL, 3, 0);        /* a vertical cut through two vertices is made once */
    expect(TEETH, SUNDER_DECOMPOSITION_ANGLE_BISECTOR, 3, 0); /* cuts to the corners of the base */
    expect(TEETH, SUNDER_DECOMPOSITION_VERTICAL, 3, 2);
}

static void test_hole(void **state)
{
    expect(FRAME, SUNDER_DECOMPOSITION_TRIANGULATION, 8, 0);
    expect(FRAME, SUNDER_DECOMPOSITION_ANGLE_BISECTOR, 4, 0);
    expect(FRAME, SUNDER_DECOMPOSITION_VERTICAL, 4, 4);
    const outcome got = decompose(FRAME, SUNDER_DECOMPOSITION_OPTIMAL, false);
    assert_int_equal(got.used, SUNDER_DECOMPOSITION_HERTEL_MEHLHORN);
    assert_int_equal(got.fallbacks, 1);
}

/* The cone contains no vertex, only the inside of an edge: a cut to a Steiner point there saves a piece. A spike
 * upwards into a long roof. */
static void test_steiner(void **state)
{
    expect("POLYGON((-9 0,-1 0,0 5,1 0,9 0,20 9,-20 9,-9 0))", SUNDER_DECOMPOSITION_ANGLE_BISECTOR, 2, 1);
    expect("POLYGON((-9 0,-1 0,0 5,1 0,9 0,20 9,-20 9,-9 0))", SUNDER_DECOMPOSITION_VERTICAL, 2, 1);
    expect("POLYGON((-9 0,-1 0,0 5,1 0,9 0,20 9,-20 9,-9 0))", SUNDER_DECOMPOSITION_OPTIMAL, 3, 0);
}

/* Cuts from three spikes in a room. The cut from the spike below runs straight up to the roof; those from the left and
 * from the upper right end at the same point of it, from both sides. */
static void test_cuts_meet_on_a_cut(void **state)
{
    static const char wkt[] =
        "POLYGON((-20 -20,-1 -20,0 -10,1 -20,20 -20,20 20,15.5 20,10 15,14.5 20,-20 20,-20 6,-10 5,"
        "-20 4,-20 -20))";
    expect(wkt, SUNDER_DECOMPOSITION_ANGLE_BISECTOR, 4, 2);
}

/* Two cuts that end at one place of the roof, (0, 20). */
static void test_cuts_meet_on_an_edge(void **state)
{
    static const char wkt[] =
        "POLYGON((-20 -20,-1 -20,0 -10,1 -20,20 -20,20 20,-20 20,-20 0.5,-10 10,-20 -0.5,-20 -20))";
    expect(wkt, SUNDER_DECOMPOSITION_ANGLE_BISECTOR, 3, 1);
}

/* A vertex that lies on the line between two others: the optimal decomposition uses both halves of that line, and the
 * piece above has a straight corner there. Notches from the left, from the right and from below, with their tips at the
 * same height. */
static void test_straight_corner(void **state)
{
    static const char wkt[] = "POLYGON((0 0,5 0,6 3,7 0,12 0,12 2,10 3,12 4,12 6,0 6,0 4,2 3,0 2,0 0))";
    expect(wkt, SUNDER_DECOMPOSITION_OPTIMAL, 3, 0);
    const outcome merged = decompose(wkt, SUNDER_DECOMPOSITION_HERTEL_MEHLHORN, false);
    assert_true(merged.pieces > 3);
}

/* A cone that contains no point with small integer coordinates: a slit as thin as doubles allow. The cut is the
 * extension of an edge. */
static void test_thin_cone(void **state)
{
    static const char wkt[] = "POLYGON((-1073741824 0,-4 0,1073741824 1,-3 0,1073741827 0,2147483648 1000,2147483648 "
                              "1073741824,-1073741824 1073741824,-1073741824 0))";
    for (int wide = 0; wide < 2; wide++) {
        const outcome got = decompose(wkt, SUNDER_DECOMPOSITION_ANGLE_BISECTOR, wide);
        assert_true(got.pieces >= 2);
    }
}

static void test_members_and_empty(void **state)
{
    static const char wkt[] = "MULTIPOLYGON(((0 0,4 0,4 2,2 2,2 4,0 4,0 0)),((1 1,9 1,9 9,1 9,1 1)),((20 0,26 0,26 "
                              "6,20 6,20 0),(22 2,22 4,24 4,24 2,22 2)))";
    const outcome got = decompose(wkt, SUNDER_DECOMPOSITION_ANGLE_BISECTOR, false);
    assert_int_equal(got.pieces, 2 + 1 + 4);
    sunder_shape *none = NULL;
    const size_t zero = 0;
    const double xy = 0;
    assert_int_equal(sunder_shape_from_rings(&xy, &zero, &zero, 0, SUNDER_VALIDITY_STRICT, &none, NULL), SUNDER_OK);
    sunder_shape *l = shape_of(L_SHAPE);
    for (int kind = SUNDER_DECOMPOSITION_ANGLE_BISECTOR; kind <= SUNDER_DECOMPOSITION_MIXED; kind++) {
        sunder_i_placed placed;
        sunder_i_decomposition p, q;
        assert_int_equal(sunder_i_place(none, l, NULL, &placed, NULL), SUNDER_OK);
        assert_int_equal(sunder_i_decompose_pair(&placed.lattice, none, placed.p, l, placed.q,
                                                 (sunder_decomposition)kind, &p, &q, NULL),
                         SUNDER_OK);
        assert_int_equal(p.pieces, 0);
        assert_true(q.pieces >= 2);
        sunder_i_decomposition_clear(&p);
        sunder_i_decomposition_clear(&q);
        sunder_i_placed_free(&placed);
    }
    sunder_shape_free(none);
    sunder_shape_free(l);
}

/* ---- The mixed objective ---- */

static double perimeters(sunder_i_lattice *l, const sunder_i_decomposition *d)
{
    double sum = 0;
    for (uint32_t i = 0; i < d->pieces; i++) {
        const uint32_t first = sunder_i_piece_first(d, i), end = d->piece_end[i];
        for (uint32_t k = first; k < end; k++) {
            const sunder_i_corner *a = &d->corner[d->piece_corner[k]];
            const sunder_i_corner *b = &d->corner[d->piece_corner[k + 1 < end ? k + 1 : first]];
            sum += hypot(sunder_i_big_ratio(&l->arena, a->at.x, a->at.w, 0) -
                             sunder_i_big_ratio(&l->arena, b->at.x, b->at.w, 0),
                         sunder_i_big_ratio(&l->arena, a->at.y, a->at.w, 0) -
                             sunder_i_big_ratio(&l->arena, b->at.y, b->at.w, 0));
        }
    }
    return sum;
}

/* The total length of the boundaries of all subsums, computed from the pieces themselves. */
static double objective(const sunder_shape *p, const sunder_shape *q, sunder_decomposition kind)
{
    sunder_i_placed placed;
    sunder_i_decomposition a, b;
    assert_int_equal(sunder_i_place(p, q, NULL, &placed, NULL), SUNDER_OK);
    assert_int_equal(sunder_i_decompose_pair(&placed.lattice, p, placed.p, q, placed.q, kind, &a, &b, NULL), SUNDER_OK);
    const double c = b.pieces * perimeters(&placed.lattice, &a) + a.pieces * perimeters(&placed.lattice, &b);
    sunder_i_decomposition_clear(&a);
    sunder_i_decomposition_clear(&b);
    sunder_i_placed_free(&placed);
    return c;
}

static void test_mixed(void **state)
{
    size_t better = 0;
    for (size_t i = 0; i < test_count(200); i++) {
        rng r = rng_start(test_seed() * 53, i);
        polyset set[2];
        for (int k = 0; k < 2; k++) {
            polyset_init(&set[k]);
            if (i % 2)
                random_star(&set[k], &r, (int)rng_int(&r, 6, 30), 1000);
            else
                random_simple(&set[k], &r, (int)rng_int(&r, 5, 8), 50);
        }
        sunder_shape *p = polyset_shape(&set[0]), *q = polyset_shape(&set[1]);
        const double mixed = objective(p, q, SUNDER_DECOMPOSITION_MIXED),
                     optimal = objective(p, q, SUNDER_DECOMPOSITION_OPTIMAL);
        /* The sums of doubles are added in different orders: 1e-9 of the sum is far more than the rounding error. */
        assert_true(mixed <= optimal * (1 + 1e-9));
        better += mixed < optimal * (1 - 1e-9);
        sunder_shape_free(p);
        sunder_shape_free(q);
        polyset_free(&set[0]);
        polyset_free(&set[1]);
    }
    assert_true(better > 5);
}

/* ---- Directions ---- */

static void test_direction(void **state)
{
    sunder_i_lattice l;
    double origin[1][2];
    const sunder_i_extent extent = {.any = true, .low = {-1, -1}, .high = {1, 1}, .low_bit = -50};
    sunder_i_lattice_init(&l, &extent, 1, false, origin, false);
    assert_true(l.narrow);
    size_t on_edge = 0;
    for (size_t i = 0; i < test_count(5000); i++) {
        rng r = rng_start(test_seed() * 59, i);
        const int64_t span = (int64_t)1 << rng_int(&r, 1, 49);
        sunder_i_point a, b;
        do {
            a = (sunder_i_point){rng_int(&r, -span, span), rng_int(&r, -span, span)};
            b = (sunder_i_point){rng_int(&r, -span, span), rng_int(&r, -span, span)};
            if (i % 3 == 0) b = (sunder_i_point){a.x + rng_int(&r, -2, 2), a.y + rng_int(&r, -2, 2)};
        } while (sunder_i_cross_sign(&l, a, b) <= 0);
        const sunder_i_point d = sunder_i_direction_within(&l, a, b);
        const bool is_a = d.x == a.x && d.y == a.y;
        on_edge += is_a;
        assert_true(is_a || (sunder_i_cross_sign(&l, a, d) > 0 && sunder_i_cross_sign(&l, d, b) > 0));
        assert_true(is_a || (llabs(d.x) <= 1 << 20 && llabs(d.y) <= 1 << 20));
    }
    assert_true(on_edge > 0 && on_edge < test_count(5000) / 2);
    sunder_i_lattice_free(&l);
}

/* ---- Sums of convex pieces ---- */

typedef struct qpoint {
    mpq_t x, y;
} qpoint;

static void load(qpoint *p, sunder_i_big x, sunder_i_big y, sunder_i_big w)
{
    mpq_inits(p->x, p->y, NULL);
    mpz_from_big(mpq_numref(p->x), x);
    mpz_from_big(mpq_denref(p->x), w);
    mpz_from_big(mpq_numref(p->y), y);
    mpz_from_big(mpq_denref(p->y), w);
    mpq_canonicalize(p->x);
    mpq_canonicalize(p->y);
}

static int side(const qpoint *a, const qpoint *b, const qpoint *c)
{
    mpq_t u, v, w;
    mpq_inits(u, v, w, NULL);
    mpq_sub(u, b->x, a->x);
    mpq_sub(v, c->y, a->y);
    mpq_mul(u, u, v);
    mpq_sub(v, b->y, a->y);
    mpq_sub(w, c->x, a->x);
    mpq_mul(v, v, w);
    const int s = mpq_cmp(u, v);
    mpq_clears(u, v, w, NULL);
    return s;
}

/* The corners of the sum turn left and are sums of corners, and all sums of corners are on the left of its sides: so it
 * is their hull. */
static void check_sum(const sunder_i_decomposition *p, uint32_t i, const sunder_i_decomposition *q, uint32_t j,
                      const sunder_i_convex_sum *s)
{
    const uint32_t pf = sunder_i_piece_first(p, i), pe = p->piece_end[i];
    const uint32_t qf = sunder_i_piece_first(q, j), qe = q->piece_end[j];
    assert_in_range(s->corners, 3, pe - pf + qe - qf);
    qpoint *c = test_alloc(s->corners, sizeof *c);
    for (uint32_t k = 0; k < s->corners; k++) load(&c[k], s->at[k].x, s->at[k].y, s->at[k].w);
    for (uint32_t k = 0; k < s->corners; k++)
        assert_true(side(&c[k], &c[(k + 1) % s->corners], &c[(k + 2) % s->corners]) > 0);
    for (uint32_t a = pf; a < pe; a++)
        for (uint32_t b = qf; b < qe; b++) {
            const sunder_i_corner *u = &p->corner[p->piece_corner[a]], *v = &q->corner[q->piece_corner[b]];
            qpoint x, y;
            load(&x, u->at.x, u->at.y, u->at.w);
            load(&y, v->at.x, v->at.y, v->at.w);
            mpq_add(x.x, x.x, y.x);
            mpq_add(x.y, x.y, y.y);
            for (uint32_t k = 0; k < s->corners; k++) {
                assert_true(side(&c[k], &c[(k + 1) % s->corners], &x) >= 0);
                if (p->piece_corner[a] == s->of_p[k] && q->piece_corner[b] == s->of_q[k])
                    assert_true(mpq_equal(x.x, c[k].x) && mpq_equal(x.y, c[k].y));
            }
            mpq_clears(x.x, x.y, y.x, y.y, NULL);
        }
    for (uint32_t k = 0; k < s->corners; k++) mpq_clears(c[k].x, c[k].y, NULL);
    free(c);
}

static void test_convex_sum(void **state)
{
    for (int kind = 0; kind < PAIR_KINDS; kind++)
        for (size_t i = 0; i < test_count(4); i++) {
            rng r = rng_start(test_seed() * 61 + (uint64_t)kind, i);
            polyset set[2];
            random_pair(&set[0], &set[1], &r, (pair_kind)kind);
            sunder_shape *p = polyset_shape(&set[0]), *q = polyset_shape(&set[1]);
            sunder_i_placed placed;
            sunder_i_decomposition a, b;
            const sunder_i_place_options options = {.force_wide = i % 2, .reflect_q = i % 3 == 0};
            assert_int_equal(sunder_i_place(p, q, &options, &placed, NULL), SUNDER_OK);
            assert_int_equal(sunder_i_decompose_pair(&placed.lattice, p, placed.p, q, placed.q,
                                                     (sunder_decomposition)(1 + i % 6), &a, &b, NULL),
                             SUNDER_OK);
            sunder_i_arena arena;
            sunder_i_arena_init(&arena);
            for (uint32_t k = 0; k < 20 && a.pieces && b.pieces; k++) {
                const uint32_t u = (uint32_t)(rng_next(&r) % a.pieces), v = (uint32_t)(rng_next(&r) % b.pieces);
                sunder_i_convex_sum s;
                assert_true(sunder_i_convex_sum_of(&placed.lattice, &a, u, &b, v, &arena, &s));
                check_sum(&a, u, &b, v, &s);
            }
            sunder_i_arena_free(&arena);
            sunder_i_decomposition_clear(&a);
            sunder_i_decomposition_clear(&b);
            sunder_i_placed_free(&placed);
            sunder_shape_free(p);
            sunder_shape_free(q);
            polyset_free(&set[0]);
            polyset_free(&set[1]);
        }
}

/* Two squares with parallel sides: the sum has four sides, each made of one side of both. */
static void test_parallel_sides(void **state)
{
    sunder_shape *p = shape_of("POLYGON((0 0,2 0,2 2,0 2,0 0))"), *q = shape_of("POLYGON((0 0,1 0,1 3,0 3,0 0))");
    sunder_i_placed placed;
    sunder_i_decomposition a, b;
    sunder_i_convex_sum s;
    sunder_i_arena arena;
    sunder_i_arena_init(&arena);
    assert_int_equal(sunder_i_place(p, q, NULL, &placed, NULL), SUNDER_OK);
    assert_int_equal(sunder_i_decompose_pair(&placed.lattice, p, placed.p, q, placed.q,
                                             SUNDER_DECOMPOSITION_HERTEL_MEHLHORN, &a, &b, NULL),
                     SUNDER_OK);
    assert_true(sunder_i_convex_sum_of(&placed.lattice, &a, 0, &b, 0, &arena, &s));
    assert_int_equal(s.corners, 4);
    for (uint32_t k = 0; k < 4; k++) assert_true(s.side_p[k] && s.side_q[k]);
    check_sum(&a, 0, &b, 0, &s);
    sunder_i_arena_free(&arena);
    sunder_i_decomposition_clear(&a);
    sunder_i_decomposition_clear(&b);
    sunder_i_placed_free(&placed);
    sunder_shape_free(p);
    sunder_shape_free(q);
}

/* ---- Memory ---- */

typedef struct attempt {
    const sunder_shape *p, *q;
    sunder_decomposition kind;
    bool wide;
} attempt;

static bool try_once(void *context)
{
    const attempt *t = context;
    sunder_i_placed placed;
    const sunder_i_place_options options = {.force_wide = t->wide};
    if (sunder_i_place(t->p, t->q, &options, &placed, NULL)) return false;
    sunder_i_decomposition a, b;
    const sunder_status status =
        sunder_i_decompose_pair(&placed.lattice, t->p, placed.p, t->q, placed.q, t->kind, &a, &b, NULL);
    if (status == SUNDER_OK) {
        sunder_i_decomposition_clear(&a);
        sunder_i_decomposition_clear(&b);
    }
    sunder_i_placed_free(&placed);
    return status == SUNDER_OK;
}

static void test_memory(void **state)
{
    failing_begin();
    sunder_shape *p = shape_of(FRAME);
    sunder_shape *q = shape_of("POLYGON((0 0,40 0,40 30,35 7,30 31,26 5,22 29,17 6,11 30,9 8,5 31,0 30,0 0))");
    for (int kind = SUNDER_DECOMPOSITION_ANGLE_BISECTOR; kind <= SUNDER_DECOMPOSITION_MIXED; kind++)
        for (int wide = 0; wide < 2; wide++) {
            attempt t = {p, q, (sunder_decomposition)kind, wide};
            assert_true(failing_loop(try_once, &t, false));
        }
    sunder_shape_free(p);
    sunder_shape_free(q);
    assert_int_equal(failing_outstanding(), 0);
    failing_end();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_convex),
        cmocka_unit_test(test_one_reflex),
        cmocka_unit_test(test_pairs_of_reflex),
        cmocka_unit_test(test_hole),
        cmocka_unit_test(test_steiner),
        cmocka_unit_test(test_straight_corner),
        cmocka_unit_test(test_cuts_meet_on_a_cut),
        cmocka_unit_test(test_cuts_meet_on_an_edge),
        cmocka_unit_test(test_thin_cone),
        cmocka_unit_test(test_members_and_empty),
        cmocka_unit_test(test_mixed),
        cmocka_unit_test(test_direction),
        cmocka_unit_test(test_convex_sum),
        cmocka_unit_test(test_parallel_sides),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests_name("decomposition", tests, NULL, NULL);
}
