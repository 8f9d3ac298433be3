/* The width of random shapes: of some it is a whole number by construction, and the limits around it are decided to the
 * last bit. For others an oracle in rationals searches squares for a disc of a diameter somewhat above or below. */
#include "generate.h"
#include "rational_plane.h"
#include "sunder_legible.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static bool is_narrow(const sunder_shape *shape, double limit, double *has)
{
    const sunder_legible_limits limits = {.width = limit};
    sunder_illegible *found;
    size_t n;
    assert_int_equal(sunder_shape_illegible(shape, &limits, &found, &n, NULL), SUNDER_OK);
    if (n && has) *has = found[0].has;
    sunder_free(found);
    return n > 0;
}

/* ---- Widths that are known --------------------------------------------------------------------------------------- */

/* Turns the corners by the angle of the triangle with the sides a, b, c, which makes them c times as large. */
static void add_turned(polyset *set, double *xy, size_t n, double a, double b, const double by[2])
{
    for (size_t k = 0; k < n; k++) {
        const double x = xy[2 * k], y = xy[2 * k + 1];
        xy[2 * k] = a * x - b * y + by[0];
        xy[2 * k + 1] = b * x + a * y + by[1];
    }
    polyset_polygon(set, xy, n);
}

/* A right triangle, a rectangle, or a square without its corners, whose largest disc touches four reflex corners.
 * Returns the width. */
static double known_shape(polyset *set, rng *r, uint64_t i)
{
    static const double triple[4][3] = {{3, 4, 5}, {5, 12, 13}, {8, 15, 17}, {7, 24, 25}};
    const double *t = triple[rng_int(r, 0, 3)], *turn = triple[rng_int(r, 0, 3)];
    const double u = (double)rng_int(r, 1, 9), by[2] = {(double)rng_int(r, -9999, 9999), 5e6};
    const double a = u * t[0], b = u * t[1], s = (double)rng_int(r, 1, 40), e = a + b + s;
    double triangle[] = {0, 0, 2 * a, 0, 0, 2 * b}, rectangle[] = {0, 0, a + s, 0, a + s, a, 0, a};
    double cross[] = {-a, -b, -a, -e, a, -e, a, -b, e, -b, e, b, a, b, a, e, -a, e, -a, b, -e, b, -e, -b};
    if (i % 3 == 0) add_turned(set, triangle, 3, turn[0], turn[1], by);
    if (i % 3 == 1) add_turned(set, rectangle, 4, turn[0], turn[1], by);
    if (i % 3 == 2) add_turned(set, cross, 12, turn[0], turn[1], by);
    return turn[2] * (i % 3 == 0 ? 2 * u * (t[0] + t[1] - t[2]) : i % 3 == 1 ? a : 2 * u * t[2]);
}

static void test_known(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < test_count(300); i++) {
        rng r = rng_start(test_seed() + 4200, i);
        polyset set;
        polyset_init(&set);
        const double width = known_shape(&set, &r, i);
        sunder_shape *shape = polyset_shape(&set);
        if (is_narrow(shape, width, NULL) || is_narrow(shape, nextafter(width, 0), NULL) ||
            !is_narrow(shape, nextafter(width, INFINITY), NULL)) {
            char *wkt = polyset_wkt(&set);
            fail_msg("width %.17g of %s", width, wkt);
        }
        sunder_shape_free(shape);
        polyset_free(&set);
    }
}

/* ---- A search in squares ----------------------------------------------------------------------------------------- */

#define SQUARES_MAX 20000
#define DEPTH 12

typedef struct square {
    mpq_t x, y, half;
    int depth;
} square;

/* The squared distance of a point from an edge. */
static void edge_square(mpq_t out, const vec *at, const vec *a, const vec *b)
{
    vec u, v;
    mpq_t t, zero;
    vec_init(&u);
    vec_init(&v);
    mpq_inits(t, zero, NULL);
    vec_sub(&u, b, a);
    vec_sub(&v, at, a);
    vec_dot(t, &u, &v);
    vec_dot(out, &u, &u);
    mpq_div(t, t, out);
    if (mpq_sgn(t) < 0) mpq_set(t, zero);
    if (mpq_cmp_ui(t, 1, 1) > 0) mpq_set_ui(t, 1, 1);
    mpq_mul(u.x, u.x, t);
    mpq_mul(u.y, u.y, t);
    vec_sub(&v, &v, &u);
    vec_dot(out, &v, &v);
    mpq_clears(t, zero, NULL);
    vec_clear(&u);
    vec_clear(&v);
}

/* Is a point inside the rings of polygon 0, by the edges that a ray to its right crosses? *least: the squared distance
 * from them. */
static bool locate(const sunder_shape *shape, const vec *at, mpq_t least)
{
    bool inside = false, first = true;
    vec a, b;
    mpq_t d;
    vec_init(&a);
    vec_init(&b);
    mpq_init(d);
    for (size_t ring = 0; ring < sunder_shape_rings(shape, 0); ring++) {
        size_t n;
        const double *xy = sunder_shape_ring(shape, 0, ring, &n);
        for (size_t k = 0; k < n; k++, first = false) {
            vec_set_d(&a, xy + 2 * k);
            vec_set_d(&b, xy + 2 * ((k + 1) % n));
            edge_square(d, at, &a, &b);
            if (first || mpq_cmp(d, least) < 0) mpq_set(least, d);
            const bool up = mpq_cmp(a.y, at->y) <= 0, down = mpq_cmp(b.y, at->y) <= 0;
            if (up != down) inside ^= vec_side(&a, &b, at) == (up ? 1 : -1);
        }
    }
    mpq_clear(d);
    vec_clear(&a);
    vec_clear(&b);
    return inside;
}

