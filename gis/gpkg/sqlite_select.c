/* sqlite_select.c: see sqlite_select.h. */
#include "gpkg/sqlite_select.h"

#include "gpkg/sqlite_statement.h"

#include <string.h>

/* SQLite's numbers for types of values. */
enum { INTEGER = 1, REAL = 2, TEXT = 3, BYTES = 4 };

void *gis_sqlite_select_begin(void *database, const char *sql)
{
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    void *statement = NULL;
    return sqlite && sqlite->prepare(database, sql, -1, &statement, NULL) == GIS_SQLITE_OK ? statement : NULL;
}

void gis_sqlite_select_end(void *statement)
{
    if (statement) gis_sqlite_find_functions()->finalize(statement);
}

gis_sqlite_next gis_sqlite_select_next(void *statement)
{
    const int outcome = gis_sqlite_find_functions()->step(statement);
    return outcome == GIS_SQLITE_ROW    ? GIS_SQLITE_HAS_ROW
           : outcome == GIS_SQLITE_DONE ? GIS_SQLITE_AT_END
                                        : GIS_SQLITE_BROKEN;
}

bool gis_sqlite_select_value(void *statement, int column, gis_value *value)
{
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    void *held = sqlite->column_value(statement, column);
    *value = (gis_value){.kind = GIS_NULL};
    switch (sqlite->value_type(held)) {
    case INTEGER: *value = (gis_value){GIS_INTEGER, {.integer = sqlite->value_number(held)}}; return true;
    case REAL: *value = (gis_value){GIS_REAL, {.real = sqlite->value_real(held)}}; return true;
    case TEXT:
        *value = (gis_value){GIS_TEXT, {.text = (const char *)sqlite->value_text(held)}};
        return value->as.text && strlen(value->as.text) == (size_t)sqlite->value_size(held);
    case BYTES: return false;
    default: return true;
    }
}

const unsigned char *gis_sqlite_select_bytes(void *statement, int column, size_t *size, bool *null)
{
    const gis_sqlite_functions *sqlite = gis_sqlite_find_functions();
    void *held = sqlite->column_value(statement, column);
    const int type = sqlite->value_type(held);
    *null = type != INTEGER && type != REAL && type != TEXT && type != BYTES;
    if (type != BYTES) return NULL;
    const unsigned char *bytes = sqlite->value_bytes(held);
    *size = (size_t)sqlite->value_size(held);
    return bytes;
}
