/* Does a convex D fit into the intersection of P and Q? Compared with brute force in integers that shares no code with
 * the library. If D fits, it fits at a corner of the set of its positions, where two of these lines meet: the line of a
 * side of P or Q, moved by minus a corner of D; or the line of a side of -D, moved to a corner of P or Q. Every such
 * place is tried. Coordinates are small, so exact fits, along a line and at a point, are frequent. */
#include "failing.h"
#include "morphology/morphology.h"
#include "random.h"
#include "sunder.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

__extension__ typedef __int128 int128;

enum { MOST = 8, MOST_LINES = 512 };

typedef struct ring {
    int n;
    int64_t xy[MOST][2];
} ring;

static sunder_status make(const ring *r, int rings, const double origin[2], sunder_shape **out)
{
    double xy[4 * MOST][2];
    size_t ring_end[4], poly_end[4], n = 0;
    for (int k = 0; k < rings; k++) {
        for (int i = 0; i < r[k].n; i++, n++)
            for (int c = 0; c < 2; c++) xy[n][c] = (double)r[k].xy[i][c] + (origin ? origin[c] : 0);
        ring_end[k] = n;
        poly_end[k] = (size_t)k + 1;
    }
    return sunder_shape_from_rings(xy[0], ring_end, poly_end, (size_t)rings, SUNDER_VALIDITY_STRICT, out, NULL);
}

/* Does D fit, and is the answer the same after a translation, and with P and Q exchanged? */
static bool asked(const sunder_shape *p, const sunder_shape *q, const sunder_shape *d, rng *r)
{
    bool fits, again;
    const double t[2] = {(double)rng_int(r, -900, 900), (double)rng_int(r, -900, 900) / 4};
    assert_int_equal(sunder_i_fits_in_both(p, NULL, q, NULL, d, &fits, NULL), SUNDER_OK);
    assert_int_equal(sunder_i_fits_in_both(q, t, p, t, d, &again, NULL), SUNDER_OK);
    assert_int_equal(fits, again);
    return fits;
}

/* ---- Simple polygons --------------------------------------------------------------------------------------------- */

