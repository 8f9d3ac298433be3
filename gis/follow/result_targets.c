/* result_targets.c: targets that are taken from the run that moves them, as they are written. */
#include "follow/follow.h"

#include "base/message.h"

#include <cpl_conv.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Sets what the features of a block have in common. */
static bool set_block(const gis_feature_row *row, char **block, gis_error *error)
{
    char text[32];
    if (row->block.kind != GIS_INTEGER) return true;
    snprintf(text, sizeof text, "%" PRId64, (int64_t)row->block.as.integer);
    *block = malloc(strlen(text) + 1);
    if (!*block) return gis_no_memory(error);
    strcpy(*block, text);
    return true;
}

/* Sets the polygons to those that are written; without any, the vertices before the move. */
static bool set_geometry(const gis_layer_input *own, size_t i, const gis_feature_row *row, gis_polygons *now,
                         gis_moved_feature *out, gis_error *error)
{
    gis_polygonal_part part = {0};
    out->now = now;
    if (row->other) return gis_polygons_append_shape(now, row->other, row->dx, row->dy, error);
    OGRGeometryH geometry = gis_source_geometry(own->source, i);
    bool ok = gis_geometry_polygonal_part(geometry, &part, error) && gis_polygons_append_all(now, &part.set, error);
    for (size_t k = 0; ok && k < now->vertices; k++) {
        now->xy[2 * k] += row->dx;
        now->xy[2 * k + 1] += row->dy;
    }
    gis_polygonal_part_clear(&part);
    return ok && (now->polygons || gis_geometry_points(geometry, &out->point, &out->points, error));
}

bool gis_follow_take(gis_follow_targets *targets, const gis_layer_input *own, bool layers, size_t i,
                     const gis_feature_row *row, gis_error *error)
{
    const char *name = gis_layer_name(own);
    const GIntBig fid = gis_source_fid(own->source, i);
    const gis_subject subject = {NULL, name, fid != OGRNullFID, fid, i, NULL};
    gis_moved_feature one = {.move = {row->dx, row->dy},
                             .hidden = row->status == SUNDER_FEATURE_HIDDEN,
                             .fid = fid,
                             .layer = layers ? name : NULL,
                             .subject = &subject};
    gis_polygons now = {0};
    const bool ok = set_block(row, &one.block, error) && set_geometry(own, i, row, &now, &one, error) &&
                    gis_follow_add(targets, &one, error);
    gis_polygons_clear(&now);
    return ok;
}
