/* sum_type.c: see sum_type.h; and the functions that return a Sum. Exact coordinates are passed on as texts "num" or
 * "num/den", of which the package makes fractions. */
#include "python/sum_type.h"

#include "geometry/polygons_wkb.h"
#include "geometry/round/round.h"
#include "python/shapes_type.h"
#include "python/watched_call.h"

#include <string.h>

static void free_sum(PyObject *self)
{
    PyTypeObject *type = Py_TYPE(self);
    sunder_sum_free(((gis_py_sum *)self)->owned);
    Py_XDECREF(((gis_py_sum *)self)->owner);
    PyObject_Free(self);
    Py_DECREF(type);
}

PyObject *gis_py_sum_wrap(const gis_py_state *state, sunder_sum *sum)
{
    gis_py_sum *out = PyObject_New(gis_py_sum, state->sum);
    if (!out) {
        sunder_sum_free(sum);
        return NULL;
    }
    out->sum = out->owned = sum;
    out->owner = NULL;
    return (PyObject *)out;
}

PyObject *gis_py_sum_lend(const gis_py_state *state, const sunder_sum *sum, PyObject *owner)
{
    gis_py_sum *out = PyObject_New(gis_py_sum, state->sum);
    if (!out) return NULL;
    out->sum = sum;
    out->owned = NULL;
    out->owner = Py_NewRef(owner);
    return (PyObject *)out;
}

static const sunder_sum *sum_of(PyObject *self) { return ((gis_py_sum *)self)->sum; }

/* ---- Coordinates ------------------------------------------------------------------------------------------------- */

static PyObject *exact_vertex(PyObject *self, uint32_t vertex)
{
    char *x, *y;
    sunder_error why;
    if (sunder_sum_vertex_text(sum_of(self), vertex, &x, &y, &why) != SUNDER_OK)
        return gis_py_raise(gis_py_state_of_object(self), NULL, &why);
    PyObject *out = Py_BuildValue("ss", x, y);
    sunder_free(x);
    sunder_free(y);
    return out;
}

/* (x, y) as floats, or exact as texts. */
static PyObject *vertex_of(PyObject *self, uint32_t vertex, bool exact)
{
    double xy[2];
    if (exact) return exact_vertex(self, vertex);
    sunder_sum_vertex(sum_of(self), vertex, xy);
    return Py_BuildValue("dd", xy[0], xy[1]);
}

static PyObject *list_of_vertices(PyObject *self, const uint32_t *vertex, size_t n, bool exact)
{
    PyObject *out = PyList_New((Py_ssize_t)n);
    for (size_t k = 0; out && k < n; k++) {
        PyObject *one = vertex_of(self, vertex[k], exact);
        if (!one || PyList_SetItem(out, (Py_ssize_t)k, one) < 0) Py_CLEAR(out);
    }
    return out;
}

static PyObject *polygon_of(PyObject *self, size_t p, bool exact)
{
    const size_t rings = sunder_sum_rings(sum_of(self), p);
    PyObject *out = PyList_New((Py_ssize_t)rings);
    for (size_t r = 0; out && r < rings; r++) {
        size_t n;
        const uint32_t *vertex = sunder_sum_ring(sum_of(self), p, r, &n);
        PyObject *ring = list_of_vertices(self, vertex, n, exact);
        if (!ring || PyList_SetItem(out, (Py_ssize_t)r, ring) < 0) Py_CLEAR(out);
    }
    return out;
}

static PyObject *get_polygons(PyObject *self, PyObject *args)
{
    int exact;
    sunder_sum_size size;
    if (!PyArg_ParseTuple(args, "p", &exact)) return NULL;
    sunder_sum_get_size(sum_of(self), &size);
    PyObject *out = PyList_New((Py_ssize_t)size.polygons);
    for (size_t p = 0; out && p < size.polygons; p++) {
        PyObject *polygon = polygon_of(self, p, exact);
        if (!polygon || PyList_SetItem(out, (Py_ssize_t)p, polygon) < 0) Py_CLEAR(out);
    }
    return out;
}

