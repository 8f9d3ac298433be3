/* stage_publish.c: the renames that put staged files in place, and undoing them.
 *
 * Everything is synced before the first rename. A rename is atomic: if a single file replaces a single file, the old
 * one or the new one is there at every moment. Several renames are not atomic, and the process may be killed between
 * two of them. So a record of the renames is written and synced first, replaced files are moved aside into the stage,
 * and new files are moved to their places, the main one last. As long as one new file is still in the stage the run is
 * unfinished, and the next run that finds the record can restore the old state (stage_remains.c); after the last rename
 * the new state is complete. */
#define _GNU_SOURCE
#include "disk/stage_internal.h"

#include "base/path.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- Syncing ----------------------------------------------------------------------------------------------------- */

/* Does this error mean that the file system has no fsync (for directories, for example)? */
static bool cannot_sync(int reason)
{
    return reason == EINVAL || reason == EROFS || reason == ENOTSUP || reason == EBADF;
}

/* Syncs an open file. A file must be on the disk before its rename is; otherwise a crash could leave the name without
 * the content. shown: the path, for messages. */
static bool sync_open(int file, const char *shown, gis_error *error)
{
    const bool done = file >= 0 && (fsync(file) == 0 || cannot_sync(errno));
    return done || gis_fail(error, "%s: cannot be flushed to disk: %s", shown, strerror(errno));
}

