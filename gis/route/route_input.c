/* route_input.c: reads the obstacles, from a layer of any geometry type or from a text, and the robot. Each feature is
 * one obstacle with all its geometry: polygons become a shape, lines and points become chains. */
#include "route/route_input.h"

#include "base/interrupt.h"
#include "base/message.h"
#include "geometry/wkt.h"
#include "read/crs_units.h"

#include <cpl_conv.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void gis_route_obstacle_name(const gis_route_input *input, size_t i, char *text, size_t size)
{
    if (!input->source) {
        snprintf(text, size, "OBSTACLES");
        return;
    }
    GIntBig fid = gis_source_fid(input->source, i);
    const gis_subject subject = {NULL, gis_source_name(input->source), fid != OGRNullFID, fid, i, NULL};
    gis_name_subject(&subject, text, size);
}

/* ---- Obstacles --------------------------------------------------------------------------------------------------- */

static bool make_room(gis_route_input *input, size_t n, gis_error *error)
{
    input->shape = calloc(n + 1, sizeof *input->shape);
    input->lines = calloc(n + 1, sizeof *input->lines);
    input->obstacle = calloc(n + 1, sizeof *input->obstacle);
    if (!input->shape || !input->lines || !input->obstacle) return gis_no_memory(error);
    input->n = n;
    return true;
}

/* Reads the polygons of a feature, treated as --invalid says, and its lines and points. */
static bool read_feature(gis_route_input *input, size_t i, OGRGeometryH geometry, gis_polygonal_part *part,
                         gis_error *error)
{
    char who[GIS_WHO_SIZE];
    bool arcs = false, invalid;
    if (!geometry) return true;
    gis_route_obstacle_name(input, i, who, sizeof who);
    if (!gis_geometry_polygonal_part(geometry, part, error) ||
        !gis_lines_append(geometry, &input->lines[i], &arcs, error))
        return false;
    if (part->linearised > 0)
        gis_say_warning(GIS_MESSAGE_ARCS, "%s: its arcs are taken as polylines that differ from them by up to %g", who,
                        part->linearised);
    if (arcs) gis_say_warning(GIS_MESSAGE_ARCS, "%s: the arcs of its lines are taken as polylines", who);
    return !part->set.polygons ||
           gis_shape_of_feature(&part->set, input->request->invalid, who, "", &input->shape[i], &invalid, error);
}

static bool read_layer(gis_route_input *input, gis_error *error)
{
    const char *path = input->request->obstacles, *meant = gis_shape_prefix_meant(path);
    gis_source_request selected = input->request->source;
    selected.path = path;
    selected.takes = GIS_TAKES_POLYGONS | GIS_TAKES_LINES | GIS_TAKES_POINTS;
    selected.not_finite = gis_invalid_not_finite(input->request->invalid, GIS_NOT_FINITE_LEFT_OUT);
    if (!gis_source_open(&selected, &input->source, error)) {
        if (meant && strstr(error->message, "no such file"))
            gis_fail(error, "OBSTACLES (%s): neither a file nor a shape; did you mean %s?", path, meant);
        return false;
    }
    gis_say_warnings(GIS_MESSAGE_INPUT, gis_source_warnings(input->source));
    input->crs = gis_source_crs(input->source);
    if (!make_room(input, gis_source_count(input->source), error)) return false;
    gis_polygonal_part part = {0};
    bool ok = true;
    for (size_t i = 0; ok && i < input->n; i++)
        ok = gis_go_on(error) && read_feature(input, i, gis_source_geometry(input->source, i), &part, error);
    gis_polygonal_part_clear(&part);
    return ok;
}

/* Returns whether the text is WKT of a type that gis_shape_from_text() does not support: points, lines or a
 * collection. */
static bool is_other_wkt(const char *text)
{
    static const char *const kinds[] = {"POINT", "MULTIPOINT", "LINESTRING", "MULTILINESTRING", "GEOMETRYCOLLECTION"};
    int srid;
    text = gis_wkt_after_srid(text, &srid);
    text += strspn(text, " \t\n\r");
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        size_t n = strlen(kinds[i]);
        if (EQUALN(text, kinds[i], n) && (text[n] == '(' || text[n] == ' ')) return true;
    }
    return false;
}

