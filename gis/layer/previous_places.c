/* previous_places.c: which features are free to go back to where they stand in the layer: those that were edited, and
 * those near a place of the earlier result that is empty now, with all members of their former blocks. If several
 * layers move together, a place that is empty in one of them makes room in all. */
#include "layer/previous_layer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Features go back that stood within this many gaps of a place that is empty now. */
static const double gaps_of_reach = 1.1;

/* The box of a place that is empty now. */
typedef struct empty_place {
    double box[4];
} empty_place;

typedef struct empty_places {
    empty_place *list; /* [n] sorted by the left sides */
    size_t n;
    double widest, reach;
} empty_places;

static bool box_of(OGRGeometryH geometry, double box[4])
{
    OGREnvelope e;
    if (!geometry || OGR_G_IsEmpty(geometry)) return false;
    OGR_G_GetEnvelope(geometry, &e);
    memcpy(box, (double[]){e.MinX, e.MinY, e.MaxX, e.MaxY}, 4 * sizeof *box);
    return true;
}

/* Adds the place of a feature of the result, grown by half of the largest symbol if it is a point. */
static void add_place(empty_places *places, const double box[4], const double symbol[2])
{
    empty_place *e = &places->list[places->n++];
    for (int k = 0; k < 4; k++) e->box[k] = box[k] + (k < 2 ? -symbol[k & 1] : symbol[k & 1]);
    places->widest = fmax(places->widest, e->box[2] - e->box[0]);
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

/* Adds the places of one result; there is room for all its features. */
static void add_places(const gis_previous_layer *r, empty_places *places)
{
    const gis_layer_input *input = r->input;
    double symbol[2], box[4];
    largest_symbol(input, symbol);
    for (size_t k = 0; k < r->n; k++)
        if (!r->matched[k] && box_of(gis_source_geometry(r->before.source, k), box)) add_place(places, box, symbol);
    for (size_t i = 0; i < input->n; i++)
        if (input->previous.edited[i] && box_of(gis_source_geometry(r->before.source, input->previous.of[i]), box))
            add_place(places, box, symbol);
}

static bool list_empty_places(const gis_previous_layer *layer, size_t layers, empty_places *places, gis_error *error)
{
    size_t most = 0;
    for (size_t k = 0; k < layers; k++) most += layer[k].n;
    places->list = malloc((most + 1) * sizeof *places->list);
    if (!places->list) return gis_no_memory(error);
    for (size_t k = 0; k < layers; k++) add_places(&layer[k], places);
    if (places->n) qsort(places->list, places->n, sizeof *places->list, by_left);
    return true;
}

/* Did feature i stand within reach of a place that is empty now? */
static bool stood_near_empty(const empty_places *places, const gis_layer_input *input, size_t i)
{
    const double *move = input->previous.move + 2 * i;
    double box[4];
    if (!input->shape[i] || sunder_shape_is_empty(input->shape[i])) return false;
    sunder_shape_box(input->shape[i], box);
    for (int k = 0; k < 4; k++) box[k] += move[k & 1] + (k < 2 ? -places->reach : places->reach);
    size_t low = 0, high = places->n;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (places->list[middle].box[0] < box[0] - places->widest)
            low = middle + 1;
        else
            high = middle;
    }
    for (; low < places->n && places->list[low].box[0] <= box[2]; low++) {
        const double *e = places->list[low].box;
        if (e[2] >= box[0] && e[1] <= box[3] && e[3] >= box[1]) return true;
    }
    return false;
}

static int by_value(const void *a, const void *b)
{
    const int64_t p = *(const int64_t *)a, q = *(const int64_t *)b;
    return (p > q) - (p < q);
}

/* Notes the features of one layer that go back, and adds their former blocks to `block`. */
static size_t relax_layer(const gis_previous_layer *r, const empty_places *places, int64_t *block)
{
    gis_previous *out = &r->input->previous;
    size_t blocks = 0;
    for (size_t i = 0; i < r->input->n; i++) {
        out->relaxed[i] = out->edited[i] || (out->of[i] != SIZE_MAX && stood_near_empty(places, r->input, i));
        if (out->relaxed[i] && r->block[i] >= 0) block[blocks++] = r->block[i];
    }
    return blocks;
}

/* Lets the other members of these blocks go back, too. */
static bool relax_features(gis_previous_layer *layer, size_t layers, const empty_places *places, gis_error *error)
{
    size_t n = 0, blocks = 0;
    for (size_t k = 0; k < layers; k++) n += layer[k].input->n;
    int64_t *block = malloc((n + 1) * sizeof *block);
    if (!block) return gis_no_memory(error);
    for (size_t k = 0; k < layers; k++) blocks += relax_layer(&layer[k], places, block + blocks);
    if (blocks) qsort(block, blocks, sizeof *block, by_value);
    for (size_t k = 0; k < layers && blocks; k++) {
        const gis_previous_layer *r = &layer[k];
        for (size_t i = 0; i < r->input->n; i++)
            if (r->block[i] >= 0 && bsearch(&r->block[i], block, blocks, sizeof *block, by_value))
                r->input->previous.relaxed[i] = true;
    }
    free(block);
    return true;
}

bool gis_previous_relax(gis_previous_layer *layer, size_t layers, bool stays, double gap, gis_error *error)
{
    empty_places places = {.reach = gaps_of_reach * gap};
    const bool ok =
        (stays || list_empty_places(layer, layers, &places, error)) && relax_features(layer, layers, &places, error);
    free(places.list);
    return ok;
}
