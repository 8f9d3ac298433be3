/* A cache of the pieces that divided a plane, for nearly equal questions: without one feature of a proof, or about the
 * next conflict of the same two blocks.
 *
 * A region is divided by the obstacle that covers its middle and most of it. If that obstacle is forbidden in the next
 * question, too, it is still the best of everything forbidden before; so only new obstacles have to be examined, a few
 * pieces of the pair in question, or none. If it remains the best, the regions that its ways leave are the same, and so
 * on. So the choices equal those made without the cache, and their counted cost is the same. */
#include "displacement/prove/proofs/plane.h"

#include "base/list.h"

#include <string.h>

enum { MANY, FEW };

void sunder_i_plane_choices_free(sunder_i_plane_choices *choices)
{
    sunder_i_free(choices->choice);
    sunder_i_free(choices->region);
    sunder_i_free(choices->asked);
    memset(choices, 0, sizeof *choices);
}

/* Was that run not forbidden then? */
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

bool sunder_i_plane_choices_begin(sunder_i_plane *g)
{
    struct sunder_i_plane_kept *kept = g->kept;
    sunder_i_plane_choices *made = &g->made;
    if (g->obstacles > kept->most_asked) kept->most_asked = g->obstacles;
    if (!sunder_i_reserve(&made->region, &made->region_capacity, 1, sizeof *made->region)) return false;
    made->region[made->regions++] = SUNDER_I_NO_CHOICE;
    for (size_t k = 2; k-- > 0 && !g->known;)
        if (kept->proofs[k].n && count_fresh(g, &kept->proofs[k]) <= g->obstacles / PLANE_FRESH)
            g->known = &kept->proofs[k];
    bool ok = true;
    for (size_t k = 0; k < g->runs && g->known && ok; k++)
        if (is_fresh(g->known, g->run[k]))
            ok = sunder_i_plane_index_list(kept, &kept->run[g->run[k]], &g->fresh, &g->freshes, &g->fresh_capacity);
    return ok;
}

const sunder_i_plane_choice *sunder_i_plane_choices_known(const sunder_i_plane *g, uint32_t region)
{
    if (!g->known || region == SUNDER_I_NO_CHOICE || g->known->region[region] == SUNDER_I_NO_CHOICE) return NULL;
    const sunder_i_plane_choice *choice = &g->known->choice[g->known->region[region]];
    if (choice->obstacle == SUNDER_I_NO_CHOICE) return choice;
    return g->kept->run[g->kept->obstacle[choice->obstacle].run].asked ? choice : NULL;
}

uint32_t sunder_i_plane_choices_below(const sunder_i_plane *g, uint32_t region, uint32_t obstacle)
{
    const sunder_i_plane_choice *choice = sunder_i_plane_choices_known(g, region);
    return choice && choice->obstacle == obstacle ? choice->below : SUNDER_I_NO_CHOICE;
}

bool sunder_i_plane_choices_add(sunder_i_plane *g, uint32_t region, uint32_t obstacle, size_t ways, double share,
                                uint32_t *below)
{
    sunder_i_plane_choices *made = &g->made;
    if (region == SUNDER_I_NO_CHOICE) {
        *below = SUNDER_I_NO_CHOICE;
        return true;
    }
    if (!sunder_i_reserve(&made->choice, &made->capacity, made->n + 1, sizeof *made->choice) ||
        !sunder_i_reserve(&made->region, &made->region_capacity, made->regions + ways, sizeof *made->region))
        return false;
    *below = (uint32_t)made->regions;
    for (size_t k = 0; k < ways; k++) made->region[made->regions++] = SUNDER_I_NO_CHOICE;
    made->region[region] = (uint32_t)made->n;
    made->choice[made->n++] = (sunder_i_plane_choice){share, obstacle, *below};
    return true;
}

bool sunder_i_plane_choices_end(sunder_i_plane *g, bool proved)
{
    struct sunder_i_plane_kept *kept = g->kept;
    sunder_i_plane_choices *made = &g->made;
    if (!proved || !made->n) return true;
    if (!sunder_i_reserve(&made->asked, &made->run_capacity, kept->runs, sizeof *made->asked)) return false;
    for (size_t k = 0; k < kept->runs; k++) made->asked[k] = kept->run[k].asked;
    made->runs = kept->runs;
    sunder_i_plane_choices *to = &kept->proofs[2 * g->obstacles < kept->most_asked ? FEW : MANY];
    sunder_i_plane_choices_free(to);
    *to = *made;
    memset(made, 0, sizeof *made);
    return true;
}
