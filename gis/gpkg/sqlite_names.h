/* sqlite_names.h: statements put together of words and names. */
#ifndef GIS_SQLITE_NAMES_H
#define GIS_SQLITE_NAMES_H

/* A statement, put together: `to` with more behind it, or with a name in quotes, its own doubled; CPLFree(). */
char *gis_sql_append(char *to, const char *more);
char *gis_sql_append_name(char *to, const char *name);

#endif
