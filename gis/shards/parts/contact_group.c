/* contact_group.c: see contact_group.h. Features are joined to groups cell by cell along the curve. Features near a
 * cell that is not yet visited are kept until the last such cell was visited, so memory is needed only for the features
 * along the border between visited and unvisited cells. */
#include "shards/parts/contact_group.h"

#include "base/array.h"
#include "base/core_error.h"
#include "base/disjoint_sets.h"
#include "base/interrupt.h"
#include "geometry/gis_box.h"
#include "shards/parts/box_pairs.h"
#include "shards/parts/part_memory.h"

#include <stdlib.h>
#include <string.h>

/* The groups that can no longer grow are dropped when there are more than this number of groups, plus twice the number
 * that the last dropping left. */
enum { MOST_GROUPS = 1 << 12 };

/* Pairs of shapes that are compared, per feature on average. Layers with more pairs have stacked features; then boxes
 * alone are compared. */
static const size_t patience = 500;

typedef struct member {
    double box[4]; /* enlarged by half the reach on all sides */
    uint64_t place;
    size_t group;
    sunder_shape *shape; /* owned; NULL: only boxes are compared, or the shape is read when it is needed */
    bool inside;         /* its box lies in another member's, so it can be skipped where only boxes are compared */
} member;

typedef struct members {
    member *at;
    size_t n, room;
} members;

typedef struct search {
    const gis_layout *layout;
    double reach;
    bool by_shapes;
    size_t patience;          /* shape comparisons left, for pairs whose boxes meet */
    gis_contact_group *group; /* [groups] sums are kept at the roots */
    size_t *parent;           /* [groups] of the disjoint sets */
    size_t groups, group_room, parent_room, enough_groups;
    gis_contact_group largest; /* the largest of the groups that were dropped as complete */
    size_t *of_block;          /* [layout->blocks] a group of the block, or SIZE_MAX */
    size_t *beside;            /* [besides] numbers of the cells within reach of the current cell, ascending */
    size_t besides, beside_room;
    size_t *last;  /* [cells] of a cell and those beside it, the one that is visited last; after it
                    * the members of the cell are dropped */
    members *cell; /* [cells] the members kept of each cell */
    members here;  /* members of the current cell */
    member **swept;
    size_t swept_n, swept_room;
    gis_box_pairs pairs;
    sunder_shape *read; /* set by gis_spool_read_one() */
    gis_error *error;
    bool failed;
} search;

/* ---- Groups ------------------------------------------------------------------------------------------------------ */

static double bytes_of(const gis_layout *layout, const gis_contact_group *t)
{
    return gis_part_bytes(layout->how.keep_trees, layout->how.effort, (double)t->features, (double)t->vertices);
}

static bool add_group(search *l, const double box[4], size_t vertices)
{
    if (!gis_array_reserve(&l->group, &l->group_room, l->groups + 1, sizeof *l->group) ||
        !gis_array_reserve(&l->parent, &l->parent_room, l->groups + 1, sizeof *l->parent))
        return false;
    gis_contact_group *to = &l->group[l->groups];
    *to = (gis_contact_group){.features = 1, .vertices = vertices};
    memcpy(to->box, box, sizeof to->box);
    l->parent[l->groups] = l->groups;
    l->groups++;
    return true;
}

static void join_groups(search *l, size_t a, size_t b)
{
    const size_t x = gis_set_root(l->parent, a), y = gis_set_root(l->parent, b);
    if (x == y) return;
    gis_contact_group *to = &l->group[x < y ? x : y];
    const gis_contact_group *from = &l->group[x < y ? y : x];
    to->features += from->features;
    to->vertices += from->vertices;
    gis_box_join(to->box, from->box);
    gis_set_join(l->parent, x, y);
}

/* Joins the group `one` with the other members of the block with this number. */
static void join_block(search *l, int64_t number, size_t one)
{
    const gis_part_block *block = gis_layout_block(l->layout, number);
    if (!block) return;
    size_t *first = &l->of_block[block - l->layout->block];
    if (*first == SIZE_MAX) *first = one;
    join_groups(l, *first, one);
}

static void consider_group(search *l, const gis_contact_group *group)
{
    if (bytes_of(l->layout, group) > bytes_of(l->layout, &l->largest)) l->largest = *group;
}

