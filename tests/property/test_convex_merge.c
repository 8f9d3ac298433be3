/* Sums of convex pieces by merging: random polygons with straight corners, segments and points, whose directions are
 * often equal, compared with the hull of all sums of corners, in plain integers. Also ranks, directions and
 * candidates. */
#include "convex/pieces.h"
#include "predicate/predicate.h"
#include "random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 32 };

typedef struct place {
    int64_t x, y;
} place;

typedef struct piece {
    place at[MOST];
    bool candidate[MOST];
    int n;
} piece;

static int64_t turn(place a, place b, place c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }
static bool smaller(place a, place b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }
static bool equal(place a, place b) { return a.x == b.x && a.y == b.y; }

/* ---- The oracle: Andrew's hull, strictly convex, counter-clockwise from its smallest corner ---- */

static int hull(place *p, int n, place *out)
{
    for (int i = 1; i < n; i++)
        for (int j = i; j > 0 && smaller(p[j], p[j - 1]); j--) {
            const place t = p[j];
            p[j] = p[j - 1];
            p[j - 1] = t;
        }
    int distinct = 0;
    for (int i = 0; i < n; i++)
        if (i == 0 || !equal(p[i], p[distinct - 1])) p[distinct++] = p[i];
    if (distinct == 1) out[0] = p[0];
    if (distinct == 1) return 1;
    int k = 0;
    for (int i = 0; i < distinct; i++) {
        while (k >= 2 && turn(out[k - 2], out[k - 1], p[i]) <= 0) k--;
        out[k++] = p[i];
    }
    for (int i = distinct - 2, lower = k + 1; i >= 0; i--) {
        while (k >= lower && turn(out[k - 2], out[k - 1], p[i]) <= 0) k--;
        out[k++] = p[i];
    }
    return k - 1;
}

/* ---- Pieces ---- */

static void random_piece(rng *r, piece *out)
{
    place some[8], corner[9];
    const int64_t size = rng_int(r, 1, 6); /* a small board makes many equal directions */
    const int n = (int)rng_int(r, 1, 8);
    for (int i = 0; i < n; i++) some[i] = (place){2 * rng_int(r, -size, size), 2 * rng_int(r, -size, size)};
    const int corners = hull(some, n, corner);
    const int first = (int)rng_int(r, 0, corners - 1);
    out->n = 0;
    for (int i = 0; i < corners; i++) {
        const place a = corner[(first + i) % corners], b = corner[(first + i + 1) % corners];
        out->at[out->n++] = a;
        if (corners > 2 && rng_once_in(r, 4)) out->at[out->n++] = (place){(a.x + b.x) / 2, (a.y + b.y) / 2};
    }
    for (int i = 0; i < out->n; i++) out->candidate[i] = rng_once_in(r, 2);
}

static sunder_i_point put(sunder_i_lattice *l, place p)
{
    return (sunder_i_point){sunder_i_lattice_int(l, (double)p.x, 0), sunder_i_lattice_int(l, (double)p.y, 0)};
}

static void list_of(sunder_i_lattice *l, const piece *p, sunder_i_convex_pieces *out)
{
    assert_true(sunder_i_convex_pieces_init(out, 1, (size_t)p->n));
    for (int i = 0; i < p->n; i++) sunder_i_convex_pieces_add_corner(out, put(l, p->at[i]), p->candidate[i]);
    out->end[out->n++] = out->corners;
}

/* The corners of the sum as plain integers: each is the sum of two corners. */
static void read_sum(sunder_i_lattice *l, const sunder_i_convex_pieces *sum, const piece *p, const piece *q, piece *out)
{
    out->n = 0;
    for (uint32_t k = 0; k < sum->corners; k++)
        for (int i = 0, found = 0; i < p->n * q->n && !found; i++) {
            const place a = p->at[i / q->n], b = q->at[i % q->n], c = {a.x + b.x, a.y + b.y};
            found = sunder_i_point_cmp(l, put(l, c), sum->corner[k]) == 0;
            if (found) out->at[out->n] = c;
            if (found) out->candidate[out->n++] = sum->candidate[k];
        }
}

/* ---- Properties -------- */

/* Corners that are not straight, from the smallest on. */
static int strict_corners(const piece *p, place *out)
{
    int n = 0, least = 0;
    place kept[MOST];
    for (int i = 0; i < p->n; i++) {
        const place before = p->at[(i + p->n - 1) % p->n], here = p->at[i], after = p->at[(i + 1) % p->n];
        const bool back = (here.x - before.x) * (after.x - here.x) + (here.y - before.y) * (after.y - here.y) < 0;
        if (p->n < 3 || turn(before, here, after) != 0 || back) kept[n++] = here;
    }
    for (int i = 1; i < n; i++)
        if (smaller(kept[i], kept[least])) least = i;
    for (int i = 0; i < n; i++) out[i] = kept[(least + i) % n];
    return n;
}

