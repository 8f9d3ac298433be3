/* sink_checks.c: what can be refused before any work is done: an output that exists, is an input, or is in use by
 * another program; a format that would change the coordinates. Everything else is found by reading back. */
#define _GNU_SOURCE
#include "base/message.h"
#include "base/path.h"
#include "base/trust.h"
#include "gpkg/sqlite_calls.h"
#include "gpkg/sqlite_lock.h"
#include "read/source_files.h"
#include "write/sink/abilities.h"
#include "write/sink/sink_internal.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <string.h>
#include <sys/stat.h>

bool gis_sink_is_input(const gis_sink *sink, const char *path)
{
    for (size_t k = 0; k <= sink->request.n_more; k++)
        if (gis_source_lies_in(gis_sink_source(sink, k), path)) return true;
    return false;
}

/* ---- What exists ------------------------------------------------------------------------------------------------- */

static GDALDatasetH open_quietly(const char *path, unsigned flags, const gis_format *format)
{
    const char *drivers[] = {format ? format->name : NULL, NULL};
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    GDALDatasetH dataset = GDALOpenEx(path, GDAL_OF_VECTOR | flags, format ? drivers : NULL, NULL, NULL);
    gis_listen_end();
    gis_listener_clear(&listener);
    return dataset;
}

static bool has_layer(GDALDatasetH dataset, const char *name)
{
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    bool found = GDALDatasetGetLayerByName(dataset, name) != NULL;
    gis_listen_end();
    gis_listener_clear(&listener);
    return found;
}

/* Is the layer of the output with this name a layer that is read? */
static bool is_input_layer(const gis_sink *sink, const char *name)
{
    for (size_t k = 0; k <= sink->request.n_more; k++) {
        const gis_source *source = gis_sink_source(sink, k);
        if (gis_source_lies_in(source, sink->request.path) && EQUAL(name, OGR_L_GetName(gis_source_layer(source))))
            return true;
    }
    return false;
}

/* Fails if the layer is an input layer itself, or exists and may not be replaced. Frees the name. */
static bool check_layer_name(const gis_sink *sink, GDALDatasetH dataset, char *name, gis_error *error)
{
    bool done = true;
    if (is_input_layer(sink, name))
        done = gis_fail(error, "layer %s of %s is the input itself; give the output another name with --output-layer",
                        name, sink->request.path);
    else if (!sink->request.overwrite_layer && has_layer(dataset, name))
        done = gis_fail(error, "%s has a layer %s already; --overwrite-layer replaces it, --output-layer names another",
                        sink->request.path, name);
    CPLFree(name);
    return done;
}

static bool check_layer_names(const gis_sink *sink, gis_error *error)
{
    GDALDatasetH dataset = open_quietly(sink->request.path, GDAL_OF_READONLY, NULL);
    if (!dataset) return gis_fail(error, "%s: cannot be opened to add layers", sink->request.path);
    bool done = check_layer_name(sink, dataset, gis_sink_name_for(sink, ""), error);
    for (size_t k = 0; done && k < sink->request.n_more; k++)
        done = check_layer_name(sink, dataset, CPLStrdup(sink->request.more[k].name), error);
    for (const char *const *suffix = sink->request.suffixes; done && suffix && *suffix; suffix++)
        done = check_layer_name(sink, dataset, gis_sink_name_for(sink, *suffix), error);
    GDALClose(dataset);
    return done;
}

/* Refuses an output that a rename must not replace: a device or a pipe, which the whole system would lose, and a link
 * that leads nowhere, which would be noticed only at the end. */
static bool check_is_file(const char *path, gis_error *error)
{
    struct stat status;
    if (lstat(path, &status) == 0 && S_ISLNK(status.st_mode) && stat(path, &status) != 0)
        return gis_fail(error, "%s is a broken link; remove it, or create its target", path);
    if (!gis_link_may_be_followed(path, "the output", error)) return false;
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode))
        return gis_fail(error, "%s is not a regular file; it is not replaced", path);
    return true;
}

