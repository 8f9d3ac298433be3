/* geometry.c: converts OGR geometries to arrays and back, and translates them in place.
 *
 * The functions recurse on the nesting of collections, which GDAL's readers limit to 32, never on the number of
 * vertices or parts. */
#include "geometry/geometry.h"

#include <cpl_conv.h>
#include <float.h>
#include <math.h>

static bool is_polygon(OGRwkbGeometryType flat)
{
    return flat == wkbPolygon || flat == wkbCurvePolygon || flat == wkbTriangle;
}

/* Is it a point, or a curve with vertices of its own? A LinearRing has the type LineString. */
static bool is_leaf(OGRwkbGeometryType flat)
{
    return flat == wkbPoint || flat == wkbLineString || flat == wkbCircularString;
}

/* ---- Content of a geometry --------------------------------------------------------------------------------------- */

enum { HAS_POLYGON = 1, HAS_LINE = 2, HAS_POINT = 4 };

static unsigned contents_of(OGRGeometryH geometry)
{
    if (OGR_G_IsEmpty(geometry)) return 0;
    OGRwkbGeometryType flat = wkbFlatten(OGR_G_GetGeometryType(geometry));
    if (is_polygon(flat)) return HAS_POLYGON;
    if (flat == wkbPoint) return HAS_POINT;
    if (is_leaf(flat) || flat == wkbCompoundCurve) return HAS_LINE;
    unsigned found = 0;
    for (int i = 0; i < OGR_G_GetGeometryCount(geometry); i++) found |= contents_of(OGR_G_GetGeometryRef(geometry, i));
    return found;
}

gis_content gis_geometry_content(OGRGeometryH geometry)
{
    unsigned found = geometry ? contents_of(geometry) : 0;
    return !found ? GIS_NOTHING : found & HAS_POLYGON ? GIS_POLYGONS : found == HAS_POINT ? GIS_POINTS : GIS_OTHER;
}

bool gis_geometry_is_finite(OGRGeometryH geometry)
{
    if (!geometry || OGR_G_IsEmpty(geometry)) return true;
    if (is_leaf(wkbFlatten(OGR_G_GetGeometryType(geometry)))) {
        int n = OGR_G_GetPointCount(geometry);
        for (int i = 0; i < n; i++)
            if (!isfinite(OGR_G_GetX(geometry, i)) || !isfinite(OGR_G_GetY(geometry, i))) return false;
        return true;
    }
    for (int i = 0; i < OGR_G_GetGeometryCount(geometry); i++)
        if (!gis_geometry_is_finite(OGR_G_GetGeometryRef(geometry, i))) return false;
    return true;
}

/* ---- Polygons to arrays ------------------------------------------------------------------------------------------ */

static bool append_polygon(OGRGeometryH polygon, gis_polygons *set, gis_error *error)
{
    size_t rings_before = set->rings;
    for (int r = 0; r < OGR_G_GetGeometryCount(polygon); r++) {
        OGRGeometryH ring = OGR_G_GetGeometryRef(polygon, r);
        int n = OGR_G_GetPointCount(ring);
        if (n <= 0) {
            if (r == 0) return true; /* without an outer ring the polygon is empty, whatever its holes */
            continue;
        }
        if (!gis_polygons_reserve(set, (size_t)n, error)) return false;
        double *to = set->xy + 2 * set->vertices;
        OGR_G_GetPoints(ring, to, 2 * (int)sizeof *to, to + 1, 2 * (int)sizeof *to, NULL, 0);
        set->vertices += (size_t)n;
        if (!gis_polygons_end_closed_ring(set, error)) return false;
    }
    return set->rings == rings_before || gis_polygons_end_polygon(set, error);
}

