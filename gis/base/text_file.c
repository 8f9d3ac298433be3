/* text_file.c: see text_file.h. The temporary file lies in the same directory, so that putting it in place is a rename,
 * which happens or does not. */
#define _GNU_SOURCE
#include "base/text_file.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* path.PID.ending: of this process alone. */
static char *beside(const char *path, const char *ending)
{
    size_t size = strlen(path) + strlen(ending) + 32;
    char *name = malloc(size);
    if (name) snprintf(name, size, "%s.%ld.%s", path, (long)getpid(), ending);
    return name;
}

static bool write_bytes(const char *name, const char *mode, const char *text, size_t length, int *reason)
{
    FILE *file = fopen(name, mode);
    bool done = file && fwrite(text, 1, length, file) == length && fflush(file) == 0;
    *reason = errno;
    if (file && fclose(file) != 0 && done) {
        done = false;
        *reason = errno;
    }
    return done;
}

static bool write_temporary(gis_text_file *file, const char *text, size_t length, int *reason)
{
    gis_hold();
    bool done = write_bytes(file->temporary, "wx", text, length, reason);
    if (!done && *reason == EEXIST) { /* not ours to remove */
        free(file->temporary);
        file->temporary = NULL;
    } else {
        file->leftover = gis_leftover_temporary(file->temporary);
    }
    gis_release();
    return done;
}

bool gis_text_file_write(gis_text_file *file, const char *path, const char *text, size_t length, const char *what,
                         gis_error *error)
{
    struct stat info;
    char *resolved = lstat(path, &info) == 0 && S_ISLNK(info.st_mode) ? realpath(path, NULL) : NULL;
    file->path = resolved ? resolved : strdup(path);
    if (!file->path) return gis_no_memory(error);
    bool special = stat(file->path, &info) == 0 && !S_ISREG(info.st_mode);
    if (!special && !(file->temporary = beside(file->path, "part"))) return gis_no_memory(error);
    int reason;
    if (special ? write_bytes(file->path, "w", text, length, &reason) : write_temporary(file, text, length, &reason))
        return true;
    return gis_fail(error, "%s: cannot write %s: %s", what, path, strerror(reason));
}

static bool step_aside(gis_text_file *file, const char *what, gis_error *error)
{
    char *former = beside(file->path, "former");
    if (!former) return gis_no_memory(error);
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
