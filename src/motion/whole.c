/* Members may touch and overlap, and their union is meant: where two share a wall, the wall is inside. Their pieces
 * leave it out, though, and a segment or a point, which has no area, would pass along it. So the union is taken first.
 * Its corners are the members' own, unless members cross. */
#include "motion/whole.h"

#include "shape/build.h"

typedef struct copy {
    const sunder_sum *sum;
    size_t rings, vertices;
    double *xy;
    size_t *ring_end, *poly_end;
} copy;

static void measure(copy *c, const sunder_sum_size *counts)
{
    for (size_t p = 0; p < counts->polygons; p++)
        for (size_t r = 0; r < sunder_sum_rings(c->sum, p); r++, c->rings++) {
            size_t n;
            sunder_sum_ring(c->sum, p, r, &n);
            c->vertices += n;
        }
}

/* All rings as doubles; *off is how far they are from the truth. */
static sunder_status fill(copy *c, const sunder_sum_size *counts, double *off, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    size_t rings = 0, vertices = 0;
    *off = 0;
    for (size_t p = 0; p < counts->polygons && status == SUNDER_OK; p++) {
        for (size_t r = 0; r < sunder_sum_rings(c->sum, p) && status == SUNDER_OK; r++) {
            size_t n;
            const uint32_t *ring = sunder_sum_ring(c->sum, p, r, &n);
            status = sunder_sum_vertices(c->sum, ring, n, c->xy + 2 * vertices, off, err);
            c->ring_end[rings++] = vertices += n;
        }
        c->poly_end[p] = rings;
    }
    return status;
}

static sunder_status shape_of(const sunder_sum *sum, sunder_shape **out, sunder_error *err)
{
    sunder_sum_size size;
    copy c = {.sum = sum};
    sunder_sum_get_size(sum, &size);
    measure(&c, &size);
    c.xy = sunder_i_alloc(2 * c.vertices, sizeof *c.xy);
    c.ring_end = sunder_i_alloc(c.rings, sizeof *c.ring_end);
    c.poly_end = sunder_i_alloc(size.polygons, sizeof *c.poly_end);
    double off;
    sunder_status status = c.xy && c.ring_end && c.poly_end ? fill(&c, &size, &off, err) : sunder_i_no_memory(err);
    if (status == SUNDER_OK && off == 0)
        status = sunder_shape_from_rings(c.xy, c.ring_end, c.poly_end, size.polygons, SUNDER_VALIDITY_STRICT, out, err);
    sunder_i_free(c.xy);
    sunder_i_free(c.ring_end);
    sunder_i_free(c.poly_end);
    return status;
}

sunder_status sunder_i_whole(const sunder_shape *shape, sunder_shape **out, sunder_error *err)
{
    *out = NULL;
    if (shape->polygons < 2) return SUNDER_OK;
    sunder_sum *sum;
    sunder_status status = sunder_shape_union(shape, NULL, &sum, err);
    if (status != SUNDER_OK) return status;
    status = shape_of(sum, out, err);
    sunder_sum_free(sum);
    return status;
}
