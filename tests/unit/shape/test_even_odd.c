/* shape: difficult rings on a small grid (rings that cross themselves, that run back along themselves, self-touching
 * points, touching and coincident holes). Every invariant of the shape is checked, and membership of random points is
 * compared with a count of crossings of the input rings. */
#include "gmp_numbers.h"
#include "polyset.h"
#include "random.h"
#include "shape/shape.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define CASES 3000
#define POINTS 24
#define DEN 101 /* spacing of sample points; odd and larger than the grid, so that few lie on edges */

/* A ring that repeatedly returns to places and edges used before. */
static void nasty_ring(polyset *set, rng *g, int64_t span, size_t most)
{
    double xy[64];
    const size_t n = (size_t)rng_int(g, 3, (int64_t)most);
    for (size_t i = 0; i < n; i++) {
        const int kind = (int)rng_int(g, 0, 9);
        double *p = xy + 2 * i;
        if (kind == 0 && i > 0) {
            memcpy(p, xy + 2 * (i - 1), 2 * sizeof *p); /* repeats the last point */
        } else if (kind == 1 && i > 1) {
            memcpy(p, xy + 2 * (size_t)rng_int(g, 0, (int64_t)i - 2), 2 * sizeof *p); /* a place used before */
        } else if (kind <= 3 && i > 0) {
            p[0] = kind == 2 ? p[-2] : (double)rng_int(g, 0, span); /* along an axis */
            p[1] = kind == 2 ? (double)rng_int(g, 0, span) : p[-1];
        } else {
            p[0] = (double)rng_int(g, 0, span);
            p[1] = (double)rng_int(g, 0, span);
        }
    }
    polyset_ring(set, xy, n);
}

static void nasty_set(polyset *set, rng *g)
{
    const int64_t span = rng_int(g, 2, 9), polygons = rng_once_in(g, 4) ? 2 : 1;
    for (int64_t p = 0; p < polygons; p++) {
        const int64_t rings = rng_once_in(g, 2) ? 1 : rng_int(g, 2, 4);
        for (int64_t r = 0; r < rings; r++) nasty_ring(set, g, span, rng_once_in(g, 5) ? 20 : 7);
        polyset_end_polygon(set);
    }
}

/* Long walks along the eight directions of a small board: crossings on half-integers only, edges covered many times,
 * dozens of passages through one point. Large enough for the grids and trees that small rings do not use. */
