/* parts_separate.c: see part.h. Separates the features in the cells of these parts; the features around them, within
 * layout->halo, are read as well. */
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

bool gis_parts_separate(const gis_layout *layout, unsigned first, unsigned end, gis_part_result *result,
                        gis_error *error)
{
    const gis_spool *spool = layout->spool;
    gis_boxes_list boxes = {0};
    const cells_of_parts which = {spool, first, end};
    bool done = true;
    for (size_t k = 0; k < gis_spool_cells(spool) && done; k++) {
        const gis_spool_cell *c = gis_spool_cell_at(spool, k);
        if (first <= c->part && c->part < end && c->box[0] <= c->box[2])
            done = gis_boxes_add(&boxes, c->box, layout->halo, error);
    }
    done = done && (boxes.n == 0 || gis_part_separate(layout, &boxes, is_of_parts, &which, first, result, error));
    free(boxes.box);
    return done;
}
