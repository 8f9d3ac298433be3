/* part.c: see part.h. */
#include "parts/part.h"

#include "base/array.h"
#include "base/box.h"
#include "base/core.h"
#include "base/message.h"
#include "parts/memory.h"
#include "proof/lines.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A feature as it was read, at its place in the order of the input. */
typedef struct loaded {
    gis_spool_feature feature; /* its id owned */
    bool wanted;
} loaded;

typedef struct part {
    const gis_layout *layout;
    gis_spool *spool;
    const gis_boxes_list *boxes;
    gis_part_wants *wants;
    const void *user;
    size_t cell; /* that is being read */
    bool others; /* ... for those of blocks alone */
    bool *block; /* [layout->blocks] one of it is there */
    loaded *item;
    size_t n, capacity;
    gis_barriers_list barriers;
    sunder_layer *layer;
    sunder_report *report;
    gis_proof_lines lines; /* where trees are kept */
    unsigned run;
    gis_part_result *out;
} part;

bool gis_boxes_add(gis_boxes_list *list, const double box[4], double reach, gis_error *error)
{
    if (!gis_array_reserve(&list->box, &list->capacity, list->n + 1, sizeof *list->box)) return gis_no_memory(error);
    for (int c = 0; c < 4; c++) list->box[list->n][c] = box[c] + (c < 2 ? -reach : reach);
    list->n++;
    return true;
}

