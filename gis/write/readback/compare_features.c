/* compare_features.c: compares the features of a written layer, as they read back, with the features that were sent.
 *
 * Formats may reverse the rings of a polygon, start them at another vertex, or reorder holes and members; the point set
 * stays the same. So both sides are brought to a normal form (each ring begins at its smallest vertex and continues to
 * the smaller of its neighbours; holes and members are sorted) and compared double by double. A different grouping of
 * rings into members counts as a difference. */
#include "write/sink/sink_internal.h"

#include "base/interrupt.h"

#include <cpl_conv.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- One form for polygons --------------------------------------------------------------------------------------- */

typedef struct ring_view {
    const double *xy;
    size_t n; /* number of vertices without the closing one */
    size_t first;
    bool backward;
} ring_view;

static const double *ring_vertex(const ring_view *ring, size_t i)
{
    size_t k = ring->backward ? (ring->first + ring->n - i % ring->n) % ring->n : (ring->first + i) % ring->n;
    return ring->xy + 2 * k;
}

static int compare_points(const double *p, const double *q)
{
    if (p[0] != q[0]) return p[0] < q[0] ? -1 : 1;
    return (p[1] > q[1]) - (p[1] < q[1]);
}

static int compare_rings(const ring_view *a, const ring_view *b)
{
    if (a->n != b->n) return a->n < b->n ? -1 : 1;
    for (size_t i = 0; i < a->n; i++) {
        int order = compare_points(ring_vertex(a, i), ring_vertex(b, i));
        if (order) return order;
    }
    return 0;
}

/* The normal form of a ring: it begins at the smallest vertex. A ring that visits this vertex several times has several
 * candidates, and the lexicographically smallest sequence of vertices is taken. Rings touch themselves rarely and in
 * few places, so trying all candidates is cheap. */
static ring_view normal_ring(const double *xy, size_t n)
{
    if (n > 1 && compare_points(xy, xy + 2 * (n - 1)) == 0) n--;
    ring_view best = {xy, n, 0, false};
    size_t smallest = 0;
    for (size_t i = 1; i < n; i++)
        if (compare_points(xy + 2 * i, xy + 2 * smallest) < 0) smallest = i;
    bool any = false;
    for (size_t i = smallest; i < n; i++) {
        if (compare_points(xy + 2 * i, xy + 2 * smallest) != 0) continue;
        for (int backward = 0; backward < 2; backward++) {
            ring_view candidate = {xy, n, i, backward != 0};
            if (!any || compare_rings(&candidate, &best) < 0) best = candidate;
            any = true;
        }
    }
    return best;
}

static int order_rings(const void *a, const void *b) { return compare_rings(a, b); }

typedef struct member {
    ring_view *rings; /* the outer ring first, then the holes in sorted order */
    size_t n;
} member;

static int order_members(const void *a, const void *b)
{
    const member *p = a, *q = b;
    if (p->n != q->n) return p->n < q->n ? -1 : 1;
    for (size_t r = 0; r < p->n; r++) {
        int order = compare_rings(&p->rings[r], &q->rings[r]);
        if (order) return order;
    }
    return 0;
}

/* Fills `members` and, with their rings, `views` with the normal form of `rings`; both arrays must be large enough. */
static void normalise_polygons(const gis_polygons *rings, member *members, ring_view *views)
{
    size_t r = 0;
    for (size_t p = 0; p < rings->polygons; p++) {
        size_t first = r;
        for (; r < rings->poly_end[p]; r++) {
            size_t start = r ? rings->ring_end[r - 1] : 0;
            views[r] = normal_ring(rings->xy + 2 * start, rings->ring_end[r] - start);
        }
        members[p] = (member){views + first, r - first};
        if (r - first > 2) qsort(views + first + 1, r - first - 1, sizeof *views, order_rings);
    }
    qsort(members, rings->polygons, sizeof *members, order_members);
}

static bool polygons_identical(const gis_polygons *a, const gis_polygons *b)
{
    return a->vertices == b->vertices && a->rings == b->rings && a->polygons == b->polygons &&
           (!a->polygons || (memcmp(a->poly_end, b->poly_end, a->polygons * sizeof *a->poly_end) == 0 &&
                             memcmp(a->ring_end, b->ring_end, a->rings * sizeof *a->ring_end) == 0 &&
                             memcmp(a->xy, b->xy, 2 * a->vertices * sizeof *a->xy) == 0));
}

