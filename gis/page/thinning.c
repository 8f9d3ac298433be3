/* thinning.c: see thinning.h.
 *
 * The page must load quickly, hence the size of its map is limited. Features are drawn completely in the order of
 * their importance, until the limit is reached:
 *
 *     those that are in a conflict or block one
 *     those that moved, the longest moves first
 *     those near features of the first two kinds, or near features with another shape or hidden ones
 *     the rest
 *
 * All other features are simplified with a tolerance, and those not larger than it are omitted; the tolerance is
 * doubled until the map is small enough. The choice depends on the layer only. */
#include "page/thinning.h"

#include "base/interrupt.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* most_bytes: the limit of the map; most_whole: the fraction of it for features that are drawn completely, if not all
 * are. The average bytes of a feature and of a vertex were measured on layers of buildings. */
static const double most_bytes = 6.5e6, most_whole = 0.6;
enum { FEATURE_BYTES = 24, CORNER_BYTES = 6 };

/* "Near" is decided on a grid with this number of cells in each direction. */
enum { CELLS = 512 };

/* Returns the range of cells that a box meets, with one more cell on every side: minimum x, minimum y, maximum x,
 * maximum y. */
static void cells_of(const gis_page_model *model, const double box[4], size_t cells[4])
{
    for (int k = 0; k < 4; k++) {
        double low = model->extent[k % 2], size = model->extent[k % 2 + 2] - low;
        double at = size > 0 ? floor((box[k] - low) / size * CELLS) + (k < 2 ? -1 : 1) : 0;
        cells[k] = (size_t)fmin(CELLS - 1, fmax(0, at));
    }
}

static void mark_cells(const gis_page_model *model, const double box[4], bool *marked)
{
    size_t c[4];
    cells_of(model, box, c);
    for (size_t y = c[1]; y <= c[3]; y++) memset(marked + y * CELLS + c[0], true, c[2] - c[0] + 1);
}

static bool meets_marked(const gis_page_model *model, const double box[4], const bool *marked)
{
    size_t c[4];
    cells_of(model, box, c);
    for (size_t y = c[1]; y <= c[3]; y++)
        if (memchr(marked + y * CELLS + c[0], true, c[2] - c[0] + 1)) return true;
    return false;
}

static bool is_telling(const gis_view_feature *feature)
{
    return feature->involved || feature->changed || feature->status == SUNDER_FEATURE_HIDDEN || feature->move[0] != 0 ||
           feature->move[1] != 0;
}

/* Marks the cells of all features that moved, changed, are hidden, are in a conflict, or block one. */
static void mark_telling(const gis_page_model *model, bool *marked)
{
    for (size_t i = 0; i < model->n; i++) {
        const gis_view_feature *feature = &model->feature[i];
        if (!feature->vertices || !is_telling(feature)) continue;
        double after[4];
        gis_page_box(feature, 1, after);
        mark_cells(model, feature->box, marked);
        mark_cells(model, after, marked);
    }
}

/* ---- Features that are drawn completely -------------------------------------------------------------------------- */

/* The state of the choice of features that are drawn completely. */
typedef struct room {
    const gis_page_model *model;
    gis_thinning *thinning;
    double taken, most;
    bool full; /* a feature exceeded the limit, so that no less important one is drawn completely */
} room;

/* A feature that changed is drawn in two shapes. */
static size_t shapes_of(const gis_view_feature *feature) { return feature->changed ? 2 : 1; }

static double whole_bytes(const gis_view_feature *feature)
{
    return FEATURE_BYTES + CORNER_BYTES * (double)(shapes_of(feature) * feature->vertices);
}

static void draw_whole(room *map, size_t i)
{
    const gis_view_feature *feature = &map->model->feature[i];
    if (!feature->vertices || map->full || map->thinning->drawn[i]) return;
    double bytes = whole_bytes(feature);
    map->full = map->taken + bytes > map->most;
    if (map->full) return;
    map->taken += bytes;
    map->thinning->drawn[i] = GIS_DRAWN_WHOLE;
    map->thinning->whole++;
}

static bool choose_whole(room *map, gis_error *error)
{
    const gis_page_model *model = map->model;
    bool *marked = calloc((size_t)CELLS * CELLS, sizeof *marked);
    if (!marked) return gis_no_memory(error);
    mark_telling(model, marked);
    for (size_t i = 0; i < model->n; i++)
        if (model->feature[i].involved) draw_whole(map, i);
    for (size_t k = 0; k < model->n_moved; k++) draw_whole(map, model->moved[k]);
    for (size_t i = 0; i < model->n; i++)
        if (model->feature[i].vertices && meets_marked(model, model->feature[i].box, marked)) draw_whole(map, i);
    for (size_t i = 0; i < model->n; i++) draw_whole(map, i);
    free(marked);
    return true;
}

/* ---- Simplified features ----------------------------------------------------------------------------------------- */

static bool is_as_small(const gis_view_feature *feature, double tolerance)
{
    return fmax(feature->box[2] - feature->box[0], feature->box[3] - feature->box[1]) <= tolerance;
}

