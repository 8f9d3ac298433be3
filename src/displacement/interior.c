/* An interior point method for the same program, for clusters in which thousands of constraints compete.
 *
 * Mehrotra's predictor-corrector [Nocedal and Wright, Numerical Optimization, 2nd edition, section 16.6]: with slacks s
 * and forces f, both positive, H x = A'f,   A x + softness f = d + s,   s f = mu -> 0, each step solves (H + A' diag(f
 * / (s + softness f)) A) dx = r. The matrix couples bodies in contact only. Bodies are ordered along the longer side of
 * the cluster, so that it is a narrow band, and it is factored within its envelope: row by row from the first entry
 * that is not zero [George and Liu, Computer Solution of Large Sparse Positive Definite Systems, 1981, chapter 4]. The
 * steps number a dozen or two whatever the program, and what comes out lies inside the constraints, not a rounding
 * error beyond them. */
#include "displacement/quadratic.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MOST_STEPS 60

typedef struct place {
    double along;
    uint32_t body;
} place;

typedef struct interior {
    sunder_i_quadratic *p;
    size_t n, m;         /* unknowns, constraints */
    uint32_t *unknown;   /* [bodies] first of its two unknowns, or SUNDER_I_NOBODY */
    size_t *first, *row; /* [n] first column of each row, and where the row starts less that column */
    double *matrix;      /* the envelope, row by row */
    double *h, *x, *dx;  /* [n] */
    double *s, *f, *ds, *df, *rp, *rc, *soft; /* [m] */
    double *memory;
} interior;

static int by_along(const void *a, const void *b)
{
    const place *p = a, *q = b;
    if (p->along != q->along) return p->along < q->along ? -1 : 1;
    return p->body < q->body ? -1 : p->body > q->body;
}

static void interior_free(interior *q)
{
    sunder_i_free(q->unknown);
    sunder_i_free(q->first);
    sunder_i_free(q->row);
    sunder_i_free(q->matrix);
    sunder_i_free(q->memory);
}

/* Bodies that touch others far along the cluster: a block outline among its houses. One of them early in the order would make
 * every row behind it long; at the end they cost one long row each. Of two bodies far apart in the order it is the one with more
 * contacts. */
static bool mark_far_reaching(const interior *q, const place *order, bool *last)
{
    const sunder_i_quadratic *p = q->p;
    uint32_t *rank = sunder_i_alloc(p->bodies, sizeof *rank), *contacts = sunder_i_calloc(p->bodies, sizeof *contacts);
    const bool ok = rank && contacts;
    for (size_t k = 0; ok && k < p->bodies; k++) rank[order[k].body] = (uint32_t)k;
    for (size_t c = 0; ok && c < p->n; c++) {
        if (p->constraint[c].i != SUNDER_I_NOBODY) contacts[p->constraint[c].i]++;
        if (p->constraint[c].j != SUNDER_I_NOBODY) contacts[p->constraint[c].j]++;
    }
    const double band = 20 + 2 * sqrt((double)p->bodies);
    for (size_t c = 0; ok && c < p->n; c++) {
        const uint32_t i = p->constraint[c].i, j = p->constraint[c].j;
        if (i == SUNDER_I_NOBODY || j == SUNDER_I_NOBODY) continue;
        if (fabs((double)rank[i] - (double)rank[j]) <= band || last[i] || last[j]) continue;
        last[contacts[i] > contacts[j] || (contacts[i] == contacts[j] && i < j) ? i : j] = true;
    }
    sunder_i_free(rank);
    sunder_i_free(contacts);
    return ok;
}

