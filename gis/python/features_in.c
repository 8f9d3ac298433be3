/* features_in.c: see features_in.h. */
#include "python/features_in.h"

#include "base/array.h"
#include "python/buffers.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void gis_py_features_clear(gis_py_features *features)
{
    gis_polygons_clear(&features->areas);
    gis_polygons_clear(&features->lines);
    free(features->area_end);
    free(features->line_end);
    free(features->points);
    *features = (gis_py_features){0};
}

static bool or_no_memory(bool done)
{
    if (!done) PyErr_NoMemory();
    return done;
}

bool gis_py_vertex(gis_polygons *to, double x, double y) { return or_no_memory(gis_polygons_vertex(to, x, y, NULL)); }
bool gis_py_end_ring(gis_py_features *to) { return or_no_memory(gis_polygons_end_closed_ring(&to->areas, NULL)); }
bool gis_py_end_polygon(gis_py_features *to) { return or_no_memory(gis_polygons_end_polygon(&to->areas, NULL)); }
bool gis_py_end_line(gis_py_features *to) { return or_no_memory(gis_polygons_end_ring(&to->lines, NULL)); }

/* Ends the geometry that was added last. */
static bool end_feature(gis_py_features *to)
{
    const size_t n = to->n, first = n ? to->line_end[n - 1] : 0;
    if (!gis_array_reserve(&to->area_end, &to->area_capacity, n + 1, sizeof *to->area_end) ||
        !gis_array_reserve(&to->line_end, &to->line_capacity, n + 1, sizeof *to->line_end) ||
        !gis_array_reserve(&to->points, &to->points_capacity, n + 1, sizeof *to->points))
        return or_no_memory(false);
    to->area_end[n] = to->areas.polygons;
    to->line_end[n] = to->lines.rings;
    to->points[n] = to->lines.rings > first && to->areas.polygons == (n ? to->area_end[n - 1] : 0);
    for (size_t k = first; to->points[n] && k < to->lines.rings; k++)
        to->points[n] = to->lines.ring_end[k] - (k ? to->lines.ring_end[k - 1] : 0) == 1;
    to->n++;
    return true;
}

gis_py_content gis_py_features_content(const gis_py_features *from, size_t i)
{
    if (from->area_end[i] > (i ? from->area_end[i - 1] : 0)) return GIS_PY_POLYGONS;
    if (from->points[i]) return GIS_PY_POINTS;
    return from->line_end[i] > (i ? from->line_end[i - 1] : 0) ? GIS_PY_LINES : GIS_PY_NOTHING;
}

static bool add_bytes(gis_py_features *to, PyObject *object, const char *who)
{
    Py_buffer view;
    if (PyObject_GetBuffer(object, &view, PyBUF_CONTIG_RO) < 0) {
        PyErr_Clear();
        return gis_py_wrong(who, "bytes that are not contiguous");
    }
    const bool done = gis_py_wkb_add(to, view.buf, (size_t)view.len, who);
    PyBuffer_Release(&view);
    return done;
}

/* Gets an attribute, or NULL without an exception if there is none. */
static PyObject *attribute_of(PyObject *object, const char *name)
{
    PyObject *value = PyObject_GetAttrString(object, name);
    if (!value) PyErr_Clear();
    return value;
}

static bool add_any(gis_py_features *to, PyObject *geometry, const char *who)
{
    if (geometry == Py_None) return true;
    if (gis_py_is_bytes(geometry)) return add_bytes(to, geometry, who);
    if (PyUnicode_Check(geometry)) return gis_py_wrong(who, "a text, and not a geometry");
    if (PyList_Check(geometry) || PyTuple_Check(geometry) || PyObject_CheckBuffer(geometry))
        return gis_py_sequence_add(to, geometry, who);
    if (PyDict_Check(geometry)) return gis_py_mapping_add(to, geometry, who, 0);
    PyObject *value = attribute_of(geometry, "wkb");
    bool done;
    if (value && PyBytes_Check(value)) {
        done = add_bytes(to, value, who);
        Py_DECREF(value);
        return done;
    }
    Py_XDECREF(value);
    value = attribute_of(geometry, "__geo_interface__");
    if (value) {
        done = PyMapping_Check(value) ? gis_py_mapping_add(to, value, who, 0)
                                      : gis_py_wrong(who, "its __geo_interface__ is not a mapping");
        Py_DECREF(value);
        return done;
    }
    if (PyMapping_Check(geometry) && PyMapping_HasKeyString(geometry, "type"))
        return gis_py_mapping_add(to, geometry, who, 0);
    PyObject *type = PyType_GetName(Py_TYPE(geometry));
    const char *name = type ? PyUnicode_AsUTF8AndSize(type, NULL) : NULL;
    if (name) gis_py_wrong(who, "not a geometry: an object of the type %.100s", name);
    Py_XDECREF(type);
    return false;
}

bool gis_py_features_add(gis_py_features *to, PyObject *geometry, const char *who)
{
    if (add_any(to, geometry, who)) return end_feature(to);
    /* What a foreign object raised is no rule of ours: its exception stays, unless it is of lookups. */
    return false;
}

