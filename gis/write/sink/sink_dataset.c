/* sink_dataset.c: opens and closes the datasets of a sink. They are made in the stage, or copied there for an update,
 * so that the existing output is untouched until everything is written and read back. */
#define _LARGEFILE64_SOURCE /* cpl_vsi.h needs struct stat64 */
#include "base/path.h"
#include "gpkg/sqlite_calls.h"
#include "write/sink/sink_internal.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <string.h>

/* Files that SQLite keeps beside a database that is open or was not closed properly; they are part of the data. */
static const char *const sqlite_companions[] = {"-wal", "-journal", "-shm"};

/* ---- What is replaced -------------------------------------------------------------------------------------------- */

/* Marks all files of the dataset at `path`, which is about to be replaced, to be moved aside when the stage is
 * published. */
static void supersede_dataset(gis_sink *sink, const char *path)
{
    gis_stage_supersede(sink->stage, path);
    if (gis_sink_is_directory(path)) return;
    for (size_t i = 0; i < sizeof sqlite_companions / sizeof *sqlite_companions; i++) {
        char *companion = gis_printed("%s%s", path, sqlite_companions[i]);
        if (gis_sink_exists(companion)) gis_stage_supersede(sink->stage, companion);
        CPLFree(companion);
    }
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    GDALDatasetH old = GDALOpenEx(path, GDAL_OF_VECTOR | GDAL_OF_READONLY, NULL, NULL, NULL);
    char **files = old ? GDALGetFileList(old) : NULL;
    char *directory = gis_path_directory(path);
    for (char **file = files; file && *file; file++) {
        char *its_directory = gis_path_directory(*file);
        if (strcmp(its_directory, directory) == 0) gis_stage_supersede(sink->stage, *file);
        CPLFree(its_directory);
    }
    CPLFree(directory);
    CSLDestroy(files);
    if (old) GDALClose(old);
    gis_listen_end();
    gis_listener_clear(&listener);
}

/* Marks an existing file for replacement, if that was requested. A file that appeared there after the checks, without
 * such a request, makes publishing fail. */
static void supersede_existing(gis_sink *sink, const char *file, bool may_replace)
{
    if (sink->place != GIS_PLACE_FILE || !may_replace) return;
    char *outside = gis_stage_outside(sink->stage, file);
    if (gis_sink_exists(outside)) supersede_dataset(sink, outside);
    CPLFree(outside);
}

/* ---- Making and opening ------------------------------------------------------------------------------------------ */

/* Turns SQLite's syncing off for a staged file: the file is discarded if anything fails, and synced before it is
 * published. A value that the user set by --config stays. Returns whether the setting was changed. */
static bool relax_sqlite(void)
{
    bool relaxed = !CPLGetConfigOption("OGR_SQLITE_SYNCHRONOUS", NULL);
    if (relaxed) CPLSetThreadLocalConfigOption("OGR_SQLITE_SYNCHRONOUS", "OFF");
    return relaxed;
}

static void restore_sqlite(bool relaxed)
{
    if (relaxed) CPLSetThreadLocalConfigOption("OGR_SQLITE_SYNCHRONOUS", NULL);
}

static void copy_metadata(const gis_sink *sink, GDALDatasetH to)
{
    CSLConstList all = sink->source ? GDALGetMetadata(gis_source_dataset(sink->source), NULL) : NULL;
    if (sink->format.geopackage && CSLCount(all) > 0) GDALSetMetadata(to, all, NULL);
}

static bool create_dataset(gis_sink *sink, const char *file, GDALDatasetH *out, gis_error *error)
{
    char *path = gis_sink_inside(sink, file);
    gis_sqlite_heed_signals();
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    bool relaxed = relax_sqlite();
    *out = GDALCreate(sink->format.driver, path, 0, 0, 0, GDT_Unknown, (CSLConstList)sink->request.dataset_options);
    restore_sqlite(relaxed);
    if (*out) copy_metadata(sink, *out);
    gis_listen_end();
    CPLFree(path);
    /* after an error a database may continue with some of its tables missing */
    bool done = *out && !(sink->format.sqlite && listener.failures);
    if (!done)
        gis_fail(error, "%s: cannot be created as %s: %s", sink->request.path, sink->format.name,
                 gis_listener_reason(&listener, "GDAL gives no reason"));
    gis_listener_clear(&listener);
    return done;
}

/* Copies the existing dataset into the stage; for formats that are not databases. */
static bool copy_in(gis_sink *sink, gis_error *error)
{
    char *outside = gis_stage_outside(sink->stage, sink->main_file);
    bool done = gis_stage_copy_in(sink->stage, outside, error);
    CPLFree(outside);
    return done;
}

