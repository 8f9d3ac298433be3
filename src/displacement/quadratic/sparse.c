/* The structure of a sparse matrix and of its Cholesky factor, for an order of elimination.
 *
 * Nodes that are eliminated late often have the same neighbours as the node after them, except for that node itself. In
 * a postorder of the elimination tree such columns are consecutive, and are processed as one panel
 * (sparse_factor.c). */
#include "displacement/quadratic/sparse.h"
#include "displacement/quadratic/elimination.h"

#include "base/invariant.h"

#include <stdlib.h>
#include <string.h>

void sunder_i_sparse_free(sunder_i_sparse *matrix)
{
    sunder_i_free_all(matrix->rank, matrix->column, matrix->row, matrix->diagonal, matrix->block, matrix->first,
                      matrix->link, matrix->at, matrix->y, matrix->panel, matrix->across);
    memset(matrix, 0, sizeof *matrix);
}

/* ---- Columns ----------------------------------------------------------------------------------------------------- */

/* Does column k have the same rows as the column before it, except for row k itself? */
static bool continues_panel(const sunder_i_sparse *m, uint32_t k)
{
    return k > 0 && m->column[k] > m->column[k - 1] && m->row[m->column[k - 1]] == k &&
           m->column[k] - m->column[k - 1] == m->column[k + 1] - m->column[k] + 1;
}

/* Makes the columns, by rank, from the lists of neighbours. Returns false if memory is out. */
static bool fill_columns(sunder_i_sparse *m, const sunder_i_elimination *g)
{
    size_t entries = 0;
    for (size_t v = 0; v < m->n; v++) entries += g->near[v].n;
    m->row = sunder_i_alloc(entries, sizeof *m->row);
    m->block = sunder_i_alloc(4 * entries, sizeof *m->block);
    if (!m->row || !m->block) return false;
    for (size_t v = 0; v < m->n; v++) m->column[m->rank[v] + 1] = g->near[v].n;
    m->column[0] = 0;
    for (size_t r = 0; r < m->n; r++) m->column[r + 1] += m->column[r];
    for (size_t v = 0; v < m->n; v++) {
        uint32_t *row = m->row + m->column[m->rank[v]];
        const size_t n = g->near[v].n;
        for (size_t k = 0; k < n; k++) row[k] = m->rank[g->near[v].item[k]];
        if (n) qsort(row, n, sizeof *row, sunder_i_by_number);
        m->work += n * (n + 1) / 2;
    }
    for (uint32_t k = 0; k < m->n; k++) m->panel[k] = continues_panel(m, k) ? m->panel[k - 1] : k;
    return true;
}

#ifndef NDEBUG
/* Checks that ranks are a permutation, and that rows ascend below the diagonal in each column. */
static const char *check_matrix(const sunder_i_sparse *m)
{
    size_t sum = 0;
    for (size_t v = 0; v < m->n; v++) {
        if (m->rank[v] >= m->n) return "a rank beyond the last";
        sum += m->rank[v];
        for (size_t k = m->column[v]; k < m->column[v + 1]; k++)
            if (m->row[k] <= (k > m->column[v] ? m->row[k - 1] : v) || m->row[k] >= m->n) return "rows do not ascend";
    }
    return m->n == 0 || sum == m->n * (m->n - 1) / 2 ? NULL : "ranks are no permutation";
}
#endif

bool sunder_i_sparse_init(sunder_i_sparse *matrix, size_t n, const sunder_i_id_pair *pair, size_t pairs,
                          const double *place)
{
    memset(matrix, 0, sizeof *matrix);
    matrix->n = n;
    matrix->rank = sunder_i_alloc(n, sizeof *matrix->rank);
    matrix->column = sunder_i_calloc(n + 1, sizeof *matrix->column);
    matrix->diagonal = sunder_i_alloc(4 * n, sizeof *matrix->diagonal);
    matrix->first = sunder_i_alloc(n, sizeof *matrix->first);
    matrix->link = sunder_i_alloc(n, sizeof *matrix->link);
    matrix->at = sunder_i_alloc(2 * n, sizeof *matrix->at);
    matrix->y = sunder_i_alloc(2 * n, sizeof *matrix->y);
    matrix->panel = sunder_i_alloc(n, sizeof *matrix->panel);
    matrix->across = sunder_i_alloc(8 * n, sizeof *matrix->across);
    if (!matrix->rank || !matrix->column || !matrix->diagonal || !matrix->first || !matrix->link || !matrix->at ||
        !matrix->y || !matrix->panel || !matrix->across)
        return false;
    sunder_i_elimination e;
    const bool ok = sunder_i_elimination_init(&e, n, pair, pairs, matrix->rank) && sunder_i_eliminate(&e, place) &&
                    fill_columns(matrix, &e);
    sunder_i_elimination_free(&e);
    SUNDER_I_CHECK(ok ? check_matrix(matrix) : NULL, n);
    return ok;
}

/* ---- Entries ----------------------------------------------------------------------------------------------------- */

void sunder_i_sparse_clear(sunder_i_sparse *matrix)
{
    memset(matrix->diagonal, 0, 4 * matrix->n * sizeof *matrix->diagonal);
    memset(matrix->block, 0, 4 * matrix->column[matrix->n] * sizeof *matrix->block);
}

double *sunder_i_sparse_diagonal(sunder_i_sparse *matrix, uint32_t a)
{
    return matrix->diagonal + 4 * (size_t)matrix->rank[a];
}

double *sunder_i_sparse_block(sunder_i_sparse *matrix, uint32_t a, uint32_t b, bool *transposed)
{
    const uint32_t ra = matrix->rank[a], rb = matrix->rank[b], low = ra < rb ? ra : rb, high = ra < rb ? rb : ra;
    const uint32_t *row = matrix->row + matrix->column[low];
    const uint32_t *found =
        bsearch(&high, row, matrix->column[low + 1] - matrix->column[low], sizeof *row, sunder_i_by_number);
    *transposed = ra > rb; /* blocks are stored column by column, and read row by row */
    return matrix->block + 4 * (size_t)(found - matrix->row);
}
