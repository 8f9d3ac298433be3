/* temporary.c: see temporary.h. */
#define _GNU_SOURCE
#include "disk/temporary.h"

#include "base/remove_tree.h"
#include "base/trust.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#define LETTERS "XXXXXX"

/* If a process that removes abandoned files holds the lock, the file is removed or about to be. */
bool gis_not_abandoned(int descriptor)
{
    struct stat now;
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) return errno != EWOULDBLOCK;
    return fstat(descriptor, &now) != 0 || now.st_nlink > 0;
}

static void draw_again(char *path) { strcpy(path + strlen(path) - (sizeof LETTERS - 1), LETTERS); }

static bool mark_as_being_made(int directory)
{
    const int made = openat(directory, GIS_BEING_MADE, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
    if (made >= 0) close(made);
    return made >= 0;
}

int gis_make_directory(char *path)
{
    while (mkdtemp(path)) {
        const int opened = open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
        if (opened >= 0 && gis_not_abandoned(opened)) {
            if (mark_as_being_made(opened)) return opened;
            const int reason = errno;
            close(opened);
            rmdir(path);
            errno = reason;
            return -1;
        }
        if (opened >= 0) close(opened);
        if (opened < 0 && errno != ENOENT) return -1;
        draw_again(path);
    }
    return -1;
}

/* The file gets the usual mode, since mkstemp() makes files for their owner only. */
int gis_make_file(char *path)
{
    int opened;
    while ((opened = mkstemp(path)) >= 0 && !gis_not_abandoned(opened)) {
        close(opened);
        draw_again(path);
    }
    if (opened < 0) return -1;
    const mode_t mask = umask(0);
    umask(mask);
    (void)fchmod(opened, 0666 & ~mask);
    return opened;
}

static bool is_called(const char *name, const char *prefix)
{
    static const char end[] = GIS_OWN_LETTERS;
    const size_t n = strlen(name), of_end = strlen(end), fixed = strcspn(end, "X");
    return n >= strlen(prefix) + of_end && strncmp(name, prefix, strlen(prefix)) == 0 &&
           strncmp(name + n - of_end, end, fixed) == 0;
}

/* Removes an abandoned directory. One without the mark may have been made just now, so it is removed only if it is
 * empty, which rmdir(2) checks. */
static void remove_directory(int directory, const char *name, int opened)
{
    struct stat mark;
    if (!gis_is_private_directory(opened)) return;
    if (fstatat(opened, GIS_BEING_MADE, &mark, AT_SYMLINK_NOFOLLOW) == 0)
        gis_remove_tree_in(directory, name);
    else
        unlinkat(directory, name, AT_REMOVEDIR);
}

static void remove_if_abandoned(int directory, const char *name)
{
    struct stat status;
    const int opened = openat(directory, name, O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (opened < 0) return;
    if (fstat(opened, &status) == 0 && gis_is_own(opened) && flock(opened, LOCK_EX | LOCK_NB) == 0) {
        if (S_ISDIR(status.st_mode))
            remove_directory(directory, name, opened);
        else if (S_ISREG(status.st_mode))
            unlinkat(directory, name, 0);
    }
    close(opened);
}

void gis_remove_abandoned(const char *directory, const char *prefix)
{
    DIR *list = opendir(directory);
    if (!list) return;
    for (const struct dirent *entry; (entry = readdir(list)) != NULL;)
        if (is_called(entry->d_name, prefix)) remove_if_abandoned(dirfd(list), entry->d_name);
    closedir(list);
}
