/* Freeness by cutting both sets into vertical slabs, and positions of pairs, for the tests of separation. In rationals;
 * shares no code with the library. */
#ifndef SUNDER_TESTS_SEPARATION_ORACLE_H
#define SUNDER_TESTS_SEPARATION_ORACLE_H

#include "generate.h"

#include <gmp.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

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

static int compare_rationals(const void *a, const void *b) { return mpq_cmp(*(const mpq_t *)a, *(const mpq_t *)b); }

typedef struct crossing {
    mpq_t y;
    int set, member;
} crossing;

static int compare_crossings(const void *a, const void *b)
{
    return mpq_cmp(((const crossing *)a)->y, ((const crossing *)b)->y);
}

/* What a vertical line is asked: does it run through both interiors at once; through the first set outside the second?
 */
typedef enum question { MEET, ESCAPE } question;

/* By parity within each member. */
static bool line_says(const edge *e, size_t n, const mpq_t x, question what)
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
        both |= p && (what == MEET ? q : !q);
    }
    for (size_t i = 0; i < m; i++) mpq_clear(c[i].y);
    free(c);
    return both;
}

/* Of P and Q + (x, y); NULLs for zero. */
static bool ask_slabs(const polyset *p, const polyset *q, const mpq_t *x, const mpq_t *y, question what)
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
        meet = line_says(e, n, middle, what);
    }
    mpq_clears(middle, two, NULL);
    for (size_t i = 0; i < m; i++) mpq_clear(xs[i]);
    for (size_t i = 0; i < n; i++) mpq_clears(e[i].ax, e[i].ay, e[i].bx, e[i].by, NULL);
    free(xs);
    free(e);
    return meet;
}

static inline bool interiors_meet(const polyset *p, const polyset *q, const mpq_t *x, const mpq_t *y)
{
    return ask_slabs(p, q, x, y, MEET);
}

/* Is some interior point of P outside Q? */
static inline bool escapes(const polyset *p, const polyset *q) { return ask_slabs(p, q, NULL, NULL, ESCAPE); }

/* Moves q over p, a few units off. */
static inline void bring_together(const polyset *p, polyset *q, rng *r)
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

#endif
