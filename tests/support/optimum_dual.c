/* The dual active-set method of Goldfarb and Idnani (1983) for a diagonal Hessian, in variables x = sqrt(w) t, in which
 * the Hessian is the identity; if bodies prefer other moves than 0, t counts from these. All in doubles: only the bound
 * has to be certain, a value of the dual function
 *
 *     D(l) = sum_c l_c h_c - sum_i |g_i|^2 / (4 w_i),   g_i = sum of +-l_c n_c over the rows of body i,
 *
 * which is below the optimum for every l >= 0, however l was found. Its own rounding error is subtracted: a sum of m
 * terms of k factors errs by at most (m + k) 2^-52 of the sum of the terms' absolute values. For infeasible rows there
 * is an l with g = 0 and sum l_c h_c > 0: along it D is unbounded, except for the rounding errors in g. */
#include "optimum_dual.h"

#include <math.h>
#include <string.h>

enum { DIMENSIONS = 2 * OPTIMUM_BODIES };

static const double UNIT = 0x1p-52;

typedef struct active_set {
    double normal[OPTIMUM_ROWS][DIMENSIONS], size[OPTIMUM_ROWS]; /* normals of the rows, in x; the length of each */
    size_t row[DIMENSIONS], n;                                   /* the active rows */
    double force[OPTIMUM_ROWS];                                  /* of each row; 0 if it is not active */
    double q[DIMENSIONS][DIMENSIONS], r[DIMENSIONS][DIMENSIONS]; /* normals of active rows = Q R */
    double x[DIMENSIONS];
} active_set;

static double dot(const double *a, const double *b)
{
    double sum = 0;
    for (size_t k = 0; k < DIMENSIONS; k++) sum += a[k] * b[k];
    return sum;
}

static bool stands(const optimum_problem *m, size_t body) { return body == OPTIMUM_NOBODY || m->body[body].limit == 0; }

static bool prefers(const optimum_problem *m)
{
    for (size_t k = 0; k < 2 * m->bodies; k++)
        if (m->preferred[k] != 0) return true;
    return false;
}

static void set_normals(active_set *s, const optimum_problem *m, const optimum_row *row, size_t n)
{
    for (size_t c = 0; c < n; c++) {
        double *v = s->normal[c];
        memset(v, 0, sizeof s->normal[c]);
        for (size_t k = 0; k < 2; k++) {
            if (!stands(m, row[c].a)) v[2 * row[c].a + k] -= row[c].n[k] / sqrt(m->body[row[c].a].weight);
            if (!stands(m, row[c].b)) v[2 * row[c].b + k] += row[c].n[k] / sqrt(m->body[row[c].b].weight);
        }
        s->size[c] = sqrt(dot(v, v));
    }
}

/* Gram-Schmidt, each vector twice. */
static void factor(active_set *s)
{
    memset(s->r, 0, sizeof s->r);
    for (size_t j = 0; j < s->n; j++) {
        memcpy(s->q[j], s->normal[s->row[j]], sizeof s->q[j]);
        for (int twice = 0; twice < 2; twice++)
            for (size_t i = 0; i < j; i++) {
                const double along = dot(s->q[i], s->q[j]);
                s->r[i][j] += along;
                for (size_t k = 0; k < DIMENSIONS; k++) s->q[j][k] -= along * s->q[i][k];
            }
        s->r[j][j] = sqrt(dot(s->q[j], s->q[j]));
        for (size_t k = 0; k < DIMENSIONS; k++) s->q[j][k] /= s->r[j][j];
    }
}

/* normal p = sum of y_j times the active normals + z, where z is orthogonal to them. */
static void split(const active_set *s, size_t p, double y[DIMENSIONS], double z[DIMENSIONS])
{
    double along[DIMENSIONS] = {0};
    memcpy(z, s->normal[p], DIMENSIONS * sizeof *z);
    for (int twice = 0; twice < 2; twice++)
        for (size_t j = 0; j < s->n; j++) {
            const double more = dot(s->q[j], z);
            along[j] += more;
            for (size_t k = 0; k < DIMENSIONS; k++) z[k] -= more * s->q[j][k];
        }
    for (size_t j = s->n; j-- > 0;) {
        y[j] = along[j];
        for (size_t i = j + 1; i < s->n; i++) y[j] -= s->r[j][i] * y[i];
        y[j] /= s->r[j][j];
    }
}

static void drop(active_set *s, size_t j)
{
    s->force[s->row[j]] = 0;
    for (s->n--; j < s->n; j++) s->row[j] = s->row[j + 1];
    factor(s);
}

/* Makes row p active. Returns false if no variable can move any more: then the forces are a certificate of
 * infeasibility. */
