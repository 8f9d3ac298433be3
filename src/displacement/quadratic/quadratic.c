/* Minimises sum w_i |t_i|^2 under constraints n.(t_j - t_i) >= d, by up to five methods in sequence.
 *
 * The dual has one multiplier (a force) for each constraint, and t follows from the forces: 2 w_i t_i = sum of the
 * forces on i. Hildreth's method [Hil57] visits one constraint after another and sets its force to the value for which
 * it holds with equality, or to zero. It finds quickly which constraints are active, but converges slowly if contacts
 * form long chains. There conjugate gradients with non-negative forces (conjugate_gradients.c) are far quicker. Once
 * the active set is known, or nearly, linear equations (active_set.c) give the remaining digits. Programs of more than
 * a few dozen constraints try Newton's method on the moves (newton.c) first, which takes a fraction of the time if
 * constraints contradict each other. Programs that these methods do not solve, and large ones, go to an interior point
 * method (interior_point.c).
 *
 * With softness s each constraint may be violated by s * (mass_i + mass_j) * force. This adds to the diagonal of the
 * dual, so contradicting constraints have a compromise. */
#include "displacement/quadratic/links.h"
#include "displacement/quadratic/tuning.h"

#include "base/extremes.h"
#include "base/invariant.h"
#include "base/memory.h"
#include "base/stage_switch.h"

#include <math.h>
#include <string.h>

/* ---- Sweeps ------------------------------------------------------------------------------------------------------ */

/* Sweeps of Hildreth's method in sequence, over links. */
typedef struct sweeping {
    const sunder_i_quadratic *p;
    double softness;
    sunder_i_link *link; /* [n] */
    double *t;           /* [2 * (bodies + 1)] */
    uint32_t *acting;    /* [n] the constraints that were active after the last full sweep; others become active only in
                          * the next full sweep */
    size_t acting_n;
} sweeping;

/* Sets the force of constraint k to the value for which it holds with equality, or to zero. Returns the distance by
 * which this moved its ends; 0 if the force did not change. */
static inline double relax_constraint(const sweeping *s, uint32_t k)
{
    const sunder_i_link *link = &s->link[k];
    sunder_i_constraint *c = &s->p->constraint[k];
    const double m = link->mass[0] + link->mass[1];
    if (!(m > 0)) return 0;
    double change = (c->d - sunder_i_link_stretch(link, s->t) - (s->softness * m + c->give) * c->force) /
                    (m * (1 + s->softness) + c->give);
    if (change < -c->force) change = -c->force;
    if (change == 0) return 0;
    c->force += change;
    sunder_i_link_push(link, change, s->t);
    s->t[2 * s->p->bodies] = s->t[2 * s->p->bodies + 1] = 0; /* the ground */
    return fabs(change) * m;
}

static double sweep_all(sweeping *s)
{
    double farthest = 0;
    s->acting_n = 0;
    for (uint32_t k = 0; k < s->p->n; k++) {
        const double moved = relax_constraint(s, k);
        if (moved > farthest) farthest = moved;
        if (s->p->constraint[k].force > 0) s->acting[s->acting_n++] = k;
    }
    return farthest;
}

static void sweep_acting(sweeping *s)
{
    for (size_t a = 0; a < s->acting_n; a++)
        if (s->p->constraint[s->acting[a]].force > 0) relax_constraint(s, s->acting[a]);
}

/* Sweeps over the active constraints, with a sweep over all constraints every FULL_SWEEP-th time, until that moves
 * nothing by more than `tolerance`. Returns false if memory is out. */
