/* file.c: see file.h. A file appears by a rename after its bytes are on the disk, so it is there completely or not at
 * all. */
#define _GNU_SOURCE
#include "disk/file.h"

#include "disk/temporary.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

char *gis_disk_path(const char *directory, const char *name)
{
    const size_t size = strlen(directory) + strlen(name) + 2;
    char *path = malloc(size);
    if (path) snprintf(path, size, "%s/%s", directory, name);
    return path;
}

static bool cannot_write(const char *path, gis_error *error)
{
    return gis_fail(error, "%s: cannot be written: %s", path, strerror(errno));
}

#define UNIQUE "XXXXXX"

static bool is_unique(const char *name)
{
    const size_t n = strlen(name), of_these = strlen(UNIQUE);
    return n > of_these && strcmp(name + n - of_these, UNIQUE) == 0;
}

/* Creates a new file. An existing file or link of this name is removed, not written into; a device is opened. */
static int open_new(const char *path)
{
    struct stat status;
    const bool there = lstat(path, &status) == 0;
    if (there && !S_ISREG(status.st_mode) && !S_ISLNK(status.st_mode))
        return open(path, O_RDWR | O_NOFOLLOW | O_CLOEXEC);
    if (there) unlink(path);
    return open(path, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
}

static FILE *create_stream(char *path, const char *name)
{
    const int opened = is_unique(name) ? gis_make_file(path) : open_new(path);
    FILE *stream = opened >= 0 ? fdopen(opened, "w+") : NULL;
    if (opened >= 0 && !stream) close(opened);
    return stream;
}

/* Opens a plain file for reading. Other kinds are refused; opening a pipe would block. */
static FILE *open_to_read(const char *path, struct stat *status)
{
    const int opened = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (opened < 0) return NULL;
    FILE *stream = NULL;
    if (fstat(opened, status) == 0 && !S_ISREG(status->st_mode))
        errno = EINVAL;
    else
        stream = fdopen(opened, "r");
    if (!stream) close(opened);
    return stream;
}

/* Size of the buffer of a written file: records are small, and a system call for a few of them takes longer than
 * copying them. If it cannot be allocated, writing is only slower. */
enum { BUFFER = 1 << 17 };

static void add_buffer(gis_disk_file *file)
{
    file->buffer = malloc(BUFFER);
    if (file->buffer) setvbuf(file->stream, file->buffer, _IOFBF, BUFFER);
}

bool gis_disk_file_create(gis_disk_file *file, const char *directory, const char *name, gis_error *error)
{
    *file = (gis_disk_file){.path = gis_disk_path(directory, name)};
    if (!file->path) return gis_no_memory(error);
    gis_hold();
    file->stream = create_stream(file->path, name);
    if (file->stream) file->leftover = gis_leftover_temporary(file->path);
    gis_release();
    if (file->stream) add_buffer(file);
    return file->stream || cannot_write(file->path, error);
}

bool gis_disk_file_write(gis_disk_file *file, const void *bytes, size_t n, gis_error *error)
{
    file->size += n;
    return fwrite(bytes, 1, n, file->stream) == n || cannot_write(file->path, error);
}

bool gis_disk_file_flush(gis_disk_file *file, gis_error *error)
{
    return fflush(file->stream) == 0 || cannot_write(file->path, error);
}

/* Syncs a directory; only then is the name of a new file in it on the disk. */
static bool sync_directory(const char *directory, gis_error *error)
{
    const int opened = open(directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool done = opened >= 0 && (fsync(opened) == 0 || errno == EINVAL);
    if (!done) cannot_write(directory, error);
    if (opened >= 0) close(opened);
    return done;
}

bool gis_disk_file_place(gis_disk_file *file, const char *directory, const char *name, gis_error *error)
{
    char *path = gis_disk_path(directory, name);
    if (!path) return gis_no_memory(error);
    bool done = fflush(file->stream) == 0 && fsync(fileno(file->stream)) == 0;
    done = fclose(file->stream) == 0 && done;
    file->stream = NULL;
    gis_hold();
    done = done && rename(file->path, path) == 0;
    if (!done) cannot_write(path, error);
    if (done) {
        gis_leftover_forget(file->leftover);
        file->leftover = NULL;
    }
    gis_release();
    free(path);
    gis_disk_file_close(file);
    return done && sync_directory(directory, error);
}

bool gis_disk_file_open(gis_disk_file *file, const char *directory, const char *name, gis_error *error)
{
    *file = (gis_disk_file){.path = gis_disk_path(directory, name)};
    if (!file->path) return gis_no_memory(error);
    struct stat status;
    file->stream = open_to_read(file->path, &status);
    if (!file->stream) return gis_fail(error, "%s: cannot be read: %s", file->path, strerror(errno));
    file->size = (uint64_t)status.st_size;
    return true;
}

bool gis_disk_file_read(gis_disk_file *file, uint64_t from, void *to, size_t n, gis_error *error)
{
    char *at = to;
    while (n > 0) {
        const ssize_t got = pread(fileno(file->stream), at, n, (off_t)from);
        if (got < 0 && errno == EINTR && gis_go_on(error)) continue;
        if (got < 0) return gis_fail(error, "%s: cannot be read: %s", file->path, strerror(errno));
        if (got == 0) return gis_fail(error, "%s: it ends too early: it was cut off", file->path);
        at += got;
        from += (uint64_t)got;
        n -= (size_t)got;
    }
    return true;
}

void gis_disk_file_close(gis_disk_file *file)
{
    gis_hold();
    if (file->stream) fclose(file->stream);
    if (file->leftover) {
        remove(file->path);
        gis_leftover_forget(file->leftover);
    }
    gis_release();
    free(file->buffer);
    free(file->path);
    *file = (gis_disk_file){0};
}
