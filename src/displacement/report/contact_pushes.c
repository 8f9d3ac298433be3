/* Computes the pushes that hold the features of a contact group in place: the forces of the group's quadratic program
 * at the result.
 *
 * In the result every pair in contact lies on the boundary of its forbidden set and keeps one half-plane for each piece
 * that it touches. Among all moves that keep these half-planes and the limits, the moves of the result have the least
 * cost, up to rounding, if the result is optimal. The multipliers of the half-planes say how strongly each pair is
 * pushed. They are computed in floating point and decide nothing. Several half-planes of one pair give one push, the
 * sum of their forces (renumber.c). A feature at its limit is pushed by the limit too, which is not reported, since it
 * is no pair. A pair that remains in conflict is held to the distance or the depth that it had at the start. */
#include "displacement/layer/reads.h"
#include "displacement/prove/optimum/body_contact.h"
#include "displacement/quadratic/quadratic.h"
#include "displacement/report/report.h"
#include "displacement/report/tuning.h"
#include "displacement/solve/clusters/cluster_stages.h"

#include "base/extremes.h"
#include "base/parallel.h"
#include "base/watch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The number of groups whose pushes one task computes, and the number of tasks that run before cached pieces of bodies
 * may be discarded. */
#define GROUPS_OF_A_BATCH 64
#define BATCHES_AT_ONCE 32

/* The pushes found for some groups, in the order of the groups. */
typedef struct found_pushes {
    sunder_push *push;
    size_t n, capacity;
} found_pushes;

typedef struct pressing {
    const sunder_i_solver *solver;
    const sunder_i_group *group;
    sunder_i_waived waived;
    sunder_i_quadratic program;
    sunder_push *push; /* [program.n] the pair that each constraint of `program` belongs to */
    size_t push_capacity;
    sunder_i_list near;
    sunder_i_contact_list touch; /* the contacts of the pair that is examined */
    found_pushes *found;
} pressing;

static size_t place_of(const sunder_i_group *g, uint32_t body)
{
    const uint32_t *at = bsearch(&body, g->body, g->n, sizeof body, sunder_i_by_number);
    return at ? (size_t)(at - g->body) : SIZE_MAX;
}

/* Returns the distance up to which a and b count as touching: the contact tolerance plus twice the margin that the
 * group keeps beyond the gap. */
static double hair_of(const pressing *p, const sunder_i_body *a, const sunder_i_body *b)
{
    return sunder_i_contact_hair(&p->solver->model, a, b) + 2 * p->group->margin;
}

static bool add_constraint(pressing *p, const sunder_i_constraint *c, size_t a, size_t b)
{
    sunder_i_quadratic *q = &p->program;
    if (!sunder_i_reserve(&q->constraint, &q->capacity, q->n + 1, sizeof *q->constraint) ||
        !sunder_i_reserve(&p->push, &p->push_capacity, q->n + 1, sizeof *p->push))
        return false;
    p->push[q->n] = (sunder_push){.a = a, .b = b};
    q->constraint[q->n++] = *c;
    return true;
}

/* Adds the half-planes of bodies i and j of the group to the program, one for each contact. Returns false if memory is
 * out. */
static bool add_pair(pressing *p, size_t i, size_t j)
{
    const sunder_i_model *model = &p->solver->model;
    const uint32_t a = p->group->body[i], b = p->group->body[j];
    const double hair = hair_of(p, &model->body[a], &model->body[b]);
    bool ok = sunder_i_contacts_of_pair(model, &p->waived, a, b, model->move + 2 * (size_t)a,
                                        model->move + 2 * (size_t)b, hair, &p->touch, NULL);
    for (size_t k = 0; k < p->touch.n && ok; k++) {
        const sunder_i_contact *touch = &p->touch.item[k];
        const sunder_i_constraint c = {
            .i = (uint32_t)i, .j = (uint32_t)j, .n = {touch->n[0], touch->n[1]}, .d = touch->d};
        ok = add_constraint(p, &c, touch->a, touch->b);
    }
    return ok;
}

/* Adds the half-planes of body i and all bodies of the group that are near it, or near its path from the original
 * position if paths are restricted. Pairs of movable bodies are added once, from the body with the smaller index.
 * Returns false if memory is out. */
static bool add_pairs_of(pressing *p, size_t i)
{
    const sunder_i_model *model = &p->solver->model;
    const uint32_t b = p->group->body[i];
    const sunder_i_body *body = &model->body[b];
    const double home[2] = {0, 0};
    double box[4], start[4];
    if (body->fixed || body->pieces == 0) return true;
    p->near.n = 0;
    sunder_i_body_box(body, model->move + 2 * (size_t)b, model->rules.gap + hair_of(p, body, body), box);
    sunder_i_body_box(body, home, model->rules.gap, start);
    if (sunder_i_forbids_paths(model)) sunder_i_box_join(box, start);
    sunder_i_reading reading;
    sunder_i_reads_begin(&reading, model, b);
    const bool ok = sunder_i_look_about(model, model->standing, box, &p->near);
    sunder_i_reads_end(&reading);
    if (!ok) return false;
    sunder_i_things_to_bodies(model, &p->near);
    for (size_t k = 0; k < p->near.n; k++) {
        const size_t j = place_of(p->group, p->near.item[k]);
        if (j == SIZE_MAX || j == i || (!model->body[p->near.item[k]].fixed && j < i)) continue;
        if (!sunder_i_step() || !add_pair(p, i, j)) return false;
    }
    return true;
}

/* If body i is at its limit, adds the constraint that its move does not get longer in the direction n of its present
 * move t: -n.v >= -|t| for its new move v. Returns false if memory is out. */
