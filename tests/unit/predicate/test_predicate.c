/* predicate/: the same random questions on a narrow lattice, on a forced wide one, and in GMP; points on small grids
 * and at the largest narrow coordinates, so that all signs, ties and coincidences occur. */
#include "failing.h"
#include "gmp_numbers.h"
#include "predicate/narrow.h"
#include "predicate/predicate.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define ROUNDS 6000

typedef struct spot {
    int64_t x, y;
} spot;

/* Two lattices over the same integers, and numbers of GMP to compare with. */
typedef struct bench {
    sunder_i_lattice l[2];
    rng g;
    mpz_t s, t, u, v, w;
} bench;

static void open_lattice(sunder_i_lattice *l, bool wide)
{
    double origin[1][2];
    const double corner[] = {-0x1p57, -0x1p57, 1, 3};
    sunder_i_extent e = {0};
    sunder_i_extent_add(&e, corner, 2);
    sunder_i_lattice_init(l, &e, 1, false, origin, wide);
}

static void open_bench(bench *b, uint64_t i)
{
    open_lattice(&b->l[0], false);
    open_lattice(&b->l[1], true);
    assert_true(b->l[0].narrow && !b->l[1].narrow);
    b->g = rng_start(test_seed(), i);
    mpz_inits(b->s, b->t, b->u, b->v, b->w, NULL);
}

static void close_bench(bench *b)
{
    for (int k = 0; k < 2; k++) {
        assert_false(b->l[k].arena.failed);
        sunder_i_lattice_free(&b->l[k]);
    }
    mpz_clears(b->s, b->t, b->u, b->v, b->w, NULL);
}

static int64_t coordinate(rng *g, int kind)
{
    if (kind == 0) return rng_int(g, -2, 2);
    if (kind == 1) return rng_int(g, -1000000, 1000000);
    const int64_t big = ((int64_t)1 << 59) - 1;
    if (kind == 2) return rng_once_in(g, 2) ? big - rng_int(g, 0, 3) : -big + rng_int(g, 0, 3);
    return rng_int(g, -big, big);
}

static void random_spots(rng *g, int round, spot *p, int n)
{
    for (int i = 0; i < n; i++) {
        p[i].x = coordinate(g, round % 4);
        p[i].y = coordinate(g, round % 4);
    }
    if (round % 7 == 6 && n > 2) { /* collinear: the third at the midpoint, or at twice the distance */
        p[2].x = p[0].x / 4 + p[1].x / 4;
        p[2].y = p[0].y / 4 + p[1].y / 4;
        p[0] = (spot){p[2].x - p[1].x / 8, p[2].y - p[1].y / 8};
        p[1] = (spot){p[2].x + (p[2].x - p[0].x), p[2].y + (p[2].y - p[0].y)};
    }
}

/* The point on lattice k. */
static sunder_i_point at(bench *b, int k, spot p)
{
    return (sunder_i_point){sunder_i_lattice_big(&b->l[k], sunder_i_big_i64(&b->l[k].arena, p.x)),
                            sunder_i_lattice_big(&b->l[k], sunder_i_big_i64(&b->l[k].arena, p.y))};
}

static int sign(int v) { return (v > 0) - (v < 0); }

/* r = (b - a) x (d - c), or their dot product. */
static void product(mpz_t r, spot a, spot b, spot c, spot d, bool dot)
{
    mpz_t u;
    mpz_init(u);
    mpz_set_si(r, b.x - a.x);
    mpz_mul_si(r, r, dot ? d.x - c.x : d.y - c.y);
    mpz_set_si(u, b.y - a.y);
    mpz_mul_si(u, u, dot ? d.y - c.y : d.x - c.x);
    if (dot)
        mpz_add(r, r, u);
    else
        mpz_sub(r, r, u);
    mpz_clear(u);
}

