/* mend_multipolygon.c: makes a valid multipolygon of rounded polygons.
 *
 * Each polygon is valid by itself already (round.c, mend_polygon.c). Together they are a valid multipolygon if their
 * interiors are disjoint and their boundaries meet in points only. That held before rounding; but rounding moved
 * vertices by up to an ulp, so polygons that met in a point, or were nearer than an ulp, may now overlap or share part
 * of an edge.
 *
 * If two polygons do, a vertex of one is within a few ulps of an edge of the other, since the first contact during the
 * move was at a vertex. A grid of vertices finds such neighbours, in doubles with generous bounds; neighbours form
 * groups. Then the test is exact: n polygons with connected interiors are apart in the sense above exactly if the
 * interior of their union has n components. A group that fails is bent through its vertices, united and rounded again,
 * until all groups are valid. */
#include "base/core_error.h"
#include "geometry/round/constants.h"
#include "geometry/round/steps.h"

#include "base/interrupt.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

/* ---- Groups of polygons: union-find ------------------------------------------------------------------------------ */

static size_t root_of(size_t *parent, size_t p)
{
    while (parent[p] != p) p = parent[p] = parent[parent[p]];
    return p;
}

/* Joins two groups. The smaller number becomes the root, so that a group takes the position of its first polygon. */
static void join_polygons(size_t *parent, size_t p, size_t q)
{
    p = root_of(parent, p);
    q = root_of(parent, q);
    if (p < q)
        parent[q] = p;
    else
        parent[p] = q;
}

/* ---- A grid of vertices ------------------------------------------------------------------------------------------ */

typedef struct grid {
    double least[2], step[2];
    size_t cells[2];  /* numbers of columns and rows */
    size_t *cell_end; /* [columns * rows] ends of the cells' vertices in `vertex` */
    size_t *vertex;   /* numbers of the vertices, cell by cell */
    size_t *owner;    /* [vertices] the polygon of each vertex */
} grid;

static void grid_clear(grid *g)
{
    free(g->cell_end);
    free(g->vertex);
    free(g->owner);
}

/* The column or row of a coordinate; despite rounding, a larger coordinate never gets a smaller number. */
static size_t cell_along(const grid *g, int axis, double at)
{
    double k = at / g->step[axis] - g->least[axis] / g->step[axis];
    return k > 0 ? (size_t)fmin(k, (double)(g->cells[axis] - 1)) : 0;
}

static size_t cell_of(const grid *g, const double *xy)
{
    return cell_along(g, 1, xy[1]) * g->cells[0] + cell_along(g, 0, xy[0]);
}

static void lay_out(const gis_polygons *set, grid *g)
{
    double most[2] = {-INFINITY, -INFINITY};
    g->least[0] = g->least[1] = INFINITY;
    for (size_t v = 0; v < set->vertices; v++)
        for (int k = 0; k < 2; k++) {
            g->least[k] = fmin(g->least[k], set->xy[2 * v + (size_t)k]);
            most[k] = fmax(most[k], set->xy[2 * v + (size_t)k]);
        }
    for (int k = 0; k < 2; k++) {
        g->cells[k] = (size_t)sqrt((double)set->vertices) + 1;
        double n = (double)g->cells[k], step = most[k] / n - g->least[k] / n;
        g->step[k] = step > 0 ? step : 1;
    }
}

static bool grid_make(const gis_polygons *set, grid *g, gis_error *error)
{
    lay_out(set, g);
    size_t n = g->cells[0] * g->cells[1];
    g->cell_end = calloc(n + 1, sizeof *g->cell_end);
    g->vertex = malloc((set->vertices + 1) * sizeof *g->vertex);
    g->owner = malloc((set->vertices + 1) * sizeof *g->owner);
    if (!g->cell_end || !g->vertex || !g->owner) return gis_no_memory(error);
    for (size_t p = 0, r = 0, v = 0; p < set->polygons; p++)
        for (; r < set->poly_end[p]; r++)
            for (; v < set->ring_end[r]; v++) g->owner[v] = p;
    for (size_t v = 0; v < set->vertices; v++) g->cell_end[cell_of(g, set->xy + 2 * v) + 1]++;
    for (size_t c = 0; c < n; c++) g->cell_end[c + 1] += g->cell_end[c];
    /* Counts were stored one cell later, so that filling turns the starts of cells into their ends. */
    for (size_t v = 0; v < set->vertices; v++) g->vertex[g->cell_end[cell_of(g, set->xy + 2 * v)]++] = v;
    return true;
}

static bool is_near(const double *a, const double *b, const double *c, const double reach[2])
{
    double off;
    gis_place_along(a, b, c, reach, &off);
    return !(off > 1); /* true also for NaN */
}

