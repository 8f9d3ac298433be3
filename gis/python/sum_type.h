/* sum_type.h: the type Sum: an exact polygonal set, the result of a sum, a dilation and the like. */
#ifndef GIS_PYTHON_SUM_TYPE_H
#define GIS_PYTHON_SUM_TYPE_H

#include "python/extension.h"

typedef struct gis_py_sum {
    PyObject ob_base;
    sunder_sum *sum;
} gis_py_sum;

extern PyType_Spec gis_py_sum_spec;

/* Takes over a sum. */
PyObject *gis_py_sum_wrap(const gis_py_state *state, sunder_sum *sum);

#endif
