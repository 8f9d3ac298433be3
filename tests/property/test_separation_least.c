/* The least separating translation against brute force in rationals that shares no code with the library.
 *
 * The oracle: a free placement nearest to the origin lies on a line on which a vertex of one operand touches an edge of the
 * other; so it is the foot of a perpendicular on such a line, or a crossing of two, or an end of a contact segment. All are
 * made, sorted by length, and the first free one is the answer; of several of that length the lexicographically smallest.
 * Free is decided by cutting both sets into vertical slabs. */
#include "generate.h"

#include "separation/least.h"

#include <gmp.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct candidate {
    mpq_t x, y, norm;
} candidate;

typedef struct segment {
    long ax, ay, dx, dy;
} segment;

/* ---- Free? ---- */

typedef struct edge {
    mpq_t ax, ay, bx, by; /* ax < bx */
    int set, member;
} edge;

static size_t load_edges(edge *e, const polyset *s, int set, const mpq_t *x, const mpq_t *y)
{
    size_t n = 0;
    for (size_t p = 0, r = 0, v = 0; p < s->polygons; p++)
        for (; r < s->poly_end[p]; r++) {
            const size_t first = v, end = s->ring_end[r];
            for (; v < end; v++) {
                const size_t w = v + 1 < end ? v + 1 : first;
                if (s->xy[2 * v] == s->xy[2 * w]) continue; /* vertical: bounds no slab from above or below */
                const size_t a = s->xy[2 * v] < s->xy[2 * w] ? v : w, b = a == v ? w : v;
                mpq_inits(e[n].ax, e[n].ay, e[n].bx, e[n].by, NULL);
                mpq_set_d(e[n].ax, s->xy[2 * a]);
                mpq_set_d(e[n].ay, s->xy[2 * a + 1]);
                mpq_set_d(e[n].bx, s->xy[2 * b]);
                mpq_set_d(e[n].by, s->xy[2 * b + 1]);
                if (x) {
                    mpq_add(e[n].ax, e[n].ax, *x);
                    mpq_add(e[n].bx, e[n].bx, *x);
                    mpq_add(e[n].ay, e[n].ay, *y);
                    mpq_add(e[n].by, e[n].by, *y);
                }
                e[n].set = set;
                e[n].member = (int)p;
                n++;
            }
        }
    return n;
}

/* y of the edge at x. */
static void height(mpq_t out, const edge *e, const mpq_t x)
{
    mpq_t t, u;
    mpq_inits(t, u, NULL);
    mpq_sub(t, x, e->ax);
    mpq_sub(u, e->by, e->ay);
    mpq_mul(t, t, u);
    mpq_sub(u, e->bx, e->ax);
    mpq_div(t, t, u);
    mpq_add(out, e->ay, t);
    mpq_clears(t, u, NULL);
}

/* Adds the x of the crossing of two edges, if it lies within both. */
static size_t add_crossing(mpq_t *xs, size_t n, const edge *e, const edge *f)
{
    mpq_t lo, hi, a, b, c, d;
    mpq_inits(lo, hi, a, b, c, d, NULL);
    mpq_set(lo, mpq_cmp(e->ax, f->ax) > 0 ? e->ax : f->ax);
    mpq_set(hi, mpq_cmp(e->bx, f->bx) < 0 ? e->bx : f->bx);
    if (mpq_cmp(lo, hi) < 0) {
        height(a, e, lo);
        height(b, f, lo);
        height(c, e, hi);
        height(d, f, hi);
        mpq_sub(a, a, b); /* difference at lo */
        mpq_sub(c, c, d); /* and at hi */
        if (mpq_sgn(a) * mpq_sgn(c) < 0) {
            mpq_sub(c, a, c);
            mpq_div(a, a, c);
            mpq_sub(hi, hi, lo);
            mpq_mul(a, a, hi);
            mpq_init(xs[n]);
            mpq_add(xs[n++], lo, a);
        }
    }
    mpq_clears(lo, hi, a, b, c, d, NULL);
    return n;
}

static int compare_rationals(const void *a, const void *b)
{
    return mpq_cmp(*(const mpq_t *)a, *(const mpq_t *)b);
}

