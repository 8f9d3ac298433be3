/* stage.c: a hidden directory, renames, and their undoing. */
#define _GNU_SOURCE
#include "write/stage.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Where superseded files wait, inside the stage, until all is in place. */
#define OLD "superseded~"

struct gis_stage {
    char *directory;   /* the final one */
    char *inside;      /* the stage */
    char *main;        /* base name of the main file */
    char **superseded; /* base names */
};

static char *join(const char *directory, const char *name)
{
    return CPLStrdup(CPLSPrintf("%s/%s", directory, name));
}

bool gis_stage_new(const char *final_path, gis_stage **out, gis_error *error)
{
    struct stat status;
    char *resolved = lstat(final_path, &status) == 0 && S_ISLNK(status.st_mode) ? realpath(final_path, NULL) : NULL;
    char *path = CPLStrdup(resolved ? resolved : final_path);
    free(resolved);
    size_t length = strlen(path);
    while (length > 1 && path[length - 1] == '/')
        path[--length] = '\0';
    gis_stage *stage = CPLCalloc(1, sizeof *stage);
    stage->main = CPLStrdup(CPLGetFilename(path));
    stage->directory = CPLStrdup(CPLGetPath(path));
    if (!stage->directory[0]) {
        CPLFree(stage->directory);
        stage->directory = CPLStrdup(path[0] == '/' ? "/" : ".");
    }
    CPLFree(path);
    bool done = gis_stage_make(stage, error);
    if (done) {
        rmdir(stage->inside);
        CPLFree(stage->inside);
        stage->inside = NULL;
        *out = stage;
    } else {
        gis_stage_free(stage);
    }
    return done;
}

bool gis_stage_make(gis_stage *stage, gis_error *error)
{
    if (stage->inside)
        return true;
    char *inside = join(stage->directory, ".sunder-XXXXXX");
    if (!mkdtemp(inside)) {
        gis_fail(error, "%s/%s: cannot write in %s: %s", stage->directory, stage->main, stage->directory,
                 strerror(errno));
        CPLFree(inside);
        return false;
    }
    stage->inside = inside;
    return true;
}

void gis_stage_free(gis_stage *stage)
{
    if (!stage)
        return;
    if (stage->inside)
        VSIRmdirRecursive(stage->inside);
    CPLFree(stage->inside);
    CPLFree(stage->directory);
    CPLFree(stage->main);
    CSLDestroy(stage->superseded);
    CPLFree(stage);
}

char *gis_stage_inside(const gis_stage *stage, const char *name)
{
    return join(stage->inside, name);
}

char *gis_stage_outside(const gis_stage *stage, const char *name)
{
    return join(stage->directory, name);
}

const char *gis_stage_main(const gis_stage *stage)
{
    return stage->main;
}

/* ---- Copying in ------------------------------------------------------------------------------------------- */

static bool copy_bytes(int from, int to)
{
    static const size_t size = 1 << 20;
    char *buffer = malloc(size);
    ssize_t got = -1;
    while (buffer && (got = read(from, buffer, size)) > 0) {
        for (ssize_t done = 0; done < got;) {
            ssize_t put = write(to, buffer + done, (size_t)(got - done));
            if (put < 0) {
                free(buffer);
                return false;
            }
            done += put;
        }
    }
    free(buffer);
    return got == 0;
}

static bool copy_file(const char *from, const char *to, mode_t mode, gis_error *error)
{
    int in = open(from, O_RDONLY | O_CLOEXEC);
    if (in < 0)
        return gis_fail(error, "%s: cannot be read: %s", from, strerror(errno));
    int out = open(to, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode & 0777);
    bool done = out >= 0 && copy_bytes(in, out);
    int reason = errno;
    if (out >= 0 && close(out) != 0 && done) {
        done = false;
        reason = errno;
    }
    close(in);
    return done || gis_fail(error, "%s: cannot be copied: %s", from, strerror(reason));
}

/* Recurses on directories within directories: datasets nest them one deep at most, and 8 is where we stop. */
static bool copy_tree(const char *from, const char *to, int depth, gis_error *error)
{
    struct stat status;
    if (stat(from, &status) != 0)
        return gis_fail(error, "%s: %s", from, strerror(errno));
    if (!S_ISDIR(status.st_mode))
        return copy_file(from, to, status.st_mode, error);
    if (depth > 8 || mkdir(to, status.st_mode & 0777) != 0)
        return gis_fail(error, "%s: cannot be copied: %s", from, depth > 8 ? "too deep" : strerror(errno));
    char **names = VSIReadDir(from);
    bool done = true;
    for (char **name = names; done && name && *name; name++) {
        if (strcmp(*name, ".") == 0 || strcmp(*name, "..") == 0)
            continue;
        char *child = join(from, *name), *copy = join(to, *name);
        done = copy_tree(child, copy, depth + 1, error);
        CPLFree(child);
        CPLFree(copy);
    }
    CSLDestroy(names);
    return done;
}

bool gis_stage_copy_in(gis_stage *stage, const char *path, gis_error *error)
{
    char *to = gis_stage_inside(stage, CPLGetFilename(path));
    bool done = copy_tree(path, to, 0, error);
    if (done)
        gis_stage_supersede(stage, path);
    CPLFree(to);
    return done;
}

