/* Conjugate gradients on non-negative forces: modified proportioning with reduced gradient projections [Dos09,
 * algorithm 5.8].
 *
 * The dual is min 1/2 f'Gf - d'f over f >= 0. Conjugate gradient steps change the positive forces. If such a step would
 * make a force negative, it stops there, and a short projected gradient step follows instead. If the gradient at the
 * zero forces exceeds the imbalance of the positive ones, zero forces are allowed to grow. Each constraint is scaled so
 * that its diagonal entry in G is 1. G is never formed: a product with it moves the bodies by the forces and computes
 * the stretch of each constraint.
 *
 * The sign of a force, and the direction of a step, are unpredictable. So loops over all constraints compute both
 * alternatives and select one, where possible, instead of branching. */
#include "displacement/quadratic/links.h"
#include "displacement/quadratic/tuning.h"

#include "base/extremes.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

/* How far the forces are from the optimum. `cut` is a squared norm over the positive forces: each gradient entry times
 * that entry, or times the entry clipped so that the short step would not make the force negative. `zero` is the same
 * over the zero forces. `worst` is the largest violation as a length. */
typedef struct imbalance {
    double cut, zero, worst;
} imbalance;

typedef struct dual {
    sunder_i_quadratic *p;
    size_t n;
    double softness;
    double *scale;             /* [n] sqrt(mass_i + mass_j); 0 if neither end can move */
    double *give;              /* [n] what is added to the diagonal of G */
    double *f, *g, *step, *gs; /* [n] forces, gradient Gf - d, direction, G times it */
    double *t;                 /* [2 * (bodies + 1)] the moves of the bodies; the last is the ground */
    uint32_t *pushing;         /* [n] scratch: constraints with a nonzero entry */
    sunder_i_link *link;       /* [n] */
    imbalance seen;            /* the imbalance for the present forces */
    bool is_seen;              /* `seen` is valid */
} dual;

/* Sets q->t to the moves of the bodies that the forces v cause. */
static void push_all(dual *q, const double *v)
{
    const sunder_i_quadratic *p = q->p;
    const sunder_i_link *link = q->link;
    const double *scale = q->scale;
    double *t = q->t;
    memset(t, 0, 2 * p->bodies * sizeof *t);
    size_t pushing = 0;
    for (uint32_t k = 0; k < q->n; k++) {
        q->pushing[pushing] = k;
        pushing += v[k] != 0;
    }
    for (size_t i = 0; i < pushing; i++) {
        const uint32_t k = q->pushing[i];
        sunder_i_link_push(&link[k], v[k] / scale[k], t);
    }
    t[2 * p->bodies] = t[2 * p->bodies + 1] = 0; /* the ground */
    q->p->work += 2 * q->n;
}

/* Returns (G v)_k. push_all() must have been called for v. */
static inline double product_of(const dual *q, const double *v, size_t k)
{
    return q->scale[k] > 0 ? sunder_i_link_stretch(&q->link[k], q->t) / q->scale[k] + q->give[k] * v[k] : 0;
}

/* Computes out = G v. */
static void multiply_by_matrix(dual *q, const double *v, double *out)
{
    push_all(q, v);
    for (size_t k = 0; k < q->n; k++) out[k] = product_of(q, v, k);
}

/* As sunder_i_min() and sunder_i_max() if the first argument is a number: a NaN as second argument is ignored.
 * Inline. */
static inline double least_of(double other, double x) { return x < other ? x : other; }
static inline double most_of(double other, double x) { return x > other ? x : other; }

static void compute_gradient(dual *q)
{
    multiply_by_matrix(q, q->f, q->g);
    for (size_t k = 0; k < q->n; k++)
        if (q->scale[k] > 0) q->g[k] -= q->p->constraint[k].d / q->scale[k];
}

/* Returns an estimate, slightly too large, of the largest eigenvalue of G, by the power method. */
static double largest_eigenvalue(dual *q)
{
    double value = 1;
    for (size_t k = 0; k < q->n; k++) q->step[k] = q->scale[k] > 0 ? 1 + (double)(k % 7) / 8 : 0;
    for (int round = 0; round < POWERS; round++) {
        multiply_by_matrix(q, q->step, q->gs);
        double norm = 0, before = 0;
        for (size_t k = 0; k < q->n; k++) {
            norm += q->gs[k] * q->gs[k];
            before += q->step[k] * q->step[k];
        }
        if (!(norm > 0)) break;
        value = sqrt(norm / before);
        for (size_t k = 0; k < q->n; k++) q->step[k] = q->gs[k] / sqrt(norm);
    }
    return ABOVE_FOUND * value;
}

