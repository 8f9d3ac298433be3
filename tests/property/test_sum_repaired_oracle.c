/* Operands of every kind, repaired by the even-odd rule, compared with exact brute force (even_odd.h, oracle.h): sums;
 * whether the interiors meet; least translations without a gap, to the last digit; those with a gap, by the brute force
 * for gaps, on the operands scaled so that their corners are integers; the obstacles of a robot; and that a route past
 * them is free. */
#include "even_odd.h"
#include "gap_oracle.h"
#include "generate.h"
#include "json.h"
#include "oracle.h"
#include "sum_text.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define SHOWN 3 /* at most this many disagreements are printed; the rest are counted */

typedef struct repaired {
    polyset p, q;
    sunder_shape *a, *b;
} repaired;

static sunder_shape *even_odd_shape(const polyset *p)
{
    sunder_shape *s = NULL;
    sunder_error err;
    if (sunder_shape_from_rings(p->xy, p->ring_end, p->poly_end, p->polygons, SUNDER_VALIDITY_EVEN_ODD, &s, &err))
        fail_msg("%s", err.message);
    return s;
}

/* near: Q is placed near P. */
static void open_case(repaired *c, rng *r, invalid_kind kind, int most_p, int most_q, bool near)
{
    polyset_init(&c->p);
    polyset_init(&c->q);
    random_invalid(&c->p, r, kind, most_p);
    if (rng_once_in(r, 2))
        random_invalid(&c->q, r, rng_once_in(r, 2) ? kind : INVALID_SCRIBBLE, most_q);
    else
        random_simple(&c->q, r, (int)rng_int(r, 3, 4), 5);
    if (near) bring_together(&c->p, &c->q, r);
    c->a = even_odd_shape(&c->p);
    c->b = even_odd_shape(&c->q);
}

static void close_case(repaired *c)
{
    sunder_shape_free(c->a);
    sunder_shape_free(c->b);
    polyset_free(&c->p);
    polyset_free(&c->q);
}

/* A test of a case: returns NULL, or what is wrong. */
typedef const char *(*question)(const repaired *c, size_t i);

static const char *ask_sum(const repaired *c, size_t i)
{
    sunder_sum *sum = NULL;
    if (sunder_minkowski_sum(c->a, c->b, NULL, &sum, NULL) != SUNDER_OK) return "no sum";
    char *got = sum_text(sum), *want = oracle_even_odd_text(&c->p, &c->q, i % 16 == 0);
    const bool same = got && strcmp(got, want) == 0;
    free(got);
    free(want);
    sunder_sum_free(sum);
    return same ? NULL : "the sum differs from the oracle's";
}

/* ---- Without a gap ---- */

static void read_place(mpq_t place[2], const json *xy)
{
    for (size_t k = 0; k < 2; k++)
        if (mpq_set_str(place[k], json_text(&xy->item[k]), 10)) abort();
}

/* Replaces *least by the squared distance of the segment from the origin if that is less (negative: none yet). */
static void take_nearer(mpq_t least, const json *from, const json *to)
{
    mpq_t a[2], b[2], d[2], t, u, v;
    mpq_inits(a[0], a[1], b[0], b[1], d[0], d[1], t, u, v, NULL);
    read_place(a, from);
    read_place(b, to);
    for (int k = 0; k < 2; k++) {
        mpq_sub(d[k], b[k], a[k]);
        mpq_mul(v, a[k], d[k]);
        mpq_sub(t, t, v); /* -a . d */
        mpq_mul(v, d[k], d[k]);
        mpq_add(u, u, v);
    }
    if (mpq_sgn(t) > 0 && mpq_cmp(t, u) < 0) { /* the foot of the perpendicular: (a x d)^2 / d^2 */
        mpq_mul(t, a[0], d[1]);
        mpq_mul(v, a[1], d[0]);
        mpq_sub(t, t, v);
        mpq_mul(t, t, t);
        mpq_div(t, t, u);
    } else {
        mpq_t *end = mpq_sgn(t) > 0 ? b : a;
        mpq_mul(t, end[0], end[0]);
        mpq_mul(v, end[1], end[1]);
        mpq_add(t, t, v);
    }
    if (mpq_sgn(least) < 0 || mpq_cmp(t, least) < 0) mpq_set(least, t);
    mpq_clears(a[0], a[1], b[0], b[1], d[0], d[1], t, u, v, NULL);
}

