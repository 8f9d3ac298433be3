/* sqlite_lock.h: tests the locks of a SQLite database from outside. Its file format defines them as byte ranges locked
 * by fcntl() ("File Locking And Concurrency In SQLite Version 3", and os.h in its source).
 *
 * Closing any descriptor of a file releases all locks that the same process has on it; so none of these functions may
 * be called while GDAL has the database open. */
#ifndef GIS_SQLITE_LOCK_H
#define GIS_SQLITE_LOCK_H

#include "base/gis_error.h"

/* How long to wait for a lock, in milliseconds: GDAL's SQLITE_BUSY_TIMEOUT. */
int gis_sqlite_patience(void);

/* Is it a plain file that begins as a SQLite database does? */
bool gis_sqlite_is(const char *path);
/* Does another process read or write the database now, or (in WAL mode) have it open? False if that cannot be
 * determined. */
bool gis_sqlite_in_use(const char *path);
/* Does another process have a write transaction open? */
bool gis_sqlite_being_written(const char *path);

/* Waits for the lock that excludes all other processes. Returns a descriptor that the caller closes; -1 with an error;
 * or -2 if the file is not writable or has no locks. */
int gis_sqlite_lock(const char *path, gis_error *error);

/* Fails with the message that another program did not release the database in time. */
bool gis_sqlite_fail_in_use(const char *path, gis_error *error);

/* Is there a journal ("-journal") of an interrupted transaction beside the database, which SQLite will roll back when
 * it opens the database? (A journal without a valid head does not count.) Is there a non-empty log ("-wal")? */
bool gis_sqlite_has_journal(const char *path);
bool gis_sqlite_has_log(const char *path);

/* The ending of a journal or log beside `path` that another user has put into a directory where all users may write
 * (base/trust.h); SQLite would apply it to the database. NULL: there is none. GIS_SQLITE_PLANTED is a message for path,
 * ending, path. */
#define GIS_SQLITE_PLANTED                                                                                             \
    "%s%s belongs to another user, in a directory in which all may write; SQLite would read it as a part of %s: "      \
    "inspect it, and move it away"
const char *gis_sqlite_planted_companion(const char *path);

#endif
