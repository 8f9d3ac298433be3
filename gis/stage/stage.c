/* stage.c: the hidden directory and what is put in it. Its maker holds a lock on it as long as it lives: by that a
 * stage whose maker was killed is told from one at work (remains.c). */
#define _GNU_SOURCE
#include "stage/internal.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

char *gis_join(const char *directory, const char *name) { return CPLStrdup(CPLSPrintf("%s/%s", directory, name)); }

bool gis_there(const char *path)
{
    struct stat status;
    return lstat(path, &status) == 0;
}

void gis_stage_place_of(const char *final_path, char **directory, char **name)
{
    struct stat status;
    char *resolved = lstat(final_path, &status) == 0 && S_ISLNK(status.st_mode) ? realpath(final_path, NULL) : NULL;
    char *path = CPLStrdup(resolved ? resolved : final_path);
    free(resolved);
    size_t length = strlen(path);
    while (length > 1 && path[length - 1] == '/') path[--length] = '\0';
    *name = CPLStrdup(CPLGetFilename(path));
    *directory = CPLStrdup(CPLGetPath(path));
    if (!(*directory)[0]) {
        CPLFree(*directory);
        *directory = CPLStrdup(path[0] == '/' ? "/" : ".");
    }
    CPLFree(path);
}

/* Forgets the directory, which is gone, or stays as it is. */
static void leave(gis_stage *stage)
{
    if (stage->lock >= 0) close(stage->lock);
    stage->lock = -1;
    gis_leftover_forget(stage->leftover);
    stage->leftover = NULL;
    CPLFree(stage->inside);
    stage->inside = NULL;
}

bool gis_stage_new(const char *final_path, gis_stage **out, gis_error *error)
{
    gis_stage *stage = CPLCalloc(1, sizeof *stage);
    stage->lock = -1;
    gis_stage_place_of(final_path, &stage->directory, &stage->main);
    bool done = gis_stage_make(stage, error);
    if (done) {
        rmdir(stage->inside);
        leave(stage);
        *out = stage;
    } else {
        gis_stage_free(stage);
    }
    return done;
}

bool gis_stage_make(gis_stage *stage, gis_error *error)
{
    if (stage->inside) return true;
    char *inside = gis_join(stage->directory, GIS_STAGE_PREFIX "XXXXXX");
    gis_hold(); /* it is there, and known to be */
    bool made = mkdtemp(inside) != NULL;
    int reason = errno;
    stage->leftover = made ? gis_leftover_temporary(inside) : NULL;
    gis_release();
    if (!made) {
        gis_fail(error, "%s/%s: cannot write in %s: %s", stage->directory, stage->main, stage->directory,
                 strerror(reason));
        CPLFree(inside);
        return false;
    }
    stage->inside = inside;
    /* Held as long as this process lives: so the next one knows whether the stage is in use. */
    stage->lock = open(inside, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (stage->lock >= 0) (void)flock(stage->lock, LOCK_EX | LOCK_NB);
    return true;
}

void gis_stage_free(gis_stage *stage)
{
    if (!stage) return;
    if (stage->inside) VSIRmdirRecursive(stage->inside);
    leave(stage);
    CPLFree(stage->directory);
    CPLFree(stage->main);
    CSLDestroy(stage->superseded);
    CPLFree(stage);
}

char *gis_stage_inside(const gis_stage *stage, const char *name) { return gis_join(stage->inside, name); }

char *gis_stage_outside(const gis_stage *stage, const char *name) { return gis_join(stage->directory, name); }

const char *gis_stage_main(const gis_stage *stage) { return stage->main; }

/* ---- Copying in -------------------------------------------------------------------------------------------------- */

/* A piece at a time, so that a signal is heard in between. */
enum { PIECE = 1 << 20 };

static bool write_all(int to, const char *bytes, size_t n)
{
    while (n && !gis_interrupted()) {
        ssize_t put = write(to, bytes, n < PIECE ? n : PIECE);
        if (put < 0) return false;
        bytes += put;
        n -= (size_t)put;
    }
    return n == 0;
}

static bool copy_bytes(int from, int to)
{
    char *buffer = malloc(PIECE);
    ssize_t got = -1;
    while (buffer && (got = read(from, buffer, PIECE)) > 0)
        if (!write_all(to, buffer, (size_t)got)) break;
    free(buffer);
    return got == 0;
}

static bool copy_file(const char *from, const char *to, mode_t mode, gis_error *error)
{
    int in = open(from, O_RDONLY | O_CLOEXEC);
    if (in < 0) return gis_fail(error, "%s: cannot be read: %s", from, strerror(errno));
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

/* Datasets nest directories a few levels deep; what nests them deeper than this is none, or goes in circles. */
enum { DEEPEST = 8 };

/* Recurses at most DEEPEST deep. */
static bool copy_tree(const char *from, const char *to, int depth, gis_error *error)
{
    struct stat status;
    if (stat(from, &status) != 0) return gis_fail(error, "%s: %s", from, strerror(errno));
    if (!S_ISDIR(status.st_mode)) return copy_file(from, to, status.st_mode, error);
    if (depth > DEEPEST || mkdir(to, status.st_mode & 0777) != 0)
        return gis_fail(error, "%s: cannot be copied: %s", from, depth > DEEPEST ? "too deep" : strerror(errno));
    char **names = VSIReadDir(from);
    bool done = true;
    for (char **name = names; done && name && *name; name++) {
        if (strcmp(*name, ".") == 0 || strcmp(*name, "..") == 0) continue;
        char *child = gis_join(from, *name), *copy = gis_join(to, *name);
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
    if (done) gis_stage_supersede(stage, path);
    CPLFree(to);
    return done;
}

void gis_stage_supersede(gis_stage *stage, const char *path)
{
    if (CSLFindString(stage->superseded, CPLGetFilename(path)) < 0)
        stage->superseded = CSLAddString(stage->superseded, CPLGetFilename(path));
}

bool gis_stage_put(gis_stage *stage, const char *name, const void *bytes, size_t n, gis_error *error)
{
    char *to = gis_stage_inside(stage, name);
    int out = open(to, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    bool done = out >= 0 && write_all(out, bytes, n);
    int reason = errno;
    if (out >= 0 && close(out) != 0 && done) {
        done = false;
        reason = errno;
    }
    CPLFree(to);
    return done || gis_fail(error, "%s/%s: cannot be written: %s", stage->directory, name, strerror(reason));
}

bool gis_stage_put_directory(gis_stage *stage, const char *name, gis_error *error)
{
    char *to = gis_stage_inside(stage, name);
    bool done =
        mkdir(to, 0777) == 0 || gis_fail(error, "%s/%s: cannot be made: %s", stage->directory, name, strerror(errno));
    CPLFree(to);
    return done;
}