/* Checks one file that the output will have, in a format with one layer a file. */
static bool check_file(const gis_sink *sink, const char *suffix, gis_error *error)
{
    char *name = gis_sink_file_for(sink, suffix);
    char *directory = gis_path_directory(sink->request.path), *path = gis_path_join(directory, name);
    CPLFree(directory);
    bool replace = sink->request.overwrite || sink->request.overwrite_layer;
    bool done = check_is_file(path, error);
    if (done && gis_sink_exists(path)) {
        if (gis_sink_is_input(sink, path))
            done = gis_fail(error, "%s: input and output are the same", path);
        else if (!replace)
            done = gis_fail(error, "%s exists already; --overwrite replaces it", path);
        else if (gis_sink_is_directory(path))
            done = gis_fail(error, "%s is a directory; it is not replaced by a file", path);
    }
    CPLFree(name);
    CPLFree(path);
    return done;
}

static bool check_files(const gis_sink *sink, gis_error *error)
{
    bool done = check_file(sink, "", error);
    for (const char *const *suffix = sink->request.suffixes; done && suffix && *suffix && !sink->to_stdout; suffix++)
        done = check_file(sink, *suffix, error);
    return done;
}

/* Warns that another program's transaction was interrupted, and has SQLite roll it back by opening the database for
 * update. "The state before the work" is then the state before that transaction. */
static void settle_journal(const gis_sink *sink)
{
    const char *path = sink->request.path;
    gis_say_warning(GIS_MESSAGE_REMAINS, "%s-journal was left by an interrupted transaction; SQLite rolls it back",
                    path);
    GDALDatasetH dataset = sink->request.update ? open_quietly(path, GDAL_OF_UPDATE, &sink->format) : NULL;
    if (dataset) GDALClose(dataset);
}

/* Refuses companion files (-wal, -journal) that somebody else put beside the database, since SQLite would read them as
 * part of it. */
static bool check_companions(const char *path, gis_error *error)
{
    const char *planted = gis_sqlite_planted_companion(path);
    return !planted || gis_fail(error, GIS_SQLITE_PLANTED, path, planted, path);
}

/* Checks the companion files of a SQLite database, and whether another program uses it while it is to be replaced. */
static bool check_database_file(const gis_sink *sink, gis_error *error)
{
    const char *path = sink->request.path;
    if (!check_companions(path, error)) return false;
    bool there = gis_sink_exists(path);
    if (!there && (gis_sqlite_has_journal(path) || gis_sqlite_has_log(path)))
        return gis_fail(error,
                        "%s%s belongs to a former database and would be read as part of the new one; move it away",
                        path, gis_sqlite_has_log(path) ? "-wal" : "-journal");
    if (there && gis_sqlite_has_journal(path) && !gis_sqlite_being_written(path)) settle_journal(sink);
    if (there && sink->request.overwrite && !gis_sink_is_input(sink, path) && !gis_sqlite_can_replace(path) &&
        gis_sqlite_in_use(path))
        return gis_fail(error, "%s is in use by another program: close it there, or write another file", path);
    return true;
}

static bool check_whole(gis_sink *sink, gis_error *error)
{
    const char *path = sink->request.path;
    if (!check_is_file(path, error) || (sink->format.sqlite && !check_database_file(sink, error))) return false;
    bool there = gis_sink_exists(path);
    if (there && sink->request.update) {
        sink->updating = true;
        if (sink->format.sqlite && sink->place == GIS_PLACE_FILE) sink->place = GIS_PLACE_DATABASE;
        return check_layer_names(sink, error);
    }
    /* A new member of the archive that is read counts as the input too, since the archive's directory is rewritten. */
    if ((there || sink->place == GIS_PLACE_MEMORY) && gis_sink_is_input(sink, path))
        return gis_fail(error, "%s: input and output are the same; --update adds layers of other names to it", path);
    if (!there) return true;
    if (!sink->request.overwrite)
        return gis_fail(error, "%s exists already; --overwrite replaces it, --update adds layers to it", path);
    if (gis_sink_is_directory(path)) { /* a directory is replaced only if it is a dataset of the same format */
        GDALDatasetH old = open_quietly(path, GDAL_OF_READONLY, &sink->format);
        if (!old)
            return gis_fail(error, "%s is a directory, and not a %s dataset: it is not replaced", path,
                            sink->format.name);
        GDALClose(old);
    }
    return true;
}

