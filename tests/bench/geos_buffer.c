/* geos_buffer each|dissolve|close|open SHAPE FILE: the operations of bench_buffer, by GEOS: round buffers of N / 4
 * quadrant segments for disc:R:N (GEOS's polygons lie in the round buffer, ours around it), mitred ones of half the
 * side for square:SIDE. `dissolve` is the buffer of each feature, then the unary union of all; `close` is the same,
 * then the buffer inwards; `open` is the union of all and two buffers. */
#include "buffer_input.h"
#include "geos_input.h"

/* Takes ownership of g; sign -1 erodes it. */
static GEOSGeometry *buffer(GEOSGeometry *g, const bench_shape *by, int sign)
{
    GEOSGeometry *grown;
    if (by->segments)
        grown = GEOSBuffer_r(geos, g, sign * by->size, (int)by->segments / 4);
    else
        grown = GEOSBufferWithStyle_r(geos, g, sign * by->size / 2, 8, GEOSBUF_CAP_FLAT, GEOSBUF_JOIN_MITRE, 5);
    GEOSGeom_destroy_r(geos, g);
    return geos_must(grown);
}

/* Takes ownership of all of them. */
static GEOSGeometry *unite(GEOSGeometry **all, size_t n)
{
    GEOSGeometry *many = geos_must(GEOSGeom_createCollection_r(geos, GEOS_GEOMETRYCOLLECTION, all, (unsigned)n));
    GEOSGeometry *one = geos_must(GEOSUnaryUnion_r(geos, many));
    GEOSGeom_destroy_r(geos, many);
    return one;
}

static void measure(const GEOSGeometry *g, size_t *vertices, double *area)
{
    double a;
    GEOSArea_r(geos, g, &a);
    *area += a;
    *vertices += geos_count(g);
}

static double once(const bench_layer *layer, const bench_shape *by, const char *how, size_t *vertices, double *area)
{
    const int each = strcmp(how, "each") == 0, open = strcmp(how, "open") == 0;
    GEOSGeometry **all = bench_alloc(layer->n * sizeof(GEOSGeometry *));
    double seconds;
    *vertices = 0;
    *area = 0;
    const double start = bench_now();
    for (size_t i = 0; i < layer->n; i++) {
        all[i] = geos_geometry(&layer->set[i]);
        if (!open) all[i] = buffer(all[i], by, 1);
        if (each) {
            measure(all[i], vertices, area); /* as cheap as our conversion to vertices, which is timed, too */
            GEOSGeom_destroy_r(geos, all[i]);
        }
    }
    if (!each) {
        GEOSGeometry *one = unite(all, layer->n);
        if (open || strcmp(how, "close") == 0) one = buffer(one, by, -1);
        if (open) one = buffer(one, by, 1);
        measure(one, vertices, area);
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
    geos_begin();
    for (; bench_again(n, spent); n++)
        spent += t[n] = once(&layer, &by, argv[1], &vertices, &area);
    printf("%zu %zu %zu %.12g %.6f\n", layer.n, bench_layer_vertices(&layer), vertices, area, bench_median(t, n));
    GEOS_finish_r(geos);
    bench_layer_free(&layer);
    return 0;
}
