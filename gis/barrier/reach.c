/* reach.c: what of a barrier layer may be in the way of anything. A barrier is within reach if some feature that goes
 * as far as any may comes as near to it as half its width and its distance. That is asked of boxes in a tree, so that
 * what lies between features far from each other is not read for both. */
#include "barrier/barrier.h"

#include "base/interrupt.h"
#include "read/fields.h"

#include <cpl_conv.h>
#include <cpl_quad_tree.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>

struct gis_barrier_targets {
    double (*box)[4];
    size_t n;
    CPLQuadTree *tree; /* of the boxes; NULL: there are none */
};

static void bounds_of(const void *box, CPLRectObj *out)
{
    const double *b = box;
    *out = (CPLRectObj){b[0], b[1], b[2], b[3]};
}

gis_barrier_targets *gis_barrier_targets_new(const double (*box)[4], size_t n)
{
    gis_barrier_targets *targets = calloc(1, sizeof *targets);
    double(*copy)[4] = calloc(n + 1, sizeof *copy);
    if (!targets || !copy) {
        free(targets);
        free(copy);
        return NULL;
    }
    *targets = (gis_barrier_targets){.box = copy, .n = n};
    CPLRectObj all = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < n; i++) {
        for (int k = 0; k < 4; k++) copy[i][k] = box[i][k];
        all = (CPLRectObj){fmin(all.minx, box[i][0]), fmin(all.miny, box[i][1]), fmax(all.maxx, box[i][2]),
                           fmax(all.maxy, box[i][3])};
    }
    if (n == 0) return targets;
    targets->tree = CPLQuadTreeCreate(&all, bounds_of);
    CPLQuadTreeSetMaxDepth(targets->tree, CPLQuadTreeGetAdvisedMaxDepth(n < INT_MAX ? (int)n : INT_MAX));
    for (size_t i = 0; i < n; i++) CPLQuadTreeInsert(targets->tree, copy[i]);
    return targets;
}

void gis_barrier_targets_free(gis_barrier_targets *targets)
{
    if (!targets) return;
    if (targets->tree) CPLQuadTreeDestroy(targets->tree);
    free(targets->box);
    free(targets);
}

/* A box grown by so much on all sides; rounded outward, as the sums are off by less. */
static void grow(const double box[4], double by, double out[4])
{
    for (int k = 0; k < 4; k++) {
        const double to = k < 2 ? -INFINITY : INFINITY;
        out[k] = nextafter(nextafter(box[k] + (k < 2 ? -by : by), to), to);
    }
}

bool gis_barrier_is_near(const gis_barrier_surroundings *around, const double box[4], double distance)
{
    double grown[4];
    int n = 0;
    if (!around->targets->tree) return false;
    grow(box, around->reach + distance, grown);
    if (!isfinite(around->reach + distance)) return true;
    const CPLRectObj asked = {grown[0], grown[1], grown[2], grown[3]};
    CPLFree(CPLQuadTreeSearch(around->targets->tree, &asked, &n));
    return n > 0;
}

bool gis_barrier_reach_box(const gis_barrier_surroundings *around, double distance, double box[4])
{
    const gis_barrier_targets *targets = around->targets;
    double all[4] = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < targets->n; i++)
        for (int k = 0; k < 4; k++) all[k] = (k < 2 ? fmin : fmax)(all[k], targets->box[i][k]);
    grow(all, around->reach + distance, box);
    return isfinite(around->reach + distance);
}

bool gis_barrier_greatest(OGRLayerH layer, const char *field, double *greatest)
{
    static const char *geometry[] = {"OGR_GEOMETRY", NULL};
    const int at = OGR_FD_GetFieldIndex(OGR_L_GetLayerDefn(layer), field);
    const bool ignores = OGR_L_TestCapability(layer, OLCIgnoreFields);
    bool ok = at >= 0;
    *greatest = 0;
    if (!ok || (ignores && OGR_L_SetIgnoredFields(layer, geometry) != OGRERR_NONE)) return false;
    OGR_L_ResetReading(layer);
    for (OGRFeatureH feature; ok && (feature = OGR_L_GetNextFeature(layer)) != NULL; OGR_F_Destroy(feature)) {
        const double width = gis_field_is_blank(feature, at) ? 0 : gis_field_number(feature, at);
        if (width > *greatest) *greatest = width;
        ok = isfinite(width) && !gis_interrupted();
    }
    if (ignores) OGR_L_SetIgnoredFields(layer, NULL);
    return ok;
}
