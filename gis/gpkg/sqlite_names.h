/* sqlite_names.h: builds SQL statements from text and names. */
#ifndef GIS_SQLITE_NAMES_H
#define GIS_SQLITE_NAMES_H

/* Appends text, or a name in double quotes (quotes in it are doubled), to the statement `to`, which is freed. CPLFree()
 * the result. */
char *gis_sql_append(char *to, const char *more);
char *gis_sql_append_name(char *to, const char *name);

#endif
