/* part_of_shard.c: the parts that a spool is dealt to. */
#include "shards/parts/part.h"

#include <stdlib.h>

typedef struct of_shard {
    const gis_spool *spool;
    unsigned first, end;
} of_shard;

static bool is_of_shard(const void *user, size_t cell, size_t index)
{
    const of_shard *s = user;
    (void)index;
    const unsigned shard = gis_spool_cell_at(s->spool, cell)->shard;
    return s->first <= shard && shard < s->end;
}

bool gis_parts_shards(const gis_layout *layout, unsigned first, unsigned end, gis_part_result *result, gis_error *error)
{
    const gis_spool *spool = layout->spool;
    gis_boxes_list boxes = {0};
    const of_shard which = {spool, first, end};
    bool done = true;
    for (size_t k = 0; k < gis_spool_cells(spool) && done; k++) {
        const gis_spool_cell *c = gis_spool_cell_at(spool, k);
        if (first <= c->shard && c->shard < end && c->box[0] <= c->box[2])
            done = gis_boxes_add(&boxes, c->box, layout->halo, error);
    }
    done = done && (boxes.n == 0 || gis_part_separate(layout, &boxes, is_of_shard, &which, first, result, error));
    free(boxes.box);
    return done;
}
