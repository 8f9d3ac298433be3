/* text_file.c: see text_file.h. The temporary file is in the same directory, so that putting it in place is a rename,
 * which is atomic. */
#define _GNU_SOURCE
#include "disk/text_file.h"

#include "base/trust.h"
#include "disk/temporary.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The temporary file's name repeats at most this number of bytes of the final name, so that it is not too long for any
 * file system. */
enum { SHOWN_OF_NAME = 100 };

/* DIRECTORY/NAME.sunder-XXXXXX; mkstemp() replaces the letters, so that the name cannot be predicted. */
static char *temporary_path(const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const size_t size = strlen(path) + sizeof GIS_OWN_LETTERS + 1;
    char *temporary = malloc(size);
    if (temporary) snprintf(temporary, size, "%.*s%.*s" GIS_OWN_LETTERS, (int)(name - path), path, SHOWN_OF_NAME, name);
    return temporary;
}

static FILE *open_temporary(gis_text_file *file)
{
    gis_hold();
    const int made = gis_make_file(file->temporary);
    FILE *opened = made >= 0 ? fdopen(made, "w") : NULL;
    const int reason = errno;
    if (opened) {
        file->leftover = gis_leftover_temporary(file->temporary);
    } else {
        if (made >= 0) unlink(file->temporary);
        if (made >= 0) close(made);
        free(file->temporary);
        file->temporary = NULL;
    }
    gis_release();
    errno = reason;
    return opened;
}

/* Writes the text and closes the file. *reason: the errno if writing failed; 0: `write` failed and has set *error. */
static bool write_all(FILE *to, gis_text_writer *write, const void *of, int *reason, gis_error *error)
{
    errno = 0;
    bool done = write(of, to, error) && fflush(to) == 0;
    *reason = done || ferror(to) ? errno : 0;
    if (fclose(to) != 0 && done) {
        done = false;
        *reason = errno;
    }
    return done;
}

bool gis_text_file_write(gis_text_file *file, const char *path, gis_text_writer *write, const void *of,
                         const char *what, gis_error *error)
{
    struct stat info;
    char *resolved = lstat(path, &info) == 0 && S_ISLNK(info.st_mode) ? realpath(path, NULL) : NULL;
    file->path = resolved ? resolved : strdup(path);
    if (!file->path) return gis_no_memory(error);
    if (!gis_link_may_be_followed(path, what, error)) return false;
    bool special = stat(file->path, &info) == 0 && !S_ISREG(info.st_mode);
    if (!special && !(file->temporary = temporary_path(file->path))) return gis_no_memory(error);
    FILE *to = special ? fopen(file->path, "w") : open_temporary(file);
    int reason = errno;
    if (to && write_all(to, write, of, &reason, error)) return true;
    return (to && reason == 0) ? false : gis_fail(error, "%s: cannot write %s: %s", what, path, strerror(reason));
}

static bool step_aside(gis_text_file *file, const char *what, gis_error *error)
{
    const size_t size = strlen(file->temporary) + 2;
    char *former = malloc(size);
    if (!former) return gis_no_memory(error);
    snprintf(former, size, "%s~", file->temporary);
    if (rename(file->path, former) == 0) {
        file->former = former;
        file->former_leftover = gis_leftover_former(former, file->path);
        return true;
    }
    int reason = errno;
    free(former);
    return reason == ENOENT || gis_fail(error, "%s: cannot replace %s: %s", what, file->path, strerror(reason));
}

bool gis_text_file_place(gis_text_file *file, const char *what, gis_error *error)
{
    if (!file->temporary) return true;
    gis_hold();
    bool done = step_aside(file, what, error);
    if (done && rename(file->temporary, file->path) != 0) {
        done = gis_fail(error, "%s: cannot write %s: %s", what, file->path, strerror(errno));
    } else if (done) {
        file->placed = true;
        gis_leftover_forget(file->leftover);
        file->leftover = file->former ? NULL : gis_leftover_until(GIS_DECIDED, file->path);
    }
    gis_release();
    return done;
}

void gis_text_file_end(gis_text_file *file, bool keep)
{
    gis_hold();
    if (!keep && file->former)
        (void)!rename(file->former, file->path);
    else if (!keep && file->placed)
        remove(file->path);
    if (keep && file->former) remove(file->former);
    if (file->temporary && !file->placed) remove(file->temporary);
    gis_leftover_forget(file->leftover);
    gis_leftover_forget(file->former_leftover);
    gis_release();
    free(file->path);
    free(file->temporary);
    free(file->former);
    *file = (gis_text_file){0};
}
