/* previous.c: the result of an earlier run (--previous): its moves are preferred, and features near a place that is
 * empty now are free to go back (previous_places.c), since the layer would otherwise keep moves whose reason is gone.
 *
 * A place of the result is empty if its feature is not in the layer any more, or was edited (previous_edits.c): what
 * stands there may be smaller now, or elsewhere. A feature that was edited is free to go back itself. */
#include "layer/gap_rules.h"
#include "layer/previous_edits.h"
#include "layer/previous_layer.h"

#include "base/message.h"
#include "read/crs_units.h"
#include "read/fields.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Does the result lack the layer? Only a result of several layers has layers of other names. */
static bool lacks_layer(const gis_layer_input *input)
{
    const char *path = input->request->previous;
    GDALDatasetH dataset = input->request->name ? GDALOpenEx(path, GDAL_OF_VECTOR, NULL, NULL, NULL) : NULL;
    const bool lacks = dataset && !GDALDatasetGetLayerByName(dataset, input->request->name);
    GDALClose(dataset);
    if (lacks)
        gis_say_warning(GIS_MESSAGE_PASSED_BY, "--previous %s: it has no layer %s, whose features are new", path,
                        input->request->name);
    return lacks;
}

static bool open_result(gis_previous_layer *r, gis_error *error)
{
    const gis_layer_input_request *now = r->input->request;
    r->request = *now;
    r->request.source =
        (gis_source_request){.path = now->previous,
                             .input_crs = now->source.input_crs,
                             .layer = now->name,
                             .layer_like = now->written ? now->written : gis_source_name(r->input->source)};
    r->request.output = NULL;
    r->request.with = NULL;
    r->request.more = 0;
    r->request.rules = (gis_layer_rules){.core = now->rules.core};
    r->request.barriers = 0;
    if (!gis_layer_begin(&r->request, true, &r->before, error)) return false;
    if (!gis_crs_may_be_same(gis_source_crs(r->input->source), gis_source_crs(r->before.source)))
        return gis_fail(error, "--previous %s: it is in another CRS than layer %s; give a result of the same layer",
                        now->previous, gis_source_name(r->input->source));
    static const char *const name[] = {"sunder_dx", "sunder_dy"};
    for (int c = 0; c < 2; c++) {
        r->move_field[c] = gis_source_field(r->before.source, name[c]);
        if (r->move_field[c] < 0)
            return gis_fail(error, "--previous %s: layer %s has no field %s; give a result of sunder separate",
                            now->previous, gis_source_name(r->before.source), name[c]);
    }
    r->block_field = gis_source_field(r->before.source, "sunder_blk");
    return true;
}

static bool take_move(const gis_previous_layer *r, size_t was, double move[2], gis_error *error)
{
    for (int c = 0; c < 2; c++) {
        OGRFeatureH feature = gis_source_attributes(r->before.source, was);
        if (gis_field_is_blank(feature, r->move_field[c])) continue;
        move[c] = gis_field_number(feature, r->move_field[c]);
        if (!isfinite(move[c]))
            return gis_layer_wrong_number(&r->before, was, r->move_field[c], "former move", "a finite number", error);
    }
    return true;
}

/* Takes the former moves of the features that the result has, too. */
static bool match_features(gis_previous_layer *r, gis_error *error)
{
    gis_layer_input *input = r->input;
    gis_previous *out = &input->previous;
    const size_t n = r->n;
    bool ok = gis_feature_keys_list(&r->before, gis_feature_key_field(&r->before), "--previous", &r->key, error);
    for (size_t i = 0; i < input->n && ok; i++) {
        char *key = gis_feature_key_of(input, i, -1);
        const gis_feature_key *found = key ? gis_feature_keys_find(r->key, n, key) : NULL;
        ok = key || gis_no_memory(error);
        free(key);
        if (!found) continue;
        out->of[i] = found->feature;
        r->matched[found->feature] = true;
        ok = take_move(r, found->feature, out->move + 2 * i, error);
        OGRFeatureH feature = gis_source_attributes(r->before.source, found->feature);
        if (r->block_field >= 0 && !gis_field_is_blank(feature, r->block_field))
            r->block[i] = (int64_t)gis_field_number(feature, r->block_field);
    }
    for (size_t k = 0; k < n && ok; k++) out->gone += !r->matched[k];
    return ok;
}

/* Most features of a layer that is made again are as they were, unless keys have changed. */
static void warn_of_edits(const gis_previous_layer *r)
{
    const gis_previous *previous = &r->input->previous;
    size_t edited = 0, matched = 0;
    for (size_t i = 0; i < r->input->n; i++) {
        edited += previous->edited[i];
        matched += previous->of[i] != SIZE_MAX;
    }
    if (2 * edited > matched && r->input->id_field < 0)
        gis_say_warning(GIS_MESSAGE_PASSED_BY,
                        "--previous: %zu of %zu features have another geometry than when %s was made; if FIDs have "
                        "changed since, match features by --id-field",
                        edited, matched, r->request.previous);
}

/* ---- All of it --------------------------------------------------------------------------------------------------- */

/* Reads what the result says of one layer. */
static bool read_layer(gis_previous_layer *r, gis_error *error)
{
    gis_layer_input *input = r->input;
    gis_previous *out = &input->previous;
    const bool lacks = lacks_layer(input);
    if (!lacks && !open_result(r, error)) return false;
    r->n = lacks ? 0 : gis_source_count(r->before.source);
    out->move = calloc(2 * input->n + 1, sizeof *out->move);
    out->of = malloc((input->n + 1) * sizeof *out->of);
    out->relaxed = calloc(input->n + 1, sizeof *out->relaxed);
    out->edited = calloc(input->n + 1, sizeof *out->edited);
    r->matched = calloc(r->n + 1, sizeof *r->matched);
    r->block = malloc((input->n + 1) * sizeof *r->block);
    if (!out->move || !out->of || !out->relaxed || !out->edited || !r->matched || !r->block)
        return gis_no_memory(error);
    for (size_t i = 0; i < input->n; i++) {
        out->of[i] = SIZE_MAX;
        r->block[i] = -1;
    }
    if (lacks) return true;
    if (!match_features(r, error) || !gis_previous_find_edits(input, &r->before, out->edited, error)) return false;
    warn_of_edits(r);
    return true;
}

static void clear_layer(gis_previous_layer *r)
{
    gis_feature_keys_free(r->key, r->key ? r->n : 0);
    free(r->matched);
    free(r->block);
    gis_layer_input_clear(&r->before);
}

bool gis_previous_read(gis_layer_input *input, gis_error *error)
{
    const size_t layers = input->parts ? input->parts : 1;
    if (!input->request->previous) return true;
    gis_previous_layer *layer = calloc(layers, sizeof *layer);
    bool ok = layer || gis_no_memory(error);
    for (size_t k = 0; k < layers && ok; k++) {
        layer[k].input = input->parts ? &input->part[k] : input;
        ok = read_layer(&layer[k], error);
    }
    ok = ok && gis_previous_relax(layer, layers, input->request->previous_stays, gis_class_gaps_most(input), error);
    for (size_t k = 0; k < layers && layer; k++) clear_layer(&layer[k]);
    free(layer);
    return ok;
}