/* An error here is ignored, since the later fsync reports it again. */
void gis_stage_write_out(const gis_stage *stage)
{
#ifdef SYNC_FILE_RANGE_WRITE
    const int file = openat(stage->inner, stage->main, O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
    if (file >= 0) {
        (void)sync_file_range(file, 0, 0, SYNC_FILE_RANGE_WRITE);
        close(file);
    }
#else
    (void)stage;
#endif
}

/* Syncs a file, or a directory after everything in it. */
static bool sync_tree(int directory, const char *name, const char *shown, gis_error *error)
{
    if (!gis_go_on(error)) return false;
    const int opened = openat(directory, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    char **names = opened >= 0 && gis_entry_is_directory(directory, name) ? gis_entry_names(opened) : NULL;
    bool done = true;
    for (char **each = names; done && each && *each; each++) {
        char *child = gis_path_join(shown, *each);
        done = sync_tree(opened, *each, child, error);
        CPLFree(child);
    }
    CSLDestroy(names);
    done = done && sync_open(opened, shown, error);
    if (opened >= 0) close(opened);
    return done;
}

/* ---- The record -------------------------------------------------------------------------------------------------- */

static void record_name(FILE *file, const char *kind, const char *name)
{
    char *escaped = CPLEscapeString(name, -1, CPLES_BackslashQuotable);
    fprintf(file, "%s%s\n", kind, escaped);
    CPLFree(escaped);
}

static void record_new(const gis_stage *stage, FILE *file, const char *name)
{
    char mark[GIS_MARK_SIZE], kind[GIS_MARK_SIZE + 8];
    if (gis_entry_mark(stage->inner, name, mark)) {
        snprintf(kind, sizeof kind, GIS_RECORD_NEW "%s ", mark);
        record_name(file, kind, name);
    }
}

static FILE *make_record(const gis_stage *stage)
{
    const int made = openat(stage->inner, GIS_STAGE_RECORD, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
    FILE *file = made >= 0 ? fdopen(made, "w") : NULL;
    if (made >= 0 && !file) close(made);
    return file;
}

static bool write_record(const gis_stage *stage, char **names, gis_error *error)
{
    FILE *file = make_record(stage);
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
    if (!done) return gis_fail(error, "%s/" GIS_STAGE_RECORD ": %s", stage->inside, strerror(reason));
    return gis_go_on(error) && sync_open(stage->inner, stage->inside, error) &&
           sync_open(stage->outer, stage->directory, error);
}

static void remove_record(const gis_stage *stage) { unlinkat(stage->inner, GIS_STAGE_RECORD, 0); }

/* ---- Renames ----------------------------------------------------------------------------------------------------- */

typedef struct renaming {
    int from, to; /* descriptors of directories */
    const char *name;
} renaming;

typedef struct journal {
    renaming *done;
    int n;
} journal;

static bool move_entry(journal *log, const gis_stage *stage, renaming it, bool replace, gis_error *error)
{
    if (gis_entry_move(it.from, it.to, it.name, replace) != 0)
        return errno == EEXIST
                   ? gis_fail(error, "%s/%s: exists already", stage->directory, it.name)
                   : gis_fail(error, "%s/%s: cannot be put in place: %s", stage->directory, it.name, strerror(errno));
    log->done[log->n++] = it;
    return true;
}

static void undo_renames(journal *log)
{
    while (log->n > 0) {
        const renaming *last = &log->done[--log->n];
        (void)!renameat(last->to, last->name, last->from, last->name);
    }
}

/* Moves replaced files aside. The main file stays if a plain file replaces a plain file: rename() replaces it in one
 * step, so that the old or the new one is there at every moment. */
static bool step_aside(const gis_stage *stage, int aside, bool main_in_one_step, journal *log, gis_error *error)
{
    bool done = true;
    for (char **name = stage->superseded; done && name && *name; name++)
        if (gis_entry_is_there(stage->outer, *name) && !(main_in_one_step && strcmp(*name, stage->main) == 0))
            done = move_entry(log, stage, (renaming){stage->outer, aside, *name}, true, error);
    return done;
}

static bool put_all(const gis_stage *stage, char **names, bool main_in_one_step, journal *log, gis_error *error)
{
    bool done = true;
    for (char **name = names; done && *name; name++)
        if (strcmp(*name, stage->main) != 0)
            done = move_entry(log, stage, (renaming){stage->inner, stage->outer, *name}, false, error);
    if (done && CSLFindString(names, stage->main) >= 0)
        done = move_entry(log, stage, (renaming){stage->inner, stage->outer, stage->main}, main_in_one_step, error);
    return done;
}

/* ---- Publishing -------------------------------------------------------------------------------------------------- */

/* Marks existing files with the names of new ones as replaced. An existing directory with the name of a new file may
 * hold anything, so the run fails. */
static bool supersede_namesakes(gis_stage *stage, char **names, gis_error *error)
{
    bool done = true;
    for (char **name = names; done && *name; name++) {
        if (gis_entry_is_directory(stage->outer, *name) && !gis_entry_is_directory(stage->inner, *name))
            done = gis_fail(error, "%s/%s is a directory; it is not replaced by a file", stage->directory, *name);
        else if (gis_entry_is_there(stage->outer, *name))
            gis_stage_supersede(stage, *name);
    }
    return done;
}

/* The number of replaced files that exist. */
static int count_old(const gis_stage *stage)
{
    int n = 0;
    for (char **name = stage->superseded; name && *name; name++) n += gis_entry_is_there(stage->outer, *name);
    return n;
}

/* Makes and opens the directory to which replaced files are moved; -1: it cannot be made. */
static int make_aside(const gis_stage *stage, gis_error *error)
{
    const int opened = mkdirat(stage->inner, GIS_STAGE_OLD, 0700) == 0
                           ? openat(stage->inner, GIS_STAGE_OLD, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC)
                           : -1;
    if (opened < 0) gis_fail(error, "%s/" GIS_STAGE_OLD ": %s", stage->inside, strerror(errno));
    return opened;
}

/* Makes all renames and sets the outcome while signals are held. A signal that arrives earlier is handled before the
 * first rename, or not at all. */
static bool rename_all(const gis_stage *stage, char **names, bool in_one_step, gis_error *error)
{
    const size_t most = (size_t)(CSLCount(names) + CSLCount(stage->superseded)) + 1;
    journal log = {CPLCalloc(most, sizeof *log.done), 0};
    gis_hold();
    const int aside = gis_go_on(error) ? make_aside(stage, error) : -1;
    const bool done = aside >= 0 && step_aside(stage, aside, in_one_step, &log, error) &&
                      put_all(stage, names, in_one_step, &log, error);
    if (done)
        gis_set_outcome(GIS_DECIDED);
    else
        undo_renames(&log);
    if (aside >= 0) close(aside);
    gis_release();
    CPLFree(log.done);
    return done;
}

static bool put_in_order(gis_stage *stage, char **names, gis_error *error)
{
    const bool superseded = CSLFindString(stage->superseded, stage->main) >= 0;
    const bool in_one_step =
        superseded && gis_entry_is_file(stage->inner, stage->main) && gis_entry_is_file(stage->outer, stage->main);
    const int renames = CSLCount(names) + count_old(stage) - in_one_step;
    const bool done = (superseded || !gis_entry_is_there(stage->outer, stage->main) ||
                       gis_fail(error, "%s/%s: exists already", stage->directory, stage->main)) &&
                      sync_tree(stage->inner, ".", stage->inside, error) &&
                      (renames < 2 || write_record(stage, names, error)) &&
                      rename_all(stage, names, in_one_step, error);
    /* Whether the renames were made or undone, the state is consistent; if this sync fails, only the state after a
     * power failure is uncertain. */
    (void)sync_open(stage->outer, stage->directory, NULL);
    remove_record(stage);
    return done;
}

bool gis_stage_publish(gis_stage *stage, bool replace, gis_error *error)
{
    char **names = gis_entry_names(stage->inner), *none = NULL, **of = names ? names : &none;
    const bool done = (!replace || supersede_namesakes(stage, of, error)) && put_in_order(stage, of, error);
    CSLDestroy(names);
    return done;
}
