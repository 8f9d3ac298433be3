/* enlarging.c: see enlarging.h. */
#include "layer/enlarging.h"
#include "layer/levels.h"

#include "base/core_error.h"
#include "sunder_hiding.h"

#include <stdlib.h>

/* Sets shape[] and block[] to the larger shapes, and to the blocks. */
static bool make_larger(const gis_layer_input *input, const bool *rigid, const sunder_feature *feature,
                        sunder_shape **shape, int64_t *block, gis_error *error)
{
    const sunder_layer_options core = gis_layer_core_options(input);
    const sunder_enlarging how = {input->lengths.min_size, rigid};
    sunder_layer *layer = NULL;
    sunder_error why;
    const bool ok = sunder_layer_new(feature, input->n, &layer, &why) == SUNDER_OK &&
                    sunder_layer_enlarge(layer, &core, &how, shape, block, &why) == SUNDER_OK;
    sunder_layer_free(layer);
    return ok || gis_core_failed(error, "--enlarge", &why);
}

/* Replaces each shape that grew by the larger one, and keeps the shape as read in given[]. */
static void take_larger(gis_layer_input *input, sunder_feature *feature, sunder_shape **shape, const int64_t *block)
{
    for (size_t i = 0; i < input->n; i++) {
        feature[i].block = block[i];
        if (!shape[i]) continue;
        input->given[i] = input->shape[i];
        feature[i].shape = input->shape[i] = shape[i];
        input->enlarged++;
    }
    input->blocks_given = true;
}

bool gis_enlarge(gis_layer_input *input, sunder_feature *feature, gis_error *error)
{
    if (!input->request->rules.enlarge) return true;
    sunder_shape **shape = calloc(input->n + 1, sizeof *shape);
    int64_t *block = malloc((input->n + 1) * sizeof *block);
    bool *rigid = NULL;
    input->given = calloc(input->n + 1, sizeof *input->given);
    const bool ok = ((shape && block && input->given) || gis_no_memory(error)) &&
                    gis_levels_rigid(input, &rigid, error) && make_larger(input, rigid, feature, shape, block, error);
    if (ok) take_larger(input, feature, shape, block);
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
    for (size_t k = 0; ok && k < n; k++) given[k] = input->given[matched ? matched[k] : k];
    if (ok && sunder_layer_set_originals(layer, given, &why) != SUNDER_OK)
        ok = gis_core_failed(error, "--enlarge", &why);
    free((void *)given);
    return ok;
}
