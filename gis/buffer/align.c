/* align.c: --align with --dissolve. A dissolved set is made block by block, and the shape is turned for each block
 * (turned_shape.c).
 *
 * A block is a group of features whose dilations by the shape as given are connected. Each block is dilated or eroded
 * by itself and rounded. Turned shapes may reach into other blocks, hence the results of the blocks are united, and the
 * crossings of the union are rounded once more. */
#include "buffer/buffer.h"

#include "base/core_error.h"

#include <cpl_conv.h>
#include <cpl_quad_tree.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* The interval [from, to] of the progress of `whole` that one stage takes. The stage reports, and can be stopped,
 * through it. */
typedef struct part {
    const sunder_sum_options *whole;
    double from, to;
} part;

static bool tell_part(double fraction, void *user)
{
    const part *p = user;
    return !p->whole->progress || p->whole->progress(p->from + (p->to - p->from) * fraction, p->whole->progress_user);
}

/* Rounds the sum to doubles if `status` is SUNDER_OK; else sets *error to the core's message `why`. */
static bool round_result(sunder_status status, const sunder_sum *sum, const sunder_error *why, gis_rounded *out,
                         gis_error *error)
{
    if (status != SUNDER_OK) return gis_core_failed(error, NULL, why);
    return gis_round_sum(sum, out, error);
}

/* The shares of the progress that the stages take: finding the blocks, and making them. The rest is the share of their
 * union. */
static const double find_share = 0.2, make_share = 0.6;

/* ---- Blocks ------------------------------------------------------------------------------------------------------ */

typedef struct in_block {
    size_t block, feature;
} in_block;

static int by_block(const void *a, const void *b)
{
    const in_block *p = a, *q = b;
    int order = (p->block > q->block) - (p->block < q->block);
    return order ? order : (p->feature > q->feature) - (p->feature < q->feature);
}