typedef struct crossing {
    mpq_t y;
    int set, member;
} crossing;

static int compare_crossings(const void *a, const void *b)
{
    return mpq_cmp(((const crossing *)a)->y, ((const crossing *)b)->y);
}

/* Does the vertical line at x run through both interiors at once? By parity within each member. */
static bool line_meets_both(const edge *e, size_t n, const mpq_t x)
{
    crossing *c = malloc(n * sizeof *c);
    size_t m = 0;
    for (size_t i = 0; i < n; i++)
        if (mpq_cmp(e[i].ax, x) < 0 && mpq_cmp(x, e[i].bx) < 0) {
            mpq_init(c[m].y);
            height(c[m].y, e + i, x);
            c[m].set = e[i].set;
            c[m++].member = e[i].member;
        }
    qsort(c, m, sizeof *c, compare_crossings);
    bool in[2][64] = {{false}};
    bool both = false;
    for (size_t i = 0; i < m; i++) {
        in[c[i].set][c[i].member] ^= true;
        if (i + 1 < m && mpq_equal(c[i].y, c[i + 1].y)) continue;
        bool p = false, q = false;
        for (int k = 0; k < 64; k++) {
            p |= in[0][k];
            q |= in[1][k];
        }
        both |= p && q;
    }
    for (size_t i = 0; i < m; i++) mpq_clear(c[i].y);
    free(c);
    return both;
}

static bool interiors_meet(const polyset *p, const polyset *q, const mpq_t *x, const mpq_t *y)
{
    const size_t most = p->vertices + q->vertices;
    edge *e = malloc(most * sizeof *e);
    size_t n = load_edges(e, p, 0, NULL, NULL);
    n += load_edges(e + n, q, 1, x, y);
    mpq_t *xs = malloc((2 * n + n * n) * sizeof *xs);
    size_t m = 0;
    for (size_t i = 0; i < n; i++) {
        mpq_init(xs[m]);
        mpq_set(xs[m++], e[i].ax);
        mpq_init(xs[m]);
        mpq_set(xs[m++], e[i].bx);
        for (size_t j = 0; j < i; j++) m = add_crossing(xs, m, e + i, e + j);
    }
    qsort(xs, m, sizeof *xs, compare_rationals);
    bool meet = false;
    mpq_t middle, two;
    mpq_inits(middle, two, NULL);
    mpq_set_ui(two, 2, 1);
    for (size_t i = 0; i + 1 < m && !meet; i++) {
        if (mpq_equal(xs[i], xs[i + 1])) continue;
        mpq_add(middle, xs[i], xs[i + 1]);
        mpq_div(middle, middle, two);
        meet = line_meets_both(e, n, middle);
    }
    mpq_clears(middle, two, NULL);
    for (size_t i = 0; i < m; i++) mpq_clear(xs[i]);
    for (size_t i = 0; i < n; i++) mpq_clears(e[i].ax, e[i].ay, e[i].bx, e[i].by, NULL);
    free(xs);
    free(e);
    return meet;
}

/* ---- Candidates ---- */