static void join_in_cell(const gis_polygons *set, const grid *g, size_t cell, const double *a, const double *b,
                         size_t polygon, const double reach[2], size_t *parent)
{
    for (size_t i = cell ? g->cell_end[cell - 1] : 0; i < g->cell_end[cell]; i++) {
        size_t v = g->vertex[i];
        if (g->owner[v] != polygon && is_near(a, b, set->xy + 2 * v, reach))
            join_polygons(parent, polygon, g->owner[v]);
    }
}

/* Joins a polygon with those that have a vertex near its edge ab. The edge is followed through the grid in pieces of
 * about a cell. */
static void join_along(const gis_polygons *set, const grid *g, const double *a, const double *b, size_t polygon,
                       double moved, size_t *parent)
{
    double ulp[2], reach[2];
    size_t pieces = 1;
    for (int k = 0; k < 2; k++) {
        ulp[k] = gis_ulp(fmax(fabs(a[k]), fabs(b[k])));
        reach[k] = GIS_NEAR_ULPS * ulp[k] + GIS_NEAR_MOVES * moved;
        size_t from = cell_along(g, k, fmin(a[k], b[k])), to = cell_along(g, k, fmax(a[k], b[k]));
        pieces = to - from + 1 > pieces ? to - from + 1 : pieces;
    }
    double from[2] = {a[0], a[1]}, to[2];
    for (size_t i = 1; i <= pieces; i++) {
        double t = (double)i / (double)pieces;
        size_t low[2], high[2];
        for (int k = 0; k < 2; k++) {
            to[k] = i < pieces ? (1 - t) * a[k] + t * b[k] : b[k];
            low[k] = cell_along(g, k, fmin(from[k], to[k]) - reach[k] - GIS_NEAR_ULPS * ulp[k]);
            high[k] = cell_along(g, k, fmax(from[k], to[k]) + reach[k] + GIS_NEAR_ULPS * ulp[k]);
            from[k] = to[k];
        }
        for (size_t row = low[1]; row <= high[1]; row++)
            for (size_t column = low[0]; column <= high[0]; column++)
                join_in_cell(set, g, row * g->cells[0] + column, a, b, polygon, reach, parent);
    }
}

static void polygon_box(const gis_polygons *set, size_t p, double box[4])
{
    size_t r = p ? set->poly_end[p - 1] : 0;
    box[0] = box[1] = INFINITY;
    box[2] = box[3] = -INFINITY;
    for (size_t v = r ? set->ring_end[r - 1] : 0; v < set->ring_end[r]; v++)
        for (size_t k = 0; k < 2; k++) {
            box[k] = fmin(box[k], set->xy[2 * v + k]);
            box[k + 2] = fmax(box[k + 2], set->xy[2 * v + k]);
        }
}

/* Joins all polygons whose boxes meet that of a polygon that may have lost a hole: a polygon inside the former hole
 * need not have a vertex near an edge. */
static void join_inside(const gis_polygons *set, size_t suspect, size_t *parent)
{
    double box[4], other[4];
    polygon_box(set, suspect, box);
    for (size_t p = 0; p < set->polygons && !gis_interrupted(); p++) {
        polygon_box(set, p, other);
        if (other[0] <= box[2] && other[2] >= box[0] && other[1] <= box[3] && other[3] >= box[1])
            join_polygons(parent, suspect, p);
    }
}

static bool join_ring(const gis_polygons *set, const grid *g, size_t r, size_t polygon, double moved, size_t *parent,
                      gis_error *error)
{
    size_t first = r ? set->ring_end[r - 1] : 0, end = set->ring_end[r];
    for (size_t v = first; v < end; v++) {
        if (!gis_go_on(error)) return false;
        join_along(set, g, set->xy + 2 * v, set->xy + 2 * (v + 1 < end ? v + 1 : first), polygon, moved, parent);
    }
    return true;
}

static bool find_groups(const gis_polygons *set, const gis_suspects *suspects, double moved, size_t *parent,
                        gis_error *error)
{
    grid g = {0};
    bool ok = grid_make(set, &g, error);
    for (size_t p = 0; p < set->polygons; p++) parent[p] = p;
    for (size_t p = 0, r = 0; ok && p < set->polygons; p++)
        for (; ok && r < set->poly_end[p]; r++) ok = join_ring(set, &g, r, p, moved, parent, error);
    for (size_t i = 0; ok && i < suspects->n; i++) join_inside(set, suspects->polygon[i], parent);
    grid_clear(&g);
    return ok && gis_go_on(error);
}

/* ---- One group --------------------------------------------------------------------------------------------------- */

static bool unite_group(const gis_polygons *group, sunder_validity validity, sunder_sum **out, gis_error *error)
{
    sunder_shape *shape = NULL;
    sunder_error why;
    bool ok = (gis_polygons_shape(group, validity, &shape, &why) == SUNDER_OK &&
               sunder_shape_union(shape, NULL, out, &why) == SUNDER_OK) ||
              gis_core_failed(error, NULL, &why);
    sunder_shape_free(shape);
    return ok;
}

