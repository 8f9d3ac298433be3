/* layer_calls.c: separates or checks a whole layer. The arrays of demands have a value for each feature; options come
 * as a dict with the names of sunder_layer_options. */
#include "python/layer_calls.h"

#include "python/buffers.h"
#include "python/near_barriers.h"
#include "python/obstacles.h"
#include "python/watched_call.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* ---- Options ----------------------------------------------------------------------------------------------------- */

typedef enum kind { REAL, TRUTH, WHOLE, WORDS } kind;

/* A member of sunder_layer_options that a dict may set. */
typedef struct option {
    const char *name;
    size_t at;
    kind of;
} option;

#define OPTION(name) #name, offsetof(sunder_layer_options, name)

static const option options_known[] = {
    {OPTION(gap), REAL},
    {OPTION(touch_tolerance), REAL},
    {OPTION(no_blocks), TRUTH},
    {OPTION(no_touch), TRUTH},
    {OPTION(list_inside), TRUTH},
    {OPTION(allow_jumps), TRUTH},
    {OPTION(effort), REAL},
    {OPTION(barrier_reach), REAL},
    {OPTION(kink), REAL},
    {OPTION(ease), REAL},
    {OPTION(full_gap), REAL},
    {OPTION(threads), WHOLE},
    {"seed", offsetof(sunder_layer_options, seed), WORDS},
};

static bool set_option(const option *known, PyObject *value, sunder_layer_options *to)
{
    char *at = (char *)to + known->at;
    double real;
    unsigned long long whole;
    switch (known->of) {
    case REAL:
        real = PyFloat_AsDouble(value);
        if (!PyErr_Occurred()) memcpy(at, &real, sizeof real);
        break;
    case TRUTH: *(bool *)at = PyObject_IsTrue(value) == 1; break;
    case WHOLE:
    case WORDS:
        whole = PyLong_AsUnsignedLongLong(value);
        if (PyErr_Occurred() || (known->of == WHOLE && whole > 64)) {
            PyErr_Clear();
            return gis_py_wrong(known->name, "not an integer from 0 to %s", known->of == WHOLE ? "64" : "2^64 - 1");
        }
        if (known->of == WHOLE)
            *(unsigned *)(void *)at = (unsigned)whole;
        else
            *(uint64_t *)(void *)at = whole;
        break;
    }
    if (!PyErr_Occurred()) return true;
    PyErr_Clear();
    return gis_py_wrong(known->name, "not a number");
}

static bool set_words(PyObject *dict, sunder_layer_options *to)
{
    PyObject *contained = PyDict_GetItemString(dict, "contained"), *rows = PyDict_GetItemString(dict, "rows"),
             *stiffness = PyDict_GetItemString(dict, "row_stiffness");
    const char *word = contained ? PyUnicode_AsUTF8AndSize(contained, NULL) : "block";
    unsigned found = 0;
    if (!word) return false;
    while (found <= SUNDER_CONTAINMENT_SEPARATE &&
           strcmp(word, sunder_containment_string((sunder_containment)found)) != 0)
        found++;
    if (found > SUNDER_CONTAINMENT_SEPARATE)
        return gis_py_wrong("contained", "\"%.50s\" is none of block, ignore, separate", word);
    to->contained = (sunder_containment)found;
    const long how = rows ? PyLong_AsLong(rows) : 0;
    to->rows = how == 1 ? SUNDER_ROWS_FOUND : how == 2 ? SUNDER_ROWS_GIVEN : SUNDER_ROWS_NONE;
    double *pair = NULL;
    size_t n;
    if (!stiffness) return !PyErr_Occurred();
    if (!gis_py_doubles(stiffness, "row_stiffness", 2, &pair, &n)) return false;
    memcpy(to->row_stiffness, pair, sizeof to->row_stiffness);
    free(pair);
    return true;
}

static bool read_options(PyObject *dict, sunder_layer_options *to)
{
    sunder_layer_options_init(to);
    for (size_t k = 0; k < sizeof options_known / sizeof *options_known; k++) {
        PyObject *value = PyDict_GetItemString(dict, options_known[k].name);
        if (value && !set_option(&options_known[k], value, to)) return false;
    }
    to->drop_proofs = true;
    return set_words(dict, to);
}

/* ---- Features ---------------------------------------------------------------------------------------------------- */

/* Everything that a call holds. */
typedef struct call {
    const gis_py_shapes *shapes;
    sunder_feature *feature;
    int64_t *row;            /* NULL: none are given */
    double *anchor, *prefer; /* NULL: none */
    sunder_barrier *barrier;
    double *distance; /* [barriers] */
    int64_t *number;  /* [barriers] the number of each among all that were given */
    size_t barriers;
    gis_py_obstacles *obstacles; /* [sets] */
    size_t sets;
    sunder_layer_options options;
    bool check;
    sunder_report *report;
    sunder_status status;
    sunder_error why;
} call;

