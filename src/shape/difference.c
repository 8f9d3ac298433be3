/* difference.c: a shape without convex polygons, exactly, and then its largest polygon with rounded corners.
 *
 * The rings of the shape have the winding number 1 inside; those of the cuts are reversed and have -1. Where the sum is
 * positive a point is in the shape and in no cut. */
#include "shape/difference.h"

#include "shape/even_odd.h"
#include "shape/rational_corners.h"

#include <math.h>
#include <string.h>

/* The rings of the shape, followed by those of the cuts. */
static bool take_rings(const sunder_shape *shape, const sunder_i_cuts *cuts, sunder_i_rings *r, sunder_i_arena *arena)
{
    const sunder_i_cleaned *cleaned = &shape->form->cleaned;
    if (!sunder_i_rings_grow(r, arena, shape->vertices + cuts->corners, cleaned->rings + cuts->n, 1)) return false;
    r->vertices = shape->vertices + (uint32_t)cuts->corners;
    memcpy(r->xy, shape->xy, 2 * (size_t)shape->vertices * sizeof *r->xy);
    for (uint32_t v = 0; v < shape->vertices; v++) {
        r->next[v] = cleaned->next[v];
        r->prev[v] = cleaned->prev[v];
    }
    for (uint32_t k = 0; k < cleaned->rings; k++) r->ring_end[r->rings++] = cleaned->ring_end[k];
    uint32_t v = shape->vertices;
    for (size_t k = 0; k < cuts->n; k++) {
        const size_t first = k ? cuts->end[k - 1] : 0, n = cuts->end[k] - first;
        for (size_t i = 0; i < n; i++, v++) {
            memcpy(r->xy + 2 * (size_t)v, cuts->xy + 2 * (cuts->end[k] - 1 - i), 2 * sizeof *r->xy);
            r->next[v] = i + 1 < n ? v + 1 : v + 1 - (uint32_t)n;
            r->prev[v] = i ? v - 1 : v + (uint32_t)n - 1;
        }
        r->ring_end[r->rings++] = v;
    }
    r->poly_end[r->polygons++] = r->rings;
    return true;
}

/* ---- Rounding ---------------------------------------------------------------------------------------------------- */

/* The farthest neighbour that is tried in place of the nearest double, in units of the last place along each axis. */
enum { FARTHEST = 3 };

static double next_double(double v, int ulps)
{
    for (; ulps > 0; ulps--) v = nextafter(v, INFINITY);
    for (; ulps < 0; ulps++) v = nextafter(v, -INFINITY);
    return v;
}

bool sunder_i_round_inward(const double *a, const double *b, double xy[2])
{
    const sunder_point from = {a[0], a[1]}, to = {b[0], b[1]};
    const double was[2] = {xy[0], xy[1]};
    double best = INFINITY;
    bool on_line = false;
    for (int i = -FARTHEST; i <= FARTHEST; i++)
        for (int j = -FARTHEST; j <= FARTHEST; j++) {
            const sunder_point at = {next_double(was[0], i), next_double(was[1], j)};
            const double off = hypot(at.x - was[0], at.y - was[1]);
            const int side = sunder_orient(&from, &to, &at);
            if (side < 0 || (on_line && side > 0) || (off >= best && on_line == (side == 0))) continue;
            on_line = side == 0;
            best = off;
            xy[0] = at.x;
            xy[1] = at.y;
        }
    return best < INFINITY;
}

/* What is being made: the set, and its corners in doubles. */
typedef struct difference {
    const sunder_shape *shape;
    sunder_i_rings r;
    sunder_i_even_odd set;
    const uint32_t *crossing_of;
    double *xy; /* [2 * set.points] */
} difference;

