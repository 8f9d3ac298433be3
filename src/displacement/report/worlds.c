/* Determines the worlds of a layer: its parts that did not influence each other.
 *
 * Two bodies belong to the same world if they were ever solved together, if they are in conflict or in contact, or if
 * the solver examined, on behalf of one, a place where the other ever was. If the layer had contained only the bodies
 * of a world and the fixed features near them, every question would have had the same answer, and each body would end
 * where it does. The places examined are recorded as boxes (layer/reads.h): a part of the layer that holds everything
 * that meets the boxes of a world gives the same result for that world as the whole layer. A block is always read as a
 * whole, whichever member was met, because its other end may be fixed. */
#include "displacement/layer/resolution.h"
#include "displacement/report/report.h"

#include "base/union_find.h"

#include <stdlib.h>
#include <string.h>

/* The relative tolerance by which contact may exceed the required distance. */
#define HAIR 0x1p-16

typedef struct gathering {
    const sunder_i_solver *solver;
    const sunder_i_model *model;
    double reach;
    const double (*row_reach)[4]; /* [bodies] sunder_i_rows.reach; NULL: there are no rows */
    uint32_t *root;               /* [bodies] union-find of bodies that influenced each other */
    bool *active;                 /* [bodies] the body influenced another, or was influenced */
    /* [bodies] boxes of each set of root[], at its root: the places read, the places seen, the places where its bodies
     * stood */
    double (*read)[4], (*seen)[4], (*wrote)[4];
} gathering;

static bool is_fixed(const sunder_i_model *model, uint32_t body) { return model->body[body].fixed; }

/* Computes the box of the places where the body stood, from its original to every later position. */
static void box_of(const sunder_i_model *model, uint32_t body, double box[4])
{
    const sunder_i_body *b = &model->body[body];
    const double *went = model->went + 4 * (size_t)body;
    sunder_i_box_clear(box);
    for (uint32_t m = 0; m < b->members; m++) {
        const uint32_t f = model->member[b->member + m];
        if (model->present[f]) sunder_i_box_join(box, sunder_i_home_box(model, f));
    }
    for (int c = 0; c < 4; c++) box[c] += went[c];
}

/* Records that bodies i and j influenced each other. A fixed body does not join two sets; but two fixed bodies in
 * conflict with each other belong to a world, too. */
static void meet_bodies(gathering *g, uint32_t i, uint32_t j)
{
    const sunder_i_model *model = g->model;
    if (is_fixed(model, i) && !is_fixed(model, j)) {
        meet_bodies(g, j, i);
        return;
    }
    g->active[i] = true;
    if (sunder_i_is_barrier_body(model, &model->body[j])) return;
    if (is_fixed(model, j) && !is_fixed(model, i)) {
        /* Whether the block is fixed may depend on a member at its other end, so all of it is marked as seen. */
        double box[4];
        box_of(model, j, box);
        sunder_i_box_join(g->model->read[i].seen, box);
        return;
    }
    g->active[j] = true;
    sunder_i_union_join(g->root, i, j);
}

static void meet_conflicts(gathering *g, const sunder_i_relations *relations)
{
    for (size_t k = 0; k < relations->n; k++) {
        const sunder_i_relation *r = &relations->pair[k];
        const uint32_t i = g->model->body_of[r->a], j = g->model->body_of[r->b];
        if (i != j && (sunder_i_is_conflict(r) || r->kept)) meet_bodies(g, i, j);
    }
}

/* A pair of bodies that may not move is tight without ever having been solved. */
static void meet_tight(gathering *g, const sunder_report *report)
{
    const uint32_t *body_of = g->model->body_of;
    for (size_t k = 0; k < report->conflicts; k++) {
        const sunder_conflict *c = &report->conflict[k];
        if (c->kind == SUNDER_CONFLICT_TIGHT) meet_bodies(g, body_of[c->a], body_of[c->b]);
    }
}

static void meet_groups(gathering *g)
{
    const sunder_i_groups *groups = &g->solver->groups;
    for (size_t k = 0; k < groups->n; k++) {
        const sunder_i_group *group = &groups->group[k];
        for (size_t m = 0; m < group->n + group->guests.n; m++) {
            const uint32_t b = m < group->n ? group->body[m] : group->guests.item[m - group->n];
            if (!is_fixed(g->model, b)) meet_bodies(g, group->number, b);
        }
    }
    for (size_t k = 0; k < groups->joins; k++) meet_bodies(g, groups->joined[k].a, groups->joined[k].b);
}

