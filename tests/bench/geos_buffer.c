/* geos_buffer each|dissolve SHAPE FILE: what bench_buffer does, by GEOS: round buffers of N / 4 quadrant segments for
 * disc:R:N (GEOS's polygons lie in the round buffer, ours around it), mitred ones of half the side for square:SIDE.
 * `dissolve` is the buffer of each feature, then the unary union of all. */
#include "buffer_input.h"

#include <geos_c.h>
#include <stdarg.h>

static GEOSContextHandle_t geos;

static void complain(const char *message, void *user)
{
    (void)user;
    fprintf(stderr, "geos_buffer: %s\n", message);
}

static void *must(void *made)
{
    if (!made) exit(1);
    return made;
}

static GEOSGeometry *ring(const bench_set *s, size_t r)
{
    const size_t first = r ? s->ring_end[r - 1] : 0, n = s->ring_end[r] - first;
    GEOSCoordSequence *c = must(GEOSCoordSeq_create_r(geos, (unsigned)n + 1, 2));
    for (size_t i = 0; i <= n; i++) {
        const double *xy = s->xy + 2 * (first + (i < n ? i : 0));
        GEOSCoordSeq_setXY_r(geos, c, (unsigned)i, xy[0], xy[1]);
    }
    return must(GEOSGeom_createLinearRing_r(geos, c));
}

static GEOSGeometry *polygon(const bench_set *s, size_t p)
{
    const size_t first = p ? s->poly_end[p - 1] : 0, holes = s->poly_end[p] - first - 1;
    GEOSGeometry **hole = bench_alloc((holes + 1) * sizeof(GEOSGeometry *));
    for (size_t i = 0; i < holes; i++) hole[i] = ring(s, first + 1 + i);
    GEOSGeometry *g = must(GEOSGeom_createPolygon_r(geos, ring(s, first), hole, (unsigned)holes));
    free(hole);
    return g;
}

static GEOSGeometry *geometry(const bench_set *s)
{
    if (s->polygons == 1) return polygon(s, 0);
    GEOSGeometry **part = bench_alloc(s->polygons * sizeof(GEOSGeometry *));
    for (size_t p = 0; p < s->polygons; p++) part[p] = polygon(s, p);
    GEOSGeometry *g = must(GEOSGeom_createCollection_r(geos, GEOS_MULTIPOLYGON, part, (unsigned)s->polygons));
    free(part);
    return g;
}

static GEOSGeometry *buffer(const bench_set *s, const bench_shape *by)
{
    GEOSGeometry *g = geometry(s), *grown;
    if (by->segments)
        grown = GEOSBuffer_r(geos, g, by->size, (int)by->segments / 4);
    else
        grown = GEOSBufferWithStyle_r(geos, g, by->size / 2, 8, GEOSBUF_CAP_FLAT, GEOSBUF_JOIN_MITRE, 5);
    GEOSGeom_destroy_r(geos, g);
    return must(grown);
}

/* The vertices of the result, without the repeated ones that close rings. */
static size_t count(const GEOSGeometry *g)
{
    size_t n = 0;
    for (int i = 0; i < GEOSGetNumGeometries_r(geos, g); i++) {
        const GEOSGeometry *p = GEOSGetGeometryN_r(geos, g, i);
        if (GEOSisEmpty_r(geos, p)) continue;
        n += (size_t)GEOSGetNumCoordinates_r(geos, p) - 1 - (size_t)GEOSGetNumInteriorRings_r(geos, p);
    }
    return n;
}

static void measure(const GEOSGeometry *g, size_t *vertices, double *area)
{
    double a;
    GEOSArea_r(geos, g, &a);
    *area += a;
    *vertices += count(g);
}

static double once(const bench_layer *layer, const bench_shape *by, int dissolve, size_t *vertices, double *area)
{
    GEOSGeometry **all = bench_alloc(layer->n * sizeof(GEOSGeometry *));
    double seconds;
    *vertices = 0;
    *area = 0;
    const double start = bench_now();
    for (size_t i = 0; i < layer->n; i++) {
        all[i] = buffer(&layer->set[i], by);
        if (!dissolve) {
            measure(all[i], vertices, area); /* as cheap as ours, which is timed too */
            GEOSGeom_destroy_r(geos, all[i]);
        }
    }
    if (dissolve) {
        GEOSGeometry *many = must(GEOSGeom_createCollection_r(geos, GEOS_GEOMETRYCOLLECTION, all, (unsigned)layer->n));
        GEOSGeometry *one = must(GEOSUnaryUnion_r(geos, many));
        measure(one, vertices, area);
        GEOSGeom_destroy_r(geos, many);
        GEOSGeom_destroy_r(geos, one);
    }
    seconds = bench_now() - start;
    free(all);
    return seconds;
}

int main(int argc, char **argv)
{
    bench_layer layer;
    bench_shape by;
    double t[100], spent = 0, area = 0;
    size_t n = 0, vertices = 0;
    bench_buffer_arguments(argc, argv, &layer);
    if (!bench_shape_read(&by, argv[2])) return 2;
    geos = GEOS_init_r();
    GEOSContext_setErrorMessageHandler_r(geos, complain, NULL);
    for (; bench_again(n, spent); n++)
        spent += t[n] = once(&layer, &by, strcmp(argv[1], "dissolve") == 0, &vertices, &area);
    printf("%zu %zu %zu %.12g %.6f\n", layer.n, bench_layer_vertices(&layer), vertices, area, bench_median(t, n));
    GEOS_finish_r(geos);
    bench_layer_free(&layer);
    return 0;
}