static bool add_limit(pressing *p, size_t i)
{
    const sunder_i_model *model = &p->solver->model;
    const uint32_t b = p->group->body[i];
    const double *t = model->move + 2 * (size_t)b, length = hypot(t[0], t[1]);
    if (model->body[b].fixed || !(length > 0) || length < model->body[b].limit * (1 - AT_LIMIT)) return true;
    const sunder_i_constraint c = {
        .i = (uint32_t)i, .j = SUNDER_I_GROUND, .n = {t[0] / length, t[1] / length}, .d = -length};
    return add_constraint(p, &c, SIZE_MAX, SIZE_MAX);
}

/* Appends a push for each constraint with a positive force. Several pushes of one pair are added up only in renumber.c,
 * when the final numbers of the features are known. */
static bool list_forces(pressing *p)
{
    const sunder_i_quadratic *q = &p->program;
    found_pushes *r = p->found;
    for (size_t k = 0; k < q->n; k++) {
        const sunder_i_constraint *c = &q->constraint[k];
        if (!(c->force > 0) || !isfinite(c->force) || p->push[k].a == SIZE_MAX) continue;
        if (!sunder_i_reserve(&r->push, &r->capacity, r->n + 1, sizeof *r->push)) return false;
        r->push[r->n++] = (sunder_push){p->push[k].a, p->push[k].b, c->force, {c->n[0], c->n[1]}};
    }
    return true;
}

static bool press_group(pressing *p, const sunder_i_group *g)
{
    const sunder_i_model *model = &p->solver->model;
    double *mass = sunder_i_alloc(g->n, sizeof *mass), *t = sunder_i_calloc(2 * g->n, sizeof *t),
           *preferred = sunder_i_calloc(2 * g->n, sizeof *preferred), size = 0;
    bool ok = mass && t && preferred;
    p->group = g;
    p->program.bodies = g->n;
    p->program.mass = mass;
    p->program.preferred = model->preferred ? preferred : NULL;
    p->program.t = t;
    p->program.n = 0;
    p->program.work = 0;
    for (size_t i = 0; i < g->n && ok; i++) {
        const sunder_i_body *body = &model->body[g->body[i]];
        const double *move = model->move + 2 * (size_t)g->body[i];
        mass[i] = body->fixed ? 0 : 0.5 / body->weight;
        size = sunder_i_max(size, hypot(move[0], move[1]));
        if (!body->fixed) memcpy(preferred + 2 * i, sunder_i_preferred(model, g->body[i]), 2 * sizeof *preferred);
        ok = add_pairs_of(p, i) && add_limit(p, i);
    }
    if (ok && p->program.n && size > 0)
        ok = sunder_i_quadratic_solve(&p->program, 0, PRESSED * size, size) >= 0 && list_forces(p);
    sunder_i_free_all(mass, t, preferred);
    return ok;
}

typedef struct pressing_batches {
    const sunder_i_solver *solver;
    size_t first;        /* the index of the first group of the first task */
    found_pushes *found; /* [BATCHES_AT_ONCE] the pushes that each task finds */
} pressing_batches;

static sunder_status press_batches(void *context, size_t begin, size_t end, sunder_error *err)
{
    const pressing_batches *all = context;
    const sunder_i_groups *groups = &all->solver->groups;
    pressing p = {.solver = all->solver, .waived = {.pair = groups->waived, .n = groups->waived_n}};
    bool ok = true;
    for (size_t batch = begin; batch < end; batch++) {
        const size_t first = all->first + batch * GROUPS_OF_A_BATCH;
        p.found = &all->found[batch];
        for (size_t k = first; k < first + GROUPS_OF_A_BATCH && k < groups->n && ok; k++)
            ok = press_group(&p, &groups->group[k]);
    }
    sunder_i_free_all(p.program.constraint, p.push, p.near.item, p.touch.item);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

static bool append_pushes(sunder_report *report, size_t *capacity, const found_pushes *found)
{
    if (found->n == 0) return true;
    if (!sunder_i_reserve(&report->push, capacity, report->pushes + found->n, sizeof *found->push)) return false;
    memcpy(report->push + report->pushes, found->push, found->n * sizeof *found->push);
    report->pushes += found->n;
    return true;
}

sunder_status sunder_i_report_pushes(sunder_report *report, sunder_i_solver *solver, sunder_error *err)
{
    if (!solver->model.rules.keep_pushes) return SUNDER_OK;
    /* If no proofs were made, the waived pairs have not been determined yet. */
    const sunder_status status = solver->groups.waived ? SUNDER_OK : sunder_i_solver_list_waivers(solver, err);
    if (status) return status;
    found_pushes found[BATCHES_AT_ONCE];
    size_t capacity = 0;
    sunder_status pressed = SUNDER_OK;
    for (size_t first = 0; first < solver->groups.n && !pressed; first += BATCHES_AT_ONCE * GROUPS_OF_A_BATCH) {
        pressing_batches all = {solver, first, found};
        memset(found, 0, sizeof found);
        pressed = sunder_i_parallel(solver->model.rules.threads, BATCHES_AT_ONCE, SUNDER_I_GRAIN_WHOLE, press_batches,
                                    &all, err);
        for (size_t k = 0; k < BATCHES_AT_ONCE; k++) {
            if (!pressed && !append_pushes(report, &capacity, &found[k])) pressed = sunder_i_failure_cause(err);
            sunder_i_free(found[k].push);
        }
        sunder_i_pieces_forget(&solver->model, SUNDER_I_PIECES_HELD);
    }
    return pressed;
}
