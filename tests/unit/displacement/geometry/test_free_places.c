/* Free places among many convex obstacles, which the search finds through grid cells: the result is free, and as near
 * as the nearest free one of all candidates (feet of perpendiculars, crossings of sides), each tested against all
 * obstacles. */
#include "base/watch.h"
#include "displacement/geometry/grown_cache.h"
#include "random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

enum { MOST = 90, CORNERS = 9 };

/* Places on a side are not inside. Places that are nearer to a side than this count as on it. */
#define ON 1e-9

typedef struct crowd {
    double corner[MOST][CORNERS][2];
    size_t corners[MOST], n;
    double target[2];
} crowd;

/* Regular polygons, from few and far apart to many on top of each other, some far larger or thinner than the others. */
static void draw(rng *r, crowd *c)
{
    c->n = (size_t)rng_int(r, 1, MOST);
    const double spread = 1 + 9 * rng_unit(r), size = pow(10, 6 * rng_unit(r) - 3);
    const double far[2] = {size * 100 * rng_unit(r), -size * 100 * rng_unit(r)};
    for (size_t k = 0; k < c->n; k++) {
        const double x = far[0] + size * spread * (rng_unit(r) - 0.5), y = far[1] + size * spread * (rng_unit(r) - 0.5),
                     a = 6.3 * rng_unit(r), h = size * (0.5 + rng_unit(r)) * (rng_once_in(r, 12) ? 4 : 1),
                     w = h * (rng_once_in(r, 6) ? 0.02 : 1);
        c->corners[k] = (size_t)rng_int(r, 3, CORNERS);
        for (size_t m = 0; m < c->corners[k]; m++) {
            const double at = 2 * 3.14159265358979 * (double)m / (double)c->corners[k], u = w * cos(at),
                         v = h * sin(at);
            c->corner[k][m][0] = x + cos(a) * u - sin(a) * v;
            c->corner[k][m][1] = y + sin(a) * u + cos(a) * v;
        }
    }
    for (int e = 0; e < 2; e++) c->target[e] = far[e] + size * spread * (rng_unit(r) - 0.5) / 2;
}

/* The distance of x to the left of side m of obstacle k. */
static double left_of(const crowd *c, size_t k, size_t m, const double x[2])
{
    const double *p = c->corner[k][m], *q = c->corner[k][m + 1 < c->corners[k] ? m + 1 : 0];
    const double ex = q[0] - p[0], ey = q[1] - p[1];
    return (ex * (x[1] - p[1]) - ey * (x[0] - p[0])) / hypot(ex, ey);
}

static bool is_free(const crowd *c, const double x[2], double on)
{
    for (size_t k = 0; k < c->n; k++) {
        double least = INFINITY;
        for (size_t m = 0; m < c->corners[k]; m++) least = fmin(least, left_of(c, k, m, x));
        if (least > on) return false;
    }
    return true;
}

static void consider(const crowd *c, const double x[2], double on, double *best)
{
    const double d = hypot(x[0] - c->target[0], x[1] - c->target[1]);
    if (d < *best && is_free(c, x, on)) *best = d;
}

static void consider_foot(const crowd *c, const double *p, const double *q, double on, double *best)
{
    const double e[2] = {q[0] - p[0], q[1] - p[1]}, square = e[0] * e[0] + e[1] * e[1];
    const double s = ((c->target[0] - p[0]) * e[0] + (c->target[1] - p[1]) * e[1]) / square;
    if (!(s >= 0 && s <= 1)) return;
    const double x[2] = {p[0] + s * e[0], p[1] + s * e[1]};
    consider(c, x, on, best);
}

static void consider_crossing(const crowd *c, const double *p, const double *q, const double *a, const double *b,
                              double on, double *best)
{
    const double e[2] = {q[0] - p[0], q[1] - p[1]}, f[2] = {b[0] - a[0], b[1] - a[1]};
    const double turn = e[0] * f[1] - e[1] * f[0];
    const double s = ((a[0] - p[0]) * f[1] - (a[1] - p[1]) * f[0]) / turn,
                 t = ((a[0] - p[0]) * e[1] - (a[1] - p[1]) * e[0]) / turn;
    if (!(s >= 0 && s <= 1 && t >= 0 && t <= 1)) return;
    const double x[2] = {p[0] + s * e[0], p[1] + s * e[1]};
    consider(c, x, on, best);
}

/* The distance of the nearest free place, by trying all candidates. */
static double try_all(const crowd *c, double on)
{
    double best = INFINITY;
    consider(c, c->target, on, &best);
    for (size_t k = 0; k < c->n; k++)
        for (size_t m = 0; m < c->corners[k]; m++) {
            const double *p = c->corner[k][m], *q = c->corner[k][m + 1 < c->corners[k] ? m + 1 : 0];
            consider_foot(c, p, q, on, &best);
            for (size_t l = 0; l < k; l++)
                for (size_t o = 0; o < c->corners[l]; o++)
                    consider_crossing(c, p, q, c->corner[l][o], c->corner[l][o + 1 < c->corners[l] ? o + 1 : 0], on,
                                      &best);
        }
    return best;
}

