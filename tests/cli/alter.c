/* A library to be preloaded. It changes one value that is bound to an SQLite statement. ALTER=real or ALTER=geometry
 * selects the kind of value, ALTER_AT its number, from 1 on. ALTER=extent: the trigger that maintains a layer's extent
 * is not created. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

int sqlite3_bind_double(void *statement, int at, double value);
int sqlite3_bind_blob(void *statement, int at, const void *bytes, int size, void (*destroy)(void *));
int sqlite3_exec(void *database, const char *sql, int (*row)(void *, int, char **, char **), void *user,
                 char **message);

/* Is this call the selected one? */
static int its_turn(const char *what)
{
    static long seen;
    const char *asked = getenv("ALTER"), *when = getenv("ALTER_AT");
    return asked && when && strcmp(asked, what) == 0 && ++seen == atol(when);
}

/* Sets the function pointer at `function` to the SQLite function of that name that this library replaces. */
static void find(const char *name, void *function)
{
    void *found = dlsym(RTLD_NEXT, name);
    memcpy(function, &found, sizeof found);
}

int sqlite3_bind_double(void *statement, int at, double value)
{
    int (*bind)(void *, int, double);
    find("sqlite3_bind_double", &bind);
    return bind(statement, at, its_turn("real") ? value + 1 : value);
}

/* The ninth byte from the end of a geometry is the most significant byte of the last X, or of the last Y if there is
 * Z. */
int sqlite3_bind_blob(void *statement, int at, const void *bytes, int size, void (*destroy)(void *))
{
    int (*bind)(void *, int, const void *, int, void (*)(void *));
    find("sqlite3_bind_blob", &bind);
    if (size < 9 || memcmp(bytes, "GP", 2) != 0 || !its_turn("geometry"))
        return bind(statement, at, bytes, size, destroy);
    char *other = malloc((size_t)size);
    if (!other) abort();
    memcpy(other, bytes, (size_t)size);
    other[size - 9] ^= 1;
    /* not SQLITE_STATIC and not SQLITE_TRANSIENT */
    if (destroy && destroy != (void (*)(void *)) - 1) destroy((void *)bytes);
    return bind(statement, at, other, size, free);
}

int sqlite3_exec(void *database, const char *sql, int (*row)(void *, int, char **, char **), void *user, char **message)
{
    int (*run)(void *, const char *, int (*)(void *, int, char **, char **), void *, char **);
    find("sqlite3_exec", &run);
    return sql && strstr(sql, "TRIGGER sunder_extent") && its_turn("extent") ? 0
                                                                             : run(database, sql, row, user, message);
}
