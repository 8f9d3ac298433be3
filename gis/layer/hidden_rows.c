/* hidden_rows.c: the layer of hidden features, each with the set of features and barriers that cannot all be kept. */
#include "layer/output.h"

#include "base/interrupt.h"
#include "read/read_shape.h"
#include "sunder_hiding.h"

#include <stdlib.h>
#include <string.h>

static bool begin_hidden(gis_sink *sink, const gis_layer_input *input, gis_sink_layer **layer, gis_error *error)
{
    const gis_field fields[] = {{"fid", OFTInteger64, 0}, {"id", gis_id_type(input), 0}, {"class", OFTInteger64, 0},
                                {"weight", OFTReal, 0},   {"forced", OFTInteger64, 0},   {"because", OFTString, 0}};
    const gis_sink_layer_request request = {.suffix = "hidden",
                                            .type = OGR_L_GetGeomType(gis_source_layer(input->source)),
                                            .crs = gis_source_crs(input->source),
                                            .fields = fields,
                                            .n_fields = sizeof fields / sizeof *fields,
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

/* Writes "tentative: " before the things of a clause without a proof. */
static bool put_because(const gis_things *things, const sunder_clause *why, gis_conflict_texts *scratch,
                        gis_value *value, gis_error *error)
{
    static const char mark[] = "tentative: ";
    if (!gis_things_value(things, why->thing, why->things, &scratch->blocked_by, value, error)) return false;
    if (why->proved) return true;
    const size_t length = strlen(scratch->blocked_by);
    char *text = malloc(length + sizeof mark);
    if (!text) return gis_no_memory(error);
    memcpy(text, mark, sizeof mark - 1);
    memcpy(text + sizeof mark - 1, scratch->blocked_by, length + 1);
    free(scratch->blocked_by);
    value->as.text = scratch->blocked_by = text;
    return true;
}

static bool write_hidden(gis_sink_layer *layer, const gis_layer_input *input, size_t i, const sunder_clause *why,
                         gis_error *error)
{
    const gis_things things = gis_things_of(input);
    const sunder_hiding_cost cost = gis_layer_hiding_cost(input, i);
    const gis_value none = {.kind = GIS_NULL};
    gis_conflict_texts scratch = {0};
    gis_value values[] = {
        gis_fid_value(input, i),
        none,
        cost.hierarchy == GIS_LAST_CLASS ? none : (gis_value){GIS_INTEGER, {.integer = cost.hierarchy}},
        {GIS_REAL, {.real = (double)cost.weight / GIS_HIDING_UNIT}},
        {GIS_INTEGER, {.integer = why->proved && why->members == 1}},
        none,
    };
    bool ok = gis_go_on(error) && gis_id_value(input, i, &scratch.id[0], &values[1], error) &&
              put_because(&things, why, &scratch, &values[5], error);
    OGRGeometryH geometry = ok ? OGR_G_Clone(gis_source_geometry(input->source, i)) : NULL;
    ok = ok && gis_sink_write(layer, NULL, geometry, values, error);
    gis_conflict_texts_clear(&scratch);
    return ok;
}

bool gis_write_hidden(gis_sink *sink, const gis_layer_input *input, const sunder_report *report, gis_error *error)
{
    gis_sink_layer *layer;
    if (!begin_hidden(sink, input, &layer, error)) return false;
    const sunder_clause **reason = gis_hidden_reasons(report, input->n);
    bool ok = reason || gis_no_memory(error);
    for (size_t i = 0; i < input->n && ok; i++)
        if (sunder_report_status(report, i) == SUNDER_FEATURE_HIDDEN)
            ok = write_hidden(layer, input, i, reason[i], error);
    free(reason);
    return ok;
}
