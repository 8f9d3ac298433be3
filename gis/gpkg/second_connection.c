/* second_connection.c: see second_connection.h. The file is opened under the name that SQLite has for it, since GDAL's
 * connection string may contain more than a path. */
#include "gpkg/second_connection.h"

#include "gpkg/sqlite_calls.h"
#include "gpkg/sqlite_find.h"
#include "gpkg/sqlite_names.h"
#include "gpkg/sqlite_select.h"

#include <cpl_conv.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/* Constants of SQLite's programming interface. */
enum { OK = 0, OPEN_READONLY = 1, OPEN_NO_LOCK_FOR_THREADS = 0x8000 };

typedef struct calls {
    const char *(*name_of_file)(void *, const char *);
    int (*open)(const char *, void **, int, const char *);
    int (*close)(void *);
} calls;

static bool find_all(calls *sqlite)
{
    return gis_sqlite_find("sqlite3_db_filename", &sqlite->name_of_file) &&
           gis_sqlite_find("sqlite3_open_v2", &sqlite->open) && gis_sqlite_find("sqlite3_close", &sqlite->close);
}

static bool has_log(void *database)
{
    gis_value mode;
    void *statement = gis_sqlite_select_begin(database, "PRAGMA journal_mode");
    const bool known = statement && gis_sqlite_select_next(statement) == GIS_SQLITE_HAS_ROW &&
                       gis_sqlite_select_value(statement, 0, &mode) && mode.kind == GIS_TEXT;
    const bool has = !known || strcmp(mode.as.text, "wal") == 0;
    gis_sqlite_select_end(statement);
    return has;
}

/* Whether it is a plain file is found by stat() on its name: opening and closing the file here would release SQLite's
 * locks on it. */
void *gis_second_connection_open(void *database)
{
    calls sqlite;
    struct stat status;
    void *again = NULL;
    if (!find_all(&sqlite) || has_log(database)) return NULL;
    const char *name = sqlite.name_of_file(database, "main");
    if (!name || stat(name, &status) != 0 || !S_ISREG(status.st_mode)) return NULL;
    gis_sqlite_heed_signals();
    if (sqlite.open(name, &again, OPEN_READONLY | OPEN_NO_LOCK_FOR_THREADS, NULL) == OK) return again;
    sqlite.close(again);
    return NULL;
}

void gis_second_connection_close(void *again)
{
    calls sqlite;
    if (again && find_all(&sqlite)) sqlite.close(again);
}

char *gis_sql_append_stretch(char *sql, const char *key, gis_sqlite_stretch which, int64_t last)
{
    static const char *const compared[] = {NULL, "<=", ">"};
    char number[64];
    if (which == GIS_SQLITE_ALL) return sql;
    snprintf(number, sizeof number, " %s %" PRId64, compared[which], last);
    return gis_sql_append(gis_sql_append_name(gis_sql_append(sql, " WHERE "), key), number);
}

/* SQLite finds min() or max() alone by looking up the key; for both in one SELECT it would read the whole table. So two
 * subqueries are used. */
bool gis_sqlite_find_middle(void *database, const char *table, const char *key, int64_t *middle, uint64_t *span)
{
    static const char *const ask[] = {"SELECT (SELECT min(", "), (SELECT max("};
    char *sql = CPLStrdup("");
    for (int k = 0; k < 2; k++) {
        sql = gis_sql_append_name(gis_sql_append(sql, ask[k]), key);
        sql = gis_sql_append_name(gis_sql_append(sql, ") FROM "), table);
    }
    sql = gis_sql_append(sql, ")");
    void *statement = gis_sqlite_select_begin(database, sql);
    CPLFree(sql);
    gis_value least, most;
    const bool done = statement && gis_sqlite_select_next(statement) == GIS_SQLITE_HAS_ROW &&
                      gis_sqlite_select_value(statement, 0, &least) && least.kind == GIS_INTEGER &&
                      gis_sqlite_select_value(statement, 1, &most) && most.kind == GIS_INTEGER;
    if (done) *middle = least.as.integer / 2 + most.as.integer / 2;
    if (done) *span = (uint64_t)most.as.integer - (uint64_t)least.as.integer;
    gis_sqlite_select_end(statement);
    return done;
}