static char *copy_of(const char *text)
{
    char *copy = text ? malloc(strlen(text) + 1) : NULL;
    return copy ? strcpy(copy, text) : NULL;
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

static bool is_near(const part *p, const double box[4])
{
    for (size_t k = 0; k < p->boxes->n; k++)
        if (gis_box_meets(p->boxes->box[k], box)) return true;
    return false;
}

/* Among the layout's blocks; SIZE_MAX: it is none. */
static size_t place_of(const part *p, int64_t number)
{
    const gis_part_block *block = gis_layout_block(p->layout, number);
    return block ? (size_t)(block - p->layout->block) : SIZE_MAX;
}

static bool take(void *user, const gis_spool_feature *feature, gis_error *error)
{
    part *p = user;
    double box[4];
    sunder_shape_box(feature->demands.shape, box);
    const size_t block = place_of(p, feature->demands.block);
    const bool near = is_near(p, box), there = p->others ? !near && block != SIZE_MAX && p->block[block] : near;
    if (there && block != SIZE_MAX) p->block[block] = true;
    if (there && gis_array_reserve(&p->item, &p->capacity, p->n + 1, sizeof *p->item)) {
        loaded *to = &p->item[p->n++];
        *to = (loaded){*feature, p->wants(p->user, p->cell, feature->index)};
        to->feature.id = copy_of(feature->id);
        return !feature->id || to->feature.id || gis_no_memory(error);
    }
    sunder_shape_free((sunder_shape *)feature->demands.shape);
    return !there || gis_no_memory(error);
}

static int by_index(const void *a, const void *b)
{
    const loaded *p = a, *q = b;
    return (p->feature.index > q->feature.index) - (p->feature.index < q->feature.index);
}

/* Can there be one in the cell that is of a block with one that is there? */
static bool has_others(const part *p, const double box[4])
{
    for (size_t b = 0; b < p->layout->blocks; b++)
        if (p->block[b] && gis_box_meets(p->layout->block[b].box, box)) return true;
    return false;
}

static bool load(part *p, gis_error *error)
{
    p->block = calloc(p->layout->blocks + 1, sizeof *p->block);
    if (!p->block) return gis_no_memory(error);
    for (int others = 0; others < (p->layout->blocks ? 2 : 1); others++) {
        p->others = others;
        for (p->cell = 0; p->cell < gis_spool_cells(p->spool); p->cell++) {
            const double *box = gis_spool_cell_at(p->spool, p->cell)->box;
            if ((others ? has_others(p, box) : is_near(p, box)) && !gis_spool_read(p->spool, p->cell, take, p, error))
                return false;
        }
    }
    if (p->n) qsort(p->item, p->n, sizeof *p->item, by_index);
    return gis_barriers_load(&p->layout->barriers, (const double(*)[4])p->boxes->box, p->boxes->n, &p->barriers, error);
}

/* What hangs together is one part, whatever its size: it is told of before hours are spent on it. */
static void warn_if_large(const part *p)
{
    const sunder_layer_options *how = &p->layout->how;
    size_t vertices = 0;
    for (size_t k = 0; k < p->n; k++) {
        const sunder_shape *shape = p->item[k].feature.demands.shape;
        vertices += shape ? sunder_shape_vertices(shape) : 0;
    }
    const double bytes = gis_part_bytes(how->keep_trees, how->effort, (double)p->n, (double)vertices);
    if (p->layout->memory > 0 && bytes > GIS_PART_LARGE * p->layout->memory)
        gis_say_warning(
            GIS_MESSAGE_MEMORY,
            "%zu features may have to do with each other, and are one piece of work: it takes about %.0f MB, "
            "more than --max-memory has it",
            p->n, ceil(bytes / 1e6));
}

/* ---- Names in lines of proofs ------------------------------------------------------------------------------------ */

static int64_t call_feature(const void *of, size_t feature)
{
    const part *p = of;
    const gis_spool_feature *f = &p->item[feature].feature;
    return p->layout->by_places ? (int64_t)f->index : f->fid;
}

static int64_t call_barrier(const void *of, size_t thing, const char **layer)
{
    const part *p = of;
    const gis_part_barrier *barrier = &p->barriers.item[thing - p->n];
    *layer = barrier->layer;
    return barrier->fid;
}

static const sunder_feature *demands_of(const void *of, size_t feature)
{
    return &((const part *)of)->item[feature].feature.demands;
}

static bool begin_lines(part *p, gis_error *error)
{
    const gis_proof_things things = {p, p->n, call_feature, call_barrier, demands_of};
    return gis_proof_lines_begin(&p->lines, &things, p->report, error);
}

/* The line that was made becomes the result's. */
static bool take_line(part *p, gis_part_line *to, gis_error *error)
{
    gis_text *made = &p->lines.json.text;
    const char *line = gis_text_get(made);
    const bool done = line ? gis_part_add_line(p->out, line, made->length + 1, to, error) : gis_no_memory(error);
    gis_text_empty(made);
    p->lines.json.need_comma = false;
    return done;
}

/* ---- Separating -------------------------------------------------------------------------------------------------- */

static bool separate(part *p, gis_error *error)
{
    sunder_layer_options options = p->layout->how;
    sunder_error why;
    options.keep_worlds = true;
    sunder_feature *feature = malloc((p->n + 1) * sizeof *feature);
    if (!feature) return gis_no_memory(error);
    for (size_t k = 0; k < p->n; k++) feature[k] = p->item[k].feature.demands;
    const bool made = sunder_layer_new(feature, p->n, &p->layer, &why) == SUNDER_OK;
    free(feature);
    if (made && !gis_barriers_set(&p->barriers, p->layer, error)) return false;
    if (!made || sunder_layer_separate(p->layer, &options, &p->report, &why) != SUNDER_OK)
        return gis_core_failed(error, "a part of the layer", &why);
    sunder_layer_summary summary;
    sunder_report_summary(p->report, &summary);
    p->out->unverified = p->out->unverified || !summary.verified;
    return !options.keep_trees || begin_lines(p, error);
}

/* ---- Completeness ------------------------------------------------------------------------------------------------ */

/* Quarters of quarters: finer than that a box is not cut. */
enum { DEPTH = 7 };

static bool is_within(const double box[4], const double of[4])
{
    return of[0] <= box[0] && of[1] <= box[1] && box[2] <= of[2] && box[3] <= of[3];
}

/* Is everything of the layer that meets the box in the part? */
static bool is_known(const part *p, const double box[4], int depth)
{
    bool any = false;
    for (size_t k = 0; k < p->boxes->n; k++) {
        if (is_within(box, p->boxes->box[k])) return true;
        any = any || gis_box_meets(box, p->boxes->box[k]);
    }
    bool empty = true;
    for (size_t k = 0; k < gis_spool_cells(p->spool) && empty; k++)
        empty = !gis_box_meets(box, gis_spool_cell_at(p->spool, k)->box);
    empty = empty && !gis_barriers_may_meet(&p->layout->barriers, box);
    if (empty || !any || depth == 0) return empty;
    const double x = box[0] / 2 + box[2] / 2, y = box[1] / 2 + box[3] / 2;
    const double quarter[4][4] = {
        {box[0], box[1], x, y}, {x, box[1], box[2], y}, {box[0], y, x, box[3]}, {x, y, box[2], box[3]}};
    for (int k = 0; k < 4; k++)
        if (!is_known(p, quarter[k], depth - 1)) return false;
    return true;
}

/* ---- What is told ------------------------------------------------------------------------------------------------ */

static const gis_part_barrier *barrier_of(const part *p, size_t thing)
{
    return thing >= p->n && thing != SIZE_MAX ? &p->barriers.item[thing - p->n] : NULL;
}

static size_t index_of(const part *p, size_t thing)
{
    const gis_part_barrier *barrier = barrier_of(p, thing);
    if (barrier) return p->layout->features + barrier->number;
    return thing < p->n ? p->item[thing].feature.index : SIZE_MAX;
}

static bool add_name(part *p, gis_part_conflict *to, size_t thing, gis_error *error)
{
    gis_part_name name = {.index = index_of(p, thing)};
    if (name.index == SIZE_MAX) return true;
    const gis_part_barrier *barrier = barrier_of(p, thing);
    name.fid = barrier ? barrier->fid : p->item[thing].feature.fid;
    const char *text = barrier ? barrier->layer : p->item[thing].feature.id;
    if (!gis_part_add_text(p->out, text, &name.id, error) || !GIS_PART_MORE(p->out, name, names, 1, error))
        return false;
    p->out->name[p->out->names++] = name;
    to->names++;
    return true;
}

static bool add_row(part *p, size_t k, gis_error *error)
{
    const gis_spool_feature *f = &p->item[k].feature;
    gis_part_row row = {.index = f->index,
                        .fid = f->fid,
                        .from = {f->start[0], f->start[1]},
                        .weight = f->demands.weight,
                        .status = sunder_report_status(p->report, k),
                        .rounded = sunder_report_rounded(p->report, k)};
    sunder_report_move(p->report, k, &row.move[0], &row.move[1]);
    if (isnan(row.from[0])) sunder_shape_anchor(f->demands.shape, row.from);
    if (!gis_part_add_text(p->out, f->id, &row.id, error) || !GIS_PART_MORE(p->out, row, rows, 1, error)) return false;
    p->out->row[p->out->rows++] = row;
    return true;
}

/* number: among those of the report. */
static bool add_conflict(part *p, size_t number, bool loose, gis_error *error)
{
    size_t n;
    gis_part_result *out = p->out;
    const sunder_conflict *c = &sunder_report_conflicts(p->report, &n)[number];
    gis_part_conflict to = {.is = *c, .blocker = out->blockers, .name = out->names, .loose = loose};
    if (p->lines.report) {
        gis_proof_conflict(&p->lines, number);
        if (!take_line(p, &to.line, error)) return false;
    }
    if (!GIS_PART_MORE(out, conflict, conflicts, 1, error) ||
        !GIS_PART_MORE(out, blocker, blockers, c->n_blocked_by, error))
        return false;
    to.is.a = index_of(p, c->a);
    to.is.b = index_of(p, c->b);
    to.is.need_gone = index_of(p, c->need_gone);
    to.is.blocked_by = NULL;
    bool done = add_name(p, &to, c->a, error) && add_name(p, &to, c->b, error) && add_name(p, &to, c->need_gone, error);
    for (size_t k = 0; k < c->n_blocked_by && done; k++) {
        out->blocker[out->blockers++] = index_of(p, c->blocked_by[k]);
        done = add_name(p, &to, c->blocked_by[k], error);
    }
    out->conflict[out->conflicts++] = to;
    return done;
}

/* Where a feature stands at the end, and its FID. */
static int64_t stand(const part *p, size_t thing, double at[2])
{
    double move[2];
    sunder_report_move(p->report, thing, &move[0], &move[1]);
    sunder_shape_anchor(p->item[thing].feature.demands.shape, at);
    for (int c = 0; c < 2; c++) at[c] += move[c];
    return p->item[thing].feature.fid;
}

static bool add_push(part *p, const sunder_push *push, gis_error *error)
{
    const gis_part_barrier *barrier = barrier_of(p, push->b);
    gis_part_push to = {.is = *push};
    to.fid[0] = stand(p, push->a, to.from);
    if (barrier)
        gis_barrier_corner(&barrier->demands.geometry, to.from, to.to);
    else
        to.fid[1] = stand(p, push->b, to.to);
    if (barrier) to.fid[1] = barrier->fid;
    to.is.a = index_of(p, push->a);
    to.is.b = index_of(p, push->b);
    if (!gis_part_add_text(p->out, barrier ? barrier->layer : NULL, &to.layer, error) ||
        !GIS_PART_MORE(p->out, push, pushes, 1, error))
        return false;
    p->out->push[p->out->pushes++] = to;
    return true;
}

static bool add_footprints(part *p, const sunder_world *w, gis_part_world *to, gis_error *error)
{
    size_t n;
    const sunder_footprint *all = sunder_report_footprints(p->report, &n);
    if (!GIS_PART_MORE(p->out, footprint, footprints, w->footprints, error)) return false;
    to->complete = true;
    for (size_t k = 0; k < w->footprints; k++) {
        const sunder_footprint *f = &all[w->footprint + k];
        p->out->footprint[p->out->footprints++] = *f;
        to->complete = to->complete && is_known(p, f->seen, DEPTH);
    }
    return true;
}

/* What belongs to a world: features, conflicts or pushes by their numbers. */
typedef struct belonging {
    size_t world, at;
} belonging;

static int by_world(const void *a, const void *b)
{
    const belonging *p = a, *q = b;
    if (p->world != q->world) return p->world < q->world ? -1 : 1;
    return (p->at > q->at) - (p->at < q->at);
}

/* Of all worlds, one behind the other, and how far each list is used up. */
typedef struct belongings {
    belonging *feature, *conflict, *push, *tree;
    gis_proof_place *place; /* [trees]; NULL: there are none */
    size_t features, conflicts, pushes, trees, f, c, p, t;
} belongings;

static bool list_belongings(const part *p, belongings *all, gis_error *error)
{
    const sunder_conflict *conflict = sunder_report_conflicts(p->report, &all->conflicts);
    const sunder_push *push = sunder_report_pushes(p->report, &all->pushes);
    if (p->lines.report && !gis_proof_order(&p->lines, &all->place, &all->trees, error)) return false;
    all->features = p->n;
    all->tree = malloc((all->trees + 1) * sizeof *all->tree);
    all->feature = malloc((p->n + 1) * sizeof *all->feature);
    all->conflict = malloc((all->conflicts + 1) * sizeof *all->conflict);
    all->push = malloc((all->pushes + 1) * sizeof *all->push);
    if (!all->feature || !all->conflict || !all->push || !all->tree) return gis_no_memory(error);
    for (size_t k = 0; k < p->n; k++) all->feature[k] = (belonging){sunder_report_world(p->report, k), k};
    for (size_t k = 0; k < all->conflicts; k++)
        all->conflict[k] = (belonging){sunder_report_world_of_pair(p->report, conflict[k].a, conflict[k].b), k};
    for (size_t k = 0; k < all->pushes; k++)
        all->push[k] = (belonging){sunder_report_world_of_pair(p->report, push[k].a, push[k].b), k};
    for (size_t k = 0; k < all->trees; k++)
        all->tree[k] = (belonging){sunder_report_world(p->report, all->place[k].first), k};
    qsort(all->tree, all->trees, sizeof *all->tree, by_world);
    qsort(all->feature, all->features, sizeof *all->feature, by_world);
    qsort(all->conflict, all->conflicts, sizeof *all->conflict, by_world);
    qsort(all->push, all->pushes, sizeof *all->push, by_world);
    return true;
}

static bool is_wanted(const part *p, const belongings *all, size_t number)
{
    for (size_t k = all->f; k < all->features && all->feature[k].world == number; k++)
        if (p->item[all->feature[k].at].wanted) return true;
    return false;
}

static bool add_tree(part *p, const gis_proof_place *place, gis_error *error)
{
    size_t n;
    gis_part_tree to = {index_of(p, place->first), place->among, {0}};
    if (!gis_proof_tree(&p->lines, &sunder_report_bound_trees(p->report, &n)[place->tree], error) ||
        !take_line(p, &to.line, error) || !GIS_PART_MORE(p->out, tree, trees, 1, error))
        return false;
    p->out->tree[p->out->trees++] = to;
    return true;
}

static bool add_members(part *p, belongings *all, size_t number, gis_error *error)
{
    size_t n;
    const sunder_push *push = sunder_report_pushes(p->report, &n);
    for (size_t k = all->f; k < all->features && all->feature[k].world == number; k++)
        if (!add_row(p, all->feature[k].at, error)) return false;
    for (size_t k = all->c; k < all->conflicts && all->conflict[k].world == number; k++)
        if (!add_conflict(p, all->conflict[k].at, false, error)) return false;
    for (size_t k = all->p; k < all->pushes && all->push[k].world == number; k++)
        if (!add_push(p, &push[all->push[k].at], error)) return false;
    for (size_t k = all->t; k < all->trees && all->tree[k].world == number; k++)
        if (!add_tree(p, &all->place[all->tree[k].at], error)) return false;
    return true;
}

static void pass_by(belongings *all, size_t number)
{
    while (all->f < all->features && all->feature[all->f].world == number) all->f++;
    while (all->c < all->conflicts && all->conflict[all->c].world == number) all->c++;
    while (all->p < all->pushes && all->push[all->p].world == number) all->p++;
    while (all->t < all->trees && all->tree[all->t].world == number) all->t++;
}

static bool add_world(part *p, size_t number, belongings *all, gis_error *error)
{
    size_t n;
    gis_part_result *out = p->out;
    const sunder_world *w = &sunder_report_worlds(p->report, &n)[number];
    const sunder_world_bound *bound = sunder_report_world_bounds(p->report, &n);
    gis_part_world to = {.first = index_of(p, w->first),
                         .run = p->run,
                         .row = out->rows,
                         .footprint = out->footprints,
                         .footprints = w->footprints,
                         .bound = out->bounds,
                         .bounds = w->bounds,
                         .conflict = out->conflicts,
                         .push = out->pushes,
                         .tree = out->trees,
                         .before = w->before,
                         .after = w->after,
                         .thin = w->thin,
                         .clusters = w->clusters,
                         .clusters_optimal = w->clusters_optimal};
    if (!GIS_PART_MORE(out, bound, bounds, w->bounds, error) || !add_footprints(p, w, &to, error)) return false;
    for (size_t k = 0; k < w->bounds; k++) out->bound[out->bounds++] = bound[w->bound + k];
    if (!add_members(p, all, number, error)) return false;
    to.rows = out->rows - to.row;
    to.conflicts = out->conflicts - to.conflict;
    to.pushes = out->pushes - to.push;
    to.trees = out->trees - to.tree;
    if (!GIS_PART_MORE(out, world, worlds, 1, error)) return false;
    out->world[out->worlds++] = to;
    return true;
}

/* Conflicts inside blocks that nothing happened to. */
static bool add_loose(part *p, const belongings *all, gis_error *error)
{
    size_t n;
    gis_part_result *out = p->out;
    const sunder_conflict *conflict = sunder_report_conflicts(p->report, &n);
    for (size_t k = all->c; k < all->conflicts; k++) {
        const sunder_conflict *c = &conflict[all->conflict[k].at];
        if (!p->item[c->a].wanted) continue;
        if (!GIS_PART_MORE(out, world, worlds, 1, error)) return false;
        out->world[out->worlds++] = (gis_part_world){.first = index_of(p, c->a),
                                                     .run = p->run,
                                                     .complete = true,
                                                     .loose = true,
                                                     .row = out->rows,
                                                     .footprint = out->footprints,
                                                     .bound = out->bounds,
                                                     .push = out->pushes,
                                                     .tree = out->trees,
                                                     .conflict = out->conflicts,
                                                     .conflicts = 1};
        if (!add_conflict(p, all->conflict[k].at, true, error)) return false;
    }
    return true;
}

static bool add_worlds(part *p, gis_error *error)
{
    size_t n;
    belongings all = {0};
    sunder_report_worlds(p->report, &n);
    bool done = list_belongings(p, &all, error);
    for (size_t k = 0; k < n && done; k++) {
        if (is_wanted(p, &all, k)) done = add_world(p, k, &all, error);
        pass_by(&all, k);
    }
    done = done && add_loose(p, &all, error);
    free(all.feature);
    free(all.conflict);
    free(all.push);
    free(all.tree);
    free(all.place);
    return done;
}

static sunder_feature_status status_alone(const part *p, size_t k)
{
    const sunder_feature *demands = &p->item[k].feature.demands;
    return demands->fixed || demands->max_shift == 0 ? SUNDER_FEATURE_FIXED : SUNDER_FEATURE_UNMOVED;
}

/* Who was asked for and is of no world, if that is not all there is to say; and whose block it is, by pairs with the
 * block's first. */
static bool add_others(part *p, gis_error *error)
{
    gis_part_result *out = p->out;
    for (size_t k = 0; k < p->n; k++) {
        const int64_t block = sunder_report_block(p->report, k);
        if (block >= 0 && (size_t)block != k) {
            if (!GIS_PART_MORE(out, link, links, 1, error)) return false;
            out->link[out->links++] = (gis_part_link){index_of(p, (size_t)block), index_of(p, k)};
        }
        if (!p->item[k].wanted || sunder_report_world(p->report, k) != SIZE_MAX) continue;
        const gis_part_still still = {index_of(p, k), sunder_report_inside(p->report, k),
                                      sunder_report_status(p->report, k)};
        if (block < 0 && !still.inside && still.status == status_alone(p, k)) continue;
        if (!GIS_PART_MORE(out, still, stills, 1, error)) return false;
        out->still[out->stills++] = still;
    }
    return true;
}

static void clear(part *p)
{
    for (size_t k = 0; k < p->n; k++) {
        sunder_shape_free((sunder_shape *)p->item[k].feature.demands.shape);
        free((char *)p->item[k].feature.id);
    }
    free(p->item);
    free(p->block);
    gis_barriers_list_clear(&p->barriers);
    gis_proof_lines_clear(&p->lines);
    sunder_layer_free(p->layer);
    sunder_report_free(p->report);
}

bool gis_part_separate(const gis_layout *layout, const gis_boxes_list *boxes, gis_part_wants *wants, const void *user,
                       unsigned run, gis_part_result *result, gis_error *error)
{
    part p = {.layout = layout,
              .spool = layout->spool,
              .boxes = boxes,
              .wants = wants,
              .user = user,
              .run = run,
              .out = result};
    bool done = load(&p, error);
    if (done) warn_if_large(&p);
    done = done && separate(&p, error) && add_worlds(&p, error) && add_others(&p, error);
    clear(&p);
    return done;
}
