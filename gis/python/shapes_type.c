/* shapes_type.c: see shapes_type.h. As in the program, a set is read strictly first, so that a valid one is taken as it
 * is, and of an invalid one the place of the defect is known; only then is it taken by the even-odd rule. */
#include "python/shapes_type.h"

#include "geometry/polygons_wkb.h"
#include "python/shapes_out.h"
#include "python/watched_call.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void free_shapes(PyObject *self)
{
    gis_py_shapes *shapes = (gis_py_shapes *)self;
    for (size_t i = 0; i < shapes->n; i++) {
        if (shapes->shape) sunder_shape_free(shapes->shape[i]);
        if (shapes->reason) free(shapes->reason[i]);
    }
    free(shapes->shape);
    free(shapes->mended);
    free(shapes->reason);
    gis_py_features_clear(&shapes->features);
    PyTypeObject *type = Py_TYPE(self);
    PyObject_Free(self);
    Py_DECREF(type);
}

/* A new object with room for n shapes, all NULL. */
static gis_py_shapes *allocate(const gis_py_state *state, size_t n)
{
    gis_py_shapes *out = PyObject_New(gis_py_shapes, state->shapes);
    if (!out) return NULL;
    out->n = n;
    out->features = (gis_py_features){0};
    out->shape = calloc(n + 1, sizeof *out->shape);
    out->mended = calloc(n + 1, 1);
    out->reason = calloc(n + 1, sizeof *out->reason);
    if (out->shape && out->mended && out->reason) return out;
    Py_DECREF(out);
    PyErr_NoMemory();
    return NULL;
}

PyObject *gis_py_shapes_wrap(const gis_py_state *state, sunder_shape **shape, size_t n)
{
    gis_py_shapes *out = allocate(state, n);
    for (size_t i = 0; i < n; i++) {
        if (out)
            out->shape[i] = shape[i];
        else
            sunder_shape_free(shape[i]);
    }
    return (PyObject *)out;
}

/* ---- From features ----------------------------------------------------------------------------------------------- */

typedef struct making {
    gis_py_shapes *out;
    gis_py_invalid policy;
    size_t at; /* the feature at fault */
    sunder_error why;
    bool failed;
    size_t *ring_end, *poly_end; /* buffers for the ends of one feature */
    size_t ring_room, poly_room;
} making;

static bool reserve(size_t **array, size_t *room, size_t n)
{
    if (n <= *room) return true;
    size_t *larger = realloc(*array, (n + n / 2) * sizeof **array);
    if (!larger) return false;
    *array = larger;
    *room = n + n / 2;
    return true;
}

/* The polygons first ... last - 1 of the set as arrays that begin with 0. */
static bool extract(making *m, const gis_polygons *set, size_t first, size_t last, const double **xy)
{
    const size_t ring = first ? set->poly_end[first - 1] : 0, rings = set->poly_end[last - 1] - ring,
                 vertex = ring ? set->ring_end[ring - 1] : 0;
    if (!reserve(&m->ring_end, &m->ring_room, rings) || !reserve(&m->poly_end, &m->poly_room, last - first))
        return false;
    for (size_t r = 0; r < rings; r++) m->ring_end[r] = set->ring_end[ring + r] - vertex;
    for (size_t p = first; p < last; p++) m->poly_end[p - first] = set->poly_end[p] - ring;
    *xy = set->xy + 2 * vertex;
    return true;
}

static bool make_shape(making *m, size_t i, const gis_polygons *set, size_t first, size_t last)
{
    const double *xy;
    m->at = i;
    m->why = (sunder_error){.status = SUNDER_ENOMEM};
    if (!extract(m, set, first, last, &xy)) return false;
    sunder_status status = sunder_shape_from_rings(xy, m->ring_end, m->poly_end, last - first, SUNDER_VALIDITY_STRICT,
                                                   &m->out->shape[i], &m->why);
    if (status != SUNDER_EINVALID || m->policy == GIS_PY_FAIL) return status == SUNDER_OK;
    m->out->reason[i] = strdup(m->why.message);
    m->out->mended[i] = m->policy == GIS_PY_SKIP ? 2 : 1;
    return m->policy == GIS_PY_SKIP ||
           sunder_shape_from_rings(xy, m->ring_end, m->poly_end, last - first, SUNDER_VALIDITY_EVEN_ODD,
                                   &m->out->shape[i], &m->why) == SUNDER_OK;
}

