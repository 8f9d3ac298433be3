/* members.c: the polygons of a set are grouped by the bounding boxes of their sums with the other operand: polygons of
 * different groups have sums without a common point. A small group is computed as one curve, if the other operand or
 * all of its polygons are convex. */
#include "minkowski/members.h"

#include "base/extremes.h"
#include "base/sort.h"
#include "base/union_find.h"
#include "base/watch.h"
#include "minkowski/convolution.h"
#include "predicate/narrow.h"
#include "spatial/rtree.h"

#include <math.h>
#include <string.h>

/* The method is declined if the box of each polygon's sum overlaps more than this number of these boxes on average, its
 * own included, since then there are large groups, or only one. */
#define MOST_MEETINGS 32

typedef struct grouper {
    const sunder_shape *many, *one;
    const sunder_i_point *at_many, *at_one;
    double (*box)[4]; /* [n] the box of each polygon's sum */
    uint32_t *group;  /* [n] a union-find forest, see base/union_find.h */
    uint32_t *order;  /* [n] the polygons, group by group */
    uint32_t n;
    bool one_convex;
    sunder_i_members_left *left;
} grouper;

static uint32_t first_ring(const sunder_shape *s, uint32_t polygon)
{
    return polygon ? s->form->cleaned.poly_end[polygon - 1] : 0;
}
static uint32_t first_vertex(const sunder_shape *s, uint32_t ring)
{
    return ring ? s->form->cleaned.ring_end[ring - 1] : 0;
}

/* Returns true if the polygon has one ring, which turns left at every vertex. */
static bool is_convex(const sunder_shape *s, const sunder_i_point *at, uint32_t polygon)
{
    const uint32_t ring = first_ring(s, polygon);
    if (s->form->cleaned.poly_end[polygon] - ring > 1) return false;
    for (uint32_t v = first_vertex(s, ring); v < s->form->cleaned.ring_end[ring]; v++)
        if (sunder_i_narrow_orient(at[s->form->cleaned.prev[v]], at[v], at[s->form->cleaned.next[v]]) <= 0)
            return false;
    return true;
}

/* ---- Groups ---- */

/* Adds the box of a polygon to `box`. Doubles have a relative error of at most 2^-53, so that the widened boxes of two
 * sums with a common point overlap. */
static void add_box(const sunder_shape *s, const sunder_i_point *at, uint32_t polygon, double box[4])
{
    const uint32_t ring = first_ring(s, polygon), begin = first_vertex(s, ring);
    sunder_i_point low = at[begin], high = low;
    for (uint32_t v = begin + 1; v < s->form->cleaned.ring_end[ring]; v++) {
        if (at[v].x < low.x) low.x = at[v].x;
        if (at[v].x > high.x) high.x = at[v].x;
        if (at[v].y < low.y) low.y = at[v].y;
        if (at[v].y > high.y) high.y = at[v].y;
    }
    box[0] += (double)low.x;
    box[1] += (double)low.y;
    box[2] += (double)high.x;
    box[3] += (double)high.y;
}

static void make_boxes(const grouper *g)
{
    double one[4] = {0, 0, 0, 0}, most = 0;
    add_box(g->one, g->at_one, 0, one);
    for (uint32_t i = 0; i < g->n; i++) {
        memcpy(g->box[i], one, sizeof one);
        add_box(g->many, g->at_many, i, g->box[i]);
        for (int k = 0; k < 4; k++) most = sunder_i_max(most, fabs(g->box[i][k]) + fabs(one[k]));
    }
    for (uint32_t i = 0; i < g->n; i++)
        for (int k = 0; k < 4; k++) g->box[i][k] += (k < 2 ? -1 : 1) * 0x1p-48 * most;
}

/* Joins polygons with overlapping boxes; *fits becomes false if there are too many overlaps. Fails with
 * SUNDER_ENOMEM. */
static sunder_status join_groups(grouper *g, bool *fits, sunder_error *err)
{
    sunder_i_rtree tree;
    sunder_i_list hits = {0};
    size_t meetings = 0;
    sunder_status status = sunder_i_rtree_build((const double *)g->box, NULL, g->n, &tree, err);
    if (status != SUNDER_OK) return status;
    sunder_i_union_init(g->group, g->n);
    *fits = true;
    for (uint32_t i = 0; i < g->n && *fits && status == SUNDER_OK; i++) {
        hits.n = 0;
        if (!sunder_i_rtree_query(&tree, g->box[i], &hits) || !sunder_i_step()) status = sunder_i_failure_cause(err);
        for (size_t k = 0; k < hits.n; k++) sunder_i_union_join(g->group, i, hits.item[k]);
        meetings += hits.n;
        *fits = meetings <= (size_t)MOST_MEETINGS * g->n;
    }
    sunder_i_free(hits.item);
    sunder_i_rtree_free(&tree);
    return status;
}

/* Sorts the polygons by group, and by number within a group. Returns false if out of memory. */
static bool order_members(grouper *g)
{
    uint64_t *key = sunder_i_alloc(g->n, sizeof *key);
    if (!key) return false;
    for (uint32_t i = 0; i < g->n; i++) key[i] = (uint64_t)sunder_i_union_find(g->group, i) << 32 | i;
    const bool ok = sunder_i_sort_keys(key, g->n);
    for (uint32_t i = 0; ok && i < g->n; i++) g->order[i] = (uint32_t)key[i];
    sunder_i_free(key);
    return ok;
}

