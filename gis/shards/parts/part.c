/* part.c: see part.h. */
#include "shards/parts/part_internal.h"

#include "base/array.h"
#include "base/core_error.h"
#include "base/message.h"
#include "geometry/gis_box.h"
#include "shards/parts/part_memory.h"

#include <math.h>
#include <ogr_core.h>
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

static bool meets_any(const gis_boxes_list *boxes, const double box[4])
{
    for (size_t k = 0; k < boxes->n; k++)
        if (gis_box_meets(boxes->box[k], box)) return true;
    return false;
}

static bool is_near(const gis_part *p, const double box[4]) { return meets_any(p->boxes, box); }

/* The pass in which the feature's block, and its row, came into the part; NULL: it has none. */
static void find_passes(const gis_part *p, const gis_spool_feature *feature, unsigned *of[2])
{
    const gis_part_block *block = gis_layout_block(p->layout, feature->demands.block),
                         *row = gis_layout_row(p->layout, feature->row);
    of[0] = block ? &p->block[block - p->layout->block] : NULL;
    of[1] = row ? &p->row[row - p->layout->row] : NULL;
}

/* Is the feature to be added in this pass? Its block and its row then are in the part. */
static bool is_added(gis_part *p, const gis_spool_feature *feature, bool near)
{
    unsigned *of[2], first = GIS_NO_PASS;
    find_passes(p, feature, of);
    for (int c = 0; c < 2; c++)
        if (of[c] && *of[c] < first) first = *of[c];
    const bool added = p->pass ? !near && first == p->pass - 1 : near;
    for (int c = 0; c < 2 && added; c++) {
        if (!of[c] || *of[c] != GIS_NO_PASS) continue;
        *of[c] = p->pass;
        p->more = true;
    }
    return added;
}

