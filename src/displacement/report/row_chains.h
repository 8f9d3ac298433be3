/* Pairs of neighbours, row by row. */
#ifndef SUNDER_I_ROW_CHAINS_H
#define SUNDER_I_ROW_CHAINS_H

#include "displacement/layer/model.h"
#include "sunder_parts.h"

/* A pair in a row. */
typedef struct sunder_i_chained_pair {
    size_t pair;
    bool turned; /* the row passes the second one of the pair first */
} sunder_i_chained_pair;

typedef struct sunder_i_row_chains {
    sunder_i_chained_pair *link; /* [row_end[rows - 1]] the pairs of each row in order */
    size_t *row_end;             /* [rows] the index past the last pair of each row */
    size_t rows;
    size_t *block; /* [2 * pairs] a number below `blocks` for each of the two blocks of a pair */
    size_t blocks; /* the number of different blocks */
} sunder_i_row_chains;

/* The caller frees them with sunder_i_row_chains_free(), also after a failure. Fails with SUNDER_ENOMEM. */
sunder_status sunder_i_row_chains_make(const sunder_row_pair *pair, size_t n, sunder_i_row_chains *out,
                                       sunder_error *err);
void sunder_i_row_chains_free(sunder_i_row_chains *chains);

#endif
