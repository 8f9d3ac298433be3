/* The least separating translation compared with brute force in rationals that shares no code with the library.
 *
 * The oracle: a free placement nearest to the origin lies on a line on which a vertex of one operand touches an edge of
 * the other. So it is the foot of a perpendicular on such a line, or a crossing of two, or an end of a contact segment.
 * All of these are computed and sorted by length, and the first free one is the answer; among several of equal length
 * the lexicographically smallest. Whether a placement is free is decided by cutting both sets into vertical slabs. */
#include "generate.h"
#include "separation/least_translation.h"
#include "separation/separation.h"
#include "slabs.h"

#include <gmp.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct candidate {
    mpq_t x, y, norm;
} candidate;

typedef struct segment {
    long ax, ay, dx, dy;
} segment;

/* ---- Candidates ---- */

static size_t contact_segments(segment *s, const polyset *p, const polyset *q, int sign)
{
    /* Q + t touches P if an edge of one meets a vertex of the other: t = p - q. */
    size_t n = 0;
    for (size_t r = 0, v = 0; r < p->rings; r++) {
        const size_t first = v, end = p->ring_end[r];
        for (; v < end; v++) {
            const size_t w = v + 1 < end ? v + 1 : first;
            for (size_t k = 0; k < q->vertices; k++)
                s[n++] = (segment){sign * ((long)p->xy[2 * v] - (long)q->xy[2 * k]),
                                   sign * ((long)p->xy[2 * v + 1] - (long)q->xy[2 * k + 1]),
                                   sign * ((long)p->xy[2 * w] - (long)p->xy[2 * v]),
                                   sign * ((long)p->xy[2 * w + 1] - (long)p->xy[2 * v + 1])};
        }
    }
    return n;
}

static int same_segment(const void *a, const void *b) { return memcmp(a, b, sizeof(segment)); }

static void put(candidate *c, const segment *s, long num, long den)
{
    mpq_inits(c->x, c->y, c->norm, NULL);
    mpq_set_si(c->x, s->ax * den + s->dx * num, (unsigned long)den);
    mpq_set_si(c->y, s->ay * den + s->dy * num, (unsigned long)den);
    mpq_canonicalize(c->x);
    mpq_canonicalize(c->y);
    mpq_t t;
    mpq_init(t);
    mpq_mul(c->norm, c->x, c->x);
    mpq_mul(t, c->y, c->y);
    mpq_add(c->norm, c->norm, t);
    mpq_clear(t);
}

static int compare_candidates(const void *a, const void *b)
{
    const candidate *c = a, *d = b;
    int k = mpq_cmp(c->norm, d->norm);
    if (!k) k = mpq_cmp(c->x, d->x);
    return k ? k : mpq_cmp(c->y, d->y);
}

/* The point at the rational parameter num / den in [0, 1] on the segment. */
static void add(candidate *c, size_t *n, const segment *s, long num, long den, double limit)
{
    if (den < 0) {
        num = -num;
        den = -den;
    }
    if (num < 0 || num > den) return;
    const double t = (double)num / (double)den, x = (double)s->ax + t * (double)s->dx,
                 y = (double)s->ay + t * (double)s->dy;
    if (x * x + y * y > limit * limit + 1) return; /* longer than a translation known to be free, with a tolerance */
    put(c + (*n)++, s, num, den);
}