static bool take_feature(void *user, const gis_spool_feature *feature, gis_error *error)
{
    gis_part *p = user;
    double box[4];
    gis_spool_feature_box(feature, box);
    const bool there = is_added(p, feature, is_near(p, box));
    if (there && gis_array_reserve(&p->item, &p->capacity, p->n + 1, sizeof *p->item)) {
        gis_part_loaded *to = &p->item[p->n++];
        *to = (gis_part_loaded){*feature, NULL, p->wants(p->user, p->cell, feature->index)};
        to->feature.given = (gis_spool_rings){0};
        to->feature.id = copy_of(feature->id);
        if (feature->given.polygons && !gis_spool_rings_shape(&feature->given, &to->given, error)) return false;
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

/* Lists the boxes of the blocks and rows that came in the pass before. */
static bool list_others(const gis_part *p, gis_boxes_list *others, gis_error *error)
{
    const gis_layout *l = p->layout;
    bool ok = true;
    others->n = 0;
    for (size_t b = 0; p->pass && b < l->blocks && ok; b++)
        if (p->block[b] == p->pass - 1) ok = gis_boxes_add(others, l->block[b].box, 0, error);
    for (size_t r = 0; p->pass && r < l->rows && ok; r++)
        if (p->row[r] == p->pass - 1) ok = gis_boxes_add(others, l->row[r].box, 0, error);
    return ok;
}

static unsigned *not_in_any_pass(size_t n)
{
    unsigned *pass = malloc((n + 1) * sizeof *pass);
    for (size_t k = 0; k < n && pass; k++) pass[k] = GIS_NO_PASS;
    return pass;
}

bool gis_part_load(gis_part *p, gis_error *error)
{
    p->block = not_in_any_pass(p->layout->blocks);
    p->row = not_in_any_pass(p->layout->rows);
    if (!p->block || !p->row) return gis_no_memory(error);
    gis_boxes_list others = {0};
    bool done = true;
    for (p->pass = 0, p->more = true; p->more && done; p->pass++) {
        p->more = false;
        done = list_others(p, &others, error);
        for (p->cell = 0; p->cell < gis_spool_cells(p->spool) && done; p->cell++) {
            const double *box = gis_spool_cell_at(p->spool, p->cell)->box;
            if (p->pass ? meets_any(&others, box) : is_near(p, box))
                done = gis_spool_read(p->spool, p->cell, take_feature, p, error);
        }
    }
    free(others.box);
    if (!done) return false;
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

static uint32_t class_of(const void *of, size_t thing)
{
    const gis_part *p = of;
    return thing < p->n ? p->item[thing].feature.gap_class : p->barriers.item[thing - p->n].gap_class;
}

static bool begin_lines(gis_part *p, gis_error *error)
{
    const gis_proof_things things = {
        p, p->n, call_feature, call_barrier, demands_of, p->layout->gaps.classes ? class_of : NULL};
    return gis_proof_lines_begin(&p->lines, &things, p->report, error) &&
           gis_proof_choices_make(&p->lines, &p->choices, error);
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

static bool set_rows(gis_part *p, gis_error *error)
{
    sunder_error why;
    if (p->layout->how.rows != SUNDER_ROWS_GIVEN) return true;
    int64_t *row = malloc((p->n + 1) * sizeof *row);
    if (!row) return gis_no_memory(error);
    for (size_t k = 0; k < p->n; k++) row[k] = p->item[k].feature.row - 1;
    const bool done = sunder_layer_set_rows(p->layer, row, &why) == SUNDER_OK;
    free(row);
    return done || gis_core_failed(error, "a part of the layer", &why);
}

/* Sets the gaps by classes, if there are any; the barriers are set. */
static bool set_gaps(gis_part *p, gis_error *error)
{
    sunder_gaps gaps = p->layout->gaps;
    sunder_error why;
    if (gaps.classes == 0) return true;
    uint32_t *of = malloc((p->n + p->barriers.n + 1) * sizeof *of);
    if (!of) return gis_no_memory(error);
    for (size_t k = 0; k < p->n + p->barriers.n; k++) of[k] = class_of(p, k);
    gaps.feature = of;
    gaps.barrier = of + p->n;
    const bool done = sunder_layer_set_gaps(p->layer, &gaps, &why) == SUNDER_OK;
    free(of);
    return done || gis_core_failed(error, "--spec: gaps", &why);
}

/* Sets what it costs to hide features, if that is allowed. */
static bool set_hiding(gis_part *p, gis_error *error)
{
    sunder_error why;
    sunder_layer_set_crossed(p->layer, p->layout->rules->crossed);
    if (!p->layout->rules->hide) return true;
    sunder_hiding_cost *cost = malloc((p->n + 1) * sizeof *cost);
    if (!cost) return gis_no_memory(error);
    for (size_t k = 0; k < p->n; k++) cost[k] = p->item[k].feature.hiding;
    const bool done = sunder_layer_set_hiding(p->layer, cost, &why) == SUNDER_OK;
    free(cost);
    return done || gis_core_failed(error, "--hide", &why);
}

/* Tells the core which shapes features had before they became larger, if any did. */
static bool set_originals(gis_part *p, gis_error *error)
{
    sunder_error why;
    if (!p->layout->rules->enlarge) return true;
    const sunder_shape **given = malloc((p->n + 1) * sizeof *given);
    if (!given) return gis_no_memory(error);
    for (size_t k = 0; k < p->n; k++) given[k] = p->item[k].given;
    const bool done = sunder_layer_set_originals(p->layer, given, &why) == SUNDER_OK;
    free((void *)given);
    return done || gis_core_failed(error, "--enlarge", &why);
}

/* What the smaller shapes of features are made of: [n] each. */
typedef struct rung_material {
    const sunder_shape **shape;
    int64_t *weight;
    bool *rigid;
} rung_material;

static bool make_levels(gis_part *p, rung_material *m, gis_error *error)
{
    const gis_layout *l = p->layout;
    const gis_rung_request request = {.rules = l->rules,
                                      .lengths = l->lengths,
                                      .core = l->how,
                                      .layer = p->layer,
                                      .n = p->n,
                                      .shape = m->shape,
                                      .weight = m->weight,
                                      .rigid = m->rigid};
    for (size_t k = 0; k < p->n; k++) {
        const gis_spool_feature *f = &p->item[k].feature;
        m->shape[k] = f->demands.shape;
        m->weight[k] = f->hiding.weight;
        m->rigid[k] = f->rigid;
    }
    return gis_rungs_make(&request, &p->levels, error) &&
           gis_rungs_set(l->rules, l->lengths->min_size, &p->levels, NULL, p->n, p->layer, l->name, error);
}

/* Makes the smaller shapes that features may have, if that is allowed. */
static bool set_levels(gis_part *p, gis_error *error)
{
    if (!gis_levels_asked(p->layout->rules)) return true;
    rung_material m = {malloc((p->n + 1) * sizeof *m.shape), malloc((p->n + 1) * sizeof *m.weight),
                       malloc((p->n + 1) * sizeof *m.rigid)};
    const bool done = ((m.shape && m.weight && m.rigid) || gis_no_memory(error)) && make_levels(p, &m, error);
    free((void *)m.shape);
    free(m.weight);
    free(m.rigid);
    return done;
}

/* Tells of a feature that is in two rows, as gis_layer_run() does, and of other errors of the core. */
static bool tell_failure(const gis_part *p, const sunder_error *why, gis_error *error)
{
    char who[GIS_WHO_SIZE];
    if (why->status != SUNDER_EINVALID || why->polygon >= p->n)
        return gis_core_failed(error, "a part of the layer", why);
    const gis_spool_feature *f = &p->item[why->polygon].feature;
    gis_name_subject(&(gis_subject){NULL, p->layout->name, f->fid != OGRNullFID, f->fid, f->index, f->id}, who,
                     sizeof who);
    return gis_fail(error, "%s: --rows: %s", who, why->message);
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
    if (made && (!set_sides(p, error) || !set_rows(p, error) || !gis_barriers_set(&p->barriers, p->layer, error) ||
                 !set_gaps(p, error) || !set_originals(p, error) || !set_hiding(p, error) || !set_levels(p, error)))
        return false;
    if (!made || sunder_layer_separate(p->layer, &options, &p->report, &why) != SUNDER_OK)
        return tell_failure(p, &why, error);
    sunder_layer_summary summary;
    sunder_report_summary(p->report, &summary);
    if (p->layout->explain) *p->layout->explain += summary.seconds_explain;
    if (p->layout->verify) *p->layout->verify += summary.seconds_verify;
    p->out->unverified = p->out->unverified || !summary.verified;
    return !options.keep_trees || begin_lines(p, error);
}

void gis_part_clear(gis_part *p)
{
    for (size_t k = 0; k < p->n; k++) {
        sunder_shape_free((sunder_shape *)p->item[k].feature.demands.shape);
        sunder_shape_free(p->item[k].given);
        free((char *)p->item[k].feature.id);
    }
    free(p->item);
    free(p->block);
    free(p->row);
    free(p->decided);
    gis_barriers_list_clear(&p->barriers);
    gis_proof_lines_clear(&p->lines);
    gis_proof_choices_clear(&p->choices);
    sunder_layer_free(p->layer);
    gis_levels_clear(&p->levels);
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
    bool done = gis_part_load(&p, error);
    if (done) warn_if_large(&p);
    done = done && separate_part(&p, error) && gis_part_fill_worlds(&p, error) && gis_part_fill_rows(&p, error) &&
           gis_part_fill_others(&p, error);
    gis_part_clear(&p);
    return done;
}