/* A step along q->step. `curvature` is step'G step, or 0 if it is no larger than rounding errors; `slope` is that of
 * the dual; `feasible` is the step length at which the first force becomes zero.
 *
 * Contradicting constraints give a direction without curvature, along which the dual decreases without bound, so a step
 * could have any length and overflow. The diagonal of G is 1, so rounding errors of sums of n terms are at most n 2^-53
 * of the step's square; a chain of n contacts has a curvature of at least 5 / n^2 of it. The two can be distinguished
 * up to 100,000 contacts. */
typedef struct direction {
    double curvature, slope, feasible;
} direction;

/* Sets q->gs to G times the step, and computes all sums along the step in the same pass, each in its own order, so that
 * none waits for another. A division is made only for a force that may limit the step; a product, raised slightly,
 * shows which those are. */
static direction measure_step(dual *q)
{
    const double *step = q->step, *f = q->f, *g = q->g;
    double curvature = 0, square = 0, slope = 0, feasible = INFINITY;
    push_all(q, step);
    for (size_t k = 0; k < q->n; k++) {
        const double product = q->gs[k] = product_of(q, step, k);
        curvature += step[k] * product;
        square += step[k] * step[k];
        slope += g[k] * step[k];
        if (f[k] < feasible * step[k] * (1 + 0x1p-50)) feasible = least_of(feasible, f[k] / step[k]);
    }
    return (direction){curvature > 0x1p-44 * square ? curvature : 0, slope, feasible};
}

/* The next direction is the gradient of the positive forces alone. */
static void restart_step(dual *q)
{
    for (size_t k = 0; k < q->n; k++) q->step[k] = q->f[k] > 0 ? q->g[k] : 0;
}

static inline void note_imbalance(imbalance *i, double f, double g, double scale, double short_step)
{
    const bool positive = f > 0;
    const double cut =
        least_of(f / short_step, g) * g; /* for a zero force: the square of g if g is negative, so that the
                                                      * force should grow; else 0 */
    const double off = positive ? fabs(g) : most_of(0, -g);
    i->cut += positive ? cut : 0;
    i->zero += positive ? 0 : cut;
    i->worst = most_of(i->worst, off * scale);
}

static imbalance measure_imbalance(const dual *q, double short_step)
{
    imbalance i = {0, 0, 0};
    for (size_t k = 0; k < q->n; k++) note_imbalance(&i, q->f[k], q->g[k], q->scale[k], short_step);
    return i;
}

/* Takes a step of length `taken`. Returns the component of the remaining gradient along the step, over the positive
 * forces, and records the imbalance in q->seen. */
static double take_step(dual *q, double taken, double short_step)
{
    imbalance i = {0, 0, 0};
    double along = 0;
    for (size_t k = 0; k < q->n; k++) {
        const double f = q->f[k] = most_of(0, q->f[k] - taken * q->step[k]);
        const double g = q->g[k] -= taken * q->gs[k];
        const double product = g * q->gs[k];
        along += f > 0 ? product : 0;
        note_imbalance(&i, f, g, q->scale[k], short_step);
    }
    q->seen = i;
    return along;
}

/* Two priced constraints with opposite normals both push while they give, and start as firm ones with these forces. All
 * but the difference has to vanish, along a direction without curvature: takes a step until a force is 0. */
static bool cancel_forces(dual *q, const direction *d, double short_step)
{
    const bool cancels = q->p->priced && d->slope > 0 && d->feasible < INFINITY;
    if (cancels) {
        take_step(q, d->feasible, short_step);
        compute_gradient(q);
    }
    restart_step(q);
    return cancels;
}

/* Makes one step in the positive forces. Returns false if it makes no progress. */
static bool step_positive_forces(dual *q, double short_step)
{
    const direction d = measure_step(q);
    q->is_seen = false;
    if (!(d.curvature > 0)) return cancel_forces(q, &d, short_step);
    const double length = d.slope / d.curvature;
    const double along = take_step(q, sunder_i_min(length, d.feasible), short_step) / d.curvature;
    if (length <= d.feasible) {
        q->is_seen = true;
        for (size_t k = 0; k < q->n; k++) q->step[k] = (q->f[k] > 0 ? q->g[k] : 0) - along * q->step[k];
        return true;
    }
    for (size_t k = 0; k < q->n; k++)
        if (q->f[k] > 0) q->f[k] = most_of(0, q->f[k] - short_step * q->g[k]);
    compute_gradient(q);
    restart_step(q);
    return true;
}

