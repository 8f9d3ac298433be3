/* Real layers for the tests with GEOS: polygons that ogr2ogr reads and prints as hexadecimal WKB, so that no digit is
 * lost; and the program sunder, run on these layers. Static functions, for one program each. */
#ifndef SUNDER_TESTS_CROSS_LAYERS_H
#define SUNDER_TESTS_CROSS_LAYERS_H

#include "json.h"
#include "polyset.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>
#include <geos_c.h>

static GEOSContextHandle_t geos;
static char layers_scratch[] = "cross-XXXXXX"; /* below the current directory of the test, the build directory */

static inline void layers_complain(const char *message, void *user)
{
    (void)user;
    print_message("GEOS: %s\n", message);
}

static inline int layers_open(void **state)
{
    (void)state;
    geos = GEOS_init_r();
    GEOSContext_setErrorMessageHandler_r(geos, layers_complain, NULL);
    return geos && mkdtemp(layers_scratch) ? 0 : -1;
}

static inline int layers_close(void **state)
{
    (void)state;
    char *command = test_format("rm -rf '%s'", layers_scratch);
    const int failed = system(command);
    free(command);
    GEOS_finish_r(geos);
    return failed;
}

/* "../shared/data/NAME" beside the repository, as GDAL opens it; NULL if it does not exist. */
static inline char *layers_path(const char *name)
{
    const char *source = getenv("SUNDER_SOURCE");
    char *path = test_format("%s/../shared/data/%s", source ? source : SUNDER_SOURCE, name);
    struct stat s;
    if (stat(path, &s) == 0 && strstr(name, ".zip")) {
        char *zip = test_format("/vsizip/%s", path);
        free(path);
        return zip;
    }
    if (stat(path, &s) == 0) return path;
    free(path);
    return NULL;
}

/* The result of a comparison. Files that exist have to be readable. */
typedef enum layers_answer {
    LAYERS_MISSING = -2,
    LAYERS_UNREADABLE = -1,
    LAYERS_WRONG = 0,
    LAYERS_RIGHT = 1
} layers_answer;

typedef struct layers_tally {
    size_t asked, unreadable, wrong;
} layers_tally;

static inline void layers_count(layers_tally *t, layers_answer answer)
{
    t->asked += answer >= 0;
    t->unreadable += answer == LAYERS_UNREADABLE;
    t->wrong += answer == LAYERS_WRONG;
}

static inline void layers_conclude(const layers_tally *t)
{
    if (!t->asked) {
        print_message("no ../shared/data beside the repository, or no ogr2ogr with SpatiaLite: skipped\n");
        skip();
    }
    assert_int_equal(t->unreadable, 0);
    assert_int_equal(t->wrong, 0);
}

typedef struct geometries {
    GEOSGeometry **at;
    size_t n;
} geometries;

static inline void geometries_free(geometries *g)
{
    for (size_t i = 0; i < g->n; i++) GEOSGeom_destroy_r(geos, g->at[i]);
    free(g->at);
    *g = (geometries){0};
}

static inline bool geometries_add(geometries *g, const char *hex, size_t n)
{
    GEOSGeometry *one = GEOSGeomFromHEX_buf_r(geos, (const unsigned char *)hex, n);
    if (!one) return false;
    g->at = test_resize(g->at, g->n + 1, sizeof *g->at);
    g->at[g->n++] = one;
    return true;
}

/* All geometries of a layer that satisfy the condition; false if GDAL cannot read them. */
static inline bool layers_read(const char *path, const char *layer, const char *condition, geometries *out)
{
    /* Shapefiles and GeoPackages have different names for the geometry column; the condition does not use it. */
    char *command =
        test_format("ogr2ogr -f CSV /vsistdout/ '%s' -dialect SQLite -sql \"SELECT hex(ST_AsBinary(%s)) AS w FROM "
                    "\\\"%s\\\" WHERE %s\" 2>/dev/null",
                    path, strstr(path, ".zip") ? "geometry" : "geom", layer, condition);
    FILE *f = popen(command, "r");
    free(command);
    char *line = NULL;
    size_t room = 0;
    bool ok = f != NULL;
    *out = (geometries){0};
    for (long n; ok && (n = getline(&line, &room, f)) > 0;) {
        const size_t hex = strspn(line, "\"") ? strspn(line + 1, "0123456789ABCDEF") : strspn(line, "0123456789ABCDEF");
        if (hex > 2) ok = geometries_add(out, line + strspn(line, "\""), hex); /* skips the heading */
    }
    free(line);
    ok = f && pclose(f) == 0 && ok && out->n > 0;
    if (!ok) geometries_free(out);
    return ok;
}

/* Runs `sunder buffer` on the valid features of a layer; the output is in the scratch directory. Returns the summary;
 * or NULL, with the message on stdout, if it fails. */
static inline json *layers_buffer(const char *path, const char *layer, const char *options, const char *output)
{
    const char *sunder = getenv("SUNDER");
    char *stats = test_format("%s/stats.json", layers_scratch);
    char *command = test_format(
        "'%s' buffer --quiet --overwrite --dialect SQLite --sql 'SELECT * FROM \"%s\" WHERE ST_IsValid(%s)' "
        "%s --stats '%s' '%s' '%s/%s' 2>'%s/err'",
        sunder, layer, strstr(path, ".zip") ? "geometry" : "geom", options, stats, path, layers_scratch, output,
        layers_scratch);
    json *summary = NULL;
    if (system(command) != 0) {
        char *err = test_format("%s/err", layers_scratch), *text = test_read_file(err);
        print_message("%s\n%s\n", command, text ? text : "");
        free(text);
        free(err);
    } else {
        char *text = test_read_file(stats);
        summary = text ? json_read(text) : NULL;
        free(text);
    }
    free(command);
    free(stats);
    return summary;
}

static inline double json_number(const json *object, const char *key)
{
    return strtod(json_text(json_get(object, key)), NULL);
}

#endif