static void make_all(void *of, gis_py_watch *watch)
{
    making *m = of;
    const gis_py_features *from = &m->out->features;
    (void)watch;
    for (size_t i = 0, first = 0; !m->failed && i < from->n; first = from->area_end[i++])
        if (from->area_end[i] > first) m->failed = !make_shape(m, i, &from->areas, first, from->area_end[i]);
}

PyObject *gis_py_shapes_new(const gis_py_state *state, gis_py_features *from, gis_py_invalid policy, const char *who,
                            bool numbered)
{
    making m = {.out = allocate(state, from->n), .policy = policy};
    if (!m.out) {
        gis_py_features_clear(from);
        return NULL;
    }
    m.out->features = *from;
    *from = (gis_py_features){0};
    const bool ran = gis_py_run(make_all, &m, Py_None, false);
    free(m.ring_end);
    free(m.poly_end);
    gis_polygons_clear(&m.out->features.areas);
    if (ran && !m.failed) return (PyObject *)m.out;
    char name[100];
    snprintf(name, sizeof name, "%s %zu", who, m.at);
    Py_DECREF(m.out);
    return gis_py_raise(state, numbered ? name : who, &m.why);
}

/* ---- Getters ----------------------------------------------------------------------------------------------------- */

gis_py_shapes *gis_py_shapes_of(const gis_py_state *state, PyObject *object)
{
    if (Py_TYPE(object) == state->shapes) return (gis_py_shapes *)object;
    PyErr_SetString(PyExc_TypeError, "Shapes are needed");
    return NULL;
}

const sunder_shape *gis_py_operand(const gis_py_state *state, PyObject *object, const char *who)
{
    const gis_py_shapes *shapes = gis_py_shapes_of(state, object);
    if (!shapes) return NULL;
    if (shapes->n == 1 && shapes->shape[0]) return shapes->shape[0];
    if (shapes->n != 1)
        gis_py_wrong(who, "%zu geometries; one is needed", shapes->n);
    else
        gis_py_wrong(who, "no polygons");
    return NULL;
}

static Py_ssize_t length_of(PyObject *self) { return (Py_ssize_t)((gis_py_shapes *)self)->n; }

static PyObject *get_areas(PyObject *self, PyObject *unused)
{
    const gis_py_shapes *shapes = (gis_py_shapes *)self;
    void *data;
    (void)unused;
    PyObject *out = gis_py_array("d", sizeof(double), shapes->n, 1, &data);
    for (size_t i = 0; out && i < shapes->n; i++) {
        const double area = shapes->shape[i] ? sunder_shape_area(shapes->shape[i]) : 0;
        memcpy((char *)data + i * sizeof area, &area, sizeof area);
    }
    return out;
}

static PyObject *get_boxes(PyObject *self, PyObject *unused)
{
    const gis_py_shapes *shapes = (gis_py_shapes *)self;
    void *data;
    (void)unused;
    PyObject *out = gis_py_array("d", sizeof(double), shapes->n, 4, &data);
    for (size_t i = 0; out && i < shapes->n; i++) {
        double box[4] = {0};
        if (shapes->shape[i]) sunder_shape_box(shapes->shape[i], box);
        memcpy((char *)data + i * sizeof box, box, sizeof box);
    }
    return out;
}

/* A list of (number, reason, skipped) of the geometries that were invalid. */
static PyObject *get_invalid(PyObject *self, PyObject *unused)
{
    const gis_py_shapes *shapes = (gis_py_shapes *)self;
    (void)unused;
    PyObject *out = PyList_New(0);
    for (size_t i = 0; out && i < shapes->n; i++) {
        if (!shapes->mended[i]) continue;
        PyObject *one = Py_BuildValue("nsO", (Py_ssize_t)i, shapes->reason[i] ? shapes->reason[i] : "",
                                      shapes->mended[i] == 2 ? Py_True : Py_False);
        if (!one || PyList_Append(out, one) < 0) Py_CLEAR(out);
        Py_XDECREF(one);
    }
    return out;
}

/* What each geometry holds: 0 nothing, 1 polygons, 2 lines, 3 points. */
static PyObject *get_contents(PyObject *self, PyObject *unused)
{
    const gis_py_shapes *shapes = (gis_py_shapes *)self;
    void *data;
    (void)unused;
    PyObject *out = gis_py_array("B", 1, shapes->n, 1, &data);
    for (size_t i = 0; out && i < shapes->n; i++)
        ((unsigned char *)data)[i] = shapes->features.n == shapes->n
                                         ? (unsigned char)gis_py_features_content(&shapes->features, i)
                                         : (shapes->shape[i] ? GIS_PY_POLYGONS : GIS_PY_NOTHING);
    return out;
}

