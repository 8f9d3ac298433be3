/* part_enlarge.c: see part.h. A block grows as a whole, so a feature is known only when its whole block is in the part,
 * with everything that might belong to it. If it is not, the part is read again with more around the block. */
#include "shards/parts/part_internal.h"

#include "base/core_error.h"
#include "geometry/gis_box.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A part while its features become larger; [n] each. */
typedef struct growing {
    gis_part *p;
    sunder_shape **shape; /* the larger shapes; NULL: the feature keeps its own */
    int64_t *block;       /* the block of each feature, as the first of its features; -1: none */
    bool *rigid;
    bool *wanted, *open; /* of the first feature of a block: one of its features is requested; and is not known */
} growing;

static bool begin(growing *g, gis_part *p, gis_error *error)
{
    const size_t n = p->n + 1;
    *g = (growing){.p = p,
                   .shape = calloc(n, sizeof *g->shape),
                   .block = malloc(n * sizeof *g->block),
                   .rigid = malloc(n * sizeof *g->rigid),
                   .wanted = calloc(n, sizeof *g->wanted),
                   .open = calloc(n, sizeof *g->open)};
    for (size_t k = 0; g->rigid && k < p->n; k++) g->rigid[k] = p->item[k].feature.rigid;
    return (g->shape && g->block && g->rigid && g->wanted && g->open) || gis_no_memory(error);
}

static void end(growing *g)
{
    for (size_t k = 0; g->shape && k < g->p->n; k++) sunder_shape_free(g->shape[k]);
    free(g->shape);
    free(g->block);
    free(g->rigid);
    free(g->wanted);
    free(g->open);
}

static bool make_larger(growing *g, gis_error *error)
{
    const gis_part *p = g->p;
    const sunder_enlarging how = {p->layout->lengths->min_size, g->rigid};
    sunder_layer *layer = NULL;
    sunder_error why;
    sunder_feature *feature = malloc((p->n + 1) * sizeof *feature);
    if (!feature) return gis_no_memory(error);
    for (size_t k = 0; k < p->n; k++) feature[k] = p->item[k].feature.demands;
    const bool done = sunder_layer_new(feature, p->n, &layer, &why) == SUNDER_OK &&
                      sunder_layer_enlarge(layer, &p->layout->how, &how, g->shape, g->block, &why) == SUNDER_OK;
    sunder_layer_free(layer);
    free(feature);
    return done || gis_core_failed(error, "--enlarge", &why);
}

static size_t first_of(const growing *g, size_t k) { return g->block[k] < 0 ? k : (size_t)g->block[k]; }

/* The box around everything that may be in a block with feature k because of it. */
static void box_about(const growing *g, size_t k, double box[4])
{
    const sunder_layer_options *how = &g->p->layout->how;
    const double reach = 2 * (fmax(how->gap, how->full_gap) + fmax(how->touch_tolerance, 0));
    sunder_shape_box(g->p->item[k].feature.demands.shape, box);
    for (int c = 0; c < 4; c++) box[c] += c < 2 ? -reach : reach;
}

/* Adds boxes around the blocks of requested features that are not known, larger ones at each attempt. */
static bool add_boxes(growing *g, gis_boxes_list *boxes, unsigned attempt, gis_error *error)
{
    const gis_part *p = g->p;
    double box[4];
    bool ok = true;
    for (size_t k = 0; k < p->n; k++)
        if (p->item[k].wanted) g->wanted[first_of(g, k)] = true;
    for (size_t k = 0; k < p->n; k++) {
        box_about(g, k, box);
        if (g->wanted[first_of(g, k)] && !gis_part_knows(p, box)) g->open[first_of(g, k)] = true;
    }
    for (size_t k = 0; k < p->n && ok; k++) {
        box_about(g, k, box);
        if (g->open[first_of(g, k)]) ok = gis_boxes_add(boxes, box, ldexp(p->layout->halo, (int)attempt), error);
    }
    return ok;
}

/* Adds the requested features to the spool, with their blocks. */
static bool add_features(growing *g, gis_spool_writer *to, size_t *larger, gis_error *error)
{
    bool ok = true;
    for (size_t k = 0; k < g->p->n && ok; k++) {
        const gis_part_loaded *item = &g->p->item[k];
        gis_spool_feature feature = item->feature;
        if (!item->wanted) continue;
        feature.demands.block = g->block[k] < 0 ? -1 : (int64_t)g->p->item[g->block[k]].feature.index;
        if (g->shape[k]) {
            feature.given = gis_spool_rings_of(feature.demands.shape);
            feature.demands.shape = g->shape[k];
            ++*larger;
        }
        ok = gis_spool_add(to, &feature, error);
    }
    return ok;
}

/* Makes one attempt; *done: everything was known, and the features are in the spool. Otherwise *boxes gets more. */
static bool attempt_part(gis_part *p, gis_boxes_list *boxes, unsigned attempt, gis_spool_writer *to, size_t *larger,
                         bool *done, gis_error *error)
{
    const size_t before = boxes->n;
    growing g = {.p = p};
    bool ok = gis_part_load(p, error) && begin(&g, p, error) && make_larger(&g, error) &&
              add_boxes(&g, boxes, attempt, error);
    *done = ok && boxes->n == before;
    ok = ok && (!*done || add_features(&g, to, larger, error));
    end(&g);
    return ok;
}

bool gis_part_enlarge(const gis_layout *layout, gis_boxes_list *boxes, gis_part_wants *wants, const void *user,
                      gis_spool_writer *to, size_t *larger, gis_error *error)
{
    bool ok = true, done = false;
    for (unsigned attempt = 0; ok && !done; attempt++) {
        gis_part p = {.layout = layout, .spool = layout->spool, .boxes = boxes, .wants = wants, .user = user};
        ok = attempt_part(&p, boxes, attempt, to, larger, &done, error);
        gis_part_clear(&p);
    }
    return ok;
}
