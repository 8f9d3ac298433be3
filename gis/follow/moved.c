/* moved.c: the features of MOVED, with their shapes before and after their moves. The shape before is the one after,
 * moved back; separate chooses moves for which both are exact in doubles, wherever there are such. */
#include "follow/follow.h"

#include "base/core_error.h"
#include "base/interrupt.h"
#include "base/message.h"
#include "read/fields.h"

#include <cpl_conv.h>
#include <cpl_quad_tree.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef struct columns {
    int dx, dy, block, hidden;
} columns;

/* ---- The layer --------------------------------------------------------------------------------------------------- */

static bool is_result(OGRLayerH layer)
{
    OGRFeatureDefnH fields = OGR_L_GetLayerDefn(layer);
    return OGR_FD_GetFieldIndex(fields, "sunder_dx") >= 0 && OGR_FD_GetFieldIndex(fields, "sunder_dy") >= 0;
}

/* Sets *name, to be freed with CPLFree(), to that of the only layer that has the fields of a result; it stays NULL if
 * there is none or more than one, which opening the source with the name of no layer reports. */
static bool find_layer(const gis_source_request *request, char **name, gis_error *error)
{
    GDALDatasetH dataset =
        GDALOpenEx(request->path, GDAL_OF_VECTOR | GDAL_OF_READONLY, request->drivers, request->open_options, NULL);
    size_t found = 0;
    bool ok = true;
    for (int i = 0; dataset && i < GDALDatasetGetLayerCount(dataset); i++) {
        OGRLayerH layer = GDALDatasetGetLayer(dataset, i);
        if (!layer || !is_result(layer)) continue;
        if (found++ == 0) *name = CPLStrdup(OGR_L_GetName(layer));
    }
    if (dataset && found != 1) {
        ok = gis_fail_usage(error, "MOVED (%s): %s has the fields sunder_dx and sunder_dy of a result of separate",
                            request->path, found ? "more than one layer" : "no layer");
        CPLFree(*name);
        *name = NULL;
    }
    GDALClose(dataset);
    return ok;
}

static bool open_moved(const gis_follow_request *request, gis_source **out, gis_error *error)
{
    gis_source_request moved = request->moved;
    char *name = NULL;
    bool ok = find_layer(&moved, &name, error);
    moved.layer = name;
    moved.takes = GIS_TAKES_POLYGONS | GIS_TAKES_POINTS;
    moved.not_finite = GIS_NOT_FINITE_LEFT_OUT;
    ok = ok && gis_source_open(&moved, out, error);
    CPLFree(name);
    if (ok) gis_say_warnings(GIS_MESSAGE_INPUT, gis_source_warnings(*out));
    return ok;
}

/* ---- Features ---------------------------------------------------------------------------------------------------- */

static void name_target(const gis_source *source, size_t i, char *text, size_t size)
{
    const GIntBig fid = gis_source_fid(source, i);
    const gis_subject subject = {"MOVED", gis_source_name(source), fid != OGRNullFID, fid, i, NULL};
    gis_name_subject(&subject, text, size);
}

static bool read_move(const gis_source *source, size_t i, const columns *at, gis_follow_target *out, gis_error *error)
{
    OGRFeatureH feature = gis_source_feature(source, i);
    const int field[2] = {at->dx, at->dy};
    for (int k = 0; k < 2; k++) {
        if (gis_field_is_blank(feature, field[k])) continue; /* a skipped feature, which did not move */
        out->move[k] = gis_field_number(feature, field[k]);
        if (isfinite(out->move[k])) continue;
        char who[GIS_WHO_SIZE], value[GIS_FIELD_TEXT_SIZE];
        name_target(source, i, who, sizeof who);
        gis_field_text(feature, field[k], value);
        return gis_fail(error, "%s: %s is %s, which is no move", who, k ? "sunder_dy" : "sunder_dx", value);
    }
    out->hidden =
        at->hidden >= 0 && !gis_field_is_blank(feature, at->hidden) && gis_field_number(feature, at->hidden) != 0;
    return true;
}

