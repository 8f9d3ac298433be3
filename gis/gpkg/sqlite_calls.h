/* sqlite_calls.h: what is asked of SQLite itself, past GDAL.
 *
 * It must be the very copy that GDAL uses: another one in the same process would not know of its locks. So nothing is
 * linked; the functions are looked up in the running program, and where GDAL keeps its SQLite to itself none of this
 * can be had. */
#ifndef GIS_SQLITE_CALLS_H
#define GIS_SQLITE_CALLS_H

#include "base/error.h"

/* A statement of any database that is opened from here on, until GDAL closes one, is cut short when a signal has come:
 * to be asked for before each opening. */
void gis_sqlite_heed_signals(void);

typedef enum gis_sqlite_outcome { GIS_SQLITE_DONE, GIS_SQLITE_FAILED, GIS_SQLITE_CANNOT } gis_sqlite_outcome;

/* Is it a database that this process may write, and is SQLite to be had? */
bool gis_sqlite_can_replace(const char *path);
/* The content of the database `to` becomes that of `from`, page by page, in one transaction: whoever has it open sees
 * the old content or the new one, locks are waited for (gis_sqlite_patience()), the mode of its journal stays.
 * GIS_SQLITE_CANNOT, and nothing is said: it cannot be so replaced, or is damaged. GDAL must have neither open. */
gis_sqlite_outcome gis_sqlite_replace(const char *from, const char *to, gis_error *error);

#endif
