/* previous_edits.c: a result has the geometry of each feature plus its move, rounded as gis_geometry_translate() rounds
 * it. So the geometry in the layer plus the former move is that in the result, to the bit, unless one of them was
 * edited since.
 *
 * A format may change the order, the orientation and the start of rings, and make a Polygon a MultiPolygon. Therefore
 * polygons whose vertices differ are compared as sets of edges without a direction. Points, and the control points of
 * arcs, are compared in their order. Z and M are not compared. */
#include "layer/previous_edits.h"

#include "base/interrupt.h"
#include "read/fields.h"

#include <cpl_conv.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct comparison {
    const gis_layer_input *now, *before;
    int level_field, cut_field;    /* of the result; -1: it has none */
    gis_polygonal_part is, was;    /* of the two features that are compared */
    double *edge, *edge_was;       /* [4 each] their edges */
    size_t capacity, capacity_was; /* in edges */
} comparison;

static void translate(double *xy, size_t n, const double move[2])
{
    if (move[0] == 0 && move[1] == 0) return;
    for (size_t k = 0; k < 2 * n; k++) xy[k] += move[k & 1];
}

static bool are_equal(const double *a, const double *b, size_t n)
{
    for (size_t k = 0; k < n; k++)
        if (a[k] != b[k]) return false;
    return true;
}

/* ---- Polygons ---------------------------------------------------------------------------------------------------- */

static int by_ends(const void *a, const void *b)
{
    const double *p = a, *q = b;
    for (int k = 0; k < 4; k++)
        if (p[k] != q[k]) return p[k] < q[k] ? -1 : 1;
    return 0;
}

/* Lists the edges of a set, sorted, each with its lesser end first; those of length 0 are left out. */
static bool list_edges(const gis_polygons *set, double **edge, size_t *capacity, size_t *edges, gis_error *error)
{
    *edges = 0;
    if (set->vertices > *capacity) {
        double *more = realloc(*edge, 4 * set->vertices * sizeof *more);
        if (!more) return gis_no_memory(error);
        *edge = more;
        *capacity = set->vertices;
    }
    for (size_t r = 0, first = 0; r < set->rings; first = set->ring_end[r++])
        for (size_t v = first; v < set->ring_end[r]; v++) {
            const double *p = set->xy + 2 * v, *q = set->xy + 2 * (v + 1 < set->ring_end[r] ? v + 1 : first);
            if (p[0] == q[0] && p[1] == q[1]) continue;
            const bool in_order = p[0] < q[0] || (p[0] == q[0] && p[1] < q[1]);
            double *to = *edge + 4 * (*edges)++;
            memcpy(to, in_order ? p : q, 2 * sizeof *to);
            memcpy(to + 2, in_order ? q : p, 2 * sizeof *to);
        }
    if (*edges) qsort(*edge, *edges, 4 * sizeof **edge, by_ends);
    return true;
}

/* Do both sets have the same boundary? */
static bool compare_polygons(comparison *c, bool *same, gis_error *error)
{
    const gis_polygons *a = &c->is.set, *b = &c->was.set;
    size_t edges, edges_was;
    *same = a->vertices == b->vertices && a->rings == b->rings && are_equal(a->xy, b->xy, 2 * a->vertices) &&
            (!a->rings || memcmp(a->ring_end, b->ring_end, a->rings * sizeof *a->ring_end) == 0);
    if (*same) return true;
    if (!list_edges(a, &c->edge, &c->capacity, &edges, error) ||
        !list_edges(b, &c->edge_was, &c->capacity_was, &edges_was, error))
        return false;
    *same = edges == edges_was && are_equal(c->edge, c->edge_was, 4 * edges);
    return true;
}

/* ------------------------------------------------------------------------------------------------------------------ */

static bool compare_points(const comparison *c, size_t i, size_t was, bool *same, gis_error *error)
{
    double *xy = NULL, *xy_was = NULL;
    size_t n, n_was;
    const bool ok = gis_geometry_points(gis_source_geometry(c->now->source, i), &xy, &n, error) &&
                    gis_geometry_points(gis_source_geometry(c->before->source, was), &xy_was, &n_was, error);
    if (ok) {
        translate(xy, n, c->now->previous.move + 2 * i);
        *same = n == n_was && are_equal(xy, xy_was, 2 * n);
    }
    CPLFree(xy);
    CPLFree(xy_was);
    return ok;
}

/* Did the earlier run change the shape of this feature of the result? */
static bool was_shaped(const comparison *c, size_t was)
{
    if (c->level_field < 0 && c->cut_field < 0) return false;
    OGRFeatureH feature = gis_source_attributes(c->before->source, was);
    return (c->level_field >= 0 && OGR_F_GetFieldAsInteger(feature, c->level_field) != 0) ||
           (c->cut_field >= 0 && OGR_F_GetFieldAsDouble(feature, c->cut_field) != 0);
}

static bool compare(comparison *c, size_t i, bool *same, gis_error *error)
{
    const size_t was = c->now->previous.of[i];
    *same = was == SIZE_MAX || was_shaped(c, was);
    if (*same) return true;
    if (c->now->points) return compare_points(c, i, was, same, error);
    if (!gis_source_polygons(c->now->source, i, &c->is, error) ||
        !gis_source_polygons(c->before->source, was, &c->was, error))
        return false;
    if (c->is.linearised > 0 || c->was.linearised > 0) return compare_points(c, i, was, same, error);
    translate(c->is.set.xy, c->is.set.vertices, c->now->previous.move + 2 * i);
    return compare_polygons(c, same, error);
}

bool gis_previous_find_edits(const gis_layer_input *now, const gis_layer_input *before, bool *edited, gis_error *error)
{
    comparison c = {.now = now,
                    .before = before,
                    .level_field = gis_source_field(before->source, "sunder_lvl"),
                    .cut_field = gis_source_field(before->source, "sunder_cut")};
    bool ok = true, same;
    for (size_t i = 0; ok && i < now->n; i++) {
        ok = gis_go_on(error) && compare(&c, i, &same, error);
        edited[i] = ok && !same;
    }
    gis_polygonal_part_clear(&c.is);
    gis_polygonal_part_clear(&c.was);
    free(c.edge);
    free(c.edge_was);
    return ok;
}
