/* moved.c: reads MOVED, a layer that separate wrote, as targets. */
#include "follow/follow.h"

#include "base/interrupt.h"
#include "base/message.h"
#include "read/fields.h"

#include <cpl_conv.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct columns {
    int dx, dy, block, hidden;
    int key; /* the field that another layer's field names; -1: the FID is named */
} columns;

/* ---- The layer --------------------------------------------------------------------------------------------------- */

/* Is the layer a result of separate, or one that went along, and has the column sunder_to? */
static bool is_result(OGRLayerH layer, bool went_along)
{
    OGRFeatureDefnH fields = OGR_L_GetLayerDefn(layer);
    return OGR_FD_GetFieldIndex(fields, "sunder_dx") >= 0 && OGR_FD_GetFieldIndex(fields, "sunder_dy") >= 0 &&
           (OGR_FD_GetFieldIndex(fields, "sunder_to") >= 0) == went_along;
}

/* Counts the layers of that kind, and sets *name, to be freed with CPLFree(), to that of the first one. */
static size_t count_results(GDALDatasetH dataset, bool went_along, char **name)
{
    size_t found = 0;
    for (int i = 0; i < GDALDatasetGetLayerCount(dataset); i++) {
        OGRLayerH layer = GDALDatasetGetLayer(dataset, i);
        if (!layer || !is_result(layer, went_along)) continue;
        if (found++ == 0) *name = CPLStrdup(OGR_L_GetName(layer));
    }
    return found;
}

/* Sets *name likewise to that of the only layer that has the fields of a result; without such a layer, to that of the
 * only one that went along. It stays NULL if there is none or more than one, which opening the source with the name of
 * no layer reports. */
static bool find_layer(const gis_source_request *request, char **name, gis_error *error)
{
    GDALDatasetH dataset =
        GDALOpenEx(request->path, GDAL_OF_VECTOR | GDAL_OF_READONLY, request->drivers, request->open_options, NULL);
    size_t found = dataset ? count_results(dataset, false, name) : 0;
    bool ok = true;
    if (dataset && found == 0) found = count_results(dataset, true, name);
    if (dataset && found != 1) {
        ok = gis_fail_usage(error, "MOVED (%s): %s has the fields sunder_dx and sunder_dy of a result of separate",
                            request->path, found ? "more than one layer" : "no layer");
        CPLFree(*name);
        *name = NULL;
    }
    GDALClose(dataset);
    return ok;
}

static bool open_moved(const gis_follow_request *request, gis_source **out, gis_error *error)
{
    gis_source_request moved = request->moved;
    char *name = NULL;
    bool ok = find_layer(&moved, &name, error);
    moved.layer = name;
    moved.takes = GIS_TAKES_POLYGONS | GIS_TAKES_POINTS;
    moved.not_finite = GIS_NOT_FINITE_LEFT_OUT;
    ok = ok && gis_source_open(&moved, out, error);
    CPLFree(name);
    if (ok) gis_say_warnings(GIS_MESSAGE_INPUT, gis_source_warnings(*out));
    return ok;
}

/* ---- Features ---------------------------------------------------------------------------------------------------- */

static bool read_move(const gis_source *source, size_t i, const columns *at, const gis_subject *subject, double move[2],
                      gis_error *error)
{
    OGRFeatureH feature = gis_source_feature(source, i);
    const int field[2] = {at->dx, at->dy};
    for (int k = 0; k < 2; k++) {
        move[k] = 0;
        if (gis_field_is_blank(feature, field[k])) continue; /* a skipped feature, which did not move */
        move[k] = gis_field_number(feature, field[k]);
        if (isfinite(move[k])) continue;
        char who[GIS_WHO_SIZE], value[GIS_FIELD_TEXT_SIZE];
        gis_name_subject(subject, who, sizeof who);
        gis_field_text(feature, field[k], value);
        return gis_fail(error, "%s: %s is %s, which is no move", who, k ? "sunder_dy" : "sunder_dx", value);
    }
    return true;
}

/* Reads the text of a field that is not blank; *text stays NULL if it is. */
static bool read_text(OGRFeatureH feature, int field, char **text, gis_error *error)
{
    if (field < 0 || gis_field_is_blank(feature, field)) return true;
    *text = gis_field_key(feature, field);
    return *text || gis_no_memory(error);
}

/* Reads the geometry: its polygons or, if it has none, its vertices, taken back by the move. */
static bool read_geometry(const gis_source *source, size_t i, gis_polygonal_part *part, gis_moved_feature *out,
                          gis_error *error)
{
    OGRGeometryH geometry = gis_source_geometry(source, i);
    out->now = &part->set;
    if (!gis_geometry_polygonal_part(geometry, part, error)) return false;
    if (part->set.polygons) return true;
    if (!gis_geometry_points(geometry, &out->point, &out->points, error)) return false;
    for (size_t k = 0; k < 2 * out->points; k++) out->point[k] -= out->move[k & 1];
    return true;
}

static bool read_feature(gis_follow *follow, gis_follow_targets *targets, size_t i, const columns *at,
                         gis_polygonal_part *part, gis_error *error)
{
    const gis_source *source = follow->moved;
    OGRFeatureH feature = gis_source_feature(source, i);
    const GIntBig fid = gis_source_fid(source, i);
    const gis_subject subject = {"MOVED", gis_source_name(source), fid != OGRNullFID, fid, i, NULL};
    gis_moved_feature one = {.fid = fid, .subject = &subject};
    one.hidden =
        at->hidden >= 0 && !gis_field_is_blank(feature, at->hidden) && gis_field_number(feature, at->hidden) != 0;
    return read_move(source, i, at, &subject, one.move, error) && read_text(feature, at->block, &one.block, error) &&
           read_geometry(source, i, part, &one, error) && gis_follow_add(targets, &one, error) &&
           gis_follow_add_key(follow, feature, at->key, fid, error);
}

/* ------------------------------------------------------------------------------------------------------------------ */

bool gis_follow_read_moved(gis_follow *follow, gis_follow_targets *out, gis_error *error)
{
    const gis_follow_request *request = follow->request;
    if (!open_moved(request, &follow->moved, error)) return false;
    const gis_source *source = follow->moved;
    columns at = {gis_source_field(source, "sunder_dx"), gis_source_field(source, "sunder_dy"),
                  gis_source_field(source, "sunder_blk"), gis_source_field(source, "sunder_inv"), -1};
    gis_polygonal_part part = {0};
    bool ok = gis_field_find(source, "--id-field", request->id_field, &at.key, error);
    for (size_t i = 0; ok && i < gis_source_count(source); i++)
        ok = gis_go_on(error) && read_feature(follow, out, i, &at, &part, error);
    gis_polygonal_part_clear(&part);
    return ok && gis_follow_complete(out, error);
}
