/* path.c: see path.h. */
#define _GNU_SOURCE /* for getcwd() without a limit */
#include "base/path.h"

#include <cpl_conv.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

char *gis_printed(const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    const int n = vsnprintf(NULL, 0, format, arguments);
    const size_t size = n > 0 ? (size_t)n + 1 : 1;
    char *text = CPLCalloc(1, size);
    if (n > 0) vsnprintf(text, size, format, again);
    va_end(again);
    va_end(arguments);
    return text;
}

/* A copy of the first n bytes. */
static char *part_of(const char *path, size_t n)
{
    char *part = CPLCalloc(1, n + 1);
    memcpy(part, path, n);
    return part;
}

char *gis_path_join(const char *directory, const char *name)
{
    const size_t n = strlen(directory);
    return gis_printed("%s%s%s", directory, n == 0 || directory[n - 1] == '/' ? "" : "/", name);
}

const char *gis_path_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

char *gis_path_directory(const char *path)
{
    const size_t n = (size_t)(gis_path_name(path) - path);
    return part_of(path, n > 1 ? n - 1 : n);
}

const char *gis_path_extension(const char *path)
{
    const char *dot = strrchr(gis_path_name(path), '.');
    return dot ? dot + 1 : path + strlen(path);
}

char *gis_path_stem(const char *path)
{
    const char *name = gis_path_name(path), *dot = strrchr(name, '.');
    return part_of(name, dot ? (size_t)(dot - name) : strlen(name));
}

char *gis_path_here(void)
{
    char *here = getcwd(NULL, 0), *copy = here && *here == '/' ? CPLStrdup(here) : NULL;
    free(here);
    return copy;
}

bool gis_path_suits_gdal(const char *path, const char *what, gis_error *error)
{
    const size_t n = strlen(path);
    if (n <= GIS_PATH_LONGEST || strchr("{[<", path[0])) return true;
    return gis_fail(error,
                    "%s: its path has %zu bytes, and GDAL accepts %d at most; change to a directory nearer to it, or "
                    "use a link: %s",
                    what, n, GIS_PATH_LONGEST, path);
}