static bool append_polygons(OGRGeometryH geometry, gis_polygonal_part *part, gis_error *error)
{
    if (OGR_G_IsEmpty(geometry)) return true;
    OGRwkbGeometryType flat = wkbFlatten(OGR_G_GetGeometryType(geometry));
    if (is_polygon(flat)) return append_polygon(geometry, &part->set, error);
    if (is_leaf(flat) || flat == wkbCompoundCurve) return true;
    for (int i = 0; i < OGR_G_GetGeometryCount(geometry); i++)
        if (!append_polygons(OGR_G_GetGeometryRef(geometry, i), part, error)) return false;
    return true;
}

/* The sagitta of a chord: how far an arc may be from the chord that GDAL draws for it. A chord of length c of a circle
 * with radius R is at most R - sqrt(R^2 - c^2/4) away from the arc. GDAL's step differs from arc to arc, so each arc is
 * linearised separately, and its longest chord is used. All this is computed in doubles; the rounding errors are far
 * below the slack that is added at the end (1e-9 of the radius is about 1e6 times the relative error of a dozen
 * operations, and the vertices are off by some ulps of a coordinate). */
static double sagitta_of(double chord, double radius)
{
    double half = chord / 2, rest = radius * radius - half * half;
    return half * half / (radius + sqrt(fmax(0, rest))); /* R - sqrt(R^2 - c^2/4) without its cancellation */
}

static bool arc_deviation(OGRGeometryH arc, double *deviation, gis_error *error)
{
    double x[3], y[3], largest = 0;
    for (int i = 0; i < 3; i++) {
        x[i] = OGR_G_GetX(arc, i);
        y[i] = OGR_G_GetY(arc, i);
        largest = fmax(largest, fmax(fabs(x[i]), fabs(y[i])));
    }
    double ax = x[1] - x[0], ay = y[1] - y[0], bx = x[2] - x[1], by = y[2] - y[1], cx = x[2] - x[0], cy = y[2] - y[0];
    double area2 = fabs(ax * cy - ay * cx);
    double radius = cx == 0 && cy == 0 ? hypot(ax, ay) / 2 /* a full circle: the middle point is opposite the ends */
                                       : hypot(ax, ay) * hypot(bx, by) * hypot(cx, cy) / (2 * area2);
    OGRGeometryH line = OGR_G_GetLinearGeometry(arc, 0, NULL);
    if (!line) return gis_fail(error, "GDAL cannot linearise an arc");
    double longest = 0;
    int n = OGR_G_GetPointCount(line);
    for (int i = 1; i < n; i++)
        longest = fmax(longest, hypot(OGR_G_GetX(line, i) - OGR_G_GetX(line, i - 1),
                                      OGR_G_GetY(line, i) - OGR_G_GetY(line, i - 1)));
    OGR_G_DestroyGeometry(line);
    double slack = 16 * DBL_EPSILON * largest;
    double sagitta = 0; /* collinear points have an infinite radius; their chords are exact */
    if (isfinite(radius)) sagitta = sagitta_of(longest, radius);
    if (isfinite(radius) && n == 2 && area2 > 0) /* drawn as one chord, even if it spans more than half of the circle */
        sagitta = fmax(sagitta, area2 / hypot(cx, cy));
    *deviation = fmax(*deviation, sagitta + 1e-9 * fmin(radius, longest) + slack);
    return true;
}

static bool arcs_deviation(OGRGeometryH geometry, double *deviation, gis_error *error)
{
    OGRwkbGeometryType flat = wkbFlatten(OGR_G_GetGeometryType(geometry));
    if (flat == wkbPoint || flat == wkbLineString) return true;
    if (flat != wkbCircularString) {
        for (int i = 0; i < OGR_G_GetGeometryCount(geometry); i++)
            if (!arcs_deviation(OGR_G_GetGeometryRef(geometry, i), deviation, error)) return false;
        return true;
    }
    int n = OGR_G_GetPointCount(geometry);
    for (int i = 0; i + 2 < n; i += 2) {
        OGRGeometryH arc = OGR_G_CreateGeometry(wkbCircularString);
        if (!arc) return gis_no_memory(error);
        for (int k = 0; k < 3; k++) OGR_G_AddPoint_2D(arc, OGR_G_GetX(geometry, i + k), OGR_G_GetY(geometry, i + k));
        bool done = arc_deviation(arc, deviation, error);
        OGR_G_DestroyGeometry(arc);
        if (!done) return false;
    }
    return true;
}