/* ---- Where sets looked, and where they stood --------------------------------------------------------------------- */

/* Adds to what the body read: its neighbours in rows as they stand, and the place that decides which ones they are. */
static void look_along_rows(gathering *g, uint32_t b)
{
    const sunder_i_model *model = g->model;
    const sunder_i_extras *has = model->body[b].has;
    const uint32_t at = sunder_i_union_find(g->root, b);
    if (g->row_reach) sunder_i_box_join(g->seen[at], g->row_reach[b]);
    for (uint32_t k = has->row_side; k < has->row_side + has->row_sides && !is_fixed(model, b); k++) {
        double box[4];
        box_of(model, model->row_side[k].other, box);
        sunder_i_box_join(g->read[at], box);
    }
}

static void find_boxes(gathering *g)
{
    for (uint32_t b = 0; b < g->model->bodies; b++) {
        sunder_i_box_clear(g->read[b]);
        sunder_i_box_clear(g->seen[b]);
        sunder_i_box_clear(g->wrote[b]);
    }
    for (uint32_t b = 0; b < g->model->bodies; b++) {
        if (!g->active[b]) continue;
        const uint32_t at = sunder_i_union_find(g->root, b);
        double box[4], about[4];
        box_of(g->model, b, box);
        sunder_i_box_grow(box, g->reach, about);
        if (!is_fixed(g->model, b)) sunder_i_box_join(g->wrote[at], box);
        sunder_i_box_join(g->read[at], about);
        sunder_i_box_join(g->read[at], g->model->read[b].place);
        sunder_i_box_join(g->seen[at], g->model->read[b].seen);
        look_along_rows(g, b);
    }
    for (uint32_t b = 0; b < g->model->bodies; b++) {
        if (!g->active[b] || sunder_i_union_find(g->root, b) != b) continue;
        /* Whether a block ends here depends on what is next to it, so the box is grown. */
        sunder_i_box_grow(g->seen[b], g->reach, g->seen[b]);
        sunder_i_box_join(g->seen[b], g->read[b]);
    }
}

/* Copies root[] to world[], and joins there any two sets of bodies if the box of the places that the bodies of one
 * examined (read) meets the box of the places where those of the other stood (wrote). Fixed bodies join nothing. */
static sunder_status meet_readers(gathering *g, uint32_t *world, sunder_error *err)
{
    const size_t n = g->model->bodies;
    bool *there = sunder_i_calloc(n, sizeof *there);
    sunder_i_rtree tree = {0};
    sunder_i_list hits = {0};
    sunder_status status = there ? SUNDER_OK : sunder_i_failure_cause(err);
    for (size_t b = 0; b < n && !status; b++) there[b] = g->wrote[b][0] <= g->wrote[b][2];
    if (!status) status = sunder_i_rtree_build(g->wrote[0], there, n, &tree, err);
    memcpy(world, g->root, n * sizeof *world);
    for (uint32_t b = 0; b < n && !status; b++) {
        if (!there[b]) continue;
        hits.n = 0;
        if (!sunder_i_rtree_query(&tree, g->read[b], &hits)) status = sunder_i_failure_cause(err);
        for (size_t k = 0; k < hits.n && !status; k++)
            if (!is_fixed(g->model, b) && !is_fixed(g->model, hits.item[k]))
                sunder_i_union_join(world, b, hits.item[k]);
    }
    sunder_i_rtree_free(&tree);
    sunder_i_free_all(hits.item, there);
    return status;
}

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
        if (!g->active[body]) continue;
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

