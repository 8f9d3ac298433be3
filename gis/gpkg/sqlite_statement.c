/* sqlite_statement.c: see sqlite_statement.h. */
#include "gpkg/sqlite_statement.h"

#include "gpkg/sqlite_find.h"

#include <stddef.h>

const gis_sqlite_functions *gis_sqlite_find_functions(void)
{
    static gis_sqlite_functions f;
    static bool looked, found;
    if (looked) return found ? &f : NULL;
    looked = true;
    found =
        gis_sqlite_find("sqlite3_sourceid", &f.source_id) && gis_sqlite_find("sqlite3_prepare_v2", &f.prepare) &&
        gis_sqlite_find("sqlite3_bind_null", &f.bind_null) && gis_sqlite_find("sqlite3_bind_int64", &f.bind_number) &&
        gis_sqlite_find("sqlite3_bind_double", &f.bind_real) && gis_sqlite_find("sqlite3_bind_text", &f.bind_text) &&
        gis_sqlite_find("sqlite3_bind_blob", &f.bind_bytes) && gis_sqlite_find("sqlite3_step", &f.step) &&
        gis_sqlite_find("sqlite3_reset", &f.reset) && gis_sqlite_find("sqlite3_finalize", &f.finalize) &&
        gis_sqlite_find("sqlite3_column_blob", &f.column_bytes) &&
        gis_sqlite_find("sqlite3_column_bytes", &f.column_size) &&
        gis_sqlite_find("sqlite3_column_value", &f.column_value) &&
        gis_sqlite_find("sqlite3_value_type", &f.value_type) &&
        gis_sqlite_find("sqlite3_value_int64", &f.value_number) &&
        gis_sqlite_find("sqlite3_value_double", &f.value_real) &&
        gis_sqlite_find("sqlite3_value_text", &f.value_text) && gis_sqlite_find("sqlite3_value_blob", &f.value_bytes) &&
        gis_sqlite_find("sqlite3_value_bytes", &f.value_size) && gis_sqlite_find("sqlite3_exec", &f.run) &&
        gis_sqlite_find("sqlite3_errmsg", &f.error_message) && gis_sqlite_find("sqlite3_snprintf", &f.print);
    return found ? &f : NULL;
}
