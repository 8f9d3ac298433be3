/* planar_map/sites.c: order, sides, turns and crossings compared with GMP's rationals, with numbers of five to two
 * thousand bits, positions that doubles do not distinguish, and exact arithmetic both after the filter and in place of
 * it. */
#include "gmp_numbers.h"
#include "planar_map/map.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

typedef struct spot {
    mpq_t x, y;
} spot;

typedef struct bed {
    sunder_i_lattice lattice;
    sunder_i_planar_map *map;
    sunder_i_arena arena;
    rng g;
} bed;

static void open_bed(bed *b, uint64_t seed, double reach)
{
    *b = (bed){.g = rng_start(test_seed(), seed)};
    double origin[1][2];
    const double corner[] = {-reach, -reach, reach, 1};
    sunder_i_extent e = {0};
    sunder_i_extent_add(&e, corner, 2);
    sunder_i_lattice_init(&b->lattice, &e, 1, false, origin, false);
    assert_int_equal(sunder_i_planar_map_new(&b->lattice, 1, &b->map, NULL), SUNDER_OK);
}

static void close_bed(bed *b)
{
    sunder_i_planar_map_free(b->map);
    sunder_i_lattice_free(&b->lattice);
    sunder_i_arena_free(&b->arena);
}

static void spot_random(bed *b, spot *s, unsigned bits)
{
    for (int i = 0; i < 2; i++) {
        mpq_ptr q = i ? s->y : s->x;
        random_mpz(mpq_numref(q), &b->g, bits);
        random_mpz(mpq_denref(q), &b->g, 1 + bits / 3);
        if (mpz_sgn(mpq_denref(q)) == 0 || rng_once_in(&b->g, 2)) mpz_set_ui(mpq_denref(q), 1);
        mpq_canonicalize(q);
    }
}

/* Makes a site: coordinates over a common denominator, times a random factor. */
static sunder_i_site site_of(bed *b, const spot *s)
{
    mpz_t n, d;
    mpz_inits(n, d, NULL);
    mpz_mul(d, mpq_denref(s->x), mpq_denref(s->y));
    mpz_mul_ui(d, d, (unsigned long)rng_int(&b->g, 1, 5));
    sunder_i_rational_point at;
    at.w = big_from_mpz(&b->arena, d);
    for (int i = 0; i < 2; i++) {
        mpq_srcptr q = i ? s->y : s->x;
        mpz_divexact(n, d, mpq_denref(q));
        mpz_mul(n, n, mpq_numref(q));
        *(i ? &at.y : &at.x) = big_from_mpz(&b->arena, n);
    }
    mpz_clears(n, d, NULL);
    return sunder_i_site_of(b->map, at);
}

static int sign(int v) { return (v > 0) - (v < 0); }

static int spot_cmp(const spot *p, const spot *q)
{
    const int c = mpq_cmp(p->x, q->x);
    return sign(c ? c : mpq_cmp(p->y, q->y));
}

/* Sign of (ax by - ay bx) for the vectors from p to q and from s to r. */
static int cross_sign(const spot *p, const spot *q, const spot *s, const spot *r)
{
    mpq_t a, b, c, d;
    mpq_inits(a, b, c, d, NULL);
    mpq_sub(a, q->x, p->x);
    mpq_sub(b, r->y, s->y);
    mpq_sub(c, q->y, p->y);
    mpq_sub(d, r->x, s->x);
    mpq_mul(a, a, b);
    mpq_mul(c, c, d);
    const int turn = sign(mpq_cmp(a, c));
    mpq_clears(a, b, c, d, NULL);
    return turn;
}

/* Makes a spot on the line pq, or slightly off it. */
static void spot_near(bed *b, spot *r, const spot *p, const spot *q)
{
    mpq_t t, u;
    mpq_inits(t, u, NULL);
    mpq_set_si(t, rng_int(&b->g, -3, 7), (unsigned long)rng_int(&b->g, 1, 7));
    mpq_canonicalize(t);
    mpq_sub(u, q->x, p->x);
    mpq_mul(u, u, t);
    mpq_add(r->x, p->x, u);
    mpq_sub(u, q->y, p->y);
    mpq_mul(u, u, t);
    mpq_add(r->y, p->y, u);
    if (rng_once_in(&b->g, 2)) {
        mpq_set_si(u, rng_once_in(&b->g, 2) ? 1 : -1, 1);
        mpq_div_2exp(u, u, (mp_bitcnt_t)rng_int(&b->g, 0, 300));
        mpq_ptr moved = rng_once_in(&b->g, 2) ? r->x : r->y;
        mpq_add(moved, moved, u);
    }
    mpq_clears(t, u, NULL);
}

static sunder_i_map_line line_of(bed *b, const spot *p, const spot *q, const sunder_i_point *along)
{
    const sunder_i_site s = site_of(b, p), t = site_of(b, q);
    return sunder_i_line_through(b->map, &s, &t, along, &b->arena);
}

