/* What the forces of a program do: the moves that they make, what these miss, a pass of Hildreth's method [Hil57], and
 * the cost that they prove. */
#include "displacement/quadratic/methods.h"
#include "displacement/quadratic/tuning.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

void sunder_i_quadratic_place(sunder_i_quadratic *program)
{
    memset(program->t, 0, 2 * program->bodies * sizeof *program->t);
    for (size_t k = 0; k < program->n; k++)
        if (program->constraint[k].force > 0)
            sunder_i_push(program, &program->constraint[k], program->constraint[k].force, program->t);
}

void sunder_i_quadratic_sweep(sunder_i_quadratic *program, double softness)
{
    program->work += program->n;
    for (size_t k = 0; k < program->n; k++) {
        sunder_i_constraint *c = &program->constraint[k];
        const double m = sunder_i_mass(program, c->i) + sunder_i_mass(program, c->j);
        if (!(m > 0)) continue;
        double change = (c->d - sunder_i_stretch(c, program->t) - (softness * m + c->give) * c->force) /
                        (m * (1 + softness) + c->give);
        if (change < -c->force) change = -c->force;
        if (change == 0) continue;
        c->force += change;
        sunder_i_push(program, c, change, program->t);
    }
}

double sunder_i_quadratic_worst(const sunder_i_quadratic *program, double softness)
{
    double v = 0;
    for (size_t k = 0; k < program->n; k++) {
        const sunder_i_constraint *c = &program->constraint[k];
        const double m = sunder_i_mass(program, c->i) + sunder_i_mass(program, c->j);
        const double missed = c->d - sunder_i_stretch(c, program->t) - (softness * m + c->give) * c->force;
        if (missed != missed) return INFINITY; /* if the program has no solution, forces can overflow */
        if (missed > v) v = missed;
    }
    return v;
}

/* Weak duality: for any forces, no solution costs less than sum f d - sum w |t|^2 - sum give f^2 / 2, where t are the
 * moves that they cause. */
bool sunder_i_quadratic_is_beyond(const sunder_i_quadratic *program, double softness)
{
    if (softness > 0 || !(program->most_cost > 0)) return false;
    double *t = sunder_i_calloc(2 * program->bodies, sizeof *t), least = 0;
    if (!t) return false;
    for (size_t k = 0; k < program->n; k++) {
        const sunder_i_constraint *c = &program->constraint[k];
        if (!(c->force > 0)) continue;
        sunder_i_push(program, c, c->force, t);
        least += c->force * (c->d - c->give * c->force / 2);
    }
    for (size_t b = 0; b < program->bodies; b++)
        if (program->mass[b] > 0) least -= (t[2 * b] * t[2 * b] + t[2 * b + 1] * t[2 * b + 1]) / (2 * program->mass[b]);
    sunder_i_free(t);
    return least > program->most_cost * (1 + BEYOND);
}
