/* sqlite_lock.c: see sqlite_lock.h. F_GETLK tests for a lock without taking it, so no other process is disturbed; on a
 * file system without locks the database counts as not in use. */
#define _GNU_SOURCE
#include "gpkg/sqlite_lock.h"

#include "base/interrupt.h"
#include "base/path.h"
#include "base/trust.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* Locks that belong to the open file instead of the process, if the system has them. */
#ifdef F_OFD_SETLK
enum { SET_LOCK = F_OFD_SETLK, GET_LOCK = F_OFD_GETLK };
#else
enum { SET_LOCK = F_SETLK, GET_LOCK = F_GETLK };
#endif

/* SQLite's lock bytes: one for a writer that waits for readers, one for a writer, and 510 for readers. */
enum { PENDING = 0x40000000, RESERVED = PENDING + 1, ALL = 512 };

static struct flock lock_range(short type, off_t start, off_t length)
{
    return (struct flock){.l_type = type, .l_whence = SEEK_SET, .l_start = start, .l_len = length};
}

int gis_sqlite_patience(void) { return atoi(CPLGetConfigOption("SQLITE_BUSY_TIMEOUT", "5000")); }

bool gis_sqlite_is(const char *path)
{
    static const char magic[16] = "SQLite format 3";
    char start[sizeof magic];
    struct stat status;
    if (stat(path, &status) != 0 || !S_ISREG(status.st_mode)) return false;
    int file = open(path, O_RDONLY | O_CLOEXEC);
    bool is = file >= 0 && pread(file, start, sizeof start, 0) == (ssize_t)sizeof start &&
              memcmp(start, magic, sizeof magic) == 0;
    if (file >= 0) close(file);
    return is;
}

/* Does another process hold a lock that conflicts with one of this type on these bytes? */
static bool lock_is_held(const char *path, short type, off_t start, off_t length)
{
    int file = open(path, O_RDONLY | O_CLOEXEC);
    struct flock lock = lock_range(type, start, length);
    bool met = file >= 0 && fcntl(file, GET_LOCK, &lock) == 0 && lock.l_type != F_UNLCK;
    if (file >= 0) close(file);
    return met;
}

bool gis_sqlite_in_use(const char *path) { return lock_is_held(path, F_WRLCK, PENDING, ALL); }

bool gis_sqlite_being_written(const char *path) { return lock_is_held(path, F_WRLCK, PENDING, 2); }

/* Milliseconds between two attempts: too short for a person to notice, much longer than an attempt takes. */
enum { MOMENT = 20 };

static void wait_a_moment(void)
{
    const struct timespec moment = {0, MOMENT * 1000000L};
    nanosleep(&moment, NULL);
}

int gis_sqlite_lock(const char *path, gis_error *error)
{
    int file = open(path, O_RDWR | O_CLOEXEC);
    if (file < 0 && (errno == EACCES || errno == EROFS || errno == EPERM))
        return -2; /* SQLite cannot write it either; the directory's permissions decide whether it can be replaced */
    if (file < 0) {
        gis_fail(error, "%s: %s", path, strerror(errno));
        return -1;
    }
    for (int waited = 0;; waited += MOMENT) {
        struct flock lock = lock_range(F_WRLCK, PENDING, ALL);
        if (fcntl(file, SET_LOCK, &lock) == 0) return file;
        if (errno != EAGAIN && errno != EACCES) {
            close(file);
            return -2;
        }
        if (waited >= gis_sqlite_patience() || gis_interrupted()) break;
        wait_a_moment();
    }
    close(file);
    gis_sqlite_fail_in_use(path, error);
    return -1;
}

bool gis_sqlite_fail_in_use(const char *path, gis_error *error)
{
    return gis_fail(
        error,
        "%s is in use by another program, which did not release it within %g s: close it there, or write another file",
        path, gis_sqlite_patience() / 1000.);
}

bool gis_sqlite_has_journal(const char *path)
{
    static const unsigned char magic[8] = {0xd9, 0xd5, 0x05, 0xf9, 0x20, 0xa1, 0x63, 0xd7};
    unsigned char start[sizeof magic];
    char *name = gis_printed("%s-journal", path);
    int file = open(name, O_RDONLY | O_CLOEXEC);
    bool has = file >= 0 && read(file, start, sizeof start) == (ssize_t)sizeof start &&
               memcmp(start, magic, sizeof magic) == 0;
    if (file >= 0) close(file);
    CPLFree(name);
    return has;
}

bool gis_sqlite_has_log(const char *path)
{
    char *name = gis_printed("%s-wal", path);
    struct stat status;
    bool has = stat(name, &status) == 0 && status.st_size > 0;
    CPLFree(name);
    return has;
}

const char *gis_sqlite_planted_companion(const char *path)
{
    static const char *const endings[] = {"-journal", "-wal"};
    const char *found = NULL;
    for (size_t k = 0; k < sizeof endings / sizeof *endings && !found; k++) {
        char *name = gis_printed("%s%s", path, endings[k]);
        if (gis_may_be_planted(name)) found = endings[k];
        CPLFree(name);
    }
    return found;
}