/* Moves q to some place on a line through p whose direction is a lattice vector, or its reverse. */
static sunder_i_point put_along(bed *b, const spot *p, spot *q)
{
    const int64_t most = rng_once_in(&b->g, 2) ? 9 : (INT64_C(1) << SUNDER_I_PLAIN_BITS) - 1;
    sunder_i_point v = {rng_int(&b->g, -most, most), rng_once_in(&b->g, 4) ? 0 : rng_int(&b->g, -most, most)};
    if (rng_once_in(&b->g, 4) || v.x == 0) v = (sunder_i_point){v.y, v.x ? v.x : 1};
    mpq_t far, t;
    mpq_inits(far, t, NULL);
    mpq_set(far, q->x); /* only in x */
    for (int axis = 0; axis < 2; axis++) {
        mpq_set_si(t, axis ? v.y : v.x, 1);
        mpq_mul(t, t, far);
        mpq_add(axis ? q->y : q->x, axis ? p->y : p->x, t);
    }
    mpq_clears(far, t, NULL);
    return v;
}

static void check_cmp(bed *b, const spot *p, const spot *q)
{
    sunder_i_site s = site_of(b, p), t = site_of(b, q);
    assert_int_equal(sunder_i_site_cmp(b->map, &s, &t), spot_cmp(p, q));
    s.ax = t.ax;
    s.ay = t.ay; /* disables the filter */
    assert_int_equal(sunder_i_site_cmp(b->map, &s, &t), spot_cmp(p, q));
    const sunder_i_site once = site_of(b, p), again = site_of(b, p); /* perhaps over different denominators */
    assert_int_equal(sunder_i_site_cmp(b->map, &once, &again), 0);
}

static void check_side(bed *b, const sunder_i_map_line *line, const spot *p, const spot *q, const spot *r)
{
    sunder_i_site s = site_of(b, r);
    const int expected = cross_sign(p, q, p, r);
    assert_int_equal(sunder_i_site_side(b->map, line, &s), expected);
    s.ax = NAN;
    assert_int_equal(sunder_i_site_side(b->map, line, &s), expected);
}

static void check_pair_of_lines(bed *b, const sunder_i_map_line *f, const sunder_i_map_line *g, int turn)
{
    assert_int_equal(sunder_i_line_turn(b->map, f, g), turn);
    sunder_i_map_line blind = *f;
    blind.a = NAN;
    assert_int_equal(sunder_i_line_turn(b->map, &blind, g), turn);
    if (turn == 0) return;
    const sunder_i_site c = sunder_i_line_crossing(b->map, f, g, &b->arena);
    assert_true(sunder_i_big_sign(c.at.w) > 0);
    if (fabs(c.ax) > 0x1p501 || fabs(c.ay) > 0x1p501) return; /* far outside the lattice, where no edge can be */
    assert_int_equal(sunder_i_site_side(b->map, f, &c), 0);
    assert_int_equal(sunder_i_site_side(b->map, g, &c), 0);
}

static void run(double reach, uint64_t seed, size_t rounds)
{
    static const unsigned sizes[] = {3, 20, 50, 300, 600, 980};
    bed b;
    open_bed(&b, seed, reach);
    spot p, q, r, s;
    mpq_inits(p.x, p.y, q.x, q.y, r.x, r.y, s.x, s.y, NULL);
    for (size_t i = 0; i < test_count(rounds); i++) {
        const unsigned bits = sizes[rng_int(&b.g, 0, b.lattice.narrow ? 2 : 5)];
        spot_random(&b, &p, bits);
        spot_random(&b, &q, bits);
        if (rng_once_in(&b.g, 4)) mpq_set(q.x, p.x);
        if (rng_once_in(&b.g, 4)) mpq_set(q.y, p.y);
        const bool known = rng_once_in(&b.g, 3);
        const sunder_i_point along = known ? put_along(&b, &p, &q) : (sunder_i_point){0, 0};
        check_cmp(&b, &p, &q);
        if (spot_cmp(&p, &q) == 0) continue;
        if (spot_cmp(&p, &q) > 0) {
            mpq_swap(p.x, q.x);
            mpq_swap(p.y, q.y);
        }
        const sunder_i_map_line line = line_of(&b, &p, &q, known ? &along : NULL);
        if (rng_once_in(&b.g, 3))
            spot_random(&b, &r, bits);
        else
            spot_near(&b, &r, &p, &q);
        check_side(&b, &line, &p, &q, &r);
        spot_near(&b, &s, &p, &q);
        if (spot_cmp(&r, &s) < 0) {
            const sunder_i_map_line other = line_of(&b, &r, &s, NULL);
            check_pair_of_lines(&b, &line, &other, cross_sign(&p, &q, &r, &s));
        }
        sunder_i_arena_free(&b.arena);
    }
    mpq_clears(p.x, p.y, q.x, q.y, r.x, r.y, s.x, s.y, NULL);
    close_bed(&b);
}

static void test_narrow(void **state)
{
    (void)state;
    run(0x1p57, 1, 20000);
}

static void test_wide(void **state)
{
    (void)state;
    run(1e300, 2, 6000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_narrow), cmocka_unit_test(test_wide)};
    return cmocka_run_group_tests_name("planar_map sites", tests, NULL, NULL);
}
