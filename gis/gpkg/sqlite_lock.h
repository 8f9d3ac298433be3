/* sqlite_lock.h: the locks of a SQLite database seen from outside, as its file format lays them down: byte ranges of
 * the file, locked by fcntl() ("File Locking And Concurrency In SQLite Version 3", and os.h of its source).
 *
 * Closing any handle of a file gives up the locks that this very process has on it through others: so none of this may
 * be asked while GDAL has the database open. */
#ifndef GIS_SQLITE_LOCK_H
#define GIS_SQLITE_LOCK_H

#include "base/gis_error.h"

/* How long is waited for a lock, in milliseconds: GDAL's own SQLITE_BUSY_TIMEOUT. */
int gis_sqlite_patience(void);

/* Is it a plain file that begins as SQLite databases do? */
bool gis_sqlite_is(const char *path);
/* Does another process read or write it now, or (in WAL mode) have it open? False where nothing can be known. */
bool gis_sqlite_in_use(const char *path);
/* Is a write transaction of another process under way? */
bool gis_sqlite_being_written(const char *path);

/* Waits for the lock that excludes all other processes. Returns the handle, which the caller closes; -1 with an
 * error; or -2 if the file is not writable or has no locks. */
int gis_sqlite_lock(const char *path, gis_error *error);

/* Fails with the sentence that says that somebody did not let go of it. */
bool gis_sqlite_fail_in_use(const char *path, gis_error *error);

/* Beside a database: a journal ("-journal") of a transaction that was interrupted and that SQLite rolls back when it
 * opens the database next (one whose head was never written says nothing), or a log ("-wal") that belongs to it. */
bool gis_sqlite_has_journal(const char *path);
bool gis_sqlite_has_log(const char *path);

/* The ending of a journal or log that lies beside `path` in a directory in which all may write, and that another user
 * made (base/trust.h): SQLite would apply it to the database. NULL: there is none. The sentence takes path, ending,
 * path. */
#define GIS_SQLITE_PLANTED                                                                                             \
    "%s%s belongs to another user, in a directory in which all may write; SQLite would take it for a part of %s: "     \
    "look at it, and move it away"
const char *gis_sqlite_planted_companion(const char *path);

#endif
