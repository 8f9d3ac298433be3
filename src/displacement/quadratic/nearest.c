/* Minimises |t|^2 under constraints n.(t_j - t_i) >= d, by the dual method of Goldfarb and Idnani [GI83].
 *
 * It begins at t = 0 with no active constraint, and adds one violated constraint after another, the worst first. The
 * normal v of the new constraint is a combination of the active normals, with coefficients called shares, plus a rest z
 * orthogonal to them:
 *
 *     t moves along z until v holds; v's force grows in proportion, those of the active ones change by their shares;
 *     a constraint whose force reaches zero before that becomes inactive.
 *
 * At each stage t is the nearest point under the active constraints, and its distance grows each time. So no active set
 * repeats, and the method ends, after a few steps for each constraint that is active at the end; iterative methods take
 * hundreds of passes. If all shares are non-positive, the sum of v and the active normals, each times minus its share,
 * is z. Then there is no solution if no move along z within the limits removes the violation of v [Farkas].
 *
 * The active normals are stored as Q R with Q orthonormal. They are orthogonalised twice [GVL13, 5.2]; the first pass
 * uses that a normal has entries for two bodies only. When a constraint is removed, rows of R are rotated by Givens
 * rotations. So two walls that almost oppose each other are distinguished from two that do.
 *
 *   the active normals span everything       z is a rounding error, and counts as zero, as does a rest below 1e-14
 *   an active constraint is violated again   by rounding: it is added again, and its earlier copy is removed */
#include "displacement/quadratic/nearest.h"
#include "displacement/quadratic/tuning.h"

#include "base/extremes.h"
#include "base/list.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

/* A squared length of `rest` (nearest.h) below this is taken for a rounding error. */
#define NOTHING 1e-28

void sunder_i_nearest_free(sunder_i_nearest *nearest)
{
    sunder_i_free_all(nearest->set, nearest->force, nearest->axis, nearest->factor, nearest->part, nearest->share,
                      nearest->rest);
}

bool sunder_i_nearest_begin(sunder_i_nearest *nearest, sunder_i_quadratic *program)
{
    const size_t n = 2 * program->bodies;
    nearest->dims = n;
    nearest->n = 0;
    memset(program->t, 0, n * sizeof *program->t);
    for (size_t k = 0; k < program->n; k++) program->constraint[k].force = 0;
    return sunder_i_reserve(&nearest->set, &nearest->set_capacity, n, sizeof *nearest->set) &&
           sunder_i_reserve(&nearest->force, &nearest->force_capacity, n, sizeof *nearest->force) &&
           sunder_i_reserve(&nearest->axis, &nearest->axis_capacity, n * n, sizeof *nearest->axis) &&
           sunder_i_reserve(&nearest->factor, &nearest->factor_capacity, n * n, sizeof *nearest->factor) &&
           sunder_i_reserve(&nearest->part, &nearest->part_capacity, n, sizeof *nearest->part) &&
           sunder_i_reserve(&nearest->share, &nearest->share_capacity, n, sizeof *nearest->share) &&
           sunder_i_reserve(&nearest->rest, &nearest->rest_capacity, n, sizeof *nearest->rest);
}

/* ---- The factors ------------------------------------------------------------------------------------------------- */