static PyObject *get_segments(PyObject *self, PyObject *args)
{
    int exact;
    sunder_sum_size size;
    if (!PyArg_ParseTuple(args, "p", &exact)) return NULL;
    sunder_sum_get_size(sum_of(self), &size);
    PyObject *out = PyList_New((Py_ssize_t)size.degenerate_segments);
    for (size_t k = 0; out && k < size.degenerate_segments; k++) {
        uint32_t ends[2];
        sunder_sum_segment(sum_of(self), k, ends);
        PyObject *from = vertex_of(self, ends[0], exact), *to = from ? vertex_of(self, ends[1], exact) : NULL,
                 *one = to ? PyTuple_Pack(2, from, to) : NULL;
        Py_XDECREF(from);
        Py_XDECREF(to);
        if (!one || PyList_SetItem(out, (Py_ssize_t)k, one) < 0) Py_CLEAR(out);
    }
    return out;
}

static PyObject *get_points(PyObject *self, PyObject *args)
{
    int exact;
    sunder_sum_size size;
    if (!PyArg_ParseTuple(args, "p", &exact)) return NULL;
    sunder_sum_get_size(sum_of(self), &size);
    PyObject *out = PyList_New((Py_ssize_t)size.degenerate_points);
    for (size_t k = 0; out && k < size.degenerate_points; k++) {
        PyObject *one = vertex_of(self, sunder_sum_point(sum_of(self), k), exact);
        if (!one || PyList_SetItem(out, (Py_ssize_t)k, one) < 0) Py_CLEAR(out);
    }
    return out;
}

static PyObject *get_area(PyObject *self, PyObject *unused)
{
    char *text;
    sunder_error why;
    (void)unused;
    if (sunder_sum_area_text(sum_of(self), &text, &why) != SUNDER_OK)
        return gis_py_raise(gis_py_state_of_object(self), NULL, &why);
    PyObject *out = PyUnicode_FromString(text);
    sunder_free(text);
    return out;
}

static PyObject *get_size(PyObject *self, PyObject *unused)
{
    sunder_sum_size size;
    (void)unused;
    sunder_sum_get_size(sum_of(self), &size);
    return Py_BuildValue("nnnnn", (Py_ssize_t)size.polygons, (Py_ssize_t)size.holes, (Py_ssize_t)size.vertices,
                         (Py_ssize_t)size.degenerate_segments, (Py_ssize_t)size.degenerate_points);
}

/* ---- Rounded ----------------------------------------------------------------------------------------------------- */

typedef struct rounding {
    const sunder_sum *sum;
    gis_rounded out;
    gis_error error;
    bool done;
} rounding;

static void round_sum(void *of, gis_py_watch *watch)
{
    rounding *r = of;
    (void)watch;
    r->done = gis_round_sum(r->sum, &r->out, &r->error);
}

/* (wkb, deviation, mended): valid polygons in doubles, as the program writes them. */
static PyObject *get_rounded(PyObject *self, PyObject *args)
{
    int multi;
    rounding r = {.sum = sum_of(self)};
    if (!PyArg_ParseTuple(args, "p", &multi)) return NULL;
    if (!gis_py_run(round_sum, &r, Py_None, false) || !r.done) {
        gis_rounded_clear(&r.out);
        return gis_py_raise_gis(gis_py_state_of_object(self), NULL, &r.error);
    }
    const gis_polygons *set = &r.out.set;
    const bool several = multi || set->polygons != 1;
    PyObject *wkb = PyBytes_FromStringAndSize(
        NULL, (Py_ssize_t)gis_polygons_wkb_bytes(set->xy, set->ring_end, set->poly_end, set->polygons, several));
    PyObject *out = NULL;
    if (wkb) {
        gis_polygons_wkb_write(set->xy, set->ring_end, set->poly_end, set->polygons, several,
                               (unsigned char *)PyBytes_AsString(wkb));
        out = Py_BuildValue("Ndn", wkb, r.out.deviation, (Py_ssize_t)r.out.repaired);
    }
    gis_rounded_clear(&r.out);
    return out;
}

static PyMethodDef methods[] = {
    {"polygons", get_polygons, METH_VARARGS, "polygons(exact): a list of polygons, each a list of rings of (x, y)."},
    {"segments", get_segments, METH_VARARGS, "segments(exact): a list of ((x, y), (x, y))."},
    {"points", get_points, METH_VARARGS, "points(exact): a list of (x, y)."},
    {"area", get_area, METH_NOARGS, "The exact area as a text, num or num/den."},
    {"size", get_size, METH_NOARGS, "Numbers of polygons, holes, vertices, degenerate segments, degenerate points."},
    {"rounded", get_rounded, METH_VARARGS, "rounded(multi): (wkb, deviation, mended), valid polygons in doubles."},
    {NULL, NULL, 0, NULL},
};

