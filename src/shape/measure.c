/* What a shape says of itself: counts, box, area, anchor. */
#include "shape/shape.h"

#include "predicate/predicate.h"

#include <math.h>
#include <string.h>

size_t sunder_shape_polygons(const sunder_shape *shape) { return shape->polygons; }
size_t sunder_shape_vertices(const sunder_shape *shape) { return shape->vertices; }
bool sunder_shape_is_empty(const sunder_shape *shape) { return shape->polygons == 0; }
bool sunder_shape_repaired(const sunder_shape *shape) { return shape->repaired; }

bool sunder_shape_touches(const sunder_shape *shape) { return shape->touches; }
void sunder_shape_box(const sunder_shape *shape, double box[4]) { memcpy(box, shape->box, sizeof shape->box); }

/* Twice the area of a closed walk on the lattice, exactly: sum of cross products taken from its first corner. */
static sunder_i_big twice_area(sunder_i_lattice *l, sunder_i_arena *arena, const sunder_i_point *at,
                               const uint32_t *corner, uint32_t n)
{
    sunder_i_big sum = {NULL, 0};
    for (uint32_t i = 1; i + 1 < n; i++) {
        const sunder_i_point u = sunder_i_point_sub(l, at[corner[i]], at[corner[0]]);
        const sunder_i_point v = sunder_i_point_sub(l, at[corner[i + 1]], at[corner[0]]);
        const sunder_i_big s = sunder_i_big_mul(arena, sunder_i_lattice_get(l, u.x), sunder_i_lattice_get(l, v.y));
        const sunder_i_big t = sunder_i_big_mul(arena, sunder_i_lattice_get(l, u.y), sunder_i_lattice_get(l, v.x));
        sum = sunder_i_big_add(arena, sum, sunder_i_big_sub(arena, s, t));
    }
    return sum;
}

/* The sum over convex pieces, which is the sum over members. */
double sunder_shape_area(const sunder_shape *shape)
{
    sunder_i_placed placed;
    if (shape->pieces == 0 || sunder_i_place(shape, NULL, NULL, &placed, NULL)) return 0;
    sunder_i_lattice *l = &placed.lattice;
    sunder_i_arena arena;
    sunder_i_arena_init(&arena);
    sunder_i_big sum = {NULL, 0};
    for (uint32_t i = 0, at = 0; i < shape->pieces; at = shape->piece_end[i++])
        sum = sunder_i_big_add(&arena, sum,
                               twice_area(l, &arena, placed.p, shape->piece_vertex + at, shape->piece_end[i] - at));
    const sunder_i_big den = sunder_i_big_mul(&arena, l->denominator, l->denominator);
    const double area = sunder_i_big_ratio(&arena, sum, den, 2 * l->exponent - 1);
    sunder_i_arena_free(&arena);
    sunder_i_placed_free(&placed);
    return area;
}

/* Area of a convex piece in doubles, from its first corner, so that far origins cost no digits. */
static double rough_area(const sunder_shape *shape, const uint32_t *corner, uint32_t n)
{
    const double *o = shape->xy + 2 * (size_t)corner[0];
    double sum = 0;
    for (uint32_t i = 1; i + 1 < n; i++) {
        const double *a = shape->xy + 2 * (size_t)corner[i], *b = shape->xy + 2 * (size_t)corner[i + 1];
        sum += (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
    }
    return sum;
}

/* (num / den) * 2^exponent + origin, to the nearest double. */
static double near_value(sunder_i_arena *arena, sunder_i_big num, sunder_i_big den, long exponent, double origin)
{
    int e;
    const sunder_i_big o = sunder_i_big_double(arena, origin, &e);
    if (o.size == 0) return sunder_i_big_ratio(arena, num, den, exponent);
    const long unit = exponent < e ? exponent : e;
    num = sunder_i_big_shl(arena, num, (unsigned long)(exponent - unit));
    const sunder_i_big shift = sunder_i_big_mul(arena, sunder_i_big_shl(arena, o, (unsigned long)(e - unit)), den);
    return sunder_i_big_ratio(arena, sunder_i_big_add(arena, num, shift), den, unit);
}

/* The centroid of a piece: over the fan of triangles o, a, b with u = a - o, v = b - o it is
 * o + sum (u + v) cross(u, v) / (3 sum cross(u, v)). */
static void centroid(sunder_i_lattice *l, sunder_i_arena *arena, const sunder_i_point *at, const uint32_t *corner,
                     uint32_t n, const double origin[2], double xy[2])
{
    sunder_i_big weight = {NULL, 0}, moment[2] = {{NULL, 0}, {NULL, 0}};
    for (uint32_t i = 1; i + 1 < n; i++) {
        const sunder_i_point u = sunder_i_point_sub(l, at[corner[i]], at[corner[0]]);
        const sunder_i_point v = sunder_i_point_sub(l, at[corner[i + 1]], at[corner[0]]);
        const sunder_i_big ux = sunder_i_lattice_get(l, u.x), uy = sunder_i_lattice_get(l, u.y);
        const sunder_i_big vx = sunder_i_lattice_get(l, v.x), vy = sunder_i_lattice_get(l, v.y);
        const sunder_i_big cross =
            sunder_i_big_sub(arena, sunder_i_big_mul(arena, ux, vy), sunder_i_big_mul(arena, uy, vx));
        weight = sunder_i_big_add(arena, weight, cross);
        moment[0] = sunder_i_big_add(arena, moment[0], sunder_i_big_mul(arena, cross, sunder_i_big_add(arena, ux, vx)));
        moment[1] = sunder_i_big_add(arena, moment[1], sunder_i_big_mul(arena, cross, sunder_i_big_add(arena, uy, vy)));
    }
    weight = sunder_i_big_mul(arena, weight, sunder_i_big_i64(arena, 3));
    const sunder_i_big den = sunder_i_big_mul(arena, weight, l->denominator);
    const int64_t first[2] = {at[corner[0]].x, at[corner[0]].y};
    for (int k = 0; k < 2; k++) {
        const sunder_i_big start = sunder_i_big_mul(arena, weight, sunder_i_lattice_get(l, first[k]));
        xy[k] = near_value(arena, sunder_i_big_add(arena, start, moment[k]), den, l->exponent, origin[k]);
    }
}

void sunder_shape_anchor(const sunder_shape *shape, double xy[2])
{
    double most = -1;
    uint32_t largest = 0, from = 0;
    xy[0] = xy[1] = 0;
    if (shape->pieces == 0) return;
    for (uint32_t i = 0, at = 0; i < shape->pieces; at = shape->piece_end[i++]) {
        const double area = rough_area(shape, shape->piece_vertex + at, shape->piece_end[i] - at);
        if (!(area > most)) continue;
        most = area;
        largest = i;
        from = at;
    }
    sunder_i_placed placed;
    if (sunder_i_place(shape, NULL, NULL, &placed, NULL)) return;
    sunder_i_arena arena;
    sunder_i_arena_init(&arena);
    centroid(&placed.lattice, &arena, placed.p, shape->piece_vertex + from, shape->piece_end[largest] - from,
             placed.origin_p, xy);
    sunder_i_arena_free(&arena);
    sunder_i_placed_free(&placed);
}
