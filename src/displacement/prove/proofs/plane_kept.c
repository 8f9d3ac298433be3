/* A cache of the planes of relative moves, for questions about the same bodies. Two blocks of dozens of houses have a
 * hundred conflicts; each is examined, and again without each feature of its proof (report/no_room.c). The
 * obstacles are the same each time, tens of thousands of them, and so are the half-planes of all except those in
 * question. The cache only saves time: answers are the same, and their cost is counted the same. */
#include "displacement/prove/proofs/plane.h"

#include "base/stage_switch.h"

#include <string.h>

static void free_kept(struct sunder_i_plane_kept *kept)
{
    if (!kept) return;
    sunder_i_free_all(kept->obstacle, kept->box, kept->run, kept->item, kept->tree.box);
    for (size_t k = 0; k < 2; k++) sunder_i_plane_choices_free(&kept->proofs[k]);
    sunder_i_free_all(kept->half_plane, kept);
}

void sunder_i_planes_clear(sunder_i_planes *planes)
{
    for (size_t k = 0; k < SUNDER_I_PLANES_KEPT; k++) free_kept(planes->plane[k]);
    sunder_i_half_planes_forget(&planes->half_planes);
    memset(planes, 0, sizeof *planes);
}

static bool is_of(const struct sunder_i_plane_kept *kept, const sunder_i_plane *g)
{
    return kept->p == g->p && kept->q == g->q && kept->reach == g->reach && kept->coarse == g->c->subproblem->coarse &&
           sunder_i_stage_is_on("memo", "planes");
}

/* The most recently used entry is moved to the front. */
struct sunder_i_plane_kept *sunder_i_planes_take(sunder_i_planes *planes, const sunder_i_plane *plane)
{
    size_t at = 0;
    while (at + 1 < SUNDER_I_PLANES_KEPT && planes->plane[at] && !is_of(planes->plane[at], plane)) at++;
    struct sunder_i_plane_kept *found = planes->plane[at];
    if (found && !is_of(found, plane)) {
        free_kept(found);
        found = NULL;
    }
    memmove(planes->plane + 1, planes->plane, at * sizeof(planes->plane[0]));
    planes->plane[0] = found;
    if (found) return found;
    found = sunder_i_calloc(1, sizeof *found);
    if (!found) return NULL;
    found->p = plane->p;
    found->q = plane->q;
    found->reach = plane->reach;
    found->coarse = plane->c->subproblem->coarse;
    planes->plane[0] = found;
    return sunder_i_plane_find(plane, found) ? found : NULL;
}
