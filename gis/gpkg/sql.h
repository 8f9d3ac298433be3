/* sql.h: runs SQL on a dataset, and detects failures, which GDAL only reports. */
#ifndef GIS_GPKG_SQL_H
#define GIS_GPKG_SQL_H

#include "base/gis_error.h"
#include "gpkg/sqlite_names.h"

#include <gdal.h>
#include <stdbool.h>

/* Runs a statement whose result is not needed; fails with "WHAT cannot be written: GDAL's reason". */
bool gis_sql_run(GDALDatasetH dataset, const char *sql, const char *what, gis_error *error);

/* The first column of the first row of a query, as text, to be freed with CPLFree(); NULL if there is no row or it is
 * null. */
char *gis_sql_ask(GDALDatasetH dataset, const char *sql);

#endif
