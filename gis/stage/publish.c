/* publish.c: the renames that put staged files in place, and their undoing.
 *
 * Everything is synced before the first rename. One rename is one step: a single file that replaces a single file is at
 * every moment the old one or the new one. Several are not, and the process may be killed between two of them: so a
 * record of what will be done is written and synced first, superseded files step aside into the stage, new files come
 * to their places, the main one last. As long as one new file is still in the stage the run did not finish, and whoever
 * finds the record can bring the old state back (remains.c); with the last one the new state is complete. */
#define _GNU_SOURCE
#include "stage/internal.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- Syncing ----------------------------------------------------------------------------------------------------- */

/* Some file systems know no fsync, of directories above all. */
static bool cannot_sync(int reason)
{
    return reason == EINVAL || reason == EROFS || reason == ENOTSUP || reason == EBADF;
}

/* A file must be on the disk before the rename is, else a crash could leave the name with nothing behind it. */
static bool sync_path(const char *path, gis_error *error)
{
    if (!gis_go_on(error)) return false;
    int file = open(path, O_RDONLY | O_CLOEXEC);
    bool done = file >= 0 && (fsync(file) == 0 || cannot_sync(errno));
    int reason = errno;
    if (file >= 0) close(file);
    return done || gis_fail(error, "%s: cannot be brought to the disk: %s", path, strerror(reason));
}

/* An error of the disk is kept for whoever syncs. */
void gis_stage_write_out(const gis_stage *stage)
{
#ifdef SYNC_FILE_RANGE_WRITE
    char *path = gis_stage_inside(stage, gis_stage_main(stage));
    const int file = open(path, O_RDONLY | O_CLOEXEC);
    if (file >= 0) {
        (void)sync_file_range(file, 0, 0, SYNC_FILE_RANGE_WRITE);
        close(file);
    }
    CPLFree(path);
#else
    (void)stage;
#endif
}

static bool is_dots(const char *name) { return strcmp(name, ".") == 0 || strcmp(name, "..") == 0; }

static bool is_directory(const char *path)
{
    struct stat status;
    return lstat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

/* A file, or a directory after all that is in it. */
static bool sync_tree(const char *path, gis_error *error)
{
    char **names = is_directory(path) ? VSIReadDir(path) : NULL;
    bool done = true;
    for (char **name = names; done && name && *name; name++) {
        if (is_dots(*name)) continue;
        char *child = gis_join(path, *name);
        done = sync_tree(child, error);
        CPLFree(child);
    }
    CSLDestroy(names);
    return done && sync_path(path, error);
}

/* ---- The record -------------------------------------------------------------------------------------------------- */

static void record_name(FILE *file, const char *kind, const char *name)
{
    char *escaped = CPLEscapeString(name, -1, CPLES_BackslashQuotable);
    fprintf(file, "%s%s\n", kind, escaped);
    CPLFree(escaped);
}

bool gis_stage_mark(const char *path, char mark[GIS_MARK_SIZE])
{
    struct stat status;
    if (lstat(path, &status) != 0) return false;
    snprintf(mark, GIS_MARK_SIZE, "%ju-%jd-%jd.%ld", (uintmax_t)status.st_ino, (intmax_t)status.st_size,
             (intmax_t)status.st_mtim.tv_sec, status.st_mtim.tv_nsec);
    return true;
}

static void record_new(const gis_stage *stage, FILE *file, const char *name)
{
    char *path = gis_join(stage->inside, name), mark[GIS_MARK_SIZE], kind[GIS_MARK_SIZE + 8];
    if (gis_stage_mark(path, mark)) {
        snprintf(kind, sizeof kind, GIS_RECORD_NEW "%s ", mark);
        record_name(file, kind, name);
    }
    CPLFree(path);
}

static bool write_record(const gis_stage *stage, char **names, gis_error *error)
{
    char *path = gis_join(stage->inside, GIS_STAGE_RECORD);
    FILE *file = fopen(path, "wx");
    if (file) {
        record_name(file, GIS_RECORD_MAIN, stage->main);
        for (char **name = stage->superseded; name && *name; name++) record_name(file, GIS_RECORD_OLD, *name);
        for (char **name = names; *name; name++) record_new(stage, file, *name);
    }
    bool done = file && fflush(file) == 0 && !ferror(file) && (fsync(fileno(file)) == 0 || cannot_sync(errno));
    int reason = errno;
    if (file && fclose(file) != 0 && done) {
        done = false;
        reason = errno;
    }
    if (!done) gis_fail(error, "%s: %s", path, strerror(reason));
    CPLFree(path);
    return done && sync_path(stage->inside, error) && sync_path(stage->directory, error);
}

static void remove_record(const gis_stage *stage)
{
    char *path = gis_join(stage->inside, GIS_STAGE_RECORD);
    unlink(path);
    CPLFree(path);
}

/* ---- Renames ----------------------------------------------------------------------------------------------------- */

typedef struct renaming {
    char *from, *to;
} renaming;

typedef struct journal {
    renaming *done;
    int n;
} journal;

/* Without `replace` what came to this name in the meantime stays, in one step where the system has it. */
static int rename_to(const char *from, const char *to, bool replace)
{
    if (replace) return rename(from, to);
#ifdef RENAME_NOREPLACE
    if (renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE) == 0) return 0;
    if (errno != ENOSYS && errno != EINVAL) return -1;
#endif
    if (!gis_there(to)) return rename(from, to);
    errno = EEXIST;
    return -1;
}

