/* geometry_wind.c: orients the rings of polygons. The orientation of a ring is the turn at its lowest vertex, which the
 * library's predicate determines exactly; the sign of an area could be wrong by rounding. */
#include "geometry/geometry.h"

#include <cpl_conv.h>

static sunder_point point_at(OGRGeometryH ring, int i)
{
    return (sunder_point){OGR_G_GetX(ring, i), OGR_G_GetY(ring, i)};
}

static bool same_point(sunder_point p, sunder_point q) { return p.x == q.x && p.y == q.y; }

/* The turn at the lowest vertex (the rightmost of several) of n vertices without the closing one: +1 counter-clockwise,
 * -1 clockwise, 0 if it is a spike or all vertices coincide. The lowest vertex is on the convex hull, so for a simple
 * ring this is its orientation; for a ring that crosses itself it is what GDAL's reader of Shapefiles assumes. */
static int ring_turn(OGRGeometryH ring, int n)
{
    int lowest = 0;
    for (int i = 1; i < n; i++) {
        sunder_point p = point_at(ring, i), q = point_at(ring, lowest);
        if (p.y < q.y || (p.y == q.y && p.x > q.x)) lowest = i;
    }
    sunder_point at = point_at(ring, lowest), before = at, after = at;
    for (int i = 1; i < n && same_point(before, at); i++) /* skip repeated vertices */
        before = point_at(ring, (lowest + n - i) % n);
    for (int i = 1; i < n && same_point(after, at); i++) after = point_at(ring, (lowest + i) % n);
    return sunder_orient(&before, &at, &after);
}

static bool reverse_ring(OGRGeometryH ring, gis_error *error)
{
    int n = OGR_G_GetPointCount(ring);
    bool z = OGR_G_Is3D(ring), m = OGR_G_IsMeasured(ring);
    enum { STRIDE = 4 * sizeof(double) };
    double *all = VSIMalloc2((size_t)n, STRIDE);
    if (!all) return gis_no_memory(error);
    OGR_G_GetPointsZM(ring, all, STRIDE, all + 1, STRIDE, all + 2, STRIDE, all + 3, STRIDE);
    for (int i = 0; i < n; i++) {
        const double *p = all + 4 * (n - 1 - i);
        if (z && m)
            OGR_G_SetPointZM(ring, i, p[0], p[1], p[2], p[3]);
        else if (m)
            OGR_G_SetPointM(ring, i, p[0], p[1], p[3]);
        else if (z)
            OGR_G_SetPoint(ring, i, p[0], p[1], p[2]);
        else
            OGR_G_SetPoint_2D(ring, i, p[0], p[1]);
    }
    VSIFree(all);
    return true;
}

static bool wind_polygon(OGRGeometryH polygon, gis_error *error)
{
    for (int r = 0; r < OGR_G_GetGeometryCount(polygon); r++) {
        OGRGeometryH ring = OGR_G_GetGeometryRef(polygon, r);
        int n = OGR_G_GetPointCount(ring);
        if (n > 1 && same_point(point_at(ring, 0), point_at(ring, n - 1))) n--;
        int turn = n >= 3 ? ring_turn(ring, n) : 0;
        if (turn == (r == 0 ? 1 : -1) && !reverse_ring(ring, error)) return false;
    }
    return true;
}

bool gis_geometry_wind_clockwise(OGRGeometryH geometry, gis_error *error)
{
    if (!geometry || OGR_G_IsEmpty(geometry)) return true;
    OGRwkbGeometryType flat = wkbFlatten(OGR_G_GetGeometryType(geometry));
    if (flat == wkbPolygon || flat == wkbTriangle) return wind_polygon(geometry, error);
    if (flat == wkbPoint || flat == wkbCurvePolygon || OGR_GT_IsSubClassOf(flat, wkbCurve)) return true;
    for (int i = 0; i < OGR_G_GetGeometryCount(geometry); i++)
        if (!gis_geometry_wind_clockwise(OGR_G_GetGeometryRef(geometry, i), error)) return false;
    return true;
}
