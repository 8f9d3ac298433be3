/* The least translation that separates two sets lies on the boundary of the set of translations that do not, on a
 * segment made by an edge of one and a vertex of the other. So it is an end of such a segment, the foot of the
 * perpendicular from the origin, or a crossing of two segments. Candidates are sorted by their lengths in doubles;
 * those that may be the shortest are computed in rationals, and vertical slabs decide whether they separate the two. */
#include "standing.h"

#include "slabs.h"

#include <math.h>
#include <stdlib.h>

typedef struct contact {
    mpq_t x, y, dx, dy;
    double at[2], along[2];
} contact;

typedef struct candidate {
    double length;
    size_t first, second; /* contacts; both equal: a foot or an end */
    int kind;             /* 0, 1: ends; 2: the foot; 3: the crossing */
} candidate;

static void difference(mpq_t out, double x, double y)
{
    mpq_t t;
    mpq_init(t);
    mpq_set_d(out, x);
    mpq_set_d(t, y);
    mpq_sub(out, out, t);
    mpq_clear(t);
}

/* The edges of p minus the vertices of q; `negative`: multiplied by -1. */
static size_t add_contacts(contact *c, const polyset *p, const polyset *q, bool negative)
{
    size_t n = 0;
    for (size_t r = 0, v = 0; r < p->rings; r++) {
        const size_t first = v, end = p->ring_end[r];
        for (; v < end; v++) {
            const double *a = p->xy + 2 * v, *b = p->xy + 2 * (v + 1 < end ? v + 1 : first);
            for (size_t k = 0; k < q->vertices; k++, n++) {
                mpq_inits(c[n].x, c[n].y, c[n].dx, c[n].dy, NULL);
                difference(c[n].x, a[0], q->xy[2 * k]);
                difference(c[n].y, a[1], q->xy[2 * k + 1]);
                difference(c[n].dx, b[0], a[0]);
                difference(c[n].dy, b[1], a[1]);
                if (negative) {
                    mpq_neg(c[n].x, c[n].x);
                    mpq_neg(c[n].y, c[n].y);
                    mpq_neg(c[n].dx, c[n].dx);
                    mpq_neg(c[n].dy, c[n].dy);
                }
                c[n].at[0] = mpq_get_d(c[n].x);
                c[n].at[1] = mpq_get_d(c[n].y);
                c[n].along[0] = mpq_get_d(c[n].dx);
                c[n].along[1] = mpq_get_d(c[n].dy);
            }
        }
    }
    return n;
}

/* The parameter of the candidate on contact c. */
static void share_of(mpq_t s, const contact *all, const candidate *c)
{
    const contact *p = &all[c->first], *q = &all[c->second];
    mpq_t t, u;
    mpq_inits(t, u, NULL);
    if (c->kind < 2) {
        mpq_set_ui(s, (unsigned long)c->kind, 1);
    } else if (c->kind == 2) {
        mpq_mul(s, p->x, p->dx);
        mpq_mul(t, p->y, p->dy);
        mpq_add(s, s, t);
        mpq_neg(s, s);
        mpq_mul(t, p->dx, p->dx);
        mpq_mul(u, p->dy, p->dy);
        mpq_add(t, t, u);
        mpq_div(s, s, t);
    } else {
        mpq_t v;
        mpq_init(v);
        mpq_sub(t, q->x, p->x);
        mpq_sub(u, q->y, p->y);
        mpq_mul(t, t, q->dy);
        mpq_mul(u, u, q->dx);
        mpq_sub(s, t, u);
        mpq_mul(t, p->dx, q->dy);
        mpq_mul(u, p->dy, q->dx);
        mpq_sub(v, t, u);
        if (mpq_sgn(v))
            mpq_div(s, s, v);
        else
            mpq_set_ui(s, 2, 1);
        mpq_clear(v);
    }
    mpq_clears(t, u, NULL);
}

/* The distance of the origin from a contact, which is a lower bound for candidates on it. */
static double reach_of(const contact *p)
{
    const double square = p->along[0] * p->along[0] + p->along[1] * p->along[1];
    const double s = fmin(1, fmax(0, -(p->at[0] * p->along[0] + p->at[1] * p->along[1]) / square));
    return hypot(p->at[0] + s * p->along[0], p->at[1] + s * p->along[1]);
}