static int64_t cross(const int64_t a[2], const int64_t b[2], const int64_t c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* Does the segment meet the interior of the convex, counter-clockwise ring? Its part within every side's half-plane is
 * low < s < high, in fractions; a segment along a side is outside. */
static bool meets_interior(const int64_t a[2], const int64_t b[2], const ring *d)
{
    int64_t low[2] = {0, 1}, high[2] = {1, 1};
    for (int i = 0; i < d->n; i++) {
        const int64_t *p = d->xy[i], *q = d->xy[(i + 1) % d->n];
        const int64_t fa = cross(p, q, a), fb = cross(p, q, b);
        if (fa <= 0 && fb <= 0) return false;
        if (fa > 0 && fb > 0) continue;
        const int64_t num = fa > 0 ? fa : -fa, den = llabs(fa - fb);
        if (fa <= 0 && (int128)num * low[1] > (int128)low[0] * den) low[0] = num, low[1] = den;
        if (fb <= 0 && (int128)num * high[1] < (int128)high[0] * den) high[0] = num, high[1] = den;
    }
    return (int128)low[0] * high[1] < (int128)high[0] * low[1];
}

static bool holds_point(const ring *r, const int64_t at[2])
{
    bool in = false;
    for (int i = 0; i < r->n; i++) {
        const int64_t *a = r->xy[i], *b = r->xy[(i + 1) % r->n];
        if ((a[1] > at[1]) == (b[1] > at[1])) continue;
        const int64_t side = cross(a, b, at);
        if (b[1] > a[1] ? side > 0 : side < 0) in = !in;
    }
    return in;
}

/* Does D + x / w lie in the ring? All numbers are multiplied by w, and those of the centre also by the number of
 * corners. */
static bool lies_in(const ring *r, const ring *d, const int64_t x[2], int64_t w)
{
    ring at = {.n = d->n}, grown = {.n = r->n}, moved = {.n = d->n};
    int64_t middle[2] = {0, 0};
    for (int i = 0; i < d->n; i++)
        for (int c = 0; c < 2; c++) {
            at.xy[i][c] = d->xy[i][c] * w + x[c];
            middle[c] += at.xy[i][c];
            moved.xy[i][c] = at.xy[i][c] * d->n;
        }
    for (int i = 0; i < r->n; i++)
        for (int c = 0; c < 2; c++) grown.xy[i][c] = r->xy[i][c] * w * d->n;
    for (int i = 0; i < r->n; i++)
        if (meets_interior(grown.xy[i], grown.xy[(i + 1) % r->n], &moved)) return false;
    return holds_point(&grown, middle);
}

typedef struct line {
    int64_t a, b, c; /* a x + b y = c */
} line;

static size_t lines_of(const ring *r, const ring *d, line *out)
{
    size_t n = 0;
    for (int k = 0; k < 2; k++) {
        const ring *of = k ? d : r, *by = k ? r : d;
        for (int i = 0; i < of->n; i++)
            for (int j = 0; j < by->n; j++) {
                const int64_t *p = of->xy[i], *q = of->xy[(i + 1) % of->n], *v = by->xy[j];
                const int64_t a = p[1] - q[1], b = q[0] - p[0], sign = k ? -1 : 1;
                /* A side of r, moved by -v; or minus a side of D, at v. */
                out[n++] = (line){a, b, sign * (a * (p[0] - v[0]) + b * (p[1] - v[1]))};
            }
    }
    return n;
}

static bool expected(const ring *p, const ring *q, const ring *d)
{
    line l[MOST_LINES];
    size_t n = lines_of(p, d, l);
    n += lines_of(q, d, l + n);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < i; j++) {
            int64_t w = l[i].a * l[j].b - l[j].a * l[i].b;
            if (w == 0) continue;
            int64_t x[2] = {l[i].c * l[j].b - l[j].c * l[i].b, l[i].a * l[j].c - l[j].a * l[i].c};
            if (w < 0) w = -w, x[0] = -x[0], x[1] = -x[1];
            if (lies_in(p, d, x, w) && lies_in(q, d, x, w)) return true;
        }
    return false;
}

static const ring elements[] = {{4, {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}},
                                {4, {{-1, -2}, {1, -2}, {1, 2}, {-1, 2}}},
                                {3, {{-1, -1}, {2, -1}, {-1, 2}}},
                                {4, {{2, 0}, {0, 2}, {-2, 0}, {0, -2}}},
                                {6, {{2, -1}, {2, 1}, {0, 2}, {-2, 1}, {-2, -1}, {0, -2}}}};

static void random_ring(rng *r, ring *out, sunder_shape **shape)
{
    do {
        out->n = (int)rng_int(r, 3, 6);
        for (int i = 0; i < out->n; i++)
            for (int c = 0; c < 2; c++) out->xy[i][c] = rng_int(r, 0, 7) * (rng_once_in(r, 3) ? 1 : 2);
    } while (make(out, 1, NULL, shape) != SUNDER_OK);
}

static void test_polygons(void **state)
{
    const uint64_t seed = test_seed();
    size_t fitted = 0;
    const size_t cases = test_count(400);
    for (size_t i = 0; i < cases; i++) {
        rng r = rng_start(seed, i);
        ring p, q;
        sunder_shape *sp, *sq, *sd;
        const ring *d = &elements[rng_int(&r, 0, 4)];
        random_ring(&r, &p, &sp);
        random_ring(&r, &q, &sq);
        assert_int_equal(make(d, 1, NULL, &sd), SUNDER_OK);
        const bool fits = asked(sp, sq, sd, &r), should = expected(&p, &q, d);
        if (fits != should) print_message("SUNDER_SEED=%llu, case %zu\n", (unsigned long long)seed, i);
        assert_int_equal(fits, should);
        fitted += fits;
        sunder_shape_free(sp);
        sunder_shape_free(sq);
        sunder_shape_free(sd);
    }
    print_message("%zu of %zu fit, seed %llu\n", fitted, cases, (unsigned long long)seed);
    assert_true(cases < 100 || (fitted > cases / 50 && fitted < cases));
}