/* Sets the doubles of all corners. Returns false if memory is out; *found is false if a corner has none. */
static bool round_corners(difference *d, const double origin[2], sunder_i_arena *arena, bool *found)
{
    sunder_i_lattice *l = d->r.lattice;
    d->xy = sunder_i_arena_alloc(arena, 2 * (size_t)d->set.points, sizeof *d->xy);
    *found = true;
    for (uint32_t i = 0; i < d->set.points && d->xy; i++) {
        const uint32_t point = d->set.point[i];
        double *xy = d->xy + 2 * (size_t)i;
        if (!(point & SUNDER_I_MADE)) {
            memcpy(xy, d->r.xy + 2 * (size_t)point, 2 * sizeof *xy);
            continue;
        }
        const uint32_t k = point & ~SUNDER_I_MADE, edge = d->crossing_of[k];
        const sunder_i_exact m =
            sunder_i_exact_make(arena, sunder_i_hpoint_read(arena, l, &d->set.made[k]), l->exponent, origin);
        if (arena->failed) return false;
        for (int c = 0; c < 2; c++) xy[c] = sunder_i_big_ratio(arena, m.num[c], m.den, m.exponent);
        if (edge < d->shape->vertices)
            *found =
                *found && sunder_i_round_inward(d->r.xy + 2 * (size_t)edge, d->r.xy + 2 * (size_t)d->r.next[edge], xy);
    }
    return !arena->failed;
}

/* ---- The largest polygon ----------------------------------------------------------------------------------------- */

/* Makes a shape of one polygon of the set; NULL if its rounded rings are not valid. */
static sunder_status make_polygon(const difference *d, uint32_t polygon, sunder_shape **out, sunder_error *err)
{
    const sunder_i_even_odd *set = &d->set;
    const uint32_t first = polygon ? set->poly_end[polygon - 1] : 0, rings = set->poly_end[polygon] - first;
    const uint32_t corner = first ? set->ring_end[first - 1] : 0;
    size_t *end = sunder_i_alloc(rings, sizeof *end);
    const size_t poly_end = rings;
    *out = NULL;
    if (!end) return sunder_i_failure_cause(err);
    for (uint32_t k = 0; k < rings; k++) end[k] = set->ring_end[first + k] - corner;
    sunder_error invalid;
    const sunder_status status =
        sunder_shape_from_rings(d->xy + 2 * (size_t)corner, end, &poly_end, 1, SUNDER_VALIDITY_STRICT, out, &invalid);
    sunder_i_free(end);
    if (!status || status == SUNDER_EINVALID) return SUNDER_OK;
    return sunder_i_failure_cause(err);
}

/* Sets *out to the polygon of the greatest area, the first of equal ones. */
static sunder_status take_largest(const difference *d, sunder_shape **out, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (uint32_t k = 0; k < d->set.polygons && !status; k++) {
        sunder_shape *one;
        status = make_polygon(d, k, &one, err);
        const bool larger = one && (!*out || sunder_shape_area(one) > sunder_shape_area(*out));
        sunder_shape_free(larger ? *out : one);
        if (larger) *out = one;
    }
    return status;
}

sunder_status sunder_i_shape_subtract(const sunder_shape *shape, const sunder_i_cuts *cuts, sunder_shape **out,
                                      sunder_error *err)
{
    sunder_i_arena arena;
    sunder_i_lattice lattice;
    sunder_i_extent extent = {0};
    double origin[1][2];
    difference d = {.shape = shape, .r = {.lattice = &lattice}};
    bool found = false;
    *out = NULL;
    sunder_i_arena_init(&arena);
    sunder_i_extent_add(&extent, shape->xy, shape->vertices);
    sunder_i_extent_add(&extent, cuts->xy, cuts->corners);
    sunder_i_lattice_init(&lattice, &extent, 1, true, origin, false);
    bool ok = take_rings(shape, cuts, &d.r, &arena);
    if (ok) sunder_i_lattice_points(&lattice, d.r.xy, d.r.vertices, origin[0], d.r.at);
    ok = ok && !lattice.arena.failed && sunder_i_winding_find(&d.r, &arena, &d.set, &d.crossing_of) &&
         round_corners(&d, origin[0], &arena, &found);
    sunder_status status = ok ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status && found) status = take_largest(&d, out, err);
    if (status) {
        sunder_shape_free(*out);
        *out = NULL;
    }
    sunder_i_lattice_free(&lattice);
    sunder_i_arena_free(&arena);
    return status;
}
