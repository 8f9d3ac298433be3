/* Programs whose bodies prefer other moves than 0: sum w |t - a|^2 is least. The methods minimise sum w |s|^2, so they
 * get the program in s = t - a: a constraint n.(t_j - t_i) >= d is n.(s_j - s_i) >= d - n.(a_j - a_i). */
#include "displacement/quadratic/methods.h"

#include "base/memory.h"

/* Expresses the program in s. Returns the distances of its constraints; NULL if memory is out. */
static double *begin_relative(sunder_i_quadratic *p)
{
    double *d = sunder_i_alloc(p->n, sizeof *d);
    for (size_t k = 0; d && k < p->n; k++) {
        d[k] = p->constraint[k].d;
        p->constraint[k].d -= sunder_i_stretch(&p->constraint[k], p->preferred);
    }
    for (size_t k = 0; d && k < 2 * p->bodies; k++) p->t[k] -= p->preferred[k];
    return d;
}

/* Expresses it in t again, with the distances that it had, which are freed. */
static void end_relative(sunder_i_quadratic *p, double *d)
{
    for (size_t k = 0; k < p->n; k++) p->constraint[k].d = d[k];
    for (size_t k = 0; k < 2 * p->bodies; k++) p->t[k] += p->preferred[k];
    sunder_i_free(d);
}

double sunder_i_quadratic_solve(sunder_i_quadratic *program, double softness, double tolerance, double scale)
{
    if (!program->preferred) return sunder_i_quadratic_solve_priced(program, softness, tolerance, scale);
    double *d = begin_relative(program);
    if (!d) return -1;
    const double missed = sunder_i_quadratic_solve_priced(program, softness, tolerance, scale);
    end_relative(program, d);
    return missed;
}

double sunder_i_quadratic_mend(sunder_i_quadratic *program, double tolerance, double scale, double more)
{
    if (!program->preferred) return sunder_i_quadratic_mend_part(program, tolerance, scale, more);
    double *d = begin_relative(program);
    if (!d) return -1;
    const double missed = sunder_i_quadratic_mend_part(program, tolerance, scale, more);
    end_relative(program, d);
    return missed;
}
