/* Determines the worlds of a layer: its parts that did not influence each other (influence.c). If the layer had
 * contained only the bodies of a world and the fixed features near them, every question would have had the same answer,
 * and each body would end where it does: a part of the layer that holds everything that meets the boxes of a world
 * gives the same result for that world as the whole layer. */
#include "displacement/layer/resolution.h"
#include "displacement/report/influence.h"

#include "base/union_find.h"

#include <stdlib.h>
#include <string.h>

typedef struct gathering {
    const sunder_i_solver *solver;
    const sunder_i_model *model;
    const sunder_i_influence *by;
} gathering;

/* ---- What is reported -------------------------------------------------------------------------------------------- */

/* Numbers the worlds in the order of their first features, and sets world_of of each feature. */
static sunder_status number_worlds(sunder_report *report, const gathering *g, uint32_t *world, sunder_error *err)
{
    const sunder_i_model *model = g->model;
    const uint32_t *number = g->solver->layer.number;
    size_t *named = sunder_i_alloc(model->bodies, sizeof *named),
           *thing = sunder_i_alloc(model->features, sizeof *thing);
    report->world_of = sunder_i_alloc(model->features, sizeof *report->world_of);
    sunder_status status = named && thing && report->world_of ? SUNDER_OK : sunder_i_failure_cause(err);
    for (size_t b = 0; b < model->bodies && !status; b++) named[b] = SIZE_MAX;
    for (size_t f = 0; f < model->features && !status; f++) thing[number[f]] = f;
    for (size_t k = 0; k < model->features && !status; k++) {
        const uint32_t body = model->body_of[thing[k]];
        report->world_of[k] = SIZE_MAX;
        if (!g->by->active[body]) continue;
        size_t *name = &named[sunder_i_union_find(world, body)];
        if (*name == SIZE_MAX) {
            if (!sunder_i_reserve(&report->world, &report->world_room, report->worlds + 1, sizeof *report->world)) {
                status = sunder_i_failure_cause(err);
                break;
            }
            report->world[ *name = report->worlds++] = (sunder_world){.first = k};
        }
        report->world_of[k] = *name;
    }
    sunder_i_free_all(named, thing);
    return status;
}

static size_t world_of_body(const sunder_report *report, const gathering *g, uint32_t body)
{
    const sunder_i_body *b = &g->model->body[body];
    if (sunder_i_is_barrier_body(g->model, b)) return SIZE_MAX;
    return report->world_of[g->solver->layer.number[g->model->member[b->member]]];
}

/* Returns the world of a pair of the model's numbers, or SIZE_MAX if both are in a block that influenced nothing. */
static size_t world_of_pair(const sunder_report *report, const gathering *g, uint32_t a, uint32_t b)
{
    const size_t n = g->model->features;
    const uint32_t *number = g->solver->layer.number;
    return sunder_report_world_of_pair(report, number[a], b < n ? number[b] : n);
}

static int by_world(const void *a, const void *b)
{
    const sunder_footprint *p = a, *q = b;
    if (p->world != q->world) return p->world < q->world ? -1 : 1;
    return memcmp(p->read, q->read, sizeof p->read);
}

static bool is_root(const gathering *g, uint32_t b) { return g->by->active[b] && g->by->root[b] == b; }

static sunder_status list_footprints(sunder_report *report, const gathering *g, sunder_error *err)
{
    size_t n = 0;
    for (uint32_t b = 0; b < g->model->bodies; b++) n += is_root(g, b);
    report->footprint = sunder_i_alloc(n, sizeof *report->footprint);
    if (!report->footprint) return sunder_i_failure_cause(err);
    for (uint32_t b = 0; b < g->model->bodies; b++) {
        if (!is_root(g, b)) continue;
        sunder_footprint *p = &report->footprint[report->footprints++];
        p->world = world_of_body(report, g, b);
        memcpy(p->read, g->by->read[b], sizeof p->read);
        memcpy(p->wrote, g->by->wrote[b], sizeof p->wrote);
        /* Whether a block ends here depends on what is next to it, so the box is grown. */
        sunder_i_box_grow(g->by->seen[b], sunder_i_contact_reach(&g->model->rules), p->seen);
        sunder_i_box_join(p->seen, p->read);
    }
    if (n) qsort(report->footprint, n, sizeof *report->footprint, by_world);
    for (size_t k = n; k-- > 0;) {
        sunder_world *w = &report->world[report->footprint[k].world];
        w->footprint = k;
        w->footprints++;
    }
    return SUNDER_OK;
}

