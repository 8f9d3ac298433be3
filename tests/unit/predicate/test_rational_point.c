/* predicate/ beyond narrow lattices: the same random questions about lattice points and crossings of lattice segments,
 * with the filters and without (all numbers pooled), and in GMP's rationals. */
#include "failing.h"
#include "gmp_numbers.h"
#include "predicate/predicate.h"
#include "predicate/rational_point.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define ROUNDS 1500
#define SPOTS 4

/* A point on both lattices, and its exact coordinates. */
typedef struct spot {
    mpq_t x, y;
    sunder_i_point at[2];
} spot;

typedef struct bench {
    sunder_i_lattice l[2];
    rng g;
    spot s[SPOTS];
    mpq_t t, u, v;
} bench;

static void open_bench(bench *b, uint64_t i)
{
    const double corner[] = {-0x1p57, -0x1p57, 1, 3};
    for (int k = 0; k < 2; k++) {
        double origin[1][2];
        sunder_i_extent e = {0};
        sunder_i_extent_add(&e, corner, 2);
        sunder_i_lattice_init(&b->l[k], &e, 1, false, origin, k);
        sunder_i_lattice_admit_ratios(&b->l[k]);
        assert_false(b->l[k].narrow);
    }
    b->g = rng_start(test_seed(), i);
    for (int i2 = 0; i2 < SPOTS; i2++) mpq_inits(b->s[i2].x, b->s[i2].y, NULL);
    mpq_inits(b->t, b->u, b->v, NULL);
}

static void close_bench(bench *b)
{
    for (int k = 0; k < 2; k++) {
        assert_false(b->l[k].arena.failed);
        sunder_i_lattice_free(&b->l[k]);
    }
    for (int i = 0; i < SPOTS; i++) mpq_clears(b->s[i].x, b->s[i].y, NULL);
    mpq_clears(b->t, b->u, b->v, NULL);
}

static int64_t coordinate(rng *g, int kind)
{
    static const int64_t big = ((int64_t)1 << 57) - 1;
    if (kind == 0) return rng_int(g, -2, 2);
    if (kind == 1) return rng_int(g, -1000, 1000);
    return kind == 2 ? rng_int(g, -big, big) : big - rng_int(g, 0, 3);
}

/* Puts the exact coordinates onto both lattices. */
static void put(bench *b, spot *s)
{
    for (int k = 0; k < 2; k++) {
        sunder_i_arena *m = &b->l[k].arena;
        const sunder_i_big xd = big_from_mpz(m, mpq_denref(s->x)), yd = big_from_mpz(m, mpq_denref(s->y));
        const sunder_i_rational_point v = {sunder_i_times(m, big_from_mpz(m, mpq_numref(s->x)), yd),
                                           sunder_i_times(m, big_from_mpz(m, mpq_numref(s->y)), xd),
                                           sunder_i_times(m, xd, yd)};
        s->at[k] = sunder_i_rational_put(&b->l[k], v);
    }
}

/* r = (b - a) x (d - c), or their dot product. */
static void product(mpq_t r, const spot *a, const spot *b, const spot *c, const spot *d, bool dot)
{
    mpq_t p, q;
    mpq_inits(p, q, NULL);
    mpq_sub(r, b->x, a->x);
    mpq_sub(p, dot ? d->x : d->y, dot ? c->x : c->y);
    mpq_mul(r, r, p);
    mpq_sub(p, b->y, a->y);
    mpq_sub(q, dot ? d->y : d->x, dot ? c->y : c->x);
    mpq_mul(p, p, q);
    if (dot)
        mpq_add(r, r, p);
    else
        mpq_sub(r, r, p);
    mpq_clears(p, q, NULL);
}

/* Sets s to a + t (b - a). */
static void between(spot *s, const spot *a, const spot *b, const mpq_t t)
{
    mpq_t p;
    mpq_init(p);
    mpq_sub(p, b->x, a->x);
    mpq_mul(p, p, t);
    mpq_add(p, p, a->x);
    mpq_t q;
    mpq_init(q);
    mpq_sub(q, b->y, a->y);
    mpq_mul(q, q, t);
    mpq_add(q, q, a->y);
    mpq_set(s->x, p);
    mpq_set(s->y, q);
    mpq_clears(p, q, NULL);
}

