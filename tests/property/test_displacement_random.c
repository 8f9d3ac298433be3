/* Laws of a separated layer, on random towns.
 *
 * They are checked in rational arithmetic by code that shares nothing with src/. The features as written keep the gap,
 * except for listed pairs and pairs inside a block. Each move shifts every vertex by one vector, exactly. No move
 * exceeds its limit, and no listed pair is worse than at the start. The lower bound is computed again from the pairs
 * given with it, and every reported least separation of a pair is at most the one in the result. The report is the same
 * for every number of threads, and a check of the result agrees with it. */
#include "passage_oracle.h"
#include "random.h"
#include "run_layer.h"

#include "sunder_proof.h"

#include <gmp.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 40, CORNERS = 8 };

/* The number of towns, and the most houses in each. With half as many houses again the test takes as long as all others
 * together, so that is left to larger runs. */
enum { TOWNS = 60, HOUSES = 28 };

typedef struct house {
    double xy[2 * CORNERS + 8];
    size_t ring_end[2], rings, corners;
    sunder_shape *shape;
} house;

typedef struct town {
    house house[MOST];
    sunder_feature feature[MOST];
    size_t n;
} town;

/* ---- Random towns ----------------------------------------------------------------------------------------------- */

static void corner(house *h, double x, double y)
{
    h->xy[2 * h->corners] = x;
    h->xy[2 * h->corners++ + 1] = y;
}

/* A box, an L, a U, a slanted quadrangle, or a box with a courtyard; at coordinates as in maps, on a grid of 1/8 or
 * using all their bits. */
static void make_house(rng *r, house *h, double wide, bool grid)
{
    memset(h, 0, sizeof *h);
    const double ox = 451234.567, oy = 5411234.567;
    const double x = floor(rng_unit(r) * wide * 8) / 8, y = floor(rng_unit(r) * wide * 8) / 8;
    const double w = (double)rng_int(r, 3, 12), d = (double)rng_int(r, 3, 12), a = w / 3, b = d / 3;
    const int kind = (int)rng_int(r, 0, 4);
    if (kind == 0 || kind == 4) {
        corner(h, x, y), corner(h, x + w, y), corner(h, x + w, y + d), corner(h, x, y + d);
    } else if (kind == 1) {
        corner(h, x, y), corner(h, x + w, y), corner(h, x + w, y + b), corner(h, x + a, y + b), corner(h, x + a, y + d),
            corner(h, x, y + d);
    } else if (kind == 2) {
        corner(h, x, y), corner(h, x + w, y), corner(h, x + w, y + d), corner(h, x + 2 * a, y + d),
            corner(h, x + 2 * a, y + b);
        corner(h, x + a, y + b), corner(h, x + a, y + d), corner(h, x, y + d);
    } else {
        corner(h, x, y), corner(h, x + w, y + a), corner(h, x + w - a, y + a + d), corner(h, x - a, y + d);
    }
    h->ring_end[0] = h->corners;
    h->rings = 1;
    if (kind == 4) {
        corner(h, x + a, y + b), corner(h, x + a, y + 2 * b), corner(h, x + 2 * a, y + 2 * b),
            corner(h, x + 2 * a, y + b);
        h->ring_end[1] = h->corners;
        h->rings = 2;
    }
    for (size_t k = 0; k < 2 * h->corners; k++) {
        const double o = k & 1 ? oy : ox;
        h->xy[k] = grid ? floor(h->xy[k] * 8) / 8 + floor(o) : h->xy[k] + o;
    }
    sunder_error err;
    if (sunder_shape_from_rings(h->xy, h->ring_end, &h->rings, 1, SUNDER_VALIDITY_STRICT, &h->shape, &err))
        fail_msg("%s", err.message);
}

