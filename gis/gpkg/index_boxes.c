/* index_boxes.c: see index_boxes.h. */
#include "gpkg/index_boxes.h"

#include "base/array.h"
#include "base/keyed_sort.h"
#include "disk/external_sort.h"
#include "geometry/hilbert.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Adding boxes ------------------------------------------------------------------------------------------------ */

/* A box with the keys by which it is sorted. */
typedef struct record {
    gis_sort_head head;
    gis_index_box box;
} record;

static float float_below(double x)
{
    float f = (float)x;
    return (double)f > x ? nextafterf(f, -INFINITY) : f;
}

static float float_above(double x)
{
    float f = (float)x;
    return (double)f < x ? nextafterf(f, INFINITY) : f;
}

/* Converts a box to floats, rounded outwards. */
static void set_box(gis_index_box *out, GIntBig fid, const OGREnvelope *box)
{
    out->fid = fid;
    out->side[0] = float_below(box->MinX);
    out->side[1] = float_above(box->MaxX);
    out->side[2] = float_below(box->MinY);
    out->side[3] = float_above(box->MaxY);
}

static bool store_box(gis_index_boxes *boxes, const gis_index_box *box, gis_error *error)
{
    return (boxes->file.stream || gis_disk_file_create(&boxes->file, boxes->scratch, "boxes.XXXXXX", error)) &&
           gis_disk_file_write(&boxes->file, box, sizeof *box, error);
}

/* In memory, the box is built in its final place. Built elsewhere and copied, it would have to wait until its parts
 * reach the cache, which costs some hundred nanoseconds per row. */
bool gis_index_boxes_add(gis_index_boxes *boxes, GIntBig fid, const OGREnvelope *box, gis_error *error)
{
    gis_index_box passing, *one = &passing;
    if (!boxes->scratch) {
        if (!gis_array_reserve(&boxes->at, &boxes->capacity, boxes->n + 1, sizeof *boxes->at))
            return gis_no_memory(error);
        one = &boxes->at[boxes->n];
    }
    set_box(one, fid, box);
    if (boxes->scratch && !store_box(boxes, one, error)) return false;
    if (boxes->n++ == 0) memcpy(boxes->around, one->side, sizeof one->side);
    for (int k = 0; k < 4; k++)
        boxes->around[k] = k % 2 ? fmaxf(boxes->around[k], one->side[k]) : fminf(boxes->around[k], one->side[k]);
    return true;
}

void gis_index_boxes_clear(gis_index_boxes *boxes)
{
    free(boxes->at);
    gis_disk_file_close(&boxes->file);
    *boxes = (gis_index_boxes){.scratch = boxes->scratch};
}

/* ---- Order ------------------------------------------------------------------------------------------------------- */

/* The curve's grid is fine enough to distinguish the boxes of any layer. */
enum { CURVE_BITS = 16 };

/* The position of the box's centre along the curve. Boxes at the same position keep their order of insertion. */
static uint32_t position_along(const gis_index_boxes *boxes, const gis_index_box *box)
{
    const float *around = boxes->around, *side = box->side;
    const uint32_t x = gis_curve_cell(((double)side[0] + side[1]) / 2, around[0], around[1], CURVE_BITS);
    const uint32_t y = gis_curve_cell(((double)side[2] + side[3]) / 2, around[2], around[3], CURVE_BITS);
    return (uint32_t)gis_curve_position(x, y, CURVE_BITS);
}

static bool take_from_memory(gis_index_boxes *boxes, gis_index_boxes_take *take, void *user, gis_error *error)
{
    gis_keyed *places = malloc((boxes->n + 1) * sizeof *places); /* position along the curve, and number of the box */
    for (size_t i = 0; places && i < boxes->n; i++) places[i] = (gis_keyed){position_along(boxes, &boxes->at[i]), i};
    bool done = (places && gis_keyed_sort(places, boxes->n)) || gis_no_memory(error);
    for (size_t i = 0; done && i < boxes->n; i++) done = take(user, &boxes->at[places[i].with], error);
    free(places);
    return done;
}

typedef struct taking {
    gis_index_boxes_take *take;
    void *user;
} taking;

static bool take_record(void *user, const unsigned char *bytes, gis_error *error)
{
    const taking *t = user;
    const record *one = (const void *)bytes;
    return t->take(t->user, &one->box, error);
}

/* Number of boxes read at once. */
enum { STRETCH = 4096 };

static bool sort_file(gis_index_boxes *boxes, gis_sorter *sorter, gis_error *error)
{
    gis_index_box *box = malloc(STRETCH * sizeof *box);
    bool done = (box || gis_no_memory(error)) && gis_disk_file_flush(&boxes->file, error);
    for (size_t k = 0; k < boxes->n && done; k += STRETCH) {
        const size_t n = boxes->n - k < STRETCH ? boxes->n - k : STRETCH;
        done = gis_disk_file_read(&boxes->file, k * sizeof *box, box, n * sizeof *box, error) && gis_go_on(error);
        for (size_t i = 0; i < n && done; i++) {
            const record one = {.head = {sizeof one, position_along(boxes, &box[i]), 0}, .box = box[i]};
            done = gis_sorter_add(sorter, &one, error);
        }
    }
    free(box);
    return done;
}

static bool take_from_disk(gis_index_boxes *boxes, gis_index_boxes_take *take, void *user, gis_error *error)
{
    taking t = {take, user};
    gis_sorter *sorter = NULL;
    const bool done =
        boxes->n == 0 || (gis_sorter_new(boxes->scratch, "boxes-sorted.XXXXXX", GIS_SORT_BYTES, &sorter, error) &&
                          sort_file(boxes, sorter, error) && gis_sorter_take(sorter, take_record, &t, error));
    gis_sorter_free(sorter);
    return done;
}

bool gis_index_boxes_in_order(gis_index_boxes *boxes, gis_index_boxes_take *take, void *user, gis_error *error)
{
    const bool done =
        boxes->scratch ? take_from_disk(boxes, take, user, error) : take_from_memory(boxes, take, user, error);
    gis_index_boxes_clear(boxes);
    return done;
}