bool gis_geometry_polygonal_part(OGRGeometryH geometry, gis_polygonal_part *part, gis_error *error)
{
    part->set.vertices = part->set.rings = part->set.polygons = 0;
    part->linearised = 0;
    if (!geometry) return true;
    if (!OGR_G_HasCurveGeometry(geometry, TRUE)) return append_polygons(geometry, part, error);
    OGRGeometryH linear = OGR_G_GetLinearGeometry(geometry, 0, NULL);
    if (!linear) return gis_fail(error, "GDAL cannot linearise the arcs of a geometry");
    bool done = append_polygons(linear, part, error) && arcs_deviation(geometry, &part->linearised, error);
    OGR_G_DestroyGeometry(linear);
    return done;
}

void gis_polygonal_part_clear(gis_polygonal_part *part)
{
    gis_polygons_clear(&part->set);
    *part = (gis_polygonal_part){0};
}

static size_t count_vertices(OGRGeometryH geometry)
{
    if (OGR_G_IsEmpty(geometry)) return 0;
    if (is_leaf(wkbFlatten(OGR_G_GetGeometryType(geometry)))) return (size_t)OGR_G_GetPointCount(geometry);
    size_t n = 0;
    for (int i = 0; i < OGR_G_GetGeometryCount(geometry); i++) n += count_vertices(OGR_G_GetGeometryRef(geometry, i));
    return n;
}

static double *copy_vertices(OGRGeometryH geometry, double *to)
{
    if (OGR_G_IsEmpty(geometry)) return to;
    if (is_leaf(wkbFlatten(OGR_G_GetGeometryType(geometry)))) {
        int n = OGR_G_GetPointCount(geometry);
        OGR_G_GetPoints(geometry, to, 2 * (int)sizeof *to, to + 1, 2 * (int)sizeof *to, NULL, 0);
        return to + 2 * n;
    }
    for (int i = 0; i < OGR_G_GetGeometryCount(geometry); i++)
        to = copy_vertices(OGR_G_GetGeometryRef(geometry, i), to);
    return to;
}

bool gis_geometry_points(OGRGeometryH geometry, double **xy, size_t *n, gis_error *error)
{
    size_t count = geometry ? count_vertices(geometry) : 0;
    double *made = VSIMalloc2(count + 1, 2 * sizeof *made);
    if (!made) return gis_no_memory(error);
    if (count) copy_vertices(geometry, made);
    *xy = made;
    *n = count;
    return true;
}

/* ---- Translation, and other changes of vertices ------------------------------------------------------------------ */

/* Sets the X and Y of a vertex by the setter for the geometry's dimension; another one would add or clear Z or M. */
static void set_vertex(OGRGeometryH leaf, int i, const double xy[2])
{
    bool z = OGR_G_Is3D(leaf), m = OGR_G_IsMeasured(leaf);
    if (z && m)
        OGR_G_SetPointZM(leaf, i, xy[0], xy[1], OGR_G_GetZ(leaf, i), OGR_G_GetM(leaf, i));
    else if (m)
        OGR_G_SetPointM(leaf, i, xy[0], xy[1], OGR_G_GetM(leaf, i));
    else if (z)
        OGR_G_SetPoint(leaf, i, xy[0], xy[1], OGR_G_GetZ(leaf, i));
    else
        OGR_G_SetPoint_2D(leaf, i, xy[0], xy[1]);
}

