/* min sum w_i |t_i|^2 under constraints n.(t_j - t_i) >= d: dual coordinate ascent, then an active set.
 *
 * The dual has one multiplier (a force) a constraint, and t follows from the forces: 2 w_i t_i = sum of the forces on i. Hildreth's method
 * [Hildreth, "A quadratic programming procedure", NRLQ 4, 1957] takes one constraint after another and gives its force the value that makes it
 * hold with equality, or zero. It is quick to find which constraints act, slow to find how strongly where contacts form chains. So the
 * acting set is then solved as linear equations, G f = d with G the Gram matrix of the constraints, and corrected as by
 * Lawson and Hanson (Solving Least Squares Problems, 1974, chapter 23): forces that turn negative are dropped, violated constraints
 * added.
 *
 * With softness s each constraint may be missed by s * (mass_i + mass_j) * force, which adds that to the diagonal of G: contradictions
 * then have a compromise. */
#include "displacement/displacement.h"

#include <math.h>
#include <string.h>

/* Up to this many acting constraints are solved as dense equations: cubic, some milliseconds. */
#define MOST_ACTIVE 220

static double mass_of(const sunder_i_quadratic *p, uint32_t i) { return i == SUNDER_I_NOBODY ? 0 : p->mass[i]; }

/* What t misses of the constraint; negative where it has room. */
static double missing(const sunder_i_quadratic *p, const sunder_i_constraint *c)
{
    double v = c->d;
    if (c->j != SUNDER_I_NOBODY) v -= c->n[0] * p->t[2 * c->j] + c->n[1] * p->t[2 * c->j + 1];
    if (c->i != SUNDER_I_NOBODY) v += c->n[0] * p->t[2 * c->i] + c->n[1] * p->t[2 * c->i + 1];
    return v;
}

static void push(sunder_i_quadratic *p, const sunder_i_constraint *c, double force)
{
    if (c->j != SUNDER_I_NOBODY) {
        p->t[2 * c->j] += p->mass[c->j] * force * c->n[0];
        p->t[2 * c->j + 1] += p->mass[c->j] * force * c->n[1];
    }
    if (c->i != SUNDER_I_NOBODY) {
        p->t[2 * c->i] -= p->mass[c->i] * force * c->n[0];
        p->t[2 * c->i + 1] -= p->mass[c->i] * force * c->n[1];
    }
}

static void place(sunder_i_quadratic *p)
{
    memset(p->t, 0, 2 * p->bodies * sizeof *p->t);
    for (size_t k = 0; k < p->n; k++)
        if (p->constraint[k].force > 0) push(p, &p->constraint[k], p->constraint[k].force);
}

/* One pass over all constraints, or over those that act. Returns the farthest any force moved something. */
static double sweep(sunder_i_quadratic *p, double softness, bool acting_only)
{
    double farthest = 0;
    for (size_t k = 0; k < p->n; k++) {
        sunder_i_constraint *c = &p->constraint[k];
        if (acting_only && !(c->force > 0)) continue;
        const double m = mass_of(p, c->i) + mass_of(p, c->j);
        if (!(m > 0)) continue;
        double change = (missing(p, c) - softness * m * c->force) / (m * (1 + softness));
        if (change < -c->force) change = -c->force;
        if (change == 0) continue;
        c->force += change;
        push(p, c, change);
        farthest = fmax(farthest, fabs(change) * m);
    }
    return farthest;
}

static double worst(const sunder_i_quadratic *p, double softness)
{
    double v = 0;
    for (size_t k = 0; k < p->n; k++) {
        const sunder_i_constraint *c = &p->constraint[k];
        const double m = mass_of(p, c->i) + mass_of(p, c->j);
        v = fmax(v, missing(p, c) - softness * m * c->force);
    }
    return v;
}

/* ---- The acting set as equations ------------------------------------------------------------------------------- */

typedef struct equations {
    uint32_t *set;          /* [capacity] acting constraints */
    double *gram, *force;   /* lower triangle of the factor; the solution */
    size_t n, capacity;
} equations;

/* Entry (a, b) of the Gram matrix. */
static double gram(const sunder_i_quadratic *p, const sunder_i_constraint *a, const sunder_i_constraint *b)
{
    const double dot = a->n[0] * b->n[0] + a->n[1] * b->n[1];
    double m = 0;
    if (a->i != SUNDER_I_NOBODY) m += a->i == b->i ? p->mass[a->i] : a->i == b->j ? -p->mass[a->i] : 0;
    if (a->j != SUNDER_I_NOBODY) m += a->j == b->j ? p->mass[a->j] : a->j == b->i ? -p->mass[a->j] : 0;
    return dot * m;
}

