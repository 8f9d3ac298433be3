/* box_pairs.c: see box_pairs.h. Boxes that the line has reached and not left lie at the front of the same list. */
#include "shards/parts/box_pairs.h"

#include "base/array.h"

#include <stdlib.h>
#include <string.h>

bool gis_sweep_add(gis_sweep *sweep, const double box[4], size_t of, int kind, gis_error *error)
{
    if (!(box[0] <= box[2])) return true;
    if (!gis_array_reserve(&sweep->box, &sweep->room, sweep->n + 1, sizeof *sweep->box)) return gis_no_memory(error);
    gis_swept *to = &sweep->box[sweep->n++];
    *to = (gis_swept){.of = of, .kind = kind};
    memcpy(to->box, box, sizeof to->box);
    return true;
}

static int by_left(const void *a, const void *b)
{
    const gis_swept *p = a, *q = b;
    return (p->box[0] > q->box[0]) - (p->box[0] < q->box[0]);
}

static bool meet(const gis_swept *a, const gis_swept *b) { return a->box[1] <= b->box[3] && b->box[1] <= a->box[3]; }

void gis_sweep_run(gis_sweep *sweep, gis_sweep_meets *meets, void *user)
{
    gis_swept *box = sweep->box;
    size_t open = 0;
    if (sweep->n) qsort(box, sweep->n, sizeof *box, by_left);
    for (size_t k = 0; k < sweep->n; k++) {
        const gis_swept next = box[k];
        gis_sweep_on on = GIS_SWEEP_BOTH;
        size_t kept = 0;
        for (size_t i = 0; i < open; i++) {
            if (box[i].box[2] < next.box[0]) continue;
            if (on != GIS_SWEEP_A_ALONE && meet(&box[i], &next)) on = meets(user, &box[i], &next);
            if (on != GIS_SWEEP_B_ALONE) {
                if (kept != i) box[kept] = box[i];
                kept++;
            }
            if (on == GIS_SWEEP_B_ALONE) on = GIS_SWEEP_BOTH;
        }
        open = kept;
        if (on != GIS_SWEEP_A_ALONE) box[open++] = next; /* open <= k: what stood there was taken */
    }
    sweep->n = 0;
}

void gis_sweep_clear(gis_sweep *sweep)
{
    free(sweep->box);
    *sweep = (gis_sweep){0};
}
