/* min sum w_i |t_i|^2 under constraints n.(t_j - t_i) >= d: four methods, one after the other.
 *
 * The dual has one multiplier (a force) a constraint, and t follows from the forces: 2 w_i t_i = sum of the forces on
 * i. Hildreth's method [Hil57] takes one constraint after another and gives its force the value that makes it hold with
 * equality, or zero. It is quick to find which constraints act, slow to find how strongly where contacts form long
 * chains. There conjugate gradients that keep the forces non-negative (conjugate_gradients.c) are far quicker, and when
 * the acting set is known, or nearly, linear equations (active_set.c) give the rest of the digits. What resists, and
 * what is large, goes to an interior point method (interior_point.c).
 *
 * With softness s each constraint may be missed by s * (mass_i + mass_j) * force, which adds that to the diagonal of
 * the dual: contradictions then have a compromise. */
#include "displacement/programs/methods.h"
#include "displacement/programs/tuning.h"

#include "base/invariant.h"

#include <math.h>
#include <string.h>

void sunder_i_quadratic_place(sunder_i_quadratic *p)
{
    memset(p->t, 0, 2 * p->bodies * sizeof *p->t);
    for (size_t k = 0; k < p->n; k++)
        if (p->constraint[k].force > 0) sunder_i_push(p, &p->constraint[k], p->constraint[k].force, p->t);
}

/* One pass over all constraints, or over those that act. Returns the farthest any force moved something. */
double sunder_i_quadratic_sweep(sunder_i_quadratic *p, double softness, bool acting_only)
{
    double farthest = 0;
    p->work += acting_only ? p->n / 4 : p->n;
    for (size_t k = 0; k < p->n; k++) {
        sunder_i_constraint *c = &p->constraint[k];
        if (acting_only && !(c->force > 0)) continue;
        const double m = sunder_i_mass(p, c->i) + sunder_i_mass(p, c->j);
        if (!(m > 0)) continue;
        double change = (c->d - sunder_i_stretch(c, p->t) - softness * m * c->force) / (m * (1 + softness));
        if (change < -c->force) change = -c->force;
        if (change == 0) continue;
        c->force += change;
        sunder_i_push(p, c, change, p->t);
        farthest = fmax(farthest, fabs(change) * m);
    }
    return farthest;
}

double sunder_i_quadratic_worst(const sunder_i_quadratic *p, double softness)
{
    double v = 0;
    for (size_t k = 0; k < p->n; k++) {
        const sunder_i_constraint *c = &p->constraint[k];
        const double m = sunder_i_mass(p, c->i) + sunder_i_mass(p, c->j);
        const double missed = c->d - sunder_i_stretch(c, p->t) - softness * m * c->force;
        if (missed != missed) return INFINITY; /* without a solution forces can outgrow all numbers */
        v = fmax(v, missed);
    }
    return v;
}

/* First the quick ways, which solve almost every program of a few dozen contacts to the last digit. */
static bool solve_quickly(sunder_i_quadratic *p, double softness, double tolerance)
{
    sunder_i_quadratic_place(p);
    for (int k = 0; k < SWEEPS; k++) {
        const bool full = k % FULL_SWEEP == 0;
        const double moved = sunder_i_quadratic_sweep(p, softness, !full);
        if (full && moved <= tolerance) break;
    }
    if (!sunder_i_quadratic_gradient(p, softness, tolerance, QUICK_STEPS)) return false;
    sunder_i_quadratic_place(p);
    if (sunder_i_quadratic_worst(p, softness) <= tolerance) return true;
    if (!sunder_i_quadratic_equations(p, softness, tolerance)) return false;
    sunder_i_quadratic_place(p);
    return true;
}

#ifndef NDEBUG
/* Ends are bodies or the ground, forces push, positions are numbers. */
static const char *check(const sunder_i_quadratic *p)
{
    for (size_t k = 0; k < p->n; k++) {
        const sunder_i_constraint *c = &p->constraint[k];
        if ((c->i != SUNDER_I_GROUND && c->i >= p->bodies) || (c->j != SUNDER_I_GROUND && c->j >= p->bodies))
            return "a constraint of no body";
        if (!(c->force >= 0) || !isfinite(c->force)) return "a force that pulls";
    }
    for (size_t k = 0; k < 2 * p->bodies; k++)
        if (!isfinite(p->t[k])) return "a position that is no number";
    return NULL;
}
#endif

/* What is missed; where forces have outgrown all numbers nothing is moved, and everything is missed. */
static double finish(sunder_i_quadratic *p)
{
    const double missed = sunder_i_quadratic_worst(p, 0);
    if (missed == INFINITY) {
        for (size_t k = 0; k < p->n; k++) p->constraint[k].force = 0;
        sunder_i_quadratic_place(p);
    }
    SUNDER_I_CHECK(check(p), p->n);
    return fmax(0, missed);
}

double sunder_i_quadratic_solve(sunder_i_quadratic *p, double softness, double tolerance, double scale)
{
    if (p->n <= MOST_QUICK) {
        if (!solve_quickly(p, softness, tolerance)) return -1;
        if (sunder_i_quadratic_worst(p, softness) <= tolerance) return finish(p);
    }
    sunder_i_quadratic_place(p);
    if (sunder_i_quadratic_is_done(p)) return finish(p);
    if (!sunder_i_quadratic_interior(p, softness, tolerance, scale)) return -1;
    return finish(p);
}