/* Replaces *group, which a kept member or block refers to, by the number of its root, and marks the root in `to` as one
 * that stays. */
static void keep_group(const search *l, size_t *to, size_t *group)
{
    *group = gis_set_root(l->parent, *group);
    to[*group] = 0;
}

/* Drops groups without kept members; only the largest of these is remembered. */
static bool drop_complete_groups(search *l, gis_error *error)
{
    const size_t cells = gis_spool_cells(l->layout->spool);
    size_t *to = malloc((l->groups + 1) * sizeof *to), n = 0;
    if (!to) return gis_no_memory(error);
    for (size_t k = 0; k < l->groups; k++) to[k] = SIZE_MAX;
    for (size_t c = 0; c < cells; c++)
        for (size_t k = 0; k < l->cell[c].n; k++) keep_group(l, to, &l->cell[c].at[k].group);
    for (size_t b = 0; b < l->layout->blocks; b++)
        if (l->of_block[b] != SIZE_MAX) keep_group(l, to, &l->of_block[b]);
    for (size_t k = 0; k < l->groups; k++) {
        if (to[k] != SIZE_MAX) {
            to[k] = n;
            l->group[n++] = l->group[k];
        } else if (l->parent[k] == k) {
            consider_group(l, &l->group[k]);
        }
    }
    for (size_t c = 0; c < cells; c++)
        for (size_t k = 0; k < l->cell[c].n; k++) l->cell[c].at[k].group = to[l->cell[c].at[k].group];
    for (size_t b = 0; b < l->layout->blocks; b++)
        if (l->of_block[b] != SIZE_MAX) l->of_block[b] = to[l->of_block[b]];
    for (size_t k = 0; k < n; k++) l->parent[k] = k;
    l->groups = n;
    free(to);
    return true;
}

/* ---- Neighbours -------------------------------------------------------------------------------------------------- */

static bool keep_shape(void *user, const gis_spool_feature *feature, gis_error *error)
{
    search *l = user;
    (void)error;
    l->read = (sunder_shape *)feature->demands.shape;
    return true;
}

static sunder_shape *shape_of(search *l, member *m)
{
    l->read = NULL;
    if (!m->shape && gis_spool_read_one(l->layout->spool, m->place, keep_shape, l, l->error)) m->shape = l->read;
    return m->shape;
}

static bool are_within_reach(search *l, member *a, member *b)
{
    bool apart = true;
    sunder_error why;
    const sunder_shape *p = shape_of(l, a), *q = p ? shape_of(l, b) : NULL;
    if (!q)
        l->failed = true;
    else if (sunder_pair_apart(p, q, l->reach, &apart, &why) != SUNDER_OK)
        l->failed = !gis_core_failed(l->error, "what hangs together", &why);
    return !apart;
}

/* Joins two members whose boxes meet. A box that lies in another needs no further comparisons: whatever meets it meets
 * the other. */
static gis_box_pairs_next join_boxes(search *l, member *p, member *q, const gis_paired_box *a, const gis_paired_box *b)
{
    join_groups(l, p->group, q->group);
    if (a->box[2] >= b->box[2] && a->box[1] <= b->box[1] && a->box[3] >= b->box[3]) {
        q->inside = true;
        return GIS_BOX_PAIRS_A_ONLY;
    }
    const bool within = b->box[2] >= a->box[2] && b->box[1] <= a->box[1] && b->box[3] >= a->box[3];
    return within ? GIS_BOX_PAIRS_B_ONLY : GIS_BOX_PAIRS_BOTH;
}

/* Joins two members that are within reach. kind is 1 for members kept from earlier cells, which were compared with each
 * other before. */
static gis_box_pairs_next join_if_near(void *user, const gis_paired_box *a, const gis_paired_box *b)
{
    search *l = user;
    member *p = l->swept[a->of], *q = l->swept[b->of];
    if (!l->by_shapes) return join_boxes(l, p, q, a, b);
    /* after an error, or when no comparisons are left, the sweep should end quickly */
    if (l->failed || l->patience == 0) return GIS_BOX_PAIRS_A_ONLY;
    if (a->kind && b->kind) return GIS_BOX_PAIRS_BOTH;
    l->patience--;
    if (gis_set_root(l->parent, p->group) != gis_set_root(l->parent, q->group) && are_within_reach(l, p, q))
        join_groups(l, p->group, q->group);
    return GIS_BOX_PAIRS_BOTH;
}

