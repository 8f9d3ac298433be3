/* unions.c: the stages of a sum by union: operands on one lattice, pieces, the union, the outline from its map. */
#include "unions/unions.h"

#include "base/clock.h"
#include "base/counts.h"
#include "sum/from_map.h"
#include "sum/map_view.h"
#include "sum/operands_on_lattice.h"

#include <inttypes.h>

static sunder_status unite_by_algorithm(sunder_i_uniting *u, sunder_algorithm algorithm, sunder_i_planar_map **map,
                                        sunder_error *err)
{
    const uint64_t subsums = (uint64_t)u->p.pieces * u->q.pieces;
    if (subsums >= UINT32_MAX)
        return sunder_i_fail(err, SUNDER_ESIZE, "%" PRIu64 " pairs of convex pieces are more than can be numbered",
                             subsums);
    u->subsums = (uint32_t)subsums;
    switch (algorithm) {
    case SUNDER_ALGORITHM_INCREMENTAL: return sunder_i_unite_by_increments(u, map, err);
    case SUNDER_ALGORITHM_DIVIDE:
        if (subsums) return sunder_i_unite_by_halves(u, map, err);
        break;
    default: break;
    }
    return sunder_i_unite_by_arrangement(u, map, err);
}

/* Makes the outline of the sum from the map. The map is moved to the sum if `keep`, else freed. */
static sunder_status finish_sum(sunder_sum *sum, sunder_i_planar_map *map, bool keep, sunder_error *err)
{
    const sunder_status status = sunder_i_sum_from_map(map, sum, err);
    if (status == SUNDER_OK && keep) return sunder_i_map_view_take(map, sum, &sum->map, err);
    sunder_i_planar_map_free(map);
    return status;
}

static sunder_status unite_pieces(sunder_sum *sum, sunder_i_uniting *u, sunder_error *err)
{
    const double start = sunder_i_now();
    const sunder_counts before = sum->lattice.counts;
    sunder_i_planar_map *map;
    sunder_status status = unite_by_algorithm(u, sum->method.algorithm, &map, err);
    if (status == SUNDER_OK) status = finish_sum(sum, map, u->options->keep_map, err);
    if (status != SUNDER_OK) return status;
    const sunder_counts all = sunder_i_counts_since(&sum->lattice.counts, &before);
    sum->phase[SUNDER_PHASE_SUBSUMS] = u->counts;
    sum->phase[SUNDER_PHASE_UNION] = sunder_i_counts_since(&all, &u->counts);
    sum->seconds[SUNDER_PHASE_SUBSUMS] = u->seconds;
    sum->seconds[SUNDER_PHASE_UNION] = sunder_i_now() - start - u->seconds;
    return SUNDER_OK;
}

sunder_status sunder_i_union_sum(sunder_sum *sum, const sunder_shape *p, const sunder_shape *q, bool force_wide,
                                 const sunder_sum_options *options, sunder_error *err)
{
    const double start = sunder_i_now();
    sunder_i_placed placed;
    sunder_status status = sunder_i_sum_place(sum, p, q, force_wide, &placed, err);
    if (status != SUNDER_OK) return status;
    sunder_i_uniting u = {
        .lattice = &sum->lattice, .options = options, .fatness = SUNDER_I_FATNESS, .random = options->seed};
    const sunder_counts before = sum->lattice.counts;
    status = sunder_i_decompose_pair(&sum->lattice, p, placed.p, q, placed.q, options->decomposition, &u.p, &u.q, err);
    sunder_i_placed_free(&placed);
    if (status != SUNDER_OK) return status;
    sum->phase[SUNDER_PHASE_DECOMPOSE] = sunder_i_counts_since(&sum->lattice.counts, &before);
    sum->seconds[SUNDER_PHASE_DECOMPOSE] = sunder_i_now() - start;
    /* that of the operand with fallbacks, if there is one */
    sum->method.decomposition = u.p.fallbacks ? u.p.used : u.q.used;
    sum->method.order = options->order;
    sum->method.pieces_p = u.p.pieces;
    sum->method.pieces_q = u.q.pieces;
    status = unite_pieces(sum, &u, err);
    sunder_i_decomposition_clear(&u.p);
    sunder_i_decomposition_clear(&u.q);
    sunder_i_arena_free(&u.arena);
    return status;
}
