/* shapes_out.h: Shapes as arrays, and moved. */
#ifndef GIS_PYTHON_SHAPES_OUT_H
#define GIS_PYTHON_SHAPES_OUT_H

#include "python/shapes_type.h"

/* Methods of Shapes. ragged() -> (coordinates, ring offsets, polygon offsets, geometry offsets): the rings as they were
 * given, without closing vertices that were dropped. */
PyObject *gis_py_shapes_ragged(PyObject *self, PyObject *unused);
/* moved(moves) -> Shapes: each shape moved by its pair of numbers, coordinates rounded to the nearest doubles. */
PyObject *gis_py_shapes_moved(PyObject *self, PyObject *args);

#endif
