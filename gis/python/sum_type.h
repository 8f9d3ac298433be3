/* sum_type.h: the type Sum: an exact polygonal set, the result of a sum, a dilation and the like. */
#ifndef GIS_PYTHON_SUM_TYPE_H
#define GIS_PYTHON_SUM_TYPE_H

#include "python/extension.h"

typedef struct gis_py_sum {
    PyObject ob_base;
    const sunder_sum *sum;
    sunder_sum *owned; /* NULL: the owner has it */
    PyObject *owner;   /* NULL: none */
} gis_py_sum;

extern PyType_Spec gis_py_sum_spec;

/* Takes over a sum. */
PyObject *gis_py_sum_wrap(const gis_py_state *state, sunder_sum *sum);
/* A sum that `owner` has, to which a reference is kept. */
PyObject *gis_py_sum_lend(const gis_py_state *state, const sunder_sum *sum, PyObject *owner);

#endif
