/* The membership test: sums of triangles as half-planes. */
#include "oracle_inner.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void hpoint_init(hpoint *p)
{
    mpz_inits(p->x, p->y, p->w, NULL);
    p->ax = p->ay = 0;
}

void hpoint_clear(hpoint *p) { mpz_clears(p->x, p->y, p->w, NULL); }

/* Approximates n / d * 2^-shift, with a relative error below 1e-15 within the range of doubles. */
static double near_ratio(const mpz_t n, const mpz_t d, long shift)
{
    long e, f;
    const double a = mpz_get_d_2exp(&e, n), b = mpz_get_d_2exp(&f, d);
    const long up = e - f - shift;
    return ldexp(a / b, up > 5000 ? 5000 : up < -5000 ? -5000 : (int)up);
}

void hpoint_finish(const oracle *o, hpoint *p)
{
    mpz_t g;
    mpz_init(g);
    mpz_gcd(g, p->x, p->y);
    mpz_gcd(g, g, p->w);
    if (mpz_sgn(p->w) < 0) mpz_neg(g, g);
    if (mpz_cmp_ui(g, 1)) {
        mpz_divexact(p->x, p->x, g);
        mpz_divexact(p->y, p->y, g);
        mpz_divexact(p->w, p->w, g);
    }
    mpz_clear(g);
    p->ax = near_ratio(p->x, p->w, o->shift);
    p->ay = near_ratio(p->y, p->w, o->shift);
}

static int cmp_ratio(const mpz_t a, const mpz_t v, const mpz_t b, const mpz_t w)
{
    mpz_t s, t;
    mpz_inits(s, t, NULL);
    mpz_mul(s, a, w);
    mpz_mul(t, b, v);
    const int c = mpz_cmp(s, t);
    mpz_clears(s, t, NULL);
    return (c > 0) - (c < 0);
}

/* If the two approximations differ by more than this, their order is certain. */
static int cmp_near(double a, double b)
{
    const double slack = 1e-12 * (fabs(a) + fabs(b));
    if (!(slack > 1e-290) || isinf(slack)) return 0;
    return a < b - slack ? -1 : a > b + slack ? 1 : 0;
}

int hpoint_cmp(const hpoint *a, const hpoint *b)
{
    int c = cmp_near(a->ax, b->ax);
    if (!c) c = cmp_ratio(a->x, a->w, b->x, b->w);
    if (c) return c;
    c = cmp_near(a->ay, b->ay);
    return c ? c : cmp_ratio(a->y, a->w, b->y, b->w);
}

static int low_bit(double v)
{
    int e;
    if (v == 0) return INT_MAX;
    uint64_t m = (uint64_t)fabs(ldexp(frexp(v, &e), 53));
    for (e -= 53; !(m & 1); m >>= 1) e++;
    return e;
}

static void extent(const polyset *set, int *low, double *high)
{
    for (size_t i = 0; i < 2 * set->vertices; i++) {
        const int b = low_bit(set->xy[i]);
        if (b < *low) *low = b;
        if (fabs(set->xy[i]) > *high) *high = fabs(set->xy[i]);
    }
}

/* The side of T + S with the outward normal of an edge ab of T (or S): h = max over T + max over S of n . x. */
static void make_side(const oracle *o, halfplane *s, const zpoint *a, const zpoint *b, const zpoint *const t[3],
                      const zpoint *const u[3])
{
    mpz_inits(s->nx, s->ny, s->h, NULL);
    mpz_sub(s->nx, b->y, a->y);
    mpz_sub(s->ny, a->x, b->x);
    mpz_t best, v;
    mpz_inits(best, v, NULL);
    for (int set = 0; set < 2; set++) {
        const zpoint *const *c = set ? u : t;
        for (int i = 0; i < 3; i++) {
            mpz_mul(v, s->nx, c[i]->x);
            mpz_addmul(v, s->ny, c[i]->y);
            if (i == 0 || mpz_cmp(v, best) > 0) mpz_set(best, v);
        }
        mpz_add(s->h, s->h, best);
    }
    mpz_set_ui(v, 1);
    s->anx = near_ratio(s->nx, v, o->shift);
    s->any = near_ratio(s->ny, v, o->shift);
    s->ah = near_ratio(s->h, v, 2 * o->shift);
    mpz_clears(best, v, NULL);
}

