/* The optimal convex decomposition is optimal: compared with all sets of diagonals of small simple polygons, both by
 * the number of diagonals and by their total length. */
#include "decomposition/maker.h"
#include "generate.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

typedef struct spot {
    int64_t x, y;
} spot;

static int64_t cross(spot a, spot b, spot c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }
static int sgn(int64_t v) { return (v > 0) - (v < 0); }

static bool strictly_between(spot a, spot b, spot c)
{
    if (cross(a, b, c) != 0) return false;
    return (c.x - a.x) * (c.x - b.x) + (c.y - a.y) * (c.y - b.y) < 0;
}

static bool cross_inside(spot a, spot b, spot c, spot d)
{
    return sgn(cross(a, b, c)) * sgn(cross(a, b, d)) < 0 && sgn(cross(c, d, a)) * sgn(cross(c, d, b)) < 0;
}

/* Is the open segment ij inside the polygon and free of vertices? */
static bool is_diagonal(const spot *v, int n, int i, int j)
{
    if (j == i + 1 || (i == 0 && j == n - 1)) return false;
    for (int k = 0; k < n; k++) {
        if (strictly_between(v[i], v[j], v[k])) return false;
        if (cross_inside(v[i], v[j], v[k], v[(k + 1) % n])) return false;
    }
    /* The midpoint is inside, by the parity of crossings, in doubled coordinates. */
    const spot m = {v[i].x + v[j].x, v[i].y + v[j].y};
    int crossings = 0;
    for (int k = 0; k < n; k++) {
        const spot a = {2 * v[k].x, 2 * v[k].y}, b = {2 * v[(k + 1) % n].x, 2 * v[(k + 1) % n].y};
        if ((a.y > m.y) != (b.y > m.y) && (b.y > a.y) == (cross(a, b, m) > 0)) crossings++;
    }
    return crossings & 1;
}

/* Are all angles at vertex i at most pi, with the diagonals chosen? */
static bool angles_fit(const spot *v, int n, const int (*diagonal)[2], int count, unsigned chosen, int i)
{
    /* The neighbours of i, in the order of their numbers from i on, which is counter-clockwise. */
    int last = (i + 1) % n;
    for (int step = 2; step < n; step++) {
        const int k = (i + step) % n;
        bool linked = step == n - 1;
        for (int d = 0; d < count; d++)
            linked |= chosen >> d & 1 &&
                      ((diagonal[d][0] == i && diagonal[d][1] == k) || (diagonal[d][1] == i && diagonal[d][0] == k));
        if (!linked) continue;
        const int64_t turn = cross(v[i], v[last], v[k]);
        if (turn < 0) return false;
        last = k;
    }
    return true;
}

/* Lists the diagonals of the polygon; returns their number. */
static int find_diagonals(const spot *v, int n, int (*diagonal)[2])
{
    int count = 0;
    for (int i = 0; i < n; i++)
        for (int j = i + 1; j < n; j++)
            if (is_diagonal(v, n, i, j)) {
                diagonal[count][0] = i;
                diagonal[count++][1] = j;
            }
    return count;
}

/* The least total weight of a set of diagonals that decomposes the polygon. */
static double lightest(const spot *v, int n, const int (*diagonal)[2], int count, const double *weight)
{
    double best = INFINITY;
    for (unsigned chosen = 0; chosen < 1u << count; chosen++) {
        double sum = 0;
        for (int d = 0; d < count; d++)
            if (chosen >> d & 1) sum += weight[d];
        bool ok = sum < best;
        for (int a = 0; a < count && ok; a++)
            for (int b = a + 1; b < count && ok; b++)
                if (chosen >> a & 1 && chosen >> b & 1)
                    ok = !cross_inside(v[diagonal[a][0]], v[diagonal[a][1]], v[diagonal[b][0]], v[diagonal[b][1]]);
        for (int i = 0; i < n && ok; i++) ok = angles_fit(v, n, diagonal, count, chosen, i);
        if (ok) best = sum;
    }
    return best;
}

/* Compares the program with brute force; a diagonal weighs `each` plus its length times by_length. */
static bool same_optimum(const polyset *set, double each, double by_length, double *want)
{
    sunder_shape *shape = polyset_shape(set);
    assert_non_null(shape);
    sunder_i_placed placed;
    assert_int_equal(sunder_i_place(shape, NULL, NULL, &placed, NULL), SUNDER_OK);
    spot v[16];
    int diagonal[64][2];
    double weight[64], got = 0, length = 0;
    uint32_t diagonals = 0;
    const int n = (int)shape->vertices;
    for (int k = 0; k < n; k++) v[k] = (spot){placed.p[k].x, placed.p[k].y};
    const int count = find_diagonals(v, n, diagonal);
    for (int d = 0; d < count; d++) {
        const spot a = v[diagonal[d][0]], b = v[diagonal[d][1]];
        weight[d] = each + by_length * hypot((double)(a.x - b.x), (double)(a.y - b.y));
    }
    *want = 0;
    if (count <= 18) { /* otherwise there are too many sets to try */
        *want = lightest(v, n, (const int(*)[2])diagonal, count, weight);
        sunder_i_maker m;
        assert_true(sunder_i_maker_init(&m, &placed.lattice, shape, placed.p));
        const sunder_i_member member = sunder_i_maker_member(&m, 0);
        sunder_i_program *program = sunder_i_program_new(&m, &member);
        assert_non_null(program);
        assert_true(sunder_i_program_solve(program, each, by_length, &diagonals, &length));
        got = each * diagonals + by_length * length;
        sunder_i_program_free(program);
        sunder_i_maker_free(&m);
    }
    sunder_i_placed_free(&placed);
    sunder_shape_free(shape);
    /* A few doubles are added in different orders; all terms are positive. */
    return fabs(got - *want) <= 1e-12 * *want;
}

static size_t report(const char *what, const polyset *set, uint64_t seed, size_t i)
{
    char *wkt = polyset_wkt(set);
    print_message("SUNDER_SEED=%llu, case %zu: %s\n%s\n", (unsigned long long)seed, i, what, wkt);
    free(wkt);
    return 1;
}

static void random_small(polyset *set, rng *r)
{
    polyset_init(set);
    if (rng_once_in(r, 3))
        random_star(set, r, (int)rng_int(r, 5, 9), (double)rng_int(r, 6, 40));
    else
        random_simple(set, r, (int)rng_int(r, 4, 8), (int)rng_int(r, 3, 9));
}

static void test_optimum(void **state)
{
    const uint64_t seed = test_seed();
    size_t bad = 0, more = 0;
    for (size_t i = 0; i < test_count(3000) && bad < 5; i++) {
        rng r = rng_start(seed * 47, i);
        polyset set;
        double want;
        random_small(&set, &r);
        if (!same_optimum(&set, 1, 0, &want)) bad += report("fewest pieces", &set, seed, i);
        more += want > 2;
        const double each = rng_unit(&r) + 0.01, by_length = rng_unit(&r);
        if (!same_optimum(&set, each, by_length, &want)) bad += report("lightest diagonals", &set, seed, i);
        polyset_free(&set);
    }
    assert_int_equal(bad, 0);
    assert_true(more > 10); /* enough polygons were compared */
}
int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_optimum)};
    return cmocka_run_group_tests_name("optimal convex decompositions", tests, NULL, NULL);
}