static bool move(journal *log, const char *from, const char *to, bool replace, gis_error *error)
{
    if (rename_to(from, to, replace) != 0)
        return errno == EEXIST ? gis_fail(error, "%s: exists already", to)
                               : gis_fail(error, "%s: cannot be put in place: %s", to, strerror(errno));
    log->done[log->n++] = (renaming){CPLStrdup(from), CPLStrdup(to)};
    return true;
}

static void close_journal(journal *log, bool undo)
{
    while (log->n > 0) {
        renaming *last = &log->done[--log->n];
        if (undo) (void)!rename(last->to, last->from);
        CPLFree(last->from);
        CPLFree(last->to);
    }
    CPLFree(log->done);
}

/* Superseded files step aside, all but the main one where a plain file replaces a plain file: rename() does that in
 * one step, so that at every moment either the old or the new one is there. */
static bool step_aside(const gis_stage *stage, bool main_in_one_step, journal *log, gis_error *error)
{
    char *old = gis_join(stage->inside, GIS_STAGE_OLD);
    bool done = mkdir(old, 0700) == 0 || gis_fail(error, "%s: %s", old, strerror(errno));
    for (char **name = stage->superseded; done && name && *name; name++) {
        char *from = gis_join(stage->directory, *name), *to = gis_join(old, *name);
        if (gis_there(from) && !(main_in_one_step && strcmp(*name, stage->main) == 0))
            done = move(log, from, to, true, error);
        CPLFree(from);
        CPLFree(to);
    }
    CPLFree(old);
    return done;
}

static bool put_in_place(const gis_stage *stage, const char *name, bool may_replace, journal *log, gis_error *error)
{
    char *from = gis_join(stage->inside, name), *to = gis_join(stage->directory, name);
    bool done = move(log, from, to, may_replace, error);
    CPLFree(from);
    CPLFree(to);
    return done;
}

static bool put_all(const gis_stage *stage, char **names, bool main_in_one_step, journal *log, gis_error *error)
{
    bool done = true;
    for (char **name = names; done && *name; name++)
        if (strcmp(*name, stage->main) != 0) done = put_in_place(stage, *name, false, log, error);
    if (done && CSLFindString(names, stage->main) >= 0)
        done = put_in_place(stage, stage->main, main_in_one_step, log, error);
    return done;
}

/* ---- Publishing -------------------------------------------------------------------------------------------------- */

static bool is_plain(const char *path)
{
    struct stat status;
    return lstat(path, &status) == 0 && S_ISREG(status.st_mode);
}

/* A directory that has the name of one of the files may hold anything: it stays, and the run fails. */
static bool supersede_namesakes(gis_stage *stage, char **names, gis_error *error)
{
    bool done = true;
    for (char **name = names; done && *name; name++) {
        char *outside = gis_join(stage->directory, *name), *inside = gis_join(stage->inside, *name);
        bool in_the_way = gis_there(outside);
        if (in_the_way && is_directory(outside) && !is_directory(inside))
            done = gis_fail(error, "%s is a directory; it is not replaced by a file", outside);
        else if (in_the_way)
            gis_stage_supersede(stage, *name);
        CPLFree(outside);
        CPLFree(inside);
    }
    return done;
}

static char **staged_names(const gis_stage *stage)
{
    char **all = VSIReadDir(stage->inside), **names = CPLCalloc((size_t)CSLCount(all) + 1, sizeof *names);
    size_t n = 0;
    for (char **name = all; name && *name; name++)
        if (!is_dots(*name)) names[n++] = CPLStrdup(*name);
    CSLDestroy(all);
    return names;
}

/* How many of the superseded files are there. */
static int count_old(const gis_stage *stage)
{
    int n = 0;
    for (char **name = stage->superseded; name && *name; name++) {
        char *path = gis_join(stage->directory, *name);
        n += gis_there(path);
        CPLFree(path);
    }
    return n;
}

/* The renames, and the outcome: no signal comes between them. One that has come before is heard now or never. */
static bool rename_all(const gis_stage *stage, char **names, bool in_one_step, gis_error *error)
{
    size_t most = (size_t)(CSLCount(names) + CSLCount(stage->superseded)) + 1;
    journal log = {CPLCalloc(most, sizeof *log.done), 0};
    gis_hold();
    bool done = gis_go_on(error) && step_aside(stage, in_one_step, &log, error) &&
                put_all(stage, names, in_one_step, &log, error);
    close_journal(&log, !done);
    if (done) gis_set_outcome(GIS_DECIDED);
    gis_release();
    return done;
}

static bool put_in_order(gis_stage *stage, char **names, gis_error *error)
{
    char *main_from = gis_join(stage->inside, stage->main), *main_to = gis_join(stage->directory, stage->main);
    bool superseded = CSLFindString(stage->superseded, stage->main) >= 0;
    bool in_one_step = superseded && is_plain(main_from) && is_plain(main_to);
    int renames = CSLCount(names) + count_old(stage) - in_one_step;
    bool done = (superseded || !gis_there(main_to) || gis_fail(error, "%s: exists already", main_to)) &&
                sync_tree(stage->inside, error) && (renames < 2 || write_record(stage, names, error)) &&
                rename_all(stage, names, in_one_step, error);
    /* The new state is whole, and so is the old one: that this sync may fail changes nothing but which of them a power
     * failure leaves. */
    (void)sync_path(stage->directory, NULL);
    remove_record(stage);
    CPLFree(main_from);
    CPLFree(main_to);
    return done;
}

bool gis_stage_publish(gis_stage *stage, bool replace, gis_error *error)
{
    char **names = staged_names(stage);
    bool done = (!replace || supersede_namesakes(stage, names, error)) && put_in_order(stage, names, error);
    CSLDestroy(names);
    return done;
}