static size_t make_candidates(candidate **out, const polyset *p, const polyset *q)
{
    segment *s = malloc(2 * p->vertices * q->vertices * sizeof *s);
    size_t all = contact_segments(s, p, q, 1);
    all += contact_segments(s + all, q, p, -1);
    qsort(s, all, sizeof *s, same_segment);
    size_t m = 0;
    for (size_t i = 0; i < all; i++)
        if (m == 0 || same_segment(s + i, s + m - 1)) s[m++] = s[i];
    long right = -1000000, left = 1000000;
    for (size_t i = 0; i < m; i++) {
        if (s[i].ax > right) right = s[i].ax;
        if (s[i].ax < left) left = s[i].ax;
    }
    const double limit = (double)(right < -left ? right : -left);
    candidate *c = malloc((3 * m + m * m) * sizeof *c);
    size_t n = 0;
    for (size_t i = 0; i < m; i++) {
        add(c, &n, s + i, 0, 1, limit);
        add(c, &n, s + i, 1, 1, limit);
        add(c, &n, s + i, -(s[i].ax * s[i].dx + s[i].ay * s[i].dy), s[i].dx * s[i].dx + s[i].dy * s[i].dy, limit);
        for (size_t j = 0; j < m; j++) {
            const long cross = s[i].dx * s[j].dy - s[i].dy * s[j].dx;
            if (cross) add(c, &n, s + i, (s[j].ax - s[i].ax) * s[j].dy - (s[j].ay - s[i].ay) * s[j].dx, cross, limit);
        }
    }
    free(s);
    qsort(c, n, sizeof *c, compare_candidates);
    *out = c;
    return n;
}

/* The least free placement. */
static void oracle(const polyset *p, const polyset *q, mpq_t x, mpq_t y)
{
    mpq_set_ui(x, 0, 1);
    mpq_set_ui(y, 0, 1);
    if (!interiors_meet(p, q, NULL, NULL)) return;
    candidate *c;
    const size_t n = make_candidates(&c, p, q);
    bool found = false;
    for (size_t i = 0; i < n && !found; i++) {
        if (i && compare_candidates(c + i, c + i - 1) == 0) continue;
        if (interiors_meet(p, q, (const mpq_t *)&c[i].x, (const mpq_t *)&c[i].y)) continue;
        mpq_set(x, c[i].x);
        mpq_set(y, c[i].y);
        found = true;
    }
    assert_true(found);
    for (size_t i = 0; i < n; i++) mpq_clears(c[i].x, c[i].y, c[i].norm, NULL);
    free(c);
}

static void print_shape(const polyset *s)
{
    char *text = polyset_wkt(s);
    print_error("%s\n", text);
    free(text);
}

/* ---- The kind of contact, by testing around the point ---- */

typedef struct ray {
    long x, y;
    double angle;
} ray;

static int compare_rays(const void *a, const void *b)
{
    const double s = ((const ray *)a)->angle, t = ((const ray *)b)->angle;
    return (s > t) - (s < t);
}

static size_t all_rays(ray *r, const polyset *s, size_t n)
{
    for (size_t k = 0, v = 0; k < s->rings; k++) {
        const size_t first = v, end = s->ring_end[k];
        for (; v < end; v++) {
            const size_t w = v + 1 < end ? v + 1 : first;
            for (int sign = -1; sign <= 1; sign += 2) {
                r[n].x = sign * ((long)s->xy[2 * w] - (long)s->xy[2 * v]);
                r[n].y = sign * ((long)s->xy[2 * w + 1] - (long)s->xy[2 * v + 1]);
                r[n].angle = atan2((double)r[n].y, (double)r[n].x);
                n++;
            }
        }
    }
    return n;
}

/* Is the point slightly beside it, along (dx, dy), free? Features of these inputs are at least about 1e-7 apart. */
static bool free_beside(const polyset *p, const polyset *q, const mpq_t x, const mpq_t y, long dx, long dy)
{
    mpq_t u, v, e;
    mpq_inits(u, v, e, NULL);
    mpq_set_si(e, dx, 1000000000000ul);
    mpq_canonicalize(e);
    mpq_add(u, x, e);
    mpq_set_si(e, dy, 1000000000000ul);
    mpq_canonicalize(e);
    mpq_add(v, y, e);
    const bool free_there = !interiors_meet(p, q, (const mpq_t *)&u, (const mpq_t *)&v);
    mpq_clears(u, v, e, NULL);
    return free_there;
}

