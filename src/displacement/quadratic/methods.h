/* The methods that quadratic.c takes one after the other, and what they share. */
#ifndef SUNDER_I_METHODS_H
#define SUNDER_I_METHODS_H

#include "displacement/quadratic/quadratic.h"
#include <stdbool.h>

/* Is it time to stop, solved or not? */
static inline bool sunder_i_quadratic_is_done(const sunder_i_quadratic *p)
{
    return p->most_work && p->work >= p->most_work;
}

static inline double sunder_i_mass(const sunder_i_quadratic *p, uint32_t i)
{
    return i == SUNDER_I_GROUND ? 0 : p->mass[i];
}

/* Adds to t what a force on the constraint moves. */
static inline void sunder_i_push(const sunder_i_quadratic *p, const sunder_i_constraint *c, double force, double *t)
{
    if (c->j != SUNDER_I_GROUND) {
        t[2 * c->j] += p->mass[c->j] * force * c->n[0];
        t[2 * c->j + 1] += p->mass[c->j] * force * c->n[1];
    }
    if (c->i != SUNDER_I_GROUND) {
        t[2 * c->i] -= p->mass[c->i] * force * c->n[0];
        t[2 * c->i + 1] -= p->mass[c->i] * force * c->n[1];
    }
}

/* ---- quadratic.c ------------------------------------------------------------------------------------------------- */

/* t from the forces; what is missed at worst, softness allowed for; a pass of Hildreth's method. */
void sunder_i_quadratic_place(sunder_i_quadratic *program);
double sunder_i_quadratic_worst(const sunder_i_quadratic *program, double softness);
void sunder_i_quadratic_sweep(sunder_i_quadratic *program, double softness);

/* Do the forces prove that every solution costs more than program->most_cost? Not of soft programs, nor where
 * memory is out. */
bool sunder_i_quadratic_is_beyond(const sunder_i_quadratic *program, double softness);

/* ---- conjugate_gradients.c --------------------------------------------------------------------------------------- */

/* Conjugate gradients on the forces, which stay non-negative; at most `steps`, until no constraint is missed, nor one
 * that acts kept, by more than tolerance. False if memory is out. The forces are changed, t is not. */
bool sunder_i_quadratic_gradient(sunder_i_quadratic *program, double softness, double tolerance, unsigned steps);

/* ---- active_set.c ------------------------------------------------------------------------------------------------ */

/* The acting constraints as linear equations, their set corrected. False if memory is out. The forces are changed, t is
 * not. */
bool sunder_i_quadratic_equations(sunder_i_quadratic *program, double softness, double tolerance);

/* ---- newton.c ---------------------------------------------------------------------------------------------------- */

/* By Newton steps on the moves, from the forces: *solved, with t and the forces, which keep, or all but keep, all that
 * is demanded, or prove that all solutions cost too much; else the forces are what they were. False if memory is
 * out. */
bool sunder_i_quadratic_newton(sunder_i_quadratic *program, double softness, double tolerance, bool *solved);

/* ---- interior_point.c -------------------------------------------------------------------------------------------- */

/* By an interior point method, from p->t; sets t and the forces. scale: a length such as things move by. False if
 * memory is out. */
bool sunder_i_quadratic_interior(sunder_i_quadratic *program, double softness, double tolerance, double scale);

#endif