static bool enforce(active_set *s, size_t p, double h)
{
    double y[DIMENSIONS], z[DIMENSIONS];
    for (;;) {
        split(s, p, y, z);
        const double free = sqrt(dot(z, z));
        size_t first = s->n;
        double until = INFINITY;
        for (size_t j = 0; j < s->n; j++)
            if (y[j] > 1e-12 && s->force[s->row[j]] / y[j] < until) until = s->force[s->row[j]] / y[j], first = j;
        const bool moves = s->n < DIMENSIONS && free > 1e-9 * s->size[p];
        const double whole = moves ? (h - dot(s->normal[p], s->x)) / dot(z, s->normal[p]) : INFINITY;
        if (!moves && first == s->n) {
            for (size_t j = 0; j < s->n; j++) s->force[s->row[j]] = fmax(0, -y[j]);
            s->force[p] = 1;
            return false;
        }
        const double step = fmin(until, whole);
        if (moves)
            for (size_t k = 0; k < DIMENSIONS; k++) s->x[k] += step * z[k];
        for (size_t j = 0; j < s->n; j++) s->force[s->row[j]] = fmax(0, s->force[s->row[j]] - step * y[j]);
        s->force[p] += step;
        if (step == whole) {
            s->row[s->n++] = p;
            factor(s);
            return true;
        }
        drop(s, first);
    }
}

/* Returns D(scale * force) minus a bound of its rounding error. */
static double dual_value(const optimum_problem *m, const optimum_row *row, size_t n, const double *force, double scale)
{
    double sum = 0, all = 0, g[OPTIMUM_BODIES + 1][2] = {{0}}, size[OPTIMUM_BODIES + 1][2] = {{0}};
    for (size_t c = 0; c < n; c++) {
        const double l = scale * force[c];
        sum += l * row[c].h;
        all += fabs(l * row[c].h);
        for (int k = 0; k < 2; k++) {
            g[row[c].a][k] -= l * row[c].n[k];
            g[row[c].b][k] += l * row[c].n[k];
            size[row[c].a][k] += fabs(l * row[c].n[k]);
            size[row[c].b][k] += fabs(l * row[c].n[k]);
        }
    }
    const double off = (double)(n + 16) * UNIT;
    for (size_t i = 0; i < m->bodies; i++) {
        if (stands(m, i)) continue;
        for (int k = 0; k < 2; k++) {
            const double most = fabs(g[i][k]) + off * size[i][k];
            sum -= most * most / (4 * m->body[i].weight);
            all += most * most / (4 * m->body[i].weight);
        }
    }
    return sum - off * all;
}

static double certificate(const optimum_problem *m, const optimum_row *row, size_t n, const double *force,
                          double enough)
{
    double best = 0;
    const double once = dual_value(m, row, n, force, 1);
    if (!(once > -INFINITY)) return best;
    for (int e = -20; e <= 60; e++) best = fmax(best, dual_value(m, row, n, force, ldexp(1 + enough, e)));
    return best;
}

/* The row for moves that count from the preferred ones; h is rounded down. */
static optimum_row from_preferred(const optimum_problem *m, const optimum_row *row)
{
    optimum_row out = *row;
    double size = fabs(row->h);
    for (size_t k = 0; k < 2; k++)
        for (int end = 0; end < 2; end++) {
            const size_t body = end ? row->b : row->a;
            const double part = body == OPTIMUM_NOBODY ? 0 : row->n[k] * m->preferred[2 * body + k];
            out.h -= end ? part : -part;
            size += fabs(part);
        }
    out.h -= 16 * UNIT * size;
    return out;
}

optimum_verdict optimum_solve(const optimum_problem *m, const optimum_row *given, size_t n, double enough,
                              optimum_solution *s)
{
    active_set a = {.n = 0};
    optimum_row row[OPTIMUM_ROWS];
    for (size_t c = 0; c < n; c++) row[c] = prefers(m) ? from_preferred(m, &given[c]) : given[c];
    set_normals(&a, m, row, n);
    *s = (optimum_solution){.cost = 0};
    for (size_t step = 0; step < 2000; step++) {
        size_t worst = n;
        double most = 1e-11;
        for (size_t c = 0; c < n; c++) {
            const double missing = row[c].h - dot(a.normal[c], a.x);
            const double size = a.size[c] > 0 ? a.size[c] : 1;
            if (missing / size > most) most = missing / size, worst = c;
        }
        if (worst == n) {
            for (size_t i = 0; i < m->bodies; i++)
                for (size_t k = 0; k < 2; k++)
                    s->t[2 * i + k] =
                        stands(m, i) ? 0 : a.x[2 * i + k] / sqrt(m->body[i].weight) + m->preferred[2 * i + k];
            s->cost = dot(a.x, a.x);
            s->bound = fmax(0, dual_value(m, row, n, a.force, 2));
            return OPTIMUM_SOLVED;
        }
        if (!enforce(&a, worst, row[worst].h)) {
            s->bound = certificate(m, row, n, a.force, enough);
            return s->bound >= enough ? OPTIMUM_INFEASIBLE : OPTIMUM_STUCK;
        }
    }
    return OPTIMUM_STUCK;
}
