/* Solves the same program by Newton steps on the moves, starting from forces that are nearly right.
 *
 * A soft program has no hard constraints: a violation v > 0 costs v^2 / (2 give), with give = softness * (mass_i +
 * mass_j), and its force is v / give. The sum of these costs and the cost of the moves is convex, smooth and piecewise
 * quadratic; a piece is given by the set of violated constraints, which are the active ones. A Newton step goes to the
 * minimum of the present piece, or to the least value on the way there. Once a full step stays in its piece, the
 * solution is found [QS93]. This takes a few steps from forces that are nearly right, and a dozen or two from zero. The
 * dual methods, in contrast, need more steps for longer chains, and do not end if constraints contradict each other.
 *
 * A hard program is solved as a sequence of soft ones [Roc76]: the distance of each constraint is increased by give
 * times its previous force, so that nothing is violated once the forces no longer change. A smaller give needs fewer
 * rounds, so it is reduced in each. What a constraint gives by itself is no part of that share. If contradictions let
 * the forces grow, they soon prove that every solution costs too much. */
#include "displacement/quadratic/methods.h"
#include "displacement/quadratic/normal_equations.h"
#include "displacement/quadratic/tuning.h"

#include "base/extremes.h"
#include "base/watch.h"

#include <math.h>
#include <string.h>

typedef struct newton {
    sunder_i_quadratic *p;
    sunder_i_normal normal;
    double *x, *step;    /* [n + 2] the moves of the bodies, and a step; zero for the ground */
    double *give, *owed; /* [m] give: the violation that a force of 1 causes, 0 if neither end can move; owed: the
                          * distance, including the force's share */
    double *left;        /* [m] the violation of `owed`; if it is positive the constraint is active, with force left /
                          * give */
    double *along;       /* [m] how much the whole step reduces `left` */
    double *first;       /* [m] the forces at the beginning */
    double *before;      /* [m] the forces before the last step of the sequence */
    double *memory;
} newton;

static bool newton_init(newton *q, sunder_i_quadratic *p)
{
    memset(q, 0, sizeof *q);
    q->p = p;
    if (!sunder_i_normal_init(&q->normal, p)) return false;
    const size_t places = q->normal.n + 2, m = q->normal.m;
    q->memory = sunder_i_calloc(2 * places + 6 * m, sizeof *q->memory);
    if (!q->memory) return false;
    q->x = q->memory;
    q->step = q->x + places;
    q->give = q->step + places;
    q->owed = q->give + m;
    q->left = q->owed + m;
    q->along = q->left + m;
    q->first = q->along + m;
    q->before = q->first + m;
    for (size_t c = 0; c < m; c++) q->first[c] = p->constraint[c].force;
    return true;
}

/* ---- One soft program -------------------------------------------------------------------------------------------- */

static void measure_violations(newton *q)
{
    for (size_t c = 0; c < q->normal.m; c++)
        q->left[c] = q->give[c] > 0 ? q->owed[c] - sunder_i_normal_stretch(&q->normal.row[c], q->x) : 0;
}

/* Computes the step to the minimum of the present piece. Returns false if the matrix is not positive definite, as
 * computed in doubles. */
static bool find_step(newton *q)
{
    sunder_i_normal *a = &q->normal;
    sunder_i_normal_clear(a);
    for (size_t k = 0; k < a->n; k++) q->step[k] = -a->h[k] * q->x[k];
    for (size_t c = 0; c < a->m; c++) {
        if (!(q->left[c] > 0)) continue;
        sunder_i_normal_add(a, c, 1 / q->give[c]);
        sunder_i_normal_spread(&a->row[c], q->left[c] / q->give[c], q->step);
    }
    q->p->work += (q->p->bodies <= FEW_BODIES ? WORK_OF_FEW : 1) * (a->matrix.work + 4 * a->m);
    if (!sunder_i_sparse_factor(&a->matrix)) return false;
    sunder_i_sparse_solve(&a->matrix, q->step);
    q->step[a->n] = q->step[a->n + 1] = 0;
    for (size_t c = 0; c < a->m; c++) q->along[c] = sunder_i_normal_stretch(&a->row[c], q->step);
    return true;
}

/* Sets *slope to the derivative of the sum at fraction `share` of the step, and *bend to its second derivative. moves:
 * the contribution of the cost of moves. */
static void derivatives_at(const newton *q, double share, const double moves[2], double *slope, double *bend)
{
    *slope = moves[0] + share * moves[1];
    *bend = moves[1];
    for (size_t c = 0; c < q->normal.m; c++) {
        const double left = q->left[c] - share * q->along[c];
        if (!(left > 0)) continue;
        const double force = q->along[c] / q->give[c];
        *slope -= left * force;
        *bend += q->along[c] * force;
    }
}

