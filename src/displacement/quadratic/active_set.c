/* Solves for the forces of the active constraints as linear equations.
 *
 * The equations are G f = d, where G is the Gram matrix of the active constraints in the metric of the masses. They are
 * solved by a Cholesky factorisation, and the active set is corrected as by Lawson and Hanson [LH74, chapter 23]:
 * constraints whose forces turn negative are dropped, violated ones are added. At the end all forces are positive, the
 * active constraints hold with equality and no other constraint is violated, so the solution is optimal. */
#include "displacement/quadratic/methods.h"
#include "displacement/quadratic/tuning.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

typedef struct equations {
    uint32_t *set;        /* [capacity] the active constraints */
    double *factor;       /* the lower triangle of the Cholesky factor, by columns of length `capacity` */
    double *row;          /* [capacity] the row that is being factored */
    double *half, *force; /* the result of forward substitution; the forces */
    size_t n, capacity;
    int factors; /* the number of factorisations up to now */
} equations;

/* Returns the entry of the Gram matrix for constraints a and b. */
static double gram_entry(const sunder_i_quadratic *p, const sunder_i_constraint *a, const sunder_i_constraint *b)
{
    const double dot = a->n[0] * b->n[0] + a->n[1] * b->n[1];
    double m = 0;
    if (a->i != SUNDER_I_GROUND) m += a->i == b->i ? p->mass[a->i] : a->i == b->j ? -p->mass[a->i] : 0;
    if (a->j != SUNDER_I_GROUND) m += a->j == b->j ? p->mass[a->j] : a->j == b->i ? -p->mass[a->j] : 0;
    return dot * m;
}

/* Sets row[0 .. r] to row r of the Gram matrix up to the diagonal, whose entry is raised slightly. */
static void fill_row(const sunder_i_quadratic *p, const equations *e, size_t r, double softness, double *row)
{
    const sunder_i_constraint *c = &p->constraint[e->set[r]];
    for (size_t k = 0; k <= r; k++) row[k] = gram_entry(p, c, &p->constraint[e->set[k]]);
    row[r] = row[r] * (1 + softness + RAISED) + c->give;
}

/* Computes the Cholesky factor, a row at a time, and solves G f = d for e->force. Rows before `from` are kept from the
 * last call. Returns false if G is not positive definite, as computed in doubles.
 *
 * The factor is stored by columns: once an entry of a row is known, it is subtracted from the later entries of the row
 * in one pass over a column. Most entries are zero, since most pairs of constraints have no body in common. Each entry
 * is the same sum in the same order as if it were computed by itself. */
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

static bool gather_active(const sunder_i_quadratic *p, equations *e)
{
    e->n = 0;
    for (size_t k = 0; k < p->n; k++)
        if (p->constraint[k].force > 0) {
            if (e->n == e->capacity) return false;
            e->set[e->n++] = (uint32_t)k;
        }
    return true;
}

/* Removes row r from the active set. */
static void drop_row(sunder_i_quadratic *p, equations *e, size_t r)
{
    p->constraint[e->set[r]].force = 0;
    memmove(e->set + r, e->set + r + 1, (e->n - r - 1) * sizeof *e->set);
    e->n--;
}

/* Solves the equations and drops constraints with negative forces, repeatedly until all forces are positive. In the
 * first HASTY rounds all such constraints are dropped at once, which is usually right. After that the forces move
 * towards the solution only until one of them becomes zero, and that one constraint is dropped. Returns false if the
 * number of factorisations or the work exceeds its limit, or a factorisation fails or gives a force that is not
 * finite. */
static bool find_forces(sunder_i_quadratic *p, equations *e, double softness)
{
    size_t from = 0;
    for (int hasty = HASTY; e->n; hasty--) {
        if (e->factors++ >= MOST_FACTORS || sunder_i_quadratic_is_done(p)) return false;
        if (!solve_equations(p, e, from, softness)) return false;
        double step = 1;
        size_t first = SIZE_MAX, least = SIZE_MAX;
        for (size_t k = 0; k < e->n; k++) {
            const double now = p->constraint[e->set[k]].force;
            if (!isfinite(e->force[k])) return false;
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
            drop_row(p, e, first);
        else
            for (size_t k = e->n; k-- > least;)
                if (e->force[k] <= 0) drop_row(p, e, k);
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
        if (!gather_active(program, &e) || !find_forces(program, &e, softness)) break;
        sunder_i_quadratic_place(program);
        if (sunder_i_quadratic_worst(program, softness) <= tolerance) break;
        /* Constraints that the solution violates get a force in two passes of Hildreth's method. */
        sunder_i_quadratic_sweep(program, softness);
        sunder_i_quadratic_sweep(program, softness);
    }
    sunder_i_free_all(e.set, e.force, e.half, e.row, e.factor);
    return ok;
}
