/* shapes_out.c: see shapes_out.h. The arrays are those that GeoArrow and Shapely use for multipolygons: offsets begin
 * with 0 and have one value more than there are items, and rings are closed. */
#include "python/shapes_out.h"

#include "python/buffers.h"

#include <stdlib.h>
#include <string.h>

/* The places of the arrays, and how far they are filled. */
typedef struct arrays {
    double *xy;
    int64_t *ring, *polygon, *geometry;
    size_t vertices, rings, polygons;
} arrays;

/* Is the ring's last vertex a copy of its first? */
static bool is_closed(const double *xy, size_t n) { return n > 1 && memcmp(xy, xy + 2 * (n - 1), 2 * sizeof *xy) == 0; }

/* Adds the rings of a shape; xy == NULL: they are only counted. */
static void add_shape(const sunder_shape *shape, arrays *to)
{
    const double *xy = NULL;
    const size_t *ring_end = NULL, *poly_end = NULL,
                 polygons = shape ? sunder_shape_given(shape, &xy, &ring_end, &poly_end) : 0;
    for (size_t p = 0, r = 0; p < polygons; p++) {
        for (; r < poly_end[p]; r++) {
            const size_t first = r ? ring_end[r - 1] : 0, n = ring_end[r] - first,
                         open = n && !is_closed(xy + 2 * first, n);
            if (to->xy && n > 0) {
                memcpy(to->xy + 2 * to->vertices, xy + 2 * first, 2 * n * sizeof *xy);
                memcpy(to->xy + 2 * (to->vertices + n), xy + 2 * first, open * 2 * sizeof *xy);
            }
            to->vertices += n + open;
            to->rings++;
            if (to->xy) to->ring[to->rings] = (int64_t)to->vertices;
        }
        to->polygons++;
        if (to->xy) to->polygon[to->polygons] = (int64_t)to->rings;
    }
}

PyObject *gis_py_shapes_ragged(PyObject *self, PyObject *unused)
{
    const gis_py_shapes *shapes = (gis_py_shapes *)self;
    arrays need = {0}, to = {0};
    void *data[4];
    (void)unused;
    for (size_t i = 0; i < shapes->n; i++) add_shape(shapes->shape[i], &need);
    PyObject *xy = gis_py_array("d", sizeof(double), need.vertices, 2, &data[0]),
             *ring = xy ? gis_py_array("q", 8, need.rings + 1, 1, &data[1]) : NULL,
             *polygon = ring ? gis_py_array("q", 8, need.polygons + 1, 1, &data[2]) : NULL,
             *geometry = polygon ? gis_py_array("q", 8, shapes->n + 1, 1, &data[3]) : NULL;
    if (!geometry) {
        Py_XDECREF(xy);
        Py_XDECREF(ring);
        Py_XDECREF(polygon);
        return NULL;
    }
    to = (arrays){.xy = data[0], .ring = data[1], .polygon = data[2], .geometry = data[3]};
    to.ring[0] = to.polygon[0] = to.geometry[0] = 0;
    for (size_t i = 0; i < shapes->n; i++) {
        add_shape(shapes->shape[i], &to);
        to.geometry[i + 1] = (int64_t)to.polygons;
    }
    return Py_BuildValue("NNNN", xy, ring, polygon, geometry);
}

PyObject *gis_py_shapes_moved(PyObject *self, PyObject *args)
{
    const gis_py_shapes *shapes = (gis_py_shapes *)self;
    const gis_py_state *state = gis_py_state_of_object(self);
    PyObject *moves;
    double *move;
    size_t n, made = 0;
    sunder_error why;
    if (!PyArg_ParseTuple(args, "O", &moves) || !gis_py_coordinates(moves, "moves", true, &move, &n)) return NULL;
    sunder_shape **shape = calloc(shapes->n + 1, sizeof *shape);
    bool done = n == shapes->n || gis_py_wrong("moves", "%zu of them; %zu are needed", n, shapes->n);
    if (done && !shape) {
        PyErr_NoMemory();
        done = false;
    }
    for (; done && made < n; made++) {
        bool exact;
        if (!shapes->shape[made]) continue;
        if (sunder_shape_translate(shapes->shape[made], move[2 * made], move[2 * made + 1], &shape[made], &exact,
                                   &why) == SUNDER_OK)
            continue;
        gis_py_raise(state, "moves", &why);
        done = false;
        break;
    }
    PyObject *out = done ? gis_py_shapes_wrap(state, shape, n) : NULL;
    for (size_t k = 0; !done && shape && k < made; k++) sunder_shape_free(shape[k]);
    free(shape);
    free(move);
    return out;
}