/* Returns the fraction of the step at which the sum is least, approximately. The slope along the step is increasing and
 * piecewise linear, so Newton's method finds its zero, bracketed between a fraction where the sum decreases and one
 * where it increases. */
static double find_share(const newton *q)
{
    const sunder_i_normal *a = &q->normal;
    double moves[2] = {0, 0}, low = 0, high = INFINITY, share = 1, whole = 0;
    for (size_t k = 0; k < a->n; k++) {
        moves[0] += a->h[k] * q->x[k] * q->step[k];
        moves[1] += a->h[k] * q->step[k] * q->step[k];
    }
    for (int k = 0; k < MOST_SHARES; k++) {
        double slope, bend;
        derivatives_at(q, share, moves, &slope, &bend);
        if (k == 0) whole = fabs(slope);
        *(slope > 0 ? &high : &low) = share;
        if (k > 0 && !(fabs(slope) > FLAT * whole)) break;
        const double before = share;
        share -= slope / bend;
        if (!(share > low && share < high)) share = high < INFINITY ? (low + high) / 2 : 2 * before;
        if (fabs(share - before) < FLAT * before) break;
    }
    return share;
}

/* Goes the fraction `share` of the step. Returns whether the active constraints are the same as before. *far is the
 * longest whole step of a coordinate. */
static bool take_step(newton *q, double share, double *far)
{
    bool same = true;
    *far = 0;
    for (size_t k = 0; k < q->normal.n; k++) {
        q->x[k] += share * q->step[k];
        *far = sunder_i_max(*far, fabs(q->step[k]));
    }
    for (size_t c = 0; c < q->normal.m; c++) {
        const bool acted = q->left[c] > 0;
        q->left[c] -= share * q->along[c];
        same = same && acted == (q->left[c] > 0);
    }
    return same;
}

/* Finds the minimum of the sum. Returns false if it was not found. */
static bool minimise_sum(newton *q, double tolerance)
{
    measure_violations(q);
    if (!sunder_i_look()) return false;
    for (int k = 0; k < MOST_NEWTON && !sunder_i_quadratic_is_done(q->p); k++) {
        double far;
        if (!find_step(q)) return false;
        const double share = find_share(q);
        const bool same = take_step(q, share, &far);
        if ((same && share == 1) || far <= tolerance) return true;
    }
    return false;
}

/* ---- The sequence of soft programs ------------------------------------------------------------------------------- */

/* Sets the distances `owed`, for a hard program including the share of the present forces. */
static void set_distances(newton *q, double softness, bool hard)
{
    const sunder_i_quadratic *p = q->p;
    for (size_t c = 0; c < q->normal.m; c++) {
        const sunder_i_constraint *k = &p->constraint[c];
        const double give = softness * (sunder_i_mass(p, k->i) + sunder_i_mass(p, k->j));
        q->give[c] = give > 0 ? give + k->give : 0;
        q->owed[c] = k->d + (hard ? give * k->force : 0);
    }
}

/* Stores the new forces in the program. Returns the largest change of give times force: it is the distance by which a
 * constraint is violated, or slack, because its force has changed. *missed is the largest increase, which is a
 * violation. */
static double take_forces(newton *q, double *missed)
{
    double most = 0;
    *missed = 0;
    measure_violations(q);
    for (size_t c = 0; c < q->normal.m; c++) q->before[c] = q->p->constraint[c].force;
    for (size_t c = 0; c < q->normal.m; c++) {
        if (!(q->give[c] > 0)) continue;
        const double left = sunder_i_max(0, q->left[c]), change = fabs(left - q->give[c] * q->p->constraint[c].force);
        if (!(change <= most)) most = change;
        *missed = sunder_i_max(*missed, left - q->give[c] * q->p->constraint[c].force);
        q->p->constraint[c].force = left / q->give[c];
    }
    return most;
}

static bool solve_soft(newton *q, double softness, double tolerance)
{
    set_distances(q, softness, false);
    if (!minimise_sum(q, tolerance / CLOSE)) return false;
    double missed;
    take_forces(q, &missed);
    return true;
}

/* Returns how far to continue along the last change of the forces: as far as the bound that they prove grows and no
 * force becomes negative. Along f + s g, where f and g cause the moves t and u, the bound grows by s (g.d - sum of t.u
 * / mass - sum of give f g) - s^2 / 2 (sum of u.u / mass + sum of give g^2) [weak duality, forces.c]. It stops at
 * twice the bound that is needed. rising: forces that decreased are kept. */
