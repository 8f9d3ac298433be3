/* Real layers dilated by sunder buffer, compared with GEOS. GEOS has no Minkowski sums, but for a convex B with the
 * origin inside, and a polygon P,
 *
 *     P + B  =  P  u  the convex hull of s + B, for every side s of the boundary of P
 *
 * (if p + b is not in P, the segment from p to p + b crosses the boundary), and GEOS has hulls and unions. Areas of
 * dissolved layers agree to 1e-9: GEOS rounds each of some thousand crossings by 1e-16 of its coordinates, and one
 * missing or additional side or corner would make a difference a hundred times larger than the tolerance. Everything
 * written, by all operations, is valid for GEOS. */
#include "layers.h"

typedef struct brush {
    const char *text; /* the argument of the program */
    double xy[32];
    size_t n;
} brush;

/* Shapes with the origin inside. */
static const brush square = {"square:6", {-3, -3, 3, -3, 3, 3, -3, 3}, 4};
static const brush octagon = {"'POLYGON ((-1.5 -2, 1 -2.5, 3 -1, 3.5 1, 2 3, -0.5 3.5, -2 2, -2.5 -0.5))'",
                              {-1.5, -2, 1, -2.5, 3, -1, 3.5, 1, 2, 3, -0.5, 3.5, -2, 2, -2.5, -0.5},
                              8};
static const brush regular = {"'POLYGON ((-1 -2.5, 1 -2.5, 2.5 -1, 2.5 1, 1 2.5, -1 2.5, -2.5 1, -2.5 -1))'",
                              {-1, -2.5, 1, -2.5, 2.5, -1, 2.5, 1, 1, 2.5, -1, 2.5, -2.5, 1, -2.5, -1},
                              8};

static void put_hull(geometries *out, const double *a, const double *b, const brush *by)
{
    GEOSCoordSequence *s = GEOSCoordSeq_create_r(geos, (unsigned)(2 * by->n), 2);
    for (unsigned k = 0; k < 2 * by->n; k++) {
        const double *from = k < by->n ? a : b, *c = by->xy + 2 * (k % by->n);
        GEOSCoordSeq_setXY_r(geos, s, k, from[0] + c[0], from[1] + c[1]);
    }
    GEOSGeometry *points = GEOSGeom_createLineString_r(geos, s);
    out->at = test_resize(out->at, out->n + 1, sizeof *out->at);
    out->at[out->n++] = GEOSConvexHull_r(geos, points);
    GEOSGeom_destroy_r(geos, points);
}

static void put_ring(geometries *out, const GEOSGeometry *ring, const brush *by)
{
    const GEOSCoordSequence *s = GEOSGeom_getCoordSeq_r(geos, ring);
    unsigned n = 0;
    GEOSCoordSeq_getSize_r(geos, s, &n);
    for (unsigned i = 0; i + 1 < n; i++) {
        double a[2], b[2];
        GEOSCoordSeq_getXY_r(geos, s, i, &a[0], &a[1]);
        GEOSCoordSeq_getXY_r(geos, s, i + 1, &b[0], &b[1]);
        put_hull(out, a, b, by);
    }
}

/* Adds the members of P and the hulls of their sides. */
static void put_feature(geometries *out, const GEOSGeometry *feature, const brush *by)
{
    for (int i = 0; i < GEOSGetNumGeometries_r(geos, feature); i++) {
        const GEOSGeometry *p = GEOSGetGeometryN_r(geos, feature, i);
        out->at = test_resize(out->at, out->n + 1, sizeof *out->at);
        out->at[out->n++] = GEOSGeom_clone_r(geos, p);
        put_ring(out, GEOSGetExteriorRing_r(geos, p), by);
        for (int h = 0; h < GEOSGetNumInteriorRings_r(geos, p); h++)
            put_ring(out, GEOSGetInteriorRingN_r(geos, p, h), by);
    }
}

/* Returns the union, and frees the parts. */
static GEOSGeometry *unite(geometries *parts)
{
    GEOSGeometry *many = GEOSGeom_createCollection_r(geos, GEOS_GEOMETRYCOLLECTION, parts->at, (unsigned)parts->n);
    GEOSGeometry *one = GEOSUnaryUnion_r(geos, many);
    GEOSGeom_destroy_r(geos, many);
    free(parts->at);
    *parts = (geometries){0};
    return one;
}

/* Unites each feature first, which is faster than all hulls at once. */
static double geos_area(const geometries *features, const brush *by)
{
    double area = NAN;
    geometries grown = {0};
    for (size_t i = 0; i < features->n; i++) {
        geometries parts = {0};
        put_feature(&parts, features->at[i], by);
        grown.at = test_resize(grown.at, grown.n + 1, sizeof *grown.at);
        grown.at[grown.n++] = unite(&parts);
    }
    GEOSGeometry *all = unite(&grown);
    if (all) GEOSArea_r(geos, all, &area);
    GEOSGeom_destroy_r(geos, all);
    return area;
}