/* The scalar product of vectors of even length n, in four independent partial sums. */
static inline double scalar_product(const double *restrict a, const double *restrict b, size_t n)
{
    double sum[4] = {0, 0, 0, 0};
    size_t d = 0;
    for (; d + 4 <= n; d += 4)
        for (size_t e = 0; e < 4; e++) sum[e] += a[d + e] * b[d + e];
    for (size_t e = 0; d + e < n; e++) sum[e] += a[d + e] * b[d + e];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

static inline void subtract_multiple(double along, const double *restrict axis, double *restrict rest, size_t n)
{
    for (size_t d = 0; d < n; d++) rest[d] -= along * axis[d];
}

/* Returns the scalar product of the constraint's normal with an axis; the normal has entries for two bodies only. */
static inline double normal_along(const sunder_i_constraint *c, const double *axis)
{
    double along = 0;
    if (c->j != SUNDER_I_GROUND) along += c->n[0] * axis[2 * (size_t)c->j] + c->n[1] * axis[2 * (size_t)c->j + 1];
    if (c->i != SUNDER_I_GROUND) along -= c->n[0] * axis[2 * (size_t)c->i] + c->n[1] * axis[2 * (size_t)c->i + 1];
    return along;
}

/* Sets w->part, share and rest for the normal of constraint c. Returns the square of the rest's length, or 0 if the
 * rest is a rounding error. */
static double decompose_normal(sunder_i_nearest *w, const sunder_i_constraint *c)
{
    const size_t dims = w->dims;
    memset(w->rest, 0, dims * sizeof *w->rest);
    for (size_t x = 0; x < 2; x++) {
        if (c->j != SUNDER_I_GROUND) w->rest[2 * (size_t)c->j + x] += c->n[x];
        if (c->i != SUNDER_I_GROUND) w->rest[2 * (size_t)c->i + x] -= c->n[x];
    }
    for (size_t k = 0; k < w->n; k++) {
        const double *axis = w->axis + k * dims;
        w->part[k] = normal_along(c, axis);
        subtract_multiple(w->part[k], axis, w->rest, dims);
    }
    for (size_t k = 0; k < w->n; k++) {
        const double *axis = w->axis + k * dims, along = scalar_product(axis, w->rest, dims);
        subtract_multiple(along, axis, w->rest, dims);
        w->part[k] += along;
    }
    for (size_t k = w->n; k-- > 0;) {
        double share = w->part[k];
        for (size_t l = k + 1; l < w->n; l++) share -= w->factor[l * dims + k] * w->share[l];
        w->share[k] = share / w->factor[k * dims + k];
    }
    const double square = scalar_product(w->rest, w->rest, dims);
    return w->n < dims && square > NOTHING ? square : 0;
}

/* Makes the constraint for which decompose_normal() was called active. */
static void activate_constraint(sunder_i_nearest *w, size_t constraint, double force, double square)
{
    const double length = sqrt(square);
    double *axis = w->axis + w->n * w->dims, *factor = w->factor + w->n * w->dims;
    for (size_t d = 0; d < w->dims; d++) axis[d] = w->rest[d] / length;
    memcpy(factor, w->part, w->n * sizeof *factor);
    factor[w->n] = length;
    w->set[w->n] = (uint32_t)constraint;
    w->force[w->n++] = force;
}

/* Makes the k-th active constraint inactive. */
static void deactivate_constraint(sunder_i_nearest *w, size_t k)
{
    const size_t dims = w->dims, after = w->n - k - 1;
    memmove(w->set + k, w->set + k + 1, after * sizeof *w->set);
    memmove(w->force + k, w->force + k + 1, after * sizeof *w->force);
    memmove(w->factor + k * dims, w->factor + (k + 1) * dims, after * dims * sizeof *w->factor);
    w->n--;
    for (; k < w->n; k++) {
        double *low = w->axis + k * dims, *high = low + dims;
        const double *own = w->factor + k * dims, length = hypot(own[k], own[k + 1]);
        const double c = own[k] / length, s = own[k + 1] / length;
        for (size_t l = k; l < w->n; l++) {
            double *f = w->factor + l * dims, at = f[k];
            f[k] = c * at + s * f[k + 1];
            f[k + 1] = c * f[k + 1] - s * at;
        }
        for (size_t d = 0; d < dims; d++) {
            const double at = low[d];
            low[d] = c * at + s * high[d];
            high[d] = c * high[d] - s * at;
        }
    }
}

/* ---- The steps --------------------------------------------------------------------------------------------------- */

/* Returns the active constraint whose force is the first to reach zero as the new constraint's force grows, or w->n if
 * there is none. *step is the growth at which it does. */
static size_t first_to_vanish(const sunder_i_nearest *w, double *step)
{
    size_t first = w->n;
    *step = INFINITY;
    for (size_t k = 0; k < w->n; k++) {
        if (!(w->share[k] > 0) || !(w->force[k] / w->share[k] < *step)) continue;
        *step = w->force[k] / w->share[k];
        first = k;
    }
    return first;
}

/* Is the greatest decrease of the violation along the rest, within the limits, less than the violation `missed`? */
static bool is_out_of_reach(const sunder_i_nearest *w, const sunder_i_quadratic *p, const double *from,
                            const double *limit, double missed)
{
    double most = 0;
    for (size_t b = 0; b < p->bodies; b++) {
        const double *z = w->rest + 2 * b, x = from[2 * b] + p->t[2 * b], y = from[2 * b + 1] + p->t[2 * b + 1];
        most += limit[b] * sqrt(z[0] * z[0] + z[1] * z[1]) - z[0] * x - z[1] * y;
    }
    return most < missed;
}

static void set_forces(const sunder_i_nearest *w, sunder_i_quadratic *p, const double *force, double sign)
{
    for (size_t k = 0; k < p->n; k++) p->constraint[k].force = 0;
    for (size_t k = 0; k < w->n; k++) p->constraint[w->set[k]].force = sunder_i_max(0, sign * force[k]);
}

/* Adds constraint `which` and steps until it holds; then returns FOUND. */
static sunder_i_nearest_outcome satisfy_constraint(sunder_i_nearest *w, sunder_i_quadratic *p, size_t which,
                                                   const double *from, const double *limit)
{
    const sunder_i_constraint *c = &p->constraint[which];
    double own = 0, most;
    for (int step = 0; step < MOST_NEAREST; step++) {
        const double square = decompose_normal(w, c), missed = sunder_i_max(0, c->d - sunder_i_stretch(c, p->t));
        const size_t first = first_to_vanish(w, &most);
        p->work += 1 + w->n * w->dims / 4;
        if (first == w->n && is_out_of_reach(w, p, from, limit, missed)) {
            set_forces(w, p, w->share, -1);
            p->constraint[which].force = 1;
            return SUNDER_I_NEAREST_NONE;
        }
        const bool holds = square > 0 && missed / square <= most;
        const double by = holds ? missed / square : most;
        if (!isfinite(by)) return SUNDER_I_NEAREST_NOT_SURE;
        for (size_t d = 0; d < w->dims && square > 0; d++) p->t[d] += by * w->rest[d];
        for (size_t k = 0; k < w->n; k++) w->force[k] = sunder_i_max(0, w->force[k] - by * w->share[k]);
        own += by;
        if (holds) {
            activate_constraint(w, which, own, square);
            return SUNDER_I_NEAREST_FOUND;
        }
        deactivate_constraint(w, first);
    }
    return SUNDER_I_NEAREST_NOT_SURE;
}

sunder_i_nearest_outcome sunder_i_nearest_go_on(sunder_i_nearest *nearest, sunder_i_quadratic *program,
                                                const double *from, const double *limit, double tolerance)
{
    for (int step = 0; step < MOST_NEAREST; step++) {
        size_t worst = program->n;
        double most = tolerance;
        program->work += program->n;
        for (size_t k = 0; k < program->n; k++) {
            const double missed = program->constraint[k].d - sunder_i_stretch(&program->constraint[k], program->t);
            if (!(missed > most)) continue;
            most = missed;
            worst = k;
        }
        if (worst == program->n) {
            set_forces(nearest, program, nearest->force, 1);
            return SUNDER_I_NEAREST_FOUND;
        }
        const sunder_i_nearest_outcome outcome = satisfy_constraint(nearest, program, worst, from, limit);
        if (outcome != SUNDER_I_NEAREST_FOUND) return outcome;
    }
    return SUNDER_I_NEAREST_NOT_SURE;
}
