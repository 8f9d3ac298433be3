/* barrier_reach.c: which barriers may be in the way of a feature. A barrier is within reach if some feature, after the
 * longest move, may come as near to it as half its width plus its gap, or if the barrier may decide on which side of it
 * a feature stands (sunder_side_reach()). A tree of the features' boxes is searched, so that barriers between groups of
 * features that are far apart are not read. If the features are in cells on disk, the tree contains the cells, and the
 * boxes of a cell's features are read when needed; CELLS_HELD cells are cached. */
#include "layer/barriers/barrier.h"

#include "base/interrupt.h"
#include "geometry/gis_box.h"
#include "read/fields.h"

#include <cpl_conv.h>
#include <cpl_quad_tree.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CELLS_HELD = 2048 };

/* A cache of the boxes of CELLS_HELD cells; the oldest is dropped first. */
typedef struct looked_up {
    gis_box_cells from;
    double (**box)[4]; /* [from.cells] NULL: not in the cache */
    size_t *n;
    size_t *number; /* [boxes of the tree] number of the cell that each belongs to */
    size_t held[CELLS_HELD], at;
    bool failed;
    gis_error error;
} looked_up;

struct gis_barrier_targets {
    double (*box)[4];
    size_t n;
    CPLQuadTree *tree; /* of the boxes; NULL: there are none */
    looked_up *cells;  /* NULL: the boxes are those of features */
};

static void bounds_of(const void *box, CPLRectObj *out)
{
    const double *b = box;
    *out = (CPLRectObj){b[0], b[1], b[2], b[3]};
}

void gis_barrier_target_grow(double box[4], double side_reach, double reach)
{
    const double by = side_reach - reach;
    if (by > 0)
        for (int k = 0; k < 4; k++) box[k] += k < 2 ? -by : by;
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

/* ---- Boxes in cells ---------------------------------------------------------------------------------------------- */

static void free_cells(looked_up *cells)
{
    for (size_t k = 0; cells->box && k < cells->from.cells; k++) free(cells->box[k]);
    free(cells->box);
    free(cells->n);
    free(cells->number);
    free(cells);
}

static bool look_up(looked_up *cells, size_t cell)
{
    size_t *place = &cells->held[cells->at];
    if (cells->box[cell]) return true;
    if (*place != SIZE_MAX) {
        free(cells->box[*place]);
        cells->box[*place] = NULL;
    }
    cells->at = (cells->at + 1) % CELLS_HELD;
    *place = cell;
    cells->box[cell] = malloc((cells->from.boxes(cells->from.of, cell) + 1) * sizeof **cells->box);
    if (!cells->box[cell])
        gis_no_memory(&cells->error);
    else if (cells->from.read(cells->from.of, cell, cells->box[cell], &cells->n[cell], &cells->error)) {
        for (size_t k = 0; k < cells->n[cell]; k++) {
            double *box = cells->box[cell][k];
            gis_barrier_target_grow(box, sunder_side_reach(box), cells->from.reach);
        }
        return true;
    }
    cells->failed = true;
    return false;
}

/* The box around the boxes of a cell's features after gis_barrier_target_grow(). */
static void box_of_cell(looked_up *cells, size_t cell, double out[4])
{
    memcpy(out, cells->from.around(cells->from.of, cell), 4 * sizeof *out);
    /* no box of the cell is enlarged */
    if (!(sunder_side_reach(out) > cells->from.reach) || !look_up(cells, cell)) return;
    for (size_t k = 0; k < cells->n[cell]; k++)
        for (int c = 0; c < 4; c++) out[c] = (c < 2 ? fmin : fmax)(out[c], cells->box[cell][k][c]);
}

/* Lists the cells that are not empty, and sets *box to their boxes, *n to their number. */
static looked_up *list_cells(const gis_box_cells *from, double (*box)[4], size_t *n)
{
    const size_t cells = from->cells;
    looked_up *out = calloc(1, sizeof *out);
    if (!out) return NULL;
    *out = (looked_up){.from = *from,
                       .box = calloc(cells + 1, sizeof *out->box),
                       .n = calloc(cells + 1, sizeof *out->n),
                       .number = calloc(cells + 1, sizeof *out->number)};
    if (!out->box || !out->n || !out->number) {
        free_cells(out);
        return NULL;
    }
    for (size_t k = 0; k < CELLS_HELD; k++) out->held[k] = SIZE_MAX;
    *n = 0;
    for (size_t k = 0; k < cells; k++) {
        const double *own = from->around(from->of, k);
        if (!(own[0] <= own[2])) continue;
        box_of_cell(out, k, box[*n]);
        out->number[(*n)++] = k;
    }
    return out;
}

gis_barrier_targets *gis_barrier_targets_of_cells(const gis_box_cells *from)
{
    size_t n;
    double(*box)[4] = calloc(from->cells + 1, sizeof *box);
    looked_up *cells = box ? list_cells(from, box, &n) : NULL;
    gis_barrier_targets *targets = cells ? gis_barrier_targets_new((const double(*)[4])box, n) : NULL;
    free(box);
    if (targets)
        targets->cells = cells;
    else if (cells)
        free_cells(cells);
    return targets;
}

bool gis_barrier_targets_sound(const gis_barrier_targets *targets, gis_error *error)
{
    if (!targets->cells || !targets->cells->failed) return true;
    *error = targets->cells->error;
    return false;
}

/* Does the box of a feature of the cell meet `box`? */
static bool cell_meets(looked_up *cells, size_t cell, const double box[4])
{
    if (cells->failed || !look_up(cells, cell)) return false;
    for (size_t k = 0; k < cells->n[cell]; k++) {
        const double *own = cells->box[cell][k];
        if (own[0] <= box[2] && box[0] <= own[2] && own[1] <= box[3] && box[1] <= own[3]) return true;
    }
    return false;
}

void gis_barrier_targets_free(gis_barrier_targets *targets)
{
    if (!targets) return;
    if (targets->cells) free_cells(targets->cells);
    if (targets->tree) CPLQuadTreeDestroy(targets->tree);
    free(targets->box);
    free(targets);
}

bool gis_barrier_is_near(const gis_barrier_surroundings *around, const double box[4], double distance)
{
    double grown[4];
    int n = 0;
    if (!around->targets->tree) return false;
    gis_box_grow(box, around->reach + distance, grown);
    if (!isfinite(around->reach + distance)) return true;
    const CPLRectObj asked = {grown[0], grown[1], grown[2], grown[3]};
    looked_up *cells = around->targets->cells;
    void **found = CPLQuadTreeSearch(around->targets->tree, &asked, &n);
    bool near = n > 0 && !cells;
    for (int k = 0; k < n && cells && !near; k++) {
        const double(*own)[4] = found[k];
        near = cell_meets(cells, cells->number[own - (const double(*)[4])around->targets->box], grown);
    }
    CPLFree(found);
    return near;
}

bool gis_barrier_reach_box(const gis_barrier_surroundings *around, double distance, double box[4])
{
    const gis_barrier_targets *targets = around->targets;
    double all[4] = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < targets->n; i++)
        for (int k = 0; k < 4; k++) all[k] = (k < 2 ? fmin : fmax)(all[k], targets->box[i][k]);
    gis_box_grow(all, around->reach + distance, box);
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
