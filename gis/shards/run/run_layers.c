/* run_layers.c: the layers of what was separated in parts, row by row: of things that lie in order on disk, beside
 * the features as they are read once more. */
#include "shards/run/run.h"

#include "base/array.h"
#include "base/interrupt.h"
#include "disk/file.h"
#include "layer/checksum.h"
#include "layer/output.h"

#include <cpl_conv.h>
#include <stdlib.h>
#include <string.h>

/* ---- The main layer ---------------------------------------------------------------------------------------------- */

/* Where each list is, while features go by in their order. */
typedef struct passing {
    gis_shard_run *parts;
    gis_disk_file status;
    unsigned char *alone; /* of the batch that goes by: how each feature of it is by itself */
    size_t room;
    bool any; /* joined.rows is at one */
    size_t block;
} passing;

/* Of a feature that went by, or goes: so the first of its block did, if it is of one. own: where it is in the block;
 * NULL: it stands alone. */
static gis_value block_value(const gis_shard_run *p, const gis_sink_layer *layer, const gis_part_link *own,
                             size_t feature, GIntBig fid)
{
    const gis_joined *j = &p->joined;
    const int64_t alone = gis_sink_has_null(layer) ? -1 : (int64_t)feature;
    if (!own) return gis_block_as_value(p->facts.source.fids_unique, alone, fid);
    return gis_block_as_value(p->facts.source.fids_unique, (int64_t)own->b,
                              p->block_fid[gis_joined_block(j, own->b) - j->block]);
}

static bool pass(passing *at, const gis_source *source, size_t i, gis_sink_layer *layer, gis_error *error)
{
    gis_shard_run *p = at->parts;
    const gis_joined *j = &p->joined;
    const size_t feature = gis_source_first(source) + i;
    gis_feature_row row = {.status = (sunder_feature_status)at->alone[i]};
    gis_sorted_results *rows = &p->joined.rows;
    if (at->any && rows->head.first == feature) {
        if (rows->one.rows) {
            row.dx = rows->one.row->move[0];
            row.dy = rows->one.row->move[1];
            row.status = rows->one.row->status;
        } else {
            row.status = gis_joined_status(j, rows->one.still);
        }
        if (!gis_sorted_results_next(rows, &at->any, error)) return false;
    }
    const gis_part_link *own = at->block < j->blocks && j->block[at->block].a == feature ? &j->block[at->block] : NULL;
    if (own) p->block_fid[at->block++] = gis_source_fid(source, i);
    if (!layer) return true;
    row.block = block_value(p, layer, own, feature, gis_source_fid(source, i));
    return gis_main_row(layer, i, &row, error);
}

/* The features are read a second time; others than the first time have no place in what was made of those. */
static bool input_changed(const gis_source *source, gis_error *error)
{
    return gis_fail(error,
                    "%s: features were changed, added or removed since the layer was read, or what the options ask of "
                    "their fields",
                    gis_source_path(source));
}

static bool begin_batch(passing *at, const gis_layer_input *input, gis_layer_checksums *sums, gis_error *error)
{
    const gis_source *source = input->source;
    const size_t first = gis_source_first(source), n = gis_source_count(source);
    if (first + n > at->parts->facts.source.features) return input_changed(source, error);
    if (!gis_layer_checksums_add(sums, input, error)) return false;
    if (!gis_array_reserve(&at->alone, &at->room, n, sizeof *at->alone)) return gis_no_memory(error);
    return gis_disk_file_read(&at->status, first, at->alone, n, error);
}

/* All features go by, as blocks are called by FIDs that are known then; and are written, if layer is not NULL. */
static bool write_main(gis_shard_run *p, const gis_layer_input *input, gis_sink_layer *layer, gis_error *error)
{
    gis_source *source = input->source;
    gis_layer_checksums sums = {0};
    passing at = {.parts = p};
    bool any = true;
    p->block_fid = malloc((p->joined.blocks + 1) * sizeof *p->block_fid);
    if (!p->block_fid) return gis_no_memory(error);
    gis_sorted_results_rewind(&p->joined.rows);
    bool done = gis_disk_file_open(&at.status, p->directory, "status", error) &&
                gis_sorted_results_next(&p->joined.rows, &at.any, error);
    while (done && any) {
        done = begin_batch(&at, input, &sums, error);
        for (size_t i = 0; i < gis_source_count(source) && done; i++) done = pass(&at, source, i, layer, error);
        any = !p->whole;
        if (any) done = done && gis_source_next(source, &any, error);
    }
    gis_disk_file_close(&at.status);
    free(at.alone);
    if (done && gis_layer_checksums_end(&sums) != p->facts.checksum) return input_changed(source, error);
    return done;
}

/* ---- The others -------------------------------------------------------------------------------------------------- */

static gis_value id_value(const gis_shard_run *p, const char *text)
{
    if (!text || !p->facts.has_id) return (gis_value){.kind = GIS_NULL};
    if (p->facts.id_type == OFTInteger64) return (gis_value){GIS_INTEGER, {.integer = strtoll(text, NULL, 10)}};
    if (p->facts.id_type == OFTReal) return (gis_value){GIS_REAL, {.real = CPLAtof(text)}};
    return (gis_value){GIS_TEXT, {.text = text}};
}

