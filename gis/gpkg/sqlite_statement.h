/* sqlite_statement.h: SQLite's functions for preparing, binding and running statements, found in the running program.
 * Types and constants are those of SQLite's programming interface, which does not change. */
#ifndef GIS_SQLITE_STATEMENT_H
#define GIS_SQLITE_STATEMENT_H

#include <stdint.h>

enum {
    GIS_SQLITE_OK = 0,
    GIS_SQLITE_CONSTRAINT = 19,
    GIS_SQLITE_MISUSE = 21,
    GIS_SQLITE_ROW = 100,
    GIS_SQLITE_DONE = 101
};
enum { GIS_SQLITE_KIND = 0xff }; /* the low byte of a result code; the rest is detail */

typedef struct gis_sqlite_functions {
    const char *(*source_id)(void);
    int (*prepare)(void *, const char *, int, void **, const char **);
    int (*bind_null)(void *, int);
    int (*bind_number)(void *, int, int64_t);
    int (*bind_real)(void *, int, double);
    int (*bind_text)(void *, int, const char *, int, void (*)(void *));
    int (*bind_bytes)(void *, int, const void *, int, void (*)(void *));
    int (*step)(void *);
    int (*reset)(void *);
    int (*finalize)(void *);
    const void *(*column_bytes)(void *, int);
    int (*column_size)(void *, int);
    void *(*column_value)(void *, int); /* functions for columns take a lock, those for values do not */
    int (*value_type)(void *);
    int64_t (*value_number)(void *);
    double (*value_real)(void *);
    const unsigned char *(*value_text)(void *);
    const void *(*value_bytes)(void *);
    int (*value_size)(void *);
    int (*run)(void *, const char *, int (*)(void *, int, char **, char **), void *, char **);
    const char *(*error_message)(void *);
    char *(*print)(int, char *, const char *, ...);
} gis_sqlite_functions;

/* Looks the functions up at the first call. NULL: one is missing. */
const gis_sqlite_functions *gis_sqlite_find_functions(void);

#endif
