/* legible.c: the audit of a layer, and its rows. */
#include "legible/legible_inner.h"

#include "base/array.h"
#include "base/core_error.h"
#include "base/interrupt.h"

#include <math.h>
#include <stdlib.h>

/* Adds what was found of one feature. */
static bool add_findings(gis_legible *out, size_t feature, const sunder_illegible *found, size_t n, gis_error *error)
{
    for (size_t k = 0; k < n; k++) {
        if (!gis_array_reserve(&out->item, &out->capacity, out->n + 1, sizeof *out->item)) return gis_no_memory(error);
        out->item[out->n++] = (gis_legible_finding){feature, found[k]};
        out->count[found[k].kind]++;
    }
    return true;
}

static bool check_feature(const gis_layer_input *input, size_t i, const sunder_legible_limits *limits, gis_legible *out,
                          gis_error *error)
{
    const sunder_shape *shape = gis_layer_original(input, i);
    sunder_illegible *found = NULL;
    sunder_error why;
    size_t n = 0;
    if (!shape || (input->feature && input->feature[i].ignored)) return true;
    if (sunder_shape_illegible(shape, limits, &found, &n, &why) != SUNDER_OK)
        return gis_core_failed(error, gis_source_name(input->source), &why);
    const bool ok = add_findings(out, input->first + i, found, n, error);
    sunder_free(found);
    return ok;
}

bool gis_legible_check(const gis_layer_input *input, const gis_legible_rules *rules, gis_legible *out, gis_error *error)
{
    sunder_legible_limits limits;
    if (!rules) return true;
    if (!gis_legible_limits(rules, &input->units, &limits, error)) return false;
    for (int kind = 0; kind < SUNDER_ILLEGIBLE_KINDS; kind++)
        out->asked[kind] = out->asked[kind] || rules->least[kind].text;
    for (size_t i = 0; i < input->n; i++)
        if (!gis_go_on(error) || !check_feature(input, i, &limits, out, error)) return false;
    return true;
}

void gis_legible_clear(gis_legible *legible)
{
    free(legible->item);
    *legible = (gis_legible){0};
}

bool gis_legible_row(const gis_layer_input *input, const gis_legible *legible, size_t k, gis_conflict_texts *scratch,
                     gis_value values[N_CONFLICT_COLUMNS], gis_error *error)
{
    const gis_legible_finding *f = &legible->item[k];
    for (int column = 0; column < N_CONFLICT_COLUMNS; column++) values[column] = (gis_value){.kind = GIS_NULL};
    values[COLUMN_FID_A] = gis_fid_value(input, f->feature);
    values[COLUMN_KIND] = (gis_value){GIS_TEXT, {.text = sunder_illegible_kind_string(f->is.kind)}};
    values[COLUMN_DISTANCE] = (gis_value){GIS_REAL, {.real = f->is.has}};
    values[COLUMN_REQUIRED] = (gis_value){GIS_REAL, {.real = f->is.required}};
    const gis_things things = gis_things_of(input);
    values[COLUMN_LAYER_A] = gis_things_layer(&things, f->feature);
    return gis_id_value(input, f->feature, &scratch->id[0], &values[COLUMN_ID_A], error);
}

bool gis_write_legible(gis_sink_layer *layer, const gis_layer_input *input, const gis_legible *legible,
                       gis_error *error)
{
    gis_conflict_texts scratch = {0};
    bool ok = true;
    for (size_t k = 0; ok && k < legible->n; k++) {
        gis_value values[N_CONFLICT_COLUMNS];
        const sunder_illegible *is = &legible->item[k].is;
        ok = gis_go_on(error) && gis_legible_row(input, legible, k, &scratch, values, error) &&
             gis_line_row(layer, values, is->from, is->to, error);
    }
    gis_conflict_texts_clear(&scratch);
    return ok;
}
