/* The matrix of both Newton methods, H + A' diag(v) A: H has the weights of the bodies, and each constraint adds blocks
 * for its two bodies. It couples only bodies in contact, and is factored sparsely (sparse.c). */
#ifndef SUNDER_I_NORMAL_EQUATIONS_H
#define SUNDER_I_NORMAL_EQUATIONS_H

#include "displacement/quadratic/quadratic.h"
#include "displacement/quadratic/sparse.h"

/* One constraint. i and j are the first of the two unknowns of its bodies. The ground's come after all unknowns, so no
 * code has to test which end is the ground. */
typedef struct sunder_i_normal_row {
    uint32_t i, j;
    double n[2];
    double *on_i, *on_j, *across; /* the blocks of the matrix that it adds to; a spare block instead of those of the
                                   * ground */
} sunder_i_normal_row;

typedef struct sunder_i_normal {
    size_t n, m;              /* the numbers of unknowns and of constraints */
    uint32_t *unknown;        /* [bodies] the first of the two unknowns of each, or n if the body does not move */
    double *h;                /* [n] the diagonal of H, followed by the spare block */
    sunder_i_normal_row *row; /* [m] */
    sunder_i_sparse matrix;
} sunder_i_normal;

/* Returns false if memory is out; the caller frees *q in any case. */
bool sunder_i_normal_init(sunder_i_normal *q, const sunder_i_quadratic *program);
void sunder_i_normal_free(sunder_i_normal *q);
/* sunder_i_normal_clear() sets the matrix to H. sunder_i_normal_add() adds v times the blocks of constraint c. */
void sunder_i_normal_clear(sunder_i_normal *q);
void sunder_i_normal_add(sunder_i_normal *q, size_t c, double v);

/* Returns (A x) for one constraint. x: [n + 2], zero for the ground. */
static inline double sunder_i_normal_stretch(const sunder_i_normal_row *c, const double *x)
{
    return (c->n[0] * x[c->j] + c->n[1] * x[c->j + 1]) - (c->n[0] * x[c->i] + c->n[1] * x[c->i + 1]);
}

/* Computes x += A' v for one constraint. It also changes the ground's entries; the caller has to undo that. */
static inline void sunder_i_normal_spread(const sunder_i_normal_row *c, double v, double *x)
{
    x[c->j] += v * c->n[0];
    x[c->j + 1] += v * c->n[1];
    x[c->i] -= v * c->n[0];
    x[c->i + 1] -= v * c->n[1];
}

#endif
