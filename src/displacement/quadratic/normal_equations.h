/* The matrix of both Newton methods, H + A' diag(v) A: what bodies weigh, and what constraints between two of them add.
 * It couples bodies in contact only, and is factored sparsely (sparse.c). */
#ifndef SUNDER_I_NORMAL_EQUATIONS_H
#define SUNDER_I_NORMAL_EQUATIONS_H

#include "displacement/quadratic/quadratic.h"
#include "displacement/quadratic/sparse.h"

/* One constraint. Its places are the first of a body's two unknowns; the ground's place comes after all unknowns, so no
 * code has to test which end is the ground. */
typedef struct sunder_i_normal_row {
    uint32_t i, j;
    double n[2];
    double *on_i, *on_j, *across; /* the blocks of the matrix that it adds to; where the ground has none, a spare one */
} sunder_i_normal_row;

typedef struct sunder_i_normal {
    size_t n, m;              /* unknowns, constraints */
    uint32_t *unknown;        /* [bodies] the first of its two, or n for what does not move */
    double *h;                /* [n] the diagonal of H, and the spare block */
    sunder_i_normal_row *row; /* [m] */
    sunder_i_sparse matrix;
} sunder_i_normal;

/* False if memory is out; the caller frees it in any case. */
bool sunder_i_normal_init(sunder_i_normal *q, const sunder_i_quadratic *program);
void sunder_i_normal_free(sunder_i_normal *q);
/* H alone, and v times what constraint c adds. */
void sunder_i_normal_clear(sunder_i_normal *q);
void sunder_i_normal_add(sunder_i_normal *q, size_t c, double v);

/* (A x) of a constraint; x: [n + 2], zero at the ground. */
static inline double sunder_i_normal_stretch(const sunder_i_normal_row *c, const double *x)
{
    return (c->n[0] * x[c->j] + c->n[1] * x[c->j + 1]) - (c->n[0] * x[c->i] + c->n[1] * x[c->i + 1]);
}

/* x += A' v for one constraint. What it does to the ground is to be undone. */
static inline void sunder_i_normal_spread(const sunder_i_normal_row *c, double v, double *x)
{
    x[c->j] += v * c->n[0];
    x[c->j + 1] += v * c->n[1];
    x[c->i] -= v * c->n[0];
    x[c->i + 1] -= v * c->n[1];
}

#endif
