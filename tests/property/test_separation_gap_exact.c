/* Least translations with a gap for figures that are difficult for the search, compared with brute force in long
 * numbers (gap_oracle.h): walls that are nearly collinear or nearly parallel, sides of rational length, corners and
 * walls at exactly fitting distances, all displaced by powers of two from 2^-8 to 2^-52. Each search has to find a
 * result that keeps the gap exactly, is at most 1e-9 longer than the least, and has a valid lower bound. */
#include "gap_oracle.h"
#include "random.h"

#include "separation/least_translation.h"
#include "separation/separation.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* ---- Figures ---- */

/* Zero, or a power of two of either sign. */
static double offset(rng *r)
{
    if (rng_once_in(r, 4)) return 0;
    return ldexp(rng_once_in(r, 2) ? 1 : -1, -(int)rng_int(r, 8, 52));
}

static double any_of(rng *r, const double *v, size_t n) { return v[rng_int(r, 0, (int64_t)n - 1)]; }
#define ANY_OF(r, list) any_of(r, list, sizeof(list) / sizeof *(list))

static void box(polyset *s, double x0, double y0, double x1, double y1)
{
    const double xy[] = {x0, y0, x1, y0, x1, y1, x0, y1};
    polyset_polygon(s, xy, 4);
}

/* A floor with nearly straight bends, and a post above a bend. */
static double near_walls(polyset *p, polyset *q, rng *r)
{
    static const double GAPS[] = {32, 31, 1, 0.5, 5, 3.25, 100};
    static const double WIDTHS[] = {4096, 1024, 64, 3, 4095.999999999999};
    const double w = ANY_OF(r, WIDTHS), v = ANY_OF(r, WIDTHS), rise = offset(r) * (rng_once_in(r, 2) ? 1 : 64);
    const double xy[] = {-w, -1024, v, -1024, v, rise, 0, 0, -w, rng_once_in(r, 3) ? offset(r) : 0};
    polyset_polygon(p, xy, 5);
    const double left = -(double)rng_int(r, 1, 4) + offset(r), right = offset(r);
    box(q, left, -(double)rng_int(r, 0, 2), right, 9);
    return ANY_OF(r, GAPS);
}

/* Two walls, parallel or nearly so, and between them a box for which there is exactly as much room as the gap requires,
 * or nearly. */
static double corridor(polyset *p, polyset *q, rng *r)
{
    static const double GAPS[] = {1, 0.5, 2, 3, 0.375};
    const double gap = ANY_OF(r, GAPS), width = (double)rng_int(r, 1, 4), length = (double)rng_int(r, 4, 64);
    const double room = width + 2 * gap + offset(r), lean = offset(r);
    const double low[] = {-length, -8, length, -8, length, lean, -length, rng_once_in(r, 2) ? 0 : -lean};
    polyset_polygon(p, low, 4);
    const double high[] = {-length, room, length, room + offset(r), length, room + 8, -length, room + 8};
    polyset_polygon(p, high, 4);
    const double up = (double)rng_int(r, -1, 2) / 2 + offset(r), along = (double)rng_int(r, -2, 2);
    box(q, along, up, along + 2, up + width);
    return gap;
}

typedef struct triple {
    double x, y, z;
} triple;
static const triple TRIPLES[] = {{3, 4, 5}, {5, 12, 13}, {8, 15, 17}, {7, 24, 25}, {20, 21, 29}, {4, 3, 5}, {1, 0, 1}};
static triple any_triple(rng *r) { return TRIPLES[rng_int(r, 0, 6)]; }

/* Slanted walls of rational length, and a corner in front of them or between them. */
static double rational_walls(polyset *p, polyset *q, rng *r)
{
    const triple t = any_triple(r), u = any_triple(r);
    const double k = (double)rng_int(r, 1, 8), m = (double)rng_int(r, 1, 8), e = offset(r);
    /* A valley with its bottom at the origin, or a wedge with its top there. */
    if (rng_once_in(r, 2)) {
        const double xy[] = {-k * t.x - 9,        -99, m * u.x + 9, -99,      m * u.x + 9, m * u.y,      m * u.x,
                             m * u.y + offset(r), e,   0,           -k * t.x, k * t.y,     -k * t.x - 9, k * t.y};
        polyset_polygon(p, xy, 7);
    } else {
        const double xy[] = {
            -k * t.x - 1, -k * t.y - 99,           m * u.x + 1, -m * u.y - 99, m * u.x + 1, -m * u.y - 1, e, 0,
            -k * t.x - 1, -k * t.y - 1 + offset(r)};
        polyset_polygon(p, xy, 5);
    }
    const double x = (double)rng_int(r, -3, 3) + offset(r), y = (double)rng_int(r, -3, 3) + offset(r);
    if (rng_once_in(r, 2)) {
        const triple v = any_triple(r);
        const double xy[] = {x, y, x + v.x, y + v.y + 3, x - v.y, y + v.x + 3};
        polyset_polygon(q, xy, 3);
    } else
        box(q, x - 1, y, x + 1, y + 2);
    static const double GAPS[] = {1, 5, 2.5, 13, 0.5, 3};
    return ANY_OF(r, GAPS);
}

