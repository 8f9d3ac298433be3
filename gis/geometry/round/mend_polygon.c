/* mend_polygon.c: repairs polygons that rounding to doubles has made invalid.
 *
 * Vertices have moved by less than an ulp. That makes polygons with tight spots invalid, and sums often have them:
 * rings that meet in points, a vertex on an edge of another ring, needles thinner than an ulp. Two steps repair them:
 *
 * - an edge is bent through every vertex within a few ulps of it: it gets a new vertex equal to that one. This moves
 * the edge by at most that distance, and rings that crossed slightly touch again (snap rounding, with the vertices as
 * hot pixels); - if the polygon is still invalid, it is replaced by the set that its rings enclose by the even-odd
 * rule, computed exactly by the core and rounded; tiny folds and needles without width disappear. It may become several
 * polygons.
 *
 * Rounding in the second step may cause new defects, so both steps are repeated. Distances in doubles only choose where
 * to bend; the core's exact validation decides what is valid. */
#include "base/core_error.h"
#include "geometry/round/constants.h"
#include "geometry/round/steps.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

bool gis_end_ring_with_area(gis_polygons *set, size_t first, bool *kept, gis_error *error)
{
    while (set->vertices > first + 1 && gis_same_vertex(set->xy + 2 * first, set->xy + 2 * (set->vertices - 1)))
        set->vertices--;
    const sunder_point *point = (const sunder_point *)set->xy; /* pairs of doubles have the layout of sunder_point */
    *kept = false;
    for (size_t i = first + 2; i < set->vertices && !*kept; i++)
        *kept = sunder_orient(&point[first], &point[first + 1], &point[i]) != 0;
    if (*kept) return gis_polygons_end_ring(set, error);
    set->vertices = first;
    return true;
}

/* Makes a shape of the rings first ... last - 1 as one polygon; *out is NULL if they are invalid. */
static bool strict_shape(const gis_polygons *set, size_t first, size_t last, sunder_shape **out, gis_error *error)
{
    size_t start = first ? set->ring_end[first - 1] : 0, rings = last - first;
    size_t *ends = malloc((rings + 1) * sizeof *ends);
    if (!ends) return gis_no_memory(error);
    for (size_t r = first; r < last; r++) ends[r - first] = set->ring_end[r] - start;
    *out = NULL;
    sunder_error why;
    sunder_status status =
        sunder_shape_from_rings(set->xy + 2 * start, ends, &rings, 1, SUNDER_VALIDITY_STRICT, out, &why);
    free(ends);
    return status == SUNDER_OK || status == SUNDER_EINVALID || gis_core_failed(error, NULL, &why);
}

/* The state of rings as a polygon. If rings touch, it may be valid only in the sense of SUNDER_VALIDITY_STRICT, but not
 * of OGC: its interior is not connected, or a ring touches itself. */
typedef enum polygon_state { BROKEN, TOUCHES, WELL } polygon_state;

/* Determines the state of the rings first ... last - 1. Fails only if memory is out or the core fails. */
static bool find_state(const gis_polygons *set, size_t first, size_t last, polygon_state *state, gis_error *error)
{
    sunder_shape *shape;
    if (!strict_shape(set, first, last, &shape, error)) return false;
    *state = !shape ? BROKEN : sunder_shape_touches(shape) ? TOUCHES : WELL;
    sunder_shape_free(shape);
    return true;
}

static bool append_exact(const sunder_sum *sum, gis_polygons *to, gis_error *error)
{
    sunder_sum_size size;
    sunder_error why;
    sunder_sum_get_size(sum, &size);
    for (size_t p = 0; p < size.polygons; p++) {
        for (size_t r = 0; r < sunder_sum_rings(sum, p); r++) {
            size_t n;
            double off = 0; /* the vertices are doubles, so nothing is rounded */
            const uint32_t *vertex = sunder_sum_ring(sum, p, r, &n);
            if (!gis_polygons_reserve(to, n, error)) return false;
            if (sunder_sum_vertices(sum, vertex, n, to->xy + 2 * to->vertices, &off, &why) != SUNDER_OK)
                return gis_core_failed(error, NULL, &why);
            to->vertices += n;
            if (!gis_polygons_end_ring(to, error)) return false;
        }
        if (!gis_polygons_end_polygon(to, error)) return false;
    }
    return true;
}

