/* in_parts.c: see in_parts.h. */
#define _GNU_SOURCE /* mkdtemp() */
#include "layer/in_parts.h"

#include "base/interrupt.h"
#include "base/remove_tree.h"
#include "base/resources.h"
#include "spool/file.h"

#include <cpl_conv.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The spool is dealt to so many shards, of which a part is as many as memory allows. */
enum { SHARDS = 4096 };
enum { BATCH = 16384 };
/* The share of them in all the work, what borders cut being the rest; roughly. */
#define MOSTLY_SHARDS 0.9

/* Bytes that a feature and a vertex of a part take, at most on towns; of what is kept besides, for each of the
 * layer. */
static const double bytes_a_feature = 2000, bytes_a_vertex = 120, bytes_kept = 160, bytes_anyway = 96e6;

/* ---- What cannot be done ----------------------------------------------------------------------------------------- */

static bool refuse(const gis_layer_input_request *request, gis_error *error)
{
    const struct {
        bool given;
        const char *option;
    } asked[] = {{request->barriers > 0, "--barrier"}, {request->symbol || request->symbol_field, "--symbol"}};
    for (size_t k = 0; k < sizeof asked / sizeof *asked; k++)
        if (asked[k].given)
            return gis_fail_usage(error, "--max-memory: a layer is not separated in parts with %s", asked[k].option);
    return true;
}

/* ---- Onto the disk ----------------------------------------------------------------------------------------------- */

static bool make_directory(gis_in_parts *p, gis_error *error)
{
    const char *where = getenv("TMPDIR");
    p->directory = CPLStrdup(CPLFormFilename(where && *where ? where : "/tmp", "sunder.XXXXXX", NULL));
    if (!mkdtemp(p->directory)) {
        gis_fail(error, "%s: a directory for the parts of the layer cannot be made: %s", p->directory, strerror(errno));
        CPLFree(p->directory);
        p->directory = NULL;
        return false;
    }
    p->leftover = gis_leftover_temporary(p->directory);
    return true;
}

/* How many shards fit into what is left of the memory. */
static bool choose_parts(gis_in_parts *p, double memory, gis_error *error)
{
    const double features = (double)gis_spool_features(p->spool), vertices = (double)gis_spool_vertices(p->spool),
                 all = bytes_a_feature * features + bytes_a_vertex * vertices,
                 left = memory - bytes_anyway - bytes_kept * (double)p->facts.source.features;
    if (!(left > all / SHARDS))
        return gis_fail(error, "--max-memory: %zu features need %.0f MB at least", p->facts.source.features,
                        ceil((memory - left + all / SHARDS) / 1e6) + 1);
    p->at_once = (unsigned)fmin(SHARDS, fmax(1, floor(SHARDS * left / fmax(all, 1))));
    return true;
}

bool gis_in_parts_begin(const gis_layer_input_request *request, double memory, gis_in_parts *out, gis_error *error)
{
    *out = (gis_in_parts){.request = request};
    return refuse(request, error) && make_directory(out, error) &&
           gis_layer_spool(request, SHARDS, out->directory, &out->facts, error) &&
           gis_spool_open(out->directory, &out->spool, error) && choose_parts(out, memory, error);
}

bool gis_in_parts_open(gis_in_parts *p, bool whole, gis_layer_input *out, gis_error *error)
{
    gis_layer_input_request again = *p->request;
    p->whole = whole;
    again.source.batch = whole ? 0 : BATCH;
    again.source.facts = &p->facts.source;
    const bool done = gis_layer_begin(&again, true, out, error);
    out->request = p->request;
    out->n = p->facts.source.features;
    out->gap = p->facts.gap;
    out->max_shift = p->facts.max_shift;
    out->tolerance = p->facts.tolerance;
    out->invalid = p->facts.invalid;
    out->null = p->facts.null;
    out->other = p->facts.other;
    return done;
}

/* ---- Solving ----------------------------------------------------------------------------------------------------- */