/* Numbers the unknowns along the cluster, far-reaching bodies last; where gives each body's place. */
static bool number_unknowns(interior *q, const double *where)
{
    const sunder_i_quadratic *p = q->p;
    place *order = sunder_i_alloc(p->bodies, sizeof *order);
    bool *last = sunder_i_calloc(p->bodies, sizeof *last);
    q->unknown = sunder_i_alloc(p->bodies, sizeof *q->unknown);
    if (!order || !last || !q->unknown) {
        sunder_i_free(order);
        sunder_i_free(last);
        return false;
    }
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t k = 0; k < 2 * p->bodies; k++) {
        low[k & 1] = fmin(low[k & 1], where[k]);
        high[k & 1] = fmax(high[k & 1], where[k]);
    }
    const size_t axis = high[0] - low[0] >= high[1] - low[1] ? 0 : 1;
    for (size_t k = 0; k < p->bodies; k++) order[k] = (place){where[2 * k + axis], (uint32_t)k};
    qsort(order, p->bodies, sizeof *order, by_along);
    const bool ok = mark_far_reaching(q, order, last);
    q->n = 0;
    for (int late = 0; late < 2; late++)
        for (size_t k = 0; ok && k < p->bodies; k++) {
            const uint32_t b = order[k].body;
            if (last[b] != (late == 1)) continue;
            q->unknown[b] = p->mass[b] > 0 ? (uint32_t)q->n : SUNDER_I_NOBODY;
            if (p->mass[b] > 0) q->n += 2;
        }
    sunder_i_free(order);
    sunder_i_free(last);
    return ok;
}

static uint32_t unknown_of(const interior *q, uint32_t body)
{
    return body == SUNDER_I_NOBODY ? SUNDER_I_NOBODY : q->unknown[body];
}

/* Which entries the matrix has: from the first body that a body is in contact with. */
static bool shape_matrix(interior *q)
{
    q->first = sunder_i_alloc(q->n, sizeof *q->first);
    q->row = sunder_i_alloc(q->n, sizeof *q->row);
    if (!q->first || !q->row) return false;
    for (size_t k = 0; k < q->n; k++) q->first[k] = k & ~(size_t)1;
    for (size_t c = 0; c < q->m; c++) {
        const uint32_t a = unknown_of(q, q->p->constraint[c].i), b = unknown_of(q, q->p->constraint[c].j);
        if (a == SUNDER_I_NOBODY || b == SUNDER_I_NOBODY) continue;
        const size_t low = a < b ? a : b, high = a < b ? b : a;
        for (size_t r = high; r < high + 2; r++)
            if (q->first[r] > low) q->first[r] = low;
    }
    size_t size = 0;
    for (size_t r = 0; r < q->n; r++) {
        q->row[r] = size - q->first[r];
        size += r - q->first[r] + 1;
    }
    q->matrix = sunder_i_alloc(size, sizeof *q->matrix);
    return q->matrix;
}

static void add_entry(interior *q, size_t r, size_t c, double v)
{
    if (c <= r)
        q->matrix[q->row[r] + c] += v;
    else
        q->matrix[q->row[c] + r] += v;
}

static void fill_matrix(interior *q)
{
    for (size_t r = 0; r < q->n; r++) {
        for (size_t c = q->first[r]; c < r; c++) q->matrix[q->row[r] + c] = 0;
        q->matrix[q->row[r] + r] = q->h[r];
    }
    for (size_t c = 0; c < q->m; c++) {
        const sunder_i_constraint *k = &q->p->constraint[c];
        const uint32_t a = unknown_of(q, k->i), b = unknown_of(q, k->j);
        const double v = q->f[c] / (q->s[c] + q->soft[c] * q->f[c]);
        for (size_t r = 0; r < 2; r++)
            for (size_t e = 0; e < 2; e++) {
                const double w = v * k->n[r] * k->n[e];
                if (a != SUNDER_I_NOBODY && e <= r) add_entry(q, a + r, a + e, w);
                if (b != SUNDER_I_NOBODY && e <= r) add_entry(q, b + r, b + e, w);
                if (a != SUNDER_I_NOBODY && b != SUNDER_I_NOBODY) add_entry(q, a + r, b + e, -w);
            }
    }
}

