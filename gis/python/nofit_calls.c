/* nofit_calls.c: no-fit polygons of many pairs of rotated parts in one call. */
#include "python/buffers.h"
#include "python/shapes_type.h"
#include "python/sum_type.h"
#include "python/watched_call.h"

#include <stdlib.h>

typedef struct nofit_call {
    const gis_py_shapes *parts;
    sunder_rotation *rotation;
    sunder_nofit *pair;
    size_t rotations, pairs;
    unsigned threads;
    sunder_nofits *out;
    sunder_status status;
    sunder_error why;
} nofit_call;

static void run_batch(void *of, gis_py_watch *watch)
{
    nofit_call *c = of;
    sunder_sum_options how;
    sunder_sum_options_init(&how);
    how.threads = c->threads;
    how.progress = gis_py_progress;
    how.progress_user = watch;
    c->status = sunder_nofit_batch((const sunder_shape *const *)c->parts->shape, c->parts->n, c->rotation, c->rotations,
                                   c->pair, c->pairs, &how, &c->out, &c->why);
}

/* Reads three numbers for each rotation, and four for each pair. */
static bool read_arguments(nofit_call *c, PyObject *rotations, PyObject *pairs)
{
    double *number = NULL;
    int64_t *index = NULL;
    size_t n;
    for (size_t i = 0; i < c->parts->n; i++)
        if (!c->parts->shape[i]) return gis_py_wrong("part", "number %zu has no polygons", i);
    if (!gis_py_doubles(rotations, "rotations", SIZE_MAX, &number, &n)) return false;
    c->rotations = n / 3;
    c->rotation = malloc((c->rotations + 1) * sizeof *c->rotation);
    for (size_t k = 0; c->rotation && k < c->rotations; k++)
        c->rotation[k] = (sunder_rotation){number[3 * k], number[3 * k + 1], number[3 * k + 2]};
    free(number);
    if (!gis_py_integers(pairs, "pairs", SIZE_MAX, &index, &n)) return false;
    c->pairs = n / 4;
    c->pair = malloc((c->pairs + 1) * sizeof *c->pair);
    bool done = c->pair && c->rotation;
    if (!done) PyErr_NoMemory();
    for (size_t k = 0; done && k < 4 * c->pairs; k++)
        if (index[k] < 0 || index[k] >= UINT32_MAX)
            done = gis_py_wrong("pairs", "pair %zu has the number %lld", k / 4, (long long)index[k]);
    for (size_t k = 0; done && k < c->pairs; k++)
        c->pair[k] = (sunder_nofit){(uint32_t)index[4 * k], (uint32_t)index[4 * k + 1], (uint32_t)index[4 * k + 2],
                                    (uint32_t)index[4 * k + 3]};
    free(index);
    return done;
}

static const char capsule_name[] = "sunder_nofits";

static void free_capsule(PyObject *capsule) { sunder_nofits_free(PyCapsule_GetPointer(capsule, capsule_name)); }

/* ([(sum, scale, exact), ...], the number of the result of each pair) */
static PyObject *report_nofits(const gis_py_state *state, nofit_call *c)
{
    void *numbers;
    PyObject *owner = PyCapsule_New(c->out, capsule_name, free_capsule);
    if (!owner) {
        sunder_nofits_free(c->out);
        return NULL;
    }
    const size_t n = sunder_nofits_distinct(c->out);
    PyObject *sums = PyList_New((Py_ssize_t)n), *of = sums ? gis_py_array("q", 8, c->pairs, 1, &numbers) : NULL;
    for (size_t k = 0; of && k < n; k++) {
        double scale;
        bool exact;
        const sunder_sum *sum = sunder_nofits_sum(c->out, k, &scale, &exact);
        PyObject *made = gis_py_sum_lend(state, sum, owner),
                 *one = made ? Py_BuildValue("NdO", made, scale, exact ? Py_True : Py_False) : NULL;
        if (!one || PyList_SetItem(sums, (Py_ssize_t)k, one) < 0) Py_CLEAR(of);
    }
    for (size_t i = 0; of && i < c->pairs; i++) ((int64_t *)numbers)[i] = (int64_t)sunder_nofits_result(c->out, i);
    Py_DECREF(owner);
    if (of) return Py_BuildValue("NN", sums, of);
    Py_XDECREF(sums);
    return NULL;
}

/* nofit_batch(parts, rotations, pairs, threads, progress) */
static PyObject *nofit_batch(PyObject *module, PyObject *args)
{
    PyObject *parts, *rotations, *pairs, *progress, *out = NULL;
    nofit_call c = {.status = SUNDER_ECANCEL};
    if (!PyArg_ParseTuple(args, "OOOIO", &parts, &rotations, &pairs, &c.threads, &progress)) return NULL;
    const gis_py_state *state = gis_py_state_of(module);
    c.parts = gis_py_shapes_of(state, parts);
    if (c.parts && read_arguments(&c, rotations, pairs)) {
        const bool ran = gis_py_run(run_batch, &c, progress, c.threads != 1);
        if (ran && c.status == SUNDER_OK)
            out = report_nofits(state, &c);
        else if (c.status == SUNDER_OK)
            sunder_nofits_free(c.out);
        else if (ran)
            gis_py_raise(state, NULL, &c.why);
    }
    free(c.rotation);
    free(c.pair);
    return out;
}

PyMethodDef gis_py_nofit_functions[] = {
    {"nofit_batch", nofit_batch, METH_VARARGS,
     "nofit_batch(parts, rotations, pairs, threads, progress) -> ([(Sum, scale, exact)], numbers of results)."},
    {NULL, NULL, 0, NULL},
};
