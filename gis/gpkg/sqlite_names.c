/* sqlite_names.c: see sqlite_names.h. */
#include "gpkg/sqlite_names.h"

#include <cpl_conv.h>
#include <string.h>

char *gis_sql_append(char *to, const char *more)
{
    char *both = CPLMalloc(strlen(to) + strlen(more) + 1);
    strcpy(both, to);
    strcat(both, more);
    CPLFree(to);
    return both;
}

char *gis_sql_append_name(char *to, const char *name)
{
    char *quoted = CPLMalloc(2 * strlen(name) + 3), *at = quoted;
    *at++ = '"';
    for (; *name; name++) {
        if (*name == '"') *at++ = '"';
        *at++ = *name;
    }
    strcpy(at, "\"");
    to = gis_sql_append(to, quoted);
    CPLFree(quoted);
    return to;
}
