/* conflicts.c: one conflict as a row, and the layer of conflicts. check prints the same rows as lines. */
#include "layer/output.h"

#include <cpl_conv.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static gis_value fid_value(GIntBig fid)
{
    return fid == OGRNullFID ? (gis_value){.kind = GIS_NULL} : (gis_value){GIS_INTEGER, {.integer = fid}};
}

gis_value gis_barrier_fid_value(const gis_barrier_feature *barrier) { return fid_value(barrier->fid); }

gis_value gis_fid_value(const gis_layer_input *input, size_t feature)
{
    return fid_value(gis_source_fid(input->source, feature));
}

bool gis_id_value(const gis_layer_input *input, size_t i, char **copy, gis_value *value, gis_error *error)
{
    *value = (gis_value){.kind = GIS_NULL};
    if (input->id_field < 0) return true;
    OGRFeatureH feature = gis_source_feature(input->source, i);
    if (!OGR_F_IsFieldSetAndNotNull(feature, input->id_field)) return true;
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

const gis_barrier_feature *gis_barrier_of(const gis_layer_input *input, size_t thing)
{
    return thing < input->n || thing == SIZE_MAX ? NULL : &input->barriers.feature[thing - input->n];
}

const char *gis_barrier_layer(const gis_layer_input *input, const gis_barrier_feature *barrier)
{
    return input->barriers.layer[barrier->request];
}

/* Things by their numbers, with commas: FIDs, of barriers LAYER:FID. */
static bool things_value(const gis_layer_input *input, const size_t *thing, size_t n, char **copy, gis_value *value,
                         gis_error *error)
{
    *value = (gis_value){.kind = GIS_NULL};
    if (n == 0) return true;
    size_t size = n * 22 + 1, length = 0;
    for (size_t k = 0; k < n; k++) {
        const gis_barrier_feature *barrier = gis_barrier_of(input, thing[k]);
        if (barrier) size += strlen(gis_barrier_layer(input, barrier)) + 1;
    }
    char *text = malloc(size);
    if (!text) return gis_no_memory(error);
    for (size_t k = 0; k < n; k++) {
        const gis_barrier_feature *barrier = gis_barrier_of(input, thing[k]);
        length += (size_t)snprintf(text + length, size - length, "%s%s%s" CPL_FRMT_GIB, k ? "," : "",
                                   barrier ? gis_barrier_layer(input, barrier) : "", barrier ? ":" : "",
                                   barrier ? barrier->fid : gis_source_fid(input->source, thing[k]));
    }
    free(*copy);
    *copy = text;
    *value = (gis_value){GIS_TEXT, {.text = text}};
    return true;
}

/* NAN: none is known. */
static gis_value length_value(double length)
{
    return isnan(length) ? (gis_value){.kind = GIS_NULL} : (gis_value){GIS_REAL, {.real = length}};
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
    const gis_barrier_feature *barrier = gis_barrier_of(input, conflict->b);
    const bool alone = conflict->b == SIZE_MAX;
    const gis_value none = {.kind = GIS_NULL};
    values[COLUMN_ID_B] = none;
    values[COLUMN_FID_A] = gis_fid_value(input, conflict->a);
    values[COLUMN_FID_B] = barrier || alone ? none : gis_fid_value(input, conflict->b);
    values[COLUMN_BARRIER] = barrier ? (gis_value){GIS_TEXT, {.text = gis_barrier_layer(input, barrier)}} : none;
    values[COLUMN_BARR_FID] = barrier ? gis_barrier_fid_value(barrier) : none;
    values[COLUMN_KIND] = (gis_value){GIS_TEXT, {.text = sunder_conflict_kind_string(conflict->kind)}};
    values[COLUMN_REASON] = *reason ? (gis_value){GIS_TEXT, {.text = reason}} : (gis_value){.kind = GIS_NULL};
    values[COLUMN_DISTANCE] = (gis_value){GIS_REAL, {.real = conflict->distance}};
    values[COLUMN_BEFORE] = (gis_value){GIS_REAL, {.real = conflict->before}};
    values[COLUMN_DEPTH] = (gis_value){GIS_REAL, {.real = conflict->depth}};
    values[COLUMN_REQUIRED] = (gis_value){GIS_REAL, {.real = conflict->required}};
    values[COLUMN_NEED_SHIFT] = length_value(conflict->need_shift);
    values[COLUMN_NEED_GAP] = length_value(conflict->need_gap);
    return gis_id_value(input, conflict->a, &scratch->id[0], &values[COLUMN_ID_A], error) &&
           (barrier || alone || gis_id_value(input, conflict->b, &scratch->id[1], &values[COLUMN_ID_B], error)) &&
           things_value(input, &conflict->need_gone, conflict->need_gone != SIZE_MAX, &scratch->need_gone,
                        &values[COLUMN_NEED_GONE], error) &&
           things_value(input, conflict->blocked_by, conflict->n_blocked_by, &scratch->blocked_by,
                        &values[COLUMN_BLOCKED_BY], error);
}

void gis_conflict_texts_clear(gis_conflict_texts *scratch)
{
    free(scratch->id[0]);
    free(scratch->id[1]);
    free(scratch->blocked_by);
    free(scratch->need_gone);
    *scratch = (gis_conflict_texts){0};
}

bool gis_conflicts_begin(gis_sink *sink, const gis_layer_input *input, const char *suffix, gis_sink_layer **layer,
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
        [COLUMN_KIND] = {"kind", OFTString, 15},
        [COLUMN_REASON] = {"reason", OFTString, 12},
        [COLUMN_DISTANCE] = {"distance", OFTReal, 0},
        [COLUMN_BEFORE] = {"before", OFTReal, 0},
        [COLUMN_DEPTH] = {"depth", OFTReal, 0},
        [COLUMN_REQUIRED] = {"required", OFTReal, 0},
        [COLUMN_BLOCKED_BY] = {"blocked_by", OFTString, 0},
        [COLUMN_NEED_SHIFT] = {"need_shift", OFTReal, 0},
        [COLUMN_NEED_GAP] = {"need_gap", OFTReal, 0},
        [COLUMN_NEED_GONE] = {"need_gone", OFTString, 0},
    };
    const gis_sink_layer_request request = {.suffix = suffix,
                                            .type = wkbLineString,
                                            .crs = gis_source_crs(input->source),
                                            .fields = fields,
                                            .n_fields = N_CONFLICT_COLUMNS,
                                            .style = GIS_STYLE_CONFLICTS};
    return gis_sink_add(sink, &request, layer, error);
}

