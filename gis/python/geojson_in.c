/* geojson_in.c: geometries given as mappings as in GeoJSON (also __geo_interface__), or as sequences of pairs. */
#include "python/features_in.h"

#include "python/buffers.h"

#include <stdlib.h>
#include <string.h>

/* Appends one point given as a sequence; more numbers than two are ignored. */
static bool add_pair(gis_polygons *to, PyObject *pair, const char *who)
{
    if (!(PyTuple_Check(pair) || PyList_Check(pair) ||
          (PySequence_Check(pair) && !PyUnicode_Check(pair) && !PyBytes_Check(pair))) ||
        PySequence_Size(pair) < 2) {
        PyErr_Clear();
        return gis_py_wrong(who, "a vertex is not a pair of numbers");
    }
    double xy[2];
    for (Py_ssize_t k = 0; k < 2; k++) {
        PyObject *item = PySequence_GetItem(pair, k);
        if (!item) return false;
        xy[k] = PyFloat_AsDouble(item);
        Py_DECREF(item);
        if (xy[k] == -1 && PyErr_Occurred()) {
            PyErr_Clear();
            return gis_py_wrong(who, "a coordinate is not a number");
        }
    }
    return gis_py_vertex(to, xy[0], xy[1]);
}

/* Appends the points of an array, or of a sequence of pairs. */
static bool add_points(gis_polygons *to, PyObject *points, const char *who)
{
    if (PyObject_CheckBuffer(points)) {
        double *xy;
        size_t n;
        if (!gis_py_coordinates(points, who, false, &xy, &n)) return false;
        bool done = true;
        for (size_t k = 0; done && k < n; k++) done = gis_py_vertex(to, xy[2 * k], xy[2 * k + 1]);
        free(xy);
        return done;
    }
    if (!PySequence_Check(points) || PyUnicode_Check(points)) return gis_py_wrong(who, "not a sequence of vertices");
    const Py_ssize_t n = PySequence_Size(points);
    bool done = n >= 0;
    for (Py_ssize_t k = 0; done && k < n; k++) {
        PyObject *pair = PySequence_GetItem(points, k);
        done = pair && add_pair(to, pair, who);
        Py_XDECREF(pair);
    }
    return done;
}

typedef bool add_part(gis_py_features *to, PyObject *part, const char *who);

/* Calls add() for each part of a sequence. */
static bool add_parts(gis_py_features *to, PyObject *parts, const char *who, add_part *add)
{
    if (!PySequence_Check(parts) || PyUnicode_Check(parts)) return gis_py_wrong(who, "coordinates are not a sequence");
    const Py_ssize_t n = PySequence_Size(parts);
    bool done = n >= 0;
    for (Py_ssize_t k = 0; done && k < n; k++) {
        PyObject *part = PySequence_GetItem(parts, k);
        done = part && add(to, part, who);
        Py_XDECREF(part);
    }
    return done;
}

static bool add_ring(gis_py_features *to, PyObject *ring, const char *who)
{
    return add_points(&to->areas, ring, who) && gis_py_end_ring(to);
}

static bool add_polygon(gis_py_features *to, PyObject *polygon, const char *who)
{
    if (PySequence_Check(polygon) && PySequence_Size(polygon) == 0) return true;
    PyErr_Clear();
    return add_parts(to, polygon, who, add_ring) && gis_py_end_polygon(to);
}

static bool add_line(gis_py_features *to, PyObject *line, const char *who)
{
    const size_t before = to->lines.vertices;
    return add_points(&to->lines, line, who) && (to->lines.vertices == before || gis_py_end_line(to));
}

static bool add_point(gis_py_features *to, PyObject *point, const char *who)
{
    if (PySequence_Check(point) && PySequence_Size(point) == 0) return true;
    PyErr_Clear();
    return add_pair(&to->lines, point, who) && gis_py_end_line(to);
}

static bool add_polygons(gis_py_features *to, PyObject *polygons, const char *who)
{
    return add_parts(to, polygons, who, add_polygon);
}

static bool add_lines(gis_py_features *to, PyObject *lines, const char *who)
{
    return add_parts(to, lines, who, add_line);
}

static bool add_all_points(gis_py_features *to, PyObject *points, const char *who)
{
    return add_parts(to, points, who, add_point);
}

