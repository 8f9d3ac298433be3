/* Cuts a feature by lines into parts.
 *
 * Each member with the lines near it gives a planar map. The member's parts are the faces of the map inside the member:
 * a face is connected, and a line that ends inside it bounds it on both sides and separates nothing. Areas are compared
 * in doubles with an error bound first, and exactly if that does not decide. Corners of the feature or of a barrier's
 * area that are not doubles are put on the lattice exactly. */
#include "displacement/layer/side_cut.h"

#include "base/error.h"
#include "base/extremes.h"
#include "base/random.h"
#include "base/watch.h"
#include "shape/shape.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* ---- On one lattice ---------------------------------------------------------------------------------------------- */

static bool is_exact(const sunder_shape *s, uint32_t v) { return s->rational && s->form->numbers->exact[v].den.size; }

/* Extends the extent by the ends of a line. Ends that are not doubles lie within one unit in the last place of the
 * rounded ones. */
static void add_extent(sunder_i_extent *all, const sunder_i_side *side)
{
    const bool rational = side->area && side->area->rational;
    for (int e = 0; e < 2; e++) {
        const double *at = e ? side->to : side->from;
        sunder_i_extent_add(all, at, 1);
        for (int k = 0; rational && k < 2; k++) {
            all->low[k] = sunder_i_min(all->low[k], nextafter(at[k], -DBL_MAX));
            all->high[k] = sunder_i_max(all->high[k], nextafter(at[k], DBL_MAX));
        }
    }
    if (rational && side->area->low_bit < all->low_bit) all->low_bit = side->area->low_bit;
}

static void set_lattice(sunder_i_side_cut *c)
{
    sunder_i_extent all = sunder_i_shape_extent(c->shape);
    bool rational = c->shape->rational;
    for (size_t k = 0; k < c->sides; k++) {
        add_extent(&all, c->side[k]);
        rational = rational || (c->side[k]->area && c->side[k]->area->rational);
    }
    sunder_i_lattice_init(&c->lattice, &all, 1, true, &c->origin, false);
    if (rational) sunder_i_lattice_admit_ratios(&c->lattice);
    sunder_i_arena_init(&c->arena);
}

/* Puts vertex v of shape s on the lattice, or, if s is NULL or the vertex is a double, the point xy. */
static sunder_i_rational_point put_point(sunder_i_side_cut *c, const sunder_shape *s, uint32_t v, const double *xy)
{
    sunder_i_point at;
    if (s && is_exact(s, v)) {
        at = sunder_i_place_exact(&c->lattice, &s->form->numbers->exact[v], NULL, c->origin);
    } else {
        at.x = sunder_i_lattice_int(&c->lattice, xy[0], c->origin[0]);
        at.y = sunder_i_lattice_int(&c->lattice, xy[1], c->origin[1]);
    }
    return sunder_i_rational_get(&c->arena, &c->lattice, at);
}

static sunder_i_rational_point put_vertex(sunder_i_side_cut *c, uint32_t v)
{
    return put_point(c, c->shape, v, c->shape->xy + 2 * (size_t)v);
}

static void put_line(sunder_i_side_cut *c, const sunder_i_side *side, sunder_i_rational_point end[2])
{
    const sunder_shape *s = side->area;
    end[0] = put_point(c, s, side->vertex, side->from);
    end[1] = put_point(c, s, s ? s->form->cleaned.next[side->vertex] : 0, side->to);
}

/* The coordinates need not be multiples of the lattice's unit. */
sunder_i_rational_point sunder_i_side_cut_point(sunder_i_side_cut *cut, const double xy[2])
{
    sunder_i_arena *m = &cut->arena;
    long unit = cut->lattice.exponent;
    for (int k = 0; k < 2; k++)
        if (xy[k] != 0 && sunder_i_low_bit(xy[k]) < unit) unit = sunder_i_low_bit(xy[k]);
    sunder_i_big at[2];
    for (int k = 0; k < 2; k++) {
        int e, f;
        sunder_i_big v = sunder_i_big_double(m, xy[k], &e), o = sunder_i_big_double(m, cut->origin[k], &f);
        if (v.size) v = sunder_i_big_shl(m, v, (unsigned long)(e - unit));
        if (o.size) o = sunder_i_big_shl(m, o, (unsigned long)(f - unit));
        at[k] = sunder_i_big_sub(m, v, o);
    }
    return (sunder_i_rational_point){
        at[0], at[1], sunder_i_big_shl(m, sunder_i_big_i64(m, 1), (unsigned long)(cut->lattice.exponent - unit))};
}

