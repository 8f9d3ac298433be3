/* Statements on a dataset whose failures GDAL only reports. */
#ifndef GIS_SQL_H
#define GIS_SQL_H

#include "base/error.h"

#include <gdal.h>
#include <stdbool.h>

/* Runs one statement that returns nothing of interest; false with the error "WHAT cannot be written: GDAL's reason". */
bool gis_sql_run(GDALDatasetH dataset, const char *sql, const char *what, gis_error *error);

#endif
