/* The parts of a block. Polygons hang together if one lies in another one, or if they are no farther apart than the
 * touch tolerance. All of this is in doubles: it decides what grows about one point. */
#include "displacement/levels/block_parts.h"

#include "displacement/levels/edges.h"

#include <math.h>

static bool list_polygons(const sunder_shape *shape, uint32_t feature, sunder_i_block_parts *out)
{
    const sunder_i_cleaned *c = &shape->form->cleaned;
    for (uint32_t p = 0, vertex = 0; p < c->polygons; p++) {
        if (!sunder_i_reserve(&out->polygon, &out->room, out->n + 1, sizeof *out->polygon)) return false;
        sunder_i_block_polygon *polygon = &out->polygon[out->n++];
        *polygon = (sunder_i_block_polygon){
            .shape = shape, .feature = feature, .vertex = vertex, .end = c->ring_end[c->poly_end[p] - 1]};
        sunder_i_box_clear(polygon->box);
        for (; vertex < polygon->end; vertex++) sunder_i_box_include(polygon->box, shape->xy + 2 * (size_t)vertex);
    }
    return true;
}

static double cross(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static double distance_to_point(const double edge[4], const double p[2])
{
    double off[2];
    sunder_i_off_edge(edge, p, off);
    return hypot(off[0], off[1]);
}

static bool are_edges_near(const double a[4], const double b[4], double tolerance)
{
    if ((cross(a, a + 2, b) < 0) != (cross(a, a + 2, b + 2) < 0) &&
        (cross(b, b + 2, a) < 0) != (cross(b, b + 2, a + 2) < 0))
        return true;
    for (int c = 0; c < 2; c++)
        if (distance_to_point(a, b + 2 * c) <= tolerance || distance_to_point(b, a + 2 * c) <= tolerance) return true;
    return false;
}

/* Is the first vertex of polygon p inside of q? */
static bool begins_inside(const sunder_i_block_polygon *p, const sunder_i_block_polygon *q)
{
    const double *at = p->shape->xy + 2 * (size_t)p->vertex;
    bool inside = false;
    for (uint32_t v = q->vertex; v < q->end; v++) {
        double e[4];
        sunder_i_edge_of(q->shape, v, e);
        inside ^= sunder_i_ray_crosses(at, e);
    }
    return inside;
}

static bool is_edge_near(const double edge[4], const sunder_i_block_polygon *q, double tolerance)
{
    double box[4];
    for (int c = 0; c < 2; c++) {
        box[c] = sunder_i_min(edge[c], edge[c + 2]) - tolerance;
        box[c + 2] = sunder_i_max(edge[c], edge[c + 2]) + tolerance;
    }
    if (!sunder_i_box_meet(box, q->box)) return false;
    for (uint32_t v = q->vertex; v < q->end; v++) {
        double other[4];
        sunder_i_edge_of(q->shape, v, other);
        if (are_edges_near(edge, other, tolerance)) return true;
    }
    return false;
}

static bool hang_together(const sunder_i_block_polygon *p, const sunder_i_block_polygon *q, double tolerance)
{
    double box[4];
    sunder_i_box_grow(p->box, tolerance, box);
    if (!sunder_i_box_meet(box, q->box)) return false;
    for (uint32_t v = p->vertex; v < p->end; v++) {
        double edge[4];
        sunder_i_edge_of(p->shape, v, edge);
        if (is_edge_near(edge, q, tolerance)) return true;
    }
    return begins_inside(p, q) || begins_inside(q, p);
}

/* Assigns `part` to polygon k and to every polygon that is connected to it, directly or through others. The polygons of
 * the part are moved to the indices from k on. Returns the index past the last one. */
static size_t take_part(sunder_i_block_polygon *polygon, size_t k, size_t n, double tolerance, uint32_t part)
{
    size_t end = k + 1;
    for (; k < end; k++) {
        polygon[k].part = part;
        for (size_t i = end; i < n; i++) {
            if (!hang_together(&polygon[k], &polygon[i], tolerance)) continue;
            const sunder_i_block_polygon other = polygon[i];
            polygon[i] = polygon[end];
            polygon[end++] = other;
        }
    }
    return end;
}

bool sunder_i_block_parts_find(const sunder_i_model *model, const sunder_i_body *body, const sunder_shape *const *shape,
                               double tolerance, sunder_i_block_parts *out)
{
    out->n = out->parts = 0;
    for (uint32_t m = 0; m < body->members; m++) {
        const uint32_t f = model->member[body->member + m];
        if (shape[f] && !list_polygons(shape[f], f, out)) return false;
    }
    for (size_t k = 0; k < out->n;) k = take_part(out->polygon, k, out->n, tolerance, out->parts++);
    return true;
}
