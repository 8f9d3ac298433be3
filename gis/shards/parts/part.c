/* part.c: see part.h. */
#include "shards/parts/part_internal.h"

#include "base/array.h"
#include "base/core_error.h"
#include "base/message.h"
#include "geometry/gis_box.h"
#include "shards/parts/part_memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool gis_boxes_add(gis_boxes_list *list, const double box[4], double reach, gis_error *error)
{
    if (!gis_array_reserve(&list->box, &list->capacity, list->n + 1, sizeof *list->box)) return gis_no_memory(error);
    for (int c = 0; c < 4; c++) list->box[list->n][c] = box[c] + (c < 2 ? -reach : reach);
    list->n++;
    return true;
}

static char *copy_of(const char *text)
{
    char *copy = text ? malloc(strlen(text) + 1) : NULL;
    return copy ? strcpy(copy, text) : NULL;
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

static bool is_near(const gis_part *p, const double box[4])
{
    for (size_t k = 0; k < p->boxes->n; k++)
        if (gis_box_meets(p->boxes->box[k], box)) return true;
    return false;
}

/* The place in layout->block of the block with this number; SIZE_MAX: there is none. */
static size_t place_of(const gis_part *p, int64_t number)
{
    const gis_part_block *block = gis_layout_block(p->layout, number);
    return block ? (size_t)(block - p->layout->block) : SIZE_MAX;
}

static bool take_feature(void *user, const gis_spool_feature *feature, gis_error *error)
{
    gis_part *p = user;
    double box[4];
    sunder_shape_box(feature->demands.shape, box);
    const size_t block = place_of(p, feature->demands.block);
    const bool near = is_near(p, box), there = p->others ? !near && block != SIZE_MAX && p->block[block] : near;
    if (there && block != SIZE_MAX) p->block[block] = true;
    if (there && gis_array_reserve(&p->item, &p->capacity, p->n + 1, sizeof *p->item)) {
        gis_part_loaded *to = &p->item[p->n++];
        *to = (gis_part_loaded){*feature, p->wants(p->user, p->cell, feature->index)};
        to->feature.id = copy_of(feature->id);
        return !feature->id || to->feature.id || gis_no_memory(error);
    }
    sunder_shape_free((sunder_shape *)feature->demands.shape);
    return !there || gis_no_memory(error);
}

static int by_index(const void *a, const void *b)
{
    const gis_part_loaded *p = a, *q = b;
    return (p->feature.index > q->feature.index) - (p->feature.index < q->feature.index);
}

/* May a feature in this box belong to a block that has a feature in the part? */
static bool has_others(const gis_part *p, const double box[4])
{
    for (size_t b = 0; b < p->layout->blocks; b++)
        if (p->block[b] && gis_box_meets(p->layout->block[b].box, box)) return true;
    return false;
}

static bool load_part(gis_part *p, gis_error *error)
{
    p->block = calloc(p->layout->blocks + 1, sizeof *p->block);
    if (!p->block) return gis_no_memory(error);
    for (int others = 0; others < (p->layout->blocks ? 2 : 1); others++) {
        p->others = others;
        for (p->cell = 0; p->cell < gis_spool_cells(p->spool); p->cell++) {
            const double *box = gis_spool_cell_at(p->spool, p->cell)->box;
            if ((others ? has_others(p, box) : is_near(p, box)) &&
                !gis_spool_read(p->spool, p->cell, take_feature, p, error))
                return false;
        }
    }
    if (p->n) qsort(p->item, p->n, sizeof *p->item, by_index);
    return gis_barriers_load(&p->layout->barriers, (const double(*)[4])p->boxes->box, p->boxes->n, &p->barriers, error);
}

/* Warns if the features of a part need more memory than allowed. They may depend on each other, so they are separated
 * as one piece, whatever its size; the warning comes before hours are spent on it. */
static void warn_if_large(const gis_part *p)
{
    const sunder_layer_options *how = &p->layout->how;
    size_t vertices = 0;
    for (size_t k = 0; k < p->n; k++) {
        const sunder_shape *shape = p->item[k].feature.demands.shape;
        vertices += shape ? sunder_shape_vertices(shape) : 0;
    }
    const double bytes = gis_part_bytes(how->keep_trees, how->effort, (double)p->n, (double)vertices);
    if (p->layout->memory > 0 && bytes > GIS_PART_LARGE * p->layout->memory)
        gis_say_warning(GIS_MESSAGE_MEMORY,
                        "%zu features may depend on each other and are separated as one piece: it takes about %.0f MB, "
                        "more than --max-memory",
                        p->n, ceil(bytes / 1e6));
}

/* ---- Names in the lines of the proof ----------------------------------------------------------------------------- */

static int64_t call_feature(const void *of, size_t feature)
{
    const gis_part *p = of;
    const gis_spool_feature *f = &p->item[feature].feature;
    return p->layout->by_places ? (int64_t)f->index : f->fid;
}

static int64_t call_barrier(const void *of, size_t thing, const char **layer)
{
    const gis_part *p = of;
    const gis_spooled_barrier *barrier = &p->barriers.item[thing - p->n];
    *layer = barrier->layer;
    return barrier->fid;
}

static const sunder_feature *demands_of(const void *of, size_t feature)
{
    return &((const gis_part *)of)->item[feature].feature.demands;
}

static bool begin_lines(gis_part *p, gis_error *error)
{
    const gis_proof_things things = {p, p->n, call_feature, call_barrier, demands_of};
    return gis_proof_lines_begin(&p->lines, &things, p->report, error);
}

/* ---- Separating -------------------------------------------------------------------------------------------------- */

/* Sets the side anchors of point features, which are the points themselves; other features have NAN. */
static bool set_sides(gis_part *p, gis_error *error)
{
    sunder_error why;
    double *xy = malloc((2 * p->n + 1) * sizeof *xy);
    if (!xy) return gis_no_memory(error);
    for (size_t k = 0; k < p->n; k++) memcpy(xy + 2 * k, p->item[k].feature.start, 2 * sizeof *xy);
    const bool done = sunder_layer_set_side_anchors(p->layer, xy, &why) == SUNDER_OK;
    free(xy);
    return done || gis_core_failed(error, "a part of the layer", &why);
}

static bool separate_part(gis_part *p, gis_error *error)
{
    sunder_layer_options options = p->layout->how;
    sunder_error why;
    options.keep_worlds = true;
    sunder_feature *feature = malloc((p->n + 1) * sizeof *feature);
    if (!feature) return gis_no_memory(error);
    for (size_t k = 0; k < p->n; k++) feature[k] = p->item[k].feature.demands;
    p->decided = calloc(p->n + 1, sizeof *p->decided);
    if (!p->decided) {
        free(feature);
        return gis_no_memory(error);
    }
    const bool made = sunder_layer_new(feature, p->n, &p->layer, &why) == SUNDER_OK;
    free(feature);
    if (made && (!set_sides(p, error) || !gis_barriers_set(&p->barriers, p->layer, error))) return false;
    if (!made || sunder_layer_separate(p->layer, &options, &p->report, &why) != SUNDER_OK)
        return gis_core_failed(error, "a part of the layer", &why);
    sunder_layer_summary summary;
    sunder_report_summary(p->report, &summary);
    if (p->layout->explain) *p->layout->explain += summary.seconds_explain;
    if (p->layout->verify) *p->layout->verify += summary.seconds_verify;
    p->out->unverified = p->out->unverified || !summary.verified;
    return !options.keep_trees || begin_lines(p, error);
}

static void clear_part(gis_part *p)
{
    for (size_t k = 0; k < p->n; k++) {
        sunder_shape_free((sunder_shape *)p->item[k].feature.demands.shape);
        free((char *)p->item[k].feature.id);
    }
    free(p->item);
    free(p->block);
    free(p->decided);
    gis_barriers_list_clear(&p->barriers);
    gis_proof_lines_clear(&p->lines);
    sunder_layer_free(p->layer);
    sunder_report_free(p->report);
}

bool gis_part_separate(const gis_layout *layout, const gis_boxes_list *boxes, gis_part_wants *wants, const void *user,
                       unsigned run, gis_part_result *result, gis_error *error)
{
    gis_part p = {.layout = layout,
                  .spool = layout->spool,
                  .boxes = boxes,
                  .wants = wants,
                  .user = user,
                  .run = run,
                  .out = result};
    bool done = load_part(&p, error);
    if (done) warn_if_large(&p);
    done = done && separate_part(&p, error) && gis_part_fill_worlds(&p, error) && gis_part_fill_rows(&p, error) &&
           gis_part_fill_others(&p, error);
    clear_part(&p);
    return done;
}
