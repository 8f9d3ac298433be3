/* Quadratic programs: least weighted sums of squared moves under linear constraints between pairs of bodies; see
 * quadratic.c. */
#ifndef SUNDER_I_QUADRATIC_H
#define SUNDER_I_QUADRATIC_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The body number of the ground, which does not move. */
#define SUNDER_I_GROUND UINT32_MAX

/* The constraint n.(t_j - t_i) >= d. i or j may be SUNDER_I_GROUND, whose move is zero. With give > 0 it may be
 * violated by v at the cost v^2 / (2 give), and is then violated by give times its force: two such constraints, with
 * opposite normals and distances, are a spring. With price > 0 the violation costs price v besides, and there is none
 * as long as the force is at most the price (priced.c). */
typedef struct sunder_i_constraint {
    uint32_t i, j;
    double n[2], d;
    double force; /* its Lagrange multiplier */
    double give;  /* >= 0 */
    double price; /* >= 0; above 0 only if give > 0 */
    uint64_t key; /* identifies the constraint, so that it is found again in the next round */
} sunder_i_constraint;

typedef struct sunder_i_quadratic {
    size_t bodies;
    const double *mass;      /* [bodies] inverse weights: 1 / (2 w); 0 for a fixed body */
    const double *preferred; /* [2 * bodies] the moves that cost nothing, 0 for a fixed body; NULL: all are 0 */
    sunder_i_constraint *constraint;
    size_t n, capacity;
    double *t;           /* [2 * bodies] out: the moves */
    const double *place; /* [2 * bodies] positions in the plane, used to order the elimination; NULL: not known */
    bool priced;         /* it has had constraints with a price, so that opposite forces may have to cancel out
                          * (conjugate_gradients.c) */
    uint64_t work;       /* the work done, approximately in constraints processed */
    uint64_t most_work;  /* 0, or a limit of `work`, at which the method stops with the best result so far */
    double most_cost;    /* 0, or the greatest cost of a useful solution: once it is proved that every solution costs
                          * more, the search stops */
} sunder_i_quadratic;

/* Returns n.(t_j - t_i). */
static inline double sunder_i_stretch(const sunder_i_constraint *c, const double *t)
{
    double v = 0;
    if (c->j != SUNDER_I_GROUND) v += c->n[0] * t[2 * c->j] + c->n[1] * t[2 * c->j + 1];
    if (c->i != SUNDER_I_GROUND) v -= c->n[0] * t[2 * c->i] + c->n[1] * t[2 * c->i + 1];
    return v;
}

/* Minimises sum w |t - a|^2, with the preferred moves a, plus the cost of the violations of constraints that give,
 * under the constraints, starting from their forces. softness > 0 lets every constraint be violated in proportion to
 * its force (relative to what the force moves), so that contradictions end in a compromise. Returns the largest
 * violation beyond what constraints give, INFINITY if it is only known that every solution costs too much, and a
 * negative number if memory is out. scale: a typical length of moves. */
double sunder_i_quadratic_solve(sunder_i_quadratic *program, double softness, double tolerance, double scale);

/* Solves a large program again that was solved and has got a few more constraints: only bodies around the constraints
 * that t violates move, the others stay (mend.c). Returns the largest violation. Returns INFINITY, with t and forces
 * unchanged, if this fails or increases the cost by a larger share than `more`; and a negative number if memory is
 * out. */
double sunder_i_quadratic_mend(sunder_i_quadratic *program, double tolerance, double scale, double more);

#endif
