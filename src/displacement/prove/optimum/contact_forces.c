/* The forces on the contacts of a layout: those that hold every body in its place.
 *
 * Each contact of two bodies is a half-plane of their relative move, tangent to the forbidden set at the present
 * relative move. A body at its limit is in contact with the ground. A spring between neighbours in a row is two
 * contacts that give. For a locally optimal layout, the least cost under these half-planes is the layout's own cost,
 * and the forces (multipliers) of that program show which contacts matter. All of this is in doubles: bounds made from
 * the forces (blocks.c) are proved separately. */
#include "displacement/prove/optimum/blocks.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/watch.h"

#include <math.h>
#include <string.h>

static bool add_contacts(sunder_i_contact_forces *c, const sunder_i_move_cut *cut, size_t n)
{
    if (!sunder_i_reserve(&c->cut, &c->capacity, c->n + n, sizeof *c->cut)) return false;
    for (size_t k = 0; k < n; k++) c->cut[c->n++] = cut[k];
    return true;
}

static bool add_contact(sunder_i_contact_forces *c, uint32_t i, uint32_t j, const double n[2], double d)
{
    const sunder_i_move_cut cut = {.i = i, .j = j, .n = {n[0], n[1]}, .d = d};
    return add_contacts(c, &cut, 1);
}

static bool add_springs(sunder_i_contact_forces *c, const sunder_i_group *g, uint32_t i, uint32_t j)
{
    sunder_i_move_cut cut[4];
    return add_contacts(c, cut, sunder_i_spring_cuts(c->model, g->body[i], g->body[j], i, j, cut));
}

static bool add_contacts_of_pair(sunder_i_contact_forces *c, const sunder_i_group *g, uint32_t i, uint32_t j)
{
    const sunder_i_body *body = c->model->body;
    const double hair = sunder_i_contact_hair(c->model, &body[g->body[i]], &body[g->body[j]]) + 2 * g->margin;
    size_t edges = 0;
    bool ok = sunder_i_contacts_of_pair(c->model, c->waived, g->body[i], g->body[j], g->move + 2 * (size_t)i,
                                        g->move + 2 * (size_t)j, hair, &c->touch, &edges);
    c->steps += 16 + 8 * edges;
    for (size_t k = 0; k < c->touch.n && ok; k++) ok = add_contact(c, i, j, c->touch.item[k].n, c->touch.item[k].d);
    return ok;
}

/* May the bodies at places i and j of the group be in contact? Decided by their boxes, which include their paths if
 * paths are restricted. */
static bool are_near(const sunder_i_contact_forces *c, const sunder_i_group *g, uint32_t i, uint32_t j)
{
    const sunder_i_model *model = c->model;
    const double home[2] = {0, 0};
    double p[4], q[4], start[4];
    if (sunder_i_row_side_of(model, &model->body[g->body[i]], g->body[j])) return true;
    sunder_i_body_box(&model->body[g->body[i]], g->move + 2 * (size_t)i, model->rules.gap * (1 + 0x1p-20), p);
    sunder_i_body_box(&model->body[g->body[j]], g->move + 2 * (size_t)j, 0, q);
    if (sunder_i_forbids_paths(model)) {
        sunder_i_body_box(&model->body[g->body[i]], home, 0, start);
        sunder_i_box_join(p, start);
        sunder_i_body_box(&model->body[g->body[j]], home, 0, start);
        sunder_i_box_join(q, start);
    }
    return sunder_i_box_meet(p, q);
}

static bool find_contacts(sunder_i_contact_forces *c, const sunder_i_group *g)
{
    for (uint32_t i = 0; i < g->n; i++) {
        const sunder_i_body *p = &c->model->body[g->body[i]];
        const double *t = g->move + 2 * (size_t)i, length = hypot(t[0], t[1]), limit = sunder_i_limit_of(p);
        if (!p->fixed && length > 0 && length >= limit * (1 - 0x1p-30)) {
            const double n[2] = {t[0] / length, t[1] / length};
            if (!add_contact(c, i, SUNDER_I_GROUND, n, -limit)) return false;
        }
        for (uint32_t j = i + 1; j < g->n; j++) {
            if (p->fixed && c->model->body[g->body[j]].fixed) continue;
            if (are_near(c, g, i, j) && !(add_contacts_of_pair(c, g, i, j) && add_springs(c, g, i, j))) return false;
        }
        c->steps += g->n / 4;
        if (!sunder_i_steps(1 + g->n / 64)) return false;
    }
    return true;
}

/* Adds the violated contacts to the program, the most violated first, until none is violated. Returns false if memory
 * is out or stopped on request. */
static bool solve_forces(sunder_i_contact_forces *c, const sunder_i_group *g)
{
    sunder_i_dual_program *p = &c->program;
    for (size_t round = 0; round < 4 * c->n + 64; round++) {
        uint32_t worst = UINT32_MAX;
        double most = CONTACT_MISSED * sqrt(g->cost);
        for (uint32_t k = 0; k < c->n; k++) {
            const double missing = sunder_i_dual_missing(p, &c->cut[k]);
            if (missing <= most || (c->cut[k].give > 0 && sunder_i_dual_is_acting(p, k))) continue;
            most = missing;
            worst = k;
        }
        if (worst == UINT32_MAX) break;
        bool failed;
        const sunder_i_dual_outcome outcome = sunder_i_dual_add(p, worst, 4 * g->cost, &failed);
        c->steps += p->steps + c->n;
        p->steps = 0;
        if (failed || !sunder_i_steps(1 + (p->acting_n + c->n) / 16)) return false;
        if (outcome != SUNDER_I_DUAL_SOLVED) break;
    }
    return true;
}

bool sunder_i_contact_forces_find(sunder_i_contact_forces *contacts, const sunder_i_model *model,
                                  const sunder_i_waived *waived, const sunder_i_group *group, const double *weight,
                                  const double *mass, const double *anchor)
{
    memset(contacts, 0, sizeof *contacts);
    contacts->model = model;
    contacts->waived = waived;
    if (!sunder_i_dual_init(&contacts->program, group->n, 0) || !find_contacts(contacts, group)) return false;
    contacts->program.weight = weight;
    contacts->program.mass = mass;
    contacts->program.anchor = anchor;
    contacts->program.cut = contacts->cut;
    if (!sunder_i_dual_load(&contacts->program, NULL, 0) || !solve_forces(contacts, group)) return false;
    contacts->force = sunder_i_calloc(contacts->n, sizeof *contacts->force);
    if (!contacts->force) return false;
    for (size_t k = 0; k < contacts->program.acting_n; k++)
        contacts->force[contacts->program.acting[k].cut] = contacts->program.acting[k].force;
    return true;
}

void sunder_i_contact_forces_free(sunder_i_contact_forces *contacts)
{
    sunder_i_free_all(contacts->cut, contacts->force, contacts->touch.item);
    sunder_i_dual_free(&contacts->program);
    memset(contacts, 0, sizeof *contacts);
}