/* Counts a conflict of the layer as given in its world. One inside a block without a world is counted with the first of
 * its two features. */
static void count_home_pair(sunder_report *report, const gathering *g, const sunder_i_home_pair *pair)
{
    const sunder_conflict c = {.kind = pair->kind, .inside_block = pair->inside};
    const size_t w = world_of_pair(report, g, pair->a, pair->b), p = g->solver->layer.number[pair->a],
                 q = g->solver->layer.number[pair->b];
    if (pair->fact == SUNDER_I_HOME_THIN)
        report->world[w].thin++;
    else if (pair->fact == SUNDER_I_HOME_CONFLICT && w != SIZE_MAX)
        sunder_i_count(&report->world[w].before, &c);
    else if (pair->fact == SUNDER_I_HOME_CONFLICT)
        report->inside[p < q ? p : q]++;
}

/* Counts each conflict in its world. */
static sunder_status count_pairs(sunder_report *report, const gathering *g, sunder_error *err)
{
    const sunder_i_relations *now = &g->solver->now;
    report->inside = sunder_i_calloc(g->model->features, sizeof *report->inside);
    if (!report->inside) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < report->home_pairs; k++) count_home_pair(report, g, &report->home_pair[k]);
    for (size_t k = 0; k < now->n;) {
        sunder_conflict c;
        uint32_t a, b;
        if (!sunder_i_next_conflict(g->model, now, &k, &a, &b, &c)) continue;
        const size_t w = world_of_pair(report, g, a, b);
        if (w != SIZE_MAX) sunder_i_count(&report->world[w].after, &c);
    }
    return SUNDER_OK;
}

/* Returns what is proved of the part whose root is `body`, and what the body pays. */
static sunder_world_bound bound_of(const sunder_report *report, uint32_t body)
{
    sunder_world_bound bound = {0};
    if (report->proved) bound.proved = report->proved[body];
    if (report->proved) bound.by_pairs = (report->by_pairs ? report->by_pairs : report->proved)[body];
    if (!report->paying) return bound;
    const sunder_i_paying *paying = &report->paying[body];
    bound.short_pairs = paying->pairs;
    bound.shortfall = paying->missing;
    bound.cost_shortfall = paying->pays;
    bound.cost_alone = paying->alone;
    return bound;
}

static bool is_any(sunder_world_bound bound) { return bound.proved > 0 || bound.by_pairs > 0 || bound.short_pairs; }

/* Counts the contact groups of each world, and lists what is proved of its parts. */
static sunder_status count_proved(sunder_report *report, const gathering *g, sunder_error *err)
{
    const sunder_i_groups *groups = &g->solver->groups;
    for (size_t k = 0; k < groups->n; k++) {
        sunder_world *w = &report->world[world_of_body(report, g, groups->group[k].number)];
        w->clusters++;
        w->clusters_optimal += g->model->rules.effort > 0 && sunder_i_group_is_optimal(&groups->group[k]);
    }
    for (uint32_t b = 0; b < g->model->bodies; b++)
        if (is_any(bound_of(report, b))) report->world[world_of_body(report, g, b)].bounds++;
    for (size_t k = 0; k < report->worlds; k++) {
        report->world[k].bound = report->world_bounds;
        report->world_bounds += report->world[k].bounds;
        report->world[k].bounds = 0;
    }
    report->world_bound = sunder_i_alloc(report->world_bounds, sizeof *report->world_bound);
    if (!report->world_bound) return sunder_i_failure_cause(err);
    for (uint32_t b = 0; b < g->model->bodies; b++) {
        if (!is_any(bound_of(report, b))) continue;
        sunder_world *w = &report->world[world_of_body(report, g, b)];
        report->world_bound[w->bound + w->bounds++] = bound_of(report, b);
    }
    return SUNDER_OK;
}

/* Stores for each feature, in the caller's numbers, whether its coordinates were rounded, whether it is fixed, and what
 * decides on its neighbours in rows. */
static sunder_status keep_each(sunder_report *report, const gathering *g, sunder_error *err)
{
    const sunder_i_model *model = g->model;
    report->inexact = sunder_i_calloc(model->features, sizeof *report->inexact);
    report->stands = sunder_i_calloc(model->features, sizeof *report->stands);
    if (!report->inexact || !report->stands) return sunder_i_failure_cause(err);
    for (size_t f = 0; f < model->features; f++) {
        report->inexact[g->solver->layer.number[f]] = model->inexact[f];
        report->stands[g->solver->layer.number[f]] = sunder_i_influence_stands(g->by, model->body_of[f]);
    }
    if (!g->solver->rows.reach) return SUNDER_OK;
    report->row_reach = sunder_i_alloc(model->features, sizeof *report->row_reach);
    if (!report->row_reach) return sunder_i_failure_cause(err);
    for (size_t f = 0; f < model->features; f++)
        sunder_i_box_grow(g->solver->rows.reach[model->body_of[f]], sunder_i_contact_reach(&model->rules),
                          report->row_reach[g->solver->layer.number[f]]);
    return SUNDER_OK;
}

