/* trust.c: see trust.h. */
#define _GNU_SOURCE /* for O_PATH */
#include "base/trust.h"

#include "base/path.h"

#include <cpl_conv.h>
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PERMISSIONS = 07777 & ~02000 }; /* all mode bits except setgid, which a directory inherits */

bool gis_is_own(int descriptor)
{
    struct stat status;
    return fstat(descriptor, &status) == 0 && status.st_uid == geteuid();
}

bool gis_is_private_directory(int descriptor)
{
    struct stat status;
    return fstat(descriptor, &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == geteuid() &&
           (status.st_mode & PERMISSIONS) == 0700;
}

int gis_open_private_directory(int directory, const char *name)
{
    const int opened = openat(directory, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (opened < 0 || gis_is_private_directory(opened)) return opened;
    close(opened);
    errno = EPERM;
    return -1;
}

bool gis_is_plain_name(const char *name)
{
    return *name && strcmp(name, ".") != 0 && strcmp(name, "..") != 0 && !strchr(name, '/');
}

bool gis_may_be_planted(const char *path)
{
    struct stat it, around;
    char *directory = gis_path_directory(path);
    const bool both = lstat(path, &it) == 0 && stat(*directory ? directory : ".", &around) == 0;
    CPLFree(directory);
    return both && (around.st_mode & S_ISVTX) && (around.st_mode & S_IWOTH) && it.st_uid != geteuid() &&
           it.st_uid != 0 && it.st_uid != around.st_uid;
}

bool gis_link_may_be_followed(const char *path, const char *what, gis_error *error)
{
    struct stat status;
    if (lstat(path, &status) != 0 || !S_ISLNK(status.st_mode) || !gis_may_be_planted(path)) return true;
    return gis_fail(error,
                    "%s: %s is a link that another user (%lu) put into a directory in which all may write; it is not "
                    "followed",
                    what, path, (unsigned long)status.st_uid);
}

int gis_open_directory(const char *path)
{
    const char *of = *path ? path : ".";
    const int opened = open(of, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
#ifdef O_PATH
    /* a directory that cannot be listed */
    if (opened < 0 && errno == EACCES) return open(of, O_PATH | O_DIRECTORY | O_CLOEXEC);
#endif
    return opened;
}