static bool write_displacement(gis_shard_run *p, gis_sink_layer *layer, gis_error *error)
{
    gis_sorted_results *rows = &p->joined.rows;
    bool any = true;
    gis_sorted_results_rewind(rows);
    while (gis_sorted_results_next(rows, &any, error) && any) {
        const gis_part_row *own = rows->one.row;
        if (!rows->one.rows || (own->move[0] == 0 && own->move[1] == 0)) continue;
        const gis_arrow_row row = {
            .fid = gis_fid_as_value(own->fid),
            .id = id_value(p, gis_part_text(&rows->one, own->id)),
            .block = block_value(p, layer, gis_joined_block(&p->joined, own->index), own->index, own->fid),
            .from = {own->from[0], own->from[1]},
            .move = {own->move[0], own->move[1]}};
        if (!gis_go_on(error) || !gis_displacement_row(layer, &row, error)) return false;
    }
    return !any;
}

/* Names of the conflict that is at hand. */
static const gis_part_name *name_of(const gis_shard_run *p, size_t feature)
{
    const gis_part_result *one = &p->joined.conflicts.one;
    for (size_t k = 0; k < one->names; k++)
        if (one->name[k].index == feature) return &one->name[k];
    return NULL;
}

static GIntBig part_fid(const void *of, size_t feature)
{
    const gis_part_name *name = name_of(of, feature);
    return name ? name->fid : OGRNullFID;
}

static bool part_id(const void *of, size_t feature, char **copy, gis_value *value, gis_error *error)
{
    const gis_shard_run *p = of;
    const gis_part_name *name = name_of(p, feature);
    (void)copy;
    (void)error;
    *value = id_value(p, name ? gis_part_text(&p->joined.conflicts.one, name->id) : NULL);
    return true;
}

static GIntBig part_barrier(const void *of, size_t thing, const char **layer)
{
    const gis_shard_run *p = of;
    const gis_part_name *name = name_of(p, thing);
    *layer = name ? gis_part_text(&p->joined.conflicts.one, name->id) : "";
    return name ? name->fid : OGRNullFID;
}

static bool write_conflicts(gis_shard_run *p, gis_sink_layer *layer, gis_error *error)
{
    const gis_things things = {p, p->facts.source.features, part_fid, part_id, part_barrier};
    gis_conflict_texts scratch = {0};
    gis_sorted_results *conflicts = &p->joined.conflicts;
    bool any = true, done = true;
    gis_sorted_results_rewind(conflicts);
    while (done && (done = gis_sorted_results_next(conflicts, &any, error)) && any) {
        gis_part_conflict *c = conflicts->one.conflict;
        gis_value values[N_CONFLICT_COLUMNS];
        c->is.blocked_by = conflicts->one.blocker;
        done = gis_go_on(error) && gis_things_conflict(&things, &c->is, &scratch, values, error) &&
               gis_line_row(layer, values, c->is.from, c->is.to, error);
    }
    gis_conflict_texts_clear(&scratch);
    return done;
}

/* The two things of the push that is at hand. */
static GIntBig push_fid(const void *of, size_t feature)
{
    const gis_part_push *push = ((const gis_part_result *)of)->push;
    return push->fid[feature != push->is.a];
}

static GIntBig push_barrier(const void *of, size_t thing, const char **layer)
{
    const gis_part_result *one = of;
    (void)thing;
    *layer = gis_part_text(one, one->push->layer);
    return one->push->fid[1];
}

static bool write_pushes(gis_shard_run *p, gis_sink_layer *layer, gis_error *error)
{
    gis_sorted_results *pushes = &p->joined.pushes;
    bool any = true;
    while (gis_sorted_results_next(pushes, &any, error) && any) {
        const gis_part_push *push = pushes->one.push;
        const gis_things things = {&pushes->one, p->facts.source.features, push_fid, NULL, push_barrier};
        gis_value values[N_PUSH_COLUMNS];
        gis_things_push(&things, &push->is, values);
        if (!gis_go_on(error) || !gis_line_row(layer, values, push->from, push->to, error)) return false;
    }
    return !any;
}

/* Features are asked about in their order, and rows lie in it. */
typedef struct moving {
    gis_sorted_results *rows;
    bool any;
} moving;

static bool move_of(void *user, size_t feature, double move[2], gis_error *error)
{
    moving *m = user;
    move[0] = move[1] = 0;
    if (!m->any || m->rows->head.first != feature) return true;
    if (m->rows->one.rows) memcpy(move, m->rows->one.row->move, 2 * sizeof *move);
    return gis_sorted_results_next(m->rows, &m->any, error);
}

static bool write_symbols(gis_shard_run *p, const gis_layer_input *input, gis_sink *sink, gis_error *error)
{
    moving m = {.rows = &p->joined.rows};
    gis_sorted_results_rewind(m.rows);
    return gis_sorted_results_next(m.rows, &m.any, error) &&
           gis_write_symbols_anew(sink, input, p->facts.multi, !p->whole, move_of, &m, error);
}

bool gis_shard_run_write(gis_shard_run *parts, const gis_layer_input *input, const gis_shard_run_layers *layers,
                         gis_sink *sink, gis_error *error)
{
    OGRSpatialReferenceH crs = gis_source_crs(input->source);
    gis_sink_layer *layer = NULL;
    const OGRFieldType id = parts->facts.id_type;
    if (layers->main && !gis_main_begin(sink, &layer, error)) return false;
    if (!write_main(parts, input, layer, error)) return false;
    if (layers->displacement &&
        (!gis_displacement_begin(sink, id, crs, &layer, error) || !write_displacement(parts, layer, error)))
        return false;
    if (layers->conflicts &&
        (!gis_conflicts_begin(sink, "conflicts", id, crs, &layer, error) || !write_conflicts(parts, layer, error)))
        return false;
    if (layers->pushes && (!gis_pushes_begin(sink, crs, &layer, error) || !write_pushes(parts, layer, error)))
        return false;
    return !layers->symbols || write_symbols(parts, input, sink, error);
}