static void make_town(rng *r, town *t)
{
    memset(t, 0, sizeof *t);
    t->n = (size_t)rng_int(r, 2, test_count(1) > 1 ? MOST : HOUSES);
    const double wide = sqrt((double)t->n) * (double)rng_int(r, 4, 16);
    const bool grid = rng_once_in(r, 2), limits = rng_once_in(r, 3), weights = rng_once_in(r, 2);
    for (size_t k = 0; k < t->n; k++) {
        make_house(r, &t->house[k], wide, grid);
        sunder_feature *f = &t->feature[k];
        f->shape = t->house[k].shape;
        f->weight = weights ? (double)rng_int(r, 1, 64) / 8 : 1;
        f->max_shift = limits && rng_once_in(r, 3) ? (double)rng_int(r, 0, 30) / 8 : INFINITY;
        f->fixed = limits && rng_once_in(r, 10);
        f->ignored = rng_once_in(r, 40);
        f->block = rng_once_in(r, 20) ? rng_int(r, 0, 2) : -1;
    }
}

static void free_town(town *t)
{
    for (size_t k = 0; k < t->n; k++) sunder_shape_free(t->house[k].shape);
}

/* ---- Rational geometry ------------------------------------------------------------------------------------------ */

typedef struct rational {
    mpq_t a, b, c, d, e, f;
} rational;

static void open_rational(rational *q) { mpq_inits(q->a, q->b, q->c, q->d, q->e, q->f, NULL); }
static void close_rational(rational *q) { mpq_clears(q->a, q->b, q->c, q->d, q->e, q->f, NULL); }

static void difference(mpq_t out, double x, double y, mpq_t scratch)
{
    mpq_set_d(out, x);
    mpq_set_d(scratch, y);
    mpq_sub(out, out, scratch);
}

/* out = (q - p) x (r - p) */
static void cross(rational *s, mpq_t out, const double *p, const double *q, const double *r)
{
    difference(s->a, q[0], p[0], s->e);
    difference(s->b, r[1], p[1], s->e);
    difference(s->c, q[1], p[1], s->e);
    difference(s->d, r[0], p[0], s->e);
    mpq_mul(s->a, s->a, s->b);
    mpq_mul(s->c, s->c, s->d);
    mpq_sub(out, s->a, s->c);
}

static int side(rational *s, const double *p, const double *q, const double *r)
{
    cross(s, s->f, p, q, r);
    return mpq_sgn(s->f);
}

/* out = (q - p) . (r - p) */
static void dot(rational *s, mpq_t out, const double *p, const double *q, const double *r)
{
    difference(s->a, q[0], p[0], s->e);
    difference(s->b, r[0], p[0], s->e);
    difference(s->c, q[1], p[1], s->e);
    difference(s->d, r[1], p[1], s->e);
    mpq_mul(s->a, s->a, s->b);
    mpq_mul(s->c, s->c, s->d);
    mpq_add(out, s->a, s->c);
}

/* Is point r nearer to segment pq than the square root of `square`? */
static bool is_near_point(rational *s, const double *p, const double *q, const double *r, const mpq_t square)
{
    mpq_t along, whole, d;
    mpq_inits(along, whole, d, NULL);
    dot(s, along, p, q, r);
    dot(s, whole, p, q, q);
    if (mpq_sgn(along) <= 0) {
        dot(s, d, p, r, r);
    } else if (mpq_cmp(along, whole) >= 0) {
        dot(s, d, q, r, r);
    } else {
        cross(s, d, p, q, r);
        mpq_mul(d, d, d);
        mpq_div(d, d, whole);
    }
    const bool near = mpq_cmp(d, square) < 0;
    mpq_clears(along, whole, d, NULL);
    return near;
}

static bool do_cross(rational *s, const double *p, const double *q, const double *r, const double *t)
{
    return side(s, p, q, r) * side(s, p, q, t) < 0 && side(s, r, t, p) * side(s, r, t, q) < 0;
}

