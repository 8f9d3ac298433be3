/* preferred_moves.c: the places that features prefer, as moves from where they stand: the cost counts from there. A
 * field goes before an earlier result, and that before links. */
#include "layer/output.h"

#include "base/core_error.h"
#include "read/fields.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Sets move[2] to the move that the fields of --prefer-dx and --prefer-dy give feature i; null changes nothing. */
static bool take_fields(const gis_layer_input *input, size_t i, double move[2], gis_error *error)
{
    for (int c = 0; c < 2; c++) {
        OGRFeatureH feature = gis_source_attributes(input->source, i);
        const int field = input->prefer_field[c];
        char who[GIS_WHO_SIZE];
        if (gis_field_is_blank(feature, field)) continue;
        const double value = gis_field_number(feature, field);
        if (!isfinite(value))
            return gis_layer_wrong_number(input, i, field, "preferred move", "a finite number", error);
        const gis_length length = {fabs(value), GIS_LAYER_UNIT};
        gis_feature_name(input, i, who, sizeof who);
        if (!gis_length_in_layer_units(&length, &input->units, who, &move[c], error)) return false;
        move[c] = copysign(move[c], value);
    }
    return true;
}

/* Sets the moves that links give the places of features. */
static bool take_links(const gis_layer_input *input, double *move, gis_error *error)
{
    const gis_links_request *request = &input->request->links;
    gis_links links = {0};
    if (!request->dataset) return true;
    const gis_links_surroundings around = {gis_source_crs(input->source), &input->units, input->request->output,
                                           input->request->update};
    bool ok = gis_links_read(request, &around, &links, error);
    for (size_t i = 0; i < input->n && ok; i++) {
        double at[2];
        if (input->feature[i].ignored) continue;
        ok = gis_arrow_start(input, i, at, error);
        if (ok) gis_links_move(&links, at, move + 2 * i);
    }
    gis_links_clear(&links);
    return ok;
}

static bool is_preferring(const gis_layer_input *input)
{
    return input->prefer_field[0] >= 0 || input->request->previous || input->request->links.dataset;
}

/* Sets move[2 n] to the moves that the features of one source prefer. */
static bool find_preferred(gis_layer_input *input, double *move, gis_error *error)
{
    const gis_previous *previous = &input->previous;
    if (!is_preferring(input)) return true;
    bool ok = take_links(input, move, error);
    for (size_t i = 0; i < input->n && ok; i++) {
        if (input->feature[i].ignored) continue;
        if (previous->move && previous->of[i] != SIZE_MAX && !previous->relaxed[i])
            memcpy(move + 2 * i, previous->move + 2 * i, 2 * sizeof *move);
        if (input->prefer_field[0] >= 0) ok = take_fields(input, i, move + 2 * i, error);
    }
    return ok;
}

bool gis_layer_set_preferred(gis_layer_input *input, gis_error *error)
{
    sunder_error why;
    bool any = !input->parts && is_preferring(input);
    for (size_t k = 0; k < input->parts; k++) any = any || is_preferring(&input->part[k]);
    if (!any) return true;
    double *move = calloc(2 * input->n + 1, sizeof *move);
    bool ok = (move || gis_no_memory(error)) && gis_previous_read(input, error);
    if (ok && !input->parts) ok = find_preferred(input, move, error);
    for (size_t k = 0; k < input->parts && ok; k++)
        ok = find_preferred(&input->part[k], move + 2 * input->part[k].first, error);
    if (ok && sunder_layer_set_preferred(input->layer, move, &why) != SUNDER_OK)
        ok = gis_core_failed(error, "preferred places", &why);
    free(move);
    return ok;
}
