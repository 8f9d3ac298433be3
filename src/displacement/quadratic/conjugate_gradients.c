/* Conjugate gradients on non-negative forces: modified proportioning with reduced gradient projections [Dos09,
 * algorithm 5.8].
 *
 * The dual is min 1/2 f'Gf - d'f over f >= 0. Among the positive forces it takes conjugate gradient steps. Where such a
 * step would make a force negative, it stops there and takes a short projected gradient step instead. Where the
 * gradient at the zero forces exceeds the imbalance of the positive ones, it lets zero forces in. Each constraint is
 * scaled so that its diagonal in G is 1. G is never formed: a product with it moves the bodies by the forces and reads
 * the stretch of each constraint.
 *
 * It is unpredictable which forces are positive and which way a step goes. So loops over all constraints compute both
 * alternatives and select one, where they can, instead of branching. */
#include "displacement/quadratic/links.h"
#include "displacement/quadratic/tuning.h"

#include "base/extremes.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

/* Norms of the imbalance: of positive forces (twice, once clipped where the step would make them negative), of zero
 * forces; and the worst, as a length. */
typedef struct imbalance {
    double cut, zero, worst;
} imbalance;

typedef struct dual {
    sunder_i_quadratic *p;
    size_t n;
    double softness;
    double *scale;             /* [n] sqrt(mass_i + mass_j); 0 for what cannot move */
    double *f, *g, *step, *gs; /* [n] forces, gradient Gf - d, direction, G times it */
    double *t;                 /* [2 * (bodies + 1)] */
    uint32_t *pushing;         /* [n] scratch: constraints with a nonzero entry */
    sunder_i_link *link;       /* [n] */
    imbalance seen;            /* at the forces as they are ... */
    bool is_seen;              /* ... if it is known */
} dual;

/* Where v pushes the bodies: to q->t. */
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

/* (G v)_k, after v was pushed. */
static inline double product_of(const dual *q, const double *v, size_t k)
{
    return q->scale[k] > 0 ? sunder_i_link_stretch(&q->link[k], q->t) / q->scale[k] + q->softness * v[k] : 0;
}

/* out = G v */
static void multiply(dual *q, const double *v, double *out)
{
    push_all(q, v);
    for (size_t k = 0; k < q->n; k++) out[k] = product_of(q, v, k);
}

/* As sunder_i_min() and sunder_i_max() for a first argument that is a number: a NaN as second argument is ignored.
 * Inline. */
static inline double least(double so_far, double x) { return x < so_far ? x : so_far; }
static inline double most(double so_far, double x) { return x > so_far ? x : so_far; }

static void gradient(dual *q)
{
    multiply(q, q->f, q->g);
    for (size_t k = 0; k < q->n; k++)
        if (q->scale[k] > 0) q->g[k] -= q->p->constraint[k].d / q->scale[k];
}