/* Draws a lattice point, the crossing of two lattice segments, or a point of a line through two others. */
static void random_spot(bench *b, int i, int kind)
{
    spot *s = &b->s[i], c[4];
    mpq_set_si(s->x, coordinate(&b->g, kind), 1);
    mpq_set_si(s->y, coordinate(&b->g, kind), 1);
    const int how = (int)rng_int(&b->g, 0, 3);
    if (how == 1) {
        for (int k = 0; k < 4; k++) {
            mpq_inits(c[k].x, c[k].y, NULL);
            mpq_set_si(c[k].x, coordinate(&b->g, kind), 1);
            mpq_set_si(c[k].y, coordinate(&b->g, kind), 1);
        }
        product(b->t, &c[0], &c[2], &c[2], &c[3], false);
        product(b->u, &c[0], &c[1], &c[2], &c[3], false);
        if (mpq_sgn(b->u) != 0) {
            mpq_div(b->t, b->t, b->u);
            /* Only inside the first segment, so that it stays within the lattice. */
            if (mpq_sgn(b->t) >= 0 && mpq_cmp_si(b->t, 1, 1) <= 0) between(s, &c[0], &c[1], b->t);
        }
        for (int k = 0; k < 4; k++) mpq_clears(c[k].x, c[k].y, NULL);
    } else if (how == 2 && i >= 2) {
        mpq_set_si(b->t, rng_int(&b->g, 0, 7), 7);
        mpq_canonicalize(b->t);
        between(s, &b->s[i - 2], &b->s[i - 1], b->t);
    } else if (how == 3 && i >= 1) {
        mpq_set(s->x, b->s[i - 1].x);
        if (rng_once_in(&b->g, 2)) mpq_set(s->y, b->s[i - 1].y);
    }
    put(b, s);
}

static void random_spots(bench *b, int round)
{
    for (int i = 0; i < SPOTS; i++) random_spot(b, i, round % 4);
}

static int sign(int v) { return (v > 0) - (v < 0); }

static int lexicographic(const spot *a, const spot *b)
{
    const int c = sign(mpq_cmp(a->x, b->x));
    return c ? c : sign(mpq_cmp(a->y, b->y));
}

static void expect_ratio(const sunder_i_lattice *l, int64_t n, const mpq_t want)
{
    sunder_i_arena arena = {0};
    mpq_t got;
    mpq_init(got);
    const sunder_i_ratio r = sunder_i_lattice_read(&arena, l, n);
    mpz_from_big(mpq_numref(got), r.num);
    mpz_from_big(mpq_denref(got), r.den);
    assert_true(mpz_sgn(mpq_denref(got)) > 0);
    mpq_canonicalize(got);
    assert_true(mpq_equal(got, want));
    const double v = mpq_get_d(want);
    assert_true(fabs(sunder_i_approx(l, n) - v) <= 0x1p-52 * fabs(v));
    mpq_clear(got);
    sunder_i_arena_free(&arena);
}

static void test_points(void **state)
{
    (void)state;
    bench b;
    open_bench(&b, 31);
    for (int i = 0; i < ROUNDS; i++) {
        random_spots(&b, i);
        const spot *p = &b.s[0], *q = &b.s[1], *r = &b.s[2], *s = &b.s[3];
        for (int k = 0; k < 2; k++) {
            sunder_i_lattice *l = &b.l[k];
            expect_ratio(l, p->at[k].x, p->x);
            expect_ratio(l, p->at[k].y, p->y);
            assert_int_equal(sunder_i_point_cmp(l, p->at[k], q->at[k]), lexicographic(p, q));
            assert_int_equal(sunder_i_point_equal(l, p->at[k], q->at[k]), lexicographic(p, q) == 0);
            const sunder_i_point u = sunder_i_point_sub(l, q->at[k], p->at[k]),
                                 v = sunder_i_point_sub(l, s->at[k], r->at[k]);
            mpq_sub(b.t, q->x, p->x);
            expect_ratio(l, u.x, b.t);
            assert_true(sunder_i_point_equal(l, sunder_i_point_add(l, u, p->at[k]), q->at[k]));
            mpq_neg(b.t, b.t);
            expect_ratio(l, sunder_i_point_neg(l, u).x, b.t);
            product(b.t, p, q, p, r, false);
            assert_int_equal(sunder_i_orient(l, p->at[k], q->at[k], r->at[k]), mpq_sgn(b.t));
            product(b.t, p, q, r, s, false);
            assert_int_equal(sunder_i_cross_sign(l, u, v), mpq_sgn(b.t));
            if (lexicographic(p, q) && lexicographic(r, s)) {
                const int hu = sunder_i_direction_half(l, u), hv = sunder_i_direction_half(l, v);
                assert_int_equal(sunder_i_angle_cmp(l, u, v), hu != hv ? hu - hv : -mpq_sgn(b.t));
            }
            product(b.t, p, q, r, s, true);
            assert_int_equal(sunder_i_dot_sign(l, u, v), mpq_sgn(b.t));
            double dx, dy;
            sunder_i_point_difference(l, q->at[k], p->at[k], &dx, &dy);
            mpq_sub(b.t, q->y, p->y);
            assert_true(fabs(dy - mpq_get_d(b.t)) <= 0x1p-52 * fabs(dy));
        }
    }
    close_bench(&b);
}

