/* incremental.c: incremental union [AFH00, section 2].
 *
 * Subsums are united one at a time with the union so far. Each is inserted into the map of the union; then all elements
 * of the map inside it, and all parts of its own boundary inside the union, are redundant and are removed.
 *
 * Invariant: the map is that of the union of the subsums inserted so far, with its degenerate holes and nothing else.
 * An edge or vertex is redundant only if it is in the interior of some subsum: one between two covered faces that no
 * subsum covers is a degenerate hole, and remains until a later subsum covers it.
 *
 * Time: the number of elements that are inserted and removed. The method is good if the union remains small, and better
 * if fat subsums come first (subsum_order.c); if no subsum covers many crossings of others, it computes as much as the
 * arrangement, and the removals in addition. */
#include "base/random.h"
#include "unions/unions.h"

static sunder_status unite_subsums(sunder_i_uniting *u, uint32_t *subsum, uint32_t first, uint32_t n,
                                   sunder_i_planar_map *map, sunder_error *err)
{
    for (uint32_t k = 0; k < n; k++) subsum[k] = first + k;
    if (!sunder_i_order_subsums(u, subsum, n)) return sunder_i_failure_cause(err);
    return sunder_i_feed(u, subsum, n, sunder_i_planar_map_unite_polygon, map, err);
}

sunder_status sunder_i_unite_some(sunder_i_uniting *u, uint32_t first, uint32_t n, sunder_i_planar_map **out,
                                  sunder_error *err)
{
    sunder_i_planar_map *map;
    sunder_status status = sunder_i_planar_map_new(u->lattice, sunder_i_draw(&u->random), &map, err);
    if (status != SUNDER_OK) return status;
    uint32_t *subsum = sunder_i_alloc(n, sizeof *subsum);
    status = subsum ? unite_subsums(u, subsum, first, n, map, err) : sunder_i_failure_cause(err);
    sunder_i_free(subsum);
    if (status == SUNDER_OK)
        *out = map;
    else
        sunder_i_planar_map_free(map);
    return status;
}

sunder_status sunder_i_unite_by_increments(sunder_i_uniting *u, sunder_i_planar_map **out, sunder_error *err)
{
    return sunder_i_unite_some(u, 0, u->subsums, out, err);
}
