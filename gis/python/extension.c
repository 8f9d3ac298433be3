/* extension.c: the module sunder._sunder. The package beside it (sunder/) has the functions that people call; this
 * module takes arrays and geometries apart, calls the core, and returns plain Python values. */
#include "python/extension.h"

#include "python/shapes_type.h"
#include "python/sum_type.h"

#include <stdarg.h>
#include <stdio.h>

gis_py_state *gis_py_state_of(PyObject *module) { return PyModule_GetState(module); }
gis_py_state *gis_py_state_of_object(PyObject *object) { return PyType_GetModuleState(Py_TYPE(object)); }

static PyObject *raise_text(PyObject *type, const char *who, const char *message)
{
    PyErr_Format(type, "%s%s%s", who ? who : "", who ? ": " : "", message);
    return NULL;
}

PyObject *gis_py_raise(const gis_py_state *state, const char *who, const sunder_error *why)
{
    if (PyErr_Occurred()) return NULL; /* what cancelled the call */
    switch (why->status) {
    case SUNDER_EINVALID:
    case SUNDER_EARG: return raise_text(PyExc_ValueError, who, why->message);
    case SUNDER_ENOMEM: return PyErr_NoMemory();
    case SUNDER_ECANCEL: return raise_text(PyExc_KeyboardInterrupt, who, "stopped");
    default: return raise_text(state->error, who, why->message);
    }
}

PyObject *gis_py_raise_gis(const gis_py_state *state, const char *who, const gis_error *why)
{
    if (PyErr_Occurred()) return NULL;
    return why->no_memory ? PyErr_NoMemory() : raise_text(state->error, who, why->message);
}

bool gis_py_wrong(const char *who, const char *format, ...)
{
    char text[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    raise_text(PyExc_ValueError, who, text);
    return false;
}

PyObject *gis_py_array(const char *format, size_t item, size_t rows, size_t columns, void **data)
{
    PyObject *bytes = PyByteArray_FromStringAndSize(NULL, (Py_ssize_t)(item * rows * columns));
    if (!bytes) return NULL;
    *data = PyByteArray_AsString(bytes);
    PyObject *flat = PyMemoryView_FromObject(bytes), *cast = NULL;
    Py_DECREF(bytes);
    if (!flat) return NULL;
    if (columns > 1 && rows > 0)
        cast = PyObject_CallMethod(flat, "cast", "s(nn)", format, (Py_ssize_t)rows, (Py_ssize_t)columns);
    else
        cast = PyObject_CallMethod(flat, "cast", "s", format);
    Py_DECREF(flat);
    return cast;
}

/* ---- The module -------------------------------------------------------------------------------------------------- */

static int add_type(PyObject *module, const char *name, PyType_Spec *spec, PyTypeObject **out)
{
    *out = (PyTypeObject *)PyType_FromModuleAndSpec(module, spec, NULL);
    return *out ? PyModule_AddObjectRef(module, name, (PyObject *)*out) : -1;
}

static int add_contents(PyObject *module)
{
    gis_py_state *state = gis_py_state_of(module);
    state->error = PyErr_NewExceptionWithDoc(
        "sunder.Error", "The library could not compute a result, though the input breaks no rule.", NULL, NULL);
    if (!state->error || PyModule_AddObjectRef(module, "Error", state->error) < 0) return -1;
    if (add_type(module, "Shapes", &gis_py_shapes_spec, &state->shapes) < 0 ||
        add_type(module, "Sum", &gis_py_sum_spec, &state->sum) < 0)
        return -1;
    PyMethodDef *const tables[] = {gis_py_shape_functions, gis_py_sum_functions,   gis_py_pair_functions,
                                   gis_py_nofit_functions, gis_py_route_functions, gis_py_layer_functions};
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++)
        if (PyModule_AddFunctions(module, tables[i]) < 0) return -1;
    return PyModule_AddStringConstant(module, "version", sunder_version());
}

static int visit_state(PyObject *module, visitproc visit, void *arg)
{
    gis_py_state *state = gis_py_state_of(module);
    Py_VISIT(state->error);
    Py_VISIT(state->shapes);
    Py_VISIT(state->sum);
    return 0;
}

static int clear_state(PyObject *module)
{
    gis_py_state *state = gis_py_state_of(module);
    Py_CLEAR(state->error);
    Py_CLEAR(state->shapes);
    Py_CLEAR(state->sum);
    return 0;
}

static void free_state(void *module) { clear_state(module); }

static PyModuleDef_Slot slots[] = {{Py_mod_exec, GIS_PY_SLOT(add_contents)}, {0, NULL}};

static PyModuleDef definition = {
    PyModuleDef_HEAD_INIT,
    .m_name = "sunder._sunder",
    .m_doc = "The core of the package sunder, on plain values. Its interface may change; use the package.",
    .m_size = sizeof(gis_py_state),
    .m_slots = slots,
    .m_traverse = visit_state,
    .m_clear = clear_state,
    .m_free = free_state,
};

PyMODINIT_FUNC PyInit__sunder(void);
PyMODINIT_FUNC PyInit__sunder(void) { return PyModuleDef_Init(&definition); }