static bool same_polygons(const gis_polygons *a, const gis_polygons *b, bool *same, gis_error *error)
{
    *same = polygons_identical(a, b);
    if (*same || a->polygons != b->polygons || a->rings != b->rings) return true;
    member *members = malloc((2 * a->polygons + 1) * sizeof *members);
    ring_view *views = malloc((2 * a->rings + 1) * sizeof *views);
    if (members && views) {
        normalise_polygons(a, members, views);
        normalise_polygons(b, members + a->polygons, views + a->rings);
        *same = true;
        for (size_t p = 0; *same && p < a->polygons; p++)
            *same = order_members(&members[p], &members[a->polygons + p]) == 0;
    }
    bool done = members && views;
    free(members);
    free(views);
    return done || gis_no_memory(error);
}

/* ---- How far off ------------------------------------------------------------------------------------------------- */

/* The largest distance from a vertex of `a` to its nearest vertex of `b`. Quadratic time; called only if a and b
 * differ. */
static double vertex_distance(const gis_polygons *a, const gis_polygons *b)
{
    double largest = 0;
    for (size_t i = 0; i < a->vertices && !gis_interrupted(); i++) {
        double nearest = INFINITY;
        for (size_t k = 0; k < b->vertices; k++)
            nearest = fmin(nearest, hypot(a->xy[2 * i] - b->xy[2 * k], a->xy[2 * i + 1] - b->xy[2 * k + 1]));
        largest = fmax(largest, nearest);
    }
    return largest;
}

static bool any_elsewhere(const gis_polygons *a, const gis_polygons *b)
{
    return vertex_distance(a, b) > 0 || vertex_distance(b, a) > 0;
}

static double polygon_deviation(const gis_polygons *a, const gis_polygons *b)
{
    if (a->polygons != b->polygons || a->rings != b->rings || a->vertices != b->vertices) return INFINITY;
    return fmax(vertex_distance(a, b), vertex_distance(b, a));
}

/* The geometry of the source's feature, if that geometry was sent (before its move); NULL if another geometry was sent,
 * or none. */
static OGRGeometryH own_geometry(const gis_sink_layer *layer, const gis_sent *sent)
{
    OGRGeometryH own = sent->feature && sent->moved ? OGR_F_GetGeometryRef(sent->feature) : NULL;
    return own && gis_sink_holds(layer, own) ? own : NULL;
}

/* ---- One feature ------------------------------------------------------------------------------------------------- */

typedef struct workspace {
    gis_polygonal_part sent, kept;
    bool keeps_vertices; /* the format keeps vertices, so a changed vertex means damage */
    bool damaged;
} workspace;

static void note_difference(gis_sink_result *result, double deviation)
{
    result->exact = false;
    result->deviation = fmax(result->deviation, deviation);
}

/* Compares points or lines, whose vertices keep their order in all formats. */
static bool compare_vertices(OGRGeometryH sent, OGRGeometryH kept, workspace *work, gis_sink_result *result,
                             gis_error *error)
{
    double *a = NULL, *b = NULL;
    size_t n_a = 0, n_b = 0;
    bool done = gis_geometry_points(sent, &a, &n_a, error) && gis_geometry_points(kept, &b, &n_b, error);
    if (done && n_a != n_b) note_difference(result, INFINITY);
    for (size_t i = 0; done && n_a == n_b && i < n_a; i++)
        if (compare_points(a + 2 * i, b + 2 * i) != 0)
            note_difference(result, hypot(a[2 * i] - b[2 * i], a[2 * i + 1] - b[2 * i + 1]));
    work->damaged = work->damaged || (work->keeps_vertices && !result->exact);
    CPLFree(a);
    CPLFree(b);
    return done;
}