bool gis_in_parts_solve(gis_in_parts *p, const gis_layer_input *input, gis_progress *progress,
                        sunder_layer_summary *summary, gis_error *error)
{
    /* How far the core is with a part tells nobody anything; but it hears of signals that way. */
    gis_progress silent = gis_progress_new(GIS_PROGRESS_NONE);
    sunder_layer_options how = gis_layer_core_options(input);
    how.progress = gis_progress_call;
    how.progress_user = &silent;
    const double began = gis_clock();
    if (!gis_layout_make(p->spool, &how, p->request->rules.block_field != NULL, &p->layout, error)) return false;
    for (unsigned k = 0; k < SHARDS; k += p->at_once) {
        const unsigned end = k + p->at_once < SHARDS ? k + p->at_once : SHARDS;
        if (!gis_parts_shards(&p->layout, k, end, &p->result, error)) return false;
        gis_progress_call(MOSTLY_SHARDS * end / SHARDS, progress);
        if (!gis_go_on(error)) return false;
    }
    if (!gis_parts_join(&p->layout, &p->result, &p->joined, error)) return false;
    gis_layout_clear(&p->layout); /* which borrows `silent` */
    *summary = p->joined.summary;
    summary->features = p->facts.source.features;
    summary->vertices = p->facts.vertices;
    summary->skipped = p->facts.skipped;
    summary->seconds_solve = gis_clock() - began;
    return true;
}

GIntBig gis_in_parts_fid(const gis_in_parts *p, size_t feature)
{
    const gis_part_row *row = gis_joined_row(&p->joined, feature);
    return row ? row->fid : OGRNullFID;
}

/* ---- The main layer ---------------------------------------------------------------------------------------------- */

/* Where each list is, while features go by in their order. */
typedef struct passing {
    gis_in_parts *parts;
    gis_spool_file status;
    size_t row, still, block;
} passing;

/* Of a feature that went by, or goes: so the first of its block did. */
static gis_value block_value(const gis_in_parts *p, size_t feature)
{
    const gis_joined *j = &p->joined;
    const gis_part_link *own = gis_joined_block(j, feature);
    if (!own) return gis_block_as_value(p->facts.source.fids_unique, -1, OGRNullFID);
    return gis_block_as_value(p->facts.source.fids_unique, (int64_t)own->b,
                              p->first_fid[gis_joined_block(j, own->b) - j->block]);
}

static bool pass(passing *at, const gis_source *source, size_t i, gis_sink_layer *layer, gis_error *error)
{
    gis_in_parts *p = at->parts;
    const gis_joined *j = &p->joined;
    const size_t feature = gis_source_first(source) + i;
    unsigned char alone;
    if (!gis_spool_file_read(&at->status, feature, &alone, 1, error)) return false;
    gis_feature_row row = {.status = (sunder_feature_status)alone};
    if (at->still < j->stills && j->still[at->still].index == feature) row.status = j->still[at->still++].status;
    if (at->row < j->rows && p->result.row[j->row[at->row]].index == feature) {
        const gis_part_row *own = &p->result.row[j->row[at->row++]];
        row.dx = own->move[0];
        row.dy = own->move[1];
        row.status = own->status;
    }
    if (at->block < j->blocks && j->block[at->block].a == feature)
        p->first_fid[at->block++] = gis_source_fid(source, i);
    row.block = block_value(p, feature);
    return !layer || gis_main_row(layer, i, &row, error);
}

/* All features go by, as blocks are called by FIDs that are known then; and are written, if layer is not NULL. */
static bool write_main(gis_in_parts *p, gis_source *source, gis_sink_layer *layer, gis_error *error)
{
    passing at = {.parts = p};
    bool any = true;
    p->first_fid = malloc((p->joined.blocks + 1) * sizeof *p->first_fid);
    if (!p->first_fid) return gis_no_memory(error);
    bool done = gis_spool_file_open(&at.status, p->directory, "status", error);
    while (done && any) {
        for (size_t i = 0; i < gis_source_count(source) && done; i++) done = pass(&at, source, i, layer, error);
        any = !p->whole;
        if (any) done = done && gis_source_next(source, &any, error);
    }
    gis_spool_file_close(&at.status);
    return done;
}

/* ---- The others -------------------------------------------------------------------------------------------------- */

static gis_value id_value(const gis_in_parts *p, const char *text)
{
    if (!text || !p->facts.has_id) return (gis_value){.kind = GIS_NULL};
    if (p->facts.id_type == OFTInteger64) return (gis_value){GIS_INTEGER, {.integer = strtoll(text, NULL, 10)}};
    if (p->facts.id_type == OFTReal) return (gis_value){GIS_REAL, {.real = CPLAtof(text)}};
    return (gis_value){GIS_TEXT, {.text = text}};
}

