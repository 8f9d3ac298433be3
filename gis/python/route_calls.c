/* route_calls.c: the shortest route of a robot among obstacles. */
#include "python/obstacles.h"
#include "python/watched_call.h"

typedef struct routing {
    const gis_py_obstacles *obstacles;
    const sunder_shape *robot;
    sunder_place from, to;
    double gap;
    sunder_route *out;
    sunder_status status;
    sunder_error why;
} routing;

static void find_route(void *of, gis_py_watch *watch)
{
    routing *r = of;
    sunder_route_options how;
    sunder_route_options_init(&how);
    how.gap = r->gap;
    how.progress = gis_py_progress;
    how.progress_user = watch;
    r->status =
        sunder_route_find(r->obstacles->obstacle, r->obstacles->n, r->robot, &r->from, &r->to, &how, &r->out, &r->why);
}

/* A list of (x, y), exact as texts or rounded. */
static PyObject *list_path(const sunder_route *route, bool exact)
{
    const size_t n = sunder_route_vertices(route);
    PyObject *out = PyList_New((Py_ssize_t)n);
    for (size_t k = 0; out && k < n; k++) {
        const char *x, *y;
        double xy[2];
        sunder_route_vertex(route, k, xy);
        sunder_route_vertex_text(route, k, &x, &y);
        PyObject *one = exact ? Py_BuildValue("ss", x, y) : Py_BuildValue("dd", xy[0], xy[1]);
        if (!one || PyList_SetItem(out, (Py_ssize_t)k, one) < 0) Py_CLEAR(out);
    }
    return out;
}

static PyObject *report_route(const sunder_route *route)
{
    size_t obstacle;
    const sunder_route_status reason = sunder_route_reason(route, &obstacle);
    PyObject *rounded = list_path(route, false), *exact = rounded ? list_path(route, true) : NULL;
    if (!exact) {
        Py_XDECREF(rounded);
        return NULL;
    }
    return Py_BuildValue("sdNNOn", sunder_route_status_string(reason), sunder_route_length(route), rounded, exact,
                         sunder_route_rounded_is_free(route) ? Py_True : Py_False,
                         obstacle == SIZE_MAX ? (Py_ssize_t)-1 : (Py_ssize_t)obstacle);
}

/* route(obstacles, robot, (x, y), (x, y), gap, progress): coordinates are texts of rationals -> (reason, length, path,
 * exact path, rounded_is_free, obstacle or -1) */
static PyObject *route(PyObject *module, PyObject *args)
{
    PyObject *obstacles, *robot, *progress, *out = NULL;
    routing r = {.status = SUNDER_ECANCEL};
    gis_py_obstacles held;
    if (!PyArg_ParseTuple(args, "OO(ss)(ss)dO", &obstacles, &robot, &r.from.text[0], &r.from.text[1], &r.to.text[0],
                          &r.to.text[1], &r.gap, &progress))
        return NULL;
    const gis_py_state *state = gis_py_state_of(module);
    const gis_py_shapes *shapes = gis_py_shapes_of(state, obstacles);
    if (!shapes || !(r.robot = gis_py_operand(state, robot, "robot")) || !gis_py_obstacles_make(shapes, false, &held))
        return NULL;
    r.obstacles = &held;
    const bool ran = gis_py_run(find_route, &r, progress, false);
    if (ran && r.status == SUNDER_OK)
        out = report_route(r.out);
    else if (ran)
        gis_py_raise(state, NULL, &r.why);
    if (r.status == SUNDER_OK) sunder_route_free(r.out);
    gis_py_obstacles_clear(&held);
    return out;
}

PyMethodDef gis_py_route_functions[] = {
    {"route", route, METH_VARARGS,
     "route(obstacles, robot, start, goal, gap, progress) -> (reason, length, path, exact path, free, obstacle)."},
    {NULL, NULL, 0, NULL},
};
