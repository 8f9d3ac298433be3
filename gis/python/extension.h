/* extension.h: what all files of the Python extension share: the limited interface of Python 3.11, the state of the
 * module, and how failures become exceptions.
 *
 * The extension has no GDAL and no headers of NumPy: it is built of the core, of files of gis/ that do not need GDAL,
 * and of this folder. Functions return NULL, -1 or false with an exception set. Work of the core runs without the
 * interpreter's lock (watched_call.h). */
#ifndef GIS_PYTHON_EXTENSION_H
#define GIS_PYTHON_EXTENSION_H

#ifndef Py_LIMITED_API
#define Py_LIMITED_API 0x030B0000 /* the buffer protocol is in it from 3.11 on */
#endif
#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include "base/gis_error.h"
#include "sunder.h"

/* A function in a table of slots, where Python keeps it as a pointer to void. */
#define GIS_PY_SLOT(function) (__extension__(void *)(function))

typedef struct gis_py_state {
    PyObject *error;      /* sunder.Error */
    PyTypeObject *shapes; /* the types of this module */
    PyTypeObject *sum;
} gis_py_state;

/* The state, from the module or from one of its objects. */
gis_py_state *gis_py_state_of(PyObject *module);
gis_py_state *gis_py_state_of_object(PyObject *object);

/* Raise ValueError for input that breaks a rule, MemoryError, or sunder.Error for all else; a call that was cancelled
 * keeps the exception that cancelled it. `who` (NULL: none) begins the message. Return NULL. */
PyObject *gis_py_raise(const gis_py_state *state, const char *who, const sunder_error *why);
PyObject *gis_py_raise_gis(const gis_py_state *state, const char *who, const gis_error *why);

/* Raises ValueError "WHO: ..." and returns false. */
bool gis_py_wrong(const char *who, const char *format, ...);

/* A new memoryview of n bytes that belong to it, cast to this format of the buffer protocol ("d", "q", "B"); *data is
 * set to the bytes. columns > 1 gives it two dimensions. NULL: an exception is set. */
PyObject *gis_py_array(const char *format, size_t item, size_t rows, size_t columns, void **data);

/* The functions of the module, by topic; each table ends with an empty row. */
extern PyMethodDef gis_py_shape_functions[], gis_py_sum_functions[], gis_py_pair_functions[], gis_py_route_functions[],
    gis_py_layer_functions[], gis_py_nofit_functions[];

#endif
