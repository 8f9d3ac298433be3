/* Solves a program again that was solved before and has got a few more constraints.
 *
 * In a cluster of thousands of bodies, once the program is solved, a dozen bodies exceed their limits, or run into
 * pieces that were out of reach before: of 48 programs of a grid of 5,041 squares within limits, 20 were solved again
 * for a handful of constraints. The effect of a few constraints decreases with the number of contacts between, so only
 * the bodies around them are solved while all others stay. More constraints never make the optimum cheaper, so the
 * increase in cost bounds the distance of the result from the optimum. */
#include "displacement/quadratic/methods.h"
#include "displacement/quadratic/tuning.h"

#include "base/extremes.h"
#include "base/memory.h"
#include "base/stage_switch.h"

#include <math.h>
#include <string.h>

#define OUTSIDE UINT32_MAX

typedef struct mending {
    sunder_i_quadratic *p;
    uint32_t *ring;  /* [bodies] the number of contacts from a violated constraint; OUTSIDE: the body stays */
    uint32_t *place; /* [bodies] the number of each body in the partial program */
    uint32_t *body;  /* [part.bodies] the number of each in the whole program */
    uint32_t *which; /* [part.n] the constraints of the whole program */
    double *mass;    /* [part.bodies] */
    sunder_i_quadratic part;
} mending;

static void mending_free(mending *m)
{
    sunder_i_free_all(m->ring, m->place, m->body, m->which, m->mass, m->part.t, m->part.constraint);
}

static bool mending_init(mending *m, sunder_i_quadratic *p)
{
    memset(m, 0, sizeof *m);
    m->p = p;
    m->ring = sunder_i_alloc(p->bodies, sizeof *m->ring);
    m->place = sunder_i_alloc(p->bodies, sizeof *m->place);
    m->body = sunder_i_alloc(p->bodies, sizeof *m->body);
    m->which = sunder_i_alloc(p->n, sizeof *m->which);
    m->mass = sunder_i_alloc(p->bodies, sizeof *m->mass);
    m->part.t = sunder_i_alloc(2 * p->bodies, sizeof *m->part.t);
    m->part.constraint = sunder_i_alloc(p->n, sizeof *m->part.constraint);
    return m->ring && m->place && m->body && m->which && m->mass && m->part.t && m->part.constraint;
}

/* ---- Bodies of the partial program ------------------------------------------------------------------------------- */

static bool may_move(const mending *m, uint32_t body) { return body != SUNDER_I_GROUND && m->p->mass[body] > 0; }

static bool takes_part(const mending *m, uint32_t body) { return body != SUNDER_I_GROUND && m->ring[body] != OUTSIDE; }

static void mark_missed(mending *m, double tolerance)
{
    const sunder_i_quadratic *p = m->p;
    for (size_t b = 0; b < p->bodies; b++) m->ring[b] = OUTSIDE;
    for (size_t k = 0; k < p->n; k++) {
        const sunder_i_constraint *c = &p->constraint[k];
        if (c->d - sunder_i_stretch(c, p->t) - c->give * c->force <= tolerance) continue;
        if (may_move(m, c->i)) m->ring[c->i] = 0;
        if (may_move(m, c->j)) m->ring[c->j] = 0;
    }
}

/* Marks the next ring: bodies in contact with bodies of ring number `ring` that are in no ring yet. */
static void mark_next(mending *m, uint32_t ring)
{
    const sunder_i_quadratic *p = m->p;
    for (size_t k = 0; k < p->n; k++) {
        const uint32_t i = p->constraint[k].i, j = p->constraint[k].j;
        if (!may_move(m, i) || !may_move(m, j)) continue;
        if (m->ring[i] == ring && m->ring[j] == OUTSIDE) m->ring[j] = ring + 1;
        if (m->ring[j] == ring && m->ring[i] == OUTSIDE) m->ring[i] = ring + 1;
    }
    m->p->work += p->n;
}

/* ---- The partial program ----------------------------------------------------------------------------------------- */

static void take_bodies(mending *m)
{
    sunder_i_quadratic *part = &m->part;
    part->bodies = 0;
    for (uint32_t b = 0; b < m->p->bodies; b++) {
        if (m->ring[b] == OUTSIDE) continue;
        m->place[b] = (uint32_t)part->bodies;
        m->mass[part->bodies] = m->p->mass[b];
        memcpy(part->t + 2 * part->bodies, m->p->t + 2 * (size_t)b, 2 * sizeof *part->t);
        m->body[part->bodies++] = b;
    }
    part->mass = m->mass;
}

