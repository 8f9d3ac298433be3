/* sink_finish.c: the end of writing: close the datasets, read them back, put them in place. The order matters, since a
 * driver may report errors only when it closes, and an output in place cannot be withdrawn. */
#define _LARGEFILE64_SOURCE /* cpl_vsi.h needs struct stat64 */
#include "base/interrupt.h"
#include "base/path.h"
#include "base/resources.h"
#include "base/side_thread.h"
#include "gpkg/layer_styles.h"
#include "gpkg/sqlite_calls.h"
#include "gpkg/sqlite_lock.h"
#include "write/sink/abilities.h"
#include "write/sink/sink_internal.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* ---- Looking at what was written --------------------------------------------------------------------------------- */

static OGRLayerH find_layer(const gis_sink_layer *layer, GDALDatasetH dataset)
{
    if (layer->file || GDALDatasetGetLayerCount(dataset) == 1)
        return GDALDatasetGetLayer(dataset, 0); /* some formats name their only layer after the file */
    OGRLayerH found = GDALDatasetGetLayerByName(dataset, layer->name);
    const gis_sink *sink = layer->sink;
    if (!found && !sink->updating && (size_t)GDALDatasetGetLayerCount(dataset) == sink->n_layers)
        for (size_t i = 0; i < sink->n_layers; i++) /* others change the layer's name when they write it; then its
                                                     * number identifies it */
            if (sink->layers[i] == layer) found = GDALDatasetGetLayer(dataset, (int)i);
    return found;
}

/* The layer is not there, or the format cannot be read. Accepts a write-only format, which the user has allowed, as
 * unverified (success then means that all writes and the close succeeded), and a layer without features that the format
 * drops; fails otherwise. */
static bool leave_unread(gis_sink_layer *layer, gis_sink_result *result, gis_error *error)
{
    gis_sink *sink = layer->sink;
    const bool drops_empty = sink->format.abilities & GIS_DROPS_EMPTY;
    const bool may_be_empty = drops_empty || (sink->request.allow_inexact && !sink->format.keeps_vertices &&
                                              !EQUAL(sink->format.name, "GeoJSON"));
    if (layer->written == 0 && may_be_empty && !sink->format.only_written) {
        if (!layer->file) /* in a file of its own: the file is just empty */
            gis_sentences_add(&sink->losses, "layer %s has no features, and is not there when %s is read", layer->name,
                              sink->format.name);
        return true;
    }
    if (!sink->format.only_written)
        return gis_fail(error, "%s: layer %s cannot be read back after writing; %s", sink->request.path, layer->name,
                        sink->format.abilities
                            ? "is the disk full?"
                            : "the driver may be unable to read what it writes, or layers of this kind");
    result->exact = false;
    result->deviation = INFINITY;
    result->unread = true;
    return true;
}

/* Reads the layer back and compares it. *again is set if it must be written again with more digits. Only differences in
 * layers of features (layer->promised) go into *result; in layers of arrows and links geometries may be rounded, but
 * must be there. */
static bool inspect_layer(gis_sink_layer *layer, GDALDatasetH dataset, gis_sink_result *result, bool *again,
                          gis_error *error)
{
    gis_sink_result seen = {.exact = true};
    OGRLayerH as_written = dataset ? find_layer(layer, dataset) : NULL;
    *again = false;
    if (!as_written) return leave_unread(layer, result, error);
    if (!(layer->digests.wanted ? gis_digests_agree(layer, dataset, as_written, error)
                                : gis_sink_compare(layer, as_written, &seen, error)) ||
        !gis_sink_check_companions(layer, as_written, error) || !gis_sink_check_whole(layer, as_written, error))
        return false;
    *again = gis_sink_may_rewrite(layer, &seen);
    if (*again) return true;
    if (layer->promised) {
        result->exact = result->exact && seen.exact;
        result->deviation = fmax(result->deviation, seen.deviation);
    } else if (!isfinite(seen.deviation)) {
        gis_sentences_add(&layer->sink->losses, "layer %s: its geometries do not read back as they were written",
                          layer->name);
    }
    gis_sink_find_losses(layer, as_written);
    return true;
}

