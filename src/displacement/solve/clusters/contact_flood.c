/* Components of contact: starting from bodies that moved, or are in conflict, everything connected to them by contacts.
 *
 * Contacts are found for some thousand bodies at a time, on all threads, and joined when all have been found, in the
 * order of the bodies. So the result does not depend on threads; of two neighbours one looks for the contact. */
#include "displacement/solve/clusters/contact_flood.h"
#include "displacement/layer/reads.h"
#include "displacement/layer/resolution.h"
#include "displacement/prove/optimum/body_contact.h"
#include "displacement/solve/clusters/tuning.h"

#include "base/parallel.h"
#include "base/union_find.h"
#include "base/watch.h"

#include <math.h>
#include <string.h>

/* Contacts are found for this many bodies at a time, on all threads, before the results are joined. */
enum { BODIES_OF_A_BATCH = 64, BATCHES_AT_ONCE = 64 };

typedef enum standing { ELSEWHERE, WAITS, IN_TURN, LOOKED_AT } standing;

typedef struct contacts {
    sunder_i_id_pair *pair; /* [n] a body whose contacts were looked for, and a body in contact with it */
    size_t n, capacity;
} contacts;

typedef struct flooding {
    sunder_i_solver *solver;
    const sunder_i_model *model; /* whose distances decide on contact */
    sunder_i_flood *out;
    unsigned char *standing; /* [bodies] standing */
    size_t turn;             /* index in the queue of the first body of the current batches */
    contacts batch[BATCHES_AT_ONCE];
} flooding;

static bool is_fixed(const flooding *f, uint32_t body) { return f->solver->model.body[body].fixed; }

static bool enqueue_body(flooding *f, uint32_t body)
{
    if (f->standing[body] != ELSEWHERE || is_fixed(f, body)) return true;
    f->standing[body] = WAITS;
    return sunder_i_list_push(&f->out->body, body);
}

/* Puts into the queue the movable bodies that stand at other places than they prefer, or are in conflict. */
static bool enqueue_starting_bodies(flooding *f)
{
    const sunder_i_solver *s = f->solver;
    bool ok = true;
    for (uint32_t b = 0; b < s->model.bodies && ok; b++)
        if (sunder_i_is_astray(&s->model, b, s->model.move + 2 * (size_t)b)) ok = enqueue_body(f, b);
    for (size_t k = 0; k < s->now.n && ok; k++) {
        const sunder_i_relation *r = &s->now.pair[k];
        if (sunder_i_is_conflict_of_bodies(&s->model, r))
            ok = enqueue_body(f, s->model.body_of[r->a]) && enqueue_body(f, s->model.body_of[r->b]);
    }
    return ok;
}

/* Does b look for its contact with `other`? Of two bodies in the queue the earlier does, and within the current batches
 * the one with the smaller number. */
static bool looks_for_contact(const flooding *f, uint32_t b, uint32_t other)
{
    return other != b && f->standing[other] != LOOKED_AT && (f->standing[other] != IN_TURN || b < other);
}

/* Stores the bodies near body b in `near`. */
static bool find_near_bodies(const flooding *f, uint32_t b, sunder_i_list *near)
{
    const sunder_i_model *model = f->model;
    const sunder_i_body *body = &model->body[b];
    double box[4];
    near->n = 0;
    if (body->pieces == 0) return true;
    const double reach = model->rules.gap + sunder_i_contact_hair(model, body, body);
    sunder_i_body_box(body, model->move + 2 * (size_t)b, reach, box);
    sunder_i_reading reading;
    sunder_i_reads_begin(&reading, model, b);
    const bool ok = sunder_i_look_about(model, model->standing, box, near);
    sunder_i_reads_end(&reading);
    if (!ok) near->n = 0;
    sunder_i_things_to_bodies(model, near);
    return ok && sunder_i_add_row_neighbours(model, b, near);
}

static bool add_contact(contacts *out, uint32_t b, uint32_t other)
{
    if (!sunder_i_reserve(&out->pair, &out->capacity, out->n + 1, sizeof *out->pair)) return false;
    out->pair[out->n++] = (sunder_i_id_pair){b, other};
    return true;
}

/* Adds the neighbours in rows whose springs to b act: they are stretched. */
static bool find_springs(const flooding *f, uint32_t b, contacts *out)
{
    const sunder_i_model *model = f->model;
    const sunder_i_extras *has = model->body[b].has;
    const double *t = model->move + 2 * (size_t)b, *stiffness = model->rules.row_stiffness;
    if (!(stiffness[0] + stiffness[1] > 0)) return true;
    for (uint32_t k = has->row_side; k < has->row_side + has->row_sides; k++) {
        const uint32_t other = model->row_side[k].other;
        const double *s = model->move + 2 * (size_t)other, *rest = model->row_side[k].rest;
        if (hypot(s[0] - t[0] - rest[0], s[1] - t[1] - rest[1]) > SLACK_SPRING * model->rules.gap &&
            looks_for_contact(f, b, other) && !add_contact(out, b, other))
            return false;
    }
    return true;
}

