/* Least weighted squares of moves under linear constraints between pairs of bodies; see quadratic.c. */
#ifndef SUNDER_I_QUADRATIC_H
#define SUNDER_I_QUADRATIC_H

#include <stddef.h>
#include <stdint.h>

/* What does not move. */
#define SUNDER_I_GROUND UINT32_MAX

/* n.(t_j - t_i) >= d; i or j may be SUNDER_I_GROUND, which stands at zero. */
typedef struct sunder_i_constraint {
    uint32_t i, j;
    double n[2], d;
    double force; /* its multiplier */
    uint64_t key; /* what it stands for, to find it again in the next round */
} sunder_i_constraint;

typedef struct sunder_i_quadratic {
    size_t bodies;
    const double *mass; /* [bodies] inverse: 1 / (2 w); 0 for what is fixed */
    sunder_i_constraint *constraint;
    size_t n, capacity;
    double *t;           /* [2 * bodies] out */
    const double *place; /* [2 * bodies] positions in the plane, which tell neighbours; NULL: not known */
    uint64_t work;       /* work so far, approximately in constraints looked at */
    uint64_t most_work;  /* 0, or how much may be: then what is done by then is the solution, such as it is */
    double most_cost;    /* 0, or what no solution that is of use costs more than: where none costs as little, none is
                           looked for any longer */
} sunder_i_quadratic;

/* n.(t_j - t_i) */
static inline double sunder_i_stretch(const sunder_i_constraint *c, const double *t)
{
    double v = 0;
    if (c->j != SUNDER_I_GROUND) v += c->n[0] * t[2 * c->j] + c->n[1] * t[2 * c->j + 1];
    if (c->i != SUNDER_I_GROUND) v -= c->n[0] * t[2 * c->i] + c->n[1] * t[2 * c->i + 1];
    return v;
}

/* min sum w |t|^2 under the constraints, starting from their forces. softness > 0 lets every constraint yield in
 * proportion to its force (relative to what the force moves), so that contradictions end in a compromise. Returns the
 * worst violation, INFINITY where all that is known is that any solution costs too much; negative if memory is out.
 * scale: a length such as bodies move by. */
double sunder_i_quadratic_solve(sunder_i_quadratic *program, double softness, double tolerance, double scale);

/* The same of a large program that was solved, and has a few more constraints since: about those that t misses only,
 * while what is farther off stays (mend.c). Returns the worst violation; INFINITY if it does not do, or costs more than
 * before by a larger share than `more`, with t and forces as they were; negative if memory is out. */
double sunder_i_quadratic_mend(sunder_i_quadratic *program, double tolerance, double scale, double more);

#endif