/* A little above the largest eigenvalue of G, by powers. */
static double largest(dual *q)
{
    double value = 1;
    for (size_t k = 0; k < q->n; k++) q->step[k] = q->scale[k] > 0 ? 1 + (double)(k % 7) / 8 : 0;
    for (int round = 0; round < POWERS; round++) {
        multiply(q, q->step, q->gs);
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

/* Along the step: its curvature, or 0 where it is only rounding; its slope; and its length until a force becomes zero.
 * Contradicting constraints give a direction without curvature, along which the dual falls without end: a step there
 * could have any length, and overflow in the end. The diagonal of G is 1, so sums of n terms are off by at most n 2^-53
 * of the step's square; a chain of n contacts has a curvature of at least 5 / n^2 of it. The two are apart up to
 * 100,000 contacts. */
typedef struct direction {
    double curvature, slope, feasible;
} direction;

/* G times the step to q->gs, and on the same way all sums along it: each is added up by itself, in its order, and none
 * waits for another. What no force bars is told by a product, a hair more than it may be; few are divided. */
static direction look_along(dual *q)
{
    const double *step = q->step, *f = q->f, *g = q->g;
    double curvature = 0, square = 0, slope = 0, feasible = INFINITY;
    push_all(q, step);
    for (size_t k = 0; k < q->n; k++) {
        const double product = q->gs[k] = product_of(q, step, k);
        curvature += step[k] * product;
        square += step[k] * step[k];
        slope += g[k] * step[k];
        if (f[k] < feasible * step[k] * (1 + 0x1p-50)) feasible = least(feasible, f[k] / step[k]);
    }
    return (direction){curvature > 0x1p-44 * square ? curvature : 0, slope, feasible};
}

/* The gradient among the positive forces is the next direction. */
static void restart(dual *q)
{
    for (size_t k = 0; k < q->n; k++) q->step[k] = q->f[k] > 0 ? q->g[k] : 0;
}

static inline void note_imbalance(imbalance *i, double f, double g, double scale, double short_step)
{
    const bool positive = f > 0;
    const double cut = least(f / short_step, g) * g; /* of a force of 0 the square of g, if it calls for more, or 0 */
    const double off = positive ? fabs(g) : most(0, -g);
    i->cut += positive ? cut : 0;
    i->zero += positive ? 0 : cut;
    i->worst = most(i->worst, off * scale);
}

static imbalance look(const dual *q, double short_step)
{
    imbalance i = {0, 0, 0};
    for (size_t k = 0; k < q->n; k++) note_imbalance(&i, q->f[k], q->g[k], q->scale[k], short_step);
    return i;
}

/* Takes a step of this length. Returns the component of the remaining gradient along the step, among the positive
 * forces, and records the imbalance on the way. */
static double go(dual *q, double taken, double short_step)
{
    imbalance i = {0, 0, 0};
    double along = 0;
    for (size_t k = 0; k < q->n; k++) {
        const double f = q->f[k] = most(0, q->f[k] - taken * q->step[k]);
        const double g = q->g[k] -= taken * q->gs[k];
        const double product = g * q->gs[k];
        along += f > 0 ? product : 0;
        note_imbalance(&i, f, g, q->scale[k], short_step);
    }
    q->seen = i;
    return along;
}

/* One step among the positive forces; false if it makes no progress. */
static bool step_within(dual *q, double short_step)
{
    const direction d = look_along(q);
    q->is_seen = false;
    if (!(d.curvature > 0)) {
        restart(q);
        return false;
    }
    const double length = d.slope / d.curvature;
    const double along = go(q, sunder_i_min(length, d.feasible), short_step) / d.curvature;
    if (length <= d.feasible) {
        q->is_seen = true;
        for (size_t k = 0; k < q->n; k++) q->step[k] = (q->f[k] > 0 ? q->g[k] : 0) - along * q->step[k];
        return true;
    }
    for (size_t k = 0; k < q->n; k++)
        if (q->f[k] > 0) q->f[k] = most(0, q->f[k] - short_step * q->g[k]);
    gradient(q);
    restart(q);
    return true;
}

/* Lets in the zero forces that are called for; false where that leads nowhere. */
static bool step_in(dual *q)
{
    for (size_t k = 0; k < q->n; k++) q->step[k] = q->f[k] > 0 ? 0 : least(0, q->g[k]);
    const direction d = look_along(q);
    q->is_seen = false;
    if (d.curvature > 0) {
        const double length = d.slope / d.curvature;
        for (size_t k = 0; k < q->n; k++) {
            q->f[k] -= length * q->step[k];
            q->g[k] -= length * q->gs[k];
        }
    }
    restart(q);
    return d.curvature > 0;
}

/* Is every imbalance below the tolerance? Usually the sweeps have found the forces already; then no step needs a
 * length, which takes a dozen products to find. They are counted as work all the same, so that skipping them changes no
 * result. */
static bool is_in_balance(dual *q, double tolerance)
{
    const double any_length = 1;
    bool any = false;
    for (size_t k = 0; k < q->n && !any; k++) any = q->scale[k] > 0;
    if (!any || !(look(q, any_length).worst <= tolerance)) return false;
    q->p->work += POWERS * 2 * q->n;
    return true;
}

/* Copies the result to the program. */
static void store(const dual *q)
{
    for (size_t k = 0; k < q->n; k++)
        if (q->scale[k] > 0) q->p->constraint[k].force = q->f[k] / q->scale[k];
}

/* Do the forces, as they are, prove that no solution is of any use? Without one they grow until they do. */
static bool is_beyond(const dual *q)
{
    if (q->softness > 0 || !(q->p->most_cost > 0)) return false;
    store(q);
    return sunder_i_quadratic_is_beyond(q->p, q->softness);
}

static void iterate(dual *q, double tolerance, unsigned steps)
{
    gradient(q);
    if (is_in_balance(q, tolerance)) return;
    const double short_step = GRADIENT_STEP / largest(q);
    restart(q);
    /* Nowhere along a direction made of earlier ones, and then nowhere along the gradient itself: this is the end. */
    int nowhere = 0;
    for (unsigned k = 0; k < steps && nowhere < 2 && !sunder_i_quadratic_is_done(q->p); k++) {
        const imbalance i = q->is_seen ? q->seen : look(q, short_step);
        if (i.worst <= tolerance) break;
        const bool somewhere = i.zero <= i.cut ? step_within(q, short_step) : step_in(q);
        nowhere = somewhere ? 0 : nowhere + 1;
        if (k % REFRESH != REFRESH - 1) continue;
        if (is_beyond(q)) break;
        gradient(q);
        q->is_seen = false;
    }
}

bool sunder_i_quadratic_gradient(sunder_i_quadratic *program, double softness, double tolerance, unsigned steps)
{
    if (program->n == 0) return true;
    const size_t numbers = 5 * program->n + 2 * (program->bodies + 1),
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
              .t = memory + 5 * program->n,
              .link = link,
              .pushing = (uint32_t *)(void *)(link + program->n)};
    for (size_t k = 0; k < program->n; k++) {
        const sunder_i_constraint *c = &program->constraint[k];
        q.scale[k] = sqrt(sunder_i_mass(program, c->i) + sunder_i_mass(program, c->j));
        q.f[k] = q.scale[k] * c->force;
    }
    iterate(&q, tolerance / 2, steps);
    store(&q);
    if (need > sizeof few) sunder_i_free(memory);
    return true;
}
