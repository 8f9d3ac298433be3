/* Shapes from hostile rings, and all functions of one shape. */
#include <math.h>

#include "bytes.h"

static void demand_shape(const sunder_shape *shape)
{
    double box[4], anchor[2];
    fuzz_fail_allocations(0); /* getters do not report lack of memory */
    sunder_shape_box(shape, box);
    FUZZ_DEMAND(box[0] <= box[2] && box[1] <= box[3]);
    FUZZ_DEMAND(sunder_shape_is_empty(shape) == (sunder_shape_vertices(shape) == 0));
    FUZZ_DEMAND(sunder_shape_is_empty(shape) || sunder_shape_vertices(shape) >= 3 * sunder_shape_polygons(shape));
    FUZZ_DEMAND(sunder_shape_area(shape) >= 0);
    sunder_shape_anchor(shape, anchor);
    /* The anchor is inside the shape; rounded to doubles it still cannot leave the box. */
    FUZZ_DEMAND(anchor[0] >= box[0] && anchor[0] <= box[2] && anchor[1] >= box[1] && anchor[1] <= box[3]);
}

static void ask_reflection(const sunder_shape *shape)
{
    sunder_shape *mirrored = NULL;
    if (sunder_shape_reflect(shape, &mirrored, NULL) == SUNDER_OK) {
        double box[4], other[4];
        sunder_shape_box(shape, box);
        sunder_shape_box(mirrored, other);
        FUZZ_DEMAND(other[0] == -box[2] && other[1] == -box[3] && other[2] == -box[0] && other[3] == -box[1]);
        FUZZ_DEMAND(sunder_shape_vertices(mirrored) == sunder_shape_vertices(shape));
    }
    sunder_shape_free(mirrored);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_bytes bytes = {data, size};
    unsigned fail = fuzz_byte(&bytes);
    fuzz_fail_allocations(fail < 64 ? fail : 0);
    fuzz_scale scale = fuzz_choose_scale(&bytes);
    sunder_shape *shape = fuzz_shape(&bytes, scale, 64), *moved = NULL, *disc = NULL;
    if (shape) {
        bool exact = false;
        demand_shape(shape);
        ask_reflection(shape);
        double dx = fuzz_coordinate(&bytes, scale), dy = fuzz_coordinate(&bytes, scale);
        if (sunder_shape_translate(shape, dx, dy, &moved, &exact, NULL) == SUNDER_OK) {
            demand_shape(moved);
            FUZZ_DEMAND(!exact || sunder_shape_vertices(moved) == sunder_shape_vertices(shape));
        }
    }
    double radius = fuzz_coordinate(&bytes, scale);
    unsigned segments = fuzz_byte(&bytes);
    sunder_status status = sunder_shape_disc(radius, segments, fuzz_byte(&bytes) & 1, &disc, NULL);
    FUZZ_DEMAND((disc != NULL) == (status == SUNDER_OK));
    FUZZ_DEMAND((radius > 0 && isfinite(radius) && segments >= 3) == (status != SUNDER_EARG));
    if (disc) demand_shape(disc);
    sunder_shape_free(disc);
    sunder_shape_free(moved);
    sunder_shape_free(shape);
    return 0;
}