static bool sweep_too(search *l, member *m, int kind, gis_error *error)
{
    if (!gis_array_reserve(&l->swept, &l->swept_room, l->swept_n + 1, sizeof(member *))) return gis_no_memory(error);
    l->swept[l->swept_n++] = m;
    return gis_box_pairs_add(&l->pairs, m->box, l->swept_n - 1, kind, error);
}

static void drop_shapes(members *all)
{
    for (size_t k = 0; k < all->n; k++) {
        sunder_shape_free(all->at[k].shape);
        all->at[k].shape = NULL;
    }
}

/* The box of a cell, enlarged as those of its members are. */
static void box_of(const search *l, size_t cell, double box[4])
{
    memcpy(box, gis_spool_cell_at(l->layout->spool, cell)->box, 4 * sizeof *box);
    for (int c = 0; c < 4; c++) box[c] += (c < 2 ? -1 : 1) * l->reach / 2;
}

/* Joins the members of the cell with each other, and with the kept members of earlier cells beside it. */
static bool join_cell(search *l, size_t cell, gis_error *error)
{
    double box[4];
    bool done = true;
    box_of(l, cell, box);
    l->swept_n = 0;
    for (size_t k = 0; k < l->here.n && done; k++) done = sweep_too(l, &l->here.at[k], 0, error);
    for (size_t b = 0; b < l->besides && done; b++) {
        members *there = &l->cell[l->beside[b]];
        for (size_t k = 0; k < there->n && done; k++)
            if (gis_box_meets(box, there->at[k].box)) done = sweep_too(l, &there->at[k], 1, error);
    }
    if (done) gis_box_pairs_visit(&l->pairs, join_if_near, l);
    for (size_t b = 0; b < l->besides; b++) drop_shapes(&l->cell[l->beside[b]]);
    return done && !l->failed && gis_go_on(error);
}

/* ---- Cells ------------------------------------------------------------------------------------------------------- */

static bool add_member(members *to, const member *m, gis_error *error)
{
    if (!gis_array_reserve(&to->at, &to->room, to->n + 1, sizeof *to->at)) return gis_no_memory(error);
    to->at[to->n++] = *m;
    return true;
}

static void clear_members(members *all)
{
    drop_shapes(all);
    free(all->at);
    *all = (members){0};
}

static bool take_member(search *l, const gis_spool_feature *feature, const double box[4], size_t vertices,
                        gis_error *error)
{
    member own = {.place = feature->place, .group = l->groups, .shape = (sunder_shape *)feature->demands.shape};
    for (int c = 0; c < 4; c++) own.box[c] = box[c] + (c < 2 ? -1 : 1) * l->reach / 2;
    if (gis_box_is_empty(box) || feature->demands.fixed) {
        sunder_shape_free(own.shape);
        return true;
    }
    if (!add_member(&l->here, &own, error)) {
        sunder_shape_free(own.shape);
        return false;
    }
    if (!add_group(l, box, vertices)) return gis_no_memory(error);
    join_block(l, feature->demands.block, own.group);
    return true;
}

static bool glance_at_feature(void *user, const gis_spool_feature *feature, const double box[4], size_t vertices,
                              gis_error *error)
{
    return take_member(user, feature, box, vertices, error);
}

static bool visit_feature(void *user, const gis_spool_feature *feature, gis_error *error)
{
    double box[4];
    sunder_shape_box(feature->demands.shape, box);
    return take_member(user, feature, box, sunder_shape_vertices(feature->demands.shape), error);
}

/* Keeps the members of the cell that are within reach of a later cell. */
static bool keep_border_members(search *l, size_t cell, gis_error *error)
{
    bool done = true;
    drop_shapes(&l->here);
    for (size_t k = 0; k < l->here.n && done; k++) {
        bool near = false;
        if (l->here.at[k].inside) continue;
        for (size_t b = l->besides; b-- > 0 && l->beside[b] > cell && !near;) {
            double box[4];
            box_of(l, l->beside[b], box);
            near = gis_box_meets(box, l->here.at[k].box);
        }
        done = !near || add_member(&l->cell[cell], &l->here.at[k], error);
    }
    l->here.n = 0;
    return done;
}