sunder_status sunder_i_report_worlds(sunder_report *report, const sunder_i_solver *solver,
                                     sunder_i_influence *influence, sunder_error *err)
{
    if (!solver->model.rules.keep_worlds) return SUNDER_OK;
    const gathering g = {.solver = solver, .model = &solver->model, .by = influence};
    uint32_t *world = sunder_i_alloc(solver->model.bodies, sizeof *world);
    sunder_status status = world ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status) status = sunder_i_influence_add(influence, solver, report, err);
    if (!status) status = sunder_i_influence_gather(influence, world, err);
    if (!status) status = number_worlds(report, &g, world, err);
    if (!status) status = keep_each(report, &g, err);
    if (!status) status = list_footprints(report, &g, err);
    if (!status) status = count_pairs(report, &g, err);
    if (!status) status = count_proved(report, &g, err);
    sunder_i_free(world);
    return status;
}

/* ---- The layer as given ------------------------------------------------------------------------------------------ */

static bool keep_pair(sunder_report *report, size_t *room, sunder_i_home_pair pair)
{
    if (!sunder_i_reserve(&report->home_pair, room, report->home_pairs + 1, sizeof *report->home_pair)) return false;
    report->home_pair[report->home_pairs++] = pair;
    return true;
}

sunder_status sunder_i_report_keep_home(sunder_report *report, const sunder_i_model *model,
                                        const sunder_i_relations *start, sunder_error *err)
{
    size_t room = 0;
    bool ok = true;
    if (!model->rules.keep_worlds) return SUNDER_OK;
    for (size_t k = 0; k < start->n && ok; k++) {
        const sunder_i_relation *r = &start->pair[k];
        if (model->body_of[r->a] != model->body_of[r->b] && (sunder_i_is_conflict(r) || r->kept))
            ok = keep_pair(report, &room, (sunder_i_home_pair){r->a, r->b, SUNDER_I_HOME_MET, 0, false});
        if (ok && report->thin && report->thin[k])
            ok = keep_pair(report, &room, (sunder_i_home_pair){r->a, r->b, SUNDER_I_HOME_THIN, 0, false});
    }
    for (size_t k = 0; k < start->n && ok;) {
        sunder_conflict c;
        uint32_t a, b;
        if (sunder_i_next_conflict(model, start, &k, &a, &b, &c))
            ok = keep_pair(report, &room, (sunder_i_home_pair){a, b, SUNDER_I_HOME_CONFLICT, c.kind, c.inside_block});
    }
    sunder_i_free(report->thin);
    report->thin = NULL;
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

size_t sunder_report_world(const sunder_report *report, size_t feature)
{
    return report->world_of ? report->world_of[feature] : SIZE_MAX;
}

size_t sunder_report_world_of_pair(const sunder_report *report, size_t a, size_t b)
{
    const size_t one = a < report->n ? sunder_report_world(report, a) : SIZE_MAX,
                 other = b < report->n ? sunder_report_world(report, b) : SIZE_MAX;
    return other == SIZE_MAX || (one != SIZE_MAX && !report->stands[a]) ? one : other;
}

const sunder_world *sunder_report_worlds(const sunder_report *report, size_t *n)
{
    *n = report->worlds;
    return report->world;
}

const sunder_footprint *sunder_report_footprints(const sunder_report *report, size_t *n)
{
    *n = report->footprints;
    return report->footprint;
}

const sunder_world_bound *sunder_report_world_bounds(const sunder_report *report, size_t *n)
{
    *n = report->world_bounds;
    return report->world_bound;
}

void sunder_report_row_reach(const sunder_report *report, size_t feature, double box[4])
{
    sunder_i_box_clear(box);
    if (report->row_reach) memcpy(box, report->row_reach[feature], sizeof report->row_reach[feature]);
}

size_t sunder_report_inside(const sunder_report *report, size_t feature)
{
    return report->inside ? report->inside[feature] : 0;
}

bool sunder_report_rounded(const sunder_report *report, size_t feature)
{
    return report->inexact && report->inexact[feature];
}
