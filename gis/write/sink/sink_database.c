/* sink_database.c: adds layers to a database in one transaction.
 *
 * A SQLite file (a GeoPackage) is updated in place: renaming a copy over it would lose what other programs write
 * meanwhile, and a log that another program keeps beside it would be applied to the new file. First the write lock is
 * taken, by a statement that changes nothing (GDAL begins its transactions without a lock). Then the schema that GDAL
 * read when it opened the file is checked to be current; if it is not, the file is opened again. From then to the end
 * no other program can write. The journal mode and SQLite's syncing stay as they are, so the next program that opens
 * the database rolls an interrupted transaction back. */
#define _LARGEFILE64_SOURCE /* cpl_vsi.h needs struct stat64 */
#include "base/path.h"
#include "gpkg/layer_styles.h"
#include "gpkg/sql.h"
#include "gpkg/sqlite_calls.h"
#include "gpkg/sqlite_lock.h"
#include "write/sink/sink_internal.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>

/* ---- Opening ----------------------------------------------------------------------------------------------------- */

bool gis_sink_open_for_update(gis_sink *sink, gis_error *error)
{
    char *path = gis_sink_inside(sink, sink->main_file);
    gis_sqlite_heed_signals();
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    sink->dataset = GDALOpenEx(path, GDAL_OF_VECTOR | GDAL_OF_UPDATE | GDAL_OF_VERBOSE_ERROR, NULL, NULL, NULL);
    gis_listen_end();
    CPLFree(path);
    if (!sink->dataset)
        gis_fail(error, "%s: cannot be opened to add layers: %s", sink->request.path,
                 gis_listener_reason(&listener, "GDAL gives no reason"));
    else if (!GDALDatasetTestCapability(sink->dataset, ODsCCreateLayer))
        gis_fail(error, "%s: no layers can be added to it", sink->request.path);
    gis_listener_clear(&listener);
    return sink->dataset && GDALDatasetTestCapability(sink->dataset, ODsCCreateLayer);
}

bool gis_sink_begin_transaction(gis_sink *sink, gis_error *error)
{
    if (!GDALDatasetTestCapability(sink->dataset, ODsCTransactions)) {
        if (sink->place == GIS_PLACE_DATABASE)
            return gis_fail(error, "%s: the database has no transactions", sink->request.path);
        return true;
    }
    sink->in_transaction = GDALDatasetStartTransaction(sink->dataset, FALSE) == OGRERR_NONE;
    return sink->in_transaction || gis_fail(error, "%s: no transaction can be started", sink->request.path);
}

static bool in_sqlite_file(const gis_sink *sink) { return sink->place == GIS_PLACE_DATABASE && sink->format.sqlite; }

/* ---- The lock of a SQLite file ----------------------------------------------------------------------------------- */

/* What must be the same before GDAL opens the file and after the lock is taken: the file itself (another file may have
 * been renamed to its place), and SQLite's schema version, which changes with every layer that is made or removed. */
typedef struct version {
    dev_t device;
    ino_t inode;
    char *schema; /* NULL: it cannot be read */
} version;

static version version_of(const char *path, GDALDatasetH dataset)
{
    struct stat status = {0};
    version now = {0};
    if (stat(path, &status) == 0) now = (version){status.st_dev, status.st_ino, NULL};
    now.schema = dataset ? gis_sql_ask(dataset, "PRAGMA schema_version") : NULL;
    return now;
}

static bool same_version(const version *a, const version *b)
{
    return a->device == b->device && a->inode == b->inode && a->schema && b->schema &&
           strcmp(a->schema, b->schema) == 0;
}

static version version_before(const gis_sink *sink)
{
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    GDALDatasetH dataset = GDALOpenEx(sink->request.path, GDAL_OF_VECTOR | GDAL_OF_READONLY, NULL, NULL, NULL);
    version before = version_of(sink->request.path, dataset);
    if (dataset) GDALClose(dataset);
    gis_listen_end();
    gis_listener_clear(&listener);
    return before;
}

/* A statement that could write, but changes nothing. As the first statement of its transaction it takes the write lock,
 * and waits for it. */
static char *locking_statement(const gis_sink *sink)
{
    char *table = gis_sql_ask(sink->dataset, "SELECT name FROM sqlite_master WHERE type = 'table' AND name NOT LIKE "
                                             "'sqlite_%' AND sql NOT LIKE 'CREATE VIRTUAL%' ORDER BY rowid LIMIT 1");
    char *quoted = table ? CPLEscapeString(table, -1, CPLES_SQLI) : NULL;
    char *sql = quoted ? gis_printed("DELETE FROM \"%s\" WHERE 0", quoted) : NULL;
    CPLFree(table);
    CPLFree(quoted);
    return sql;
}