/* Checks the functions on the crossing of pq and rs. */
static void check_crossing(bench *b, int k, const spot *truth, const mpq_t t)
{
    sunder_i_lattice *l = &b->l[k];
    const sunder_i_point p = b->s[0].at[k], q = b->s[1].at[k], r = b->s[2].at[k], s = b->s[3].at[k];
    const sunder_i_fraction f = sunder_i_crossing(l, p, q, r, s), g = sunder_i_crossing(l, r, s, p, q);
    mpq_t got;
    mpq_init(got);
    const sunder_i_ratio v = sunder_i_fraction_read(&l->arena, l, &f);
    mpz_from_big(mpq_numref(got), v.num);
    mpz_from_big(mpq_denref(got), v.den);
    assert_true(mpz_sgn(mpq_denref(got)) > 0);
    mpq_canonicalize(got);
    assert_true(mpq_equal(got, t));
    assert_int_equal(sunder_i_fraction_sign(l, &f), mpq_sgn(t));
    const sunder_i_fraction one = sunder_i_fraction_int(l, 1);
    assert_int_equal(sunder_i_fraction_cmp(l, &f, &one), sign(mpq_cmp_si(t, 1, 1)));
    const sunder_i_hpoint h = sunder_i_hpoint_at(l, p, q, &f), i = sunder_i_hpoint_at(l, r, s, &g);
    assert_true(sunder_i_hpoint_equal(l, &h, &i));
    assert_true(sunder_i_hpoint_hash(l, &h) == sunder_i_hpoint_hash(l, &i));
    assert_int_equal(sunder_i_orient_hpoint(l, r, s, &h), 0);
    assert_int_equal(sunder_i_orient_hpoint(l, p, q, &h), 0);
    for (int n = 0; n < SPOTS; n++) {
        const sunder_i_hpoint own = sunder_i_hpoint_of(l, b->s[n].at[k]);
        assert_int_equal(sunder_i_hpoint_cmp(l, &h, &own), lexicographic(truth, &b->s[n]));
        assert_int_equal(sunder_i_hpoint_cmp_x(l, &h, &own), sign(mpq_cmp(truth->x, b->s[n].x)));
        assert_int_equal(sunder_i_hpoint_cmp_y(l, &own, &h), -sign(mpq_cmp(truth->y, b->s[n].y)));
    }
    mpq_clear(got);
}

static void test_crossings(void **state)
{
    (void)state;
    bench b;
    open_bench(&b, 32);
    int met = 0;
    spot x;
    mpq_t t;
    mpq_inits(x.x, x.y, t, NULL);
    for (int i = 0; i < ROUNDS; i++) {
        random_spots(&b, i);
        product(t, &b.s[0], &b.s[2], &b.s[2], &b.s[3], false);
        product(b.u, &b.s[0], &b.s[1], &b.s[2], &b.s[3], false);
        if (mpq_sgn(b.u) == 0) continue;
        met++;
        mpq_div(t, t, b.u);
        between(&x, &b.s[0], &b.s[1], t);
        for (int k = 0; k < 2; k++) check_crossing(&b, k, &x, t);
    }
    assert_true(met > ROUNDS / 4);
    mpq_clears(x.x, x.y, t, NULL);
    close_bench(&b);
}

