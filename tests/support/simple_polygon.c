#include "simple_polygon.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

sunder_shape *simple_polygon(const double *xy, size_t n)
{
    sunder_shape *shape;
    sunder_error err;
    const size_t one = 1;
    if (sunder_shape_from_rings(xy, &n, &one, 1, SUNDER_VALIDITY_STRICT, &shape, &err)) fail_msg("%s", err.message);
    return shape;
}
