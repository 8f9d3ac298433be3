/* targets.c: the features that were moved, with their shapes before and after their moves. The shape before is the one
 * after, moved back; separate chooses moves for which both are exact in doubles, wherever there are such. */
#include "follow/follow.h"

#include "base/array.h"
#include "base/core_error.h"
#include "base/message.h"

#include <cpl_conv.h>
#include <cpl_quad_tree.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* ---- Features ---------------------------------------------------------------------------------------------------- */

static bool make_shapes(const gis_moved_feature *feature, gis_follow_target *out, gis_error *error)
{
    sunder_error why;
    bool exact;
    char who[GIS_WHO_SIZE];
    if (feature->now->polygons == 0) return true;
    if (gis_polygons_shape(feature->now, SUNDER_VALIDITY_EVEN_ODD, &out->now, &why) == SUNDER_OK &&
        sunder_shape_translate(out->now, -out->move[0], -out->move[1], &out->home, &exact, &why) == SUNDER_OK)
        return true;
    gis_name_subject(feature->subject, who, sizeof who);
    return gis_core_failed(error, who, &why);
}

bool gis_follow_add(gis_follow_targets *targets, gis_moved_feature *feature, gis_error *error)
{
    const size_t n = targets->n;
    bool ok =
        gis_array_reserve(&targets->target, &targets->capacity, n + 1, sizeof *targets->target) || gis_no_memory(error);
    if (!ok) {
        free(feature->block);
        CPLFree(feature->point);
        return false;
    }
    gis_follow_target *target = &targets->target[targets->n++];
    *target = (gis_follow_target){.point = feature->point,
                                  .points = feature->points,
                                  .move = {feature->move[0], feature->move[1]},
                                  .group = n,
                                  .hidden = feature->hidden,
                                  .fid = feature->fid,
                                  .layer = feature->layer,
                                  .block = feature->block};
    return make_shapes(feature, target, error);
}

/* ---- Groups ------------------------------------------------------------------------------------------------------ */

typedef struct in_block {
    const char *block;
    size_t target;
} in_block;

static int by_block(const void *a, const void *b)
{
    const in_block *p = a, *q = b;
    const int order = strcmp(p->block, q->block);
    return order ? order : (p->target > q->target) - (p->target < q->target);
}

/* Sets the groups: the visible features of equal blocks, and each other one by itself. A hidden member stayed when its
 * block moved. */
static bool find_groups(gis_follow_targets *out, gis_error *error)
{
    in_block *list = calloc(out->n + 1, sizeof *list);
    size_t n = 0;
    if (!list) return gis_no_memory(error);
    for (size_t i = 0; i < out->n; i++)
        if (out->target[i].block && !out->target[i].hidden) list[n++] = (in_block){out->target[i].block, i};
    qsort(list, n, sizeof *list, by_block);
    for (size_t k = 1; k < n; k++) {
        gis_follow_target *a = &out->target[list[k - 1].target], *b = &out->target[list[k].target];
        const bool same = a->move[0] == b->move[0] && a->move[1] == b->move[1];
        if (same && strcmp(a->block, b->block) == 0) b->group = a->group;
    }
    free(list);
    return true;
}

/* ---- Boxes ------------------------------------------------------------------------------------------------------- */

static void box_of(const gis_follow_target *target, double box[4])
{
    box[0] = box[1] = INFINITY;
    box[2] = box[3] = -INFINITY;
    if (target->home) sunder_shape_box(target->home, box);
    for (size_t k = 0; k < 2 * target->points; k++) {
        box[k & 1] = fmin(box[k & 1], target->point[k]);
        box[2 + (k & 1)] = fmax(box[2 + (k & 1)], target->point[k]);
    }
}

/* By how much a vertex at home may be off the one that the move was rounded for. */
static double rounding_of(const gis_follow_target *target, const double box[4])
{
    double most = 0;
    for (int k = 0; k < 4; k++) most = fmax(most, fmax(fabs(box[k]), fabs(box[k] + target->move[k & 1])));
    return nextafter(most, INFINITY) - most;
}

