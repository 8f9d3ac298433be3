#include "read/sql.h"

bool gis_sql_run(GDALDatasetH dataset, const char *sql, const char *what, gis_error *error)
{
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    OGRLayerH result = GDALDatasetExecuteSQL(dataset, sql, NULL, NULL);
    if (result)
        GDALDatasetReleaseResultSet(dataset, result);
    gis_listen_end();
    bool done = !listener.failures;
    if (!done)
        gis_fail(error, "%s cannot be written: %s", what,
                 gis_listener_reason(&listener, "GDAL gives no reason"));
    gis_listener_clear(&listener);
    return done;
}
