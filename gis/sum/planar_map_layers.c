/* planar_map_layers.c: writes the planar map of a sum as layers for inspection. Each vertex is rounded once, so that
 * edges and faces that meet in the map also meet in the layers; a face that rounding made invalid is repaired like a
 * polygon of a sum. */
#include "sum/sum_layers.h"

#include "base/interrupt.h"
#include "geometry/geometry.h"
#include "geometry/round/steps.h"

#include <math.h>
#include <stdlib.h>

typedef struct map_run {
    const sunder_map *map;
    double *xy; /* [2 * vertices] the rounded coordinates of all vertices */
    bool *done; /* [half-edges] whether a half-edge is part of a ring already */
    gis_polygons face;
} map_run;

static gis_value covered_by(uint32_t n) { return (gis_value){.kind = GIS_INTEGER, .as.integer = (GIntBig)n}; }

static const double *half_edge_vertex(const map_run *run, uint32_t half)
{
    return run->xy + 2 * (size_t)sunder_map_origin(run->map, half);
}

/* ---- Faces ------------------------------------------------------------------------------------------------------- */

/* Returns whether the half-edge separates two faces. (An antenna has the same face on both sides.) */
static bool is_side(const sunder_map *map, uint32_t half)
{
    return sunder_map_face(map, half) != sunder_map_face(map, sunder_map_twin(half));
}

/* Returns the next half-edge of a ring. At a vertex the ring turns so that the angle between the two half-edges is
 * outside of the face; hence rings of a face meet in points only. */
static uint32_t next_side(const sunder_map *map, uint32_t half)
{
    uint32_t face = sunder_map_face(map, half), next = sunder_map_twin(half);
    do next = sunder_map_turn(map, next);
    while (sunder_map_face(map, next) != face || !is_side(map, next));
    return next;
}

/* Appends the ring that contains the half-edge `start`, in doubles, unless rounding leaves it without area. */
static bool append_ring(map_run *run, uint32_t start, gis_error *error)
{
    size_t first = run->face.vertices;
    uint32_t half = start;
    do {
        const double *xy = half_edge_vertex(run, half);
        const double *last = run->face.vertices > first ? run->face.xy + 2 * (run->face.vertices - 1) : NULL;
        if ((!last || last[0] != xy[0] || last[1] != xy[1]) && !gis_polygons_vertex(&run->face, xy[0], xy[1], error))
            return false;
        run->done[half] = true;
        half = next_side(run->map, half);
    } while (half != start);
    bool kept;
    return gis_end_ring_with_area(&run->face, first, &kept, error);
}

static bool append_cycle(map_run *run, uint32_t start, gis_error *error)
{
    uint32_t half = start;
    do {
        if (!run->done[half] && is_side(run->map, half) && !append_ring(run, half, error)) return false;
        half = sunder_map_next(run->map, half);
    } while (half != start);
    return true;
}

/* Returns the half-edge of a cycle that separates two faces and leaves the smallest vertex; on an outer boundary it
 * belongs to the outer ring. Returns SUNDER_NOWHERE if the cycle has antennas only. */
static uint32_t first_side(const map_run *run, uint32_t start)
{
    uint32_t best = SUNDER_NOWHERE, half = start;
    do {
        const double *a = half_edge_vertex(run, half), *b = best == SUNDER_NOWHERE ? NULL : half_edge_vertex(run, best);
        if (is_side(run->map, half) && (!b || a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]))) best = half;
        half = sunder_map_next(run->map, half);
    } while (half != start);
    return best;
}

/* Sets run->face to the rings of a face, the outer one first. If rounding made it invalid it is repaired. */
static bool gather_face(map_run *run, uint32_t face, gis_error *error)
{
    run->face.vertices = run->face.rings = run->face.polygons = 0;
    uint32_t outer = sunder_map_outer(run->map, face), side = first_side(run, outer);
    if (side != SUNDER_NOWHERE && (!append_ring(run, side, error) || !append_cycle(run, outer, error))) return false;
    size_t n;
    const uint32_t *inner = sunder_map_inner(run->map, face, &n);
    for (size_t i = 0; i < n; i++)
        if (!append_cycle(run, inner[i], error)) return false;
    if (!run->face.rings) return true;
    double moved = 0;
    size_t repaired = 0;
    return gis_end_valid_polygon(&run->face, 0, &moved, &repaired, error);
}