static bool compare_geometries(OGRGeometryH sent, OGRGeometryH kept, workspace *work, gis_sink_result *result,
                               gis_error *error)
{
    gis_content content = gis_geometry_content(sent);
    if (content != gis_geometry_content(kept)) {
        work->damaged = work->damaged || work->keeps_vertices;
        note_difference(result, INFINITY);
        return true;
    }
    if (content == GIS_NOTHING) return true;
    if (content != GIS_POLYGONS) return compare_vertices(sent, kept, work, result, error);
    bool same;
    if (!gis_geometry_polygonal_part(sent, &work->sent, error) ||
        !gis_geometry_polygonal_part(kept, &work->kept, error) ||
        !same_polygons(&work->sent.set, &work->kept.set, &same, error))
        return false;
    if (!same) /* rings that were only regrouped into other members have all their vertices */
        work->damaged = work->damaged || (work->keeps_vertices && any_elsewhere(&work->sent.set, &work->kept.set));
    if (!same) note_difference(result, polygon_deviation(&work->sent.set, &work->kept.set));
    return true;
}

static bool compare_sent(const gis_sink_layer *layer, const gis_sent *sent, OGRGeometryH kept, workspace *work,
                         gis_sink_result *result, gis_error *error)
{
    OGRGeometryH own = own_geometry(layer, sent);
    if (!own || (sent->dx == 0 && sent->dy == 0))
        return compare_geometries(own ? own : sent->made, kept, work, result, error);
    OGRGeometryH moved = OGR_G_Clone(own);
    bool done = moved && gis_geometry_translate(moved, sent->dx, sent->dy, error) &&
                compare_geometries(moved, kept, work, result, error);
    OGR_G_DestroyGeometry(moved);
    return done || (!moved && gis_no_memory(error));
}

/* Notes a loss if the driver dropped the Z values, the M values or the whole geometry of a feature without an error. */
static void find_dropped(const gis_sink_layer *layer, const gis_sent *sent, OGRGeometryH kept)
{
    OGRGeometryH geometry = sent->made ? sent->made : own_geometry(layer, sent);
    if (!gis_sink_tells(layer) || !geometry || OGR_G_IsEmpty(geometry)) return;
    gis_sentences *losses = &layer->sink->losses;
    const char *format = layer->sink->format.name;
    if (!kept || OGR_G_IsEmpty(kept)) {
        gis_sentences_add(losses, "geometries are not written: %s cannot hold them", format);
        return;
    }
    if (OGR_G_Is3D(geometry) && !OGR_G_Is3D(kept))
        gis_sentences_add(losses, "Z values are not written: %s has none", format);
    if (OGR_G_IsMeasured(geometry) && !OGR_G_IsMeasured(kept))
        gis_sentences_add(losses, "M values are not written: %s has none", format);
}

/* ---- The layer --------------------------------------------------------------------------------------------------- */

static bool fail_damaged(const gis_sink_layer *layer, size_t feature, gis_error *error)
{
    return gis_fail(error, "%s, layer %s: feature %zu does not read back as it was written; is the disk full?",
                    layer->sink->request.path, layer->name, feature);
}

static bool compare_features(gis_sink_layer *layer, OGRLayerH as_written, workspace *work, gis_sink_result *result,
                             gis_error *error)
{
    size_t i = 0;
    bool done = true;
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    OGR_L_ResetReading(as_written);
    for (OGRFeatureH kept; done && (kept = OGR_L_GetNextFeature(as_written)) != NULL; i++) {
        if (i < layer->n_sent) {
            const gis_sent *sent = &layer->sent[i];
            done = compare_sent(layer, sent, OGR_F_GetGeometryRef(kept), work, result, error) && gis_go_on(error);
            if (done && work->damaged) done = fail_damaged(layer, i + 1, error);
            find_dropped(layer, sent, OGR_F_GetGeometryRef(kept));
            if (done) done = gis_sink_compare_values(layer, i, kept, error);
        }
        OGR_F_Destroy(kept);
    }
    gis_listen_end();
    if (done && listener.failures)
        done = gis_sink_fail_reading(layer, i, gis_listener_reason(&listener, "no reason given"), error);
    else if (done && i != layer->n_sent)
        done = gis_sink_fail_count(layer, i, error);
    gis_listener_clear(&listener);
    return done;
}

bool gis_sink_compare(gis_sink_layer *layer, OGRLayerH as_written, gis_sink_result *result, gis_error *error)
{
    if (layer->sink->format.keeps_order && !gis_sink_begin_values(layer, as_written, error)) return false;
    workspace work = {.keeps_vertices = layer->sink->format.keeps_vertices};
    bool done = compare_features(layer, as_written, &work, result, error);
    gis_polygonal_part_clear(&work.sent);
    gis_polygonal_part_clear(&work.kept);
    return done;
}