bool gis_geometry_change(OGRGeometryH geometry, gis_vertex_change *change, void *user, gis_error *error)
{
    if (!geometry || OGR_G_IsEmpty(geometry)) return true; /* an empty point with coordinates would not be empty */
    if (!is_leaf(wkbFlatten(OGR_G_GetGeometryType(geometry)))) {
        for (int i = 0; i < OGR_G_GetGeometryCount(geometry); i++)
            if (!gis_geometry_change(OGR_G_GetGeometryRef(geometry, i), change, user, error)) return false;
        return true;
    }
    const int n = OGR_G_GetPointCount(geometry);
    for (int i = 0; i < n; i++) {
        double xy[2] = {OGR_G_GetX(geometry, i), OGR_G_GetY(geometry, i)};
        if (!change(user, xy, error)) return false;
        set_vertex(geometry, i, xy);
    }
    return true;
}

static bool translate_vertex(void *user, double xy[2], gis_error *error)
{
    const double *move = user;
    (void)error;
    for (int k = 0; k < 2; k++) xy[k] += move[k];
    return true;
}

bool gis_geometry_translate(OGRGeometryH geometry, double dx, double dy, gis_error *error)
{
    double move[2] = {dx, dy};
    return (dx == 0 && dy == 0) || gis_geometry_change(geometry, translate_vertex, move, error);
}

/* ---- New geometries ---------------------------------------------------------------------------------------------- */

OGRGeometryH gis_geometry_line(const double from[2], const double to[2])
{
    OGRGeometryH line = OGR_G_CreateGeometry(wkbLineString);
    if (line) {
        OGR_G_AddPoint_2D(line, from[0], from[1]);
        OGR_G_AddPoint_2D(line, to[0], to[1]);
    }
    return line;
}

OGRGeometryH gis_geometry_point(const double xy[2])
{
    OGRGeometryH point = OGR_G_CreateGeometry(wkbPoint);
    if (point) OGR_G_SetPoint_2D(point, 0, xy[0], xy[1]);
    return point;
}

static OGRGeometryH new_ring(const double *xy, size_t first, size_t end)
{
    OGRGeometryH ring = OGR_G_CreateGeometry(wkbLinearRing);
    if (!ring) return NULL;
    size_t n = end - first;
    bool closed = n > 1 && xy[2 * first] == xy[2 * end - 2] && xy[2 * first + 1] == xy[2 * end - 1];
    OGR_G_SetPointCount(ring, (int)n + !closed);
    for (size_t i = 0; i < n; i++) OGR_G_SetPoint_2D(ring, (int)i, xy[2 * (first + i)], xy[2 * (first + i) + 1]);
    if (!closed && n > 0) OGR_G_SetPoint_2D(ring, (int)n, xy[2 * first], xy[2 * first + 1]);
    return ring;
}

OGRGeometryH gis_geometry_polygon(const gis_polygons *set, size_t p)
{
    OGRGeometryH polygon = OGR_G_CreateGeometry(wkbPolygon);
    for (size_t r = p ? set->poly_end[p - 1] : 0; polygon && r < set->poly_end[p]; r++) {
        OGRGeometryH ring = new_ring(set->xy, r ? set->ring_end[r - 1] : 0, set->ring_end[r]);
        if (!ring || OGR_G_AddGeometryDirectly(polygon, ring) != OGRERR_NONE) {
            OGR_G_DestroyGeometry(ring);
            OGR_G_DestroyGeometry(polygon);
            polygon = NULL;
        }
    }
    return polygon;
}

OGRGeometryH gis_geometry_polygons(const gis_polygons *set, bool multi)
{
    if (set->polygons == 1 && !multi) return gis_geometry_polygon(set, 0);
    OGRGeometryH all = OGR_G_CreateGeometry(wkbMultiPolygon);
    for (size_t p = 0; all && p < set->polygons; p++) {
        OGRGeometryH polygon = gis_geometry_polygon(set, p);
        if (!polygon || OGR_G_AddGeometryDirectly(all, polygon) != OGRERR_NONE) {
            OGR_G_DestroyGeometry(polygon);
            OGR_G_DestroyGeometry(all);
            all = NULL;
        }
    }
    return all;
}
