/* sqlite_calls.c: see sqlite_calls.h. Types and constants are those of SQLite's programming interface, which does not
 * change. */
#define _GNU_SOURCE
#include "gpkg/sqlite_calls.h"

#include "base/interrupt.h"
#include "gpkg/sqlite_find.h"
#include "gpkg/sqlite_lock.h"

#include <dlfcn.h>
#include <string.h>
#include <unistd.h>

typedef struct sqlite3 sqlite3;
typedef struct sqlite3_backup sqlite3_backup;

enum { OK = 0, BUSY = 5, LOCKED = 6, READONLY = 8, CORRUPT = 11, NOTADB = 26, DONE = 101 };
enum { OPEN_READONLY = 1, OPEN_READWRITE = 2 };
enum { RESULT = 0xff }; /* the low byte of a result code; the rest is detail */

/* Copies the address byte by byte: POSIX guarantees that a pointer to data can hold a pointer to a function. */
bool gis_sqlite_find(const char *name, void *function)
{
    void *found = dlsym(RTLD_DEFAULT, name);
    memcpy(function, &found, sizeof found);
    return found != NULL;
}

/* ---- Signals ----------------------------------------------------------------------------------------------------- */

/* SQLite calls stop_statement() every STEPS steps of a statement; some thousands of steps take a millisecond. */
enum { STEPS = 1000 };

static int stop_statement(void *user)
{
    (void)user;
    return gis_interrupted();
}

/* SQLite calls this for each database that is opened. (GDAL removes this hook when it closes a database with
 * SpatiaLite.) */
static int watch_database(sqlite3 *database, char **message, const void *routines)
{
    void (*progress_handler)(sqlite3 *, int, int (*)(void *), void *);
    (void)message;
    (void)routines;
    if (gis_sqlite_find("sqlite3_progress_handler", &progress_handler))
        progress_handler(database, STEPS, stop_statement, NULL);
    return OK;
}

void gis_sqlite_heed_signals(void)
{
    int (*auto_extension)(void (*)(void));
    if (gis_sqlite_find("sqlite3_auto_extension", &auto_extension)) auto_extension((void (*)(void))watch_database);
}

/* ---- Replacing --------------------------------------------------------------------------------------------------- */

/* Number of pages copied at once (some megabytes); signals are handled in between. */
enum { PAGES = 1024 };

typedef struct calls {
    int (*open)(const char *, sqlite3 **, int, const char *);
    int (*close)(sqlite3 *);
    int (*busy_timeout)(sqlite3 *, int);
    int (*error_code)(sqlite3 *);
    const char *(*error_message)(sqlite3 *);
    sqlite3_backup *(*begin)(sqlite3 *, const char *, sqlite3 *, const char *);
    int (*step)(sqlite3_backup *, int);
    int (*finish)(sqlite3_backup *);
} calls;

static bool find_all(calls *sqlite)
{
    return gis_sqlite_find("sqlite3_open_v2", &sqlite->open) && gis_sqlite_find("sqlite3_close", &sqlite->close) &&
           gis_sqlite_find("sqlite3_busy_timeout", &sqlite->busy_timeout) &&
           gis_sqlite_find("sqlite3_errcode", &sqlite->error_code) &&
           gis_sqlite_find("sqlite3_errmsg", &sqlite->error_message) &&
           gis_sqlite_find("sqlite3_backup_init", &sqlite->begin) &&
           gis_sqlite_find("sqlite3_backup_step", &sqlite->step) &&
           gis_sqlite_find("sqlite3_backup_finish", &sqlite->finish);
}

/* Copies the pages. The step that reaches the last page commits the transaction, so each step might. */
static bool copy_pages(const calls *sqlite, sqlite3_backup *copy, int *result, gis_error *error)
{
    do {
        if (!gis_decide(error)) return false;
        *result = sqlite->step(copy, PAGES);
        gis_set_outcome(*result == DONE ? GIS_DECIDED : GIS_OPEN);
    } while (*result == OK);
    return *result == DONE;
}

static gis_sqlite_outcome copy_all(const calls *sqlite, sqlite3 *from, sqlite3 *to, const char *name, gis_error *error)
{
    int result = OK;
    sqlite3_backup *copy = sqlite->begin(to, "main", from, "main");
    bool done = copy && copy_pages(sqlite, copy, &result, error);
    if (copy) sqlite->finish(copy); /* rolls an unfinished copy back */
    if (done) return GIS_SQLITE_DONE;
    int reason = (result ? result : sqlite->error_code(to)) & RESULT;
    if (reason == NOTADB || reason == CORRUPT) return GIS_SQLITE_CANNOT;
    if (reason == BUSY || reason == LOCKED)
        gis_sqlite_fail_in_use(name, error);
    else if (reason == READONLY)
        gis_fail(
            error,
            "%s: cannot be replaced: its page size is different, and cannot be changed in WAL mode; write another file",
            name);
    else
        gis_fail(error, "%s: writing failed: %s", name, sqlite->error_message(to));
    return GIS_SQLITE_FAILED;
}

bool gis_sqlite_can_replace(const char *path)
{
    calls sqlite;
    return gis_sqlite_is(path) && access(path, W_OK) == 0 && find_all(&sqlite);
}

gis_sqlite_outcome gis_sqlite_replace(const char *from, const char *to, gis_error *error)
{
    calls sqlite;
    sqlite3 *source = NULL, *target = NULL;
    if (!gis_sqlite_can_replace(to) || !find_all(&sqlite)) return GIS_SQLITE_CANNOT;
    gis_sqlite_outcome outcome = GIS_SQLITE_FAILED;
    if (sqlite.open(to, &target, OPEN_READWRITE, NULL) != OK)
        gis_fail(error, "%s: cannot be opened: %s", to, sqlite.error_message(target));
    else if (sqlite.open(from, &source, OPEN_READONLY, NULL) != OK)
        gis_fail(error, "%s: cannot be read: %s", from, sqlite.error_message(source));
    else if (sqlite.busy_timeout(target, gis_sqlite_patience()) == OK)
        outcome = copy_all(&sqlite, source, target, to, error);
    sqlite.close(source);
    sqlite.close(target);
    return outcome;
}
