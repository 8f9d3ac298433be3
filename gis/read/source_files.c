/* source_files.c: see source_files.h. Existing files are compared by device and inode, since links, dots and mounts
 * give a file many names. */
#include "read/source_files.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <string.h>
#include <sys/stat.h>

static bool same_file(const char *a, const char *b)
{
    struct stat of_a, of_b;
    if (strcmp(a, b) == 0) return true;
    return stat(a, &of_a) == 0 && stat(b, &of_b) == 0 && of_a.st_dev == of_b.st_dev && of_a.st_ino == of_b.st_ino;
}

static bool is_file(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && S_ISREG(status.st_mode);
}

/* The path behind a driver's name, as in GPKG:file:layer or GeoJSON:file; the path itself if there is none. A single
 * letter is a drive. */
static const char *without_driver(const char *path)
{
    size_t n = strspn(path, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_");
    if (n < 2 || path[n] != ':' || is_file(path)) return path;
    path += n + 1;
    return *path == '"' ? path + 1 : path;
}

/* The ordinary file behind a virtual path, to be freed with CPLFree(); NULL if there is none (/vsimem/, a network).
 * Prefixes (a driver's name, /vsizip/, /vsigzip/ within it, /vsisubfile/0_100,) and braces around an archive's name are
 * removed; then the shortest prefix that is a file is the archive. */
static char *real_file(const char *name)
{
    const char *path = without_driver(name);
    bool virtual = path != name;
    const char *ends = virtual ? "/}:\"" : "/}";
    while (strncmp(path, "/vsi", 4) == 0) {
        bool part = strncmp(path, "/vsisubfile/", 12) == 0;
        path = strchr(path + 1, part ? ',' : '/');
        if (!path) return NULL;
        path++;
        virtual = true;
    }
    if (!virtual) return CPLStrdup(path);
    if (*path == '{') path++;
    if (!*path) /* for example /vsistdout/ itself */
        return NULL;
    char *found = CPLStrdup(path);
    for (char *end = strpbrk(found + 1, ends); end; end = strpbrk(end + 1, ends)) {
        char kept = *end;
        *end = '\0';
        if (is_file(found)) return found;
        *end = kept;
    }
    if (is_file(found)) return found;
    CPLFree(found);
    return NULL;
}

static const char *without_dot(const char *path)
{
    while (strncmp(path, "./", 2) == 0) path += 2;
    return path;
}

bool gis_path_lies_in(const char *path, const char *file)
{
    char *of_path = real_file(path), *of_file = real_file(file);
    bool same =
        strcmp(path, file) == 0 || (of_path && of_file && same_file(without_dot(of_path), without_dot(of_file)));
    CPLFree(of_path);
    CPLFree(of_file);
    return same;
}

bool gis_source_lies_in(const gis_source *source, const char *file)
{
    if (!source) return false;
    if (gis_path_lies_in(gis_source_path(source), file)) return true;
    char **files = GDALGetFileList(gis_source_dataset(source));
    bool found = false;
    for (char **each = files; each && *each; each++) found = found || gis_path_lies_in(*each, file);
    CSLDestroy(files);
    return found;
}

bool gis_source_spare(const gis_source *source, const char *output, bool update, gis_error *error)
{
    if (!update && gis_source_lies_in(source, output))
        return gis_fail(error, "%s is an input; give another output, or --update with new layer names", output);
    return true;
}
