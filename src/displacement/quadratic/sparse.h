/* A symmetric positive definite matrix of 2 x 2 blocks with few entries, and its Cholesky factor. */
#ifndef SUNDER_I_SPARSE_H
#define SUNDER_I_SPARSE_H

#include "base/list.h"

typedef struct sunder_i_sparse {
    size_t n;               /* rows and columns of blocks */
    uint32_t *rank;         /* [n] when each is eliminated */
    size_t *column;         /* [n + 1] by rank: where the entries below the diagonal start */
    uint32_t *row;          /* ranks, ascending in each column; fill-in included */
    double *diagonal;       /* [4 * n] by rank, each column by column */
    double *block;          /* [4 * column[n]] the same */
    uint32_t *panel;        /* [n] by rank: the first of consecutive columns that have the same rows below them */
    uint32_t *first, *link; /* [n] of the factorisation: panels by the row that they come to next */
    size_t *at;             /* [2 * n] */
    double *across;         /* [8 * n] what a panel has in the row at hand, each number twice */
    double *y;              /* [2 * n] */
    uint64_t work;          /* products of blocks in one factorisation */
} sunder_i_sparse;

/* The structure: entries (a, b) and (b, a) for each pair of different numbers below n, and the diagonal. place: NULL,
 * or [2 n] where in the plane each row's body stands, which may be of use for the order. False if memory is out; free
 * it all the same. */
bool sunder_i_sparse_init(sunder_i_sparse *matrix, size_t n, const sunder_i_id_pair *pair, size_t pairs,
                          const double *place);
void sunder_i_sparse_free(sunder_i_sparse *matrix);
void sunder_i_sparse_clear(sunder_i_sparse *matrix);
/* The block of entry (a, b), a != b, which is one of the pairs, row by row; *transposed: it holds that of (b, a). */
double *sunder_i_sparse_block(sunder_i_sparse *matrix, uint32_t a, uint32_t b, bool *transposed);
double *sunder_i_sparse_diagonal(sunder_i_sparse *matrix, uint32_t a);
/* In place. False if the matrix is not positive definite, as far as doubles can tell. */
bool sunder_i_sparse_factor(sunder_i_sparse *matrix);
/* x: two doubles a row; the right-hand side in, the solution out. */
void sunder_i_sparse_solve(sunder_i_sparse *matrix, double *x);

#endif