void gis_stage_supersede(gis_stage *stage, const char *path)
{
    if (CSLFindString(stage->superseded, CPLGetFilename(path)) < 0)
        stage->superseded = CSLAddString(stage->superseded, CPLGetFilename(path));
}

/* ---- Publishing ------------------------------------------------------------------------------------------- */

typedef struct renaming {
    char *from, *to;
} renaming;

typedef struct journal {
    renaming *done;
    int n;
} journal;

static bool exists(const char *path)
{
    struct stat status;
    return lstat(path, &status) == 0;
}

static bool move(journal *log, const char *from, const char *to, gis_error *error)
{
    if (rename(from, to) != 0)
        return gis_fail(error, "%s: cannot be put in place: %s", to, strerror(errno));
    log->done[log->n++] = (renaming){CPLStrdup(from), CPLStrdup(to)};
    return true;
}

static void close_journal(journal *log, bool undo)
{
    while (log->n > 0) {
        renaming *last = &log->done[--log->n];
        if (undo)
            (void)!rename(last->to, last->from);
        CPLFree(last->from);
        CPLFree(last->to);
    }
    CPLFree(log->done);
}

/* A file must be on the disk before the rename is, else a crash could leave the name with nothing behind it. */
static bool sync_file(const char *path, gis_error *error)
{
    int file = open(path, O_RDONLY | O_CLOEXEC);
    bool done = file >= 0 && (fsync(file) == 0 || errno == EINVAL || errno == EROFS);
    int reason = errno;
    if (file >= 0)
        close(file);
    return done || gis_fail(error, "%s: %s", path, strerror(reason));
}

/* Superseded files step aside, all but the main one where a plain file replaces a plain file: rename() does that in
 * one step, so that at every moment either the old or the new one is there. */
static bool step_aside(const gis_stage *stage, bool main_in_one_step, journal *log, gis_error *error)
{
    char *old = join(stage->inside, OLD);
    bool done = mkdir(old, 0700) == 0 || gis_fail(error, "%s: %s", old, strerror(errno));
    for (char **name = stage->superseded; done && name && *name; name++) {
        char *from = join(stage->directory, *name), *to = join(old, *name);
        if (exists(from) && !(main_in_one_step && strcmp(*name, stage->main) == 0))
            done = move(log, from, to, error);
        CPLFree(from);
        CPLFree(to);
    }
    CPLFree(old);
    return done;
}

static bool put_in_place(const gis_stage *stage, const char *name, bool may_replace, journal *log, gis_error *error)
{
    char *from = join(stage->inside, name), *to = join(stage->directory, name);
    bool done = sync_file(from, error) &&
                (may_replace || !exists(to) || gis_fail(error, "%s: exists already", to)) && move(log, from, to, error);
    CPLFree(from);
    CPLFree(to);
    return done;
}

static bool is_plain(const char *path)
{
    struct stat status;
    return lstat(path, &status) == 0 && S_ISREG(status.st_mode);
}

static bool is_directory(const char *path)
{
    struct stat status;
    return lstat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

/* A directory that has the name of one of the files may hold anything: it stays, and the run fails. */
static bool supersede_namesakes(gis_stage *stage, char **names, gis_error *error)
{
    bool done = true;
    for (char **name = names; done && name && *name; name++) {
        char *outside = join(stage->directory, *name), *inside = join(stage->inside, *name);
        bool in_the_way = strcmp(*name, ".") != 0 && strcmp(*name, "..") != 0 && exists(outside);
        if (in_the_way && is_directory(outside) && !is_directory(inside))
            done = gis_fail(error, "%s is a directory; it is not replaced by a file", outside);
        else if (in_the_way)
            gis_stage_supersede(stage, *name);
        CPLFree(outside);
        CPLFree(inside);
    }
    return done;
}

bool gis_stage_publish(gis_stage *stage, bool replace, gis_error *error)
{
    char **names = VSIReadDir(stage->inside);
    if (replace && !supersede_namesakes(stage, names, error)) {
        CSLDestroy(names);
        return false;
    }
    journal log = {CPLCalloc((size_t)(CSLCount(names) + CSLCount(stage->superseded)) + 1, sizeof(renaming)), 0};
    char *main_from = join(stage->inside, stage->main), *main_to = join(stage->directory, stage->main);
    bool superseded = CSLFindString(stage->superseded, stage->main) >= 0;
    bool in_one_step = superseded && is_plain(main_from) && is_plain(main_to);
    bool done = (superseded || !exists(main_to) || gis_fail(error, "%s: exists already", main_to)) &&
                step_aside(stage, in_one_step, &log, error);
    bool has_main = false;
    for (char **name = names; done && name && *name; name++) {
        if (strcmp(*name, ".") == 0 || strcmp(*name, "..") == 0)
            continue;
        if (strcmp(*name, stage->main) == 0)
            has_main = true;
        else
            done = put_in_place(stage, *name, false, &log, error);
    }
    if (done && has_main)
        done = put_in_place(stage, stage->main, in_one_step, &log, error);
    close_journal(&log, !done);
    CPLFree(main_from);
    CPLFree(main_to);
    CSLDestroy(names);
    return done;
}
