/* parts_separate.c: see part.h. The features in the cells of some parts are separated, or become larger; the features
 * around them, within layout->halo, are read as well. */
#include "shards/parts/part.h"

#include <stdlib.h>

typedef struct cells_of_parts {
    const gis_spool *spool;
    unsigned first, end;
} cells_of_parts;

static bool is_of_parts(const void *user, size_t cell, size_t index)
{
    const cells_of_parts *s = user;
    (void)index;
    const unsigned part = gis_spool_cell_at(s->spool, cell)->part;
    return s->first <= part && part < s->end;
}

static bool list_boxes(const gis_layout *layout, unsigned first, unsigned end, gis_boxes_list *boxes, gis_error *error)
{
    bool done = true;
    for (size_t k = 0; k < gis_spool_cells(layout->spool) && done; k++) {
        const gis_spool_cell *c = gis_spool_cell_at(layout->spool, k);
        if (first <= c->part && c->part < end && c->box[0] <= c->box[2])
            done = gis_boxes_add(boxes, c->box, layout->halo, error);
    }
    return done;
}

bool gis_parts_separate(const gis_layout *layout, unsigned first, unsigned end, gis_part_result *result,
                        gis_error *error)
{
    gis_boxes_list boxes = {0};
    const cells_of_parts which = {layout->spool, first, end};
    const bool done = list_boxes(layout, first, end, &boxes, error) &&
                      (boxes.n == 0 || gis_part_separate(layout, &boxes, is_of_parts, &which, first, result, error));
    free(boxes.box);
    return done;
}

bool gis_parts_enlarge(const gis_layout *layout, unsigned first, unsigned end, gis_spool_writer *to, size_t *larger,
                       gis_error *error)
{
    gis_boxes_list boxes = {0};
    const cells_of_parts which = {layout->spool, first, end};
    const bool done = list_boxes(layout, first, end, &boxes, error) &&
                      (boxes.n == 0 || gis_part_enlarge(layout, &boxes, is_of_parts, &which, to, larger, error));
    free(boxes.box);
    return done;
}