static GDALDatasetH reopen_file(gis_sink *sink, const char *file)
{
    const char *drivers[] = {sink->format.name, NULL};
    char *path = gis_sink_inside(sink, file);
    gis_sqlite_heed_signals();
    GDALDatasetH dataset = GDALOpenEx(path, GDAL_OF_VECTOR | GDAL_OF_READONLY, drivers, NULL, NULL);
    /* a file with one feature is taken for GeoJSON unless the prefix says otherwise */
    if (!dataset && EQUAL(sink->format.name, "GeoJSONSeq")) {
        char *told = gis_printed("GeoJSONSeq:%s", path);
        dataset = GDALOpenEx(told, GDAL_OF_VECTOR | GDAL_OF_READONLY, drivers, NULL, NULL);
        CPLFree(told);
    }
    CPLFree(path);
    return dataset;
}

/* Inspects a layer that has a file of its own, and rewrites it as long as that helps. */
static bool inspect_file(gis_sink_layer *layer, gis_sink_result *result, gis_error *error)
{
    bool again, done;
    do {
        GDALDatasetH dataset = reopen_file(layer->sink, layer->file);
        done = inspect_layer(layer, dataset, result, &again, error);
        if (dataset) GDALClose(dataset);
    } while (done && again && (done = gis_sink_rewrite(layer, error)));
    return done;
}

static bool inspect_layers(gis_sink *sink, gis_sink_result *result, gis_error *error)
{
    bool done = true, again;
    gis_listener listener = {0}; /* warnings of the reader are not shown to the user */
    gis_listen_begin(&listener);
    GDALDatasetH common =
        sink->format.one_layer && sink->n_layers && sink->layers[0]->file ? NULL : reopen_file(sink, sink->main_file);
    for (size_t i = 0; done && i < sink->n_layers; i++) {
        gis_sink_layer *layer = sink->layers[i];
        done = layer->file ? inspect_file(layer, result, error) : inspect_layer(layer, common, result, &again, error);
        gis_sink_forget_sent(layer);
        gis_digests_clear(&layer->digests);
    }
    if (common) GDALClose(common);
    gis_listen_end();
    gis_listener_clear(&listener);
    return done;
}

/* In a database the layers are read before the transaction is committed; afterwards it would be too late to refuse
 * them. */
static bool inspect_database(gis_sink *sink, gis_sink_result *result, gis_error *error)
{
    for (size_t i = 0; i < sink->n_layers; i++) {
        gis_sink_find_losses(sink->layers[i], sink->layers[i]->layer);
        if (!gis_digests_agree(sink->layers[i], NULL, sink->layers[i]->layer, error) ||
            !gis_sink_check_registered(sink->layers[i], error))
            return false;
    }
    if (!sink->format.keeps_doubles) {
        result->exact = false;
        result->deviation = INFINITY;
    }
    return true;
}

static bool apply_strict(const gis_sink *sink, gis_error *error)
{
    if (!sink->request.strict || !sink->losses.n) return true;
    if (sink->losses.n == 1) return gis_fail(error, "%s: %s (--strict)", sink->request.path, sink->losses.items[0]);
    return gis_fail(error, "%s: %s, and %zu more losses (--strict)", sink->request.path, sink->losses.items[0],
                    sink->losses.n - 1);
}

/* ---- From memory to where it goes -------------------------------------------------------------------------------- */

/* The number of bytes copied in one step; interrupts are handled between two steps. */
enum { COPIED_AT_ONCE = 1 << 16 };

static bool copy_stream(VSILFILE *from, FILE *to_stdout, VSILFILE *to)
{
    char *buffer = CPLMalloc(COPIED_AT_ONCE);
    bool done = true;
    for (size_t got; done && !gis_interrupted() && (got = VSIFReadL(buffer, 1, COPIED_AT_ONCE, from)) > 0;)
        done = to_stdout ? fwrite(buffer, 1, got, to_stdout) == got : VSIFWriteL(buffer, 1, got, to) == got;
    CPLFree(buffer);
    return done && !gis_interrupted();
}

