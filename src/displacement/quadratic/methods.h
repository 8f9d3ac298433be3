/* The methods that quadratic.c tries one after the other, and functions that they share. */
#ifndef SUNDER_I_METHODS_H
#define SUNDER_I_METHODS_H

#include "displacement/quadratic/quadratic.h"
#include <stdbool.h>

/* Has the program used up its work? Then methods stop, solved or not. */
static inline bool sunder_i_quadratic_is_done(const sunder_i_quadratic *p)
{
    return p->most_work && p->work >= p->most_work;
}

/* The mass (inverse weight) of body i; 0 for the ground. */
static inline double sunder_i_mass(const sunder_i_quadratic *p, uint32_t i)
{
    return i == SUNDER_I_GROUND ? 0 : p->mass[i];
}

/* Adds to t the moves that a force on constraint c causes. */
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

/* ---- forces.c ---------------------------------------------------------------------------------------------------- */

/* sunder_i_quadratic_place() sets t to the moves that the forces cause. sunder_i_quadratic_worst() returns the largest
 * violation at t, less what softness allows. sunder_i_quadratic_sweep() makes one pass of Hildreth's method over all
 * constraints, which changes the forces and t. */
void sunder_i_quadratic_place(sunder_i_quadratic *program);
double sunder_i_quadratic_worst(const sunder_i_quadratic *program, double softness);
void sunder_i_quadratic_sweep(sunder_i_quadratic *program, double softness);

/* Do the forces prove that every solution costs more than program->most_cost? Returns false for soft programs, and if
 * memory is out. */
bool sunder_i_quadratic_is_beyond(const sunder_i_quadratic *program, double softness);

/* ---- quadratic.c ------------------------------------------------------------------------------------------------- */

/* As sunder_i_quadratic_solve() and sunder_i_quadratic_mend(), for a program without preferred moves. */
double sunder_i_quadratic_solve_priced(sunder_i_quadratic *program, double softness, double tolerance, double scale);
double sunder_i_quadratic_mend_part(sunder_i_quadratic *program, double tolerance, double scale, double more);
/* As sunder_i_quadratic_solve_priced(), for a program without prices. */
double sunder_i_quadratic_solve_once(sunder_i_quadratic *program, double softness, double tolerance, double scale);

/* ---- conjugate_gradients.c --------------------------------------------------------------------------------------- */

/* Conjugate gradients on the forces, which stay non-negative: at most `steps` steps, until no constraint is violated by
 * more than `tolerance`, and no active one is slack by more. Returns false if memory is out. Changes the forces, not
 * t. */
bool sunder_i_quadratic_gradient(sunder_i_quadratic *program, double softness, double tolerance, unsigned steps);

/* ---- active_set.c ------------------------------------------------------------------------------------------------ */

/* Solves for the forces of the active constraints by linear equations, and corrects the active set. Does nothing if too
 * many are active (MOST_ACTIVE). Returns false if memory is out. Changes the forces; t may be that of earlier forces
 * afterwards, so the caller has to place the bodies. */
bool sunder_i_quadratic_equations(sunder_i_quadratic *program, double softness, double tolerance);

/* ---- newton.c ---------------------------------------------------------------------------------------------------- */

/* Newton steps on the moves, starting from the forces. If *solved is set, t and the forces satisfy the constraints, or
 * nearly, or the forces prove that all solutions cost more than program->most_cost; otherwise the forces are unchanged.
 * Returns false if memory is out. */
bool sunder_i_quadratic_newton(sunder_i_quadratic *program, double softness, double tolerance, bool *solved);

/* ---- interior_point.c -------------------------------------------------------------------------------------------- */

/* An interior point method, starting from p->t; sets t and the forces. scale: a typical length of moves. Returns false
 * if memory is out. */
bool sunder_i_quadratic_interior(sunder_i_quadratic *program, double softness, double tolerance, double scale);

#endif