enum { FIXED = 1, IGNORED = 2 };

/* Reads an array of the dict, of one or more values for each feature; NULL where it is missing. */
static bool read_reals(PyObject *dict, const char *name, size_t n, double **out)
{
    PyObject *value = PyDict_GetItemString(dict, name);
    *out = NULL;
    return !value || value == Py_None || gis_py_doubles(value, name, n, out, &n);
}

static bool read_wholes(PyObject *dict, const char *name, size_t n, int64_t **out)
{
    PyObject *value = PyDict_GetItemString(dict, name);
    *out = NULL;
    return !value || value == Py_None || gis_py_integers(value, name, n, out, &n);
}

static bool check_demand(const sunder_feature *feature, size_t i)
{
    if (!(feature->weight >= SUNDER_LEAST_WEIGHT && feature->weight <= SUNDER_GREATEST_WEIGHT))
        return gis_py_wrong("weight", "that of geometry %zu is not a number from 1e-100 to 1e100", i);
    return feature->max_shift >= 0 || gis_py_wrong("max_shift", "that of geometry %zu is not a number, 0 or more", i);
}

static bool make_features(call *c, PyObject *demands)
{
    const size_t n = c->shapes->n;
    double *weight = NULL, *limit = NULL;
    int64_t *flags = NULL, *block = NULL;
    c->feature = calloc(n + 1, sizeof *c->feature);
    if (!c->feature) PyErr_NoMemory();
    bool done = c->feature && read_reals(demands, "weight", n, &weight) &&
                read_reals(demands, "max_shift", n, &limit) && read_wholes(demands, "flags", n, &flags) &&
                read_wholes(demands, "blocks", n, &block) && read_wholes(demands, "rows", n, &c->row) &&
                read_reals(demands, "anchors", 2 * n, &c->anchor) && read_reals(demands, "prefer", 2 * n, &c->prefer);
    for (size_t i = 0; done && i < n; i++) {
        const sunder_shape *shape = c->shapes->shape[i];
        c->feature[i] = (sunder_feature){
            .shape = shape,
            .weight = weight ? weight[i] : 1,
            .max_shift = limit ? limit[i] : INFINITY,
            .block = block ? block[i] : -1,
            .fixed = flags && (flags[i] & FIXED),
            .ignored = !shape || sunder_shape_is_empty(shape) || (flags && (flags[i] & IGNORED)),
        };
        if (c->feature[i].ignored) c->feature[i].weight = 1; /* not used; it may be anything */
        done = check_demand(&c->feature[i], i);
    }
    free(weight);
    free(limit);
    free(flags);
    free(block);
    return done;
}

/* ---- Barriers ---------------------------------------------------------------------------------------------------- */

/* Fills barriers of one set: (shapes, widths, gap, full_gap, distance, side, boundary); `to` and `distance` have room.
 * The distance is what features keep, the layer's gap included. */
static bool fill_set(const gis_py_state *state, PyObject *set, gis_py_obstacles *held, sunder_barrier *to,
                     double *distance)
{
    PyObject *object, *widths;
    double gap, full_gap, kept, *width;
    int side, boundary;
    size_t n;
    if (!PyArg_ParseTuple(set, "OOdddpp", &object, &widths, &gap, &full_gap, &kept, &side, &boundary)) return false;
    const gis_py_shapes *shapes = gis_py_shapes_of(state, object);
    if (!shapes || !gis_py_doubles(widths, "barrier: width", shapes->n, &width, &n)) return false;
    const bool done = gis_py_obstacles_make(shapes, boundary, held);
    for (size_t k = 0; done && k < n; k++) distance[k] = kept;
    for (size_t k = 0; done && k < n; k++)
        to[k] = (sunder_barrier){.geometry = held->obstacle[k],
                                 .width = width[k] > 0 ? width[k] : 0,
                                 .gap = gap,
                                 .full_gap = full_gap,
                                 .side = side};
    free(width);
    return done;
}

/* The number of geometries of all sets; -1: an exception is set. */
static Py_ssize_t count_barriers(const gis_py_state *state, PyObject *sets)
{
    Py_ssize_t sum = 0;
    for (Py_ssize_t k = 0; k < PyList_Size(sets); k++) {
        PyObject *set = PyList_GetItem(sets, k);
        const gis_py_shapes *shapes =
            PyTuple_Check(set) && PyTuple_Size(set) > 0 ? gis_py_shapes_of(state, PyTuple_GetItem(set, 0)) : NULL;
        if (!shapes) return -1;
        sum += (Py_ssize_t)shapes->n;
    }
    return sum;
}