static bool sweep_constraints(sunder_i_quadratic *p, double softness, double tolerance)
{
    const size_t places = 2 * (p->bodies + 1);
    const size_t need = p->n * (sizeof(sunder_i_link) + sizeof(uint32_t)) + places * sizeof(double);
    _Alignas(double) char few[ON_THE_STACK];
    char *memory = need <= sizeof few ? few : sunder_i_alloc(need, 1);
    if (!memory) return false;
    sweeping s = {.p = p, .softness = softness, .link = (sunder_i_link *)(void *)memory};
    s.t = (double *)(void *)(s.link + p->n);
    s.acting = (uint32_t *)(void *)(s.t + places);
    sunder_i_links_make(p, s.link);
    memset(s.t, 0, places * sizeof *s.t);
    for (size_t k = 0; k < p->n; k++)
        if (p->constraint[k].force > 0) sunder_i_link_push(&s.link[k], p->constraint[k].force, s.t);
    s.t[places - 2] = s.t[places - 1] = 0;
    for (int k = 0; k < SWEEPS; k++) {
        const bool full = k % FULL_SWEEP == 0;
        p->work += full ? p->n : p->n / 4;
        if (!full)
            sweep_acting(&s);
        else if (sweep_all(&s) <= tolerance)
            break;
    }
    if (need > sizeof few) sunder_i_free(memory);
    return true;
}

/* ---- The sequence of methods ------------------------------------------------------------------------------------- */

/* Does the program use this method? Only the ablation harness leaves one out. */
static bool uses_method(const char *method) { return sunder_i_stage_is_on("program", method); }

/* Tries the quick methods, which solve almost every program of a few dozen contacts to the last digit. Returns false if
 * memory is out. */
static bool solve_quickly(sunder_i_quadratic *p, double softness, double tolerance)
{
    if (uses_method("sweeps") && !sweep_constraints(p, softness, tolerance)) return false;
    if (uses_method("conjugate gradients") && !sunder_i_quadratic_gradient(p, softness, tolerance, QUICK_STEPS))
        return false;
    sunder_i_quadratic_place(p);
    if (sunder_i_quadratic_worst(p, softness) <= tolerance || sunder_i_quadratic_is_beyond(p, softness)) return true;
    if (uses_method("active set") && !sunder_i_quadratic_equations(p, softness, tolerance)) return false;
    sunder_i_quadratic_place(p);
    return true;
}

#ifndef NDEBUG
/* Checks that ends are bodies or the ground, that no force is negative, and that positions are finite. */
static const char *check_program(const sunder_i_quadratic *p)
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

/* Returns the largest violation. If forces have overflowed, it resets forces and moves to zero and returns INFINITY. */
static double finish_program(sunder_i_quadratic *p)
{
    const double missed = sunder_i_quadratic_worst(p, 0);
    if (missed == INFINITY) {
        for (size_t k = 0; k < p->n; k++) p->constraint[k].force = 0;
        sunder_i_quadratic_place(p);
    }
    SUNDER_I_CHECK(check_program(p), p->n);
    return sunder_i_max(0, missed);
}

static double give_up(sunder_i_quadratic *p)
{
    finish_program(p);
    return INFINITY;
}

double sunder_i_quadratic_solve_once(sunder_i_quadratic *program, double softness, double tolerance, double scale)
{
    bool solved = false;
    if (uses_method("newton") && program->most_cost > 0 && program->n > FEWEST_NEWTON && program->n <= MOST_QUICK &&
        program->bodies <= MOST_BODIES_NEWTON && !sunder_i_quadratic_newton(program, softness, tolerance, &solved))
        return -1;
    if (!solved && program->n <= MOST_QUICK && !solve_quickly(program, softness, tolerance)) return -1;
    if (program->n <= MOST_QUICK && sunder_i_quadratic_worst(program, softness) <= tolerance)
        return finish_program(program);
    if (solved) return sunder_i_quadratic_is_beyond(program, softness) ? give_up(program) : finish_program(program);
    sunder_i_quadratic_place(program);
    if (sunder_i_quadratic_is_done(program)) return finish_program(program);
    if (sunder_i_quadratic_is_beyond(program, softness)) return give_up(program);
    if (uses_method("interior point") && !sunder_i_quadratic_interior(program, softness, tolerance, scale)) return -1;
    return sunder_i_quadratic_is_beyond(program, softness) ? give_up(program) : finish_program(program);
}