static size_t contact_segments(segment *s, const polyset *p, const polyset *q, int sign)
{
    /* Q + t touches P where an edge of one meets a vertex of the other: t = p - q. */
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

static int same_segment(const void *a, const void *b)
{
    return memcmp(a, b, sizeof(segment));
}

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

/* The rational num / den in [0, 1] of the segment. */
static void add(candidate *c, size_t *n, const segment *s, long num, long den, double limit)
{
    if (den < 0) {
        num = -num;
        den = -den;
    }
    if (num < 0 || num > den) return;
    const double t = (double)num / (double)den, x = (double)s->ax + t * (double)s->dx, y = (double)s->ay + t * (double)s->dy;
    if (x * x + y * y > limit * limit + 1) return; /* farther than a way out known to be free; generously */
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

/* ---- How it touches, by looking around the point ---- */

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

/* Is the point a little way along (dx, dy) free? Features of these inputs are at least about 1e-7 apart. */
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

/* 0: a boundary of the outside or of a hole; 1: a degenerate segment; 2: a degenerate point. */
static int surroundings(const polyset *p, const polyset *q, const mpq_t x, const mpq_t y)
{
    ray *r = malloc(2 * (p->vertices + q->vertices) * sizeof *r);
    const size_t n = all_rays(r, q, all_rays(r, p, 0));
    qsort(r, n, sizeof *r, compare_rays);
    int kind = 2;
    for (size_t i = 0; i < n && kind; i++) {
        const ray a = r[i], b = r[i + 1 < n ? i + 1 : 0];
        const long cross = a.x * b.y - a.y * b.x;
        /* Between them: never along an edge. Directions are less than pi apart, since every one has its opposite. */
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

static void expect_answer(const polyset *p, const polyset *q, const sunder_shape *a, const sunder_shape *b,
                          const mpq_t x, const mpq_t y, bool wide)
{
    sunder_separation s;
    sunder_error err = {0};
    const sunder_i_least_options options = {.upper = INFINITY, .texts = true, .force_wide = wide};
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
    if (moved && !wide && surroundings(p, q, x, y) != kind_of(s.contact)) {
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
    /* The doubles, asked again by the oracle. */
    if (!wide) {
        mpq_set_d(u, s.dx);
        mpq_set_d(v, s.dy);
        assert_int_equal(s.rounded_is_free, !interiors_meet(p, q, (const mpq_t *)&u, (const mpq_t *)&v));
    }
    mpq_clears(u, v, norm, t, NULL);
    sunder_separation_clear(&s);
}

/* The kinds that live on small integers; the oracle is too slow for long outlines. */
static const pair_kind KINDS[] = {PAIR_SQUARES, PAIR_STEPS, PAIR_TRIANGLES, PAIR_TRIANGLE_STEPS, PAIR_PEG,  PAIR_SLIDE,
                                  PAIR_SLANTED, PAIR_SIMPLE, PAIR_MEMBERS,  PAIR_BOARDS,         PAIR_HOLES, PAIR_ROOMS,
                                  PAIR_SELF};

static bool integers_only(const polyset *s)
{
    for (size_t i = 0; i < 2 * s->vertices; i++)
        if (s->xy[i] != floor(s->xy[i]) || fabs(s->xy[i]) > 1000) return false;
    return true;
}

/* Moves q over p, a few units off. */
static void bring_together(const polyset *p, polyset *q, rng *r)
{
    for (int k = 0; k < 2; k++) {
        double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
        for (size_t i = 0; i < p->vertices; i++) {
            low[0] = fmin(low[0], p->xy[2 * i + (size_t)k]);
            high[0] = fmax(high[0], p->xy[2 * i + (size_t)k]);
        }
        for (size_t i = 0; i < q->vertices; i++) {
            low[1] = fmin(low[1], q->xy[2 * i + (size_t)k]);
            high[1] = fmax(high[1], q->xy[2 * i + (size_t)k]);
        }
        const double d = floor((low[0] + high[0] - low[1] - high[1]) / 2) + (double)rng_int(r, -3, 3);
        polyset_move(q, k ? 0 : d, k ? d : 0);
    }
}

static void one_pair(const polyset *p, const polyset *q, size_t kinds[3])
{
    sunder_shape *a = polyset_shape(p), *b = polyset_shape(q);
    assert_non_null(a);
    assert_non_null(b);
    mpq_t x, y;
    mpq_inits(x, y, NULL);
    oracle(p, q, x, y);
    expect_answer(p, q, a, b, x, y, false);
    expect_answer(p, q, a, b, x, y, true);
    if (mpq_sgn(x) || mpq_sgn(y)) kinds[surroundings(p, q, x, y)]++;
    mpq_clears(x, y, NULL);
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
        polyset_negate(&q); /* generated for sums */
        bring_together(&p, &q, &r);
        if (p.vertices * q.vertices <= 120 && p.polygons <= 64 && q.polygons <= 64 && integers_only(&p) && integers_only(&q)) {
            one_pair(&p, &q, kinds);
            done++;
        }
        polyset_free(&p);
        polyset_free(&q);
    }
    print_message("%zu pairs; moved to a boundary %zu, a degenerate segment %zu, a degenerate point %zu\n", done, kinds[0],
                  kinds[1], kinds[2]);
    assert_true(kinds[0] > 0 && kinds[1] > 0 && kinds[2] > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(least_is_least)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
