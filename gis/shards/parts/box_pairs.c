/* box_pairs.c: see box_pairs.h. A sweep from left to right; the boxes that the sweep line intersects are kept at the
 * front of the same array. */
#include "shards/parts/box_pairs.h"

#include "base/array.h"

#include <stdlib.h>
#include <string.h>

bool gis_box_pairs_add(gis_box_pairs *pairs, const double box[4], size_t of, int kind, gis_error *error)
{
    if (!(box[0] <= box[2])) return true;
    if (!gis_array_reserve(&pairs->box, &pairs->room, pairs->n + 1, sizeof *pairs->box)) return gis_no_memory(error);
    gis_paired_box *to = &pairs->box[pairs->n++];
    *to = (gis_paired_box){.of = of, .kind = kind};
    memcpy(to->box, box, sizeof to->box);
    return true;
}

static int by_left(const void *a, const void *b)
{
    const gis_paired_box *p = a, *q = b;
    return (p->box[0] > q->box[0]) - (p->box[0] < q->box[0]);
}

static bool heights_meet(const gis_paired_box *a, const gis_paired_box *b)
{
    return a->box[1] <= b->box[3] && b->box[1] <= a->box[3];
}

void gis_box_pairs_visit(gis_box_pairs *pairs, gis_box_pairs_visitor *meets, void *user)
{
    gis_paired_box *box = pairs->box;
    size_t open = 0;
    if (pairs->n) qsort(box, pairs->n, sizeof *box, by_left);
    for (size_t k = 0; k < pairs->n; k++) {
        const gis_paired_box next = box[k];
        gis_box_pairs_next on = GIS_BOX_PAIRS_BOTH;
        size_t kept = 0;
        for (size_t i = 0; i < open; i++) {
            if (box[i].box[2] < next.box[0]) continue;
            if (on != GIS_BOX_PAIRS_A_ONLY && heights_meet(&box[i], &next)) on = meets(user, &box[i], &next);
            if (on != GIS_BOX_PAIRS_B_ONLY) {
                if (kept != i) box[kept] = box[i];
                kept++;
            }
            if (on == GIS_BOX_PAIRS_B_ONLY) on = GIS_BOX_PAIRS_BOTH;
        }
        open = kept;
        if (on != GIS_BOX_PAIRS_A_ONLY)
            box[open++] = next; /* open <= k, so this overwrites a box that was processed
                                                             * already */
    }
    pairs->n = 0;
}

void gis_box_pairs_clear(gis_box_pairs *pairs)
{
    free(pairs->box);
    *pairs = (gis_box_pairs){0};
}