/* Appends rings that touch as polygons that are valid in the sense of OGC, with the same vertices. */
static bool append_touching(gis_polygons *set, const gis_polygons *from, size_t first, size_t last, gis_error *error)
{
    sunder_shape *shape;
    sunder_sum *sum = NULL;
    sunder_error why;
    if (!strict_shape(from, first, last, &shape, error)) return false;
    bool ok = (shape && sunder_shape_union(shape, NULL, &sum, &why) == SUNDER_OK) ||
              gis_fail(error, "%s", shape ? why.message : "the polygon is not valid");
    ok = ok && append_exact(sum, set, error);
    sunder_sum_free(sum);
    sunder_shape_free(shape);
    return ok;
}

/* ---- Bending ----------------------------------------------------------------------------------------------------- */

typedef struct bend {
    double t, distance, xy[2];
} bend;

/* Vertices sorted by x, so that only those near an edge are tested. */
typedef struct column {
    double xy[2];
} column;

static int by_x(const void *a, const void *b)
{
    const column *ca = a, *cb = b;
    return (ca->xy[0] > cb->xy[0]) - (ca->xy[0] < cb->xy[0]);
}

static int by_place(const void *a, const void *b)
{
    double ta = ((const bend *)a)->t, tb = ((const bend *)b)->t;
    return (ta > tb) - (ta < tb);
}

double gis_place_along(const double *a, const double *b, const double *c, const double unit[2], double *off)
{
    double dx = (b[0] - a[0]) / unit[0], dy = (b[1] - a[1]) / unit[1], length2 = dx * dx + dy * dy;
    double cx = (c[0] - a[0]) / unit[0], cy = (c[1] - a[1]) / unit[1];
    double t = length2 > 0 ? (cx * dx + cy * dy) / length2 : 0;
    double inside = t < 0 ? 0 : t > 1 ? 1 : t;
    *off = hypot(cx - inside * dx, cy - inside * dy);
    return t;
}

/* Is c so near to the inside of the edge ab that rounding may have put it on the wrong side? Sets *found to the place
 * and distance. */
static bool is_near(const double *a, const double *b, const double *c, const double reach[2], bend *found)
{
    double off, t;
    if (gis_same_vertex(a, c) || gis_same_vertex(b, c)) return false;
    t = gis_place_along(a, b, c, reach, &off);
    if (!(t > 0 && t < 1)) return false;
    double x = a[0] + t * (b[0] - a[0]), y = a[1] + t * (b[1] - a[1]);
    *found = (bend){t, hypot(c[0] - x, c[1] - y), {c[0], c[1]}};
    return off <= 1;
}

/* Finds the vertices near ab, in order along it; `bends` must have room for all vertices. */
static size_t find_bends(const column *columns, size_t n, const double *a, const double *b, double ulps, bend *bends)
{
    double reach[2];
    for (int k = 0; k < 2; k++) reach[k] = ulps * gis_ulp(fmax(fabs(a[k]), fabs(b[k])));
    double xmin = fmin(a[0], b[0]) - reach[0], xmax = fmax(a[0], b[0]) + reach[0];
    double ymin = fmin(a[1], b[1]) - reach[1], ymax = fmax(a[1], b[1]) + reach[1];
    size_t low = 0, high = n, found = 0;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (columns[middle].xy[0] < xmin)
            low = middle + 1;
        else
            high = middle;
    }
    for (size_t k = low; k < n && columns[k].xy[0] <= xmax; k++) {
        const double *c = columns[k].xy;
        if (c[1] >= ymin && c[1] <= ymax && is_near(a, b, c, reach, &bends[found])) found++;
    }
    qsort(bends, found, sizeof *bends, by_place);
    return found;
}