static bool copy_out(gis_sink *sink, const char *file, const char *target, gis_error *error)
{
    char *inside = gis_sink_inside(sink, file);
    VSILFILE *from = VSIFOpenL(inside, "rb");
    VSILFILE *to = from && target ? VSIFOpenL(target, "wb") : NULL;
    errno = 0;
    bool done = from && (to || !target) && copy_stream(from, target ? NULL : stdout, to);
    if (to && VSIFCloseL(to) != 0) done = false;
    if (!target && fflush(stdout) != 0) done = false;
    int reason = errno;
    if (from) VSIFCloseL(from);
    CPLFree(inside);
    return done || gis_fail(error, "%s: cannot be written%s%s", sink->request.path, reason ? ": " : "",
                            reason ? strerror(reason) : "");
}

/* Copies files from memory to the stage, with directories (formats for tiles have a few levels). */
static bool stage_memory(const gis_sink *sink, const char *memory, const char *inside, gis_error *error)
{
    char **files = VSIReadDir(memory);
    bool done = true;
    for (char **file = files; file && *file && done && (done = gis_go_on(error)); file++) {
        if (strcmp(*file, ".") == 0 || strcmp(*file, "..") == 0) continue;
        char *from = gis_printed("%s/%s", memory, *file);
        char *to = inside[0] ? gis_printed("%s/%s", inside, *file) : CPLStrdup(*file);
        vsi_l_offset length = 0;
        if (gis_sink_is_directory(from)) {
            done = gis_stage_put_directory(sink->stage, to, error) && stage_memory(sink, from, to, error);
        } else {
            const GByte *bytes = VSIGetMemFileBuffer(from, &length, FALSE);
            done = gis_stage_put(sink->stage, to, bytes, (size_t)length, error);
        }
        CPLFree(from);
        CPLFree(to);
    }
    CSLDestroy(files);
    return done;
}

static bool publish_memory(gis_sink *sink, gis_error *error)
{
    char **files = VSIReadDir(sink->memory);
    int n = CSLCount(files);
    bool done = true;
    if (sink->to_stdout && n > 1)
        done = gis_fail(error, "%s: %s makes several files, which cannot go to the standard output", sink->request.path,
                        sink->format.name);
    char *base = gis_path_directory(sink->request.path);
    int copied = 0;
    for (int i = 0; done && i < n; i++) {
        char *target = sink->to_stdout ? NULL : gis_path_join(base, files[i]);
        done = copy_out(sink, files[i], target, error);
        copied += done;
        CPLFree(target);
    }
    for (int i = 0; !done && !sink->to_stdout && i <= copied && i < n; i++) {
        char *target = gis_path_join(base, files[i]);
        VSIUnlink(target);
        CPLFree(target);
    }
    if (done) gis_set_outcome(GIS_DECIDED);
    CPLFree(base);
    CSLDestroy(files);
    return done;
}

/* ---- Finish and publish ------------------------------------------------------------------------------------------ */

static bool write_styles(gis_sink *sink, gis_error *error)
{
    if (!sink->format.geopackage || sink->request.no_styles) return true;
    for (size_t i = 0; i < sink->n_layers; i++) {
        gis_sink_layer *layer = sink->layers[i];
        const gis_source *from = layer->request.as_source ? layer->source : NULL;
        if (!gis_styles_write(layer->dataset, layer->layer, layer->request.style,
                              from ? gis_source_dataset(from) : NULL, from ? gis_source_layer(from) : NULL, error))
            return false;
    }
    return true;
}

/* Ends the rows of all layers before it makes the first spatial index, since a statement about one layer makes GDAL
 * write the feature counts of all layers. */
static bool write_indexes(gis_sink *sink, gis_error *error)
{
    bool done = true;
    for (size_t i = 0; done && i < sink->n_layers; i++) done = gis_sink_rows_end(sink->layers[i], error);
    for (size_t i = 0; done && i < sink->n_layers; i++) {
        gis_sink_layer *layer = sink->layers[i];
        done = gis_rtree_end(layer->dataset, layer->layer, &layer->tree, error);
    }
    return done;
}