/* Finds the cells beside `cell`. They are found anew for each cell by comparing boxes, since a list of all pairs would
 * be long if large features lie everywhere. */
static bool find_beside(search *l, size_t cell, gis_error *error)
{
    double box[4], other[4];
    box_of(l, cell, box);
    l->besides = 0;
    for (size_t k = 0; k < gis_spool_cells(l->layout->spool); k++) {
        box_of(l, k, other);
        if (k == cell || !gis_box_meets(box, other)) continue;
        if (!gis_array_reserve(&l->beside, &l->beside_room, l->besides + 1, sizeof *l->beside))
            return gis_no_memory(error);
        l->beside[l->besides++] = k;
    }
    l->last[cell] = l->besides && l->beside[l->besides - 1] > cell ? l->beside[l->besides - 1] : cell;
    return true;
}

static bool visit_cell(search *l, size_t cell, gis_error *error)
{
    gis_spool *spool = l->layout->spool;
    const bool done = find_beside(l, cell, error) &&
                      (l->by_shapes ? gis_spool_read(spool, cell, visit_feature, l, error)
                                    : gis_spool_skim(spool, cell, glance_at_feature, l, error)) &&
                      join_cell(l, cell, error) && keep_border_members(l, cell, error);
    for (size_t b = 0; b < l->besides && l->beside[b] < cell; b++)
        if (l->last[l->beside[b]] == cell) clear_members(&l->cell[l->beside[b]]);
    return done;
}

static bool visit_cells(search *l, gis_error *error)
{
    bool done = true;
    l->enough_groups = MOST_GROUPS;
    for (size_t k = 0; k < gis_spool_cells(l->layout->spool) && done && l->patience > 0; k++) {
        done = visit_cell(l, k, error);
        if (done && l->groups > l->enough_groups) {
            done = drop_complete_groups(l, error);
            l->enough_groups = MOST_GROUPS + 2 * l->groups;
        }
    }
    for (size_t k = 0; k < l->groups && done; k++)
        if (l->parent[k] == k) consider_group(l, &l->group[k]);
    return done;
}

static void clear_search(search *l)
{
    for (size_t k = 0; l->cell && k < gis_spool_cells(l->layout->spool); k++) clear_members(&l->cell[k]);
    clear_members(&l->here);
    free(l->cell);
    free(l->swept);
    free(l->beside);
    free(l->last);
    free(l->group);
    free(l->parent);
    free(l->of_block);
    gis_box_pairs_clear(&l->pairs);
}

/* Finds the largest group. *whole is set to false if the limit of shape comparisons was reached. */
static bool find_largest_group(const gis_layout *layout, double reach, bool by_shapes, gis_contact_group *out,
                               bool *whole, gis_error *error)
{
    search l = {.layout = layout, .reach = reach, .by_shapes = by_shapes, .error = error};
    l.patience = patience * gis_spool_features(layout->spool) + 1;
    gis_box_clear(l.largest.box);
    l.of_block = malloc((layout->blocks + 1) * sizeof *l.of_block);
    l.cell = calloc(gis_spool_cells(layout->spool) + 1, sizeof *l.cell);
    l.last = calloc(gis_spool_cells(layout->spool) + 1, sizeof *l.last);
    for (size_t b = 0; l.of_block && b < layout->blocks; b++) l.of_block[b] = SIZE_MAX;
    const bool done = ((l.of_block && l.cell && l.last) || gis_no_memory(error)) && visit_cells(&l, error);
    *out = l.largest;
    *whole = l.patience > 0;
    clear_search(&l);
    return done;
}

bool gis_contact_group_find(const gis_layout *layout, double reach, double enough, gis_contact_group *out,
                            gis_error *error)
{
    gis_contact_group by_shapes;
    bool whole;
    if (!find_largest_group(layout, reach, false, out, &whole, error)) return false;
    if (bytes_of(layout, out) <= enough) return true;
    if (!find_largest_group(layout, reach, true, &by_shapes, &whole, error)) return false;
    if (whole) *out = by_shapes;
    return true;
}
