/* sql.h: statements on a dataset whose failures GDAL only reports. */
#ifndef GIS_GPKG_SQL_H
#define GIS_GPKG_SQL_H

#include "base/gis_error.h"
#include "gpkg/sqlite_names.h"

#include <gdal.h>
#include <stdbool.h>

/* Runs one statement that returns nothing of interest; false with the error "WHAT cannot be written: GDAL's reason". */
bool gis_sql_run(GDALDatasetH dataset, const char *sql, const char *what, gis_error *error);

/* The text in the first column of the first row that a query gives, to be freed with CPLFree(); NULL if there is
 * none. */
char *gis_sql_ask(GDALDatasetH dataset, const char *sql);

#endif
