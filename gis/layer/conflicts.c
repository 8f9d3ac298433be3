/* conflicts.c: one conflict as a row, and the layer of conflicts. check prints the same rows as lines. */
#include "layer/output.h"

#include <cpl_conv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

gis_value gis_fid_value(const gis_layer_input *input, size_t feature)
{
    GIntBig fid = gis_source_fid(input->source, feature);
    return fid == OGRNullFID ? (gis_value){.kind = GIS_NULL} : (gis_value){GIS_INTEGER, {.integer = fid}};
}

bool gis_id_value(const gis_layer_input *input, size_t i, char **copy, gis_value *value, gis_error *error)
{
    OGRFeatureH feature = gis_source_feature(input->source, i);
    *value = (gis_value){.kind = GIS_NULL};
    if (input->id_field < 0 || !OGR_F_IsFieldSetAndNotNull(feature, input->id_field)) return true;
    switch (gis_id_type(input)) {
    case OFTInteger64:
        *value = (gis_value){GIS_INTEGER, {.integer = OGR_F_GetFieldAsInteger64(feature, input->id_field)}};
        return true;
    case OFTReal:
        *value = (gis_value){GIS_REAL, {.real = OGR_F_GetFieldAsDouble(feature, input->id_field)}};
        return true;
    default: break;
    }
    const char *text = OGR_F_GetFieldAsString(feature, input->id_field);
    char *copied = malloc(strlen(text) + 1);
    if (!copied) return gis_no_memory(error);
    free(*copy);
    *copy = strcpy(copied, text);
    *value = (gis_value){GIS_TEXT, {.text = copied}};
    return true;
}

/* FIDs of what stands in the way, with commas. */
static bool blockers(const gis_layer_input *input, const sunder_conflict *conflict, char **copy, gis_value *value,
                     gis_error *error)
{
    *value = (gis_value){.kind = GIS_NULL};
    if (conflict->n_blocked_by == 0) return true;
    size_t size = conflict->n_blocked_by * 22 + 1, length = 0;
    char *text = malloc(size);
    if (!text) return gis_no_memory(error);
    for (size_t k = 0; k < conflict->n_blocked_by; k++)
        length += (size_t)snprintf(text + length, size - length, "%s" CPL_FRMT_GIB, k ? "," : "",
                                   gis_source_fid(input->source, conflict->blocked_by[k]));
    free(*copy);
    *copy = text;
    *value = (gis_value){GIS_TEXT, {.text = text}};
    return true;
}

OGRFieldType gis_id_type(const gis_layer_input *input)
{
    if (input->id_field < 0) return OFTString;
    OGRFieldDefnH field = OGR_FD_GetFieldDefn(OGR_L_GetLayerDefn(gis_source_layer(input->source)), input->id_field);
    switch (OGR_Fld_GetType(field)) {
    case OFTInteger:
    case OFTInteger64: return OFTInteger64;
    case OFTReal: return OFTReal;
    default: return OFTString;
    }
}

bool gis_conflict_values(const gis_layer_input *input, const sunder_conflict *conflict, gis_conflict_texts *scratch,
                         gis_value values[N_CONFLICT_COLUMNS], gis_error *error)
{
    const char *reason = sunder_reason_string(conflict->reason);
    values[COLUMN_FID_A] = gis_fid_value(input, conflict->a);
    values[COLUMN_FID_B] = gis_fid_value(input, conflict->b);
    values[COLUMN_BARRIER] = (gis_value){.kind = GIS_NULL};
    values[COLUMN_BARR_FID] = (gis_value){.kind = GIS_NULL};
    values[COLUMN_KIND] = (gis_value){GIS_TEXT, {.text = sunder_conflict_kind_string(conflict->kind)}};
    values[COLUMN_REASON] = *reason ? (gis_value){GIS_TEXT, {.text = reason}} : (gis_value){.kind = GIS_NULL};
    values[COLUMN_DISTANCE] = (gis_value){GIS_REAL, {.real = conflict->distance}};
    values[COLUMN_BEFORE] = (gis_value){GIS_REAL, {.real = conflict->before}};
    values[COLUMN_DEPTH] = (gis_value){GIS_REAL, {.real = conflict->depth}};
    values[COLUMN_REQUIRED] = (gis_value){GIS_REAL, {.real = conflict->required}};
    return gis_id_value(input, conflict->a, &scratch->id[0], &values[COLUMN_ID_A], error) &&
           gis_id_value(input, conflict->b, &scratch->id[1], &values[COLUMN_ID_B], error) &&
           blockers(input, conflict, &scratch->blocked_by, &values[COLUMN_BLOCKED_BY], error);
}

void gis_conflict_texts_clear(gis_conflict_texts *scratch)
{
    free(scratch->id[0]);
    free(scratch->id[1]);
    free(scratch->blocked_by);
    *scratch = (gis_conflict_texts){0};
}

bool gis_write_conflicts(gis_sink *sink, const gis_layer_input *input, const sunder_report *report, const char *suffix,
                         gis_error *error)
{
    OGRFieldType id = gis_id_type(input);
    const gis_field fields[N_CONFLICT_COLUMNS] = {
        [COLUMN_FID_A] = {"fid_a", OFTInteger64, 0},
        [COLUMN_ID_A] = {"id_a", id, 0},
        [COLUMN_FID_B] = {"fid_b", OFTInteger64, 0},
        [COLUMN_ID_B] = {"id_b", id, 0},
        [COLUMN_BARRIER] = {"barrier", OFTString, 0},
        [COLUMN_BARR_FID] = {"barr_fid", OFTInteger64, 0},
        [COLUMN_KIND] = {"kind", OFTString, 10},
        [COLUMN_REASON] = {"reason", OFTString, 12},
        [COLUMN_DISTANCE] = {"distance", OFTReal, 0},
        [COLUMN_BEFORE] = {"before", OFTReal, 0},
        [COLUMN_DEPTH] = {"depth", OFTReal, 0},
        [COLUMN_REQUIRED] = {"required", OFTReal, 0},
        [COLUMN_BLOCKED_BY] = {"blocked_by", OFTString, 0},
    };
    const gis_sink_layer_request request = {.suffix = suffix,
                                            .type = wkbLineString,
                                            .crs = gis_source_crs(input->source),
                                            .fields = fields,
                                            .n_fields = N_CONFLICT_COLUMNS,
                                            .style = GIS_STYLE_CONFLICTS};
    gis_sink_layer *layer;
    if (!gis_sink_add(sink, &request, &layer, error)) return false;
    size_t n;
    const sunder_conflict *conflicts = sunder_report_conflicts(report, &n);
    gis_conflict_texts scratch = {0};
    bool ok = true;
    for (size_t k = 0; ok && k < n; k++) {
        gis_value values[N_CONFLICT_COLUMNS];
        ok = gis_conflict_values(input, &conflicts[k], &scratch, values, error);
        if (!ok) break;
        OGRGeometryH line = gis_geometry_line(conflicts[k].from, conflicts[k].to);
        ok = line ? gis_sink_write(layer, NULL, line, values, error) : gis_no_memory(error);
    }
    gis_conflict_texts_clear(&scratch);
    return ok;
}