static bool is_within(const gis_polygons *set, size_t polygon, const double *at)
{
    bool in = false;
    for (size_t r = polygon ? set->poly_end[polygon - 1] : 0; r < set->poly_end[polygon]; r++)
        for (size_t first = r ? set->ring_end[r - 1] : 0, i = first; i < set->ring_end[r]; i++) {
            const double *a = set->xy + 2 * i, *b = set->xy + 2 * (i + 1 < set->ring_end[r] ? i + 1 : first);
            if ((a[1] > at[1]) != (b[1] > at[1]) && at[0] < a[0] + (at[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
                in = !in;
        }
    return in;
}

static CPLRectObj box_of(const gis_polygons *set, size_t polygon)
{
    CPLRectObj box = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    size_t r = polygon ? set->poly_end[polygon - 1] : 0;
    for (size_t i = r ? set->ring_end[r - 1] : 0; i < set->ring_end[r]; i++) {
        box.minx = fmin(box.minx, set->xy[2 * i]);
        box.miny = fmin(box.miny, set->xy[2 * i + 1]);
        box.maxx = fmax(box.maxx, set->xy[2 * i]);
        box.maxy = fmax(box.maxy, set->xy[2 * i + 1]);
    }
    return box;
}

/* A quadtree of the bounding boxes of all polygons; its items are the numbers of the polygons. */
static CPLQuadTree *index_of(const gis_polygons *set)
{
    CPLRectObj all = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (size_t p = 0; p < set->polygons; p++) {
        const CPLRectObj box = box_of(set, p);
        all = (CPLRectObj){fmin(all.minx, box.minx), fmin(all.miny, box.miny), fmax(all.maxx, box.maxx),
                           fmax(all.maxy, box.maxy)};
    }
    CPLQuadTree *index = CPLQuadTreeCreate(&all, NULL);
    for (size_t p = 0; index && p < set->polygons; p++) {
        const CPLRectObj box = box_of(set, p);
        CPLQuadTreeInsertWithBounds(index, (void *)(uintptr_t)p, &box);
    }
    return index;
}

/* Returns the polygon of the dilation that contains the point `at`, or set->polygons if none does. `at` is the first
 * vertex of a feature, moved by an interior point of the shape, hence it is interior to the dilation. */
static size_t block_of(const gis_polygons *set, const CPLQuadTree *index, const double *at)
{
    const CPLRectObj here = {at[0], at[1], at[0], at[1]};
    int n;
    size_t found = set->polygons;
    void **candidate = CPLQuadTreeSearch(index, &here, &n);
    for (int i = 0; i < n && found == set->polygons; i++)
        if (is_within(set, (size_t)(uintptr_t)candidate[i], at)) found = (size_t)(uintptr_t)candidate[i];
    CPLFree(candidate);
    return found;
}

/* Assigns each member of the set that has polygons to a block, and sorts members[0..*n) by block. */
static bool find_blocks(const gis_buffer *buffer, const gis_buffer_set *set, const sunder_sum_options *how,
                        in_block *members, size_t *n, double *deviation, gis_error *error)
{
    part first = {how, 0, find_share};
    const sunder_sum_options stage = {
        .size = sizeof stage, .progress = tell_part, .progress_user = &first, .threads = how->threads};
    sunder_shape *joined;
    sunder_sum *sum = NULL;
    sunder_error why;
    gis_rounded grown = {0};
    if (!gis_buffer_join(buffer, set, &joined, deviation, error)) return false;
    sunder_status status = sunder_minkowski_sum(joined, buffer->shape, &stage, &sum, &why);
    bool ok = round_result(status, sum, &why, &grown, error);
    CPLQuadTree *index = ok ? index_of(&grown.set) : NULL;
    ok = ok && (index || gis_no_memory(error));
    double inner[2];
    sunder_shape_anchor(buffer->shape, inner);
    *n = 0;
    for (size_t i = 0; ok && i < set->members; i++) {
        const sunder_shape *shape = buffer->input.shape[set->member[i]];
        if (!shape || sunder_shape_is_empty(shape)) continue;
        size_t corners;
        const double *corner = sunder_shape_ring(shape, 0, 0, &corners);
        const double at[2] = {corner[0] + inner[0], corner[1] + inner[1]};
        members[(*n)++] = (in_block){block_of(&grown.set, index, at), set->member[i]};
    }
    qsort(members, *n, sizeof *members, by_block);
    if (index) CPLQuadTreeDestroy(index);
    gis_rounded_clear(&grown);
    sunder_sum_free(sum);
    sunder_shape_free(joined);
    return ok;
}

/* Adds the result of a block to that of the set: its polygons to `polygons`, its deviation, repairs, segments and
 * points to `all`. */
static bool append_block(gis_buffer_set *all, const gis_buffer_set *block, gis_polygons *polygons, gis_error *error)
{
    if (!gis_polygons_append_all(polygons, &block->result.set, error)) return false;
    all->result.deviation = fmax(all->result.deviation, block->result.deviation);
    all->result.repaired += block->result.repaired;
    double *segment = realloc(all->segment, (4 * (all->segments + block->segments) + 1) * sizeof *segment);
    if (segment) all->segment = segment;
    double *point = realloc(all->point, (2 * (all->points + block->points) + 1) * sizeof *point);
    if (point) all->point = point;
    if (!segment || !point) return gis_no_memory(error);
    if (block->segments) memcpy(segment + 4 * all->segments, block->segment, 4 * block->segments * sizeof *segment);
    if (block->points) memcpy(point + 2 * all->points, block->point, 2 * block->points * sizeof *point);
    all->segments += block->segments;
    all->points += block->points;
    return true;
}

/* Unites the polygons of the blocks, which may overlap; the result becomes all->result. */
static bool unite_blocks(gis_buffer_set *all, const gis_polygons *polygons, const sunder_sum_options *how,
                         gis_error *error)
{
    part last = {how, find_share + make_share, 1};
    const sunder_sum_options stage = {
        .size = sizeof stage, .progress = tell_part, .progress_user = &last, .threads = how->threads};
    sunder_shape *shape;
    sunder_sum *sum = NULL;
    sunder_error why;
    gis_rounded united = {0};
    if (gis_polygons_shape(polygons, SUNDER_VALIDITY_STRICT, &shape, &why) != SUNDER_OK)
        return gis_core_failed(error, NULL, &why);
    sunder_status status = sunder_shape_union(shape, &stage, &sum, &why);
    bool ok = round_result(status, sum, &why, &united, error);
    if (ok) {
        united.deviation += all->result.deviation;
        united.repaired += all->result.repaired;
        all->result = united;
        all->area = gis_polygons_area(&united.set);
    }
    sunder_sum_free(sum);
    sunder_shape_free(shape);
    return ok;
}

bool gis_buffer_make_blocks(const gis_buffer *buffer, gis_buffer_set *set, const sunder_sum_options *how,
                            gis_error *error)
{
    size_t n, *feature = malloc((set->members + 1) * sizeof *feature);
    in_block *members = malloc((set->members + 1) * sizeof *members);
    gis_polygons polygons = {0};
    double before = 0;
    bool ok =
        ((feature && members) || gis_no_memory(error)) && find_blocks(buffer, set, how, members, &n, &before, error);
    for (size_t i = 0; ok && i < n; i++) feature[i] = members[i].feature;
    set->none = ok && n == 0;
    for (size_t i = 0, end; ok && i < n; i = end) {
        for (end = i + 1; end < n && members[end].block == members[i].block;) end++;
        gis_buffer_set block = {.member = feature + i, .members = end - i};
        part middle = {how, find_share + make_share * (double)i / (double)n,
                       find_share + make_share * (double)end / (double)n};
        const sunder_sum_options stage = {
            .size = sizeof stage, .progress = tell_part, .progress_user = &middle, .threads = how->threads};
        ok = gis_buffer_make_set(buffer, &block, &stage, error) && append_block(set, &block, &polygons, error);
        gis_buffer_set_clear(&block);
    }
    ok = ok && (set->none || unite_blocks(set, &polygons, how, error));
    if (ok) set->result.deviation += before;
    gis_polygons_clear(&polygons);
    free(members);
    free(feature);
    return ok;
}