static bool fail_locked(const gis_sink *sink, const char *reason, gis_error *error)
{
    return gis_fail(error,
                    "%s is in use by another program, which did not release it within %g s (%s); nothing was changed",
                    sink->request.path, gis_sqlite_patience() / 1000., reason);
}

/* ---- Nothing outside the transaction ----------------------------------------------------------------------------- */

/* SQLite ends a transaction by itself when the disk fails, and GDAL may continue; each further statement would then be
 * a transaction of its own and be committed. Two measures prevent that. First, a second connection keeps a read open,
 * so that no connection, this program's included, can commit until it is closed. (In WAL mode readers do not block
 * commits; but there nothing is written before the commit as long as the cache keeps its pages, and what is not written
 * cannot fail.) Second, a temporary table that disappears with the transaction shows whether the transaction that was
 * begun still exists. */
#define MARK "sunder_transaction"

static bool guard_transaction(gis_sink *sink, gis_error *error)
{
    char *journal = gis_printed("%s-journal", sink->request.path);
    sink->journal = gis_leftover_until(GIS_DECIDING, journal);
    CPLFree(journal);
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    sink->reader = GDALOpenEx(sink->request.path, GDAL_OF_VECTOR | GDAL_OF_READONLY, NULL, NULL, NULL);
    if (sink->reader) sink->reading = GDALDatasetExecuteSQL(sink->reader, "SELECT name FROM sqlite_master", NULL, NULL);
    /* reading one row of several keeps the statement open */
    OGRFeatureH row = sink->reading ? OGR_L_GetNextFeature(sink->reading) : NULL;
    if (row) OGR_F_Destroy(row);
    gis_listen_end();
    gis_listener_clear(&listener);
    return (row || gis_fail(error, "%s: cannot be read while it is written", sink->request.path)) &&
           gis_sql_run(sink->dataset, "PRAGMA cache_spill = 0", "the database", error) &&
           gis_sql_run(sink->dataset, "PRAGMA busy_timeout = 0", "the database", error) &&
           gis_sql_run(sink->dataset, "CREATE TEMP TABLE " MARK " (x)", "the database", error);
}

static void unguard_transaction(gis_sink *sink)
{
    if (sink->reading) GDALDatasetReleaseResultSet(sink->reader, sink->reading);
    if (sink->reader) GDALClose(sink->reader);
    gis_leftover_forget(sink->journal);
    sink->reading = NULL;
    sink->reader = NULL;
    sink->journal = NULL;
}

/* Fails if the process may not write files as large as the database (ulimit -f): rolling back rewrites the old content
 * up to the end of the file. */
static bool may_write_all_of(const char *path, gis_error *error)
{
    struct rlimit limit;
    struct stat status;
    if (getrlimit(RLIMIT_FSIZE, &limit) != 0 || stat(path, &status) != 0 || status.st_size <= 0 ||
        limit.rlim_cur == RLIM_INFINITY || (rlim_t)status.st_size <= limit.rlim_cur)
        return true;
    return gis_fail(error, "%s: it is larger than a file that this process may write (ulimit -f); nothing was changed",
                    path);
}

static bool begin_locked(gis_sink *sink, gis_error *error)
{
    if (!may_write_all_of(sink->request.path, error)) return false;
    char *sql = locking_statement(sink);
    gis_error reason;
    bool done =
        !sql ? fail_locked(sink, "its tables cannot be read", error)
             : gis_sink_begin_transaction(sink, error) && (gis_sql_run(sink->dataset, sql, "the database", &reason) ||
                                                           fail_locked(sink, reason.message, error));
    CPLFree(sql);
    return done && guard_transaction(sink, error);
}

bool gis_sink_unbroken(gis_sink *sink, gis_error *error)
{
    if (!in_sqlite_file(sink) || !sink->in_transaction) return true;
    char *mark = gis_sql_ask(sink->dataset, "SELECT 1 FROM sqlite_temp_master WHERE name = '" MARK "'");
    bool there = mark != NULL;
    CPLFree(mark);
    return there || gis_fail(error, "%s: writing failed, and the database rolled back all changes; is the disk full?",
                             sink->request.path);
}

static void abandon_dataset(gis_sink *sink)
{
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    gis_sink_roll_back(sink);
    if (sink->dataset) GDALClose(sink->dataset);
    sink->dataset = NULL;
    gis_listen_end();
    gis_listener_clear(&listener);
}

/* If the schema changed between opening and locking, the file is opened again; after this number of attempts other
 * programs are changing it all the time. */
enum { ATTEMPTS = 50 };

