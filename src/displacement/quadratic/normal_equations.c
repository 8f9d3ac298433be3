/* Sets up the matrix: its unknowns and rows, and which blocks each constraint adds to. This is computed once and used
 * in each step. */
#include "displacement/quadratic/normal_equations.h"
#include "displacement/quadratic/methods.h"

#include <string.h>

void sunder_i_normal_free(sunder_i_normal *q)
{
    sunder_i_sparse_free(&q->matrix);
    sunder_i_free_all(q->unknown, q->h, q->row);
}

static void number_unknowns(sunder_i_normal *q, const sunder_i_quadratic *p)
{
    for (size_t b = 0; b < p->bodies; b++) q->n += p->mass[b] > 0 ? 2 : 0;
    for (size_t b = 0, next = 0; b < p->bodies; b++) {
        q->unknown[b] = (uint32_t)(p->mass[b] > 0 ? next : q->n);
        next += p->mass[b] > 0 ? 2 : 0;
    }
}

/* Returns the positions of the bodies that have unknowns; NULL if memory is out. */
static double *find_places(const sunder_i_normal *q, const sunder_i_quadratic *p)
{
    double *place = sunder_i_alloc(q->n, sizeof *place);
    for (size_t b = 0; place && b < p->bodies; b++)
        if (p->mass[b] > 0) memcpy(place + q->unknown[b], p->place + 2 * b, 2 * sizeof *place);
    return place;
}

/* Sets the structure of the matrix: which blocks it has. */
static bool shape_matrix(sunder_i_normal *q, const sunder_i_quadratic *p)
{
    double *place = p->place ? find_places(q, p) : NULL;
    sunder_i_id_pair *pair = sunder_i_alloc(q->m, sizeof *pair);
    size_t pairs = 0;
    for (size_t c = 0; pair && c < q->m; c++)
        if (q->row[c].i < q->n && q->row[c].j < q->n)
            pair[pairs++] = (sunder_i_id_pair){q->row[c].i / 2, q->row[c].j / 2};
    const bool ok = pair && (place || !p->place) && sunder_i_sparse_init(&q->matrix, q->n / 2, pair, pairs, place);
    sunder_i_free_all(pair, place);
    return ok;
}

static void find_blocks(sunder_i_normal *q, sunder_i_normal_row *c)
{
    double *spare = q->h + q->n;
    /* The block of a constraint is symmetric, so it does not matter which of the two off-diagonal entries is stored. */
    bool transposed;
    c->on_i = c->i < q->n ? sunder_i_sparse_diagonal(&q->matrix, c->i / 2) : spare;
    c->on_j = c->j < q->n ? sunder_i_sparse_diagonal(&q->matrix, c->j / 2) : spare;
    c->across = c->i < q->n && c->j < q->n ? sunder_i_sparse_block(&q->matrix, c->i / 2, c->j / 2, &transposed) : spare;
}

bool sunder_i_normal_init(sunder_i_normal *q, const sunder_i_quadratic *program)
{
    memset(q, 0, sizeof *q);
    q->m = program->n;
    q->unknown = sunder_i_alloc(program->bodies, sizeof *q->unknown);
    q->row = sunder_i_alloc(q->m, sizeof *q->row);
    if (!q->unknown || !q->row) return false;
    number_unknowns(q, program);
    q->h = sunder_i_calloc(q->n + 4, sizeof *q->h);
    if (!q->h) return false;
    for (size_t b = 0; b < program->bodies; b++)
        for (size_t e = 0; e < 2 && program->mass[b] > 0; e++) q->h[q->unknown[b] + e] = 1 / program->mass[b];
    for (size_t c = 0; c < q->m; c++) {
        const sunder_i_constraint *k = &program->constraint[c];
        q->row[c].i = k->i == SUNDER_I_GROUND ? (uint32_t)q->n : q->unknown[k->i];
        q->row[c].j = k->j == SUNDER_I_GROUND ? (uint32_t)q->n : q->unknown[k->j];
        memcpy(q->row[c].n, k->n, sizeof k->n);
    }
    if (!shape_matrix(q, program)) return false;
    for (size_t c = 0; c < q->m; c++) find_blocks(q, &q->row[c]);
    return true;
}

void sunder_i_normal_clear(sunder_i_normal *q)
{
    sunder_i_sparse_clear(&q->matrix);
    for (size_t r = 0; r < q->n; r++) sunder_i_sparse_diagonal(&q->matrix, (uint32_t)r / 2)[r & 1 ? 3 : 0] = q->h[r];
}

void sunder_i_normal_add(sunder_i_normal *q, size_t c, double v)
{
    const sunder_i_normal_row *row = &q->row[c];
    const double x = row->n[0], y = row->n[1], part[] = {v * x * x, v * y * x, v * x * y, v * y * y};
    for (int e = 0; e < 4; e++) row->on_i[e] += part[e];
    for (int e = 0; e < 4; e++) row->on_j[e] += part[e];
    for (int e = 0; e < 4; e++) row->across[e] -= part[e];
}
