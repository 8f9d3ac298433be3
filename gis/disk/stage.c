/* stage.c: the hidden directory and its contents. The process that made it holds a lock on it until it ends; the lock
 * distinguishes an abandoned stage from one in use (stage_remains.c). */
#define _GNU_SOURCE
#include "disk/stage_internal.h"

#include "base/path.h"
#include "base/remove_tree.h"
#include "base/trust.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

void gis_stage_place_of(const char *final_path, char **directory, char **name)
{
    struct stat status;
    char *resolved = lstat(final_path, &status) == 0 && S_ISLNK(status.st_mode) ? realpath(final_path, NULL) : NULL;
    char *path = CPLStrdup(resolved ? resolved : final_path);
    free(resolved);
    size_t length = strlen(path);
    while (length > 1 && path[length - 1] == '/') path[--length] = '\0';
    *name = CPLStrdup(gis_path_name(path));
    *directory = gis_path_directory(path);
    if (!(*directory)[0]) {
        CPLFree(*directory);
        *directory = CPLStrdup(".");
    }
    CPLFree(path);
}

/* Closes the stage and forgets its name, when the directory was removed or stays as it is. */
static void forget_directory(gis_stage *stage)
{
    if (stage->inner >= 0) close(stage->inner);
    stage->inner = -1;
    gis_leftover_forget(stage->leftover);
    stage->leftover = NULL;
    CPLFree(stage->inside);
    stage->inside = NULL;
}

static bool cannot_write(const gis_stage *stage, int reason, gis_error *error)
{
    return gis_fail(error, "%s/%s: cannot write in %s: %s", stage->directory, stage->main, stage->directory,
                    strerror(reason));
}

bool gis_stage_new(const char *final_path, gis_stage **out, gis_error *error)
{
    gis_stage *stage = CPLCalloc(1, sizeof *stage);
    stage->inner = -1;
    gis_stage_place_of(final_path, &stage->directory, &stage->main);
    stage->outer = gis_open_directory(stage->directory);
    bool done = (stage->outer >= 0 || cannot_write(stage, errno, error)) && gis_stage_make(stage, error);
    if (done) {
        unlinkat(stage->outer, gis_path_name(stage->inside), AT_REMOVEDIR);
        forget_directory(stage);
        *out = stage;
    } else {
        gis_stage_free(stage);
    }
    return done;
}

/* ---- Making the stage -------------------------------------------------------------------------------------------- */

static bool choose_letters(char letters[6])
{
    static const char all[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
    unsigned char drawn[6];
    if (getentropy(drawn, sizeof drawn) != 0) return false;
    for (size_t k = 0; k < sizeof drawn; k++) letters[k] = all[drawn[k] % (sizeof all - 1)];
    return true;
}

/* Makes a new directory, opens it and, if possible, locks it. Returns -1 with errno on failure; EAGAIN: the name was
 * taken, or another process that removes empty stages held the lock first. */
static int make_private(int outer, const char *name)
{
    if (mkdirat(outer, name, 0700) != 0) {
        if (errno == EEXIST) errno = EAGAIN;
        return -1;
    }
    const int made = gis_open_private_directory(outer, name);
    struct stat status;
    if (made >= 0 && (flock(made, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) && fstat(made, &status) == 0 &&
        status.st_nlink > 0)
        return made;
    const int reason = made >= 0 || errno == ENOENT ? EAGAIN : errno;
    if (made >= 0) close(made);
    unlinkat(outer, name, AT_REMOVEDIR);
    errno = reason;
    return -1;
}

/* Number of attempts; more collisions with other runs are implausible. */
enum { ATTEMPTS = 100 };

bool gis_stage_make(gis_stage *stage, gis_error *error)
{
    if (stage->inside) return true;
    int reason = EAGAIN;
    for (int attempt = 0; attempt < ATTEMPTS && reason == EAGAIN; attempt++) {
        char name[] = GIS_STAGE_PREFIX "XXXXXX";
        if (!choose_letters(name + sizeof GIS_STAGE_PREFIX - 1)) return cannot_write(stage, errno, error);
        gis_hold(); /* so that a signal finds the directory registered for removal */
        stage->inner = make_private(stage->outer, name);
        reason = errno;
        if (stage->inner >= 0) {
            stage->inside = gis_path_join(stage->directory, name);
            stage->leftover = gis_leftover_temporary(stage->inside);
        }
        gis_release();
        if (stage->inner >= 0) return true;
    }
    return cannot_write(stage, reason, error);
}

void gis_stage_free(gis_stage *stage)
{
    if (!stage) return;
    if (stage->inside) gis_remove_tree_in(stage->outer, gis_path_name(stage->inside));
    forget_directory(stage);
    if (stage->outer >= 0) close(stage->outer);
    CPLFree(stage->directory);
    CPLFree(stage->main);
    CSLDestroy(stage->superseded);
    CPLFree(stage);
}

char *gis_stage_inside(const gis_stage *stage, const char *name) { return gis_path_join(stage->inside, name); }

char *gis_stage_outside(const gis_stage *stage, const char *name) { return gis_path_join(stage->directory, name); }

const char *gis_stage_main(const gis_stage *stage) { return stage->main; }

/* ---- Copying in -------------------------------------------------------------------------------------------------- */

/* Number of bytes copied at once; signals are handled in between. */
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

/* Datasets nest directories only a few levels deep. A deeper tree is not a dataset, or contains a cycle. */
enum { DEEPEST = 8 };

/* Copies a file or a directory; recurses at most DEEPEST levels. */
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
        char *child = gis_path_join(from, *name), *copy = gis_path_join(to, *name);
        done = copy_tree(child, copy, depth + 1, error);
        CPLFree(child);
        CPLFree(copy);
    }
    CSLDestroy(names);
    return done;
}

bool gis_stage_copy_in(gis_stage *stage, const char *path, gis_error *error)
{
    char *to = gis_stage_inside(stage, gis_path_name(path));
    bool done = copy_tree(path, to, 0, error);
    if (done) gis_stage_supersede(stage, path);
    CPLFree(to);
    return done;
}

void gis_stage_supersede(gis_stage *stage, const char *path)
{
    if (CSLFindString(stage->superseded, gis_path_name(path)) < 0)
        stage->superseded = CSLAddString(stage->superseded, gis_path_name(path));
}

bool gis_stage_put(gis_stage *stage, const char *name, const void *bytes, size_t n, gis_error *error)
{
    int out = openat(stage->inner, name, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    bool done = out >= 0 && write_all(out, bytes, n);
    int reason = errno;
    if (out >= 0 && close(out) != 0 && done) {
        done = false;
        reason = errno;
    }
    return done || gis_fail(error, "%s/%s: cannot be written: %s", stage->directory, name, strerror(reason));
}

bool gis_stage_put_directory(gis_stage *stage, const char *name, gis_error *error)
{
    return mkdirat(stage->inner, name, 0777) == 0 ||
           gis_fail(error, "%s/%s: cannot be made: %s", stage->directory, name, strerror(errno));
}
