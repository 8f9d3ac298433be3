/* A symmetric positive definite matrix of 2 x 2 blocks with few entries, and its Cholesky factor. */
#ifndef SUNDER_I_SPARSE_H
#define SUNDER_I_SPARSE_H

#include "base/list.h"

typedef struct sunder_i_sparse {
    size_t n;               /* the number of rows and columns, in blocks */
    uint32_t *rank;         /* [n] the position of each in the order of elimination */
    size_t *column;         /* [n + 1] by rank: where the entries of each column below the diagonal start */
    uint32_t *row;          /* the ranks of the rows, ascending in each column; fill-in included */
    double *diagonal;       /* [4 * n] by rank: the diagonal blocks, each stored column by column */
    double *block;          /* [4 * column[n]] the blocks below the diagonal, stored in the same way */
    uint32_t *panel;        /* [n] by rank: the first of the consecutive columns that have the same rows below them */
    uint32_t *first, *link; /* [n] used by the factorisation: lists of panels by the row that each comes to next */
    size_t *at;             /* [2 * n] used by the factorisation: positions of entries */
    double *across;         /* [8 * n] used by the factorisation: the blocks of a panel in one row, each number twice */
    double *y;              /* [2 * n] used by sunder_i_sparse_solve() */
    uint64_t work;          /* the number of products of blocks in one factorisation */
} sunder_i_sparse;

/* Sets up the structure: the diagonal, and entries (a, b) and (b, a) for each pair of different numbers below n. place:
 * NULL, or [2 n] the position of each row's body in the plane, which helps to find a good order. Returns false if
 * memory is out; the caller frees *matrix in any case. */
bool sunder_i_sparse_init(sunder_i_sparse *matrix, size_t n, const sunder_i_id_pair *pair, size_t pairs,
                          const double *place);
void sunder_i_sparse_free(sunder_i_sparse *matrix);
/* Sets all entries to zero; the structure stays. */
void sunder_i_sparse_clear(sunder_i_sparse *matrix);
/* Returns the block of entry (a, b), a != b, which must be one of the pairs, to be read row by row; *transposed is set
 * if, read like this, it is the block of (b, a). */
double *sunder_i_sparse_block(sunder_i_sparse *matrix, uint32_t a, uint32_t b, bool *transposed);
/* Returns the block of entry (a, a), stored column by column. */
double *sunder_i_sparse_diagonal(sunder_i_sparse *matrix, uint32_t a);
/* Replaces the matrix by its Cholesky factor. Returns false if the matrix is not positive definite, as computed in
 * doubles. */
bool sunder_i_sparse_factor(sunder_i_sparse *matrix);
/* Solves a system by the factor. x: two doubles a row; in: the right-hand side, out: the solution. */
void sunder_i_sparse_solve(sunder_i_sparse *matrix, double *x);

#endif