/* +1 inside, 0 on the boundary, -1 outside; by a ray to the right. */
static int locate(rational *s, const house *h, const double *x)
{
    bool in = false;
    size_t from = 0;
    for (size_t r = 0; r < h->rings; from = h->ring_end[r++])
        for (size_t k = from; k < h->ring_end[r]; k++) {
            const double *p = h->xy + 2 * k, *q = h->xy + 2 * (k + 1 < h->ring_end[r] ? k + 1 : from);
            if (side(s, p, q, x) == 0 && fmin(p[0], q[0]) <= x[0] && x[0] <= fmax(p[0], q[0]) &&
                fmin(p[1], q[1]) <= x[1] && x[1] <= fmax(p[1], q[1]))
                return 0;
            if ((p[1] > x[1]) == (q[1] > x[1])) continue;
            if (side(s, p, q, x) * (q[1] > p[1] ? 1 : -1) > 0) in = !in;
        }
    return in ? 1 : -1;
}

/* Are the two certainly in conflict: are boundaries nearer than the gap or crossing, or is a corner of one inside the
 * other? With a gap these are all cases. Without one a pair that overlaps although corners lie only on walls is
 * missed. */
static bool conflict(const house *a, const house *b, double gap)
{
    rational s;
    mpq_t square;
    bool bad = false;
    open_rational(&s);
    mpq_init(square);
    mpq_set_d(square, gap);
    mpq_mul(square, square, square);
    size_t fa = 0;
    for (size_t ra = 0; ra < a->rings && !bad; fa = a->ring_end[ra++])
        for (size_t i = fa; i < a->ring_end[ra] && !bad; i++) {
            const double *p = a->xy + 2 * i, *q = a->xy + 2 * (i + 1 < a->ring_end[ra] ? i + 1 : fa);
            size_t fb = 0;
            for (size_t rb = 0; rb < b->rings && !bad; fb = b->ring_end[rb++])
                for (size_t j = fb; j < b->ring_end[rb] && !bad; j++) {
                    const double *r = b->xy + 2 * j, *t = b->xy + 2 * (j + 1 < b->ring_end[rb] ? j + 1 : fb);
                    bad = do_cross(&s, p, q, r, t) || is_near_point(&s, p, q, r, square) ||
                          is_near_point(&s, r, t, p, square);
                }
        }
    for (size_t i = 0; i < a->corners && !bad; i++) bad = locate(&s, b, a->xy + 2 * i) > 0;
    for (size_t i = 0; i < b->corners && !bad; i++) bad = locate(&s, a, b->xy + 2 * i) > 0;
    mpq_clear(square);
    close_rational(&s);
    return bad;
}

/* ---- The laws --------------------------------------------------------------------------------------------------- */

/* The house as written; false if a coordinate was rounded. */
static bool write_house(const house *from, double dx, double dy, house *to)
{
    bool exact = true;
    rational s;
    open_rational(&s);
    *to = *from;
    to->shape = NULL;
    for (size_t k = 0; k < 2 * from->corners; k++) {
        to->xy[k] = from->xy[k] + (k & 1 ? dy : dx);
        mpq_set_d(s.a, from->xy[k]);
        mpq_set_d(s.b, k & 1 ? dy : dx);
        mpq_add(s.a, s.a, s.b);
        mpq_set_d(s.b, to->xy[k]);
        exact = exact && mpq_equal(s.a, s.b);
    }
    close_rational(&s);
    return exact;
}

static bool is_listed(const sunder_conflict *c, size_t n, size_t a, size_t b)
{
    for (size_t k = 0; k < n; k++)
        if (c[k].a == a && c[k].b == b) return true;
    return false;
}

static void check_pairs(const town *t, const sunder_report *report, const house *now, const sunder_layer_options *o)
{
    size_t n;
    const sunder_conflict *c = sunder_report_conflicts(report, &n);
    for (size_t a = 0; a < t->n; a++)
        for (size_t b = a + 1; b < t->n; b++) {
            if (t->feature[a].ignored || t->feature[b].ignored) continue;
            const int64_t block = sunder_report_block(report, a);
            if (block >= 0 && block == sunder_report_block(report, b)) continue;
            if (is_listed(c, n, a, b)) continue;
            if (conflict(&now[a], &now[b], o->gap))
                fail_msg("features %zu and %zu are in conflict and not listed", a, b);
        }
    /* Each listed conflict exists. */
    for (size_t k = 0; k < n; k++)
        if (o->gap > 0 && !conflict(&now[c[k].a], &now[c[k].b], o->gap))
            fail_msg("%zu and %zu are listed, but not in conflict", c[k].a, c[k].b);
}

