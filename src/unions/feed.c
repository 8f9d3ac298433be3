/* Subsums are made one at a time when they are needed, and discarded when they are in the map: so the memory is that of
 * the map. Their time and operations are counted separately from the map's. */
#include "unions/unions.h"

#include "base/clock.h"
#include "base/counts.h"

bool sunder_i_make_subsum(sunder_i_uniting *u, uint32_t subsum, sunder_i_convex_sum *out)
{
    const sunder_counts before = u->lattice->counts;
    const double start = sunder_i_now();
    const bool ok =
        sunder_i_convex_sum_of(u->lattice, &u->p, subsum % u->p.pieces, &u->q, subsum / u->p.pieces, &u->arena, out);
    u->seconds += sunder_i_now() - start;
    sunder_i_counts_add(&u->counts, &u->lattice->counts, &before);
    return ok;
}

/* Reports progress: each subsum counts equally, though later ones usually take longer. Returns false if cancelled. */
static bool go_on(const sunder_i_uniting *u)
{
    const sunder_sum_options *o = u->options;
    return !o->progress || o->progress((double)u->fed / u->subsums, o->progress_user);
}

sunder_status sunder_i_feed(sunder_i_uniting *u, const uint32_t *subsum, uint32_t n, sunder_i_add_polygon add,
                            sunder_i_planar_map *map, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (uint32_t i = 0; i < n && status == SUNDER_OK; i++, u->fed++) {
        if (!go_on(u)) return sunder_i_cancelled(err);
        const sunder_i_mark mark = sunder_i_arena_mark(&u->arena);
        sunder_i_convex_sum s;
        if (!sunder_i_make_subsum(u, subsum[i], &s)) return sunder_i_failure_cause(err);
        status = add(map, s.at, s.along, s.corners, err);
        sunder_i_arena_release(&u->arena, mark);
    }
    return status;
}