static const struct {
    const char *file, *layer;
    const brush *by;
} dissolved[] = {{"krems_2013.gpkg", "buildings", &square},
                 {"krems_2013.gpkg", "buildings", &octagon},
                 {"saint_jean_la_poterie.gpkg", "buildings", &octagon},
                 {"neuss_2026.gpkg", "buildings", &regular},
                 {"baltimore_2015_shp.zip", "buildings", &octagon},
                 {"paris_cite_2014.gpkg", "buildings", &square}};

static layers_answer same_area(const char *file, const char *layer, const brush *by)
{
    char *path = layers_path(file);
    geometries features;
    layers_answer answer = path ? LAYERS_UNREADABLE : LAYERS_MISSING;
    const char *where = path && strstr(path, ".zip") ? "ST_IsValid(geometry)" : "ST_IsValid(geom)";
    if (path && getenv("SUNDER") && layers_read(path, layer, where, &features)) {
        char *options = test_format("--dissolve --shape %s", by->text);
        json *summary = layers_buffer(path, layer, options, "dissolved.gpkg");
        const double theirs = geos_area(&features, by), ours = summary ? json_number(summary, "area") : NAN;
        answer = fabs(ours - theirs) <= 1e-9 * theirs ? LAYERS_RIGHT : LAYERS_WRONG;
        print_message("%s, %zu features by %s: %.17g, GEOS %.17g\n", file, features.n, by->text, ours, theirs);
        json_free(summary);
        free(options);
        geometries_free(&features);
    }
    free(path);
    return answer;
}

static void test_areas(void **state)
{
    (void)state;
    layers_tally t = {0};
    for (size_t i = 0; i < sizeof dissolved / sizeof *dissolved; i++)
        layers_count(&t, same_area(dissolved[i].file, dissolved[i].layer, dissolved[i].by));
    layers_conclude(&t);
}

/* ---- Written geometries are valid ---- */

/* The number of written geometries that GEOS finds invalid; -1 if they cannot be read. */
static long count_invalid(const char *output, size_t *polygons)
{
    char *path = test_format("%s/%s", layers_scratch, output);
    geometries written;
    long invalid = layers_read(path, "grown", "geom IS NOT NULL", &written) ? 0 : -1;
    free(path);
    for (size_t i = 0; invalid >= 0 && i < written.n; i++) {
        invalid += GEOSisValid_r(geos, written.at[i]) != 1;
        *polygons += (size_t)GEOSGetNumGeometries_r(geos, written.at[i]);
    }
    if (invalid >= 0) geometries_free(&written);
    return invalid;
}

enum { DILATE = 1, ERODE = 2, OPEN = 4, CLOSE = 8, ALL = 15 };

static layers_answer all_valid(const char *file, const char *layer, const brush *by, bool dissolve, int wanted)
{
    static const char *const operations[] = {"dilate", "erode", "open", "close"};
    char *path = layers_path(file);
    layers_answer answer = path ? LAYERS_UNREADABLE : LAYERS_MISSING;
    geometries probe;
    if (path && getenv("SUNDER") && layers_read(path, layer, "ST_IsValid(geom)", &probe)) {
        answer = LAYERS_RIGHT;
        geometries_free(&probe);
        for (size_t k = 0; k < 4; k++) {
            if (!(wanted >> k & 1)) continue;
            char *options = test_format("%s --operation %s --output-layer grown --shape %s",
                                        dissolve ? "--dissolve" : "", operations[k], by->text);
            json *summary = layers_buffer(path, layer, options, "grown.gpkg");
            size_t polygons = 0;
            const long invalid = summary ? count_invalid("grown.gpkg", &polygons) : -1;
            print_message("%s %s: %zu polygons, %ld features invalid, %s mended\n", file, options, polygons, invalid,
                          json_text(json_get(summary, "repaired")));
            if (invalid != 0 || polygons == 0) answer = LAYERS_WRONG;
            json_free(summary);
            free(options);
        }
    }
    free(path);
    return answer;
}

static void test_validity(void **state)
{
    (void)state;
    static const struct {
        const char *file;
        const brush *by;
        bool dissolve;
        int operations;
    } runs[] = {{"krems_2013.gpkg", &octagon, false, ALL},
                {"krems_2013.gpkg", &square, true, ALL},
                {"krems_2013.gpkg", &octagon, true, ALL},
                {"saint_jean_la_poterie.gpkg", &square, false, ALL},
                {"saint_jean_la_poterie.gpkg", &octagon, true, ALL},
                {"paris_cite_2014.gpkg", &octagon, false, DILATE},
                {"paris_cite_2014.gpkg", &square, true, DILATE | CLOSE}};
    layers_tally t = {0};
    for (size_t i = 0; i < sizeof runs / sizeof *runs; i++)
        layers_count(&t, all_valid(runs[i].file, "buildings", runs[i].by, runs[i].dissolve, runs[i].operations));
    layers_conclude(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_areas), cmocka_unit_test(test_validity)};
    return cmocka_run_group_tests_name("buffers beside GEOS", tests, layers_open, layers_close);
}
