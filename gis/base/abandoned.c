/* abandoned.c: see abandoned.h. */
#define _GNU_SOURCE
#include "base/abandoned.h"

#include "base/remove_tree.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

/* Who removes holds the lock meanwhile: it is not to be had, or by then the thing has no name any more. */
bool gis_not_abandoned(int descriptor)
{
    struct stat now;
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) return errno != EWOULDBLOCK;
    return fstat(descriptor, &now) != 0 || now.st_nlink > 0;
}

int gis_directory_not_abandoned(const char *path)
{
    const int opened = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (opened < 0) return errno == ENOENT ? -2 : -1;
    if (gis_not_abandoned(opened)) return opened;
    close(opened);
    return -2;
}

static bool is_called(const char *name, const char *prefix)
{
    static const char end[] = GIS_OWN_LETTERS;
    const size_t n = strlen(name), of_end = strlen(end), fixed = strcspn(end, "X");
    return n >= strlen(prefix) + of_end && strncmp(name, prefix, strlen(prefix)) == 0 &&
           strncmp(name + n - of_end, end, fixed) == 0;
}

static void remove_if_abandoned(const char *directory, const char *name)
{
    const size_t size = strlen(directory) + strlen(name) + 2;
    char *path = malloc(size);
    if (!path) return;
    snprintf(path, size, "%s/%s", directory, name);
    const int opened = open(path, O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (opened >= 0 && flock(opened, LOCK_EX | LOCK_NB) == 0) gis_remove_tree(path);
    if (opened >= 0) close(opened);
    free(path);
}

void gis_remove_abandoned(const char *directory, const char *prefix)
{
    DIR *list = opendir(directory);
    if (!list) return;
    for (const struct dirent *entry; (entry = readdir(list)) != NULL;)
        if (is_called(entry->d_name, prefix)) remove_if_abandoned(directory, entry->d_name);
    closedir(list);
}