/* Reads obstacles given as WKT. Invalid WKT on the command line (`literal`) is a usage error, in a file it is not. */
static bool read_wkt(gis_route_input *input, const char *wkt, const char *who, bool literal, gis_error *error)
{
    int srid;
    char *at = CPLStrdup(gis_wkt_after_srid(wkt, &srid)), *rest = at;
    OGRGeometryH geometry = NULL;
    gis_polygonal_part part = {0};
    OGRErr status = OGR_G_CreateFromWkt(&rest, NULL, &geometry);
    bool ok = status == OGRERR_NONE && geometry && !rest[strspn(rest, " \t\r\n")];
    if (status == OGRERR_NOT_ENOUGH_MEMORY)
        ok = gis_no_memory(error);
    else if (!ok || !gis_geometry_is_finite(geometry))
        ok = literal ? gis_fail_usage(error, "OBSTACLES: this WKT cannot be read: %.60s", wkt)
                     : gis_fail(error, "%s: this WKT cannot be read: %.60s", who, wkt);
    ok = ok && read_feature(input, 0, geometry, &part, error);
    gis_polygonal_part_clear(&part);
    OGR_G_DestroyGeometry(geometry);
    CPLFree(at);
    return ok;
}

static bool read_text(gis_route_input *input, const char *text, gis_error *error)
{
    double unasked = 0;
    char who[GIS_SHAPE_NAME_SIZE], *held = NULL;
    const gis_invalid_policy policy = input->request->invalid;
    gis_shape_name("OBSTACLES", text, who, sizeof who);
    if (!make_room(input, 1, error) || (text[0] == '@' && !gis_shape_read_file(text + 1, who, &held, error)))
        return false;
    const char *wkt = held ? held : text;
    bool ok;
    if (is_other_wkt(wkt))
        ok = read_wkt(input, wkt, who, !held, error);
    else if (held)
        ok = gis_shape_of_wkt(wkt, who, policy, &input->shape[0], &unasked, error);
    else
        ok = gis_shape_from_text(text, "OBSTACLES", &input->units, policy, &input->shape[0], NULL, error);
    free(held);
    return ok;
}

/* ---- Reading the input ------------------------------------------------------------------------------------------- */

static void join_place(double box[4], double x, double y)
{
    box[0] = fmin(box[0], x), box[1] = fmin(box[1], y);
    box[2] = fmax(box[2], x), box[3] = fmax(box[3], y);
}

/* Warns if lengths in the CRS differ from lengths on the ground; the warning contains the local scale at the centre of
 * the obstacles. */
static void warn_of_crs(const gis_route_input *input)
{
    double box[4] = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    if (!input->crs) return;
    for (size_t i = 0; i < input->n; i++) {
        double one[4];
        for (size_t k = 0; k < input->lines[i].points; k++)
            join_place(box, input->lines[i].xy[2 * k], input->lines[i].xy[2 * k + 1]);
        if (!input->shape[i] || sunder_shape_is_empty(input->shape[i])) continue;
        sunder_shape_box(input->shape[i], one);
        join_place(box, one[0], one[1]);
        join_place(box, one[2], one[3]);
    }
    gis_crs_units_warn(input->crs, gis_source_name(input->source), box[0] <= box[2] ? box : NULL);
}

bool gis_route_input_read(const gis_route_request *request, gis_route_input *out, gis_error *error)
{
    *out = (gis_route_input){.request = request};
    bool text = gis_shape_is_text(request->obstacles);
    if (!text && !read_layer(out, error)) return false;
    out->units = gis_crs_units_of(out->crs, request->scale);
    if (text && !read_text(out, request->obstacles, error)) return false;
    warn_of_crs(out);
    if (!gis_shape_read(&request->robot, &out->units, out->crs, &out->robot_source, &out->robot, error) ||
        !gis_optional_length_in_layer_units(&request->gap, &out->units, "--gap", &out->gap, error))
        return false;
    for (size_t i = 0; i < out->n; i++)
        out->obstacle[i] = (sunder_obstacle){out->shape[i], out->lines[i].xy, out->lines[i].end, out->lines[i].lines};
    return true;
}

void gis_route_input_clear(gis_route_input *input)
{
    for (size_t i = 0; i < input->n; i++) {
        sunder_shape_free(input->shape[i]);
        gis_lines_clear(&input->lines[i]);
    }
    free(input->shape);
    free(input->lines);
    free(input->obstacle);
    sunder_shape_free(input->robot);
    gis_source_close(input->robot_source);
    gis_source_close(input->source);
    *input = (gis_route_input){0};
}

void gis_route_request_clear(gis_route_request *request)
{
    gis_coordinate_clear(&request->from);
    gis_coordinate_clear(&request->to);
}