static bool find_contacts(const flooding *f, uint32_t b, sunder_i_list *near, contacts *out)
{
    const sunder_i_model *model = f->model;
    if (!find_springs(f, b, out) || !find_near_bodies(f, b, near)) return false;
    for (size_t k = 0; k < near->n; k++) {
        const uint32_t other = near->item[k];
        bool contact = false;
        if (!looks_for_contact(f, b, other)) continue;
        if (!sunder_i_are_in_contact(model, b, other, model->move + 2 * (size_t)b, model->move + 2 * (size_t)other,
                                     &contact))
            return false;
        if (contact && !add_contact(out, b, other)) return false;
    }
    return true;
}

static sunder_status find_contacts_of_batches(void *context, size_t begin, size_t end, sunder_error *err)
{
    flooding *f = context;
    sunder_i_list near = {0};
    bool ok = true;
    for (size_t batch = begin; batch < end && ok; batch++) {
        const size_t first = f->turn + batch * BODIES_OF_A_BATCH;
        f->batch[batch].n = 0;
        for (size_t k = first; k < first + BODIES_OF_A_BATCH && k < f->out->body.n && ok; k++)
            ok = sunder_i_step() && find_contacts(f, f->out->body.item[k], &near, &f->batch[batch]);
    }
    sunder_i_free(near.item);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

/* Joins two bodies in contact. A fixed body connects nothing, and is listed with each body that touches it. */
static bool join_contact(flooding *f, const sunder_i_id_pair *pair)
{
    if (is_fixed(f, pair->b)) {
        if (!sunder_i_reserve(&f->out->touch, &f->out->touch_capacity, f->out->touches + 1, sizeof *f->out->touch))
            return false;
        f->out->touch[f->out->touches++] = *pair;
        return true;
    }
    sunder_i_union_join(f->out->parent, pair->a, pair->b);
    return enqueue_body(f, pair->b);
}

/* Handles the next bodies of the queue, at most BATCHES_AT_ONCE batches of them. */
static sunder_status process_batches(flooding *f, sunder_error *err)
{
    const size_t all = (size_t)BODIES_OF_A_BATCH * BATCHES_AT_ONCE, left = f->out->body.n - f->turn;
    const size_t n = left < all ? left : all, batches = (n + BODIES_OF_A_BATCH - 1) / BODIES_OF_A_BATCH;
    for (size_t k = 0; k < n; k++) f->standing[f->out->body.item[f->turn + k]] = IN_TURN;
    const sunder_status status = sunder_i_parallel(f->solver->model.rules.threads, batches, SUNDER_I_GRAIN_WHOLE,
                                                   find_contacts_of_batches, f, err);
    if (status) return status;
    for (size_t k = 0; k < n; k++) f->standing[f->out->body.item[f->turn + k]] = LOOKED_AT;
    f->turn += n;
    for (size_t batch = 0; batch < batches; batch++)
        for (size_t k = 0; k < f->batch[batch].n; k++)
            if (!join_contact(f, &f->batch[batch].pair[k])) return sunder_i_failure_cause(err);
    sunder_i_pieces_forget(&f->solver->model, SUNDER_I_PIECES_HELD);
    return SUNDER_OK;
}

static sunder_status flood_from_queue(flooding *f, sunder_error *err)
{
    const sunder_i_groups *groups = &f->solver->groups;
    sunder_i_union_init(f->out->parent, f->solver->model.bodies);
    if (!enqueue_starting_bodies(f)) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < groups->joins; k++) {
        const sunder_i_id_pair *joined = &groups->joined[k];
        sunder_i_union_join(f->out->parent, joined->a, joined->b);
        if (!enqueue_body(f, joined->a) || !enqueue_body(f, joined->b)) return sunder_i_failure_cause(err);
    }
    sunder_status status = SUNDER_OK;
    while (f->turn < f->out->body.n && !status) status = process_batches(f, err);
    return status;
}

sunder_status sunder_i_flood_contacts(sunder_i_solver *solver, sunder_i_flood *out, sunder_error *err)
{
    sunder_i_barriers barriers;
    const sunder_i_model full = sunder_i_with_full_gap(&solver->model, &barriers);
    flooding f = {.solver = solver,
                  .model = solver->eased ? &full : &solver->model,
                  .out = out,
                  .standing = sunder_i_calloc(solver->model.bodies, sizeof *f.standing)};
    *out = (sunder_i_flood){.parent = sunder_i_alloc(solver->model.bodies, sizeof *out->parent)};
    const sunder_status status = f.standing && out->parent ? flood_from_queue(&f, err) : sunder_i_failure_cause(err);
    for (size_t k = 0; k < BATCHES_AT_ONCE; k++) sunder_i_free(f.batch[k].pair);
    sunder_i_free(f.standing);
    return status;
}

void sunder_i_flood_free(sunder_i_flood *flood)
{
    sunder_i_free_all(flood->parent, flood->body.item, flood->touch);
    memset(flood, 0, sizeof *flood);
}
