/* predicate/segment: how two segments meet, in every degenerate form, and their distance compared with a gap; on both
 * lattices, and by GMP. */
#include "gmp_numbers.h"
#include "predicate/predicate.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

#define ROUNDS 20000

typedef struct spot {
    int64_t x, y;
} spot;

static sunder_i_lattice lattice[2];

static int open_lattices(void **state)
{
    (void)state;
    const double corner[] = {-0x1p57, -0x1p57, 1, 3};
    for (int wide = 0; wide < 2; wide++) {
        double origin[1][2];
        sunder_i_extent e = {0};
        sunder_i_extent_add(&e, corner, 2);
        sunder_i_lattice_init(&lattice[wide], &e, 1, false, origin, wide);
        if (lattice[wide].narrow == wide) return -1;
    }
    return 0;
}

static int close_lattices(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) sunder_i_lattice_free(&lattice[k]);
    return 0;
}

static int64_t number(int k, int64_t v)
{
    return sunder_i_lattice_big(&lattice[k], sunder_i_big_i64(&lattice[k].arena, v));
}

static sunder_i_point at(int k, spot p) { return (sunder_i_point){number(k, p.x), number(k, p.y)}; }

static sunder_i_meeting meeting(int k, const spot p[4])
{
    return sunder_i_segments_meet(&lattice[k], at(k, p[0]), at(k, p[1]), at(k, p[2]), at(k, p[3]));
}

/* Tests all orders of the ends and of the segments. */
static void expect_meeting(const spot p[4], sunder_i_meeting want)
{
    for (int k = 0; k < 2; k++)
        for (int turn = 0; turn < 8; turn++) {
            spot q[4];
            for (int i = 0; i < 4; i++) q[i] = p[(i ^ (turn & 1 && i < 2) ^ (turn & 2 && i >= 2)) ^ (turn & 4 ? 2 : 0)];
            assert_int_equal(meeting(k, q), want);
        }
}

static void test_named(void **state)
{
    (void)state;
    static const struct {
        spot p[4];
        sunder_i_meeting want;
    } cases[] = {
        {{{0, 0}, {4, 4}, {0, 4}, {4, 0}}, SUNDER_I_CROSS},
        {{{0, 0}, {4, 0}, {2, 0}, {2, 5}}, SUNDER_I_END_INSIDE},
        {{{0, 0}, {4, 0}, {4, 0}, {7, 5}}, SUNDER_I_ENDS_EQUAL},
        {{{0, 0}, {4, 0}, {2, 1}, {2, 5}}, SUNDER_I_APART},
        {{{0, 0}, {4, 0}, {5, -1}, {5, 5}}, SUNDER_I_APART},
        {{{0, 0}, {4, 4}, {2, 2}, {6, 6}}, SUNDER_I_OVERLAP},
        {{{0, 0}, {6, 6}, {2, 2}, {4, 4}}, SUNDER_I_OVERLAP},
        {{{0, 0}, {6, 6}, {0, 0}, {4, 4}}, SUNDER_I_OVERLAP},
        {{{0, 0}, {6, 6}, {0, 0}, {6, 6}}, SUNDER_I_OVERLAP},
        {{{0, 0}, {2, 2}, {2, 2}, {4, 4}}, SUNDER_I_ENDS_EQUAL},
        {{{0, 0}, {2, 2}, {3, 3}, {4, 4}}, SUNDER_I_APART},
        {{{0, 0}, {0, 5}, {0, 2}, {0, 9}}, SUNDER_I_OVERLAP},
        {{{0, 0}, {5, 0}, {1, 3}, {4, 3}}, SUNDER_I_APART},
        /* segments of no length */
        {{{0, 0}, {4, 4}, {2, 2}, {2, 2}}, SUNDER_I_END_INSIDE},
        {{{0, 0}, {4, 4}, {4, 4}, {4, 4}}, SUNDER_I_ENDS_EQUAL},
        {{{0, 0}, {4, 4}, {5, 5}, {5, 5}}, SUNDER_I_APART},
        {{{0, 0}, {4, 4}, {2, 3}, {2, 3}}, SUNDER_I_APART},
        {{{1, 1}, {1, 1}, {1, 1}, {1, 1}}, SUNDER_I_ENDS_EQUAL},
        {{{1, 1}, {1, 1}, {2, 1}, {2, 1}}, SUNDER_I_APART},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) expect_meeting(cases[i].p, cases[i].want);
}

/* ---- Results by GMP ---- */

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

static int side(spot a, spot b, spot c)
{
    mpz_t r;
    mpz_init(r);
    product(r, a, b, a, c, false);
    const int s = mpz_sgn(r);
    mpz_clear(r);
    return s;
}

static bool equal(spot a, spot b) { return a.x == b.x && a.y == b.y; }

static bool on_closed(spot a, spot b, spot p)
{
    return side(a, b, p) == 0 && (a.x < b.x ? a.x : b.x) <= p.x && p.x <= (a.x < b.x ? b.x : a.x) &&
           (a.y < b.y ? a.y : b.y) <= p.y && p.y <= (a.y < b.y ? b.y : a.y);
}

/* Do the segments have a common point? */
static bool meet(const spot p[4])
{
    return (side(p[0], p[1], p[2]) * side(p[0], p[1], p[3]) < 0 &&
            side(p[2], p[3], p[0]) * side(p[2], p[3], p[1]) < 0) ||
           on_closed(p[0], p[1], p[2]) || on_closed(p[0], p[1], p[3]) || on_closed(p[2], p[3], p[0]) ||
           on_closed(p[2], p[3], p[1]);
}