static void walk_set(polyset *set, rng *g)
{
    static const int step[8][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    const int64_t span = rng_int(g, 4, 9), rings = rng_int(g, 1, 3);
    for (int64_t r = 0; r < rings; r++) {
        int64_t x = rng_int(g, 0, span), y = rng_int(g, 0, span);
        for (int64_t n = rng_int(g, 20, 150); n > 0; n--) {
            const int d = (int)rng_int(g, 0, 7);
            const int64_t far = rng_int(g, 1, 3);
            const int64_t nx = x + far * step[d][0], ny = y + far * step[d][1];
            if (nx < 0 || ny < 0 || nx > span || ny > span) continue;
            x = nx;
            y = ny;
            polyset_vertex(set, (double)x, (double)y);
        }
        polyset_vertex(set, (double)x, (double)y);
        polyset_end_ring(set);
    }
    polyset_end_polygon(set);
}

/* Is the point (x, y) / DEN inside by the even-odd rule (1), outside (0), or on an edge (-1)? All numbers are small. */
static int even_odd(const polyset *set, size_t ring_lo, size_t ring_hi, int64_t x, int64_t y)
{
    int inside = 0;
    for (size_t ring = ring_lo; ring < ring_hi; ring++) {
        const size_t lo = ring ? set->ring_end[ring - 1] : 0, hi = set->ring_end[ring];
        for (size_t i = lo, j = hi - 1; i < hi; j = i++) {
            const int64_t ax = (int64_t)set->xy[2 * j] * DEN, ay = (int64_t)set->xy[2 * j + 1] * DEN;
            const int64_t bx = (int64_t)set->xy[2 * i] * DEN, by = (int64_t)set->xy[2 * i + 1] * DEN;
            const int64_t cross = (bx - ax) * (y - ay) - (by - ay) * (x - ax);
            if (cross == 0 && (x - ax) * (x - bx) + (y - ay) * (y - by) <= 0) return -1;
            if ((ay > y) != (by > y) && (cross > 0) == (by > ay)) inside ^= 1;
        }
    }
    return inside;
}

/* The winding number of a ring around a point that is not on any of its edges. */
static int winding(const polyset *set, size_t ring, int64_t x, int64_t y)
{
    const size_t lo = ring ? set->ring_end[ring - 1] : 0, hi = set->ring_end[ring];
    int n = 0;
    for (size_t i = lo, j = hi - 1; i < hi; j = i++) {
        const int64_t ax = (int64_t)set->xy[2 * j] * DEN, ay = (int64_t)set->xy[2 * j + 1] * DEN;
        const int64_t bx = (int64_t)set->xy[2 * i] * DEN, by = (int64_t)set->xy[2 * i + 1] * DEN;
        if ((ay > y) == (by > y)) continue;
        const int64_t cross = (bx - ax) * (y - ay) - (by - ay) * (x - ax);
        if ((cross > 0) == (by > ay)) n += by > ay ? 1 : -1;
    }
    return n;
}

/* Properties of a valid polygon at any point: every ring winds around it once or not at all, always in the same
 * direction; at most one hole contains it, and then the outer ring does, too. */
static bool looks_sound(const polyset *set, rng *g)
{
    int way[64] = {0};
    assert_true(set->rings <= 64);
    for (int k = 0; k < POINTS; k++) {
        const int64_t x = rng_int(g, 0, 9 * DEN), y = rng_int(g, 0, 9 * DEN);
        for (size_t p = 0, ring = 0; p < set->polygons; ring = set->poly_end[p++]) {
            if (even_odd(set, ring, set->poly_end[p], x, y) < 0) continue;
            int holes = 0, outer = 0;
            for (size_t r = ring; r < set->poly_end[p]; r++) {
                const int w = winding(set, r, x, y);
                if (w == 0) continue;
                if (w < -1 || w > 1 || w == -way[r]) return false;
                way[r] = w;
                holes += r > ring;
                outer += r == ring;
            }
            if (holes > outer) return false;
        }
    }
    return true;
}

/* A set of polygons, each by the even-odd rule: is the point inside any of them? */
static int in_set(const polyset *set, int64_t x, int64_t y)
{
    int inside = 0;
    for (size_t p = 0, ring = 0; p < set->polygons; ring = set->poly_end[p++]) {
        const int in = even_odd(set, ring, set->poly_end[p], x, y);
        if (in < 0) return -1;
        inside |= in;
    }
    return inside;
}

/* Coordinate i of the cleaned form, exactly. */
static void coordinate(mpq_t r, const sunder_shape *s, size_t i)
{
    const sunder_i_exact *v = s->rational ? &s->form->numbers->exact[i / 2] : NULL;
    if (!v || v->den.size == 0) {
        mpq_set_d(r, s->xy[i]);
        return;
    }
    mpz_from_big(mpq_numref(r), v->num[i & 1]);
    mpz_from_big(mpq_denref(r), v->den);
    mpq_canonicalize(r);
    if (v->exponent >= 0)
        mpq_mul_2exp(r, r, (mp_bitcnt_t)v->exponent);
    else
        mpq_div_2exp(r, r, (mp_bitcnt_t)-v->exponent);
}

/* All corners as rationals, so that each is converted only once. */
static mpq_t *coordinates(const sunder_shape *s)
{
    mpq_t *at = test_alloc(2 * (size_t)s->vertices + 1, sizeof *at);
    for (size_t i = 0; i < 2 * (size_t)s->vertices; i++) {
        mpq_init(at[i]);
        coordinate(at[i], s, i);
    }
    return at;
}

static void free_coordinates(mpq_t *at, const sunder_shape *s)
{
    for (size_t i = 0; i < 2 * (size_t)s->vertices; i++) mpq_clear(at[i]);
    free(at);
}

/* Is (x, y) / DEN in some piece, which is a closed set? */
static bool in_pieces(const sunder_shape *s, mpq_t *at, int64_t x, int64_t y)
{
    bool found = false;
    mpq_t p[2], u, v, w, z;
    mpq_inits(p[0], p[1], u, v, w, z, NULL);
    mpq_set_si(p[0], x, DEN);
    mpq_set_si(p[1], y, DEN);
    mpq_canonicalize(p[0]);
    mpq_canonicalize(p[1]);
    for (uint32_t i = 0, lo = 0; i < s->pieces && !found; lo = s->piece_end[i++]) {
        bool in = true;
        for (uint32_t k = lo; k < s->piece_end[i] && in; k++) {
            mpq_t *a = at + 2 * (size_t)sunder_i_piece_vertices(s)[k];
            mpq_t *b = at + 2 * (size_t)sunder_i_piece_vertices(s)[k + 1 < s->piece_end[i] ? k + 1 : lo];
            mpq_sub(u, b[0], a[0]);
            mpq_sub(v, p[1], a[1]);
            mpq_mul(w, u, v);
            mpq_sub(u, b[1], a[1]);
            mpq_sub(v, p[0], a[0]);
            mpq_mul(z, u, v);
            in = mpq_cmp(w, z) >= 0;
        }
        found = in;
    }
    mpq_clears(p[0], p[1], u, v, w, z, NULL);
    return found;
}

static void explain(const polyset *set, uint64_t i, const char *what)
{
    char *text = polyset_wkt(set);
    fail_msg("SUNDER_SEED=%llu, case %llu: %s: %s", (unsigned long long)test_seed(), (unsigned long long)i, what, text);
}

static void check_members(const polyset *set, const sunder_shape *s, rng *g, uint64_t i)
{
    mpq_t *at = coordinates(s);
    for (int k = 0; k < POINTS; k++) {
        const int64_t x = rng_int(g, -DEN, 10 * DEN), y = rng_int(g, -DEN, 10 * DEN);
        const int in = in_set(set, x, y);
        if (in >= 0 && in_pieces(s, at, x, y) != (in == 1)) explain(set, i, "a point is on the wrong side");
    }
    free_coordinates(at, s);
}

/* The same set, flat and far wider than a narrow lattice allows: everything is decided in big integers, with the same
 * result. */
static void check_wide(const polyset *set, const sunder_shape *s, uint64_t i)
{
    polyset thin;
    sunder_shape *t = NULL;
    sunder_error err;
    polyset_copy(&thin, set);
    polyset_scale(&thin, 0x1p-100, 0x1p100);
    if (sunder_shape_from_rings(thin.xy, thin.ring_end, thin.poly_end, thin.polygons, SUNDER_VALIDITY_EVEN_ODD, &t,
                                &err))
        explain(set, i, err.message);
    const char *fault = sunder_i_shape_check(t);
    if (fault) explain(set, i, fault);
    if (t->vertices != s->vertices || t->form->cleaned.rings != s->form->cleaned.rings ||
        t->form->cleaned.polygons != s->form->cleaned.polygons || sunder_shape_area(t) != sunder_shape_area(s))
        explain(set, i, "on a wide lattice the set differs");
    for (size_t k = 0; k < 2 * (size_t)s->vertices; k++)
        if (t->xy[k] != s->xy[k] * (k & 1 ? 0x1p100 : 0x1p-100)) explain(set, i, "on a wide lattice a corner differs");
    sunder_shape_free(t);
    polyset_free(&thin);
}

static void check_case(const polyset *set, rng *g, uint64_t i, size_t *strict)
{
    sunder_shape *s = NULL, *t = NULL;
    sunder_error err;
    if (sunder_shape_from_rings(set->xy, set->ring_end, set->poly_end, set->polygons, SUNDER_VALIDITY_EVEN_ODD, &s,
                                &err))
        explain(set, i, err.message);
    const char *fault = sunder_i_shape_check(s);
    if (fault) explain(set, i, fault);
    check_members(set, s, g, i);
    if (i % 4 == 0) check_wide(set, s, i);
    const sunder_status status =
        sunder_shape_from_rings(set->xy, set->ring_end, set->poly_end, set->polygons, SUNDER_VALIDITY_STRICT, &t, &err);
    if (status != (sunder_shape_repaired(s) ? SUNDER_EINVALID : SUNDER_OK))
        explain(set, i, "strict and even-odd do not agree on validity");
    if (status == SUNDER_OK) {
        ++*strict;
        if (!looks_sound(set, g)) explain(set, i, "an invalid polygon was accepted");
        fault = sunder_i_shape_check(t);
        if (fault) explain(set, i, fault);
        if (sunder_shape_area(s) != sunder_shape_area(t)) explain(set, i, "strict and even-odd differ in area");
        sunder_shape_free(t);
    }
    sunder_shape_free(s);
}

static void test_nasty_rings(void **state)
{
    (void)state;
    const size_t n = test_count(CASES);
    size_t strict = 0;
    for (uint64_t i = 0; i < n; i++) {
        rng g = rng_start(test_seed(), i);
        polyset set;
        polyset_init(&set);
        nasty_set(&set, &g);
        check_case(&set, &g, i, &strict);
        polyset_free(&set);
    }
    /* Both valid and invalid sets occurred. */
    assert_true(strict > n / 100);
    assert_true(strict < n);
}

static void test_long_walks(void **state)
{
    (void)state;
    const size_t n = test_count(CASES / 30);
    size_t strict = 0;
    for (uint64_t i = 0; i < n; i++) {
        rng g = rng_start(test_seed(), i + 1000000);
        polyset set;
        polyset_init(&set);
        walk_set(&set, &g);
        check_case(&set, &g, i, &strict);
        polyset_free(&set);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_nasty_rings), cmocka_unit_test(test_long_walks)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