/* *bytes becomes the estimated size of a simplified feature; 0 if it is omitted. */
static bool simpler_bytes(const gis_page_model *model, size_t i, double tolerance, gis_corners *scratch, double *bytes,
                          gis_error *error)
{
    const sunder_shape *shape;
    *bytes = 0;
    if (is_as_small(&model->feature[i], tolerance)) return true;
    if (!gis_page_shape(model, i, GIS_VIEW_FIRST, &shape, error)) return false;
    for (size_t p = 0; p < sunder_shape_polygons(shape); p++)
        for (size_t r = 0; r < sunder_shape_rings(shape, p); r++) {
            size_t n;
            const double *ring = sunder_shape_ring(shape, p, r, &n);
            if (!gis_corners_simplify(scratch, ring, n, tolerance, error)) return false;
            *bytes += CORNER_BYTES * (double)(shapes_of(&model->feature[i]) * scratch->n);
        }
    if (*bytes > 0) *bytes += FEATURE_BYTES;
    return true;
}

/* Simplifies the features that are not drawn completely with the tolerance of the thinning; *bytes becomes the sum of
 * their estimated sizes. */
static bool simplify_rest(const gis_page_model *model, gis_thinning *thinning, double *bytes, gis_error *error)
{
    gis_corners scratch = {0};
    bool ok = true;
    *bytes = 0;
    thinning->simpler = thinning->left_out = 0;
    for (size_t i = 0; ok && i < model->n; i++) {
        double one;
        if (!model->feature[i].vertices || thinning->drawn[i] == GIS_DRAWN_WHOLE) continue;
        ok = gis_go_on(error) && simpler_bytes(model, i, thinning->tolerance, &scratch, &one, error);
        bool drawn = ok && one > 0;
        thinning->drawn[i] = drawn ? GIS_DRAWN_SIMPLER : GIS_DRAWN_NOT;
        *bytes += drawn ? one : 0;
        thinning->simpler += drawn;
        thinning->left_out += !drawn;
    }
    gis_corners_clear(&scratch);
    return ok;
}

static bool choose_features(const gis_page_model *model, gis_thinning *thinning, gis_error *error)
{
    double all = 0, bytes;
    for (size_t i = 0; i < model->n; i++)
        if (model->feature[i].vertices) all += whole_bytes(&model->feature[i]);
    room map = {model, thinning, 0, all <= most_bytes ? most_bytes : most_whole * most_bytes, false};
    if (!choose_whole(&map, error)) return false;
    if (!map.full) return true;
    double size = fmax(model->extent[2] - model->extent[0], model->extent[3] - model->extent[1]);
    for (thinning->tolerance = size / 0x1p14;; thinning->tolerance *= 2) {
        if (!simplify_rest(model, thinning, &bytes, error)) return false;
        if (map.taken + bytes <= most_bytes) return true;
    }
}

/* ---- Barriers ---------------------------------------------------------------------------------------------------- */

static const double most_barrier_bytes = 2e6;

static bool line_bytes(const gis_page_model *model, const gis_view_barrier *barrier, double tolerance,
                       gis_corners *scratch, double *bytes, gis_error *error)
{
    sunder_obstacle geometry;
    size_t begin = 0;
    *bytes = FEATURE_BYTES + CORNER_BYTES * (double)barrier->vertices;
    if (tolerance == 0) return true;
    if (!gis_page_geometry(model, barrier, &geometry, error)) return false;
    *bytes = FEATURE_BYTES;
    for (size_t line = 0; line < geometry.lines; begin = geometry.line_end[line++]) {
        const size_t n = geometry.line_end[line] - begin;
        if (!gis_corners_simplify_line(scratch, geometry.xy + 2 * begin, n, tolerance, error)) return false;
        *bytes += CORNER_BYTES * (double)scratch->n;
    }
    if (geometry.shape) *bytes += CORNER_BYTES * (double)sunder_shape_vertices(geometry.shape);
    return true;
}

/* Doubles the tolerance of barriers until they are small enough. Barriers not larger than the tolerance are omitted. */
static bool choose_barriers(const gis_page_model *model, gis_thinning *thinning, gis_error *error)
{
    gis_corners scratch = {0};
    double size = fmax(model->extent[2] - model->extent[0], model->extent[3] - model->extent[1]);
    bool ok = true;
    for (double *tolerance = &thinning->barrier_tolerance; ok; *tolerance = fmax(2 * *tolerance, size / 0x1p14)) {
        double bytes = 0;
        for (size_t k = 0; ok && k < model->n_barriers; k++) {
            const double *box = model->barrier[k].box;
            double one = 0;
            bool drawn = *tolerance == 0 || fmax(box[2] - box[0], box[3] - box[1]) > *tolerance;
            ok = !drawn || line_bytes(model, &model->barrier[k], *tolerance, &scratch, &one, error);
            bytes += one;
        }
        if (bytes <= most_barrier_bytes) break;
    }
    gis_corners_clear(&scratch);
    return ok;
}

bool gis_thinning_choose(const gis_page_model *model, gis_thinning *thinning, gis_error *error)
{
    *thinning = (gis_thinning){.drawn = calloc(model->n + 1, 1)};
    if (!thinning->drawn) return gis_no_memory(error);
    return model->empty || (choose_features(model, thinning, error) && choose_barriers(model, thinning, error));
}

void gis_thinning_clear(gis_thinning *thinning)
{
    free(thinning->drawn);
    *thinning = (gis_thinning){0};
}