static void make_box(const oracle *o, double box[4], const zpoint *const t[3], const zpoint *const u[3])
{
    mpz_t v, one;
    mpz_inits(v, one, NULL);
    mpz_set_ui(one, 1);
    for (int i = 0; i < 9; i++)
        for (int d = 0; d < 2; d++) {
            mpz_add(v, d ? t[i / 3]->y : t[i / 3]->x, d ? u[i % 3]->y : u[i % 3]->x);
            const double c = near_ratio(v, one, o->shift), slack = 1e-13 * fabs(c) + 1e-300;
            if (i == 0 || c - slack < box[d]) box[d] = c - slack;
            if (i == 0 || c + slack > box[2 + d]) box[2 + d] = c + slack;
        }
    mpz_clears(v, one, NULL);
}

/* Called after both operands are loaded. */
static void make_subsums(oracle *o)
{
    oracle_triangulate(o, &o->p);
    oracle_triangulate(o, &o->q);
    o->sub = test_alloc(o->p.triangles * o->q.triangles, sizeof *o->sub);
    o->subsums = 0;
    for (size_t i = 0; i < o->p.triangles; i++)
        for (size_t j = 0; j < o->q.triangles; j++) {
            subsum *s = &o->sub[o->subsums++];
            const zpoint *t[3], *u[3];
            for (size_t c = 0; c < 3; c++) {
                t[c] = &o->p.v[o->p.triangle[3 * i + c]];
                u[c] = &o->q.v[o->q.triangle[3 * j + c]];
            }
            for (int c = 0; c < 3; c++) {
                make_side(o, &s->side[c], t[c], t[(c + 1) % 3], t, u);
                make_side(o, &s->side[3 + c], u[c], u[(c + 1) % 3], t, u);
            }
            make_box(o, s->box, t, u);
        }
}

oracle *oracle_new(const polyset *p, const polyset *q)
{
    oracle *o = test_alloc(1, sizeof *o);
    int low = INT_MAX, e;
    double high = 0;
    extent(p, &low, &high);
    extent(q, &low, &high);
    if (low == INT_MAX) low = 0;
    o->shift = -low;
    mpq_init(o->unit);
    mpq_set_ui(o->unit, 1, 1);
    if (low >= 0)
        mpq_mul_2exp(o->unit, o->unit, (mp_bitcnt_t)low);
    else
        mpq_div_2exp(o->unit, o->unit, (mp_bitcnt_t)-low);
    frexp(high, &e);
    o->small = e - low < 58;
    oracle_load(o, &o->p, p);
    oracle_load(o, &o->q, q);
    make_subsums(o);
    return o;
}

oracle *oracle_new_even_odd(const polyset *p, const polyset *q)
{
    oracle *o = test_alloc(1, sizeof *o);
    even_odd a, b;
    mpz_t factor;
    even_odd_open(&a, p);
    even_odd_open(&b, q);
    mpz_init_set_ui(factor, 1);
    even_odd_denominator(&a, factor);
    even_odd_denominator(&b, factor);
    o->shift = (long)mpz_sizeinbase(factor, 2) - 1;
    mpq_init(o->unit);
    mpq_set_z(o->unit, factor);
    mpq_inv(o->unit, o->unit);
    o->small = false;
    oracle_load_even_odd(o, &o->p, &a, factor);
    oracle_load_even_odd(o, &o->q, &b, factor);
    mpz_clear(factor);
    even_odd_close(&a);
    even_odd_close(&b);
    make_subsums(o);
    return o;
}

void oracle_free(oracle *o)
{
    if (!o) return;
    for (size_t i = 0; i < o->subsums; i++)
        for (int c = 0; c < 6; c++) mpz_clears(o->sub[i].side[c].nx, o->sub[i].side[c].ny, o->sub[i].side[c].h, NULL);
    free(o->sub);
    mpq_clear(o->unit);
    oracle_unload(&o->p);
    oracle_unload(&o->q);
    free(o);
}

/* Sign of n . x - h. Each double has an error of at most 1e-15; the bound is a hundred times their joint error. */
static int side_of(const halfplane *s, const hpoint *x)
{
    const double a = s->anx * x->ax, b = s->any * x->ay, v = a + b - s->ah;
    const double size = fabs(a) + fabs(b) + fabs(s->ah);
    if (size > 1e-280 && size < 1e300 && fabs(v) > 1e-13 * size) return v < 0 ? -1 : 1;
    mpz_t t;
    mpz_init(t);
    mpz_mul(t, s->nx, x->x);
    mpz_addmul(t, s->ny, x->y);
    mpz_submul(t, s->h, x->w);
    const int sign = mpz_sgn(t);
    mpz_clear(t);
    return sign;
}