/* Posts whose circles (with the gap as radius) touch each other, or nearly touch. */
static double tangent_arcs(polyset *p, polyset *q, rng *r)
{
    const triple t = any_triple(r), u = any_triple(r);
    const double k = (double)rng_int(r, 1, 3), gap = k * t.z / 2, a = 0.25;
    box(p, -a, -a, 0, 0);
    box(p, k * t.x + offset(r), k * t.y + offset(r), k * t.x + 1 + a, k * t.y + 1 + a);
    if (rng_once_in(r, 2)) box(p, k * u.y + offset(r), -k * u.x - 1, k * u.y + 1, -k * u.x + offset(r));
    const double x = (double)rng_int(r, -2, 2) / 2, y = (double)rng_int(r, -2, 2) / 2;
    if (rng_once_in(r, 2))
        box(q, x, y, x + a, y + a + offset(r));
    else {
        const double xy[] = {x, y, x + a, y + offset(r), x, y + a};
        polyset_polygon(q, xy, 3);
    }
    return rng_once_in(r, 3) ? gap + offset(r) : gap;
}

/* A courtyard or a bay that contains the box with the gap on all sides, exactly or nearly. */
static double exact_fit(polyset *p, polyset *q, rng *r)
{
    static const double GAPS[] = {1, 0.5, 2, 0.25, 1.5};
    const double gap = ANY_OF(r, GAPS), w = (double)rng_int(r, 1, 4), h = (double)rng_int(r, 1, 4);
    const double x = w + 2 * gap + offset(r), y = h + 2 * gap + offset(r);
    if (rng_once_in(r, 2)) {
        const double outer[] = {-9, -9, x + 9, -9, x + 9, y + 9, -9, y + 9};
        const double court[] = {0, 0, offset(r), y, x, y, x, 0};
        polyset_ring(p, outer, 4);
        polyset_ring(p, court, 4);
        polyset_end_polygon(p);
    } else {
        const double bay[] = {-9, -9, x + 9, -9, x + 9, y, x, y, x + offset(r), offset(r), 0, 0, offset(r), y, -9, y};
        polyset_polygon(p, bay, 8);
    }
    const double left = gap + (double)rng_int(r, -2, 2) / 2 + offset(r), up = gap + (double)rng_int(r, -2, 2) / 2;
    box(q, left, up, left + w, up + h);
    return gap;
}

/* Small polygons with integer corners, each slightly displaced. */
static double loose_integers(polyset *p, polyset *q, rng *r)
{
    polyset *const set[] = {p, q};
    for (int k = 0; k < 2; k++) {
        double xy[12];
        const size_t n = (size_t)rng_int(r, 3, 6);
        for (size_t i = 0; i < n; i++) {
            const double a = 6.283185307179586 * ((double)i + rng_unit(r) / 2) / (double)n, l = 2 + 6 * rng_unit(r);
            xy[2 * i] = rint(l * cos(a)) + offset(r);
            xy[2 * i + 1] = rint(l * sin(a)) + offset(r);
        }
        polyset_polygon(set[k], xy, n);
    }
    polyset_move(q, (double)rng_int(r, -4, 4), (double)rng_int(r, -4, 4));
    static const double GAPS[] = {1, 0.5, 2, 5, 0.125};
    return ANY_OF(r, GAPS);
}

typedef struct maker {
    const char *name;
    double (*make)(polyset *p, polyset *q, rng *r);
} maker;

static const maker MAKERS[] = {
    {"near walls", near_walls},     {"corridor", corridor},   {"rational walls", rational_walls},
    {"tangent arcs", tangent_arcs}, {"exact fit", exact_fit}, {"loose integers", loose_integers},
};
#define KINDS (sizeof MAKERS / sizeof *MAKERS)

/* The same figure mirrored, with the axes swapped, with P and Q swapped. */
static void look_at(polyset *p, polyset *q, rng *r)
{
    polyset *const set[] = {p, q};
    const bool swap = rng_once_in(r, 2);
    const double sx = rng_once_in(r, 2) ? 1 : -1, sy = rng_once_in(r, 2) ? 1 : -1;
    for (int k = 0; k < 2; k++)
        for (size_t i = 0; i < set[k]->vertices; i++) {
            double *v = set[k]->xy + 2 * i, x = v[0];
            if (swap) {
                v[0] = v[1];
                v[1] = x;
            }
            v[0] *= sx;
            v[1] *= sy;
        }
    if (!rng_once_in(r, 2)) return;
    const polyset t = *p;
    *p = *q;
    *q = t;
}

