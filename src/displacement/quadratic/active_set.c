/* The acting constraints as linear equations.
 *
 * G f = d with G the Gram matrix of the acting constraints in the metric of the masses, by Cholesky; and the set
 * corrected as by Lawson and Hanson [LH74, chapter 23]: forces that turn negative are dropped, violated constraints
 * added. At the end all forces are positive, the acting constraints hold with equality and no other is violated: that
 * is the optimum. */
#include "displacement/quadratic/methods.h"
#include "displacement/quadratic/tuning.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

typedef struct equations {
    uint32_t *set;        /* [capacity] acting constraints */
    double *factor;       /* its lower triangle, by columns of `capacity` */
    double *row;          /* [capacity] the one at hand */
    double *half, *force; /* after the forward half; the solution */
    size_t n, capacity;
    int factors; /* so far */
} equations;

/* Entry (a, b) of the Gram matrix. */
static double gram(const sunder_i_quadratic *p, const sunder_i_constraint *a, const sunder_i_constraint *b)
{
    const double dot = a->n[0] * b->n[0] + a->n[1] * b->n[1];
    double m = 0;
    if (a->i != SUNDER_I_GROUND) m += a->i == b->i ? p->mass[a->i] : a->i == b->j ? -p->mass[a->i] : 0;
    if (a->j != SUNDER_I_GROUND) m += a->j == b->j ? p->mass[a->j] : a->j == b->i ? -p->mass[a->j] : 0;
    return dot * m;
}

/* Row r of the Gram matrix up to the diagonal, which is a little raised. */
static void fill_row(const sunder_i_quadratic *p, const equations *e, size_t r, double softness, double *row)
{
    const sunder_i_constraint *c = &p->constraint[e->set[r]];
    for (size_t k = 0; k <= r; k++) row[k] = gram(p, c, &p->constraint[e->set[k]]);
    row[r] *= 1 + softness + RAISED;
}

/* Cholesky factor, a row at a time, and the solution of G f = d. Rows before `from` are kept from the last call.
 *
 * The factor is kept by columns: as soon as an entry of a row is known, its contribution to the later entries of the
 * row is one pass over a column. Most entries are zero, since most constraints have no body in common. Each entry is
 * the same sum in the same order as if it were computed by itself. */
static bool solve_equations(sunder_i_quadratic *p, equations *e, size_t from, double softness)
{
    p->work += e->n * e->n * (e->n - from) / 32 + e->n * e->n / 8;
    double *row = e->row;
    for (size_t r = from; r < e->n; r++) {
        double f = p->constraint[e->set[r]].d;
        fill_row(p, e, r, softness, row);
        for (size_t k = 0; k < r; k++) {
            double *column = e->factor + k * e->capacity;
            if (row[k] == 0) {
                column[r] = 0;
                continue;
            }
            const double x = row[k] / column[k];
            column[r] = x;
            f -= x * e->half[k];
            for (size_t i = k + 1; i <= r; i++) row[i] -= x * column[i];
        }
        if (!(row[r] > 0)) return false;
        const double root = sqrt(row[r]);
        e->factor[r * e->capacity + r] = root;
        e->half[r] = f / root;
    }
    memcpy(e->force, e->half, e->n * sizeof *e->force);
    for (size_t r = e->n; r-- > 0;) {
        const double *column = e->factor + r * e->capacity;
        double f = e->force[r];
        for (size_t k = r + 1; k < e->n; k++) f -= column[k] * e->force[k];
        e->force[r] = f / column[r];
    }
    return true;
}

static bool gather(const sunder_i_quadratic *p, equations *e)
{
    e->n = 0;
    for (size_t k = 0; k < p->n; k++)
        if (p->constraint[k].force > 0) {
            if (e->n == e->capacity) return false;
            e->set[e->n++] = (uint32_t)k;
        }
    return true;
}

/* Takes row r out of the set. */
static void drop(sunder_i_quadratic *p, equations *e, size_t r)
{
    p->constraint[e->set[r]].force = 0;
    memmove(e->set + r, e->set + r + 1, (e->n - r - 1) * sizeof *e->set);
    e->n--;
}

/* Solves, drops what would pull instead of push, solves again. At first all such constraints at once, which mostly is
 * right; then by the book: the forces go towards the solution until one of them is zero, and only that one
 * is dropped. */
static bool descend(sunder_i_quadratic *p, equations *e, double softness)
{
    size_t from = 0;
    for (int hasty = HASTY; e->n; hasty--) {
        if (e->factors++ >= MOST_FACTORS || sunder_i_quadratic_is_done(p)) return false;
        if (!solve_equations(p, e, from, softness)) return false;
        double step = 1;
        size_t first = SIZE_MAX, least = SIZE_MAX;
        for (size_t k = 0; k < e->n; k++) {
            const double now = p->constraint[e->set[k]].force;
            if (e->force[k] > 0) continue;
            if (least == SIZE_MAX) least = k;
            if (hasty <= 0 && now / (now - e->force[k]) <= step) {
                step = now / (now - e->force[k]);
                first = k;
            }
        }
        for (size_t k = 0; k < e->n; k++) {
            sunder_i_constraint *c = &p->constraint[e->set[k]];
            c->force += step * (e->force[k] - c->force);
            if (c->force < 0) c->force = 0;
        }
        if (least == SIZE_MAX) return true;
        from = hasty > 0 ? least : first;
        if (hasty <= 0)
            drop(p, e, first);
        else
            for (size_t k = e->n; k-- > least;)
                if (e->force[k] <= 0) drop(p, e, k);
    }
    return true;
}

bool sunder_i_quadratic_equations(sunder_i_quadratic *program, double softness, double tolerance)
{
    size_t acting = 0;
    for (size_t k = 0; k < program->n; k++) acting += program->constraint[k].force > 0;
    if (acting > MOST_ACTIVE) return true;
    equations e = {.capacity = acting + MORE_ACTIVE};
    e.set = sunder_i_alloc(e.capacity, sizeof *e.set);
    e.force = sunder_i_alloc(e.capacity, sizeof *e.force);
    e.half = sunder_i_alloc(e.capacity, sizeof *e.half);
    e.row = sunder_i_alloc(e.capacity, sizeof *e.row);
    e.factor = sunder_i_calloc(e.capacity * e.capacity, sizeof *e.factor);
    const bool ok = e.set && e.force && e.half && e.row && e.factor;
    for (int round = 0; ok && round < MOST_ADDING; round++) {
        if (!gather(program, &e) || !descend(program, &e, softness)) break;
        sunder_i_quadratic_place(program);
        if (sunder_i_quadratic_worst(program, softness) <= tolerance) break;
        /* Those that the solution violates get a force of their own by a pass or two of the first method. */
        sunder_i_quadratic_sweep(program, softness);
        sunder_i_quadratic_sweep(program, softness);
    }
    sunder_i_free(e.set);
    sunder_i_free(e.force);
    sunder_i_free(e.half);
    sunder_i_free(e.row);
    sunder_i_free(e.factor);
    return ok;
}
