/* absolute_paths.c: see plan.h. A plan may be made in one directory and merged in another, and the files that its
 * command line names must still be found. Names that GDAL's drivers interpret are handled in the forms in which a file
 * name can be recognised. */
#include "shards/plan/plan.h"

#include "base/path.h"

#include <cpl_conv.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Do the first n bytes of `path` name an existing file? */
static bool is_there(const char *path, size_t n)
{
    char *name = gis_printed("%.*s", (int)n, path);
    const bool there = n > 0 && access(name, F_OK) == 0;
    CPLFree(name);
    return there;
}

/* A copy of the text with the current directory inserted at offset `at`. */
static char *insert_directory(const char *text, size_t at)
{
    char *here = gis_path_here();
    if (!here) return CPLStrdup(text);
    const size_t size = strlen(here) + strlen(text) + 2;
    char *out = CPLCalloc(1, size);
    snprintf(out, size, "%.*s%s/%s", (int)at, text, here, text + at);
    CPLFree(here);
    return out;
}

/* Finds the file name in paths like /vsizip/a.zip/b.gpkg or /vsigzip//vsizip/..., if it is a relative path to an
 * existing file; sets *at to its offset. */
static bool find_in_archive(const char *source, size_t *at)
{
    size_t from = 0;
    while (strncmp(source + from, "/vsi", 4) == 0) {
        const size_t name = strcspn(source + from + 1, "/") + 1;
        if (!source[from + name]) return false;
        from += name + 1;
    }
    from += source[from] == '{';
    if (from == 0 || source[from] == '/') return false;
    for (size_t n = 0; n == 0 || source[from + n]; n++) {
        n += strcspn(source + from + n, "/}");
        if (is_there(source + from, n)) {
            *at = from;
            return true;
        }
        if (!source[from + n]) break;
    }
    return false;
}

/* Finds the file name in forms like GPKG:town.gpkg:buildings; sets *at to its offset. False if no such file exists. */
static bool find_behind_driver(const char *source, size_t *at)
{
    const char *colon = strchr(source, ':');
    if (!colon || colon[1] == '/') return false;
    *at = (size_t)(colon + 1 - source);
    const char *rest = colon + 1;
    return is_there(rest, strlen(rest)) || is_there(rest, strcspn(rest, ":"));
}

char *gis_plan_absolute_source(const char *source)
{
    size_t at = 0;
    if (*source == '/' ? find_in_archive(source, &at)
                       : is_there(source, strlen(source)) || find_behind_driver(source, &at))
        return insert_directory(source, is_there(source, strlen(source)) && *source != '/' ? 0 : at);
    return CPLStrdup(source);
}

char *gis_plan_absolute_output(const char *path)
{
    return *path == '/' || strcmp(path, "-") == 0 ? CPLStrdup(path) : insert_directory(path, 0);
}

char *gis_plan_absolute_shape(const char *shape)
{
    if (*shape == '@' && shape[1] != '/' && strcmp(shape, "@-") != 0) return insert_directory(shape, 1);
    return CPLStrdup(shape);
}

/* Makes the dataset of a --barrier absolute. A comma within the name is written as "\,"; the keys begin at the first
 * other comma. */
char *gis_plan_absolute_barrier(const char *barrier)
{
    size_t n = 0;
    while (barrier[n] && barrier[n] != ',') n += barrier[n] == '\\' && barrier[n + 1] == ',' ? 2 : 1;
    char *plain = CPLStrdup(barrier);
    size_t length = 0;
    for (size_t k = 0; k < n; k++)
        if (!(barrier[k] == '\\' && barrier[k + 1] == ',')) plain[length++] = barrier[k];
    plain[length] = '\0';
    char *found = gis_plan_absolute_source(plain);
    char *out = CPLCalloc(1, 2 * strlen(found) + strlen(barrier + n) + 1), *to = out;
    for (const char *c = found; *c; c++) {
        if (*c == ',') *to++ = '\\';
        *to++ = *c;
    }
    strcpy(to, barrier + n);
    CPLFree(found);
    CPLFree(plain);
    return out;
}
