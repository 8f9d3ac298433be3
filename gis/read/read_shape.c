/* read_shape.c: see read_shape.h. The polygons of a layer are validated feature by feature, so that messages can name
 * the one at fault, and then joined to one set: read strictly if all are valid, by the even-odd rule if one had to be
 * repaired. */
#include "read/read_shape.h"

#include "base/core_error.h"
#include "base/interrupt.h"
#include "base/message.h"
#include "base/resources.h"
#include "read/crs_units.h"

#include <cpl_conv.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Appends the polygons of feature i, which is validated by itself according to --invalid. */
static bool append_feature(const gis_source *source, size_t i, const gis_polygonal_part *part,
                           gis_invalid_policy policy, gis_polygons *all, bool *any_invalid, gis_error *error)
{
    char who[GIS_WHO_SIZE];
    GIntBig fid = gis_source_fid(source, i);
    const gis_subject subject = {NULL, gis_source_name(source), fid != OGRNullFID, fid, i, NULL};
    gis_name_subject(&subject, who, sizeof who);
    if (part->linearised > 0)
        gis_say_warning(GIS_MESSAGE_ARCS, "%s: its arcs are taken as polylines that differ from them by up to %g", who,
                        part->linearised);
    sunder_shape *alone = NULL;
    bool invalid;
    if (!gis_shape_of_feature(&part->set, policy, who, "", &alone, &invalid, error)) return false;
    if (!alone) /* skipped, with a warning */
        return true;
    sunder_shape_free(alone);
    *any_invalid = *any_invalid || invalid;
    return gis_polygons_append_all(all, &part->set, error);
}

static bool shape_of_layer(const gis_source *source, gis_invalid_policy policy, const char *who, sunder_shape **out,
                           double *building, gis_error *error)
{
    gis_polygons all = {0};
    gis_polygonal_part part = {0};
    bool ok = true, any_invalid = false;
    for (size_t i = 0; ok && i < gis_source_count(source); i++)
        if (gis_source_content(source, i) == GIS_POLYGONS)
            ok = gis_go_on(error) && gis_geometry_polygonal_part(gis_source_geometry(source, i), &part, error) &&
                 append_feature(source, i, &part, policy, &all, &any_invalid, error);
    if (ok) {
        sunder_error why;
        double begin = gis_clock();
        const sunder_validity validity = any_invalid ? SUNDER_VALIDITY_EVEN_ODD : SUNDER_VALIDITY_STRICT;
        ok = gis_polygons_shape(&all, validity, out, &why) == SUNDER_OK || gis_core_failed(error, who, &why);
        if (building) *building += gis_clock() - begin;
    }
    gis_polygonal_part_clear(&part);
    gis_polygons_clear(&all);
    return ok;
}

bool gis_shape_from_source(const gis_source_request *request, gis_invalid_policy policy, const char *who,
                           gis_source **source, sunder_shape **out, double *building, gis_error *error)
{
    gis_source_request polygons = *request;
    polygons.takes = GIS_TAKES_POLYGONS;
    polygons.not_finite = gis_invalid_not_finite(policy, GIS_NOT_FINITE_LEFT_OUT);
    gis_source *opened;
    const char *meant = gis_shape_prefix_meant(request->path);
    if (!gis_source_open(&polygons, &opened, error)) {
        if (meant && access(request->path, F_OK) != 0)
            gis_fail(error, "%s (%s): neither a file nor a shape; did you mean %s?", who, request->path, meant);
        return false;
    }
    gis_say_warnings(GIS_MESSAGE_INPUT, gis_source_warnings(opened));
    if (!shape_of_layer(opened, policy, who, out, building, error)) {
        gis_source_close(opened);
        return false;
    }
    *source = opened;
    return true;
}

bool gis_shape_read(const gis_shape_request *request, const gis_crs_units *units, OGRSpatialReferenceH crs,
                    gis_source **source, sunder_shape **out, gis_error *error)
{
    const char *name = request->option, *text = request->text;
    gis_source *opened = NULL;
    sunder_shape *shape = NULL;
    bool ok;
    if (gis_shape_is_text(text)) {
        ok = gis_shape_from_text(text, name, units, request->invalid, &shape, NULL, error);
    } else {
        const gis_source_request whole = {.path = text};
        ok = gis_shape_from_source(&whole, request->invalid, name, &opened, &shape, NULL, error) &&
             (gis_crs_may_be_same(crs, gis_source_crs(opened)) ||
              gis_fail(error, "%s %s has another CRS than the layer; reproject one of them first", name, text));
    }
    if (ok && sunder_shape_is_empty(shape)) ok = gis_fail_usage(error, "%s %s: it has no area", name, text);
    if (!ok) {
        sunder_shape_free(shape);
        gis_source_close(opened);
        return false;
    }
    *out = shape;
    if (opened) *source = opened;
    return true;
}