bool gis_py_features_add_all(gis_py_features *to, PyObject *geometries, const char *who)
{
    PyObject *each = PyObject_GetIter(geometries), *item;
    if (!each) {
        PyErr_Clear();
        return gis_py_wrong(who, "not a sequence of geometries");
    }
    bool done = true;
    for (size_t i = 0; done && (item = PyIter_Next(each)); i++) {
        char one[100];
        snprintf(one, sizeof one, "%s %zu", who, i);
        done = (i % 256 != 0 || PyErr_CheckSignals() == 0) && gis_py_features_add(to, item, one);
        Py_DECREF(item);
    }
    Py_DECREF(each);
    return done && !PyErr_Occurred();
}

/* ---- Ragged arrays ----------------------------------------------------------------------------------------------- */

/* Offsets: from 0, never falling, up to `most`. Sets *ends to the n values after the first; to be freed with free(). */
static bool read_offsets(PyObject *object, const char *who, size_t most, int64_t **ends, size_t *n)
{
    if (!gis_py_integers(object, who, SIZE_MAX, ends, n)) return false;
    bool done = *n > 0 && (*ends)[0] == 0;
    if (!done) gis_py_wrong(who, "offsets have to begin with 0");
    for (size_t i = 1; done && i < *n; i++)
        if ((*ends)[i] < (*ends)[i - 1] || (uint64_t)(*ends)[i] > most)
            done = gis_py_wrong(who, "offset %zu is %lld; it must be from %lld to %zu", i, (long long)(*ends)[i],
                                (long long)(*ends)[i - 1], most);
    if (!done) {
        free(*ends);
        *ends = NULL;
        return false;
    }
    (*n)--;
    for (size_t i = 0; i < *n; i++) (*ends)[i] = (*ends)[i + 1];
    return true;
}

typedef struct ragged {
    double *xy;
    int64_t *ring_end, *polygon_end, *geometry_end; /* NULL: each polygon is one geometry */
    size_t vertices, rings, polygons, geometries;
} ragged;

/* Makes room for all of it, in one step for each array. */
static bool reserve_ragged(gis_polygons *set, const ragged *from)
{
    return or_no_memory(
        gis_polygons_reserve(set, from->vertices, NULL) &&
        gis_array_reserve(&set->ring_end, &set->ring_capacity, set->rings + from->rings + 1, sizeof *set->ring_end) &&
        gis_array_reserve(&set->poly_end, &set->poly_capacity, set->polygons + from->polygons + 1,
                          sizeof *set->poly_end));
}

/* Copies polygon p to the room that was made; as by gis_polygons_end_closed_ring(), closing vertices are dropped. */
static void copy_polygon(gis_polygons *set, const ragged *from, size_t p)
{
    for (int64_t r = p ? from->polygon_end[p - 1] : 0; r < from->polygon_end[p]; r++) {
        const size_t first = r ? (size_t)from->ring_end[r - 1] : 0;
        size_t n = (size_t)from->ring_end[r] - first;
        const double *xy = from->xy + 2 * first;
        if (n > 1 && memcmp(xy, xy + 2 * (n - 1), 2 * sizeof *xy) == 0) n--;
        if (n > 0) memcpy(set->xy + 2 * set->vertices, xy, 2 * n * sizeof *xy);
        set->vertices += n;
        set->ring_end[set->rings++] = set->vertices;
    }
    set->poly_end[set->polygons++] = set->rings;
}

static bool add_ragged(gis_py_features *to, const ragged *from)
{
    size_t p = 0;
    if (!reserve_ragged(&to->areas, from)) return false;
    for (size_t i = 0; i < from->geometries; i++) {
        const size_t end = from->geometry_end ? (size_t)from->geometry_end[i] : i + 1;
        for (; p < end; p++) {
            /* An empty polygon is no polygon. */
            if (from->polygon_end[p] > (p ? from->polygon_end[p - 1] : 0)) copy_polygon(&to->areas, from, p);
        }
        if (!end_feature(to)) return false;
    }
    return true;
}

bool gis_py_features_add_ragged(gis_py_features *to, PyObject *coordinates, PyObject *rings, PyObject *polygons,
                                PyObject *geometries, const char *who)
{
    ragged from = {0};
    char name[100];
    bool done = PyObject_CheckBuffer(coordinates) || gis_py_wrong(who, "coordinates are not an array");
    snprintf(name, sizeof name, "%s: coordinates", who);
    done = done && gis_py_coordinates(coordinates, name, true, &from.xy, &from.vertices);
    snprintf(name, sizeof name, "%s: ring offsets", who);
    done = done && read_offsets(rings, name, from.vertices, &from.ring_end, &from.rings);
    snprintf(name, sizeof name, "%s: polygon offsets", who);
    done = done && read_offsets(polygons, name, from.rings, &from.polygon_end, &from.polygons);
    from.geometries = from.polygons;
    snprintf(name, sizeof name, "%s: geometry offsets", who);
    if (done && geometries != Py_None)
        done = read_offsets(geometries, name, from.polygons, &from.geometry_end, &from.geometries);
    done = done && add_ragged(to, &from);
    free(from.xy);
    free(from.ring_end);
    free(from.polygon_end);
    free(from.geometry_end);
    return done;
}