static void check_moves(const town *t, const sunder_report *report, house *now)
{
    size_t rounded = 0;
    sunder_layer_summary s;
    sunder_report_summary(report, &s);
    for (size_t k = 0; k < t->n; k++) {
        double d[2];
        sunder_report_move(report, k, &d[0], &d[1]);
        if (!write_house(&t->house[k], d[0], d[1], &now[k])) rounded++;
        if (t->feature[k].fixed || t->feature[k].ignored) assert_true(d[0] == 0 && d[1] == 0);
        if (t->feature[k].max_shift == INFINITY) continue;
        rational q;
        open_rational(&q);
        mpq_set_d(q.a, d[0]);
        mpq_mul(q.a, q.a, q.a);
        mpq_set_d(q.b, d[1]);
        mpq_mul(q.b, q.b, q.b);
        mpq_add(q.a, q.a, q.b);
        mpq_set_d(q.b, t->feature[k].max_shift);
        mpq_mul(q.b, q.b, q.b);
        assert_true(mpq_cmp(q.a, q.b) <= 0);
        close_rational(&q);
    }
    assert_true(rounded <= s.rounded);
    assert_int_equal(s.rounded, 0); /* at such coordinates every move can be exact */
    for (size_t a = 0; a < t->n; a++)
        for (size_t b = 0; b < t->n; b++)
            if (sunder_report_block(report, a) >= 0 &&
                sunder_report_block(report, a) == sunder_report_block(report, b)) {
                double d[2], e[2];
                sunder_report_move(report, a, &d[0], &d[1]);
                sunder_report_move(report, b, &e[0], &e[1]);
                assert_true(d[0] == e[0] && d[1] == e[1]);
            }
}

static bool same_body(const sunder_report *report, size_t a, size_t b)
{
    return a == b ||
           (sunder_report_block(report, a) >= 0 && sunder_report_block(report, a) == sunder_report_block(report, b));
}

/* The bound computed from its pairs: sum l d - sum (sum l)^2 / (4 w), in rationals. */
static void check_bound(const town *t, const sunder_report *report, bool may_overlap)
{
    size_t n;
    const sunder_bound_pair *p = sunder_report_bound_pairs(report, &n);
    sunder_layer_summary s;
    sunder_report_summary(report, &s);
    mpq_t value, x, y, load, weight;
    mpq_inits(value, x, y, load, weight, NULL);
    for (size_t k = 0; k < n; k++) {
        assert_true(p[k].multiplier >= 0 && p[k].least >= 0);
        mpq_set_d(x, p[k].multiplier);
        mpq_set_d(y, p[k].least);
        mpq_mul(x, x, y);
        mpq_add(value, value, x);
        /* The reported least translation of a pair is no longer than its relative move in the result. */
        double a[2], b[2];
        sunder_report_move(report, p[k].a, &a[0], &a[1]);
        sunder_report_move(report, p[k].b, &b[0], &b[1]);
        assert_true(p[k].least <= hypot(a[0] - b[0], a[1] - b[1]) * (1 + 1e-9) + 1e-9);
    }
    for (size_t f = 0; f < t->n; f++) {
        bool first = true, still = false;
        mpq_set_ui(load, 0, 1);
        mpq_set_ui(weight, 0, 1);
        for (size_t g = 0; g < t->n; g++) {
            if (!same_body(report, f, g)) continue;
            if (g < f) first = false;
            still = still || t->feature[g].fixed || t->feature[g].max_shift == 0;
            mpq_set_d(x, t->feature[g].weight);
            mpq_add(weight, weight, x);
        }
        if (!first || still) continue;
        for (size_t k = 0; k < n; k++)
            if (same_body(report, f, p[k].a) || same_body(report, f, p[k].b)) {
                mpq_set_d(x, p[k].multiplier);
                mpq_add(load, load, x);
            }
        mpq_mul(load, load, load);
        mpq_div(load, load, weight);
        mpq_set_ui(x, 1, 4);
        mpq_mul(load, load, x);
        mpq_sub(value, value, load);
    }
    mpq_set_d(x, s.pair_bound);
    assert_true(s.pair_bound == 0 || mpq_cmp(x, value) <= 0);
    /* Trees prove slightly less for pairs than their least translations do, and nothing for pairs that may be inside
     * each other. */
    assert_true(may_overlap || s.pair_bound * (1 - 0x1p-17) <= s.lower_bound);
    assert_true(s.lower_bound <= s.cost * (1 + 1e-12));
    assert_true(s.pair_bound >= mpq_get_d(value) - 1e-9 * (1 + fabs(mpq_get_d(value))));
    mpq_clears(value, x, y, load, weight, NULL);
}