/* The first point of geometry i, or the smallest of several by x, then y; None if it has none. */
static PyObject *get_point(PyObject *self, PyObject *args)
{
    const gis_py_shapes *shapes = (gis_py_shapes *)self;
    Py_ssize_t i;
    if (!PyArg_ParseTuple(args, "n", &i)) return NULL;
    if (i < 0 || (size_t)i >= shapes->features.n || !shapes->features.points[i]) Py_RETURN_NONE;
    const gis_polygons *lines = &shapes->features.lines;
    const double *least = NULL;
    for (size_t k = i ? shapes->features.line_end[i - 1] : 0; k < shapes->features.line_end[i]; k++) {
        const double *xy = lines->xy + 2 * (lines->ring_end[k] - 1);
        if (!least || xy[0] < least[0] || (xy[0] == least[0] && xy[1] < least[1])) least = xy;
    }
    return Py_BuildValue("dd", least[0], least[1]);
}

/* The well-known binary of shape i as it was given, moved: each coordinate is the double nearest to x + dx. */
static PyObject *get_wkb(PyObject *self, PyObject *args)
{
    const gis_py_shapes *shapes = (gis_py_shapes *)self;
    Py_ssize_t i;
    if (!PyArg_ParseTuple(args, "n", &i)) return NULL;
    if (i < 0 || (size_t)i >= shapes->n) return PyErr_Format(PyExc_IndexError, "there is no shape %zd", i);
    const double *xy = NULL;
    const size_t *ring_end = NULL, *poly_end = NULL,
                 polygons = shapes->shape[i] ? sunder_shape_given(shapes->shape[i], &xy, &ring_end, &poly_end) : 0;
    const bool multi = polygons != 1;
    PyObject *out =
        PyBytes_FromStringAndSize(NULL, (Py_ssize_t)gis_polygons_wkb_bytes(xy, ring_end, poly_end, polygons, multi));
    if (out) gis_polygons_wkb_write(xy, ring_end, poly_end, polygons, multi, (unsigned char *)PyBytes_AsString(out));
    return out;
}

static PyMethodDef methods[] = {
    {"areas", get_areas, METH_NOARGS, "Areas, (n,) float64; 0 where there are no polygons."},
    {"boxes", get_boxes, METH_NOARGS, "Boxes xmin, ymin, xmax, ymax, (n, 4) float64."},
    {"invalid", get_invalid, METH_NOARGS, "List of (number, reason, skipped) of what was invalid."},
    {"contents", get_contents, METH_NOARGS, "(n,) uint8: 0 nothing, 1 polygons, 2 lines, 3 points."},
    {"point", get_point, METH_VARARGS, "point(i): the smallest point of geometry i by x, then y, or None."},
    {"ragged", gis_py_shapes_ragged, METH_NOARGS, "Coordinates, and offsets of rings, polygons and geometries."},
    {"moved", gis_py_shapes_moved, METH_VARARGS, "moved(moves) -> Shapes: moves are (n, 2) float64."},
    {"wkb", get_wkb, METH_VARARGS, "wkb(i): the polygons of geometry i as they were given, as well-known binary."},
    {NULL, NULL, 0, NULL},
};

static PyType_Slot slots[] = {
    {Py_tp_dealloc, GIS_PY_SLOT(free_shapes)},
    {Py_tp_methods, methods},
    {Py_sq_length, GIS_PY_SLOT(length_of)},
    {Py_tp_doc, "Polygonal sets, read once and used in several calls; made by sunder.Shapes()."},
    {0, NULL},
};

PyType_Spec gis_py_shapes_spec = {
    .name = "sunder._sunder.Shapes",
    .basicsize = sizeof(gis_py_shapes),
    .flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION,
    .slots = slots,
};

/* ---- Functions of the module ------------------------------------------------------------------------------------- */

static bool find_policy(const char *word, gis_py_invalid *policy)
{
    static const char *const words[] = {"repair", "skip", "fail"};
    for (unsigned k = 0; k < 3; k++)
        if (strcmp(word, words[k]) == 0) {
            *policy = (gis_py_invalid)k;
            return true;
        }
    return gis_py_wrong("invalid", "\"%.50s\" is none of repair, skip, fail", word);
}

/* read(geometry, who, invalid): one geometry. */
static PyObject *read_one(PyObject *module, PyObject *args)
{
    PyObject *geometry;
    const char *who, *word;
    gis_py_invalid policy = GIS_PY_REPAIR;
    gis_py_features features = {0};
    if (!PyArg_ParseTuple(args, "Oss", &geometry, &who, &word) || !find_policy(word, &policy)) return NULL;
    if (gis_py_features_add(&features, geometry, who))
        return gis_py_shapes_new(gis_py_state_of(module), &features, policy, who, false);
    gis_py_features_clear(&features);
    return NULL;
}

