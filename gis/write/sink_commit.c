/* sink_commit.c: the end of the writing: close, look at what was written, put it in place. */
#define _LARGEFILE64_SOURCE /* cpl_vsi.h needs struct stat64 */
#include "write/sink_internal.h"
#include "write/style.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- Looking at what was written -------------------------------------------------------------------------- */

static OGRLayerH find_layer(const gis_sink_layer *layer, GDALDatasetH dataset)
{
    if (layer->file || GDALDatasetGetLayerCount(dataset) == 1)
        return GDALDatasetGetLayer(dataset, 0); /* some formats name the layer after the file */
    OGRLayerH found = GDALDatasetGetLayerByName(dataset, layer->name);
    const gis_sink *sink = layer->sink;
    if (!found && !sink->updating && (size_t)GDALDatasetGetLayerCount(dataset) == sink->n_layers)
        for (size_t i = 0; i < sink->n_layers; i++) /* others change its name when they write it */
            if (sink->layers[i] == layer)
                found = GDALDatasetGetLayer(dataset, (int)i);
    return found;
}

bool gis_sink_fail_count(const gis_sink_layer *layer, size_t read_back, gis_error *error)
{
    const gis_sink *sink = layer->sink;
    bool some_empty = layer->request.like_source && sink->source &&
                      gis_source_content_count(sink->source, GIS_NOTHING) > 0;
    return gis_fail(error, "%s, layer %s: %zu features were written, but %zu read back%s", sink->request.path,
                    layer->name, layer->written, read_back,
                    some_empty ? "; the format may have no place for features without geometry" : "");
}

static bool inspect_layer(gis_sink_layer *layer, GDALDatasetH dataset, gis_sink_result *result, gis_error *error)
{
    gis_sink *sink = layer->sink;
    OGRLayerH as_written = dataset ? find_layer(layer, dataset) : NULL;
    if (!as_written) {
        if (sink->format.keeps_doubles || !sink->request.allow_inexact)
            return gis_fail(error, "%s: layer %s cannot be read back after writing; the disk may be full",
                            sink->request.path, layer->name);
        result->exact = false; /* a format that is only written, and the user knows */
        result->deviation = INFINITY;
        return true;
    }
    GIntBig count = layer->keep_sent ? 0 : OGR_L_GetFeatureCount(as_written, TRUE);
    if (!layer->keep_sent && count != (GIntBig)layer->written)
        return gis_sink_fail_count(layer, (size_t)count, error);
    if (layer->keep_sent && !gis_sink_compare(layer, as_written, result, error))
        return false;
    gis_sink_find_losses(layer, as_written);
    return true;
}

static GDALDatasetH reopen(gis_sink *sink, const char *file)
{
    const char *drivers[] = {sink->format.name, NULL};
    char *path = gis_sink_inside(sink, file);
    GDALDatasetH dataset = GDALOpenEx(path, GDAL_OF_VECTOR | GDAL_OF_READONLY, drivers, NULL, NULL);
    CPLFree(path);
    return dataset;
}

static bool inspect(gis_sink *sink, gis_sink_result *result, gis_error *error)
{
    bool done = true;
    gis_listener listener = {0}; /* what a reader grumbles about is not our user's business */
    gis_listen_begin(&listener);
    GDALDatasetH common = sink->format.one_layer && sink->n_layers && sink->layers[0]->file
                              ? NULL
                              : reopen(sink, sink->main_file);
    for (size_t i = 0; done && i < sink->n_layers; i++) {
        gis_sink_layer *layer = sink->layers[i];
        GDALDatasetH dataset = layer->file ? reopen(sink, layer->file) : common;
        done = inspect_layer(layer, dataset, result, error);
        gis_sink_forget_sent(layer);
        if (layer->file && dataset)
            GDALClose(dataset);
    }
    if (common)
        GDALClose(common);
    gis_listen_end();
    gis_listener_clear(&listener);
    return done;
}

/* In a database the layers are looked at before the transaction ends: afterwards it would be too late to refuse. */
static void inspect_database(gis_sink *sink, gis_sink_result *result)
{
    for (size_t i = 0; i < sink->n_layers; i++)
        gis_sink_find_losses(sink->layers[i], sink->layers[i]->layer);
    if (!sink->format.keeps_doubles) {
        result->exact = false;
        result->deviation = INFINITY;
    }
}

static bool apply_strict(const gis_sink *sink, gis_error *error)
{
    if (!sink->request.strict || !sink->losses.n)
        return true;
    if (sink->losses.n == 1)
        return gis_fail(error, "%s: %s (--strict)", sink->request.path, sink->losses.items[0]);
    return gis_fail(error, "%s: %s, and %zu more losses (--strict)", sink->request.path, sink->losses.items[0],
                    sink->losses.n - 1);
}

/* ---- Out of memory's files -------------------------------------------------------------------------------- */

