/* joined_layers.c: layers that move together. Each is read by its own rules; then their features are numbered one layer
 * after the other, and the core gets all of them as one layer. Coordinates have to be of one CRS, since each layer is
 * written as it came. */
#include "layer/layer_input.h"

#include "read/crs_units.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

static bool check_crs(const gis_layer_input *input, const gis_layer_input *part, gis_error *error)
{
    static const char *const how[] = {"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES", "CRITERION=EQUIVALENT", NULL};
    OGRSpatialReferenceH first = gis_source_crs(input->source), crs = gis_source_crs(part->source);
    if ((!first && !crs) || (first && crs && OSRIsSameEx(first, crs, how))) return true;
    return gis_fail(error, "layers %s and %s move together, and have different CRSs: reproject one of them",
                    gis_layer_name(input), gis_layer_name(part));
}

static bool check_name(const gis_layer_input *input, const gis_layer_input *part, gis_error *error)
{
    for (size_t k = 0; k < input->parts; k++)
        if (EQUAL(gis_layer_name(&input->part[k]), gis_layer_name(part)))
            return gis_fail_usage(error, "--spec: two layers that move have the name %s", gis_layer_name(part));
    return true;
}

static bool read_part(gis_layer_input *input, const gis_layer_input_request *request, gis_error *error)
{
    gis_layer_input *part = &input->part[input->parts];
    const bool ok = gis_layer_read_features(request, part, error) &&
                    (input->parts == 0 || check_crs(&input->part[0], part, error)) && check_name(input, part, error);
    input->parts++; /* also on failure: the part is cleared with the others */
    part->first = input->n;
    input->n += part->n;
    input->invalid += part->invalid;
    input->null += part->null;
    input->other += part->other;
    return ok;
}

/* ---- Joining ----------------------------------------------------------------------------------------------------- */

/* In a result of several layers sunder_blk is the same in all members of a block, whatever layer they are of. */
static bool has_common_blocks(const gis_layer_input *input, const gis_layer_input *part)
{
    const char *field = part->request->rules.block_field;
    return part->block_field >= 0 && EQUAL(field, "sunder_blk") &&
           strcmp(gis_source_path(part->source), gis_source_path(input->part[0].source)) == 0;
}

/* Numbers such blocks once more, over all parts. *next becomes the number after the greatest. */
static bool number_common_blocks(gis_layer_input *input, int64_t *next, gis_error *error)
{
    gis_block_keys keys = {0};
    bool ok = true;
    for (size_t k = 0; ok && k < input->parts; k++)
        if (has_common_blocks(input, &input->part[k])) ok = gis_layer_number_blocks(&input->part[k], &keys, error);
    ok = ok && gis_block_keys_rank(&keys, error);
    for (size_t k = 0; ok && k < input->parts; k++) {
        const gis_layer_input *part = &input->part[k];
        for (size_t i = 0; i < part->n && has_common_blocks(input, part); i++)
            if (part->feature[i].block >= 0) part->feature[i].block = keys.rank[part->feature[i].block];
    }
    *next = (int64_t)keys.n;
    gis_block_keys_clear(&keys);
    return ok;
}

/* Gives the blocks of a part numbers that no other part has. Returns the number after its greatest. */
static int64_t shift_blocks(const gis_layer_input *part, sunder_feature *feature, int64_t from)
{
    int64_t next = from;
    for (size_t i = 0; i < part->n; i++) {
        if (feature[i].block < 0) continue;
        feature[i].block += from;
        if (feature[i].block >= next) next = feature[i].block + 1;
    }
    return next;
}

static bool join_features(gis_layer_input *input, gis_error *error)
{
    int64_t next = 0;
    input->shape = malloc((input->n + 1) * sizeof *input->shape);
    input->feature = malloc((input->n + 1) * sizeof *input->feature);
    const bool classed = input->part[0].gap_class != NULL;
    if (classed) input->gap_class = malloc((input->n + 1) * sizeof *input->gap_class);
    if (!input->shape || !input->feature || (classed && !input->gap_class)) return gis_no_memory(error);
    if (!number_common_blocks(input, &next, error)) return false;
    for (size_t k = 0; k < input->parts; k++) {
        const gis_layer_input *part = &input->part[k];
        sunder_feature *feature = input->feature + part->first;
        memcpy(input->shape + part->first, part->shape, part->n * sizeof *part->shape);
        memcpy(feature, part->feature, part->n * sizeof *feature);
        if (!has_common_blocks(input, part)) next = shift_blocks(part, feature, next);
        if (classed) memcpy(input->gap_class + part->first, part->gap_class, part->n * sizeof *input->gap_class);
    }
    return true;
}

/* Takes what concerns the whole run from the first part. */
static void take_common(gis_layer_input *input)
{
    const gis_layer_input *first = &input->part[0];
    input->source = first->source;
    input->units = first->units;
    input->gap = first->gap;
    input->least_gap = first->least_gap;
    input->max_shift = first->max_shift;
    input->tolerance = first->tolerance;
    input->barrier_reach = INFINITY;
}

/* The tables of gaps are of the run; those of parts are not used. */
static void take_class_tables(gis_layer_input *input)
{
    input->class_tables = input->part[0].class_tables;
    input->part[0].class_tables = (gis_class_tables){0};
}

static bool join_layers(const gis_layer_input_request *request, gis_layer_input *out, gis_error *error)
{
    *out = (gis_layer_input){.request = request, .part = calloc(request->more + 1, sizeof *out->part)};
    if (!out->part) return gis_no_memory(error);
    for (size_t k = 0; k <= request->more; k++)
        if (!read_part(out, k ? &request->with[k - 1] : request->alone, error)) return false;
    take_common(out);
    take_class_tables(out);
    return join_features(out, error) && gis_layer_complete(out, error);
}

bool gis_layer_input_read(const gis_layer_input_request *request, gis_layer_input *out, gis_error *error)
{
    if (request->more) return join_layers(request, out, error);
    return gis_layer_read_features(request, out, error) && gis_layer_complete(out, error);
}
