/* The nodes that are visible from a node: none is missing, for any coordinates, and most others are excluded. Legs are
 * compared with the exact test, turns with exact orientations. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "motion/visibility.h"
#include "random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PIECES 36

typedef struct scene {
    sunder_i_free_space space;
    sunder_i_corners corners;
    sunder_i_visibility view;
    bool *seen; /* [nodes] visible in the last query */
} scene;

enum { WHOLE, MAP, RAGGED, FAR, WIDE, KINDS };

/* A coordinate of one kind: integers; map coordinates that use all bits; arbitrary doubles. */
static double put(rng *r, int kind, int64_t whole)
{
    if (kind == MAP) return 13000000 + 0x1p-28 * (double)(whole * (1 << 20) + rng_int(r, 0, 1 << 12));
    if (kind == RAGGED) return ((double)whole + rng_unit(r) / 4) * 1e-3;
    return (double)whole;
}

/* Boxes, segments and points on a loose grid, which sometimes touch and overlap. */
static size_t make_obstacles(rng *r, int kind, double (*xy)[10], size_t *ends, sunder_obstacle *out,
                             sunder_shape **shapes)
{
    size_t n = 0;
    for (int64_t i = 0; i < PIECES; i++) {
        const int64_t x = 9 * (i % 6) + rng_int(r, -2, 2), y = 9 * (i / 6) + rng_int(r, -2, 2);
        const int64_t w = rng_int(r, 1, 9), h = rng_int(r, 1, 9);
        const double x0 = put(r, kind, x), y0 = put(r, kind, y), x1 = put(r, kind, x + w), y1 = put(r, kind, y + h);
        const double box[] = {x0, y0, x1, y0, x1, y1, x0, y1};
        memcpy(xy[i], box, sizeof box);
        ends[i] = 1 + (size_t)rng_int(r, 0, 1) * 2; /* a point, or a line with a bend */
        shapes[i] = NULL;
        if (rng_once_in(r, 5)) continue;
        if (rng_once_in(r, 5)) {
            out[n++] = (sunder_obstacle){NULL, xy[i], &ends[i], 1};
            continue;
        }
        const size_t corners = rng_once_in(r, 3) ? 3 : 4, one = 1;
        assert_int_equal(sunder_shape_from_rings(box, &corners, &one, 1, SUNDER_VALIDITY_STRICT, &shapes[i], NULL),
                         SUNDER_OK);
        out[n++] = (sunder_obstacle){shapes[i], NULL, NULL, 0};
    }
    static const double away[2][2] = {{1e16, -3e17}, {1e300, 0x1p-1074}};
    static const size_t single = 1;
    if (kind >= FAR) out[n++] = (sunder_obstacle){NULL, away[kind - FAR], &single, 1};
    return n;
}

static sunder_shape *make_robot(rng *r, int kind)
{
    static const double square[] = {-1, -1, 1, -1, 1, 1, -1, 1}, bent[] = {0, 0, 3, 0, 3, 1, 1, 1, 1, 2, 0, 2};
    const bool l = rng_once_in(r, 3);
    const size_t n = l ? 6 : 4, one = 1;
    const double scale = kind == MAP ? 0x1p-8 : kind == RAGGED ? 1e-3 : 1;
    double xy[12];
    for (size_t i = 0; i < 2 * n; i++) xy[i] = scale * (l ? bent[i] : square[i]);
    sunder_shape *s;
    assert_int_equal(sunder_shape_from_rings(xy, &n, &one, 1, SUNDER_VALIDITY_STRICT, &s, NULL), SUNDER_OK);
    return s;
}

/* A random free place. */
static sunder_i_filtered_point somewhere(rng *r, int kind, const sunder_i_free_space *space)
{
    for (;;) {
        const double x = put(r, kind, rng_int(r, -6, 64)), y = put(r, kind, rng_int(r, -6, 64)), xy[2] = {x, y};
        const sunder_i_filtered_point p = sunder_i_filtered_of_double(space->sum, space->filter.lattice, xy);
        if (sunder_i_leg_is_free(space, &p, &p, false, NULL)) return p;
    }
}

static void make_scene(rng *r, int kind, scene *s)
{
    double xy[PIECES][10];
    size_t ends[PIECES];
    sunder_obstacle obstacle[PIECES + 1];
    sunder_shape *shapes[PIECES], *robot = make_robot(r, kind);
    const size_t n = make_obstacles(r, kind, xy, ends, obstacle, shapes);
    assert_int_equal(sunder_i_free_space_build(obstacle, n, robot, 0, NULL, &s->space, NULL), SUNDER_OK);
    for (size_t i = 0; i < PIECES; i++) sunder_shape_free(shapes[i]);
    sunder_shape_free(robot);
    const sunder_i_filtered_point start = somewhere(r, kind, &s->space), goal = somewhere(r, kind, &s->space);
    assert_int_equal(sunder_i_corners_find(&s->space, &start, &goal, &s->corners, NULL), SUNDER_OK);
    assert_true(sunder_i_visibility_init(&s->view, &s->space, &s->corners));
    s->seen = calloc(s->corners.nodes, sizeof *s->seen);
    assert_non_null(s->seen);
}

static void free_scene(scene *s)
{
    sunder_i_visibility_free(&s->view);
    sunder_i_corners_free(&s->corners);
    sunder_i_free_space_free(&s->space);
    free(s->seen);
}