/* What a square says: 1: a disc of the radius fits about its centre; 0: about none of its points; -1: unknown. A point
 * of it is at most 3 / 2 of its half side from the centre. */
static int ask_square(const sunder_shape *shape, const square *s, const mpq_t radius)
{
    vec at;
    mpq_t d, reach, r;
    vec_init(&at);
    mpq_inits(d, reach, r, NULL);
    mpq_set(at.x, s->x);
    mpq_set(at.y, s->y);
    const bool inside = locate(shape, &at, d);
    mpq_set_ui(reach, 3, 2);
    mpq_mul(reach, reach, s->half);
    mpq_mul(r, radius, radius);
    int answer = -1;
    if (inside && mpq_cmp(d, r) >= 0)
        answer = 1;
    else { /* inside: d + reach < radius; outside: reach - d < radius */
        mpq_sub(r, radius, reach);
        const int sign = mpq_sgn(r);
        mpq_mul(r, r, r);
        const int order = mpq_cmp(d, r);
        if (inside ? sign > 0 && order < 0 : sign > 0 || order > 0) answer = 0;
    }
    mpq_clears(d, reach, r, NULL);
    vec_clear(&at);
    return answer;
}

static square *add_square(square *list, size_t *n, const square *of, int quarter)
{
    square *s = &list[(*n)++];
    mpq_inits(s->x, s->y, s->half, NULL);
    mpq_set_ui(s->half, 1, 2);
    mpq_mul(s->half, s->half, of->half);
    (quarter & 1 ? mpq_add : mpq_sub)(s->x, of->x, s->half);
    (quarter & 2 ? mpq_add : mpq_sub)(s->y, of->y, s->half);
    s->depth = of->depth + 1;
    return s;
}

/* Does a disc of the diameter lie in polygon 0? 1, 0, or -1 if the squares do not tell. */
static int holds_disc(const sunder_shape *shape, double diameter)
{
    square *list = malloc(SQUARES_MAX * sizeof *list), root = {.depth = 0};
    size_t n = 0;
    double box[4];
    mpq_t radius, two;
    sunder_shape_box(shape, box);
    mpq_inits(radius, two, root.x, root.y, root.half, NULL);
    mpq_set_d(radius, diameter);
    mpq_set_ui(two, 2, 1);
    mpq_div(radius, radius, two);
    mpq_set_d(root.x, floor((box[0] + box[2]) / 2));
    mpq_set_d(root.y, floor((box[1] + box[3]) / 2));
    mpq_set_d(root.half, ceil(fmax(box[2] - box[0], box[3] - box[1])));
    int answer = 0;
    for (int q = 0; q < 4; q++) add_square(list, &n, &root, q);
    for (size_t k = 0; k < n && answer != 1; k++) {
        const int here = ask_square(shape, &list[k], radius);
        if (here == 1) answer = 1;
        if (here >= 0) continue;
        if (list[k].depth == DEPTH || n + 4 > SQUARES_MAX)
            answer = -1;
        else
            for (int q = 0; q < 4; q++) add_square(list, &n, &list[k], q);
    }
    for (size_t k = 0; k < n; k++) mpq_clears(list[k].x, list[k].y, list[k].half, NULL);
    mpq_clears(radius, two, root.x, root.y, root.half, NULL);
    free(list);
    return answer;
}

static void random_shape(polyset *set, rng *r, uint64_t i)
{
    cells c;
    if (i % 3 == 0) random_simple(set, r, (int)rng_int(r, 3, 8), 12);
    if (i % 3 == 1) random_star(set, r, (int)rng_int(r, 4, 9), 20);
    if (i % 3 == 2) {
        random_cells(&c, r, 3, 3, SPACING_SMALL, rng_once_in(r, 2), 80);
        cells_outline(set, &c, rng_once_in(r, 2), true);
    }
}

/* The library's answer changes within a millionth of the width that it reports, and the oracle's between 0.99 and
 * 1.01. */
static bool is_right(const sunder_shape *shape, size_t *decided)
{
    double has = 0;
    if (!is_narrow(shape, 1e6, &has)) return false;
    if (is_narrow(shape, has * (1 - 1e-6), NULL) || !is_narrow(shape, has * (1 + 1e-6), NULL)) return false;
    const int less = holds_disc(shape, has * 0.99), more = holds_disc(shape, has * 1.01);
    *decided += (size_t)(less >= 0) + (size_t)(more >= 0);
    return less != 0 && more != 1;
}

static void test_random(void **state)
{
    (void)state;
    size_t decided = 0, shapes = 0;
    for (uint64_t i = 0; i < test_count(60); i++) {
        rng r = rng_start(test_seed() + 4300, i);
        polyset set;
        polyset_init(&set);
        random_shape(&set, &r, i);
        sunder_shape *shape = polyset_shape(&set);
        if (sunder_shape_polygons(shape) == 1) {
            shapes++;
            if (!is_right(shape, &decided)) {
                char *wkt = polyset_wkt(&set);
                fail_msg("case %d: %s", (int)i, wkt);
            }
        }
        sunder_shape_free(shape);
        polyset_free(&set);
    }
    printf("%zu shapes, %zu of %zu questions decided\n", shapes, decided, 2 * shapes);
    assert_true(decided > shapes && shapes > 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_known), cmocka_unit_test(test_random)};
    printf("seed %llu\n", (unsigned long long)test_seed());
    return cmocka_run_group_tests(tests, NULL, NULL);
}