/* Returns 0 for the boundary of the outside or of a hole, 1 for a degenerate segment, 2 for a degenerate point. */
static int surroundings(const polyset *p, const polyset *q, const mpq_t x, const mpq_t y)
{
    ray *r = malloc(2 * (p->vertices + q->vertices) * sizeof *r);
    const size_t n = all_rays(r, q, all_rays(r, p, 0));
    qsort(r, n, sizeof *r, compare_rays);
    int kind = 2;
    for (size_t i = 0; i < n && kind; i++) {
        const ray a = r[i], b = r[i + 1 < n ? i + 1 : 0];
        const long cross = a.x * b.y - a.y * b.x;
        /* Between two directions of edges, so never along an edge. Neighbouring directions differ by less than pi,
         * since each has its opposite. */
        if (cross != 0 && free_beside(p, q, x, y, a.x + b.x, a.y + b.y)) kind = 0;
        if (kind == 2 && free_beside(p, q, x, y, a.x, a.y)) kind = 1;
    }
    free(r);
    return kind;
}

static int kind_of(sunder_contact contact)
{
    return contact == SUNDER_CONTACT_DEGENERATE_POINT ? 2 : contact == SUNDER_CONTACT_DEGENERATE_SEGMENT ? 1 : 0;
}

/* In 64-bit integers; in big integers; or in 128-bit integers, for the same pair scaled up. */
typedef enum rung { BRIEF, WIDE, NARROW } rung;
#define LARGER 2147483659.0 /* odd, so that the unit does not absorb it */

static void expect_answer(const polyset *p, const polyset *q, const sunder_shape *a, const sunder_shape *b,
                          const mpq_t x, const mpq_t y, rung by)
{
    sunder_separation s;
    sunder_error err = {0};
    const sunder_i_least_options options = {.upper = INFINITY, .texts = true, .force_wide = by == WIDE};
    if (sunder_i_least(a, b, &options, &s, NULL, &err)) fail_msg("%s", err.message);
    mpq_t u, v;
    mpq_inits(u, v, NULL);
    assert_int_equal(mpq_set_str(u, s.dx_text, 10), 0);
    assert_int_equal(mpq_set_str(v, s.dy_text, 10), 0);
    if (!mpq_equal(u, x) || !mpq_equal(v, y)) {
        char *ex = mpq_get_str(NULL, 10, x), *ey = mpq_get_str(NULL, 10, y);
        print_error("expected (%s, %s), got (%s, %s) by %s\n", ex, ey, s.dx_text, s.dy_text,
                    sunder_contact_string(s.contact));
        print_shape(p);
        print_shape(q);
        fail();
    }
    const bool moved = mpq_sgn(x) || mpq_sgn(y);
    assert_int_equal(s.contact != SUNDER_CONTACT_NONE, moved);
    if (moved && by == BRIEF && surroundings(p, q, x, y) != kind_of(s.contact)) {
        print_error("contact %s at (%s, %s)\n", sunder_contact_string(s.contact), s.dx_text, s.dy_text);
        print_shape(p);
        print_shape(q);
        fail();
    }
    mpq_t norm, t;
    mpq_inits(norm, t, NULL);
    mpq_mul(norm, x, x);
    mpq_mul(t, y, y);
    mpq_add(norm, norm, t);
    assert_int_equal(mpq_set_str(t, s.distance_squared_text, 10), 0);
    assert_true(mpq_equal(norm, t));
    assert_true(s.dx == mpq_get_d(x) || fabs(s.dx - mpq_get_d(x)) <= fabs(s.dx) * 0x1p-52); /* mpq_get_d truncates */
    mpq_set_d(t, s.lower_bound);
    mpq_mul(t, t, t);
    assert_true(mpq_cmp(t, norm) <= 0);
    /* The oracle tests whether the rounded translation is free. */
    if (by == BRIEF) {
        mpq_set_d(u, s.dx);
        mpq_set_d(v, s.dy);
        assert_int_equal(s.rounded_is_free, !interiors_meet(p, q, (const mpq_t *)&u, (const mpq_t *)&v));
    }
    mpq_clears(u, v, norm, t, NULL);
    sunder_separation_clear(&s);
}