/* Classifies by the number of common points: none, one (by its place on the segments), or more. */
static sunder_i_meeting slow_meeting(const spot p[4])
{
    if (!meet(p)) return SUNDER_I_APART;
    /* The ends, without repetitions, that lie on the other segment. */
    spot on[4];
    int n = 0;
    for (int i = 0; i < 4; i++) {
        bool fresh = i < 2 ? on_closed(p[2], p[3], p[i]) : on_closed(p[0], p[1], p[i]);
        for (int k = 0; k < n; k++) fresh = fresh && !equal(on[k], p[i]);
        if (fresh) on[n++] = p[i];
    }
    if (n == 0) return SUNDER_I_CROSS;
    if (n >= 2) return SUNDER_I_OVERLAP;
    const bool end_of_first = equal(on[0], p[0]) || equal(on[0], p[1]),
               end_of_second = equal(on[0], p[2]) || equal(on[0], p[3]);
    return end_of_first && end_of_second ? SUNDER_I_ENDS_EQUAL : SUNDER_I_END_INSIDE;
}

static void distance2(mpq_t r, spot p, spot a, spot b)
{
    mpz_t u, v, w;
    mpz_inits(u, v, w, NULL);
    product(u, a, p, a, b, true);
    product(v, b, p, b, a, true);
    if (mpz_sgn(u) <= 0)
        product(mpq_numref(r), a, p, a, p, true), mpz_set_ui(mpq_denref(r), 1);
    else if (mpz_sgn(v) <= 0)
        product(mpq_numref(r), b, p, b, p, true), mpz_set_ui(mpq_denref(r), 1);
    else {
        product(w, a, b, a, p, false);
        mpz_mul(mpq_numref(r), w, w);
        product(mpq_denref(r), a, b, a, b, true);
        mpq_canonicalize(r);
    }
    mpz_clears(u, v, w, NULL);
}

static void least_distance2(mpq_t r, const spot p[4])
{
    mpq_t d;
    mpq_init(d);
    mpq_set_ui(r, 0, 1);
    for (int i = 0; i < 4 && !meet(p); i++) {
        if (i < 2)
            distance2(d, p[i], p[2], p[3]);
        else
            distance2(d, p[i], p[0], p[1]);
        if (i == 0 || mpq_cmp(d, r) < 0) mpq_set(r, d);
    }
    mpq_clear(d);
}

static int64_t coordinate(rng *g, int kind)
{
    const int64_t big = ((int64_t)1 << 58) - 1;
    return kind == 0   ? rng_int(g, 0, 3)
           : kind == 1 ? rng_int(g, -100, 100)
           : kind == 2 ? (rng_once_in(g, 2) ? big : -big) + rng_int(g, -2, 2)
                       : rng_int(g, -big, big);
}

static void random_segments(rng *g, int round, spot p[4])
{
    for (int i = 0; i < 4; i++) p[i] = (spot){coordinate(g, round % 4), coordinate(g, round % 4)};
    if (round % 6 == 0) p[2] = (spot){p[0].x + (p[1].x - p[0].x) / 2, p[0].y + (p[1].y - p[0].y) / 2};
    if (round % 12 == 0) p[3] = (spot){p[1].x + (p[1].x - p[2].x), p[1].y + (p[1].y - p[2].y)};
}

static void test_meetings(void **state)
{
    (void)state;
    rng g = rng_start(test_seed(), 31);
    int seen[5] = {0};
    for (int i = 0; i < ROUNDS; i++) {
        spot p[4];
        random_segments(&g, i, p);
        const sunder_i_meeting want = slow_meeting(p);
        seen[want]++;
        /* Two coincident degenerate segments share their point as a common end. */
        for (int k = 0; k < 2; k++) assert_int_equal(meeting(k, p), want);
    }
    for (int m = 0; m < 5; m++) assert_true(seen[m] > 100);
}

static void test_distances(void **state)
{
    (void)state;
    rng g = rng_start(test_seed(), 32);
    mpq_t d, gap2;
    mpz_t root;
    int seen[3] = {0};
    mpq_inits(d, gap2, NULL);
    mpz_init(root);
    for (int i = 0; i < ROUNDS; i++) {
        spot p[4];
        random_segments(&g, i, p);
        least_distance2(d, p);
        /* The gap is the distance rounded down, one more, or any number. */
        mpz_fdiv_q(root, mpq_numref(d), mpq_denref(d));
        mpz_sqrt(root, root);
        int64_t gap = mpz_sizeinbase(root, 2) < 60 ? mpz_get_si(root) + rng_int(&g, 0, 1) : 0;
        if (i % 5 == 0) gap = i % 10 ? 0 : rng_int(&g, 0, 200);
        mpq_set_si(gap2, gap, 1);
        mpq_mul(gap2, gap2, gap2);
        const int c = mpq_cmp(d, gap2), want = (c > 0) - (c < 0);
        seen[want + 1]++;
        for (int k = 0; k < 2; k++)
            assert_int_equal(sunder_i_segment_distance_cmp(&lattice[k], at(k, p[0]), at(k, p[1]), at(k, p[2]),
                                                           at(k, p[3]), number(k, gap)),
                             want);
    }
    assert_true(seen[0] > 500 && seen[1] > 500 && seen[2] > 500);
    assert_false(lattice[0].arena.failed || lattice[1].arena.failed);
    mpq_clears(d, gap2, NULL);
    mpz_clear(root);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_named), cmocka_unit_test(test_meetings),
                                       cmocka_unit_test(test_distances)};
    return cmocka_run_group_tests_name("predicate/segment", tests, open_lattices, close_lattices);
}