/* Cholesky factor, a row at a time, skipping the leading zeros of each row, and the solution of G f = d. The diagonal is raised by 1e-11
 * of itself: constraints that say the same twice are common (a long wall cut into pieces) and any split of their force will do. */
static bool solve_equations(const sunder_i_quadratic *p, equations *e, double softness)
{
    for (size_t r = 0; r < e->n; r++) {
        double *row = e->gram + r * e->capacity;
        const sunder_i_constraint *c = &p->constraint[e->set[r]];
        double f = c->d;
        for (size_t k = 0; k <= r; k++) {
            const double *other = e->gram + k * e->capacity;
            double g = gram(p, c, &p->constraint[e->set[k]]);
            if (k == r) g *= 1 + softness + 1e-11;
            for (size_t i = 0; i < k; i++) g -= row[i] * other[i];
            if (k < r) {
                row[k] = g / other[k];
                f -= row[k] * e->force[k];
            } else {
                if (!(g > 0)) return false;
                row[r] = sqrt(g);
            }
        }
        e->force[r] = f / row[r];
    }
    for (size_t r = e->n; r-- > 0;) {
        double f = e->force[r];
        for (size_t k = r + 1; k < e->n; k++) f -= e->gram[k * e->capacity + r] * e->force[k];
        e->force[r] = f / e->gram[r * e->capacity + r];
    }
    return true;
}

static bool gather(const sunder_i_quadratic *p, equations *e)
{
    e->n = 0;
    for (size_t k = 0; k < p->n; k++)
        if (p->constraint[k].force > 0) {
            if (e->n == e->capacity) return false;
            e->set[e->n++] = (uint32_t)k;
        }
    return true;
}

/* Goes from the forces towards the solution of the equations until one reaches zero, drops that and solves again. */
static bool descend(sunder_i_quadratic *p, equations *e, double softness)
{
    while (e->n) {
        if (!solve_equations(p, e, softness)) return false;
        double step = 1;
        size_t first = SIZE_MAX;
        for (size_t k = 0; k < e->n; k++) {
            const double now = p->constraint[e->set[k]].force;
            if (e->force[k] <= 0 && now / (now - e->force[k]) <= step) {
                step = now / (now - e->force[k]);
                first = k;
            }
        }
        for (size_t k = 0; k < e->n; k++) {
            sunder_i_constraint *c = &p->constraint[e->set[k]];
            c->force += step * (e->force[k] - c->force);
            if (c->force < 0) c->force = 0;
        }
        if (first == SIZE_MAX) return true;
        p->constraint[e->set[first]].force = 0;
        memmove(e->set + first, e->set + first + 1, (e->n - first - 1) * sizeof *e->set);
        e->n--;
    }
    return true;
}

/* Exact forces where the acting set is small enough. False if memory is out. */
static bool polish(sunder_i_quadratic *p, double softness, double tolerance)
{
    size_t acting = 0;
    for (size_t k = 0; k < p->n; k++) acting += p->constraint[k].force > 0;
    if (acting > MOST_ACTIVE) return true;
    equations e = {.capacity = acting + 64};
    e.set = sunder_i_alloc(e.capacity, sizeof *e.set);
    e.force = sunder_i_alloc(e.capacity, sizeof *e.force);
    e.gram = sunder_i_calloc(e.capacity * e.capacity, sizeof *e.gram);
    const bool ok = e.set && e.force && e.gram;
    for (int round = 0; ok && round < 40; round++) {
        if (!gather(p, &e) || !descend(p, &e, softness)) break;
        place(p);
        if (worst(p, softness) <= tolerance) break;
        /* Those that the solution violates get a force of their own by a pass or two of the first method. */
        sweep(p, softness, false);
        sweep(p, softness, false);
    }
    sunder_i_free(e.set);
    sunder_i_free(e.force);
    sunder_i_free(e.gram);
    return ok;
}

double sunder_i_quadratic_solve(sunder_i_quadratic *p, double softness, double tolerance, unsigned sweeps)
{
    place(p);
    unsigned used = 0, goal = 60;
    for (;;) {
        while (used < goal) {
            const double moved = sweep(p, softness, used % 8 != 0);
            const bool full = used++ % 8 == 0;
            if (full && moved <= tolerance) break;
        }
        place(p);
        if (!polish(p, softness, tolerance)) return -1;
        place(p);
        const double v = worst(p, softness);
        if (v <= tolerance || used >= sweeps) return fmax(0, worst(p, 0));
        goal = used * 4 < sweeps ? used * 4 : sweeps;
    }
}