/* Makes the constraints of the partial program: those with at least one end that takes part. An end that does not take
 * part becomes the ground, and its present move is included in the distance. */
static void take_constraints(mending *m)
{
    const sunder_i_quadratic *p = m->p;
    sunder_i_quadratic *part = &m->part;
    part->n = 0;
    for (size_t k = 0; k < p->n; k++) {
        sunder_i_constraint c = p->constraint[k];
        const bool i = takes_part(m, c.i), j = takes_part(m, c.j);
        if (!i && !j) continue;
        const sunder_i_constraint still = {
            .i = i ? SUNDER_I_GROUND : c.i, .j = j ? SUNDER_I_GROUND : c.j, .n = {c.n[0], c.n[1]}};
        c.d -= sunder_i_stretch(&still, p->t);
        c.i = i ? m->place[c.i] : SUNDER_I_GROUND;
        c.j = j ? m->place[c.j] : SUNDER_I_GROUND;
        m->which[part->n] = (uint32_t)k;
        part->constraint[part->n++] = c;
    }
}

static double cost_of(const sunder_i_quadratic *p)
{
    double cost = 0;
    for (size_t k = 0; k < p->n; k++)
        cost += p->constraint[k].give * p->constraint[k].force * p->constraint[k].force / 2;
    for (size_t b = 0; b < p->bodies; b++)
        if (p->mass[b] > 0) cost += (p->t[2 * b] * p->t[2 * b] + p->t[2 * b + 1] * p->t[2 * b + 1]) / (2 * p->mass[b]);
    return cost;
}

static void swap_doubles(double *a, double *b)
{
    const double c = *a;
    *a = *b;
    *b = c;
}

/* Exchanges moves and forces between the partial program and the whole one; a second call undoes it. */
static void exchange_results(mending *m)
{
    for (size_t b = 0; b < 2 * m->part.bodies; b++) swap_doubles(&m->p->t[2 * m->body[b / 2] + b % 2], &m->part.t[b]);
    for (size_t k = 0; k < m->part.n; k++)
        swap_doubles(&m->p->constraint[m->which[k]].force, &m->part.constraint[k].force);
}

/* Solves the partial program by the interior point method, as the whole was solved: a body that ends slightly beyond
 * what its pairs require stands worse than before, and would have to go back. *solved is set if the result, together
 * with the bodies that stay, costs at most a share `more` more than before; the whole program then has it. Returns
 * false if memory is out. */
static bool solve_part(mending *m, double tolerance, double scale, double more, bool *solved)
{
    sunder_i_quadratic *p = m->p, *part = &m->part;
    part->work = 0;
    part->most_work = p->most_work ? (p->most_work > p->work ? p->most_work - p->work : 1) : 0;
    *solved = false;
    if (!sunder_i_quadratic_interior(part, 0, tolerance, scale)) return false;
    p->work += part->work + p->n;
    if (!(sunder_i_quadratic_worst(part, 0) <= tolerance)) return true;
    const double before = cost_of(p);
    exchange_results(m);
    *solved = cost_of(p) <= before * (1 + more);
    if (!*solved) exchange_results(m);
    return true;
}

double sunder_i_quadratic_mend_part(sunder_i_quadratic *program, double tolerance, double scale, double more)
{
    if (program->n <= MOST_QUICK || !sunder_i_stage_is_on("program", "mend")) return INFINITY;
    mending m;
    bool ok = mending_init(&m, program), solved = false;
    if (ok) mark_missed(&m, tolerance);
    for (uint32_t rings = FIRST_RINGS, ring = 0; ok && !solved && !sunder_i_quadratic_is_done(program); rings *= 2) {
        const size_t before = m.part.bodies;
        for (; ring < rings; ring++) mark_next(&m, ring);
        take_bodies(&m);
        if (m.part.bodies == before || m.part.bodies > program->bodies / MOST_MENDING_SHARE) break;
        take_constraints(&m);
        ok = solve_part(&m, tolerance, scale, more, &solved);
    }
    mending_free(&m);
    if (!ok) return -1;
    return solved ? sunder_i_max(0, sunder_i_quadratic_worst(program, 0)) : INFINITY;
}