/* Lets zero forces with a negative gradient grow. Returns false if their direction has no curvature. */
static bool step_zero_forces(dual *q)
{
    for (size_t k = 0; k < q->n; k++) q->step[k] = q->f[k] > 0 ? 0 : least_of(0, q->g[k]);
    const direction d = measure_step(q);
    q->is_seen = false;
    if (d.curvature > 0) {
        const double length = d.slope / d.curvature;
        for (size_t k = 0; k < q->n; k++) {
            q->f[k] -= length * q->step[k];
            q->g[k] -= length * q->gs[k];
        }
    }
    restart_step(q);
    return d.curvature > 0;
}

/* Is every violation at most `tolerance`? Usually the sweeps have found the forces already; then no step length is
 * needed, which takes a dozen products to compute. These products are counted as work all the same, so that skipping
 * them changes no result. */
static bool is_in_balance(dual *q, double tolerance)
{
    const double any_length = 1;
    bool any = false;
    for (size_t k = 0; k < q->n && !any; k++) any = q->scale[k] > 0;
    if (!any || !(measure_imbalance(q, any_length).worst <= tolerance)) return false;
    q->p->work += POWERS * 2 * q->n;
    return true;
}

/* Copies the forces to the program. */
static void store_forces(const dual *q)
{
    for (size_t k = 0; k < q->n; k++)
        if (q->scale[k] > 0) q->p->constraint[k].force = q->f[k] / q->scale[k];
}

/* Do the present forces prove that no solution costs at most p->most_cost? If the program has no solution the forces
 * grow until they do. */
static bool is_beyond(const dual *q)
{
    if (q->softness > 0 || !(q->p->most_cost > 0)) return false;
    store_forces(q);
    return sunder_i_quadratic_is_beyond(q->p, q->softness);
}

static void iterate_steps(dual *q, double tolerance, unsigned steps)
{
    compute_gradient(q);
    if (is_in_balance(q, tolerance)) return;
    const double short_step = GRADIENT_STEP / largest_eigenvalue(q);
    restart_step(q);
    /* After a step without progress along a conjugate direction the next step is along the gradient. If that makes no
     * progress either, the loop ends. */
    int idle = 0;
    for (unsigned k = 0; k < steps && idle < 2 && !sunder_i_quadratic_is_done(q->p); k++) {
        const imbalance i = q->is_seen ? q->seen : measure_imbalance(q, short_step);
        if (i.worst <= tolerance) break;
        const bool has_moved = i.zero <= i.cut ? step_positive_forces(q, short_step) : step_zero_forces(q);
        idle = has_moved ? 0 : idle + 1;
        if (k % REFRESH != REFRESH - 1) continue;
        if (is_beyond(q)) break;
        compute_gradient(q);
        q->is_seen = false;
    }
}

bool sunder_i_quadratic_gradient(sunder_i_quadratic *program, double softness, double tolerance, unsigned steps)
{
    if (program->n == 0) return true;
    const size_t numbers = 6 * program->n + 2 * (program->bodies + 1),
                 need = numbers * sizeof(double) + program->n * (sizeof(sunder_i_link) + sizeof(uint32_t));
    _Alignas(double) char few[ON_THE_STACK];
    double *memory = need <= sizeof few ? (double *)(void *)few : sunder_i_alloc(need, 1);
    if (!memory) return false;
    memset(memory, 0, numbers * sizeof *memory);
    sunder_i_link *link = (sunder_i_link *)(void *)(memory + numbers);
    sunder_i_links_make(program, link);
    dual q = {.p = program,
              .n = program->n,
              .softness = softness,
              .scale = memory,
              .f = memory + program->n,
              .g = memory + 2 * program->n,
              .step = memory + 3 * program->n,
              .gs = memory + 4 * program->n,
              .give = memory + 5 * program->n,
              .t = memory + 6 * program->n,
              .link = link,
              .pushing = (uint32_t *)(void *)(link + program->n)};
    for (size_t k = 0; k < program->n; k++) {
        const sunder_i_constraint *c = &program->constraint[k];
        const double mass = sunder_i_mass(program, c->i) + sunder_i_mass(program, c->j);
        q.scale[k] = sqrt(mass);
        q.give[k] = mass > 0 ? softness + c->give / mass : 0;
        q.f[k] = q.scale[k] * c->force;
    }
    iterate_steps(&q, tolerance / 2, steps);
    store_forces(&q);
    if (need > sizeof few) sunder_i_free(memory);
    return true;
}