static bool make_barriers(const gis_py_state *state, call *c, PyObject *sets)
{
    const Py_ssize_t all = count_barriers(state, sets);
    if (all < 0) return false;
    c->sets = (size_t)PyList_Size(sets);
    c->barrier = calloc((size_t)all + 1, sizeof *c->barrier);
    c->obstacles = calloc(c->sets + 1, sizeof *c->obstacles);
    c->distance = calloc((size_t)all + 1, sizeof *c->distance);
    c->number = calloc((size_t)all + 1, sizeof *c->number);
    if (!c->barrier || !c->obstacles || !c->distance || !c->number) {
        PyErr_NoMemory();
        return false;
    }
    for (size_t k = 0; k < c->sets; k++) {
        PyObject *set = PyList_GetItem(sets, (Py_ssize_t)k);
        if (!fill_set(state, set, &c->obstacles[k], c->barrier + c->barriers, c->distance + c->barriers)) return false;
        c->barriers += c->obstacles[k].n;
    }
    return true;
}

/* Leaves out barriers that are not within reach, if the reach is known. False: memory is out. */
static bool keep_near(call *c)
{
    bool no_memory = false;
    const double reach = c->options.barrier_reach;
    const size_t all = c->barriers;
    for (size_t k = 0; k < all; k++) c->number[k] = (int64_t)k;
    if (!isfinite(reach) || all == 0) return true;
    gis_py_targets *targets = gis_py_targets_new(c->feature, c->anchor, c->shapes->n, reach, &no_memory);
    c->barriers = 0;
    for (size_t k = 0; !no_memory && k < all; k++) {
        if (!gis_py_is_near(targets, &c->barrier[k], c->distance[k])) continue;
        c->barrier[c->barriers] = c->barrier[k];
        c->number[c->barriers++] = (int64_t)k;
    }
    gis_py_targets_free(targets);
    return !no_memory;
}

/* ---- The call ---------------------------------------------------------------------------------------------------- */

static void run_layer(void *of, gis_py_watch *watch)
{
    call *c = of;
    sunder_layer *layer = NULL;
    c->options.progress = gis_py_progress;
    c->options.progress_user = watch;
    c->why.status = c->status = SUNDER_ENOMEM;
    if (!keep_near(c)) return;
    c->status = sunder_layer_new(c->feature, c->shapes->n, &layer, &c->why);
    if (c->status == SUNDER_OK) c->status = sunder_layer_set_barriers(layer, c->barrier, c->barriers, &c->why);
    if (c->status == SUNDER_OK && c->row) c->status = sunder_layer_set_rows(layer, c->row, &c->why);
    if (c->status == SUNDER_OK && c->anchor) c->status = sunder_layer_set_side_anchors(layer, c->anchor, &c->why);
    if (c->status == SUNDER_OK && c->prefer) c->status = sunder_layer_set_preferred(layer, c->prefer, &c->why);
    if (c->status == SUNDER_OK)
        c->status = c->check ? sunder_layer_check(layer, &c->options, &c->report, &c->why)
                             : sunder_layer_separate(layer, &c->options, &c->report, &c->why);
    sunder_layer_free(layer);
}

static void clear_call(call *c)
{
    sunder_report_free(c->report);
    for (size_t k = 0; c->obstacles && k < c->sets; k++) gis_py_obstacles_clear(&c->obstacles[k]);
    free(c->obstacles);
    free(c->barrier);
    free(c->distance);
    free(c->number);
    free(c->feature);
    free(c->row);
    free(c->anchor);
    free(c->prefer);
}

/* layer(shapes, demands, barriers, options, check, progress): demands is a dict of arrays or None: weight, max_shift,
 * flags (1 fixed, 2 ignored), blocks, rows, anchors, prefer; barriers a list of tuples (shapes, widths, gap, full_gap,
 * distance, side, boundary) -> a dict, see gis_py_report() */
static PyObject *separate_layer(PyObject *module, PyObject *args)
{
    PyObject *object, *demands, *sets, *options, *progress, *out = NULL;
    int check;
    if (!PyArg_ParseTuple(args, "OO!O!O!pO", &object, &PyDict_Type, &demands, &PyList_Type, &sets, &PyDict_Type,
                          &options, &check, &progress))
        return NULL;
    const gis_py_state *state = gis_py_state_of(module);
    call c = {.check = check, .status = SUNDER_ECANCEL};
    c.shapes = gis_py_shapes_of(state, object);
    if (c.shapes && read_options(options, &c.options) && make_features(&c, demands) && make_barriers(state, &c, sets)) {
        const bool ran = gis_py_run(run_layer, &c, progress, true);
        if (ran && c.status == SUNDER_OK)
            out = gis_py_report(c.report, c.shapes->n, c.number, c.barriers);
        else if (ran)
            gis_py_raise(state, NULL, &c.why);
    }
    clear_call(&c);
    return out;
}

PyMethodDef gis_py_layer_functions[] = {
    {"layer", separate_layer, METH_VARARGS, "layer(shapes, demands, barriers, options, check, progress) -> dict."},
    {NULL, NULL, 0, NULL},
};
