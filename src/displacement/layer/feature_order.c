/* The order in which features are processed, independent of the order in which the caller lists them: by position, then
 * by corners, then by the other input. All later stages break ties by number (of bodies, of pieces, of pairs), so the
 * same features in another order get the same moves; only features that are alike in everything are distinguished by
 * their places in the list, and may swap roles. Numbers rise with y, independently of the other features: a feature far
 * away does not change the order of two others. At the end the report refers to features by the caller's numbers
 * (report/renumber.c). */
#include "displacement/layer/barrier_parts.h"

#include "base/sort.h"
#include "shape/shape.h"

#include <math.h>
#include <string.h>

static int by_double(double a, double b) { return a < b ? -1 : a > b; }

static int by_shape(const sunder_shape *a, const sunder_shape *b)
{
    if (a == b || !a || !b) return !a - !b;
    if (a->vertices != b->vertices) return a->vertices < b->vertices ? -1 : 1;
    int order = 0;
    for (size_t k = 0; k < 2 * (size_t)a->vertices && order == 0; k++) order = by_double(a->xy[k], b->xy[k]);
    return order;
}

static int by_demands(const sunder_feature *a, const sunder_feature *b)
{
    int order = by_double(a->weight, b->weight);
    if (order == 0) order = by_double(a->max_shift, b->max_shift);
    if (order == 0) order = a->fixed - b->fixed;
    if (order == 0) order = a->ignored - b->ignored;
    if (order == 0) order = a->joins_none - b->joins_none;
    if (order == 0) order = a->may_jump - b->may_jump;
    if (order == 0) order = a->in_no_row - b->in_no_row;
    return order ? order : a->block < b->block ? -1 : a->block > b->block;
}

/* Sets box to the box of feature f. The box of an absent feature is at infinity, so that it sorts behind all others. */
static void place_of(const sunder_layer *layer, uint32_t f, double box[4])
{
    const sunder_feature feature = sunder_i_given_feature(layer, f);
    for (int c = 0; c < 4; c++) box[c] = INFINITY;
    if (sunder_i_is_present(&feature)) sunder_shape_box(feature.shape, box);
}

/* Compares two features by place, then corners, then demands. Features that are equal in all of these remain in the
 * order of the list, since the sort is stable. */
static int by_place(void *context, uint32_t x, uint32_t y)
{
    static const int side[4] = {1, 0, 3, 2};
    const sunder_layer *layer = context;
    double a[4], b[4];
    place_of(layer, x, a);
    place_of(layer, y, b);
    int order = 0;
    for (int c = 0; c < 4 && order == 0; c++) order = by_double(a[side[c]], b[side[c]]);
    if (order == 0) order = by_shape(sunder_i_given_feature(layer, x).shape, sunder_i_given_feature(layer, y).shape);
    if (order == 0) order = by_demands(sunder_i_demands(layer, x), sunder_i_demands(layer, y));
    if (order == 0 && layer->gaps) order = by_double(layer->gaps->of[x], layer->gaps->of[y]);
    for (size_t c = 0; c < 2 && order == 0 && layer->preferred; c++)
        order = by_double(layer->preferred[2 * (size_t)x + c], layer->preferred[2 * (size_t)y + c]);
    return order;
}

/* Maps a double to an integer such that integers are ordered as the doubles are. Both zeros map to the same integer. */
static uint64_t ordered_bits(double v)
{
    const double sum = v + 0.0;
    uint64_t bits;
    memcpy(&bits, &sum, sizeof bits);
    return bits >> 63 ? ~bits : bits | (uint64_t)1 << 63;
}

/* Makes a key for each feature. It consists of as many leading bits of the feature's lower edge, less the lowest, as
 * there is room for, and of the feature's number. A feature whose leading bits are greater lies no lower. */
static void make_keys(const sunder_layer *layer, uint64_t *key)
{
    uint64_t lowest = UINT64_MAX, highest = 0;
    int shift = 0;
    for (size_t k = 0; k < layer->n; k++) {
        double box[4];
        place_of(layer, (uint32_t)k, box);
        key[k] = ordered_bits(box[1]);
        if (!(box[1] < INFINITY)) continue;
        if (key[k] < lowest) lowest = key[k];
        if (key[k] > highest) highest = key[k];
    }
    while (lowest <= highest && (highest - lowest) >> shift >= UINT32_MAX) shift++;
    for (size_t k = 0; k < layer->n; k++) {
        const uint64_t above = key[k] > highest ? UINT32_MAX : (key[k] - lowest) >> shift;
        key[k] = above << 32 | k;
    }
}

/* Sorts the features by their lower edges first, by radix sort; then those with equal keys by all criteria. */
static bool sort_by_place(const sunder_layer *layer, uint32_t *number)
{
    uint64_t *key = sunder_i_alloc(layer->n, sizeof *key);
    bool ok = key != NULL;
    if (ok) make_keys(layer, key);
    ok = ok && sunder_i_sort_keys(key, layer->n);
    for (size_t k = 0; k < layer->n && ok; k++) number[k] = (uint32_t)key[k];
    for (size_t first = 0, end; first < layer->n && ok; first = end) {
        for (end = first + 1; end < layer->n && key[end] >> 32 == key[first] >> 32;) end++;
        if (end > first + 1) ok = sunder_i_sort_indices(number + first, end - first, by_place, (void *)layer);
    }
    sunder_i_free(key);
    return ok;
}

/* Appends the parts of barriers, as fixed features, behind the features, in the order of the barriers. */
static void append_parts(const sunder_i_barriers *barriers, sunder_layer *out)
{
    for (uint32_t k = 0; k < barriers->parts; k++) {
        out->part[k] =
            (sunder_feature){.shape = barriers->shape[k], .weight = 1, .max_shift = 0, .block = -1, .fixed = true};
        out->number[out->n + k] = (uint32_t)out->n + barriers->barrier[k];
    }
}

void sunder_i_ordered_clear(sunder_layer *ordered)
{
    sunder_i_free_all(ordered->number, ordered->part);
    *ordered = (sunder_layer){0};
}

sunder_status sunder_i_order_layer(const sunder_layer *layer, const sunder_i_barriers *barriers, bool as_given,
                                   sunder_layer *out, sunder_error *err)
{
    const size_t n = layer->n;
    *out = (sunder_layer){.n = n, .barrier = layer->barrier, .barriers = layer->barriers, .given = layer};
    out->part = sunder_i_alloc(barriers->parts, sizeof *out->part);
    out->number = sunder_i_alloc(n + barriers->parts, sizeof *out->number);
    bool ok = out->part && out->number;
    for (size_t k = 0; ok && k < n && as_given; k++) out->number[k] = (uint32_t)k;
    if (ok && !as_given) ok = sort_by_place(layer, out->number);
    if (ok) append_parts(barriers, out);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}