/* Converts a length, or with power 2 an area, into units of the lattice. */
sunder_i_ratio sunder_i_side_cut_in_units(sunder_i_side_cut *cut, double size, int power)
{
    const long by = power * cut->lattice.exponent;
    sunder_i_ratio r = sunder_i_ratio_double(&cut->arena, sunder_i_min(size, DBL_MAX));
    if (by < 0)
        r.num = sunder_i_big_shl(&cut->arena, r.num, (unsigned long)-by);
    else
        r.den = sunder_i_big_shl(&cut->arena, r.den, (unsigned long)by);
    return r;
}

/* Rounds a point to the nearest doubles. */
void sunder_i_side_cut_doubles(sunder_i_side_cut *cut, const sunder_i_rational_point *at, double xy[2])
{
    sunder_i_arena *m = &cut->arena;
    for (int k = 0; k < 2; k++) {
        int e;
        sunder_i_big o = sunder_i_big_double(m, cut->origin[k], &e);
        if (o.size) o = sunder_i_big_shl(m, o, (unsigned long)(e - cut->lattice.exponent));
        const sunder_i_big num = sunder_i_big_add(m, sunder_i_rational_axis(at, k), sunder_i_big_mul(m, o, at->w));
        xy[k] = sunder_i_big_ratio(m, num, at->w, cut->lattice.exponent);
    }
}

/* ---- The boundary of a part -------------------------------------------------------------------------------------- */

void sunder_i_side_cut_boundary(sunder_i_side_cut *cut, const sunder_i_cut_part *part, sunder_i_visit_side_cut visit,
                                void *context)
{
    size_t inner;
    const uint32_t *of = sunder_i_planar_map_face_inner(part->map, part->face, &inner);
    for (size_t k = 0; k <= inner; k++) {
        const uint32_t start = k < inner ? of[k] : sunder_i_planar_map_face_outer(part->map, part->face);
        uint32_t h = start;
        do {
            const uint32_t next = sunder_i_planar_map_next(part->map, h);
            visit(cut, sunder_i_planar_map_vertex_point(part->map, sunder_i_planar_map_origin(part->map, h)),
                  sunder_i_planar_map_vertex_point(part->map, sunder_i_planar_map_origin(part->map, next)), context);
            h = next;
        } while (h != start);
    }
}

/* An area estimated in doubles. Each coordinate has a relative error of 2^-53, and a cross product an error of less
 * than 2^-50 of the magnitudes of its two products. A sum of n terms has an error of n 2^-53 of the sum of the terms'
 * magnitudes. */
typedef struct estimate {
    double sum, size;
    size_t n;
} estimate;

static void add_estimate(sunder_i_side_cut *c, const sunder_i_rational_point *a, const sunder_i_rational_point *b,
                         void *context)
{
    estimate *e = context;
    const sunder_i_mark mark = sunder_i_arena_mark(&c->arena);
    double p[2], q[2];
    sunder_i_rational_doubles(&c->arena, *a, 0, &p[0], &p[1]);
    sunder_i_rational_doubles(&c->arena, *b, 0, &q[0], &q[1]);
    sunder_i_arena_release(&c->arena, mark);
    e->sum += p[0] * q[1] - p[1] * q[0];
    e->size += fabs(p[0] * q[1]) + fabs(p[1] * q[0]);
    e->n++;
}