static void check(const crowd *c, rng *r)
{
    sunder_i_obstacles o = {0};
    double place[1][2];
    uint64_t steps = 0;
    bool failed = false;
    for (size_t k = 0; k < c->n; k++) sunder_i_obstacles_add(&o, c->corner[k][0], c->corners[k], 0);
    const double size = hypot(o.obstacle[0].box[2] - o.obstacle[0].box[0], o.obstacle[0].box[3] - o.obstacle[0].box[1]),
                 on = ON * size, nearest = try_all(c, on);
    const double limit = rng_once_in(r, 2) ? 1000 * size : rng_unit(r) * 2 * size;
    const size_t n = sunder_i_free_places(&o, c->target, limit, 0, 1, place, &steps, &failed);
    assert_false(failed);
    if (n) {
        assert_true(is_free(c, place[0], on));
        assert_true(fabs(hypot(place[0][0] - c->target[0], place[0][1] - c->target[1]) - nearest) <= on);
    } else {
        assert_true(nearest >= limit - on);
    }
    sunder_i_obstacles_free(&o);
}

static void test_crowds(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(400);
    print_message("seed %llu, %zu crowds\n", (unsigned long long)seed, n);
    for (size_t i = 0; i < n; i++) {
        rng r = rng_start(seed, i);
        static crowd c;
        draw(&r, &c);
        check(&c, &r);
    }
}

/* Rounded corners: their resolution depends on the width of the gap; if the gap is tiny compared with the obstacle, two
 * tangents suffice. */
static void test_corners(void **state)
{
    (void)state;
    const double square[] = {0, 0, 8, 0, 8, 8, 0, 8}, needle[] = {0, 0, 8, 0, 8, 1e-3};
    sunder_i_obstacles o = {0};
    sunder_i_obstacles_add(&o, square, 4, 1);
    sunder_i_obstacles_add(&o, square, 4, 1e-9);
    sunder_i_obstacles_add(&o, needle, 3, 1e-9);
    assert_false(o.failed);
    assert_int_equal(o.obstacle[0].walls, 16);
    assert_int_equal(o.obstacle[1].walls, 4);
    assert_int_equal(o.obstacle[2].walls, 4);
    for (int k = 0; k < 2; k++) {
        assert_true(o.obstacle[2].box[k] > -2e-9 && o.obstacle[2].box[k] <= -1e-9);
        assert_true(o.obstacle[2].box[k + 2] < (k ? 1e-3 : 8) + 2e-9);
    }
    sunder_i_obstacles_free(&o);
}

/* Cached results are returned unchanged after other additions, as long as they fit into the cache. */
static void test_kept(void **state)
{
    (void)state;
    enum { ROUNDS = 40 };
    sunder_i_grown_cache cache = {0};
    size_t found = 0;
    for (uint64_t round = 0; round < ROUNDS; round++) {
        rng r = rng_start(2, round / 2);
        static crowd c;
        sunder_i_obstacles o = {0}, again = {0};
        draw(&r, &c);
        for (size_t k = 0; k < c.n; k++) {
            const sunder_i_grown_key key = {k, {c.target[0], c.target[1]}, 0.1};
            sunder_i_obstacles_add(&o, c.corner[k][0], c.corners[k], key.gap);
            assert_true(o.n == k + 1);
            if (sunder_i_grown_cache_add(&cache, &key, &again)) {
                found++;
                assert_true(round % 2);
            } else {
                sunder_i_obstacles_add(&again, c.corner[k][0], c.corners[k], key.gap);
                assert_true(sunder_i_grown_cache_keep(&cache, &key, &again));
            }
        }
        assert_true(again.n == o.n && again.walls == o.walls);
        for (size_t k = 0; k < o.n; k++) {
            assert_int_equal(again.obstacle[k].wall, o.obstacle[k].wall);
            assert_memory_equal(again.obstacle[k].box, o.obstacle[k].box, sizeof o.obstacle[k].box);
        }
        for (size_t k = 0; k < o.walls; k++) {
            assert_int_equal(again.wall[k].obstacle, o.wall[k].obstacle);
            assert_memory_equal(again.wall[k].from, o.wall[k].from, sizeof o.wall[k].from);
            assert_memory_equal(again.wall[k].to, o.wall[k].to, sizeof o.wall[k].to);
        }
        assert_memory_equal(again.line, o.line, o.walls * sizeof *o.line);
        sunder_i_obstacles_free(&o);
        sunder_i_obstacles_free(&again);
    }
    assert_true(found > 100);
    sunder_i_grown_cache_free(&cache);
}

static bool go_on_once(void *user)
{
    bool *asked = user, go_on = !*asked;
    *asked = true;
    return go_on;
}

/* A search that is stopped on request, even while its cells are made, reports failure. */
static void test_stopped(void **state)
{
    (void)state;
    static crowd c;
    size_t stopped = 0;
    for (int before = 0; before < SUNDER_I_STEPS; before++) {
        rng r = rng_start(1, (uint64_t)before);
        bool asked = false, failed = false;
        sunder_i_obstacles o = {0};
        double place[4][2];
        uint64_t steps = 0;
        draw(&r, &c);
        for (size_t k = 0; k < c.n; k++) sunder_i_obstacles_add(&o, c.corner[k][0], c.corners[k], 0);
        sunder_watch(go_on_once, &asked); /* polled at the next step, and then every SUNDER_I_STEPS steps */
        for (int k = 0; k < before; k++) sunder_i_step();
        sunder_i_free_places(&o, c.target, 1e9, 0, 4, place, &steps, &failed);
        assert_true(failed == sunder_i_stopped());
        stopped += failed;
        sunder_watch(NULL, NULL);
        sunder_i_obstacles_free(&o);
    }
    assert_true(stopped > 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_crowds), cmocka_unit_test(test_corners),
                                       cmocka_unit_test(test_kept), cmocka_unit_test(test_stopped)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
