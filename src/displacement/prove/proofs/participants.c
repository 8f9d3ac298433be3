/* The participants of a branch and bound, and the distances that they have to keep from each other. */
#include "displacement/layer/reads.h"
#include "displacement/layer/resolution.h"
#include "displacement/prove/proofs/branching.h"

#include "base/extremes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Raises the lengths that decide what is small: a hair is at least 2^-40 of the longest limit, and at least 2^-47 of
 * the size of the coordinates plus the gap, which exceeds the rounding errors of positions (half_planes.c). */
static void set_scale(sunder_i_branching *c, const sunder_i_body *b, double limit)
{
    const sunder_i_body *first = &c->model->body[c->subproblem->body[0]];
    double size = 0;
    for (size_t x = 0; x < 4; x++) size += fabs(b->box[x]) + fabs(b->origin[x & 1] - first->origin[x & 1]);
    c->longest = sunder_i_max(c->longest, limit);
    c->hair = sunder_i_max(c->hair, sunder_i_max(c->longest * 0x1p-40, (size + c->model->rules.gap) * 0x1p-47));
}

uint32_t sunder_i_branching_place(const sunder_i_branching *branching, uint32_t body)
{
    for (uint32_t k = 0; k < branching->bodies; k++)
        if (branching->body[k] == body) return k;
    return SUNDER_I_GROUND;
}

/* Adds a participant, and returns its place. */
static uint32_t add_participant(sunder_i_branching *c, uint32_t body, double limit)
{
    const size_t n = c->bodies + 1;
    if (!sunder_i_reserve(&c->body, &c->body_capacity, n, sizeof *c->body) ||
        !sunder_i_reserve(&c->limit, &c->limit_capacity, n, sizeof *c->limit) ||
        !sunder_i_reserve(&c->weight, &c->weight_capacity, n, sizeof *c->weight) ||
        !sunder_i_reserve(&c->t, &c->t_capacity, 2 * n, sizeof *c->t) ||
        !sunder_i_reserve(&c->shift, &c->shift_capacity, 2 * n, sizeof *c->shift) ||
        !sunder_i_reserve(&c->net, &c->net_capacity, 2 * n, sizeof *c->net)) {
        c->failed = true;
        return 0;
    }
    const uint32_t at = (uint32_t)c->bodies++;
    c->body[at] = body;
    c->limit[at] = limit;
    c->t[2 * at] = c->t[2 * at + 1] = c->shift[2 * at] = c->shift[2 * at + 1] = 0;
    return at;
}

uint32_t sunder_i_branching_join(sunder_i_branching *branching, uint32_t body)
{
    const uint32_t known = sunder_i_branching_place(branching, body);
    const double limit = sunder_i_branching_limit(branching, &branching->model->body[body]);
    if (known != SUNDER_I_GROUND) return known;
    set_scale(branching, &branching->model->body[body], limit);
    return limit > 0 ? add_participant(branching, body, limit) : SUNDER_I_GROUND;
}

static bool is_overlap(const sunder_i_model *model, const sunder_i_requirement *r)
{
    return r->clearance < 0 && r->clearance > -INFINITY && sunder_i_is_barrier(model, r->b);
}

bool sunder_i_may_have_slack(const sunder_i_subproblem *subproblem)
{
    for (size_t k = 0; k < subproblem->required_n; k++)
        if (is_overlap(subproblem->model, &subproblem->required[k])) return true;
    return false;
}

uint32_t sunder_i_branching_slack(const sunder_i_branching *branching, const sunder_i_requirement *required)
{
    for (size_t k = 0; k < branching->slacks; k++)
        if (branching->slack[k].required == required) return branching->slack[k].place;
    return SUNDER_I_GROUND;
}

uint32_t sunder_i_branching_join_slack(sunder_i_branching *branching, const sunder_i_requirement *required)
{
    const uint32_t known = sunder_i_branching_slack(branching, required);
    if (known != SUNDER_I_GROUND) return known;
    if (!sunder_i_reserve(&branching->slack, &branching->slack_capacity, branching->slacks + 1,
                          sizeof *branching->slack)) {
        branching->failed = true;
        return 0;
    }
    branching->longest = sunder_i_max(branching->longest, -required->clearance);
    branching->hair = sunder_i_max(branching->hair, branching->longest * 0x1p-40);
    const uint32_t place = add_participant(branching, SUNDER_I_NOBODY, -required->clearance);
    if (branching->failed) return 0;
    branching->slack[branching->slacks++] = (sunder_i_slack){required, place};
    sunder_i_branching_begin(branching, place);
    return place;
}

void sunder_i_branching_begin(sunder_i_branching *branching, size_t first)
{
    memset(branching->t + 2 * first, 0, 2 * (branching->bodies - first) * sizeof *branching->t);
    for (size_t k = 0; k < branching->slacks; k++)
        if (branching->slack[k].place >= first)
            memcpy(branching->t + 2 * (size_t)branching->slack[k].place, branching->slack[k].required->shift,
                   2 * sizeof *branching->t);
}

/* Could bodies p and q, moved within their limits, come nearer to each other than the gap? Decided by their boxes. */
static bool is_in_reach(const sunder_i_model *model, const sunder_i_body *p, const sunder_i_body *q)
{
    const double reach = (p->fixed ? 0 : p->limit) + (q->fixed ? 0 : q->limit) + model->rules.gap;
    double box[4];
    for (uint32_t x = 0; x < 4; x++)
        box[x] = p->box[x] + (p->origin[x & 1] - q->origin[x & 1]) + (x < 2 ? -reach : reach);
    return p->pieces && q->pieces && sunder_i_box_meet(box, q->box);
}