static bool factor(interior *q)
{
    uint64_t work = 0;
    for (size_t r = 0; r < q->n; r++) {
        double *row = q->matrix + q->row[r];
        for (size_t c = q->first[r]; c < r; c++) {
            const double *other = q->matrix + q->row[c];
            double v = row[c];
            const size_t from = q->first[r] > q->first[c] ? q->first[r] : q->first[c];
            for (size_t k = from; k < c; k++) v -= row[k] * other[k];
            row[c] = v / other[c];
            work += c - from;
        }
        double v = row[r];
        for (size_t k = q->first[r]; k < r; k++) v -= row[k] * row[k];
        if (!(v > 0)) return false;
        row[r] = sqrt(v);
    }
    q->p->work += work / 16 + 4 * q->m;
    return true;
}

static void back_solve(interior *q, double *x)
{
    for (size_t r = 0; r < q->n; r++) {
        const double *row = q->matrix + q->row[r];
        for (size_t k = q->first[r]; k < r; k++) x[r] -= row[k] * x[k];
        x[r] /= row[r];
    }
    for (size_t r = q->n; r-- > 0;) {
        const double *row = q->matrix + q->row[r];
        x[r] /= row[r];
        for (size_t k = q->first[r]; k < r; k++) x[k] -= row[k] * x[r];
    }
}

/* (A x) of constraint c. */
static double stretch(const interior *q, size_t c, const double *x)
{
    const sunder_i_constraint *k = &q->p->constraint[c];
    const uint32_t a = unknown_of(q, k->i), b = unknown_of(q, k->j);
    double v = 0;
    if (b != SUNDER_I_NOBODY) v += k->n[0] * x[b] + k->n[1] * x[b + 1];
    if (a != SUNDER_I_NOBODY) v -= k->n[0] * x[a] + k->n[1] * x[a + 1];
    return v;
}

/* x += A' v for one constraint. */
static void spread(const interior *q, size_t c, double v, double *x)
{
    const sunder_i_constraint *k = &q->p->constraint[c];
    const uint32_t a = unknown_of(q, k->i), b = unknown_of(q, k->j);
    for (size_t e = 0; e < 2; e++) {
        if (b != SUNDER_I_NOBODY) x[b + e] += v * k->n[e];
        if (a != SUNDER_I_NOBODY) x[a + e] -= v * k->n[e];
    }
}

/* The Newton step for the complementarity rc, with the factor as it stands. */
static void direction(interior *q)
{
    for (size_t k = 0; k < q->n; k++) q->dx[k] = -q->h[k] * q->x[k];
    for (size_t c = 0; c < q->m; c++)
        spread(q, c, q->f[c] - (q->rc[c] + q->f[c] * q->rp[c]) / (q->s[c] + q->soft[c] * q->f[c]), q->dx);
    back_solve(q, q->dx);
    for (size_t c = 0; c < q->m; c++) {
        const double a = stretch(q, c, q->dx);
        q->df[c] = -(q->rc[c] + q->f[c] * (q->rp[c] + a)) / (q->s[c] + q->soft[c] * q->f[c]);
        q->ds[c] = a + q->soft[c] * q->df[c] + q->rp[c];
    }
}

/* How far s and f can go and stay positive. */
static double longest(const interior *q)
{
    double step = 1;
    for (size_t c = 0; c < q->m; c++) {
        if (q->ds[c] < 0) step = fmin(step, -q->s[c] / q->ds[c]);
        if (q->df[c] < 0) step = fmin(step, -q->f[c] / q->df[c]);
    }
    return step;
}

static double mean_product(const interior *q, double step)
{
    double mu = 0;
    for (size_t c = 0; c < q->m; c++) mu += (q->s[c] + step * q->ds[c]) * (q->f[c] + step * q->df[c]);
    return mu / (double)q->m;
}