/* read_all(geometries, who, invalid) */
static PyObject *read_all(PyObject *module, PyObject *args)
{
    PyObject *geometries;
    const char *who, *word;
    gis_py_invalid policy = GIS_PY_REPAIR;
    gis_py_features features = {0};
    if (!PyArg_ParseTuple(args, "Oss", &geometries, &who, &word) || !find_policy(word, &policy)) return NULL;
    if (gis_py_features_add_all(&features, geometries, who))
        return gis_py_shapes_new(gis_py_state_of(module), &features, policy, who, true);
    gis_py_features_clear(&features);
    return NULL;
}

/* read_ragged(coordinates, ring_offsets, polygon_offsets, geometry_offsets, who, invalid) */
static PyObject *read_ragged(PyObject *module, PyObject *args)
{
    PyObject *coordinates, *rings, *polygons, *geometries;
    const char *who, *word;
    gis_py_invalid policy = GIS_PY_REPAIR;
    gis_py_features features = {0};
    if (!PyArg_ParseTuple(args, "OOOOss", &coordinates, &rings, &polygons, &geometries, &who, &word) ||
        !find_policy(word, &policy))
        return NULL;
    if (gis_py_features_add_ragged(&features, coordinates, rings, polygons, geometries, who))
        return gis_py_shapes_new(gis_py_state_of(module), &features, policy, who, true);
    gis_py_features_clear(&features);
    return NULL;
}

/* disc(radius, segments, inside), rectangle(width, height) */
static PyObject *make_disc(PyObject *module, PyObject *args)
{
    double radius;
    unsigned segments;
    int inside;
    sunder_shape *shape;
    sunder_error why;
    if (!PyArg_ParseTuple(args, "dIp", &radius, &segments, &inside)) return NULL;
    if (sunder_shape_disc(radius, segments, inside, &shape, &why) != SUNDER_OK)
        return gis_py_raise(gis_py_state_of(module), "disc", &why);
    return gis_py_shapes_wrap(gis_py_state_of(module), &shape, 1);
}

static PyObject *make_rectangle(PyObject *module, PyObject *args)
{
    double width, height;
    sunder_shape *shape;
    sunder_error why;
    if (!PyArg_ParseTuple(args, "dd", &width, &height)) return NULL;
    if (sunder_shape_rectangle(width, height, &shape, &why) != SUNDER_OK)
        return gis_py_raise(gis_py_state_of(module), "rectangle", &why);
    return gis_py_shapes_wrap(gis_py_state_of(module), &shape, 1);
}

/* move_wkb(bytes, dx, dy): well-known binary with (dx, dy) added to each x and y. */
static PyObject *move_wkb(PyObject *module, PyObject *args)
{
    const char *bytes;
    Py_ssize_t n;
    double dx, dy;
    (void)module;
    if (!PyArg_ParseTuple(args, "y#dd", &bytes, &n, &dx, &dy)) return NULL;
    gis_py_features taken = {0};
    const bool valid = gis_py_wkb_add(&taken, (const unsigned char *)bytes, (size_t)n, "geometry");
    gis_py_features_clear(&taken);
    PyObject *out = valid ? PyBytes_FromStringAndSize(bytes, n) : NULL;
    if (out) gis_py_wkb_move((unsigned char *)PyBytes_AsString(out), (size_t)n, dx, dy);
    return out;
}

PyMethodDef gis_py_shape_functions[] = {
    {"read", read_one, METH_VARARGS, "read(geometry, who, invalid) -> Shapes of one item."},
    {"read_all", read_all, METH_VARARGS, "read_all(geometries, who, invalid) -> Shapes."},
    {"read_ragged", read_ragged, METH_VARARGS,
     "read_ragged(coordinates, ring_offsets, polygon_offsets, geometry_offsets, who, invalid) -> Shapes."},
    {"disc", make_disc, METH_VARARGS, "disc(radius, segments, inside) -> Shapes of one item."},
    {"rectangle", make_rectangle, METH_VARARGS, "rectangle(width, height) -> Shapes of one item."},
    {"move_wkb", move_wkb, METH_VARARGS, "move_wkb(wkb, dx, dy) -> bytes: x + dx and y + dy, the nearest doubles."},
    {NULL, NULL, 0, NULL},
};
