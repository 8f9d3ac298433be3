/* buffers.h: numbers in objects of the buffer protocol, such as arrays of NumPy, memoryviews, array.array. */
#ifndef GIS_PYTHON_BUFFERS_H
#define GIS_PYTHON_BUFFERS_H

#include "python/extension.h"

/* Is it a buffer of bytes of one dimension: well-known binary? */
bool gis_py_is_bytes(PyObject *object);

/* Reads coordinates: a buffer of the shape (n, k) with k >= 2, x and y being the first two columns, or (2 n,) if `flat`
 * allows it. Numbers are float64, float32 or integers that a double holds; strides may be anything. Sets *xy to 2 * n
 * doubles, to be freed with free(). False: ValueError or MemoryError is set. */
bool gis_py_coordinates(PyObject *object, const char *who, bool flat, double **xy, size_t *n);
/* Reads a buffer of the shape (n,) of numbers, of n numbers exactly unless n is SIZE_MAX; other objects have to be
 * sequences of numbers. */
bool gis_py_doubles(PyObject *object, const char *who, size_t n, double **out, size_t *count);
/* The same for integers. */
bool gis_py_integers(PyObject *object, const char *who, size_t n, int64_t **out, size_t *count);

#endif