static void nearest_of(mpq_t least, const char *sum)
{
    json *text = json_read(sum);
    const json *polygons = json_get(text, "polygons"), *segments = json_get(text, "degenerate_segments");
    const json *points = json_get(text, "degenerate_points");
    for (size_t p = 0; p < json_count(polygons); p++) {
        const json *holes = json_get(&polygons->item[p], "holes");
        for (size_t h = 0; h <= json_count(holes); h++) {
            const json *ring = h ? &holes->item[h - 1] : json_get(&polygons->item[p], "outer");
            for (size_t i = 0; i < json_count(ring); i++)
                take_nearer(least, &ring->item[i], &ring->item[i + 1 < ring->n ? i + 1 : 0]);
        }
    }
    for (size_t i = 0; i < json_count(segments); i++)
        take_nearer(least, &segments->item[i].item[0], &segments->item[i].item[1]);
    for (size_t i = 0; i < json_count(points); i++) take_nearer(least, &points->item[i], &points->item[i]);
    json_free(text);
}

/* Q + t is disjoint from P exactly if t is not in int P + int -Q. */
static const char *ask_least(const repaired *c, size_t i)
{
    (void)i;
    sunder_separation s;
    polyset back;
    mpq_t least, ours;
    bool overlap = false;
    if (sunder_pair_separate(c->a, c->b, 0, &s, NULL) != SUNDER_OK) return "no least translation";
    if (sunder_pair_overlap(c->a, c->b, &overlap, NULL) != SUNDER_OK) return "no overlap";
    mpq_inits(least, ours, NULL);
    polyset_copy(&back, &c->q);
    polyset_negate(&back);
    oracle *o = oracle_new_even_odd(&c->p, &back);
    const char *what = NULL;
    if (mpq_set_str(ours, s.distance_squared_text, 10)) abort();
    if (oracle_covers(o, "0", "0")) {
        char *sum = oracle_even_odd_text(&c->p, &back, false);
        mpq_set_si(least, -1, 1);
        nearest_of(least, sum);
        free(sum);
        if (!overlap)
            what = "the interiors meet";
        else if (oracle_covers(o, s.dx_text, s.dy_text))
            what = "they still meet";
    } else if (overlap) {
        what = "the interiors do not meet";
    }
    if (!what && !mpq_equal(least, ours)) what = "the length differs";
    oracle_free(o);
    polyset_free(&back);
    mpq_clears(least, ours, NULL);
    sunder_separation_clear(&s);
    return what;
}

/* ---- With a gap ---- */

static const char *judge(const polyset *p, const polyset *q, double gap, double times, const sunder_separation *s)
{
    mpq_t x, y, square, k;
    mpq_inits(x, y, square, k, NULL);
    if (mpq_set_str(x, s->dx_text, 10) || mpq_set_str(y, s->dy_text, 10) ||
        mpq_set_str(square, s->distance_squared_text, 10))
        abort();
    mpq_set_d(k, times);
    mpq_mul(x, x, k);
    mpq_mul(y, y, k);
    mpq_mul(square, square, k);
    mpq_mul(square, square, k);
    double length;
    const char *what = NULL;
    if (!gap_oracle_keeps(p, q, gap * times, x, y))
        what = "the gap is not kept";
    else if (gap_oracle_judge(p, q, gap * times, square, s->lower_bound * times * (1 - 0x1p-52), &length) != GAP_FINE)
        what = "a free place is nearer";
    mpq_clears(x, y, square, k, NULL);
    return what;
}

/* Only if a moderate factor makes all corners integers, since the brute force takes doubles. */
static const char *ask_gap(const repaired *c, size_t i)
{
    static const double GAPS[] = {1, 0.5, 2, 3.25};
    const double gap = GAPS[i % 4];
    sunder_separation s;
    if (sunder_pair_separate(c->a, c->b, gap, &s, NULL) != SUNDER_OK) return "no least translation";
    even_odd p, q;
    polyset kp, kq;
    mpz_t k;
    const char *what = NULL;
    mpz_init_set_ui(k, 1);
    even_odd_open(&p, &c->p);
    even_odd_open(&q, &c->q);
    even_odd_denominator(&p, k);
    even_odd_denominator(&q, k);
    if (p.n && q.n && mpz_sizeinbase(k, 2) < 40 && even_odd_times(&p, k, &kp)) {
        if (even_odd_times(&q, k, &kq)) {
            what = judge(&kp, &kq, gap, mpz_get_d(k), &s);
            polyset_free(&kq);
        }
        polyset_free(&kp);
    }
    even_odd_close(&p);
    even_odd_close(&q);
    mpz_clear(k);
    sunder_separation_clear(&s);
    return what;
}

/* ---- Routes ---- */