static bool check_database(gis_sink *sink, gis_error *error)
{
    if (sink->request.overwrite)
        return gis_fail_usage(error, "--overwrite would replace a whole database; use --overwrite-layer");
    sink->updating = true;
    return check_layer_names(sink, error);
}

bool gis_sink_check_existing(gis_sink *sink, gis_error *error)
{
    if (sink->request.n_more && (sink->to_stdout || sink->format.one_layer))
        return gis_fail(error, "%s: there are %zu layers, and %s holds one layer a file; write a GeoPackage",
                        sink->request.path, sink->request.n_more + 1, sink->format.name);
    if (sink->to_stdout) return true;
    if (sink->place == GIS_PLACE_DATABASE) return check_database(sink, error);
    return sink->format.one_layer ? check_files(sink, error) : check_whole(sink, error);
}

/* ---- Formats that have no place for some features ---------------------------------------------------------------- */

static bool check_geometries_of(const gis_sink *sink, const gis_source *source, gis_error *error)
{
    const size_t n = gis_source_content_count(source, GIS_NOTHING) + gis_source_content_count(source, GIS_BROKEN);
    return n == 0 || gis_fail(error,
                              "%s: %s drops features without geometry, and %zu of layer %s ha%s none: select the "
                              "others with --where, or write another format",
                              sink->request.path, sink->format.name, n, gis_source_name(source), n == 1 ? "s" : "ve");
}

bool gis_sink_check_geometries(const gis_sink *sink, gis_error *error)
{
    if (!sink->request.features || !(sink->format.abilities & GIS_NEEDS_GEOMETRY)) return true;
    for (size_t k = 0; k <= sink->request.n_more; k++)
        if (!check_geometries_of(sink, gis_sink_source(sink, k), error)) return false;
    return true;
}

/* ---- Formats that cannot hold the coordinates -------------------------------------------------------------------- */

static bool is_wgs84(OGRSpatialReferenceH crs)
{
    const char *code = OSRGetAuthorityCode(crs, NULL), *authority = OSRGetAuthorityName(crs, NULL);
    return code && authority &&
           ((EQUAL(authority, "EPSG") && EQUAL(code, "4326")) || (EQUAL(authority, "OGC") && EQUAL(code, "CRS84")));
}

bool gis_sink_check_reprojection(const gis_sink *sink, gis_error *error)
{
    OGRSpatialReferenceH crs = sink->source ? gis_source_crs(sink->source) : NULL;
    if ((sink->format.abilities & GIS_NEEDS_WGS84) && !(crs && is_wgs84(crs)))
        return gis_fail(error, "%s: %s holds only coordinates of WGS 84; write another format, or reproject the layer",
                        sink->request.path, sink->format.name);
    if (sink->format.only_written && !sink->request.allow_inexact && !sink->format.reprojects)
        return gis_fail(error,
                        "%s: GDAL cannot read %s, so the written features could not be verified; write another format, "
                        "or give --allow-inexact-output",
                        sink->request.path, sink->format.name);
    if (!sink->format.reprojects || sink->request.allow_inexact || !crs || is_wgs84(crs)) return true;
    return gis_fail(error,
                    "%s: %s would reproject the coordinates to WGS 84, so the written features could not be verified; "
                    "write another format, or give --allow-inexact-output",
                    sink->request.path, sink->format.name);
}