/* Makes the shapes of a target with polygons, or finds its vertices. */
static bool read_shape(const gis_source *source, size_t i, gis_polygonal_part *part, gis_follow_target *out,
                       gis_error *error)
{
    OGRGeometryH geometry = gis_source_geometry(source, i);
    sunder_error why;
    bool exact;
    if (!gis_geometry_polygonal_part(geometry, part, error)) return false;
    if (part->set.polygons == 0) {
        if (!gis_geometry_points(geometry, &out->point, &out->points, error)) return false;
        for (size_t k = 0; k < 2 * out->points; k++) out->point[k] -= out->move[k & 1];
        return true;
    }
    if (gis_polygons_shape(&part->set, SUNDER_VALIDITY_EVEN_ODD, &out->now, &why) == SUNDER_OK &&
        sunder_shape_translate(out->now, -out->move[0], -out->move[1], &out->home, &exact, &why) == SUNDER_OK)
        return true;
    char who[GIS_WHO_SIZE];
    name_target(source, i, who, sizeof who);
    return gis_core_failed(error, who, &why);
}

/* ---- Groups ------------------------------------------------------------------------------------------------------ */

typedef struct in_block {
    char *block; /* owned */
    size_t target;
} in_block;

static int by_block(const void *a, const void *b)
{
    const in_block *p = a, *q = b;
    const int order = strcmp(p->block, q->block);
    return order ? order : (p->target > q->target) - (p->target < q->target);
}

/* Sets the groups: the visible features with equal values of the block field, and each other one by itself. A hidden
 * member stayed when its block moved. */
static bool find_groups(gis_follow_targets *out, int field, gis_error *error)
{
    in_block *list = calloc(out->n + 1, sizeof *list);
    size_t n = 0;
    bool ok = list != NULL || gis_no_memory(error);
    for (size_t i = 0; ok && i < out->n; i++) {
        OGRFeatureH feature = gis_source_feature(out->source, i);
        out->target[i].group = i;
        if (field < 0 || out->target[i].hidden || gis_field_is_blank(feature, field)) continue;
        list[n] = (in_block){gis_field_key(feature, field), i};
        ok = list[n++].block != NULL || gis_no_memory(error);
    }
    if (ok) qsort(list, n, sizeof *list, by_block);
    for (size_t k = 1; ok && k < n; k++) {
        gis_follow_target *a = &out->target[list[k - 1].target], *b = &out->target[list[k].target];
        const bool same = a->move[0] == b->move[0] && a->move[1] == b->move[1];
        if (same && strcmp(list[k - 1].block, list[k].block) == 0) b->group = a->group;
    }
    for (size_t k = 0; list && k < n; k++) free(list[k].block);
    free(list);
    return ok;
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

bool gis_follow_read_moved(const gis_follow_request *request, gis_follow_targets *out, gis_error *error)
{
    *out = (gis_follow_targets){0};
    if (!open_moved(request, &out->source, error)) return false;
    const columns at = {gis_source_field(out->source, "sunder_dx"), gis_source_field(out->source, "sunder_dy"),
                        gis_source_field(out->source, "sunder_blk"), gis_source_field(out->source, "sunder_inv")};
    gis_polygonal_part part = {0};
    out->n = gis_source_count(out->source);
    out->target = calloc(out->n + 1, sizeof *out->target);
    bool ok = out->target != NULL || gis_no_memory(error);
    for (size_t i = 0; ok && i < out->n; i++)
        ok = gis_go_on(error) && read_move(out->source, i, &at, &out->target[i], error) &&
             read_shape(out->source, i, &part, &out->target[i], error);
    gis_polygonal_part_clear(&part);
    return ok && find_groups(out, at.block, error) && make_tree(out, error);
}

void gis_follow_targets_clear(gis_follow_targets *targets)
{
    for (size_t i = 0; targets->target && i < targets->n; i++) {
        sunder_shape_free(targets->target[i].home);
        sunder_shape_free(targets->target[i].now);
        CPLFree(targets->target[i].point);
    }
    if (targets->tree) CPLQuadTreeDestroy(targets->tree);
    free(targets->target);
    free(targets->box);
    gis_source_close(targets->source);
    *targets = (gis_follow_targets){0};
}