static void boundary_of(const house *h, oracle_boundary *out)
{
    polyset set;
    polyset_init(&set);
    for (size_t r = 0, v = 0; r < h->rings; v = h->ring_end[r++]) polyset_ring(&set, h->xy + 2 * v, h->ring_end[r] - v);
    polyset_end_polygon(&set);
    oracle_boundary_open(out, &set);
    polyset_free(&set);
}

/* On its path relative to another feature, no anchor met that feature, unless it was inside it; in rationals. */
static void check_jumps(const town *t, const sunder_report *report)
{
    oracle_boundary truth[MOST];
    for (size_t k = 0; k < t->n; k++) boundary_of(&t->house[k], &truth[k]);
    for (size_t a = 0; a < t->n; a++)
        for (size_t b = 0; b < t->n; b++) {
            double at[2], d[2], e[2];
            if (same_body(report, a, b) || t->feature[a].ignored || t->feature[b].ignored) continue;
            sunder_shape_anchor(t->house[a].shape, at);
            sunder_report_move(report, a, &d[0], &d[1]);
            sunder_report_move(report, b, &e[0], &e[1]);
            if (!oracle_holds(&truth[b], at) && oracle_way_meets(&truth[b], at, d, e))
                fail_msg("house %zu jumps over house %zu", a, b);
        }
    for (size_t k = 0; k < t->n; k++) oracle_boundary_close(&truth[k]);
}

static sunder_report *separate(const town *t, sunder_layer_options *o, unsigned threads)
{
    o->threads = threads;
    return run_separate(t->feature, t->n, o);
}

static void check_same(const town *t, const sunder_report *a, const sunder_report *b)
{
    sunder_layer_summary s, u;
    sunder_report_summary(a, &s);
    sunder_report_summary(b, &u);
    s.seconds_solve = u.seconds_solve = s.seconds_explain = u.seconds_explain = 0;
    s.seconds_verify = u.seconds_verify = 0;
    assert_memory_equal(&s.before, &u.before, sizeof s.before);
    assert_memory_equal(&s.after, &u.after, sizeof s.after);
    assert_true(s.cost == u.cost && s.lower_bound == u.lower_bound && s.total == u.total && s.clusters == u.clusters);
    for (size_t k = 0; k < t->n; k++) {
        double d[2], e[2];
        sunder_report_move(a, k, &d[0], &d[1]);
        sunder_report_move(b, k, &e[0], &e[1]);
        assert_memory_equal(d, e, sizeof d);
        assert_int_equal(sunder_report_status(a, k), sunder_report_status(b, k));
    }
}

/* A check of the features as written, with blocks given by number, counts what `after` says. */
/* No move violated a rule; and if the moves are derived from the coordinates alone, the check finds no violation,
 * either. */