/* One step. Returns false when there is no use in going on. */
static bool advance(interior *q, double tolerance, double *mu)
{
    double missed = 0, cost = 0;
    for (size_t c = 0; c < q->m; c++) {
        q->rp[c] = stretch(q, c, q->x) - q->p->constraint[c].d - q->s[c] + q->soft[c] * q->f[c];
        missed = fmax(missed, fabs(q->rp[c]));
        q->rc[c] = q->s[c] * q->f[c];
        q->ds[c] = q->df[c] = 0;
    }
    for (size_t k = 0; k < q->n; k++) cost += q->h[k] * q->x[k] * q->x[k] / 2;
    *mu = mean_product(q, 0);
    if (missed <= tolerance && *mu * (double)q->m <= 1e-8 * cost) return false;
    fill_matrix(q);
    if (!factor(q)) return false;
    direction(q);
    const double affine = longest(q), ratio = mean_product(q, affine) / *mu, centre = ratio * ratio * ratio * *mu;
    for (size_t c = 0; c < q->m; c++) q->rc[c] = q->s[c] * q->f[c] + q->ds[c] * q->df[c] - centre;
    direction(q);
    const double free_step = longest(q), step = free_step < 1 ? 0.99 * free_step : 1;
    for (size_t k = 0; k < q->n; k++) q->x[k] += step * q->dx[k];
    for (size_t c = 0; c < q->m; c++) {
        q->s[c] += step * q->ds[c];
        q->f[c] += step * q->df[c];
    }
    return step > 1e-8;
}

bool sunder_i_quadratic_interior(sunder_i_quadratic *p, double softness, double tolerance, double scale,
                                 const double *where)
{
    if (p->n == 0) return true;
    interior q;
    memset(&q, 0, sizeof q);
    q.p = p;
    q.m = p->n;
    bool ok = number_unknowns(&q, where) && shape_matrix(&q);
    if (ok) {
        q.memory = sunder_i_calloc(3 * q.n + 7 * q.m, sizeof *q.memory);
        ok = q.memory;
    }
    if (ok && q.n) {
        double *next = q.memory, mean = 0, mu;
        double **vector[] = {&q.h, &q.x, &q.dx, &q.s, &q.f, &q.ds, &q.df, &q.rp, &q.rc, &q.soft};
        for (size_t v = 0; v < sizeof vector / sizeof *vector; v++) {
            *vector[v] = next;
            next += v < 3 ? q.n : q.m;
        }
        for (size_t b = 0; b < p->bodies; b++) {
            if (q.unknown[b] == SUNDER_I_NOBODY) continue;
            for (size_t e = 0; e < 2; e++) {
                q.h[q.unknown[b] + e] = 1 / p->mass[b];
                q.x[q.unknown[b] + e] = p->t[2 * b + e];
            }
            mean += 2 / p->mass[b] / (double)q.n;
        }
        for (size_t c = 0; c < q.m; c++) {
            const sunder_i_constraint *k = &p->constraint[c];
            q.soft[c] = softness * (sunder_i_mass(p, k->i) + sunder_i_mass(p, k->j));
            q.s[c] = fmax(stretch(&q, c, q.x) - k->d, 0.1 * scale);
            q.f[c] = 0.1 * mean * scale * scale / q.s[c];
        }
        for (int k = 0; k < MOST_STEPS && advance(&q, tolerance, &mu); k++) continue;
        for (size_t b = 0; b < p->bodies; b++)
            for (size_t e = 0; e < 2; e++)
                p->t[2 * b + e] = q.unknown[b] == SUNDER_I_NOBODY ? 0 : q.x[q.unknown[b] + e];
        /* Forces that fade are of constraints that do not act. */
        for (size_t c = 0; c < q.m; c++) p->constraint[c].force = q.f[c] > 1e-9 * mean * scale ? q.f[c] : 0;
    }
    interior_free(&q);
    return ok;
}
