/* layer_calls.h: a whole layer: what the call takes (layer_calls.c), and its report as Python's values
 * (layer_result.c). */
#ifndef GIS_PYTHON_LAYER_CALLS_H
#define GIS_PYTHON_LAYER_CALLS_H

#include "python/extension.h"

/* A dict with the moves, statuses, blocks, conflicts and the summary of a report on n features. `barrier` has the
 * numbers of the barriers of the report among all. */
PyObject *gis_py_report(const sunder_report *report, size_t n, const int64_t *barrier, size_t barriers);

#endif