/* The sides of p in the direction d, and whether one of them is a candidate. */
static int sides_along(const piece *p, place d, bool *candidate)
{
    int n = 0;
    for (int i = 0; i < p->n && p->n > 1; i++) {
        const place a = p->at[i], b = p->at[(i + 1) % p->n], e = {b.x - a.x, b.y - a.y};
        if (e.x * d.y != e.y * d.x || e.x * d.x + e.y * d.y <= 0) continue;
        n++;
        *candidate = *candidate || p->candidate[i];
    }
    return n;
}

/* If neither operand has straight corners along a side of the sum, that side is a candidate exactly if one of its parts
 * is. */
static bool candidates_agree(const piece *sum, const piece *p, const piece *q)
{
    for (int i = 0; i < sum->n && sum->n > 1; i++) {
        const place a = sum->at[i], b = sum->at[(i + 1) % sum->n], d = {b.x - a.x, b.y - a.y};
        bool any = false;
        const int m = sides_along(p, d, &any), n = sides_along(q, d, &any);
        if (m <= 1 && n <= 1 && sum->candidate[i] != any) return false;
    }
    return true;
}

static bool directions_agree(sunder_i_lattice *l, const sunder_i_convex_pieces *sum)
{
    const uint32_t n = sum->corners;
    for (uint32_t k = 0; k < n && n > 1; k++) {
        const sunder_i_point d = sunder_i_point_sub(l, sum->corner[k + 1 < n ? k + 1 : 0], sum->corner[k]);
        const bool turned = sum->rank[k] >= sum->classes;
        if (sunder_i_cross_sign(l, sum->direction[sum->rank[k] - (turned ? sum->classes : 0)], d) != 0) return false;
        if ((sunder_i_direction_half(l, d) == 1) != turned) return false;
    }
    return true;
}

static const char *try_case(rng *r, bool wide)
{
    sunder_i_lattice l;
    double origin[1][2];
    sunder_i_extent extent = {0};
    const double ends[] = {-64, -64, 64, 63};
    sunder_i_extent_add(&extent, ends, 2);
    sunder_i_lattice_init(&l, &extent, 1, false, origin, wide);
    piece p, q, sum;
    random_piece(r, &p);
    random_piece(r, &q);
    sunder_i_convex_pieces a, b, s, *const list[] = {&a, &b};
    sunder_i_directions directions;
    list_of(&l, &p, &a);
    list_of(&l, &q, &b);
    assert_true(sunder_i_convex_pieces_rank(&l, list, 2, &directions));
    assert_true(sunder_i_convex_pieces_sum(&a, &b, &s));
    read_sum(&l, &s, &p, &q, &sum);
    place all[MOST * MOST], want[MOST * MOST + 1], got[MOST];
    int n = 0;
    for (int i = 0; i < p.n; i++)
        for (int j = 0; j < q.n; j++) all[n++] = (place){p.at[i].x + q.at[j].x, p.at[i].y + q.at[j].y};
    const int corners = hull(all, n, want), strict = strict_corners(&sum, got);
    const char *wrong = sunder_i_convex_pieces_check(&a);
    if (!wrong) wrong = sunder_i_convex_pieces_check(&b);
    if (!wrong) wrong = sunder_i_convex_pieces_check(&s);
    if (!wrong && sum.n != (int)s.corners) wrong = "a corner is no sum of corners";
    if (!wrong && (strict != corners || memcmp(got, want, (size_t)corners * sizeof *got))) wrong = "not the hull";
    if (!wrong && !directions_agree(&l, &s)) wrong = "a rank belongs to another direction";
    if (!wrong && !candidates_agree(&sum, &p, &q)) wrong = "a side is wrongly a candidate, or wrongly not";
    sunder_i_convex_pieces_free(&a);
    sunder_i_convex_pieces_free(&b);
    sunder_i_convex_pieces_free(&s);
    sunder_i_directions_free(&directions);
    sunder_i_lattice_free(&l);
    return wrong;
}

static void test_sums_are_hulls(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t count = test_count(4000);
    print_message("SUNDER_SEED=%llu, %zu cases\n", (unsigned long long)seed, count);
    for (size_t i = 0; i < count; i++) {
        rng r = rng_start(seed, i);
        const char *wrong = try_case(&r, i % 4 == 0);
        if (wrong) fail_msg("SUNDER_SEED=%llu, case %zu: %s", (unsigned long long)seed, i, wrong);
    }
}

/* The checker finds descending ranks, and corners with too large a turn. */
static void test_checker(void **state)
{
    (void)state;
    uint32_t end[] = {4}, rank[] = {0, 1, 2, 3};
    const sunder_i_convex_pieces square = {.n = 1, .corners = 4, .end = end, .rank = rank, .classes = 2};
    assert_null(sunder_i_convex_pieces_check(&square));
    rank[1] = 3;
    assert_string_equal(sunder_i_convex_pieces_check(&square), "a piece turns by half a turn or more at a corner");
    rank[1] = 1;
    rank[2] = 0;
    assert_string_equal(sunder_i_convex_pieces_check(&square), "the ranks of a piece fall");
    for (uint32_t k = 0; k < 4; k++) rank[k] = k + 1;
    assert_string_equal(sunder_i_convex_pieces_check(&square), "a side has a rank past the last");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sums_are_hulls),
        cmocka_unit_test(test_checker),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