static void test_points(void **state)
{
    (void)state;
    bench b;
    open_bench(&b, 21);
    for (int i = 0; i < ROUNDS; i++) {
        spot p[3];
        random_spots(&b.g, i, p, 3);
        const int order =
            p[0].x != p[1].x ? (p[0].x > p[1].x) - (p[0].x < p[1].x) : (p[0].y > p[1].y) - (p[0].y < p[1].y);
        product(b.s, p[0], p[1], p[0], p[2], false);
        for (int k = 0; k < 2; k++) {
            sunder_i_lattice *l = &b.l[k];
            const sunder_i_point a = at(&b, k, p[0]), c = at(&b, k, p[1]), d = at(&b, k, p[2]);
            assert_int_equal(sunder_i_point_cmp(l, a, c), order);
            assert_int_equal(sunder_i_point_equal(l, a, c), order == 0);
            assert_true(sunder_i_point_equal(l, a, at(&b, k, p[0])));
            assert_int_equal(sunder_i_int_cmp(l, a.x, c.x), (p[0].x > p[1].x) - (p[0].x < p[1].x));
            assert_int_equal(sunder_i_orient(l, a, c, d), mpz_sgn(b.s));
            const sunder_i_point sum = sunder_i_point_add(l, a, c), back = sunder_i_point_sub(l, sum, c);
            assert_true(sunder_i_point_equal(l, back, a));
            assert_true(sunder_i_point_equal(l, sunder_i_point_neg(l, sunder_i_point_neg(l, a)), a));
            assert_true(sunder_i_point_equal(l, sunder_i_point_sub(l, a, c),
                                             sunder_i_point_neg(l, sunder_i_point_sub(l, c, a))));
            if (k == 0) assert_true(sunder_i_i128_sign(sunder_i_narrow_orient(a, c, d)) == mpz_sgn(b.s));
        }
    }
    assert_true(b.l[0].counts.orientation_tests >= ROUNDS && b.l[0].counts.comparisons >= ROUNDS);
    assert_true(b.l[1].counts.exact_fallbacks >= ROUNDS);
    close_bench(&b);
}

static int half(spot v) { return v.y < 0 || (v.y == 0 && v.x < 0); }

static void test_vectors(void **state)
{
    (void)state;
    bench b;
    const spot o = {0, 0};
    open_bench(&b, 22);
    for (int i = 0; i < ROUNDS; i++) {
        spot p[2];
        random_spots(&b.g, i, p, 2);
        if (i % 9 == 0) p[1] = (spot){-p[0].x, -p[0].y};
        if (i % 9 == 1) p[1] = (spot){p[0].x / 2, p[0].y / 2}, p[0] = (spot){2 * p[1].x, 2 * p[1].y};
        product(b.s, o, p[0], o, p[1], false);
        product(b.t, o, p[0], o, p[1], true);
        const bool zero = (!p[0].x && !p[0].y) || (!p[1].x && !p[1].y);
        const int angle = half(p[0]) != half(p[1]) ? (half(p[0]) ? 1 : -1) : -mpz_sgn(b.s);
        for (int k = 0; k < 2; k++) {
            const sunder_i_point u = at(&b, k, p[0]), v = at(&b, k, p[1]);
            assert_int_equal(sunder_i_cross_sign(&b.l[k], u, v), mpz_sgn(b.s));
            assert_int_equal(sunder_i_dot_sign(&b.l[k], u, v), mpz_sgn(b.t));
            if (!zero) assert_int_equal(sunder_i_angle_cmp(&b.l[k], u, v), angle);
        }
    }
    close_bench(&b);
}

/* ---- Fractions and crossings ---- */

static void fraction_exact(mpq_t r, bench *b, int k, const sunder_i_fraction *f)
{
    if (k == 0) assert_true(f->den > 0);
    const sunder_i_ratio v = sunder_i_fraction_read(&b->l[k].arena, &b->l[k], f);
    mpz_from_big(mpq_numref(r), v.num);
    mpz_from_big(mpq_denref(r), v.den);
    assert_int_equal(sunder_i_fraction_sign(&b->l[k], f), mpz_sgn(mpq_numref(r)));
    assert_true(mpz_sgn(mpq_denref(r)) > 0);
    mpq_canonicalize(r);
}

/* |value - r| <= 4e-16 * max(1, |r|), as the header promises. */
static void expect_close(double value, const mpq_t r)
{
    mpq_t d, bound, one;
    mpq_inits(d, bound, one, NULL);
    mpq_set_d(d, value);
    mpq_sub(d, d, r);
    mpq_abs(d, d);
    mpq_set_ui(one, 1, 1);
    mpq_abs(bound, r);
    if (mpq_cmp(bound, one) < 0) mpq_set(bound, one);
    mpq_set_d(one, 4e-16);
    mpq_mul(bound, bound, one);
    assert_true(mpq_cmp(d, bound) <= 0);
    mpq_clears(d, bound, one, NULL);
}

static void ratio_of(mpq_t r, const mpz_t num, const mpz_t den)
{
    mpz_set(mpq_numref(r), num);
    mpz_set(mpq_denref(r), den);
    mpq_canonicalize(r);
}

static void check_fraction(bench *b, int k, const sunder_i_fraction *f, const mpq_t want)
{
    mpq_t r;
    mpq_init(r);
    fraction_exact(r, b, k, f);
    assert_true(mpq_equal(r, want));
    expect_close(f->value, want);
    mpq_clear(r);
}

/* x = a + t (b - a), per axis. */
static void along_line(mpq_t r, int64_t a, int64_t b, const mpq_t t)
{
    mpq_t s;
    mpq_init(s);
    mpq_set_si(r, b - a, 1);
    mpq_mul(r, r, t);
    mpq_set_si(s, a, 1);
    mpq_add(r, r, s);
    mpq_clear(s);
}