/* Tests a group of polygons and mends it if needed (*bad is set): its edges are bent through the vertices near them
 * (gis_bend_set()), the group is united again, and the result is rounded into *mended. */
static bool mend_group(const gis_polygons *group, int round, bool *bad, gis_rounded *mended, gis_suspects *suspects,
                       double *moved, gis_error *error)
{
    sunder_sum *sum = NULL;
    sunder_sum_size size;
    if (!unite_group(group, SUNDER_VALIDITY_STRICT, &sum, error)) return false;
    sunder_sum_get_size(sum, &size);
    sunder_sum_free(sum);
    *bad = size.polygons != group->polygons;
    if (!*bad) return true;
    gis_polygons bent = {0};
    sum = NULL;
    bool ok = gis_bend_set(group, round, &bent, moved, error) &&
              unite_group(&bent, SUNDER_VALIDITY_EVEN_ODD, &sum, error) &&
              gis_round_polygons(sum, mended, suspects, error);
    gis_polygons_clear(&bent);
    sunder_sum_free(sum);
    return ok;
}

/* ---- All groups, until all are valid ----------------------------------------------------------------------------- */

/* The set for the next round: valid groups unchanged, the others mended. */
typedef struct rebuilding {
    gis_rounded next;
    gis_suspects suspects;
    double moved; /* the largest move of any group */
    size_t bad;
} rebuilding;

static bool append_group(const gis_polygons *set, const size_t *member, size_t n, int round, rebuilding *to,
                         gis_error *error)
{
    gis_polygons group = {0};
    gis_rounded mended = {0};
    bool ok = true, bad = false;
    double moved = 0;
    gis_suspects of_group = {0};
    for (size_t i = 0; ok && i < n; i++) ok = gis_polygons_append_one(&group, set, member[i], error);
    if (ok && n > 1) ok = mend_group(&group, round, &bad, &mended, &of_group, &moved, error);
    const gis_polygons *from = bad ? &mended.set : &group;
    for (size_t i = 0; ok && i < of_group.n; i++)
        ok = gis_suspect(&to->suspects, to->next.set.polygons + of_group.polygon[i], error);
    ok = ok && gis_polygons_append_all(&to->next.set, from, error);
    to->bad += bad;
    to->moved = fmax(to->moved, moved + mended.deviation);
    gis_polygons_clear(&group);
    gis_rounded_clear(&mended);
    gis_suspects_clear(&of_group);
    return ok;
}

/* Lists the members of all groups, group by group, in the order of their first polygons. */
static void list_members(size_t *parent, size_t n, size_t *count, size_t *member)
{
    for (size_t p = 0; p < n; p++) count[root_of(parent, p)]++;
    for (size_t p = 0, at = 0; p < n; p++) {
        size_t here = count[p];
        count[p] = at;
        at += here;
    }
    for (size_t p = 0; p < n; p++) member[count[root_of(parent, p)]++] = p;
}

/* One round. *again is set if a group was mended, so that all have to be tested again. */
static bool mend_once(gis_rounded *rounded, int round, gis_suspects *suspects, bool *again, gis_error *error)
{
    const gis_polygons *set = &rounded->set;
    size_t n = set->polygons, *parent = malloc((n + 1) * sizeof *parent);
    size_t *end = calloc(n + 1, sizeof *end), *member = malloc((n + 1) * sizeof *member);
    rebuilding to = {0};
    bool ok = ((parent && end && member) || gis_no_memory(error)) &&
              find_groups(set, suspects, rounded->deviation, parent, error);
    if (ok) list_members(parent, n, end, member);
    bool any = false;
    for (size_t p = 0; ok && p < n && !any; p++) any = parent[p] != p;
    for (size_t p = 0, from = 0; ok && any && p < n && (ok = gis_go_on(error)); p++)
        if (parent[p] == p) {
            ok = append_group(set, member + from, end[p] - from, round, &to, error);
            from = end[p];
        }
    *again = ok && to.bad > 0;
    if (*again) {
        to.next.deviation = rounded->deviation + to.moved;
        to.next.repaired = rounded->repaired + to.bad;
        gis_rounded_clear(rounded);
        gis_suspects_clear(suspects);
        *rounded = to.next;
        *suspects = to.suspects;
    } else {
        gis_rounded_clear(&to.next);
        gis_suspects_clear(&to.suspects);
    }
    free(parent);
    free(end);
    free(member);
    return ok;
}

bool gis_mend_multipolygon(gis_rounded *rounded, gis_suspects *suspects, gis_error *error)
{
    bool again = rounded->set.polygons > 1 && rounded->deviation > 0;
    for (int round = 0; again; round++) {
        if (round == GIS_MULTIPOLYGON_ROUNDS)
            return gis_fail(error, "after rounding to doubles the polygons are no longer disjoint; `sunder sum "
                                   "--exact` gives exact ones as JSON");
        if (!mend_once(rounded, round, suspects, &again, error)) return false;
    }
    return true;
}