/* The length in doubles; infinite if the crossing is certainly not on both contacts. If both are nearly parallel,
 * doubles cannot locate the crossing; then a lower bound of the length is returned. */
static double rough_length(const contact *all, const candidate *c)
{
    const contact *p = &all[c->first], *q = &all[c->second];
    double s = c->kind;
    if (c->kind == 2)
        s = -(p->at[0] * p->along[0] + p->at[1] * p->along[1]) /
            (p->along[0] * p->along[0] + p->along[1] * p->along[1]);
    if (c->kind == 3) {
        const double x = q->at[0] - p->at[0], y = q->at[1] - p->at[1];
        const double cross = p->along[0] * q->along[1] - p->along[1] * q->along[0];
        if (fabs(cross) <= 1e-6 * hypot(p->along[0], p->along[1]) * hypot(q->along[0], q->along[1]))
            return fmax(reach_of(p), reach_of(q));
        s = (x * q->along[1] - y * q->along[0]) / cross;
        const double r = (x * p->along[1] - y * p->along[0]) / cross;
        if (!(r > -1e-6 && r < 1 + 1e-6)) return INFINITY;
    }
    if (!(s > -1e-6 && s < 1 + 1e-6)) return INFINITY;
    return hypot(p->at[0] + s * p->along[0], p->at[1] + s * p->along[1]);
}

static int by_length(const void *a, const void *b)
{
    const candidate *c = a, *d = b;
    return (c->length > d->length) - (c->length < d->length);
}

static size_t list_candidates(candidate *out, const contact *all, size_t n)
{
    size_t m = 0;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++)
            for (int kind = j < i ? 3 : 0; kind < (j < i ? 4 : 3); kind++) {
                candidate c = {0, i, j, kind};
                c.length = rough_length(all, &c);
                if (c.length < INFINITY) out[m++] = c;
            }
    qsort(out, m, sizeof *out, by_length);
    return m;
}

/* The candidate exactly, and the square of its length; false if it is not on its contact. */
static bool make(const contact *all, const candidate *c, mpq_t x, mpq_t y, mpq_t square)
{
    const contact *p = &all[c->first];
    mpq_t s;
    mpq_init(s);
    share_of(s, all, c);
    const bool on = mpq_sgn(s) >= 0 && mpq_cmp_ui(s, 1, 1) <= 0;
    mpq_mul(x, s, p->dx);
    mpq_add(x, x, p->x);
    mpq_mul(y, s, p->dy);
    mpq_add(y, y, p->y);
    mpq_mul(square, x, x);
    mpq_mul(s, y, y);
    mpq_add(square, square, s);
    mpq_clear(s);
    return on;
}

static void least_parting(mpq_t best, const polyset *a, const polyset *b)
{
    contact *all = test_alloc(2 * a->vertices * b->vertices, sizeof *all);
    size_t n = add_contacts(all, a, b, false);
    n += add_contacts(all + n, b, a, true);
    candidate *list = test_alloc(3 * n + n * n / 2, sizeof *list);
    const size_t m = list_candidates(list, all, n);
    double most = INFINITY, extent = 0;
    for (size_t k = 0; k < n; k++) extent = fmax(extent, hypot(all[k].at[0], all[k].at[1]));
    bool any = false;
    mpq_t x, y, square;
    mpq_inits(x, y, square, NULL);
    /* The approximate lengths have errors far below a millionth of the extent, or are lower bounds. */
    for (size_t k = 0; k < m && list[k].length <= most; k++) {
        if (!make(all, &list[k], x, y, square) || (any && mpq_cmp(square, best) >= 0)) continue;
        if (interiors_meet(a, b, (const mpq_t *)&x, (const mpq_t *)&y)) continue;
        mpq_set(best, square);
        any = true;
        most = sqrt(mpq_get_d(best)) * (1 + 1e-6) + 1e-6 * extent;
    }
    mpq_clears(x, y, square, NULL);
    for (size_t k = 0; k < n; k++) mpq_clears(all[k].x, all[k].y, all[k].dx, all[k].dy, NULL);
    free(all);
    free(list);
}

/* ---- Distances ---- */