/* ---- Rounds ---- */

/* Makes the rounds of the polygons order[from .. to - 1]. Returns false if one of them has no convex operand, or if
 * there are too many. */
static bool make_rounds(const grouper *g, uint32_t from, uint32_t to, sunder_i_round round[SUNDER_I_MOST_CURVES])
{
    size_t rings = 0;
    if (to - from > SUNDER_I_MOST_CURVES) return false;
    for (uint32_t i = from; i < to; i++) {
        const uint32_t m = g->order[i];
        const sunder_i_round straight = {g->many, g->one, g->at_many, g->at_one, m, 0};
        const sunder_i_round turned = {g->one, g->many, g->at_one, g->at_many, 0, m};
        if (!g->one_convex && !is_convex(g->many, g->at_many, m)) return false;
        round[i - from] = g->one_convex ? straight : turned;
        rings +=
            g->one_convex ? g->many->form->cleaned.poly_end[m] - first_ring(g->many, m) : g->one->form->cleaned.rings;
    }
    return rings <= SUNDER_I_MOST_CURVES;
}

static sunder_status trace_groups(const grouper *g, sunder_i_traced *traced, sunder_error *err)
{
    sunder_i_round round[SUNDER_I_MOST_CURVES];
    for (uint32_t i = 0, k; i < g->n; i = k) {
        bool done = false;
        const uint32_t group = sunder_i_union_find(g->group, g->order[i]);
        for (k = i + 1; k < g->n && sunder_i_union_find(g->group, g->order[k]) == group;) k++;
        if (make_rounds(g, i, k, round)) {
            const sunder_status status = sunder_i_convolution_trace(traced, round, k - i, &done, err);
            if (status != SUNDER_OK) return status;
        }
        for (uint32_t m = i; m < k; m++) g->left->polygon[g->order[m]] = !done;
        g->left->n += done ? 0 : k - i;
        if (!sunder_i_step()) return sunder_i_failure_cause(err);
    }
    return SUNDER_OK;
}

static sunder_status trace_members(const grouper *g, sunder_sum *sum, sunder_error *err)
{
    sunder_i_traced traced = {.sum = sum};
    const sunder_status status = trace_groups(g, &traced, err);
    const sunder_status end = sunder_i_traced_end(&traced, status == SUNDER_OK && g->left->n < g->n, err);
    return status == SUNDER_OK ? end : status;
}

sunder_status sunder_i_members_sum(sunder_sum *sum, const sunder_shape *many, const sunder_i_point *at_many,
                                   const sunder_shape *one, const sunder_i_point *at_one, sunder_i_members_left *left,
                                   sunder_error *err)
{
    sunder_i_arena arena = {0};
    const uint32_t n = many->form->cleaned.polygons;
    *left = (sunder_i_members_left){NULL, n};
    if (!sum->lattice.narrow || many->flat || one->flat) return SUNDER_OK;
    grouper g = {.many = many,
                 .one = one,
                 .at_many = at_many,
                 .at_one = at_one,
                 .box = sunder_i_arena_alloc(&arena, n, sizeof *g.box),
                 .group = sunder_i_arena_alloc(&arena, n, sizeof *g.group),
                 .order = sunder_i_arena_alloc(&arena, n, sizeof *g.order),
                 .n = n,
                 .one_convex = is_convex(one, at_one, 0),
                 .left = left};
    bool fits;
    sunder_status status = arena.failed ? sunder_i_failure_cause(err) : SUNDER_OK;
    if (status == SUNDER_OK) {
        make_boxes(&g);
        status = join_groups(&g, &fits, err);
    }
    if (status == SUNDER_OK && fits) {
        left->polygon = sunder_i_alloc(n, sizeof *left->polygon);
        left->n = 0;
        status = left->polygon && order_members(&g) ? trace_members(&g, sum, err) : sunder_i_failure_cause(err);
    }
    sunder_i_arena_free(&arena);
    return status;
}

bool sunder_i_members_view_init(const sunder_shape *many, const bool *polygon, sunder_shape *view)
{
    const size_t room = many->pieces ? many->piece_end[many->pieces - 1] : 0;
    const uint32_t *from = sunder_i_piece_vertices(many);
    uint32_t *end = sunder_i_alloc(many->pieces + room, sizeof *end), pieces = 0, corners = 0, at = 0;
    bool *wanted = sunder_i_alloc(many->vertices, sizeof *wanted);
    *view = *many;
    view->piece_end = end;
    if (!end || !wanted) {
        sunder_i_free(wanted);
        sunder_i_members_view_free(view);
        return false;
    }
    for (uint32_t p = 0; p < many->form->cleaned.polygons; p++)
        for (const uint32_t past = many->form->cleaned.ring_end[many->form->cleaned.poly_end[p] - 1]; at < past; at++)
            wanted[at] = polygon[p];
    uint32_t *vertex = end + many->pieces;
    for (uint32_t i = 0, k = 0; i < many->pieces; i++) {
        const bool takes = wanted[from[k]];
        for (; k < many->piece_end[i]; k++)
            if (takes) vertex[corners++] = from[k];
        if (takes) end[pieces++] = corners;
    }
    memmove(end + pieces, vertex, corners * sizeof *end); /* the vertices follow the ends directly */
    view->pieces = pieces;
    sunder_i_free(wanted);
    return true;
}

void sunder_i_members_view_free(sunder_shape *view) { sunder_i_free((void *)(uintptr_t)view->piece_end); }