static void add_exactly(sunder_i_side_cut *c, const sunder_i_rational_point *a, const sunder_i_rational_point *b,
                        void *context)
{
    sunder_i_ratio *sum = context;
    sunder_i_arena *m = &c->arena;
    const sunder_i_ratio term = {sunder_i_rational_cross(m, *a, *b), sunder_i_times(m, a->w, b->w)};
    *sum = sunder_i_ratio_add(m, *sum, term);
}

static sunder_i_ratio exact_area(sunder_i_side_cut *c, const sunder_i_cut_part *p)
{
    sunder_i_ratio sum = {sunder_i_big_i64(&c->arena, 0), sunder_i_big_i64(&c->arena, 1)};
    sunder_i_side_cut_boundary(c, p, add_exactly, &sum);
    return sum;
}

/* ---- Parts ------------------------------------------------------------------------------------------------------- */

static bool add_part(sunder_i_side_cut *c, sunder_i_planar_map *map, uint32_t face)
{
    estimate e = {0, 0, 0};
    sunder_i_cut_part p = {.map = map, .face = face};
    if (!sunder_i_reserve(&c->part, &c->part_capacity, c->parts + 1, sizeof *c->part)) return false;
    sunder_i_side_cut_boundary(c, &p, add_estimate, &e);
    p.area = e.sum;
    p.off = (8 + (double)e.n) * 0x1p-52 * e.size + DBL_MIN;
    if (!isfinite(p.area) || !isfinite(p.off)) {
        p.area = 0;
        p.off = INFINITY;
    }
    c->part[c->parts++] = p;
    return true;
}

/* Is edge e a piece of a line inside the member? Edges of the member have the member on one side only; lines along
 * these do not count. */
static bool is_inside(const sunder_i_planar_map *map, uint32_t e)
{
    return sunder_i_planar_map_sides(map, 2 * e) == 0 && sunder_i_planar_map_sides(map, 2 * e + 1) == 0 &&
           sunder_i_planar_map_left_covered(map, 2 * e) > 0;
}

static sunder_status take_parts(sunder_i_side_cut *c, sunder_i_planar_map *map, sunder_error *err)
{
    for (uint32_t e = 0; e < sunder_i_planar_map_edge_end(map) && !c->any; e++)
        c->any = sunder_i_planar_map_edge_alive(map, e) && is_inside(map, e);
    for (uint32_t f = 1; f < sunder_i_planar_map_face_end(map); f++)
        if (sunder_i_planar_map_face_covered(map, f) > 0 && !add_part(c, map, f)) return sunder_i_failure_cause(err);
    return SUNDER_OK;
}

/* A segment to be inserted into the map; segments are inserted in random order. */
typedef struct segment {
    sunder_i_rational_point from, to;
    bool line; /* it is a line; otherwise an edge with the member on its left */
} segment;

static sunder_status insert_segments(sunder_i_planar_map *map, const segment *list, size_t n, sunder_error *err)
{
    uint32_t *order = sunder_i_alloc(n, sizeof *order);
    uint64_t random = 1;
    sunder_status status = order ? SUNDER_OK : sunder_i_failure_cause(err);
    for (uint32_t k = 0; order && k < n; k++) order[k] = k;
    if (order) sunder_i_shuffle(order, n, sizeof *order, &random);
    for (size_t k = 0; k < n && !status; k++) {
        const segment *s = &list[order[k]];
        status = sunder_i_planar_map_insert_segment(map, s->from, s->to, !s->line, 0, NULL, NULL, err);
        if (!status && !sunder_i_step()) status = sunder_i_cancelled(err);
    }
    sunder_i_free(order);
    return status;
}