bool gis_sink_open_sqlite(gis_sink *sink, gis_error *error)
{
    for (int attempt = 0; attempt < ATTEMPTS; attempt++) {
        version before = version_before(sink), after = {0};
        bool locked = gis_sink_open_for_update(sink, error) && begin_locked(sink, error);
        if (locked) after = version_of(sink->request.path, sink->dataset);
        bool done = locked && same_version(&before, &after);
        CPLFree(before.schema);
        CPLFree(after.schema);
        if (done) return true;
        abandon_dataset(sink);
        if (!locked) return false;
    }
    return gis_fail(error, "%s: other programs keep changing it; nothing was changed by this one", sink->request.path);
}

/* ---- Layers that are there --------------------------------------------------------------------------------------- */

/* Called with the lock held, since the layers that were found before the work may have changed. */
bool gis_sink_make_room(gis_sink *sink, const char *name, gis_error *error)
{
    for (int i = 0; i < GDALDatasetGetLayerCount(sink->dataset); i++) {
        if (!EQUAL(OGR_L_GetName(GDALDatasetGetLayer(sink->dataset, i)), name)) continue;
        if (!sink->request.overwrite_layer)
            return gis_fail(error,
                            "%s has a layer %s by now: --overwrite-layer replaces it, --output-layer names "
                            "another",
                            sink->request.path, name);
        if (sink->format.geopackage && !gis_styles_forget(sink->dataset, name, error)) return false;
        gis_listener listener = {0};
        gis_listen_begin(&listener);
        bool done = GDALDatasetDeleteLayer(sink->dataset, i) == OGRERR_NONE && !listener.failures;
        gis_listen_end();
        if (!done)
            gis_fail(error, "%s: layer %s cannot be replaced: %s", sink->request.path, name,
                     gis_listener_reason(&listener, "GDAL gives no reason"));
        gis_listener_clear(&listener);
        return done && gis_sink_unbroken(sink, error);
    }
    return true;
}

/* ---- The end of the transaction ---------------------------------------------------------------------------------- */

bool gis_sink_flush(gis_sink *sink, gis_error *error)
{
    gis_sink_layer *last = sink->n_layers ? sink->layers[sink->n_layers - 1] : NULL;
    if (sink->place != GIS_PLACE_DATABASE || !last || !last->layer) return true;
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    GDALFlushCache(sink->dataset);
    gis_listen_end();
    bool done = !listener.failures;
    if (!done)
        gis_fail(error, "%s, layer %s: writing failed: %s", sink->request.path, last->name,
                 gis_listener_reason(&listener, "GDAL gives no reason"));
    gis_listener_clear(&listener);
    return done && gis_sink_unbroken(sink, error);
}

/* Blocks further writes: what GDAL would write when it closes the file would be outside the transaction. */
static void seal_database(gis_sink *sink)
{
    if (in_sqlite_file(sink)) gis_sql_run(sink->dataset, "PRAGMA query_only = 1", "the database", NULL);
}

void gis_sink_roll_back(gis_sink *sink)
{
    if (sink->in_transaction) {
        GDALDatasetRollbackTransaction(sink->dataset);
        seal_database(sink);
    }
    sink->in_transaction = false;
    unguard_transaction(sink);
}

/* Before the commit: closes this program's reader, and lets SQLite wait for other programs' readers. */
static bool clear_the_way(gis_sink *sink, gis_error *error)
{
    char wait[64];
    snprintf(wait, sizeof wait, "PRAGMA busy_timeout = %d", gis_sqlite_patience());
    if (!in_sqlite_file(sink)) return true;
    if (!gis_sink_unbroken(sink, error) || !gis_sql_run(sink->dataset, wait, "the database", error)) return false;
    unguard_transaction(sink);
    return true;
}

bool gis_sink_end_transaction(gis_sink *sink, gis_error *error)
{
    if (!sink->in_transaction) return true;
    bool final = sink->place == GIS_PLACE_DATABASE; /* a file in the stage is published later */
    if (!clear_the_way(sink, error) || (final && !gis_decide(error))) return false;
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    bool done = GDALDatasetCommitTransaction(sink->dataset) == OGRERR_NONE && !listener.failures;
    gis_listen_end();
    sink->in_transaction = !done; /* true if the commit failed: it must be rolled back */
    if (final) gis_set_outcome(done ? GIS_DECIDED : GIS_OPEN);
    if (!done && sink->format.sqlite && strstr(listener.first, "locked"))
        fail_locked(sink, listener.first, error);
    else if (!done)
        gis_fail(error, "%s: writing failed: %s", sink->request.path,
                 gis_listener_reason(&listener, "the transaction cannot be committed"));
    else
        seal_database(sink);
    gis_listener_clear(&listener);
    return done;
}
