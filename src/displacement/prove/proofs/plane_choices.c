/* A cache of the obstacles that divided a plane, for nearly equal questions: without one feature of a proof, or about
 * the next conflict of the same two blocks.
 *
 * A region is divided by the obstacle that covers its middle and most of it. If that obstacle is forbidden in the next
 * question, too, it is still the best of everything forbidden before; so only new obstacles have to be examined, a few
 * pieces of the pair in question, or none. If it remains the best, the regions that its half-planes leave are the same,
 * and so on. So the choices equal those made without the cache, and their counted cost is the same. */
#include "displacement/prove/proofs/plane.h"

#include "base/list.h"

#include <string.h>

enum { MANY, FEW };

void sunder_i_plane_choices_free(sunder_i_plane_choices *choices)
{
    sunder_i_free_all(choices->choice, choices->region, choices->asked);
    memset(choices, 0, sizeof *choices);
}

/* Was the run not forbidden in the cached question `then`? */
static bool is_fresh(const sunder_i_plane_choices *then, uint32_t run)
{
    return run >= then->runs || !then->asked[run];
}

static size_t count_fresh(const sunder_i_plane *g, const sunder_i_plane_choices *then)
{
    size_t n = 0;
    for (size_t k = 0; k < g->runs; k++)
        if (is_fresh(then, g->run[k])) n += g->kept->run[g->run[k]].reached;
    return n;
}

bool sunder_i_plane_choices_begin(sunder_i_plane *plane)
{
    struct sunder_i_plane_kept *kept = plane->kept;
    sunder_i_plane_choices *made = &plane->made;
    if (plane->obstacles > kept->most_asked) kept->most_asked = plane->obstacles;
    if (!sunder_i_reserve(&made->region, &made->region_capacity, 1, sizeof *made->region)) return false;
    made->region[made->regions++] = SUNDER_I_NO_CHOICE;
    for (size_t k = 2; k-- > 0 && !plane->known;)
        if (kept->proofs[k].n && count_fresh(plane, &kept->proofs[k]) <= plane->obstacles / PLANE_FRESH)
            plane->known = &kept->proofs[k];
    bool ok = true;
    for (size_t k = 0; k < plane->runs && plane->known && ok; k++)
        if (is_fresh(plane->known, plane->run[k]))
            ok = sunder_i_plane_index_list(kept, &kept->run[plane->run[k]], &plane->fresh, &plane->freshes,
                                           &plane->fresh_capacity);
    return ok;
}

const sunder_i_plane_choice *sunder_i_plane_choices_known(const sunder_i_plane *plane, uint32_t region)
{
    if (!plane->known || region == SUNDER_I_NO_CHOICE || plane->known->region[region] == SUNDER_I_NO_CHOICE)
        return NULL;
    const sunder_i_plane_choice *choice = &plane->known->choice[plane->known->region[region]];
    if (choice->obstacle == SUNDER_I_NO_CHOICE) return choice;
    return plane->kept->run[plane->kept->obstacle[choice->obstacle].run].asked ? choice : NULL;
}

uint32_t sunder_i_plane_choices_below(const sunder_i_plane *plane, uint32_t region, uint32_t obstacle)
{
    const sunder_i_plane_choice *choice = sunder_i_plane_choices_known(plane, region);
    return choice && choice->obstacle == obstacle ? choice->below : SUNDER_I_NO_CHOICE;
}

bool sunder_i_plane_choices_add(sunder_i_plane *plane, uint32_t region, uint32_t obstacle, size_t half_planes,
                                double share, uint32_t *below)
{
    sunder_i_plane_choices *made = &plane->made;
    if (region == SUNDER_I_NO_CHOICE) {
        *below = SUNDER_I_NO_CHOICE;
        return true;
    }
    if (!sunder_i_reserve(&made->choice, &made->capacity, made->n + 1, sizeof *made->choice) ||
        !sunder_i_reserve(&made->region, &made->region_capacity, made->regions + half_planes, sizeof *made->region))
        return false;
    *below = (uint32_t)made->regions;
    for (size_t k = 0; k < half_planes; k++) made->region[made->regions++] = SUNDER_I_NO_CHOICE;
    made->region[region] = (uint32_t)made->n;
    made->choice[made->n++] = (sunder_i_plane_choice){share, obstacle, *below};
    return true;
}

bool sunder_i_plane_choices_end(sunder_i_plane *plane, bool proved)
{
    struct sunder_i_plane_kept *kept = plane->kept;
    sunder_i_plane_choices *made = &plane->made;
    if (!proved || !made->n) return true;
    if (!sunder_i_reserve(&made->asked, &made->run_capacity, kept->runs, sizeof *made->asked)) return false;
    for (size_t k = 0; k < kept->runs; k++) made->asked[k] = kept->run[k].asked;
    made->runs = kept->runs;
    sunder_i_plane_choices *to = &kept->proofs[2 * plane->obstacles < kept->most_asked ? FEW : MANY];
    sunder_i_plane_choices_free(to);
    *to = *made;
    memset(made, 0, sizeof *made);
    return true;
}