static bool write_face(gis_sink_layer *layer, map_run *run, uint32_t face, gis_error *error)
{
    const gis_value value = covered_by(sunder_map_face_covered(run->map, face));
    return gather_face(run, face, error) && gis_write_polygons(layer, &run->face, &value, error);
}

/* ---- Layers ------------------------------------------------------------------------------------------------------ */

static bool write_faces(gis_sink_layer *layer, map_run *run, gis_error *error)
{
    for (uint32_t f = 1; f < sunder_map_faces(run->map); f++)
        if (!write_face(layer, run, f, error)) return false;
    return true;
}

static bool write_edges(gis_sink_layer *layer, map_run *run, gis_error *error)
{
    for (uint32_t e = 0; e < sunder_map_edges(run->map); e++) {
        gis_value value = covered_by(sunder_map_edge_covered(run->map, e));
        OGRGeometryH line = gis_geometry_line(half_edge_vertex(run, 2 * e), half_edge_vertex(run, 2 * e + 1));
        if (!line) return gis_no_memory(error);
        if (!gis_sink_write(layer, NULL, line, &value, error)) return false;
    }
    return true;
}

static bool write_vertices(gis_sink_layer *layer, map_run *run, gis_error *error)
{
    for (uint32_t v = 0; v < sunder_map_vertices(run->map); v++) {
        gis_value value = covered_by(sunder_map_vertex_covered(run->map, v));
        OGRGeometryH point = gis_geometry_point(run->xy + 2 * (size_t)v);
        if (!point) return gis_no_memory(error);
        if (!gis_sink_write(layer, NULL, point, &value, error)) return false;
    }
    return true;
}

static bool place_vertices(map_run *run, gis_error *error)
{
    for (uint32_t v = 0; v < sunder_map_vertices(run->map); v++) {
        double *xy = run->xy + 2 * (size_t)v;
        sunder_map_vertex(run->map, v, xy);
        if (!gis_go_on(error)) return false;
        if (!isfinite(xy[0]) || !isfinite(xy[1])) return gis_fail(error, "the planar map leaves the range of doubles");
    }
    return true;
}

static bool write_layers(gis_sink *sink, map_run *run, OGRSpatialReferenceH crs, gis_error *error)
{
    static const gis_field field = {"covered_by", OFTInteger64, 0};
    static const struct {
        const char *suffix;
        OGRwkbGeometryType type;
        bool (*write)(gis_sink_layer *layer, map_run *run, gis_error *error);
    } layers[] = {{"faces", wkbPolygon, write_faces},
                  {"edges", wkbLineString, write_edges},
                  {"vertices", wkbPoint, write_vertices}};
    for (size_t i = 0; i < sizeof layers / sizeof *layers; i++) {
        gis_sink_layer_request request = {.suffix = layers[i].suffix,
                                          .type = layers[i].type,
                                          .crs = crs,
                                          .fields = &field,
                                          .n_fields = 1,
                                          .style = GIS_STYLE_NONE};
        gis_sink_layer *layer;
        if (!gis_sink_add(sink, &request, &layer, error) || !layers[i].write(layer, run, error)) return false;
    }
    return true;
}

bool gis_write_map(gis_sink *sink, const sunder_map *map, OGRSpatialReferenceH crs, gis_error *error)
{
    map_run run = {.map = map,
                   .xy = malloc((sunder_map_vertices(map) + 1) * 2 * sizeof *run.xy),
                   .done = calloc(2 * sunder_map_edges(map) + 1, sizeof *run.done)};
    bool ok = (run.xy && run.done) || gis_no_memory(error);
    ok = ok && place_vertices(&run, error) && write_layers(sink, &run, crs, error);
    free(run.xy);
    free(run.done);
    gis_polygons_clear(&run.face);
    return ok;
}