static bool close_all(gis_sink *sink, gis_error *error)
{
    for (size_t i = 0; i < sink->n_layers; i++)
        if (sink->layers[i]->file && !gis_sink_close(sink, sink->layers[i], error)) return false;
    return gis_sink_close(sink, NULL, error);
}

static void write_out(void *stage) { gis_stage_write_out(stage); }

/* Reads all files back. They are closed already; meanwhile another thread waits until the disk has written them. */
static bool inspect_files(gis_sink *sink, gis_sink_result *result, gis_error *error)
{
    const bool apart = sink->stage && !sink->memory && gis_threads(sink->request.threads) > 1;
    gis_side_thread *beside = apart ? gis_side_thread_new() : NULL;
    if (beside) gis_side_thread_do(beside, write_out, sink->stage);
    const bool done = inspect_layers(sink, result, error);
    gis_side_thread_free(beside);
    return done;
}

/* Notes a loss if the format rounds or changes geometries, or cannot be read back. */
static void note_inexact(gis_sink *sink, const gis_sink_result *seen)
{
    if (seen->unread)
        gis_sentences_add(&sink->losses, "what was written was not read back: %s is only written", sink->format.name);
    if (seen->exact || seen->unread) return;
    if (isfinite(seen->deviation))
        gis_sentences_add(&sink->losses, "the format rounds coordinates: they are off by up to %.9g", seen->deviation);
    else
        gis_sentences_add(&sink->losses, "the format changes geometries: they do not read back as written");
}

/* Noted after --strict was applied, since this is not a loss caused by the format. */
static void note_stream(gis_sink *sink)
{
    if (sink->to_stdout)
        gis_sentences_add(&sink->losses, "what goes to the standard output is read back in memory, not from there");
}

bool gis_sink_finish(gis_sink *sink, gis_sink_result *result, gis_error *error)
{
    gis_sink_result seen = {.exact = true};
    if (sink->place == GIS_PLACE_DATABASE) {
        if (!write_indexes(sink, error) || !write_styles(sink, error) || !gis_sink_flush(sink, error) ||
            !inspect_database(sink, &seen, error))
            return false;
    } else if (!write_indexes(sink, error) || !write_styles(sink, error) || !close_all(sink, error) ||
               !inspect_files(sink, &seen, error) ||
               (sink->stage && sink->memory && !stage_memory(sink, sink->memory, "", error))) {
        return false;
    }
    note_inexact(sink, &seen);
    if (!apply_strict(sink, error)) return false;
    note_stream(sink);
    *result = seen;
    return true;
}

/* Replaces the output by renaming. A SQLite file that is not a valid database, or is not writable, is replaced only
 * while no other process has it open: its log (-wal) would otherwise be applied to the new file. */
static bool rename_over(gis_sink *sink, gis_error *error)
{
    const char *path = sink->request.path;
    int lock = sink->request.overwrite && gis_sqlite_is(path) ? gis_sqlite_lock(path, error) : -2;
    bool done = lock != -1 && gis_stage_publish(sink->stage, sink->request.overwrite, error);
    if (lock >= 0) close(lock);
    return done;
}

/* Puts files in place. A SQLite database is replaced within its file (gis_sqlite_replace()), not by renaming: another
 * process may have it open, idle and without a lock, and what that process wrote afterwards would go to the file that
 * lost its name. */
static bool publish_files(gis_sink *sink, gis_error *error)
{
    const char *path = sink->request.path;
    gis_sqlite_outcome outcome = GIS_SQLITE_CANNOT;
    if (sink->request.overwrite && sink->format.sqlite && gis_sqlite_can_replace(path)) {
        char *inside = gis_sink_inside(sink, sink->main_file);
        outcome = gis_sqlite_replace(inside, path, error);
        CPLFree(inside);
    }
    return outcome == GIS_SQLITE_CANNOT ? rename_over(sink, error) : outcome == GIS_SQLITE_DONE;
}

bool gis_sink_publish(gis_sink *sink, gis_error *error)
{
    sink->published = sink->place == GIS_PLACE_DATABASE ? close_all(sink, error)
                      : sink->place == GIS_PLACE_FILE   ? publish_files(sink, error)
                                                        : publish_memory(sink, error);
    return sink->published;
}