bool gis_write_conflict_row(gis_sink_layer *layer, const gis_value *values, const double from[2], const double to[2],
                            gis_error *error)
{
    OGRGeometryH line = gis_geometry_line(from, to);
    return line ? gis_sink_write(layer, NULL, line, values, error) : gis_no_memory(error);
}

bool gis_write_report_conflicts(gis_sink_layer *layer, const gis_layer_input *input, const sunder_report *report,
                                gis_error *error)
{
    size_t n;
    const sunder_conflict *conflicts = sunder_report_conflicts(report, &n);
    gis_conflict_texts scratch = {0};
    bool ok = true;
    for (size_t k = 0; ok && k < n; k++) {
        gis_value values[N_CONFLICT_COLUMNS];
        ok = gis_conflict_values(input, &conflicts[k], &scratch, values, error) &&
             gis_write_conflict_row(layer, values, conflicts[k].from, conflicts[k].to, error);
    }
    gis_conflict_texts_clear(&scratch);
    return ok;
}

bool gis_write_conflicts(gis_sink *sink, const gis_layer_input *input, const sunder_report *report, gis_error *error)
{
    gis_sink_layer *layer;
    return gis_conflicts_begin(sink, input, "conflicts", &layer, error) &&
           gis_write_report_conflicts(layer, input, report, error);
}