static bool bend_ring(const gis_polygons *from, size_t r, const column *columns, size_t n, double ulps, bend *bends,
                      gis_polygons *to, double *moved, gis_error *error)
{
    size_t begin = r ? from->ring_end[r - 1] : 0, end = from->ring_end[r];
    for (size_t i = begin; i < end; i++) {
        const double *a = from->xy + 2 * i, *b = from->xy + 2 * (i + 1 < end ? i + 1 : begin);
        if (!gis_polygons_vertex(to, a[0], a[1], error)) return false;
        size_t found = find_bends(columns, n, a, b, ulps, bends);
        for (size_t k = 0; k < found; k++) {
            *moved = fmax(*moved, bends[k].distance);
            if ((k == 0 || !gis_same_vertex(bends[k].xy, bends[k - 1].xy)) &&
                !gis_polygons_vertex(to, bends[k].xy[0], bends[k].xy[1], error))
                return false;
        }
    }
    return gis_polygons_end_ring(to, error);
}

static bool bend_all(const gis_polygons *from, double ulps, gis_polygons *to, double *moved, gis_error *error)
{
    size_t n = from->vertices;
    column *columns = malloc((n + 1) * sizeof *columns);
    bend *bends = malloc((n + 1) * sizeof *bends);
    bool ok = (columns && bends) || gis_no_memory(error);
    for (size_t v = 0; ok && v < n; v++) columns[v] = (column){{from->xy[2 * v], from->xy[2 * v + 1]}};
    if (ok) qsort(columns, n, sizeof *columns, by_x);
    for (size_t p = 0, r = 0; ok && p < from->polygons; p++) {
        for (; ok && r < from->poly_end[p]; r++) ok = bend_ring(from, r, columns, n, ulps, bends, to, moved, error);
        ok = ok && gis_polygons_end_polygon(to, error);
    }
    free(columns);
    free(bends);
    return ok;
}

bool gis_bend_set(const gis_polygons *from, int round, gis_polygons *to, double *moved, gis_error *error)
{
    double now = 0;
    if (!bend_all(from, round == 0 ? GIS_BEND_ULPS : GIS_PIXEL_ULPS, to, &now, error)) return false;
    *moved += now;
    for (int i = 1; round > 0 && i < GIS_BENDS_IN_A_ROW && now > 0; i++) {
        gis_polygons bent = {0};
        now = 0;
        bool ok = bend_all(to, GIS_PIXEL_ULPS, &bent, &now, error);
        gis_polygons_clear(to);
        *to = bent;
        *moved += now;
        if (!ok) return false;
    }
    return true;
}

/* ---- The even-odd set, rounded ----------------------------------------------------------------------------------- */

/* Appends polygon p of the shape. Rings without area are dropped; if that is the outer ring, nothing is appended. */
static bool append_rounded(const sunder_shape *shape, size_t p, gis_polygons *out, double *moved, gis_error *error)
{
    size_t first = out->rings;
    for (size_t r = 0; r < sunder_shape_rings(shape, p); r++) {
        size_t n, start = out->vertices;
        const double *xy = sunder_shape_ring(shape, p, r, &n);
        bool kept;
        for (size_t v = 0; v < n; v++) {
            *moved = fmax(*moved, gis_ulp(fmax(fabs(xy[2 * v]), fabs(xy[2 * v + 1]))));
            if (out->vertices > start && gis_same_vertex(out->xy + 2 * (out->vertices - 1), xy + 2 * v)) continue;
            if (!gis_polygons_vertex(out, xy[2 * v], xy[2 * v + 1], error)) return false;
        }
        if (!gis_end_ring_with_area(out, start, &kept, error)) return false;
        if (r == 0 && !kept) return true;
    }
    return out->rings == first || gis_polygons_end_polygon(out, error);
}

