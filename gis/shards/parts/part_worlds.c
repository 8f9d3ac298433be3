/* part_worlds.c: see part_internal.h. */
#include "shards/parts/part_internal.h"

#include "base/array.h"
#include "geometry/gis_box.h"
#include "layer/output.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

/* ---- Completeness ---------------------------------------------------------------------------------------------- */

/* A box whose content is unknown is divided into quarters at most this number of times. */
enum { DEPTH = 7 };

static bool is_within(const double box[4], const double of[4])
{
    return of[0] <= box[0] && of[1] <= box[1] && box[2] <= of[2] && box[3] <= of[3];
}

static bool is_known(const gis_part *p, const double box[4], int depth)
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

bool gis_part_knows(const gis_part *p, const double box[4]) { return is_known(p, box, DEPTH); }

/* ---- Worlds ---------------------------------------------------------------------------------------------------- */

/* Features are cut back at barriers that are farther than they have to be by a hair (sunder_layer_trim()), so these are
 * looked for within some more of the largest coordinate. */
static void add_hair(const gis_part *p, double box[4])
{
    double most = 0;
    if (!p->layout->rules->trim) return;
    for (int c = 0; c < 4; c++) most = fmax(most, fabs(box[c]));
    for (int c = 0; c < 4; c++) box[c] += c < 2 ? -most * 0x1p-40 : most * 0x1p-40;
}

static bool add_footprints(gis_part *p, const sunder_world *w, gis_part_world *to, gis_error *error)
{
    size_t n;
    const sunder_footprint *all = sunder_report_footprints(p->report, &n);
    if (!GIS_PART_MORE(p->out, footprint, footprints, w->footprints, error)) return false;
    to->complete = true;
    for (size_t k = 0; k < w->footprints; k++) {
        sunder_footprint *f = &p->out->footprint[p->out->footprints++];
        *f = all[w->footprint + k];
        add_hair(p, f->seen);
        to->complete = to->complete && gis_part_knows(p, f->seen);
    }
    return true;
}

/* An item of a world: a feature, conflict, push or tree, by its number. */
typedef struct belonging {
    size_t world, at;
} belonging;

static int by_world(const void *a, const void *b)
{
    const belonging *p = a, *q = b;
    if (p->world != q->world) return p->world < q->world ? -1 : 1;
    return (p->at > q->at) - (p->at < q->at);
}

/* The items of all worlds, sorted by world, and the place reached in each list. */
typedef struct belongings {
    belonging *feature, *conflict, *push, *tree, *component, *clause, *choice;
    const sunder_clause **reason; /* [features] why each is hidden; NULL for others */
    gis_proof_place *place;       /* [trees]; NULL: no trees are kept */
    size_t features, conflicts, pushes, trees, components, f, c, p, t, h, l, o;
} belongings;

/* Lists the places of clauses or choices by world; NULL: memory is out. */
static belonging *list_places(const gis_part *p, const gis_proof_place *place, size_t n)
{
    belonging *list = malloc((n + 1) * sizeof *list);
    for (size_t k = 0; k < n && list; k++) list[k] = (belonging){sunder_report_world(p->report, place[k].first), k};
    if (list && n) qsort(list, n, sizeof *list, by_world);
    return list;
}

static bool list_belongings(const gis_part *p, belongings *all, gis_error *error)
{
    const sunder_conflict *conflict = sunder_report_conflicts(p->report, &all->conflicts);
    const sunder_push *push = sunder_report_pushes(p->report, &all->pushes);
    const sunder_hiding_component *component = sunder_report_hiding_components(p->report, &all->components);
    if (p->lines.report && !gis_proof_order(&p->lines, &all->place, &all->trees, error)) return false;
    all->features = p->n;
    all->tree = malloc((all->trees + 1) * sizeof *all->tree);
    all->feature = malloc((p->n + 1) * sizeof *all->feature);
    all->conflict = malloc((all->conflicts + 1) * sizeof *all->conflict);
    all->push = malloc((all->pushes + 1) * sizeof *all->push);
    all->component = malloc((all->components + 1) * sizeof *all->component);
    all->reason = gis_hidden_reasons(p->report, p->n);
    all->clause = list_places(p, p->choices.clause, p->choices.clauses);
    all->choice = list_places(p, p->choices.tree, p->choices.trees);
    if (!all->clause || !all->choice || !all->feature || !all->conflict || !all->push || !all->tree ||
        !all->component || !all->reason)
        return gis_no_memory(error);
    for (size_t k = 0; k < p->n; k++) all->feature[k] = (belonging){sunder_report_world(p->report, k), k};
    for (size_t k = 0; k < all->conflicts; k++)
        all->conflict[k] = (belonging){sunder_report_world_of_pair(p->report, conflict[k].a, conflict[k].b), k};
    for (size_t k = 0; k < all->pushes; k++)
        all->push[k] = (belonging){sunder_report_world_of_pair(p->report, push[k].a, push[k].b), k};
    for (size_t k = 0; k < all->trees; k++)
        all->tree[k] = (belonging){sunder_report_world(p->report, all->place[k].first), k};
    for (size_t k = 0; k < all->components; k++)
        all->component[k] = (belonging){sunder_report_world(p->report, component[k].feature), k};
    qsort(all->component, all->components, sizeof *all->component, by_world);
    qsort(all->tree, all->trees, sizeof *all->tree, by_world);
    qsort(all->feature, all->features, sizeof *all->feature, by_world);
    qsort(all->conflict, all->conflicts, sizeof *all->conflict, by_world);
    qsort(all->push, all->pushes, sizeof *all->push, by_world);
    return true;
}