static bool make_tree(gis_follow_targets *out, gis_error *error)
{
    CPLRectObj all = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    out->box = malloc((out->n + 1) * 4 * sizeof *out->box);
    if (!out->box) return gis_no_memory(error);
    for (size_t i = 0; i < out->n; i++) {
        double *box = out->box + 4 * i;
        box_of(&out->target[i], box);
        const double rounding = box[0] <= box[2] ? rounding_of(&out->target[i], box) : 0;
        for (int k = 0; k < 4; k++) box[k] += k < 2 ? -rounding : rounding;
        all = (CPLRectObj){fmin(all.minx, box[0]), fmin(all.miny, box[1]), fmax(all.maxx, box[2]),
                           fmax(all.maxy, box[3])};
    }
    if (!(all.minx <= all.maxx)) return true;
    out->tree = CPLQuadTreeCreate(&all, NULL);
    if (!out->tree) return gis_no_memory(error);
    CPLQuadTreeSetMaxDepth(out->tree, CPLQuadTreeGetAdvisedMaxDepth(out->n < INT32_MAX ? (int)out->n : INT32_MAX));
    for (size_t i = 0; i < out->n; i++) {
        const double *box = out->box + 4 * i;
        const CPLRectObj bounds = {box[0], box[1], box[2], box[3]};
        if (box[0] <= box[2]) CPLQuadTreeInsertWithBounds(out->tree, (void *)(uintptr_t)i, &bounds);
    }
    return true;
}

static int by_number(const void *a, const void *b)
{
    const uintptr_t p = *(const uintptr_t *)a, q = *(const uintptr_t *)b;
    return (p > q) - (p < q);
}

bool gis_follow_near(const gis_follow_targets *targets, const double box[4], double reach,
                     bool (*look)(void *user, size_t target), void *user, gis_error *error)
{
    if (!targets->tree) return true;
    CPLRectObj about = {box[0] - reach, box[1] - reach, box[2] + reach, box[3] + reach};
    int n = 0;
    void **found = CPLQuadTreeSearch(targets->tree, &about, &n);
    if (!found && n > 0) return gis_no_memory(error);
    uintptr_t *number = (uintptr_t *)found;
    if (n > 0) qsort(number, (size_t)n, sizeof *number, by_number);
    for (int k = 0; k < n && look(user, number[k]); k++) {
    }
    CPLFree(found);
    return true;
}

bool gis_follow_was_vertex(const gis_follow_target *target, const sunder_point *at)
{
    const double *xy;
    const size_t *ring_end, *poly_end;
    if (!target->now) return false;
    const size_t polygons = sunder_shape_given(target->now, &xy, &ring_end, &poly_end);
    const size_t vertices = polygons ? ring_end[poly_end[polygons - 1] - 1] : 0;
    const double to[2] = {at->x + target->move[0], at->y + target->move[1]};
    for (size_t k = 0; k < vertices; k++)
        if (xy[2 * k] == to[0] && xy[2 * k + 1] == to[1]) return true;
    return false;
}

int gis_follow_side(const gis_follow_target *target, const sunder_point *at)
{
    if (gis_follow_was_vertex(target, at)) return 0;
    return target->home ? sunder_shape_locate(target->home, at) : -1;
}

/* ------------------------------------------------------------------------------------------------------------------ */

bool gis_follow_complete(gis_follow_targets *targets, gis_error *error)
{
    return find_groups(targets, error) && make_tree(targets, error);
}

void gis_follow_targets_clear(gis_follow_targets *targets)
{
    for (size_t i = 0; i < targets->n; i++) {
        sunder_shape_free(targets->target[i].home);
        sunder_shape_free(targets->target[i].now);
        CPLFree(targets->target[i].point);
        free(targets->target[i].block);
    }
    if (targets->tree) CPLQuadTreeDestroy(targets->tree);
    free(targets->target);
    free(targets->box);
    *targets = (gis_follow_targets){0};
}