/* Is the place between two vertices of the route, given in eighths, free? */
static bool leg_is_free(const oracle *o, const sunder_route *route, size_t leg, unsigned long eighth)
{
    const char *text[2][2];
    char *at[2];
    for (size_t i = 0; i < 2; i++) sunder_route_vertex_text(route, leg + i, &text[i][0], &text[i][1]);
    for (int k = 0; k < 2; k++) {
        mpq_t a, b, t;
        mpq_inits(a, b, t, NULL);
        if (mpq_set_str(a, text[0][k], 10) || mpq_set_str(b, text[1][k], 10)) abort();
        mpq_set_ui(t, eighth, 8);
        mpq_canonicalize(t);
        mpq_sub(b, b, a);
        mpq_mul(b, b, t);
        mpq_add(a, a, b);
        at[k] = mpq_get_str(NULL, 10, a);
        mpq_clears(a, b, t, NULL);
    }
    const bool covered = oracle_covers(o, at[0], at[1]);
    free(at[0]);
    free(at[1]);
    return !covered;
}

static const char *judge_route(const sunder_route *route, const oracle *o, const char *want)
{
    const size_t n = sunder_route_vertices(route);
    char *got = sum_text(sunder_route_obstacles(route));
    const bool same = got && strcmp(got, want) == 0;
    free(got);
    if (!same) return "the obstacles differ from the oracle's";
    for (size_t leg = 0; leg + 1 < n; leg++)
        for (unsigned long eighth = 0; eighth <= 8; eighth++)
            if (!leg_is_free(o, route, leg, eighth)) return "the route is not free";
    return NULL;
}

/* If the robot's start or goal is not free, only the obstacles are compared. */
static const char *ask_route(const repaired *c, size_t i)
{
    const double *p = c->p.xy, *q = c->q.xy, far = 4 * fabs(p[2] - p[0]) + 1;
    const sunder_obstacle obstacle = {.shape = c->a};
    const sunder_place from = {.xy = {p[0] - q[0] - far, p[1] - q[1]}};
    const sunder_place to = {.xy = {p[0] - q[0] + (i % 2 ? far : 1), p[1] - q[1]}};
    sunder_route *route = NULL;
    polyset back;
    if (sunder_shape_is_empty(c->b)) return NULL;
    if (sunder_route_find(&obstacle, 1, c->b, &from, &to, NULL, &route, NULL) != SUNDER_OK) return "no answer";
    polyset_copy(&back, &c->q);
    polyset_negate(&back);
    oracle *o = oracle_new_even_odd(&c->p, &back);
    char *want = oracle_even_odd_text(&c->p, &back, false);
    const char *what = judge_route(route, o, want);
    free(want);
    oracle_free(o);
    polyset_free(&back);
    sunder_route_free(route);
    return what;
}

/* ---- Runs ---- */

typedef struct run {
    const char *name;
    question ask;
    size_t cases; /* cases of each kind */
    int most_p, most_q;
    bool near;
} run;

static const run RUNS[] = {{"sums", ask_sum, 60, 7, 4, false},
                           {"least translations", ask_least, 30, 7, 4, true},
                           {"least translations with a gap", ask_gap, 30, 6, 4, true},
                           {"routes", ask_route, 20, 7, 4, true}};

static bool holds(const run *u, invalid_kind kind, uint64_t seed, size_t i, bool shown)
{
    rng r = rng_start(seed + 31 + (uint64_t)kind * 1000003 + (uint64_t)(u - RUNS) * 7919, i);
    repaired c;
    open_case(&c, &r, kind, u->most_p, u->most_q, u->near);
    const char *what = u->ask(&c, i);
    if (what && shown) {
        char *a = polyset_wkt(&c.p), *b = polyset_wkt(&c.q);
        print_message("kind %s, SUNDER_SEED=%llu, case %zu: %s\n%s\n%s\n", invalid_kind_string(kind),
                      (unsigned long long)seed, i, what, a, b);
        free(a);
        free(b);
    }
    close_case(&c);
    return !what;
}

static void test_run(void **state)
{
    const run *u = *state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(u->cases);
    size_t bad = 0;
    for (int kind = 0; kind < INVALID_KINDS; kind++)
        for (size_t i = 0; i < n; i++)
            if (!holds(u, (invalid_kind)kind, seed, i, bad < SHOWN)) bad++;
    print_message("%s SUNDER_SEED=%llu: %zu of %zu agree\n", u->name, (unsigned long long)seed, INVALID_KINDS * n - bad,
                  INVALID_KINDS * n);
    assert_int_equal(bad, 0);
}

int main(void)
{
    struct CMUnitTest tests[4];
    for (int k = 0; k < 4; k++) tests[k] = (struct CMUnitTest){RUNS[k].name, test_run, NULL, NULL, (void *)&RUNS[k]};
    return cmocka_run_group_tests_name("repaired operands against brute force", tests, NULL, NULL);
}