static bool open_for_update(gis_sink *sink, gis_error *error)
{
    if (sink->place == GIS_PLACE_DATABASE && sink->format.sqlite && !sink->format.database)
        return gis_sink_open_sqlite(sink, error);
    return (sink->place != GIS_PLACE_FILE || copy_in(sink, error)) && gis_sink_open_for_update(sink, error) &&
           gis_sink_begin_transaction(sink, error);
}

bool gis_sink_dataset_for(gis_sink *sink, gis_sink_layer *layer, gis_error *error)
{
    if (sink->stage && !gis_stage_make(sink->stage, error)) return false;
    if (layer->file) {
        supersede_existing(sink, layer->file, sink->request.overwrite || sink->request.overwrite_layer);
        return create_dataset(sink, layer->file, &layer->dataset, error);
    }
    if (!sink->dataset) {
        if (!sink->updating) supersede_existing(sink, sink->main_file, sink->request.overwrite);
        if (!(sink->updating ? open_for_update(sink, error)
                             : create_dataset(sink, sink->main_file, &sink->dataset, error) &&
                                   gis_sink_begin_transaction(sink, error)))
            return false;
    }
    layer->dataset = sink->dataset;
    return !sink->updating || gis_sink_make_room(sink, layer->name, error);
}

/* ---- Closing ----------------------------------------------------------------------------------------------------- */

static void forget_handles(gis_sink *sink, GDALDatasetH dataset)
{
    for (size_t i = 0; i < sink->n_layers; i++)
        if (sink->layers[i]->dataset == dataset) {
            sink->layers[i]->dataset = NULL;
            sink->layers[i]->layer = NULL;
        }
    if (sink->dataset == dataset) sink->dataset = NULL;
}

/* Checks that a text file ends with a line break, and appends one if it does not. GDAL does not notice if this last
 * byte could not be written, and no reader misses it. */
static bool end_last_line(const gis_sink *sink, const char *file, gis_error *error)
{
    char last, *path = gis_sink_inside(sink, file);
    bool plain = sink->format.lines && gis_sink_exists(path) && !gis_sink_is_directory(path);
    VSILFILE *text = plain ? VSIFOpenL(path, "rb+") : NULL;
    bool done = !plain || (text && VSIFSeekL(text, 0, SEEK_END) == 0);
    if (text && done && VSIFTellL(text) > 0)
        done = VSIFSeekL(text, VSIFTellL(text) - 1, SEEK_SET) == 0 && VSIFReadL(&last, 1, 1, text) == 1 &&
               (last == '\n' || (VSIFSeekL(text, 0, SEEK_END) == 0 && VSIFWriteL("\n", 1, 1, text) == 1));
    if (text && VSIFCloseL(text) != 0) done = false;
    CPLFree(path);
    return done ||
           gis_fail(error, "%s: the last line of %s cannot be written; is the disk full?", sink->request.path, file);
}

bool gis_sink_close(gis_sink *sink, gis_sink_layer *layer, gis_error *error)
{
    GDALDatasetH dataset = layer ? layer->dataset : sink->dataset;
    if (!dataset) return true;
    if (dataset == sink->dataset && !gis_sink_end_transaction(sink, error)) return false;
    /* after the commit, errors of closing change nothing */
    bool committed = dataset == sink->dataset && sink->place == GIS_PLACE_DATABASE;
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    GDALFlushCache(dataset);
    GDALClose(dataset);
    gis_listen_end();
    forget_handles(sink, dataset);
    bool done = !listener.failures || committed;
    if (!done)
        gis_fail(error, "%s: writing failed: %s", sink->request.path,
                 gis_listener_reason(&listener, "GDAL gives no reason"));
    for (size_t i = 0; i < listener.warnings.n; i++)
        gis_sentences_add(&sink->warnings, "%s", listener.warnings.items[i]);
    gis_listener_clear(&listener);
    return done && end_last_line(sink, layer && layer->file ? layer->file : sink->main_file, error);
}

void gis_sink_drop(gis_sink *sink)
{
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    /* SQLite cannot roll back while statements are open */
    for (size_t i = 0; i < sink->n_layers; i++) gis_sink_rows_clear(sink->layers[i]);
    gis_sink_roll_back(sink);
    for (size_t i = 0; i < sink->n_layers; i++)
        if (sink->layers[i]->file && sink->layers[i]->dataset) {
            GDALDatasetH own = sink->layers[i]->dataset;
            forget_handles(sink, own);
            GDALClose(own);
        }
    if (sink->dataset) {
        GDALDatasetH common = sink->dataset;
        forget_handles(sink, common);
        GDALClose(common);
    }
    gis_listen_end();
    gis_listener_clear(&listener);
}