static double far_along(const newton *q, bool rising)
{
    const sunder_i_quadratic *p = q->p;
    double gain = 0, loss = 0, far = INFINITY, *t = sunder_i_calloc(4 * p->bodies, sizeof *t);
    if (!t) return 0;
    double *u = t + 2 * p->bodies;
    for (size_t c = 0; c < p->n; c++) {
        const sunder_i_constraint *k = &p->constraint[c];
        const double more = sunder_i_max(k->force - q->before[c], rising ? 0 : -INFINITY);
        if (k->force > 0) sunder_i_push(p, k, k->force, t);
        if (more != 0) sunder_i_push(p, k, more, u);
        if (more < 0) far = sunder_i_min(far, k->force / -more);
        gain += more * (k->d - k->give * k->force);
        loss += k->give * more * more;
    }
    for (size_t b = 0; b < 2 * p->bodies; b++) {
        if (!(p->mass[b / 2] > 0)) continue;
        gain -= t[b] * u[b] / p->mass[b / 2];
        loss += u[b] * u[b] / p->mass[b / 2];
    }
    sunder_i_free(t);
    if (!(gain > 0)) return 0;
    far = sunder_i_min(far, gain / loss);
    if (p->most_cost > 0) far = sunder_i_min(far, 4 * p->most_cost / gain);
    return far < INFINITY ? far : 0;
}

static void go_along(newton *q, double far, bool rising)
{
    for (size_t c = 0; c < q->p->n; c++) {
        double *force = &q->p->constraint[c].force;
        const double now = *force, more = now - q->before[c];
        if (more > 0 || !rising) *force = sunder_i_max(0, now + far * more);
        q->before[c] = now;
    }
}

/* Is it proved that all solutions cost too much, by the present forces or by forces farther along their last change? If
 * constraints contradict each other only slightly, the forces grow slowly, but at last along a straight line. If they
 * prove it, the program has these forces. */
static bool is_beyond(newton *q)
{
    if (sunder_i_quadratic_is_beyond(q->p, 0)) return true;
    const double far = q->p->most_cost > 0 ? far_along(q, true) : 0;
    if (!(far > 0)) return false;
    memcpy(q->along, q->before, q->normal.m * sizeof *q->along);
    go_along(q, far, true);
    if (sunder_i_quadratic_is_beyond(q->p, 0)) return true;
    for (size_t c = 0; c < q->normal.m; c++) q->p->constraint[c].force = q->before[c];
    memcpy(q->before, q->along, q->normal.m * sizeof *q->along);
    return false;
}

/* Solves a hard program; returns false if it was not solved. If the forces change as much as in the last round, force
 * is being transferred between two constraints that are nearly the same, in steps limited by the small distance between
 * the two; the rest of that path is taken at once. As long as the violations are tiny, it does not matter which of the
 * two has the force. (With few constraints the dual methods settle this quickly.) */
static bool solve_hard(newton *q, double tolerance)
{
    const bool few = q->normal.m <= FEW_TO_LEAP;
    const int most = few ? MOST_FORCES_OF_FEW : MOST_FORCES;
    double give = FIRST_GIVE, last = INFINITY;
    if (sunder_i_quadratic_is_beyond(q->p, 0)) return true;
    for (int k = 0; k < most && !sunder_i_quadratic_is_done(q->p);
         k++, give = sunder_i_max(LEAST_GIVE, give / LESS_GIVE)) {
        set_distances(q, give, true);
        if (!minimise_sum(q, tolerance / CLOSE)) return false;
        double missed;
        const double change = take_forces(q, &missed);
        if (change <= tolerance || is_beyond(q)) return true;
        const bool stands = !few && change > STANDS * last;
        if (stands && missed <= tolerance && change <= HAIR * tolerance) return true;
        if (stands) go_along(q, far_along(q, false), false);
        last = change;
    }
    return false;
}

bool sunder_i_quadratic_newton(sunder_i_quadratic *program, double softness, double tolerance, bool *solved)
{
    newton q;
    *solved = false;
    const bool ok = newton_init(&q, program);
    if (ok) {
        sunder_i_quadratic_place(program);
        for (size_t b = 0; b < program->bodies; b++)
            if (program->mass[b] > 0) memcpy(q.x + q.normal.unknown[b], program->t + 2 * b, 2 * sizeof *q.x);
        *solved = softness > 0 ? solve_soft(&q, softness, tolerance) : solve_hard(&q, tolerance);
        for (size_t b = 0; b < program->bodies && *solved; b++)
            if (program->mass[b] > 0) memcpy(program->t + 2 * b, q.x + q.normal.unknown[b], 2 * sizeof *q.x);
        for (size_t c = 0; c < program->n && !*solved; c++) program->constraint[c].force = q.first[c];
    }
    sunder_i_normal_free(&q.normal);
    sunder_i_free(q.memory);
    return ok;
}
