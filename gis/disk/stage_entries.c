/* stage_entries.c: tests and moves entries of an open directory by name, without following links. */
#define _GNU_SOURCE /* for renameat2() */
#include "disk/stage_internal.h"

#include <cpl_string.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool entry_status(int directory, const char *name, struct stat *status)
{
    return fstatat(directory, name, status, AT_SYMLINK_NOFOLLOW) == 0;
}

bool gis_entry_mark(int directory, const char *name, char mark[GIS_MARK_SIZE])
{
    struct stat status;
    if (!entry_status(directory, name, &status)) return false;
    snprintf(mark, GIS_MARK_SIZE, "%ju-%jd-%jd.%ld", (uintmax_t)status.st_ino, (intmax_t)status.st_size,
             (intmax_t)status.st_mtim.tv_sec, status.st_mtim.tv_nsec);
    return true;
}

bool gis_entry_is_there(int directory, const char *name)
{
    struct stat status;
    return entry_status(directory, name, &status);
}

bool gis_entry_is_directory(int directory, const char *name)
{
    struct stat status;
    return entry_status(directory, name, &status) && S_ISDIR(status.st_mode);
}

bool gis_entry_is_file(int directory, const char *name)
{
    struct stat status;
    return entry_status(directory, name, &status) && S_ISREG(status.st_mode);
}

char **gis_entry_names(int directory)
{
    char **names = NULL;
    /* a new descriptor, which reads from the beginning */
    const int again = openat(directory, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *list = again >= 0 ? fdopendir(again) : NULL;
    if (!list && again >= 0) close(again);
    for (const struct dirent *entry; list && (entry = readdir(list)) != NULL;)
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
            names = CSLAddString(names, entry->d_name);
    if (list) closedir(list);
    return names;
}

int gis_entry_move(int from, int to, const char *name, bool replace)
{
    if (replace) return renameat(from, name, to, name);
#ifdef RENAME_NOREPLACE
    if (renameat2(from, name, to, name, RENAME_NOREPLACE) == 0) return 0;
    if (errno != ENOSYS && errno != EINVAL) return -1;
#endif
    if (!gis_entry_is_there(to, name)) return renameat(from, name, to, name);
    errno = EEXIST;
    return -1;
}
