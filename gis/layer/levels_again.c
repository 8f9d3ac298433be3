/* levels_again.c: see levels_again.h. A feature that the result does not have was hidden, perhaps, and not written
 * (--drop-hidden). Its block is needed, since the wall that it shares with a visible feature is no outline of the
 * block; the result no longer says which block that is, but which features form one. */
#include "layer/levels_again.h"

#include "base/core_error.h"
#include "layer/gap_rules.h"
#include "layer/enlarging.h"
#include "layer/levels.h"

#include <stdlib.h>
#include <string.h>

/* Sets group[n] to the blocks that all features of the original would form by touching. */
static bool find_groups(const gis_layer_input *original, int64_t *group, gis_error *error)
{
    const size_t n = original->n;
    sunder_layer_options core = gis_layer_core_options(original);
    sunder_feature *alone = malloc((n + 1) * sizeof *alone);
    sunder_layer *layer = NULL;
    sunder_error why;
    if (!alone) return gis_no_memory(error);
    memcpy(alone, original->feature, n * sizeof *alone);
    for (size_t i = 0; i < n; i++) alone[i].block = -1;
    core.no_blocks = false;
    const bool ok = sunder_layer_new(alone, n, &layer, &why) == SUNDER_OK &&
                    sunder_layer_blocks(layer, &core, group, &why) == SUNDER_OK;
    sunder_layer_free(layer);
    free(alone);
    return ok || gis_core_failed(error, "--before", &why);
}

/* Puts each lost feature into the block of the first feature of its group that has one. */
static bool join_lost(gis_layer_input *original, const size_t *lost, size_t n, gis_error *error)
{
    if (n == 0) return true;
    int64_t *group = malloc((original->n + 1) * sizeof *group), *block = malloc((original->n + 1) * sizeof *block);
    bool ok = (group && block) || gis_no_memory(error);
    ok = ok && find_groups(original, group, error);
    for (size_t i = 0; ok && i < original->n; i++) block[i] = -1;
    for (size_t k = 0; ok && k < n; k++) original->feature[lost[k]].block = -1;
    for (size_t i = 0; ok && i < original->n; i++)
        if (group[i] >= 0 && block[group[i]] < 0) block[group[i]] = original->feature[i].block;
    for (size_t k = 0; ok && k < n; k++)
        if (group[lost[k]] >= 0) original->feature[lost[k]].block = block[group[lost[k]]];
    free(group);
    free(block);
    return ok;
}

bool gis_levels_again(gis_layer_input *original, const size_t *lost, size_t n, gis_levels *levels, gis_error *error)
{
    const gis_barriers *barriers = &original->barriers;
    sunder_layer *layer = NULL;
    sunder_error why;
    if (!gis_levels_asked(&original->request->rules)) return true;
    if (!join_lost(original, lost, n, error) || !gis_enlarge(original, original->feature, error)) return false;
    bool ok = (sunder_layer_new(original->feature, original->n, &layer, &why) == SUNDER_OK &&
               sunder_layer_set_barriers(layer, barriers->barrier, barriers->n, &why) == SUNDER_OK) ||
              gis_core_failed(error, "--before", &why);
    ok = ok && gis_class_gaps_set(original, NULL, original->n, layer, error);
    if (ok) sunder_layer_set_crossed(layer, original->request->rules.crossed);
    ok = ok && gis_enlarge_tell(original, NULL, original->n, layer, error) &&
         gis_levels_make(original, layer, levels, error);
    sunder_layer_free(layer);
    return ok;
}
