/* previous.c: the result of an earlier run (--previous): its moves are preferred, and features near a place that is
 * empty now are free to go back, since the layer would otherwise keep moves whose reason is gone.
 *
 * A place of the result is empty if its feature is not in the layer any more, or was edited (previous_edits.c): what
 * stands there may be smaller now, or elsewhere. A feature that was edited is free to go back itself. */
#include "layer/feature_keys.h"
#include "layer/previous_edits.h"

#include "base/message.h"
#include "read/crs_units.h"
#include "read/fields.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Features go back that stood within this many gaps of a place that is empty now. */
static const double gaps_of_reach = 1.1;

/* The box of a place that is empty now. */
typedef struct empty_place {
    double box[4];
} empty_place;

typedef struct reading {
    gis_layer_input *input;
    gis_layer_input_request request;
    gis_layer_input before; /* the result of the earlier run */
    int move_field[2], block_field;
    gis_feature_key *key; /* of the result's features, sorted */
    bool *matched;        /* [features of the result] */
    int64_t *block;       /* [features of the layer] the former block; -1: none */
    empty_place *empty;
    size_t empties;
    double widest, reach;
} reading;

static bool open_result(reading *r, gis_error *error)
{
    const gis_layer_input_request *now = r->input->request;
    r->request = *now;
    r->request.source = (gis_source_request){
        .path = now->previous, .input_crs = now->source.input_crs, .layer_like = gis_source_name(r->input->source)};
    r->request.output = NULL;
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

static bool take_move(const reading *r, size_t was, double move[2], gis_error *error)
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
static bool match_features(reading *r, gis_error *error)
{
    gis_layer_input *input = r->input;
    gis_previous *out = &input->previous;
    const size_t n = gis_source_count(r->before.source);
    bool ok = gis_feature_keys_list(&r->before, gis_feature_key_field(&r->before), "--previous", &r->key, error);
    for (size_t i = 0; i < input->n && ok; i++) {
        char *key = gis_feature_key_of(input, i, -1);
        const gis_feature_key *found = key ? gis_feature_keys_find(r->key, n, key) : NULL;
        ok = key || gis_no_memory(error);
        free(key);
        r->block[i] = -1;
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

/* ---- Places that are empty now ----------------------------------------------------------------------------------- */

static bool box_of(OGRGeometryH geometry, double box[4])
{
    OGREnvelope e;
    if (!geometry || OGR_G_IsEmpty(geometry)) return false;
    OGR_G_GetEnvelope(geometry, &e);
    memcpy(box, (double[]){e.MinX, e.MinY, e.MaxX, e.MaxY}, 4 * sizeof *box);
    return true;
}

/* Adds the place of a feature of the result, grown by half of the largest symbol if it is a point. */
static void add_place(reading *r, const double box[4], const double symbol[2])
{
    empty_place *e = &r->empty[r->empties++];
    for (int k = 0; k < 4; k++) e->box[k] = box[k] + (k < 2 ? -symbol[k & 1] : symbol[k & 1]);
    r->widest = fmax(r->widest, e->box[2] - e->box[0]);
}

static int by_left(const void *a, const void *b)
{
    const empty_place *p = a, *q = b;
    return (p->box[0] > q->box[0]) - (p->box[0] < q->box[0]);
}

/* Half of the extents of the largest symbol; 0 for polygons. */
static void largest_symbol(const gis_layer_input *input, double half[2])
{
    half[0] = half[1] = 0;
    for (size_t i = 0; input->points && i < input->n; i++) {
        double box[4];
        if (!input->shape[i] || sunder_shape_is_empty(input->shape[i])) continue;
        sunder_shape_box(input->shape[i], box);
        for (int c = 0; c < 2; c++) half[c] = fmax(half[c], (box[c + 2] - box[c]) / 2);
    }
}

static bool list_empty_places(reading *r, gis_error *error)
{
    const gis_layer_input *input = r->input;
    const size_t n = gis_source_count(r->before.source);
    double symbol[2], box[4];
    r->empty = malloc((n + 1) * sizeof *r->empty);
    if (!r->empty) return gis_no_memory(error);
    largest_symbol(input, symbol);
    for (size_t k = 0; k < n; k++)
        if (!r->matched[k] && box_of(gis_source_geometry(r->before.source, k), box)) add_place(r, box, symbol);
    for (size_t i = 0; i < input->n; i++)
        if (input->previous.edited[i] && box_of(gis_source_geometry(r->before.source, input->previous.of[i]), box))
            add_place(r, box, symbol);
    if (r->empties) qsort(r->empty, r->empties, sizeof *r->empty, by_left);
    return true;
}

/* Did feature i stand within reach of a place that is empty now? */
static bool stood_near_empty(const reading *r, size_t i)
{
    const double *move = r->input->previous.move + 2 * i;
    double box[4];
    if (!r->input->shape[i] || sunder_shape_is_empty(r->input->shape[i])) return false;
    sunder_shape_box(r->input->shape[i], box);
    for (int k = 0; k < 4; k++) box[k] += move[k & 1] + (k < 2 ? -r->reach : r->reach);
    size_t low = 0, high = r->empties;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (r->empty[middle].box[0] < box[0] - r->widest)
            low = middle + 1;
        else
            high = middle;
    }
    for (; low < r->empties && r->empty[low].box[0] <= box[2]; low++) {
        const double *e = r->empty[low].box;
        if (e[2] >= box[0] && e[1] <= box[3] && e[3] >= box[1]) return true;
    }
    return false;
}

static int by_value(const void *a, const void *b)
{
    const int64_t p = *(const int64_t *)a, q = *(const int64_t *)b;
    return (p > q) - (p < q);
}

/* Lets edited features and those near empty places go back, with all members of their former blocks. */
static bool relax_features(reading *r, gis_error *error)
{
    gis_layer_input *input = r->input;
    gis_previous *out = &input->previous;
    int64_t *block = malloc((input->n + 1) * sizeof *block);
    size_t blocks = 0;
    if (!block) return gis_no_memory(error);
    r->reach = gaps_of_reach * input->gap;
    for (size_t i = 0; i < input->n; i++) {
        out->relaxed[i] = out->edited[i] || (out->of[i] != SIZE_MAX && stood_near_empty(r, i));
        if (out->relaxed[i] && r->block[i] >= 0) block[blocks++] = r->block[i];
    }
    qsort(block, blocks, sizeof *block, by_value);
    for (size_t i = 0; i < input->n && blocks; i++)
        if (r->block[i] >= 0 && bsearch(&r->block[i], block, blocks, sizeof *block, by_value)) out->relaxed[i] = true;
    free(block);
    return true;
}

/* Most features of a layer that is made again are as they were, unless keys have changed. */
static void warn_of_edits(const reading *r)
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

bool gis_previous_read(gis_layer_input *input, gis_error *error)
{
    reading r = {.input = input};
    gis_previous *out = &input->previous;
    if (!input->request->previous) return true;
    bool ok = open_result(&r, error);
    if (ok) {
        out->move = calloc(2 * input->n + 1, sizeof *out->move);
        out->of = malloc((input->n + 1) * sizeof *out->of);
        out->relaxed = calloc(input->n + 1, sizeof *out->relaxed);
        out->edited = calloc(input->n + 1, sizeof *out->edited);
        r.matched = calloc(gis_source_count(r.before.source) + 1, sizeof *r.matched);
        r.block = malloc((input->n + 1) * sizeof *r.block);
        ok = (out->move && out->of && out->relaxed && out->edited && r.matched && r.block) || gis_no_memory(error);
    }
    for (size_t i = 0; i < input->n && ok; i++) out->of[i] = SIZE_MAX;
    ok = ok && match_features(&r, error);
    ok = ok && gis_previous_find_edits(input, &r.before, out->edited, error);
    if (ok) warn_of_edits(&r);
    if (ok && !input->request->previous_stays) ok = list_empty_places(&r, error);
    ok = ok && relax_features(&r, error);
    gis_feature_keys_free(r.key, r.key ? gis_source_count(r.before.source) : 0);
    free(r.matched);
    free(r.block);
    free(r.empty);
    gis_layer_input_clear(&r.before);
    return ok;
}