static void check_hpoint(bench *b, int k, const sunder_i_hpoint *h, const mpq_t x, const mpq_t y)
{
    mpq_t r;
    mpq_init(r);
    const sunder_i_rational_point p = sunder_i_hpoint_read(&b->l[k].arena, &b->l[k], h);
    assert_true(sunder_i_big_sign(p.w) > 0);
    for (int axis = 0; axis < 2; axis++) {
        mpz_from_big(mpq_numref(r), axis ? p.y : p.x);
        mpz_from_big(mpq_denref(r), p.w);
        mpq_canonicalize(r);
        assert_true(mpq_equal(r, axis ? y : x));
    }
    expect_close(h->ax, x);
    expect_close(h->ay, y);
    mpq_clear(r);
}

typedef struct crossed {
    sunder_i_fraction f[2];
    sunder_i_hpoint h[2];
    mpq_t t, x, y;
} crossed;

/* A random crossing of the line p[0] p[1], on both lattices; false if there is none. */
static bool cross_line(bench *b, int round, const spot p[2], crossed *c)
{
    spot q[2];
    random_spots(&b->g, round, q, 2);
    if (round % 5 == 0 && rng_once_in(&b->g, 2)) { /* through the first end, so that many lines cross there */
        q[0] = (spot){p[0].x / 2, p[0].y / 2};
        q[1] = (spot){p[0].x + (p[0].x - q[0].x), p[0].y + (p[0].y - q[0].y)};
    }
    product(b->v, p[0], p[1], q[0], q[1], false);
    if (mpz_sgn(b->v) == 0) return false;
    product(b->u, p[0], q[0], q[0], q[1], false);
    ratio_of(c->t, b->u, b->v);
    along_line(c->x, p[0].x, p[1].x, c->t);
    along_line(c->y, p[0].y, p[1].y, c->t);
    for (int k = 0; k < 2; k++) {
        const sunder_i_point a = at(b, k, p[0]), d = at(b, k, p[1]);
        c->f[k] = sunder_i_crossing(&b->l[k], a, d, at(b, k, q[0]), at(b, k, q[1]));
        check_fraction(b, k, &c->f[k], c->t);
        c->h[k] = sunder_i_hpoint_at(&b->l[k], a, d, &c->f[k]);
        check_hpoint(b, k, &c->h[k], c->x, c->y);
    }
    return true;
}

static void test_crossings(void **state)
{
    (void)state;
    bench b;
    crossed c[3];
    int ties = 0, equal_points = 0;
    open_bench(&b, 23);
    for (int i = 0; i < 3; i++) mpq_inits(c[i].t, c[i].x, c[i].y, NULL);
    for (int i = 0; i < ROUNDS; i++) {
        spot p[4];
        random_spots(&b.g, i, p, 4);
        if (i % 5 == 0) p[2] = p[0];
        const spot first[2] = {p[0], p[1]}, other[2] = {p[2], p[3]};
        if ((p[0].x == p[1].x && p[0].y == p[1].y) || (p[2].x == p[3].x && p[2].y == p[3].y)) continue;
        if (!cross_line(&b, i, first, &c[0]) || !cross_line(&b, i, first, &c[1]) || !cross_line(&b, i, other, &c[2]))
            continue;
        const int order = sign(mpq_cmp(c[0].t, c[1].t));
        const int px = sign(mpq_cmp(c[0].x, c[2].x)), lex = px ? px : sign(mpq_cmp(c[0].y, c[2].y));
        ties += order == 0;
        equal_points += lex == 0;
        /* The side of a crossing relative to another line: (d - a) x (h - a). */
        mpq_t s, t;
        mpq_inits(s, t, NULL);
        mpq_set_si(s, p[2].y, 1);
        mpq_sub(s, c[0].y, s);
        mpq_set_si(t, p[3].x - p[2].x, 1);
        mpq_mul(s, s, t);
        mpq_set_si(t, p[2].x, 1);
        mpq_sub(t, c[0].x, t);
        mpz_t d;
        mpz_init_set_si(d, p[3].y - p[2].y);
        mpz_mul(mpq_numref(t), mpq_numref(t), d);
        mpq_canonicalize(t);
        mpz_clear(d);
        const int side = sign(mpq_cmp(s, t));
        mpq_clears(s, t, NULL);
        for (int k = 0; k < 2; k++) {
            sunder_i_lattice *l = &b.l[k];
            assert_int_equal(sunder_i_fraction_cmp(l, &c[0].f[k], &c[1].f[k]), order);
            assert_int_equal(sunder_i_fraction_cmp(l, &c[1].f[k], &c[0].f[k]), -order);
            assert_int_equal(sunder_i_hpoint_cmp(l, &c[0].h[k], &c[2].h[k]), lex);
            assert_int_equal(sunder_i_hpoint_cmp(l, &c[2].h[k], &c[0].h[k]), -lex);
            assert_int_equal(sunder_i_hpoint_equal(l, &c[0].h[k], &c[2].h[k]), lex == 0);
            assert_int_equal(sunder_i_orient_hpoint(l, at(&b, k, p[2]), at(&b, k, p[3]), &c[0].h[k]), side);
        }
    }
    print_message("%d ties, %d equal points\n", ties, equal_points);
    assert_true(ties > 20 && equal_points > 20);
    assert_true(b.l[0].counts.segment_intersections > ROUNDS);
    for (int i = 0; i < 3; i++) mpq_clears(c[i].t, c[i].x, c[i].y, NULL);
    close_bench(&b);
}

