/* obstacles.h: what stays where it is: geometries as obstacles of the core, for routes and for barriers. */
#ifndef GIS_PYTHON_OBSTACLES_H
#define GIS_PYTHON_OBSTACLES_H

#include "python/shapes_type.h"

/* Obstacles that borrow shapes and coordinates from Shapes, which have to outlive them. */
typedef struct gis_py_obstacles {
    sunder_obstacle *obstacle; /* [n] one for each geometry */
    size_t *end;               /* the ends of lines of all of them */
    double *xy;                /* closed rings as lines, if boundaries were asked for */
    size_t n;
} gis_py_obstacles;

/* boundary: rings of polygons are lines, and there are no areas. False: MemoryError is set. */
bool gis_py_obstacles_make(const gis_py_shapes *from, bool boundary, gis_py_obstacles *out);
void gis_py_obstacles_clear(gis_py_obstacles *obstacles);

#endif