static sunder_status list_footprints(sunder_report *report, const gathering *g, sunder_error *err)
{
    size_t n = 0;
    for (uint32_t b = 0; b < g->model->bodies; b++) n += g->active[b] && sunder_i_union_find(g->root, b) == b;
    report->footprint = sunder_i_alloc(n, sizeof *report->footprint);
    if (!report->footprint) return sunder_i_failure_cause(err);
    for (uint32_t b = 0; b < g->model->bodies; b++) {
        if (!g->active[b] || sunder_i_union_find(g->root, b) != b) continue;
        sunder_footprint *p = &report->footprint[report->footprints++];
        p->world = world_of_body(report, g, b);
        memcpy(p->read, g->read[b], sizeof p->read);
        memcpy(p->seen, g->seen[b], sizeof p->seen);
        memcpy(p->wrote, g->wrote[b], sizeof p->wrote);
    }
    if (n) qsort(report->footprint, n, sizeof *report->footprint, by_world);
    for (size_t k = n; k-- > 0;) {
        sunder_world *w = &report->world[report->footprint[k].world];
        w->footprint = k;
        w->footprints++;
    }
    return SUNDER_OK;
}

/* Counts each conflict in its world. A conflict inside a block without a world is counted with the first of its two
 * features. */
static sunder_status count_pairs(sunder_report *report, const gathering *g, sunder_error *err)
{
    const sunder_i_relations *const list[2] = {&g->solver->start, &g->solver->now};
    report->inside = sunder_i_calloc(g->model->features, sizeof *report->inside);
    if (!report->inside) return sunder_i_failure_cause(err);
    for (int now = 0; now < 2; now++) {
        for (size_t k = 0; k < list[now]->n;) {
            sunder_conflict c;
            uint32_t a, b;
            if (!sunder_i_next_conflict(g->model, list[now], &k, &a, &b, &c)) continue;
            const size_t w = world_of_pair(report, g, a, b);
            if (w != SIZE_MAX) {
                sunder_i_count(now ? &report->world[w].after : &report->world[w].before, &c);
            } else if (!now) {
                const size_t p = g->solver->layer.number[a], q = g->solver->layer.number[b];
                report->inside[p < q ? p : q]++;
            }
        }
    }
    for (size_t k = 0; k < g->solver->start.n && report->thin; k++) {
        const sunder_i_relation *r = &g->solver->start.pair[k];
        if (report->thin[k]) report->world[world_of_pair(report, g, r->a, r->b)].thin++;
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
        report->stands[g->solver->layer.number[f]] = is_fixed(model, model->body_of[f]);
    }
    if (!g->row_reach) return SUNDER_OK;
    report->row_reach = sunder_i_alloc(model->features, sizeof *report->row_reach);
    if (!report->row_reach) return sunder_i_failure_cause(err);
    for (size_t f = 0; f < model->features; f++)
        sunder_i_box_grow(g->row_reach[model->body_of[f]], g->reach, report->row_reach[g->solver->layer.number[f]]);
    return SUNDER_OK;
}

sunder_status sunder_i_report_worlds(sunder_report *report, const sunder_i_solver *solver, sunder_error *err)
{
    const sunder_i_model *model = &solver->model;
    if (!model->rules.keep_worlds) return SUNDER_OK;
    const size_t n = model->bodies;
    gathering g = {.solver = solver,
                   .model = model,
                   .reach = (model->rules.full_gap + model->rules.tolerance + model->rules.thin) * (1 + HAIR),
                   .row_reach = (const double(*)[4])solver->rows.reach,
                   .root = sunder_i_alloc(n, sizeof *g.root),
                   .active = sunder_i_calloc(n, sizeof *g.active),
                   .read = sunder_i_alloc(n, sizeof *g.read),
                   .seen = sunder_i_alloc(n, sizeof *g.seen),
                   .wrote = sunder_i_alloc(n, sizeof *g.wrote)};
    uint32_t *world = sunder_i_alloc(n, sizeof *world);
    sunder_status status =
        g.root && g.active && g.read && g.seen && g.wrote && world ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status) {
        sunder_i_union_init(g.root, n);
        for (size_t e = 0; e < solver->edges; e++) meet_bodies(&g, solver->edge[e].a, solver->edge[e].b);
        meet_conflicts(&g, &solver->start);
        meet_conflicts(&g, &solver->now);
        meet_tight(&g, report);
        meet_groups(&g);
        find_boxes(&g);
        status = meet_readers(&g, world, err);
    }
    if (!status) status = number_worlds(report, &g, world, err);
    if (!status) status = keep_each(report, &g, err);
    if (!status) status = list_footprints(report, &g, err);
    if (!status) status = count_pairs(report, &g, err);
    if (!status) status = count_proved(report, &g, err);
    sunder_i_free_all(g.root, g.active, g.read, g.seen, g.wrote, world);
    return status;
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