/* The kinds with small integer coordinates; the oracle is too slow for long outlines. */
static const pair_kind KINDS[] = {PAIR_SQUARES, PAIR_STEPS,   PAIR_TRIANGLES, PAIR_TRIANGLE_STEPS, PAIR_PEG,
                                  PAIR_SLIDE,   PAIR_SLANTED, PAIR_SIMPLE,    PAIR_MEMBERS,        PAIR_BOARDS,
                                  PAIR_HOLES,   PAIR_ROOMS,   PAIR_SELF};

static bool integers_only(const polyset *s)
{
    for (size_t i = 0; i < 2 * s->vertices; i++)
        if (s->xy[i] != floor(s->xy[i]) || fabs(s->xy[i]) > 1000) return false;
    return true;
}

/* Convex shapes, slivers, and a large shape with a small one, in addition to the kinds. */
static void vary(polyset *p, polyset *q, rng *r)
{
    const int way = (int)rng_int(r, 0, 7);
    if (way == 0) {
        polyset_free(p);
        polyset_free(q);
        polyset_init(p);
        polyset_init(q);
        random_convex(p, r, (int)rng_int(r, 3, 8), 20);
        random_convex(q, r, (int)rng_int(r, 3, 6), 12);
    } else if (way == 1) {
        const double k = (double)rng_int(r, 5, 40), m = (double)rng_int(r, 5, 40);
        polyset_map(p, 1, k, 0, 1);
        polyset_map(q, 1, rng_once_in(r, 2) ? k : m, 0, 1);
    } else if (way == 2) {
        polyset_scale(rng_once_in(r, 2) ? p : q, 50, 50);
    }
}

/* Draws a pair, and may scale it. */
static void one_pair(polyset *p, polyset *q, size_t kinds[3])
{
    sunder_shape *a = polyset_shape(p), *b = polyset_shape(q);
    assert_non_null(a);
    assert_non_null(b);
    mpq_t x, y;
    mpq_inits(x, y, NULL);
    oracle(p, q, x, y);
    expect_answer(p, q, a, b, x, y, BRIEF);
    expect_answer(p, q, a, b, x, y, WIDE);
    if (mpq_sgn(x) || mpq_sgn(y)) kinds[surroundings(p, q, x, y)]++;
    sunder_shape_free(a);
    sunder_shape_free(b);
    mpq_t larger;
    mpq_init(larger);
    mpq_set_d(larger, LARGER);
    mpq_mul(x, x, larger);
    mpq_mul(y, y, larger);
    polyset_scale(p, LARGER, LARGER);
    polyset_scale(q, LARGER, LARGER);
    a = polyset_shape(p);
    b = polyset_shape(q);
    expect_answer(p, q, a, b, x, y, NARROW);
    mpq_clears(x, y, larger, NULL);
    sunder_shape_free(a);
    sunder_shape_free(b);
}

static void least_is_least(void **state)
{
    const uint64_t seed = test_seed();
    const size_t rounds = test_count(300);
    size_t kinds[3] = {0, 0, 0}, done = 0;
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
    for (size_t i = 0; done < rounds && i < 20 * rounds; i++) {
        rng r = rng_start(seed, i);
        polyset p, q;
        random_pair(&p, &q, &r, KINDS[i % (sizeof KINDS / sizeof *KINDS)]);
        polyset_negate(&q); /* the generator makes operands of sums */
        vary(&p, &q, &r);
        bring_together(&p, &q, &r);
        if (p.vertices * q.vertices <= 120 && p.polygons <= 64 && q.polygons <= 64 && integers_only(&p) &&
            integers_only(&q)) {
            one_pair(&p, &q, kinds);
            done++;
        }
        polyset_free(&p);
        polyset_free(&q);
    }
    print_message("%zu pairs; moved to a boundary %zu, a degenerate segment %zu, a degenerate point %zu\n", done,
                  kinds[0], kinds[1], kinds[2]);
    assert_true(kinds[0] > 0 && kinds[1] > 0 && kinds[2] > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(least_is_least)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