static PyType_Slot slots[] = {
    {Py_tp_dealloc, GIS_PY_SLOT(free_sum)},
    {Py_tp_methods, methods},
    {Py_tp_doc, "An exact polygonal set."},
    {0, NULL},
};

PyType_Spec gis_py_sum_spec = {
    .name = "sunder._sunder.Sum",
    .basicsize = sizeof(gis_py_sum),
    .flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION,
    .slots = slots,
};

/* ---- Functions of the module ------------------------------------------------------------------------------------- */

/* The arguments and the result of one call of the core. */
typedef struct summing {
    const sunder_shape *p, *q;
    bool reflect, morphology;
    sunder_operation operation;
    unsigned threads;
    sunder_sum *out;
    sunder_error why;
    sunder_status status;
} summing;

static void make_sum(void *of, gis_py_watch *watch)
{
    summing *s = of;
    sunder_shape *reflected = NULL;
    sunder_sum_options how;
    sunder_sum_options_init(&how);
    how.progress = gis_py_progress;
    how.progress_user = watch;
    how.threads = s->threads;
    s->status = s->reflect ? sunder_shape_reflect(s->q, &reflected, &s->why) : SUNDER_OK;
    if (s->status != SUNDER_OK) return;
    const sunder_shape *q = reflected ? reflected : s->q;
    s->status = s->morphology ? sunder_morphology(s->p, q, s->operation, &how, &s->out, &s->why)
                              : sunder_minkowski_sum(s->p, q, &how, &s->out, &s->why);
    sunder_shape_free(reflected);
}

static PyObject *run_sum(PyObject *module, summing *s, PyObject *progress)
{
    const gis_py_state *state = gis_py_state_of(module);
    if (!gis_py_run(make_sum, s, progress, s->threads != 1)) {
        if (s->status == SUNDER_OK) sunder_sum_free(s->out);
        return NULL;
    }
    if (s->status != SUNDER_OK) return gis_py_raise(state, NULL, &s->why);
    return gis_py_sum_wrap(state, s->out);
}

/* minkowski_sum(p, q, reflect, progress) */
static PyObject *minkowski_sum(PyObject *module, PyObject *args)
{
    PyObject *p, *q, *progress;
    int reflect;
    if (!PyArg_ParseTuple(args, "OOpO", &p, &q, &reflect, &progress)) return NULL;
    const gis_py_state *state = gis_py_state_of(module);
    summing s = {.reflect = reflect, .threads = 1, .status = SUNDER_ECANCEL};
    if (!(s.p = gis_py_operand(state, p, "a")) || !(s.q = gis_py_operand(state, q, "b"))) return NULL;
    return run_sum(module, &s, progress);
}

/* morphology(p, b, operation, threads, progress) */
static PyObject *morphology(PyObject *module, PyObject *args)
{
    PyObject *p, *b, *progress;
    const char *operation;
    unsigned threads, found = 0;
    if (!PyArg_ParseTuple(args, "OOsIO", &p, &b, &operation, &threads, &progress)) return NULL;
    const gis_py_state *state = gis_py_state_of(module);
    summing s = {.morphology = true, .threads = threads, .status = SUNDER_ECANCEL};
    while (found <= SUNDER_OPERATION_CLOSE && strcmp(operation, sunder_operation_string((sunder_operation)found)) != 0)
        found++;
    if (found > SUNDER_OPERATION_CLOSE) {
        gis_py_wrong("operation", "\"%.50s\" is none of dilate, erode, open, close", operation);
        return NULL;
    }
    s.operation = (sunder_operation)found;
    if (!(s.p = gis_py_operand(state, p, "a")) || !(s.q = gis_py_operand(state, b, "b"))) return NULL;
    return run_sum(module, &s, progress);
}

PyMethodDef gis_py_sum_functions[] = {
    {"minkowski_sum", minkowski_sum, METH_VARARGS, "minkowski_sum(p, q, reflect, progress) -> Sum; reflect: p and -q."},
    {"morphology", morphology, METH_VARARGS, "morphology(p, b, operation, threads, progress) -> Sum."},
    {NULL, NULL, 0, NULL},
};