/* Makes the planar map of the member with the vertices first .. last - 1, with the lines, and appends its parts. */
static sunder_status cut_member(sunder_i_side_cut *c, uint32_t first, uint32_t last, sunder_i_planar_map **map,
                                sunder_error *err)
{
    size_t n = 0;
    segment *list = sunder_i_alloc(last - first + c->sides, sizeof *list);
    if (!list) return sunder_i_failure_cause(err);
    for (uint32_t v = first; v < last; v++)
        list[n++] = (segment){put_vertex(c, v), put_vertex(c, c->shape->form->cleaned.next[v]), false};
    for (size_t k = 0; k < c->sides; k++, n++) {
        sunder_i_rational_point end[2];
        put_line(c, c->side[k], end);
        list[n] = (segment){end[0], end[1], true};
    }
    sunder_status status = sunder_i_planar_map_new(&c->lattice, 1, map, err);
    if (!status) status = insert_segments(*map, list, n, err);
    if (!status) status = sunder_i_planar_map_mark(*map, err);
    if (!status) status = sunder_i_planar_map_faces(*map, err);
    sunder_i_free(list);
    return status ? status : take_parts(c, *map, err);
}

/* Returns the end of the vertices of a polygon. */
static uint32_t vertices_to(const sunder_shape *s, uint32_t polygon)
{
    return s->form->cleaned.ring_end[s->form->cleaned.poly_end[polygon] - 1];
}

sunder_status sunder_i_side_cut_make(const sunder_shape *shape, const sunder_i_side *const *side, size_t n,
                                     sunder_i_side_cut *out, sunder_error *err)
{
    memset(out, 0, sizeof *out);
    out->shape = shape;
    out->side = side;
    out->sides = n;
    set_lattice(out);
    out->map = sunder_i_calloc(shape->form->cleaned.polygons, sizeof(sunder_i_planar_map *));
    sunder_status status = out->map ? SUNDER_OK : sunder_i_failure_cause(err);
    for (uint32_t k = 0; k < shape->form->cleaned.polygons && !status; k++)
        status = cut_member(out, k ? vertices_to(shape, k - 1) : 0, vertices_to(shape, k), &out->map[k], err);
    return status;
}

void sunder_i_side_cut_free(sunder_i_side_cut *cut)
{
    for (uint32_t k = 0; cut->map && k < cut->shape->form->cleaned.polygons; k++) sunder_i_planar_map_free(cut->map[k]);
    sunder_i_free_all(cut->map, cut->part);
    sunder_i_arena_free(&cut->arena);
    sunder_i_lattice_free(&cut->lattice);
}

void sunder_i_side_cut_keep_largest(sunder_i_side_cut *cut, double slack)
{
    sunder_i_arena *m = &cut->arena;
    const double twice = ldexp(2 * slack, (int)(-2 * cut->lattice.exponent));
    double least = -INFINITY;
    size_t n = 0;
    for (size_t k = 0; k < cut->parts; k++) least = sunder_i_max(least, cut->part[k].area - cut->part[k].off);
    for (size_t k = 0; k < cut->parts; k++)
        if (!(cut->part[k].area + cut->part[k].off + 1.0000001 * twice < least)) cut->part[n++] = cut->part[k];
    cut->parts = n;
    if (n < 2) return;
    sunder_i_ratio largest = exact_area(cut, &cut->part[0]);
    for (size_t k = 1; k < cut->parts && !m->failed; k++) {
        const sunder_i_ratio area = exact_area(cut, &cut->part[k]);
        if (sunder_i_ratio_cmp(m, area, largest) > 0) largest = area;
    }
    const sunder_i_ratio missing = sunder_i_side_cut_in_units(cut, 2 * slack, 2);
    n = 0;
    for (size_t k = 0; k < cut->parts && !m->failed; k++)
        if (sunder_i_ratio_cmp(m, sunder_i_ratio_add(m, exact_area(cut, &cut->part[k]), missing), largest) >= 0)
            cut->part[n++] = cut->part[k];
    cut->parts = n;
}

sunder_status sunder_i_side_cut_holds(const sunder_i_cut_part *part, sunder_i_rational_point at, bool *holds,
                                      sunder_error *err)
{
    sunder_i_location place;
    const sunder_status status = sunder_i_planar_map_locate(part->map, at, &place, err);
    *holds = !status && place.place == SUNDER_I_IN_FACE && place.face == part->face;
    return status;
}