/* Squared distance of s[0] from the segment s[1] s[2]. */
static void squared_distance(bench *b, mpq_t r)
{
    spot foot;
    mpq_inits(foot.x, foot.y, NULL);
    product(b->t, &b->s[1], &b->s[0], &b->s[1], &b->s[2], true);
    product(b->u, &b->s[1], &b->s[2], &b->s[1], &b->s[2], true);
    if (mpq_sgn(b->u) == 0)
        mpq_set_si(b->t, 0, 1);
    else
        mpq_div(b->t, b->t, b->u);
    if (mpq_sgn(b->t) < 0) mpq_set_si(b->t, 0, 1);
    if (mpq_cmp_si(b->t, 1, 1) > 0) mpq_set_si(b->t, 1, 1);
    between(&foot, &b->s[1], &b->s[2], b->t);
    product(r, &b->s[0], &foot, &b->s[0], &foot, true);
    mpq_clears(foot.x, foot.y, NULL);
}

static void test_distances(void **state)
{
    (void)state;
    bench b;
    mpq_t square;
    open_bench(&b, 33);
    mpq_init(square);
    for (int i = 0; i < ROUNDS; i++) {
        random_spots(&b, i % 2);
        squared_distance(&b, square);
        const int64_t gap = rng_int(&b.g, 0, i % 2 ? 1000 : 3);
        mpq_set_si(b.v, gap * gap, 1);
        for (int k = 0; k < 2; k++) {
            const sunder_i_point p = b.s[0].at[k], a = b.s[1].at[k], c = b.s[2].at[k];
            const int64_t g = sunder_i_lattice_big(&b.l[k], sunder_i_big_i64(&b.l[k].arena, gap));
            assert_int_equal(sunder_i_segment_distance_cmp(&b.l[k], p, p, a, c, g), sign(mpq_cmp(square, b.v)));
            const sunder_i_meeting m = sunder_i_segments_meet(&b.l[k], p, p, a, c);
            assert_int_equal(m == SUNDER_I_APART, mpq_sgn(square) > 0);
        }
    }
    mpq_clear(square);
    close_bench(&b);
}

static bool run(void *context)
{
    (void)context;
    sunder_i_lattice l;
    double origin[1][2];
    const double corner[] = {-100, -100, 100, 100};
    sunder_i_extent e = {0};
    sunder_i_extent_add(&e, corner, 2);
    sunder_i_lattice_init(&l, &e, 1, false, origin, false);
    sunder_i_lattice_admit_ratios(&l);
    sunder_i_point p[4];
    for (int64_t i = 0; i < 4; i++) {
        sunder_i_arena *m = &l.arena;
        const sunder_i_rational_point v = {sunder_i_big_i64(m, 5 * i * i - 7), sunder_i_big_i64(m, 3 - 11 * i),
                                           sunder_i_big_i64(m, 3 + 2 * i)};
        p[i] = sunder_i_rational_put(&l, v);
    }
    for (int i = 0; i < 10 && !l.arena.failed; i++) {
        const sunder_i_fraction f = sunder_i_crossing(&l, p[0], p[1], p[2], p[3]),
                                g = sunder_i_foot(&l, p[0], p[1], p[3]);
        const sunder_i_hpoint h = sunder_i_hpoint_at(&l, p[0], p[1], &f), q = sunder_i_hpoint_at(&l, p[0], p[1], &g);
        sunder_i_fraction_cmp(&l, &f, &g);
        sunder_i_hpoint_cmp(&l, &h, &q);
        sunder_i_orient_hpoint(&l, p[2], p[3], &h);
        sunder_i_orient(&l, p[0], p[1], sunder_i_point_add(&l, p[2], p[3]));
        sunder_i_segment_distance_cmp(&l, p[0], p[1], p[2], p[3], 1);
    }
    const bool ok = !l.arena.failed;
    sunder_i_lattice_free(&l);
    return ok;
}

static void test_out_of_memory(void **state)
{
    (void)state;
    assert_true(failing_loop(run, NULL, false));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_points), cmocka_unit_test(test_crossings),
                                       cmocka_unit_test(test_distances), cmocka_unit_test(test_out_of_memory)};
    return cmocka_run_group_tests_name("predicate/ on ratios", tests, NULL, NULL);
}