/* ---- Mappings ---------------------------------------------------------------------------------------------------- */

/* The types, the member that holds their content, and the function for it. */
typedef struct kind {
    const char *name, *member;
    add_part *add; /* NULL: a mapping, or several of them */
} kind;

static const kind kinds[] = {
    {"Polygon", "coordinates", add_polygon},       {"MultiPolygon", "coordinates", add_polygons},
    {"LineString", "coordinates", add_line},       {"LinearRing", "coordinates", add_line},
    {"MultiLineString", "coordinates", add_lines}, {"Point", "coordinates", add_point},
    {"MultiPoint", "coordinates", add_all_points}, {"Feature", "geometry", NULL},
    {"FeatureCollection", "features", NULL},       {"GeometryCollection", "geometries", NULL},
};

static const kind *find_kind(PyObject *mapping, const char *who)
{
    PyObject *type = PyMapping_GetItemString(mapping, "type");
    if (!type) PyErr_Clear();
    const char *text = type && PyUnicode_Check(type) ? PyUnicode_AsUTF8AndSize(type, NULL) : NULL;
    const kind *found = NULL;
    for (size_t k = 0; text && k < sizeof kinds / sizeof *kinds; k++)
        if (strcmp(text, kinds[k].name) == 0) found = &kinds[k];
    if (!found) {
        PyErr_Clear();
        if (text)
            gis_py_wrong(who, "a mapping of the type %.50s, which is not a geometry of GeoJSON", text);
        else
            gis_py_wrong(who, "a mapping without a type; a geometry of GeoJSON has one");
    }
    Py_XDECREF(type);
    return found;
}

bool gis_py_mapping_add(gis_py_features *to, PyObject *mapping, const char *who, int depth)
{
    if (depth > GIS_PY_DEEPEST) return gis_py_wrong(who, "collections are nested too deeply");
    if (mapping == Py_None) return true;
    if (!PyMapping_Check(mapping)) return gis_py_wrong(who, "a member of a collection is not a mapping");
    const kind *of = find_kind(mapping, who);
    if (!of) return false;
    PyObject *content = PyMapping_GetItemString(mapping, of->member);
    if (!content) {
        PyErr_Clear();
        return gis_py_wrong(who, "a %s without %s", of->name, of->member);
    }
    bool done;
    if (of->add) {
        done = of->add(to, content, who);
    } else if (strcmp(of->member, "geometry") == 0) {
        done = gis_py_mapping_add(to, content, who, depth + 1);
    } else {
        const Py_ssize_t n = PySequence_Check(content) ? PySequence_Size(content) : -1;
        done = n >= 0 || gis_py_wrong(who, "its %s are not a sequence", of->member);
        for (Py_ssize_t k = 0; done && k < n; k++) {
            PyObject *part = PySequence_GetItem(content, k);
            done = part && gis_py_mapping_add(to, part, who, depth + 1);
            Py_XDECREF(part);
        }
    }
    Py_DECREF(content);
    return done;
}

/* ---- Sequences --------------------------------------------------------------------------------------------------- */

/* Are the items of the sequence numbers in sequence, rather than sequences of sequences: a ring of pairs? */
static bool is_ring(PyObject *sequence)
{
    if (PyObject_CheckBuffer(sequence)) return true;
    PyObject *first = PySequence_Size(sequence) > 0 ? PySequence_GetItem(sequence, 0) : NULL, *inner = NULL;
    const bool flat = first && PyObject_CheckBuffer(first);
    if (first && !flat && PySequence_Check(first) && !PyUnicode_Check(first) && PySequence_Size(first) > 0)
        inner = PySequence_GetItem(first, 0);
    const bool ring = inner && PyNumber_Check(inner);
    PyErr_Clear();
    Py_XDECREF(first);
    Py_XDECREF(inner);
    return ring;
}

bool gis_py_sequence_add(gis_py_features *to, PyObject *sequence, const char *who)
{
    if (is_ring(sequence)) return add_ring(to, sequence, who) && gis_py_end_polygon(to);
    if (PySequence_Size(sequence) == 0) return gis_py_wrong(who, "an empty sequence; a polygon has rings");
    return add_parts(to, sequence, who, add_ring) && gis_py_end_polygon(to);
}
