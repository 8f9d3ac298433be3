/* sink.c: creates and frees a sink: interprets a request for its destination, prepares the destination before the work,
 * and undoes the preparation after a failure. */
#define _GNU_SOURCE
#include "base/message.h"
#include "base/path.h"
#include "gpkg/sqlite_lock.h"
#include "write/sink/abilities.h"
#include "write/sink/sink_internal.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* ---- Life -------------------------------------------------------------------------------------------------------- */

/* SOURCE_DATE_EPOCH (reproducible-builds.org) fixes the dates that GDAL writes into a GeoPackage. */
static void fix_date(gis_sink *sink)
{
    const char *epoch = getenv("SOURCE_DATE_EPOCH");
    if (!epoch || !epoch[0] || CPLGetConfigOption("OGR_CURRENT_DATE", NULL)) return;
    char *end;
    time_t seconds = (time_t)strtoll(epoch, &end, 10);
    struct tm broken;
    char text[40];
    if (*end || !gmtime_r(&seconds, &broken)) return;
    strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S.000Z", &broken);
    CPLSetThreadLocalConfigOption("OGR_CURRENT_DATE", text);
    sink->set_date = true;
}

static void choose_place(gis_sink *sink)
{
    const char *path = sink->request.path;
    sink->to_stdout = strcmp(path, "/vsistdout/") == 0 || strcmp(path, "/dev/stdout") == 0;
    if (sink->format.database)
        sink->place = GIS_PLACE_DATABASE;
    else if (sink->to_stdout || strncmp(path, "/vsi", 4) == 0)
        sink->place = GIS_PLACE_MEMORY;
    else
        sink->place = GIS_PLACE_FILE;
}

static void make_memory(gis_sink *sink)
{
    sink->memory = gis_printed("/vsimem/sunder-%p", (void *)sink);
    VSIMkdir(sink->memory, 0700);
}

static bool prepare_place(gis_sink *sink, gis_error *error)
{
    if (sink->place == GIS_PLACE_FILE) {
        if (!gis_stage_new(sink->request.path, &sink->stage, error)) return false;
        sink->main_file = CPLStrdup(gis_stage_main(sink->stage));
        /* A write-only file cannot be read back, and drivers do not notice every failed write; so it is made in memory,
         * and this program writes it to disk. */
        if (sink->format.only_written && !sink->updating) make_memory(sink);
    } else if (sink->place == GIS_PLACE_MEMORY) {
        if (sink->updating)
            return gis_fail(error, "%s: --update works on plain files and databases only", sink->request.path);
        make_memory(sink);
        const char *ending = GDALGetMetadataItem(sink->format.driver, GDAL_DMD_EXTENSION, NULL);
        sink->main_file = sink->to_stdout
                              ? gis_printed("output%s%s", ending && *ending ? "." : "", ending ? ending : "")
                              : CPLStrdup(gis_path_name(sink->request.path));
    }
    return true;
}

/* Completes or undoes what an interrupted earlier run left beside the output, before the output is inspected. */
static bool recover_output(gis_sink *sink, gis_error *error)
{
    gis_sentences said = {0};
    bool done = sink->place != GIS_PLACE_FILE || gis_stage_recover(sink->request.path, &said, error);
    gis_say_warnings(GIS_MESSAGE_REMAINS, &said);
    gis_sentences_clear(&said);
    return done;
}

static bool check_request(const gis_sink_request *request, gis_error *error)
{
    if (request->overwrite && request->update)
        return gis_fail_usage(error, "--overwrite replaces the whole output and --update keeps it: give one of them");
    if (request->overwrite_layer && !request->update) return gis_fail_usage(error, "--overwrite-layer needs --update");
    return true;
}

/* Can the format keep the FIDs of this source, if it keeps any? */
static bool keeps_fids_of(const gis_format *format, const gis_source *source)
{
    return !source || (gis_source_fids_unique(source) &&
                       !((format->abilities & GIS_NEEDS_POSITIVE_FIDS) && gis_source_fids_negative(source)));
}

bool gis_sink_open(const gis_sink_request *request, const gis_source *source, gis_sink **out, gis_error *error)
{
    gis_format format;
    if (!check_request(request, error) || !gis_path_suits_gdal(request->path, "the output", error) ||
        !gis_format_find(request->path, request->format, request->layer_options, &format, error))
        return false;
    gis_sink *sink = calloc(1, sizeof *sink);
    if (!sink) return gis_no_memory(error);
    sink->request = *request;
    sink->source = source;
    sink->format = format;
    sink->fids_kept = format.keeps_fids && !request->new_fids && keeps_fids_of(&format, source);
    for (size_t k = 0; k < request->n_more; k++)
        sink->fids_kept = sink->fids_kept && keeps_fids_of(&format, request->more[k].source);
    gis_format_tell_unknown(&format, GDAL_DMD_CREATIONOPTIONLIST, request->dataset_options, &sink->losses);
    gis_format_tell_unknown(&format, GDAL_DS_LAYER_CREATIONOPTIONLIST, request->layer_options, &sink->losses);
    choose_place(sink);
    fix_date(sink);
    if (!gis_sink_check_type(sink, error) || !gis_sink_check_geometries(sink, error) ||
        !gis_sink_check_reprojection(sink, error) || !recover_output(sink, error) ||
        !gis_sink_check_existing(sink, error) || !prepare_place(sink, error)) {
        gis_sink_free(sink);
        return false;
    }
    *out = sink;
    return true;
}