static bool points_inward(const halfplane *s, const zpoint *d)
{
    mpz_t t;
    mpz_init(t);
    mpz_mul(t, s->nx, d->x);
    mpz_addmul(t, s->ny, d->y);
    const bool in = mpz_sgn(t) < 0;
    mpz_clear(t);
    return in;
}

bool oracle_covered(const oracle *o, const hpoint *x, const zpoint *direction)
{
    const double slack_x = 1e-13 * fabs(x->ax) + 1e-300, slack_y = 1e-13 * fabs(x->ay) + 1e-300;
    for (size_t i = 0; i < o->subsums; i++) {
        const subsum *s = &o->sub[i];
        if (x->ax + slack_x < s->box[0] || x->ax - slack_x > s->box[2] || x->ay + slack_y < s->box[1] ||
            x->ay - slack_y > s->box[3])
            continue;
        bool in = true;
        for (int c = 0; c < 6 && in; c++) {
            const int side = side_of(&s->side[c], x);
            in = side < 0 || (side == 0 && direction && points_inward(&s->side[c], direction));
        }
        if (in) return true;
    }
    return false;
}

bool oracle_covers(const oracle *o, const char *x, const char *y)
{
    mpq_t a, b;
    mpq_inits(a, b, NULL);
    if (mpq_set_str(a, x, 10) || mpq_set_str(b, y, 10)) abort();
    mpq_canonicalize(a);
    mpq_canonicalize(b);
    mpq_div(a, a, o->unit);
    mpq_div(b, b, o->unit);
    hpoint h;
    hpoint_init(&h);
    mpz_mul(h.x, mpq_numref(a), mpq_denref(b));
    mpz_mul(h.y, mpq_numref(b), mpq_denref(a));
    mpz_mul(h.w, mpq_denref(a), mpq_denref(b));
    hpoint_finish(o, &h);
    const bool in = oracle_covered(o, &h, NULL);
    hpoint_clear(&h);
    mpq_clears(a, b, NULL);
    return in;
}

double *oracle_triangles(const polyset *set, size_t *count)
{
    polyset none;
    polyset_init(&none);
    oracle *o = oracle_new(set, &none);
    double *xy = test_alloc(6 * o->p.triangles, sizeof *xy);
    mpz_t one;
    mpz_init_set_ui(one, 1);
    *count = o->p.triangles;
    for (size_t i = 0; i < 3 * *count; i++) {
        const zpoint *v = &o->p.v[o->p.triangle[i]];
        xy[2 * i] = near_ratio(v->x, one, o->shift); /* exact, since the coordinates were doubles */
        xy[2 * i + 1] = near_ratio(v->y, one, o->shift);
    }
    mpz_clear(one);
    oracle_free(o);
    return xy;
}

/* Returns the text, and frees the oracle. */
static char *text_of(oracle *o, bool all_segments)
{
    oracle_map map;
    oracle_map_build(o, all_segments, &map);
    char *text = oracle_map_text(o, &map);
    oracle_map_free(&map);
    oracle_free(o);
    return text;
}

char *oracle_sum_text(const polyset *p, const polyset *q, bool all_segments)
{
    return text_of(oracle_new(p, q), all_segments);
}

char *oracle_even_odd_text(const polyset *p, const polyset *q, bool all_segments)
{
    return text_of(oracle_new_even_odd(p, q), all_segments);
}

int oracle_verdict(const char *ours, const polyset *p, const polyset *q, const char *kind, uint64_t seed, size_t i)
{
    char *expected = oracle_sum_text(p, q, false);
    const bool same = strcmp(ours, expected) == 0;
    if (!same) {
        char *a = polyset_wkt(p), *b = polyset_wkt(q);
        printf("%s, SUNDER_SEED=%llu, case %zu\n%s\n%s\n  ours   %.2000s\n  oracle %.2000s\n", kind,
               (unsigned long long)seed, i, a, b, ours, expected);
        free(a);
        free(b);
    }
    free(expected);
    return same ? 1 : -1;
}