static bool is_wanted(const gis_part *p, const belongings *all, size_t number)
{
    for (size_t k = all->f; k < all->features && all->feature[k].world == number; k++)
        if (p->item[all->feature[k].at].wanted) return true;
    return false;
}

static bool add_members(gis_part *p, belongings *all, size_t number, gis_error *error)
{
    size_t n;
    const sunder_push *push = sunder_report_pushes(p->report, &n);
    for (size_t k = all->f; k < all->features && all->feature[k].world == number; k++)
        if (!gis_part_fill_row(p, all->feature[k].at, error) ||
            (sunder_report_status(p->report, all->feature[k].at) == SUNDER_FEATURE_HIDDEN &&
             !gis_part_fill_hidden(p, all->feature[k].at, all->reason[all->feature[k].at], error)))
            return false;
    for (size_t k = all->c; k < all->conflicts && all->conflict[k].world == number; k++)
        if (!gis_part_fill_conflict(p, all->conflict[k].at, false, error)) return false;
    for (size_t k = all->p; k < all->pushes && all->push[k].world == number; k++)
        if (!gis_part_fill_push(p, &push[all->push[k].at], error)) return false;
    for (size_t k = all->t; k < all->trees && all->tree[k].world == number; k++)
        if (!gis_part_fill_tree(p, &all->place[all->tree[k].at], error)) return false;
    for (size_t k = all->h; k < all->components && all->component[k].world == number; k++)
        if (!gis_part_fill_component(p, all->component[k].at, error)) return false;
    return true;
}

/* Adds the lines of the proof about what is hidden or smaller. */
static bool add_told(gis_part *p, const belongings *all, size_t number, gis_error *error)
{
    for (size_t k = all->f; k < all->features && all->feature[k].world == number; k++)
        if (!gis_part_fill_shapes(p, all->feature[k].at, error)) return false;
    for (size_t k = all->l; k < p->choices.clauses && all->clause[k].world == number; k++)
        if (!gis_part_fill_clause(p, &p->choices.clause[all->clause[k].at], error)) return false;
    for (size_t k = all->o; k < p->choices.trees && all->choice[k].world == number; k++)
        if (!gis_part_fill_choice(p, &p->choices.tree[all->choice[k].at], error)) return false;
    return true;
}

static void pass_by(const gis_part *p, belongings *all, size_t number)
{
    while (all->l < p->choices.clauses && all->clause[all->l].world == number) all->l++;
    while (all->o < p->choices.trees && all->choice[all->o].world == number) all->o++;
    while (all->f < all->features && all->feature[all->f].world == number) all->f++;
    while (all->c < all->conflicts && all->conflict[all->c].world == number) all->c++;
    while (all->p < all->pushes && all->push[all->p].world == number) all->p++;
    while (all->t < all->trees && all->tree[all->t].world == number) all->t++;
    while (all->h < all->components && all->component[all->h].world == number) all->h++;
}

/* Adds what was seen at the shape that a feature of the world had before it became larger, unless that lies in the
 * larger one: a barrier may cross the feature there. */
static bool add_given(gis_part *p, size_t k, size_t number, gis_part_world *to, gis_error *error)
{
    sunder_footprint footprint = {.world = number};
    double larger[4];
    if (!p->item[k].given) return true;
    sunder_shape_box(p->item[k].given, footprint.seen);
    sunder_shape_box(p->item[k].feature.demands.shape, larger);
    if (is_within(footprint.seen, larger)) return true;
    gis_box_clear(footprint.read);
    gis_box_clear(footprint.wrote);
    if (!GIS_PART_MORE(p->out, footprint, footprints, 1, error)) return false;
    p->out->footprint[p->out->footprints++] = footprint;
    to->footprints++;
    to->complete = to->complete && gis_part_knows(p, footprint.seen);
    return true;
}

