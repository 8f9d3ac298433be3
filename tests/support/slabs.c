#include "slabs.h"

#include <stdlib.h>

#define MEMBERS_MAX 64

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
                if (s->xy[2 * v] == s->xy[2 * w]) continue; /* vertical: does not bound a slab from above or below */
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

/* Sets `out` to the y of the edge at x. */
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

/* Adds the x of the crossing of two edges, if the crossing lies within both. */
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

/* The points at which edges meet a vertical line that contains no end of an edge, in order; freed by
 * clear_crossings(). */
static crossing *crossings_of(const edge *e, size_t n, const mpq_t x, size_t *count)
{
    crossing *c = test_alloc(n, sizeof *c);
    size_t m = 0;
    for (size_t i = 0; i < n; i++)
        if (mpq_cmp(e[i].ax, x) < 0 && mpq_cmp(x, e[i].bx) < 0) {
            mpq_init(c[m].y);
            height(c[m].y, e + i, x);
            c[m].set = e[i].set;
            c[m++].member = e[i].member;
        }
    if (m) qsort(c, m, sizeof *c, compare_crossings);
    *count = m;
    return c;
}

static void clear_crossings(crossing *c, size_t n)
{
    for (size_t i = 0; i < n; i++) mpq_clear(c[i].y);
    free(c);
}

/* The questions decided on a vertical line: does it meet both interiors at the same place, or the first set outside the
 * second? */
typedef enum question { MEET, ESCAPE } question;

/* By the even-odd rule within each member. */
static bool line_says(const edge *e, size_t n, const mpq_t x, question what)
{
    size_t m;
    crossing *c = crossings_of(e, n, x, &m);
    bool in[2][MEMBERS_MAX] = {{false}}, yes = false;
    for (size_t i = 0; i < m; i++) {
        in[c[i].set][c[i].member] ^= true;
        if (i + 1 < m && mpq_equal(c[i].y, c[i + 1].y)) continue;
        bool p = false, q = false;
        for (int k = 0; k < MEMBERS_MAX; k++) {
            p |= in[0][k];
            q |= in[1][k];
        }
        yes |= p && (what == MEET ? q : !q);
    }
    clear_crossings(c, m);
    return yes;
}

/* The length of the part of a vertical line that the members cover together. */
static void covered_length(mpq_t length, const edge *e, size_t n, const mpq_t x)
{
    size_t m, covers = 0;
    crossing *c = crossings_of(e, n, x, &m);
    bool in[MEMBERS_MAX] = {false};
    mpq_set_ui(length, 0, 1);
    for (size_t i = 0; i < m; i++) {
        covers = in[c[i].member] ? covers - 1 : covers + 1;
        in[c[i].member] ^= true;
        if (!covers || i + 1 == m) continue;
        mpq_add(length, length, c[i + 1].y);
        mpq_sub(length, length, c[i].y);
    }
    clear_crossings(c, m);
}

typedef struct slabs {
    edge *e;
    mpq_t *x; /* borders of slabs, in order, some of them equal */
    size_t edges, borders;
} slabs;

/* Slabs of P and Q + (x, y). NULL: no Q, or zero. */
static void slabs_open(slabs *s, const polyset *p, const polyset *q, const mpq_t *x, const mpq_t *y)
{
    s->e = test_alloc(p->vertices + (q ? q->vertices : 0), sizeof *s->e);
    size_t n = load_edges(s->e, p, 0, NULL, NULL), m = 0;
    if (q) n += load_edges(s->e + n, q, 1, x, y);
    s->x = test_alloc(2 * n + n * n, sizeof *s->x);
    for (size_t i = 0; i < n; i++) {
        mpq_init(s->x[m]);
        mpq_set(s->x[m++], s->e[i].ax);
        mpq_init(s->x[m]);
        mpq_set(s->x[m++], s->e[i].bx);
        for (size_t j = 0; j < i; j++) m = add_crossing(s->x, m, s->e + i, s->e + j);
    }
    if (m) qsort(s->x, m, sizeof *s->x, compare_rationals);
    s->edges = n;
    s->borders = m;
}

static void slabs_close(slabs *s)
{
    for (size_t i = 0; i < s->borders; i++) mpq_clear(s->x[i]);
    for (size_t i = 0; i < s->edges; i++) mpq_clears(s->e[i].ax, s->e[i].ay, s->e[i].bx, s->e[i].by, NULL);
    free(s->x);
    free(s->e);
}

/* The x in the middle of slab i; false if the slab has no width. */
static bool slab_middle(mpq_t middle, const slabs *s, size_t i)
{
    if (mpq_equal(s->x[i], s->x[i + 1])) return false;
    mpq_add(middle, s->x[i], s->x[i + 1]);
    mpq_div_2exp(middle, middle, 1);
    return true;
}

static bool ask_slabs(const polyset *p, const polyset *q, const mpq_t *x, const mpq_t *y, question what)
{
    slabs s;
    bool yes = false;
    mpq_t middle;
    mpq_init(middle);
    slabs_open(&s, p, q, x, y);
    for (size_t i = 0; i + 1 < s.borders && !yes; i++)
        if (slab_middle(middle, &s, i)) yes = line_says(s.e, s.edges, middle, what);
    slabs_close(&s);
    mpq_clear(middle);
    return yes;
}

bool interiors_meet(const polyset *p, const polyset *q, const mpq_t *x, const mpq_t *y)
{
    return ask_slabs(p, q, x, y, MEET);
}

bool escapes(const polyset *p, const polyset *q) { return ask_slabs(p, q, NULL, NULL, ESCAPE); }

void area_by_slabs(mpq_t area, const polyset *set)
{
    slabs s;
    mpq_t middle, width, length;
    mpq_inits(middle, width, length, NULL);
    mpq_set_ui(area, 0, 1);
    slabs_open(&s, set, NULL, NULL, NULL);
    for (size_t i = 0; i + 1 < s.borders; i++) {
        if (!slab_middle(middle, &s, i)) continue;
        /* edges do not cross within a slab, so the length in its middle is the mean length */
        covered_length(length, s.e, s.edges, middle);
        mpq_sub(width, s.x[i + 1], s.x[i]);
        mpq_mul(width, width, length);
        mpq_add(area, area, width);
    }
    slabs_close(&s);
    mpq_clears(middle, width, length, NULL);
}