static void test_feet(void **state)
{
    (void)state;
    bench b;
    mpq_t want, x, y;
    open_bench(&b, 24);
    mpq_inits(want, x, y, NULL);
    for (int i = 0; i < ROUNDS; i++) {
        spot p[3];
        random_spots(&b.g, i, p, 3);
        if (p[0].x == p[1].x && p[0].y == p[1].y) continue;
        product(b.s, p[0], p[2], p[0], p[1], true);
        product(b.t, p[0], p[1], p[0], p[1], true);
        ratio_of(want, b.s, b.t);
        product(b.u, p[0], p[1], p[0], p[2], false);
        for (int k = 0; k < 2; k++) {
            const sunder_i_point a = at(&b, k, p[0]), d = at(&b, k, p[1]), e = at(&b, k, p[2]);
            sunder_i_fraction f = sunder_i_foot(&b.l[k], a, d, e);
            check_fraction(&b, k, &f, want);
            if (mpz_sgn(b.u) == 0) { /* if the point is on the line, it is the foot */
                f = sunder_i_along(&b.l[k], a, d, e);
                check_fraction(&b, k, &f, want);
            }
            const sunder_i_hpoint h = sunder_i_hpoint_of(&b.l[k], e);
            mpq_set_si(x, p[2].x, 1);
            mpq_set_si(y, p[2].y, 1);
            check_hpoint(&b, k, &h, x, y);
            f = sunder_i_fraction_int(&b.l[k], i % 5 - 2);
            mpq_set_si(x, i % 5 - 2, 1);
            check_fraction(&b, k, &f, x);
        }
    }
    mpq_clears(want, x, y, NULL);
    close_bench(&b);
}

static bool predicate_run(void *context)
{
    sunder_i_lattice l;
    open_lattice(&l, *(const bool *)context);
    sunder_i_point p[4];
    static const int64_t xy[8] = {0, 0, 1000001, 3, 17, -900, 23, 777777};
    for (int i = 0; i < 4; i++)
        p[i] = (sunder_i_point){sunder_i_lattice_big(&l, sunder_i_big_i64(&l.arena, xy[2 * i])),
                                sunder_i_lattice_big(&l, sunder_i_big_i64(&l.arena, xy[2 * i + 1]))};
    for (int i = 0; i < 20 && !l.arena.failed; i++) {
        const sunder_i_fraction f = sunder_i_crossing(&l, p[0], p[1], p[2], p[3]),
                                g = sunder_i_foot(&l, p[0], p[1], p[3]);
        const sunder_i_hpoint h = sunder_i_hpoint_at(&l, p[0], p[1], &f), q = sunder_i_hpoint_at(&l, p[0], p[1], &g);
        if (l.arena.failed) break;
        sunder_i_fraction_cmp(&l, &f, &g);
        sunder_i_hpoint_cmp(&l, &h, &q);
        sunder_i_orient_hpoint(&l, p[2], p[3], &q);
        sunder_i_segments_meet(&l, p[0], p[1], p[2], p[3]);
        if (l.arena.failed) break;
        sunder_i_segment_distance_cmp(&l, p[0], p[1], p[2], p[3], p[1].x);
    }
    const bool ok = !l.arena.failed;
    sunder_i_lattice_free(&l);
    return ok;
}

static void test_out_of_memory(void **state)
{
    (void)state;
    for (int wide = 0; wide < 2; wide++) {
        bool w = wide;
        assert_true(failing_loop(predicate_run, &w, false));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_points), cmocka_unit_test(test_vectors),
                                       cmocka_unit_test(test_crossings), cmocka_unit_test(test_feet),
                                       cmocka_unit_test(test_out_of_memory)};
    return cmocka_run_group_tests_name("predicate", tests, NULL, NULL);
}