/* Appends the bodies of the reserve that could meet body `of` to c->near. Returns false if memory is out. */
static bool find_in_reach(sunder_i_branching *c, uint32_t of)
{
    const sunder_i_model *model = c->model;
    const sunder_i_subproblem *q = c->subproblem;
    const sunder_i_body *p = &model->body[of];
    const double reach = (p->fixed ? 0 : p->limit) + q->farthest + model->rules.gap;
    double box[4];
    const size_t before = c->near.n;
    size_t out = before;
    for (uint32_t x = 0; x < 4; x++) box[x] = p->box[x] + p->origin[x & 1];
    sunder_i_box_grow(box, reach, box);
    if (!sunder_i_look_about(model, &model->tree, box, &c->near)) return false;
    c->looked += c->near.n - before;
    for (size_t k = before; k < c->near.n; k++) {
        const uint32_t b = model->body_of[c->near.item[k]];
        const sunder_i_body *r = &model->body[b];
        if (!r->fixed && isfinite(r->limit) && sunder_i_set_has(q->reserve, q->reserves, b) && is_in_reach(model, p, r))
            c->near.item[out++] = b;
    }
    c->near.n = out;
    return true;
}

bool sunder_i_branching_widen(sunder_i_branching *branching)
{
    const size_t before = branching->bodies;
    branching->near.n = 0;
    for (size_t i = 0; i < before && branching->subproblem->reserves && !branching->failed; i++)
        if (branching->body[i] != SUNDER_I_NOBODY && !find_in_reach(branching, branching->body[i]))
            branching->failed = true;
    branching->near.n = sunder_i_set_make(branching->near.item, branching->near.n);
    for (size_t k = 0; k < branching->near.n && !branching->failed; k++)
        sunder_i_branching_join(branching, branching->near.item[k]);
    return branching->bodies > before;
}

static bool is_heeded(const sunder_i_branching *c, uint32_t f)
{
    const sunder_i_subproblem *q = c->subproblem;
    return !q->feature || sunder_i_set_has(q->feature, q->features, sunder_i_whole_of(c->model, f));
}

/* Do the things f and g belong to two bodies, at least one of which can move, and do both have a limit (or a
 * substitute, subproblem->instead)? *reach is the sum of the two limits. */
static bool can_move(const sunder_i_branching *c, uint32_t f, uint32_t g, double *reach)
{
    const sunder_i_model *model = c->model;
    const sunder_i_body *p = &model->body[model->body_of[f]], *r = &model->body[model->body_of[g]];
    *reach = sunder_i_branching_limit(c, p) + sunder_i_branching_limit(c, r);
    return p != r && *reach > 0 && isfinite(*reach);
}

bool sunder_i_branching_is_path_heeded(const sunder_i_branching *branching, uint32_t f)
{
    const sunder_i_subproblem *q = branching->subproblem;
    for (size_t k = 0; k < q->bodies && q->heed_paths; k++)
        if (q->body[k] == branching->model->body_of[f]) return true;
    return is_heeded(branching, f);
}

bool sunder_i_branching_shades(const sunder_i_branching *branching, uint32_t f, uint32_t g)
{
    const bool side = sunder_i_is_barrier(branching->model, g);
    double reach;
    return can_move(branching, f, g, &reach) && sunder_i_branching_is_path_heeded(branching, f) &&
           ((side && branching->subproblem->every_side) || sunder_i_branching_is_path_heeded(branching, g)) &&
           (side || !sunder_i_may_pass(branching->model, f, g));
}

double sunder_i_branching_owed(const sunder_i_subproblem *subproblem, uint32_t f, uint32_t g)
{
    const double owed = sunder_i_owed_below(subproblem->model, f, g), less = subproblem->less;
    if (!(less > 0) || !sunder_i_owe_gap(subproblem->model, f, g)) return owed;
    /* The gap that remains is demanded of pairs whose own gap is greater. */
    const double spare = subproblem->model->rules.gap - sunder_i_gap_of(subproblem->model, f, g);
    return sunder_i_max(owed - sunder_i_max(less - spare, 0), 0);
}

bool sunder_i_branching_owe(const sunder_i_branching *branching, uint32_t f, uint32_t g, double *clearance)
{
    const sunder_i_model *model = branching->model;
    const sunder_i_subproblem *q = branching->subproblem;
    const uint32_t whole[2] = {sunder_i_whole_of(model, f), sunder_i_whole_of(model, g)};
    double reach;
    if (!can_move(branching, f, g, &reach) || !is_heeded(branching, f) || !is_heeded(branching, g)) return false;
    if (!sunder_i_is_barrier(model, f > g ? f : g) &&
        sunder_i_may_get_inside(&model->rules, sunder_i_home_box(model, f), sunder_i_home_box(model, g),
                                nextafter(reach, INFINITY)))
        return false;
    *clearance = sunder_i_branching_owed(q, f, g) + q->margin;
    const sunder_i_requirement key = {.a = whole[f > g], .b = whole[f < g]};
    const bool is_asked = key.a == q->a && key.b == q->b;
    const sunder_i_requirement *required =
        is_asked || !q->required_n ? NULL : bsearch(&key, q->required, q->required_n, sizeof key, sunder_i_by_id_pair);
    const double held = required ? required->clearance + q->held_margin : INFINITY;
    if (required) *clearance = q->less > 0 ? sunder_i_min(*clearance, held) : held;
    return *clearance > -INFINITY;
}