static void check_way(const town *t, const sunder_feature *now, const sunder_layer_options *o)
{
    sunder_layer *before = NULL, *after = NULL;
    sunder_report *report = NULL;
    size_t n;
    assert_int_equal(sunder_layer_new(t->feature, t->n, &before, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_new(now, t->n, &after, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_check_moves(before, after, o, &report, NULL), SUNDER_OK);
    const sunder_conflict *c = sunder_report_conflicts(report, &n);
    if (n) fail_msg("%s: %zu and %zu", sunder_conflict_kind_string(c->kind), c->a, c->b);
    sunder_report_free(report);
    sunder_layer_free(before);
    sunder_layer_free(after);
}

static void check_again(const town *t, const sunder_report *report, const house *now,
                        const sunder_layer_options *options)
{
    sunder_feature feature[MOST];
    sunder_layer_options o = *options;
    sunder_error err;
    sunder_layer_summary s, u;
    for (size_t k = 0; k < t->n; k++) {
        sunder_shape *shape = NULL;
        feature[k] = t->feature[k];
        if (sunder_shape_from_rings(now[k].xy, now[k].ring_end, &now[k].rings, 1, SUNDER_VALIDITY_STRICT, &shape, &err))
            fail_msg("%s", err.message);
        feature[k].shape = shape;
        feature[k].block = sunder_report_block(report, k);
    }
    check_way(t, feature, &o);
    o.no_blocks = true;
    sunder_report *again = run_check(feature, t->n, &o);
    sunder_report_summary(report, &s);
    sunder_report_summary(again, &u);
    assert_memory_equal(&s.after, &u.after, sizeof s.after);
    sunder_report_free(again);
    for (size_t k = 0; k < t->n; k++) sunder_shape_free((sunder_shape *)feature[k].shape);
}

static void check_towns(void **state)
{
    const uint64_t seed = test_seed();
    const size_t towns = test_count(TOWNS);
    for (size_t k = 0; k < towns; k++) {
        rng r = rng_start(seed, k);
        town t;
        make_town(&r, &t);
        sunder_layer_options o;
        sunder_layer_options_init(&o);
        o.gap = rng_once_in(&r, 4) ? 0 : (double)rng_int(&r, 1, 24) / 8;
        o.contained = (sunder_containment)rng_int(&r, 0, 2);
        o.no_blocks = o.gap > 0 && rng_once_in(&r, 3);
        o.allow_jumps = rng_once_in(&r, 2);
        o.effort = rng_once_in(&r, 4) ? 1 : 0.1;
        print_message("town %zu of seed %llu: %zu houses, gap %g\n", k, (unsigned long long)seed, t.n, o.gap);
        sunder_report *one = separate(&t, &o, 1), *two = separate(&t, &o, 2), *three = separate(&t, &o, 3);
        house now[MOST];
        check_same(&t, one, two);
        check_same(&t, one, three);
        check_moves(&t, one, now);
        if (!o.allow_jumps) check_jumps(&t, one);
        if (o.contained != SUNDER_CONTAINMENT_IGNORE) check_pairs(&t, one, now, &o);
        check_bound(&t, one, o.contained == SUNDER_CONTAINMENT_IGNORE);
        check_again(&t, one, now, &o);
        bool free_to_move = true;
        for (size_t f = 0; f < t.n; f++)
            free_to_move = free_to_move && !t.feature[f].fixed && t.feature[f].max_shift == INFINITY;
        sunder_layer_summary s;
        sunder_report_summary(one, &s);
        assert_true(s.verified);
        /* A feature that may not jump may have to stay in a courtyard. */
        if (free_to_move && o.allow_jumps && o.contained != SUNDER_CONTAINMENT_IGNORE)
            assert_int_equal(s.after.overlap + s.after.too_close + s.after.contained + s.after.duplicate, 0);
        sunder_report_free(one);
        sunder_report_free(two);
        sunder_report_free(three);
        free_town(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_towns)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
