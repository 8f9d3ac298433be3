/* Sets as GEOS's geometries; one context for the whole program. */
#ifndef SUNDER_BENCH_GEOS_INPUT_H
#define SUNDER_BENCH_GEOS_INPUT_H

#include "wkt_input.h"

#include <geos_c.h>

static GEOSContextHandle_t geos;

static inline void geos_complain(const char *message, void *user)
{
    (void)user;
    fprintf(stderr, "GEOS: %s\n", message);
}

static inline void *geos_must(void *made)
{
    if (!made) exit(1);
    return made;
}

static inline GEOSGeometry *geos_ring(const bench_set *s, size_t r)
{
    const size_t first = r ? s->ring_end[r - 1] : 0, n = s->ring_end[r] - first;
    GEOSCoordSequence *c = geos_must(GEOSCoordSeq_create_r(geos, (unsigned)n + 1, 2));
    for (size_t i = 0; i <= n; i++) {
        const double *xy = s->xy + 2 * (first + (i < n ? i : 0));
        GEOSCoordSeq_setXY_r(geos, c, (unsigned)i, xy[0], xy[1]);
    }
    return geos_must(GEOSGeom_createLinearRing_r(geos, c));
}

static inline GEOSGeometry *geos_polygon(const bench_set *s, size_t p)
{
    const size_t first = p ? s->poly_end[p - 1] : 0, holes = s->poly_end[p] - first - 1;
    GEOSGeometry **hole = bench_alloc((holes + 1) * sizeof(GEOSGeometry *));
    for (size_t i = 0; i < holes; i++) hole[i] = geos_ring(s, first + 1 + i);
    GEOSGeometry *g = geos_must(GEOSGeom_createPolygon_r(geos, geos_ring(s, first), hole, (unsigned)holes));
    free(hole);
    return g;
}

static inline GEOSGeometry *geos_geometry(const bench_set *s)
{
    if (s->polygons == 1) return geos_polygon(s, 0);
    GEOSGeometry **part = bench_alloc(s->polygons * sizeof(GEOSGeometry *));
    for (size_t p = 0; p < s->polygons; p++) part[p] = geos_polygon(s, p);
    GEOSGeometry *g = geos_must(GEOSGeom_createCollection_r(geos, GEOS_MULTIPOLYGON, part, (unsigned)s->polygons));
    free(part);
    return g;
}

static inline void geos_begin(void)
{
    geos = GEOS_init_r();
    GEOSContext_setErrorMessageHandler_r(geos, geos_complain, NULL);
}

/* The vertices of the result, without the repeated ones that close rings. */
static inline size_t geos_count(const GEOSGeometry *g)
{
    size_t n = 0;
    for (int i = 0; i < GEOSGetNumGeometries_r(geos, g); i++) {
        const GEOSGeometry *p = GEOSGetGeometryN_r(geos, g, i);
        if (GEOSisEmpty_r(geos, p)) continue;
        n += (size_t)GEOSGetNumCoordinates_r(geos, p) - 1 - (size_t)GEOSGetNumInteriorRings_r(geos, p);
    }
    return n;
}

#endif
