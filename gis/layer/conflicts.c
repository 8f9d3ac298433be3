/* conflicts.c: the row of a conflict, and the layer of conflicts. `check` prints the same rows as lines. */
#include "layer/output.h"

#include <cpl_conv.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

GIntBig gis_layer_fid(const gis_layer_input *input, size_t feature)
{
    const gis_layer_input *own = gis_layer_own(input, &feature);
    return gis_source_fid(own->source, feature);
}

gis_value gis_fid_value(const gis_layer_input *input, size_t feature)
{
    return gis_fid_as_value(gis_layer_fid(input, feature));
}

bool gis_id_value(const gis_layer_input *input, size_t i, char **copy, gis_value *value, gis_error *error)
{
    *value = (gis_value){.kind = GIS_NULL};
    input = gis_layer_own(input, &i);
    if (input->id_field < 0) return true;
    OGRFeatureH feature = gis_source_attributes(input->source, i);
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

static GIntBig input_fid(const void *of, size_t feature) { return gis_layer_fid(of, feature); }

static const char *input_layer(const void *of, size_t feature) { return gis_layer_name(gis_layer_own(of, &feature)); }

static bool input_id(const void *of, size_t feature, char **copy, gis_value *value, gis_error *error)
{
    return gis_id_value(of, feature, copy, value, error);
}

static GIntBig input_barrier(const void *of, size_t thing, const char **layer)
{
    const gis_layer_input *input = of;
    const gis_barrier_feature *barrier = gis_barrier_of(input, thing);
    *layer = gis_barrier_layer(input, barrier);
    return barrier->fid;
}

gis_things gis_things_of(const gis_layer_input *input)
{
    return (gis_things){input, input->n, input_fid, input_id, input_barrier, input->parts ? input_layer : NULL};
}

bool gis_things_is_barrier(const gis_things *things, size_t thing)
{
    return thing >= things->features && thing != SIZE_MAX;
}

const gis_barrier_feature *gis_barrier_of(const gis_layer_input *input, size_t thing)
{
    const bool none = thing < input->n || thing == SIZE_MAX;
    return none ? NULL : &input->barriers.feature[thing - input->n];
}

const char *gis_barrier_layer(const gis_layer_input *input, const gis_barrier_feature *barrier)
{
    return input->barriers.layer[barrier->request];
}

/* The FID of a thing, and the name of its layer; "" for a feature of the only layer that moves. */
static GIntBig find_thing(const gis_things *things, size_t thing, const char **layer)
{
    *layer = "";
    if (gis_things_is_barrier(things, thing)) return things->barrier(things->of, thing, layer);
    if (things->layer) *layer = things->layer(things->of, thing);
    return things->fid(things->of, thing);
}

gis_value gis_things_layer(const gis_things *things, size_t thing)
{
    const bool none = !things->layer || thing == SIZE_MAX || gis_things_is_barrier(things, thing);
    return none ? (gis_value){.kind = GIS_NULL} : (gis_value){GIS_TEXT, {.text = things->layer(things->of, thing)}};
}

bool gis_things_value(const gis_things *things, const size_t *thing, size_t n, char **copy, gis_value *value,
                      gis_error *error)
{
    *value = (gis_value){.kind = GIS_NULL};
    if (n == 0) return true;
    size_t size = n * 22 + 1, length = 0;
    const char *layer;
    for (size_t k = 0; k < n; k++) {
        find_thing(things, thing[k], &layer);
        size += strlen(layer) + 1;
    }
    char *text = malloc(size);
    if (!text) return gis_no_memory(error);
    for (size_t k = 0; k < n; k++) {
        const GIntBig fid = find_thing(things, thing[k], &layer);
        length += (size_t)snprintf(text + length, size - length, "%s%s%s" CPL_FRMT_GIB, k ? "," : "", layer,
                                   *layer ? ":" : "", fid);
    }
    free(*copy);
    *copy = text;
    *value = (gis_value){GIS_TEXT, {.text = text}};
    return true;
}

/* A length as a value; null if it is NAN. */
static gis_value length_value(double length)
{
    return isnan(length) ? (gis_value){.kind = GIS_NULL} : (gis_value){GIS_REAL, {.real = length}};
}

/* The type of the ids of one layer. */
static OGRFieldType own_id_type(const gis_layer_input *input)
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

/* Layers that move together have ids of one type, or as texts. */
OGRFieldType gis_id_type(const gis_layer_input *input)
{
    if (!input->parts) return own_id_type(input);
    const OGRFieldType type = own_id_type(&input->part[0]);
    for (size_t k = 1; k < input->parts; k++)
        if (own_id_type(&input->part[k]) != type) return OFTString;
    return type;
}

bool gis_things_conflict(const gis_things *things, const sunder_conflict *conflict, gis_conflict_texts *scratch,
                         gis_value values[N_CONFLICT_COLUMNS], gis_error *error)
{
    const char *reason = sunder_reason_string(conflict->reason);
    const char *layer = NULL;
    const bool barrier = gis_things_is_barrier(things, conflict->b);
    const GIntBig barrier_fid = barrier ? things->barrier(things->of, conflict->b, &layer) : OGRNullFID;
    const bool alone = conflict->b == SIZE_MAX;
    const gis_value none = {.kind = GIS_NULL};
    values[COLUMN_ID_B] = none;
    values[COLUMN_FID_A] = gis_fid_as_value(things->fid(things->of, conflict->a));
    values[COLUMN_FID_B] = barrier || alone ? none : gis_fid_as_value(things->fid(things->of, conflict->b));
    values[COLUMN_BARRIER] = barrier ? (gis_value){GIS_TEXT, {.text = layer}} : none;
    values[COLUMN_BARR_FID] = barrier ? gis_fid_as_value(barrier_fid) : none;
    values[COLUMN_KIND] = (gis_value){GIS_TEXT, {.text = sunder_conflict_kind_string(conflict->kind)}};
    values[COLUMN_REASON] = *reason ? (gis_value){GIS_TEXT, {.text = reason}} : (gis_value){.kind = GIS_NULL};
    values[COLUMN_DISTANCE] = (gis_value){GIS_REAL, {.real = conflict->distance}};
    values[COLUMN_BEFORE] = (gis_value){GIS_REAL, {.real = conflict->before}};
    values[COLUMN_DEPTH] = (gis_value){GIS_REAL, {.real = conflict->depth}};
    values[COLUMN_REQUIRED] = (gis_value){GIS_REAL, {.real = conflict->required}};
    values[COLUMN_MISSING] = length_value(conflict->missing);
    values[COLUMN_NEED_SHIFT] = length_value(conflict->need_shift);
    values[COLUMN_NEED_GAP] = length_value(conflict->need_gap);
    values[COLUMN_BY_ROW] = (gis_value){GIS_INTEGER, {.integer = conflict->by_row}};
    values[COLUMN_LAYER_A] = gis_things_layer(things, conflict->a);
    values[COLUMN_LAYER_B] = gis_things_layer(things, conflict->b);
    return things->id(things->of, conflict->a, &scratch->id[0], &values[COLUMN_ID_A], error) &&
           (barrier || alone || things->id(things->of, conflict->b, &scratch->id[1], &values[COLUMN_ID_B], error)) &&
           gis_things_value(things, &conflict->need_gone, conflict->need_gone != SIZE_MAX, &scratch->need_gone,
                            &values[COLUMN_NEED_GONE], error) &&
           gis_things_value(things, conflict->blocked_by, conflict->n_blocked_by, &scratch->blocked_by,
                            &values[COLUMN_BLOCKED_BY], error);
}

bool gis_conflict_values(const gis_layer_input *input, const sunder_conflict *conflict, gis_conflict_texts *scratch,
                         gis_value values[N_CONFLICT_COLUMNS], gis_error *error)
{
    const gis_things things = gis_things_of(input);
    return gis_things_conflict(&things, conflict, scratch, values, error);
}

void gis_conflict_texts_clear(gis_conflict_texts *scratch)
{
    free(scratch->id[0]);
    free(scratch->id[1]);
    free(scratch->blocked_by);
    free(scratch->need_gone);
    *scratch = (gis_conflict_texts){0};
}

bool gis_conflicts_begin(gis_sink *sink, const char *suffix, OGRFieldType id, OGRSpatialReferenceH crs, bool by_row,
                         bool layers, bool tight, gis_sink_layer **layer, gis_error *error)
{
    const gis_field fields[N_CONFLICT_COLUMNS] = {
        [COLUMN_FID_A] = {"fid_a", OFTInteger64, 0},      [COLUMN_ID_A] = {"id_a", id, 0},
        [COLUMN_FID_B] = {"fid_b", OFTInteger64, 0},      [COLUMN_ID_B] = {"id_b", id, 0},
        [COLUMN_BARRIER] = {"barrier", OFTString, 0},     [COLUMN_BARR_FID] = {"barr_fid", OFTInteger64, 0},
        [COLUMN_KIND] = {"kind", OFTString, 15},          [COLUMN_REASON] = {"reason", OFTString, 12},
        [COLUMN_DISTANCE] = {"distance", OFTReal, 0},     [COLUMN_BEFORE] = {"before", OFTReal, 0},
        [COLUMN_DEPTH] = {"depth", OFTReal, 0},           [COLUMN_REQUIRED] = {"required", OFTReal, 0},
        [COLUMN_MISSING] = {"missing", OFTReal, 0},       [COLUMN_BLOCKED_BY] = {"blocked_by", OFTString, 0},
        [COLUMN_NEED_SHIFT] = {"need_shift", OFTReal, 0}, [COLUMN_NEED_GAP] = {"need_gap", OFTReal, 0},
        [COLUMN_NEED_GONE] = {"need_gone", OFTString, 0}, [COLUMN_BY_ROW] = {"by_row", OFTInteger, 0},
        [COLUMN_LAYER_A] = {"layer_a", OFTString, 0},     [COLUMN_LAYER_B] = {"layer_b", OFTString, 0},
    };
    const gis_sink_layer_request request = {.suffix = suffix,
                                            .type = wkbLineString,
                                            .crs = crs,
                                            .fields = fields,
                                            .n_fields = layers   ? N_CONFLICT_COLUMNS
                                                        : by_row ? COLUMN_LAYER_A
                                                                 : COLUMN_BY_ROW,
                                            .style = tight ? GIS_STYLE_WITH_TIGHT : GIS_STYLE_CONFLICTS};
    return gis_sink_add(sink, &request, layer, error);
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
             gis_line_row(layer, values, conflicts[k].from, conflicts[k].to, error);
    }
    gis_conflict_texts_clear(&scratch);
    return ok;
}