static bool copy_stream(VSILFILE *from, FILE *to_stdout, VSILFILE *to)
{
    static const size_t size = 1 << 16;
    char *buffer = CPLMalloc(size);
    bool done = true;
    for (size_t got; done && (got = VSIFReadL(buffer, 1, size, from)) > 0;)
        done = to_stdout ? fwrite(buffer, 1, got, to_stdout) == got : VSIFWriteL(buffer, 1, got, to) == got;
    CPLFree(buffer);
    return done;
}

static bool copy_out(gis_sink *sink, const char *file, const char *target, gis_error *error)
{
    char *inside = gis_sink_inside(sink, file);
    VSILFILE *from = VSIFOpenL(inside, "rb");
    VSILFILE *to = from && target ? VSIFOpenL(target, "wb") : NULL;
    errno = 0;
    bool done = from && (to || !target) && copy_stream(from, target ? NULL : stdout, to);
    if (to && VSIFCloseL(to) != 0)
        done = false;
    if (!target && fflush(stdout) != 0)
        done = false;
    int reason = errno;
    if (from)
        VSIFCloseL(from);
    CPLFree(inside);
    return done || gis_fail(error, "%s: cannot be written%s%s", sink->request.path, reason ? ": " : "",
                            reason ? strerror(reason) : "");
}

static bool publish_memory(gis_sink *sink, gis_error *error)
{
    char **files = VSIReadDir(sink->memory);
    int n = CSLCount(files);
    bool done = true;
    if (sink->to_stdout && n > 1)
        done = gis_fail(error, "%s: %s makes several files, which cannot go to the standard output",
                        sink->request.path, sink->format.name);
    char *base = CPLStrdup(CPLGetPath(sink->request.path));
    int copied = 0;
    for (int i = 0; done && i < n; i++) {
        char *target = sink->to_stdout ? NULL : CPLStrdup(CPLFormFilename(base, files[i], NULL));
        done = copy_out(sink, files[i], target, error);
        copied += done;
        CPLFree(target);
    }
    for (int i = 0; !done && !sink->to_stdout && i <= copied && i < n; i++) {
        char *target = CPLStrdup(CPLFormFilename(base, files[i], NULL));
        VSIUnlink(target);
        CPLFree(target);
    }
    CPLFree(base);
    CSLDestroy(files);
    return done;
}

/* ---- Finish and publish ------------------------------------------------------------------------------------ */

static bool write_styles(gis_sink *sink, gis_error *error)
{
    if (!sink->format.geopackage || sink->request.no_styles)
        return true;
    /* Any SQL makes GDAL build the spatial indexes first, for which it attaches a database, and that does not work
     * within a transaction. */
    if (!gis_sink_end_transaction(sink, error))
        return false;
    for (size_t i = 0; i < sink->n_layers; i++) {
        gis_sink_layer *layer = sink->layers[i];
        if (!gis_styles_write(layer->dataset, layer->layer, layer->request.style,
                              layer->request.as_source ? sink->source : NULL, error))
            return false;
    }
    return true;
}

static bool write_indexes(gis_sink *sink, gis_error *error)
{
    for (size_t i = 0; i < sink->n_layers; i++) {
        gis_sink_layer *layer = sink->layers[i];
        if (!gis_rtree_end(layer->dataset, layer->layer, &layer->boxes, error))
            return false;
    }
    return true;
}

static bool close_all(gis_sink *sink, gis_error *error)
{
    for (size_t i = 0; i < sink->n_layers; i++)
        if (sink->layers[i]->file && !gis_sink_close(sink, sink->layers[i], error))
            return false;
    return gis_sink_close(sink, NULL, error);
}

/* A format that rounds or changes geometries loses something, too. */
static void note_inexact(gis_sink *sink, const gis_sink_result *seen)
{
    if (seen->exact)
        return;
    if (isfinite(seen->deviation))
        gis_list_add(&sink->losses, "the format rounds coordinates: they are off by up to %.9g", seen->deviation);
    else
        gis_list_add(&sink->losses, "the format changes geometries: they do not read back as written");
}

bool gis_sink_finish(gis_sink *sink, gis_sink_result *result, gis_error *error)
{
    gis_sink_result seen = {true, 0};
    if (sink->place == GIS_PLACE_DATABASE) {
        if (!gis_sink_flush(sink, error))
            return false;
        inspect_database(sink, &seen);
    } else if (!write_indexes(sink, error) || !write_styles(sink, error) || !close_all(sink, error) ||
               !inspect(sink, &seen, error)) {
        return false;
    }
    note_inexact(sink, &seen);
    if (!apply_strict(sink, error))
        return false;
    *result = seen;
    return true;
}

bool gis_sink_publish(gis_sink *sink, gis_error *error)
{
    return sink->place == GIS_PLACE_DATABASE ? close_all(sink, error)
           : sink->place == GIS_PLACE_FILE   ? gis_stage_publish(sink->stage, sink->request.overwrite, error)
                                             : publish_memory(sink, error);
}
