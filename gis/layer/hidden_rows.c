/* hidden_rows.c: the layer of hidden features, each with the set of features and barriers that cannot all be kept. */
#include "layer/output.h"

#include "base/interrupt.h"
#include "read/read_shape.h"
#include "sunder_hiding.h"

#include <stdlib.h>
#include <string.h>

/* The geometry type of the features; layers of different types may move together. */
static OGRwkbGeometryType type_of(const gis_layer_input *input)
{
    const OGRwkbGeometryType type = OGR_L_GetGeomType(gis_source_layer(input->source));
    for (size_t k = 1; k < input->parts; k++)
        if (OGR_L_GetGeomType(gis_source_layer(input->part[k].source)) != type) return wkbUnknown;
    return type;
}

bool gis_hidden_begin(gis_sink *sink, const gis_layer_input *input, OGRFieldType id, gis_sink_layer **layer,
                      gis_error *error)
{
    const gis_field fields[] = {{"fid", OFTInteger64, 0},    {"id", id, 0},
                                {"class", OFTInteger64, 0},  {"weight", OFTReal, 0},
                                {"forced", OFTInteger64, 0}, {"because", OFTString, 0},
                                {"layer_a", OFTString, 0}};
    const gis_sink_layer_request request = {.suffix = "hidden",
                                            .type = type_of(input),
                                            .crs = gis_source_crs(input->source),
                                            .fields = fields,
                                            .n_fields = sizeof fields / sizeof *fields - (input->parts ? 0 : 1),
                                            .style = GIS_STYLE_HIDDEN};
    return gis_sink_add(sink, &request, layer, error);
}

/* Is p a better reason than q to hide a member of both? Proved clauses come first, then those with fewer members, then
 * those with fewer things. */
static bool is_better(const sunder_clause *p, const sunder_clause *q)
{
    if (!q || p->proved != q->proved) return !q || p->proved;
    return p->members != q->members ? p->members < q->members : p->things < q->things;
}

const sunder_clause **gis_hidden_reasons(const sunder_report *report, size_t n)
{
    const sunder_clause **reason = calloc(n + 1, sizeof *reason);
    size_t clauses;
    const sunder_clause *clause = sunder_report_clauses(report, &clauses);
    for (size_t k = 0; reason && k < clauses; k++)
        for (size_t m = 0; m < clause[k].members; m++) {
            const sunder_clause **of = &reason[clause[k].member[m]];
            if (is_better(&clause[k], *of)) *of = &clause[k];
        }
    return reason;
}

gis_hidden_row gis_hidden_row_of(size_t feature, sunder_hiding_cost cost, const sunder_clause *why)
{
    return (gis_hidden_row){feature, cost, why->thing, why->things, why->proved, why->proved && why->members == 1};
}

bool gis_hidden_list(const gis_layer_input *input, const sunder_report *report, gis_hidden_row **list, size_t *n,
                     gis_error *error)
{
    size_t hidden = 0;
    for (size_t i = 0; i < input->n; i++) hidden += sunder_report_status(report, i) == SUNDER_FEATURE_HIDDEN;
    const sunder_clause **reason = gis_hidden_reasons(report, input->n);
    *list = malloc((hidden + 1) * sizeof **list);
    *n = 0;
    for (size_t i = 0; reason && *list && i < input->n; i++)
        if (sunder_report_status(report, i) == SUNDER_FEATURE_HIDDEN)
            (*list)[(*n)++] = gis_hidden_row_of(i, gis_layer_hiding_cost(input, i), reason[i]);
    const bool ok = reason && *list;
    free(reason);
    return ok || gis_no_memory(error);
}

/* Writes "tentative: " before the things of a clause without a proof. */
static bool put_because(const gis_things *things, const gis_hidden_row *row, gis_conflict_texts *scratch,
                        gis_value *value, gis_error *error)
{
    static const char mark[] = "tentative: ";
    if (!gis_things_value(things, row->thing, row->things, &scratch->blocked_by, value, error)) return false;
    if (row->proved) return true;
    const size_t length = strlen(scratch->blocked_by);
    char *text = malloc(length + sizeof mark);
    if (!text) return gis_no_memory(error);
    memcpy(text, mark, sizeof mark - 1);
    memcpy(text + sizeof mark - 1, scratch->blocked_by, length + 1);
    free(scratch->blocked_by);
    value->as.text = scratch->blocked_by = text;
    return true;
}

bool gis_hidden_put(gis_sink_layer *layer, const gis_hidden_row *row, const gis_things *things, OGRGeometryH geometry,
                    gis_error *error)
{
    const gis_value none = {.kind = GIS_NULL};
    gis_conflict_texts scratch = {0};
    gis_value values[] = {
        gis_fid_as_value(things->fid(things->of, row->feature)),
        none,
        row->cost.hierarchy == GIS_LAST_CLASS ? none : (gis_value){GIS_INTEGER, {.integer = row->cost.hierarchy}},
        {GIS_REAL, {.real = (double)row->cost.weight / GIS_HIDING_UNIT}},
        {GIS_INTEGER, {.integer = row->forced}},
        none,
        gis_things_layer(things, row->feature),
    };
    bool ok = gis_go_on(error) && things->id(things->of, row->feature, &scratch.id[0], &values[1], error) &&
              put_because(things, row, &scratch, &values[5], error);
    ok = ok && gis_sink_write(layer, NULL, OGR_G_Clone(geometry), values, error);
    gis_conflict_texts_clear(&scratch);
    return ok;
}