static void point_square(mpq_t out, const double *c, const double *a, const double *b)
{
    mpq_t e[2], v[2], s, t;
    mpq_inits(e[0], e[1], v[0], v[1], s, t, NULL);
    for (int k = 0; k < 2; k++) {
        difference(e[k], b[k], a[k]);
        difference(v[k], c[k], a[k]);
    }
    mpq_mul(s, e[0], v[0]);
    mpq_mul(t, e[1], v[1]);
    mpq_add(s, s, t);
    mpq_mul(out, e[0], e[0]);
    mpq_mul(t, e[1], e[1]);
    mpq_add(t, out, t);
    if (mpq_sgn(s) <= 0 || mpq_sgn(t) == 0)
        mpq_set_ui(s, 0, 1);
    else if (mpq_cmp(s, t) >= 0)
        mpq_set_ui(s, 1, 1);
    else
        mpq_div(s, s, t);
    mpq_set_ui(out, 0, 1);
    for (int k = 0; k < 2; k++) {
        mpq_mul(t, s, e[k]);
        mpq_sub(t, v[k], t);
        mpq_mul(t, t, t);
        mpq_add(out, out, t);
    }
    mpq_clears(e[0], e[1], v[0], v[1], s, t, NULL);
}

static void least_distance(mpq_t best, const polyset *a, const polyset *b)
{
    bool any = false;
    mpq_t square;
    mpq_init(square);
    for (int side = 0; side < 2; side++) {
        const polyset *p = side ? b : a, *q = side ? a : b;
        for (size_t r = 0, v = 0; r < p->rings; r++) {
            const size_t first = v, end = p->ring_end[r];
            for (; v < end; v++)
                for (size_t k = 0; k < q->vertices; k++) {
                    point_square(square, q->xy + 2 * k, p->xy + 2 * v, p->xy + 2 * (v + 1 < end ? v + 1 : first));
                    if (!any || mpq_cmp(square, best) < 0) mpq_set(best, square);
                    any = true;
                }
        }
    }
    mpq_clear(square);
}

/* ---- The rule ---- */

void standing_of(standing *s, const polyset *a, const polyset *b)
{
    mpq_init(s->square);
    s->meet = interiors_meet(a, b, NULL, NULL);
    if (s->meet)
        least_parting(s->square, a, b);
    else
        least_distance(s->square, a, b);
}

void standing_clear(standing *s) { mpq_clear(s->square); }

bool stands_worse(const standing *now, const standing *was)
{
    if (now->meet != was->meet) return now->meet;
    const int order = mpq_cmp(now->square, was->square);
    return now->meet ? order > 0 : order < 0;
}

bool stands_apart(const standing *s, double gap)
{
    mpq_t g;
    mpq_init(g);
    mpq_set_d(g, gap);
    mpq_mul(g, g, g);
    const bool apart = !s->meet && mpq_cmp(s->square, g) >= 0;
    mpq_clear(g);
    return apart;
}

/* Is the relative position unchanged? Then there is nothing to compare. */
static bool same_shift(const polyset *a_was, const polyset *b_was, const polyset *a_is, const polyset *b_is)
{
    bool same = true;
    mpq_t first, now;
    mpq_inits(first, now, NULL);
    for (int c = 0; c < 2 && same; c++) {
        difference(first, a_is->xy[c], a_was->xy[c]);
        for (size_t v = 0; v < a_was->vertices + b_was->vertices && same; v++) {
            const size_t k = v < a_was->vertices ? v : v - a_was->vertices;
            const polyset *was = v < a_was->vertices ? a_was : b_was, *is = v < a_was->vertices ? a_is : b_is;
            difference(now, is->xy[2 * k + (size_t)c], was->xy[2 * k + (size_t)c]);
            same = mpq_equal(first, now);
        }
    }
    mpq_clears(first, now, NULL);
    return same;
}

const char *standing_rule(const polyset *a_was, const polyset *b_was, const polyset *a_is, const polyset *b_is,
                          double gap)
{
    if (same_shift(a_was, b_was, a_is, b_is)) return NULL;
    standing was, is;
    standing_of(&was, a_was, b_was);
    standing_of(&is, a_is, b_is);
    const char *wrong = NULL;
    if (stands_apart(&was, gap))
        wrong = "were no conflict";
    else if (stands_worse(&is, &was))
        wrong = "are worse than at the start";
    standing_clear(&was);
    standing_clear(&is);
    return wrong;
}