/* ---- Members that overlap and share walls ------------------------------------------------------------------------ */

/* A rectangle fits into a union of rectangles if all cells of a grid of half units that it contains are in the union.
 * All corners are integers, so it suffices to try integer positions, or positions in contact. */
static bool rectangles_hold(const ring *r, int n, int x0, int y0, int x1, int y1)
{
    for (int x = 2 * x0 + 1; x < 2 * x1; x += 2)
        for (int y = 2 * y0 + 1; y < 2 * y1; y += 2) {
            bool in = false;
            for (int k = 0; k < n; k++)
                in = in ||
                     (2 * r[k].xy[0][0] < x && x < 2 * r[k].xy[2][0] && 2 * r[k].xy[0][1] < y && y < 2 * r[k].xy[2][1]);
            if (!in) return false;
        }
    return true;
}

static void random_rectangles(rng *r, ring *out, int n)
{
    for (int k = 0; k < n; k++) {
        const int64_t x = rng_int(r, 0, 9), y = rng_int(r, 0, 9), w = rng_int(r, 1, 6), h = rng_int(r, 1, 6);
        out[k] = (ring){4, {{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}};
    }
}

static void test_members(void **state)
{
    const uint64_t seed = test_seed();
    const double origin[2] = {4503599.125, 5411003.0625};
    size_t fitted = 0;
    const size_t cases = test_count(600);
    for (size_t i = 0; i < cases; i++) {
        rng r = rng_start(seed ^ 0x3e3b, i);
        ring p[4], q[4];
        const int np = (int)rng_int(&r, 1, 4), nq = (int)rng_int(&r, 1, 4);
        const int64_t w = rng_int(&r, 1, 2), h = rng_int(&r, 1, 2);
        const ring d = {4, {{-w, -h}, {w, -h}, {w, h}, {-w, h}}};
        sunder_shape *sp, *sq, *sd;
        random_rectangles(&r, p, np);
        random_rectangles(&r, q, nq);
        const double *at = rng_once_in(&r, 2) ? origin : NULL;
        assert_int_equal(make(p, np, at, &sp), SUNDER_OK);
        assert_int_equal(make(q, nq, at, &sq), SUNDER_OK);
        assert_int_equal(make(&d, 1, NULL, &sd), SUNDER_OK);
        bool should = false;
        for (int x = 0; x < 16; x++)
            for (int y = 0; y < 16; y++)
                should = should || (rectangles_hold(p, np, x, y, x + 2 * (int)w, y + 2 * (int)h) &&
                                    rectangles_hold(q, nq, x, y, x + 2 * (int)w, y + 2 * (int)h));
        const bool fits = asked(sp, sq, sd, &r);
        if (fits != should) print_message("SUNDER_SEED=%llu, case %zu\n", (unsigned long long)seed, i);
        assert_int_equal(fits, should);
        fitted += fits;
        sunder_shape_free(sp);
        sunder_shape_free(sq);
        sunder_shape_free(sd);
    }
    print_message("%zu of %zu fit, seed %llu\n", fitted, cases, (unsigned long long)seed);
    assert_true(cases < 100 || (fitted > cases / 50 && fitted < cases));
}

/* ---- Thin overlaps, as in a layer -------------------------------------------------------------------------------- */

/* A bar in a slot that is too narrow by w on both sides. A translation that separates them is as long as they are, and
 * the overlap consists of two strips of width w. They are two bodies exactly if a disc of the tolerance fits into the
 * overlap, which it does if the strips are as wide as the disc's box. */
static bool join(double w, double tolerance)
{
    const double slot[] = {0, 0, 10, 0, 10, 90, 0, 90, 20, 0, 30, 0, 30, 90, 20, 90},
                 bar[] = {10 - w, -5, 20 + w, -5, 20 + w, 95, 10 - w, 95};
    const size_t ring_end[] = {4, 8}, poly_end[] = {1, 2};
    sunder_feature f[2] = {{.weight = 1, .max_shift = INFINITY, .block = -1},
                           {.weight = 1, .max_shift = INFINITY, .block = -1}};
    sunder_shape *shape[2];
    sunder_layer *layer;
    sunder_report *report;
    sunder_layer_options options;
    sunder_layer_summary summary;
    sunder_layer_options_init(&options);
    options.touch_tolerance = tolerance;
    for (int i = 0; i < 2; i++) {
        assert_int_equal(sunder_shape_from_rings(i ? bar : slot, ring_end, poly_end, i ? 1 : 2, SUNDER_VALIDITY_STRICT,
                                                 &shape[i], NULL),
                         SUNDER_OK);
        f[i].shape = shape[i];
    }
    assert_int_equal(sunder_layer_new(f, 2, &layer, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_check(layer, &options, &report, NULL), SUNDER_OK);
    sunder_report_summary(report, &summary);
    assert_int_equal(summary.before.overlap + summary.before.inside_blocks, 1);
    sunder_report_free(report);
    sunder_layer_free(layer);
    for (int i = 0; i < 2; i++) sunder_shape_free(shape[i]);
    return summary.before.inside_blocks == 1;
}

static void test_slot(void **state)
{
    for (double any = 0x1p-20; any < 4; any *= 1.75) {
        const double hair = 0x1p-47; /* 20 + w is exact */
        const double tolerance =
            ldexp(floor(ldexp(any, 45)), -45); /* so that the disc's corners on the axes are exact */
        sunder_shape *disc;
        double box[4];
        assert_int_equal(sunder_shape_disc(tolerance / 2, 16, true, &disc, NULL), SUNDER_OK);
        sunder_shape_box(disc, box);
        sunder_shape_free(disc);
        const double wide = box[2] - box[0];
        assert_true(20 + wide - 20 == wide && 10 - (10 - wide) == wide && 20 + (wide - hair) - 20 == wide - hair);
        assert_false(join(wide, tolerance));
        assert_true(join(wide - hair, tolerance));
        assert_true(join(tolerance / 2, tolerance));
        assert_false(join(1.01 * tolerance, tolerance));
    }
}

/* ---- Memory ------------------------------------------------------------------------------------------------------ */

static bool attempt(void *context)
{
    static const ring p[] = {{6, {{0, 0}, {9, 0}, {9, 9}, {6, 9}, {6, 3}, {0, 3}}},
                             {4, {{4, 4}, {9, 4}, {9, 9}, {4, 9}}}};
    sunder_shape *shape[3] = {NULL, NULL, NULL};
    bool fits = false;
    const bool ok = make(p, 2, NULL, &shape[0]) == SUNDER_OK && make(p + 1, 1, NULL, &shape[1]) == SUNDER_OK &&
                    make(&elements[3], 1, NULL, &shape[2]) == SUNDER_OK &&
                    sunder_i_fits_in_both(shape[0], NULL, shape[1], NULL, shape[2], &fits, NULL) == SUNDER_OK;
    assert_true(!ok || fits);
    for (int i = 0; i < 3; i++) sunder_shape_free(shape[i]);
    return ok;
}

static void test_memory(void **state) { assert_true(failing_loop(attempt, NULL, false)); }

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_polygons), cmocka_unit_test(test_members),
                                       cmocka_unit_test(test_slot), cmocka_unit_test(test_memory)};
    return cmocka_run_group_tests_name("what fits into what two have in common", tests, NULL, NULL);
}