void gis_sink_tell_loss(gis_sink_layer *layer, const char *sentence)
{
    gis_sentences_add(&layer->sink->losses, "%s", sentence);
}

bool gis_sink_has_null(const gis_sink_layer *layer) { return !(layer->sink->format.abilities & GIS_HAS_NO_NULL); }

bool gis_sink_takes_more(const gis_sink *sink) { return !sink->to_stdout; }

static void free_layer(gis_sink_layer *layer)
{
    gis_sink_forget_sent(layer);
    gis_digests_clear(&layer->digests);
    gis_rtree_clear(&layer->tree);
    CPLFree(layer->name);
    CPLFree(layer->file);
    free(layer->changes);
    CPLFree(layer->field_map);
    CPLFree(layer->own);
    CSLDestroy(layer->created);
    CSLDestroy(layer->own_created);
    free(layer->own_changes);
    CPLFree((void *)layer->request.fields);
    CPLFree((void *)layer->request.suffix);
    free(layer);
}

static gis_sink_layer *new_layer(gis_sink *sink, const gis_sink_layer_request *request)
{
    gis_sink_layer *layer = calloc(1, sizeof *layer);
    if (!layer) return NULL;
    layer->sink = sink;
    layer->request = *request;
    layer->request.suffix = CPLStrdup(request->suffix);
    gis_field *fields = CPLMalloc((request->n_fields + 1) * sizeof *fields);
    if (request->n_fields) memcpy(fields, request->fields, request->n_fields * sizeof *fields);
    layer->request.fields = fields;
    layer->source = gis_sink_source(sink, request->main);
    layer->name = gis_sink_name_of(sink, request);
    if (sink->format.one_layer)
        layer->file = sink->to_stdout || !request->suffix[0] ? CPLStrdup(sink->main_file)
                                                             : gis_sink_file_for(sink, request->suffix);
    layer->tree.boxes.scratch = layer->digests.sent.scratch = sink->request.scratch;
    layer->fid_field = -1;
    return layer;
}

bool gis_sink_add(gis_sink *sink, const gis_sink_layer_request *request, gis_sink_layer **out, gis_error *error)
{
    gis_sink_layer *previous = sink->n_layers ? sink->layers[sink->n_layers - 1] : NULL;
    if (previous && sink->format.one_layer && !gis_sink_close(sink, previous, error)) return false;
    if (previous && !gis_sink_rows_end(previous, error)) return false;
    if (!gis_sink_flush(sink, error)) return false;
    gis_sink_layer **layers = realloc(sink->layers, (sink->n_layers + 1) * sizeof *layers);
    if (layers) sink->layers = layers;
    gis_sink_layer *layer = layers ? new_layer(sink, request) : NULL;
    if (!layer) return gis_no_memory(error);
    sink->layers[sink->n_layers++] = layer; /* owned by the sink from here on, also if a later step fails */
    if (!gis_sink_dataset_for(sink, layer, error) || !gis_sink_create_layer(layer, error)) return false;
    *out = layer;
    return true;
}

void gis_sink_free(gis_sink *sink)
{
    if (!sink) return;
    gis_sink_drop(sink);
    if (sink->place == GIS_PLACE_DATABASE && !sink->published && sink->format.sqlite &&
        gis_sqlite_has_journal(sink->request.path) && !gis_sqlite_being_written(sink->request.path))
        gis_say_warning(GIS_MESSAGE_REMAINS,
                        "%s-journal holds the former content of the database; SQLite restores it at the next write",
                        sink->request.path);
    for (size_t i = 0; i < sink->n_layers; i++) free_layer(sink->layers[i]);
    free(sink->layers);
    gis_stage_free(sink->stage);
    if (sink->memory) VSIRmdirRecursive(sink->memory);
    CPLFree(sink->memory);
    CPLFree(sink->main_file);
    if (sink->set_rewind) CPLSetThreadLocalConfigOption("SHAPE_REWIND_ON_WRITE", NULL);
    if (sink->set_date) CPLSetThreadLocalConfigOption("OGR_CURRENT_DATE", NULL);
    gis_sentences_clear(&sink->losses);
    gis_sentences_clear(&sink->warnings);
    free(sink);
}

const gis_sentences *gis_sink_losses(const gis_sink *sink) { return &sink->losses; }

const gis_sentences *gis_sink_warnings(const gis_sink *sink) { return &sink->warnings; }