static bool write_displacement(const gis_in_parts *p, gis_sink_layer *layer, gis_error *error)
{
    for (size_t k = 0; k < p->joined.rows; k++) {
        const gis_part_row *own = &p->result.row[p->joined.row[k]];
        if (own->move[0] == 0 && own->move[1] == 0) continue;
        const gis_arrow_row row = {.fid = gis_fid_as_value(own->fid),
                                   .id = id_value(p, own->id),
                                   .block = block_value(p, own->index),
                                   .from = {own->from[0], own->from[1]},
                                   .move = {own->move[0], own->move[1]}};
        if (!gis_go_on(error) || !gis_displacement_row(layer, &row, error)) return false;
    }
    return true;
}

static const gis_part_name *name_of(const gis_in_parts *p, size_t feature)
{
    size_t low = 0, high = p->result.names;
    while (low + 1 < high) {
        const size_t middle = (low + high) / 2;
        if (p->result.name[middle].index <= feature)
            low = middle;
        else
            high = middle;
    }
    return &p->result.name[low];
}

static GIntBig part_fid(const void *of, size_t feature) { return name_of(of, feature)->fid; }

static bool part_id(const void *of, size_t feature, char **copy, gis_value *value, gis_error *error)
{
    (void)copy;
    (void)error;
    *value = id_value(of, name_of(of, feature)->id);
    return true;
}

static bool write_conflicts(const gis_in_parts *p, const gis_things *things, gis_sink_layer *layer, gis_error *error)
{
    gis_conflict_texts scratch = {0};
    bool done = true;
    for (size_t k = 0; k < p->joined.conflicts && done; k++) {
        const sunder_conflict *c = &p->result.conflict[p->joined.conflict[k]];
        gis_value values[N_CONFLICT_COLUMNS];
        done = gis_go_on(error) && gis_things_conflict(things, c, &scratch, values, error) &&
               gis_line_row(layer, values, c->from, c->to, error);
    }
    gis_conflict_texts_clear(&scratch);
    return done;
}

static void anchor_now(const gis_in_parts *p, size_t feature, double at[2])
{
    const gis_part_row *row = gis_joined_row(&p->joined, feature);
    for (int c = 0; c < 2; c++) at[c] = name_of(p, feature)->anchor[c] + (row ? row->move[c] : 0);
}

static bool write_pushes(const gis_in_parts *p, const gis_things *things, gis_sink_layer *layer, gis_error *error)
{
    for (size_t k = 0; k < p->joined.pushes; k++) {
        const sunder_push *push = &p->result.push[p->joined.push[k]];
        gis_value values[N_PUSH_COLUMNS];
        double from[2], to[2];
        gis_things_push(things, push, values);
        anchor_now(p, push->a, from);
        anchor_now(p, push->b, to);
        if (!gis_go_on(error) || !gis_line_row(layer, values, from, to, error)) return false;
    }
    return true;
}

bool gis_in_parts_write(gis_in_parts *p, const gis_layer_input *input, const gis_in_parts_layers *layers,
                        gis_sink *sink, gis_error *error)
{
    const gis_barriers none = {0};
    const gis_things things = {p, p->facts.source.features, part_fid, part_id, &none};
    OGRSpatialReferenceH crs = gis_source_crs(input->source);
    gis_sink_layer *layer = NULL;
    const OGRFieldType id = p->facts.id_type;
    if (layers->main && !gis_main_begin(sink, &layer, error)) return false;
    if (!write_main(p, input->source, layer, error)) return false;
    if (layers->displacement &&
        (!gis_displacement_begin(sink, id, crs, &layer, error) || !write_displacement(p, layer, error)))
        return false;
    if (layers->conflicts &&
        (!gis_conflicts_begin(sink, "conflicts", id, crs, &layer, error) || !write_conflicts(p, &things, layer, error)))
        return false;
    return !layers->pushes || (gis_pushes_begin(sink, crs, &layer, error) && write_pushes(p, &things, layer, error));
}

void gis_in_parts_clear(gis_in_parts *p)
{
    gis_joined_clear(&p->joined);
    gis_part_result_clear(&p->result);
    gis_layout_clear(&p->layout);
    gis_spool_close(p->spool);
    gis_layer_facts_clear(&p->facts);
    free(p->first_fid);
    if (p->directory) gis_remove_tree(p->directory);
    gis_leftover_forget(p->leftover);
    CPLFree(p->directory);
    *p = (gis_in_parts){0};
}