static void look(scene *s, uint32_t v, uint32_t before, double room)
{
    memset(s->seen, 0, s->corners.nodes * sizeof *s->seen);
    sunder_i_visibility_look(&s->view, v, before, room);
    for (size_t i = 0; i < s->view.seen_n; i++) s->seen[s->view.seen[i]] = true;
}

static const sunder_i_filtered_point *place(const scene *s, uint32_t node)
{
    return &s->corners.place[s->corners.node[node]];
}

static bool is_free(const scene *s, uint32_t v, uint32_t w)
{
    return sunder_i_leg_is_free(&s->space, place(s, v), place(s, w), false, NULL);
}

/* The sides of the neighbours of the plain corner v relative to the line pq, in *lowest and *highest; returns false if
 * v is not a plain corner. */
static bool sides(const scene *s, uint32_t v, const sunder_i_filtered_point *p, const sunder_i_filtered_point *q,
                  int *lowest, int *highest)
{
    const uint32_t *beside = s->corners.beside[s->corners.node[v]];
    *lowest = *highest = 0;
    if (beside[0] == SUNDER_I_NO_PLACE) return false;
    for (int k = 0; k < 2; k++) {
        const int side = sunder_i_filtered_orient(&s->space.filter, p, q, &s->corners.place[beside[k]]);
        if (side < *lowest) *lowest = side;
        if (side > *highest) *highest = side;
    }
    return true;
}

/* May a shortest path that comes along pq have a vertex at v, as far as that corner is concerned? */
static bool is_tangent(const scene *s, uint32_t v, const sunder_i_filtered_point *p, const sunder_i_filtered_point *q)
{
    int low, high;
    return !sides(s, v, p, q, &low, &high) || low == 0 || high == 0;
}

/* Can a shortest path come from u to v and continue to w? */
static bool is_taut(const scene *s, uint32_t u, uint32_t v, uint32_t w)
{
    int low[2], high[2];
    const sunder_i_filtered_point *a = place(s, u), *b = place(s, v), *c = place(s, w);
    if (!sides(s, v, a, b, &low[0], &high[0])) return true;
    sides(s, v, b, c, &low[1], &high[1]);
    const int turn = sunder_i_filtered_orient(&s->space.filter, a, b, c);
    if (turn > 0) return low[0] == 0 && low[1] == 0;
    if (turn < 0) return high[0] == 0 && high[1] == 0;
    /* Does bc continue ab straight on? The reverse direction does not count. */
    const sunder_i_filter *g = &s->space.filter;
    return sunder_i_filtered_cmp(g, a, b) == sunder_i_filtered_cmp(g, b, c);
}

/* Counts the nodes visible from v and those that have to be, and demands that each of the latter is found. */
static void check_look(const scene *s, uint32_t before, uint32_t v, double room, size_t *needed)
{
    const uint32_t nodes = s->corners.nodes, start = nodes - 2, goal = nodes - 1;
    for (uint32_t w = 0; w < nodes; w++) {
        if (w == v || w == start || s->seen[w]) continue;
        const double length =
            sunder_i_visibility_distance(&s->view, v, w) + sunder_i_visibility_distance(&s->view, w, goal);
        if (length > room * (1 - 1e-9) || !is_free(s, v, w)) continue;
        if (w != goal && !is_tangent(s, w, place(s, v), place(s, w))) continue;
        assert_true(before != SUNDER_I_NO_NODE && !is_taut(s, before, v, w));
    }
    *needed += s->view.seen_n;
}

static void nothing_is_missed(void **state)
{
    (void)state;
    size_t all = 0, seen = 0, after = 0, onward = 0;
    for (size_t i = 0, n = test_count(15); i < n; i++) {
        rng r = rng_start(test_seed(), i);
        scene s;
        make_scene(&r, (int)(i % KINDS), &s);
        const uint32_t nodes = s.corners.nodes;
        for (uint32_t v = 0; v < nodes; v++) {
            look(&s, v, SUNDER_I_NO_NODE, INFINITY);
            check_look(&s, SUNDER_I_NO_NODE, v, INFINITY, &seen);
            all += nodes;
            const double room = sunder_i_visibility_distance(&s.view, v, nodes - 1) * (1 + rng_unit(&r));
            size_t unused = 0;
            look(&s, v, SUNDER_I_NO_NODE, room);
            check_look(&s, SUNDER_I_NO_NODE, v, room, &unused);
            const uint32_t u = (uint32_t)rng_int(&r, 0, nodes - 1);
            if (u == v || v >= nodes - 2 || !is_free(&s, u, v) || !is_tangent(&s, v, place(&s, u), place(&s, v)))
                continue;
            look(&s, v, u, INFINITY);
            check_look(&s, u, v, INFINITY, &onward);
            after += nodes;
        }
        free_scene(&s);
    }
    /* Otherwise the test could not fail: most nodes have to be hidden, and even more after a leg. */
    print_message("of %zu nodes %zu are seen; of %zu after a leg %zu\n", all, seen, after, onward);
    assert_true(all > 1000 && after > 1000);
    assert_true(seen > all / 100 && seen < all / 4);
    assert_true(onward > after / 1000 && onward < after / 8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(nothing_is_missed)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