static sunder_shape *shape_or_null(const polyset *s)
{
    sunder_shape *shape = NULL;
    sunder_shape_from_rings(s->xy, s->ring_end, s->poly_end, s->polygons, SUNDER_VALIDITY_STRICT, &shape, NULL);
    return shape;
}

/* ---- Judging ---- */

typedef struct tally {
    size_t done, moved, contact[6];
} tally;

static void complain(const char *what, uint64_t number, const polyset *p, const polyset *q, double gap,
                     const sunder_separation *s, double truth)
{
    char *a = polyset_wkt(p), *b = polyset_wkt(q);
    print_error("%s: %s, pair %llu, gap %.17g, got (%s, %s), length %.17g, bound %.17g, %s, attained %d; brute force "
                "%.17g\n%s\n%s\n",
                what, MAKERS[number % KINDS].name, (unsigned long long)number, gap, s->dx_text ? s->dx_text : "-",
                s->dy_text ? s->dy_text : "-", s->distance, s->lower_bound, sunder_contact_string(s->contact),
                s->attained, truth, a, b);
    free(a);
    free(b);
    fail();
}

static const char *judge(const polyset *p, const polyset *q, double gap, const sunder_separation *s, double *truth,
                         tally *t)
{
    mpq_t x, y, square;
    mpq_inits(x, y, square, NULL);
    const char *wrong = NULL;
    *truth = NAN;
    if (!s->dx_text || !s->dy_text || mpq_set_str(x, s->dx_text, 10) || mpq_set_str(y, s->dy_text, 10))
        wrong = "no answer";
    else if (!gap_oracle_keeps(p, q, gap, x, y))
        wrong = "too near";
    else if (s->overlap) {
        mpq_mul(square, x, x);
        mpq_mul(x, y, y);
        mpq_add(square, square, x);
        const gap_verdict verdict = gap_oracle_judge(p, q, gap, square, s->lower_bound, truth);
        if (verdict == GAP_BOUND_HIGH) wrong = "the bound is above the least";
        if (verdict == GAP_TOO_LONG) wrong = "not the least";
        if (!s->attained) wrong = "the minimum is attained, but not reported as attained";
        if (*truth == INFINITY) wrong = "the oracle finds nothing";
        if (s->lower_bound > s->distance || s->distance > s->lower_bound * (1 + 1e-9))
            wrong = "bound and length do not agree";
        t->moved++;
    } else if (s->distance != 0)
        wrong = "a translation although the gap is kept already";
    if (!wrong && s->rounded_is_free) {
        mpq_set_d(x, s->dx);
        mpq_set_d(y, s->dy);
        if (!gap_oracle_keeps(p, q, gap, x, y)) wrong = "the doubles are too near";
    }
    t->contact[s->contact]++;
    mpq_clears(x, y, square, NULL);
    return wrong;
}

static void try_pair(uint64_t number, const polyset *p, const polyset *q, double gap, bool wide, tally *t)
{
    sunder_shape *a = shape_or_null(p), *b = shape_or_null(q);
    if (a && b) {
        sunder_separation s = {.attained = false};
        sunder_error err = {0};
        const sunder_i_least_options options = {.gap = gap, .upper = INFINITY, .texts = true, .force_wide = wide};
        double truth = NAN;
        const bool failed = sunder_i_least(a, b, &options, &s, NULL, &err) != SUNDER_OK;
        const char *wrong = failed ? err.message : judge(p, q, gap, &s, &truth, t);
        if (wrong) complain(wrong, number, p, q, gap, &s, truth);
        sunder_separation_clear(&s);
        t->done++;
    }
    sunder_shape_free(a);
    sunder_shape_free(b);
}

static void gaps_that_hurt(void **state)
{
    const uint64_t seed = test_seed(), rounds = test_count(1000);
    tally t = {0};
    for (uint64_t i = 0; t.done < rounds; i++) {
        rng r = rng_start(seed, i);
        polyset p, q;
        polyset_init(&p);
        polyset_init(&q);
        const double gap = MAKERS[i % KINDS].make(&p, &q, &r);
        look_at(&p, &q, &r);
        try_pair(i, &p, &q, gap, rng_once_in(&r, 8), &t);
        polyset_free(&p);
        polyset_free(&q);
    }
    print_message("SUNDER_SEED=%llu: %zu pairs, %zu moved; contacts:", (unsigned long long)seed, t.done, t.moved);
    for (int k = 0; k < 6; k++) print_message(" %s %zu", sunder_contact_string((sunder_contact)k), t.contact[k]);
    print_message("\n");
    assert_true(t.moved > t.done / 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(gaps_that_hurt)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
