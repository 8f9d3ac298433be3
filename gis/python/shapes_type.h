/* shapes_type.h: the type Shapes: shapes of the core, in a row. It does not change, so that threads may share it. */
#ifndef GIS_PYTHON_SHAPES_TYPE_H
#define GIS_PYTHON_SHAPES_TYPE_H

#include "python/features_in.h"

typedef struct gis_py_shapes {
    PyObject ob_base;
    sunder_shape **shape;     /* [n] NULL: the geometry has no polygons, or was skipped */
    gis_py_features features; /* as they were given; without areas, which the shapes have */
    unsigned char *mended;    /* [n] 1: taken by the even-odd rule; 2: skipped */
    char **reason;            /* [n] why; NULL where nothing was invalid */
    size_t n;
} gis_py_shapes;

extern PyType_Spec gis_py_shapes_spec;

/* The object as Shapes; NULL with TypeError if it is something else. Borrowed. */
gis_py_shapes *gis_py_shapes_of(const gis_py_state *state, PyObject *object);
/* Its only shape, as an operand: an error if it has not one item, or this has no polygons. `who` is its name. */
const sunder_shape *gis_py_operand(const gis_py_state *state, PyObject *object, const char *who);

/* The word "repair", "skip" or "fail". */
typedef enum gis_py_invalid { GIS_PY_REPAIR, GIS_PY_SKIP, GIS_PY_FAIL } gis_py_invalid;

/* Makes new Shapes of features, which it takes over and clears in any case. `who` begins messages, with a number if
 * there may be several. The lock is released meanwhile. */
PyObject *gis_py_shapes_new(const gis_py_state *state, gis_py_features *from, gis_py_invalid policy, const char *who,
                            bool numbered);
/* Takes over n shapes. */
PyObject *gis_py_shapes_wrap(const gis_py_state *state, sunder_shape **shape, size_t n);

#endif