static bool add_world(gis_part *p, size_t number, belongings *all, gis_error *error)
{
    size_t n;
    gis_part_result *out = p->out;
    const sunder_world *w = &sunder_report_worlds(p->report, &n)[number];
    const sunder_world_bound *bound = sunder_report_world_bounds(p->report, &n);
    gis_part_world to = gis_part_world_at(out);
    to.first = gis_part_index_of(p, w->first);
    to.run = p->run;
    to.footprints = w->footprints;
    to.bounds = w->bounds;
    to.before = w->before;
    to.after = w->after;
    to.thin = w->thin;
    to.clusters = w->clusters;
    to.clusters_optimal = w->clusters_optimal;
    if (!GIS_PART_MORE(out, bound, bounds, w->bounds, error) || !add_footprints(p, w, &to, error)) return false;
    for (size_t k = 0; k < w->bounds; k++) out->bound[out->bounds++] = bound[w->bound + k];
    for (size_t k = all->f; k < all->features && all->feature[k].world == number; k++)
        if (!add_given(p, all->feature[k].at, number, &to, error)) return false;
    if (!add_members(p, all, number, error) || !add_told(p, all, number, error)) return false;
    for (size_t k = all->f; k < all->features && all->feature[k].world == number; k++)
        p->decided[all->feature[k].at] = to.complete;
    to.rows = out->rows - to.row;
    to.conflicts = out->conflicts - to.conflict;
    to.pushes = out->pushes - to.push;
    to.trees = out->trees - to.tree;
    to.components = out->components - to.component;
    to.classes = out->classes - to.class;
    to.hiddens = out->hiddens - to.hidden;
    to.tolds = out->tolds - to.told;
    if (!GIS_PART_MORE(out, world, worlds, 1, error)) return false;
    out->world[out->worlds++] = to;
    return true;
}

/* Adds the conflicts inside blocks that are in no world, if their first feature is requested, each as a loose
 * world. */
static bool add_loose(gis_part *p, const belongings *all, gis_error *error)
{
    size_t n;
    gis_part_result *out = p->out;
    const sunder_conflict *conflict = sunder_report_conflicts(p->report, &n);
    for (size_t k = all->c; k < all->conflicts; k++) {
        const sunder_conflict *c = &conflict[all->conflict[k].at];
        if (!p->item[c->a].wanted) continue;
        if (!GIS_PART_MORE(out, world, worlds, 1, error)) return false;
        gis_part_world to = gis_part_world_at(out);
        to.first = gis_part_index_of(p, c->a);
        to.run = p->run;
        to.complete = to.loose = true;
        to.conflicts = 1;
        out->world[out->worlds++] = to;
        if (!gis_part_fill_conflict(p, all->conflict[k].at, true, error)) return false;
    }
    return true;
}

bool gis_part_fill_worlds(gis_part *p, gis_error *error)
{
    size_t n;
    belongings all = {0};
    sunder_report_worlds(p->report, &n);
    bool done = list_belongings(p, &all, error);
    for (size_t k = 0; k < n && done; k++) {
        if (is_wanted(p, &all, k)) done = add_world(p, k, &all, error);
        pass_by(p, &all, k);
    }
    done = done && add_loose(p, &all, error);
    free(all.feature);
    free(all.conflict);
    free(all.push);
    free(all.tree);
    free(all.component);
    free(all.reason);
    free(all.clause);
    free(all.choice);
    free(all.place);
    return done;
}

/* ---- Others ------------------------------------------------------------------------------------------------------ */

static sunder_feature_status status_alone(const gis_part *p, size_t k)
{
    const sunder_feature *demands = &p->item[k].feature.demands;
    return demands->fixed || demands->max_shift == 0 ? SUNDER_FEATURE_FIXED : SUNDER_FEATURE_UNMOVED;
}

/* Adds requested features that are in no world, if they differ from features alone, and the blocks of all features, as
 * links to the block's first feature. */
bool gis_part_fill_others(gis_part *p, gis_error *error)
{
    gis_part_result *out = p->out;
    for (size_t k = 0; k < p->n; k++) {
        const int64_t block = sunder_report_block(p->report, k);
        if (block >= 0 && (size_t)block != k) {
            if (!GIS_PART_MORE(out, link, links, 1, error)) return false;
            out->link[out->links++] = (gis_part_link){gis_part_index_of(p, (size_t)block), gis_part_index_of(p, k)};
        }
        if (!p->item[k].wanted || sunder_report_world(p->report, k) != SIZE_MAX) continue;
        const gis_part_still still = {gis_part_index_of(p, k), sunder_report_inside(p->report, k),
                                      sunder_report_status(p->report, k)};
        if (block < 0 && !still.inside && still.status == status_alone(p, k)) continue;
        if (!GIS_PART_MORE(out, still, stills, 1, error)) return false;
        out->still[out->stills++] = still;
    }
    return true;
}