/* Appends the set that all rings of `set` enclose by the even-odd rule, rounded. */
static bool append_enclosed(const gis_polygons *set, gis_polygons *out, double *moved, gis_error *error)
{
    sunder_shape *shape = NULL;
    sunder_error why;
    if (gis_polygons_shape(set, SUNDER_VALIDITY_EVEN_ODD, &shape, &why) != SUNDER_OK)
        return gis_core_failed(error, NULL, &why);
    bool ok = true;
    for (size_t p = 0; ok && p < sunder_shape_polygons(shape); p++) ok = append_rounded(shape, p, out, moved, error);
    sunder_shape_free(shape);
    return ok;
}

/* ---- Both steps, until all is valid ------------------------------------------------------------------------------ */

/* Appends the valid polygons to `done`, the others to `broken`. */
static bool sort_out(const gis_polygons *set, gis_polygons *done, gis_polygons *broken, gis_error *error)
{
    for (size_t p = 0; p < set->polygons; p++) {
        size_t from = p ? set->poly_end[p - 1] : 0, to = set->poly_end[p];
        polygon_state state;
        if (!find_state(set, from, to, &state, error)) return false;
        bool ok = state == TOUCHES ? append_touching(done, set, from, to, error)
                                   : gis_polygons_append(state == WELL ? done : broken, set, from, to, error);
        if (!ok) return false;
    }
    return true;
}

/* One round for an invalid polygon, the rings first ... last - 1: appends what is valid to `done`, the rest to
 * `again`. */
static bool mend_once(const gis_polygons *set, size_t first, size_t last, int round, gis_polygons *done,
                      gis_polygons *again, double *moved, gis_error *error)
{
    double bends = 0, rounding = 0;
    gis_polygons one = {0}, bent = {0}, broken = {0}, pieces = {0};
    bool ok = gis_polygons_append(&one, set, first, last, error) && gis_bend_set(&one, round, &bent, &bends, error) &&
              sort_out(&bent, done, &broken, error);
    if (ok && broken.polygons)
        ok = append_enclosed(&broken, &pieces, &rounding, error) && sort_out(&pieces, done, again, error);
    *moved = fmax(*moved, bends + rounding);
    gis_polygons_clear(&one);
    gis_polygons_clear(&bent);
    gis_polygons_clear(&broken);
    gis_polygons_clear(&pieces);
    return ok;
}

/* Replaces the rings first ... set->rings - 1 by valid polygons; raises *moved to the largest distance by which the
 * boundary moved. */
static bool mend_polygon(gis_polygons *set, size_t first, double *moved, gis_error *error)
{
    gis_polygons work = {0};
    double total = 0;
    bool ok = gis_polygons_append(&work, set, first, set->rings, error);
    set->vertices = first ? set->ring_end[first - 1] : 0;
    set->rings = first;
    for (int round = 0; ok && round < GIS_POLYGON_ROUNDS && work.polygons; round++) {
        gis_polygons again = {0};
        double now = 0;
        for (size_t p = 0; ok && p < work.polygons; p++)
            ok = mend_once(&work, p ? work.poly_end[p - 1] : 0, work.poly_end[p], round, set, &again, &now, error);
        gis_polygons_clear(&work);
        work = again;
        total += now;
    }
    if (ok && work.polygons)
        ok = gis_fail(error,
                      "after rounding to doubles the sum is no longer valid; `sunder sum --exact` gives it as JSON");
    gis_polygons_clear(&work);
    *moved = fmax(*moved, total);
    return ok;
}

bool gis_end_valid_polygon(gis_polygons *set, size_t first, double *moved, size_t *repaired, gis_error *error)
{
    polygon_state state;
    if (!find_state(set, first, set->rings, &state, error)) return false;
    if (state == WELL) return gis_polygons_end_polygon(set, error);
    if (state == BROKEN) {
        *repaired += 1;
        return mend_polygon(set, first, moved, error);
    }
    gis_polygons copy = {0};
    bool ok = gis_polygons_append(&copy, set, first, set->rings, error);
    set->vertices = first ? set->ring_end[first - 1] : 0;
    set->rings = first;
    ok = ok && append_touching(set, &copy, 0, copy.rings, error);
    gis_polygons_clear(&copy);
    return ok;
}
