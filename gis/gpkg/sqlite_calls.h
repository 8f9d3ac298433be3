/* sqlite_calls.h: direct calls of SQLite, without GDAL.
 *
 * They must use the same copy of SQLite as GDAL: another copy in the same process would not know its locks. So nothing
 * is linked; the functions are looked up in the running program, and are not available if GDAL hides its SQLite. */
#ifndef GIS_SQLITE_CALLS_H
#define GIS_SQLITE_CALLS_H

#include "base/gis_error.h"

/* Makes statements end early when a signal has arrived, in every database that is opened from now on, until GDAL closes
 * one. To be called before each opening. */
void gis_sqlite_heed_signals(void);

typedef enum gis_sqlite_outcome { GIS_SQLITE_DONE, GIS_SQLITE_FAILED, GIS_SQLITE_CANNOT } gis_sqlite_outcome;

/* Is it a SQLite database that this process may write, and is SQLite available? */
bool gis_sqlite_can_replace(const char *path);
/* Replaces the content of the database `to` by that of `from`, page by page, in one transaction: other connections see
 * the old content or the new one, locks are waited for (gis_sqlite_patience()), and the journal mode stays.
 * GIS_SQLITE_CANNOT, without a message: the database is damaged, or cannot be replaced in this way. GDAL must not have
 * either database open. */
gis_sqlite_outcome gis_sqlite_replace(const char *from, const char *to, gis_error *error);

#endif
