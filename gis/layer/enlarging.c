/* enlarging.c: see enlarging.h. */
#include "layer/enlarging.h"

#include "base/core_error.h"
#include "sunder_hiding.h"

#include <stdlib.h>

static size_t index_of(const size_t *matched, size_t k) { return matched ? matched[k] : k; }

/* The features that --rigid-where selects, among those of the layer; the caller frees *out. */
static bool find_rigid(const gis_layer_input *input, const size_t *matched, size_t n, bool **out, gis_error *error)
{
    const char *where = input->request->rules.rigid_where;
    bool *all = calloc(input->n + 1, sizeof *all), *rigid = calloc(n + 1, sizeof *rigid);
    bool ok = (all && rigid) || gis_no_memory(error);
    if (ok && where) ok = gis_source_mark(input->source, "--rigid-where", where, all, error);
    for (size_t k = 0; ok && k < n; k++) rigid[k] = all[index_of(matched, k)];
    free(all);
    *out = rigid;
    return ok;
}

/* Sets shape[n] and block[n] to the larger shapes, and to the blocks. */
static bool make_larger(const gis_layer_input *input, const bool *rigid, const sunder_feature *feature, size_t n,
                        sunder_shape **shape, int64_t *block, gis_error *error)
{
    const sunder_layer_options core = gis_layer_core_options(input);
    const sunder_enlarging how = {input->min_size, rigid};
    sunder_layer *layer = NULL;
    sunder_error why;
    const bool ok = sunder_layer_new(feature, n, &layer, &why) == SUNDER_OK &&
                    sunder_layer_enlarge(layer, &core, &how, shape, block, &why) == SUNDER_OK;
    sunder_layer_free(layer);
    return ok || gis_core_failed(error, "--enlarge", &why);
}

/* Puts the larger shapes in the place of those as given. */
static void take_larger(gis_layer_input *input, const size_t *matched, sunder_feature *feature, size_t n,
                        sunder_shape **shape, const int64_t *block)
{
    for (size_t k = 0; k < n; k++) {
        const size_t i = index_of(matched, k);
        feature[k].block = block[k];
        if (!shape[k]) continue;
        input->given[i] = input->shape[i];
        feature[k].shape = input->shape[i] = shape[k];
        input->enlarged++;
    }
    input->blocks_given = true;
}

bool gis_enlarge(gis_layer_input *input, const size_t *matched, sunder_feature *feature, size_t n, gis_error *error)
{
    if (!input->request->rules.enlarge) return true;
    sunder_shape **shape = calloc(n + 1, sizeof *shape);
    int64_t *block = malloc((n + 1) * sizeof *block);
    bool *rigid = NULL;
    input->given = calloc(input->n + 1, sizeof *input->given);
    bool ok = (shape && block && input->given) || gis_no_memory(error);
    ok = ok && find_rigid(input, matched, n, &rigid, error) &&
         make_larger(input, rigid, feature, n, shape, block, error);
    if (ok) take_larger(input, matched, feature, n, shape, block);
    free(rigid);
    free(shape);
    free(block);
    return ok;
}

bool gis_enlarge_tell(const gis_layer_input *input, const size_t *matched, size_t n, sunder_layer *layer,
                      gis_error *error)
{
    sunder_error why;
    if (!input->given) return true;
    const sunder_shape **given = calloc(n + 1, sizeof *given);
    bool ok = given || gis_no_memory(error);
    for (size_t k = 0; ok && k < n; k++) given[k] = input->given[index_of(matched, k)];
    if (ok && sunder_layer_set_originals(layer, given, &why) != SUNDER_OK)
        ok = gis_core_failed(error, "--enlarge", &why);
    free((void *)given);
    return ok;
}
